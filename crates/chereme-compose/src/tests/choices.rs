//! Tests of the choice of a sign as the source of a value, and that stored choices give the same movement again.

use super::*;
use crate::{evaluate_recipe, resolve_recipe};

#[test]
fn values_are_replaced_one_by_one_and_joined() {
    let made = made("BOL | configure right U, S");
    let held: Vec<_> = made
        .notes
        .iter()
        .filter(|n| {
            n.hand == Some(BodySide::Right) && n.about == NoteSubject::Component(SignComponent::Configuration, None)
        })
        .map(|n| n.value.reading_value().expect("a value").to_owned())
        .collect();
    assert_eq!(held, ["U", "S"]);
    let joint = made
        .anatomy
        .part_joint(BodyPart::Finger(BodySide::Right, chereme_motion::HandFinger::Index, 2))
        .expect("a finger");
    let column = &made.clip.joint_channel(joint).rotations;
    assert!(column[..48].iter().all(|q| *q == column[0]), "the first value is held");
    assert!(
        column[72..].iter().all(|q| *q == column[72]),
        "the second value is held"
    );
    let jump = column.windows(2).map(|w| w[0].angle_between(w[1])).fold(0.0, f64::max);
    let whole = column[0].angle_between(column[72]);
    assert!(whole > 0.05 && jump < whole / 5.0, "{jump} of {whole}");
    for (recipe, want) in [
        ("BOL | configure right U, S, Y", "give 1 or 2"),
        ("BOL | configure right Q", "no configuration"),
        ("BOL | configure right claw", "no sign with movement holds \"claw\""),
        ("BOOL", "did you mean \"BOL\"?"),
        ("BOL | configure right best(configuration=X)", "finds no sign"),
        ("BOL | place both by left 180cm", "the arm is 53 cm long"),
    ] {
        let error = make(recipe).expect_err(recipe).to_string();
        assert!(error.contains(want), "{recipe}: {error}");
    }
}

#[test]
fn a_value_comes_from_the_nearest_source() {
    use crate::PoseOrigin as From;
    let origin = |recipe: &str| {
        let recipe: crate::Recipe = recipe.parse().expect("recipe");
        let resolved = resolve_recipe(&recipe, &Shelf::new()).expect("resolved");
        let poses = resolved.resolved_inputs().0.values().find_map(|input| match input {
            crate::RecipeInput::Poses(poses) => Some(poses.clone()),
            _ => None,
        });
        poses.expect("poses")[0].origin.clone()
    };
    assert_eq!(
        origin("ESCARGOT | configure right S"),
        From::SameSigner("token:BOL".into())
    );
    assert_eq!(
        origin("ESCARGOT | configure right U"),
        From::OtherSigner("token:LIMACE".into())
    );
    assert_eq!(
        origin("LIMACE | configure right H"),
        From::Neighbour {
            sign: "token:LIMACE".into(),
            value: "U".into()
        }
    );
    assert_eq!(
        origin("ESCARGOT | configure right H"),
        From::Inventory("configurations".into())
    );
    assert_eq!(
        origin("ESCARGOT | configure right from CHAT"),
        From::Named("token:CHAT".into())
    );
    let best = origin("ESCARGOT | configure right best(configuration=U signer=same)");
    assert_eq!(best, From::OtherSigner("token:LIMACE".into()));
}

#[test]
fn a_sign_whose_hand_shows_another_posture_than_it_is_coded_with_gives_none() {
    let mut shelf = Shelf::new();
    for held in &mut shelf.materials.get_mut("BOL").expect("there").held {
        if held.value.reading_value() == Some("S") {
            held.value = chereme_sign::ComponentReading::Value("V".into());
        }
    }
    let chosen = |recipe: &str| {
        let recipe: crate::Recipe = recipe.parse().expect("recipe");
        let resolved = resolve_recipe(&recipe, &shelf).expect("resolved");
        let mut inputs = resolved.resolved_inputs().0.values();
        let pose = inputs.find_map(|input| match input {
            crate::RecipeInput::Poses(poses) => Some(poses[0].clone()),
            _ => None,
        });
        let said = evaluate_recipe(&resolved).expect("made").report.to_string();
        (pose.expect("a posture"), said)
    };
    // BOL is coded with V, but its fingers are far less bent.
    let (pose, said) = chosen("ESCARGOT | configure right V");
    assert_eq!(pose.origin, crate::PoseOrigin::Inventory("configurations".into()));
    assert!(!said.contains("from the inventory's posture"), "{said}");
    let (pose, said) = chosen("ESCARGOT | configure right U");
    let angle = pose.coding.expect("a coding").angle.expect("an angle");
    assert!(angle < 20_f64.to_radians(), "{angle}");
    let degrees = format!("{:.0}° from the inventory's posture", angle.to_degrees());
    assert!(said.contains(&degrees), "{said}");
}

#[test]
fn a_resolved_recipe_is_stored_and_gives_the_same_movement() {
    let shelf = Shelf::new();
    for text in [
        "ESCARGOT | configure right U | place right near BOL then BOL via",
        "BOL then via learned 0.3s LIMACE",
    ] {
        let text = text.trim_end_matches(" via");
        let recipe: crate::Recipe = text.parse().expect(text);
        let resolved = resolve_recipe(&recipe, &shelf).expect(text);
        let json = serde_json::to_string(resolved.resolved_inputs()).expect("json");
        let inputs: crate::RecipeInputs = serde_json::from_str(&json).expect("json");
        let mut changed = Shelf::new();
        changed.materials.get_mut("LIMACE").expect("there").held.clear();
        let again = crate::testing::restore_recipe_inputs(&recipe, inputs.clone(), &changed).expect("restored");
        let (a, b) = (
            evaluate_recipe(&resolved).expect(text),
            evaluate_recipe(&again).expect(text),
        );
        assert!(farthest(&a.clip, &b.clip) < 1e-12);
        for material in changed.materials.values_mut() {
            material.hash.push('x');
        }
        let error = crate::testing::restore_recipe_inputs(&recipe, inputs, &changed).expect_err("changed");
        assert!(matches!(error.cause, StepError::Changed { .. }));
    }
}
