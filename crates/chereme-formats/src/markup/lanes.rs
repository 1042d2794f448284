//! Annotations that overlap on one tier, which the tier rules forbid.

use crate::finding::Finding;
use crate::tally::Findings;
use chereme_motion::{Instant, Span};

/// The length of a point as an annotation, in microseconds, unless the next one begins before.
const POINT_MICROS: i64 = 40_000;
/// The most tiers that one tier of a file becomes because its annotations overlap.
pub(crate) const LANES: usize = 16;

/// The time of an annotation to be arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Timed {
    pub(crate) span: Span,
    /// Whether it is a point, whose length depends on the next one.
    pub(crate) is_point: bool,
}

impl Timed {
    /// Returns the time of a point.
    pub(crate) fn point(at: Instant) -> Self {
        Self {
            span: Span::between(at, at.shifted(1)),
            is_point: true,
        }
    }

    /// Returns the time between two instants; one without length is a point. Findings name the tier.
    pub(crate) fn between(
        start: Instant,
        end: Instant,
        (tier, line): (&str, impl FnOnce() -> u64),
        findings: &mut Findings,
    ) -> Self {
        if start == end {
            findings.add("annotations without length", || {
                Finding::warning(line(), format!("an annotation of the tier {tier:?} at {start} has no length; it lasts 40 ms, or until the next one"))
            });
            return Self::point(start);
        }
        if end < start {
            findings.add("annotations that end before they start", || {
                Finding::warning(line(), format!("an annotation of the tier {tier:?} at {start} ends before it starts; the ends were exchanged"))
            });
        }
        Self {
            span: Span::between(start, end),
            is_point: false,
        }
    }
}

/// Returns the lane of each annotation, from 0, so that those of one lane do not overlap; points get their lengths. No
/// more than [`LANES`] are used; annotations without room stay in the last one, and are counted.
pub(crate) fn lanes(times: &mut [Timed]) -> (Vec<usize>, u64) {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by_key(|&at| (times[at].span, at));
    let mut of = vec![0; times.len()];
    let mut lanes: Vec<(Instant, usize)> = Vec::new();
    let mut crowded = 0;
    for at in order {
        let span = times[at].span;
        let free = lanes.iter().position(|(end, _)| *end <= span.start());
        let lane = match free {
            Some(free) => free,
            None if lanes.len() < LANES => {
                lanes.push((span.end(), at));
                of[at] = lanes.len() - 1;
                continue;
            }
            None => {
                crowded += 1;
                LANES - 1
            }
        };
        let (end, before) = &mut lanes[lane];
        if times[*before].is_point {
            lengthen(&mut times[*before], span.start());
        }
        of[at] = lane;
        (*end, *before) = (span.end().max(*end), at);
    }
    for (_, last) in lanes {
        if times[last].is_point {
            lengthen(&mut times[last], Instant::from_micros(i64::MAX));
        }
    }
    (of, crowded)
}

/// Reports annotations of a tier that lie on other lanes than the first.
pub(crate) fn split(
    (tier, of, crowded): (&str, &[usize], u64),
    line: impl Fn() -> u64,
    findings: &mut Findings,
) {
    let others = of.iter().filter(|lane| **lane > 0).count();
    if others > 0 {
        findings.add("tiers with annotations that overlap", || {
            Finding::warning(
                line(),
                format!(
                    "annotations of {tier:?} overlap others: {others} were put on tiers of their own, as {:?}",
                    format!("{tier} (2)")
                ),
            )
        });
    }
    if crowded > 0 {
        findings.add("crowded tiers", || {
            Finding::warning(
                line(),
                format!("more than {LANES} annotations of {tier:?} overlap at once: {crowded} of them still do"),
            )
        });
    }
}

/// Gives a point its length; it ends at `next` at the latest.
fn lengthen(point: &mut Timed, next: Instant) {
    let start = point.span.start();
    let end = start.shifted(POINT_MICROS).min(next).max(start.shifted(1));
    point.span = Span::between(start, end);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(start: i64, end: i64) -> Timed {
        let instant = Instant::from_millis;
        match start == end {
            true => Timed::point(instant(start)),
            false => Timed {
                span: Span::between(instant(start), instant(end)),
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
            (
                vec![at(0, 30), at(10, 20), at(20, 40)],
                vec![0, 1, 1],
                vec![30, 20, 40],
            ),
            (
                vec![at(0, 0), at(10, 10), at(100, 100)],
                vec![0, 0, 0],
                vec![10, 50, 140],
            ),
            (vec![at(0, 0), at(0, 0)], vec![0, 1], vec![40, 40]),
        ] {
            let mut arranged = times.clone();
            let (of, crowded) = lanes(&mut arranged);
            assert_eq!((of, crowded), (expected, 0), "{times:?}");
            let found: Vec<i64> = arranged.iter().map(|it| it.span.end().millis()).collect();
            assert_eq!(found, ends, "{times:?}");
        }
        let (of, crowded) = lanes(&mut [at(0, 10); 20]);
        assert_eq!((of[19], crowded), (LANES - 1, 4));
    }
}
