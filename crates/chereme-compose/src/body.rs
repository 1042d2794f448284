//! The signer's body during a sign: its directions, its places, its size.

use chereme_motion::glam::DVec3;
use chereme_motion::{ModelPose, Pose, Side};
use chereme_sign::Component;
use chereme_sign::inventory::Landmark;

use crate::recipe::{HandPoint, Leg, Spot};
use crate::sources::Spatial;
use crate::stroke::SignStroke;
use crate::units::{Length, towards};
use crate::work::Work;

/// The number of frames from which a mean posture of the body is taken.
const SAMPLES: usize = 16;

/// The signer's own directions and middle over a whole piece of movement.
///
/// Up is the model's up; left and forward are horizontal, from the mean direction that the trunk faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    /// The middle between the shoulders.
    pub(crate) origin: DVec3,
    pub(crate) left: DVec3,
    pub(crate) forward: DVec3,
    /// The distance between the shoulders in metres.
    pub(crate) shoulders: f64,
    /// The arm's length from shoulder to wrist in metres.
    pub(crate) arm: f64,
}

impl Frame {
    /// Returns the frame; `None` if the skeleton has no arm at all.
    ///
    /// A body whose front is unknown (one arm, one leg) faces forward in model space.
    pub(crate) fn of(work: &Work) -> Option<Self> {
        let arm = Side::BOTH
            .into_iter()
            .filter_map(|side| arm_length(work, side));
        let arm = arm.reduce(f64::max)?;
        let (mut origin, mut forward, mut count) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        let mut shoulders = 0.0;
        for frame in samples(0..work.frames) {
            let mut pose = work.pose(frame);
            let model = ModelPose::of(&work.skeleton, &pose);
            still_collars(work, &mut pose);
            let still = ModelPose::of(&work.skeleton, &pose);
            let bodies = [&model, &still].map(|model| work.anatomy.body_frame(model));
            if let [Some(body), Some(still)] = bodies {
                origin += body.origin;
                forward += still.forward;
                shoulders = body.scale;
                count += 1.0;
            }
        }
        if count == 0.0 {
            let upper = Side::BOTH
                .into_iter()
                .find_map(|side| work.anatomy.arm(side))?
                .upper;
            origin = mean(work, 0..work.frames, |model| Some(model.position(upper)))?;
            (forward, shoulders, count) = (DVec3::Z, 0.7 * arm, 1.0);
        }
        let level = DVec3::new(forward.x, 0.0, forward.z).normalize_or(DVec3::Z);
        Some(Self {
            origin: origin / count,
            left: DVec3::Y.cross(level),
            forward: level,
            shoulders,
            arm,
        })
    }

    /// Converts a direction from body space (left, up, forward) to model space.
    pub(crate) fn direction(&self, v: DVec3) -> DVec3 {
        self.left * v.x + DVec3::Y * v.y + self.forward * v.z
    }

    /// Converts a direction from model space to body space.
    pub(crate) fn to_body(self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.left), v.y, v.dot(self.forward))
    }

    /// Returns the sum of legs in model space, in metres.
    pub(crate) fn sum(&self, legs: &[Leg]) -> DVec3 {
        legs.iter().map(|leg| self.leg(leg)).sum()
    }

    /// Returns one leg in model space, in metres.
    pub(crate) fn leg(&self, leg: &Leg) -> DVec3 {
        let direction = towards(&leg.towards).unwrap_or(DVec3::ZERO);
        self.direction(direction) * leg.distance.metres(self.arm)
    }

    /// Returns the point at these distances to the left of the body's middle, above the floor, and in front of the
    /// body.
    pub(crate) fn point(&self, at: &[Length; 3]) -> DVec3 {
        let [left, up, forward] = at.map(|length| length.metres(self.arm));
        let level = self.left * left + self.forward * forward;
        DVec3::new(self.origin.x + level.x, up, self.origin.z + level.z)
    }

    /// Returns the position of `at` relative to the middle between the shoulders.
    pub(crate) fn spatial(&self, at: DVec3) -> Spatial {
        let offset = self.to_body(at - self.origin) / self.shoulders.max(1e-9);
        Spatial {
            landmark: ORIGIN.to_owned(),
            offset: offset.to_array(),
        }
    }

    /// Returns the place in model space for an acting hand; `None` if the skeleton has no such landmark.
    pub(crate) fn place(&self, work: &Work, at: &Spatial, hand: Side) -> Option<DVec3> {
        let landmark = Landmark {
            name: at.landmark.clone(),
            offset: at.offset,
        };
        let (name, offset) = landmark.resolve(hand);
        let root = if name == ORIGIN {
            self.origin
        } else {
            mean(work, 0..work.frames, |model| {
                work.anatomy.landmark(&work.skeleton, model, &name)
            })?
        };
        Some(root + self.direction(DVec3::from(offset)) * self.shoulders)
    }

    /// Returns the position of a spot for an acting hand; `place` is the answer for an inventory's value.
    pub(crate) fn spot(
        &self,
        work: &Work,
        spot: &Spot,
        place: Option<&Spatial>,
        hand: Side,
    ) -> Option<DVec3> {
        let chest = self.origin - DVec3::Y * (0.35 * self.shoulders);
        Some(match spot {
            Spot::Me => chest + self.forward * (0.3 * self.arm),
            Spot::You => chest + self.forward * (0.85 * self.arm),
            Spot::Towards(directions) => {
                let direction = self.direction(towards(directions)?);
                chest + (direction + self.forward * 0.5).normalize_or(direction) * (0.85 * self.arm)
            }
            Spot::Point(at) => self.point(at),
            Spot::Value(_) => self.place(work, place?, hand)?,
        })
    }
}

