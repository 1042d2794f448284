//! Activities between rests, and the one sign that is left of each without its preparation and retraction.

use std::ops::{Range, RangeInclusive};

use super::cut_curves::CURVE_RATE;
use super::cut_tuned::tuned;

/// Height (0 at the hips, 1 at the shoulders) and speed (arm lengths a second) of a wrist, at one rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct WristCurve<'a> {
    pub(super) height: &'a [f64],
    pub(super) speed: &'a [f64],
}

/// The heights that part rest and activity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestHeights {
    /// The height of the commonest still posture, at least that of the hips.
    rest: f64,
    /// An activity begins at this height.
    pub(super) up: f64,
    /// An activity ends below this height.
    down: f64,
}

/// An activity with the one sign in it, in samples.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PeeledSign {
    /// The samples of the activity.
    pub(super) activity: Range<usize>,
    /// The first and the last sample of the sign.
    pub(super) sign: RangeInclusive<usize>,
    /// The number of the dominant hand.
    pub(super) dominant: usize,
    /// Which hands count.
    pub(super) counts: [bool; 2],
}

impl RestHeights {
    /// Measures the rest of a take: its commonest still posture that is low enough, by the height of the higher hand.
    pub(super) fn measure_rest(hands: [WristCurve<'_>; 2]) -> Self {
        const HEIGHT_STEP: f64 = 0.05;
        let numbers = &tuned().activity;
        let mut still_samples: Vec<(i64, usize)> = Vec::new();
        for sample in 0..hands[0].height.len() {
            let height = hands[0].height[sample].max(hands[1].height[sample]);
            let is_still = hands.iter().all(|hand| hand.speed[sample] < numbers.still);
            if is_still && height < numbers.highest_rest {
                let step = (height / HEIGHT_STEP).round() as i64;
                match still_samples.iter_mut().find(|(known_step, _)| *known_step == step) {
                    Some((_, count)) => *count += 1,
                    None => still_samples.push((step, 1)),
                }
            }
        }
        // Of equally common postures the lower one is the rest.
        let commonest = still_samples.iter().max_by_key(|(step, count)| (*count, -step));
        let rest = commonest.map_or(0.0, |(step, _)| *step as f64 * HEIGHT_STEP).max(0.0);
        let [above, still_above] = numbers.above_rest;
        Self {
            rest,
            up: numbers.up.max(rest + above),
            down: numbers.down.max(rest + still_above),
        }
    }
}

/// Returns the activities of a take, each with its sign.
pub(super) fn peel_activities(hands: [WristCurve<'_>; 2], rest: RestHeights) -> Vec<PeeledSign> {
    let activities = activity_ranges(hands, rest).into_iter();
    activities
        .filter_map(|activity| peel_activity(hands, rest, activity))
        .collect()
}

fn activity_ranges(hands: [WristCurve<'_>; 2], rest: RestHeights) -> Vec<Range<usize>> {
    let count = hands[0].height.len();
    let highest = |sample: usize| hands[0].height[sample].max(hands[1].height[sample]);
    let mut ranges: Vec<Range<usize>> = Vec::new();
    let mut start = 0;
    while let Some(rises) = (start..count).find(|sample| highest(*sample) >= rest.up) {
        // Both ends lie where the hands pass the lower height, so that a reversed take has the same activities.
        let begin = (start..rises).rev().find(|sample| highest(*sample) < rest.down);
        let end = (rises..count)
            .find(|sample| highest(*sample) < rest.down)
            .unwrap_or(count);
        ranges.push(begin.map_or(start, |low| low + 1)..end);
        start = end;
    }
    ranges
}

fn peel_activity(hands: [WristCurve<'_>; 2], rest: RestHeights, activity: Range<usize>) -> Option<PeeledSign> {
    // Only the way while raised counts: an arm that swings below does not sign.
    let way = |hand: &WristCurve<'_>| -> f64 {
        let raised = activity.clone().filter(|sample| hand.height[*sample] > rest.down);
        raised.map(|sample| hand.speed[sample] / CURVE_RATE).sum()
    };
    let ways = hands.each_ref().map(way);
    let dominant = usize::from(ways[1] > ways[0]);
    let mut peeled = PeeledSign {
        activity: activity.clone(),
        sign: activity.start..=activity.start,
        dominant,
        counts: [false; 2],
    };
    let mut sign: Option<(usize, usize)> = None;
    for (number, hand) in hands.into_iter().enumerate() {
        // A weak hand that hardly moves neither delays the begin nor the end.
        if number != dominant && ways[number] <= tuned().activity.weak_share * ways[dominant] {
            continue;
        }
        if let Some((begin, end)) = peel_hand(hand, rest, &activity) {
            peeled.counts[number] = true;
            sign = Some(sign.map_or((begin, end), |(first, last)| (first.min(begin), last.max(end))));
        }
    }
    let (begin, end) = sign?;
    peeled.sign = begin..=end;
    Some(peeled)
}

/// Returns the first and the last sample at which one hand signs: between the posture that its preparation reaches and
/// the one that its retraction leaves.
fn peel_hand(hand: WristCurve<'_>, rest: RestHeights, activity: &Range<usize>) -> Option<(usize, usize)> {
    let around = (tuned().activity.around * CURVE_RATE).round() as usize;
    let mut raised: Vec<f64> = hand.height[activity.clone()].to_vec();
    raised.retain(|height| *height > rest.up);
    if raised.is_empty() {
        return None;
    }
    raised.sort_by(f64::total_cmp);
    // The mean of both middles is the median for an even count, and the same in a reversed take.
    let (middle, low_middle) = (raised[raised.len() / 2], raised[(raised.len() - 1) / 2]);
    let usual = (middle + low_middle) / 2.0;
    let level = rest.rest + tuned().peel.level * (usual - rest.rest);
    let is_arrived = |sample: &usize| hand.height[*sample] >= level;
    let first = activity.clone().find(is_arrived)?;
    let last = activity.clone().rev().find(is_arrived)?;
    let peak = |samples: Range<usize>| hand.speed[samples].iter().copied().fold(0.0, f64::max);
    // The peak of the way up may lie before the activity, in which hands must be up already.
    let slow_before = tuned().peel.slow * peak(activity.start.saturating_sub(around)..first + 1);
    let slow_after = tuned().peel.slow * peak(last..(activity.end + around).min(hand.speed.len()));
    let is_minimum = |sample: usize| {
        let before = sample.checked_sub(1).map(|before| hand.speed[before]);
        let after = hand.speed.get(sample + 1);
        let is_lower = |other: f64| hand.speed[sample] <= other;
        before.is_some_and(is_lower) && after.copied().is_some_and(is_lower)
    };
    // A take that begins or ends in the middle of signing has no preparation or no retraction.
    let begin = match first {
        0 => 0,
        _ => (first..=last).find(|sample| hand.speed[*sample] < slow_before || is_minimum(*sample))?,
    };
    let end = match last + 1 == hand.speed.len() {
        true => last,
        false => (first..=last)
            .rev()
            .find(|sample| hand.speed[*sample] < slow_after || is_minimum(*sample))?,
    };
    (begin <= end).then_some((begin, end))
}
