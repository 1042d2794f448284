//! Operations and their authors, the newest first; back to any point and forward again.

mod history_conflicts;
pub(crate) mod history_data;

use std::sync::Arc;

use chereme_corpus::CorpusOverview;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Button, FontId, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, vec2,
};

use super::PaneInterface;
use crate::action::Action;
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::words::{InterfaceLanguage, fill_text_braces, history_words as words};
use crate::work::whole_corpus;
use history_data::{HistoryRow, OperationStanding};

/// Several undos or redos, which wait to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct HistoryWalk {
    /// The operation that was clicked; `None` for the state before all of them.
    to: Option<i64>,
    back: bool,
    steps: usize,
}

/// The pane.
#[derive(Default)]
pub(crate) struct HistoryPane {
    filter: String,
    walk: Option<HistoryWalk>,
    /// The rows, and the inputs that they were computed from.
    rows: Vec<HistoryRow>,
    of: Option<(Arc<CorpusOverview>, InterfaceLanguage, String)>,
}

impl HistoryPane {
    fn update_history_rows(&mut self, seen: &PaneInput<'_>) {
        let same = self.of.as_ref().is_some_and(|(overview, language, filter)| {
            Arc::ptr_eq(overview, &seen.snapshot.overview) && *language == seen.language && *filter == self.filter
        });
        if same {
            return;
        }
        let overview = seen.snapshot.overview.clone();
        self.rows = history_data::history_rows(&overview.operations, seen.language, &self.filter);
        if self
            .of
            .as_ref()
            .is_some_and(|(before, ..)| !Arc::ptr_eq(before, &overview))
        {
            self.walk = None;
        }
        self.of = Some((overview, seen.language, self.filter.clone()));
    }

    fn show_history_buttons(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal(|ui| {
            for action in [Action::Undo, Action::Redo] {
                let button = ui.button(seen.say_text(action.action_row().name));
                if button.on_hover_text(seen.keys.action_keys_text(action)).clicked() {
                    // This undoes changes of the corpus, even if the recipe changed since.
                    let back = action == Action::Undo;
                    seen.request_work(whole_corpus::undo_or_redo(back));
                }
            }
            let width = ui.available_width() - 8.0;
            let filter = script_edit::draw_text_line(ui, &mut self.filter, |field| {
                field.hint_text(seen.say_text(words::FILTER)).desired_width(width)
            });
            let response = filter.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say_text(words::FILTER)));
        });
    }

    /// Asks for confirmation of a walk of several steps.
    fn confirmation(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let Some(walk) = self.walk else { return };
        let text = if walk.back {
            words::WALK_BACK
        } else {
            words::WALK_FORWARD
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(fill_text_braces(seen.say_text(text), &[("n", &walk.steps)]));
            let go = Button::new(seen.say_text(words::WALK_GO));
            if ui.add(go).clicked() {
                walk_now(walk, seen.out);
                self.walk = None;
            }
            if ui.button(seen.say_text(crate::words::shell::CANCEL)).clicked() {
                self.walk = None;
            }
        });
    }

    fn handle_clicked_operation(&mut self, row: &HistoryRow, out: &CommandOutbox) {
        let walk = match row.standing {
            OperationStanding::Stands(0) | OperationStanding::Gone => None,
            OperationStanding::Stands(steps) => Some((true, steps)),
            OperationStanding::Undone(steps) => Some((false, steps)),
        };
        let Some((back, steps)) = walk else {
            self.walk = None;
            return;
        };
        let to = Some(row.id);
        self.ask_history_walk(HistoryWalk { to, back, steps }, out);
    }

    fn ask_history_walk(&mut self, walk: HistoryWalk, out: &CommandOutbox) {
        if walk.steps == 1 {
            walk_now(walk, out);
            self.walk = None;
        } else {
            self.walk = Some(walk);
        }
    }

    /// Returns whether the waiting walk would undo or redo that operation.
    fn is_in_the_walk(&self, row: &HistoryRow) -> bool {
        match (self.walk, row.standing) {
            (Some(walk), OperationStanding::Stands(steps)) => walk.back && steps < walk.steps,
            (Some(walk), OperationStanding::Undone(steps)) => !walk.back && steps <= walk.steps,
            _ => false,
        }
    }
}

fn walk_now(walk: HistoryWalk, out: &CommandOutbox) {
    let (back, steps) = (walk.back, walk.steps);
    out.request_work(whole_corpus::walk_operations_job(back, steps));
}

