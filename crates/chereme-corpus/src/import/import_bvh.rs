//! Imports motion files: a recording with its skeleton and its movement, every number stored exactly.

mod bvh_again;
mod bvh_unread;
mod odd;
mod root;

use std::fs::File;
use std::sync::Arc;

use chereme_formats::ReaderCorrection;
use chereme_formats::bvh::bones::BonePositions;
use chereme_formats::bvh::bvh_convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{BvhHierarchy, BvhReadOptions, BvhReader, ChannelFix, MotionBlock};
use chereme_motion::anatomy::{BodyAnatomy, BodyPart, ConventionGuess, OddTip, PartEvidence};
use chereme_motion::ends::ClipEnds;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, Clip, FrameRate, ModelPose, Skeleton, SpaceConvention};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use sha2::{Digest, Sha256};

use super::import_again::{groups_json, set_hand};
use super::import_joining::JoinReason;
use super::understood::{BodyRead, ConventionRead, JointRole, MovementRead, RootRead};
use super::{FileReport, FileStatus, ImportJob, ImportOptions, import_eaf};
use crate::address;
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_recordings::{self, MotionTrackRow, RecordingRow};
use crate::db::stored_tiers;
use crate::db::stored_tracks::{self, TrackKind};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{self, BLOCK_FRAMES, ChannelGroup, MotionTrack};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::report_finding::ReportFinding;

pub(super) use odd::report_odd_frames;
use root::{mend_order, mend_root, root_order, root_read, root_scale};

/// The number of frames in a header above which it is taken for damaged.
const MOST_DECLARED: u64 = 1_000_000_000;

pub(super) fn import_bvh(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    if let Some(report) = report_known_movement(job)? {
        return match job.again.filter(|_| job.options.reads_movement()) {
            Some(recording) => bvh_again::read_movement_again(job, recording, report, progress),
            None => Ok(report),
        };
    }
    let OpenedBvh {
        mut reader,
        size,
        mut block,
        mut more,
        mut hierarchy,
        mut bones,
        rate,
    } = open_bvh_file(job)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let frame_time = reader.bvh_motion_header().frame_time.clone();
    let understanding = understand(job.options, &hierarchy, &block, rate, &mut report)?;
    let declared = reader.bvh_motion_header().declared_frames;
    let plausible = declared.filter(|frames| *frames <= MOST_DECLARED);
    // A header may state fewer or more frames than the file holds; the rows are counted in the end.
    let frame_count = plausible.and_then(|frames| usize::try_from(frames).ok());
    let length = frame_count.map(|frames| rate.frame_start_instant(frames).instant_micros());
    let recording = insert_recording(job, length, &mut report)?;
    let track = insert_track(
        job,
        recording,
        &hierarchy,
        rate,
        frame_time.map(|time| time.to_string()),
        &understanding,
    )?;
    let groups = understanding.column_groups(&hierarchy);
    while more {
        let first = usize::try_from(block.first_frame).unwrap_or(usize::MAX);
        movement::store_block_groups(job.connection, track, &groups, first, block.frames, &block.columns)?;
        progress.report_amount(ProgressUnit::Bytes, &job.file_name, reader.bytes_read(), Some(size))?;
        more = reader.next_block(&mut block).map_err(bvh_import_error)?;
        if more {
            bones.sample_motion_block(&block);
        }
    }
    let summary = reader.finish_bvh_reading();
    // Bones are placed by all frames, so that the skeleton is stored again once the last one is read.
    place_joints(job, track, &bones, &mut hierarchy, &mut report)?;
    finish_movement_track(job, recording, track, summary.frames, rate)?;
    if let Some(clock) = job.options.clock {
        stored_tracks::set_clock(job.connection, track, clock.instant_micros())?;
        super::import_clock::align_tracks_by_clock(job, recording, &[track], &mut report)?;
    }
    let found_by_reader = summary.findings.into_iter().map(|finding| {
        let is_order = finding.mend == Some(ReaderCorrection::RootOrder);
        let mut finding = ReportFinding::from(finding);
        match job.options.mend_root {
            true if is_order => (finding.severity, finding.remedy) = ("note", None),
            false if is_order => finding.remedy = Some(mend_order()),
            _ => {}
        }
        finding
    });
    report.findings.extend(found_by_reader);
    let first = first_frame(&hierarchy, &understanding.first, rate, summary.root_fix)?;
    let scale = root_scale(
        &first,
        &understanding.anatomy,
        understanding.convention.axes.up_direction().axis_direction_vector(),
    );
    mend_root(job, track, summary.root_fix, scale, &mut report)?;
    report_odd_frames(job, recording, &mut report, progress)?;
    let offset_us = job.options.offset_us;
    let kept = super::import_tracks::store_leaf_markers(job, track, offset_us, &understanding.anatomy, &mut report)?;
    job.count_created_rows("tracks", usize::from(kept.is_some()));
    report.recording = Some(stored_recordings::load_recording_row(job.connection, recording)?.name);
    Ok(report)
}

