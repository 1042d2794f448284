//! Import: what was understood of files before anything is written, what a person knows better, and
//! then the writing.

mod body;
mod data;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use chereme_corpus::{FileReport, FileStatus, ImportOptions, ImportReport};
use eframe::egui::{
    Button, CollapsingHeader, ComboBox, Grid, Id, ProgressBar, RichText, Role, ScrollArea, Ui,
    WidgetInfo,
};

use super::Pane;
use super::complete::{Line, Typed, complete, fitting};
use crate::choose::Choose;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::words::{Text, fill, import as words, shell};
use crate::work::{Ended, Outcome, Work, WorkId};

/// What a person says that files do not.
#[derive(Debug, Clone, Default, PartialEq)]
struct Said {
    signer: String,
    /// `right`, `left`, or nothing.
    hand: Option<&'static str>,
    metres_per_unit: Option<f64>,
    licence: String,
    mend_root: bool,
    /// What tiers are, by name.
    tiers: BTreeMap<String, String>,
}

impl Said {
    fn options(&self, dry_run: bool) -> ImportOptions {
        let text = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
        ImportOptions {
            signer: text(&self.signer),
            handedness: self.hand.map(str::to_owned),
            metres_per_unit: self.metres_per_unit,
            licence: text(&self.licence),
            mend_root: self.mend_root,
            mapping: data::mapping(&self.tiers),
            dry_run,
            ..ImportOptions::default()
        }
    }
}

/// What a typed path may become, as far as it was asked.
#[derive(Default)]
pub(crate) struct Paths {
    of: String,
    asked: Option<WorkId>,
    all: Vec<String>,
}

impl Paths {
    /// Shows a path with what it may become.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        id: Id,
        line: Line<'_>,
        text: &mut String,
        out: &mut Outbox,
    ) -> Typed {
        let folder = |text: &str| text.rfind('/').map(|at| text[..=at].to_owned());
        let focused = ui.memory(|memory| memory.has_focus(id));
        if focused
            && let Some(folder) = folder(text)
            && folder != self.of
        {
            self.asked = Some(out.work(Work::Paths(folder.clone())));
            self.of = folder;
            self.all.clear();
        }
        let candidates = |typed: &str| fitting(self.all.iter().map(String::as_str), typed);
        complete(ui, id, line, text, &candidates)
    }

    pub(crate) fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asked.take_if(|asked| *asked == id).is_some()
            && let Ok(Outcome::Paths(_, all)) = ended
        {
            self.all.clone_from(all);
        }
    }
}

/// The pane.
#[derive(Default)]
pub(crate) struct Import {
    path: String,
    /// Files that were dropped or chosen, where they are several.
    dropped: Vec<PathBuf>,
    paths: Paths,
    said: Said,
    /// What was said when the files were looked at last.
    looked: Said,
    asked: Option<WorkId>,
    report: Option<ImportReport>,
    /// Why nothing could be looked at.
    wrong: Option<String>,
    /// The work was stopped.
    stopped: bool,
    /// Files were just given: look at them.
    fresh: bool,
    come: bool,
}

impl Import {
    /// Takes paths to be looked at.
    pub(crate) fn propose(&mut self, paths: &[PathBuf]) {
        self.path = match paths {
            [one] => one.display().to_string(),
            _ => String::new(),
        };
        self.dropped = paths.to_vec();
        self.report = None;
        self.fresh = !paths.is_empty();
    }

    fn files(&self) -> Vec<PathBuf> {
        match self.path.trim() {
            "" => self.dropped.clone(),
            path => vec![PathBuf::from(path)],
        }
    }

    fn ask(&mut self, dry_run: bool, out: &mut Outbox) {
        if let Some(old) = self.asked.take() {
            out.send(Command::Stop(old));
        }
        let options = Box::new(self.said.options(dry_run));
        self.looked = self.said.clone();
        (self.wrong, self.stopped) = (None, false);
        self.asked = Some(out.work(Work::Import(self.files(), options)));
    }

