//! Hidden markers restored from models of hand and face, as a track of their own.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use chereme_analysis::cue::cue_face::FaceModel;
use chereme_analysis::cue::cue_hand::{HandModel, RestoredHand};
use chereme_analysis::cue::rigid::RigidMotion;
use chereme_motion::column::FrameNumberColumn;
use chereme_motion::glam::DVec3;
use chereme_motion::markers::{MotionMarker, QualityMeaning};
use chereme_motion::{CaptureMethod, MarkerSpace, MarkerTrack, SpaceConvention};
use rusqlite::Connection;
use serde::Serialize;

use super::capture::{CuerTake, RESTORED_TRACK_NAME, load_cuer_take, load_cuer_takes};
use super::{CuedOptions, round_to_decimals};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_recordings::RecordingRow;
use crate::db::stored_tracks::{self, TrackKind};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::track::{NewTrack, TrackContent, track_store};
use crate::words::effect::OperationEffect;

/// Settings for restoring hidden markers: the takes to learn from, and the size of the model.
#[derive(Debug, Clone)]
pub struct RestoreOptions {
    /// The recordings from which the models learn; without names takes of the hand alone and of the face alone,
    /// otherwise all takes.
    pub train: Vec<RowName>,
    /// The number of components in the model of the hand's posture, from 1 to 25.
    pub components: usize,
    /// Whether to report the errors and store nothing.
    pub dry_run: bool,
    /// Labels and code.
    pub cued: CuedOptions,
}

impl Default for RestoreOptions {
    fn default() -> Self {
        Self {
            train: Vec::new(),
            components: 20,
            dry_run: false,
            cued: CuedOptions::default(),
        }
    }
}

/// A take whose hidden markers were restored.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestoredTake {
    /// The name of the recording.
    pub recording: String,
    /// The recordings from which the model of the hand learned; empty without a model.
    pub hand_from: Vec<String>,
    /// The share of the hand's variance that its components explain.
    pub explained: Option<f64>,
    /// The recordings from which the model of the face learned; empty without a model.
    pub face_from: Vec<String>,
    /// How many frames there are.
    pub frames: u64,
    /// The number of hidden positions of known markers.
    pub hidden: u64,
    /// The number of restored positions.
    pub restored: u64,
    /// The number of uncertain positions: their predicted standard deviation is above 8 mm in the room.
    pub uncertain: u64,
    /// The mean distance of the hand's visible markers from the model, in millimetres.
    pub hand_mm: Option<f64>,
    /// The mean distance along one axis, in millimetres.
    pub hand_axis_mm: Option<f64>,
    /// The mean distance of the face's visible markers from the model, in millimetres.
    pub face_mm: Option<f64>,
    /// The markers that were restored.
    pub markers: Vec<RestoredMarker>,
    /// The track of restored positions; nothing if none was stored.
    pub track: Option<String>,
    /// Reasons for caution.
    pub findings: Vec<String>,
}

/// A marker that was restored.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestoredMarker {
    /// Its name in the file.
    pub name: String,
    /// The number of frames in which it was restored.
    pub frames: u64,
    /// The mean of its predicted standard deviation in the room, in millimetres.
    pub sd_mm: f64,
    /// The greatest predicted standard deviation, in millimetres.
    pub most_sd_mm: f64,
}

/// The predicted standard deviation in the room above which a position counts as uncertain, in millimetres.
const UNCERTAIN_POSITION_DEVIATION_MM: f64 = 8.0;
/// The mean distance of visible markers from the model above which a finding warns, in millimetres.
const FAR_MARKER_DISTANCE_MM: f64 = 6.0;
/// The number of frames after which no further take is loaded to be restored at the same time.
const MAX_FRAMES_RESTORED_TOGETHER: usize = 100_000;
/// The largest number of frames from which a model learns.
const MOST_LEARNED: usize = 10_000;

