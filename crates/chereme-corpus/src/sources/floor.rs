//! The floor below a body on which signs are generated: a capture whose root was misread hangs in the air or below it.

use std::sync::Arc;

use chereme_compose::MovementMaterial;
use chereme_motion::{BodyPart, BodySide, Clip};
use sha2::{Digest, Sha256};

use crate::db::stored_motion;
use crate::error::{CorpusError, CorpusResult};

/// The largest distance in metres between feet and floor that a body keeps. Signs that follow one another keep their
/// heights up to the same difference.
const MAX_FLOOR_DISTANCE_METRES: f64 = 0.6;

/// Returns the height in metres of a body's lowest foot above the floor in its first frame; `None` if the body has no
/// feet or stands on the floor.
pub(super) fn hanging_height(body: &MovementMaterial) -> Option<f64> {
    let lowest = lowest_foot_height(body)?;
    (lowest.abs() > MAX_FLOOR_DISTANCE_METRES).then_some(lowest)
}

/// Returns the height of the lowest point of the feet in the first frame.
fn lowest_foot_height(body: &MovementMaterial) -> Option<f64> {
    let feet = BodySide::BOTH_SIDES.map(|side| body.anatomy.part_joint(BodyPart::Foot(side)));
    // With one foot only, a leg that is raised would count as the height of the body.
    if body.clip.clip_frame_count() == 0 || feet.contains(&None) {
        return None;
    }
    let skeleton = body.clip.clip_skeleton();
    let model = body.clip.model_pose(0);
    let toes = BodySide::BOTH_SIDES.map(|side| body.anatomy.part_joint(BodyPart::Toes(side)));
    let joints = feet.into_iter().chain(toes).flatten();
    // The tips of toes reach lower than their joints when somebody stands on them.
    let heights = joints.flat_map(|joint| {
        let tip_offset = body.anatomy.joint_tip(skeleton, joint);
        let tip = tip_offset.map(|tip| model.joint_point_to_model(joint, tip).y);
        [Some(model.model_joint_position(joint).y), tip]
    });
    Some(heights.flatten().fold(f64::INFINITY, f64::min))
}

