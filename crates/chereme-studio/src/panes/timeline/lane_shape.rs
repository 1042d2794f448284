//! The geometry of lanes, without widgets: their height, their scale, and the line through their frames.

use super::lanes::Lane;
use crate::words::{Language, timeline as words};

/// The height of a lane, in points: with room, with little room, and folded.
const HIGH: f32 = 28.0;
const LOW: f32 = 18.0;
pub(super) const FOLDED: f32 = 16.0;
/// Height of the lane of a stored curve, in points.
pub(super) const FACE: f32 = 18.0;
/// The greatest share of the pane for all lanes, and the height that is left for tiers.
const SHARE: f32 = 0.5;
const TIERS: f32 = 3.5 * 26.0;
/// Frames narrower than this, in points, are thinned to the columns of the screen instead.
const NARROW: f32 = 1.5;
/// The greatest distance between points of a drawn line, in points.
const STEP: f32 = 2.0;

/// The lanes to show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Wanted {
    /// Open lanes of measured movement.
    pub(super) open: usize,
    /// Folded lanes.
    pub(super) folded: usize,
    /// Lanes of stored curves.
    pub(super) face: usize,
}

/// Returns the height of each open lane, and the greatest height of all together, in points. In a low pane, lanes
/// become lower and finally scroll, so that tiers stay in sight.
pub(super) fn room(wanted: Wanted, height: f32) -> (f32, f32) {
    let most = (height - TIERS).min(height * SHARE).max(FOLDED);
    let rest = wanted.folded as f32 * FOLDED + wanted.face as f32 * FACE;
    let each = (most - rest) / wanted.open.max(1) as f32;
    let each = each.floor().clamp(LOW, HIGH);
    let all = wanted.open as f32 * each + rest;
    (each, all.min(most))
}

/// Returns the smallest round number of at least `value`: 1, 1.5, 2, 3 or 5 times a power of ten.
fn round(value: f32) -> f32 {
    let power = 10.0_f32.powf(value.max(1e-6).log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 10.0];
    let found = steps.into_iter().find(|step| step * power >= value * 0.999);
    found.unwrap_or(10.0) * power
}

/// Returns the numbers at the lower and upper edge of a lane, given its largest number.
pub(super) fn range(lane: Lane, largest: f32) -> (f32, f32) {
    match lane {
        Lane::Speed => (0.0, round(largest.max(0.5))),
        Lane::Aperture => (0.3, 1.05),
        Lane::Palm => (-1.05, 1.05),
        Lane::Distance => (0.0, round(largest.max(0.3))),
        Lane::Face => (0.0, 1.0),
    }
}

/// Returns the two marks of a lane's scale with their units, the upper one last.
pub(super) fn marks(lane: Lane, largest: f32, language: Language) -> [(f32, String); 2] {
    let (low, high) = range(lane, largest);
    let zero = (low, "0".to_owned());
    match lane {
        Lane::Speed => [zero, (high, format!("{high} m/s"))],
        Lane::Distance => [zero, (high, format!("{high} m"))],
        Lane::Aperture => [(0.5, "50 %".to_owned()), (1.0, "100 %".to_owned())],
        Lane::Face => [zero, (1.0, "100 %".to_owned())],
        Lane::Palm => [
            (-1.0, words::TO_DOWN.of(language).to_owned()),
            (1.0, words::TO_UP.of(language).to_owned()),
        ],
    }
}

/// Returns whether frames of that width, in points, are drawn as a line.
pub(super) fn is_wide(frame: f32) -> bool {
    frame >= NARROW
}

/// Returns the points of a smooth line through `frames`, from left to right. It goes through each frame, and stays
/// between the values of neighbouring frames (monotone cubic, Fritsch and Carlson 1980).
pub(super) fn smooth(frames: &[(f32, f32)]) -> Vec<(f32, f32)> {
    let slopes = slopes(frames);
    let mut points = Vec::new();
    for (at, pair) in frames.windows(2).enumerate() {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let wide = x1 - x0;
        let count = (wide / STEP).ceil().clamp(1.0, 200.0) as usize;
        for step in 0..count {
            let t = step as f32 / count as f32;
            let (t2, t3) = (t * t, t * t * t);
            let y = (2.0 * t3 - 3.0 * t2 + 1.0) * y0
                + (t3 - 2.0 * t2 + t) * wide * slopes[at]
                + (3.0 * t2 - 2.0 * t3) * y1
                + (t3 - t2) * wide * slopes[at + 1];
            points.push((x0 + t * wide, y));
        }
    }
    points.extend(frames.last());
    points
}

