//! Stretches time if an arm would move faster than people do.

use super::notation_tuned::tuned;
use chereme_motion::glam::{DQuat, DVec3};

/// Top speeds of arms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TopArmSpeeds {
    /// The top speed of a joint, in radians per second.
    pub(crate) joint: f64,
    /// The top speed of a wrist, in metres per second.
    pub(crate) wrist: f64,
}

/// The moving parts of an arm: positions of wrist and elbow, and rotations in model space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingArm {
    pub(crate) wrist: DVec3,
    pub(crate) elbow: DVec3,
    pub(crate) turned: [DQuat; 3],
    /// Local rotations of its joints.
    pub(crate) local: [DQuat; 4],
}

impl MovingArm {
    /// Returns whether wrist and bones are the same in both frames.
    fn has_same_arm(&self, next: &Self) -> bool {
        self.wrist == next.wrist && self.turned == next.turned
    }
}

/// A map of planned to stretched time: the time of each planned frame, in seconds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimeWarp {
    times: Vec<f64>,
    rate: f64,
    fastest: TopArmSpeeds,
}

impl TimeWarp {
    /// Returns the map that keeps arms at `rate` frames per second within the allowed speeds.
    ///
    /// Each step lasts as long as its fastest part needs; steps next to a stretched one last longer, too,
    /// so that no movement brakes suddenly. Each step lasts at least as long as its factor in `least`, and the planned frames of
    /// `anchors`, in ascending order, remain frames. `hasty(arm, frame)` returns the rotation (rad) of a joint and
    /// the distance (m) of a wrist until the next frame, extrapolated from the fastest part of the step.
    pub(crate) fn warp_within_speeds(
        arms: &[impl AsRef<[MovingArm]>],
        rate: f64,
        fastest: &TopArmSpeeds,
        least: Vec<f64>,
        anchors: &[usize],
        hasty: impl Fn(usize, usize) -> [f64; 2],
    ) -> Self {
        let arms: Vec<&[MovingArm]> = arms.iter().map(AsRef::as_ref).collect();
        let total = arms.iter().map(|arm| arm.len()).max().unwrap_or(0);
        let mut lasts = least;
        lasts.resize(total.saturating_sub(1), 1.0);
        for (which, arm) in arms.iter().enumerate() {
            for (n, pair) in arm.windows(2).enumerate() {
                let [a, b] = [&pair[0], &pair[1]];
                if a.has_same_arm(b) {
                    continue;
                }
                let travel = a.wrist.distance(b.wrist) * rate / fastest.wrist;
                let turn_pairs = a.turned.iter().zip(b.turned);
                let turn = turn_pairs
                    .map(|(a, b)| a.angle_between(b) * rate / fastest.joint)
                    .fold(0.0, f64::max);
                let mut last = travel.max(turn);
                if last > 1.0 {
                    // Joints interpolate each on its own between the two frames.
                    let each = a.local.iter().zip(b.local);
                    let sum: f64 = each.map(|(a, b)| a.angle_between(b)).sum();
                    last = (1.2 * turn).max(1.6 * travel).max(sum * rate / fastest.joint);
                    let needed = needed_step_factor(hasty(which, n), rate, fastest);
                    if needed < tuned().tempo.longer * last {
                        last = last.max(needed);
                    }
                }
                lasts[n] = lasts[n].max(last);
            }
        }
        for arm in arms {
            slow(arm, rate, &mut lasts);
        }
        Self::lasting(&lasts, anchors, rate, fastest)
    }

    /// Returns the map that keeps finished frames within the allowed speeds, if a joint was faster within
    /// a step than its two frames showed.
    pub(crate) fn warp_finished_frames(arms: &[Vec<MovingArm>], rate: f64, fastest: &TopArmSpeeds) -> Self {
        let total = arms.iter().map(Vec::len).max().unwrap_or(0);
        let mut lasts = vec![1.0_f64; total.saturating_sub(1)];
        for arm in arms {
            for (last, pair) in lasts.iter_mut().zip(arm.windows(2)) {
                if pair[0].has_same_arm(&pair[1]) {
                    continue;
                }
                let travel = pair[0].wrist.distance(pair[1].wrist) * rate / fastest.wrist;
                let turn_pairs = pair[0].turned.iter().zip(pair[1].turned);
                let turns = turn_pairs.map(|(a, b)| a.angle_between(b));
                let turn = turns.fold(0.0, f64::max) * rate / fastest.joint;
                if travel.max(turn) > 1.0 {
                    *last = last.max(1.2 * travel.max(turn));
                }
            }
        }
        Self::lasting(&lasts, &[], rate, fastest)
    }

