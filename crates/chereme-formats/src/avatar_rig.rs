//! The bones of avatars in other programs: their names by part of the body, and movement on such bones.

use std::collections::{BTreeMap, BTreeSet};

use chereme_data::files_below;
use chereme_motion::anatomy::PartError;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, LocalPose, ModelPose, Skeleton, SkeletonJoint};
use serde::Deserialize;

use crate::reach::{self, TooFar};

/// The folder with the tables of the avatars that are known.
const RIG_TABLES_FOLDER: &str = "schema/skeletons";
/// The text in a bone's name that stands for the side.
const SIDE_PLACEHOLDER: &str = "{side}";
/// The parts without which movement fits no avatar.
const NEEDED_RIG_PARTS: [BodyPart; 3] = [
    BodyPart::Hips,
    BodyPart::UpperArm(BodySide::Left),
    BodyPart::UpperArm(BodySide::Right),
];

/// The names of a kind of avatar's bones, and its posture at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct AvatarRig {
    /// The name for people, such as `Mixamo`.
    pub title: String,
    /// How far the arms hang below those of a T-pose at rest, in radians.
    arms_down: f64,
    /// The bones of each part: the last one turns it, those before it lie between its parent's bone and it.
    bones: BTreeMap<BodyPart, Vec<String>>,
}

/// A table of bones as it is written in JSON.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RigTable {
    title: String,
    #[serde(default)]
    arms_down_degrees: f64,
    /// The words for left and right in the names of bones.
    sides: [String; 2],
    bones: BTreeMap<String, BoneNames>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum BoneNames {
    One(String),
    Several(Vec<String>),
}

