//! The canonical right hand: a fixed net of vertices projected onto an implicit hand, with skin weights.
//!
//! Millimetres; x towards the thumb, y along the hand, z out of the palm, the wrist at the origin. Thirty-six columns
//! run around the palm and twelve around each digit, so that the roots of fingers need no extra vertices. Measures
//! follow Buryanov and Kotiuk 2010 (Int. J. Morphol. 28(3), table I).

use std::sync::OnceLock;

use chereme_motion::{FingerAngles, HandAngles, ThumbAngles};
use glam::{Mat3, Quat, Vec3};

use super::solids::{BodySolid, blended_solid_distance, cast_skin_ray, join_solid_distances, on_skin};

/// The number of bones of the canonical hand: the palm, and three of each digit.
pub(super) const HAND_BONE_COUNT: usize = 16;
/// The bone of the palm.
pub(super) const PALM_BONE: usize = 0;
/// The first index of joints halfway between a bone and its parent.
pub(super) const FIRST_HALF_JOINT: usize = 16;
/// The index of the forearm at the wrist, which rotates with the hand.
pub(super) const CUFF_FOLLOWER: usize = 32;
/// The bones inside the palm of ring and little finger.
pub(super) const PALM_ARCH_BONES: [usize; 2] = [33, 34];
/// The number of all followers of a hand.
pub(super) const HAND_FOLLOWER_COUNT: usize = 35;

/// Returns the bone of a digit: 0 the thumb to 4 the little finger, and its place from 0 to 2.
pub(super) const fn digit_bone_index(digit: usize, place: usize) -> usize {
    1 + digit * 3 + place
}

/// A vertex of the hand: its digit, its shade, and its followers.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandVertex {
    pub(super) place: Vec3,
    /// The digit, or `None` for the palm.
    pub(super) digit: Option<usize>,
    /// 0 on the back to 1 on the palm's side.
    pub(super) palmar: f32,
    /// The share of light that reaches it; 1 if nothing is near.
    pub(super) open: f32,
    pub(super) nail: f32,
    /// Followers with weights that sum to one.
    pub(super) weights: [(usize, f32); 4],
}

/// A bone in the posture in which the canonical hand is built.
#[derive(Debug, Clone, Copy)]
pub(super) struct CanonicalHandBone {
    pub(super) from: Vec3,
    pub(super) to: Vec3,
    /// The side, the bone's direction, and the direction of its inner surface.
    pub(super) axes: Mat3,
}

/// The canonical hand.
#[derive(Debug)]
pub(super) struct CanonicalHand {
    pub(super) skins: Vec<HandVertex>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) bones: [CanonicalHandBone; HAND_BONE_COUNT],
}

/// The base of each finger across and along the hand, and the lengths of its bones.
const FINGER_BONE_MEASURES_MM: [([f32; 2], [f32; 3]); 4] = [
    ([30.0, 88.0], [43.0, 25.0, 22.0]),
    ([9.5, 91.0], [47.0, 29.0, 23.0]),
    ([-11.0, 86.0], [43.0, 27.0, 23.0]),
    ([-30.0, 78.0], [34.0, 20.0, 20.0]),
];
pub(super) const THUMB_BONE_MEASURES_MM: (Vec3, [f32; 3]) = (Vec3::new(23.0, 22.0, 8.0), [44.8, 33.0, 26.1]);
/// Radii at base, middle, joint, middle, joint, middle, tip, from thumb to little finger.
pub(super) const DIGIT_RADII_MM: [[f32; 7]; 5] = [
    [12.6, 10.8, 10.4, 9.9, 10.0, 9.0, 7.0],
    [11.0, 9.3, 9.3, 8.1, 8.0, 7.6, 6.3],
    [11.3, 9.6, 9.6, 8.4, 8.2, 7.8, 6.5],
    [10.7, 9.0, 9.0, 7.8, 7.7, 7.3, 6.1],
    [9.8, 7.8, 7.8, 6.8, 6.7, 6.4, 5.3],
];
/// Directions of the vertices around a finger in degrees: 0 towards the thumb, 90 out of the palm.
const FINGER_RIM_DEGREES: [f32; 12] = [
    0.0, 38.0, 62.0, 90.0, 118.0, 142.0, 180.0, 218.0, 242.0, 270.0, 298.0, 322.0,
];
/// The spread of each finger in the posture in which the hand is built, in degrees; fingers that touched would grow
/// together.
const BUILT_FINGER_SPREAD_DEGREES: [f32; 4] = [11.0, 2.0, -7.0, -16.0];
/// The bend of each finger's joints in that posture, from its base on, in degrees.
const BUILT_FINGER_BEND_DEGREES: [f32; 3] = [6.0, 6.0, 4.0];
/// The thumb in that posture, in degrees: radial, palmar, opposition, and the bend of its middle and end joints.
const THUMB_ANGLES: [f32; 5] = [42.0, 24.0, 10.0, 4.0, 4.0];

