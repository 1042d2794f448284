//! The outlines of a hand over time.

use super::plan::SignPlan;
use super::stage::{HandOutline, Stage};
use super::track::{Timing, early, nlerp, shape_spans};

/// The outlines of a hand over time, as two outlines from each frame on that bracket the actual one during
/// a change of shape.
pub(crate) struct Outlines<'a> {
    /// Index of the first frame.
    pub(super) first: usize,
    from: Vec<(usize, [Outline<'a>; 2])>,
    between: Vec<HandOutline>,
}

/// The outline of a shape, or an intermediate one by its index.
#[derive(Clone, Copy)]
enum Outline<'a> {
    Shape(&'a HandOutline),
    Between(usize),
}

/// The number of steps for the outlines of a change of shape.
const STEPS: usize = 4;

impl<'a> Outlines<'a> {
    /// Returns the outlines of a hand of a plan.
    pub(super) fn of(stage: &Stage, plan: &'a SignPlan, n: usize, timing: &Timing<'_>) -> Self {
        let shapes = &plan.shapes[n];
        let of = |shape: usize| Outline::Shape(&shapes[shape].outline);
        let mut now = plan.start[n].shape;
        let mut from = vec![(0, [of(now); 2])];
        let mut between = Vec::new();
        for (span, shape, event) in shape_spans(&plan.events[n], timing.rate, timing.total) {
            let mut steps = vec![of(now)];
            for step in 1..STEPS {
                let share = step as f64 / STEPS as f64;
                let turns = shapes[now].rotations.iter().zip(&shapes[shape].rotations);
                let turns = turns.map(|(a, b)| nlerp(*a, *b, share)).collect();
                between.push(stage.outline(plan.sides[n], turns));
                steps.push(Outline::Between(between.len() - 1));
            }
            steps.push(of(shape));
            let mut last = None;
            for frame in span.clone() {
                let share = early(event, frame, timing);
                let step = ((share * STEPS as f64) as usize).min(STEPS - 1);
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

impl Outlines<'_> {
    pub(crate) fn at(&self, frame: usize) -> [&HandOutline; 2] {
        let n = self
            .from
            .partition_point(|&(from, ..)| from <= self.first + frame);
        self.from[n.saturating_sub(1)]
            .1
            .map(|outline| match outline {
                Outline::Shape(outline) => outline,
                Outline::Between(n) => &self.between[n],
            })
    }
}
