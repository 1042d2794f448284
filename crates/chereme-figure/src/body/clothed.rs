//! The canonical trunk with both arms in clothes: rings projected onto an implicit body, one closed surface.
//!
//! Millimetres in bind space: x to the signer's left, y up, z forwards, the origin between the shoulder joints.
//! Measures follow ANSUR II (Gordon et al. 2014, NATICK/TR-15/007), means of men.

use std::sync::OnceLock;

use chereme_motion::BodySide;
use glam::Vec3;

use super::solids::{BodySolid, blended_solid_distance, field_slope, join_solid_distances, on_skin, smooth_step};
use super::trunk::arm_direction;

/// Half of the distance between the shoulder joints.
pub(super) const SHOULDER_HALF_WIDTH_MM: f32 = 172.0;
/// The length of the trunk.
pub(super) const TRUNK_LENGTH_MM: f32 = 500.0;
/// The length of the upper arm.
pub(super) const UPPER_ARM_LENGTH_MM: f32 = 290.0;
/// The length of the forearm.
pub(super) const FOREARM_LENGTH_MM: f32 = 245.0;

/// The shares of the followers that move a vertex of the clothes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FollowerShares {
    pub(super) pelvis: f32,
    pub(super) chest: f32,
    /// The thighs' part of the pelvis's share, right and left: the seat of the clothes bends with them.
    pub(super) thighs: [f32; 2],
    /// The neck's part of the chest's share; it counts as far up the neck as the vertex is.
    pub(super) neck: f32,
    pub(super) shoulder: f32,
    /// The joint halfway between chest and upper arm.
    pub(super) armpit: f32,
    pub(super) upper: f32,
    /// The share of the upper arm's rotation about its length.
    pub(super) upper_turn: f32,
    pub(super) elbow: f32,
    pub(super) fore: f32,
    pub(super) fore_turn: f32,
}

/// A vertex of the clothes.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClothVertex {
    pub(super) at: Vec3,
    pub(super) side: BodySide,
    /// The position along the arm, from the shoulder.
    pub(super) along: f32,
    /// The weight of the arm's own measures for its position.
    pub(super) arm: f32,
    pub(super) open: f32,
    pub(super) shares: FollowerShares,
    /// Whether it lies on the hem of the collar or of a sleeve.
    pub(super) hem: bool,
}

/// The canonical clothes.
#[derive(Debug)]
pub(super) struct CanonicalClothes {
    pub(super) cloths: Vec<ClothVertex>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl CanonicalClothes {
    /// Returns the clothes; built once.
    pub(super) fn shared_clothes() -> &'static Self {
        static BUILT_CLOTHES: OnceLock<CanonicalClothes> = OnceLock::new();
        BUILT_CLOTHES.get_or_init(|| ClothesMaker::new().make_clothes())
    }
}