/// A BVH file with its first block of frames.
struct OpenedBvh {
    reader: BvhReader<File>,
    /// The number of bytes of the file.
    size: u64,
    block: MotionBlock,
    /// Whether the block holds frames.
    more: bool,
    /// The skeleton, with the joints where the first block puts them.
    hierarchy: BvhHierarchy,
    bones: BonePositions,
    rate: FrameRate,
}

/// Opens a BVH file and reads its first block.
fn open_bvh_file(job: &ImportJob<'_>) -> CorpusResult<OpenedBvh> {
    let file = File::open(job.path).map_err(|error| CorpusError::from_file_failure(job.path, error))?;
    let size = file
        .metadata()
        .map_err(|error| CorpusError::from_file_failure(job.path, error))?
        .len();
    let options = BvhReadOptions {
        block_frames: BLOCK_FRAMES,
    };
    let mut reader = BvhReader::open_with(file, options).map_err(bvh_import_error)?;
    let mut block = MotionBlock::default();
    let more = reader.next_block(&mut block).map_err(bvh_import_error)?;
    let mut hierarchy = reader.bvh_hierarchy().clone();
    let mut bones = BonePositions::new(&hierarchy);
    bones.sample_motion_block(&block);
    bones.record_joint_positions(&mut hierarchy);
    let rate = bvh_convert::rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref()).map_err(|error| {
        CorpusError::from_wrong_message(error.to_string()).with_advice("correct the line `Frame Time:` of the file")
    })?;
    Ok(OpenedBvh {
        reader,
        size,
        block,
        more,
        hierarchy,
        bones,
        rate,
    })
}

/// Returns the report of movement that was imported before, from the same path, or under the same name by an earlier
/// import.
fn report_known_movement(job: &mut ImportJob<'_>) -> CorpusResult<Option<FileReport>> {
    let name = job.file_name.to_lowercase();
    let known_file = job.places.files_with_hash(&job.hash).find(|row| {
        let here = row.path.as_deref() == Some(&job.place);
        here || (job.places.is_earlier(row) && row.name.to_lowercase() == name)
    });
    let Some(mut row) = known_file.filter(|row| row.kind == job.kind).cloned() else {
        return Ok(None);
    };
    let elsewhere = row.path.take().filter(|path| *path != job.place);
    let mut report = FileReport::unchanged_file_report(job.path, elsewhere.as_deref());
    job.again = row.recording_id;
    if let Some(id) = row.recording_id {
        report.recording = Some(stored_recordings::load_recording_row(job.connection, id)?.name);
    }
    if elsewhere.is_some() {
        // The annotation files beside the file's new place belong to the same take.
        row.path = Some(job.place.clone());
        job.places.add_file_place(row);
    }
    Ok(Some(report))
}

/// Reports other movement that was imported from the path of this file.
fn report_replaced_movement(job: &ImportJob<'_>, report: &mut FileReport) -> CorpusResult<()> {
    let before = job.places.find_file_at(&job.place, job.kind);
    if let Some(id) = before.and_then(|row| row.recording_id) {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "other movement was imported from this file before, as the recording {:?}; movement is \
                 not replaced, and this is a recording of its own",
                stored_recordings::load_recording_row(job.connection, id)?.name
            ),
            "undo the earlier import, if it is not needed any more",
        ));
    }
    Ok(())
}

