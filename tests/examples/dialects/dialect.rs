//! Descriptions of skeleton dialects: the names, units, rest poses, joints and faults in files of common programs.

use std::f64::consts::FRAC_PI_2;

use chereme_motion::{BodyPart, BodySide, HandFinger};

/// The form in which one program writes a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dialect {
    pub(crate) name: &'static str,
    /// Its name for a part.
    pub(crate) part: fn(BodyPart) -> String,
    /// Prefix of every name, such as `Anna:`.
    pub(crate) space: &'static str,
    /// Units per metre.
    pub(crate) unit: f64,
    /// Whether Z points up instead of Y.
    pub(crate) z_up: bool,
    /// Angle by which the arms are lowered at rest, in radians.
    pub(crate) lowered: f64,
    /// Angle by which fingers and thumb are bent at rest, in radians.
    pub(crate) bent: f64,
    pub(crate) metacarpals: bool,
    /// Whether fingers end in a fourth joint instead of an End Site.
    pub(crate) ends: bool,
    /// The turn about X and Y, in radians, of a node with its own offset above the hips, which make up for it.
    pub(crate) wrapped: Option<[f64; 2]>,
    pub(crate) markers: bool,
    /// Whether fingertips and some finger joints have wrong offsets, and every joint has position channels.
    pub(crate) broken: bool,
    /// Whether the movement begins with a T-pose five metres away that faces backwards.
    pub(crate) odd: bool,
    /// Noise of the rotations in radians.
    pub(crate) noise: f64,
    /// Angle by which thumbs are turned toward the palm at rest, in radians.
    pub(crate) opposed: f64,
    /// Angle by which the signer's straightest finger is bent, in radians; the fist is as usual.
    pub(crate) lax: f64,
    /// Whether digits lack their last joint.
    pub(crate) short: bool,
    /// Whether every bone lies along its own Z axis, so that the body at rest is a pole, and both collar bones begin in
    /// one place.
    pub(crate) pole: bool,
}

const PLAIN: Dialect = Dialect {
    name: "plain",
    part: motionbuilder,
    space: "",
    unit: 100.0,
    z_up: false,
    lowered: 0.0,
    bent: 0.0,
    metacarpals: false,
    ends: false,
    wrapped: None,
    markers: false,
    broken: false,
    odd: false,
    noise: 0.0,
    opposed: 0.0,
    lax: 0.0,
    short: false,
    pole: false,
};

/// Returns every dialect; the last one combines all oddities.
pub(crate) fn all() -> Vec<Dialect> {
    vec![
        PLAIN,
        Dialect {
            name: "mixamo-t",
            part: mixamo,
            ends: true,
            ..PLAIN
        },
        Dialect {
            name: "unreal-a",
            part: unreal,
            z_up: true,
            lowered: 0.8,
            metacarpals: true,
            ..PLAIN
        },
        Dialect {
            name: "rigify-i",
            part: rigify,
            unit: 1.0,
            z_up: true,
            lowered: 1.4,
            metacarpals: true,
            ..PLAIN
        },
        Dialect {
            name: "biped-mm",
            part: biped,
            unit: 1000.0,
            lowered: 0.4,
            bent: 0.15,
            ..PLAIN
        },
        Dialect {
            name: "vrm-inch",
            part: vrm,
            unit: 39.37,
            ..PLAIN
        },
        Dialect {
            name: "four-joints",
            ends: true,
            metacarpals: true,
            ..PLAIN
        },
        Dialect {
            name: "relaxed-rest",
            lowered: 1.2,
            bent: 0.5,
            ..PLAIN
        },
        Dialect {
            name: "fist-rest",
            bent: 1.3,
            ..PLAIN
        },
        Dialect {
            name: "wrapped",
            wrapped: Some([0.0, 0.6]),
            ..PLAIN
        },
        Dialect {
            name: "armature",
            wrapped: Some([-FRAC_PI_2, 0.0]),
            ends: true,
            ..PLAIN
        },
        Dialect {
            name: "shogun-markers",
            space: "Anna:",
            wrapped: Some([0.0, 0.6]),
            markers: true,
            broken: true,
            ..PLAIN
        },
        Dialect {
            name: "along-z",
            pole: true,
            ..PLAIN
        },
        Dialect {
            name: "broken-offsets",
            broken: true,
            ends: true,
            ..PLAIN
        },
        Dialect {
            name: "odd-frames",
            odd: true,
            ..PLAIN
        },
        Dialect {
            name: "noise",
            noise: 0.03,
            ..PLAIN
        },
        Dialect {
            name: "opposed-rest",
            opposed: 0.7,
            bent: 0.3,
            ..PLAIN
        },
        Dialect {
            name: "short-digits",
            short: true,
            ..PLAIN
        },
        Dialect {
            name: "lax-signer",
            lax: 0.35,
            ..PLAIN
        },
        Dialect {
            name: "lax-and-noisy",
            part: mixamo,
            lax: 0.25,
            noise: 0.02,
            bent: 0.3,
            ends: true,
            ..PLAIN
        },
        Dialect {
            name: "all-at-once",
            part: unreal,
            space: "NS:",
            z_up: true,
            lowered: 0.8,
            bent: 0.5,
            metacarpals: true,
            ends: true,
            wrapped: Some([0.0, 0.6]),
            markers: true,
            broken: true,
            odd: true,
            noise: 0.02,
            opposed: 0.3,
            lax: 0.2,
            ..PLAIN
        },
    ]
}

