//! Movement as lanes below the ruler: measured piece by piece in the background, stored, and thinned to the columns of
//! the screen.

use crate::settings::timeline_settings::CurveLane;
use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::ClipKinematicCurves;
use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};

use super::lane_shape;
use crate::action::Action;
use crate::command::CommandOutbox;
use crate::model::time_window::TimeWindow;
use crate::words::{InterfaceText, timeline as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, movement_jobs};

/// Frames of a piece, and of a summary within it.
const LANE_PIECE_FRAMES: usize = 1200;
const LANE_SUMMARY_FRAMES: usize = 16;
/// Values of a stored curve up to this count as zero.
const NEGLIGIBLE_CURVE_VALUE: f64 = 1e-3;

/// Every lane with the action that shows it and its name.
pub(crate) const CURVE_LANES: [(CurveLane, Action, InterfaceText); 5] = [
    (CurveLane::Speed, Action::LaneSpeed, words::LANE_SPEED),
    (CurveLane::Aperture, Action::LaneAperture, words::LANE_APERTURE),
    (CurveLane::Palm, Action::LanePalm, words::LANE_PALM),
    (CurveLane::Distance, Action::LaneDistance, words::LANE_DISTANCE),
    (CurveLane::Face, Action::LaneFace, words::LANE_FACE),
];

/// The frames of a recording's movement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MovementFrames {
    pub(crate) recording: i64,
    pub(crate) frames: usize,
    pub(crate) rate: FrameRate,
    pub(crate) offset: i64,
}

/// Neighbouring frames: the position of each in points from the left edge, and its number.
pub(super) type FrameRun = Vec<(f32, f32)>;

/// A number for each frame of a piece, with the least and largest of every [`LANE_SUMMARY_FRAMES`] frames.
#[derive(Debug, Clone, Default, PartialEq)]
struct CurveSeries {
    values: Vec<f32>,
    rough: Vec<(f32, f32)>,
}

impl CurveSeries {
    fn new(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f32> = values.map(|value| value as f32).collect();
        let rough = values.chunks(LANE_SUMMARY_FRAMES).map(min_max_values).collect();
        Self { values, rough }
    }

    /// Returns about the least and largest number of the frames `from..to`.
    fn series_range_ends(&self, from: usize, to: usize) -> Option<(f32, f32)> {
        let to = to.min(self.values.len());
        if from >= to {
            return None;
        }
        // Long ranges are read from the summaries, whose ends may lie a few frames outside.
        if to - from < 4 * LANE_SUMMARY_FRAMES {
            return Some(min_max_values(&self.values[from..to]));
        }
        let rough = &self.rough[from / LANE_SUMMARY_FRAMES..to.div_ceil(LANE_SUMMARY_FRAMES)];
        let low = rough.iter().map(|range| range.0).fold(f32::INFINITY, f32::min);
        let high = rough.iter().map(|range| range.1).fold(f32::NEG_INFINITY, f32::max);
        Some((low, high))
    }
}

fn min_max_values(values: &[f32]) -> (f32, f32) {
    let low = values.iter().copied().fold(f32::INFINITY, f32::min);
    let high = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    (low, high)
}

#[derive(Debug, Default)]
struct CurvePiece {
    /// By lane and hand.
    series: BTreeMap<(CurveLane, usize), CurveSeries>,
    /// By name of the stored curve; curves that are zero throughout are left out.
    stored: BTreeMap<String, CurveSeries>,
    palms: [Vec<[f32; 3]>; 2],
    /// Times of the minima of speed, in microseconds.
    minima: Vec<i64>,
}

/// The movement that has been measured so far.
#[derive(Debug, Default)]
pub(crate) struct MeasuredCurves {
    source: Option<MovementFrames>,
    pieces: BTreeMap<usize, CurvePiece>,
    /// The running measurement and its piece; one at a time, so that a newly visible piece is next.
    asked: Option<(WorkId, usize)>,
    /// Whether a piece could not be measured.
    failed: bool,
}

