//! Recipes from text to movement, on bodies with usual and with unusual axes.

mod choices;
mod curves;
mod draft;
mod expression;
mod goldens;
mod joining;
mod laws;
mod notated;
mod operators;
mod paths;
mod rest;
mod robust;
mod said;
mod strokes;
mod values;

use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, Part, Side};
use chereme_sign::Component;
use proptest::prelude::*;

use crate::outcome::{About, Generated};
use crate::testing::{Shelf, farthest, model};
use crate::work::{Group, groups};
use crate::{Cause, MakeError, evaluate, resolve};

fn make(recipe: &str) -> Result<Generated, MakeError> {
    let recipe: crate::Recipe = recipe.parse().unwrap_or_else(|e| panic!("{recipe}: {e}"));
    evaluate(&resolve(&recipe, &Shelf::new())?)
}

fn made(recipe: &str) -> Generated {
    make(recipe).unwrap_or_else(|error| panic!("{recipe}: {error}"))
}

fn source(gloss: &str) -> Clip {
    Shelf::new().materials[gloss].clip.clone()
}

/// Returns the groups whose local channels differ between two clips.
fn differing(a: &Generated, b: &Clip) -> Vec<Group> {
    let groups = groups(b.skeleton(), &a.anatomy);
    let mut found: Vec<Group> = (0..b.skeleton().len())
        .filter(|&joint| a.clip.channel(joint) != b.channel(joint))
        .map(|joint| groups[joint])
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn bones_keep_their_lengths(clip: &Clip) {
    let rest = clip.skeleton().rest_model_pose();
    for frame in 0..clip.frames() {
        let now = clip.model_pose(frame);
        for joint in 1..clip.skeleton().len() {
            let parent = clip.skeleton().parent(joint).expect("no root");
            let length =
                |m: &chereme_motion::ModelPose| m.position(joint).distance(m.position(parent));
            assert!((length(&now) - length(&rest)).abs() < 1e-6);
        }
    }
}

fn wrist(made: &Generated, side: Side) -> Vec<DVec3> {
    let hand = made.anatomy.joint(Part::Hand(side)).expect("a hand");
    made.clip.path(hand)
}