/// A frame in the model of the face: the head's motion, and the position and predicted error of each marker.
type FaceRow = (RigidMotion, Vec<DVec3>, Vec<f64>);

/// The report on a take, and the track of restored markers if there are any.
type TakeRestoration = (RestoredTake, Option<NewTrack>);

struct RestorationModels {
    hand: Option<(HandModel, Vec<String>)>,
    face: Option<(FaceModel, Vec<String>)>,
    findings: Vec<String>,
}

impl Corpus {
    /// Restores the hidden markers of cuers. Models of hand and face learn from recordings, and their estimates of
    /// hidden markers become the track `restored` of each recording, with the predicted standard deviation of each
    /// position; an earlier track of that name is replaced. Captured tracks remain unchanged.
    ///
    /// # Errors
    /// Fails if there are no such markers, too few frames to learn from, or `progress` stops the work.
    pub fn restore_markers(
        &mut self,
        recordings: &[RowName],
        options: &RestoreOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<RestoredTake>> {
        if !(1..=25).contains(&options.components) {
            return Err(
                CorpusError::from_wrong_message(format!("{} components", options.components))
                    .with_advice("a hand has from 1 to 25; the founding paper keeps 12"),
            );
        }
        let connection = self.store.read_connection();
        let (models, rows) = models(connection, options, progress)?;
        let mut done = Vec::new();
        let mut new = Vec::new();
        let named: Vec<RecordingRow> = match (recordings, options.train.as_slice()) {
            ([], []) => rows,
            ([], _) => {
                let all = load_cuer_takes(connection, &[], &options.cued)?;
                all.into_iter().map(|take| take.row).collect()
            }
            _ => {
                let rows = recordings
                    .iter()
                    .map(|name| address::find_recording_by_name(connection, name));
                rows.collect::<CorpusResult<_>>()?
            }
        };
        let mut ahead = named.into_iter().peekable();
        let mut counted = RestoredFrameCounter::default();
        while ahead.peek().is_some() {
            let mut together: Vec<CuerTake> = Vec::new();
            let mut frames = 0;
            // Takes are held in memory together only as long as there are cores for them.
            while together.len() < cores() && frames < MAX_FRAMES_RESTORED_TOGETHER {
                let Some(row) = ahead.next() else { break };
                let take = load_cuer_take(connection, row, &options.cued)?;
                frames += take.take_frame_count();
                together.push(take);
            }
            for (take, result) in together
                .iter()
                .zip(counted.restore_all_takes(&together, &models, progress)?)
            {
                let (report, track) = result?;
                done.push(report);
                new.push((take.row.id, track));
            }
        }
        if options.dry_run || new.iter().all(|(_, track)| track.is_none()) {
            return Ok(done);
        }
        let effect = OperationEffect::RestoreMarkers {
            places: done.iter().map(|take| take.restored).sum(),
            recordings: done.len() as u64,
        };
        let names = self.store.run_store_operation(|connection| {
            let mut names = Vec::new();
            for (recording, track) in &new {
                let Some(track) = track else {
                    names.push(None);
                    continue;
                };
                if let Some(old) =
                    stored_tracks::find_named_track(connection, *recording, TrackKind::Markers, RESTORED_TRACK_NAME)?
                {
                    stored_tracks::remove_track(connection, old)?;
                }
                let id = track_store::store_new_track(connection, *recording, track)?;
                names.push(Some(stored_tracks::load_track_row(connection, id)?.name));
            }
            Ok((names, effect))
        })?;
        for (report, name) in done.iter_mut().zip(names) {
            report.track = name;
        }
        Ok(done)
    }
}

/// Trains the models: the hand's on takes of the hand alone if there are any, the face's on takes of the face. Returns the
/// recordings of all takes that were read, too.
fn models(
    connection: &Connection,
    options: &RestoreOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<(RestorationModels, Vec<RecordingRow>)> {
    let all = load_cuer_takes(connection, &options.train, &options.cued)?;
    let lone_takes = |of: fn(&CuerTake) -> bool, other: fn(&CuerTake) -> bool| -> Vec<&CuerTake> {
        let matching_takes: Vec<&CuerTake> = all.iter().filter(|take| of(take)).collect();
        let alone: Vec<&CuerTake> = matching_takes.iter().copied().filter(|take| !other(take)).collect();
        // Where the hand touches the face, each hides markers of the other; takes of one alone show all.
        if options.train.is_empty() && !alone.is_empty() {
            alone
        } else {
            matching_takes
        }
    };
    let hands = lone_takes(CuerTake::has_hand, CuerTake::has_face);
    let faces = lone_takes(CuerTake::has_face, CuerTake::has_hand);
    let names = |of: &[&CuerTake]| of.iter().map(|take| take.row.name.clone()).collect();
    let mut findings = Vec::new();
    let mut learn = |task: &'static str, done: u64| progress.report_amount(ProgressUnit::Items, task, done, Some(2));
    learn("the model of the hand", 0)?;
    let hand = match thinned(&hands, |take| &take.hand_points) {
        frames if frames.is_empty() => None,
        frames => match HandModel::learn_hand_model(&frames, options.components) {
            Ok(model) => Some((model, names(&hands))),
            Err(error) => {
                findings.push(format!("there is no model of the hand: {error}"));
                None
            }
        },
    };
    learn("the model of the face", 1)?;
    let face = match thinned(&faces, |take| &take.face_points) {
        frames if frames.is_empty() => None,
        frames => match FaceModel::learn_face_model(&frames) {
            Ok(model) => Some((model, names(&faces))),
            Err(error) => {
                findings.push(format!("there is no model of the face: {error}"));
                None
            }
        },
    };
    if hand.is_none() && face.is_none() {
        return Err(
            CorpusError::from_wrong_message(findings.join("; ")).with_command_advice(
                "name with --train recordings that show every marker, of the hand alone or the face alone",
            ),
        );
    }
    let models = RestorationModels { hand, face, findings };
    Ok((models, all.into_iter().map(|take| take.row).collect()))
}

/// Returns captured frames of takes in which something is visible, evenly thinned.
fn thinned(takes: &[&CuerTake], points: fn(&CuerTake) -> &[Option<usize>]) -> Vec<Vec<Option<DVec3>>> {
    let all: usize = takes.iter().map(|take| take.take_frame_count()).sum();
    let step = all.div_ceil(MOST_LEARNED).max(1);
    let mut some = Vec::new();
    for take in takes {
        let step_frames = (0..take.take_frame_count()).step_by(step);
        let frames = step_frames.map(|frame| captured_frame_positions(take, points(take), frame));
        some.extend(frames.filter(|frame| frame.iter().any(Option::is_some)));
    }
    some
}

/// Returns the number of takes that are restored at the same time.
fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from).min(8)
}

