//! Markers and keys of a recording in the form for the models of cued speech.

use std::collections::BTreeSet;
use std::path::Path;

use chereme_analysis::cue::face;
use chereme_analysis::cue::hand;
use chereme_analysis::cue::labels;
use chereme_analysis::cue::session::{Followed, Key, KeySounds, rigid_set};
use chereme_compose::CueTier;
use chereme_motion::{Instant, Markers, Space, Span};
use chereme_sign::Remedy;
use chereme_sign::cue::{self, Alphabet, CueCode, Phone, Utterance};
use rusqlite::Connection;
use serde::Serialize;

use super::CuedOptions;
use crate::Corpus;
use crate::address::{self, Name};
use crate::cue::{guessed_alphabet, is_phone_tier};
use crate::db::columns::Origin;
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers::{self, AnnotationRow};
use crate::db::tracks::{self, TrackKind, TrackRow};
use crate::error::{Error, Result};
use crate::track::read;

/// The name of the tracks of restored markers.
pub(super) const RESTORED: &str = "restored";
/// The fewest labels of a set that make a recording count as showing it.
const FEWEST: usize = 12;
/// The longest take that is processed, in frames.
const MOST_FRAMES: usize = 400_000;

/// The markers of a recording that models of cued speech know.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CuedMarkers {
    /// The name of the recording.
    pub recording: String,
    /// The track of markers.
    pub track: String,
    /// Frames a second.
    pub rate: f64,
    /// How many frames there are.
    pub frames: u64,
    /// Those of the forearm and hand.
    pub hand: MarkerSet,
    /// Those of the face.
    pub face: MarkerSet,
    /// Labels of the file that belong to no marker of the models.
    pub unused: Vec<String>,
    /// The number of hidden positions that are restored in a track of their own.
    pub restored: u64,
}

/// A set of markers of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkerSet {
    /// How many markers of the set the recording has.
    pub found: u64,
    /// The names of the missing markers.
    pub missing: Vec<String>,
    /// The share of visible positions among those of the found markers.
    pub seen: f64,
}

/// Reads labels of markers from a table of two columns: the program's name, such as `HB1`, and the file's label.
///
/// # Errors
/// Fails if the file cannot be read, or a line has another number of cells or a name that the models do not have.
pub fn read_marker_labels(path: &Path) -> Result<Vec<(String, String)>> {
    const MOST_BYTES: u64 = 1 << 20;
    let size = std::fs::metadata(path)
        .map_err(|error| Error::file(path, error))?
        .len();
    if size > MOST_BYTES {
        return Err(Error::wrong(format!("the file has {size} bytes"))
            .at(path.display().to_string())
            .advise("give a table of two columns and at most 1 MiB"));
    }
    let text = std::fs::read_to_string(path).map_err(|error| Error::file(path, error))?;
    let known: BTreeSet<String> = labels::hand().into_iter().chain(labels::face()).collect();
    let mut all = Vec::new();
    for (line, row) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        let row = row.trim();
        if row.is_empty() || row.starts_with('#') {
            continue;
        }
        let wrong = |message: String| {
            Error::wrong(message)
                .at(format!("{}, line {line}", path.display()))
                .advise("write a name such as HB1, a comma, and the label of the file; names are FA1-FA5, HB1-HB7, I1-I8, M1-M8, R1-R8, L1-L8, T1-T6, RF1-RF5, RN1-RN2, RE1-RE2, LP1-LP16, CK1-CK12, JW1-JW8, TH1-TH18")
        };
        let cut = row.split_once([',', '\t', ';']);
        let Some((own, label)) = cut.map(|(own, label)| (own.trim(), label.trim())) else {
            return Err(wrong(format!("{row:?} has no second column")));
        };
        if !known.contains(own) {
            return Err(wrong(format!("{own:?} is no marker of the models")));
        }
        all.push((own.to_owned(), label.to_owned()));
    }
    Ok(all)
}