const TRUNK_RING_COLUMNS: usize = 28;
/// Height, half width and half depth of the trunk's rings, from below.
const TRUNK_RING_MEASURES_MM: [[f32; 3]; 15] = [
    [-600.0, 158.0, 104.0],
    [-585.0, 163.0, 108.0],
    [-530.0, 164.0, 110.0],
    [-470.0, 158.0, 108.0],
    [-410.0, 148.0, 102.0],
    [-350.0, 140.0, 98.0],
    [-290.0, 140.0, 100.0],
    [-235.0, 144.0, 106.0],
    [-185.0, 149.0, 112.0],
    [-140.0, 152.0, 114.0],
    [-100.0, 154.0, 112.0],
    [-64.0, 156.0, 106.0],
    [-30.0, 156.0, 98.0],
    [4.0, 152.0, 86.0],
    [36.0, 140.0, 72.0],
];
/// Half the breadth and half the depth of the collar.
const COLLAR_MEASURES_MM: [f32; 2] = [58.0, 55.0];
/// The position of the collar's middle, forward; negative is backward.
pub(super) const COLLAR_BACK: f32 = -14.0;
/// The radius of the neck in that collar.
pub(super) const NECK_RADIUS_MM: f32 = 46.5;
/// The rows about an arm that have no faces: the hole for the arm.
const HOLE_ROWS: std::ops::Range<usize> = 10..14;
/// Positions of an arm's rings along it, with half their height and half their breadth.
const ARM_RING_MEASURES_MM: [[f32; 3]; 19] = [
    [44.0, 39.0, 45.0],
    [72.0, 42.0, 47.0],
    [100.0, 45.0, 48.0],
    [132.0, 47.5, 47.0],
    [168.0, 48.5, 45.5],
    [204.0, 47.0, 44.5],
    [236.0, 46.0, 44.5],
    [258.0, 45.0, 45.0],
    [275.0, 44.5, 46.0],
    [290.0, 44.5, 47.0],
    [305.0, 45.0, 47.5],
    [322.0, 46.0, 48.0],
    [345.0, 46.5, 48.0],
    [385.0, 45.0, 46.0],
    [425.0, 41.0, 42.0],
    [465.0, 36.5, 38.5],
    [500.0, 33.0, 36.5],
    [528.0, 31.0, 36.0],
    [541.0, 31.0, 36.5],
];

struct ClothesMaker {
    trunk: Vec<(Vec<BodySolid>, f32)>,
    arms: [Vec<BodySolid>; 2],
    cloths: Vec<ClothVertex>,
    triangles: Vec<[u32; 3]>,
}

impl ClothesMaker {
    fn new() -> Self {
        // Both sides are made from one list, so that the trunk is symmetric.
        let both = |solids: &[([f32; 3], [f32; 3], [f32; 2])], flat: f32| -> Vec<BodySolid> {
            let mirrored = |[x, y, z]: [f32; 3], sign: f32| [x * sign, y, z];
            let sides = [1.0, -1.0].into_iter();
            sides
                .flat_map(|sign| {
                    solids.iter().map(move |&(a, b, radii)| {
                        BodySolid::new_rod_solid(mirrored(a, sign), mirrored(b, sign), radii)
                            .flatten_rod_solid(Vec3::Z, flat)
                    })
                })
                .collect()
        };
        let trunk = vec![
            (
                both(&[([52.0, -90.0, 0.0], [46.0, -320.0, 2.0], [98.0, 90.0])], 1.14),
                40.0,
            ),
            (
                both(&[([44.0, -330.0, 0.0], [54.0, -540.0, -2.0], [90.0, 106.0])], 1.08),
                40.0,
            ),
            (
                vec![BodySolid::new_rod_solid(
                    [0.0, -120.0, 8.0],
                    [0.0, -320.0, 8.0],
                    [100.0, 90.0],
                )],
                40.0,
            ),
            (
                both(&[([132.0, -6.0, -8.0], [28.0, 66.0, -18.0], [37.0, 46.0])], 1.0),
                34.0,
            ),
            (
                vec![BodySolid::new_rod_solid(
                    [0.0, -60.0, 30.0],
                    [0.0, 56.0, -4.0],
                    [58.0, 46.0],
                )],
                34.0,
            ),
            // The upper back, from the nape to the shoulder blades.
            (
                both(&[([24.0, 62.0, -20.0], [56.0, -110.0, -4.0], [44.0, 84.0])], 1.0),
                34.0,
            ),
            (
                both(&[([56.0, -130.0, 36.0], [84.0, -70.0, 16.0], [62.0, 54.0])], 1.0),
                30.0,
            ),
        ];
        let arms = BodySide::BOTH_SIDES.map(|side| {
            let (from, along) = shoulder(side);
            let rod = |a: f32, b: f32, radii| {
                BodySolid::new_rod_solid((from + along * a).to_array(), (from + along * b).to_array(), radii)
            };
            vec![
                rod(0.0, 120.0, [40.0, 47.0]),
                rod(120.0, UPPER_ARM_LENGTH_MM, [47.0, 45.0]),
                rod(UPPER_ARM_LENGTH_MM, UPPER_ARM_LENGTH_MM + 70.0, [45.0, 47.0]),
                rod(
                    UPPER_ARM_LENGTH_MM + 70.0,
                    UPPER_ARM_LENGTH_MM + FOREARM_LENGTH_MM,
                    [47.0, 32.0],
                ),
            ]
        });
        Self {
            trunk,
            arms,
            cloths: Vec::new(),
            triangles: Vec::new(),
        }
    }

