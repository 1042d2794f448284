//! The effect of each operator.

use std::sync::Arc;

use chereme_motion::BodyAnatomy;
use chereme_sign::SignerHandedness;

use super::*;
use crate::testing::{Axes, skeleton};
use chereme_sign::words::InterfaceLanguage;

#[test]
fn broken_contacts_are_reported() {
    let chin = "ESCARGOT | place right at chin with index";
    let away = made(&format!("{chin} | configure right S | place right by right 10cm"));
    assert!(
        away.report.contacts.iter().any(|c| c.contains("touched")),
        "{:?}",
        away.report.contacts
    );
    let text = away.report.to_string();
    assert!(
        text.contains("contacts undone") && text.contains("right fingers"),
        "{text}"
    );
    assert!(made("ESCARGOT | place both by up 2cm").report.contacts.is_empty());
}

#[test]
fn another_signer_s_sign_follows_on_the_first_one_s_body() {
    let made = made("BOL then LIMACE");
    bones_keep_their_lengths(&made.clip);
    assert_eq!(made.clip.clip_skeleton(), source("BOL").clip_skeleton());
    let glosses: Vec<_> = made
        .notes
        .iter()
        .filter(|n| n.about == NoteSubject::Gloss)
        .map(|n| n.value.reading_value().expect("a gloss").to_owned())
        .collect();
    assert_eq!(glosses, ["BOL", "LIMACE"]);
    assert_eq!(made.report.joins.len(), 2);
    let hand = made
        .anatomy
        .part_joint(BodyPart::Hand(BodySide::Right))
        .expect("a hand");
    let path = made.clip.joint_path(hand);
    let step = path.windows(2).map(|w| w[0].distance(w[1])).fold(0.0, f64::max);
    assert!(step < 0.05, "no jump of the wrist: {step}");
    assert_eq!(made.clip.clip_frame_count(), {
        let frames = made.clip.clip_frame_count();
        assert!((240..340).contains(&frames), "{frames}");
        frames
    });
}

#[test]
fn trunk_and_legs_change_over_as_slowly_as_the_hands() {
    for recipe in [
        "BOL then LIMACE",
        "(ESCARGOT | span 0.3s..0.8s) then (LIMACE | span 0.4s..0.9s)",
        "(BOL | span 0.2s..0.7s) then (ESCARGOT | span 0.3s..0.8s)",
    ] {
        let made = made(recipe);
        let hands = made.report.joins.iter().map(|join| join.span.span_seconds());
        let fastest = hands.fold(f64::INFINITY, f64::min);
        let mut notes = made.notes.iter();
        let body = notes.find(|note| note.about == NoteSubject::Transition);
        let body = body.expect("a transition").span.span_seconds();
        assert!((body - fastest).abs() < 1e-6, "{recipe}: {body} and {fastest} s");
        assert!(body >= 0.14, "{recipe}: {body} s");
    }
}

#[test]
fn a_repetition_joins_its_copies_smoothly() {
    let made = made("LIMACE | repeat 3 gap 0.1s");
    assert_eq!(made.clip.clip_frame_count(), 3 * 120 + 2 * 12);
    assert_eq!(made.clip.clip_pose_at(5), made.clip.clip_pose_at(5 + 132));
    assert!(make("LIMACE | repeat 1000 gap 60s").is_err());
}

#[test]
fn paths_are_amplified_displaced_and_directed() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let before = wrist(&made(gloss), BodySide::Right);
        let small = wrist(&made(&format!("{gloss} | amplify right 0.5")), BodySide::Right);
        let far = |path: &[DVec3]| path[10].distance(path[80]);
        assert!((far(&small) - far(&before) / 2.0).abs() < 1e-4, "{gloss}");
        let carried = made(&format!("{gloss} | travel right down 6cm then up 6cm"));
        let path = wrist(&carried, BodySide::Right);
        assert!(path[0].abs_diff_eq(before[0], 1e-6) && path[119].abs_diff_eq(before[119], 1e-3));
        assert!((before[60].y - path[60].y - 0.06).abs() < 2e-3, "{gloss}");
        let curve = "travel right through 0cm,-6cm,0cm then 4cm,-6cm,0cm in 0.8s";
        let curved = made(&format!("{gloss} | {curve}"));
        let path = wrist(&curved, BodySide::Right);
        let gone = |f: usize| path[f] - before[f];
        assert!(gone(0).length() < 1e-6, "{gloss}");
        let end = DVec3::new(0.04, -0.06, 0.0);
        for f in [100, 119] {
            // The recording has 120 frames per second: from frame 96 on the hand stays at the end of the curve.
            assert!(gone(f).abs_diff_eq(end, 3e-3), "{gloss} {f}: {}", gone(f));
        }
        let sent = made(&format!("{gloss} | from me to left with right"));
        let path = wrist(&sent, BodySide::Right);
        assert!(path[119].x > path[0].x + 0.05, "{gloss}: {} {}", path[0], path[119]);
        let across = wrist(&made(&format!("{gloss} | from right to left")), BodySide::Right);
        assert!(across[119].x > across[0].x + 0.3, "{gloss}: {across:?}");
        for made in [carried, curved, sent] {
            bones_keep_their_lengths(&made.clip);
            assert_eq!(differing(&made, &source(gloss)), [JointGroup::Arm(BodySide::Right)]);
        }
    }
}

