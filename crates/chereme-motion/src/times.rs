//! The times of a track's frames: at an even rate, or each with its own time.

use crate::column::FrameNumberColumn;
use crate::time::{FrameRate, RecordingInstant, TimeSpan};

/// The times of frames, counted from the start of their track.
#[derive(Debug, Clone, PartialEq)]
pub enum FrameTimes {
    /// Frame `n` is `n` frame times after the start.
    Even(FrameRate),
    /// Each frame has its own time.
    Listed(ListedTimes),
}

/// Times in seconds, exactly as the file gives them: without gaps, each later than the one before.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedTimes(FrameNumberColumn);

/// A reason why numbers are not times.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TimesError {
    /// A frame has no time.
    #[error("frame {0} has no time")]
    Gap(usize),
    /// A time is not later than the one before it.
    #[error("the time of frame {frame}, {seconds} s, is not later than that of the frame before")]
    Order {
        /// The frame, from 0.
        frame: usize,
        /// Its time.
        seconds: f64,
    },
    /// A time lies more than a hundred years from the start.
    #[error("the time of frame {frame}, {seconds} s, is out of range")]
    Range {
        /// The frame, from 0.
        frame: usize,
        /// Its time.
        seconds: f64,
    },
}

/// A hundred years in seconds.
const MAX_LISTED_SECONDS: f64 = 3.2e9;

/// The shortest pause between two frames that counts as a gap, in microseconds.
const LEAST_GAP: i64 = 250_000;
/// The shortest pause between two frames that counts as a gap, in usual steps.
const GAP_STEPS: i64 = 3;

impl ListedTimes {
    /// Returns the times of a column of seconds.
    ///
    /// # Errors
    /// [`TimesError`] if a frame has no time, or a time is not later than the one before.
    pub fn new(seconds: FrameNumberColumn) -> Result<Self, TimesError> {
        let mut before = f64::NEG_INFINITY;
        for (frame, time) in seconds.column_values().enumerate() {
            let seconds = time.ok_or(TimesError::Gap(frame))?;
            if seconds.abs() > MAX_LISTED_SECONDS {
                return Err(TimesError::Range { frame, seconds });
            }
            if seconds <= before {
                return Err(TimesError::Order { frame, seconds });
            }
            before = seconds;
        }
        Ok(Self(seconds))
    }

    /// Returns the seconds as the file gives them.
    #[must_use]
    pub fn listed_seconds(&self) -> &FrameNumberColumn {
        &self.0
    }

    /// Returns the even rate whose frames are within `tolerance` seconds of the times, counted from the first one;
    /// `None` if there is no such rate, or if there are fewer than two times.
    #[must_use]
    pub fn infer_even_rate(&self, tolerance: f64) -> Option<FrameRate> {
        let times: Vec<f64> = self.0.column_values().flatten().collect();
        let (first, last) = (*times.first()?, *times.last()?);
        let step = (last - first) / (times.len() - 1).max(1) as f64;
        // The mean step is taken as a frame time written with six decimals.
        let rate = FrameRate::from_frame_time(step, 6).ok()?;
        let near = |(frame, time): (usize, &f64)| (time - first - frame as f64 * rate.frame_time()).abs() <= tolerance;
        (times.len() > 1 && times.iter().enumerate().all(near)).then_some(rate)
    }
}

impl FrameTimes {
    /// Returns the times of a column of seconds.
    ///
    /// # Errors
    /// The errors of [`ListedTimes::new`].
    pub fn from_listed_seconds(seconds: FrameNumberColumn) -> Result<Self, TimesError> {
        ListedTimes::new(seconds).map(Self::Listed)
    }

    /// Returns the even rate; `None` if frames have their own times.
    #[must_use]
    pub fn even_times_rate(&self) -> Option<FrameRate> {
        match self {
            Self::Even(rate) => Some(*rate),
            Self::Listed(_) => None,
        }
    }

    /// Returns the number of frames that have a time; `None` if there is no limit.
    #[must_use]
    pub fn timed_frame_count(&self) -> Option<usize> {
        match self {
            Self::Even(_) => None,
            Self::Listed(listed) => Some(listed.0.len()),
        }
    }

