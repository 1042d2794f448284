//! Where the eye of the stage stands, without a window.

use chereme_figure::View;
use chereme_figure::camera::Camera;
use chereme_motion::Instant;
use glam::{Quat, Vec3};

use crate::action::Action;

/// The views with the actions that choose them.
pub(crate) const VIEWS: [(View, Action); 7] = {
    use chereme_motion::Side;
    [
        (View::Addressee, Action::ViewFront),
        (View::Signer, Action::ViewSigner),
        (View::Left, Action::ViewLeft),
        (View::Right, Action::ViewRight),
        (View::Top, Action::ViewTop),
        (View::Hand(Side::Right), Action::ViewRightHand),
        (View::Hand(Side::Left), Action::ViewLeftHand),
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

    /// Goes nearer by that factor, or farther where it is below 1.
    pub(crate) fn nearer(&mut self, factor: f32) {
        self.zoom = (self.zoom * factor).clamp(0.2, 20.0);
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

/// All that a picture of the stage depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub(crate) at: Instant,
    pub(crate) eye: Eye,
    pub(crate) size: [usize; 2],
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
    fn nearer_shows_less() {
        let mut eye = Eye::default();
        eye.nearer(2.0);
        assert_eq!(eye.camera(PRESET).half_height, 0.5);
        eye.nearer(1e9);
        assert_eq!(eye.camera(PRESET).half_height, 0.05);
    }
}
