//! The numbers of each frame at 25 Hz from which the linear heads read whether it lies within a sign.
//!
//! `schema/cutting.json` names the numbers and gives their weights; a name such as `D_chg_w10` or `W_sp@-3` says how its
//! number is computed.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::cut_curves::{CURVE_RATE, HandCurve, TakeCurves};
use super::cut_tuned::tuned;
use super::segment_decoder::FrameOdds;

/// The rate of frames in Hz.
pub(super) const FRAME_RATE: f64 = 25.0;
/// The number of samples of the curves for each frame.
const SAMPLES_PER_FRAME: usize = (CURVE_RATE / FRAME_RATE) as usize;
/// Keeps shares of tiny amounts small.
const RELATIVE_FLOOR: f64 = 0.15;
/// The time around a frame that shows which hand is dominant, in frames.
const DOMINANCE_FRAMES: usize = 15;
/// The lags in frames at which a posture can return.
const RETURN_LAGS: std::ops::RangeInclusive<usize> = 2..=23;
/// The least distance of postures between leaving and returning, and the largest number for it.
const RETURN_LIMITS: [f64; 2] = [0.5, 3.0];

/// The kind of a number, before it is shifted in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum NumberKind {
    Height,
    Aside,
    Forward,
    Speed,
    Palm,
    Fingers,
    Elbow,
    Posture,
    Acceleration,
    Rise,
    WristChange(usize),
    PalmChange(usize),
    FingerChange(usize),
    Straightness(usize),
    Way(usize),
    RelativeSpeed(usize),
    RelativePosture(usize),
    ReturnLater,
    ReturnBefore,
}

/// A number of a frame: of which hand, which one, and how many frames later.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FrameNumber {
    is_weak: bool,
    kind: NumberKind,
    shift: isize,
}

impl FrameNumber {
    /// Reads a name such as `D_chg_w10` or `W_sp@-3`.
    fn from_name(name: &str) -> Option<Self> {
        let (hand, rest) = name.split_once('_')?;
        let is_weak = match hand {
            "D" => false,
            "W" => true,
            _ => return None,
        };
        let (base, shift) = match rest.split_once('@') {
            Some((base, shift)) => (base, shift.parse().ok()?),
            None => (rest, 0),
        };
        let letters = base.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let window = base[letters.len()..].parse::<usize>().ok();
        let kind = match (letters, window) {
            ("y", None) => NumberKind::Height,
            ("x", None) => NumberKind::Aside,
            ("z", None) => NumberKind::Forward,
            ("sp", None) => NumberKind::Speed,
            ("pal", None) => NumberKind::Palm,
            ("fi", None) => NumberKind::Fingers,
            ("elb", None) => NumberKind::Elbow,
            ("post", None) => NumberKind::Posture,
            ("acc", None) => NumberKind::Acceleration,
            ("vy", None) => NumberKind::Rise,
            ("chg_w", Some(window)) => NumberKind::WristChange(window),
            ("chg_r", Some(window)) => NumberKind::PalmChange(window),
            ("chg_f", Some(window)) => NumberKind::FingerChange(window),
            ("str", Some(window)) => NumberKind::Straightness(window),
            ("path", Some(window)) => NumberKind::Way(window),
            ("rel", Some(window)) => NumberKind::RelativeSpeed(window),
            ("relp", Some(window)) => NumberKind::RelativePosture(window),
            ("ret_fwd", None) => NumberKind::ReturnLater,
            ("ret_bwd", None) => NumberKind::ReturnBefore,
            _ => return None,
        };
        Some(Self { is_weak, kind, shift })
    }
}

/// A linear head: a bias, and the weight of each number by name.
pub(super) struct LinearHead {
    bias: f64,
    weights: Vec<(String, f64)>,
    prior: f64,
}

