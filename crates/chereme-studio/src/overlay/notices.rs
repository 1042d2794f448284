//! Notices: reports of actions, and failures with remedies; they never block the user.

use std::fmt::Display;
use std::path::PathBuf;

use chereme_corpus::words::effect::OperationEffect;
use chereme_corpus::{Cause, CheckReport, Deleted, Error, FitReport, Proposed};
use eframe::egui::text::{LayoutJob, TextFormat, TextWrapping};
use eframe::egui::{
    Align, Align2, Area, Color32, Context, Frame, Id, Label, Layout, Order, RichText, Role,
    ScrollArea, Sense, Shape, Stroke, Style, TextStyle, Ui, Vec2, WidgetInfo, vec2,
};

use super::{remedy, trouble};
use crate::action::Action;
use crate::command::Command;
use crate::context::Outbox;
use crate::file_dialogs::Choose;
use crate::theme;
use crate::theme::Colours;
use crate::words::{Language, Text, fill, history, shell as words, spoken};
use crate::work::Outcome;

/// How long a hint is shown, in seconds.
const SHORT: f64 = 5.0;
/// How long a hint with a command is shown, in seconds.
const LONG: f64 = 15.0;
/// How many notices are shown at once.
const MOST: usize = 4;

/// The kind of a notice: each has a colour, and a shape that can be recognised without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoticeKind {
    /// Something was done.
    Done,
    /// A warning: an impossible action, or a change by others.
    Warning,
    /// Something failed.
    Error,
}

impl NoticeKind {
    fn colour(self, colours: &Colours) -> Color32 {
        match self {
            Self::Done => colours.good,
            Self::Warning => colours.warning,
            Self::Error => colours.trouble,
        }
    }

    fn name(self) -> Text {
        match self {
            Self::Done => words::KIND_DONE,
            Self::Warning => words::KIND_WARNING,
            Self::Error => words::KIND_ERROR,
        }
    }
}

/// A remedy that a notice offers, as often as the user wants.
#[derive(Debug, Clone)]
pub(crate) enum NoticeOffer {
    /// Carry out an action.
    Do(Action),
    /// Let the user choose a file or a folder.
    Choose(Choose),
    /// Save a copy of the corpus there and continue in it.
    SaveCopy(PathBuf),
}

impl NoticeOffer {
    fn command(&self) -> Command {
        match self {
            Self::Do(action) => Command::Do(*action),
            Self::Choose(what) => Command::Choose(*what),
            Self::SaveCopy(path) => Command::SaveCopy(path.clone()),
        }
    }
}

/// A notice.
#[derive(Debug, Clone)]
pub(crate) struct Notice {
    id: u64,
    pub(crate) kind: NoticeKind,
    /// Whether it appears in the status line only, as it reports the user's own action.
    quiet: bool,
    /// The remedies that the notice offers, with their labels.
    offers: Vec<(Text, NoticeOffer)>,
    pub(crate) text: String,
    pub(crate) remedy: Option<String>,
    /// The original message of the corpus.
    detail: Option<String>,
    /// Whether it stays until it is dismissed.
    pub(crate) stays: bool,
    /// Whether it disappears as soon as something could be written, as for a full disk or a lock of another program.
    passes: bool,
    /// When it was first seen, on the window's clock.
    since: Option<f64>,
}

/// The notices on display.
#[derive(Debug, Default)]
pub(crate) struct Notices {
    /// The id of the notice in the status line, where it covers nothing.
    in_line: Option<u64>,
    pub(crate) all: Vec<Notice>,
    next: u64,
    /// Whether Escape was pressed with no menu and no field open, so that it may close a notice.
    pub(crate) may_close: bool,
}

impl Notices {
    /// Reports something done; the notice disappears by itself.
    pub(crate) fn hint(&mut self, text: impl Into<String>) {
        self.add(NoticeKind::Done, text.into(), None, false);
    }

