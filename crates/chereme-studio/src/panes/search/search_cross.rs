//! The table of how many of the found tokens have each value of one field and each of another.

use chereme_corpus::{NO_VALUE, ValueTally};
use chereme_sign::SignComponent;
use chereme_sign::query::{add_query_condition, attribute_field_text, facet_condition};
use eframe::egui::{Button, RichText, ScrollArea, Ui, Window, vec2};

use super::panes_search_facets::facet_name;
use crate::context::PaneInput;
use crate::panes::combo::show_named_combo;
use crate::words::{fill_text_braces, search_words as words, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, searching};

/// The most columns that are drawn.
const MAX_DRAWN_COLUMNS: usize = 60;
/// The size of a cell, in points.
const CROSS_CELL_SIZE: [f32; 2] = [84.0, 20.0];
/// The size of the table before somebody changes it, in points.
const CROSS_TABLE_SIZE: [f32; 2] = [560.0, 360.0];

/// A cross table, its fields, and the query whose tokens it counts.
#[derive(Debug, Default)]
pub(super) struct CrossTable {
    /// The fields of rows and columns; none before it was opened.
    fields: Option<[String; 2]>,
    is_open: bool,
    /// The query and the fields that were asked for last.
    counted: Option<(String, [String; 2])>,
    asked: Option<WorkId>,
    table: Option<Result<ValueTally, String>>,
}

impl CrossTable {
    /// Shows the button that opens the table.
    pub(super) fn show_cross_button(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if ui.button(seen.say_text(words::CROSS)).clicked() {
            self.is_open = !self.is_open;
        }
    }

    /// Counts again: the corpus or the answer changed.
    pub(super) fn forget_cross_counts(&mut self) {
        self.counted = None;
    }

    pub(super) fn receive_cross_counts(&mut self, id: WorkId, ended: &WorkResult) {
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(WorkOutcome::Tallied(tally)) => self.table = Some(Ok(tally.clone())),
            Ok(_) => {}
            Err(error) => self.table = Some(Err(error.to_string())),
        }
    }

    /// Shows the open table; a press on a cell returns the query for its tokens.
    pub(super) fn show_cross_table(&mut self, ui: &Ui, seen: &PaneInput<'_>, query: &str) -> Option<String> {
        if !self.is_open {
            return None;
        }
        let usual = || ["configuration", "placement"].map(str::to_owned);
        let fields = self.fields.get_or_insert_with(usual);
        let now = (query.to_owned(), fields.clone());
        if self.counted.as_ref() != Some(&now) {
            let job = searching::tally_values_job(now.0.clone(), fields.to_vec());
            self.asked = Some(seen.request_work(job));
            (self.counted, self.table) = (Some(now), None);
        }
        let (mut is_open, mut chosen) = (true, None);
        Window::new(seen.say_text(words::CROSS_TITLE))
            .open(&mut is_open)
            .default_size(CROSS_TABLE_SIZE)
            .show(ui.ctx(), |ui| {
                ui.horizontal_wrapped(|ui| {
                    let all = countable_fields(seen);
                    for (field, label) in fields.iter_mut().zip([words::CROSS_ROWS, words::CROSS_COLUMNS]) {
                        show_named_combo(ui, seen.say_text(label), field, &all);
                    }
                    if let Some(Ok(tally)) = &self.table
                        && ui.button(seen.say_text(words::CROSS_COPY)).clicked()
                    {
                        ui.copy_text(tally_as_tabs(tally));
                    }
                });
                match &self.table {
                    Some(Ok(tally)) => chosen = show_cross_cells(ui, seen, tally, query),
                    Some(Err(wrong)) => {
                        let wrong = translate_library_message(wrong, seen.language);
                        ui.label(RichText::new(wrong).color(seen.pane_colours().trouble));
                    }
                    None => drop(ui.spinner()),
                }
            });
        self.is_open = is_open;
        chosen
    }
}

