//! Figures of a report as SVG inside the page: bars, boxes, shares, confusions, effects and correlations.
//!
//! Colours are shades of brown and teal, or of one blue, which colour-blind readers distinguish; each number stands
//! beside its colour. Units are pixels of the page.

use std::fmt::Write as _;

use chereme_analysis::statistics::GroupDescription;

use super::report_numbers::{format_percent, format_report_number};
use super::{AnswerShare, ConfusionTable, MeasurePoint, ResampledInterval};
use crate::map::escape_markup;
use crate::study::report::report_words as w;
use crate::words::InterfaceLanguage;

/// The width of every figure.
const CHART_WIDTH_PX: f64 = 860.0;
/// The shades of a scale, from its low end over its middle to its high end.
const SCALE_SHADES: [[f64; 3]; 5] = [
    [140.0, 81.0, 10.0],
    [223.0, 183.0, 106.0],
    [232.0, 230.0, 224.0],
    [96.0, 182.0, 174.0],
    [1.0, 90.0, 82.0],
];
/// The shades of a table, from no answer to all.
const CONFUSION_TABLE_SHADES: [[f64; 3]; 3] = [[255.0, 255.0, 255.0], [120.0, 170.0, 214.0], [12.0, 62.0, 117.0]];

/// A colour as red, green and blue, and whether letters on it are white.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ChartShade {
    /// Red, green and blue.
    pub rgb: [u8; 3],
    /// Whether white letters have more contrast on it than black ones.
    pub is_dark: bool,
}

impl ChartShade {
    /// Returns the colour of an answer on a scale: 0 is its low end, 1 its high end.
    #[must_use]
    pub fn of_scale(share: f64) -> Self {
        Self::colour_at_share(&SCALE_SHADES, share)
    }

    /// Returns the colour of a cell of a table: 0 is no answer, 1 all of them.
    #[must_use]
    pub fn of_table(share: f64) -> Self {
        Self::colour_at_share(&CONFUSION_TABLE_SHADES, share)
    }

    /// Returns the colour at a share of the path through some shades.
    fn colour_at_share(shades: &[[f64; 3]], share: f64) -> Self {
        let shade_position = share.clamp(0.0, 1.0) * (shades.len() - 1) as f64;
        // The last shade has no next one to be mixed with.
        let low = (shade_position.floor() as usize).min(shades.len() - 2);
        let mix = |n: usize| {
            let [from, to] = [shades[low][n], shades[low + 1][n]];
            (from + (to - from) * (shade_position - low as f64)).round()
        };
        let rgb = [mix(0), mix(1), mix(2)];
        let linear = rgb.map(|channel| {
            // Contrast is defined for linear light, and not for the stored values.
            let it = channel / 255.0;
            if it <= 0.03928 {
                it / 12.92
            } else {
                ((it + 0.055) / 1.055).powf(2.4)
            }
        });
        // Relative luminance (WCAG 2.1): below 0.179 white letters have more contrast than black ones.
        let light = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        Self {
            rgb: rgb.map(|channel| channel as u8),
            is_dark: light < 0.179,
        }
    }
}

/// Returns the colour at a share of the path through some shades, and the colour of letters on it.
fn shade_at_share(shades: &[[f64; 3]], share: f64) -> (String, &'static str) {
    let ChartShade { rgb, is_dark } = ChartShade::colour_at_share(shades, share);
    let letters = if is_dark { "#fff" } else { "#000" };
    let [red, green, blue] = rgb;
    (format!("#{red:02x}{green:02x}{blue:02x}"), letters)
}

/// A figure that grows by elements.
struct SvgChart {
    body: String,
    height: f64,
}

impl SvgChart {
    fn new() -> Self {
        Self {
            body: String::new(),
            height: 0.0,
        }
    }

