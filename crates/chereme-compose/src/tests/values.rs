//! The notes of operators on the signs they generate, and the moment at which a place is measured.

use super::*;
use crate::recipe_settings::RecipeHandPoint;
use crate::work::WorkingClip;
use crate::{LetterStroke, body, evaluate_recipe};

/// The notes on a hand: component, part, value, and the time in milliseconds.
fn said(made: &GeneratedMovement, side: BodySide, component: SignComponent) -> Vec<(String, String, i64, i64)> {
    let of = |note: &crate::GeneratedNote| {
        let NoteSubject::Component(found, feature) = &note.about else {
            return None;
        };
        let value = note.value.reading_value()?;
        let here = *found == component && note.hand == Some(side);
        let span = [note.span.span_start_instant(), note.span.span_end_instant()].map(|at| at.instant_micros() / 1000);
        let feature = feature.clone().unwrap_or_default();
        here.then(|| (feature, value.to_owned(), span[0], span[1]))
    };
    let mut said: Vec<_> = made.notes.iter().filter_map(of).collect();
    said.sort();
    said
}

fn values(recipe: &str, side: BodySide, component: SignComponent) -> Vec<String> {
    let said = said(&made(recipe), side, component);
    let value = |(feature, value, ..): (String, String, i64, i64)| match feature.as_str() {
        "" => value,
        feature => format!("{feature}={value}"),
    };
    said.into_iter().map(value).collect()
}

#[test]
fn every_operator_updates_the_values_that_it_changes() {
    use BodySide::{Left, Right};
    use SignComponent::{Configuration, Movement, Orientation, Placement};
    for (recipe, side, component, want) in [
        ("ESCARGOT | place right at chin", Right, Placement, vec!["chin"]),
        ("LIMACE | place right at chin", Right, Placement, vec!["chin"]),
        ("ESCARGOT | place right by up 9cm", Right, Placement, vec![]),
        ("LIMACE | place right near ESCARGOT", Right, Placement, vec!["chest"]),
        ("LIMACE | place right near ESCARGOT by up 9cm", Right, Placement, vec![]),
        ("ESCARGOT | configure right U", Right, Configuration, vec!["U"]),
        ("BOL | configure right U, _", Right, Configuration, vec!["S", "U"]),
        ("ESCARGOT | reverse", Right, Movement, vec!["arc"]),
        ("ESCARGOT | amplify right 0.5", Right, Movement, vec!["arc"]),
        ("ESCARGOT | amplify right 0", Right, Movement, vec![]),
        ("BOL | place both at chin", Right, Placement, vec!["chin"]),
        (
            "BOL | place right by up 70cm | place both at chin",
            Right,
            Placement,
            vec![],
        ),
        ("ESCARGOT | swap", Left, Movement, vec!["arc"]),
        ("ESCARGOT | swap", Right, Movement, vec![]),
        ("BOL | swap", Right, Placement, vec!["high-right"]),
        ("ESCARGOT | mirror right", Left, Configuration, vec!["Y"]),
        (
            "ESCARGOT | repeat 2",
            Right,
            Movement,
            vec!["arc", "arc", "repetition=twice"],
        ),
        (
            "ESCARGOT | repeat 2 | repeat 2",
            Right,
            Movement,
            vec!["arc", "arc", "arc", "arc", "repetition=several"],
        ),
        ("ESCARGOT | travel right down 9cm", Right, Movement, vec![]),
        ("ESCARGOT | travel right down 9cm", Right, Placement, vec![]),
        ("ESCARGOT | travel right down 9cm", Right, Configuration, vec!["Y"]),
        ("ESCARGOT | from me to left with right", Right, Placement, vec![]),
        (
            "ESCARGOT | from chin to left with right",
            Right,
            Placement,
            vec!["chin"],
        ),
        (
            "ESCARGOT | orient right palm down fingers forward",
            Right,
            Orientation,
            vec!["fingers=out", "palm=down"],
        ),
    ] {
        assert_eq!(values(recipe, side, component), want, "{recipe}");
    }
}