/// Stores the positions of joints as the whole movement gives them, and reports offsets that differ.
fn place_joints(
    job: &ImportJob<'_>,
    track: i64,
    bones: &BonePositions,
    hierarchy: &mut BvhHierarchy,
    report: &mut FileReport,
) -> CorpusResult<()> {
    let moved = bones.record_joint_positions(hierarchy);
    let (hash, document) = stored_as(hierarchy)?;
    let joints = hierarchy.joints.len();
    let skeleton = stored_recordings::skeleton_stored(job.connection, &hash, joints, &document)?;
    stored_recordings::set_skeleton(job.connection, track, skeleton)?;
    let names: Vec<&str> = moved
        .iter()
        .map(|&joint| hierarchy.joints[joint].name.as_str())
        .collect();
    let owned = names.iter().map(|&name| name.to_owned()).collect();
    report.understood.placed_by_movement = Some(owned);
    if !names.is_empty() {
        report.findings.push(ReportFinding::finding_note(format!(
            "the offsets of {} are not where the movement puts {}: the movement is used, and the stored numbers stay those of the file",
            list_first_names(&names),
            if names.len() == 1 { "it" } else { "them" }
        )));
    }
    Ok(())
}

/// Lists the first few names, and the number of those left out.
fn list_first_names(names: &[&str]) -> String {
    let shown = names.iter().take(6).copied().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(6) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Returns the hash and the JSON under which a skeleton is stored.
fn stored_as(hierarchy: &BvhHierarchy) -> CorpusResult<(String, String)> {
    let document =
        serde_json::to_string(hierarchy).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    Ok((to_hex_text(&Sha256::digest(document.as_bytes())), document))
}

fn bvh_import_error(error: chereme_formats::bvh::raw::BvhError) -> CorpusError {
    let (remedy, line) = (error.kind.bvh_error_remedy(), error.line);
    CorpusError::from_wrong_message(error.kind.to_string())
        .with_error_place(format!("line {line}"))
        .with_advice(remedy)
}

/// Guesses of unit and axes with less confidence than this are reported.
pub(super) const SURE_GUESS_CONFIDENCE: f64 = 0.7;

/// Interpretation of a file's skeleton: unit and axes, channel groups, joint roles, and its first frames.
struct UnderstoodSkeleton {
    convention: SpaceConvention,
    groups: std::collections::BTreeMap<ChannelGroup, Vec<usize>>,
    anatomy: BodyAnatomy,
    first: MotionBlock,
}

impl UnderstoodSkeleton {
    /// Returns the columns of the file that belong to each channel group.
    fn column_groups(&self, hierarchy: &BvhHierarchy) -> Vec<(ChannelGroup, Vec<usize>)> {
        let columns = |joints: &Vec<usize>| movement::columns_of(hierarchy, joints);
        let groups = self.groups.iter();
        groups.map(|(group, joints)| (*group, columns(joints))).collect()
    }
}

fn understand(
    options: &ImportOptions,
    hierarchy: &BvhHierarchy,
    block: &MotionBlock,
    rate: FrameRate,
    report: &mut FileReport,
) -> CorpusResult<UnderstoodSkeleton> {
    let first = first_frame(hierarchy, block, rate, None)?;
    let skeleton: &Arc<Skeleton> = first.clip_skeleton();
    let roles = options.roles.clone().unwrap_or_default();
    let anatomy = BodyAnatomy::with_roles(skeleton, &roles).map_err(|error| {
        CorpusError::from_wrong_message(error.to_string()).with_advice(ErrorRemedy::choice_remedy(
            RemedyChoice::JointRoles,
            "correct the roles file (--roles), or leave it out",
        ))
    })?;
    let guess = guess_bvh_convention(&anatomy, skeleton, &first, hierarchy, block, rate)?;
    let convention = SpaceConvention {
        metres_per_unit: options.metres_per_unit.unwrap_or(guess.convention.metres_per_unit),
        axes: options.axes.unwrap_or(guess.convention.axes),
    };
    describe_bvh_reading(report, &guess, &convention, rate, hierarchy);
    describe_anatomy(report, skeleton, &anatomy);
    if guess.unit_name == "unknown" && options.metres_per_unit.is_none() {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "the file's unit of length cannot be inferred from its skeleton; one unit is taken for {:.4} m",
                convention.metres_per_unit
            ),
            ErrorRemedy::choice_remedy(RemedyChoice::Unit, "say the unit with --unit, such as --unit cm"),
        ));
    }
    report
        .findings
        .extend(bvh_unread::unusual_stature_finding(&guess, options));
    // An unknown unit has a warning of its own, and says all that there is to doubt.
    let doubted = guess.axes_confidence < SURE_GUESS_CONFIDENCE && guess.unit_name != "unknown";
    if let Some(reason) = guess.reasons.last().filter(|_| doubted && options.axes.is_none()) {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "the directions up and left are uncertain; {} is assumed ({reason})",
                convention.axes
            ),
            ErrorRemedy::choice_remedy(
                RemedyChoice::Axes,
                "look at it with `chereme render`; say the axes with --axes, or name the joints in a roles file",
            ),
        ));
    }
    Ok(UnderstoodSkeleton {
        convention,
        groups: movement::channel_groups(skeleton, &anatomy),
        anatomy,
        first: MotionBlock {
            // The block is overwritten by the following frames, and the first one is still needed.
            columns: block.columns.clone(),
            ..*block
        },
    })
}