    fn add_svg_text(&mut self, at: [f64; 2], class: &str, text: &str) {
        let [x, y] = at;
        let text = escape_markup(text);
        // Formatting into a string never fails.
        let _ = write!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" class=\"{class}\">{text}</text>"
        );
    }

    fn rect(&mut self, at: [f64; 2], size: [f64; 2], style: &str) {
        let ([x, y], [w, h]) = (at, size);
        let _ = write!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{h:.1}\" {style}/>",
            // Rounding may make a width slightly negative, which SVG does not allow.
            w.max(0.0)
        );
    }

    fn add_svg_line(&mut self, from: [f64; 2], to: [f64; 2], class: &str) {
        let ([x1, y1], [x2, y2]) = (from, to);
        let _ = write!(
            self.body,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" class=\"{class}\"/>"
        );
    }

    fn add_svg_dot(&mut self, at: [f64; 2], radius: f64, class: &str) {
        let [x, y] = at;
        let _ = write!(
            self.body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" class=\"{class}\"/>"
        );
    }

    /// Ends the figure; `title` is read to people who do not see it.
    fn finish_svg(self, title: &str) -> String {
        let title = escape_markup(title);
        format!(
            "<svg viewBox=\"0 0 {CHART_WIDTH_PX} {:.0}\" role=\"img\"><title>{title}</title>{}</svg>\n",
            self.height, self.body
        )
    }
}

/// Returns the room for labels beside a figure, by the longest of them.
fn label_margin<'a>(labels: impl Iterator<Item = &'a str>) -> f64 {
    let width = |label: &str| -> f64 {
        let letters = shorten_chart_label(label);
        // The font is not known here, so the width of letters is estimated.
        letters.chars().map(|c| if c.is_uppercase() { 9.8 } else { 7.6 }).sum()
    };
    (labels.map(width).fold(0.0, f64::max) + 18.0).clamp(70.0, 330.0)
}

/// Returns a label that fits into the room for labels.
fn shorten_chart_label(label: &str) -> String {
    const MAX_LABEL_CHARS: usize = 34;
    if label.chars().count() <= MAX_LABEL_CHARS {
        return label.to_owned();
    }
    let start: String = label.chars().take(MAX_LABEL_CHARS - 1).collect();
    format!("{start}…")
}

/// One row of bars: a label and how often each answer was given.
pub(super) struct BarRow<'a> {
    /// Its label.
    pub(super) label: &'a str,
    /// The counts, from the low end of the scale to the high end.
    pub(super) counts: &'a [usize],
}

