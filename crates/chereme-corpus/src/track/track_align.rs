//! Finds the position of one track on another track's clock from movement that both show.

use chereme_analysis::align::{self, TimedSignal as Samples};
use chereme_motion::anatomy::BodyPart;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, CurveTrack, MarkerTrack};
use rusqlite::Connection;
use serde::Serialize;

use super::track_change::find_track_named;
use super::{SkeletonTrack, TrackContent, TrackRow, track_read};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_tracks;
use crate::error::{CorpusError, CorpusResult};

/// The part of a track that is compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AlignmentSignal {
    /// The track's name.
    pub track: String,
    /// Names of joints, points or curves; by default the wrists, or every channel if no wrist is known.
    pub channels: Vec<String>,
}

/// The position of a track on the recording's clock, inferred from its movement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrackAlignment {
    /// The track that would be moved.
    pub track: String,
    /// The track that it is compared with.
    pub to: String,
    /// The compared channels of the two tracks.
    pub channels: [Vec<String>; 2],
    /// Its present offset on the recording's clock, in microseconds.
    pub offset_now_us: i64,
    /// The offset on the recording's clock at which the two speeds are most alike, in microseconds.
    pub offset_us: i64,
    /// The correlation of the two speeds at `offset_us`, at most 1.
    pub correlation: f64,
    /// The best correlation at any offset away from `offset_us`.
    pub runner_up: f64,
    /// Confidence in the offset, from 0 to 1; below 0.5 a person should look at both tracks before using it.
    pub confidence: f64,
}

impl Corpus {
    /// Finds the position of a track on the clock of another track of its recording: the offset at which their speeds,
    /// such as those of a wrist, are most alike. Changes nothing.
    ///
    /// `limit_us` is the largest distance from its present offset.
    ///
    /// # Errors
    /// Fails if there is no such track or channel, or the two share no movement.
    pub fn align_track(
        &self,
        recording: &RowName,
        track: &AlignmentSignal,
        to: &AlignmentSignal,
        limit_us: i64,
    ) -> CorpusResult<TrackAlignment> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let all = stored_tracks::load_track_rows(connection, row.id)?;
        let own_track = find_track_named(&all, &row.name, &track.track)?;
        let other = find_track_named(&all, &row.name, &to.track)?;
        let (moved, moved_names) = signal(connection, own_track, &track.channels)?;
        let (still, still_names) = signal(connection, other, &to.channels)?;
        let limit = limit_us as f64 / 1e6;
        let shift = align::find_signal_shift(&still, &moved, limit).ok_or_else(|| {
            CorpusError::from_wrong_message(format!(
                "{:?} and {:?} share no movement that could bring them together",
                own_track.name, other.name
            ))
            .with_error_place(&own_track.name)
            .with_advice("name a joint, point or curve that moves in both, or set the offset by hand")
        })?;
        Ok(TrackAlignment {
            track: own_track.name.clone(),
            to: other.name.clone(),
            channels: [moved_names, still_names],
            offset_now_us: own_track.offset_us,
            offset_us: own_track.offset_us + (shift.seconds * 1e6).round() as i64,
            correlation: shift.correlation,
            runner_up: shift.runner_up,
            confidence: shift.shift_confidence(),
        })
    }
}

/// Returns the mean speed of a track's channels over time on the recording's clock, and their names.
fn signal(connection: &Connection, row: &TrackRow, wanted: &[String]) -> CorpusResult<(Samples, Vec<String>)> {
    let (paths, names) = match track_read::read_stored_track(connection, row, None)? {
        TrackContent::Skeleton(skeleton) => of_skeleton(&skeleton, wanted)?,
        TrackContent::Markers(markers) => of_markers(&markers, wanted)?,
        TrackContent::Curves(curves) => of_curves(&curves, wanted)?,
        TrackContent::Media(_) => {
            return Err(
                CorpusError::from_wrong_message(format!("{:?} is a file of media", row.name))
                    .with_error_place(&row.name)
                    .with_advice("compare a track of points that were estimated from it"),
            );
        }
    };
    let mut points = Vec::new();
    for frame in 1..paths.times.len() {
        let (from, to) = (paths.times[frame - 1], paths.times[frame]);
        let speeds: Vec<f64> = paths
            .places
            .iter()
            .filter_map(|path| Some(path[frame]?.distance(path[frame - 1]?) / (to - from)))
            .collect();
        // Frames at the same time have no speed.
        if !speeds.is_empty() && to > from {
            let speed = speeds.iter().sum::<f64>() / speeds.len() as f64;
            points.push(((from + to) / 2.0 + row.offset_us as f64 / 1e6, speed));
        }
    }
    Ok((Samples { points }, names))
}

/// Positions by channel and frame, and the time of each frame.
struct ChannelPaths {
    times: Vec<f64>,
    places: Vec<Vec<Option<DVec3>>>,
}