/// Guesses the unit and axes from the first ordinary frame: a bind pose may face another direction.
fn guess_bvh_convention(
    anatomy: &BodyAnatomy,
    skeleton: &Skeleton,
    first: &Clip,
    hierarchy: &BvhHierarchy,
    block: &MotionBlock,
    rate: FrameRate,
) -> CorpusResult<ConventionGuess> {
    let pose: Option<ModelPose> = (first.clip_frame_count() > 0).then(|| first.model_pose(0));
    let guess = anatomy.guess_convention(skeleton, pose.as_ref());
    let head = guess
        .convention
        .file_clip_to_model(&first_block_clip(hierarchy, block, rate, None, block.frames)?);
    let sound = ClipEnds::examine_clip_ends(&head, &anatomy.clone().with_clip(&head))
        .sound
        .start;
    if sound == 0 {
        return Ok(guess);
    }
    let pose = first_block_clip(hierarchy, block, rate, None, sound + 1)?.model_pose(sound);
    Ok(anatomy.guess_convention(skeleton, Some(&pose)))
}

fn first_frame(
    hierarchy: &BvhHierarchy,
    block: &MotionBlock,
    rate: FrameRate,
    fix: Option<ChannelFix>,
) -> CorpusResult<Clip> {
    first_block_clip(hierarchy, block, rate, fix, 1)
}

/// Returns the first frames of a block, in the file's unit and axes.
fn first_block_clip(
    hierarchy: &BvhHierarchy,
    block: &MotionBlock,
    rate: FrameRate,
    fix: Option<ChannelFix>,
    count: usize,
) -> CorpusResult<Clip> {
    let mut builder =
        ClipBuilder::new(hierarchy, fix).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    builder.push_block_rows(0..block.frames.min(count), |at| block.columns.get(at));
    builder.finish_bvh_clip(rate).map_err(|error| {
        CorpusError::from_wrong_message(error.to_string())
            .with_advice("a joint is placed beyond what a number can hold; correct the number")
    })
}

fn describe_bvh_reading(
    report: &mut FileReport,
    guess: &ConventionGuess,
    convention: &SpaceConvention,
    rate: FrameRate,
    hierarchy: &BvhHierarchy,
) {
    let chosen = convention != &guess.convention;
    report.understood.movement = Some(MovementRead {
        joints: hierarchy.joints.len(),
        channels: Some(hierarchy.channel_count()),
        frame_rate: rate.to_string(),
        unit: if chosen { "as given" } else { guess.unit_name },
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        guess: Some(ConventionRead {
            confidence: guess.confidence,
            reasons: guess.reasons.clone(),
        }),
    });
}