    fn clothes_distance(&self, point: Vec3) -> f32 {
        let mut all = f32::INFINITY;
        for (solids, width) in &self.trunk {
            all = join_solid_distances(all, blended_solid_distance(solids, *width, point), *width);
        }
        for arm in &self.arms {
            // Arms join the trunk over 30 mm, which makes the armpit round.
            all = join_solid_distances(all, blended_solid_distance(arm, 4.0, point), 30.0);
        }
        all
    }

    fn add_cloth_vertex(&mut self, at: Vec3) -> usize {
        let side = if at.x > 0.0 { BodySide::Left } else { BodySide::Right };
        self.cloths.push(ClothVertex {
            at,
            side,
            along: 0.0,
            arm: 0.0,
            open: 1.0,
            shares: FollowerShares::default(),
            hem: false,
        });
        self.cloths.len() - 1
    }

    fn add_clothes_tube(&mut self, a: &[usize], b: &[usize], hole: impl Fn(usize) -> bool) {
        let count = a.len();
        for k in (0..count).filter(|&k| !hole(k)) {
            let next = (k + 1) % count;
            let [p, q, r, s] = [a[k], a[next], b[next], b[k]].map(|i| i as u32);
            self.triangles.extend([[p, q, r], [p, r, s]]);
        }
    }