/// Returns the slope of the line at each frame.
fn slopes(frames: &[(f32, f32)]) -> Vec<f32> {
    let pairs = frames.windows(2);
    let steep: Vec<f32> = pairs
        .map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0).max(f32::EPSILON))
        .collect();
    let (Some(first), Some(last)) = (steep.first(), steep.last()) else {
        return vec![0.0; frames.len()];
    };
    let mut slopes = vec![*first];
    for pair in steep.windows(2) {
        let turns = pair[0] * pair[1] <= 0.0;
        slopes.push(if turns {
            0.0
        } else {
            (pair[0] + pair[1]) / 2.0
        });
    }
    slopes.push(*last);
    for (at, steep) in steep.iter().enumerate() {
        if *steep == 0.0 {
            (slopes[at], slopes[at + 1]) = (0.0, 0.0);
            continue;
        }
        let (a, b) = (slopes[at] / steep, slopes[at + 1] / steep);
        let far = a.hypot(b);
        if far > 3.0 {
            slopes[at] = 3.0 / far * a * steep;
            slopes[at + 1] = 3.0 / far * b * steep;
        }
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiers_stay_visible_with_any_number_of_lanes() {
        // Heights of the rows below the ruler at 1280x800 and 1024x640, and in a very low pane.
        for height in [250.0_f32, 180.0, 150.0] {
            for open in 0..5 {
                for face in [0, 12] {
                    let wanted = Wanted {
                        open,
                        face,
                        folded: 1,
                    };
                    let (each, all) = room(wanted, height);
                    assert!((LOW..=HIGH).contains(&each), "{wanted:?} {height}: {each}");
                    assert!(height - all >= 2.0 * 26.0, "{wanted:?} {height}: {all}");
                    assert!(all <= height / 2.0, "{wanted:?} {height}: {all}");
                }
            }
        }
        let four = Wanted {
            open: 4,
            ..Wanted::default()
        };
        assert_eq!(
            room(four, 600.0),
            (HIGH, 4.0 * HIGH),
            "slim where there is room"
        );
        let folded = Wanted {
            folded: 4,
            ..Wanted::default()
        };
        assert_eq!(room(folded, 600.0).1, 4.0 * FOLDED);
    }

    #[test]
    fn a_scale_shows_round_numbers_with_their_unit() {
        for (lane, largest, english, french) in [
            (Lane::Speed, 1.27, ["0", "1.5 m/s"], ["0", "1.5 m/s"]),
            (Lane::Speed, 0.1, ["0", "0.5 m/s"], ["0", "0.5 m/s"]),
            (Lane::Distance, 0.62, ["0", "1 m"], ["0", "1 m"]),
            (Lane::Aperture, 0.9, ["50 %", "100 %"], ["50 %", "100 %"]),
            (Lane::Palm, 1.0, ["down", "up"], ["bas", "haut"]),
        ] {
            for (language, want) in [(Language::English, english), (Language::French, french)] {
                let all = marks(lane, largest, language);
                let (low, high) = range(lane, largest);
                for ((value, text), want) in all.iter().zip(want) {
                    assert!((low..=high).contains(value), "{lane:?} {value}");
                    assert!(text.contains(want), "{lane:?} {text}");
                }
            }
        }
        assert_eq!(round(3.0), 3.0);
        assert_eq!(round(5.1), 10.0);
    }

    #[test]
    fn a_line_at_25_frames_a_second_has_no_stairs() {
        // Frames 8 points apart: 25 a second, 200 points for a second.
        let frame = |n: usize| (n as f32 * 8.0, (n as f32 * 0.4).sin());
        let frames: Vec<(f32, f32)> = (0..50).map(frame).collect();
        let line = smooth(&frames);
        for frame in &frames {
            assert!(line.contains(frame), "it goes through {frame:?}");
        }
        for pair in line.windows(2) {
            assert!(pair[1].0 - pair[0].0 <= STEP + 1e-3);
            // A stair would rise by a whole frame at once: up to 0.4 here.
            assert!((pair[1].1 - pair[0].1).abs() < 0.16, "{pair:?}");
        }
        assert!(
            line.iter().all(|(_, y)| (-1.0..=1.0).contains(y)),
            "it never overshoots"
        );
        let step = smooth(&[(0.0, 0.0), (8.0, 0.0), (16.0, 1.0), (24.0, 1.0)]);
        assert!(
            step.iter().all(|(_, y)| (0.0..=1.0).contains(y)),
            "{step:?}"
        );
        assert!(smooth(&[]).is_empty());
        assert_eq!(smooth(&[(1.0, 2.0)]), [(1.0, 2.0)]);
    }
}
