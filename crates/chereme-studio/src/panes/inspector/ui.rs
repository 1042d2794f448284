//! The inspector's widgets, part by part.

use chereme_corpus::{
    AnnotationAction, AnnotationChange, AnnotationName, Details, Moment, TierRole, ValueState,
};
use chereme_motion::{Instant, Span};
use eframe::egui::{CollapsingHeader, Id, RichText, TextStyle, TextWrapMode, Ui, WidgetText};

use super::about::{self, recording, recording_more, signer, signer_more};
use super::data::{self, Line};
use super::edit::{grid, line, name_and_value, offered, title};
use super::{Inspector, Thing};
use crate::context::{Outbox, PaneInput};
use crate::model::Found;
use crate::panes::complete::fitting;
use crate::panes::timeline::data::{time_text, value_text};
use crate::words::{Text, inspector as words, timeline};
use crate::work::editing;

pub(super) fn lines(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, lines: &[Line]) {
    grid(ui, id, |ui| {
        for (text, value) in lines {
            name_and_value(ui, seen, *text, value);
        }
    });
}

/// Shows a foldable part.
fn part(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: Text,
    open: bool,
    what: &str,
    content: impl FnOnce(&mut Ui),
) {
    // A long name is cut, as a header would take the full width of its text.
    let title = WidgetText::from(format!("{} · {what}", seen.say(text)));
    let room = ui.available_width() - 24.0;
    let title = title.into_galley(ui, Some(TextWrapMode::Truncate), room, TextStyle::Button);
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

/// Shows the selection: the annotation, its token, the tier, the recording, the signer.
pub(super) fn selected(it: &mut Inspector, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
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
                super::tier::show(ui, seen, tier, out);
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

/// Shows all details of something.
pub(super) fn thing(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
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
        Some(Ok(Details::Token(token))) => super::token::show(it, ui, seen, &token, out),
        Some(Ok(Details::Sign(sign))) => about::sign(it, ui, seen, &sign, out),
        Some(Ok(Details::Signer(signer))) => signer_more(it, ui, seen, &signer),
        Some(Ok(Details::Recording(recording))) => recording_more(ui, seen, &recording, out),
        Some(Ok(Details::Value(inventory, value, uses))) => {
            about::value(it, ui, seen, (inventory, &value), uses, out);
        }
    }
}

pub(super) fn span_text(span: Span) -> String {
    format!("{} – {}", time_text(span.start()), time_text(span.end()))
}

fn missing<'a>(seen: &PaneInput<'a>, state: ValueState) -> &'static str {
    match state {
        ValueState::NotApplicable => seen.say(timeline::NOT_APPLICABLE),
        ValueState::Unclear => seen.say(timeline::UNCLEAR),
        _ => seen.say(timeline::UNSET),
    }
}

/// Changes an annotation's times or value.
pub(super) fn set(out: &mut Outbox, id: i64, times: [Option<Instant>; 2], value: Option<String>) {
    let [start, end] = times.map(|at| at.map(Moment::Time));
    let action = AnnotationAction::Set {
        annotation: AnnotationName::Number(id),
        start,
        end,
        value,
    };
    let changes = vec![AnnotationChange::from(action)];
    out.work(editing::annotate(changes));
}

/// Returns the values of an inventory that match the typed text.
pub(super) fn values_like(
    seen: &PaneInput<'_>,
    inventory: Option<i64>,
    typed: &str,
) -> Vec<String> {
    let all = &seen.snapshot.overview.inventories;
    let found = all.iter().find(|it| Some(it.id) == inventory);
    found.map_or(Vec::new(), |it| {
        fitting(it.inventory.values.iter().map(|it| it.id.as_str()), typed)
    })
}

fn annotation(ui: &mut Ui, seen: &PaneInput<'_>, found: Found<'_>, out: &mut Outbox) {
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
        let candidates = |typed: &str| match row.role {
            TierRole::Gloss => fitting(glosses.clone(), typed),
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
            name_and_value(
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
            name_and_value(
                ui,
                seen,
                words::PARENT,
                &format!("{text} ({})", above.tier.row.name),
            );
        }
        if let Some(annotator) = &row.annotator {
            name_and_value(ui, seen, words::ANNOTATOR, annotator);
        }
    });
}
