//! Plans motions as events: paths, turns of wrists, playing fingers; in sequence, simultaneous, repeated.

pub(super) mod bend;
mod relative;
mod repeat;
mod room;
mod size;
mod start;
mod target;

use std::f64::consts::TAU;

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::sites::HandPoint;
use chereme_sign::hamnosys::{
    BodyAction, Circular, Compass, Curve, Digit, Digits, Directed, HandClass, Manner, Motion,
    MotionKind, Place, Posture, Repeat, Repetition, Size, WristMotion, orientation,
};

use size::{across, amount, grown, is_round, sized, turns, wrist_name};

use super::pace::Pace;
use super::path::Path;
use super::plan::{Act, Event, Frame, HandState, PhaseKind, Planner, Signer, Who, acting, mean};
use super::tuned::tuned;
use super::wrist_cycle::WristCycle;

/// Modifiers that a motion inherits from the motions around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Env {
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

impl Default for Env {
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

impl Planner<'_> {
    /// Plans a motion of the acting hands from `time` on (s); returns its end.
    pub(crate) fn motion(&mut self, motion: &Motion, who: Who, time: f64, env: &Env) -> f64 {
        let manner = &motion.manner;
        let time = if manner.rest {
            time + self.signer.language.time_rest
        } else {
            time
        };
        let who = alternated(manner, who);
        let env = Env {
            slower: env.slower * self.signer.slower(manner),
            ..*env
        };
        let at_once = matches!(
            motion.kind,
            MotionKind::Parallel(_) | MotionKind::Target { .. }
        );
        if at_once {
            self.enter();
        }
        let end = self.kind(&motion.kind, manner, who, time, &env);
        self.leave(who, at_once);
        if manner.bouncing {
            return self.bounce(who, time, end);
        }
        end
    }

    fn kind(&mut self, kind: &MotionKind, manner: &Manner, who: Who, time: f64, env: &Env) -> f64 {
        match kind {
            MotionKind::Directed(directed) => self.directed(directed, manner, who, time, env),
            MotionKind::Circular(circular) => self.circular(circular, manner, who, time, env),
            MotionKind::Wrist { motion, size } => {
                self.wrist(*motion, *size, manner, who, time, env)
            }
            MotionKind::Cross { diagonal } => self.crossing(*diagonal, manner, who, time, env),
            MotionKind::FingerPlay(digits) => self.play(digits, who, time, env),
            MotionKind::Still => {
                let end = time + self.signer.language.time_still * env.slower;
                self.add_phase(who, PhaseKind::Hold, time, end, "still");
                end
            }
            MotionKind::Body(action) => self.body(action, time),
            MotionKind::Split(a, b) => {
                let own = self.signer.own_frame();
                let mut end = time;
                for (n, motion) in [a, b].into_iter().enumerate() {
                    let mut only: Who = [None, None];
                    only[n] = Some(Frame {
                        behind: false,
                        ..own
                    });
                    if let Some(motion) = motion {
                        end = end.max(self.motion(motion, only, time, env));
                    }
                }
                end
            }
            MotionKind::Sequence { motions, fused } => {
                self.sequence(motions, *fused, who, time, env)
            }
            MotionKind::Parallel(motions) => self.parallel(motions, who, time, env),
            MotionKind::Target { motion, posture } => {
                self.target(motion.as_deref(), posture, manner, who, time, env)
            }
            MotionKind::Repeated { motion, repetition } => {
                self.repeated(motion, repetition, who, time, env)
            }
        }
    }

    /// Moves the acting hands along a path, given for the dominant hand (left, up, forward).
    fn along(&mut self, path: &Path, who: Who, [from, to]: [f64; 2], pace: Pace) {
        for (n, frame) in acting(who) {
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let stage = self.signer.stage;
            let own = path.map(|v| stage.direction(v * frame.axes * sign));
            self.state[n].point += own.end();
            self.state[n].used = true;
            self.follow(n, &own, [from, to], pace);
            self.plan.events[n].push(Event {
                from,
                to,
                pace,
                act: Act::Move(own),
            });
        }
    }

