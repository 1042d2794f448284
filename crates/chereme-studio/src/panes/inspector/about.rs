//! The details of recordings, signers, signs and values.

use std::collections::BTreeMap;

use chereme_corpus::{
    ConsentAudience, ConsentChange, CorpusAddress, MediaChange, PersonAttribute, PersonChange, PersonConsent,
    PersonContents, RecordingChange, RecordingDetails, RecordingGlance, RelationChange, RowName, SignChange,
    SignDetails, SignerChange, SignerDetails, TrackKind, ValueDetails,
};
use chereme_motion::{BodySide, RecordingInstant};
use chereme_sign::ComponentInventory;
use eframe::egui::{CollapsingHeader, Id, Label, RichText, Sense, Ui, vec2};

use super::inspector_edit::{
    name_and_value, new_change, show_editable_line, show_editable_notes, show_inspector_choice, show_inspector_grid,
    show_line_with_completion, show_part_title,
};
use super::inspector_ui::{show_inspector_lines, show_thing_link};
use super::{InspectorPane, inspector_data};
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::panes::complete_pane::fitting_candidates;
use crate::panes::import::import_people;
use crate::panes::library::library_data as library;
use crate::panes::timeline::timeline_data::time_text;
use crate::words::{InterfaceText, fill_text_braces, inspector as words};
use crate::work::recordings_jobs;

pub(super) fn show_recording_details(ui: &mut Ui, seen: &PaneInput<'_>, glance: &RecordingGlance) {
    let row = &glance.row;
    let change = |change: RecordingChange| {
        seen.request_work(recordings_jobs::change_recording(RowName::Number(row.id), change));
    };
    let key = |what: &str| Id::unique(("recording", row.id, what.to_owned()));
    show_inspector_grid(ui, "recording", |ui| {
        if let Some(name) = show_editable_line(ui, seen, key("name"), words::NAME, &row.name) {
            change(new_change(|asked: &mut RecordingChange| asked.name = Some(name)));
        }
        let signers = &seen.snapshot.overview.signers;
        let candidates = |typed: &str| fitting_candidates(signers.iter().map(|signer| signer.name.as_str()), typed);
        let now = row.signer.clone().unwrap_or_default();
        if let Some(name) = show_line_with_completion(ui, seen, key("signer"), words::SIGNER, &now, &candidates) {
            change(new_change(|asked: &mut RecordingChange| {
                asked.signer = Some(none_if_blank(name))
            }));
        }
        let now = row.licence.clone().unwrap_or_default();
        if let Some(text) = show_editable_line(ui, seen, key("licence"), words::LICENCE, &now) {
            change(new_change(|asked: &mut RecordingChange| {
                asked.licence = Some(none_if_blank(text))
            }));
        }
        let now = row.notes.clone().unwrap_or_default();
        if let Some(text) = show_editable_notes(ui, seen, key("notes"), &now) {
            change(new_change(|asked: &mut RecordingChange| {
                asked.notes = Some(none_if_blank(text))
            }));
        }
    });
    let origin = |source: library::RecordingOrigin| seen.say_text(source.recording_origin_text()).to_owned();
    show_inspector_lines(
        ui,
        seen,
        "recording more",
        &inspector_data::recording_lines(glance, origin),
    );
    if let Some(recipe) = &glance.recipe {
        ui.weak(seen.snapshot.name_tokens_in_text(recipe));
        if ui.button(seen.say_text(words::OPEN_RECIPE)).clicked() {
            seen.send_command(WindowCommand::Recipe(recipe.clone(), Some(row.name.clone())));
        }
    }
}

pub(super) fn none_if_blank(text: String) -> Option<String> {
    Some(text.trim().to_owned()).filter(|text| !text.is_empty())
}

