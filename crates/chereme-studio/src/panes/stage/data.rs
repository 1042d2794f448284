//! Where the eye of the stage stands, without a window.

use chereme_figure::View;
use chereme_figure::camera::Camera;
use chereme_motion::Instant;
use eframe::egui::{Rect, pos2, vec2};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

use crate::action::Action;

/// The views with the actions that choose them.
pub(crate) const VIEWS: [(View, Action); 8] = {
    use chereme_motion::Side;
    [
        (View::Addressee, Action::ViewFront),
        (View::Signer, Action::ViewSigner),
        (View::Left, Action::ViewLeft),
        (View::Right, Action::ViewRight),
        (View::Top, Action::ViewTop),
        (View::Hand(Side::Right), Action::ViewRightHand),
        (View::Hand(Side::Left), Action::ViewLeftHand),
        (View::Face, Action::ViewFace),
    ]
};

/// A preset view with what the mouse did to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Eye {
    pub(crate) view: View,
    /// Turned around the vertical and up, in radians.
    turn: f32,
    lift: f32,
    /// Shifted by shares of the picture's height to the right and up.
    shift: [f32; 2],
    /// How much nearer, 1 being the preset.
    zoom: f32,
}

impl Default for Eye {
    fn default() -> Self {
        Self::of(View::Addressee)
    }
}

impl Eye {
    /// Returns the preset itself.
    pub(crate) fn of(view: View) -> Self {
        Self {
            view,
            turn: 0.0,
            lift: 0.0,
            shift: [0.0; 2],
            zoom: 1.0,
        }
    }

    /// Turns by a drag over those shares of the picture's height.
    pub(crate) fn orbit(&mut self, [right, down]: [f32; 2]) {
        const HALF: f32 = std::f32::consts::FRAC_PI_2;
        self.turn = (self.turn - right * 3.0).rem_euclid(4.0 * HALF);
        self.lift = (self.lift + down * 3.0).clamp(-HALF * 0.98, HALF * 0.98);
    }

    /// Moves the picture by a drag over those shares of its height.
    pub(crate) fn pan(&mut self, [right, down]: [f32; 2]) {
        self.shift[0] -= right / self.zoom;
        self.shift[1] += down / self.zoom;
    }

    /// Moves nearer by that factor, or farther if it is below 1.
    pub(crate) fn nearer(&mut self, factor: f32) {
        self.zoom = (self.zoom * factor).clamp(0.2, 20.0);
    }

    /// Does the same around a point of the picture, which keeps its place: those shares of the height to the right of
    /// the middle, and below it.
    pub(crate) fn nearer_at(&mut self, factor: f32, [right, down]: [f32; 2]) {
        let before = self.zoom;
        self.nearer(factor);
        let gone = 1.0 / before - 1.0 / self.zoom;
        self.shift[0] += right * gone;
        self.shift[1] -= down * gone;
    }

    /// Returns the camera, where `preset` is the one of the view.
    pub(crate) fn camera(&self, preset: Camera) -> Camera {
        let sight = preset.eye - preset.target;
        let towards = sight.normalize_or(Vec3::Z);
        let side = preset.up.cross(towards).normalize_or(Vec3::X);
        let up = towards.cross(side);
        let turned = Quat::from_axis_angle(up, self.turn) * Quat::from_axis_angle(side, -self.lift);
        let (side, up) = (turned * side, turned * up);
        let half_height = preset.half_height / self.zoom;
        let moved = (side * self.shift[0] + up * self.shift[1]) * 2.0 * preset.half_height;
        let target = preset.target + moved;
        let near = if self.is_preset() { preset.near } else { 0.0 };
        Camera {
            eye: target + turned * sight / self.zoom,
            target,
            up,
            half_height,
            near: near / self.zoom,
        }
    }

    /// Returns whether nothing was done to the preset but to go nearer.
    pub(crate) fn is_preset(&self) -> bool {
        self.turn == 0.0 && self.lift == 0.0
    }
}

