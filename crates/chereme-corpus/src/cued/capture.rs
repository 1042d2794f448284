//! Markers and keys of a recording in the form for the models of cued speech.

use std::collections::BTreeSet;
use std::path::Path;

use chereme_analysis::cue::cue_face;
use chereme_analysis::cue::cue_hand;
use chereme_analysis::cue::cue_labels;
use chereme_analysis::cue::session::{ExpectedCueKey, FollowedTake, KeySounds, rigid_set};
use chereme_compose::CueTier;
use chereme_motion::{MarkerSpace, MarkerTrack, RecordingInstant, TimeSpan};
use chereme_sign::cue::{self, CueCode, CuedUtterance, PhoneAlphabet, SpokenPhone};
use rusqlite::Connection;
use serde::Serialize;

use super::CuedOptions;
use crate::Corpus;
use crate::address::{self, RowName};
use crate::cue::{guessed_alphabet, is_phone_tier};
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self, AnnotationRow};
use crate::db::stored_tracks::{self, TrackKind, TrackRow};
use crate::error::{CorpusError, CorpusResult};
use crate::track::track_read;

/// The name of the tracks of restored markers.
pub(super) const RESTORED_TRACK_NAME: &str = "restored";
/// The fewest labels of a set that make a recording count as showing it.
const MIN_SHOWN_MARKER_LABELS: usize = 12;
/// The longest take that is processed, in frames.
const MAX_TAKE_FRAMES: usize = 400_000;

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
pub fn read_marker_labels(path: &Path) -> CorpusResult<Vec<(String, String)>> {
    const MAX_MARKER_LABELS_BYTES: u64 = 1 << 20;
    let size = std::fs::metadata(path)
        .map_err(|error| CorpusError::from_file_failure(path, error))?
        .len();
    if size > MAX_MARKER_LABELS_BYTES {
        return Err(CorpusError::from_wrong_message(format!("the file has {size} bytes"))
            .with_error_place(path.display().to_string())
            .with_advice("give a table of two columns and at most 1 MiB"));
    }
    let text = std::fs::read_to_string(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    let known_labels: BTreeSet<String> = cue_labels::hand_marker_names()
        .into_iter()
        .chain(cue_labels::face_marker_names())
        .collect();
    let mut all = Vec::new();
    // Spreadsheets put a byte order mark before the first name.
    for (line, row) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        let row = row.trim();
        if row.is_empty() || row.starts_with('#') {
            continue;
        }
        let wrong = |message: String| {
            CorpusError::from_wrong_message(message)
                .with_error_place(format!("{}, line {line}", path.display()))
                .with_advice("write a name such as HB1, a comma, and the label of the file; names are FA1-FA5, HB1-HB7, I1-I8, M1-M8, R1-R8, L1-L8, T1-T6, RF1-RF5, RN1-RN2, RE1-RE2, LP1-LP16, CK1-CK12, JW1-JW8, TH1-TH18")
        };
        let cut = row.split_once([',', '\t', ';']);
        let Some((own, label)) = cut.map(|(own, label)| (own.trim(), label.trim())) else {
            return Err(wrong(format!("{row:?} has no second column")));
        };
        if !known_labels.contains(own) {
            return Err(wrong(format!("{own:?} is no marker of the models")));
        }
        all.push((own.to_owned(), label.to_owned()));
    }
    Ok(all)
}

/// A take of a cuer: its markers in millimetres of model space; hidden markers have the positions that were restored
/// earlier.
pub(super) struct CuerTake {
    pub(super) row: RecordingRow,
    pub(super) track: TrackRow,
    pub(super) markers: MarkerTrack,
    /// The index of each hand marker among the track's points.
    pub(super) hand_points: Vec<Option<usize>>,
    pub(super) face_points: Vec<Option<usize>>,
    pub(super) rate: f64,
    /// The time of frame 0 on the recording's clock, in seconds.
    pub(super) offset: f64,
    pub(super) hand: Vec<cue_hand::HandMarkerFrame>,
    pub(super) face: Vec<cue_face::FaceMarkerFrame>,
}

impl CuerTake {
    pub(super) fn has_hand(&self) -> bool {
        count_found_points(&self.hand_points) >= MIN_SHOWN_MARKER_LABELS && visible_position_share(&self.hand) > 0.0
    }

