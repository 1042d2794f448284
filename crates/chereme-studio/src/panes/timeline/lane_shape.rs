//! The geometry of lanes, without widgets: their height, their scale, and the line through their frames.

use crate::settings::timeline_settings::CurveLane;
use crate::words::{InterfaceLanguage, timeline as words};

/// The height of a lane, in points: with room, with little room, and folded.
const HIGH_LANE_HEIGHT_POINTS: f32 = 28.0;
const LOW_LANE_HEIGHT_POINTS: f32 = 18.0;
pub(super) const FOLDED_LANE_HEIGHT_POINTS: f32 = 16.0;
/// Height of the lane of a stored curve, in points.
pub(super) const CURVE_LANE_HEIGHT_POINTS: f32 = 18.0;
/// The greatest share of the pane for all lanes, and the height that is left for tiers.
const MAX_LANES_HEIGHT_SHARE: f32 = 0.5;
const MIN_TIERS_HEIGHT_POINTS: f32 = 3.5 * 26.0;
/// Frames narrower than this, in points, are thinned to the columns of the screen instead.
const NARROW_FRAME_WIDTH_POINTS: f32 = 1.5;
/// The greatest distance between points of a drawn line, in points.
const MAX_LINE_STEP_POINTS: f32 = 2.0;

/// The lanes to show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct WantedLanes {
    /// Open lanes of measured movement.
    pub(super) open: usize,
    /// Folded lanes.
    pub(super) folded: usize,
    /// Lanes of stored curves.
    pub(super) face: usize,
}

/// Returns the height of each open lane, and the greatest height of all together, in points. In a low pane, lanes
/// become lower and finally scroll, so that tiers stay in sight.
pub(super) fn lane_room_heights(wanted: WantedLanes, height: f32) -> (f32, f32) {
    // With little height lanes get half of it, unless tiers would be left without rows.
    let most = (height - MIN_TIERS_HEIGHT_POINTS)
        .min(height * MAX_LANES_HEIGHT_SHARE)
        .max(FOLDED_LANE_HEIGHT_POINTS);
    let rest = wanted.folded as f32 * FOLDED_LANE_HEIGHT_POINTS + wanted.face as f32 * CURVE_LANE_HEIGHT_POINTS;
    let raw_height = (most - rest) / wanted.open.max(1) as f32;
    let each = raw_height
        .floor()
        .clamp(LOW_LANE_HEIGHT_POINTS, HIGH_LANE_HEIGHT_POINTS);
    let all = wanted.open as f32 * each + rest;
    (each, all.min(most))
}

/// Returns the smallest round number of at least `value`: 1, 1.5, 2, 3 or 5 times a power of ten.
fn round_up_scale(value: f32) -> f32 {
    let power = 10.0_f32.powf(value.max(1e-6).log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 10.0];
    // A tolerance, so that 0.5 is not rounded up because of its last bit.
    let first_step = steps.into_iter().find(|step| step * power >= value * 0.999);
    first_step.unwrap_or(10.0) * power
}

/// Returns the numbers at the lower and upper edge of a lane, given its largest number.
pub(super) fn lane_value_range(lane: CurveLane, largest: f32) -> (f32, f32) {
    match lane {
        CurveLane::Speed => (0.0, round_up_scale(largest.max(0.5))),
        CurveLane::Aperture => (0.3, 1.05),
        CurveLane::Palm => (-1.05, 1.05),
        CurveLane::Distance => (0.0, round_up_scale(largest.max(0.3))),
        CurveLane::Face => (0.0, 1.0),
    }
}

/// Returns the two marks of a lane's scale with their units, the upper one last.
pub(super) fn lane_scale_marks(lane: CurveLane, largest: f32, language: InterfaceLanguage) -> [(f32, String); 2] {
    let (low, high) = lane_value_range(lane, largest);
    let zero = (low, "0".to_owned());
    match lane {
        CurveLane::Speed => [zero, (high, format!("{high} m/s"))],
        CurveLane::Distance => [zero, (high, format!("{high} m"))],
        CurveLane::Aperture => [(0.5, "50 %".to_owned()), (1.0, "100 %".to_owned())],
        CurveLane::Face => [zero, (1.0, "100 %".to_owned())],
        CurveLane::Palm => [
            (-1.0, words::TO_DOWN.text_in_language(language).to_owned()),
            (1.0, words::TO_UP.text_in_language(language).to_owned()),
        ],
    }
}

/// Returns whether frames of that width, in points, are drawn as a line.
pub(super) fn is_wide(frame: f32) -> bool {
    frame >= NARROW_FRAME_WIDTH_POINTS
}

