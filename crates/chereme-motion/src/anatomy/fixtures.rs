//! Skeletons for tests: one body with many variations.

pub(crate) mod conventions;
pub(crate) mod real;

use glam::{DQuat, DVec3};

use super::Part;
use crate::hand::{Finger, Side};
use crate::skeleton::{Joint, Skeleton};

/// The variation of the body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wear {
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

pub(crate) const PLAIN: Wear = Wear {
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
    let axis = DVec3::new(
        (x * 1.7).sin(),
        (x * 2.3 + 1.0).cos(),
        (x * 0.9 + 2.0).sin(),
    );
    DQuat::from_axis_angle(axis.normalize_or(DVec3::Y), x * 0.7)
}

pub(crate) fn wears() -> Vec<(&'static str, Wear)> {
    let z_up = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    vec![
        ("plain", PLAIN),
        (
            "bent",
            Wear {
                bent: 0.15,
                ..PLAIN
            },
        ),
        (
            "z-up cm",
            Wear {
                axes: z_up,
                unit: 100.0,
                bent: 0.1,
                ..PLAIN
            },
        ),
        (
            "A-pose",
            Wear {
                lowered: 0.8,
                bent: 0.1,
                ..PLAIN
            },
        ),
        (
            "turned frames",
            Wear {
                frames: any_turn,
                bent: 0.1,
                ..PLAIN
            },
        ),
        (
            "metacarpals",
            Wear {
                frames: any_turn,
                metacarpals: true,
                ..PLAIN
            },
        ),
        (
            "two joints",
            Wear {
                joints: 2,
                frames: any_turn,
                ..PLAIN
            },
        ),
        (
            "no tips",
            Wear {
                tips: false,
                frames: any_turn,
                bent: 0.2,
                ..PLAIN
            },
        ),
    ]
}

struct Spec {
    name: String,
    parent: Option<usize>,
    at: DVec3,
    tip: Option<DVec3>,
}

struct Builder(Vec<Spec>);

impl Builder {
    fn add(&mut self, part: Part, parent: Option<usize>, at: [f64; 3]) -> usize {
        self.0.push(Spec {
            name: part.to_string(),
            parent,
            at: at.into(),
            tip: None,
        });
        self.0.len() - 1
    }
}

/// Returns a body 1.75 m tall in a T-pose (or with lowered arms), whose joints are named after their parts.
pub(crate) fn body(wear: Wear) -> Skeleton {
    let mut b = Builder(Vec::new());
    let hips = b.add(Part::Hips, None, [0.0, 0.95, 0.0]);
    let spine = b.add(Part::Spine, Some(hips), [0.0, 1.07, 0.0]);
    let chest = b.add(Part::Chest, Some(spine), [0.0, 1.27, 0.0]);
    let neck = b.add(Part::Neck, Some(chest), [0.0, 1.48, 0.0]);
    let head = b.add(Part::Head, Some(neck), [0.0, 1.58, 0.01]);
    b.0[head].tip = Some(DVec3::new(0.0, 1.75, 0.01));
    for side in Side::BOTH {
        arm(&mut b, wear, side, chest);
        leg(&mut b, side, hips);
    }
    finish(b, wear)
}

fn leg(b: &mut Builder, side: Side, hips: usize) {
    let s = side.sign();
    let thigh = b.add(Part::Thigh(side), Some(hips), [s * 0.09, 0.92, 0.0]);
    let shin = b.add(Part::Shin(side), Some(thigh), [s * 0.1, 0.5, 0.01]);
    let foot = b.add(Part::Foot(side), Some(shin), [s * 0.1, 0.08, 0.0]);
    let toes = b.add(Part::Toes(side), Some(foot), [s * 0.1, 0.02, 0.14]);
    b.0[toes].tip = Some(DVec3::new(s * 0.1, 0.02, 0.2));
}

fn arm(b: &mut Builder, wear: Wear, side: Side, chest: usize) {
    let s = side.sign();
    let first = b.0.len();
    let clavicle = b.add(Part::Clavicle(side), Some(chest), [s * 0.03, 1.43, 0.02]);
    let upper = b.add(Part::UpperArm(side), Some(clavicle), [s * 0.18, 1.43, 0.0]);
    let forearm = b.add(Part::Forearm(side), Some(upper), [s * 0.46, 1.43, 0.0]);
    let hand = b.add(Part::Hand(side), Some(forearm), [s * 0.71, 1.43, 0.0]);
    let wrist = DVec3::new(s * 0.71, 1.43, 0.0);
    let out = |x: f64, y: f64, z: f64| DVec3::new(s * x, y, z);
    let mut at = wrist + out(0.025, -0.012, 0.028);
    let along = out(0.68, -0.28, 0.68).normalize();
    let mut parent = hand;
    for (n, bone) in (0..3u8).zip([0.045, 0.033, 0.026]) {
        parent = b.add(Part::Thumb(side, n), Some(parent), at.into());
        at += along * bone;
        b.0[parent].tip = (n == 2).then_some(at);
    }
    let fingers = [
        (0.09, 0.026),
        (0.092, 0.005),
        (0.088, -0.014),
        (0.08, -0.03),
    ];
    for (finger, (reach, z)) in Finger::ALL.into_iter().zip(fingers) {
        let mut parent = hand;
        if wear.metacarpals {
            let at = wrist + out(0.02, 0.0, z * 0.6);
            parent = b.add(Part::Finger(side, finger, 0), Some(parent), at.into());
        }
        let mut at = wrist + out(reach, 0.0, z);
        let mut bend = wear.bent;
        for (n, bone) in (1..=wear.joints).zip([0.042, 0.026, 0.022]) {
            parent = b.add(Part::Finger(side, finger, n), Some(parent), at.into());
            at += out(bend.cos(), -bend.sin(), 0.1 * z).normalize() * bone;
            bend += wear.bent;
            b.0[parent].tip = (n == wear.joints).then_some(at);
        }
    }
    let shoulder = b.0[upper].at;
    let turn = DQuat::from_rotation_z(-s * wear.lowered);
    for spec in &mut b.0[first + 1..] {
        spec.at = shoulder + turn * (spec.at - shoulder);
        spec.tip = spec.tip.map(|tip| shoulder + turn * (tip - shoulder));
    }
}

fn finish(b: Builder, wear: Wear) -> Skeleton {
    let place = |at: DVec3| wear.axes * at * wear.unit;
    let mut worn: Vec<(DVec3, DQuat)> = Vec::new();
    let mut joints = Vec::new();
    for (n, spec) in b.0.into_iter().enumerate() {
        let (at, turned) = (place(spec.at), (wear.frames)(n));
        let (from, above) = spec
            .parent
            .map_or((DVec3::ZERO, DQuat::IDENTITY), |p| worn[p]);
        let tip = spec.tip.filter(|_| wear.tips);
        joints.push(Joint {
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
pub(crate) fn renamed(skeleton: &Skeleton, name: impl Fn(usize, &str) -> String) -> Skeleton {
    let joints = skeleton.joints().iter().enumerate();
    let joints = joints.map(|(n, joint)| Joint {
        name: name(n, &joint.name),
        ..joint.clone()
    });
    Skeleton::new(joints.collect()).expect("names do not matter")
}

/// Returns roles that give every joint of [`body`] the part that it is named after, so that tests do not depend on the
/// detection of names.
pub(crate) fn roles(skeleton: &Skeleton) -> super::Roles {
    let joints = skeleton.joints().iter();
    let named = joints.filter_map(|joint| Some((joint.name.parse().ok()?, joint.name.clone())));
    super::Roles(named.collect())
}
