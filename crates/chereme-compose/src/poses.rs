//! Chooses the posture of a hand for a value, in order of preference.

use chereme_motion::glam::DQuat;
use chereme_motion::{BodySide, HandAngles, Skeleton};
use chereme_sign::SignComponent;
use serde::{Deserialize, Serialize};

use crate::error::StepError;
use crate::recipe_settings::ValueChoice;
use crate::sources::{ComponentValue, MaterialSigner, MovementMaterial, RecipeSources, TokenExample, ValueMeaning};

/// A chosen posture of the hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HandPose {
    /// The configuration's value, if it is known.
    pub value: Option<String>,
    /// The source of the posture.
    pub origin: PoseOrigin,
    /// The posture.
    pub angles: HandAngles,
    /// The local rotations of the joints below the wrist, for a skeleton with the same fingers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exact: Option<ExactHandRotations>,
    /// The coding by which the sign was found to show the value; `None` for a sign that the recipe names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coding: Option<DonorCoding>,
}

/// The coding that says that a sign shows a value, and how well the movement agrees with it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DonorCoding {
    /// The annotator, if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// The confidence of the detector whose proposal was accepted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub confidence: Option<f64>,
    /// The root mean square of the differences to the angles of the inventory's posture, in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

impl std::fmt::Display for DonorCoding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let by = self.by.as_ref().map(|by| format!("coded by {by}"));
        let confidence = self.confidence.map(|sure| format!("confidence {sure:.2}"));
        let angle = self
            .angle
            .map(|angle| format!("{:.0}° from the inventory's posture", angle.to_degrees()));
        let parts: Vec<String> = [by, confidence, angle].into_iter().flatten().collect();
        write!(f, "{}", parts.join(", "))
    }
}

impl HandPose {
    /// Returns the address of the sign that shows the posture; `None` if it is the inventory's own.
    #[must_use]
    pub fn posture_giver_address(&self) -> Option<&str> {
        match &self.origin {
            PoseOrigin::Named(sign)
            | PoseOrigin::SameSigner(sign)
            | PoseOrigin::OtherSigner(sign)
            | PoseOrigin::Neighbour { sign, .. } => Some(sign),
            PoseOrigin::Inventory(_) => None,
        }
    }
}

/// Local rotations of the joints below a wrist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExactHandRotations {
    /// The hand.
    pub side: BodySide,
    /// Each joint's name and local rotation.
    pub joints: Vec<(String, DQuat)>,
}

/// The source of a posture, the most preferred first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PoseOrigin {
    /// The sign that the recipe names.
    Named(String),
    /// Another sign of the same signer.
    SameSigner(String),
    /// A sign of another signer.
    OtherSigner(String),
    /// A sign with a neighbouring value, changed by the difference between the two values in the inventory.
    Neighbour {
        /// The sign.
        sign: String,
        /// The value it holds.
        value: String,
    },
    /// The inventory's own posture.
    Inventory(String),
}

impl std::fmt::Display for PoseOrigin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Named(sign) => write!(f, "{sign}"),
            Self::SameSigner(sign) => write!(f, "{sign} (same signer)"),
            Self::OtherSigner(sign) => write!(f, "{sign} (another signer)"),
            Self::Neighbour { sign, value } => write!(f, "{sign} (its {value} changed)"),
            Self::Inventory(inventory) => write!(f, "inventory {inventory}"),
        }
    }
}

/// The greatest distance of a neighbouring value, as the root mean square of its angles' differences in radians.
const NEAR_VALUE_DISTANCE_RAD: f64 = 0.25;
/// The greatest such distance of a posture from the value that it shows.
const SHOWN_VALUE_DISTANCE_RAD: f64 = 0.2;
/// The greatest such distance of an example's posture from the value that it is coded with: 20 degrees.
const AGREEING_DISTANCE_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// The number of examples that are tried before the next best kind of source.
const MAX_EXAMPLE_TRIES: usize = 8;

