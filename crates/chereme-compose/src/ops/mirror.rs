//! `swap` and `mirror`: give one arm the movement of the other, mirrored at the body's sagittal plane.
//!
//! With C the rotation of the joint that carries both arms, R that of an arm's joint j and m its counterpart, all in
//! model space, and a zero for the rest pose, the movement of j relative to the trunk is `D = (C C₀⁻¹)⁻¹ R_j R_j0⁻¹`.
//! Its mirror image `S D S` (S reflects across the plane between the shoulders at rest) is given to m:
//! `R_m = C C₀⁻¹ · S D S · K · R_m0`, where K, the shortest rotation, compensates for arms whose bones are not symmetric
//! at rest. Applied twice, this gives R again. All this is done joint by joint in local space.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Part, Side, Skeleton};
use chereme_sign::words::Text;
use chereme_sign::{Component, Reading};

use crate::error::Cause;
use crate::outcome::{About, Note};
use crate::work::{Columns, Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Description, Done, Field, FieldSetting, Neighbours, Operator, Step, Syntax};
use crate::text::{Parsed, Parser};
use crate::units::Hands;

/// The operator that exchanges the arms; it has no settings.
pub(crate) struct Swap;

impl Syntax for Swap {
    const NAME: &'static str = "swap";
    const DESCRIPTION: Description = Description {
        title: Text::new("Swap hands", "Échanger les mains"),
        hint: Text::new(
            "the arms exchange their movement",
            "les bras échangent leurs rôles",
        ),
        examples: &[("swap", Text::new("the arms exchanged", "les bras échangés"))],
        messages: &[],
    };

    fn parse(_parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        Ok(Self)
    }

    fn usual() -> Self {
        Self
    }
}

impl Display for Swap {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAME)
    }
}

impl Operator for Swap {
    fn apply(&self, work: &mut Work, _given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(swap(work)?.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Swapped, Keep::None))
    }

    fn after(&self, before: &mut Step) -> Neighbours {
        match before {
            Step::Swap => Neighbours::Nothing,
            _ => Neighbours::Apart,
        }
    }
}

/// Settings of `mirror right`: the arm that is copied.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mirror {
    /// The arm whose movement the other arm takes; never both.
    #[serde(default = "crate::recipe::dominant")]
    pub from: Hands,
}

impl Syntax for Mirror {
    const NAME: &'static str = "mirror";
    const DESCRIPTION: Description = Description {
        title: Text::new("Mirror", "Miroir"),
        hint: Text::new("one arm copies the other", "un bras copie l’autre"),
        examples: &[(
            "mirror right",
            Text::new(
                "the left arm like the right one",
                "le bras gauche comme le droit",
            ),
        )],
        messages: &[
            Text::new(
                "one arm is copied to the other; name right, left, dominant or weak",
                "un bras est copié sur l’autre ; nommez right, left, dominant ou weak",
            ),
            Text::new(
                "the hands go through each other in {n} frames, from {first} on; take one aside, as with: place left by left 5cm",
                "les mains se traversent dans {n} images, à partir de {first} ; écartez-en une, comme avec : place left by left 5cm",
            ),
            Text::new(
                "joints without a counterpart stay as they were: {names}",
                "les articulations sans pendant restent comme elles étaient : {names}",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let from = parser.hand().unwrap_or(Hands::Dominant);
        Ok(Self { from })
    }

    fn usual() -> Self {
        let from = Hands::Dominant;
        Self { from }
    }
}

impl Display for Mirror {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.from {
            Hands::Dominant => f.write_str("mirror"),
            from => write!(f, "mirror {}", from.name()),
        }
    }
}

impl Operator for Mirror {
    fn check(&self) -> Result<(), RecipeError> {
        match self.from {
            Hands::Both => Err(RecipeError::Empty {
                step: Self::NAME,
                what: "one arm is copied to the other; name right, left, dominant or weak",
            }),
            Hands::Right | Hands::Left | Hands::Dominant | Hands::Weak => Ok(()),
        }
    }

