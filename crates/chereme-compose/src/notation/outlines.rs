//! The outlines of a hand over time.

use super::notation_plan::SignPlan;
use super::notation_stage::{HandOutline, StandingBody};
use super::notation_track::{AnimationTiming, early_shape_share, lerp_rotations_normalized, shape_spans};

/// The outlines of a hand over time, as two outlines from each frame on that bracket the actual one during
/// a change of shape.
pub(crate) struct OutlineTrack<'a> {
    /// Index of the first frame.
    pub(super) first: usize,
    from: Vec<(usize, [TrackedOutline<'a>; 2])>,
    between: Vec<HandOutline>,
}

/// The outline of a shape, or an intermediate one by its index.
#[derive(Clone, Copy)]
enum TrackedOutline<'a> {
    Shape(&'a HandOutline),
    Between(usize),
}

/// The number of steps for the outlines of a change of shape.
const OUTLINE_CHANGE_STEPS: usize = 4;

impl<'a> OutlineTrack<'a> {
    /// Returns the outlines of a hand of a plan.
    pub(super) fn outlines_from_plan(
        stage: &StandingBody,
        plan: &'a SignPlan,
        n: usize,
        timing: &AnimationTiming<'_>,
    ) -> Self {
        let shapes = &plan.shapes[n];
        let of = |shape: usize| TrackedOutline::Shape(&shapes[shape].outline);
        let mut now = plan.start[n].shape;
        let mut from = vec![(0, [of(now); 2])];
        let mut between = Vec::new();
        for (span, shape, event) in shape_spans(&plan.events[n], timing.rate, timing.total) {
            let mut steps = vec![of(now)];
            for step in 1..OUTLINE_CHANGE_STEPS {
                let share = step as f64 / OUTLINE_CHANGE_STEPS as f64;
                let turn_pairs = shapes[now].rotations.iter().zip(&shapes[shape].rotations);
                let turns = turn_pairs
                    .map(|(a, b)| lerp_rotations_normalized(*a, *b, share))
                    .collect();
                between.push(stage.hand_outline(plan.sides[n], turns));
                steps.push(TrackedOutline::Between(between.len() - 1));
            }
            steps.push(of(shape));
            let mut last = None;
            for frame in span.clone() {
                let share = early_shape_share(event, frame, timing);
                let step = ((share * OUTLINE_CHANGE_STEPS as f64) as usize).min(OUTLINE_CHANGE_STEPS - 1);
                if last.replace(step) != Some(step) {
                    from.push((frame, [steps[step], steps[step + 1]]));
                }
            }
            from.push((span.end, [of(shape); 2]));
            now = shape;
        }
        Self {
            first: 0,
            from,
            between,
        }
    }
}

impl OutlineTrack<'_> {
    pub(crate) fn outlines_at_frame(&self, frame: usize) -> [&HandOutline; 2] {
        let n = self.from.partition_point(|&(from, ..)| from <= self.first + frame);
        self.from[n.saturating_sub(1)].1.map(|outline| match outline {
            TrackedOutline::Shape(outline) => outline,
            TrackedOutline::Between(n) => &self.between[n],
        })
    }
}
