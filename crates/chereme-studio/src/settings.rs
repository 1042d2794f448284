//! The settings that the window keeps between sessions: a JSON file in the platform's settings folder.

pub(crate) mod stage_settings;
pub(crate) mod timeline_settings;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use egui_tiles::Tree;
use serde::{Deserialize, Serialize};

use crate::key_chord::{DefaultKeymap, ReboundKeys};
use crate::layout::PaneKind;
use crate::model::time_window::TimeWindow;
use crate::player::SteppingSettings;
use crate::settings::stage_settings::StageSettings;
use crate::settings::timeline_settings::TimelineSettings;
use crate::words::InterfaceLanguage;

/// How many recently opened corpora are kept.
const MAX_RECENT_CORPORA: usize = 12;

/// Light, dark, or the system's choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ThemeChoice {
    #[default]
    System,
    Light,
    Dark,
}

/// The stored settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct StudioSettings {
    pub(crate) language: InterfaceLanguage,
    pub(crate) theme: ThemeChoice,
    /// Scale of the interface; 1 is normal.
    pub(crate) scale: f32,
    pub(crate) keymap: DefaultKeymap,
    /// The user's own keys, by action id.
    pub(crate) keys: ReboundKeys,
    /// Recently opened corpora, the newest first.
    pub(crate) recent: Vec<PathBuf>,
    /// The folder of the last export.
    pub(crate) export_folder: Option<PathBuf>,
    /// Saved searches and recent queries.
    pub(crate) searches: SearchHistory,
    /// The user's task, which decides the usual layout.
    pub(crate) busy: crate::layout::BusyTask,
    /// The layout of the panes; the usual one if `None`.
    pub(crate) layout: Option<Tree<PaneKind>>,
    /// The layout in small windows; the usual one if `None`.
    pub(crate) small_layout: Option<Tree<PaneKind>>,
    /// Settings and visible parts of the timeline.
    pub(crate) timeline: TimelineSettings,
    /// Settings of step-and-repeat playback.
    pub(crate) stepping: SteppingSettings,
    /// Settings of the stage.
    pub(crate) stage: StageSettings,
    /// Whether the library is a list instead of a wall of figures.
    pub(crate) library_list: bool,
    /// The views of recent corpora, by path.
    pub(crate) views: BTreeMap<String, CorpusViewSettings>,
}

/// The view of one corpus.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct CorpusViewSettings {
    /// Names of tiers whose children are folded.
    pub(crate) folded: BTreeSet<String>,
    /// Names of hidden tiers.
    pub(crate) hidden: BTreeSet<String>,
    /// The view of each recording, by row id.
    pub(crate) windows: BTreeMap<i64, TimeWindow>,
}

/// How many recent queries are kept.
const MAX_RECENT_QUERIES: usize = 20;

/// Saved searches and recent queries.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct SearchHistory {
    /// Saved searches from before corpora stored them; the open corpus takes them over.
    pub(crate) saved: Vec<SavedSearch>,
    /// Recent queries, the newest first.
    pub(crate) recent: Vec<String>,
}

/// A saved query with its name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SavedSearch {
    pub(crate) name: String,
    pub(crate) query: String,
}

impl SearchHistory {
    /// Moves a query to the front of the recent ones; returns whether that changes anything.
    pub(crate) fn record_recent_query(&mut self, query: &str) -> bool {
        let query = query.trim();
        if query.is_empty() || self.recent.first().is_some_and(|first| first == query) {
            return false;
        }
        self.recent.retain(|known| known != query);
        self.recent.insert(0, query.to_owned());
        self.recent.truncate(MAX_RECENT_QUERIES);
        true
    }
}

impl Default for StudioSettings {
    fn default() -> Self {
        Self {
            language: InterfaceLanguage::default(),
            theme: ThemeChoice::default(),
            scale: 1.0,
            keymap: DefaultKeymap::default(),
            keys: ReboundKeys::new(),
            recent: Vec::new(),
            export_folder: None,
            searches: SearchHistory::default(),
            busy: crate::layout::BusyTask::default(),
            layout: None,
            small_layout: None,
            timeline: TimelineSettings::default(),
            stepping: SteppingSettings::default(),
            stage: StageSettings::default(),
            library_list: false,
            views: BTreeMap::new(),
        }
    }
}

impl StudioSettings {
    /// Reads the file, without entries that are unreadable; `None` if the file is missing or not JSON.
    pub(crate) fn read_settings_file(path: &Path) -> Option<Self> {
        let text = fs::read_to_string(path).ok()?;
        let mut value: serde_json::Value = serde_json::from_str(&text).ok()?;
        loop {
            match serde_json::from_value::<Self>(value.clone()) {
                Ok(settings) => return Some(settings.checked_settings()),
                Err(_) => forget_what_is_wrong(&mut value)?,
            }
        }
    }

    /// Writes the file, completely or not at all.
    pub(crate) fn write_settings_file(&self, path: &Path) -> io::Result<()> {
        write_whole(path, self)
    }

