//! The window skin: stage, timeline, search, recombination, history.
//!
//! [`run`] opens the window. It shows a `model` snapshot that a thread reads from
//! [`chereme_corpus`], and never waits for it; everything a person does is a
//! command, carried out after the frame or by a thread beside it.
//!
//! | module | holds |
//! |---|---|
//! | `app` | the window: one frame after the other |
//! | `action` | the table of everything that keys, menus and the palette can request |
//! | `command`, `dispatch` | every possible request, and the one place that carries requests out |
//! | `opening` | opens and closes corpora, takes newer snapshots |
//! | `context` | the input of a pane, its requests, and the selection |
//! | `model` | the corpus at one moment; movement in pieces around the playhead |
//! | `work` | use cases of the corpus on threads, with progress and stopping |
//! | `keys` | default keymaps as a table, the user's changes, matching |
//! | `words` | every text in English and French |
//! | `player` | the transport |
//! | `miniatures` | looping little figures, for any pane |
//! | `film` | the recording's films, in step with the playhead |
//! | `pickers` | boxes in which a value is chosen by its look |
//! | `share` | the contents of the stage as a film, a picture or a body |
//! | `clipboard`, `file_dialogs` | the clipboard and the file choosers of the system |
//! | `draft` | unfinished text, kept through a crash |
//! | `settings`, `layout`, `theme` | the stored settings, the places of the panes, colours and fonts |
//! | `script` | text in the scripts of the world: fonts, and text that is read from the right |
//! | `panes` | one module each: rows by plain functions in `data`, widgets in `ui` |
//! | `menu_and_status`, `start`, `overlay` | menus and status line, the page without a corpus, windows above the panes |
//! | `pixel_rects` | shapes as rectangles of whole pixels |
//! | `error` | the reasons why the window cannot open |

mod action;
mod app;
mod clipboard;
mod command;
mod context;
mod dispatch;
mod error;
mod file_dialogs;
mod film;
mod key_chord;
mod keys;
mod layout;
mod menu_and_status;
mod miniatures;
mod missing_file;
mod model;
mod opening;
mod overlay;
mod panes;
mod pickers;
mod pixel_rects;
mod player;
mod script;
mod settings;
mod share;
mod start;
mod theme;
mod window_remedy;
mod words;
mod work;
mod workbench;

use std::path::PathBuf;

pub use app::Studio;
pub use error::StudioError;
pub use settings::StudioFolders;
pub use words::InterfaceLanguage;

use eframe::egui::ViewportBuilder;

/// The settings that the window starts with.
#[derive(Debug, Clone, Default)]
pub struct StudioOptions {
    /// The corpus to open; the start page if `None`.
    pub corpus: Option<PathBuf>,
    /// Name of the person at work, for the history.
    pub author: String,
    /// Where settings and the starter corpus are kept.
    pub folders: StudioFolders,
    /// The language to use if the settings name none.
    pub language: InterfaceLanguage,
    /// The language requested for this start; it is stored in the settings.
    pub asked_language: Option<InterfaceLanguage>,
}

/// Opens the window, and returns after it is closed.
///
/// # Errors
/// [`StudioError::Window`] if the system has no display, or none that can draw.
pub fn run(options: StudioOptions) -> Result<(), StudioError> {
    let native = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_title("Chereme")
            .with_app_id("chereme")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([640.0, 420.0])
            .with_drag_and_drop(true),
        // Dithering smooths gradients, which only occur at the ends of lists; it is slow in windows drawn by software.
        dithering: false,
        // `script` finds fonts, for pictures too.
        system_font_fallback: false,
        ..eframe::NativeOptions::default()
    };
    let started = eframe::run_native("chereme", native, Box::new(move |_| Ok(Box::new(Studio::new(options)))));
    started.map_err(StudioError::from_window_error)
}