impl MeasuredCurves {
    /// Switches to a recording, and requests the missing visible piece that is nearest to the playhead.
    pub(super) fn request_curve_pieces(
        &mut self,
        source: Option<MovementFrames>,
        seen: (i64, i64),
        playhead: i64,
        out: &CommandOutbox,
    ) {
        if self.source != source {
            *self = Self {
                source,
                ..Self::default()
            };
        }
        // One measurement at a time, so that what becomes visible is measured next.
        let Some(source) = source.filter(|_| self.asked.is_none() && !self.failed) else {
            return;
        };
        let Some(piece) = self.next(source, seen.0, seen.1, playhead) else {
            return;
        };
        let frames = piece * LANE_PIECE_FRAMES..((piece + 1) * LANE_PIECE_FRAMES).min(source.frames);
        let span = source.rate.frame_range_span(frames).shifted_span(source.offset);
        let job = movement_jobs::measure_movement_job(source.recording, piece, span);
        self.asked = Some((out.request_work(job), piece));
    }

    fn next(&self, source: MovementFrames, from: i64, to: i64, playhead: i64) -> Option<usize> {
        let piece = |micros| source.movement_frame_at(micros) / LANE_PIECE_FRAMES;
        let here = piece(playhead.clamp(from, to));
        (piece(from)..=piece(to))
            .filter(|piece| !self.pieces.contains_key(piece))
            .min_by_key(|piece| piece.abs_diff(here))
    }

    pub(super) fn receive_curve_piece(&mut self, id: WorkId, ended: &WorkResult) {
        if self.asked.is_none_or(|(asked, _)| asked != id) {
            return;
        }
        self.asked = None;
        match ended {
            Ok(WorkOutcome::Measured { piece, curves }) => {
                let time = |frame: usize| curves.rate.frame_start_instant(frame).instant_micros() + curves.offset_us;
                let minima = curves.minima.iter().map(|frame| time(*frame)).collect();
                let mut measured = CurvePiece::new(&curves.kinematics, minima);
                let stored = curves.stored.iter();
                // Most faces use few of the stored curves; the rest would be empty lanes.
                let some = stored.filter(|curve| curve.values.iter().any(|value| *value > NEGLIGIBLE_CURVE_VALUE));
                measured.stored = some
                    .map(|curve| (curve.name.clone(), CurveSeries::new(curve.values.iter().copied())))
                    .collect();
                self.pieces.insert(*piece, measured);
            }
            _ => self.failed = true,
        }
    }

    /// Returns the minima of wrist speed between two times, in order.
    pub(super) fn wrist_speed_minima(&self, from: i64, to: i64) -> Vec<i64> {
        let all = self.pieces.values().flat_map(|piece| &piece.minima);
        all.copied().filter(|at| (from..=to).contains(at)).collect()
    }

    /// Returns the largest measured number of a lane.
    pub(super) fn largest_lane_value(&self, lane: CurveLane) -> f32 {
        let all = self.pieces.values().flat_map(|piece| &piece.series);
        let lane_series = all.filter(|((of, _), _)| *of == lane);
        lane_series
            .flat_map(|(_, series)| &series.rough)
            .map(|range| range.1)
            .fold(0.0, f32::max)
    }

    /// Returns for each column of the screen the least and largest number of a curve; `None` if not measured.
    pub(super) fn curve_column_ranges(
        &self,
        of: (CurveLane, usize),
        window: &TimeWindow,
        width: usize,
    ) -> Vec<Option<(f32, f32)>> {
        self.series_column_ranges(|piece| piece.series.get(&of), window, width)
    }

    /// Returns the names of the stored curves that are not zero, as far as they are known.
    pub(super) fn nonzero_stored_curves(&self) -> Vec<&str> {
        let all_names = self.pieces.values().flat_map(|piece| piece.stored.keys());
        let all: BTreeSet<&str> = all_names.map(String::as_str).collect();
        all.into_iter().collect()
    }

    /// Returns the same as [`curve_column_ranges`](Self::curve_column_ranges) for a stored curve.
    pub(super) fn stored_columns(&self, name: &str, window: &TimeWindow, width: usize) -> Vec<Option<(f32, f32)>> {
        self.series_column_ranges(|piece| piece.stored.get(name), window, width)
    }