    fn make_clothes(mut self) -> CanonicalClothes {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        for [y, wide, deep] in TRUNK_RING_MEASURES_MM {
            let ring: Vec<Vec3> = circle_steps(TRUNK_RING_COLUMNS)
                .map(|[cosine, sine]| {
                    // A power below one makes rings squarer, as a trunk is.
                    let square = |v: f32| v.signum() * v.abs().powf(0.88);
                    Vec3::new(square(cosine) * wide, y, square(sine) * deep)
                })
                .map(|at| {
                    let on = on_skin(&|p| self.clothes_distance(p), at, 1.0);
                    // The lowest rings close the hem, beyond the implicit body.
                    if y < -560.0 { at } else { on }
                })
                .collect();
            rows.push(ring.into_iter().map(|at| self.add_cloth_vertex(at)).collect());
        }
        let collar: Vec<Vec3> = circle_steps(TRUNK_RING_COLUMNS)
            .map(|[cosine, sine]| {
                let low = sine.max(0.0);
                Vec3::new(
                    // The collar is lower at the throat than at the nape.
                    cosine * COLLAR_MEASURES_MM[0],
                    88.0 - 30.0 * low - 4.0 * sine.min(0.0),
                    sine * COLLAR_MEASURES_MM[1] + COLLAR_BACK,
                )
            })
            .collect();
        for share in [0.36, 0.70] {
            let below = rows[TRUNK_RING_MEASURES_MM.len() - 1].clone();
            let places: Vec<Vec3> = (0..TRUNK_RING_COLUMNS)
                .map(|k| {
                    let blended_place = self.cloths[below[k]].at.lerp(collar[k], share);
                    on_skin(&|p| self.clothes_distance(p), blended_place + Vec3::Y * 4.0, 1.0)
                })
                .collect();
            rows.push(places.into_iter().map(|at| self.add_cloth_vertex(at)).collect());
        }
        // The lowest two rings and the collar are fixed; those between may slide.
        let loose: Vec<usize> = rows[2..].iter().flatten().copied().collect();
        let rim: Vec<usize> = collar.iter().map(|&at| self.add_cloth_vertex(at)).collect();
        let lip: Vec<usize> = collar
            .iter()
            .map(|&at| {
                let inwards = Vec3::new(-at.x, 0.0, COLLAR_BACK - at.z).normalize_or(Vec3::Y);
                self.add_cloth_vertex(at + Vec3::Y * 7.0 + inwards * 3.0)
            })
            .collect();
        let inner: Vec<usize> = collar
            .iter()
            .map(|&at| {
                self.add_cloth_vertex(Vec3::new(
                    at.x * 0.7,
                    at.y - 22.0,
                    (at.z - COLLAR_BACK) * 0.7 + COLLAR_BACK,
                ))
            })
            .collect();
        // Hems are darker and follow the neck fully.
        for &index in rim.iter().chain(&lip).chain(&inner) {
            self.cloths[index].hem = true;
        }
        rows.extend([rim, lip, inner]);
        let hole = |column: usize, row: usize| {
            // Column 0 points to the left and half of the columns further to the right.
            let left = !(3..TRUNK_RING_COLUMNS - 3).contains(&column);
            let right = (TRUNK_RING_COLUMNS / 2 - 3..TRUNK_RING_COLUMNS / 2 + 3).contains(&column);
            HOLE_ROWS.contains(&row) && (left || right)
        };
        for row in 0..rows.len() - 1 {
            let (a, b) = (rows[row].clone(), rows[row + 1].clone());
            self.add_clothes_tube(&a, &b, |column| hole(column, row));
        }
        self.cap(&rows[0].clone(), Vec3::new(0.0, -590.0, 0.0), false);
        let top = rows[rows.len() - 1].clone();
        self.cap(&top, Vec3::new(0.0, 40.0, -12.0), true);
        let first_arm = self.cloths.len();
        for side in BodySide::BOTH_SIDES {
            self.add_sleeve(side, &rows);
        }
        // Weights depend on places, so that they come after the last movement.
        self.relax_clothes(&loose, first_arm);
        for index in 0..self.cloths.len() {
            self.weigh_cloth_vertex(index, index >= first_arm);
        }
        // The order of rings does not show which way triangles face.
        if self.clothes_volume() < 0.0 {
            for triangle in &mut self.triangles {
                triangle.swap(1, 2);
            }
        }
        self.compact()
    }

    fn cap(&mut self, ring: &[usize], at: Vec3, last: bool) {
        let pole = self.add_cloth_vertex(at) as u32;
        for k in 0..ring.len() {
            let [a, b] = [ring[k], ring[(k + 1) % ring.len()]].map(|i| i as u32);
            self.triangles.push(if last { [a, b, pole] } else { [b, a, pole] });
        }
    }

