//! Fits a skeleton to the markers of a recording; runs only on command.

use std::sync::Arc;

use chereme_motion::fit::{FitError, FittedSkeleton, fit_skeleton, people_of_markers};
use chereme_motion::{
    BodyAnatomy, BodySide, CurveTrack, FrameNumberColumn, FrameTimes, RecordingInstant, ScalarCurve, Skeleton,
    SpaceConvention, TimeSpan,
};
use chereme_sign::ErrorRemedy;
use rusqlite::Connection;
use serde::Serialize;

use super::{NewTrack, SkeletonTrack, TrackContent, TrackKind, TrackRow, track_read, track_store};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::{stored_recordings, stored_tracks};
use crate::error::{CorpusError, CorpusResult};
use crate::movement;
use crate::starter::built_in_body;
use crate::words::effect::OperationEffect;

/// The largest median distance between markers and a usable skeleton, in metres; a larger one gives a warning.
const MAX_MARKER_DISTANCE_METRES: f64 = 0.02;
/// The least share of frames in which the markers of a usable result are seen; a smaller one gives a warning.
const MIN_MARKERS_SEEN_SHARE: f64 = 0.6;

/// The name of the track from which a recording's signs are read if it has one.
const BODY_TRACK_NAME: &str = "body";
/// The statures of signers in metres, children included; another gives a warning.
const SIGNER_STATURES_METRES: [f64; 2] = [0.7, 2.4];

/// Options of a fit.
#[derive(Debug, Clone, Copy, Default)]
pub struct FitOptions<'a> {
    /// The track of markers; the first one if it is not given.
    pub track: Option<&'a str>,
    /// The recording whose skeleton is fitted; without it the program's own body.
    pub to: Option<&'a RowName>,
    /// The person whose markers are used, such as `Anna` for `Anna:LSHO`; needed if they are those of several people.
    pub subject: Option<&'a str>,
    /// Whether nothing is stored.
    pub dry_run: bool,
}

/// A skeleton that was fitted to markers.
#[derive(Debug, Clone, Serialize)]
pub struct FitReport {
    /// The track of markers.
    pub markers: String,
    /// The person whose markers were used, if one was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The name of the new track with the movement; nothing if nothing was stored.
    pub track: Option<String>,
    /// The size of the fitted skeleton relative to the given one.
    pub scale: f64,
    /// The number of fitted frames.
    pub frames: usize,
    /// The number of frames with too few markers, which repeat the posture before them.
    pub held: usize,
    /// The median of the markers' median distances, in millimetres.
    pub median_mm: f64,
    /// The distance of each marker from its place on the fitted skeleton.
    pub residuals: Vec<FitResidual>,
    /// Labels of markers that belong to no known bone.
    pub unused: Vec<String>,
    /// Warnings about the result.
    pub findings: Vec<String>,
}

/// The distance of a marker from its place on the fitted skeleton.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitResidual {
    /// The marker's label.
    pub marker: String,
    /// The joint whose bone it is on.
    pub joint: String,
    /// The median distance in millimetres.
    pub median_mm: f64,
    /// The 95th percentile of the distance, in millimetres.
    pub most_mm: f64,
    /// The share of frames in which the marker is seen.
    pub seen: f64,
}

