//! Recipes from text to movement, on bodies with usual and with unusual axes.

mod choices;
mod curves;
mod draft;
mod expression;
mod face;
mod goldens;
mod joining;
mod laws;
mod notated;
mod on_body;
mod operators;
mod paths;
mod rest;
mod robust;
mod said;
mod strokes;
mod values;

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide, Clip};
use chereme_sign::SignComponent;
use proptest::prelude::*;

use crate::outcome::{GeneratedMovement, NoteSubject};
use crate::testing::{Shelf, farthest, model};
use crate::work::{JointGroup, find_joint_groups};
use crate::{MakeError, StepError, evaluate_recipe, resolve_recipe};

fn make(recipe: &str) -> Result<GeneratedMovement, MakeError> {
    let recipe: crate::Recipe = recipe.parse().unwrap_or_else(|e| panic!("{recipe}: {e}"));
    evaluate_recipe(&resolve_recipe(&recipe, &Shelf::new())?)
}

fn made(recipe: &str) -> GeneratedMovement {
    make(recipe).unwrap_or_else(|error| panic!("{recipe}: {error}"))
}

fn source(gloss: &str) -> Clip {
    Shelf::new().materials[gloss].clip.clone()
}

/// Returns the groups whose local channels differ between two clips.
fn differing(a: &GeneratedMovement, b: &Clip) -> Vec<JointGroup> {
    let groups = find_joint_groups(b.clip_skeleton(), &a.anatomy);
    let mut found: Vec<JointGroup> = (0..b.clip_skeleton().len())
        .filter(|&joint| a.clip.joint_channel(joint) != b.joint_channel(joint))
        .map(|joint| groups[joint])
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn bones_keep_their_lengths(clip: &Clip) {
    let rest = clip.clip_skeleton().rest_model_pose();
    for frame in 0..clip.clip_frame_count() {
        let now = clip.model_pose(frame);
        for joint in 1..clip.clip_skeleton().len() {
            let parent = clip.clip_skeleton().joint_parent(joint).expect("no root");
            let length =
                |m: &chereme_motion::ModelPose| m.model_joint_position(joint).distance(m.model_joint_position(parent));
            assert!((length(&now) - length(&rest)).abs() < 1e-6);
        }
    }
}

fn wrist(made: &GeneratedMovement, side: BodySide) -> Vec<DVec3> {
    let hand = made.anatomy.part_joint(BodyPart::Hand(side)).expect("a hand");
    made.clip.joint_path(hand)
}