#[test]
fn a_still_hand_gets_the_value_of_the_path_it_travels() {
    let recipe = "spell B | travel right down 20cm";
    let want = ["straight", "direction=down"];
    assert_eq!(values(recipe, BodySide::Right, SignComponent::Movement), want);
    let recipe = "spell B | travel right down 20cm then up 20cm";
    assert_eq!(values(recipe, BodySide::Right, SignComponent::Movement), ["path"]);
}

#[test]
fn a_span_keeps_its_frames_and_their_values() {
    let cut = made("ESCARGOT | span 0.4s..0.7s");
    assert_eq!(cut.clip.clip_frame_count(), 36);
    assert_eq!(cut.clip.clip_pose_at(0), source("ESCARGOT").clip_pose_at(48));
    let shape = said(&cut, BodySide::Right, SignComponent::Configuration);
    assert_eq!(shape, [(String::new(), "Y".to_owned(), 0, 300)]);
    assert_eq!(made("ESCARGOT | span 0.5s..").clip.clip_frame_count(), 60);
    assert_eq!(made("ESCARGOT | span ..0.5s").clip.clip_frame_count(), 60);
    assert_eq!(
        made("ESCARGOT | span 0.2s..0.8s | span 0.1s..0.3s").clip,
        made("ESCARGOT | span 0.3s..0.5s").clip
    );
    let error = make("ESCARGOT | span 4s..5s").expect_err("beyond the end");
    assert!(error.to_string().contains("lasts 1.00 s"), "{error}");
    for wrong in ["span 1s..0.5s", "span ..", "span 1s", "span 1..2", "span"] {
        assert!(format!("A | {wrong}").parse::<crate::Recipe>().is_err(), "{wrong}");
    }
}

#[test]
fn trim_keeps_movement_without_rest_unchanged() {
    assert_eq!(made("ESCARGOT | trim").clip, source("ESCARGOT"));
}

#[test]
fn the_hand_touches_the_place_at_its_contact_and_stays_out_of_the_body() {
    // Constructed so that it touches the chin early, then moves away.
    let touching = "ESCARGOT | place right at chin with index | travel right forward 30cm";
    for (recipe, place) in [
        (format!("{touching} | place right at chin with index"), "chin"),
        ("ESCARGOT | place right at chin with index".to_owned(), "chin"),
        ("ESCARGOT | place right at chin".to_owned(), "chin"),
    ] {
        let made = made(&recipe);
        let step = made.report.steps.last().expect("a step");
        let off = step.residual.expect("a target");
        let work = WorkingClip {
            channels: made.clip.joint_channels().to_vec(),
            ..WorkingClip::working_clip_from(&Shelf::new().materials["ESCARGOT"])
        };
        let before = WorkingClip::working_clip_from(&Shelf::new().materials["ESCARGOT"]);
        let cleared = crate::ops::clear::clear_hand_of_body(
            &mut work.clone(),
            &before,
            BodySide::Right,
            crate::recipe::ArmSolverMethod::Analytic,
        );
        let still = cleared.map_or(0.0, |it| it.largest_shift_in(&(0..work.frames)));
        assert!(still < 0.01, "{recipe}: still {still} m in the body");
        let near = (0..work.frames).map(|frame| {
            let model = made.clip.model_pose(frame);
            let at = work
                .anatomy
                .landmark_place_position(&work.skeleton, &model, place)
                .expect("a head");
            let points = RecipeHandPoint::ALL_HAND_POINTS.iter();
            let points = points.filter_map(|&point| body::hand_point(&work, &model, BodySide::Right, point));
            points.map(|point| point.distance(at)).fold(f64::MAX, f64::min)
        });
        let near = near.fold(f64::MAX, f64::min);
        assert!(near < 0.12 + off, "{recipe}: {near} m, told {off}");
    }
}

