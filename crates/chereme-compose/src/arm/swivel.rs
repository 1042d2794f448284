//! Rotates arms about the line from shoulder to wrist, and their bones about their length, over all frames at once.

use std::f64::consts::TAU;

use chereme_motion::glam::{DQuat, DVec3};

use super::free_angle::{FreelyTurnedRotation, RotatingDirection, ease_free_angles};
use super::smooth::TrustedAngles;
use super::{ArmJointTurns, ArmSource, ArmStep, least_turn, off_line, shoulder_wrist_direction};

/// The speed of an elbow about its shoulder beyond the source's, in radians per second: 3.5 degrees per frame at 120
/// Hz.
const MAX_ELBOW_SWING_SPEED: f64 = 7.3;
/// The rotation speed of upper arm and forearm beyond the source's, in radians per second: 4.3 degrees per frame at 120
/// Hz.
const MAX_ARM_TURN_SPEED: f64 = 9.0;

/// Rotates arms about the line from shoulder to wrist so that they move steadily: first the whole arm, then the elbow
/// alone, if it is not in the direction of its natural bend.
pub(super) fn swivel_arm_steps(steps: &mut [ArmStep], frame_time: f64) {
    let was = swivels(steps.iter().map(|step| (shoulder_wrist_direction(step.was), step.pole)));
    let is = swivels(
        steps
            .iter()
            .map(|step| (shoulder_wrist_direction(step.is), step.carry * step.pole)),
    );
    if let Some(changes) = calm_line_angles(steps, &was, is, |_| 1.0, frame_time) {
        for (step, change) in steps.iter_mut().zip(changes).filter(|(step, _)| step.moves) {
            step.carry = DQuat::from_axis_angle(shoulder_wrist_direction(step.is), change) * step.carry;
        }
    }
    // Measured again, because elbows ride on the changed swivels of their arms.
    let was = swivels(
        steps
            .iter()
            .map(|step| (shoulder_wrist_direction(step.was), step.stands)),
    );
    let is = swivels(
        steps
            .iter()
            .map(|step| (shoulder_wrist_direction(step.is), step.carry * step.bends)),
    );
    // An elbow that stands out farther than in the source may swing by a smaller angle only.
    let seen = |step: &ArmStep| (off_line(step.was) / off_line(step.is).max(1e-9)).min(1.0);
    let changes = calm_line_angles(steps, &was, is, seen, frame_time);
    for (n, step) in steps.iter_mut().enumerate().filter(|(_, step)| step.moves) {
        let line = shoulder_wrist_direction(step.is);
        let mut out = step.carry * step.bends;
        if let Some(changes) = &changes {
            out = DQuat::from_axis_angle(line, changes[n]) * out;
        }
        // A part along the line would change the lengths of the bones.
        let out = out.reject_from_normalized(line).normalize_or(out);
        let along = (step.is[1] - step.is[0]).dot(line);
        step.is[1] = step.is[0] + line * along + out * off_line(step.is);
    }
}

/// Smooths the angles `is` about the new lines; the share `seen` of the changes of `was`, the angles about the old
/// lines, counts as their own change.
fn calm_line_angles(
    steps: &[ArmStep],
    was: &[f64],
    is: Vec<f64>,
    seen: impl Fn(&ArmStep) -> f64,
    frame_time: f64,
) -> Option<Vec<f64>> {
    let trusted_turns = own_angle_changes(was).into_iter().enumerate().map(|(n, turn)| {
        // A change is as reliable as the less reliable of its two frames.
        let trust = steps[n.saturating_sub(1)].trust.min(steps[n].trust);
        turn * trust.min(1.0) * seen(&steps[n])
    });
    let own_turns = trusted_turns.collect();
    let trust = steps.iter().map(|step| step.trust).collect();
    TrustedAngles {
        values: is,
        trust,
        own: own_turns,
    }
    .calming_corrections(frame_time)
}

/// Returns the angle of each direction about its line, relative to a reference that follows the lines by shortest
/// rotations.
fn swivels(arms: impl Iterator<Item = (DVec3, DVec3)>) -> Vec<f64> {
    let mut carried: Option<(DVec3, DVec3)> = None;
    arms.map(|(line, out)| {
        let carried_across = match carried {
            Some((before, across)) => carried_along(before, line, across),
            None => line.any_orthonormal_vector(),
        };
        let across = carried_across
            .reject_from_normalized(line)
            .normalize_or(line.any_orthonormal_vector());
        carried = Some((line, across));
        line.dot(across.cross(out)).atan2(across.dot(out))
    })
    .collect()
}