/// A reason why a table of bones is refused.
#[derive(Debug, thiserror::Error)]
pub enum RigTableError {
    /// The table is no JSON, or lacks a field.
    #[error("the table of bones is not as it should be: {0}")]
    Json(#[from] serde_json::Error),
    /// A bone belongs to no part of the body.
    #[error("in \"bones\": {0}")]
    Part(#[from] PartError),
    /// A bone has no name, or one that stands twice.
    #[error("in \"bones\": {part} has the name {name:?}, which is empty or stands twice")]
    Name {
        /// The part.
        part: BodyPart,
        /// The name.
        name: String,
    },
    /// A part that every avatar has is missing.
    #[error("in \"bones\": there is no bone for {0}")]
    Missing(BodyPart),
    /// The arms cannot hang like that.
    #[error("\"arms_down_degrees\" is {0}, but arms hang between 0 and 90 degrees below a T-pose")]
    Arms(f64),
}

/// A reason why a movement does not fit on an avatar.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RigError {
    /// The body lacks a part that every avatar has.
    #[error("the skeleton has no {0}, which avatars need")]
    NoPart(BodyPart),
    /// A place is farther away than files can say.
    #[error(transparent)]
    TooFar(#[from] TooFar),
}

/// Movement on the bones of an avatar, in metres.
///
/// At rest no bone is turned and all axes are those of model space; feet stand at height 0. Only the first joint, the
/// hips, changes its position.
#[derive(Debug, Clone, PartialEq)]
pub struct RiggedClip {
    /// The movement.
    pub clip: Clip,
    /// The part that each joint turns, and the joint of the original that it follows; `None` of a joint in between.
    pub joints: Vec<Option<(BodyPart, usize)>>,
    /// The bones of the avatar that the original body lacks.
    pub missing: Vec<String>,
}

impl AvatarRig {
    /// Returns the names of the avatars that are known.
    pub fn avatar_rig_names() -> impl Iterator<Item = &'static str> {
        files_below(RIG_TABLES_FOLDER).filter_map(|(path, _)| path.strip_suffix(".json"))
    }

    /// Returns a known avatar, such as `mixamo`.
    #[must_use]
    pub fn find_avatar_rig(name: &str) -> Option<Self> {
        let file = format!("{}.json", name.to_lowercase());
        let (_, text) = files_below(RIG_TABLES_FOLDER).find(|(path, _)| *path == file)?;
        Self::read_rig_table(text).ok()
    }

    /// Reads a table of bones.
    ///
    /// # Errors
    /// [`RigTableError`] if it is no such table, or hips or upper arms have no bone.
    pub fn read_rig_table(text: &str) -> Result<Self, RigTableError> {
        let table: RigTable = serde_json::from_str(text.trim_start_matches('\u{feff}'))?;
        if !(0.0..=90.0).contains(&table.arms_down_degrees) {
            return Err(RigTableError::Arms(table.arms_down_degrees));
        }
        let mut bones = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for (part, names) in table.bones {
            let names = match names {
                BoneNames::One(name) => vec![name],
                BoneNames::Several(names) => names,
            };
            let is_sided = !names.is_empty() && names.iter().all(|name| name.contains(SIDE_PLACEHOLDER));
            let of_sides = match is_sided {
                true => vec![
                    (format!("left {part}"), table.sides[0].as_str()),
                    (format!("right {part}"), table.sides[1].as_str()),
                ],
                false => vec![(part, "")],
            };
            for (part, side) in of_sides {
                let part: BodyPart = part.parse()?;
                let names: Vec<String> = names.iter().map(|name| name.replace(SIDE_PLACEHOLDER, side)).collect();
                let wrong = names
                    .iter()
                    .find(|name| name.trim().is_empty() || !taken.insert((*name).clone()));
                if let Some(name) = wrong.cloned().or_else(|| names.is_empty().then(String::new)) {
                    return Err(RigTableError::Name { part, name });
                }
                bones.insert(part, names);
            }
        }
        if let Some(part) = NEEDED_RIG_PARTS.into_iter().find(|part| !bones.contains_key(part)) {
            return Err(RigTableError::Missing(part));
        }
        Ok(Self {
            title: table.title,
            arms_down: table.arms_down_degrees.to_radians(),
            bones,
        })
    }

    /// Returns the bone that turns a part.
    #[must_use]
    pub fn part_bone(&self, part: BodyPart) -> Option<&str> {
        self.bones.get(&part)?.last().map(String::as_str)
    }

    /// Returns a movement on the bones of the avatar, with the lengths of the body that made it.
    ///
    /// Rotations of joints that the avatar does not know are added to those of the bones below them.
    ///
    /// # Errors
    /// [`RigError`] if the body has no hips or no arms, or a place is too far away.
    pub fn put_on_rig(&self, clip: &Clip, anatomy: &BodyAnatomy) -> Result<RiggedClip, RigError> {
        reach::check_clip_reach(clip)?;
        let skeleton = clip.clip_skeleton();
        let mut parts: Vec<(BodyPart, usize)> = Vec::new();
        for (part, joint, _) in anatomy.found_parts() {
            let is_taken = parts.iter().any(|(_, taken)| *taken == joint);
            if self.bones.contains_key(&part) && !is_taken {
                parts.push((part, joint));
            }
        }
        let has = |part: &BodyPart| parts.iter().any(|(found, _)| found == part);
        if let Some(part) = NEEDED_RIG_PARTS.into_iter().find(|part| !has(part)) {
            return Err(RigError::NoPart(part));
        }
        let lacking = self.bones.iter().filter(|(part, _)| !has(part));
        let missing = lacking.flat_map(|(_, names)| names.iter().cloned()).collect();
        // The hips come first: other roots hang below them.
        parts.sort_by_key(|(part, joint)| (*part != BodyPart::Hips, *joint));
        let rest = self.resting_places(clip, anatomy, &parts);
        let lowest = rest.iter().fold(f64::INFINITY, |least, (place, _)| least.min(place.y));
        let mut bones = RigBones::default();
        for (nth, (part, joint)) in parts.iter().enumerate() {
            let mut above = skeleton.joint_ancestors(*joint).filter(|ancestor| ancestor != joint);
            let parent = above.find_map(|ancestor| parts[..nth].iter().position(|(_, bone)| *bone == ancestor));
            let parent = parent.or((nth > 0).then_some(0));
            let tip = skeleton.joint_at(*joint).tip.map(|tip| rest[nth].1 * tip);
            let from = parent.map_or(DVec3::Y * lowest, |parent| rest[parent].0);
            bones.add_rig_bone(&self.bones[part], parent, rest[nth].0 - from, tip);
        }
        let poses = (0..clip.clip_frame_count()).map(|frame| {
            let pose = clip.model_pose(frame);
            let turn = |nth: usize| pose.model_joint_rotation(parts[nth].1) * rest[nth].1.inverse();
            let turns: Vec<DQuat> = (0..parts.len()).map(turn).collect();
            bones.local_pose(&turns, pose.model_joint_position(parts[0].1))
        });
        let mut poses: Vec<LocalPose> = poses.collect();
        keep_turns_near(&mut poses);
        let mut joints = vec![None; bones.joints.len()];
        for (nth, part) in parts.iter().enumerate() {
            joints[bones.own[nth]] = Some(*part);
        }
        let skeleton = Skeleton::new(bones.joints).expect("each bone hangs below an earlier one, at a finite place");
        let clip = Clip::from_poses(skeleton.into(), clip.clip_frame_rate(), &poses)
            .expect("a pose has a unit quaternion for each bone");
        Ok(RiggedClip { clip, joints, missing })
    }

    /// Returns the places and rotations of the original's joints in the posture of rest.
    fn resting_places(&self, clip: &Clip, anatomy: &BodyAnatomy, parts: &[(BodyPart, usize)]) -> Vec<(DVec3, DQuat)> {
        let skeleton = clip.clip_skeleton();
        let rest: ModelPose = anatomy.clone().with_clip(clip).t_pose(skeleton);
        let shoulder = |side: BodySide| {
            let upper_arm = |(part, _): &&(BodyPart, usize)| *part == BodyPart::UpperArm(side);
            parts.iter().find(upper_arm).map(|(_, joint)| *joint)
        };
        let placed = parts.iter().map(|(part, joint)| {
            let (place, turn) = (rest.model_joint_position(*joint), rest.model_joint_rotation(*joint));
            let hangs = |shoulder: &usize| skeleton.joint_ancestors(*joint).any(|above| above == *shoulder);
            match part
                .part_side()
                .and_then(|side| Some((side, shoulder(side).filter(hangs)?)))
            {
                Some((side, shoulder)) => {
                    let pivot = rest.model_joint_position(shoulder);
                    let lowered = DQuat::from_rotation_z(-side.side_sign() * self.arms_down);
                    (pivot + lowered * (place - pivot), lowered * turn)
                }
                None => (place, turn),
            }
        });
        placed.collect()
    }
}

/// The joints of an avatar while they are put together.
#[derive(Default)]
struct RigBones {
    joints: Vec<SkeletonJoint>,
    /// The joint of each bone that follows one of the original.
    own: Vec<usize>,
    /// The bone above each of these.
    parents: Vec<Option<usize>>,
}

impl RigBones {
    /// Adds a bone, and evenly those that lie between its parent and it.
    fn add_rig_bone(&mut self, names: &[String], parent: Option<usize>, offset: DVec3, tip: Option<DVec3>) {
        let names = match parent {
            Some(_) => names,
            None => &names[names.len() - 1..],
        };
        let mut above = parent.map(|parent| self.own[parent]);
        for name in names {
            self.joints
                .push(SkeletonJoint::new(name, above, offset / names.len() as f64));
            above = Some(self.joints.len() - 1);
        }
        self.own.push(self.joints.len() - 1);
        self.parents.push(parent);
        if let Some(joint) = self.joints.last_mut() {
            joint.tip = tip;
        }
    }

