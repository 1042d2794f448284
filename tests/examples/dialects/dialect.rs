//! Descriptions of skeleton dialects: the names, units, rest poses, joints and faults in files of common programs.

use std::f64::consts::FRAC_PI_2;

use chereme_motion::{Finger, Part, Side};

/// The form in which one program writes a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dialect {
    pub(crate) name: &'static str,
    /// Its name for a part.
    pub(crate) part: fn(Part) -> String,
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

fn cap(side: Side) -> &'static str {
    if side == Side::Left { "Left" } else { "Right" }
}

fn letter(side: Side) -> &'static str {
    if side == Side::Left { "l" } else { "r" }
}

fn finger(finger: Finger) -> &'static str {
    match finger {
        Finger::Index => "Index",
        Finger::Middle => "Middle",
        Finger::Ring => "Ring",
        Finger::Little => "Pinky",
    }
}

fn motionbuilder(part: Part) -> String {
    match part {
        Part::Hips => "Hips".into(),
        Part::Spine => "Spine".into(),
        Part::Chest => "Spine2".into(),
        Part::Neck => "Neck".into(),
        Part::Head => "Head".into(),
        Part::Jaw => "Jaw".into(),
        Part::Eye(s) => format!("{}Eye", cap(s)),
        Part::Clavicle(s) => format!("{}Shoulder", cap(s)),
        Part::UpperArm(s) => format!("{}Arm", cap(s)),
        Part::Forearm(s) => format!("{}ForeArm", cap(s)),
        Part::Hand(s) => format!("{}Hand", cap(s)),
        Part::Thumb(s, n) => format!("{}HandThumb{}", cap(s), n + 1),
        Part::Finger(s, f, 0) => format!("{}InHand{}", cap(s), finger(f)),
        Part::Finger(s, f, n) => format!("{}Hand{}{n}", cap(s), finger(f)),
        Part::Thigh(s) => format!("{}UpLeg", cap(s)),
        Part::Shin(s) => format!("{}Leg", cap(s)),
        Part::Foot(s) => format!("{}Foot", cap(s)),
        Part::Toes(s) => format!("{}ToeBase", cap(s)),
    }
}

fn mixamo(part: Part) -> String {
    format!("mixamorig:{}", motionbuilder(part))
}

fn unreal(part: Part) -> String {
    let sided = |name: &str, s: Side| format!("{name}_{}", letter(s));
    match part {
        Part::Hips => "pelvis".into(),
        Part::Spine => "spine_01".into(),
        Part::Chest => "spine_03".into(),
        Part::Neck => "neck_01".into(),
        Part::Head => "head".into(),
        Part::Jaw => "jaw".into(),
        Part::Eye(s) => sided("eye", s),
        Part::Clavicle(s) => sided("clavicle", s),
        Part::UpperArm(s) => sided("upperarm", s),
        Part::Forearm(s) => sided("lowerarm", s),
        Part::Hand(s) => sided("hand", s),
        Part::Thumb(s, n) => sided(&format!("thumb_0{}", n + 1), s),
        Part::Finger(s, f, 0) => sided(&format!("{}_metacarpal", finger(f).to_lowercase()), s),
        Part::Finger(s, f, n) => sided(&format!("{}_0{n}", finger(f).to_lowercase()), s),
        Part::Thigh(s) => sided("thigh", s),
        Part::Shin(s) => sided("calf", s),
        Part::Foot(s) => sided("foot", s),
        Part::Toes(s) => sided("ball", s),
    }
}

fn rigify(part: Part) -> String {
    let sided = |name: &str, s: Side| format!("{name}.{}", letter(s).to_uppercase());
    match part {
        Part::Hips => "hips".into(),
        Part::Spine => "spine".into(),
        Part::Chest => "chest".into(),
        Part::Neck => "neck".into(),
        Part::Head => "head".into(),
        Part::Jaw => "jaw".into(),
        Part::Eye(s) => sided("eye", s),
        Part::Clavicle(s) => sided("shoulder", s),
        Part::UpperArm(s) => sided("upper_arm", s),
        Part::Forearm(s) => sided("forearm", s),
        Part::Hand(s) => sided("hand", s),
        Part::Thumb(s, n) => sided(&format!("thumb.0{}", n + 1), s),
        Part::Finger(s, f, 0) => sided(&format!("palm.0{}", f.index() + 1), s),
        Part::Finger(s, f, n) => sided(&format!("f_{}.0{n}", finger(f).to_lowercase()), s),
        Part::Thigh(s) => sided("thigh", s),
        Part::Shin(s) => sided("shin", s),
        Part::Foot(s) => sided("foot", s),
        Part::Toes(s) => sided("toe", s),
    }
}

fn biped(part: Part) -> String {
    let sided = |name: &str, s: Side| format!("Bip01 {} {name}", letter(s).to_uppercase());
    match part {
        Part::Hips => "Bip01 Pelvis".into(),
        Part::Spine => "Bip01 Spine".into(),
        Part::Chest => "Bip01 Spine2".into(),
        Part::Neck => "Bip01 Neck".into(),
        Part::Head => "Bip01 Head".into(),
        Part::Jaw => "Bip01 Jaw".into(),
        Part::Eye(s) => sided("Eye", s),
        Part::Clavicle(s) => sided("Clavicle", s),
        Part::UpperArm(s) => sided("UpperArm", s),
        Part::Forearm(s) => sided("Forearm", s),
        Part::Hand(s) => sided("Hand", s),
        Part::Thumb(s, 0) => sided("Finger0", s),
        Part::Thumb(s, n) => sided(&format!("Finger0{n}"), s),
        Part::Finger(s, f, 0) => sided(&format!("Palm{}", f.index() + 1), s),
        Part::Finger(s, f, 1) => sided(&format!("Finger{}", f.index() + 1), s),
        Part::Finger(s, f, n) => sided(&format!("Finger{}{}", f.index() + 1, n - 1), s),
        Part::Thigh(s) => sided("Thigh", s),
        Part::Shin(s) => sided("Calf", s),
        Part::Foot(s) => sided("Foot", s),
        Part::Toes(s) => sided("Toe0", s),
    }
}

fn vrm(part: Part) -> String {
    let sided = |name: &str, s: Side| format!("{}{name}", cap(s).to_lowercase());
    let segment =
        |n: u8| ["Metacarpal", "Proximal", "Intermediate", "Distal"][usize::from(n.min(3))];
    match part {
        Part::Thumb(s, n) => sided(
            &format!(
                "Thumb{}",
                ["Metacarpal", "Proximal", "Distal"][usize::from(n.min(2))]
            ),
            s,
        ),
        Part::Finger(s, f, n) => {
            let name = if f == Finger::Little {
                "Little"
            } else {
                finger(f)
            };
            sided(&format!("{name}{}", segment(n)), s)
        }
        Part::Clavicle(s) => sided("Shoulder", s),
        Part::UpperArm(s) => sided("UpperArm", s),
        Part::Forearm(s) => sided("LowerArm", s),
        Part::Hand(s) => sided("Hand", s),
        Part::Thigh(s) => sided("UpperLeg", s),
        Part::Shin(s) => sided("LowerLeg", s),
        Part::Foot(s) => sided("Foot", s),
        Part::Toes(s) => sided("Toes", s),
        Part::Eye(s) => sided("Eye", s),
        Part::Chest => "chest".into(),
        other => motionbuilder(other).to_lowercase(),
    }
}
