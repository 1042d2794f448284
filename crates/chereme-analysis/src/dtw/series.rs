//! A multivariate time series: frames of channels, kept column by column and checked once.

use super::DtwError;

/// Largest allowed magnitude of a value; its square, summed over any series that fits in memory, stays
/// finite.
const MAX_SERIES_VALUE: f64 = 1e140;

/// A checked multivariate time series of at least one frame and one channel, all values finite.
///
/// Values are kept channel by channel, so that a local distance runs over contiguous numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelSeries {
    frames: usize,
    values: Vec<f64>,
}

impl ChannelSeries {
    /// Returns the series whose frames are `rows`, each with one value per channel.
    ///
    /// # Errors
    /// [`DtwError::Empty`] without frames or channels, [`DtwError::Ragged`] if the number of channels of a
    /// frame differs from the first frame's, [`DtwError::Value`] for NaN, infinities and magnitudes above
    /// 1e140.
    pub fn from_rows<R: AsRef<[f64]>>(rows: &[R]) -> Result<Self, DtwError> {
        let channels = rows.first().map_or(0, |row| row.as_ref().len());
        if channels == 0 {
            return Err(DtwError::Empty);
        }
        let ragged = rows.iter().position(|row| row.as_ref().len() != channels);
        if let Some(frame) = ragged {
            let row_length = rows[frame].as_ref().len();
            return Err(DtwError::Ragged {
                frame,
                found: row_length,
                expected: channels,
            });
        }
        let column = |c| rows.iter().map(move |row| row.as_ref()[c]);
        Self::check_series_values(rows.len(), (0..channels).flat_map(column).collect())
    }

    /// Returns the series whose channels are `columns`, each with one value per frame.
    ///
    /// # Errors
    /// The same as [`from_rows`](Self::from_rows)'s; a shorter or longer column is reported by the frame
    /// at which it departs.
    pub fn from_columns<C: AsRef<[f64]>>(columns: &[C]) -> Result<Self, DtwError> {
        let frames = columns.first().map_or(0, |column| column.as_ref().len());
        if frames == 0 {
            return Err(DtwError::Empty);
        }
        if let Some(other) = columns.iter().map(|c| c.as_ref().len()).find(|len| *len != frames) {
            let longer_count = columns.iter().filter(|c| c.as_ref().len() > frames.min(other)).count();
            return Err(DtwError::Ragged {
                frame: frames.min(other),
                found: longer_count,
                expected: columns.len(),
            });
        }
        let values = columns.iter().flat_map(|c| c.as_ref().iter().copied()).collect();
        Self::check_series_values(frames, values)
    }

    fn check_series_values(frames: usize, values: Vec<f64>) -> Result<Self, DtwError> {
        let sound = |v: f64| v.abs() <= MAX_SERIES_VALUE;
        match values.iter().position(|v| !sound(*v)) {
            Some(at) => Err(DtwError::Value {
                frame: at % frames,
                channel: at / frames,
                value: values[at],
            }),
            None => Ok(Self { frames, values }),
        }
    }

    /// Returns the series with every channel divided by its own scale: the amount of that channel that
    /// weighs as much as 1 of another.
    ///
    /// # Errors
    /// [`DtwError::Scales`] if the numbers of scales and channels differ, [`DtwError::Scale`] if a scale
    /// is not a positive finite number, [`DtwError::Value`] if a quotient is too large.
    pub fn scale_channels(&self, scales: &[f64]) -> Result<Self, DtwError> {
        if scales.len() != self.series_channel_count() {
            return Err(DtwError::Scales {
                found: scales.len(),
                channels: self.series_channel_count(),
            });
        }
        let bad = scales.iter().position(|s| !(s.is_finite() && *s > 0.0));
        if let Some(channel) = bad {
            return Err(DtwError::Scale {
                channel,
                scale: scales[channel],
            });
        }
        let columns = self.values.chunks_exact(self.frames).zip(scales);
        let values = columns
            .flat_map(|(column, s)| column.iter().map(move |v| v / s))
            .collect();
        Self::check_series_values(self.frames, values)
    }

    /// Returns the series stretched or squeezed to `frames` frames (at least one) by linear interpolation,
    /// first on first and last on last; a single frame comes from the middle.
    #[must_use]
    pub fn resample_series_frames(&self, frames: usize) -> Self {
        let frames = frames.max(1);
        let places: Vec<f64> = (0..frames)
            .map(|i| resampled_frame_position(i, frames, self.frames))
            .collect();
        let sample = |column: &[f64], at: f64| {
            let (first, share) = (at.floor() as usize, at.fract());
            let second = (first + 1).min(column.len() - 1);
            column[first] * (1.0 - share) + column[second] * share
        };
        let columns = self.values.chunks_exact(self.frames);
        let values = columns
            .flat_map(|column| places.iter().map(move |at| sample(column, *at)))
            .collect();
        Self { frames, values }
    }

    /// Returns the number of frames.
    #[must_use]
    pub fn series_frame_count(&self) -> usize {
        self.frames
    }

    /// Returns the number of channels.
    #[must_use]
    pub fn series_channel_count(&self) -> usize {
        self.values.len() / self.frames
    }

    /// Returns the values of one channel, a value per frame.
    ///
    /// # Panics
    /// Panics if there is no such channel.
    #[must_use]
    pub fn channel_values(&self, channel: usize) -> &[f64] {
        &self.values[channel * self.frames..][..self.frames]
    }

    /// Returns the values of one frame, a value per channel.
    pub(crate) fn frame_values(&self, frame: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().skip(frame).step_by(self.frames).copied()
    }
}

/// Returns the position of frame `i` of `frames` in a series of `source` frames, in frames.
pub(crate) fn resampled_frame_position(i: usize, frames: usize, source: usize) -> f64 {
    let last = (source - 1) as f64;
    if frames == 1 {
        (last / 2.0).floor()
    } else {
        i as f64 * last / (frames - 1) as f64
    }
}