#[test]
fn hands_turn_as_asked_and_stay_where_they_are() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let made = made(&format!("{gloss} | orient right palm up fingers forward"));
        let model = made.clip.model_pose(60);
        let frame = made.anatomy.body_frame(&model).expect("a trunk");
        let palm = made.anatomy.palm_normal(BodySide::Right, &model).expect("fingers");
        let fingers = made.anatomy.hand_direction(BodySide::Right, &model).expect("fingers");
        assert!(palm.angle_between(DVec3::Y) < 1e-6 && fingers.angle_between(frame.forward) < 0.2);
        let before = wrist(&super::made(gloss), BodySide::Right);
        for (a, b) in before.iter().zip(wrist(&made, BodySide::Right)) {
            assert!(a.distance(b) < 1e-3);
        }
    }
    let turned = made("ESCARGOT | orient right by 30deg about up by -30deg about up");
    assert!(farthest(&turned.clip, &source("ESCARGOT")) < 1e-6);
}

#[test]
fn time_is_stretched_as_a_whole_and_phase_by_phase() {
    let slow = made("ESCARGOT | retime 200%");
    assert_eq!(slow.clip.clip_frame_count(), 240);
    assert!(slow.notes.iter().any(|n| n.span == crate::testing::span(400, 1600)));
    let phases = made("ESCARGOT | retime 1, to 1.2s, 50%");
    assert_eq!(phases.clip.clip_frame_count(), 24 + 144 + 12);
    assert!(phases.notes.iter().any(|n| n.span == crate::testing::span(200, 1400)));
    assert_eq!(made("ESCARGOT | retime 1").clip, source("ESCARGOT"));
    let error = make("ESCARGOT | retime 1, 2").expect_err("two of three").to_string();
    assert!(error.contains("the sign has 3 phases"), "{error}");
}

#[test]
fn the_head_movement_of_another_sign_replaces_only_the_head() {
    for donor in ["BOL", "LIMACE"] {
        let made = made(&format!("ESCARGOT | nonmanual from {donor}"));
        assert_eq!(differing(&made, &source("ESCARGOT")), [JointGroup::Head], "{donor}");
    }
}

#[test]
fn repetitions_shrink_and_quicken() {
    let made = made("ESCARGOT | repeat 3 scale 0.5 tempo 2 gap 0.1s");
    assert_eq!(made.clip.clip_frame_count(), 120 + 12 + 60 + 12 + 30);
    let path = wrist(&made, BodySide::Right);
    let size = |p: &[DVec3]| p.iter().map(|a| a.distance(p[0])).fold(0.0, f64::max);
    assert!((size(&path[132..192]) / size(&path[..120]) - 0.5).abs() < 0.05);
}

#[test]
fn words_are_spelt_letter_by_letter() {
    for (recipe, side) in [
        ("spell USU", BodySide::Right),
        ("spell US left on signer:2", BodySide::Left),
    ] {
        let made = made(recipe);
        bones_keep_their_lengths(&made.clip);
        let letters: Vec<_> = made.notes.iter().filter(|n| n.hand == Some(side)).collect();
        assert_eq!(letters.len(), recipe.split(' ').nth(1).expect("a word").len());
        for note in letters {
            let frame = made
                .clip
                .clip_frame_rate()
                .nearest_frame_at(note.span.span_start_instant())
                + 5;
            let model = made.clip.model_pose(frame);
            let up = made.anatomy.hand_direction(side, &model).expect("fingers");
            let palm = made.anatomy.palm_normal(side, &model).expect("fingers");
            let body = made.anatomy.body_frame(&model).expect("a trunk");
            assert!(up.angle_between(DVec3::Y) < 1e-6 && palm.angle_between(body.forward) < 0.01);
            let pose = made.clip.clip_pose_at(frame);
            let shown = made
                .anatomy
                .hand_angles(made.clip.clip_skeleton(), side, &pose)
                .expect("fingers");
            let wanted = match note.value.reading_value() {
                Some("U") => "LIMACE",
                _ => "BOL",
            };
            assert!(shown.fingers[1].flexion[1] > 0.1, "{wanted}");
        }
        assert!(made.report.steps[0].residual.expect("reached") < 1e-3);
    }
    assert!(made("spell UU | travel right 20cm").clip.clip_frame_count() > 50);
    assert!(
        make("spell UQ")
            .expect_err("no Q")
            .to_string()
            .contains("no configuration")
    );
}

