//! Annotations that overlap on one tier, which the tier rules forbid.

use crate::tally::FindingTally;
use chereme_motion::{RecordingInstant, TimeSpan};

/// The length of a point as an annotation, in microseconds, unless the next one begins before.
const POINT_MICROS: i64 = 40_000;
/// The most tiers that one tier of a file becomes because its annotations overlap.
pub(crate) const MAX_TIER_LANES: usize = 16;

/// The time of an annotation to be arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TimedAnnotation {
    pub(crate) span: TimeSpan,
    /// Whether it is a point, whose length depends on the next one.
    pub(crate) is_point: bool,
}

impl TimedAnnotation {
    /// Returns the time of a point.
    pub(crate) fn timed_at_point(at: RecordingInstant) -> Self {
        Self {
            span: TimeSpan::span_between(at, at.shifted_instant(1)),
            is_point: true,
        }
    }

    /// Returns the time between two instants; one without length is a point. Findings name the tier.
    pub(crate) fn timed_between_instants(
        start: RecordingInstant,
        end: RecordingInstant,
        tier: &str,
        line: impl FnOnce() -> u64,
        findings: &mut FindingTally,
    ) -> Self {
        if start == end {
            findings.add_limited_warning("annotations without length", line(), || {
                format!(
                    "an annotation of the tier {tier:?} at {start} has no length; it lasts 40 ms, or until the next one"
                )
            });
            return Self::timed_at_point(start);
        }
        if end < start {
            findings.add_limited_warning("annotations that end before they start", line(), || {
                format!("an annotation of the tier {tier:?} at {start} ends before it starts; the ends were exchanged")
            });
        }
        Self {
            span: TimeSpan::span_between(start, end),
            is_point: false,
        }
    }
}

/// Returns the lane of each annotation, from 0, so that those of one lane do not overlap; points get their lengths. No
/// more than [`MAX_TIER_LANES`] are used; annotations without room stay in the last one, and are counted.
pub(crate) fn arrange_tier_lanes(times: &mut [TimedAnnotation]) -> (Vec<usize>, u64) {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by_key(|&at| (times[at].span, at));
    let mut of = vec![0; times.len()];
    let mut lanes: Vec<(RecordingInstant, usize)> = Vec::new();
    let mut crowded = 0;
    for at in order {
        let span = times[at].span;
        let free = lanes.iter().position(|(end, _)| *end <= span.span_start_instant());
        let lane = match free {
            Some(free) => free,
            None if lanes.len() < MAX_TIER_LANES => {
                lanes.push((span.span_end_instant(), at));
                of[at] = lanes.len() - 1;
                continue;
            }
            None => {
                crowded += 1;
                MAX_TIER_LANES - 1
            }
        };
        let (end, before) = &mut lanes[lane];
        // A point lasts until the next annotation of its lane begins, at most its usual length.
        if times[*before].is_point {
            lengthen_timed_point(&mut times[*before], span.span_start_instant());
        }
        of[at] = lane;
        (*end, *before) = (span.span_end_instant().max(*end), at);
    }
    for (_, last) in lanes {
        if times[last].is_point {
            lengthen_timed_point(&mut times[last], RecordingInstant::from_micros(i64::MAX));
        }
    }
    (of, crowded)
}

/// Reports annotations of a tier that lie on other lanes than the first.
pub(crate) fn report_split_lanes(
    tier: &str,
    of: &[usize],
    crowded: u64,
    line: impl Fn() -> u64,
    findings: &mut FindingTally,
) {
    let others = of.iter().filter(|lane| **lane > 0).count();
    if others > 0 {
        findings.add_limited_warning("tiers with annotations that overlap", line(), || {
            format!(
                "annotations of {tier:?} overlap others: {others} were put on tiers of their own, as {:?}",
                format!("{tier} (2)")
            )
        });
    }
    if crowded > 0 {
        findings.add_limited_warning("crowded tiers", line(), || {
            format!("more than {MAX_TIER_LANES} annotations of {tier:?} overlap at once: {crowded} of them still do")
        });
    }
}

/// Gives a point its length; it ends at `next` at the latest.
fn lengthen_timed_point(point: &mut TimedAnnotation, next: RecordingInstant) {
    let start = point.span.span_start_instant();
    let end = start
        .shifted_instant(POINT_MICROS)
        .min(next)
        .max(start.shifted_instant(1));
    point.span = TimeSpan::span_between(start, end);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(start: i64, end: i64) -> TimedAnnotation {
        let instant = RecordingInstant::from_millis;
        match start == end {
            true => TimedAnnotation::timed_at_point(instant(start)),
            false => TimedAnnotation {
                span: TimeSpan::span_between(instant(start), instant(end)),
                is_point: false,
            },
        }
    }

    #[test]
    fn annotations_of_a_lane_do_not_overlap() {
        for (times, expected, ends) in [
            (vec![], vec![], vec![]),
            (vec![at(0, 10), at(10, 20)], vec![0, 0], vec![10, 20]),
            (vec![at(5, 20), at(0, 10)], vec![1, 0], vec![20, 10]),
            (vec![at(0, 30), at(10, 20), at(20, 40)], vec![0, 1, 1], vec![30, 20, 40]),
            (
                vec![at(0, 0), at(10, 10), at(100, 100)],
                vec![0, 0, 0],
                vec![10, 50, 140],
            ),
            (vec![at(0, 0), at(0, 0)], vec![0, 1], vec![40, 40]),
        ] {
            let mut arranged = times.clone();
            let (of, crowded) = arrange_tier_lanes(&mut arranged);
            assert_eq!((of, crowded), (expected, 0), "{times:?}");
            let found: Vec<i64> = arranged
                .iter()
                .map(|it| it.span.span_end_instant().instant_millis())
                .collect();
            assert_eq!(found, ends, "{times:?}");
        }
        let (of, crowded) = arrange_tier_lanes(&mut [at(0, 10); 20]);
        assert_eq!((of[19], crowded), (MAX_TIER_LANES - 1, 4));
    }
}
