//! Movement of a living body besides its notation: sway of the trunk, head and eyes that follow the hands, blinks at
//! the boundaries of signs.
//!
//! The sway is a sum of waves that a seed determines: the same notation gives the same movement. Written acts of a part
//! replace it. Hands at the face move with the head, so that no contact is lost.

use std::f64::consts::TAU;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::interpolation::smooth_step;
use chereme_motion::{BodyPart, BodySide};
use chereme_sign::hamnosys::{BodyLanguage, NonmanualPart, NotatedSign};

use super::notation_nonmanual::{self, BodyBend};
use super::notation_plan::{SignPlan, SignSpan};
use super::notation_stage::StandingBody;
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;
use crate::outcome::GeneratedCurve;

/// The rotations of the body in each planned frame: written acts, and natural movement in between.
pub(crate) struct BodyLifeRotations {
    pub(crate) bents: Vec<BodyBend>,
    /// The direction of the eyes to the left and up in each frame, from -1 to 1.
    gaze: Vec<[f64; 2]>,
}

impl BodyLifeRotations {
    /// Plans the movement of the body that follows the goals of its hands.
    pub(crate) fn plan_body_life(
        body: &StandingBody,
        signs: &[&NotatedSign],
        plan: &SignPlan,
        language: &BodyLanguage,
        hands: [&HandGoalFrames<'_>; 2],
        rate: f64,
    ) -> Self {
        let total = hands[0].points.len();
        let (mut bents, busy) = notation_nonmanual::written_body_bends(signs, &plan.signs, language, rate, total);
        let after = hand_gaze_directions(body, hands, rate);
        let sway = language.life_sway.to_radians();
        let period = language.life_sway_time.max(0.5);
        let end = total.saturating_sub(1) as f64 / rate;
        // A left-handed signer sways like the mirror image of a right-handed one.
        let side = -plan.sides[0].side_sign();
        let mirror = DVec3::new(1.0, side, side);
        let waves = [1.0, 4.0]
            .map(|first| [0.0, 1.0, 2.0].map(|n| AperiodicWave::wave_from_seed(language.life_seed + (first + n))));
        for (frame, bent) in bents.iter_mut().enumerate() {
            let time = frame as f64 / rate;
            let busy = busy[frame];
            let moves = smooth_step(time / tuned().life.starts) * smooth_step((end - time) / tuned().life.starts);
            let [trunk, head] =
                waves.map(|waves| DVec3::from(waves.map(|wave| wave.wave_value_at(time / period))) * mirror);
            let trunk = trunk * DVec3::from(tuned().life.sway) * (sway * moves);
            let head = head * (tuned().life.nod * sway * moves);
            bent.trunk += trunk * (1.0 - busy.trunk);
            let turned = (after[frame] * language.life_head).clamp_length_max(tuned().life.after) * moves;
            bent.head += (head + turned - trunk * 0.5) * (1.0 - busy.head);
        }
        let gaze = after.iter().map(|after| {
            let amount = |angle: f64| (angle * language.life_gaze / tuned().life.eyes).clamp(-1.0, 1.0);
            [amount(after.y), amount(-after.x)]
        });
        let gaze = gaze.collect();
        Self { bents, gaze }
    }

    /// Moves hands that are at the head with it, and keeps hands that touch something in place while a shoulder is
    /// raised or brought forward.
    pub(crate) fn carry_hands_with_head(&self, body: &StandingBody, side: BodySide, wanted: &mut HandGoalFrames<'_>) {
        let touches = wanted.points.iter_mut().zip(&wanted.touch);
        for ((point, touch), bent) in touches.zip(&self.bents) {
            if *touch > 0.0 {
                *point -= bent.moved_shoulder(body, side) * smooth_step(*touch);
            }
        }
        let Some((middle, height)) = head_middle_and_height(body) else {
            return;
        };
        for (point, bent) in wanted.points.iter_mut().zip(&self.bents) {
            let far = point.distance(middle) / height;
            let share = (tuned().life.at_head[1] - far) / (tuned().life.at_head[1] - tuned().life.at_head[0]);
            if share <= 0.0 || !bent.turns_head() {
                continue;
            }
            *point = point.lerp(bent.with_head(body, *point), smooth_step(share));
        }
    }

    /// Returns the curves of eyes and lids in stretched time; `frames` are the planned frames. Written acts of either
    /// replace them.
    pub(crate) fn eye_and_lid_curves(
        &self,
        signs: &[&NotatedSign],
        spans: &[SignSpan],
        language: &BodyLanguage,
        rate: f64,
        frames: &[(usize, f64)],
    ) -> Vec<GeneratedCurve> {
        let acts = |part: NonmanualPart| {
            let mut all = signs.iter().flat_map(|sign| sign.nonmanual.acts_by_tier());
            all.any(|(_, act)| act.part == part)
        };
        let mut curves = Vec::new();
        if language.life_blink > 0.0 && !acts(NonmanualPart::Lids) {
            let values = blinks(spans, language, rate, frames.len());
            curves.push(GeneratedCurve {
                name: "lids.CB".to_owned(),
                values,
            });
        }
        if language.life_gaze > 0.0 && !acts(NonmanualPart::Gaze) {
            for (name, axis, sign) in [("LE", 0, 1.0), ("RI", 0, -1.0), ("DN", 1, -1.0)] {
                let values = frames.iter().map(|&(frame, _)| {
                    let gaze = self.gaze[frame.min(self.gaze.len() - 1)];
                    (gaze[axis] * sign).max(0.0)
                });
                let values: Vec<f64> = values.collect();
                if values.iter().any(|value| *value > 0.02) {
                    let name = format!("gaze.{name}");
                    curves.push(GeneratedCurve { name, values });
                }
            }
        }
        curves
    }
}

/// Returns the middle of the head and its height in metres, on the standing body.
fn head_middle_and_height(body: &StandingBody) -> Option<(DVec3, f64)> {
    let height = body.anatomy.anatomy_measures()?.head.max(1e-3);
    let nose = body.body_landmark_position("nose")?;
    body.anatomy.part_joint(BodyPart::Head)?;
    Some((nose - body.forward * (0.4 * height), height))
}

/// Returns the directions of the hands' goals from the head in each frame, relative to straight ahead, as rotation
/// vectors (left, up, forward; rad); hanging hands do not count.
fn hand_gaze_directions(body: &StandingBody, hands: [&HandGoalFrames<'_>; 2], rate: f64) -> Vec<DVec3> {
    let total = hands[0].points.len();
    let Some((middle, height)) = head_middle_and_height(body) else {
        return vec![DVec3::ZERO; total];
    };
    let low = body.shoulder_middle().y - 0.75 * body.arm;
    let frame_offsets = (0..total).map(|frame| {
        let (mut sum, mut weight, mut away) = (DVec3::ZERO, 0.0, 1.0_f64);
        for hand in hands {
            let hand_point = hand.points[frame];
            let far = hand_point.distance(middle) / height;
            away = away.min(smooth_step(
                (far - tuned().life.away[0]) / (tuned().life.away[1] - tuned().life.away[0]),
            ));
            let share = smooth_step((hand_point.y - low) / (0.2 * body.arm));
            sum += (hand_point - middle) * share;
            weight += share;
        }
        if weight < 1e-6 {
            return DVec3::ZERO;
        }
        let direction = sum / weight;
        let ahead = direction.dot(body.forward).max(0.12 * body.arm);
        let down = (-direction.y).atan2(ahead.hypot(direction.dot(body.left)));
        let aside = direction.dot(body.left).atan2(ahead);
        DVec3::new(down, aside, 0.0) * (weight.min(1.0) * away)
    });
    let offset_vectors: Vec<DVec3> = frame_offsets.collect();
    let near = ((0.5 * tuned().life.slowly * rate) as usize).max(1);
    averaged(&averaged(&offset_vectors, near), near)
}

/// Returns running averages over `near` frames before and after.
fn averaged(own: &[DVec3], near: usize) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; own.len() + 1];
    for (n, value) in own.iter().enumerate() {
        sums[n + 1] = sums[n] + *value;
    }
    let each = (0..own.len()).map(|n| {
        let (from, to) = (n.saturating_sub(near), (n + near + 1).min(own.len()));
        (sums[to] - sums[from]) / (to - from) as f64
    });
    each.collect()
}