/// Applies the shortest rotation from one unit vector to another to `across`, a vector at a right angle to the first.
fn carried_along(from: DVec3, to: DVec3, across: DVec3) -> DVec3 {
    let opposed = 1.0 + from.dot(to);
    // Between opposite lines the formula would divide by zero, and any half turn is shortest.
    if opposed < 1e-9 {
        return least_turn(from, to) * across;
    }
    across - (from + to) * (to.dot(across) / opposed)
}

/// Returns the change of each angle from the one before, in the shorter direction.
fn own_angle_changes(angles: &[f64]) -> Vec<f64> {
    let turned = |n: usize| match n.checked_sub(1) {
        Some(before) => {
            let turn = angles[n] - angles[before];
            turn - TAU * (turn / TAU).round()
        }
        None => 0.0,
    };
    (0..angles.len()).map(turned).collect()
}

/// Returns the angle of a rotation.
fn swivel_rotation_angle(q: DQuat) -> f64 {
    // `q` and `-q` are one rotation; the absolute value takes the shorter way.
    2.0 * q.xyz().length().atan2(q.w.abs())
}

/// Returns the largest allowed change of each frame from the one before: `more` than the change in the source.
fn most(frames: usize, more: f64, source: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let most = |n: usize| n.checked_sub(1).map_or(0.0, |before| source(before, n) + more);
    (0..frames).map(most).collect()
}

fn stay(steps: &[ArmStep]) -> Vec<bool> {
    steps.iter().map(|step| !step.moves).collect()
}

/// Rotates arms about their lines if an elbow would jump and can avoid it.
pub(super) fn ease_elbow_jumps(source: &ArmSource, steps: &mut [ArmStep], frame_time: f64) {
    let trunk: Vec<DQuat> = source.trunks(steps.len());
    // Seen from the trunk, so that a turn of the whole body is no jump.
    let arm_circles = steps.iter().zip(&trunk).map(|(step, trunk)| RotatingDirection {
        line: *trunk * shoulder_wrist_direction(step.is),
        start: *trunk * arm_bone_directions(step.is)[0],
    });
    let circles: Vec<RotatingDirection> = arm_circles.collect();
    if RotatingDirection::is_calm(&circles, MAX_ELBOW_SWING_SPEED * frame_time) {
        return;
    }
    let was: Vec<DVec3> = (0..steps.len())
        .map(|n| trunk[n] * arm_bone_directions(steps[n].was)[0])
        .collect();
    let most = most(steps.len(), MAX_ELBOW_SWING_SPEED * frame_time, |before, n| {
        was[before].angle_between(was[n])
    });
    let changes = ease_free_angles(&stay(steps), frame_time, |n, angles| {
        let two = [&circles[n - 1], &circles[n]];
        [RotatingDirection::direction_excess_rotation(two, angles, most[n]), None]
    });
    let Some(changes) = changes else {
        return;
    };
    for (step, change) in steps.iter_mut().zip(changes).filter(|(step, _)| step.moves) {
        let turn = DQuat::from_axis_angle(shoulder_wrist_direction(step.is), change);
        step.is[1] = step.is[0] + turn * (step.is[1] - step.is[0]);
        step.carry = turn * step.carry;
    }
}

/// Rotates the bones about their length so that neither jumps: the upper arm in the space of the trunk, the forearm in
/// that of the upper arm.
pub(super) fn twist_arm_bones(source: &ArmSource, steps: &[ArmStep], turns: &mut [ArmJointTurns], frame_time: f64) {
    let stay = stay(steps);
    let more = MAX_ARM_TURN_SPEED * frame_time;
    // The forearm's twist is measured in the space of the upper arm, which must be final.
    twist_upper(source, steps, turns, &stay, frame_time);
    let seen = |turn: &ArmJointTurns| turn.old[0].inverse() * turn.old[1];
    let was: Vec<DQuat> = turns.iter().map(seen).collect();
    calm_forearm(&was, turns, &stay, frame_time);
    let turned = turns.iter().map(|turn| {
        let seen = turn.upper.inverse() * turn.forearm;
        let line = seen * turn.bone;
        FreelyTurnedRotation {
            line,
            start: DQuat::from_axis_angle(line, turn.twist) * seen,
        }
    });
    let turned: Vec<FreelyTurnedRotation> = turned.collect();
    if FreelyTurnedRotation::is_calm(&turned, more) {
        return;
    }
    let most = most(turns.len(), more, |before, n| {
        swivel_rotation_angle(was[before].inverse() * was[n])
    });
    let changes = ease_free_angles(&stay, frame_time, |n, angles| {
        let two = [&turned[n - 1], &turned[n]];
        [FreelyTurnedRotation::turned_excess_rotation(two, angles, most[n]), None]
    });
    for (turn, change) in turns.iter_mut().zip(changes.into_iter().flatten()) {
        turn.twist += change;
    }
}

