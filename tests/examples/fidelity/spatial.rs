//! Table for hands placed elsewhere: the rest of the path, the rotation of hands, the movement of elbows.

use chereme_compose::GeneratedMovement;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{ArmChain, BodySide, Clip, FrameRate, ModelPose};

use crate::Result;
use crate::capture::Capture;
use crate::shelf::Shelf;
use crate::table::markdown;

const HEAD: [&str; 11] = [
    "capture",
    "targets",
    "in reach",
    "residual well inside, mm",
    "residual, mm",
    "hand turned, °",
    "elbow jumps, 10 cm",
    "elbow jumps, 25 cm",
    "the wrist asks for",
    "largest other, °",
    "clips out of reach, told",
];
/// A joint jumps if it turns by this many degrees more than in the source from one frame to the next.
const JUMP: f64 = 5.0;
/// A rotation between two frames of the source, in degrees, that no arm can make: the capture is cut there.
const CUT: f64 = 15.0;
/// The longest soft end of the reach.
const SOFT: f64 = 0.08;

#[derive(Default)]
struct Found {
    targets: usize,
    in_reach: usize,
    /// Largest residuals: of targets nearer than the longest soft end, and of all in reach.
    residual: [f64; 2],
    turned: f64,
    /// Jumps with hands moved by 10 and by 25 cm, and those that any arm must make for such a path of the wrist.
    jumps: [usize; 2],
    asked: usize,
    largest: f64,
    /// Clips with targets out of reach, and those of them whose report says so.
    beyond: [usize; 2],
    refused: usize,
    /// Clips with most targets out of reach sideways, so that their place is unknown.
    unclear: usize,
}

pub(crate) fn tables(captures: &[Capture]) -> Result<String> {
    let mut all = Found::default();
    let mut rows = Vec::new();
    for capture in captures {
        let mut found = Found::default();
        let clip = capture.clip.resample_clip(FrameRate::new(120, 1)?);
        for direction in ["left", "right", "up", "down"] {
            for centimetres in [10, 25] {
                one(capture, &clip, direction, centimetres, &mut found)?;
            }
        }
        all.add(&found);
        rows.push(found.row(&capture.name));
    }
    rows.push(all.row("**all**"));
    Ok(format!(
        "### Hands placed 10 and 25 cm to the left, right, up and down\n\nAt 120 Hz. A target is in \
         reach where it is no farther from the shoulder than the arm is long; residuals are those of \
         targets that lie more than 8 % of its length, the longest soft end, inside the arm's reach, \
         far and near, and of all in reach. A \
         jump is a turn of upper arm or forearm from a frame to the next that is more than {JUMP}° \
         larger than the source's, where nothing of the source's arm turns by more than {CUT}°. Those \
         that the wrist asks for are counted apart: where it is fixed, an elbow's angle changes by \
         that much already, or the circles on which the elbow can be lie that far apart.\n\n{}",
        markdown(&HEAD, rows)
    ))
}

impl Found {
    fn add(&mut self, other: &Self) {
        self.targets += other.targets;
        self.in_reach += other.in_reach;
        self.asked += other.asked;
        self.turned = self.turned.max(other.turned);
        self.largest = self.largest.max(other.largest);
        self.refused += other.refused;
        self.unclear += other.unclear;
        for n in 0..2 {
            self.residual[n] = self.residual[n].max(other.residual[n]);
            self.jumps[n] += other.jumps[n];
            self.beyond[n] += other.beyond[n];
        }
    }

    fn row(&self, name: &str) -> Vec<String> {
        let mut beyond = format!("{} of {}", self.beyond[1], self.beyond[0]);
        for (count, what) in [(self.refused, "refused"), (self.unclear, "not measured")] {
            if count > 0 {
                beyond.push_str(&format!(", {count} {what}"));
            }
        }
        vec![
            name.to_owned(),
            self.targets.to_string(),
            format!("{:.0} %", 100.0 * self.in_reach as f64 / self.targets.max(1) as f64),
            format!("{:.2}", self.residual[0] * 1000.0),
            format!("{:.2}", self.residual[1] * 1000.0),
            format!("{:.4}", self.turned.to_degrees()),
            self.jumps[0].to_string(),
            self.jumps[1].to_string(),
            self.asked.to_string(),
            format!("{:.1}", self.largest.to_degrees()),
            beyond,
        ]
    }
}

fn one(capture: &Capture, clip: &Clip, direction: &str, cm: usize, found: &mut Found) -> Result<()> {
    let sides = capture.sides();
    let hands = if sides.len() == 2 {
        "both"
    } else {
        sides[0].body_side_name()
    };
    let shelf = Shelf::new(clip.clone(), &capture.anatomy);
    let made = match shelf.make(&format!("place {hands} by {direction} {cm}cm")) {
        Ok(made) => made,
        Err(_) => {
            found.refused += 1;
            return Ok(());
        }
    };
    let asked = cm as f64 / 100.0;
    let by = match direction {
        "up" => DVec3::Y * asked,
        "down" => DVec3::NEG_Y * asked,
        _ => offset(capture, clip, &made.clip),
    };
    if (by.length() - asked).abs() > 1e-6 {
        found.unclear += 1;
        return Ok(());
    }
    let mut beyond = false;
    for side in sides {
        beyond |= arm(capture, clip, &made.clip, side, by, found);
        jumps(capture, clip, &made.clip, side, found, usize::from(cm > 10));
    }
    if beyond {
        found.beyond[0] += 1;
        found.beyond[1] += usize::from(is_reported(&made));
    }
    Ok(())
}

fn is_reported(made: &GeneratedMovement) -> bool {
    let did = made.report.steps.iter().flat_map(|step| &step.did);
    did.into_iter().any(|did| did.contains("out of reach"))
}

