//! Synchronises two signals of one event: finds the shift at which they are most similar.

/// A signal with gaps, by time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimedSignal {
    /// Times in seconds, rising, each with the value at that time.
    pub points: Vec<(f64, f64)>,
}

/// The shift of one signal onto another, with its confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignalShift {
    /// Seconds to add to the times of the second signal.
    pub seconds: f64,
    /// The correlation at that shift, at most 1.
    pub correlation: f64,
    /// The best correlation of shifts that differ by more than [`DISTINCT_SHIFT_SECONDS`] seconds.
    pub runner_up: f64,
}

impl SignalShift {
    /// Returns the confidence in the shift, from 0 to 1: the correlation, less if another shift fits
    /// nearly as well.
    #[must_use]
    pub fn shift_confidence(&self) -> f64 {
        let ahead = (self.correlation - self.runner_up.max(0.0)) / CLEAR_CORRELATION_LEAD;
        self.correlation.clamp(0.0, 1.0) * ahead.clamp(0.0, 1.0)
    }
}

/// Shifts that differ by less than this (s) count as the same.
pub const DISTINCT_SHIFT_SECONDS: f64 = 0.3;
/// A lead of the best correlation over the runner-up that leaves no doubt.
const CLEAR_CORRELATION_LEAD: f64 = 0.25;
/// The time between samples, in seconds, if the signals are short enough.
const SIGNAL_STEP_SECONDS: f64 = 0.01;
/// Largest product of samples and shifts to compute.
const MOST_WORK: f64 = 4e8;
/// Signals must share this many seconds, or half of the shorter one if that is less ...
const MIN_SHARED_SECONDS: f64 = 2.0;
/// ... and at least this share of the shorter one.
const MIN_SHARED_RATIO: f64 = 0.4;
/// A pause between two points that is longer than this is a gap, in seconds.
const SIGNAL_GAP_SECONDS: f64 = 0.25;

/// Returns the shift within `limit` seconds at which `second` is most similar to `first`; `None` if they share too
/// little or one of them never changes.
#[must_use]
pub fn find_signal_shift(first: &TimedSignal, second: &TimedSignal, limit: f64) -> Option<SignalShift> {
    let length = |signal: &TimedSignal| Some(signal.points.last()?.0 - signal.points.first()?.0);
    let (a, b) = (length(first)?, length(second)?);
    // A larger shift leaves no time that both signals cover.
    let limit = limit.clamp(0.0, a.max(b) + MIN_SHARED_SECONDS);
    let work = |step: f64| (a / step) * (2.0 * limit / step);
    let mut step = SIGNAL_STEP_SECONDS;
    while work(step) > MOST_WORK {
        step *= 2.0;
    }
    let start = first.points.first()?.0;
    let left = first.resample_signal(start, step);
    let right = second.resample_signal(second.points.first()?.0, step);
    let between = second.points.first()?.0 - start;
    let shorter = a.min(b);
    let least_seconds = MIN_SHARED_SECONDS.min(shorter / 2.0).max(shorter * MIN_SHARED_RATIO);
    // A correlation of fewer than eight samples says nothing.
    let least = (least_seconds / step).max(8.0) as usize;
    let reach = (limit / step).round() as i64;
    // Sample `n` of the second signal meets sample `n + lag` of the first.
    let base = (between / step).round() as i64;
    let lags: Vec<i64> = (base - reach..=base + reach).collect();
    let all: Vec<f64> = lags
        .iter()
        // A shift with too little shared time cannot win.
        .map(|lag| lagged_correlation(&left, &right, *lag, least).unwrap_or(-1.0))
        .collect();
    let best = (0..all.len()).max_by(|a, b| all[*a].total_cmp(&all[*b]))?;
    if all[best] <= -1.0 {
        return None;
    }
    let apart = (DISTINCT_SHIFT_SECONDS / step).ceil() as usize;
    let others = all.iter().enumerate();
    let runner_up = others
        .filter(|(at, _)| at.abs_diff(best) > apart)
        .map(|(_, value)| *value)
        .fold(-1.0, f64::max);
    let peak = lags[best] as f64 + summit(&all, best);
    Some(SignalShift {
        seconds: peak * step - between,
        correlation: all[best],
        runner_up,
    })
}

/// Returns the offset of the vertex of a parabola through a value and its neighbours.
fn summit(all: &[f64], at: usize) -> f64 {
    let Some((before, after)) = at
        .checked_sub(1)
        .and_then(|previous| Some((all[previous], *all.get(at + 1)?)))
    else {
        return 0.0;
    };
    let bend = before - 2.0 * all[at] + after;
    // A neighbour without a correlation, or no maximum at all, leaves nothing to interpolate.
    if before <= -1.0 || after <= -1.0 || bend >= 0.0 {
        return 0.0;
    }
    ((before - after) / (2.0 * bend)).clamp(-0.5, 0.5)
}

