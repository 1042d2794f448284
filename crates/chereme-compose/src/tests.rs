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
fn operators_taken_one_by_one_come_back() {
    use crate::ops::{mirror, place, reverse};
    use crate::recipe::Solver;
    use crate::work::Work;
    for gloss in ["ESCARGOT", "LIMACE"] {
        let material = &Shelf::new().materials[gloss];
        let by = DVec3::new(0.06, 0.05, -0.04);
        let solver = Solver::Analytic;
        type Once = fn(&mut Work, f64, DVec3, Solver);
        let operators: [(&str, Once); 3] = [
            ("reverse", |work, _, _, _| drop(reverse::reverse(work))),
            ("swap", |work, _, _, _| {
                drop(mirror::swap(work).expect("two arms"))
            }),
            ("place", |work, sign, by, solver| {
                let reach = place::shift(work, &Side::BOTH, by * sign, solver).expect("two arms");
                assert!(reach.residual < 1e-9 && reach.helped == 0);
            }),
        ];
        for (name, operator) in operators {
            let mut work = Work::of(material);
            operator(&mut work, 1.0, by, solver);
            operator(&mut work, -1.0, by, solver);
            let far = farthest(&work.into_clip().expect("a clip"), &material.clip);
            assert!(far < 1e-5, "{gloss} {name}: {far}");
        }
    }
}

#[test]
fn contacts_that_are_undone_are_told() {
    let chin = "ESCARGOT | place right at chin with index";
    let away = made(&format!(
        "{chin} | configure right S | place right by right 10cm"
    ));
    assert!(
        away.report.contacts.iter().any(|c| c.contains("touched")),
        "{:?}",
        away.report.contacts
    );
    let text = away.report.to_string();
    assert!(
        text.contains("contacts undone") && text.contains("right fingers"),
        "{text}"
    );
    assert!(
        made("ESCARGOT | place both by up 2cm")
            .report
            .contacts
            .is_empty()
    );
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

/// Returns a shelf whose first sign's body lacks the joints whose names start with `without`.
fn lacking(without: &str) -> Shelf {
    let mut shelf = Shelf::new();
    let old = shelf.materials["ESCARGOT"].clone();
    let skeleton = old.clip.skeleton();
    let lost: Vec<usize> = (0..skeleton.len())
        .filter(|&joint| {
            skeleton
                .ancestors(joint)
                .any(|above| skeleton.joint(above).name.starts_with(without))
        })
        .collect();
    let kept: Vec<usize> = (0..skeleton.len())
        .filter(|joint| !lost.contains(joint))
        .collect();
    let joints = kept.iter().map(|&joint| chereme_motion::Joint {
        parent: skeleton
            .parent(joint)
            .and_then(|p| kept.iter().position(|&k| k == p)),
        ..skeleton.joint(joint).clone()
    });
    let smaller =
        std::sync::Arc::new(chereme_motion::Skeleton::new(joints.collect()).expect("a tree"));
    let channels = kept
        .iter()
        .map(|&joint| old.clip.channel(joint).clone())
        .collect();
    let sign = shelf.materials.get_mut("ESCARGOT").expect("there");
    sign.anatomy = std::sync::Arc::new(chereme_motion::Anatomy::detect(&smaller));
    sign.clip = Clip::new(smaller, old.clip.rate(), channels).expect("a clip");
    shelf
}

#[test]
fn bodies_that_lack_something_are_told_what() {
    for (without, step, want) in [
        ("Left", "swap", "no left arm"),
        ("Left", "place both by up 5cm", "no left arm"),
        ("Left", "mirror right", "no left arm"),
        ("RightHandI", "orient right palm up", ""),
        (
            "RightHand",
            "configure right U",
            "right hand has no fingers",
        ),
        (
            "RightHandIndex",
            "configure right U",
            "right hand has no fingers",
        ),
        ("Neck", "nonmanual from BOL", "no head"),
        ("Left", "place right by up 5cm", ""),
        ("Left", "reverse | repeat 2", ""),
    ] {
        let recipe: crate::Recipe = format!("ESCARGOT | {step}").parse().expect(step);
        let made = resolve(&recipe, &lacking(without)).and_then(|resolved| evaluate(&resolved));
        match made {
            Ok(_) => assert_eq!(want, "", "{without} {step}"),
            Err(error) => {
                let error = error.to_string();
                assert!(
                    !want.is_empty() && error.contains(want),
                    "{without} {step}: {error}"
                );
            }
        }
    }
}

/// Steps of every kind, some of which cannot be taken.
const STEPS: [&str; 26] = [
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
                let end = made.clip.span().end();
                for note in &made.notes {
                    prop_assert!(note.span.end() <= end, "{}: {:?} ends after {}", text, note, end);
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains("stored inputs"), "{}: {}", text, error),
        }
    }
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

