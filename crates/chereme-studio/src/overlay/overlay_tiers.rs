//! The window for work on the tiers of many recordings: it shows what the work would do, and carries it out as one step.

use chereme_corpus::words::counted_in;
use chereme_corpus::{CorpusError, TierRoundOptions, TierRoundReport, TierRoundRow, TierStereotype};
use eframe::egui::{Button, Checkbox, Context, Grid, Label, RichText, Role, ScrollArea, TextStyle, Ui, WidgetInfo};

use super::tier_round_form::{RoundRecordings, RoundWorkKind, TierRoundForm, TierTextProperty};
use crate::context::PaneInput;
use crate::panes::show_running_work;
use crate::panes::timeline::tier_box::{
    how_text, possible_tier_roles, show_copied_choice, show_tier_drop_down, tier_hand_choices,
};
use crate::script::script_edit;
use crate::window_remedy::ShownFailure;
use crate::words::{InterfaceText, fill_text_braces, tier_round_words as words, timeline, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, editing};

/// The greatest height of a list of recordings, in points.
const LIST_HEIGHT_POINTS: f32 = 132.0;
const FIELD_WIDTH_POINTS: f32 = 250.0;

/// A dry run: the form, the corpus generation that it was tried on, and its report.
struct TriedRound {
    form: TierRoundForm,
    generation: i64,
    report: TierRoundReport,
}

/// The window.
#[derive(Default)]
pub(crate) struct TierRoundWindow {
    open: bool,
    form: TierRoundForm,
    /// Whether recordings that refuse are left out.
    skip: bool,
    /// The requested work, and the form and generation that it is for.
    asked: Option<(WorkId, TierRoundForm, i64)>,
    tried: Option<TriedRound>,
    done: Option<TierRoundReport>,
    failure: Option<ShownFailure>,
    stopped: bool,
}

impl TierRoundWindow {
    pub(crate) fn toggle_tier_round_window(&mut self) {
        self.open = !self.open;
        self.forget_result();
    }

    fn forget_result(&mut self) {
        (self.tried, self.done, self.failure, self.stopped) = (None, None, None, false);
    }

    pub(crate) fn handle_tier_round_result(&mut self, id: WorkId, ended: &WorkResult) {
        let Some((_, form, generation)) = self.asked.take_if(|(asked, ..)| *asked == id) else {
            return;
        };
        match ended {
            Ok(WorkOutcome::Toured(report)) if report.dry_run => {
                let mut report = report.clone();
                // Refusals are what the user has to decide about.
                report.recordings.sort_by_key(|row| row.refused.is_none());
                self.tried = Some(TriedRound {
                    form,
                    generation,
                    report,
                });
            }
            Ok(WorkOutcome::Toured(report)) => self.done = Some(report.clone()),
            Ok(_) => {}
            Err(CorpusError::Stopped) => self.stopped = true,
            Err(error) => self.failure = Some(ShownFailure::from_error(error)),
        }
    }

    pub(crate) fn ui(&mut self, ctx: &Context, seen: &PaneInput<'_>) {
        if !self.open {
            return;
        }
        let open = super::show_form_window(ctx, seen.say_text(words::TITLE), "tier rounds", |ui| {
            show_recordings(ui, seen, &mut self.form);
            ui.add_space(6.0);
            show_work(ui, seen, &mut self.form);
            ui.add_space(6.0);
            self.show_buttons(ui, seen);
            self.show_result(ui, seen);
        });
        self.open = open && !(self.asked.is_none() && super::take_escape_key(ctx));
    }

    /// Returns the dry run, if it is one of the present form and corpus.
    fn valid_trial(&self, seen: &PaneInput<'_>) -> Option<&TierRoundReport> {
        let generation = seen.snapshot.overview.generation;
        let tried = self.tried.as_ref()?;
        (tried.form == self.form && tried.generation == generation).then_some(&tried.report)
    }

