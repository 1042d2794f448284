//! Approaches to movements: as fast as the movement that follows, and steady.

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::ManualPart;

use super::comfort::StanceTrail;
use super::notation_motion::InheritedModifiers;
use super::notation_plan::{ActingHands, HandEvent, HandState, PhaseKind, SignPlan, SignPlanner, iterate_acting_hands};
use super::notation_track::{EventGoalColumns, follow_hand_events};
use super::notation_tuned::tuned;
use super::pace::MovementPace;
use super::stretch_time::MovingArm;

/// The number of steps in which the path of an approach is measured.
const APPROACH_PATH_STEPS: usize = 40;
/// Frames per second at which the movements after an approach are measured.
const APPROACH_SAMPLE_FPS: f64 = 100.0;

/// The course of an approach: with it, the wrist's speed changes at the ends only.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ApproachCourse {
    /// The time at which the approach begins, in seconds.
    pub(crate) from: f64,
    /// The time at which it ends, in seconds.
    pub(crate) to: f64,
    /// The completed share of its acts after equal shares of the wrist's path.
    table: Vec<f64>,
}

impl ApproachCourse {
    /// Returns the completed share of the acts after a share of the wrist's path.
    pub(crate) fn completed_act_share(&self, travelled: f64) -> f64 {
        let last = self.table.len() - 1;
        let position = travelled.clamp(0.0, 1.0) * last as f64;
        let first = (position as usize).min(last - 1);
        self.table[first] + (self.table[first + 1] - self.table[first]) * (position - first as f64)
    }

    /// Returns the course of a wrist on its path, and the length (m) that the path would have at its top speed; `None` if
    /// the wrist hardly moves.
    fn measure_approach_course(path: &EventGoalColumns) -> Option<(Vec<f64>, f64)> {
        let wrists: Vec<DVec3> = path.goal_wrist_positions().collect();
        let wrist_steps = wrists.windows(2).zip(path.turns.windows(2));
        let steps = wrist_steps.map(|(at, turned)| {
            let far = at[0].distance(at[1]);
            (far, far + tuned().approach.lever * turned[0].angle_between(turned[1]))
        });
        let steps: Vec<(f64, f64)> = steps.collect();
        let total_step: f64 = steps.iter().map(|(_, step)| step).sum();
        if total_step < 1e-3 {
            return None;
        }
        let moving_steps = steps.iter().filter(|(_, step)| *step > 1e-9);
        let longest = moving_steps.map(|(far, step)| far / step * total_step);
        let longest = longest.fold(0.0, f64::max);
        let count = steps.len();
        let (mut n, mut before) = (0, 0.0);
        let table = (0..=count).map(|share| {
            let wanted = total_step * share as f64 / count as f64;
            while n + 1 < count && before + steps[n].1 < wanted {
                before += steps[n].1;
                n += 1;
            }
            let within = (wanted - before) / steps[n].1.max(1e-12);
            (n as f64 + within.clamp(0.0, 1.0)) / count as f64
        });
        Some((table.collect(), longest))
    }
}

/// An approach before its time is known.
#[derive(Debug, Default)]
pub(super) struct PlannedApproach {
    /// Its least duration (s), so that no hand is faster than in the movements that follow; 0 if these do not move it.
    pub(super) least: f64,
    tables: [Option<Vec<f64>>; 2],
}

impl PlannedApproach {
    /// Returns the courses of both hands in a time span (s).
    pub(super) fn approach_courses(self, from: f64, to: f64) -> [Option<ApproachCourse>; 2] {
        self.tables
            .map(|table| table.map(|table| ApproachCourse { from, to, table }))
    }
}

