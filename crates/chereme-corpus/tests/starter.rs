//! The starter corpus: its files equal those that the program generates, they are imported without warnings, and a body
//! can perform the movement.

#[path = "../examples/make_starter/all.rs"]
mod all;

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use all::Take;
use chereme_compose::GeneratedMovement;
use chereme_formats::bvh::raw::{BvhReader, MotionBlock};
use chereme_formats::roles::{TierMapping, guess_tiers};
use chereme_formats::{eaf, lexicon};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, Clip, ModelPose};
use chereme_sign::TierRole;
use chereme_sign::inventory::builtin_by_id;

static MADE: LazyLock<Vec<(Take, GeneratedMovement)>> = LazyLock::new(all::performances);

fn committed(name: &str) -> Vec<u8> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    fs::read(folder.join(name)).unwrap_or_else(|error| panic!("corpus/{name}: {error}"))
}

/// Compares files; numbers may differ in their last digit, since sines differ between machines.
fn same(a: &[u8], b: &[u8]) -> bool {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
    let (a, b) = (text(a), text(b));
    let (mut a, mut b) = (a.split_ascii_whitespace(), b.split_ascii_whitespace());
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(x), Some(y)) if x == y => {}
            (Some(x), Some(y)) => match (x.parse::<f64>(), y.parse::<f64>()) {
                (Ok(x), Ok(y)) if (x - y).abs() < 0.0101 => {}
                _ => return false,
            },
            _ => return false,
        }
    }
}

#[test]
fn the_files_equal_those_that_the_program_generates() {
    let remedy = "run: cargo run -p chereme-corpus --example make_starter";
    let files = all::files(&MADE);
    for (name, bytes) in &files {
        let there = committed(name);
        let equal = if name.ends_with(".bvh") {
            same(&there, bytes)
        } else {
            there == *bytes
        };
        assert!(equal, "corpus/{name} is not what the program makes; {remedy}");
    }
    let whole: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    assert!(whole < 3_600_000, "{whole} bytes are much to embed");
}

#[test]
fn recordings_read_without_a_finding() {
    for (take, made) in MADE.iter() {
        let bytes = committed(&format!("{}.bvh", take.stem));
        let mut reader = BvhReader::open_bvh(&bytes[..]).expect("a hierarchy");
        assert_eq!(reader.bvh_hierarchy().joints.len(), 61);
        let mut block = MotionBlock::default();
        while reader.next_block(&mut block).expect("rows of numbers") {}
        let summary = reader.finish_bvh_reading();
        assert_eq!(summary.frames as usize, made.clip.clip_frame_count());
        assert!(summary.findings.is_empty(), "{}: {:?}", take.stem, summary.findings);
    }
}

#[test]
fn annotations_read_without_a_finding_and_every_value_is_known() {
    for (take, made) in MADE.iter() {
        let bytes = committed(&format!("{}.eaf", take.stem));
        let (transcript, findings) = eaf::read_eaf(&bytes).expect("an annotation document");
        assert!(findings.is_empty(), "{}: {findings:?}", take.stem);
        assert!(transcript.transcript_end() <= made.clip.clip_span().span_end_instant());
        let guesses = guess_tiers(&transcript, &TierMapping::default());
        let mut fields = BTreeSet::new();
        for (tier, guess) in transcript.tiers.iter().zip(guesses) {
            let role = guess
                .role
                .unwrap_or_else(|| panic!("{:?} is not understood", tier.name));
            let TierRole::Component { component, feature } = role else {
                continue;
            };
            let known = fields.insert((
                component,
                feature.clone(),
                guess.hand.map(|hand| hand.annotated_hands_name()),
            ));
            assert!(known, "{:?} says what another tier says", tier.name);
            let named = tier.vocabulary.as_deref().expect("a vocabulary");
            if named == "phases" {
                continue;
            }
            let inventory = builtin_by_id(named).expect("an inventory");
            assert_eq!(
                (inventory.component, &inventory.feature),
                (component, &feature),
                "{:?}",
                tier.name
            );
            for annotation in &tier.annotations {
                assert!(
                    inventory.value_by_id(&annotation.value).is_some(),
                    "{} on {:?}",
                    annotation.value,
                    tier.name
                );
            }
        }
        assert_eq!(fields.len(), 2 * 7 + 2);
    }
}

