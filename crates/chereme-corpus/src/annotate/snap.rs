//! Snapping of times: to boundaries of annotations, minima of wrist speed, starts of frames.

use std::collections::BTreeSet;

use chereme_motion::{FrameRate, RecordingInstant};
use serde::{Deserialize, Serialize};

use crate::contents::TierContents;

/// The kinds of times that a drag snaps to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct SnapKinds {
    /// Starts of frames.
    pub frames: bool,
    /// Boundaries of annotations.
    pub boundaries: bool,
    /// Minima of wrist speed.
    pub minima: bool,
}

impl Default for SnapKinds {
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
pub enum SnapTarget {
    /// The boundary of an annotation, or a mark.
    Boundary,
    /// A minimum of wrist speed.
    Minimum,
    /// The start of a frame.
    Frame,
}

/// Frame times of a recording: the rate, and the offset of the first frame on the recording's clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordingFrameTimes {
    /// The number of frames per second.
    pub rate: FrameRate,
    /// The start of the first frame, in microseconds.
    pub offset: i64,
}

impl RecordingFrameTimes {
    /// Returns the start of a frame, in microseconds.
    #[must_use]
    pub fn snap_frame_start(&self, frame: u64) -> i64 {
        let frame = usize::try_from(frame).unwrap_or(usize::MAX);
        self.rate.frame_start_instant(frame).instant_micros() + self.offset
    }

    /// Returns the start of the frame nearest to a time.
    #[must_use]
    pub fn nearest_frame_start(&self, micros: i64) -> i64 {
        // There is no frame before the first one.
        let local_micros = (micros - self.offset).max(0);
        let frame = self.rate.nearest_frame_at(RecordingInstant::from_micros(local_micros));
        self.rate.frame_start_instant(frame).instant_micros() + self.offset
    }

    /// Returns the start of the frame `by` frames after the one nearest to a time.
    #[must_use]
    pub fn stepped_frame_start(&self, micros: i64, by: i64) -> i64 {
        let local_micros = (self.nearest_frame_start(micros) - self.offset).max(0);
        let signed_frame = self.rate.nearest_frame_at(RecordingInstant::from_micros(local_micros)) as i64 + by;
        let frame = usize::try_from(signed_frame).unwrap_or_default();
        self.rate.frame_start_instant(frame).instant_micros() + self.offset
    }
}

/// The snapping targets of a drag.
#[derive(Debug)]
pub struct SnapGuides<'a> {
    /// The kinds of times to snap to.
    pub snaps: SnapKinds,
    /// The tiers whose boundaries are targets.
    pub tiers: &'a [TierContents],
    /// The dragged annotations, whose boundaries are no targets.
    pub except: &'a BTreeSet<i64>,
    /// Further times that are treated as boundaries, such as the playhead.
    pub marks: &'a [i64],
    /// Minima of wrist speed, in order, in microseconds.
    pub minima: &'a [i64],
    /// The frames of the recording's movement.
    pub frames: Option<RecordingFrameTimes>,
    /// The distance within which a time snaps to a boundary or minimum, in microseconds.
    pub reach: i64,
}

impl SnapGuides<'_> {
    /// Returns the time to snap to and the reason; the time itself if nothing is near.
    #[must_use]
    pub fn snap_time(&self, micros: i64) -> (i64, Option<SnapTarget>) {
        let boundary = self
            .snaps
            .boundaries
            .then(|| self.nearest_boundary_time(micros))
            .flatten();
        let minimum = self
            .snaps
            .minima
            .then(|| nearest_sorted_time(self.minima, micros))
            .flatten();
        let near = [(boundary, SnapTarget::Boundary), (minimum, SnapTarget::Minimum)]
            .into_iter()
            .filter_map(|(at, why)| Some((at?, why)))
            .filter(|(at, _)| (at - micros).abs() <= self.reach)
            .min_by_key(|(at, why)| ((at - micros).abs(), *why));
        match (near, self.frames.filter(|_| self.snaps.frames)) {
            (Some((at, why)), _) => (at, Some(why)),
            (None, Some(frames)) => (frames.nearest_frame_start(micros), Some(SnapTarget::Frame)),
            (None, None) => (micros, None),
        }
    }

    fn nearest_boundary_time(&self, micros: i64) -> Option<i64> {
        let inside = self.tiers.iter().flat_map(|tier| {
            let columns = &tier.annotations;
            let near = |all: &[i64]| {
                let after = all.partition_point(|at| *at < micros);
                // The nearest ones may be those that are dragged, which do not count.
                let around = after.saturating_sub(2)..(after + 2).min(all.len());
                around
                    .filter(|at| !self.except.contains(&columns.ids[*at]))
                    .map(|at| all[at])
                    .min_by_key(|at| (at - micros).abs())
            };
            [near(&columns.starts), near(&columns.ends)]
        });
        let marks = self.marks.iter().copied();
        inside.flatten().chain(marks).min_by_key(|at| (at - micros).abs())
    }
}

fn nearest_sorted_time(sorted: &[i64], micros: i64) -> Option<i64> {
    let after = sorted.partition_point(|at| *at < micros);
    let around = after.saturating_sub(1)..(after + 1).min(sorted.len());
    sorted[around].iter().copied().min_by_key(|at| (at - micros).abs())
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
        let guides = |snaps| SnapGuides {
            snaps,
            tiers: &tiers,
            except: &except,
            marks: &[700_000],
            minima: &[236_000, 600_000],
            frames: Some(RecordingFrameTimes {
                rate: FrameRate::new(100, 1).expect("a rate"),
                offset: 0,
            }),
            reach: 20_000,
        };
        let all = SnapKinds {
            frames: true,
            boundaries: true,
            minima: true,
        };
        let none = SnapKinds {
            frames: false,
            boundaries: false,
            minima: false,
        };
        let cases = [
            (all, 234_000, (233_000, Some(SnapTarget::Boundary))),
            (all, 235_000, (236_000, Some(SnapTarget::Minimum))),
            (all, 404_000, (400_000, Some(SnapTarget::Frame))),
            (all, 605_000, (600_000, Some(SnapTarget::Minimum))),
            (all, 705_001, (700_000, Some(SnapTarget::Boundary))),
            (
                SnapKinds { minima: false, ..all },
                605_001,
                (610_000, Some(SnapTarget::Frame)),
            ),
            (none, 605_001, (605_001, None)),
        ];
        for (snaps, at, want) in cases {
            assert_eq!(guides(snaps).snap_time(at), want, "{at}");
        }
    }

    #[test]
    fn steps_go_from_frame_to_frame() {
        let frames = RecordingFrameTimes {
            rate: FrameRate::new(30, 1).expect("a rate"),
            offset: 5,
        };
        assert_eq!(frames.nearest_frame_start(40_000), 33_333 + 5);
        assert_eq!(frames.stepped_frame_start(33_000, 1), 66_667 + 5);
        assert_eq!(frames.stepped_frame_start(33_000, -9), 5);
    }
}
