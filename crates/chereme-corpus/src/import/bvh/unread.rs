//! Findings about skeletons that have unread parts or an unusual size.

use chereme_motion::Finger;

use super::*;

fn roles() -> Remedy {
    Remedy::choice(
        Choice::JointRoles,
        "if a joint is one of these, say so in a roles file (--roles)",
    )
}

/// Returns a finding for each hand that cannot be read, because joints of its arm were not found although others were.
pub(super) fn hands(anatomy: &Anatomy) -> Vec<ReportFinding> {
    let unread = |side: Side| {
        let arm = [Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)];
        let lacks = |part: &&Part| anatomy.joint(**part).is_none();
        let missing: Vec<String> = arm.iter().filter(lacks).map(Part::to_string).collect();
        if missing.is_empty() || missing.len() == arm.len() {
            return None;
        }
        Some(ReportFinding::warning(
            format!(
                "nothing about the {} hand can be read from this movement, because these joints were not found: {}",
                side.name(),
                missing.join(", ")
            ),
            roles(),
        ))
    };
    Side::BOTH.into_iter().filter_map(unread).collect()
}

/// Returns a finding for each hand that has joints of some digits only: the posture of the others is unknown.
pub(super) fn digits(anatomy: &Anatomy) -> Vec<ReportFinding> {
    let unread = |side: Side| {
        let thumb = std::iter::once(("thumb".to_owned(), Part::Thumb(side, 1)));
        let fingers = Finger::ALL
            .into_iter()
            .map(|finger| (finger.name().to_owned(), Part::Finger(side, finger, 1)));
        let (found, missing): (Vec<_>, Vec<_>) = thumb
            .chain(fingers)
            .partition(|(_, part)| anatomy.joint(*part).is_some());
        if found.is_empty() || missing.is_empty() {
            return None;
        }
        let missing: Vec<String> = missing.into_iter().map(|(name, _)| name).collect();
        Some(ReportFinding::warning(
            format!(
                "the {} hand has no joints of these digits, and a handshape read from it is a guess about them: {}",
                side.name(),
                missing.join(", ")
            ),
            roles(),
        ))
    };
    Side::BOTH.into_iter().filter_map(unread).collect()
}

/// Returns a finding if the inferred unit gives the body a stature that few people have.
pub(super) fn unusual(guess: &ConventionGuess, options: &ImportOptions) -> Option<ReportFinding> {
    let reason = guess.unusual_stature()?;
    if options.metres_per_unit.is_some() {
        return None;
    }
    Some(ReportFinding::warning(
        format!(
            "the unit of length is uncertain; {} is assumed ({reason})",
            guess.unit_name
        ),
        Remedy::choice(Choice::Unit, "say the unit with --unit, such as --unit cm"),
    ))
}