/// Returns factors on the durations of the planned steps: hands that make way for the trunk or for each other are faster
/// than planned, and their approaches last longer. `arms` are the solved frames of both hands, `most` is the longest
/// approach (s).
pub(super) fn unhurried_step_factors(
    plan: &SignPlan,
    arms: [Option<&[MovingArm]>; 2],
    rate: f64,
    most: f64,
) -> Vec<f64> {
    let total = arms.iter().flatten().map(|arm| arm.len()).max();
    let mut lasts = vec![1.0_f64; total.unwrap_or(0).saturating_sub(1)];
    for (n, arm) in arms.into_iter().enumerate() {
        let Some(arm) = arm.filter(|arm| arm.len() > 1) else {
            continue;
        };
        let speeds = |from: f64, to: f64| {
            let nearest_frame = |time: f64| ((time * rate).round() as usize).min(arm.len() - 1);
            let steps = nearest_frame(from)..nearest_frame(to);
            steps.map(|step| (step, arm[step].wrist.distance(arm[step + 1].wrist) * rate))
        };
        for (which, course) in plan.courses[n].iter().enumerate() {
            let next = plan.courses[n].get(which + 1).map_or(plan.end, |next| next.from);
            let strokes = plan.phases.iter().filter(|phase| {
                let follows = (course.to - 1e-6..next).contains(&phase.from);
                phase.hand == n && phase.kind == PhaseKind::Stroke && follows
            });
            let stroke_speeds = strokes.flat_map(|phase| speeds(phase.from, phase.to));
            let top = stroke_speeds.map(|(_, speed)| speed).fold(0.0, f64::max) * tuned().approach.solved.0;
            if top < tuned().approach.slowest {
                continue;
            }
            let longer = |top: f64| {
                let steps = speeds(course.from, course.to);
                steps.map(|(_, speed)| (speed / top - 1.0).max(0.0)).sum::<f64>() / rate
            };
            let allowed = (most - (course.to - course.from)).max(tuned().approach.solved.1);
            let mut top = top;
            while longer(top) > allowed {
                top *= 1.03;
            }
            for (step, speed) in speeds(course.from, course.to) {
                lasts[step] = lasts[step].max(speed / top);
            }
        }
    }
    lasts
}

