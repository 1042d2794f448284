//! The inspector's widgets, part by part.

use chereme_corpus::{
    AnnotationAction, AnnotationChange, AnnotationName, ObjectDetails, TableMoment, TierRole, ValueState,
};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{CollapsingHeader, Id, RichText, TextStyle, TextWrapMode, Ui, WidgetText};

use super::InspectorPane;
use super::about::{self, recording_more, show_recording_details, show_signer_details, signer_more};
use super::inspector_data::{self, InspectorLine};
use super::inspector_edit::{
    name_and_value, show_editable_line, show_inspector_grid, show_line_with_completion, show_part_title,
};
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::model::{FoundAnnotation, InspectedThing};
use crate::panes::complete_pane::fitting_candidates;
use crate::panes::timeline::timeline_data::{time_text, value_text};
use crate::words::{InterfaceText, inspector as words, timeline};
use crate::work::editing;

pub(super) fn show_inspector_lines(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, lines: &[InspectorLine]) {
    show_inspector_grid(ui, id, |ui| {
        for (text, value) in lines {
            name_and_value(ui, seen, *text, value);
        }
    });
}

/// Shows a foldable part.
fn show_inspector_part(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    open: bool,
    what: &str,
    content: impl FnOnce(&mut Ui),
) {
    // A long name is cut, as a header would take the full width of its text.
    let title = WidgetText::from(format!("{} · {what}", seen.say_text(text)));
    let room = ui.available_width() - 24.0;
    let title = title.into_galley(ui, Some(TextWrapMode::Truncate), room, TextStyle::Button);
    CollapsingHeader::new(title)
        .id_salt(text.text_id())
        .default_open(open)
        .show(ui, content);
}

/// Shows a link to something else.
pub(super) fn show_thing_link(inspector: &mut InspectorPane, ui: &mut Ui, text: &str, to: InspectedThing) {
    if ui.link(text).clicked() {
        inspector.turned = Some(to);
    }
}

/// Shows the selection: the annotation, its token, the tier, the recording, the signer.
pub(super) fn show_selected_details(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let Some(recording) = seen.shown.recording.and_then(|id| seen.snapshot.recording_glance(id)) else {
        return;
    };
    let selection = seen
        .shown
        .selected_annotation()
        .and_then(|id| seen.snapshot.find_open_annotation(id));
    if let Some(found) = selection {
        show_part_title(ui, seen.say_text(words::ANNOTATION), &found.tier.row.name);
        show_annotation_details(ui, seen, found);
        ui.separator();
    } else if let Some(span) = seen.shown.span {
        show_inspector_lines(ui, seen, "span", &[(words::SPAN, span_text(span))]);
        ui.separator();
    }
    let token =
        crate::panes::recombine::selected_token(seen).filter(|_| selection.is_some() || seen.shown.span.is_some());
    if let Some((token, gloss)) = token {
        show_inspector_part(ui, seen, words::TOKEN, true, &gloss, |ui| {
            show_thing_details(it, ui, seen, &InspectedThing::Token(token));
        });
    }
    let tier = selection.map(|found| found.tier).or_else(|| {
        let contents = seen.snapshot.recording_contents(recording.row.id)?;
        contents.tiers.iter().find(|tier| Some(tier.row.id) == seen.shown.tier)
    });
    if let Some(tier) = tier {
        show_inspector_part(ui, seen, words::TIER, selection.is_none(), &tier.row.name, |ui| {
            super::inspector_tier::show_tier_details(ui, seen, tier);
        });
    }
    let open = selection.is_none();
    show_inspector_part(ui, seen, words::RECORDING, open, &recording.row.name, |ui| {
        show_thing_details(it, ui, seen, &InspectedThing::Recording(recording.row.id));
    });
    if let Some((id, name)) = recording.row.signer_id.zip(recording.row.signer.as_ref()) {
        show_inspector_part(ui, seen, words::SIGNER, false, name, |ui| {
            show_thing_details(it, ui, seen, &InspectedThing::Signer(id));
        });
    }
}

