//! Imports captures in formats other than BVH: markers, curves and skeletons, and tiers of other programs.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use chereme_formats::eaf::AnnotationTranscript;
use chereme_formats::points::{self as point_tables, PointFile};
use chereme_formats::table::annotations;
use chereme_formats::tracks::{CapturedTrackContent, CapturedTracks, another_rate};
use chereme_formats::{BodyScene, ImportFinding, curves, gltf, keypoints};
use chereme_motion::{
    BodyAnatomy, BodyPart, BodySide, CaptureMethod, Clip, FrameRate, MarkerSpace, SignerAxes, Skeleton, SpaceConvention,
};
use chereme_sign::{ErrorRemedy, RemedyChoice};

use super::understood::MovementRead;
use super::{
    FileReport, FileStatus, ImportJob, ImportOptions, import_again, import_bvh, import_eaf, import_inventory,
    import_notated, import_points, import_tracks, import_whole, lexicon,
};
use crate::db::stored_motion;
use crate::db::stored_recordings::MotionTrackRow;
use crate::error::{CorpusError, CorpusResult};
use crate::movement;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;
use crate::track::{NewTrack, SkeletonTrack, TrackContent, TrackKind, track_store};

/// The number of bytes that are enough to see whether a table or JSON document holds curves.
const CURVE_PROBE_BYTES: usize = 1 << 14;

/// The remedy for a capture that cannot be read.
const DAMAGED_CAPTURE_REMEDY: &str = "mend that place, or export the take again from the program that recorded it";

/// Reads facial animation parameters.
pub(super) fn import_curves(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    job.kind = "curves";
    // The table of a recording's curves has a second ending.
    if let Some(stem) = job.stem.strip_suffix(".curves") {
        job.stem = stem.to_owned();
    }
    import_tracks(job, progress, |bytes| {
        curves::read_curves(bytes).map_err(|error| error.to_string())
    })
}

/// Reads a table: markers if its columns are places of points, curves if its first column is a time, tiers if its rows
/// are annotations, otherwise a lexicon.
pub(super) fn import_table(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    let head = read_file_head(job.path)?;
    let curves = curves::CurveFile::detect_curve_file(&head);
    // A plain table of numbers may be points or curves; the titles of a face system are not ambiguous.
    let is_face = curves.is_some_and(|form| form != curves::CurveFile::Plain);
    let points = table_of_points(job.path)?.filter(|_| !is_face);
    match points {
        // An exported tier may have columns of numbers, too.
        Some(PointFile::Plain) if curves.is_none() && annotations::is_export(&head) => import_tiers(job, progress),
        Some(_) => import_points(job, progress),
        None if curves.is_some() => import_curves(job, progress),
        None if annotations::is_export(&head) => import_tiers(job, progress),
        None => lexicon::import_lexicon(job, progress),
    }
}

/// The number of bytes that hold the titles of the widest table of points, and some of its rows.
const HEAD_OF_POINTS: usize = 1 << 20;

/// Returns the kind of a table of points.
fn table_of_points(path: &Path) -> CorpusResult<Option<PointFile>> {
    Ok(PointFile::detect_point_file(&read_leading_bytes(path, HEAD_OF_POINTS)?))
}

/// The kind of a table of points in `source_file.kind`.
pub(super) const POINT_TABLE_KIND: &str = "table of points";

/// Reads points from a table.
fn import_points(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    job.kind = POINT_TABLE_KIND;
    let rate = job.options.rate;
    import_tracks(job, progress, |bytes| {
        point_tables::read_point_table(bytes, rate).map_err(|error| error.to_string())
    })
}

/// Reads JSON: scores of a face, points from film, otherwise an inventory or signs.
pub(super) fn import_json(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    let head = read_file_head(job.path)?;
    if curves::CurveFile::detect_curve_file(&head).is_some() {
        return import_curves(job, progress);
    }
    match keypoints::is_keypoints(&head) {
        true => import_points::import_point_files(job, progress),
        false => import_inventory::import_inventory(job, progress),
    }
}

/// Reads a text file: signs that another program exported as JSON, markers if its columns are places of points, tiers if
/// its rows are annotations, otherwise lines of HamNoSys.
pub(super) fn import_text(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    match read_file_head(job.path)? {
        head if is_export_of_signs(&head) => lexicon::import_lexicon(job, progress),
        head => match table_of_points(job.path)? {
            // An exported tier may have columns of numbers, too.
            Some(PointFile::Plain) if annotations::is_export(&head) => import_tiers(job, progress),
            Some(_) => import_points(job, progress),
            None if annotations::is_export(&head) => import_tiers(job, progress),
            None => import_notated::import_lines(job, progress),
        },
    }
}

