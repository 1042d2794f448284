//! Operations and their authors, the newest first; back to any point and forward again.

mod conflicts;
pub(crate) mod data;

use std::sync::Arc;

use chereme_corpus::Overview;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Button, FontId, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui,
    WidgetInfo, vec2,
};

use super::Pane;
use crate::action::Action;
use crate::context::{Outbox, PaneInput};
use crate::script::edit;
use crate::words::{Language, fill, history as words};
use crate::work::whole_corpus;
use data::{HistoryRow, Standing};

/// Several undos or redos, which wait to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Walk {
    /// The operation that was clicked; `None` for the state before all of them.
    to: Option<i64>,
    back: bool,
    steps: usize,
}

/// The pane.
#[derive(Default)]
pub(crate) struct History {
    filter: String,
    walk: Option<Walk>,
    /// The rows, and the inputs that they were computed from.
    rows: Vec<HistoryRow>,
    of: Option<(Arc<Overview>, Language, String)>,
}

impl History {
    fn follow(&mut self, seen: &PaneInput<'_>) {
        let same = self
            .of
            .as_ref()
            .is_some_and(|(overview, language, filter)| {
                Arc::ptr_eq(overview, &seen.snapshot.overview)
                    && *language == seen.language
                    && *filter == self.filter
            });
        if same {
            return;
        }
        let overview = seen.snapshot.overview.clone();
        self.rows = data::rows(&overview.operations, seen.language, &self.filter);
        if self
            .of
            .as_ref()
            .is_some_and(|(before, ..)| !Arc::ptr_eq(before, &overview))
        {
            self.walk = None;
        }
        self.of = Some((overview, seen.language, self.filter.clone()));
    }

    fn buttons(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        ui.horizontal(|ui| {
            for action in [Action::Undo, Action::Redo] {
                let button = ui.button(seen.say(action.row().name));
                if button.on_hover_text(seen.keys.text(action)).clicked() {
                    // This undoes changes of the corpus, even if the recipe changed since.
                    let back = action == Action::Undo;
                    out.work(whole_corpus::undo_or_redo(back));
                }
            }
            let width = ui.available_width() - 8.0;
            let filter = edit::line(ui, &mut self.filter, |field| {
                field
                    .hint_text(seen.say(words::FILTER))
                    .desired_width(width)
            });
            let response = filter.response.response;
            response.widget_info(|| {
                WidgetInfo::labeled(Role::TextInput, true, seen.say(words::FILTER))
            });
        });
    }

    /// Asks for confirmation of a walk of several steps.
    fn confirmation(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some(walk) = self.walk else { return };
        let text = if walk.back {
            words::WALK_BACK
        } else {
            words::WALK_FORWARD
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(fill(seen.say(text), &[("n", &walk.steps)]));
            let go = Button::new(seen.say(words::WALK_GO));
            if ui.add(go).clicked() {
                walk_now(walk, out);
                self.walk = None;
            }
            if ui.button(seen.say(crate::words::shell::CANCEL)).clicked() {
                self.walk = None;
            }
        });
    }

    fn clicked(&mut self, row: &HistoryRow, out: &mut Outbox) {
        let walk = match row.standing {
            Standing::Stands(0) | Standing::Gone => None,
            Standing::Stands(steps) => Some((true, steps)),
            Standing::Undone(steps) => Some((false, steps)),
        };
        let Some((back, steps)) = walk else {
            self.walk = None;
            return;
        };
        let to = Some(row.id);
        self.ask(Walk { to, back, steps }, out);
    }

    fn ask(&mut self, walk: Walk, out: &mut Outbox) {
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
            (Some(walk), Standing::Stands(steps)) => walk.back && steps < walk.steps,
            (Some(walk), Standing::Undone(steps)) => !walk.back && steps <= walk.steps,
            _ => false,
        }
    }
}

fn walk_now(walk: Walk, out: &mut Outbox) {
    let (back, steps) = (walk.back, walk.steps);
    out.work(whole_corpus::walk(back, steps));
}

impl Pane for History {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.follow(seen);
        self.buttons(ui, seen, out);
        conflicts::show(ui, seen, out);
        let operations = &seen.snapshot.overview.operations;
        if operations.is_empty() {
            ui.label(seen.say(words::EMPTY));
            return;
        }
        self.confirmation(ui, seen, out);
        if self.rows.is_empty() {
            ui.weak(seen.say(words::NONE_FIT));
        }
        let height = ui.spacing().interact_size.y * 1.9;
        // The state before all operations is a row too, if the first operation is in the list.
        let whole = operations.last().is_some_and(|it| it.id == 1) && self.filter.trim().is_empty();
        let count = self.rows.len() + usize::from(whole);
        ScrollArea::vertical()
            .auto_shrink(false)
            .show_rows(ui, height, count, |ui, range| {
                for at in range {
                    match self.rows.get(at).cloned() {
                        Some(row) => {
                            if self.row(ui, seen, height, &row) {
                                self.clicked(&row, out);
                            }
                        }
                        None => self.beginning(ui, seen, out),
                    }
                }
            });
    }
}

impl History {
    fn beginning(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let steps = data::standing(&seen.snapshot.overview.operations);
        let button = Button::new(seen.say(words::BEGINNING)).frame(false);
        if ui.add_enabled(steps > 0, button).clicked() {
            let (to, back) = (None, true);
            self.ask(Walk { to, back, steps }, out);
        }
    }

    /// Shows an operation; returns whether it was clicked.
    fn row(&self, ui: &mut Ui, seen: &PaneInput<'_>, height: f32, row: &HistoryRow) -> bool {
        let size = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let newest = row.standing == Standing::Stands(0);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, newest, &row.what));
        let state = match row.standing {
            Standing::Stands(0) => Some(words::NOW),
            Standing::Stands(_) => None,
            Standing::Undone(_) => Some(words::UNDONE),
            Standing::Gone => Some(words::GONE),
        };
        let (colours, visuals) = (seen.colours(), ui.visuals());
        let stands = matches!(row.standing, Standing::Stands(_));
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
            Standing::Stands(0) => drop(painter.circle_filled(dot, 5.0, colours.accent)),
            Standing::Stands(_) => drop(painter.circle_filled(dot, 3.5, colours.rule)),
            _ => drop(painter.circle(dot, 3.5, visuals.panel_fill, Stroke::new(1.5, colours.rule))),
        }
        let body = TextStyle::Body.resolve(ui.style());
        let small = FontId::proportional(TextStyle::Small.resolve(ui.style()).size);
        let at = rect.left_center() + vec2(20.0, 0.0);
        let line = |text: String, font: FontId, colour| {
            let mut job = LayoutJob::simple_singleline(text, font, colour);
            job.wrap = TextWrapping::truncate_at_width((rect.right() - at.x).max(0.0));
            painter.layout_job(job)
        };
        let what = line(row.what.clone(), body, strong);
        painter.galley(at - vec2(0.0, what.size().y), what, strong);
        let about = match state {
            Some(text) => format!("{} · {}", seen.say(text), row.about),
            None => row.about.clone(),
        };
        let weak = visuals.weak_text_color();
        painter.galley(at + vec2(0.0, 2.0), line(about, small, weak), weak);
        let tip = match row.standing {
            Standing::Stands(0) | Standing::Gone => None,
            Standing::Stands(_) => Some(words::TIP_BACK),
            Standing::Undone(_) => Some(words::TIP_FORWARD),
        };
        response
            .on_hover_ui(|ui| {
                ui.label(RichText::new(&row.what));
                if let Some(tip) = tip {
                    ui.weak(seen.say(tip));
                }
            })
            .clicked()
    }
}