    fn choosing(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let label = ui.label(RichText::new(seen.say(words::PATH)).small());
        let id = Id::unique("import path");
        let line = Line {
            name: "",
            hint: seen.say(words::PATH_HINT),
            width: f32::INFINITY,
        };
        if std::mem::take(&mut self.come) {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let typed = self.paths.show(ui, id, line, &mut self.path, out);
        let (entered, changed) = (typed.entered, typed.changed);
        typed.response.labelled_by(label.id);
        if changed {
            self.report = None;
        }
        // A folder that is taken from the list goes on to what is in it.
        let whole = !changed || !self.path.ends_with('/');
        if entered && whole && !self.files().is_empty() {
            self.ask(true, out);
        }
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say(words::CHOOSE_FILES)).clicked() {
                out.send(Command::Choose(Choose::Files));
            }
            if ui.button(seen.say(words::CHOOSE_FOLDER)).clicked() {
                out.send(Command::Choose(Choose::Folder));
            }
        });
        if self.path.trim().is_empty() {
            for path in self.dropped.iter().take(8) {
                ui.small(path.display().to_string());
            }
            if self.dropped.len() > 8 {
                let more = self.dropped.len() - 8;
                ui.small(fill(seen.say(words::MORE_FILES), &[("n", &more)]));
            }
        }
    }

    /// What a person knows better than the files.
    fn known(&mut self, ui: &mut Ui, seen: &Seen<'_>) {
        let said = &mut self.said;
        CollapsingHeader::new(seen.say(words::KNOWN_BETTER))
            .id_salt("known")
            .show(ui, |ui| {
                Grid::new("known").num_columns(2).show(ui, |ui| {
                    let label = ui.label(seen.say(words::SIGNER));
                    let signers = &seen.snapshot.overview.signers;
                    let candidates =
                        |typed: &str| fitting(signers.iter().map(|it| it.name.as_str()), typed);
                    let line = Line {
                        name: "",
                        hint: seen.say(words::AS_FILES_SAY),
                        width: 150.0,
                    };
                    let typed = complete(
                        ui,
                        Id::unique("import signer"),
                        line,
                        &mut said.signer,
                        &candidates,
                    );
                    typed.response.labelled_by(label.id);
                    ui.end_row();
                    let hands = [
                        (None, words::AS_FILES_SAY),
                        (Some("right"), words::RIGHT),
                        (Some("left"), words::LEFT),
                    ];
                    list(ui, seen, words::HANDEDNESS, &mut said.hand, &hands);
                    let units = [
                        (None, words::AS_UNDERSTOOD),
                        (Some(1.0), words::METRES),
                        (Some(0.01), words::CENTIMETRES),
                        (Some(0.001), words::MILLIMETRES),
                        (Some(0.0254), words::INCHES),
                    ];
                    list(ui, seen, words::UNIT, &mut said.metres_per_unit, &units);
                    let label = ui.label(seen.say(words::LICENCE));
                    let none = |_: &str| Vec::new();
                    let line = Line {
                        name: "",
                        hint: "",
                        width: 150.0,
                    };
                    let typed = complete(
                        ui,
                        Id::unique("import licence"),
                        line,
                        &mut said.licence,
                        &none,
                    );
                    typed.response.labelled_by(label.id);
                    ui.end_row();
                });
                ui.checkbox(&mut said.mend_root, seen.say(words::MEND_ROOT));
            });
    }

    fn buttons(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let running = self.asked.and_then(|id| seen.running.get(&id));
        if let (Some(running), Some(id)) = (running, self.asked) {
            ui.horizontal(|ui| {
                match running.far.share() {
                    Some(share) => {
                        drop(
                            ui.add(
                                ProgressBar::new(share)
                                    .desired_width(120.0)
                                    .show_percentage(),
                            ),
                        );
                    }
                    None => drop(ui.spinner()),
                }
                if ui.button(seen.say(shell::CANCEL)).clicked() {
                    out.send(Command::Stop(id));
                }
                let task = eframe::egui::Label::new(&running.far.task);
                ui.add(task.truncate());
            });
            return;
        }
        let ready = !self.files().is_empty();
        let looked = self.report.as_ref().is_some_and(|report| report.dry_run);
        let changed = looked && self.looked != self.said;
        ui.horizontal_wrapped(|ui| {
            let text = if looked {
                words::LOOK_AGAIN
            } else {
                words::LOOK
            };
            if !looked || changed {
                let look = Button::new(seen.say(text));
                if ui.add_enabled(ready, look).clicked() {
                    self.ask(true, out);
                }
            }
            let any = self.report.as_ref().is_some_and(|report| {
                report
                    .files
                    .iter()
                    .any(|file| matches!(file.status, FileStatus::Imported | FileStatus::Updated))
            });
            let take = Button::new(RichText::new(seen.say(words::TAKE)).strong());
            let take = ui.add_enabled(ready && looked && any, take);
            let tip = if looked {
                words::NOTHING_NEW
            } else {
                words::LOOK_FIRST
            };
            if take.on_disabled_hover_text(seen.say(tip)).clicked() {
                self.ask(false, out);
            }
        });
    }

    fn report(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let Some(report) = self.report.take() else {
            if self.wrong.is_none() && !seen.is_running(self.asked) {
                ui.weak(seen.say(words::NOTHING));
            }
            return;
        };
        ui.separator();
        let text = if report.dry_run {
            words::DRY
        } else {
            words::DONE
        };
        ui.strong(seen.say(text));
        let created: Vec<String> = data::created(&report)
            .iter()
            .map(|(text, count)| fill(seen.say(*text), &[("n", count)]))
            .collect();
        ui.label(created.join(" · "));
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let open = report.files.len() <= 2;
            for file in data::in_order(&report) {
                self.file(ui, seen, file, (open, report.dry_run), out);
            }
        });
        self.report = Some(report);
    }

    fn file(
        &mut self,
        ui: &mut Ui,
        seen: &Seen<'_>,
        file: &FileReport,
        (open, dry): (bool, bool),
        out: &mut Outbox,
    ) {
        let name = Path::new(&file.path)
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        let colour = match file.status {
            FileStatus::Refused => seen.colours().trouble,
            FileStatus::Imported | FileStatus::Updated => ui.visuals().text_color(),
            _ => ui.visuals().weak_text_color(),
        };
        let [_, warnings, notes] = data::counts(file);
        let mut title = format!("{name} · {}", seen.say(data::status_text(file.status)));
        for (count, text) in [(warnings, words::WARNINGS), (notes, words::NOTES)] {
            if count > 0 {
                title = format!("{title} · {}", fill(seen.say(text), &[("n", &count)]));
            }
        }
        let header = CollapsingHeader::new(RichText::new(title).color(colour));
        let open = open || file.status == FileStatus::Refused;
        header
            .id_salt((&file.path, dry))
            .default_open(open)
            .show(ui, |ui| {
                if let Some(recording) = &file.recording {
                    ui.horizontal_wrapped(|ui| {
                        ui.weak(seen.say(words::BECOMES));
                        ui.label(recording);
                        let there = seen.snapshot.recording_named(recording);
                        if let Some(there) = there.filter(|_| !dry)
                            && ui.small_button(seen.say(words::SHOW)).clicked()
                        {
                            out.send(Command::Recording(there.row.id));
                        }
                    });
                }
                self.understood(ui, seen, file, dry);
                findings(ui, seen, file);
            });
    }

    fn understood(&mut self, ui: &mut Ui, seen: &Seen<'_>, file: &FileReport, dry: bool) {
        let lines = data::movement(file);
        let parts = data::parts(file);
        if !lines.is_empty() || parts.is_some() {
            ui.horizontal_top(|ui| {
                if let Some(parts) = &parts {
                    body::show(ui, seen, parts);
                }
                ui.vertical(|ui| {
                    for (text, value) in &lines {
                        ui.small(seen.say(*text));
                        ui.add(eframe::egui::Label::new(value).wrap());
                    }
                })
                .response
                .on_hover_text(data::reasons(file).join("\n"));
            });
        }
        let tiers = data::guesses(file, "tiers");
        if !tiers.is_empty() {
            ui.weak(seen.say(words::TIERS_ARE));
            Grid::new(("tiers", &file.path))
                .num_columns(2)
                .striped(true)
                .show(ui, |ui| {
                    for guess in &tiers {
                        let label = ui.add(eframe::egui::Label::new(&guess.name).truncate());
                        label.on_hover_text(&guess.why);
                        if dry {
                            self.tier(ui, seen, guess);
                        } else {
                            ui.label(&guess.role);
                        }
                        ui.end_row();
                    }
                });
        }
        let columns = data::guesses(file, "columns");
        if !columns.is_empty() {
            let all: Vec<String> = columns
                .iter()
                .map(|it| format!("{} = {}", it.name, it.role))
                .collect();
            ui.small(all.join(", "));
        }
    }

    /// What a tier is taken for, to be changed.
    fn tier(&mut self, ui: &mut Ui, seen: &Seen<'_>, guess: &data::Guess) {
        let said = self.said.tiers.get(&guess.name).cloned();
        let now = said.clone().unwrap_or_else(|| guess.role.clone());
        let shown = if now.is_empty() {
            seen.say(words::NOT_KNOWN)
        } else {
            &now
        };
        let mut text = RichText::new(shown);
        if said.is_some() {
            text = text.strong();
        } else if guess.sure < 0.6 {
            text = text.color(seen.colours().trouble);
        }
        let combo = ComboBox::from_id_salt(&guess.name)
            .selected_text(text)
            .width(0.0);
        let inner = combo.show_ui(ui, |ui| {
            for role in data::ROLES {
                if ui.selectable_label(now == role, role).clicked() {
                    self.said.tiers.insert(guess.name.clone(), role.to_owned());
                }
            }
        });
        let name = fill(seen.say(words::TIER_IS), &[("tier", &guess.name)]);
        inner
            .response
            .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    }
}