    pub(super) fn has_face(&self) -> bool {
        count_found_points(&self.face_points) >= MIN_SHOWN_MARKER_LABELS && visible_position_share(&self.face) > 0.0
    }

    pub(super) fn take_frame_count(&self) -> usize {
        self.markers.marker_frame_count()
    }

    /// Returns the time of a frame on the recording's clock, in microseconds.
    pub(super) fn take_time_micros(&self, seconds: f64) -> i64 {
        ((seconds + self.offset) * 1e6).round() as i64
    }
}

fn count_found_points(points: &[Option<usize>]) -> usize {
    points.iter().flatten().count()
}

/// Returns the share of positions that are visible.
fn visible_position_share(frames: &[Vec<Option<chereme_motion::glam::DVec3>>]) -> f64 {
    let all: usize = frames.iter().map(Vec::len).sum();
    let seen: usize = frames.iter().map(|frame| frame.iter().flatten().count()).sum();
    seen as f64 / all.max(1) as f64
}

impl Corpus {
    /// Returns the markers of a recording that the models of cued speech know, and their visibility.
    ///
    /// # Errors
    /// Fails if there is no such recording, or it has no markers in a room.
    pub fn cued_markers(&self, recording: &RowName, options: &CuedOptions) -> CorpusResult<CuedMarkers> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let take = load_cuer_take(connection, row, options)?;
        let set = |points: &[Option<usize>], names: Vec<String>| {
            let set_points = points.iter().flatten();
            let (mut all, mut seen) = (0u64, 0u64);
            for point in set_points {
                let marker = &take.markers.marker_points()[*point];
                all += take.take_frame_count() as u64;
                seen += (0..take.take_frame_count())
                    .filter(|frame| marker.marker_position(*frame).is_some())
                    .count() as u64;
            }
            MarkerSet {
                found: count_found_points(points) as u64,
                missing: names
                    .into_iter()
                    .zip(points)
                    .filter(|(_, at)| at.is_none())
                    .map(|(name, _)| name)
                    .collect(),
                seen: super::round_to_decimals(seen as f64 / all.max(1) as f64, 4),
            }
        };
        let used: BTreeSet<usize> = take
            .hand_points
            .iter()
            .chain(&take.face_points)
            .flatten()
            .copied()
            .collect();
        let numbered_points = take.markers.marker_points().iter().enumerate();
        let unused = numbered_points
            .filter(|(n, _)| !used.contains(n))
            .map(|(_, point)| point.name.clone());
        Ok(CuedMarkers {
            track: take.track.name.clone(),
            rate: take.rate,
            frames: take.take_frame_count() as u64,
            hand: set(&take.hand_points, cue_labels::hand_marker_names()),
            face: set(&take.face_points, cue_labels::face_marker_names()),
            unused: unused.collect(),
            restored: restored_places(connection, take.row.id)?,
            recording: take.row.name,
        })
    }
}

fn restored_places(connection: &Connection, recording: i64) -> CorpusResult<u64> {
    let mut count = 0;
    for row in stored_tracks::load_track_rows(connection, recording)? {
        if row.kind == TrackKind::Markers && row.name == RESTORED_TRACK_NAME {
            let markers = track_read::read_track_markers(connection, &row, None)?;
            for point in markers.marker_points() {
                count += (0..markers.marker_frame_count())
                    .filter(|frame| point.marker_position(*frame).is_some())
                    .count() as u64;
            }
        }
    }
    Ok(count)
}

