//! The laws of the operators, on bodies of plain and of odd axes.

use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, Part, Side};
use chereme_sign::Component;
use proptest::prelude::*;

use crate::made::{About, Made};
use crate::testing::{Shelf, farthest, model};
use crate::work::{Group, groups};
use crate::{Cause, MakeError, evaluate, resolve};

fn make(recipe: &str) -> Result<Made, MakeError> {
    let recipe: crate::Recipe = recipe.parse().unwrap_or_else(|e| panic!("{recipe}: {e}"));
    evaluate(&resolve(&recipe, &Shelf::new())?)
}

fn made(recipe: &str) -> Made {
    make(recipe).unwrap_or_else(|error| panic!("{recipe}: {error}"))
}

fn source(gloss: &str) -> Clip {
    Shelf::new().materials[gloss].clip.clone()
}

/// Returns the groups whose local channels differ between two clips.
fn differing(a: &Made, b: &Clip) -> Vec<Group> {
    let groups = groups(b.skeleton(), &a.anatomy);
    let mut found: Vec<Group> = (0..b.skeleton().len())
        .filter(|&joint| a.clip.channel(joint) != b.channel(joint))
        .map(|joint| groups[joint])
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn bones_keep_their_lengths(clip: &Clip) {
    let rest = clip.skeleton().rest_model_pose();
    for frame in 0..clip.frames() {
        let now = clip.model_pose(frame);
        for joint in 1..clip.skeleton().len() {
            let parent = clip.skeleton().parent(joint).expect("no root");
            let length =
                |m: &chereme_motion::ModelPose| m.position(joint).distance(m.position(parent));
            assert!((length(&now) - length(&rest)).abs() < 1e-6);
        }
    }
}

#[test]
fn a_sign_alone_is_what_it_was() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        assert_eq!(made(gloss).clip, source(gloss));
    }
}

#[test]
fn involutions_come_back() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        for twice in [
            "reverse | reverse",
            "swap | swap",
            "reverse | swap | reverse | swap",
        ] {
            let back = made(&format!("{gloss} | {twice}")).clip;
            let far = farthest(&back, &source(gloss));
            assert!(far < 1e-5, "{gloss} | {twice}: {far}");
        }
        let reversed = made(&format!("{gloss} | reverse | reverse"));
        assert_eq!(reversed.clip, source(gloss));
        let one = made(&format!("{gloss} | mirror right"));
        for again in [
            "mirror right | mirror right",
            "mirror right | mirror left",
            "mirror right | swap",
        ] {
            let far = farthest(&made(&format!("{gloss} | {again}")).clip, &one.clip);
            assert!(far < 1e-5, "{gloss} | {again}: {far}");
        }
        bones_keep_their_lengths(&one.clip);
    }
}

#[test]
fn a_swap_shows_the_mirror_image_whatever_the_axes() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let (before, swapped) = (source(gloss), made(&format!("{gloss} | swap")));
        let anatomy = &swapped.anatomy;
        let joint = |part| anatomy.joint(part).expect("a full body");
        for frame in [0, 37, 119] {
            let (a, b) = (model(&before, frame), model(&swapped.clip, frame));
            let chest = joint(Part::Chest);
            // In the chest's own posture at rest the plane is x = 0.
            let rest = before.skeleton().rest_model_pose();
            let home = |m: &chereme_motion::ModelPose, at: DVec3| {
                let carried = m.rotation(chest) * rest.rotation(chest).inverse();
                carried.inverse() * (at - m.position(chest))
            };
            for part in [
                Part::Hand(Side::Right),
                Part::Forearm(Side::Left),
                Part::Finger(Side::Right, chereme_motion::Finger::Little, 3),
            ] {
                let was = home(&a, a.position(joint(part)));
                let is = home(&b, b.position(joint(part.mirrored())));
                assert!(
                    is.abs_diff_eq(DVec3::new(-was.x, was.y, was.z), 1e-9),
                    "{gloss} {part} {was} {is}"
                );
            }
        }
    }
}

