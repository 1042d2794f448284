//! A chart of the alignment of two clips.

use crate::error::{FigureError, checked_size};
use crate::font;
use crate::image::RasterImage;
use crate::palette::{PaperTheme, RgbColour};

/// Options of the chart of an alignment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChartOptions {
    /// The names of the horizontal and the vertical axis.
    pub names: [String; 2],
    /// The largest side of the grid's square, in pixels.
    pub size: usize,
    /// The paper.
    pub theme: PaperTheme,
}

impl Default for ChartOptions {
    fn default() -> Self {
        Self {
            names: ["A".into(), "B".into()],
            size: 280,
            theme: PaperTheme::Light,
        }
    }
}

/// Space around the grid for names and numbers, in pixels.
const CHART_MARGIN_PIXELS: usize = 34;
/// The colour of the path on a light and on a dark background.
const CHART_PATH_COLOURS: [RgbColour; 2] = [
    RgbColour::from_hex_colour(0x00_5F_9E),
    RgbColour::from_hex_colour(0x6F_C3_FF),
];

/// Draws the alignment of two clips of `lengths` frames: the first runs to the right, the second up, and
/// `path` goes through the corresponding pairs of frames; a thin diagonal shows the path of an even
/// alignment.
///
/// # Errors
/// [`FigureError`] if the path is empty, a pair lies outside, or the chart would be too large.
pub fn alignment_picture(
    path: &[(usize, usize)],
    lengths: [usize; 2],
    options: &ChartOptions,
) -> Result<RasterImage, FigureError> {
    if path.is_empty() {
        return Err(FigureError::Nothing { what: "pair of frames" });
    }
    for &(a, b) in path {
        for (frame, length) in [a, b].into_iter().zip(lengths) {
            if frame >= length {
                let last = length.saturating_sub(1);
                return Err(FigureError::Frame { frame, last });
            }
        }
    }
    let side = options
        .size
        .saturating_add(CHART_MARGIN_PIXELS + font::CELL_WIDTH_DOTS * 2);
    let [width, height] = checked_size(side, side)?;
    let theme = options.theme;
    let mut chart = RasterImage::new(width, height, theme.theme_paper_colour());
    let inner = options.size as i64;
    let (left, top) = (CHART_MARGIN_PIXELS as i64, font::CELL_WIDTH_DOTS as i64);
    // Both axes have one scale, so that an even alignment of equal clips is a true diagonal.
    let longest = lengths[0].max(lengths[1]).max(2) as i64 - 1;
    let extent = lengths.map(|length| (length as i64 - 1) * (inner - 1) / longest);
    let place = |a: i64, b: i64| {
        let x = left + (2 * a * (inner - 1) + longest) / (2 * longest);
        let y = top + inner - 1 - (2 * b * (inner - 1) + longest) / (2 * longest);
        [x, y]
    };
    draw_chart_grid(&mut chart, place, lengths, theme);
    chart.draw_image_line(
        place(0, 0),
        [left + extent[0], top + inner - 1 - extent[1]],
        theme.rule_colour(),
    );
    let colour = CHART_PATH_COLOURS[usize::from(theme == PaperTheme::Dark)];
    let points: Vec<[i64; 2]> = path.iter().map(|&(a, b)| place(a as i64, b as i64)).collect();
    for pair in points.windows(2) {
        // The path is two pixels wide.
        for [dx, dy] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let moved = |at: [i64; 2]| [at[0] + dx, at[1] - dy];
            chart.draw_image_line(moved(pair[0]), moved(pair[1]), colour);
        }
    }
    for &at in [points[0], points[points.len() - 1]].iter() {
        chart.fill_image_rectangle([at[0] - 1, at[1] - 2], [4, 4], colour);
    }
    draw_chart_labels(&mut chart, options, lengths, top + inner);
    Ok(chart)
}

/// Draws rules at round numbers of frames, at most ten in each direction.
fn draw_chart_grid(
    chart: &mut RasterImage,
    place: impl Fn(i64, i64) -> [i64; 2],
    lengths: [usize; 2],
    theme: PaperTheme,
) {
    let [wide, tall] = lengths.map(|length| length as i64 - 1);
    let step = round_step(wide.max(tall));
    for at in (0..=wide / step).map(|i| i * step).chain([wide]) {
        chart.draw_image_line(place(at, 0), place(at, tall), theme.rule_colour());
    }
    for at in (0..=tall / step).map(|i| i * step).chain([tall]) {
        chart.draw_image_line(place(0, at), place(wide, at), theme.rule_colour());
    }
}

/// Returns the least of 1, 2, 5, 10, 20... that cuts `length` into ten at most.
fn round_step(length: i64) -> i64 {
    let mut power = 1;
    loop {
        for factor in [1, 2, 5] {
            if length / (factor * power) <= 10 {
                return factor * power;
            }
        }
        power *= 10;
    }
}

fn draw_chart_labels(chart: &mut RasterImage, options: &ChartOptions, lengths: [usize; 2], below: i64) {
    let text = options.theme.theme_text_colour();
    let across_label = format!("{} ({})", options.names[0], lengths[0]);
    let across = font::fit_text_width(&across_label, options.size);
    chart.draw_image_text(&across, [CHART_MARGIN_PIXELS as i64, below + 4], 1, text);
    // Letters below one another, as many as fit.
    let up = format!("{} ({})", options.names[1], lengths[1]);
    let room = options.size / font::CELL_HEIGHT_DOTS;
    for (row, letter) in up.chars().take(room).enumerate() {
        let label_place = [
            (CHART_MARGIN_PIXELS / 2) as i64,
            (font::CELL_WIDTH_DOTS + row * font::CELL_HEIGHT_DOTS) as i64,
        ];
        chart.draw_image_text(&letter.to_string(), label_place, 1, text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_runs_from_the_lower_left_to_the_upper_right() {
        let path: Vec<(usize, usize)> = (0..40).map(|i| (i, i / 2)).collect();
        let options = ChartOptions::default();
        let chart = alignment_picture(&path, [40, 20], &options).expect("a chart");
        assert_eq!(
            chart.image_pixel_at(CHART_MARGIN_PIXELS, font::CELL_WIDTH_DOTS + 279),
            CHART_PATH_COLOURS[0]
        );
        assert_eq!(
            chart.image_pixel_at(CHART_MARGIN_PIXELS + 279, font::CELL_WIDTH_DOTS + 279 - 19 * 279 / 39),
            CHART_PATH_COLOURS[0]
        );
    }

    #[test]
    fn an_invalid_path_is_refused() {
        let options = ChartOptions::default();
        let error = |path: &[(usize, usize)]| {
            alignment_picture(path, [4, 3], &options)
                .expect_err("refused")
                .to_string()
        };
        assert!(error(&[]).contains("nothing to draw"));
        assert!(error(&[(0, 0), (3, 3)]).contains("no frame 3; the clip's frames are 0 to 2"));
        let one = alignment_picture(&[(0, 0)], [1, 1], &options);
        assert!(one.is_ok());
    }

    #[test]
    fn axis_steps_are_round_numbers() {
        for (length, step) in [(0, 1), (10, 1), (21, 2), (22, 5), (59, 10), (5000, 500)] {
            assert_eq!(round_step(length), step, "{length}");
        }
    }
}
