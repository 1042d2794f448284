//! The details of recordings, signers, signs and values.

use chereme_corpus::{
    MediaChange, Name, RecordingChange, RecordingDetails, RecordingGlance, SignChange, SignDetails,
    SignerChange, SignerDetails, SignerRow, TrackKind,
};
use chereme_motion::{Instant, Side};
use eframe::egui::{CollapsingHeader, Id, Label, RichText, Sense, Ui, vec2};

use super::data;
use super::edit::{choice, grid, line, name_and_value, notes, offered, title};
use super::ui::{lines, link};
use super::{Inspector, Thing};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::panes::complete::fitting;
use crate::panes::import::people;
use crate::panes::library::data as library;
use crate::panes::timeline::data::time_text;
use crate::words::{fill, inspector as words};
use crate::work::recordings;

pub(super) fn recording(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    glance: &RecordingGlance,
    out: &mut Outbox,
) {
    let row = &glance.row;
    let change = |out: &mut Outbox, change: RecordingChange| {
        out.work(recordings::change_recording(Name::Number(row.id), change));
    };
    let key = |what: &str| Id::unique(("recording", row.id, what.to_owned()));
    grid(ui, "recording", |ui| {
        if let Some(name) = line(ui, seen, key("name"), words::NAME, &row.name) {
            let name = Some(name);
            change(
                out,
                RecordingChange {
                    name,
                    ..RecordingChange::default()
                },
            );
        }
        let signers = &seen.snapshot.overview.signers;
        let candidates = |typed: &str| fitting(signers.iter().map(|it| it.name.as_str()), typed);
        let now = row.signer.clone().unwrap_or_default();
        if let Some(name) = offered(ui, seen, key("signer"), words::SIGNER, &now, &candidates) {
            let signer = Some(none_if_blank(name));
            change(
                out,
                RecordingChange {
                    signer,
                    ..RecordingChange::default()
                },
            );
        }
        let now = row.licence.clone().unwrap_or_default();
        if let Some(text) = line(ui, seen, key("licence"), words::LICENCE, &now) {
            let licence = Some(none_if_blank(text));
            change(
                out,
                RecordingChange {
                    licence,
                    ..RecordingChange::default()
                },
            );
        }
        let now = row.notes.clone().unwrap_or_default();
        if let Some(text) = notes(ui, seen, key("notes"), &now) {
            let notes = Some(none_if_blank(text));
            change(
                out,
                RecordingChange {
                    notes,
                    ..RecordingChange::default()
                },
            );
        }
    });
    let origin = |source: library::Source| seen.say(source.text()).to_owned();
    lines(
        ui,
        seen,
        "recording more",
        &data::recording_lines(glance, origin),
    );
    if let Some(recipe) = &glance.recipe {
        ui.weak(seen.snapshot.named(recipe));
        if ui.button(seen.say(words::OPEN_RECIPE)).clicked() {
            out.send(Command::Recipe(recipe.clone(), Some(row.name.clone())));
        }
    }
}

pub(super) fn none_if_blank(text: String) -> Option<String> {
    Some(text.trim().to_owned()).filter(|text| !text.is_empty())
}

