//! The canonical head: one closed net around mouth and eyes, in head heights from the middle between chin and crown.
//!
//! x to the signer's left, y up, z forwards. The net is built once over directions from the middle of the head;
//! expressions move its vertices.

use std::f32::consts::{PI, TAU};
use std::sync::OnceLock;

use glam::{DVec2, Vec2, Vec3};

use super::delaunay;
use super::solids::{BodySolid, find_surface_crossing, join_solid_distances, smooth_step};

/// The number of vertices in each loop of the mouth.
pub(super) const MOUTH_LOOP_VERTICES: usize = 24;
/// The number of vertices in each loop of an eye.
pub(super) const EYE_LOOP_VERTICES: usize = 18;
/// Height of the line between the lips.
pub(super) const LIP_LINE_HEIGHT: f32 = -0.292;
/// Middle and radius of the signer's left eyeball.
pub(super) const LEFT_EYEBALL: (Vec3, f32) = (Vec3::new(0.140, 0.0, 0.232), 0.064);
/// The point from which directions are measured.
const HEAD_MIDDLE: Vec3 = Vec3::new(0.0, -0.05, -0.03);

/// The part of the face that a vertex belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FacePart {
    /// The skin.
    Skin,
    /// A loop of the mouth, counted from its inner edge outwards, and the index in the loop.
    Mouth(usize, usize),
    /// The side (0 for right), a loop of the eye, counted from its edge outwards, and the index in the loop.
    Eye(usize, usize, usize),
    /// The inside of the mouth.
    Bowl(usize),
    /// The surface behind the lids.
    Socket(usize, usize),
}

/// A vertex of the canonical head at rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeadVertex {
    pub(super) at: Vec3,
    pub(super) place: FacePart,
    /// The share of light that reaches it.
    pub(super) open: f32,
}

/// The canonical head.
#[derive(Debug)]
pub(super) struct CanonicalHead {
    pub(super) knots: Vec<HeadVertex>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Triangles of the scalp.
    pub(super) scalp: Vec<[u32; 3]>,
    front: Vec<f32>,
}

/// The number of steps in each direction of the table of the front's surface.
const FRONT_TABLE_STEPS: usize = 72;
/// The reach of that table from the middle, to every side.
const FRONT_TABLE_REACH: f32 = 0.52;