/// Returns a body that stands on the floor: the same one if it stands there already.
pub(crate) fn ground_body(mut body: MovementMaterial) -> CorpusResult<MovementMaterial> {
    let Some(height) = hanging_height(&body) else {
        return Ok(body);
    };
    let skeleton = Arc::clone(body.clip.clip_skeleton());
    let frames = body.clip.clip_frame_count();
    let mut channels = body.clip.joint_channels().to_vec();
    for (joint, channel) in skeleton.skeleton_joints().iter().zip(&mut channels) {
        if joint.parent.is_some() {
            continue;
        }
        let translations = channel.translations.take();
        // A root without places of its own stands at its offset throughout.
        let mut places = translations.unwrap_or_else(|| vec![joint.offset; frames]);
        for place in &mut places {
            place.y -= height;
        }
        channel.translations = Some(places);
    }
    let clip = Clip::new(skeleton, body.clip.clip_frame_rate(), channels);
    body.clip = clip.map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    // Moved movement is another material, and needs another hash.
    let name = format!("{} on the floor", body.hash);
    body.hash = stored_motion::to_hex_text(&Sha256::digest(name.as_bytes()));
    Ok(body)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use chereme_motion::{JointChannel, RecordingInstant, TimeSpan};

    use crate::address::{CorpusAddress, RowName};
    use crate::{
        Corpus, CueOptions, ImportOptions, NotationStaging, ProgressReceiver, ignore_progress_step, starter_files,
    };

    /// Returns a starter capture that is raised by this many centimetres.
    fn raised(centimetres: f64) -> String {
        let (_, bytes) = starter_files()
            .find(|(file, _)| file.ends_with("chat.bvh"))
            .expect("a starter capture");
        let text = String::from_utf8(bytes.to_vec()).expect("text");
        let (head, frames) = text.split_once("MOTION").expect("frames");
        let mut lines = frames.lines();
        let mut raised = format!("{head}MOTION");
        for line in lines.by_ref().take(3) {
            raised += &format!("{line}\n");
        }
        for line in lines {
            let numbers = line.split_whitespace().enumerate().map(|(nth, number)| {
                let value: f64 = number.parse().expect("a number");
                let value = if nth == 1 { value + centimetres } else { value };
                value.to_string()
            });
            raised += &(numbers.collect::<Vec<_>>().join(" ") + "\n");
        }
        raised
    }

    /// Returns a corpus of captures that are raised by these many centimetres.
    fn corpus_of(folder: &std::path::Path, heights: &[f64]) -> Corpus {
        let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
        let files = heights.iter().enumerate().map(|(nth, height)| {
            let path = folder.join(format!("take{nth}.bvh"));
            fs::write(&path, raised(*height)).expect("written");
            path
        });
        let files: Vec<_> = files.collect();
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("taken in");
        corpus
    }

    /// Returns the height of the lowest joint, and all channels, of signs made in a corpus of captures that are raised
    /// by these many centimetres.
    fn made(heights: &[f64], signer: Option<&str>) -> Vec<(f64, Vec<JointChannel>)> {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of(folder.path(), heights);
        let staging = NotationStaging { signer, language: None };
        let notation = "hamfist hamextfingeru hampalml hamchest";
        corpus
            .animate_notation(&[notation], &staging, Some("NOTATED"))
            .expect("animated");
        let options = CueOptions {
            signer: signer.map(str::to_owned),
            ..CueOptions::default()
        };
        corpus
            .generate_cued_speech("bon", &options, Some("CUED"))
            .expect("cued");
        let signs = ["NOTATED", "CUED"].map(|name| {
            let address = CorpusAddress::Recording(RowName::Text(name.to_owned()));
            let clip = corpus.movement_at_address(&address).expect("movement").clip;
            assert!(
                clip.clip_span()
                    > TimeSpan::new(RecordingInstant::RECORDING_START, RecordingInstant::RECORDING_START)
                        .expect("a span")
            );
            let heights = clip.model_pose(0).model_joint_positions().to_vec();
            let lowest = heights.iter().map(|at| at.y).fold(f64::INFINITY, f64::min);
            (lowest, clip.into_channels())
        });
        signs.into()
    }

    #[test]
    fn signs_stand_on_the_floor_whatever_body_they_are_made_on() {
        let stands = made(&[0.0], None);
        for (heights, signer, same) in [
            (&[-97.0][..], None, false),
            (&[-97.0], Some("take0"), false),
            (&[200.0], None, false),
            (&[-97.0, 0.0], None, true),
            (&[-97.0, 0.0], Some("take0"), false),
            (&[0.0, 200.0], None, true),
        ] {
            for ((lowest, channels), (usual, of_standing)) in made(heights, signer).iter().zip(&stands) {
                let apart = (lowest - usual).abs();
                assert!(apart < 0.15, "{heights:?} {signer:?}: {lowest} {usual}");
                if same {
                    assert_eq!(channels, of_standing, "{heights:?}");
                }
            }
        }
        // A body a little above the floor keeps its height.
        for ((lowest, _), (usual, _)) in made(&[20.0], None).iter().zip(&stands) {
            assert!((lowest - usual - 0.2).abs() < 1e-6, "{lowest} {usual}");
        }
    }

    #[test]
    fn signs_made_on_a_hanging_body_are_transcribed_by_animating_them_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of(folder.path(), &[-97.0]);
        let file = folder.path().join("s.sigml");
        let sigml = r#"<sigml><hamgestural_sign gloss="S"><sign_nonmanual>
<body_tier><body_movement movement="TF"/></body_tier></sign_nonmanual><sign_manual>
<handconfig handshape="flat"/><handconfig extfidir="u" palmor="l"/><location_bodyarm location="chest"/>
</sign_manual></hamgestural_sign></sigml>"#;
        fs::write(&file, sigml).expect("written");
        let path = file.to_str().expect("a path");
        let made = corpus.animate_notation(&[path], &NotationStaging::default(), Some("S"));
        made.expect("animated");
        let mut hear = ignore_progress_step;
        let read = corpus.transcribe_movement(&"S".parse().expect("an address"), &mut ProgressReceiver::new(&mut hear));
        let read = read.expect("transcribed").nonmanual;
        let acts: Vec<String> = read.acts_by_tier().map(|(_, act)| act.act_curve_name()).collect();
        assert_eq!(acts, ["body.TF"], "only a sign animated again shows them");
    }
}
