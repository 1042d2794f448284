//! Finds hands that turn to and fro about the wrist, and fingers that play.

use chereme_sign::hamnosys::{DigitList, HandDigit, WristMotion};
use glam::DVec3;

use super::super::transcribe_scene::{HandTrajectory, SignerScene, to_rotation_vector};
use crate::transcribe::transcribe_tuned::tuned;

/// A movement to and fro of wrist or fingers.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::transcribe) enum HandSway {
    /// About the wrist: by `angle` radians to either side, `cycles` times.
    Wrist {
        motion: WristMotion,
        angle: f64,
        cycles: f64,
        runner_up: Option<(WristMotion, f64)>,
    },
    /// Fingers play, each `cycles` times.
    Play { digits: DigitList, cycles: f64 },
}

impl HandSway {
    pub(in crate::transcribe) fn sway_name(&self) -> &'static str {
        match self {
            Self::Play { .. } => "fingerplay",
            Self::Wrist { motion, .. } => wrist_name(*motion),
        }
    }
}

/// Returns the name of a wrist movement.
pub(in crate::transcribe) fn wrist_name(motion: WristMotion) -> &'static str {
    match motion {
        WristMotion::Nodding => "nodding",
        WristMotion::Swinging => "swinging",
        WristMotion::Twisting => "twisting",
        WristMotion::StirCw => "stirring",
        WristMotion::StirCcw => "stirring back",
    }
}

/// Returns the movement of the hand to and fro about the wrist, measured from the middle of its range;
/// `None` if there is no such movement.
pub(super) fn find_wrist_sway(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
) -> Option<HandSway> {
    let start = track.turned[first].inverse();
    let turns: Vec<DVec3> = (first..=last)
        .map(|n| to_rotation_vector(start * track.turned[n]))
        .collect();
    let parts: [Vec<f64>; 3] = std::array::from_fn(|axis| turns.iter().map(|t| t[axis]).collect());
    let swings = parts.each_ref().map(|part| SwingStatistics::from_swing_values(part));
    let widest = swings.iter().map(|swing| swing.range).fold(0.0, f64::max);
    // A hand may turn to another orientation about one axis while it moves to and fro about another.
    let sways = |swing: &SwingStatistics| {
        swing.range >= (tuned().sway.sway * scene.loose).max(tuned().sway.besides * widest)
            && swing.turning >= 2
            && swing.net < 0.45 * swing.range
    };
    let most = (0..3)
        .filter(|&axis| sways(&swings[axis]))
        .max_by(|&a, &b| swings[a].range.total_cmp(&swings[b].range))?;
    let swing = swings[most];
    let motions = [WristMotion::Twisting, WristMotion::Swinging, WristMotion::Nodding];
    let (y, z) = (&swings[1], &swings[2]);
    // The area that both bends enclose, by the cross products of successive ones.
    let round: f64 = (1..turns.len())
        .map(|n| turns[n - 1].y * turns[n].z - turns[n - 1].z * turns[n].y)
        .sum::<f64>()
        / 2.0;
    let narrow = y.range.min(z.range) / y.range.max(z.range).max(1e-9);
    // The area of an ellipse with these ranges.
    let full = std::f64::consts::PI * y.range * z.range / 4.0;
    if most != 0 && narrow > 0.45 && round.abs() > 0.5 * full {
        // As the signer sees it, from nodding over to swinging.
        let motion = if round > 0.0 {
            WristMotion::StirCw
        } else {
            WristMotion::StirCcw
        };
        return Some(HandSway::Wrist {
            motion,
            angle: (y.range + z.range) / 4.0,
            cycles: (round.abs() / full).max(1.0),
            runner_up: Some((motions[most], swing.range / 2.0)),
        });
    }
    // A movement that starts at an end of its range goes there and back and does not swing about a middle.
    if !(0.2..=0.8).contains(&swing.start) {
        return None;
    }
    let next = (0..3)
        .filter(|&axis| axis != most)
        .max_by(|&a, &b| swings[a].range.total_cmp(&swings[b].range));
    Some(HandSway::Wrist {
        motion: motions[most],
        angle: swing.range / 2.0,
        cycles: swing.turning as f64 / 2.0,
        runner_up: next.map(|axis| (motions[axis], swings[axis].range / 2.0)),
    })
}