#[test]
fn the_lexicon_reads_and_uses_the_inventories() {
    let (lexicon, findings) =
        lexicon::read_lexicon(&committed("lexicon.csv"), &TierMapping::default()).expect("a table");
    assert!(findings.is_empty(), "{findings:?}");
    assert_eq!(lexicon.entries.len(), 14);
    let known = |id: &str, value: &str| builtin_by_id(id).is_some_and(|it| it.value_by_id(value).is_some());
    let recorded: BTreeSet<&str> = ["LION", "POULE", "VACHE"].into();
    for entry in &lexicon.entries {
        assert_eq!(entry.translations.len(), 2, "{}", entry.gloss);
        let taken = MADE
            .iter()
            .any(|(take, _)| take.signs.iter().any(|sign| sign.gloss == entry.gloss));
        assert_eq!(taken, recorded.contains(&*entry.gloss), "{}", entry.gloss);
        for coding in &entry.codings {
            let value = coding.reading.reading_value().expect("a value");
            let inventories: &[&str] = match coding.component.component_name() {
                "configuration" => &["configurations"],
                "placement" => &["placements"],
                "movement" => &["movements", "directions", "repetitions"],
                _ => &["palm", "fingers"],
            };
            assert!(
                inventories.iter().any(|id| known(id, value)),
                "{}: {value}",
                entry.gloss
            );
        }
    }
}

#[test]
fn the_animator_performs_the_notation_and_nothing_jumps() {
    let mut pulled = Vec::new();
    for (take, made) in MADE.iter() {
        let clip = &made.clip;
        // Three warnings are expected: some letters point beyond the limits of the wrist, hands that touch lie in each
        // other by the thickness of a finger, or are moved apart, and letters that move are bent for the arm's comfort.
        let missed = |warning: &&String| {
            let expected = ["turned up to", "each other", "stays comfortable"];
            !expected.iter().any(|words| warning.contains(words))
        };
        let warnings: Vec<&String> = made.report.warnings.iter().filter(missed).collect();
        assert!(warnings.is_empty(), "{}: {warnings:?}", take.stem);
        for (joint, channel) in clip.clip_skeleton().skeleton_joints().iter().zip(clip.joint_channels()) {
            for (frame, pair) in channel.rotations.windows(2).enumerate() {
                let speed = pair[0].angle_between(pair[1]).to_degrees() * clip.clip_frame_rate().per_second();
                if speed >= 1100.0 {
                    pulled.push(format!(
                        "{} {} frame {frame}: {speed:.0} degrees a second",
                        take.stem, joint.name
                    ));
                }
            }
        }
        for side in BodySide::BOTH_SIDES {
            let arm = BodyAnatomy::detect_anatomy(clip.clip_skeleton())
                .arm_chain(side)
                .expect("an arm");
            for (name, joint) in [("elbow", arm.forearm), ("wrist", arm.hand)] {
                let path = clip.joint_path(joint);
                let pull = path.windows(3).map(|p| (p[2] - p[1] * 2.0 + p[0]).length() * 3600.0);
                let (frame, most) = pull
                    .enumerate()
                    .fold((0, 0.0), |most, now| if now.1 > most.1 { now } else { most });
                if most >= 100.0 {
                    pulled.push(format!(
                        "{} {} {name} frame {frame}: {most:.0} m/s2",
                        take.stem,
                        side.body_side_name()
                    ));
                }
            }
        }
    }
    assert!(pulled.is_empty(), "{pulled:?}");
}

#[test]
fn hands_stay_out_of_the_trunk_and_of_each_other() {
    for (take, made) in MADE.iter() {
        let clip = &made.clip;
        let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
        // Skin is soft: in these takes hands lie on each other or hit.
        let deepest = match take.stem {
            "escargot" | "punir" => -0.021,
            _ => 0.0,
        };
        for frame in (0..clip.clip_frame_count()).step_by(3) {
            let model = clip.model_pose(frame);
            let body = anatomy.body_frame(&model).expect("a trunk");
            let hands = BodySide::BOTH_SIDES.map(|side| bones(clip, &anatomy, &model, side));
            for (_, end, radius) in hands.iter().flatten() {
                let at = body.direction_to_body(*end - body.origin);
                let inside = DVec3::new(at.x / 0.155, 0.0, at.z / 0.105).length();
                let beside = !(-0.42..0.0).contains(&at.y) || (inside - 1.0) * 0.105 > radius - 0.02;
                assert!(beside, "{} frame {frame}: a hand is in the trunk", take.stem);
            }
            for a in &hands[0] {
                for b in &hands[1] {
                    let apart = distance(a, b);
                    assert!(
                        apart > deepest,
                        "{} frame {frame}: the hands are in each other",
                        take.stem
                    );
                }
            }
        }
    }
}

