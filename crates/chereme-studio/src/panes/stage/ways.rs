//! How the stage is looked at, as it is remembered between sittings.

use serde::{Deserialize, Serialize};

use super::data::{Compare, Eye, Shows, VIEWS};
use super::{REACH, Stage};

/// The stage's settings that are remembered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct StageWays {
    /// The views that it is parted into, by the names of their actions.
    views: Vec<String>,
    trails: bool,
    /// How far trails reach, in seconds.
    reach: f64,
    ghosts: bool,
    grid: bool,
    points: bool,
    places: bool,
    inset: bool,
    compare: Compare,
}

impl Default for StageWays {
    fn default() -> Self {
        Self {
            views: vec!["view.front".to_owned()],
            trails: false,
            reach: REACH,
            ghosts: false,
            grid: false,
            points: true,
            places: false,
            inset: false,
            compare: Compare::default(),
        }
    }
}

impl StageWays {
    /// Returns how a stage is looked at.
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
            inset: stage.inset,
            compare: stage.compare,
        }
    }

    /// Has a stage looked at so; views that are not known are those from the front.
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
        (stage.places, stage.inset, stage.compare) = (self.places, self.inset, self.compare);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_is_looked_at_as_it_was() {
        let mut stage = Stage::default();
        assert_eq!(StageWays::of(&stage), StageWays::default());
        stage.split(4);
        (stage.places, stage.compare, stage.reach) = (true, Compare::Over, 1.5);
        stage.inset = true;
        let ways = StageWays::of(&stage);
        let text = serde_json::to_string(&ways).expect("written");
        let read: StageWays = serde_json::from_str(&text).expect("read");
        let mut other = Stage::default();
        read.take(&mut other);
        assert_eq!(StageWays::of(&other), ways);
        let odd: StageWays =
            serde_json::from_str(r#"{"views": ["a", "b", "c"], "reach": 1e99}"#).expect("read");
        odd.take(&mut other);
        assert_eq!((other.eyes.len(), other.reach), (4, 2.0));
    }
}