impl Corpus {
    /// Returns the people to whom the markers of a recording belong if they are those of several;
    /// [`fit_markers`](Self::fit_markers) needs the name of one of them then. None if they are those of one person.
    ///
    /// # Errors
    /// Fails if there is no such recording or track of markers.
    pub fn marker_people(&self, recording: &RowName, track: Option<&str>) -> CorpusResult<Vec<String>> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let markers = choose_marker_track(connection, &row.name, row.id, track)?;
        // The names are in every piece of the track.
        let begin = RecordingInstant::from_micros(markers.offset_us);
        let piece = TimeSpan::span_between(begin, begin);
        let points = track_read::read_track_markers(connection, &markers, Some(piece))?;
        Ok(people_of_markers(&points))
    }

    /// Fits a skeleton to a recording's markers: that of another recording, or the program's own body.
    ///
    /// The movement becomes a track `body` of the recording (another name if it has one), and the distance of every
    /// marker in every frame a track of curves, `fit residual`, whose names keep the person's; the markers stay. A dry run
    /// stores nothing.
    ///
    /// # Errors
    /// Fails if there is no such recording or track of markers, the points have no place in a room, are those of several
    /// people and none of them is named, too few labels are known, or the skeleton is not a body's.
    pub fn fit_markers(&mut self, recording: &RowName, options: &FitOptions<'_>) -> CorpusResult<FitReport> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let markers = choose_marker_track(connection, &row.name, row.id, options.track)?;
        let (skeleton, anatomy) = fit_target_skeleton(connection, options.to)?;
        let points = track_read::read_track_markers(connection, &markers, None)?;
        let fitted = fit_skeleton(&points, &skeleton, &anatomy, options.subject).map_err(|error| {
            CorpusError::from_wrong_message(error.to_string())
                .with_error_place(&row.name)
                .with_advice(fit_error_remedy(&error))
        })?;
        let mut report = marker_fit_report(&markers.name, options.subject, &fitted);
        let present_track = stored_recordings::body_track(connection, row.id)?;
        // The fit can be stored all the same, but under another name, and signs are not read from it.
        if present_track.is_some_and(|known| known.name == BODY_TRACK_NAME) {
            report.findings.push(
                "the recording has a body already, from which signs are read; import the file again as a recording of \
                 its own for another person"
                    .to_owned(),
            );
        }
        if options.dry_run {
            return Ok(report);
        }
        let new = new_tracks(&fitted, markers.offset_us)?;
        let names = self.store.run_store_operation(|connection| {
            let mut names = Vec::new();
            for track in &new {
                let id = track_store::store_new_track(connection, row.id, track)?;
                names.push(stored_tracks::load_track_row(connection, id)?.name);
            }
            let effect = OperationEffect::FitMarkers {
                recording: row.name.clone(),
                markers: markers.name.clone(),
                subject: options.subject.map(ToString::to_string),
                millimetres: report.median_mm.round() as u64,
            };
            Ok((names, effect))
        })?;
        report.track = names.into_iter().next();
        Ok(report)
    }
}

fn fit_error_remedy(error: &FitError) -> ErrorRemedy {
    match error {
        FitError::People(people) | FitError::Subject { known: people, .. } if !people.is_empty() => {
            let name = people.first().map_or("", String::as_str);
            ErrorRemedy::command_remedy(format!("name one of them: --subject {name:?}"))
        }
        _ => "markers are known by labels such as LSHO, RWRA, C7 or R.Elbow; rename them in the file".into(),
    }
}

fn choose_marker_track(
    connection: &Connection,
    recording: &str,
    id: i64,
    track: Option<&str>,
) -> CorpusResult<TrackRow> {
    let all = stored_tracks::load_track_rows(connection, id)?;
    let asked_track = match track {
        Some(name) => Some(super::track_change::find_track_named(&all, recording, name)?),
        None => all.iter().find(|row| row.kind == TrackKind::Markers),
    };
    let marker_track = asked_track.filter(|row| row.kind == TrackKind::Markers);
    marker_track.cloned().ok_or_else(|| {
        CorpusError::from_wrong_message(format!("{recording:?} has no track of markers"))
            .with_error_place(recording)
            .with_command_advice("import a .c3d or .trc file into it: chereme import CORPUS FILE --into recording:3")
    })
}

/// Returns a skeleton in metres and model space.
fn fit_target_skeleton(connection: &Connection, to: Option<&RowName>) -> CorpusResult<(Arc<Skeleton>, BodyAnatomy)> {
    let Some(name) = to else {
        let (clip, anatomy) = built_in_body()?;
        return Ok((clip.clip_skeleton().clone(), anatomy.as_ref().clone()));
    };
    let row = address::find_recording_by_name(connection, name)?;
    stored_recordings::body_track(connection, row.id)?.ok_or_else(|| {
        CorpusError::from_wrong_message(format!("{:?} has no skeleton", row.name))
            .with_error_place(&row.name)
            .with_command_advice("name a recording of movement, or leave --to out for the program's own body")
    })?;
    let track = movement::MotionTrack::open_motion_track(connection, row.id)?;
    let clip = track.read_motion_clip(connection, 0..1, &movement::ChannelGroup::ALL_CHANNEL_GROUPS)?;
    Ok((clip.clip_skeleton().clone(), track.track_anatomy(connection)?))
}

