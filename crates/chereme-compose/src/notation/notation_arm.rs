//! Poses an arm: the elbow follows the rules of Kennaway, section 4.2, in closed form.
//!
//! The plane of the arm is at an angle to the vertical plane through shoulder and wrist: small in front of the arm's
//! own shoulder, larger across the body; `freedom` selects the deviation from that rule. Near full reach the collar bone
//! helps, and it draws back if the wrist is too near. The hand stays within the limits of its wrist.

use super::notation_tuned::tuned;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::interpolation::smooth_step;
use chereme_motion::{ArmChain, BodyAnatomy, BodySide, LocalPose, ModelPose, Skeleton, WristAngles, WristLimits};
use chereme_sign::hamnosys::BodyLanguage;

/// The heights of a wrist above its shoulder (arm lengths) for which the body language has a usual elbow.
const WRIST_HEIGHTS: [f64; 3] = [-0.3, 0.0, 0.3];

/// The bones of one arm, on a body that stands still.
pub(crate) struct ArmBoneRig {
    pub(crate) side: BodySide,
    pub(crate) chain: ArmChain,
    /// Position of the shoulder in model space while the collar bone is at rest.
    pub(crate) shoulder: DVec3,
    /// Lengths of the upper arm and the forearm, in metres.
    pub(crate) lengths: [f64; 2],
    /// Direction of the elbow at rest, in model space.
    pub(crate) elbow_axis: DVec3,
    clavicle: Option<CollarBone>,
    /// Rotation at rest of the joints above the upper arm.
    above: DQuat,
    /// Rotations at rest from the upper arm to the forearm's joint, and on to the hand's.
    between: [DQuat; 2],
    /// Vectors along the bones, in the space of their joints.
    bones: [DVec3; 2],
    /// Rotation from the upper arm and its elbow to the axes.
    level: DQuat,
    /// Local rotations of the forearm and the hand at rest.
    rest: [DQuat; 2],
    outside: DVec3,
    forward: DVec3,
}

struct CollarBone {
    joint: usize,
    at: DVec3,
    /// Its rotation in model space.
    turned: DQuat,
    /// The rotation of its parent in model space.
    above: DQuat,
    /// The rotation between it and the upper arm.
    between: DQuat,
}

/// Limits of wrist, elbow and collar bone from the body language; angles in radians.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmLimits {
    /// Of the wrist and of the forearm's turn.
    pub(crate) wrist: WristLimits,
    /// Cosine of the largest bend of an elbow.
    folded: f64,
    own: f64,
    across: f64,
    help: (f64, f64),
    /// Rotation (rad) by which a collar bone rises with a hand above the shoulder.
    rise: f64,
    /// Largest rotation of the collar bone that helps the hand (rad), and the share of it that is possible downwards.
    shrug: (f64, f64),
    /// The usual depths of an elbow below its shoulder (arm lengths) with the hand at each of [`WRIST_HEIGHTS`].
    elbows: [f64; 3],
    /// Largest deviation (rad) from the notated orientation at which it still reads as notated.
    pub(crate) tolerance: f64,
}

impl ArmLimits {
    pub(crate) fn arm_limits_from_language(language: &BodyLanguage) -> Self {
        let angle = f64::to_radians;
        Self {
            wrist: language.wrist_limits(),
            folded: angle(language.limit_elbow).cos(),
            own: angle(language.elbow_own_side),
            across: angle(language.elbow_across),
            help: (language.clavicle_from, angle(language.clavicle_most)),
            rise: angle(language.life_shoulder),
            shrug: (angle(language.shrug), language.shrug_down),
            elbows: [language.elbow_low, language.elbow_level, language.elbow_high],
            tolerance: angle(language.tolerance).max(1e-3),
        }
    }

    /// Returns the usual depth of an elbow below its shoulder for the wrist's height above that shoulder, both in arm
    /// lengths.
    pub(crate) fn usual_elbow_depth(&self, height: f64) -> f64 {
        let [low, level, high] = self.elbows;
        let near = |from: usize| {
            let share = (height - WRIST_HEIGHTS[from]) / (WRIST_HEIGHTS[from + 1] - WRIST_HEIGHTS[from]);
            share.clamp(0.0, 1.0)
        };
        low + (level - low) * near(0) + (high - level) * near(1)
    }
}

