//! Corrections by the user, who knows more than the files.

use std::collections::BTreeMap;

use chereme_corpus::{FileJoining, ImportOptions, OwnEdits};
use chereme_motion::SignerAxes;
use eframe::egui::{CollapsingHeader, ComboBox, Grid, Id, Role, Ui, WidgetInfo};

use super::{import_data, import_people};
use crate::context::PaneInput;
use crate::panes::complete_pane::{CompletionLine, fitting_candidates, show_completion_line};
use crate::words::{InterfaceText, fill_text_braces, import_words as words};

/// The user's corrections.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ImportCorrections {
    signer: String,
    /// `right`, `left`, or `None`.
    hand: Option<&'static str>,
    metres_per_unit: Option<f64>,
    licence: String,
    mend_root: bool,
    /// Whether the user's own edits are kept if a file changed.
    own_edits: OwnEdits,
    /// The evidence that joins files into one recording.
    joining: FileJoining,
    axes: Option<SignerAxes>,
    /// The roles of tiers, by name.
    pub(super) tiers: BTreeMap<String, String>,
    /// The joint of each part of the body; empty if the part has none.
    pub(super) joints: BTreeMap<String, String>,
}

impl ImportCorrections {
    pub(super) fn corrected_import_options(&self, dry_run: bool) -> ImportOptions {
        let text = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
        ImportOptions {
            signer: text(&self.signer),
            handedness: self.hand.map(str::to_owned),
            metres_per_unit: self.metres_per_unit,
            licence: text(&self.licence),
            mend_root: self.mend_root,
            own_edits: self.own_edits,
            joining: self.joining,
            axes: self.axes,
            roles: import_data::chosen_joint_roles(&self.joints),
            mapping: import_data::mapping_from_choices(&self.tiers),
            dry_run,
            ..ImportOptions::default()
        }
    }
}

/// Shows the corrections that the user can make.
pub(super) fn show_import_corrections(corrections: &mut ImportCorrections, ui: &mut Ui, seen: &PaneInput<'_>) {
    CollapsingHeader::new(seen.say_text(words::KNOWN_BETTER))
        .id_salt("known")
        .show(ui, |ui| {
            Grid::new("known").num_columns(2).show(ui, |ui| {
                let label = ui.label(seen.say_text(words::SIGNER));
                let signers = &seen.snapshot.overview.signers;
                let candidates =
                    |typed: &str| fitting_candidates(signers.iter().map(|signer| signer.name.as_str()), typed);
                let line = CompletionLine {
                    hint: seen.say_text(words::AS_FILES_SAY),
                    width: 150.0,
                    ..CompletionLine::default()
                };
                let typed = show_completion_line(
                    ui,
                    Id::unique("import signer"),
                    line,
                    &mut corrections.signer,
                    &candidates,
                );
                typed.response.labelled_by(label.id);
                ui.end_row();
                let hands = [
                    (None, words::AS_FILES_SAY),
                    (Some("right"), words::RIGHT),
                    (Some("left"), words::LEFT),
                ];
                show_correction_list(ui, seen, words::HANDEDNESS, &mut corrections.hand, &hands);
                let units = [
                    (None, words::AS_UNDERSTOOD),
                    (Some(1.0), words::METRES),
                    (Some(0.01), words::CENTIMETRES),
                    (Some(0.001), words::MILLIMETRES),
                    (Some(0.0254), words::INCHES),
                ];
                show_correction_list(ui, seen, words::UNIT, &mut corrections.metres_per_unit, &units);
                show_axes_choice(ui, seen, &mut corrections.axes);
                let edits = [
                    (OwnEdits::Ask, words::EDITS_ASK),
                    (OwnEdits::Merge, words::EDITS_MERGE),
                    (OwnEdits::Theirs, words::EDITS_THEIRS),
                    (OwnEdits::Mine, words::EDITS_MINE),
                ];
                show_correction_list(ui, seen, words::OWN_EDITS, &mut corrections.own_edits, &edits);
                let joinings = [
                    (FileJoining::Certain, words::JOIN_CERTAIN),
                    (FileJoining::Name, words::JOIN_NAME),
                    (FileJoining::Timecode, words::JOIN_TIMECODE),
                    (FileJoining::None, words::JOIN_NONE),
                ];
                show_correction_list(ui, seen, words::JOINING, &mut corrections.joining, &joinings);
                let label = ui.label(seen.say_text(words::LICENCE));
                let none = |_: &str| Vec::new();
                let line = CompletionLine {
                    width: 150.0,
                    ..CompletionLine::default()
                };
                let typed =
                    show_completion_line(ui, Id::unique("import licence"), line, &mut corrections.licence, &none);
                typed.response.labelled_by(label.id);
                ui.end_row();
            });
            ui.checkbox(&mut corrections.mend_root, seen.say_text(words::MEND_ROOT));
        });
    show_named_joints(corrections, ui, seen);
}

