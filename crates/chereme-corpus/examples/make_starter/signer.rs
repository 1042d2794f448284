//! The body of the signer: a skeleton of the project's own design with the names that MotionBuilder uses.

use chereme_motion::axes::SpaceAxis;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, RotationOrder, Skeleton, SkeletonJoint};

/// The signer's name in the annotation files.
pub(crate) const NAME: &str = "Camille (made)";

/// Stature is 168 cm; lengths of limbs are shares of it after Drillis & Contini 1966.
/// Joint, parent, offset in centimetres at rest: a T-pose facing +Z, palms down.
const SPINE: [(&str, &str, [f64; 3]); 7] = [
    ("Hips", "", [0.0, 93.0, 0.0]),
    ("Spine", "Hips", [0.0, 10.0, -1.0]),
    ("Spine1", "Spine", [0.0, 12.0, -1.0]),
    ("Spine2", "Spine1", [0.0, 12.0, 0.0]),
    ("Neck", "Spine2", [0.0, 15.0, -0.5]),
    ("Neck1", "Neck", [0.0, 5.0, 0.8]),
    ("Head", "Neck1", [0.0, 4.0, 1.0]),
];

/// The joints of the left arm; for the right arm the first number is negated. `@` stands for the side's name.
const ARM: [(&str, &str, [f64; 3]); 23] = [
    ("@Shoulder", "Spine2", [2.5, 11.2, 1.0]),
    ("@Arm", "@Shoulder", [14.3, -0.6, -1.5]),
    ("@ForeArm", "@Arm", [29.0, 0.0, 0.0]),
    ("@Hand", "@ForeArm", [25.0, 0.0, 0.0]),
    ("@HandThumb1", "@Hand", [2.4, -1.2, 2.4]),
    ("@HandThumb2", "@HandThumb1", [3.3, -1.0, 2.6]),
    ("@HandThumb3", "@HandThumb2", [2.5, -0.7, 1.9]),
    ("@InHandIndex", "@Hand", [2.4, 0.0, 1.3]),
    ("@HandIndex1", "@InHandIndex", [6.3, 0.0, 1.1]),
    ("@HandIndex2", "@HandIndex1", [4.0, 0.0, 0.0]),
    ("@HandIndex3", "@HandIndex2", [2.4, 0.0, 0.0]),
    ("@InHandMiddle", "@Hand", [2.5, 0.0, 0.0]),
    ("@HandMiddle1", "@InHandMiddle", [6.1, 0.0, 0.0]),
    ("@HandMiddle2", "@HandMiddle1", [4.5, 0.0, 0.0]),
    ("@HandMiddle3", "@HandMiddle2", [2.8, 0.0, 0.0]),
    ("@InHandRing", "@Hand", [2.3, 0.0, -1.0]),
    ("@HandRing1", "@InHandRing", [5.8, 0.0, -1.0]),
    ("@HandRing2", "@HandRing1", [4.2, 0.0, 0.0]),
    ("@HandRing3", "@HandRing2", [2.6, 0.0, 0.0]),
    ("@InHandPinky", "@Hand", [2.1, 0.0, -1.8]),
    ("@HandPinky1", "@InHandPinky", [5.3, 0.0, -2.0]),
    ("@HandPinky2", "@HandPinky1", [3.3, 0.0, 0.0]),
    ("@HandPinky3", "@HandPinky2", [2.0, 0.0, 0.0]),
];

const LEG: [(&str, &str, [f64; 3]); 4] = [
    ("@UpLeg", "Hips", [8.6, -4.0, 0.0]),
    ("@Leg", "@UpLeg", [0.0, -41.5, 0.5]),
    ("@Foot", "@Leg", [0.0, -41.0, -1.5]),
    ("@ToeBase", "@Foot", [0.0, -5.0, 13.0]),
];

/// The ends of bones without a following joint, in centimetres, for the left side.
const TIPS: [(&str, [f64; 3]); 7] = [
    ("Head", [0.0, 17.0, 1.0]),
    ("@HandThumb3", [2.1, -0.6, 1.6]),
    ("@HandIndex3", [2.1, 0.0, 0.0]),
    ("@HandMiddle3", [2.3, 0.0, 0.0]),
    ("@HandRing3", [2.2, 0.0, 0.0]),
    ("@HandPinky3", [1.9, 0.0, 0.0]),
    ("@ToeBase", [0.0, 0.0, 7.0]),
];

/// Returns the skeleton in metres; parents come before their children, depth first.
pub(crate) fn skeleton() -> Skeleton {
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    let mut add = |table: &[(&str, &str, [f64; 3])], side: Option<BodySide>| {
        for &(name, parent, offset) in table {
            let named = |name: &str| name.replace('@', prefix(side));
            let parent = named(parent);
            let parent = joints.iter().position(|joint| joint.name == parent);
            let tip = TIPS.iter().find(|(end, _)| *end == name);
            joints.push(SkeletonJoint {
                tip: tip.map(|&(_, tip)| placed(tip, side)),
                ..SkeletonJoint::new(named(name), parent, placed(offset, side))
            });
        }
    };
    add(&SPINE, None);
    for table in [&ARM[..], &LEG[..]] {
        add(table, Some(BodySide::Left));
        add(table, Some(BodySide::Right));
    }
    Skeleton::new(joints).expect("the tables name parents first")
}

fn prefix(side: Option<BodySide>) -> &'static str {
    match side {
        None => "",
        Some(BodySide::Left) => "Left",
        Some(BodySide::Right) => "Right",
    }
}

fn placed([x, y, z]: [f64; 3], side: Option<BodySide>) -> DVec3 {
    DVec3::new(x * side.map_or(1.0, BodySide::side_sign), y, z) / 100.0
}

/// Returns the order of the rotation channels of a joint.
///
/// A forearm rotates about its length (X) by more than a right angle, which the middle axis cannot represent; with X as
/// the last axis its angles never jump.
pub(crate) fn rotation_order(joint: &str) -> RotationOrder {
    let turned = RotationOrder::new([SpaceAxis::Y, SpaceAxis::Z, SpaceAxis::X]);
    match turned {
        Some(order) if joint.ends_with("ForeArm") => order,
        _ => RotationOrder::ZXY_ORDER,
    }
}
