//! Manner of an act: its duration against the usual one, and its course over time.

use chereme_sign::hamnosys::{BodyLanguage, MotionManner};

use super::super::transcribe_scene::SignerScene;
use super::*;
use crate::transcribe::transcribe_tuned::tuned;

/// A candidate manner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TempoCandidate {
    Usual,
    Fast,
    Slow,
    Tense,
    Halt,
}

impl TempoCandidate {
    /// Returns the manner in notation.
    fn notate_tempo_manner(self, rest: bool) -> MotionManner {
        let mut manner = MotionManner {
            rest,
            ..MotionManner::default()
        };
        match self {
            Self::Usual => {}
            Self::Fast => manner.fast = true,
            Self::Slow => manner.slow = true,
            Self::Tense => manner.tense = true,
            Self::Halt => manner.halt = true,
        }
        manner
    }

    /// Returns its factor on the usual duration, and its penalty.
    fn tempo_duration_factor(self, l: &BodyLanguage) -> (f64, f64) {
        match self {
            Self::Usual => (1.0, 0.0),
            Self::Fast => (l.manner_fast, 0.05),
            Self::Slow => (l.manner_slow, 0.05),
            Self::Tense => (l.manner_tense, 0.25),
            Self::Halt => (l.manner_halt, 0.15),
        }
    }
}

/// The course of an act over time: `span` is the share of its time between a tenth and nine tenths of the
/// path; `late` (when half of the path is done) and `even` (how long its middle half takes) are shares of
/// that span.
#[derive(Debug, Clone, Copy)]
struct ActCourse {
    span: f64,
    late: f64,
    even: f64,
}

fn course_from_shares([span, late, even]: [f64; 3]) -> ActCourse {
    ActCourse { span, late, even }
}

/// The measured course of an act, with the seconds between a tenth and nine tenths of it.
struct MeasuredCourse {
    seconds: f64,
    course: ActCourse,
}

impl NotationWriter<'_> {
    /// Infers the manner of an act that begins `idle` frames after the one before.
    pub(super) fn infer_act_manner(
        &mut self,
        track: &HandTrajectory,
        act: &TranscribedAct,
        into_contact: bool,
        idle: usize,
    ) -> MotionManner {
        let scene = self.scene;
        let rest = scene.frames_to_seconds(idle) > tuned().manner.rests * scene.language.time_rest;
        let Some(found) = tempo(scene, track, act, into_contact) else {
            return TempoCandidate::Usual.notate_tempo_manner(rest);
        };
        let first = *act.frames.start();
        self.record_feature(FeatureKind::Manner, Some(track), first, &found, |tempo| {
            transcribe_words::describe_manner(&tempo.notate_tempo_manner(rest))
        });
        found.best.notate_tempo_manner(rest)
    }
}

/// Returns the tempo of an act; the residual is the logarithm of the ratio of times.
fn tempo(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    act: &TranscribedAct,
    into_contact: bool,
) -> Option<BestReading<TempoCandidate>> {
    let l = scene.language;
    let (first, last) = (*act.frames.start(), *act.frames.end());
    if let ActKind::Sway(sway) = &act.kind {
        let (time, whole) = (scene.frames_to_seconds(last - first), swayed(l, sway));
        let tempi = [TempoCandidate::Usual, TempoCandidate::Fast, TempoCandidate::Slow];
        return Some(nearest_tempo(&tempi, l, |_, factor| {
            let off = (time / (whole * factor)).ln().abs();
            (off, off)
        }));
    }
    let ran = ran(scene, track, act)?;
    let (usual, round) = usual_act_durations(scene, track, act)?;
    let all = [
        TempoCandidate::Usual,
        TempoCandidate::Fast,
        TempoCandidate::Slow,
        TempoCandidate::Tense,
        TempoCandidate::Halt,
    ];
    let tempi = &all[..if into_contact || round { 4 } else { 5 }];
    // A hand may come to rest at a contact that is not meant.
    let course_choices: &[(ActCourse, f64)] = match (round, into_contact) {
        (true, _) => &[(course_from_shares(tuned().manner.round), 0.0)],
        (false, true) => &[
            (course_from_shares(tuned().manner.contact), 0.0),
            (course_from_shares(tuned().manner.targetted), tuned().manner.unexpected),
        ],
        (false, false) => &[(course_from_shares(tuned().manner.targetted), 0.0)],
    };
    Some(nearest_tempo(tempi, l, |tempo, factor| {
        let courses = match tempo {
            TempoCandidate::Tense => &[(course_from_shares(tuned().manner.tense), 0.0)],
            TempoCandidate::Halt => &[(course_from_shares(tuned().manner.stop), 0.0)],
            _ => course_choices,
        };
        let scored = courses.iter().map(|(course, cost)| {
            let times = usual.iter().map(|&(usual, least)| {
                let expected_seconds = (usual * factor).max(least);
                (ran.seconds / (expected_seconds * course.span)).ln().abs()
            });
            let off = times.fold(f64::MAX, f64::min);
            let late = (ran.course.late - course.late).abs();
            let even = (ran.course.even - course.even).abs();
            (
                off,
                off + tuned().manner.late * late + tuned().manner.even * even + cost,
            )
        });
        scored.fold(
            (f64::MAX, f64::MAX),
            |best, tried| {
                if tried.1 < best.1 { tried } else { best }
            },
        )
    }))
}

