//! The interpretation of each file, and the user's corrections before anything is written.

use std::path::Path;

use chereme_corpus::{FileReport, FileStatus};
use eframe::egui::{Align, CollapsingHeader, ComboBox, Grid, Id, RichText, Role, Ui, WidgetInfo};

use super::import_known::ImportCorrections;
use super::{import_body, import_data, import_people};
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::panes::complete_pane::{CompletionLine, fitting_candidates, show_completion_line};
use crate::panes::timeline::tier_box;
use crate::window_remedy;
use crate::words::{fill_text_braces, import_words as words, shell, translate_library_message};

/// Shows the interpretation of a file.
pub(super) fn show_file_report(
    corrections: &mut ImportCorrections,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    file: &FileReport,
    open: bool,
    dry: bool,
) {
    let name = Path::new(&file.path).file_name().unwrap_or_default().to_string_lossy();
    let colour = match file.status {
        FileStatus::Refused => seen.pane_colours().trouble,
        FileStatus::Imported | FileStatus::Updated => ui.visuals().text_color(),
        _ => ui.visuals().weak_text_color(),
    };
    let [_, warnings, notes] = import_data::finding_counts(file);
    let mut title = format!("{name} · {}", seen.say_text(import_data::status_text(file.status)));
    let remarks = if notes == 1 { words::ONE_NOTE } else { words::NOTES };
    for (count, text) in [(warnings, words::WARNINGS), (notes, remarks)] {
        if count > 0 {
            title = format!("{title} · {}", fill_text_braces(seen.say_text(text), &[("n", &count)]));
        }
    }
    let header = CollapsingHeader::new(RichText::new(title).color(colour));
    let open = open || file.status == FileStatus::Refused;
    header.id_salt((&file.path, dry)).default_open(open).show(ui, |ui| {
        if let Some(recording) = &file.recording {
            ui.horizontal_wrapped(|ui| {
                ui.weak(seen.say_text(words::BECOMES));
                ui.label(recording);
                let there = seen.snapshot.recording_named(recording);
                if let Some(there) = there.filter(|_| !dry)
                    && ui.small_button(seen.say_text(words::SHOW)).clicked()
                {
                    seen.send_command(WindowCommand::Recording(there.row.id));
                    seen.send_command(WindowCommand::Look);
                }
            });
        }
        if let Some(join) = &file.joined {
            let why = translate_library_message(join.by.join_reason_text(), seen.language);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("file", &join.with), ("why", &why)];
            ui.small(fill_text_braces(seen.say_text(words::JOINED), &values));
        }
        show_understood_file(corrections, ui, seen, file, dry);
        show_file_findings(ui, seen, file);
    });
}

fn show_understood_file(
    corrections: &mut ImportCorrections,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    file: &FileReport,
    dry: bool,
) {
    let lines = import_data::movement_interpretation(file, seen.language);
    let parts = import_data::found_body_parts(file);
    if !lines.is_empty() || parts.is_some() {
        ui.horizontal_top(|ui| {
            if let Some(parts) = &parts
                && let Some(part) = import_body::show_body_map(ui, seen, parts, dry)
            {
                ui.data_mut(|data| data.insert_temp(pointed_part_id(file), part));
            }
            ui.vertical(|ui| {
                for (text, value) in &lines {
                    ui.small(seen.say_text(*text));
                    ui.add(eframe::egui::Label::new(value).wrap());
                }
            })
            .response
            .on_hover_text(import_data::unit_and_axes_reasons(file).join("\n"));
        });
    }
    if dry {
        show_file_joints(corrections, ui, seen, file);
    }
    let tiers = import_data::guessed_tier_roles(file);
    if !tiers.is_empty() {
        ui.weak(seen.say_text(words::TIERS_ARE));
        Grid::new(("tiers", &file.path))
            .num_columns(2)
            .striped(true)
            .show(ui, |ui| {
                for guess in &tiers {
                    let label = ui.add(eframe::egui::Label::new(&guess.name).truncate());
                    label.on_hover_text(&guess.why);
                    if dry {
                        show_guessed_tier(corrections, ui, seen, guess);
                    } else {
                        ui.label(tier_box::role_text(&guess.role, seen));
                    }
                    ui.end_row();
                }
            });
    }
    let columns = import_data::guessed_column_meanings(file);
    if !columns.is_empty() {
        ui.small(columns.join(", "));
    }
}

