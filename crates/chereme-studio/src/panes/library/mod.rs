//! The library pane: lists of the recordings, the signs and the people of the corpus.

pub(crate) mod library_data;
mod library_delete;
mod library_fit;
mod library_wall;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::TimeSpan;
use eframe::egui::{
    Align, Id, Key, Layout, Modifiers, Rect, RectAlign, Response, ScrollArea, Sense, Tooltip, Ui, Vec2, WidgetInfo,
    vec2,
};

use super::notated_pane::AnimatedNotations;
use super::without_movement::{self, MovementAbsence};
use super::{ActionOutcome, PaneInterface};
use crate::action::Action;
use crate::command::{CommandOutbox, DraggedToken, WindowCommand};
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureMotion};
use crate::model::InspectedThing;
use crate::panes::list_keys;
use crate::script::script_edit;
use crate::words::{InterfaceLanguage, fill_text_braces, library as words};
use crate::work::{WorkId, WorkResult};
use library_data::{LibraryPersonRow, LibraryRow, LibrarySignRow, SignMovement};
use library_delete::DeletionState;
use library_fit::BodyFitState;

/// Height of a row, in heights of a button.
const LIBRARY_ROW_HEIGHT: f32 = 2.1;
/// Side of the picture beside the row under the pointer, in points.
const LARGE_PICTURE_SIDE: f32 = 220.0;

/// The contents of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LibraryList {
    Recordings,
    Signs,
    People,
}

/// The pane.
#[derive(Default)]
pub(crate) struct LibraryPane {
    filter: String,
    /// The chosen list; signs if there are no recordings.
    list: Option<LibraryList>,
    rows: LibraryRows,
    /// The row at the keyboard cursor, and the row to give the focus next.
    at: usize,
    reach: Option<usize>,
    /// The row with the keyboard focus.
    focused: Option<usize>,
    /// The scroll offset of the list, in points.
    scrolled: f32,
    /// The sign that was clicked last.
    chosen: Option<LibrarySignRow>,
    notated: AnimatedNotations,
    leaving: DeletionState,
    fitting: BodyFitState,
}

/// The filtered rows, computed again when their inputs change.
#[derive(Default)]
struct LibraryRows {
    of: Option<(usize, String, InterfaceLanguage)>,
    recordings: Vec<LibraryRow>,
    signs: Vec<LibrarySignRow>,
    people: Vec<LibraryPersonRow>,
    /// The first sign of each recording.
    first: BTreeMap<i64, TimeSpan>,
}

impl LibraryRows {
    fn update_library_rows(&mut self, seen: &PaneInput<'_>, filter: &str) {
        let overview = &seen.snapshot.overview;
        let now = (Arc::as_ptr(overview) as usize, filter.to_owned(), seen.language);
        if self.of.as_ref() == Some(&now) {
            return;
        }
        let origin = |source: library_data::RecordingOrigin| seen.say_text(source.recording_origin_text()).to_owned();
        let kind = |kind| seen.say_text(library_data::kind_text(kind)).to_owned();
        self.recordings = library_data::library_recording_rows(&overview.recordings, filter, origin, kind);
        self.signs = library_data::library_sign_rows(&overview.signs, &overview.recordings, filter, seen.language);
        self.people = library_data::library_person_rows(overview, filter, seen.language);
        self.first = library_wall::first_signs(&overview.signs);
        self.of = Some(now);
    }
}

impl LibraryPane {
    /// Returns the last chosen sign, for use in another pane.
    pub(crate) fn last_chosen_sign(&self) -> Option<DraggedToken> {
        carried_sign_of(self.chosen.as_ref()?)
    }

    fn listed_library(&self, seen: &PaneInput<'_>) -> LibraryList {
        let none = seen.snapshot.overview.recordings.is_empty();
        let usual = if none {
            LibraryList::Signs
        } else {
            LibraryList::Recordings
        };
        self.list.unwrap_or(usual)
    }