/// A take of a cuer: its markers in millimetres of model space; hidden markers have the positions that were restored
/// earlier.
pub(super) struct Take {
    pub(super) row: RecordingRow,
    pub(super) track: TrackRow,
    pub(super) markers: Markers,
    /// The index of each hand marker among the track's points.
    pub(super) hand_points: Vec<Option<usize>>,
    pub(super) face_points: Vec<Option<usize>>,
    pub(super) rate: f64,
    /// The time of frame 0 on the recording's clock, in seconds.
    pub(super) offset: f64,
    pub(super) hand: Vec<hand::Frame>,
    pub(super) face: Vec<face::Frame>,
}

impl Take {
    pub(super) fn has_hand(&self) -> bool {
        found(&self.hand_points) >= FEWEST && shown(&self.hand) > 0.0
    }

    pub(super) fn has_face(&self) -> bool {
        found(&self.face_points) >= FEWEST && shown(&self.face) > 0.0
    }

    pub(super) fn frames(&self) -> usize {
        self.markers.frames()
    }

    /// Returns the time of a frame on the recording's clock, in microseconds.
    pub(super) fn micros(&self, seconds: f64) -> i64 {
        ((seconds + self.offset) * 1e6).round() as i64
    }
}

fn found(points: &[Option<usize>]) -> usize {
    points.iter().flatten().count()
}

/// Returns the share of positions that are visible.
fn shown(frames: &[Vec<Option<chereme_motion::glam::DVec3>>]) -> f64 {
    let all: usize = frames.iter().map(Vec::len).sum();
    let seen: usize = frames
        .iter()
        .map(|frame| frame.iter().flatten().count())
        .sum();
    seen as f64 / all.max(1) as f64
}

impl Corpus {
    /// Returns the markers of a recording that the models of cued speech know, and their visibility.
    ///
    /// # Errors
    /// Fails if there is no such recording, or it has no markers in a room.
    pub fn cued_markers(&self, recording: &Name, options: &CuedOptions) -> Result<CuedMarkers> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        let take = take(connection, row, options)?;
        let set = |points: &[Option<usize>], names: Vec<String>| {
            let own = points.iter().flatten();
            let (mut all, mut seen) = (0u64, 0u64);
            for point in own {
                let marker = &take.markers.points()[*point];
                all += take.frames() as u64;
                seen += (0..take.frames())
                    .filter(|frame| marker.at(*frame).is_some())
                    .count() as u64;
            }
            MarkerSet {
                found: found(points) as u64,
                missing: names
                    .into_iter()
                    .zip(points)
                    .filter(|(_, at)| at.is_none())
                    .map(|(name, _)| name)
                    .collect(),
                seen: super::rounded(seen as f64 / all.max(1) as f64, 4),
            }
        };
        let used: BTreeSet<usize> = take
            .hand_points
            .iter()
            .chain(&take.face_points)
            .flatten()
            .copied()
            .collect();
        let unused = take.markers.points().iter().enumerate();
        let unused = unused
            .filter(|(n, _)| !used.contains(n))
            .map(|(_, point)| point.name.clone());
        Ok(CuedMarkers {
            track: take.track.name.clone(),
            rate: take.rate,
            frames: take.frames() as u64,
            hand: set(&take.hand_points, labels::hand()),
            face: set(&take.face_points, labels::face()),
            unused: unused.collect(),
            restored: restored_places(connection, take.row.id)?,
            recording: take.row.name,
        })
    }
}

fn restored_places(connection: &Connection, recording: i64) -> Result<u64> {
    let mut count = 0;
    for row in tracks::tracks(connection, recording)? {
        if row.kind == TrackKind::Markers && row.name == RESTORED {
            let markers = read::markers(connection, &row, None)?;
            for point in markers.points() {
                count += (0..markers.frames())
                    .filter(|frame| point.at(*frame).is_some())
                    .count() as u64;
            }
        }
    }
    Ok(count)
}