fn cap(side: BodySide) -> &'static str {
    if side == BodySide::Left { "Left" } else { "Right" }
}

fn letter(side: BodySide) -> &'static str {
    if side == BodySide::Left { "l" } else { "r" }
}

fn finger(finger: HandFinger) -> &'static str {
    match finger {
        HandFinger::Index => "Index",
        HandFinger::Middle => "Middle",
        HandFinger::Ring => "Ring",
        HandFinger::Little => "Pinky",
    }
}

fn motionbuilder(part: BodyPart) -> String {
    match part {
        BodyPart::Hips => "Hips".into(),
        BodyPart::Spine => "Spine".into(),
        BodyPart::Chest => "Spine2".into(),
        BodyPart::Neck => "Neck".into(),
        BodyPart::Head => "Head".into(),
        BodyPart::Jaw => "Jaw".into(),
        BodyPart::Eye(s) => format!("{}Eye", cap(s)),
        BodyPart::Clavicle(s) => format!("{}Shoulder", cap(s)),
        BodyPart::UpperArm(s) => format!("{}Arm", cap(s)),
        BodyPart::Forearm(s) => format!("{}ForeArm", cap(s)),
        BodyPart::Hand(s) => format!("{}Hand", cap(s)),
        BodyPart::Thumb(s, n) => format!("{}HandThumb{}", cap(s), n + 1),
        BodyPart::Finger(s, f, 0) => format!("{}InHand{}", cap(s), finger(f)),
        BodyPart::Finger(s, f, n) => format!("{}Hand{}{n}", cap(s), finger(f)),
        BodyPart::Thigh(s) => format!("{}UpLeg", cap(s)),
        BodyPart::Shin(s) => format!("{}Leg", cap(s)),
        BodyPart::Foot(s) => format!("{}Foot", cap(s)),
        BodyPart::Toes(s) => format!("{}ToeBase", cap(s)),
    }
}

fn mixamo(part: BodyPart) -> String {
    format!("mixamorig:{}", motionbuilder(part))
}

fn unreal(part: BodyPart) -> String {
    let sided = |name: &str, s: BodySide| format!("{name}_{}", letter(s));
    match part {
        BodyPart::Hips => "pelvis".into(),
        BodyPart::Spine => "spine_01".into(),
        BodyPart::Chest => "spine_03".into(),
        BodyPart::Neck => "neck_01".into(),
        BodyPart::Head => "head".into(),
        BodyPart::Jaw => "jaw".into(),
        BodyPart::Eye(s) => sided("eye", s),
        BodyPart::Clavicle(s) => sided("clavicle", s),
        BodyPart::UpperArm(s) => sided("upperarm", s),
        BodyPart::Forearm(s) => sided("lowerarm", s),
        BodyPart::Hand(s) => sided("hand", s),
        BodyPart::Thumb(s, n) => sided(&format!("thumb_0{}", n + 1), s),
        BodyPart::Finger(s, f, 0) => sided(&format!("{}_metacarpal", finger(f).to_lowercase()), s),
        BodyPart::Finger(s, f, n) => sided(&format!("{}_0{n}", finger(f).to_lowercase()), s),
        BodyPart::Thigh(s) => sided("thigh", s),
        BodyPart::Shin(s) => sided("calf", s),
        BodyPart::Foot(s) => sided("foot", s),
        BodyPart::Toes(s) => sided("ball", s),
    }
}

