//! The panes: each a module with rows computed by plain functions (`data`) and widgets (`ui`).
//!
//! To add one: a variant of [`PaneKind`] with its title and a place in its layouts (both in `layout`), a field of [`PaneSet`]
//! with its arms, and an action that shows it.

pub(crate) mod agreement;
pub(crate) mod carry;
pub(crate) mod combo;
pub(crate) mod complete_pane;
pub(crate) mod cue;
pub(crate) mod faces;
pub(crate) mod film_pane;
mod film_screens;
pub(crate) mod history;
pub(crate) mod import;
pub(crate) mod inspector;
pub(crate) mod library;
pub(crate) mod list_keys;
pub(crate) mod map;
pub(crate) mod measures;
mod notated_pane;
pub(crate) mod recombine;
mod saved_pane;
pub(crate) mod search;
pub(crate) mod stage;
pub(crate) mod studies;
pub(crate) mod timeline;
pub(crate) mod without_movement;

use eframe::egui::{
    Align2, Color32, Id, ProgressBar, Response, RichText, Role, Sense, StrokeKind, TextStyle, TextWrapMode, Ui,
    WidgetInfo, WidgetText, pos2, vec2,
};

use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::layout::PaneKind;
use crate::words::{InterfaceText, shell};
use crate::work::{WorkId, WorkResult};

/// The outcome of an action that was offered to a pane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ActionOutcome {
    /// The action does not belong to this pane.
    No,
    /// The action was carried out.
    Yes,
    /// The action is not possible now, for this reason.
    Cannot(InterfaceText),
}

/// The interface of every pane.
pub(crate) trait PaneInterface {
    /// Draws the pane, and sends requests for the user's input in it.
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>);

    /// Carries out an action of this pane.
    fn carry_out_pane_action(&mut self, _action: Action, _seen: &PaneInput<'_>) -> ActionOutcome {
        ActionOutcome::No
    }

    /// Handles the result of work, whether this pane or another requested it.
    fn receive_work_result(&mut self, _id: WorkId, _ended: &WorkResult) {}

    /// Called when an action brings the pane to the front: it should take the keyboard.
    fn come(&mut self) {}

    /// Called when an action brings another pane to the front: this one should release the keyboard.
    fn release_pane_keyboard(&mut self) {}
}

/// Every pane.
#[derive(Default)]
pub(crate) struct PaneSet {
    pub(crate) library: library::LibraryPane,
    pub(crate) map: map::MapPane,
    pub(crate) measures: measures::MeasuresPane,
    pub(crate) cue: cue::CuePane,
    pub(crate) faces: faces::FacesPane,
    pub(crate) agreement: agreement::AgreementPane,
    pub(crate) studies: studies::StudiesPane,
    pub(crate) stage: stage::StagePane,
    pub(crate) timeline: timeline::TimelinePane,
    pub(crate) search: search::SearchPane,
    pub(crate) recombine: recombine::RecombinePane,
    pub(crate) inspector: inspector::InspectorPane,
    pub(crate) history: history::HistoryPane,
    pub(crate) import: import::ImportPane,
    pub(crate) film: film_pane::FilmPane,
}

impl PaneSet {
    pub(crate) fn get_mut(&mut self, kind: PaneKind) -> &mut dyn PaneInterface {
        match kind {
            PaneKind::Library => &mut self.library,
            PaneKind::Map => &mut self.map,
            PaneKind::Measures => &mut self.measures,
            PaneKind::Cue => &mut self.cue,
            PaneKind::Faces => &mut self.faces,
            PaneKind::Agreement => &mut self.agreement,
            PaneKind::Studies => &mut self.studies,
            PaneKind::Stage => &mut self.stage,
            PaneKind::Timeline => &mut self.timeline,
            PaneKind::Search => &mut self.search,
            PaneKind::Recombine => &mut self.recombine,
            PaneKind::Inspector => &mut self.inspector,
            PaneKind::History => &mut self.history,
            PaneKind::Import => &mut self.import,
            PaneKind::Film => &mut self.film,
        }
    }

    pub(crate) fn forward_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        for kind in PaneKind::ALL_PANE_KINDS {
            self.get_mut(kind).receive_work_result(id, ended);
        }
    }
}