impl CanonicalHand {
    /// Returns the hand; built once.
    pub(super) fn shared_hand() -> &'static Self {
        static BUILT_HAND: OnceLock<CanonicalHand> = OnceLock::new();
        BUILT_HAND.get_or_init(|| HandMaker::new().make_hand())
    }

    /// Returns the posture in which the hand is built, as joint angles.
    pub(super) fn built_hand_angles() -> HandAngles {
        let radians = |degrees: f32| f64::from(degrees).to_radians();
        let [radial, palmar, opposition, middle, end] = THUMB_ANGLES.map(radians);
        HandAngles {
            thumb: ThumbAngles {
                radial,
                palmar,
                opposition,
                flexion: [middle, end],
            },
            fingers: BUILT_FINGER_SPREAD_DEGREES.map(|spread| FingerAngles {
                spread: radians(spread),
                flexion: BUILT_FINGER_BEND_DEGREES.map(radians),
            }),
        }
    }
}

/// Returns the directions of the thumb's bones, and of the pad on each.
fn thumb_axes() -> [[Vec3; 2]; 3] {
    let [radial, palmar, opposition, middle, end] = THUMB_ANGLES.map(f32::to_radians);
    let turn = Quat::from_axis_angle(Vec3::NEG_Z, radial)
        * Quat::from_axis_angle(Vec3::X, palmar)
        * Quat::from_axis_angle(Vec3::Y, -opposition);
    let across = |angle: f32| Quat::from_axis_angle(Vec3::NEG_Z, -angle);
    let turns = [turn, turn * across(middle), turn * across(middle + end)];
    // The thumb's pad faces across the palm, while a finger's faces out of it.
    turns.map(|turn| [turn * Vec3::Y, turn * Vec3::NEG_X])
}

/// Returns the rotation from the y axis to the line from the wrist to the middle finger's base, to which joint angles
/// are relative.
fn tilt() -> Quat {
    let [x, y] = FINGER_BONE_MEASURES_MM[1].0;
    Quat::from_rotation_arc(Vec3::Y, Vec3::new(x, y, 0.0).normalize())
}

