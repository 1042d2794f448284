//! Synthetic bodies, movement and a small corpus for tests.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3, EulerRot};
use chereme_motion::{
    BodyAnatomy, BodySide, Clip, FrameRate, HandAngles, JointChannel, ModelPose, RecordingInstant, Skeleton,
    SkeletonJoint, TimeSpan,
};
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};

use crate::error::{MakeError, SourceError, StepError};
use crate::poses::DonorCoding;
use crate::recipe::Recipe;
use crate::recipe_inputs::{RecipeInput, RecipeInputs};
use crate::resolve::ResolvedRecipe;
use crate::sources::*;

/// The local axes of a body's joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Axes {
    /// All parallel to model space at rest.
    Plain,
    /// Each joint is rotated differently at rest, left and right unlike.
    Odd,
}

/// Returns a body of 51 joints in a T-pose with full hands, `size` times the size of a tall person.
pub(crate) fn skeleton(axes: Axes, size: f64) -> Skeleton {
    let mut names: Vec<(String, Option<usize>, DVec3, Option<DVec3>)> = Vec::new();
    let mut add = |name: &str, parent: Option<usize>, at: [f64; 3], tip: Option<[f64; 3]>| {
        names.push((
            name.to_owned(),
            parent,
            DVec3::from(at) * size,
            tip.map(|t| DVec3::from(t) * size),
        ));
        names.len() - 1
    };
    let hips = add("Hips", None, [0.0, 0.95, 0.0], None);
    let spine = add("Spine", Some(hips), [0.0, 1.05, 0.0], None);
    let chest = add("Spine2", Some(spine), [0.0, 1.25, 0.0], None);
    let neck = add("Neck", Some(chest), [0.0, 1.47, 0.0], None);
    add("Head", Some(neck), [0.0, 1.56, 0.0], Some([0.0, 0.2, 0.0]));
    for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
        let clavicle = add(&format!("{side}Shoulder"), Some(chest), [0.03 * x, 1.42, 0.0], None);
        let upper = add(&format!("{side}Arm"), Some(clavicle), [0.18 * x, 1.42, 0.0], None);
        let fore = add(&format!("{side}ForeArm"), Some(upper), [0.46 * x, 1.42, 0.0], None);
        let hand = add(&format!("{side}Hand"), Some(fore), [0.71 * x, 1.42, 0.0], None);
        for (finger, z) in [("Index", 0.03), ("Middle", 0.01), ("Ring", -0.01), ("Pinky", -0.03)] {
            let mut parent = hand;
            for (n, along) in [(1, 0.80), (2, 0.84), (3, 0.865)] {
                let tip = (n == 3).then_some([0.02 * x, 0.0, 0.0]);
                parent = add(
                    &format!("{side}Hand{finger}{n}"),
                    Some(parent),
                    [along * x, 1.42, z],
                    tip,
                );
            }
        }
        let mut parent = hand;
        for (n, along, z) in [(1, 0.73, 0.03), (2, 0.75, 0.06), (3, 0.77, 0.08)] {
            let tip = (n == 3).then_some([0.015 * x, 0.0, 0.015]);
            parent = add(&format!("{side}HandThumb{n}"), Some(parent), [along * x, 1.42, z], tip);
        }
        let thigh = add(&format!("{side}UpLeg"), Some(hips), [0.09 * x, 0.9, 0.0], None);
        let shin = add(&format!("{side}Leg"), Some(thigh), [0.09 * x, 0.5, 0.0], None);
        add(&format!("{side}Foot"), Some(shin), [0.09 * x, 0.08, 0.0], None);
    }
    let turned: Vec<DQuat> = (0..names.len())
        .map(|n| match axes {
            Axes::Plain => DQuat::IDENTITY,
            Axes::Odd => {
                let n = n as f64;
                DQuat::from_euler(EulerRot::XYZ, 1.3 * n, 0.7 * n + 1.0, 2.1 * n)
            }
        })
        .collect();
    let joints = names.iter().enumerate().map(|(n, (name, parent, at, tip))| {
        let above = parent.map_or(DQuat::IDENTITY, |p| turned[p]);
        let from = parent.map_or(DVec3::ZERO, |p| names[p].2);
        SkeletonJoint {
            name: name.clone(),
            parent: *parent,
            offset: above.inverse() * (*at - from),
            rest: (above.inverse() * turned[n]).normalize(),
            tip: tip.map(|tip| turned[n].inverse() * tip),
        }
    });
    Skeleton::new(joints.collect()).expect("a tree")
}