    fn add_phase(&mut self, who: Who, kind: PhaseKind, from: f64, to: f64, says: &str) {
        for (n, _) in acting(who) {
            self.phase(n, kind, from, to, says);
        }
    }

    fn directed(
        &mut self,
        directed: &Directed,
        manner: &Manner,
        who: Who,
        time: f64,
        env: &Env,
    ) -> f64 {
        let l = self.signer.language;
        let size = amount(&directed.size, [l.move_small, l.move_normal, l.move_big]);
        let direction = mean(directed.direction, directed.second);
        let sign = if env.back { -1.0 } else { 1.0 };
        let chord = direction * (size * env.size * self.signer.stage.arm * sign);
        let usual = if directed.curve.is_some() || directed.zigzag.is_some() {
            l.time_arc
        } else {
            l.time_straight
        };
        let path = match &directed.curve {
            Some(curve) => Path::Arc {
                chord,
                bow: self.signer.bow(direction, curve) * chord.length(),
            },
            None => Path::Line(chord),
        };
        let path = self.bent(path);
        let mut end = time + self.signer.timed(usual, path.length(), env);
        let mut pace = Pace::of(manner, Pace::Targetted);
        if directed.zigzag.is_some() {
            // The path takes as long as its waves need.
            let rate = l.zigzag_rate * (1.0 / env.slower).clamp(0.8, 1.25);
            end = end.max(time + l.zigzag_waves / rate);
            pace = Pace::of(manner, Pace::Linear);
        }
        self.along(&path, who, [time, end], pace);
        if let Some(zigzag) = &directed.zigzag {
            let wide = sized(zigzag.size, [l.zigzag_small, l.zigzag_normal, l.zigzag_big]);
            let wave = Path::Wave {
                side: across(direction) * (wide * env.size * self.signer.stage.arm),
                waves: l.zigzag_waves,
                wavy: zigzag.wavy,
                grown: grown(zigzag.growth, 2.0 * l.growth),
            };
            self.along(&wave, who, [time, end], pace);
        }
        let says = format!(
            "{}{}",
            if directed.curve.is_some() { "arc " } else { "" },
            directed.direction
        );
        self.add_phase(who, PhaseKind::Stroke, time, end, &says);
        end
    }

    fn circular(
        &mut self,
        circular: &Circular,
        manner: &Manner,
        who: Who,
        time: f64,
        env: &Env,
    ) -> f64 {
        let l = self.signer.language;
        let radius = amount(
            &circular.size,
            [l.circle_small, l.circle_normal, l.circle_big],
        );
        let turns = turns(circular) + env.rounds;
        let skin = self.outwards(who);
        let (start, quarter) = self.signer.rim(circular, radius * env.size, skin);
        let path = Path::Circle {
            start,
            quarter: if env.back { -quarter } else { quarter },
            angle: turns * TAU,
            grown: grown(circular.growth, l.growth * turns),
        };
        let usual = l.time_circle * turns.max(0.4);
        let end = time + self.signer.timed(usual, path.length(), env);
        let quarters = (1..4).map(|n| f64::from(n) / 4.0 / turns.max(1.0));
        for (n, frame) in acting(who) {
            let sign = if frame.behind { -1.0 } else { 1.0 };
            let stage = self.signer.stage;
            let own = path.map(|v| stage.direction(v * frame.axes * sign));
            self.pass(n, &own, quarters.clone());
        }
        self.along(&path, who, [time, end], Pace::of(manner, Pace::Linear));
        self.make_room(&path, who, [time, end]);
        let says = format!("circle {}", circular.axis);
        self.add_phase(who, PhaseKind::Stroke, time, end, &says);
        end
    }