/// Shows the role of a tier, which can be changed.
fn show_guessed_tier(
    corrections: &mut ImportCorrections,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    guess: &import_data::TierRoleGuess,
) {
    let chosen = corrections.tiers.get(&guess.name).cloned();
    let now = chosen.clone().unwrap_or_else(|| guess.role.clone());
    let shown = if now.is_empty() {
        seen.say_text(words::NOT_KNOWN).to_owned()
    } else {
        tier_box::role_text(&now, seen)
    };
    let mut text = RichText::new(shown);
    if chosen.is_some() {
        text = text.strong();
    } else if guess.sure < 0.6 {
        text = text.color(seen.pane_colours().trouble);
    }
    let combo = ComboBox::from_id_salt(&guess.name).selected_text(text).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for role in import_data::offered_roles() {
            let text = tier_box::role_text(role, seen);
            if ui.selectable_label(now == role, text).clicked() {
                corrections.tiers.insert(guess.name.clone(), role.to_owned());
            }
        }
    });
    let name = fill_text_braces(seen.say_text(words::TIER_IS), &[("tier", &guess.name)]);
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
}

/// Returns the key under which the clicked part of a file's body is remembered.
fn pointed_part_id(file: &FileReport) -> Id {
    Id::unique(("pointed", &file.path))
}

/// Shows the joint of each part of the body, which can be changed; goes to the part that was clicked on the body.
fn show_file_joints(corrections: &mut ImportCorrections, ui: &mut Ui, seen: &PaneInput<'_>, file: &FileReport) {
    let rows = import_data::joint_rows(file);
    if rows.is_empty() {
        return;
    }
    let title = RichText::new(seen.say_text(words::JOINTS_ARE)).small();
    let pointed = pointed_part_id(file);
    let part: Option<String> = ui.data(|data| data.get_temp(pointed));
    let is_it = |name: &str| {
        let part = part.as_deref();
        part.is_some_and(|wanted_part| name == wanted_part || name.starts_with(&format!("{wanted_part} ")))
    };
    let wanted = rows.iter().position(|(part, _)| is_it(part));
    let header = CollapsingHeader::new(title)
        .id_salt(("joints", &file.path))
        .open(wanted.map(|_| true));
    header.show(ui, |ui| {
        let names = import_data::joint_names(file);
        let candidates = |typed: &str| fitting_candidates(names.iter().copied(), typed);
        Grid::new(("joints", &file.path)).num_columns(2).show(ui, |ui| {
            for (at, (part, joint)) in rows.iter().enumerate() {
                let changed = corrections.joints.contains_key(part);
                let named = import_people::body_part_name(part, seen.language);
                let name = RichText::new(&named).small();
                ui.label(if changed { name.strong() } else { name });
                let mut text = corrections.joints.get(part).unwrap_or(joint).clone();
                let label = fill_text_braces(seen.say_text(words::JOINT_OF), &[("part", &named)]);
                let line = CompletionLine {
                    name: &label,
                    hint: seen.say_text(words::NO_JOINT),
                    width: 130.0,
                    ..CompletionLine::default()
                };
                let id = Id::unique(("joint", &file.path, part));
                let typed = show_completion_line(ui, id, line, &mut text, &candidates);
                // The field can take the focus once its heading is open.
                if wanted == Some(at) && ui.is_visible() {
                    typed.response.request_focus();
                    typed.response.scroll_to_me(Some(Align::Center));
                    ui.data_mut(|data| data.remove_temp::<String>(pointed));
                }
                if typed.changed {
                    if text == *joint {
                        corrections.joints.remove(part);
                    } else {
                        corrections.joints.insert(part.clone(), text);
                    }
                }
                ui.end_row();
            }
        });
    });
}

/// Shows the findings about a file, with their lines and remedies.
fn show_file_findings(ui: &mut Ui, seen: &PaneInput<'_>, file: &FileReport) {
    for finding in &file.findings {
        let colour = match finding.severity {
            "note" => ui.visuals().weak_text_color(),
            _ => seen.pane_colours().trouble,
        };
        let place = match finding.line {
            Some(line) => format!("{}: ", fill_text_braces(seen.say_text(words::LINE), &[("n", &line)])),
            None => String::new(),
        };
        let message = import_people::translate_import_remark(&finding.message, seen.language);
        let text = RichText::new(format!("{place}{message}")).small().color(colour);
        ui.label(text);
        let remedy = finding.remedy.as_ref();
        if let Some(remedy) = remedy.and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language)) {
            let text = fill_text_braces(seen.say_text(shell::REMEDY), &[("remedy", &remedy)]);
            ui.label(RichText::new(text).small());
        }
    }
}