/// Draws stacked bars that are centred on the middle of the scale; `legend` has the words of each answer.
pub(super) fn diverging_bar_chart(bars: &[BarRow<'_>], legend: &[String], language: InterfaceLanguage) -> String {
    let mut svg = SvgChart::new();
    let points = legend.len();
    let colour = |at: usize| shade_at_share(&SCALE_SHADES, at as f64 / (points.max(2) - 1) as f64);
    let mut x = 4.0;
    let mut y = 6.0;
    for (at, text) in legend.iter().enumerate() {
        let width = 30.0 + text.chars().count() as f64 * 7.3;
        if x + width > CHART_WIDTH_PX {
            (x, y) = (4.0, y + 22.0);
        }
        svg.rect(
            [x, y],
            [14.0, 14.0],
            &format!("fill=\"{}\" class=\"edge\"", colour(at).0),
        );
        svg.add_svg_text([x + 20.0, y + 12.0], "small", text);
        x += width + 6.0;
    }
    let top = y + 30.0;
    let left = label_margin(bars.iter().map(|bar| bar.label));
    let right = 70.0;
    let share = |counts: &[usize], at: usize| {
        let all: usize = counts.iter().sum();
        // A bar without answers has no shares.
        counts[at] as f64 / (all.max(1)) as f64
    };
    // The middle answer of an odd scale counts half on each side.
    let below = |counts: &[usize]| -> f64 {
        let lower_share: f64 = (0..points / 2).map(|at| share(counts, at)).sum();
        if points % 2 == 1 {
            lower_share + share(counts, points / 2) / 2.0
        } else {
            lower_share
        }
    };
    // Without answers on one side, the axis would stand at the very edge.
    let lows = bars.iter().map(|bar| below(bar.counts)).fold(0.1, f64::max);
    let highs = bars.iter().map(|bar| 1.0 - below(bar.counts)).fold(0.1, f64::max);
    let unit = (CHART_WIDTH_PX - left - right) / (lows + highs);
    let middle = left + lows * unit;
    let bottom = top + bars.len() as f64 * 38.0;
    for quarter in -4..=4_i32 {
        let tick = f64::from(quarter) / 4.0;
        if -tick <= lows + 1e-9 && tick <= highs + 1e-9 {
            let class = if quarter == 0 { "axis" } else { "grid" };
            svg.add_svg_line([middle + tick * unit, top - 6.0], [middle + tick * unit, bottom], class);
            let words = format!("{}%", 25 * quarter.abs());
            svg.add_svg_text([middle + tick * unit, bottom + 16.0], "small mid", &words);
        }
    }
    for (row, bar) in bars.iter().enumerate() {
        let y = top + row as f64 * 38.0;
        svg.add_svg_text([left - 10.0, y + 19.0], "end", &shorten_chart_label(bar.label));
        let all: usize = bar.counts.iter().sum();
        let mut x = middle - below(bar.counts) * unit;
        for at in 0..points.min(bar.counts.len()) {
            let width = share(bar.counts, at) * unit;
            let (fill, letters) = colour(at);
            svg.rect([x, y], [width, 28.0], &format!("fill=\"{fill}\" class=\"edge\""));
            let words = format_report_number(100.0 * share(bar.counts, at), 0, language);
            // A number that does not fit would overlap the next part.
            if width > 9.0 + words.len() as f64 * 8.0 {
                let class = if letters == "#fff" {
                    "small mid light"
                } else {
                    "small mid"
                };
                svg.add_svg_text([x + width / 2.0, y + 19.0], class, &words);
            }
            x += width;
        }
        svg.add_svg_text(
            [CHART_WIDTH_PX - right + 12.0, y + 19.0],
            "small",
            &format!("n = {all}"),
        );
    }
    svg.height = bottom + 24.0;
    svg.finish_svg(w::BARS.text_in_language(language))
}

/// One row of boxes: a label, the description of the answers, and the mean answer of each person.
pub(super) struct BoxRow<'a> {
    /// Its label.
    pub(super) label: &'a str,
    /// The description.
    pub(super) description: &'a GroupDescription,
    /// The means, in ascending order.
    pub(super) means: &'a [f64],
}