impl LinearHead {
    /// Creates the head of a table of weights; `share` is the share of frames of its kind that is taken off, if any.
    pub(super) fn from_weights(weights: &BTreeMap<String, f64>, share: Option<f64>) -> Self {
        let named = weights.iter().filter(|(name, _)| name.as_str() != "bias");
        Self {
            bias: weights.get("bias").copied().unwrap_or(0.0),
            weights: named.map(|(name, weight)| (name.clone(), *weight)).collect(),
            // Without the log odds of its share, the odds of a rare boundary
            // are the evidence of the frame alone.
            prior: share.map_or(0.0, |share| (share / (1.0 - share)).ln()),
        }
    }

    /// Returns the log odds of a frame, given its numbers by name.
    pub(super) fn frame_log_odds(&self, number: impl Fn(usize, &str) -> f64) -> f64 {
        let weighted = self.weights.iter().enumerate();
        let sum: f64 = weighted
            .map(|(place, (name, weight))| weight * number(place, name))
            .sum();
        // One extreme frame must not outweigh a whole sign.
        let limit = tuned().decoder.clip;
        (self.bias + sum).clamp(-limit, limit) - self.prior
    }
}

/// The three heads of the program, with the numbers that they all read.
struct SignHeads {
    numbers: Vec<FrameNumber>,
    heads: [LinearHead; 3],
}

fn sign_heads() -> &'static SignHeads {
    static SIGN_HEADS: LazyLock<SignHeads> = LazyLock::new(|| {
        let weights = &tuned().heads;
        let prior = Some(tuned().decoder.boundary_prior);
        let heads = [
            LinearHead::from_weights(&weights.sign, None),
            LinearHead::from_weights(&weights.begin, prior),
            LinearHead::from_weights(&weights.end, prior),
        ];
        let names = heads[0].weights.iter();
        let numbers =
            names.map(|(name, _)| FrameNumber::from_name(name).expect("the program's own file names numbers"));
        SignHeads {
            numbers: numbers.collect(),
            heads,
        }
    });
    &SIGN_HEADS
}

/// The numbers of each frame of a take, 25 a second, from which heads are learned.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameNumberTable {
    /// The names of the numbers.
    pub names: Vec<String>,
    /// The numbers of each frame.
    pub rows: Vec<Vec<f64>>,
}

impl FrameNumberTable {
    pub(super) fn of_curves(curves: &TakeCurves, up: f64) -> Self {
        let model = sign_heads();
        let columns = FrameColumns::new(curves, up);
        let wanted: Vec<Vec<f64>> = model
            .numbers
            .iter()
            .map(|number| columns.number_column(number))
            .collect();
        let row = |frame: usize| wanted.iter().map(|column| column[frame]).collect();
        Self {
            names: model.heads[0].weights.iter().map(|(name, _)| name.clone()).collect(),
            rows: (0..columns.frames).map(row).collect(),
        }
    }
}

/// Returns the log odds of all frames.
pub(super) fn measure_frame_odds(curves: &TakeCurves, up: f64) -> FrameOdds {
    let table = FrameNumberTable::of_curves(curves, up);
    let head_odds = |head: &LinearHead| -> Vec<f64> {
        let rows = table.rows.iter();
        rows.map(|row| head.frame_log_odds(|place, _| row[place])).collect()
    };
    let [sign, begin, end] = sign_heads().heads.each_ref().map(head_odds);
    FrameOdds { sign, begin, end }
}

/// The columns of numbers of a take: those of each hand, and the hand that is dominant in each frame.
struct FrameColumns {
    frames: usize,
    dominant: Vec<usize>,
    hands: [BTreeMap<NumberKind, Vec<f64>>; 2],
}

