//! Applies the options of an import to a file that is in the corpus already: to its recording, and to its movement.

use std::collections::BTreeMap;

use chereme_motion::{BodyAnatomy, RecordingInstant, SpaceConvention};
use chereme_sign::ErrorRemedy;
use serde_json::json;

use super::{FileReport, FileStatus, ImportJob, ImportOptions, import_tracks as beside};
use crate::address;
use crate::db::edits;
use crate::db::stored_recordings::{self, MotionTrackRow};
use crate::db::stored_tracks::{self, TrackKind, TrackRow};
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::report_finding::ReportFinding;

/// The sign for something that was not stated before.
const NOT_STATED_SIGN: &str = "–";

impl ImportOptions {
    /// Returns whether the caller says how movement is to be read.
    pub(super) fn reads_movement(&self) -> bool {
        self.metres_per_unit.is_some() || self.axes.is_some() || self.roles.is_some() || self.mend_root
    }
}

/// Gives a recording the signer, dominant hand, origin and licence that the caller states, and reports what changed,
/// and which options have no effect on a file that the corpus has already.
pub(super) fn update_recording_description(
    job: &mut ImportJob<'_>,
    recording: i64,
    report: &mut FileReport,
) -> CorpusResult<()> {
    let options = job.options;
    let before = stored_recordings::load_recording_row(job.connection, recording)?;
    let mut after = before.clone();
    if let Some(name) = &options.signer {
        let new = stored_recordings::find_signer(job.connection, name)?.is_none();
        job.count_created_rows("signers", usize::from(new));
        let hand = options.handedness.as_deref();
        after.signer_id = Some(stored_recordings::signer_named(job.connection, name, hand)?);
        after.signer = Some(name.clone());
    }
    after.origin = options.origin.unwrap_or(before.origin);
    after.licence = options.licence.clone().or(after.licence);
    let finding_count = report.findings.len();
    let or_nothing = |text: &Option<String>| text.as_deref().unwrap_or(NOT_STATED_SIGN).to_owned();
    let mut note = |text: String| report.findings.push(ReportFinding::finding_note(text));
    if after.signer_id != before.signer_id {
        let [now, then] = [&after, &before].map(|row| or_nothing(&row.signer));
        note(format!("signer: {now} (before: {then})"));
    }
    if after.origin != before.origin {
        let [now, then] = [&after, &before].map(|row| row.origin);
        note(format!("origin: {now} (before: {then})"));
    }
    if after.licence != before.licence {
        let [now, then] = [&after, &before].map(|row| or_nothing(&row.licence));
        note(format!("licence: {now} (before: {then})"));
    }
    if after != before {
        edits::update_recording(job.connection, &after)?;
        job.counts.count_changed_rows("recordings", 1);
    }
    if let Some(signer) = after.signer_id {
        set_hand(job, signer, report)?;
    } else if options.handedness.is_some() {
        report.findings.push(ReportFinding::finding_warning(
            "its recording has no signer, so no signer has the dominant hand now",
            ErrorRemedy::command_remedy("name the signer, too, with --signer"),
        ));
    }
    // Only notes report changes; warnings say that nothing was done.
    let changed = report.findings[finding_count..]
        .iter()
        .any(|finding| finding.severity == "note");
    if changed && report.status == FileStatus::Unchanged {
        report.status = FileStatus::Updated;
    }
    warn_of_place(job, recording, report)
}

/// Gives a signer the dominant hand that the caller states, and reports it if the signer had another.
pub(super) fn set_hand(job: &mut ImportJob<'_>, signer: i64, report: &mut FileReport) -> CorpusResult<()> {
    let Some(hand) = job.options.handedness.as_deref() else {
        return Ok(());
    };
    let Some(mut row) = stored_recordings::find_signer_row(job.connection, signer)? else {
        return Ok(());
    };
    if row.handedness.as_deref() == Some(hand) {
        return Ok(());
    }
    let then = row.handedness.replace(hand.to_owned());
    edits::update_signer(job.connection, &row)?;
    job.counts.count_changed_rows("signers", 1);
    report.findings.push(ReportFinding::finding_note(format!(
        "dominant hand of {:?}: {hand} (before: {})",
        row.name,
        then.as_deref().unwrap_or(NOT_STATED_SIGN)
    )));
    Ok(())
}

