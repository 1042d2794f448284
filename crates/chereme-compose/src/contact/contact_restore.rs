//! Moves wrists a little, so that hands touch again where they touched before an operator.

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;

use super::{ContactSpan, KEPT_CONTACT_OFFSET_M, MovementContacts, PointTracks, TOUCHING_HAND_POINTS};
use crate::arm;
use crate::recipe_settings::ArmSolverMethod;
use crate::work::{JointColumns, JointGroup, WorkingClip};

/// The longest shift of a wrist, in metres, that repairs a contact unnoticed: the same point of the hand touches again,
/// and nobody is warned.
pub(super) const UNNOTICED_SHIFT: f64 = 0.03;
/// The longest shift for any point of the hand to touch, in metres.
const MAX_RESTORING_SHIFT_M: f64 = 0.12;
/// The longest shift on another body, in metres: heads are as far from shoulders as bodies differ.
pub(super) const MAX_OTHER_BODY_SHIFT_M: f64 = 0.25;
/// The time in which a wrist moves to and from a restored contact, in seconds.
pub(crate) const CONTACT_BLEND_S: f64 = 0.2;

/// The contacts that an operator must keep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ContactsToKeep {
    /// None: it moves one hand elsewhere.
    None,
    /// Those of the hands with each other: it moves both elsewhere.
    Hands,
    /// Those of these hands with each other and the body.
    All(&'static [BodySide]),
}

impl ContactsToKeep {
    /// Returns the contacts to keep when these hands are moved elsewhere: those with each other if both move.
    pub(crate) fn contacts_between_sides(sides: &[BodySide]) -> Self {
        match sides.len() {
            2 => Self::Hands,
            _ => Self::None,
        }
    }
}

/// Moves wrists so that former contacts touch again, if `keep` asks for it and a small move is enough; returns a
/// description of the moves. If another point of the hand touches now, that point is part of the contact from then on.
///
/// The hand that was changed moves to the other; if both were, the weak hand moves first. Hands keep their rotations.
/// Before and after a contact the wrist's new path is blended with the old one.
pub(crate) fn restore_contacts(
    work: &mut WorkingClip,
    before: &mut MovementContacts,
    keep: ContactsToKeep,
    operator: &str,
) -> Vec<String> {
    let (sides, body): (&[BodySide], bool) = match keep {
        ContactsToKeep::None => return Vec::new(),
        ContactsToKeep::Hands => (&BodySide::BOTH_SIDES, false),
        ContactsToKeep::All(sides) => (sides, true),
    };
    let wanted = |contact: &ContactSpan| match contact.other {
        Some(_) => true,
        None => body && sides.contains(&contact.side),
    };
    let same_point_shift = before.same_point_shift;
    let MovementContacts { anchors, found, .. } = before;
    if !found.iter().any(wanted) {
        return Vec::new();
    }
    let weak = work.handedness.signer_dominant_side().opposite_side();
    let mut order = vec![weak, weak.opposite_side()];
    order.retain(|side| sides.contains(side));
    let mut did = Vec::new();
    for side in order {
        // Again for each hand, because the first one may have moved.
        let tracks = anchors.follow_anchored_points(work);
        let mut shifts: Vec<Option<DVec3>> = vec![None; work.frames];
        for contact in found.iter_mut().filter(|contact| wanted(contact)) {
            if contact.side != side && contact.other.is_none() {
                continue;
            }
            let Some((shift, point)) = restoring_wrist_shift(contact, &tracks, side, same_point_shift) else {
                continue;
            };
            let slots = &mut shifts[contact.frames.clone()];
            // A frame has one shift, that of the first contact.
            if slots.iter().any(Option::is_some) {
                continue;
            }
            let most = shift
                .iter()
                .map(|displacement| displacement.length())
                .fold(0.0, f64::max);
            for (slot, displacement) in slots.iter_mut().zip(shift) {
                *slot = Some(displacement);
            }
            let was = contact.contact_point_names();
            if contact.side == side {
                contact.point = point;
            } else {
                contact.place = point;
            }
            contact.repaired = contact.repaired.max(most);
            did.push(describe_restored_contact(contact, &was, side, most));
        }
        if shifts.iter().all(Option::is_none) {
            continue;
        }
        let displacements = blend_shifts(&shifts, (CONTACT_BLEND_S / work.rate.frame_time()).round() as usize);
        let Some(hand) = work.anatomy.arm_chain(side).map(|arm| arm.hand) else {
            continue;
        };
        let columns = JointColumns::joint_columns_of(work, [hand]);
        let wrists = columns.joint_positions(hand).iter().zip(&displacements);
        let targets: Vec<DVec3> = wrists.map(|(wrist, displacement)| *wrist + *displacement).collect();
        arm::move_wrist(work, side, &columns, &targets, None, ArmSolverMethod::Analytic);
        work.note_changed_groups([JointGroup::Arm(side)], &format!("{operator} (contact kept)"));
    }
    did
}

/// Returns warnings about contacts that a step repaired by a long shift of a wrist.
pub(crate) fn long_repairs(mended: &MovementContacts, step: &str) -> Vec<String> {
    let all = mended.found.iter();
    let long = all.filter(|contact| contact.repaired > UNNOTICED_SHIFT);
    long.map(|contact| {
        let (point, place) = contact.contact_point_names();
        format!(
            "{step}: a wrist is moved by {:.1} cm so that {point} and {place} touch",
            contact.repaired * 100.0
        )
    })
    .collect()
}