/// Returns the planned frames at which approaches end and signs begin, in ascending order.
pub(super) fn approach_end_frames(plan: &SignPlan, rate: f64) -> Vec<usize> {
    let courses = plan.courses.iter().flatten().map(|course| course.to);
    let signs = plan.signs.iter().map(|sign| sign.from);
    let mut ends: Vec<usize> = courses
        .chain(signs)
        .map(|time| (time * rate).round() as usize)
        .collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

impl SignPlanner<'_> {
    /// Returns the approach of the `named` hands from their states before a part to its goal. It lasts at most as long
    /// as the body language allows.
    pub(super) fn plan_approach(
        &mut self,
        part: &ManualPart,
        [who, named]: [ActingHands; 2],
        [before, goal]: [&[HandState; 2]; 2],
    ) -> PlannedApproach {
        let mut approach = PlannedApproach::default();
        if part.actions.is_empty() || self.trail.is_some() {
            return approach;
        }
        let tops = self.tops(part, who);
        let top = tops.into_iter().fold(0.0, f64::max);
        for (n, _) in iterate_acting_hands(named) {
            let path = self.plan_approach_path(n, &before[n], &goal[n]);
            let Some((table, longest)) = ApproachCourse::measure_approach_course(&path) else {
                continue;
            };
            approach.tables[n] = Some(table);
            let hand_top = if tops[n] > tuned().approach.slowest {
                tops[n]
            } else {
                top
            };
            if hand_top > tuned().approach.slowest {
                let least = MovementPace::Calm.peak_speed_factor() * longest / (tuned().approach.slower * hand_top);
                approach.least = approach.least.max(least);
            }
        }
        approach.least = approach.least.min(self.signer.language.time_approach_most);
        approach
    }

    /// Returns the top speeds (m/s) of both wrists in the movements of a part.
    fn tops(&mut self, part: &ManualPart, who: ActingHands) -> [f64; 2] {
        let event_counts = [0, 1].map(|n| self.plan.events[n].len());
        let start = self.state.clone();
        self.trail = Some(StanceTrail::default());
        let slower = 1.0 / self.sign_speed_factor();
        let (end, events) = self.run_trial_plan(|planner| {
            let mut now = 0.0;
            for action in &part.actions {
                let env = InheritedModifiers {
                    slower,
                    ..InheritedModifiers::default()
                };
                now = planner.plan_motion(action, who, now, &env);
            }
            let events = [0, 1].map(|n| planner.plan.events[n].split_off(event_counts[n]));
            (now, events)
        });
        self.trail = None;
        let total = (end * APPROACH_SAMPLE_FPS).ceil() as usize + 1;
        [0, 1].map(|n| {
            let course = |event: &HandEvent, share: f64| self.signer.paces.pace_path_share(event.pace, share);
            let made = follow_hand_events(&start[n], &events[n], APPROACH_SAMPLE_FPS, total, course);
            let wrists: Vec<DVec3> = made.goal_wrist_positions().collect();
            let lax_events = events[n].iter().filter(|event| event.pace == MovementPace::Lax);
            let lax: Vec<(f64, f64)> = lax_events.map(|event| (event.from, event.to)).collect();
            let steps = wrists.windows(2).enumerate().filter(|(step, _)| {
                let time = (*step as f64 + 0.5) / APPROACH_SAMPLE_FPS;
                !lax.iter().any(|(from, to)| (*from..*to).contains(&time))
            });
            let speeds = steps.map(|(_, two)| two[0].distance(two[1]) * APPROACH_SAMPLE_FPS);
            speeds.fold(0.0, f64::max)
        })
    }

    /// Returns the path of a hand from one state to another, in [`APPROACH_PATH_STEPS`] equal shares of its acts.
    fn plan_approach_path(&mut self, n: usize, before: &HandState, goal: &HandState) -> EventGoalColumns {
        let event_count = self.plan.events[n].len();
        let now = std::mem::replace(&mut self.state[n], before.clone());
        self.bend_transition_path(n, goal, 0.0, 1.0, MovementPace::Calm);
        self.travel_to_goal(n, goal, 0.0, 1.0, MovementPace::Calm);
        let events = self.plan.events[n].split_off(event_count);
        self.state[n] = now;
        follow_hand_events(
            before,
            &events,
            APPROACH_PATH_STEPS as f64,
            APPROACH_PATH_STEPS + 1,
            |_, share| share,
        )
    }
}

#[cfg(test)]
mod tests {
    use chereme_motion::glam::DQuat;

    use super::*;

    #[test]
    fn a_wrist_that_would_hurry_over_half_of_its_path_moves_steadily() {
        let wrist = |n: usize| DVec3::X * if n < 20 { 0.0 } else { 0.02 * (n - 20) as f64 };
        let path = EventGoalColumns {
            points: (0..=40).map(wrist).collect(),
            turns: vec![DQuat::IDENTITY; 41],
            leans: vec![DQuat::IDENTITY; 41],
            offsets: vec![DVec3::ZERO; 41],
            wrist: vec![None; 41],
            transitions: Vec::new(),
        };
        let (table, longest) = ApproachCourse::measure_approach_course(&path).expect("it moves");
        assert!((longest - 0.4).abs() < 1e-9, "{longest}");
        let course = ApproachCourse {
            from: 0.0,
            to: 1.0,
            table,
        };
        for travelled in [0.1, 0.5, 0.9] {
            let share = course.completed_act_share(travelled);
            assert!((share - 0.5 - travelled / 2.0).abs() < 1e-6, "{travelled}: {share}");
        }
        assert_eq!(course.completed_act_share(1.0), 1.0);
    }

    #[test]
    fn a_wrist_that_stays_gets_no_speed_profile() {
        let path = EventGoalColumns {
            points: vec![DVec3::ONE; 41],
            turns: vec![DQuat::IDENTITY; 41],
            leans: vec![DQuat::IDENTITY; 41],
            offsets: vec![DVec3::ZERO; 41],
            wrist: vec![None; 41],
            transitions: Vec::new(),
        };
        assert!(ApproachCourse::measure_approach_course(&path).is_none());
    }
}