fn new_tracks(fitted: &FittedSkeleton, offset_us: i64) -> CorpusResult<Vec<NewTrack>> {
    let curve = |marker: &chereme_motion::fit::FittedMarker| ScalarCurve {
        name: marker.name.clone(),
        unit: "mm".to_owned(),
        values: FrameNumberColumn::from_double_floats(
            marker.distances.iter().map(|distance| distance * 1000.0).collect(),
        ),
    };
    let distance_curves = fitted.markers.iter().map(curve).collect();
    let curves = CurveTrack::new(FrameTimes::Even(fitted.clip.clip_frame_rate()), distance_curves)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let body = SkeletonTrack {
        clip: fitted.clip.clone(),
        convention: SpaceConvention::MODEL_CONVENTION,
        roles: None,
    };
    let track = |name: &str, track| NewTrack {
        offset_us,
        ..NewTrack::new(name, track)
    };
    Ok(vec![
        track(BODY_TRACK_NAME, TrackContent::Skeleton(body)),
        track("fit residual", TrackContent::Curves(curves)),
    ])
}

fn marker_fit_report(markers: &str, subject: Option<&str>, fitted: &FittedSkeleton) -> FitReport {
    let mm = |metres: f64| (metres * 10_000.0).round() / 10.0;
    let skeleton = fitted.clip.clip_skeleton();
    let seen = fitted.markers.iter().map(|marker| marker.seen).sum::<f64>() / fitted.markers.len().max(1) as f64;
    let mut findings = Vec::new();
    if fitted.median_marker_distance() > MAX_MARKER_DISTANCE_METRES || seen < MIN_MARKERS_SEEN_SHARE {
        findings.push(format!(
            "this is no capture of a skeleton: markers are {:.0} mm from it in the median and seen in {:.0} % of the \
             frames; a good fit is below {:.0} mm and above {:.0} %",
            fitted.median_marker_distance() * 1000.0,
            seen * 100.0,
            MAX_MARKER_DISTANCE_METRES * 1000.0,
            MIN_MARKERS_SEEN_SHARE * 100.0
        ));
    }
    if let Some(subject) = subject.filter(|_| fitted.others > 0) {
        findings.push(format!(
            "markers that are not of {subject:?} and are left out: {}",
            fitted.others
        ));
    }
    if fitted.held > 0 {
        findings.push(format!(
            "frames with too few markers, in which the posture before is held: {}",
            fitted.held
        ));
    }
    if !(SIGNER_STATURES_METRES[0]..=SIGNER_STATURES_METRES[1]).contains(&fitted.stature) {
        findings.push(format!(
            "the body of the markers is {:.3} m tall; if that is wrong, import the file again with \
             its unit",
            fitted.stature
        ));
    }
    for side in &fitted.unturned {
        let letter = if *side == BodySide::Left { 'L' } else { 'R' };
        findings.push(format!(
            "the turn of the {} forearm and palm about the forearm is a guess, as no pair of markers on the sides of \
             thumb and little finger shows it; call them {letter}WRA and {letter}WRB",
            side.body_side_name()
        ));
    }
    findings.push(
        "no marker is on the fingers, which stay at rest: handshapes read from this track are not the signer's"
            .to_owned(),
    );
    FitReport {
        markers: markers.to_owned(),
        subject: subject.map(str::to_owned),
        track: None,
        scale: (fitted.scale * 1000.0).round() / 1000.0,
        frames: fitted.clip.clip_frame_count(),
        held: fitted.held,
        median_mm: mm(fitted.median_marker_distance()),
        residuals: fitted
            .markers
            .iter()
            .map(|marker| FitResidual {
                marker: marker.name.clone(),
                joint: skeleton.joint_at(marker.joint).name.clone(),
                median_mm: mm(marker.median),
                most_mm: mm(marker.most),
                seen: (marker.seen * 1000.0).round() / 1000.0,
            })
            .collect(),
        unused: fitted.unused.clone(),
        findings,
    }
}
