//! Stores the tracks of a file in the recording that they belong to.

use super::import_joining::{FileJoining, JoinReason};
use super::understood::TrackRead;
use super::{FileReport, ImportJob, import_bvh, import_clock};
use crate::db::stored_recordings;
use crate::db::stored_tracks;
use crate::error::CorpusResult;
use crate::movement::{self, BLOCK_FRAMES};
use crate::report_finding::ReportFinding;
use crate::track::{NewTrack, TrackContent, track_store};
use chereme_motion::{
    BodyAnatomy, Clip, FrameNumberColumn, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker,
    RecordingInstant, Skeleton, SpaceConvention,
};
use chereme_sign::ErrorRemedy;

/// Stores the tracks of a file and returns their recording: the one that the caller named, the one of the files with
/// this folder and stem, or a new one. Adds a line for each track to the report, and the caller's offset to each track.
///
/// The reader stores the file itself ([`ImportJob::keep_source_file`]) and reports its oddities.
pub(super) fn store_imported_tracks(
    job: &mut ImportJob<'_>,
    new: Vec<NewTrack>,
    report: &mut FileReport,
) -> CorpusResult<i64> {
    // A named recording counts more than files that lie beside this one.
    let same_take = job.find_sibling_recording().filter(|_| job.options.into.is_none());
    let given = job.options.clock.map(RecordingInstant::instant_micros);
    let day = |track: &NewTrack| {
        let start = track.clock_us.or(given)?;
        Some(start..start.saturating_add(length_us(&track.track)))
    };
    let days: Vec<_> = new.iter().filter_map(day).collect();
    let joined = match same_take {
        Some(recording) => Some((recording, JoinReason::FolderAndName)),
        None => match import_clock::find_take_by_timecode(job, &days, report)? {
            Some(recording) => Some((recording, JoinReason::Timecode)),
            None => folder_take(job, &new)?.map(|recording| (recording, JoinReason::OnlyInFolder)),
        },
    };
    let recording = match joined {
        Some((recording, reason)) => {
            job.note_file_join(recording, reason);
            // This join rests on the weakest evidence, so the user reads how to undo it.
            if reason == JoinReason::OnlyInFolder {
                report_folder(job, recording, report)?;
            }
            describe_joined_recording(job, recording, report)?;
            recording
        }
        None => {
            let lengths = new.iter().map(|track| length_us(&track.track));
            import_bvh::insert_recording(job, lengths.max(), report)?
        }
    };
    for track in &new {
        report.findings.extend(curve_gaps_finding(&track.track));
    }
    let mut ids = Vec::with_capacity(new.len());
    for mut track in new {
        track.offset_us = track.offset_us.saturating_add(job.options.offset_us);
        // A timecode in the file is exact, while the option is one time for all files.
        track.clock_us = track.clock_us.or(given);
        ids.push(track_store::store_new_track(job.connection, recording, &track)?);
    }
    import_clock::align_tracks_by_clock(job, recording, &ids, report)?;
    job.count_created_rows("tracks", ids.len());
    let shown = |id: &i64| -> CorpusResult<TrackRead> {
        let (row, form) = (
            stored_tracks::load_track_row(job.connection, *id)?,
            stored_tracks::load_track_form(job.connection, *id)?,
        );
        Ok(TrackRead {
            kind: row.kind,
            name: row.name,
            rate: row.rate.map(chereme_motion::FrameRate::per_second),
            frames: row.frames,
            offset_us: row.offset_us,
            duration_us: row.duration_us,
            channels: row.channels,
            metres_per_unit: form.metres_per_unit,
            axes: form.axes,
        })
    };
    report.recording = Some(stored_recordings::load_recording_row(job.connection, recording)?.name);
    report.understood.tracks = Some(ids.iter().map(shown).collect::<CorpusResult<_>>()?);
    Ok(recording)
}

