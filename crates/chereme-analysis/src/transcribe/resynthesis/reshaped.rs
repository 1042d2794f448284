//! Other kinds of a motion: a path or none, an arc or a circle.

use chereme_sign::hamnosys::{
    Amount, Circular, Clock, Compass, Curve, Directed, Direction, Motion, MotionKind, Posture,
    orientation,
};
use glam::DVec3;

/// The cosine of the smallest angle between an axis and a direction that counts as across it.
const ACROSS: f64 = 0.3;

/// Returns a motion's readings of another kind: a posture that a path leads to, or that is taken without a path; a circle for an
/// arc, and an arc for a circle.
pub(super) fn reshaped(of: &Motion) -> Vec<Motion> {
    let kinds: Vec<MotionKind> = match &of.kind {
        MotionKind::Target { motion, posture } => match motion.as_deref() {
            None => posture_after_path(posture),
            Some(motion) if is_path(motion) => vec![MotionKind::Target {
                motion: None,
                posture: posture.clone(),
            }],
            Some(_) => Vec::new(),
        },
        MotionKind::Directed(path) => path.curve.map_or_else(Vec::new, |it| circles(path, it)),
        MotionKind::Circular(circle) => arcs(circle),
        _ => Vec::new(),
    };
    let kinds = kinds.into_iter();
    kinds.map(|kind| Motion { kind, ..of.clone() }).collect()
}

fn is_path(motion: &Motion) -> bool {
    matches!(
        motion.kind,
        MotionKind::Directed(_) | MotionKind::Circular(_)
    )
}

/// Returns straight paths in all directions that end in a posture.
fn posture_after_path(posture: &Posture) -> Vec<MotionKind> {
    let directions = Direction::all().filter(|direction| direction.has_symbol());
    let paths = directions.map(|direction| MotionKind::Directed(straight(direction)));
    paths
        .map(|path| MotionKind::Target {
            motion: Some(Box::new(Motion::new(path))),
            posture: Box::new(posture.clone()),
        })
        .collect()
}

fn straight(direction: Direction) -> Directed {
    Directed {
        direction,
        second: None,
        size: Amount::default(),
        curve: None,
        zigzag: None,
        ellipse: None,
    }
}

/// Returns circles that begin as an arc does, about the two axes nearest to its own, from each hour.
fn circles(path: &Directed, curve: Curve) -> Vec<MotionKind> {
    let along = DVec3::from(path.direction.vector());
    let bulge = DVec3::from(orientation::about(along.to_array(), curve.to.angle()));
    let axis = bulge.cross(along);
    let cosine = |it: &Direction| axis.dot(DVec3::from(it.vector()));
    let mut axes: Vec<Direction> = Direction::all().filter(|it| it.has_symbol()).collect();
    axes.sort_by(|a, b| cosine(b).total_cmp(&cosine(a)));
    let hours: Vec<Option<Compass>> = [None].into_iter().chain(Compass::ALL.map(Some)).collect();
    let nearest = axes.into_iter().take(2);
    let all = nearest.flat_map(|axis| {
        hours.iter().map(move |start| Circular {
            axis,
            second: None,
            size: path.size,
            ellipse: None,
            ellipse_size: None,
            clock: Clock {
                start: *start,
                ..Clock::default()
            },
            zigzag: None,
            growth: None,
        })
    });
    all.map(MotionKind::Circular).collect()
}

/// Returns arcs that turn about the axis of a circle.
fn arcs(circle: &Circular) -> Vec<MotionKind> {
    let axis = DVec3::from(circle.axis.vector());
    let all = Direction::all().filter(|it| it.has_symbol());
    let across = all.filter(|it| axis.dot(DVec3::from(it.vector())).abs() < ACROSS);
    across
        .map(|direction| {
            let along = DVec3::from(direction.vector());
            let bulge = along.cross(axis).to_array();
            let to = Compass::nearest(orientation::angle_about(along.to_array(), bulge));
            MotionKind::Directed(Directed {
                size: circle.size,
                curve: Some(Curve { to, size: None }),
                ..straight(direction)
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::actions::tests::{named, sign};
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
            let all: Vec<String> = reshaped(&of[0])
                .into_iter()
                .map(|it| named(vec![it]))
                .collect();
            assert!(all.iter().any(|it| it == expected), "{movement}: {all:?}");
        }
        let straight = sign("moveo").parts.swap_remove(0).actions;
        assert_eq!(reshaped(&straight[0]), []);
    }
}