    /// Returns the time of `frame`, rounded to the microsecond; after the last listed frame, its time.
    #[must_use]
    pub fn frame_time_instant(&self, frame: usize) -> RecordingInstant {
        match self {
            Self::Even(rate) => rate.frame_start_instant(frame),
            Self::Listed(ListedTimes(seconds)) => {
                let frame = frame.min(seconds.len().saturating_sub(1));
                RecordingInstant::from_seconds(seconds.column_value_at(frame).unwrap_or_default())
            }
        }
    }

    /// Returns the index of the frame that `instant` shows, out of `frames`: the last one that is not after it, else
    /// the first. At an even rate it is the nearest one, as for a clip.
    #[must_use]
    pub fn shown_frame_at(&self, instant: RecordingInstant, frames: usize) -> Option<usize> {
        let last = frames.checked_sub(1)?;
        Some(match self {
            Self::Even(rate) => rate.nearest_frame_at(instant).min(last),
            Self::Listed(_) => self.first_after(instant, frames).saturating_sub(1),
        })
    }

    /// Returns the span of `frames` frames: from the first to the end of the last. The last listed frame lasts as long
    /// as the median of the others, and a single one has no duration.
    #[must_use]
    pub fn frame_times_span(&self, frames: usize) -> TimeSpan {
        let Self::Listed(ListedTimes(seconds)) = self else {
            let Self::Even(rate) = self else {
                return TimeSpan::default();
            };
            return rate.frame_range_span(0..frames);
        };
        let Some(last) = frames.min(seconds.len()).checked_sub(1) else {
            return TimeSpan::default();
        };
        let step = self.usual_step(frames);
        TimeSpan::span_between(
            self.frame_time_instant(0),
            self.frame_time_instant(last).shifted_instant(step),
        )
    }

    /// Returns the usual time from one of `frames` frames to the next, in microseconds: the median; 0 for a single
    /// listed frame.
    #[must_use]
    pub fn usual_step(&self, frames: usize) -> i64 {
        if let Self::Even(rate) = self {
            return rate.frame_start_instant(1).instant_micros();
        }
        // The median is not misled by pauses, which a mean is.
        let mut steps: Vec<i64> = (1..frames.min(self.timed_frame_count().unwrap_or(frames)))
            .map(|frame| {
                self.frame_time_instant(frame).instant_micros() - self.frame_time_instant(frame - 1).instant_micros()
            })
            .collect();
        steps.sort_unstable();
        steps.get(steps.len() / 2).copied().unwrap_or_default()
    }

    /// Returns the longest time between two of `frames` frames across which values may be blended, in microseconds; a
    /// longer one is a gap, in which nothing was measured. It is a quarter of a second, or three usual steps if those
    /// are longer.
    #[must_use]
    pub fn longest_step(&self, frames: usize) -> i64 {
        // Slow tracks have long steps that are no gaps.
        LEAST_GAP.max(self.usual_step(frames).saturating_mul(GAP_STEPS))
    }

    /// Returns the gaps among `frames` frames: each from the frame before it to the frame after it.
    #[must_use]
    pub fn frame_time_gaps(&self, frames: usize) -> Vec<TimeSpan> {
        let Self::Listed(_) = self else {
            return Vec::new();
        };
        let longest = self.longest_step(frames);
        (1..frames.min(self.timed_frame_count().unwrap_or(frames)))
            .map(|frame| TimeSpan::span_between(self.frame_time_instant(frame - 1), self.frame_time_instant(frame)))
            .filter(|span| span.span_micros() > longest)
            .collect()
    }

    /// Returns those of `frames` whose times lie in `span`.
    #[must_use]
    pub fn frames_in(&self, span: TimeSpan, frames: usize) -> std::ops::Range<usize> {
        match self {
            Self::Even(rate) => {
                let range = rate.frames_in(span);
                range.start.min(frames)..range.end.min(frames)
            }
            Self::Listed(_) => {
                // A frame exactly at the start is in the half-open span, hence the microsecond less.
                let before = |at: RecordingInstant| self.first_after(at.shifted_instant(-1), frames);
                before(span.span_start_instant())..before(span.span_end_instant())
            }
        }
    }

