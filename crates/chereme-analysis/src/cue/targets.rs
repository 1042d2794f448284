//! The frames at which keys are shown, found by monotone dynamic programming, and the phases that follow.

use chereme_motion::Interpolation;

/// A key whose target is looked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Sought {
    /// The acoustic start of the key, in seconds.
    pub a1: f64,
    /// For each frame the log of the probability of this key; empty before a recogniser is there.
    pub log: Vec<f64>,
}

/// How targets are looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetOptions {
    /// The farthest a target may be from the start of its key, in seconds.
    pub window: f64,
    /// The least time between two targets, in seconds.
    pub apart: f64,
    /// How far from the start of the key targets usually are, in seconds.
    pub spread: f64,
    /// The share of the peak speed below which the hand has arrived.
    pub still: f64,
}

impl Default for TargetOptions {
    fn default() -> Self {
        Self {
            window: 0.35,
            apart: 0.05,
            spread: 0.2,
            still: 0.1,
        }
    }
}

/// Finds one frame a key, in order: probable, slow, and near the start of its sound.
///
/// `speed` has a number a frame, `frame_time` is in seconds. Nothing if the frames have no room for all keys.
#[must_use]
pub fn targets(
    keys: &[Sought],
    speed: &[f64],
    frame_time: f64,
    options: &TargetOptions,
) -> Option<Vec<usize>> {
    if keys.is_empty() || speed.is_empty() || frame_time.is_nan() || frame_time <= 0.0 {
        return keys.is_empty().then(Vec::new);
    }
    let mut sorted: Vec<f64> = speed.iter().copied().filter(|s| s.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted
        .get(sorted.len() / 2)
        .copied()
        .unwrap_or(1.0)
        .max(1e-9);
    let apart = (options.apart / frame_time).ceil() as usize;
    let last = speed.len() - 1;
    let window = |a1: f64| {
        let frame = |time: f64| (time / frame_time).round().clamp(0.0, last as f64) as usize;
        frame(a1 - options.window)..=frame(a1 + options.window)
    };
    let score = |key: &Sought, frame: usize| {
        let log = key.log.get(frame).copied().unwrap_or(0.0).max(-50.0);
        let slow = speed[frame] / median;
        let near = (frame as f64 * frame_time - key.a1) / options.spread;
        let slow = if slow.is_finite() { slow } else { 10.0 };
        log - 0.5 * slow * slow - 0.5 * near * near
    };
    // For each key: for each frame of its window, the best sum and where the key before is then.
    let mut table: Vec<(usize, Vec<(f64, usize)>)> = Vec::with_capacity(keys.len());
    for key in keys {
        let frames = window(key.a1);
        let first = *frames.start();
        let mut row = Vec::new();
        let mut best = (f64::NEG_INFINITY, 0);
        let mut seen = 0;
        for frame in frames {
            let own = score(key, frame);
            let Some((start, before)) = table.last() else {
                row.push((own, 0));
                continue;
            };
            // The best of the key before that is early enough; the first of equals.
            while seen < before.len() && start + seen + apart <= frame {
                if before[seen].0 > best.0 {
                    best = (before[seen].0, seen);
                }
                seen += 1;
            }
            row.push((own + best.0, best.1));
        }
        table.push((first, row));
    }
    let (_, ends) = table.last()?;
    let (mut at, sum) = ends
        .iter()
        .enumerate()
        .map(|(n, (sum, _))| (n, *sum))
        .reduce(|best, next| if next.1 > best.1 { next } else { best })?;
    if sum == f64::NEG_INFINITY {
        return None;
    }
    let mut found = vec![0; keys.len()];
    for (n, (first, row)) in table.iter().enumerate().rev() {
        found[n] = first + at;
        at = row[at].1;
    }
    Some(found)
}

/// Returns when the hand arrives at a target, in seconds: the first moment after the peak of speed since the key
/// before at which it is nearly still, the bias of that share on a minimum-jerk way added back.
#[must_use]
pub fn arrival(speed: &[f64], before: usize, target: usize, frame_time: f64, still: f64) -> f64 {
    let end = (target + 1).min(speed.len());
    let start = before.min(end.saturating_sub(1));
    let Some((peak_at, peak)) = (start..end)
        .map(|frame| (frame, speed[frame]))
        .reduce(|best, next| if next.1 > best.1 { next } else { best })
    else {
        return target as f64 * frame_time;
    };
    let limit = still * peak;
    let after = peak_at..speed.len().min(target + 1 + ((0.2 / frame_time) as usize));
    let Some(frame) = after.clone().find(|frame| speed[*frame] < limit) else {
        return target as f64 * frame_time;
    };
    let (early, late) = (speed[frame.saturating_sub(1)], speed[frame]);
    let part = if early > late {
        (early - limit) / (early - late)
    } else {
        1.0
    };
    let crossed = (frame as f64 - 1.0 + part) * frame_time;
    // From the peak, at half of its time, to the crossing is a fixed share of the whole way.
    let share = crossing(still);
    let length = (crossed - peak_at as f64 * frame_time) / (share - 0.5);
    crossed + (1.0 - share) * length
}

/// Returns the share of the time of a minimum-jerk way at which its speed falls below `still` of its peak.
fn crossing(still: f64) -> f64 {
    let speed = |w: f64| {
        let h = 1e-4;
        let course = Interpolation::MinimumJerk;
        (course.share(w + h) - course.share(w - h)) / (2.0 * h)
    };
    let peak = speed(0.5);
    let (mut low, mut high) = (0.5, 1.0 - 1e-4);
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if speed(middle) > still * peak {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low + high) / 2.0
}

/// Median and quartiles of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quartiles {
    /// How many.
    pub n: usize,
    /// A quarter lies below this.
    pub low: f64,
    /// Half lies below this.
    pub median: f64,
    /// Three quarters lie below this.
    pub high: f64,
}

impl Quartiles {
    /// Returns those of numbers; nothing without numbers. Between two numbers they are interpolated.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = numbers.iter().copied().filter(|x| x.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |share: f64| {
            let place = share * last as f64;
            let first = place.floor() as usize;
            let next = (first + 1).min(last);
            sorted[first] + (sorted[next] - sorted[first]) * place.fract()
        };
        Some(Self {
            n: sorted.len(),
            low: at(0.25),
            median: at(0.5),
            high: at(0.75),
        })
    }
}