    fn show_buttons(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.checkbox(&mut self.skip, seen.say_text(words::SKIP));
        let (changing, refusing) = self.valid_trial(seen).map_or((0, 0), count_outcomes);
        let is_ready = self.form.round_scope().is_some() && self.form.round_work().is_some();
        let may_do = changing > 0 && (refusing == 0 || self.skip) && !seen.snapshot.is_read_only();
        let mut pressed = None;
        ui.horizontal(|ui| {
            if show_running_work(ui, seen, self.asked.as_ref().map(|(id, ..)| *id)) {
                return;
            }
            for (text, is_enabled, dry_run) in [(words::TRY, is_ready, true), (words::CARRY_OUT, may_do, false)] {
                let button = Button::new(RichText::new(seen.say_text(text)).strong());
                if ui.add_enabled(is_enabled, button).clicked() {
                    pressed = Some(dry_run);
                }
            }
        });
        if let (Some(dry_run), Some(scope), Some(work)) = (pressed, self.form.round_scope(), self.form.round_work()) {
            let options = TierRoundOptions {
                dry_run,
                skip: self.skip,
            };
            let id = seen.request_work(editing::work_on_tiers_job(scope, work, options));
            let generation = seen.snapshot.overview.generation;
            self.asked = Some((id, self.form.clone(), generation));
            self.forget_result();
        }
    }

    /// Shows what the work would do or did, or why it cannot be done.
    fn show_result(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let colours = seen.pane_colours();
        if let Some(failure) = &self.failure {
            failure.show_failure(ui, seen.language, colours.trouble);
        }
        if self.stopped {
            ui.label(seen.say_text(words::STOPPED));
        }
        if let Some(report) = &self.done {
            let text = report.round_sentence(seen.language);
            ui.label(RichText::new(text).color(colours.good));
            show_rows(ui, seen, report);
        }
        let Some(report) = self.valid_trial(seen) else {
            return;
        };
        let (changing, refusing) = count_outcomes(report);
        let would = fill_text_braces(
            seen.say_text(words::WOULD),
            &[("n", &changing), ("refusing", &refusing), ("same", &report.untouched)],
        );
        ui.strong(would);
        if report.only_with_tokens {
            ui.label(seen.say_text(words::ONLY_WITH_TOKENS));
        }
        if refusing > 0 && !self.skip {
            ui.label(RichText::new(seen.say_text(words::REFUSED)).color(colours.trouble));
        }
        show_rows(ui, seen, report);
    }
}

/// Returns how many recordings change, and how many refuse.
fn count_outcomes(report: &TierRoundReport) -> (usize, usize) {
    let refusing = report.recordings.iter().filter(|row| row.refused.is_some()).count();
    (report.recordings.len() - refusing, refusing)
}

fn show_rows(ui: &mut Ui, seen: &PaneInput<'_>, report: &TierRoundReport) {
    let high = ui.text_style_height(&TextStyle::Small);
    let area = ScrollArea::vertical()
        .auto_shrink([false, true])
        .id_salt("rows")
        .max_height(LIST_HEIGHT_POINTS)
        .min_scrolled_height(LIST_HEIGHT_POINTS);
    area.show_rows(ui, high, report.recordings.len(), |ui, range| {
        for row in &report.recordings[range] {
            let text = RichText::new(round_row_text(row, seen)).small();
            let text = match row.refused {
                Some(_) => text.color(seen.pane_colours().trouble),
                None => text,
            };
            ui.add(Label::new(text).truncate());
        }
    });
}

fn round_row_text(row: &TierRoundRow, seen: &PaneInput<'_>) -> String {
    match &row.refused {
        Some(why) => {
            let why = translate_library_message(why, seen.language);
            fill_text_braces(seen.say_text(words::REFUSES), &[("name", &row.name), ("why", &why)])
        }
        None => {
            let annotations = counted_in(row.annotations, "annotations", seen.language);
            let tiers = row.tiers.join(", ");
            fill_text_braces(
                seen.say_text(words::ROW),
                &[("name", &row.name), ("tiers", &tiers), ("annotations", &annotations)],
            )
        }
    }
}

