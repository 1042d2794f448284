//! Settings of the timeline: stored, and changed by actions.

use crate::settings::timeline_settings::TimelineSettings;
use std::collections::BTreeSet;

use super::tier_spans::NeighbourMode;
use super::timeline_lanes;
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;

impl TimelineSettings {
    /// Returns the settings after an action; `None` if the action does not change them.
    pub(crate) fn settings_after_action(&self, action: Action) -> Option<Self> {
        let mut settings = self.clone();
        match action {
            Action::ModeNormal => settings.mode = NeighbourMode::Normal,
            Action::ModeBulldozer => settings.mode = NeighbourMode::Bulldozer,
            Action::ModeShift => settings.mode = NeighbourMode::Shift,
            Action::SnapFrames => settings.snaps.frames = !settings.snaps.frames,
            Action::SnapBoundaries => settings.snaps.boundaries = !settings.snaps.boundaries,
            Action::SnapMinima => settings.snaps.minima = !settings.snaps.minima,
            Action::Overview => settings.overview = !settings.overview,
            Action::ShowTiers => settings.hidden.clear(),
            _ => {
                let (lane, ..) = timeline_lanes::CURVE_LANES
                    .into_iter()
                    .find(|(_, of, _)| *of == action)?;
                toggle_in_set(&mut settings.lanes, lane);
            }
        }
        Some(settings)
    }

    /// Returns whether the setting that an action switches or chooses is on; `false` for other actions.
    pub(crate) fn is_on(&self, action: Action) -> bool {
        match action {
            Action::ModeNormal => self.mode == NeighbourMode::Normal,
            Action::ModeBulldozer => self.mode == NeighbourMode::Bulldozer,
            Action::ModeShift => self.mode == NeighbourMode::Shift,
            Action::SnapFrames => self.snaps.frames,
            Action::SnapBoundaries => self.snaps.boundaries,
            Action::SnapMinima => self.snaps.minima,
            Action::Overview => self.overview,
            _ => timeline_lanes::CURVE_LANES
                .iter()
                .any(|(lane, of, _)| *of == action && self.lanes.contains(lane)),
        }
    }
}

/// Adds a thing to a set, or removes it.
pub(crate) fn toggle_in_set<T: Ord>(set: &mut BTreeSet<T>, it: T) {
    if !set.remove(&it) {
        set.insert(it);
    }
}

/// Changes the timeline's settings.
pub(crate) fn change_timeline_settings(seen: &PaneInput<'_>, timeline: TimelineSettings) {
    let mut settings = seen.settings.clone();
    settings.timeline = timeline;
    seen.send_command(WindowCommand::Settings(Box::new(settings)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn switches_toggle_and_modes_exclude_each_other() {
        let mut settings = TimelineSettings::default();
        for action in [Action::SnapMinima, Action::LaneSpeed, Action::ModeShift] {
            assert!(!settings.is_on(action));
            settings = settings.settings_after_action(action).expect("its own");
            assert!(settings.is_on(action), "{action:?}");
        }
        assert!(!settings.is_on(Action::ModeNormal));
        settings = settings.settings_after_action(Action::LaneSpeed).expect("its own");
        assert!(!settings.is_on(Action::LaneSpeed));
        assert_eq!(settings.settings_after_action(Action::Undo), None);
    }
}
