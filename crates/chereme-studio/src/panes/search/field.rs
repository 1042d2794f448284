//! The query as text: errors are marked at their place, and completions are offered.

use std::ops::Range;
use std::sync::Arc;

use chereme_corpus::kept_like;
use chereme_sign::query::{Query, QueryError};
use eframe::egui::text::{CCursor, CCursorRange, CharIndex, LayoutJob, TextFormat};
use eframe::egui::{
    Button, Color32, Galley, Key, Modifiers, Popup, PopupCloseBehavior, Response, RichText, Role,
    Stroke, TextBuffer, TextEdit, TextStyle, Ui, WidgetInfo,
};

use super::suggest::{self, Offers};
use crate::context::PaneInput;
use crate::overlay::remedy;
use crate::script::edit;
use crate::words::{fill, search as words, spoken};

/// The text of the query, and the state of its completions.
#[derive(Debug, Default)]
pub(crate) struct Field {
    pub(crate) text: String,
    /// The index of the completion at the keyboard cursor.
    at: Option<usize>,
    /// The text for which Escape closed the completions.
    away: Option<String>,
    /// Whether the pointer was over the completions.
    over: bool,
    focus: bool,
    /// The new place of the cursor, as a character index.
    cursor: Option<usize>,
}

/// The outcome of the field in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Typed {
    pub(crate) changed: bool,
    pub(crate) entered: bool,
    /// Whether the results take the keyboard.
    pub(crate) down: bool,
    /// Whether a word is still being written.
    pub(crate) unfinished: bool,
}

impl Field {
    pub(crate) fn take_focus(&mut self) {
        self.focus = true;
        self.cursor = Some(self.text.chars().count());
    }

    /// Sets another query; completions open again when it is changed.
    pub(crate) fn set(&mut self, text: String) {
        self.cursor = Some(text.chars().count());
        self.away = Some(text.clone());
        self.text = text;
    }

