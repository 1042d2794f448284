//! Recombination: a recipe as text and as a stack of cards, evaluated while it changes, stored as a new sign.

mod cards;
mod catalogue;
mod live;
mod operators;
mod recombine_face;
mod recombine_fields;
mod recombine_path;
mod recombine_report;
mod recombine_settings;
mod recombine_steps;
mod recombine_store;
mod recombine_suggest;
mod spots;
pub(crate) mod stack;

use std::sync::Arc;

use chereme_corpus::recipe::{PlacementGoal, Recipe, RecipeError, RecipeLength, RecipeNode, Step};
use chereme_corpus::{CorpusOverview, OperationRow, RecombinationResult};
use eframe::egui::{Button, CollapsingHeader, Frame, Id, Panel, RichText, ScrollArea, Ui};

use super::{ActionOutcome, PaneInterface, carry};
use crate::action::Action;
use crate::command::{DraggedToken, WindowCommand};
use crate::context::PaneInput;
use crate::model::generated::GeneratedClip;
use crate::model::model_handle::{PlacementHandle, TravelCourse};
use crate::script::script_edit;
use crate::words::{fill_text_braces, recombine_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult};
use live::RecipePreview;
pub(crate) use recombine_fields::{gloss_means_token, recipe_of, selected_token};
pub(crate) use recombine_path::{draw_on_stage, drawing_card_id, lengths_from_position, points_of_line};
use recombine_steps::StepHistory;
use stack::{CardContent, CardStack, RecipeCard};

/// Changes that follow each other within this time, in seconds, are one step of undo.
const UNDO_SETTLE_SECONDS: f64 = 0.4;

/// The pane.
#[derive(Default)]
pub(crate) struct RecombinePane {
    stack: CardStack,
    /// The recipe as typed; the cards show the same recipe if the text can be read.
    text: String,
    /// Why the text cannot be read.
    wrong: Option<String>,
    /// The card that keyboard actions apply to.
    chosen: Option<u64>,
    /// The card that takes the keyboard next.
    focus: Option<u64>,
    /// A card that was just added, whose first field takes the keyboard.
    fresh: Option<u64>,
    live: RecipePreview,
    suggest: recombine_suggest::ProposalList,
    gloss: String,
    /// The name of the stored sign whose recipe was opened.
    opened: Option<String>,
    storing: Option<WorkId>,
    /// The sign that was stored last.
    stored: Option<recombine_store::StoredSign>,
    /// Whether the stage shows the result instead of the recording.
    on_stage: bool,
    /// The movement that was last given to the stage.
    given: Option<Arc<RecombinationResult>>,
    come: bool,
    /// Whether the gloss takes the keyboard next.
    naming: bool,
    steps: StepHistory<RecipePage>,
    /// The recipe after the last step of undo.
    settled: RecipePage,
    /// The text after its last change, and the time of that change in seconds of the window's clock.
    changed: (String, f64),
}

/// The state of the recipe that undo restores.
#[derive(Debug, Clone, Default, PartialEq)]
struct RecipePage {
    stack: CardStack,
    text: String,
    opened: Option<String>,
    gloss: String,
}

/// Reads a recipe as text, or as JSON if it begins with a brace.
fn parse_recipe_text(text: &str) -> Result<Recipe, String> {
    if text.trim_start().starts_with('{') {
        return serde_json::from_str(text).map_err(|error| error.to_string());
    }
    text.parse().map_err(|error: RecipeError| match &error {
        RecipeError::Text(at) => {
            // The message shows the text at the error, so that nobody has to count letters.
            let start = at.at.saturating_sub(24);
            let letters = |from: usize, count: usize| -> String { at.text.chars().skip(from).take(count).collect() };
            let (before, after) = (letters(start, at.at - start), letters(at.at, 16));
            format!("… {before} ▸ {after}\n{}", at.problem)
        }
        _ => error.to_string(),
    })
}

impl RecombinePane {
    /// Opens a recipe; `opened` is the name of the stored sign that it comes from, if any.
    pub(crate) fn open_recipe_text(&mut self, recipe: &str, opened: Option<String>, gloss: Option<String>) {
        self.stack = CardStack::default();
        self.type_in(recipe.to_owned());
        self.live.reload_recipe_preview();
        self.opened = opened;
        self.gloss = gloss.unwrap_or_default();
        self.stored = None;
        self.chosen = None;
        self.on_stage = true;
    }

    fn current_recipe_page(&self) -> RecipePage {
        RecipePage {
            stack: self.stack.clone(),
            text: self.text.clone(),
            opened: self.opened.clone(),
            gloss: self.gloss.clone(),
        }
    }