/// Returns the take of a recording.
pub(super) fn take(
    connection: &Connection,
    row: RecordingRow,
    options: &CuedOptions,
) -> Result<Take> {
    let no_markers = |message: String| {
        Error::wrong(message)
            .at(row.name.clone())
            .advise(Remedy::command(
                "import a .c3d or .trc file of a cuer; other labels are mapped with --labels FILE",
            ))
    };
    let mut best: Option<(TrackRow, usize)> = None;
    let all = tracks::tracks(connection, row.id)?;
    for track in all
        .iter()
        .filter(|it| it.kind == TrackKind::Markers && it.name != RESTORED)
    {
        let names: Vec<String> = tracks::channels(connection, track.id)?
            .into_iter()
            .map(|it| it.name)
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let count = found(&mapped(&labels::hand(), &names, options))
            + found(&mapped(&labels::face(), &names, options));
        if best.as_ref().is_none_or(|(_, most)| count > *most) {
            best = Some((track.clone(), count));
        }
    }
    let Some((track, count)) = best else {
        return Err(no_markers(format!(
            "{:?} has no track of markers",
            row.name
        )));
    };
    if count < FEWEST {
        return Err(no_markers(format!(
            "{count} labels of {:?} are known as markers of a cuer's hand or face",
            row.name
        )));
    }
    if track
        .frames
        .is_some_and(|frames| frames > MOST_FRAMES as u64)
    {
        return Err(Error::wrong(format!(
            "{:?} has {} frames; at most {MOST_FRAMES} are followed at once",
            row.name,
            track.frames.unwrap_or_default()
        ))
        .at(row.name.clone())
        .advise("cut the recording into shorter takes"));
    }
    let markers = read::markers(connection, &track, None)?;
    let rate = markers.times().rate().ok_or_else(|| {
        Error::wrong(format!("the frames of {:?} are not even in time", row.name))
            .at(row.name.clone())
            .advise("export it from the camera system with a constant frame rate")
    })?;
    if !matches!(markers.space(), Space::World(_)) {
        return Err(no_markers(format!(
            "the points of {:?} lie on a picture, and not in a room",
            row.name
        )));
    }
    let names: Vec<&str> = markers
        .points()
        .iter()
        .map(|point| point.name.as_str())
        .collect();
    let hand_points = mapped(&labels::hand(), &names, options);
    let face_points = mapped(&labels::face(), &names, options);
    let mut hand = frames(&markers, &hand_points);
    let mut face = frames(&markers, &face_points);
    fill(connection, row.id, &mut hand, &mut face)?;
    Ok(Take {
        rate: rate.per_second(),
        offset: track.offset_us as f64 / 1e6,
        row,
        track,
        markers,
        hand_points,
        face_points,
        hand,
        face,
    })
}

/// Fills hidden markers with positions that were restored earlier.
fn fill(
    connection: &Connection,
    recording: i64,
    hand: &mut [hand::Frame],
    face: &mut [face::Frame],
) -> Result<()> {
    for row in tracks::tracks(connection, recording)? {
        if row.kind != TrackKind::Markers || row.name != RESTORED {
            continue;
        }
        let markers = read::markers(connection, &row, None)?;
        let names: Vec<&str> = markers
            .points()
            .iter()
            .map(|point| point.name.as_str())
            .collect();
        for (own, frames_of) in [(labels::hand(), &mut *hand), (labels::face(), &mut *face)] {
            let points = labels::mapped(&own, &names);
            for (seen, restored) in frames_of.iter_mut().zip(frames(&markers, &points)) {
                for (seen, restored) in seen.iter_mut().zip(restored) {
                    *seen = seen.or(restored);
                }
            }
        }
    }
    Ok(())
}

fn mapped(wanted: &[String], names: &[&str], options: &CuedOptions) -> Vec<Option<usize>> {
    let called = |name: &String| {
        let other = options.labels.iter().find(|(own, _)| own == name);
        other.map_or_else(|| name.clone(), |(_, label)| label.clone())
    };
    let wanted: Vec<String> = wanted.iter().map(called).collect();
    labels::mapped(&wanted, names)
}

/// Returns the positions of markers in each frame, in millimetres of model space.
fn frames(
    markers: &Markers,
    points: &[Option<usize>],
) -> Vec<Vec<Option<chereme_motion::glam::DVec3>>> {
    let space = markers.space();
    (0..markers.frames())
        .map(|frame| {
            points
                .iter()
                .map(|point| {
                    let at = markers.points()[(*point)?].at(frame)?;
                    Some(space.shown(at) * 1000.0).filter(|at| at.is_finite())
                })
                .collect()
        })
        .collect()
}

