//! A synthetic signer whose hands take eight handshapes, for testing pictures.

use std::error::Error;

use chereme_motion::glam::{DMat3, DQuat, DVec3};
use chereme_motion::{BodySide, Clip, FrameRate, LocalPose, Skeleton, SkeletonJoint};

/// Flexions of the index, middle, ring and little finger; spread; the thumb's angles: out and across.
const SHAPES: [([f64; 4], f64, [f64; 2]); 8] = [
    ([0.0, 0.0, 0.0, 0.0], 0.28, [0.7, 0.0]),
    ([0.0, 0.0, 0.0, 0.0], 0.0, [0.1, 0.8]),
    ([0.0, 0.0, 1.5, 1.5], 0.0, [0.1, 1.1]),
    ([0.0, 0.0, 1.5, 1.5], 0.28, [0.1, 1.1]),
    ([1.5, 1.5, 1.5, 0.0], 0.4, [0.9, 0.0]),
    ([1.5, 1.5, 1.5, 1.5], 0.0, [0.1, 1.0]),
    ([0.75, 0.75, 0.75, 0.75], 0.0, [0.3, 0.7]),
    ([0.0, 1.5, 1.5, 1.5], 0.0, [0.1, 1.1]),
];

/// Returns 64 frames at 25 a second: 5, B, U, V, Y, S, O and an index finger, eight frames each.
pub(crate) fn handshapes() -> Result<Clip, Box<dyn Error>> {
    let skeleton = skeleton()?;
    let poses: Vec<LocalPose> = (0..64)
        .map(|frame| {
            let shape = SHAPES[frame / 8];
            let sway = (frame as f64 * 0.2).sin() * 0.04;
            pose(&skeleton, shape, sway)
        })
        .collect();
    Ok(Clip::from_poses(skeleton.into(), FrameRate::new(25, 1)?, &poses)?)
}

fn skeleton() -> Result<Skeleton, Box<dyn Error>> {
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    let mut add = |name: &str, parent: &str, offset: [f64; 3]| {
        let parent = joints.iter().position(|joint| joint.name == parent);
        joints.push(SkeletonJoint::new(name, parent, DVec3::from_array(offset)));
    };
    add("Hips", "", [0.0, 0.98, 0.0]);
    add("Spine", "Hips", [0.0, 0.10, 0.0]);
    add("Spine1", "Spine", [0.0, 0.12, 0.0]);
    add("Spine2", "Spine1", [0.0, 0.13, 0.0]);
    add("Neck", "Spine2", [0.0, 0.15, -0.01]);
    add("Head", "Neck", [0.0, 0.09, 0.01]);
    add("HeadTop_End", "Head", [0.0, 0.17, 0.02]);
    for side in BodySide::BOTH_SIDES {
        let (name, s) = (if side == BodySide::Right { "Right" } else { "Left" }, side.side_sign());
        let mut limb = |part: &str, parent: &str, offset: [f64; 3]| {
            let parent = parent.replace('*', name);
            add(&format!("{name}{part}"), &parent, [offset[0] * s, offset[1], offset[2]]);
        };
        limb("UpLeg", "Hips", [0.09, -0.06, 0.0]);
        limb("Leg", "*UpLeg", [0.0, -0.42, 0.0]);
        limb("Foot", "*Leg", [0.0, -0.42, 0.0]);
        limb("ToeBase", "*Foot", [0.0, -0.06, 0.12]);
        limb("Shoulder", "Spine2", [0.05, 0.11, 0.0]);
        limb("Arm", "*Shoulder", [0.125, -0.01, 0.0]);
        limb("ForeArm", "*Arm", [0.28, 0.0, 0.0]);
        limb("Hand", "*ForeArm", [0.25, 0.0, 0.0]);
        limb("HandThumb1", "*Hand", [0.025, -0.012, 0.028]);
        limb("HandThumb2", "*HandThumb1", [0.034, -0.008, 0.028]);
        limb("HandThumb3", "*HandThumb2", [0.026, 0.0, 0.020]);
        limb("HandThumb4", "*HandThumb3", [0.021, 0.0, 0.016]);
        for (finger, x, z, bones) in [
            ("Index", 0.092, 0.031, [0.043, 0.026, 0.022]),
            ("Middle", 0.095, 0.009, [0.047, 0.030, 0.024]),
            ("Ring", 0.089, -0.012, [0.043, 0.028, 0.023]),
            ("Pinky", 0.081, -0.032, [0.034, 0.020, 0.019]),
        ] {
            limb(&format!("Hand{finger}1"), "*Hand", [x, 0.0, z]);
            for (i, bone) in bones.into_iter().enumerate() {
                let parent = format!("*Hand{finger}{}", i + 1);
                limb(&format!("Hand{finger}{}", i + 2), &parent, [bone, 0.0, 0.0]);
            }
        }
    }
    Ok(Skeleton::new(joints)?)
}