/// Returns the take of a recording.
pub(super) fn load_cuer_take(
    connection: &Connection,
    row: RecordingRow,
    options: &CuedOptions,
) -> CorpusResult<CuerTake> {
    let no_markers = |message: String| {
        CorpusError::from_wrong_message(message)
            .with_error_place(row.name.clone())
            .with_command_advice("import a .c3d or .trc file of a cuer; other labels are mapped with --labels FILE")
    };
    let mut best: Option<(TrackRow, usize)> = None;
    let all = stored_tracks::load_track_rows(connection, row.id)?;
    for track in all
        .iter()
        .filter(|track| track.kind == TrackKind::Markers && track.name != RESTORED_TRACK_NAME)
    {
        let channel_names: Vec<String> = stored_tracks::load_channel_rows(connection, track.id)?
            .into_iter()
            .map(|channel| channel.name)
            .collect();
        let names: Vec<&str> = channel_names.iter().map(String::as_str).collect();
        let count = count_found_points(&map_marker_labels(&cue_labels::hand_marker_names(), &names, options))
            + count_found_points(&map_marker_labels(&cue_labels::face_marker_names(), &names, options));
        // Of several tracks of markers the one with the most known labels shows the cuer.
        if best.as_ref().is_none_or(|(_, most)| count > *most) {
            best = Some((track.clone(), count));
        }
    }
    let Some((track, count)) = best else {
        return Err(no_markers(format!("{:?} has no track of markers", row.name)));
    };
    if count < MIN_SHOWN_MARKER_LABELS {
        return Err(no_markers(format!(
            "{count} labels of {:?} are known as markers of a cuer's hand or face",
            row.name
        )));
    }
    if track.frames.is_some_and(|frames| frames > MAX_TAKE_FRAMES as u64) {
        return Err(CorpusError::from_wrong_message(format!(
            "{:?} has {} frames; at most {MAX_TAKE_FRAMES} are followed at once",
            row.name,
            track.frames.unwrap_or_default()
        ))
        .with_error_place(row.name.clone())
        .with_advice("cut the recording into shorter takes"));
    }
    let markers = track_read::read_track_markers(connection, &track, None)?;
    let rate = markers.marker_times().even_times_rate().ok_or_else(|| {
        CorpusError::from_wrong_message(format!("the frames of {:?} are not even in time", row.name))
            .with_error_place(row.name.clone())
            .with_advice("export it from the camera system with a constant frame rate")
    })?;
    // Models are in millimetres of a room, which a picture does not give.
    if !matches!(markers.marker_space(), MarkerSpace::World(_)) {
        return Err(no_markers(format!(
            "the points of {:?} lie on a picture, and not in a room",
            row.name
        )));
    }
    let names: Vec<&str> = markers
        .marker_points()
        .iter()
        .map(|point| point.name.as_str())
        .collect();
    let hand_points = map_marker_labels(&cue_labels::hand_marker_names(), &names, options);
    let face_points = map_marker_labels(&cue_labels::face_marker_names(), &names, options);
    let mut hand = marker_positions_by_frame(&markers, &hand_points);
    let mut face = marker_positions_by_frame(&markers, &face_points);
    fill_restored_positions(connection, row.id, &mut hand, &mut face)?;
    Ok(CuerTake {
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
fn fill_restored_positions(
    connection: &Connection,
    recording: i64,
    hand: &mut [cue_hand::HandMarkerFrame],
    face: &mut [cue_face::FaceMarkerFrame],
) -> CorpusResult<()> {
    for row in stored_tracks::load_track_rows(connection, recording)? {
        if row.kind != TrackKind::Markers || row.name != RESTORED_TRACK_NAME {
            continue;
        }
        let markers = track_read::read_track_markers(connection, &row, None)?;
        let names: Vec<&str> = markers
            .marker_points()
            .iter()
            .map(|point| point.name.as_str())
            .collect();
        for (own, frames_of) in [
            (cue_labels::hand_marker_names(), &mut *hand),
            (cue_labels::face_marker_names(), &mut *face),
        ] {
            let points = cue_labels::match_cue_labels(&own, &names);
            for (seen, restored) in frames_of.iter_mut().zip(marker_positions_by_frame(&markers, &points)) {
                for (seen, restored) in seen.iter_mut().zip(restored) {
                    // A captured position always counts for more than a restored one.
                    *seen = seen.or(restored);
                }
            }
        }
    }
    Ok(())
}

fn map_marker_labels(wanted: &[String], names: &[&str], options: &CuedOptions) -> Vec<Option<usize>> {
    let called = |name: &String| {
        let other = options.labels.iter().find(|(own, _)| own == name);
        other.map_or_else(|| name.clone(), |(_, label)| label.clone())
    };
    let wanted: Vec<String> = wanted.iter().map(called).collect();
    cue_labels::match_cue_labels(&wanted, names)
}

/// Returns the positions of markers in each frame, in millimetres of model space.
fn marker_positions_by_frame(
    markers: &MarkerTrack,
    points: &[Option<usize>],
) -> Vec<Vec<Option<chereme_motion::glam::DVec3>>> {
    let space = markers.marker_space();
    (0..markers.marker_frame_count())
        .map(|frame| {
            points
                .iter()
                .map(|point| {
                    let marker_point = markers.marker_points()[(*point)?].marker_position(frame)?;
                    Some(space.displayed_position(marker_point) * 1000.0).filter(|at| at.is_finite())
                })
                .collect()
        })
        .collect()
}

/// Returns the takes of recordings; without names those of all captured recordings that show a cuer's hand or face.
///
/// # Errors
/// Fails if a named recording has no such markers, or no recording has.
pub(super) fn load_cuer_takes(
    connection: &Connection,
    names: &[RowName],
    options: &CuedOptions,
) -> CorpusResult<Vec<CuerTake>> {
    if !names.is_empty() {
        return names
            .iter()
            .map(|name| load_cuer_take(connection, address::find_recording_by_name(connection, name)?, options))
            .collect();
    }
    let mut take_list = Vec::new();
    for row in stored_recordings::load_recording_rows(connection)? {
        if row.origin == RecordOrigin::Made {
            continue;
        }
        let all = stored_tracks::load_track_rows(connection, row.id)?;
        // A recording of somebody else's markers is no error when nobody named it.
        if all.iter().any(|track| track.kind == TrackKind::Markers)
            && let Ok(take) = load_cuer_take(connection, row, options)
        {
            take_list.push(take);
        }
    }
    if take_list.is_empty() {
        return Err(
            CorpusError::from_wrong_message("no recording shows the markers of a cuer's hand or face")
                .with_command_advice("import .c3d or .trc files of a cuer; other labels are mapped with --labels FILE"),
        );
    }
    Ok(take_list)
}

/// A take with the keys of its tiers.
pub(super) struct KeyedTake {
    pub(super) take: CuerTake,
    pub(super) followed: FollowedTake,
    pub(super) keys: Vec<ExpectedCueKey>,
}

impl KeyedTake {
    pub(super) fn followed_with_keys(&self) -> (&FollowedTake, &[ExpectedCueKey]) {
        (&self.followed, &self.keys)
    }
}

/// Returns the takes of recordings that have keys, with their markers and keys.
///
/// # Errors
/// Fails if no recording has both markers of a hand and keys.
pub(super) fn load_keyed_takes(
    connection: &Connection,
    names: &[RowName],
    options: &CuedOptions,
) -> CorpusResult<Vec<KeyedTake>> {
    let code = options.load_cue_code()?;
    let takes = load_cuer_takes(connection, names, options)?;
    let faces = takes.iter().filter(|take| take.has_face());
    // The head's rigid markers are learned once from all takes that show a face.
    let rigid = rigid_set(faces.flat_map(|take| take.face.iter()));
    let mut cued_takes = Vec::new();
    for take in takes {
        if !take.has_hand() {
            continue;
        }
        let keys = load_take_keys(connection, &take, &code)?;
        if keys.is_empty() {
            continue;
        }
        let rigid = rigid.as_deref().filter(|_| take.has_face());
        let followed = FollowedTake::of_seen(&take.hand, &take.face, rigid, take.rate);
        cued_takes.push(KeyedTake { take, followed, keys });
    }
    if cued_takes.is_empty() {
        return Err(CorpusError::from_wrong_message(
            "no recording has the markers of a hand and a tier of keys or phones",
        )
        .with_advice(
            "import the TextGrid or EAF file of each take under the same name, with a tier called Phones or Keys",
        ));
    }
    Ok(cued_takes)
}

/// Returns the keys of a take in its own time: those of its tier of keys, otherwise those that its phones predict.
pub(super) fn load_take_keys(
    connection: &Connection,
    take: &CuerTake,
    code: &CueCode,
) -> CorpusResult<Vec<ExpectedCueKey>> {
    let phones = load_recording_phones(connection, take.row.id, code)?;
    let tier_keys = key_tier(connection, &take.row, code)?;
    let seconds = |micros: i64| micros as f64 / 1e6 - take.offset;
    if let Some(own) = tier_keys.filter(|own| !own.is_empty()) {
        let starts: Vec<i64> = phones
            .iter()
            .flat_map(|(phones, _)| phones)
            .filter_map(|phone| phone.span)
            .map(|span| span.span_start_instant().instant_micros())
            .collect();
        let keys = own.iter().map(|key| {
            let (row, shape) = (&key.row, key.shape);
            // The starts of phones are in order of time.
            let first = starts.partition_point(|start| *start < row.start_us);
            let within: Vec<i64> = starts[first..]
                .iter()
                .copied()
                .take_while(|start| *start < row.end_us)
                .collect();
            // The number of phones within a key says its sounds: two are a consonant and a vowel.
            let (kind, a2) = match within.as_slice() {
                [_, vowel, ..] => (KeySounds::Pair, *vowel),
                // A single vowel at the placement of consonants is ambiguous; at another placement it is a vowel.
                _ if shape == code.vowel_alone
                    && usize::from(key.placement) != cue::placement_number(&code.consonant_alone) =>
                {
                    (KeySounds::Vowel, row.start_us)
                }
                _ => (KeySounds::Consonant, row.end_us),
            };
            ExpectedCueKey {
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
    let read = CuedUtterance::of_phones(code.clone(), phones, alphabet);
    Ok(keys_from_timed_utterance(&read, take.offset))
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
) -> CorpusResult<Option<Vec<TierKey>>> {
    let rows = find_tier_annotations_named(connection, recording.id, |name| name == CueTier::Keys.cue_tier_name())?;
    let key = |row: AnnotationRow| {
        let label_key = cue::key_of_label(&row.value)
            .and_then(|(placement, shape)| Some((u8::try_from(cue::placement_number(placement)).ok()?, shape)));
        let Some((placement, shape)) = label_key else {
            return Err(
                CorpusError::from_wrong_message(format!("{:?} on the tier Keys is no key", row.value))
                    .with_error_place(format!("{}, {:.3} s", recording.name, row.start_us as f64 / 1e6))
                    .with_advice("write keys as mouth-4, 4-m or 24; silence is an empty annotation or #"),
            );
        };
        Ok(TierKey { placement, shape, row })
    };
    let rows = rows.map(|rows| {
        let spoken = rows.into_iter().filter(|row| !code.is_pause(row.value.trim()));
        spoken.map(key).collect()
    });
    rows.transpose()
}

/// Returns the keys of an utterance whose times are known.
pub(super) fn keys_from_timed_utterance(read: &CuedUtterance, offset: f64) -> Vec<ExpectedCueKey> {
    let keys = read.keys.iter().filter_map(|key| {
        let span = key.span?;
        let seconds = |at: RecordingInstant| at.instant_seconds() - offset;
        let (kind, a2) = match key.vowel {
            Some(vowel) if key.phones.len() > 1 => (KeySounds::Pair, vowel.span_start_instant()),
            Some(vowel) => (KeySounds::Vowel, vowel.span_start_instant()),
            None => (KeySounds::Consonant, span.span_end_instant()),
        };
        Some(ExpectedCueKey {
            kind,
            placement: u8::try_from(cue::placement_number(&key.placement)).ok()?,
            shape: key.shape,
            a1: seconds(span.span_start_instant()),
            a2: seconds(a2),
            a3: seconds(span.span_end_instant()),
        })
    });
    keys.collect()
}

/// Returns the phones of a recording's phone tier, and their alphabet.
pub(super) fn load_recording_phones(
    connection: &Connection,
    recording: i64,
    code: &CueCode,
) -> CorpusResult<Option<(Vec<SpokenPhone>, PhoneAlphabet)>> {
    let Some(rows) = find_tier_annotations_named(connection, recording, is_phone_tier)? else {
        return Ok(None);
    };
    let phones: Vec<SpokenPhone> = rows
        .into_iter()
        .map(|row| SpokenPhone {
            label: row.value.trim().to_owned(),
            span: Some(TimeSpan::from_span_micros(row.start_us, row.end_us.max(row.start_us))),
        })
        .collect();
    let alphabet = guessed_alphabet(code, &phones);
    // Phone tiers may leave pauses out, which a reading needs in order not to join words over them.
    Ok(Some((crate::cue::with_gaps(phones), alphabet)))
}

/// Returns the annotations of the first tier of a recording whose name meets `fits`.
pub(super) fn find_tier_annotations_named(
    connection: &Connection,
    recording: i64,
    fits: impl Fn(&str) -> bool,
) -> CorpusResult<Option<Vec<AnnotationRow>>> {
    for row in stored_tiers::load_tier_rows(connection, recording)? {
        if fits(&row.name) {
            return Ok(Some(stored_tiers::load_tier_annotation_rows(connection, row.id)?));
        }
    }
    Ok(None)
}