    /// Returns the direction (left, up, forward in the hand's frame) away from that which a circle should start at: the
    /// skin that a hand touches, or the other of two mirrored hands that are together.
    fn outwards(&self, who: Who) -> Option<DVec3> {
        let skin = acting(who).find_map(|(n, frame)| self.skin(n, frame));
        let beside = || match who {
            [Some(own), Some(other)] if self.together.is_some() && own.mirrors(&other) => {
                Some(DVec3::X * (self.signer.sides[0].sign() * own.axes.x))
            }
            _ => None,
        };
        skin.or_else(beside)
    }

    fn wrist(
        &mut self,
        motion: WristMotion,
        size: Option<Size>,
        manner: &Manner,
        who: Who,
        time: f64,
        env: &Env,
    ) -> f64 {
        let l = self.signer.language;
        let scale = sized(size, [l.wrist_small, 1.0, l.wrist_big]) * env.size;
        let cycles = if env.rounds > 0.0 {
            env.rounds + 1.0
        } else {
            l.wrist_cycles
        };
        let end = time + l.time_wrist * cycles * env.slower;
        for (n, frame) in acting(who) {
            let Some(hand) = self.signer.stage.hand(self.signer.sides[n]) else {
                continue;
            };
            let nod = hand.along.cross(hand.palm);
            let swing = hand.palm * -hand.side.sign();
            let angle = |degrees: f64| (degrees * scale).to_radians();
            let axes = match motion {
                WristMotion::Nodding => [nod * angle(l.wrist_nodding), DVec3::ZERO],
                WristMotion::Swinging => [swing * angle(l.wrist_swinging), DVec3::ZERO],
                WristMotion::Twisting => [
                    hand.along * (-hand.side.sign() * angle(l.wrist_twisting)),
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
            if let Some(skin) = self.skin(n, frame).filter(|_| flaps) {
                self.off_skin(n, frame.axes * skin, &mut cycle);
            }
            self.plan.events[n].push(Event {
                from: time,
                to: end,
                pace: Pace::of(manner, Pace::Linear),
                act: Act::Wrist(cycle),
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
        let out = moves.dot(self.signer.stage.direction(skin));
        if out.abs() > tuned().motion.flaps.0 * moves.length() {
            cycle.one_sided = true;
            cycle.axes[0] *= tuned().motion.flaps.1 * out.signum();
        }
    }

    fn crossing(&mut self, diagonal: bool, manner: &Manner, who: Who, time: f64, env: &Env) -> f64 {
        let l = self.signer.language;
        let size = l.cross_size * env.size * self.signer.stage.arm;
        let points = if diagonal {
            [[1.0, -1.0], [1.0, 0.0], [0.0, -1.0]]
        } else {
            [[0.0, -1.0], [0.5, -0.5], [-0.5, -0.5]]
        };
        let path = Path::Through(points.map(|[x, y]| DVec3::new(x, y, 0.0) * size).to_vec());
        let end = time + self.signer.timed(2.2 * l.time_straight, path.length(), env);
        self.along(&path, who, [time, end], Pace::of(manner, Pace::Linear));
        self.add_phase(who, PhaseKind::Stroke, time, end, "cross");
        end
    }

    fn play(&mut self, digits: &Digits, who: Who, time: f64, env: &Env) -> f64 {
        let l = self.signer.language;
        let cycles = l.play_cycles + env.rounds;
        let end = time + l.time_play * cycles * env.slower;
        for (n, _) in acting(who) {
            let (usual, share) = match self.state[n].handshape.form.class {
                HandClass::Pinch12 | HandClass::Pinch12Open => {
                    ([true, true, false, false, false], tuned().motion.rubs)
                }
                HandClass::PinchAll => ([true; 5], tuned().motion.rubs),
                _ => ([false, true, true, true, true], 1.0),
            };
            let playing = match digits.is_empty() {
                true => usual,
                false => Digit::ALL.map(|digit| digits.contains(digit)),
            };
            self.plan.events[n].push(Event {
                from: time,
                to: end,
                pace: Pace::Linear,
                act: Act::Play {
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
    pub(crate) fn body(&mut self, action: &BodyAction, time: f64) -> f64 {
        self.remark("movements of the body in place of a hand are annotated, not animated");
        let end = time + self.signer.language.time_body;
        self.phase(
            0,
            PhaseKind::Stroke,
            time,
            end,
            &format!("the body moves: {:?}", action.part),
        );
        end
    }

    fn sequence(&mut self, motions: &[Motion], fused: bool, who: Who, time: f64, env: &Env) -> f64 {
        let mut now = time;
        let last = motions.len().saturating_sub(1);
        let order: Vec<&Motion> = if env.back {
            motions.iter().rev().collect()
        } else {
            motions.iter().collect()
        };
        for (n, motion) in order.into_iter().enumerate() {
            let end = self.motion(motion, who, now, env);
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
    fn let_go(&mut self, motions: &[Motion], who: Who, time: f64) {
        let turns = |motion: &Motion| match &motion.kind {
            MotionKind::Target { motion, posture } => {
                let turned =
                    posture.extended.dominant().is_some() || posture.palm.dominant().is_some();
                motion.is_none() && turned && posture.place.is_none()
            }
            _ => false,
        };
        if !motions.iter().any(goes) || !motions.iter().any(turns) {
            return;
        }
        let inwards = |motion: &Motion| match &motion.kind {
            MotionKind::Directed(path) => mean(path.direction, path.second).z < -0.3,
            _ => false,
        };
        let turned = match self.together {
            Some(_) => [f64::INFINITY; 2],
            // A hand that leads to the body does so with the part that is nearest to it.
            None if motions.iter().any(inwards) => return,
            None => self.turned_by(motions.iter().filter(|motion| turns(motion)), who),
        };
        for (n, frame) in acting(who) {
            let least = match self.skin(n, frame) {
                Some(skin) if motions.iter().any(|motion| leaves(motion, skin)) => {
                    tuned().motion.leaving_turn
                }
                Some(_) => continue,
                None => tuned().motion.far_turn,
            };
            if turned[n] < least {
                continue;
            }
            let palm = self.hands().offset(n, &[HandPoint::Palm]);
            let mut goal = self.state[n].clone();
            if goal.offset.distance(palm) < 1e-9 {
                continue;
            }
            goal.point = goal.wrist() + goal.rotation * palm;
            goal.offset = palm;
            self.go(n, &goal, time, time + tuned().motion.let_go, Pace::Linear);
        }
    }

    /// Returns the angles (rad) by which motions rotate the hands, by a trial plan.
    fn turned_by<'m>(&mut self, motions: impl Iterator<Item = &'m Motion>, who: Who) -> [f64; 2] {
        let before = [0, 1].map(|n| self.state[n].rotation);
        let after = self.unseen(|planner| {
            for motion in motions {
                planner.motion(motion, who, 0.0, &Env::default());
            }
            [0, 1].map(|n| planner.state[n].rotation)
        });
        [0, 1].map(|n| before[n].angle_between(after[n]))
    }

    fn parallel(&mut self, motions: &[Motion], who: Who, time: f64, env: &Env) -> f64 {
        self.let_go(motions, who, time);
        let shared = self.signer.shared_tempo(motions);
        let env = &Env {
            goes: env.goes || motions.iter().any(goes),
            ..*env
        };
        let at_tempo = |motion: &Motion| Env {
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
            let env = at_tempo(motion);
            let env = Env {
                slower: env.slower * stretch,
                ..env
            };
            self.motion(motion, who, time, &env);
        }
        time + longest
    }

    /// Returns the duration of a motion (s), by a trial plan.
    fn length_of(&mut self, motion: &Motion, who: Who, env: &Env) -> f64 {
        self.unseen(|planner| planner.motion(motion, who, 0.0, env))
    }

    /// Runs a trial plan whose stances do not count.
    fn unseen<T>(&mut self, plan: impl FnOnce(&mut Self) -> T) -> T {
        self.enter();
        let result = self.aside(plan);
        if let Some(trail) = &mut self.trail {
            trail.within -= 1;
        }
        result
    }

    /// Runs a trial plan and discards its events and remarks; returns its result.
    pub(crate) fn aside<T>(&mut self, plan: impl FnOnce(&mut Self) -> T) -> T {
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
fn goes(motion: &Motion) -> bool {
    matches!(
        motion.kind,
        MotionKind::Directed(_) | MotionKind::Circular(_)
    )
}

/// Returns whether a motion leads away from the skin; `out` is its outward normal (left, up, forward in the hand's frame).
fn leaves(motion: &Motion, out: DVec3) -> bool {
    match &motion.kind {
        MotionKind::Directed(path) => mean(path.direction, path.second).dot(out) > 0.3,
        _ => false,
    }
}

impl Signer<'_> {
    /// Returns a manner's factor on the duration.
    fn slower(&self, manner: &Manner) -> f64 {
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
        let speed = manner
            .speed
            .filter(|speed| speed.is_finite() && *speed > 0.0);
        slower / speed.unwrap_or(1.0).clamp(0.1, 10.0)
    }

    /// Returns the duration (s) of a path: the usual one, or longer if the hand would be too fast.
    fn timed(&self, usual: f64, length: f64, env: &Env) -> f64 {
        // A targetted movement is at its fastest 2.6 times as fast as on average.
        let least = 2.6 * length / (self.language.speed_most * self.stage.arm);
        (usual * env.slower).max(least)
    }

    /// Returns the bulge of an arc: its direction, with its depth as a share of the chord as length.
    fn bow(&self, direction: DVec3, curve: &Curve) -> DVec3 {
        let l = self.language;
        let deep = sized(curve.size, [l.arc_small, l.arc_normal, l.arc_big]);
        DVec3::from(orientation::about(direction.into(), curve.to.angle())) * deep
    }

    /// Returns the vectors from a circle's centre to its start and to the point a quarter turn on. The
    /// default start is above; a hand that touches the body or the other hand starts there: `skin` is the direction
    /// away from it.
    fn rim(&self, circular: &Circular, radius: f64, skin: Option<DVec3>) -> (DVec3, DVec3) {
        let l = self.language;
        let axis = mean(circular.axis, circular.second);
        let about = |angle: f64| DVec3::from(orientation::about(axis.into(), angle));
        let upright = skin.filter(|out| out.dot(axis).abs() < 0.8);
        let usual = upright.map_or(std::f64::consts::PI, |out| {
            orientation::angle_about(axis.into(), (-out).into())
        });
        let start = about(circular.clock.start.map_or(usual, |at| at.angle()));
        // A quarter turn on by the right-hand rule about the axis.
        let mut spokes = [start, axis.cross(start)];
        if let Some(ellipse) = circular.ellipse {
            use chereme_sign::hamnosys::Ellipse;
            let long = match ellipse {
                Ellipse::Horizontal => about(Compass::R.angle()),
                Ellipse::Vertical => about(Compass::U.angle()),
                Ellipse::UpRight => about(Compass::Ur.angle()),
                Ellipse::UpLeft => about(Compass::Ul.angle()),
            };
            let narrow = sized(
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
    fn shared_tempo(&self, motions: &[Motion]) -> f64 {
        let written = motions.iter().filter(|motion| has_tempo(motion));
        let factors = written.filter_map(tempo_manner).map(|it| self.slower(it));
        factors.fold(1.0, f64::min)
    }
}

/// Returns the manner that gives the tempo of a motion: its own, or that of the motion that it repeats or that leads to
/// its goal.
fn tempo_manner(motion: &Motion) -> Option<&Manner> {
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

fn has_tempo(motion: &Motion) -> bool {
    tempo_manner(motion).is_some()
}

/// Returns the acting hands of an alternating motion: the second hand is half a period behind.
fn alternated(manner: &Manner, mut who: Who) -> Who {
    if (manner.alternating || manner.second_alternating) && who[0].is_some() {
        who[1] = who[1].map(|frame| Frame {
            behind: true,
            ..frame
        });
    }
    who
}