/// How the made movement and the original are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Compare {
    /// Side by side.
    #[default]
    Beside,
    /// The original over the other, seen through.
    Over,
    /// Without the original.
    Alone,
}

impl Compare {
    pub(crate) const ALL: [Self; 3] = [Self::Beside, Self::Over, Self::Alone];

    pub(crate) fn next(self) -> Self {
        match self {
            Self::Beside => Self::Over,
            Self::Over => Self::Alone,
            Self::Alone => Self::Beside,
        }
    }
}

/// Who a pane shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Who {
    /// The signer of what is played.
    Signer,
    /// That of what it was made from.
    Original,
    /// Both, one over the other.
    Both,
}

/// A part of the stage: its rectangle, its eye, and its signer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part {
    pub(crate) rect: Rect,
    pub(crate) eye: usize,
    pub(crate) who: Who,
}

/// The share of the lower side of a part that a face in its corner takes.
const INSET: f32 = 0.4;

/// Returns a face in the upper right corner of each part, seen by the eye of that number.
pub(crate) fn insets(parts: &[Part], eye: usize) -> Vec<Part> {
    let corner = |part: &Part| {
        let side = part.rect.size().min_elem() * INSET;
        let rect = Rect::from_min_size(
            pos2(part.rect.right() - side, part.rect.top()),
            vec2(side, side),
        );
        Part { rect, eye, ..*part }
    };
    parts.iter().map(corner).collect()
}

/// The line between panes.
const GAP: f32 = 2.0;

/// Returns the parts of the stage for that many eyes, and with the original where there is one.
pub(crate) fn parts(whole: Rect, eyes: usize, compare: Option<Compare>) -> Vec<Part> {
    let wide = whole.width() >= whole.height();
    let panes = match eyes {
        1 => vec![whole],
        2 => halves(whole, wide),
        _ => halves(whole, false)
            .into_iter()
            .flat_map(|half| halves(half, true))
            .collect(),
    };
    let mut parts = Vec::new();
    for (eye, rect) in panes.into_iter().enumerate() {
        let mut part = |rect, who| parts.push(Part { rect, eye, who });
        match compare {
            Some(Compare::Beside) => {
                let sides = halves(rect, rect.width() >= rect.height() * 0.8);
                part(sides[0], Who::Original);
                part(sides[1], Who::Signer);
            }
            Some(Compare::Over) => part(rect, Who::Both),
            Some(Compare::Alone) | None => part(rect, Who::Signer),
        }
    }
    parts
}

fn halves(whole: Rect, beside: bool) -> Vec<Rect> {
    let middle = whole.center();
    let (mut first, mut second) = (whole, whole);
    if beside {
        first.max.x = middle.x - GAP / 2.0;
        second.min.x = middle.x + GAP / 2.0;
    } else {
        first.max.y = middle.y - GAP / 2.0;
        second.min.y = middle.y + GAP / 2.0;
    }
    vec![first, second]
}

/// Returns the views that panes begin with when the stage is parted into so many.
pub(crate) fn usual_views(count: usize) -> &'static [View] {
    use chereme_motion::Side;
    match count {
        1 => &[View::Addressee],
        2 => &[View::Addressee, View::Right],
        _ => &[
            View::Addressee,
            View::Right,
            View::Hand(Side::Right),
            View::Hand(Side::Left),
        ],
    }
}

/// The extras drawn with the signer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shows {
    /// The reach of trails, in seconds, if they are shown.
    pub(crate) trails: Option<f64>,
    pub(crate) ghosts: bool,
    pub(crate) grid: bool,
    /// Whether markers stand next to the signer.
    pub(crate) points: bool,
}

/// All that the pictures of the stage depend on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Look {
    pub(crate) at: Instant,
    pub(crate) eyes: Vec<Eye>,
    pub(crate) parts: Vec<(usize, Who, [usize; 2])>,
    pub(crate) shows: Shows,
    pub(crate) dark: bool,
    pub(crate) samples: usize,
}

