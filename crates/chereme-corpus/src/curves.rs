//! Scalar curves beside movement: a number a frame, such as how much the brows are raised.

use std::io::Write;
use std::ops::Range;

use chereme_compose::Curve;
use chereme_formats::bvh::raw::Column;
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, Address, Stretch};
use crate::codec;
use crate::db::{curves as rows, damaged, motion};
use crate::error::{Error, Result};
use crate::movement::{BLOCK_FRAMES, Track};

/// Decimals of stored numbers.
const DECIMALS: u8 = 6;
const SCALE: f64 = 1e6;

impl Corpus {
    /// Returns the scalar curves at an address, a number for each frame of its movement; none where it
    /// has none. Made signs have those of their non-manuals, from 0 to 1, by names such as `brows.RB`.
    ///
    /// # Errors
    /// Where nothing has that address, several things have it, or it has no movement.
    pub fn curves_of(&self, address: &Address) -> Result<Vec<Curve>> {
        let connection = self.store.read();
        let stretch = address::stretch(connection, address)?;
        let track = Track::of(connection, stretch.recording.id)?;
        of_track(connection, &track, track.frames_in(stretch.span))
    }
}

/// Stores the curves of a track with `frames` frames.
pub(crate) fn store(
    connection: &Connection,
    track: i64,
    curves: &[Curve],
    frames: usize,
) -> Result<()> {
    if curves.is_empty() {
        return Ok(());
    }
    if let Some(odd) = curves.iter().find(|curve| curve.values.len() != frames) {
        let (name, count) = (&odd.name, odd.values.len());
        return Err(Error::wrong(format!(
            "the curve {name:?} has {count} values for {frames} frames"
        )));
    }
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
    rows::insert_names(connection, track, &names)?;
    for first in (0..frames).step_by(BLOCK_FRAMES) {
        let own = first..frames.min(first + BLOCK_FRAMES);
        let columns: Vec<Column> = curves
            .iter()
            .map(|curve| Column {
                scale: DECIMALS,
                mantissas: curve.values[own.clone()]
                    .iter()
                    .map(|value| (value * SCALE).round() as i64)
                    .collect(),
                exceptions: Vec::new(),
            })
            .collect();
        let columns: Vec<&Column> = columns.iter().collect();
        let data = codec::encode(own.len(), &columns);
        rows::insert_block(connection, track, first, own.len(), &data)?;
    }
    Ok(())
}

/// Returns the curves of a track over `frames`.
pub(crate) fn of_track(
    connection: &Connection,
    track: &Track,
    frames: Range<usize>,
) -> Result<Vec<Curve>> {
    let names = rows::names(connection, track.row.id)?;
    let mut curves: Vec<Curve> = names
        .into_iter()
        .map(|name| Curve {
            name,
            values: Vec::with_capacity(frames.len()),
        })
        .collect();
    if curves.is_empty() {
        return Ok(curves);
    }
    let mut next = frames.start;
    for block in rows::blocks(connection, track.row.id, &frames)? {
        let place = || format!("block {}", motion::hex(&block.hash));
        if block.frames > BLOCK_FRAMES || block.first_frame > next {
            return Err(damaged(place(), "the curves have a gap"));
        }
        let columns = codec::decode(&block.data, block.frames, curves.len())
            .map_err(|reason| damaged(place(), reason))?;
        let end = frames.end.min(block.first_frame + block.frames);
        let own = next - block.first_frame..end.saturating_sub(block.first_frame);
        for (curve, column) in curves.iter_mut().zip(&columns) {
            let scale = 10f64.powi(i32::from(column.scale));
            let values = column.mantissas.get(own.clone()).unwrap_or_default();
            curve
                .values
                .extend(values.iter().map(|value| *value as f64 / scale));
        }
        next = end.max(next);
    }
    if next < frames.end {
        let place = format!("track {}", track.row.id);
        return Err(damaged(
            place,
            format!("frame {next} of its curves is missing"),
        ));
    }
    Ok(curves)
}

/// Writes the curves of a stretch as a table: a frame a row, its time in seconds from the first one, and
/// a column for each curve.
pub(crate) fn write_table(
    connection: &Connection,
    stretch: &Stretch,
    delimiter: u8,
    out: &mut dyn Write,
) -> Result<()> {
    let track = Track::of(connection, stretch.recording.id)?;
    let frames = match stretch.token {
        Some(_) => track.frames_in(stretch.span),
        None => 0..track.frames(),
    };
    let curves = of_track(connection, &track, frames.clone())?;
    if curves.is_empty() {
        let name = &stretch.recording.name;
        return Err(Error::wrong(format!("the recording {name:?} has no curves")).advise(
            "signs made from notation with non-manual tiers have some; `chereme list CORPUS recordings` counts them",
        ));
    }
    let fault = |error: csv::Error| Error::wrong(format!("the curves cannot be written: {error}"));
    let mut table = csv::WriterBuilder::new()
        .delimiter(delimiter)
        .from_writer(out);
    let titles = ["frame", "time_s"].into_iter();
    let titles = titles.chain(curves.iter().map(|curve| curve.name.as_str()));
    table.write_record(titles).map_err(fault)?;
    for n in 0..frames.len() {
        let time = track.rate.instant(n).seconds();
        let values = curves.iter().map(|curve| curve.values[n].to_string());
        let row = [n.to_string(), time.to_string()].into_iter().chain(values);
        table.write_record(row).map_err(fault)?;
    }
    table
        .flush()
        .map_err(|error| Error::wrong(format!("the curves cannot be written: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_come_back_as_they_were_made_and_go_and_return_with_their_sign() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("vraag.sigml");
        let text = "<sigml><hamgestural_sign gloss=\"VRAAG\"><sign_nonmanual><facialexpr_tier>\
                    <eye_brows movement=\"RB\"/></facialexpr_tier></sign_nonmanual><sign_manual>\
                    <handconfig handshape=\"flat\" extfidir=\"uo\" palmor=\"l\"/>\
                    <directedmotion direction=\"o\"/></sign_manual></hamgestural_sign></sigml>";
        std::fs::write(&file, text).expect("written");
        let path = folder.path().join("a.chereme");
        let mut corpus = Corpus::create(&path, "A").expect("made");
        let recipe = format!("sigml {:?} | repeat 8", file.display().to_string());
        let (_, made, _) = corpus.make(&recipe).expect("made");
        assert!(made.clip.frames() > BLOCK_FRAMES, "more than one block");
        let most = made.curves[0].values.iter().copied().fold(0.0, f64::max);
        assert!(most > 0.9, "the brows are raised: {most}");
        corpus.recombine(&recipe, "VRAAG").expect("stored");
        let sign = Address::Gloss("VRAAG".into());
        let stored = corpus.curves_of(&sign).expect("read");
        assert_eq!(stored.len(), made.curves.len());
        for (stored, made) in stored.iter().zip(&made.curves) {
            assert_eq!(stored.name, made.name);
            assert_eq!(stored.values.len(), made.values.len());
            let pairs = stored.values.iter().zip(&made.values);
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() <= 0.5 / SCALE));
        }
        let plain = "hamnosys \"hamflathand hamextfingeru hampalml hamchest\"";
        corpus.recombine_again(&sign, plain).expect("made anew");
        assert_eq!(corpus.curves_of(&sign).expect("read"), []);
        corpus.undo().expect("undone");
        assert_eq!(corpus.curves_of(&sign).expect("read"), stored);
    }
}