pub(super) fn recording_more(ui: &mut Ui, seen: &PaneInput<'_>, it: &RecordingDetails) {
    show_inspector_grid(ui, "recording file", |ui| {
        let lexicons = &seen.snapshot.overview.lexicons;
        if !lexicons.is_empty() {
            let none = (None, seen.say_text(words::NO_LEXICON).to_owned());
            let named = lexicons.iter().map(|row| (Some(row.name.clone()), row.name.clone()));
            let all: Vec<(Option<String>, String)> = [none].into_iter().chain(named).collect();
            if let Some(lexicon) = show_inspector_choice(ui, seen, words::LEXICON, &it.lexicon, &all) {
                seen.request_work(recordings_jobs::link_lexicon_job(it.id, lexicon));
            }
        }
        if let Some(metres) = it.metres_per_unit {
            name_and_value(ui, seen, words::UNITS, &inspector_data::metres_text(metres));
        }
        if let Some(axes) = &it.axes {
            let axes = match axes.parse() {
                Ok(axes) => import_people::axes_sentence(axes, seen.language),
                Err(_) => axes.clone(),
            };
            name_and_value(ui, seen, words::AXES, &axes);
        }
        if !it.files.is_empty() {
            let files: Vec<&str> = it.files.iter().map(|(_, name)| name.as_str()).collect();
            name_and_value(ui, seen, words::FILES, &files.join(", "));
        }
        if let Some(engine) = &it.engine {
            name_and_value(ui, seen, words::ENGINE, engine);
        }
        if it.joints > 0 {
            name_and_value(ui, seen, words::JOINTS, &it.joints.to_string());
        }
        if !it.range_takes.is_empty() {
            name_and_value(ui, seen, words::RANGE_TAKES, &it.range_takes.join(", "));
        }
    });
    let who = CorpusAddress::Recording(RowName::Number(it.id));
    show_consent(ui, seen, who, &it.consent);
    show_recording_tracks(ui, seen, it);
    show_recording_media(ui, seen, it);
    if it.roles.is_empty() {
        return;
    }
    let text = fill_text_braces(seen.say_text(words::ROLES), &[("n", &it.roles.len())]);
    CollapsingHeader::new(RichText::new(text).small()).show(ui, |ui| {
        show_inspector_grid(ui, "roles", |ui| {
            for (part, joint) in &it.roles {
                ui.small(import_people::body_part_name(part, seen.language));
                ui.small(joint);
                ui.end_row();
            }
        });
        if !it.missing.is_empty() {
            let missing_parts = it.missing.iter();
            let parts: Vec<String> = missing_parts
                .map(|name| import_people::body_part_name(name, seen.language))
                .collect();
            let what = parts.join(" · ");
            ui.label(RichText::new(fill_text_braces(seen.say_text(words::MISSING), &[("what", &what)])).small());
        }
    });
}

/// Shows the tracks of numbers, if there are any besides the body's movement.
fn show_recording_tracks(ui: &mut Ui, seen: &PaneInput<'_>, it: &RecordingDetails) {
    let moving = it.tracks.iter().filter(|track| track.kind != TrackKind::Media);
    let lines: Vec<(&str, String)> = moving
        .map(|track| {
            (
                track.name.as_str(),
                inspector_data::track_description(track, |text| seen.say_text(text).to_owned()),
            )
        })
        .collect();
    if it
        .tracks
        .iter()
        .all(|track| matches!(track.kind, TrackKind::Skeleton | TrackKind::Media))
        && lines.len() < 2
    {
        return;
    }
    ui.weak(seen.say_text(words::TRACKS));
    show_inspector_grid(ui, "tracks", |ui| {
        for (name, text) in &lines {
            ui.label(*name);
            ui.add(Label::new(RichText::new(text).small()).wrap());
            ui.end_row();
        }
    });
}