pub(super) fn describe_anatomy(report: &mut FileReport, skeleton: &Skeleton, anatomy: &BodyAnatomy) {
    let name = |joint: usize| skeleton.joint_at(joint).name.clone();
    let role = |(part, joint, by): (BodyPart, usize, PartEvidence)| JointRole {
        part: part.to_string(),
        joint: name(joint),
        by,
    };
    let guessed = anatomy
        .found_parts()
        .filter(|(.., how)| *how == PartEvidence::Topology)
        .count();
    let missing: Vec<String> = anatomy.missing_parts().iter().map(ToString::to_string).collect();
    if guessed > 0 {
        report.findings.push(ReportFinding::finding_note(format!(
            "joints identified by their position in the skeleton, not by name: {guessed}"
        )));
    }
    if !missing.is_empty() {
        let shown = missing.iter().take(6).cloned().collect::<Vec<_>>().join(", ");
        let more_count = missing.len().saturating_sub(6);
        let more = if more_count > 0 {
            format!(" and {more_count} more")
        } else {
            String::new()
        };
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: format!("not found in the skeleton: {shown}{more}"),
            remedy: Some(ErrorRemedy::choice_remedy(
                RemedyChoice::JointRoles,
                "if a joint is one of these, say so in a roles file (--roles)",
            )),
        });
    }
    report.findings.extend(bvh_unread::unread_hand_findings(anatomy));
    report.findings.extend(bvh_unread::unread_digit_findings(anatomy));
    report.findings.extend(odd_tips(skeleton, anatomy));
    let markers: Vec<String> = anatomy.marker_joints().iter().map(|&joint| name(joint)).collect();
    let body = BodyRead {
        roles: anatomy.found_parts().map(role).collect(),
        joint_names: (0..skeleton.len()).map(name).collect(),
        missing,
        markers: markers.clone(),
    };
    report.understood.body = Some(body.into());
    if !markers.is_empty() {
        let names: Vec<&str> = markers.iter().map(String::as_str).collect();
        report.findings.push(ReportFinding::finding_note(format!(
            "{} optical markers are beside the skeleton and do not count as joints: {}",
            markers.len(),
            list_first_names(&names)
        )));
    }
    for ambiguity in anatomy.ambiguous_parts() {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "{} was taken to be {:?}; other joints could be it",
                ambiguity.part,
                name(ambiguity.taken)
            ),
            ErrorRemedy::choice_remedy(RemedyChoice::JointRoles, "say which one in a roles file (--roles)"),
        ));
    }
}

/// Returns the recording without movement that a movement of this length belongs to, if its annotations were imported
/// first. A recording from another folder is another take if it has a capture of any kind, or annotations that end after
/// the movement.
fn without_movement(
    job: &mut ImportJob<'_>,
    length_us: Option<i64>,
    report: &mut FileReport,
) -> CorpusResult<Option<i64>> {
    if let Some(id) = job.places.recording_beside_file(&job.place) {
        let track = stored_recordings::body_track(job.connection, id)?;
        if track.is_some() {
            return Ok(None);
        }
        job.note_file_join(id, JoinReason::FolderAndName);
        return Ok(Some(id));
    }
    let connection = job.connection;
    let is_bare = |id: i64| -> CorpusResult<bool> {
        let tracks = stored_tracks::load_track_rows(connection, id)?;
        // A film beside annotations is no capture, and can belong to the same take.
        Ok(tracks.iter().all(|track| track.kind == TrackKind::Media))
    };
    let fits = |id: i64| -> CorpusResult<bool> {
        let Some(length) = length_us else {
            return Ok(true);
        };
        let most = length.saturating_add(import_eaf::MAX_OVERHANG_US);
        for tier in stored_tiers::load_tier_rows(connection, id)? {
            let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id)?;
            if rows.iter().any(|row| row.end_us > most) {
                return Ok(false);
            }
        }
        Ok(true)
    };
    let mut likely = Vec::new();
    for candidate in job.recordings_of_same_name()? {
        if is_bare(candidate.id)? && fits(candidate.id)? {
            likely.push(candidate);
        }
    }
    job.join_by_name_elsewhere(&likely, report)
}

/// Returns the recording that a movement of this length belongs to: the one that the caller named, one of this name
/// without movement, or a new one.
pub(super) fn insert_recording(
    job: &mut ImportJob<'_>,
    length_us: Option<i64>,
    report: &mut FileReport,
) -> CorpusResult<i64> {
    let options = job.options;
    if let Some(into) = &options.into {
        let id = address::find_recording_by_name(job.connection, into)?.id;
        job.note_file_join(id, JoinReason::Stated);
        return Ok(id);
    }
    report_replaced_movement(job, report)?;
    let signer_id = match &options.signer {
        Some(name) => {
            let new = stored_recordings::find_signer(job.connection, name)?.is_none();
            job.count_created_rows("signers", usize::from(new));
            let hand = options.handedness.as_deref();
            let signer = stored_recordings::signer_named(job.connection, name, hand)?;
            set_hand(job, signer, report)?;
            Some(signer)
        }
        None => None,
    };
    let id = match without_movement(job, length_us, report)? {
        Some(id) => {
            let (origin, licence) = (options.origin, options.licence.as_deref());
            stored_recordings::set_recording_description(job.connection, id, signer_id, origin, licence)?;
            id
        }
        None => {
            job.count_created_rows("recordings", 1);
            let (name, note) = job.own_name()?;
            report.findings.extend(note);
            let row = RecordingRow {
                id: 0,
                name,
                signer_id,
                signer: None,
                origin: options.origin.unwrap_or_default(),
                duration_us: 0,
                licence: options.licence.clone(),
                notes: None,
            };
            stored_recordings::insert_recording(job.connection, &row)?
        }
    };
    Ok(id)
}