    /// Reports the user's own action, at the end of the status line only.
    pub(crate) fn did(&mut self, text: impl Into<String>) {
        self.hint(text);
        if let Some(notice) = self.all.last_mut() {
            notice.quiet = true;
        }
    }

    /// Shows a warning, such as why something cannot be done; it disappears by itself.
    pub(crate) fn warn(&mut self, text: impl Into<String>) {
        self.add(NoticeKind::Warning, text.into(), None, false);
    }

    /// Shows a notice that stays.
    pub(crate) fn say(&mut self, text: &str, remedy: Option<&str>) {
        let remedy = remedy.map(str::to_owned);
        self.add(NoticeKind::Warning, text.to_owned(), remedy, true);
    }

    /// Shows a failure that stays, with commands that can help at once.
    pub(crate) fn offer(&mut self, text: String, remedy: &str, offers: Vec<(Text, NoticeOffer)>) {
        self.add(NoticeKind::Error, text, Some(remedy.to_owned()), true);
        if let Some(notice) = self.all.last_mut() {
            notice.offers = offers;
        }
    }

    /// Removes the notices that offer commands.
    pub(crate) fn withdraw(&mut self) {
        self.all.retain(|notice| notice.offers.is_empty());
    }

    /// Reports a failure, and the remedy.
    pub(crate) fn trouble(&mut self, error: &Error, task: Option<Text>, language: Language) {
        if matches!(error, Error::Stopped) {
            self.hint(words::STOPPED.of(language));
            return;
        }
        let report = trouble::failure_report(error, task, language);
        self.all
            .retain(|notice| notice.detail != report.detail || report.detail.is_none());
        self.add(NoticeKind::Error, report.text, report.remedy, true);
        if let Some(notice) = self.all.last_mut() {
            notice.detail = report.detail;
            notice.passes = matches!(error.cause(), Some(Cause::Full | Cause::Busy));
        }
    }

    /// Reports that the settings could not be written.
    pub(crate) fn unsaved(&mut self, error: &dyn Display, language: Language) {
        self.add(
            NoticeKind::Error,
            words::SETTINGS_UNSAVED.of(language).to_owned(),
            Some(error.to_string()),
            true,
        );
    }

    /// Reports the outcome of work, if it is worth a notice.
    pub(crate) fn of(&mut self, outcome: &Outcome, language: Language) {
        let written = matches!(
            outcome,
            Outcome::Annotated(_)
                | Outcome::Changed
                | Outcome::Imported(_)
                | Outcome::Merged(_)
                | Outcome::Adjudicated(_)
                | Outcome::Planned(_)
                | Outcome::AnswersImported(_)
                | Outcome::Recombined(_)
                | Outcome::Deleted(_)
                | Outcome::Undone(_)
                | Outcome::Redone(_)
        );
        self.all.retain(|notice| !(written && notice.passes));
        let text = match outcome {
            Outcome::Said(text) => text.clone(),
            Outcome::Recombined(made) => {
                fill(words::NOTICE_STORED.of(language), &[("gloss", &made.gloss)])
            }
            Outcome::Deleted(done) => return self.deleted(done, language),
            Outcome::Undone(row) => history::undo_sentence(&row.effect, language),
            Outcome::Walked { back, steps } => {
                let text = if *back {
                    history::WALKED_BACK
                } else {
                    history::WALKED_FORWARD
                };
                fill(text.of(language), &[("n", steps)])
            }
            Outcome::Proposed(done) => return self.proposed(done, language),
            Outcome::Fitted(report) => return self.fitted(report, language),
            Outcome::Checked(report) => return self.checked(report, language),
            Outcome::Redone(row) => {
                let what = history::operation_sentence(&row.effect, language);
                fill(history::DONE_AGAIN.of(language), &[("what", &what)])
            }
            Outcome::Exported(report) => super::export::written_text(report, language),
            Outcome::Shared(picture) => {
                let values: [(&str, &dyn std::fmt::Display); 2] =
                    [("title", &picture.title), ("path", &picture.path.display())];
                fill(crate::words::stage::SHARED.of(language), &values)
            }
            _ => return,
        };
        self.hint(text);
    }

