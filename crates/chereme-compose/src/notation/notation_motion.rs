//! Plans motions as events: paths, turns of wrists, playing fingers; in sequence, simultaneous, repeated.

pub(super) mod bend;
mod motion_repeat;
mod motion_target;
mod relative;
mod room;
mod size;
mod start;

use std::f64::consts::TAU;

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::NotatedHandPoint;
use chereme_sign::hamnosys::{
    BodyAction, CircularPath, CompassDirection, DigitList, DirectedPath, HandClass, HandDigit, HandPlace, MotionKind,
    MotionManner, MotionRepetition, MotionSize, NotatedMotion, NotatedPosture, PathCurve, RepeatKind, WristMotion,
    orientation,
};

use size::{
    amount_from_sizes, circle_turn_count, direction_across_path, grow_length, is_round, length_for_size, wrist_name,
};

use super::notation_path::HandPath;
use super::notation_plan::{
    ActingFrame, ActingHands, HandAct, HandEvent, HandState, NotationSigner, PhaseKind, SignPlanner,
    iterate_acting_hands, mean_direction_vector,
};
use super::notation_tuned::tuned;
use super::pace::MovementPace;
use super::wrist_cycle::WristCycle;

/// Modifiers that a motion inherits from the motions around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InheritedModifiers {
    /// Factor on its duration.
    pub(crate) slower: f64,
    /// Factor on its size.
    pub(crate) size: f64,
    /// The number of additional rounds of a circular motion.
    pub(crate) rounds: f64,
    /// Whether it runs backwards.
    pub(crate) back: bool,
    /// Whether a path of the hand is notated at the same time.
    pub(crate) goes: bool,
}

impl Default for InheritedModifiers {
    fn default() -> Self {
        Self {
            slower: 1.0,
            size: 1.0,
            rounds: 0.0,
            back: false,
            goes: false,
        }
    }
}

