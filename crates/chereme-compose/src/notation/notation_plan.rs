//! Plans signs: turns the tree into timed events of each hand.

use std::collections::BTreeMap;

use chereme_motion::BodySide;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::DirectionFrame::Relative;
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::sites::NotatedHandPoint;
use chereme_sign::hamnosys::{
    BodyLanguage, BodyPlace, DirectionAim, EachHand, HandConstellation, HandPlace, HandSymmetry, HandsUsed, Handshape,
    ManualPart, NotatedPosture, NotatedSign, SpatialDirection,
};

use super::approach::ApproachCourse;
use super::notation_arm::ArmLimits;
use super::notation_path::HandPath;
use super::notation_stage::{FingerShape, StandingBody};
use super::notation_tuned::tuned;
use super::pace::{MovementPace, PaceTables};
use super::stretch_time::TimeWarp;
use super::thumb;
use super::wrist_cycle::WristCycle;

/// One act of a hand with its time span, in seconds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HandEvent {
    pub(crate) from: f64,
    /// The time at which its last posture is left, in seconds.
    pub(crate) to: f64,
    pub(crate) pace: MovementPace,
    pub(crate) act: HandAct,
}

/// The acts of a hand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum HandAct {
    /// Its reference point moves along a path; simultaneous paths add up.
    Move(HandPath),
    /// It rotates to an orientation in model space.
    Turn(DQuat),
    /// It leans off its written orientation by this turn, in the hand's space; its rotation includes it.
    Lean(DQuat),
    /// It turns with the tangent of `path`, after an immediate turn `corner`; `to` is its final
    /// orientation.
    Follow { path: HandPath, corner: DQuat, to: DQuat },
    /// Its reference point changes to this one, in the hand's space.
    Point(DVec3),
    /// Its fingers take a shape, by index among the plan's.
    Shape(usize),
    /// It moves to and fro about the wrist.
    Wrist(WristCycle),
    /// Fingers play, thumb first, `cycles` times, by `angle` (rad) at the base joint.
    Play { digits: [bool; 5], angle: f64, cycles: f64 },
}

/// A phase of a hand's movement, in seconds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HandPhase {
    /// The hand: 0 for the dominant one, 1 for the other.
    pub(crate) hand: usize,
    pub(crate) kind: PhaseKind,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) says: String,
}

/// The kinds of phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PhaseKind {
    Transition,
    Stroke,
    Hold,
}

/// The state of a hand at the current end of the plan.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HandState {
    /// Position of its reference point in model space.
    pub(crate) point: DVec3,
    /// Rotation of the hand in model space.
    pub(crate) rotation: DQuat,
    /// The turn, in the hand's space, by which that rotation leans off the written one.
    pub(crate) leaned: DQuat,
    /// The reference point in the hand's space.
    pub(crate) offset: DVec3,
    pub(crate) shape: usize,
    /// The notated handshape.
    pub(crate) handshape: Handshape,
    /// The notated direction of its axis, in the frame of the dominant hand.
    pub(crate) direction: DVec3,
    /// The notated angle of its palm (rad), in the frame of the dominant hand.
    pub(crate) palm: f64,
    /// The signs of left, up and forward for its direction and for its palm.
    pub(crate) axes: [DVec3; 2],
    /// Whether its direction or palm is notated relative to its movement.
    pub(crate) follows: bool,
    /// The direction of its last movement.
    pub(crate) heading: Option<DVec3>,
    /// Whether it takes part in the sign.
    pub(crate) used: bool,
}

impl HandState {
    /// Returns the position of the wrist.
    pub(crate) fn wrist_position(&self) -> DVec3 {
        self.point - self.rotation * self.offset
    }
}

