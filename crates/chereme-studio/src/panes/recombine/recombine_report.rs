//! The composition of a generated sign: the source of each channel, joins, contacts, warnings.

use chereme_corpus::recipe::{GenerationReport, JoinReport};
use eframe::egui::{CollapsingHeader, Grid, RichText, Ui};

use crate::context::PaneInput;
use crate::words::{InterfaceText, fill_text_braces, recombine_words as words};

/// Changes of velocity at a join above this are visible, in metres per second.
const VISIBLE_JOLT_SPEED: f64 = 0.5;

/// Returns texts about a join: its place, and the jumps of position and velocity.
pub(super) fn join_text(join: &JoinReport) -> (String, String) {
    let place = format!(
        "{:.2}–{:.2} s",
        join.span.span_start_instant().instant_seconds(),
        join.span.span_end_instant().instant_seconds()
    );
    let how = format!(
        "{:.1} mm · {:.2} m/s · {:.0} m/s²",
        join.position * 1000.0,
        join.velocity,
        join.acceleration
    );
    (place, how)
}

/// Shows the report.
pub(super) fn show_recipe_report(ui: &mut Ui, seen: &PaneInput<'_>, report: &GenerationReport) {
    for warning in &report.warnings {
        ui.label(
            RichText::new(format!("! {}", seen.snapshot.name_tokens_in_text(warning)))
                .small()
                .color(seen.pane_colours().trouble),
        );
    }
    show_report_section(ui, seen, words::CHANNELS, report.channels.len(), |ui| {
        Grid::new("channels").num_columns(2).striped(true).show(ui, |ui| {
            for channel in &report.channels {
                ui.small(&channel.channel);
                let from = seen.snapshot.name_tokens_in_text(&channel.from.join(" → "));
                ui.add(eframe::egui::Label::new(RichText::new(from).small()).wrap());
                ui.end_row();
            }
        });
    });
    show_report_section(ui, seen, words::JOINS, report.joins.len(), |ui| {
        for join in &report.joins {
            let (place, how) = join_text(join);
            let hand = match join.hand {
                chereme_motion::BodySide::Right => words::RIGHT_HAND,
                chereme_motion::BodySide::Left => words::LEFT_HAND,
            };
            ui.small(format!("{} · {place} · {}", seen.say_text(hand), join.what));
            let colour = if join.velocity > VISIBLE_JOLT_SPEED {
                seen.pane_colours().trouble
            } else {
                ui.visuals().weak_text_color()
            };
            ui.label(RichText::new(how).small().color(colour));
        }
    });
    show_report_section(ui, seen, words::CONTACTS, report.contacts.len(), |ui| {
        for contact in &report.contacts {
            ui.small(seen.snapshot.name_tokens_in_text(contact));
        }
    });
}

/// Shows a foldable part of the report, if it is not empty.
fn show_report_section(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    count: usize,
    content: impl FnOnce(&mut Ui),
) {
    if count == 0 {
        return;
    }
    let title = fill_text_braces(seen.say_text(text), &[("n", &count)]);
    CollapsingHeader::new(RichText::new(title).small())
        .id_salt(text.text_id())
        .show(ui, content);
}