    fn add_sleeve(&mut self, side: BodySide, rows: &[Vec<usize>]) {
        let middle = if side == BodySide::Left {
            TRUNK_RING_COLUMNS
        } else {
            TRUNK_RING_COLUMNS / 2
        };
        let columns: Vec<usize> = (0..7).map(|k| (middle + k - 3) % TRUNK_RING_COLUMNS).collect();
        let (low, high) = (HOLE_ROWS.start, HOLE_ROWS.end);
        // The hole is walked once round: lower row, side, upper row back, other side.
        let mut hole: Vec<usize> = columns.iter().map(|&c| rows[low][c]).collect();
        hole.extend((low + 1..high).map(|row| rows[row][columns[6]]));
        hole.extend(columns.iter().rev().map(|&c| rows[high][c]));
        hole.extend((low + 1..high).rev().map(|row| rows[row][columns[0]]));
        let (from, along) = shoulder(side);
        let up = Vec3::Z.cross(along) * side.side_sign() as f32;
        let count = hole.len();
        let point = |[at, tall, wide]: [f32; 3], k: usize, back: bool, shift: usize| {
            let k = if back {
                (shift + count - k) % count
            } else {
                (shift + k) % count
            };
            let (sine, cosine) = (std::f32::consts::TAU * k as f32 / count as f32).sin_cos();
            // The back of the sleeve stands out over the tip of the elbow.
            let elbow = (-((at - UPPER_ARM_LENGTH_MM) / 22.0).powi(2)).exp() * 7.0 * (-sine).max(0.0);
            from + along * at + up * (cosine * tall) + Vec3::Z * (sine * (wide + elbow))
        };
        // The ring that is nearest to the hole, in either direction, meets it without a twist.
        let mut best = (f32::INFINITY, false, 0);
        for back in [false, true] {
            for shift in 0..count {
                let sum: f32 = (0..count)
                    .map(|k| {
                        self.cloths[hole[k]]
                            .at
                            .distance_squared(point(ARM_RING_MEASURES_MM[0], k, back, shift))
                    })
                    .sum();
                if sum < best.0 {
                    best = (sum, back, shift);
                }
            }
        }
        let (_, back, shift) = best;
        let mut before = hole;
        for (number, stop) in ARM_RING_MEASURES_MM.into_iter().enumerate() {
            let ring: Vec<usize> = (0..count)
                .map(|k| self.add_cloth_vertex(point(stop, k, back, shift)))
                .collect();
            for &index in &ring {
                self.cloths[index].side = side;
                self.cloths[index].hem = number + 1 == ARM_RING_MEASURES_MM.len();
            }
            self.add_clothes_tube(&before, &ring, |_| false);
            before = ring;
        }
        let [at, tall, wide] = ARM_RING_MEASURES_MM[ARM_RING_MEASURES_MM.len() - 1];
        // A last ring within the sleeve hides its inside.
        let inside = [at - 14.0, tall * 0.8, wide * 0.8];
        let ring: Vec<usize> = (0..count)
            .map(|k| self.add_cloth_vertex(point(inside, k, back, shift)))
            .collect();
        self.add_clothes_tube(&before, &ring, |_| false);
        self.cap(&ring, from + along * (at - 20.0), true);
        let end = self.cloths.len();
        for index in ring[0]..end {
            self.cloths[index].side = side;
        }
    }