impl CanonicalHead {
    /// Returns the head; built once.
    pub(super) fn shared_head() -> &'static Self {
        static BUILT_HEAD: OnceLock<CanonicalHead> = OnceLock::new();
        BUILT_HEAD.get_or_init(Self::make_canonical_head)
    }

    /// Returns the depth, forwards, of the surface at a place seen from the front.
    pub(super) fn front_depth_at(&self, x: f32, y: f32) -> f32 {
        let table_position = |v: f32| {
            ((v / FRONT_TABLE_REACH + 1.0) * 0.5 * (FRONT_TABLE_STEPS - 1) as f32)
                // Just below the last cell's end, so that its right neighbour exists for the interpolation.
                .clamp(0.0, FRONT_TABLE_STEPS as f32 - 1.001)
        };
        let (u, v) = (table_position(x), table_position(y));
        let (i, j) = (u as usize, v as usize);
        let value = |i: usize, j: usize| self.front[j * FRONT_TABLE_STEPS + i];
        let (s, t) = (u - i as f32, v - j as f32);
        let row = |j: usize| value(i, j) * (1.0 - s) + value(i + 1, j) * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    }

    fn make_canonical_head() -> Self {
        let solids = solids();
        let field = |p: Vec3| head_distance(&solids, p);
        let step = 2.0 * FRONT_TABLE_REACH / (FRONT_TABLE_STEPS - 1) as f32;
        let front: Vec<f32> = (0..FRONT_TABLE_STEPS * FRONT_TABLE_STEPS)
            .map(|i| {
                let (x, y) = (
                    (i % FRONT_TABLE_STEPS) as f32 * step - FRONT_TABLE_REACH,
                    (i / FRONT_TABLE_STEPS) as f32 * step - FRONT_TABLE_REACH,
                );
                from_front(&field, x, y)
            })
            .collect();
        let mut canon = Self {
            knots: Vec::new(),
            triangles: Vec::new(),
            scalp: Vec::new(),
            front,
        };
        canon.lay_out_head(&field);
        canon.shade_head_vertices(&field);
        canon
    }

    fn lay_out_head(&mut self, field: &dyn Fn(Vec3) -> f32) {
        let mut places: Vec<(Vec3, FacePart)> = Vec::new();
        // Built with open lips, so that no two vertices coincide.
        for ring in 0..4 {
            for k in 0..MOUTH_LOOP_VERTICES {
                let [x, y] = lip_loop_vertex(ring, k, 0.7);
                places.push((Vec3::new(x, y, self.front_depth_at(x, y)), FacePart::Mouth(ring, k)));
            }
        }
        for side in 0..2 {
            for ring in 0..4 {
                for k in 0..EYE_LOOP_VERTICES {
                    // The loops come first: skin keeps another distance from them than from skin.
                    let [x, y] = eye_loop_vertex(side, ring, k);
                    places.push((Vec3::new(x, y, self.front_depth_at(x, y)), FacePart::Eye(side, ring, k)));
                }
            }
        }
        let loops = places.len();
        // The hairline, then the nose, then the rest.
        for k in 0..44 {
            let around = TAU * k as f32 / 44.0;
            let outward = Vec3::new(around.sin(), hairline(around), around.cos());
            let flat = Vec3::new(around.sin(), 0.0, around.cos());
            let skin_place = surface_point_at_height(field, flat, outward.y);
            places.push((skin_place, FacePart::Skin));
        }
        for k in 0..32 {
            let (row, column) = (k / 4, k % 4);
            let y = 0.0 - row as f32 * 0.029;
            // The nose gets wider downwards, so its columns fan out from bridge to wings.
            let wide = 0.020 + 0.050 * smooth_step(row as f32 / 6.0);
            let x = (column as f32 / 1.5 - 1.0) * wide;
            places.push((Vec3::new(x, y, self.front_depth_at(x, y)), FacePart::Skin));
        }
        let fine = 0.115;
        let grid = |spacing: f32| {
            // A row of equilateral triangles is 0.866 (half the root of three) of the spacing high.
            let rows = (PI / (spacing * 0.866)) as i32 + 1;
            let columns = (PI / spacing) as i32 + 1;
            (-rows..=rows).flat_map(move |row| {
                (-columns..=columns).map(move |column| {
                    let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
                    Vec2::new((column as f32 + shift) * spacing, row as f32 * spacing * 0.866)
                })
            })
        };
        // The face needs small triangles for expressions; beyond it, over the skull, coarser ones do.
        for (spacing, from, to) in [(fine, 0.0, 1.15), (0.19, 1.15, 2.62)] {
            for at in grid(spacing) {
                let angle = at.length();
                if angle < from || angle >= to {
                    continue;
                }
                let surface_place = surface_point_towards(field, direction_from_flat(at));
                let flat_place = flatten_head_place(surface_place);
                let near = places.iter().enumerate().any(|(index, (other, _))| {
                    // Loops are dense themselves, so skin may come closer to them than to other skin.
                    let limit = if index < loops { 0.55 * fine } else { 0.62 * spacing };
                    flatten_head_place(*other).distance(flat_place) < f64::from(limit)
                });
                let inside = is_in_loop(&places, flat_place, surface_place);
                if !near && !inside {
                    places.push((surface_place, FacePart::Skin));
                }
            }
        }
        // The net is flat only if the back of the head is open: this rim is closed to a pole afterwards.
        let rim = places.len();
        for k in 0..16 {
            let angle = TAU * k as f32 / 16.0;
            // 2.80 radians lie short of straight backwards (pi), where all directions of the flat map meet.
            let rim_point = Vec2::new(angle.cos(), angle.sin()) * 2.80;
            places.push((
                surface_point_towards(field, direction_from_flat(rim_point)),
                FacePart::Skin,
            ));
        }
        let points: Vec<DVec2> = places.iter().map(|(at, _)| flatten_head_place(*at)).collect();
        let mut triangles = delaunay::delaunay_triangles(&points);
        triangles.retain(|t| !is_opening(t.map(|i| places[i].1)));
        // Seen from outside, the signer's left is at the right: the net is anticlockwise already.
        for (at, place) in &places {
            self.knots.push(HeadVertex {
                at: *at,
                place: *place,
                open: 1.0,
            });
        }
        self.triangles = triangles.iter().map(|t| t.map(|i| i as u32)).collect();
        self.rest_head_loops();
        self.close_head_holes(rim, field);
        self.grow_hair();
    }

    /// Moves the loops to their positions at rest.
    fn rest_head_loops(&mut self) {
        let moved: Vec<Vec3> = self
            .knots
            .iter()
            .map(|knot| match knot.place {
                FacePart::Mouth(ring, k) => {
                    // At rest the lips are closed; they were open only while the net was triangulated.
                    let [x, y] = lip_loop_vertex(ring, k, 0.0);
                    Vec3::new(x, y, self.front_depth_at(x, y))
                }
                _ => knot.at,
            })
            .collect();
        for (knot, at) in self.knots.iter_mut().zip(moved) {
            knot.at = at;
        }
    }

    /// Closes the back of the head, the mouth and the eyes.
    fn close_head_holes(&mut self, rim: usize, field: &dyn Fn(Vec3) -> f32) {
        let back = self.add_head_vertex(surface_point_towards(field, Vec3::NEG_Z), FacePart::Skin);
        for k in 0..16 {
            let (a, b) = ((rim + k) as u32, (rim + (k + 1) % 16) as u32);
            self.triangles.push([b, a, back]);
        }
        let first = |place: FacePart, knots: &[HeadVertex]| knots.iter().position(|knot| knot.place == place);
        let mouth = first(FacePart::Mouth(0, 0), &self.knots).unwrap_or(0) as u32;
        let bowl: Vec<u32> = (0..MOUTH_LOOP_VERTICES)
            .map(|k| {
                let knot_place = self.knots[mouth as usize + k].at;
                // A bowl behind the lips hides the inside of the head when the mouth opens.
                self.add_head_vertex(knot_place - Vec3::Z * 0.07, FacePart::Bowl(k))
            })
            .collect();
        let pole = self.add_head_vertex(
            Vec3::new(0.0, LIP_LINE_HEIGHT, 0.16),
            FacePart::Bowl(MOUTH_LOOP_VERTICES),
        );
        for k in 0..MOUTH_LOOP_VERTICES as u32 {
            let next = (k + 1) % MOUTH_LOOP_VERTICES as u32;
            let (a, b) = (mouth + k, mouth + next);
            let (c, d) = (bowl[k as usize], bowl[next as usize]);
            self.triangles
                .extend([[a, b, d], [a, d, c], [c, d, pole]].map(|[p, q, r]| [p, r, q]));
        }
        for side in 0..2 {
            let edge = first(FacePart::Eye(side, 0, 0), &self.knots).unwrap_or(0) as u32;
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let centre = LEFT_EYEBALL.0 * Vec3::new(sign, 1.0, 1.0);
            let pole = self.add_head_vertex(centre - Vec3::Z * 0.10, FacePart::Socket(side, EYE_LOOP_VERTICES));
            for k in 0..EYE_LOOP_VERTICES as u32 {
                let next = (k + 1) % EYE_LOOP_VERTICES as u32;
                self.triangles.push([edge + k, pole, edge + next]);
            }
        }
        // The bowl and the sockets are added in no fixed direction of turn, so the whole net is oriented once.
        orient_net_outwards(&mut self.triangles, &self.knots);
    }

    fn add_head_vertex(&mut self, at: Vec3, place: FacePart) -> u32 {
        self.knots.push(HeadVertex { at, place, open: 1.0 });
        self.knots.len() as u32 - 1
    }

    fn grow_hair(&mut self) {
        let above: Vec<bool> = self
            .knots
            .iter()
            .map(|knot| knot.place == FacePart::Skin && height_above_hairline(knot.at) > -0.004)
            .collect();
        let scalp = self.triangles.iter().filter(|t| t.iter().all(|&i| above[i as usize]));
        self.scalp = scalp.copied().collect();
    }

    fn shade_head_vertices(&mut self, field: &dyn Fn(Vec3) -> f32) {
        for knot in &mut self.knots {
            let normal = super::solids::field_slope(field, knot.at, 0.006);
            let mut dark = 0.0;
            // Skin closer than a probe is long takes light away, near skin most.
            for step in 1..=5 {
                let far = step as f32 * 0.03;
                dark += (far - field(knot.at + normal * far)).max(0.0) / 0.03 * 0.5f32.powi(step);
            }
            // A hollow gets at most a fifth darker, so that the face stays readable.
            knot.open = (1.0 - 0.26 * dark).clamp(0.80, 1.0);
        }
    }
}

