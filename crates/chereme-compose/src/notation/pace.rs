//! Paces: the progress of a movement over time. The two-level controller of Kennaway, section 4.5, as tables.

use std::sync::LazyLock;

use super::notation_tuned::tuned;
use chereme_sign::hamnosys::{BodyLanguage, MotionManner};

/// The number of steps in a table.
const PACE_TABLE_STEPS: usize = 256;

/// The kinds of pace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MovementPace {
    /// A meaningful movement: late peak, short deceleration.
    Targetted,
    /// A movement without meaning: transitions and returns.
    Lax,
    /// A movement into contact: abrupt stop.
    Contact,
    /// A notated sudden stop.
    Halt,
    /// A tense movement: slow and steady.
    Tense,
    /// A circle: constant speed except at both ends.
    Linear,
    /// An approach to a movement: even, so that it is not faster than the movement that follows.
    Calm,
}

impl MovementPace {
    /// Returns the pace of a movement in a manner.
    pub(crate) fn pace_from_manner(manner: &MotionManner, usual: Self) -> Self {
        if manner.halt {
            Self::Halt
        } else if manner.tense {
            Self::Tense
        } else {
            usual
        }
    }
}

impl MovementPace {
    /// Returns the top speed of a movement, as a multiple of its mean speed.
    pub(crate) fn peak_speed_factor(self) -> f64 {
        match self {
            Self::Targetted => 2.2,
            Self::Contact => 3.6,
            Self::Lax => 1.83,
            Self::Halt => 3.7,
            Self::Tense => 1.43,
            Self::Linear => 1.18,
            Self::Calm => 1.0 / (1.0 - tuned().tempo.calm),
        }
    }
}

/// The pace tables of a body language.
#[derive(Debug, Clone)]
pub(crate) struct PaceTables {
    tables: [Vec<f64>; 7],
}

impl PaceTables {
    pub(crate) fn pace_tables_from_language(language: &BodyLanguage) -> Self {
        static DEFAULT_PACE_TABLES: LazyLock<PaceTables> =
            LazyLock::new(|| PaceTables::computed(BodyLanguage::default_body_language()));
        match language == BodyLanguage::default_body_language() {
            true => DEFAULT_PACE_TABLES.clone(),
            false => Self::computed(language),
        }
    }

    fn computed(language: &BodyLanguage) -> Self {
        let l = language;
        let ramp = linear_pace_table(l.linear_ramp);
        let grown = |gain: f64, power: f64, ratio: f64| {
            if gain == 0.0 {
                linear_pace_table(2.0 * l.linear_ramp)
            } else {
                controlled(gain, power, ratio, 0.0)
            }
        };
        Self {
            tables: [
                grown(l.targetted_gain, l.targetted_power, l.targetted_ratio),
                grown(l.lax_gain, l.lax_power, l.lax_ratio),
                controlled(l.contact_gain, l.contact_power, l.contact_ratio, l.contact_brake),
                grown(l.halt_gain, l.halt_power, l.halt_ratio),
                grown(l.tense_gain, l.tense_power, l.tense_ratio),
                ramp,
                linear_pace_table(tuned().tempo.calm),
            ],
        }
    }

    /// Returns the completed share of the path at the share `time` of the duration.
    pub(crate) fn pace_path_share(&self, pace: MovementPace, time: f64) -> f64 {
        let table = &self.tables[pace as usize];
        let table_position = time.clamp(0.0, 1.0) * PACE_TABLE_STEPS as f64;
        let first = (table_position as usize).min(PACE_TABLE_STEPS - 1);
        table[first] + (table[first + 1] - table[first]) * (table_position - first as f64)
    }
}

/// Runs the controller `x'' = k'(k(1 - x) - x')` with `k = 1 + gain·x^power` and `k' = ratio·k` until it
/// arrives (or comes within 1 %), and scales time and path to 1. Any remaining speed is braked within the
/// share `brake` of the time.
fn controlled(gain: f64, power: f64, ratio: f64, brake: f64) -> Vec<f64> {
    const PACE_SEARCH_STEP: f64 = 1e-3;
    let arrival = if ratio < 4.0 { 1.0 } else { 0.99 };
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    let mut course = vec![0.0];
    while x < arrival && course.len() < 40_000 {
        let push = |x: f64, v: f64| {
            let k = 1.0 + gain * x.clamp(0.0, 1.0).powf(power);
            ratio * k * (k * (1.0 - x) - v)
        };
        let half = (x + v * PACE_SEARCH_STEP / 2.0, v + push(x, v) * PACE_SEARCH_STEP / 2.0);
        x += half.1 * PACE_SEARCH_STEP;
        v += push(half.0, half.1) * PACE_SEARCH_STEP;
        course.push(x);
    }
    let steps = (course.len() as f64 * brake.clamp(0.0, 0.5)) as usize;
    for n in 0..steps {
        x += v * PACE_SEARCH_STEP * (1.0 - (n as f64 + 0.5) / steps as f64);
        course.push(x);
    }
    sample_pace_table(|time| {
        let course_position = time * (course.len() - 1) as f64;
        let first = (course_position as usize).min(course.len() - 2);
        course[first] + (course[first + 1] - course[first]) * (course_position - first as f64)
    })
}