/// Returns signing movement: both arms bent before the chest and moving independently, fingers curling and the
/// trunk swaying a little; each `seed` gives a different movement.
pub(crate) fn clip(skeleton: &Arc<Skeleton>, frames: usize, seed: f64) -> Clip {
    let rest = skeleton.rest_model_pose();
    let rate = FrameRate::new(120, 1).expect("rate");
    let mut columns: Vec<Vec<DQuat>> = Vec::new();
    let mut moved: Vec<Vec<DQuat>> = Vec::new();
    for (n, joint) in skeleton.skeleton_joints().iter().enumerate() {
        let deltas: Vec<DQuat> = (0..frames).map(|f| bend(&joint.name, f as f64 / 120.0, seed)).collect();
        let carried: Vec<DQuat> = match joint.parent {
            None => deltas,
            Some(parent) => deltas.iter().zip(&moved[parent]).map(|(d, p)| *p * *d).collect(),
        };
        let model: Vec<DQuat> = carried.iter().map(|d| *d * rest.model_joint_rotation(n)).collect();
        columns.push(model);
        moved.push(carried);
    }
    let channels = skeleton
        .skeleton_joints()
        .iter()
        .enumerate()
        .map(|(n, joint)| JointChannel {
            rotations: (0..frames)
                .map(|f| {
                    let above = joint.parent.map_or(DQuat::IDENTITY, |p| columns[p][f]);
                    (above.inverse() * columns[n][f]).normalize()
                })
                .collect(),
            translations: (n == 0).then(|| {
                (0..frames)
                    .map(|f| joint.offset + DVec3::new(0.01 * (f as f64 * 0.02).sin(), 0.0, 0.0))
                    .collect()
            }),
        });
    Clip::new(Arc::clone(skeleton), rate, channels.collect()).expect("a clip")
}

fn bend(name: &str, t: f64, seed: f64) -> DQuat {
    let wave = |speed: f64, phase: f64| (TAU * speed * t + phase + seed).sin();
    let (side, part) = match name.strip_prefix("Left") {
        Some(part) => (-1.0, part),
        None => (1.0, name.strip_prefix("Right").unwrap_or(name)),
    };
    let apart = if side < 0.0 { 0.8 } else { 0.0 };
    let turn = |x: f64, y: f64, z: f64| DQuat::from_euler(EulerRot::ZYX, side * z, side * y, x);
    match part {
        "Spine" => turn(0.05 * wave(0.4, 0.3), 0.1 * wave(0.3, 0.0) * side, 0.0),
        "Head" => turn(0.1 * wave(0.5, 1.0), 0.2 * wave(0.4, 2.0), 0.0),
        "Arm" => turn(
            0.1 * wave(1.0, apart),
            0.45 + 0.15 * wave(1.1, apart),
            1.1 + 0.15 * wave(0.8, apart),
        ),
        "ForeArm" => turn(0.3 * wave(0.9, apart), 1.4 + 0.3 * wave(1.2, apart), -0.2),
        "Hand" => turn(0.2 * wave(1.5, apart), 0.1 * wave(1.4, apart), 0.2 * wave(1.3, apart)),
        _ if part.contains("Thumb") => turn(0.0, -0.2 - 0.05 * wave(1.0, 0.0), 0.1),
        _ if part.starts_with("Hand") => turn(0.0, 0.0, 0.4 + 0.1 * wave(1.0, apart)),
        _ => DQuat::IDENTITY,
    }
}

