//! Learns the course of transitions from captured movement, and tests courses against it.
//!
//! A course is the progress of a transition over time: at each share of the time, the share of the path from one
//! posture to the next that is covered.

use std::ops::Range;
use std::sync::Arc;

use chereme_motion::Clip;
use chereme_motion::glam::{DQuat, DVec3};

use crate::course::Course;
use crate::recipe::Profile;

/// The number of steps of a learned course.
const STEPS: usize = 64;
/// The least total rotation of the joints in a transition that counts, in radians.
const LEAST_TURN: f64 = 0.1;

/// A span of captured movement from one posture to another.
#[derive(Debug, Clone)]
pub struct Stretch<'a> {
    /// The movement.
    pub clip: &'a Clip,
    /// The joints of the transition, such as those of an arm or of a hand's fingers.
    pub joints: &'a [usize],
    /// The frames: the first shows the one posture, the last the other.
    pub frames: Range<usize>,
}

/// Returns the usual course of transitions: shares of the path at equal steps of time, from 0 to 1, never falling.
///
/// The rotations of all joints from the first frame to the last, multiplied by the share of a frame, fit the rotations
/// from the first frame to this one best, by least squares; rotations about other axes do not count. Each step takes
/// the mean of the middle half of all transitions, so that transitions that overshoot or wait do not bend the course.
/// Stretches of fewer than three frames, outside of their clip, or with joints that hardly rotate are left out; without
/// any stretch the result is `None`.
#[must_use]
pub fn learn_course<'a>(stretches: impl IntoIterator<Item = Stretch<'a>>) -> Option<Vec<f64>> {
    let mut learner = CourseLearner::default();
    for stretch in stretches {
        learner.add(&stretch);
    }
    learner.course()
}

/// Learns a course as [`learn_course`] does, stretch by stretch.
#[derive(Debug, Clone)]
pub struct CourseLearner {
    /// The shares of all transitions at each step.
    steps: Vec<Vec<f64>>,
}

impl Default for CourseLearner {
    fn default() -> Self {
        Self {
            steps: vec![Vec::new(); STEPS + 1],
        }
    }
}

impl CourseLearner {
    /// Adds a stretch; returns whether it counted.
    pub fn add(&mut self, stretch: &Stretch<'_>) -> bool {
        let Some(shares) = shares(stretch) else {
            return false;
        };
        let last = (shares.len() - 1) as f64;
        for (n, step) in self.steps.iter_mut().enumerate() {
            let at = n as f64 / STEPS as f64 * last;
            let first = (at.floor() as usize).min(shares.len() - 2);
            step.push(shares[first] + (shares[first + 1] - shares[first]) * (at - first as f64));
        }
        true
    }

    /// Returns the number of stretches that counted.
    #[must_use]
    pub fn transitions(&self) -> usize {
        self.steps[0].len()
    }

    /// Returns the course learned so far; `None` if no stretch counted.
    #[must_use]
    pub fn course(&self) -> Option<Vec<f64>> {
        if self.transitions() == 0 {
            return None;
        }
        let mut highest: f64 = 0.0;
        let rising = self.steps.iter().map(|step| {
            highest = highest.max(middle(step.clone())).clamp(0.0, 1.0);
            highest
        });
        let mut course: Vec<f64> = rising.collect();
        course[0] = 0.0;
        course[STEPS] = 1.0;
        Some(course)
    }
}

/// Returns the mean of the middle half of the values.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let cut = values.len() / 4;
    let kept = &values[cut..values.len() - cut];
    kept.iter().sum::<f64>() / kept.len() as f64
}

/// Returns the clip with one stretch synthesised: its joints go from the stretch's first posture to its last by a
/// course. A comparison with the captured clip shows the accuracy of the course.
///
/// `learned` is the course for [`Profile::Learned`], as [`learn_course`] returns it; other profiles ignore it. Returns
/// `None` if the stretch is empty or outside of its clip, or if `profile` is [`Profile::Learned`] without a course.
#[must_use]
pub fn bridge(stretch: &Stretch<'_>, profile: Profile, learned: Option<&[f64]>) -> Option<Clip> {
    let course = Course::of(profile, learned)?;
    let clip = stretch.clip;
    let (first, last) = (stretch.frames.start, stretch.frames.end.checked_sub(1)?);
    if !is_inside(stretch) {
        return None;
    }
    let mut channels = clip.channels().to_vec();
    for &joint in stretch.joints {
        let column = &mut channels[joint].rotations;
        let (a, b) = (column[first], column[last]);
        let steps = (last - first).max(1) as f64;
        for (n, rotation) in column[first..=last].iter_mut().enumerate() {
            *rotation = course.rotation(a, b, n as f64 / steps);
        }
    }
    Clip::new(Arc::clone(clip.skeleton()), clip.rate(), channels).ok()
}

