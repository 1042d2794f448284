//! Recombination: a recipe as text and as a stack of cards, evaluated while it changes, stored as a new sign.

mod cards;
mod catalogue;
mod fields;
mod live;
mod operators;
mod path;
mod report;
mod settings;
mod spots;
pub(crate) mod stack;
mod steps;
mod store;
mod suggest;

use std::sync::Arc;

use chereme_corpus::recipe::{Goal, Length, Node, Recipe, RecipeError, Step};
use chereme_corpus::{OperationRow, Overview, Recombination};
use eframe::egui::{Button, CollapsingHeader, Frame, Id, Panel, RichText, ScrollArea, Ui};

use super::{Acted, Carried, Pane, carry};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::model::handle::{Course, Handle};
use crate::script::edit;
use crate::words::{fill, recombine as words};
use crate::work::{Ended, Outcome, WorkId};
pub(crate) use fields::{recipe_of, selected_token};
use live::Live;
pub(crate) use path::{draw_on_stage, drawing, lengths, offset_legs, points_of, points_of_line};
use stack::{Card, Stack, What};
use steps::Steps;

/// Changes that follow each other within this time, in seconds, are one step of undo.
const SETTLES: f64 = 0.4;

/// The pane.
#[derive(Default)]
pub(crate) struct Recombine {
    stack: Stack,
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
    live: Live,
    suggest: suggest::Suggest,
    gloss: String,
    /// The name of the stored sign whose recipe was opened.
    opened: Option<String>,
    storing: Option<WorkId>,
    /// The sign that was stored last.
    stored: Option<store::Stored>,
    /// Whether the stage shows the result instead of the recording.
    on_stage: bool,
    /// The movement that was last given to the stage.
    given: Option<Arc<Recombination>>,
    come: bool,
    /// Whether the gloss takes the keyboard next.
    naming: bool,
    steps: Steps<Page>,
    /// The recipe after the last step of undo.
    settled: Page,
    /// The text after its last change, and the time of that change in seconds of the window's clock.
    changed: (String, f64),
}

/// The state of the recipe that undo restores.
#[derive(Debug, Clone, Default, PartialEq)]
struct Page {
    stack: Stack,
    text: String,
    opened: Option<String>,
    gloss: String,
}

/// Reads a recipe as text, or as JSON if it begins with a brace.
fn read(text: &str) -> Result<Recipe, String> {
    if text.trim_start().starts_with('{') {
        return serde_json::from_str(text).map_err(|error| error.to_string());
    }
    text.parse().map_err(|error: RecipeError| match &error {
        RecipeError::Text(at) => {
            // The message shows the text at the error, so that nobody has to count letters.
            let start = at.at.saturating_sub(24);
            let letters = |from: usize, count: usize| -> String {
                at.text.chars().skip(from).take(count).collect()
            };
            let (before, after) = (letters(start, at.at - start), letters(at.at, 16));
            format!("… {before} ▸ {after}\n{}", at.problem)
        }
        _ => error.to_string(),
    })
}

impl Recombine {
    /// Opens a recipe; `opened` is the name of the stored sign that it comes from, if any.
    pub(crate) fn open(&mut self, recipe: &str, opened: Option<String>, gloss: Option<String>) {
        self.stack = Stack::default();
        self.type_in(recipe.to_owned());
        self.live.reload();
        self.opened = opened;
        self.gloss = gloss.unwrap_or_default();
        self.stored = None;
        self.chosen = None;
        self.on_stage = true;
    }

    fn page(&self) -> Page {
        Page {
            stack: self.stack.clone(),
            text: self.text.clone(),
            opened: self.opened.clone(),
            gloss: self.gloss.clone(),
        }
    }

    /// Makes the changes since the last step one step of undo.
    fn settle(&mut self) {
        let same = self.settled.text == self.text && self.settled.stack == self.stack;
        if !same {
            let page = self.page();
            let before = std::mem::replace(&mut self.settled, page.clone());
            self.steps.did(before, page);
        }
    }

    /// Counts the new operations on the corpus; unsettled changes of the recipe become a step before them.
    fn count(&mut self, operations: &[OperationRow]) {
        if self.steps.is_behind(operations) {
            self.settle();
            self.steps.follow(operations);
        }
    }