#[test]
fn the_finger_points_at_the_target() {
    for (recipe, target) in [
        ("point right at -40cm,120cm,150cm", DVec3::new(-0.4, 1.2, 1.5)),
        ("point left at 60cm,180cm,60cm", DVec3::new(0.6, 1.8, 0.6)),
        (
            "point right at -10cm,120cm,35cm with U via cosine 0.4s",
            DVec3::new(-0.1, 1.2, 0.35),
        ),
        ("point right at 200cm,10cm,50cm", DVec3::new(2.0, 0.1, 0.5)),
    ] {
        let made = made(&format!("{recipe} on signer:1"));
        let side = if recipe.contains("left") {
            BodySide::Left
        } else {
            BodySide::Right
        };
        let model = made.clip.model_pose(made.clip.clip_frame_count() / 2);
        let base = made
            .anatomy
            .part_joint(BodyPart::Finger(side, chereme_motion::HandFinger::Index, 1))
            .expect("a finger");
        let tip = made
            .anatomy
            .landmark_place_position(
                made.clip.clip_skeleton(),
                &model,
                &format!("{}-index-tip", side.body_side_name()),
            )
            .expect("a tip");
        let line = tip - model.model_joint_position(base);
        let miss = (target - tip).reject_from(line).length();
        assert!(miss < 0.002 && line.dot(target - tip) > -0.03, "{recipe}: {miss}");
        assert_eq!(
            made.clip.clip_pose_at(0),
            made.clip.clip_pose_at(made.clip.clip_frame_count() - 1),
            "back at rest"
        );
        bones_keep_their_lengths(&made.clip);
    }
}

#[test]
fn letters_take_the_time_from_the_recipe_or_else_from_the_corpus() {
    let seconds = |recipe: &str| {
        let made = made(recipe);
        let report = made.report.steps[0].did.join("\n");
        (made.clip.clip_span().span_seconds(), report)
    };
    let (learned, report) = seconds("spell UB");
    assert!((learned - 0.75).abs() < 0.02, "{learned}");
    assert!(report.contains("0.30 s, the median of 9") && report.contains("0.15 s, the median of 8"));
    let (half, report) = seconds("spell UB hold 0.1s");
    assert!(
        (half - 0.35).abs() < 0.02 && !report.contains("held for"),
        "{half} {report}"
    );
    let (asked, report) = seconds("spell UB hold 0.1s via learned 0.5s");
    assert!((asked - 0.7).abs() < 0.02, "{asked}");
    assert!(report.contains("learned from 12 transitions of fingers"), "{report}");
}

#[test]
fn touches_stay_touches_on_another_body() {
    let touching = made("ESCARGOT | place right at chin with index");
    for (axes, size) in [(Axes::Plain, 0.8), (Axes::Odd, 1.1)] {
        let body = Arc::new(skeleton(axes, size));
        let anatomy = Arc::new(BodyAnatomy::detect_anatomy(&body));
        let handedness = SignerHandedness::Right;
        let moved = crate::on_body(&touching.clip, &touching.anatomy, handedness, &body, &anatomy).expect("moved");
        assert!(moved.contacts > 0, "{size}");
        assert_eq!(moved.lost, Vec::<String>::new(), "{size}");
    }
}

#[test]
fn contacts_are_followed_through_every_operator() {
    let touching = "ESCARGOT | place right at chin with index";
    let contacts = |step: &str| made(&format!("{touching} | {step}")).report.contacts;
    for kept in ["reverse", "repeat 2", "repeat 3 tempo 1.3", "retime 150%"] {
        assert_eq!(contacts(kept), Vec::<String>::new(), "{kept}");
    }
    // The head is turned aside, so that the mirror image of the hand misses the nose.
    for mirrored in ["swap", "mirror right"] {
        let reports = contacts(mirrored);
        assert!(!reports.is_empty(), "{mirrored}");
        let names_both = |text: &String| text.contains("right-thumb-tip touched nose");
        assert!(
            reports
                .iter()
                .any(|text| names_both(text) && text.contains("now left-thumb-tip")),
            "{reports:?}"
        );
    }
    // A shrunk movement no longer reaches its contact, or the report describes the restored contact.
    let shrunk = made(&format!("{touching} | repeat 2 scale 0.3"));
    let report = format!("{}{:?}", shrunk.report, shrunk.report.contacts);
    assert!(report.contains("repetition 2: "), "{report}");
}

