//! The camera: position, direction and visible area.

use glam::Vec3;

/// An eye that looks at a point; the picture's middle is that point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FigureCamera {
    /// Position of the eye in model space, in metres.
    pub eye: Vec3,
    /// The point it looks at in model space, in metres.
    pub target: Vec3,
    /// The upward direction of the picture; must not be along the line of sight.
    pub up: Vec3,
    /// Half the height of the visible area at the target's distance, in metres.
    pub half_height: f32,
    /// Distance from the eye at which drawing begins, in metres; nearer surfaces are left out.
    pub near: f32,
}

/// A position in the picture and its distance from the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedPoint {
    /// Columns from the left edge, in pixels.
    pub x: f32,
    /// Rows from the upper edge, in pixels.
    pub y: f32,
    /// Distance along the line of sight, in metres; zero or negative behind the eye.
    pub depth: f32,
}

/// A camera prepared for a picture of some size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraProjection {
    eye: Vec3,
    /// The picture's right, its up, and from the eye towards the target.
    axes: [Vec3; 3],
    /// Pixels per metre at a distance of one metre.
    scale: f32,
    centre: [f32; 2],
}

impl FigureCamera {
    /// Returns the projection onto a picture of `width` by `height` pixels.
    #[must_use]
    pub fn camera_projection(&self, width: usize, height: usize) -> CameraProjection {
        let sight = self.target - self.eye;
        // An eye at its target looks away from the viewer.
        let forward = sight.normalize_or(Vec3::NEG_Z);
        let right = forward.cross(self.up).normalize_or(Vec3::X);
        let up = right.cross(forward);
        let centre = [width as f32 / 2.0, height as f32 / 2.0];
        CameraProjection {
            eye: self.eye,
            axes: [right, up, forward],
            scale: centre[1] * sight.length() / self.half_height,
            centre,
        }
    }
}

impl CameraProjection {
    /// Returns the position of `point` in the picture.
    #[must_use]
    pub fn project_point(&self, point: Vec3) -> ProjectedPoint {
        let [right, up, forward] = self.axes;
        let from_eye = point - self.eye;
        let depth = forward.dot(from_eye);
        // Behind the eye the sign is wrong; callers test the depth.
        let scale = self.scale / depth;
        ProjectedPoint {
            x: self.centre[0] + right.dot(from_eye) * scale,
            y: self.centre[1] - up.dot(from_eye) * scale,
            depth,
        }
    }

    /// Returns the origin and the direction of the line of sight through a position of the picture; the
    /// direction is not normalised.
    #[must_use]
    pub fn sight_ray(&self, x: f32, y: f32) -> (Vec3, Vec3) {
        let [right, up, forward] = self.axes;
        let across = right * (x - self.centre[0]) - up * (y - self.centre[1]);
        (self.eye, forward + across / self.scale)
    }

    /// Returns the direction of view, of length 1.
    #[must_use]
    pub fn sight_direction(&self) -> Vec3 {
        self.axes[2]
    }

    /// Converts `direction` to the picture's right, up and towards the eye.
    #[must_use]
    pub fn to_picture_axes(&self, direction: Vec3) -> Vec3 {
        let [right, up, forward] = self.axes;
        Vec3::new(right.dot(direction), up.dot(direction), -forward.dot(direction))
    }
}