fn pose(skeleton: &Skeleton, (flexions, spread, thumb): ([f64; 4], f64, [f64; 2]), sway: f64) -> LocalPose {
    let mut pose = skeleton.rest_pose();
    for side in BodySide::BOTH_SIDES {
        let s = side.side_sign();
        let name = if side == BodySide::Right { "Right" } else { "Left" };
        let find = |part: &str| skeleton.find_joint(&format!("{name}{part}"));
        let mut set = |part: &str, turn: DQuat| {
            if let Some(joint) = find(part) {
                pose.rotations[joint] = turn;
            }
        };
        let x = DVec3::X * s;
        let upper = DQuat::from_rotation_arc(x, DVec3::new(0.32 * s, -0.9, 0.25 + sway).normalize());
        let front = side == BodySide::Right;
        let forearm = if front {
            DVec3::new(0.12 * s, 0.75, 0.65)
        } else {
            DVec3::new(-0.65 * s, 0.15, 0.65)
        };
        let lower = DQuat::from_rotation_arc(x, forearm.normalize());
        let hand = if front {
            basis([x, DVec3::Z], [DVec3::Y, -x])
        } else {
            basis(
                [x, DVec3::Z],
                [DVec3::new(-0.75 * s, 0.6, 0.25), DVec3::new(0.3 * s, 0.8, 0.3)],
            )
        };
        set("Arm", upper);
        set("ForeArm", upper.inverse() * lower);
        set("Hand", lower.inverse() * hand);
        let bend = DVec3::new(0.0, 0.0, -s);
        let open = DVec3::new(0.0, s, 0.0);
        for (i, finger) in ["Index", "Middle", "Ring", "Pinky"].into_iter().enumerate() {
            let fan = (1.5 - i as f64) * spread * 0.66;
            let turn = DQuat::from_axis_angle(open, -fan) * DQuat::from_axis_angle(bend, flexions[i]);
            set(&format!("Hand{finger}1"), turn);
            set(
                &format!("Hand{finger}2"),
                DQuat::from_axis_angle(bend, flexions[i] * 1.05),
            );
            set(
                &format!("Hand{finger}3"),
                DQuat::from_axis_angle(bend, flexions[i] * 0.7),
            );
        }
        let root = DQuat::from_axis_angle(open, 0.5 - thumb[0]) * DQuat::from_axis_angle(bend, thumb[1] * 0.4);
        set("HandThumb1", root);
        set("HandThumb2", DQuat::from_axis_angle(open, thumb[1] * 0.6));
        set("HandThumb3", DQuat::from_axis_angle(open, thumb[1] * 0.7));
    }
    pose
}

/// Returns the rotation that takes two directions to two others.
fn basis(from: [DVec3; 2], to: [DVec3; 2]) -> DQuat {
    let frame = |[a, b]: [DVec3; 2]| {
        let a = a.normalize();
        let b = (b - a * a.dot(b)).normalize();
        DMat3::from_cols(a, b, a.cross(b))
    };
    DQuat::from_mat3(&(frame(to) * frame(from).transpose()))
}
