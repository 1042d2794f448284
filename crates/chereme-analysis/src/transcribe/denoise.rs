//! Denoises joints that tremble from frame to frame, as no person's do: noise of sensors, or of postures
//! estimated frame by frame.

use std::f64::consts::PI;
use std::sync::Arc;

use chereme_motion::{Channel, Clip};
use glam::{DQuat, DVec4};

use crate::transcribe::tuned::tuned;

/// The fewest frames from which noise can be estimated.
const FEWEST: usize = 12;

/// A clip whose trembling joints were smoothed.
pub(super) struct Steadied {
    pub(super) clip: Clip,
    /// The noise of the worst joint, in degrees.
    pub(super) most: f64,
    /// The number of smoothed joints.
    pub(super) joints: usize,
}

/// Smooths the joints of a clip that tremble; `None` if no joint does.
pub(super) fn steadied(clip: &Clip) -> Option<Steadied> {
    let (mut most, mut joints) = (0.0_f64, 0);
    let mut channels = Vec::with_capacity(clip.channels().len());
    for channel in clip.channels() {
        let trembles = noise(&channel.rotations);
        if trembles < tuned().denoise.trembles {
            channels.push(channel.clone());
            continue;
        }
        most = most.max(trembles.to_degrees());
        joints += 1;
        // A kernel n frames wide divides the standard deviation of white noise by the square root of
        // 32 √π n / 27. This width leaves half of the noise that counts as trembling.
        let enough =
            (2.0 * trembles / tuned().denoise.trembles).powi(2) * 27.0 / (32.0 * PI.sqrt());
        let wide = enough.min(tuned().denoise.widest * clip.rate().per_second());
        channels.push(Channel {
            rotations: smoothed(&channel.rotations, wide),
            translations: channel.translations.clone(),
        });
    }
    if joints == 0 {
        return None;
    }
    let clip = Clip::new(Arc::clone(clip.skeleton()), clip.rate(), channels).ok()?;
    Some(Steadied { clip, most, joints })
}

/// Returns the noise of rotations about each axis (rad), by the median of their fourth differences, which
/// hold little of real movement.
fn noise(rotations: &[DQuat]) -> f64 {
    // Ratio of the median length of normally distributed vectors to their standard deviation along one axis.
    const MEDIAN: f64 = 1.538;
    if rotations.len() < FEWEST {
        return 0.0;
    }
    let mut differences: Vec<f64> = rotations
        .windows(5)
        .map(|five| {
            let like = |n: usize| {
                let v = DVec4::from(five[n]);
                if five[n].dot(five[2]) < 0.0 { -v } else { v }
            };
            let fourth = like(0) + like(4) - 4.0 * (like(1) + like(3)) + 6.0 * like(2);
            fourth.length()
        })
        .collect();
    let middle = differences.len() / 2;
    let (_, median, _) = differences.select_nth_unstable_by(middle, f64::total_cmp);
    // The squares of 1, 4, 6, 4, 1 sum to 70; a quaternion has half of the angle.
    2.0 * *median / (MEDIAN * 70.0_f64.sqrt())
}

