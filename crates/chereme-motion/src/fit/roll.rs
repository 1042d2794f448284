//! The turn of a forearm about itself, from the sides of its two wrist markers.

use glam::{DQuat, DVec3};

use super::Used;
use super::labels::Attachment;
use crate::anatomy::{Anatomy, Part};
use crate::hand::{Finger, Side};
use crate::pose::ModelPose;

/// The least angle between the line of two wrist markers and the forearm for a turn to be read, as a sine.
const ACROSS: f64 = 0.3;

/// The two markers of a wrist that lie on the sides of thumb and little finger, as indices of the used markers.
pub(super) struct Wrist {
    thumb: usize,
    little: usize,
    /// The forearm, and the unit vectors along it and towards the thumb's side, in its space.
    joint: usize,
    along: DVec3,
    thumbwards: DVec3,
}

impl Wrist {
    /// Returns the markers of a side's wrist; `None` if one is missing or never seen together with the other, or the
    /// hand has no fingers and so no side of the thumb.
    pub(super) fn of(
        side: Side,
        used: &[Used],
        labels: &[Option<Attachment>],
        shown: &[Vec<Option<DVec3>>],
        rest: &ModelPose,
        anatomy: &Anatomy,
    ) -> Option<Self> {
        let fore = anatomy.joint(Part::Forearm(side))?;
        let find = |sign: f64| {
            used.iter().position(|it| {
                it.joint == fore
                    && labels[it.marker].is_some_and(|label| label.thumbwards * sign > 0.0)
            })
        };
        let (thumb, little) = (find(1.0)?, find(-1.0)?);
        let seen = |frame: &Vec<Option<DVec3>>, it: usize| frame[used[it].marker].is_some();
        if !shown
            .iter()
            .any(|frame| seen(frame, thumb) && seen(frame, little))
        {
            return None;
        }
        let back = rest.rotation(fore).inverse();
        let along = rest.position(anatomy.joint(Part::Hand(side))?) - rest.position(fore);
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
    pub(super) fn turn(&self, used: &mut [Used]) {
        let line = used[self.thumb].place - used[self.little].place;
        let across = line.reject_from_normalized(self.along);
        if across.length() <= ACROSS * line.length() {
            return;
        }
        let off = across.cross(self.thumbwards).dot(self.along);
        let turn = DQuat::from_axis_angle(self.along, off.atan2(across.dot(self.thumbwards)));
        for it in used.iter_mut().filter(|it| it.joint == self.joint) {
            it.place = turn * it.place;
        }
    }
}

/// Returns the shift of a marker from the middle of its bone, in model space; `None` for a hand without fingers.
pub(super) fn beside(label: Attachment, rest: &ModelPose, anatomy: &Anatomy) -> Option<DVec3> {
    let (Part::Forearm(side) | Part::Hand(side)) = label.on[0] else {
        return None;
    };
    let mut shift = DVec3::ZERO;
    if label.thumbwards != 0.0 {
        shift += label.thumbwards * thumbwards(side, rest, anatomy)?;
    }
    if label.raised != 0.0 {
        shift -= label.raised * anatomy.palm_normal(side, rest)?;
    }
    Some(shift)
}

/// Returns the unit vector across a side's forearm towards the thumb's side, in model space.
fn thumbwards(side: Side, rest: &ModelPose, anatomy: &Anatomy) -> Option<DVec3> {
    let at = |part| Some(rest.position(anatomy.joint(part)?));
    let bases = Finger::ALL.map(|finger| at(Part::Finger(side, finger, 1)));
    let mut bases = bases.into_iter().flatten();
    let first = bases.next()?;
    let across = match bases.last() {
        Some(last) => first - last,
        None => at(Part::Thumb(side, 1)).or(at(Part::Thumb(side, 0)))? - first,
    };
    let along = (at(Part::Hand(side))? - at(Part::Forearm(side))?).try_normalize()?;
    across.reject_from_normalized(along).try_normalize()
}
