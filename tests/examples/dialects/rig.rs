//! Transfers a capture to the skeleton of a dialect, and writes it as BVH.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

use chereme_corpus::DisplayedMovement;
use chereme_formats::bvh::bvh_convert;
use chereme_formats::bvh::raw::{BvhChannel as Column, BvhWriter, FileNumber, MotionBlock};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{
    BodyPart, BodySide, Clip, FingerAngles, HandAngles, HandFinger, JointChannel, LocalPose, ModelPose, Skeleton,
    SkeletonJoint,
};

use crate::Result;
use crate::dialect::Dialect;
use crate::read::{SIDE, shapes};

/// The number of frames for which each handshape is held.
const HOLD: usize = 4;

/// The capture with every handshape on its right hand, and the frames in which each is read.
pub(crate) struct Staged {
    pub(crate) clip: Clip,
    pub(crate) frames: Vec<usize>,
}

/// Puts every handshape of the inventory on the right hand, each in another frame of the capture.
pub(crate) fn staged(source: &DisplayedMovement) -> Result<Staged> {
    let (clip, anatomy) = (&source.clip, &source.anatomy);
    let active = chereme_motion::ends::activity_frames(clip, anatomy).unwrap_or(0..clip.clip_frame_count());
    let shapes = shapes();
    let (mut poses, mut frames) = (Vec::new(), Vec::new());
    for (n, (_, angles)) in shapes.iter().enumerate() {
        let frame = active.start + n * (active.len() - 1) / shapes.len().max(1);
        let mut pose = clip.clip_pose_at(frame);
        if !anatomy.set_hand_angles(clip.clip_skeleton(), SIDE, angles, &mut pose) {
            return Err("the capture has no fingers".into());
        }
        frames.push(poses.len() + HOLD / 2);
        poses.extend(vec![pose; HOLD]);
    }
    let clip = Clip::from_poses(clip.clip_skeleton().clone(), clip.clip_frame_rate(), &poses)?;
    Ok(Staged { clip, frames })
}

/// Returns the posture of a hand whose straightest finger is bent by `lax`, and whose fist is as usual.
fn lax(angles: &HandAngles, lax: f64) -> HandAngles {
    let mut lazy = *angles;
    let bend = |angle: f64, full: f64| lax + angle * (1.0 - lax / full);
    for finger in &mut lazy.fingers {
        for (angle, full) in finger.flexion.iter_mut().zip([1.5, 1.7, 1.2]) {
            *angle = bend(*angle, full);
        }
    }
    lazy.thumb.radial += 0.2 * lax;
    lazy.thumb.palmar += 0.2 * lax;
    lazy.thumb.flexion = lazy.thumb.flexion.map(|angle| angle + 0.25 * lax);
    lazy
}

/// A joint of the dialect's skeleton.
struct Bone {
    name: String,
    parent: Option<usize>,
    /// The joint of the capture whose rotation it has.
    of: usize,
    /// Its position in that joint's space.
    at: DVec3,
    tip: Option<DVec3>,
    finger: bool,
}

