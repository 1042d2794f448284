//! Imports captures in formats other than BVH: markers, curves and skeletons, and tiers of other programs.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use chereme_formats::eaf::Transcript;
use chereme_formats::points::{self as point_tables, PointFile};
use chereme_formats::table::annotations;
use chereme_formats::tracks::{Content, Tracks, another_rate};
use chereme_formats::{Finding, Scene, curves, gltf, keypoints};
use chereme_motion::{Anatomy, Axes, Capture, Clip, Convention, Part, Rate, Side, Skeleton, Space};
use chereme_sign::{Choice, Remedy};

use super::report::ReportFinding;
use super::understood::MovementRead;
use super::{
    FileReport, FileStatus, ImportOptions, Job, again, bvh, eaf, inventory, lexicon, notated,
    points, tracks, whole,
};
use crate::db::motion;
use crate::db::recordings::MotionTrackRow;
use crate::error::{Error, Result};
use crate::movement;
use crate::progress::Progress;
use crate::track::{NewTrack, SkeletonTrack, Track, TrackKind, store};

/// The number of bytes that are enough to see whether a table or JSON document holds curves.
const HEAD: usize = 1 << 14;

/// The remedy for a capture that cannot be read.
const DAMAGED: &str = "mend that place, or export the take again from the program that recorded it";

