//! Conditions on curves of the face and head, evaluated on captured faces, skeletons and generated curves.

use chereme_motion::FacePosture;
use chereme_sign::query::{CurveTest, QueryError, QueryTest};
use chereme_sign::text::nearest_candidate;

use super::compile::{QueryContext, QueryResult};
use super::probe::{IndexProbe, RowField};
use super::search_plan::QueryPlan;
use crate::curves::face_course::ChannelCourse;
use crate::curves::face_fits::CorpusFits;
use crate::db::{signs, stored_recordings};

/// Names that stand for several channels, whose mean is compared.
const CURVE_PART_CHANNELS: [(&str, &[&str]); 9] = [
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
const HEAD_CURVE_NAMES: [&str; 3] = ["head_pitch", "head_yaw", "head_roll"];
const TRUNK_CURVE_NAMES: [&str; 3] = ["trunk_pitch", "trunk_yaw", "trunk_roll"];

/// Returns the plan for the tokens during which a curve meets the condition for the required time.
///
/// # Errors
/// Fails if no channel of a face has this name.
pub(super) fn plan_curve_test(ask: &QueryContext<'_>, test: &QueryTest, wanted: &CurveTest) -> QueryResult<QueryPlan> {
    let Some(channels) = curve_channel_indices(&wanted.name) else {
        return Err(unknown_curve_error(test, &wanted.name).into());
    };
    let fits = CorpusFits::load_corpus_fits(ask.connection)?;
    let mut hits = Vec::new();
    for row in stored_recordings::load_recording_rows(ask.connection)? {
        let tokens = signs::tokens_of_recording(ask.connection, row.id)?;
        // Reading curves is slow, and a recording without tokens cannot give an answer.
        if tokens.is_empty() {
            continue;
        }
        let Some(course) = ChannelCourse::load_channel_course(ask.connection, row.id, &channels, &fits)? else {
            continue;
        };
        let passes = |start: i64, end: i64| {
            course.passes_lasting_test(start, end, wanted.lasting, |value| {
                wanted.test.accepts_attribute_number(value)
            })
        };
        let passing = tokens.iter().filter(|token| match (token.start_us, token.end_us) {
            (Some(start), Some(end)) => passes(start, end),
            _ => false,
        });
        hits.extend(passing.map(|token| token.id));
    }
    Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Token, hits)))
}

/// Returns the indices of the channels that a name stands for; those of the head come first.
fn curve_channel_indices(name: &str) -> Option<Vec<usize>> {
    if let Some(at) = HEAD_CURVE_NAMES.iter().position(|own| *own == name) {
        return Some(vec![at]);
    }
    if let Some(at) = TRUNK_CURVE_NAMES.iter().position(|own| *own == name) {
        return Some(vec![at + HEAD_CURVE_NAMES.len() + FacePosture::FACE_NUMBER_COUNT]);
    }
    if let Some(at) = FacePosture::face_number_position(name) {
        return Some(vec![at + HEAD_CURVE_NAMES.len()]);
    }
    let (_, numbers) = CURVE_PART_CHANNELS.iter().find(|(part, _)| *part == name)?;
    numbers
        .iter()
        .map(|number| FacePosture::face_number_position(number).map(|at| at + HEAD_CURVE_NAMES.len()))
        .collect()
}

fn unknown_curve_error(test: &QueryTest, name: &str) -> QueryError {
    let parts = CURVE_PART_CHANNELS.iter().map(|(part, _)| *part);
    let curve_names = || {
        parts
            .clone()
            .chain(HEAD_CURVE_NAMES)
            .chain(TRUNK_CURVE_NAMES)
            .chain(FacePosture::FACE_NUMBER_NAMES)
    };
    let all: Vec<&str> = curve_names().collect();
    QueryError {
        at: test.subject_at.char_range(),
        message: format!("a face has no curve {name:?}"),
        remedy: format!("the curves are: {}", all.join(", ")).into(),
        suggestion: nearest_candidate(name, curve_names()).map(|meant| format!("nonmanual.{meant}")),
    }
}

#[cfg(test)]
mod tests {
    use super::curve_channel_indices;

    #[test]
    fn channel_names_map_to_channel_numbers() {
        assert_eq!(curve_channel_indices("head_yaw"), Some(vec![1]));
        assert_eq!(curve_channel_indices("brows"), Some(vec![3, 4]));
        assert_eq!(curve_channel_indices("jaw_open"), Some(vec![11]));
        assert_eq!(curve_channel_indices("trunk_yaw"), Some(vec![25]));
        assert_eq!(curve_channel_indices("ears"), None);
    }
}
