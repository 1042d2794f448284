//! From the score of a take to what each hand, the head and the trunk do at any moment.

use chereme_motion::glam::DVec3;
use chereme_motion::{Anatomy, HandAngles, ModelPose, Side, Skeleton};
use chereme_sign::inventory::builtin_by_id;

use super::arm::{self, Wrist};
use super::course::{Fingers, Turns, between, minimum_jerk};
use super::score::{Beat, Part, Point, Sign, Take};

/// The body at rest, on which places are looked up.
pub(crate) struct Body {
    /// The joints.
    pub(crate) skeleton: Skeleton,
    /// Which joint is what.
    pub(crate) anatomy: Anatomy,
    /// The posture at rest.
    pub(crate) rest: ModelPose,
}

/// Where a wrist is at one moment, on the body at rest.
#[derive(Clone, Copy, Debug)]
struct Key {
    time: f64,
    place: DVec3,
    on_head: bool,
    wrist: Wrist,
    raise: f64,
    /// How far the way to the next key bows out in its middle.
    bow: DVec3,
}

/// Where a wrist is and how the hand hangs on the forearm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Where it is as the trunk carries it, on the body at rest, and likewise the head.
    pub(crate) on_trunk: DVec3,
    /// The share of the place that the head carries.
    pub(crate) on_head: f64,
    /// How the hand hangs on the forearm.
    pub(crate) wrist: Wrist,
    /// How far the elbow is raised.
    pub(crate) raise: f64,
}

/// What one hand does during a take.
pub(crate) struct HandTrack {
    keys: Vec<Key>,
    times: Vec<f64>,
    /// The handshapes.
    pub(crate) fingers: Fingers,
    /// What it does, from and to in seconds: `preparation`, `stroke`, `hold` or `retraction`.
    pub(crate) phases: Vec<(&'static str, f64, f64)>,
}

impl HandTrack {
    /// Returns where the hand is at `time`.
    pub(crate) fn at(&self, time: f64) -> Reach {
        let (n, share) = between(&self.times, time);
        let (a, b) = (&self.keys[n], self.keys.get(n + 1).unwrap_or(&self.keys[n]));
        let done = minimum_jerk(share);
        let twist = a.wrist.twist + (b.wrist.twist - a.wrist.twist) * done;
        let head = |key: &Key| f64::from(u8::from(key.on_head));
        Reach {
            on_trunk: a.place.lerp(b.place, done) + a.bow * (4.0 * done * (1.0 - done)),
            on_head: head(a) + (head(b) - head(a)) * done,
            wrist: Wrist {
                twist,
                bend: a.wrist.bend.slerp(b.wrist.bend, done),
            },
            raise: a.raise + (b.raise - a.raise) * done,
        }
    }
}

impl Body {
    /// Returns the body of a skeleton.
    pub(crate) fn new(skeleton: Skeleton) -> Self {
        Self {
            anatomy: Anatomy::detect(&skeleton),
            rest: skeleton.rest_model_pose(),
            skeleton,
        }
    }

    /// Returns the posture of a value of the inventory `configurations`.
    pub(crate) fn shape(&self, id: &str) -> HandAngles {
        let inventory = builtin_by_id("configurations").expect("the inventory is built in");
        let value = inventory.get(id);
        value
            .and_then(|value| value.pose)
            .expect("the scores name values that have a pose")
    }