/// Returns whether a text file is an export of another program: signs of SLP-AA as JSON, points, or annotations.
pub(super) fn is_export(path: &Path) -> bool {
    let head = read_file_head(path).unwrap_or_default();
    let has_points = || table_of_points(path).is_ok_and(|kind| kind.is_some());
    is_export_of_signs(&head) || annotations::is_export(&head) || has_points()
}

/// The kind of a table of annotations in `source_file.kind`.
pub(super) const ANNOTATION_TABLE_KIND: &str = "annotation table";

/// Reads the tiers of a table of annotations; refuses those of an annotation file beside it, which says more.
fn import_tiers(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    job.kind = ANNOTATION_TABLE_KIND;
    // Exports keep the name of their document, with its ending before their own.
    for ending in [".eaf", ".elan"] {
        if let Some(stem) = job.stem.strip_suffix(ending) {
            job.stem = stem.to_owned();
        }
    }
    let document_path = job.path.with_file_name(format!("{}.eaf", job.stem));
    if document_path.is_file() {
        let name = document_path.file_name().unwrap_or_default().to_string_lossy();
        let why = CorpusError::from_wrong_message(format!("it is an export of {name}, which says more"))
            .with_error_place(job.path.display().to_string())
            .with_command_advice("if it holds changes of its own: `chereme annotate CORPUS --in RECORDING from FILE`");
        return match job.named {
            true => Err(why),
            false => Ok(FileReport::skipped_file_report(job.path, &why)),
        };
    }
    import_eaf::import_as(job, progress, |bytes| {
        annotations::read_elan_table(bytes).map_err(|error| error.to_string())
    })
}

/// Returns whether a text is an export of signs as JSON, which SLP-AA names `.txt`.
fn is_export_of_signs(head: &[u8]) -> bool {
    let text = String::from_utf8_lossy(head);
    text.trim_start_matches('\u{feff}').trim_start().starts_with(['{', '[']) && text.contains("\"signlevel\"")
}

/// Returns the first bytes of a file.
pub(super) fn read_file_head(path: &Path) -> CorpusResult<Vec<u8>> {
    read_leading_bytes(path, CURVE_PROBE_BYTES)
}

/// Returns the first `most` bytes of a file.
fn read_leading_bytes(path: &Path, most: usize) -> CorpusResult<Vec<u8>> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    let mut head = Vec::new();
    let file = File::open(path).map_err(fault)?;
    file.take(most as u64).read_to_end(&mut head).map_err(fault)?;
    Ok(head)
}

/// Reads a skeleton from glTF with its movement, and the weights of morph targets.
pub(super) fn import_gltf(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    let folder = job.path.parent().unwrap_or(Path::new("")).to_owned();
    import_scene(job, progress, |bytes| {
        let sibling_bytes = |name: &str| import_whole::read_whole_file(&folder.join(name)).ok();
        gltf::read_gltf(bytes, &sibling_bytes).map_err(|error| error.to_string())
    })
}

/// Reads a skeleton from FBX with its movement, and the weights of blend shapes.
#[cfg(feature = "fbx")]
pub(super) fn import_fbx(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    import_scene(job, progress, |bytes| {
        chereme_formats::fbx::read_fbx(bytes).map_err(|error| error.to_string())
    })
}

/// Refuses FBX, which this build of the program does not read.
#[cfg(not(feature = "fbx"))]
pub(super) fn import_fbx(job: &mut ImportJob<'_>, _: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    Err(super::readers::unread_format_error(job.path))
}

