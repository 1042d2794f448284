//! The window skin: stage, timeline, search, recombination, history.
//!
//! [`run`] opens the window. It shows a `model` snapshot that a thread reads from
//! [`chereme_corpus`], and never waits for it; everything a person does is a
//! command, carried out after the frame or by a thread beside it.
//!
//! Each room uses only rooms in the lines above its own, or earlier in its line; a test of the arrows keeps it so.
//!
//! | module | holds |
//! |---|---|
//! | `words`, `error` | every text; the reasons why the window cannot open |
//! | `pixel_rects`, `player`, `window_remedy` | shapes as rectangles of whole pixels; the transport; remedies in the window's words |
//! | `key_chord`, `layout` | keys with modifiers, default keymaps; the panes by name, and their places |
//! | `model`, `film`, `work` | the corpus at one moment, what is shown and selected; films; use cases on threads |
//! | `settings`, `theme`, `script` | the stored settings; colours and fonts; text in the scripts of the world |
//! | `action`, `keys`, `clipboard` | the table of everything that keys, menus and the palette can request; matching of keys |
//! | `command`, `file_dialogs` | every possible request as one value, and the requests of a frame; file choosers of the system |
//! | `miniatures`, `start_wall` | looping little figures, for any pane; the wall of signs without a corpus |
//! | `context` | what a pane sees while it draws |
//! | `pickers` | boxes in which a value is chosen by its look |
//! | `panes` | one module each: rows by plain functions, and widgets |
//! | `overlay`, `workbench` | windows above the panes; the tiles with the panes |
//! | `app` | the window: its frames, and one file each for keys, menus, requests, opening, sharing, the start page |

mod action;
mod app;
mod clipboard;
mod command;
mod context;
mod error;
mod file_dialogs;
mod film;
mod key_chord;
mod keys;
mod layout;
mod miniatures;
mod model;
mod overlay;
mod panes;
mod pickers;
mod pixel_rects;
mod player;
mod script;
mod settings;
mod start_wall;
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
