//! The bones of markers, by the markers' labels: Plug-in Gait, the set of 41 markers of CMU, Helen Hayes.

use crate::anatomy::BodyPart;
use crate::hand::{BodySide, HandFinger};

/// The place of a marker on a skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkerAttachment {
    /// The parts that may carry it, in order of preference; the first one that the skeleton has is used.
    pub on: [BodyPart; 2],
    /// Its expected place: a part, and the share of the distance from the carrying joint to that part's joint.
    pub towards: Option<(BodyPart, f64)>,
    /// The joint that it is next to, if any; used to measure limbs.
    pub near: Option<BodyPart>,
    /// Its distance from the bone towards the side of the thumb, in metres; negative towards the little finger. Only
    /// labels that name their side have one.
    pub thumbwards: f64,
    /// Its distance from the bone out of the back of the hand, in metres.
    pub raised: f64,
}

/// The distance of the two markers of a wrist from its middle, in metres: half the breadth of a wrist, and a marker.
const BESIDE_WRIST: f64 = 0.035;
/// The distance of a marker on the back of the hand from the bone, in metres.
const ABOVE_HAND: f64 = 0.015;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AttachmentBone {
    Head,
    Top,
    Collar,
    Back,
    Hips,
    Shoulder,
    UpperArm,
    Elbow,
    Forearm,
    Wrist,
    WristByThumb,
    WristByLittleFinger,
    Hand,
    Thigh,
    Knee,
    Shin,
    Ankle,
    Heel,
    Toe,
}

const MIDDLE_MARKER_BONES: [(&str, AttachmentBone); 20] = [
    ("C7", AttachmentBone::Collar),
    ("CLAV", AttachmentBone::Collar),
    ("T8", AttachmentBone::Back),
    ("T10", AttachmentBone::Back),
    ("T12", AttachmentBone::Back),
    ("STRN", AttachmentBone::Back),
    ("STERNUM", AttachmentBone::Back),
    ("RBAK", AttachmentBone::Back),
    ("LBAK", AttachmentBone::Back),
    ("BACK", AttachmentBone::Back),
    ("OFFSET", AttachmentBone::Back),
    ("SACR", AttachmentBone::Hips),
    ("VSACRAL", AttachmentBone::Hips),
    ("L5", AttachmentBone::Hips),
    ("ARIEL", AttachmentBone::Top),
    ("TOPHEAD", AttachmentBone::Top),
    ("FRONTHEAD", AttachmentBone::Head),
    ("REARHEAD", AttachmentBone::Head),
    ("MFHD", AttachmentBone::Head),
    ("MBHD", AttachmentBone::Head),
];

const SIDED_MARKER_BONES: [(&str, AttachmentBone); 40] = [
    ("FHD", AttachmentBone::Head),
    ("BHD", AttachmentBone::Head),
    ("SHO", AttachmentBone::Shoulder),
    ("SHOULDER", AttachmentBone::Shoulder),
    ("UPA", AttachmentBone::UpperArm),
    ("BICEPS", AttachmentBone::UpperArm),
    ("ELB", AttachmentBone::Elbow),
    ("ELBOW", AttachmentBone::Elbow),
    ("OEL", AttachmentBone::Elbow),
    ("IEL", AttachmentBone::Elbow),
    ("FRM", AttachmentBone::Forearm),
    ("FRA", AttachmentBone::Forearm),
    ("FOREARM", AttachmentBone::Forearm),
    ("WRA", AttachmentBone::WristByThumb),
    ("WRB", AttachmentBone::WristByLittleFinger),
    ("WRI", AttachmentBone::Wrist),
    ("WRIST", AttachmentBone::Wrist),
    ("OWR", AttachmentBone::Wrist),
    ("IWR", AttachmentBone::Wrist),
    ("FIN", AttachmentBone::Hand),
    ("HND", AttachmentBone::Hand),
    ("ASI", AttachmentBone::Hips),
    ("ASIS", AttachmentBone::Hips),
    ("PSI", AttachmentBone::Hips),
    ("PSIS", AttachmentBone::Hips),
    ("FWT", AttachmentBone::Hips),
    ("BWT", AttachmentBone::Hips),
    ("THI", AttachmentBone::Thigh),
    ("THIGH", AttachmentBone::Thigh),
    ("KNE", AttachmentBone::Knee),
    ("KNEE", AttachmentBone::Knee),
    ("TIB", AttachmentBone::Shin),
    ("SHN", AttachmentBone::Shin),
    ("SHANK", AttachmentBone::Shin),
    ("ANK", AttachmentBone::Ankle),
    ("ANKLE", AttachmentBone::Ankle),
    ("HEE", AttachmentBone::Heel),
    ("HEEL", AttachmentBone::Heel),
    ("TOE", AttachmentBone::Toe),
    ("MT5", AttachmentBone::Toe),
];

