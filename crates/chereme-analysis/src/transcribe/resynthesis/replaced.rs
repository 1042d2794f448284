//! Replaces inferred actions in a transcription by those that re-synthesis found, with their features.

use chereme_sign::hamnosys::{
    CircularPath, DirectedPath, DirectionAim, HandPlace, MotionKind, MotionManner, NotatedPosture, RepeatKind, to_names,
};

use super::super::acts::wrist_name;
use super::super::transcribe_words::{self, WordsAndSymbols};
use super::super::{FeatureKind, NotationFeature, ResidualUnit, RunnerUp};
use super::*;

/// A value that notation states about an act.
pub(in crate::transcribe) type StatedValue = (FeatureKind, WordsAndSymbols);

/// Replaces the features and stages of actions in a transcription, `from` the inferred actions `to` others. `before` and
/// `after` are the deviations (m) of both from the observed movement: they become the residuals of the features that
/// change. A finding names both movements. `several` is the number of times that "several times" adds to the first one.
pub(in crate::transcribe) fn replace_transcribed_actions(
    found: &mut TokenTranscription,
    [from, to]: [&[NotatedMotion]; 2],
    [before, after]: [f64; 2],
    several: f64,
) {
    let (old, new) = (list_single_acts(from), list_single_acts(to));
    let mut features = Vec::new();
    for (stage, (old, new)) in found.stages.iter_mut().skip(1).zip(old.iter().zip(new)) {
        let mut stage_features: Vec<NotationFeature> = found
            .features
            .extract_if(.., |feature| {
                let other = |side| stage.hand.is_some_and(|hand| hand != side);
                feature.action == stage.action && !feature.hand.is_some_and(other)
            })
            .collect();
        if **old != *new {
            stage.text = transcribe_words::motion_hamnosys(new);
            restate(
                &mut stage_features,
                stage,
                stated_act_values(old, several),
                stated_act_values(new, several),
                [before, after],
            );
        }
        features.extend(stage_features);
    }
    found.features.extend(features);
    let names = |actions: &[NotatedMotion]| {
        let text: String = actions.iter().map(transcribe_words::motion_hamnosys).collect();
        to_names(&text).map_or(text, |names| names.join(" "))
    };
    found.findings.push(format!(
        "re-synthesised, the movement {} is {:.1} cm from the observed one; {}, which was read first, is {:.1} cm from it",
        names(to),
        100.0 * after,
        names(from),
        100.0 * before
    ));
}

/// Returns the single acts of actions, in the order of the stages: those of the dominant hand first.
#[must_use]
pub fn list_single_acts(actions: &[NotatedMotion]) -> Vec<&NotatedMotion> {
    let of = |hand: usize| {
        actions.iter().flat_map(move |action| match &action.kind {
            MotionKind::Split(a, b) => match [a, b][hand].as_deref() {
                Some(NotatedMotion {
                    kind: MotionKind::Sequence { motions, .. },
                    ..
                }) => motions.iter().collect(),
                motion => motion.into_iter().collect(),
            },
            _ if hand == 0 => vec![action],
            _ => Vec::new(),
        })
    };
    of(0).chain(of(1)).collect()
}

/// Changes the features of an act from the `old` values to the `new` ones.
fn restate(
    own: &mut Vec<NotationFeature>,
    stage: &TranscriptionStage,
    old: Vec<StatedValue>,
    new: Vec<StatedValue>,
    [before, after]: [f64; 2],
) {
    let of = |all: &[StatedValue], kind: FeatureKind| -> Vec<WordsAndSymbols> {
        let all = all.iter().filter(|statement| statement.0 == kind);
        all.map(|statement| statement.1.clone()).collect()
    };
    let hand = stage.hand.or(own.iter().find_map(|feature| feature.hand));
    let mut kinds: Vec<FeatureKind> = old.iter().chain(&new).map(|statement| statement.0).collect();
    kinds.sort();
    kinds.dedup();
    for kind in kinds {
        let (old, new) = (of(&old, kind), of(&new, kind));
        let mut nth = 0;
        own.retain_mut(|feature| {
            if feature.kind != kind {
                return true;
            }
            nth += 1;
            let (was, is) = (old.get(nth - 1), new.get(nth - 1));
            // A value that only the old notation states goes with it.
            let Some(is) = is else {
                return was.is_none();
            };
            if was == Some(is) {
                return true;
            }
            if feature.value != is.words {
                feature.runner_up = Some(RunnerUp {
                    value: std::mem::take(&mut feature.value),
                    text: std::mem::take(&mut feature.text),
                    residual: 100.0 * before,
                });
                feature.residual = 100.0 * after;
                feature.unit = ResidualUnit::Centimetres;
            }
            (feature.value, feature.text) = (is.words.clone(), is.text.clone());
            true
        });
        own.extend(new.into_iter().skip(nth.max(old.len())).map(|is| NotationFeature {
            kind,
            hand,
            frame: stage.frames.0,
            frames: stage.frames,
            action: stage.action,
            value: is.words,
            text: is.text,
            residual: 100.0 * after,
            unit: ResidualUnit::Centimetres,
            runner_up: None,
        }));
    }
}