/// The time span of one sign.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SignSpan {
    pub(crate) gloss: String,
    /// The time at which its first posture is reached, in seconds.
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// The planned events of both hands.
pub(crate) struct SignPlan {
    /// The dominant side, then the other.
    pub(crate) sides: [BodySide; 2],
    pub(crate) start: [HandState; 2],
    pub(crate) events: [Vec<HandEvent>; 2],
    pub(crate) shapes: [Vec<FingerShape>; 2],
    pub(crate) phases: Vec<HandPhase>,
    pub(crate) signs: Vec<SignSpan>,
    /// Time spans (s, as planned) in which each hand touches something.
    pub(crate) contacts: [Vec<(f64, f64)>; 2],
    /// The courses of each hand's approaches to movements.
    pub(crate) courses: [Vec<ApproachCourse>; 2],
    /// Time spans (s, as planned) in which each hand moves to a named place.
    pub(crate) arrivals: [Vec<(f64, f64)>; 2],
    /// Time spans (s, as planned) in which each hand moves from rest or back.
    pub(crate) away: [Vec<(f64, f64)>; 2],
    /// Time spans (s, as planned) in which the hands mirror each other.
    pub(crate) mirrored: Vec<(f64, f64)>,
    pub(crate) end: f64,
    /// Whether the hands interlock or cross, so that their bulk may overlap.
    pub(crate) laced: bool,
    /// Warnings about approximations and omissions, without duplicates.
    pub(crate) remarks: Vec<String>,
}

impl SignPlan {
    /// Returns the course of a hand's event, if that is part of an approach to a movement.
    pub(crate) fn event_course(&self, n: usize, event: &HandEvent) -> Option<&ApproachCourse> {
        let mut courses = self.courses[n].iter().filter(|_| event.pace == MovementPace::Calm);
        courses.find(|course| course.from == event.from && course.to == event.to)
    }

    /// Stretches the times of phases and signs; events keep their planned times.
    pub(crate) fn stretch_plan_times(&mut self, warp: &TimeWarp) {
        if warp.is_none() {
            return;
        }
        for phase in &mut self.phases {
            (phase.from, phase.to) = (warp.stretched_time_at(phase.from), warp.stretched_time_at(phase.to));
        }
        for sign in &mut self.signs {
            (sign.from, sign.to) = (warp.stretched_time_at(sign.from), warp.stretched_time_at(sign.to));
        }
        self.end = warp.stretched_time_at(self.end);
    }
}

/// The frame of an acting hand: relates notated directions and sides to the hand's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ActingFrame {
    /// Factors (1 or -1) on left, up and forward.
    pub(crate) axes: DVec3,
    /// The same for palms: two hands mirror them even if their directions are parallel.
    pub(crate) palm_axes: DVec3,
    /// Whether left and right of places are exchanged.
    pub(crate) mirrored: bool,
    /// Whether it is half a period behind.
    pub(crate) behind: bool,
}

impl ActingFrame {
    /// Returns whether the other hand mirrors this one.
    pub(crate) fn is_mirrored_by(&self, other: &Self) -> bool {
        other.axes.x * self.axes.x < 0.0 && other.axes.y > 0.0 && other.axes.z > 0.0
    }
}

/// The acting hands, the dominant one first, each with its frame.
pub(crate) type ActingHands = [Option<ActingFrame>; 2];

/// The signing body, and the rules that turn notation into positions and times on it.
#[derive(Clone, Copy)]
pub(crate) struct NotationSigner<'a> {
    pub(crate) stage: &'a StandingBody,
    pub(crate) language: &'a BodyLanguage,
    pub(crate) paces: &'a PaceTables,
    pub(crate) limits: ArmLimits,
    /// The dominant side, then the other.
    pub(crate) sides: [BodySide; 2],
    /// Frames per second.
    rate: f64,
}

/// Both hands at the current end of a plan.
pub(crate) struct PlannedHands<'p> {
    pub(crate) signer: NotationSigner<'p>,
    pub(crate) state: &'p [HandState; 2],
    /// The shapes of each hand, to which states refer.
    pub(crate) shapes: &'p [Vec<FingerShape>; 2],
}

/// Turns signs into the events of a plan, one posture and one motion after the other.
pub(crate) struct SignPlanner<'a> {
    pub(crate) signer: NotationSigner<'a>,
    pub(crate) state: [HandState; 2],
    pub(crate) rest: [HandState; 2],
    pub(crate) named: BTreeMap<u8, [Option<DVec3>; 2]>,
    pub(crate) symmetric: bool,
    /// The last constellation of the hands in this sign.
    pub(crate) together: Option<HandConstellation>,
    /// The last constellation of hands that are close to each other, in this sign.
    pub(crate) near: Option<HandConstellation>,
    /// Whether the hands have reached the first posture of the sign.
    pub(crate) begun: bool,
    /// The hand that stays in place while the other moves to it.
    pub(crate) fixed: Option<usize>,
    /// Collects stances during a trial plan.
    pub(crate) trail: Option<super::comfort::StanceTrail>,
    /// The number of trial plans, one within the other, that are being made.
    pub(crate) trials: usize,
    /// The bend of the movements of the current part.
    pub(crate) bend: Option<super::notation_motion::bend::MovementBend>,
    /// The last place of each hand at the body in this sign.
    pub(crate) at_body: [Option<BodyPlace>; 2],
    /// Indexes of shapes by handshape, for each hand.
    shaped: [Vec<(Handshape, usize)>; 2],
    speed: f64,
    pub(crate) plan: SignPlan,
}

