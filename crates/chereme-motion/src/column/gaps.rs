//! The frames at which a channel has no number.

use std::ops::Range;

/// Frames without a number, as sorted runs that do not touch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ColumnGaps(Vec<Range<u32>>);

impl ColumnGaps {
    /// Returns the gaps at `frames`, in any order.
    #[must_use]
    pub fn from_gap_frames(frames: impl IntoIterator<Item = u32>) -> Self {
        let runs = frames.into_iter();
        Self::from_gap_runs(runs.map(|frame| frame..frame.saturating_add(1)))
    }

    /// Returns the gaps that cover `runs`, in any order; runs may touch and overlap.
    #[must_use]
    pub fn from_gap_runs(runs: impl IntoIterator<Item = Range<u32>>) -> Self {
        let mut runs: Vec<Range<u32>> = runs.into_iter().filter(|run| !run.is_empty()).collect();
        runs.sort_by_key(|run| run.start);
        let mut joined: Vec<Range<u32>> = Vec::new();
        for run in runs {
            match joined.last_mut() {
                Some(last) if run.start <= last.end => last.end = last.end.max(run.end),
                _ => joined.push(run),
            }
        }
        Self(joined)
    }

    /// Returns the runs of frames, sorted; no two of them touch.
    #[must_use]
    pub fn gap_runs(&self) -> &[Range<u32>] {
        &self.0
    }

    /// Returns whether `frame` lies in a gap.
    #[must_use]
    pub fn is_gap_frame(&self, frame: usize) -> bool {
        let Ok(frame) = u32::try_from(frame) else {
            return false;
        };
        let after = self.0.partition_point(|run| run.start <= frame);
        after > 0 && frame < self.0[after - 1].end
    }

    /// Returns how many frames have no number.
    #[must_use]
    pub fn gap_frame_count(&self) -> usize {
        self.0.iter().map(ExactSizeIterator::len).sum()
    }

    /// Returns whether there is no gap.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the first frame after the last gap, 0 if there is no gap.
    #[must_use]
    pub fn gaps_end_frame(&self) -> usize {
        self.0.last().map_or(0, |run| run.end as usize)
    }

    /// Returns the gaps within the frames `rows`, counted from the first of them.
    #[must_use]
    pub fn slice_gaps(&self, rows: Range<usize>) -> Self {
        let bound = |frame: usize| u32::try_from(frame).unwrap_or(u32::MAX);
        let (start, end) = (bound(rows.start), bound(rows.end));
        let cut = |run: &Range<u32>| run.start.max(start)..run.end.min(end);
        let cut_runs = self.0.iter().map(cut).filter(|run| run.start < run.end);
        Self(cut_runs.map(|run| run.start - start..run.end - start).collect())
    }

    /// Adds the gaps of frames that follow; their first frame is number `first`.
    pub fn append_gaps(&mut self, first: usize, other: &Self) {
        let first = u32::try_from(first).unwrap_or(u32::MAX);
        let moved = |run: &Range<u32>| run.start.saturating_add(first)..run.end.saturating_add(first);
        let all = self.0.drain(..).chain(other.0.iter().map(moved));
        *self = Self::from_gap_runs(all.collect::<Vec<_>>());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_merged_sliced_and_joined_again() {
        let gaps = ColumnGaps::from_gap_runs([7..9, 2..4, 4..5, 3..4, 6..6]);
        assert_eq!(gaps.gap_runs(), [2..5, 7..9]);
        assert_eq!(gaps, ColumnGaps::from_gap_frames([8, 7, 2, 4, 3]));
        let held: Vec<usize> = (0..12).filter(|&frame| gaps.is_gap_frame(frame)).collect();
        assert_eq!(held, [2, 3, 4, 7, 8]);
        assert_eq!((gaps.gap_frame_count(), gaps.gaps_end_frame()), (5, 9));
        for cut in 0..12 {
            let mut both = gaps.slice_gaps(0..cut);
            both.append_gaps(cut, &gaps.slice_gaps(cut..12));
            assert_eq!(both, gaps, "cut at {cut}");
        }
        assert!(!gaps.is_gap_frame(usize::MAX));
    }
}
