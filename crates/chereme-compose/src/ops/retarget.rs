//! Transfers movement from one skeleton to another, part by part, through the anatomy.

use std::sync::Arc;

use chereme_motion::glam::{DMat3, DQuat, DVec3};
use chereme_motion::{Anatomy, Channel, ModelPose, Part, Pose, Rate, Side, Skeleton};

use crate::arm;
use crate::body;
use crate::contact::{self, Carry, Keep};
use crate::error::Cause;
use crate::recipe::Solver;
use crate::work::{Columns, Work};

/// Movement on another skeleton, and its contacts.
pub(crate) struct Touching {
    pub(crate) work: Work,
    /// The number of contacts before.
    pub(crate) contacts: usize,
    /// Those that were kept by moving a wrist.
    pub(crate) kept: Vec<String>,
    /// Those that were lost.
    pub(crate) lost: Vec<String>,
    /// Those that were kept by moving a wrist far.
    pub(crate) warnings: Vec<String>,
}

/// The body that receives movement.
pub(crate) struct TargetBody<'a> {
    pub(crate) skeleton: &'a Arc<Skeleton>,
    pub(crate) anatomy: &'a Arc<Anatomy>,
    /// The posture of joints that the movement says nothing about.
    pub(crate) idle: Pose,
}

impl<'a> TargetBody<'a> {
    /// Returns the body with its rest pose for idle joints.
    pub(crate) fn at_rest(skeleton: &'a Arc<Skeleton>, anatomy: &'a Arc<Anatomy>) -> Self {
        Self {
            skeleton,
            anatomy,
            idle: skeleton.rest_pose(),
        }
    }
}

/// Transfers movement to another skeleton, and moves wrists a little, so that hands touch what they touched.
pub(crate) fn touching(
    work: &Work,
    onto: &TargetBody<'_>,
    operator: &str,
) -> Result<Touching, Cause> {
    let touched = contact::touches(work);
    let mut out = retarget(work, onto)?;
    let mut touched = touched.on(&out);
    let keep = Keep::All(&Side::BOTH);
    let kept = contact::mend(&mut out, &mut touched, keep, operator);
    Ok(Touching {
        contacts: touched.count(),
        lost: contact::lost(&touched, &out, Carry::Same),
        warnings: contact::long_repairs(&touched, operator),
        work: out,
        kept,
    })
}

