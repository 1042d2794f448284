//! Reads the first track of pictures in a film file: positions, times, size and colours of its frames.

use std::io::{Read, Seek};

use super::boxes::{self, Inner, letters};
use super::table::{Edit, Shape};
use super::{Colours, Container, Error, MAX_FRAMES, Turn, fragments, table};
use crate::finding::Finding;

/// Kinds with which files of this family begin.
const FIRST: [&[u8; 4]; 8] = [
    b"ftyp", b"moov", b"mdat", b"wide", b"free", b"skip", b"pnot", b"styp",
];

/// Reads the index of a film: the positions and times of its frames, from the first track with pictures.
///
/// # Errors
/// [`Error`] if the file is no MP4, is not whole, or holds no pictures.
pub fn read(input: &mut (impl Read + Seek)) -> Result<(Container, Vec<Finding>), Error> {
    let mut findings = Vec::new();
    let (places, broken) = boxes::top_level_boxes(input)?;
    let known = |kind: [u8; 4]| FIRST.iter().any(|it| **it == kind);
    if !places.first().is_some_and(|place| known(place.kind)) {
        return Err(Error::NoMp4);
    }
    let end = places.last().map_or(0, |place| place.to);
    if broken {
        let message = "the file does not end where its last box does; it may be cut short";
        findings.push(Finding::warning(None, message));
    }
    let place = places.iter().find(|place| place.kind == *b"moov");
    let place = place.ok_or(Error::NoMovie)?;
    let bytes = boxes::content(input, place)?;
    let moov = Inner {
        kind: *b"moov",
        at: place.from,
        bytes: &bytes,
    };
    let movie_scale = match moov.child(b"mvhd") {
        Some(mvhd) => mvhd.number(if mvhd.version()? == 1 { 20 } else { 12 })?,
        None => 0,
    };
    let mut others = Vec::new();
    let mut films = Vec::new();
    for trak in moov.children(0).filter(|it| it.kind == *b"trak") {
        match handler(trak) {
            Some(kind) if kind == *b"vide" => films.push(trak),
            Some(kind) => others.push(letters(kind)),
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
        return Err(Error::NoPictures(others));
    };
    if films.len() > 1 {
        let message = format!("the file holds {} films; the first is shown", films.len());
        findings.push(Finding::note(None, message));
    }
    let mut film = track(*trak)?;
    let edit = edit(*trak, film.timescale, movie_scale, &mut findings)?;
    let stbl = descend(*trak, &[b"mdia", b"minf", b"stbl"]);
    let mut shape = Shape {
        end,
        edit,
        frames: Vec::new(),
        beyond: 0,
    };
    if let Some(stbl) = stbl {
        table::frames(stbl, &mut shape)?;
    }
    let pieces = places.iter().filter(|place| place.kind == *b"moof");
    let id = track_id(*trak)?;
    let defaults = fragments::defaults(moov, id)?;
    let mut clock = fragments::Clock::after(&shape.frames);
    for piece in pieces {
        let bytes = boxes::content(input, piece)?;
        let moof = Inner {
            kind: *b"moof",
            at: piece.from,
            bytes: &bytes,
        };
        fragments::frames(moof, piece.at, (id, defaults), &mut clock, &mut shape)?;
        if shape.frames.len() > MAX_FRAMES {
            break;
        }
    }
    if shape.frames.len() > MAX_FRAMES {
        return Err(Error::Limit {
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
        findings.push(Finding::warning(None, message));
    }
    film.frames = table::settled(shape);
    if film.frames.iter().all(|frame| frame.hidden) {
        return Err(Error::NoPictures("an empty track".to_owned()));
    }
    Ok((film, findings))
}

/// Returns the box at the end of a path of kinds.
fn descend<'a>(from: Inner<'a>, path: &[&[u8; 4]]) -> Option<Inner<'a>> {
    path.iter().try_fold(from, |it, kind| it.child(kind))
}

fn handler(trak: Inner<'_>) -> Option<[u8; 4]> {
    let hdlr = descend(trak, &[b"mdia", b"hdlr"])?;
    hdlr.bytes.get(8..12)?.try_into().ok()
}

fn track_id(trak: Inner<'_>) -> Result<u32, Error> {
    let tkhd = trak.child(b"tkhd");
    let tkhd = tkhd.ok_or_else(|| trak.fault("it has no header (tkhd)"))?;
    tkhd.number(if tkhd.version()? == 1 { 20 } else { 12 })
}

/// Reads the description of a track of pictures.
fn track(trak: Inner<'_>) -> Result<Container, Error> {
    let mdhd = descend(trak, &[b"mdia", b"mdhd"]);
    let mdhd = mdhd.ok_or_else(|| trak.fault("it has no clock (mdhd)"))?;
    let timescale = mdhd.number(if mdhd.version()? == 1 { 20 } else { 12 })?;
    if timescale == 0 {
        return Err(mdhd.fault("its clock does not run"));
    }
    let stsd = descend(trak, &[b"mdia", b"minf", b"stbl", b"stsd"]);
    let stsd = stsd.ok_or_else(|| trak.fault("it does not say how it is coded (stsd)"))?;
    let entry = stsd.children(8).next();
    let entry = entry.ok_or_else(|| stsd.fault("it is empty"))?;
    let mut coding = letters(entry.kind);
    let mut configuration = Vec::new();
    let mut colours = None;
    // 78 bytes describe the picture before the boxes of the entry.
    for inner in entry.children(78) {
        match &inner.kind {
            b"avcC" => configuration = inner.bytes.to_vec(),
            b"colr" => colours = colours.or(said_colours(inner)),
            b"sinf" => "encv".clone_into(&mut coding),
            _ => {}
        }
    }
    Ok(Container {
        coding,
        configuration,
        width: u32::from(entry.short(24)?),
        height: u32::from(entry.short(26)?),
        turn: turn(trak),
        colours,
        timescale,
        frames: Vec::new(),
    })
}

/// Reads a `colr` box; colour profiles are ignored.
fn said_colours(colr: Inner<'_>) -> Option<Colours> {
    let kind = colr.bytes.get(..4)?;
    let matrix = u8::try_from(colr.short(8).ok()?).ok()?;
    let full_range = match kind {
        b"nclx" => colr.bytes.get(10)? & 0x80 != 0,
        b"nclc" => false,
        _ => return None,
    };
    Some(Colours { matrix, full_range })
}

/// Returns the rotation in a track's matrix; none if the matrix is not a rotation by right angles.
fn turn(trak: Inner<'_>) -> Turn {
    let found = || {
        let tkhd = trak.child(b"tkhd")?;
        let at = if tkhd.version().ok()? == 1 { 52 } else { 40 };
        let term = |index: usize| Some((tkhd.number(at + 4 * index).ok()?.cast_signed()).signum());
        Some([term(0)?, term(1)?, term(3)?, term(4)?])
    };
    match found() {
        Some([0, 1, -1, 0]) => Turn::Quarter,
        Some([-1, 0, 0, -1]) => Turn::Half,
        Some([0, -1, 1, 0]) => Turn::ThreeQuarters,
        _ => Turn::None,
    }
}

/// Reads the edit list of a track: an optional empty start, and one piece of the film.
fn edit(
    trak: Inner<'_>,
    timescale: u32,
    movie_scale: u32,
    findings: &mut Vec<Finding>,
) -> Result<Edit, Error> {
    let Some(elst) = descend(trak, &[b"edts", b"elst"]) else {
        return Ok(Edit::default());
    };
    let wide = elst.version()? == 1;
    let mut edit = Edit::default();
    let mut pieces = 0;
    for row in elst.rows(4, if wide { 20 } else { 12 })? {
        let (duration, from) = if wide {
            let from = boxes::long(row, 8).unwrap_or_default();
            (boxes::long(row, 0).unwrap_or_default(), from.cast_signed())
        } else {
            let from = boxes::number(row, 4).unwrap_or_default();
            let duration = boxes::number(row, 0).unwrap_or_default();
            (u64::from(duration), i64::from(from.cast_signed()))
        };
        let ticks = match movie_scale {
            0 => 0,
            scale => {
                let ticks = u128::from(duration) * u128::from(timescale) / u128::from(scale);
                i64::try_from(ticks).unwrap_or(i64::MAX)
            }
        };
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
            Finding::warning(
                None,
                format!("the film was cut in {pieces} pieces by its edit list; it is shown uncut"),
            )
            .with_remedy("write it again as one piece, for example with ffmpeg"),
        );
    }
    Ok(edit)
}
