//! The content of the timeline, without widgets: positions of times, ticks, and bars.

use chereme_corpus::{AnnotationColumns, TierContents, ValueState};
use chereme_motion::{RecordingInstant, TimeSpan};

use crate::model::time_window::TimeWindow;

/// Returns the first window of a recording, with `at` in it. Returns `None`, which shows everything, if annotations are
/// readable then; otherwise a window in which annotations of median length are.
pub(crate) fn first_window(tiers: &[TierContents], whole: TimeSpan, at: f64, width: f32) -> Option<TimeWindow> {
    /// The least width of an annotation of median length, in points, for which everything is shown; and its width in
    /// the window otherwise.
    const MIN_ANNOTATION_WIDTH_POINTS: f64 = 14.0;
    const WIDE_ANNOTATION_POINTS: f64 = 56.0;
    /// Without annotations, the width of the window, and the least width of any window, in microseconds.
    const MINUTE_WINDOW_MICROS: f64 = 60e6;
    const FEW_SECONDS: f64 = 4e6;
    let all = TimeWindow::window_of_whole(whole, width);
    let mut lengths: Vec<i64> = Vec::new();
    for tier in tiers {
        let columns = &tier.annotations;
        lengths.extend(columns.ends.iter().zip(&columns.starts).map(|(end, start)| end - start));
    }
    let middle = lengths.len() / 2;
    let usual = (!lengths.is_empty()).then(|| *lengths.select_nth_unstable(middle).1 as f64);
    let points = f64::from(width.max(1.0));
    let scale = match usual {
        Some(usual) if usual / all.scale >= MIN_ANNOTATION_WIDTH_POINTS => return None,
        // Not nearer than a few seconds, however short annotations are.
        Some(usual) => (usual.max(1000.0) / WIDE_ANNOTATION_POINTS).max(FEW_SECONDS / points),
        None if whole.span_micros() as f64 <= MINUTE_WINDOW_MICROS => return None,
        None => MINUTE_WINDOW_MICROS / points,
    };
    if scale >= all.scale {
        return None;
    }
    // A tenth of the window lies before the time, so that what led to it is visible.
    let start = at - points * scale * 0.1;
    Some(TimeWindow { start, scale }.clamp_window_within(whole, width))
}

/// A mark of the ruler.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RulerTick {
    pub(crate) micros: i64,
    /// Its text; `None` for small marks.
    pub(crate) text: Option<String>,
}

/// Returns the marks of a ruler `width` points wide, those with text at least 80 points apart.
pub(crate) fn ruler_ticks(window: &TimeWindow, width: f32) -> Vec<RulerTick> {
    const RULER_STEPS_MICROS: [i64; 16] = [
        1_000,
        2_000,
        5_000,
        10_000,
        20_000,
        50_000,
        100_000,
        200_000,
        500_000,
        1_000_000,
        2_000_000,
        5_000_000,
        10_000_000,
        30_000_000,
        60_000_000,
        300_000_000,
    ];
    let least = window.scale * 80.0;
    let fits = RULER_STEPS_MICROS.into_iter().find(|step| *step as f64 >= least);
    let step = fits.unwrap_or_else(|| {
        // Beyond the table the steps are whole multiples of ten minutes.
        let hours = (least / 600e6).ceil().max(1.0);
        600_000_000 * hours as i64
    });
    let small = (step / 5).max(1);
    let first = (window.start / small as f64).ceil() as i64;
    let last = (window.points_to_micros(width) / small as f64).floor() as i64;
    // A window that is absurdly long draws no more than this.
    (first..=last.min(first + 2000))
        .map(|at| {
            let micros = at * small;
            let text = (micros % step == 0).then(|| time_text(RecordingInstant::from_micros(micros)));
            RulerTick { micros, text }
        })
        .collect()
}

/// Returns a time as text: `0:01.250`, `1:02:03.000`.
pub(crate) fn time_text(at: RecordingInstant) -> String {
    let micros = at.instant_micros();
    let sign = if micros < 0 { "-" } else { "" };
    let millis = micros.unsigned_abs() / 1000;
    let (seconds, rest) = (millis / 1000, millis % 1000);
    let (minutes, hours) = (seconds / 60, seconds / 3600);
    if hours > 0 {
        format!("{sign}{hours}:{:02}:{:02}.{rest:03}", minutes % 60, seconds % 60)
    } else {
        format!("{sign}{minutes}:{:02}.{rest:03}", seconds % 60)
    }
}