/// Returns the median displacement of the wrists over all frames and hands, coordinate by coordinate.
fn offset(capture: &Capture, clip: &Clip, made: &Clip) -> DVec3 {
    let hands = capture
        .sides()
        .into_iter()
        .filter_map(|side| capture.anatomy.arm_chain(side));
    let mut moved: Vec<DVec3> = Vec::new();
    for arm in hands {
        let [was, is] = [clip, made].map(|clip| clip.joint_path(arm.hand));
        moved.extend(was.iter().zip(&is).map(|(was, is)| *is - *was));
    }
    let middle = |axis: usize| {
        let mut values: Vec<f64> = moved.iter().map(|displacement| displacement[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values[values.len() / 2]
    };
    DVec3::new(middle(0), middle(1), middle(2))
}

/// Measures one arm; returns whether a target was out of reach and missed.
fn arm(capture: &Capture, clip: &Clip, made: &Clip, side: BodySide, by: DVec3, found: &mut Found) -> bool {
    let Some(arm) = capture.anatomy.arm_chain(side) else {
        return false;
    };
    let mut beyond = false;
    for frame in 0..clip.clip_frame_count() {
        let [was, is]: [ModelPose; 2] = [clip, made].map(|clip| clip.model_pose(frame));
        let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| was.model_joint_position(j));
        let (first, second) = (shoulder.distance(elbow), elbow.distance(wrist));
        let distance = shoulder.distance(wrist + by);
        let residual = is.model_joint_position(arm.hand).distance(wrist + by);
        found.targets += 1;
        if distance <= first + second && distance >= (first - second).abs() {
            found.in_reach += 1;
            found.residual[1] = found.residual[1].max(residual);
            let (whole, folded) = (first + second, (first - second).abs());
            if distance <= (1.0 - SOFT) * whole && distance >= folded + SOFT * whole {
                found.residual[0] = found.residual[0].max(residual);
            }
        } else {
            beyond |= residual > 1e-3;
        }
        let turn = was.model_joint_rotation(arm.hand).inverse() * is.model_joint_rotation(arm.hand);
        let turned = 2.0 * turn.xyz().length().atan2(turn.w.abs());
        found.turned = found.turned.max(turned);
    }
    beyond
}

/// Counts the jumps of upper arm and forearm that the operator causes.
///
/// The upper arm is measured in the space of the trunk, the forearm in that of the upper arm.
fn jumps(capture: &Capture, clip: &Clip, made: &Clip, side: BodySide, found: &mut Found, far: usize) {
    let Some(arm) = capture.anatomy.arm_chain(side) else {
        return;
    };
    let skeleton = clip.clip_skeleton();
    let top = skeleton.joint_parent(arm.clavicle.unwrap_or(arm.upper));
    let joints = [(arm.upper, top), (arm.forearm, Some(arm.upper))];
    let whole = turns(clip, arm.upper, None);
    let forearm = turns(clip, arm.forearm, Some(arm.upper));
    let fastest: Vec<f64> = whole.into_iter().zip(forearm).map(|(a, b)| a.max(b)).collect();
    for (joint, base) in joints {
        let [was, is] = [clip, made].map(|clip| turns(clip, joint, base));
        for (frame, (source, turn)) in was.into_iter().zip(is).enumerate() {
            if fastest[frame] > CUT.to_radians() {
                continue;
            }
            let jumps = turn - source > JUMP.to_radians();
            if jumps {
                let [before, after] = [frame, frame + 1].map(|frame| Bend::of(made, &arm, frame));
                let least = match joint == arm.upper {
                    true => before.upper_to(&after),
                    false => (after.elbow - before.elbow).abs(),
                };
                if least - source > JUMP.to_radians() {
                    found.asked += 1;
                    continue;
                }
            }
            found.largest = found.largest.max(turn - source);
            found.jumps[far] += usize::from(jumps);
        }
    }
}

/// The bend of an arm: the line from shoulder to wrist, and the angles of shoulder and elbow to it in the plane of the
/// arm.
///
/// These follow from the position of the wrist; the elbow may be anywhere on a circle about the line.
struct Bend {
    line: DVec3,
    shoulder: f64,
    elbow: f64,
}

impl Bend {
    fn of(clip: &Clip, arm: &ArmChain, frame: usize) -> Self {
        let model = clip.model_pose(frame);
        let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| model.model_joint_position(j));
        let (line, upper) = (wrist - shoulder, elbow - shoulder);
        Self {
            line,
            shoulder: line.angle_between(upper),
            elbow: upper.angle_between(wrist - elbow),
        }
    }

    /// Returns the least rotation of an upper arm from one bend to the other, for any position of the elbow on its circle:
    /// the angle between the circles, seen from the shoulder.
    fn upper_to(&self, after: &Self) -> f64 {
        let apart = self.line.angle_between(after.line);
        let within = (self.shoulder - after.shoulder).abs() - apart;
        within.max(apart - self.shoulder - after.shoulder).max(0.0)
    }
}

/// Returns the rotation of a joint from each frame to the next, in the space of a joint above it.
fn turns(clip: &Clip, joint: usize, base: Option<usize>) -> Vec<f64> {
    let chain: Vec<usize> = clip
        .clip_skeleton()
        .joint_ancestors(joint)
        .take_while(|&above| Some(above) != base)
        .collect();
    let turned: Vec<DQuat> = (0..clip.clip_frame_count())
        .map(|frame| {
            let local = |&joint: &usize| clip.joint_channel(joint).rotations[frame];
            chain.iter().rev().map(local).product()
        })
        .collect();
    turned
        .windows(2)
        .map(|two| {
            let turn = two[0].inverse() * two[1];
            2.0 * turn.xyz().length().atan2(turn.w.abs())
        })
        .collect()
}