/// Returns the takes of recordings; without names those of all captured recordings that show a cuer's hand or face.
///
/// # Errors
/// Fails if a named recording has no such markers, or no recording has.
pub(super) fn takes(
    connection: &Connection,
    names: &[Name],
    options: &CuedOptions,
) -> Result<Vec<Take>> {
    if !names.is_empty() {
        return names
            .iter()
            .map(|name| take(connection, address::recording(connection, name)?, options))
            .collect();
    }
    let mut found = Vec::new();
    for row in recordings::recordings(connection)? {
        if row.origin == Origin::Made {
            continue;
        }
        let all = tracks::tracks(connection, row.id)?;
        if all.iter().any(|it| it.kind == TrackKind::Markers)
            && let Ok(take) = take(connection, row, options)
        {
            found.push(take);
        }
    }
    if found.is_empty() {
        return Err(
            Error::wrong("no recording shows the markers of a cuer's hand or face").advise(
                Remedy::command("import .c3d or .trc files of a cuer; other labels are mapped with --labels FILE"),
            ),
        );
    }
    Ok(found)
}

/// A take with the keys of its tiers.
pub(super) struct Cued {
    pub(super) take: Take,
    pub(super) followed: Followed,
    pub(super) keys: Vec<Key>,
}

impl Cued {
    pub(super) fn pair(&self) -> (&Followed, &[Key]) {
        (&self.followed, &self.keys)
    }
}

/// Returns the takes of recordings that have keys, with their markers and keys.
///
/// # Errors
/// Fails if no recording has both markers of a hand and keys.
pub(super) fn cued(
    connection: &Connection,
    names: &[Name],
    options: &CuedOptions,
) -> Result<Vec<Cued>> {
    let code = options.code()?;
    let takes = takes(connection, names, options)?;
    let faces = takes.iter().filter(|take| take.has_face());
    let rigid = rigid_set(faces.flat_map(|take| take.face.iter()));
    let mut found = Vec::new();
    for take in takes {
        if !take.has_hand() {
            continue;
        }
        let keys = keys(connection, &take, &code)?;
        if keys.is_empty() {
            continue;
        }
        let rigid = rigid.as_deref().filter(|_| take.has_face());
        let followed = Followed::of_seen(&take.hand, &take.face, rigid, take.rate);
        found.push(Cued {
            take,
            followed,
            keys,
        });
    }
    if found.is_empty() {
        return Err(Error::wrong("no recording has the markers of a hand and a tier of keys or phones")
            .advise("import the TextGrid or EAF file of each take under the same name, with a tier called Phones or Keys"));
    }
    Ok(found)
}

/// Returns the keys of a take in its own time: those of its tier of keys, otherwise those that its phones predict.
pub(super) fn keys(connection: &Connection, take: &Take, code: &CueCode) -> Result<Vec<Key>> {
    let phones = phones(connection, take.row.id, code)?;
    let own = key_tier(connection, &take.row, code)?;
    let seconds = |micros: i64| micros as f64 / 1e6 - take.offset;
    if let Some(own) = own.filter(|own| !own.is_empty()) {
        let starts: Vec<i64> = phones
            .iter()
            .flat_map(|(phones, _)| phones)
            .filter_map(|phone| phone.span)
            .map(|span| span.start().micros())
            .collect();
        let keys = own.iter().map(|key| {
            let (row, shape) = (&key.row, key.shape);
            let first = starts.partition_point(|start| *start < row.start_us);
            let within: Vec<i64> = starts[first..]
                .iter()
                .copied()
                .take_while(|start| *start < row.end_us)
                .collect();
            let (kind, a2) = match within.as_slice() {
                [_, vowel, ..] => (KeySounds::Pair, *vowel),
                // A single vowel at the placement of consonants is ambiguous; at another placement it is a vowel.
                _ if shape == code.vowel_alone
                    && usize::from(key.placement)
                        != cue::placement_number(&code.consonant_alone) =>
                {
                    (KeySounds::Vowel, row.start_us)
                }
                _ => (KeySounds::Consonant, row.end_us),
            };
            Key {
                kind,
                placement: key.placement,
                shape,
                a1: seconds(row.start_us),
                a2: seconds(a2),
                a3: seconds(row.end_us),
            }
        });
        return Ok(keys.collect());
    }
    let Some((phones, alphabet)) = phones else {
        return Ok(Vec::new());
    };
    let read = Utterance::of_phones(code.clone(), phones, alphabet);
    Ok(predicted(&read, take.offset))
}