    /// Makes changes one step of undo when nothing is dragged or typed, and no change has followed for a while. Changes
    /// before a press of the mouse are a separate step.
    fn settle_in_time(&mut self, ui: &Ui) {
        let (now, held) = ui.input(|input| (input.time, input.pointer.any_down()));
        if ui.input(|input| input.pointer.any_pressed()) {
            self.settle();
        }
        if self.changed.0 != self.text {
            self.changed = (self.text.clone(), now);
        }
        let rest = self.changed.1 + SETTLES - now;
        if rest > 0.0 {
            let rest = std::time::Duration::from_secs_f64(rest);
            ui.ctx().request_repaint_after(rest);
        } else if !held && !ui.ctx().text_edit_focused() {
            self.settle();
        }
    }

    /// Undoes or redoes a step of the recipe; returns whether a step of the recipe was next.
    pub(crate) fn walk(&mut self, back: bool, operations: &[OperationRow]) -> bool {
        self.count(operations);
        self.settle();
        let page = if back {
            self.steps.back()
        } else {
            self.steps.forward()
        };
        let Some(page) = page else { return false };
        self.settled = page.clone();
        Page {
            stack: self.stack,
            text: self.text,
            opened: self.opened,
            gloss: self.gloss,
        } = page;
        true
    }

    /// Changes the goal of a card's placement.
    pub(crate) fn place(&mut self, card: u64, goal: Goal) {
        if let Some(Card {
            what: What::Step(Step::Place(place)),
            ..
        }) = self.stack.get_mut(card)
        {
            place.to = goal;
            self.follow_cards();
        }
    }

