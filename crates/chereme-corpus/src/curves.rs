//! Scalar curves beside movement: a number for each frame, such as how much the brows are raised. Recipes generate some,
//! others are derived from captured faces; a face alone is staged as movement of the program's own body.

pub(crate) mod face_captured;
pub(crate) mod face_course;
pub(crate) mod face_fits;
pub(crate) mod face_head;
pub(crate) mod face_stage;

use std::io::Write;
use std::ops::Range;

use chereme_compose::GeneratedCurve;
use chereme_motion::column::{DecimalColumn, FrameNumberColumn};
use chereme_motion::{FrameRate, FrameTimes, TimeSpan};
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RecordingStretch};
use crate::db::upgrade::NONMANUALS_TRACK_NAME;
use crate::db::{stored_motion, stored_tracks};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::MotionTrack;
use crate::track::{self, NewTrack};

/// The number of decimals of stored numbers.
const STORED_CURVE_DECIMALS: u8 = 6;

impl Corpus {
    /// Returns the scalar curves at an address, a number for each frame of its movement; an empty list if it has no
    /// curves. Generated signs have those of their non-manuals, from 0 to 1, by names such as `brows.RB`.
    ///
    /// # Errors
    /// Fails if nothing has that address, if several things have it, or if it has no movement.
    pub fn curves_of(&self, address: &CorpusAddress) -> CorpusResult<Vec<GeneratedCurve>> {
        let connection = self.store.read_connection();
        let stretch = address::find_addressed_stretch(connection, address)?;
        let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
        of_track(connection, &track, track.frames_in(stretch.span))
    }
}

/// Stores the curves of a generated movement, with a number for each frame, as a track of their own.
pub(crate) fn store_generated_curves(
    connection: &Connection,
    recording: i64,
    curves: &[GeneratedCurve],
    rate: FrameRate,
    frames: usize,
) -> CorpusResult<()> {
    if curves.is_empty() {
        return Ok(());
    }
    if let Some(odd) = curves.iter().find(|curve| curve.values.len() != frames) {
        let (name, count) = (&odd.name, odd.values.len());
        return Err(CorpusError::from_wrong_message(format!(
            "the curve {name:?} has {count} values for {frames} frames"
        )));
    }
    let fault = |name: &str| CorpusError::from_wrong_message(format!("the curve {name:?} has a number out of range"));
    let column = |curve: &GeneratedCurve| {
        let values = curve.values.iter().copied();
        let decimals =
            DecimalColumn::from_rounded_values(values, STORED_CURVE_DECIMALS).ok_or_else(|| fault(&curve.name))?;
        Ok(chereme_motion::ScalarCurve::new(
            curve.name.clone(),
            FrameNumberColumn::from(decimals),
        ))
    };
    let all = curves.iter().map(column).collect::<CorpusResult<_>>()?;
    let track = chereme_motion::CurveTrack::new(FrameTimes::Even(rate), all)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let new = NewTrack::new(NONMANUALS_TRACK_NAME, track::TrackContent::Curves(track));
    track::track_store::store_new_track(connection, recording, &new)?;
    Ok(())
}

/// Returns the curves of non-manuals that accompany a movement, over `frames` of it: a number for each frame. A
/// captured face gives the numbers of this program's own face, such as `face.jaw_open`.
pub(crate) fn of_track(
    connection: &Connection,
    track: &MotionTrack,
    frames: Range<usize>,
) -> CorpusResult<Vec<GeneratedCurve>> {
    let mut all = load_recipe_curves(connection, track, frames.clone())?;
    let instants = frames.map(|frame| {
        track
            .rate
            .frame_start_instant(frame)
            .shifted_instant(track.row.offset_us)
    });
    let captured = face_captured::curves_at(connection, track.row.recording_id, instants)?;
    all.extend(captured.into_iter().filter(|curve| !curve.values.is_empty()));
    Ok(all)
}

/// Returns the curves that a recipe generated, over `frames` of its movement.
fn load_recipe_curves(
    connection: &Connection,
    track: &MotionTrack,
    frames: Range<usize>,
) -> CorpusResult<Vec<GeneratedCurve>> {
    let Some(row) = stored_motion::find_nonmanual_track(connection, track.row.id)? else {
        return Ok(Vec::new());
    };
    let row = stored_tracks::load_track_row(connection, row)?;
    let same = (row.rate, row.offset_us) == (Some(track.rate), track.row.offset_us);
    let frame = |frame: usize| {
        track
            .rate
            .frame_start_instant(frame)
            .shifted_instant(track.row.offset_us)
    };
    let span = TimeSpan::span_between(frame(frames.start), frame(frames.end));
    // Tracks that share their frames need no blending, and only the span is read.
    if same && row.frames == Some(track.motion_frame_count() as u64) {
        let stored = track::track_read::read_track_curves(connection, &row, Some(span))?;
        let all = stored.track_curves().iter().map(|curve| GeneratedCurve {
            name: curve.name.clone(),
            values: curve.values.column_values().map(Option::unwrap_or_default).collect(),
        });
        return Ok(all.collect());
    }
    let stored = track::track_read::read_track_curves(connection, &row, None)?;
    let mut all: Vec<GeneratedCurve> = stored
        .track_curves()
        .iter()
        .map(|curve| GeneratedCurve {
            name: curve.name.clone(),
            values: Vec::with_capacity(frames.len()),
        })
        .collect();
    for at in frames.map(frame) {
        let values = stored.sample_curves(at.shifted_instant(-row.offset_us));
        for (curve, value) in all.iter_mut().zip(values) {
            curve.values.push(value.unwrap_or_default());
        }
    }
    Ok(all)
}