/// Shows the media files of a recording: whether they exist, and how to link them.
fn show_recording_media(ui: &mut Ui, seen: &PaneInput<'_>, it: &RecordingDetails) {
    let change = |change: MediaChange| {
        seen.request_work(recordings_jobs::change_media(RowName::Number(it.id), change));
    };
    for (at, place) in it.media.iter().enumerate() {
        let track = &place.track;
        show_inspector_grid(ui, &format!("media {at}"), |ui| {
            let key = Id::unique(("media", track.id));
            if let Some(url) = show_editable_line(ui, seen, key, words::MEDIA, &track.url) {
                change(MediaChange::Move(track.id, url));
            }
        });
        let path = place.path.as_ref().map(|path| path.display().to_string());
        let (text, colour) = match (&path, place.is_there) {
            (Some(_), true) => (words::MEDIA_THERE, seen.pane_colours().good),
            (Some(_), false) => (words::MEDIA_GONE, seen.pane_colours().trouble),
            (None, _) => (words::MEDIA_ELSEWHERE, ui.visuals().weak_text_color()),
        };
        let text = fill_text_braces(seen.say_text(text), &[("path", &path.unwrap_or_default())]);
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
        ui.horizontal_wrapped(|ui| {
            if ui.small_button(seen.say_text(words::MEDIA_FIND)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Media(it.id, Some(track.id))));
            }
            if ui.small_button(seen.say_text(words::MEDIA_REMOVE)).clicked() {
                change(MediaChange::Remove(track.id));
            }
        });
    }
    let hint = seen.say_text(words::MEDIA_HINT);
    let add = ui.small_button(seen.say_text(words::MEDIA_ADD)).on_hover_text(hint);
    if add.clicked() {
        seen.send_command(WindowCommand::Choose(ChooserPurpose::Media(it.id, None)));
    }
}

pub(super) fn show_signer_details(ui: &mut Ui, seen: &PaneInput<'_>, row: &PersonContents) {
    let change = |change: SignerChange| {
        seen.request_work(recordings_jobs::change_signer(RowName::Number(row.id), change));
    };
    show_inspector_grid(ui, "signer", |ui| {
        let key = Id::unique(("signer name", row.id));
        if let Some(name) = show_editable_line(ui, seen, key, words::NAME, &row.name) {
            change(new_change(|asked: &mut SignerChange| asked.name = Some(name)));
        }
        let all: Vec<(Option<String>, String)> = [
            (None, words::UNKNOWN),
            (Some("right"), words::RIGHT),
            (Some("left"), words::LEFT),
        ]
        .map(|(name, text)| (name.map(str::to_owned), seen.say_text(text).to_owned()))
        .into();
        if let Some(hand) = show_inspector_choice(ui, seen, words::HANDEDNESS, &row.handedness, &all) {
            let side = |name: String| match name.as_str() {
                "left" => BodySide::Left,
                _ => BodySide::Right,
            };
            change(new_change(|asked: &mut SignerChange| {
                asked.handedness = Some(hand.map(side))
            }));
        }
        let key = Id::unique(("signer notes", row.id));
        let now = row.notes.clone().unwrap_or_default();
        if let Some(text) = show_editable_notes(ui, seen, key, &now) {
            change(new_change(|asked: &mut SignerChange| {
                asked.notes = Some(none_if_blank(text))
            }));
        }
    });
}

