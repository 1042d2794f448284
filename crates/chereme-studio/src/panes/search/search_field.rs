//! The query as text: errors are marked at their place, and completions are offered.

use std::ops::Range;
use std::sync::Arc;

use chereme_corpus::kept_like;
use chereme_sign::query::{QueryError, TokenQuery};
use eframe::egui::text::{CCursor, CCursorRange, CharIndex, LayoutJob, TextFormat};
use eframe::egui::{
    Button, Color32, Galley, Key, Modifiers, Popup, PopupCloseBehavior, Response, RichText, Role, Stroke, TextBuffer,
    TextEdit, TextStyle, Ui, WidgetInfo,
};

use super::search_suggest::{self, CompletionOffers};
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::window_remedy;
use crate::words::{fill_text_braces, search_words as words, translate_library_message};

/// The text of the query, and the state of its completions.
#[derive(Debug, Default)]
pub(crate) struct QueryField {
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
pub(crate) struct QueryFieldOutcome {
    pub(crate) changed: bool,
    pub(crate) entered: bool,
    /// Whether the results take the keyboard.
    pub(crate) down: bool,
    /// Whether a word is still being written.
    pub(crate) unfinished: bool,
}

impl QueryField {
    pub(crate) fn take_focus(&mut self) {
        self.focus = true;
        self.cursor = Some(self.text.chars().count());
    }

    /// Sets another query; completions open again when it is changed.
    pub(crate) fn set_query_text(&mut self, text: String) {
        self.cursor = Some(text.chars().count());
        self.away = Some(text.clone());
        self.text = text;
    }

    /// Draws the field with its completions; `wrong` is the index of the first character of an error that the corpus
    /// reports.
    pub(crate) fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, wrong: Option<usize>) -> QueryFieldOutcome {
        let id = ui.scope_id().with("query");
        let here = ui.memory(|memory| memory.has_focus(id));
        let mut typed = QueryFieldOutcome::default();
        let cursor = self.cursor_in(ui, id);
        let offers = self.query_offers_at(seen, cursor, here);
        if here {
            typed = self.handle_query_keys(ui, &offers);
        }
        // A kept query is called by its name, which is no query itself.
        let error = match search_suggest::kept_name(&self.text) {
            Some(_) => None,
            None => TokenQuery::parse_query(&self.text).err(),
        };
        let mark = query_error_range(&self.text, error.as_ref(), wrong);
        let trouble = seen.pane_colours().trouble;
        let mut layouter =
            |ui: &Ui, text: &dyn TextBuffer, _wrap: f32| lay_out_marked_query(ui, text.as_str(), mark.clone(), trouble);
        let before = self.text.clone();
        let label = seen.say_text(words::QUERY);
        let field = TextEdit::singleline(&mut self.text)
            .id(id)
            .hint_text(seen.say_text(words::HINT))
            .layouter(&mut layouter)
            .lock_focus(offers.is_some())
            .desired_width(f32::INFINITY);
        let mut output = script_edit::draw_with_text_edge(ui, |ui| field.show(ui));
        script_edit::settle_text_cursor(ui, &mut output);
        let response: Response = output.response.response;
        let text = self.text.clone();
        response.widget_info(|| WidgetInfo {
            label: Some(label.to_owned()),
            ..WidgetInfo::text_edit(true, &before, &text, seen.say_text(words::HINT))
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
            let text_cursor = CCursor::new(CharIndex(cursor));
            state.cursor.set_char_range(Some(CCursorRange::one(text_cursor)));
            state.store(ui.ctx(), id);
        }
        typed.changed |= self.draw_completion_list(&response, seen, &offers);
        typed.unfinished = offers.is_some();
        self.show_query_error(ui, seen, error.as_ref(), &mut typed);
        typed
    }

    fn cursor_in(&self, ui: &Ui, id: eframe::egui::Id) -> usize {
        let state = TextEdit::load_state(ui.ctx(), id);
        let range = state.and_then(|state| state.cursor.char_range());
        range.map_or(self.text.chars().count(), |range| range.primary.index.0)
    }

    /// Returns the present completions.
    fn query_offers_at(&self, seen: &PaneInput<'_>, cursor: usize, here: bool) -> Option<CompletionOffers> {
        let put_away = self.away.as_deref() == Some(self.text.as_str());
        if !(here || self.over) || put_away || self.text.is_empty() {
            return None;
        }
        let offers = search_suggest::find_query_completions(&self.text, cursor, seen.snapshot, seen.language);
        (!offers.all.is_empty()).then_some(offers)
    }

    fn handle_query_keys(&mut self, ui: &Ui, offers: &Option<CompletionOffers>) -> QueryFieldOutcome {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let mut typed = QueryFieldOutcome::default();
        let Some(offers) = offers else {
            // Without completions these keys belong to the field and the results.
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
                typed.changed = self.apply_query_offer(offers, at);
                // This is the whole query, with no further choice left.
                typed.entered = only && TokenQuery::parse_query(&self.text).is_ok();
            }
            None => typed.entered = enter,
        }
        if typed.entered {
            self.away = Some(self.text.clone());
        }
        typed
    }

