//! The export window: writes the selection or the results of a search in a suitable format; the folder is remembered.

use std::path::{Path, PathBuf};

use chereme_corpus::{Address, ExportOptions, ExportReport, ExportWhat, Name};
use eframe::egui::{
    Align2, Button, Context, Id, Key, ProgressBar, RichText, ScrollArea, Ui, Window,
};

use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::complete::Line;
use crate::panes::import::Paths;
use crate::panes::recombine::selected_token;
use crate::settings::Settings;
use crate::words::{Language, Text, export as words, fill, shell, spoken};
use crate::work::{Ended, Outcome, WorkId, exchange};

/// The height of the window's title and edges, in points.
const HEAD: f32 = 56.0;
/// The width of the bar that scrolls, in points.
const BAR: f32 = 10.0;

/// The object of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum What {
    Token(i64, String),
    Tier(i64, String),
    Recording(i64, String),
    /// The results of a query, and how many there are.
    Found(String, usize),
    All,
}

/// A format, by the extension of its files, and its name; no extension means a folder.
type Format = (Option<&'static str>, Text);

const TABLES: [Format; 2] = [(Some("csv"), words::CSV), (Some("tsv"), words::TSV)];
const NOTATION: [Format; 3] = [
    (Some("sigml"), words::SIGML),
    (Some("hsigml"), words::HSIGML),
    (Some("hns"), words::HNS),
];
const MOTION: [Format; 2] = [(Some("bvh"), words::BVH), (Some("eaf"), words::EAF)];

/// Returns the formats that can hold the object, the likeliest first.
pub(crate) fn formats(what: &What) -> Vec<Format> {
    let mut all = Vec::new();
    match what {
        What::Token(..) | What::Recording(..) => {
            all.extend(MOTION);
            all.extend(TABLES);
            all.extend(NOTATION);
        }
        What::Tier(..) => all.extend(TABLES),
        What::Found(..) => {
            all.extend(TABLES);
            all.extend(NOTATION);
        }
        What::All => {
            all.push((None, words::FOLDER));
            all.extend(TABLES);
            all.extend(NOTATION);
        }
    }
    all
}

/// Returns a suggested file name without folder.
pub(crate) fn file_name(what: &What, corpus: &Path, format: Option<&str>) -> String {
    let stem = corpus.file_stem().unwrap_or_default().to_string_lossy();
    let base = match what {
        What::Token(_, gloss) => gloss.clone(),
        What::Tier(_, name) | What::Recording(_, name) => name.clone(),
        What::Found(..) => format!("{stem}-found"),
        What::All => format!("{stem}-export"),
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
pub(crate) struct Export {
    open: bool,
    what: Option<What>,
    format: Option<&'static str>,
    to: String,
    /// Whether the user typed the path, so that it is not changed automatically.
    typed: bool,
    replace: bool,
    paths: Paths,
    /// The query of the latest complete answer, and how many tokens it found.
    found: Option<(String, usize)>,
    asked: Option<WorkId>,
    wrong: Option<String>,
    stopped: bool,
    written: Option<ExportReport>,
}

impl Export {
    pub(crate) fn toggle(&mut self) {
        self.open = !self.open;
        (self.what, self.typed, self.wrong, self.written) = (None, false, None, None);
    }

    pub(crate) fn hear(&mut self, id: WorkId, ended: &Ended) {
        // An answer without facets is only a count or a later page.
        if let Ok(Outcome::Found(answer)) = ended
            && !answer.facets.is_empty()
        {
            self.found = Some((answer.query.clone(), answer.total));
        }
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(Outcome::Exported(report)) => self.written = Some(report.clone()),
            Ok(_) => {}
            Err(chereme_corpus::Error::Stopped) => self.stopped = true,
            Err(error) => {
                let remedy = error.remedy().and_then(|it| it.advice().map(str::to_owned));
                let remedy = remedy.map_or(String::new(), |it| format!("\n{it}"));
                self.wrong = Some(format!("{error}{remedy}"));
            }
        }
    }

    /// Returns what can be exported now, the selection first.
    fn choices(&self, seen: &PaneInput<'_>) -> Vec<What> {
        let mut all = Vec::new();
        let selected = seen.shown.annotation().is_some() || seen.shown.span.is_some();
        if let Some((token, gloss)) = selected_token(seen).filter(|_| selected) {
            all.push(What::Token(token, gloss));
        }
        if let Some(recording) = seen
            .shown
            .recording
            .and_then(|id| seen.snapshot.recording(id))
        {
            all.push(What::Recording(
                recording.row.id,
                recording.row.name.clone(),
            ));
            let contents = seen.snapshot.contents(recording.row.id);
            let tier = contents.and_then(|it| {
                it.tiers
                    .iter()
                    .find(|it| Some(it.row.id) == seen.shown.tier)
            });
            all.extend(tier.map(|it| What::Tier(it.row.id, it.row.name.clone())));
        }
        let found = self.found.as_ref().filter(|(_, total)| *total > 0);
        all.extend(found.map(|(query, total)| What::Found(query.clone(), *total)));
        all.push(What::All);
        all
    }

    pub(crate) fn ui(
        &mut self,
        ctx: &Context,
        seen: &PaneInput<'_>,
        settings: &Settings,
        corpus: &Path,
        out: &mut Outbox,
    ) {
        if !self.open {
            return;
        }
        let mut open = true;
        let window = Window::new(seen.say(words::TITLE))
            .id(Id::unique("export"))
            .open(&mut open)
            .pivot(Align2::CENTER_CENTER)
            .default_pos(ctx.content_rect().center())
            .default_width(420.0)
            .resizable(false);
        window.show(ctx, |ui| {
            ui.set_width(420.0_f32.min(ctx.content_rect().width() - 60.0));
            let high = (ctx.content_rect().height() - HEAD).max(120.0);
            ScrollArea::vertical().max_height(high).show(ui, |ui| {
                // The bar that scrolls covers no field.
                ui.set_max_width(ui.available_width() - BAR);
                self.form(ui, seen, (settings, corpus), out);
            });
        });
        self.open = open && !(self.asked.is_none() && super::escaped(ctx));
    }

    fn form(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        (settings, corpus): (&Settings, &Path),
        out: &mut Outbox,
    ) {
        let choices = self.choices(seen);
        if self
            .what
            .as_ref()
            .is_none_or(|what| !choices.contains(what))
        {
            self.what = choices.first().cloned();
        }
        let before = (self.what.clone(), self.format);
        ui.label(RichText::new(seen.say(words::WHAT)).small());
        for choice in &choices {
            let chosen = self.what.as_ref() == Some(choice);
            if ui.radio(chosen, what_text(seen, choice)).clicked() {
                self.what = Some(choice.clone());
            }
        }
        let Some(what) = self.what.clone() else {
            return;
        };
        let formats = formats(&what);
        if !formats.iter().any(|(format, _)| *format == self.format) || before.0.is_none() {
            self.format = formats.first().and_then(|(format, _)| *format);
        }
        ui.add_space(4.0);
        ui.label(RichText::new(seen.say(words::FORMAT)).small());
        ui.horizontal_wrapped(|ui| {
            for (format, text) in formats {
                ui.selectable_value(&mut self.format, format, seen.say(text));
            }
        });
        if before != (self.what.clone(), self.format) && (!self.typed || self.to.is_empty()) {
            let name = file_name(&what, corpus, self.format);
            let folder = settings.export_folder.clone();
            let folder = folder
                .or_else(|| corpus.parent().map(Path::to_owned))
                .unwrap_or_default();
            self.to = folder.join(name).display().to_string();
            (self.written, self.wrong) = (None, None);
        } else if before.1 != self.format && self.typed {
            let path = PathBuf::from(&self.to);
            let path = path.with_extension(self.format.unwrap_or_default());
            self.to = path.display().to_string();
        }
        ui.add_space(4.0);
        let label = ui.label(RichText::new(seen.say(words::WHERE)).small());
        let line = Line::default();
        let typed = self
            .paths
            .show(ui, Id::unique("export path"), line, &mut self.to);
        let entered = typed.response.lost_focus() && ui.input(|it| it.key_pressed(Key::Enter));
        typed.response.labelled_by(label.id);
        if typed.changed {
            self.typed = true;
            (self.written, self.wrong) = (None, None);
        }
        ui.checkbox(&mut self.replace, seen.say(words::REPLACE));
        ui.add_space(4.0);
        self.buttons(ui, seen, settings, (&what, entered), out);
        if let Some(wrong) = &self.wrong {
            let lines = wrong.lines().map(|line| spoken(line, seen.language));
            let said = lines.collect::<Vec<_>>().join("\n");
            ui.label(RichText::new(said).color(seen.colours().trouble));
        }
        if self.stopped {
            ui.label(seen.say(words::STOPPED));
        }
        if let Some(report) = &self.written {
            let text = written_text(report, seen.language);
            ui.label(RichText::new(text).color(seen.colours().good));
            ScrollArea::vertical().max_height(100.0).show(ui, |ui| {
                for file in &report.files {
                    ui.small(format!(
                        "{} · {} KB",
                        file.path.display(),
                        file.bytes.div_ceil(1024)
                    ));
                }
                for note in &report.notes {
                    ui.small(spoken(note, seen.language));
                }
            });
        }
    }

    fn buttons(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        settings: &Settings,
        (what, entered): (&What, bool),
        out: &mut Outbox,
    ) {
        let running = self.asked.and_then(|id| seen.running.get(&id));
        ui.horizontal(|ui| {
            if let (Some(running), Some(id)) = (running, self.asked) {
                match running.far.share() {
                    Some(share) => {
                        drop(
                            ui.add(
                                ProgressBar::new(share)
                                    .desired_width(160.0)
                                    .show_percentage(),
                            ),
                        );
                    }
                    None => drop(ui.spinner()),
                }
                if ui.button(seen.say(shell::CANCEL)).clicked() {
                    out.send(Command::Stop(id));
                }
                return;
            }
            let ready = !self.to.trim().is_empty();
            let write = Button::new(RichText::new(seen.say(words::WRITE)).strong());
            if ui.add_enabled(ready, write).clicked() || (ready && entered) {
                self.write(settings, what, out);
            }
        });
    }

    fn write(&mut self, settings: &Settings, what: &What, out: &mut Outbox) {
        let to = PathBuf::from(self.to.trim());
        let options = ExportOptions {
            force: self.replace,
            ..ExportOptions::default()
        };
        let address = |address: Address| ExportWhat::Address(address);
        let job = match what {
            What::Token(id, _) => {
                exchange::export(address(Address::Token(*id)), to.clone(), options)
            }
            What::Tier(id, _) => exchange::export(address(Address::Tier(*id)), to.clone(), options),
            What::Recording(id, _) => {
                let recording = Address::Recording(Name::Number(*id));
                exchange::export(address(recording), to.clone(), options)
            }
            What::Found(query, _) => exchange::export_found(query.clone(), to.clone(), options),
            What::All => exchange::export(ExportWhat::All, to.clone(), options),
        };
        (self.wrong, self.written, self.stopped) = (None, None, false);
        self.asked = Some(out.work(job));
        let folder = to.parent().map(Path::to_owned);
        if folder != settings.export_folder {
            out.send(Command::Settings(Box::new(Settings {
                export_folder: folder,
                ..settings.clone()
            })));
        }
    }
}

/// Returns the text that reports the written files and their folder.
pub(crate) fn written_text(report: &ExportReport, language: Language) -> String {
    let Some(first) = report.files.first() else {
        return words::WRITTEN_NONE.of(language).to_owned();
    };
    let name = first.path.file_name().unwrap_or_default().display();
    let folder = first.path.parent().unwrap_or(&first.path).display();
    let text = match report.files.len() {
        1 => words::WRITTEN_ONE,
        _ => words::WRITTEN,
    };
    let n = report.files.len();
    fill(
        text.of(language),
        &[("n", &n), ("name", &name), ("folder", &folder)],
    )
}

fn what_text(seen: &PaneInput<'_>, what: &What) -> String {
    match what {
        What::Token(_, gloss) => fill(seen.say(words::TOKEN), &[("name", gloss)]),
        What::Tier(_, name) => fill(seen.say(words::TIER), &[("name", name)]),
        What::Recording(_, name) => fill(seen.say(words::RECORDING), &[("name", name)]),
        // An empty query finds all tokens.
        What::Found(query, n) if query.trim().is_empty() => {
            fill(seen.say(words::FOUND_ALL), &[("n", n)])
        }
        What::Found(query, n) => {
            let values: [(&str, &dyn std::fmt::Display); 2] = [("n", n), ("query", query)];
            fill(seen.say(words::FOUND), &values)
        }
        What::All => seen.say(words::ALL_OF_IT).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exported_files_get_safe_names_from_their_contents() {
        let corpus = Path::new("/a/corpus.chereme");
        for (what, format, want) in [
            (What::Token(1, "QUOI?".into()), Some("bvh"), "QUOI-.bvh"),
            (What::Recording(1, "a/b".into()), Some("eaf"), "a-b.eaf"),
            (What::Found("x".into(), 3), Some("csv"), "corpus-found.csv"),
            (What::All, None, "corpus-export"),
        ] {
            assert_eq!(file_name(&what, corpus, format), want);
            assert!(formats(&what).iter().any(|(known, _)| *known == format));
        }
        assert_eq!(formats(&What::Tier(1, String::new())).len(), 2);
    }
}
