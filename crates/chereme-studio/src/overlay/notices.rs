//! Notices: reports of actions, and failures with remedies; they never block the user.

use std::fmt::Display;
use std::path::PathBuf;

use chereme_corpus::words::effect::OperationEffect;
use chereme_corpus::{CheckReport, CorpusError, DatabaseFailureCause, DeletionReport, FitReport, ProposalResult};
use eframe::egui::text::{LayoutJob, TextFormat, TextWrapping};
use eframe::egui::{
    Align, Align2, Area, Color32, Context, Frame, Id, Label, Layout, Order, RichText, Role, ScrollArea, Sense, Shape,
    Stroke, Style, TextStyle, Ui, Vec2, WidgetInfo, vec2,
};

use super::overlay_trouble;
use crate::action::Action;
use crate::command::{ChooserPurpose, CommandOutbox, WindowCommand};
use crate::theme::ThemeColours;
use crate::words::{
    InterfaceLanguage, InterfaceText, fill_text_braces, history_words, shell as words, translate_library_message,
};
use crate::work::WorkOutcome;
use crate::{theme, window_remedy};

/// How long a hint is shown, in seconds.
const HINT_SECONDS: f64 = 5.0;
/// How long a hint with a command is shown, in seconds.
const COMMAND_HINT_SECONDS: f64 = 15.0;
/// How many notices are shown at once.
const MAX_SHOWN_NOTICES: usize = 4;

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
    fn notice_kind_colour(self, colours: &ThemeColours) -> Color32 {
        match self {
            Self::Done => colours.good,
            Self::Warning => colours.warning,
            Self::Error => colours.trouble,
        }
    }

    fn notice_kind_name(self) -> InterfaceText {
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
    Choose(ChooserPurpose),
    /// Save a copy of the corpus there and continue in it.
    SaveCopy(PathBuf),
}

impl NoticeOffer {
    fn offered_command(&self) -> WindowCommand {
        match self {
            Self::Do(action) => WindowCommand::Do(*action),
            Self::Choose(what) => WindowCommand::Choose(*what),
            Self::SaveCopy(path) => WindowCommand::SaveCopy(path.clone()),
        }
    }
}

/// A notice.
#[derive(Debug, Clone)]
pub(crate) struct WindowNotice {
    id: u64,
    pub(crate) kind: NoticeKind,
    /// Whether it appears in the status line only, as it reports the user's own action.
    quiet: bool,
    /// The remedies that the notice offers, with their labels.
    offers: Vec<(InterfaceText, NoticeOffer)>,
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
pub(crate) struct NoticeBoard {
    /// The id of the notice in the status line, where it covers nothing.
    in_line: Option<u64>,
    pub(crate) all: Vec<WindowNotice>,
    next: u64,
    /// Whether Escape was pressed with no menu and no field open, so that it may close a notice.
    pub(crate) may_close: bool,
}

impl NoticeBoard {
    /// Reports something done; the notice disappears by itself.
    pub(crate) fn add_hint(&mut self, text: impl Into<String>) {
        self.add_notice(NoticeKind::Done, text.into(), None, false);
    }

    /// Reports the user's own action, at the end of the status line only.
    pub(crate) fn report_own_action(&mut self, text: impl Into<String>) {
        self.add_hint(text);
        if let Some(notice) = self.all.last_mut() {
            notice.quiet = true;
        }
    }

    /// Shows a warning, such as why something cannot be done; it disappears by itself.
    pub(crate) fn add_warning(&mut self, text: impl Into<String>) {
        self.add_notice(NoticeKind::Warning, text.into(), None, false);
    }

    /// Shows a notice that stays.
    pub(crate) fn add_lasting_notice(&mut self, text: &str, remedy: Option<&str>) {
        let remedy = remedy.map(str::to_owned);
        self.add_notice(NoticeKind::Warning, text.to_owned(), remedy, true);
    }

