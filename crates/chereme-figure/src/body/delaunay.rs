//! A net of triangles over points of a plane, each triangle as even as the points allow (Bowyer 1981, Watson 1981).

use glam::DVec2;

/// Returns the triangles of the Delaunay net of `points`, anticlockwise.
pub(super) fn delaunay_triangles(points: &[DVec2]) -> Vec<[usize; 3]> {
    let count = points.len();
    // The outer triangle holds all points, which lie within about pi of the origin.
    let far = 100.0;
    let mut all = points.to_vec();
    all.extend([DVec2::new(-far, -far), DVec2::new(far, -far), DVec2::new(0.0, far)]);
    let mut triangles = vec![[count, count + 1, count + 2]];
    for index in 0..count {
        let inserted_point = all[index];
        let mut rim: Vec<[usize; 2]> = Vec::new();
        triangles.retain(|&triangle| {
            let hit = is_within_circle(triangle.map(|i| all[i]), inserted_point);
            if hit {
                for k in 0..3 {
                    let edge = [triangle[k], triangle[(k + 1) % 3]];
                    // An edge of two removed triangles is inside the hole; its two directions cancel out.
                    match rim.iter().position(|rim_edge| *rim_edge == [edge[1], edge[0]]) {
                        Some(other) => {
                            rim.swap_remove(other);
                        }
                        None => rim.push(edge),
                    }
                }
            }
            !hit
        });
        triangles.extend(rim.into_iter().map(|[a, b]| [a, b, index]));
    }
    // Triangles with a corner of the outer one are not part of the net.
    triangles.retain(|triangle| triangle.iter().all(|&index| index < count));
    triangles
}

/// Returns whether a point lies in the circle through the corners of an anticlockwise triangle.
fn is_within_circle([a, b, c]: [DVec2; 3], at: DVec2) -> bool {
    let [a, b, c] = [a - at, b - at, c - at];
    let lift = |v: DVec2| v.length_squared();
    // Above rounding: of points on one circle none counts as inside.
    lift(a) * b.perp_dot(c) - lift(b) * a.perp_dot(c) + lift(c) * a.perp_dot(b) > 1e-14
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangulation_covers_the_convex_hull_exactly_once() {
        let points: Vec<DVec2> = (0..60)
            .map(|i| {
                let i = f64::from(i);
                DVec2::new((i * 12.9898).sin(), (i * 78.233).sin())
            })
            .chain([[-1.1, -1.1], [1.1, -1.1], [1.1, 1.1], [-1.1, 1.1]].map(DVec2::from))
            .collect();
        let net = delaunay_triangles(&points);
        let area = |[a, b, c]: [usize; 3]| (points[b] - points[a]).perp_dot(points[c] - points[a]) / 2.0;
        assert!(net.iter().all(|&triangle| area(triangle) > 0.0));
        let sum: f64 = net.iter().map(|&triangle| area(triangle)).sum();
        assert!((sum - 4.84).abs() < 1e-9, "{sum}");
    }
}