fn canonical_hand_bones() -> [CanonicalHandBone; HAND_BONE_COUNT] {
    let frame = |from: Vec3, along: Vec3, pad: Vec3, length: f32| {
        let pad = (pad - along * along.dot(pad)).normalize_or(Vec3::Z);
        CanonicalHandBone {
            from,
            to: from + along * length,
            axes: Mat3::from_cols(along.cross(pad), along, pad),
        }
    };
    let tilt = tilt();
    let mut all = [frame(Vec3::ZERO, tilt * Vec3::Y, Vec3::Z, 91.5); HAND_BONE_COUNT];
    let mut bone_start = THUMB_BONE_MEASURES_MM.0;
    for (place, [along, pad]) in thumb_axes().into_iter().enumerate() {
        all[digit_bone_index(0, place)] = frame(bone_start, tilt * along, tilt * pad, THUMB_BONE_MEASURES_MM.1[place]);
        bone_start = all[digit_bone_index(0, place)].to;
    }
    for (finger, ([x, y], lengths)) in FINGER_BONE_MEASURES_MM.into_iter().enumerate() {
        let mut at = Vec3::new(x, y, 0.0);
        let mut bent = 0.0;
        for place in 0..3 {
            bent += BUILT_FINGER_BEND_DEGREES[place];
            let first = Quat::from_axis_angle(Vec3::X, BUILT_FINGER_BEND_DEGREES[0].to_radians());
            let fan = Quat::from_axis_angle(Vec3::NEG_Z, BUILT_FINGER_SPREAD_DEGREES[finger].to_radians());
            let rest = Quat::from_axis_angle(Vec3::X, (bent - BUILT_FINGER_BEND_DEGREES[0]).to_radians());
            let turn = tilt * first * fan * rest;
            all[digit_bone_index(finger + 1, place)] = frame(at, turn * Vec3::Y, turn * Vec3::Z, lengths[place]);
            at = all[digit_bone_index(finger + 1, place)].to;
        }
    }
    all
}

/// A canonical hand under construction.
pub(super) struct HandMaker {
    pub(super) bones: [CanonicalHandBone; HAND_BONE_COUNT],
    digits: [Vec<BodySolid>; 5],
    palm: Vec<(Vec<BodySolid>, f32)>,
    pub(super) skins: Vec<HandVertex>,
    triangles: Vec<[u32; 3]>,
    /// Vertices that are spread evenly over the palm.
    loose: Vec<usize>,
}

impl HandMaker {
    fn new() -> Self {
        let bones = canonical_hand_bones();
        let digits = std::array::from_fn(|digit| digit_solids(&bones, digit));
        Self {
            palm: palm_solids(&bones),
            bones,
            digits,
            skins: Vec::new(),
            triangles: Vec::new(),
            loose: Vec::new(),
        }
    }

    fn digit_distance(&self, digit: usize, point: Vec3) -> f32 {
        blended_solid_distance(&self.digits[digit], 2.0, point)
    }

    pub(super) fn whole_hand_distance(&self, point: Vec3) -> f32 {
        let mut palm = f32::INFINITY;
        for (solids, width) in &self.palm {
            palm = join_solid_distances(palm, blended_solid_distance(solids, *width, point), *width);
        }
        let palm = join_solid_distances(palm, self.digit_distance(0, point), 5.0);
        // Fingers never blend with each other: neighbours that touch would grow together.
        (1..5).fold(palm, |all, digit| {
            all.min(join_solid_distances(palm, self.digit_distance(digit, point), 3.5))
        })
    }

    /// Returns the distance of a point from a somewhat swollen palm without a thumb.
    fn bare_palm_distance(&self, point: Vec3) -> f32 {
        // The last two groups are the ball of the thumb and its web, which have vertices of their own.
        let palm = self.palm[..4].iter().fold(f32::INFINITY, |palm, (solids, width)| {
            join_solid_distances(palm, blended_solid_distance(solids, *width, point), *width)
        });
        (1..5).fold(palm, |all, digit| {
            all.min(join_solid_distances(palm, self.digit_distance(digit, point), 3.5))
        }) - 2.0
    }

    fn add_hand_vertex(&mut self, place: Vec3, digit: Option<usize>) -> usize {
        self.skins.push(HandVertex {
            place,
            digit,
            palmar: 0.0,
            open: 1.0,
            nail: 0.0,
            weights: [(PALM_BONE, 0.0); 4],
        });
        self.skins.len() - 1
    }

    fn add_hand_tube(&mut self, a: &[usize], b: &[usize]) {
        let count = a.len();
        for k in 0..count {
            let next = (k + 1) % count;
            let [p, q, r, s] = [a[k], a[next], b[next], b[k]].map(|i| i as u32);
            self.triangles.extend([[p, q, r], [p, r, s]]);
        }
    }

