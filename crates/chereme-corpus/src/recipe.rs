//! Recipes as trees, for user interfaces that show and change their parts: re-exports of [`chereme_compose`].

pub use chereme_compose::recipe::*;
pub use chereme_compose::units::*;
pub use chereme_compose::{
    ChannelReport, GenerationReport, JoinReport, MeasuredSpline, PhaseRule, RecipeError, RecipeTextProblem, StepReport,
    TextError, TouchReport,
};
