//! Cuts a take into signs, and the movement of each hand into preparation, stroke, hold and retraction.
//!
//! 1. The curves of both wrists, palms, fingers and elbows are measured in the space of the trunk.
//! 2. *Activities* lie between rests; rest is the commonest still posture of the take.
//! 3. Each activity is *decoded*: 105 numbers of each 40 ms give the log odds that it lies within a sign, that one begins
//!    and that one ends; a semi-Markov model with two states finds the likeliest spans. The cost of a sign is the only number
//!    that a person needs to change: with a larger one there are fewer signs.
//! 4. An activity with one sign is *peeled* instead: the sign lies between the posture that the preparation reaches and the one
//!    that the retraction leaves. This needs no weights, and its boundaries are the better ones.
//! 5. Each hand's movement is divided into phases.
//!
//! A sign begins when its posture is reached, and ends with its last hold. The weights were learned on generated signing;
//! README.md says what they reach, and on what. All numbers lie in `schema/cutting.json`.

mod channel_holds;
mod cut_curves;
mod cut_phases;
mod cut_tuned;
mod frame_numbers;
mod peel;
mod segment_decoder;
#[cfg(test)]
pub(crate) mod tests;

use std::ops::Range;

use chereme_motion::{BodyAnatomy, BodySide, Clip, RecordingInstant, TimeSpan};
use serde::Serialize;

pub use channel_holds::{ChannelPosture, HandChannel, find_channel_postures};
use cut_curves::{CURVE_RATE, TakeCurves};
pub use cut_phases::{HandPhase, PhaseKind};
use cut_tuned::tuned;
pub use frame_numbers::FrameNumberTable;
use frame_numbers::{FRAME_RATE, measure_frame_odds};
use peel::{PeeledSign, RestHeights, WristCurve, peel_activities};
use segment_decoder::FrameOdds;

/// Options of cutting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutOptions {
    /// The cost of a sign: a larger one gives fewer signs.
    pub sign_cost: f64,
}

impl Default for CutOptions {
    fn default() -> Self {
        Self {
            sign_cost: tuned().decoder.cost,
        }
    }
}

impl CutOptions {
    /// Returns the options for so many steps towards more signs (or, if negative, towards fewer).
    #[must_use]
    pub fn with_more_signs(steps: i32) -> Self {
        let usual = Self::default();
        Self {
            sign_cost: usual.sign_cost - f64::from(steps) * tuned().decoder.slider,
        }
    }
}

/// A take that was cut; times are counted from its first frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TakeCut {
    /// The signs, in order of time.
    pub signs: Vec<CutSign>,
    /// The phases of the right hand, then of the left, each in order of time.
    pub phases: [Vec<HandPhase>; 2],
}

/// A sign that was cut out of a take.
#[derive(Debug, Clone, PartialEq)]
pub struct CutSign {
    /// Its time, from the posture that is reached to the end of its last hold.
    pub span: TimeSpan,
    /// The hand that moves more.
    pub dominant: BodySide,
    /// Whether both hands sign.
    pub is_two_handed: bool,
    /// The rule that found it.
    pub rule: CutRule,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
}

/// The rule that found a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CutRule {
    /// It is the only one between two rests.
    Peeled,
    /// It is one of several between two rests.
    Decoded,
}

/// The reason why no sign was found in a take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum UncutReason {
    /// The body has no arm, or no trunk to measure it by.
    #[error("the body has no arms that could be measured; name their joints' roles")]
    NoArms,
    /// No hand moves.
    #[error("no hand moves; there may be a movement in another recording of this take")]
    NoMovement,
    /// Hands move, but stay low.
    #[error("the hands move, but never come up from where they rest; mark the signs by hand")]
    HandsStayLow,
}

/// The least way of a hand in a take with movement, in arm lengths.
const LEAST_WAY: f64 = 0.1;

