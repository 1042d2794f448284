//! Denoises joints that tremble from frame to frame, as no person's do: noise of sensors, or of postures
//! estimated frame by frame.

use std::ops::Range;
use std::sync::Arc;

use chereme_motion::{Clip, JointChannel};
use glam::{DQuat, DVec4};

use crate::transcribe::transcribe_tuned::tuned;

/// The fewest frames from which noise can be estimated.
const MIN_NOISE_FRAMES: usize = 12;

/// Kernel widths that are tried, as shares of the widest.
const KERNEL_WIDTH_SHARES: [f64; 7] = [0.15, 0.25, 0.35, 0.5, 0.7, 0.85, 1.0];

/// A clip whose trembling joints were smoothed.
pub(super) struct SteadiedClip {
    pub(super) clip: Clip,
    /// The noise of the worst joint, in degrees.
    pub(super) most: f64,
    /// The number of smoothed joints.
    pub(super) joints: usize,
}

/// Smooths the joints of a clip that tremble; `None` if no joint does.
pub(super) fn steady_trembling_clip(clip: &Clip) -> Option<SteadiedClip> {
    let (mut most, mut joints) = (0.0_f64, 0);
    let mut channels = Vec::with_capacity(clip.joint_channels().len());
    for channel in clip.joint_channels() {
        let trembles = noise(&channel.rotations);
        if trembles < tuned().denoise.trembles {
            channels.push(channel.clone());
            continue;
        }
        most = most.max(trembles.to_degrees());
        joints += 1;
        channels.push(JointChannel {
            rotations: calm_joint_rotations(&channel.rotations, trembles, clip.clip_frame_rate().per_second()),
            translations: channel.translations.clone(),
        });
    }
    if joints == 0 {
        return None;
    }
    let clip = Clip::new(Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate(), channels).ok()?;
    Some(SteadiedClip { clip, most, joints })
}

/// Returns the noise of rotations about each axis (rad), by the median product of successive fourth differences: noise
/// turns them round from frame to frame, and movement does not.
fn noise(rotations: &[DQuat]) -> f64 {
    // Ratio of that median, for normally distributed vectors, to their variance along one axis.
    const MEDIAN_VARIANCE_RATIO: f64 = -128.3;
    if rotations.len() < MIN_NOISE_FRAMES {
        return 0.0;
    }
    let mut last = DVec4::ZERO;
    let near: Vec<DVec4> = rotations
        .iter()
        .map(|turned| {
            let turned = DVec4::from(*turned);
            // A quaternion and its negative are one rotation: neighbours must not jump between them.
            last = if turned.dot(last) < 0.0 { -turned } else { turned };
            last
        })
        .collect();
    let differences: Vec<DVec4> = near
        .windows(5)
        .map(|five| five[0] + five[4] - 4.0 * (five[1] + five[3]) + 6.0 * five[2])
        .collect();
    let pairs = differences.windows(2);
    let mut products: Vec<f64> = pairs.map(|pair| pair[0].dot(pair[1])).collect();
    let middle = products.len() / 2;
    let (_, median, _) = products.select_nth_unstable_by(middle, f64::total_cmp);
    // A quaternion has half of the angle.
    2.0 * (*median / MEDIAN_VARIANCE_RATIO).max(0.0).sqrt()
}

/// Returns rotations without most of their noise (rad about each axis): the mean of what a kernel leaves of them, and
/// of the stretches in which they stay within their noise, each by the frames that it averages.
fn calm_joint_rotations(rotations: &[DQuat], noise: f64, per_second: f64) -> Vec<DQuat> {
    let (moving, frames) = least_wrong(rotations, noise, per_second);
    let mut sums: Vec<DVec4> = moving
        .iter()
        .map(|turned| DVec4::from(*turned) * frames.powi(2))
        .collect();
    for (stretch, mean) in longest_still_stretches(rotations, noise, per_second) {
        let weight = (stretch.len() as f64).powi(2);
        for n in stretch {
            // Opposite signs of one rotation would cancel out.
            let sign = moving[n].dot(DQuat::from_vec4(mean)).signum();
            sums[n] += mean * (sign * weight);
        }
    }
    let both = sums.into_iter().zip(&moving);
    both.map(|(sum, turned)| DQuat::from_vec4(sum.normalize_or(DVec4::from(*turned))))
        .collect()
}

/// Smooths rotations by the kernel with the least expected error, which is the remaining noise and the deformation of the
/// movement (Stein's unbiased estimate of risk, Annals of Statistics 9, 1981); also returns how many frames it averages.
fn least_wrong(rotations: &[DQuat], noise: f64, per_second: f64) -> (Vec<DQuat>, f64) {
    let widest = tuned().denoise.widest * per_second;
    // Without a kernel the error is the noise about three axes.
    let mut best = (rotations.to_vec(), 1.0, 3.0 * noise * noise);
    for share in KERNEL_WIDTH_SHARES {
        let wide = share * widest;
        let smooth = smooth_rotations(rotations, wide);
        let squares: f64 = smooth
            .iter()
            .zip(rotations)
            .map(|(a, b)| a.angle_between(*b).powi(2))
            .sum();
        let bell = bell(wide);
        let all = bell[0] + 2.0 * bell[1..].iter().sum::<f64>();
        let central_share = bell[0] / all;
        // Stein's estimate; `central_share` is how far each frame still follows its own noise.
        let wrong = squares / rotations.len() as f64 + 3.0 * noise * noise * (2.0 * central_share - 1.0);
        if wrong < best.2 {
            // Averaging divides the variance of independent noise by all² over the sum of squares.
            let square_sum = bell[0].powi(2) + 2.0 * bell[1..].iter().map(|weight| weight * weight).sum::<f64>();
            best = (smooth, all * all / square_sum, wrong);
        }
    }
    (best.0, best.1)
}