    fn make_hand(mut self) -> CanonicalHand {
        let bases = self.add_finger_bases();
        let rings = self.palm_rings(&bases);
        let thumb = self.thumb_hole(&rings);
        let mut digit_rings: Vec<(usize, Vec<usize>)> = vec![(0, thumb)];
        digit_rings.extend(bases.iter().cloned().enumerate().map(|(f, ring)| (f + 1, ring)));
        let pins = self.skins.len();
        for (digit, base) in digit_rings {
            self.digit_rings(digit, base);
        }
        self.relax_palm_vertices(pins);
        self.assign_skin_weights();
        self.colour_glove_skin();
        // The order of rings does not say which way triangles face; the sign of the volume does.
        if self.hand_volume() < 0.0 {
            for triangle in &mut self.triangles {
                triangle.swap(1, 2);
            }
        }
        CanonicalHand {
            skins: self.skins,
            triangles: self.triangles,
            bones: self.bones,
        }
    }

    /// Adds the rings at the roots of the fingers; neighbours share three vertices of the web.
    fn add_finger_bases(&mut self) -> Vec<Vec<usize>> {
        let mut rings: Vec<Vec<usize>> = Vec::new();
        for finger in 0..4 {
            let first = self.bones[digit_bone_index(finger + 1, 0)];
            let length = first.from.distance(first.to);
            let radius = DIGIT_RADII_MM[finger + 1][1];
            let [side, along, pad] = [first.axes.x_axis, first.axes.y_axis, first.axes.z_axis];
            // The side axis follows the palm's order: positive x is towards the thumb.
            let side = if side.x < 0.0 { -side } else { side };
            // The little finger is shorter, so its crease on the palm lies nearer the knuckle.
            let front = if finger == 3 { 16.0 } else { 20.0 };
            let mut ring = vec![usize::MAX; 12];
            for (k, slot) in ring.iter_mut().enumerate() {
                let (sine, cosine) = FINGER_RIM_DEGREES[k].to_radians().sin_cos();
                let reach = match k {
                    2..=4 => front,
                    8..=10 => 13.0,
                    0 | 1 | 11 if finger == 0 => {
                        [19.0, 19.5, 14.0][[0, 1, 11].iter().position(|&i| i == k).unwrap_or(0)]
                    }
                    5..=7 if finger == 3 => [17.0, 15.0, 13.0][k - 5],
                    0 | 1 | 11 => {
                        // Shared with the neighbour on the thumb's side.
                        let before: &Vec<usize> = &rings[finger - 1];
                        *slot = before[match k {
                            0 => 6,
                            1 => 5,
                            _ => 7,
                        }];
                        continue;
                    }
                    _ => length * 0.48,
                };
                // The little finger has no neighbour beyond it and therefore no web there.
                let web = (5..=7).contains(&k) && finger < 3;
                let place = if web {
                    let other = self.bones[digit_bone_index(finger + 2, 0)];
                    let share = [0.50, 0.48, 0.44][k - 5];
                    let middle = (first.from.lerp(first.to, share) + other.from.lerp(other.to, share)) * 0.5;
                    middle + Vec3::Z * [4.0, 0.5, -4.5][k - 5]
                } else {
                    // 0.47 is the cosine of 62 degrees: the outer ones end 0.62 radii aside.
                    let wide = if matches!(k, 2..=4 | 8..=10) { 0.62 / 0.47 } else { 1.0 };
                    first.from + along * reach + (side * (cosine * wide) + pad * sine) * radius
                };
                *slot = self.add_hand_vertex(place, None);
            }
            rings.push(ring);
        }
        for ring in &rings {
            for &index in ring {
                let place = self.skins[index].place;
                self.skins[index].place = on_skin(&|p| self.whole_hand_distance(p), place, 0.5);
            }
        }
        rings
    }