/// Shows the choice of recordings.
fn show_recordings(ui: &mut Ui, seen: &PaneInput<'_>, form: &mut TierRoundForm) {
    let recordings = &seen.snapshot.overview.recordings;
    ui.label(RichText::new(seen.say_text(words::RECORDINGS)).small());
    let counted = |text: InterfaceText, n: usize| fill_text_braces(seen.say_text(text), &[("n", &n)]);
    let choices = [
        (RoundRecordings::All, counted(words::EVERY, recordings.len())),
        (RoundRecordings::Found, seen.say_text(words::FOUND).to_owned()),
        (RoundRecordings::Named, seen.say_text(words::NAMED).to_owned()),
        (RoundRecordings::Ticked, counted(words::TICKED, form.ticked.len())),
    ];
    for (choice, text) in choices {
        ui.radio_value(&mut form.recordings, choice, text);
        if form.recordings != choice {
            continue;
        }
        match choice {
            RoundRecordings::All => {}
            RoundRecordings::Found => named_line(ui, seen, words::QUERY, words::QUERY_HINT, &mut form.query),
            RoundRecordings::Named => named_line(ui, seen, words::PATTERN, words::PATTERN_HINT, &mut form.pattern),
            RoundRecordings::Ticked => {
                let high = ui.spacing().interact_size.y;
                let area = ScrollArea::vertical()
                    .auto_shrink([false, true])
                    .id_salt("ticked")
                    .max_height(LIST_HEIGHT_POINTS)
                    .min_scrolled_height(LIST_HEIGHT_POINTS);
                area.show_rows(ui, high, recordings.len(), |ui, range| {
                    for glance in &recordings[range] {
                        let mut is_ticked = form.ticked.contains(&glance.row.id);
                        if ui.add(Checkbox::new(&mut is_ticked, &glance.row.name)).changed() {
                            match is_ticked {
                                true => form.ticked.insert(glance.row.id),
                                false => form.ticked.remove(&glance.row.id),
                            };
                        }
                    }
                });
            }
        }
    }
}

/// Shows a line of text with its name before it.
fn named_line(ui: &mut Ui, seen: &PaneInput<'_>, name: InterfaceText, hint: InterfaceText, text: &mut String) {
    ui.horizontal(|ui| {
        ui.add_space(20.0);
        field_line(ui, seen, name, Some(hint), text);
    });
}

/// Shows a name, and a line of text that it labels.
fn field_line(ui: &mut Ui, seen: &PaneInput<'_>, name: InterfaceText, hint: Option<InterfaceText>, text: &mut String) {
    let label = ui.label(seen.say_text(name));
    let hint = hint.map_or("", |hint| seen.say_text(hint));
    let width = FIELD_WIDTH_POINTS.min(ui.available_width());
    let line = script_edit::draw_text_line(ui, text, |field| field.hint_text(hint).desired_width(width));
    line.response.response.labelled_by(label.id);
}

/// Shows the choice of the work, and the fields of its kind.
fn show_work(ui: &mut Ui, seen: &PaneInput<'_>, form: &mut TierRoundForm) {
    form.like = seen.shown.recording;
    let grid = Grid::new("tier round form").num_columns(2).spacing([12.0, 6.0]);
    grid.show(ui, |ui| {
        let kinds = RoundWorkKind::ALL_ROUND_WORK_KINDS.map(|(kind, text)| (kind, seen.say_text(text).to_owned()));
        let now = kinds.iter().find(|(kind, _)| *kind == form.kind);
        let now = now.map_or(String::new(), |(_, text)| text.clone());
        show_tier_drop_down(ui, seen.say_text(words::WORK), &now, &kinds, |kind| form.kind = *kind);
        let line = |ui: &mut Ui, name, hint, text: &mut String| {
            field_line(ui, seen, name, hint, text);
            ui.end_row();
        };
        match form.kind {
            RoundWorkKind::AddUsual | RoundWorkKind::AddLike => {}
            RoundWorkKind::Add => line(ui, timeline::TIER_NAME, None, &mut form.name),
            RoundWorkKind::Change => {
                line(ui, words::TIER, Some(words::TIER_HINT), &mut form.tier);
                line(ui, words::NEW_NAME, Some(words::KEPT), &mut form.name);
            }
            RoundWorkKind::Copy => {
                line(ui, words::TIER, Some(words::TIER_HINT), &mut form.tier);
                line(ui, words::COPY_NAME, None, &mut form.name);
                show_copied_choice(ui, seen, &mut form.copied);
            }
            RoundWorkKind::Remove => line(ui, words::TIER, Some(words::TIER_HINT), &mut form.tier),
            RoundWorkKind::Shift => {
                line(ui, words::SHIFTED, Some(words::SHIFTED_HINT), &mut form.tier);
                line(ui, words::SECONDS, None, &mut form.seconds);
            }
        }
        if matches!(form.kind, RoundWorkKind::Add | RoundWorkKind::Change) {
            show_tier_properties(ui, seen, form);
        }
    });
}