    /// Shows a failure that stays, with commands that can help at once.
    pub(crate) fn offer_failure_remedies(
        &mut self,
        text: String,
        remedy: &str,
        offers: Vec<(InterfaceText, NoticeOffer)>,
    ) {
        self.add_notice(NoticeKind::Error, text, Some(remedy.to_owned()), true);
        if let Some(notice) = self.all.last_mut() {
            notice.offers = offers;
        }
    }

    /// Removes the notices that offer commands.
    pub(crate) fn withdraw_offers(&mut self) {
        self.all.retain(|notice| notice.offers.is_empty());
    }

    /// Reports a failure, and the remedy.
    pub(crate) fn report_work_failure(
        &mut self,
        error: &CorpusError,
        task: Option<InterfaceText>,
        language: InterfaceLanguage,
    ) {
        if matches!(error, CorpusError::Stopped) {
            self.add_hint(words::STOPPED.text_in_language(language));
            return;
        }
        let report = overlay_trouble::failure_report(error, task, language);
        self.all
            .retain(|notice| notice.detail != report.detail || report.detail.is_none());
        self.add_notice(NoticeKind::Error, report.text, report.remedy, true);
        if let Some(notice) = self.all.last_mut() {
            notice.detail = report.detail;
            notice.passes = matches!(
                error.database_failure_cause(),
                Some(DatabaseFailureCause::Full | DatabaseFailureCause::Busy)
            );
        }
    }

    /// Reports that the settings could not be written.
    pub(crate) fn report_unsaved_settings(&mut self, error: &dyn Display, language: InterfaceLanguage) {
        self.add_notice(
            NoticeKind::Error,
            words::SETTINGS_UNSAVED.text_in_language(language).to_owned(),
            Some(error.to_string()),
            true,
        );
    }

    /// Reports the outcome of work, if it is worth a notice.
    pub(crate) fn report_work_outcome(&mut self, outcome: &WorkOutcome, language: InterfaceLanguage) {
        // Notices that ask to look at something pass with the next change.
        let written = matches!(
            outcome,
            WorkOutcome::Annotated(_)
                | WorkOutcome::Changed
                | WorkOutcome::Imported(_)
                | WorkOutcome::Merged(_)
                | WorkOutcome::Adjudicated(_)
                | WorkOutcome::Planned(_)
                | WorkOutcome::AnswersImported(_)
                | WorkOutcome::Recombined(_)
                | WorkOutcome::Deleted(_)
                | WorkOutcome::Undone(_)
                | WorkOutcome::Redone(_)
                | WorkOutcome::Toured(_)
        );
        self.all.retain(|notice| !(written && notice.passes));
        let text = match outcome {
            WorkOutcome::Said(text) => text.clone(),
            WorkOutcome::Recombined(made) => fill_text_braces(
                words::NOTICE_STORED.text_in_language(language),
                &[("gloss", &made.gloss)],
            ),
            WorkOutcome::Deleted(done) => return self.deleted(done, language),
            WorkOutcome::Undone(row) => history_words::undo_sentence(&row.effect, language),
            WorkOutcome::Walked { back, steps } => {
                let text = if *back {
                    history_words::WALKED_BACK
                } else {
                    history_words::WALKED_FORWARD
                };
                fill_text_braces(text.text_in_language(language), &[("n", steps)])
            }
            WorkOutcome::Proposed(done) => return self.proposed(done, language),
            WorkOutcome::Fitted(report) => return self.report_fitted_body(report, language),
            WorkOutcome::Checked(report) => return self.report_corpus_check(report, language),
            WorkOutcome::Redone(row) => {
                let what = history_words::operation_sentence(&row.effect, language);
                fill_text_braces(history_words::DONE_AGAIN.text_in_language(language), &[("what", &what)])
            }
            WorkOutcome::Toured(report) if !report.dry_run => report.round_sentence(language),
            WorkOutcome::Exported(report) => super::overlay_export::written_text(report, language),
            WorkOutcome::Shared { title, path, notes } => {
                for sentence in notes {
                    self.add_lasting_notice(&translate_library_message(sentence, language), None);
                }
                let values: [(&str, &dyn Display); 2] = [("title", title), ("path", &path.display())];
                fill_text_braces(crate::words::stage_words::SHARED.text_in_language(language), &values)
            }
            _ => return,
        };
        self.add_hint(text);
    }

