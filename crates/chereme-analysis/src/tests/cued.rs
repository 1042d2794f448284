//! Golden tables of the models of cued speech.

use glam::DVec3;

use crate::cue::cue_face::{FaceModel, share_of};
use crate::cue::cue_hand::HandModel;
use crate::cue::cue_phases::measure_key_phases;
use crate::cue::gauss::{GaussianRecogniser, RecognitionConfusion};
use crate::cue::generate::{self, CueGeneratorSettings, GENERATED_FRAME_RATE, GeneratedTake};
use crate::cue::rigid::RigidMotion;
use crate::cue::session::{
    ExpectedCueKey, FollowedTake, KeyGestures, KeySounds, collect_target_examples, find_key_gestures, find_known,
};
use crate::golden::{compare, put};

fn clean() -> CueGeneratorSettings {
    CueGeneratorSettings {
        hidden: 0.0,
        ..CueGeneratorSettings::default()
    }
}

fn keys(take: &GeneratedTake) -> Vec<ExpectedCueKey> {
    let key = |it: &generate::TrueKey| ExpectedCueKey {
        kind: KeySounds::ALL_KEY_SOUNDS[it.kind],
        placement: it.placement,
        shape: it.shape,
        a1: it.sound[0],
        a2: it.sound[1],
        a3: it.sound[2],
    };
    take.keys.iter().map(key).collect()
}

fn gestures(out: &mut String, all: &[KeyGestures]) {
    for (n, it) in all.iter().enumerate() {
        put(out, format!("key {n} hand {:?}", it.hand));
        put(out, format!("  fingers {:?}", it.fingers));
    }
}

#[test]
fn golden_gestures_and_phases_of_cued_keys() {
    let takes: Vec<GeneratedTake> = (0..4)
        .map(|n| generate::generate_random_sentence(&clean(), n, 8))
        .collect();
    let followed: Vec<FollowedTake> = takes
        .iter()
        .map(|it| FollowedTake::of_truth(&it.true_hand, &it.head, GENERATED_FRAME_RATE))
        .collect();
    let keys: Vec<Vec<ExpectedCueKey>> = takes.iter().map(keys).collect();
    let pairs: Vec<(&FollowedTake, &[ExpectedCueKey])> = followed.iter().zip(keys.iter().map(Vec::as_slice)).collect();
    let mut out = String::new();
    let (recognisers, shown) = find_key_gestures(&pairs).expect("gestures");
    put(&mut out, "## gestures");
    gestures(&mut out, &shown[0]);
    put(&mut out, "## phases");
    let all = keys.iter().map(Vec::as_slice).zip(shown.iter().map(Vec::as_slice));
    for it in measure_key_phases(all) {
        put(&mut out, format!("{it:?}"));
    }
    put(&mut out, "## another take, its markers partly hidden");
    let settings = CueGeneratorSettings {
        hidden: 0.3,
        ..CueGeneratorSettings::default()
    };
    let take = generate::generate_random_sentence(&settings, 17, 5);
    let seen = FollowedTake::of_seen(&take.hand, &take.face, None, GENERATED_FRAME_RATE);
    let truth = FollowedTake::of_truth(&take.true_hand, &take.head, GENERATED_FRAME_RATE);
    gestures(&mut out, &find_known(&truth, &self::keys(&take), &recognisers));
    for frame in (0..seen.followed_frame_count()).step_by(45) {
        put(
            &mut out,
            format!(
                "frame {frame}: {:?} read {:?}",
                seen.dictionary_parameters(frame),
                recognisers.recognise_frame_key(&truth, frame)
            ),
        );
    }
    put(&mut out, "## recognisers");
    let (shapes, placements) = collect_target_examples(&pairs, &shown);
    for (name, examples) in [("shapes", shapes), ("placements", placements)] {
        let learnt = GaussianRecogniser::learn_gaussian_classes(&examples, 0.25).expect("a recogniser");
        let found = RecognitionConfusion::count_confusions(&learnt, &examples);
        put(
            &mut out,
            format!(
                "{name}: rate {:?} counts {:?}",
                found.correct_recognition_rate(),
                found.counts
            ),
        );
        for (class, row) in examples.iter().step_by(5) {
            put(
                &mut out,
                format!(
                    "  {class}: log {:?} of {:?}",
                    learnt.log_of(row, *class),
                    learnt.most_probable_class(row)
                ),
            );
        }
    }
    compare("cued_keys", &out);
}

/// Returns one of nine markers of a frame.
fn few(points: &[DVec3]) -> Vec<DVec3> {
    points.iter().copied().step_by(9).collect()
}

#[test]
fn golden_hands_and_faces_of_cuers() {
    let mut out = String::new();
    let settings = CueGeneratorSettings::default();
    let take = generate::generate_random_sentence(&settings, 3, 4);
    put(&mut out, "## generated");
    put(&mut out, format!("{} frames", take.hand.len()));
    for key in &take.keys {
        put(&mut out, format!("{key:?}"));
    }
    for frame in (0..take.true_hand.len()).step_by(60) {
        put(&mut out, format!("frame {frame}: angles {:?}", take.true_angles[frame]));
        put(&mut out, format!("  hand {:?}", few(&take.true_hand[frame])));
        put(
            &mut out,
            format!(
                "  face {:?} {:?}",
                take.true_parameters[frame],
                few(&take.true_face[frame])
            ),
        );
    }
    let hands =
        HandModel::learn_hand_model(&generate::generate_shape_transitions(&clean(), 1).hand, 8).expect("a hand");
    put(&mut out, "## the hand");
    put(&mut out, format!("explained {:?}", hands.explained_variance_share()));
    let mut before = None;
    for frame in (0..take.hand.len()).step_by(40) {
        let Some(it) = hands.restore_hand_markers(&take.hand[frame], before.as_ref()) else {
            continue;
        };
        put(
            &mut out,
            format!(
                "frame {frame}: {:?} sd {:?}",
                few(&it.points),
                it.sd.iter().step_by(11).collect::<Vec<_>>()
            ),
        );
        put(
            &mut out,
            format!(
                "  seven {:?} tips {:?} {:?}",
                HandModel::shape_distances(&it.points),
                HandModel::pointing_fingertip(&it.points, 1),
                HandModel::pointing_fingertip(&it.points, 4)
            ),
        );
        before = Some(it);
    }
    put(&mut out, "## the face");
    let learnt: Vec<_> = generate::generate_random_sentence(&clean(), 0, 10)
        .face
        .into_iter()
        .step_by(4)
        .collect();
    let faces = FaceModel::learn_face_model(&learnt).expect("a face");
    put(&mut out, format!("weights {:?}", faces.weights));
    for frame in (0..take.face.len()).step_by(60) {
        if let Some((motion, points, sd)) = faces.restore_face_markers(&take.face[frame]) {
            put(
                &mut out,
                format!("frame {frame}: {:?} {:?}", motion.translation, few(&points)),
            );
            put(
                &mut out,
                format!("  sd {:?}", sd.iter().step_by(11).collect::<Vec<_>>()),
            );
        }
    }
    let motion = RigidMotion {
        translation: DVec3::new(10.0, -4.0, 2.5),
        ..take.head[0]
    };
    put(&mut out, format!("share {:?}", share_of(&motion, 0.37)));
    compare("cued_models", &out);
}