/// Returns the place of a marker by its label, such as `LSHO`, `Anna:RWRA`, `Anna_RWRA` or `R.Elbow`; `None` for an
/// unknown label.
#[must_use]
pub fn find_marker_attachment(label: &str) -> Option<MarkerAttachment> {
    split_worn_marker(label).1
}

/// Returns the subject before a marker's label, such as `Anna` of `Anna:LSHO` and of `Anna_LSHO`, and the marker's place;
/// a name without a known label ends at its last colon.
pub(super) fn split_worn_marker(name: &str) -> (&str, Option<MarkerAttachment>) {
    let (subject, bare) = name.rsplit_once(':').unwrap_or(("", name));
    if let Some(place) = bare_attachment(bare) {
        return (subject, Some(place));
    }
    let after_colon = name.len() - bare.len();
    // A subject may have underscores itself, so every one is tried from the left.
    let attachment_match = bare.match_indices('_').find_map(|(at, _)| {
        let subject = &name[..after_colon + at];
        Some((subject, bare_attachment(&bare[at + 1..])?))
    });
    match attachment_match.filter(|(subject, _)| !subject.is_empty()) {
        Some((subject, place)) => (subject, Some(place)),
        None => (subject, None),
    }
}

fn bare_attachment(bare: &str) -> Option<MarkerAttachment> {
    // Programs write R.Elbow, R_ELB and relb for the same marker.
    let plain: String = bare
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .map(|letter| letter.to_ascii_uppercase())
        .collect();
    // Middle labels first, since LBAK and RBAK begin with the letter of a side but lie on the back.
    if let Some((_, bone)) = MIDDLE_MARKER_BONES.iter().find(|(name, _)| *name == plain) {
        // Middle bones have no side, so either will do.
        return Some(attach_to_bone(*bone, BodySide::Right));
    }
    let (side, rest) = match (plain.strip_prefix('L'), plain.strip_prefix('R')) {
        (Some(rest), _) => (BodySide::Left, rest),
        (_, Some(rest)) => (BodySide::Right, rest),
        _ => return None,
    };
    let sided_bone = SIDED_MARKER_BONES.iter().find(|(name, _)| *name == rest);
    sided_bone.map(|(_, bone)| attach_to_bone(*bone, side))
}

fn attach_to_bone(bone: AttachmentBone, side: BodySide) -> MarkerAttachment {
    let on = |part: BodyPart, other: BodyPart| MarkerAttachment {
        on: [part, other],
        towards: None,
        near: None,
        thumbwards: 0.0,
        raised: 0.0,
    };
    let (upper, fore, hand) = (BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side));
    let (thigh, shin, foot) = (BodyPart::Thigh(side), BodyPart::Shin(side), BodyPart::Foot(side));
    let along = |part: BodyPart, end: BodyPart, share: f64| MarkerAttachment {
        towards: Some((end, share)),
        ..on(part, part)
    };
    let near = |part: BodyPart, attachment: MarkerAttachment| MarkerAttachment {
        near: Some(part),
        ..attachment
    };
    let wrist = |thumbwards: f64| MarkerAttachment {
        thumbwards,
        ..near(hand, along(fore, hand, 1.0))
    };
    match bone {
        AttachmentBone::Head | AttachmentBone::Top => on(BodyPart::Head, BodyPart::Neck),
        AttachmentBone::Collar => MarkerAttachment {
            towards: Some((BodyPart::Neck, 1.0)),
            ..on(BodyPart::Chest, BodyPart::Spine)
        },
        AttachmentBone::Back => on(BodyPart::Chest, BodyPart::Spine),
        AttachmentBone::Hips => on(BodyPart::Hips, BodyPart::Spine),
        AttachmentBone::Shoulder => near(
            upper,
            MarkerAttachment {
                towards: Some((upper, 1.0)),
                ..on(BodyPart::Clavicle(side), BodyPart::Chest)
            },
        ),
        AttachmentBone::UpperArm => along(upper, fore, 0.5),
        AttachmentBone::Elbow => near(fore, along(upper, fore, 1.0)),
        AttachmentBone::Forearm => along(fore, hand, 0.5),
        AttachmentBone::Wrist => wrist(0.0),
        AttachmentBone::WristByThumb => wrist(BESIDE_WRIST),
        AttachmentBone::WristByLittleFinger => wrist(-BESIDE_WRIST),
        AttachmentBone::Hand => MarkerAttachment {
            raised: ABOVE_HAND,
            ..along(hand, BodyPart::Finger(side, HandFinger::Middle, 1), 1.0)
        },
        AttachmentBone::Thigh => along(thigh, shin, 0.5),
        AttachmentBone::Knee => near(shin, along(thigh, shin, 1.0)),
        AttachmentBone::Shin => along(shin, foot, 0.5),
        AttachmentBone::Ankle => near(foot, along(shin, foot, 1.0)),
        AttachmentBone::Heel => on(foot, foot),
        AttachmentBone::Toe => along(foot, BodyPart::Toes(side), 1.0),
    }
}