/// Shows the other names and the attributes of a person, and a field that makes them one with somebody else.
fn show_person_details(ui: &mut Ui, seen: &PaneInput<'_>, person: &PersonContents) {
    let change = |change: PersonChange| {
        seen.request_work(recordings_jobs::change_person(RowName::Number(person.id), change));
    };
    let key = |what: &'static str| Id::unique(("person", what, person.id));
    show_inspector_grid(ui, "person", |ui| {
        let now = person.aliases.join("; ");
        if let Some(text) = show_editable_line(ui, seen, key("names"), words::OTHER_NAMES, &now) {
            let wanted: Vec<String> = listed_parts(&text).map(str::to_owned).collect();
            let gone = person.aliases.iter().filter(|alias| !wanted.contains(alias));
            let remove_aliases = gone.cloned().collect();
            change(new_change(|asked: &mut PersonChange| {
                asked.remove_aliases = remove_aliases;
                asked.add_aliases = wanted;
            }));
        }
        let now = attributes_line(&person.attributes);
        if let Some(text) = show_editable_line(ui, seen, key("attributes"), words::ATTRIBUTES, &now) {
            change(new_change(|asked: &mut PersonChange| {
                asked.attributes = changed_attributes(&person.attributes, &text)
            }));
        }
        if let Some(first) = person.attributes.first() {
            let all = audience_choices(seen, words::SEEN_BY_ME);
            if let Some(audience) = show_inspector_choice(ui, seen, words::ATTRIBUTES_SEEN_BY, &first.audience, &all) {
                change(new_change(|asked: &mut PersonChange| asked.audience = Some(audience)));
            }
        }
        let others = seen.snapshot.overview.people.iter().filter(|row| row.id != person.id);
        let names: Vec<&str> = others.map(|row| row.name.as_str()).collect();
        let candidates = |typed: &str| fitting_candidates(names.iter().copied(), typed);
        if let Some(name) = show_line_with_completion(ui, seen, key("same"), words::SAME_PERSON_AS, "", &candidates)
            && !name.trim().is_empty()
        {
            let into = RowName::Text(name.trim().to_owned());
            seen.request_work(recordings_jobs::unite_people(RowName::Number(person.id), into));
        }
    });
    if person.participant_tiers + person.annotator_tiers > 0 {
        let text = fill_text_braces(
            seen.say_text(words::PERSON_TIERS),
            &[
                ("participant", &person.participant_tiers),
                ("annotator", &person.annotator_tiers),
            ],
        );
        ui.weak(text);
    }
    if person.annotator_tiers > 0 {
        show_preference(ui, seen, &person.name);
    }
}

/// Shows whether the values of an annotator count before those of others, to change.
pub(super) fn show_preference(ui: &mut Ui, seen: &PaneInput<'_>, annotator: &str) {
    let mut preferred = seen.snapshot.overview.preferred_annotator.as_deref() == Some(annotator);
    let box_response = ui.checkbox(&mut preferred, seen.say_text(words::PREFERRED));
    if box_response
        .on_hover_text(seen.say_text(words::PREFERRED_HINT))
        .changed()
    {
        let name = preferred.then(|| annotator.to_owned());
        seen.request_work(recordings_jobs::prefer_annotator_job(name));
    }
}

/// Returns the audiences to choose from, the narrowest under a name of its own.
fn audience_choices(seen: &PaneInput<'_>, narrowest: InterfaceText) -> Vec<(ConsentAudience, String)> {
    let all = [
        (ConsentAudience::Nobody, narrowest),
        (ConsentAudience::Research, words::SEEN_BY_RESEARCH),
        (ConsentAudience::Public, words::SEEN_BY_ALL),
    ];
    all.map(|(audience, text)| (audience, seen.say_text(text).to_owned()))
        .into()
}

/// Shows what a person or a recording agreed to, to change.
fn show_consent(ui: &mut Ui, seen: &PaneInput<'_>, who: CorpusAddress, now: &PersonConsent) {
    let title = RichText::new(seen.say_text(words::AGREED)).small();
    let is_person = matches!(who, CorpusAddress::Signer(_));
    let folded = CollapsingHeader::new(title).id_salt("agreed").default_open(is_person);
    folded.show(ui, |ui| {
        let mut change = ConsentChange::default();
        show_inspector_grid(ui, "agreed", |ui| {
            let mut all = vec![(None, seen.say_text(words::UNKNOWN).to_owned())];
            let named = audience_choices(seen, words::SEEN_BY_NOBODY).into_iter();
            all.extend(named.map(|(audience, name)| (Some(audience), name)));
            for (text, now, asked) in [
                (words::AGREED_MOVEMENT, &now.movement, &mut change.movement),
                (words::AGREED_ANNOTATION, &now.annotation, &mut change.annotation),
                (words::AGREED_DERIVED, &now.derived, &mut change.derived),
            ] {
                *asked = show_inspector_choice(ui, seen, text, now, &all);
            }
            for (text, now, asked) in [
                (words::AGREED_DAY, &now.day, &mut change.day),
                (words::AGREED_FORM, &now.form, &mut change.form),
            ] {
                let key = Id::unique(("agreed", who.to_string(), text.text_id()));
                let typed = show_editable_line(ui, seen, key, text, now.as_deref().unwrap_or_default());
                *asked = typed.map(none_if_blank);
            }
        });
        ui.add(Label::new(RichText::new(seen.say_text(words::AGREED_HINT)).small().weak()).wrap());
        if change != ConsentChange::default() {
            seen.request_work(recordings_jobs::change_consent_job(who, change));
        }
    });
}