    fn apply(&self, work: &mut Work, _given: &mut Given<'_>) -> Result<Done, Cause> {
        let from = self.from.sides(work.handedness)[0];
        Ok(mirror(work, from)?.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        let from = self.from.sides(handedness)[0];
        Some((Carry::Copied(from), Keep::None))
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let field = Field::Hand(&mut self.from);
        let copied = Text::new("copied from the", "copié de la");
        vec![FieldSetting::new(copied, field)]
    }
}

/// Exchanges the movements of the arms.
pub(crate) fn swap(work: &mut Work) -> Result<Vec<String>, Cause> {
    let plan = MirrorPlan::of(work)?;
    let images = plan.pairs.iter().map(|pair| (pair, plan.image(work, pair)));
    let mirrored: Vec<(&Pair, Column)> = images.collect();
    let did = plan.write(work, mirrored);
    for note in &mut work.notes {
        turn_over(note);
    }
    work.changed(arms(&Side::BOTH), "swap");
    Ok(did)
}

/// Gives the other arm the mirror image of the movement of `from`.
pub(crate) fn mirror(work: &mut Work, from: Side) -> Result<Vec<String>, Cause> {
    let plan = MirrorPlan::of(work)?;
    let copied = plan.pairs.iter().filter(|pair| pair.side == from);
    let images = copied.map(|pair| (pair, plan.image(work, pair)));
    let mirrored: Vec<(&Pair, Column)> = images.collect();
    let mut did = plan.write(work, mirrored);
    did.extend(crossing(work, &plan));
    work.notes.retain(|note| note.hand != Some(from.other()));
    let copies: Vec<Note> = work
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
    let operator = format!("mirror {}", from.name());
    // A value of the sign as a whole belongs to the dominant hand, and hands with equal values count as two.
    let copied = work.handedness.dominant() != from;
    for note in work.notes.iter_mut().filter(|note| note.hand.is_none()) {
        match &note.about {
            About::Component(_, Some(feature)) if feature == "handedness" => {
                note.value = Reading::Unset;
            }
            About::Component(component, _) if copied && *component != Component::NonManual => {
                note.value = Reading::Unset;
            }
            _ => {}
        }
    }
    work.changed(arms(&[from.other()]), &operator);
    Ok(did)
}

/// Reports hands that are each other's mirror image and pass through each other: a joint of one is beyond the plane
/// between them.
fn crossing(work: &Work, plan: &MirrorPlan) -> Option<String> {
    let upper = |side| Some(work.anatomy.arm(side)?.upper);
    let (left, right) = (upper(Side::Left)?, upper(Side::Right)?);
    let hand = work.anatomy.arm(Side::Left)?.hand;
    let below = work.skeleton.subtree(hand);
    let pairs = plan.pairs.iter().filter(|pair| below.contains(&pair.joint));
    let pairs: Vec<(usize, usize)> = pairs.map(|pair| (pair.joint, pair.other)).collect();
    let all = pairs.iter().flat_map(|&(a, b)| [a, b]).chain([left, right]);
    let columns = Columns::of(work, all);
    let offset = |from: usize, to: usize, frame: usize| {
        columns.positions(to)[frame] - columns.positions(from)[frame]
    };
    let crossed = |frame: &usize| {
        let across = offset(right, left, *frame);
        pairs
            .iter()
            .any(|&(left, right)| offset(right, left, *frame).dot(across) < 0.0)
    };
    let frames: Vec<usize> = (0..work.frames).filter(crossed).collect();
    let first = work.rate.instant(*frames.first()?);
    Some(format!(
        "the hands go through each other in {} frames, from {first} on; take one aside, as with: \
         place left by left 5cm",
        frames.len()
    ))
}

fn arms(sides: &[Side]) -> Vec<Group> {
    sides
        .iter()
        .flat_map(|&side| [Group::Arm(side), Group::Fingers(side)])
        .collect()
}

/// Replaces the hand by the other one, and the side in values such as `high-left`.
fn turn_over(note: &mut Note) {
    let manual = |component: &Component| *component != Component::NonManual;
    match (note.hand, &note.about) {
        (Some(side), _) => note.hand = Some(side.other()),
        (None, About::Component(component, _)) if manual(component) => {}
        _ => return,
    }
    if let (About::Component(..), Reading::Value(value)) = (&note.about, &mut note.value) {
        let words = value.split_inclusive(['-', ' ', '_', '/']);
        let turned = words.map(|word| match word.trim_end_matches(['-', ' ', '_', '/']) {
            "left" => word.replace("left", "right"),
            "right" => word.replace("right", "left"),
            _ => word.to_owned(),
        });
        *value = turned.collect();
    }
}

struct Column {
    rotations: Vec<DQuat>,
    translations: Option<Vec<DVec3>>,
}

/// A joint of one arm and its counterpart.
struct Pair {
    side: Side,
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
    pairs: Vec<Pair>,
    alone: Vec<String>,
}

impl MirrorPlan {
    fn of(work: &Work) -> Result<Self, Cause> {
        let (skeleton, anatomy) = (&work.skeleton, &work.anatomy);
        let mut tops = [0; 2];
        for (top, side) in tops.iter_mut().zip(Side::BOTH) {
            let arm = anatomy.arm(side).ok_or(Cause::NoArm(side))?;
            *top = arm.clavicle.unwrap_or(arm.upper);
        }
        let above: Vec<usize> = skeleton.ancestors(tops[0]).collect();
        let trunk = skeleton
            .ancestors(tops[1])
            .find(|joint| above.contains(joint));
        let trunk = trunk
            .filter(|joint| !tops.contains(joint))
            .ok_or(Cause::NoArm(Side::Left))?;
        let rest = skeleton.rest_model_pose();
        let shoulder = |side| {
            anatomy
                .joint(Part::UpperArm(side))
                .map(|j| rest.position(j))
        };
        let normal = match (shoulder(Side::Left), shoulder(Side::Right)) {
            (Some(left), Some(right)) => (left - right).normalize_or(DVec3::X),
            _ => DVec3::X,
        };
        let map = anatomy.mirror_map(skeleton);
        let mut plan = Self {
            normal,
            rest: rest.rotations().to_vec(),
            pairs: Vec::new(),
            alone: Vec::new(),
        };
        for (&top, side) in tops.iter().zip(Side::BOTH) {
            for joint in skeleton.subtree(top) {
                match map[joint].filter(|&other| other != joint && map[other] == Some(joint)) {
                    Some(other) => {
                        let even = plan.even(work, joint, other, &map);
                        plan.pairs.push(Pair {
                            side,
                            joint,
                            other,
                            even,
                            around: [DQuat::IDENTITY; 2],
                            between: [Vec::new(), Vec::new()],
                        });
                    }
                    None => plan.alone.push(skeleton.joint(joint).name.clone()),
                }
            }
        }
        plan.pairs.sort_by_key(|pair| pair.other);
        for n in 0..plan.pairs.len() {
            let (around, between) = plan.hung(skeleton, &plan.pairs[n], trunk);
            (plan.pairs[n].around, plan.pairs[n].between) = (around, between);
        }
        Ok(plan)
    }

