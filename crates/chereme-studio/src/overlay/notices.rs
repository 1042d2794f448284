//! Notices: what happened, and what went wrong with what helps; they never stand in the way.

use std::fmt::Display;

use chereme_corpus::{Cause, CheckReport, Error};
use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{
    Align, Align2, Area, Context, Frame, Id, Label, Layout, Order, RichText, Role, ScrollArea,
    Style, TextStyle, Ui, WidgetInfo, vec2,
};

use super::trouble;
use crate::command::Command;
use crate::context::Outbox;
use crate::theme;
use crate::theme::Colours;
use crate::words::{Language, Text, fill, history, shell as words};
use crate::work::Outcome;

/// How long good news is shown, in seconds.
const SHORT: f64 = 5.0;
/// How many are shown at once.
const MOST: usize = 4;

/// A notice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Notice {
    id: u64,
    pub(crate) text: String,
    pub(crate) remedy: Option<String>,
    /// What the corpus itself said.
    detail: Option<String>,
    /// Whether it stays until it is put away.
    pub(crate) stays: bool,
    /// Whether it is over as soon as something could be written: a full disk, another's lock.
    passes: bool,
    /// When it was first seen, on the window's clock.
    since: Option<f64>,
}

/// The notices that are shown.
#[derive(Debug, Default)]
pub(crate) struct Notices {
    /// The one that stands in the status line, where it covers nothing.
    in_line: Option<u64>,
    pub(crate) all: Vec<Notice>,
    next: u64,
}

impl Notices {
    /// Says something that goes away by itself.
    pub(crate) fn hint(&mut self, text: impl Into<String>) {
        self.add(text.into(), None, false);
    }

    /// Says something that stays.
    pub(crate) fn say(&mut self, text: &str, remedy: Option<&str>) {
        self.add(text.to_owned(), remedy.map(str::to_owned), true);
    }

    /// Tells what went wrong, and what helps.
    pub(crate) fn trouble(&mut self, error: &Error, task: Option<Text>, language: Language) {
        if matches!(error, Error::Stopped) {
            self.hint(words::STOPPED.of(language));
            return;
        }
        let told = trouble::told(error, task, language);
        self.all
            .retain(|notice| notice.detail != told.detail || told.detail.is_none());
        self.add(told.text, told.remedy, true);
        if let Some(notice) = self.all.last_mut() {
            notice.detail = told.detail;
            notice.passes = matches!(error.cause(), Some(Cause::Full | Cause::Busy));
        }
    }

    /// Tells that the settings could not be written.
    pub(crate) fn unsaved(&mut self, error: &dyn Display, language: Language) {
        self.add(
            words::SETTINGS_UNSAVED.of(language).to_owned(),
            Some(error.to_string()),
            true,
        );
    }

    /// Tells what came of work, where that is worth a word.
    pub(crate) fn of(&mut self, outcome: &Outcome, language: Language) {
        let written = matches!(
            outcome,
            Outcome::Annotated(_)
                | Outcome::Changed
                | Outcome::Imported(_)
                | Outcome::Recombined(_)
                | Outcome::Undone(_)
                | Outcome::Redone(_)
        );
        self.all.retain(|notice| !(written && notice.passes));
        let text = match outcome {
            Outcome::Recombined(made) => {
                fill(words::NOTICE_STORED.of(language), &[("gloss", &made.gloss)])
            }
            Outcome::Undone(row) => {
                fill(words::NOTICE_UNDONE.of(language), &[("what", &row.summary)])
            }
            Outcome::Walked { back, steps } => {
                let text = if *back {
                    history::WALKED_BACK
                } else {
                    history::WALKED_FORWARD
                };
                fill(text.of(language), &[("n", steps)])
            }
            Outcome::Proposed(it) => fill(
                words::NOTICE_PROPOSED.of(language),
                &[("tokens", &it.tokens), ("unread", &it.unread)],
            ),
            Outcome::Checked(report) => return self.checked(report, language),
            Outcome::Redone(row) => {
                fill(words::NOTICE_REDONE.of(language), &[("what", &row.summary)])
            }
            Outcome::Exported(report) => {
                let text = super::export::written_text(report);
                fill(text.of(language), &[("n", &report.files.len())])
            }
            _ => return,
        };
        self.hint(text);
    }

    /// Tells what a check found: faults with their places and what helps, which stay until they are put away.
    fn checked(&mut self, report: &CheckReport, language: Language) {
        if report.ok && report.mended.is_empty() {
            return self.hint(words::CHECKED_WELL.of(language));
        }
        let (text, n) = if report.ok {
            (words::CHECKED_MENDED, report.mended.len())
        } else {
            (words::CHECKED_FAULTS, report.faults.len())
        };
        self.say(&fill(text.of(language), &[("n", &n)]), None);
        let faults = report.faults.iter();
        let faults = faults.map(|it| format!("{}: {} ({})", it.place, it.message, it.remedy));
        let lines: Vec<String> = report.mended.iter().cloned().chain(faults).collect();
        if let Some(notice) = self.all.last_mut() {
            notice.detail = Some(lines.join("\n"));
        }
    }

    pub(crate) fn dismiss(&mut self, id: u64) {
        self.all.retain(|notice| notice.id != id);
    }