    /// Makes a card move the hands along a curve through points, given as lengths to the left, up and forward.
    pub(crate) fn travel(&mut self, card: u64, points: &[[Length; 3]]) {
        if let Some(Card {
            what: What::Step(Step::Travel(travel)),
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
    fn course(&self) -> Option<Course> {
        let made = self.live.made.is_some() && self.on_stage && self.wrong.is_none();
        let chosen = self.chosen.and_then(|card| self.stack.position(card));
        let is_path = |card: &stack::Card| matches!(card.what, What::Step(Step::Travel(_)));
        let at = chosen.or_else(|| self.stack.cards().iter().rposition(is_path));
        let at = at.filter(|_| made)?;
        let card = &self.stack.cards()[at];
        let What::Step(Step::Travel(travel)) = &card.what else {
            return None;
        };
        self.stack.counts(at).then(|| Course {
            card: card.id,
            travel: travel.clone(),
        })
    }

    /// Returns the placement that can be dragged on the stage: that of the chosen card.
    fn handle(&self) -> Option<Handle> {
        let made = self.live.made.is_some() && self.on_stage && self.wrong.is_none();
        let card = self.chosen.filter(|_| made)?;
        let at = self.stack.position(card)?;
        let What::Step(Step::Place(place)) = &self.stack.cards()[at].what else {
            return None;
        };
        let note = self.live.notes.get(&card);
        self.stack.counts(at).then(|| Handle {
            card,
            hand: place.hand,
            to: place.to.clone(),
            moved: note.and_then(|it| it.moved),
        })
    }

    /// Adds a sign: to the chosen card, or any, that lacks one, else as a separate source.
    pub(crate) fn take_in(&mut self, carried: &Carried, overview: &Overview) {
        let name = fields::address(overview, carried.token, &carried.gloss);
        let waiting = |card: &stack::Card| matches!(&card.what, What::Source { node: Node::Sign(name), .. } if name.trim().is_empty());
        let cards = self.stack.cards();
        let chosen = cards.iter().find(|it| Some(it.id) == self.chosen);
        let found = chosen.filter(|it| waiting(it));
        let found = found.or_else(|| cards.iter().find(|it| waiting(it)));
        match found.map(|card| card.id) {
            Some(id) => {
                if let Some(card) = self.stack.get_mut(id)
                    && let What::Source { node, .. } = &mut card.what
                {
                    *node = Node::Sign(name);
                }
                (self.chosen, self.focus) = (Some(id), Some(id));
                self.follow_cards();
            }
            None if self.stack.is_empty() => self.open(&Node::Sign(name).to_string(), None, None),
            None => self.add(What::source(Node::Sign(name))),
        }
    }

    /// Returns whether the stage has not received the last result yet.
    pub(crate) fn has_news(&self) -> bool {
        self.live.has_news()
    }

    /// Evaluates the current recipe, and passes the result, its handle and its path to the stage; `now` is the time on
    /// the window's clock.
    pub(crate) fn keep_up(&mut self, seen: &PaneInput<'_>, now: f64, out: &mut Outbox) {
        let generation = seen.snapshot.overview.generation;
        if self.wrong.is_none() {
            let text = self.stack.text();
            self.live.follow(&self.stack, &text, (generation, now), out);
        }
        self.show_on_stage(seen, out);
        let handle = self.handle();
        if seen.shown.handle != handle {
            out.send(Command::Handle(handle));
        }
        let course = self.course();
        if seen.shown.course.as_deref() != course.as_ref() {
            out.send(Command::Course(course.map(Box::new)));
        }
    }

    /// Passes the result to the stage, or returns the stage to the recording.
    fn show_on_stage(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
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
        let shown = made.map(|made| Arc::new(GeneratedClip::of(made)));
        out.send(Command::Made(shown));
    }

    /// Sets the text to typed text; the cards follow if it can be read.
    fn type_in(&mut self, text: String) {
        self.text = text;
        if self.text.trim().is_empty() {
            self.stack = Stack::default();
            self.wrong = None;
            return;
        }
        match read(&self.text) {
            Ok(recipe) => {
                self.stack.take(&recipe);
                (self.wrong, self.on_stage) = (None, true);
            }
            Err(wrong) => self.wrong = Some(wrong),
        }
    }

    /// Updates the text after a change of the cards.
    fn follow_cards(&mut self) {
        self.wrong = None;
        self.on_stage = true;
        match self.stack.recipe() {
            Some(Ok(recipe)) => self.stack.take(&recipe),
            Some(Err(error)) => self.wrong = Some(error.to_string()),
            None => {}
        }
        self.text = self.stack.text();
    }

    /// Adds a card after the chosen one, and chooses it.
    fn add(&mut self, what: What) {
        let after = self.chosen.filter(|_| !what.is_source());
        let id = self.stack.add(after, what);
        (self.chosen, self.focus, self.fresh) = (id, id, id);
        self.follow_cards();
    }

    /// Carries out an action of keys or menus on a card.
    fn change(&mut self, id: u64, action: Action) {
        let at = self.stack.position(id);
        match action {
            Action::CardUp => drop(self.stack.shift(id, false)),
            Action::CardDown => drop(self.stack.shift(id, true)),
            Action::CardSwitch => self.stack.switch(id),
            Action::CardDuplicate => {
                let copy = self.stack.duplicate(id);
                (self.chosen, self.focus) = (copy, copy);
            }
            Action::CardRemove => {
                self.stack.remove(id);
                let last = self.stack.cards().len().checked_sub(1);
                let next = last
                    .zip(at)
                    .map(|(last, at)| self.stack.cards()[at.min(last)].id);
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
    fn source(&self) -> Option<&str> {
        match &self.stack.cards().first()?.what {
            What::Source {
                node: Node::Sign(name),
                ..
            } if !name.trim().is_empty() => Some(name),
            _ => None,
        }
    }

    fn recipe_field(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let label = ui.horizontal(|ui| {
            let text = match &self.opened {
                Some(name) => fill(seen.say(words::OPENED), &[("name", name)]),
                None => seen.say(words::RECIPE).to_owned(),
            };
            let label = ui.label(RichText::new(text).small()).id;
            if self.live.is_making() {
                ui.add(eframe::egui::Spinner::new().size(12.0));
            }
            if !self.stack.is_empty() && ui.small_button(seen.say(words::CLEAR)).clicked() {
                self.open("", None, None);
                self.come = true;
            }
            label
        });
        let label = label.inner;
        let mut text = self.text.clone();
        let rows = 1 + text.len() / 44;
        let field = edit::block(ui, &mut text, |field| {
            field
                .id(Id::unique("recipe"))
                .hint_text(seen.say(words::HINT))
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
                self.live.reload();
            }
            self.type_in(text);
        }
        if let Some(wrong) = &self.wrong {
            let wrong = RichText::new(wrong).small().color(seen.colours().trouble);
            ui.label(wrong);
        }
    }

    /// Shows the page without a recipe.
    fn beginning(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.add_space(8.0);
        ui.strong(seen.say(words::EMPTY));
        ui.label(seen.say(words::EMPTY_MORE));
        ui.add_space(4.0);
        if let Some((recipe, gloss)) = fields::selected_recipe(seen) {
            let text = fill(seen.say(words::BEGIN_SELECTED), &[("gloss", &gloss)]);
            let button = ui.button(text);
            let key = seen.keys.text(Action::RecombineSelected);
            if button.on_hover_text(key).clicked() {
                self.open(&recipe, None, None);
            }
        }
    }

    fn adding(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let mut wanted = None;
        ui.horizontal_wrapped(|ui| {
            if !self.stack.is_empty() {
                ui.menu_button(seen.say(words::ADD_OPERATOR), |ui| {
                    for (text, hint, step) in catalogue::operators() {
                        let button = Button::new(seen.say(text)).shortcut_text(seen.say(hint));
                        if ui.add(button).clicked() {
                            wanted = Some(What::Step(step));
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
            ui.menu_button(seen.say(text), |ui| {
                for (text, node) in catalogue::sources() {
                    if ui.button(seen.say(text)).clicked() {
                        wanted = Some(What::source(node));
                        ui.close();
                    }
                }
            });
        });
        if let Some(what) = wanted {
            self.add(what);
        }
    }
}

impl Pane for Recombine {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let whole = ui.available_rect_before_wrap();
        if !self.stack.is_empty() {
            Panel::bottom("recombine-store")
                .frame(Frame::new().inner_margin(eframe::egui::Margin::symmetric(0, 6)))
                .show(ui, |ui| self.storing(ui, seen, out));
        }
        self.recipe_field(ui, seen);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if self.stack.is_empty() {
                self.beginning(ui, seen);
            } else if cards::show(self, ui, seen) {
                self.follow_cards();
            }
            self.adding(ui, seen);
            if let Some(trouble) = self.live.trouble.as_ref().filter(|it| it.card.is_none()) {
                ui.label(RichText::new(&trouble.text).color(seen.colours().trouble));
            }
            if let Some(made) = self
                .live
                .made
                .clone()
                .filter(|_| self.live.trouble.is_none())
            {
                report::show(ui, seen, &made.report);
            }
            // An unfinished name has no suggestions.
            let known = self.live.trouble.is_none();
            if let Some(source) = self.source().filter(|_| known).map(str::to_owned) {
                let name = match fields::gloss_of(seen, &source) {
                    Some(gloss) => gloss,
                    None => source.clone(),
                };
                let title = fill(seen.say(words::SUGGEST), &[("sign", &name)]);
                let header = CollapsingHeader::new(title).id_salt("suggest");
                let shown = header.show(ui, |ui| self.suggest.show(ui, seen, &source, out));
                if let Some(chosen) = shown.body_returned.flatten() {
                    let opened = None;
                    self.open(&chosen.recipe, opened, chosen.gloss);
                }
            }
        });
        if let Some(carried) = carry::let_go(ui, seen, whole) {
            self.take_in(&carried, &seen.snapshot.overview);
        }
        self.naming = false;
        if let Some(thing) = fields::asked(ui) {
            out.send(Command::Inspect(thing));
        }
        self.keep_up(seen, ui.input(|input| input.time), out);
        self.count(&seen.snapshot.overview.operations);
        self.settle_in_time(ui);
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::CardUp
            | Action::CardDown
            | Action::CardDuplicate
            | Action::CardSwitch
            | Action::CardRemove => match self.chosen {
                Some(id) => {
                    self.change(id, action);
                    Acted::Yes
                }
                None => Acted::Cannot(words::NEEDS_CARD),
            },
            Action::StoreSign if self.stack.is_empty() => Acted::Cannot(words::NEEDS_RECIPE),
            Action::StoreSign => {
                (self.come, self.naming) = (false, true);
                Acted::Yes
            }
            Action::RecombineSelected => match fields::selected_recipe(seen) {
                Some((recipe, _)) => {
                    out.send(Command::Recipe(recipe, None));
                    Acted::Yes
                }
                None => Acted::Cannot(crate::words::shell::NEEDS_ANNOTATION),
            },
            _ => Acted::No,
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.live.hear(id, ended) {
            return;
        }
        self.suggest.hear(id, ended);
        if self.storing.take_if(|storing| *storing == id).is_some()
            && let Ok(Outcome::Recombined(made)) = ended
        {
            self.stored = store::Stored::of(made);
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
        let mut pane = Recombine::default();
        pane.type_in("BOL|reverse".into());
        assert_eq!(pane.stack.cards().len(), 2);
        assert_eq!(pane.text, "BOL|reverse", "what is typed stays as it is");
        pane.type_in("BOL|revers".into());
        assert!(pane.wrong.as_ref().is_some_and(|it| it.contains("reverse")));
        assert_eq!(pane.stack.text(), "BOL | reverse", "the cards stay");
        let id = pane.stack.cards()[1].id;
        pane.change(id, Action::CardDuplicate);
        assert_eq!(pane.text, "BOL | reverse | reverse");
        assert!(pane.wrong.is_none());
        pane.change(id, Action::CardRemove);
        assert_eq!(pane.text, "BOL | reverse");
        assert!(pane.focus.is_some());
        pane.type_in(String::new());
        assert!(pane.stack.is_empty());
        pane.type_in(r#"{"version": 1, "make": {"sign": "BOL"}}"#.into());
        assert_eq!(pane.stack.text(), "BOL");
    }
}
