//! The stored settings of the timeline.

use std::collections::BTreeSet;

use chereme_corpus::snap::SnapKinds;
use chereme_sign::tier::tier_spans::NeighbourMode;
use serde::{Deserialize, Serialize};

/// A lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum CurveLane {
    Speed,
    Aperture,
    Palm,
    Distance,
    /// The curves stored with the movement, each in its own lane.
    Face,
}

impl CurveLane {
    /// Returns the number of curves: one for each hand, or one for both.
    pub(crate) fn lane_curve_count(self) -> usize {
        match self {
            Self::Distance => 1,
            Self::Face => 0,
            _ => 2,
        }
    }
}

/// Settings of the timeline.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct TimelineSettings {
    /// How an edit treats neighbouring annotations.
    pub(crate) mode: NeighbourMode,
    /// The kinds of times that drags snap to.
    pub(crate) snaps: SnapKinds,
    /// The visible lanes of movement.
    pub(crate) lanes: BTreeSet<CurveLane>,
    /// The lanes that are folded to their names.
    pub(crate) folded_lanes: BTreeSet<CurveLane>,
    /// Whether a strip shows the whole recording while only a part is visible.
    pub(crate) overview: bool,
    /// Names of tiers whose children are folded.
    pub(crate) folded: BTreeSet<String>,
    /// Names of hidden tiers.
    pub(crate) hidden: BTreeSet<String>,
}

impl Default for TimelineSettings {
    fn default() -> Self {
        Self {
            mode: NeighbourMode::default(),
            snaps: SnapKinds::default(),
            lanes: BTreeSet::new(),
            folded_lanes: BTreeSet::new(),
            overview: true,
            folded: BTreeSet::new(),
            hidden: BTreeSet::new(),
        }
    }
}
