//! The skin of bodies whose rest pose no body can have.

use std::sync::Arc;

use chereme_figure::SignerBody;
use chereme_figure::body::group;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, HandFinger, LocalPose, Skeleton, SkeletonJoint};

#[path = "../examples/common/signer.rs"]
mod signer;

/// Returns the clip with every bone along its joint's own Z axis, those of the legs against it: its rest pose is a pole
/// that stands. Both collar bones begin in one place.
fn along_z(clip: &Clip, anatomy: &BodyAnatomy) -> Clip {
    let skeleton = clip.clip_skeleton();
    let rest = skeleton.rest_model_pose();
    let goes_on = |joint: &usize| {
        let part = anatomy.part_of(*joint);
        matches!(
            part,
            Some(BodyPart::Spine | BodyPart::Chest | BodyPart::Neck | BodyPart::Finger(_, HandFinger::Middle, _))
        )
    };
    let collars = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Clavicle(side)).expect("a collar"));
    let collar = (rest.model_joint_position(collars[0]) + rest.model_joint_position(collars[1])) / 2.0;
    let place = |joint: usize| match collars.contains(&joint) {
        true => collar,
        false => rest.model_joint_position(joint),
    };
    let mut own: Vec<DQuat> = Vec::new();
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    for joint in 0..skeleton.len() {
        let parent = skeleton.joint_parent(joint);
        let above = parent.map_or(DQuat::IDENTITY, |parent| own[parent]);
        let children = skeleton.joint_children(joint);
        let next = children.iter().find(|joint| goes_on(joint)).or(children.first());
        let along = next.and_then(|&next| (place(next) - place(joint)).try_normalize());
        let part = anatomy.part_of(joint);
        let is_leg = matches!(part, Some(BodyPart::Thigh(_) | BodyPart::Shin(_) | BodyPart::Foot(_)));
        let axis = if is_leg { DVec3::NEG_Z } else { DVec3::Z };
        own.push(along.map_or(above, |along| DQuat::from_rotation_arc(above * axis, along) * above));
        let from = parent.map_or(DVec3::ZERO, place);
        let name = skeleton.joint_at(joint).name.clone();
        joints.push(SkeletonJoint::new(
            name,
            parent,
            above.inverse() * (place(joint) - from),
        ));
    }
    let pole = Arc::new(Skeleton::new(joints).expect("a tree"));
    let poses: Vec<LocalPose> = (0..clip.clip_frame_count())
        .map(|frame| {
            let model = clip.model_pose(frame);
            let turned = |joint: usize| model.model_joint_rotation(joint) * own[joint];
            let mut pose = pole.rest_pose();
            for joint in 0..pole.len() {
                let above = pole.joint_parent(joint).map_or(DQuat::IDENTITY, turned);
                pose.rotations[joint] = (above.inverse() * turned(joint)).normalize();
            }
            pose.translations[0] = model.model_joint_position(0);
            pose
        })
        .collect();
    Clip::from_poses(pole, clip.clip_frame_rate(), &poses).expect("a clip")
}

#[test]
fn the_shoulders_stand_below_the_ears_whatever_the_rest_pose_is() {
    let plain = signer::handshapes().expect("the example's clip");
    let anatomy = BodyAnatomy::detect_anatomy(plain.clip_skeleton());
    let pole = along_z(&plain, &anatomy);
    let at_rest = BodyAnatomy::detect_anatomy(pole.clip_skeleton());
    assert!(!at_rest.is_posed());
    let known = at_rest.with_clip(&pole);
    let bodies = [(&plain, &anatomy), (&pole, &known)];
    let bodies = bodies.map(|(clip, anatomy)| SignerBody::new(clip.clip_skeleton(), anatomy));
    for frame in [0, 20, 40, 60] {
        let poses = [&plain, &pole].map(|clip| clip.model_pose(frame));
        let ear = known.landmark_place_position(pole.clip_skeleton(), &poses[1], "right-earlobe");
        let ear = ear.expect("an ear").y as f32;
        let [usual, drawn] = [0, 1].map(|n| bodies[n].posed_mesh(&poses[n]));
        let clothes = [
            group::TORSO_GROUP,
            group::arm_group(BodySide::Right),
            group::arm_group(BodySide::Left),
        ];
        let highest = drawn
            .vertices
            .iter()
            .filter(|it| clothes.contains(&it.group))
            .map(|it| it.position.y)
            .fold(f32::NEG_INFINITY, f32::max);
        assert!(highest < ear - 0.02, "{frame}: {highest} {ear}");
        // Head, trunk, arms and hands are those of the body whose rest pose is a T-pose.
        let pairs = usual.vertices.iter().zip(&drawn.vertices);
        let own = pairs.filter(|(a, _)| a.group != group::REMAINING_BODY_GROUP);
        let far = own.map(|(a, b)| a.position.distance(b.position));
        let far = far.fold(0.0, f32::max);
        assert!(far < 0.04, "{frame}: {far} m off");
    }
}
