//! The export window: writes the selection or the results of a search in a suitable format; the folder is remembered.

use std::path::{Path, PathBuf};

use chereme_corpus::{CorpusAddress, ExportOptions, ExportReport, ExportWhat, MovementForm, OutputAudience, RowName};
use eframe::egui::{Button, Context, Id, Key, RichText, ScrollArea, Ui};

use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::panes::complete_pane::CompletionLine;
use crate::panes::import::PathCompletions;
use crate::panes::recombine::selected_token;
use crate::panes::show_running_work;
use crate::settings::StudioSettings;
use crate::window_remedy::ShownFailure;
use crate::words::{
    InterfaceLanguage, InterfaceText, export_words as words, fill_text_braces, translate_library_message,
};
use crate::work::{WorkId, WorkOutcome, WorkResult, exchange};

/// The object of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ExportObject {
    Token(i64, String),
    Tier(i64, String),
    Recording(i64, String),
    /// The results of a query, and how many there are.
    Found(String, usize),
    All,
}

/// A format, by the extension of its files, and its name; no extension means a folder.
type ExportWindowFormat = (Option<&'static str>, InterfaceText);

const TABLE_FORMATS: [ExportWindowFormat; 2] = [(Some("csv"), words::CSV), (Some("tsv"), words::TSV)];
const NOTATION_FORMATS: [ExportWindowFormat; 3] = [
    (Some("sigml"), words::SIGML),
    (Some("hsigml"), words::HSIGML),
    (Some("hns"), words::HNS),
];
const MOTION_FORMATS: [ExportWindowFormat; 2] = [(Some("bvh"), words::BVH), (Some("eaf"), words::EAF)];

/// Returns the formats that can hold the object, the likeliest first.
pub(crate) fn formats_for_export(what: &ExportObject) -> Vec<ExportWindowFormat> {
    let mut all = Vec::new();
    match what {
        ExportObject::Token(..) | ExportObject::Recording(..) => {
            all.extend(MOTION_FORMATS);
            all.extend(TABLE_FORMATS);
            all.extend(NOTATION_FORMATS);
        }
        ExportObject::Tier(..) => all.extend(TABLE_FORMATS),
        ExportObject::Found(..) => {
            all.extend(TABLE_FORMATS);
            all.extend(NOTATION_FORMATS);
        }
        ExportObject::All => {
            all.push((None, words::FOLDER));
            all.extend(TABLE_FORMATS);
            all.extend(NOTATION_FORMATS);
        }
    }
    all
}

/// Returns a suggested file name without folder.
pub(crate) fn file_name(what: &ExportObject, corpus: &Path, format: Option<&str>) -> String {
    let stem = corpus.file_stem().unwrap_or_default().to_string_lossy();
    let base = match what {
        ExportObject::Token(_, gloss) => gloss.clone(),
        ExportObject::Tier(_, name) | ExportObject::Recording(_, name) => name.clone(),
        ExportObject::Found(..) => format!("{stem}-found"),
        ExportObject::All => format!("{stem}-export"),
    };
    let safe = |letter: char| {
        if "/\\:*?\"<>|".contains(letter) || letter.is_control() {
            '-'
        } else {
            letter
        }
    };
    let base: String = base.chars().map(safe).collect();
    match format {
        Some(format) => format!("{base}.{format}"),
        None => base,
    }
}

/// The window that exports.
#[derive(Default)]
pub(crate) struct ExportWindow {
    open: bool,
    what: Option<ExportObject>,
    format: Option<&'static str>,
    /// The avatar whose bones move in the file instead of those of the capture.
    avatar: Option<&'static str>,
    /// For whom it is written.
    audience: OutputAudience,
    to: String,
    /// Whether the user typed the path, so that it is not changed automatically.
    typed: bool,
    replace: bool,
    paths: PathCompletions,
    /// The query of the latest complete answer, and how many tokens it found.
    found: Option<(String, usize)>,
    asked: Option<WorkId>,
    wrong: Option<ShownFailure>,
    stopped: bool,
    written: Option<ExportReport>,
}

impl ExportWindow {
    pub(crate) fn toggle_export_window(&mut self) {
        self.open = !self.open;
        (self.what, self.typed, self.wrong, self.written) = (None, false, None, None);
        // Each export is for oneself unless others are chosen, so that nothing goes out because the last one did.
        self.audience = OutputAudience::default();
    }

    pub(crate) fn handle_export_result(&mut self, id: WorkId, ended: &WorkResult) {
        // An answer without facets is only a count or a later page.
        if let Ok(WorkOutcome::Found(answer)) = ended
            && !answer.facets.is_empty()
        {
            self.found = Some((answer.query.clone(), answer.total));
        }
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(WorkOutcome::Exported(report)) => self.written = Some(report.clone()),
            Ok(_) => {}
            Err(chereme_corpus::CorpusError::Stopped) => self.stopped = true,
            Err(error) => self.wrong = Some(ShownFailure::from_error(error)),
        }
    }

    /// Returns what can be exported now, the selection first.
    fn exportable_objects(&self, seen: &PaneInput<'_>) -> Vec<ExportObject> {
        let mut all = Vec::new();
        let selected = seen.shown.selected_annotation().is_some() || seen.shown.span.is_some();
        if let Some((token, gloss)) = selected_token(seen).filter(|_| selected) {
            all.push(ExportObject::Token(token, gloss));
        }
        if let Some(recording) = seen.shown.recording.and_then(|id| seen.snapshot.recording_glance(id)) {
            all.push(ExportObject::Recording(recording.row.id, recording.row.name.clone()));
            let contents = seen.snapshot.recording_contents(recording.row.id);
            let tier =
                contents.and_then(|contents| contents.tiers.iter().find(|tier| Some(tier.row.id) == seen.shown.tier));
            all.extend(tier.map(|tier| ExportObject::Tier(tier.row.id, tier.row.name.clone())));
        }
        let found_query = self.found.as_ref().filter(|(_, total)| *total > 0);
        all.extend(found_query.map(|(query, total)| ExportObject::Found(query.clone(), *total)));
        all.push(ExportObject::All);
        all
    }

    pub(crate) fn ui(&mut self, ctx: &Context, seen: &PaneInput<'_>, settings: &StudioSettings, corpus: &Path) {
        if !self.open {
            return;
        }
        let open = super::show_form_window(ctx, seen.say_text(words::TITLE), "export", |ui| {
            self.show_export_form(ui, seen, settings, corpus);
        });
        self.open = open && !(self.asked.is_none() && super::take_escape_key(ctx));
    }

    fn show_export_form(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, settings: &StudioSettings, corpus: &Path) {
        let choices = self.exportable_objects(seen);
        if self.what.as_ref().is_none_or(|what| !choices.contains(what)) {
            self.what = choices.first().cloned();
        }
        let before = (self.what.clone(), self.format);
        ui.label(RichText::new(seen.say_text(words::WHAT)).small());
        for choice in &choices {
            let chosen = self.what.as_ref() == Some(choice);
            if ui.radio(chosen, what_text(seen, choice)).clicked() {
                self.what = Some(choice.clone());
            }
        }
        let Some(what) = self.what.clone() else {
            return;
        };
        let formats = formats_for_export(&what);
        if !formats.iter().any(|(format, _)| *format == self.format) || before.0.is_none() {
            self.format = formats.first().and_then(|(format, _)| *format);
        }
        ui.add_space(4.0);
        ui.label(RichText::new(seen.say_text(words::FORMAT)).small());
        ui.horizontal_wrapped(|ui| {
            for (format, text) in formats {
                ui.selectable_value(&mut self.format, format, seen.say_text(text));
            }
        });
        if matches!(self.format, Some("bvh" | "glb")) {
            ui.add_space(4.0);
            ui.label(RichText::new(seen.say_text(words::SKELETON)).small());
            ui.horizontal_wrapped(|ui| {
                ui.selectable_value(&mut self.avatar, None, seen.say_text(words::CAPTURED));
                for name in MovementForm::avatar_names() {
                    ui.selectable_value(&mut self.avatar, Some(name), name);
                }
            });
        }
        if before != (self.what.clone(), self.format) && (!self.typed || self.to.is_empty()) {
            let name = file_name(&what, corpus, self.format);
            let set_folder = settings.export_folder.clone();
            let folder = set_folder
                .or_else(|| corpus.parent().map(Path::to_owned))
                .unwrap_or_default();
            self.to = folder.join(name).display().to_string();
            (self.written, self.wrong) = (None, None);
        } else if before.1 != self.format && self.typed {
            let typed_path = PathBuf::from(&self.to);
            let path = typed_path.with_extension(self.format.unwrap_or_default());
            self.to = path.display().to_string();
        }
        ui.add_space(4.0);
        ui.label(RichText::new(seen.say_text(words::AUDIENCE)).small());
        ui.horizontal_wrapped(|ui| {
            for (audience, text) in [
                (OutputAudience::Me, words::FOR_ME),
                (OutputAudience::Research, words::FOR_RESEARCH),
                (OutputAudience::Public, words::FOR_PUBLIC),
            ] {
                let choice = ui.selectable_value(&mut self.audience, audience, seen.say_text(text));
                if choice.changed() {
                    (self.written, self.wrong) = (None, None);
                }
            }
        });
        if self.audience != OutputAudience::Me {
            ui.small(seen.say_text(words::AUDIENCE_HINT));
        }
        ui.add_space(4.0);
        let label = ui.label(RichText::new(seen.say_text(words::WHERE)).small());
        let line = CompletionLine::default();
        let typed = self
            .paths
            .show_path_field(ui, Id::unique("export path"), line, &mut self.to);
        let entered = typed.response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        typed.response.labelled_by(label.id);
        if typed.changed {
            self.typed = true;
            (self.written, self.wrong) = (None, None);
        }
        ui.checkbox(&mut self.replace, seen.say_text(words::REPLACE));
        ui.add_space(4.0);
        self.show_export_buttons(ui, seen, settings, &what, entered);
        if let Some(wrong) = &self.wrong {
            wrong.show_failure(ui, seen.language, seen.pane_colours().trouble);
        }
        if self.stopped {
            ui.label(seen.say_text(words::STOPPED));
        }
        if let Some(report) = &self.written {
            let text = written_text(report, seen.language);
            ui.label(RichText::new(text).color(seen.pane_colours().good));
            if !report.withheld.is_empty() {
                let withheld = fill_text_braces(seen.say_text(words::WITHHELD), &[("n", &report.withheld.len())]);
                ui.label(RichText::new(withheld).color(seen.pane_colours().warning));
            }
            ScrollArea::vertical().max_height(100.0).show(ui, |ui| {
                for note in &report.notes {
                    ui.small(translate_library_message(note, seen.language));
                }
                for file in &report.files {
                    ui.small(format!("{} · {} KB", file.path.display(), file.bytes.div_ceil(1024)));
                }
            });
        }
    }

    fn show_export_buttons(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        settings: &StudioSettings,
        what: &ExportObject,
        entered: bool,
    ) {
        ui.horizontal(|ui| {
            if show_running_work(ui, seen, self.asked) {
                return;
            }
            let ready = !self.to.trim().is_empty();
            let write = Button::new(RichText::new(seen.say_text(words::WRITE)).strong());
            if ui.add_enabled(ready, write).clicked() || (ready && entered) {
                self.write_export(settings, what, seen.out);
            }
        });
    }

    /// Returns the chosen form of movement, where the format holds movement on any bones.
    fn movement_form(&self) -> MovementForm {
        let avatar = self.avatar.filter(|_| matches!(self.format, Some("bvh" | "glb")));
        MovementForm::read_movement_form(avatar, None, false).unwrap_or_default()
    }

    fn write_export(&mut self, settings: &StudioSettings, what: &ExportObject, out: &CommandOutbox) {
        let to = PathBuf::from(self.to.trim());
        let options = ExportOptions {
            force: self.replace,
            movement: self.movement_form(),
            audience: self.audience,
            ..ExportOptions::default()
        };
        let stored = match what {
            ExportObject::Token(id, _) => Some(CorpusAddress::Token(*id)),
            ExportObject::Tier(id, _) => Some(CorpusAddress::Tier(*id)),
            ExportObject::Recording(id, _) => Some(CorpusAddress::Recording(RowName::Number(*id))),
            ExportObject::Found(..) | ExportObject::All => None,
        };
        let job = match what {
            ExportObject::Found(query, _) => exchange::export_found(query.clone(), to.clone(), options),
            _ => exchange::export_files_job(stored.map_or(ExportWhat::All, ExportWhat::Address), to.clone(), options),
        };
        (self.wrong, self.written, self.stopped) = (None, None, false);
        self.asked = Some(out.request_work(job));
        let folder = to.parent().map(Path::to_owned);
        if folder != settings.export_folder {
            out.send_command(WindowCommand::Settings(Box::new(StudioSettings {
                export_folder: folder,
                ..settings.clone()
            })));
        }
    }
}

