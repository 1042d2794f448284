//! Instants, spans and frame rates: integer microseconds, half-open spans, rational rates.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;

const MICROS_PER_SECOND: i128 = 1_000_000;

/// A moment, in microseconds from the start of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RecordingInstant(i64);

impl RecordingInstant {
    /// The start of the recording.
    pub const RECORDING_START: Self = Self(0);

    /// Returns the instant `micros` microseconds after the start.
    #[must_use]
    pub const fn from_micros(micros: i64) -> Self {
        Self(micros)
    }

    /// Returns the instant `millis` milliseconds after the start, as ELAN counts; it saturates at the ends of the
    /// range.
    #[must_use]
    pub const fn from_millis(millis: i64) -> Self {
        Self(millis.saturating_mul(1000))
    }

    /// Returns the instant nearest to `seconds` after the start; it saturates, and NaN is the start.
    #[must_use]
    pub fn from_seconds(seconds: f64) -> Self {
        Self((seconds * 1e6).round() as i64)
    }

    /// Returns the microseconds from the start.
    #[must_use]
    pub const fn instant_micros(self) -> i64 {
        self.0
    }

    /// Returns the milliseconds from the start, halves rounded up.
    #[must_use]
    pub const fn instant_millis(self) -> i64 {
        // Half a millisecond is added so that a floor becomes a rounding, also below zero.
        self.0.saturating_add(500).div_euclid(1000)
    }

    /// Returns the seconds from the start.
    #[must_use]
    pub fn instant_seconds(self) -> f64 {
        self.0 as f64 / 1e6
    }

    /// Returns the instant moved by `micros` microseconds; it saturates.
    #[must_use]
    pub const fn shifted_instant(self, micros: i64) -> Self {
        Self(self.0.saturating_add(micros))
    }
}

impl fmt::Display for RecordingInstant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3}s", self.instant_seconds())
    }
}

/// A half-open span of time: it includes its start and excludes its end, and is never negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(try_from = "RawSpan", into = "RawSpan")]
pub struct TimeSpan {
    start: RecordingInstant,
    end: RecordingInstant,
}

#[derive(Serialize, Deserialize)]
struct RawSpan {
    start_us: i64,
    end_us: i64,
}

impl TryFrom<RawSpan> for TimeSpan {
    type Error = SpanError;
    fn try_from(raw: RawSpan) -> Result<Self, SpanError> {
        Self::new(RecordingInstant(raw.start_us), RecordingInstant(raw.end_us))
    }
}

impl From<TimeSpan> for RawSpan {
    fn from(span: TimeSpan) -> Self {
        Self {
            start_us: span.start.0,
            end_us: span.end.0,
        }
    }
}

/// A span whose end is before its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a span cannot end ({end}) before it starts ({start})")]
pub struct SpanError {
    /// The requested start.
    pub start: RecordingInstant,
    /// The requested end.
    pub end: RecordingInstant,
}

impl TimeSpan {
    /// Returns the span from `start` up to `end`, excluding `end`; equal ends give an empty span.
    ///
    /// # Errors
    /// [`SpanError`] if `end` is before `start`.
    pub fn new(start: RecordingInstant, end: RecordingInstant) -> Result<Self, SpanError> {
        if end < start {
            Err(SpanError { start, end })
        } else {
            Ok(Self { start, end })
        }
    }

    /// Returns the span between two instants, whichever comes first.
    #[must_use]
    pub fn span_between(a: RecordingInstant, b: RecordingInstant) -> Self {
        Self {
            start: a.min(b),
            end: a.max(b),
        }
    }

    /// Returns the span between two times in microseconds, whichever comes first.
    #[must_use]
    pub fn from_span_micros(a: i64, b: i64) -> Self {
        Self::span_between(RecordingInstant::from_micros(a), RecordingInstant::from_micros(b))
    }

    /// Returns the start and the end of the span in microseconds.
    #[must_use]
    pub const fn span_bounds_micros(self) -> (i64, i64) {
        (self.start.instant_micros(), self.end.instant_micros())
    }

    /// Returns the first instant of the span.
    #[must_use]
    pub const fn span_start_instant(self) -> RecordingInstant {
        self.start
    }

    /// Returns the first instant after the span.
    #[must_use]
    pub const fn span_end_instant(self) -> RecordingInstant {
        self.end
    }

    /// Returns the length in microseconds.
    #[must_use]
    pub const fn span_micros(self) -> i64 {
        self.end.0.saturating_sub(self.start.0)
    }

    /// Returns the length in seconds.
    #[must_use]
    pub fn span_seconds(self) -> f64 {
        self.span_micros() as f64 / 1e6
    }

    /// Returns whether the span contains no instant.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }

    /// Returns whether `instant` lies in the span.
    #[must_use]
    pub fn has_instant(self, instant: RecordingInstant) -> bool {
        self.start <= instant && instant < self.end
    }

    /// Returns whether `other` lies completely in the span.
    #[must_use]
    pub fn has_span_inside(self, other: Self) -> bool {
        self.start <= other.start && other.end <= self.end
    }