    /// Makes the changes since the last step one step of undo.
    fn settle_recipe_changes(&mut self) {
        let same = self.settled.text == self.text && self.settled.stack == self.stack;
        if !same {
            let page = self.current_recipe_page();
            let before = std::mem::replace(&mut self.settled, page.clone());
            self.steps.record_page_change(before, page);
        }
    }

    /// Counts the new operations on the corpus; unsettled changes of the recipe become a step before them.
    fn count_corpus_operations(&mut self, operations: &[OperationRow]) {
        if self.steps.is_behind(operations) {
            self.settle_recipe_changes();
            self.steps.count_new_operations(operations);
        }
    }

    /// Makes changes one step of undo when nothing is dragged or typed, and no change has followed for a while. Changes
    /// before a press of the mouse are a separate step.
    fn settle_in_time(&mut self, ui: &Ui) {
        let (now, held) = ui.input(|input| (input.time, input.pointer.any_down()));
        if ui.input(|input| input.pointer.any_pressed()) {
            self.settle_recipe_changes();
        }
        if self.changed.0 != self.text {
            self.changed = (self.text.clone(), now);
        }
        let rest = self.changed.1 + UNDO_SETTLE_SECONDS - now;
        if rest > 0.0 {
            let rest = std::time::Duration::from_secs_f64(rest);
            ui.ctx().request_repaint_after(rest);
        } else if !held && !ui.ctx().text_edit_focused() {
            self.settle_recipe_changes();
        }
    }

    /// Undoes or redoes a step of the recipe; returns whether a step of the recipe was next.
    pub(crate) fn walk_recipe_history(&mut self, back: bool, operations: &[OperationRow]) -> bool {
        self.count_corpus_operations(operations);
        self.settle_recipe_changes();
        let page = if back {
            self.steps.step_page_back()
        } else {
            self.steps.step_page_forward()
        };
        let Some(page) = page else { return false };
        self.settled = page.clone();
        RecipePage {
            stack: self.stack,
            text: self.text,
            opened: self.opened,
            gloss: self.gloss,
        } = page;
        true
    }

    /// Changes the goal of a card's placement.
    pub(crate) fn place_card_goal(&mut self, card: u64, goal: PlacementGoal) {
        if let Some(RecipeCard {
            what: CardContent::Step(Step::Place(place)),
            ..
        }) = self.stack.get_mut(card)
        {
            place.to = goal;
            self.follow_cards();
        }
    }

    /// Makes a card move the hands along a curve through points, given as lengths to the left, up and forward.
    pub(crate) fn set_travel_points(&mut self, card: u64, points: &[[RecipeLength; 3]]) {
        if let Some(RecipeCard {
            what: CardContent::Step(Step::Travel(travel)),
            ..
        }) = self.stack.get_mut(card)
        {
            travel.through = points.to_vec();
            travel.path.clear();
            self.follow_cards();
        }
    }

    /// Returns the path that can be pulled on the stage: that of the chosen card; while none is chosen, as after typing a
    /// recipe, the last one.
    fn chosen_hand_path(&self) -> Option<TravelCourse> {
        let made = self.live.made.is_some() && self.on_stage && self.wrong.is_none();
        let chosen = self.chosen.and_then(|card| self.stack.find_card_position(card));
        let is_path = |card: &stack::RecipeCard| matches!(card.what, CardContent::Step(Step::Travel(_)));
        let candidate_index = chosen.or_else(|| self.stack.stack_cards().iter().rposition(is_path));
        let card_index = candidate_index.filter(|_| made)?;
        let card = &self.stack.stack_cards()[card_index];
        let CardContent::Step(Step::Travel(travel)) = &card.what else {
            return None;
        };
        self.stack.is_card_used(card_index).then(|| TravelCourse {
            card: card.id,
            travel: travel.clone(),
        })
    }

    /// Returns the placement that can be dragged on the stage: that of the chosen card.
    fn chosen_placement_handle(&self) -> Option<PlacementHandle> {
        let made = self.live.made.is_some() && self.on_stage && self.wrong.is_none();
        let card = self.chosen.filter(|_| made)?;
        let card_index = self.stack.find_card_position(card)?;
        let CardContent::Step(Step::Place(place)) = &self.stack.stack_cards()[card_index].what else {
            return None;
        };
        let note = self.live.notes.get(&card);
        self.stack.is_card_used(card_index).then(|| PlacementHandle {
            card,
            hand: place.hand,
            to: place.to.clone(),
            moved: note.and_then(|note| note.moved),
        })
    }