/// Returns a span in milliseconds.
pub(crate) fn span(start: i64, end: i64) -> TimeSpan {
    TimeSpan::span_between(RecordingInstant::from_millis(start), RecordingInstant::from_millis(end))
}

/// Returns a component value of a sign.
pub(crate) fn held(hand: BodySide, component: SignComponent, value: &str, span: TimeSpan) -> HeldValue {
    HeldValue {
        hand: Some(hand),
        component,
        feature: None,
        value: ComponentReading::Value(value.into()),
        span,
    }
}

/// A corpus of a few signs, in memory.
pub(crate) struct Shelf {
    pub(crate) materials: BTreeMap<String, MovementMaterial>,
    pub(crate) values: Vec<(SignComponent, ComponentValue)>,
    /// Expressions of the face by their material.
    pub(crate) expressions: BTreeMap<String, (ExpressionFunction, ExpressionMilestones)>,
}

impl Shelf {
    /// Returns two signers (one of odd axes and smaller), with four signs, and a few values.
    pub(crate) fn new() -> Self {
        let plain = Arc::new(skeleton(Axes::Plain, 1.0));
        let odd = Arc::new(skeleton(Axes::Odd, 0.85));
        let configuration = SignComponent::Configuration;
        let material =
            |gloss: &str, skeleton: &Arc<Skeleton>, signer: &str, seed: f64, held: Vec<HeldValue>| MovementMaterial {
                address: format!("token:{gloss}"),
                hash: format!("{gloss}-{seed}"),
                gloss: gloss.to_owned(),
                signer: Some(signer.to_owned()),
                handedness: SignerHandedness::Right,
                clip: clip(skeleton, 120, seed),
                anatomy: Arc::new(BodyAnatomy::detect_anatomy(skeleton)),
                curves: Vec::new(),
                held,
            };
        let all = [
            material(
                "ESCARGOT",
                &plain,
                "signer:1",
                0.0,
                vec![
                    held(BodySide::Right, configuration, "Y", span(200, 800)),
                    held(BodySide::Right, SignComponent::Placement, "chest", span(200, 800)),
                    held(BodySide::Right, SignComponent::Movement, "arc", span(200, 800)),
                ],
            ),
            material(
                "BOL",
                &plain,
                "signer:1",
                1.0,
                vec![
                    held(BodySide::Right, configuration, "B", span(0, 400)),
                    held(BodySide::Right, configuration, "S", span(600, 1000)),
                    held(BodySide::Left, configuration, "B", span(0, 1000)),
                    held(BodySide::Left, SignComponent::Placement, "high-left", span(0, 1000)),
                ],
            ),
            material(
                "LIMACE",
                &odd,
                "signer:2",
                2.0,
                vec![held(BodySide::Right, configuration, "U", span(100, 900))],
            ),
            material(
                "CHAT",
                &odd,
                "signer:2",
                3.0,
                vec![held(BodySide::Left, configuration, "S", span(100, 900))],
            ),
        ];
        let pose = |curl: f64| {
            let mut angles = HandAngles::default();
            for (n, finger) in angles.fingers.iter_mut().enumerate() {
                finger.flexion = [curl * n as f64 / 3.0, curl, curl / 2.0];
            }
            Some(ValueMeaning::Hand(angles))
        };
        let value = |id: &str, meaning| ComponentValue {
            id: id.to_owned(),
            inventory: "configurations".into(),
            meaning,
        };
        let place = |id: &str, landmark: &str, offset: [f64; 3]| ComponentValue {
            id: id.to_owned(),
            inventory: "placements".into(),
            meaning: Some(ValueMeaning::Place(BodyRelativePlace {
                landmark: landmark.to_owned(),
                offset,
            })),
        };
        Self {
            materials: all.into_iter().map(|m| (m.gloss.clone(), m)).collect(),
            expressions: BTreeMap::new(),
            values: vec![
                (configuration, value("Y", pose(0.3))),
                (configuration, value("U", pose(0.7))),
                (configuration, value("H", pose(0.8))),
                (configuration, value("V", pose(1.6))),
                (configuration, value("B", pose(0.1))),
                (configuration, value("S", pose(0.2))),
                (configuration, value("claw", None)),
                (SignComponent::Placement, place("chin", "chin", [0.0, 0.0, 0.3])),
                (
                    SignComponent::Placement,
                    place("neutral-space", "neutral-space", [0.0; 3]),
                ),
            ],
        }
    }
}