#[test]
fn mirrored_hands_that_would_pass_through_each_other_are_reported() {
    let crossed = made("ESCARGOT | place right by left 40cm | mirror right");
    let report = crossed.report.to_string();
    assert!(report.contains("go through each other"), "{report}");
    let apart = made("ESCARGOT | place right by right 20cm | mirror right");
    assert!(!apart.report.to_string().contains("go through each other"));
}

#[test]
fn a_spelling_hand_follows_a_smooth_curve_whose_shape_is_reported() {
    let points = "through 3cm,8cm,0cm then 10cm,12cm,0cm then 17cm,8cm,0cm then 20cm,0cm,0cm";
    let made = made(&format!("spell UU | travel right {points}"));
    assert!(
        made.report.steps[1].did[0].contains("a curve of"),
        "{:?}",
        made.report.steps[1].did
    );
    let spelt = wrist(&self::made("spell UU"), BodySide::Right);
    let path = wrist(&made, BodySide::Right);
    // The curve is the difference to the movement without it: the hand moves between letters as well.
    let gone: Vec<DVec3> = path.iter().zip(&spelt).map(|(a, b)| *a - *b).collect();
    let steps: Vec<DVec3> = gone.windows(2).map(|it| it[1] - it[0]).collect();
    let moving = steps.iter().filter(|it| it.length() > 2e-3);
    let moving: Vec<&DVec3> = moving.collect();
    assert!(moving.len() > 10);
    for pair in moving.windows(2) {
        let turn = pair[0].angle_between(*pair[1]);
        assert!(turn < 0.6, "a corner of {turn} radians");
    }
    let did = &made.report.steps[1].did[0];
    assert!(did.ends_with("(arc)"), "{did}");
}

#[test]
fn every_operator_of_the_list_has_one_name_and_its_own_words() {
    let words = crate::recipe::Step::operator_first_words();
    let mut once = words.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), words.len(), "a word begins two operators");
    for step in crate::recipe::Step::usual() {
        let json = serde_json::to_value(&step).expect("JSON");
        let key = json.as_str().or_else(|| {
            let object = json.as_object()?;
            object.keys().next().map(String::as_str)
        });
        assert_eq!(key, Some(step.name()), "{json}");
        let text = step.to_string();
        let first = text.split(' ').next().expect("a word");
        assert!(words.contains(&first), "{text}");
        if step.check_step_settings().is_ok() {
            let recipe = format!("A | {text}");
            let again: crate::Recipe = recipe.parse().expect(&recipe);
            assert_eq!(again.to_string(), recipe);
        }
    }
}

#[test]
fn a_sign_named_like_a_recipe_keyword_is_quoted() {
    for word in crate::recipe::Step::operator_first_words()
        .into_iter()
        .chain(["cue", "near", "over", "palm", "scale", "me", "then"])
    {
        let sign = crate::recipe::RecipeNode::Sign(word.to_owned());
        let text = sign.to_string();
        assert_eq!(text, format!("\"{word}\""));
        let recipe: crate::Recipe = text.parse().expect(&text);
        assert_eq!(*recipe.recipe_root(), sign);
    }
}

#[test]
fn the_words_of_operators_are_in_both_languages_and_their_examples_are_recipes() {
    for mut step in crate::recipe::Step::usual() {
        let words = step.description();
        assert!(!words.examples.is_empty(), "{}", step.name());
        for (recipe, _) in words.examples {
            let read: Result<crate::Recipe, _> = format!("A | {recipe}").parse();
            let read = read.unwrap_or_else(|error| panic!("{recipe}: {error}"));
            assert!(!read.to_string().ends_with("A"), "{recipe} changes nothing");
        }
        let effects = words.examples.iter().map(|(_, effect)| *effect);
        let mut texts = vec![words.title, words.hint];
        texts.extend(effects);
        texts.extend(step.fields().into_iter().map(|setting| setting.label));
        for text in texts {
            for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
                let words = text.text_in_language(language);
                assert!(!words.trim().is_empty() && !words.contains("operator-"), "{text:?}");
            }
        }
    }
}
