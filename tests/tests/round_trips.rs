//! A file of any format is read, stored and read back: every number and every annotation is the one of the file.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use chereme_corpus::{
    Corpus, CorpusAddress, ExportOptions, ExportWhat, ImportOptions, ProgressReceiver, RowName, TrackContent,
    ignore_progress_step,
};
use chereme_formats::eaf::AnnotationTranscript;
use chereme_formats::tracks::{CapturedTrackContent, CapturedTracks};
use chereme_formats::{BodyScene, c3d, curves, eaf, fbx, gltf, keypoints, pose, subtitles, textgrid, trc};
use chereme_motion::{
    Clip, FrameNumberColumn, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, RecordingInstant, Skeleton,
    SkeletonJoint, SpaceConvention, glam::DVec3,
};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The content of a file after it was read.
enum Meaning {
    Tracks(CapturedTracks),
    Scene(Box<BodyScene>),
    Transcript(AnnotationTranscript),
}

/// Reads a file by its extension. Returns `None` for other extensions and for files that the reader refuses.
fn read(path: &Path) -> Option<Meaning> {
    let bytes = fs::read(path).ok()?;
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let folder = path.parent()?.to_owned();
    let tracks = |it: CapturedTracks| Some(Meaning::Tracks(it));
    match ending.as_str() {
        "c3d" => tracks(c3d::read_c3d(&bytes).ok()?.0),
        "trc" => tracks(trc::read_trc_file(&bytes).ok()?.0),
        "pose" => tracks(pose::read_pose_file(&bytes).ok()?.0),
        "csv" | "fap" | "pbtxt" => tracks(curves::read_curves(&bytes).ok()?.0),
        "json" if keypoints::is_keypoints(&bytes) => {
            let mut reader = keypoints::KeypointReader::default();
            reader.push_keypoint_document(None, &bytes).ok()?;
            tracks(reader.finish_keypoint_tracks(None).ok()?.0)
        }
        "json" => tracks(curves::read_curves(&bytes).ok()?.0),
        "glb" | "gltf" | "vrm" => {
            let beside = |name: &str| fs::read(folder.join(name)).ok();
            Some(Meaning::Scene(Box::new(gltf::read_gltf(&bytes, &beside).ok()?.0)))
        }
        "fbx" => Some(Meaning::Scene(Box::new(fbx::read_fbx(&bytes).ok()?.0))),
        "textgrid" => Some(Meaning::Transcript(textgrid::read_textgrid_file(&bytes).ok()?.0)),
        "eaf" => Some(Meaning::Transcript(eaf::read_eaf(&bytes).ok()?.0)),
        "srt" | "vtt" => Some(Meaning::Transcript(subtitles::read_subtitles(&bytes).ok()?.0)),
        _ => None,
    }
}

fn corpus_of(folder: &Path, file: &Path) -> Result<Corpus> {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A")?;
    let mut hear = ignore_progress_step;
    let options = ImportOptions::default();
    let report = corpus.import_paths(&[file.to_owned()], &options, &mut ProgressReceiver::new(&mut hear))?;
    match report.has_refusals() {
        true => Err(format!("{}: {:?}", file.display(), report.files).into()),
        false => Ok(corpus),
    }
}

/// Compares a clip with the stored one; quaternions of opposite sign count as the same rotation.
fn same_clip(is: &Clip, want: &Clip) -> bool {
    let joints = is
        .clip_skeleton()
        .skeleton_joints()
        .iter()
        .zip(want.clip_skeleton().skeleton_joints());
    let names = joints.clone().all(|(a, b)| a.name == b.name && a.parent == b.parent);
    let frames = 0..want.clip_frame_count();
    names
        && is.clip_frame_count() == want.clip_frame_count()
        && is.clip_frame_rate() == want.clip_frame_rate()
        && frames.into_iter().all(|frame| {
            let (a, b) = (is.clip_pose_at(frame), want.clip_pose_at(frame));
            a.rotations == b.rotations && a.translations == b.translations
        })
}

/// Checks a file; returns whether it holds something that is compared.
fn check(path: &Path) -> Result<bool> {
    let Some(meaning) = read(path) else {
        return Ok(false);
    };
    let own = tempfile::tempdir()?;
    let corpus = corpus_of(own.path(), path)?;
    let rows = corpus.recording_tracks(&RowName::Number(1))?;
    let stored = |name: &str| -> Result<TrackContent> {
        let row = rows.iter().find(|row| row.name == name);
        let row = row.ok_or_else(|| format!("{}: no track {name}", path.display()))?;
        Ok(corpus.read_track_content(row.id, None)?)
    };
    match meaning {
        Meaning::Tracks(tracks) => {
            for track in tracks.tracks {
                let same = match (stored(&track.name)?, &track.content) {
                    (TrackContent::Markers(is), CapturedTrackContent::Markers(want)) => is == *want,
                    (TrackContent::Curves(is), CapturedTrackContent::Curves(want)) => is == *want,
                    _ => false,
                };
                assert!(same, "{}: {}", path.display(), track.name);
            }
        }
        Meaning::Scene(scene) => {
            let TrackContent::Skeleton(body) = stored("body")? else {
                return Err(format!("{}: no body", path.display()).into());
            };
            assert!(same_clip(&body.clip, &scene.clip), "{}", path.display());
            if let Some(morphs) = scene.morphs {
                let TrackContent::Curves(face) = stored("face")? else {
                    return Err(format!("{}: no face", path.display()).into());
                };
                assert!(face == morphs, "{}", path.display());
            }
        }
        Meaning::Transcript(want) => {
            // Subtitles have one tier of no known role, which only annotation files hold.
            let is_grid = path.extension().is_some_and(|it| it.eq_ignore_ascii_case("textgrid"));
            let to = own.path().join(if is_grid { "out.TextGrid" } else { "out.eaf" });
            let mut hear = ignore_progress_step;
            corpus.export_corpus(
                &ExportWhat::Address(CorpusAddress::Recording(RowName::Number(1))),
                &to,
                &ExportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )?;
            let Some(Meaning::Transcript(is)) = read(&to) else {
                return Err(format!("{} is not read again", to.display()).into());
            };
            assert_eq!(said(&is), said(&want), "{}", path.display());
        }
    }
    Ok(true)
}

