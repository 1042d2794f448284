//! Plans repeated motions: every kind of repetition, and bouncing.

use super::*;

impl SignPlanner<'_> {
    pub(super) fn plan_repeated_motion(
        &mut self,
        motion: &NotatedMotion,
        repetition: &MotionRepetition,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
    ) -> f64 {
        let l = self.signer.language;
        let count = |repeat: RepeatKind| match repeat {
            RepeatKind::FromStart
            | RepeatKind::Continue
            | RepeatKind::Reverse
            | RepeatKind::ToFro
            | RepeatKind::Swap => 1.0,
            RepeatKind::FromStartSeveral | RepeatKind::ContinueSeveral => l.repeat_several,
            RepeatKind::ManyRandom => l.repeat_random,
        };
        let more = count(repetition.repeat) + repetition.second.map_or(0.0, count);
        let steady = is_round(motion) && repetition.shift.is_none() && repetition.growth.is_none();
        if steady && repetition.repeat != RepeatKind::Reverse {
            let env = InheritedModifiers {
                rounds: env.rounds + more,
                ..*env
            };
            return self.plan_motion(motion, who, time, &env);
        }
        let start = self.state.clone();
        let mut env = *env;
        let mut now = self.plan_motion(motion, who, time, &env);
        let mut origin = start;
        for round in 0..more as usize {
            if let Some(growth) = repetition.growth {
                let by = l.growth * length_for_size(growth.size, [0.5, 1.0, 1.5]);
                env.size *= if growth.increasing { 1.0 + by } else { 1.0 / (1.0 + by) };
            }
            now = self.plan_motion_again(motion, repetition, who, now, &env, &mut origin, round);
        }
        now
    }

    /// Plans one more round of a repeated motion.
    #[expect(clippy::too_many_arguments, reason = "one round of the loop above")]
    pub(super) fn plan_motion_again(
        &mut self,
        motion: &NotatedMotion,
        repetition: &MotionRepetition,
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
        origin: &mut [HandState; 2],
        round: usize,
    ) -> f64 {
        let l = self.signer.language;
        if let Some(shift) = repetition.shift {
            let by = DVec3::from(shift.spatial_direction_vector())
                * (l.repeat_shift * length_for_size(repetition.shift_size, [0.6, 1.0, 1.6]) * self.signer.stage.arm);
            for (n, frame) in iterate_acting_hands(who) {
                origin[n].point += self.signer.stage.body_to_model_direction(by * frame.axes);
            }
        }
        match repetition.repeat {
            RepeatKind::Continue | RepeatKind::ContinueSeveral => self.plan_motion(motion, who, time, env),
            RepeatKind::Reverse => self.back_to(origin, who, time, env, motion, MovementPace::Targetted),
            RepeatKind::ToFro => {
                let now = self.back_to(origin, who, time, env, motion, MovementPace::Targetted);
                self.plan_motion(motion, who, now, env)
            }
            RepeatKind::Swap => {
                let swapped = [0, 1].map(|n| {
                    who[n].map(|frame| ActingFrame {
                        behind: !frame.behind,
                        ..frame
                    })
                });
                let now = self.back_to(origin, who, time, env, motion, MovementPace::Lax);
                self.plan_motion(motion, swapped, now, env)
            }
            RepeatKind::FromStart | RepeatKind::FromStartSeveral | RepeatKind::ManyRandom => {
                let now = self.back_to(origin, who, time, env, motion, MovementPace::Lax);
                let unlike = if repetition.repeat == RepeatKind::ManyRandom {
                    // Fixed rather than random factors: the same notation gives the same movement.
                    [1.15, 0.85, 1.05, 0.9][round % 4]
                } else {
                    1.0
                };
                let env = InheritedModifiers {
                    size: env.size * unlike,
                    ..*env
                };
                self.plan_motion(motion, who, now, &env)
            }
        }
    }

    /// Moves hands back to the start of a motion; curved paths are traversed backwards.
    pub(super) fn back_to(
        &mut self,
        origin: &[HandState; 2],
        who: ActingHands,
        time: f64,
        env: &InheritedModifiers,
        motion: &NotatedMotion,
        pace: MovementPace,
    ) -> f64 {
        let both = [0, 1].map(|n| who[n].is_some() || self.state[n] != origin[n]);
        let far = (0..2)
            .map(|n| self.state[n].wrist_position().distance(origin[n].wrist_position()))
            .fold(0.0, f64::max);
        let usual = if pace == MovementPace::Lax {
            self.signer.language.time_return
        } else {
            self.signer.language.time_straight
        };
        let end = time
            + self
                .signer
                .limit_path_duration(usual * self.signer.slower(&motion.manner), far, env);
        for n in 0..2 {
            if both[n] {
                let used = self.state[n].used;
                self.go_to_hand_goal(n, &origin[n].clone(), time, end, pace);
                self.state[n].used = used;
                let kind = if pace == MovementPace::Lax {
                    PhaseKind::Transition
                } else {
                    PhaseKind::Stroke
                };
                self.add_hand_phase(n, kind, time, end, "back");
            }
        }
        end
    }

    pub(super) fn plan_bounce(&mut self, who: ActingHands, from: f64, end: f64) -> f64 {
        let l = self.signer.language;
        let mut to = end;
        for (n, _) in iterate_acting_hands(who) {
            let events = self.plan.events[n].iter().filter(|event| event.from >= from - 1e-9);
            let displacement: DVec3 = events
                .map(|event| match &event.act {
                    HandAct::Move(path) => path.path_end(),
                    _ => DVec3::ZERO,
                })
                .sum();
            if displacement.length() < 1e-6 {
                continue;
            }
            to = end + l.time_return;
            self.plan.events[n].push(HandEvent {
                from: end,
                to,
                pace: MovementPace::Linear,
                act: HandAct::Move(HandPath::Spring(displacement * -l.bounce)),
            });
        }
        to
    }
}
