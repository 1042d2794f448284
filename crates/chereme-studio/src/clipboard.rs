//! The clipboard of the system, and pending requests for its text.

use eframe::egui::text_selection::LabelSelectionState;
use eframe::egui::{Context, Event, ViewportCommand};

use crate::action::Action;

/// How many frames to wait for the system's text.
const MAX_PASTE_WAIT_FRAMES: u32 = 4;

/// The text copied here, and the pending paste.
#[derive(Debug, Default)]
pub(crate) struct WindowClipboard {
    /// The last text copied here: pasted if the system's clipboard is empty.
    own: String,
    /// The text that came with the paste key.
    given: Option<String>,
    /// The action that waits for the system's text, and for how many frames it has waited.
    waits: Option<(Action, u32)>,
}

impl WindowClipboard {
    /// Puts a text on the system's clipboard.
    pub(crate) fn put_clipboard_text(&mut self, ctx: &Context, text: String) {
        ctx.copy_text(text.clone());
        self.own = text;
    }

    /// Stores the text that came with a key.
    pub(crate) fn store_pasted_text(&mut self, text: Option<String>) {
        if text.is_some() {
            self.given = text;
        }
    }

    /// Returns the text to paste. If it is not here yet, requests it from the system; [`take_awaited_paste`](Self::take_awaited_paste) returns it
    /// later.
    pub(crate) fn request_pasted_text(&mut self, ctx: &Context, action: Action) -> Option<String> {
        let given = self.given.take();
        if given.is_none() {
            ctx.send_viewport_cmd(ViewportCommand::RequestPaste);
            self.waits = Some((action, 0));
        }
        given
    }

    /// Returns the awaited text and its action once the text has come; after [`MAX_PASTE_WAIT_FRAMES`] frames the text copied here.
    pub(crate) fn take_awaited_paste(&mut self, ctx: &Context) -> Option<(Action, String)> {
        let (action, frames) = self.waits?;
        let text = ctx.input_mut(|input| {
            let is = |event: &Event| matches!(event, Event::Paste(_));
            let index = input.events.iter().position(is)?;
            match input.events.remove(index) {
                Event::Paste(text) => Some(text),
                _ => None,
            }
        });
        if text.is_none() && frames < MAX_PASTE_WAIT_FRAMES {
            self.waits = Some((action, frames + 1));
            ctx.request_repaint();
            return None;
        }
        self.waits = None;
        Some((action, text.unwrap_or_else(|| self.own.clone())))
    }

    pub(crate) fn is_waiting(&self) -> bool {
        self.waits.is_some()
    }
}

/// Returns whether the user has selected text of a label.
pub(crate) fn is_text_marked(ctx: &Context) -> bool {
    let marks = ctx.plugin::<LabelSelectionState>();
    marks.lock().has_selection()
}