/// Orients all triangles of a connected net outwards.
fn orient_net_outwards(triangles: &mut [[u32; 3]], knots: &[HeadVertex]) {
    use std::collections::BTreeMap;
    let mut edges: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (index, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            edges.entry((a.min(b), a.max(b))).or_default().push(index);
        }
    }
    let mut visited = vec![false; triangles.len()];
    let mut next = vec![0];
    visited[0] = true;
    while let Some(index) = next.pop() {
        let current_triangle = triangles[index];
        for k in 0..3 {
            let (a, b) = (current_triangle[k], current_triangle[(k + 1) % 3]);
            for &other in &edges[&(a.min(b), a.max(b))] {
                if visited[other] {
                    continue;
                }
                let t = triangles[other];
                // Two triangles that agree run along their common edge in opposite directions.
                let same = (0..3).any(|k| (t[k], t[(k + 1) % 3]) == (a, b));
                if same {
                    triangles[other].swap(1, 2);
                }
                visited[other] = true;
                next.push(other);
            }
        }
    }
    let corner = |i: u32| knots[i as usize].at;
    let volume: f32 = triangles
        .iter()
        .map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))))
        .sum();
    // The first triangle's direction was arbitrary: a negative volume says that the net is inside out.
    if volume < 0.0 {
        for triangle in triangles {
            triangle.swap(1, 2);
        }
    }
}