impl SignPlanner<'_> {
    /// Plans a motion of the acting hands from `time` on (s); returns its end.
    pub(crate) fn plan_motion(
        &mut self,
        motion: &NotatedMotion,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let manner = &motion.manner;
        let time = if manner.rest {
            time + self.signer.language.time_rest
        } else {
            time
        };
        let who = alternated(manner, who);
        let env = InheritedModifiers {
            slower: env.slower * self.signer.slower(manner),
            ..*env
        };
        let at_once = matches!(motion.kind, MotionKind::Parallel(_) | MotionKind::Target { .. });
        if at_once {
            self.enter_trail_part();
        }
        let end = self.plan_motion_kind(&motion.kind, manner, who, time, &env);
        self.leave_trail_part(who, at_once);
        if manner.bouncing {
            return self.plan_bounce(who, time, end);
        }
        end
    }

    fn plan_motion_kind(
        &mut self,
        kind: &MotionKind,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        match kind {
            MotionKind::Directed(directed) => self.plan_directed_motion(directed, manner, who, time, env),
            MotionKind::Circular(circular) => self.plan_circular_motion(circular, manner, who, time, env),
            MotionKind::Wrist { motion, size } => self.plan_wrist_motion(*motion, *size, manner, who, time, env),
            MotionKind::Cross { diagonal } => self.plan_crossing_motion(*diagonal, manner, who, time, env),
            MotionKind::FingerPlay(digits) => self.plan_finger_play(digits, who, time, env),
            MotionKind::Still => {
                let end = time + self.signer.language.time_still * env.slower;
                self.add_phase(who, PhaseKind::Hold, time, end, "still");
                end
            }
            MotionKind::Body(action) => self.report_body_action(action, time),
            MotionKind::Split(a, b) => {
                let signer_frame = self.signer.own_frame();
                let mut end = time;
                for (n, motion) in [a, b].into_iter().enumerate() {
                    let mut only: ActingHands = [None, None];
                    only[n] = Some(ActingFrame {
                        behind: false,
                        ..signer_frame
                    });
                    if let Some(motion) = motion {
                        end = end.max(self.plan_motion(motion, only, time, env));
                    }
                }
                end
            }
            MotionKind::Sequence { motions, fused } => self.plan_motion_sequence(motions, *fused, who, time, env),
            MotionKind::Parallel(motions) => self.plan_parallel_motions(motions, who, time, env),
            MotionKind::Target { motion, posture } => {
                self.plan_target_motion(motion.as_deref(), posture, manner, who, time, env)
            }
            MotionKind::Repeated { motion, repetition } => {
                self.plan_repeated_motion(motion, repetition, who, time, env)
            }
        }
    }

    /// Moves the acting hands along a path, given for the dominant hand (left, up, forward).
    fn plan_along_path(&mut self, path: &HandPath, who: ActingHands, [from, to]: [f64; 2], pace: MovementPace) {
        for (n, frame) in iterate_acting_hands(who) {
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let stage = self.signer.stage;
            let hand_path = path.map_path_vectors(|v| stage.body_to_model_direction(v * frame.axes * sign));
            self.state[n].point += hand_path.path_end();
            self.state[n].used = true;
            self.follow_path_direction(n, &hand_path, [from, to], pace);
            self.plan.events[n].push(HandEvent {
                from,
                to,
                pace,
                act: HandAct::Move(hand_path),
            });
        }
    }

    fn add_phase(&mut self, who: ActingHands, kind: PhaseKind, from: f64, to: f64, says: &str) {
        for (n, _) in iterate_acting_hands(who) {
            self.add_hand_phase(n, kind, from, to, says);
        }
    }

    fn plan_directed_motion(
        &mut self,
        directed: &DirectedPath,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let l = self.signer.language;
        let size = amount_from_sizes(&directed.size, [l.move_small, l.move_normal, l.move_big]);
        let direction = mean_direction_vector(directed.direction, directed.second);
        let sign = if env.back { -1.0 } else { 1.0 };
        let chord = direction * (size * env.size * self.signer.stage.arm * sign);
        let usual = if directed.curve.is_some() || directed.zigzag.is_some() {
            l.time_arc
        } else {
            l.time_straight
        };
        let raw_path = match &directed.curve {
            Some(curve) => HandPath::Arc {
                chord,
                bow: self.signer.bow(direction, curve) * chord.length(),
            },
            None => HandPath::Line(chord),
        };
        let path = self.bend_path(raw_path);
        let mut end = time + self.signer.limit_path_duration(usual, path.path_length(), env);
        let mut pace = MovementPace::pace_from_manner(manner, MovementPace::Targetted);
        if directed.zigzag.is_some() {
            // The path takes as long as its waves need.
            let rate = l.zigzag_rate * (1.0 / env.slower).clamp(0.8, 1.25);
            end = end.max(time + l.zigzag_waves / rate);
            pace = MovementPace::pace_from_manner(manner, MovementPace::Linear);
        }
        self.plan_along_path(&path, who, [time, end], pace);
        if let Some(zigzag) = &directed.zigzag {
            let wide = length_for_size(zigzag.size, [l.zigzag_small, l.zigzag_normal, l.zigzag_big]);
            let wave = HandPath::Wave {
                side: direction_across_path(direction) * (wide * env.size * self.signer.stage.arm),
                waves: l.zigzag_waves,
                wavy: zigzag.wavy,
                grown: grow_length(zigzag.growth, 2.0 * l.growth),
            };
            self.plan_along_path(&wave, who, [time, end], pace);
        }
        let says = format!(
            "{}{}",
            if directed.curve.is_some() { "arc " } else { "" },
            directed.direction
        );
        self.add_phase(who, PhaseKind::Stroke, time, end, &says);
        end
    }

    fn plan_circular_motion(
        &mut self,
        circular: &CircularPath,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let l = self.signer.language;
        let radius = amount_from_sizes(&circular.size, [l.circle_small, l.circle_normal, l.circle_big]);
        let turns = circle_turn_count(circular) + env.rounds;
        let skin = self.circle_outward_direction(who);
        let (start, quarter) = self.signer.rim(circular, radius * env.size, skin);
        let path = HandPath::Circle {
            start,
            quarter: if env.back { -quarter } else { quarter },
            angle: turns * TAU,
            grown: grow_length(circular.growth, l.growth * turns),
        };
        let usual = l.time_circle * turns.max(0.4);
        let end = time + self.signer.limit_path_duration(usual, path.path_length(), env);
        let quarters = (1..4).map(|n| f64::from(n) / 4.0 / turns.max(1.0));
        for (n, frame) in iterate_acting_hands(who) {
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let stage = self.signer.stage;
            let hand_path = path.map_path_vectors(|v| stage.body_to_model_direction(v * frame.axes * sign));
            self.pass_along_path(n, &hand_path, quarters.clone());
        }
        self.plan_along_path(
            &path,
            who,
            [time, end],
            MovementPace::pace_from_manner(manner, MovementPace::Linear),
        );
        self.make_circle_room(&path, who, [time, end]);
        let says = format!("circle {}", circular.axis);
        self.add_phase(who, PhaseKind::Stroke, time, end, &says);
        end
    }

    /// Returns the direction (left, up, forward in the hand's frame) away from that which a circle should start at: the
    /// skin that a hand touches, or the other of two mirrored hands that are together.
    fn circle_outward_direction(&self, who: ActingHands) -> Option<DVec3> {
        let skin = iterate_acting_hands(who).find_map(|(n, frame)| self.skin_normal_at_hand(n, frame));
        let side_direction = || match who {
            [Some(own), Some(other)] if self.together.is_some() && own.is_mirrored_by(&other) => {
                Some(DVec3::X * (self.signer.sides[0].side_sign() * own.axes.x))
            }
            _ => None,
        };
        skin.or_else(side_direction)
    }

    fn plan_wrist_motion(
        &mut self,
        motion: WristMotion,
        size: Option<MotionSize>,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let l = self.signer.language;
        let scale = length_for_size(size, [l.wrist_small, 1.0, l.wrist_big]) * env.size;
        let cycles = if env.rounds > 0.0 {
            env.rounds + 1.0
        } else {
            l.wrist_cycles
        };
        let end = time + l.time_wrist * cycles * env.slower;
        for (n, frame) in iterate_acting_hands(who) {
            let Some(hand) = self.signer.stage.hand_of_side(self.signer.sides[n]) else {
                continue;
            };
            let nod = hand.along.cross(hand.palm);
            let swing = hand.palm * -hand.side.side_sign();
            let angle = |degrees: f64| (degrees * scale).to_radians();
            let axes = match motion {
                WristMotion::Nodding => [nod * angle(l.wrist_nodding), DVec3::ZERO],
                WristMotion::Swinging => [swing * angle(l.wrist_swinging), DVec3::ZERO],
                WristMotion::Twisting => [
                    hand.along * (-hand.side.side_sign() * angle(l.wrist_twisting)),
                    DVec3::ZERO,
                ],
                WristMotion::StirCw => [nod, swing].map(|axis| axis * angle(l.wrist_stirring)),
                WristMotion::StirCcw => [nod, -swing].map(|axis| axis * angle(l.wrist_stirring)),
            };
            let half = if frame.behind { -1.0 } else { 1.0 };
            let mut cycle = WristCycle {
                axes: axes.map(|axis| axis * half),
                cycles,
                one_sided: false,
            };
            let flaps = matches!(motion, WristMotion::Nodding | WristMotion::Swinging);
            if let Some(skin) = self.skin_normal_at_hand(n, frame).filter(|_| flaps) {
                self.off_skin(n, frame.axes * skin, &mut cycle);
            }
            self.plan.events[n].push(HandEvent {
                from: time,
                to: end,
                pace: MovementPace::pace_from_manner(manner, MovementPace::Linear),
                act: HandAct::Wrist(cycle),
            });
        }
        self.add_phase(who, PhaseKind::Stroke, time, end, wrist_name(motion));
        end
    }

    /// Makes a hand that touches the skin leave it and return to it, if its movement about the wrist would otherwise lead
    /// into the body. `skin` is the outward normal of the skin (left, up, forward).
    fn off_skin(&self, n: usize, skin: DVec3, cycle: &mut WristCycle) {
        let state = &self.state[n];
        let moves = state.rotation * cycle.axes[0].cross(state.offset);
        let out = moves.dot(self.signer.stage.body_to_model_direction(skin));
        if out.abs() > tuned().motion.flaps.0 * moves.length() {
            cycle.one_sided = true;
            cycle.axes[0] *= tuned().motion.flaps.1 * out.signum();
        }
    }

    fn plan_crossing_motion(
        &mut self,
        diagonal: bool,
        manner: &MotionManner,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let l = self.signer.language;
        let size = l.cross_size * env.size * self.signer.stage.arm;
        let points = if diagonal {
            [[1.0, -1.0], [1.0, 0.0], [0.0, -1.0]]
        } else {
            [[0.0, -1.0], [0.5, -0.5], [-0.5, -0.5]]
        };
        let path = HandPath::Through(points.map(|[x, y]| DVec3::new(x, y, 0.0) * size).to_vec());
        let end = time
            + self
                .signer
                .limit_path_duration(2.2 * l.time_straight, path.path_length(), env);
        self.plan_along_path(
            &path,
            who,
            [time, end],
            MovementPace::pace_from_manner(manner, MovementPace::Linear),
        );
        self.add_phase(who, PhaseKind::Stroke, time, end, "cross");
        end
    }

    fn plan_finger_play(&mut self, digits: &DigitList, who: ActingHands, time: f64, env: &InheritedModifiers) -> f64 {
        let l = self.signer.language;
        let cycles = l.play_cycles + env.rounds;
        let end = time + l.time_play * cycles * env.slower;
        for (n, _) in iterate_acting_hands(who) {
            let (usual, share) = match self.state[n].handshape.form.class {
                HandClass::Pinch12 | HandClass::Pinch12Open => ([true, true, false, false, false], tuned().motion.rubs),
                HandClass::PinchAll => ([true; 5], tuned().motion.rubs),
                _ => ([false, true, true, true, true], 1.0),
            };
            let playing = match digits.is_empty() {
                true => usual,
                false => HandDigit::ALL_HAND_DIGITS.map(|digit| digits.contains_digit(digit)),
            };
            self.plan.events[n].push(HandEvent {
                from: time,
                to: end,
                pace: MovementPace::Linear,
                act: HandAct::Play {
                    digits: playing,
                    angle: l.play_angle.to_radians() * share,
                    cycles,
                },
            });
        }
        self.add_phase(who, PhaseKind::Stroke, time, end, "fingers play");
        end
    }

    /// Reports an action of the body in place of a hand; the animator does not move the body for it.
    pub(crate) fn report_body_action(&mut self, action: &BodyAction, time: f64) -> f64 {
        self.add_plan_remark("movements of the body in place of a hand are annotated, not animated");
        let end = time + self.signer.language.time_body;
        self.add_hand_phase(
            0,
            PhaseKind::Stroke,
            time,
            end,
            &format!("the body moves: {:?}", action.part),
        );
        end
    }

    fn plan_motion_sequence(
        &mut self,
        motions: &[NotatedMotion],
        fused: bool,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let mut now = time;
        let last = motions.len().saturating_sub(1);
        let order: Vec<&NotatedMotion> = if env.back {
            motions.iter().rev().collect()
        } else {
            motions.iter().collect()
        };
        for (n, motion) in order.into_iter().enumerate() {
            let end = self.plan_motion(motion, who, now, env);
            now = if fused && n < last {
                end - (end - now) * self.signer.language.fused
            } else {
                end
            };
        }
        now
    }

    /// Makes hands that rotate while they leave each other or the skin, or that rotate far while they move, rotate about their palms
    /// instead of their fingertips: otherwise turning about the fingertips would move the wrist back against its path.
    fn let_go_fingertips(&mut self, motions: &[NotatedMotion], who: ActingHands, time: f64) {
        let turns = |motion: &NotatedMotion| match &motion.kind {
            MotionKind::Target { motion, posture } => {
                let turned = posture.extended.dominant_value().is_some() || posture.palm.dominant_value().is_some();
                motion.is_none() && turned && posture.place.is_none()
            }
            _ => false,
        };
        if !motions.iter().any(goes) || !motions.iter().any(turns) {
            return;
        }
        let inwards = |motion: &NotatedMotion| match &motion.kind {
            MotionKind::Directed(path) => mean_direction_vector(path.direction, path.second).z < -0.3,
            _ => false,
        };
        let turned = match self.together {
            Some(_) => [f64::INFINITY; 2],
            // A hand that leads to the body does so with the part that is nearest to it.
            None if motions.iter().any(inwards) => return,
            None => self.turned_by(motions.iter().filter(|motion| turns(motion)), who),
        };
        for (n, frame) in iterate_acting_hands(who) {
            let least = match self.skin_normal_at_hand(n, frame) {
                Some(skin) if motions.iter().any(|motion| leaves_skin(motion, skin)) => tuned().motion.leaving_turn,
                Some(_) => continue,
                None => tuned().motion.far_turn,
            };
            if turned[n] < least {
                continue;
            }
            let palm = self.planned_hands().mean_hand_point(n, &[NotatedHandPoint::Palm]);
            let mut goal = self.state[n].clone();
            if goal.offset.distance(palm) < 1e-9 {
                continue;
            }
            goal.point = goal.wrist_position() + goal.rotation * palm;
            goal.offset = palm;
            self.go_to_hand_goal(n, &goal, time, time + tuned().motion.let_go, MovementPace::Linear);
        }
    }

    /// Returns the angles (rad) by which motions rotate the hands, by a trial plan.
    fn turned_by<'m>(&mut self, motions: impl Iterator<Item = &'m NotatedMotion>, who: ActingHands) -> [f64; 2] {
        let before = [0, 1].map(|n| self.state[n].rotation);
        let after = self.unseen(|planner| {
            for motion in motions {
                planner.plan_motion(motion, who, 0.0, &InheritedModifiers::default());
            }
            [0, 1].map(|n| planner.state[n].rotation)
        });
        [0, 1].map(|n| before[n].angle_between(after[n]))
    }

    fn plan_parallel_motions(
        &mut self,
        motions: &[NotatedMotion],
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        self.let_go_fingertips(motions, who, time);
        let shared = self.signer.shared_tempo(motions);
        let env = &InheritedModifiers {
            goes: env.goes || motions.iter().any(goes),
            ..*env
        };
        let at_tempo = |motion: &NotatedMotion| InheritedModifiers {
            slower: match has_tempo(motion) {
                true => env.slower,
                false => env.slower * shared,
            },
            ..*env
        };
        let lengths: Vec<f64> = motions
            .iter()
            .map(|motion| self.length_of(motion, who, &at_tempo(motion)))
            .collect();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        // Plan paths first, so that the postures at their end are solved at the final positions.
        let (paths, ends): (Vec<_>, Vec<_>) = motions
            .iter()
            .zip(lengths)
            .partition(|(motion, _)| !matches!(motion.kind, MotionKind::Target { .. }));
        for (motion, length) in paths.into_iter().chain(ends) {
            let stretch = if length > 1e-6 { longest / length } else { 1.0 };
            let tempo_env = at_tempo(motion);
            let env = InheritedModifiers {
                slower: tempo_env.slower * stretch,
                ..tempo_env
            };
            self.plan_motion(motion, who, time, &env);
        }
        time + longest
    }

    /// Returns the duration of a motion (s), by a trial plan.
    fn length_of(&mut self, motion: &NotatedMotion, who: ActingHands, env: &InheritedModifiers) -> f64 {
        self.unseen(|planner| planner.plan_motion(motion, who, 0.0, env))
    }

    /// Runs a trial plan whose stances do not count.
    fn unseen<T>(&mut self, plan: impl FnOnce(&mut Self) -> T) -> T {
        self.enter_trail_part();
        let result = self.run_trial_plan(plan);
        if let Some(trail) = &mut self.trail {
            trail.within -= 1;
        }
        result
    }

    /// Runs a trial plan and discards its events and remarks; returns its result.
    pub(crate) fn run_trial_plan<T>(&mut self, plan: impl FnOnce(&mut Self) -> T) -> T {
        let state = self.state.clone();
        let events = [0, 1].map(|n| self.plan.events[n].len());
        let (phases, remarks) = (self.plan.phases.len(), self.plan.remarks.len());
        let (named, together) = (self.named.clone(), self.together.clone());
        let near = self.near.clone();
        let contacts = [0, 1].map(|n| self.plan.contacts[n].len());
        let arrivals = [0, 1].map(|n| self.plan.arrivals[n].len());
        let at_body = self.at_body.clone();
        self.trials += 1;
        let end = plan(self);
        self.trials -= 1;
        self.state = state;
        self.named = named;
        self.together = together;
        self.near = near;
        self.at_body = at_body;
        for n in 0..2 {
            self.plan.events[n].truncate(events[n]);
            self.plan.contacts[n].truncate(contacts[n]);
            self.plan.arrivals[n].truncate(arrivals[n]);
        }
        self.plan.phases.truncate(phases);
        self.plan.remarks.truncate(remarks);
        end
    }
}

