//! Roles: the user's own assignment of joints to parts.

use std::collections::BTreeMap;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::part::{BodyPart, PartError, nearest_spelling};
use crate::skeleton::Skeleton;

/// The joints of parts as assigned by the user; they override the detection.
///
/// The text has lines `part = joint`, in which `#` starts a comment and an empty joint means that the skeleton has no
/// such part; or it is a JSON object with the same contents:
///
/// ```
/// use chereme_motion::anatomy::{BodyPart, AssignedJointRoles};
///
/// let roles: AssignedJointRoles = "# our rig\nright hand = wrist_7\njaw =".parse()?;
/// assert_eq!(roles.0[&BodyPart::Jaw], "");
/// assert_eq!(roles, r#"{"right hand": "wrist_7", "jaw": ""}"#.parse()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct AssignedJointRoles(
    /// The name of each part's joint; empty for a part that the skeleton does not have.
    pub BTreeMap<BodyPart, String>,
);

/// Why roles were refused.
#[derive(Debug, thiserror::Error)]
pub enum RolesError {
    /// A line has no equals sign.
    #[error("line {line} of the roles ({text:?}) is not of the form `part = joint`")]
    Line {
        /// The line, from 1.
        line: usize,
        /// Its text.
        text: String,
    },
    /// A line does not name a part.
    #[error("line {line} of the roles: {error}")]
    Part {
        /// The line, from 1.
        line: usize,
        /// The reason for the refusal.
        #[source]
        error: PartError,
    },
    /// A part is named twice.
    #[error("line {line} of the roles names {part} again; each part has one joint")]
    Twice {
        /// The second line, from 1.
        line: usize,
        /// The part.
        part: BodyPart,
    },
    /// The text is not JSON, or not an object of parts and joint names.
    #[error("the roles are no JSON object of parts and joint names: {0}")]
    Json(#[from] serde_json::Error),
    /// The skeleton has no joint of that name.
    #[error("{part}: the skeleton has no joint {joint:?}; did you mean {suggestion:?}?")]
    Joint {
        /// The part.
        part: BodyPart,
        /// The name given for its joint.
        joint: String,
        /// The name of a joint with the most similar spelling.
        suggestion: String,
    },
    /// Two different parts are given the same joint.
    #[error("joint {joint:?} is given to both {first} and {second}; only spine and chest may share")]
    Shared {
        /// The joint's name.
        joint: String,
        /// The first part.
        first: BodyPart,
        /// The second part.
        second: BodyPart,
    },
}

impl FromStr for AssignedJointRoles {
    type Err = RolesError;
    fn from_str(text: &str) -> Result<Self, RolesError> {
        // Editors on Windows write a mark before the text.
        let text = text.trim_start_matches('\u{feff}');
        if text.trim_start().starts_with('{') {
            return Ok(serde_json::from_str(text)?);
        }
        let mut roles = BTreeMap::new();
        for (line, content) in (1..).zip(text.lines()) {
            let content = content.split('#').next().unwrap_or_default().trim();
            if content.is_empty() {
                continue;
            }
            let Some((part, joint)) = content.split_once('=') else {
                return Err(RolesError::Line {
                    line,
                    text: content.to_owned(),
                });
            };
            let part = part.trim().parse().map_err(|error| RolesError::Part { line, error })?;
            if roles.insert(part, joint.trim().to_owned()).is_some() {
                return Err(RolesError::Twice { line, part });
            }
        }
        Ok(Self(roles))
    }
}

impl AssignedJointRoles {
    /// Returns each part's joint, `None` for a part that the user marked as missing.
    ///
    /// # Errors
    /// [`RolesError::Joint`] or [`RolesError::Shared`].
    pub(super) fn resolve_joint_roles(
        &self,
        skeleton: &Skeleton,
    ) -> Result<BTreeMap<BodyPart, Option<usize>>, RolesError> {
        let mut joints = BTreeMap::new();
        let mut taken: BTreeMap<usize, BodyPart> = BTreeMap::new();
        for (&part, name) in &self.0 {
            if name.is_empty() {
                joints.insert(part, None);
                continue;
            }
            let Some(joint) = skeleton.find_joint(name) else {
                let names = skeleton.skeleton_joints().iter().map(|joint| joint.name.as_str());
                return Err(RolesError::Joint {
                    part,
                    joint: name.clone(),
                    suggestion: nearest_spelling(name, names).to_owned(),
                });
            };
            if let Some(first) = taken.insert(joint, part)
                // Short spines have one joint for both.
                && (first, part) != (BodyPart::Spine, BodyPart::Chest)
            {
                return Err(RolesError::Shared {
                    joint: name.clone(),
                    first,
                    second: part,
                });
            }
            joints.insert(part, Some(joint));
        }
        Ok(joints)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{BodyAnatomy, PartEvidence};
    use crate::hand::BodySide;
    use crate::skeleton::SkeletonJoint;
    use glam::DVec3;

    #[test]
    fn faults_name_the_line_and_part_and_suggest_a_correction() {
        let skeleton = Skeleton::new(vec![
            SkeletonJoint::new("pelvis", None, DVec3::ZERO),
            SkeletonJoint::new("wrist_7", Some(0), DVec3::X),
        ])
        .expect("a tree");
        let faults = |text: &str| match text.parse::<AssignedJointRoles>() {
            Err(error) => error.to_string(),
            Ok(roles) => match BodyAnatomy::with_roles(&skeleton, &roles) {
                Err(error) => error.to_string(),
                Ok(_) => String::new(),
            },
        };
        for (text, want) in [
            ("\nright hand wrist_7", "line 2"),
            ("right hnad = wrist_7", "did you mean \"right hand\""),
            ("jaw = a\njaw = b", "line 2 of the roles names jaw again"),
            ("right hand = wrist7", "did you mean \"wrist_7\""),
            (
                "right hand = wrist_7\nleft hand = wrist_7",
                "both right hand and left hand",
            ),
            ("{\"right hand\": 7}", "JSON"),
            ("{\"rihgt hand\": \"wrist_7\"}", "no part of the body"),
            ("right hand = wrist_7", ""),
        ] {
            let error = faults(text);
            assert!(
                error.contains(want) && error.is_empty() == want.is_empty(),
                "{text}: {error}"
            );
        }
    }

    #[test]
    fn roles_override_names_and_remove_parts() {
        let skeleton = Skeleton::new(vec![
            SkeletonJoint::new("hips", None, DVec3::ZERO),
            SkeletonJoint::new("RightHand", Some(0), DVec3::X),
            SkeletonJoint::new("other", Some(0), DVec3::X),
            SkeletonJoint::new("jaw", Some(0), DVec3::X),
        ])
        .expect("a tree");
        let roles: AssignedJointRoles = "right hand = other\njaw =".parse().expect("roles");
        let anatomy = BodyAnatomy::with_roles(&skeleton, &roles).expect("joints");
        let hand = BodyPart::Hand(BodySide::Right);
        assert_eq!(anatomy.part_joint(hand), Some(2));
        assert_eq!(anatomy.part_evidence(hand), Some(PartEvidence::Roles));
        assert_eq!(anatomy.part_joint(BodyPart::Jaw), None);
        assert_eq!(anatomy.part_of(1), None);
    }
}
