//! The answers to a study, imported from files.

use std::path::PathBuf;

use chereme_corpus::FileStatus;
use chereme_corpus::study::{AnswersOptions, AnswersReport, ColumnUse, NamedText, StudyOverview};
use eframe::egui::{Button, CollapsingHeader, Grid, ScrollArea, Ui};

use super::studies_draft::{show_remove_line_button, text_block};
use super::{PathField, StudiesPane, answer_list, progress};
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::panes::import::PathCompletions;
use crate::words::{fill_text_braces, shell, studies_words as words, translate_library_message};
use crate::work::{WorkId, studying};

/// How many findings of a file are shown.
const MAX_SHOWN_FINDINGS: usize = 20;

/// The files, and the report of their import.
#[derive(Default)]
pub(super) struct AnswerImportForm {
    path: String,
    paths: PathCompletions,
    /// Files that were chosen or dropped together.
    several: Vec<PathBuf>,
    /// The map of columns of tables with one participant a row, and the name of its file.
    map: String,
    map_file: String,
    /// Whether the import that runs, or the last one, is only tried.
    tried: bool,
    pub(super) importing: Option<WorkId>,
    pub(super) report: Option<AnswersReport>,
}

impl AnswerImportForm {
    /// Takes files or folders that were chosen or dropped.
    pub(super) fn take_answer_files(&mut self, paths: Vec<PathBuf>) {
        self.report = None;
        match paths.as_slice() {
            [one] => (self.path, self.several) = (one.display().to_string(), Vec::new()),
            _ => (self.path, self.several) = (String::new(), paths),
        }
    }

    /// Takes a map of columns that was read from a file.
    pub(super) fn take_map(&mut self, it: &NamedText) {
        let raw_name = std::path::Path::new(&it.file).file_name();
        let name = raw_name.map(|name| name.to_string_lossy().into_owned());
        self.map_file = name.unwrap_or_else(|| it.file.clone());
        self.map = it.text.trim_start_matches('\u{feff}').to_owned();
        self.report = None;
    }

    fn answer_import_options(&self, dry_run: bool) -> AnswersOptions {
        let file = match self.map_file.as_str() {
            "" => "map",
            name => name,
        };
        let columns = (!self.map.trim().is_empty()).then(|| NamedText {
            text: self.map.clone(),
            file: file.to_owned(),
        });
        AnswersOptions { columns, dry_run }
    }

    fn answer_file_paths(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.several.clone(),
            path => vec![PathBuf::from(path)],
        }
    }
}

/// Shows the files, the button that imports them, and the report.
pub(super) fn show_answer_import(pane: &mut StudiesPane, ui: &mut Ui, seen: &PaneInput<'_>, it: &StudyOverview) {
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("people", &it.participants),
        ("finished", &it.finished),
        ("answers", &it.answers),
    ];
    ui.label(fill_text_braces(seen.say_text(words::PEOPLE), &values));
    let form = &mut pane.forms.answers;
    let field = PathField {
        name: words::ANSWERS_PATH,
        hint: seen.say_text(words::ANSWERS_HINT),
        chooser: ChooserPurpose::Answers,
    };
    field.show_path_line(ui, seen, &mut form.paths, &mut form.path);
    if form.path.trim().is_empty() {
        for path in form.several.iter().take(8) {
            ui.small(path.display().to_string());
        }
    }
    let header = CollapsingHeader::new(seen.say_text(words::MAP_HEADER)).id_salt("map");
    let open = (!form.map.trim().is_empty()).then_some(true);
    header.open(open).show(ui, |ui| {
        ui.weak(seen.say_text(words::MAP_HELP));
        let titles = "column,item,condition,part,role,question,means,values";
        text_block(ui, seen.say_text(words::MAP_HEADER), titles, &mut form.map);
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say_text(words::CHOOSE_MAP)).clicked() {
                seen.send_command(WindowCommand::Choose(ChooserPurpose::Columns));
            }
            if !form.map.is_empty() && show_remove_line_button(ui, seen, seen.say_text(words::MAP_HEADER)) {
                form.map.clear();
                form.map_file.clear();
            }
            if !form.map_file.is_empty() {
                ui.weak(&form.map_file);
            }
        });
    });
    if !progress(ui, seen, form.importing, words::TASK_ANSWERS) {
        let files = form.answer_file_paths();
        let locked = seen.snapshot.is_read_only();
        let ready = !files.is_empty() && !locked;
        let why = match locked {
            true => shell::READ_ONLY_WHY,
            false => words::NEEDS_FILES,
        };
        let mut wanted = None;
        ui.horizontal_wrapped(|ui| {
            for (dry_run, text) in [(false, words::IMPORT), (true, words::TRY_IMPORT)] {
                let button = ui.add_enabled(ready, Button::new(seen.say_text(text)));
                if button.on_disabled_hover_text(seen.say_text(why)).clicked() {
                    wanted = Some(dry_run);
                }
            }
        });
        if let Some(dry_run) = wanted {
            let job = studying::import_answers_job(it.plan.name.clone(), files, form.answer_import_options(dry_run));
            (form.importing, form.report) = (Some(seen.request_work(job)), None);
            form.tried = dry_run;
            pane.clear_study_results();
        }
    }
    if let Some(report) = &pane.forms.answers.report {
        if pane.forms.answers.tried {
            ui.strong(seen.say_text(words::TRIED));
        }
        imported(ui, seen, report);
    }
    answer_list::show_study_answers(pane, ui, seen, it);
}