    /// Returns the number of a stored curve at a time; a curve that is not stored is at rest; `None` if its
    /// piece is not loaded.
    pub(super) fn stored_at(&self, name: &str, micros: i64) -> Option<f32> {
        let frame = self.source?.movement_frame_at(micros);
        let piece = self.pieces.get(&(frame / LANE_PIECE_FRAMES))?;
        let series = piece.stored.get(name);
        Some(
            series
                .and_then(|series| series.values.get(frame % LANE_PIECE_FRAMES).copied())
                .unwrap_or(0.0),
        )
    }

    /// Returns the visible frames of a curve as runs without gaps, each from left to right. `None` if frames
    /// are too narrow to be drawn separately.
    pub(super) fn visible_frame_runs(
        &self,
        of: (CurveLane, usize),
        window: &TimeWindow,
        width: f32,
    ) -> Option<Vec<FrameRun>> {
        self.series_frame_runs(|piece| piece.series.get(&of), window, width)
    }

    /// Returns the same for a stored curve.
    pub(super) fn stored_runs(&self, name: &str, window: &TimeWindow, width: f32) -> Option<Vec<FrameRun>> {
        self.series_frame_runs(|piece| piece.stored.get(name), window, width)
    }

    fn series_frame_runs<'a>(
        &'a self,
        series: impl Fn(&'a CurvePiece) -> Option<&'a CurveSeries>,
        window: &TimeWindow,
        width: f32,
    ) -> Option<Vec<FrameRun>> {
        let source = self.source?;
        let time = |frame: usize| (source.rate.frame_start_instant(frame).instant_micros() + source.offset) as f64;
        if source.frames < 2 || !lane_shape::is_wide(window.time_to_points(time(1)) - window.time_to_points(time(0))) {
            return None;
        }
        // One frame more on both sides, so that the line leaves the window.
        let first = source
            .movement_frame_at(window.points_to_micros(0.0) as i64)
            .saturating_sub(1);
        let last = (source.movement_frame_at(window.points_to_micros(width) as i64) + 2).min(source.frames);
        let mut runs = vec![FrameRun::new()];
        for frame in first..last {
            let piece = self.pieces.get(&(frame / LANE_PIECE_FRAMES));
            let value = piece.and_then(&series);
            match value.and_then(|curve| curve.values.get(frame % LANE_PIECE_FRAMES)) {
                Some(value) => {
                    if let Some(run) = runs.last_mut() {
                        run.push((window.time_to_points(time(frame)), *value));
                    }
                }
                // A gap in the measurement interrupts the line.
                None => runs.push(FrameRun::new()),
            }
        }
        runs.retain(|run| run.len() > 1);
        Some(runs)
    }

    /// Returns whether nothing has been measured yet.
    pub(super) fn is_bare(&self) -> bool {
        self.pieces.is_empty()
    }

    fn series_column_ranges<'a>(
        &'a self,
        series: impl Fn(&'a CurvePiece) -> Option<&'a CurveSeries>,
        window: &TimeWindow,
        width: usize,
    ) -> Vec<Option<(f32, f32)>> {
        let Some(source) = self.source else {
            return vec![None; width];
        };
        let column = |x: usize| {
            let (from, to) = (
                window.points_to_micros(x as f32),
                window.points_to_micros(x as f32 + 1.0),
            );
            let end = source
                .rate
                .frame_range_span(0..source.frames)
                .span_end_instant()
                .instant_micros()
                + source.offset;
            // Outside the movement there is nothing to draw, not even its first or last value.
            if to < source.offset as f64 || from > end as f64 {
                return None;
            }
            let (from, to) = (
                source.movement_frame_at(from as i64),
                source.movement_frame_at(to as i64) + 1,
            );
            let pieces = self
                .pieces
                .range(from / LANE_PIECE_FRAMES..=(to - 1) / LANE_PIECE_FRAMES);
            pieces
                .filter_map(|(number, piece)| {
                    let first = number * LANE_PIECE_FRAMES;
                    series(piece)?.series_range_ends(from.saturating_sub(first), to.saturating_sub(first))
                })
                .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        };
        (0..width).map(column).collect()
    }

    /// Returns the number of a curve at a time.
    pub(super) fn curve_value_at(&self, lane: CurveLane, hand: usize, micros: i64) -> Option<f32> {
        let frame = self.source?.movement_frame_at(micros);
        let piece = self.pieces.get(&(frame / LANE_PIECE_FRAMES))?;
        piece
            .series
            .get(&(lane, hand))?
            .values
            .get(frame % LANE_PIECE_FRAMES)
            .copied()
    }