/// Returns a table of constant speed, with smooth ramps over the share `ramp` of the time at both ends.
fn linear_pace_table(ramp: f64) -> Vec<f64> {
    let ramp = ramp.clamp(0.01, 0.5);
    // The integral of a smoothstep is half of its ramp.
    let rise = |t: f64| {
        let u = (t / ramp).clamp(0.0, 1.0);
        ramp * (u * u * u - 0.5 * u * u * u * u) + (t - ramp).max(0.0)
    };
    sample_pace_table(|time| {
        if time <= 0.5 {
            rise(time)
        } else {
            1.0 - ramp - rise(1.0 - time)
        }
    })
}

fn sample_pace_table(at: impl Fn(f64) -> f64) -> Vec<f64> {
    let full_value = at(1.0);
    let mut table: Vec<f64> = (0..=PACE_TABLE_STEPS)
        .map(|n| at(n as f64 / PACE_TABLE_STEPS as f64) / full_value)
        .collect();
    table[0] = 0.0;
    table[PACE_TABLE_STEPS] = 1.0;
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [MovementPace; 7] = [
        MovementPace::Targetted,
        MovementPace::Lax,
        MovementPace::Contact,
        MovementPace::Halt,
        MovementPace::Tense,
        MovementPace::Linear,
        MovementPace::Calm,
    ];

    fn peak(paces: &PaceTables, pace: MovementPace) -> (f64, f64) {
        let speed = |n: usize| {
            let at = |n: usize| paces.pace_path_share(pace, n as f64 / 200.0);
            (at(n + 1) - at(n)) * 200.0
        };
        let best = (0..200).max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
        let at = best.expect("steps");
        ((at as f64 + 0.5) / 200.0, speed(at))
    }

    #[test]
    fn speed_profiles_rise_from_zero_to_one_without_going_back() {
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        for pace in ALL {
            assert_eq!(paces.pace_path_share(pace, 0.0), 0.0, "{pace:?}");
            assert_eq!(paces.pace_path_share(pace, 1.0), 1.0, "{pace:?}");
            let mut before = 0.0;
            for n in 1..=500 {
                let now = paces.pace_path_share(pace, f64::from(n) / 500.0);
                assert!(now >= before - 1e-9, "{pace:?} at {n}");
                before = now;
            }
        }
    }

    #[test]
    fn speed_peaks_agree_with_the_paper_and_the_measured_tables() {
        let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
        let near = |pace: MovementPace, shares: [f64; 3]| {
            for (time, share) in [0.25, 0.5, 0.75].into_iter().zip(shares) {
                let is = paces.pace_path_share(pace, time);
                assert!((is - share).abs() < 0.02, "{pace:?} at {time}: {is}");
            }
        };
        near(MovementPace::Lax, [0.19, 0.62, 0.92]);
        near(MovementPace::Targetted, [0.07, 0.34, 0.84]);
        assert!((peak(&paces, MovementPace::Lax).0 - 0.43).abs() < 0.04);
        assert!((peak(&paces, MovementPace::Targetted).0 - 0.62).abs() < 0.04);
        assert!((peak(&paces, MovementPace::Halt).0 - 0.91).abs() < 0.05);
        let end = (1.0 - paces.pace_path_share(MovementPace::Halt, 0.99)) * 100.0;
        assert!((end - 1.9).abs() < 0.4, "{end}");
        for pace in ALL {
            let (_, top) = peak(&paces, pace);
            assert!((top / pace.peak_speed_factor() - 1.0).abs() < 0.12, "{pace:?}: {top}");
        }
        let even = paces.pace_path_share(MovementPace::Linear, 0.6) - paces.pace_path_share(MovementPace::Linear, 0.4);
        assert!((even - 0.2 / 0.85).abs() < 1e-3, "{even}");
    }
}