/// Writes the movement in a dialect; returns how many frames come before it.
pub(crate) fn write(source: &DisplayedMovement, staged: &Staged, dialect: &Dialect, path: &Path) -> Result<usize> {
    let clip = &staged.clip;
    let mut bones = bones(source, dialect);
    let rest = rest(source, dialect);
    if dialect.pole {
        join_collars(source, &rest, &mut bones);
    }
    let posture = |frame: usize| {
        let mut pose = clip.clip_pose_at(frame);
        if dialect.lax > 0.0
            && let Some(angles) = source.anatomy.hand_angles(clip.clip_skeleton(), SIDE, &pose)
        {
            let angles = lax(&angles, dialect.lax);
            let skeleton = clip.clip_skeleton();
            source.anatomy.set_hand_angles(skeleton, SIDE, &angles, &mut pose);
        }
        ModelPose::from_local_pose(clip.clip_skeleton(), &pose)
    };
    let mut models: Vec<ModelPose> = (0..clip.clip_frame_count()).map(posture).collect();
    let prefix = if dialect.odd { 2 } else { 0 };
    for _ in 0..prefix {
        models.insert(0, t_pose_far_away(source, &clip.clip_pose_at(0)));
    }
    let turn = if dialect.z_up {
        DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2)
    } else {
        DQuat::IDENTITY
    };
    let unit = |v: DVec3| turn * v * dialect.unit;
    let place = |model: &ModelPose, bone: &Bone| unit(model.joint_point_to_model(bone.of, bone.at));
    // The wrapper is somewhere else and turned; the hips below it make up for that.
    let more = usize::from(dialect.wrapped.is_some());
    let (wrap, wrapped_turn) = match dialect.wrapped {
        Some([x, y]) => (
            unit(DVec3::new(0.4, 0.1, -1.3)),
            DQuat::from_rotation_x(x) * DQuat::from_rotation_y(y),
        ),
        None => (DVec3::ZERO, DQuat::IDENTITY),
    };
    let own = match dialect.pole {
        true => own_axes(source, &bones, |bone| place(&rest, bone)),
        false => vec![DQuat::IDENTITY; bones.len()],
    };
    let axes_above = |bone: &Bone| bone.parent.map_or(DQuat::IDENTITY, |parent| own[parent]);
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    if dialect.wrapped.is_some() {
        joints.push(SkeletonJoint::new("RootNode", None, DVec3::ZERO));
    }
    for (bone, own) in bones.iter().zip(&own) {
        let at = place(&rest, bone);
        let from = bone.parent.map_or(DVec3::ZERO, |parent| place(&rest, &bones[parent]));
        let parent = bone.parent.map(|parent| parent + more);
        joints.push(SkeletonJoint {
            tip: bone.tip.map(|tip| {
                let joint = rest.model_joint_rotation(bone.of);
                own.inverse() * unit(joint * tip)
            }),
            ..SkeletonJoint::new(
                format!("{}{}", dialect.space, bone.name),
                parent.or(dialect.wrapped.map(|_| 0)),
                axes_above(bone).inverse() * (at - from),
            )
        });
    }
    let body = joints.len();
    let markers = if dialect.markers { markers(source) } else { Vec::new() };
    for (name, joint) in &markers {
        let at = unit(rest.model_joint_position(*joint));
        joints.push(SkeletonJoint::new(format!("{}{name}", dialect.space), Some(0), at));
    }
    let mut noise = Noise(17);
    let mut channels: Vec<JointChannel> = joints.iter().map(|_| JointChannel::default()).collect();
    for model in &models {
        // The rotation of each bone from rest, in the file's axes.
        let turned: Vec<DQuat> = bones
            .iter()
            .map(|bone| {
                let world = model.model_joint_rotation(bone.of) * rest.model_joint_rotation(bone.of).inverse();
                turn * world * turn.inverse() * noise.turn(dialect.noise)
            })
            .collect();
        let mut push = |joint: usize, rotation: DQuat, at: DVec3| {
            channels[joint].rotations.push(rotation.normalize());
            channels[joint].translations.get_or_insert_default().push(at);
        };
        if dialect.wrapped.is_some() {
            push(0, wrapped_turn, wrap);
        }
        for (n, bone) in bones.iter().enumerate() {
            let at = place(model, bone);
            let (above, from) = match bone.parent {
                Some(parent) => (turned[parent], place(model, &bones[parent])),
                None => (wrapped_turn, wrap),
            };
            let above = above * axes_above(bone);
            push(
                n + more,
                above.inverse() * turned[n] * own[n],
                above.inverse() * (at - from),
            );
        }
        for (n, (_, joint)) in markers.iter().enumerate() {
            let at = unit(model.model_joint_position(*joint) + DVec3::new(0.0, 0.02, 0.03));
            push(body + n, DQuat::IDENTITY, wrapped_turn.inverse() * (at - wrap));
        }
    }
    let file = Arc::new(Skeleton::new(joints)?);
    let placed = |joint: usize| {
        let root = file.joint_parent(joint).is_none_or(|parent| parent < more);
        root || dialect.broken || joint >= body
    };
    for (joint, channel) in channels.iter_mut().enumerate() {
        if !placed(joint) {
            channel.translations = None;
        }
    }
    let clip = Clip::new(file.clone(), clip.clip_frame_rate(), channels)?;
    let mut hierarchy = bvh_convert::hierarchy_from_skeleton(&file, 6);
    for (joint, raw) in hierarchy.joints.iter_mut().enumerate() {
        let positions = [Column::Xposition, Column::Yposition, Column::Zposition];
        raw.channels.retain(|channel| !channel.is_position());
        if placed(joint) {
            raw.channels.splice(0..0, positions);
        }
    }
    let columns = bvh_convert::columns_from_clip(&clip, &hierarchy, 6)?;
    if dialect.broken {
        for (joint, _) in bones.iter().enumerate().filter(|(_, bone)| bone.finger) {
            let last = bones.iter().all(|other| other.parent != Some(joint));
            if last || joint % 3 == 0 {
                let wrong = [60.0, -7.0, 13.0].map(|cm: f64| (cm / 100.0 * dialect.unit).to_string());
                for (slot, text) in hierarchy.joints[joint + more].offset.iter_mut().zip(wrong) {
                    *slot = text.parse::<FileNumber>()?;
                }
            }
        }
    }
    let time: FileNumber = format!("{:.9}", clip.clip_frame_rate().frame_time()).parse()?;
    let motion = Some((Some(&time), clip.clip_frame_count() as u64));
    let mut writer = BvhWriter::new(BufWriter::new(File::create(path)?), &hierarchy, motion)?;
    writer.write_motion_block(&MotionBlock {
        first_frame: 0,
        frames: clip.clip_frame_count(),
        columns,
    })?;
    writer.finish_bvh_writing()?;
    Ok(prefix)
}