    /// Adds a sign: to the chosen card, or any, that lacks one, else as a separate source.
    pub(crate) fn take_in(&mut self, carried: &DraggedToken, overview: &CorpusOverview) {
        let name = recombine_fields::recipe_token_address(overview, carried.token, &carried.gloss);
        let waiting = |card: &stack::RecipeCard| matches!(&card.what, CardContent::Source { node: RecipeNode::Sign(name), .. } if name.trim().is_empty());
        let cards = self.stack.stack_cards();
        let chosen = cards.iter().find(|card| Some(card.id) == self.chosen);
        let chosen_match = chosen.filter(|card| waiting(card));
        let waiting_card = chosen_match.or_else(|| cards.iter().find(|card| waiting(card)));
        match waiting_card.map(|card| card.id) {
            Some(id) => {
                if let Some(card) = self.stack.get_mut(id)
                    && let CardContent::Source { node, .. } = &mut card.what
                {
                    *node = RecipeNode::Sign(name);
                }
                (self.chosen, self.focus) = (Some(id), Some(id));
                self.follow_cards();
            }
            None if self.stack.is_empty() => self.open_recipe_text(&RecipeNode::Sign(name).to_string(), None, None),
            None => self.add_chosen_card(CardContent::source_with_default_transition(RecipeNode::Sign(name))),
        }
    }

    /// Returns whether the stage has not received the last result yet.
    pub(crate) fn has_news(&self) -> bool {
        self.live.has_news()
    }

    /// Evaluates the current recipe, and passes the result, its handle and its path to the stage; `now` is the time on
    /// the window's clock.
    pub(crate) fn keep_up(&mut self, seen: &PaneInput<'_>, now: f64) {
        let generation = seen.snapshot.overview.generation;
        if self.wrong.is_none() {
            let text = self.stack.used_recipe_text();
            self.live
                .evaluate_changed_recipe(&self.stack, &text, generation, now, seen.out);
        }
        self.show_on_stage(seen);
        let handle = self.chosen_placement_handle();
        if seen.shown.handle != handle {
            seen.send_command(WindowCommand::Handle(handle));
        }
        let course = self.chosen_hand_path();
        if seen.shown.course.as_deref() != course.as_ref() {
            seen.send_command(WindowCommand::Course(course.map(Box::new)));
        }
    }

    /// Passes the result to the stage, or returns the stage to the recording.
    fn show_on_stage(&mut self, seen: &PaneInput<'_>) {
        let made = self.live.made.as_ref().filter(|_| self.on_stage);
        let same = match (made, &self.given) {
            (Some(made), Some(given)) => Arc::ptr_eq(made, given),
            (None, None) => true,
            _ => false,
        };
        if same {
            // Any command that shows something in a recording ends the display of the result.
            if self.given.is_some() && seen.shown.made.is_none() {
                (self.given, self.on_stage) = (None, false);
            }
            return;
        }
        self.given = made.cloned();
        let shown = made.map(|made| Arc::new(GeneratedClip::clip_from_recipe_result(made)));
        seen.send_command(WindowCommand::Made(shown));
    }

    /// Sets the text to typed text; the cards follow if it can be read.
    fn type_in(&mut self, text: String) {
        self.text = text;
        if self.text.trim().is_empty() {
            self.stack = CardStack::default();
            self.wrong = None;
            return;
        }
        match parse_recipe_text(&self.text) {
            Ok(recipe) => {
                self.stack.replace_stack_recipe(&recipe);
                (self.wrong, self.on_stage) = (None, true);
            }
            Err(wrong) => self.wrong = Some(wrong),
        }
    }

    /// Updates the text after a change of the cards.
    fn follow_cards(&mut self) {
        self.wrong = None;
        self.on_stage = true;
        match self.stack.used_recipe() {
            Some(Ok(recipe)) => self.stack.replace_stack_recipe(&recipe),
            Some(Err(error)) => self.wrong = Some(error.to_string()),
            None => {}
        }
        self.text = self.stack.used_recipe_text();
    }

    /// Adds a card after the chosen one, and chooses it.
    fn add_chosen_card(&mut self, what: CardContent) {
        let after = self.chosen.filter(|_| !what.is_source());
        let id = self.stack.add_stack_card(after, what);
        (self.chosen, self.focus, self.fresh) = (id, id, id);
        self.follow_cards();
    }

