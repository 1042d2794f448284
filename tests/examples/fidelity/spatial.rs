//! Hands placed elsewhere: what is left of the way, how hands are turned, how elbows move.

use chereme_compose::Made;
use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, ModelPose, Rate, Side};

use crate::Result;
use crate::capture::Capture;
use crate::shelf::Shelf;
use crate::table::markdown;

const HEAD: [&str; 9] = [
    "capture",
    "targets",
    "in reach",
    "residual in reach, mm",
    "hand turned, °",
    "elbow jumps, 10 cm",
    "elbow jumps, 25 cm",
    "largest, °",
    "clips out of reach, told",
];
/// A joint's turn between two frames at 120 Hz that is a jump, in degrees.
const JUMP: f64 = 5.0;

#[derive(Default)]
struct Found {
    targets: usize,
    in_reach: usize,
    residual: f64,
    turned: f64,
    jumps: [usize; 2],
    largest: f64,
    /// Clips with targets out of reach, and those of them whose report says so.
    beyond: [usize; 2],
    refused: usize,
}

pub fn tables(captures: &[Capture]) -> Result<String> {
    let mut all = Found::default();
    let mut rows = Vec::new();
    for capture in captures {
        let mut found = Found::default();
        let clip = capture.clip.resampled(Rate::new(120, 1)?);
        for way in ["left", "right", "up", "down"] {
            for centimetres in [10, 25] {
                one(capture, &clip, way, centimetres, &mut found)?;
            }
        }
        all.add(&found);
        rows.push(found.row(&capture.name));
    }
    rows.push(all.row("**all**"));
    Ok(format!(
        "### Hands placed 10 and 25 cm to the left, right, up and down\n\nAt 120 Hz. A target is in \
         reach where it is no farther from the shoulder than the arm is long. A jump is a turn of \
         upper arm or forearm by more than {JUMP}° from a frame to the next where the source turns \
         by less.\n\n{}",
        markdown(&HEAD, rows)
    ))
}

impl Found {
    fn add(&mut self, other: &Self) {
        self.targets += other.targets;
        self.in_reach += other.in_reach;
        self.residual = self.residual.max(other.residual);
        self.turned = self.turned.max(other.turned);
        self.largest = self.largest.max(other.largest);
        self.refused += other.refused;
        for n in 0..2 {
            self.jumps[n] += other.jumps[n];
            self.beyond[n] += other.beyond[n];
        }
    }

    fn row(&self, name: &str) -> Vec<String> {
        let refused = match self.refused {
            0 => String::new(),
            n => format!(", {n} refused"),
        };
        vec![
            name.to_owned(),
            self.targets.to_string(),
            format!("{:.0} %", 100.0 * self.in_reach as f64 / self.targets.max(1) as f64),
            format!("{:.2}", self.residual * 1000.0),
            format!("{:.4}", self.turned.to_degrees()),
            self.jumps[0].to_string(),
            self.jumps[1].to_string(),
            format!("{:.1}", self.largest.to_degrees()),
            format!("{} of {}{refused}", self.beyond[1], self.beyond[0]),
        ]
    }
}

fn one(capture: &Capture, clip: &Clip, way: &str, cm: usize, found: &mut Found) -> Result<()> {
    let sides = capture.sides();
    let hands = if sides.len() == 2 { "both" } else { sides[0].name() };
    let shelf = Shelf::new(clip.clone(), &capture.anatomy);
    let made = match shelf.make(&format!("place {hands} by {way} {cm}cm")) {
        Ok(made) => made,
        Err(_) => {
            found.refused += 1;
            return Ok(());
        }
    };
    let by = offset(capture, clip, way) * (cm as f64 / 100.0);
    let mut beyond = false;
    for side in sides {
        beyond |= arm(capture, clip, &made.clip, side, by, found);
        let (jumps, largest) = jumps(capture, clip, &made.clip, side);
        found.jumps[usize::from(cm > 10)] += jumps;
        found.largest = found.largest.max(largest);
    }
    if beyond {
        found.beyond[0] += 1;
        found.beyond[1] += usize::from(told(&made));
    }
    Ok(())
}

fn told(made: &Made) -> bool {
    let did = made.report.steps.iter().flat_map(|step| &step.did);
    did.into_iter().any(|did| did.contains("out of reach"))
}

/// Returns the signer's own direction in model space: the mean of where the trunk faces.
fn offset(capture: &Capture, clip: &Clip, way: &str) -> DVec3 {
    let frames = clip.frames();
    let count = frames.min(16);
    let forward: DVec3 = (0..count)
        .map(|n| if count == frames { n } else { (2 * n + 1) * frames / (2 * count) })
        .filter_map(|frame| capture.anatomy.body_frame(&clip.model_pose(frame)))
        .map(|body| body.forward)
        .sum();
    let forward = DVec3::new(forward.x, 0.0, forward.z).normalize_or(DVec3::Z);
    match way {
        "left" => DVec3::Y.cross(forward),
        "right" => forward.cross(DVec3::Y),
        "up" => DVec3::Y,
        _ => DVec3::NEG_Y,
    }
}

/// Measures one arm; tells whether a target was out of reach and not met.
fn arm(
    capture: &Capture,
    clip: &Clip,
    made: &Clip,
    side: Side,
    by: DVec3,
    found: &mut Found,
) -> bool {
    let Some(arm) = capture.anatomy.arm(side) else { return false };
    let mut beyond = false;
    for frame in 0..clip.frames() {
        let [was, is]: [ModelPose; 2] = [clip, made].map(|clip| clip.model_pose(frame));
        let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| was.position(j));
        let (first, second) = (shoulder.distance(elbow), elbow.distance(wrist));
        let distance = shoulder.distance(wrist + by);
        let residual = is.position(arm.hand).distance(wrist + by);
        found.targets += 1;
        if distance <= first + second && distance >= (first - second).abs() {
            found.in_reach += 1;
            found.residual = found.residual.max(residual);
        } else {
            beyond |= residual > 1e-3;
        }
        let turn = was.rotation(arm.hand).inverse() * is.rotation(arm.hand);
        let turned = 2.0 * turn.xyz().length().atan2(turn.w.abs());
        found.turned = found.turned.max(turned);
    }
    beyond
}

/// Returns how many jumps of upper arm and forearm are the operator's, and the largest in radians.
fn jumps(capture: &Capture, clip: &Clip, made: &Clip, side: Side) -> (usize, f64) {
    let Some(arm) = capture.anatomy.arm(side) else { return (0, 0.0) };
    let (mut count, mut largest): (usize, f64) = (0, 0.0);
    for joint in [arm.upper, arm.forearm] {
        let [was, is] = [clip, made].map(|clip| &clip.channel(joint).rotations);
        for frame in 1..clip.frames() {
            let source = was[frame - 1].angle_between(was[frame]);
            let turn = is[frame - 1].angle_between(is[frame]);
            if source <= JUMP.to_radians() {
                largest = largest.max(turn);
                count += usize::from(turn > JUMP.to_radians());
            }
        }
    }
    (count, largest)
}
