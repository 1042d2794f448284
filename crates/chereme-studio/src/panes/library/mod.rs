//! The library pane: lists of the recordings and the signs of the corpus.

pub(crate) mod data;
mod delete;
mod fit;
mod wall;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::Span;
use eframe::egui::{
    Align, EventFilter, Id, Key, Layout, Modifiers, Rect, RectAlign, Response, ScrollArea, Sense,
    Tooltip, Ui, Vec2, WidgetInfo, vec2,
};

use super::inspector::Thing;
use super::notated::Notated;
use super::without_movement::{self, Bare};
use super::{Acted, Carried, Pane};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::miniatures::{self, Cell, Motion};
use crate::script::edit;
use crate::words::{Language, fill, library as words};
use crate::work::{Ended, WorkId};
use data::{LibraryRow, Moves, SignRow};
use delete::Leaving;
use fit::Fitting;

/// Height of a row, in heights of a button.
const ROW: f32 = 2.1;
/// Side of the picture beside the row under the pointer, in points.
const LARGE: f32 = 220.0;

/// The contents of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum List {
    Recordings,
    Signs,
}

/// The pane.
#[derive(Default)]
pub(crate) struct Library {
    filter: String,
    /// The chosen list; signs if there are no recordings.
    list: Option<List>,
    rows: Rows,
    /// The row at the keyboard cursor, and the row to give the focus next.
    at: usize,
    reach: Option<usize>,
    /// The row with the keyboard focus.
    focused: Option<usize>,
    /// The scroll offset of the list, in points.
    scrolled: f32,
    /// The sign that was clicked last.
    chosen: Option<SignRow>,
    notated: Notated,
    leaving: Leaving,
    fitting: Fitting,
}

/// The filtered rows, computed again when their inputs change.
#[derive(Default)]
struct Rows {
    of: Option<(usize, String, Language)>,
    recordings: Vec<LibraryRow>,
    signs: Vec<SignRow>,
    /// The first sign of each recording.
    first: BTreeMap<i64, Span>,
}

impl Rows {
    fn update(&mut self, seen: &PaneInput<'_>, filter: &str) {
        let overview = &seen.snapshot.overview;
        let now = (
            Arc::as_ptr(overview) as usize,
            filter.to_owned(),
            seen.language,
        );
        if self.of.as_ref() == Some(&now) {
            return;
        }
        let origin = |source: data::Source| seen.say(source.text()).to_owned();
        let kind = |kind| seen.say(data::kind_text(kind)).to_owned();
        self.recordings = data::rows(&overview.recordings, filter, origin, kind);
        self.signs = data::signs(&overview.signs, &overview.recordings, filter, seen.language);
        self.first = wall::first_signs(&overview.signs);
        self.of = Some(now);
    }
}

impl Library {
    /// Returns the last chosen sign, for use in another pane.
    pub(crate) fn carried(&self) -> Option<Carried> {
        carried(self.chosen.as_ref()?)
    }

    fn listed(&self, seen: &PaneInput<'_>) -> List {
        let none = seen.snapshot.overview.recordings.is_empty();
        let usual = if none { List::Signs } else { List::Recordings };
        self.list.unwrap_or(usual)
    }