pub(super) fn recording_more(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    it: &RecordingDetails,
    out: &mut Outbox,
) {
    grid(ui, "recording file", |ui| {
        if let Some(metres) = it.metres_per_unit {
            name_and_value(ui, seen, words::UNITS, &data::metres(metres));
        }
        if let Some(axes) = &it.axes {
            let axes = match axes.parse() {
                Ok(axes) => people::axes(axes, seen.language),
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
    });
    tracks(ui, seen, it);
    media(ui, seen, it, out);
    if it.roles.is_empty() {
        return;
    }
    let text = fill(seen.say(words::ROLES), &[("n", &it.roles.len())]);
    CollapsingHeader::new(RichText::new(text).small()).show(ui, |ui| {
        grid(ui, "roles", |ui| {
            for (part, joint) in &it.roles {
                ui.small(people::part(part, seen.language));
                ui.small(joint);
                ui.end_row();
            }
        });
        if !it.missing.is_empty() {
            let parts = it.missing.iter();
            let parts: Vec<String> = parts.map(|it| people::part(it, seen.language)).collect();
            let what = parts.join(" · ");
            ui.label(RichText::new(fill(seen.say(words::MISSING), &[("what", &what)])).small());
        }
    });
}

/// Shows the tracks of numbers, if there are any besides the body's movement.
fn tracks(ui: &mut Ui, seen: &PaneInput<'_>, it: &RecordingDetails) {
    let moving = it.tracks.iter().filter(|it| it.kind != TrackKind::Media);
    let lines: Vec<(&str, String)> = moving
        .map(|track| {
            (
                track.name.as_str(),
                data::track(track, |text| seen.say(text).to_owned()),
            )
        })
        .collect();
    if it
        .tracks
        .iter()
        .all(|it| matches!(it.kind, TrackKind::Skeleton | TrackKind::Media))
        && lines.len() < 2
    {
        return;
    }
    ui.weak(seen.say(words::TRACKS));
    grid(ui, "tracks", |ui| {
        for (name, text) in &lines {
            ui.label(*name);
            ui.add(Label::new(RichText::new(text).small()).wrap());
            ui.end_row();
        }
    });
}

/// Shows the media files of a recording: whether they exist, and how to link them.
fn media(ui: &mut Ui, seen: &PaneInput<'_>, it: &RecordingDetails, out: &mut Outbox) {
    let change = |out: &mut Outbox, change: MediaChange| {
        out.work(recordings::change_media(Name::Number(it.id), change));
    };
    for (at, place) in it.media.iter().enumerate() {
        let track = &place.track;
        grid(ui, &format!("media {at}"), |ui| {
            let key = Id::unique(("media", track.id));
            if let Some(url) = line(ui, seen, key, words::MEDIA, &track.url) {
                change(out, MediaChange::Move(track.id, url));
            }
        });
        let path = place.path.as_ref().map(|it| it.display().to_string());
        let (text, colour) = match (&path, place.is_there) {
            (Some(_), true) => (words::MEDIA_THERE, seen.colours().good),
            (Some(_), false) => (words::MEDIA_GONE, seen.colours().trouble),
            (None, _) => (words::MEDIA_ELSEWHERE, ui.visuals().weak_text_color()),
        };
        let text = fill(seen.say(text), &[("path", &path.unwrap_or_default())]);
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
        ui.horizontal_wrapped(|ui| {
            if ui.small_button(seen.say(words::MEDIA_FIND)).clicked() {
                out.send(Command::Choose(Choose::Media(it.id, Some(track.id))));
            }
            if ui.small_button(seen.say(words::MEDIA_REMOVE)).clicked() {
                change(out, MediaChange::Remove(track.id));
            }
        });
    }
    let hint = seen.say(words::MEDIA_HINT);
    let add = ui
        .small_button(seen.say(words::MEDIA_ADD))
        .on_hover_text(hint);
    if add.clicked() {
        out.send(Command::Choose(Choose::Media(it.id, None)));
    }
}

pub(super) fn signer(ui: &mut Ui, seen: &PaneInput<'_>, row: &SignerRow, out: &mut Outbox) {
    let change = |out: &mut Outbox, change: SignerChange| {
        out.work(recordings::change_signer(Name::Number(row.id), change));
    };
    grid(ui, "signer", |ui| {
        let key = Id::unique(("signer name", row.id));
        if let Some(name) = line(ui, seen, key, words::NAME, &row.name) {
            let name = Some(name);
            change(
                out,
                SignerChange {
                    name,
                    ..SignerChange::default()
                },
            );
        }
        let all: Vec<(Option<String>, String)> = [
            (None, words::UNKNOWN),
            (Some("right"), words::RIGHT),
            (Some("left"), words::LEFT),
        ]
        .map(|(name, text)| (name.map(str::to_owned), seen.say(text).to_owned()))
        .into();
        if let Some(hand) = choice(ui, seen, words::HANDEDNESS, &row.handedness, &all) {
            let side = |name: String| match name.as_str() {
                "left" => Side::Left,
                _ => Side::Right,
            };
            let handedness = Some(hand.map(side));
            change(
                out,
                SignerChange {
                    handedness,
                    ..SignerChange::default()
                },
            );
        }
        let key = Id::unique(("signer notes", row.id));
        let now = row.notes.clone().unwrap_or_default();
        if let Some(text) = notes(ui, seen, key, &now) {
            let notes = Some(none_if_blank(text));
            change(
                out,
                SignerChange {
                    notes,
                    ..SignerChange::default()
                },
            );
        }
    });
}

pub(super) fn signer_more(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    signer: &SignerDetails,
) {
    lines(ui, seen, "measures", &data::measures(signer));
    let n = signer.recordings.len();
    let text = format!("{} ({n})", seen.say(words::RECORDINGS));
    CollapsingHeader::new(RichText::new(text).small()).show(ui, |ui| {
        for recording in &signer.recordings {
            link(it, ui, &recording.name, Thing::Recording(recording.id));
        }
    });
}

pub(super) fn sign(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    sign: &SignDetails,
    out: &mut Outbox,
) {
    title(ui, seen.say(words::SIGN), &sign.gloss);
    let change = |out: &mut Outbox, change: SignChange| {
        out.work(recordings::change_sign(Name::Number(sign.id), change));
    };
    grid(ui, "sign", |ui| {
        let key = Id::unique(("sign gloss", sign.id));
        if let Some(gloss) = line(ui, seen, key, words::GLOSS, &sign.gloss) {
            let gloss = Some(gloss);
            change(
                out,
                SignChange {
                    gloss,
                    ..SignChange::default()
                },
            );
        }
        let key = Id::unique(("sign notes", sign.id));
        let now = sign.notes.clone().unwrap_or_default();
        if let Some(text) = notes(ui, seen, key, &now) {
            let notes = Some(none_if_blank(text));
            change(
                out,
                SignChange {
                    notes,
                    ..SignChange::default()
                },
            );
        }
        for (language, text) in &sign.texts {
            ui.weak(language);
            ui.horizontal(|ui| {
                ui.label(text);
                let tip = fill(seen.say(words::REMOVE), &[("what", text)]);
                if ui.small_button("×").on_hover_text(tip).clicked() {
                    let remove_texts = vec![(language.clone(), text.clone())];
                    change(
                        out,
                        SignChange {
                            remove_texts,
                            ..SignChange::default()
                        },
                    );
                }
            });
            ui.end_row();
        }
        let key = Id::unique(("sign text", sign.id));
        let language = seen.language.code();
        if let Some(text) = line(ui, seen, key, words::TEXT_NEW, "") {
            let add_texts = vec![(language.to_owned(), text)];
            change(
                out,
                SignChange {
                    add_texts,
                    ..SignChange::default()
                },
            );
        }
    });
    ui.separator();
    ui.weak(format!(
        "{} ({})",
        seen.say(words::TOKENS),
        sign.tokens.len()
    ));
    for token in &sign.tokens {
        ui.horizontal_wrapped(|ui| {
            let place = match (&token.recording, token.start_us) {
                (Some(name), Some(start)) => {
                    format!("{name} · {}", time_text(Instant::from_micros(start)))
                }
                _ => seen.say(crate::words::search::LEXICON).to_owned(),
            };
            link(it, ui, &place, Thing::Token(token.id));
            if token.citation {
                ui.small(seen.say(words::CITATION));
            }
        });
    }
}

pub(super) fn value(
    it: &mut Inspector,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (inventory, id): (i64, &str),
    uses: u64,
    out: &mut Outbox,
) {
    let stored = seen
        .snapshot
        .overview
        .inventories
        .iter()
        .find(|it| it.id == inventory);
    let Some((stored, value)) = stored.and_then(|it| Some((&it.inventory, it.inventory.get(id)?)))
    else {
        ui.label(id);
        return;
    };
    title(ui, seen.say(words::INVENTORY_VALUE), id);
    let (rect, _) = ui.allocate_exact_size(vec2(110.0, 110.0), Sense::hover());
    crate::pickers::picture(ui, rect, seen, stored, id);
    let code = seen.language.code();
    grid(ui, "value", |ui| {
        name_and_value(ui, seen, words::INVENTORY, &stored.id);
        if let Some(name) = value.names.get(code) {
            name_and_value(ui, seen, words::NAME, name);
        }
        if !value.aliases.is_empty() {
            name_and_value(ui, seen, words::ALIASES, &value.aliases.join(", "));
        }
        if let Some(broader) = &value.broader {
            ui.weak(seen.say(words::BROADER));
            link(it, ui, broader, Thing::Value(inventory, broader.clone()));
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
    });
    if let Some(text) = &value.hamnosys {
        super::token::hamnosys(ui, seen, text);
    }
    if uses > 0 && ui.button(seen.say(words::SEARCH_USES)).clicked() {
        let field = stored.field().to_string();
        out.send(Command::Find(crate::panes::search::with_value(
            "", &field, id,
        )));
    }
}
