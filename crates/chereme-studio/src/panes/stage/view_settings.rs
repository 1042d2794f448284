//! Settings of the stage that are kept between sessions.

use serde::{Deserialize, Serialize};

use super::data::{Compare, Eye, Insets, Shows, VIEWS};
use super::{REACH, Stage};

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
    compare: Compare,
    insets: Insets,
}

impl Default for StageSettings {
    fn default() -> Self {
        Self {
            views: vec!["view.front".to_owned()],
            trails: false,
            reach: REACH,
            ghosts: false,
            grid: false,
            points: true,
            places: false,
            compare: Compare::default(),
            insets: Insets::default(),
        }
    }
}

impl StageSettings {
    /// Returns the settings of a stage.
    pub(super) fn of(stage: &Stage) -> Self {
        let name = |eye: &Eye| {
            let found = VIEWS.iter().find(|(view, _)| *view == eye.view);
            found.map_or(String::new(), |(_, action)| action.row().id.to_owned())
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
    pub(super) fn take(&self, stage: &mut Stage) {
        let count = match self.views.len() {
            0 | 1 => 1,
            2 => 2,
            _ => 4,
        };
        let eye = |nth: usize| {
            let name = self.views.get(nth);
            let found = VIEWS
                .iter()
                .find(|(_, action)| name.is_some_and(|name| name == action.row().id));
            found.map_or(Eye::default(), |(view, _)| Eye::of(*view))
        };
        stage.eyes = (0..count).map(eye).collect();
        stage.active = 0;
        stage.reach = if self.reach.is_finite() {
            self.reach.clamp(0.1, 2.0)
        } else {
            REACH
        };
        stage.shows = Shows {
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
        let mut stage = Stage::default();
        assert_eq!(StageSettings::of(&stage), StageSettings::default());
        stage.split(4);
        (stage.places, stage.compare, stage.reach) = (true, Compare::Over, 1.5);
        (stage.insets.palms, stage.insets.hands) = (true, false);
        let settings = StageSettings::of(&stage);
        let text = serde_json::to_string(&settings).expect("written");
        let read: StageSettings = serde_json::from_str(&text).expect("read");
        let mut other = Stage::default();
        read.take(&mut other);
        assert_eq!(StageSettings::of(&other), settings);
        let odd: StageSettings =
            serde_json::from_str(r#"{"views": ["a", "b", "c"], "reach": 1e99}"#).expect("read");
        odd.take(&mut other);
        assert_eq!((other.eyes.len(), other.reach), (4, 2.0));
    }
}
