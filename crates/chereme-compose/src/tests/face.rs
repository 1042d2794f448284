//! The operator `face`: its values, its laws, and the face that can be seen.

use chereme_motion::{BodyPart, FacePosture};
use chereme_sign::SignComponent;

use crate::face_parts::FacePart;
use crate::outcome::{GeneratedCurve, GeneratedMovement, NoteSubject};
use crate::recipe::Recipe;
use crate::testing::{Shelf, restore_recipe_inputs};
use crate::work::JointGroup;
use crate::{RecipeError, StepError, evaluate_recipe, faces_from_curves, resolve_recipe};

fn curve(name: &str, values: Vec<f64>) -> GeneratedCurve {
    GeneratedCurve {
        name: name.to_owned(),
        values,
    }
}

/// A shelf on which BOL furrows its brows, mouths and leans, and LIMACE has a captured face.
fn shelf() -> Shelf {
    let mut shelf = Shelf::new();
    let bol = shelf.materials.get_mut("BOL").expect("there");
    let frames = bol.clip.clip_frame_count();
    let ramp = |n: usize| 0.2 + 0.6 * n as f64 / frames as f64;
    bol.curves = vec![
        curve("brows.FU", (0..frames).map(ramp).collect()),
        curve("mouthing.map", vec![1.0; frames]),
        curve("body.TF", vec![0.5; frames]),
    ];
    let limace = shelf.materials.get_mut("LIMACE").expect("there");
    let frames = limace.clip.clip_frame_count();
    limace.curves = vec![
        curve("face.brow_squeeze", vec![0.4; frames]),
        curve("face.lip_corner_left", vec![-0.3; frames]),
        curve("head.SH", vec![1.0; frames]),
    ];
    shelf
}

fn made(recipe: &str) -> GeneratedMovement {
    made_on(recipe, &shelf())
}

fn made_on(recipe: &str, shelf: &Shelf) -> GeneratedMovement {
    let recipe: Recipe = recipe.parse().unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let resolved = resolve_recipe(&recipe, shelf).unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let made = evaluate_recipe(&resolved).unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let stored = restore_recipe_inputs(&recipe, resolved.resolved_inputs().clone(), shelf).expect("found again");
    assert_eq!(evaluate_recipe(&stored).expect("made again"), made, "{recipe}");
    made
}

