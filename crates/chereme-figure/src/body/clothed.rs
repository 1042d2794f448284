//! The canonical trunk with both arms in clothes: rings projected onto an implicit body, one closed surface.
//!
//! Millimetres in bind space: x to the signer's left, y up, z forwards, the origin between the shoulder joints.
//! Measures follow ANSUR II (Gordon et al. 2014, NATICK/TR-15/007), means of men.

use std::sync::OnceLock;

use chereme_motion::Side;
use glam::Vec3;

use super::solids::{Solid, grown, joined, on_skin, slope, smooth_step};
use super::trunk::arm_direction;

/// Half of the distance between the shoulder joints.
pub(super) const SHOULDER: f32 = 172.0;
/// The length of the trunk.
pub(super) const TRUNK: f32 = 500.0;
/// The length of the upper arm.
pub(super) const UPPER: f32 = 290.0;
/// The length of the forearm.
pub(super) const FORE: f32 = 245.0;

/// The shares of the followers that move a vertex of the clothes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shares {
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
pub(super) struct Cloth {
    pub(super) at: Vec3,
    pub(super) side: Side,
    /// The position along the arm, from the shoulder.
    pub(super) along: f32,
    /// The weight of the arm's own measures for its position.
    pub(super) arm: f32,
    pub(super) open: f32,
    pub(super) shares: Shares,
    /// Whether it lies on the hem of the collar or of a sleeve.
    pub(super) hem: bool,
}

/// The canonical clothes.
#[derive(Debug)]
pub(super) struct Clothed {
    pub(super) cloths: Vec<Cloth>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Clothed {
    /// Returns the clothes; built once.
    pub(super) fn get() -> &'static Self {
        static CLOTHED: OnceLock<Clothed> = OnceLock::new();
        CLOTHED.get_or_init(|| Maker::new().make())
    }
}