/// Returns the postures for `choice`: one, or the successive ones of a sign.
pub(crate) fn choose_hand_poses(
    sources: &dyn RecipeSources,
    choice: &ValueChoice,
    side: BodySide,
    setting: &MaterialSigner,
) -> Result<Vec<HandPose>, StepError> {
    match choice {
        ValueChoice::Keep => Ok(Vec::new()),
        ValueChoice::Value(text) => {
            let value = sources.find_component_value(SignComponent::Configuration, text)?;
            Ok(vec![of_value(sources, &value, side, setting)?])
        }
        ValueChoice::From(address) => {
            let material = sources.find_material(address)?;
            let poses = held_by(&material, side);
            if poses.is_empty() {
                let address = material.address;
                let what = "configuration";
                return Err(StepError::NothingToTake { address, what });
            }
            Ok(poses)
        }
        ValueChoice::Best(query) => {
            let examples = sources.find_best_examples(query, setting.signer.as_deref())?;
            for example in examples.iter().take(MAX_EXAMPLE_TRIES) {
                if let Some(pose) = pose_shown_by_example(sources, example, None, side)? {
                    return Ok(vec![with_origin(pose, example, setting)]);
                }
            }
            Err(StepError::NothingFound(query.clone()))
        }
    }
}

/// Returns the posture for a value: from the same signer, another signer, a modified neighbour, or the inventory. Signs
/// whose hand shows another posture than they are coded with give none.
pub(crate) fn of_value(
    sources: &dyn RecipeSources,
    value: &ComponentValue,
    side: BodySide,
    setting: &MaterialSigner,
) -> Result<HandPose, StepError> {
    let examples = sources.holding(SignComponent::Configuration, &value.id)?;
    let same = |example: &&TokenExample| setting.signer.is_some() && example.signer == setting.signer;
    let same_examples = examples.iter().filter(same).take(MAX_EXAMPLE_TRIES);
    let others = examples.iter().filter(|e| !same(e)).take(MAX_EXAMPLE_TRIES);
    for example in same_examples.chain(others) {
        if let Some(pose) = pose_agreeing_with_value(sources, example, value, side)? {
            return Ok(with_origin(pose, example, setting));
        }
    }
    let Some(ValueMeaning::Hand(angles)) = &value.meaning else {
        let value = value.id.clone();
        let what = "posture of the hand";
        return Err(StepError::NoMeaning { value, what });
    };
    if let Some(pose) = from_neighbour(sources, value, angles, side, setting)? {
        return Ok(pose);
    }
    Ok(HandPose {
        value: Some(value.id.clone()),
        origin: PoseOrigin::Inventory(value.inventory.clone()),
        angles: *angles,
        exact: None,
        coding: None,
    })
}

/// Returns the posture of the same signer's nearest value, changed by the difference of the inventory's postures.
fn from_neighbour(
    sources: &dyn RecipeSources,
    wanted: &ComponentValue,
    angles: &HandAngles,
    side: BodySide,
    setting: &MaterialSigner,
) -> Result<Option<HandPose>, StepError> {
    let mut near: Vec<(f64, ComponentValue, HandAngles)> = Vec::new();
    for value in sources.list_component_values(SignComponent::Configuration) {
        if let Some(ValueMeaning::Hand(other)) = value.meaning
            && value.id != wanted.id
        {
            let distance = hand_angle_distance(angles, &other);
            if distance < NEAR_VALUE_DISTANCE_RAD {
                near.push((distance, value, other));
            }
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.id.cmp(&b.1.id)));
    for (_, value, other) in near.iter().take(3) {
        for example in sources
            .holding(SignComponent::Configuration, &value.id)?
            .iter()
            .take(MAX_EXAMPLE_TRIES)
        {
            // Another signer's hand differs by more than the neighbouring value does.
            if setting.signer.is_none() || example.signer != setting.signer {
                continue;
            }
            let Some(pose) = pose_agreeing_with_value(sources, example, value, side)? else {
                continue;
            };
            let (a, b, c) = (pose.angles.to_array(), angles.to_array(), other.to_array());
            // How this signer makes the neighbour differ from the inventory carries over to the wanted value.
            let changed = std::array::from_fn(|i| a[i] + b[i] - c[i]);
            return Ok(Some(HandPose {
                value: Some(wanted.id.clone()),
                origin: PoseOrigin::Neighbour {
                    sign: example.address.clone(),
                    value: value.id.clone(),
                },
                angles: HandAngles::from_array(changed),
                exact: None,
                coding: pose.coding,
            }));
        }
    }
    Ok(None)
}

