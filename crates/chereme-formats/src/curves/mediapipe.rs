//! JSON of face trackers: MediaPipe's, one object a frame with named scores, and the text form of its list of scores;
//! objects of shapes by name; and names with a row of weights for each frame.

use chereme_motion::FrameRate;
use chereme_motion::column::FileNumber;
use serde_json::Value;

use super::{CurveChannels, CurveClock, CurveError};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::tracks::rate_of;

/// Frames per second if the file gives no times, as MediaPipe's results.
const DEFAULT_MEDIAPIPE_FPS: f64 = 30.0;

/// The most names of scores; faces have some 52.
const MOST_NAMES: usize = 1024;
/// The most scores, gaps counted too.
const MOST_SCORES: usize = 30_000_000;

/// Returns whether a line opens a score of the text form of `ClassificationList`.
pub(super) fn opens_score(line: &str) -> bool {
    line.strip_prefix("classification")
        .is_some_and(|rest| rest.trim_start().starts_with('{'))
}

/// Reads the text form of `ClassificationList`: one frame, a `label` and a `score` in each `classification`.
fn read_classification_text(text: &str, findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    let mut channels = CurveChannels::new(Vec::new());
    let (mut score, mut label) = (None, None);
    for (line, content) in (1u64..).zip(text.lines()) {
        let content = content.trim();
        match content.split_once(':').map(|(key, value)| (key.trim(), value.trim())) {
            _ if opens_score(content) => (score, label) = (None, None),
            Some(("score", value)) => {
                let number = FileNumber::parse_file_number(value.as_bytes());
                score = Some(number.map_err(|_| CurveError::curve_cell_error(line, value, "number"))?);
            }
            Some(("label", value)) => label = Some(value.trim_matches('"').to_owned()),
            _ => {}
        }
        if let (Some(number), Some(name)) = (&score, &label) {
            channels.names.push(name.clone());
            channels.units.push("");
            channels.columns.push(vec![Some(number.clone())]);
            (score, label) = (None, None);
        }
    }
    let usual = rate_of(DEFAULT_MEDIAPIPE_FPS).ok_or(CurveError::Empty)?;
    channels.clock = CurveClock::Rate(usual);
    findings.push_note_finding(None, "it holds the scores of one frame");
    match channels.names.is_empty() {
        true => Err(CurveError::Empty),
        false => Ok(channels),
    }
}

/// Keys under which a frame holds its shapes by name.
const SHAPE_KEYS: [&str; 4] = ["faceBlendshapes", "blendShapes", "blendshapes", "shapes"];

/// Returns whether JSON that begins so has shapes of a face as keys, or as a list of names.
pub(super) fn names_shapes(start: &str) -> bool {
    let lower = start.to_ascii_lowercase();
    ["\"jawopen\"", "\"browinnerup\""]
        .iter()
        .all(|name| lower.contains(name))
}

/// Returns the rate that a document states.
fn stated_rate(document: &Value) -> Option<FrameRate> {
    let keys = ["fps", "exportFps", "frameRate", "frame_rate"];
    let number = keys.iter().find_map(|key| document.get(key)?.as_f64());
    rate_of(number?)
}

/// Reads names of shapes and a row of weights for each frame; `None` if the document has another form.
fn read_weight_matrix(document: &Value) -> Option<Result<CurveChannels, CurveError>> {
    let list = |keys: &[&str]| keys.iter().find_map(|key| document.get(key)?.as_array());
    let names = list(&["facsNames", "names", "blendShapeNames", "blendshapeNames"])?;
    let rows = list(&["weightMat", "weights", "blendShapeWeights"])?;
    let names: Option<Vec<String>> = names.iter().map(|name| Some(name.as_str()?.to_owned())).collect();
    let mut channels = CurveChannels::new(names?);
    for (frame, row) in rows.iter().enumerate() {
        let row = row.as_array()?;
        if row.len() != channels.names.len() {
            let (found, names) = (row.len(), channels.names.len());
            return Some(Err(CurveError::Json(format!(
                "the frame {frame} has {found} weights for {names} names"
            ))));
        }
        for (column, weight) in channels.columns.iter_mut().zip(row) {
            let number = weight.as_number().map(ToString::to_string);
            column.push(number.and_then(|text| FileNumber::parse_file_number(text.as_bytes()).ok()));
        }
    }
    Some(Ok(channels))
}

/// Returns the clock of frames without times.
fn even_clock(document: &Value, findings: &mut FindingTally) -> Result<CurveClock, CurveError> {
    if let Some(rate) = stated_rate(document) {
        return Ok(CurveClock::Rate(rate));
    }
    findings.push_counted_finding(
        ImportFinding::new_warning_finding(
            None,
            format!("its frames have no times; {DEFAULT_MEDIAPIPE_FPS} a second are taken"),
        )
        .with_remedy("write \"timestampMs\" into each frame"),
    );
    Ok(CurveClock::Rate(
        rate_of(DEFAULT_MEDIAPIPE_FPS).ok_or(CurveError::Empty)?,
    ))
}