/// Reads facial animation parameters.
pub(super) fn import_curves(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    job.kind = "curves";
    // The table of a recording's curves has a second ending.
    if let Some(stem) = job.stem.strip_suffix(".curves") {
        job.stem = stem.to_owned();
    }
    import_tracks(job, progress, |bytes| {
        curves::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads a table: markers if its columns are places of points, curves if its first column is a time, tiers if its rows
/// are annotations, otherwise a lexicon.
pub(super) fn import_table(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    let head = head(job.path)?;
    let curves = curves::CurveFile::of(&head);
    let is_face = curves.is_some_and(|it| it != curves::CurveFile::Plain);
    let points = table_of_points(job.path)?.filter(|_| !is_face);
    match points {
        // An exported tier may have columns of numbers, too.
        Some(PointFile::Plain) if curves.is_none() && annotations::is_export(&head) => {
            import_tiers(job, progress)
        }
        Some(_) => import_points(job, progress),
        None if curves.is_some() => import_curves(job, progress),
        None if annotations::is_export(&head) => import_tiers(job, progress),
        None => lexicon::import(job, progress),
    }
}

/// The number of bytes that hold the titles of the widest table of points, and some of its rows.
const HEAD_OF_POINTS: usize = 1 << 20;

/// Returns the kind of a table of points.
fn table_of_points(path: &Path) -> Result<Option<PointFile>> {
    Ok(PointFile::of(&beginning(path, HEAD_OF_POINTS)?))
}

/// The kind of a table of points in `source_file.kind`.
const POINTS: &str = "table of points";

/// Reads points from a table.
fn import_points(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    job.kind = POINTS;
    let rate = job.options.rate;
    import_tracks(job, progress, |bytes| {
        point_tables::read(bytes, rate).map_err(|it| it.to_string())
    })
}

/// Reads JSON: scores of a face, points from film, otherwise an inventory or signs.
pub(super) fn import_json(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    let head = head(job.path)?;
    if curves::CurveFile::of(&head).is_some() {
        return import_curves(job, progress);
    }
    match keypoints::is_keypoints(&head) {
        true => points::import(job, progress),
        false => inventory::import(job, progress),
    }
}

/// Reads a text file: signs that another program exported as JSON, markers if its columns are places of points, tiers if
/// its rows are annotations, otherwise lines of HamNoSys.
pub(super) fn import_text(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    match head(job.path)? {
        head if is_export_of_signs(&head) => lexicon::import(job, progress),
        head => match table_of_points(job.path)? {
            // An exported tier may have columns of numbers, too.
            Some(PointFile::Plain) if annotations::is_export(&head) => import_tiers(job, progress),
            Some(_) => import_points(job, progress),
            None if annotations::is_export(&head) => import_tiers(job, progress),
            None => notated::import_lines(job, progress),
        },
    }
}

/// Returns whether a text file is an export of another program: signs of SLP-AA as JSON, points, or annotations.
pub(super) fn is_export(path: &Path) -> bool {
    let head = head(path).unwrap_or_default();
    let has_points = || table_of_points(path).is_ok_and(|kind| kind.is_some());
    is_export_of_signs(&head) || annotations::is_export(&head) || has_points()
}

/// The kind of a table of annotations in `source_file.kind`.
pub(super) const TIERS: &str = "annotation table";

/// Reads the tiers of a table of annotations; refuses those of an annotation file beside it, which says more.
fn import_tiers(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    job.kind = TIERS;
    for ending in [".eaf", ".elan"] {
        if let Some(stem) = job.stem.strip_suffix(ending) {
            job.stem = stem.to_owned();
        }
    }
    let whole = job.path.with_file_name(format!("{}.eaf", job.stem));
    if whole.is_file() {
        let name = whole.file_name().unwrap_or_default().to_string_lossy();
        let why = Error::wrong(format!("it is an export of {name}, which says more"))
            .at(job.path.display().to_string())
            .advise(Remedy::command("if it holds changes of its own: `chereme annotate CORPUS --in RECORDING from FILE`"));
        return match job.named {
            true => Err(why),
            false => Ok(FileReport::skipped(job.path, &why)),
        };
    }
    eaf::import_as(job, progress, |bytes| {
        annotations::transcript(bytes).map_err(|it| it.to_string())
    })
}

/// Returns whether a text is an export of signs as JSON, which SLP-AA names `.txt`.
fn is_export_of_signs(head: &[u8]) -> bool {
    let text = String::from_utf8_lossy(head);
    text.trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with(['{', '['])
        && text.contains("\"signlevel\"")
}

/// Returns the first bytes of a file.
pub(super) fn head(path: &Path) -> Result<Vec<u8>> {
    beginning(path, HEAD)
}

/// Returns the first `most` bytes of a file.
fn beginning(path: &Path, most: usize) -> Result<Vec<u8>> {
    let fault = |error| Error::file(path, error);
    let mut head = Vec::new();
    let file = File::open(path).map_err(fault)?;
    file.take(most as u64)
        .read_to_end(&mut head)
        .map_err(fault)?;
    Ok(head)
}

/// Reads a skeleton from glTF with its movement, and the weights of morph targets.
pub(super) fn import_gltf(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    let folder = job.path.parent().unwrap_or(Path::new("")).to_owned();
    scene(job, progress, |bytes| {
        let beside = |name: &str| whole::read(&folder.join(name)).ok();
        gltf::read(bytes, &beside).map_err(|it| it.to_string())
    })
}

/// Reads a skeleton from FBX with its movement, and the weights of blend shapes.
#[cfg(feature = "fbx")]
pub(super) fn import_fbx(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    scene(job, progress, |bytes| {
        chereme_formats::fbx::read(bytes).map_err(|it| it.to_string())
    })
}

/// Refuses FBX, which this build of the program does not read.
#[cfg(not(feature = "fbx"))]
pub(super) fn import_fbx(job: &mut Job<'_>, _: &mut Progress<'_>) -> Result<FileReport> {
    Err(super::readers::unread(job.path))
}

/// Stores the body of a scene and the curves of its face, with the same report as for BVH.
fn scene(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
    read: impl FnOnce(&[u8]) -> std::result::Result<(Scene, Vec<Finding>), String>,
) -> Result<FileReport> {
    let known = job.imported_before();
    if let Some(report) = &known
        && !job.options.reads_movement()
    {
        return Ok(report.clone());
    }
    let bytes = job.bytes()?;
    job.report_progress(progress)?;
    let (scene, findings) = read(&bytes).map_err(Error::wrong)?;
    job.report_progress(progress)?;
    if let Some((report, recording)) = known.zip(job.again) {
        return read_again(job, recording, &scene, report, progress);
    }
    let mut report = begun(job, findings);
    let skeleton = scene.clip.skeleton().clone();
    let anatomy = body(job.options, &skeleton)?;
    let convention = facing(job.options, &scene, &anatomy, &mut report);
    describe(&scene, convention, &anatomy, &mut report);
    let moves = scene.clip.frames() > 1;
    let rate = scene.clip.rate();
    let mut markers = tracks::Beside::of(&skeleton, &anatomy);
    markers.push(&scene.clip);
    let markers = markers.track(rate, convention).filter(|_| moves);
    let clock_us = scene.clock.map(chereme_motion::Instant::micros);
    let mut new = vec![NewTrack::new(
        "body",
        Track::Skeleton(SkeletonTrack {
            clip: scene.clip,
            convention,
            roles: job.options.roles.clone(),
        }),
    )];
    new.extend(
        scene
            .morphs
            .map(|morphs| NewTrack::new("face", Track::Curves(morphs))),
    );
    new.extend(markers.map(|markers| NewTrack::new("markers", Track::Markers(markers))));
    for track in &mut new {
        track.clock_us = clock_us;
    }
    let recording = tracks::store(job, new, &mut report)?;
    job.keep(Some(recording), None)?;
    if moves {
        bvh::report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}

/// Returns the parts of the body of a skeleton.
fn body(options: &ImportOptions, skeleton: &Skeleton) -> Result<Anatomy> {
    let roles = options.roles.clone().unwrap_or_default();
    Anatomy::with_roles(skeleton, &roles).map_err(|error| {
        Error::wrong(error.to_string()).advise(Remedy::choice(
            Choice::JointRoles,
            "correct the roles file (--roles), or leave it out",
        ))
    })
}

/// Adds the interpretation of a scene to the report.
fn describe(scene: &Scene, convention: Convention, anatomy: &Anatomy, report: &mut FileReport) {
    let skeleton = scene.clip.skeleton();
    let unit = match convention.metres_per_unit {
        1.0 => "m",
        0.01 => "cm",
        0.001 => "mm",
        _ => "of its own",
    };
    report.understood.movement = Some(MovementRead {
        joints: skeleton.len(),
        channels: None,
        frame_rate: scene.clip.rate().to_string(),
        unit,
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        guess: None,
    });
    bvh::describe_anatomy(report, skeleton, anatomy);
}

/// Reads the movement of a recording again as the options say; its numbers, annotations and other tracks stay.
fn read_again(
    job: &mut Job<'_>,
    recording: i64,
    scene: &Scene,
    mut report: FileReport,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    let Some(standing) = again::own_track(job, recording, false, &mut report)? else {
        return Ok(report);
    };
    let was = &standing.track;
    let skeleton = scene.clip.skeleton();
    let mut fresh = FileReport::new(job.path, FileStatus::Updated);
    let earlier = ImportOptions {
        roles: was.roles(),
        ..ImportOptions::default()
    };
    let guess = facing(&earlier, scene, &body(&earlier, skeleton)?, &mut fresh);
    fresh.findings.clear();
    let options = again::options_again(job.options, was, guess);
    let anatomy = body(&options, skeleton)?;
    let convention = facing(&options, scene, &anatomy, &mut fresh);
    describe(scene, convention, &anatomy, &mut fresh);
    let groups = movement::channel_groups(skeleton, &anatomy);
    let row = MotionTrackRow {
        metres_per_unit: convention.metres_per_unit,
        axes: convention.axes.to_string(),
        roles: options
            .roles
            .as_ref()
            .and_then(|roles| serde_json::to_string(roles).ok()),
        channel_groups: again::groups_json(&groups),
        ..was.row.clone()
    };
    if row.channel_groups != was.row.channel_groups {
        motion::remove_blocks(job.connection, row.id)?;
        store::skeleton_blocks(job.connection, row.id, &groups, &scene.clip)?;
    }
    again::apply(job, &standing, &row, &anatomy, &mut report)?;
    report.understood = fresh.understood;
    if report.status == FileStatus::Updated {
        report.findings.extend(fresh.findings);
        bvh::report_odd_frames(job, recording, &mut report, progress)?;
    }
    Ok(report)
}

/// Returns unit and axes: the caller's if given, otherwise the file's, with the left side corrected by the body's
/// joints. A unit that makes the body a giant or a dwarf is corrected by a power of ten, and a body that lies or hangs
/// upside down is righted.
fn facing(
    options: &ImportOptions,
    scene: &Scene,
    anatomy: &Anatomy,
    report: &mut FileReport,
) -> Convention {
    let stated = scene.convention;
    let seen_in = |frame: usize| {
        let pose = (scene.clip.frames() > frame).then(|| scene.clip.model_pose(frame));
        anatomy.convention(scene.clip.skeleton(), pose.as_ref())
    };
    let found = seen_in(0);
    let axes = found.convention.axes;
    let is_sure = found.axes_confidence >= bvh::SURE;
    // A take may begin in a posture of the file's program.
    let stays = || seen_in(scene.clip.frames() / 2).convention.axes.up() == axes.up();
    let is_righted = is_sure
        && axes.up() != stated.axes.up()
        && stays()
        && legs_continue(&scene.clip, anatomy, axes);
    let agrees = is_sure && axes.up() == stated.axes.up() || is_righted;
    if is_righted && options.axes.is_none() {
        report.findings.push(ReportFinding::warning(
            format!(
                "in the axes that the file states ({}) the body lies or hangs upside down; it is righted: {axes} is assumed",
                stated.axes
            ),
            Remedy::choice(Choice::Axes, "say the axes with --axes, such as --axes +Y,+X, if it does so in truth"),
        ));
    }
    let metres_per_unit = options.metres_per_unit.unwrap_or_else(|| {
        let stature = anatomy.measures().map(|it| it.stature * stated.metres_per_unit);
        let step = stature.map_or(1.0, scale_of_body);
        if step != 1.0 {
            report.findings.push(ReportFinding::warning(
                format!(
                    "in the unit that the file states the body is {:.4} m tall; its lengths are multiplied by {step}",
                    stature.unwrap_or_default()
                ),
                Remedy::choice(Choice::Unit, "say the unit with --unit, such as --unit cm, if the body is as tall as the file says"),
            ));
        }
        stated.metres_per_unit * step
    });
    Convention {
        metres_per_unit,
        axes: options
            .axes
            .unwrap_or(if agrees { axes } else { stated.axes }),
    }
}

/// Returns whether the legs continue the trunk downwards in the first frame, so that the body does not only bend over.
/// A body without feet is believed if its trunk is.
fn legs_continue(clip: &Clip, anatomy: &Anatomy, axes: Axes) -> bool {
    let (skeleton, up) = (clip.skeleton(), axes.up().vector());
    let pose = match clip.frames() {
        0 => skeleton.rest_model_pose(),
        _ => clip.model_pose(0),
    };
    Side::BOTH.into_iter().all(|side| {
        let joint = |part| anatomy.joint(part).map(|joint| pose.position(joint));
        let leg = joint(Part::Thigh(side)).zip(joint(Part::Foot(side)));
        let leg = leg.and_then(|(thigh, foot)| (thigh - foot).try_normalize());
        leg.is_none_or(|leg| leg.dot(up) > bvh::SURE)
    })
}

/// The stature in metres from which a body may be wrong by a factor of three either way.
const PERSON: f64 = 1.6;

/// Returns the power of ten that makes a body of this stature in metres a person; 1 if it may be one.
fn scale_of_body(stature: f64) -> f64 {
    let decades = (PERSON / stature).log10();
    if decades.is_finite() && decades.abs() <= 6.0 {
        10_f64.powi(decades.round() as i32)
    } else {
        1.0
    }
}

fn begun(job: &Job<'_>, findings: Vec<Finding>) -> FileReport {
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    report
}

/// Stores the tracks and events of a file.
pub(super) fn import_tracks(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
    read: impl FnOnce(&[u8]) -> std::result::Result<(Tracks, Vec<Finding>), String>,
) -> Result<FileReport> {
    if let Some(report) = job.imported_before() {
        return with_kept_form(job, report);
    }
    let bytes = job.bytes()?;
    job.report_progress(progress)?;
    let damaged = |why| Error::wrong(why).advise(DAMAGED);
    let (mut document, mut findings) = read(&bytes).map_err(damaged)?;
    if let Some(rate) = job.options.rate {
        findings.extend(set_rate(&mut document, rate));
    }
    set_convention(&mut document, job.options, job.kind == POINTS);
    findings.retain(|finding| !is_answered(finding, job.options));
    job.report_progress(progress)?;
    keep_take(job, document, findings, progress)
}

/// Returns whether the caller said what a finding asks for: the unit or the axes.
fn is_answered(finding: &Finding, options: &ImportOptions) -> bool {
    match finding.remedy {
        Some(Remedy::Choice(Choice::Unit, _)) => options.metres_per_unit.is_some(),
        Some(Remedy::Choice(Choice::Axes, _)) => options.axes.is_some(),
        _ => false,
    }
}

/// Gives measured points of a document the unit and the axes that the caller states, and estimated ones if it `takes_all`:
/// tables state neither.
fn set_convention(document: &mut Tracks, options: &ImportOptions, takes_all: bool) {
    for track in &mut document.tracks {
        let Content::Markers(markers) = &mut track.content else {
            continue;
        };
        let Space::World(stated) = *markers.space() else {
            continue;
        };
        if markers.capture() == Capture::Estimated && !takes_all {
            continue;
        }
        *markers = markers.clone().in_room(Convention {
            metres_per_unit: options.metres_per_unit.unwrap_or(stated.metres_per_unit),
            axes: options.axes.unwrap_or(stated.axes),
        });
    }
}

/// Gives the points from film of a document another rate; other contents keep that of their file. Returns what to say.
fn set_rate(document: &mut Tracks, rate: Rate) -> Option<Finding> {
    let mut found = None;
    for track in &mut document.tracks {
        let Content::Markers(markers) = &mut track.content else {
            continue;
        };
        let Some(stated) = markers.times().rate().filter(|stated| *stated != rate) else {
            continue;
        };
        if markers.capture() == Capture::Estimated {
            *markers = markers.clone().at_rate(rate);
            found = Some(another_rate(stated, rate));
        } else {
            found = found.or_else(|| Some(kept_rate(stated)));
        }
    }
    found
}

fn kept_rate(stated: Rate) -> Finding {
    Finding::note(
        None,
        format!("the file states {stated}, which stays: only points from film take another rate"),
    )
}

/// Adds to the report of a file that was imported before that its points keep their rate, unit and axes, if others are
/// wanted.
pub(super) fn with_kept_form(job: &Job<'_>, mut report: FileReport) -> Result<FileReport> {
    let Some(recording) = job.again else {
        return Ok(report);
    };
    let rows = crate::db::tracks::tracks(job.connection, recording)?;
    let of_points = rows.iter().filter(|row| row.kind == TrackKind::Markers);
    for row in of_points.clone() {
        let form = crate::db::tracks::form(job.connection, row.id)?;
        let (unit, axes) = (job.options.metres_per_unit, job.options.axes);
        let other_unit = form
            .metres_per_unit
            .zip(unit)
            .is_some_and(|(was, is)| was != is);
        let axes = axes.map(|axes| axes.to_string());
        if other_unit || form.axes.zip(axes).is_some_and(|(was, is)| was != is) {
            report.findings.push(ReportFinding::warning(
                "it was imported before, and its points keep their unit and axes",
                Remedy::command(
                    "undo the earlier import, and import it again with --unit and --axes",
                ),
            ));
            break;
        }
    }
    let Some(rate) = job.options.rate else {
        return Ok(report);
    };
    let kept = of_points.filter_map(|row| row.rate).find(|it| *it != rate);
    if let Some(kept) = kept {
        report.findings.push(ReportFinding::warning(
            format!("it was imported before with {kept}, and its points keep that rate"),
            Remedy::command(
                "undo the earlier import, and import it again with --rate, such as --rate 50",
            ),
        ));
    }
    Ok(report)
}

/// Stores the tracks and events of a document.
pub(super) fn keep_take(
    job: &mut Job<'_>,
    document: Tracks,
    findings: Vec<Finding>,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    let new = document.tracks.into_iter().map(|track| NewTrack {
        offset_us: track.offset.micros(),
        clock_us: track.clock.map(chereme_motion::Instant::micros),
        ..NewTrack::new(
            track.name,
            match track.content {
                Content::Markers(markers) => Track::Markers(markers),
                Content::Curves(curves) => Track::Curves(curves),
            },
        )
    });
    let mut report = begun(job, findings);
    let recording = tracks::store(job, new.collect(), &mut report)?;
    if let Some(events) = document.events {
        add_events(job, recording, &events, &mut report, progress)?;
    }
    job.keep(Some(recording), None)?;
    Ok(report)
}

/// Stores events of a capture as a tier, unless the recording already has a tier of their name.
fn add_events(
    job: &mut Job<'_>,
    recording: i64,
    events: &Transcript,
    report: &mut FileReport,
    progress: &mut Progress<'_>,
) -> Result<()> {
    if !eaf::add(job, recording, events, report, progress)? {
        report.findings.push(ReportFinding::warning(
            "the recording has a tier \"events\" already, so the events of this file were left out",
            "rename that tier and import the file again",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use chereme_formats::tracks::FileTrack;
    use chereme_motion::{Column, Marker, Markers, Space, Times};

    use super::*;

    #[test]
    fn points_from_film_take_the_rate_that_is_asked_for_and_measured_ones_keep_theirs() {
        let rate = |frames: u32| Rate::new(frames, 1).expect("a rate");
        let cases = [
            (Capture::Estimated, 25, 25, ""),
            (
                Capture::Estimated,
                50,
                50,
                "the file states 25 fps; the rate",
            ),
            (
                Capture::Measured,
                50,
                25,
                "the file states 25 fps, which stays",
            ),
        ];
        for (capture, asked, expected, start) in cases {
            let point = Marker::new("WRIST", vec![Column::singles(vec![1.0; 4]); 3]);
            let space = Space::World(Convention::MODEL);
            let markers = Markers::new(Times::Even(rate(25)), space, vec![point]);
            let markers = markers.expect("markers").captured(capture);
            let mut document = Tracks::default();
            let track = FileTrack::new("landmarks", Content::Markers(markers));
            document.tracks.push(track);
            let found = set_rate(&mut document, rate(asked));
            let message = found.map_or(String::new(), |it| it.message);
            assert!(message.starts_with(start) && message.is_empty() == start.is_empty());
            let Content::Markers(markers) = &document.tracks[0].content else {
                panic!("no markers");
            };
            assert_eq!(markers.times().rate(), Some(rate(expected)), "{message}");
        }
    }
}