/// Returns the values that the notation of an act states; `several` is the number of times that "several times" adds to
/// the first one.
pub(in crate::transcribe) fn stated_act_values(act: &NotatedMotion, several: f64) -> Vec<StatedValue> {
    let mut all = Vec::new();
    let mut manner = MotionManner::default();
    collect_stated_values(act, &mut all, &mut manner, several);
    if !all.iter().any(|statement| statement.0 == FeatureKind::Movement) {
        let replacement = WordsAndSymbols::new("replacement", "");
        all.insert(0, (FeatureKind::Movement, replacement));
    }
    all.push((FeatureKind::Manner, transcribe_words::describe_manner(&manner)));
    all
}

fn collect_stated_values(motion: &NotatedMotion, all: &mut Vec<StatedValue>, manner: &mut MotionManner, several: f64) {
    let motion_manner = &motion.manner;
    manner.fast |= motion_manner.fast;
    manner.slow |= motion_manner.slow;
    manner.tense |= motion_manner.tense;
    manner.halt |= motion_manner.halt;
    manner.rest |= motion_manner.rest;
    let mut say = |name: &str| {
        let text = transcribe_words::motion_hamnosys(&NotatedMotion::new(motion.kind.clone()));
        all.push((FeatureKind::Movement, WordsAndSymbols::new(name, text)));
    };
    match &motion.kind {
        MotionKind::Directed(path) => {
            say(directed_path_name(path));
            let course = transcribe_words::describe_movement_course(&DirectionAim::aim_at(path.direction), false);
            all.push((FeatureKind::Course, course));
            all.push((FeatureKind::Size, transcribe_words::describe_path_size(path.size.first)));
        }
        MotionKind::Circular(CircularPath { axis, size, .. }) => {
            say("circle");
            all.push((
                FeatureKind::Course,
                transcribe_words::describe_movement_course(&DirectionAim::aim_at(*axis), true),
            ));
            all.push((FeatureKind::Size, transcribe_words::describe_path_size(size.first)));
        }
        MotionKind::Wrist { motion, size } => {
            say(wrist_name(*motion));
            all.push((FeatureKind::Size, transcribe_words::describe_path_size(*size)));
        }
        MotionKind::FingerPlay(_) => say("fingerplay"),
        MotionKind::Parallel(motions) | MotionKind::Sequence { motions, .. } => {
            for motion in motions {
                collect_stated_values(motion, all, manner, several);
            }
        }
        MotionKind::Target { motion, posture } => {
            if let Some(motion) = motion {
                collect_stated_values(motion, all, manner, several);
            }
            state_end(posture, all);
        }
        MotionKind::Repeated { motion, repetition } => {
            collect_stated_values(motion, all, manner, several);
            let more = |repeat: RepeatKind| match repeat {
                RepeatKind::FromStartSeveral | RepeatKind::ContinueSeveral => several as usize,
                _ => 1,
            };
            let times = 1 + more(repetition.repeat) + repetition.second.map_or(0, more);
            let mut stated = transcribe_words::describe_repetition(times, repetition.repeat);
            if let Some(second) = repetition.second {
                stated.text += &transcribe_words::describe_repetition(times, second).text;
            }
            all.push((FeatureKind::Repetition, stated));
        }
        MotionKind::Split(..) | MotionKind::Cross { .. } | MotionKind::Still | MotionKind::Body(_) => {}
    }
}

/// States the posture at the end of an act.
fn state_end(posture: &NotatedPosture, all: &mut Vec<StatedValue>) {
    if let EachHand::Shared(shape) = &posture.shape {
        all.push((FeatureKind::Handshape, transcribe_words::describe_handshape(shape)));
    }
    if let EachHand::Shared(aim) = &posture.extended {
        all.push((FeatureKind::Direction, transcribe_words::describe_aim_direction(aim)));
    }
    if let EachHand::Shared(aim) = &posture.palm {
        all.push((FeatureKind::Palm, transcribe_words::describe_palm(aim)));
    }
    match &posture.place {
        Some(HandPlace::Body(place)) => {
            all.push((FeatureKind::Location, transcribe_words::describe_body_place(place)));
            all.push((FeatureKind::Contact, transcribe_words::describe_place_contact(place)));
        }
        Some(HandPlace::Hands(hands)) => {
            all.push((FeatureKind::Contact, transcribe_words::describe_hands_together(hands)))
        }
        _ => {}
    }
}

fn directed_path_name(path: &DirectedPath) -> &'static str {
    match (&path.zigzag, &path.curve) {
        (Some(zigzag), _) if zigzag.wavy => "waves",
        (Some(_), _) => "zigzag",
        (None, Some(_)) => "arc",
        (None, None) => "straight",
    }
}