/// Returns the value that a posture shows: the nearest of the inventories, if one is near enough.
pub(crate) fn nearest_value(sources: &dyn RecipeSources, angles: &HandAngles) -> Option<String> {
    let values = sources.list_component_values(SignComponent::Configuration).into_iter();
    let near = values.filter_map(|value| match &value.meaning {
        Some(ValueMeaning::Hand(own)) => Some((hand_angle_distance(angles, own), value.id)),
        _ => None,
    });
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|candidate| candidate.0 < SHOWN_VALUE_DISTANCE_RAD)
        .map(|candidate| candidate.1)
}

fn hand_angle_distance(a: &HandAngles, b: &HandAngles) -> f64 {
    let squares = a
        .to_array()
        .into_iter()
        .zip(b.to_array())
        .map(|(x, y)| (x - y) * (x - y));
    (squares.sum::<f64>() / HandAngles::HAND_ANGLE_COUNT as f64).sqrt()
}

/// Returns the posture of an example that is coded with a value, with its coding; `None` if the hand has no fingers, or its
/// posture is another one than the inventory's.
fn pose_agreeing_with_value(
    sources: &dyn RecipeSources,
    example: &TokenExample,
    value: &ComponentValue,
    side: BodySide,
) -> Result<Option<HandPose>, StepError> {
    let Some(pose) = pose_shown_by_example(sources, example, Some(&value.id), side)? else {
        return Ok(None);
    };
    let angle = match &value.meaning {
        Some(ValueMeaning::Hand(own)) => Some(hand_angle_distance(&pose.angles, own)),
        _ => None,
    };
    let coding = Some(DonorCoding {
        angle,
        ..example.coding.clone()
    });
    let agrees = angle.is_none_or(|angle| angle < AGREEING_DISTANCE_RAD);
    Ok(agrees.then_some(HandPose { coding, ..pose }))
}

/// Returns the posture in the middle of an example's span; `None` if the hand has no fingers.
fn pose_shown_by_example(
    sources: &dyn RecipeSources,
    example: &TokenExample,
    value: Option<&str>,
    side: BodySide,
) -> Result<Option<HandPose>, StepError> {
    let material = sources.find_material(&example.address)?;
    let held_value = |side: BodySide| {
        material.held.iter().find(|held| {
            held.hand == Some(side)
                && held.component == SignComponent::Configuration
                && held.feature.is_none()
                && held.value.reading_value().is_some()
                && value.is_none_or(|value| held.value.reading_value() == Some(value))
        })
    };
    let from = example
        .hand
        .or_else(|| {
            [side, side.opposite_side()]
                .into_iter()
                .find(|&s| held_value(s).is_some())
        })
        .unwrap_or(side);
    let source_value = held_value(from);
    let span = example
        .span
        .or(source_value.map(|held| held.span))
        .unwrap_or(material.clip.clip_span());
    let middle = span.span_start_instant().shifted_instant(span.span_micros() / 2);
    let name = value.or(source_value.and_then(|held| held.value.reading_value()));
    Ok(pose_at(&material, from, middle, name.map(str::to_owned)))
}

fn with_origin(pose: HandPose, example: &TokenExample, setting: &MaterialSigner) -> HandPose {
    let same = setting.signer.is_some() && example.signer == setting.signer;
    let address = example.address.clone();
    let origin = if same {
        PoseOrigin::SameSigner(address)
    } else {
        PoseOrigin::OtherSigner(address)
    };
    HandPose { origin, ..pose }
}