    /// Draws the choice between a wall of pictures and a list, from the right.
    fn layout_of_list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        for (as_list, name) in [(true, words::LIST), (false, words::WALL)] {
            let on = seen.settings.library_list == as_list;
            if ui.selectable_label(on, seen.say_text(name)).clicked() && !on {
                let mut settings = seen.settings.clone();
                settings.library_list = as_list;
                seen.send_command(WindowCommand::Settings(Box::new(settings)));
                (self.scrolled, self.reach) = (0.0, None);
            }
        }
    }

    /// Draws the choice of the list, and the filter.
    fn show_library_head(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) -> LibraryList {
        let list = self.listed_library(seen);
        let overview = &seen.snapshot.overview;
        ui.horizontal_wrapped(|ui| {
            let all = [
                (LibraryList::Recordings, words::RECORDINGS, overview.recordings.len()),
                (LibraryList::Signs, words::SIGNS, overview.signs.len()),
                (LibraryList::People, words::PEOPLE, overview.people.len()),
            ];
            for (of, name, count) in all {
                let name = fill_text_braces(seen.say_text(name), &[("n", &count)]);
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
                self.layout_of_list(ui, seen);
                script_edit::draw_text_line(ui, &mut self.filter, |field| {
                    field
                        .hint_text(seen.say_text(words::FILTER))
                        .desired_width(f32::INFINITY)
                })
            })
            .inner;
        let response = shown.response.response;
        let (name, text) = (seen.say_text(words::FILTER), self.filter.clone());
        response.widget_info(|| WidgetInfo {
            label: Some(name.to_owned()),
            ..WidgetInfo::text_edit(true, &before, &text, name)
        });
        if response.changed() {
            (self.at, self.scrolled) = (0, 0.0);
        }
        let down = response.has_focus() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::ArrowDown));
        if down {
            self.reach = Some(0);
        }
        self.listed_library(seen)
    }

    /// Chooses a sign: shows it in its recording, or animates its notation. For a sign without either, the pane lists
    /// the possible actions.
    fn choose_library_sign(&mut self, row: &LibrarySignRow, out: &CommandOutbox) {
        self.chosen = Some(row.clone());
        let Some(token) = row.token else { return };
        self.notated.choose_notated_sign(row.moves, token, &row.gloss, out);
    }

    /// Shows the chosen notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_chosen_notated_sign(&mut self, out: &CommandOutbox) {
        self.notated.show_opened_notation(out);
    }

    /// Lists the possible actions for the chosen sign if it has no movement.
    fn show_sign_actions(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let Some((row, token)) = self.chosen.as_ref().and_then(|row| Some((row, row.token?))) else {
            return;
        };
        let bare = match row.moves {
            SignMovement::Recorded(..) => return,
            SignMovement::Notated => self.notated.movement_absence(token),
            SignMovement::Not => Some(MovementAbsence::Coded),
        };
        if let Some(bare) = bare {
            without_movement::show_movement_absence(ui, seen, token, &row.gloss, &bare);
        }
    }

    fn library_scroll_area(&mut self, ui: &Ui, height: f32) -> ScrollArea {
        let area = ScrollArea::vertical().auto_shrink(false);
        let Some(at) = self.reach else { return area };
        let offset = super::scrolled_to(at, height, self.scrolled, ui.available_height());
        area.vertical_scroll_offset(offset)
    }

    /// Takes the arrow keys if a row of the list has the focus.
    fn take_library_keys(&mut self, ui: &Ui, total: usize) {
        if total == 0 || ui.memory(|memory| memory.focused()) != Some(row_id(self.at)) {
            return;
        }
        if let Some(to) = list_keys::take_list_keys(ui, self.at, total) {
            (self.at, self.reach) = (to, Some(to));
        }
    }

    /// Gives the focus to the row that the keys moved to, and keeps the arrow keys in the list.
    fn focus_library_row(&mut self, ui: &Ui, response: &Response, at: usize) {
        if self.reach == Some(at) {
            self.reach = None;
            response.request_focus();
        }
        if response.has_focus() {
            self.at = at;
            self.focused = Some(at);
            list_keys::keep_arrow_keys(ui, response.id, false);
        }
    }

    /// Lists `count` rows of one height, each drawn by `show`.
    fn show_library_rows(&mut self, ui: &mut Ui, count: usize, mut show: impl FnMut(&mut Self, &mut Ui, usize, f32)) {
        let height = ui.spacing().interact_size.y * LIBRARY_ROW_HEIGHT;
        self.take_library_keys(ui, count);
        let area = self.library_scroll_area(ui, height + ui.spacing().item_spacing.y);
        let shown = area.show_rows(ui, height, count, |ui, range| {
            for at in range {
                show(self, ui, at, height);
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
    }

    fn show_recording_rows(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let rows = std::mem::take(&mut self.rows.recordings);
        self.show_library_rows(ui, rows.len(), |pane, ui, at, height| {
            let row = &rows[at];
            let chosen = seen.shown.recording == Some(row.id);
            let lead = height - 4.0;
            let response = super::list_row_at(ui, row_id(at), height, lead, chosen, &row.name, &row.about);
            pane.focus_library_row(ui, &response, at);
            if row.moves {
                let motion = MiniatureMotion::Span(row.id, row.whole);
                show_row_figure(ui, seen, motion, &response, lead);
            }
            pane.on_recording(seen, row, &response);
        });
        self.rows.recordings = rows;
    }

    /// Lists the people; a click shows one in the inspector, with everything about them to change.
    fn show_person_rows(&mut self, ui: &mut Ui, out: &CommandOutbox) {
        let rows = std::mem::take(&mut self.rows.people);
        self.show_library_rows(ui, rows.len(), |pane, ui, at, height| {
            let row = &rows[at];
            let response = super::list_row_at(ui, row_id(at), height, 0.0, false, &row.name, &row.about);
            pane.focus_library_row(ui, &response, at);
            if response.clicked() {
                out.send_command(WindowCommand::Inspect(InspectedThing::Signer(row.id)));
            }
        });
        self.rows.people = rows;
    }

    /// Handles clicks on a recording.
    fn on_recording(&mut self, seen: &PaneInput<'_>, row: &LibraryRow, response: &Response) {
        if response.clicked() {
            seen.send_command(WindowCommand::Recording(row.id));
            seen.send_command(WindowCommand::Look);
        }
        if response.double_clicked() {
            open_recipe(seen, Some(row.id));
        }
        response.context_menu(|ui| {
            if seen.snapshot.recipe_of(row.id).is_some() {
                let name = seen.say_text(Action::OpenRecipe.action_row().name);
                if ui.button(name).clicked() {
                    open_recipe(seen, Some(row.id));
                    ui.close();
                }
            }
            offer_to_inspect(ui, seen, InspectedThing::Recording(row.id));
            ui.separator();
            if row.has_markers {
                self.fit_entry(ui, seen, row);
            }
            let doomed = || library_delete::recording_deletion_target(row.id, &row.name);
            self.delete_entry(ui, seen, doomed);
        });
    }

    fn show_sign_rows(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let rows = std::mem::take(&mut self.rows.signs);
        self.show_library_rows(ui, rows.len(), |pane, ui, at, height| {
            pane.show_one_sign_row(ui, seen, at, &rows[at], height);
        });
        self.rows.signs = rows;
    }

    fn show_one_sign_row(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, at: usize, row: &LibrarySignRow, height: f32) {
        let chosen = self.chosen.as_ref().is_some_and(|chosen_sign| chosen_sign.id == row.id);
        let lead = height - 4.0;
        let response = super::list_row_at(ui, row_id(at), height, lead, chosen, &row.gloss, &row.about);
        self.focus_library_row(ui, &response, at);
        let motion = match (row.moves, row.token) {
            (SignMovement::Recorded(recording, span), _) => Some(MiniatureMotion::Span(recording, span)),
            (SignMovement::Notated, Some(token)) if ui.is_rect_visible(response.rect) => self
                .notated
                .notated_clip(token, &row.gloss, seen.out)
                .map(MiniatureMotion::Made),
            _ => None,
        };
        if let Some(motion) = &motion {
            show_row_figure(ui, seen, motion.clone(), &response, lead);
        }
        self.on_sign(seen, row, motion, &response);
    }

    /// Handles clicks on a sign, and drags.
    fn on_sign(
        &mut self,
        seen: &PaneInput<'_>,
        row: &LibrarySignRow,
        motion: Option<MiniatureMotion>,
        response: &Response,
    ) {
        if let Some(carried) = carried_sign_of(row) {
            super::carry::make_sign_draggable(response, carried, motion);
        }
        if response.clicked() {
            self.choose_library_sign(row, seen.out);
        }
        let recording = citation_recording(row);
        if response.double_clicked() {
            open_recipe(seen, recording);
        }
        response.context_menu(|ui| {
            let gloss = row.gloss.as_str();
            if let Some(token) = row.token {
                super::carry::show_sign_menu(ui, seen, token, gloss, recording);
                ui.separator();
            }
            self.delete_entry(ui, seen, || library_delete::sign_deletion_target(row));
        });
    }
}

/// Returns the widget id of the row at an index, whatever its contents.
fn row_id(at: usize) -> Id {
    Id::unique("library").with(at)
}

/// Returns the recording that contains a sign's citation form.
fn citation_recording(row: &LibrarySignRow) -> Option<i64> {
    match row.moves {
        SignMovement::Recorded(recording, _) => Some(recording),
        _ => None,
    }
}

/// Opens the recipe of a recording that was made from one.
fn open_recipe(seen: &PaneInput<'_>, recording: Option<i64>) {
    if let Some((recipe, name)) = recording.and_then(|id| seen.snapshot.recipe_of(id)) {
        seen.send_command(WindowCommand::Recipe(recipe, Some(name)));
    }
}

fn carried_sign_of(row: &LibrarySignRow) -> Option<DraggedToken> {
    let gloss = row.gloss.clone();
    row.token.map(|token| DraggedToken { token, gloss })
}

fn show_row_figure(ui: &Ui, seen: &PaneInput<'_>, motion: MiniatureMotion, response: &Response, lead: f32) {
    let centre = response.rect.left_center() + vec2(4.0 + lead / 2.0, 0.0);
    let mut cell = MiniatureCell::new(motion.clone(), Vec2::splat(lead));
    if response.hovered() || response.has_focus() {
        cell = cell.with_playing_clock(miniatures::figure_loop_clock(ui));
    }
    let rect = Rect::from_center_size(centre, cell.size);
    seen.little.paint_figure(ui, seen.language, seen.out, &cell, rect);
    let mut tooltip = Tooltip::for_enabled(response);
    tooltip.popup = tooltip.popup.align(RectAlign::RIGHT_START);
    tooltip.show(|ui| {
        let size = Vec2::splat(LARGE_PICTURE_SIDE);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let large = MiniatureCell::new(motion, size).with_playing_clock(miniatures::figure_loop_clock(ui));
        seen.little.paint_figure(ui, seen.language, seen.out, &large, rect);
    });
}

fn offer_to_inspect(ui: &mut Ui, seen: &PaneInput<'_>, thing: InspectedThing) {
    if ui.button(seen.say_text(words::INSPECT)).clicked() {
        seen.send_command(WindowCommand::Inspect(thing));
        ui.close();
    }
}

impl PaneInterface for LibraryPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.notated
            .forget_animation_failures(seen.snapshot.overview.generation);
        self.show_deletion(ui, seen);
        self.show_body_fit(ui, seen);
        self.focused = None;
        let overview = &seen.snapshot.overview;
        if overview.recordings.is_empty() && overview.signs.is_empty() {
            ui.label(seen.say_text(words::EMPTY));
            if ui.button(seen.say_text(words::IMPORT)).clicked() {
                seen.send_command(WindowCommand::Do(Action::Import));
            }
            return;
        }
        let list = self.show_library_head(ui, seen);
        self.rows.update_library_rows(seen, &self.filter);
        if list == LibraryList::Signs {
            self.show_sign_actions(ui, seen);
        }
        match list {
            LibraryList::Recordings if overview.recordings.is_empty() => {
                ui.label(seen.say_text(words::NO_RECORDINGS));
            }
            LibraryList::Signs if overview.signs.is_empty() => {
                ui.label(seen.say_text(words::NO_SIGNS));
            }
            LibraryList::Recordings if self.rows.recordings.is_empty() => {
                ui.label(seen.say_text(words::NONE_FIT));
            }
            LibraryList::Signs if self.rows.signs.is_empty() => {
                ui.label(seen.say_text(words::NO_SIGN_FITS));
            }
            LibraryList::People if self.rows.people.is_empty() => {
                ui.label(seen.say_text(words::NO_PERSON_FITS));
            }
            LibraryList::People => self.show_person_rows(ui, seen.out),
            _ if !seen.settings.library_list => self.show_library_wall(ui, seen, list),
            LibraryList::Recordings => self.show_recording_rows(ui, seen),
            LibraryList::Signs => self.show_sign_rows(ui, seen),
        }
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::DeleteListed => self.delete_chosen(seen),
            Action::FitMarkers => self.fit_chosen(seen),
            _ => ActionOutcome::No,
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        self.notated.receive_animation_result(id, ended);
        self.hear_deletion(id, ended);
        self.hear_people(id, ended);
    }
}
