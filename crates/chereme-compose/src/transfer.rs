//! Movement of one body on another, outside recipes.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::{Anatomy, Clip, Skeleton};
use chereme_sign::Handedness;

use crate::error::Cause;
use crate::ops::retarget::{self, TargetBody};
use crate::work::Work;

/// Movement on another body.
#[derive(Debug, Clone)]
pub struct Transferred {
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
/// [`Cause::NoArm`] if the body has an arm that the movement lacks.
pub fn on_body(
    (clip, anatomy): (&Clip, &Arc<Anatomy>),
    handedness: Handedness,
    (skeleton, of_body): (&Arc<Skeleton>, &Arc<Anatomy>),
) -> Result<Transferred, Cause> {
    let work = Work {
        skeleton: Arc::clone(clip.skeleton()),
        anatomy: Arc::clone(anatomy),
        rate: clip.rate(),
        frames: clip.frames(),
        channels: clip.channels().to_vec(),
        handedness,
        signer: None,
        notes: Vec::new(),
        curves: Vec::new(),
        from: BTreeMap::new(),
    };
    let done = retarget::touching(
        &work,
        &TargetBody::at_rest(skeleton, of_body),
        "another body",
    )?;
    Ok(Transferred {
        clip: done.work.into_clip()?,
        contacts: done.contacts,
        lost: done.lost,
    })
}

#[cfg(test)]
mod tests {
    use chereme_motion::{ModelPose, Part, Side};

    use super::*;
    use crate::testing::{Axes, Shelf, skeleton};

    #[test]
    fn movement_goes_to_a_smaller_body_and_to_one_of_other_axes() {
        let materials = Shelf::new().materials;
        for (axes, size) in [(Axes::Plain, 0.8), (Axes::Odd, 1.1)] {
            let skeleton = Arc::new(skeleton(axes, size));
            let anatomy = Arc::new(Anatomy::detect(&skeleton));
            for (gloss, material) in &materials {
                let from = (&material.clip, &material.anatomy);
                let made = on_body(from, material.handedness, (&skeleton, &anatomy));
                let made = made.unwrap_or_else(|error| panic!("{gloss}: {error}"));
                assert_eq!(made.clip.frames(), material.clip.frames());
                assert_eq!(made.clip.skeleton(), &skeleton);
                assert!(made.lost.is_empty(), "{gloss}: {:?}", made.lost);
                let hand = anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
                let pose = ModelPose::of(&skeleton, &made.clip.pose(0));
                assert!(pose.position(hand).is_finite(), "{gloss}");
            }
        }
    }
}
