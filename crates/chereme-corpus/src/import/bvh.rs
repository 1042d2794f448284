//! Imports motion files: a recording with its skeleton and its movement, every number stored exactly.

mod again;
mod odd;
mod root;
mod unread;

use std::fs::File;
use std::sync::Arc;

use chereme_formats::Mend;
use chereme_formats::bvh::bones::Bones;
use chereme_formats::bvh::convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{Block, ChannelFix, Hierarchy, Options, Reader};
use chereme_motion::anatomy::{Anatomy, ConventionGuess, Evidence, OddTip, Part};
use chereme_motion::ends::Ends;
use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, Convention, ModelPose, Rate, Side, Skeleton};
use chereme_sign::{Choice, Remedy};
use sha2::{Digest, Sha256};

use super::again::{groups_json, set_hand};
use super::report::ReportFinding;
use super::understood::{BodyRead, ConventionRead, JointRole, MovementRead, RootRead};
use super::{FileReport, FileStatus, ImportOptions, Job, eaf};
use crate::address;
use crate::db::motion::hex;
use crate::db::recordings::{self, MotionTrackRow, RecordingRow};
use crate::db::tiers;
use crate::db::tracks::{self, TrackKind};
use crate::error::{Error, Result};
use crate::movement::{self, BLOCK_FRAMES, ChannelGroup, MotionTrack};
use crate::progress::{Progress, Step, Unit};

pub(super) use odd::report_odd_frames;
use root::{mend_order, mend_root, root_order, root_read, root_scale};

/// The number of frames in a header above which it is taken for damaged.
const MOST_DECLARED: u64 = 1_000_000_000;

pub(super) fn import(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    if let Some(report) = known(job)? {
        return match job.again.filter(|_| job.options.reads_movement()) {
            Some(recording) => again::read(job, recording, report, progress),
            None => Ok(report),
        };
    }
    let Opened {
        mut reader,
        size,
        mut block,
        mut more,
        mut hierarchy,
        mut bones,
        rate,
    } = open(job)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let frame_time = reader.header().frame_time.clone();
    let found = understand(job.options, &hierarchy, &block, rate, &mut report)?;
    let declared = reader.header().declared_frames;
    let plausible = declared.filter(|frames| *frames <= MOST_DECLARED);
    let length = plausible.and_then(|frames| usize::try_from(frames).ok());
    let length = length.map(|frames| rate.instant(frames).micros());
    let recording = insert_recording(job, length, &mut report)?;
    let track = insert_track(
        job,
        recording,
        &hierarchy,
        rate,
        frame_time.map(|time| time.to_string()),
        &found,
    )?;
    let groups = found.column_groups(&hierarchy);
    while more {
        let first = usize::try_from(block.first_frame).unwrap_or(usize::MAX);
        movement::store_block(
            job.connection,
            track,
            &groups,
            first,
            block.frames,
            &block.columns,
        )?;
        progress.report(Step {
            task: &job.file_name,
            done: reader.bytes_read(),
            total: Some(size),
            unit: Unit::Bytes,
        })?;
        more = reader.next_block(&mut block).map_err(wrong)?;
        if more {
            bones.push(&block);
        }
    }
    let summary = reader.finish();
    place_joints(job, track, &bones, &mut hierarchy, &mut report)?;
    finish(job, recording, track, summary.frames, rate)?;
    if let Some(clock) = job.options.clock {
        tracks::set_clock(job.connection, track, clock.micros())?;
        super::clock::place(job, recording, &[track], &mut report)?;
    }
    let found_by_reader = summary.findings.into_iter().map(|finding| {
        let is_order = finding.mend == Some(Mend::RootOrder);
        let mut finding = ReportFinding::from(finding);
        match job.options.mend_root {
            true if is_order => (finding.severity, finding.remedy) = ("note", None),
            false if is_order => finding.remedy = Some(mend_order()),
            _ => {}
        }
        finding
    });
    report.findings.extend(found_by_reader);
    let first = first_frame(&hierarchy, &found.first, rate, summary.root_fix)?;
    let scale = root_scale(&first, &found.anatomy, found.convention.axes.up().vector());
    mend_root(job, track, summary.root_fix, scale, &mut report)?;
    report_odd_frames(job, recording, &mut report, progress)?;
    let offset_us = job.options.offset_us;
    let kept = super::tracks::keep_beside(job, track, offset_us, &found.anatomy, &mut report)?;
    job.count("tracks", usize::from(kept.is_some()));
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    Ok(report)
}