    /// Returns what the hand of `side` does during `take`.
    pub(crate) fn hand_track(&self, take: &Take, side: Side) -> HandTrack {
        let resting = self.key(side, &resting(), &relaxed());
        let mut track = HandTrack {
            keys: vec![Key {
                time: 0.0,
                ..resting
            }],
            times: Vec::new(),
            fingers: Fingers::new(relaxed()),
            phases: Vec::new(),
        };
        let lag = if side == Side::Left { 0.05 } else { 0.0 };
        let mut free = 0.0;
        let mut busy = false;
        for (place, (start, sign)) in take.signs.iter().enumerate() {
            let part = sign.part(side);
            if part.beats.is_empty() {
                if busy {
                    free = self.lower(&mut track, resting, free + 0.1);
                    busy = false;
                }
                continue;
            }
            let keys = self.keys(side, part, *start);
            let far = track.keys[track.keys.len() - 1]
                .place
                .distance(keys[0].place);
            let leave = if busy {
                free
            } else {
                (start - lag - 0.34 - 0.42 * far).max(free)
            };
            self.leave(&mut track, leave, far, side, busy);
            track.phases.push(("preparation", leave, *start));
            track.phases.push(("stroke", *start, start + sign.hold));
            track
                .phases
                .push(("hold", start + sign.hold, start + sign.length));
            change_shapes(self, &mut track.fingers, part, *start, leave);
            track.keys.extend(keys);
            free = start + sign.length;
            busy = true;
            if place + 1 == take.signs.len() {
                self.lower(&mut track, resting, free);
            }
        }
        track.phases.retain(|(_, from, to)| to - from > 1e-9);
        track.times = track.keys.iter().map(|key| key.time).collect();
        track
    }

    /// Holds the last key until `time` and bows the way from it.
    fn leave(&self, track: &mut HandTrack, time: f64, far: f64, side: Side, busy: bool) {
        let mut from = track.keys[track.keys.len() - 1];
        let size = far * if busy { 0.10 } else { 0.16 };
        from.bow = DVec3::new(side.sign() * 0.5, if busy { 0.4 } else { -0.1 }, 1.0) * size;
        if time > from.time + 1e-9 {
            from.time = time;
            track.keys.push(from);
        } else if let Some(last) = track.keys.last_mut() {
            *last = from;
        }
    }

    /// Brings the hand back to rest from `time` on, and returns when it is there.
    fn lower(&self, track: &mut HandTrack, resting: Key, time: f64) -> f64 {
        let far = track.keys[track.keys.len() - 1]
            .place
            .distance(resting.place);
        let side = if resting.place.x < 0.0 {
            Side::Right
        } else {
            Side::Left
        };
        self.leave(track, time, far, side, false);
        let end = time + 0.40 + 0.45 * far;
        track.keys.push(Key {
            time: end,
            ..resting
        });
        track
            .fingers
            .change(time + 0.05, time + 0.05 + 0.7 * (end - time), relaxed());
        track.phases.push(("retraction", time, end));
        end
    }

    fn keys(&self, side: Side, part: &Part, start: f64) -> Vec<Key> {
        let mut keys: Vec<Key> = part
            .beats
            .iter()
            .map(|beat| {
                let held = part
                    .shapes
                    .iter()
                    .rev()
                    .find(|shape| shape.1 <= beat.at + 1e-9);
                let shape = held
                    .or(part.shapes.first())
                    .map_or(relaxed(), |shape| self.shape(shape.0));
                Key {
                    time: start + beat.at,
                    ..self.key(side, beat, &shape)
                }
            })
            .collect();
        for n in 1..keys.len() {
            keys[n - 1].bow = own(side, part.beats[n].bow) / 100.0;
        }
        keys
    }

    fn key(&self, side: Side, beat: &Beat, shape: &HandAngles) -> Key {
        let name = beat.landmark.replace("ipsi", side.name());
        let landmark = self.anatomy.landmark(&self.skeleton, &self.rest, &name);
        let landmark = landmark.expect("the scores name landmarks of the body");
        let (fingers, palm) = (own(side, beat.fingers), own(side, beat.palm));
        let turned = self.anatomy.hand_rotation(side, fingers, palm);
        let turned = turned.expect("palm and fingers of the scores are not on one line");
        let point = self.point(side, beat.point, shape);
        let place = landmark + own(side, beat.offset) / 100.0 - turned * point;
        let mut pose = self.skeleton.rest_pose();
        let arm = self.anatomy.arm(side).expect("the signer has arms");
        let (forearm, _) = arm::reach(&self.skeleton, &mut pose, &arm, side, place, beat.elbow);
        Key {
            time: beat.at,
            place,
            on_head: HEAD.iter().any(|part| name.ends_with(part)),
            wrist: arm::hang(forearm, turned),
            raise: beat.elbow,
            bow: DVec3::ZERO,
        }
    }

