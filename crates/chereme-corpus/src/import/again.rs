//! Applies the options of an import to a file that is in the corpus already: to its recording, and to its movement.

use std::collections::BTreeMap;

use chereme_motion::{Anatomy, Convention, Instant};
use chereme_sign::Remedy;
use serde_json::json;

use super::report::ReportFinding;
use super::{FileReport, FileStatus, ImportOptions, Job, tracks as beside};
use crate::address;
use crate::db::edits;
use crate::db::recordings::{self, MotionTrackRow};
use crate::db::tracks::{self, TrackKind, TrackRow};
use crate::error::Result;
use crate::movement::{ChannelGroup, MotionTrack};

/// The sign for something that was not stated before.
const NOTHING: &str = "–";

impl ImportOptions {
    /// Returns whether the caller says how movement is to be read.
    pub(super) fn reads_movement(&self) -> bool {
        self.metres_per_unit.is_some()
            || self.axes.is_some()
            || self.roles.is_some()
            || self.mend_root
    }
}

/// Gives a recording the signer, dominant hand, origin and licence that the caller states, and reports what changed,
/// and which options have no effect on a file that the corpus has already.
pub(super) fn describe(job: &mut Job<'_>, recording: i64, report: &mut FileReport) -> Result<()> {
    let options = job.options;
    let before = recordings::recording(job.connection, recording)?;
    let mut after = before.clone();
    if let Some(name) = &options.signer {
        let new = recordings::find_signer(job.connection, name)?.is_none();
        job.count("signers", usize::from(new));
        let hand = options.handedness.as_deref();
        after.signer_id = Some(recordings::signer_named(job.connection, name, hand)?);
        after.signer = Some(name.clone());
    }
    after.origin = options.origin.unwrap_or(before.origin);
    after.licence = options.licence.clone().or(after.licence);
    let known = report.findings.len();
    let or_nothing = |text: &Option<String>| text.as_deref().unwrap_or(NOTHING).to_owned();
    let mut note = |text: String| report.findings.push(ReportFinding::note(text));
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
        job.counts.changed("recordings", 1);
    }
    if let Some(signer) = after.signer_id {
        set_hand(job, signer, report)?;
    } else if options.handedness.is_some() {
        report.findings.push(ReportFinding::warning(
            "its recording has no signer, so no signer has the dominant hand now",
            Remedy::command("name the signer, too, with --signer"),
        ));
    }
    let changed = report.findings[known..]
        .iter()
        .any(|it| it.severity == "note");
    if changed && report.status == FileStatus::Unchanged {
        report.status = FileStatus::Updated;
    }
    warn_of_place(job, recording, report)
}

/// Gives a signer the dominant hand that the caller states, and reports it if the signer had another.
pub(super) fn set_hand(job: &mut Job<'_>, signer: i64, report: &mut FileReport) -> Result<()> {
    let Some(hand) = job.options.handedness.as_deref() else {
        return Ok(());
    };
    let Some(mut row) = recordings::signer(job.connection, signer)? else {
        return Ok(());
    };
    if row.handedness.as_deref() == Some(hand) {
        return Ok(());
    }
    let then = row.handedness.replace(hand.to_owned());
    edits::update_signer(job.connection, &row)?;
    job.counts.changed("signers", 1);
    report.findings.push(ReportFinding::note(format!(
        "dominant hand of {:?}: {hand} (before: {})",
        row.name,
        then.as_deref().unwrap_or(NOTHING)
    )));
    Ok(())
}

/// Warns of options that would place new tracks, if the tracks of the file are elsewhere.
fn warn_of_place(job: &Job<'_>, recording: i64, report: &mut FileReport) -> Result<()> {
    let options = job.options;
    let all = tracks::tracks(job.connection, recording)?;
    let moves = options.offset_us != 0 && all.iter().all(|it| it.offset_us != options.offset_us);
    let clock = options.clock.map(Instant::micros);
    let times = clock.is_some() && all.iter().all(|it| it.clock_us != clock);
    let other = match &options.into {
        Some(into) => address::recording(job.connection, into)?.id != recording,
        None => false,
    };
    for (has, option) in [
        (moves, "--offset"),
        (times, "--timecode"),
        (other, "--into"),
    ] {
        if has {
            report.findings.push(ReportFinding::warning(
                format!("it is in the corpus already, so {option} has no effect"),
                Remedy::command(
                    "move its tracks with `chereme track`; or `chereme undo` its first import, and import it again",
                ),
            ));
        }
    }
    Ok(())
}

/// A skeleton track before its file is read again.
pub(super) struct Standing {
    pub(super) track: MotionTrack,
    /// The names of the optical markers beside the skeleton.
    markers: Vec<String>,
}