    fn add(&mut self, text: String, remedy: Option<String>, stays: bool) {
        self.all.retain(|notice| {
            // One hint follows another; what is to be put away stays.
            notice.text != text && (stays || notice.stays || notice.since.is_none())
        });
        self.next += 1;
        self.all.push(Notice {
            id: self.next,
            text,
            remedy,
            detail: None,
            stays,
            passes: false,
            since: None,
        });
        while self.all.len() > MOST {
            self.all.remove(0);
        }
    }

    /// Shows the newest hint at the end of the status line, where there is room for it.
    pub(crate) fn line(&mut self, ui: &mut Ui) {
        self.in_line = None;
        let Some(notice) = self.all.iter().rev().find(|it| !it.stays) else {
            return;
        };
        let colours = Colours::of(theme::is_dark(ui.ctx()));
        let mut job = LayoutJob::default();
        let font = TextStyle::Body.resolve(ui.style());
        let dot = TextFormat::simple(font.clone(), colours.good);
        job.append("●", 0.0, dot);
        let strong = ui.visuals().strong_text_color();
        job.append(
            &notice.text.replace('`', ""),
            8.0,
            TextFormat::simple(font, strong),
        );
        let galley = ui.painter().layout_job(job);
        if galley.rows.len() > 1 || galley.size().x + 16.0 > ui.available_width() {
            return;
        }
        self.in_line = Some(notice.id);
        let label = notice.text.clone();
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let said = ui.add(Label::new(galley));
            said.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
        });
    }

    pub(crate) fn ui(&mut self, ctx: &Context, language: Language, out: &mut Outbox) {
        let now = ctx.input(|input| input.time);
        for notice in &mut self.all {
            notice.since.get_or_insert(now);
        }
        let old = |notice: &Notice| {
            !notice.stays && notice.since.is_some_and(|since| now - since > SHORT)
        };
        self.all.retain(|notice| !old(notice));
        if self.all.is_empty() {
            return;
        }
        ctx.request_repaint_after(std::time::Duration::from_millis(500));
        let in_line = self.in_line;
        let elsewhere = |notice: &&Notice| Some(notice.id) != in_line;
        if !self.all.iter().any(|it| elsewhere(&it)) {
            return;
        }
        let area = Area::new(Id::unique("notices"))
            .order(Order::Foreground)
            .anchor(Align2::RIGHT_BOTTOM, vec2(-16.0, -44.0));
        area.show(ctx, |ui| {
            ui.set_max_width(420.0);
            let colours = Colours::of(theme::is_dark(ctx));
            for notice in self.all.iter().filter(elsewhere) {
                Frame::popup(ui.style()).show(ui, |ui| {
                    let edge = if notice.stays {
                        colours.trouble
                    } else {
                        colours.good
                    };
                    ui.horizontal_wrapped(|ui| {
                        ui.label(RichText::new("●").color(edge));
                        ui.label(with_code(ui.style(), &notice.text, false));
                    });
                    if let Some(remedy) = &notice.remedy {
                        ui.label(with_code(ui.style(), remedy, true));
                    }
                    if let Some(detail) = &notice.detail {
                        ui.separator();
                        ScrollArea::vertical().max_height(120.0).show(ui, |ui| {
                            ui.label(RichText::new(detail).small().weak());
                        });
                    }
                    if notice.stays && ui.button(words::CLOSE.of(language)).clicked() {
                        out.send(Command::Dismiss(notice.id));
                    }
                });
            }
        });
    }
}

/// Lays a text out with what stands between backticks as code, without them.
fn with_code(style: &Style, text: &str, weak: bool) -> LayoutJob {
    let mut job = LayoutJob::default();
    let visuals = &style.visuals;
    let colour = if weak {
        visuals.weak_text_color()
    } else {
        visuals.text_color()
    };
    let fonts = [TextStyle::Body, TextStyle::Monospace].map(|it| it.resolve(style));
    for (at, part) in text.split('`').enumerate() {
        let format = TextFormat::simple(fonts[at % 2].clone(), colour);
        job.append(part, 0.0, format);
    }
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_check_found_stays_with_its_places() {
        let mut notices = Notices::default();
        let well = CheckReport {
            ok: true,
            ..CheckReport::default()
        };
        notices.of(&Outcome::Checked(well.clone()), Language::English);
        assert!(!notices.all[0].stays);
        let faulty = CheckReport {
            ok: false,
            faults: vec![chereme_corpus::Fault {
                kind: "block",
                place: "block 7".into(),
                message: "it is another".into(),
                remedy: "import again".into(),
            }],
            ..well
        };
        notices.of(&Outcome::Checked(faulty), Language::English);
        let told = notices.all.last().expect("a notice");
        assert!(told.stays && told.text == "Checked, and faults found: 1");
        let detail = told.detail.as_deref();
        assert_eq!(detail, Some("block 7: it is another (import again)"));
    }

    #[test]
    fn trouble_comes_with_what_helps_and_is_told_once() {
        let mut notices = Notices::default();
        let error = || Error::wrong("no").advise("yes");
        notices.trouble(&error(), None, Language::French);
        notices.trouble(&error(), None, Language::French);
        assert_eq!(notices.all.len(), 1);
        assert_eq!(notices.all[0].detail.as_deref(), Some("no\n(yes)"));
        notices.trouble(&Error::Stopped, None, Language::English);
        assert!(!notices.all[1].stays);
        for at in 0..9 {
            notices.hint(at.to_string());
        }
        assert_eq!(notices.all.len(), MOST);
    }
}