/// Returns whether a motion is a path of the hand.
fn goes(motion: &NotatedMotion) -> bool {
    matches!(motion.kind, MotionKind::Directed(_) | MotionKind::Circular(_))
}

/// Returns whether a motion leads away from the skin; `out` is its outward normal (left, up, forward in the hand's frame).
fn leaves_skin(motion: &NotatedMotion, out: DVec3) -> bool {
    match &motion.kind {
        MotionKind::Directed(path) => mean_direction_vector(path.direction, path.second).dot(out) > 0.3,
        _ => false,
    }
}

impl NotationSigner<'_> {
    /// Returns a manner's factor on the duration.
    fn slower(&self, manner: &MotionManner) -> f64 {
        let l = self.language;
        let mut slower = 1.0;
        if manner.fast {
            slower *= l.manner_fast;
        }
        if manner.slow {
            slower *= l.manner_slow;
        }
        if manner.tense {
            slower *= l.manner_tense;
        }
        if manner.halt {
            slower *= l.manner_halt;
        }
        let speed = manner.speed.filter(|speed| speed.is_finite() && *speed > 0.0);
        slower / speed.unwrap_or(1.0).clamp(0.1, 10.0)
    }

    /// Returns the duration (s) of a path: the usual one, or longer if the hand would be too fast.
    fn limit_path_duration(&self, usual: f64, length: f64, env: &InheritedModifiers) -> f64 {
        // A targetted movement is at its fastest 2.6 times as fast as on average.
        let least = 2.6 * length / (self.language.speed_most * self.stage.arm);
        (usual * env.slower).max(least)
    }

    /// Returns the bulge of an arc: its direction, with its depth as a share of the chord as length.
    fn bow(&self, direction: DVec3, curve: &PathCurve) -> DVec3 {
        let l = self.language;
        let deep = length_for_size(curve.size, [l.arc_small, l.arc_normal, l.arc_big]);
        DVec3::from(orientation::rotate_from_forward(
            direction.into(),
            curve.to.compass_angle(),
        )) * deep
    }

    /// Returns the vectors from a circle's centre to its start and to the point a quarter turn on. The
    /// default start is above; a hand that touches the body or the other hand starts there: `skin` is the direction
    /// away from it.
    fn rim(&self, circular: &CircularPath, radius: f64, skin: Option<DVec3>) -> (DVec3, DVec3) {
        let l = self.language;
        let axis = mean_direction_vector(circular.axis, circular.second);
        let about = |angle: f64| DVec3::from(orientation::rotate_from_forward(axis.into(), angle));
        let upright = skin.filter(|out| out.dot(axis).abs() < 0.8);
        let usual = upright.map_or(std::f64::consts::PI, |out| {
            orientation::angle_about(axis.into(), (-out).into())
        });
        let start = about(circular.clock.start.map_or(usual, |at| at.compass_angle()));
        // A quarter turn on by the right-hand rule about the axis.
        let mut spokes = [start, axis.cross(start)];
        if let Some(ellipse) = circular.ellipse {
            use chereme_sign::hamnosys::EllipseAxis;
            let long = match ellipse {
                EllipseAxis::Horizontal => about(CompassDirection::R.compass_angle()),
                EllipseAxis::Vertical => about(CompassDirection::U.compass_angle()),
                EllipseAxis::UpRight => about(CompassDirection::Ur.compass_angle()),
                EllipseAxis::UpLeft => about(CompassDirection::Ul.compass_angle()),
            };
            let narrow = length_for_size(
                circular.ellipse_size,
                [l.ellipse_small, l.ellipse_normal, l.ellipse_big],
            );
            let squeeze = |v: DVec3| {
                let along = long * v.dot(long);
                along + (v - along) * narrow
            };
            spokes = spokes.map(squeeze);
        }
        let size = radius * self.stage.arm;
        (spokes[0] * size, spokes[1] * size)
    }

    /// Returns the factor on the duration of simultaneous motions for which the notation gives no tempo: the fastest
    /// that it gives one of them. Without it a change of handshape beside a fast path would slow the path down.
    fn shared_tempo(&self, motions: &[NotatedMotion]) -> f64 {
        let written = motions.iter().filter(|motion| has_tempo(motion));
        let factors = written.filter_map(tempo_manner).map(|manner| self.slower(manner));
        factors.fold(1.0, f64::min)
    }
}

/// Returns the manner that gives the tempo of a motion: its own, or that of the motion that it repeats or that leads to
/// its goal.
fn tempo_manner(motion: &NotatedMotion) -> Option<&MotionManner> {
    let manner = &motion.manner;
    if manner.fast || manner.slow || manner.speed.is_some() {
        return Some(manner);
    }
    match &motion.kind {
        MotionKind::Target { motion, .. } => motion.as_deref().and_then(tempo_manner),
        MotionKind::Repeated { motion, .. } => tempo_manner(motion),
        _ => None,
    }
}

fn has_tempo(motion: &NotatedMotion) -> bool {
    tempo_manner(motion).is_some()
}

/// Returns the acting hands of an alternating motion: the second hand is half a period behind.
fn alternated(manner: &MotionManner, mut who: ActingHands) -> ActingHands {
    if (manner.alternating || manner.second_alternating) && who[0].is_some() {
        who[1] = who[1].map(|frame| ActingFrame { behind: true, ..frame });
    }
    who
}
