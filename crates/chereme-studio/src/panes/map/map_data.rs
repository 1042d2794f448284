//! The view of the map, its labels and its selections, without widgets.

use std::collections::BTreeSet;

use chereme_corpus::{SignMap, facet_condition};
use eframe::egui::{Pos2, Rect, Vec2, pos2};

/// The part of the map in sight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MapView {
    /// The map position at the centre of the view.
    centre: Pos2,
    /// Magnification: at 1 the whole map is in sight.
    zoom: f32,
}

impl Default for MapView {
    fn default() -> Self {
        Self {
            centre: pos2(0.5, 0.5),
            zoom: 1.0,
        }
    }
}

/// The margin around the whole map, as a share of its side.
const MAP_MARGIN_SHARE: f32 = 0.06;
/// The share of the remaining distance of a flight that is left after a second.
const FLIGHT_REMAINDER_SHARE: f32 = 1e-4;
/// The greatest magnification.
const MAX_MAP_MAGNIFICATION: f32 = 400.0;

impl MapView {
    fn map_scale(&self, rect: Rect) -> f32 {
        rect.size().min_elem() * (1.0 - 2.0 * MAP_MARGIN_SHARE) * self.zoom
    }

    /// Returns the point in the window for a position on the map.
    pub(super) fn window_point_of(&self, rect: Rect, place: Pos2) -> Pos2 {
        rect.center() + (place - self.centre) * self.map_scale(rect)
    }

    /// Returns the position on the map for a point in the window.
    pub(super) fn map_position_of(&self, rect: Rect, point: Pos2) -> Pos2 {
        self.centre + (point - rect.center()) / self.map_scale(rect)
    }

    /// Returns a view with `place` in the centre and at most `most` of `places` in sight, magnified at least as much as
    /// the present one.
    pub(super) fn view_near_place(
        &self,
        rect: Rect,
        place: Pos2,
        places: impl Iterator<Item = Pos2>,
        most: usize,
    ) -> Self {
        let unit = Self {
            centre: place,
            zoom: 1.0,
        }
        .map_scale(rect);
        // The magnification at which a position leaves the window.
        let leaves = |at: Pos2| {
            let away = (at - place).abs() * unit;
            let half = rect.size() / 2.0;
            (half.x / away.x.max(1e-6)).min(half.y / away.y.max(1e-6))
        };
        let mut zooms: Vec<f32> = places.map(leaves).collect();
        zooms.sort_by(|a, b| b.total_cmp(a));
        let zoom = zooms.get(most).copied().unwrap_or(0.0);
        Self {
            centre: place,
            zoom: zoom.max(self.zoom).clamp(0.5, MAX_MAP_MAGNIFICATION),
        }
    }

    /// Moves towards another view for `seconds`; returns whether it has arrived.
    pub(super) fn move_towards_view(&mut self, to: Self, seconds: f32) -> bool {
        let share = 1.0 - FLIGHT_REMAINDER_SHARE.powf(seconds);
        self.centre += (to.centre - self.centre) * share;
        self.zoom *= (to.zoom / self.zoom).powf(share);
        let off = (to.centre - self.centre).length() * self.zoom;
        let near = off < 1e-3 && (to.zoom / self.zoom).ln().abs() < 1e-2;
        if near {
            *self = to;
        }
        near
    }

    /// Moves the map by `by` points; its centre stays on the map.
    pub(super) fn move_map_by(&mut self, rect: Rect, by: Vec2) {
        self.centre = (self.centre - by / self.map_scale(rect)).clamp(Pos2::ZERO, pos2(1.0, 1.0));
    }

    /// Magnifies by a factor, keeping the position under the pointer.
    pub(super) fn zoom_map_at(&mut self, rect: Rect, pointer: Pos2, factor: f32) {
        let pointed_place = self.map_position_of(rect, pointer);
        self.zoom = (self.zoom * factor).clamp(0.5, MAX_MAP_MAGNIFICATION);
        let away = pointed_place - self.map_position_of(rect, pointer);
        self.centre = (self.centre + away).clamp(Pos2::ZERO, pos2(1.0, 1.0));
    }
}

/// The area that labels occupy, as squares of a grid.
#[derive(Debug, Default)]
pub(super) struct OccupiedLabels(BTreeSet<(i32, i32)>);

/// The side of a grid square, in points.
pub(super) const LABEL_SQUARE_SIDE: f32 = 8.0;

impl OccupiedLabels {
    /// Occupies a rectangle if it is free; returns whether it was.
    pub(super) fn take_label_room(&mut self, room: Rect) -> bool {
        let square = |at: Pos2| {
            (
                (at.x / LABEL_SQUARE_SIDE).floor() as i32,
                (at.y / LABEL_SQUARE_SIDE).floor() as i32,
            )
        };
        let ((left, top), (right, bottom)) = (square(room.min), square(room.max));
        let square_iterator = (left..=right).flat_map(|x| (top..=bottom).map(move |y| (x, y)));
        let squares: Vec<(i32, i32)> = square_iterator.collect();
        let free = squares.iter().all(|square| !self.0.contains(square));
        if free {
            self.0.extend(squares);
        }
        free
    }
}