/// The degrees of freedom of an arm whose wrist is fixed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ArmBearing {
    /// Deviation of the arm's plane from the rule's, in radians.
    pub(crate) plane: f64,
    /// Shift of the shoulder along the upper arm by the collar bone: from -1, away from the elbow, to 1,
    /// the farthest towards it.
    pub(crate) shrug: f64,
}

impl ArmBearing {
    /// Interpolates linearly.
    pub(crate) fn mix_bearings(&self, to: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        Self {
            plane: mix(self.plane, to.plane),
            shrug: mix(self.shrug, to.shrug),
        }
    }
}

/// One posture of an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArmPosture {
    pub(crate) shoulder: DVec3,
    pub(crate) elbow: DVec3,
    pub(crate) wrist: DVec3,
    /// Normal of the arm's plane: the unit vector about which the line from shoulder to wrist turns
    /// towards the elbow.
    across: DVec3,
    /// The collar bone's rotation from rest, in model space.
    help: DQuat,
}

/// An arm whose wrist is fixed and whose plane is open.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FixedWristArm {
    shoulder: DVec3,
    /// The collar bone's rotation from rest, in model space.
    help: DQuat,
    /// Unit vector from the shoulder to the wrist.
    along: DVec3,
    /// Distance from the shoulder to the wrist, in metres.
    reach: f64,
    /// Distance from the shoulder to the middle of the circle on which the elbow can be, in metres.
    to_middle: f64,
    /// Radius of that circle, in metres.
    off: f64,
    /// Angle (rad) of the rule's plane, from the second pole to the first.
    rule: f64,
    /// Two directions at right angles to `along` and to each other: outwards, and down.
    poles: [DVec3; 2],
    outside: DVec3,
}

impl FixedWristArm {
    /// Returns the posture in the plane that is turned by `turn` (rad) from the rule's.
    pub(crate) fn posture_in_plane(&self, turn: f64) -> ArmPosture {
        let (sin, cos) = (self.rule + turn).sin_cos();
        let raw_pole = self.poles[0] * sin + self.poles[1] * cos;
        let pole = raw_pole.reject_from_normalized(self.along).normalize_or(raw_pole);
        ArmPosture {
            shoulder: self.shoulder,
            elbow: self.shoulder + self.along * self.to_middle + pole * self.off,
            wrist: self.shoulder + self.along * self.reach,
            across: self.along.cross(pole).normalize_or(self.outside),
            help: self.help,
        }
    }
}

/// Directions of the hand that the wrist should hold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldDirections {
    /// Direction of the hand's axis, in the space of its joint.
    pub(crate) along: DVec3,
    /// Direction of the palm, in the space of its joint.
    pub(crate) palm: DVec3,
    pub(crate) radial: DVec3,
    /// Rotation from these directions to the axes.
    level: DQuat,
}

impl HeldDirections {
    pub(crate) fn from_hand_directions(along: DVec3, palm: DVec3, radial: DVec3) -> Self {
        Self {
            along,
            palm,
            radial,
            level: basis_rotation(along, palm).inverse(),
        }
    }
}

