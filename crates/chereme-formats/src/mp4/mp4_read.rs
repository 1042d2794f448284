//! Reads the first track of pictures in a film file: positions, times, size and colours of its frames.

use std::io::{Read, Seek};

use super::boxes::{self, InnerBox, box_kind_letters};
use super::mp4_table::{FrameListBuilder, TrackEdit};
use super::{MAX_FRAMES, Mp4Container, Mp4Error, PictureColours, PictureRotation, fragments, mp4_table};
use crate::finding::ImportFinding;

/// Kinds with which files of this family begin.
const FIRST_BOX_KINDS: [&[u8; 4]; 8] = [b"ftyp", b"moov", b"mdat", b"wide", b"free", b"skip", b"pnot", b"styp"];

/// Reads the index of a film: the positions and times of its frames, from the first track with pictures.
///
/// # Errors
/// [`Mp4Error`] if the file is no MP4, is not whole, or holds no pictures.
pub fn read_mp4_index(input: &mut (impl Read + Seek)) -> Result<(Mp4Container, Vec<ImportFinding>), Mp4Error> {
    let mut findings = Vec::new();
    let (places, broken) = boxes::top_level_boxes(input)?;
    let is_first_kind = |kind: [u8; 4]| FIRST_BOX_KINDS.iter().any(|first_kind| **first_kind == kind);
    if !places.first().is_some_and(|place| is_first_kind(place.kind)) {
        return Err(Mp4Error::NoMp4);
    }
    let end = places.last().map_or(0, |place| place.to);
    if broken {
        let message = "the file does not end where its last box does; it may be cut short";
        findings.push(ImportFinding::new_warning_finding(None, message));
    }
    let moov_place = places.iter().find(|place| place.kind == *b"moov");
    let place = moov_place.ok_or(Mp4Error::NoMovie)?;
    let bytes = boxes::read_box_content(input, place)?;
    let moov = InnerBox {
        kind: *b"moov",
        at: place.from,
        bytes: &bytes,
    };
    // In version 1 two times of 64 bits come before it.
    let movie_scale = match moov.find_child_box(b"mvhd") {
        Some(mvhd) => mvhd.box_u32_at(if mvhd.box_version()? == 1 { 20 } else { 12 })?,
        None => 0,
    };
    let mut others = Vec::new();
    let mut films = Vec::new();
    for trak in moov.child_boxes(0).filter(|child| child.kind == *b"trak") {
        match handler(trak) {
            Some(kind) if kind == *b"vide" => films.push(trak),
            Some(kind) => others.push(box_kind_letters(kind)),
            None => {}
        }
    }
    let Some(trak) = films.first() else {
        others.sort();
        others.dedup();
        let others = match others.join(", ") {
            none if none.is_empty() => "headers".to_owned(),
            others => others,
        };
        return Err(Mp4Error::NoPictures(others));
    };
    if films.len() > 1 {
        let message = format!("the file holds {} films; the first is shown", films.len());
        findings.push(ImportFinding::new_note_finding(None, message));
    }
    let mut film = read_picture_track(*trak)?;
    let edit = read_edit_list(*trak, film.timescale, movie_scale, &mut findings)?;
    let stbl = find_box_at_path(*trak, &[b"mdia", b"minf", b"stbl"]);
    let mut shape = FrameListBuilder {
        end,
        edit,
        frames: Vec::new(),
        beyond: 0,
    };
    if let Some(stbl) = stbl {
        mp4_table::add_sample_frames(stbl, &mut shape)?;
    }
    let pieces = places.iter().filter(|place| place.kind == *b"moof");
    let id = track_id(*trak)?;
    let defaults = fragments::read_sample_defaults(moov, id)?;
    let mut clock = fragments::FragmentClock::clock_after_frames(&shape.frames);
    for piece in pieces {
        let bytes = boxes::read_box_content(input, piece)?;
        let moof = InnerBox {
            kind: *b"moof",
            at: piece.from,
            bytes: &bytes,
        };
        fragments::add_fragment_frames(moof, piece.at, id, defaults, &mut clock, &mut shape)?;
        if shape.frames.len() > MAX_FRAMES {
            break;
        }
    }
    if shape.frames.len() > MAX_FRAMES {
        return Err(Mp4Error::Limit {
            what: "frames",
            found: shape.frames.len() as u64,
            most: MAX_FRAMES as u64,
        });
    }
    if shape.beyond > 0 {
        let message = format!(
            "the file is cut short; frames beyond its end, which are left out: {}",
            shape.beyond
        );
        findings.push(ImportFinding::new_warning_finding(None, message));
    }
    film.frames = mp4_table::frames_after_edit(shape);
    if film.frames.iter().all(|frame| frame.hidden) {
        return Err(Mp4Error::NoPictures("an empty track".to_owned()));
    }
    Ok((film, findings))
}

/// Returns the box at the end of a path of kinds.
fn find_box_at_path<'a>(from: InnerBox<'a>, path: &[&[u8; 4]]) -> Option<InnerBox<'a>> {
    path.iter().try_fold(from, |parent, kind| parent.find_child_box(kind))
}

fn handler(trak: InnerBox<'_>) -> Option<[u8; 4]> {
    let hdlr = find_box_at_path(trak, &[b"mdia", b"hdlr"])?;
    hdlr.bytes.get(8..12)?.try_into().ok()
}

