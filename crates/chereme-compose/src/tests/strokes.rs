//! Operators change the stroke of a sign: its rests stay, its hands stay together, and each goes to its own side.

use crate::{evaluate_recipe, resolve_recipe};
use chereme_motion::ModelPose;
use chereme_sign::ComponentReading;

use super::*;
use crate::sources::{
    BodyRelativePlace, ComponentValue, LearnedCourse, LearnedProfile, LearnedReaches, MovementMaterial, RecipeSources,
    ValueMeaning,
};
use crate::stroke::SignStroke;
use crate::work::WorkingClip;

/// Notated signs that begin and end at rest: with one hand, and with two that move alike.
const ONE: &str = "hamnosys \"hamflathand hamextfingeru hampalml hamchin hammoveo\" with quiet";
const TWO: &str = "hamnosys \"hamsymmlr hamflathand hamextfingero hampalmd hamchest hammoved\" with quiet";

/// Returns the postures of the joints of arms and fingers in a frame.
fn arms(made: &GeneratedMovement, frame: usize) -> Vec<chereme_motion::glam::DQuat> {
    let joints = BodySide::BOTH_SIDES.map(|side| {
        let anatomy = &made.anatomy;
        [anatomy.arm_joints(side), anatomy.finger_joints(side)].concat()
    });
    let turned = |&joint: &usize| made.clip.joint_channel(joint).rotations[frame];
    joints.concat().iter().map(turned).collect()
}

#[test]
fn rests_before_and_after_a_sign_stay_as_they_are() {
    for sign in [ONE, TWO] {
        let plain = made(sign);
        for step in [
            "place both by left 20cm",
            "place right at neutral-space",
            "orient both by 60deg about up",
            "amplify both 1.5",
            "travel right down 10cm",
            "travel both through 5cm,5cm,0cm then 10cm,0cm,0cm",
            "from me to left",
            "configure both U",
        ] {
            let made = made(&format!("{sign} | {step}"));
            let (first, last) = (0, made.clip.clip_frame_count() - 1);
            let end = plain.clip.clip_frame_count() - 1;
            for (frame, rest) in [(first, 0), (last, end)] {
                // An elbow that would jump where a path begins is moved a little before, too.
                let close = if step.starts_with("from") { 0.01 } else { 1e-9 };
                for (is, was) in arms(&made, frame).iter().zip(arms(&plain, rest)) {
                    assert!(is.abs_diff_eq(was, close), "{sign} | {step}: {is} {was}");
                }
            }
        }
        let moved = made(&format!("{sign} | place both by left 20cm"));
        let gone = |side: BodySide, frame: usize| {
            let [was, is] = [&plain, &moved].map(|made| wrist(made, side)[frame]);
            is - was
        };
        let work = WorkingClip::from_generated_movement(made(sign), sign);
        let stroke = SignStroke::of_work(&work).expect("a clip");
        let by = gone(BodySide::Right, stroke.middle_frame());
        assert!(by.abs_diff_eq(DVec3::X * 0.2, 2e-3), "{sign}: {by}");
        let steps = (1..plain.clip.clip_frame_count()).map(|frame| {
            let by = gone(BodySide::Right, frame) - gone(BodySide::Right, frame - 1);
            by.length() * plain.clip.clip_frame_rate().per_second()
        });
        let fastest = steps.fold(0.0, f64::max);
        assert!(fastest < 1.5, "the displacement sets in at {fastest} m/s");
        assert!(moved.report.to_string().contains("stays as it is"));
    }
}

/// Returns a shelf with a sign of which only the fingers move, and with places on both sides and on the other hand.
fn posed() -> Shelf {
    let mut shelf = sided();
    let mut sign = shelf.materials["ESCARGOT"].clone();
    let fingers = BodySide::BOTH_SIDES
        .map(|side| sign.anatomy.finger_joints(side))
        .concat();
    let mut channels = sign.clip.joint_channels().to_vec();
    for (joint, channel) in channels.iter_mut().enumerate() {
        if !fingers.contains(&joint) {
            let still = channel.rotations[0];
            channel.rotations.fill(still);
            if let Some(places) = &mut channel.translations {
                let still = places[0];
                places.fill(still);
            }
        }
    }
    sign.clip = Clip::new(sign.clip.clip_skeleton().clone(), sign.clip.clip_frame_rate(), channels).expect("a clip");
    sign.held.clear();
    sign.gloss = "POSED".into();
    sign.address = "token:POSED".into();
    shelf.materials.insert("POSED".into(), sign);
    shelf
}

