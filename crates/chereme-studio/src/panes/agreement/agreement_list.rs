//! The list of disagreements: its filters, and rows that open their places.

use chereme_corpus::{AnnotatorAgreement, DisagreementKind};
use eframe::egui::{Id, Response, ScrollArea, Ui};

use super::agreement_data::{DisagreementKinds, DisagreementOrder};
use super::{AgreementPane, AgreementView};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::panes::{combo, list_keys, list_row_at, scrolled_to};
use crate::words::{agreement as words, fill_text_braces};

/// The height of a row, in heights of a button.
const DISAGREEMENT_ROW_HEIGHT: f32 = 1.9;

fn row_id(at: usize) -> Id {
    Id::unique("disagreement").with(at)
}

impl AgreementPane {
    /// Shows the names of the lists and tables.
    pub(super) fn show_agreement_views(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, found: &AnnotatorAgreement) {
        let counted = |text, n: usize| fill_text_braces(seen.say_text(text), &[("n", &n)]);
        let mut views = vec![
            (
                AgreementView::Disagreements,
                counted(words::DISAGREEMENTS, found.list.len()),
            ),
            (AgreementView::Values, seen.say_text(words::VALUES).to_owned()),
            (AgreementView::Confusion, seen.say_text(words::CONFUSION).to_owned()),
            (AgreementView::Measures, seen.say_text(words::ALL_MEASURES).to_owned()),
        ];
        if found.pairs.len() > 1 {
            let text = counted(words::RECORDINGS, found.pairs.len());
            views.push((AgreementView::Recordings, text));
        } else if self.view == AgreementView::Recordings {
            self.view = AgreementView::Disagreements;
        }
        ui.horizontal_wrapped(|ui| {
            for (view, name) in views {
                ui.selectable_value(&mut self.view, view, name);
            }
        });
    }

    /// Shows the list.
    pub(super) fn show_disagreement_list(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        found: &AnnotatorAgreement,
        names: &[String; 2],
    ) {
        if found.list.is_empty() {
            ui.label(seen.say_text(words::NONE));
            return;
        }
        let counts = &found.disagreements;
        let only = |tier: &String, n: u64| {
            let values: [(&str, &dyn std::fmt::Display); 2] = [("tier", tier), ("n", &n)];
            fill_text_braces(seen.say_text(words::ONLY), &values)
        };
        let counted = |text, n: u64| fill_text_braces(seen.say_text(text), &[("n", &n)]);
        let kinds = [
            (DisagreementKinds::All, seen.say_text(words::EVERY_KIND).to_owned()),
            (
                DisagreementKinds::Only(DisagreementKind::OnlyA),
                only(&names[0], counts.only_a),
            ),
            (
                DisagreementKinds::Only(DisagreementKind::OnlyB),
                only(&names[1], counts.only_b),
            ),
            (
                DisagreementKinds::Only(DisagreementKind::Value),
                counted(words::OTHER_VALUE, counts.value),
            ),
            (
                DisagreementKinds::Only(DisagreementKind::Boundary),
                counted(words::BOUNDARY, counts.boundary),
            ),
        ];
        let orders = [
            (DisagreementOrder::Costliest, seen.say_text(words::COSTLIEST).to_owned()),
            (DisagreementOrder::Time, seen.say_text(words::BY_TIME).to_owned()),
        ];
        ui.horizontal_wrapped(|ui| {
            combo::show_named_combo(ui, seen.say_text(words::KIND), &mut self.kinds, &kinds);
            combo::show_named_combo(ui, seen.say_text(words::ORDER), &mut self.order, &orders);
        });
        self.refresh_disagreement_rows(seen.language);
        ui.horizontal_wrapped(|ui| {
            for (action, text) in [
                (Action::PreviousDisagreement, words::PREVIOUS),
                (Action::NextDisagreement, words::NEXT),
            ] {
                let button = ui.button(seen.say_text(text));
                if button.on_hover_text(seen.keys.action_keys_text(action)).clicked() {
                    seen.send_command(WindowCommand::Do(action));
                }
            }
            let values: [(&str, &dyn std::fmt::Display); 2] =
                [("n", &self.at.map_or(0, |at| at + 1)), ("of", &self.rows.len())];
            ui.weak(fill_text_braces(seen.say_text(words::NTH), &values));
        });
        if self.rows.is_empty() {
            ui.label(seen.say_text(words::NONE_OF_KIND));
            return;
        }
        self.rows_of_list(ui, seen);
    }

    fn rows_of_list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let height = ui.spacing().interact_size.y * DISAGREEMENT_ROW_HEIGHT;
        self.take_disagreement_keys(ui, seen);
        let mut area = ScrollArea::vertical().id_salt("disagreements").auto_shrink(false);
        if let Some(at) = self.reach {
            let row_pitch = height + ui.spacing().item_spacing.y;
            let room = ui.available_height();
            area = area.vertical_scroll_offset(scrolled_to(at, row_pitch, self.scrolled, room));
        }
        let rows = std::mem::take(&mut self.rows);
        let mut opened = None;
        let mut reached = None;
        let shown = area.show_rows(ui, height, rows.len(), |ui, range| {
            for at in range {
                let row = &rows[at];
                let chosen = self.at == Some(at);
                let response = list_row_at(ui, row_id(at), height, 0.0, chosen, &row.name, &row.about);
                if self.reach == Some(at) {
                    reached = Some(response.rect);
                }
                self.focus_disagreement_row(ui, &response, at);
                if response.clicked() {
                    opened = Some(at);
                }
            }
        });
        self.scrolled = shown.state.clamped_offset().y;
        // In a low pane the list itself is partly out of sight.
        if let Some(row) = reached {
            ui.scroll_to_rect(row, None);
        }
        self.rows = rows;
        if let Some(at) = opened {
            self.open_disagreement(at, seen);
            self.reach = Some(at);
        }
    }

    /// Takes the arrow keys if a row of the list has the focus: each row is opened as it is reached.
    fn take_disagreement_keys(&mut self, ui: &Ui, seen: &PaneInput<'_>) {
        let Some(focused) = ui.memory(|memory| memory.focused()) else {
            return;
        };
        let now = self.at.filter(|at| focused == row_id(*at));
        let Some(now) = now.or((focused == row_id(0)).then_some(0)) else {
            return;
        };
        if let Some(to) = list_keys::take_list_keys(ui, now, self.rows.len()) {
            self.open_disagreement(to, seen);
            self.reach = Some(to);
        }
    }

    /// Gives the focus to the row that the keys moved to, and keeps the arrow keys in the list.
    fn focus_disagreement_row(&mut self, ui: &Ui, response: &Response, at: usize) {
        if self.reach == Some(at) {
            self.reach = None;
            response.request_focus();
        }
        if response.has_focus() {
            list_keys::keep_arrow_keys(ui, response.id, false);
        }
    }
}