/// Warns of options that would place new tracks, if the tracks of the file are elsewhere.
fn warn_of_place(job: &ImportJob<'_>, recording: i64, report: &mut FileReport) -> CorpusResult<()> {
    let options = job.options;
    let all = stored_tracks::load_track_rows(job.connection, recording)?;
    let moves = options.offset_us != 0 && all.iter().all(|track| track.offset_us != options.offset_us);
    let clock = options.clock.map(RecordingInstant::instant_micros);
    let times = clock.is_some() && all.iter().all(|track| track.clock_us != clock);
    let other = match &options.into {
        Some(into) => address::find_recording_by_name(job.connection, into)?.id != recording,
        None => false,
    };
    for (has, option) in [(moves, "--offset"), (times, "--timecode"), (other, "--into")] {
        if has {
            report.findings.push(ReportFinding::finding_warning(
                format!("it is in the corpus already, so {option} has no effect"),
                ErrorRemedy::command_remedy(
                    "move its tracks with `chereme track`; or `chereme undo` its first import, and import it again",
                ),
            ));
        }
    }
    Ok(())
}

/// A skeleton track before its file is read again.
pub(super) struct StandingSkeletonTrack {
    pub(super) track: MotionTrack,
    /// The names of the optical markers beside the skeleton.
    markers: Vec<String>,
}

/// Returns the skeleton track of a recording that a motion file became; nothing, and a warning, if it is not known.
pub(super) fn own_track(
    job: &ImportJob<'_>,
    recording: i64,
    is_bvh: bool,
    report: &mut FileReport,
) -> CorpusResult<Option<StandingSkeletonTrack>> {
    let mut skeleton_tracks = Vec::new();
    for row in stored_tracks::load_track_rows(job.connection, recording)? {
        if row.kind == TrackKind::Skeleton {
            skeleton_tracks.push(MotionTrack::of_row(job.connection, row.id)?);
        }
    }
    // A track from a BVH file has its columns, and can only be read again from such a file.
    skeleton_tracks.retain(|candidate| candidate.is_of_bvh() == is_bvh);
    if skeleton_tracks.len() == 1
        && let Some(track) = skeleton_tracks.pop()
    {
        let markers = marker_names(job, &track)?;
        return Ok(Some(StandingSkeletonTrack { track, markers }));
    }
    report.findings.push(ReportFinding::finding_warning(
        format!(
            "it was not read again: its recording has {} skeletons from such files, and nothing shows which one is this file's",
            skeleton_tracks.len()
        ),
        "to read it in another manner, import a copy of it under another name",
    ));
    Ok(None)
}

/// Returns the JSON of the joints of each channel group.
pub(super) fn groups_json(groups: &BTreeMap<ChannelGroup, Vec<usize>>) -> String {
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.channel_group_name(), joints))
        .collect();
    json!(named).to_string()
}

/// Returns the options for reading a file again. An option that the caller leaves out has the value that holds already,
/// unless that is the reader's `guess`.
pub(super) fn options_again(options: &ImportOptions, was: &MotionTrack, guess: SpaceConvention) -> ImportOptions {
    let before = was.convention;
    // A value that equals the guess was itself a guess, and is guessed again with the other options.
    let unit = (before.metres_per_unit != guess.metres_per_unit).then_some(before.metres_per_unit);
    ImportOptions {
        metres_per_unit: options.metres_per_unit.or(unit),
        axes: options.axes.or((before.axes != guess.axes).then_some(before.axes)),
        roles: options.roles.clone().or(was.manual_joint_roles()),
        ..ImportOptions::default()
    }
}

