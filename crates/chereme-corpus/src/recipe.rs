//! Recipes as trees, for skins that show and change their parts: what [`chereme_compose`] has of them.

pub use chereme_compose::recipe::*;
pub use chereme_compose::units::*;
pub use chereme_compose::{
    ChannelReport, JoinReport, PhaseRule, Problem, RecipeError, Report, Spline, StepReport,
    TextError,
};