impl PaneInterface for HistoryPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.update_history_rows(seen);
        self.show_history_buttons(ui, seen);
        history_conflicts::show_open_conflicts(ui, seen);
        let operations = &seen.snapshot.overview.operations;
        if operations.is_empty() {
            ui.label(seen.say_text(words::EMPTY));
            return;
        }
        self.confirmation(ui, seen);
        if self.rows.is_empty() {
            ui.weak(seen.say_text(words::NONE_FIT));
        }
        let height = ui.spacing().interact_size.y * 1.9;
        // The state before all operations is a row too, if the first operation is in the list.
        let is_complete = operations.last().is_some_and(|operation| operation.id == 1) && self.filter.trim().is_empty();
        let count = self.rows.len() + usize::from(is_complete);
        ScrollArea::vertical()
            .auto_shrink(false)
            .show_rows(ui, height, count, |ui, range| {
                for at in range {
                    match self.rows.get(at).cloned() {
                        Some(row) => {
                            if self.show_history_row(ui, seen, height, &row) {
                                self.handle_clicked_operation(&row, seen.out);
                            }
                        }
                        None => self.show_history_beginning(ui, seen),
                    }
                }
            });
    }
}

impl HistoryPane {
    fn show_history_beginning(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let steps = history_data::count_standing_operations(&seen.snapshot.overview.operations);
        let button = Button::new(seen.say_text(words::BEGINNING)).frame(false);
        if ui.add_enabled(steps > 0, button).clicked() {
            let (to, back) = (None, true);
            self.ask_history_walk(HistoryWalk { to, back, steps }, seen.out);
        }
    }

    /// Shows an operation; returns whether it was clicked.
    fn show_history_row(&self, ui: &mut Ui, seen: &PaneInput<'_>, height: f32, row: &HistoryRow) -> bool {
        let size = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        // The number counts the operations that would have to be undone first.
        let newest = row.standing == OperationStanding::Stands(0);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, newest, &row.what));
        let state = match row.standing {
            OperationStanding::Stands(0) => Some(words::NOW),
            OperationStanding::Stands(_) => None,
            OperationStanding::Undone(_) => Some(words::UNDONE),
            OperationStanding::Gone => Some(words::GONE),
        };
        let (colours, visuals) = (seen.pane_colours(), ui.visuals());
        let stands = matches!(row.standing, OperationStanding::Stands(_));
        let strong = if stands {
            visuals.text_color()
        } else {
            visuals.weak_text_color()
        };
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        if self.is_in_the_walk(row) {
            painter.rect_filled(rect, 4.0, colours.selection);
        } else if response.hovered() {
            painter.rect_filled(rect, 4.0, colours.stripe);
        }
        if response.has_focus() {
            let stroke = Stroke::new(1.5, colours.accent);
            painter.rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
        }
        let rail = rect.left() + 7.0;
        painter.vline(rail, rect.y_range(), Stroke::new(2.0, colours.rule));
        let dot = rect.left_center() + vec2(7.0, 0.0);
        match row.standing {
            OperationStanding::Stands(0) => drop(painter.circle_filled(dot, 5.0, colours.accent)),
            OperationStanding::Stands(_) => drop(painter.circle_filled(dot, 3.5, colours.rule)),
            _ => drop(painter.circle(dot, 3.5, visuals.panel_fill, Stroke::new(1.5, colours.rule))),
        }
        let body = TextStyle::Body.resolve(ui.style());
        let small = FontId::proportional(TextStyle::Small.resolve(ui.style()).size);
        let text_position = rect.left_center() + vec2(20.0, 0.0);
        let line = |text: String, font: FontId, colour| {
            let mut job = LayoutJob::simple_singleline(text, font, colour);
            job.wrap = TextWrapping::truncate_at_width((rect.right() - text_position.x).max(0.0));
            painter.layout_job(job)
        };
        let what = line(row.what.clone(), body, strong);
        painter.galley(text_position - vec2(0.0, what.size().y), what, strong);
        let about = match state {
            Some(text) => format!("{} · {}", seen.say_text(text), row.about),
            None => row.about.clone(),
        };
        let weak = visuals.weak_text_color();
        painter.galley(text_position + vec2(0.0, 2.0), line(about, small, weak), weak);
        let tip = match row.standing {
            OperationStanding::Stands(0) | OperationStanding::Gone => None,
            OperationStanding::Stands(_) => Some(words::TIP_BACK),
            OperationStanding::Undone(_) => Some(words::TIP_FORWARD),
        };
        response
            .on_hover_ui(|ui| {
                ui.label(RichText::new(&row.what));
                if let Some(tip) = tip {
                    ui.weak(seen.say_text(tip));
                }
            })
            .clicked()
    }
}