/// Draws box plots with median, mean and a dot for each person.
pub(super) fn box_plot_chart(rows: &[BoxRow<'_>], scale: [i64; 2], language: InterfaceLanguage) -> String {
    let mut svg = SvgChart::new();
    let left = label_margin(rows.iter().map(|row| row.label));
    let [low, high] = scale.map(|end| end as f64);
    let unit = (CHART_WIDTH_PX - left - 40.0) / (high - low).max(1.0);
    let place = |value: f64| left + 16.0 + (value - low) * unit;
    const BOX_ROW_HEIGHT_PX: f64 = 64.0;
    let bottom = 6.0 + rows.len() as f64 * BOX_ROW_HEIGHT_PX;
    // A scale with very many points would only be a grey area.
    for point in (scale[0]..=scale[1]).take(100) {
        let x = place(point as f64);
        svg.add_svg_line([x, 2.0], [x, bottom], "grid");
        svg.add_svg_text([x, bottom + 16.0], "small mid", &point.to_string());
    }
    for (at, row) in rows.iter().enumerate() {
        let y = 8.0 + at as f64 * BOX_ROW_HEIGHT_PX;
        let description = row.description;
        svg.add_svg_text([left - 10.0, y + 18.0], "end", &shorten_chart_label(row.label));
        svg.add_svg_line(
            [place(description.whisker_low), y + 13.0],
            [place(description.whisker_high), y + 13.0],
            "stroke",
        );
        for end in [description.whisker_low, description.whisker_high] {
            svg.add_svg_line([place(end), y + 6.0], [place(end), y + 20.0], "stroke");
        }
        // A box without spread would be invisible.
        let width = (place(description.q3) - place(description.q1)).max(3.0);
        svg.rect([place(description.q1), y], [width, 26.0], "class=\"box\"");
        svg.add_svg_line(
            [place(description.median), y],
            [place(description.median), y + 26.0],
            "median",
        );
        svg.add_svg_line(
            [place(description.mean), y - 3.0],
            [place(description.mean), y + 29.0],
            "mean",
        );
        let mut outside = description.outliers.clone();
        // Equal values would be drawn on top of each other.
        outside.dedup();
        for value in outside {
            svg.add_svg_dot([place(value), y + 13.0], 3.5, "ring");
        }
        swarm(&mut svg, row.means, y + 35.0, &place);
    }
    svg.height = bottom + 24.0;
    svg.finish_svg(w::BOXES.text_in_language(language))
}

/// Draws a dot for each value; near values stand in columns of five, side by side around their place.
fn swarm(svg: &mut SvgChart, values: &[f64], top: f64, place: &dyn Fn(f64) -> f64) {
    const SWARM_DOT_STEP_PX: f64 = 5.4;
    // Dots that are nearer than this would cover each other.
    let near = |a: &f64, b: &f64| place(*b) - place(*a) < 2.0;
    for group in values.chunk_by(near) {
        let columns = group.len().div_ceil(5);
        let left = place(group[0]) - SWARM_DOT_STEP_PX * (columns - 1) as f64 / 2.0;
        for at in 0..group.len() {
            // Columns are filled row by row, so that the lowest row alone is incomplete.
            let (row, column) = (at / columns, at % columns);
            let x = left + SWARM_DOT_STEP_PX * column as f64;
            svg.add_svg_dot([x, top + SWARM_DOT_STEP_PX * row as f64], 2.4, "person");
        }
    }
}

/// Draws bars of shares with their intervals; `chance` is the share of right answers by guessing.
pub(super) fn share_bar_chart(
    rows: &[(&str, &AnswerShare)],
    chance: Option<f64>,
    language: InterfaceLanguage,
) -> String {
    let mut svg = SvgChart::new();
    let left = label_margin(rows.iter().map(|row| row.0));
    let right = 170.0;
    let unit = CHART_WIDTH_PX - left - right;
    let bottom = 6.0 + rows.len() as f64 * 32.0;
    for quarter in 0..=4_i32 {
        let x = left + f64::from(quarter) / 4.0 * unit;
        svg.add_svg_line([x, 2.0], [x, bottom], if quarter == 0 { "axis" } else { "grid" });
        svg.add_svg_text([x, bottom + 16.0], "small mid", &format!("{}%", 25 * quarter));
    }
    for (at, (label, share)) in rows.iter().enumerate() {
        let y = 8.0 + at as f64 * 32.0;
        svg.add_svg_text([left - 10.0, y + 16.0], "end", &shorten_chart_label(label));
        svg.rect([left, y], [share.share * unit, 22.0], "class=\"share\"");
        let [low, high] = share.interval.map(|value| left + value * unit);
        svg.add_svg_line([low, y + 11.0], [high, y + 11.0], "stroke");
        for end in [low, high] {
            svg.add_svg_line([end, y + 5.0], [end, y + 17.0], "stroke");
        }
        let words = format!(
            "{}  ({}/{})",
            format_percent(share.share, language),
            share.right,
            share.of
        );
        svg.add_svg_text([CHART_WIDTH_PX - right + 14.0, y + 16.0], "small", &words);
    }
    if let Some(chance) = chance {
        let x = left + chance * unit;
        svg.add_svg_line([x, 2.0], [x, bottom], "chance");
    }
    svg.height = bottom + 24.0;
    svg.finish_svg(w::SHARES.text_in_language(language))
}

/// Draws a table of right and chosen options; darker cells have more answers of their row.
pub(super) fn confusion_table_chart(table: &ConfusionTable, language: InterfaceLanguage) -> String {
    let mut svg = SvgChart::new();
    let left = label_margin(table.rows.iter().map(String::as_str));
    let cell = ((CHART_WIDTH_PX - left - 60.0) / table.columns.len().max(1) as f64).clamp(12.0, 56.0);
    let longest = table
        .columns
        .iter()
        .map(|label| shorten_chart_label(label).chars().count())
        .max()
        .unwrap_or(0);
    let top = 20.0 + (longest as f64 * 5.4).min(150.0);
    for (at, name) in table.columns.iter().enumerate() {
        let x = left + (at as f64 + 0.5) * cell;
        let _ = write!(
            svg.body,
            "<text transform=\"translate({x:.1} {:.1}) rotate(-45)\" class=\"small\">{}</text>",
            top - 6.0,
            escape_markup(&shorten_chart_label(name))
        );
    }
    for (row, (name, counts)) in table.rows.iter().zip(&table.counts).enumerate() {
        let y = top + row as f64 * 28.0;
        svg.add_svg_text([left - 8.0, y + 19.0], "small end", &shorten_chart_label(name));
        let all: usize = counts.iter().sum();
        for (column, count) in counts.iter().enumerate() {
            let (fill, letters) = shade_at_share(&CONFUSION_TABLE_SHADES, *count as f64 / all.max(1) as f64);
            let x = left + column as f64 * cell;
            let style = format!("fill=\"{fill}\" class=\"edge\"");
            svg.rect([x, y], [cell, 28.0], &style);
            // Empty cells stay empty, so that the others stand out.
            if *count > 0 {
                let class = if letters == "#fff" {
                    "small mid light"
                } else {
                    "small mid"
                };
                svg.add_svg_text([x + cell / 2.0, y + 19.0], class, &count.to_string());
            }
        }
        let end = left + counts.len() as f64 * cell;
        svg.add_svg_text([end + 8.0, y + 19.0], "small", &format!("n = {all}"));
    }
    // Frames come last, so that no neighbour covers them.
    for (row, name) in table.rows.iter().enumerate() {
        if let Some(column) = table.columns.iter().position(|title| title == name) {
            let corner = [left + column as f64 * cell, top + row as f64 * 28.0];
            svg.rect(corner, [cell, 28.0], "class=\"right\"");
        }
    }
    svg.height = top + table.rows.len() as f64 * 28.0 + 6.0;
    svg.finish_svg(w::CONFUSION.text_in_language(language))
}

/// Draws effects with their intervals, and the range of differences that are too small to matter.
pub(super) fn effect_interval_chart(
    rows: &[(String, f64, Option<ResampledInterval>)],
    bound: f64,
    language: InterfaceLanguage,
) -> String {
    let mut svg = SvgChart::new();
    let left = label_margin(rows.iter().map(|row| row.0.as_str()));
    let right = 190.0;
    let reach = rows.iter().fold(bound, |most, (_, delta, ends)| {
        let ends = ends.map_or(0.0, |interval| interval.low.abs().max(interval.high.abs()));
        most.max(delta.abs()).max(ends)
    });
    // No effect of this kind is greater than 1.
    let reach = (reach * 1.1).min(1.0);
    let middle = left + (CHART_WIDTH_PX - left - right) / 2.0;
    let unit = (CHART_WIDTH_PX - left - right) / 2.0 / reach;
    let bottom = 8.0 + rows.len() as f64 * 30.0;
    svg.rect(
        [middle - bound * unit, 2.0],
        [2.0 * bound * unit, bottom - 2.0],
        "class=\"band\"",
    );
    let step = if reach > 0.6 { 0.25 } else { 0.1 };
    for at in -10..=10_i32 {
        let value = f64::from(at) * step;
        if value.abs() <= reach + 1e-9 {
            let x = middle + value * unit;
            svg.add_svg_line([x, 2.0], [x, bottom], if at == 0 { "axis" } else { "grid" });
            let decimals = if step < 0.2 { 1 } else { 2 };
            svg.add_svg_text(
                [x, bottom + 16.0],
                "small mid",
                &format_report_number(value, decimals, language),
            );
        }
    }
    for (at, (label, delta, ends)) in rows.iter().enumerate() {
        let y = 22.0 + at as f64 * 30.0;
        svg.add_svg_text([left - 10.0, y + 5.0], "end", &shorten_chart_label(label));
        let mut words = format_report_number(*delta, 3, language);
        if let Some(ends) = ends {
            svg.add_svg_line([middle + ends.low * unit, y], [middle + ends.high * unit, y], "thick");
            let [low, high] = [ends.low, ends.high].map(|end| format_report_number(end, 3, language));
            let _ = write!(words, "  [{low}; {high}]");
        }
        svg.add_svg_dot([middle + delta * unit, y], 5.0, "estimate");
        svg.add_svg_text([CHART_WIDTH_PX - right + 12.0, y + 5.0], "small", &words);
    }
    svg.height = bottom + 24.0;
    svg.finish_svg(w::EFFECTS.text_in_language(language))
}

/// Returns round numbers inside a range, about five of them, and their decimals.
fn axis_ticks([low, high]: [f64; 2]) -> (Vec<f64>, usize) {
    let rough = (high - low) / 5.0;
    let power = rough.log10().floor();
    let unit = 10_f64.powf(power);
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * unit);
    let step = steps.into_iter().find(|candidate| *candidate >= rough).unwrap_or(unit);
    let first = (low / step).ceil();
    let ticks = (0..12).map(|at| (first + f64::from(at)) * step);
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    (ticks.take_while(|tick| *tick <= high).collect(), decimals)
}