/// Reports whether non-manuals or a captured face accompany the movement of a stretch.
pub(crate) fn has_some(connection: &Connection, stretch: &RecordingStretch) -> CorpusResult<bool> {
    let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
    // One frame shows which curves there are.
    let first = 0..track.motion_frame_count().min(1);
    Ok(!of_track(connection, &track, first)?.is_empty())
}

/// Writes the curves of a stretch as a table: one row for each frame, with its time in seconds from the first one and a
/// column for each curve.
pub(crate) fn write_table(
    connection: &Connection,
    stretch: &RecordingStretch,
    delimiter: u8,
    out: &mut dyn Write,
) -> CorpusResult<()> {
    let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
    let frames = track.stretch_frames(stretch);
    let curves = of_track(connection, &track, frames.clone())?;
    if curves.is_empty() {
        let name = &stretch.recording.name;
        return Err(CorpusError::from_wrong_message(format!("the recording {name:?} has no curves")).with_command_advice("signs made from notation with non-manual tiers have some; `chereme list CORPUS recordings` counts them")
        .into_lacking_content());
    }
    let fault = |error: csv::Error| CorpusError::from_wrong_message(format!("the curves cannot be written: {error}"));
    let mut table = csv::WriterBuilder::new().delimiter(delimiter).from_writer(out);
    let first_titles = ["frame", "time_s"].into_iter();
    let titles = first_titles.chain(curves.iter().map(|curve| curve.name.as_str()));
    table.write_record(titles).map_err(fault)?;
    for n in 0..frames.len() {
        let time = track::track_table::frame_seconds(track.rate, n);
        let values = curves.iter().map(|curve| curve.values[n].to_string());
        let row = [n.to_string(), time.to_string()].into_iter().chain(values);
        table.write_record(row).map_err(fault)?;
    }
    table
        .flush()
        .map_err(|error| CorpusError::from_wrong_message(format!("the curves cannot be written: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_read_back_unchanged_and_are_undone_and_redone_with_their_sign() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("vraag.sigml");
        let text = "<sigml><hamgestural_sign gloss=\"VRAAG\"><sign_nonmanual><facialexpr_tier>\
                    <eye_brows movement=\"RB\"/></facialexpr_tier></sign_nonmanual><sign_manual>\
                    <handconfig handshape=\"flat\" extfidir=\"uo\" palmor=\"l\"/>\
                    <directedmotion direction=\"o\"/></sign_manual></hamgestural_sign></sigml>";
        std::fs::write(&file, text).expect("written");
        let path = folder.path().join("a.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let recipe = format!("sigml {:?} | repeat 30", file.display().to_string());
        let (_, made, _) = corpus.evaluate_recipe_text(&recipe).expect("made");
        assert!(
            made.clip.clip_frame_count() > crate::movement::BLOCK_FRAMES,
            "more than one block"
        );
        let most = made.curves[0].values.iter().copied().fold(0.0, f64::max);
        assert!(most > 0.9, "the brows are raised: {most}");
        corpus.recombine_recipe(&recipe, "VRAAG").expect("stored");
        let sign = CorpusAddress::Gloss("VRAAG".into());
        let stored = corpus.curves_of(&sign).expect("read");
        assert_eq!(stored.len(), made.curves.len());
        for (stored, made) in stored.iter().zip(&made.curves) {
            assert_eq!(stored.name, made.name);
            assert_eq!(stored.values.len(), made.values.len());
            let pairs = stored.values.iter().zip(&made.values);
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() <= 0.5e-6));
        }
        let plain = "hamnosys \"hamflathand hamextfingeru hampalml hamchest\"";
        corpus.recombine_again(&sign, plain).expect("generated again");
        let curves = corpus.curves_of(&sign).expect("read");
        let brows = |it: &GeneratedCurve| it.name.starts_with("brows");
        assert!(stored.iter().any(brows) && !curves.iter().any(brows));
        corpus.undo_operation().expect("undone");
        assert_eq!(corpus.curves_of(&sign).expect("read"), stored);
    }
}