impl RecipeSources for Shelf {
    fn find_material(&self, address: &str) -> Result<MovementMaterial, SourceError> {
        let gloss = address.strip_prefix("token:").unwrap_or(address);
        self.materials.get(gloss).cloned().ok_or_else(|| SourceError::Missing {
            address: address.to_owned(),
            nearest: chereme_sign::text::nearest_candidate(gloss, self.materials.keys().map(String::as_str))
                .map(str::to_owned),
        })
    }

    fn find_face_expression(&self, address: &str, _function: Option<&str>) -> Result<ExpressionSource, SourceError> {
        let material = self.find_material(address)?;
        match self.expressions.get(&material.gloss) {
            Some((function, milestones)) => Ok(ExpressionSource {
                material,
                function: function.clone(),
                milestones: *milestones,
            }),
            None => Err(SourceError::Expression {
                address: address.to_owned(),
                why: "it has no milestones".to_owned(),
                remedy: None,
            }),
        }
    }

    fn stage(&self, signer: Option<&str>) -> Result<MovementMaterial, SourceError> {
        let found = self
            .materials
            .values()
            .find(|m| signer.is_none() || m.signer.as_deref() == signer || Some(m.address.as_str()) == signer);
        let mut material = found.cloned().ok_or_else(|| SourceError::Missing {
            address: signer.unwrap_or_default().to_owned(),
            nearest: None,
        })?;
        material.clip = Clip::from_rest_pose(
            Arc::clone(material.clip.clip_skeleton()),
            material.clip.clip_frame_rate(),
            1,
        );
        material.held.clear();
        if signer.is_some_and(|name| name.starts_with("token:")) {
            material.hash.push_str(" at rest");
        }
        material.address = "stage".into();
        material.gloss = "rest".into();
        Ok(material)
    }

    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError> {
        let mut of = self.values.iter().filter(|(c, _)| *c == component).map(|(_, v)| v);
        of.clone()
            .find(|v| v.id == text)
            .cloned()
            .ok_or_else(|| SourceError::UnknownValue {
                component,
                text: text.to_owned(),
                nearest: chereme_sign::text::nearest_candidate(text, of.by_ref().map(|v| v.id.as_str()))
                    .map(str::to_owned),
            })
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        self.values
            .iter()
            .filter(|(c, _)| *c == component)
            .map(|(_, v)| v.clone())
            .collect()
    }

    fn holding(&self, component: SignComponent, value: &str) -> Result<Vec<TokenExample>, SourceError> {
        Ok(self
            .materials
            .values()
            .flat_map(|m| m.held.iter().map(move |h| (m, h)))
            .filter(|(_, h)| h.component == component && h.value.reading_value() == Some(value))
            .map(|(m, h)| TokenExample {
                coding: DonorCoding::default(),
                address: m.address.clone(),
                signer: m.signer.clone(),
                hand: h.hand,
                span: Some(h.span),
            })
            .collect())
    }

    fn find_best_examples(&self, query: &str, _: Option<&str>) -> Result<Vec<TokenExample>, SourceError> {
        let value = query.split('=').nth(1).unwrap_or_default();
        let value = value.split_whitespace().next().unwrap_or_default();
        self.holding(SignComponent::Configuration, value)
    }

