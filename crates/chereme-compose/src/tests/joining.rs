//! Pieces that are joined, movement on another body, and the speed that steps add.

use crate::{evaluate_recipe, resolve_recipe};
use std::sync::Arc;

use chereme_motion::glam::DQuat;
use chereme_motion::{BodyAnatomy, JointChannel, ModelPose, Skeleton, SkeletonJoint};

use super::*;
use crate::sources::MovementMaterial;

/// Returns material of other joints and channels under another name.
fn remade(
    material: &MovementMaterial,
    gloss: &str,
    joints: Vec<SkeletonJoint>,
    channels: Vec<JointChannel>,
) -> MovementMaterial {
    let skeleton = Arc::new(Skeleton::new(joints).expect("a tree"));
    let clip = Clip::new(skeleton, material.clip.clip_frame_rate(), channels).expect("a clip");
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton()).with_clip(&clip);
    MovementMaterial {
        address: format!("token:{gloss}"),
        hash: gloss.to_owned(),
        gloss: gloss.to_owned(),
        anatomy: Arc::new(anatomy),
        clip,
        ..material.clone()
    }
}

/// Puts a node above the root, which is turned and moved; the root makes up for that.
pub(super) fn with_armature(material: &MovementMaterial, gloss: &str) -> MovementMaterial {
    let turn = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let place = DVec3::new(0.3, -0.2, 0.5);
    let mut joints = vec![SkeletonJoint::new("Armature", None, DVec3::ZERO)];
    joints.extend(material.clip.clip_skeleton().skeleton_joints().iter().cloned());
    for joint in &mut joints[1..] {
        joint.parent = Some(joint.parent.map_or(0, |parent| parent + 1));
    }
    let frames = material.clip.clip_frame_count();
    let mut channels = material.clip.clone().into_channels();
    let back = turn.inverse();
    for rotation in &mut channels[0].rotations {
        *rotation = back * *rotation;
    }
    for at in channels[0].translations.iter_mut().flatten() {
        *at = back * (*at - place);
    }
    channels.insert(
        0,
        JointChannel {
            rotations: vec![turn; frames],
            translations: Some(vec![place; frames]),
        },
    );
    remade(material, gloss, joints, channels)
}

/// Moves the body to another place.
fn moved(material: &MovementMaterial, gloss: &str, by: DVec3) -> MovementMaterial {
    let mut channels = material.clip.clone().into_channels();
    for at in channels[0].translations.iter_mut().flatten() {
        *at += by;
    }
    remade(
        material,
        gloss,
        material.clip.clip_skeleton().skeleton_joints().to_vec(),
        channels,
    )
}

/// Gives a body toes and turns its feet out; the axes of its joints are plain.
pub(super) fn with_toes(material: &MovementMaterial, gloss: &str) -> MovementMaterial {
    let mut joints = material.clip.clip_skeleton().skeleton_joints().to_vec();
    let mut channels = material.clip.clone().into_channels();
    for side in BodySide::BOTH_SIDES {
        let foot = material.anatomy.part_joint(BodyPart::Foot(side)).expect("a foot");
        let turn = DQuat::from_rotation_y(0.2 * side.side_sign());
        channels[foot].rotations.fill(turn);
        let name = if side == BodySide::Left {
            "LeftToeBase"
        } else {
            "RightToeBase"
        };
        joints.push(SkeletonJoint {
            tip: Some(DVec3::new(0.0, -0.01, 0.06)),
            ..SkeletonJoint::new(name, Some(foot), DVec3::new(0.0, -0.06, 0.13))
        });
        channels.push(JointChannel {
            rotations: vec![DQuat::from_rotation_x(-0.1); material.clip.clip_frame_count()],
            translations: None,
        });
    }
    remade(material, gloss, joints, channels)
}

/// Lays the bone of every joint of a limb with one child, or with a tip, along that joint's Z axis, without any rest
/// rotation: no body can assume such a rest pose, and the same movement has other rotations.
pub(super) fn along_one_axis(material: &MovementMaterial, gloss: &str) -> MovementMaterial {
    let skeleton = material.clip.clip_skeleton();
    let turns: Vec<DQuat> = (0..skeleton.len())
        .map(|joint| {
            let part = material.anatomy.part_of(joint);
            let bone = match skeleton.joint_children(joint) {
                _ if part.is_none_or(|part| part.part_side().is_none()) => None,
                [child] => Some(skeleton.joint_at(*child).offset),
                [] => skeleton.joint_at(joint).tip,
                _ => None,
            };
            let bone = bone.and_then(DVec3::try_normalize);
            bone.map_or(DQuat::IDENTITY, |bone| DQuat::from_rotation_arc(DVec3::Z, bone))
        })
        .collect();
    let above = |joint: usize| {
        skeleton
            .joint_parent(joint)
            .map_or(DQuat::IDENTITY, |parent| turns[parent])
    };
    let joints = skeleton
        .skeleton_joints()
        .iter()
        .enumerate()
        .map(|(n, joint)| SkeletonJoint {
            offset: above(n).inverse() * joint.offset,
            rest: DQuat::IDENTITY,
            tip: joint.tip.map(|tip| turns[n].inverse() * tip),
            ..joint.clone()
        });
    let joints = joints.collect();
    let mut channels = material.clip.clone().into_channels();
    for (n, channel) in channels.iter_mut().enumerate() {
        for rotation in &mut channel.rotations {
            *rotation = (above(n).inverse() * *rotation * turns[n]).normalize();
        }
    }
    remade(material, gloss, joints, channels)
}