/// Returns whether a point lies inside a closed line.
pub(super) fn is_inside_outline(line: &[Pos2], point: Pos2) -> bool {
    let mut inside = false;
    for (at, a) in line.iter().enumerate() {
        let b = line[(at + 1) % line.len()];
        if (a.y > point.y) != (b.y > point.y) {
            let x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
            inside ^= point.x < x;
        }
    }
    inside
}

/// Returns the indices of the signs that are most similar to one.
pub(super) fn most_similar_signs(map: &SignMap, at: usize) -> Vec<usize> {
    let index = |token: &i64| map.signs.binary_search_by_key(token, |sign| sign.token).ok();
    map.signs
        .get(at)
        .map_or(Vec::new(), |sign| sign.near.iter().filter_map(index).collect())
}

/// Returns the query for signs with these glosses; `None` if there is no gloss.
pub(super) fn glosses_query<'a>(glosses: impl Iterator<Item = &'a str>) -> Option<String> {
    let glosses: BTreeSet<&str> = glosses.collect();
    let terms: Vec<String> = glosses
        .iter()
        .filter_map(|gloss| facet_condition("gloss", gloss))
        .collect();
    (!terms.is_empty()).then(|| terms.join(" or "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::MapPoint;

    fn rect() -> Rect {
        Rect::from_min_max(pos2(100.0, 50.0), pos2(500.0, 350.0))
    }

    #[test]
    fn the_whole_map_is_visible_at_first_and_zooming_keeps_the_point_under_the_pointer() {
        let mut view = MapView::default();
        for corner in [pos2(0.0, 0.0), pos2(1.0, 0.0), pos2(0.0, 1.0), pos2(1.0, 1.0)] {
            assert!(rect().contains(view.window_point_of(rect(), corner)), "{corner:?}");
        }
        let pointer = pos2(260.0, 180.0);
        let held = view.map_position_of(rect(), pointer);
        view.zoom_map_at(rect(), pointer, 3.0);
        assert!(view.window_point_of(rect(), held).distance(pointer) < 0.01);
        view.move_map_by(rect(), Vec2::new(30.0, -10.0));
        assert!(
            view.window_point_of(rect(), held)
                .distance(pointer + Vec2::new(30.0, -10.0))
                < 0.01
        );
        for _ in 0..100 {
            view.zoom_map_at(rect(), pointer, 3.0);
            view.move_map_by(rect(), Vec2::new(1e6, 1e6));
        }
        assert!(view.centre.x >= 0.0 && view.zoom <= MAX_MAP_MAGNIFICATION);
    }

    #[test]
    fn a_flight_arrives_with_a_sign_in_the_middle_and_few_around_it() {
        let places: Vec<Pos2> = (0..400)
            .map(|n| pos2((n % 20) as f32 / 19.0, (n / 20) as f32 / 19.0))
            .collect();
        let goal = places[210];
        let to = MapView::default().view_near_place(rect(), goal, places.iter().copied(), 20);
        let seen = |view: &MapView| {
            let shown = places.iter().map(|at| view.window_point_of(rect(), *at));
            shown.filter(|at| rect().contains(*at)).count()
        };
        // Positions on a grid come into sight in groups.
        assert!((2..=30).contains(&seen(&to)), "{}", seen(&to));
        let mut view = MapView::default();
        let mut frames = 1;
        while !view.move_towards_view(to, 1.0 / 60.0) {
            frames += 1;
            assert!(frames < 120);
        }
        assert!(frames > 10, "it flies");
        assert!(view.window_point_of(rect(), goal).distance(rect().center()) < 0.1);
    }

    #[test]
    fn a_lasso_selects_the_signs_inside_it() {
        let line = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (5.0, 4.0), (0.0, 10.0)];
        let line = line.map(|(x, y)| pos2(x, y));
        assert!(is_inside_outline(&line, pos2(2.0, 3.0)));
        assert!(!is_inside_outline(&line, pos2(5.0, 8.0)), "the notch is outside");
        assert!(!is_inside_outline(&line, pos2(-1.0, 3.0)));
        assert!(!is_inside_outline(&[], pos2(0.0, 0.0)));
    }

    #[test]
    fn labels_never_cover_each_other() {
        let mut labels = OccupiedLabels::default();
        let at = |x: f32| Rect::from_min_size(pos2(x, 10.0), Vec2::new(40.0, 12.0));
        assert!(labels.take_label_room(at(0.0)));
        assert!(!labels.take_label_room(at(30.0)));
        assert!(labels.take_label_room(at(60.0)));
    }

    #[test]
    fn a_selection_is_a_query_and_neighbours_are_found_by_token() {
        assert_eq!(
            glosses_query(["A", "B C", "A"].into_iter()),
            Some("gloss==A or gloss==\"B C\"".into())
        );
        assert_eq!(glosses_query(std::iter::empty()), None);
        let point = |token: i64, near: &[i64]| MapPoint {
            token,
            gloss: String::new(),
            origin: chereme_corpus::RecordOrigin::default(),
            x: 0.0,
            y: 0.0,
            near: near.to_vec(),
        };
        let map = SignMap {
            components: vec![],
            signs: vec![point(3, &[9, 5]), point(5, &[3]), point(9, &[])],
            left_out: 0,
        };
        assert_eq!(most_similar_signs(&map, 0), [2, 1]);
        assert_eq!(most_similar_signs(&map, 7), Vec::<usize>::new());
    }
}
