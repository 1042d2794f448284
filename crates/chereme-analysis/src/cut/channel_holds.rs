//! Holds of the fingers, the place and the palm of a hand, each for itself.

use std::ops::Range;

use chereme_motion::{BodyAnatomy, Clip, RecordingInstant, TimeSpan};
use serde::Serialize;

use super::cut_curves::{CURVE_RATE, HandCurve, TakeCurves};
use super::cut_tuned::tuned;

/// A part of a hand's posture that is held or moves for itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandChannel {
    /// The joints of the fingers.
    Fingers,
    /// The place of the wrist.
    Place,
    /// The rotation of the palm.
    Palm,
}

impl HandChannel {
    /// All of them.
    pub const ALL_CHANNELS: [Self; 3] = [Self::Fingers, Self::Place, Self::Palm];

    /// Returns its speed, and the speed below which it is held in and around some samples.
    pub(super) fn speed_and_limit<'c>(self, hand: &'c HandCurve, samples: &Range<usize>) -> (&'c [f64], f64) {
        let numbers = &tuned().holds;
        let (speed, limit) = match self {
            Self::Fingers => (&hand.finger_speed, numbers.turn),
            Self::Place => (&hand.speed, numbers.place),
            Self::Palm => (&hand.palm_speed, numbers.turn),
        };
        let around = (tuned().activity.around * CURVE_RATE).round() as usize;
        let near = samples.start.saturating_sub(around)..(samples.end + around).min(speed.len());
        let peak = speed[near].iter().copied().fold(0.0, f64::max);
        // A slow signer holds at slower speeds, but never below a share of the usual limit.
        (speed, limit.min(numbers.peak * peak).max(numbers.least * limit))
    }

    /// Returns the difference between two samples, in the unit of the channel's tolerances.
    fn sample_difference(self, hand: &HandCurve, a: usize, b: usize) -> f64 {
        match self {
            Self::Fingers => hand.finger_change(a, b),
            Self::Place => hand.places[a].distance(hand.places[b]),
            Self::Palm => hand.palm_change(a, b),
        }
    }
}

/// The posture of a channel at the beginning or the end of a sign, or in all of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelPosture {
    /// Its time from the clip's first frame: that of the hold, or the whole sign's if it has no other posture.
    pub span: TimeSpan,
    /// The moment that shows it best: the middle of the hold, or the slowest moment.
    pub moment: RecordingInstant,
    /// Whether it is held.
    pub is_held: bool,
    /// The share of the sign from the beginning to the end of the hold.
    pub share: f64,
    /// The greatest difference from the posture in the sign, in arm lengths for a place, else in degrees.
    pub reach: f64,
    /// The confidence, from 0 to 1, by the length of the hold and the spread in it.
    pub confidence: f64,
}

/// A posture in samples of the curves.
#[derive(Debug, Clone, PartialEq)]
struct SampledPosture {
    samples: Range<usize>,
    /// The longest hold of those that it unites.
    core: Range<usize>,
    moment: usize,
    is_held: bool,
    confidence: f64,
}

/// Returns the postures of each channel in a sign, of the right hand and then of the left: one, or the first and the last
/// if they differ. `sign` counts from the clip's first frame, and the clip should show 0.4 s on both sides of it. `None`
/// if the body cannot be measured.
#[must_use]
pub fn find_channel_postures(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    sign: TimeSpan,
) -> Option<[[Vec<ChannelPosture>; 3]; 2]> {
    let curves = TakeCurves::measure_clip(clip, anatomy)?;
    let last = curves.sample_count();
    let sample = |at: RecordingInstant| ((at.instant_seconds() * CURVE_RATE).round().max(0.0) as usize).min(last);
    let start = sample(sign.span_start_instant()).min(last - 1);
    let samples = start..sample(sign.span_end_instant()).max(start + 1);
    let instant = |sample: usize| RecordingInstant::from_seconds(sample as f64 / CURVE_RATE);
    Some(curves.hands.each_ref().map(|hand| {
        HandChannel::ALL_CHANNELS.map(|channel| {
            let postures = sampled_postures(hand, channel, &samples);
            let is_only = postures.len() == 1;
            let timed = |posture: &SampledPosture| ChannelPosture {
                span: match is_only {
                    true => sign,
                    false => TimeSpan::span_between(instant(posture.samples.start), instant(posture.samples.end)),
                },
                moment: instant(posture.moment),
                is_held: posture.is_held,
                share: posture.samples.len() as f64 / samples.len() as f64,
                reach: {
                    let away = |sample| channel.sample_difference(hand, posture.moment, sample);
                    samples.clone().map(away).fold(0.0, f64::max)
                },
                confidence: posture.confidence,
            };
            postures.iter().map(timed).collect()
        })
    }))
}

