//! Movement of one body on another, outside recipes.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::{BodyAnatomy, Clip, Skeleton};
use chereme_sign::SignerHandedness;

use crate::error::StepError;
use crate::ops::retarget::{self, TargetBody};
use crate::work::WorkingClip;

/// Movement on another body.
#[derive(Debug, Clone)]
pub struct TransferredMovement {
    /// The movement.
    pub clip: Clip,
    /// The number of times that a hand touched the other hand or the body.
    pub contacts: usize,
    /// Contacts that were lost, each as a sentence: the hand stays apart from what it touched.
    pub lost: Vec<String>,
}

/// Returns the movement of one body on another, as the recipe `A then B` puts B on the body of A: limbs keep their
/// directions, fingers their angles, and hands that touched something touch it again.
///
/// # Errors
/// [`StepError::NoArm`] if the body has an arm that the movement lacks.
pub fn on_body(
    clip: &Clip,
    anatomy: &Arc<BodyAnatomy>,
    handedness: SignerHandedness,
    skeleton: &Arc<Skeleton>,
    body_anatomy: &Arc<BodyAnatomy>,
) -> Result<TransferredMovement, StepError> {
    let work = WorkingClip {
        skeleton: Arc::clone(clip.clip_skeleton()),
        anatomy: Arc::clone(anatomy),
        rate: clip.clip_frame_rate(),
        frames: clip.clip_frame_count(),
        channels: clip.joint_channels().to_vec(),
        handedness,
        signer: None,
        notes: Vec::new(),
        curves: Vec::new(),
        from: BTreeMap::new(),
    };
    let done = retarget::retarget_with_contacts(&work, &TargetBody::at_rest(skeleton, body_anatomy), "another body")?;
    Ok(TransferredMovement {
        clip: done.work.into_clip()?,
        contacts: done.contacts,
        lost: done.lost,
    })
}

#[cfg(test)]
mod tests {
    use chereme_motion::{BodyPart, BodySide, ModelPose};

    use super::*;
    use crate::testing::{Axes, Shelf, skeleton};

    #[test]
    fn movement_goes_to_a_smaller_body_and_to_one_of_other_axes() {
        let materials = Shelf::new().materials;
        for (axes, size) in [(Axes::Plain, 0.8), (Axes::Odd, 1.1)] {
            let skeleton = Arc::new(skeleton(axes, size));
            let anatomy = Arc::new(BodyAnatomy::detect_anatomy(&skeleton));
            for (gloss, material) in &materials {
                let made = on_body(
                    &material.clip,
                    &material.anatomy,
                    material.handedness,
                    &skeleton,
                    &anatomy,
                )
                .unwrap_or_else(|error| panic!("{gloss}: {error}"));
                assert_eq!(made.clip.clip_frame_count(), material.clip.clip_frame_count());
                assert_eq!(made.clip.clip_skeleton(), &skeleton);
                assert!(made.lost.is_empty(), "{gloss}: {:?}", made.lost);
                let hand = anatomy.part_joint(BodyPart::Hand(BodySide::Right)).expect("a hand");
                let pose = ModelPose::from_local_pose(&skeleton, &made.clip.clip_pose_at(0));
                assert!(pose.model_joint_position(hand).is_finite(), "{gloss}");
            }
        }
    }
}