/// A wave without a visible period.
#[derive(Clone, Copy)]
struct AperiodicWave {
    /// The phases of its parts, in periods.
    phases: [f64; 3],
}

impl AperiodicWave {
    /// Returns the wave for a seed.
    fn wave_from_seed(seed: f64) -> Self {
        let phase = |n: f64| (seed * 12.9898 + n * 78.233).sin() * 43_758.545_3;
        Self {
            phases: [1.0, 2.0, 3.0].map(|n| phase(n).fract()),
        }
    }

    /// Returns its value, from -1 to 1; `turns` is the time in periods.
    fn wave_value_at(&self, turns: f64) -> f64 {
        let one = |speed: f64, phase: f64| (TAU * (turns * speed + phase)).sin();
        let [slow, middle, fast] = self.phases;
        0.6 * one(1.0, slow) + 0.3 * one(1.73, middle) + 0.1 * one(3.1, fast)
    }
}

/// Returns the closure of the lids in each frame, from 0 to 1: they blink at the beginning and the end of each sign,
/// and in between if the sign is long.
fn blinks(spans: &[SignSpan], language: &BodyLanguage, rate: f64, total: usize) -> Vec<f64> {
    let mut values = vec![0.0_f64; total];
    let mut last = f64::NEG_INFINITY;
    let mut blink = |at: f64| {
        if at - last < tuned().life.apart {
            return;
        }
        last = at;
        let [close, open] = tuned().life.blink;
        let frames = ((at - close) * rate).max(0.0) as usize..((at + open) * rate) as usize + 1;
        let near = values.iter_mut().enumerate();
        for (frame, value) in near.take(frames.end).skip(frames.start) {
            let off = frame as f64 / rate - at;
            let share = 1.0 - if off < 0.0 { -off / close } else { off / open };
            *value = value.max(smooth_step(share));
        }
    };
    for span in spans {
        let (from, to) = (span.from - 0.12, span.to + 0.06);
        let between = ((to - from) / language.life_blink).ceil().max(1.0);
        for n in 0..=between as usize {
            blink(from + (to - from) * n as f64 / between);
        }
    }
    values
}