    /// Reports what was proposed, with the corpus's notes on what was not.
    fn proposed(&mut self, done: &Proposed, language: Language) {
        let values: [(&str, &dyn Display); 2] =
            [("tokens", &done.tokens), ("unread", &done.unread)];
        match (done.tokens, done.unread) {
            (0, 0) => {
                let remedy = words::NOTICE_NO_SIGNS_REMEDY.of(language);
                self.say(words::NOTICE_NO_SIGNS.of(language), Some(remedy));
            }
            (0, _) => self.say(
                &fill(words::NOTICE_NOT_PROPOSED.of(language), &values),
                None,
            ),
            _ => self.hint(fill(words::NOTICE_PROPOSED.of(language), &values)),
        }
        for finding in &done.findings {
            self.say(&spoken(finding, language), None);
        }
    }

    /// Reports a body that was fitted to markers, with the corpus's warnings about it.
    fn fitted(&mut self, report: &FitReport, language: Language) {
        let markers = match &report.subject {
            Some(subject) => format!("{} ({subject})", report.markers),
            None => report.markers.clone(),
        };
        let mm = format!("{:.0}", report.median_mm);
        let values: [(&str, &dyn Display); 3] =
            [("markers", &markers), ("n", &report.frames), ("mm", &mm)];
        self.hint(fill(words::NOTICE_FITTED.of(language), &values));
        for finding in &report.findings {
            self.say(&spoken(finding, language), None);
        }
    }

    /// Reports a deletion, and offers to undo it.
    fn deleted(&mut self, done: &Deleted, language: Language) {
        if done.dry_run {
            return;
        }
        let names = vec![done.summary.clone()];
        self.hint(history::operation_sentence(
            &OperationEffect::Delete { names },
            language,
        ));
        if let Some(notice) = self.all.last_mut() {
            notice.offers = vec![(Action::Undo.row().name, NoticeOffer::Do(Action::Undo))];
        }
    }

    /// Reports the results of a check: faults with their places and remedies, which stay until they are dismissed.
    fn checked(&mut self, report: &CheckReport, language: Language) {
        if report.ok && report.mended.is_empty() && report.questions.is_empty() {
            return self.hint(words::CHECKED_WELL.of(language));
        }
        let (text, n) = match (report.ok, report.mended.len()) {
            (false, _) => (words::CHECKED_FAULTS, report.faults.len()),
            (true, 0) => (words::CHECKED_WELL, 0),
            (true, mended) => (words::CHECKED_MENDED, mended),
        };
        self.say(&fill(text.of(language), &[("n", &n)]), None);
        if let (false, Some(notice)) = (report.ok, self.all.last_mut()) {
            notice.kind = NoticeKind::Error;
        }
        let faults = report.findings();
        let said = |text: &String| spoken(text, language);
        let faults = faults.map(|it| {
            let message = said(&it.message);
            match remedy::here(&it.remedy, language) {
                Some(remedy) => format!("{}: {message} ({remedy})", it.place),
                None => format!("{}: {message}", it.place),
            }
        });
        let lines: Vec<String> = report.mended.iter().map(said).chain(faults).collect();
        if let Some(notice) = self.all.last_mut() {
            notice.detail = Some(lines.join("\n"));
        }
    }

    pub(crate) fn dismiss(&mut self, id: u64) {
        self.all.retain(|notice| notice.id != id);
    }

    /// Removes the newest notice that stays, if Escape was pressed and nothing else took it.
    pub(crate) fn take_escape(&mut self, ctx: &Context) {
        let may_close = std::mem::take(&mut self.may_close);
        let newest = self.all.iter().rposition(|notice| notice.stays);
        if let Some(newest) = newest.filter(|_| may_close && super::escaped(ctx)) {
            self.all.remove(newest);
        }
    }