/// Stores the body of a scene and the curves of its face, with the same report as for BVH.
fn import_scene(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
    read: impl FnOnce(&[u8]) -> std::result::Result<(BodyScene, Vec<ImportFinding>), String>,
) -> CorpusResult<FileReport> {
    let earlier_report = job.imported_before();
    if let Some(report) = &earlier_report
        && !job.options.reads_movement()
    {
        return Ok(report.clone());
    }
    let bytes = job.read_job_bytes()?;
    job.report_progress(progress)?;
    let (scene, findings) = read(&bytes).map_err(CorpusError::from_wrong_message)?;
    job.report_progress(progress)?;
    if let Some((report, recording)) = earlier_report.zip(job.again) {
        return read_again(job, recording, &scene, report, progress);
    }
    let mut report = begin_capture_report(job, findings);
    let skeleton = scene.clip.clip_skeleton().clone();
    let anatomy = anatomy_of_skeleton(job.options, &skeleton)?;
    let convention = determine_scene_convention(job.options, &scene, &anatomy, &mut report);
    describe_scene_reading(&scene, convention, &anatomy, &mut report);
    // A single frame is a model in a pose, whose joints are no markers of a capture.
    let moves = scene.clip.clip_frame_count() > 1;
    let rate = scene.clip.clip_frame_rate();
    let mut markers = import_tracks::SkeletonMarkers::markers_of_anatomy(&skeleton, &anatomy);
    markers.push_clip_frames(&scene.clip);
    let markers = markers.into_marker_track(rate, convention).filter(|_| moves);
    let clock_us = scene.clock.map(chereme_motion::RecordingInstant::instant_micros);
    let mut new = vec![NewTrack::new(
        "body",
        TrackContent::Skeleton(SkeletonTrack {
            clip: scene.clip,
            convention,
            roles: job.options.roles.clone(),
        }),
    )];
    new.extend(
        scene
            .morphs
            .map(|morphs| NewTrack::new("face", TrackContent::Curves(morphs))),
    );
    new.extend(markers.map(|markers| NewTrack::new("markers", TrackContent::Markers(markers))));
    for track in &mut new {
        track.clock_us = clock_us;
    }
    let recording = import_tracks::store_imported_tracks(job, new, &mut report)?;
    job.keep_source_file(Some(recording), None)?;
    if moves {
        import_bvh::report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}

/// Returns the parts of the body of a skeleton.
fn anatomy_of_skeleton(options: &ImportOptions, skeleton: &Skeleton) -> CorpusResult<BodyAnatomy> {
    let roles = options.roles.clone().unwrap_or_default();
    BodyAnatomy::with_roles(skeleton, &roles).map_err(|error| {
        CorpusError::from_wrong_message(error.to_string()).with_advice(ErrorRemedy::choice_remedy(
            RemedyChoice::JointRoles,
            "correct the roles file (--roles), or leave it out",
        ))
    })
}

/// Adds the interpretation of a scene to the report.
fn describe_scene_reading(
    scene: &BodyScene,
    convention: SpaceConvention,
    anatomy: &BodyAnatomy,
    report: &mut FileReport,
) {
    let skeleton = scene.clip.clip_skeleton();
    let unit = match convention.metres_per_unit {
        1.0 => "m",
        0.01 => "cm",
        0.001 => "mm",
        _ => "of its own",
    };
    report.understood.movement = Some(MovementRead {
        joints: skeleton.len(),
        channels: None,
        frame_rate: scene.clip.clip_frame_rate().to_string(),
        unit,
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        guess: None,
    });
    import_bvh::describe_anatomy(report, skeleton, anatomy);
}

/// Reads the movement of a recording again as the options say; its numbers, annotations and other tracks stay.
fn read_again(
    job: &mut ImportJob<'_>,
    recording: i64,
    scene: &BodyScene,
    mut report: FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let Some(standing) = import_again::own_track(job, recording, false, &mut report)? else {
        return Ok(report);
    };
    let was = &standing.track;
    let skeleton = scene.clip.clip_skeleton();
    let mut fresh = FileReport::new(job.path, FileStatus::Updated);
    let earlier = ImportOptions {
        roles: was.manual_joint_roles(),
        ..ImportOptions::default()
    };
    let guess = determine_scene_convention(&earlier, scene, &anatomy_of_skeleton(&earlier, skeleton)?, &mut fresh);
    // Only the guess of the first reading is wanted; its doubts were reported then.
    fresh.findings.clear();
    let options = import_again::options_again(job.options, was, guess);
    let anatomy = anatomy_of_skeleton(&options, skeleton)?;
    let convention = determine_scene_convention(&options, scene, &anatomy, &mut fresh);
    describe_scene_reading(scene, convention, &anatomy, &mut fresh);
    let groups = movement::channel_groups(skeleton, &anatomy);
    let row = MotionTrackRow {
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        roles: options
            .roles
            .as_ref()
            .and_then(|roles| serde_json::to_string(roles).ok()),
        channel_groups: import_again::groups_json(&groups),
        ..was.row.clone()
    };
    if row.channel_groups != was.row.channel_groups {
        stored_motion::remove_blocks(job.connection, row.id)?;
        track_store::skeleton_blocks(job.connection, row.id, &groups, &scene.clip)?;
    }
    import_again::apply_skeleton_reading(job, &standing, &row, &anatomy, &mut report)?;
    report.understood = fresh.understood;
    if report.status == FileStatus::Updated {
        report.findings.extend(fresh.findings);
        import_bvh::report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}

/// Returns unit and axes: the caller's if given, otherwise the file's, with the left side corrected by the body's
/// joints. A unit that makes the body a giant or a dwarf is corrected by a power of ten, and a body that lies or hangs
/// upside down is righted.
fn determine_scene_convention(
    options: &ImportOptions,
    scene: &BodyScene,
    anatomy: &BodyAnatomy,
    report: &mut FileReport,
) -> SpaceConvention {
    let stated = scene.convention;
    let seen_in = |frame: usize| {
        let pose = (scene.clip.clip_frame_count() > frame).then(|| scene.clip.model_pose(frame));
        anatomy.guess_convention(scene.clip.clip_skeleton(), pose.as_ref())
    };
    let first_view = seen_in(0);
    let axes = first_view.convention.axes;
    let is_sure = first_view.axes_confidence >= import_bvh::SURE_GUESS_CONFIDENCE;
    // A take may begin in a posture of the file's program.
    let stays = || {
        seen_in(scene.clip.clip_frame_count() / 2)
            .convention
            .axes
            .up_direction()
            == axes.up_direction()
    };
    // Somebody may lie down, hang or bend over: only a body that does so throughout, with its legs, is wrong.
    let is_righted = is_sure
        && axes.up_direction() != stated.axes.up_direction()
        && stays()
        && legs_continue(&scene.clip, anatomy, axes);
    let agrees = is_sure && axes.up_direction() == stated.axes.up_direction() || is_righted;
    if is_righted && options.axes.is_none() {
        report.findings.push(ReportFinding::finding_warning(
            format!(
                "in the axes that the file states ({}) the body lies or hangs upside down; it is righted: {axes} is assumed",
                stated.axes
            ),
            ErrorRemedy::choice_remedy(RemedyChoice::Axes, "say the axes with --axes, such as --axes +Y,+X, if it does so in truth"),
        ));
    }
    let metres_per_unit = options.metres_per_unit.unwrap_or_else(|| {
        let stature = anatomy
            .anatomy_measures()
            .map(|measures| measures.stature * stated.metres_per_unit);
        let step = stature.map_or(1.0, scale_of_body);
        if step != 1.0 {
            report.findings.push(ReportFinding::finding_warning(
                format!(
                    "in the unit that the file states the body is {:.4} m tall; its lengths are multiplied by {step}",
                    stature.unwrap_or_default()
                ),
                ErrorRemedy::choice_remedy(
                    RemedyChoice::Unit,
                    "say the unit with --unit, such as --unit cm, if the body is as tall as the file says",
                ),
            ));
        }
        stated.metres_per_unit * step
    });
    SpaceConvention {
        metres_per_unit,
        axes: options.axes.unwrap_or(if agrees { axes } else { stated.axes }),
    }
}

/// Returns whether the legs continue the trunk downwards in the first frame, so that the body does not only bend over.
/// A body without feet is believed if its trunk is.
fn legs_continue(clip: &Clip, anatomy: &BodyAnatomy, axes: SignerAxes) -> bool {
    let (skeleton, up) = (clip.clip_skeleton(), axes.up_direction().axis_direction_vector());
    let pose = match clip.clip_frame_count() {
        0 => skeleton.rest_model_pose(),
        _ => clip.model_pose(0),
    };
    BodySide::BOTH_SIDES.into_iter().all(|side| {
        let joint = |part| anatomy.part_joint(part).map(|joint| pose.model_joint_position(joint));
        let leg_ends = joint(BodyPart::Thigh(side)).zip(joint(BodyPart::Foot(side)));
        let leg = leg_ends.and_then(|(thigh, foot)| (thigh - foot).try_normalize());
        leg.is_none_or(|leg| leg.dot(up) > import_bvh::SURE_GUESS_CONFIDENCE)
    })
}

/// The stature in metres from which a body may be wrong by a factor of three either way.
const REFERENCE_STATURE_M: f64 = 1.6;

/// Returns the power of ten that makes a body of this stature in metres a person; 1 if it may be one.
fn scale_of_body(stature: f64) -> f64 {
    let decades = (REFERENCE_STATURE_M / stature).log10();
    // A body of no size, or of more than a million times a person's, is no mistake of a unit.
    if decades.is_finite() && decades.abs() <= 6.0 {
        10_f64.powi(decades.round() as i32)
    } else {
        1.0
    }
}

fn begin_capture_report(job: &ImportJob<'_>, findings: Vec<ImportFinding>) -> FileReport {
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    report
}

/// Stores the tracks and events of a file.
pub(super) fn import_tracks(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
    read: impl FnOnce(&[u8]) -> std::result::Result<(CapturedTracks, Vec<ImportFinding>), String>,
) -> CorpusResult<FileReport> {
    if let Some(report) = job.imported_before() {
        return with_kept_form(job, report);
    }
    let bytes = job.read_job_bytes()?;
    job.report_progress(progress)?;
    let damaged = |why| CorpusError::from_wrong_message(why).with_advice(DAMAGED_CAPTURE_REMEDY);
    let (mut document, mut findings) = read(&bytes).map_err(damaged)?;
    if let Some(rate) = job.options.rate {
        findings.extend(set_rate(&mut document, rate));
    }
    set_convention(&mut document, job.options, job.kind == POINT_TABLE_KIND);
    findings.retain(|finding| !is_answered(finding, job.options));
    job.report_progress(progress)?;
    keep_take(job, document, findings, progress)
}

/// Returns whether the caller said what a finding asks for: the unit or the axes.
fn is_answered(finding: &ImportFinding, options: &ImportOptions) -> bool {
    match finding.remedy {
        Some(ErrorRemedy::Choice(RemedyChoice::Unit, _)) => options.metres_per_unit.is_some(),
        Some(ErrorRemedy::Choice(RemedyChoice::Axes, _)) => options.axes.is_some(),
        _ => false,
    }
}

/// Gives measured points of a document the unit and the axes that the caller states, and estimated ones if it `takes_all`:
/// tables state neither.
fn set_convention(document: &mut CapturedTracks, options: &ImportOptions, takes_all: bool) {
    for track in &mut document.tracks {
        let CapturedTrackContent::Markers(markers) = &mut track.content else {
            continue;
        };
        let MarkerSpace::World(stated) = *markers.marker_space() else {
            continue;
        };
        // Points estimated from film have no unit or axes that a person could know better.
        if markers.marker_capture() == CaptureMethod::Estimated && !takes_all {
            continue;
        }
        *markers = markers.clone().in_room(SpaceConvention {
            metres_per_unit: options.metres_per_unit.unwrap_or(stated.metres_per_unit),
            axes: options.axes.unwrap_or(stated.axes),
        });
    }
}

/// Gives the points from film of a document another rate; other contents keep that of their file. Returns what to say.
fn set_rate(document: &mut CapturedTracks, rate: FrameRate) -> Option<ImportFinding> {
    let mut finding = None;
    for track in &mut document.tracks {
        let CapturedTrackContent::Markers(markers) = &mut track.content else {
            continue;
        };
        let Some(stated) = markers
            .marker_times()
            .even_times_rate()
            .filter(|stated| *stated != rate)
        else {
            continue;
        };
        if markers.marker_capture() == CaptureMethod::Estimated {
            *markers = markers.clone().at_rate(rate);
            finding = Some(another_rate(stated, rate));
        } else {
            finding = finding.or_else(|| Some(kept_rate(stated)));
        }
    }
    finding
}

fn kept_rate(stated: FrameRate) -> ImportFinding {
    ImportFinding::new_note_finding(
        None,
        format!("the file states {stated}, which stays: only points from film take another rate"),
    )
}

/// Adds to the report of a file that was imported before that its points keep their rate, unit and axes, if others are
/// wanted.
pub(super) fn with_kept_form(job: &ImportJob<'_>, mut report: FileReport) -> CorpusResult<FileReport> {
    let Some(recording) = job.again else {
        return Ok(report);
    };
    let rows = crate::db::stored_tracks::load_track_rows(job.connection, recording)?;
    let of_points = rows.iter().filter(|row| row.kind == TrackKind::Markers);
    for row in of_points.clone() {
        let form = crate::db::stored_tracks::load_track_form(job.connection, row.id)?;
        let (unit, axes) = (job.options.metres_per_unit, job.options.axes);
        let other_unit = form.metres_per_unit.zip(unit).is_some_and(|(was, is)| was != is);
        let axes = axes.map(|axes| axes.to_string());
        if other_unit || form.axes.zip(axes).is_some_and(|(was, is)| was != is) {
            report.findings.push(ReportFinding::finding_warning(
                "it was imported before, and its points keep their unit and axes",
                ErrorRemedy::command_remedy("undo the earlier import, and import it again with --unit and --axes"),
            ));
            break;
        }
    }
    let Some(rate) = job.options.rate else {
        return Ok(report);
    };
    let kept = of_points
        .filter_map(|row| row.rate)
        .find(|other_rate| *other_rate != rate);
    if let Some(kept) = kept {
        report.findings.push(ReportFinding::finding_warning(
            format!("it was imported before with {kept}, and its points keep that rate"),
            ErrorRemedy::command_remedy("undo the earlier import, and import it again with --rate, such as --rate 50"),
        ));
    }
    Ok(report)
}

/// Stores the tracks and events of a document.
pub(super) fn keep_take(
    job: &mut ImportJob<'_>,
    document: CapturedTracks,
    findings: Vec<ImportFinding>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let new = document.tracks.into_iter().map(|track| NewTrack {
        offset_us: track.offset.instant_micros(),
        clock_us: track.clock.map(chereme_motion::RecordingInstant::instant_micros),
        ..NewTrack::new(
            track.name,
            match track.content {
                CapturedTrackContent::Markers(markers) => TrackContent::Markers(markers),
                CapturedTrackContent::Curves(curves) => TrackContent::Curves(curves),
            },
        )
    });
    let mut report = begin_capture_report(job, findings);
    let recording = import_tracks::store_imported_tracks(job, new.collect(), &mut report)?;
    if let Some(events) = document.events {
        add_events(job, recording, &events, &mut report, progress)?;
    }
    job.keep_source_file(Some(recording), None)?;
    Ok(report)
}

/// Stores events of a capture as a tier, unless the recording already has a tier of their name.
fn add_events(
    job: &mut ImportJob<'_>,
    recording: i64,
    events: &AnnotationTranscript,
    report: &mut FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    if !import_eaf::add_transcript_tiers(job, recording, events, report, progress)? {
        report.findings.push(ReportFinding::finding_warning(
            "the recording has a tier \"events\" already, so the events of this file were left out",
            "rename that tier and import the file again",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use chereme_formats::tracks::FileTrack;
    use chereme_motion::{FrameNumberColumn, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker};

    use super::*;

    #[test]
    fn points_from_film_take_the_rate_that_is_asked_for_and_measured_ones_keep_theirs() {
        let rate = |frames: u32| FrameRate::new(frames, 1).expect("a rate");
        let cases = [
            (CaptureMethod::Estimated, 25, 25, ""),
            (CaptureMethod::Estimated, 50, 50, "the file states 25 fps; the rate"),
            (CaptureMethod::Measured, 50, 25, "the file states 25 fps, which stays"),
        ];
        for (capture, asked, expected, start) in cases {
            let point = MotionMarker::new("WRIST", vec![FrameNumberColumn::from_single_floats(vec![1.0; 4]); 3]);
            let space = MarkerSpace::World(SpaceConvention::MODEL_CONVENTION);
            let markers = MarkerTrack::new(FrameTimes::Even(rate(25)), space, vec![point]);
            let markers = markers.expect("markers").with_capture_method(capture);
            let mut document = CapturedTracks::default();
            let track = FileTrack::new("landmarks", CapturedTrackContent::Markers(markers));
            document.tracks.push(track);
            let found = set_rate(&mut document, rate(asked));
            let message = found.map_or(String::new(), |it| it.message);
            assert!(message.starts_with(start) && message.is_empty() == start.is_empty());
            let CapturedTrackContent::Markers(markers) = &document.tracks[0].content else {
                panic!("no markers");
            };
            assert_eq!(
                markers.marker_times().even_times_rate(),
                Some(rate(expected)),
                "{message}"
            );
        }
    }
}
