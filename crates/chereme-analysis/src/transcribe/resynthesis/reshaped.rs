//! Other kinds of a motion: a path or none, an arc or a circle.

use chereme_sign::hamnosys::{
    CircularPath, ClockRange, CompassDirection, DirectedPath, MotionKind, NotatedMotion, NotatedPosture, PathCurve,
    SizeAmount, SpatialDirection, orientation,
};
use glam::DVec3;

/// The cosine of the smallest angle between an axis and a direction that counts as across it.
const ACROSS_AXIS_COSINE: f64 = 0.3;

/// Returns a motion's readings of another kind: a posture that a path leads to, or that is taken without a path; a circle for an
/// arc, and an arc for a circle.
pub(super) fn reshape_motion(of: &NotatedMotion) -> Vec<NotatedMotion> {
    let reshaped_kinds: Vec<MotionKind> = match &of.kind {
        MotionKind::Target { motion, posture } => match motion.as_deref() {
            None => posture_after_path(posture),
            Some(motion) if is_path(motion) => vec![MotionKind::Target {
                motion: None,
                posture: posture.clone(),
            }],
            Some(_) => Vec::new(),
        },
        MotionKind::Directed(path) => path.curve.map_or_else(Vec::new, |curve| arc_to_circles(path, curve)),
        MotionKind::Circular(circle) => arcs(circle),
        _ => Vec::new(),
    };
    let kinds = reshaped_kinds.into_iter();
    kinds.map(|kind| NotatedMotion { kind, ..of.clone() }).collect()
}

fn is_path(motion: &NotatedMotion) -> bool {
    matches!(motion.kind, MotionKind::Directed(_) | MotionKind::Circular(_))
}

/// Returns straight paths in all directions that end in a posture.
fn posture_after_path(posture: &NotatedPosture) -> Vec<MotionKind> {
    let directions = SpatialDirection::all_spatial_directions().filter(|direction| direction.has_symbol());
    let paths = directions.map(|direction| MotionKind::Directed(straight(direction)));
    paths
        .map(|path| MotionKind::Target {
            motion: Some(Box::new(NotatedMotion::new(path))),
            posture: Box::new(posture.clone()),
        })
        .collect()
}

fn straight(direction: SpatialDirection) -> DirectedPath {
    DirectedPath {
        direction,
        second: None,
        size: SizeAmount::default(),
        curve: None,
        zigzag: None,
        ellipse: None,
    }
}

/// Returns circles that begin as an arc does, about the two axes nearest to its own, from each hour.
fn arc_to_circles(path: &DirectedPath, curve: PathCurve) -> Vec<MotionKind> {
    let along = DVec3::from(path.direction.spatial_direction_vector());
    let bulge = DVec3::from(orientation::rotate_from_forward(
        along.to_array(),
        curve.to.compass_angle(),
    ));
    let axis = bulge.cross(along);
    let cosine = |direction: &SpatialDirection| axis.dot(DVec3::from(direction.spatial_direction_vector()));
    let mut axes: Vec<SpatialDirection> = SpatialDirection::all_spatial_directions()
        .filter(|direction| direction.has_symbol())
        .collect();
    axes.sort_by(|a, b| cosine(b).total_cmp(&cosine(a)));
    let hours: Vec<Option<CompassDirection>> = [None]
        .into_iter()
        .chain(CompassDirection::ALL_COMPASS_DIRECTIONS.map(Some))
        .collect();
    let nearest = axes.into_iter().take(2);
    let all = nearest.flat_map(|axis| {
        hours.iter().map(move |start| CircularPath {
            axis,
            second: None,
            size: path.size,
            ellipse: None,
            ellipse_size: None,
            clock: ClockRange {
                start: *start,
                ..ClockRange::default()
            },
            zigzag: None,
            growth: None,
        })
    });
    all.map(MotionKind::Circular).collect()
}

/// Returns arcs that turn about the axis of a circle.
fn arcs(circle: &CircularPath) -> Vec<MotionKind> {
    let axis = DVec3::from(circle.axis.spatial_direction_vector());
    let all = SpatialDirection::all_spatial_directions().filter(|direction| direction.has_symbol());
    let across =
        all.filter(|direction| axis.dot(DVec3::from(direction.spatial_direction_vector())).abs() < ACROSS_AXIS_COSINE);
    across
        .map(|direction| {
            let along = DVec3::from(direction.spatial_direction_vector());
            let bulge = along.cross(axis).to_array();
            let to = CompassDirection::nearest_compass_direction(orientation::angle_about(along.to_array(), bulge));
            MotionKind::Directed(DirectedPath {
                size: circle.size,
                curve: Some(PathCurve { to, size: None }),
                ..straight(direction)
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::resynthesis_actions::tests::{named, sign};
    use super::*;

    #[test]
    fn a_path_or_none_and_an_arc_or_a_circle() {
        let cases = [
            (
                "replace extfingeru palml",
                "parbegin moveo replace extfingeru palml parend",
            ),
            ("moveo chest touch", "replace chest touch"),
            // Up and back down again over the right: about the axis that points out.
            ("mover arcu", "circleo clockl"),
            ("circleo", "mover arcu"),
        ];
        for (movement, expected) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let all: Vec<String> = reshape_motion(&of[0]).into_iter().map(|it| named(vec![it])).collect();
            assert!(all.iter().any(|it| it == expected), "{movement}: {all:?}");
        }
        let straight = sign("moveo").parts.swap_remove(0).actions;
        assert_eq!(reshape_motion(&straight[0]), []);
    }
}