/// Cuts a take into signs. Odd frames at its ends are left out by the caller, see [`chereme_motion::ends`].
///
/// # Errors
/// [`UncutReason`] if no sign is found.
pub fn cut_take(clip: &Clip, anatomy: &BodyAnatomy, options: CutOptions) -> Result<TakeCut, UncutReason> {
    let curves = TakeCurves::measure_clip(clip, anatomy).ok_or(UncutReason::NoArms)?;
    let wrists = curves.wrist_curves();
    let rest = RestHeights::measure_rest(wrists);
    let activities = peel_activities(wrists, rest);
    if activities.is_empty() {
        // The two remedies differ, so that a still take is distinguished from a low one.
        let way = |hand: &WristCurve<'_>| hand.speed.iter().sum::<f64>() / CURVE_RATE;
        return Err(match wrists.iter().map(way).fold(0.0, f64::max) < LEAST_WAY {
            true => UncutReason::NoMovement,
            false => UncutReason::HandsStayLow,
        });
    }
    let odds = measure_frame_odds(&curves, rest.up);
    let mut signs = Vec::new();
    for activity in &activities {
        signs.extend(cut_activity(&curves, &odds, activity, options));
    }
    let phases = cut_phases::divide_phases(&curves, &signs);
    let signs = signs.iter().map(|sign| sign.timed_sign(clip)).collect();
    Ok(TakeCut { signs, phases })
}

/// Returns the numbers of each frame of a take, to learn the weights of the heads; `None` if its body cannot be measured.
#[must_use]
pub fn measure_frame_numbers(clip: &Clip, anatomy: &BodyAnatomy) -> Option<FrameNumberTable> {
    let curves = TakeCurves::measure_clip(clip, anatomy)?;
    let rest = RestHeights::measure_rest(curves.wrist_curves());
    Some(FrameNumberTable::of_curves(&curves, rest.up))
}

/// The simplest ways to cut a take, with which every other one is compared.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BaselineCuts {
    /// Each activity as one span.
    pub activities: Vec<TimeSpan>,
    /// Each activity cut at every minimum of the faster wrist's speed.
    pub speed_minima: Vec<TimeSpan>,
}

/// Cuts a take in the simplest ways; no spans if it has no activity.
#[must_use]
pub fn cut_baselines(clip: &Clip, anatomy: &BodyAnatomy) -> BaselineCuts {
    let mut cuts = BaselineCuts::default();
    let Some(curves) = TakeCurves::measure_clip(clip, anatomy) else {
        return cuts;
    };
    let wrists = curves.wrist_curves();
    let fastest: Vec<f64> = (0..curves.sample_count())
        .map(|sample| wrists[0].speed[sample].max(wrists[1].speed[sample]))
        .collect();
    let instant = |sample: usize| RecordingInstant::from_seconds(sample as f64 / CURVE_RATE);
    let span = |start: usize, end: usize| TimeSpan::span_between(instant(start), instant(end));
    for activity in peel_activities(wrists, RestHeights::measure_rest(wrists)) {
        let Range { start, end } = activity.activity;
        cuts.activities.push(span(start, end));
        let mut from = start;
        for sample in start + 1..end.saturating_sub(1) {
            if fastest[sample] < fastest[sample - 1] && fastest[sample] <= fastest[sample + 1] {
                cuts.speed_minima.push(span(from, sample));
                from = sample;
            }
        }
        cuts.speed_minima.push(span(from, end));
    }
    cuts
}

/// A sign in samples of the curves.
#[derive(Debug, Clone, PartialEq)]
struct SampledSign {
    /// The samples from its begin to its end.
    samples: Range<usize>,
    /// The samples of the activity around it.
    activity: Range<usize>,
    dominant: usize,
    counts: [bool; 2],
    rule: CutRule,
    confidence: f64,
}

impl SampledSign {
    fn timed_sign(&self, clip: &Clip) -> CutSign {
        let last = clip.clip_span().span_end_instant();
        let instant = |sample: usize| RecordingInstant::from_seconds(sample as f64 / CURVE_RATE).min(last);
        CutSign {
            span: TimeSpan::span_between(instant(self.samples.start), instant(self.samples.end)),
            dominant: BodySide::BOTH_SIDES[self.dominant],
            is_two_handed: self.counts == [true; 2],
            rule: self.rule,
            confidence: self.confidence,
        }
    }
}

