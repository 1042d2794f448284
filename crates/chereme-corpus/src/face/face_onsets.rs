//! Begin and end of non-manuals relative to the signs that they span, for each construction.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use chereme_motion::RecordingInstant;
use chereme_sign::milestones::{ExpressionFunction, UTTERANCE_EDGE_MICROS};
use serde::Serialize;

use super::expressions;
use super::performances::{FACE_CHANNELS, sample_channel_numbers};
use crate::Corpus;
use crate::atomic_write;
use crate::curves::face_fits::CorpusFits;
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The frames per second at which onsets are determined.
const ONSET_SAMPLE_RATE_FPS: f64 = 60.0;
/// The smallest change from its start for which a channel counts as active in an expression, in the channel's unit.
const MIN_ACTIVE_CHANNEL_CHANGE: f64 = 0.8;
/// The longest expressions that are measured, in seconds; others are counted.
const MAX_EXPRESSION_SECONDS: f64 = 1_800.0;

/// Begin of a channel before the first sign and its end after the last one, in seconds; no end if it never comes back.
type ChannelReach = (f64, Option<f64>);

/// Begin and end of non-manuals, for each function and channel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NonmanualOnsets {
    /// The number of expressions that were examined.
    pub expressions: u64,
    /// The number of expressions without a face.
    pub without_face: u64,
    /// The number of expressions during whose signs nothing was measured at times.
    pub with_gaps: u64,
    /// The number of expressions of more than half an hour, which were not examined.
    pub too_long: u64,
    /// The statistics, by function and channel.
    pub rows: Vec<OnsetRow>,
}

/// Begin and end of one channel in the expressions of a function.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OnsetRow {
    /// The function.
    pub function: ExpressionFunction,
    /// The channel.
    pub channel: &'static str,
    /// The number of expressions in which the channel is active.
    pub n: u64,
    /// Begin minus the begin of the first sign, in seconds; below 0 the channel begins before it.
    pub onset_s: NumberQuartiles,
    /// The number of these expressions in which the channel comes back by half a second after M5.
    pub ends: u64,
    /// End minus the end of the last sign, in seconds; above 0 the channel ends after it. `None` if it never comes back.
    pub offset_s: Option<NumberQuartiles>,
}

/// The quartiles of some numbers (type 7: linear between order statistics).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NumberQuartiles {
    /// The first quartile.
    pub q1: f64,
    /// The median.
    pub median: f64,
    /// The third quartile.
    pub q3: f64,
}

impl NumberQuartiles {
    /// Returns the quartiles of numbers; `None` without any.
    pub(crate) fn quartiles_from_values(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        let quantile = |share: f64| {
            let place = share * last as f64;
            let (first, rest) = (place.floor() as usize, place.fract());
            values[first] + (values[(first + 1).min(last)] - values[first]) * rest
        };
        Some(Self {
            q1: quantile(0.25),
            median: quantile(0.5),
            q3: quantile(0.75),
        })
    }
}