/// Returns the shift of the wrist of `side` at each frame of a contact, and the point of that hand that then touches:
/// the former one or, if that needs a long shift, the one that needs the shortest. `None` if the contact still exists,
/// or the shift would be too long.
fn restoring_wrist_shift(
    contact: &ContactSpan,
    tracks: &PointTracks<'_>,
    side: BodySide,
    same_point_shift: f64,
) -> Option<(Vec<DVec3>, usize)> {
    if contact.contact_displacement(tracks) < KEPT_CONTACT_OFFSET_M {
        return None;
    }
    let acts = contact.side == side;
    let hand_point = if acts { contact.point } else { contact.place };
    let displacements = |point: usize| -> Option<(Vec<DVec3>, f64)> {
        let mut same = contact.clone();
        if acts {
            same.point = point;
        } else {
            same.place = point;
        }
        let displacements: Option<Vec<DVec3>> = contact
            .frames
            .clone()
            .zip(&contact.offsets)
            .map(|(frame, was)| {
                let displacement = same.contact_offset(tracks, frame)? - *was;
                // To bring the place to the point takes the opposite shift.
                Some(if acts { displacement } else { -displacement })
            })
            .collect();
        let displacements = displacements?;
        let most = displacements
            .iter()
            .map(|displacement| displacement.length())
            .fold(0.0, f64::max);
        Some((displacements, most))
    };
    let (same, most) = displacements(hand_point)?;
    if most <= same_point_shift {
        return Some((same, hand_point));
    }
    let parts = (0..TOUCHING_HAND_POINTS.len()).filter_map(|point| Some((displacements(point)?, point)));
    let ((best, most), point) = parts.min_by(|a, b| a.0.1.total_cmp(&b.0.1))?;
    (most <= MAX_RESTORING_SHIFT_M).then_some((best, point))
}

fn describe_restored_contact(contact: &ContactSpan, was: &(String, String), side: BodySide, most: f64) -> String {
    let now = contact.contact_point_names();
    let instead = match now == *was {
        true => String::new(),
        false => format!(" instead of {} and {}", was.0, was.1),
    };
    format!(
        "contact kept: {} and {}{instead}; the {} wrist is moved by up to {:.1} cm for it",
        now.0,
        now.1,
        side.body_side_name(),
        most * 100.0
    )
}

/// Fills in missing shifts: fades from the nearest one before to the nearest one after, each within `blend` frames.
pub(crate) fn blend_shifts(shifts: &[Option<DVec3>], blend: usize) -> Vec<DVec3> {
    let blend = blend.max(1);
    let smooth = |share: f64| {
        let w = share.clamp(0.0, 1.0);
        w * w * w * (10.0 + w * (6.0 * w - 15.0))
    };
    let mut displacements = Vec::with_capacity(shifts.len());
    let mut before: Option<(usize, DVec3)> = None;
    let mut after: Option<(usize, DVec3)> = None;
    for (frame, shift) in shifts.iter().enumerate() {
        if let Some(displacement) = *shift {
            before = Some((frame, displacement));
            displacements.push(displacement);
            continue;
        }
        // The next shift is sought again only when the last one found is behind.
        if after.is_none_or(|(at, _)| at < frame) {
            let next = (frame..shifts.len()).find_map(|at| Some((at, shifts[at]?)));
            after = next.or(Some((usize::MAX, DVec3::ZERO)));
        }
        let next = after.filter(|(at, _)| *at != usize::MAX);
        let displacement = match (before, next) {
            // Shifts this near pass into each other, without a return to the old path between them.
            (Some((from, a)), Some((to, b))) if to - from <= 2 * blend => {
                a.lerp(b, smooth((frame - from) as f64 / (to - from) as f64))
            }
            (before, next) => {
                let fade = |away: usize| 1.0 - smooth(away as f64 / blend as f64);
                let out = before.map_or(DVec3::ZERO, |(from, a)| a * fade(frame - from));
                out + next.map_or(DVec3::ZERO, |(to, b)| b * fade(to - frame))
            }
        };
        displacements.push(displacement);
    }
    displacements
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_fade_in_and_out_and_blend_between_contacts() {
        let mut shifts = vec![None; 100];
        shifts[30..40].fill(Some(DVec3::X));
        shifts[50..55].fill(Some(DVec3::X * 3.0));
        let displacements = blend_shifts(&shifts, 10);
        assert_eq!(
            (
                displacements[19],
                displacements[35],
                displacements[52],
                displacements[65]
            ),
            (DVec3::ZERO, DVec3::X, DVec3::X * 3.0, DVec3::ZERO)
        );
        assert!(
            displacements[24].x > 0.0
                && displacements[24].x < 0.5
                && displacements[45].x > 1.0
                && displacements[45].x < 3.0
        );
        let step = displacements
            .windows(2)
            .map(|w| w[0].distance(w[1]))
            .fold(0.0, f64::max);
        assert!(step < 0.7, "{step}");
    }
}