#[test]
fn larger_paths_keep_hands_together_that_move_alike_or_touch() {
    let shelf = posed();
    let make = |text: &str| {
        let recipe: crate::Recipe = text.parse().expect("a recipe");
        let made = resolve_recipe(&recipe, &shelf).and_then(|resolved| evaluate_recipe(&resolved));
        made.unwrap_or_else(|error| panic!("{text}: {error}"))
    };
    let size = |path: &[DVec3]| {
        let far = path.iter().map(|at| at.distance(path[0]));
        far.fold(0.0, f64::max)
    };
    for (start, travel) in [
        ("POSED", "travel both up 8cm then down 8cm"),
        ("POSED", "travel both left up 8cm"),
        ("POSED | place right at touch", "travel both up 8cm then down 8cm"),
        ("POSED | place right at touch", "travel right up 8cm then down 8cm"),
    ] {
        let plain = make(&format!("{start} | {travel}"));
        for factor in [0.5, 1.5, 2.0] {
            let scaled = make(&format!("{start} | {travel} | amplify both {factor}"));
            let [was, is] = [&plain, &scaled].map(|made| BodySide::BOTH_SIDES.map(|side| wrist(made, side)));
            let parallel = travel.contains("both");
            for frame in 0..plain.clip.clip_frame_count() {
                let [before, after] = [&was, &is].map(|two| two[0][frame] - two[1][frame]);
                // A hand that taps the other one touches it at the start and at the end.
                let together = parallel || [0, plain.clip.clip_frame_count() - 1].contains(&frame);
                let off = before.distance(after);
                assert!(!together || off < 5e-3, "{start} | {travel} {factor}: {off} at {frame}");
                let left = was[1][frame].distance(is[1][frame]);
                assert!(
                    parallel || left < 5e-3,
                    "{start} | {travel} {factor}: {left} at {frame}"
                );
            }
            let grown = size(&is[0]) / size(&was[0]);
            assert!((grown - factor).abs() < 0.2, "{start} | {travel} {factor}: {grown}");
        }
    }
}

#[test]
fn a_resting_hand_is_not_shifted_by_a_larger_path_of_the_other() {
    let plain = made(ONE);
    let scaled = made(&format!("{ONE} | amplify both 1.8"));
    let [was, is] = [&plain, &scaled].map(|made| wrist(made, BodySide::Left));
    for (was, is) in was.iter().zip(&is) {
        assert!(was.distance(*is) < 5e-3, "{was} {is}");
    }
}

/// Returns a shelf with places on both sides.
fn sided() -> Shelf {
    let mut shelf = Shelf::new();
    for (id, landmark, forward) in [
        ("shoulder", "ipsi-shoulder", 0.6),
        ("palm", "contra-palm", 0.6),
        ("touch", "contra-palm", 0.0),
    ] {
        let value = ComponentValue {
            id: id.to_owned(),
            inventory: "placements".into(),
            meaning: Some(ValueMeaning::Place(BodyRelativePlace {
                landmark: landmark.to_owned(),
                offset: [0.0, 0.0, forward],
            })),
        };
        shelf.values.push((SignComponent::Placement, value));
    }
    shelf
}