/// Returns whether a stretch is not empty, and its frames and joints are in its clip.
fn is_inside(stretch: &Stretch<'_>) -> bool {
    let clip = stretch.clip;
    !stretch.frames.is_empty()
        && stretch.frames.end <= clip.frames()
        && stretch
            .joints
            .iter()
            .all(|&joint| joint < clip.skeleton().len())
}

/// Returns the share of the path covered in each frame; `None` for a stretch that does not count.
fn shares(stretch: &Stretch<'_>) -> Option<Vec<f64>> {
    if !is_inside(stretch) || stretch.frames.len() < 3 {
        return None;
    }
    let columns: Vec<&[DQuat]> = stretch
        .joints
        .iter()
        .map(|&joint| &stretch.clip.channel(joint).rotations[stretch.frames.clone()])
        .collect();
    let last = stretch.frames.len() - 1;
    let displacements: Vec<DVec3> = columns
        .iter()
        .map(|column| turn(column[0], column[last]))
        .collect();
    let whole: f64 = displacements
        .iter()
        .map(|displacement| displacement.length_squared())
        .sum();
    if whole.sqrt() < LEAST_TURN {
        return None;
    }
    let share = |frame: usize| {
        let along = columns.iter().zip(&displacements);
        along
            .map(|(column, displacement)| turn(column[0], column[frame]).dot(*displacement))
            .sum::<f64>()
            / whole
    };
    Some((0..=last).map(share).collect())
}

/// Returns the shortest rotation from one rotation to another, as an axis multiplied by the angle.
fn turn(from: DQuat, to: DQuat) -> DVec3 {
    let turn = from.inverse() * to;
    let short = if turn.w < 0.0 { -turn } else { turn };
    short.to_scaled_axis()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Axes, clip, skeleton};

    #[test]
    fn a_speed_profile_is_learned_from_movement_generated_by_it() {
        let captured = clip(&Arc::new(skeleton(Axes::Odd, 1.0)), 120, 0.0);
        let anatomy = chereme_motion::Anatomy::detect(captured.skeleton());
        let joints = anatomy.arm_joints(chereme_motion::Side::Right);
        for (profile, at_a_fifth) in [(Profile::Slerp, 0.2), (Profile::MinimumJerk, 0.05792)] {
            let stretch = Stretch {
                clip: &captured,
                joints: &joints,
                frames: 10..60,
            };
            let made = bridge(&stretch, profile, None).expect("inside");
            let course = learn_course([Stretch {
                clip: &made,
                ..stretch.clone()
            }])
            .expect("turns");
            let at = |w: f64| Course::Learned(course.clone()).share(w);
            assert!(
                (at(0.2) - at_a_fifth).abs() < 5e-3,
                "{profile:?} {}",
                at(0.2)
            );
            assert!(
                course.windows(2).all(|w| w[0] <= w[1]) && (course[0], course[STEPS]) == (0.0, 1.0)
            );
            let again = bridge(&stretch, Profile::Learned, Some(&course)).expect("inside");
            for &joint in &joints {
                for frame in 10..60 {
                    let (a, b) = (
                        &made.channel(joint).rotations,
                        &again.channel(joint).rotations,
                    );
                    assert!(a[frame].angle_between(b[frame]) < 0.01);
                }
            }
        }
    }

    #[test]
    fn transitions_unlike_the_others_do_not_count() {
        let shares = vec![0.4, 0.5, 9.0, 0.45, 0.55, -3.0, 0.5, 0.6];
        assert!((middle(shares) - 0.5).abs() < 1e-12);
        assert!((middle(vec![0.1, 0.4, 0.7]) - 0.4).abs() < 1e-12);
    }

    #[test]
    fn stretches_without_movement_are_skipped() {
        let still = clip(&Arc::new(skeleton(Axes::Plain, 1.0)), 30, 0.0);
        for (joints, frames) in [
            (&[0usize][..], 0..30),
            (&[3, 99], 0..30),
            (&[3], 20..90),
            (&[3], 4..5),
            (&[3], 9..9),
        ] {
            let stretch = Stretch {
                clip: &still,
                joints,
                frames,
            };
            assert_eq!(learn_course([stretch.clone()]), None);
            let inside = bridge(&stretch, Profile::Slerp, None).is_some();
            assert_eq!(
                inside,
                joints.len() == 1 && stretch.frames.end <= 30 && !stretch.frames.is_empty()
            );
            assert!(bridge(&stretch, Profile::Learned, None).is_none());
        }
    }
}