    /// Reports what was proposed, with the corpus's notes on what was not.
    fn proposed(&mut self, done: &ProposalResult, language: InterfaceLanguage) {
        let values: [(&str, &dyn Display); 2] = [("tokens", &done.tokens), ("unread", &done.unread)];
        match (done.tokens, done.unread) {
            (0, 0) => {
                let remedy = words::NOTICE_NO_SIGNS_REMEDY.text_in_language(language);
                self.add_lasting_notice(words::NOTICE_NO_SIGNS.text_in_language(language), Some(remedy));
            }
            (0, _) => self.add_lasting_notice(
                &fill_text_braces(words::NOTICE_NOT_PROPOSED.text_in_language(language), &values),
                None,
            ),
            _ => self.add_hint(fill_text_braces(
                words::NOTICE_PROPOSED.text_in_language(language),
                &values,
            )),
        }
        for finding in &done.findings {
            self.add_lasting_notice(&translate_library_message(finding, language), None);
        }
    }

    /// Reports a body that was fitted to markers, with the corpus's warnings about it.
    fn report_fitted_body(&mut self, report: &FitReport, language: InterfaceLanguage) {
        let markers = match &report.subject {
            Some(subject) => format!("{} ({subject})", report.markers),
            None => report.markers.clone(),
        };
        let mm = format!("{:.0}", report.median_mm);
        let values: [(&str, &dyn Display); 3] = [("markers", &markers), ("n", &report.frames), ("mm", &mm)];
        self.add_hint(fill_text_braces(
            words::NOTICE_FITTED.text_in_language(language),
            &values,
        ));
        for finding in &report.findings {
            self.add_lasting_notice(&translate_library_message(finding, language), None);
        }
    }

    /// Reports a deletion, and offers to undo it.
    fn deleted(&mut self, done: &DeletionReport, language: InterfaceLanguage) {
        if done.dry_run {
            return;
        }
        let names = vec![done.summary.clone()];
        self.add_hint(history_words::operation_sentence(
            &OperationEffect::Delete { names },
            language,
        ));
        if let Some(notice) = self.all.last_mut() {
            notice.offers = vec![(Action::Undo.action_row().name, NoticeOffer::Do(Action::Undo))];
        }
    }

    /// Reports the results of a check: faults with their places and remedies, which stay until they are dismissed.
    fn report_corpus_check(&mut self, report: &CheckReport, language: InterfaceLanguage) {
        if report.ok && report.mended.is_empty() && report.questions.is_empty() {
            return self.add_hint(words::CHECKED_WELL.text_in_language(language));
        }
        let (text, n) = match (report.ok, report.mended.len()) {
            (false, _) => (words::CHECKED_FAULTS, report.faults.len()),
            (true, 0) => (words::CHECKED_WELL, 0),
            (true, mended) => (words::CHECKED_MENDED, mended),
        };
        self.add_lasting_notice(&fill_text_braces(text.text_in_language(language), &[("n", &n)]), None);
        if let (false, Some(notice)) = (report.ok, self.all.last_mut()) {
            notice.kind = NoticeKind::Error;
        }
        let faults = report.all_findings();
        let spoken_text = |text: &String| translate_library_message(text, language);
        let faults = faults.map(|fault| {
            let message = spoken_text(&fault.message);
            match window_remedy::window_remedy_text(&fault.remedy, language) {
                Some(remedy) => format!("{}: {message} ({remedy})", fault.place),
                None => format!("{}: {message}", fault.place),
            }
        });
        let lines: Vec<String> = report.mended.iter().map(spoken_text).chain(faults).collect();
        if let Some(notice) = self.all.last_mut() {
            notice.detail = Some(lines.join("\n"));
        }
    }

    pub(crate) fn dismiss_notice(&mut self, id: u64) {
        self.all.retain(|notice| notice.id != id);
    }