    fn find_alphabet_letters(&self, _: Option<&str>, word: &str) -> Result<Vec<AlphabetLetter>, SourceError> {
        word.chars()
            .map(|c| {
                Ok(AlphabetLetter {
                    letter: c.to_string(),
                    value: self.find_component_value(SignComponent::Configuration, &c.to_string())?,
                    fingers: None,
                    palm: None,
                    strokes: Vec::new(),
                })
            })
            .collect()
    }

    fn learned_profile(&self) -> Result<Option<LearnedProfile>, SourceError> {
        Ok(Some(LearnedProfile {
            arms: None,
            reaches: None,
            fingers: Some(LearnedCourse {
                recordings: Vec::new(),
                shares: vec![0.0, 0.1, 0.9, 1.0],
                transitions: 12,
            }),
        }))
    }

    fn spelling_times(&self) -> Result<SpellingTimes, SourceError> {
        let median = |seconds, count| Some(MedianTime { seconds, count });
        Ok(SpellingTimes {
            hold: median(0.3, 9),
            change: median(0.15, 8),
        })
    }
}

/// Returns the positions of every fingertip and wrist of `side` at every frame.
pub(crate) fn tips(clip: &Clip, side: BodySide) -> Vec<Vec<DVec3>> {
    let skeleton = clip.clip_skeleton();
    let anatomy = BodyAnatomy::detect_anatomy(skeleton);
    let mut joints = anatomy.finger_joints(side);
    joints.extend(anatomy.arm_chain(side).map(|arm| arm.hand));
    (0..clip.clip_frame_count())
        .map(|frame| {
            let model = clip.model_pose(frame);
            let at = |&joint: &usize| {
                model
                    .bone_tip_position(skeleton, joint)
                    .unwrap_or(model.model_joint_position(joint))
            };
            joints.iter().map(at).collect()
        })
        .collect()
}

/// Returns the largest distance between the same points of two clips' hands.
pub(crate) fn farthest(a: &Clip, b: &Clip) -> f64 {
    assert_eq!(a.clip_frame_count(), b.clip_frame_count());
    let mut farthest: f64 = 0.0;
    for side in BodySide::BOTH_SIDES {
        for (x, y) in tips(a, side).iter().flatten().zip(tips(b, side).iter().flatten()) {
            farthest = farthest.max(x.distance(*y));
        }
    }
    farthest
}

/// Returns the model-space posture of a frame.
pub(crate) fn model(clip: &Clip, frame: usize) -> ModelPose {
    clip.model_pose(frame)
}

/// Restores earlier choices: loads the movement that `inputs` name and nothing else.
///
/// # Errors
/// [`MakeError`] if a source is gone or its movement has changed.
pub(crate) fn restore_recipe_inputs(
    recipe: &Recipe,
    inputs: RecipeInputs,
    sources: &dyn RecipeSources,
) -> Result<ResolvedRecipe, MakeError> {
    let mut materials = BTreeMap::new();
    for (path, input) in &inputs.0 {
        let RecipeInput::Material(stored) = input else {
            continue;
        };
        let fault = |cause| MakeError {
            path: path.clone(),
            step: stored.address.clone(),
            cause,
        };
        let mut material = sources
            .find_material(&stored.address)
            .map_err(|error| fault(error.into()))?;
        // A recording that only gave its body at rest is such a body again.
        if material.hash != stored.hash
            && let Ok(body) = sources.stage(Some(&stored.address))
        {
            material = body;
        }
        // The same name may stand for new movement, from which another sign would come.
        if material.hash != stored.hash {
            let address = stored.address.clone();
            return Err(fault(StepError::Changed { address }));
        }
        if material.clip.clip_frame_count() == 0 {
            return Err(fault(StepError::Empty(material.address)));
        }
        material.held.clone_from(&stored.held);
        material.gloss.clone_from(&stored.gloss);
        material.handedness = stored.handedness;
        materials.insert(path.clone(), Arc::new(material));
    }
    Ok(ResolvedRecipe {
        recipe: recipe.clone(),
        inputs,
        materials,
    })
}
