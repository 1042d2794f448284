//! The floor below a body on which signs are generated: a capture whose root was misread hangs in the air or below it.

use std::sync::Arc;

use chereme_compose::Material;
use chereme_motion::{Clip, Part, Side};
use sha2::{Digest, Sha256};

use crate::db::motion;
use crate::error::{Error, Result};

/// The largest distance in metres between feet and floor that a body keeps. Signs that follow one another keep their
/// heights up to the same difference.
const STANDS: f64 = 0.6;

/// Returns the height in metres of a body's lowest foot above the floor in its first frame; `None` if the body has no
/// feet or stands on the floor.
pub(super) fn hanging(body: &Material) -> Option<f64> {
    let lowest = lowest(body)?;
    (lowest.abs() > STANDS).then_some(lowest)
}

/// Returns the height of the lowest point of the feet in the first frame.
fn lowest(body: &Material) -> Option<f64> {
    let feet = Side::BOTH.map(|side| body.anatomy.joint(Part::Foot(side)));
    if body.clip.frames() == 0 || feet.contains(&None) {
        return None;
    }
    let skeleton = body.clip.skeleton();
    let model = body.clip.model_pose(0);
    let toes = Side::BOTH.map(|side| body.anatomy.joint(Part::Toes(side)));
    let joints = feet.into_iter().chain(toes).flatten();
    let heights = joints.flat_map(|joint| {
        let tip = body.anatomy.tip(skeleton, joint);
        let tip = tip.map(|tip| model.point(joint, tip).y);
        [Some(model.position(joint).y), tip]
    });
    Some(heights.flatten().fold(f64::INFINITY, f64::min))
}

/// Returns a body that stands on the floor: the same one if it stands there already.
pub(crate) fn grounded(mut body: Material) -> Result<Material> {
    let Some(height) = hanging(&body) else {
        return Ok(body);
    };
    let skeleton = Arc::clone(body.clip.skeleton());
    let frames = body.clip.frames();
    let mut channels = body.clip.channels().to_vec();
    for (joint, channel) in skeleton.joints().iter().zip(&mut channels) {
        if joint.parent.is_some() {
            continue;
        }
        let places = channel.translations.take();
        let mut places = places.unwrap_or_else(|| vec![joint.offset; frames]);
        for place in &mut places {
            place.y -= height;
        }
        channel.translations = Some(places);
    }
    let clip = Clip::new(skeleton, body.clip.rate(), channels);
    body.clip = clip.map_err(|error| Error::wrong(error.to_string()))?;
    let name = format!("{} on the floor", body.hash);
    body.hash = motion::hex(&Sha256::digest(name.as_bytes()));
    Ok(body)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use chereme_motion::{Channel, Instant, Span};

    use crate::address::{Address, Name};
    use crate::{Corpus, CueOptions, ImportOptions, Progress, Staging, starter_files, unheard};

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
        let mut corpus = Corpus::create(&folder.join("c.chereme"), "A").expect("made");
        let files = heights.iter().enumerate().map(|(nth, height)| {
            let path = folder.join(format!("take{nth}.bvh"));
            fs::write(&path, raised(*height)).expect("written");
            path
        });
        let files: Vec<_> = files.collect();
        let mut hear = unheard;
        corpus
            .import(
                &files,
                &ImportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("taken in");
        corpus
    }

    /// Returns the height of the lowest joint, and all channels, of signs made in a corpus of captures that are raised
    /// by these many centimetres.
    fn made(heights: &[f64], signer: Option<&str>) -> Vec<(f64, Vec<Channel>)> {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus_of(folder.path(), heights);
        let staging = Staging {
            signer,
            language: None,
        };
        let notation = "hamfist hamextfingeru hampalml hamchest";
        corpus
            .animate(&[notation], &staging, Some("NOTATED"))
            .expect("animated");
        let options = CueOptions {
            signer: signer.map(str::to_owned),
            ..CueOptions::default()
        };
        corpus.cue("bon", &options, Some("CUED")).expect("cued");
        let signs = ["NOTATED", "CUED"].map(|name| {
            let address = Address::Recording(Name::Text(name.to_owned()));
            let clip = corpus.movement(&address).expect("movement").clip;
            assert!(clip.span() > Span::new(Instant::ZERO, Instant::ZERO).expect("a span"));
            let heights = clip.model_pose(0).positions().to_vec();
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
            for ((lowest, channels), (usual, of_standing)) in
                made(heights, signer).iter().zip(&stands)
            {
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
        let made = corpus.animate(&[path], &Staging::default(), Some("S"));
        made.expect("animated");
        let mut hear = unheard;
        let read = corpus.transcribe(
            &"S".parse().expect("an address"),
            &mut Progress::new(&mut hear),
        );
        let read = read.expect("transcribed").nonmanual;
        let acts: Vec<String> = read.acts().map(|(_, act)| act.name()).collect();
        assert_eq!(acts, ["body.TF"], "only a sign animated again shows them");
    }
}
