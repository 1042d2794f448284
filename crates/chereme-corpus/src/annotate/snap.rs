//! Snapping of times: to boundaries of annotations, minima of wrist speed, starts of frames.

use std::collections::BTreeSet;

use chereme_motion::{Instant, Rate};
use serde::{Deserialize, Serialize};

use crate::contents::TierContents;

/// The kinds of times that a drag snaps to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Snaps {
    /// Starts of frames.
    pub frames: bool,
    /// Boundaries of annotations.
    pub boundaries: bool,
    /// Minima of wrist speed.
    pub minima: bool,
}

impl Default for Snaps {
    fn default() -> Self {
        Self {
            frames: true,
            boundaries: true,
            minima: false,
        }
    }
}

/// The kind of target that a time snapped to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Catch {
    /// The boundary of an annotation, or a mark.
    Boundary,
    /// A minimum of wrist speed.
    Minimum,
    /// The start of a frame.
    Frame,
}

/// Frame times of a recording: the rate, and the offset of the first frame on the recording's clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frames {
    /// The number of frames per second.
    pub rate: Rate,
    /// The start of the first frame, in microseconds.
    pub offset: i64,
}

impl Frames {
    /// Returns the start of a frame, in microseconds.
    #[must_use]
    pub fn start(&self, frame: u64) -> i64 {
        let frame = usize::try_from(frame).unwrap_or(usize::MAX);
        self.rate.instant(frame).micros() + self.offset
    }

    /// Returns the start of the frame nearest to a time.
    #[must_use]
    pub fn nearest(&self, micros: i64) -> i64 {
        let own = (micros - self.offset).max(0);
        let frame = self.rate.frame_at(Instant::from_micros(own));
        self.rate.instant(frame).micros() + self.offset
    }

    /// Returns the start of the frame `by` frames after the one nearest to a time.
    #[must_use]
    pub fn stepped(&self, micros: i64, by: i64) -> i64 {
        let own = (self.nearest(micros) - self.offset).max(0);
        let frame = self.rate.frame_at(Instant::from_micros(own)) as i64 + by;
        let frame = usize::try_from(frame).unwrap_or_default();
        self.rate.instant(frame).micros() + self.offset
    }
}

/// The snapping targets of a drag.
#[derive(Debug)]
pub struct Guides<'a> {
    /// The kinds of times to snap to.
    pub snaps: Snaps,
    /// The tiers whose boundaries are targets.
    pub tiers: &'a [TierContents],
    /// The dragged annotations, whose boundaries are no targets.
    pub except: &'a BTreeSet<i64>,
    /// Further times that are treated as boundaries, such as the playhead.
    pub marks: &'a [i64],
    /// Minima of wrist speed, in order, in microseconds.
    pub minima: &'a [i64],
    /// The frames of the recording's movement.
    pub frames: Option<Frames>,
    /// The distance within which a time snaps to a boundary or minimum, in microseconds.
    pub reach: i64,
}

impl Guides<'_> {
    /// Returns the time to snap to and the reason; the time itself if nothing is near.
    #[must_use]
    pub fn settle(&self, micros: i64) -> (i64, Option<Catch>) {
        let boundary = self
            .snaps
            .boundaries
            .then(|| self.boundary(micros))
            .flatten();
        let minimum = self
            .snaps
            .minima
            .then(|| nearest(self.minima, micros))
            .flatten();
        let near = [(boundary, Catch::Boundary), (minimum, Catch::Minimum)]
            .into_iter()
            .filter_map(|(at, why)| Some((at?, why)))
            .filter(|(at, _)| (at - micros).abs() <= self.reach)
            .min_by_key(|(at, why)| ((at - micros).abs(), *why));
        match (near, self.frames.filter(|_| self.snaps.frames)) {
            (Some((at, why)), _) => (at, Some(why)),
            (None, Some(frames)) => (frames.nearest(micros), Some(Catch::Frame)),
            (None, None) => (micros, None),
        }
    }

    fn boundary(&self, micros: i64) -> Option<i64> {
        let inside = self.tiers.iter().flat_map(|tier| {
            let columns = &tier.annotations;
            let near = |all: &[i64]| {
                let after = all.partition_point(|at| *at < micros);
                let around = after.saturating_sub(2)..(after + 2).min(all.len());
                around
                    .filter(|at| !self.except.contains(&columns.ids[*at]))
                    .map(|at| all[at])
                    .min_by_key(|at| (at - micros).abs())
            };
            [near(&columns.starts), near(&columns.ends)]
        });
        let marks = self.marks.iter().copied();
        inside
            .flatten()
            .chain(marks)
            .min_by_key(|at| (at - micros).abs())
    }
}

fn nearest(sorted: &[i64], micros: i64) -> Option<i64> {
    let after = sorted.partition_point(|at| *at < micros);
    let around = after.saturating_sub(1)..(after + 1).min(sorted.len());
    sorted[around]
        .iter()
        .copied()
        .min_by_key(|at| (at - micros).abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contents::AnnotationColumns;

    fn tier(spans: &[(i64, i64)]) -> TierContents {
        let count = spans.len();
        TierContents {
            row: Default::default(),
            annotations: AnnotationColumns {
                ids: (1..=count as i64).collect(),
                starts: spans.iter().map(|it| it.0).collect(),
                ends: spans.iter().map(|it| it.1).collect(),
                ..AnnotationColumns::default()
            },
        }
    }

    #[test]
    fn a_nearby_boundary_or_minimum_takes_precedence_over_the_frame() {
        let tiers = [tier(&[(100_000, 233_000), (400_000, 500_000)])];
        let except = BTreeSet::from([2]);
        let guides = |snaps| Guides {
            snaps,
            tiers: &tiers,
            except: &except,
            marks: &[700_000],
            minima: &[236_000, 600_000],
            frames: Some(Frames {
                rate: Rate::new(100, 1).expect("a rate"),
                offset: 0,
            }),
            reach: 20_000,
        };
        let all = Snaps {
            frames: true,
            boundaries: true,
            minima: true,
        };
        let none = Snaps {
            frames: false,
            boundaries: false,
            minima: false,
        };
        let cases = [
            (all, 234_000, (233_000, Some(Catch::Boundary))),
            (all, 235_000, (236_000, Some(Catch::Minimum))),
            (all, 404_000, (400_000, Some(Catch::Frame))),
            (all, 605_000, (600_000, Some(Catch::Minimum))),
            (all, 705_001, (700_000, Some(Catch::Boundary))),
            (
                Snaps {
                    minima: false,
                    ..all
                },
                605_001,
                (610_000, Some(Catch::Frame)),
            ),
            (none, 605_001, (605_001, None)),
        ];
        for (snaps, at, want) in cases {
            assert_eq!(guides(snaps).settle(at), want, "{at}");
        }
    }

    #[test]
    fn steps_go_from_frame_to_frame() {
        let frames = Frames {
            rate: Rate::new(30, 1).expect("a rate"),
            offset: 5,
        };
        assert_eq!(frames.nearest(40_000), 33_333 + 5);
        assert_eq!(frames.stepped(33_000, 1), 66_667 + 5);
        assert_eq!(frames.stepped(33_000, -9), 5);
    }
}