impl Corpus {
    /// Returns begin and end of non-manuals relative to the manual signs that they span, for each function and channel.
    ///
    /// A channel begins when it has covered half of the distance from its value half a second before the expression to
    /// its extreme value in the body, and ends when it comes back to half. A channel that does not come back has no end.
    ///
    /// # Errors
    /// Fails if there are no expressions, or `progress` stops the work.
    pub fn measure_nonmanual_onsets(
        &self,
        function: Option<&ExpressionFunction>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<NonmanualOnsets> {
        let connection = self.store.read_connection();
        let mut reaches: BTreeMap<(ExpressionFunction, usize), Vec<ChannelReach>> = BTreeMap::new();
        let mut report = NonmanualOnsets {
            expressions: 0,
            without_face: 0,
            with_gaps: 0,
            too_long: 0,
            rows: Vec::new(),
        };
        let channels: Vec<usize> = (0..FACE_CHANNELS.len()).collect();
        let fits = CorpusFits::load_corpus_fits(connection)?;
        let all = stored_recordings::load_recording_rows(connection)?;
        for (done, row) in all.iter().enumerate() {
            progress.report_items(&row.name, done, all.len())?;
            for it in expressions::load_recording_expressions(connection, row.id, function, None)? {
                let marks = it.milestones.milestone_times();
                // Half a second more on both sides shows the face at rest before, and its return after.
                let from = marks[0].shifted_instant(-UTTERANCE_EDGE_MICROS).instant_seconds();
                let to = marks[4].shifted_instant(UTTERANCE_EDGE_MICROS).instant_seconds();
                // A wrong end can make an expression of days, and each frame of it would be sampled.
                if to - from > MAX_EXPRESSION_SECONDS {
                    report.too_long += 1;
                    continue;
                }
                report.expressions += 1;
                let moments: Vec<RecordingInstant> = (0..((to - from) * ONSET_SAMPLE_RATE_FPS) as usize)
                    .map(|n| RecordingInstant::from_seconds(from + n as f64 / ONSET_SAMPLE_RATE_FPS))
                    .collect();
                let Some(columns) = sample_channel_numbers(connection, row.id, &moments, &channels, &fits)? else {
                    report.without_face += 1;
                    continue;
                };
                let frame =
                    |at: RecordingInstant| ((at.instant_seconds() - from) * ONSET_SAMPLE_RATE_FPS).round() as usize;
                let signs = frame(marks[1])..frame(marks[3]);
                let has_gap = |column: &Vec<f64>| {
                    let sign_values = column.get(signs.clone());
                    sign_values.is_none_or(|own| own.iter().any(|value| value.is_nan()))
                };
                report.with_gaps += u64::from(columns.iter().flatten().any(has_gap));
                for (channel, column) in columns.iter().enumerate() {
                    let Some(column) = column else { continue };
                    let unit = FACE_CHANNELS[channel].counts_as_one;
                    let Some((on, off)) = find_channel_reach(column, signs.start, signs.end, unit) else {
                        continue;
                    };
                    let seconds = |frame: usize| from + frame as f64 / ONSET_SAMPLE_RATE_FPS;
                    let lags = (
                        seconds(on) - marks[1].instant_seconds(),
                        off.map(|off| seconds(off) - marks[3].instant_seconds()),
                    );
                    let key = (it.function.clone(), channel);
                    reaches.entry(key).or_default().push(lags);
                }
            }
        }
        if report.expressions + report.too_long == 0 {
            return Err(
                CorpusError::from_wrong_message("there are no expressions with a function").with_command_advice(
                    "annotate wh, yn, negation or topic on a tier called \"function\"; see `chereme milestones --help`",
                ),
            );
        }
        for ((function, channel), lags) in reaches {
            let n = lags.len() as u64;
            let (on, off): (Vec<f64>, Vec<Option<f64>>) = lags.into_iter().unzip();
            let off: Vec<f64> = off.into_iter().flatten().collect();
            let Some(onset_s) = NumberQuartiles::quartiles_from_values(on) else {
                continue;
            };
            report.rows.push(OnsetRow {
                function,
                channel: FACE_CHANNELS[channel].name,
                n,
                onset_s,
                ends: off.len() as u64,
                offset_s: NumberQuartiles::quartiles_from_values(off),
            });
        }
        Ok(report)
    }

    /// Draws onsets and offsets to an SVG: for each function and channel a box from the first to the third quartile with
    /// its median.
    ///
    /// # Errors
    /// Fails if the name does not end in `.svg`, the file exists already and `force` is not set, or it cannot be written.
    pub fn draw_onsets(&self, onsets: &NonmanualOnsets, to: &Path, force: bool) -> CorpusResult<()> {
        atomic_write::write_svg(to, force, &onsets_svg(onsets)).map(drop)
    }
}

/// Returns the frames at which a channel has covered half of the distance to its extreme value in the body, and at
/// which it comes back, if it does. `None` if it is not active, or was not measured where it begins.
fn find_channel_reach(column: &[f64], first: usize, last: usize, unit: f64) -> Option<(usize, Option<usize>)> {
    let mut before = column.get(..first)?.iter().copied();
    // The first measured value before the signs is the channel at rest.
    let rest = before.find(|value| value.is_finite())?;
    let body = column.get(first..last.min(column.len()))?;
    let away = |value: f64| (value - rest).abs();
    let (at, most) = body
        .iter()
        .enumerate()
        .filter(|(_, it)| it.is_finite())
        .max_by(|(_, a), (_, b)| away(**a).total_cmp(&away(**b)))?;
    if away(*most) < MIN_ACTIVE_CHANNEL_CHANGE * unit {
        return None;
    }
    let (peak, half) = (first + at, away(*most) / 2.0);
    // Beyond rest on the other side the channel is not in the expression, however far it goes.
    let side = (most - rest).signum();
    // The first frame without a number is the last one that is looked at.
    let out = |frame: &usize| column[*frame].is_nan() || (column[*frame] - rest) * side < half;
    let measured = |frame: &usize| !column[*frame].is_nan();
    // Searched backwards from the peak, so that an earlier, separate movement does not count as the onset.
    let on = (0..peak).rev().find(out).filter(measured)? + 1;
    let off = (peak..column.len()).find(out).filter(measured);
    Some((on, off))
}

/// Onset or offset of a row.
type OnsetRowQuartiles = fn(&OnsetRow) -> Option<NumberQuartiles>;

fn onsets_svg(onsets: &NonmanualOnsets) -> String {
    const ONSET_CHART_ROW_HEIGHT: usize = 22;
    const ONSET_CHART_NAMES_WIDTH: f64 = 260.0;
    const ONSET_CHART_WIDTH: f64 = 300.0;
    const ONSET_CHART_GAP: f64 = 40.0;
    let spread = |of: OnsetRowQuartiles| {
        let drawn = onsets.rows.iter().filter_map(of);
        let ends = drawn.flat_map(|quartiles| [quartiles.q1, quartiles.q3]);
        // A tenth of a second on both sides keeps zero inside, and the scale from a division by zero.
        ends.fold((-0.1_f64, 0.1_f64), |(low, high), end| (low.min(end), high.max(end)))
    };
    let height = 60 + ONSET_CHART_ROW_HEIGHT * onsets.rows.len();
    let width = ONSET_CHART_NAMES_WIDTH + 2.0 * ONSET_CHART_WIDTH + ONSET_CHART_GAP + 60.0;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let parts: [(&str, OnsetRowQuartiles, f64); 2] = [
        (
            "begin against the first sign [s]",
            |row| Some(row.onset_s),
            ONSET_CHART_NAMES_WIDTH,
        ),
        (
            "end against the last sign [s]",
            |row| row.offset_s,
            ONSET_CHART_NAMES_WIDTH + ONSET_CHART_WIDTH + ONSET_CHART_GAP,
        ),
    ];
    for (title, of, left) in parts {
        let (low, high) = spread(of);
        let x = |value: f64| left + (value - low) / (high - low) * ONSET_CHART_WIDTH;
        let _ = writeln!(text, "<text x=\"{left:.0}\" y=\"20\">{title}</text>");
        let bottom = height - 20;
        let _ = writeln!(
            text,
            "<line x1=\"{0:.1}\" y1=\"30\" x2=\"{0:.1}\" y2=\"{bottom}\" stroke=\"#888\" stroke-dasharray=\"3 3\"/>",
            x(0.0)
        );
        // A label needs this much room beside that of zero.
        const MIN_TICK_LABEL_ROOM: f64 = 34.0;
        for value in [low, 0.0, high] {
            if value != 0.0 && (x(value) - x(0.0)).abs() < MIN_TICK_LABEL_ROOM {
                continue;
            }
            let _ = writeln!(
                text,
                "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{value:.2}</text>",
                x(value),
                height - 5
            );
        }
        for (n, row) in onsets.rows.iter().enumerate() {
            let y = 36 + n * ONSET_CHART_ROW_HEIGHT;
            let Some(it) = of(row) else { continue };
            let (from, to) = (x(it.q1), x(it.q3));
            let _ = writeln!(
                text,
                "<rect x=\"{from:.1}\" y=\"{y}\" width=\"{:.1}\" height=\"14\" fill=\"#9ecae1\" stroke=\"#3182bd\"/>\
                 <line x1=\"{2:.1}\" y1=\"{y}\" x2=\"{2:.1}\" y2=\"{1}\" stroke=\"#08306b\" stroke-width=\"2\"/>",
                (to - from).max(1.0),
                y + 14,
                x(it.median)
            );
        }
    }
    for (n, row) in onsets.rows.iter().enumerate() {
        let y = 48 + n * ONSET_CHART_ROW_HEIGHT;
        let function = row.function.function_name().replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(
            text,
            "<text x=\"8\" y=\"{y}\">{function}: {} (n = {})</text>",
            row.channel, row.n
        );
    }
    text.push_str("</svg>\n");
    text
}

#[cfg(test)]
mod tests {
    use super::{NumberQuartiles, find_channel_reach};