fn wrist(made: &Made, side: Side) -> Vec<DVec3> {
    let hand = made.anatomy.joint(Part::Hand(side)).expect("a hand");
    made.clip.path(hand)
}

#[test]
fn paths_are_scaled_carried_and_sent() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let before = wrist(&made(gloss), Side::Right);
        let small = wrist(&made(&format!("{gloss} | amplify right 0.5")), Side::Right);
        let far = |path: &[DVec3]| path[10].distance(path[80]);
        assert!((far(&small) - far(&before) / 2.0).abs() < 1e-4, "{gloss}");
        let carried = made(&format!("{gloss} | travel right down 6cm then up 6cm"));
        let path = wrist(&carried, Side::Right);
        assert!(path[0].abs_diff_eq(before[0], 1e-6) && path[119].abs_diff_eq(before[119], 1e-3));
        assert!((before[60].y - path[60].y - 0.06).abs() < 2e-3, "{gloss}");
        let sent = made(&format!("{gloss} | from me to left with right"));
        let path = wrist(&sent, Side::Right);
        assert!(
            path[119].x > path[0].x + 0.05,
            "{gloss}: {} {}",
            path[0],
            path[119]
        );
        for made in [carried, sent] {
            bones_keep_their_lengths(&made.clip);
            assert_eq!(differing(&made, &source(gloss)), [Group::Arm(Side::Right)]);
        }
    }
}

#[test]
fn hands_turn_as_asked_and_stay_where_they_are() {
    for gloss in ["ESCARGOT", "LIMACE"] {
        let made = made(&format!("{gloss} | orient right palm up fingers forward"));
        let model = made.clip.model_pose(60);
        let frame = made.anatomy.body_frame(&model).expect("a trunk");
        let palm = made
            .anatomy
            .palm_normal(Side::Right, &model)
            .expect("fingers");
        let fingers = made
            .anatomy
            .hand_direction(Side::Right, &model)
            .expect("fingers");
        assert!(palm.angle_between(DVec3::Y) < 1e-6 && fingers.angle_between(frame.forward) < 0.2);
        let before = wrist(&super::tests::made(gloss), Side::Right);
        for (a, b) in before.iter().zip(wrist(&made, Side::Right)) {
            assert!(a.distance(b) < 1e-3);
        }
    }
    let turned = made("ESCARGOT | orient right by 30deg about up by -30deg about up");
    assert!(farthest(&turned.clip, &source("ESCARGOT")) < 1e-6);
}

#[test]
fn time_is_stretched_as_a_whole_and_phase_by_phase() {
    let slow = made("ESCARGOT | retime 200%");
    assert_eq!(slow.clip.frames(), 240);
    assert!(
        slow.notes
            .iter()
            .any(|n| n.span == crate::testing::span(400, 1600))
    );
    let phases = made("ESCARGOT | retime 1, to 1.2s, 50%");
    assert_eq!(phases.clip.frames(), 24 + 144 + 12);
    assert!(
        phases
            .notes
            .iter()
            .any(|n| n.span == crate::testing::span(200, 1400))
    );
    assert_eq!(made("ESCARGOT | retime 1").clip, source("ESCARGOT"));
    let error = make("ESCARGOT | retime 1, 2")
        .expect_err("two of three")
        .to_string();
    assert!(error.contains("the sign has 3 phases"), "{error}");
}

#[test]
fn the_head_of_another_sign_on_this_one() {
    for donor in ["BOL", "LIMACE"] {
        let made = made(&format!("ESCARGOT | nonmanual from {donor}"));
        assert_eq!(
            differing(&made, &source("ESCARGOT")),
            [Group::Head],
            "{donor}"
        );
    }
}

#[test]
fn repetitions_shrink_and_quicken() {
    let made = made("ESCARGOT | repeat 3 scale 0.5 tempo 2 gap 0.1s");
    assert_eq!(made.clip.frames(), 120 + 12 + 60 + 12 + 30);
    let path = wrist(&made, Side::Right);
    let size = |p: &[DVec3]| p.iter().map(|a| a.distance(p[0])).fold(0.0, f64::max);
    assert!((size(&path[132..192]) / size(&path[..120]) - 0.5).abs() < 0.05);
}