impl ArmBoneRig {
    pub(crate) fn build_arm_rig(
        skeleton: &Skeleton,
        anatomy: &BodyAnatomy,
        base: &LocalPose,
        model: &ModelPose,
        side: BodySide,
        [left, forward]: [DVec3; 2],
    ) -> Option<Self> {
        let chain = anatomy.arm_chain(side)?;
        let parent = |joint: usize| skeleton.joint_parent(joint);
        let turned = |joint: Option<usize>| joint.map_or(DQuat::IDENTITY, |j| model.model_joint_rotation(j));
        let relative = |from: usize, to: usize| {
            // The rotation of the joints between the two, without that of `to` itself.
            (model.model_joint_rotation(from).inverse() * turned(parent(to))).normalize()
        };
        let [shoulder, elbow, wrist] =
            [chain.upper, chain.forearm, chain.hand].map(|joint| model.model_joint_position(joint));
        let lengths = [shoulder.distance(elbow), elbow.distance(wrist)];
        let bone = |joint: usize, from: DVec3, to: DVec3| {
            Some(model.model_joint_rotation(joint).inverse() * (to - from).try_normalize()?)
        };
        let bones = [bone(chain.upper, shoulder, elbow)?, bone(chain.forearm, elbow, wrist)?];
        let outside = left * side.side_sign();
        let elbow_direction = anatomy
            .elbow_direction(side)
            .unwrap_or_else(|| model.model_joint_rotation(chain.upper).inverse() * (-forward - DVec3::Y * 0.3));
        let elbow_local = elbow_direction
            .reject_from_normalized(bones[0])
            .normalize_or(bones[0].any_orthonormal_vector());
        let clavicle = chain.clavicle.map(|joint| CollarBone {
            joint,
            at: model.model_joint_position(joint),
            turned: model.model_joint_rotation(joint),
            above: turned(parent(joint)),
            between: relative(joint, chain.upper),
        });
        Some(Self {
            side,
            chain,
            shoulder,
            lengths,
            elbow_axis: model.model_joint_rotation(chain.upper) * elbow_local,
            clavicle,
            above: turned(parent(chain.upper)),
            between: [
                relative(chain.upper, chain.forearm),
                relative(chain.forearm, chain.hand),
            ],
            bones,
            level: basis_rotation(bones[0], elbow_local).inverse(),
            rest: [chain.forearm, chain.hand].map(|joint| base.rotations[joint]),
            outside,
            forward,
        })
    }

    /// Returns the joints that an arm's posture rotates: collar bone, upper arm, forearm, hand.
    pub(crate) fn arm_joint_indices(&self) -> [Option<usize>; 4] {
        let chain = &self.chain;
        [
            self.clavicle.as_ref().map(|clavicle| clavicle.joint),
            Some(chain.upper),
            Some(chain.forearm),
            Some(chain.hand),
        ]
    }

    /// Returns the arm's length in metres.
    pub(crate) fn rig_arm_length(&self) -> f64 {
        self.lengths[0] + self.lengths[1]
    }

    /// Solves the arm for a position of the wrist.
    pub(crate) fn reach_wrist_position(&self, wrist: DVec3, bearing: ArmBearing, limits: &ArmLimits) -> ArmPosture {
        let posed = self.fix_wrist_position(wrist, limits).posture_in_plane(bearing.plane);
        self.shrug_arm_posture(posed, wrist, bearing, limits)
    }

    /// Does the same from the posture in the plane of this bearing without its shrug.
    pub(crate) fn shrug_arm_posture(
        &self,
        posed: ArmPosture,
        wrist: DVec3,
        bearing: ArmBearing,
        limits: &ArmLimits,
    ) -> ArmPosture {
        if bearing.shrug == 0.0 {
            return posed;
        }
        let (shoulder, help) = self.shrugged(&posed, bearing.shrug, limits);
        self.line_from(wrist, shoulder, help, limits)
            .posture_in_plane(bearing.plane)
    }

    /// Computes everything about the arm that a position of the wrist decides whatever the arm's plane.
    pub(crate) fn fix_wrist_position(&self, wrist: DVec3, limits: &ArmLimits) -> FixedWristArm {
        let (shoulder, help) = self.shoulder_for(wrist, limits);
        self.line_from(wrist, shoulder, help, limits)
    }

    /// Computes the same from a given position of the shoulder and turn of the collar bone.
    fn line_from(&self, wrist: DVec3, shoulder: DVec3, help: DQuat, limits: &ArmLimits) -> FixedWristArm {
        let to_wrist = self.not_too_near(wrist - shoulder, limits);
        let along = to_wrist.normalize_or(self.forward);
        let reach = self.soften(to_wrist.length());
        let [first, second] = self.lengths;
        let to_middle = ((first * first - second * second + reach * reach) / (2.0 * reach)).clamp(-first, first);
        let crossed = -(wrist - self.shoulder).dot(self.outside) / (0.6 * self.rig_arm_length());
        let arc = least_arc_rotation(self.forward, along);
        FixedWristArm {
            shoulder,
            help,
            along,
            reach,
            to_middle,
            off: (first * first - to_middle * to_middle).max(0.0).sqrt(),
            rule: limits.own + (limits.across - limits.own) * smooth_step(crossed),
            poles: [arc * self.outside, arc * DVec3::NEG_Y],
            outside: self.outside,
        }
    }