/// Returns the points of a smooth line through `frames`, from left to right. It goes through each frame, and stays
/// between the values of neighbouring frames (monotone cubic, Fritsch and Carlson 1980).
pub(super) fn smooth_frame_line(frames: &[(f32, f32)]) -> Vec<(f32, f32)> {
    let slopes = frame_line_slopes(frames);
    let mut points = Vec::new();
    for (at, pair) in frames.windows(2).enumerate() {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let wide = x1 - x0;
        let count = (wide / MAX_LINE_STEP_POINTS).ceil().clamp(1.0, 200.0) as usize;
        // The cubic Hermite polynomials; slopes are in units a point, hence the width.
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
fn frame_line_slopes(frames: &[(f32, f32)]) -> Vec<f32> {
    let pairs = frames.windows(2);
    let steep: Vec<f32> = pairs
        .map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0).max(f32::EPSILON))
        .collect();
    let (Some(first), Some(last)) = (steep.first(), steep.last()) else {
        return vec![0.0; frames.len()];
    };
    let mut slopes = vec![*first];
    for pair in steep.windows(2) {
        // At a peak or a valley the line is level, or it would overshoot.
        let turns = pair[0] * pair[1] <= 0.0;
        slopes.push(if turns { 0.0 } else { (pair[0] + pair[1]) / 2.0 });
    }
    slopes.push(*last);
    for (at, steep) in steep.iter().enumerate() {
        // Between equal values the line stays level.
        if *steep == 0.0 {
            (slopes[at], slopes[at + 1]) = (0.0, 0.0);
            continue;
        }
        let (a, b) = (slopes[at] / steep, slopes[at + 1] / steep);
        let far = a.hypot(b);
        // Within a circle of radius 3 the cubic is monotone (Fritsch and Carlson 1980).
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
                    let wanted = WantedLanes { open, face, folded: 1 };
                    let (each, all) = lane_room_heights(wanted, height);
                    assert!(
                        (LOW_LANE_HEIGHT_POINTS..=HIGH_LANE_HEIGHT_POINTS).contains(&each),
                        "{wanted:?} {height}: {each}"
                    );
                    assert!(height - all >= 2.0 * 26.0, "{wanted:?} {height}: {all}");
                    assert!(all <= height / 2.0, "{wanted:?} {height}: {all}");
                }
            }
        }
        let four = WantedLanes {
            open: 4,
            ..WantedLanes::default()
        };
        assert_eq!(
            lane_room_heights(four, 600.0),
            (HIGH_LANE_HEIGHT_POINTS, 4.0 * HIGH_LANE_HEIGHT_POINTS),
            "slim where there is room"
        );
        let folded = WantedLanes {
            folded: 4,
            ..WantedLanes::default()
        };
        assert_eq!(lane_room_heights(folded, 600.0).1, 4.0 * FOLDED_LANE_HEIGHT_POINTS);
    }

    #[test]
    fn a_scale_shows_round_numbers_with_their_unit() {
        for (lane, largest, english, french) in [
            (CurveLane::Speed, 1.27, ["0", "1.5 m/s"], ["0", "1.5 m/s"]),
            (CurveLane::Speed, 0.1, ["0", "0.5 m/s"], ["0", "0.5 m/s"]),
            (CurveLane::Distance, 0.62, ["0", "1 m"], ["0", "1 m"]),
            (CurveLane::Aperture, 0.9, ["50 %", "100 %"], ["50 %", "100 %"]),
            (CurveLane::Palm, 1.0, ["down", "up"], ["bas", "haut"]),
        ] {
            for (language, want) in [
                (InterfaceLanguage::English, english),
                (InterfaceLanguage::French, french),
            ] {
                let all = lane_scale_marks(lane, largest, language);
                let (low, high) = lane_value_range(lane, largest);
                for ((value, text), want) in all.iter().zip(want) {
                    assert!((low..=high).contains(value), "{lane:?} {value}");
                    assert!(text.contains(want), "{lane:?} {text}");
                }
            }
        }
        assert_eq!(round_up_scale(3.0), 3.0);
        assert_eq!(round_up_scale(5.1), 10.0);
    }

    #[test]
    fn a_line_at_25_frames_a_second_has_no_stairs() {
        // Frames 8 points apart: 25 a second, 200 points for a second.
        let frame = |n: usize| (n as f32 * 8.0, (n as f32 * 0.4).sin());
        let frames: Vec<(f32, f32)> = (0..50).map(frame).collect();
        let line = smooth_frame_line(&frames);
        for frame in &frames {
            assert!(line.contains(frame), "it goes through {frame:?}");
        }
        for pair in line.windows(2) {
            assert!(pair[1].0 - pair[0].0 <= MAX_LINE_STEP_POINTS + 1e-3);
            // A stair would rise by a whole frame at once: up to 0.4 here.
            assert!((pair[1].1 - pair[0].1).abs() < 0.16, "{pair:?}");
        }
        assert!(
            line.iter().all(|(_, y)| (-1.0..=1.0).contains(y)),
            "it never overshoots"
        );
        let step = smooth_frame_line(&[(0.0, 0.0), (8.0, 0.0), (16.0, 1.0), (24.0, 1.0)]);
        assert!(step.iter().all(|(_, y)| (0.0..=1.0).contains(y)), "{step:?}");
        assert!(smooth_frame_line(&[]).is_empty());
        assert_eq!(smooth_frame_line(&[(1.0, 2.0)]), [(1.0, 2.0)]);
    }
}