/// Gives collar bones their posture at rest, so that moved arms do not change the trunk's front; does nothing if the
/// rest posture is impossible for a body.
fn still_collars(work: &Work, pose: &mut Pose) {
    if !work.anatomy.is_posed() {
        return;
    }
    for side in Side::BOTH {
        let arm = work.anatomy.arm(side);
        if let Some(clavicle) = arm.and_then(|arm| arm.clavicle) {
            pose.rotations[clavicle] = work.skeleton.joint(clavicle).rest;
        }
    }
}

/// The landmark to which generated placements are relative: the middle between the shoulders.
pub(crate) const ORIGIN: &str = "shoulders-middle";

/// Returns the length of an arm at rest from shoulder to wrist, in metres.
pub(crate) fn arm_length(work: &Work, side: Side) -> Option<f64> {
    let arm = work.anatomy.arm(side)?;
    let rest = work.skeleton.rest_model_pose();
    let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| rest.position(j));
    Some(shoulder.distance(elbow) + elbow.distance(wrist))
}

/// Returns the position of a point of the hand in one posture.
pub(crate) fn hand_point(
    work: &Work,
    model: &ModelPose,
    side: Side,
    point: HandPoint,
) -> Option<DVec3> {
    let wrist = work.anatomy.arm(side).map(|arm| model.position(arm.hand));
    let name = match point {
        HandPoint::Wrist => return wrist,
        HandPoint::Palm => "palm".to_owned(),
        digit => format!("{}-tip", digit.name()),
    };
    let name = format!("{}-{name}", side.name());
    work.anatomy
        .landmark(&work.skeleton, model, &name)
        .or(wrist)
}

/// Returns the mean position of a point of the hands while they hold their placements, or over the stroke if no
/// placement is annotated.
pub(crate) fn mean_point(work: &Work, sides: &[Side], point: HandPoint) -> Option<DVec3> {
    let each: Vec<DVec3> = sides
        .iter()
        .filter_map(|&side| {
            let stroke = || SignStroke::of_work(work).ok().map(|stroke| stroke.frames);
            let frames = placed(work, side).or_else(stroke)?;
            mean(work, frames, |model| hand_point(work, model, side, point))
        })
        .collect();
    (!each.is_empty()).then(|| each.iter().sum::<DVec3>() / each.len() as f64)
}

/// Returns the frames in which a hand holds its placements, from the first to the last, if any is annotated.
pub(crate) fn placed(work: &Work, side: Side) -> Option<std::ops::Range<usize>> {
    let held = work.held(side, Component::Placement);
    let span = |n: usize| work.rate.frames_in(work.notes[n].span);
    let (first, last) = (*held.first()?, *held.last()?);
    Some(span(first).start..span(last).end.min(work.frames))
}

/// Returns the mean of `at` over some frames; over all frames if the list is empty.
pub(crate) fn mean(
    work: &Work,
    frames: std::ops::Range<usize>,
    at: impl Fn(&ModelPose) -> Option<DVec3>,
) -> Option<DVec3> {
    let frames = if frames.is_empty() {
        0..work.frames
    } else {
        frames
    };
    let found: Vec<DVec3> = samples(frames)
        .filter_map(|frame| at(&ModelPose::of(&work.skeleton, &work.pose(frame))))
        .collect();
    (!found.is_empty()).then(|| found.iter().sum::<DVec3>() / found.len() as f64)
}

/// Returns up to [`SAMPLES`] frames spread evenly, the same ones backwards as forwards.
fn samples(frames: std::ops::Range<usize>) -> impl Iterator<Item = usize> {
    let (start, len) = (frames.start, frames.len());
    let count = len.min(SAMPLES);
    (0..count).map(move |n| {
        if count == len {
            start + n
        } else {
            start + (2 * n + 1) * len / (2 * count)
        }
    })
}