    #[test]
    fn a_channel_begins_and_ends_at_half_its_height() {
        let column: Vec<f64> = (0..100)
            .map(|n: i32| (f64::from(n - 20) / 10.0).min(f64::from(80 - n) / 20.0).clamp(0.0, 1.0))
            .collect();
        assert_eq!(find_channel_reach(&column, 30, 60, 0.25), Some((25, Some(71))));
        let down: Vec<f64> = column.iter().map(|it| -it).collect();
        assert_eq!(find_channel_reach(&down, 30, 60, 0.25), Some((25, Some(71))));
        assert_eq!(
            find_channel_reach(&column[..70], 30, 60, 0.25),
            Some((25, None)),
            "it never comes back"
        );
        let without = |gap: std::ops::Range<usize>| {
            let mut column = column.clone();
            column[gap].fill(f64::NAN);
            find_channel_reach(&column, 30, 60, 0.25)
        };
        assert_eq!(without(0..10), Some((25, Some(71))), "the rest is the first number");
        assert_eq!(without(0..30), None, "there is no rest");
        assert_eq!(without(20..28), None, "its begin was not measured");
        assert_eq!(without(65..75), Some((25, None)), "its end was not measured");
        let little: Vec<f64> = column.iter().map(|it| it * 0.1).collect();
        assert_eq!(find_channel_reach(&little, 30, 60, 0.25), None);
        assert_eq!(
            (
                find_channel_reach(&[], 0, 0, 1.0),
                find_channel_reach(&column, 200, 300, 1.0)
            ),
            (None, None)
        );
    }

    #[test]
    fn quartiles_lie_between_order_statistics() {
        let of = |values: &[f64]| {
            NumberQuartiles::quartiles_from_values(values.to_vec()).map(|it| [it.q1, it.median, it.q3])
        };
        assert_eq!(of(&[4.0, 1.0, 3.0, 2.0]), Some([1.75, 2.5, 3.25]));
        assert_eq!((of(&[5.0]), of(&[])), (Some([5.0; 3]), None));
    }
}