/// Returns a place in the plane on which the net is built: the direction from the middle of the head, by its angle from
/// straight ahead.
fn flatten_head_place(at: Vec3) -> DVec2 {
    let outward = (at - HEAD_MIDDLE).as_dvec3().normalize();
    // Rounding may push the cosine beyond one, where the arc cosine is not a number.
    let angle = outward.z.clamp(-1.0, 1.0).acos();
    DVec2::new(outward.x, outward.y).normalize_or_zero() * angle
}

fn direction_from_flat(at: Vec2) -> Vec3 {
    let angle = at.length();
    let around = at.normalize_or_zero();
    Vec3::new(around.x * angle.sin(), around.y * angle.sin(), angle.cos())
}

/// Returns the point of the surface in a direction from the middle of the head.
fn surface_point_towards(field: &dyn Fn(Vec3) -> f32, towards: Vec3) -> Vec3 {
    find_surface_crossing(field, HEAD_MIDDLE, towards, 0.1, 0.9, 18)
}

/// Returns the point of the surface at a height, in a horizontal direction from the middle of the head.
fn surface_point_at_height(field: &dyn Fn(Vec3) -> f32, towards: Vec3, y: f32) -> Vec3 {
    let from = Vec3::new(0.0, y, HEAD_MIDDLE.z);
    find_surface_crossing(field, from, towards, 0.05, 0.7, 18)
}

fn from_front(field: &dyn Fn(Vec3) -> f32, x: f32, y: f32) -> f32 {
    // In front of the nose tip, so that the march meets the surface from outside.
    let mut z = 0.62;
    for _ in 0..60 {
        let away = field(Vec3::new(x, y, z));
        if away < 0.0008 || z < -0.5 {
            break;
        }
        // Smooth unions distort distances, so that a step is shorter than the distance found.
        z -= (away * 0.8).max(0.001);
    }
    // Beside the head the ray meets nothing; its depth stays at that of the sides.
    z.max(-0.2)
}