    /// Returns a posture in which bones have these turns from rest in model space, with the hips at a place.
    fn local_pose(&self, turns: &[DQuat], hips: DVec3) -> LocalPose {
        let mut pose = LocalPose {
            rotations: vec![DQuat::IDENTITY; self.joints.len()],
            translations: self.joints.iter().map(|joint| joint.offset).collect(),
        };
        for (nth, parent) in self.parents.iter().enumerate() {
            let above = parent.map_or(DQuat::IDENTITY, |parent| turns[parent].inverse());
            pose.rotations[self.own[nth]] = (above * turns[nth]).normalize();
        }
        pose.translations[0] = hips;
        pose
    }
}

/// Turns the signs of quaternions so that neighbours in time lie in one half of their sphere: players interpolate the
/// four numbers.
fn keep_turns_near(poses: &mut [LocalPose]) {
    for frame in 1..poses.len() {
        let (before, after) = poses.split_at_mut(frame);
        let (Some(before), Some(after)) = (before.last(), after.first_mut()) else {
            return;
        };
        for (turn, former) in after.rotations.iter_mut().zip(&before.rotations) {
            if former.dot(*turn) < 0.0 {
                *turn = -*turn;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The joints of SMPL-X in its own order: 22 of the body, jaw and eyes, 15 of each hand.
    const SMPLX_JOINTS: &str =
        "pelvis left_hip right_hip spine1 left_knee right_knee spine2 left_ankle right_ankle spine3
        left_foot right_foot neck left_collar right_collar head left_shoulder right_shoulder left_elbow right_elbow
        left_wrist right_wrist jaw left_eye_smplhf right_eye_smplhf
        left_index1 left_index2 left_index3 left_middle1 left_middle2 left_middle3 left_pinky1 left_pinky2 left_pinky3
        left_ring1 left_ring2 left_ring3 left_thumb1 left_thumb2 left_thumb3
        right_index1 right_index2 right_index3 right_middle1 right_middle2 right_middle3 right_pinky1 right_pinky2
        right_pinky3 right_ring1 right_ring2 right_ring3 right_thumb1 right_thumb2 right_thumb3";

    #[test]
    fn every_known_table_is_read_and_smpl_x_has_its_55_joints() {
        for name in AvatarRig::avatar_rig_names() {
            let rig = AvatarRig::find_avatar_rig(&name.to_uppercase());
            assert!(rig.is_some_and(|rig| rig.bones.len() >= 45), "{name}");
        }
        let rig = AvatarRig::find_avatar_rig("smplx").expect("a table");
        let names: BTreeSet<&str> = rig.bones.values().flatten().map(String::as_str).collect();
        let wanted: BTreeSet<&str> = SMPLX_JOINTS.split_whitespace().collect();
        assert_eq!((wanted.len(), names), (55, wanted));
        assert_eq!(AvatarRig::find_avatar_rig("nobody"), None);
    }

    #[test]
    fn a_wrong_table_is_refused_with_its_place() {
        let table = |bones: &str| format!("{{\"title\": \"T\", \"sides\": [\"L\", \"R\"], \"bones\": {{{bones}}}}}");
        for (text, wanted) in [
            ("[]".to_owned(), "not as it should be"),
            (table("\"hips\": 3"), "line 1"),
            (table("\"hip bone\": \"a\""), "did you mean"),
            (table("\"hips\": \"a\", \"chest\": \"a\""), "\"a\""),
            (table("\"hips\": []"), "empty"),
            (table("\"hips\": \"a\""), "no bone for left upper arm"),
            (
                "{\"title\": \"T\", \"sides\": [\"L\", \"R\"], \"bones\": {}, \"arms_down_degrees\": 99}".to_owned(),
                "99",
            ),
        ] {
            let error = AvatarRig::read_rig_table(&text).expect_err(&text).to_string();
            assert!(error.contains(wanted), "{text}: {error}");
        }
        let rig = AvatarRig::read_rig_table(&table("\"hips\": \"a\", \"upper arm\": \"arm {side}\"")).expect("a table");
        assert_eq!(rig.part_bone(BodyPart::UpperArm(BodySide::Right)), Some("arm R"));
    }
}
