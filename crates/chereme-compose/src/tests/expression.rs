//! Expressions of the face transferred phase by phase.

use chereme_motion::{BodyPart, RecordingInstant};
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};

use crate::outcome::{GeneratedCurve, GeneratedMovement};
use crate::testing::Shelf;
use crate::testing::restore_recipe_inputs;
use crate::work::JointGroup;
use crate::{Recipe, StepError, evaluate_recipe, resolve_recipe};

const OWN: [i64; 5] = [100, 250, 600, 800, 950];

/// A shelf on which BOL has an expression: brows that show the phase, from 0 at M1 to 1 at M5.
fn shelf() -> Shelf {
    let mut shelf = Shelf::new();
    let bol = shelf.materials.get_mut("BOL").expect("there");
    let rate = bol.clip.clip_frame_rate();
    let value = |frame: usize| {
        let at = rate.frame_start_instant(frame).instant_seconds() * 1000.0;
        let ends = OWN.map(|end| end as f64);
        match (0..4).find(|&n| at >= ends[n] && at < ends[n + 1]) {
            Some(n) => 0.25 * (n as f64 + (at - ends[n]) / (ends[n + 1] - ends[n])),
            None => 0.0,
        }
    };
    let brows = (0..bol.clip.clip_frame_count()).map(value).collect();
    let curve = |name: &str, values: Vec<f64>| GeneratedCurve {
        name: name.to_owned(),
        values,
    };
    bol.curves = vec![
        curve("face.brow_squeeze", brows),
        curve("face.jaw_open", vec![0.8; 120]),
    ];
    let marks = ExpressionMilestones::of_times(OWN.map(RecordingInstant::from_millis));
    shelf
        .expressions
        .insert("BOL".into(), (ExpressionFunction::from_function_name("wh"), marks));
    shelf
}

fn made(recipe: &str, shelf: &Shelf) -> GeneratedMovement {
    let recipe: Recipe = recipe.parse().unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let resolved = resolve_recipe(&recipe, shelf).unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let made = evaluate_recipe(&resolved).unwrap_or_else(|error| panic!("{recipe}: {error}"));
    let stored = restore_recipe_inputs(&recipe, resolved.resolved_inputs().clone(), shelf).expect("found again");
    assert_eq!(
        evaluate_recipe(&stored).expect("made again").clip,
        made.clip,
        "{recipe}"
    );
    made
}

fn curve<'a>(made: &'a GeneratedMovement, name: &str) -> &'a [f64] {
    let found = made.curves.iter().find(|curve| curve.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

#[test]
fn each_milestone_lands_within_a_frame_whatever_the_durations() {
    let shelf = shelf();
    for target in [
        [100, 250, 600, 800, 950],
        [50, 100, 150, 700, 990],
        [10, 400, 450, 460, 900],
    ] {
        let times = target.map(|at| format!("{at}ms")).join(", ");
        let recipe = format!("ESCARGOT | nonmanual wh from BOL over {times} by phases");
        let made = made(&recipe, &shelf);
        let brows = curve(&made, "face.brow_squeeze");
        let frame = |at: i64| {
            made.clip
                .clip_frame_rate()
                .nearest_frame_at(RecordingInstant::from_millis(at))
        };
        for (n, at) in target.into_iter().enumerate().take(4).skip(1) {
            let phase = 0.25 * n as f64;
            let around = &brows[frame(at) - 1..=frame(at) + 1];
            let (low, high) = (around[0].min(around[2]), around[0].max(around[2]));
            assert!(
                low <= phase + 1e-9 && high >= phase - 1e-9,
                "{recipe}: M{} {around:?}",
                n + 1
            );
        }
        assert!(brows[..frame(target[0])].iter().all(|value| *value == 0.0), "{recipe}");
        assert!(
            brows[frame(target[4]) + 1..].iter().all(|value| *value < 1e-9),
            "{recipe}"
        );
        let leap = brows
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).abs())
            .fold(0.0, f64::max);
        assert!(leap < 0.36, "{recipe}: it grows and fades, {leap}");
    }
}

#[test]
fn an_expression_moves_head_and_trunk_and_keeps_the_fingers() {
    let shelf = shelf();
    let recipe = "ESCARGOT | nonmanual from BOL over 0.1s, 0.25s, 0.6s, 0.8s, 0.95s by phases";
    let made = made(recipe, &shelf);
    let own = &shelf.materials["ESCARGOT"].clip;
    let groups = super::differing(&made, own);
    assert!(
        groups.contains(&JointGroup::Head) && groups.contains(&JointGroup::Trunk),
        "{groups:?}"
    );
    assert!(
        !groups
            .iter()
            .any(|group| matches!(group, JointGroup::Fingers(_) | JointGroup::Legs))
    );
    let head = made.anatomy.part_joint(BodyPart::Head).expect("a head");
    let theirs = &shelf.materials["BOL"].clip.joint_channel(head).rotations;
    let got = &made.clip.joint_channel(head).rotations;
    let same = made
        .clip
        .clip_frame_rate()
        .nearest_frame_at(RecordingInstant::from_millis(700));
    assert!(
        got[same].angle_between(theirs[same]) < 1e-6,
        "in the body it is the other's head"
    );
    assert_eq!(
        got[0],
        own.joint_channel(head).rotations[0],
        "before M1 nothing changes"
    );
    let hips = made.anatomy.part_joint(BodyPart::Hips).expect("hips");
    assert_eq!(made.clip.joint_channel(hips), own.joint_channel(hips));
}

