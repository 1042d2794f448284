//! Tests of the generated cuer: the fingertip reaches its targets in time, leaves the lips free, and impossible
//! requests are refused.

use std::sync::Arc;

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, Clip, FrameRate, HandAngles, ModelPose};
use chereme_sign::SignerHandedness;

use super::cue_places::{CueHeadSpace, lip_clearance};
use super::*;
use crate::poses::PoseOrigin;
use crate::sources::MovementMaterial;
use crate::testing::{Axes, skeleton};
use crate::units::{HandChoice, RecipeFactor};

fn work(axes: Axes, frames: u32) -> WorkingClip {
    let skeleton = Arc::new(skeleton(axes, 1.0));
    let rate = FrameRate::new(frames, 1).expect("a rate");
    WorkingClip::working_clip_from(&MovementMaterial {
        address: "stage".into(),
        hash: "stage".into(),
        gloss: "rest".into(),
        signer: None,
        handedness: SignerHandedness::Right,
        clip: Clip::from_rest_pose(Arc::clone(&skeleton), rate, 1),
        anatomy: Arc::new(BodyAnatomy::detect_anatomy(&skeleton)),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

fn settings(text: &str, phase: PhaseRule) -> CueSettings {
    CueSettings {
        text: text.to_owned(),
        phones: None,
        code: None,
        variants: Vec::new(),
        hand: HandChoice::Dominant,
        phase,
        pace: Some(RecipeFactor(1.6)),
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
            coding: None,
        }
    };
    (0..=8).map(|number| (number, pose(number))).collect()
}

/// All eight shapes and five placements.
const ALL: &str = "bonjour le chat dort sur un beau fauteuil vert et gagne du pain blanc, puis il mange";

#[test]
fn the_fingertip_reaches_every_target_on_any_axes_and_under_any_timing_rule() {
    for axes in [Axes::Plain, Axes::Odd] {
        for phase in PhaseRule::ALL_PHASE_RULES {
            let mut work = work(axes, 120);
            let settings = settings(ALL, phase);
            let done = perform_cues(&mut work, &settings, &shapes(), &CuePhases::default()).expect("cued");
            assert!(done.residual < 1e-3, "{axes:?} {phase:?} {}", done.residual);
            let read = read_cue_utterance(&settings).expect("read");
            let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(0));
            let head = CueHeadSpace::from_head_posture(&work.anatomy, &work.skeleton, &model, BodySide::Right)
                .expect("a head");
            let held: Vec<&GeneratedNote> = work
                .notes
                .iter()
                .filter(|note| note.about == NoteSubject::Component(SignComponent::Placement, None))
                .collect();
            assert_eq!(held.len(), read.keys.len());
            for (note, key) in held.iter().zip(&read.keys) {
                let frame = work.rate.nearest_frame_at(note.span.span_start_instant()) + 1;
                let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame));
                let shape = read.code.find_cue_shape(key.shape).expect("a shape");
                let name = format!("right-{}-tip", shape.points_with);
                let tip = work
                    .anatomy
                    .landmark_place_position(&work.skeleton, &model, &name)
                    .expect("a tip");
                let at = head.head_to_model_point(head.find_cue_spot(&key.placement).expect("a place").at);
                // Under rules other than the paper's the fingers may still be moving.
                if phase == PhaseRule::Paper {
                    assert!(tip.distance(at) < 0.01, "{} {}", key.placement, tip.distance(at));
                }
            }
        }
    }
}

#[test]
fn targets_keep_the_timing_rule_within_a_frame_and_leave_the_lips_free() {
    let mut work = work(Axes::Plain, 120);
    let settings = settings(ALL, PhaseRule::Paper);
    let done = perform_cues(&mut work, &settings, &shapes(), &CuePhases::default()).expect("cued");
    assert!(done.warnings.is_empty(), "{:?}", done.warnings);
    let read = read_cue_utterance(&settings).expect("read");
    let of = |tier: CueTier| {
        let own = work.notes.iter().filter(move |it| it.about == NoteSubject::Cue(tier));
        own.cloned().collect::<Vec<GeneratedNote>>()
    };
    let keys = of(CueTier::Keys);
    let hand: Vec<GeneratedNote> = of(CueTier::Hand)
        .into_iter()
        .filter(|note| note.value.reading_value().is_some_and(|it| !it.ends_with("rest-0")))
        .collect();
    assert_eq!((keys.len(), hand.len()), (read.keys.len(), read.keys.len()));
    let mut inside = 0;
    let mut pairs = 0;
    for ((key, hand), own) in keys.iter().zip(&hand).zip(&read.keys) {
        let shift = key.span.span_start_instant().instant_micros()
            - own.span.expect("times").span_start_instant().instant_micros();
        let wanted = match own.vowel {
            Some(vowel) if own.phones.len() > 1 => {
                let vowel = vowel.span_start_instant().instant_micros() + shift;
                pairs += 1;
                let within = key.span.span_start_instant().instant_micros()..vowel;
                inside += usize::from(within.contains(&hand.span.span_end_instant().instant_micros()));
                (key.span.span_start_instant().instant_micros() + vowel) / 2
            }
            _ => key.span.span_start_instant().instant_micros(),
        };
        let off = (hand.span.span_end_instant().instant_micros() - wanted).abs();
        assert!(off <= 8_334, "{:?} is off by {off} us", own.phones);
    }
    assert!(inside * 100 >= pairs * 99, "{inside} of {pairs} in their consonant");
    let faces = crate::face::faces_from_curves(&work.curves);
    assert!(faces.iter().any(|face| face.jaw > 0.6) && faces.iter().any(|face| face.pressed > 0.4));
    let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(0));
    let head = CueHeadSpace::from_head_posture(&work.anatomy, &work.skeleton, &model, BodySide::Right).expect("a head");
    let anatomy = &work.anatomy;
    for (frame, face) in faces.iter().enumerate().take(work.frames) {
        let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame));
        for finger in ["index", "middle"] {
            let name = format!("right-{finger}-tip");
            let tip: DVec3 = anatomy
                .landmark_place_position(&work.skeleton, &model, &name)
                .expect("a tip");
            let clear = lip_clearance(head.model_to_head_point(tip), face, head.size);
            assert!(clear > -0.02, "the {finger} finger covers the lips at {frame}: {clear}");
        }
    }
}

#[test]
fn sentences_that_cannot_be_cued_are_refused_with_a_reason() {
    let mut work = work(Axes::Plain, 60);
    for (text, message) in [("", "nothing"), ("!!!", "nothing"), ("…", "nothing")] {
        let error = perform_cues(
            &mut work,
            &settings(text, PhaseRule::Paper),
            &shapes(),
            &CuePhases::default(),
        );
        assert!(error.is_err(), "{text:?} {message}");
    }
    let long = "papa ".repeat(30_000);
    let error = perform_cues(
        &mut work,
        &settings(&long, PhaseRule::Paper),
        &shapes(),
        &CuePhases::default(),
    );
    assert!(matches!(error, Err(StepError::TooLong { .. })), "hours are refused");
    let mut other = settings("a", PhaseRule::Paper);
    other.code = Some("klingon".into());
    assert!(perform_cues(&mut work, &other, &shapes(), &CuePhases::default()).is_err());
}