/// Returns whether a place lies inside an opening or its loops.
fn is_in_loop(places: &[(Vec3, FacePart)], at: DVec2, place: Vec3) -> bool {
    let within = |wanted: &dyn Fn(FacePart) -> bool| {
        let corners: Vec<DVec2> = places
            .iter()
            .filter(|(_, place)| wanted(*place))
            .map(|(at, _)| flatten_head_place(*at))
            .collect();
        let mut inside = false;
        for k in 0..corners.len() {
            let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
            // An even-odd test: from inside, a ray crosses the outline an odd number of times.
            if (a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x {
                inside = !inside;
            }
        }
        inside
    };
    // Behind the head the flat map runs wide and says nothing about openings.
    place.z > 0.0
        && (within(&|part| matches!(part, FacePart::Mouth(3, _)))
            || within(&|part| matches!(part, FacePart::Eye(0, 3, _)))
            || within(&|part| matches!(part, FacePart::Eye(1, 3, _))))
}

fn is_opening(places: [FacePart; 3]) -> bool {
    places.iter().all(|part| matches!(part, FacePart::Mouth(0, _)))
        || places.iter().all(|part| matches!(part, FacePart::Eye(0, 0, _)))
        || places.iter().all(|part| matches!(part, FacePart::Eye(1, 0, _)))
}

/// Returns a vertex of the mouth's loops with the lips open by a share.
fn lip_loop_vertex(ring: usize, k: usize, apart: f32) -> [f32; 2] {
    let (sine, cosine) = (TAU * k as f32 / MOUTH_LOOP_VERTICES as f32).sin_cos();
    let far = sine.abs();
    // The upper lip is thinner in its middle: Cupid's bow.
    let bow = 1.0 - 0.28 * (-(cosine / 0.16).powi(2)).exp();
    let (thick, gap) = if sine >= 0.0 {
        (0.034 * far.powf(0.8) * bow, 0.032 * apart)
    } else {
        (0.042 * far.powf(0.9), 0.029 * apart)
    };
    let [inner, wide] = [[0.0, 0.97], [0.5, 0.985], [1.0, 1.0], [1.0, 1.22]][ring];
    // The outermost loop lies in the skin around the lips, which it lets move with them.
    let skin = if ring == 3 { 0.032 } else { 0.0 };
    let y = sine.signum() * (thick * inner + gap * far.powf(0.75) + skin * far) + 0.004 * cosine.abs().powf(2.2);
    [0.110 * wide * cosine, LIP_LINE_HEIGHT + y]
}

/// Returns a vertex of the loops of the right (0) or left (1) eye.
pub(super) fn eye_loop_vertex(side: usize, ring: usize, k: usize) -> [f32; 2] {
    let half = EYE_LOOP_VERTICES as f32 / 2.0;
    let upper = k < EYE_LOOP_VERTICES / 2;
    // From the inner corner to the outer one along the upper lid, and back along the lower one.
    let t = if upper { k as f32 / half } else { 2.0 - k as f32 / half };
    let height = if upper {
        0.042 * (PI * t.powf(0.85)).sin().max(0.0).powf(0.8)
    } else {
        -0.030 * (PI * t.powf(1.15)).sin().max(0.0).powf(0.9)
    };
    let x = -0.072 * (PI * t).cos();
    let (wide, more) = [(1.0, 0.0), (1.06, 0.0075), (1.18, 0.022), (1.42, 0.042)][ring];
    // The outer loops bulge over the middle of the eye and meet its corners.
    let round = (1.0 - (x / 0.072).powi(2)).max(0.0).sqrt();
    let y = height + more * round * if upper { 1.0 } else { -0.75 };
    let sign = if side == 0 { -1.0 } else { 1.0 };
    [sign * (LEFT_EYEBALL.0.x + x * wide), y]
}

/// Returns the height of the hairline at an angle around the head, 0 straight ahead.
fn hairline(around: f32) -> f32 {
    const HAIRLINE_POINTS: [[f32; 2]; 9] = [
        [0.0, 0.335],
        [30.0, 0.315],
        [48.0, 0.26],
        [62.0, 0.17],
        [74.0, -0.02],
        [86.0, 0.02],
        [100.0, 0.06],
        [125.0, -0.17],
        [180.0, -0.26],
    ];
    let around = (around / TAU).fract() * 360.0;
    // Both halves of the head have the same hairline.
    let angle = if around > 180.0 { 360.0 - around } else { around };
    let piece = HAIRLINE_POINTS.windows(2).find(|pair| angle <= pair[1][0]);
    piece.map_or(-0.26, |pair| {
        let share = (angle - pair[0][0]) / (pair[1][0] - pair[0][0]);
        pair[0][1] + (pair[1][1] - pair[0][1]) * share
    })
}

/// Returns the height of a place of the head above the hairline.
pub(super) fn height_above_hairline(at: Vec3) -> f32 {
    at.y - hairline(at.x.atan2(at.z - HEAD_MIDDLE.z).rem_euclid(TAU))
}

struct HeadSolids {
    grown: Vec<(Vec<BodySolid>, f32)>,
    sockets: Vec<BodySolid>,
    nose: Vec<(Vec<BodySolid>, f32)>,
}

fn solids() -> HeadSolids {
    let both = |make: &dyn Fn(f32) -> BodySolid| vec![make(1.0), make(-1.0)];
    HeadSolids {
        grown: vec![
            (
                vec![BodySolid::new_ball_solid([0.0, 0.105, -0.055], [0.325, 0.395, 0.410])],
                0.10,
            ),
            (
                vec![BodySolid::new_ball_solid([0.0, -0.10, 0.070], [0.262, 0.345, 0.265])],
                0.10,
            ),
            (
                both(&|s| {
                    BodySolid::new_rod_solid([0.180 * s, -0.235, -0.03], [0.055 * s, -0.410, 0.185], [0.092, 0.078])
                }),
                0.10,
            ),
            (
                vec![BodySolid::new_ball_solid([0.0, -0.43, 0.220], [0.085, 0.06, 0.065])],
                0.05,
            ),
            (
                both(&|s| BodySolid::new_ball_solid([0.150 * s, -0.105, 0.180], [0.125, 0.125, 0.125])),
                0.07,
            ),
            (
                both(&|s| BodySolid::new_rod_solid([0.03 * s, 0.085, 0.272], [0.19 * s, 0.075, 0.205], [0.052, 0.048])),
                0.05,
            ),
        ],
        sockets: both(&|s| BodySolid::new_ball_solid([0.140 * s, 0.002, 0.385], [0.088, 0.088, 0.088])),
        nose: vec![
            (
                vec![BodySolid::new_rod_solid(
                    [0.0, 0.035, 0.288],
                    [0.0, -0.148, 0.400],
                    [0.024, 0.038],
                )],
                0.028,
            ),
            (
                both(&|s| BodySolid::new_ball_solid([0.043 * s, -0.165, 0.335], [0.034, 0.030, 0.034])),
                0.025,
            ),
            (
                vec![BodySolid::new_ball_solid([0.0, -0.280, 0.232], [0.125, 0.095, 0.100])],
                0.05,
            ),
        ],
    }
}

fn head_distance(solids: &HeadSolids, point: Vec3) -> f32 {
    let add = |all: f32, (parts, width): &(Vec<BodySolid>, f32)| {
        parts.iter().fold(all, |all, solid| {
            join_solid_distances(all, solid.distance_to_solid(point), *width)
        })
    };
    let mut all = solids.grown.iter().fold(f32::INFINITY, add);
    for socket in &solids.sockets {
        // A smooth difference: the socket is cut out of what the other solids make.
        all = -join_solid_distances(-all, socket.distance_to_solid(point), 0.06);
    }
    solids.nose.iter().fold(all, add)
}