pub(super) fn read_mediapipe_channels(text: &str, findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    if !text.trim_start().starts_with(['{', '[']) {
        return read_classification_text(text, findings);
    }
    let document: Value =
        serde_json::from_str(text).map_err(|error| CurveError::Json(format!("line {}: {error}", error.line())))?;
    if let Some(read) = read_weight_matrix(&document) {
        let mut channels = read?;
        channels.clock = even_clock(&document, findings)?;
        return Ok(channels);
    }
    let frames = match &document {
        Value::Array(frames) => frames.iter().collect(),
        Value::Object(object) => match object.get("frames") {
            Some(Value::Array(frames)) => frames.iter().collect(),
            _ => vec![&document],
        },
        _ => Vec::new(),
    };
    let mut channels = CurveChannels::new(Vec::new());
    let mut times = Vec::new();
    let points = frames.iter().filter(|frame| has_landmarks(frame)).count();
    if points > 0 {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!("landmarks beside the scores are left out: {points} frames have them"),
            )
            .with_remedy("write the landmarks into a file of their own, without scores"),
        );
    }
    for (row, frame) in frames.iter().enumerate() {
        // A name that a frame lacks has a gap there.
        for column in &mut channels.columns {
            column.push(None);
        }
        for (name, score) in scores(frame) {
            let name_index = match channels.names.iter().position(|known| known == name) {
                Some(at) => at,
                None => {
                    let names = channels.names.len() + 1;
                    // Each new name makes a column of all frames, which hostile files could use to fill memory.
                    if names > MOST_NAMES || names.saturating_mul(frames.len()) > MOST_SCORES {
                        return Err(CurveError::Json(format!(
                            "it has more than {MOST_NAMES} names of scores, or {MOST_SCORES} scores"
                        )));
                    }
                    channels.names.push(name.to_owned());
                    channels.units.push("");
                    channels.columns.push(vec![None; row + 1]);
                    channels.names.len() - 1
                }
            };
            channels.columns[name_index][row] = FileNumber::parse_file_number(score.as_bytes()).ok();
        }
        times.push(frame_time_seconds(frame));
    }
    if channels.names.is_empty() {
        return Err(CurveError::Json(
            "no frame holds categories with a categoryName and a score".to_owned(),
        ));
    }
    let stated_times: Option<Vec<f64>> = times.into_iter().collect();
    // Times that stand still or go back are those of no film.
    channels.clock = match stated_times.filter(|times| times.windows(2).all(|pair| pair[1] > pair[0])) {
        Some(times) => CurveClock::Seconds(times),
        None => even_clock(&document, findings)?,
    };
    Ok(channels)
}

/// Returns whether a frame lists landmarks.
fn has_landmarks(frame: &Value) -> bool {
    frame.as_object().is_some_and(|frame| {
        frame.iter().any(|(key, value)| {
            key.to_ascii_lowercase().ends_with("landmarks") && value.as_array().is_some_and(|list| !list.is_empty())
        })
    })
}

/// Returns the named scores of a frame, as the file writes the numbers.
fn scores(frame: &Value) -> Vec<(&str, String)> {
    let listed_shapes = SHAPE_KEYS.iter().find_map(|key| frame.get(key));
    let shapes = listed_shapes.unwrap_or(frame);
    let first = match shapes {
        Value::Array(faces) if faces.first().is_some_and(|face| face.get("categories").is_some()) => &faces[0],
        other => other,
    };
    let categories = first.get("categories").unwrap_or(first);
    if let Value::Object(shapes) = categories {
        let named = shapes
            .iter()
            .filter(|(name, _)| !FRAME_TIME_KEYS.contains(&name.as_str()));
        let pairs = named.filter_map(|(name, score)| Some((&**name, score.as_number()?.to_string())));
        return pairs.collect();
    }
    let Value::Array(categories) = categories else {
        return Vec::new();
    };
    let pairs = categories.iter().filter_map(|category| {
        let name = category.get("categoryName").or(category.get("label"))?.as_str()?;
        Some((name, category.get("score")?.as_number()?.to_string()))
    });
    pairs.collect()
}

/// Returns the seconds that a frame names.
fn frame_time_seconds(frame: &Value) -> Option<f64> {
    let named = |key: &str| frame.get(key).and_then(Value::as_f64);
    let millis = named("timestampMs").or(named("timestamp_ms"));
    let seconds = named("time").or(named("timeCode"));
    millis.map(|millis| millis / 1000.0).or(seconds)
}

/// Keys of a frame that are no shapes.
const FRAME_TIME_KEYS: [&str; 7] = [
    "timestampMs",
    "timestamp_ms",
    "timestamp",
    "time",
    "timeCode",
    "frame",
    "index",
];