/// Returns the parts of a list that a person typed.
fn listed_parts(text: &str) -> impl Iterator<Item = &str> {
    text.split(';').map(str::trim).filter(|part| !part.is_empty())
}

/// Returns the attributes of a person in one line: `region=north; age=34`.
fn attributes_line(attributes: &[PersonAttribute]) -> String {
    let each = attributes.iter();
    let parts = each.map(|attribute| format!("{}={}", attribute.name, attribute.text));
    parts.collect::<Vec<_>>().join("; ")
}

/// Returns the attributes that a typed line changes; those that it leaves out have an empty text.
fn changed_attributes(attributes: &[PersonAttribute], line: &str) -> BTreeMap<String, String> {
    let mut changed: BTreeMap<String, String> = listed_parts(line)
        .map(|part| part.split_once('=').unwrap_or((part, "")))
        .map(|(name, text)| (name.trim().to_owned(), text.trim().to_owned()))
        .collect();
    for attribute in attributes {
        match changed.get(&attribute.name) {
            Some(text) if *text == attribute.text => drop(changed.remove(&attribute.name)),
            Some(_) => {}
            None => drop(changed.insert(attribute.name.clone(), String::new())),
        }
    }
    changed
}

pub(super) fn signer_more(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, signer: &SignerDetails) {
    show_person_details(ui, seen, &signer.person);
    let who = CorpusAddress::Signer(RowName::Number(signer.person.id));
    show_consent(ui, seen, who, &signer.consent);
    show_inspector_lines(ui, seen, "measures", &inspector_data::body_measure_lines(signer));
    let n = signer.recordings.len();
    let text = format!("{} ({n})", seen.say_text(words::RECORDINGS));
    CollapsingHeader::new(RichText::new(text).small()).show(ui, |ui| {
        for recording in &signer.recordings {
            show_thing_link(it, ui, &recording.name, InspectedThing::Recording(recording.id));
        }
    });
}