    /// Draws the choice between a wall of pictures and a list, from the right.
    fn layout_of_list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        for (as_list, name) in [(true, words::LIST), (false, words::WALL)] {
            let on = seen.settings.library_list == as_list;
            if ui.selectable_label(on, seen.say(name)).clicked() && !on {
                let mut settings = seen.settings.clone();
                settings.library_list = as_list;
                out.send(Command::Settings(Box::new(settings)));
                (self.scrolled, self.reach) = (0.0, None);
            }
        }
    }

    /// Draws the choice of the list, and the filter.
    fn head(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) -> List {
        let list = self.listed(seen);
        let overview = &seen.snapshot.overview;
        ui.horizontal_wrapped(|ui| {
            let all = [
                (
                    List::Recordings,
                    words::RECORDINGS,
                    overview.recordings.len(),
                ),
                (List::Signs, words::SIGNS, overview.signs.len()),
            ];
            for (of, name, count) in all {
                let name = fill(seen.say(name), &[("n", &count)]);
                if ui.selectable_label(list == of, name).clicked() && list != of {
                    (self.list, self.at, self.scrolled) = (Some(of), 0, 0.0);
                    self.reach = None;
                }
            }
        });
        let before = self.filter.clone();
        let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
        let from_the_right = Layout::right_to_left(Align::Center);
        let shown = ui
            .allocate_ui_with_layout(row, from_the_right, |ui| {
                self.layout_of_list(ui, seen, out);
                edit::line(ui, &mut self.filter, |field| {
                    field
                        .hint_text(seen.say(words::FILTER))
                        .desired_width(f32::INFINITY)
                })
            })
            .inner;
        let response = shown.response.response;
        let (name, text) = (seen.say(words::FILTER), self.filter.clone());
        response.widget_info(|| WidgetInfo {
            label: Some(name.to_owned()),
            ..WidgetInfo::text_edit(true, &before, &text, name)
        });
        if response.changed() {
            (self.at, self.scrolled) = (0, 0.0);
        }
        let down = response.has_focus()
            && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::ArrowDown));
        if down {
            self.reach = Some(0);
        }
        self.listed(seen)
    }

    /// Chooses a sign: shows it in its recording, or animates its notation. For a sign without either, the pane lists
    /// the possible actions.
    fn choose(&mut self, row: &SignRow, out: &mut Outbox) {
        self.chosen = Some(row.clone());
        let Some(token) = row.token else { return };
        self.notated.choose(row.moves, (token, &row.gloss), out);
    }

    /// Shows the chosen notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_made(&mut self, out: &mut Outbox) {
        self.notated.show(out);
    }

    /// Lists the possible actions for the chosen sign if it has no movement.
    fn hint(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some((row, token)) = self.chosen.as_ref().and_then(|row| Some((row, row.token?)))
        else {
            return;
        };
        let bare = match row.moves {
            Moves::Recorded(..) => return,
            Moves::Notated => self.notated.bare(token),
            Moves::Not => Some(Bare::Coded),
        };
        if let Some(bare) = bare {
            without_movement::show(ui, seen, out, (token, &row.gloss), &bare);
        }
    }

    fn scroll(&mut self, ui: &Ui, height: f32) -> ScrollArea {
        let area = ScrollArea::vertical().auto_shrink(false);
        let Some(at) = self.reach else { return area };
        let offset = super::scrolled_to(at, height, self.scrolled, ui.available_height());
        area.vertical_scroll_offset(offset)
    }

    /// Takes the arrow keys if a row of the list has the focus.
    fn keys(&mut self, ui: &Ui, total: usize) {
        if total == 0 || ui.memory(|memory| memory.focused()) != Some(row_id(self.at)) {
            return;
        }
        let mut to = None;
        ui.input_mut(|input| {
            for (key, by) in [
                (Key::ArrowUp, -1),
                (Key::ArrowDown, 1),
                (Key::PageUp, -8),
                (Key::PageDown, 8),
                (Key::Home, isize::MIN / 2),
                (Key::End, isize::MAX / 2),
            ] {
                if input.consume_key(Modifiers::NONE, key) {
                    to = Some(self.at.saturating_add_signed(by).min(total - 1));
                }
            }
        });
        if let Some(to) = to {
            (self.at, self.reach) = (to, Some(to));
        }
    }

    /// Gives the focus to the row that the keys moved to, and keeps the arrow keys in the list.
    fn focus(&mut self, ui: &Ui, response: &Response, at: usize) {
        if self.reach == Some(at) {
            self.reach = None;
            response.request_focus();
        }
        if response.has_focus() {
            self.at = at;
            self.focused = Some(at);
            let arrows = EventFilter {
                vertical_arrows: true,
                ..EventFilter::default()
            };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        }
    }

    fn recordings(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let rows = std::mem::take(&mut self.rows.recordings);
        let height = ui.spacing().interact_size.y * ROW;
        self.keys(ui, rows.len());
        let area = self.scroll(ui, height + ui.spacing().item_spacing.y);
        let shown = area.show_rows(ui, height, rows.len(), |ui, range| {
            for at in range {
                let row = &rows[at];
                let chosen = seen.shown.recording == Some(row.id);
                let lead = height - 4.0;
                let said = (row.name.as_str(), row.about.as_str());
                let response = super::list_row_at(ui, row_id(at), (height, lead), chosen, said);
                self.focus(ui, &response, at);
                if row.moves {
                    let motion = Motion::Span(row.id, row.whole);
                    figure(ui, seen, out, motion, &response, lead);
                }
                self.on_recording(seen, out, row, &response);
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
        self.rows.recordings = rows;
    }

    /// Handles clicks on a recording.
    fn on_recording(
        &mut self,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        row: &LibraryRow,
        response: &Response,
    ) {
        if response.clicked() {
            out.send(Command::Recording(row.id));
            out.send(Command::Look);
        }
        if response.double_clicked() {
            open_recipe(seen, Some(row.id), out);
        }
        response.context_menu(|ui| {
            if seen.snapshot.recipe_of(row.id).is_some() {
                let name = seen.say(Action::OpenRecipe.row().name);
                if ui.button(name).clicked() {
                    open_recipe(seen, Some(row.id), out);
                    ui.close();
                }
            }
            inspect(ui, seen, Thing::Recording(row.id), out);
            ui.separator();
            if row.has_markers {
                self.fit_entry(ui, seen, row, out);
            }
            let doomed = || delete::recording(row.id, &row.name);
            self.delete_entry(ui, seen, doomed, out);
        });
    }

    fn signs(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let rows = std::mem::take(&mut self.rows.signs);
        let height = ui.spacing().interact_size.y * ROW;
        self.keys(ui, rows.len());
        let area = self.scroll(ui, height + ui.spacing().item_spacing.y);
        let shown = area.show_rows(ui, height, rows.len(), |ui, range| {
            for at in range {
                self.sign(ui, seen, out, (at, &rows[at]), height);
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
        self.rows.signs = rows;
    }

    fn sign(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        (at, row): (usize, &SignRow),
        height: f32,
    ) {
        let chosen = self.chosen.as_ref().is_some_and(|it| it.gloss == row.gloss);
        let lead = height - 4.0;
        let said = (row.gloss.as_str(), row.about.as_str());
        let response = super::list_row_at(ui, row_id(at), (height, lead), chosen, said);
        self.focus(ui, &response, at);
        let motion = match (row.moves, row.token) {
            (Moves::Recorded(recording, span), _) => Some(Motion::Span(recording, span)),
            (Moves::Notated, Some(token)) if ui.is_rect_visible(response.rect) => {
                self.notated.get(token, &row.gloss, out).map(Motion::Made)
            }
            _ => None,
        };
        if let Some(motion) = &motion {
            figure(ui, seen, out, motion.clone(), &response, lead);
        }
        self.on_sign(seen, out, (row, motion), &response);
    }

    /// Handles clicks on a sign, and drags.
    fn on_sign(
        &mut self,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        (row, motion): (&SignRow, Option<Motion>),
        response: &Response,
    ) {
        if let Some(carried) = carried(row) {
            super::carry::drag(response, carried, motion);
        }
        if response.clicked() {
            self.choose(row, out);
        }
        let recording = recording_of(row);
        if response.double_clicked() {
            open_recipe(seen, recording, out);
        }
        response.context_menu(|ui| {
            let gloss = row.gloss.as_str();
            if let Some(token) = row.token {
                super::carry::menu(ui, seen, (token, gloss, recording), out);
                ui.separator();
            }
            self.delete_entry(ui, seen, || delete::sign(gloss), out);
        });
    }
}

/// Returns the widget id of the row at an index, whatever its contents.
fn row_id(at: usize) -> Id {
    Id::unique("library").with(at)
}

/// Returns the recording that contains a sign's citation form.
fn recording_of(row: &SignRow) -> Option<i64> {
    match row.moves {
        Moves::Recorded(recording, _) => Some(recording),
        _ => None,
    }
}

/// Opens the recipe of a recording that was made from one.
fn open_recipe(seen: &PaneInput<'_>, recording: Option<i64>, out: &mut Outbox) {
    if let Some((recipe, name)) = recording.and_then(|it| seen.snapshot.recipe_of(it)) {
        out.send(Command::Recipe(recipe, Some(name)));
    }
}

fn carried(row: &SignRow) -> Option<Carried> {
    let gloss = row.gloss.clone();
    row.token.map(|token| Carried { token, gloss })
}

fn figure(
    ui: &Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    motion: Motion,
    response: &Response,
    lead: f32,
) {
    let at = response.rect.left_center() + vec2(4.0 + lead / 2.0, 0.0);
    let mut cell = Cell::new(motion.clone(), Vec2::splat(lead));
    if response.hovered() || response.has_focus() {
        cell = cell.playing(miniatures::clock(ui));
    }
    let rect = Rect::from_center_size(at, cell.size);
    seen.little.paint(ui, seen, out, &cell, rect);
    let mut beside = Tooltip::for_enabled(response);
    beside.popup = beside.popup.align(RectAlign::RIGHT_START);
    beside.show(|ui| {
        let size = Vec2::splat(LARGE);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let large = Cell::new(motion, size).playing(miniatures::clock(ui));
        seen.little.paint(ui, seen, out, &large, rect);
    });
}

fn inspect(ui: &mut Ui, seen: &PaneInput<'_>, thing: Thing, out: &mut Outbox) {
    if ui.button(seen.say(words::INSPECT)).clicked() {
        out.send(Command::Inspect(thing));
        ui.close();
    }
}

impl Pane for Library {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.notated.follow(seen.snapshot.overview.generation);
        self.deletion(ui, seen, out);
        self.fitting(ui, seen, out);
        self.focused = None;
        let overview = &seen.snapshot.overview;
        if overview.recordings.is_empty() && overview.signs.is_empty() {
            ui.label(seen.say(words::EMPTY));
            if ui.button(seen.say(words::IMPORT)).clicked() {
                out.send(Command::Do(Action::Import));
            }
            return;
        }
        let list = self.head(ui, seen, out);
        self.rows.update(seen, &self.filter);
        if list == List::Signs {
            self.hint(ui, seen, out);
        }
        match list {
            List::Recordings if overview.recordings.is_empty() => {
                ui.label(seen.say(words::NO_RECORDINGS));
            }
            List::Signs if overview.signs.is_empty() => {
                ui.label(seen.say(words::NO_SIGNS));
            }
            List::Recordings if self.rows.recordings.is_empty() => {
                ui.label(seen.say(words::NONE_FIT));
            }
            List::Signs if self.rows.signs.is_empty() => {
                ui.label(seen.say(words::NO_SIGN_FITS));
            }
            _ if !seen.settings.library_list => self.wall(ui, seen, out, list),
            List::Recordings => self.recordings(ui, seen, out),
            List::Signs => self.signs(ui, seen, out),
        }
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::DeleteListed => self.delete_chosen(seen, out),
            Action::FitMarkers => self.fit_chosen(seen, out),
            _ => Acted::No,
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.notated.hear(id, ended);
        self.hear_deletion(id, ended);
        self.hear_people(id, ended);
    }
}
