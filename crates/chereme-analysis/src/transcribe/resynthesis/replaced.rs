//! Replaces inferred actions in a transcription by those that re-synthesis found, with their features.

use chereme_sign::hamnosys::{
    Aim, Circular, Directed, Manner, MotionKind, Place, Posture, Repeat, to_names,
};

use super::super::acts::wrist_name;
use super::super::words::{self, WordsAndSymbols};
use super::super::{Feature, FeatureKind, RunnerUp, Unit};
use super::*;

/// A value that notation states about an act.
pub(in crate::transcribe) type Stated = (FeatureKind, WordsAndSymbols);

/// Replaces the features and stages of actions in a transcription, `from` the inferred actions `to` others. `before` and
/// `after` are the deviations (m) of both from the observed movement: they become the residuals of the features that
/// change. A finding names both movements. `several` is the number of times that "several times" adds to the first one.
pub(in crate::transcribe) fn replace(
    found: &mut Transcription,
    [from, to]: [&[Motion]; 2],
    [before, after]: [f64; 2],
    several: f64,
) {
    let (old, new) = (acts(from), acts(to));
    let mut features = Vec::new();
    for (stage, (old, new)) in found.stages.iter_mut().skip(1).zip(old.iter().zip(new)) {
        let mut own: Vec<Feature> = found
            .features
            .extract_if(.., |feature| {
                let other = |side| stage.hand.is_some_and(|hand| hand != side);
                feature.action == stage.action && !feature.hand.is_some_and(other)
            })
            .collect();
        if **old != *new {
            stage.text = words::motion(new);
            restate(
                &mut own,
                stage,
                (stated(old, several), stated(new, several)),
                [before, after],
            );
        }
        features.extend(own);
    }
    found.features.extend(features);
    let names = |actions: &[Motion]| {
        let text: String = actions.iter().map(words::motion).collect();
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
pub(in crate::transcribe) fn acts(actions: &[Motion]) -> Vec<&Motion> {
    let of = |hand: usize| {
        actions.iter().flat_map(move |action| match &action.kind {
            MotionKind::Split(a, b) => match [a, b][hand].as_deref() {
                Some(Motion {
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
    own: &mut Vec<Feature>,
    stage: &Stage,
    (old, new): (Vec<Stated>, Vec<Stated>),
    [before, after]: [f64; 2],
) {
    let of = |all: &[Stated], kind: FeatureKind| -> Vec<WordsAndSymbols> {
        let all = all.iter().filter(|it| it.0 == kind);
        all.map(|it| it.1.clone()).collect()
    };
    let hand = stage.hand.or(own.iter().find_map(|it| it.hand));
    let mut kinds: Vec<FeatureKind> = old.iter().chain(&new).map(|it| it.0).collect();
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
                feature.unit = Unit::Centimetres;
            }
            (feature.value, feature.text) = (is.words.clone(), is.text.clone());
            true
        });
        own.extend(new.into_iter().skip(nth.max(old.len())).map(|is| Feature {
            kind,
            hand,
            frame: stage.frames.0,
            frames: stage.frames,
            action: stage.action,
            value: is.words,
            text: is.text,
            residual: 100.0 * after,
            unit: Unit::Centimetres,
            runner_up: None,
        }));
    }
}

/// Returns the values that the notation of an act states; `several` is the number of times that "several times" adds to
/// the first one.
pub(in crate::transcribe) fn stated(act: &Motion, several: f64) -> Vec<Stated> {
    let mut all = Vec::new();
    let mut manner = Manner::default();
    state(act, &mut all, &mut manner, several);
    if !all.iter().any(|it| it.0 == FeatureKind::Movement) {
        let replacement = WordsAndSymbols::new("replacement", "");
        all.insert(0, (FeatureKind::Movement, replacement));
    }
    all.push((FeatureKind::Manner, words::manner(&manner)));
    all
}

fn state(motion: &Motion, all: &mut Vec<Stated>, manner: &mut Manner, several: f64) {
    let own = &motion.manner;
    manner.fast |= own.fast;
    manner.slow |= own.slow;
    manner.tense |= own.tense;
    manner.halt |= own.halt;
    manner.rest |= own.rest;
    let mut say = |name: &str| {
        let text = words::motion(&Motion::new(motion.kind.clone()));
        all.push((FeatureKind::Movement, WordsAndSymbols::new(name, text)));
    };
    match &motion.kind {
        MotionKind::Directed(path) => {
            say(name(path));
            let course = words::course(&Aim::at(path.direction), false);
            all.push((FeatureKind::Course, course));
            all.push((FeatureKind::Size, words::size(path.size.first)));
        }
        MotionKind::Circular(Circular { axis, size, .. }) => {
            say("circle");
            all.push((FeatureKind::Course, words::course(&Aim::at(*axis), true)));
            all.push((FeatureKind::Size, words::size(size.first)));
        }
        MotionKind::Wrist { motion, size } => {
            say(wrist_name(*motion));
            all.push((FeatureKind::Size, words::size(*size)));
        }
        MotionKind::FingerPlay(_) => say("fingerplay"),
        MotionKind::Parallel(motions) | MotionKind::Sequence { motions, .. } => {
            for motion in motions {
                state(motion, all, manner, several);
            }
        }
        MotionKind::Target { motion, posture } => {
            if let Some(motion) = motion {
                state(motion, all, manner, several);
            }
            state_end(posture, all);
        }
        MotionKind::Repeated { motion, repetition } => {
            state(motion, all, manner, several);
            let more = |repeat: Repeat| match repeat {
                Repeat::FromStartSeveral | Repeat::ContinueSeveral => several as usize,
                _ => 1,
            };
            let times = 1 + more(repetition.repeat) + repetition.second.map_or(0, more);
            let mut stated = words::repetition(times, repetition.repeat);
            if let Some(second) = repetition.second {
                stated.text += &words::repetition(times, second).text;
            }
            all.push((FeatureKind::Repetition, stated));
        }
        MotionKind::Split(..)
        | MotionKind::Cross { .. }
        | MotionKind::Still
        | MotionKind::Body(_) => {}
    }
}

/// States the posture at the end of an act.
fn state_end(posture: &Posture, all: &mut Vec<Stated>) {
    if let Each::Shared(shape) = &posture.shape {
        all.push((FeatureKind::Handshape, words::shape(shape)));
    }
    if let Each::Shared(aim) = &posture.extended {
        all.push((FeatureKind::Direction, words::direction(aim)));
    }
    if let Each::Shared(aim) = &posture.palm {
        all.push((FeatureKind::Palm, words::palm(aim)));
    }
    match &posture.place {
        Some(Place::Body(place)) => {
            all.push((FeatureKind::Location, words::place(place)));
            all.push((FeatureKind::Contact, words::nearness(place)));
        }
        Some(Place::Hands(hands)) => all.push((FeatureKind::Contact, words::together(hands))),
        _ => {}
    }
}

fn name(path: &Directed) -> &'static str {
    match (&path.zigzag, &path.curve) {
        (Some(zigzag), _) if zigzag.wavy => "waves",
        (Some(_), _) => "zigzag",
        (None, Some(_)) => "arc",
        (None, None) => "straight",
    }
}
