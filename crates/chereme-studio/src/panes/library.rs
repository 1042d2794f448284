//! The recordings of the corpus, to choose one.

use chereme_corpus::RecordingGlance;
use chereme_motion::{Instant, Span};
use chereme_sign::text::fold;
use eframe::egui::{Rect, RichText, ScrollArea, TextEdit, Ui, Vec2, vec2};

use super::Pane;
use super::timeline::data::time_text;
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::little::{self, Cell, Motion};
use crate::words::{Text, library as words};

/// A recording as the list shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) id: i64,
    pub(crate) name: String,
    /// Signer, origin and duration.
    pub(crate) about: String,
    /// All of it, and whether there is movement in it.
    pub(crate) whole: Span,
    pub(crate) moves: bool,
}

/// Returns the recordings whose name or signer holds `filter`, whatever its case and accents.
pub(crate) fn rows(
    recordings: &[RecordingGlance],
    filter: &str,
    origin: impl Fn(&str) -> String,
) -> Vec<Row> {
    let wanted = fold(filter.trim());
    let fits = |it: &&RecordingGlance| {
        wanted.is_empty()
            || fold(&it.row.name).contains(&wanted)
            || it
                .row
                .signer
                .as_deref()
                .is_some_and(|signer| fold(signer).contains(&wanted))
    };
    let row = |it: &RecordingGlance| {
        let parts = [
            it.row.signer.clone(),
            Some(origin(&it.row.origin)),
            Some(time_text(Instant::from_micros(it.row.duration_us))),
        ];
        Row {
            id: it.row.id,
            name: it.row.name.clone(),
            about: parts.into_iter().flatten().collect::<Vec<_>>().join(" · "),
            whole: Span::between(Instant::ZERO, Instant::from_micros(it.row.duration_us)),
            moves: it.frames > 0,
        }
    };
    recordings.iter().filter(fits).map(row).collect()
}

/// Returns what an origin is called; an unknown one is called by its name.
pub(crate) fn origin_text(origin: &str) -> Option<Text> {
    match origin {
        "captured" => Some(words::CAPTURED),
        "made" => Some(words::MADE),
        "generated" => Some(words::GENERATED),
        _ => None,
    }
}

/// The pane.
#[derive(Default)]
pub(crate) struct Library {
    filter: String,
}

impl Pane for Library {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let overview = &seen.snapshot.overview;
        if overview.recordings.is_empty() {
            ui.label(seen.say(words::EMPTY));
            if ui.button(seen.say(words::IMPORT)).clicked() {
                out.send(Command::Do(Action::Import));
            }
            return;
        }
        let filter = TextEdit::singleline(&mut self.filter)
            .hint_text(seen.say(words::FILTER))
            .desired_width(f32::INFINITY);
        let label = ui.label(RichText::new(seen.say(words::FILTER)).small());
        ui.add(filter).labelled_by(label.id);
        let origin =
            |name: &str| origin_text(name).map_or(name.to_owned(), |it| seen.say(it).to_owned());
        let rows = rows(&overview.recordings, &self.filter, origin);
        if rows.is_empty() {
            ui.label(seen.say(words::NONE_FIT));
            return;
        }
        let height = ui.spacing().interact_size.y * 2.1;
        ScrollArea::vertical()
            .auto_shrink(false)
            .show_rows(ui, height, rows.len(), |ui, range| {
                for row in &rows[range] {
                    show(ui, row, height, seen, out);
                }
            });
    }
}

fn show(ui: &mut Ui, row: &Row, height: f32, seen: &Seen<'_>, out: &mut Outbox) {
    let chosen = seen.shown.recording == Some(row.id);
    let lead = height - 4.0;
    let response = super::list_row_after(ui, (height, lead), chosen, &row.name, &row.about);
    if row.moves {
        let at = response.rect.left_center() + vec2(4.0 + lead / 2.0, 0.0);
        let motion = Motion::Span(row.id, row.whole);
        let mut cell = Cell::new(motion, Vec2::splat(lead));
        if response.hovered() || response.has_focus() {
            cell = cell.playing(little::clock(ui));
        }
        let rect = Rect::from_center_size(at, cell.size);
        seen.little.paint(ui, seen, out, &cell, rect);
    }
    if response.clicked() {
        out.send(Command::Recording(row.id));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::RecordingRow;

    fn glance(id: i64, name: &str, signer: Option<&str>) -> RecordingGlance {
        let row = RecordingRow {
            id,
            name: name.into(),
            signer_id: None,
            signer: signer.map(str::to_owned),
            origin: "made".into(),
            duration_us: 1_500_000,
            licence: None,
            notes: None,
        };
        RecordingGlance {
            row,
            frames: 1,
            rate: None,
            offset_us: 0,
            tiers: 0,
            tokens: 0,
            recipe: None,
        }
    }

    #[test]
    fn recordings_are_filtered_by_name_and_signer_whatever_the_accents() {
        let all = [
            glance(1, "Écureuil", None),
            glance(2, "bol", Some("Zoé")),
            glance(3, "chat", None),
        ];
        let ids = |filter: &str| -> Vec<i64> {
            rows(&all, filter, str::to_owned)
                .iter()
                .map(|row| row.id)
                .collect()
        };
        assert_eq!(ids(""), [1, 2, 3]);
        assert_eq!(ids("ecu"), [1]);
        assert_eq!(ids(" ZOE "), [2]);
        assert_eq!(
            rows(&all, "bol", str::to_owned)[0].about,
            "Zoé · made · 0:01.500"
        );
    }
}