/// Gives a joined recording the signer, origin and licence that the caller states; another signer than its own is
/// reported instead.
fn describe_joined_recording(job: &mut ImportJob<'_>, recording: i64, report: &mut FileReport) -> CorpusResult<()> {
    let options = job.options;
    let row = stored_recordings::load_recording_row(job.connection, recording)?;
    let signer = match (&options.signer, &row.signer) {
        (Some(name), Some(theirs)) if name != theirs => {
            report.findings.push(ReportFinding::finding_warning(
                format!(
                    "the recording {:?} is of the signer {theirs:?}, who stays its signer, not {name:?}",
                    row.name
                ),
                ErrorRemedy::command_remedy(
                    "if the file is of another person: `chereme undo`, and another name for the file",
                ),
            ));
            // The recording keeps its signer, since its other files are of that person.
            None
        }
        (Some(name), None) => {
            let is_new = stored_recordings::find_signer(job.connection, name)?.is_none();
            job.count_created_rows("signers", usize::from(is_new));
            let hand = options.handedness.as_deref();
            Some(stored_recordings::signer_named(job.connection, name, hand)?)
        }
        _ => None,
    };
    let licence = options.licence.as_deref();
    stored_recordings::set_recording_description(job.connection, recording, signer, options.origin, licence)
}

/// Returns a finding about the gaps between rows of curves; `None` without any.
fn curve_gaps_finding(track: &TrackContent) -> Option<ReportFinding> {
    let TrackContent::Curves(curves) = track else {
        return None;
    };
    let gaps = curves.curve_times().frame_time_gaps(curves.curve_frame_count());
    let longest = gaps.iter().max_by_key(|gap| gap.span_micros())?;
    let total = gaps.iter().map(|gap| gap.span_seconds()).sum::<f64>();
    Some(ReportFinding::finding_warning(
        format!(
            "gaps in its rows: {}, {total:.3} s in all, the longest after {:.3} s; nothing counts as measured there",
            gaps.len(),
            longest.span_start_instant().instant_seconds()
        ),
        "export it again if the gaps are not in the recording itself",
    ))
}

/// The largest ratio of lengths of two tracks that are taken for one take without the same name.
const MAX_TAKE_LENGTH_RATIO: i64 = 2;

/// Returns the recording of the only motion file in the folder, if its length is similar to that of the tracks.
fn folder_take(job: &ImportJob<'_>, new: &[NewTrack]) -> CorpusResult<Option<i64>> {
    let is_asked = job.options.into.is_none() && job.options.joining != FileJoining::None;
    let Some(recording) = job.folder_take.filter(|_| is_asked) else {
        return Ok(None);
    };
    if job.is_other_signer(recording)? {
        return Ok(None);
    }
    let longest = new.iter().map(|track| length_us(&track.track)).max();
    let new_length = longest.unwrap_or_default();
    let theirs = stored_recordings::load_recording_row(job.connection, recording)?.duration_us;
    // A file of quite another length hardly shows the same take.
    Ok(Some(recording).filter(|_| are_take_lengths(new_length, theirs)))
}

/// Returns whether two lengths may be those of one take.
pub(super) fn are_take_lengths(own: i64, theirs: i64) -> bool {
    own <= theirs.saturating_mul(MAX_TAKE_LENGTH_RATIO) && theirs <= own.saturating_mul(MAX_TAKE_LENGTH_RATIO)
}

/// Reports that a file was assigned to the take of its folder.
fn report_folder(job: &ImportJob<'_>, recording: i64, report: &mut FileReport) -> CorpusResult<()> {
    let name = stored_recordings::load_recording_row(job.connection, recording)?.name;
    report.findings.push(ReportFinding {
        remedy: Some(ErrorRemedy::command_remedy(
            "if they are of two takes: `chereme undo`, and import each file by its name",
        )),
        ..ReportFinding::finding_note(format!(
            "it is the only file of its kind next to one of movement: it is taken for the take {name:?}"
        ))
    });
    Ok(())
}

