//! Bodies with missing parts, and operators in any order.

use super::*;
use crate::{evaluate_recipe, resolve_recipe};

/// Returns a shelf whose first sign's body lacks the joints whose names start with `without`.
fn lacking(without: &str) -> Shelf {
    let mut shelf = Shelf::new();
    let old = shelf.materials["ESCARGOT"].clone();
    let skeleton = old.clip.clip_skeleton();
    let lost: Vec<usize> = (0..skeleton.len())
        .filter(|&joint| {
            skeleton
                .joint_ancestors(joint)
                .any(|above| skeleton.joint_at(above).name.starts_with(without))
        })
        .collect();
    let kept: Vec<usize> = (0..skeleton.len()).filter(|joint| !lost.contains(joint)).collect();
    let joints = kept.iter().map(|&joint| chereme_motion::SkeletonJoint {
        parent: skeleton
            .joint_parent(joint)
            .and_then(|p| kept.iter().position(|&k| k == p)),
        ..skeleton.joint_at(joint).clone()
    });
    let smaller = std::sync::Arc::new(chereme_motion::Skeleton::new(joints.collect()).expect("a tree"));
    let channels = kept
        .iter()
        .map(|&joint| old.clip.joint_channel(joint).clone())
        .collect();
    let sign = shelf.materials.get_mut("ESCARGOT").expect("there");
    sign.anatomy = std::sync::Arc::new(chereme_motion::BodyAnatomy::detect_anatomy(&smaller));
    sign.clip = Clip::new(smaller, old.clip.clip_frame_rate(), channels).expect("a clip");
    shelf
}

#[test]
fn operators_name_the_part_that_a_body_lacks() {
    for (without, step, want) in [
        ("Left", "swap", "no left arm"),
        ("Left", "place both by up 5cm", "no left arm"),
        ("Left", "mirror right", "no left arm"),
        ("RightHandI", "orient right palm up", ""),
        ("RightHand", "configure right U", "right hand has no fingers"),
        ("RightHandIndex", "configure right U", "right hand has no fingers"),
        ("Neck", "nonmanual from BOL", "no head"),
        ("Neck", "face head=nodding", "no head"),
        ("Neck", "face brows=raised", ""),
        ("Left", "place right by up 5cm", ""),
        ("Left", "reverse | repeat 2", ""),
    ] {
        let recipe: crate::Recipe = format!("ESCARGOT | {step}").parse().expect(step);
        let made = resolve_recipe(&recipe, &lacking(without)).and_then(|resolved| evaluate_recipe(&resolved));
        match made {
            Ok(_) => assert_eq!(want, "", "{without} {step}"),
            Err(error) => {
                let error = error.to_string();
                assert!(!want.is_empty() && error.contains(want), "{without} {step}: {error}");
            }
        }
    }
}

/// Steps of every kind, some of them impossible.
const STEPS: [&str; 28] = [
    "configure right U",
    "configure both from BOL",
    "configure left S, _ via 0s",
    "configure right H via learned 2s",
    "place both by left 10cm",
    "place right at chin with index",
    "place left near LIMACE using fabrik",
    "place both at -10cm,110cm,40cm",
    "place right by forward 300%",
    "reverse",
    "swap",
    "mirror",
    "mirror left",
    "repeat 2",
    "repeat 3 scale 0.5 tempo 3 gap 0s",
    "orient both palm up",
    "orient right fingers down by 300deg about up",
    "amplify both 0",
    "amplify right 2",
    "travel both up 10cm then down 10cm in 0s",
    "travel right left 5cm in 9s",
    "retime 5%",
    "retime to 0.01s",
    "retime 2, 1, 50%",
    "nonmanual from CHAT",
    "from me to you",
    "face brows=raised mouth=o head=shaking over 0.1s..0.3s",
    "mouth \"bOl\"",
];
const SOURCES: [&str; 6] = [
    "ESCARGOT",
    "LIMACE",
    "BOL",
    "spell USB on signer:2",
    "point both at left on signer:1 via 0s",
    "(BOL then via 0s CHAT)",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_order_of_operators_gives_movement_or_says_why_not(
        source in proptest::sample::select(SOURCES.to_vec()),
        steps in proptest::collection::vec(proptest::sample::select(STEPS.to_vec()), 1..5),
    ) {
        let text = format!("{source} | {}", steps.join(" | "));
        match make(&text) {
            Ok(made) => {
                bones_keep_their_lengths(&made.clip);
                let end = made.clip.clip_span().span_end_instant();
                for note in &made.notes {
                    prop_assert!(note.span.span_end_instant() <= end, "{}: {:?} ends after {}", text, note, end);
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains("stored inputs"), "{}: {}", text, error),
        }
    }
}

#[test]
fn elbows_do_not_jump_unless_the_source_does() {
    for recipe in [
        "ESCARGOT | place both by left 10cm up 10cm",
        "LIMACE | place both by forward 10cm",
        "ESCARGOT | place right at chin",
        "BOL | place both by up 25cm using fabrik",
    ] {
        let made = made(recipe);
        let bend = |clip: &Clip, joint: usize| {
            let column = &clip.joint_channel(joint).rotations;
            column.windows(2).map(|w| w[0].angle_between(w[1])).fold(0.0, f64::max)
        };
        let gloss = recipe.split(' ').next().expect("a gloss");
        for side in BodySide::BOTH_SIDES {
            for part in [BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)] {
                let joint = made.anatomy.part_joint(part).expect("an arm");
                let (was, is) = (bend(&source(gloss), joint), bend(&made.clip, joint));
                assert!(is < was + 5f64.to_radians(), "{recipe} {part}: {was} {is}");
            }
        }
    }
}
