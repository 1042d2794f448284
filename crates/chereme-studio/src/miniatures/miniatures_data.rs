//! Rules for little figures, without widgets: the moments to draw, their order, and the pictures to keep.

use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{Rect, Vec2, vec2};

/// Pictures per second, if that does not make too many.
const LOOP_PICTURE_RATE_HZ: f64 = 25.0;
/// The most pictures at that rate; longer movement gets fewer per second.
const FULL_RATE_PICTURES: usize = 64;
/// The most pictures of a loop, and the fewest per second.
const MAX_LOOP_PICTURES: usize = 96;
const LEAST_RATE: f64 = 10.0;

/// Returns the part of `span` that a loop shows: its beginning, if it is long.
pub(crate) fn loop_shown_span(span: TimeSpan) -> TimeSpan {
    let most = (MAX_LOOP_PICTURES as f64 / LEAST_RATE * 1e6) as i64;
    let end = span.span_start_instant().shifted_instant(span.span_micros().min(most));
    TimeSpan::span_between(span.span_start_instant(), end)
}

/// Returns how many pictures a loop over `seconds` has; at least one.
pub(crate) fn loop_picture_count(seconds: f64) -> usize {
    let usual = (seconds * LOOP_PICTURE_RATE_HZ).round() as usize;
    let fewest = (seconds * LEAST_RATE).ceil() as usize;
    usual.clamp(1, FULL_RATE_PICTURES.max(fewest.min(MAX_LOOP_PICTURES)))
}

/// Returns the moment in `span` that picture `index` of `count` shows: the middle of its part of the span.
pub(crate) fn loop_picture_moment(span: TimeSpan, index: usize, count: usize) -> RecordingInstant {
    // The middle of each picture's share of time, so that none stands at an end.
    let share = (index as f64 + 0.5) / count as f64;
    span.span_start_instant()
        .shifted_instant((span.span_micros() as f64 * share) as i64)
}

/// Returns the index of the picture at `clock` seconds in a loop of `count` pictures over `seconds`.
pub(crate) fn index(clock: f64, seconds: f64, count: usize) -> usize {
    let share = (clock / seconds.max(1e-6)).rem_euclid(1.0);
    ((share * count as f64) as usize).min(count - 1)
}

/// Returns the order in which pictures of a loop are drawn: first the middle one, which represents the sign, then ever
/// finer steps, so that a loop moves long before it is complete.
pub(crate) fn picture_drawing_order(count: usize) -> Vec<usize> {
    let mut order = vec![count / 2];
    let mut taken = vec![false; count];
    taken[count / 2] = true;
    let mut step = count.next_power_of_two();
    while step >= 1 {
        for index in (0..count).step_by(step) {
            if !std::mem::replace(&mut taken[index], true) {
                order.push(index);
            }
        }
        step /= 2;
    }
    order
}

/// Returns the picture to show in place of `wanted`: itself if it is drawn, else the last drawn one before it in the
/// loop.
pub(crate) fn nearest_drawn_picture(drawn: impl Fn(usize) -> bool, wanted: usize, count: usize) -> Option<usize> {
    (0..count)
        .map(|back| (wanted + count - back) % count)
        .find(|&index| drawn(index))
}

/// The largest side of a picture in pixels; larger cells show it scaled.
const MAX_MINIATURE_SIDE_PIXELS: f32 = 288.0;
/// Sizes are rounded to this, so that a cell that grows a little needs no new pictures.
const PICTURE_SIZE_STEP: f32 = 8.0;

/// Returns columns and rows of a picture for a cell of that size in pixels: at least as large as the cell, unless that
/// is larger than any picture.
pub(crate) fn picture_pixel_size(cell: [f32; 2]) -> [u16; 2] {
    let shrink = (MAX_MINIATURE_SIDE_PIXELS / cell[0].max(cell[1]).max(1.0)).min(1.0);
    cell.map(|side| ((side * shrink / PICTURE_SIZE_STEP).ceil().max(2.0) * PICTURE_SIZE_STEP) as u16)
}

/// Returns the part of a picture, in shares of its sides, that covers a cell of whole pixels one to one: the middle of
/// it. `None` if the cell is larger than the picture, so that the picture must be scaled.
pub(crate) fn one_to_one(picture: [usize; 2], cell: [f32; 2]) -> Option<Rect> {
    let mut corners = [[0.0; 2]; 2];
    for axis in 0..2 {
        let (whole, part) = (picture[axis] as f32, cell[axis].round());
        if part > whole || whole < 1.0 {
            return None;
        }
        // The cut begins at a whole pixel, or the picture would be blurred.
        let start = ((whole - part) * 0.5).floor();
        corners[0][axis] = start / whole;
        corners[1][axis] = (start + part) / whole;
    }
    Some(Rect::from_min_max(corners[0].into(), corners[1].into()))
}

/// Returns the middle part of a picture, in shares of its sides, that fills a cell without being stretched.
pub(crate) fn middle_picture_part(picture: [usize; 2], cell: [f32; 2]) -> Rect {
    let [wide, high] = picture.map(|side| side.max(1) as f32);
    let scale = (cell[0] / wide).max(cell[1] / high).max(f32::MIN_POSITIVE);
    let part = vec2(cell[0] / (wide * scale), cell[1] / (high * scale));
    Rect::from_center_size((Vec2::splat(0.5)).to_pos2(), part)
}

