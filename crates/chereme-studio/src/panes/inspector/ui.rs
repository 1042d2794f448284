//! The inspector's widgets, part by part.

use chereme_corpus::{
    Address, AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, Details, Hands,
    Moment, StoredInventory, TierChange, TierName, TierRow, TokenDetails, ValueState, Values,
};
use chereme_motion::{Instant, Span};
use eframe::egui::{CollapsingHeader, Id, RichText, Ui};

use super::about::{self, recording, recording_more, signer, signer_more};
use super::data::{self, Line};
use super::edit::{choice, field, grid, line, offered, said, title};
use super::{Inspector, Thing, notation};
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::model::Found;
use crate::panes::complete::fitting;
use crate::panes::library::origin_text;
use crate::panes::timeline::data::{time_text, value_text};
use crate::words::{Text, fill, inspector as words, timeline};
use crate::work::Work;

pub(super) fn lines(ui: &mut Ui, seen: &Seen<'_>, id: &str, lines: &[Line]) {
    grid(ui, id, |ui| {
        for (text, value) in lines {
            said(ui, seen, *text, value);
        }
    });
}

/// Shows a part that can be folded away.
fn part(
    ui: &mut Ui,
    seen: &Seen<'_>,
    text: Text,
    open: bool,
    what: &str,
    content: impl FnOnce(&mut Ui),
) {
    let title = RichText::new(format!("{} · {what}", seen.say(text)));
    CollapsingHeader::new(title)
        .id_salt(text.en)
        .default_open(open)
        .show(ui, content);
}

/// Shows a link to something else.
pub(super) fn link(inspector: &mut Inspector, ui: &mut Ui, text: &str, to: Thing) {
    if ui.link(text).clicked() {
        inspector.turned = Some(to);
    }
}

/// Shows what is selected: the annotation, its token, the tier, the recording, the signer.
pub(super) fn selected(it: &mut Inspector, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    let Some(recording) = seen
        .shown
        .recording
        .and_then(|id| seen.snapshot.recording(id))
    else {
        return;
    };
    let found = seen
        .shown
        .annotation()
        .and_then(|id| seen.snapshot.annotation(id));
    if let Some(found) = found {
        title(ui, seen.say(words::ANNOTATION), &found.tier.row.name);
        annotation(ui, seen, found, out);
        ui.separator();
    } else if let Some(span) = seen.shown.span {
        lines(ui, seen, "span", &[(words::SPAN, span_text(span))]);
        ui.separator();
    }
    let token = crate::panes::recombine::selected_token(seen)
        .filter(|_| found.is_some() || seen.shown.span.is_some());
    if let Some((token, gloss)) = token {
        part(ui, seen, words::TOKEN, true, &gloss, |ui| {
            thing(it, ui, seen, &Thing::Token(token), out);
        });
    }
    let tier = found.map(|found| found.tier).or_else(|| {
        let contents = seen.snapshot.contents(recording.row.id)?;
        contents
            .tiers
            .iter()
            .find(|tier| Some(tier.row.id) == seen.shown.tier)
    });
    if let Some(tier) = tier {
        part(
            ui,
            seen,
            words::TIER,
            found.is_none(),
            &tier.row.name,
            |ui| {
                self::tier(ui, seen, tier, out);
            },
        );
    }
    let open = found.is_none();
    part(
        ui,
        seen,
        words::RECORDING,
        open,
        &recording.row.name,
        |ui| {
            thing(it, ui, seen, &Thing::Recording(recording.row.id), out);
        },
    );
    if let Some((id, name)) = recording.row.signer_id.zip(recording.row.signer.as_ref()) {
        part(ui, seen, words::SIGNER, false, name, |ui| {
            thing(it, ui, seen, &Thing::Signer(id), out);
        });
    }
}

/// Shows all that is known of something.
pub(super) fn thing(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &Seen<'_>,
    thing: &Thing,
    out: &mut Outbox,
) {
    if let Thing::Recording(id) = thing
        && let Some(glance) = seen.snapshot.recording(*id)
    {
        recording(ui, seen, glance, out);
    }
    if let Thing::Signer(id) = thing
        && let Some(row) = seen
            .snapshot
            .overview
            .signers
            .iter()
            .find(|row| row.id == *id)
    {
        signer(ui, seen, row, out);
    }
    match it.details(thing, out) {
        None => drop(ui.spinner()),
        Some(Err(wrong)) => drop(ui.label(RichText::new(wrong).color(seen.colours().trouble))),
        Some(Ok(Details::Token(token))) => self::token(it, ui, seen, &token, out),
        Some(Ok(Details::Sign(sign))) => about::sign(it, ui, seen, &sign, out),
        Some(Ok(Details::Signer(signer))) => signer_more(it, ui, seen, &signer),
        Some(Ok(Details::Recording(recording))) => recording_more(ui, seen, &recording),
        Some(Ok(Details::Value(inventory, value, uses))) => {
            about::value(it, ui, seen, (inventory, &value), uses, out);
        }
    }
}