    /// Moves a corpus to the front of the recently opened ones.
    pub(crate) fn record_opened_corpus(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT_CORPORA);
        let known_views: BTreeSet<String> = self.recent.iter().map(|recent_path| view_of(recent_path)).collect();
        self.views.retain(|path, _| known_views.contains(path));
    }

    fn checked_settings(mut self) -> Self {
        self.scale = if self.scale.is_finite() {
            self.scale.clamp(0.5, 3.0)
        } else {
            1.0
        };
        self.stepping = self.stepping.clamped_stepping_settings();
        self
    }
}

/// Returns the key under which the view of a corpus is stored.
pub(crate) fn view_of(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Writes a JSON file, completely or not at all.
pub(crate) fn write_whole(path: &Path, it: &impl Serialize) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let text = serde_json::to_string_pretty(it)?;
    let new_path = path.with_extension("json.new");
    fs::write(&new_path, text)?;
    fs::rename(&new_path, path)
}

/// Removes the first entry that cannot be read by itself; returns `None` if there is no such entry.
fn forget_what_is_wrong(value: &mut serde_json::Value) -> Option<()> {
    let map = value.as_object_mut()?;
    let wrong = map.iter().find_map(|(key, entry)| {
        let alone = serde_json::json!({ key.as_str(): entry });
        serde_json::from_value::<StudioSettings>(alone)
            .is_err()
            .then(|| key.clone())
    })?;
    map.remove(&wrong);
    Some(())
}

/// The folders for the window's own files.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StudioFolders {
    /// Folder of the settings file; without it nothing is stored.
    pub config: Option<PathBuf>,
    /// Folder of the starter corpus.
    pub data: Option<PathBuf>,
}

impl StudioFolders {
    /// Returns the platform's own folders, from `variable`, which reads the environment.
    #[must_use]
    pub fn of_platform(variable: impl Fn(&str) -> Option<String>) -> Self {
        let folder = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
        let home = folder("HOME");
        let below = |path: &str| home.as_ref().map(|home| home.join(path));
        let (config, data) = if cfg!(target_os = "windows") {
            (folder("APPDATA"), folder("LOCALAPPDATA").or_else(|| folder("APPDATA")))
        } else if cfg!(target_os = "macos") {
            let support = below("Library/Application Support");
            (support.clone(), support)
        } else {
            (
                folder("XDG_CONFIG_HOME").or_else(|| below(".config")),
                folder("XDG_DATA_HOME").or_else(|| below(".local/share")),
            )
        };
        let app_folder = |path: Option<PathBuf>| path.map(|path| path.join("chereme"));
        Self {
            config: app_folder(config),
            data: app_folder(data),
        }
    }

    pub(crate) fn settings_file(&self) -> Option<PathBuf> {
        self.config.as_ref().map(|folder| folder.join("studio.json"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn queries_are_remembered_once_the_newest_first() {
        let mut searches = SearchHistory::default();
        assert!(
            searches.record_recent_query("x")
                && searches.record_recent_query("y")
                && searches.record_recent_query(" x ")
        );
        assert!(!searches.record_recent_query("x") && !searches.record_recent_query(" "));
        assert_eq!(searches.recent, ["x", "y"]);
    }

    #[test]
    fn settings_read_back_unchanged_and_invalid_entries_are_dropped() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep/studio.json");
        assert_eq!(StudioSettings::read_settings_file(&path), None);
        let mut settings = StudioSettings {
            language: InterfaceLanguage::French,
            scale: 1.25,
            ..StudioSettings::default()
        };
        settings
            .keys
            .insert("play.toggle".into(), vec!["F5".parse().expect("a chord")]);
        settings.record_opened_corpus(Path::new("a.chereme"));
        settings.record_opened_corpus(Path::new("b.chereme"));
        settings.record_opened_corpus(Path::new("a.chereme"));
        settings.layout = Some(crate::layout::layout_for_task(
            crate::layout::BusyTask::Annotating,
            false,
        ));
        settings.write_settings_file(&path).expect("written");
        assert_eq!(StudioSettings::read_settings_file(&path), Some(settings));
        let text = r#"{ "language": "french", "scale": 99, "keymap": "vi", "layout": 7, "more": 1 }"#;
        fs::write(&path, text).expect("written");
        let read = StudioSettings::read_settings_file(&path).expect("read");
        assert_eq!(
            (read.language, read.scale, read.keymap),
            (InterfaceLanguage::French, 3.0, DefaultKeymap::Elan)
        );
        fs::write(&path, "[").expect("written");
        assert_eq!(StudioSettings::read_settings_file(&path), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn folders_follow_the_platform() {
        let of = |pairs: &'static [(&str, &str)]| {
            StudioFolders::of_platform(move |name| {
                pairs
                    .iter()
                    .find(|(known, _)| *known == name)
                    .map(|(_, value)| (*value).to_owned())
            })
        };
        let folders = of(&[("HOME", "/h"), ("XDG_DATA_HOME", "/d"), ("XDG_CONFIG_HOME", "relative")]);
        assert_eq!(folders.config, Some(PathBuf::from("/h/.config/chereme")));
        assert_eq!(folders.data, Some(PathBuf::from("/d/chereme")));
        assert_eq!(of(&[]), StudioFolders::default());
    }
}