#[test]
fn a_mouth_that_speaks_keeps_its_own_movement() {
    let mut shelf = shelf();
    let still = made("ESCARGOT | nonmanual from BOL by phases", &shelf);
    assert!(curve(&still, "face.jaw_open").iter().any(|value| *value > 0.7));
    let escargot = shelf.materials.get_mut("ESCARGOT").expect("there");
    escargot.curves = vec![GeneratedCurve {
        name: "mouthing.map".into(),
        values: vec![1.0; 120],
    }];
    let speaks = made("ESCARGOT | nonmanual from BOL by phases", &shelf);
    assert_eq!(curve(&speaks, "mouthing.map"), [1.0; 120]);
    assert!(speaks.curves.iter().all(|curve| curve.name != "face.jaw_open"));
    assert!(speaks.curves.iter().any(|curve| curve.name == "face.brow_squeeze"));
}

#[test]
fn milestones_follow_from_the_signs_that_are_spanned() {
    let shelf = shelf();
    let report = |recipe: &str| made(recipe, &shelf).report.steps.last().expect("a step").did[0].clone();
    let all = report("(ESCARGOT then CHAT then LIMACE) | nonmanual from BOL by phases");
    assert!(all.contains("onto -0.500s 0.000s"), "{all}");
    let last = report("(ESCARGOT then CHAT then LIMACE) | nonmanual from BOL over 1.9s..4s by phases");
    let (_, onto) = last.split_once("onto ").expect(&last);
    let times: Vec<&str> = onto.split(' ').collect();
    assert_eq!(times[2], "-", "one sign has no M3: {last}");
    let part = report("ESCARGOT | nonmanual from BOL over 0.8s..0.9s by phases");
    assert!(
        part.contains("onto 0.300s 0.800s") && part.contains("0.900s 1.400s"),
        "{part}"
    );
}

#[test]
fn an_expression_that_reaches_beyond_the_movement_is_reported() {
    let shelf = shelf();
    let said = |recipe: &str| {
        let made = made(recipe, &shelf);
        let step = made.report.steps.last().expect("a step");
        let said = step.did.iter().filter(|did| did.contains("not seen"));
        said.cloned().collect::<Vec<_>>()
    };
    let first = "the first 0.50 s lie before the movement and are not seen";
    let last = "the last 0.50 s lie after the movement and are not seen";
    assert_eq!(said("ESCARGOT | nonmanual from BOL by phases"), [first, last]);
    let within = "ESCARGOT | nonmanual from BOL over 0.1s, 0.2s, 0.6s, 0.8s, 1s by phases";
    assert_eq!(said(within), [""; 0]);
    let late = "ESCARGOT | nonmanual from BOL over 0s, 0.2s, 0.6s, 0.8s, 1.5s by phases";
    assert_eq!(said(late), [last]);
}

#[test]
fn an_expression_composes_with_other_operators() {
    let shelf = shelf();
    for recipe in [
        "ESCARGOT | retime 2 | nonmanual from BOL by phases | swap",
        "(ESCARGOT then CHAT) | nonmanual from BOL over 0.2s..1.5s by phases | reverse",
        "ESCARGOT | nonmanual from BOL over 0.2s..0.8s then LIMACE",
        "LIMACE | nonmanual from BOL by phases | repeat 2",
    ] {
        let made = made(recipe, &shelf);
        let brows = curve(&made, "face.brow_squeeze");
        assert_eq!(brows.len(), made.clip.clip_frame_count(), "{recipe}");
        assert!(brows.iter().any(|value| *value > 0.3), "{recipe}");
    }
}

#[test]
fn an_expression_without_milestones_is_refused_by_name() {
    let recipe: Recipe = "BOL | nonmanual from CHAT by phases".parse().expect("a recipe");
    let error = resolve_recipe(&recipe, &shelf()).expect_err("no milestones");
    assert!(matches!(error.cause, StepError::Source(_)), "{error}");
    assert!(error.to_string().contains("no expression"), "{error}");
    let wrong = "BOL | nonmanual from CHAT over 2s, 1s, 3s, 4s, 5s by phases";
    assert!(wrong.parse::<Recipe>().is_err());
}