#[test]
fn each_of_two_hands_goes_to_the_place_on_its_own_side() {
    let shelf = sided();
    let make = |text: &str| {
        let recipe: crate::Recipe = text.parse().expect("a recipe");
        evaluate_recipe(&resolve_recipe(&recipe, &shelf)?)
    };
    for gloss in ["ESCARGOT", "CHAT"] {
        let made = make(&format!("{gloss} | place both at shoulder")).expect("made");
        for side in BodySide::BOTH_SIDES {
            let mean = |name: &str| {
                let frames = 0..made.clip.clip_frame_count();
                let count = frames.len() as f64;
                let at = frames.map(|frame| {
                    let model = ModelPose::from_local_pose(made.clip.clip_skeleton(), &made.clip.clip_pose_at(frame));
                    let name = format!("{}-{name}", side.body_side_name());
                    let at = made
                        .anatomy
                        .landmark_place_position(made.clip.clip_skeleton(), &model, &name);
                    at.expect("a landmark")
                });
                at.sum::<DVec3>() / count
            };
            let off = mean("palm") - mean("shoulder");
            assert!(off.length() < 0.3, "{gloss} {}: {off}", side.body_side_name());
            let placed = made.notes.iter().find(|note| {
                note.hand == Some(side) && note.about == NoteSubject::Component(SignComponent::Placement, None)
            });
            let value = placed.map(|note| note.value.clone());
            assert_eq!(value, Some(ComponentReading::Value("shoulder".into())), "{gloss}");
        }
        let report = made.report.to_string();
        assert!(report.contains("the left hand is moved"), "{report}");
    }
    let error = make("BOL | place both at palm").expect_err("the palms move");
    let error = error.to_string();
    assert!(
        error.contains("it moves with them") && error.contains("one hand"),
        "{error}"
    );
    make("BOL | place right at palm").expect("one hand touches the other");
}

#[test]
fn signs_whose_hands_do_not_move_are_refused_with_what_they_lack() {
    let mut shelf = Shelf::new();
    let moving = shelf.materials["BOL"].clone();
    let still = |gloss: &str| -> MovementMaterial {
        let clip = Clip::from_rest_pose(moving.clip.clip_skeleton().clone(), moving.clip.clip_frame_rate(), 40);
        MovementMaterial {
            gloss: gloss.to_owned(),
            address: format!("token:{gloss}"),
            clip,
            ..moving.clone()
        }
    };
    let mut face = still("FACE");
    face.curves = vec![crate::outcome::GeneratedCurve {
        name: "jawOpen".into(),
        values: vec![0.0; 40],
    }];
    shelf.materials.insert("STILL".into(), still("STILL"));
    shelf.materials.insert("FACE".into(), face);
    for (gloss, lacks) in [("STILL", "stand still"), ("FACE", "a face only")] {
        for recipe in [
            "X",
            "X | reverse",
            "X | place both by up 5cm",
            "BOL then X",
            "X then BOL",
        ] {
            let text = recipe.replace('X', gloss);
            let recipe: crate::Recipe = text.parse().expect("a recipe");
            let error = resolve_recipe(&recipe, &shelf).expect_err(&text).to_string();
            assert!(error.contains("no movement of hands"), "{text}: {error}");
            assert!(error.contains(lacks), "{text}: {error}");
        }
        // A face gets expressions, for it has no hands to move.
        let expressions: crate::Recipe = "FACE | nonmanual from BOL".parse().expect("read");
        resolve_recipe(&expressions, &shelf).expect("a face alone");
        // As donors of a face or a handshape they serve.
        let recipe: crate::Recipe = format!("BOL | nonmanual from {gloss}").parse().expect("read");
        resolve_recipe(&recipe, &shelf).expect("a head is taken");
    }
}

#[test]
fn palm_and_fingers_in_one_direction_are_refused_as_such() {
    for directions in ["palm up fingers up", "fingers left palm right"] {
        let error = format!("BOL | orient right {directions}").parse::<crate::Recipe>();
        let error = error.expect_err(directions).to_string();
        assert!(error.contains("across the fingers"), "{error}");
    }
}

/// A shelf whose corpus shows reaches.
struct Reaching(Shelf, f64);

impl RecipeSources for Reaching {
    fn find_material(&self, address: &str) -> Result<MovementMaterial, crate::error::SourceError> {
        self.0.find_material(address)
    }

    fn stage(&self, signer: Option<&str>) -> Result<MovementMaterial, crate::error::SourceError> {
        self.0.stage(signer)
    }

    fn find_component_value(
        &self,
        component: SignComponent,
        text: &str,
    ) -> Result<ComponentValue, crate::error::SourceError> {
        self.0.find_component_value(component, text)
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        self.0.list_component_values(component)
    }