    /// Draws the field with its completions; `wrong` is the index of the first character of an error that the corpus
    /// reports.
    pub(crate) fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, wrong: Option<usize>) -> Typed {
        let id = ui.scope_id().with("query");
        let here = ui.memory(|memory| memory.has_focus(id));
        let mut typed = Typed::default();
        let cursor = self.cursor_in(ui, id);
        let offers = self.offers(seen, cursor, here);
        if here {
            typed = self.keys(ui, &offers);
        }
        let error = match suggest::kept_name(&self.text) {
            Some(_) => None,
            None => Query::parse(&self.text).err(),
        };
        let mark = mark(&self.text, error.as_ref(), wrong);
        let trouble = seen.colours().trouble;
        let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _wrap: f32| {
            marked(ui, text.as_str(), mark.clone(), trouble)
        };
        let before = self.text.clone();
        let label = seen.say(words::QUERY);
        let field = TextEdit::singleline(&mut self.text)
            .id(id)
            .hint_text(seen.say(words::HINT))
            .layouter(&mut layouter)
            .lock_focus(offers.is_some())
            .desired_width(f32::INFINITY);
        let mut output = edit::edged(ui, |ui| field.show(ui));
        edit::settle(ui, &mut output);
        let response: Response = output.response.response;
        let text = self.text.clone();
        response.widget_info(|| WidgetInfo {
            label: Some(label.to_owned()),
            ..WidgetInfo::text_edit(true, &before, &text, seen.say(words::HINT))
        });
        typed.changed |= response.changed();
        if response.changed() {
            self.at = None;
        }
        if std::mem::take(&mut self.focus) {
            response.request_focus();
        }
        if let Some(cursor) = self.cursor.take() {
            let mut state = output.state;
            let at = CCursor::new(CharIndex(cursor));
            state.cursor.set_char_range(Some(CCursorRange::one(at)));
            state.store(ui.ctx(), id);
        }
        typed.changed |= self.list(&response, seen, &offers);
        typed.unfinished = offers.is_some();
        self.error(ui, seen, error.as_ref(), &mut typed);
        typed
    }

    fn cursor_in(&self, ui: &Ui, id: eframe::egui::Id) -> usize {
        let state = TextEdit::load_state(ui.ctx(), id);
        let range = state.and_then(|state| state.cursor.char_range());
        range.map_or(self.text.chars().count(), |range| range.primary.index.0)
    }

    /// Returns the present completions.
    fn offers(&self, seen: &PaneInput<'_>, cursor: usize, here: bool) -> Option<Offers> {
        let put_away = self.away.as_deref() == Some(self.text.as_str());
        if !(here || self.over) || put_away || self.text.is_empty() {
            return None;
        }
        let offers = suggest::offers(&self.text, cursor, seen.snapshot, seen.language);
        (!offers.all.is_empty()).then_some(offers)
    }

    fn keys(&mut self, ui: &Ui, offers: &Option<Offers>) -> Typed {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let mut typed = Typed::default();
        let Some(offers) = offers else {
            typed.entered = pressed(Key::Enter);
            typed.down = pressed(Key::ArrowDown);
            return typed;
        };
        let last = offers.all.len() - 1;
        if pressed(Key::ArrowDown) {
            self.at = Some(self.at.map_or(0, |at| (at + 1).min(last)));
        }
        if pressed(Key::ArrowUp) {
            self.at = self.at.and_then(|at| at.checked_sub(1));
        }
        if pressed(Key::Escape) {
            self.away = Some(self.text.clone());
        }
        let tab = pressed(Key::Tab);
        let enter = pressed(Key::Enter);
        let taken = match (enter, tab, self.at) {
            (true, _, Some(at)) | (_, true, Some(at)) => Some(at),
            (_, true, None) => Some(0),
            (true, _, None) if offers.all.len() == 1 => Some(0),
            _ => None,
        };
        match taken {
            Some(at) => {
                let only = enter && self.at.is_none();
                typed.changed = self.take(offers, at);
                // This is the whole query, with no further choice left.
                typed.entered = only && Query::parse(&self.text).is_ok();
            }
            None => typed.entered = enter,
        }
        if typed.entered {
            self.away = Some(self.text.clone());
        }
        typed
    }

    fn take(&mut self, offers: &Offers, at: usize) -> bool {
        let Some(offer) = offers.all.get(at) else {
            return false;
        };
        let (text, cursor) = offers.take(&self.text, offer);
        self.text = text;
        self.cursor = Some(cursor);
        self.focus = true;
        self.at = None;
        true
    }

    /// Draws the completions below the field; returns whether one was taken.
    fn list(&mut self, field: &Response, seen: &PaneInput<'_>, offers: &Option<Offers>) -> bool {
        let Some(offers) = offers else {
            self.over = false;
            return false;
        };
        let popup = Popup::from_response(field)
            .open(true)
            .close_behavior(PopupCloseBehavior::IgnoreClicks)
            .accessible_name(seen.say(words::OFFERS));
        let mut taken = None;
        let shown = popup.show(|ui| {
            ui.set_max_width(field.rect.width().max(260.0));
            for (at, offer) in offers.all.iter().enumerate() {
                let chosen = self.at == Some(at);
                let button = Button::selectable(chosen, &offer.text)
                    .shortcut_text(RichText::new(&offer.about).small())
                    .min_size(eframe::egui::vec2(ui.available_width(), 0.0));
                let response = ui.add(button);
                response.widget_info(|| {
                    let name = fill(seen.say(words::OFFER), &[("text", &offer.text)]);
                    WidgetInfo::selected(Role::Button, true, chosen, name)
                });
                if response.clicked() {
                    taken = Some(at);
                }
            }
            ui.label(RichText::new(seen.say(words::OFFER_KEYS)).small().weak());
        });
        self.over = shown.is_some_and(|it| it.response.contains_pointer());
        taken.is_some_and(|at| self.take(offers, at))
    }

    /// Shows the error, and offers a correction if there is only one likely meaning.
    fn error(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        error: Option<&QueryError>,
        typed: &mut Typed,
    ) {
        if let Some(name) = suggest::kept_name(&self.text) {
            return self.unkept(ui, seen, name.trim().to_owned(), typed);
        }
        let Some(error) = error else { return };
        ui.horizontal_wrapped(|ui| {
            let end = self.text.trim_end().chars().count();
            // If the text is incomplete, nothing is wrong yet.
            let colour = if error.at.start >= end {
                ui.visuals().weak_text_color()
            } else {
                seen.colours().trouble
            };
            let message = spoken(&error.message, seen.language);
            let remedy = remedy::here(&error.remedy, seen.language);
            let words = match remedy.filter(|it| !it.is_empty()) {
                Some(remedy) => format!("{message}: {remedy}"),
                None => message,
            };
            ui.label(RichText::new(words).small().color(colour));
            if let (Some(mended), Some(suggestion)) =
                (error.corrected(&self.text), error.suggestion.as_ref())
            {
                let name = fill(seen.say(words::MEND), &[("text", suggestion)]);
                if ui.small_button(name).clicked() {
                    self.text = mended;
                    self.take_focus();
                    typed.changed = true;
                }
            }
        });
    }
}