/// Returns the signs of an activity: the decoded ones if there are several, else the peeled one.
fn cut_activity(curves: &TakeCurves, odds: &FrameOdds, activity: &PeeledSign, options: CutOptions) -> Vec<SampledSign> {
    let step = (CURVE_RATE / FRAME_RATE) as usize;
    let last_frame = odds.sign.len();
    let frames = activity.activity.start / step..activity.activity.end.div_ceil(step).min(last_frame);
    let numbers = &tuned().decoder;
    let decode = |cost: f64| odds.decode_signs(frames.clone(), numbers.weight, cost);
    let decoded = decode(options.sign_cost);
    // Two signs are often the halves of one that repeats or is a compound.
    let is_one = match decoded.len() {
        0 | 1 => true,
        // Whoever asks for more signs wants them parted more readily.
        2 => {
            let readiness = (options.sign_cost / numbers.cost).clamp(0.0, 1.0);
            decode(options.sign_cost + readiness * numbers.second).len() < 2
        }
        _ => false,
    };
    if is_one {
        let (begin, end) = (*activity.sign.start(), *activity.sign.end());
        let [supported, unsupported] = tuned().confidence.peeled;
        let is_supported = decoded.first().is_some_and(|span| {
            let shared = (span.end * step)
                .min(end)
                .saturating_sub((span.start * step).max(begin));
            let all = (span.end * step).max(end) - (span.start * step).min(begin);
            // The decoder's span supports the peeled one if they share half of the time of both.
            2 * shared >= all
        });
        // One sample has a length, too.
        return vec![SampledSign {
            samples: begin..end.max(begin + 1),
            activity: activity.activity.clone(),
            dominant: activity.dominant,
            counts: activity.counts,
            rule: CutRule::Peeled,
            confidence: if is_supported { supported } else { unsupported },
        }];
    }
    let [offset, share] = tuned().confidence.decoded;
    let mut signs: Vec<SampledSign> = Vec::new();
    for (number, span) in decoded.iter().enumerate() {
        let samples = span.start * step..(span.end * step).min(curves.sample_count() - 1);
        let before = number
            .checked_sub(1)
            .map_or(activity.activity.start, |before| decoded[before].end * step);
        let after = decoded
            .get(number + 1)
            .map_or(activity.activity.end.min(curves.sample_count()), |after| {
                after.start * step
            });
        let (dominant, counts) = signing_hands(curves, &samples);
        let evidence = odds.sign_evidence(span);
        signs.push(SampledSign {
            samples: widen_to_flanks(&curves.hands[dominant].posture_speed, samples, before..after),
            activity: activity.activity.clone(),
            dominant,
            counts,
            rule: CutRule::Decoded,
            confidence: 1.0 / (1.0 + (-offset - share * evidence).exp()),
        });
    }
    signs
}

/// Returns the number of the hand that moves more in some samples, and which hands sign in them: the other one does if it is
/// up and its way is long enough.
fn signing_hands(curves: &TakeCurves, samples: &Range<usize>) -> (usize, [bool; 2]) {
    let ways = curves.hands.each_ref().map(|hand| {
        let is_up = samples.clone().any(|sample| hand.height[sample] > tuned().activity.up);
        let way: f64 = hand.posture_speed[samples.clone()].iter().sum();
        if is_up { way } else { 0.0 }
    });
    let dominant = usize::from(ways[1] > ways[0]);
    let counts = |number: usize| number == dominant || ways[number] > tuned().activity.weak_share * ways[dominant];
    (dominant, [counts(0), counts(1)])
}

/// Moves both boundaries of a sign outwards within `bounds` while the posture is slow, compared with the peak of the way there.
fn widen_to_flanks(speed: &[f64], samples: Range<usize>, bounds: Range<usize>) -> Range<usize> {
    let [seconds, share] = tuned().decoder.flank;
    let most = (seconds * CURVE_RATE).round() as usize;
    let peak = |samples: Range<usize>| speed[samples].iter().copied().fold(0.0, f64::max);
    let (mut start, mut end) = (samples.start, samples.end);
    // The peak of the way to the sign, not of the sign, says what is slow.
    let slow_before = share * peak(bounds.start.min(start)..start + 1);
    while start > bounds.start && samples.start - start < most && speed[start - 1] < slow_before {
        start -= 1;
    }
    let slow_after = share * peak(end..bounds.end.max(end + 1).min(speed.len()));
    while end + 1 < bounds.end && end - samples.end < most && speed[end + 1] < slow_after {
        end += 1;
    }
    start..end
}
