//! The editable details of a token.

use chereme_corpus::{Address, TokenDetails};
use chereme_motion::{Instant, Span};
use eframe::egui::{CollapsingHeader, Id, Label, RichText, Ui};

use super::edit::{field, grid, name_and_value};
use super::ui::{link, set, span_text, values_like};
use super::{Inspector, Thing, data, notation};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::library::data::origin_text;
use crate::panes::longest_word;
use crate::panes::recombine::recipe_of;
use crate::panes::search::feature_text;
use crate::pickers::hamnosys;
use crate::words::inspector as words;
use crate::work::recordings;

pub(super) fn show(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    token: &TokenDetails,
    out: &mut Outbox,
) {
    let row = &token.row;
    grid(ui, "token", |ui| {
        ui.weak(seen.say(words::SIGN));
        link(it, ui, &row.gloss, Thing::Sign(row.sign_id));
        ui.end_row();
        let origin = seen.say(origin_text(row.origin));
        name_and_value(ui, seen, words::ORIGIN, origin);
        if let Some((start, end)) = row.start_us.zip(row.end_us) {
            let micros = Instant::from_micros;
            let span = Span::between(micros(start), micros(end));
            name_and_value(ui, seen, words::SPAN, &span_text(span));
        }
        ui.weak(seen.say(words::CITATION));
        if row.citation {
            ui.label(seen.say(words::CITATION_IS));
        } else if ui.small_button(seen.say(words::CITATION_MAKE)).clicked() {
            out.work(recordings::set_citation(Address::Token(row.id)));
        }
        ui.end_row();
        coding(it, ui, seen, token, out);
        if let Some(recipe) = &token.recipe {
            name_and_value(ui, seen, words::RECIPE, &seen.snapshot.named(recipe));
        }
        if !token.made_from.is_empty() {
            ui.weak(seen.say(words::MADE_FROM));
            ui.horizontal_wrapped(|ui| {
                for address in &token.made_from {
                    match address.parse() {
                        Ok(Address::Token(id)) => {
                            let name = seen.snapshot.named(address);
                            link(it, ui, &name, Thing::Token(id));
                        }
                        _ => drop(ui.label(address)),
                    }
                }
            });
            ui.end_row();
        }
        if !token.made_into.is_empty() {
            ui.weak(seen.say(words::MADE_INTO));
            ui.horizontal_wrapped(|ui| {
                for (recording, name) in &token.made_into {
                    link(it, ui, name, Thing::Recording(*recording));
                }
            });
            ui.end_row();
        }
    });
    if let Some(notation) = &token.notation {
        hamnosys(ui, seen, notation);
    }
    ui.horizontal_wrapped(|ui| {
        if let Some(recipe) = &token.recipe
            && ui.button(seen.say(words::OPEN_RECIPE)).clicked()
        {
            let opened = row.recording.clone().or(Some(row.gloss.clone()));
            out.send(Command::Recipe(recipe.clone(), opened));
        }
        if row.recording_id.is_some() && ui.button(seen.say(words::RECOMBINE)).clicked() {
            let overview = &seen.snapshot.overview;
            let recipe = recipe_of(overview, row.id, &row.gloss);
            out.send(Command::Recipe(recipe, None));
        }
        if let (Some(recording), Some((start, end))) =
            (row.recording_id, row.start_us.zip(row.end_us))
            && seen.shown.recording != Some(recording)
            && ui.button(seen.say(words::SHOW)).clicked()
        {
            let micros = Instant::from_micros;
            out.send(Command::Place(
                recording,
                Span::between(micros(start), micros(end)),
            ));
            out.send(Command::Look);
        }
    });
}

/// Shows a notation part by part: drawn symbols with their names.
pub(super) fn hamnosys(ui: &mut Ui, seen: &PaneInput<'_>, text: &str) {
    let parts = notation::parts(text);
    let title = RichText::new(seen.say(words::NOTATION));
    CollapsingHeader::new(title)
        .id_salt("hamnosys")
        .default_open(true)
        .show(ui, |ui| {
            if parts.is_empty() {
                ui.add(Label::new(text).wrap());
            }
            grid(ui, "hamnosys parts", |ui| {
                for (part, drawn) in &parts {
                    let names = notation::names(drawn);
                    let name = RichText::new(seen.say(*part)).weak();
                    ui.add(Label::new(name).extend());
                    ui.vertical(|ui| {
                        hamnosys::strip(ui, seen, drawn, hamnosys::EM);
                        ui.add(Label::new(RichText::new(&names).small().weak()).wrap());
                    });
                    ui.end_row();
                }
            });
        });
}

/// Returns the name of a field of a token; the name of the field comes before that of the hand, if a component has
/// several fields.
fn field_name(seen: &PaneInput<'_>, field: &str) -> String {
    let (texts, rest) = data::field_words(field);
    let mut name: Vec<&str> = texts.iter().map(|text| seen.say(*text)).collect();
    let after = name.len().min(1);
    let rest = rest.into_iter().map(|it| feature_text(it, seen));
    name.splice(after..after, rest);
    name.join(" ")
}

/// Shows the coding of a token; values that come from annotations can be changed.
fn coding(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    token: &TokenDetails,
    out: &mut Outbox,
) {
    let names = (ui.available_width() * 0.45).clamp(80.0, 190.0);
    if token.values.is_empty() {
        ui.label("");
        ui.weak(seen.say(words::UNSET_ALL));
        ui.end_row();
    }
    let called: Vec<String> = token
        .values
        .iter()
        .map(|it| field_name(seen, &it.field))
        .collect();
    let names = names.max(longest_word(ui, called.iter().map(String::as_str)));
    for (value, name) in token.values.iter().zip(&called) {
        let now = value.state.missing_text().or(value.value.as_deref());
        let now = now.unwrap_or_default().to_owned();
        let text = Label::new(RichText::new(name).weak()).wrap();
        let label = ui.scope(|ui| {
            ui.set_max_width(names);
            ui.add(text).id
        });
        let label = label.inner;
        ui.horizontal(|ui| {
            if let Some(annotation) = value.annotation {
                let key = Id::unique(("token value", token.row.id, &value.field, annotation));
                let candidates = |typed: &str| values_like(seen, value.inventory, typed);
                ui.set_max_width((ui.available_width() - 24.0).max(60.0));
                if let Some(text) = field(ui, seen, key, label, &now, &candidates) {
                    set(out, annotation, [None, None], Some(text));
                }
            } else {
                ui.label(&now);
            }
            if let Some((inventory, id)) = value.inventory.zip(value.value.clone()) {
                link(it, ui, "?", Thing::Value(inventory, id));
            }
        });
        ui.end_row();
    }
}
