//! Learns the course of transitions from captured movement, and tests courses against it.
//!
//! A course is the progress of a transition over time: at each share of the time, the share of the path from one
//! posture to the next that is covered.

use std::ops::Range;
use std::sync::Arc;

use chereme_motion::Clip;
use chereme_motion::glam::{DQuat, DVec3};

use crate::course::TransitionCourse;
use crate::recipe_settings::TransitionProfile;

/// The number of steps of a learned course.
const LEARNED_COURSE_STEPS: usize = 64;
/// The least total rotation of the joints in a transition that counts, in radians.
const LEAST_TURN: f64 = 0.1;

/// A span of captured movement from one posture to another.
#[derive(Debug, Clone)]
pub struct CapturedStretch<'a> {
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
pub fn learn_course<'a>(stretches: impl IntoIterator<Item = CapturedStretch<'a>>) -> Option<Vec<f64>> {
    let mut learner = CourseLearner::default();
    for stretch in stretches {
        learner.add_captured_stretch(&stretch);
    }
    learner.learned_course()
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
            steps: vec![Vec::new(); LEARNED_COURSE_STEPS + 1],
        }
    }
}

impl CourseLearner {
    /// Adds a stretch; returns whether it counted.
    pub fn add_captured_stretch(&mut self, stretch: &CapturedStretch<'_>) -> bool {
        let Some(shares) = stretch_path_shares(stretch) else {
            return false;
        };
        let last = (shares.len() - 1) as f64;
        for (n, step) in self.steps.iter_mut().enumerate() {
            let position = n as f64 / LEARNED_COURSE_STEPS as f64 * last;
            let first = (position.floor() as usize).min(shares.len() - 2);
            step.push(shares[first] + (shares[first + 1] - shares[first]) * (position - first as f64));
        }
        true
    }

    /// Returns the number of stretches that counted.
    #[must_use]
    pub fn count_learned_transitions(&self) -> usize {
        self.steps[0].len()
    }

    /// Returns the course learned so far; `None` if no stretch counted.
    #[must_use]
    pub fn learned_course(&self) -> Option<Vec<f64>> {
        if self.count_learned_transitions() == 0 {
            return None;
        }
        let mut highest: f64 = 0.0;
        let rising = self.steps.iter().map(|step| {
            highest = highest.max(middle_half_mean(step.clone())).clamp(0.0, 1.0);
            highest
        });
        let mut course: Vec<f64> = rising.collect();
        course[0] = 0.0;
        course[LEARNED_COURSE_STEPS] = 1.0;
        Some(course)
    }
}

/// Returns the mean of the middle half of the values.
fn middle_half_mean(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let cut = values.len() / 4;
    let kept = &values[cut..values.len() - cut];
    kept.iter().sum::<f64>() / kept.len() as f64
}

/// Returns the clip with one stretch synthesised: its joints go from the stretch's first posture to its last by a
/// course. A comparison with the captured clip shows the accuracy of the course.
///
/// `learned` is the course for [`TransitionProfile::Learned`], as [`learn_course`] returns it; other profiles ignore it. Returns
/// `None` if the stretch is empty or outside of its clip, or if `profile` is [`TransitionProfile::Learned`] without a course.
#[must_use]
pub fn bridge_captured_stretch(
    stretch: &CapturedStretch<'_>,
    profile: TransitionProfile,
    learned: Option<&[f64]>,
) -> Option<Clip> {
    let course = TransitionCourse::with_profile(profile, learned)?;
    let clip = stretch.clip;
    let (first, last) = (stretch.frames.start, stretch.frames.end.checked_sub(1)?);
    if !is_stretch_inside_clip(stretch) {
        return None;
    }
    let mut channels = clip.joint_channels().to_vec();
    for &joint in stretch.joints {
        let column = &mut channels[joint].rotations;
        let (a, b) = (column[first], column[last]);
        let steps = (last - first).max(1) as f64;
        for (n, rotation) in column[first..=last].iter_mut().enumerate() {
            *rotation = course.rotation_along_course(a, b, n as f64 / steps);
        }
    }
    Clip::new(Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate(), channels).ok()
}