    /// Carries out an action of keys or menus on a card.
    fn apply_card_action(&mut self, id: u64, action: Action) {
        let card_index = self.stack.find_card_position(id);
        match action {
            Action::CardUp => drop(self.stack.shift_stack_card(id, false)),
            Action::CardDown => drop(self.stack.shift_stack_card(id, true)),
            Action::CardSwitch => self.stack.switch_stack_card(id),
            Action::CardDuplicate => {
                let copy = self.stack.duplicate_stack_card(id);
                (self.chosen, self.focus) = (copy, copy);
            }
            Action::CardRemove => {
                self.stack.remove_stack_card(id);
                let last = self.stack.stack_cards().len().checked_sub(1);
                let next = last
                    .zip(card_index)
                    .map(|(last, at)| self.stack.stack_cards()[at.min(last)].id);
                (self.chosen, self.focus) = (next, next);
            }
            _ => {}
        }
        if matches!(action, Action::CardUp | Action::CardDown) {
            (self.chosen, self.focus) = (Some(id), Some(id));
        }
        self.follow_cards();
    }

    /// Returns the address of the sign that the stack begins with.
    fn stack_source_address(&self) -> Option<&str> {
        match &self.stack.stack_cards().first()?.what {
            CardContent::Source {
                node: RecipeNode::Sign(name),
                ..
            } if !name.trim().is_empty() => Some(name),
            _ => None,
        }
    }

    fn recipe_field(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let label_row = ui.horizontal(|ui| {
            let text = match &self.opened {
                Some(name) => fill_text_braces(seen.say_text(words::OPENED), &[("name", name)]),
                None => seen.say_text(words::RECIPE).to_owned(),
            };
            let label = ui.label(RichText::new(text).small()).id;
            if self.live.is_making() {
                ui.add(eframe::egui::Spinner::new().size(12.0));
            }
            if !self.stack.is_empty() && ui.small_button(seen.say_text(words::CLEAR)).clicked() {
                self.open_recipe_text("", None, None);
                self.come = true;
            }
            label
        });
        let label = label_row.inner;
        let mut text = self.text.clone();
        let rows = 1 + text.len() / 44;
        let field = script_edit::draw_text_block(ui, &mut text, |field| {
            field
                .id(Id::unique("recipe"))
                .hint_text(seen.say_text(words::HINT))
                .return_key(None)
                .desired_rows(rows.clamp(2, 5))
                .desired_width(f32::INFINITY)
        });
        let response = field.response.response.labelled_by(label);
        if std::mem::take(&mut self.come) {
            response.request_focus();
        }
        if response.changed() {
            // The same text pasted again is evaluated again, as its meaning may have changed.
            if text == self.text {
                self.live.reload_recipe_preview();
            }
            self.type_in(text);
        }
        if let Some(wrong) = &self.wrong {
            let wrong = RichText::new(wrong).small().color(seen.pane_colours().trouble);
            ui.label(wrong);
        }
    }

    /// Shows the page without a recipe.
    fn show_empty_recipe_page(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.add_space(8.0);
        ui.strong(seen.say_text(words::EMPTY));
        ui.label(seen.say_text(words::EMPTY_MORE));
        ui.add_space(4.0);
        if let Some((recipe, gloss)) = recombine_fields::selected_recipe(seen) {
            let text = fill_text_braces(seen.say_text(words::BEGIN_SELECTED), &[("gloss", &gloss)]);
            let button = ui.button(text);
            let key = seen.keys.action_keys_text(Action::RecombineSelected);
            if button.on_hover_text(key).clicked() {
                self.open_recipe_text(&recipe, None, None);
            }
        }
    }

    fn adding(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let mut wanted = None;
        ui.horizontal_wrapped(|ui| {
            if !self.stack.is_empty() {
                ui.menu_button(seen.say_text(words::ADD_OPERATOR), |ui| {
                    for (text, hint, step) in catalogue::list_recipe_operators() {
                        let button = Button::new(seen.say_text(text)).shortcut_text(seen.say_text(hint));
                        if ui.add(button).clicked() {
                            wanted = Some(CardContent::Step(step));
                            ui.close();
                        }
                    }
                });
            }
            let text = if self.stack.is_empty() {
                words::BEGIN_WITH
            } else {
                words::ADD_SOURCE
            };
            ui.menu_button(seen.say_text(text), |ui| {
                for (text, node) in catalogue::list_recipe_sources() {
                    if ui.button(seen.say_text(text)).clicked() {
                        wanted = Some(CardContent::source_with_default_transition(node));
                        ui.close();
                    }
                }
            });
        });
        if let Some(what) = wanted {
            self.add_chosen_card(what);
        }
    }
}