/// Returns the acting hands with their frames.
pub(crate) fn iterate_acting_hands(who: ActingHands) -> impl Iterator<Item = (usize, ActingFrame)> {
    let both = who.into_iter().enumerate();
    both.filter_map(|(n, frame)| Some((n, frame?)))
}

impl<'a> SignPlanner<'a> {
    pub(crate) fn new(
        stage: &'a StandingBody,
        language: &'a BodyLanguage,
        paces: &'a PaceTables,
        handedness: SignerHandedness,
        rate: f64,
    ) -> Self {
        let dominant = handedness.signer_dominant_side();
        let sides = [dominant, dominant.opposite_side()];
        let (mut start, mut shapes) = (Vec::new(), [Vec::new(), Vec::new()]);
        for (n, side) in sides.into_iter().enumerate() {
            let (state, shape) = super::rest::resting_hand_state(stage, side);
            shapes[n].push(shape);
            start.push(state);
        }
        let start: [HandState; 2] = [start[0].clone(), start[1].clone()];
        Self {
            signer: NotationSigner {
                stage,
                language,
                paces,
                limits: ArmLimits::arm_limits_from_language(language),
                sides,
                rate,
            },
            state: start.clone(),
            rest: start.clone(),
            named: BTreeMap::new(),
            symmetric: false,
            together: None,
            near: None,
            begun: false,
            fixed: None,
            trail: None,
            trials: 0,
            bend: None,
            at_body: [None, None],
            shaped: [Vec::new(), Vec::new()],
            speed: 1.0,
            plan: SignPlan {
                sides,
                start,
                events: [Vec::new(), Vec::new()],
                shapes,
                phases: Vec::new(),
                signs: Vec::new(),
                contacts: [Vec::new(), Vec::new()],
                courses: [Vec::new(), Vec::new()],
                arrivals: [Vec::new(), Vec::new()],
                away: [Vec::new(), Vec::new()],
                mirrored: Vec::new(),
                end: 0.0,
                laced: false,
                remarks: Vec::new(),
            },
        }
    }