/// Shows the properties of new tiers, or those that tiers get; the first choice of a list changes nothing.
fn show_tier_properties(ui: &mut Ui, seen: &PaneInput<'_>, form: &mut TierRoundForm) {
    let is_change = form.kind == RoundWorkKind::Change;
    let kept = || (None, seen.say_text(words::KEPT).to_owned());
    let roles = possible_tier_roles(seen)
        .into_iter()
        .map(|(role, text)| (Some(role), text));
    let roles: Vec<(Option<String>, String)> = is_change.then(kept).into_iter().chain(roles).collect();
    let hands = tier_hand_choices(seen)
        .into_iter()
        .map(|(hand, text)| (Some(hand), text));
    let hands: Vec<_> = is_change.then(|| (None, kept().1)).into_iter().chain(hands).collect();
    // A choice that the list of this kind of work does not have becomes its first.
    if !roles.iter().any(|(role, _)| *role == form.role) {
        form.role = roles.first().and_then(|(role, _)| role.clone());
    }
    if !hands.iter().any(|(hand, _)| *hand == form.hand) {
        form.hand = hands.first().and_then(|(hand, _)| *hand);
    }
    show_choice(ui, seen, timeline::TIER_ROLE, &mut form.role, &roles);
    show_choice(ui, seen, timeline::TIER_HAND, &mut form.hand, &hands);
    if !is_change {
        field_line(ui, seen, words::PARENT, None, &mut form.parent);
        ui.end_row();
        if !form.parent.trim().is_empty() {
            let relations = TierStereotype::ALL_TIER_STEREOTYPES.map(|how| (how, how_text(how, seen)));
            show_choice(ui, seen, timeline::TIER_HOW, &mut form.how, &relations);
        }
    }
    for (name, property) in [
        (words::PARTICIPANT, &mut form.participant),
        (words::ANNOTATOR, &mut form.annotator),
        (words::LANGUAGE, &mut form.language),
    ] {
        show_text_property(ui, seen, name, is_change, property);
    }
}

fn show_choice<T: Clone + PartialEq>(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: InterfaceText,
    value: &mut T,
    all: &[(T, String)],
) {
    let entry = all.iter().find(|(choice, _)| choice == value);
    let now = entry.map_or(String::new(), |(_, text)| text.clone());
    show_tier_drop_down(ui, seen.say_text(name), &now, all, |choice| value.clone_from(choice));
}

/// Shows a text of a tier; a change has a mark before it, without which the text stays as it is.
fn show_text_property(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: InterfaceText,
    is_change: bool,
    property: &mut TierTextProperty,
) {
    let label = seen.say_text(name);
    if is_change {
        let text = fill_text_braces(seen.say_text(words::CHANGES_TEXT), &[("field", &label)]);
        ui.checkbox(&mut property.is_changed, text);
        let width = FIELD_WIDTH_POINTS.min(ui.available_width());
        let before = property.text.clone();
        let hint = seen.say_text(if property.is_changed {
            words::REMOVED
        } else {
            words::KEPT
        });
        let line = script_edit::draw_text_line(ui, &mut property.text, |field| {
            field.hint_text(hint).desired_width(width)
        });
        property.is_changed |= property.text != before;
        let response = line.response.response;
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
    } else {
        field_line(ui, seen, name, None, &mut property.text);
    }
    ui.end_row();
}