fn track_id(trak: InnerBox<'_>) -> Result<u32, Mp4Error> {
    let header_box = trak.find_child_box(b"tkhd");
    let tkhd = header_box.ok_or_else(|| trak.inner_box_error("it has no header (tkhd)"))?;
    tkhd.box_u32_at(if tkhd.box_version()? == 1 { 20 } else { 12 })
}

/// Reads the description of a track of pictures.
fn read_picture_track(trak: InnerBox<'_>) -> Result<Mp4Container, Mp4Error> {
    let clock_box = find_box_at_path(trak, &[b"mdia", b"mdhd"]);
    let mdhd = clock_box.ok_or_else(|| trak.inner_box_error("it has no clock (mdhd)"))?;
    let timescale = mdhd.box_u32_at(if mdhd.box_version()? == 1 { 20 } else { 12 })?;
    if timescale == 0 {
        return Err(mdhd.inner_box_error("its clock does not run"));
    }
    let coding_box = find_box_at_path(trak, &[b"mdia", b"minf", b"stbl", b"stsd"]);
    let stsd = coding_box.ok_or_else(|| trak.inner_box_error("it does not say how it is coded (stsd)"))?;
    // Version, flags and the number of entries come before the first.
    let first_entry = stsd.child_boxes(8).next();
    let entry = first_entry.ok_or_else(|| stsd.inner_box_error("it is empty"))?;
    let mut coding = box_kind_letters(entry.kind);
    let mut configuration = Vec::new();
    let mut colours = None;
    // 78 bytes describe the picture before the boxes of the entry.
    for inner in entry.child_boxes(78) {
        match &inner.kind {
            b"avcC" => configuration = inner.bytes.to_vec(),
            b"colr" => colours = colours.or(said_colours(inner)),
            // Encrypted pictures cannot be decoded, whatever their coding.
            b"sinf" => "encv".clone_into(&mut coding),
            _ => {}
        }
    }
    Ok(Mp4Container {
        coding,
        configuration,
        width: u32::from(entry.box_u16_at(24)?),
        height: u32::from(entry.box_u16_at(26)?),
        turn: read_track_rotation(trak),
        colours,
        timescale,
        frames: Vec::new(),
    })
}

/// Reads a `colr` box; colour profiles are ignored.
fn said_colours(colr: InnerBox<'_>) -> Option<PictureColours> {
    let kind = colr.bytes.get(..4)?;
    let matrix = u8::try_from(colr.box_u16_at(8).ok()?).ok()?;
    let full_range = match kind {
        b"nclx" => colr.bytes.get(10)? & 0x80 != 0,
        b"nclc" => false,
        _ => return None,
    };
    Some(PictureColours { matrix, full_range })
}

/// Returns the rotation in a track's matrix; none if the matrix is not a rotation by right angles.
fn read_track_rotation(trak: InnerBox<'_>) -> PictureRotation {
    let matrix_terms = || {
        let tkhd = trak.find_child_box(b"tkhd")?;
        // Times before the matrix have 64 bits in version 1, and 32 otherwise.
        let matrix_start = if tkhd.box_version().ok()? == 1 { 52 } else { 40 };
        let term = |index: usize| Some((tkhd.box_u32_at(matrix_start + 4 * index).ok()?.cast_signed()).signum());
        Some([term(0)?, term(1)?, term(3)?, term(4)?])
    };
    match matrix_terms() {
        Some([0, 1, -1, 0]) => PictureRotation::Quarter,
        Some([-1, 0, 0, -1]) => PictureRotation::Half,
        Some([0, -1, 1, 0]) => PictureRotation::ThreeQuarters,
        _ => PictureRotation::None,
    }
}

/// Reads the edit list of a track: an optional empty start, and one piece of the film.
fn read_edit_list(
    trak: InnerBox<'_>,
    timescale: u32,
    movie_scale: u32,
    findings: &mut Vec<ImportFinding>,
) -> Result<TrackEdit, Mp4Error> {
    let Some(elst) = find_box_at_path(trak, &[b"edts", b"elst"]) else {
        return Ok(TrackEdit::default());
    };
    let wide = elst.box_version()? == 1;
    let mut edit = TrackEdit::default();
    let mut pieces = 0;
    for row in elst.box_table_rows(4, if wide { 20 } else { 12 })? {
        let (duration, from) = if wide {
            let from = boxes::bytes_u64_at(row, 8).unwrap_or_default();
            (boxes::bytes_u64_at(row, 0).unwrap_or_default(), from.cast_signed())
        } else {
            let from = boxes::bytes_u32_at(row, 4).unwrap_or_default();
            let duration = boxes::bytes_u32_at(row, 0).unwrap_or_default();
            (u64::from(duration), i64::from(from.cast_signed()))
        };
        let ticks = match movie_scale {
            0 => 0,
            scale => {
                let ticks = u128::from(duration) * u128::from(timescale) / u128::from(scale);
                i64::try_from(ticks).unwrap_or(i64::MAX)
            }
        };
        // An edit from before the track is empty: at the start it delays the film.
        if from < 0 {
            if pieces == 0 {
                edit.delay = edit.delay.saturating_add(ticks);
            }
            continue;
        }
        pieces += 1;
        if pieces == 1 {
            edit.from = from;
            edit.until = (ticks > 0).then(|| from.saturating_add(ticks));
        }
    }
    if pieces > 1 {
        edit.until = None;
        findings.push(
            ImportFinding::new_warning_finding(
                None,
                format!("the film was cut in {pieces} pieces by its edit list; it is shown uncut"),
            )
            .with_remedy("write it again as one piece, for example with ffmpeg"),
        );
    }
    Ok(edit)
}