    /// Connects a pair to the nearest pair above it, or to the trunk.
    ///
    /// With a the joint of that pair, b its counterpart and V the rotation of j in the space of a,
    /// the first formula of this module gives m in the space of b as
    /// `R_b0⁻¹ K_a⁻¹ · S R_a0 V R_j0⁻¹ S · K R_m0`: the trunk's rotation cancels out.
    fn hung(
        &self,
        skeleton: &Skeleton,
        pair: &Pair,
        trunk: usize,
    ) -> ([DQuat; 2], [Vec<usize>; 2]) {
        let up = |joint: usize| skeleton.ancestors(joint).skip(1);
        let is_above = |above: &&Pair| {
            up(pair.joint).any(|joint| joint == above.joint)
                && up(pair.other).any(|joint| joint == above.other)
        };
        // Parents come before their children, so that the nearest pair has the last joint.
        let above = self.pairs.iter().filter(is_above).max_by_key(|it| it.joint);
        let (a, b, even) = above.map_or((trunk, trunk, DQuat::IDENTITY), |it| {
            (it.joint, it.other, it.even)
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

    fn even(&self, work: &Work, joint: usize, other: usize, map: &[Option<usize>]) -> DQuat {
        let skeleton = &work.skeleton;
        let children = skeleton.children(joint).iter();
        let mut paired = children.filter_map(|&child| {
            let counter = map[child].filter(|&c| skeleton.parent(c) == Some(other))?;
            Some((skeleton.joint(child).offset, skeleton.joint(counter).offset))
        });
        let tips = || skeleton.joint(joint).tip.zip(skeleton.joint(other).tip);
        let Some((here, there)) = paired.next().or_else(tips) else {
            return DQuat::IDENTITY;
        };
        let image = self.reflect(self.rest[joint] * here).try_normalize();
        let bone = (self.rest[other] * there).try_normalize();
        match (bone, image) {
            (Some(bone), Some(image)) if bone.dot(image) < 1.0 - 1e-12 => {
                DQuat::from_rotation_arc(bone, image)
            }
            _ => DQuat::IDENTITY,
        }
    }

    /// Returns the rotations of a joint's counterpart in the space of the pair above, and its places if the joint has
    /// translations.
    fn image(&self, work: &Work, pair: &Pair) -> Column {
        let own = &work.channels[pair.joint].rotations;
        let [before, after] = pair.around;
        let rotations = (0..work.frames).map(|frame| {
            let turned = below(work, &pair.between[0], frame) * own[frame];
            before * self.reflected(turned) * after
        });
        let above = |joint: usize| {
            work.skeleton
                .parent(joint)
                .map_or(DQuat::IDENTITY, |p| self.rest[p])
        };
        let (from, to) = (above(pair.joint), above(pair.other).inverse());
        let (here, there) = (
            work.skeleton.joint(pair.joint),
            work.skeleton.joint(pair.other),
        );
        let translations = work.channels[pair.joint]
            .translations
            .as_ref()
            .map(|places| {
                let moved =
                    |at: &DVec3| there.offset + to * self.reflect(from * (*at - here.offset));
                places.iter().map(moved).collect()
            });
        Column {
            rotations: rotations.collect(),
            translations,
        }
    }

    /// Gives counterparts their rotations, parents first.
    fn write(&self, work: &mut Work, mirrored: Vec<(&Pair, Column)>) -> Vec<String> {
        for (pair, column) in mirrored {
            let turned = column.rotations.into_iter().enumerate();
            // A joint without a counterpart, between two that have one, is carried along.
            let local = turned.map(|(frame, rotation)| {
                (below(work, &pair.between[1], frame).inverse() * rotation).normalize()
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
fn below(work: &Work, joints: &[usize], frame: usize) -> DQuat {
    let local = |&joint: &usize| work.channels[joint].rotations[frame];
    joints.iter().rev().map(local).product()
}
