//! Implicit solids onto which a surface is projected, with rays and steps to their skin.

use glam::Vec3;

/// A simple solid; lengths in any one unit.
#[derive(Debug, Clone, Copy)]
pub(super) enum BodySolid {
    /// Everything near a segment: its ends, the radii there, and the factor by which it is thinner along a direction.
    Rod {
        ends: [Vec3; 2],
        radii: [f32; 2],
        flat: (Vec3, f32),
    },
    /// An ellipsoid along the axes.
    Ball { centre: Vec3, radii: Vec3 },
}

impl BodySolid {
    pub(super) fn new_rod_solid(a: [f32; 3], b: [f32; 3], radii: [f32; 2]) -> Self {
        Self::Rod {
            ends: [Vec3::from_array(a), Vec3::from_array(b)],
            radii,
            flat: (Vec3::Z, 1.0),
        }
    }

    pub(super) fn new_ball_solid(centre: [f32; 3], radii: [f32; 3]) -> Self {
        Self::Ball {
            centre: Vec3::from_array(centre),
            radii: Vec3::from_array(radii),
        }
    }

    /// Returns a rod that is thinner by `factor` along `direction`; a ball stays unchanged.
    pub(super) fn flatten_rod_solid(self, direction: Vec3, factor: f32) -> Self {
        match self {
            Self::Rod { ends, radii, .. } => Self::Rod {
                ends,
                radii,
                flat: (direction, factor),
            },
            ball => ball,
        }
    }

    /// Returns the approximate distance of a point outside; negative inside.
    pub(super) fn distance_to_solid(&self, point: Vec3) -> f32 {
        match *self {
            Self::Rod {
                ends,
                radii,
                flat: (direction, factor),
            } => {
                // Space is stretched along the direction, which makes the rod thinner there.
                let stretched = |p: Vec3| p + direction * ((factor - 1.0) * p.dot(direction));
                let [a, b] = ends.map(stretched);
                let (from, bone) = (stretched(point) - a, b - a);
                // A rod of no length is a ball.
                let raw_share = from.dot(bone) / bone.length_squared().max(1e-9);
                let share = raw_share.clamp(0.0, 1.0);
                let radius = radii[0] + (radii[1] - radii[0]) * share;
                // The stretch lengthens distances in between one and the factor times; the mean undoes it.
                ((from - bone * share).length() - radius) / (1.0 + (factor - 1.0) / 2.0)
            }
            Self::Ball { centre, radii } => {
                let from = point - centre;
                let (near, steep) = ((from / radii).length(), (from / (radii * radii)).length().max(1e-9));
                // The distance to first order: the value divided by its slope.
                near * (near - 1.0) / steep
            }
        }
    }
}

/// Returns the smaller of two distances, with a transition rounded over a width.
pub(super) fn join_solid_distances(a: f32, b: f32, width: f32) -> f32 {
    // The usual polynomial smooth minimum: nothing beyond the width, most where both are equal.
    let near = (width - (a - b).abs()).max(0.0) / width.max(1e-9);
    a.min(b) - near * near * width * 0.25
}

/// Returns the distance to several solids that blend together over a width.
pub(super) fn blended_solid_distance(solids: &[BodySolid], width: f32, point: Vec3) -> f32 {
    let distances = solids.iter().map(|solid| solid.distance_to_solid(point));
    distances.fold(f32::INFINITY, |all, one| join_solid_distances(all, one, width))
}

/// Returns the outward direction of a field at a point.
pub(super) fn field_slope(field: &dyn Fn(Vec3) -> f32, point: Vec3, step: f32) -> Vec3 {
    // Four corners of a tetrahedron give the slope with four evaluations instead of six.
    let directions = [
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(-1.0, -1.0, 1.0),
        Vec3::new(-1.0, 1.0, -1.0),
        Vec3::new(1.0, 1.0, 1.0),
    ];
    let sum: Vec3 = directions
        .iter()
        .map(|&direction| direction * field(point + direction * step))
        .sum();
    sum.normalize_or(Vec3::Y)
}

/// Returns the point of the skin near `point`.
pub(super) fn on_skin(field: &dyn Fn(Vec3) -> f32, point: Vec3, step: f32) -> Vec3 {
    let mut skin_point = point;
    // Smooth joins distort distances, so that one step is not enough.
    for _ in 0..6 {
        let away = field(skin_point);
        if away.abs() < step * 0.05 {
            break;
        }
        // A single step is limited, since far from the skin slopes lead anywhere.
        skin_point -= field_slope(field, skin_point, step) * away.clamp(-step * 30.0, step * 30.0);
    }
    skin_point
}

/// Returns the first point of the skin on a ray from inside.
pub(super) fn cast_skin_ray(field: &dyn Fn(Vec3) -> f32, from: Vec3, towards: Vec3, step: f32) -> Vec3 {
    let mut far = 0.0;
    for _ in 0..200 {
        let away = field(from + towards * far);
        if away >= 0.0 {
            break;
        }
        // Inside, distances are rather too long: a shorter step does not jump over the skin.
        far += (-away * 0.7).max(step * 0.2);
    }
    // The march may have gone a little past the skin.
    find_surface_crossing(field, from, towards, (far - step * 2.0).max(0.0), far, 12)
}

/// Returns the point on the surface between two distances along a line, by bisection: the field is below 0 at the first
/// and above at the second. Each of `rounds` halves the uncertainty.
pub(super) fn find_surface_crossing(
    field: &dyn Fn(Vec3) -> f32,
    from: Vec3,
    towards: Vec3,
    mut low: f32,
    mut high: f32,
    rounds: usize,
) -> Vec3 {
    for _ in 0..rounds {
        let middle = (low + high) * 0.5;
        if field(from + towards * middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    from + towards * high
}

/// Returns a smooth rise from 0 to 1 for shares from 0 to 1; clamped outside.
pub(super) fn smooth_step(share: f32) -> f32 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}