    /// Returns the map with these factors on each step's duration; neighbouring steps are stretched, too.
    ///
    /// Stretched time has a frame at each planned frame of `anchors`, in ascending order.
    fn lasting(lasts: &[f64], anchors: &[usize], rate: f64, fastest: &TopArmSpeeds) -> Self {
        let around = ((0.025 * rate).ceil() as usize).max(1);
        let mut eased: Vec<f64> = (0..lasts.len())
            .map(|n| {
                let near = n.saturating_sub(around)..(n + around + 1).min(lasts.len());
                let slope = |m: usize| {
                    let far = n.abs_diff(m) as f64 / (around + 1) as f64;
                    1.0 + (lasts[m].min(2.5) - 1.0) * (1.0 - far)
                };
                near.map(slope).fold(lasts[n], f64::max)
            })
            .collect();
        let mut from = 0;
        for &to in anchors.iter().filter(|&&to| to <= lasts.len()) {
            let steps = &mut eased[from..to];
            let more: f64 = steps.iter().map(|last| last - 1.0).sum();
            if more > 1e-9 {
                let whole_steps = (more - 1e-6).ceil();
                for last in steps {
                    *last = 1.0 + (*last - 1.0) * (whole_steps / more);
                }
            }
            from = to;
        }
        let mut now = 0.0;
        let mut times = vec![0.0];
        for last in eased {
            now += last / rate;
            times.push(now);
        }
        Self {
            times,
            rate,
            fastest: *fastest,
        }
    }

    /// Returns the composition of this map with the next one.
    pub(crate) fn compose_warps(mut self, next: &Self) -> Self {
        for time in &mut self.times {
            *time = next.stretched_time_at(*time);
        }
        self
    }

    /// Returns the frames per second.
    pub(crate) fn warp_frame_rate(&self) -> f64 {
        self.rate
    }

    /// Returns whether a step lasts long enough for its fastest part.
    pub(crate) fn allows_step_duration(&self, n: usize, hasty: [f64; 2]) -> bool {
        let lasts = (self.times[n + 1] - self.times[n]) * self.rate;
        needed_step_factor(hasty, self.rate, &self.fastest) <= lasts * (1.0 + 1e-9)
    }

    /// Returns whether no time is stretched.
    pub(crate) fn is_none(&self) -> bool {
        let last = self.times.len() - 1;
        (self.times[last] - last as f64 / self.rate).abs() < 1e-9
    }

    /// Returns the stretched time of a planned time, in seconds.
    pub(crate) fn stretched_time_at(&self, planned: f64) -> f64 {
        let frame = (planned * self.rate).max(0.0);
        let last = self.times.len() - 1;
        let n = (frame as usize).min(last);
        if n == last {
            return self.times[last] + (frame - last as f64) / self.rate;
        }
        self.times[n] + (self.times[n + 1] - self.times[n]) * (frame - n as f64)
    }

    /// Returns for each frame of stretched time the planned frame before it and the share of the step to
    /// the next.
    pub(crate) fn stretched_frames(&self) -> Vec<(usize, f64)> {
        let last = self.times.len() - 1;
        let total = (self.times[last] * self.rate - 1e-9).ceil().max(0.0) as usize + 1;
        let mut n = 0;
        (0..total)
            .map(|frame| {
                let time = frame as f64 / self.rate;
                while n + 1 < last && self.times[n + 1] <= time {
                    n += 1;
                }
                if last == 0 || time >= self.times[last] {
                    return (last, 0.0);
                }
                let share = (time - self.times[n]) / (self.times[n + 1] - self.times[n]);
                (n, share.clamp(0.0, 1.0))
            })
            .collect()
    }
}