    /// Returns the first of `frames` that is after `instant`, `frames` if none of them is.
    fn first_after(&self, instant: RecordingInstant, frames: usize) -> usize {
        let (mut low, mut high) = (0, frames);
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.frame_time_instant(middle) <= instant {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(seconds: &[f64]) -> FrameTimes {
        FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.to_vec())).expect("times")
    }

    #[test]
    fn listed_times_show_the_frame_that_began_last() {
        let times = listed(&[0.5, 0.53, 0.6, 0.63]);
        let at = |seconds| times.shown_frame_at(RecordingInstant::from_seconds(seconds), 4);
        assert_eq!(
            [at(0.0), at(0.5), at(0.52), at(0.6), at(0.62), at(9.0)],
            [Some(0), Some(0), Some(0), Some(2), Some(2), Some(3)]
        );
        assert_eq!(
            times.frame_times_span(4),
            TimeSpan::span_between(
                RecordingInstant::from_seconds(0.5),
                RecordingInstant::from_seconds(0.66)
            )
        );
        let span = |a, b| TimeSpan::span_between(RecordingInstant::from_seconds(a), RecordingInstant::from_seconds(b));
        assert_eq!(times.frames_in(span(0.5, 0.6), 4), 0..2);
        assert_eq!(times.frames_in(span(0.51, 9.0), 4), 1..4);
        assert_eq!(times.shown_frame_at(RecordingInstant::RECORDING_START, 0), None);
        assert_eq!(listed(&[2.0]).frame_times_span(1).span_micros(), 0);
    }

    #[test]
    fn pauses_of_several_usual_steps_are_gaps() {
        let gaps = |seconds: &[f64]| -> Vec<(i64, i64)> {
            let times = listed(seconds);
            let ends = |it: &TimeSpan| it.span_bounds_micros();
            times.frame_time_gaps(seconds.len()).iter().map(ends).collect()
        };
        // At 10 frames a second three steps are longer than a quarter of a second.
        assert_eq!(gaps(&[0.0, 0.1, 0.2, 0.5, 0.6]), []);
        assert_eq!(gaps(&[0.0, 0.1, 0.2, 0.6, 0.7]), [(200_000, 600_000)]);
        assert_eq!(gaps(&[0.0, 0.02, 0.04, 0.28, 0.3]), []);
        assert_eq!(gaps(&[0.0, 0.02, 0.04, 0.3, 0.32]), [(40_000, 300_000)]);
        assert_eq!((gaps(&[]), gaps(&[1.0])), (vec![], vec![]));
        let even = FrameTimes::Even(FrameRate::new(2, 1).expect("a rate"));
        assert_eq!((even.frame_time_gaps(9).len(), even.usual_step(9)), (0, 500_000));
        assert_eq!(even.longest_step(9), 1_500_000);
    }

    #[test]
    fn an_even_rate_is_detected_in_regular_times() {
        let even = |seconds: &[f64], tolerance| match listed(seconds) {
            FrameTimes::Listed(times) => times.infer_even_rate(tolerance).map(FrameRate::rate_numerator),
            FrameTimes::Even(_) => None,
        };
        let at_thirty: Vec<f64> = (0..50).map(|n| 4.0 + f64::from(n) / 30.0).collect();
        assert_eq!(even(&at_thirty, 1e-6), Some(30));
        let mut gap = at_thirty;
        gap.remove(20);
        assert_eq!(even(&gap, 1e-3), None);
        assert_eq!(even(&[1.0], 1.0), None);
    }

    #[test]
    fn times_out_of_order_are_refused_with_their_frame() {
        let fault = |seconds: &[f64]| {
            FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.to_vec())).err()
        };
        assert_eq!(fault(&[0.0, f64::NAN]), Some(TimesError::Gap(1)));
        assert_eq!(
            fault(&[0.0, 1.0, 1.0]),
            Some(TimesError::Order { frame: 2, seconds: 1.0 })
        );
        assert_eq!(
            fault(&[1e12]),
            Some(TimesError::Range {
                frame: 0,
                seconds: 1e12
            })
        );
    }
}