#[test]
fn each_operator_moves_the_joints_it_must_and_no_others() {
    use Group::{Arm, Fingers};
    use Side::{Left, Right};
    for (step, want) in [
        ("configure right U", vec![Fingers(Right)]),
        ("configure both S", vec![Fingers(Right), Fingers(Left)]),
        ("configure right from BOL", vec![Fingers(Right)]),
        ("place right by up 5cm", vec![Arm(Right)]),
        ("place both by left 5cm", vec![Arm(Right), Arm(Left)]),
        ("place right at chin", vec![Arm(Right)]),
        ("place left near LIMACE by up 2cm", vec![Arm(Left)]),
        ("place both by left 0cm", vec![]),
        ("repeat 1", vec![]),
        ("mirror left", vec![Fingers(Right), Arm(Right)]),
        (
            "swap",
            vec![Fingers(Right), Fingers(Left), Arm(Right), Arm(Left)],
        ),
    ] {
        let made = match step {
            "configure right from BOL" => make("ESCARGOT | configure right from BOL"),
            _ => make(&format!("ESCARGOT | {step}")),
        };
        match made {
            Ok(made) => {
                let found = differing(&made, &source("ESCARGOT"));
                let mut want = want;
                want.sort_unstable();
                assert_eq!(found, want, "{step}");
                let told: Vec<String> = made
                    .report
                    .channels
                    .iter()
                    .filter(|c| c.from.len() > 1)
                    .map(|c| c.channel.clone())
                    .collect();
                let said: Vec<String> = Group::ALL
                    .into_iter()
                    .filter(|g| want.contains(g))
                    .map(Group::name)
                    .collect();
                assert_eq!(told, said, "{step}");
            }
            Err(error) => panic!("{step}: {error}"),
        }
    }
}

#[test]
fn values_are_replaced_one_by_one_and_joined() {
    let made = made("BOL | configure right U, S");
    let held: Vec<_> = made
        .notes
        .iter()
        .filter(|n| {
            n.hand == Some(Side::Right)
                && n.about == About::Component(Component::Configuration, None)
        })
        .map(|n| n.value.value().expect("a value").to_owned())
        .collect();
    assert_eq!(held, ["U", "S"]);
    let joint = made
        .anatomy
        .joint(Part::Finger(Side::Right, chereme_motion::Finger::Index, 2))
        .expect("a finger");
    let column = &made.clip.channel(joint).rotations;
    assert!(
        column[..48].iter().all(|q| *q == column[0]),
        "the first value is held"
    );
    assert!(
        column[72..].iter().all(|q| *q == column[72]),
        "the second value is held"
    );
    let jump = column
        .windows(2)
        .map(|w| w[0].angle_between(w[1]))
        .fold(0.0, f64::max);
    let whole = column[0].angle_between(column[72]);
    assert!(whole > 0.05 && jump < whole / 5.0, "{jump} of {whole}");
    for (recipe, want) in [
        ("BOL | configure right U, S, Y", "give 1 or 2"),
        ("BOL | configure right Q", "no configuration"),
        (
            "BOL | configure right claw",
            "no sign with movement holds \"claw\"",
        ),
        ("BOOL", "did you mean \"BOL\"?"),
        (
            "BOL | configure right best(configuration=X)",
            "finds no sign",
        ),
        ("BOL | place both by left 180cm", "the arm is 53 cm long"),
    ] {
        let error = make(recipe).expect_err(recipe).to_string();
        assert!(error.contains(want), "{recipe}: {error}");
    }
}

#[test]
fn a_value_comes_from_whoever_is_nearest() {
    use crate::PoseOrigin as From;
    let origin = |recipe: &str| {
        let recipe: crate::Recipe = recipe.parse().expect("recipe");
        let resolved = resolve(&recipe, &Shelf::new()).expect("resolved");
        let poses = resolved.inputs().0.values().find_map(|input| match input {
            crate::Input::Poses(poses) => Some(poses.clone()),
            _ => None,
        });
        poses.expect("poses")[0].origin.clone()
    };
    assert_eq!(
        origin("ESCARGOT | configure right S"),
        From::SameSigner("token:BOL".into())
    );
    assert_eq!(
        origin("ESCARGOT | configure right U"),
        From::OtherSigner("token:LIMACE".into())
    );
    assert_eq!(
        origin("LIMACE | configure right H"),
        From::Neighbour {
            sign: "token:LIMACE".into(),
            value: "U".into()
        }
    );
    assert_eq!(
        origin("ESCARGOT | configure right H"),
        From::Inventory("configurations".into())
    );
    assert_eq!(
        origin("ESCARGOT | configure right from CHAT"),
        From::Named("token:CHAT".into())
    );
    let best = origin("ESCARGOT | configure right best(configuration=U signer=same)");
    assert_eq!(best, From::OtherSigner("token:LIMACE".into()));
}

