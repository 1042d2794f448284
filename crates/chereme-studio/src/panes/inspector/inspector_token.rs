//! The editable details of a token.

use chereme_corpus::{CorpusAddress, OpinionStanding, TokenDetails, TokenValue, ValueOpinion};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{CollapsingHeader, Id, Label, RichText, Ui};

use super::inspector_data::{self, CodingRow};
use super::inspector_edit::{name_and_value, show_editable_field, show_inspector_grid};
use super::inspector_ui::{set_annotation, show_thing_link, span_text, values_like};
use super::{InspectorPane, inspector_notation};
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::panes::library::library_data::origin_text;
use crate::panes::longest_word;
use crate::panes::recombine::recipe_of;
use crate::panes::search::{feature_text, results};
use crate::panes::timeline::timeline_paint::hatch_proposal;
use crate::pickers::pickers_hamnosys;
use crate::words::inspector as words;
use crate::work::recordings_jobs;

pub(super) fn show_token_details(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, token: &TokenDetails) {
    let row = &token.row;
    show_inspector_grid(ui, "token", |ui| {
        ui.weak(seen.say_text(words::SIGN));
        show_thing_link(it, ui, &row.gloss, InspectedThing::Sign(row.sign_id));
        ui.end_row();
        if let Some(lexicon) = row
            .lexicon
            .as_deref()
            .filter(|_| seen.snapshot.overview.lexicons.len() > 1)
        {
            name_and_value(ui, seen, words::LEXICON, lexicon);
        }
        let origin = seen.say_text(origin_text(row.origin));
        name_and_value(ui, seen, words::ORIGIN, origin);
        if let Some((start, end)) = row.start_us.zip(row.end_us) {
            let micros = RecordingInstant::from_micros;
            let span = TimeSpan::span_between(micros(start), micros(end));
            name_and_value(ui, seen, words::SPAN, &span_text(span));
        }
        ui.weak(seen.say_text(words::CITATION));
        if row.citation {
            ui.label(seen.say_text(words::CITATION_IS));
        } else if ui.small_button(seen.say_text(words::CITATION_MAKE)).clicked() {
            seen.request_work(recordings_jobs::set_citation(CorpusAddress::Token(row.id)));
        }
        ui.end_row();
        show_token_coding(it, ui, seen, token);
        if let Some(recipe) = &token.recipe {
            name_and_value(ui, seen, words::RECIPE, &seen.snapshot.name_tokens_in_text(recipe));
        }
        if !token.made_from.is_empty() {
            ui.weak(seen.say_text(words::MADE_FROM));
            ui.horizontal_wrapped(|ui| {
                for address in &token.made_from {
                    match address.parse() {
                        Ok(CorpusAddress::Token(id)) => {
                            let name = seen.snapshot.name_tokens_in_text(address);
                            show_thing_link(it, ui, &name, InspectedThing::Token(id));
                        }
                        _ => drop(ui.label(address)),
                    }
                }
            });
            ui.end_row();
        }
        if !token.made_into.is_empty() {
            ui.weak(seen.say_text(words::MADE_INTO));
            ui.horizontal_wrapped(|ui| {
                for (recording, name) in &token.made_into {
                    show_thing_link(it, ui, name, InspectedThing::Recording(*recording));
                }
            });
            ui.end_row();
        }
    });
    if let Some(notation) = &token.notation {
        show_hamnosys_notation(ui, seen, notation);
    }
    ui.horizontal_wrapped(|ui| {
        if let Some(recipe) = &token.recipe
            && ui.button(seen.say_text(words::OPEN_RECIPE)).clicked()
        {
            let opened = row.recording.clone().or(Some(row.gloss.clone()));
            seen.send_command(WindowCommand::Recipe(recipe.clone(), opened));
        }
        if row.recording_id.is_some() && ui.button(seen.say_text(words::RECOMBINE)).clicked() {
            let overview = &seen.snapshot.overview;
            let recipe = recipe_of(overview, row.id, &row.gloss);
            seen.send_command(WindowCommand::Recipe(recipe, None));
        }
        if let (Some(recording), Some((start, end))) = (row.recording_id, row.start_us.zip(row.end_us))
            && seen.shown.recording != Some(recording)
            && ui.button(seen.say_text(words::SHOW)).clicked()
        {
            let micros = RecordingInstant::from_micros;
            seen.send_command(WindowCommand::Place(
                recording,
                TimeSpan::span_between(micros(start), micros(end)),
            ));
            seen.send_command(WindowCommand::Look);
        }
    });
}