type Bone = (DVec3, DVec3, f64);

/// Returns the bones below a wrist with their radius in metres.
fn bones(clip: &Clip, anatomy: &BodyAnatomy, model: &ModelPose, side: BodySide) -> Vec<Bone> {
    let skeleton = clip.clip_skeleton();
    let bone = |joint: usize| {
        let name = &skeleton.joint_at(joint).name;
        let radius = if name.contains("InHand") { 0.013 } else { 0.008 };
        let child = skeleton
            .joint_children(joint)
            .first()
            .map(|&child| model.model_joint_position(child));
        let end = model
            .bone_tip_position(skeleton, joint)
            .or(child)
            .unwrap_or(model.model_joint_position(joint));
        (model.model_joint_position(joint), end, radius)
    };
    anatomy.finger_joints(side).into_iter().map(bone).collect()
}

/// Returns the distance of two bones from surface to surface, to a few millimetres.
fn distance((a, b, thick): &Bone, (c, d, other): &Bone) -> f64 {
    let along = *d - *c;
    let points = (0..=4).map(|n| a.lerp(*b, f64::from(n) / 4.0));
    let apart = points.map(|point| {
        let share = (point - *c).dot(along) / along.length_squared().max(1e-12);
        point.distance(*c + along * share.clamp(0.0, 1.0))
    });
    apart.fold(f64::MAX, f64::min) - thick - other
}

#[test]
fn hands_touch_the_annotated_contacts() {
    let snail = places("escargot", [0.0, 1.0], ["right-palm", "left-hand-back"]);
    for [palm, back] in snail {
        let apart = palm.distance(back);
        assert!(apart < 0.07, "the snail is {apart} m off the hand");
        let above = palm.y - back.y;
        assert!((0.015..0.05).contains(&above), "it is {above} m above it");
    }
    let temple = places("penser", [0.8, 1.0], ["right-index-tip", "right-temple"]);
    for [tip, temple] in temple {
        let apart = tip.distance(temple);
        assert!(apart < 0.045, "the index is {apart} m off the temple");
    }
    let chest = places("aimer", [0.0, 0.3], ["right-palm", "chest"]);
    for [palm, chest] in chest {
        let apart = palm.z - chest.z;
        assert!(apart.abs() < 0.04, "the palm is {apart} m off the chest");
    }
}

#[test]
fn paws_of_a_walking_cat_are_in_front_in_turn() {
    let places = places("chat", [0.0, 1.0], ["right-wrist", "left-wrist"]);
    let ahead: Vec<f64> = places.iter().map(|[right, left]| right.z - left.z).collect();
    let far = ahead.iter().filter(|ahead| ahead.abs() > 0.05);
    let sides: Vec<bool> = far.map(|ahead| *ahead > 0.0).collect();
    let turns = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(turns >= 4, "they change {turns} times");
}

/// Returns the positions of landmarks in every frame of a recording's only sign, between two shares of its length.
fn places<const N: usize>(stem: &str, [from, to]: [f64; 2], names: [&str; N]) -> Vec<[DVec3; N]> {
    let (_, made) = MADE.iter().find(|(take, _)| take.stem == stem).expect("a recording");
    let clip = &made.clip;
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let sign = all::glosses(made)[0];
    let seconds = sign.span_end_instant().instant_seconds() - sign.span_start_instant().instant_seconds();
    let frame = |share: f64| {
        let time = sign.span_start_instant().instant_seconds() + share * seconds;
        (time * clip.clip_frame_rate().per_second()) as usize
    };
    let at = |frame: usize| {
        let model = clip.model_pose(frame);
        names.map(|name| {
            let place = anatomy.landmark_place_position(clip.clip_skeleton(), &model, name);
            place.expect("a landmark")
        })
    };
    (frame(from)..=frame(to)).map(at).collect()
}