/// Returns the joints of the dialect: those of the capture, and those that the dialect adds.
fn bones(source: &DisplayedMovement, dialect: &Dialect) -> Vec<Bone> {
    let (skeleton, anatomy) = (source.clip.clip_skeleton(), &source.anatomy);
    let mut bones: Vec<Bone> = Vec::new();
    let mut known: Vec<Option<usize>> = vec![None; skeleton.len()];
    for (index, joint) in skeleton.skeleton_joints().iter().enumerate() {
        let part = anatomy.part_of(index);
        // A last joint that is not a part of the body is the end of a bone.
        if part.is_none() && skeleton.joint_children(index).is_empty() {
            continue;
        }
        let last = matches!(part, Some(BodyPart::Finger(_, _, 3) | BodyPart::Thumb(_, 2)));
        if dialect.short && last {
            if let Some(parent) = joint.parent.and_then(|parent| known[parent]) {
                bones[parent].tip = Some(joint.offset);
            }
            continue;
        }
        let mut parent = joint.parent.and_then(|parent| known[parent]);
        if let Some(BodyPart::Finger(side, finger, 1)) = part
            && dialect.metacarpals
            && anatomy.part_joint(BodyPart::Finger(side, finger, 0)).is_none()
            && let Some(hand) = anatomy.part_joint(BodyPart::Hand(side))
        {
            bones.push(Bone {
                name: (dialect.part)(BodyPart::Finger(side, finger, 0)),
                parent,
                of: hand,
                at: joint.offset * 0.3,
                tip: None,
                finger: false,
            });
            parent = Some(bones.len() - 1);
        }
        let digit = matches!(part, Some(BodyPart::Thumb(..) | BodyPart::Finger(..)));
        let tip = joint.tip.or_else(|| {
            let [child] = *skeleton.joint_children(index) else {
                return None;
            };
            let ends = anatomy.part_of(child).is_none() && skeleton.joint_children(child).is_empty();
            ends.then(|| skeleton.joint_at(child).offset)
        });
        let tip = tip.or_else(|| {
            let last = skeleton.joint_children(index).is_empty() && digit;
            let back = anatomy.is_posed() || joint.rest == DQuat::IDENTITY;
            (last && back).then(|| joint.offset * 0.8)
        });
        let ends = dialect.ends
            && digit
            && skeleton
                .joint_children(index)
                .iter()
                .all(|&c| anatomy.part_of(c).is_none());
        bones.push(Bone {
            name: part.map_or_else(|| format!("helper{index}"), dialect.part),
            parent,
            of: index,
            at: DVec3::ZERO,
            tip: tip.filter(|_| !ends),
            finger: digit,
        });
        known[index] = Some(bones.len() - 1);
        if let Some(tip) = tip.filter(|_| ends) {
            let name = match part {
                Some(BodyPart::Finger(side, finger, n)) => (dialect.part)(BodyPart::Finger(side, finger, n + 1)),
                Some(BodyPart::Thumb(side, n)) => (dialect.part)(BodyPart::Thumb(side, n + 1)),
                _ => format!("end{index}"),
            };
            bones.push(Bone {
                name,
                parent: known[index],
                of: index,
                at: tip,
                tip: None,
                finger: true,
            });
        }
    }
    bones
}