/// Returns the postures of a channel in some samples: one, or the first and the last if they differ.
fn sampled_postures(hand: &HandCurve, channel: HandChannel, sign: &Range<usize>) -> Vec<SampledPosture> {
    let numbers = &tuned().holds;
    let (speed, limit) = channel.speed_and_limit(hand, sign);
    let mut postures = find_channel_holds(hand, channel, sign);
    let edge = (sign.len() / 3)
        .min((numbers.edge * CURVE_RATE).round() as usize)
        .max(1);
    let [begin, end] = [sign.start..sign.start + edge, sign.end - edge..sign.end];
    let slowest = |samples: Range<usize>| {
        let least = samples.clone().min_by(|a, b| speed[*a].total_cmp(&speed[*b]));
        let moment = least.unwrap_or(samples.start);
        SampledPosture {
            core: samples.clone(),
            samples,
            moment,
            is_held: false,
            confidence: numbers.unheld * limit / (limit + speed[moment]),
        }
    };
    let is_place = channel == HandChannel::Place;
    let is_late = postures.first().is_none_or(|first| first.samples.start >= begin.end);
    let is_early = postures.last().is_none_or(|last| last.samples.end <= end.start);
    if is_late {
        // A sign that is not held at first has its place where it begins.
        let mut first = slowest(begin.clone());
        first.moment = if is_place { begin.start } else { first.moment };
        postures.insert(0, first);
    }
    // A hand that passes through a place does not end there.
    if is_early && !is_place {
        postures.push(slowest(end));
    }
    let (Some(first), Some(last)) = (postures.first(), postures.last()) else {
        return postures;
    };
    if channel.sample_difference(hand, first.moment, last.moment) > numbers.other[channel as usize] {
        return vec![first.clone(), last.clone()];
    }
    let surer = |a: &&SampledPosture, b: &&SampledPosture| a.confidence.total_cmp(&b.confidence);
    [first, last].into_iter().max_by(surer).cloned().into_iter().collect()
}