pub(super) fn show_sign_details(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, sign: &SignDetails) {
    show_part_title(ui, seen.say_text(words::SIGN), &sign.gloss);
    if let Some(lexicon) = &sign.lexicon {
        show_inspector_grid(ui, "sign lexicon", |ui| {
            name_and_value(ui, seen, words::LEXICON, lexicon);
            let others = seen
                .snapshot
                .overview
                .lexicons
                .iter()
                .filter(|row| row.name != *lexicon);
            let names: Vec<&str> = others.map(|row| row.name.as_str()).collect();
            let candidates = |typed: &str| fitting_candidates(names.iter().copied(), typed);
            let key = Id::unique(("same lexicon", lexicon.clone()));
            if !names.is_empty()
                && let Some(text) = show_line_with_completion(ui, seen, key, words::SAME_LEXICON_AS, "", &candidates)
                && !text.trim().is_empty()
            {
                let into = text.trim().to_owned();
                seen.request_work(recordings_jobs::unite_lexicons_job(lexicon.clone(), into));
            }
        });
    }
    let change = |change: SignChange| {
        seen.request_work(recordings_jobs::change_sign(RowName::Number(sign.id), change));
    };
    show_inspector_grid(ui, "sign", |ui| {
        let key = Id::unique(("sign gloss", sign.id));
        if let Some(gloss) = show_editable_line(ui, seen, key, words::GLOSS, &sign.gloss) {
            change(new_change(|asked: &mut SignChange| asked.gloss = Some(gloss)));
        }
        let key = Id::unique(("sign notes", sign.id));
        let now = sign.notes.clone().unwrap_or_default();
        if let Some(text) = show_editable_notes(ui, seen, key, &now) {
            change(new_change(|asked: &mut SignChange| {
                asked.notes = Some(none_if_blank(text))
            }));
        }
        for (language, text) in &sign.texts {
            ui.weak(language);
            ui.horizontal(|ui| {
                ui.label(text);
                let tip = fill_text_braces(seen.say_text(words::REMOVE), &[("what", text)]);
                if ui.small_button("×").on_hover_text(tip).clicked() {
                    change(new_change(|asked: &mut SignChange| {
                        asked.remove_texts = vec![(language.clone(), text.clone())]
                    }));
                }
            });
            ui.end_row();
        }
        for relation in &sign.relations {
            ui.weak(relation.relation_words(seen.language));
            ui.horizontal(|ui| {
                show_thing_link(it, ui, &relation.related, InspectedThing::Sign(relation.related_id));
                let tip = fill_text_braces(seen.say_text(words::REMOVE), &[("what", &relation.related)]);
                // What a recipe says goes with the recipe alone.
                let is_stated = relation.source.as_deref() != Some("recipe");
                if is_stated && ui.small_button("×").on_hover_text(tip).clicked() {
                    let (name, other) = (relation.relation.clone(), RowName::Number(relation.related_id));
                    let remove = RelationChange::Remove;
                    seen.request_work(recordings_jobs::change_relation_job(sign.id, name, other, remove));
                }
            });
            ui.end_row();
        }
        let key = Id::unique(("sign relation", sign.id));
        if let Some(text) = show_editable_line(ui, seen, key, words::RELATION_NEW, "") {
            let (name, other) = text.trim().split_once(' ').unwrap_or((text.trim(), ""));
            let (name, other) = (name.to_owned(), RowName::Text(other.trim().to_owned()));
            seen.request_work(recordings_jobs::change_relation_job(
                sign.id,
                name,
                other,
                RelationChange::Add,
            ));
        }
        let key = Id::unique(("sign text", sign.id));
        let language = seen.language.language_code();
        if let Some(text) = show_editable_line(ui, seen, key, words::TEXT_NEW, "") {
            change(new_change(|asked: &mut SignChange| {
                asked.add_texts = vec![(language.to_owned(), text)]
            }));
        }
    });
    ui.separator();
    ui.weak(format!("{} ({})", seen.say_text(words::TOKENS), sign.tokens.len()));
    for token in &sign.tokens {
        ui.horizontal_wrapped(|ui| {
            let place = match (&token.recording, token.start_us) {
                (Some(name), Some(start)) => {
                    format!("{name} · {}", time_text(RecordingInstant::from_micros(start)))
                }
                _ => seen.say_text(crate::words::search_words::LEXICON).to_owned(),
            };
            show_thing_link(it, ui, &place, InspectedThing::Token(token.id));
            if token.citation {
                ui.small(seen.say_text(words::CITATION));
            }
        });
    }
}

pub(super) fn show_inventory_value(it: &mut InspectorPane, ui: &mut Ui, seen: &PaneInput<'_>, details: &ValueDetails) {
    let ValueDetails { inventory, uses, .. } = *details;
    let id = details.value.as_str();
    let stored = seen
        .snapshot
        .overview
        .inventories
        .iter()
        .find(|stored_inventory| stored_inventory.id == inventory);
    let Some((stored, value)) = stored
        .and_then(|stored_inventory| Some((&stored_inventory.inventory, stored_inventory.inventory.value_by_id(id)?)))
    else {
        ui.label(id);
        return;
    };
    show_part_title(ui, seen.say_text(words::INVENTORY_VALUE), id);
    let (rect, _) = ui.allocate_exact_size(vec2(110.0, 110.0), Sense::hover());
    crate::pickers::paint_inventory_value(ui, rect, seen, stored, id);
    let code = seen.language.language_code();
    show_inspector_grid(ui, "value", |ui| {
        name_and_value(ui, seen, words::INVENTORY, &stored.id);
        if let Some(name) = value.names.get(code) {
            name_and_value(ui, seen, words::NAME, name);
        }
        if !value.aliases.is_empty() {
            name_and_value(ui, seen, words::ALIASES, &value.aliases.join(", "));
        }
        if let Some(broader) = &value.broader {
            ui.weak(seen.say_text(words::BROADER));
            show_thing_link(it, ui, broader, InspectedThing::Value(inventory, broader.clone()));
            ui.end_row();
        }
        if !value.features.is_empty() {
            let all: Vec<&str> = value.features.iter().map(String::as_str).collect();
            name_and_value(ui, seen, words::FEATURES, &all.join(", "));
        }
        if let Some(notes) = &value.notes {
            name_and_value(ui, seen, words::NOTES, notes);
        }
        name_and_value(ui, seen, words::USES, &uses.to_string());
        show_equal_values(it, ui, seen, stored, details);
    });
    if let Some(text) = &value.hamnosys {
        super::inspector_token::show_hamnosys_notation(ui, seen, text);
    }
    if uses > 0 && ui.button(seen.say_text(words::SEARCH_USES)).clicked() {
        let field = stored.inventory_field().to_string();
        seen.send_command(WindowCommand::Find(crate::panes::search::with_value("", &field, id)));
    }
}