/// Transfers movement to another skeleton.
///
/// Each part has the directions of its counterpart in model space: its bone and a direction across it (that of the
/// elbow, out of the palm, forward from the body) point where the counterpart's point, whatever the rest poses. Wrists
/// keep their distance from the shoulders' middle in arms' lengths, fingers keep their joint angles and thumbs the
/// directions of their bones, the root's path is scaled by the legs' length, and joints that have no counterpart stay in
/// their idle posture.
pub(crate) fn retarget(work: &Work, onto: &TargetBody<'_>) -> Result<Work, Cause> {
    let (skeleton, anatomy) = (onto.skeleton, onto.anatomy);
    for side in Side::BOTH {
        if anatomy.arm(side).is_some() && work.anatomy.arm(side).is_none() {
            return Err(Cause::NoArm(side));
        }
    }
    let mut out = Work {
        skeleton: Arc::clone(skeleton),
        anatomy: Arc::clone(anatomy),
        channels: skeleton
            .joints()
            .iter()
            .zip(&onto.idle.translations)
            .map(|(joint, &place)| Channel {
                rotations: vec![joint.rest; work.frames],
                translations: (place != joint.offset).then(|| vec![place; work.frames]),
            })
            .collect(),
        ..work.clone()
    };
    let pairs = pairs(work, skeleton, anatomy);
    let placed = |part: Part| work.anatomy.joint(next_part(part)?);
    let columns = Columns::of(
        work,
        pairs
            .iter()
            .flatten()
            .flat_map(|&(from, part)| [Some(from), placed(part)])
            .flatten()
            .chain([0]),
    );
    let [there, here] =
        [(&work.skeleton, &work.anatomy), (skeleton, anatomy)].map(|(skeleton, anatomy)| Body {
            skeleton,
            anatomy,
            rest: skeleton.rest_model_pose(),
        });
    let mut model: Vec<Vec<DQuat>> = Vec::with_capacity(skeleton.len());
    for (joint, pair) in pairs.iter().enumerate() {
        let above = skeleton.parent(joint).map(|parent| &model[parent]);
        let parent = |frame: usize| above.map_or(DQuat::IDENTITY, |column| column[frame]);
        let idle = onto.idle.rotations[joint];
        let column: Vec<DQuat> = match *pair {
            Some((from, part)) => {
                let back = there.posture(part).rotation(from).inverse();
                let onto = even(&there, &here, part) * here.posture(part).rotation(joint);
                // A file that places the next joint in every frame decides thereby where the bone points.
                let next = placed(part).filter(|&next| work.channels[next].translations.is_some());
                let (posture, starts) = (there.posture(part), columns.positions(from));
                let turned = columns.rotations(from).iter().enumerate();
                let turned = turned.map(|(frame, turned)| {
                    let off = next.and_then(|next| {
                        let bone = posture.position(next) - posture.position(from);
                        let turned = (*turned * back * bone).try_normalize()?;
                        let placed = columns.positions(next)[frame] - starts[frame];
                        Some(DQuat::from_rotation_arc(turned, placed.try_normalize()?))
                    });
                    (off.unwrap_or_default() * *turned * back * onto).normalize()
                });
                turned.collect()
            }
            None => (0..work.frames).map(|frame| parent(frame) * idle).collect(),
        };
        let local =
            (0..work.frames).map(|frame| (parent(frame).inverse() * column[frame]).normalize());
        let local: Vec<DQuat> = local.collect();
        out.channels[joint].rotations = local;
        model.push(column);
    }
    root(work, &mut out);
    fingers(work, &mut out);
    wrists(work, &mut out);
    Ok(out)
}

/// Returns for each joint of the new skeleton its counterpart and part; `None` for fingers.
fn pairs(work: &Work, skeleton: &Skeleton, anatomy: &Anatomy) -> Vec<Option<(usize, Part)>> {
    let mut pairs = vec![None; skeleton.len()];
    for (part, joint, _) in anatomy.found() {
        if !matches!(part, Part::Thumb(..) | Part::Finger(..))
            && let Some(from) = work.anatomy.joint(part)
        {
            pairs[joint] = Some((from, part));
        }
    }
    pairs
}

/// Returns the part in which the bone of a limb's part ends.
fn next_part(part: Part) -> Option<Part> {
    match part {
        Part::Clavicle(side) => Some(Part::UpperArm(side)),
        Part::UpperArm(side) => Some(Part::Forearm(side)),
        Part::Forearm(side) => Some(Part::Hand(side)),
        Part::Thigh(side) => Some(Part::Shin(side)),
        Part::Shin(side) => Some(Part::Foot(side)),
        Part::Foot(side) => Some(Part::Toes(side)),
        _ => None,
    }
}

/// The directions of a part in a body's posture, in model space: along its bone, and one across it.
struct Axes {
    along: DVec3,
    across: Option<DVec3>,
}