    /// Returns the hands as planned so far.
    pub(crate) fn planned_hands(&self) -> PlannedHands<'_> {
        PlannedHands {
            signer: self.signer,
            state: &self.state,
            shapes: &self.plan.shapes,
        }
    }

    /// Plans signs one after the other, from rest and back to rest, each at its `speed`.
    pub(crate) fn plan_signs(mut self, signs: &[&NotatedSign]) -> SignPlan {
        let mut time = tuned().tempo.still;
        let parts = signs.iter().flat_map(|notated| &notated.sign.parts);
        let mut next = parts.skip(1);
        for notated in signs {
            let mut from = None;
            self.named.clear();
            self.together = None;
            self.near = None;
            self.at_body = [None, None];
            self.speed = notated.speed.unwrap_or(1.0);
            for part in &notated.sign.parts {
                let began;
                (began, time) = self.plan_sign_part(part, next.next(), time);
                from = from.or(Some(began));
            }
            self.plan.signs.push(SignSpan {
                gloss: notated.gloss.clone(),
                from: from.unwrap_or(time),
                to: time,
            });
        }
        self.plan.end = self.relax_hands_to_rest([true, true], time, None) + tuned().tempo.still;
        self.plan
    }

    pub(crate) fn add_plan_remark(&mut self, text: &str) {
        if !self.plan.remarks.iter().any(|known| known == text) {
            self.plan.remarks.push(text.to_owned());
        }
    }

    /// Plans one part of a sign: the transition to its first posture, its actions, its end. `next` is the
    /// part that follows. Returns the times at which the posture is reached and the part ends.
    fn plan_sign_part(&mut self, part: &ManualPart, next: Option<&ManualPart>, time: f64) -> (f64, f64) {
        let who = self.acting_part_hands(part.hands);
        self.bend = None;
        self.symmetric = who[0].is_some() && who[1].is_some();
        let moves = !part.actions.is_empty();
        let named = self.addressed_hands(&part.posture, who);
        let before = self.state.clone();
        for (n, _) in iterate_acting_hands(named) {
            if !self.state[n].used {
                self.raise_resting_hand(n);
            }
        }
        let posture = self.first_part_posture(&part.posture);
        let lifted = self.lift_touched_arms(&posture, named);
        self.begun = false;
        if !part.holdover || !part.posture.is_empty() {
            self.assume_posture(&posture, named, false);
        }
        self.begun = true;
        self.start_behind(part, who);
        self.start_against(part, who);
        self.start_over(part, who, named);
        if let Some(place) = &posture.place {
            self.ease_hand_places(place, named, Some((part.actions.as_slice(), who)));
        }
        self.lean_strained_hands(named, Some((part.actions.as_slice(), who)));
        self.find_comfortable_bend(part, who);
        let goal = self.state.clone();
        let drops = !part.holdover && self.lone(part);
        let dropped = [0, 1].map(|n| drops && named[n].is_none() && before[n].used && !self.is_hand_waiting(n, next));
        let dropped = [0, 1].map(|n| dropped[n] && !lifted[n]);
        let length = (0..2)
            .map(|n| self.signer.length_between(&before[n], &goal[n], n))
            .fold(0.0, f64::max);
        let approach = self.plan_approach(part, [who, named], [&before, &goal]);
        let rested = [0, 1].map(|n| !before[n].used);
        self.state = before;
        let reached = self.signer.on_frame(time + length.max(approach.least));
        let courses = approach.approach_courses(time, reached);
        for (known, course) in self.plan.courses.iter_mut().zip(courses) {
            known.extend(course);
        }
        let touching = super::touch::asks_for_contact(&posture);
        let pace = match (moves, touching) {
            (true, _) => MovementPace::Calm,
            (false, true) => MovementPace::Contact,
            (false, false) => MovementPace::Targetted,
        };
        for (n, _) in iterate_acting_hands(named) {
            self.bend_transition_path(n, &goal[n], time, reached, pace);
            self.travel_to_goal(n, &goal[n], time, reached, pace);
            self.add_hand_phase(n, PhaseKind::Transition, time, reached, "");
            if rested[n] {
                self.plan.away[n].push((time, reached));
            }
            if part.posture.place.is_some() {
                self.plan.arrivals[n].push((time, reached));
            }
            if touching {
                let most = if moves { 0.0 } else { self.signer.language.time_hold };
                self.plan.contacts[n].push((reached, reached + most));
            }
        }
        self.plan_lifted_arms(lifted, &goal, [time, reached]);
        if dropped.iter().any(|&drop| drop) {
            self.relax_hands_to_rest(dropped, time, Some(reached));
        }
        let mut now = reached;
        for body in &part.body {
            now = now.max(self.report_body_action(body, reached));
        }
        for action in &part.actions {
            let env = super::notation_motion::InheritedModifiers {
                slower: 1.0 / self.speed,
                ..super::notation_motion::InheritedModifiers::default()
            };
            now = self.plan_motion(action, who, now, &env);
        }
        let hold = if moves {
            self.signer.language.time_end
        } else {
            self.signer.language.time_hold
        } / self.speed;
        for n in 0..2 {
            if named[n].is_some() || who[n].is_some() {
                self.add_hand_phase(n, PhaseKind::Hold, now, now + hold, "");
            }
        }
        if let [Some(own), Some(other)] = who
            && own.is_mirrored_by(&other)
        {
            self.plan.mirrored.push((reached, now + hold));
        }
        (reached, now + hold)
    }

    /// Returns the factor on the speed of the current sign.
    pub(super) fn sign_speed_factor(&self) -> f64 {
        self.speed
    }

    /// Returns whether an idle hand stays in place: it is low, and the next part uses it.
    fn is_hand_waiting(&self, n: usize, next: Option<&ManualPart>) -> bool {
        let below = self.state[n].point.y < self.signer.stage.shoulder_middle().y;
        below
            && next.is_some_and(|next| {
                self.addressed_hands(&next.posture, self.acting_part_hands(next.hands))[n].is_some()
            })
    }

    /// Returns whether a part does not involve the other hand at all.
    fn lone(&self, part: &ManualPart) -> bool {
        !matches!(part.hands, HandsUsed::Both(_))
    }

    /// Returns the first posture of a part; without a notated place, in neutral space.
    fn first_part_posture(&self, posture: &NotatedPosture) -> NotatedPosture {
        let mut begun = posture.clone();
        if begun.place.is_none() {
            begun.place = Some(HandPlace::Body(chereme_sign::hamnosys::BodyPlace::default()));
        }
        begun
    }

    /// Returns the acting hands of a part with their frames.
    pub(crate) fn acting_part_hands(&self, hands: HandsUsed) -> ActingHands {
        let signer_frame = self.signer.own_frame();
        match hands {
            HandsUsed::Dominant => [Some(signer_frame), None],
            HandsUsed::Nondominant => [None, Some(signer_frame)],
            HandsUsed::Both(symmetry) => [Some(signer_frame), Some(second(signer_frame, symmetry))],
        }
    }

    /// Returns the hands that a posture addresses: the acting ones, or both if it has a value for each.
    pub(crate) fn addressed_hands(&self, posture: &NotatedPosture, who: ActingHands) -> ActingHands {
        let signer_frame = self.signer.own_frame();
        let mut named = who;
        let [shape, extended, palm] = [
            hands_with_own_value(&posture.shape),
            hands_with_own_value(&posture.extended),
            hands_with_own_value(&posture.palm),
        ];
        let place = match &posture.place {
            Some(HandPlace::Split(a, b)) => [a.is_some(), b.is_some()],
            Some(HandPlace::Hands(hands)) if self.is_lone(hands, who) => [false, false],
            Some(HandPlace::Hands(_)) => [true, true],
            Some(HandPlace::Hand(_)) => [who[0].is_none(), who[1].is_none()],
            _ => [false, false],
        };
        for n in 0..2 {
            if named[n].is_none() && (shape[n] || extended[n] || palm[n] || place[n]) {
                named[n] = Some(signer_frame);
            }
        }
        named
    }

    /// Returns whether a constellation involves only one hand, which then touches its last place at the
    /// body.
    pub(crate) fn is_lone(&self, hands: &HandConstellation, who: ActingHands) -> bool {
        let Some(own) = (0..2).find(|&n| who[n].is_some() && who[1 - n].is_none()) else {
            return false;
        };
        hands.other.is_none() && !self.state[1 - own].used && (self.at_body[own].is_some() || hands.at.is_some())
    }

    /// Sets the posture of hands at the current end of the plan: shape, orientation, place. In a change of posture a hand
    /// whose palm has the same letter before and after does not turn over between.
    pub(crate) fn assume_posture(&mut self, posture: &NotatedPosture, named: ActingHands, changes: bool) {
        for (n, frame) in iterate_acting_hands(named) {
            self.restore_upright_hand(n);
            let before = self.state[n].clone();
            self.state[n].used = true;
            if let Some(shape) = pick_hand_value(&posture.shape, n) {
                self.reshape(n, shape);
            }
            let extended = pick_hand_value(&posture.extended, n);
            let palm = pick_hand_value(&posture.palm, n);
            if let Some(aim) = extended {
                self.state[n].direction = aim_unit_vector(aim);
                self.state[n].axes[0] = self.signer.notated_value_axes(&posture.extended, n, frame.axes);
            }
            if let Some(aim) = palm {
                self.state[n].palm = aim.aim_angle();
                self.state[n].axes[1] = self.signer.notated_value_axes(&posture.palm, n, frame.palm_axes);
            }
            if extended.is_some() || palm.is_some() {
                let relative = [extended.map(|aim| aim.frame), palm.map(|aim| aim.frame)];
                self.state[n].follows = relative.contains(&Some(Relative));
                self.state[n].heading = None;
                self.turn_hand_to_notation(n);
                if changes && before.used {
                    self.keep_side(n, &before);
                }
            }
        }
        if let Some(place) = &posture.place {
            self.place_hands(place, named);
        }
    }

    /// Changes a hand's shape; its reference point stays at the same part of the hand.
    fn reshape(&mut self, n: usize, shape: &Handshape) {
        if self.state[n].handshape == *shape && self.state[n].shape > 0 {
            return;
        }
        if let Some((_, index)) = self.shaped[n].iter().find(|(known, _)| known == shape) {
            (self.state[n].shape, self.state[n].handshape) = (*index, shape.clone());
            return;
        }
        let side = self.signer.sides[n];
        let angles = hand_angles(shape, self.signer.language);
        let posed = thumb::pose_handshape_thumb(self.signer.stage, side, shape, &angles);
        let known_index = self.plan.shapes[n].iter().position(|known| *known == posed);
        let index = known_index.unwrap_or_else(|| {
            self.plan.shapes[n].push(posed);
            self.plan.shapes[n].len() - 1
        });
        self.shaped[n].push((shape.clone(), index));
        self.state[n].shape = index;
        self.state[n].handshape = shape.clone();
    }

    pub(crate) fn add_hand_phase(&mut self, hand: usize, kind: PhaseKind, from: f64, to: f64, says: &str) {
        self.plan.phases.push(HandPhase {
            hand,
            kind,
            from,
            to,
            says: says.to_owned(),
        });
    }
}

