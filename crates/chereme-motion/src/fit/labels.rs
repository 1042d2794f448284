//! The bones of markers, by the markers' labels: Plug-in Gait, the set of 41 markers of CMU, Helen Hayes.

use crate::anatomy::Part;
use crate::hand::{Finger, Side};

/// The place of a marker on a skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attachment {
    /// The parts that may carry it, in order of preference; the first one that the skeleton has is used.
    pub on: [Part; 2],
    /// Its expected place: a part, and the share of the distance from the carrying joint to that part's joint.
    pub towards: Option<(Part, f64)>,
    /// The joint that it is next to, if any; used to measure limbs.
    pub near: Option<Part>,
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
enum Bone {
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

const MIDDLE: [(&str, Bone); 20] = [
    ("C7", Bone::Collar),
    ("CLAV", Bone::Collar),
    ("T8", Bone::Back),
    ("T10", Bone::Back),
    ("T12", Bone::Back),
    ("STRN", Bone::Back),
    ("STERNUM", Bone::Back),
    ("RBAK", Bone::Back),
    ("LBAK", Bone::Back),
    ("BACK", Bone::Back),
    ("OFFSET", Bone::Back),
    ("SACR", Bone::Hips),
    ("VSACRAL", Bone::Hips),
    ("L5", Bone::Hips),
    ("ARIEL", Bone::Top),
    ("TOPHEAD", Bone::Top),
    ("FRONTHEAD", Bone::Head),
    ("REARHEAD", Bone::Head),
    ("MFHD", Bone::Head),
    ("MBHD", Bone::Head),
];

const SIDED: [(&str, Bone); 40] = [
    ("FHD", Bone::Head),
    ("BHD", Bone::Head),
    ("SHO", Bone::Shoulder),
    ("SHOULDER", Bone::Shoulder),
    ("UPA", Bone::UpperArm),
    ("BICEPS", Bone::UpperArm),
    ("ELB", Bone::Elbow),
    ("ELBOW", Bone::Elbow),
    ("OEL", Bone::Elbow),
    ("IEL", Bone::Elbow),
    ("FRM", Bone::Forearm),
    ("FRA", Bone::Forearm),
    ("FOREARM", Bone::Forearm),
    ("WRA", Bone::WristByThumb),
    ("WRB", Bone::WristByLittleFinger),
    ("WRI", Bone::Wrist),
    ("WRIST", Bone::Wrist),
    ("OWR", Bone::Wrist),
    ("IWR", Bone::Wrist),
    ("FIN", Bone::Hand),
    ("HND", Bone::Hand),
    ("ASI", Bone::Hips),
    ("ASIS", Bone::Hips),
    ("PSI", Bone::Hips),
    ("PSIS", Bone::Hips),
    ("FWT", Bone::Hips),
    ("BWT", Bone::Hips),
    ("THI", Bone::Thigh),
    ("THIGH", Bone::Thigh),
    ("KNE", Bone::Knee),
    ("KNEE", Bone::Knee),
    ("TIB", Bone::Shin),
    ("SHN", Bone::Shin),
    ("SHANK", Bone::Shin),
    ("ANK", Bone::Ankle),
    ("ANKLE", Bone::Ankle),
    ("HEE", Bone::Heel),
    ("HEEL", Bone::Heel),
    ("TOE", Bone::Toe),
    ("MT5", Bone::Toe),
];

/// Returns the place of a marker by its label, such as `LSHO`, `Anna:RWRA`, `Anna_RWRA` or `R.Elbow`; `None` for an
/// unknown label.
#[must_use]
pub fn attachment(label: &str) -> Option<Attachment> {
    worn(label).1
}

/// Returns the subject before a marker's label, such as `Anna` of `Anna:LSHO` and of `Anna_LSHO`, and the marker's place;
/// a name without a known label ends at its last colon.
pub(super) fn worn(name: &str) -> (&str, Option<Attachment>) {
    let (subject, bare) = name.rsplit_once(':').unwrap_or(("", name));
    if let Some(place) = bare_attachment(bare) {
        return (subject, Some(place));
    }
    let after_colon = name.len() - bare.len();
    let known = bare.match_indices('_').find_map(|(at, _)| {
        let subject = &name[..after_colon + at];
        Some((subject, bare_attachment(&bare[at + 1..])?))
    });
    match known.filter(|(subject, _)| !subject.is_empty()) {
        Some((subject, place)) => (subject, Some(place)),
        None => (subject, None),
    }
}

fn bare_attachment(bare: &str) -> Option<Attachment> {
    let plain: String = bare
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .map(|letter| letter.to_ascii_uppercase())
        .collect();
    if let Some((_, bone)) = MIDDLE.iter().find(|(name, _)| *name == plain) {
        return Some(of(*bone, Side::Right));
    }
    let (side, rest) = match (plain.strip_prefix('L'), plain.strip_prefix('R')) {
        (Some(rest), _) => (Side::Left, rest),
        (_, Some(rest)) => (Side::Right, rest),
        _ => return None,
    };
    let found = SIDED.iter().find(|(name, _)| *name == rest);
    found.map(|(_, bone)| of(*bone, side))
}

fn of(bone: Bone, side: Side) -> Attachment {
    let on = |part: Part, other: Part| Attachment {
        on: [part, other],
        towards: None,
        near: None,
        thumbwards: 0.0,
        raised: 0.0,
    };
    let (upper, fore, hand) = (Part::UpperArm(side), Part::Forearm(side), Part::Hand(side));
    let (thigh, shin, foot) = (Part::Thigh(side), Part::Shin(side), Part::Foot(side));
    let along = |part: Part, end: Part, share: f64| Attachment {
        towards: Some((end, share)),
        ..on(part, part)
    };
    let near = |part: Part, attachment: Attachment| Attachment {
        near: Some(part),
        ..attachment
    };
    let wrist = |thumbwards: f64| Attachment {
        thumbwards,
        ..near(hand, along(fore, hand, 1.0))
    };
    match bone {
        Bone::Head | Bone::Top => on(Part::Head, Part::Neck),
        Bone::Collar => Attachment {
            towards: Some((Part::Neck, 1.0)),
            ..on(Part::Chest, Part::Spine)
        },
        Bone::Back => on(Part::Chest, Part::Spine),
        Bone::Hips => on(Part::Hips, Part::Spine),
        Bone::Shoulder => near(
            upper,
            Attachment {
                towards: Some((upper, 1.0)),
                ..on(Part::Clavicle(side), Part::Chest)
            },
        ),
        Bone::UpperArm => along(upper, fore, 0.5),
        Bone::Elbow => near(fore, along(upper, fore, 1.0)),
        Bone::Forearm => along(fore, hand, 0.5),
        Bone::Wrist => wrist(0.0),
        Bone::WristByThumb => wrist(BESIDE_WRIST),
        Bone::WristByLittleFinger => wrist(-BESIDE_WRIST),
        Bone::Hand => Attachment {
            raised: ABOVE_HAND,
            ..along(hand, Part::Finger(side, Finger::Middle, 1), 1.0)
        },
        Bone::Thigh => along(thigh, shin, 0.5),
        Bone::Knee => near(shin, along(thigh, shin, 1.0)),
        Bone::Shin => along(shin, foot, 0.5),
        Bone::Ankle => near(foot, along(shin, foot, 1.0)),
        Bone::Heel => on(foot, foot),
        Bone::Toe => along(foot, Part::Toes(side), 1.0),
    }
}