    fn add(&mut self, kind: NoticeKind, text: String, remedy: Option<String>, stays: bool) {
        self.all.retain(|notice| {
            // A hint replaces the hint before it; a notice that must be dismissed stays.
            notice.text != text && (stays || notice.stays || notice.since.is_none())
        });
        self.next += 1;
        self.all.push(Notice {
            id: self.next,
            kind,
            quiet: false,
            offers: Vec::new(),
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

    /// Shows the newest hint at the end of the status line, if there is room for it; a report of the user's own
    /// action is cut short.
    pub(crate) fn line(&mut self, ui: &mut Ui, language: Language) {
        self.in_line = None;
        let Some(notice) = self
            .all
            .iter()
            .rev()
            .find(|it| !it.stays && it.offers.is_empty())
        else {
            return;
        };
        let font = TextStyle::Body.resolve(ui.style());
        let strong = ui.visuals().strong_text_color();
        let text = notice.text.replace('`', "");
        let mut job = LayoutJob::simple_singleline(text, font, strong);
        let room = ui.available_width() - MARK - 24.0;
        if notice.quiet {
            job.wrap = TextWrapping::truncate_at_width(room.max(0.0));
        }
        let galley = ui.painter().layout_job(job);
        if galley.size().x > room || room < 40.0 {
            return;
        }
        self.in_line = Some(notice.id);
        let (label, kind) = (notice.text.clone(), notice.kind);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let said = ui.add(Label::new(galley));
            said.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
            said.on_hover_text(&label);
            mark(ui, kind, language);
        });
    }

    pub(crate) fn ui(&mut self, ctx: &Context, language: Language, out: &mut Outbox) {
        let now = ctx.input(|input| input.time);
        for notice in &mut self.all {
            notice.since.get_or_insert(now);
        }
        let old = |notice: &Notice| {
            let shown = if notice.offers.is_empty() {
                SHORT
            } else {
                LONG
            };
            !notice.stays && notice.since.is_some_and(|since| now - since > shown)
        };
        self.all.retain(|notice| !old(notice));
        if self.all.is_empty() {
            return;
        }
        ctx.request_repaint_after(std::time::Duration::from_millis(500));
        let in_line = self.in_line;
        let elsewhere = |notice: &&Notice| Some(notice.id) != in_line && !notice.quiet;
        if !self.all.iter().any(|it| elsewhere(&it)) {
            return;
        }
        let area = Area::new(Id::unique("notices"))
            .order(Order::Foreground)
            .anchor(Align2::RIGHT_BOTTOM, vec2(-16.0, -44.0));
        area.show(ctx, |ui| {
            ui.set_max_width(WIDEST);
            for notice in self.all.iter().filter(elsewhere) {
                Frame::popup(ui.style()).show(ui, |ui| {
                    ui.horizontal(|ui| {
                        mark(ui, notice.kind, language);
                        ui.add(Label::new(with_code(ui.style(), &notice.text, false)).wrap());
                    });
                    if let Some(remedy) = &notice.remedy {
                        ui.add(Label::new(with_code(ui.style(), remedy, true)).wrap());
                    }
                    if let Some(detail) = &notice.detail {
                        ui.separator();
                        ScrollArea::vertical().max_height(120.0).show(ui, |ui| {
                            ui.add(Label::new(RichText::new(detail).small().weak()).wrap());
                        });
                    }
                    ui.horizontal_wrapped(|ui| {
                        for (text, offer) in &notice.offers {
                            if ui.button(text.of(language)).clicked() {
                                out.send(offer.command());
                            }
                        }
                        if notice.stays && ui.button(words::CLOSE.of(language)).clicked() {
                            out.send(Command::Dismiss(notice.id));
                        }
                    });
                });
            }
        });
    }
}

/// The largest width of a notice, in points.
const WIDEST: f32 = 420.0;
/// The side of a notice's mark, in points.
const MARK: f32 = 14.0;

/// Paints the mark of a notice's kind: a tick in a disc, an exclamation mark in a triangle, or a cross in a square.
fn mark(ui: &mut Ui, kind: NoticeKind, language: Language) {
    let colours = Colours::of(theme::is_dark(ui.ctx()));
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(MARK), Sense::hover());
    let name = kind.name().of(language);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    let (centre, colour) = (rect.center(), kind.colour(colours));
    let ink = Stroke::new(1.8, ui.visuals().panel_fill);
    let painter = ui.painter();
    let at = |x: f32, y: f32| centre + vec2(x, y);
    match kind {
        NoticeKind::Done => {
            painter.circle_filled(centre, 6.5, colour);
            painter.line_segment([at(-3.0, 0.2), at(-0.8, 2.6)], ink);
            painter.line_segment([at(-0.8, 2.6), at(3.2, -2.4)], ink);
        }
        NoticeKind::Warning => {
            let points = vec![at(0.0, -6.5), at(7.0, 6.0), at(-7.0, 6.0)];
            painter.add(Shape::convex_polygon(points, colour, Stroke::NONE));
            painter.line_segment([at(0.0, -2.6), at(0.0, 1.8)], ink);
            painter.line_segment([at(0.0, 3.2), at(0.0, 4.8)], ink);
        }
        NoticeKind::Error => {
            painter.rect_filled(rect.shrink(0.5), 2.0, colour);
            painter.line_segment([at(-3.0, -3.0), at(3.0, 3.0)], ink);
            painter.line_segment([at(-3.0, 3.0), at(3.0, -3.0)], ink);
        }
    }
    response.on_hover_text(name);
}