/// Frames restored so far.
#[derive(Default)]
struct RestoredFrameCounter {
    frames: AtomicU64,
    stopped: AtomicBool,
}

impl RestoredFrameCounter {
    /// Restores takes at the same time, each by a thread of its own, and reports the progress from this one.
    fn restore_all_takes(
        &mut self,
        takes: &[CuerTake],
        models: &RestorationModels,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<CorpusResult<TakeRestoration>>> {
        const RESTORE_POLL_PAUSE: Duration = Duration::from_millis(20);
        let counted = &*self;
        thread::scope(|scope| {
            let running: Vec<_> = takes
                .iter()
                .map(|take| scope.spawn(move || restored(take, models, counted)))
                .collect();
            while running.iter().any(|worker| !worker.is_finished()) {
                let step = ProgressStep {
                    task: "restoring markers",
                    done: counted.frames.load(Ordering::Relaxed),
                    total: None,
                    unit: ProgressUnit::Frames,
                };
                if let Err(stopped) = progress.report_step(step) {
                    counted.stopped.store(true, Ordering::Relaxed);
                    return Err(stopped);
                }
                thread::sleep(RESTORE_POLL_PAUSE);
            }
            let lost = || Err(CorpusError::from_wrong_message("a take could not be restored"));
            let done = running.into_iter();
            Ok(done.map(|worker| worker.join().unwrap_or_else(|_| lost())).collect())
        })
    }
}

fn restored(
    take: &CuerTake,
    models: &RestorationModels,
    counted: &RestoredFrameCounter,
) -> CorpusResult<TakeRestoration> {
    let mut hand_rows: Vec<Option<RestoredHand>> = Vec::new();
    let mut face_rows: Vec<Option<FaceRow>> = Vec::new();
    let mut before: Option<RestoredHand> = None;
    for frame in 0..take.take_frame_count() {
        if frame % 64 == 0 && counted.stopped.load(Ordering::Relaxed) {
            return Err(CorpusError::Stopped);
        }
        counted.frames.fetch_add(1, Ordering::Relaxed);
        if let Some((model, _)) = &models.hand {
            let restored_hand = model.restore_hand_markers(
                // Positions that were restored earlier must not be taken for captured ones.
                &captured_frame_positions(take, &take.hand_points, frame),
                before.as_ref(),
            );
            // The posture of the frame before is the start of the search for the next one.
            before.clone_from(&restored_hand);
            hand_rows.push(restored_hand);
        }
        if let Some((model, _)) = &models.face {
            face_rows.push(model.restore_face_markers(&captured_frame_positions(take, &take.face_points, frame)));
        }
    }
    let hand_of = |frame: usize| {
        let row = hand_rows.get(frame)?.as_ref()?;
        Some((row.points.as_slice(), row.sd.as_slice()))
    };
    let face_of = |frame: usize| {
        let row = face_rows.get(frame)?.as_ref()?;
        Some((row.1.as_slice(), row.2.as_slice()))
    };
    let mut report = RestoredTake {
        recording: take.row.name.clone(),
        hand_from: models.hand.as_ref().map_or(Vec::new(), |entry| entry.1.clone()),
        explained: models
            .hand
            .as_ref()
            .map(|entry| round_to_decimals(entry.0.explained_variance_share(), 4)),
        face_from: models.face.as_ref().map_or(Vec::new(), |entry| entry.1.clone()),
        frames: take.take_frame_count() as u64,
        hidden: 0,
        restored: 0,
        uncertain: 0,
        hand_mm: None,
        hand_axis_mm: None,
        face_mm: None,
        markers: Vec::new(),
        track: None,
        findings: models.findings.clone(),
    };
    let mut points = Vec::new();
    let (hand_mm, axis_mm) = add_restored_marker_set(take, &take.hand_points, &hand_of, &mut report, &mut points);
    let (face_mm, _) = add_restored_marker_set(take, &take.face_points, &face_of, &mut report, &mut points);
    report.hand_mm = hand_mm.map(|distance| round_to_decimals(distance, 2));
    report.hand_axis_mm = axis_mm.map(|distance| round_to_decimals(distance, 2));
    report.face_mm = face_mm.map(|distance| round_to_decimals(distance, 2));
    for (part, mm) in [("hand", hand_mm), ("face", face_mm)] {
        if let Some(mm) = mm.filter(|mm| *mm > FAR_MARKER_DISTANCE_MM) {
            report.findings.push(format!(
                "the visible markers of the {part} are {mm:.1} mm from the model on average, so restored ones are not to be \
                 trusted; check the labels and the axes of this recording, or train on takes of the same person"
            ));
        }
    }
    if points.is_empty() {
        return Ok((report, None));
    }
    let space = MarkerSpace::World(SpaceConvention {
        metres_per_unit: 0.001,
        ..SpaceConvention::MODEL_CONVENTION
    });
    let fault = |error: chereme_motion::TrackError| CorpusError::from_wrong_message(error.to_string());
    let markers = MarkerTrack::new(take.markers.marker_times().clone(), space, points)
        .map_err(fault)?
        .with_capture_method(CaptureMethod::Estimated)
        .with_quality_meaning(QualityMeaning::Residual);
    let track = NewTrack {
        offset_us: take.track.offset_us,
        ..NewTrack::new(RESTORED_TRACK_NAME, TrackContent::Markers(markers))
    };
    Ok((report, Some(track)))
}

/// Returns a frame as captured, without positions that were restored earlier.
fn captured_frame_positions(take: &CuerTake, points: &[Option<usize>], frame: usize) -> Vec<Option<DVec3>> {
    let space = take.markers.marker_space();
    points
        .iter()
        .map(|point| {
            let marker_point = take.markers.marker_points()[(*point)?].marker_position(frame)?;
            Some(space.displayed_position(marker_point) * 1000.0).filter(|at| at.is_finite())
        })
        .collect()
}

/// Adds the restored positions of a set of markers; returns the mean distance of its visible markers from the model,
/// and the mean distance along one axis.
fn add_restored_marker_set<'a>(
    take: &CuerTake,
    points: &[Option<usize>],
    predicted: &dyn Fn(usize) -> Option<(&'a [DVec3], &'a [f64])>,
    report: &mut RestoredTake,
    new: &mut Vec<MotionMarker>,
) -> (Option<f64>, Option<f64>) {
    let (mut sum, mut axes, mut count) = (0.0, 0.0, 0.0);
    let space = take.markers.marker_space();
    for (marker, point) in points.iter().enumerate() {
        let Some(point) = point else { continue };
        let source = &take.markers.marker_points()[*point];
        let gap = [f64::NAN; 4];
        let mut rows = vec![gap; take.take_frame_count()];
        let mut marker_report = RestoredMarker {
            name: source.name.clone(),
            frames: 0,
            sd_mm: 0.0,
            most_sd_mm: 0.0,
        };
        for (frame, row) in rows.iter_mut().enumerate() {
            let seen = source
                .marker_position(frame)
                .map(|at| space.displayed_position(at) * 1000.0);
            let model = predicted(frame).and_then(|(points, sd)| Some((*points.get(marker)?, *sd.get(marker)?)));
            match (seen, model) {
                (Some(seen), Some((predicted, _))) => {
                    sum += seen.distance(predicted);
                    axes += (seen - predicted).abs().element_sum() / 3.0;
                    count += 1.0;
                }
                (None, Some((predicted, sd))) if predicted.is_finite() => {
                    report.hidden += 1;
                    report.restored += 1;
                    // The deviation along one axis becomes that in the room, of three equal axes.
                    let sd = sd * 3f64.sqrt();
                    report.uncertain += u64::from(sd > UNCERTAIN_POSITION_DEVIATION_MM);
                    marker_report.frames += 1;
                    marker_report.sd_mm += sd;
                    marker_report.most_sd_mm = marker_report.most_sd_mm.max(sd);
                    *row = [predicted.x, predicted.y, predicted.z, sd].map(|x| round_to_decimals(x, 3));
                }
                (None, _) => report.hidden += 1,
                _ => {}
            }
        }
        if marker_report.frames == 0 {
            continue;
        }
        marker_report.sd_mm = round_to_decimals(marker_report.sd_mm / marker_report.frames as f64, 2);
        marker_report.most_sd_mm = round_to_decimals(marker_report.most_sd_mm, 2);
        report.markers.push(marker_report);
        let column = |k: usize| FrameNumberColumn::from_double_floats(rows.iter().map(|row| row[k]).collect());
        new.push(MotionMarker {
            group: source.group.clone(),
            name: source.name.clone(),
            place: (0..3).map(column).collect(),
            quality: Some(column(3)),
        });
    }
    let mean = |sum: f64| (count > 0.0).then(|| sum / count);
    (mean(sum), mean(axes))
}