/// Returns the successive postures of `side` in a sign; those of the other hand if that side has none; the one in the
/// middle if no configuration is annotated.
fn held_by(material: &MovementMaterial, side: BodySide) -> Vec<HandPose> {
    for side in [side, side.opposite_side()] {
        let mut held_values: Vec<_> = material
            .held
            .iter()
            .filter(|held| {
                held.hand == Some(side)
                    && held.component == SignComponent::Configuration
                    && held.feature.is_none()
                    && held.value.reading_value().is_some()
            })
            .collect();
        held_values.sort_by_key(|held| (held.span.span_start_instant(), held.span.span_end_instant()));
        let poses: Vec<HandPose> = held_values
            .iter()
            .filter_map(|held| {
                let middle = held
                    .span
                    .span_start_instant()
                    .shifted_instant(held.span.span_micros() / 2);
                pose_at(material, side, middle, held.value.reading_value().map(str::to_owned))
            })
            .collect();
        if !poses.is_empty() {
            return poses;
        }
    }
    let span = material.clip.clip_span();
    let middle = span.span_start_instant().shifted_instant(span.span_micros() / 2);
    pose_at(material, side, middle, None).into_iter().collect()
}

fn pose_at(
    material: &MovementMaterial,
    side: BodySide,
    at: chereme_motion::RecordingInstant,
    value: Option<String>,
) -> Option<HandPose> {
    let clip = &material.clip;
    if clip.clip_frame_count() == 0 || !material.anatomy.has_fingers(side) {
        return None;
    }
    let frame = clip
        .clip_frame_rate()
        .nearest_frame_at(at)
        .min(clip.clip_frame_count() - 1);
    let pose = clip.clip_pose_at(frame);
    let angles = material.anatomy.hand_angles(clip.clip_skeleton(), side, &pose)?;
    let joints = material
        .anatomy
        .finger_joints(side)
        .into_iter()
        .map(|joint| (clip.clip_skeleton().joint_at(joint).name.clone(), pose.rotations[joint]));
    Some(HandPose {
        value,
        origin: PoseOrigin::Named(material.address.clone()),
        angles,
        exact: Some(ExactHandRotations {
            side,
            joints: joints.collect(),
        }),
        coding: None,
    })
}

/// Returns the local rotations that give the hand of `side` the posture: joint and rotation.
///
/// If the donor's finger joints have the same names, in the same order, on the same side, and give the same angles on
/// this skeleton, its rotations are used unchanged; otherwise the angles are set.
pub(crate) fn hand_pose_rotations(
    skeleton: &Skeleton,
    anatomy: &chereme_motion::BodyAnatomy,
    side: BodySide,
    pose: &HandPose,
) -> Option<Vec<(usize, DQuat)>> {
    let fingers = anatomy.finger_joints(side);
    if let Some(exact) = pose.exact.as_ref().filter(|exact| exact.side == side) {
        let same = exact.joints.len() == fingers.len()
            && exact
                .joints
                .iter()
                .zip(&fingers)
                .all(|((name, _), &j)| skeleton.joint_at(j).name == *name);
        let trial = same.then(|| {
            let mut trial = skeleton.rest_pose();
            for ((_, rotation), &joint) in exact.joints.iter().zip(&fingers) {
                trial.rotations[joint] = *rotation;
            }
            trial
        });
        // The same names on other bones would give different angles.
        if let Some(trial) = trial
            && let Some(angles) = anatomy.hand_angles(skeleton, side, &trial)
            && hand_angle_distance(&angles, &pose.angles) < 1e-6
        {
            return Some(fingers.iter().map(|&j| (j, trial.rotations[j])).collect());
        }
    }
    let mut trial = skeleton.rest_pose();
    if !anatomy.set_hand_angles(skeleton, side, &pose.angles, &mut trial) {
        return None;
    }
    let digit = |&joint: &usize| anatomy.part_of(joint).is_some();
    Some(
        fingers
            .into_iter()
            .filter(digit)
            .map(|j| (j, trial.rotations[j]))
            .collect(),
    )
}
