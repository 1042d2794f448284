//! Settings of the stage that are kept between sessions.

use super::StagePane;
use super::stage_data::{StageExtras, StageEye, VIEW_ACTIONS};
use crate::settings::stage_settings::{DEFAULT_TRAIL_REACH_SECONDS, StageSettings};

impl StagePane {
    /// Returns these settings.
    pub(super) fn stage_settings(&self) -> StageSettings {
        let name = |eye: &StageEye| {
            let entry = VIEW_ACTIONS.iter().find(|(view, _)| *view == eye.view);
            entry.map_or(String::new(), |(_, action)| action.action_row().id.to_owned())
        };
        StageSettings {
            views: self.eyes.iter().map(name).collect(),
            trails: self.shows.trails.is_some(),
            reach: self.reach,
            ghosts: self.shows.ghosts,
            grid: self.shows.grid,
            points: self.shows.points,
            places: self.places,
            compare: self.compare,
            insets: self.insets,
        }
    }

    /// Applies settings to the stage; unknown views become the view from the front.
    pub(super) fn apply_stage_settings(&mut self, settings: &StageSettings) {
        let count = match settings.views.len() {
            0 | 1 => 1,
            2 => 2,
            _ => 4,
        };
        let eye = |nth: usize| {
            let name = settings.views.get(nth);
            let entry = VIEW_ACTIONS
                .iter()
                .find(|(_, action)| name.is_some_and(|name| name == action.action_row().id));
            entry.map_or(StageEye::default(), |(view, _)| StageEye::from_preset_view(*view))
        };
        self.eyes = (0..count).map(eye).collect();
        self.active = 0;
        self.reach = if settings.reach.is_finite() {
            settings.reach.clamp(0.1, 2.0)
        } else {
            DEFAULT_TRAIL_REACH_SECONDS
        };
        self.shows = StageExtras {
            trails: settings.trails.then_some(self.reach),
            ghosts: settings.ghosts,
            grid: settings.grid,
            points: settings.points,
        };
        (self.places, self.compare, self.insets) = (settings.places, settings.compare, settings.insets);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::stage_settings::OriginalComparison;

    #[test]
    fn view_settings_of_the_stage_are_restored() {
        let mut stage = StagePane::default();
        assert_eq!(stage.stage_settings(), StageSettings::default());
        stage.split_stage_views(4);
        (stage.places, stage.compare, stage.reach) = (true, OriginalComparison::Over, 1.5);
        (stage.insets.palms, stage.insets.hands) = (true, false);
        let settings = stage.stage_settings();
        let text = serde_json::to_string(&settings).expect("written");
        let read: StageSettings = serde_json::from_str(&text).expect("read");
        let mut other = StagePane::default();
        other.apply_stage_settings(&read);
        assert_eq!(other.stage_settings(), settings);
        let odd: StageSettings = serde_json::from_str(r#"{"views": ["a", "b", "c"], "reach": 1e99}"#).expect("read");
        other.apply_stage_settings(&odd);
        assert_eq!((other.eyes.len(), other.reach), (4, 2.0));
    }
}