    /// Removes the newest notice that stays, if Escape was pressed and nothing else took it.
    pub(crate) fn take_escape(&mut self, ctx: &Context) {
        let may_close = std::mem::take(&mut self.may_close);
        let newest = self.all.iter().rposition(|notice| notice.stays);
        if let Some(newest) = newest.filter(|_| may_close && super::take_escape_key(ctx)) {
            self.all.remove(newest);
        }
    }

    fn add_notice(&mut self, kind: NoticeKind, text: String, remedy: Option<String>, stays: bool) {
        self.all.retain(|notice| {
            // A hint replaces the hint before it; a notice that must be dismissed stays.
            notice.text != text && (stays || notice.stays || notice.since.is_none())
        });
        self.next += 1;
        self.all.push(WindowNotice {
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
        while self.all.len() > MAX_SHOWN_NOTICES {
            self.all.remove(0);
        }
    }

    /// Shows the newest hint at the end of the status line, if there is room for it; a report of the user's own
    /// action is cut short.
    pub(crate) fn show_status_hint(&mut self, ui: &mut Ui, language: InterfaceLanguage) {
        self.in_line = None;
        let Some(notice) = self
            .all
            .iter()
            .rev()
            .find(|notice| !notice.stays && notice.offers.is_empty())
        else {
            return;
        };
        let font = TextStyle::Body.resolve(ui.style());
        let strong = ui.visuals().strong_text_color();
        let text = notice.text.replace('`', "");
        let mut job = LayoutJob::simple_singleline(text, font, strong);
        let room = ui.available_width() - NOTICE_MARK_SIDE - 24.0;
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
            let label_response = ui.add(Label::new(galley));
            label_response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
            label_response.on_hover_text(&label);
            paint_notice_mark(ui, kind, language);
        });
    }

    pub(crate) fn ui(&mut self, ctx: &Context, language: InterfaceLanguage, out: &CommandOutbox) {
        let now = ctx.input(|input| input.time);
        for notice in &mut self.all {
            // A notice that came between two frames lasts from the first frame that shows it.
            notice.since.get_or_insert(now);
        }
        let old = |notice: &WindowNotice| {
            let shown = if notice.offers.is_empty() {
                HINT_SECONDS
            } else {
                COMMAND_HINT_SECONDS
            };
            !notice.stays && notice.since.is_some_and(|since| now - since > shown)
        };
        self.all.retain(|notice| !old(notice));
        if self.all.is_empty() {
            return;
        }
        // Without a frame nothing would take old notices away.
        ctx.request_repaint_after(std::time::Duration::from_millis(500));
        let in_line = self.in_line;
        let elsewhere = |notice: &&WindowNotice| Some(notice.id) != in_line && !notice.quiet;
        if !self.all.iter().any(|notice| elsewhere(&notice)) {
            return;
        }
        let area = Area::new(Id::unique("notices"))
            .order(Order::Foreground)
            .anchor(Align2::RIGHT_BOTTOM, vec2(-16.0, -44.0));
        area.show(ctx, |ui| {
            ui.set_max_width(MAX_NOTICE_WIDTH);
            for notice in self.all.iter().filter(elsewhere) {
                Frame::popup(ui.style()).show(ui, |ui| {
                    ui.horizontal(|ui| {
                        paint_notice_mark(ui, notice.kind, language);
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
                            if ui.button(text.text_in_language(language)).clicked() {
                                out.send_command(offer.offered_command());
                            }
                        }
                        if notice.stays && ui.button(words::CLOSE.text_in_language(language)).clicked() {
                            out.send_command(WindowCommand::Dismiss(notice.id));
                        }
                    });
                });
            }
        });
    }
}

/// The largest width of a notice, in points.
const MAX_NOTICE_WIDTH: f32 = 420.0;
/// The side of a notice's mark, in points.
const NOTICE_MARK_SIDE: f32 = 14.0;