#[test]
fn words_are_spelt_letter_by_letter() {
    for (recipe, side) in [
        ("spell USU", Side::Right),
        ("spell US left on signer:2", Side::Left),
    ] {
        let made = made(recipe);
        bones_keep_their_lengths(&made.clip);
        let letters: Vec<_> = made.notes.iter().filter(|n| n.hand == Some(side)).collect();
        assert_eq!(
            letters.len(),
            recipe.split(' ').nth(1).expect("a word").len()
        );
        for note in letters {
            let frame = made.clip.rate().frame_at(note.span.start()) + 5;
            let model = made.clip.model_pose(frame);
            let up = made.anatomy.hand_direction(side, &model).expect("fingers");
            let palm = made.anatomy.palm_normal(side, &model).expect("fingers");
            let body = made.anatomy.body_frame(&model).expect("a trunk");
            assert!(up.angle_between(DVec3::Y) < 1e-6 && palm.angle_between(body.forward) < 0.01);
            let pose = made.clip.pose(frame);
            let shown = made
                .anatomy
                .hand_angles(made.clip.skeleton(), side, &pose)
                .expect("fingers");
            let wanted = match note.value.value() {
                Some("U") => "LIMACE",
                _ => "BOL",
            };
            assert!(shown.fingers[1].flexion[1] > 0.1, "{wanted}");
        }
        assert!(made.report.steps[0].residual.expect("reached") < 1e-3);
    }
    assert!(made("spell UU | travel right 20cm").clip.frames() > 50);
    assert!(
        make("spell UQ")
            .expect_err("no Q")
            .to_string()
            .contains("no configuration")
    );
}

#[test]
fn the_finger_points_at_the_target() {
    for (recipe, target) in [
        (
            "point right at -40cm,120cm,150cm",
            DVec3::new(-0.4, 1.2, 1.5),
        ),
        ("point left at 60cm,180cm,60cm", DVec3::new(0.6, 1.8, 0.6)),
        (
            "point right at -10cm,120cm,35cm with U via cosine 0.4s",
            DVec3::new(-0.1, 1.2, 0.35),
        ),
        ("point right at 200cm,10cm,50cm", DVec3::new(2.0, 0.1, 0.5)),
    ] {
        let made = made(&format!("{recipe} on signer:1"));
        let side = if recipe.contains("left") {
            Side::Left
        } else {
            Side::Right
        };
        let model = made.clip.model_pose(made.clip.frames() / 2);
        let base = made
            .anatomy
            .joint(Part::Finger(side, chereme_motion::Finger::Index, 1))
            .expect("a finger");
        let tip = made
            .anatomy
            .landmark(
                made.clip.skeleton(),
                &model,
                &format!("{}-index-tip", side.name()),
            )
            .expect("a tip");
        let line = tip - model.position(base);
        let miss = (target - tip).reject_from(line).length();
        assert!(
            miss < 0.002 && line.dot(target - tip) > -0.03,
            "{recipe}: {miss}"
        );
        assert_eq!(
            made.clip.pose(0),
            made.clip.pose(made.clip.frames() - 1),
            "back at rest"
        );
        bones_keep_their_lengths(&made.clip);
    }
}

#[test]
fn elbows_do_not_jump_where_the_source_s_did_not() {
    for recipe in [
        "ESCARGOT | place both by left 10cm up 10cm",
        "LIMACE | place both by forward 10cm",
        "ESCARGOT | place right at chin",
        "BOL | place both by up 25cm using fabrik",
    ] {
        let made = made(recipe);
        let bend = |clip: &Clip, joint: usize| {
            let column = &clip.channel(joint).rotations;
            column
                .windows(2)
                .map(|w| w[0].angle_between(w[1]))
                .fold(0.0, f64::max)
        };
        let gloss = recipe.split(' ').next().expect("a gloss");
        for side in Side::BOTH {
            for part in [Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)] {
                let joint = made.anatomy.joint(part).expect("an arm");
                let (was, is) = (bend(&source(gloss), joint), bend(&made.clip, joint));
                assert!(is < was + 5f64.to_radians(), "{recipe} {part}: {was} {is}");
            }
        }
    }
}
