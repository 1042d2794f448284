//! The course of a transition, with a learned one beside those that formulas give.

use chereme_motion::Interpolation;
use chereme_motion::glam::DQuat;

use crate::recipe::Profile;

/// How a transition runs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Course {
    Formula(Interpolation),
    /// Shares of the way at equal steps of time, from 0 to 1.
    Learned(Vec<f64>),
}

impl Course {
    /// Returns the course that `profile` names; nothing for a learned one that is not there.
    pub(crate) fn of(profile: Profile, learned: Option<&[f64]>) -> Option<Self> {
        Some(match profile {
            Profile::Slerp => Self::Formula(Interpolation::Slerp),
            Profile::Cosine => Self::Formula(Interpolation::Cosine),
            Profile::Sigmoid => Self::Formula(Interpolation::Sigmoid),
            Profile::MinimumJerk => Self::Formula(Interpolation::MinimumJerk),
            Profile::Learned => Self::Learned(learned.filter(|table| table.len() > 1)?.to_vec()),
        })
    }

    /// Returns the share of the way done at `w` from 0 to 1.
    pub(crate) fn share(&self, w: f64) -> f64 {
        match self {
            Self::Formula(way) => way.share(w),
            Self::Learned(table) => {
                let at = w.clamp(0.0, 1.0) * (table.len() - 1) as f64;
                let first = (at.floor() as usize).min(table.len() - 2);
                table[first] + (table[first + 1] - table[first]) * (at - first as f64)
            }
        }
    }

    /// Returns the rotation at `w` from `a` to `b`.
    pub(crate) fn rotation(&self, a: DQuat, b: DQuat, w: f64) -> DQuat {
        match self {
            Self::Formula(way) => way.rotation(a, b, w),
            Self::Learned(_) => a.slerp(b, self.share(w)).normalize(),
        }
    }
}
