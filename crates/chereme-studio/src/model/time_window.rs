//! The visible part of a recording.

use chereme_motion::TimeSpan;
use serde::{Deserialize, Serialize};

/// Width of the widest window, as a multiple of the recording's length.
const WIDEST_WINDOW_FACTOR: f64 = 1.02;

/// The visible part of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct TimeWindow {
    /// The time at the left edge, in microseconds.
    pub(crate) start: f64,
    /// Microseconds per point.
    pub(crate) scale: f64,
}

impl TimeWindow {
    /// Returns the window that shows all of `whole`.
    pub(crate) fn window_of_whole(whole: TimeSpan, width: f32) -> Self {
        let micros = (whole.span_micros() as f64 * WIDEST_WINDOW_FACTOR).max(1000.0);
        Self {
            start: whole.span_start_instant().instant_micros() as f64,
            scale: micros / f64::from(width.max(1.0)),
        }
    }

    /// Returns the window that shows the time from `start` to `end` of a recording.
    pub(crate) fn window_of_range(start: f64, end: f64, whole: TimeSpan, width: f32) -> Self {
        let widest = Self::window_of_whole(whole, width).scale;
        // Not nearer than a tenth of a millisecond a point, unless the whole is shorter.
        let scale = ((end - start) / f64::from(width.max(1.0))).clamp(100.0_f64.min(widest), widest);
        Self { start, scale }.clamp_window_within(whole, width)
    }

    /// Returns the position of a time, in points from the left edge.
    pub(crate) fn time_to_points(&self, micros: f64) -> f32 {
        ((micros - self.start) / self.scale) as f32
    }

    /// Returns the time at a position in points from the left edge, in microseconds.
    pub(crate) fn points_to_micros(&self, x: f32) -> f64 {
        self.start + f64::from(x) * self.scale
    }

    /// Returns the window that shows `factor` times as much time, with the time `around` at its old position. It is
    /// never wider than `whole`, and shows at least 0.1 ms per point.
    pub(crate) fn zoomed_window(&self, factor: f64, around: f64, whole: TimeSpan, width: f32) -> Self {
        let widest = Self::window_of_whole(whole, width).scale;
        let scale = (self.scale * factor).clamp(100.0_f64.min(widest), widest);
        // The time at the pointer keeps its place in the window.
        let start = around - (around - self.start) * scale / self.scale;
        Self { start, scale }.clamp_window_within(whole, width)
    }

    /// Returns the window moved by `points`, within `whole`.
    pub(crate) fn panned_window(&self, points: f32, whole: TimeSpan, width: f32) -> Self {
        let start = self.start + f64::from(points) * self.scale;
        Self { start, ..*self }.clamp_window_within(whole, width)
    }

    /// Returns a window that contains `micros`: the next page if it lies outside.
    pub(crate) fn window_following_time(&self, micros: f64, whole: TimeSpan, width: f32) -> Self {
        let x = self.time_to_points(micros);
        if (0.0..=width).contains(&x) {
            return *self;
        }
        // A tenth of the page before the time keeps what led to it in sight.
        let start = micros - f64::from(width) * self.scale * 0.1;
        Self { start, ..*self }.clamp_window_within(whole, width)
    }

    pub(crate) fn clamp_window_within(self, whole: TimeSpan, width: f32) -> Self {
        let (first, end) = (
            whole.span_start_instant().instant_micros() as f64,
            whole.span_end_instant().instant_micros() as f64,
        );
        let last = (end - f64::from(width) * self.scale / WIDEST_WINDOW_FACTOR).max(first);
        Self {
            start: self.start.clamp(first, last),
            ..self
        }
    }
}
