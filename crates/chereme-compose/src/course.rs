//! Courses of transitions: learned ones, and those of formulas.

use chereme_motion::Interpolation;
use chereme_motion::glam::DQuat;

use crate::recipe::Profile;
use crate::sources::{LearnedCourse, LearnedProfile};

/// The courses of a transition: one for fingers, one for all other joints.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Courses {
    pub(crate) arms: Course,
    pub(crate) fingers: Course,
}

impl Courses {
    /// Returns the courses that `profile` names; `None` for learned ones that are missing.
    pub(crate) fn of(profile: Profile, learned: Option<&LearnedProfile>) -> Option<Self> {
        let shares = |course: Option<&'_ LearnedCourse>| course.map(|it| it.shares.clone());
        let [arms, fingers] = [
            shares(learned.and_then(LearnedProfile::of_arms)),
            shares(learned.and_then(LearnedProfile::of_fingers)),
        ];
        Some(Self {
            arms: Course::of(profile, arms.as_deref())?,
            fingers: Course::of(profile, fingers.as_deref())?,
        })
    }
}

/// The number of recordings that a description names.
const NAMED: usize = 3;

/// Describes the source of learned courses for people.
pub(crate) fn describe(learned: &LearnedProfile) -> String {
    let count = |course: &Option<LearnedCourse>, whose: &str| {
        let course = course.as_ref()?;
        let names = &course.recordings;
        let more = match names.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let of = match names.is_empty() {
            true => String::new(),
            false => format!(" in {}{more}", names[..names.len().min(NAMED)].join(", ")),
        };
        Some(format!("{} transitions of {whose}{of}", course.transitions))
    };
    let reaches = learned
        .reaches
        .as_ref()
        .map(|reaches| reaches.course.clone());
    let counts = match reaches {
        Some(_) => [
            count(&reaches, "reaching arms"),
            count(&learned.fingers, "fingers"),
        ],
        None => [
            count(&learned.arms, "arms"),
            count(&learned.fingers, "fingers"),
        ],
    };
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    format!("the course was learned from {}", counts.join(" and "))
}

/// The course of a transition: its progress over time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Course {
    Formula(Interpolation),
    /// Shares of the path at equal steps of time, from 0 to 1.
    Learned(Vec<f64>),
}

impl Course {
    /// Returns the course that `profile` names; `None` for a learned one that is missing.
    pub(crate) fn of(profile: Profile, learned: Option<&[f64]>) -> Option<Self> {
        Some(match profile {
            Profile::Slerp => Self::Formula(Interpolation::Slerp),
            Profile::Cosine => Self::Formula(Interpolation::Cosine),
            Profile::Sigmoid => Self::Formula(Interpolation::Sigmoid),
            Profile::MinimumJerk => Self::Formula(Interpolation::MinimumJerk),
            Profile::Learned => {
                let legal =
                    |table: &&[f64]| table.len() > 1 && table.iter().all(|share| share.is_finite());
                Self::Learned(learned.filter(legal)?.to_vec())
            }
        })
    }

    /// Returns the share of the path covered at the share `w` of the time, from 0 to 1.
    pub(crate) fn share(&self, w: f64) -> f64 {
        match self {
            Self::Formula(formula) => formula.share(w),
            Self::Learned(table) => {
                let at = w.clamp(0.0, 1.0) * (table.len() - 1) as f64;
                let first = (at.floor() as usize).min(table.len() - 2);
                table[first] + (table[first + 1] - table[first]) * (at - first as f64)
            }
        }
    }

    /// Returns the rotation from `a` to `b` at the share `w` of the time.
    pub(crate) fn rotation(&self, a: DQuat, b: DQuat, w: f64) -> DQuat {
        match self {
            Self::Formula(formula) => formula.rotation(a, b, w),
            Self::Learned(_) => a.slerp(b, self.share(w)).normalize(),
        }
    }
}
