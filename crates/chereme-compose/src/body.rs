//! The signer's body during a sign: its directions, its places, its size.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, LocalPose, ModelPose};
use chereme_sign::SignComponent;
use chereme_sign::inventory::BodyLandmark;

use crate::recipe_settings::{RecipeHandPoint, SigningSpot, StraightLeg};
use crate::sources::BodyRelativePlace;
use crate::stroke::SignStroke;
use crate::units::{RecipeLength, mean_of_directions};
use crate::work::WorkingClip;

/// The number of frames from which a mean posture of the body is taken.
const BODY_POSTURE_SAMPLES: usize = 16;

/// The signer's own directions and middle over a whole piece of movement.
///
/// Up is the model's up; left and forward are horizontal, from the mean direction that the trunk faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SignerFrame {
    /// The middle between the shoulders.
    pub(crate) origin: DVec3,
    pub(crate) left: DVec3,
    pub(crate) forward: DVec3,
    /// The distance between the shoulders in metres.
    pub(crate) shoulders: f64,
    /// The arm's length from shoulder to wrist in metres.
    pub(crate) arm: f64,
}

impl SignerFrame {
    /// Returns the frame; `None` if the skeleton has no arm at all.
    ///
    /// A body whose front is unknown (one arm, one leg) faces forward in model space.
    pub(crate) fn from_mean_posture(work: &WorkingClip) -> Option<Self> {
        let arm_lengths = BodySide::BOTH_SIDES
            .into_iter()
            .filter_map(|side| arm_length(work, side));
        let arm = arm_lengths.reduce(f64::max)?;
        let (mut origin, mut forward, mut count) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        let mut shoulders = 0.0;
        for frame in sample_posture_frames(0..work.frames) {
            let mut pose = work.local_pose_at(frame);
            let model = ModelPose::from_local_pose(&work.skeleton, &pose);
            // Raised arms pull the collar bones, which would turn the front of the trunk.
            still_collars(work, &mut pose);
            let still = ModelPose::from_local_pose(&work.skeleton, &pose);
            let bodies = [&model, &still].map(|model| work.anatomy.body_frame(model));
            if let [Some(body), Some(still)] = bodies {
                origin += body.origin;
                forward += still.forward;
                shoulders = body.scale;
                count += 1.0;
            }
        }
        if count == 0.0 {
            // With one arm or one leg the shoulder stands for the middle, and the front is the model's.
            let upper = BodySide::BOTH_SIDES
                .into_iter()
                .find_map(|side| work.anatomy.arm_chain(side))?
                .upper;
            origin = mean_body_position(work, 0..work.frames, |model| Some(model.model_joint_position(upper)))?;
            (forward, shoulders, count) = (DVec3::Z, 0.7 * arm, 1.0);
        }
        // The front of a leaning body is level too.
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
    pub(crate) fn model_direction_of(&self, v: DVec3) -> DVec3 {
        self.left * v.x + DVec3::Y * v.y + self.forward * v.z
    }

    /// Converts a direction from model space to body space.
    pub(crate) fn to_body(self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.left), v.y, v.dot(self.forward))
    }

    /// Returns the sum of legs in model space, in metres.
    pub(crate) fn sum_path_legs(&self, legs: &[StraightLeg]) -> DVec3 {
        legs.iter().map(|leg| self.leg_in_model(leg)).sum()
    }

    /// Returns one leg in model space, in metres.
    pub(crate) fn leg_in_model(&self, leg: &StraightLeg) -> DVec3 {
        let direction = mean_of_directions(&leg.towards).unwrap_or(DVec3::ZERO);
        self.model_direction_of(direction) * leg.distance.length_in_metres(self.arm)
    }

    /// Returns the point at these distances to the left of the body's middle, above the floor, and in front of the
    /// body.
    pub(crate) fn body_point_at(&self, at: &[RecipeLength; 3]) -> DVec3 {
        let [left, up, forward] = at.map(|length| length.length_in_metres(self.arm));
        let level = self.left * left + self.forward * forward;
        DVec3::new(self.origin.x + level.x, up, self.origin.z + level.z)
    }

    /// Returns the position of `at` relative to the middle between the shoulders.
    pub(crate) fn relative_spatial_position(&self, at: DVec3) -> BodyRelativePlace {
        let offset = self.to_body(at - self.origin) / self.shoulders.max(1e-9);
        BodyRelativePlace {
            landmark: PLACEMENT_ORIGIN_LANDMARK.to_owned(),
            offset: offset.to_array(),
        }
    }

    /// Returns the place in model space for an acting hand; `None` if the skeleton has no such landmark.
    pub(crate) fn hand_place_in_model(
        &self,
        work: &WorkingClip,
        at: &BodyRelativePlace,
        hand: BodySide,
    ) -> Option<DVec3> {
        let landmark = BodyLandmark {
            name: at.landmark.clone(),
            offset: at.offset,
        };
        let (name, offset) = landmark.resolve_landmark(hand);
        let root = if name == PLACEMENT_ORIGIN_LANDMARK {
            self.origin
        } else {
            mean_body_position(work, 0..work.frames, |model| {
                work.anatomy.landmark_place_position(&work.skeleton, model, &name)
            })?
        };
        Some(root + self.model_direction_of(DVec3::from(offset)) * self.shoulders)
    }

    /// Returns the position of a spot for an acting hand; `place` is the answer for an inventory's value.
    pub(crate) fn hand_spot_position(
        &self,
        work: &WorkingClip,
        spot: &SigningSpot,
        place: Option<&BodyRelativePlace>,
        hand: BodySide,
    ) -> Option<DVec3> {
        // Pronouns are aimed at the chest, below the middle between the shoulders.
        let chest = self.origin - DVec3::Y * (0.35 * self.shoulders);
        Some(match spot {
            SigningSpot::Me => chest + self.forward * (0.3 * self.arm),
            SigningSpot::You => chest + self.forward * (0.85 * self.arm),
            SigningSpot::Towards(directions) => {
                let direction = self.model_direction_of(mean_of_directions(directions)?);
                // A direction beside or behind the signer is brought forward, where an arm can reach.
                chest + (direction + self.forward * 0.5).normalize_or(direction) * (0.85 * self.arm)
            }
            SigningSpot::Point(at) => self.body_point_at(at),
            SigningSpot::Value(_) => self.hand_place_in_model(work, place?, hand)?,
        })
    }
}