impl FrameColumns {
    fn new(curves: &TakeCurves, up: f64) -> Self {
        let frames = curves.sample_count().div_ceil(SAMPLES_PER_FRAME);
        let kinds: Vec<NumberKind> = sign_heads().numbers.iter().map(|number| number.kind).collect();
        let hands = curves.hands.each_ref().map(|hand| HandFrames { hand, frames });
        let ways = hands.each_ref().map(|hand| {
            let all: Vec<f64> = (0..frames).map(|frame| hand.posture_speed(frame)).collect();
            running_sums(&all)
        });
        let dominance = |frame: usize| {
            let (first, last) = (
                frame.saturating_sub(DOMINANCE_FRAMES),
                (frame + DOMINANCE_FRAMES + 1).min(frames),
            );
            let is_up = hands.each_ref().map(|hand| hand.height(frame) > up);
            let way = ways.each_ref().map(|sums| sums[last] - sums[first]);
            // A single raised hand signs, however much the other one fidgets.
            match is_up {
                [true, false] => 0,
                [false, true] => 1,
                _ => usize::from(way[1] > way[0]),
            }
        };
        Self {
            frames,
            dominant: (0..frames).map(dominance).collect(),
            hands: hands.each_ref().map(|hand| hand.columns_of_kinds(&kinds)),
        }
    }

    /// Returns the column of a number; shifts end at the ends of the take.
    fn number_column(&self, number: &FrameNumber) -> Vec<f64> {
        let shifted = |frame: usize| {
            let other = frame.saturating_add_signed(number.shift).min(self.frames - 1);
            // The weak hand is the other one of the dominant.
            let hand = self.dominant[other] ^ usize::from(number.is_weak);
            self.hands[hand].get(&number.kind).map_or(0.0, |column| column[other])
        };
        (0..self.frames).map(shifted).collect()
    }
}

/// The frames of one hand.
struct HandFrames<'a> {
    hand: &'a HandCurve,
    frames: usize,
}