/// Returns the text that reports the written files and their folder.
pub(crate) fn written_text(report: &ExportReport, language: InterfaceLanguage) -> String {
    let Some(first) = report.files.first() else {
        return words::WRITTEN_NONE.text_in_language(language).to_owned();
    };
    let name = first.path.file_name().unwrap_or_default().display();
    let folder = first.path.parent().unwrap_or(&first.path).display();
    let text = match report.files.len() {
        1 => words::WRITTEN_ONE,
        _ => words::WRITTEN,
    };
    let n = report.files.len();
    fill_text_braces(
        text.text_in_language(language),
        &[("n", &n), ("name", &name), ("folder", &folder)],
    )
}

fn what_text(seen: &PaneInput<'_>, what: &ExportObject) -> String {
    match what {
        ExportObject::Token(_, gloss) => fill_text_braces(seen.say_text(words::TOKEN), &[("name", gloss)]),
        ExportObject::Tier(_, name) => fill_text_braces(seen.say_text(words::TIER), &[("name", name)]),
        ExportObject::Recording(_, name) => fill_text_braces(seen.say_text(words::RECORDING), &[("name", name)]),
        // An empty query finds all tokens.
        ExportObject::Found(query, n) if query.trim().is_empty() => {
            fill_text_braces(seen.say_text(words::FOUND_ALL), &[("n", n)])
        }
        ExportObject::Found(query, n) => {
            let values: [(&str, &dyn std::fmt::Display); 2] = [("n", n), ("query", query)];
            fill_text_braces(seen.say_text(words::FOUND), &values)
        }
        ExportObject::All => seen.say_text(words::ALL_OF_IT).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exported_files_get_safe_names_from_their_contents() {
        let corpus = Path::new("/a/corpus.chereme");
        for (what, format, want) in [
            (ExportObject::Token(1, "QUOI?".into()), Some("bvh"), "QUOI-.bvh"),
            (ExportObject::Recording(1, "a/b".into()), Some("eaf"), "a-b.eaf"),
            (ExportObject::Found("x".into(), 3), Some("csv"), "corpus-found.csv"),
            (ExportObject::All, None, "corpus-export"),
        ] {
            assert_eq!(file_name(&what, corpus, format), want);
            assert!(formats_for_export(&what).iter().any(|(known, _)| *known == format));
        }
        assert_eq!(formats_for_export(&ExportObject::Tier(1, String::new())).len(), 2);
    }
}
