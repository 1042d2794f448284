//! Optical markers stored beside a skeleton: leaves in the root's space that are not parts of the body.
//!
//! Capture programs export them together with the skeleton that was solved from them. Some have names like joints
//! (`RTOE`, `RMID0`, `C7`), so that names alone would make them toes, fingers and neck.

use super::anatomy_names::{self, JointLabel, JointWord};
use crate::skeleton::Skeleton;

/// Labels of markers that exist on both sides, without their `L` or `R`: those of Plug-in Gait, of the set of 41
/// markers that CMU used, of Helen Hayes, and of hands.
const SIDED_MARKER_LABELS: [&str; 51] = [
    "FHD", "BHD", "SHO", "UPA", "ELB", "IEL", "OEL", "MEL", "FRM", "FRA", "WRA", "WRB", "IWR", "OWR", "WRI", "FIN",
    "HND", "ASI", "PSI", "ILC", "FWT", "BWT", "THI", "KNE", "KNI", "MKN", "TIB", "SHN", "ANK", "MAN", "HEE", "HEL",
    "TOE", "MT1", "MT5", "ARM", "BAK", "CLA", "SCA", "TH", "THM", "IN", "IDX", "MID", "RIN", "RNG", "PIN", "PNK",
    "LIT", "MCP", "PIP",
];
/// Labels of markers on the middle line.
const MIDDLE_MARKER_LABELS: [&str; 16] = [
    "C7", "T8", "T10", "T12", "L5", "CLAV", "STRN", "SACR", "ARIEL", "MFHD", "MBHD", "TOPHEAD", "VSACRAL", "BACK",
    "TSPN", "LSPN",
];
/// The least number of markers that are recognised by name: single leaves with such names may be joints.
const MIN_RECOGNISED_MARKERS: usize = 4;
/// The least number of joints of a whole body's skeleton.
const MIN_BODY_JOINTS: usize = 10;

/// Returns the markers: leaves beside the body of a whole skeleton, whatever their names; and leaves below the root or
/// the hips with names of markers, if there are at least [`MIN_RECOGNISED_MARKERS`].
pub(super) fn find_marker_joints(skeleton: &Skeleton, names: &[&str], labels: &[Option<JointLabel>]) -> Vec<usize> {
    let leaf = |joint: usize| skeleton.joint_children(joint).is_empty();
    let body = find_arm_carrier(skeleton, labels);
    let below = body.map(|body| skeleton.joint_subtree(body));
    let is_beside = |joint: usize| {
        let (Some(body), Some(below)) = (body, &below) else {
            return false;
        };
        let above: Vec<usize> = skeleton.joint_ancestors(body).collect();
        // The toes of a leg without known names are farther from the trunk.
        let near_joints = skeleton.joint_ancestors(joint).skip(1).take(2);
        let near = near_joints.filter(|ancestor| above.contains(ancestor)).count() > 0;
        // A small skeleton may be a prop or a hand, whose leaves are its own parts.
        below.len() >= MIN_BODY_JOINTS && near && !above.contains(&joint) && !below.contains(&joint)
    };
    let carries = |joint: usize| {
        let label = labels[joint].map(|label| label.word);
        // Markers hang on what carries the whole body; leaves elsewhere are ends of bones.
        label.is_none_or(|word| matches!(word, JointWord::Root | JointWord::Hips))
    };
    let named: Vec<usize> = (1..skeleton.len())
        .filter(|&joint| leaf(joint) && is_marker(names[joint]))
        .filter(|&joint| skeleton.joint_parent(joint).is_some_and(carries))
        .collect();
    // A single leaf with such a name may be a joint; several are a set of markers.
    let several = named.len() >= MIN_RECOGNISED_MARKERS;
    (1..skeleton.len())
        .filter(|&joint| leaf(joint))
        .filter(|joint| is_beside(*joint) || (several && named.contains(joint)))
        .collect()
}

/// Returns the joint that carries both arms, and the legs if there are any.
fn find_arm_carrier(skeleton: &Skeleton, labels: &[Option<JointLabel>]) -> Option<usize> {
    let limb = |joint: &usize| {
        // A leaf with the name of a limb may be a marker itself.
        let inner = !skeleton.joint_children(*joint).is_empty();
        inner
            && labels[*joint].is_some_and(|label| {
                let limb = matches!(
                    label.word,
                    JointWord::UpperArm
                        | JointWord::Forearm
                        | JointWord::Wrist
                        | JointWord::Hand
                        | JointWord::Thigh
                        | JointWord::Shin
                        | JointWord::Leg
                        | JointWord::Foot
                );
                label.side.is_some() && limb
            })
    };
    let limbs: Vec<usize> = (0..skeleton.len()).filter(limb).collect();
    let sides = [crate::hand::BodySide::Right, crate::hand::BodySide::Left];
    let on = |side| {
        limbs
            .iter()
            .any(|&joint| labels[joint].is_some_and(|label| label.side == Some(side)))
    };
    // With one side only, the joint above it is just its shoulder.
    if !sides.into_iter().all(on) {
        return None;
    }
    let mut above: Vec<usize> = skeleton.joint_ancestors(*limbs.first()?).collect();
    for &limb in &limbs {
        let limb_ancestors: Vec<usize> = skeleton.joint_ancestors(limb).collect();
        above.retain(|joint| limb_ancestors.contains(joint));
    }
    above.first().copied()
}