impl Field {
    /// Reports that there is no saved search with that name, and offers the likeliest one.
    fn unkept(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, name: String, typed: &mut Typed) {
        if name.is_empty() || !suggest::is_unkept(&self.text, seen.snapshot) {
            return;
        }
        ui.horizontal_wrapped(|ui| {
            let text = fill(seen.say(words::NOT_KEPT), &[("name", &name)]);
            ui.label(RichText::new(text).small().color(seen.colours().trouble));
            let Some(meant) = kept_like(&name, &seen.snapshot.overview.searches) else {
                return;
            };
            let meant = format!("@{}", meant.name);
            let mend = fill(seen.say(words::MEND), &[("text", &meant)]);
            if ui.small_button(mend).clicked() {
                self.text = meant;
                self.take_focus();
                typed.changed = true;
            }
        });
    }
}

/// Returns the range of characters with an error.
pub(super) fn mark(
    text: &str,
    error: Option<&QueryError>,
    wrong: Option<usize>,
) -> Option<Range<usize>> {
    if let Some(error) = error {
        return Some(error.at.clone()).filter(|at| !at.is_empty());
    }
    let start = wrong?;
    let word = text
        .chars()
        .skip(start)
        .take_while(|c| !c.is_whitespace() && !",)".contains(*c))
        .count();
    Some(start..start + word.max(1))
}

/// Lays out a query, with a line below the error.
fn marked(ui: &Ui, text: &str, mark: Option<Range<usize>>, trouble: Color32) -> Arc<Galley> {
    let font = TextStyle::Body.resolve(ui.style());
    let plain = TextFormat::simple(font, ui.visuals().text_color());
    let mut job = LayoutJob::default();
    let mark = mark.unwrap_or(0..0);
    let byte = |at: usize| text.char_indices().nth(at).map_or(text.len(), |(at, _)| at);
    let (start, end) = (byte(mark.start), byte(mark.end));
    job.append(&text[..start], 0.0, plain.clone());
    if start < end {
        let wrong = TextFormat {
            underline: Stroke::new(2.0, trouble),
            ..plain.clone()
        };
        job.append(&text[start..end], 0.0, wrong);
    }
    job.append(&text[end..], 0.0, plain);
    job.wrap.max_width = f32::INFINITY;
    edit::lay_out(ui, job)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_marked_at_their_position() {
        let text = "right.confguration=U placement=chinn";
        let error = Query::parse(text).expect_err("a slip");
        assert_eq!(mark(text, Some(&error), None), Some(6..18));
        assert_eq!(mark(text, None, Some(31)), Some(31..36));
        assert_eq!(mark(text, None, None), None);
    }
}
