//! Conditions on curves of the face and head, evaluated on captured faces, skeletons and generated curves.

use chereme_motion::Face;
use chereme_sign::query::{CurveTest, QueryError, Test};
use chereme_sign::text::nearest;

use super::compile::{Ask, Asked};
use super::plan::Plan;
use super::probe::{Probe, RowField};
use crate::db::{recordings, signs};
use crate::face::{Course, Fits};

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
        let Some(course) = Course::of(ask.connection, row.id, &channels, &fits)? else {
            continue;
        };
        let passes = |start: i64, end: i64| {
            course.passes((start, end), wanted.lasting, |it| wanted.test.accepts(it))
        };
        let passing = tokens
            .iter()
            .filter(|token| match (token.start_us, token.end_us) {
                (Some(start), Some(end)) => passes(start, end),
                _ => false,
            });
        found.extend(passing.map(|token| token.id));
    }
    Ok(Plan::Index(Probe::Rows(RowField::Token, found)))
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
    use super::channels;

    #[test]
    fn channel_names_map_to_channel_numbers() {
        assert_eq!(channels("head_yaw"), Some(vec![1]));
        assert_eq!(channels("brows"), Some(vec![3, 4]));
        assert_eq!(channels("jaw_open"), Some(vec![11]));
        assert_eq!(channels("trunk_yaw"), Some(vec![25]));
        assert_eq!(channels("ears"), None);
    }
}
