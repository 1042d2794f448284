//! From a take to its movement: trunk, head, arms and fingers of every frame.

use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3, EulerRot};
use chereme_motion::{Clip, HandAngles, ModelPose, Part, Pose, Rate, Side};

use super::arm;
use super::noise::Noise;
use super::score::Take;
use super::track::{self, Body, HandTrack};

/// Frames a second.
pub(crate) const FPS: u32 = 60;

/// How a performance went.
pub(crate) struct Performance {
    /// The movement.
    pub(crate) clip: Clip,
    /// The right and the left hand's course.
    pub(crate) hands: [HandTrack; 2],
    /// The largest distance of a wrist from where it should be, in metres.
    pub(crate) residual: f64,
}

/// Performs `take` on `body`.
pub(crate) fn perform(body: &Body, take: &Take) -> Performance {
    let rate = Rate::new(FPS, 1).expect("a whole rate");
    let hands = Side::BOTH.map(|side| body.hand_track(take, side));
    let motion = Motion {
        body,
        hands: &hands,
        head: track::turns(take, |sign| &sign.head),
        trunk: track::turns(take, |sign| &sign.trunk),
        noise: (0..64)
            .map(|channel| Noise::new(take.seed, channel))
            .collect(),
    };
    let frames = (take.length * rate.per_second()).round() as usize;
    let mut residual: f64 = 0.0;
    let poses: Vec<Pose> = (0..frames)
        .map(|frame| {
            let (pose, missed) = motion.pose(rate.instant(frame).seconds());
            residual = residual.max(missed);
            pose
        })
        .collect();
    let skeleton = Arc::new(body.skeleton.clone());
    let clip = Clip::from_poses(skeleton, rate, &poses).expect("poses of this skeleton");
    Performance {
        clip,
        hands,
        residual,
    }
}

struct Motion<'a> {
    body: &'a Body,
    hands: &'a [HandTrack; 2],
    head: super::course::Turns,
    trunk: super::course::Turns,
    noise: Vec<Noise>,
}

impl Motion<'_> {
    fn pose(&self, time: f64) -> (Pose, f64) {
        let body = self.body;
        let mut pose = body.skeleton.rest_pose();
        self.turn_trunk(&mut pose, time);
        let model = ModelPose::of(&body.skeleton, &pose);
        let mut residual: f64 = 0.0;
        for (n, side) in Side::BOTH.into_iter().enumerate() {
            let reach = self.hands[n].at(time);
            let carried = |part| {
                let joint = body
                    .anatomy
                    .joint(part)
                    .expect("the signer has a trunk and a head");
                let from = body.rest.rotation(joint).inverse()
                    * (reach.on_trunk - body.rest.position(joint));
                model.point(joint, from)
            };
            let wander = DVec3::new(
                self.noise(10 + n, time),
                self.noise(12 + n, time),
                self.noise(14 + n, time),
            );
            let place =
                carried(Part::Chest).lerp(carried(Part::Head), reach.on_head) + wander * 0.0012;
            let arm = body.anatomy.arm(side).expect("the signer has arms");
            let (_, missed) = arm::reach(&body.skeleton, &mut pose, &arm, side, place, reach.raise);
            residual = residual.max(missed);
            let mut wrist = reach.wrist;
            wrist.twist += self.noise(16 + n, time) * 0.008;
            wrist.bend =
                (wrist.bend * DQuat::from_rotation_z(self.noise(18 + n, time) * 0.008)).normalize();
            arm::set_wrist(&mut pose, &arm, &wrist);
            let angles = self.alive(self.hands[n].fingers.at(time), n, time);
            body.anatomy
                .set_hand_angles(&body.skeleton, side, &angles, &mut pose);
        }
        (pose, residual)
    }

    fn noise(&self, channel: usize, time: f64) -> f64 {
        self.noise[channel].at(time)
    }

    /// Breathing, small sways, the turns of the score, and the trunk's share in what the hands do.
    fn turn_trunk(&self, pose: &mut Pose, time: f64) {
        let degrees = |pitch: f64, yaw: f64, roll: f64| {
            let [pitch, yaw, roll] = [pitch, yaw, roll].map(f64::to_radians);
            DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll)
        };
        let breath = (time * std::f64::consts::TAU / 3.9).sin();
        let [right, left] = [0, 1].map(|n| self.hands[n].at(time).on_trunk);
        let yaw = 9.0 * (right.z - left.z).clamp(-0.5, 0.5);
        let lean = self.trunk.at(time);
        let sway = DVec3::new(
            self.noise(0, time) * 0.35,
            self.noise(1, time) * 0.5,
            self.noise(2, time) * 0.3,
        );
        let whole = lean + sway + DVec3::new(0.0, yaw, 0.0);
        let mut set = |joint: &str, q: DQuat| {
            if let Some(joint) = self.body.skeleton.find(joint) {
                pose.rotations[joint] = q;
            }
        };
        set(
            "Hips",
            degrees(0.0, self.noise(3, time) * 0.25, self.noise(4, time) * 0.2),
        );
        for (joint, share, chest) in [
            ("Spine", 0.30, 0.0),
            ("Spine1", 0.35, -0.3),
            ("Spine2", 0.35, -0.25),
        ] {
            set(
                joint,
                degrees(
                    whole.x * share + chest * breath,
                    whole.y * share,
                    whole.z * share,
                ),
            );
        }
        let look = self.head.at(time);
        let steady = -0.85 * whole + DVec3::new(0.5 * breath, 0.0, 0.0);
        let wander = DVec3::new(
            self.noise(5, time) * 0.6,
            self.noise(6, time) * 0.9,
            self.noise(7, time) * 0.6,
        );
        let turn = look + steady + wander;
        for (joint, share) in [("Neck", 0.35), ("Neck1", 0.25), ("Head", 0.40)] {
            set(
                joint,
                degrees(turn.x * share, turn.y * share, turn.z * share),
            );
        }
    }

    /// Fingers are never quite still, unless the hand hangs during the whole take.
    fn alive(&self, mut hand: HandAngles, n: usize, time: f64) -> HandAngles {
        if self.hands[n].phases.is_empty() {
            return hand;
        }
        for (finger, angles) in hand.fingers.iter_mut().enumerate() {
            let more = self.noise(20 + 8 * n + finger, time) * 0.008;
            for (angle, share) in angles.flexion.iter_mut().zip([1.0, 0.8, 0.5]) {
                *angle += more * share;
            }
        }
        hand.thumb.radial += self.noise(24 + 8 * n, time) * 0.006;
        hand
    }
}