impl PaneInterface for RecombinePane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let pane_rect = ui.available_rect_before_wrap();
        if !self.stack.is_empty() {
            Panel::bottom("recombine-store")
                .frame(Frame::new().inner_margin(eframe::egui::Margin::symmetric(0, 6)))
                .show(ui, |ui| self.show_store_bar(ui, seen));
        }
        self.recipe_field(ui, seen);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if self.stack.is_empty() {
                self.show_empty_recipe_page(ui, seen);
            } else if cards::show_recipe_cards(self, ui, seen) {
                self.follow_cards();
            }
            self.adding(ui, seen);
            if let Some(trouble) = self.live.trouble.as_ref().filter(|trouble| trouble.card.is_none()) {
                ui.label(RichText::new(&trouble.text).color(seen.pane_colours().trouble));
            }
            if let Some(made) = self.live.made.clone().filter(|_| self.live.trouble.is_none()) {
                recombine_report::show_recipe_report(ui, seen, &made.report);
            }
            // An unfinished name has no suggestions.
            let is_sound = self.live.trouble.is_none();
            if let Some(source) = self.stack_source_address().filter(|_| is_sound).map(str::to_owned) {
                let name = match recombine_fields::gloss_of(seen, &source) {
                    Some(gloss) => gloss,
                    None => source.clone(),
                };
                let title = fill_text_braces(seen.say_text(words::SUGGEST), &[("sign", &name)]);
                let header = CollapsingHeader::new(title).id_salt("suggest");
                let shown = header.show(ui, |ui| self.suggest.show_recipe_proposals(ui, seen, &source));
                if let Some(chosen) = shown.body_returned.flatten() {
                    let opened = None;
                    self.open_recipe_text(&chosen.recipe, opened, chosen.gloss);
                }
            }
        });
        if let Some(carried) = carry::take_dropped_sign(ui, seen, pane_rect) {
            self.take_in(&carried, &seen.snapshot.overview);
        }
        self.naming = false;
        if let Some(thing) = recombine_fields::take_requested_details(ui) {
            seen.send_command(WindowCommand::Inspect(thing));
        }
        self.keep_up(seen, ui.input(|input| input.time));
        self.count_corpus_operations(&seen.snapshot.overview.operations);
        self.settle_in_time(ui);
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::CardUp | Action::CardDown | Action::CardDuplicate | Action::CardSwitch | Action::CardRemove => {
                match self.chosen {
                    Some(id) => {
                        self.apply_card_action(id, action);
                        ActionOutcome::Yes
                    }
                    None => ActionOutcome::Cannot(words::NEEDS_CARD),
                }
            }
            Action::StoreSign if self.stack.is_empty() => ActionOutcome::Cannot(words::NEEDS_RECIPE),
            Action::StoreSign => {
                (self.come, self.naming) = (false, true);
                ActionOutcome::Yes
            }
            Action::RecombineSelected => match recombine_fields::selected_recipe(seen) {
                Some((recipe, _)) => {
                    seen.send_command(WindowCommand::Recipe(recipe, None));
                    ActionOutcome::Yes
                }
                None => ActionOutcome::Cannot(crate::words::shell::NEEDS_ANNOTATION),
            },
            _ => ActionOutcome::No,
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.live.receive_preview_result(id, ended) {
            return;
        }
        self.suggest.receive_sign_suggestions(id, ended);
        if self.storing.take_if(|storing| *storing == id).is_some()
            && let Ok(WorkOutcome::Recombined(made)) = ended
        {
            self.stored = recombine_store::StoredSign::stored_from_recombination(made);
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_cards_stay_synchronised() {
        let mut pane = RecombinePane::default();
        pane.type_in("BOL|reverse".into());
        assert_eq!(pane.stack.stack_cards().len(), 2);
        assert_eq!(pane.text, "BOL|reverse", "what is typed stays as it is");
        pane.type_in("BOL|revers".into());
        assert!(pane.wrong.as_ref().is_some_and(|it| it.contains("reverse")));
        assert_eq!(pane.stack.used_recipe_text(), "BOL | reverse", "the cards stay");
        let id = pane.stack.stack_cards()[1].id;
        pane.apply_card_action(id, Action::CardDuplicate);
        assert_eq!(pane.text, "BOL | reverse | reverse");
        assert!(pane.wrong.is_none());
        pane.apply_card_action(id, Action::CardRemove);
        assert_eq!(pane.text, "BOL | reverse");
        assert!(pane.focus.is_some());
        pane.type_in(String::new());
        assert!(pane.stack.is_empty());
        pane.type_in(r#"{"version": 1, "make": {"sign": "BOL"}}"#.into());
        assert_eq!(pane.stack.used_recipe_text(), "BOL");
    }
}