/// Shows the values of other inventories that are one with a value, and those that may be.
fn show_equal_values(
    it: &mut InspectorPane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    details: &ValueDetails,
) {
    let overview = &seen.snapshot.overview;
    let own = format!("{}/{}", inventory.id, details.value);
    let group = overview.equal_values.find_equal_group(&inventory.id, &details.value);
    for name in group.into_iter().flatten().filter(|name| name.to_string() != own) {
        ui.weak(seen.say_text(words::SAME_VALUE));
        let stored = overview
            .inventories
            .iter()
            .find(|stored| stored.inventory.id == name.inventory);
        let row = stored.map_or(0, |stored| stored.id);
        show_thing_link(
            it,
            ui,
            &name.to_string(),
            InspectedThing::Value(row, name.value.clone()),
        );
        ui.end_row();
    }
    if group.is_some() {
        ui.weak("");
        if ui.button(seen.say_text(words::NOT_SAME)).clicked() {
            seen.request_work(recordings_jobs::part_value_job(own.clone()));
        }
        ui.end_row();
    }
    for (name, reasons) in &details.proposals {
        ui.weak(seen.say_text(words::PERHAPS_SAME));
        let text = fill_text_braces(seen.say_text(words::MAKE_SAME), &[("value", name)]);
        if ui.button(text).on_hover_text(reasons.join(", ")).clicked() {
            seen.request_work(recordings_jobs::equate_values_job(own.clone(), name.to_string()));
        }
        ui.end_row();
    }
    let field = inventory.inventory_field();
    let others = overview.inventories.iter().map(|stored| &stored.inventory);
    let others = others.filter(|other| other.id != inventory.id && other.inventory_field() == field);
    let named = |other: &ComponentInventory| {
        let values = other.values.iter().map(|value| format!("{}/{}", other.id, value.id));
        values.collect::<Vec<_>>()
    };
    let names: Vec<String> = others.flat_map(named).collect();
    let candidates = |typed: &str| fitting_candidates(names.iter().map(String::as_str), typed);
    let key = Id::unique(("same value", own.clone()));
    if let Some(text) = show_line_with_completion(ui, seen, key, words::SAME_VALUE_AS, "", &candidates)
        && !text.trim().is_empty()
    {
        seen.request_work(recordings_jobs::equate_values_job(own, text.trim().to_owned()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typed_line_of_attributes_says_what_changes() {
        let said = |name: &str, text: &str| PersonAttribute {
            name: name.to_owned(),
            text: text.to_owned(),
            number: None,
            audience: ConsentAudience::Nobody,
        };
        let known = [said("region", "north"), said("age", "34"), said("school", "A")];
        assert_eq!(attributes_line(&known), "region=north; age=34; school=A");
        let changed = changed_attributes(&known, "region = south;age=34 ; deaf=yes;");
        let wanted = [("deaf", "yes"), ("region", "south"), ("school", "")];
        assert_eq!(
            changed,
            wanted.map(|(name, text)| (name.to_owned(), text.to_owned())).into()
        );
        assert_eq!(changed_attributes(&known, &attributes_line(&known)), BTreeMap::new());
    }
}