/// Shows the use of each column of a table.
fn show_column_uses(ui: &mut Ui, seen: &PaneInput<'_>, id: &str, uses: &[ColumnUse]) {
    let area = ScrollArea::both().id_salt(("columns", id)).max_height(220.0);
    area.auto_shrink([false, true]).show(ui, |ui| {
        Grid::new(("uses", id)).striped(true).show(ui, |ui| {
            for title in [
                words::COLUMN_COLUMN,
                words::COLUMN_MEANS,
                words::COLUMN_CELLS,
                words::COLUMN_EXAMPLE,
            ] {
                ui.weak(seen.say_text(title));
            }
            ui.end_row();
            for it in uses {
                ui.label(&it.column);
                match it.means.as_str() {
                    "" => ui.weak(seen.say_text(words::COLUMN_UNUSED)),
                    means => ui.label(means),
                };
                ui.label(it.cells.to_string());
                ui.label(match it.stands_for.as_str() {
                    "" => it.example.clone(),
                    value => {
                        let values: [(&str, &dyn std::fmt::Display); 2] = [("code", &it.example), ("value", &value)];
                        fill_text_braces(seen.say_text(words::STANDS_FOR), &values)
                    }
                });
                ui.end_row();
            }
        });
    });
}

fn imported(ui: &mut Ui, seen: &PaneInput<'_>, report: &AnswersReport) {
    let values: [(&str, &dyn std::fmt::Display); 5] = [
        ("files", &report.files.len()),
        ("added", &report.added),
        ("replaced", &report.replaced),
        ("unchanged", &report.unchanged),
        ("answers", &report.answers),
    ];
    ui.label(fill_text_braces(seen.say_text(words::IMPORTED), &values));
    for file in &report.files {
        let refused = file.status == FileStatus::Refused;
        if refused {
            let text = fill_text_braces(seen.say_text(words::REFUSED), &[("path", &file.path)]);
            ui.colored_label(seen.pane_colours().trouble, text);
        } else if !file.findings.is_empty() {
            ui.label(&file.path);
        }
        if !file.columns.is_empty() {
            show_column_uses(ui, seen, &file.path, &file.columns);
        }
        for finding in file.findings.iter().take(MAX_SHOWN_FINDINGS) {
            let message = translate_library_message(&finding.message, seen.language);
            let text = match finding.line {
                Some(line) => {
                    let values: [(&str, &dyn std::fmt::Display); 2] = [("line", &line), ("message", &message)];
                    fill_text_braces(seen.say_text(words::LINE), &values)
                }
                None => message,
            };
            ui.weak(text);
        }
    }
}
