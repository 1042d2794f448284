//! The stored settings of the stage.

use serde::{Deserialize, Serialize};

/// Usual reach of trails, in seconds.
pub(crate) const DEFAULT_TRAIL_REACH_SECONDS: f64 = 0.4;

/// How generated movement and its original are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum OriginalComparison {
    /// Side by side.
    #[default]
    Beside,
    /// The original above the generated movement, transparent.
    Over,
    /// Without the original.
    Alone,
}

impl OriginalComparison {
    pub(crate) const ALL_COMPARISONS: [Self; 3] = [Self::Beside, Self::Over, Self::Alone];

    pub(crate) fn next(self) -> Self {
        match self {
            Self::Beside => Self::Over,
            Self::Over => Self::Alone,
            Self::Alone => Self::Beside,
        }
    }
}

/// The close-ups in the corners of the stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct WantedInsets {
    /// Both hands.
    pub(crate) hands: bool,
    /// Whether hands are turned so that the palms are visible and the fingers point up.
    pub(crate) palms: bool,
    pub(crate) face: bool,
}

impl Default for WantedInsets {
    fn default() -> Self {
        Self {
            hands: true,
            palms: false,
            face: false,
        }
    }
}

/// The stored settings of the stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct StageSettings {
    /// The views of the panes, by the names of their actions.
    pub(crate) views: Vec<String>,
    pub(crate) trails: bool,
    /// Reach of trails, in seconds.
    pub(crate) reach: f64,
    pub(crate) ghosts: bool,
    pub(crate) grid: bool,
    pub(crate) points: bool,
    pub(crate) places: bool,
    pub(crate) compare: OriginalComparison,
    pub(crate) insets: WantedInsets,
}

impl Default for StageSettings {
    fn default() -> Self {
        Self {
            views: vec!["view.front".to_owned()],
            trails: false,
            reach: DEFAULT_TRAIL_REACH_SECONDS,
            ghosts: false,
            grid: false,
            points: true,
            places: false,
            compare: OriginalComparison::default(),
            insets: WantedInsets::default(),
        }
    }
}
