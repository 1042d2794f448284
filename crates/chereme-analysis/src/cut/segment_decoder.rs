//! The likeliest spans of signs, given the log odds of every frame: a semi-Markov model with two states.

use std::ops::Range;

use super::cut_tuned::tuned;

/// The log odds of each frame, at 25 Hz: that it lies within a sign, and that a sign begins or ends at it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FrameOdds {
    pub(super) sign: Vec<f64>,
    pub(super) begin: Vec<f64>,
    pub(super) end: Vec<f64>,
}

impl FrameOdds {
    /// Returns the evidence for a sign: the mean log odds of its frames, and those of its begin and its end.
    pub(super) fn sign_evidence(&self, frames: &Range<usize>) -> f64 {
        let within: f64 = self.sign[frames.clone()].iter().sum();
        within / frames.len().max(1) as f64 + self.begin[frames.start] + self.end_odds(frames.end)
    }

    /// Returns the log odds that a sign ends before this frame.
    fn end_odds(&self, frame: usize) -> f64 {
        self.end[frame.min(self.end.len() - 1)]
    }

    /// Returns the spans of signs in `frames` with the greatest score. A sign scores its log odds within, times `weight`, and
    /// those of begin and end, less its cost.
    pub(super) fn decode_signs(&self, frames: Range<usize>, weight: f64, cost: f64) -> Vec<Range<usize>> {
        let numbers = &tuned().decoder;
        let count = frames.len();
        // Sums up to each frame give the odds of any span by one difference.
        let mut sums = vec![0.0];
        for score in &self.sign[frames.clone()] {
            sums.push(sums.last().copied().unwrap_or(0.0) + score);
        }
        // The best score of the frames before each, and where the sign begins that ends there.
        let mut best = vec![0.0; count + 1];
        let mut begins: Vec<Option<usize>> = vec![None; count + 1];
        for end in 1..=count {
            // A frame may belong to no sign and scores nothing.
            best[end] = best[end - 1];
            let ending = self.end_odds(frames.start + end) - cost;
            for begin in end.saturating_sub(numbers.longest)..(end + 1).saturating_sub(numbers.shortest) {
                // A gap keeps two signs from touching; at the start there is no sign to keep away from.
                let before = best[begin.saturating_sub(numbers.gap)];
                let within = weight * (sums[end] - sums[begin]);
                let score = before + within + self.begin[frames.start + begin] + ending;
                // Rounding must not decide between spans of equal score.
                if score > best[end] + 1e-12 {
                    (best[end], begins[end]) = (score, Some(begin));
                }
            }
        }
        let mut spans = Vec::new();
        let mut end = count;
        while end > 0 {
            match begins[end] {
                None => end -= 1,
                Some(begin) => {
                    spans.push(frames.start + begin..frames.start + end);
                    end = begin.saturating_sub(numbers.gap);
                }
            }
        }
        spans.reverse();
        spans
    }
}
