//! Plans repeated motions: every kind of repetition, and bouncing.

use super::*;

impl Planner<'_> {
    pub(super) fn repeated(
        &mut self,
        motion: &Motion,
        repetition: &Repetition,
        who: Who,
        time: f64,
        env: &Env,
    ) -> f64 {
        let l = self.signer.language;
        let count = |repeat: Repeat| match repeat {
            Repeat::FromStart
            | Repeat::Continue
            | Repeat::Reverse
            | Repeat::ToFro
            | Repeat::Swap => 1.0,
            Repeat::FromStartSeveral | Repeat::ContinueSeveral => l.repeat_several,
            Repeat::ManyRandom => l.repeat_random,
        };
        let more = count(repetition.repeat) + repetition.second.map_or(0.0, count);
        let steady = is_round(motion) && repetition.shift.is_none() && repetition.growth.is_none();
        if steady && repetition.repeat != Repeat::Reverse {
            let env = Env {
                rounds: env.rounds + more,
                ..*env
            };
            return self.motion(motion, who, time, &env);
        }
        let start = self.state.clone();
        let mut env = *env;
        let mut now = self.motion(motion, who, time, &env);
        let mut origin = start;
        for round in 0..more as usize {
            if let Some(growth) = repetition.growth {
                let by = l.growth * sized(growth.size, [0.5, 1.0, 1.5]);
                env.size *= if growth.increasing {
                    1.0 + by
                } else {
                    1.0 / (1.0 + by)
                };
            }
            now = self.again(motion, repetition, who, now, &env, &mut origin, round);
        }
        now
    }

    /// Plans one more round of a repeated motion.
    #[expect(clippy::too_many_arguments, reason = "one round of the loop above")]
    pub(super) fn again(
        &mut self,
        motion: &Motion,
        repetition: &Repetition,
        who: Who,
        time: f64,
        env: &Env,
        origin: &mut [HandState; 2],
        round: usize,
    ) -> f64 {
        let l = self.signer.language;
        if let Some(shift) = repetition.shift {
            let by = DVec3::from(shift.vector())
                * (l.repeat_shift
                    * sized(repetition.shift_size, [0.6, 1.0, 1.6])
                    * self.signer.stage.arm);
            for (n, frame) in acting(who) {
                origin[n].point += self.signer.stage.direction(by * frame.axes);
            }
        }
        match repetition.repeat {
            Repeat::Continue | Repeat::ContinueSeveral => self.motion(motion, who, time, env),
            Repeat::Reverse => self.back_to(origin, who, time, env, motion, Pace::Targetted),
            Repeat::ToFro => {
                let now = self.back_to(origin, who, time, env, motion, Pace::Targetted);
                self.motion(motion, who, now, env)
            }
            Repeat::Swap => {
                let swapped = [0, 1].map(|n| {
                    who[n].map(|frame| Frame {
                        behind: !frame.behind,
                        ..frame
                    })
                });
                let now = self.back_to(origin, who, time, env, motion, Pace::Lax);
                self.motion(motion, swapped, now, env)
            }
            Repeat::FromStart | Repeat::FromStartSeveral | Repeat::ManyRandom => {
                let now = self.back_to(origin, who, time, env, motion, Pace::Lax);
                let unlike = if repetition.repeat == Repeat::ManyRandom {
                    // Fixed rather than random factors: the same notation gives the same movement.
                    [1.15, 0.85, 1.05, 0.9][round % 4]
                } else {
                    1.0
                };
                let env = Env {
                    size: env.size * unlike,
                    ..*env
                };
                self.motion(motion, who, now, &env)
            }
        }
    }

    /// Moves hands back to the start of a motion; curved paths are traversed backwards.
    pub(super) fn back_to(
        &mut self,
        origin: &[HandState; 2],
        who: Who,
        time: f64,
        env: &Env,
        motion: &Motion,
        pace: Pace,
    ) -> f64 {
        let both = [0, 1].map(|n| who[n].is_some() || self.state[n] != origin[n]);
        let far = (0..2)
            .map(|n| self.state[n].wrist().distance(origin[n].wrist()))
            .fold(0.0, f64::max);
        let usual = if pace == Pace::Lax {
            self.signer.language.time_return
        } else {
            self.signer.language.time_straight
        };
        let end = time
            + self
                .signer
                .timed(usual * self.signer.slower(&motion.manner), far, env);
        for n in 0..2 {
            if both[n] {
                let used = self.state[n].used;
                self.go(n, &origin[n].clone(), time, end, pace);
                self.state[n].used = used;
                let kind = if pace == Pace::Lax {
                    PhaseKind::Transition
                } else {
                    PhaseKind::Stroke
                };
                self.phase(n, kind, time, end, "back");
            }
        }
        end
    }

    pub(super) fn bounce(&mut self, who: Who, from: f64, end: f64) -> f64 {
        let l = self.signer.language;
        let mut to = end;
        for (n, _) in acting(who) {
            let events = self.plan.events[n]
                .iter()
                .filter(|event| event.from >= from - 1e-9);
            let displacement: DVec3 = events
                .map(|event| match &event.act {
                    Act::Move(path) => path.end(),
                    _ => DVec3::ZERO,
                })
                .sum();
            if displacement.length() < 1e-6 {
                continue;
            }
            to = end + l.time_return;
            self.plan.events[n].push(Event {
                from: end,
                to,
                pace: Pace::Linear,
                act: Act::Move(Path::Spring(displacement * -l.bounce)),
            });
        }
        to
    }
}
