//! Courses of transitions: learned ones, and those of formulas.

use chereme_motion::InterpolationKind;
use chereme_motion::glam::DQuat;

use crate::recipe_settings::TransitionProfile;
use crate::sources::{LearnedCourse, LearnedProfile};

/// The courses of a transition: one for fingers, one for all other joints.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TransitionCourses {
    pub(crate) arms: TransitionCourse,
    pub(crate) fingers: TransitionCourse,
}

impl TransitionCourses {
    /// Returns the courses that `profile` names; `None` for learned ones that are missing.
    pub(crate) fn from_transition_profile(
        profile: TransitionProfile,
        learned: Option<&LearnedProfile>,
    ) -> Option<Self> {
        let shares = |course: Option<&'_ LearnedCourse>| course.map(|learned_course| learned_course.shares.clone());
        let [arms, fingers] = [
            shares(learned.and_then(LearnedProfile::of_arms)),
            shares(learned.and_then(LearnedProfile::of_fingers)),
        ];
        Some(Self {
            arms: TransitionCourse::with_profile(profile, arms.as_deref())?,
            fingers: TransitionCourse::with_profile(profile, fingers.as_deref())?,
        })
    }
}

/// The number of recordings that a description names.
const NAMED_RECORDING_COUNT: usize = 3;

/// Describes the source of learned courses for people.
pub(crate) fn describe_learned_profile(learned: &LearnedProfile) -> String {
    let count = |course: &Option<LearnedCourse>, whose: &str| {
        let course = course.as_ref()?;
        let names = &course.recordings;
        let more = match names.len().saturating_sub(NAMED_RECORDING_COUNT) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let of = match names.is_empty() {
            true => String::new(),
            false => format!(
                " in {}{more}",
                names[..names.len().min(NAMED_RECORDING_COUNT)].join(", ")
            ),
        };
        Some(format!("{} transitions of {whose}{of}", course.transitions))
    };
    let reaches = learned.reaches.as_ref().map(|reaches| reaches.course.clone());
    let count_texts = match reaches {
        Some(_) => [count(&reaches, "reaching arms"), count(&learned.fingers, "fingers")],
        None => [count(&learned.arms, "arms"), count(&learned.fingers, "fingers")],
    };
    let counts: Vec<String> = count_texts.into_iter().flatten().collect();
    format!("the course was learned from {}", counts.join(" and "))
}

/// The course of a transition: its progress over time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum TransitionCourse {
    Formula(InterpolationKind),
    /// Shares of the path at equal steps of time, from 0 to 1.
    Learned(Vec<f64>),
}

impl TransitionCourse {
    /// Returns the course that `profile` names; `None` for a learned one that is missing.
    pub(crate) fn with_profile(profile: TransitionProfile, learned: Option<&[f64]>) -> Option<Self> {
        Some(match profile {
            TransitionProfile::Slerp => Self::Formula(InterpolationKind::Slerp),
            TransitionProfile::Cosine => Self::Formula(InterpolationKind::Cosine),
            TransitionProfile::Sigmoid => Self::Formula(InterpolationKind::Sigmoid),
            TransitionProfile::MinimumJerk => Self::Formula(InterpolationKind::MinimumJerk),
            TransitionProfile::Learned => {
                let legal = |table: &&[f64]| table.len() > 1 && table.iter().all(|share| share.is_finite());
                Self::Learned(learned.filter(legal)?.to_vec())
            }
        })
    }

    /// Returns the share of the path covered at the share `w` of the time, from 0 to 1.
    pub(crate) fn covered_path_share(&self, w: f64) -> f64 {
        match self {
            Self::Formula(formula) => formula.interpolation_share(w),
            Self::Learned(table) => {
                let position = w.clamp(0.0, 1.0) * (table.len() - 1) as f64;
                let first = (position.floor() as usize).min(table.len() - 2);
                table[first] + (table[first + 1] - table[first]) * (position - first as f64)
            }
        }
    }

    /// Returns the rotation from `a` to `b` at the share `w` of the time.
    pub(crate) fn rotation_along_course(&self, a: DQuat, b: DQuat, w: f64) -> DQuat {
        match self {
            Self::Formula(formula) => formula.interpolate_rotation(a, b, w),
            Self::Learned(_) => a.slerp(b, self.covered_path_share(w)).normalize(),
        }
    }
}
