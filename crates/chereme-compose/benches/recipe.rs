//! Measures the frames per second at which a recipe is evaluated: `cargo bench -p chereme-compose`.
//!
//! The body has 75 joints with full hands, the sign takes 3 s at 120 Hz, the recipe has four operators. Forward
//! kinematics of every frame of the result is timed separately, because a preview needs it as well.

use std::sync::Arc;

use chereme_compose::{
    AlphabetLetter, ComponentValue, HeldValue, MovementMaterial, Recipe, RecipeSources, ResolvedRecipe, SourceError,
    TokenExample, evaluate_recipe, resolve_recipe,
};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{
    BodyAnatomy, BodySide, Clip, FrameRate, JointChannel, ModelPose, RecordingInstant, Skeleton, SkeletonJoint,
    TimeSpan,
};
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};
use divan::counter::ItemsCount;

const FRAMES: usize = 360;

fn main() {
    divan::main();
}

#[divan::bench(args = [
    "A",
    "A | reverse",
    "A | place both by left 10cm up 5cm",
    "A | configure right from A",
    "A | configure right from A | place both by left 10cm up 5cm | swap | reverse",
    "A then A",
])]
fn recipes(bencher: divan::Bencher<'_, '_>, text: &str) {
    let resolved = prepared(text);
    let frames = evaluate_recipe(&resolved).map_or(0, |made| made.clip.clip_frame_count());
    bencher
        .counter(ItemsCount::new(frames))
        .bench_local(|| evaluate_recipe(&resolved).map(|made| made.clip.clip_frame_count()));
}

#[divan::bench]
fn kinematics_of_the_result(bencher: divan::Bencher<'_, '_>) {
    let clip = Shelf::new().0.clip;
    bencher.counter(ItemsCount::new(FRAMES)).bench_local(|| {
        let mut model = ModelPose::from_local_pose(clip.clip_skeleton(), &clip.clip_pose_at(0));
        let mut sum = DVec3::ZERO;
        for frame in 0..clip.clip_frame_count() {
            model.set_local_pose(clip.clip_skeleton(), &clip.clip_pose_at(frame));
            sum += model.model_joint_position(clip.clip_skeleton().len() - 1);
        }
        sum
    });
}

fn prepared(text: &str) -> ResolvedRecipe {
    let recipe: Recipe = text.parse().expect("a recipe of this file");
    resolve_recipe(&recipe, &Shelf::new()).expect("all it needs is there")
}

/// One sign on a body of 75 joints.
struct Shelf(MovementMaterial);

impl Shelf {
    fn new() -> Self {
        let skeleton = Arc::new(body());
        let held = [(SignComponent::Configuration, "B"), (SignComponent::Placement, "chest")];
        Self(MovementMaterial {
            address: "token:1".into(),
            hash: "1".into(),
            gloss: "A".into(),
            signer: None,
            handedness: SignerHandedness::Right,
            clip: movement(&skeleton),
            anatomy: Arc::new(BodyAnatomy::detect_anatomy(&skeleton)),
            curves: Vec::new(),
            held: held
                .map(|(component, value)| HeldValue {
                    hand: Some(BodySide::Right),
                    component,
                    feature: None,
                    value: ComponentReading::Value(value.into()),
                    span: TimeSpan::span_between(
                        RecordingInstant::from_millis(300),
                        RecordingInstant::from_millis(2500),
                    ),
                })
                .into(),
        })
    }
}