/// Returns the fields that can be counted, with their names.
fn countable_fields(seen: &PaneInput<'_>) -> Vec<(String, String)> {
    let components = SignComponent::ALL_COMPONENTS
        .into_iter()
        .map(|component| component.component_name().to_owned());
    let properties = "gloss signer recording origin hand lexicon tier file";
    let attributes = seen.snapshot.overview.attributes.iter();
    let fields = components
        .chain(properties.split(' ').map(str::to_owned))
        .chain(attributes.map(|name| attribute_field_text(name)));
    fields.map(|field| (field.clone(), facet_name(&field, seen))).collect()
}

/// Draws the cells of a table; returns the query with the values of the one that is pressed.
fn show_cross_cells(ui: &mut Ui, seen: &PaneInput<'_>, tally: &ValueTally, query: &str) -> Option<String> {
    let [rows, columns] = &tally.fields[..] else {
        return None;
    };
    let mut chosen = None;
    let drawn = tally.columns.len().min(MAX_DRAWN_COLUMNS);
    if drawn < tally.columns.len() {
        let left_out = tally.columns.len() - drawn;
        ui.weak(fill_text_braces(
            seen.say_text(words::CROSS_LEFT_OUT),
            &[("n", &left_out)],
        ));
    }
    let cell = |ui: &mut Ui, text: &str| ui.add_sized(CROSS_CELL_SIZE, Button::new(text).frame(false).truncate());
    // The head is a row like the others, so that it scrolls sideways with them.
    ScrollArea::both()
        .auto_shrink(false)
        .show_rows(ui, CROSS_CELL_SIZE[1], tally.rows.len() + 1, |ui, range| {
            for at in range {
                ui.horizontal(|ui| {
                    ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
                    let row = at.checked_sub(1).map(|at| &tally.rows[at]);
                    let of_row = row.map(|row| (rows, &row.value));
                    let title = row.map_or_else(String::new, |row| format!("{} ({})", row.value, row.total));
                    if cell(ui, &title).clicked() {
                        chosen = narrowed_query(query, of_row.into_iter());
                    }
                    for (column, value) in tally.columns[..drawn].iter().enumerate() {
                        let count = row.map(|row| row.counts.get(column).copied().unwrap_or_default());
                        let text = count.map_or_else(|| value.clone(), |count| count.to_string());
                        let response = ui.add_enabled_ui(count != Some(0), |ui| cell(ui, &text)).inner;
                        if response
                            .on_hover_text(format!("{} · {value}", row.map_or("", |row| &row.value)))
                            .clicked()
                        {
                            chosen = narrowed_query(query, of_row.into_iter().chain([(columns, value)]));
                        }
                    }
                });
            }
        });
    chosen
}

/// Returns the query with a condition for each value of a field; `None` if a query cannot name one of them.
fn narrowed_query<'a>(query: &str, values: impl Iterator<Item = (&'a String, &'a String)>) -> Option<String> {
    let mut narrowed = query.to_owned();
    for (field, value) in values {
        let quoted = value.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
        let condition = match value.as_str() {
            NO_VALUE | "n/a" | "unclear" => format!("{field}={value}"),
            text => facet_condition(field, quoted.unwrap_or(text))?,
        };
        narrowed = add_query_condition(&narrowed, &condition);
    }
    Some(narrowed)
}

/// Returns a table with tabs between its cells, as spreadsheets paste it.
fn tally_as_tabs(tally: &ValueTally) -> String {
    let plain = |text: &str| text.replace(['\t', '\n', '\r'], " ");
    let mut text = tally.fields.join(" / ");
    for column in &tally.columns {
        text += &format!("\t{}", plain(column));
    }
    for row in &tally.rows {
        let counts: String = row.counts.iter().map(|count| format!("\t{count}")).collect();
        text += &format!("\n{}{counts}", plain(&row.value));
    }
    text + "\n"
}

#[cfg(test)]
mod tests;