/// Returns the length of a track in microseconds.
fn length_us(track: &TrackContent) -> i64 {
    match track {
        TrackContent::Skeleton(skeleton) => skeleton
            .clip
            .clip_frame_rate()
            .frame_start_instant(skeleton.clip.clip_frame_count())
            .instant_micros(),
        TrackContent::Markers(markers) => markers.marker_track_span().span_end_instant().instant_micros(),
        TrackContent::Curves(curves) => curves
            .curve_times()
            .frame_times_span(curves.curve_frame_count())
            .span_end_instant()
            .instant_micros(),
        TrackContent::Media(_) => 0,
    }
}

/// Stores the optical markers among the skeleton's leaf joints as a track of points, and returns that.
pub(super) fn store_leaf_markers(
    job: &ImportJob<'_>,
    track: i64,
    offset_us: i64,
    anatomy: &BodyAnatomy,
    report: &mut FileReport,
) -> CorpusResult<Option<i64>> {
    if anatomy.marker_joints().is_empty() {
        return Ok(None);
    }
    let stored = movement::MotionTrack::of_row(job.connection, track)?;
    let frames = stored.motion_frame_count();
    let head = stored.raw_clip(job.connection, 0..1)?;
    let mut companion = SkeletonMarkers::markers_of_anatomy(head.clip_skeleton(), anatomy);
    if !companion.fits_marker_limit(frames) {
        report.findings.push(ReportFinding::finding_warning(
            "the markers beside the skeleton are too many to be kept as a track of points; they stay its joints",
            "cut the take into shorter files",
        ));
        return Ok(None);
    }
    // A long take is read in parts, so that it never lies in memory whole.
    for start in (0..frames).step_by(8 * BLOCK_FRAMES) {
        let part = start..(start + 8 * BLOCK_FRAMES).min(frames);
        companion.push_clip_frames(&stored.raw_clip(job.connection, part)?);
    }
    let Some(markers) = companion.into_marker_track(stored.rate, stored.convention) else {
        return Ok(None);
    };
    let new = NewTrack {
        offset_us,
        ..NewTrack::new("markers", TrackContent::Markers(markers))
    };
    let id = track_store::store_new_track(job.connection, stored.row.recording_id, &new)?;
    Ok(Some(id))
}

/// The largest number of marker positions beside a skeleton that are stored as a track.
const MAX_BESIDE_MARKER_POSITIONS: usize = 12_000_000;

/// The optical markers beside a skeleton as points in the file's unit and axes.
pub(super) struct SkeletonMarkers {
    joints: Vec<usize>,
    names: Vec<String>,
    places: Vec<[Vec<f64>; 3]>,
}

impl SkeletonMarkers {
    /// Creates an empty collection for the markers of an anatomy.
    pub(super) fn markers_of_anatomy(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Self {
        let joints = anatomy.marker_joints().to_vec();
        let name = |&joint: &usize| skeleton.joint_at(joint).name.clone();
        Self {
            names: joints.iter().map(name).collect(),
            places: joints.iter().map(|_| Default::default()).collect(),
            joints,
        }
    }

    /// Returns whether there are markers, and few enough positions of them in this number of frames.
    pub(super) fn fits_marker_limit(&self, frames: usize) -> bool {
        !self.joints.is_empty() && self.joints.len().saturating_mul(frames) <= MAX_BESIDE_MARKER_POSITIONS
    }

    /// Adds the frames that follow those added before.
    pub(super) fn push_clip_frames(&mut self, clip: &Clip) {
        for (&joint, places) in self.joints.iter().zip(&mut self.places) {
            for at in clip.joint_path(joint) {
                for (axis, values) in places.iter_mut().enumerate() {
                    values.push(at[axis]);
                }
            }
        }
    }

    /// Returns the track; nothing if there is no marker.
    pub(super) fn into_marker_track(self, rate: FrameRate, convention: SpaceConvention) -> Option<MarkerTrack> {
        let named_points = self.names.into_iter().zip(self.places);
        let points = named_points.map(|(name, places)| {
            MotionMarker::new(
                name,
                places.map(FrameNumberColumn::from_double_floats).into_iter().collect(),
            )
        });
        MarkerTrack::new(FrameTimes::Even(rate), MarkerSpace::World(convention), points.collect()).ok()
    }
}