fn rigify(part: BodyPart) -> String {
    let sided = |name: &str, s: BodySide| format!("{name}.{}", letter(s).to_uppercase());
    match part {
        BodyPart::Hips => "hips".into(),
        BodyPart::Spine => "spine".into(),
        BodyPart::Chest => "chest".into(),
        BodyPart::Neck => "neck".into(),
        BodyPart::Head => "head".into(),
        BodyPart::Jaw => "jaw".into(),
        BodyPart::Eye(s) => sided("eye", s),
        BodyPart::Clavicle(s) => sided("shoulder", s),
        BodyPart::UpperArm(s) => sided("upper_arm", s),
        BodyPart::Forearm(s) => sided("forearm", s),
        BodyPart::Hand(s) => sided("hand", s),
        BodyPart::Thumb(s, n) => sided(&format!("thumb.0{}", n + 1), s),
        BodyPart::Finger(s, f, 0) => sided(&format!("palm.0{}", f.index() + 1), s),
        BodyPart::Finger(s, f, n) => sided(&format!("f_{}.0{n}", finger(f).to_lowercase()), s),
        BodyPart::Thigh(s) => sided("thigh", s),
        BodyPart::Shin(s) => sided("shin", s),
        BodyPart::Foot(s) => sided("foot", s),
        BodyPart::Toes(s) => sided("toe", s),
    }
}

fn biped(part: BodyPart) -> String {
    let sided = |name: &str, s: BodySide| format!("Bip01 {} {name}", letter(s).to_uppercase());
    match part {
        BodyPart::Hips => "Bip01 Pelvis".into(),
        BodyPart::Spine => "Bip01 Spine".into(),
        BodyPart::Chest => "Bip01 Spine2".into(),
        BodyPart::Neck => "Bip01 Neck".into(),
        BodyPart::Head => "Bip01 Head".into(),
        BodyPart::Jaw => "Bip01 Jaw".into(),
        BodyPart::Eye(s) => sided("Eye", s),
        BodyPart::Clavicle(s) => sided("Clavicle", s),
        BodyPart::UpperArm(s) => sided("UpperArm", s),
        BodyPart::Forearm(s) => sided("Forearm", s),
        BodyPart::Hand(s) => sided("Hand", s),
        BodyPart::Thumb(s, 0) => sided("Finger0", s),
        BodyPart::Thumb(s, n) => sided(&format!("Finger0{n}"), s),
        BodyPart::Finger(s, f, 0) => sided(&format!("Palm{}", f.index() + 1), s),
        BodyPart::Finger(s, f, 1) => sided(&format!("Finger{}", f.index() + 1), s),
        BodyPart::Finger(s, f, n) => sided(&format!("Finger{}{}", f.index() + 1, n - 1), s),
        BodyPart::Thigh(s) => sided("Thigh", s),
        BodyPart::Shin(s) => sided("Calf", s),
        BodyPart::Foot(s) => sided("Foot", s),
        BodyPart::Toes(s) => sided("Toe0", s),
    }
}

fn vrm(part: BodyPart) -> String {
    let sided = |name: &str, s: BodySide| format!("{}{name}", cap(s).to_lowercase());
    let segment = |n: u8| ["Metacarpal", "Proximal", "Intermediate", "Distal"][usize::from(n.min(3))];
    match part {
        BodyPart::Thumb(s, n) => sided(
            &format!("Thumb{}", ["Metacarpal", "Proximal", "Distal"][usize::from(n.min(2))]),
            s,
        ),
        BodyPart::Finger(s, f, n) => {
            let name = if f == HandFinger::Little { "Little" } else { finger(f) };
            sided(&format!("{name}{}", segment(n)), s)
        }
        BodyPart::Clavicle(s) => sided("Shoulder", s),
        BodyPart::UpperArm(s) => sided("UpperArm", s),
        BodyPart::Forearm(s) => sided("LowerArm", s),
        BodyPart::Hand(s) => sided("Hand", s),
        BodyPart::Thigh(s) => sided("UpperLeg", s),
        BodyPart::Shin(s) => sided("LowerLeg", s),
        BodyPart::Foot(s) => sided("Foot", s),
        BodyPart::Toes(s) => sided("Toes", s),
        BodyPart::Eye(s) => sided("Eye", s),
        BodyPart::Chest => "chest".into(),
        other => motionbuilder(other).to_lowercase(),
    }
}