impl Axes {
    /// Returns the axes of a limb's part; `None` for a part of the trunk, which uses the body's axes.
    fn of(body: &Body<'_>, part: Part) -> Option<Self> {
        let (anatomy, model) = (body.anatomy, body.posture(part));
        let at = |part| anatomy.joint(part).map(|joint| model.position(joint));
        let bone = || (at(next_part(part)?)? - at(part)?).try_normalize();
        let trunk = anatomy.body_frame(model)?;
        let elbow = |side| {
            let upper = anatomy.joint(Part::UpperArm(side))?;
            Some(model.rotation(upper) * anatomy.elbow(side)?)
        };
        let tip = || {
            let joint = anatomy.joint(part)?;
            (model.rotation(joint) * last_bone(body.skeleton, anatomy, joint)?).try_normalize()
        };
        let (along, across) = match part {
            Part::Clavicle(_) => (bone()?, Some(trunk.up)),
            Part::UpperArm(side) => (bone()?, elbow(side)),
            Part::Forearm(side) => {
                let along = bone()?;
                let upper = (at(part)? - at(Part::UpperArm(side))?).try_normalize();
                let carried = upper.map(|upper| DQuat::from_rotation_arc(upper, along));
                (
                    along,
                    elbow(side).zip(carried).map(|(out, turn)| turn * out),
                )
            }
            Part::Hand(side) => {
                let palm = anatomy.palm_normal(side, model);
                (anatomy.hand_direction(side, model)?, palm)
            }
            Part::Thigh(_) | Part::Shin(_) => (bone()?, Some(trunk.forward)),
            Part::Foot(_) => {
                let along = bone().or_else(tip);
                (along.unwrap_or(trunk.forward), Some(trunk.up))
            }
            Part::Toes(_) => (tip().unwrap_or(trunk.forward), Some(trunk.up)),
            _ => return None,
        };
        Some(Self { along, across })
    }

    fn basis(&self) -> Option<DQuat> {
        let across = self
            .across?
            .reject_from_normalized(self.along)
            .try_normalize()?;
        let columns = DMat3::from_cols(self.along, across, self.along.cross(across));
        Some(DQuat::from_mat3(&columns).normalize())
    }
}

/// Returns the end of a limb's last bone in the space of its joint: the tip, else the only joint that hangs on it.
fn last_bone(skeleton: &Skeleton, anatomy: &Anatomy, joint: usize) -> Option<DVec3> {
    let below = match skeleton.children(joint) {
        [child] => Some(skeleton.joint(*child).offset),
        _ => None,
    };
    anatomy.tip(skeleton, joint).or(below)
}

/// One of the two bodies.
struct Body<'a> {
    skeleton: &'a Skeleton,
    anatomy: &'a Anatomy,
    rest: ModelPose,
}

impl Body<'_> {
    /// Returns the posture in which a part is compared with that of another body: at rest, but standing for the legs.
    /// Where a file keeps every bone along one axis, legs point up at rest, and nothing shows which way feet point.
    fn posture(&self, part: Part) -> &ModelPose {
        match part {
            Part::Thigh(_) | Part::Shin(_) | Part::Foot(_) | Part::Toes(_) => {
                self.anatomy.measured_pose()
            }
            _ => &self.rest,
        }
    }

    /// Returns the trunk's rotation at rest, with up along the spine because shoulders may be drawn forward.
    fn trunk(&self) -> Option<DQuat> {
        let at = |part| {
            self.anatomy
                .joint(part)
                .map(|joint| self.rest.position(joint))
        };
        let up = (at(Part::Neck).or(at(Part::Head))? - at(Part::Hips)?).try_normalize()?;
        let left = self.anatomy.body_frame(&self.rest)?.left;
        let left = left.reject_from_normalized(up).try_normalize()?;
        let columns = DMat3::from_cols(left, up, left.cross(up));
        Some(DQuat::from_mat3(&columns).normalize())
    }
}

/// Returns the rotation from a part's rest pose on the new body to that on the old one.
fn even(from: &Body<'_>, to: &Body<'_>, part: Part) -> DQuat {
    let bodies = match (from.trunk(), to.trunk()) {
        (Some(from), Some(to)) => from * to.inverse(),
        _ => DQuat::IDENTITY,
    };
    let axes = |body: &Body<'_>| Axes::of(body, part);
    let (Some(there), Some(here)) = (axes(from), axes(to)) else {
        return bodies;
    };
    match (there.basis(), here.basis()) {
        (Some(there), Some(here)) => there * here.inverse(),
        _ => DQuat::from_rotation_arc((bodies * here.along).normalize(), there.along) * bodies,
    }
}

