//! The turn of a forearm about itself, from the sides of its two wrist markers.

use glam::{DQuat, DVec3};

use super::UsedMarker;
use super::fit_labels::MarkerAttachment;
use crate::anatomy::{BodyAnatomy, BodyPart};
use crate::hand::{BodySide, HandFinger};
use crate::pose::ModelPose;

/// The least angle between the line of two wrist markers and the forearm for a turn to be read, as a sine.
const MIN_WRIST_ANGLE_SINE: f64 = 0.3;

/// The two markers of a wrist that lie on the sides of thumb and little finger, as indices of the used markers.
pub(super) struct WristMarkers {
    thumb: usize,
    little: usize,
    /// The forearm, and the unit vectors along it and towards the thumb's side, in its space.
    joint: usize,
    along: DVec3,
    thumbwards: DVec3,
}

impl WristMarkers {
    /// Returns the markers of a side's wrist; `None` if one is missing or never seen together with the other, or the
    /// hand has no fingers and so no side of the thumb.
    pub(super) fn find_wrist_markers(
        side: BodySide,
        used: &[UsedMarker],
        labels: &[Option<MarkerAttachment>],
        shown: &[Vec<Option<DVec3>>],
        rest: &ModelPose,
        anatomy: &BodyAnatomy,
    ) -> Option<Self> {
        let fore = anatomy.part_joint(BodyPart::Forearm(side))?;
        let find = |sign: f64| {
            used.iter().position(|marker| {
                marker.joint == fore && labels[marker.marker].is_some_and(|label| label.thumbwards * sign > 0.0)
            })
        };
        let (thumb, little) = (find(1.0)?, find(-1.0)?);
        // Two markers that are never seen together leave no line to read a turn from.
        let seen = |frame: &Vec<Option<DVec3>>, it: usize| frame[used[it].marker].is_some();
        if !shown.iter().any(|frame| seen(frame, thumb) && seen(frame, little)) {
            return None;
        }
        let back = rest.model_joint_rotation(fore).inverse();
        let along =
            rest.model_joint_position(anatomy.part_joint(BodyPart::Hand(side))?) - rest.model_joint_position(fore);
        Some(Self {
            thumb,
            little,
            joint: fore,
            along: back * along.try_normalize()?,
            thumbwards: back * thumbwards(side, rest, anatomy)?,
        })
    }

    /// Turns the places of the forearm's markers about it, together, until the line of the two points to the thumb's
    /// side.
    pub(super) fn turn_forearm_markers(&self, used: &mut [UsedMarker]) {
        let line = used[self.thumb].place - used[self.little].place;
        let across = line.reject_from_normalized(self.along);
        // A line almost along the forearm says nothing about its turn.
        if across.length() <= MIN_WRIST_ANGLE_SINE * line.length() {
            return;
        }
        let off = across.cross(self.thumbwards).dot(self.along);
        let turn = DQuat::from_axis_angle(self.along, off.atan2(across.dot(self.thumbwards)));
        // All markers of the forearm turn together: the fit finds their places only up to this turn.
        for it in used.iter_mut().filter(|marker| marker.joint == self.joint) {
            it.place = turn * it.place;
        }
    }
}

/// Returns the shift of a marker from the middle of its bone, in model space; `None` for a hand without fingers.
pub(super) fn marker_bone_shift(label: MarkerAttachment, rest: &ModelPose, anatomy: &BodyAnatomy) -> Option<DVec3> {
    let (BodyPart::Forearm(side) | BodyPart::Hand(side)) = label.on[0] else {
        return None;
    };
    let mut shift = DVec3::ZERO;
    if label.thumbwards != 0.0 {
        shift += label.thumbwards * thumbwards(side, rest, anatomy)?;
    }
    if label.raised != 0.0 {
        // Out of the back is against the palm's normal.
        shift -= label.raised * anatomy.palm_normal(side, rest)?;
    }
    Some(shift)
}

/// Returns the unit vector across a side's forearm towards the thumb's side, in model space.
fn thumbwards(side: BodySide, rest: &ModelPose, anatomy: &BodyAnatomy) -> Option<DVec3> {
    let part_place = |part| Some(rest.model_joint_position(anatomy.part_joint(part)?));
    let finger_bases = HandFinger::ALL_FINGERS.map(|finger| part_place(BodyPart::Finger(side, finger, 1)));
    let mut bases = finger_bases.into_iter().flatten();
    let first = bases.next()?;
    // A hand with one finger shows its thumb side by the thumb.
    let across = match bases.last() {
        Some(last) => first - last,
        None => part_place(BodyPart::Thumb(side, 1)).or(part_place(BodyPart::Thumb(side, 0)))? - first,
    };
    let along = (part_place(BodyPart::Hand(side))? - part_place(BodyPart::Forearm(side))?).try_normalize()?;
    // The side may lean along the forearm, which is no turn about it.
    across.reject_from_normalized(along).try_normalize()
}