/// Stores another reading of a skeleton track, with its optical markers, and reports what changed. If nothing did, the
/// report is that of an unchanged file.
pub(super) fn apply_skeleton_reading(
    job: &mut ImportJob<'_>,
    was: &StandingSkeletonTrack,
    row: &MotionTrackRow,
    anatomy: &BodyAnatomy,
    report: &mut FileReport,
) -> CorpusResult<()> {
    let old = &was.track.row;
    if row == old {
        return Ok(());
    }
    stored_recordings::update_reading(job.connection, row)?;
    job.counts.count_changed_rows("tracks", 1);
    report.status = FileStatus::Updated;
    // The report of an unchanged file says that nothing was done.
    report.findings.clear();
    let mut note = |text: String| report.findings.push(ReportFinding::finding_note(text));
    note("it was imported before: its movement was read again, as the options say".to_owned());
    if row.metres_per_unit != old.metres_per_unit {
        let [now, then] = [row, old].map(|track_row| track_row.metres_per_unit);
        note(format!("unit of length: {now} m (before: {then} m)"));
    }
    if row.axes != old.axes {
        note(format!("axes up,left: {} (before: {})", row.axes, old.axes));
    }
    if row.roles != old.roles {
        note("the parts of the body are those of the roles file".to_owned());
    }
    let order = |track_row: &MotionTrackRow| track_row.root_order.clone().unwrap_or(NOT_STATED_SIGN.to_owned());
    if row.root_order != old.root_order {
        note(format!(
            "order of the root's columns: {} (before: {})",
            order(row),
            order(old)
        ));
    }
    let scale = |track_row: &MotionTrackRow| track_row.root_scale.unwrap_or(1.0);
    if row.root_scale != old.root_scale {
        note(format!(
            "factor for the root's positions: {} (before: {})",
            scale(row),
            scale(old)
        ));
    }
    replace_markers(job, row, &was.markers, anatomy, report)
}

/// Returns the names of the optical markers beside a skeleton.
fn marker_names(job: &ImportJob<'_>, track: &MotionTrack) -> CorpusResult<Vec<String>> {
    let markers = track.track_anatomy(job.connection)?.marker_joints().to_vec();
    let joints = &track.hierarchy.joints;
    let names = markers.iter().filter_map(|&at| joints.get(at));
    Ok(names.map(|joint| joint.name.clone()).collect())
}

/// Replaces the track of the optical markers beside a skeleton by one of the new reading.
fn replace_markers(
    job: &mut ImportJob<'_>,
    row: &MotionTrackRow,
    before: &[String],
    anatomy: &BodyAnatomy,
    report: &mut FileReport,
) -> CorpusResult<()> {
    let mut old: Option<TrackRow> = None;
    for track in stored_tracks::load_track_rows(job.connection, row.recording_id)? {
        if track.kind == TrackKind::Markers {
            let channels = stored_tracks::load_channel_rows(job.connection, track.id)?;
            // Nothing links the points to their skeleton but the names that they have in common.
            if channels.iter().map(|channel| &channel.name).eq(before) {
                old = Some(track);
            }
        }
    }
    let Some(old) = old else {
        if before.is_empty() && beside::store_leaf_markers(job, row.id, row.offset_us, anatomy, report)?.is_some() {
            job.count_created_rows("tracks", 1);
        }
        return Ok(());
    };
    stored_tracks::remove_track(job.connection, old.id)?;
    match beside::store_leaf_markers(job, row.id, old.offset_us, anatomy, report)? {
        Some(new) => {
            stored_tracks::rename_track(job.connection, new, &old.name)?;
            if let Some(clock) = old.clock_us {
                stored_tracks::set_clock(job.connection, new, clock)?;
            }
            job.counts.count_changed_rows("tracks", 1);
        }
        None => job.counts.count_removed_rows("tracks", 1),
    }
    Ok(())
}
