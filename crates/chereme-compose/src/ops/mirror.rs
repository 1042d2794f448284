//! `swap` and `mirror`: give one arm the movement of the other, mirrored at the body's sagittal plane.
//!
//! With C the rotation of the joint that carries both arms, R that of an arm's joint j and m its counterpart, all in
//! model space, and a zero for the rest pose, the movement of j relative to the trunk is `D = (C C₀⁻¹)⁻¹ R_j R_j0⁻¹`.
//! Its mirror image `S D S` (S reflects across the plane between the shoulders at rest) is given to m:
//! `R_m = C C₀⁻¹ · S D S · K · R_m0`, where K, the shortest rotation, compensates for arms whose bones are not symmetric
//! at rest. Applied twice, this gives R again. All this is done joint by joint in local space.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, Skeleton};
use chereme_sign::words::InterfaceText;
use chereme_sign::{ComponentReading, SignComponent};

use crate::error::StepError;
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::work::{JointColumns, JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorNeighbours, OperatorSyntax, Step, StepOperator,
    StepOutcome,
};
use crate::text::{ParsedText, RecipeParser};
use crate::units::HandChoice;

/// The operator that exchanges the arms; it has no settings.
pub(crate) struct Swap;

impl OperatorSyntax for Swap {
    const OPERATOR_NAME: &'static str = "swap";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "swap",
        "arms-exchanged": "swap"
    );

    fn parse_operator_text(_parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        Ok(Self)
    }

    fn default_operator() -> Self {
        Self
    }
}

impl Display for Swap {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::OPERATOR_NAME)
    }
}

impl StepOperator for Swap {
    fn apply_operator(&self, work: &mut WorkingClip, _given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        Ok(swap_arm_movements(work)?.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((ContactEffect::Swapped, ContactsToKeep::None))
    }

    fn relation_to_previous(&self, before: &mut Step) -> OperatorNeighbours {
        match before {
            Step::Swap => OperatorNeighbours::Nothing,
            _ => OperatorNeighbours::Apart,
        }
    }
}

/// Settings of `mirror right`: the arm that is copied.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MirrorSettings {
    /// The arm whose movement the other arm takes; never both.
    #[serde(default = "crate::recipe_settings::dominant_hand_choice")]
    pub from: HandChoice,
}

impl OperatorSyntax for MirrorSettings {
    const OPERATOR_NAME: &'static str = "mirror";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "mirror",
        "left-arm-like": "mirror right"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let from = parser.parse_hand_choice().unwrap_or(HandChoice::Dominant);
        Ok(Self { from })
    }

    fn default_operator() -> Self {
        let from = HandChoice::Dominant;
        Self { from }
    }
}

impl Display for MirrorSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.from {
            HandChoice::Dominant => f.write_str("mirror"),
            from => write!(f, "mirror {}", from.hand_choice_name()),
        }
    }
}

impl StepOperator for MirrorSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        match self.from {
            HandChoice::Both => Err(RecipeError::Empty {
                step: Self::OPERATOR_NAME,
                what: "one arm is copied to the other; name right, left, dominant or weak",
            }),
            HandChoice::Right | HandChoice::Left | HandChoice::Dominant | HandChoice::Weak => Ok(()),
        }
    }

    fn apply_operator(&self, work: &mut WorkingClip, _given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let from = self.from.chosen_sides(work.handedness)[0];
        Ok(mirror_arm_movement(work, from)?.into())
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        let from = self.from.chosen_sides(handedness)[0];
        Some((ContactEffect::Copied(from), ContactsToKeep::None))
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let field = OperatorField::Hand(&mut self.from);
        let copied = InterfaceText::from_id("setting-copied-from");
        vec![FieldSetting::new(copied, field)]
    }
}

/// Exchanges the movements of the arms.
pub(crate) fn swap_arm_movements(work: &mut WorkingClip) -> Result<Vec<String>, StepError> {
    let plan = MirrorPlan::mirror_plan_from(work)?;
    // All images come before any is written, because each arm is read for the other.
    let images = plan
        .pairs
        .iter()
        .map(|pair| (pair, plan.mirrored_joint_image(work, pair)));
    let mirrored: Vec<(&MirroredJointPair, MirroredColumn)> = images.collect();
    let did = plan.write_mirrored_columns(work, mirrored);
    for note in &mut work.notes {
        turn_over(note);
    }
    work.note_changed_groups(arms(&BodySide::BOTH_SIDES), "swap");
    Ok(did)
}

