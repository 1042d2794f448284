//! Hidden markers restored from models of hand and face, as a track of their own.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use chereme_analysis::cue::face::FaceModel;
use chereme_analysis::cue::hand::{HandModel, Restored};
use chereme_analysis::cue::rigid::Rigid;
use chereme_motion::column::Column;
use chereme_motion::glam::DVec3;
use chereme_motion::markers::{Marker, Quality};
use chereme_motion::{Capture, Convention, Markers, Space};
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use super::capture::{RESTORED, Take, take, takes};
use super::{CuedOptions, rounded};
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::recordings::RecordingRow;
use crate::db::tracks::{self, TrackKind};
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};
use crate::track::{NewTrack, Track, store};
use crate::words::effect::OperationEffect;

/// Settings for restoring hidden markers: the takes to learn from, and the size of the model.
#[derive(Debug, Clone)]
pub struct RestoreOptions {
    /// The recordings from which the models learn; without names takes of the hand alone and of the face alone,
    /// otherwise all takes.
    pub train: Vec<Name>,
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
const UNCERTAIN: f64 = 8.0;
/// The mean distance of visible markers from the model above which a finding warns, in millimetres.
const FAR: f64 = 6.0;
/// The number of frames after which no further take is loaded to be restored at the same time.
const TOGETHER: usize = 100_000;
/// The largest number of frames from which a model learns.
const MOST_LEARNED: usize = 10_000;

/// A frame in the model of the face: the head's motion, and the position and predicted error of each marker.
type FaceRow = (Rigid, Vec<DVec3>, Vec<f64>);

/// The report on a take, and the track of restored markers if there are any.
type Restoration = (RestoredTake, Option<NewTrack>);

struct Models {
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
        recordings: &[Name],
        options: &RestoreOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<RestoredTake>> {
        if !(1..=25).contains(&options.components) {
            return Err(Error::wrong(format!("{} components", options.components))
                .advise("a hand has from 1 to 25; the founding paper keeps 12"));
        }
        let connection = self.store.read();
        let (models, rows) = models(connection, options, progress)?;
        let mut done = Vec::new();
        let mut new = Vec::new();
        let named: Vec<RecordingRow> = match (recordings, options.train.as_slice()) {
            ([], []) => rows,
            ([], _) => {
                let all = takes(connection, &[], &options.cued)?;
                all.into_iter().map(|it| it.row).collect()
            }
            _ => {
                let rows = recordings
                    .iter()
                    .map(|name| address::recording(connection, name));
                rows.collect::<Result<_>>()?
            }
        };
        let mut ahead = named.into_iter().peekable();
        let mut counted = Counted::default();
        while ahead.peek().is_some() {
            let mut together: Vec<Take> = Vec::new();
            let mut frames = 0;
            while together.len() < cores() && frames < TOGETHER {
                let Some(row) = ahead.next() else { break };
                let take = take(connection, row, &options.cued)?;
                frames += take.frames();
                together.push(take);
            }
            for (take, result) in together
                .iter()
                .zip(counted.all(&together, &models, progress)?)
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
            places: done.iter().map(|it| it.restored).sum(),
            recordings: done.len() as u64,
        };
        let names = self.store.operation(|connection| {
            let mut names = Vec::new();
            for (recording, track) in &new {
                let Some(track) = track else {
                    names.push(None);
                    continue;
                };
                if let Some(old) =
                    tracks::named(connection, *recording, TrackKind::Markers, RESTORED)?
                {
                    tracks::remove(connection, old)?;
                }
                let id = store::store(connection, *recording, track)?;
                names.push(Some(tracks::track(connection, id)?.name));
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
    progress: &mut Progress<'_>,
) -> Result<(Models, Vec<RecordingRow>)> {
    let all = takes(connection, &options.train, &options.cued)?;
    let alone = |of: fn(&Take) -> bool, other: fn(&Take) -> bool| -> Vec<&Take> {
        let own: Vec<&Take> = all.iter().filter(|take| of(take)).collect();
        let alone: Vec<&Take> = own.iter().copied().filter(|take| !other(take)).collect();
        if options.train.is_empty() && !alone.is_empty() {
            alone
        } else {
            own
        }
    };
    let hands = alone(Take::has_hand, Take::has_face);
    let faces = alone(Take::has_face, Take::has_hand);
    let names = |of: &[&Take]| of.iter().map(|take| take.row.name.clone()).collect();
    let mut findings = Vec::new();
    let mut learn = |task: &'static str, done: u64| {
        progress.report(Step {
            task,
            done,
            total: Some(2),
            unit: Unit::Items,
        })
    };
    learn("the model of the hand", 0)?;
    let hand = match thinned(&hands, |take| &take.hand_points) {
        frames if frames.is_empty() => None,
        frames => match HandModel::learn(&frames, options.components) {
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
        frames => match FaceModel::learn(&frames) {
            Ok(model) => Some((model, names(&faces))),
            Err(error) => {
                findings.push(format!("there is no model of the face: {error}"));
                None
            }
        },
    };
    if hand.is_none() && face.is_none() {
        return Err(Error::wrong(findings.join("; "))
            .advise(Remedy::command("name with --train recordings that show every marker, of the hand alone or the face alone")));
    }
    let models = Models {
        hand,
        face,
        findings,
    };
    Ok((models, all.into_iter().map(|take| take.row).collect()))
}

/// Returns captured frames of takes in which something is visible, evenly thinned.
fn thinned(takes: &[&Take], points: fn(&Take) -> &[Option<usize>]) -> Vec<Vec<Option<DVec3>>> {
    let all: usize = takes.iter().map(|take| take.frames()).sum();
    let step = all.div_ceil(MOST_LEARNED).max(1);
    let mut some = Vec::new();
    for take in takes {
        let frames = (0..take.frames()).step_by(step);
        let frames = frames.map(|frame| captured(take, points(take), frame));
        some.extend(frames.filter(|frame| frame.iter().any(Option::is_some)));
    }
    some
}

/// Returns the number of takes that are restored at the same time.
fn cores() -> usize {
    thread::available_parallelism()
        .map_or(1, usize::from)
        .min(8)
}

/// Frames restored so far.
#[derive(Default)]
struct Counted {
    frames: AtomicU64,
    stopped: AtomicBool,
}

impl Counted {
    /// Restores takes at the same time, each by a thread of its own, and reports the progress from this one.
    fn all(
        &mut self,
        takes: &[Take],
        models: &Models,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<Result<Restoration>>> {
        const PAUSE: Duration = Duration::from_millis(20);
        let counted = &*self;
        thread::scope(|scope| {
            let running: Vec<_> = takes
                .iter()
                .map(|take| scope.spawn(move || restored(take, models, counted)))
                .collect();
            while running.iter().any(|it| !it.is_finished()) {
                let step = Step {
                    task: "restoring markers",
                    done: counted.frames.load(Ordering::Relaxed),
                    total: None,
                    unit: Unit::Frames,
                };
                if let Err(stopped) = progress.report(step) {
                    counted.stopped.store(true, Ordering::Relaxed);
                    return Err(stopped);
                }
                thread::sleep(PAUSE);
            }
            let lost = || Err(Error::wrong("a take could not be restored"));
            let done = running.into_iter();
            Ok(done
                .map(|it| it.join().unwrap_or_else(|_| lost()))
                .collect())
        })
    }
}

fn restored(take: &Take, models: &Models, counted: &Counted) -> Result<Restoration> {
    let mut hand_rows: Vec<Option<Restored>> = Vec::new();
    let mut face_rows: Vec<Option<FaceRow>> = Vec::new();
    let mut before: Option<Restored> = None;
    for frame in 0..take.frames() {
        if frame % 64 == 0 && counted.stopped.load(Ordering::Relaxed) {
            return Err(Error::Stopped);
        }
        counted.frames.fetch_add(1, Ordering::Relaxed);
        if let Some((model, _)) = &models.hand {
            let own = model.restore(&captured(take, &take.hand_points, frame), before.as_ref());
            before.clone_from(&own);
            hand_rows.push(own);
        }
        if let Some((model, _)) = &models.face {
            face_rows.push(model.restore(&captured(take, &take.face_points, frame)));
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
        hand_from: models.hand.as_ref().map_or(Vec::new(), |it| it.1.clone()),
        explained: models.hand.as_ref().map(|it| rounded(it.0.explained(), 4)),
        face_from: models.face.as_ref().map_or(Vec::new(), |it| it.1.clone()),
        frames: take.frames() as u64,
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
    let (hand_mm, axis_mm) = set(
        take,
        &take.hand_points,
        &hand_of,
        (&mut report, &mut points),
    );
    let (face_mm, _) = set(
        take,
        &take.face_points,
        &face_of,
        (&mut report, &mut points),
    );
    report.hand_mm = hand_mm.map(|it| rounded(it, 2));
    report.hand_axis_mm = axis_mm.map(|it| rounded(it, 2));
    report.face_mm = face_mm.map(|it| rounded(it, 2));
    for (part, mm) in [("hand", hand_mm), ("face", face_mm)] {
        if let Some(mm) = mm.filter(|mm| *mm > FAR) {
            report.findings.push(format!(
                "the visible markers of the {part} are {mm:.1} mm from the model on average, so restored ones are not to be \
                 trusted; check the labels and the axes of this recording, or train on takes of the same person"
            ));
        }
    }
    if points.is_empty() {
        return Ok((report, None));
    }
    let space = Space::World(Convention {
        metres_per_unit: 0.001,
        ..Convention::MODEL
    });
    let fault = |error: chereme_motion::TrackError| Error::wrong(error.to_string());
    let markers = Markers::new(take.markers.times().clone(), space, points)
        .map_err(fault)?
        .captured(Capture::Estimated)
        .rated(Quality::Residual);
    let track = NewTrack {
        offset_us: take.track.offset_us,
        ..NewTrack::new(RESTORED, Track::Markers(markers))
    };
    Ok((report, Some(track)))
}

/// Returns a frame as captured, without positions that were restored earlier.
fn captured(take: &Take, points: &[Option<usize>], frame: usize) -> Vec<Option<DVec3>> {
    let space = take.markers.space();
    points
        .iter()
        .map(|point| {
            let at = take.markers.points()[(*point)?].at(frame)?;
            Some(space.shown(at) * 1000.0).filter(|at| at.is_finite())
        })
        .collect()
}

/// Adds the restored positions of a set of markers; returns the mean distance of its visible markers from the model,
/// and the mean distance along one axis.
fn set<'a>(
    take: &Take,
    points: &[Option<usize>],
    predicted: &dyn Fn(usize) -> Option<(&'a [DVec3], &'a [f64])>,
    (report, new): (&mut RestoredTake, &mut Vec<Marker>),
) -> (Option<f64>, Option<f64>) {
    let (mut sum, mut axes, mut count) = (0.0, 0.0, 0.0);
    let space = take.markers.space();
    for (marker, point) in points.iter().enumerate() {
        let Some(point) = point else { continue };
        let source = &take.markers.points()[*point];
        let gap = [f64::NAN; 4];
        let mut rows = vec![gap; take.frames()];
        let mut own = RestoredMarker {
            name: source.name.clone(),
            frames: 0,
            sd_mm: 0.0,
            most_sd_mm: 0.0,
        };
        for (frame, row) in rows.iter_mut().enumerate() {
            let seen = source.at(frame).map(|at| space.shown(at) * 1000.0);
            let model = predicted(frame)
                .and_then(|(points, sd)| Some((*points.get(marker)?, *sd.get(marker)?)));
            match (seen, model) {
                (Some(seen), Some((predicted, _))) => {
                    sum += seen.distance(predicted);
                    axes += (seen - predicted).abs().element_sum() / 3.0;
                    count += 1.0;
                }
                (None, Some((predicted, sd))) if predicted.is_finite() => {
                    report.hidden += 1;
                    report.restored += 1;
                    let sd = sd * 3f64.sqrt();
                    report.uncertain += u64::from(sd > UNCERTAIN);
                    own.frames += 1;
                    own.sd_mm += sd;
                    own.most_sd_mm = own.most_sd_mm.max(sd);
                    *row = [predicted.x, predicted.y, predicted.z, sd].map(|x| rounded(x, 3));
                }
                (None, _) => report.hidden += 1,
                _ => {}
            }
        }
        if own.frames == 0 {
            continue;
        }
        own.sd_mm = rounded(own.sd_mm / own.frames as f64, 2);
        own.most_sd_mm = rounded(own.most_sd_mm, 2);
        report.markers.push(own);
        let column = |k: usize| Column::doubles(rows.iter().map(|row| row[k]).collect());
        new.push(Marker {
            group: source.group.clone(),
            name: source.name.clone(),
            place: (0..3).map(column).collect(),
            quality: Some(column(3)),
        });
    }
    let mean = |sum: f64| (count > 0.0).then(|| sum / count);
    (mean(sum), mean(axes))
}