/// A key that a tier gives.
pub(crate) struct TierKey {
    /// The number of its placement.
    pub(crate) placement: u8,
    pub(crate) shape: u8,
    pub(crate) row: AnnotationRow,
}

/// Returns the keys of a recording's tier of keys; labels that mean silence are none.
///
/// # Errors
/// Fails at the first label that is no key.
pub(crate) fn key_tier(
    connection: &Connection,
    recording: &RecordingRow,
    code: &CueCode,
) -> Result<Option<Vec<TierKey>>> {
    let rows = tier(connection, recording.id, |name| {
        name == CueTier::Keys.name()
    })?;
    let key = |row: AnnotationRow| {
        let known = cue::key_of_label(&row.value).and_then(|(placement, shape)| {
            Some((u8::try_from(cue::placement_number(placement)).ok()?, shape))
        });
        let Some((placement, shape)) = known else {
            return Err(
                Error::wrong(format!("{:?} on the tier Keys is no key", row.value))
                    .at(format!(
                        "{}, {:.3} s",
                        recording.name,
                        row.start_us as f64 / 1e6
                    ))
                    .advise(
                        "write keys as mouth-4, 4-m or 24; silence is an empty annotation or #",
                    ),
            );
        };
        Ok(TierKey {
            placement,
            shape,
            row,
        })
    };
    let rows = rows.map(|rows| {
        let spoken = rows
            .into_iter()
            .filter(|row| !code.is_pause(row.value.trim()));
        spoken.map(key).collect()
    });
    rows.transpose()
}

/// Returns the keys of an utterance whose times are known.
pub(super) fn predicted(read: &Utterance, offset: f64) -> Vec<Key> {
    let keys = read.keys.iter().filter_map(|key| {
        let span = key.span?;
        let seconds = |at: Instant| at.seconds() - offset;
        let (kind, a2) = match key.vowel {
            Some(vowel) if key.phones.len() > 1 => (KeySounds::Pair, vowel.start()),
            Some(vowel) => (KeySounds::Vowel, vowel.start()),
            None => (KeySounds::Consonant, span.end()),
        };
        Some(Key {
            kind,
            placement: u8::try_from(cue::placement_number(&key.placement)).ok()?,
            shape: key.shape,
            a1: seconds(span.start()),
            a2: seconds(a2),
            a3: seconds(span.end()),
        })
    });
    keys.collect()
}

/// Returns the phones of a recording's phone tier, and their alphabet.
pub(super) fn phones(
    connection: &Connection,
    recording: i64,
    code: &CueCode,
) -> Result<Option<(Vec<Phone>, Alphabet)>> {
    let Some(rows) = tier(connection, recording, is_phone_tier)? else {
        return Ok(None);
    };
    let phones: Vec<Phone> = rows
        .into_iter()
        .map(|row| Phone {
            label: row.value.trim().to_owned(),
            span: Some(Span::between(
                Instant::from_micros(row.start_us),
                Instant::from_micros(row.end_us.max(row.start_us)),
            )),
        })
        .collect();
    let alphabet = guessed_alphabet(code, &phones);
    Ok(Some((crate::cue::with_gaps(phones), alphabet)))
}

/// Returns the annotations of the first tier of a recording whose name meets `fits`.
pub(super) fn tier(
    connection: &Connection,
    recording: i64,
    fits: impl Fn(&str) -> bool,
) -> Result<Option<Vec<AnnotationRow>>> {
    for row in tiers::tiers(connection, recording)? {
        if fits(&row.name) {
            return Ok(Some(tiers::annotations(connection, row.id)?));
        }
    }
    Ok(None)
}