fn span_text(span: Span) -> String {
    format!("{} – {}", time_text(span.start()), time_text(span.end()))
}

fn missing<'a>(seen: &Seen<'a>, state: ValueState) -> &'static str {
    match state {
        ValueState::NotApplicable => seen.say(timeline::NOT_APPLICABLE),
        ValueState::Unclear => seen.say(timeline::UNCLEAR),
        _ => seen.say(timeline::UNSET),
    }
}

/// Has an annotation changed.
fn set(out: &mut Outbox, id: i64, times: [Option<Instant>; 2], value: Option<String>) {
    let [start, end] = times.map(|at| at.map(Moment::Time));
    let action = AnnotationAction::Set {
        annotation: AnnotationName::Number(id),
        start,
        end,
        value,
    };
    let changes = vec![AnnotationChange::from(action)];
    out.work(Work::Annotate(changes, AnnotateOptions::default()));
}

/// Returns what a value of the inventory of that row could be.
fn values_like(seen: &Seen<'_>, inventory: Option<i64>, typed: &str) -> Vec<String> {
    let all = &seen.snapshot.overview.inventories;
    let found = all.iter().find(|it| Some(it.id) == inventory);
    found.map_or(Vec::new(), |it| {
        fitting(it.inventory.values.iter().map(|it| it.id.as_str()), typed)
    })
}

fn annotation(ui: &mut Ui, seen: &Seen<'_>, found: Found<'_>, out: &mut Outbox) {
    let (row, columns, at) = (&found.tier.row, &found.tier.annotations, found.at);
    let id = columns.ids[at];
    grid(ui, "annotation", |ui| {
        let value = match columns.states[at] {
            ValueState::Value => columns.values[at].to_string(),
            _ => String::new(),
        };
        let glosses = seen
            .snapshot
            .overview
            .signs
            .iter()
            .map(|it| it.gloss.as_str());
        let candidates = |typed: &str| match row.role.as_str() {
            "gloss" => fitting(glosses.clone(), typed),
            _ => values_like(seen, row.inventory_id, typed),
        };
        let key = Id::unique(("annotation value", id));
        if let Some(value) = offered(ui, seen, key, words::VALUE, &value, &candidates) {
            set(out, id, [None, None], Some(value));
        }
        if columns.states[at] != ValueState::Value {
            let text = value_text(columns, at, |state| missing(seen, state)).to_owned();
            ui.label("");
            ui.weak(text);
            ui.end_row();
        }
        let span = columns.span(at);
        for (text, now, first) in [
            (words::START, span.start(), true),
            (words::END, span.end(), false),
        ] {
            let key = Id::unique(("annotation time", id, first));
            if let Some(typed) = line(ui, seen, key, text, &time_text(now)) {
                let at = data::read_time(&typed);
                if at.is_some() {
                    set(out, id, if first { [at, None] } else { [None, at] }, None);
                }
            }
        }
        if let Some(sure) = columns.confidences[at] {
            said(
                ui,
                seen,
                words::CONFIDENCE,
                &format!("{:.0} %", sure * 100.0),
            );
        }
        if let Some(above) = columns.parents[at].and_then(|id| seen.snapshot.annotation(id)) {
            let text = value_text(&above.tier.annotations, above.at, |state| {
                missing(seen, state)
            });
            said(
                ui,
                seen,
                words::PARENT,
                &format!("{text} ({})", above.tier.row.name),
            );
        }
        if let Some(annotator) = &row.annotator {
            said(ui, seen, words::ANNOTATOR, annotator);
        }
    });
}