fn nearest_tempo(
    tempi: &[TempoCandidate],
    l: &BodyLanguage,
    off: impl Fn(TempoCandidate, f64) -> (f64, f64),
) -> BestReading<TempoCandidate> {
    let scored = tempi.iter().map(|&tempo| {
        let (factor, cost) = tempo.tempo_duration_factor(l);
        let (residual, score) = off(tempo, factor);
        (tempo, residual, score + cost)
    });
    BestReading::pick_best_reading(scored.collect())
}

/// Returns the usual duration (s) of the same number of movements of wrist or fingers.
fn swayed(l: &BodyLanguage, sway: &HandSway) -> f64 {
    match sway {
        HandSway::Wrist { cycles, .. } => l.time_wrist * cycles.max(1.0),
        HandSway::Play { cycles, .. } => l.time_play * cycles.max(1.0),
    }
}

/// Returns the usual durations of an act and their lower bounds, in seconds, and whether it is a circle.
fn usual_act_durations(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    act: &TranscribedAct,
) -> Option<(Vec<(f64, f64)>, bool)> {
    let l = scene.language;
    let (first, last) = (*act.frames.start(), *act.frames.end());
    let turn = track.hand_turn_vector(first, last).length() / std::f64::consts::FRAC_PI_2;
    let gone = track.palm[first].distance(track.palm[last]) / scene.arm;
    // A posture taken at another place needs most of a transition.
    let taken = 0.6 * (l.time_transition + l.time_transition_arm * gone + l.time_turn * turn);
    // A meant movement is at its fastest 2.6 times as fast as on average.
    let least = 2.6 * polyline_length(&track.palm[first..=last]) / (l.speed_most * scene.arm);
    let with_turn = |usual: f64| {
        let turned = (act.turned || act.reshaped).then_some((usual, taken));
        [Some((usual, least)), turned].into_iter().flatten().collect::<Vec<_>>()
    };
    let (mut all, round) = match &act.kind {
        ActKind::Path(fitted) => match fitted.path {
            PathForm::Straight { .. } => (with_turn(l.time_straight), false),
            PathForm::Arc { .. } | PathForm::Wave { .. } => (with_turn(l.time_arc), false),
            PathForm::Circle { turns, .. } => (vec![(l.time_circle * turns.max(0.4), least)], true),
        },
        ActKind::Change => (vec![(l.time_replace, 0.0), (l.time_replace, taken)], false),
        ActKind::Sway(_) => return None,
    };
    // A simultaneous movement of wrist or fingers takes its own time.
    all.extend(act.with.iter().map(|sway| (swayed(l, sway), least)));
    Some((all, round))
}

/// Returns the course of an act by its path, or by its turn and finger angles if it stays in place; `None`
/// if it is too short.
fn ran(scene: &SignerScene<'_>, track: &HandTrajectory, act: &TranscribedAct) -> Option<MeasuredCourse> {
    let (first, last) = (*act.frames.start(), *act.frames.end());
    let step = |n: usize| match act.kind {
        ActKind::Change => track.hand_turn_vector(n, n + 1).length() + track.finger_angle_change(n, n + 1),
        _ => track.palm[n].distance(track.palm[n + 1]),
    };
    let mut done = vec![0.0];
    for n in first..last {
        done.push(done[done.len() - 1] + step(n));
    }
    let total_distance = done[done.len() - 1];
    if total_distance <= 0.0 || last < first + 3 {
        return None;
    }
    let share_time = |share: f64| {
        let goal = share * total_distance;
        let n = done.partition_point(|so_far| *so_far < goal).max(1);
        let (a, b) = (done[n - 1], done[n]);
        (n - 1) as f64 + if b > a { (goal - a) / (b - a) } else { 0.0 }
    };
    let [start, quarter, half, three, end] = [0.1, 0.25, 0.5, 0.75, 0.9].map(share_time);
    let span = (end - start).max(1e-3);
    Some(MeasuredCourse {
        seconds: span * scene.clip.clip_frame_rate().frame_time(),
        course: course_from_shares([0.0, (half - start) / span, (three - quarter) / span]),
    })
}