/// A BVH file with its first block of frames.
struct Opened {
    reader: Reader<File>,
    /// The number of bytes of the file.
    size: u64,
    block: Block,
    /// Whether the block holds frames.
    more: bool,
    /// The skeleton, with the joints where the first block puts them.
    hierarchy: Hierarchy,
    bones: Bones,
    rate: Rate,
}

/// Opens a BVH file and reads its first block.
fn open(job: &Job<'_>) -> Result<Opened> {
    let file = File::open(job.path).map_err(|error| Error::file(job.path, error))?;
    let size = file
        .metadata()
        .map_err(|error| Error::file(job.path, error))?
        .len();
    let options = Options {
        block_frames: BLOCK_FRAMES,
    };
    let mut reader = Reader::open_with(file, options).map_err(wrong)?;
    let mut block = Block::default();
    let more = reader.next_block(&mut block).map_err(wrong)?;
    let mut hierarchy = reader.hierarchy().clone();
    let mut bones = Bones::new(&hierarchy);
    bones.push(&block);
    bones.place(&mut hierarchy);
    let rate = convert::rate(reader.header().frame_time.as_ref()).map_err(|error| {
        Error::wrong(error.to_string()).advise("correct the line `Frame Time:` of the file")
    })?;
    Ok(Opened {
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
fn known(job: &mut Job<'_>) -> Result<Option<FileReport>> {
    let name = job.file_name.to_lowercase();
    let known = job.places.hashed(&job.hash).find(|row| {
        let here = row.path.as_deref() == Some(&job.place);
        here || (job.places.is_earlier(row) && row.name.to_lowercase() == name)
    });
    let Some(mut row) = known.filter(|row| row.kind == job.kind).cloned() else {
        return Ok(None);
    };
    let elsewhere = row.path.take().filter(|path| *path != job.place);
    let mut report = FileReport::unchanged(job.path, elsewhere.as_deref());
    job.again = row.recording_id;
    if let Some(id) = row.recording_id {
        report.recording = Some(recordings::recording(job.connection, id)?.name);
    }
    if elsewhere.is_some() {
        // The annotation files beside the file's new place belong to the same take.
        row.path = Some(job.place.clone());
        job.places.add(row);
    }
    Ok(Some(report))
}

/// Reports other files of the corpus that are related to this one: the same movement under another name, or other
/// movement that was imported from its path.
fn compare(job: &Job<'_>, report: &mut FileReport) -> Result<()> {
    let name = |id: i64| recordings::recording(job.connection, id).map(|row| row.name);
    let before = job.places.at(&job.place, job.kind);
    if let Some(id) = before.and_then(|row| row.recording_id) {
        report.findings.push(ReportFinding::warning(
            format!(
                "other movement was imported from this file before, as the recording {:?}; movement is \
                 not replaced, and this is a recording of its own",
                name(id)?
            ),
            "undo the earlier import, if it is not needed any more",
        ));
    }
    let same = job
        .places
        .hashed(&job.hash)
        .find(|row| row.kind == job.kind);
    if let Some((row, id)) = same.and_then(|row| Some((row, row.recording_id?))) {
        let place = row.path.as_ref().unwrap_or(&row.name);
        report.findings.push(ReportFinding::note(format!(
            "its movement is the same as that of the recording {:?}, from {place}",
            name(id)?
        )));
    }
    Ok(())
}

/// Stores the positions of joints as the whole movement gives them, and reports offsets that differ.
fn place_joints(
    job: &Job<'_>,
    track: i64,
    bones: &Bones,
    hierarchy: &mut Hierarchy,
    report: &mut FileReport,
) -> Result<()> {
    let moved = bones.place(hierarchy);
    let (hash, document) = stored_as(hierarchy)?;
    let joints = hierarchy.joints.len();
    let skeleton = recordings::skeleton_stored(job.connection, &hash, joints, &document)?;
    recordings::set_skeleton(job.connection, track, skeleton)?;
    let names: Vec<&str> = moved
        .iter()
        .map(|&joint| hierarchy.joints[joint].name.as_str())
        .collect();
    let owned = names.iter().map(|&name| name.to_owned()).collect();
    report.understood.placed_by_movement = Some(owned);
    if !names.is_empty() {
        report.findings.push(ReportFinding::note(format!(
            "the offsets of {} are not where the movement puts {}: the movement is used, and the stored numbers stay those of the file",
            listed(&names),
            if names.len() == 1 { "it" } else { "them" }
        )));
    }
    Ok(())
}

/// Lists the first few names, and the number of those left out.
fn listed(names: &[&str]) -> String {
    let shown = names.iter().take(6).copied().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(6) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Returns the hash and the JSON under which a skeleton is stored.
fn stored_as(hierarchy: &Hierarchy) -> Result<(String, String)> {
    let document =
        serde_json::to_string(hierarchy).map_err(|error| Error::wrong(error.to_string()))?;
    Ok((hex(&Sha256::digest(document.as_bytes())), document))
}

fn wrong(error: chereme_formats::bvh::raw::BvhError) -> Error {
    let (remedy, line) = (error.kind.remedy(), error.line);
    Error::wrong(error.kind.to_string())
        .at(format!("line {line}"))
        .advise(remedy)
}

/// Guesses of unit and axes with less confidence than this are reported.
pub(super) const SURE: f64 = 0.7;

/// Interpretation of a file's skeleton: unit and axes, channel groups, joint roles, and its first frames.
struct Understood {
    convention: Convention,
    groups: std::collections::BTreeMap<ChannelGroup, Vec<usize>>,
    anatomy: Anatomy,
    first: Block,
}

impl Understood {
    /// Returns the columns of the file that belong to each channel group.
    fn column_groups(&self, hierarchy: &Hierarchy) -> Vec<(ChannelGroup, Vec<usize>)> {
        let columns = |joints: &Vec<usize>| movement::columns_of(hierarchy, joints);
        let groups = self.groups.iter();
        groups
            .map(|(group, joints)| (*group, columns(joints)))
            .collect()
    }
}

fn understand(
    options: &ImportOptions,
    hierarchy: &Hierarchy,
    block: &Block,
    rate: Rate,
    report: &mut FileReport,
) -> Result<Understood> {
    let first = first_frame(hierarchy, block, rate, None)?;
    let skeleton: &Arc<Skeleton> = first.skeleton();
    let roles = options.roles.clone().unwrap_or_default();
    let anatomy = Anatomy::with_roles(skeleton, &roles).map_err(|error| {
        Error::wrong(error.to_string()).advise(Remedy::choice(
            Choice::JointRoles,
            "correct the roles file (--roles), or leave it out",
        ))
    })?;
    let guess = convention(&anatomy, skeleton, &first, hierarchy, block, rate)?;
    let convention = Convention {
        metres_per_unit: options
            .metres_per_unit
            .unwrap_or(guess.convention.metres_per_unit),
        axes: options.axes.unwrap_or(guess.convention.axes),
    };
    describe(report, &guess, &convention, rate, hierarchy);
    describe_anatomy(report, skeleton, &anatomy);
    if guess.unit_name == "unknown" && options.metres_per_unit.is_none() {
        report.findings.push(ReportFinding::warning(
            format!(
                "the file's unit of length cannot be inferred from its skeleton; one unit is taken for {:.4} m",
                convention.metres_per_unit
            ),
            Remedy::choice(Choice::Unit, "say the unit with --unit, such as --unit cm"),
        ));
    }
    report.findings.extend(unread::unusual(&guess, options));
    let doubted = guess.axes_confidence < SURE && guess.unit_name != "unknown";
    if let Some(reason) = guess
        .reasons
        .last()
        .filter(|_| doubted && options.axes.is_none())
    {
        report.findings.push(ReportFinding::warning(
            format!(
                "the directions up and left are uncertain; {} is assumed ({reason})",
                convention.axes
            ),
            Remedy::choice(Choice::Axes, "look at it with `chereme render`; say the axes with --axes, or name the joints in a roles file"),
        ));
    }
    Ok(Understood {
        convention,
        groups: movement::channel_groups(skeleton, &anatomy),
        anatomy,
        first: Block {
            columns: block.columns.clone(),
            ..*block
        },
    })
}

/// Guesses the unit and axes from the first ordinary frame: a bind pose may face another direction.
fn convention(
    anatomy: &Anatomy,
    skeleton: &Skeleton,
    first: &Clip,
    hierarchy: &Hierarchy,
    block: &Block,
    rate: Rate,
) -> Result<ConventionGuess> {
    let pose: Option<ModelPose> = (first.frames() > 0).then(|| first.model_pose(0));
    let guess = anatomy.convention(skeleton, pose.as_ref());
    let head = guess
        .convention
        .clip(&frames(hierarchy, block, rate, None, block.frames)?);
    let sound = Ends::of(&head, &anatomy.clone().with_clip(&head))
        .sound
        .start;
    if sound == 0 {
        return Ok(guess);
    }
    let pose = frames(hierarchy, block, rate, None, sound + 1)?.model_pose(sound);
    Ok(anatomy.convention(skeleton, Some(&pose)))
}

fn first_frame(
    hierarchy: &Hierarchy,
    block: &Block,
    rate: Rate,
    fix: Option<ChannelFix>,
) -> Result<Clip> {
    frames(hierarchy, block, rate, fix, 1)
}

/// Returns the first frames of a block, in the file's unit and axes.
fn frames(
    hierarchy: &Hierarchy,
    block: &Block,
    rate: Rate,
    fix: Option<ChannelFix>,
    count: usize,
) -> Result<Clip> {
    let mut builder =
        ClipBuilder::new(hierarchy, fix).map_err(|error| Error::wrong(error.to_string()))?;
    builder.push(0..block.frames.min(count), |at| block.columns.get(at));
    builder.finish(rate).map_err(|error| {
        Error::wrong(error.to_string())
            .advise("a joint is placed beyond what a number can hold; correct the number")
    })
}

fn describe(
    report: &mut FileReport,
    guess: &ConventionGuess,
    convention: &Convention,
    rate: Rate,
    hierarchy: &Hierarchy,
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

pub(super) fn describe_anatomy(report: &mut FileReport, skeleton: &Skeleton, anatomy: &Anatomy) {
    let name = |joint: usize| skeleton.joint(joint).name.clone();
    let role = |(part, joint, by): (Part, usize, Evidence)| JointRole {
        part: part.to_string(),
        joint: name(joint),
        by,
    };
    let guessed = anatomy
        .found()
        .filter(|(.., how)| *how == Evidence::Topology)
        .count();
    let missing: Vec<String> = anatomy.missing().iter().map(ToString::to_string).collect();
    if guessed > 0 {
        report.findings.push(ReportFinding::note(format!(
            "joints identified by their position in the skeleton, not by name: {guessed}"
        )));
    }
    if !missing.is_empty() {
        let shown = missing
            .iter()
            .take(6)
            .cloned()
            .collect::<Vec<_>>()
            .join(", ");
        let more = missing.len().saturating_sub(6);
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: format!("not found in the skeleton: {shown}{more}"),
            remedy: Some(Remedy::choice(
                Choice::JointRoles,
                "if a joint is one of these, say so in a roles file (--roles)",
            )),
        });
    }
    report.findings.extend(unread::hands(anatomy));
    report.findings.extend(unread::digits(anatomy));
    report.findings.extend(odd_tips(skeleton, anatomy));
    let markers: Vec<String> = anatomy.markers().iter().map(|&joint| name(joint)).collect();
    let body = BodyRead {
        roles: anatomy.found().map(role).collect(),
        joint_names: (0..skeleton.len()).map(name).collect(),
        missing,
        markers: markers.clone(),
    };
    report.understood.body = Some(body.into());
    if !markers.is_empty() {
        let names: Vec<&str> = markers.iter().map(String::as_str).collect();
        report.findings.push(ReportFinding::note(format!(
            "{} optical markers are beside the skeleton and do not count as joints: {}",
            markers.len(),
            listed(&names)
        )));
    }
    for ambiguity in anatomy.ambiguous() {
        report.findings.push(ReportFinding::warning(
            format!(
                "{} was taken to be {:?}; other joints could be it",
                ambiguity.part,
                name(ambiguity.taken)
            ),
            Remedy::choice(
                Choice::JointRoles,
                "say which one in a roles file (--roles)",
            ),
        ));
    }
}

/// Returns the recording without movement that a movement of this length belongs to, if its annotations were imported
/// first. A recording from another folder is another take if it has a capture of any kind, or annotations that end after
/// the movement.
fn without_movement(
    job: &Job<'_>,
    length_us: Option<i64>,
    report: &mut FileReport,
) -> Result<Option<i64>> {
    if let Some(id) = job.places.beside(&job.place) {
        let track = recordings::body_track(job.connection, id)?;
        return Ok(track.is_none().then_some(id));
    }
    let is_bare = |id: i64| -> Result<bool> {
        let tracks = tracks::tracks(job.connection, id)?;
        Ok(tracks.iter().all(|it| it.kind == TrackKind::Media))
    };
    let fits = |id: i64| -> Result<bool> {
        let Some(length) = length_us else {
            return Ok(true);
        };
        let most = length.saturating_add(eaf::BEYOND);
        for tier in tiers::tiers(job.connection, id)? {
            let rows = tiers::annotations(job.connection, tier.id)?;
            if rows.iter().any(|row| row.end_us > most) {
                return Ok(false);
            }
        }
        Ok(true)
    };
    let mut others = job.places.recordings_named(&job.place);
    let named = recordings::recording_named(job.connection, &job.stem)?;
    others.extend(named.map(|row| row.id));
    for id in others {
        if is_bare(id)? && fits(id)? {
            let name = recordings::recording(job.connection, id)?.name;
            report.findings.push(ReportFinding::note(format!(
                "the recording {name:?} of this name had no movement: it has this one now"
            )));
            return Ok(Some(id));
        }
    }
    Ok(None)
}

/// Returns the recording that a movement of this length belongs to: the one that the caller named, one of this name
/// without movement, or a new one.
pub(super) fn insert_recording(
    job: &mut Job<'_>,
    length_us: Option<i64>,
    report: &mut FileReport,
) -> Result<i64> {
    let options = job.options;
    if let Some(into) = &options.into {
        return Ok(address::recording(job.connection, into)?.id);
    }
    compare(job, report)?;
    let signer_id = match &options.signer {
        Some(name) => {
            let new = recordings::find_signer(job.connection, name)?.is_none();
            job.count("signers", usize::from(new));
            let hand = options.handedness.as_deref();
            let signer = recordings::signer_named(job.connection, name, hand)?;
            set_hand(job, signer, report)?;
            Some(signer)
        }
        None => None,
    };
    let id = match without_movement(job, length_us, report)? {
        Some(id) => {
            let (origin, licence) = (options.origin, options.licence.as_deref());
            recordings::describe(job.connection, id, signer_id, origin, licence)?;
            id
        }
        None => {
            job.count("recordings", 1);
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
            recordings::insert_recording(job.connection, &row)?
        }
    };
    Ok(id)
}

fn insert_track(
    job: &mut Job<'_>,
    recording: i64,
    hierarchy: &Hierarchy,
    rate: Rate,
    frame_time: Option<String>,
    found: &Understood,
) -> Result<i64> {
    let (hash, document) = stored_as(hierarchy)?;
    let joints = hierarchy.joints.len();
    let skeleton_id = recordings::skeleton_stored(job.connection, &hash, joints, &document)?;
    job.count("tracks", 1);
    recordings::insert_motion_track(
        job.connection,
        &MotionTrackRow {
            id: 0,
            recording_id: recording,
            name: tracks::free_name(job.connection, recording, "body")?,
            offset_us: job.options.offset_us,
            skeleton_id,
            frames: 0,
            rate_frames: rate.frames(),
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

fn finish(job: &mut Job<'_>, recording: i64, track: i64, frames: u64, rate: Rate) -> Result<()> {
    let count = i64::try_from(frames).unwrap_or(i64::MAX);
    recordings::set_frames(job.connection, track, count)?;
    let end = rate.instant(usize::try_from(frames).unwrap_or(usize::MAX));
    let end = end.shifted(job.options.offset_us);
    recordings::lengthen(job.connection, recording, end.micros())?;
    job.keep(Some(recording), None)?;
    Ok(())
}

/// Returns findings about the ends of thumbs and fingers that are mended for measures and pictures.
fn odd_tips(skeleton: &Skeleton, anatomy: &Anatomy) -> Vec<ReportFinding> {
    let named = |odd: OddTip| {
        let joints =
            (0..skeleton.len()).filter(|&joint| anatomy.odd_tip(skeleton, joint) == Some(odd));
        let names: Vec<&str> = joints.map(|it| skeleton.joint(it).name.as_str()).collect();
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
    let notes = messages.into_iter().flatten().map(ReportFinding::note);
    let long = message(OddTip::Long).map(|message| {
        ReportFinding::warning(
            message,
            Remedy::choice(
                Choice::Unit,
                "the stored numbers stay those of the file; if the fingers are right and the rest is not, say the unit with --unit",
            ),
        )
    });
    let bones = anatomy.long_finger_bones(skeleton);
    let bones: Vec<&str> = bones
        .iter()
        .map(|&(it, _)| skeleton.joint(it).name.as_str())
        .collect();
    let bones = (!bones.is_empty()).then(|| {
        ReportFinding::warning(
            format!(
                "these finger bones are over twice as long as those of the other hand and of the other fingers: {}",
                bones.join(", ")
            ),
            "they are drawn and measured at the usual length, and the stored numbers stay those of the file: mend the skeleton in the program that wrote it, and import the file again",
        )
    });
    notes.chain(long).chain(bones).collect()
}