    /// Inverts [`rotations`](Self::rotations): returns the posture with these local rotations, and the
    /// hand's rotation in model space.
    pub(crate) fn posture_from_rotations(&self, [collar, upper, forearm, hand]: [DQuat; 4]) -> (ArmPosture, DQuat) {
        let (shoulder, help, above) = match &self.clavicle {
            Some(clavicle) => {
                let turned = clavicle.above * collar;
                let help = (turned * clavicle.turned.inverse()).normalize();
                let shoulder = clavicle.at + help * (self.shoulder - clavicle.at);
                (shoulder, help, turned * clavicle.between)
            }
            None => (self.shoulder, DQuat::IDENTITY, self.above),
        };
        let upper = above * upper;
        let forearm = upper * self.between[0] * forearm;
        let hand = (forearm * self.between[1] * hand).normalize();
        let elbow = shoulder + upper * (self.bones[0] * self.lengths[0]);
        let wrist = elbow + forearm * (self.bones[1] * self.lengths[1]);
        let line = (wrist - shoulder).normalize_or(self.forward);
        let across = line.cross(elbow - shoulder).normalize_or(self.outside);
        let posed = ArmPosture {
            shoulder,
            elbow,
            wrist,
            across,
            help,
        };
        (posed, hand)
    }

    /// Solves the arm for another wrist position from the same shoulder, with the plane turned outwards by
    /// an angle (rad).
    pub(crate) fn move_posed_wrist(&self, posed: &ArmPosture, wrist: DVec3, outwards: f64) -> ArmPosture {
        let to_wrist = wrist - posed.shoulder;
        let line = to_wrist.normalize_or(self.forward);
        let [first, second] = self.lengths;
        let least = (first - second).abs() + 0.02 * self.rig_arm_length();
        let reach = to_wrist.length().clamp(least, 0.9999 * self.rig_arm_length());
        let x = ((first * first - second * second + reach * reach) / (2.0 * reach)).clamp(-first, first);
        let off = (first * first - x * x).max(0.0).sqrt();
        let elbow_offset = (posed.elbow - posed.shoulder).reject_from_normalized(line);
        let pole = elbow_offset.normalize_or(posed.across.cross(line).normalize_or(DVec3::NEG_Y));
        let pole = DQuat::from_axis_angle(line, outwards * self.side.side_sign()) * pole;
        ArmPosture {
            elbow: posed.shoulder + line * x + pole * off,
            wrist: posed.shoulder + line * reach,
            across: line.cross(pole).normalize_or(self.outside),
            ..*posed
        }
    }

    /// Returns the position of the wrist half-way between two postures if upper arm, elbow and the arm's plane turn evenly.
    pub(crate) fn wrist_between(&self, ends: &[ArmPosture; 2]) -> DVec3 {
        let [upper, forearm] = self.lengths;
        let uppers = ends.map(|posed| (posed.elbow - posed.shoulder).normalize_or(self.forward));
        let bends = [0, 1].map(|n| uppers[n].angle_between(ends[n].wrist - ends[n].elbow));
        let along = (uppers[0] + uppers[1]).normalize_or(uppers[0]);
        let across_sum = (ends[0].across + ends[1].across).reject_from_normalized(along);
        let across = across_sum.normalize_or(along.any_orthonormal_vector());
        let bend = DQuat::from_axis_angle(across, -0.5 * (bends[0] + bends[1]));
        let shoulder = ends[0].shoulder.midpoint(ends[1].shoulder);
        shoulder + along * upper + bend * along * forearm
    }

    /// Returns the position of the shoulder and the turn of the collar bone for a `shrug`: smaller
    /// downwards, and within the collar bone's limit.
    fn shrugged(&self, posed: &ArmPosture, shrug: f64, limits: &ArmLimits) -> (DVec3, DQuat) {
        let Some(clavicle) = &self.clavicle else {
            return (posed.shoulder, posed.help);
        };
        let bone = posed.shoulder - clavicle.at;
        let Some(along) = bone.try_normalize() else {
            return (posed.shoulder, posed.help);
        };
        let upper = (posed.elbow - posed.shoulder).normalize_or(self.forward);
        let (most, down) = limits.shrug;
        let mut by = upper.reject_from_normalized(along) * (shrug * most);
        by.y *= if by.y < 0.0 { down } else { 1.0 };
        let turn = DQuat::from_scaled_axis(along.cross(by));
        (clavicle.at + turn * bone, turn * posed.help)
    }

