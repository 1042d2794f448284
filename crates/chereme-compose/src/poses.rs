//! Chooses the posture of a hand for a value, in order of preference.

use chereme_motion::glam::DQuat;
use chereme_motion::{HandAngles, Side, Skeleton};
use chereme_sign::Component;
use serde::{Deserialize, Serialize};

use crate::answers::Setting;
use crate::error::Cause;
use crate::recipe::Choice;
use crate::sources::{Example, Material, Meaning, Sources, Value};

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
    pub exact: Option<Exact>,
}

impl HandPose {
    /// Returns the address of the sign that shows the posture; `None` if it is the inventory's own.
    #[must_use]
    pub fn giver(&self) -> Option<&str> {
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
pub struct Exact {
    /// The hand.
    pub side: Side,
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
const NEAR: f64 = 0.25;
/// The greatest such distance of a posture from the value that it shows.
const SHOWN: f64 = 0.2;
/// The number of examples that are tried before the next best kind of source.
const TRIES: usize = 8;

/// Returns the postures for `choice`: one, or the successive ones of a sign.
pub(crate) fn choose(
    sources: &dyn Sources,
    choice: &Choice,
    side: Side,
    setting: &Setting,
) -> Result<Vec<HandPose>, Cause> {
    match choice {
        Choice::Keep => Ok(Vec::new()),
        Choice::Value(text) => {
            let value = sources.value(Component::Configuration, text)?;
            Ok(vec![of_value(sources, &value, side, setting)?])
        }
        Choice::From(address) => {
            let material = sources.material(address)?;
            let poses = held_by(&material, side);
            if poses.is_empty() {
                let address = material.address;
                let what = "configuration";
                return Err(Cause::NothingToTake { address, what });
            }
            Ok(poses)
        }
        Choice::Best(query) => {
            let examples = sources.best(query, setting.signer.as_deref())?;
            for example in examples.iter().take(TRIES) {
                if let Some(pose) = shown(sources, example, None, side)? {
                    return Ok(vec![with_origin(pose, example, setting)]);
                }
            }
            Err(Cause::NothingFound(query.clone()))
        }
    }
}

/// Returns the posture for a value: from the same signer, another signer, a modified neighbour, or the inventory.
pub(crate) fn of_value(
    sources: &dyn Sources,
    value: &Value,
    side: Side,
    setting: &Setting,
) -> Result<HandPose, Cause> {
    let examples = sources.holding(Component::Configuration, &value.id)?;
    let same = |example: &&Example| setting.signer.is_some() && example.signer == setting.signer;
    let own = examples.iter().filter(same).take(TRIES);
    let others = examples.iter().filter(|e| !same(e)).take(TRIES);
    for example in own.chain(others) {
        if let Some(pose) = shown(sources, example, Some(&value.id), side)? {
            return Ok(with_origin(pose, example, setting));
        }
    }
    let Some(Meaning::Hand(angles)) = &value.meaning else {
        let value = value.id.clone();
        let what = "posture of the hand";
        return Err(Cause::NoMeaning { value, what });
    };
    if let Some(pose) = from_neighbour(sources, value, angles, side, setting)? {
        return Ok(pose);
    }
    Ok(HandPose {
        value: Some(value.id.clone()),
        origin: PoseOrigin::Inventory(value.inventory.clone()),
        angles: *angles,
        exact: None,
    })
}

/// Returns the posture of the same signer's nearest value, changed by the difference of the inventory's postures.
fn from_neighbour(
    sources: &dyn Sources,
    wanted: &Value,
    angles: &HandAngles,
    side: Side,
    setting: &Setting,
) -> Result<Option<HandPose>, Cause> {
    let mut near: Vec<(f64, Value, HandAngles)> = Vec::new();
    for value in sources.values(Component::Configuration) {
        if let Some(Meaning::Hand(other)) = value.meaning
            && value.id != wanted.id
        {
            let distance = distance(angles, &other);
            if distance < NEAR {
                near.push((distance, value, other));
            }
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.id.cmp(&b.1.id)));
    for (_, value, other) in near.iter().take(3) {
        for example in sources
            .holding(Component::Configuration, &value.id)?
            .iter()
            .take(TRIES)
        {
            if setting.signer.is_none() || example.signer != setting.signer {
                continue;
            }
            let Some(pose) = shown(sources, example, Some(&value.id), side)? else {
                continue;
            };
            let (a, b, c) = (pose.angles.to_array(), angles.to_array(), other.to_array());
            let changed = std::array::from_fn(|i| a[i] + b[i] - c[i]);
            return Ok(Some(HandPose {
                value: Some(wanted.id.clone()),
                origin: PoseOrigin::Neighbour {
                    sign: example.address.clone(),
                    value: value.id.clone(),
                },
                angles: HandAngles::from_array(changed),
                exact: None,
            }));
        }
    }
    Ok(None)
}

/// Returns the value that a posture shows: the nearest of the inventories, if one is near enough.
pub(crate) fn nearest_value(sources: &dyn Sources, angles: &HandAngles) -> Option<String> {
    let values = sources.values(Component::Configuration).into_iter();
    let near = values.filter_map(|value| match &value.meaning {
        Some(Meaning::Hand(own)) => Some((distance(angles, own), value.id)),
        _ => None,
    });
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.filter(|it| it.0 < SHOWN).map(|it| it.1)
}

fn distance(a: &HandAngles, b: &HandAngles) -> f64 {
    let squares = a
        .to_array()
        .into_iter()
        .zip(b.to_array())
        .map(|(x, y)| (x - y) * (x - y));
    (squares.sum::<f64>() / HandAngles::LEN as f64).sqrt()
}

/// Returns the posture in the middle of an example's span; `None` if the hand has no fingers.
fn shown(
    sources: &dyn Sources,
    example: &Example,
    value: Option<&str>,
    side: Side,
) -> Result<Option<HandPose>, Cause> {
    let material = sources.material(&example.address)?;
    let held = |side: Side| {
        material.held.iter().find(|held| {
            held.hand == Some(side)
                && held.component == Component::Configuration
                && held.feature.is_none()
                && held.value.value().is_some()
                && value.is_none_or(|value| held.value.value() == Some(value))
        })
    };
    let from = example
        .hand
        .or_else(|| {
            [side, side.other()]
                .into_iter()
                .find(|&s| held(s).is_some())
        })
        .unwrap_or(side);
    let found = held(from);
    let span = example
        .span
        .or(found.map(|held| held.span))
        .unwrap_or(material.clip.span());
    let middle = span.start().shifted(span.micros() / 2);
    let name = value.or(found.and_then(|held| held.value.value()));
    Ok(pose_at(&material, from, middle, name.map(str::to_owned)))
}

fn with_origin(pose: HandPose, example: &Example, setting: &Setting) -> HandPose {
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
fn held_by(material: &Material, side: Side) -> Vec<HandPose> {
    for side in [side, side.other()] {
        let mut held: Vec<_> = material
            .held
            .iter()
            .filter(|held| {
                held.hand == Some(side)
                    && held.component == Component::Configuration
                    && held.feature.is_none()
                    && held.value.value().is_some()
            })
            .collect();
        held.sort_by_key(|held| (held.span.start(), held.span.end()));
        let poses: Vec<HandPose> = held
            .iter()
            .filter_map(|held| {
                let middle = held.span.start().shifted(held.span.micros() / 2);
                pose_at(
                    material,
                    side,
                    middle,
                    held.value.value().map(str::to_owned),
                )
            })
            .collect();
        if !poses.is_empty() {
            return poses;
        }
    }
    let span = material.clip.span();
    let middle = span.start().shifted(span.micros() / 2);
    pose_at(material, side, middle, None).into_iter().collect()
}

fn pose_at(
    material: &Material,
    side: Side,
    at: chereme_motion::Instant,
    value: Option<String>,
) -> Option<HandPose> {
    let clip = &material.clip;
    if clip.frames() == 0 || !material.anatomy.has_fingers(side) {
        return None;
    }
    let frame = clip.rate().frame_at(at).min(clip.frames() - 1);
    let pose = clip.pose(frame);
    let angles = material.anatomy.hand_angles(clip.skeleton(), side, &pose)?;
    let joints = material.anatomy.fingers(side).into_iter().map(|joint| {
        (
            clip.skeleton().joint(joint).name.clone(),
            pose.rotations[joint],
        )
    });
    Some(HandPose {
        value,
        origin: PoseOrigin::Named(material.address.clone()),
        angles,
        exact: Some(Exact {
            side,
            joints: joints.collect(),
        }),
    })
}

/// Returns the local rotations that give the hand of `side` the posture: joint and rotation.
///
/// If the donor's finger joints have the same names, in the same order, on the same side, and give the same angles on
/// this skeleton, its rotations are used unchanged; otherwise the angles are set.
pub(crate) fn rotations(
    skeleton: &Skeleton,
    anatomy: &chereme_motion::Anatomy,
    side: Side,
    pose: &HandPose,
) -> Option<Vec<(usize, DQuat)>> {
    let fingers = anatomy.fingers(side);
    if let Some(exact) = pose.exact.as_ref().filter(|exact| exact.side == side) {
        let same = exact.joints.len() == fingers.len()
            && exact
                .joints
                .iter()
                .zip(&fingers)
                .all(|((name, _), &j)| skeleton.joint(j).name == *name);
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
            && distance(&angles, &pose.angles) < 1e-6
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