/// Moves both collar bones to the middle between them.
fn join_collars(source: &DisplayedMovement, rest: &ModelPose, bones: &mut [Bone]) {
    let collar = |side| source.anatomy.part_joint(BodyPart::Clavicle(side));
    let (Some(right), Some(left)) = (collar(BodySide::Right), collar(BodySide::Left)) else {
        return;
    };
    let middle = (rest.model_joint_position(right) + rest.model_joint_position(left)) / 2.0;
    for bone in bones.iter_mut().filter(|bone| [right, left].contains(&bone.of)) {
        bone.at = rest.model_joint_rotation(bone.of).inverse() * (middle - rest.model_joint_position(bone.of));
    }
}

/// Returns for each bone the rotation whose Z axis is the bone at rest, or the opposite in the legs: a pole that stands.
fn own_axes(source: &DisplayedMovement, bones: &[Bone], place: impl Fn(&Bone) -> DVec3) -> Vec<DQuat> {
    let goes_on = |bone: &&Bone| {
        let part = source.anatomy.part_of(bone.of);
        matches!(
            part,
            Some(BodyPart::Spine | BodyPart::Chest | BodyPart::Neck | BodyPart::Finger(_, HandFinger::Middle, _))
        )
    };
    let mut own: Vec<DQuat> = Vec::new();
    for (n, bone) in bones.iter().enumerate() {
        let above = bone.parent.map_or(DQuat::IDENTITY, |parent| own[parent]);
        let children = bones.iter().filter(|child| child.parent == Some(n));
        let next = children.clone().find(goes_on).or(children.clone().next());
        let along = next.and_then(|next| (place(next) - place(bone)).try_normalize());
        let part = source.anatomy.part_of(bone.of);
        let is_leg = matches!(part, Some(BodyPart::Thigh(_) | BodyPart::Shin(_) | BodyPart::Foot(_)));
        let axis = if is_leg { DVec3::NEG_Z } else { DVec3::Z };
        own.push(match along {
            Some(along) => DQuat::from_rotation_arc(above * axis, along) * above,
            None => above,
        });
    }
    own
}

/// Returns the rest posture of the dialect: arms out to the sides and lowered, fingers bent.
fn rest(source: &DisplayedMovement, dialect: &Dialect) -> ModelPose {
    let (skeleton, anatomy) = (source.clip.clip_skeleton(), &source.anatomy);
    let mut pose = t_pose(source, &source.clip.clip_pose_at(0), dialect.lowered);
    for side in BodySide::BOTH_SIDES {
        let bent = FingerAngles {
            spread: 0.0,
            flexion: [dialect.bent; 3],
        };
        let mut angles = HandAngles {
            fingers: [bent; 4],
            ..HandAngles::default()
        };
        angles.thumb.radial = 0.5 * (1.0 - dialect.bent).max(0.0);
        angles.thumb.palmar = 0.4 * dialect.bent;
        angles.thumb.flexion = [0.5 * dialect.bent; 2];
        angles.thumb.opposition = dialect.opposed;
        anatomy.set_hand_angles(skeleton, side, &angles, &mut pose);
    }
    ModelPose::from_local_pose(skeleton, &pose)
}

