//! Finds the target frames of keys by monotone dynamic programming, and the phases that follow from them.

use std::ops::RangeInclusive;

use chereme_motion::InterpolationKind;

/// A key whose target is to be found.
#[derive(Debug, Clone, PartialEq)]
pub struct SoughtKey {
    /// The acoustic start of the key, in seconds.
    pub a1: f64,
    /// For each frame the logarithm of this key's probability; empty as long as there is no recogniser.
    pub log: Vec<f64>,
}

/// Options for finding targets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetOptions {
    /// The largest distance of a target from the start of its key, in seconds.
    pub window: f64,
    /// The least time between two targets, in seconds.
    pub apart: f64,
    /// The usual distance of targets from the start of the key, in seconds.
    pub spread: f64,
}

impl Default for TargetOptions {
    fn default() -> Self {
        Self {
            window: 0.35,
            apart: 0.05,
            spread: 0.2,
        }
    }
}

/// Finds one target frame for each key, in order: probable, slow, and near the start of its sound.
///
/// `speed` has a number for each frame, and `frame_time` is in seconds. Returns nothing if there are too few frames for
/// all keys.
#[must_use]
pub fn find_key_targets(
    keys: &[SoughtKey],
    speed: &[f64],
    frame_time: f64,
    options: &TargetOptions,
) -> Option<Vec<usize>> {
    if keys.is_empty() || speed.is_empty() || frame_time.is_nan() || frame_time <= 0.0 {
        return keys.is_empty().then(Vec::new);
    }
    let mut sorted: Vec<f64> = speed.iter().copied().filter(|s| s.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(1.0).max(1e-9);
    let apart = (options.apart / frame_time).ceil() as usize;
    let last = speed.len() - 1;
    let window = |a1: f64| {
        let frame = |time: f64| (time / frame_time).round().clamp(0.0, last as f64) as usize;
        frame(a1 - options.window)..=frame(a1 + options.window)
    };
    let score = |key: &SoughtKey, frame: usize| {
        let log = key.log.get(frame).copied().unwrap_or(0.0).max(-50.0);
        let slow = speed[frame] / median;
        let near = (frame as f64 * frame_time - key.a1) / options.spread;
        let slow = if slow.is_finite() { slow } else { 10.0 };
        log - 0.5 * slow * slow - 0.5 * near * near
    };
    // For each key and each frame of its window: the best sum, and the frame of the previous key in that case.
    let mut table: Vec<(usize, Vec<(f64, usize)>)> = Vec::with_capacity(keys.len());
    for key in keys {
        let frames = window(key.a1);
        let first = *frames.start();
        let mut row = Vec::new();
        let mut best = (f64::NEG_INFINITY, 0);
        let mut seen = 0;
        for frame in frames {
            let frame_score = score(key, frame);
            let Some((start, before)) = table.last() else {
                row.push((frame_score, 0));
                continue;
            };
            // The best frame of the previous key that is early enough; in a tie the first one.
            while seen < before.len() && start + seen + apart <= frame {
                if before[seen].0 > best.0 {
                    best = (before[seen].0, seen);
                }
                seen += 1;
            }
            row.push((frame_score + best.0, best.1));
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
    let mut chosen_frames = vec![0; keys.len()];
    for (n, (first, row)) in table.iter().enumerate().rev() {
        chosen_frames[n] = first + at;
        at = row[at].1;
    }
    Some(chosen_frames)
}

/// A movement from rest to rest, fitted to numbers by frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovementFit {
    /// Its start, in seconds.
    pub start: f64,
    /// Its end, in seconds.
    pub end: f64,
    /// Its length, in the unit of the numbers.
    pub length: f64,
    /// The share of the numbers' variance that it explains, from 0 to 1.
    pub explained: f64,
}

/// The shortest movement that a fit may have, in seconds.
const MIN_FITTED_MOVEMENT_SECONDS: f64 = 0.05;
/// The longest time after the last frame at which a movement may end, in frames.
pub(super) const MAX_END_OVERRUN_FRAMES: f64 = 3.0;
/// The fewest frames to which a movement is fitted.
pub(super) const MIN_FITTED_FRAMES: usize = 6;

/// Fits the minimum-jerk movement that explains most of the change of `row` over some frames, with rest before
///  and after it. A frame without numbers is ignored.
///
/// The two end points of the movement follow from its times by least squares; the times are searched on a grid and
/// refined to a twentieth of a frame. Returns nothing if fewer than six frames have numbers, or if the numbers do not
/// change.
#[must_use]
pub fn fit_movement<'a>(
    row: impl Fn(usize) -> Option<&'a [f64]>,
    frames: RangeInclusive<usize>,
    frame_time: f64,
) -> Option<MovementFit> {
    let rows = |frame| row(frame).map(|row| [row, row]);
    handed_over(rows, frames, frame_time, InterpolationKind::MinimumJerk)
}

/// Fits a movement that one point begins and another ends, as when the middle finger points first and the index finger
/// later: in the course of the movement, the first of the two rows of each frame gives way to the second. The movement
/// has the given course. Otherwise as [`fit_movement`].
#[must_use]
pub fn handed_over<'a>(
    rows: impl Fn(usize) -> Option<[&'a [f64]; 2]>,
    frames: RangeInclusive<usize>,
    frame_time: f64,
    course: InterpolationKind,
) -> Option<MovementFit> {
    let seen: Vec<(f64, [&[f64]; 2])> = frames
        .clone()
        .filter_map(|frame| Some((frame as f64, rows(frame)?)))
        .collect();
    let width = seen.first()?.1[0].len();
    let uneven = |rows: &[&[f64]; 2]| rows.iter().any(|row| row.len() != width);
    if seen.len() < MIN_FITTED_FRAMES || seen.iter().any(|(_, rows)| uneven(rows)) {
        return None;
    }
    let (first, last) = (*frames.start() as f64, *frames.end() as f64 + MAX_END_OVERRUN_FRAMES);
    let shortest = MIN_FITTED_MOVEMENT_SECONDS / frame_time;
    let mut best = (TimedMovementFit::NO_MOVEMENT_FIT, first, last);
    let better = |best: &mut (TimedMovementFit, f64, f64), start: f64, end: f64| {
        if start >= first - 1.0 && end <= last && end - start >= shortest {
            let candidate_fit = TimedMovementFit::fit_timed_movement(&seen, course, start, end);
            if candidate_fit.left < best.0.left {
                *best = (candidate_fit, start, end);
                return true;
            }
        }
        false
    };
    let grid = ((last - first) / 24.0).max(1.0);
    let steps = ((last - first) / grid) as usize;
    for i in 0..=steps {
        for j in i + 1..=steps + 1 {
            let end = (first + j as f64 * grid).min(last);
            better(&mut best, first + i as f64 * grid, end);
        }
    }
    if best.0.left == f64::INFINITY {
        return None;
    }
    let mut step = grid / 2.0;
    while step > 0.05 {
        let (_, start, end) = best;
        let mut moved = false;
        for (a, b) in [
            (1.0, 0.0),
            (-1.0, 0.0),
            (0.0, 1.0),
            (0.0, -1.0),
            (1.0, 1.0),
            (-1.0, -1.0),
            (1.0, -1.0),
            (-1.0, 1.0),
        ] {
            moved |= better(&mut best, start + a * step, end + b * step);
        }
        if !moved {
            step /= 2.0;
        }
    }
    let (fit, start, end) = best;
    Some(MovementFit {
        start: start * frame_time,
        end: end * frame_time,
        length: fit.length,
        explained: (1.0 - fit.left / fit.total).clamp(0.0, 1.0),
    })
}

/// A movement with given times, fitted to frames by least squares.
#[derive(Clone, Copy)]
struct TimedMovementFit {
    /// The sum of squares around the mean.
    total: f64,
    /// The sum of squares that the movement leaves.
    left: f64,
    /// The length of the movement.
    length: f64,
}

impl TimedMovementFit {
    /// No movement.
    const NO_MOVEMENT_FIT: Self = Self {
        total: 0.0,
        left: f64::INFINITY,
        length: 0.0,
    };

    fn fit_timed_movement(seen: &[(f64, [&[f64]; 2])], course: InterpolationKind, start: f64, end: f64) -> Self {
        let width = seen.first().map_or(0, |(_, rows)| rows[0].len());
        let share = |time: f64| course.interpolation_share((time - start) / (end - start));
        let count = seen.len() as f64;
        let shares: Vec<f64> = seen.iter().map(|(time, _)| share(*time)).collect();
        let middle = shares.iter().sum::<f64>() / count;
        let spread: f64 = shares.iter().map(|s| (s - middle) * (s - middle)).sum();
        if spread < 1e-9 {
            return Self::NO_MOVEMENT_FIT;
        }
        let (mut total, mut square) = (0.0, 0.0);
        for k in 0..width {
            let (mut sum, mut squares, mut along) = (0.0, 0.0, 0.0);
            // Numbers count from the first frame, so that far origins cost no precision.
            let origin = seen[0].1[0][k];
            for (share, (_, [before, after])) in shares.iter().zip(seen) {
                let residual = before[k] + (after[k] - before[k]) * share - origin;
                sum += residual;
                squares += residual * residual;
                along += (share - middle) * residual;
            }
            total += squares - sum * sum / count;
            square += along * along;
        }
        if total.is_nan() || total <= 1e-9 {
            return Self::NO_MOVEMENT_FIT;
        }
        Self {
            total,
            left: total - square / spread,
            length: square.sqrt() / spread,
        }
    }
}

/// Median and quartiles of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GestureQuartiles {
    /// The number of values.
    pub n: usize,
    /// The first quartile.
    pub low: f64,
    /// The median.
    pub median: f64,
    /// The third quartile.
    pub high: f64,
}

impl GestureQuartiles {
    /// Returns the quartiles of numbers, interpolated between two values; nothing without numbers.
    #[must_use]
    pub fn quartiles_from_numbers(numbers: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = numbers.iter().copied().filter(|x| x.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let share_value = |share: f64| {
            let place = share * last as f64;
            let first = place.floor() as usize;
            let next = (first + 1).min(last);
            sorted[first] + (sorted[next] - sorted[first]) * place.fract()
        };
        Some(Self {
            n: sorted.len(),
            low: share_value(0.25),
            median: share_value(0.5),
            high: share_value(0.75),
        })
    }
}