/// Lays out a text; parts between backticks are shown as code, without the backticks.
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
    use chereme_corpus::words::effect::{AnnotationDeed, AnnotationEffect, ValuedThing};

    use super::*;

    #[test]
    fn a_long_notice_is_broken_into_lines_that_stay_in_the_window() {
        let mut notices = Notices::default();
        notices.offer(
            "long words ".repeat(60),
            &"and more ".repeat(60),
            Vec::new(),
        );
        let mut window = egui_kittest::Harness::builder()
            .with_size(vec2(640.0, 420.0))
            .build_ui_state(
                |ui, notices: &mut Notices| {
                    let mut out = Outbox::default();
                    notices.ui(ui.ctx(), Language::English, &mut out);
                },
                notices,
            );
        window.run_steps(3);
        use egui_kittest::kittest::Queryable;
        for label in ["long words", "and more"] {
            let found = window.get_by_label_contains(label).rect();
            assert!(
                found.left() >= 0.0 && found.width() < WIDEST,
                "{label}: {found}"
            );
        }
    }

    #[test]
    fn escape_closes_one_notice_that_stays_if_nothing_else_takes_it() {
        use eframe::egui::{Event, Key, Modifiers, RawInput};
        let mut notices = Notices::default();
        notices.say("one", None);
        notices.say("two", None);
        let ctx = Context::default();
        for (may_close, left) in [(false, 2), (true, 1), (false, 1), (true, 0)] {
            notices.may_close = may_close;
            let escape = Event::Key {
                key: Key::Escape,
                physical_key: None,
                pressed: true,
                repeat: false,
                modifiers: Modifiers::NONE,
            };
            let input = RawInput {
                events: vec![escape],
                ..RawInput::default()
            };
            let mut output = ctx.run_ui(input, |ui| notices.take_escape(ui.ctx()));
            output.textures_delta.clear();
            assert_eq!(notices.all.len(), left);
        }
    }

    #[test]
    fn faults_found_by_a_check_stay_visible_with_their_locations() {
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
        let notice = notices.all.last().expect("a notice");
        assert!(notice.stays && notice.text == "Checked, and faults found: 1");
        let detail = notice.detail.as_deref();
        assert_eq!(detail, Some("block 7: it is another (import again)"));
    }

    #[test]
    fn proposals_without_signs_and_signs_that_cannot_be_read_are_reported_apart() {
        for (unread, want) in [(0, words::NOTICE_NO_SIGNS), (3, words::NOTICE_NOT_PROPOSED)] {
            let mut notices = Notices::default();
            let proposed = Proposed {
                unread,
                ..Proposed::default()
            };
            notices.of(&Outcome::Proposed(proposed), Language::English);
            let notice = notices.all.last().expect("a notice");
            let want = fill(want.of(Language::English), &[("unread", &unread)]);
            assert_eq!(
                (&notice.text, notice.remedy.is_some()),
                (&want, unread == 0)
            );
        }
    }

    #[test]
    fn notes_on_what_was_not_proposed_stay_in_both_languages() {
        let finding = "handshapes are not proposed where fingers rest throughout, as nobody captured them: chat";
        for (tokens, language, start) in [
            (1, Language::English, "handshapes are not proposed"),
            (
                1,
                Language::French,
                "les configurations ne sont pas proposées",
            ),
            (0, Language::English, "handshapes are not proposed"),
        ] {
            let mut notices = Notices::default();
            let proposed = Proposed {
                tokens,
                unread: 1 - tokens,
                findings: vec![finding.to_owned()],
                ..Proposed::default()
            };
            notices.of(&Outcome::Proposed(proposed), language);
            assert_eq!(notices.all.len(), 2, "{tokens}");
            let notice = &notices.all[1];
            assert!(
                notice.stays && notice.text.starts_with(start),
                "{}",
                notice.text
            );
            assert!(notice.text.ends_with(": chat"), "{}", notice.text);
        }
    }

    #[test]
    fn an_error_is_shown_once_with_its_remedy() {
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

    #[test]
    fn notices_name_the_operation_and_differ_by_kind() {
        let mut notices = Notices::default();
        let row = |deed: AnnotationDeed| chereme_corpus::OperationRow {
            id: 2,
            at: "2026-01-02T03:04:05Z".into(),
            author: "A".into(),
            kind: chereme_corpus::OperationKind::Undo,
            target: Some(1),
            name: "annotate".into(),
            summary: String::new(),
            effect: OperationEffect::Annotate(AnnotationEffect {
                changes: vec![deed],
                recordings: 1,
                recording: "Un".into(),
            }),
            changes: 1,
            stands: true,
        };
        for (outcome, want) in [
            (
                Outcome::Undone(row(AnnotationDeed::AnnotationsRemoved { count: 3 })),
                "3 annotations restored in Un",
            ),
            (
                Outcome::Redone(row(AnnotationDeed::AnnotationsValued {
                    count: 3,
                    of: ValuedThing::Handshape,
                    value: "U".into(),
                })),
                "Done again: 3 handshapes changed to U in Un",
            ),
        ] {
            notices.of(&outcome, Language::English);
            let last = notices.all.last().expect("a notice");
            assert_eq!((last.text.as_str(), last.kind), (want, NoticeKind::Done));
        }
        notices.warn("no");
        assert_eq!(
            notices.all.last().map(|it| it.kind),
            Some(NoticeKind::Warning)
        );
        notices.trouble(&Error::wrong("no"), None, Language::English);
        assert_eq!(
            notices.all.last().map(|it| it.kind),
            Some(NoticeKind::Error)
        );
        for dark in [false, true] {
            let colours = Colours::of(dark);
            let all = [NoticeKind::Done, NoticeKind::Warning, NoticeKind::Error]
                .map(|it| it.colour(colours));
            assert!(all[0] != all[1] && all[1] != all[2] && all[0] != all[2]);
        }
        notices.offer(
            "gone".into(),
            "copy",
            vec![(words::SAVE_COPY, NoticeOffer::Do(Action::Undo))],
        );
        notices.withdraw();
        assert!(notices.all.iter().all(|it| it.text != "gone"));
    }
}