    /// Returns the direction of a palm at a time, in words.
    pub(super) fn palm_direction_at(&self, hand: usize, micros: i64) -> Option<InterfaceText> {
        let frame = self.source?.movement_frame_at(micros);
        let piece = self.pieces.get(&(frame / LANE_PIECE_FRAMES))?;
        Some(nearest_direction_text(
            *piece.palms[hand].get(frame % LANE_PIECE_FRAMES)?,
        ))
    }
}

impl MovementFrames {
    fn movement_frame_at(&self, micros: i64) -> usize {
        let clip_time = RecordingInstant::from_micros((micros - self.offset).max(0));
        self.rate.nearest_frame_at(clip_time).min(self.frames.saturating_sub(1))
    }
}

/// Returns the name of the main direction that is nearest to `[left, up, forward]`.
fn nearest_direction_text([left, up, forward]: [f32; 3]) -> InterfaceText {
    let directions = [
        (left, words::TO_LEFT),
        (-left, words::TO_RIGHT),
        (up, words::TO_UP),
        (-up, words::TO_DOWN),
        (forward, words::TO_FRONT),
        (-forward, words::TO_BACK),
    ];
    let best = directions.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(words::TO_UP, |(_, text)| text)
}

impl CurvePiece {
    fn new(all: &ClipKinematicCurves, minima: Vec<i64>) -> Self {
        let mut series = BTreeMap::new();
        for (number, hand) in all.hands.iter().enumerate() {
            series.insert((CurveLane::Speed, number), CurveSeries::new(hand.speed.iter().copied()));
            series.insert(
                (CurveLane::Aperture, number),
                CurveSeries::new(hand.aperture.iter().copied()),
            );
            let up = hand.palm.iter().map(|palm| palm.y);
            series.insert((CurveLane::Palm, number), CurveSeries::new(up));
        }
        series.insert((CurveLane::Distance, 0), CurveSeries::new(all.distance.iter().copied()));
        let palms = [0, 1].map(|hand: usize| {
            let palms = all.hands[hand].palm.iter();
            palms
                .map(|point| [point.x as f32, point.y as f32, point.z as f32])
                .collect()
        });
        Self {
            series,
            stored: BTreeMap::new(),
            palms,
            minima,
        }
    }
}