    /// Returns the common part of both spans; `None` if they share no instant.
    #[must_use]
    pub fn span_intersection(self, other: Self) -> Option<Self> {
        let (start, end) = (self.start.max(other.start), self.end.min(other.end));
        (start < end).then_some(Self { start, end })
    }

    /// Returns the smallest span that contains both.
    #[must_use]
    pub fn enclosing_span(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Returns whether the spans share an instant.
    #[must_use]
    pub fn is_overlapping_span(self, other: Self) -> bool {
        self.span_intersection(other).is_some()
    }

    /// Returns the span moved by `micros` microseconds; it saturates.
    #[must_use]
    pub const fn shifted_span(self, micros: i64) -> Self {
        Self {
            start: self.start.shifted_instant(micros),
            end: self.end.shifted_instant(micros),
        }
    }
}

/// A frame rate in frames per second, as a fraction in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "RawRate", into = "RawRate")]
pub struct FrameRate {
    frames: u32,
    seconds: u32,
}

#[derive(Serialize, Deserialize)]
struct RawRate {
    frames: u32,
    seconds: u32,
}

impl TryFrom<RawRate> for FrameRate {
    type Error = RateError;
    fn try_from(raw: RawRate) -> Result<Self, RateError> {
        Self::new(raw.frames, raw.seconds)
    }
}

impl From<FrameRate> for RawRate {
    fn from(rate: FrameRate) -> Self {
        Self {
            frames: rate.frames,
            seconds: rate.seconds,
        }
    }
}

/// An invalid frame rate.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RateError {
    /// One of the two numbers of the fraction is zero.
    #[error("a frame rate of {frames}/{seconds} is not a rate; both numbers must be above zero")]
    Zero {
        /// Frames.
        frames: u32,
        /// Seconds they take.
        seconds: u32,
    },
    /// The frame time is not a positive number of seconds between a microsecond and a day.
    #[error("a frame time of {0:?} s is not one; it must lie between 0.000001 and 86400 seconds")]
    FrameTime(f64),
}

/// Frame rates that exporters round in a frame time, as frames and seconds.
const COMMON_RATES: [(u32, u32); 6] = [
    (24_000, 1001),
    (30_000, 1001),
    (48_000, 1001),
    (60_000, 1001),
    (120_000, 1001),
    (240_000, 1001),
];

impl FrameRate {
    /// Returns the rate of `frames` frames in `seconds` seconds.
    ///
    /// # Errors
    /// [`RateError::Zero`] if either is zero.
    pub fn new(frames: u32, seconds: u32) -> Result<Self, RateError> {
        if frames == 0 || seconds == 0 {
            return Err(RateError::Zero { frames, seconds });
        }
        let divisor = gcd(frames, seconds);
        Ok(Self {
            frames: frames / divisor,
            seconds: seconds / divisor,
        })
    }

    /// Returns the rate for a frame time of `seconds`, written with `decimals` decimals. If the frame time is a
    /// rounding or truncation of a whole or broadcast rate (n·1000/1001, often typed as 23.976 or 29.97), within two
    /// millionths or its last decimal, it is that rate; else the nearest fraction in whole microseconds.
    ///
    /// # Errors
    /// [`RateError::FrameTime`] if `seconds` is not between a microsecond and a day.
    pub fn from_frame_time(seconds: f64, decimals: u32) -> Result<Self, RateError> {
        if !(1e-6..=86_400.0).contains(&seconds) {
            return Err(RateError::FrameTime(seconds));
        }
        // The last written decimal, or two millionths where more decimals are written than are true.
        let step = 10f64.powi(-(decimals.min(15) as i32)).max(seconds * 2e-6);
        let nearest_whole = (1.0 / seconds).round();
        let whole_rate =
            (nearest_whole >= 1.0 && nearest_whole <= f64::from(u32::MAX)).then_some((nearest_whole as u32, 1));
        let nearest = whole_rate
            .into_iter()
            .chain(COMMON_RATES)
            .map(|(f, s)| ((f64::from(s) / f64::from(f) - seconds).abs(), f, s))
            // Half a percent at most: a rate of few decimals must not become the next one.
            .filter(|(error, f, s)| *error <= step && *error < 0.005 * f64::from(*s) / f64::from(*f))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, frames, per)) = nearest {
            return Self::new(frames, per);
        }
        let micros = (seconds * 1e6).round();
        // Frame times of over an hour and eleven minutes do not fit a u32 of microseconds.
        if micros <= f64::from(u32::MAX) {
            Self::new(1_000_000, micros as u32)
        } else {
            Self::new(1, seconds.round() as u32)
        }
    }

    /// Returns the numerator: frames in [`per_seconds`](Self::per_seconds) seconds.
    #[must_use]
    pub const fn rate_numerator(self) -> u32 {
        self.frames
    }

    /// Returns the denominator: the seconds for [`rate_numerator`](Self::rate_numerator) frames.
    #[must_use]
    pub const fn per_seconds(self) -> u32 {
        self.seconds
    }

    /// Returns the frames per second.
    #[must_use]
    pub fn per_second(self) -> f64 {
        f64::from(self.frames) / f64::from(self.seconds)
    }

    /// Returns the length of one frame in seconds.
    #[must_use]
    pub fn frame_time(self) -> f64 {
        f64::from(self.seconds) / f64::from(self.frames)
    }

    /// Returns the instant at which frame number `frame` (from 0) starts, rounded to the
    /// microsecond; it saturates.
    #[must_use]
    pub fn frame_start_instant(self, frame: usize) -> RecordingInstant {
        // 128 bits, since frame times the denominator times a million exceeds 64 bits.
        let numerator = frame as i128 * i128::from(self.seconds) * MICROS_PER_SECOND;
        let micros = div_round(numerator, i128::from(self.frames));
        RecordingInstant(i64::try_from(micros).unwrap_or(i64::MAX))
    }

    /// Returns the frame whose start is nearest to `instant`; before the start it is frame 0.
    ///
    /// Up to 1 kHz `frame_at(instant(f)) == f` for every `f`.
    #[must_use]
    pub fn nearest_frame_at(self, instant: RecordingInstant) -> usize {
        let numerator = i128::from(instant.0.max(0)) * i128::from(self.frames);
        let frame = div_round(numerator, i128::from(self.seconds) * MICROS_PER_SECOND);
        usize::try_from(frame).unwrap_or(usize::MAX)
    }

    /// Returns the frames whose starts lie in `span`; a start within half a microsecond of the span's ends counts as
    /// exactly there.
    #[must_use]
    pub fn frames_in(self, span: TimeSpan) -> Range<usize> {
        self.first_from(span.start)..self.first_from(span.end)
    }

    /// Returns the span of the frames in `frames`.
    #[must_use]
    pub fn frame_range_span(self, frames: Range<usize>) -> TimeSpan {
        TimeSpan::span_between(
            self.frame_start_instant(frames.start),
            self.frame_start_instant(frames.end),
        )
    }

    fn first_from(self, instant: RecordingInstant) -> usize {
        // The nearest frame may start just before the instant; then the next one is the first from it.
        let near = self.nearest_frame_at(instant);
        if self.frame_start_instant(near) < instant {
            near.saturating_add(1)
        } else {
            near
        }
    }
}

