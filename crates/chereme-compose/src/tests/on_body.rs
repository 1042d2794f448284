//! Movement put on another body: its laws over bodies that keep their joints differently.

use super::joining::{along_one_axis, with_armature, with_rolled_thumbs, with_toes};
use super::*;
use crate::Recipe;
use crate::sources::MovementMaterial;
use crate::testing::restore_recipe_inputs;
use crate::testing::{Axes, skeleton};
use chereme_motion::BodyAnatomy;
use std::sync::Arc;

/// Returns bodies of different rest poses, axes and sizes, each as its own signer, all with the movement of `gloss`.
fn dialects(gloss: &str) -> Vec<MovementMaterial> {
    let own = Shelf::new().materials[gloss].clone();
    let toes = with_toes(&own, "TOES");
    let mut bodies = vec![
        along_one_axis(&toes, "LINE"),
        with_rolled_thumbs(&toes, "ROLLED"),
        with_armature(&along_one_axis(&toes, "LINE"), "ARMATURE"),
        toes,
    ];
    for (name, axes, size) in [
        ("SMALL", Axes::Plain, 0.8),
        ("ODD", Axes::Odd, 1.0),
        ("TALL-ODD", Axes::Odd, 1.15),
    ] {
        let skeleton = Arc::new(skeleton(axes, size));
        bodies.push(MovementMaterial {
            address: format!("token:{name}"),
            gloss: name.to_owned(),
            hash: name.to_owned(),
            clip: crate::testing::clip(&skeleton, 120, 1.0),
            anatomy: Arc::new(BodyAnatomy::detect_anatomy(&skeleton)),
            ..own.clone()
        });
    }
    for body in &mut bodies {
        body.signer = Some(format!("signer:{}", body.gloss));
    }
    bodies
}

fn shelf_of_bodies(bodies: &[MovementMaterial]) -> Shelf {
    let mut shelf = Shelf::new();
    shelf.materials = bodies.iter().map(|body| (body.gloss.clone(), body.clone())).collect();
    shelf
}

fn evaluated(shelf: &Shelf, recipe: &str) -> GeneratedMovement {
    let parsed: Recipe = recipe.parse().expect(recipe);
    evaluate_recipe(&resolve_recipe(&parsed, shelf).expect(recipe)).expect(recipe)
}

/// Returns the direction of each bone between two known parts, and the place of its end, in a frame.
fn bones(clip: &Clip, anatomy: &BodyAnatomy, frame: usize) -> Vec<(BodyPart, DVec3, DVec3)> {
    let (skeleton, model) = (clip.clip_skeleton(), clip.model_pose(frame));
    let mut bones = Vec::new();
    for (part, joint, _) in anatomy.found_parts() {
        let above = skeleton
            .joint_ancestors(joint)
            .skip(1)
            .find(|&above| anatomy.part_of(above).is_some());
        let Some(above) = above else { continue };
        let (from, to) = (model.model_joint_position(above), model.model_joint_position(joint));
        if let Some(direction) = (to - from).try_normalize() {
            bones.push((part, direction, to));
        }
    }
    bones
}

/// Returns the largest angle in degrees between the bones of two movements and the largest distance of their ends.
fn greatest_difference(a: (&Clip, &BodyAnatomy), b: (&Clip, &BodyAnatomy)) -> (f64, f64, BodyPart) {
    let mut most = (0.0_f64, 0.0_f64, BodyPart::Hips);
    for frame in (0..a.0.clip_frame_count()).step_by(17) {
        let others = bones(b.0, b.1, frame);
        for (part, direction, end) in bones(a.0, a.1, frame) {
            let Some((_, other, place)) = others.iter().find(|(other, ..)| *other == part) else {
                continue;
            };
            let angle = direction.angle_between(*other).to_degrees();
            if angle > most.0 {
                (most.0, most.2) = (angle, part);
            }
            most.1 = most.1.max(end.distance(*place));
        }
    }
    most
}

#[test]
fn on_its_own_body_a_movement_is_unchanged() {
    let bodies = dialects("BOL");
    let shelf = shelf_of_bodies(&bodies);
    for body in &bodies {
        let made = evaluated(&shelf, &format!("{0} | on signer:{0}", body.gloss));
        assert_eq!(made.clip, body.clip, "{}", body.gloss);
    }
}

#[test]
fn bones_keep_their_directions_on_every_body_and_come_back() {
    let bodies = dialects("BOL");
    let shelf = shelf_of_bodies(&bodies);
    for from in &bodies {
        for onto in &bodies {
            let there = format!("{} | on {}", from.gloss, onto.signer.as_deref().expect("a signer"));
            let made = evaluated(&shelf, &there);
            assert_eq!(made.signer, onto.signer);
            let (angle, _, part) = greatest_difference((&from.clip, &from.anatomy), (&made.clip, &made.anatomy));
            assert!(angle < 5.0, "{there}: {part:?} is turned by {angle}°");
            let back = evaluated(
                &shelf,
                &format!("{there} | on {}", from.signer.as_deref().expect("a signer")),
            );
            let own = (&from.clip, &*from.anatomy);
            let (angle, distance, part) = greatest_difference(own, (&back.clip, &back.anatomy));
            assert!(
                angle < 2.0 && distance < 0.01,
                "{there} and back: {angle}° at {part:?}, {distance} m"
            );
        }
    }
}

#[test]
fn fingertips_touch_their_places_on_every_body() {
    let bodies = dialects("ESCARGOT");
    let shelf = shelf_of_bodies(&bodies);
    for from in &bodies {
        for onto in &bodies {
            let recipe = format!(
                "{} | place right at chin with index | on signer:{}",
                from.gloss, onto.gloss
            );
            let made = evaluated(&shelf, &recipe);
            let touches = &made.report.steps.last().expect("a step").touches;
            assert!(from.gloss == onto.gloss || !touches.is_empty(), "{recipe}");
            for touch in touches {
                assert!(touch.off_m < 0.005, "{recipe}: {touch:?}");
            }
        }
    }
}

#[test]
fn a_stored_sign_on_another_body_is_restored() {
    let bodies = dialects("BOL");
    let shelf = shelf_of_bodies(&bodies);
    let recipe: Recipe = "TOES | on token:SMALL | reverse".parse().expect("a recipe");
    let resolved = resolve_recipe(&recipe, &shelf).expect("resolved");
    let made = evaluate_recipe(&resolved).expect("made");
    let text = serde_json::to_string(resolved.resolved_inputs()).expect("JSON");
    assert!(text.contains("/pipe/steps/0/on/body"), "{text}");
    // A recording that gives a body has the address of its movement, and another hash.
    let inputs = serde_json::from_str(&text.replace("\"stage\"", "\"token:SMALL\"")).expect("inputs");
    let again = restore_recipe_inputs(&recipe, inputs, &shelf).expect("restored");
    assert_eq!(evaluate_recipe(&again).expect("made again"), made);
}