    /// Returns the vector from shoulder to wrist, lengthened outwards and forward if the elbow cannot bend
    /// enough.
    fn not_too_near(&self, to_wrist: DVec3, limits: &ArmLimits) -> DVec3 {
        let missing = to_wrist.length_squared() - self.min_wrist_distance_squared(limits);
        if missing >= 0.0 {
            return to_wrist;
        }
        let out = (self.forward * 0.8 + self.outside * 0.6).normalize();
        let along = to_wrist.dot(out);
        to_wrist + out * ((along * along - missing).sqrt() - along)
    }

    /// Returns the square of the least distance from shoulder to wrist.
    fn min_wrist_distance_squared(&self, limits: &ArmLimits) -> f64 {
        let [a, b] = self.lengths;
        a * a + b * b + 2.0 * a * b * limits.folded
    }

    /// Limits a distance softly to the arm's length.
    fn soften(&self, wanted: f64) -> f64 {
        let length = self.rig_arm_length();
        let from = length * (1.0 - tuned().arm.soft);
        if wanted > from {
            let left = length - from;
            length - left * (-(wanted - from) / left).exp()
        } else {
            wanted
        }
    }

    fn shoulder_for(&self, wrist: DVec3, limits: &ArmLimits) -> (DVec3, DQuat) {
        let still = (self.shoulder, DQuat::IDENTITY);
        let Some(clavicle) = &self.clavicle else {
            return still;
        };
        let far = self.shoulder.distance(wrist);
        let bone = self.shoulder - clavicle.at;
        if bone.length() < 1e-6 {
            return still;
        }
        let above = (wrist.y - self.shoulder.y) / self.rig_arm_length();
        let raw_rise =
            limits.rise * smooth_step((above + tuned().arm.rises[0]) / (tuned().arm.rises[0] + tuned().arm.rises[1]));
        let rise = match bone.cross(DVec3::Y).try_normalize().filter(|_| raw_rise > 0.0) {
            Some(axis) => DQuat::from_axis_angle(axis, raw_rise),
            None => DQuat::IDENTITY,
        };
        // Reaches towards a far wrist, and draws back from one nearer than the elbow folds.
        let near = 1.06 * self.min_wrist_distance_squared(limits).sqrt();
        let down = (self.shoulder.y - wrist.y) / far.max(1e-9);
        let helps = 1.0 - smooth_step((down - tuned().arm.hangs[0]) / (tuned().arm.hangs[1] - tuned().arm.hangs[0]));
        let far_off = helps * (far - limits.help.0 * self.rig_arm_length()).max(0.0);
        let missing = far_off - (near - far).max(0.0);
        let reach = bone
            .cross(wrist - clavicle.at)
            .try_normalize()
            .filter(|_| missing != 0.0 && limits.help.1 > 0.0);
        let turn = reach.map_or(DQuat::IDENTITY, |axis| {
            let wanted = missing / bone.length() * bone.angle_between(wrist - clavicle.at).sin();
            DQuat::from_axis_angle(axis, limits.help.1 * (wanted / limits.help.1).tanh())
        });
        if rise == DQuat::IDENTITY && turn == DQuat::IDENTITY {
            return still;
        }
        let turn = rise * turn;
        (clavicle.at + turn * bone, turn)
    }

    /// Returns the wrist's angles in a posture with this rotation of the hand in model space.
    pub(crate) fn wrist_angles(&self, posed: &ArmPosture, hand: DQuat, held: &HeldDirections) -> WristAngles {
        let forearm = (posed.wrist - posed.elbow).normalize_or(self.forward);
        let in_hand = hand.inverse() * forearm;
        let [a, p, r] = [held.along, held.palm, held.radial].map(|axis| in_hand.dot(axis));
        let deviation = (-r).clamp(-1.0, 1.0).asin();
        // Beyond a right angle backwards, the deviation alone is ambiguous.
        let flexion = (-p).atan2(a);
        let straight = hand * held.along;
        let aligned = least_arc_rotation(straight, forearm) * (hand * held.palm);
        let out = self.elbow_out(posed, forearm);
        let inner = forearm.cross(out) * -self.side.side_sign();
        let turn = forearm.dot(inner.cross(aligned)).atan2(inner.dot(aligned)) * -self.side.side_sign();
        WristAngles {
            flexion,
            deviation,
            turn,
        }
    }