fn values<'a>(made: &'a GeneratedMovement, name: &str) -> &'a [f64] {
    let found = made.curves.iter().find(|curve| curve.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

/// Returns the values of a feature of the face, each with its span in milliseconds.
fn notes(made: &GeneratedMovement, feature: &str) -> Vec<(String, i64, i64)> {
    let about = NoteSubject::Component(SignComponent::NonManual, Some(feature.into()));
    let of_feature = made.notes.iter().filter(|note| note.about == about);
    let millis = |micros: i64| (micros as f64 / 1000.0).round() as i64;
    let each = of_feature.map(|note| {
        let [from, to] = [note.span.span_start_instant(), note.span.span_end_instant()];
        let value = note.value.reading_value().unwrap_or_default().to_owned();
        (value, millis(from.instant_micros()), millis(to.instant_micros()))
    });
    each.collect()
}

#[test]
fn a_value_becomes_its_curve_over_its_part_with_an_onset_and_an_offset() {
    let made = made("ESCARGOT | face brows=raised*0.5 over 0.4s..0.6s");
    let raised = values(&made, "brows.RB");
    for (n, value) in raised.iter().enumerate() {
        let at = n as f64 / 120.0;
        match at {
            at if (0.4..0.6).contains(&at) => assert_eq!(*value, 0.5, "{at}"),
            at if !(0.15..=0.85).contains(&at) => assert_eq!(*value, 0.0, "{at}"),
            _ => assert!((0.0..=0.5).contains(value), "{at}: {value}"),
        }
    }
    let leap = raised
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .fold(0.0, f64::max);
    assert!(leap < 0.03, "it rises and falls smoothly: {leap}");
    assert_eq!(notes(&made, "brows"), [("raised".to_owned(), 400, 600)]);
    let did = &made.report.steps[1].did;
    assert_eq!(did[..], ["the face shows brows=raised*0.5 from 0.400s to 0.600s"]);
}

#[test]
fn words_and_codes_of_every_part_show_the_same_face() {
    for (words, codes) in [
        ("brows=furrowed", "brows=FU"),
        ("eyes=squint", "lids=SB"),
        ("eyes=\"eyes narrowed\" brows=raised", ""),
        ("cheeks=C01", "cheeks=c01"),
        ("nose=wrinkled", "nose=WR"),
        ("mouth=o", "mouth=L06"),
        ("mouth=\"lèvres pincées\"", "mouth=L04"),
        ("gaze=left", "gaze=LE"),
        ("head=shaking", "head=SH"),
    ] {
        let shown = |part: &str| format!("ESCARGOT | face {part} over 0.2s..0.8s").parse::<Recipe>();
        if codes.is_empty() {
            assert!(shown(words).is_err(), "{words}");
            continue;
        }
        let (by_words, by_codes) = (
            made(&shown(words).expect(words).to_string()),
            made(&shown(codes).expect(codes).to_string()),
        );
        assert_eq!(by_words.curves, by_codes.curves, "{words}");
        assert_eq!(by_words.clip, by_codes.clip, "{words}");
    }
}

#[test]
fn each_value_that_a_part_lists_moves_the_face_or_the_head() {
    let own = made("ESCARGOT");
    for part in FacePart::ALL_FACE_PARTS {
        let inventory = part.face_part_inventory();
        assert_eq!(inventory.values.is_empty(), part == FacePart::Mouthing, "{part:?}");
        for value in &inventory.values {
            let recipe = format!("ESCARGOT | face {}={} over 0.1s..0.9s", part.face_part_name(), value.id);
            let made = made(&recipe);
            let seen = faces_from_curves(&made.curves).iter().any(|face| !face.is_at_rest());
            let resting = ["neutral", "addressee"].contains(&value.id.as_str());
            match part {
                FacePart::Head => assert_ne!(made.clip, own.clip, "{recipe}"),
                _ => assert_eq!(seen, !resting, "{recipe}"),
            }
        }
    }
    let face = |recipe: &str| faces_from_curves(&made(recipe).curves)[60];
    assert_eq!(face("ESCARGOT | face brows=raised mouth=smile").brows, [1.0, 1.0]);
    assert_eq!(face("ESCARGOT | face cheeks=puffed mouth=smile").corners, [1.0, 1.0]);
    assert_eq!(
        face("ESCARGOT | face eyes=closed"),
        FacePosture {
            lids: [1.0; 2],
            ..FacePosture::default()
        }
    );
}

#[test]
fn a_face_leaves_every_bone_and_every_other_curve_as_they_were() {
    for gloss in ["BOL", "LIMACE", "ESCARGOT"] {
        let own = made(gloss);
        for step in [
            "face brows=raised over 0.4s..0.5s",
            "face mouthing=bOl over 0.4s..0.5s",
            "face from LIMACE over 0.4s..0.5s",
        ] {
            let shown = made(&format!("{gloss} | {step}"));
            assert_eq!(shown.clip, own.clip, "{gloss} | {step}");
            for before in &own.curves {
                let after = values(&shown, &before.name);
                let is_body = ["head.", "body."].iter().any(|part| before.name.starts_with(part));
                for (n, (before, after)) in before.values.iter().zip(after).enumerate() {
                    if is_body || !(0.15..=0.75).contains(&(n as f64 / 120.0)) {
                        assert_eq!(before.to_bits(), after.to_bits(), "{gloss} | {step}: frame {n}");
                    }
                }
            }
        }
    }
}

#[test]
fn two_equal_steps_are_one_and_a_later_one_replaces_its_part() {
    for step in [
        "face brows=raised over 0.2s..0.6s",
        "face head=nodding",
        "face from LIMACE",
        "mouth \"bOl\"",
    ] {
        let (once, twice) = (made(&format!("BOL | {step}")), made(&format!("BOL | {step} | {step}")));
        assert_eq!(
            (&once.clip, &once.curves, &once.notes),
            (&twice.clip, &twice.curves, &twice.notes),
            "{step}"
        );
    }
    let both = made("ESCARGOT | face brows=raised mouth=smile | face brows=furrowed over 0.4s..0.6s");
    assert_eq!(
        (values(&both, "brows.RB")[60], values(&both, "brows.FU")[60]),
        (0.0, 1.0)
    );
    assert_eq!((values(&both, "brows.RB")[0], values(&both, "brows.FU")[0]), (1.0, 0.0));
    assert!(values(&both, "mouth.smile").iter().all(|value| *value == 1.0));
    let raised = |from, to| ("raised".to_owned(), from, to);
    let furrowed = ("furrowed".to_owned(), 400, 600);
    let mut brows = notes(&both, "brows");
    brows.sort_by_key(|note| note.1);
    assert_eq!(brows, [raised(0, 400), furrowed, raised(600, 1000)]);
    // A captured face gives way as well, and so does a mouthing to a gesture of the mouth.
    let captured = made("LIMACE | face brows=raised over 0.4s..0.6s");
    assert_eq!(values(&captured, "face.brow_squeeze")[60], 0.0);
    assert_eq!(values(&captured, "face.lip_corner_left")[60], -0.3);
    let still = made("BOL | face mouth=neutral brows=neutral");
    assert!(faces_from_curves(&still.curves).iter().all(FacePosture::is_at_rest));
}

#[test]
fn a_head_act_moves_the_head_as_notation_does_and_nothing_else() {
    let own = made("ESCARGOT");
    let shaken = made("ESCARGOT | face head=shaking over 0.3s..0.7s");
    assert_eq!(super::differing(&shaken, &own.clip), [JointGroup::Head]);
    let head = shaken.anatomy.part_joint(BodyPart::Head).expect("a head");
    let [before, after] = [&own, &shaken].map(|made| &made.clip.joint_channel(head).rotations);
    let turns: Vec<f64> = before
        .iter()
        .zip(after)
        .map(|(a, b)| a.angle_between(*b).to_degrees())
        .collect();
    let most = turns.iter().copied().fold(0.0, f64::max);
    assert!((10.0..=16.5).contains(&most), "16 degrees at most: {most}");
    let halved = made("ESCARGOT | face head=shaking*0.5 over 0.3s..0.7s");
    let half = halved
        .clip
        .joint_channel(head)
        .rotations
        .iter()
        .zip(before)
        .map(|(a, b)| a.angle_between(*b).to_degrees());
    assert!((half.fold(0.0, f64::max) - most / 2.0).abs() < 0.1);
}

#[test]
fn a_mouthing_moves_the_lips_through_its_sounds() {
    for recipe in [
        "ESCARGOT | mouth \"bOl\" over 0.2s..0.8s",
        "ESCARGOT | face mouthing=bOl over 0.2s..0.8s",
    ] {
        let made = made(recipe);
        let faces = faces_from_curves(&made.curves);
        assert!(faces[30].pressed > faces[60].pressed, "b closes the lips");
        assert!(
            faces[60].jaw > 0.3 && faces[60].jaw > faces[30].jaw,
            "O opens the mouth"
        );
        assert_eq!(notes(&made, "mouthing"), [("word".to_owned(), 200, 800)]);
    }
}

#[test]
fn the_face_alone_comes_from_another_sign() {
    let taken = made("BOL | face from LIMACE");
    assert!(values(&taken, "face.brow_squeeze").iter().all(|value| *value == 0.4));
    assert!(values(&taken, "brows.FU").iter().all(|value| *value == 0.0));
    assert!(values(&taken, "body.TF").iter().all(|value| *value == 0.5));
    assert!(taken.curves.iter().all(|curve| curve.name != "head.SH"));
    assert_eq!(taken.clip, made("BOL").clip);
    let then = made("BOL | face from LIMACE brows=raised");
    assert_eq!(
        (values(&then, "brows.RB")[9], values(&then, "face.brow_squeeze")[9]),
        (1.0, 0.0)
    );
    let none: Recipe = "BOL | face from ESCARGOT".parse().expect("a recipe");
    let error = evaluate_recipe(&resolve_recipe(&none, &shelf()).expect("found")).expect_err("no face");
    assert!(
        matches!(error.cause, StepError::NothingToTake { what: "face", .. }),
        "{error}"
    );
    let late: Recipe = "BOL | face brows=raised over 9s..10s".parse().expect("a recipe");
    let error = evaluate_recipe(&resolve_recipe(&late, &shelf()).expect("found")).expect_err("beyond its end");
    assert!(error.to_string().contains("name times within it"), "{error}");
}

#[test]
fn wrong_parts_and_values_are_refused_with_what_would_be_right() {
    for (text, at, want) in [
        (
            "face",
            8,
            "such as brows=raised (brows, eyes, cheeks, nose, mouth, mouthing, gaze, head)",
        ),
        (
            "face brwos=raised",
            9,
            "face has no \"brwos\"; write brows, eyes, cheeks, nose, mouth, mouthing, gaze, head",
        ),
        ("face brows", 9, "such as brows=raised"),
        ("face brows=raisd", 9, "brows has no \"raisd\"; write raised"),
        ("face eyes=sqint", 9, "eyes has no \"sqint\"; write slit"),
        ("face nose=qqqq", 9, "write neutral, wrinkled, twitching, widened"),
        ("face mouth=puffed", 9, "write cheeks=puffed"),
        ("face mouth=raised", 9, "write brows=raised"),
        ("face head=follows-gaze", 9, "head has no \"follows-gaze\""),
        ("face brows=raised*", 9, "a share from 0 to 1"),
        ("face brows=raised eyes", 22, "\"eyes\" stands where"),
        (
            "face brows=raised*much",
            9,
            "brows has no \"raised*much\"; write a share from 0 to 1, such as raised*0.5",
        ),
        ("face brows=raised*2", 9, "a share from 0 to 1, such as raised*0.5"),
        ("face brows=raised over 0.9s..0.2s", 0, "it ends before it begins"),
        ("mouth", 9, "the sounds of a word in SAMPA"),
        ("mouth \"b1l\"", 10, "write sounds of SAMPA, such as \"bOl\""),
        ("mouth \"?\"", 10, "mouthing has no \"?\""),
        ("face mouthing=\"\"", 9, "write sounds of SAMPA"),
    ] {
        let error = format!("A | {text}").parse::<Recipe>().expect_err(text);
        if let RecipeError::Text(error) = &error {
            assert_eq!(error.at, at, "{text}: {error}");
        }
        assert!(error.to_string().contains(want), "{text}: {error}");
    }
    for (settings, want) in [
        ("{}", "no part of the face is given"),
        (r#"{"show":{"brows":"raisd"}}"#, "brows has no \"raisd\""),
        (r#"{"show":{"ears":"raised"}}"#, "ears"),
        (r#"{"show":{"brows":"raised"},"speed":"2"}"#, "speed"),
        (r#"{"show":{"brows":"raised*-1"}}"#, "a share from 0 to 1"),
    ] {
        let json =
            format!(r#"{{"version":1,"make":{{"pipe":{{"of":{{"sign":"A"}},"steps":[{{"face":{settings}}}]}}}}}}"#);
        let error = serde_json::from_str::<Recipe>(&json).expect_err(settings).to_string();
        assert!(error.contains(want), "{settings}: {error}");
    }
}