/// Returns the holds of a channel in some samples; neighbouring ones of the same posture are one.
fn find_channel_holds(hand: &HandCurve, channel: HandChannel, sign: &Range<usize>) -> Vec<SampledPosture> {
    let numbers = &tuned().holds;
    let (speed, limit) = channel.speed_and_limit(hand, sign);
    let tolerance = numbers.same[channel as usize];
    let shortest = (numbers.shortest * CURVE_RATE).round() as usize;
    let mut holds: Vec<SampledPosture> = Vec::new();
    let mut start = sign.start;
    while start < sign.end {
        let is_held = speed[start] < limit;
        let end = (start..sign.end)
            .find(|sample| (speed[*sample] < limit) != is_held)
            .unwrap_or(sign.end);
        let run = start..end;
        start = end;
        if !is_held || run.len() < shortest {
            continue;
        }
        let moment = run.start + run.len() / 2;
        let squares = run
            .clone()
            .map(|sample| channel.sample_difference(hand, moment, sample).powi(2));
        let spread = squares.sum::<f64>() / run.len() as f64 / tolerance.powi(2);
        let length = run.len() as f64 / CURVE_RATE;
        let hold = SampledPosture {
            samples: run.clone(),
            core: run,
            moment,
            is_held: true,
            confidence: (1.0 - (-length / numbers.sure).exp()) * (-spread / 2.0).exp(),
        };
        match holds.last_mut() {
            Some(before) if channel.sample_difference(hand, before.moment, moment) < tolerance => {
                let samples = before.samples.start..hold.samples.end;
                if hold.core.len() > before.core.len() {
                    *before = hold;
                }
                before.samples = samples;
            }
            _ => holds.push(hold),
        }
    }
    holds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transcribe::tests::{Held, clip, ease};
    use chereme_sign::hamnosys::HandClass;
    use glam::DVec3;

    /// Returns the postures of the right hand in a sign of 1.2 s in which the hand does so, with its times in seconds.
    fn right_hand_postures(at: impl Fn(f64) -> Held) -> [Vec<ChannelPosture>; 3] {
        let (clip, anatomy) = clip(1.2, |share| [Some(at(share)), None]);
        let [right, _] = find_channel_postures(&clip, &anatomy, clip.clip_span()).expect("a body");
        right
    }

    fn seconds_of(span: TimeSpan) -> [f64; 2] {
        [span.span_start_instant(), span.span_end_instant()].map(RecordingInstant::instant_seconds)
    }

    fn held_hand(class: HandClass) -> Held {
        Held::new([-0.15, -0.12, 0.30], "u", "l", class)
    }

    #[test]
    fn a_hand_that_closes_in_its_place_has_two_shapes_and_one_place() {
        let close = |share: f64| held_hand(if share < 0.5 { HandClass::Flat } else { HandClass::Fist });
        let [fingers, place, palm] = right_hand_postures(close);
        assert_eq!([place.len(), palm.len()], [1, 1]);
        assert!(place[0].is_held && place[0].share > 0.85 && place[0].confidence > 0.95);
        let [open, closed] = fingers.as_slice() else {
            panic!("{fingers:?}");
        };
        // The shape changes at 0.77 s; the curves are smoothed by a bell of 40 ms.
        let ([_, until], [from, _]) = (seconds_of(open.span), seconds_of(closed.span));
        assert!(
            until > 0.6 && until < 0.77 && from > 0.77 && from < 0.93,
            "{until} {from}"
        );
        assert!(open.is_held && closed.is_held && open.confidence > 0.9);
    }

    #[test]
    fn a_hand_on_its_way_is_moving_and_says_so() {
        let far = |share: f64| held_hand(HandClass::Flat).moved(DVec3::Y * (0.25 * share));
        let [fingers, place, _] = right_hand_postures(far);
        assert!(fingers.len() == 1 && fingers[0].is_held);
        assert_eq!(place.len(), 2, "{place:?}");
        let to_and_fro = |share: f64| held_hand(HandClass::Flat).moved(DVec3::X * (0.1 * (share * 40.0).sin()));
        let [_, place, _] = right_hand_postures(to_and_fro);
        let moving: Vec<&ChannelPosture> = place.iter().filter(|posture| !posture.is_held).collect();
        assert!(moving.iter().all(|posture| posture.confidence <= 0.3), "{place:?}");
    }

    #[test]
    fn a_reversed_sign_has_its_postures_reversed() {
        let there = |share: f64| {
            let class = if share < 0.4 { HandClass::Flat } else { HandClass::Fist };
            held_hand(class).moved(DVec3::Y * (0.2 * ease(((share - 0.3) / 0.4).clamp(0.0, 1.0))))
        };
        let ways = [
            right_hand_postures(there),
            right_hand_postures(|share| there(1.0 - share)),
        ];
        let whole = 92.0 / 60.0;
        for (one, other) in ways[0].iter().zip(&ways[1]) {
            assert_eq!(one.len(), other.len());
            for (a, b) in one.iter().zip(other.iter().rev()) {
                let ([from, to], [start, end]) = (seconds_of(a.span), seconds_of(b.span));
                assert!(
                    (from - (whole - end)).abs() < 0.05 && (to - (whole - start)).abs() < 0.05,
                    "{a:?} {b:?}"
                );
                assert!((a.confidence - b.confidence).abs() < 0.1, "{a:?} {b:?}");
            }
        }
    }
}