/// Gives the other arm the mirror image of the movement of `from`.
pub(crate) fn mirror_arm_movement(work: &mut WorkingClip, from: BodySide) -> Result<Vec<String>, StepError> {
    let plan = MirrorPlan::mirror_plan_from(work)?;
    let copied = plan.pairs.iter().filter(|pair| pair.side == from);
    let images = copied.map(|pair| (pair, plan.mirrored_joint_image(work, pair)));
    let mirrored: Vec<(&MirroredJointPair, MirroredColumn)> = images.collect();
    let mut did = plan.write_mirrored_columns(work, mirrored);
    did.extend(report_crossing_hands(work, &plan));
    work.notes.retain(|note| note.hand != Some(from.opposite_side()));
    let copies: Vec<GeneratedNote> = work
        .notes
        .iter()
        .filter(|note| note.hand == Some(from))
        .cloned()
        .map(|mut note| {
            turn_over(&mut note);
            note
        })
        .collect();
    work.notes.extend(copies);
    let operator = format!("mirror {}", from.body_side_name());
    // A value of the sign as a whole belongs to the dominant hand, and hands with equal values count as two.
    let copied = work.handedness.signer_dominant_side() != from;
    for note in work.notes.iter_mut().filter(|note| note.hand.is_none()) {
        match &note.about {
            NoteSubject::Component(_, Some(feature)) if feature == "handedness" => {
                note.value = ComponentReading::Unset;
            }
            NoteSubject::Component(component, _) if copied && *component != SignComponent::NonManual => {
                note.value = ComponentReading::Unset;
            }
            _ => {}
        }
    }
    work.note_changed_groups(arms(&[from.opposite_side()]), &operator);
    Ok(did)
}

/// Reports hands that are each other's mirror image and pass through each other: a joint of one is beyond the plane
/// between them.
fn report_crossing_hands(work: &WorkingClip, plan: &MirrorPlan) -> Option<String> {
    let upper = |side| Some(work.anatomy.arm_chain(side)?.upper);
    let (left, right) = (upper(BodySide::Left)?, upper(BodySide::Right)?);
    let hand = work.anatomy.arm_chain(BodySide::Left)?.hand;
    let below = work.skeleton.joint_subtree(hand);
    let lower_pairs = plan.pairs.iter().filter(|pair| below.contains(&pair.joint));
    let pairs: Vec<(usize, usize)> = lower_pairs.map(|pair| (pair.joint, pair.other)).collect();
    let all = pairs.iter().flat_map(|&(a, b)| [a, b]).chain([left, right]);
    let columns = JointColumns::joint_columns_of(work, all);
    let offset = |from: usize, to: usize, frame: usize| {
        columns.joint_positions(to)[frame] - columns.joint_positions(from)[frame]
    };
    let crossed = |frame: &usize| {
        let across = offset(right, left, *frame);
        pairs
            .iter()
            .any(|&(left, right)| offset(right, left, *frame).dot(across) < 0.0)
    };
    let frames: Vec<usize> = (0..work.frames).filter(crossed).collect();
    let first = work.rate.frame_start_instant(*frames.first()?);
    Some(format!(
        "the hands go through each other in {} frames, from {first} on; take one aside, as with: \
         place left by left 5cm",
        frames.len()
    ))
}

fn arms(sides: &[BodySide]) -> Vec<JointGroup> {
    sides
        .iter()
        .flat_map(|&side| [JointGroup::Arm(side), JointGroup::Fingers(side)])
        .collect()
}

/// Replaces the hand by the other one, and the side in values such as `high-left`.
fn turn_over(note: &mut GeneratedNote) {
    let manual = |component: &SignComponent| *component != SignComponent::NonManual;
    match (note.hand, &note.about) {
        (Some(side), _) => note.hand = Some(side.opposite_side()),
        (None, NoteSubject::Component(component, _)) if manual(component) => {}
        _ => return,
    }
    if let (NoteSubject::Component(..), ComponentReading::Value(value)) = (&note.about, &mut note.value) {
        let words = value.split_inclusive(['-', ' ', '_', '/']);
        let turned = words.map(|word| match word.trim_end_matches(['-', ' ', '_', '/']) {
            "left" => word.replace("left", "right"),
            "right" => word.replace("right", "left"),
            _ => word.to_owned(),
        });
        *value = turned.collect();
    }
}