    /// Adds the rings from the wrist to the roots of the fingers.
    fn palm_rings(&mut self, bases: &[Vec<usize>]) -> Vec<Vec<usize>> {
        let mut last = vec![bases[0][0], bases[0][1]];
        for (finger, base) in bases.iter().enumerate() {
            last.extend(&base[2..=5]);
            if finger == 3 {
                last.extend([base[6], base[7]]);
            }
        }
        for (finger, base) in bases.iter().enumerate().rev() {
            if finger < 3 {
                last.push(base[7]);
            }
            last.extend(&base[8..=10]);
        }
        last.push(bases[0][11]);
        // Fronts and backs of the four base rings, without the middles of the webs between fingers.
        debug_assert_eq!(last.len(), 36);
        const PALM_RING_SHARES: [f32; 9] = [-0.30, -0.12, 0.04, 0.20, 0.36, 0.52, 0.67, 0.81, 0.92];
        let mut rings: Vec<Vec<usize>> = Vec::new();
        for share in PALM_RING_SHARES {
            let ring = (0..36).map(|column| {
                let end = self.skins[last[column]].place;
                let across = (end.x + 2.0) / 42.0;
                let front = match column {
                    0 | 18..20 => 0.0,
                    1..=17 => 1.0,
                    _ => -1.0,
                };
                // Not to zero at the sides: a flat edge would fold there.
                let round = (1.0 - across * across).max(0.06).sqrt();
                let carpus = Vec3::new(across * 25.0, 3.0, front * 17.0 * round);
                let thick = Vec3::new(end.x, end.y, front * 13.0 * round + 1.0);
                let mixed_place = carpus.lerp(thick, share);
                // Negative shares lie behind the wrist, on the cuff over the forearm.
                let ring_place = if share < 0.0 {
                    Vec3::new(carpus.x, 3.0 + share * 92.0, carpus.z * 0.9)
                } else {
                    mixed_place
                };
                on_skin(&|p| self.bare_palm_distance(p), ring_place, 0.5)
            });
            let places: Vec<Vec3> = ring.collect();
            let ring: Vec<usize> = places.into_iter().map(|at| self.add_hand_vertex(at, None)).collect();
            rings.push(ring);
        }
        rings.push(last);
        // Leave out a hole for the thumb: three by three quads on its side.
        for (row, pair) in rings.clone().windows(2).enumerate() {
            for column in 0..36 {
                let hole = (3..6).contains(&row) && matches!(column, 0..=2);
                if hole {
                    continue;
                }
                let next = (column + 1) % 36;
                let [p, q, r, s] = [pair[0][column], pair[0][next], pair[1][next], pair[1][column]].map(|i| i as u32);
                self.triangles.extend([[p, q, r], [p, r, s]]);
            }
        }
        let pole = self.add_hand_vertex(Vec3::new(0.0, -32.0, 0.0), None);
        for column in 0..36 {
            let [a, b] = [rings[0][(column + 1) % 36], rings[0][column]].map(|i| i as u32);
            self.triangles.push([pole as u32, a, b]);
        }
        self.loose.extend(rings[1..9].iter().flatten());
        rings
    }

    /// Returns the twelve vertices around the hole of the thumb.
    fn thumb_hole(&self, rings: &[Vec<usize>]) -> Vec<usize> {
        let columns = [0, 1, 2, 3];
        let mut hole: Vec<usize> = columns.iter().map(|&c| rings[3][c]).collect();
        hole.extend([rings[4][3], rings[5][3]]);
        hole.extend(columns.iter().rev().map(|&c| rings[6][c]));
        hole.extend([rings[5][0], rings[4][0]]);
        hole
    }