/// Rolls the thumbs of a body about their bones at rest, and gives its metacarpals another direction.
pub(super) fn with_rolled_thumbs(material: &MovementMaterial, gloss: &str) -> MovementMaterial {
    let mut joints = material.clip.clip_skeleton().skeleton_joints().to_vec();
    for side in BodySide::BOTH_SIDES {
        let joint = |n| material.anatomy.part_joint(BodyPart::Thumb(side, n)).expect("a thumb");
        let bone = joints[joint(1)].offset.normalize();
        let roll = DQuat::from_axis_angle(bone, 0.9) * DQuat::from_rotation_y(0.2);
        joints[joint(0)].rest *= roll;
    }
    remade(material, gloss, joints, material.clip.clone().into_channels())
}

fn evaluated(shelf: &Shelf, recipe: &str) -> Result<GeneratedMovement, MakeError> {
    let parsed: crate::Recipe = recipe.parse().expect(recipe);
    evaluate_recipe(&resolve_recipe(&parsed, shelf)?)
}

fn transition(made: &GeneratedMovement) -> std::ops::Range<usize> {
    let mut notes = made.notes.iter();
    let note = notes.find(|note| note.about == NoteSubject::Transition);
    made.clip.clip_frame_rate().frames_in(note.expect("a transition").span)
}

fn path(made: &GeneratedMovement, part: BodyPart) -> Vec<DVec3> {
    made.clip.joint_path(made.anatomy.part_joint(part).expect("a part"))
}

#[test]
fn joined_pieces_stand_on_one_floor_and_the_hips_go_straight() {
    let mut shelf = Shelf::new();
    let own = |gloss: &str| Shelf::new().materials[gloss].clone();
    for more in [
        with_armature(&own("BOL"), "ARMATURE"),
        with_armature(&own("CHAT"), "SMALL-ARMATURE"),
        moved(&own("CHAT"), "HIGH", DVec3::new(1.0, 0.33, -2.0)),
        along_one_axis(&own("BOL"), "LINE"),
    ] {
        shelf.materials.insert(more.gloss.clone(), more);
    }
    let glosses: Vec<String> = shelf.materials.keys().cloned().collect();
    for first in &glosses {
        for second in &glosses {
            let recipe = format!("{first} then {second}");
            let made = evaluated(&shelf, &recipe).expect(&recipe);
            assert!(made.report.warnings.is_empty(), "{recipe}: {:?}", made.report.warnings);
            let gap = transition(&made);
            let hips = path(&made, BodyPart::Hips);
            let (start, end) = (hips[gap.start - 1], hips[gap.end]);
            let line = end - start;
            for at in &hips[gap.clone()] {
                let share = (*at - start).dot(line) / line.length_squared().max(1e-12);
                let off = at.distance(start + line * share.clamp(0.0, 1.0));
                assert!(off < 0.02, "{recipe}: hips {off} m off their line");
            }
            for side in BodySide::BOTH_SIDES {
                let foot = path(&made, BodyPart::Foot(side));
                for at in &foot {
                    let off = (at.y - foot[0].y).abs();
                    assert!(off < 0.01, "{recipe}: a foot {off} m off the floor");
                }
            }
            let fast = hips.windows(2).map(|pair| pair[0].distance(pair[1]) * 120.0);
            let fast = fast.fold(0.0, f64::max);
            assert!(fast < 0.5, "{recipe}: hips at {fast} m/s");
        }
    }
}

#[test]
fn another_recording_of_one_signer_keeps_its_rotations() {
    let mut shelf = Shelf::new();
    let own = shelf.materials["BOL"].clone();
    let mut joints = own.clip.clip_skeleton().skeleton_joints().to_vec();
    for joint in &mut joints {
        joint.offset *= 1.03;
    }
    // The first recording has a marker that the second lacks.
    let first = shelf.materials["ESCARGOT"].clone();
    let mut marked = first.clip.clip_skeleton().skeleton_joints().to_vec();
    marked.push(SkeletonJoint::new("T10", Some(0), DVec3::new(0.0, 0.1, -0.1)));
    let mut channels = first.clip.clone().into_channels();
    channels.push(JointChannel {
        rotations: vec![DQuat::IDENTITY; first.clip.clip_frame_count()],
        translations: None,
    });
    let second = remade(&own, "LONG", joints, own.clip.clone().into_channels());
    let stranger = MovementMaterial {
        signer: Some("signer:7".into()),
        ..second.clone()
    };
    shelf
        .materials
        .insert("MARKED".into(), remade(&first, "MARKED", marked, channels));
    shelf.materials.insert("LONG".into(), second);
    let put = |made: &GeneratedMovement| {
        let did = &made.report.steps.last().expect("a join").did;
        did.iter().any(|did| did.contains("put on the first one's body"))
    };
    let made = evaluated(&shelf, "MARKED then LONG").expect("joined");
    assert!(!put(&made));
    let (last, end) = (made.clip.clip_frame_count() - 1, own.clip.clip_frame_count() - 1);
    for joint in 1..own.clip.clip_skeleton().len() {
        let [is, was] =
            [(&made.clip, last), (&own.clip, end)].map(|(clip, at)| clip.joint_channel(joint).rotations[at]);
        assert_eq!(is, was, "{joint}");
    }
    shelf.materials.insert("LONG".into(), stranger);
    assert!(put(&evaluated(&shelf, "MARKED then LONG").expect("joined")));
}