/// Smooths rotations by a kernel `wide` frames wide that preserves parabolas (Wand and Jones, *Kernel
/// smoothing*, 2.8: the Gaussian kernel of fourth order).
fn smoothed(rotations: &[DQuat], wide: f64) -> Vec<DQuat> {
    let reach = (3.0 * wide).ceil() as usize;
    let bell: Vec<f64> = (0..=reach)
        .map(|away| {
            let square = (away as f64 / wide.max(1e-6)).powi(2);
            (1.5 - 0.5 * square) * (-0.5 * square).exp()
        })
        .collect();
    (0..rotations.len())
        .map(|n| {
            let near = n.saturating_sub(reach)..(n + reach + 1).min(rotations.len());
            let sum: DVec4 = near
                .map(|m| {
                    let other = DVec4::from(rotations[m]);
                    let sign = rotations[m].dot(rotations[n]).signum();
                    other * (sign * bell[m.abs_diff(n)])
                })
                .sum();
            DQuat::from_vec4(sum.normalize_or(DVec4::from(rotations[n])))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Returns random numbers with mean 0 and standard deviation about 1.
    fn noisy(seed: &mut u64) -> f64 {
        let mut sum = -6.0;
        for _ in 0..12 {
            *seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            sum += (*seed >> 33) as f64 / 2f64.powi(31);
        }
        sum
    }

    fn turning(frames: usize, noise: f64) -> Vec<DQuat> {
        let mut seed = 7;
        (0..frames)
            .map(|n| {
                let turn = DQuat::from_rotation_x(0.6 * (n as f64 / 60.0 * 2.0 * PI * 2.0).sin());
                let by = DVec3::new(noisy(&mut seed), noisy(&mut seed), noisy(&mut seed));
                turn * DQuat::from_scaled_axis(by * noise)
            })
            .collect()
    }

    #[test]
    fn noise_is_measured_and_clean_movement_counts_as_none() {
        assert!(noise(&turning(120, 0.0)) < 0.1 * tuned().denoise.trembles);
        for degrees in [1.0_f64, 2.0, 4.0] {
            let found = noise(&turning(300, degrees.to_radians())).to_degrees();
            assert!((found / degrees - 1.0).abs() < 0.15, "{degrees} {found}");
        }
    }

    #[test]
    fn a_rotation_and_its_negative_quaternion_count_as_one() {
        let plain = turning(120, 0.03);
        let each = plain.iter().enumerate();
        let mixed: Vec<DQuat> = each
            .map(|(n, turn)| if n % 3 == 1 { -*turn } else { *turn })
            .collect();
        assert!((noise(&plain) - noise(&mixed)).abs() < 1e-12);
        let [one, two] = [&plain, &mixed].map(|turns| smoothed(turns, 4.0));
        for (a, b) in one.iter().zip(&two) {
            assert!(a.angle_between(*b) < 1e-6);
        }
    }

    #[test]
    fn smoothed_rotations_are_nearer_to_the_clean_movement_than_noisy_ones() {
        let clean = turning(200, 0.0);
        let shaken = turning(200, 0.035);
        let off = |some: &[DQuat]| {
            let sum: f64 = some
                .iter()
                .zip(&clean)
                .map(|(a, b)| a.angle_between(*b).powi(2))
                .sum();
            (sum / clean.len() as f64).sqrt()
        };
        let smooth = smoothed(&shaken, tuned().denoise.widest * 60.0);
        assert!(
            off(&smooth) < 0.7 * off(&shaken),
            "{} {}",
            off(&smooth),
            off(&shaken)
        );
    }

    #[test]
    fn half_of_the_noise_that_counts_as_trembling_is_left() {
        let skeleton =
            chereme_motion::Skeleton::new(vec![chereme_motion::Joint::new("Hips", None, DVec3::Y)]);
        let skeleton = Arc::new(skeleton.expect("a joint"));
        let rate = chereme_motion::Rate::new(1000, 1).expect("a rate");
        let mut seed = 3;
        for times in [1.5, 3.0] {
            let sd = times * tuned().denoise.trembles;
            let shaken = |seed: &mut u64| {
                DQuat::from_scaled_axis(DVec3::new(noisy(seed), noisy(seed), noisy(seed)) * sd)
            };
            let channel = Channel {
                rotations: (0..6000).map(|_| shaken(&mut seed)).collect(),
                translations: None,
            };
            let clip = Clip::new(Arc::clone(&skeleton), rate, vec![channel]).expect("a clip");
            let steady = steadied(&clip).expect("it trembles");
            assert_eq!(steady.joints, 1);
            assert!(
                (steady.most.to_radians() / sd - 1.0).abs() < 0.1,
                "{}",
                steady.most
            );
            let turns = &steady.clip.channel(0).rotations;
            let squares: f64 = turns
                .iter()
                .map(|turn| turn.to_scaled_axis().length_squared())
                .sum();
            let left = (squares / (3.0 * turns.len() as f64)).sqrt();
            let share = left / tuned().denoise.trembles;
            assert!((share - 0.5).abs() < 0.06, "{times}: {share}");
        }
        let still = Channel {
            rotations: vec![DQuat::IDENTITY; 100],
            translations: None,
        };
        let clip = Clip::new(skeleton, rate, vec![still]).expect("a clip");
        assert!(steadied(&clip).is_none());
    }
}