/// Stretches the arms of a posture out to the sides, lowered by an angle.
fn t_pose(source: &DisplayedMovement, from: &LocalPose, lowered: f64) -> LocalPose {
    let (skeleton, anatomy) = (source.clip.clip_skeleton(), &source.anatomy);
    let mut pose = from.clone();
    for side in BodySide::BOTH_SIDES {
        let Some(arm) = anatomy.arm_chain(side) else {
            continue;
        };
        for (joint, end) in [(arm.upper, arm.forearm), (arm.forearm, arm.hand)] {
            let model = ModelPose::from_local_pose(skeleton, &pose);
            let Some(body) = anatomy.body_frame(&model) else {
                continue;
            };
            let out = body.left * side.side_sign();
            let to = out * lowered.cos() - body.up * lowered.sin();
            let is = (model.model_joint_position(end) - model.model_joint_position(joint)).normalize_or(to);
            let turned = DQuat::from_rotation_arc(is, to) * model.model_joint_rotation(joint);
            let above = skeleton
                .joint_parent(joint)
                .map_or(DQuat::IDENTITY, |it| model.model_joint_rotation(it));
            pose.rotations[joint] = (above.inverse() * turned).normalize();
        }
        let model = ModelPose::from_local_pose(skeleton, &pose);
        if let Some(body) = anatomy.body_frame(&model) {
            let out = body.left * side.side_sign();
            let to = out * lowered.cos() - body.up * lowered.sin();
            let palm = -body.up * lowered.cos() - out * lowered.sin();
            if let Some(turned) = anatomy.hand_rotation(side, to, palm) {
                let above = model.model_joint_rotation(arm.forearm);
                pose.rotations[arm.hand] = (above.inverse() * turned).normalize();
            }
        }
    }
    pose
}

fn t_pose_far_away(source: &DisplayedMovement, from: &LocalPose) -> ModelPose {
    let mut pose = t_pose(source, from, 0.0);
    let turn = DQuat::from_rotation_y(std::f64::consts::PI);
    pose.rotations[0] = turn * pose.rotations[0];
    pose.translations[0] = turn * pose.translations[0] + DVec3::new(5.0, 0.0, 0.0);
    ModelPose::from_local_pose(source.clip.clip_skeleton(), &pose)
}

/// Returns optical markers, each with the joint that it follows.
fn markers(source: &DisplayedMovement) -> Vec<(&'static str, usize)> {
    let middle = |side| BodyPart::Finger(side, HandFinger::Middle, 2);
    let all = [
        ("C7", BodyPart::Neck),
        ("LFHD", BodyPart::Head),
        ("RFHD", BodyPart::Head),
        ("CLAV", BodyPart::Chest),
        ("RTOE", BodyPart::Foot(BodySide::Right)),
        ("LTOE", BodyPart::Foot(BodySide::Left)),
        ("RMID0", middle(BodySide::Right)),
        ("RMID6", middle(BodySide::Right)),
        ("LMID0", middle(BodySide::Left)),
        ("RTHM3", BodyPart::Thumb(BodySide::Right, 1)),
        ("RIDX3", BodyPart::Finger(BodySide::Right, HandFinger::Index, 2)),
    ];
    let joint = |(name, part): (&'static str, BodyPart)| Some((name, source.anatomy.part_joint(part)?));
    all.into_iter().filter_map(joint).collect()
}

/// Noise from a fixed seed.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }

    fn turn(&mut self, size: f64) -> DQuat {
        let [x, y, z] = [0; 3].map(|_| self.next() * size);
        DQuat::from_scaled_axis(DVec3::new(x, y, z))
    }
}