    fn digit_rings(&mut self, digit: usize, base: Vec<usize>) {
        let bones: [CanonicalHandBone; 3] = std::array::from_fn(|place| self.bones[digit_bone_index(digit, place)]);
        let radii = DIGIT_RADII_MM[digit];
        let lengths = bones.map(|bone| bone.from.distance(bone.to));
        let (b, c, tip) = (radii[2] * 0.85, radii[4] * 0.85, radii[6]);
        // The last bone ends within the round tip, whose ball reaches further by its radius.
        let end = lengths[2] - 0.62 * tip;
        let mut stops: Vec<(usize, f32)> = if digit == 0 {
            vec![(0, lengths[0] * 0.72)]
        } else {
            vec![(0, lengths[0] * 0.66)]
        };
        stops.extend([
            (0, lengths[0] - b),
            (1, 0.0),
            (1, b),
            (1, lengths[1] * 0.5),
            (1, lengths[1] - c),
            (2, 0.0),
            (2, c),
            (2, lengths[2] * 0.58),
            (2, end - 0.35 * tip),
            (2, end + 0.22 * tip),
            (2, end + 0.70 * tip),
        ]);
        let base_ring = base.clone();
        let mut before = base;
        let mut start = None;
        for (place, at) in stops {
            let current_bone = bones[place];
            // A stop at zero is a joint: its ring lies in the plane that halves the bend.
            let joint = at == 0.0;
            let along = if joint {
                (current_bone.axes.y_axis + bones[place - 1].axes.y_axis).normalize()
            } else {
                current_bone.axes.y_axis
            };
            let pad = (current_bone.axes.z_axis - along * along.dot(current_bone.axes.z_axis)).normalize();
            let middle = current_bone.from + current_bone.axes.y_axis * at;
            let side = along.cross(pad);
            let points: Vec<Vec3> = (0..12)
                .map(|k| {
                    let angle = if digit == 0 {
                        30.0 * k as f32
                    } else {
                        FINGER_RIM_DEGREES[k]
                    };
                    let (sine, cosine) = angle.to_radians().sin_cos();
                    let towards = side * cosine + pad * sine;
                    let field = |p: Vec3| self.digit_distance(digit, p);
                    if place == 2 && at > end {
                        // The round tip: rays from the middle of its ball.
                        let ball = current_bone.from + current_bone.axes.y_axis * end;
                        let lean = ((at - end) / tip).asin();
                        // Leans from the ring's plane to the bone's direction, as latitudes of the ball do.
                        let out = towards * lean.cos() + current_bone.axes.y_axis * lean.sin();
                        cast_skin_ray(&field, ball, out, 0.5)
                    } else {
                        cast_skin_ray(&field, middle, towards, 0.5)
                    }
                })
                .collect();
            // Rotate the first ring so that it meets the base without a twist.
            let fresh = start.is_none();
            let (shift, back) = *start.get_or_insert_with(|| self.best_ring_shift(&before, &points));
            let order = |k: usize| {
                if back { (shift + 12 - k) % 12 } else { (shift + k) % 12 }
            };
            if digit == 0 && fresh {
                // The ball of the thumb goes from the palm to the digit in two steps.
                for share in [0.30, 0.62] {
                    let ring: Vec<usize> = (0..12)
                        .map(|k| {
                            let from = self.skins[base_ring[k]].place;
                            let raw_place = from.lerp(points[order(k)], share);
                            let skin_place = on_skin(&|p| self.whole_hand_distance(p), raw_place, 0.5);
                            self.add_hand_vertex(skin_place, Some(digit))
                        })
                        .collect();
                    self.add_hand_tube(&before, &ring);
                    before = ring;
                }
            }
            let ring: Vec<usize> = (0..12)
                .map(|k| self.add_hand_vertex(points[order(k)], Some(digit)))
                .collect();
            self.add_hand_tube(&before, &ring);
            before = ring;
        }
        let last_bone = bones[2];
        let ball = last_bone.from + last_bone.axes.y_axis * end;
        let pole_place = cast_skin_ray(&|p| self.digit_distance(digit, p), ball, last_bone.axes.y_axis, 0.5);
        let pole = self.add_hand_vertex(pole_place, Some(digit));
        for k in 0..12 {
            let [a, b] = [before[k], before[(k + 1) % 12]].map(|i| i as u32);
            self.triangles.push([a, b, pole as u32]);
        }
    }