#[test]
fn pieces_that_would_jump_are_refused_with_a_remedy() {
    use crate::resolve_recipe;
    let mut shelf = Shelf::new();
    let bol = shelf.materials.get_mut("BOL").expect("a sign");
    let (skeleton, rate) = (bol.clip.clip_skeleton().clone(), bol.clip.clip_frame_rate());
    let mut channels = bol.clip.clone().into_channels();
    let places = channels[0].translations.as_mut().expect("a root that moves");
    let last = places.len() - 1;
    places[last].x += 5.0;
    bol.clip = Clip::new(skeleton, rate, channels).expect("a clip");
    let make = |recipe: &str| {
        let recipe: crate::Recipe = recipe.parse().expect(recipe);
        evaluate_recipe(&resolve_recipe(&recipe, &shelf)?)
    };
    let error = make("BOL then ESCARGOT").expect_err("a leap of five metres");
    assert!(matches!(error.cause, StepError::Torn { .. }), "{error}");
    assert!(error.to_string().contains("| trim"), "{error}");
    make("(BOL | trim) then ESCARGOT").expect("the odd frame is cut off");
    make("(BOL | span ..0.9s) then ESCARGOT").expect("the odd frame is cut off");
}

#[test]
fn the_second_piece_stands_where_the_first_ends_whatever_is_above_its_hips() {
    use crate::resolve_recipe;
    use chereme_motion::glam::DQuat;
    use std::sync::Arc;
    let mut shelf = Shelf::new();
    let far = shelf.materials["BOL"].clone();
    // A wrapper above the hips with a place, a turn and a movement of its own.
    let mut joints = vec![chereme_motion::SkeletonJoint::new("RootNode", None, DVec3::ZERO)];
    joints.extend(
        far.clip
            .clip_skeleton()
            .skeleton_joints()
            .iter()
            .cloned()
            .map(|mut joint| {
                joint.parent = Some(joint.parent.map_or(0, |parent| parent + 1));
                joint
            }),
    );
    let skeleton = Arc::new(chereme_motion::Skeleton::new(joints).expect("a tree"));
    let frames = far.clip.clip_frame_count();
    let mut channels = vec![chereme_motion::JointChannel {
        rotations: vec![DQuat::from_rotation_y(2.0); frames],
        translations: Some(
            (0..frames)
                .map(|f| DVec3::new(35.0 + f as f64 * 1e-3, -3.0, 127.0))
                .collect(),
        ),
    }];
    channels.extend(far.clip.joint_channels().iter().cloned());
    let clip = Clip::new(skeleton.clone(), far.clip.clip_frame_rate(), channels).expect("a clip");
    let anatomy = Arc::new(chereme_motion::BodyAnatomy::detect_anatomy(&skeleton));
    let far = crate::MovementMaterial {
        clip,
        anatomy,
        address: "token:FAR".into(),
        gloss: "FAR".into(),
        ..far
    };
    shelf.materials.insert("FAR".into(), far);
    for recipe in [
        "ESCARGOT then FAR",
        "FAR then ESCARGOT",
        "FAR then FAR",
        "LIMACE then FAR",
    ] {
        let parsed: crate::Recipe = recipe.parse().expect(recipe);
        let made = evaluate_recipe(&resolve_recipe(&parsed, &shelf).expect(recipe)).expect(recipe);
        let body = |frame: usize| made.anatomy.body_frame(&made.clip.model_pose(frame)).expect("a trunk");
        for frame in 1..made.clip.clip_frame_count() {
            let step = body(frame).origin.distance(body(frame - 1).origin);
            assert!(step < 0.05, "{recipe}: the body jumps {step} m at {frame}");
        }
        let (first, last) = (body(0), body(made.clip.clip_frame_count() - 1));
        assert!(first.forward.angle_between(last.forward) < 0.5, "{recipe}");
    }
}

#[test]
fn strokes_of_letters_keep_their_words_in_stored_answers() {
    let stroke = LetterStroke {
        displacement: [0.1, 0.0, 0.2],
        turn: 0.5,
    };
    let text = r#"{"way":[0.1,0.0,0.2],"turn":0.5}"#;
    assert_eq!(serde_json::to_string(&stroke).expect("written"), text);
    let read: LetterStroke = serde_json::from_str(text).expect("read");
    assert_eq!(read, stroke);
}