fn list<T: PartialEq + Copy>(
    ui: &mut Ui,
    seen: &Seen<'_>,
    text: Text,
    value: &mut T,
    all: &[(T, Text)],
) {
    ui.label(seen.say(text));
    let now = all
        .iter()
        .find(|(it, _)| it == value)
        .map_or("", |(_, text)| seen.say(*text));
    let combo = ComboBox::from_id_salt(text.en)
        .selected_text(now)
        .width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for (it, text) in all {
            ui.selectable_value(value, *it, seen.say(*text));
        }
    });
    let name = format!("{}: {now}", seen.say(text));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    ui.end_row();
}

/// What is odd about a file, with its line and what would be right.
fn findings(ui: &mut Ui, seen: &Seen<'_>, file: &FileReport) {
    for finding in &file.findings {
        let colour = match finding.severity {
            "note" => ui.visuals().weak_text_color(),
            _ => seen.colours().trouble,
        };
        let place = match finding.line {
            Some(line) => format!("{}: ", fill(seen.say(words::LINE), &[("n", &line)])),
            None => String::new(),
        };
        let text = RichText::new(format!("{place}{}", finding.message))
            .small()
            .color(colour);
        ui.label(text);
        if let Some(remedy) = &finding.remedy {
            let text = fill(seen.say(shell::REMEDY), &[("remedy", remedy)]);
            ui.label(RichText::new(text).small());
        }
    }
}

impl Pane for Import {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        self.choosing(ui, seen, out);
        if std::mem::take(&mut self.fresh) {
            self.ask(true, out);
        }
        self.known(ui, seen);
        self.buttons(ui, seen, out);
        if let Some(wrong) = &self.wrong {
            ui.label(RichText::new(wrong).color(seen.colours().trouble));
        }
        if self.stopped {
            ui.label(seen.say(shell::STOPPED));
        }
        self.report(ui, seen, out);
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        self.paths.hear(id, ended);
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(Outcome::Imported(report)) => self.report = Some(report.clone()),
            Err(chereme_corpus::Error::Stopped) => self.stopped = true,
            Ok(_) => {}
            Err(error) => {
                let remedy = error.remedy().map_or(String::new(), |it| format!("\n{it}"));
                self.wrong = Some(format!("{error}{remedy}"));
            }
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}