fn unknown_channel_error(wanted: &str, names: &[String]) -> CorpusError {
    let nearest_name = chereme_sign::text::nearest_candidate(wanted, names.iter().map(String::as_str));
    let near = chereme_sign::text::did_you_mean(nearest_name);
    CorpusError::from_wrong_message(format!("the track has no {wanted:?}{near}"))
        .with_error_place(wanted)
        .with_command_advice("`chereme list CORPUS tracks` lists tracks; export one as .csv to see its channels")
}

/// Returns the indices of the wanted names; those of `usual` if none is wanted, or all.
fn choose_channel_indices(names: &[String], wanted: &[String], usual: Vec<usize>) -> CorpusResult<Vec<usize>> {
    if wanted.is_empty() {
        return Ok(if usual.is_empty() {
            (0..names.len()).collect()
        } else {
            usual
        });
    }
    let find = |name: &String| {
        let name_index = names.iter().position(|candidate| candidate.eq_ignore_ascii_case(name));
        name_index.ok_or_else(|| unknown_channel_error(name, names))
    };
    wanted.iter().map(find).collect()
}

fn of_skeleton(track: &SkeletonTrack, wanted: &[String]) -> CorpusResult<(ChannelPaths, Vec<String>)> {
    let clip = track.convention.file_clip_to_model(&track.clip);
    let joints = clip.clip_skeleton().skeleton_joints().iter();
    let names: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
    let roles = track.roles.clone().unwrap_or_default();
    // Without known wrists all joints are compared, so an unclear anatomy is no error.
    let anatomy = chereme_motion::BodyAnatomy::with_roles(clip.clip_skeleton(), &roles).ok();
    let wrists = anatomy.map(|anatomy| {
        let sides = BodySide::BOTH_SIDES.iter();
        sides
            .filter_map(|side| anatomy.part_joint(BodyPart::Hand(*side)))
            .collect()
    });
    let chosen = choose_channel_indices(&names, wanted, wrists.unwrap_or_default())?;
    let path = |joint: &usize| clip.joint_path(*joint).into_iter().map(Some).collect();
    let paths = ChannelPaths {
        times: (0..clip.clip_frame_count())
            .map(|n| clip.clip_frame_rate().frame_start_instant(n).instant_seconds())
            .collect(),
        places: chosen.iter().map(path).collect(),
    };
    Ok((paths, chosen.into_iter().map(|at| names[at].clone()).collect()))
}

fn of_markers(markers: &MarkerTrack, wanted: &[String]) -> CorpusResult<(ChannelPaths, Vec<String>)> {
    let points = markers.marker_points();
    let names: Vec<String> = points.iter().map(|point| point.name.clone()).collect();
    let wrists = (0..points.len()).filter(|&at| is_wrist(&names[at])).collect();
    let chosen = choose_channel_indices(&names, wanted, wrists)?;
    let frames = 0..markers.marker_frame_count();
    let place = |point: usize, frame: usize| {
        points[point]
            .marker_position(frame)
            .map(|at| markers.marker_space().displayed_position(at))
    };
    let paths = ChannelPaths {
        times: frames
            .clone()
            .map(|n| markers.marker_times().frame_time_instant(n).instant_seconds())
            .collect(),
        places: chosen
            .iter()
            .map(|&point| frames.clone().map(|frame| place(point, frame)).collect())
            .collect(),
    };
    Ok((paths, chosen.into_iter().map(|at| names[at].clone()).collect()))
}

/// Returns whether a point is a wrist by its name: `LWRA`, `TakeoMonday:RWRB`, `RIGHT_WRIST`, `R.Wrist`.
fn is_wrist(name: &str) -> bool {
    // Programs put the name of the person before a colon.
    let name = name.rsplit(':').next().unwrap_or(name).to_ascii_uppercase();
    let plug_in = ["LWRA", "LWRB", "RWRA", "RWRB", "LWRI", "RWRI"];
    name.contains("WRIST") || plug_in.contains(&name.as_str())
}

fn of_curves(curves: &CurveTrack, wanted: &[String]) -> CorpusResult<(ChannelPaths, Vec<String>)> {
    let all = curves.track_curves();
    let names: Vec<String> = all.iter().map(|curve| curve.name.clone()).collect();
    let chosen = choose_channel_indices(&names, wanted, Vec::new())?;
    let value = |at: &usize| {
        let values = all[*at].values.column_values();
        values
            .map(|value| value.map(|value| DVec3::new(value, 0.0, 0.0)))
            .collect()
    };
    let paths = ChannelPaths {
        times: (0..curves.curve_frame_count())
            .map(|n| curves.curve_times().frame_time_instant(n).instant_seconds())
            .collect(),
        places: chosen.iter().map(value).collect(),
    };
    Ok((paths, chosen.into_iter().map(|at| names[at].clone()).collect()))
}