    /// Returns where a point of the hand is in the space of the hand's joint.
    fn point(&self, side: Side, point: Point, shape: &HandAngles) -> DVec3 {
        let Point::Of(name) = point else {
            return DVec3::ZERO;
        };
        let mut pose = self.skeleton.rest_pose();
        self.anatomy
            .set_hand_angles(&self.skeleton, side, shape, &mut pose);
        let model = ModelPose::of(&self.skeleton, &pose);
        let arm = self.anatomy.arm(side).expect("the signer has arms");
        let name = format!("{}-{name}", side.name());
        let at = self.anatomy.landmark(&self.skeleton, &model, &name);
        let at = at.expect("the scores name landmarks of the hand");
        model.rotation(arm.hand).inverse() * (at - model.position(arm.hand))
    }
}

/// Landmarks that move with the head.
const HEAD: [&str; 3] = ["temple", "nose", "chin"];

/// Brings the fingers into the shapes of a sign, early on the way to it.
fn change_shapes(body: &Body, fingers: &mut Fingers, part: &Part, start: f64, leave: f64) {
    let mut from = leave + 0.12 * (start - leave);
    for (n, shape) in part.shapes.iter().enumerate() {
        let begins = start + shape.1;
        let by = if n == 0 {
            leave + 0.86 * (start - leave)
        } else {
            begins
        };
        fingers.change(from, by, body.shape(shape.0));
        from = start + shape.2;
    }
}

/// From a hand's own side, up and forward to model space.
fn own(side: Side, [x, y, z]: [f64; 3]) -> DVec3 {
    DVec3::new(x * side.sign(), y, z)
}

/// A hand that hangs beside the thigh.
fn resting() -> Beat {
    super::score::beat(0.0, "ipsi-hip", [11.5, -3.0, 4.0])
        .with(Point::Wrist)
        .facing([-0.05, -1.0, 0.28], [-1.0, 0.0, -0.25])
}

/// The fingers of a hand that does nothing.
fn relaxed() -> HandAngles {
    let mut hand = HandAngles::default();
    hand.thumb.radial = 32f64.to_radians();
    hand.thumb.palmar = 26f64.to_radians();
    hand.thumb.opposition = 15f64.to_radians();
    hand.thumb.flexion = [12f64.to_radians(), 18f64.to_radians()];
    for (n, finger) in (0..).zip(&mut hand.fingers) {
        let more = f64::from(n) * 5.0;
        finger.spread = [4.0f64, 1.0, -2.0, -6.0][n as usize].to_radians();
        finger.flexion = [16.0 + more, 28.0 + more, 14.0 + 0.5 * more].map(f64::to_radians);
    }
    hand
}

/// Returns what the head and the trunk do during `take`.
pub(crate) fn turns(take: &Take, of: impl Fn(&Sign) -> &[super::score::Turn]) -> Turns {
    let mut turns = Turns::default();
    turns.push(0.0, DVec3::ZERO);
    let mut end = 0.0;
    for (start, sign) in &take.signs {
        if start - 0.7 > end + 0.1 {
            turns.push(start - 0.7, DVec3::ZERO);
        }
        for turn in of(sign) {
            turns.push(start + turn.0, DVec3::from(turn.1));
        }
        end = start + sign.length;
        if end + 0.65 < take.length
            && take
                .signs
                .iter()
                .all(|(next, _)| *next <= *start || next - 0.7 > end + 0.65)
        {
            turns.push(end + 0.65, DVec3::ZERO);
        }
    }
    turns
}