    /// Returns the direction of the elbow at a right angle to the forearm.
    fn elbow_out(&self, posed: &ArmPosture, forearm: DVec3) -> DVec3 {
        posed.across.cross(forearm).normalize_or(self.outside)
    }

    /// Returns the rotation in model space of a hand with these angles on its forearm: the inverse of
    /// [`wrist`](Self::wrist).
    pub(crate) fn hand_rotation_from_angles(
        &self,
        posed: &ArmPosture,
        angles: &WristAngles,
        held: &HeldDirections,
    ) -> DQuat {
        let forearm = (posed.wrist - posed.elbow).normalize_or(self.forward);
        let out = self.elbow_out(posed, forearm);
        let inner = forearm.cross(out) * -self.side.side_sign();
        let (sin, cos) = (angles.turn * -self.side.side_sign()).sin_cos();
        let palm = inner * cos + forearm.cross(inner) * sin;
        let straight = basis_rotation(forearm, palm) * held.level;
        let (sin, cos) = angles.flexion.sin_cos();
        let (aside, across) = angles.deviation.sin_cos();
        let in_hand = held.along * (across * cos) - held.palm * (across * sin) - held.radial * aside;
        (straight * least_arc_rotation(in_hand.normalize(), held.along)).normalize()
    }

    /// Returns the rotations in model space of upper arm, forearm and hand.
    pub(crate) fn arm_model_rotations(&self, posed: &ArmPosture, hand: DQuat) -> [DQuat; 3] {
        let up = (posed.elbow - posed.shoulder).normalize_or(self.forward);
        let fore = (posed.wrist - posed.elbow).normalize_or(up);
        let out = posed.across.cross(up).normalize_or(self.outside);
        let upper = basis_rotation(up, out) * self.level;
        let base = upper * self.between[0] * self.rest[0];
        let forearm = least_arc_rotation(base * self.bones[1], fore) * base;
        let rest = forearm * self.between[1] * self.rest[1];
        [upper, twist_about_axis(hand * rest.inverse(), fore) * forearm, hand]
    }

    /// Returns the local rotations of [`arm_joint_indices`](Self::arm_joint_indices) for a posture and the hand's rotation
    /// in model space.
    pub(crate) fn arm_joint_rotations(&self, posed: &ArmPosture, hand: DQuat) -> [DQuat; 4] {
        self.local_arm_rotations(posed, self.arm_model_rotations(posed, hand))
    }

    /// Returns the same from the [`turned`](Self::turned) bones of the posture.
    pub(crate) fn local_arm_rotations(&self, posed: &ArmPosture, [upper, forearm, hand]: [DQuat; 3]) -> [DQuat; 4] {
        let (clavicle, above) = match &self.clavicle {
            Some(clavicle) => {
                let turned = posed.help * clavicle.turned;
                (clavicle.above.inverse() * turned, turned * clavicle.between)
            }
            None => (DQuat::IDENTITY, self.above),
        };
        [
            clavicle.normalize(),
            (above.inverse() * upper).normalize(),
            ((upper * self.between[0]).inverse() * forearm).normalize(),
            ((forearm * self.between[1]).inverse() * hand).normalize(),
        ]
    }
}

/// Returns the rotation of a right-handed frame of two unit vectors at right angles.
fn basis_rotation(a: DVec3, b: DVec3) -> DQuat {
    DQuat::from_mat3(&chereme_motion::glam::DMat3::from_cols(a, b, a.cross(b))).normalize()
}

/// Returns the least rotation from one unit vector to another.
fn least_arc_rotation(from: DVec3, to: DVec3) -> DQuat {
    DQuat::from_rotation_arc(from, to)
}

/// Returns the part of a rotation that turns about a unit vector.
fn twist_about_axis(q: DQuat, axis: DVec3) -> DQuat {
    let along = axis * q.xyz().dot(axis);
    let twist = DQuat::from_xyzw(along.x, along.y, along.z, q.w);
    if twist.length_squared() > 1e-12 {
        twist.normalize()
    } else {
        DQuat::IDENTITY
    }
}