/// Draws the mean answers of trials over a measure.
pub(super) fn correlation_chart(points: &[MeasurePoint], names: [&str; 2], language: InterfaceLanguage) -> String {
    let mut svg = SvgChart::new();
    let range = |of: fn(&MeasurePoint) -> f64| {
        let values = points.iter().map(of);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        // Equal values would give a range without extent.
        let room = ((high - low) * 0.06).max(1e-6 * high.abs().max(1.0));
        [low - room, high + room]
    };
    let (x_range, y_range) = (range(|point| point.measure), range(|point| point.mean));
    let (left, right, top, bottom) = (60.0, CHART_WIDTH_PX - 20.0, 28.0, 330.0);
    let part = |value: f64, range: [f64; 2]| (value - range[0]) / (range[1] - range[0]);
    let across = |value: f64| left + part(value, x_range) * (right - left);
    let up = |value: f64| bottom - part(value, y_range) * (bottom - top);
    let (own, decimals) = axis_ticks(x_range);
    for x in own {
        svg.add_svg_line([across(x), top], [across(x), bottom], "grid");
        let words = format_report_number(x, decimals, language);
        svg.add_svg_text([across(x), bottom + 17.0], "small mid", &words);
    }
    let (own, decimals) = axis_ticks(y_range);
    for y in own {
        svg.add_svg_line([left, up(y)], [right, up(y)], "grid");
        svg.add_svg_text(
            [left - 8.0, up(y) + 4.0],
            "small end",
            &format_report_number(y, decimals, language),
        );
    }
    svg.add_svg_line([left, top], [left, bottom], "axis");
    svg.add_svg_line([left, bottom], [right, bottom], "axis");
    let mut taken: Vec<[f64; 3]> = Vec::new();
    for point in points {
        let [x, y] = [across(point.measure), up(point.mean)];
        svg.add_svg_dot([x, y], 4.5, "estimate");
        let label = shorten_chart_label(&point.label);
        let width = label.chars().count() as f64 * 6.8 + 8.0;
        // A label stands beside its point if no other one is there; the table of numbers is in the files.
        let begins = [x + 8.0, x - 8.0 - width];
        let free = |begin: &f64| {
            let end = begin + width;
            let is_beside = |area: &[f64; 3]| (area[2] - y).abs() < 14.0 && *begin < area[1] && area[0] < end;
            let covers = |point: &MeasurePoint| {
                let [x, own] = [across(point.measure), up(point.mean)];
                (own - y).abs() < 8.0 && *begin < x + 4.0 && x - 4.0 < end
            };
            let inside = *begin > left && end < CHART_WIDTH_PX;
            inside && !taken.iter().any(is_beside) && !points.iter().any(covers)
        };
        if let Some(begin) = begins.into_iter().find(free) {
            let label_place = if begin > x {
                [begin, y + 4.0]
            } else {
                [x - 8.0, y + 4.0]
            };
            svg.add_svg_text(label_place, if begin > x { "small" } else { "small end" }, &label);
            taken.push([begin, begin + width, y]);
        }
    }
    svg.add_svg_text([(left + right) / 2.0, bottom + 38.0], "small mid", names[0]);
    svg.add_svg_text([4.0, 14.0], "small", names[1]);
    svg.height = bottom + 46.0;
    svg.finish_svg(w::CORRELATION.text_in_language(language))
}
