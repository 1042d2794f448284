//! Settings of the stage that are kept between sessions.

use serde::{Deserialize, Serialize};

use super::stage_data::{OriginalComparison, StageExtras, StageEye, VIEW_ACTIONS, WantedInsets};
use super::{DEFAULT_TRAIL_REACH_SECONDS, StagePane};

/// The stored settings of the stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct StageSettings {
    /// The views of the panes, by the names of their actions.
    views: Vec<String>,
    trails: bool,
    /// Reach of trails, in seconds.
    reach: f64,
    ghosts: bool,
    grid: bool,
    points: bool,
    places: bool,
    compare: OriginalComparison,
    insets: WantedInsets,
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

impl StageSettings {
    /// Returns the settings of a stage.
    pub(super) fn from_stage_pane(stage: &StagePane) -> Self {
        let name = |eye: &StageEye| {
            let entry = VIEW_ACTIONS.iter().find(|(view, _)| *view == eye.view);
            entry.map_or(String::new(), |(_, action)| action.action_row().id.to_owned())
        };
        Self {
            views: stage.eyes.iter().map(name).collect(),
            trails: stage.shows.trails.is_some(),
            reach: stage.reach,
            ghosts: stage.shows.ghosts,
            grid: stage.shows.grid,
            points: stage.shows.points,
            places: stage.places,
            compare: stage.compare,
            insets: stage.insets,
        }
    }

    /// Applies the settings to a stage; unknown views become the view from the front.
    pub(super) fn apply_stage_settings(&self, stage: &mut StagePane) {
        let count = match self.views.len() {
            0 | 1 => 1,
            2 => 2,
            _ => 4,
        };
        let eye = |nth: usize| {
            let name = self.views.get(nth);
            let entry = VIEW_ACTIONS
                .iter()
                .find(|(_, action)| name.is_some_and(|name| name == action.action_row().id));
            entry.map_or(StageEye::default(), |(view, _)| StageEye::from_preset_view(*view))
        };
        stage.eyes = (0..count).map(eye).collect();
        stage.active = 0;
        stage.reach = if self.reach.is_finite() {
            self.reach.clamp(0.1, 2.0)
        } else {
            DEFAULT_TRAIL_REACH_SECONDS
        };
        stage.shows = StageExtras {
            trails: self.trails.then_some(stage.reach),
            ghosts: self.ghosts,
            grid: self.grid,
            points: self.points,
        };
        (stage.places, stage.compare, stage.insets) = (self.places, self.compare, self.insets);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_settings_of_the_stage_are_restored() {
        let mut stage = StagePane::default();
        assert_eq!(StageSettings::from_stage_pane(&stage), StageSettings::default());
        stage.split_stage_views(4);
        (stage.places, stage.compare, stage.reach) = (true, OriginalComparison::Over, 1.5);
        (stage.insets.palms, stage.insets.hands) = (true, false);
        let settings = StageSettings::from_stage_pane(&stage);
        let text = serde_json::to_string(&settings).expect("written");
        let read: StageSettings = serde_json::from_str(&text).expect("read");
        let mut other = StagePane::default();
        read.apply_stage_settings(&mut other);
        assert_eq!(StageSettings::from_stage_pane(&other), settings);
        let odd: StageSettings = serde_json::from_str(r#"{"views": ["a", "b", "c"], "reach": 1e99}"#).expect("read");
        odd.apply_stage_settings(&mut other);
        assert_eq!((other.eyes.len(), other.reach), (4, 2.0));
    }
}
