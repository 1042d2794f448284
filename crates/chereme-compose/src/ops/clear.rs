//! Keeps placed hands out of head and trunk.

use std::ops::Range;

use chereme_motion::glam::DVec3;
use chereme_motion::{ModelPose, Side};

use crate::arm;
use crate::contact::{BLEND, blended};
use crate::notation::skull::Skull;
use crate::notation::stage::Torso;
use crate::recipe::Solver;
use crate::work::{Columns, Group, Work};

/// The depth in metres that a joint of a finger may have in a body without skin.
const SKIN: f64 = 0.01;
/// The largest number of rounds in which hands are moved out of the body; the report describes any remaining depth.
const ROUNDS: usize = 4;

/// The displacement that kept a hand out of the body.
pub(crate) struct Cleared {
    /// The displacement in each frame.
    displacements: Vec<DVec3>,
    /// The remaining depth in the body, in metres.
    deep: f64,
}

impl Cleared {
    /// Returns the largest displacement in these frames.
    pub(crate) fn at(&self, frames: &Range<usize>) -> f64 {
        let displacements = self.displacements.get(frames.clone()).unwrap_or_default();
        displacements
            .iter()
            .map(|displacement| displacement.length())
            .fold(0.0, f64::max)
    }

    pub(crate) fn describe(&self, work: &Work, side: Side, frames: &Range<usize>) -> String {
        let (side, cm) = (side.name(), |metres: f64| metres * 100.0);
        let moved = self
            .displacements
            .iter()
            .map(|displacement| displacement.length());
        let count = moved
            .clone()
            .filter(|displacement| *displacement > 1e-4)
            .count();
        let most = moved.fold(0.0, f64::max);
        let mut text = format!(
            "the {side} hand is kept out of head and trunk: moved by up to {:.1} cm in {count} {}",
            cm(most),
            if count == 1 { "frame" } else { "frames" }
        );
        if self.at(frames) > SKIN {
            let at = work.rate.instant(frames.start);
            text += &format!(
                ", at {at} {:.1} cm away from its goal, as the hand would enter the body there; turn it with `orient`",
                cm(self.at(frames))
            );
        }
        if self.deep > SKIN {
            text += &format!(", and still {:.1} cm in the body", cm(self.deep));
        }
        text
    }
}

/// Moves the wrist of `side` out if the hand is deeper in head or trunk than before; returns `None` if the hand
/// stays outside.
pub(crate) fn clear(work: &mut Work, before: &Work, side: Side, solver: Solver) -> Option<Cleared> {
    let hand = work.anatomy.arm(side)?.hand;
    let was = Depths::of(before, side);
    let blend = (BLEND / work.rate.frame_time()).round() as usize;
    let mut all = vec![DVec3::ZERO; work.frames];
    let mut deep = 0.0;
    for round in 0..=ROUNDS {
        let now = Depths::of(work, side);
        let displacements: Vec<Option<DVec3>> = now
            .0
            .iter()
            .zip(&was.0)
            .map(|(now, was)| {
                let allowed = was.length().max(SKIN);
                let over = now.length() - allowed;
                (over > 1e-4).then(|| now.normalize_or_zero() * over)
            })
            .collect();
        deep = now
            .0
            .iter()
            .zip(&was.0)
            .map(|(now, was)| {
                if now.length() > was.length().max(SKIN) {
                    now.length()
                } else {
                    0.0
                }
            })
            .fold(0.0, f64::max);
        if round == ROUNDS || displacements.iter().all(Option::is_none) {
            break;
        }
        let displacements = blended(&displacements, blend);
        let columns = Columns::of(work, [hand]);
        let wrists = columns.positions(hand).iter().zip(&displacements);
        let targets: Vec<DVec3> = wrists
            .map(|(at, displacement)| *at + *displacement)
            .collect();
        arm::move_wrist(work, side, &columns, &targets, None, solver)?;
        for (sum, displacement) in all.iter_mut().zip(displacements) {
            *sum += displacement;
        }
    }
    if all.iter().all(|displacement| *displacement == DVec3::ZERO) {
        return None;
    }
    work.changed([Group::Arm(side)], "kept out of the body");
    Some(Cleared {
        displacements: all,
        deep,
    })
}

/// For each frame the longest vector by which a joint or tip of a hand would leave the body.
struct Depths(Vec<DVec3>);

impl Depths {
    fn of(work: &Work, side: Side) -> Self {
        let mut joints = work.anatomy.fingers(side);
        joints.extend(work.anatomy.arm(side).map(|arm| arm.hand));
        let columns = Columns::of(work, joints.iter().copied());
        let mut displacements = Vec::with_capacity(work.frames);
        for frame in 0..work.frames {
            let solids = Solids::of(work, frame);
            let mut longest = DVec3::ZERO;
            for &joint in &joints {
                let (at, turned) = (
                    columns.positions(joint)[frame],
                    columns.rotations(joint)[frame],
                );
                let tip = work.skeleton.joint(joint).tip.map(|tip| at + turned * tip);
                for point in [Some(at), tip].into_iter().flatten() {
                    let offset = solids.offset_out(point);
                    if offset.length_squared() > longest.length_squared() {
                        longest = offset;
                    }
                }
            }
            displacements.push(longest);
        }
        Self(displacements)
    }
}

/// Head and trunk in one frame.
struct Solids {
    trunk: Torso,
    head: Option<Skull>,
}

impl Solids {
    fn of(work: &Work, frame: usize) -> Self {
        let pose = work.pose(frame);
        let model = ModelPose::of(&work.skeleton, &pose);
        let measures = work.anatomy.measures();
        let body = work.anatomy.body_frame(&model);
        let trunk = Torso::of(
            body.filter(|_| measures.is_some()),
            measures.map_or(0.5, |it| it.trunk),
        );
        Self {
            trunk,
            head: Skull::of(&work.anatomy, &work.skeleton, &model),
        }
    }

    fn offset_out(&self, at: DVec3) -> DVec3 {
        let trunk = self.trunk.offset_out(at, 0.0);
        let head = self
            .head
            .as_ref()
            .map_or(DVec3::ZERO, |head| head.offset_out(at));
        if head.length_squared() > trunk.length_squared() {
            head
        } else {
            trunk
        }
    }
}
