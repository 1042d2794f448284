//! The geometry of a placement's handle, without widgets: its place in the picture, and the effect of a drag in space.

use chereme_figure::camera::CameraProjection;
use chereme_motion::{BodyAnatomy, Clip};
use glam::{DMat3, DVec3, Vec3};

/// The length of an axis in the picture if it is perpendicular to the line of sight, in points.
pub(super) const GIZMO_AXIS_LENGTH_POINTS: f32 = 64.0;
/// Axes that are shorter than this in the picture, in points, are left out, as they point towards the eye.
const MIN_GIZMO_AXIS_POINTS: f32 = 12.0;
/// How many frames are examined for the direction that the body faces.
const MAX_EXAMINED_FRAMES: usize = 16;

/// A line of sight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SightRay {
    pub(super) from: DVec3,
    /// Its direction, of length 1.
    pub(super) along: DVec3,
}

impl SightRay {
    /// Returns the line of sight through a point of the picture.
    pub(super) fn ray_through_point(projection: &CameraProjection, [x, y]: [f32; 2]) -> Self {
        let (from, along) = projection.sight_ray(x, y);
        Self {
            from: from.as_dvec3(),
            along: along.as_dvec3().normalize_or(DVec3::NEG_Z),
        }
    }

    /// Returns the point on an axis that is nearest to the ray, in metres from `origin` along the unit vector `axis`;
    /// `None` if both are parallel.
    pub(super) fn along_axis(&self, origin: DVec3, axis: DVec3) -> Option<f64> {
        let between = self.from - origin;
        let slant = axis.dot(self.along);
        let across = 1.0 - slant * slant;
        // Parallel lines have no nearest points.
        (across > 1e-4).then(|| (axis.dot(between) - slant * self.along.dot(between)) / across)
    }

    /// Returns the intersection with the plane through `origin` with the unit normal `normal`; `None` if the ray is
    /// parallel to the plane, or points away from it.
    pub(super) fn on_plane(&self, origin: DVec3, normal: DVec3) -> Option<DVec3> {
        let steep = normal.dot(self.along);
        let far = normal.dot(origin - self.from) / steep;
        // Behind the eye the ray meets the plane only backwards.
        (steep.abs() > 1e-4 && far > 0.0).then(|| self.from + self.along * far)
    }
}

/// A signer's directions, and the length of an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SignerDirections {
    /// Left, up and forward.
    pub(super) axes: DMat3,
    /// The length of the arm, in metres.
    pub(super) arm: f64,
}

impl SignerDirections {
    /// Returns the directions of a movement as placements use them: up is vertical, left and forward are horizontal.
    pub(super) fn directions_from_clip(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        // A sample shows the mean direction of a movement well enough.
        let step = clip.clip_frame_count().div_ceil(MAX_EXAMINED_FRAMES).max(1);
        let facing = (0..clip.clip_frame_count()).step_by(step).filter_map(|frame| {
            let body = anatomy.body_frame(&clip.model_pose(frame))?;
            Some(body.forward)
        });
        let facing: DVec3 = facing.sum();
        // Placements are along the floor, so that leaning does not tilt their axes.
        let forward = DVec3::new(facing.x, 0.0, facing.z).normalize_or(DVec3::Z);
        Some(Self {
            axes: DMat3::from_cols(DVec3::Y.cross(forward), DVec3::Y, forward),
            arm: anatomy.anatomy_measures()?.arm,
        })
    }
}

/// The part of the handle that is dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HandlePart {
    /// The axis of left (0), up (1) or forward (2).
    Axis(usize),
    /// Its middle, which moves perpendicular to the line of sight.
    Middle,
}

/// The state at the beginning of a drag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GizmoDragStart {
    pub(super) part: HandlePart,
    /// The position of the handle, in model space.
    pub(super) origin: DVec3,
    /// The value, in metres to the left, up and forward.
    pub(super) value: [f64; 3],
    /// The line of sight through the pointer.
    pub(super) ray: SightRay,
    /// The direction of view.
    pub(super) sight: DVec3,
}