/// Shows the progress of a running piece of work, and a button that stops it; returns whether it runs.
pub(crate) fn show_running_work(ui: &mut Ui, seen: &PaneInput<'_>, work: Option<WorkId>) -> bool {
    let Some((id, running)) = work.and_then(|id| Some((id, seen.running.get(&id)?))) else {
        return false;
    };
    match running.far.finished_share() {
        Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(120.0).show_percentage())),
        None => drop(ui.spinner()),
    }
    if ui.button(seen.say_text(shell::CANCEL)).clicked() {
        seen.send_command(WindowCommand::Stop(id));
    }
    true
}

/// Returns the width of the longest word in `texts`; a column of that width breaks lines only between words.
pub(crate) fn longest_word<'a>(ui: &Ui, texts: impl Iterator<Item = &'a str>) -> f32 {
    let words = texts.flat_map(str::split_whitespace);
    words
        .map(|word| measure_text_width(ui, word))
        .fold(0.0, f32::max)
        .ceil()
}

/// Returns the width of a button with that text.
pub(crate) fn button_width(ui: &Ui, text: &str) -> f32 {
    measure_text_width(ui, text) + 2.0 * ui.spacing().button_padding.x + 2.0
}

fn measure_text_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    galley.size().x
}

/// Returns the scroll offset of a list with rows of one height that brings the row `at` into sight.
pub(crate) fn scrolled_to(at: usize, height: f32, now: f32, room: f32) -> f32 {
    let top = at as f32 * height;
    let least = (top + height - room).max(0.0);
    now.clamp(least.min(top), top)
}

/// Shows a row of a list: a name, with a text below; it reacts to a click, or to Enter with the focus.
pub(crate) fn list_row(ui: &mut Ui, height: f32, chosen: bool, name: &str, about: &str) -> Response {
    list_row_after(ui, height, 0.0, chosen, name, about)
}

/// Returns the widget with the keyboard focus.
pub(crate) fn focused_widget(ui: &Ui) -> Option<Response> {
    let focused = ui.memory(|memory| memory.focused())?;
    let response = ui.ctx().read_response(focused);
    // After a click elsewhere, reading takes the focus from a widget that was just given it.
    if ui.memory(|memory| memory.focused().is_none()) {
        ui.memory_mut(|memory| memory.request_focus(focused));
    }
    response
}

/// Scrolls to a widget of this part of a pane that the keyboard has just reached.
pub(crate) fn reach_focus(ui: &Ui) {
    let Some(it) = focused_widget(ui) else {
        return;
    };
    // Visible widgets of other parts may lie where hidden widgets of this part would be.
    let is_elsewhere = it.interact_rect.is_positive() && !ui.clip_rect().intersects(it.interact_rect);
    if it.gained_focus() && ui.min_rect().contains_rect(it.rect) && !is_elsewhere {
        ui.scroll_to_rect(it.rect, None);
    }
}

/// Shows a row of a list with a width of `lead` left free at its start, for a picture.
pub(crate) fn list_row_after(ui: &mut Ui, height: f32, lead: f32, chosen: bool, name: &str, about: &str) -> Response {
    let id = ui.next_auto_id();
    list_row_at(ui, id, height, lead, chosen, name, about)
}

/// Shows the same row under the caller's id; it can be dragged.
pub(crate) fn list_row_at(
    ui: &mut Ui,
    id: Id,
    height: f32,
    lead: f32,
    chosen: bool,
    name: &str,
    about: &str,
) -> Response {
    let size = vec2(ui.available_width(), height);
    let (_, rect) = ui.allocate_space(size);
    let response = ui.interact(rect, id, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let visuals = ui.style().interact_selectable(&response, chosen);
    if chosen || response.hovered() || response.has_focus() {
        ui.painter()
            .rect(rect, 5.0, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    }
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let left = rect.left() + 8.0 + lead;
    let put = |text: &str, style: TextStyle, colour: Color32, y: Align2| {
        let width = rect.right() - 6.0 - left;
        let text = RichText::new(text).color(colour);
        let cut = Some(TextWrapMode::Truncate);
        let galley = WidgetText::from(text).into_galley(ui, cut, width, style);
        let text_rect = y.anchor_size(pos2(left, rect.center().y), galley.size());
        painter.galley(text_rect.min, galley, colour);
    };
    let colour = visuals.text_color();
    if about.is_empty() {
        put(name, TextStyle::Body, colour, Align2::LEFT_CENTER);
    } else {
        put(name, TextStyle::Body, colour, Align2::LEFT_BOTTOM);
        put(about, TextStyle::Small, colour.gamma_multiply(0.75), Align2::LEFT_TOP);
    }
    response
}