#[test]
fn what_was_resolved_is_stored_and_gives_the_same_movement() {
    let shelf = Shelf::new();
    for text in [
        "ESCARGOT | configure right U | place right near BOL then BOL via",
        "BOL then via learned 0.3s LIMACE",
    ] {
        let text = text.trim_end_matches(" via");
        let recipe: crate::Recipe = text.parse().expect(text);
        let resolved = resolve(&recipe, &shelf).expect(text);
        let json = serde_json::to_string(resolved.inputs()).expect("json");
        let inputs: crate::Inputs = serde_json::from_str(&json).expect("json");
        let mut changed = Shelf::new();
        changed
            .materials
            .get_mut("LIMACE")
            .expect("there")
            .held
            .clear();
        let again = crate::restore(&recipe, inputs.clone(), &changed).expect("restored");
        let (a, b) = (
            evaluate(&resolved).expect(text),
            evaluate(&again).expect(text),
        );
        assert!(farthest(&a.clip, &b.clip) < 1e-12);
        for material in changed.materials.values_mut() {
            material.hash.push('x');
        }
        let error = crate::restore(&recipe, inputs, &changed).expect_err("changed");
        assert!(matches!(error.cause, Cause::Changed { .. }));
    }
}

#[test]
fn another_signer_s_sign_follows_on_the_first_one_s_body() {
    let made = made("BOL then LIMACE");
    bones_keep_their_lengths(&made.clip);
    assert_eq!(made.clip.skeleton(), source("BOL").skeleton());
    let glosses: Vec<_> = made
        .notes
        .iter()
        .filter(|n| n.about == About::Gloss)
        .map(|n| n.value.value().expect("a gloss").to_owned())
        .collect();
    assert_eq!(glosses, ["BOL", "LIMACE"]);
    assert_eq!(made.report.joins.len(), 2);
    let hand = made.anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
    let path = made.clip.path(hand);
    let step = path
        .windows(2)
        .map(|w| w[0].distance(w[1]))
        .fold(0.0, f64::max);
    assert!(step < 0.05, "no jump of the wrist: {step}");
    assert_eq!(made.clip.frames(), {
        let frames = made.clip.frames();
        assert!((240..340).contains(&frames), "{frames}");
        frames
    });
}

#[test]
fn repetitions_are_joined() {
    let made = made("LIMACE | repeat 3 gap 0.1s");
    assert_eq!(made.clip.frames(), 3 * 120 + 2 * 12);
    assert_eq!(made.clip.pose(5), made.clip.pose(5 + 132));
    assert!(make("LIMACE | repeat 1000 gap 60s").is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn placing_there_and_back_is_nothing(
        left in -8i32..8, up in -8i32..8, forward in -8i32..4, odd in any::<bool>()
    ) {
        let gloss = if odd { "LIMACE" } else { "ESCARGOT" };
        let by = |sign: i32| format!("place both by left {}cm up {}cm forward {}cm", left * sign, up * sign, forward * sign);
        let there = made(&format!("{gloss} | {}", by(1)));
        let before = source(gloss);
        let reached = there.report.steps.iter().all(|s| s.residual.unwrap_or(0.0) < 1e-3);
        for side in Side::BOTH {
            let hand = there.anatomy.joint(Part::Hand(side)).expect("a hand");
            for frame in 0..before.frames() {
                let (a, b) = (model(&before, frame), model(&there.clip, frame));
                prop_assert!(a.rotation(hand).angle_between(b.rotation(hand)) < 0.1f64.to_radians());
                if reached {
                    let way = b.position(hand) - a.position(hand);
                    let length = DVec3::new(f64::from(left), f64::from(up), f64::from(forward)).length() / 100.0;
                    prop_assert!((way.length() - length).abs() < 1e-3);
                }
            }
        }
        bones_keep_their_lengths(&there.clip);
        let helped = there.report.steps.iter().any(|s| s.did.iter().any(|d| d.contains("collar bone")));
        prop_assume!(reached && !helped);
        let back = made(&format!("{gloss} | {} | {}", by(1), by(-1)));
        let far = farthest(&back.clip, &before);
        prop_assert!(far < 1e-5, "{far}");
    }
}