impl NotationSigner<'_> {
    /// Returns the frame for notation without a symmetry: mirrored for left-handed signers.
    pub(crate) fn own_frame(&self) -> ActingFrame {
        let mirrored = self.sides[0] == BodySide::Left;
        let axes = DVec3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0);
        ActingFrame {
            axes,
            palm_axes: axes,
            mirrored,
            behind: false,
        }
    }

    /// Rounds a time up to the next frame.
    fn on_frame(&self, time: f64) -> f64 {
        (time * self.rate - 1e-6).ceil() / self.rate
    }

    /// Returns the axes for a notated value of a hand: those of its frame, `shared`, or the signer's if the value is
    /// the hand's own.
    fn notated_value_axes<T>(&self, said: &EachHand<T>, n: usize, shared: DVec3) -> DVec3 {
        if n == 1 && said.other_value().is_some() {
            self.own_frame().axes
        } else {
            shared
        }
    }
}

impl PlannedHands<'_> {
    /// Returns the mean of points of a hand, in the hand's space.
    pub(crate) fn mean_hand_point(&self, n: usize, points: &[NotatedHandPoint]) -> DVec3 {
        let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
            return DVec3::ZERO;
        };
        let shape = &self.shapes[n][self.state[n].shape];
        let sum: DVec3 = points
            .iter()
            .map(|&point| self.signer.stage.hand_point_offset(hand, shape, point))
            .sum();
        sum / points.len().max(1) as f64
    }
}