fn insert_track(
    job: &mut ImportJob<'_>,
    recording: i64,
    hierarchy: &BvhHierarchy,
    rate: FrameRate,
    frame_time: Option<String>,
    found: &UnderstoodSkeleton,
) -> CorpusResult<i64> {
    let (hash, document) = stored_as(hierarchy)?;
    let joints = hierarchy.joints.len();
    let skeleton_id = stored_recordings::skeleton_stored(job.connection, &hash, joints, &document)?;
    job.count_created_rows("tracks", 1);
    stored_recordings::insert_motion_track(
        job.connection,
        &MotionTrackRow {
            id: 0,
            recording_id: recording,
            name: stored_tracks::free_track_name(job.connection, recording, "body")?,
            offset_us: job.options.offset_us,
            skeleton_id,
            frames: 0,
            rate_frames: rate.rate_numerator(),
            rate_seconds: rate.per_seconds(),
            frame_time,
            metres_per_unit: found.convention.metres_per_unit,
            axes: found.convention.axes.to_string(),
            root_order: None,
            root_scale: None,
            roles: job
                .options
                .roles
                .as_ref()
                .and_then(|roles| serde_json::to_string(roles).ok()),
            channel_groups: groups_json(&found.groups),
        },
    )
}

fn finish_movement_track(
    job: &mut ImportJob<'_>,
    recording: i64,
    track: i64,
    frames: u64,
    rate: FrameRate,
) -> CorpusResult<()> {
    let count = i64::try_from(frames).unwrap_or(i64::MAX);
    stored_recordings::set_frames(job.connection, track, count)?;
    let track_end = rate.frame_start_instant(usize::try_from(frames).unwrap_or(usize::MAX));
    let end = track_end.shifted_instant(job.options.offset_us);
    stored_recordings::lengthen_recording(job.connection, recording, end.instant_micros())?;
    job.keep_source_file(Some(recording), None)?;
    Ok(())
}

/// Returns findings about the ends of thumbs and fingers that are mended for measures and pictures.
fn odd_tips(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Vec<ReportFinding> {
    let named = |odd: OddTip| {
        let joints = (0..skeleton.len()).filter(|&joint| anatomy.odd_tip(skeleton, joint) == Some(odd));
        let names: Vec<&str> = joints.map(|joint| skeleton.joint_at(joint).name.as_str()).collect();
        (names.len(), names.join(", "))
    };
    let message = |odd: OddTip| match (odd, named(odd)) {
        (_, (0, _)) => None,
        (OddTip::Turned, (_, names)) => Some(format!(
            "the ends of these finger bones point elsewhere than the fingers and are turned to them: {names}"
        )),
        (OddTip::Short, (_, names)) => Some(format!(
            "the ends of these finger bones have no length, so that their fingertips are guessed: {names}"
        )),
        (OddTip::Long, (_, names)) => Some(format!(
            "the ends of these finger bones are over twice as long as the rest of the hand suggests, and are drawn and measured at the usual length: {names}"
        )),
    };
    let messages = [OddTip::Turned, OddTip::Short].map(message);
    let notes = messages.into_iter().flatten().map(ReportFinding::finding_note);
    let long = message(OddTip::Long).map(|message| {
        ReportFinding::finding_warning(
            message,
            ErrorRemedy::choice_remedy(
                RemedyChoice::Unit,
                "the stored numbers stay those of the file; if the fingers are right and the rest is not, say the unit with --unit",
            ),
        )
    });
    let long_bones = anatomy.long_finger_bones(skeleton);
    let bones: Vec<&str> = long_bones
        .iter()
        .map(|&(joint, _)| skeleton.joint_at(joint).name.as_str())
        .collect();
    let bones = (!bones.is_empty()).then(|| {
        ReportFinding::finding_warning(
            format!(
                "these finger bones are over twice as long as those of the other hand and of the other fingers: {}",
                bones.join(", ")
            ),
            "they are drawn and measured at the usual length, and the stored numbers stay those of the file: mend the skeleton in the program that wrote it, and import the file again",
        )
    });
    notes.chain(long).chain(bones).collect()
}