impl TimedSignal {
    /// Returns values at an even step, `None` in gaps.
    fn resample_signal(&self, start: f64, step: f64) -> Vec<Option<f64>> {
        let end = self.points.last().map_or(start, |(time, _)| *time);
        let count = ((end - start) / step).floor() as usize + 1;
        let mut next = 0;
        let value = |n| {
            let time = start + n as f64 * step;
            while self.points.get(next + 1).is_some_and(|(at, _)| *at <= time) {
                next += 1;
            }
            let (from, a) = *self.points.get(next)?;
            let Some(&(to, b)) = self.points.get(next + 1) else {
                // The last point holds for one step.
                return (time - from <= step).then_some(a);
            };
            if to - from > SIGNAL_GAP_SECONDS {
                return None;
            }
            let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
            Some(a + (b - a) * share)
        };
        (0..count).map(value).collect()
    }
}

/// Returns the correlation of the matching samples if the second signal is `lag` samples later.
fn lagged_correlation(first: &[Option<f64>], second: &[Option<f64>], lag: i64, least: usize) -> Option<f64> {
    let from = usize::try_from(lag.max(0)).ok()?;
    let skip = usize::try_from((-lag).max(0)).ok()?;
    let pairs = first.get(from..)?.iter().zip(second.get(skip..)?);
    let (mut n, mut a, mut b, mut aa, mut bb, mut ab) = (0usize, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (x, y) in pairs {
        if let (Some(x), Some(y)) = (x, y) {
            n += 1;
            a += x;
            b += y;
            aa += x * x;
            bb += y * y;
            ab += x * y;
        }
    }
    if n < least {
        return None;
    }
    let n = n as f64;
    let spread = |sum: f64, squares: f64| (squares - sum * sum / n).max(0.0);
    let (own, other) = (spread(a, aa), spread(b, bb));
    let scale = (own * other).sqrt();
    // The spread of a signal that never changes is rounding.
    let flat = own <= 1e-12 * aa || other <= 1e-12 * bb;
    (!flat && scale > 0.0).then(|| (ab - a * b / n) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Movement without a period: a few bumps at times of their own.
    fn event(time: f64) -> f64 {
        [
            (1.0, 0.2),
            (2.3, 0.35),
            (3.1, 0.15),
            (5.2, 0.4),
            (6.05, 0.2),
            (8.4, 0.3),
        ]
        .iter()
        .map(|(at, width): &(f64, f64)| (-((time - at) / width).powi(2)).exp())
        .sum()
    }

    fn seen(from: f64, to: f64, rate: f64, clock: f64, factor: f64) -> TimedSignal {
        let count = ((to - from) * rate) as usize;
        let point = |n: usize| {
            let time = from + n as f64 / rate;
            (time - clock, event(time) * factor + 0.1)
        };
        TimedSignal {
            points: (0..count).map(point).collect(),
        }
    }

    #[test]
    fn one_event_on_two_clocks_is_aligned_to_a_few_milliseconds() {
        let first = seen(0.0, 10.0, 120.0, 0.0, 1.0);
        for (from, to, clock) in [(0.0, 9.5, 0.48), (0.5, 7.0, -1.25), (0.0, 10.0, 0.0)] {
            let second = seen(from, to, 29.97, clock, 300.0);
            let found = find_signal_shift(&first, &second, 5.0).expect("a shift");
            assert!((found.seconds - clock).abs() < 0.006, "{found:?} {clock}");
            assert!(found.correlation > 0.97 && found.shift_confidence() > 0.7, "{found:?}");
        }
    }

    #[test]
    fn gaps_are_ignored_and_a_periodic_signal_gets_low_confidence() {
        let first = seen(0.0, 10.0, 100.0, 0.0, 1.0);
        let mut holes = seen(0.0, 10.0, 50.0, 0.3, 1.0);
        holes.points.retain(|(time, _)| !(2.0..2.9).contains(time));
        let found = find_signal_shift(&first, &holes, 2.0).expect("a shift");
        assert!((found.seconds - 0.3).abs() < 0.006, "{found:?}");
        let wave = TimedSignal {
            points: (0..1000)
                .map(|n| (f64::from(n) / 100.0, (f64::from(n) / 16.0).sin()))
                .collect(),
        };
        let found = find_signal_shift(&wave, &wave, 4.0).expect("a shift");
        assert!(found.shift_confidence() < 0.1, "{found:?}");
    }

    #[test]
    fn constant_empty_and_very_short_signals_have_no_shift() {
        let still = TimedSignal {
            points: (0..500).map(|n| (f64::from(n) / 100.0, 3.0)).collect(),
        };
        let moving = seen(0.0, 5.0, 100.0, 0.0, 1.0);
        assert_eq!(find_signal_shift(&still, &moving, 1.0), None);
        assert_eq!(find_signal_shift(&TimedSignal::default(), &moving, 1.0), None);
        let short = TimedSignal {
            points: vec![(0.0, 1.0), (0.01, 2.0)],
        };
        assert_eq!(find_signal_shift(&short, &moving, 1.0), None);
    }
}