/// Returns the frame of the second hand under a symmetry.
fn second(own: ActingFrame, symmetry: HandSymmetry) -> ActingFrame {
    let sign = |mirrored: bool| if mirrored { -1.0 } else { 1.0 };
    let axes = own.axes * DVec3::new(sign(symmetry.left_right), sign(symmetry.up_down), sign(symmetry.out_in));
    ActingFrame {
        axes,
        palm_axes: axes.with_x(-own.axes.x),
        mirrored: own.mirrored == symmetry.real_space,
        behind: symmetry.out_of_phase,
    }
}

/// Returns a hand's notated value: the shared one, or its own.
pub(crate) fn pick_hand_value<T>(each: &EachHand<T>, n: usize) -> Option<&T> {
    match each {
        EachHand::Split(dominant, other) => [dominant, other][n].as_ref(),
        shared => shared.dominant_value(),
    }
}

fn hands_with_own_value<T>(each: &EachHand<T>) -> [bool; 2] {
    match each {
        EachHand::Split(a, b) => [a.is_some(), b.is_some()],
        _ => [false, false],
    }
}

/// Returns the unit vector of an aim (left, up, forward).
pub(crate) fn aim_unit_vector(aim: &DirectionAim<SpatialDirection>) -> DVec3 {
    mean_direction_vector(aim.first, aim.second)
}

/// Returns the unit vector half-way between two directions.
pub(crate) fn mean_direction_vector(first: SpatialDirection, second: Option<SpatialDirection>) -> DVec3 {
    let first = DVec3::from(first.spatial_direction_vector());
    let Some(second) = second else { return first };
    (first + DVec3::from(second.spatial_direction_vector())).normalize_or(first)
}
