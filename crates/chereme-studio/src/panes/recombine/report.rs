//! The composition of a generated sign: the source of each channel, joins, contacts, warnings.

use chereme_corpus::recipe::{JoinReport, Report};
use eframe::egui::{CollapsingHeader, Grid, RichText, Ui};

use crate::context::PaneInput;
use crate::words::{Text, fill, recombine as words};

/// Changes of velocity at a join above this are visible, in metres per second.
const JOLT: f64 = 0.5;

/// Returns texts about a join: its place, and the jumps of position and velocity.
pub(super) fn join_text(join: &JoinReport) -> (String, String) {
    let place = format!(
        "{:.2}–{:.2} s",
        join.span.start().seconds(),
        join.span.end().seconds()
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
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, report: &Report) {
    for warning in &report.warnings {
        ui.label(
            RichText::new(format!("! {}", seen.snapshot.named(warning)))
                .small()
                .color(seen.colours().trouble),
        );
    }
    section(ui, seen, words::CHANNELS, report.channels.len(), |ui| {
        Grid::new("channels")
            .num_columns(2)
            .striped(true)
            .show(ui, |ui| {
                for channel in &report.channels {
                    ui.small(&channel.channel);
                    let from = seen.snapshot.named(&channel.from.join(" → "));
                    ui.add(eframe::egui::Label::new(RichText::new(from).small()).wrap());
                    ui.end_row();
                }
            });
    });
    section(ui, seen, words::JOINS, report.joins.len(), |ui| {
        for join in &report.joins {
            let (place, how) = join_text(join);
            let hand = match join.hand {
                chereme_motion::Side::Right => words::RIGHT_HAND,
                chereme_motion::Side::Left => words::LEFT_HAND,
            };
            ui.small(format!("{} · {place} · {}", seen.say(hand), join.what));
            let colour = if join.velocity > JOLT {
                seen.colours().trouble
            } else {
                ui.visuals().weak_text_color()
            };
            ui.label(RichText::new(how).small().color(colour));
        }
    });
    section(ui, seen, words::CONTACTS, report.contacts.len(), |ui| {
        for contact in &report.contacts {
            ui.small(seen.snapshot.named(contact));
        }
    });
}

/// Shows a foldable part of the report, if it is not empty.
fn section(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: Text,
    count: usize,
    content: impl FnOnce(&mut Ui),
) {
    if count == 0 {
        return;
    }
    let title = fill(seen.say(text), &[("n", &count)]);
    CollapsingHeader::new(RichText::new(title).small())
        .id_salt(text.en)
        .show(ui, content);
}
