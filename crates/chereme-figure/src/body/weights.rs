//! Skin weights and shades of the canonical hand.

use glam::Vec3;

use super::glove::{
    CUFF_FOLLOWER, CanonicalHandBone, DIGIT_RADII_MM, FIRST_HALF_JOINT, HAND_FOLLOWER_COUNT, HandMaker, HandVertex,
    PALM_ARCH_BONES, PALM_BONE, THUMB_BONE_MEASURES_MM, digit_bone_index,
};
use super::solids::{field_slope, smooth_step};

impl HandMaker {
    pub(super) fn assign_skin_weights(&mut self) {
        let mut all: Vec<[f32; HAND_FOLLOWER_COUNT]> =
            self.skins.iter().map(|skin| self.skin_bone_shares(skin)).collect();
        let neighbours = self.hand_vertex_neighbours();
        for _ in 0..3 {
            let before = all.clone();
            for (index, around) in neighbours.iter().enumerate() {
                if self.skins[index].digit.is_some_and(|digit| digit > 0) || around.is_empty() {
                    continue;
                }
                for follower in 0..HAND_FOLLOWER_COUNT {
                    let mean = around.iter().map(|&n| before[n][follower]).sum::<f32>() / around.len() as f32;
                    all[index][follower] = before[index][follower] * 0.5 + mean * 0.5;
                }
            }
        }
        for (skin, shares) in self.skins.iter_mut().zip(&all) {
            skin.weights = strongest(shares);
        }
    }

    /// Returns the share of each bone and half joint in a vertex.
    fn skin_bone_shares(&self, skin: &HandVertex) -> [f32; HAND_FOLLOWER_COUNT] {
        let mut shares = [0.0; HAND_FOLLOWER_COUNT];
        let place = skin.place;
        let metacarpal = self.bones[digit_bone_index(0, 0)];
        let along = |bone: &CanonicalHandBone| (place - bone.from).dot(bone.axes.y_axis);
        if let Some(digit) = skin.digit {
            let radii = [DIGIT_RADII_MM[digit][2], DIGIT_RADII_MM[digit][4]];
            let bones: [CanonicalHandBone; 3] = std::array::from_fn(|n| self.bones[digit_bone_index(digit, n)]);
            let shares_at = |n: usize| {
                let half = 0.95 * radii[n - 1];
                let mean = (bones[n].axes.y_axis + bones[n - 1].axes.y_axis).normalize();
                let s = (place - bones[n].from).dot(mean);
                ((s + half) / (2.0 * half)).clamp(0.0, 1.0)
            };
            let (first, second) = (shares_at(1), shares_at(2));
            let split = |t: f32| {
                [
                    (1.0 - 2.0 * t).max(0.0),
                    1.0 - (2.0 * t - 1.0).abs(),
                    (2.0 * t - 1.0).max(0.0),
                ]
            };
            let [a, h, rest] = split(first);
            let [b, k, c] = split(second);
            shares[digit_bone_index(digit, 0)] += a;
            shares[FIRST_HALF_JOINT + digit_bone_index(digit, 1)] += h;
            shares[digit_bone_index(digit, 1)] += rest * b;
            shares[FIRST_HALF_JOINT + digit_bone_index(digit, 2)] += rest * k;
            shares[digit_bone_index(digit, 2)] += rest * c;
            if digit == 0 {
                let h = along(&metacarpal) / THUMB_BONE_MEASURES_MM.1[0];
                let digit_share = if h > 1.0 { 1.0 } else { smooth_step((h + 0.15) / 0.75) };
                shares[digit_bone_index(0, 0)] *= digit_share;
                shares[PALM_BONE] += 1.0 - shares.iter().sum::<f32>();
            } else {
                let (base, palm) = self.knuckle(digit, place, 0.0);
                let moved = shares[digit_bone_index(digit, 0)];
                shares[digit_bone_index(digit, 0)] = moved * base;
                shares[FIRST_HALF_JOINT + digit_bone_index(digit, 0)] += moved * (1.0 - base - palm);
                shares[PALM_BONE] += moved * palm;
            }
            return shares;
        }
        // The palm: each knuckle's share depends on its distance across the hand.
        let near: [f32; 4] = std::array::from_fn(|finger| {
            let first = self.bones[digit_bone_index(finger + 1, 0)];
            let root = Vec3::new(first.from.x * 0.25, 3.0, 0.0);
            let line_x = if place.y < first.from.y {
                let share = (place.y - root.y) / (first.from.y - root.y);
                root.x + (first.from.x - root.x) * share
            } else {
                first.from.x + first.axes.y_axis.x / first.axes.y_axis.y * (place.y - first.from.y)
            };
            (-((place.x - line_x) / 8.0).powi(2)).exp() + 1e-6
        });
        let sum: f32 = near.iter().sum();
        for finger in 0..4 {
            let share = near[finger] / sum;
            let shift = (place.z / 12.0).clamp(0.0, 1.0) * 5.0;
            let (base, palm) = self.knuckle(finger + 1, place, shift);
            shares[digit_bone_index(finger + 1, 0)] += share * base;
            shares[FIRST_HALF_JOINT + digit_bone_index(finger + 1, 0)] += share * (1.0 - base - palm);
            let cup = smooth_step((place.y - 10.0) / 60.0);
            match finger {
                2 | 3 => {
                    shares[PALM_ARCH_BONES[finger - 2]] += share * palm * cup;
                    shares[PALM_BONE] += share * palm * (1.0 - cup);
                }
                _ => shares[PALM_BONE] += share * palm,
            }
        }
        let h = along(&metacarpal) / THUMB_BONE_MEASURES_MM.1[0];
        let nearest = metacarpal.from + metacarpal.axes.y_axis * (h.clamp(0.0, 1.0) * THUMB_BONE_MEASURES_MM.1[0]);
        let far = place.distance(nearest);
        let thumb = smooth_step((h + 0.15) / 0.75) * smooth_step(1.25 - (far - 12.0) / 16.0);
        for share in &mut shares {
            *share *= 1.0 - thumb;
        }
        shares[digit_bone_index(0, 0)] += thumb;
        // Behind the wrist, the forearm carries the skin.
        let t = ((place.y + 14.0) / 28.0).clamp(0.0, 1.0);
        let (hand, half, arm) = (
            (2.0 * t - 1.0).max(0.0),
            1.0 - (2.0 * t - 1.0).abs(),
            (1.0 - 2.0 * t).max(0.0),
        );
        for share in &mut shares {
            *share *= hand;
        }
        shares[FIRST_HALF_JOINT + PALM_BONE] += half;
        shares[CUFF_FOLLOWER] += arm;
        shares
    }