fn root(work: &Work, out: &mut Work) {
    let height = |skeleton: &Skeleton, anatomy: &Anatomy| {
        let model = skeleton.rest_model_pose();
        let hips = anatomy.joint(Part::Hips).unwrap_or(0);
        let foot = anatomy
            .joint(Part::Foot(Side::Left))
            .or(anatomy.joint(Part::Foot(Side::Right)));
        foot.map(|foot| model.position(hips).y - model.position(foot).y)
    };
    // Legs that do not hang down at rest, because every bone lies along one axis, are measured by their length.
    let size = |work: &Work| {
        let measures = work.anatomy.measures()?;
        let leg = leg_length(&work.skeleton, &work.anatomy);
        Some(leg.unwrap_or(measures.stature * 0.49))
    };
    let sizes = size(work).zip(size(out)).filter(|sizes| sizes.0 > 1e-3);
    let sizes = sizes.map_or(1.0, |(from, to)| to / from);
    let heights = height(&work.skeleton, &work.anatomy).zip(height(&out.skeleton, &out.anatomy));
    let heights = heights.filter(|heights| heights.0 > 1e-3);
    let scale = heights.map_or(sizes, |(from, to)| to / from);
    let agree = (0.75..1.35).contains(&(scale / sizes));
    let scale = if agree { scale } else { sizes };
    // The hips' height above the floor is scaled, wherever the roots of the two skeletons are.
    let hips = |work: &Work| work.anatomy.joint(Part::Hips).unwrap_or(0);
    let (from, to) = (hips(work), hips(out));
    let (there, here) = (Columns::of(work, [from]), Columns::of(out, [to]));
    let pairs = there.positions(from).iter().zip(here.positions(to));
    let offset = out.skeleton.joint(0).offset;
    let places: Vec<DVec3> = pairs
        .map(|(&at, &now)| offset + (at * scale - now))
        .collect();
    out.channels[0].translations = Some(places);
}

/// Returns the length of a leg's bones from hip to ankle.
fn leg_length(skeleton: &Skeleton, anatomy: &Anatomy) -> Option<f64> {
    Side::BOTH.into_iter().find_map(|side| {
        let (foot, thigh) = (
            anatomy.joint(Part::Foot(side))?,
            anatomy.joint(Part::Thigh(side))?,
        );
        let bones = skeleton.ancestors(foot).take_while(|&joint| joint != thigh);
        let length: f64 = bones.map(|j| skeleton.joint(j).offset.length()).sum();
        (length > 1e-3).then_some(length)
    })
}

/// Moves the wrists to the same position relative to the shoulders' middle, in arms' lengths, so that hands that meet
/// still meet on wider shoulders.
fn wrists(work: &Work, out: &mut Work) {
    let arms = |work: &Work| Side::BOTH.map(|side| work.anatomy.arm(side));
    let ([Some(r), Some(l)], [Some(right), Some(left)]) = (arms(work), arms(out)) else {
        return;
    };
    let length = |work: &Work| body::arm_length(work, Side::Right).filter(|length| *length > 1e-3);
    let Some(ratio) = length(out).zip(length(work)).map(|(to, from)| to / from) else {
        return;
    };
    let there = Columns::of(work, [r.hand, l.hand]);
    let here = Columns::of(out, [right.hand, left.hand]);
    let middle = |columns: &Columns, a: usize, b: usize, frame: usize| {
        (columns.positions(a)[frame] + columns.positions(b)[frame]) / 2.0
    };
    for (side, hand) in [(Side::Right, r.hand), (Side::Left, l.hand)] {
        let target = |frame: usize| {
            let offset = there.positions(hand)[frame] - middle(&there, r.upper, l.upper, frame);
            middle(&here, right.upper, left.upper, frame) + offset * ratio
        };
        let targets: Vec<DVec3> = (0..work.frames).map(target).collect();
        arm::move_wrist(out, side, &here, &targets, None, Solver::Analytic);
    }
}