/// Returns a duration as text: `0.680 s`.
pub(crate) fn length_text(micros: i64) -> String {
    let millis = micros.max(0) / 1000;
    format!("{}.{:03} s", millis / 1000, millis % 1000)
}

/// An annotation on the timeline, or several that are too narrow to be drawn separately.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct AnnotationBar {
    /// Index of the first one in the tier's columns.
    pub(crate) at: usize,
    /// The number of annotations.
    pub(crate) count: usize,
    /// Start of the first and end of the last, in microseconds.
    pub(crate) start: i64,
    pub(crate) end: i64,
}

/// Returns the bars of a tier that lie in `from..to`; annotations narrower than `narrow` microseconds are joined with
/// their neighbours.
///
/// The running time depends on the number of bars, not on the number of annotations.
pub(crate) fn join_annotation_bars(columns: &AnnotationColumns, from: i64, to: i64, narrow: i64) -> Vec<AnnotationBar> {
    let (starts, ends) = (&columns.starts, &columns.ends);
    let mut index = starts.partition_point(|start| *start < from);
    // Annotations that begin before the window may reach into it.
    while index > 0 && ends[index - 1] > from {
        index -= 1;
    }
    let last = starts.partition_point(|start| *start < to);
    let mut bars = Vec::new();
    while index < last {
        let (start, end) = (starts[index], ends[index]);
        let next = if end - start >= narrow {
            index + 1
        } else {
            let limit = start + narrow;
            let near = starts[index..last].partition_point(|start| *start < limit);
            // A wide annotation among narrow ones is drawn on its own.
            let wide = (index + 1..index + near).find(|other| ends[*other] - starts[*other] >= narrow);
            wide.unwrap_or(index + near).max(index + 1)
        };
        bars.push(AnnotationBar {
            at: index,
            count: next - index,
            start,
            end: ends[next - 1].max(end),
        });
        index = next;
    }
    bars
}

/// Returns the annotation of a tier at a moment, as its index in the columns.
pub(crate) fn annotation_index_at(columns: &AnnotationColumns, micros: i64) -> Option<usize> {
    let after = columns.starts.partition_point(|start| *start <= micros);
    let index = after.checked_sub(1)?;
    // An annotation of no length is found at its start.
    (columns.ends[index] > micros || columns.starts[index] == micros).then_some(index)
}