const COLUMNS: usize = 28;
/// Height, half width and half depth of the trunk's rings, from below.
const ROWS: [[f32; 3]; 15] = [
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
const COLLAR: [f32; 2] = [58.0, 55.0];
/// The position of the collar's middle, forward; negative is backward.
pub(super) const COLLAR_BACK: f32 = -14.0;
/// The radius of the neck in that collar.
pub(super) const NECK: f32 = 46.5;
/// The rows about an arm that have no faces: the hole for the arm.
const HOLE_ROWS: std::ops::Range<usize> = 10..14;
/// Positions of an arm's rings along it, with half their height and half their breadth.
const ARM: [[f32; 3]; 19] = [
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

struct Maker {
    trunk: Vec<(Vec<Solid>, f32)>,
    arms: [Vec<Solid>; 2],
    cloths: Vec<Cloth>,
    triangles: Vec<[u32; 3]>,
}

impl Maker {
    fn new() -> Self {
        let both = |solids: &[([f32; 3], [f32; 3], [f32; 2])], flat: f32| -> Vec<Solid> {
            let mirrored = |[x, y, z]: [f32; 3], sign: f32| [x * sign, y, z];
            let sides = [1.0, -1.0].into_iter();
            sides
                .flat_map(|sign| {
                    solids.iter().map(move |&(a, b, radii)| {
                        Solid::rod(mirrored(a, sign), mirrored(b, sign), radii).flat(Vec3::Z, flat)
                    })
                })
                .collect()
        };
        let trunk = vec![
            (
                both(
                    &[([52.0, -90.0, 0.0], [46.0, -320.0, 2.0], [98.0, 90.0])],
                    1.14,
                ),
                40.0,
            ),
            (
                both(
                    &[([44.0, -330.0, 0.0], [54.0, -540.0, -2.0], [90.0, 106.0])],
                    1.08,
                ),
                40.0,
            ),
            (
                vec![Solid::rod(
                    [0.0, -120.0, 8.0],
                    [0.0, -320.0, 8.0],
                    [100.0, 90.0],
                )],
                40.0,
            ),
            (
                both(
                    &[([132.0, -6.0, -8.0], [28.0, 66.0, -18.0], [37.0, 46.0])],
                    1.0,
                ),
                34.0,
            ),
            (
                vec![Solid::rod(
                    [0.0, -60.0, 30.0],
                    [0.0, 56.0, -4.0],
                    [58.0, 46.0],
                )],
                34.0,
            ),
            // The upper back, from the nape to the shoulder blades.
            (
                both(
                    &[([24.0, 62.0, -20.0], [56.0, -110.0, -4.0], [44.0, 84.0])],
                    1.0,
                ),
                34.0,
            ),
            (
                both(
                    &[([56.0, -130.0, 36.0], [84.0, -70.0, 16.0], [62.0, 54.0])],
                    1.0,
                ),
                30.0,
            ),
        ];
        let arms = Side::BOTH.map(|side| {
            let (from, along) = shoulder(side);
            let rod = |a: f32, b: f32, radii| {
                Solid::rod(
                    (from + along * a).to_array(),
                    (from + along * b).to_array(),
                    radii,
                )
            };
            vec![
                rod(0.0, 120.0, [40.0, 47.0]),
                rod(120.0, UPPER, [47.0, 45.0]),
                rod(UPPER, UPPER + 70.0, [45.0, 47.0]),
                rod(UPPER + 70.0, UPPER + FORE, [47.0, 32.0]),
            ]
        });
        Self {
            trunk,
            arms,
            cloths: Vec::new(),
            triangles: Vec::new(),
        }
    }

    fn whole(&self, point: Vec3) -> f32 {
        let mut all = f32::INFINITY;
        for (solids, width) in &self.trunk {
            all = joined(all, grown(solids, *width, point), *width);
        }
        for arm in &self.arms {
            all = joined(all, grown(arm, 4.0, point), 30.0);
        }
        all
    }

    fn add(&mut self, at: Vec3) -> usize {
        let side = if at.x > 0.0 { Side::Left } else { Side::Right };
        self.cloths.push(Cloth {
            at,
            side,
            along: 0.0,
            arm: 0.0,
            open: 1.0,
            shares: Shares::default(),
            hem: false,
        });
        self.cloths.len() - 1
    }

    fn tube(&mut self, a: &[usize], b: &[usize], hole: impl Fn(usize) -> bool) {
        let count = a.len();
        for k in (0..count).filter(|&k| !hole(k)) {
            let next = (k + 1) % count;
            let [p, q, r, s] = [a[k], a[next], b[next], b[k]].map(|i| i as u32);
            self.triangles.extend([[p, q, r], [p, r, s]]);
        }
    }

    fn make(mut self) -> Clothed {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        for [y, wide, deep] in ROWS {
            let ring: Vec<Vec3> = circle(COLUMNS)
                .map(|[cosine, sine]| {
                    let square = |v: f32| v.signum() * v.abs().powf(0.88);
                    Vec3::new(square(cosine) * wide, y, square(sine) * deep)
                })
                .map(|at| {
                    let on = on_skin(&|p| self.whole(p), at, 1.0);
                    if y < -560.0 { at } else { on }
                })
                .collect();
            rows.push(ring.into_iter().map(|at| self.add(at)).collect());
        }
        let collar: Vec<Vec3> = circle(COLUMNS)
            .map(|[cosine, sine]| {
                let low = sine.max(0.0);
                Vec3::new(
                    cosine * COLLAR[0],
                    88.0 - 30.0 * low - 4.0 * sine.min(0.0),
                    sine * COLLAR[1] + COLLAR_BACK,
                )
            })
            .collect();
        for share in [0.36, 0.70] {
            let below = rows[ROWS.len() - 1].clone();
            let places: Vec<Vec3> = (0..COLUMNS)
                .map(|k| {
                    let at = self.cloths[below[k]].at.lerp(collar[k], share);
                    on_skin(&|p| self.whole(p), at + Vec3::Y * 4.0, 1.0)
                })
                .collect();
            rows.push(places.into_iter().map(|at| self.add(at)).collect());
        }
        let loose: Vec<usize> = rows[2..].iter().flatten().copied().collect();
        let rim: Vec<usize> = collar.iter().map(|&at| self.add(at)).collect();
        let lip: Vec<usize> = collar
            .iter()
            .map(|&at| {
                let inwards = Vec3::new(-at.x, 0.0, COLLAR_BACK - at.z).normalize_or(Vec3::Y);
                self.add(at + Vec3::Y * 7.0 + inwards * 3.0)
            })
            .collect();
        let inner: Vec<usize> = collar
            .iter()
            .map(|&at| {
                self.add(Vec3::new(
                    at.x * 0.7,
                    at.y - 22.0,
                    (at.z - COLLAR_BACK) * 0.7 + COLLAR_BACK,
                ))
            })
            .collect();
        for &index in rim.iter().chain(&lip).chain(&inner) {
            self.cloths[index].hem = true;
        }
        rows.extend([rim, lip, inner]);
        let hole = |column: usize, row: usize| {
            let left = !(3..COLUMNS - 3).contains(&column);
            let right = (COLUMNS / 2 - 3..COLUMNS / 2 + 3).contains(&column);
            HOLE_ROWS.contains(&row) && (left || right)
        };
        for row in 0..rows.len() - 1 {
            let (a, b) = (rows[row].clone(), rows[row + 1].clone());
            self.tube(&a, &b, |column| hole(column, row));
        }
        self.cap(&rows[0].clone(), Vec3::new(0.0, -590.0, 0.0), false);
        let top = rows[rows.len() - 1].clone();
        self.cap(&top, Vec3::new(0.0, 40.0, -12.0), true);
        let first_arm = self.cloths.len();
        for side in Side::BOTH {
            self.arm(side, &rows);
        }
        self.relax(&loose, first_arm);
        for index in 0..self.cloths.len() {
            self.weigh(index, index >= first_arm);
        }
        if self.volume() < 0.0 {
            for triangle in &mut self.triangles {
                triangle.swap(1, 2);
            }
        }
        self.compact()
    }

    fn cap(&mut self, ring: &[usize], at: Vec3, last: bool) {
        let pole = self.add(at) as u32;
        for k in 0..ring.len() {
            let [a, b] = [ring[k], ring[(k + 1) % ring.len()]].map(|i| i as u32);
            self.triangles
                .push(if last { [a, b, pole] } else { [b, a, pole] });
        }
    }

    fn arm(&mut self, side: Side, rows: &[Vec<usize>]) {
        let middle = if side == Side::Left {
            COLUMNS
        } else {
            COLUMNS / 2
        };
        let columns: Vec<usize> = (0..7).map(|k| (middle + k - 3) % COLUMNS).collect();
        let (low, high) = (HOLE_ROWS.start, HOLE_ROWS.end);
        let mut hole: Vec<usize> = columns.iter().map(|&c| rows[low][c]).collect();
        hole.extend((low + 1..high).map(|row| rows[row][columns[6]]));
        hole.extend(columns.iter().rev().map(|&c| rows[high][c]));
        hole.extend((low + 1..high).rev().map(|row| rows[row][columns[0]]));
        let (from, along) = shoulder(side);
        let up = Vec3::Z.cross(along) * side.sign() as f32;
        let count = hole.len();
        let point = |[at, tall, wide]: [f32; 3], k: usize, back: bool, shift: usize| {
            let k = if back {
                (shift + count - k) % count
            } else {
                (shift + k) % count
            };
            let (sine, cosine) = (std::f32::consts::TAU * k as f32 / count as f32).sin_cos();
            let elbow = (-((at - UPPER) / 22.0).powi(2)).exp() * 7.0 * (-sine).max(0.0);
            from + along * at + up * (cosine * tall) + Vec3::Z * (sine * (wide + elbow))
        };
        let mut best = (f32::INFINITY, false, 0);
        for back in [false, true] {
            for shift in 0..count {
                let sum: f32 = (0..count)
                    .map(|k| {
                        self.cloths[hole[k]]
                            .at
                            .distance_squared(point(ARM[0], k, back, shift))
                    })
                    .sum();
                if sum < best.0 {
                    best = (sum, back, shift);
                }
            }
        }
        let (_, back, shift) = best;
        let mut before = hole;
        for (number, stop) in ARM.into_iter().enumerate() {
            let ring: Vec<usize> = (0..count)
                .map(|k| self.add(point(stop, k, back, shift)))
                .collect();
            for &index in &ring {
                self.cloths[index].side = side;
                self.cloths[index].hem = number + 1 == ARM.len();
            }
            self.tube(&before, &ring, |_| false);
            before = ring;
        }
        let [at, tall, wide] = ARM[ARM.len() - 1];
        let inside = [at - 14.0, tall * 0.8, wide * 0.8];
        let ring: Vec<usize> = (0..count)
            .map(|k| self.add(point(inside, k, back, shift)))
            .collect();
        self.tube(&before, &ring, |_| false);
        self.cap(&ring, from + along * (at - 20.0), true);
        let end = self.cloths.len();
        for index in ring[0]..end {
            self.cloths[index].side = side;
        }
    }

    fn neighbours(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new(); self.cloths.len()];
        for triangle in &self.triangles {
            for k in 0..3 {
                all[triangle[k] as usize].push(triangle[(k + 1) % 3] as usize);
            }
        }
        all
    }

    fn relax(&mut self, loose: &[usize], first_arm: usize) {
        let neighbours = self.neighbours();
        let mut loose = loose.to_vec();
        let of_arm = 20 * ARM.len() + 21;
        for side in 0..2 {
            loose.extend(first_arm + side * of_arm..first_arm + side * of_arm + 40);
        }
        loose.retain(|&index| !neighbours[index].is_empty());
        for _ in 0..24 {
            let places: Vec<Vec3> = loose
                .iter()
                .map(|&index| {
                    let around = &neighbours[index];
                    let mean = around.iter().map(|&n| self.cloths[n].at).sum::<Vec3>()
                        / around.len() as f32;
                    let to = self.cloths[index].at.lerp(mean, 0.5);
                    on_skin(&|p| self.whole(p), to, 1.0)
                })
                .collect();
            for (&index, at) in loose.iter().zip(places) {
                self.cloths[index].at = at;
            }
        }
    }

    fn weigh(&mut self, index: usize, of_arm: bool) {
        let cloth = self.cloths[index];
        let (from, along) = shoulder(cloth.side);
        let s = (cloth.at - from).dot(along);
        let off = (cloth.at - from - along * s).length();
        let fade = 1.0 - smooth_step((off - 66.0) / 60.0);
        let t = ((s + 50.0) / 150.0).clamp(0.0, 1.0);
        let rising = if of_arm { 1.0 } else { fade };
        let arm = (2.0 * t - 1.0).max(0.0) * rising;
        let armpit = (1.0 - (2.0 * t - 1.0).abs()) * rising;
        let rest = 1.0 - arm - armpit;
        let near = 1.0 - smooth_step((cloth.at.distance(from) - 45.0) / 130.0);
        let up = smooth_step((cloth.at.y + 430.0) / 270.0);
        let s = if of_arm { s } else { s.min(60.0) };
        let e = ((s - UPPER + 46.0) / 92.0).clamp(0.0, 1.0);
        let (elbow, fore) = (1.0 - (2.0 * e - 1.0).abs(), (2.0 * e - 1.0).max(0.0));
        let upper = (1.0 - 2.0 * e).max(0.0);
        let normal = slope(&|p| self.whole(p), cloth.at, 2.0);
        let mut dark = 0.0;
        for step in 1..=4 {
            let far = step as f32 * 14.0;
            dark += (far - self.whole(cloth.at + normal * far)).max(0.0) / 14.0 * 0.5f32.powi(step);
        }
        let hem = smooth_step((-cloth.at.y - 470.0) / 110.0) * 0.85;
        let left = smooth_step((cloth.at.x + 50.0) / 100.0);
        let neck = match cloth.hem {
            true if !of_arm => 1.0,
            _ => smooth_step((cloth.at.y - 22.0) / 40.0),
        };
        let cloth = &mut self.cloths[index];
        cloth.along = if of_arm { s } else { s.min(60.0) };
        cloth.arm = smooth_step((s - 10.0) / 90.0) * rising;
        cloth.open = if s > 150.0 {
            1.0
        } else {
            (1.0 - 0.30 * dark).clamp(0.72, 1.0)
        };
        cloth.shares = Shares {
            pelvis: rest * (1.0 - near) * (1.0 - up),
            chest: rest * (1.0 - near) * up,
            thighs: [hem * (1.0 - left), hem * left],
            neck: if of_arm { 0.0 } else { neck },
            shoulder: rest * near,
            armpit,
            upper: arm * upper,
            upper_turn: ((s - 40.0) / (UPPER - 80.0)).clamp(0.0, 1.0),
            elbow: arm * elbow,
            fore: arm * fore,
            fore_turn: ((s - UPPER) / FORE - 0.1).clamp(0.0, 0.9) / 0.9,
        };
    }

    fn volume(&self) -> f32 {
        let corner = |i: u32| self.cloths[i as usize].at;
        let sixth = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0;
        self.triangles.iter().map(sixth).sum()
    }

    /// Returns the clothes without unused vertices.
    fn compact(self) -> Clothed {
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
        Clothed { cloths, triangles }
    }
}

fn shoulder(side: Side) -> (Vec3, Vec3) {
    let sign = side.sign() as f32;
    (Vec3::X * SHOULDER * sign, arm_direction(side))
}

/// Returns cosines and sines of `count` even steps around a circle.
fn circle(count: usize) -> impl Iterator<Item = [f32; 2]> {
    (0..count).map(move |k| {
        let (sine, cosine) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        [cosine as f32, sine as f32]
    })
}