impl fmt::Display for FrameRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.seconds == 1 {
            write!(f, "{} fps", self.frames)
        } else {
            write!(f, "{:.3} fps", self.per_second())
        }
    }
}

fn div_round(numerator: i128, denominator: i128) -> i128 {
    // Doubles both, so that half a denominator is added without a fraction.
    (numerator * 2 + denominator).div_euclid(denominator * 2)
}

fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn frame_times_of_common_exporters_give_exact_rates() {
        for (seconds, decimals, frames, per) in [
            (0.033333, 6, 30, 1),
            (0.0333333, 7, 30, 1),
            (0.03333333333333333, 17, 30, 1),
            (0.008333, 6, 120, 1),
            (0.0083333, 7, 120, 1),
            (0.041667, 6, 24, 1),
            (0.0416667, 7, 24, 1),
            (0.041_708_375_041_7, 13, 24_000, 1001),
            (0.0333667, 7, 30_000, 1001),
            (0.01, 6, 100, 1),
            (0.016666666666666666, 18, 60, 1),
            (0.04, 2, 25, 1),
            (1.0, 0, 1, 1),
            (0.002, 3, 500, 1),
        ] {
            let rate = FrameRate::from_frame_time(seconds, decimals).expect("a rate");
            assert_eq!((rate.rate_numerator(), rate.per_seconds()), (frames, per), "{seconds}");
        }
        for bad in [0.0, -0.01, f64::NAN, f64::INFINITY, 1e-9, 1e9, 1e300, 1e-300] {
            let error = FrameRate::from_frame_time(bad, 6).expect_err("no rate");
            assert!(error.to_string().len() < 120, "{error}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]

        #[test]
        fn frames_convert_in_both_directions_up_to_1_khz(
            frames in 1u32..=1_000_000, seconds in 1u32..=2000, frame in 0usize..10_000_000
        ) {
            prop_assume!(frames <= seconds * 1000);
            let rate = FrameRate::new(frames, seconds).expect("a rate");
            prop_assert_eq!(rate.nearest_frame_at(rate.frame_start_instant(frame)), frame);
        }

        #[test]
        fn frames_to_span_to_frames_is_the_identity(first in 0usize..100_000, count in 0usize..1000) {
            let rate = FrameRate::new(120_000, 1001).expect("a rate");
            prop_assert_eq!(rate.frames_in(rate.frame_range_span(first..first + count)), first..first + count);
        }

        #[test]
        fn an_intersection_is_covered_by_both_spans(a in -50i64..50, b in -50i64..50, c in -50i64..50, d in -50i64..50) {
            let x = TimeSpan::span_between(RecordingInstant(a), RecordingInstant(b));
            let y = TimeSpan::span_between(RecordingInstant(c), RecordingInstant(d));
            prop_assert_eq!(x.span_intersection(y), y.span_intersection(x));
            if let Some(both) = x.span_intersection(y) {
                prop_assert!(x.has_span_inside(both) && y.has_span_inside(both) && !both.is_empty());
            }
        }
    }
}