struct MirroredColumn {
    rotations: Vec<DQuat>,
    translations: Option<Vec<DVec3>>,
}

/// A joint of one arm and its counterpart.
struct MirroredJointPair {
    side: BodySide,
    joint: usize,
    other: usize,
    /// The rotation from the counterpart's bone at rest to the mirror image of this joint's bone.
    even: DQuat,
    /// Rotations before and after the mirror image of the joint's rotation in the space of the pair above, which turn
    /// it into the counterpart's.
    around: [DQuat; 2],
    /// Joints between the joint, or its counterpart, and the pair above; the lowest first.
    between: [Vec<usize>; 2],
}

struct MirrorPlan {
    /// The normal of the sagittal plane at rest in model space.
    normal: DVec3,
    rest: Vec<DQuat>,
    /// All pairs, once for each direction of copying, parents first.
    pairs: Vec<MirroredJointPair>,
    alone: Vec<String>,
}

impl MirrorPlan {
    fn mirror_plan_from(work: &WorkingClip) -> Result<Self, StepError> {
        let (skeleton, anatomy) = (&work.skeleton, &work.anatomy);
        let mut tops = [0; 2];
        for (top, side) in tops.iter_mut().zip(BodySide::BOTH_SIDES) {
            let arm = anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?;
            *top = arm.clavicle.unwrap_or(arm.upper);
        }
        let above: Vec<usize> = skeleton.joint_ancestors(tops[0]).collect();
        let trunk_joint = skeleton.joint_ancestors(tops[1]).find(|joint| above.contains(joint));
        let trunk = trunk_joint
            .filter(|joint| !tops.contains(joint))
            .ok_or(StepError::NoArm(BodySide::Left))?;
        let rest = skeleton.rest_model_pose();
        let shoulder = |side| {
            anatomy
                .part_joint(BodyPart::UpperArm(side))
                .map(|j| rest.model_joint_position(j))
        };
        let normal = match (shoulder(BodySide::Left), shoulder(BodySide::Right)) {
            (Some(left), Some(right)) => (left - right).normalize_or(DVec3::X),
            _ => DVec3::X,
        };
        let map = anatomy.mirror_map(skeleton);
        let mut plan = Self {
            normal,
            rest: rest.model_joint_rotations().to_vec(),
            pairs: Vec::new(),
            alone: Vec::new(),
        };
        for (&top, side) in tops.iter().zip(BodySide::BOTH_SIDES) {
            for joint in skeleton.joint_subtree(top) {
                // A joint whose counterpart does not point back has none.
                match map[joint].filter(|&other| other != joint && map[other] == Some(joint)) {
                    Some(other) => {
                        let even = plan.even_joint_offsets(work, joint, other, &map);
                        plan.pairs.push(MirroredJointPair {
                            side,
                            joint,
                            other,
                            even,
                            around: [DQuat::IDENTITY; 2],
                            between: [Vec::new(), Vec::new()],
                        });
                    }
                    None => plan.alone.push(skeleton.joint_at(joint).name.clone()),
                }
            }
        }
        plan.pairs.sort_by_key(|pair| pair.other);
        for n in 0..plan.pairs.len() {
            let (around, between) = plan.connect_mirrored_pair(skeleton, &plan.pairs[n], trunk);
            (plan.pairs[n].around, plan.pairs[n].between) = (around, between);
        }
        Ok(plan)
    }

    /// Connects a pair to the nearest pair above it, or to the trunk.
    ///
    /// With a the joint of that pair, b its counterpart and V the rotation of j in the space of a,
    /// the first formula of this module gives m in the space of b as
    /// `R_b0⁻¹ K_a⁻¹ · S R_a0 V R_j0⁻¹ S · K R_m0`: the trunk's rotation cancels out.
    fn connect_mirrored_pair(
        &self,
        skeleton: &Skeleton,
        pair: &MirroredJointPair,
        trunk: usize,
    ) -> ([DQuat; 2], [Vec<usize>; 2]) {
        let up = |joint: usize| skeleton.joint_ancestors(joint).skip(1);
        let is_above = |above: &&MirroredJointPair| {
            up(pair.joint).any(|joint| joint == above.joint) && up(pair.other).any(|joint| joint == above.other)
        };
        // Parents come before their children, so that the nearest pair has the last joint.
        let above = self
            .pairs
            .iter()
            .filter(is_above)
            .max_by_key(|other_pair| other_pair.joint);
        let (a, b, even) = above.map_or((trunk, trunk, DQuat::IDENTITY), |other_pair| {
            (other_pair.joint, other_pair.other, other_pair.even)
        });
        let before = self.rest[b].inverse() * even.inverse() * self.reflected(self.rest[a]);
        let after = self.reflected(self.rest[pair.joint].inverse());
        let between = [(pair.joint, a), (pair.other, b)]
            .map(|(joint, top)| up(joint).take_while(|&joint| joint != top).collect());
        ([before, after * pair.even * self.rest[pair.other]], between)
    }