/// Gives collar bones their posture at rest, so that moved arms do not change the trunk's front; does nothing if the
/// rest posture is impossible for a body.
fn still_collars(work: &WorkingClip, pose: &mut LocalPose) {
    if !work.anatomy.is_posed() {
        return;
    }
    for side in BodySide::BOTH_SIDES {
        let arm = work.anatomy.arm_chain(side);
        if let Some(clavicle) = arm.and_then(|arm| arm.clavicle) {
            pose.rotations[clavicle] = work.skeleton.joint_at(clavicle).rest;
        }
    }
}

/// The landmark to which generated placements are relative: the middle between the shoulders.
pub(crate) const PLACEMENT_ORIGIN_LANDMARK: &str = "shoulders-middle";

/// Returns the length of an arm at rest from shoulder to wrist, in metres.
pub(crate) fn arm_length(work: &WorkingClip, side: BodySide) -> Option<f64> {
    let arm = work.anatomy.arm_chain(side)?;
    let rest = work.skeleton.rest_model_pose();
    let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| rest.model_joint_position(j));
    Some(shoulder.distance(elbow) + elbow.distance(wrist))
}

/// Returns the position of a point of the hand in one posture.
pub(crate) fn hand_point(
    work: &WorkingClip,
    model: &ModelPose,
    side: BodySide,
    point: RecipeHandPoint,
) -> Option<DVec3> {
    let wrist = work
        .anatomy
        .arm_chain(side)
        .map(|arm| model.model_joint_position(arm.hand));
    let point_name = match point {
        RecipeHandPoint::Wrist => return wrist,
        RecipeHandPoint::Palm => "palm".to_owned(),
        digit => format!("{}-tip", digit.hand_point_name()),
    };
    let name = format!("{}-{point_name}", side.body_side_name());
    work.anatomy
        .landmark_place_position(&work.skeleton, model, &name)
        .or(wrist)
}

/// Returns the mean position of a point of the hands while they hold their placements, or over the stroke if no
/// placement is annotated.
pub(crate) fn mean_point(work: &WorkingClip, sides: &[BodySide], point: RecipeHandPoint) -> Option<DVec3> {
    let each: Vec<DVec3> = sides
        .iter()
        .filter_map(|&side| {
            let stroke = || SignStroke::of_work(work).ok().map(|stroke| stroke.frames);
            let frames = held_placement_frames(work, side).or_else(stroke)?;
            mean_body_position(work, frames, |model| hand_point(work, model, side, point))
        })
        .collect();
    (!each.is_empty()).then(|| each.iter().sum::<DVec3>() / each.len() as f64)
}

/// Returns the frames in which a hand holds its placements, from the first to the last, if any is annotated.
pub(crate) fn held_placement_frames(work: &WorkingClip, side: BodySide) -> Option<std::ops::Range<usize>> {
    let placed_notes = work.held_note_indices(side, SignComponent::Placement);
    let span = |n: usize| work.rate.frames_in(work.notes[n].span);
    let (first, last) = (*placed_notes.first()?, *placed_notes.last()?);
    Some(span(first).start..span(last).end.min(work.frames))
}

/// Returns the mean of `at` over some frames; over all frames if the list is empty.
pub(crate) fn mean_body_position(
    work: &WorkingClip,
    frames: std::ops::Range<usize>,
    at: impl Fn(&ModelPose) -> Option<DVec3>,
) -> Option<DVec3> {
    let frames = if frames.is_empty() { 0..work.frames } else { frames };
    let points: Vec<DVec3> = sample_posture_frames(frames)
        .filter_map(|frame| at(&ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame))))
        .collect();
    (!points.is_empty()).then(|| points.iter().sum::<DVec3>() / points.len() as f64)
}

/// Returns up to [`BODY_POSTURE_SAMPLES`] frames spread evenly, the same ones backwards as forwards.
fn sample_posture_frames(frames: std::ops::Range<usize>) -> impl Iterator<Item = usize> {
    let (start, len) = (frames.start, frames.len());
    let count = len.min(BODY_POSTURE_SAMPLES);
    (0..count).map(move |n| {
        if count == len {
            start + n
        } else {
            // The middles of equal parts, which are the same from either end.
            start + (2 * n + 1) * len / (2 * count)
        }
    })
}