/// Shows all details of something.
pub(super) fn show_thing_details(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, thing: &InspectedThing) {
    if let InspectedThing::Recording(id) = thing
        && let Some(glance) = seen.snapshot.recording_glance(*id)
    {
        show_recording_details(ui, seen, glance);
    }
    if let InspectedThing::Signer(id) = thing
        && let Some(row) = seen.snapshot.overview.people.iter().find(|row| row.id == *id)
    {
        show_signer_details(ui, seen, row);
    }
    match it.request_thing_details(thing, seen.out) {
        None => drop(ui.spinner()),
        Some(Err(wrong)) => drop(ui.label(RichText::new(wrong).color(seen.pane_colours().trouble))),
        Some(Ok(ObjectDetails::Token(token))) => super::inspector_token::show_token_details(it, ui, seen, &token),
        Some(Ok(ObjectDetails::Sign(sign))) => about::show_sign_details(it, ui, seen, &sign),
        Some(Ok(ObjectDetails::Signer(signer))) => signer_more(it, ui, seen, &signer),
        Some(Ok(ObjectDetails::Recording(recording))) => recording_more(ui, seen, &recording),
        Some(Ok(ObjectDetails::Value(value))) => about::show_inventory_value(it, ui, seen, &value),
    }
}

pub(super) fn span_text(span: TimeSpan) -> String {
    format!(
        "{} – {}",
        time_text(span.span_start_instant()),
        time_text(span.span_end_instant())
    )
}

fn missing_value_text<'a>(seen: &PaneInput<'a>, state: ValueState) -> &'static str {
    match state {
        ValueState::NotApplicable => seen.say_text(timeline::NOT_APPLICABLE),
        ValueState::Unclear => seen.say_text(timeline::UNCLEAR),
        _ => seen.say_text(timeline::UNSET),
    }
}

/// Changes an annotation's times or value.
pub(super) fn set_annotation(
    out: &CommandOutbox,
    id: i64,
    times: [Option<RecordingInstant>; 2],
    value: Option<String>,
) {
    let [start, end] = times.map(|at| at.map(TableMoment::Time));
    let action = AnnotationAction::Set {
        annotation: AnnotationName::Number(id),
        start,
        end,
        value,
    };
    let changes = vec![AnnotationChange::from(action)];
    out.request_work(editing::annotate_corpus_job(changes));
}

/// Returns the values of an inventory that match the typed text.
pub(super) fn values_like(seen: &PaneInput<'_>, inventory: Option<i64>, typed: &str) -> Vec<String> {
    let all = &seen.snapshot.overview.inventories;
    let stored = all.iter().find(|it| Some(it.id) == inventory);
    stored.map_or(Vec::new(), |it| {
        fitting_candidates(it.inventory.values.iter().map(|value| value.id.as_str()), typed)
    })
}

fn show_annotation_details(ui: &mut Ui, seen: &PaneInput<'_>, found: FoundAnnotation<'_>) {
    let (row, columns, at) = (&found.tier.row, &found.tier.annotations, found.at);
    let id = columns.ids[at];
    show_inspector_grid(ui, "annotation", |ui| {
        let value = match columns.states[at] {
            ValueState::Value => columns.values[at].to_string(),
            _ => String::new(),
        };
        let glosses = seen.snapshot.overview.signs.iter().map(|sign| sign.gloss.as_str());
        let candidates = |typed: &str| match row.role {
            TierRole::Gloss => fitting_candidates(glosses.clone(), typed),
            _ => values_like(seen, row.inventory_id, typed),
        };
        let key = Id::unique(("annotation value", id));
        if let Some(value) = show_line_with_completion(ui, seen, key, words::VALUE, &value, &candidates) {
            set_annotation(seen.out, id, [None, None], Some(value));
        }
        if columns.states[at] != ValueState::Value {
            let text = value_text(columns, at, |state| missing_value_text(seen, state)).to_owned();
            ui.label("");
            ui.weak(text);
            ui.end_row();
        }
        let span = columns.annotation_span_at(at);
        for (text, now, first) in [
            (words::START, span.span_start_instant(), true),
            (words::END, span.span_end_instant(), false),
        ] {
            let key = Id::unique(("annotation time", id, first));
            if let Some(typed) = show_editable_line(ui, seen, key, text, &time_text(now)) {
                let time = inspector_data::read_time(&typed);
                if time.is_some() {
                    set_annotation(seen.out, id, if first { [time, None] } else { [None, time] }, None);
                }
            }
        }
        if let Some(sure) = columns.confidences[at] {
            name_and_value(ui, seen, words::CONFIDENCE, &format!("{:.0} %", sure * 100.0));
        }
        if let Some(above) = columns.parents[at].and_then(|id| seen.snapshot.find_open_annotation(id)) {
            let text = value_text(&above.tier.annotations, above.at, |state| {
                missing_value_text(seen, state)
            });
            name_and_value(ui, seen, words::PARENT, &format!("{text} ({})", above.tier.row.name));
        }
        if let Some(annotator) = &row.annotator {
            name_and_value(ui, seen, words::ANNOTATOR, annotator);
        }
    });
}