    fn reflect(&self, v: DVec3) -> DVec3 {
        v - self.normal * (2.0 * v.dot(self.normal))
    }

    /// Returns `S q S`: the rotation about the reflected axis in the opposite direction.
    fn reflected(&self, q: DQuat) -> DQuat {
        let v = -self.reflect(DVec3::new(q.x, q.y, q.z));
        DQuat::from_xyzw(v.x, v.y, v.z, q.w)
    }

    fn even_joint_offsets(&self, work: &WorkingClip, joint: usize, other: usize, map: &[Option<usize>]) -> DQuat {
        let skeleton = &work.skeleton;
        let children = skeleton.joint_children(joint).iter();
        let mut paired = children.filter_map(|&child| {
            let counter = map[child].filter(|&c| skeleton.joint_parent(c) == Some(other))?;
            Some((skeleton.joint_at(child).offset, skeleton.joint_at(counter).offset))
        });
        let tips = || skeleton.joint_at(joint).tip.zip(skeleton.joint_at(other).tip);
        let Some((here, there)) = paired.next().or_else(tips) else {
            return DQuat::IDENTITY;
        };
        let image = self.reflect(self.rest[joint] * here).try_normalize();
        let bone = (self.rest[other] * there).try_normalize();
        // Bones that are each other's image already keep an exact identity.
        match (bone, image) {
            (Some(bone), Some(image)) if bone.dot(image) < 1.0 - 1e-12 => DQuat::from_rotation_arc(bone, image),
            _ => DQuat::IDENTITY,
        }
    }

    /// Returns the rotations of a joint's counterpart in the space of the pair above, and its places if the joint has
    /// translations.
    fn mirrored_joint_image(&self, work: &WorkingClip, pair: &MirroredJointPair) -> MirroredColumn {
        let joint_rotations = &work.channels[pair.joint].rotations;
        let [before, after] = pair.around;
        let rotations = (0..work.frames).map(|frame| {
            let turned = chained_rotation_below(work, &pair.between[0], frame) * joint_rotations[frame];
            before * self.reflected(turned) * after
        });
        let above = |joint: usize| {
            work.skeleton
                .joint_parent(joint)
                .map_or(DQuat::IDENTITY, |p| self.rest[p])
        };
        let (from, to) = (above(pair.joint), above(pair.other).inverse());
        let (here, there) = (work.skeleton.joint_at(pair.joint), work.skeleton.joint_at(pair.other));
        let translations = work.channels[pair.joint].translations.as_ref().map(|places| {
            let moved = |at: &DVec3| there.offset + to * self.reflect(from * (*at - here.offset));
            places.iter().map(moved).collect()
        });
        MirroredColumn {
            rotations: rotations.collect(),
            translations,
        }
    }

    /// Gives counterparts their rotations, parents first.
    fn write_mirrored_columns(
        &self,
        work: &mut WorkingClip,
        mirrored: Vec<(&MirroredJointPair, MirroredColumn)>,
    ) -> Vec<String> {
        for (pair, column) in mirrored {
            let turned = column.rotations.into_iter().enumerate();
            // A joint without a counterpart, between two that have one, is carried along.
            let local = turned.map(|(frame, rotation)| {
                (chained_rotation_below(work, &pair.between[1], frame).inverse() * rotation).normalize()
            });
            work.channels[pair.other].rotations = local.collect();
            work.channels[pair.other].translations = column.translations;
        }
        if self.alone.is_empty() {
            return Vec::new();
        }
        vec![format!(
            "joints without a counterpart stay as they were: {}",
            self.alone.join(", ")
        )]
    }
}

/// Returns the rotation of joints below one another, the lowest first.
fn chained_rotation_below(work: &WorkingClip, joints: &[usize], frame: usize) -> DQuat {
    let local = |&joint: &usize| work.channels[joint].rotations[frame];
    joints.iter().rev().map(local).product()
}