/// Paints the mark of a notice's kind: a tick in a disc, an exclamation mark in a triangle, or a cross in a square.
fn paint_notice_mark(ui: &mut Ui, kind: NoticeKind, language: InterfaceLanguage) {
    let colours = ThemeColours::colours_for_theme(theme::is_dark(ui.ctx()));
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(NOTICE_MARK_SIDE), Sense::hover());
    let name = kind.notice_kind_name().text_in_language(language);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    let (centre, colour) = (rect.center(), kind.notice_kind_colour(colours));
    let ink = Stroke::new(1.8, ui.visuals().panel_fill);
    let painter = ui.painter();
    let point = |x: f32, y: f32| centre + vec2(x, y);
    match kind {
        NoticeKind::Done => {
            painter.circle_filled(centre, 6.5, colour);
            painter.line_segment([point(-3.0, 0.2), point(-0.8, 2.6)], ink);
            painter.line_segment([point(-0.8, 2.6), point(3.2, -2.4)], ink);
        }
        NoticeKind::Warning => {
            let points = vec![point(0.0, -6.5), point(7.0, 6.0), point(-7.0, 6.0)];
            painter.add(Shape::convex_polygon(points, colour, Stroke::NONE));
            painter.line_segment([point(0.0, -2.6), point(0.0, 1.8)], ink);
            painter.line_segment([point(0.0, 3.2), point(0.0, 4.8)], ink);
        }
        NoticeKind::Error => {
            painter.rect_filled(rect.shrink(0.5), 2.0, colour);
            painter.line_segment([point(-3.0, -3.0), point(3.0, 3.0)], ink);
            painter.line_segment([point(-3.0, 3.0), point(3.0, -3.0)], ink);
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
    let fonts = [TextStyle::Body, TextStyle::Monospace].map(|text_style| text_style.resolve(style));
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
        let mut notices = NoticeBoard::default();
        notices.offer_failure_remedies("long words ".repeat(60), &"and more ".repeat(60), Vec::new());
        let mut window = egui_kittest::Harness::builder()
            .with_size(vec2(640.0, 420.0))
            .build_ui_state(
                |ui, notices: &mut NoticeBoard| {
                    let out = CommandOutbox::default();
                    notices.ui(ui.ctx(), InterfaceLanguage::English, &out);
                },
                notices,
            );
        window.run_steps(3);
        use egui_kittest::kittest::Queryable;
        for label in ["long words", "and more"] {
            let found = window.get_by_label_contains(label).rect();
            assert!(
                found.left() >= 0.0 && found.width() < MAX_NOTICE_WIDTH,
                "{label}: {found}"
            );
        }
    }

    #[test]
    fn escape_closes_one_notice_that_stays_if_nothing_else_takes_it() {
        use eframe::egui::{Event, Key, Modifiers, RawInput};
        let mut notices = NoticeBoard::default();
        notices.add_lasting_notice("one", None);
        notices.add_lasting_notice("two", None);
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
        let mut notices = NoticeBoard::default();
        let well = CheckReport {
            ok: true,
            ..CheckReport::default()
        };
        notices.report_work_outcome(&WorkOutcome::Checked(well.clone()), InterfaceLanguage::English);
        assert!(!notices.all[0].stays);
        let faulty = CheckReport {
            ok: false,
            faults: vec![chereme_corpus::CorpusFault {
                kind: "block",
                place: "block 7".into(),
                message: "it is another".into(),
                remedy: "import again".into(),
            }],
            ..well
        };
        notices.report_work_outcome(&WorkOutcome::Checked(faulty), InterfaceLanguage::English);
        let notice = notices.all.last().expect("a notice");
        assert!(notice.stays && notice.text == "Checked, and faults found: 1");
        let detail = notice.detail.as_deref();
        assert_eq!(detail, Some("block 7: it is another (import again)"));
    }

    #[test]
    fn proposals_without_signs_and_signs_that_cannot_be_read_are_reported_apart() {
        for (unread, want) in [(0, words::NOTICE_NO_SIGNS), (3, words::NOTICE_NOT_PROPOSED)] {
            let mut notices = NoticeBoard::default();
            let proposed = ProposalResult {
                unread,
                ..ProposalResult::default()
            };
            notices.report_work_outcome(&WorkOutcome::Proposed(proposed), InterfaceLanguage::English);
            let notice = notices.all.last().expect("a notice");
            let want = fill_text_braces(
                want.text_in_language(InterfaceLanguage::English),
                &[("unread", &unread)],
            );
            assert_eq!((&notice.text, notice.remedy.is_some()), (&want, unread == 0));
        }
    }

    #[test]
    fn notes_on_what_was_not_proposed_stay_in_both_languages() {
        let finding = "handshapes are not proposed where fingers rest throughout, as nobody captured them: chat";
        for (tokens, language, start) in [
            (1, InterfaceLanguage::English, "handshapes are not proposed"),
            (1, InterfaceLanguage::French, "les configurations ne sont pas proposées"),
            (0, InterfaceLanguage::English, "handshapes are not proposed"),
        ] {
            let mut notices = NoticeBoard::default();
            let proposed = ProposalResult {
                tokens,
                unread: 1 - tokens,
                findings: vec![finding.to_owned()],
                ..ProposalResult::default()
            };
            notices.report_work_outcome(&WorkOutcome::Proposed(proposed), language);
            assert_eq!(notices.all.len(), 2, "{tokens}");
            let notice = &notices.all[1];
            assert!(notice.stays && notice.text.starts_with(start), "{}", notice.text);
            assert!(notice.text.ends_with(": chat"), "{}", notice.text);
        }
    }

    #[test]
    fn an_error_is_shown_once_with_its_remedy() {
        let mut notices = NoticeBoard::default();
        let error = || CorpusError::from_wrong_message("no").with_advice("yes");
        notices.report_work_failure(&error(), None, InterfaceLanguage::French);
        notices.report_work_failure(&error(), None, InterfaceLanguage::French);
        assert_eq!(notices.all.len(), 1);
        assert_eq!(notices.all[0].detail.as_deref(), Some("no\n(yes)"));
        notices.report_work_failure(&CorpusError::Stopped, None, InterfaceLanguage::English);
        assert!(!notices.all[1].stays);
        for at in 0..9 {
            notices.add_hint(at.to_string());
        }
        assert_eq!(notices.all.len(), MAX_SHOWN_NOTICES);
    }

    #[test]
    fn notices_name_the_operation_and_differ_by_kind() {
        let mut notices = NoticeBoard::default();
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
                WorkOutcome::Undone(row(AnnotationDeed::AnnotationsRemoved { count: 3 })),
                "3 annotations restored in Un",
            ),
            (
                WorkOutcome::Redone(row(AnnotationDeed::AnnotationsValued {
                    count: 3,
                    of: ValuedThing::Handshape,
                    value: "U".into(),
                })),
                "Done again: 3 handshapes changed to U in Un",
            ),
        ] {
            notices.report_work_outcome(&outcome, InterfaceLanguage::English);
            let last = notices.all.last().expect("a notice");
            assert_eq!((last.text.as_str(), last.kind), (want, NoticeKind::Done));
        }
        notices.add_warning("no");
        assert_eq!(notices.all.last().map(|it| it.kind), Some(NoticeKind::Warning));
        notices.report_work_failure(&CorpusError::from_wrong_message("no"), None, InterfaceLanguage::English);
        assert_eq!(notices.all.last().map(|it| it.kind), Some(NoticeKind::Error));
        for dark in [false, true] {
            let colours = ThemeColours::colours_for_theme(dark);
            let all =
                [NoticeKind::Done, NoticeKind::Warning, NoticeKind::Error].map(|it| it.notice_kind_colour(colours));
            assert!(all[0] != all[1] && all[1] != all[2] && all[0] != all[2]);
        }
        notices.offer_failure_remedies(
            "gone".into(),
            "copy",
            vec![(words::SAVE_COPY, NoticeOffer::Do(Action::Undo))],
        );
        notices.withdraw_offers();
        assert!(notices.all.iter().all(|it| it.text != "gone"));
    }
}