/// Returns whether a stretch is not empty, and its frames and joints are in its clip.
fn is_stretch_inside_clip(stretch: &CapturedStretch<'_>) -> bool {
    let clip = stretch.clip;
    !stretch.frames.is_empty()
        && stretch.frames.end <= clip.clip_frame_count()
        && stretch.joints.iter().all(|&joint| joint < clip.clip_skeleton().len())
}

/// Returns the share of the path covered in each frame; `None` for a stretch that does not count.
fn stretch_path_shares(stretch: &CapturedStretch<'_>) -> Option<Vec<f64>> {
    if !is_stretch_inside_clip(stretch) || stretch.frames.len() < 3 {
        return None;
    }
    let columns: Vec<&[DQuat]> = stretch
        .joints
        .iter()
        .map(|&joint| &stretch.clip.joint_channel(joint).rotations[stretch.frames.clone()])
        .collect();
    let last = stretch.frames.len() - 1;
    let displacements: Vec<DVec3> = columns
        .iter()
        .map(|column| shortest_rotation_vector(column[0], column[last]))
        .collect();
    let square_sum: f64 = displacements
        .iter()
        .map(|displacement| displacement.length_squared())
        .sum();
    // The share of a path that hardly moves is noise.
    if square_sum.sqrt() < LEAST_TURN {
        return None;
    }
    let share = |frame: usize| {
        let along = columns.iter().zip(&displacements);
        along
            .map(|(column, displacement)| shortest_rotation_vector(column[0], column[frame]).dot(*displacement))
            .sum::<f64>()
            / square_sum
    };
    Some((0..=last).map(share).collect())
}

/// Returns the shortest rotation from one rotation to another, as an axis multiplied by the angle.
fn shortest_rotation_vector(from: DQuat, to: DQuat) -> DVec3 {
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
        let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(captured.clip_skeleton());
        let joints = anatomy.arm_joints(chereme_motion::BodySide::Right);
        for (profile, at_a_fifth) in [
            (TransitionProfile::Slerp, 0.2),
            (TransitionProfile::MinimumJerk, 0.05792),
        ] {
            let stretch = CapturedStretch {
                clip: &captured,
                joints: &joints,
                frames: 10..60,
            };
            let made = bridge_captured_stretch(&stretch, profile, None).expect("inside");
            let course = learn_course([CapturedStretch {
                clip: &made,
                ..stretch.clone()
            }])
            .expect("turns");
            let at = |w: f64| TransitionCourse::Learned(course.clone()).covered_path_share(w);
            assert!((at(0.2) - at_a_fifth).abs() < 5e-3, "{profile:?} {}", at(0.2));
            assert!(course.windows(2).all(|w| w[0] <= w[1]) && (course[0], course[LEARNED_COURSE_STEPS]) == (0.0, 1.0));
            let again = bridge_captured_stretch(&stretch, TransitionProfile::Learned, Some(&course)).expect("inside");
            for &joint in &joints {
                for frame in 10..60 {
                    let (a, b) = (
                        &made.joint_channel(joint).rotations,
                        &again.joint_channel(joint).rotations,
                    );
                    assert!(a[frame].angle_between(b[frame]) < 0.01);
                }
            }
        }
    }

    #[test]
    fn transitions_unlike_the_others_do_not_count() {
        let shares = vec![0.4, 0.5, 9.0, 0.45, 0.55, -3.0, 0.5, 0.6];
        assert!((middle_half_mean(shares) - 0.5).abs() < 1e-12);
        assert!((middle_half_mean(vec![0.1, 0.4, 0.7]) - 0.4).abs() < 1e-12);
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
            let stretch = CapturedStretch {
                clip: &still,
                joints,
                frames,
            };
            assert_eq!(learn_course([stretch.clone()]), None);
            let inside = bridge_captured_stretch(&stretch, TransitionProfile::Slerp, None).is_some();
            assert_eq!(
                inside,
                joints.len() == 1 && stretch.frames.end <= 30 && !stretch.frames.is_empty()
            );
            assert!(bridge_captured_stretch(&stretch, TransitionProfile::Learned, None).is_none());
        }
    }
}