impl HandFrames<'_> {
    fn height(&self, frame: usize) -> f64 {
        self.hand.height[frame * SAMPLES_PER_FRAME]
    }

    /// Returns a tenth of the speed of the posture.
    fn posture_speed(&self, frame: usize) -> f64 {
        self.hand.posture_speed[frame * SAMPLES_PER_FRAME] / 10.0
    }

    fn columns_of_kinds(&self, kinds: &[NumberKind]) -> BTreeMap<NumberKind, Vec<f64>> {
        let mut columns = BTreeMap::new();
        for &kind in kinds {
            columns.entry(kind).or_insert_with(|| self.kind_column(kind));
        }
        columns
    }

    fn kind_column(&self, kind: NumberKind) -> Vec<f64> {
        let hand = self.hand;
        let sampled = |curve: &[f64], unit: f64| -> Vec<f64> {
            (0..self.frames)
                .map(|frame| curve[frame * SAMPLES_PER_FRAME] / unit)
                .collect()
        };
        let slope = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let last = hand.height.len() - 1;
            let difference = |frame: usize| {
                let sample = frame * SAMPLES_PER_FRAME;
                let (before, after) = (sample.saturating_sub(1), (sample + 1).min(last));
                (value(after) - value(before)) * CURVE_RATE / (after - before).max(1) as f64
            };
            (0..self.frames).map(difference).collect()
        };
        match kind {
            NumberKind::Height => sampled(&hand.height, 1.0),
            NumberKind::Aside => (0..self.frames).map(|frame| self.place(frame).x.abs()).collect(),
            NumberKind::Forward => (0..self.frames).map(|frame| self.place(frame).z).collect(),
            NumberKind::Speed => sampled(&hand.speed, 1.0),
            NumberKind::Palm => sampled(&hand.palm_speed, 100.0),
            NumberKind::Fingers => sampled(&hand.finger_speed, 100.0),
            NumberKind::Elbow => sampled(&hand.elbow_speed, 1.0),
            NumberKind::Posture => sampled(&hand.posture_speed, 10.0),
            NumberKind::Acceleration => slope(&|sample| hand.speed[sample]),
            NumberKind::Rise => slope(&|sample| hand.places[sample].y),
            NumberKind::WristChange(window) => {
                self.window_column(window, |a, b| hand.places[a].distance(hand.places[b]))
            }
            NumberKind::PalmChange(window) => self.window_column(window, |a, b| hand.palm_change(a, b) / 100.0),
            NumberKind::FingerChange(window) => self.window_column(window, |a, b| hand.finger_change(a, b) / 100.0),
            NumberKind::Straightness(window) => {
                let ways = self.kind_column(NumberKind::Way(window));
                let chords = self.kind_column(NumberKind::WristChange(window));
                let pairs = chords.iter().zip(&ways);
                // The summand keeps a hand that stands still from looking straight by noise.
                pairs.map(|(chord, way)| chord / (way + 0.02)).collect()
            }
            NumberKind::Way(window) => {
                let sums = running_sums(&hand.speed);
                self.window_column(window, |a, b| (sums[b] - sums[a]) / CURVE_RATE)
            }
            NumberKind::RelativeSpeed(window) => relative_column(&sampled(&hand.speed, 1.0), window),
            NumberKind::RelativePosture(window) => relative_column(&sampled(&hand.posture_speed, 10.0), window),
            NumberKind::ReturnLater => self.return_column(|frame, lag| frame.checked_add(lag)),
            NumberKind::ReturnBefore => self.return_column(|frame, lag| frame.checked_sub(lag)),
        }
    }

    fn place(&self, frame: usize) -> glam::DVec3 {
        self.hand.places[frame * SAMPLES_PER_FRAME]
    }

    /// Returns a measure between the ends of a window of so many frames around each frame.
    fn window_column(&self, window: usize, measure: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let half = window / 2;
        let ends = |frame: usize| {
            let (first, last) = (frame.saturating_sub(half), (frame + half).min(self.frames - 1));
            measure(first * SAMPLES_PER_FRAME, last * SAMPLES_PER_FRAME)
        };
        (0..self.frames).map(ends).collect()
    }

    /// Returns how far from its posture in each frame the hand remains when it comes back to it, after it has been away: its
    /// least distance as a share of the greatest.
    fn return_column(&self, other_frame: impl Fn(usize, usize) -> Option<usize>) -> Vec<f64> {
        let [away, most] = RETURN_LIMITS;
        let returned = |frame: usize| {
            let (mut farthest, mut least): (f64, f64) = (0.0, f64::INFINITY);
            for lag in RETURN_LAGS {
                let Some(other) = other_frame(frame, lag).filter(|other| *other < self.frames) else {
                    break;
                };
                let distance = self
                    .hand
                    .posture_distance(frame * SAMPLES_PER_FRAME, other * SAMPLES_PER_FRAME);
                // The hand has to leave before it can return.
                farthest = farthest.max(distance);
                if farthest >= away {
                    least = least.min(distance);
                }
            }
            // The summand keeps small distances small; the limit stands for no return at all.
            (least / (farthest + 0.2)).min(most)
        };
        (0..self.frames).map(returned).collect()
    }
}

/// Returns each number relative to the greatest in a window of so many frames around it.
fn relative_column(column: &[f64], window: usize) -> Vec<f64> {
    let half = window / 2;
    let relative = |frame: usize| {
        let near = &column[frame.saturating_sub(half)..(frame + half + 1).min(column.len())];
        column[frame] / (near.iter().copied().fold(0.0, f64::max) + RELATIVE_FLOOR)
    };
    (0..column.len()).map(relative).collect()
}

/// Returns the sums of the numbers before each, and of all.
fn running_sums(column: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0];
    let mut sum = 0.0;
    for number in column {
        sum += number;
        sums.push(sum);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_numbers_are_read_and_others_are_refused() {
        let number = |name: &str| FrameNumber::from_name(name);
        let expected = FrameNumber {
            is_weak: true,
            kind: NumberKind::Speed,
            shift: -3,
        };
        assert_eq!(number("W_sp@-3"), Some(expected));
        let change = number("D_chg_w10").map(|number| number.kind);
        assert_eq!(change, Some(NumberKind::WristChange(10)));
        for name in ["", "D", "X_y", "D_y@x", "D_y5", "D_chg_w", "D_speed"] {
            assert_eq!(number(name), None, "{name}");
        }
        assert_eq!(sign_heads().numbers.len(), 105);
    }
}