/// Shows the joints that the user named, each with a button that forgets it, even if the files were refused because of
/// them.
fn show_named_joints(corrections: &mut ImportCorrections, ui: &mut Ui, seen: &PaneInput<'_>) {
    let mut forgotten = None;
    for (part, joint) in &corrections.joints {
        ui.horizontal(|ui| {
            let joint = if joint.trim().is_empty() {
                seen.say_text(words::NO_JOINT)
            } else {
                joint.trim()
            };
            let named = import_people::body_part_name(part, seen.language);
            ui.small(format!("{named} = {joint}"));
            let name = fill_text_braces(seen.say_text(words::FORGET), &[("what", &named)]);
            let button = ui.small_button("×");
            button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
            if button.on_hover_text(&name).clicked() {
                forgotten = Some(part.clone());
            }
        });
    }
    if let Some(part) = forgotten {
        corrections.joints.remove(&part);
    }
}

/// Shows the axes that point up and to the signer's left, which can be changed.
fn show_axes_choice(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut Option<SignerAxes>) {
    ui.label(seen.say_text(words::AXES));
    let text = |axes: &Option<SignerAxes>| match axes {
        None => seen.say_text(words::AS_UNDERSTOOD).to_owned(),
        Some(axes) => import_people::axes_sentence(*axes, seen.language),
    };
    let combo = ComboBox::from_id_salt("axes").selected_text(text(value)).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for axes in std::iter::once(None).chain(import_data::all_axes().map(Some)) {
            let name = text(&axes);
            ui.selectable_value(value, axes, name);
        }
    });
    let name = format!("{}: {}", seen.say_text(words::AXES), text(value));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    ui.end_row();
}

fn show_correction_list<T: PartialEq + Copy>(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    value: &mut T,
    all: &[(T, InterfaceText)],
) {
    ui.label(seen.say_text(text));
    let now = all
        .iter()
        .find(|(other, _)| other == value)
        .map_or("", |(_, text)| seen.say_text(*text));
    let combo = ComboBox::from_id_salt(text.text_id()).selected_text(now).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for (it, text) in all {
            ui.selectable_value(value, *it, seen.say_text(*text));
        }
    });
    let name = format!("{}: {now}", seen.say_text(text));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    ui.end_row();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_evidence_that_joins_files_reaches_the_import_options() {
        for joining in [
            FileJoining::Certain,
            FileJoining::Name,
            FileJoining::Timecode,
            FileJoining::None,
        ] {
            let corrections = ImportCorrections {
                joining,
                ..ImportCorrections::default()
            };
            assert_eq!(corrections.corrected_import_options(true).joining, joining);
        }
    }

    #[test]
    fn the_choice_about_own_edits_reaches_the_import_options() {
        assert_eq!(
            ImportCorrections::default().corrected_import_options(true).own_edits,
            OwnEdits::Ask
        );
        for own_edits in [OwnEdits::Merge, OwnEdits::Theirs, OwnEdits::Mine] {
            let corrections = ImportCorrections {
                own_edits,
                ..ImportCorrections::default()
            };
            assert_eq!(corrections.corrected_import_options(false).own_edits, own_edits);
        }
    }
}