/// Returns the keys of `kept` to remove so that at most `limit` bytes stay: those wanted longest ago first, none that
/// was wanted at `now` or later. Each entry has a key, its bytes, and the frame when it was last wanted.
pub(crate) fn keys_to_evict<K: Clone + Ord>(
    kept: impl Iterator<Item = (K, usize, u64)>,
    now: u64,
    limit: usize,
) -> Vec<K> {
    let mut all: Vec<(u64, K, usize)> = kept.map(|(key, bytes, when)| (when, key, bytes)).collect();
    // By the frame of the last request first, then by key, so that the order is certain.
    all.sort_unstable();
    let mut total: usize = all.iter().map(|(_, _, bytes)| bytes).sum();
    let mut leaving = Vec::new();
    for (when, key, bytes) in all {
        // Visible pieces stay even beyond the limit.
        if total <= limit || when >= now {
            break;
        }
        total -= bytes;
        leaving.push(key);
    }
    leaving
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: i64, end: i64) -> TimeSpan {
        TimeSpan::from_span_micros(start, end)
    }

    #[test]
    fn loops_have_25_pictures_a_second_and_never_too_many() {
        for (seconds, wanted) in [
            (0.0, 1),
            (0.001, 1),
            (1.0, 25),
            (2.0, 50),
            (2.56, 64),
            (5.0, 64),
            (6.4, 64),
            (8.0, 80),
            (9.6, 96),
            (7200.0, 96),
        ] {
            assert_eq!(loop_picture_count(seconds), wanted, "{seconds}");
        }
        assert_eq!(loop_shown_span(span(7, 1_000_007)), span(7, 1_000_007));
        assert_eq!(loop_shown_span(span(7, 7_200_000_007)).span_micros(), 9_600_000);
    }

    #[test]
    fn moments_lie_in_the_span_and_the_clock_wraps_around() {
        let whole = span(1_000_000, 3_000_000);
        assert_eq!(loop_picture_moment(whole, 0, 2).instant_micros(), 1_500_000);
        assert_eq!(loop_picture_moment(whole, 1, 2).instant_micros(), 2_500_000);
        assert_eq!(index(0.0, 2.0, 50), 0);
        assert_eq!(index(1.0, 2.0, 50), 25);
        assert_eq!(index(2.0, 2.0, 50), 0);
        assert_eq!(index(-0.01, 2.0, 50), 49);
        assert_eq!(index(3.0, 0.0, 1), 0);
    }

    #[test]
    fn every_picture_is_drawn_once_the_middle_first_then_spread_out() {
        for count in [1, 2, 3, 25, 64, 96] {
            let order = picture_drawing_order(count);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, (0..count).collect::<Vec<_>>());
            assert_eq!(order[0], count / 2);
        }
        assert_eq!(picture_drawing_order(8), [4, 0, 2, 6, 1, 3, 5, 7]);
    }

    #[test]
    fn the_latest_picture_drawn_before_the_moment_is_shown() {
        let drawn = |index: usize| [2, 6].contains(&index);
        let at = |wanted| nearest_drawn_picture(drawn, wanted, 8);
        assert_eq!([at(2), at(5), at(7), at(1)], [2, 2, 6, 6].map(Some));
        assert_eq!(nearest_drawn_picture(|_| false, 3, 8), None);
    }

    #[test]
    fn sizes_are_rounded_and_bounded() {
        assert_eq!(picture_pixel_size([150.0, 144.0]), [152, 144]);
        assert_eq!(picture_pixel_size([3.0, 0.0]), [16, 16]);
        assert_eq!(picture_pixel_size([2880.0, 1440.0]), [288, 144]);
    }

    #[test]
    fn a_picture_covers_a_smaller_cell_pixel_by_pixel() {
        for cell in [[145.0, 149.0], [152.0, 152.0], [144.0, 150.0]] {
            let part = one_to_one([152, 152], cell).expect("large enough");
            for (share, pixels) in [part.width(), part.height()].into_iter().zip(cell) {
                assert!((share * 152.0 - pixels).abs() < 1e-3, "{cell:?}");
            }
            let first = part.min.x * 152.0;
            assert!((first - first.round()).abs() < 1e-3, "{cell:?}");
        }
        assert_eq!(one_to_one([152, 152], [153.0, 100.0]), None);
    }

    #[test]
    fn a_film_is_cropped_to_the_shape_of_its_cell() {
        let wide = middle_picture_part([200, 100], [50.0, 50.0]);
        assert!((wide.width() - 0.5).abs() < 1e-6 && (wide.height() - 1.0).abs() < 1e-6);
        let tall = middle_picture_part([100, 400], [200.0, 200.0]);
        assert!((tall.width() - 1.0).abs() < 1e-6 && (tall.height() - 0.25).abs() < 1e-6);
        assert!((wide.center().x - 0.5).abs() < 1e-6 && (tall.min.y - 0.375).abs() < 1e-6);
    }

    #[test]
    fn the_least_recently_wanted_pictures_are_dropped_but_no_visible_ones() {
        let kept = [('a', 10, 5), ('b', 10, 1), ('c', 10, 9), ('d', 10, 3)];
        let leaving = |limit| super::keys_to_evict(kept.into_iter(), 9, limit);
        assert!(leaving(40).is_empty());
        assert_eq!(leaving(25), ['b', 'd']);
        assert_eq!(leaving(0), ['b', 'd', 'a']);
    }
}
