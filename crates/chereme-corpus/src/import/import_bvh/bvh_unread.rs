//! Findings about skeletons that have unread parts or an unusual size.

use chereme_motion::HandFinger;

use super::*;

fn joint_roles_remedy() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::JointRoles,
        "if a joint is one of these, say so in a roles file (--roles)",
    )
}

/// Returns a finding for each hand that cannot be read, because joints of its arm were not found although others were.
pub(super) fn unread_hand_findings(anatomy: &BodyAnatomy) -> Vec<ReportFinding> {
    let unread = |side: BodySide| {
        let arm = [BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)];
        let lacks = |part: &&BodyPart| anatomy.part_joint(**part).is_none();
        let missing: Vec<String> = arm.iter().filter(lacks).map(BodyPart::to_string).collect();
        // A skeleton without any arm on that side lacks nothing that could be read.
        if missing.is_empty() || missing.len() == arm.len() {
            return None;
        }
        Some(ReportFinding::finding_warning(
            format!(
                "nothing about the {} hand can be read from this movement, because these joints were not found: {}",
                side.body_side_name(),
                missing.join(", ")
            ),
            joint_roles_remedy(),
        ))
    };
    BodySide::BOTH_SIDES.into_iter().filter_map(unread).collect()
}

/// Returns a finding for each hand that has joints of some digits only: the posture of the others is unknown.
pub(super) fn unread_digit_findings(anatomy: &BodyAnatomy) -> Vec<ReportFinding> {
    let unread = |side: BodySide| {
        let thumb = std::iter::once(("thumb".to_owned(), BodyPart::Thumb(side, 1)));
        let fingers = HandFinger::ALL_FINGERS
            .into_iter()
            .map(|finger| (finger.finger_name().to_owned(), BodyPart::Finger(side, finger, 1)));
        let (found, missing): (Vec<_>, Vec<_>) = thumb
            .chain(fingers)
            .partition(|(_, part)| anatomy.part_joint(*part).is_some());
        // Hands without any digit, or with all of them, leave nothing to guess.
        if found.is_empty() || missing.is_empty() {
            return None;
        }
        let missing: Vec<String> = missing.into_iter().map(|(name, _)| name).collect();
        Some(ReportFinding::finding_warning(
            format!(
                "the {} hand has no joints of these digits, and a handshape read from it is a guess about them: {}",
                side.body_side_name(),
                missing.join(", ")
            ),
            joint_roles_remedy(),
        ))
    };
    BodySide::BOTH_SIDES.into_iter().filter_map(unread).collect()
}

/// Returns a finding if the inferred unit gives the body a stature that few people have.
pub(super) fn unusual_stature_finding(guess: &ConventionGuess, options: &ImportOptions) -> Option<ReportFinding> {
    let reason = guess.unusual_stature()?;
    if options.metres_per_unit.is_some() {
        return None;
    }
    Some(ReportFinding::finding_warning(
        format!(
            "the unit of length is uncertain; {} is assumed ({reason})",
            guess.unit_name
        ),
        ErrorRemedy::choice_remedy(RemedyChoice::Unit, "say the unit with --unit, such as --unit cm"),
    ))
}