#[test]
fn feet_and_thumbs_point_alike_on_every_body() {
    let toes = with_toes(&Shelf::new().materials["BOL"], "TOES");
    let bodies = [
        along_one_axis(&toes, "LINE"),
        with_rolled_thumbs(&toes, "ROLLED"),
        with_armature(&along_one_axis(&toes, "LINE"), "ARMATURE"),
        toes,
    ];
    for from in &bodies {
        for onto in &bodies {
            let skeleton = onto.clip.clip_skeleton();
            let made =
                crate::on_body(&from.clip, &from.anatomy, from.handedness, skeleton, &onto.anatomy).expect("moved");
            for frame in (0..made.clip.clip_frame_count()).step_by(29) {
                let pair = [(from, from.clip.model_pose(frame)), (onto, made.clip.model_pose(frame))];
                let [before, after] = pair.map(|(body, model)| bones(body, &model));
                for ((part, before), (_, after)) in before.into_iter().zip(after) {
                    let angle = before.angle_between(after).to_degrees();
                    let recipe = format!("{} on {}", from.gloss, onto.gloss);
                    assert!(angle < 5.0, "{recipe}: {part} is turned by {angle}°");
                }
            }
        }
    }
}

/// Returns the directions of the bones of feet and thumbs.
fn bones(body: &MovementMaterial, model: &ModelPose) -> Vec<(BodyPart, DVec3)> {
    let (skeleton, anatomy) = (body.clip.clip_skeleton(), &body.anatomy);
    let mut bones = Vec::new();
    for side in BodySide::BOTH_SIDES {
        let thumb = [0, 1, 2].map(|n| BodyPart::Thumb(side, n));
        for chain in [&[BodyPart::Foot(side), BodyPart::Toes(side)][..], &thumb[..]] {
            for (n, &part) in chain.iter().enumerate() {
                let joint = anatomy.part_joint(part).expect("a joint");
                let end = match chain.get(n + 1) {
                    Some(&next) => model.model_joint_position(anatomy.part_joint(next).expect("a joint")),
                    None => model.bone_tip_position(skeleton, joint).expect("a tip"),
                };
                bones.push((part, (end - model.model_joint_position(joint)).normalize()));
            }
        }
    }
    bones
}

#[test]
fn what_a_step_adds_to_the_speed_is_warned_of_and_refused() {
    let warned = |recipe: &str| made(recipe).report.warnings.join("\n");
    assert_eq!(warned("ESCARGOT | retime 50%"), "");
    let text = warned("ESCARGOT | retime to 0.15s");
    assert!(text.contains("m/s at the wrists"), "{text}");
    for refused in [
        "ESCARGOT | retime 5%",
        "ESCARGOT | retime to 0.04s",
        "ESCARGOT | repeat 3 tempo 20",
    ] {
        let error = make(refused).expect_err(refused);
        assert!(matches!(error.cause, StepError::Rushed { .. }), "{error}");
        assert!(error.to_string().contains("give it more time"), "{error}");
    }
    let did = made("ESCARGOT then BOL").report.steps[2].did.join("\n");
    for part in ["hips", "wrists", "feet"] {
        assert!(did.contains(&format!("m/s at the {part} between the pieces")), "{did}");
    }
}

#[test]
fn the_speed_of_a_capture_itself_is_never_refused() {
    let mut shelf = Shelf::new();
    let mut odd = shelf.materials["BOL"].clone();
    let mut channels = odd.clip.clone().into_channels();
    let joint = odd
        .anatomy
        .part_joint(BodyPart::UpperArm(BodySide::Right))
        .expect("an arm");
    channels[joint].rotations[40] *= DQuat::from_rotation_y(2.0);
    odd.clip = Clip::new(odd.clip.clip_skeleton().clone(), odd.clip.clip_frame_rate(), channels).expect("a clip");
    shelf.materials.insert("BOL".into(), odd);
    for recipe in [
        "BOL",
        "BOL | reverse",
        "BOL | swap",
        "BOL then ESCARGOT",
        "LIMACE then BOL",
    ] {
        evaluated(&shelf, recipe).expect(recipe);
    }
}