/// Returns the time span in a window of that width, in microseconds.
pub(super) fn visible_window_span(window: &TimeWindow, width: f32, whole: TimeSpan) -> (i64, i64) {
    let (start, end) = whole.span_bounds_micros();
    let clamped_time = |micros: f64| (micros as i64).clamp(start, end);
    (clamped_time(window.start), clamped_time(window.points_to_micros(width)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::HandCurves;

    fn source(frames: usize) -> MovementFrames {
        MovementFrames {
            recording: 1,
            frames,
            rate: FrameRate::new(100, 1).expect("a rate"),
            offset: 0,
        }
    }

    fn measured(frames: usize, speed: impl Fn(usize) -> f64) -> MeasuredCurves {
        let mut curves = MeasuredCurves {
            source: Some(source(frames)),
            ..MeasuredCurves::default()
        };
        for piece in 0..frames.div_ceil(LANE_PIECE_FRAMES) {
            let inside = piece * LANE_PIECE_FRAMES..((piece + 1) * LANE_PIECE_FRAMES).min(frames);
            let right = HandCurves {
                speed: inside.clone().map(&speed).collect(),
                ..HandCurves::default()
            };
            let all = ClipKinematicCurves {
                hands: [right, HandCurves::default()],
                distance: Vec::new(),
            };
            let minima = vec![inside.start as i64 * 10_000];
            curves.pieces.insert(piece, CurvePiece::new(&all, minima));
        }
        curves
    }

    #[test]
    fn no_peak_is_lost_however_narrow_the_columns() {
        let curves = measured(10_000, |frame| if frame == 5_003 { 9.0 } else { 1.0 });
        for width in [10, 333, 900] {
            let window = TimeWindow {
                start: 0.0,
                scale: 100e6 / width as f64,
            };
            let columns = curves.curve_column_ranges((CurveLane::Speed, 0), &window, width);
            let high = columns.iter().flatten().map(|it| it.1).fold(0.0, f32::max);
            assert_eq!(high, 9.0, "{width}");
            assert!(columns.iter().flatten().all(|it| it.0 == 1.0));
        }
        let past = TimeWindow {
            start: 99.5e6,
            scale: 1e4,
        };
        let columns = curves.curve_column_ranges((CurveLane::Speed, 0), &past, 100);
        assert!(columns[10].is_some() && columns[90].is_none());
        assert_eq!(curves.curve_column_ranges((CurveLane::Speed, 1), &past, 1), [None]);
        assert_eq!(curves.largest_lane_value(CurveLane::Speed), 9.0);
        assert_eq!(curves.curve_value_at(CurveLane::Speed, 0, 50_030_000), Some(9.0));
    }

    #[test]
    fn wide_frames_form_a_line_with_gaps_at_missing_values() {
        let mut curves = measured(5_000, |frame| frame as f64);
        let window = |start: f64, scale: f64| TimeWindow { start, scale };
        // 10 milliseconds are 5 points.
        let runs = curves.visible_frame_runs((CurveLane::Speed, 0), &window(11.9e6, 2_000.0), 200.0);
        let runs = runs.expect("wide frames");
        assert_eq!(runs.len(), 1, "the seam of two pieces is no gap");
        assert!(runs[0][0].0 <= 0.0 && runs[0].last().expect("one").0 >= 200.0);
        for pair in runs[0].windows(2) {
            assert!((pair[1].0 - pair[0].0 - 5.0).abs() < 1e-2 && pair[1].1 - pair[0].1 == 1.0);
        }
        curves.pieces.remove(&1);
        let runs = curves.visible_frame_runs((CurveLane::Speed, 0), &window(11.9e6, 2_000.0), 200.0);
        assert_eq!(runs.expect("wide frames").len(), 1);
        let narrow = curves.visible_frame_runs((CurveLane::Speed, 0), &window(0.0, 20_000.0), 200.0);
        assert_eq!(narrow, None, "columns are drawn there");
    }

    #[test]
    fn visible_pieces_are_measured_from_the_playhead_outwards() {
        let mut curves = MeasuredCurves::default();
        let all = source(12_000);
        let out = CommandOutbox::default();
        curves.request_curve_pieces(Some(all), (0, 40_000_000), 30_000_000, &out);
        assert_eq!(curves.asked.map(|it| it.1), Some(2));
        curves.asked = None;
        curves.pieces.insert(2, CurvePiece::default());
        assert_eq!(curves.next(all, 0, 40_000_000, 30_000_000), Some(1));
        assert_eq!(curves.next(all, 30_000_000, 30_000_000, 0), None);
    }

    #[test]
    fn stored_curves_are_listed_if_they_are_not_zero() {
        let mut curves = measured(3_000, |_| 1.0);
        let piece = curves.pieces.get_mut(&1).expect("a piece");
        let brows = CurveSeries::new((0..LANE_PIECE_FRAMES).map(|frame| if frame < 600 { 0.0 } else { 0.5 }));
        piece.stored.insert("brows.RB".into(), brows);
        assert_eq!(curves.nonzero_stored_curves(), ["brows.RB"]);
        let at = |micros| curves.stored_at("brows.RB", micros);
        assert_eq!(at(0), Some(0.0));
        assert_eq!(at(23_000_000), Some(0.5));
        let window = TimeWindow {
            start: 0.0,
            scale: 30e6 / 30.0,
        };
        let columns = curves.stored_columns("brows.RB", &window, 30);
        assert_eq!(columns[5], None);
        assert_eq!(columns[13], Some((0.0, 0.0)));
        assert_eq!(columns[20], Some((0.5, 0.5)));
    }

    #[test]
    fn minima_are_limited_to_the_requested_time() {
        let curves = measured(5_000, |_| 1.0);
        assert_eq!(curves.wrist_speed_minima(1, 25_000_000), [12_000_000, 24_000_000]);
        assert_eq!(nearest_direction_text([0.1, -0.9, 0.2]), words::TO_DOWN);
    }
}