    /// Returns the shift and the direction in which twelve points are nearest to the vertices of a ring.
    fn best_ring_shift(&self, ring: &[usize], points: &[Vec3]) -> (usize, bool) {
        let centre = |all: &mut dyn Iterator<Item = Vec3>| all.sum::<Vec3>() / 12.0;
        // Compares shapes about their centres, since ring and points are at different places along the digit.
        let from = centre(&mut ring.iter().map(|&i| self.skins[i].place));
        let to = centre(&mut points.iter().copied());
        let mut best = (f32::INFINITY, (0, false));
        for back in [false, true] {
            for shift in 0..12 {
                let sum: f32 = (0..12)
                    .map(|k| {
                        let other = if back { (shift + 12 - k) % 12 } else { (shift + k) % 12 };
                        let a = self.skins[ring[k]].place - from;
                        a.distance_squared(points[other] - to)
                    })
                    .sum();
                if sum < best.0 {
                    best = (sum, (shift, back));
                }
            }
        }
        best.1
    }

    pub(super) fn hand_vertex_neighbours(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new(); self.skins.len()];
        for triangle in &self.triangles {
            for k in 0..3 {
                let [a, b] = [triangle[k], triangle[(k + 1) % 3]].map(|i| i as usize);
                all[a].push(b);
            }
        }
        all
    }

    /// Spreads the vertices of the palm evenly over its skin.
    fn relax_palm_vertices(&mut self, fingers: usize) {
        let neighbours = self.hand_vertex_neighbours();
        let mut loose = self.loose.clone();
        // Vertices of the fingers are fixed: only those added before them may slide.
        loose.retain(|&index| index < fingers && !neighbours[index].is_empty());
        // The first rings of the thumb's metacarpal lie on the palm too.
        let thumb = self.skins.iter().position(|skin| skin.digit == Some(0));
        if let Some(first) = thumb {
            // Three rings of twelve: two of the ball of the thumb and the first of the digit.
            loose.extend(first..first + 36);
        }
        for _ in 0..36 {
            let places: Vec<Vec3> = loose
                .iter()
                .map(|&index| {
                    let around = &neighbours[index];
                    // Half a step to the neighbours' mean, back onto the skin: the palm does not shrink.
                    let mean = around.iter().map(|&n| self.skins[n].place).sum::<Vec3>() / around.len() as f32;
                    let to = self.skins[index].place.lerp(mean, 0.5);
                    on_skin(&|p| self.whole_hand_distance(p), to, 0.5)
                })
                .collect();
            for (&index, place) in loose.iter().zip(places) {
                self.skins[index].place = place;
            }
        }
    }

    fn hand_volume(&self) -> f32 {
        let corner = |i: u32| self.skins[i as usize].place;
        let sixth = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0;
        self.triangles.iter().map(sixth).sum()
    }
}

fn digit_solids(bones: &[CanonicalHandBone; HAND_BONE_COUNT], digit: usize) -> Vec<BodySolid> {
    let radii = DIGIT_RADII_MM[digit];
    let mut solids = Vec::new();
    for place in 0..3 {
        let current_bone = bones[digit_bone_index(digit, place)];
        let [a, m, b] = [radii[2 * place], radii[2 * place + 1], radii[2 * place + 2]];
        let length = current_bone.from.distance(current_bone.to);
        let last = place == 2;
        // The last bone stops short of the fingertip by a share of its radius, so that the round end fits.
        let end = if last { 1.0 - 0.62 * b / length } else { 1.0 };
        // Bends the rod slightly to the palm's side: the pad of the finger.
        let meet = current_bone.from.lerp(current_bone.to, 0.52) + current_bone.axes.z_axis * 0.6;
        let rod = |from: Vec3, to: Vec3, radii| BodySolid::Rod {
            ends: [from, to],
            radii,
            flat: (current_bone.axes.z_axis, 1.10),
        };
        solids.push(rod(current_bone.from, meet, [a, m]));
        solids.push(rod(meet, current_bone.from.lerp(current_bone.to, end), [m, b]));
    }
    solids
}