impl GizmoDragStart {
    /// Returns the value for a pointer on the line of sight `ray`, rounded to millimetres or to `step`.
    pub(super) fn dragged_gizmo_value(&self, ray: SightRay, axes: DMat3, step: Option<f64>) -> Option<[f64; 3]> {
        let offset = match self.part {
            HandlePart::Axis(nth) => {
                let axis = axes.col(nth);
                // The press is seldom exactly on the axis: only the difference of both points counts.
                let from = self.ray.along_axis(self.origin, axis)?;
                let mut offset = [0.0; 3];
                offset[nth] = ray.along_axis(self.origin, axis)? - from;
                offset
            }
            HandlePart::Middle => {
                let from = self.ray.on_plane(self.origin, self.sight)?;
                let offset = ray.on_plane(self.origin, self.sight)? - from;
                (axes.transpose() * offset).to_array()
            }
        };
        let mut value = self.value;
        for (nth, offset) in offset.into_iter().enumerate() {
            // Other coordinates keep their digits; rounding them would move the hand a little.
            let moves = self.part == HandlePart::Middle || self.part == HandlePart::Axis(nth);
            if moves {
                value[nth] = snap_gizmo_length(value[nth] + offset, step);
            }
        }
        Some(value)
    }

    /// Returns the position of the handle for a value, in model space.
    pub(super) fn gizmo_handle_position(&self, value: [f64; 3], axes: DMat3) -> DVec3 {
        self.origin + axes * (DVec3::from(value) - DVec3::from(self.value))
    }
}

/// Returns a length rounded to millimetres or to `step`, such that it is exact in centimetres.
pub(super) fn snap_gizmo_length(metres: f64, step: Option<f64>) -> f64 {
    let step = step.unwrap_or(0.001);
    // Whole millimetres first, so that the value in centimetres has one decimal.
    let mm = ((metres / step).round() * step * 1000.0).round();
    // Adding 0.0 turns -0.0 into 0.0.
    mm / 10.0 / 100.0 + 0.0
}

/// Returns the value after a step by keys, in metres to the picture's right, up, and away from the eye. Each step
/// follows the axis of the signer that is nearest to it in the picture.
pub(super) fn step_gizmo_value(
    value: [f64; 3],
    [right, up, away]: [f64; 3],
    projection: &CameraProjection,
    axes: DMat3,
) -> [f64; 3] {
    let seen = [0, 1, 2].map(|nth| projection.to_picture_axes(axes.col(nth).as_vec3()));
    const AXIS_ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let fits = |order: &[usize; 3]| -> f32 {
        let [right, up, away] = order.map(|nth| seen[nth]);
        // Each axis is used once: two steps along one axis would leave a direction out of reach.
        right.x.abs() + up.y.abs() + away.z.abs()
    };
    let best = AXIS_ORDERS
        .into_iter()
        .reduce(|a, b| if fits(&b) > fits(&a) { b } else { a });
    let order = best.unwrap_or([0, 1, 2]);
    let mut value = value;
    for (at, distance) in [right, up, away].into_iter().enumerate() {
        let nth = order[at];
        let sign = match at {
            0 => seen[nth].x,
            1 => seen[nth].y,
            _ => -seen[nth].z,
        };
        if distance != 0.0 {
            value[nth] = snap_gizmo_length(value[nth] + distance * f64::from(sign.signum()), None);
        }
    }
    value
}

/// The place of a handle in the picture, in points from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GizmoLayout {
    pub(super) middle: [f32; 2],
    /// The ends of left, up and forward; `None` for an axis that points towards the eye.
    pub(super) ends: [Option<[f32; 2]>; 3],
}