/// Returns how many samples a pixel gets: four where nothing moves, one where it moves and would
/// take long.
pub(crate) fn samples(moving: bool, size: [usize; 2]) -> usize {
    if moving && size[0] * size[1] > 300_000 {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRESET: Camera = Camera {
        eye: Vec3::new(0.0, 1.0, 7.0),
        target: Vec3::new(0.0, 1.0, 0.0),
        up: Vec3::Y,
        half_height: 1.0,
        near: 3.0,
    };

    #[test]
    fn an_untouched_eye_is_the_preset() {
        let camera = Eye::default().camera(PRESET);
        assert!(camera.eye.distance(PRESET.eye) < 1e-5 && camera.up.distance(PRESET.up) < 1e-5);
        assert_eq!((camera.half_height, camera.near), (1.0, 3.0));
    }

    #[test]
    fn what_is_dragged_follows_the_pointer() {
        let point = Vec3::new(0.1, 1.2, 0.0);
        let before = PRESET.projection(400, 400).project(point);
        let mut eye = Eye::default();
        eye.pan([0.1, 0.05]);
        let after = eye.camera(PRESET).projection(400, 400).project(point);
        assert!(
            (after.x - before.x - 40.0).abs() < 0.5,
            "{}",
            after.x - before.x
        );
        assert!((after.y - before.y - 20.0).abs() < 0.5);
        let mut eye = Eye::default();
        eye.orbit([0.05, 0.0]);
        let near = Vec3::new(0.0, 1.0, 0.3);
        let turned = eye.camera(PRESET).projection(400, 400).project(near);
        assert!(turned.x > 200.0, "the near side goes with the pointer");
        eye.orbit([0.0, 0.1]);
        let camera = eye.camera(PRESET);
        assert!(camera.eye.y > PRESET.eye.y, "dragged down, seen from above");
        assert!((camera.eye.distance(camera.target) - 7.0).abs() < 1e-4);
    }

    #[test]
    fn parts_fill_the_stage_and_each_eye_has_its_own() {
        let whole = Rect::from_min_size(
            eframe::egui::pos2(10.0, 20.0),
            eframe::egui::vec2(802.0, 502.0),
        );
        for (eyes, compare, count) in [
            (1, None, 1),
            (1, Some(Compare::Beside), 2),
            (1, Some(Compare::Over), 1),
            (2, None, 2),
            (4, Some(Compare::Alone), 4),
            (4, Some(Compare::Beside), 8),
        ] {
            let parts = parts(whole, eyes, compare);
            assert_eq!(parts.len(), count);
            let area: f32 = parts.iter().map(|it| it.rect.area()).sum();
            assert!(area <= whole.area() && area > whole.area() * 0.97);
            assert_eq!(parts.last().map(|it| it.eye), Some(eyes - 1));
            assert_eq!(usual_views(eyes).len(), eyes);
        }
        assert_eq!(parts(whole, 1, Some(Compare::Beside))[0].who, Who::Original);
    }

    #[test]
    fn nearer_shows_less() {
        let mut eye = Eye::default();
        eye.nearer(2.0);
        assert_eq!(eye.camera(PRESET).half_height, 0.5);
        eye.nearer(1e9);
        assert_eq!(eye.camera(PRESET).half_height, 0.05);
    }

    #[test]
    fn the_wheel_goes_nearer_to_what_the_pointer_is_at() {
        let at = [0.3, -0.2];
        // The point under the pointer, to the right of the target and above it.
        let under = |eye: &Eye| {
            let camera = eye.camera(PRESET);
            let height = 2.0 * camera.half_height;
            let place = [at[0] * height, -at[1] * height];
            [camera.target.x + place[0], camera.target.y + place[1]]
        };
        let mut eye = Eye::default();
        let before = under(&eye);
        for factor in [1.5, 1.5, 0.4, 3.0] {
            eye.nearer_at(factor, at);
            let now = under(&eye);
            // Sums of a few numbers below ten.
            assert!(
                before.iter().zip(now).all(|(a, b)| (a - b).abs() < 1e-5),
                "{before:?} {now:?}"
            );
        }
    }
}