/// Returns the skeleton track of a recording that a motion file became; nothing, and a warning, if it is not known.
pub(super) fn own_track(
    job: &Job<'_>,
    recording: i64,
    is_bvh: bool,
    report: &mut FileReport,
) -> Result<Option<Standing>> {
    let mut found = Vec::new();
    for row in tracks::tracks(job.connection, recording)? {
        if row.kind == TrackKind::Skeleton {
            found.push(MotionTrack::of_row(job.connection, row.id)?);
        }
    }
    found.retain(|it| it.is_of_bvh() == is_bvh);
    if found.len() == 1
        && let Some(track) = found.pop()
    {
        let markers = marker_names(job, &track)?;
        return Ok(Some(Standing { track, markers }));
    }
    report.findings.push(ReportFinding::warning(
        format!(
            "it was not read again: its recording has {} skeletons from such files, and nothing shows which one is this file's",
            found.len()
        ),
        "to read it in another manner, import a copy of it under another name",
    ));
    Ok(None)
}

/// Returns the JSON of the joints of each channel group.
pub(super) fn groups_json(groups: &BTreeMap<ChannelGroup, Vec<usize>>) -> String {
    let named: BTreeMap<&str, &Vec<usize>> = groups
        .iter()
        .map(|(group, joints)| (group.name(), joints))
        .collect();
    json!(named).to_string()
}

/// Returns the options for reading a file again. An option that the caller leaves out has the value that holds already,
/// unless that is the reader's `guess`.
pub(super) fn options_again(
    options: &ImportOptions,
    was: &MotionTrack,
    guess: Convention,
) -> ImportOptions {
    let before = was.convention;
    let unit = (before.metres_per_unit != guess.metres_per_unit).then_some(before.metres_per_unit);
    ImportOptions {
        metres_per_unit: options.metres_per_unit.or(unit),
        axes: options
            .axes
            .or((before.axes != guess.axes).then_some(before.axes)),
        roles: options.roles.clone().or(was.roles()),
        ..ImportOptions::default()
    }
}

/// Stores another reading of a skeleton track, with its optical markers, and reports what changed. If nothing did, the
/// report is that of an unchanged file.
pub(super) fn apply(
    job: &mut Job<'_>,
    was: &Standing,
    row: &MotionTrackRow,
    anatomy: &Anatomy,
    report: &mut FileReport,
) -> Result<()> {
    let old = &was.track.row;
    if row == old {
        return Ok(());
    }
    recordings::update_reading(job.connection, row)?;
    job.counts.changed("tracks", 1);
    report.status = FileStatus::Updated;
    report.findings.clear();
    let mut note = |text: String| report.findings.push(ReportFinding::note(text));
    note("it was imported before: its movement was read again, as the options say".to_owned());
    if row.metres_per_unit != old.metres_per_unit {
        let [now, then] = [row, old].map(|it| it.metres_per_unit);
        note(format!("unit of length: {now} m (before: {then} m)"));
    }
    if row.axes != old.axes {
        note(format!("axes up,left: {} (before: {})", row.axes, old.axes));
    }
    if row.roles != old.roles {
        note("the parts of the body are those of the roles file".to_owned());
    }
    let order = |it: &MotionTrackRow| it.root_order.clone().unwrap_or(NOTHING.to_owned());
    if row.root_order != old.root_order {
        note(format!(
            "order of the root's columns: {} (before: {})",
            order(row),
            order(old)
        ));
    }
    let scale = |it: &MotionTrackRow| it.root_scale.unwrap_or(1.0);
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
fn marker_names(job: &Job<'_>, track: &MotionTrack) -> Result<Vec<String>> {
    let markers = track.anatomy(job.connection)?.markers().to_vec();
    let joints = &track.hierarchy.joints;
    let names = markers.iter().filter_map(|&at| joints.get(at));
    Ok(names.map(|joint| joint.name.clone()).collect())
}

/// Replaces the track of the optical markers beside a skeleton by one of the new reading.
fn replace_markers(
    job: &mut Job<'_>,
    row: &MotionTrackRow,
    before: &[String],
    anatomy: &Anatomy,
    report: &mut FileReport,
) -> Result<()> {
    let mut old: Option<TrackRow> = None;
    for track in tracks::tracks(job.connection, row.recording_id)? {
        if track.kind == TrackKind::Markers {
            let channels = tracks::channels(job.connection, track.id)?;
            if channels.iter().map(|it| &it.name).eq(before) {
                old = Some(track);
            }
        }
    }
    let Some(old) = old else {
        if before.is_empty()
            && beside::keep_beside(job, row.id, row.offset_us, anatomy, report)?.is_some()
        {
            job.count("tracks", 1);
        }
        return Ok(());
    };
    tracks::remove(job.connection, old.id)?;
    match beside::keep_beside(job, row.id, old.offset_us, anatomy, report)? {
        Some(new) => {
            tracks::rename(job.connection, new, &old.name)?;
            if let Some(clock) = old.clock_us {
                tracks::set_clock(job.connection, new, clock)?;
            }
            job.counts.changed("tracks", 1);
        }
        None => job.counts.removed("tracks", 1),
    }
    Ok(())
}