/// Returns the factor on a step's duration for a rotation (rad) of a joint and a distance (m) of the
/// wrist.
fn needed_step_factor([turn, travel]: [f64; 2], rate: f64, fastest: &TopArmSpeeds) -> f64 {
    (turn * rate / fastest.joint).max(travel * rate / fastest.wrist)
}

/// Stretches steps in which a wrist or an elbow accelerates too much, measured over a sixtieth of a second
/// to either side.
fn slow(arm: &[MovingArm], rate: f64, lasts: &mut [f64]) {
    let step = ((rate / 60.0).round() as usize).max(1);
    let seconds = step as f64 / rate;
    for n in step..arm.len().saturating_sub(step) {
        let pull = |at: fn(&MovingArm) -> DVec3| {
            let [a, b, c] = [n - step, n, n + step].map(|n| at(&arm[n]));
            (a - b * 2.0 + c).length() / (seconds * seconds)
        };
        let hard = pull(|moved| moved.wrist).max(pull(|moved| moved.elbow)) / tuned().tempo.hardest;
        if hard > 1.0 {
            for last in &mut lasts[n - step..n + step] {
                *last = last.max(hard.min(2.5));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FASTEST: TopArmSpeeds = TopArmSpeeds {
        joint: 40.0,
        wrist: 5.0,
    };

    fn along(places: &[f64]) -> Vec<MovingArm> {
        let at = |x: &f64| MovingArm {
            wrist: DVec3::X * *x,
            elbow: DVec3::ZERO,
            turned: [DQuat::IDENTITY; 3],
            local: [DQuat::IDENTITY; 4],
        };
        places.iter().map(at).collect()
    }

    #[test]
    fn slow_arms_are_not_stretched() {
        let warp = TimeWarp::warp_within_speeds(
            &[along(&[0.0, 0.01, 0.02, 0.02])],
            100.0,
            &FASTEST,
            Vec::new(),
            &[],
            |_, _| [0.0; 2],
        );
        assert!(warp.is_none());
        assert_eq!(warp.stretched_frames().len(), 4);
        assert!((warp.stretched_time_at(0.025) - 0.025).abs() < 1e-12);
    }

    #[test]
    fn an_instant_jump_takes_the_least_possible_time() {
        let mut places = vec![0.0; 20];
        places.extend(vec![0.5; 20]);
        let warp = TimeWarp::warp_within_speeds(&[along(&places)], 100.0, &FASTEST, Vec::new(), &[], |_, _| [0.0; 2]);
        assert!(
            (warp.stretched_time_at(0.2) - warp.stretched_time_at(0.19) - 0.16).abs() < 1e-12,
            "0.5 m at 5 m/s, and the bow about the joints"
        );
        let frames = warp.stretched_frames();
        let at = |(n, share): (usize, f64)| {
            let next = places[(n + 1).min(places.len() - 1)];
            places[n] + (next - places[n]) * share
        };
        for pair in frames.windows(2) {
            assert!((at(pair[1]) - at(pair[0])) * 100.0 <= 5.0 + 1e-9);
        }
        for n in 1..40 {
            assert!(warp.stretched_time_at(f64::from(n) / 100.0) > warp.stretched_time_at(f64::from(n - 1) / 100.0));
        }
    }

    #[test]
    fn steps_last_at_least_the_requested_time() {
        let least = vec![1.0, 2.0, 1.0];
        let still = [along(&[0.0; 4])];
        let warp = TimeWarp::warp_within_speeds(&still, 100.0, &FASTEST, least, &[3], |_, _| [0.0; 2]);
        assert!(warp.stretched_time_at(0.02) - warp.stretched_time_at(0.01) >= 0.02 - 1e-12);
        let frames = warp.stretched_time_at(0.03) * 100.0;
        assert!((frames - frames.round()).abs() < 1e-9, "{frames} frames");
    }

    #[test]
    fn finished_frames_that_go_too_fast_are_stretched_again_and_others_are_not() {
        let mut places: Vec<f64> = (0..20).map(|n| 0.04 * f64::from(n)).collect();
        assert!(TimeWarp::warp_finished_frames(&[along(&places)], 100.0, &FASTEST).is_none());
        places.extend((0..20).map(|n| 1.0 + 0.04 * f64::from(n)));
        let warp = TimeWarp::warp_finished_frames(&[along(&places)], 100.0, &FASTEST);
        let at = |&(n, share): &(usize, f64)| {
            let next = places[(n + 1).min(places.len() - 1)];
            places[n] + (next - places[n]) * share
        };
        for pair in warp.stretched_frames().windows(2) {
            assert!((at(&pair[1]) - at(&pair[0])) * 100.0 <= 5.0 + 1e-9);
        }
        let both = warp.clone().compose_warps(&warp);
        assert!((both.stretched_time_at(0.3) - warp.stretched_time_at(warp.stretched_time_at(0.3))).abs() < 0.02);
    }

    #[test]
    fn steps_beside_a_stretched_one_are_stretched_less_and_less() {
        // At 100 frames a second the neighbours within 25 ms, rounded up to three frames, last longer, too.
        let mut least = vec![1.0; 11];
        least[5] = 2.0;
        let still = [along(&[0.0; 12])];
        let warp = TimeWarp::warp_within_speeds(&still, 100.0, &FASTEST, least, &[], |_, _| [0.0; 2]);
        let lasts = [1.0, 1.0, 1.25, 1.5, 1.75, 2.0, 1.75, 1.5, 1.25, 1.0, 1.0];
        let mut now = 0.0;
        for (n, last) in lasts.into_iter().enumerate() {
            assert!((warp.stretched_time_at(0.01 * n as f64) - now).abs() < 1e-9, "step {n}");
            assert!((warp.stretched_time_at(0.01 * (n as f64 + 0.5)) - now - 0.005 * last).abs() < 1e-9);
            now += 0.01 * last;
        }
        assert!(
            (warp.stretched_time_at(0.11) - now).abs() < 1e-9
                && (warp.stretched_time_at(0.21) - now - 0.1).abs() < 1e-9
        );
        assert!(!warp.is_none() && warp.warp_frame_rate() == 100.0);
        // A step of 20 ms allows 0.8 rad at 40 rad/s and 0.1 m at 5 m/s.
        for (hasty, allowed) in [
            ([0.8, 0.0], true),
            ([0.82, 0.0], false),
            ([0.0, 0.1], true),
            ([0.0, 0.102], false),
        ] {
            assert_eq!(warp.allows_step_duration(5, hasty), allowed, "{hasty:?}");
        }
        let frames = warp.stretched_frames();
        assert_eq!(frames.len(), 16, "0.15 s");
        for (frame, (n, share)) in frames.into_iter().enumerate().take(15) {
            let planned = 0.01 * (n as f64 + share);
            assert!(
                (warp.stretched_time_at(planned) - 0.01 * frame as f64).abs() < 1e-9,
                "{frame}"
            );
        }
    }

    #[test]
    fn sudden_stops_are_stretched_by_their_acceleration() {
        // 3 m/s, and a stop within one frame: 300 m/s² at 100 frames a second, four times the most.
        let mut places: Vec<f64> = (0..10).map(|n| 0.03 * f64::from(n)).collect();
        places.extend([0.27; 10]);
        let mut lasts = vec![1.0; 19];
        slow(&along(&places), 100.0, &mut lasts);
        let step = 2;
        for (n, last) in lasts.into_iter().enumerate() {
            let near = (9 - 2 * step + 1..9 + 2 * step - 1).contains(&n);
            assert!(near || last == 1.0, "{n}: {last}");
            if n == 8 || n == 9 {
                // Over two frames to either side: 0.06 m in 20 ms twice.
                let hard = 0.06 / (0.02 * 0.02) / tuned().tempo.hardest;
                assert!((last - hard).abs() < 1e-9, "{n}: {last}, not {hard}");
            }
        }
    }
}