fn fingers(work: &Work, out: &mut Work) {
    for side in Side::BOTH {
        let (here, there) = (work.anatomy.fingers(side), out.anatomy.fingers(side));
        if here.is_empty() || there.is_empty() {
            continue;
        }
        let mut source: Pose = work.pose(0);
        let mut target = out.pose(0);
        for frame in 0..work.frames {
            for &joint in &here {
                source.rotations[joint] = work.channels[joint].rotations[frame];
            }
            let angles = work.anatomy.hand_angles(&work.skeleton, side, &source);
            let Some(angles) = angles else { break };
            if !out
                .anatomy
                .set_hand_angles(&out.skeleton, side, &angles, &mut target)
            {
                break;
            }
            for &joint in &there {
                out.channels[joint].rotations[frame] = target.rotations[joint];
            }
        }
        thumb(work, out, side);
    }
}

/// A joint of a digit, and the joint in which its bone ends if that hangs on it directly.
#[derive(Clone, Copy)]
struct DigitBone {
    joint: usize,
    next: Option<usize>,
}

impl DigitBone {
    fn thumb(work: &Work, side: Side) -> [Option<Self>; 3] {
        let found = |n: u8| work.anatomy.joint(Part::Thumb(side, n));
        [0, 1, 2].map(|n| {
            let joint = found(n)?;
            let next = (n + 1..3).find_map(found);
            let next = next.filter(|&next| work.skeleton.parent(next) == Some(joint));
            Some(Self { joint, next })
        })
    }

    /// Returns the direction of the bone in the space of its joint.
    fn direction(&self, work: &Work, frame: usize) -> Option<DVec3> {
        let end = match self.next {
            Some(next) => Some(work.translation(next, frame)),
            None => last_bone(&work.skeleton, &work.anatomy, self.joint),
        };
        end?.try_normalize()
    }
}

/// Turns the bones of a thumb to the directions that they have in the source: where two skeletons keep a thumb
/// differently at rest, equal angles do not turn it about equal axes.
fn thumb(work: &Work, out: &mut Work, side: Side) {
    let from = DigitBone::thumb(work, side);
    let there = Columns::of(work, from.iter().flatten().map(|bone| bone.joint));
    for (from, to) in from.into_iter().zip(DigitBone::thumb(out, side)) {
        let (Some(from), Some(to)) = (from, to) else {
            continue;
        };
        let Some(parent) = out.skeleton.parent(to.joint) else {
            continue;
        };
        let here = Columns::of(out, [parent]);
        for frame in 0..work.frames {
            let wanted = from.direction(work, frame);
            let Some((wanted, bone)) = wanted.zip(to.direction(out, frame)) else {
                break;
            };
            let above = here.rotations(parent)[frame];
            let own = above * out.channels[to.joint].rotations[frame];
            let wanted = there.rotations(from.joint)[frame] * wanted;
            let turn = DQuat::from_rotation_arc((own * bone).normalize(), wanted.normalize());
            out.channels[to.joint].rotations[frame] = (above.inverse() * turn * own).normalize();
        }
    }
}

/// Brings movement to another frame rate.
pub(crate) fn resample(work: &mut Work, rate: Rate) {
    if work.rate == rate || work.frames == 0 {
        return;
    }
    let last = work.rate.instant(work.frames - 1);
    let frames = rate.frame_at(last) + usize::from(rate.instant(rate.frame_at(last)) <= last);
    let from = work.rate.per_second();
    let at: Vec<f64> = (0..frames)
        .map(|f| rate.instant(f).seconds() * from)
        .collect();
    work.sample(&at);
    work.rate = rate;
}