/// Rotates upper arms about their length if they, or forearms in their space, would jump.
fn twist_upper(source: &ArmSource, steps: &[ArmStep], turns: &mut [ArmJointTurns], stay: &[bool], frame_time: f64) {
    let (trunk, more) = (source.trunks(steps.len()), MAX_ARM_TURN_SPEED * frame_time);
    let turned_arms = (0..steps.len()).map(|n| FreelyTurnedRotation {
        line: trunk[n] * arm_bone_directions(steps[n].is)[0],
        start: trunk[n] * turns[n].upper,
    });
    let turned: Vec<FreelyTurnedRotation> = turned_arms.collect();
    let circles = steps.iter().zip(turns.iter()).map(|(step, turn)| {
        let [upper, forearm] = arm_bone_directions(step.is).map(|bone| turn.upper.inverse() * bone);
        // As the upper arm turns, the forearm seen from it turns the other way.
        RotatingDirection {
            line: -upper,
            start: forearm,
        }
    });
    let circles: Vec<RotatingDirection> = circles.collect();
    if FreelyTurnedRotation::is_calm(&turned, more) && RotatingDirection::is_calm(&circles, more) {
        return;
    }
    let uppers = most(steps.len(), more, |a, b| {
        swivel_rotation_angle((trunk[a] * turns[a].old[0]).inverse() * trunk[b] * turns[b].old[0])
    });
    let fore = |n: usize| turns[n].old[0].inverse() * arm_bone_directions(steps[n].was)[1];
    let forearms = most(steps.len(), more, |a, b| fore(a).angle_between(fore(b)));
    let changes = ease_free_angles(stay, frame_time, |n, angles| {
        [
            FreelyTurnedRotation::turned_excess_rotation([&turned[n - 1], &turned[n]], angles, uppers[n]),
            RotatingDirection::direction_excess_rotation([&circles[n - 1], &circles[n]], angles, forearms[n]),
        ]
    });
    for (n, change) in changes.into_iter().flatten().enumerate().filter(|(n, _)| !stay[*n]) {
        let turn = DQuat::from_axis_angle(arm_bone_directions(steps[n].is)[0], change);
        turns[n].upper = (turn * turns[n].upper).normalize();
    }
}

/// Makes forearms rotate about their length as steadily as the source's; `was` holds the source's rotations in the
/// space of the upper arm.
fn calm_forearm(was: &[DQuat], turns: &mut [ArmJointTurns], stay: &[bool], frame_time: f64) {
    let Some(mark) = turns.first().map(|turn| turn.bone.any_orthonormal_vector()) else {
        return;
    };
    let own_turns = own_angle_changes(&swivels(
        was.iter()
            .zip(turns.iter())
            .map(|(was, turn)| (*was * turn.bone, *was * mark)),
    ));
    let values = swivels(turns.iter().map(|turn| {
        let seen = turn.upper.inverse() * turn.forearm;
        (seen * turn.bone, seen * mark)
    }));
    let trust = turns.iter().zip(stay).map(|(turn, stay)| match stay {
        // A frame that stays as it was captured outweighs any computed one.
        true => 2.0,
        false => (2.0 * turn.reliability).min(1.0),
    });
    let angles = TrustedAngles {
        trust: trust.collect(),
        values: values
            .iter()
            .zip(turns.iter())
            .map(|(value, turn)| value + turn.twist)
            .collect(),
        own: own_turns,
    };
    for (turn, change) in turns
        .iter_mut()
        .zip(angles.calming_corrections(frame_time).into_iter().flatten())
    {
        turn.twist += change;
    }
}

/// Returns the directions of upper arm and forearm.
fn arm_bone_directions([shoulder, elbow, wrist]: [DVec3; 3]) -> [DVec3; 2] {
    [elbow - shoulder, wrist - elbow].map(DVec3::normalize_or_zero)
}