/// Returns, for each frame, the longest stretch from it on in which rotations differ by no more than their noise, with
/// their mean.
fn longest_still_stretches(
    rotations: &[DQuat],
    noise: f64,
    per_second: f64,
) -> impl Iterator<Item = (Range<usize>, DVec4)> {
    let longest = (tuned().denoise.longest * per_second).round() as usize;
    (0..rotations.len()).filter_map(move |first| {
        let mut sum = DVec4::from(rotations[first]);
        let mut end = first + 1;
        while end < rotations.len().min(first + longest) {
            let sign = rotations[end].dot(rotations[first]).signum();
            let more = sum + DVec4::from(rotations[end]) * sign;
            let count = (end + 1 - first) as f64;
            // The squared distances from the mean; a quaternion has half of the angle.
            let scatter = 4.0 * (count - more.length_squared() / count);
            // Of noise alone the scatter is chi-squared with this many degrees of freedom and twice that
            // variance.
            let free = 3.0 * (count - 1.0);
            let most = free + tuned().denoise.odd * (2.0 * free).sqrt();
            if scatter > noise * noise * most {
                break;
            }
            (sum, end) = (more, end + 1);
        }
        (end > first + 1).then(|| (first..end, sum.normalize_or(DVec4::W)))
    })
}

/// Smooths rotations by a kernel `wide` frames wide that preserves parabolas (Wand and Jones, *Kernel
/// smoothing*, 2.8: the Gaussian kernel of fourth order).
fn smooth_rotations(rotations: &[DQuat], wide: f64) -> Vec<DQuat> {
    let bell = bell(wide);
    let reach = bell.len() - 1;
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

/// Returns the weights of that kernel, by the distance in frames.
fn bell(wide: f64) -> Vec<f64> {
    let reach = (3.0 * wide).ceil() as usize;
    let weights = (0..=reach).map(|away| {
        let square = (away as f64 / wide.max(1e-6)).powi(2);
        (1.5 - 0.5 * square) * (-0.5 * square).exp()
    });
    weights.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::TAU;

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
                let turn = DQuat::from_rotation_x(0.6 * (n as f64 / 60.0 * 2.0 * TAU).sin());
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
        let mixed: Vec<DQuat> = each.map(|(n, turn)| if n % 3 == 1 { -*turn } else { *turn }).collect();
        assert!((noise(&plain) - noise(&mixed)).abs() < 1e-12);
        let [one, two] = [&plain, &mixed].map(|turns| smooth_rotations(turns, 4.0));
        for (a, b) in one.iter().zip(&two) {
            assert!(a.angle_between(*b) < 1e-6);
        }
    }

    #[test]
    fn smoothed_rotations_are_nearer_to_the_clean_movement_than_noisy_ones() {
        let clean = turning(200, 0.0);
        let shaken = turning(200, 0.035);
        let off = |some: &[DQuat]| {
            let sum: f64 = some.iter().zip(&clean).map(|(a, b)| a.angle_between(*b).powi(2)).sum();
            (sum / clean.len() as f64).sqrt()
        };
        let smooth = smooth_rotations(&shaken, tuned().denoise.widest * 60.0);
        assert!(off(&smooth) < 0.7 * off(&shaken), "{} {}", off(&smooth), off(&shaken));
    }

    #[test]
    fn holds_lose_most_of_their_noise_and_strokes_keep_their_shape() {
        let skeleton = chereme_motion::Skeleton::new(vec![chereme_motion::SkeletonJoint::new("Hips", None, DVec3::Y)]);
        let skeleton = Arc::new(skeleton.expect("a joint"));
        let rate = chereme_motion::FrameRate::new(30, 1).expect("a rate");
        // A hold of 0.6 s, a stroke of 0.4 s, and another hold.
        let clean = |frame: usize| {
            let share = ((frame as f64 - 18.0) / 12.0).clamp(0.0, 1.0);
            DQuat::from_rotation_y(share * share * (3.0 - 2.0 * share))
        };
        let mut seed = 3;
        for degrees in [0.1_f64, 0.2, 0.5, 1.0] {
            let (mut held, mut moved) = (0.0, 0.0);
            for _ in 0..20 {
                let sd = degrees.to_radians();
                let mut shaken = |frame: usize| {
                    let by = DVec3::new(noisy(&mut seed), noisy(&mut seed), noisy(&mut seed));
                    clean(frame) * DQuat::from_scaled_axis(by * sd)
                };
                let channel = JointChannel {
                    rotations: (0..48).map(&mut shaken).collect(),
                    translations: None,
                };
                let clip = Clip::new(Arc::clone(&skeleton), rate, vec![channel]).expect("a clip");
                let steady = steady_trembling_clip(&clip).expect("it trembles");
                assert_eq!(steady.joints, 1);
                let turned = &steady.clip.joint_channel(0).rotations;
                let off = |n: usize| turned[n].angle_between(clean(n)).powi(2) / (3.0 * sd * sd);
                held += (3..15).map(off).sum::<f64>() / 240.0;
                moved += (18..31).map(off).sum::<f64>() / 260.0;
            }
            let (held, moved) = (held.sqrt(), moved.sqrt());
            assert!(held < 0.5, "{degrees}: {held}");
            assert!(moved < 1.1, "{degrees}: {moved}");
        }
        let still = JointChannel {
            rotations: (0..48).map(clean).collect(),
            translations: None,
        };
        let clip = Clip::new(skeleton, rate, vec![still]).expect("a clip");
        assert!(steady_trembling_clip(&clip).is_none());
    }
}