/// Returns the text of an annotation's value; `missing` returns the text for a missing value.
pub(crate) fn value_text<'a>(
    columns: &'a AnnotationColumns,
    at: usize,
    missing: impl Fn(ValueState) -> &'a str,
) -> &'a str {
    match columns.states[at] {
        ValueState::Value => &columns.values[at],
        state => missing(state),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(spans: &[(i64, i64)]) -> AnnotationColumns {
        let count = spans.len();
        AnnotationColumns {
            ids: (1..=count as i64).collect(),
            starts: spans.iter().map(|it| it.0).collect(),
            ends: spans.iter().map(|it| it.1).collect(),
            states: vec![ValueState::Value; count],
            values: vec!["A".into(); count],
            parents: vec![None; count],
            confidences: vec![None; count],
        }
    }

    fn span(start: i64, end: i64) -> TimeSpan {
        TimeSpan::from_span_micros(start, end)
    }

    #[test]
    fn only_visible_bars_are_drawn_and_narrow_ones_are_merged() {
        let all = columns(&[(0, 100), (100, 110), (110, 112), (112, 300), (400, 500)]);
        let shown = |from, to, narrow| -> Vec<(usize, usize)> {
            join_annotation_bars(&all, from, to, narrow)
                .iter()
                .map(|bar| (bar.at, bar.count))
                .collect()
        };
        assert_eq!(shown(0, 1000, 1), [(0, 1), (1, 1), (2, 1), (3, 1), (4, 1)]);
        assert_eq!(shown(0, 1000, 20), [(0, 1), (1, 2), (3, 1), (4, 1)]);
        assert_eq!(shown(50, 105, 1), [(0, 1), (1, 1)]);
        assert_eq!(shown(300, 400, 1), []);
        assert_eq!(shown(0, 1000, 100_000), [(0, 5)]);
        assert_eq!(join_annotation_bars(&all, 0, 1000, 100_000)[0].end, 500);
        assert_eq!(join_annotation_bars(&columns(&[]), 0, 10, 1), []);
    }

    #[test]
    fn the_annotation_under_the_pointer_is_found() {
        let all = columns(&[(0, 100), (100, 200), (300, 400)]);
        for (micros, want) in [
            (0, Some(0)),
            (99, Some(0)),
            (100, Some(1)),
            (250, None),
            (399, Some(2)),
            (400, None),
            (-1, None),
        ] {
            assert_eq!(annotation_index_at(&all, micros), want, "{micros}");
        }
    }

    #[test]
    fn a_long_recording_opens_at_a_readable_zoom_around_the_playhead() {
        let tiers = |length: i64, count: i64| -> Vec<TierContents> {
            let spans: Vec<(i64, i64)> = (0..count).map(|n| (n * length, (n + 1) * length)).collect();
            let annotations = columns(&spans);
            vec![TierContents {
                row: chereme_corpus::TierRow::default(),
                annotations,
            }]
        };
        let hour = span(0, 3_600_000_000);
        let first = |tiers: &[TierContents], whole, at| first_window(tiers, whole, at, 1000.0);
        assert_eq!(first(&tiers(500_000, 6), span(0, 3_000_000), 0.0), None);
        assert_eq!(first(&[], span(0, 50_000_000), 0.0), None);
        let found = first(&tiers(500_000, 7200), hour, 1.8e9).expect("a part");
        let usual = found.time_to_points(500_000.0) - found.time_to_points(0.0);
        assert!((40.0..80.0).contains(&usual), "{usual}");
        assert!((found.time_to_points(1.8e9) - 100.0).abs() < 1.0);
        let bare = first(&[], hour, 0.0).expect("a part");
        assert!((bare.points_to_micros(1000.0) - 60e6).abs() < 1.0);
        let frames = first(&tiers(8_000, 400_000), hour, 0.0).expect("a part");
        assert!(frames.points_to_micros(1000.0) >= 3.9e6);
    }

    #[test]
    fn a_window_keeps_its_place_when_zoomed_and_stays_within_the_recording() {
        let whole = span(0, 10_000_000);
        let window = TimeWindow::window_of_whole(whole, 1000.0);
        let near = window.zoomed_window(0.1, 5_000_000.0, whole, 1000.0);
        assert!((near.time_to_points(5_000_000.0) - window.time_to_points(5_000_000.0)).abs() < 0.01);
        assert!((near.points_to_micros(near.time_to_points(4_000_000.0)) - 4_000_000.0).abs() < 2000.0);
        let wide = near.zoomed_window(100.0, 0.0, whole, 1000.0);
        assert_eq!(wide.scale, window.scale);
        assert!(wide.start.abs() < 1e-3);
        assert_eq!(near.panned_window(-1e9, whole, 1000.0).start, 0.0);
        let end = near.panned_window(1e9, whole, 1000.0);
        assert!(end.time_to_points(10_000_000.0) < 1000.0 && end.time_to_points(10_000_000.0) > 900.0);
        let part = TimeWindow::window_of_range(2_000_000.0, 4_000_000.0, whole, 1000.0);
        assert_eq!((part.start, part.scale), (2_000_000.0, 2000.0));
        assert_eq!(
            TimeWindow::window_of_range(-9e9, 9e9, whole, 1000.0).scale,
            window.scale
        );
        let followed = near.window_following_time(9_000_000.0, whole, 1000.0);
        assert!((0.0..1000.0).contains(&followed.time_to_points(9_000_000.0)));
        assert_eq!(near.window_following_time(5_000_000.0, whole, 1000.0), near);
    }

    #[test]
    fn labels_of_the_ruler_never_overlap() {
        for scale in [150.0, 1_000.0, 77_777.0, 1e6, 3e9] {
            let window = TimeWindow {
                start: 123_456.0,
                scale,
            };
            let all = ruler_ticks(&window, 900.0);
            let texts: Vec<&RulerTick> = all.iter().filter(|tick| tick.text.is_some()).collect();
            assert!(!all.is_empty() && all.len() < 100, "{scale}: {}", all.len());
            for pair in texts.windows(2) {
                assert!(
                    window.time_to_points(pair[1].micros as f64) - window.time_to_points(pair[0].micros as f64) >= 79.9
                );
            }
        }
        for (micros, want) in [
            (0, "0:00.000"),
            (61_250_000, "1:01.250"),
            (3_723_004_000, "1:02:03.004"),
            (-1_500_000, "-0:01.500"),
        ] {
            assert_eq!(time_text(RecordingInstant::from_micros(micros)), want);
        }
    }
}