    fn holding(
        &self,
        component: SignComponent,
        value: &str,
    ) -> Result<Vec<crate::sources::TokenExample>, crate::error::SourceError> {
        self.0.holding(component, value)
    }

    fn find_best_examples(
        &self,
        query: &str,
        signer: Option<&str>,
    ) -> Result<Vec<crate::sources::TokenExample>, crate::error::SourceError> {
        self.0.find_best_examples(query, signer)
    }

    fn find_alphabet_letters(
        &self,
        alphabet: Option<&str>,
        word: &str,
    ) -> Result<Vec<crate::sources::AlphabetLetter>, crate::error::SourceError> {
        self.0.find_alphabet_letters(alphabet, word)
    }

    fn learned_profile(&self) -> Result<Option<LearnedProfile>, crate::error::SourceError> {
        let course = LearnedCourse {
            shares: vec![0.0, 0.1, 0.5, 0.9, 1.0],
            transitions: 9,
            recordings: vec!["reach".into()],
        };
        Ok(Some(LearnedProfile {
            reaches: Some(LearnedReaches { course, speed: self.1 }),
            ..LearnedProfile::default()
        }))
    }
}

#[test]
fn pointing_is_as_fast_as_captured_reaches_and_never_faster_than_signers() {
    let targets = ["30cm,140cm,50cm", "-40cm,120cm,150cm", "10cm,180cm,60cm"];
    let fastest = |made: &GeneratedMovement| {
        let path = wrist(made, BodySide::Right);
        let steps = path.windows(2).map(|two| two[0].distance(two[1]));
        steps.fold(0.0, f64::max) * made.clip.clip_frame_rate().per_second()
    };
    for target in targets {
        let recipe: crate::Recipe = format!("point right at {target} hold 0.3s on signer:1")
            .parse()
            .expect("a recipe");
        let make = |sources: &dyn RecipeSources| {
            let resolved = resolve_recipe(&recipe, sources).expect("resolved");
            evaluate_recipe(&resolved).expect("made")
        };
        let plain = make(&Shelf::new());
        assert!(fastest(&plain) < 1.6, "{target}: {}", fastest(&plain));
        for speed in [0.4, 9.0] {
            let made = make(&Reaching(Shelf::new(), speed));
            let report = made.report.to_string();
            assert!(report.contains("9 transitions of reaching arms in reach"), "{report}");
            assert!(fastest(&made) < 1.6, "{target}: {}", fastest(&made));
            let path = wrist(&made, BodySide::Right);
            let far = path[0].distance(path[path.len() / 2]);
            let seconds = (made.clip.clip_span().span_seconds() - 0.3) / 2.0;
            let mean = far / seconds;
            assert!(mean < speed * 1.02, "{target}: {mean} m/s");
            assert!(speed > 1.0 || mean > speed * 0.97, "{target}: {mean} m/s");
        }
        let asked = format!("point right at {target} via minimum-jerk 0.2s on signer:1");
        assert!(fastest(&made(&asked)) > 1.6, "a stated time is kept");
    }
}

#[test]
fn a_contact_is_repaired_with_the_nearest_part_of_the_hand() {
    let mut repaired = 0;
    for shape in ["S", "U", "V", "B"] {
        let recipe = format!("ESCARGOT | place right at chin with index | configure right {shape}");
        let made = made(&recipe);
        let step = made.report.steps.last().expect("a step");
        for did in step.did.iter().filter(|did| did.contains("contact kept")) {
            let cm = did.split("by up to ").nth(1).and_then(|it| it.split(' ').next());
            let cm: f64 = cm.and_then(|cm| cm.parse().ok()).expect("a distance");
            repaired += 1;
            let warned = made.report.warnings.iter().any(|it| it.contains("touch"));
            assert_eq!(warned, cm > 3.0, "{recipe}: {did} {:?}", made.report.warnings);
        }
    }
    assert!(repaired > 0);
    let work = WorkingClip::working_clip_from(&Shelf::new().materials["BOL"]);
    assert_eq!(
        crate::contact::long_repairs(&crate::contact::find_contacts(&work), "x").len(),
        0
    );
}