    /// Returns the shares of a finger's first bone and of the palm in the skin around its knuckle.
    fn knuckle(&self, digit: usize, place: Vec3, shift: f32) -> (f32, f32) {
        let first = self.bones[digit_bone_index(digit, 0)];
        let s = (place - first.from).dot(first.axes.y_axis) - shift;
        let t = ((s + 12.0) / 22.0).clamp(0.0, 1.0);
        ((2.0 * t - 1.0).max(0.0), (1.0 - 2.0 * t).max(0.0))
    }

    pub(super) fn colour_glove_skin(&mut self) {
        for index in 0..self.skins.len() {
            let place = self.skins[index].place;
            let normal = field_slope(&|p| self.whole_hand_distance(p), place, 0.5);
            let mut dark = 0.0;
            for step in 1..=5 {
                let far = step as f32 * 4.0;
                let free = self.whole_hand_distance(place + normal * far);
                dark += (far - free).max(0.0) / f32::powi(2.0, step) / 4.0;
            }
            let pad = match self.skins[index].digit {
                Some(digit) => self.bones[digit_bone_index(digit, 1)].axes.z_axis,
                None => Vec3::Z,
            };
            let thumb = self.skins[index].digit == Some(0);
            let facing = if thumb {
                normal.dot((pad + Vec3::Z * 0.4).normalize())
            } else {
                normal.dot(pad)
            };
            let skin = &mut self.skins[index];
            skin.palmar = smooth_step((facing + 0.35) / 0.7);
            skin.open = (1.0 - 0.38 * dark).clamp(0.62, 1.0);
            if let Some(digit) = skin.digit {
                let last = self.bones[digit_bone_index(digit, 2)];
                let length = last.from.distance(last.to);
                let h = (skin.place - last.from).dot(last.axes.y_axis) / length;
                let back = -normal.dot(last.axes.z_axis);
                let aside = normal.dot(last.axes.x_axis).abs();
                if (0.45..1.02).contains(&h) && back > 0.55 && aside < 0.62 {
                    skin.nail = 1.0;
                }
            }
        }
    }
}

/// Returns the four strongest followers, their weights summing to one.
fn strongest(shares: &[f32; HAND_FOLLOWER_COUNT]) -> [(usize, f32); 4] {
    let mut order: Vec<usize> = (0..HAND_FOLLOWER_COUNT).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    let sum: f32 = order[..4].iter().map(|&i| shares[i]).sum();
    std::array::from_fn(|k| (order[k], shares[order[k]] / sum.max(1e-6)))
}