/// Returns the fingers that play over the whole of a stretch, if any.
pub(super) fn find_finger_play(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    first: usize,
    last: usize,
) -> Option<HandSway> {
    let column = |digit: usize| -> Vec<f64> {
        let digit_angle = |n: usize| match digit {
            0 => track.angles[n].thumb.radial,
            _ => track.angles[n].fingers[digit - 1].flexion[0],
        };
        (first..=last).map(digit_angle).collect()
    };
    let columns: [Vec<f64>; 5] = std::array::from_fn(column);
    let swings = columns
        .each_ref()
        .map(|column| SwingStatistics::from_swing_values(column));
    let playing: Vec<usize> = (0..5)
        .filter(|&digit| swings[digit].turning >= 3 && swings[digit].range > tuned().sway.sway * scene.loose)
        .collect();
    if playing.len() < 2 {
        return None;
    }
    // Fingers that bend together change the handshape; they do not play.
    let apart = playing
        .windows(2)
        .any(|pair| swing_correlation(&columns[pair[0]], &columns[pair[1]]).abs() < 0.75);
    let often = playing
        .iter()
        .any(|&digit| swings[digit].turning as f64 / scene.frames_to_seconds(last - first) > 4.0);
    let digits = playing.iter().map(|&digit| HandDigit::ALL_HAND_DIGITS[digit]).collect();
    let turning: usize = playing.iter().map(|&digit| swings[digit].turning).sum();
    (apart && often).then_some(HandSway::Play {
        digits: DigitList(digits),
        cycles: turning as f64 / (2 * playing.len()) as f64,
    })
}

/// The statistics of a number that moves to and fro.
#[derive(Debug, Clone, Copy)]
struct SwingStatistics {
    range: f64,
    /// The number of reversals.
    turning: usize,
    /// Where in its range it starts, from 0 to 1.
    start: f64,
    /// The difference between its end and its start.
    net: f64,
}

impl SwingStatistics {
    fn from_swing_values(values: &[f64]) -> Self {
        let (low, high) = values
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), &v| (l.min(v), h.max(v)));
        let range = high - low;
        let (mut turning, mut up, mut edge) = (0, None, values[0]);
        // A reversal counts from three tenths of the range on, so that trembling adds none.
        for &value in values {
            let back = match up {
                None => {
                    if (value - edge).abs() > 0.3 * range {
                        up = Some(value > edge);
                        edge = value;
                    }
                    continue;
                }
                Some(true) => edge - value,
                Some(false) => value - edge,
            };
            if back < 0.0 {
                edge = value;
            } else if back > 0.3 * range {
                turning += 1;
                up = up.map(|up| !up);
                edge = value;
            }
        }
        let last = values[values.len() - 1];
        Self {
            range,
            turning: if range > 1e-9 { turning } else { 0 },
            start: (values[0] - low) / range.max(1e-9),
            net: (last - values[0]).abs(),
        }
    }
}

fn swing_correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let [ab, aa, bb] = a.iter().zip(b).fold([0.0; 3], |[ab, aa, bb], (x, y)| {
        let (x, y) = (x - ma, y - mb);
        [ab + x * y, aa + x * x, bb + y * y]
    });
    ab / (aa * bb).sqrt().max(1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reversals_are_counted_and_small_ones_ignored() {
        for (values, range, turning, start, net) in [
            (&[0.0, 1.0, 2.0][..], 2.0, 0, 0.0, 2.0),
            (&[0.0, 2.0, 0.0], 2.0, 1, 0.0, 0.0),
            (&[1.0, 2.0, 0.0, 2.0, 1.0], 2.0, 3, 0.5, 0.0),
            (&[2.0, 0.0, 1.0], 2.0, 1, 1.0, 1.0),
            (&[3.0, 3.0, 3.0], 0.0, 0, 0.0, 0.0),
            // Half a unit is less than three tenths of the range.
            (&[0.0, 1.0, 0.5, 2.0, 1.5, 2.0], 2.0, 0, 0.0, 2.0),
            (&[0.0, 2.0, 1.3, 2.0, 0.0], 2.0, 3, 0.0, 0.0),
            (&[-1.0, -3.0, -1.0, -3.0], 2.0, 2, 1.0, 2.0),
        ] {
            let is = SwingStatistics::from_swing_values(values);
            assert_eq!((is.range, is.turning), (range, turning), "{values:?}");
            assert!((is.start - start).abs() < 1e-9, "{values:?}: {}", is.start);
            assert!((is.net - net).abs() < 1e-9, "{values:?}: {}", is.net);
        }
    }

    #[test]
    fn correlation_is_that_of_its_definition() {
        let one = [1.0, 2.0, 3.0, 4.0];
        for (other, is) in [
            ([2.0, 4.0, 6.0, 8.0], 1.0),
            ([7.0, 5.0, 3.0, 1.0], -1.0),
            ([1.0, -1.0, -1.0, 1.0], 0.0),
            // Deviations (-3, -1, 1, 3) / 2 and (-1, 1, -1, 1): 2 / √(5 · 4).
            ([0.0, 2.0, 0.0, 2.0], 2.0 / 20f64.sqrt()),
            ([5.0; 4], 0.0),
        ] {
            let found = swing_correlation(&one, &other);
            assert!((found - is).abs() < 1e-9, "{other:?}: {found}");
        }
    }
}