impl BodyBend {
    /// Returns whether the head is rotated on the trunk.
    fn turns_head(&self) -> bool {
        self.head != DVec3::ZERO || self.neck != DVec3::ZERO
    }

    /// Returns the displacement (m) of a shoulder on the trunk; the whole arm moves with it.
    fn moved_shoulder(&self, body: &StandingBody, side: BodySide) -> DVec3 {
        let by = self.collar_bone(body, side);
        let joints = [BodyPart::Clavicle(side), BodyPart::UpperArm(side)];
        match joints.map(|part| body.anatomy.part_joint(part)) {
            [Some(collar_bone), Some(shoulder)] if by != DQuat::IDENTITY => {
                let bone = body.model.model_joint_position(shoulder) - body.model.model_joint_position(collar_bone);
                by * bone - bone
            }
            _ => DVec3::ZERO,
        }
    }

    /// Returns the new position of a point on the standing body's head after the head's rotation on the trunk.
    fn with_head(&self, body: &StandingBody, at: DVec3) -> DVec3 {
        let turned = |part: BodyPart, by: DVec3, at: DVec3| match body.anatomy.part_joint(part) {
            Some(joint) => {
                let pivot = body.model.model_joint_position(joint);
                pivot + DQuat::from_scaled_axis(body.body_to_model_direction(by)) * (at - pivot)
            }
            None => at,
        };
        let head_point = turned(BodyPart::Head, self.head, at);
        turned(BodyPart::Neck, self.neck, head_point)
    }
}