fn palm_solids(bones: &[CanonicalHandBone; HAND_BONE_COUNT]) -> Vec<(Vec<BodySolid>, f32)> {
    let knuckle = |digit: usize| (bones[digit_bone_index(digit, 0)].from + Vec3::Z).to_array();
    let flat = |solid: BodySolid, factor: f32| solid.flatten_rod_solid(Vec3::Z, factor);
    let metacarpals = [
        ([13.0, 9.0, -1.0], [12.5, 11.8]),
        ([4.0, 7.0, -2.0], [13.0, 11.9]),
        ([-6.0, 7.0, -2.0], [12.5, 11.2]),
        ([-14.0, 9.0, 0.0], [12.0, 10.2]),
    ];
    let mut body: Vec<BodySolid> = metacarpals
        .into_iter()
        .enumerate()
        .map(|(i, (from, radii))| flat(BodySolid::new_rod_solid(from, knuckle(i + 1), radii), 1.06))
        .collect();
    body.extend([
        flat(
            BodySolid::new_rod_solid([14.0, 22.0, 3.0], [22.0, 72.0, 2.0], [13.0, 11.0]),
            1.06,
        ),
        flat(
            BodySolid::new_rod_solid([0.0, 18.0, 3.0], [0.0, 80.0, 2.0], [14.0, 11.5]),
            1.06,
        ),
        flat(
            BodySolid::new_rod_solid([-14.0, 22.0, 3.0], [-22.0, 66.0, 2.5], [13.5, 10.5]),
            1.06,
        ),
    ]);
    let wrist = [-9.0, 0.0, 9.0]
        .map(|x| {
            flat(
                BodySolid::new_rod_solid([x, -34.0, 0.0], [x, 5.0, 0.0], [17.0, 16.0]),
                // The wrist is wide and flat, hence the strongest flattening.
                1.32,
            )
        })
        .to_vec();
    let ball = vec![BodySolid::new_rod_solid(
        [-17.0, 20.0, 5.0],
        [-27.0, 58.0, 3.0],
        [14.0, 11.0],
    )];
    let mut webs = Vec::new();
    for finger in 1..4 {
        let (a, b) = (
            bones[digit_bone_index(finger, 0)],
            bones[digit_bone_index(finger + 1, 0)],
        );
        let from = (a.from + b.from) * 0.5;
        let to = (a.from.lerp(a.to, 0.40) + b.from.lerp(b.to, 0.44)) * 0.5 + Vec3::Z * 1.5;
        webs.push(BodySolid::new_rod_solid(from.to_array(), to.to_array(), [10.0, 5.0]));
    }
    let thumb = bones[digit_bone_index(0, 0)];
    let along = |share: f32, palmar: f32| thumb.from.lerp(thumb.to, share) + Vec3::Z * palmar;
    let root = thumb.from + Vec3::new(-4.0, -2.0, 2.0);
    let ball_of_thumb = vec![
        BodySolid::new_rod_solid(root.to_array(), along(0.55, 3.0).to_array(), [15.5, 14.0]),
        BodySolid::new_rod_solid(along(0.5, 2.0).to_array(), thumb.to.to_array(), [13.5, 11.6]),
    ];
    let index = bones[digit_bone_index(1, 0)].from;
    let first_web = vec![BodySolid::new_rod_solid(
        along(0.80, 0.0).to_array(),
        Vec3::new(13.0, 9.0, -1.0).lerp(index, 0.62).to_array(),
        [8.5, 9.0],
    )];
    vec![
        (body, 7.0),
        (wrist, 8.0),
        (ball, 8.0),
        (webs, 5.0),
        (ball_of_thumb, 8.0),
        (first_web, 9.0),
    ]
}