/// Returns the place of a handle at `origin`; `None` if it is behind the eye.
pub(super) fn lay_out_gizmo(projection: &CameraProjection, origin: DVec3, axes: DMat3) -> Option<GizmoLayout> {
    let projected = projection.project_point(origin.as_vec3());
    let ends = [0, 1, 2].map(|nth| {
        let direction: Vec3 = projection.to_picture_axes(axes.col(nth).as_vec3()) * GIZMO_AXIS_LENGTH_POINTS;
        // An axis along the line of sight is a point in the picture and cannot be dragged.
        let length = direction.x.hypot(direction.y);
        (length >= MIN_GIZMO_AXIS_POINTS).then_some([projected.x + direction.x, projected.y - direction.y])
    });
    (projected.depth > 0.0).then_some(GizmoLayout {
        middle: [projected.x, projected.y],
        ends,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_figure::camera::FigureCamera;
    use proptest::prelude::*;

    fn front() -> CameraProjection {
        let camera = FigureCamera {
            eye: Vec3::new(0.0, 1.0, 7.0),
            target: Vec3::new(0.0, 1.0, 0.0),
            up: Vec3::Y,
            half_height: 1.0,
            near: 0.0,
        };
        camera.camera_projection(400, 400)
    }

    /// Left, up and forward of a signer who faces +Z.
    const OWN: DMat3 = DMat3::IDENTITY;

    fn pixel(projection: &CameraProjection, at: DVec3) -> [f32; 2] {
        let at = projection.project_point(at.as_vec3());
        [at.x, at.y]
    }

    #[test]
    fn a_line_of_sight_passes_through_the_point_seen_there() {
        let projection = front();
        for at in [
            DVec3::new(0.3, 1.2, 0.4),
            DVec3::new(-0.5, 0.4, -0.3),
            DVec3::new(0.0, 1.0, 0.0),
        ] {
            let ray = SightRay::ray_through_point(&projection, pixel(&projection, at));
            let nearest = ray.from + ray.along * ray.along.dot(at - ray.from);
            assert!(nearest.distance(at) < 1e-4, "{at}: {nearest}");
        }
    }

    #[test]
    fn rays_meet_axes_and_planes_at_the_points_of_closed_forms() {
        // The ray from (1, 2, 5) straight back is nearest to the x axis at x = 1, and meets z = 0 at (1, 2, 0).
        let ray = SightRay {
            from: DVec3::new(1.0, 2.0, 5.0),
            along: DVec3::NEG_Z,
        };
        assert_eq!(ray.along_axis(DVec3::ZERO, DVec3::X), Some(1.0));
        assert_eq!(ray.along_axis(DVec3::new(0.25, 9.0, 0.0), DVec3::X), Some(0.75));
        assert_eq!(ray.along_axis(DVec3::ZERO, DVec3::Z), None);
        assert_eq!(ray.on_plane(DVec3::ZERO, DVec3::Z), Some(DVec3::new(1.0, 2.0, 0.0)));
        assert_eq!(ray.on_plane(DVec3::ZERO, DVec3::X), None);
        assert_eq!(ray.on_plane(DVec3::new(0.0, 0.0, 9.0), DVec3::Z), None, "behind");
        // At 45 degrees from (0, 0, 1) it crosses the x axis at 1.
        let slant = SightRay {
            from: DVec3::Z,
            along: DVec3::new(1.0, 0.0, -1.0).normalize(),
        };
        let at = slant.along_axis(DVec3::ZERO, DVec3::X).expect("not along");
        assert!((at - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_dragged_handle_stays_under_the_pointer() {
        let projection = front();
        let origin = DVec3::new(-0.2, 1.1, 0.3);
        for (part, offset) in [
            (HandlePart::Axis(0), DVec3::new(0.15, 0.0, 0.0)),
            (HandlePart::Axis(1), DVec3::new(0.0, -0.2, 0.0)),
            (HandlePart::Middle, DVec3::new(0.1, 0.07, 0.0)),
        ] {
            let begun = GizmoDragStart {
                part,
                origin,
                value: [0.1, 0.0, 0.05],
                ray: SightRay::ray_through_point(&projection, pixel(&projection, origin)),
                sight: DVec3::NEG_Z,
            };
            let ray = SightRay::ray_through_point(&projection, pixel(&projection, origin + offset));
            let value = begun.dragged_gizmo_value(ray, OWN, None).expect("a value");
            let wanted = DVec3::new(0.1, 0.0, 0.05) + offset;
            assert!(DVec3::from(value).distance(wanted) < 2e-3, "{part:?}: {value:?}");
            assert!(begun.gizmo_handle_position(value, OWN).distance(origin + offset) < 2e-3);
            let whole = begun.dragged_gizmo_value(ray, OWN, Some(0.01)).expect("a value");
            let moved = (0..3).filter(|nth| whole[*nth] != begun.value[*nth]);
            for nth in moved {
                let cm = whole[nth] * 100.0;
                assert!((cm - cm.round()).abs() < 1e-6, "{whole:?}");
            }
        }
    }

    #[test]
    fn lengths_are_written_in_centimetres() {
        for mm in -999..999 {
            let metres = snap_gizmo_length(f64::from(mm) / 1000.0 + 0.0002, None);
            let text = chereme_corpus::recipe::RecipeLength::Metres(metres).to_string();
            assert_eq!(text, format!("{}cm", f64::from(mm) / 10.0));
        }
        assert_eq!(snap_gizmo_length(0.1872, Some(0.01)), 0.19);
    }

    #[test]
    fn arrow_keys_move_a_handle_as_seen_in_the_picture() {
        let one = |from: Vec3, to: Vec3, up: Vec3, keys: [f64; 3]| {
            let camera = FigureCamera {
                eye: from,
                target: to,
                up,
                half_height: 1.0,
                near: 0.0,
            };
            step_gizmo_value([0.0; 3], keys, &camera.camera_projection(400, 400), OWN)
        };
        let (up, middle) = (Vec3::Y, Vec3::new(0.0, 1.0, 0.0));
        let addressee = Vec3::new(0.0, 1.0, 7.0);
        assert_eq!(one(addressee, middle, up, [0.01, 0.0, 0.0]), [0.01, 0.0, 0.0]);
        assert_eq!(one(addressee, middle, up, [0.0, 0.05, 0.0]), [0.0, 0.05, 0.0]);
        assert_eq!(one(addressee, middle, up, [0.0, 0.0, 0.01]), [0.0, 0.0, -0.01]);
        // From the signer's left, forward is to the left of the picture.
        let left = Vec3::new(7.0, 1.0, 0.0);
        assert_eq!(one(left, middle, up, [0.01, 0.0, 0.0]), [0.0, 0.0, -0.01]);
        assert_eq!(one(left, middle, up, [0.0, 0.0, 0.01]), [-0.01, 0.0, 0.0]);
        let above = Vec3::new(0.0, 8.0, 0.0);
        assert_eq!(one(above, middle, Vec3::NEG_Z, [0.0, 0.01, 0.0]), [0.0, 0.0, -0.01]);
        assert_eq!(one(above, middle, Vec3::NEG_Z, [0.0, 0.0, 0.01]), [0.0, -0.01, 0.0]);
    }

    #[test]
    fn ends_lie_along_the_axes_and_none_points_at_the_eye() {
        let laid = lay_out_gizmo(&front(), DVec3::new(0.0, 1.0, 0.0), OWN).expect("seen");
        assert_eq!(laid.middle, [200.0, 200.0]);
        assert_eq!(laid.ends[0], Some([200.0 + GIZMO_AXIS_LENGTH_POINTS, 200.0]));
        assert_eq!(laid.ends[1], Some([200.0, 200.0 - GIZMO_AXIS_LENGTH_POINTS]));
        assert_eq!(laid.ends[2], None);
        assert!(super::lay_out_gizmo(&front(), DVec3::new(0.0, 1.0, 8.0), OWN).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_nearest_point_of_an_axis_is_at_a_right_angle_to_it(
            from in prop::array::uniform3(-3.0f64..3.0),
            to in prop::array::uniform3(-1.0f64..1.0),
            axis in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let (from, to) = (DVec3::from(from), DVec3::from(to));
            let (Some(along), Some(axis)) = ((to - from).try_normalize(), DVec3::from(axis).try_normalize())
            else {
                return Ok(());
            };
            let ray = SightRay { from, along };
            if let Some(far) = ray.along_axis(DVec3::ZERO, axis) {
                let place = axis * far;
                let on_ray = from + along * along.dot(place - from);
                prop_assert!((place - on_ray).dot(axis).abs() < 1e-6 * (1.0 + far.abs()));
            }
        }
    }
}
