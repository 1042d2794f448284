//! Skeletons for tests: one body with many variations.

pub(crate) mod conventions;
pub(crate) mod real;

use glam::{DQuat, DVec3};

use crate::anatomy::BodyPart;
use crate::hand::{BodySide, HandFinger};
use crate::skeleton::{Skeleton, SkeletonJoint};

/// The variation of the body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyVariation {
    /// Rotates the own space of the n-th joint by `frames(n)`.
    pub(crate) frames: fn(usize) -> DQuat,
    /// Rotates the whole body, like another choice of axes.
    pub(crate) axes: DQuat,
    /// The length of a metre in the skeleton's unit.
    pub(crate) unit: f64,
    /// Whether fingers have metacarpals.
    pub(crate) metacarpals: bool,
    /// The number of joints per finger, from the base on.
    pub(crate) joints: u8,
    /// Whether bones end in tips.
    pub(crate) tips: bool,
    /// The flexion of the finger joints at rest, in radians.
    pub(crate) bent: f64,
    /// The lowering of the arms at rest, in radians; 0 is a T-pose.
    pub(crate) lowered: f64,
}

pub(crate) const PLAIN_BODY_VARIATION: BodyVariation = BodyVariation {
    frames: |_| DQuat::IDENTITY,
    axes: DQuat::IDENTITY,
    unit: 1.0,
    metacarpals: false,
    joints: 3,
    tips: true,
    bent: 0.0,
    lowered: 0.0,
};

/// Returns a rotation that looks arbitrary; the same for the same number.
pub(crate) fn any_turn(n: usize) -> DQuat {
    let x = n as f64;
    let axis = DVec3::new((x * 1.7).sin(), (x * 2.3 + 1.0).cos(), (x * 0.9 + 2.0).sin());
    DQuat::from_axis_angle(axis.normalize_or(DVec3::Y), x * 0.7)
}