    fn cloth_neighbours(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new(); self.cloths.len()];
        for triangle in &self.triangles {
            for k in 0..3 {
                all[triangle[k] as usize].push(triangle[(k + 1) % 3] as usize);
            }
        }
        all
    }

    fn relax_clothes(&mut self, loose: &[usize], first_arm: usize) {
        let neighbours = self.cloth_neighbours();
        let mut loose = loose.to_vec();
        // Twenty vertices for each ring and the inner one, and the pole.
        let of_arm = 20 * ARM_RING_MEASURES_MM.len() + 21;
        for side in 0..2 {
            // The two rings next to the shoulder slide too, so that trunk and sleeve meet smoothly.
            loose.extend(first_arm + side * of_arm..first_arm + side * of_arm + 40);
        }
        loose.retain(|&index| !neighbours[index].is_empty());
        for _ in 0..24 {
            let places: Vec<Vec3> = loose
                .iter()
                .map(|&index| {
                    let around = &neighbours[index];
                    let mean = around.iter().map(|&n| self.cloths[n].at).sum::<Vec3>() / around.len() as f32;
                    let to = self.cloths[index].at.lerp(mean, 0.5);
                    on_skin(&|p| self.clothes_distance(p), to, 1.0)
                })
                .collect();
            for (&index, at) in loose.iter().zip(places) {
                self.cloths[index].at = at;
            }
        }
    }

    fn weigh_cloth_vertex(&mut self, index: usize, of_arm: bool) {
        let cloth = self.cloths[index];
        let (from, along) = shoulder(cloth.side);
        let s = (cloth.at - from).dot(along);
        let off = (cloth.at - from - along * s).length();
        // Trunk vertices far from the arm's axis do not move with it, however far out they are.
        let fade = 1.0 - smooth_step((off - 66.0) / 60.0);
        let t = ((s + 50.0) / 150.0).clamp(0.0, 1.0);
        let rising = if of_arm { 1.0 } else { fade };
        let arm = (2.0 * t - 1.0).max(0.0) * rising;
        let armpit = (1.0 - (2.0 * t - 1.0).abs()) * rising;
        let rest = 1.0 - arm - armpit;
        let near = 1.0 - smooth_step((cloth.at.distance(from) - 45.0) / 130.0);
        let up = smooth_step((cloth.at.y + 430.0) / 270.0);
        // The trunk beside the arm has the measures of the shoulder, not of places further along.
        let s = if of_arm { s } else { s.min(60.0) };
        let e = ((s - UPPER_ARM_LENGTH_MM + 46.0) / 92.0).clamp(0.0, 1.0);
        let (elbow, fore) = (1.0 - (2.0 * e - 1.0).abs(), (2.0 * e - 1.0).max(0.0));
        let upper = (1.0 - 2.0 * e).max(0.0);
        let normal = field_slope(&|p| self.clothes_distance(p), cloth.at, 2.0);
        let mut dark = 0.0;
        for step in 1..=4 {
            let far = step as f32 * 14.0;
            dark += (far - self.clothes_distance(cloth.at + normal * far)).max(0.0) / 14.0 * 0.5f32.powi(step);
        }
        let hem = smooth_step((-cloth.at.y - 470.0) / 110.0) * 0.85;
        let left = smooth_step((cloth.at.x + 50.0) / 100.0);
        let neck = match cloth.hem {
            // The collar moves with the neck as a whole; sleeve hems do not.
            true if !of_arm => 1.0,
            _ => smooth_step((cloth.at.y - 22.0) / 40.0),
        };
        let cloth = &mut self.cloths[index];
        cloth.along = if of_arm { s } else { s.min(60.0) };
        cloth.arm = smooth_step((s - 10.0) / 90.0) * rising;
        // Beyond the shoulder no other part is near enough to take light away.
        cloth.open = if s > 150.0 {
            1.0
        } else {
            (1.0 - 0.30 * dark).clamp(0.72, 1.0)
        };
        cloth.shares = FollowerShares {
            pelvis: rest * (1.0 - near) * (1.0 - up),
            chest: rest * (1.0 - near) * up,
            thighs: [hem * (1.0 - left), hem * left],
            neck: if of_arm { 0.0 } else { neck },
            shoulder: rest * near,
            armpit,
            upper: arm * upper,
            upper_turn: ((s - 40.0) / (UPPER_ARM_LENGTH_MM - 80.0)).clamp(0.0, 1.0),
            elbow: arm * elbow,
            fore: arm * fore,
            fore_turn: ((s - UPPER_ARM_LENGTH_MM) / FOREARM_LENGTH_MM - 0.1).clamp(0.0, 0.9) / 0.9,
        };
    }

    fn clothes_volume(&self) -> f32 {
        let corner = |i: u32| self.cloths[i as usize].at;
        let sixth = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0;
        self.triangles.iter().map(sixth).sum()
    }

    /// Returns the clothes without unused vertices.
    fn compact(self) -> CanonicalClothes {
        let mut numbers = vec![u32::MAX; self.cloths.len()];
        let mut cloths = Vec::new();
        let mut triangles = self.triangles;
        for index in triangles.iter_mut().flatten() {
            let old = *index as usize;
            if numbers[old] == u32::MAX {
                numbers[old] = cloths.len() as u32;
                cloths.push(self.cloths[old]);
            }
            *index = numbers[old];
        }
        CanonicalClothes { cloths, triangles }
    }
}

fn shoulder(side: BodySide) -> (Vec3, Vec3) {
    let sign = side.side_sign() as f32;
    (Vec3::X * SHOULDER_HALF_WIDTH_MM * sign, arm_direction(side))
}

/// Returns cosines and sines of `count` even steps around a circle.
fn circle_steps(count: usize) -> impl Iterator<Item = [f32; 2]> {
    (0..count).map(move |k| {
        let (sine, cosine) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        [cosine as f32, sine as f32]
    })
}
