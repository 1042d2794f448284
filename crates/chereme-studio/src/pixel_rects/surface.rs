//! Divides a rectangle into rectangles of one colour each, in whole pixels.

use eframe::egui::{Color32, Pos2, Rect};

/// The share of a pixel that is too small for a separate rectangle.
const NEGLIGIBLE_PIXEL_SHARE: f32 = 0.15;

/// A rectangle with its size in pixels.
pub(super) struct PixelSurface {
    pub(super) size: [f32; 2],
    /// Radii of the corners: top left, top right, bottom left, bottom right.
    pub(super) radius: [f32; 4],
    /// The width of its edge.
    pub(super) width: f32,
    pub(super) fill: Color32,
    pub(super) edge: Color32,
}

impl PixelSurface {
    /// Returns the rectangles that it consists of, each with its colour.
    pub(super) fn surface_pieces(&self) -> Vec<(Rect, Color32)> {
        let [across, down] = self.size.map(|side| side as i32);
        let rounded = self.radius.iter().fold(0.0_f32, |most, it| most.max(*it));
        let full_rim = rounded.max(self.width + 0.5).ceil() as i32;
        let rim = if self.width == 0.0 && rounded == 0.0 {
            0
        } else {
            full_rim
        };
        let mut open: Vec<(Rect, Color32)> = Vec::new();
        let mut done = Vec::new();
        for [top, bottom] in pixel_stretches(down, rim) {
            let mut runs = ColourRuns::default();
            for [left, right] in pixel_stretches(across, rim) {
                runs.add_colour_run(left, right, self.surface_pixel_colour([left, top]));
            }
            let mut row = Vec::with_capacity(runs.0.len());
            for (left, right, colour) in runs.0 {
                let same =
                    |piece: &(Rect, Color32)| piece.1 == colour && piece.0.x_range() == (left as f32..=right as f32);
                // Equal runs are joined downwards, so that large surfaces are few rectangles.
                let above = open.iter().position(same).map(|at| open.swap_remove(at).0);
                let from = above.map_or(top as f32, |rect| rect.top());
                let corners = [(left as f32, from), (right as f32, bottom as f32)];
                let [min, max] = corners.map(Pos2::from);
                row.push((Rect::from_min_max(min, max), colour));
            }
            done.append(&mut open);
            open = row;
        }
        done.append(&mut open);
        done
    }

    /// Returns the colour of the pixel in that column and row.
    fn surface_pixel_colour(&self, [x, y]: [i32; 2]) -> Color32 {
        let inside = self.inside_outline_distance([x as f32 + 0.5, y as f32 + 0.5]);
        let all = slightly(inside + 0.5);
        let edge = match self.width {
            0.0 => 0.0,
            width => 1.0 - slightly(inside - width + 0.5),
        };
        let [fill, edge_colour] = [self.fill, self.edge].map(|colour| colour.to_array());
        let part = |at: usize| {
            let (fill, own) = (f32::from(fill[at]), f32::from(edge_colour[at]));
            (all * (fill + (own - fill) * edge) + 0.5) as u8
        };
        Color32::from_rgba_premultiplied(part(0), part(1), part(2), part(3))
    }

    /// Returns the distance of a point from the outline, in pixels; positive inside.
    fn inside_outline_distance(&self, at: [f32; 2]) -> f32 {
        let beyond = [0, 1].map(|axis| self.size[axis] - at[axis]);
        let (right, below) = (at[0] > beyond[0], at[1] > beyond[1]);
        let away = [0, 1].map(|axis| at[axis].min(beyond[axis]));
        let radius = self.radius[usize::from(right) + 2 * usize::from(below)];
        if away[0] < radius && away[1] < radius {
            radius - (radius - away[0]).hypot(radius - away[1])
        } else {
            away[0].min(away[1])
        }
    }
}

/// Returns a share of a pixel, rounded to 0 or 1 if it is near.
fn slightly(share: f32) -> f32 {
    match share {
        it if it < NEGLIGIBLE_PIXEL_SHARE => 0.0,
        it if it > 1.0 - NEGLIGIBLE_PIXEL_SHARE => 1.0,
        it => it,
    }
}

/// Returns the pixels of a side as ranges: one by one near its ends, and all those farther than `rim` from the ends as
/// one range.
fn pixel_stretches(side: i32, rim: i32) -> impl Iterator<Item = [i32; 2]> {
    let (from, to) = if side > 2 * rim {
        (rim, side - rim)
    } else {
        (side, side)
    };
    let middle = (from < to).then_some([from, to]);
    let ones = |range: std::ops::Range<i32>| range.map(|at| [at, at + 1]);
    ones(0..from).chain(middle).chain(ones(to..side))
}

/// Ranges of neighbours with the same colour, from and to, without transparent ones.
#[derive(Default)]
pub(super) struct ColourRuns(pub(super) Vec<(i32, i32, Color32)>);

impl ColourRuns {
    pub(super) fn add_colour_run(&mut self, from: i32, to: i32, colour: Color32) {
        match self.0.last_mut() {
            _ if colour == Color32::TRANSPARENT => {}
            Some(last) if last.1 == from && last.2 == colour => last.1 = to,
            _ => self.0.push((from, to, colour)),
        }
    }
}