fn body() -> Skeleton {
    let mut joints: Vec<SkeletonJoint> = Vec::new();
    let mut add = |name: String, parent: Option<usize>, offset: [f64; 3]| {
        joints.push(SkeletonJoint::new(name, parent, DVec3::from(offset)));
        joints.len() - 1
    };
    let hips = add("Hips".into(), None, [0.0, 0.95, 0.0]);
    let mut spine = hips;
    for n in ["Spine", "Spine1", "Spine2", "Spine3"] {
        spine = add(n.into(), Some(spine), [0.0, 0.09, 0.0]);
    }
    let neck = add("Neck".into(), Some(spine), [0.0, 0.2, 0.0]);
    let head = add("Head".into(), Some(neck), [0.0, 0.1, 0.0]);
    for n in 0..8 {
        add(format!("Face{n}"), Some(head), [0.01 * f64::from(n), 0.1, 0.1]);
    }
    for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
        let clavicle = add(format!("{side}Shoulder"), Some(spine), [0.03 * x, 0.15, 0.0]);
        let upper = add(format!("{side}Arm"), Some(clavicle), [0.15 * x, 0.0, 0.0]);
        let fore = add(format!("{side}ForeArm"), Some(upper), [0.28 * x, 0.0, 0.0]);
        let hand = add(format!("{side}Hand"), Some(fore), [0.25 * x, 0.0, 0.0]);
        for (finger, z) in [("Index", 0.03), ("Middle", 0.01), ("Ring", -0.01), ("Pinky", -0.03)] {
            let mut parent = hand;
            for (n, along) in [(1, 0.09), (2, 0.04), (3, 0.025), (4, 0.02)] {
                let z = if n == 1 { z } else { 0.0 };
                parent = add(format!("{side}Hand{finger}{n}"), Some(parent), [along * x, 0.0, z]);
            }
        }
        let mut parent = hand;
        for n in 1..=4 {
            parent = add(format!("{side}HandThumb{n}"), Some(parent), [0.02 * x, 0.0, 0.02]);
        }
        let mut leg = hips;
        for (n, y) in [
            ("UpLeg", -0.05),
            ("Leg", -0.4),
            ("Foot", -0.4),
            ("ToeBase", -0.05),
            ("Toe_End", 0.0),
            ("Heel", 0.0),
        ] {
            leg = add(format!("{side}{n}"), Some(leg), [0.01 * x, y, 0.02]);
        }
    }
    assert_eq!(joints.len(), 75);
    Skeleton::new(joints).expect("a tree")
}

fn movement(skeleton: &Arc<Skeleton>) -> Clip {
    let channels = skeleton.skeleton_joints().iter().enumerate().map(|(n, joint)| {
        let side = if joint.name.starts_with("Left") { -1.0 } else { 1.0 };
        let bend = match joint.name.trim_start_matches("Left").trim_start_matches("Right") {
            "Arm" => DQuat::from_rotation_z(side * 1.1),
            "ForeArm" => DQuat::from_rotation_y(side * 1.4),
            _ => DQuat::IDENTITY,
        };
        let wave = |f: usize| 0.1 * (f as f64 * 0.05 + n as f64).sin();
        JointChannel {
            rotations: (0..FRAMES).map(|f| bend * DQuat::from_rotation_y(wave(f))).collect(),
            translations: None,
        }
    });
    let rate = FrameRate::new(120, 1).expect("a rate");
    Clip::new(Arc::clone(skeleton), rate, channels.collect()).expect("a clip")
}

impl RecipeSources for Shelf {
    fn find_material(&self, _: &str) -> Result<MovementMaterial, SourceError> {
        Ok(self.0.clone())
    }

    fn stage(&self, _: Option<&str>) -> Result<MovementMaterial, SourceError> {
        Ok(self.0.clone())
    }

    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError> {
        Err(SourceError::UnknownValue {
            component,
            text: text.into(),
            nearest: None,
        })
    }

    fn list_component_values(&self, _: SignComponent) -> Vec<ComponentValue> {
        Vec::new()
    }

    fn holding(&self, _: SignComponent, _: &str) -> Result<Vec<TokenExample>, SourceError> {
        Ok(Vec::new())
    }

    fn find_best_examples(&self, _: &str, _: Option<&str>) -> Result<Vec<TokenExample>, SourceError> {
        Ok(Vec::new())
    }

    fn find_alphabet_letters(&self, _: Option<&str>, _: &str) -> Result<Vec<AlphabetLetter>, SourceError> {
        Ok(Vec::new())
    }
}