    fn apply_query_offer(&mut self, offers: &CompletionOffers, at: usize) -> bool {
        let Some(offer) = offers.all.get(at) else {
            return false;
        };
        let (text, cursor) = offers.apply_completion_offer(&self.text, offer);
        self.text = text;
        self.cursor = Some(cursor);
        self.focus = true;
        self.at = None;
        true
    }

    /// Draws the completions below the field; returns whether one was taken.
    fn draw_completion_list(
        &mut self,
        field: &Response,
        seen: &PaneInput<'_>,
        offers: &Option<CompletionOffers>,
    ) -> bool {
        let Some(offers) = offers else {
            self.over = false;
            return false;
        };
        let popup = Popup::from_response(field)
            .open(true)
            .close_behavior(PopupCloseBehavior::IgnoreClicks)
            .accessible_name(seen.say_text(words::OFFERS));
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
                    let name = fill_text_braces(seen.say_text(words::OFFER), &[("text", &offer.text)]);
                    WidgetInfo::selected(Role::Button, true, chosen, name)
                });
                if response.clicked() {
                    taken = Some(at);
                }
            }
            ui.label(RichText::new(seen.say_text(words::OFFER_KEYS)).small().weak());
        });
        self.over = shown.is_some_and(|popup| popup.response.contains_pointer());
        taken.is_some_and(|at| self.apply_query_offer(offers, at))
    }

    /// Shows the error, and offers a correction if there is only one likely meaning.
    fn show_query_error(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        error: Option<&QueryError>,
        typed: &mut QueryFieldOutcome,
    ) {
        if let Some(name) = search_suggest::kept_name(&self.text) {
            return self.unkept(ui, seen, name.trim().to_owned(), typed);
        }
        let Some(error) = error else { return };
        ui.horizontal_wrapped(|ui| {
            let end = self.text.trim_end().chars().count();
            // If the text is incomplete, nothing is wrong yet.
            let colour = if error.at.start >= end {
                ui.visuals().weak_text_color()
            } else {
                seen.pane_colours().trouble
            };
            let message = translate_library_message(&error.message, seen.language);
            let remedy = window_remedy::window_remedy_text(&error.remedy, seen.language);
            let words = match remedy.filter(|remedy| !remedy.is_empty()) {
                Some(remedy) => format!("{message}: {remedy}"),
                None => message,
            };
            ui.label(RichText::new(words).small().color(colour));
            if let (Some(mended), Some(suggestion)) = (error.corrected_query(&self.text), error.suggestion.as_ref()) {
                let name = fill_text_braces(seen.say_text(words::MEND), &[("text", suggestion)]);
                if ui.small_button(name).clicked() {
                    self.text = mended;
                    self.take_focus();
                    typed.changed = true;
                }
            }
        });
    }
}

impl QueryField {
    /// Reports that there is no saved search with that name, and offers the likeliest one.
    fn unkept(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, name: String, typed: &mut QueryFieldOutcome) {
        if name.is_empty() || !search_suggest::is_unkept(&self.text, seen.snapshot) {
            return;
        }
        ui.horizontal_wrapped(|ui| {
            let text = fill_text_braces(seen.say_text(words::NOT_KEPT), &[("name", &name)]);
            ui.label(RichText::new(text).small().color(seen.pane_colours().trouble));
            let Some(meant) = kept_like(&name, &seen.snapshot.overview.searches) else {
                return;
            };
            let correction = format!("@{}", meant.name);
            let mend = fill_text_braces(seen.say_text(words::MEND), &[("text", &correction)]);
            if ui.small_button(mend).clicked() {
                self.text = correction;
                self.take_focus();
                typed.changed = true;
            }
        });
    }
}

/// Returns the range of characters with an error.
pub(super) fn query_error_range(text: &str, error: Option<&QueryError>, wrong: Option<usize>) -> Option<Range<usize>> {
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
fn lay_out_marked_query(ui: &Ui, text: &str, mark: Option<Range<usize>>, trouble: Color32) -> Arc<Galley> {
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
    script_edit::lay_out_edited_text(ui, job)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_marked_at_their_position() {
        let text = "right.confguration=U placement=chinn";
        let error = TokenQuery::parse_query(text).expect_err("a slip");
        assert_eq!(query_error_range(text, Some(&error), None), Some(6..18));
        assert_eq!(query_error_range(text, None, Some(31)), Some(31..36));
        assert_eq!(query_error_range(text, None, None), None);
    }
}