fn token(it: &mut Inspector, ui: &mut Ui, seen: &Seen<'_>, token: &TokenDetails, out: &mut Outbox) {
    let row = &token.row;
    grid(ui, "token", |ui| {
        ui.weak(seen.say(words::SIGN));
        link(it, ui, &row.gloss, Thing::Sign(row.sign_id));
        ui.end_row();
        let origin = origin_text(&row.origin).map_or(row.origin.as_str(), |text| seen.say(text));
        said(ui, seen, words::ORIGIN, origin);
        if let Some((start, end)) = row.start_us.zip(row.end_us) {
            let micros = Instant::from_micros;
            let span = Span::between(micros(start), micros(end));
            said(ui, seen, words::SPAN, &span_text(span));
        }
        ui.weak(seen.say(words::CITATION));
        if row.citation {
            ui.label(seen.say(words::CITATION_IS));
        } else if ui.small_button(seen.say(words::CITATION_MAKE)).clicked() {
            out.work(Work::SetCitation(Address::Token(row.id)));
        }
        ui.end_row();
        coding(it, ui, seen, token, out);
        if let Some(recipe) = &token.recipe {
            said(ui, seen, words::RECIPE, recipe);
        }
        if !token.made_from.is_empty() {
            ui.weak(seen.say(words::MADE_FROM));
            ui.horizontal_wrapped(|ui| {
                for address in &token.made_from {
                    match address.parse() {
                        Ok(Address::Token(id)) => link(it, ui, address, Thing::Token(id)),
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
            out.send(Command::Recipe(format!("token:{}", row.id), None));
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
        }
    });
}

/// Shows a notation part by part, by the names of its symbols.
pub(super) fn hamnosys(ui: &mut Ui, seen: &Seen<'_>, text: &str) {
    let parts = notation::parts(text);
    let title = RichText::new(seen.say(words::NOTATION));
    CollapsingHeader::new(title)
        .id_salt("hamnosys")
        .default_open(true)
        .show(ui, |ui| {
            if parts.is_empty() {
                ui.add(eframe::egui::Label::new(text).wrap());
            }
            lines(ui, seen, "hamnosys parts", &parts);
        });
}

/// What a token is coded as; what an annotation says can be changed.
fn coding(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &Seen<'_>,
    token: &TokenDetails,
    out: &mut Outbox,
) {
    if token.values.is_empty() {
        ui.label("");
        ui.weak(seen.say(words::UNSET_ALL));
        ui.end_row();
    }
    for value in &token.values {
        let (texts, rest) = data::field_words(&value.field);
        let name: Vec<&str> = texts
            .iter()
            .map(|text| seen.say(*text))
            .chain(rest)
            .collect();
        let name = name.join(" ");
        let now = match value.state.as_str() {
            "value" => value.value.clone().unwrap_or_default(),
            "not-applicable" => "n/a".to_owned(),
            other => other.to_owned(),
        };
        let label = ui.add(eframe::egui::Label::new(RichText::new(&name).weak()).truncate());
        let label = label.on_hover_text(&name).id;
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

fn tier(ui: &mut Ui, seen: &Seen<'_>, tier: &chereme_corpus::TierContents, out: &mut Outbox) {
    let row = &tier.row;
    let change = |out: &mut Outbox, change: TierChange| {
        out.work(Work::ChangeTier(TierName::Number(row.id), change));
    };
    grid(ui, "tier", |ui| {
        let key = Id::unique(("tier name", row.id));
        if let Some(name) = line(ui, seen, key, words::NAME, &row.name) {
            let name = Some(name);
            change(
                out,
                TierChange {
                    name,
                    ..TierChange::default()
                },
            );
        }
        said(ui, seen, words::ROLE, &data::role(row));
        if let Some(hand) = choice(ui, seen, words::HAND, &row.hand, &hands(seen)) {
            let hand = Some(hand.and_then(|name| Hands::of(&name)));
            change(
                out,
                TierChange {
                    hand,
                    ..TierChange::default()
                },
            );
        }
        if let Some(inventory) = choice(
            ui,
            seen,
            words::INVENTORY,
            &row.inventory_id,
            &inventories(seen, row),
        ) {
            let of = |id: i64| {
                seen.snapshot
                    .overview
                    .inventories
                    .iter()
                    .find(|it| it.id == id)
            };
            let values = match inventory.and_then(of) {
                Some(it) => Values::Inventory(it.inventory.id.clone()),
                None => Values::Free,
            };
            let values = Some(values);
            change(
                out,
                TierChange {
                    values,
                    ..TierChange::default()
                },
            );
        }
        let above = seen.snapshot.open.as_ref().and_then(|open| {
            let tiers = &open.contents.tiers;
            tiers.iter().find(|it| Some(it.row.id) == row.parent_id)
        });
        if let Some(above) = above {
            let how = row
                .stereotype
                .as_deref()
                .unwrap_or_default()
                .replace('_', " ");
            said(
                ui,
                seen,
                words::PARENT,
                &format!("{} ({how})", above.row.name),
            );
        }
        for (text, value) in [
            (words::PARTICIPANT, &row.participant),
            (words::ANNOTATOR, &row.annotator),
        ] {
            if let Some(value) = value {
                said(ui, seen, text, value);
            }
        }
        let (n, values) = data::tier_counts(tier);
        let counts: [(&str, &dyn std::fmt::Display); 2] = [("n", &n), ("values", &values)];
        said(
            ui,
            seen,
            words::COUNT,
            &fill(seen.say(words::FILLED), &counts),
        );
    });
}

fn hands(seen: &Seen<'_>) -> Vec<(Option<String>, String)> {
    [
        (None, words::NOBODY),
        (Some("right"), words::RIGHT),
        (Some("left"), words::LEFT),
        (Some("both"), words::BOTH),
        (Some("dominant"), words::DOMINANT),
        (Some("weak"), words::WEAK),
    ]
    .map(|(name, text)| (name.map(str::to_owned), seen.say(text).to_owned()))
    .into()
}

/// The inventories that a tier could take its values from.
fn inventories(seen: &Seen<'_>, row: &TierRow) -> Vec<(Option<i64>, String)> {
    let fits = |it: &&StoredInventory| {
        row.component.as_deref() == Some(it.inventory.component.name())
            && it.inventory.feature == row.feature
            || row.inventory_id == Some(it.id)
    };
    let all = &seen.snapshot.overview.inventories;
    let named = all
        .iter()
        .filter(fits)
        .map(|it| (Some(it.id), it.inventory.id.clone()));
    [(None, "—".to_owned())].into_iter().chain(named).collect()
}