/// Shows a notation part by part: drawn symbols with their names.
pub(super) fn show_hamnosys_notation(ui: &mut Ui, seen: &PaneInput<'_>, text: &str) {
    let parts = inspector_notation::split_notation_parts(text);
    let title = RichText::new(seen.say_text(words::NOTATION));
    CollapsingHeader::new(title)
        .id_salt("hamnosys")
        .default_open(true)
        .show(ui, |ui| {
            if parts.is_empty() {
                ui.add(Label::new(text).wrap());
            }
            show_inspector_grid(ui, "hamnosys parts", |ui| {
                for (part, drawn) in &parts {
                    let names = inspector_notation::short_symbol_names(drawn);
                    let name = RichText::new(seen.say_text(*part)).weak();
                    ui.add(Label::new(name).extend());
                    ui.vertical(|ui| {
                        pickers_hamnosys::show_symbol_strip(
                            ui,
                            seen,
                            drawn,
                            pickers_hamnosys::DEFAULT_SYMBOL_EM_POINTS,
                        );
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
    let (texts, rest) = inspector_data::field_words(field);
    let mut name: Vec<&str> = texts.iter().map(|text| seen.say_text(*text)).collect();
    let after = name.len().min(1);
    let rest = rest.into_iter().map(|feature| feature_text(feature, seen));
    name.splice(after..after, rest);
    name.join(" ")
}

/// Shows the coding of a token; values that come from annotations can be changed.
fn show_token_coding(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, token: &TokenDetails) {
    let names = (ui.available_width() * 0.45).clamp(80.0, 190.0);
    if token.values.is_empty() && token.opinions.is_empty() {
        ui.label("");
        ui.weak(seen.say_text(words::UNSET_ALL));
        ui.end_row();
    }
    let rows = inspector_data::coding_rows(&token.values, &token.opinions);
    let called: Vec<String> = rows.iter().map(|(field, _)| field_name(seen, field)).collect();
    let names = names.max(longest_word(ui, called.iter().map(String::as_str)));
    let mut above = None;
    for ((_, row), name) in rows.iter().zip(&called) {
        let repeated = above.replace(name) == Some(name);
        let value = match row {
            CodingRow::Value(value) => value,
            CodingRow::Opinion(opinion) => {
                ui.scope(|ui| {
                    ui.set_max_width(names);
                    let name = if repeated { "" } else { name };
                    ui.add(Label::new(RichText::new(name).weak()).wrap());
                });
                show_opinion(ui, seen, opinion);
                ui.end_row();
                continue;
            }
        };
        let current_text = value.state.missing_text().or(value.value.as_deref());
        let now = current_text.unwrap_or_default().to_owned();
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
                if let Some(text) = show_editable_field(ui, seen, key, label, &now, &candidates) {
                    set_annotation(seen.out, annotation, [None, None], Some(text));
                }
            } else {
                ui.label(&now);
            }
            if let Some((inventory, id)) = value.inventory.zip(value.value.clone()) {
                show_thing_link(it, ui, "?", InspectedThing::Value(inventory, id));
            }
        });
        ui.end_row();
        let said = value_source_text(value);
        if !said.is_empty() {
            ui.label("");
            ui.add(Label::new(RichText::new(said).small().weak()).wrap());
            ui.end_row();
        }
    }
    if !token.range_takes.is_empty() {
        name_and_value(ui, seen, words::RANGE_TAKES, &token.range_takes.join(", "));
    }
}

/// Returns who says a value: the annotators, and the detector with its confidence, and what it proposed if a person
/// corrected that.
fn value_source_text(value: &TokenValue) -> String {
    let confidence = value.confidence.map(|sure| format!("{sure:.2}"));
    let proposed = value.proposed.as_ref().map(|proposed| format!("({proposed})"));
    let people = Some(value.by.join(", ")).filter(|names| !names.is_empty());
    let parts = [people, value.detector.clone(), confidence, proposed];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

/// Shows a value that does not count: hatched if a detector proposes it, in the colour of warnings if it is disputed.
fn show_opinion(ui: &mut Ui, seen: &PaneInput<'_>, opinion: &ValueOpinion) {
    let mut text = RichText::new(opinion_text(seen, opinion)).italics();
    if opinion.standing == OpinionStanding::Disputed {
        text = text.color(seen.pane_colours().warning);
    }
    let shown = ui.add(Label::new(text).wrap());
    if opinion.standing == OpinionStanding::Proposed {
        let colour = seen.pane_colours().component.gamma_multiply(0.3);
        hatch_proposal(ui.painter(), shown.rect.expand(2.0), colour);
    }
}

/// Returns a value that does not count, with the reason, its author and the confidence of a detector.
fn opinion_text(seen: &PaneInput<'_>, opinion: &ValueOpinion) -> String {
    let standing = seen.say_text(results::standing_text(opinion.standing));
    let confidence = opinion.confidence.map(|share| format!("{share:.2}"));
    let author = opinion
        .by
        .clone()
        .filter(|_| !matches!(opinion.standing, OpinionStanding::Proposed | OpinionStanding::Rejected));
    let reasons: Vec<String> = [standing.to_owned()]
        .into_iter()
        .chain(author)
        .chain(confidence)
        .collect();
    format!("{} ({})", opinion.value, reasons.join(", "))
}