pub(crate) fn body_variations() -> Vec<(&'static str, BodyVariation)> {
    let z_up = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    vec![
        ("plain", PLAIN_BODY_VARIATION),
        (
            "bent",
            BodyVariation {
                bent: 0.15,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "z-up cm",
            BodyVariation {
                axes: z_up,
                unit: 100.0,
                bent: 0.1,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "A-pose",
            BodyVariation {
                lowered: 0.8,
                bent: 0.1,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "turned frames",
            BodyVariation {
                frames: any_turn,
                bent: 0.1,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "metacarpals",
            BodyVariation {
                frames: any_turn,
                metacarpals: true,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "two joints",
            BodyVariation {
                joints: 2,
                frames: any_turn,
                ..PLAIN_BODY_VARIATION
            },
        ),
        (
            "no tips",
            BodyVariation {
                tips: false,
                frames: any_turn,
                bent: 0.2,
                ..PLAIN_BODY_VARIATION
            },
        ),
    ]
}

struct FixtureJoint {
    name: String,
    parent: Option<usize>,
    at: DVec3,
    tip: Option<DVec3>,
}

struct FixtureBodyBuilder(Vec<FixtureJoint>);

impl FixtureBodyBuilder {
    fn add_fixture_joint(&mut self, part: BodyPart, parent: Option<usize>, at: [f64; 3]) -> usize {
        self.0.push(FixtureJoint {
            name: part.to_string(),
            parent,
            at: at.into(),
            tip: None,
        });
        self.0.len() - 1
    }
}

/// Returns a body 1.75 m tall in a T-pose (or with lowered arms), whose joints are named after their parts.
pub(crate) fn fixture_body(wear: BodyVariation) -> Skeleton {
    let mut b = FixtureBodyBuilder(Vec::new());
    let hips = b.add_fixture_joint(BodyPart::Hips, None, [0.0, 0.95, 0.0]);
    let spine = b.add_fixture_joint(BodyPart::Spine, Some(hips), [0.0, 1.07, 0.0]);
    let chest = b.add_fixture_joint(BodyPart::Chest, Some(spine), [0.0, 1.27, 0.0]);
    let neck = b.add_fixture_joint(BodyPart::Neck, Some(chest), [0.0, 1.48, 0.0]);
    let head = b.add_fixture_joint(BodyPart::Head, Some(neck), [0.0, 1.58, 0.01]);
    b.0[head].tip = Some(DVec3::new(0.0, 1.75, 0.01));
    for side in BodySide::BOTH_SIDES {
        add_fixture_arm(&mut b, wear, side, chest);
        add_fixture_leg(&mut b, side, hips);
    }
    finish_fixture_skeleton(b, wear)
}

fn add_fixture_leg(b: &mut FixtureBodyBuilder, side: BodySide, hips: usize) {
    let s = side.side_sign();
    let thigh = b.add_fixture_joint(BodyPart::Thigh(side), Some(hips), [s * 0.09, 0.92, 0.0]);
    let shin = b.add_fixture_joint(BodyPart::Shin(side), Some(thigh), [s * 0.1, 0.5, 0.01]);
    let foot = b.add_fixture_joint(BodyPart::Foot(side), Some(shin), [s * 0.1, 0.08, 0.0]);
    let toes = b.add_fixture_joint(BodyPart::Toes(side), Some(foot), [s * 0.1, 0.02, 0.14]);
    b.0[toes].tip = Some(DVec3::new(s * 0.1, 0.02, 0.2));
}

fn add_fixture_arm(b: &mut FixtureBodyBuilder, wear: BodyVariation, side: BodySide, chest: usize) {
    let s = side.side_sign();
    let first = b.0.len();
    let clavicle = b.add_fixture_joint(BodyPart::Clavicle(side), Some(chest), [s * 0.03, 1.43, 0.02]);
    let upper = b.add_fixture_joint(BodyPart::UpperArm(side), Some(clavicle), [s * 0.18, 1.43, 0.0]);
    let forearm = b.add_fixture_joint(BodyPart::Forearm(side), Some(upper), [s * 0.46, 1.43, 0.0]);
    let hand = b.add_fixture_joint(BodyPart::Hand(side), Some(forearm), [s * 0.71, 1.43, 0.0]);
    let wrist = DVec3::new(s * 0.71, 1.43, 0.0);
    let out = |x: f64, y: f64, z: f64| DVec3::new(s * x, y, z);
    let mut thumb_place = wrist + out(0.025, -0.012, 0.028);
    let along = out(0.68, -0.28, 0.68).normalize();
    let mut parent = hand;
    for (n, bone) in (0..3u8).zip([0.045, 0.033, 0.026]) {
        parent = b.add_fixture_joint(BodyPart::Thumb(side, n), Some(parent), thumb_place.into());
        thumb_place += along * bone;
        b.0[parent].tip = (n == 2).then_some(thumb_place);
    }
    let fingers = [(0.09, 0.026), (0.092, 0.005), (0.088, -0.014), (0.08, -0.03)];
    for (finger, (reach, z)) in HandFinger::ALL_FINGERS.into_iter().zip(fingers) {
        let mut parent = hand;
        if wear.metacarpals {
            let metacarpal_place = wrist + out(0.02, 0.0, z * 0.6);
            parent = b.add_fixture_joint(BodyPart::Finger(side, finger, 0), Some(parent), metacarpal_place.into());
        }
        let mut finger_place = wrist + out(reach, 0.0, z);
        let mut bend = wear.bent;
        for (n, bone) in (1..=wear.joints).zip([0.042, 0.026, 0.022]) {
            parent = b.add_fixture_joint(BodyPart::Finger(side, finger, n), Some(parent), finger_place.into());
            finger_place += out(bend.cos(), -bend.sin(), 0.1 * z).normalize() * bone;
            bend += wear.bent;
            b.0[parent].tip = (n == wear.joints).then_some(finger_place);
        }
    }
    let shoulder = b.0[upper].at;
    let turn = DQuat::from_rotation_z(-s * wear.lowered);
    for spec in &mut b.0[first + 1..] {
        spec.at = shoulder + turn * (spec.at - shoulder);
        spec.tip = spec.tip.map(|tip| shoulder + turn * (tip - shoulder));
    }
}

fn finish_fixture_skeleton(b: FixtureBodyBuilder, wear: BodyVariation) -> Skeleton {
    let place = |at: DVec3| wear.axes * at * wear.unit;
    let mut worn: Vec<(DVec3, DQuat)> = Vec::new();
    let mut joints = Vec::new();
    for (n, spec) in b.0.into_iter().enumerate() {
        let (at, turned) = (place(spec.at), (wear.frames)(n));
        let (from, above) = spec.parent.map_or((DVec3::ZERO, DQuat::IDENTITY), |p| worn[p]);
        let tip = spec.tip.filter(|_| wear.tips);
        joints.push(SkeletonJoint {
            name: spec.name,
            parent: spec.parent,
            offset: above.inverse() * (at - from),
            rest: (above.inverse() * turned).normalize(),
            tip: tip.map(|tip| turned.inverse() * (place(tip) - at)),
        });
        worn.push((at, turned));
    }
    Skeleton::new(joints).expect("the body is a tree")
}

/// Returns the same skeleton with other joint names.
pub(crate) fn rename_joints(skeleton: &Skeleton, name: impl Fn(usize, &str) -> String) -> Skeleton {
    let numbered_joints = skeleton.skeleton_joints().iter().enumerate();
    let joints = numbered_joints.map(|(n, joint)| SkeletonJoint {
        name: name(n, &joint.name),
        ..joint.clone()
    });
    Skeleton::new(joints.collect()).expect("names do not matter")
}

/// Returns roles that give every joint of [`fixture_body`] the part that it is named after, so that tests do not depend on the
/// detection of names.
pub(crate) fn fixture_joint_roles(skeleton: &Skeleton) -> crate::anatomy::AssignedJointRoles {
    let joints = skeleton.skeleton_joints().iter();
    let named = joints.filter_map(|joint| Some((joint.name.parse().ok()?, joint.name.clone())));
    crate::anatomy::AssignedJointRoles(named.collect())
}