/// Returns tier, times and value of every annotation that is not empty.
fn said(transcript: &AnnotationTranscript) -> Vec<(String, i64, i64, String)> {
    let mut all: Vec<_> = transcript
        .tiers
        .iter()
        .flat_map(|tier| tier.annotations.iter().map(move |it| (tier, it)))
        .filter(|(_, it)| !it.value.trim().is_empty())
        .map(|(tier, it)| {
            let at = [it.span.span_start_instant(), it.span.span_end_instant()].map(RecordingInstant::instant_millis);
            (tier.name.clone(), at[0], at[1], it.value.clone())
        })
        .collect();
    all.sort();
    all
}

fn markers() -> Result<MarkerTrack> {
    let column =
        |phase: f32| FrameNumberColumn::from_single_floats((0..40_u8).map(|at| f32::from(at).sin() + phase).collect());
    let point = |name| MotionMarker::new(name, vec![column(1.0), column(2.0), column(3.0)]);
    let rate = FrameRate::new(100, 1)?;
    let space = MarkerSpace::World(SpaceConvention::MODEL_CONVENTION);
    Ok(MarkerTrack::new(
        FrameTimes::Even(rate),
        space,
        vec![point("LSHO"), point("RSHO"), point("C7")],
    )?)
}

/// Returns small files of every format, written into a folder.
fn samples(folder: &Path) -> Result<Vec<PathBuf>> {
    let skeleton = Skeleton::new(vec![
        SkeletonJoint::new("hips", None, DVec3::Y),
        SkeletonJoint::new("chest", Some(0), DVec3::Y * 0.3),
        SkeletonJoint::new("head", Some(1), DVec3::Y * 0.3),
    ])?;
    let still = Clip::from_rest_pose(skeleton.into(), FrameRate::new(25, 1)?, 9);
    let people =
        "{\"people\":[{\"pose_keypoints_2d\":[10.5,20,0.9,0,0,0]},{\"pose_keypoints_2d\":[300.25,20,0.5,1,2,0.125]}]}";
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("a.glb", gltf::write_glb(&still, &gltf::GlbDescription::default())?),
        ("b.c3d", c3d::write_c3d(&markers()?, RecordingInstant::RECORDING_START)?),
        ("c.trc", trc::write_trc_file("c.trc", &markers()?, RecordingInstant::RECORDING_START)?.into_bytes()),
        (
            "d.csv",
            b"Timecode,BlendShapeCount,JawOpen,HeadYaw\n11:00:00:00.0,61,0.1000000001,0.2\n11:00:00:01.0,61,0.25,-0.3\n".to_vec(),
        ),
        (
            "e.csv",
            b"frame, face_id, timestamp, confidence, success, AU01_r\n1, 0, 0.000, 0.98, 1, 0.51\n2, 0, 0.033, 0.98, 1, 0.6\n".to_vec(),
        ),
        ("f.json", people.into()),
        (
            "g.TextGrid",
            b"\"ooTextFile\" \"TextGrid\" 0 2 <exists> 2 \"IntervalTier\" \"Gloss\" 0 2 2 0 1.25 \"CHAT \"\"x\"\"\" 1.25 2 \"\" \
              \"IntervalTier\" \"Place\" 0 2 1 0 2 \"chin\""
                .to_vec(),
        ),
        ("h.srt", b"1\n00:00:01,000 --> 00:00:02,500\nthe dog\nsleeps\n\n2\n00:00:03,000 --> 00:00:04,000\nthe cat\n".to_vec()),
        ("i.vtt", b"WEBVTT\n\n00:01.000 --> 00:02.500\nthe dog &amp; the cat\n".to_vec()),
    ];
    let mut paths = Vec::new();
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::write(&path, bytes)?;
        paths.push(path);
    }
    Ok(paths)
}

#[test]
fn every_format_is_read_back_from_the_store_as_its_file_has_it() -> Result<()> {
    let own = tempfile::tempdir()?;
    for path in samples(own.path())? {
        assert!(check(&path)?, "{} is compared", path.display());
    }
    Ok(())
}

/// Files of more bytes than this are left to the tests of their formats.
const LARGEST: u64 = 500_000;

#[test]
fn other_peoples_captures_are_read_back_as_their_files_have_them() -> Result<()> {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        return Ok(());
    };
    let mut folders = vec![PathBuf::from(&data).join("motion"), PathBuf::from(&data).join("face")];
    folders.push(PathBuf::from(&data).join("annotation/textgrid"));
    let mut count = 0;
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)?.flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if entry.metadata()?.len() <= LARGEST {
                count += usize::from(check(&path)?);
            }
        }
    }
    assert!(count > 20, "{count}");
    Ok(())
}
