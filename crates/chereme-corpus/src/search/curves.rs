//! Conditions on curves of the face and head, evaluated on captured faces, skeletons and generated curves.

use chereme_motion::{Face, Instant};
use chereme_sign::query::{CurveTest, QueryError, Test};
use chereme_sign::text::nearest;

use super::compile::{Ask, Asked};
use super::plan::Plan;
use super::probe::{Probe, RowField};
use crate::db::{recordings, signs};
use crate::face::{Fits, numbers_of};

/// The frames per second at which curves are evaluated.
const RATE: f64 = 50.0;
/// The part of a recording that is examined, in seconds from its start.
const LONGEST: f64 = 7_200.0;
/// Names that stand for several channels, whose mean is compared.
const PARTS: [(&str, &[&str]); 9] = [
    ("brows", &["brow_raise_right", "brow_raise_left"]),
    ("frown", &["brow_squeeze"]),
    ("lids", &["eye_close_right", "eye_close_left"]),
    ("eyes", &["eye_close_right", "eye_close_left"]),
    ("nose", &["nose_wrinkle"]),
    ("jaw", &["jaw_open"]),
    ("mouth", &["lips_part"]),
    ("corners", &["lip_corner_right", "lip_corner_left"]),
    ("cheeks", &["cheek_puff_right", "cheek_puff_left"]),
];
const HEAD: [&str; 3] = ["head_pitch", "head_yaw", "head_roll"];
const TRUNK: [&str; 3] = ["trunk_pitch", "trunk_yaw", "trunk_roll"];

/// Returns the plan for the tokens during which a curve meets the condition for the required time.
///
/// # Errors
/// Fails if no channel of a face has this name.
pub(super) fn plan(ask: &Ask<'_>, test: &Test, wanted: &CurveTest) -> Asked<Plan> {
    let Some(channels) = channels(&wanted.name) else {
        return Err(unknown(test, &wanted.name).into());
    };
    let fits = Fits::of(ask.connection)?;
    let mut found = Vec::new();
    for row in recordings::recordings(ask.connection)? {
        let tokens = signs::tokens_of_recording(ask.connection, row.id)?;
        if tokens.is_empty() {
            continue;
        }
        let frames = ((row.duration_us as f64 / 1e6).min(LONGEST) * RATE) as usize;
        let moments: Vec<Instant> = (0..frames)
            .map(|n| Instant::from_seconds(n as f64 / RATE))
            .collect();
        let Some(columns) = numbers_of(ask.connection, row.id, &moments, &channels, &fits)? else {
            continue;
        };
        let columns: Vec<Vec<f64>> = columns.into_iter().flatten().collect();
        if columns.is_empty() {
            continue;
        }
        let mean = |frame: usize| {
            columns.iter().map(|column| column[frame]).sum::<f64>() / columns.len() as f64
        };
        let passes: Vec<bool> = (0..frames)
            .map(|frame| wanted.test.accepts(mean(frame)))
            .collect();
        let runs = runs(&passes, wanted.lasting);
        let during = |start: i64, end: i64| runs.iter().any(|run| run.0 < end && start < run.1);
        let passing = tokens
            .iter()
            .filter(|token| match (token.start_us, token.end_us) {
                (Some(start), Some(end)) => during(start, end),
                _ => false,
            });
        found.extend(passing.map(|token| token.id));
    }
    Ok(Plan::Index(Probe::Rows(RowField::Token, found)))
}

/// Returns the times, in microseconds, of runs of passing frames that last at least `lasting` microseconds.
fn runs(passes: &[bool], lasting: i64) -> Vec<(i64, i64)> {
    let at = |frame: usize| Instant::from_seconds(frame as f64 / RATE).micros();
    let mut runs = Vec::new();
    let mut start = None;
    for (frame, passes) in passes.iter().copied().chain([false]).enumerate() {
        match (start, passes) {
            (None, true) => start = Some(frame),
            (Some(from), false) => {
                if at(frame) - at(from) >= lasting {
                    runs.push((at(from), at(frame)));
                }
                start = None;
            }
            _ => {}
        }
    }
    runs
}

/// Returns the indices of the channels that a name stands for; those of the head come first.
fn channels(name: &str) -> Option<Vec<usize>> {
    if let Some(at) = HEAD.iter().position(|own| *own == name) {
        return Some(vec![at]);
    }
    if let Some(at) = TRUNK.iter().position(|own| *own == name) {
        return Some(vec![at + HEAD.len() + Face::LEN]);
    }
    if let Some(at) = Face::position(name) {
        return Some(vec![at + HEAD.len()]);
    }
    let (_, numbers) = PARTS.iter().find(|(part, _)| *part == name)?;
    numbers
        .iter()
        .map(|number| Face::position(number).map(|at| at + HEAD.len()))
        .collect()
}

fn unknown(test: &Test, name: &str) -> QueryError {
    let parts = PARTS.iter().map(|(part, _)| *part);
    let known = || parts.clone().chain(HEAD).chain(TRUNK).chain(Face::NAMES);
    let all: Vec<&str> = known().collect();
    QueryError {
        at: test.subject_at.range(),
        message: format!("a face has no curve {name:?}"),
        remedy: format!("the curves are: {}", all.join(", ")).into(),
        suggestion: nearest(name, known()).map(|meant| format!("nonmanual.{meant}")),
    }
}

#[cfg(test)]
mod tests {
    use super::{channels, runs};

    #[test]
    fn a_condition_holds_only_in_runs_of_the_requested_length() {
        let passes: Vec<bool> = (0..50).map(|n| (10..15).contains(&n) || n >= 30).collect();
        assert_eq!(runs(&passes, 0), [(200_000, 300_000), (600_000, 1_000_000)]);
        assert_eq!(runs(&passes, 300_000), [(600_000, 1_000_000)]);
        assert_eq!(runs(&[], 0), []);
    }

    #[test]
    fn channel_names_map_to_channel_numbers() {
        assert_eq!(channels("head_yaw"), Some(vec![1]));
        assert_eq!(channels("brows"), Some(vec![3, 4]));
        assert_eq!(channels("jaw_open"), Some(vec![11]));
        assert_eq!(channels("trunk_yaw"), Some(vec![25]));
        assert_eq!(channels("ears"), None);
    }
}