/// Returns whether a name is that of a marker, such as `LFHD`, `NS:C7` or `RMID6`; `R.Shoulder.1` is that of a joint.
fn is_marker(name: &str) -> bool {
    let bare = anatomy_names::without_rig(name).trim();
    // Labels of markers are in capitals, names of joints are not.
    if bare.is_empty() || bare.chars().any(|c| c.is_lowercase()) {
        return false;
    }
    let plain: String = bare.chars().filter(|c| c.is_alphanumeric()).collect();
    if MIDDLE_MARKER_LABELS.contains(&plain.as_str()) {
        return true;
    }
    let sided = plain.strip_prefix('L').or(plain.strip_prefix('R'));
    sided.is_some_and(|rest| {
        let label = rest.trim_end_matches(|c: char| c.is_ascii_digit());
        // Up to two digits may follow: RMID6 is the sixth marker of a finger.
        SIDED_MARKER_LABELS.contains(&rest) || (SIDED_MARKER_LABELS.contains(&label) && rest.len() - label.len() < 3)
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body, rename_joints};
    use super::super::{BodyAnatomy, BodyPart};
    use super::*;
    use crate::hand::{BodySide, HandFinger};
    use crate::skeleton::SkeletonJoint;

    /// Returns a body with markers below `parent` of a wrapper (0) or of the hips (1), like those of capture programs.
    fn with_markers(wrapped: bool, space: &str) -> Skeleton {
        let plain = rename_joints(&fixture_body(PLAIN_BODY_VARIATION), |_, name| {
            let words = name.split(' ').map(|word| {
                let mut letters = word.chars();
                let first = letters.next().map(|c| c.to_ascii_uppercase());
                first.into_iter().chain(letters).collect::<String>()
            });
            format!("{space}{}", words.collect::<String>())
        });
        let marker = |name: &str, at: [f64; 3]| SkeletonJoint::new(format!("{space}{name}"), Some(0), at.into());
        let mut joints = vec![];
        if wrapped {
            joints.push(SkeletonJoint::new("RootNode", None, DVec3::ZERO));
        }
        let markers = [
            marker("C7", [0.0, 1.5, -0.1]),
            marker("RTOE", [-0.1, 0.05, 0.2]),
            marker("LTOE", [0.1, 0.05, 0.2]),
            marker("RMID0", [-0.8, 1.4, 0.0]),
            marker("RMID6", [-0.85, 1.4, 0.0]),
            marker("LFHD", [0.1, 1.7, 0.1]),
        ];
        if wrapped {
            joints.extend(markers.clone());
        }
        let start = joints.len();
        joints.extend(plain.skeleton_joints().iter().cloned().map(|mut joint| {
            joint.parent = match joint.parent {
                Some(parent) => Some(parent + start),
                None => wrapped.then_some(0),
            };
            joint
        }));
        if !wrapped {
            joints.extend(markers);
        }
        Skeleton::new(joints).expect("a tree")
    }

    #[test]
    fn markers_next_to_a_skeleton_are_no_body_parts() {
        for (wrapped, space) in [(true, ""), (true, "Anna:"), (false, ""), (false, "NS:")] {
            let skeleton = with_markers(wrapped, space);
            let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
            let markers = anatomy
                .marker_joints()
                .iter()
                .map(|&it| skeleton.joint_at(it).name.as_str());
            let markers: Vec<&str> = markers.collect();
            let want: Vec<String> = ["C7", "RTOE", "LTOE", "RMID0", "RMID6", "LFHD"]
                .map(|it| format!("{space}{it}"))
                .to_vec();
            assert_eq!(markers, want, "{wrapped} {space:?}");
            for (part, name) in [
                (BodyPart::Neck, "Neck"),
                (BodyPart::Toes(BodySide::Right), "RightToes"),
                (
                    BodyPart::Finger(BodySide::Right, HandFinger::Middle, 1),
                    "RightMiddleBase",
                ),
                (
                    BodyPart::Finger(BodySide::Right, HandFinger::Middle, 3),
                    "RightMiddleEnd",
                ),
            ] {
                let joint = anatomy.part_joint(part).map(|it| skeleton.joint_at(it).name.clone());
                assert_eq!(joint, Some(format!("{space}{name}")), "{part}");
            }
            assert!(anatomy.ambiguous_parts().is_empty(), "{:?}", anatomy.ambiguous_parts());
        }
    }

    #[test]
    fn joints_with_short_names_are_no_markers() {
        let skeleton = fixture_body(PLAIN_BODY_VARIATION);
        assert!(BodyAnatomy::detect_anatomy(&skeleton).marker_joints().is_empty());
        for (name, want) in [
            ("LFHD", true),
            ("Subject1:RMID6", true),
            ("R_TH2", true),
            ("C7", true),
            ("LeftToe", false),
            ("lMid2", false),
            ("Root", false),
            ("RIGHTHAND", false),
            ("", false),
        ] {
            assert_eq!(is_marker(name), want, "{name}");
        }
    }
}
