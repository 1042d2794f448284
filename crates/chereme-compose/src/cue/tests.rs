//! Tests of the generated cuer: the fingertip reaches its targets in time, leaves the lips free, and impossible
//! requests are refused.

use std::sync::Arc;

use chereme_motion::glam::DVec3;
use chereme_motion::{Anatomy, Clip, HandAngles, ModelPose, Rate, Side};
use chereme_sign::Handedness;

use super::places::{Head, clearance};
use super::*;
use crate::poses::PoseOrigin;
use crate::sources::Material;
use crate::testing::{Axes, skeleton};
use crate::units::{Factor, Hands};

fn work(axes: Axes, frames: u32) -> Work {
    let skeleton = Arc::new(skeleton(axes, 1.0));
    let rate = Rate::new(frames, 1).expect("a rate");
    Work::of(&Material {
        address: "stage".into(),
        hash: "stage".into(),
        gloss: "rest".into(),
        signer: None,
        handedness: Handedness::Right,
        clip: Clip::still(Arc::clone(&skeleton), rate, 1),
        anatomy: Arc::new(Anatomy::detect(&skeleton)),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

fn settings(text: &str, phase: PhaseRule) -> Cue {
    Cue {
        text: text.to_owned(),
        phones: None,
        code: None,
        variants: Vec::new(),
        hand: Hands::Dominant,
        phase,
        pace: Some(Factor(1.6)),
        on: None,
    }
}

/// Straight fingers for every shape except the resting one.
fn shapes() -> Vec<(u8, HandPose)> {
    let pose = |number: u8| {
        let mut angles = HandAngles::default();
        for (n, finger) in angles.fingers.iter_mut().enumerate() {
            let bent = number == 0 || usize::from(number) % 4 < n;
            finger.flexion = if bent { [1.4, 1.6, 1.0] } else { [0.0; 3] };
        }
        angles.fingers[0].flexion = if matches!(number, 0 | 3) {
            [1.4, 1.6, 1.0]
        } else {
            [0.0; 3]
        };
        angles.fingers[1].flexion = if matches!(number, 0 | 1 | 6) {
            [1.4, 1.6, 1.0]
        } else {
            [0.0; 3]
        };
        HandPose {
            value: None,
            origin: PoseOrigin::Inventory("test".into()),
            angles,
            exact: None,
        }
    };
    (0..=8).map(|number| (number, pose(number))).collect()
}

/// All eight shapes and five placements.
const ALL: &str =
    "bonjour le chat dort sur un beau fauteuil vert et gagne du pain blanc, puis il mange";

#[test]
fn the_fingertip_reaches_every_target_on_any_axes_and_under_any_timing_rule() {
    for axes in [Axes::Plain, Axes::Odd] {
        for phase in PhaseRule::ALL {
            let mut work = work(axes, 120);
            let settings = settings(ALL, phase);
            let done = cue(&mut work, &settings, &shapes(), &CuePhases::default()).expect("cued");
            assert!(done.residual < 1e-3, "{axes:?} {phase:?} {}", done.residual);
            let read = read(&settings).expect("read");
            let model = ModelPose::of(&work.skeleton, &work.pose(0));
            let head =
                Head::of(&work.anatomy, &work.skeleton, &model, Side::Right).expect("a head");
            let held: Vec<&Note> = work
                .notes
                .iter()
                .filter(|note| note.about == About::Component(Component::Placement, None))
                .collect();
            assert_eq!(held.len(), read.keys.len());
            for (note, key) in held.iter().zip(&read.keys) {
                let frame = work.rate.frame_at(note.span.start()) + 1;
                let model = ModelPose::of(&work.skeleton, &work.pose(frame));
                let shape = read.code.shape(key.shape).expect("a shape");
                let name = format!("right-{}-tip", shape.points_with);
                let tip = work
                    .anatomy
                    .landmark(&work.skeleton, &model, &name)
                    .expect("a tip");
                let at = head.point(head.spot(&key.placement).expect("a place").at);
                // Under rules other than the paper's the fingers may still be moving.
                if phase == PhaseRule::Paper {
                    assert!(
                        tip.distance(at) < 0.01,
                        "{} {}",
                        key.placement,
                        tip.distance(at)
                    );
                }
            }
        }
    }
}

#[test]
fn targets_keep_the_timing_rule_within_a_frame_and_leave_the_lips_free() {
    let mut work = work(Axes::Plain, 120);
    let settings = settings(ALL, PhaseRule::Paper);
    let done = cue(&mut work, &settings, &shapes(), &CuePhases::default()).expect("cued");
    assert!(done.warnings.is_empty(), "{:?}", done.warnings);
    let read = read(&settings).expect("read");
    let of = |tier: CueTier| {
        let own = work
            .notes
            .iter()
            .filter(move |it| it.about == About::Cue(tier));
        own.cloned().collect::<Vec<Note>>()
    };
    let keys = of(CueTier::Keys);
    let hand: Vec<Note> = of(CueTier::Hand)
        .into_iter()
        .filter(|note| note.value.value().is_some_and(|it| !it.ends_with("rest-0")))
        .collect();
    assert_eq!((keys.len(), hand.len()), (read.keys.len(), read.keys.len()));
    let mut inside = 0;
    let mut pairs = 0;
    for ((key, hand), own) in keys.iter().zip(&hand).zip(&read.keys) {
        let shift = key.span.start().micros() - own.span.expect("times").start().micros();
        let wanted = match own.vowel {
            Some(vowel) if own.phones.len() > 1 => {
                let vowel = vowel.start().micros() + shift;
                pairs += 1;
                let within = key.span.start().micros()..vowel;
                inside += usize::from(within.contains(&hand.span.end().micros()));
                (key.span.start().micros() + vowel) / 2
            }
            _ => key.span.start().micros(),
        };
        let off = (hand.span.end().micros() - wanted).abs();
        assert!(off <= 8_334, "{:?} is off by {off} us", own.phones);
    }
    assert!(
        inside * 100 >= pairs * 99,
        "{inside} of {pairs} in their consonant"
    );
    let faces = crate::face::faces(&work.curves);
    assert!(faces.iter().any(|face| face.jaw > 0.6) && faces.iter().any(|face| face.pressed > 0.4));
    let model = ModelPose::of(&work.skeleton, &work.pose(0));
    let head = Head::of(&work.anatomy, &work.skeleton, &model, Side::Right).expect("a head");
    let anatomy = &work.anatomy;
    for (frame, face) in faces.iter().enumerate().take(work.frames) {
        let model = ModelPose::of(&work.skeleton, &work.pose(frame));
        for finger in ["index", "middle"] {
            let name = format!("right-{finger}-tip");
            let tip: DVec3 = anatomy
                .landmark(&work.skeleton, &model, &name)
                .expect("a tip");
            let clear = clearance(head.local(tip), face, head.size);
            assert!(
                clear > -0.02,
                "the {finger} finger covers the lips at {frame}: {clear}"
            );
        }
    }
}

#[test]
fn sentences_that_cannot_be_cued_are_refused_with_a_reason() {
    let mut work = work(Axes::Plain, 60);
    for (text, message) in [("", "nothing"), ("!!!", "nothing"), ("…", "nothing")] {
        let error = cue(
            &mut work,
            &settings(text, PhaseRule::Paper),
            &shapes(),
            &CuePhases::default(),
        );
        assert!(error.is_err(), "{text:?} {message}");
    }
    let long = "papa ".repeat(30_000);
    let error = cue(
        &mut work,
        &settings(&long, PhaseRule::Paper),
        &shapes(),
        &CuePhases::default(),
    );
    assert!(
        matches!(error, Err(Cause::TooLong { .. })),
        "hours are refused"
    );
    let mut other = settings("a", PhaseRule::Paper);
    other.code = Some("klingon".into());
    assert!(cue(&mut work, &other, &shapes(), &CuePhases::default()).is_err());
}
