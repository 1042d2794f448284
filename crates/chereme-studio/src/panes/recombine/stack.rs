//! A recipe as a stack of cards: sources, and the operators on each, in order.
//!
//! Text and cards are the same recipe. A part that cards cannot show, such as an utterance in parentheses, is one card
//! with its text. Cards that are switched off or incomplete stay in the stack and are left out of the text.

use std::collections::BTreeMap;

use chereme_corpus::recipe::{
    JoinedPiece, OperatorPipe, PostureTransition, Recipe, RecipeChain, RecipeError, RecipeNode, SigningSpot, Step,
    ValueChoice,
};

/// The contents of a card.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum CardContent {
    /// A source of movement; the operators up to the next source apply to it.
    Source {
        /// The transition from the movement before; ignored for the first source.
        via: PostureTransition,
        /// A sign, spelling, pointing, notation, or an utterance in parentheses.
        node: RecipeNode,
    },
    /// An operator.
    Step(Step),
}

/// A card of the stack.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RecipeCard {
    /// Its id, which stays the same when the card moves.
    pub(crate) id: u64,
    /// Whether it is switched on.
    pub(crate) on: bool,
    pub(crate) what: CardContent,
}

/// The cards; the first is a source.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct CardStack {
    cards: Vec<RecipeCard>,
    next: u64,
}

impl CardContent {
    /// Returns a source with the default transition.
    pub(crate) fn source_with_default_transition(node: RecipeNode) -> Self {
        let via = PostureTransition::default();
        Self::Source { via, node }
    }

    pub(crate) fn is_source(&self) -> bool {
        matches!(self, Self::Source { .. })
    }

    /// Returns whether every necessary name is filled in.
    pub(crate) fn is_complete(&self) -> bool {
        let there = |name: &str| !name.trim().is_empty();
        let chosen = |choice: &ValueChoice| match choice {
            ValueChoice::Keep => true,
            ValueChoice::Value(name) | ValueChoice::From(name) | ValueChoice::Best(name) => there(name),
        };
        let spot = |spot: &SigningSpot| match spot {
            SigningSpot::Value(name) => there(name),
            SigningSpot::Towards(all) => !all.is_empty(),
            _ => true,
        };
        match self {
            Self::Source { node, .. } => match node {
                RecipeNode::Sign(name) => there(name),
                RecipeNode::Spell(spell) => there(&spell.word),
                RecipeNode::Point(point) => spot(&point.at) && point.with.as_ref().is_none_or(chosen),
                RecipeNode::Cue(cue) => there(&cue.text),
                RecipeNode::Hamnosys(notation) | RecipeNode::Sigml(notation) => there(&notation.of),
                RecipeNode::Pipe(_) | RecipeNode::Then(_) => true,
            },
            Self::Step(step) => !matches!(step.check_step_settings(), Err(RecipeError::Empty { .. })),
        }
    }

    /// Returns the card with `right` in place of the name `wrong`, if the card contains that name.
    pub(crate) fn with_corrected_name(&self, wrong: &str, right: &str) -> Option<Self> {
        let name = |name: &str| RecipeNode::Sign(name.to_owned()).to_string();
        let (wrong_text, right_text) = (name(wrong), name(right));
        let replaced = |text: &str| -> Option<Recipe> {
            let has_wrong = text.contains(&wrong_text);
            let text = text.replacen(&wrong_text, &right_text, 1);
            has_wrong.then(|| text.parse().ok()).flatten()
        };
        match self {
            Self::Source {
                via,
                node: RecipeNode::Sign(name),
            } if name == wrong => Some(Self::Source {
                via: *via,
                node: RecipeNode::Sign(right.to_owned()),
            }),
            Self::Source { via, node } => Some(Self::Source {
                via: *via,
                node: replaced(&node.to_string())?.recipe_root().clone(),
            }),
            Self::Step(step) => match replaced(&format!("A | {step}"))?.recipe_root() {
                RecipeNode::Pipe(pipe) => pipe.steps.first().cloned().map(Self::Step),
                _ => None,
            },
        }
    }

    /// Returns whether both are of the same kind, so that an edit can turn one into the other.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Source { .. }, Self::Source { .. }) => true,
            (Self::Step(a), Self::Step(b)) => a.name() == b.name(),
            _ => false,
        }
    }
}

impl CardStack {
    /// Returns the stack of a recipe.
    #[cfg(test)]
    pub(crate) fn from_stack_recipe(recipe: &Recipe) -> Self {
        let mut stack = Self::default();
        stack.replace_stack_recipe(recipe);
        stack
    }

    pub(crate) fn stack_cards(&self) -> &[RecipeCard] {
        &self.cards
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.cards.is_empty()
    }

    pub(crate) fn find_card_position(&self, id: u64) -> Option<usize> {
        self.cards.iter().position(|card| card.id == id)
    }

    pub(crate) fn get_mut(&mut self, id: u64) -> Option<&mut RecipeCard> {
        self.cards.iter_mut().find(|card| card.id == id)
    }

    /// Returns whether the card at `at` is used: it is switched on and complete, and so is its source.
    pub(crate) fn is_card_used(&self, at: usize) -> bool {
        let counts = |card: &RecipeCard| card.on && card.what.is_complete();
        counts(&self.cards[at]) && counts(&self.cards[self.piece_of(at).start])
    }

    /// Returns the index range of the source that the card at `at` belongs to, with its operators.
    pub(crate) fn piece_of(&self, at: usize) -> std::ops::Range<usize> {
        let is_source = |at: &usize| self.cards[*at].what.is_source();
        let start = (0..=at).rev().find(is_source).unwrap_or(0);
        let end = (at + 1..self.cards.len()).find(is_source);
        start..end.unwrap_or(self.cards.len())
    }

    /// Returns the number of sources.
    pub(crate) fn count_stack_sources(&self) -> usize {
        self.cards.iter().filter(|card| card.what.is_source()).count()
    }

    /// Returns the tree of the used cards, whether or not it is a valid recipe.
    pub(crate) fn used_recipe_node(&self) -> Option<RecipeNode> {
        let mut pieces: Vec<(PostureTransition, RecipeNode, Vec<Step>)> = Vec::new();
        for (at, card) in self.cards.iter().enumerate() {
            if !self.is_card_used(at) {
                continue;
            }
            match (&card.what, pieces.last_mut()) {
                (CardContent::Source { via, node }, _) => pieces.push((*via, node.clone(), Vec::new())),
                (CardContent::Step(step), Some((.., steps))) => steps.push(step.clone()),
                (CardContent::Step(_), None) => {}
            }
        }
        let piped = |(via, of, steps): (PostureTransition, RecipeNode, Vec<Step>)| {
            let of = Box::new(of);
            let node = if steps.is_empty() {
                *of
            } else {
                RecipeNode::Pipe(OperatorPipe { of, steps })
            };
            JoinedPiece { via, node }
        };
        let mut pieces = pieces.into_iter().map(piped);
        let first = pieces.next()?.node;
        let next: Vec<JoinedPiece> = pieces.collect();
        Some(if next.is_empty() {
            first
        } else {
            let first = Box::new(first);
            RecipeNode::Then(RecipeChain { first, next })
        })
    }

    /// Returns the recipe of the used cards; `None` if no card is used.
    ///
    /// # Errors
    /// Fails if a setting is out of range.
    pub(crate) fn used_recipe(&self) -> Option<Result<Recipe, RecipeError>> {
        self.used_recipe_node().map(Recipe::new)
    }

    /// Returns the recipe's text; empty if no card is used.
    pub(crate) fn used_recipe_text(&self) -> String {
        self.used_recipe_node().map_or(String::new(), |node| node.to_string())
    }

    /// Returns the index of each used card by its path in the recipe's JSON, as in reports.
    pub(crate) fn card_indices_by_path(&self) -> BTreeMap<String, usize> {
        let counting: Vec<usize> = (0..self.cards.len()).filter(|at| self.is_card_used(*at)).collect();
        let sources = |at: &&usize| self.cards[**at].what.is_source();
        let several = counting.iter().filter(sources).count() > 1;
        let mut paths = BTreeMap::new();
        let mut piece = 0;
        for (nth, at) in counting.iter().enumerate() {
            let mut steps = counting[nth + 1..].iter();
            if !self.cards[*at].what.is_source() {
                continue;
            }
            let base = match (several, piece) {
                (false, _) => String::new(),
                (true, 0) => "/then/first".to_owned(),
                (true, nth) => format!("/then/next/{}/node", nth - 1),
            };
            // Reports name the piece itself, too, for its transition from the one before.
            if several && piece > 0 {
                paths.insert(format!("/then/next/{}", piece - 1), *at);
            }
            piece += 1;
            let done: Vec<usize> = steps
                .by_ref()
                .take_while(|at| !self.cards[**at].what.is_source())
                .copied()
                .collect();
            // A source without steps is no pipe in the JSON.
            if done.is_empty() {
                paths.insert(base, *at);
                continue;
            }
            paths.insert(format!("{base}/pipe/of"), *at);
            for (n, step) in done.into_iter().enumerate() {
                paths.insert(format!("{base}/pipe/steps/{n}"), step);
            }
        }
        paths
    }

    /// Returns the index of the card at `path` in a report, or of the card that contains it.
    pub(crate) fn card_at(&self, path: &str) -> Option<usize> {
        let inside = |(at, _): &(String, usize)| {
            path.strip_prefix(at.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let containing_paths = self.card_indices_by_path().into_iter().filter(inside);
        containing_paths.max_by_key(|(at, _)| at.len()).map(|(_, card)| card)
    }

    /// Replaces the stack with a recipe: cards that are in the recipe keep their ids, and unused cards keep their
    /// places.
    pub(crate) fn replace_stack_recipe(&mut self, recipe: &Recipe) {
        let new = whats(recipe.recipe_root());
        let old: Vec<(RecipeCard, bool)> = self
            .cards
            .iter()
            .enumerate()
            .map(|(at, card)| (card.clone(), self.is_card_used(at)))
            .collect();
        let counting: Vec<RecipeCard> = old
            .iter()
            .filter(|(_, counts)| *counts)
            .map(|(card, _)| card.clone())
            .collect();
        let kept = match_old_cards(&counting, &new);
        self.cards = new
            .into_iter()
            .zip(kept)
            .map(|(what, id)| RecipeCard {
                id: id.unwrap_or_else(|| {
                    self.next += 1;
                    self.next
                }),
                on: true,
                what,
            })
            .collect();
        self.put_back(&old);
    }

    /// Inserts the unused cards of `old` after the cards that they followed.
    fn put_back(&mut self, old: &[(RecipeCard, bool)]) {
        for (at, (card, counts)) in old.iter().enumerate() {
            if *counts {
                continue;
            }
            let anchor = old[..at]
                .iter()
                .rev()
                .find_map(|(before, _)| self.find_card_position(before.id));
            let place = match (anchor, card.what.is_source()) {
                (Some(anchor), true) => self.piece_of(anchor).end,
                (Some(anchor), false) => anchor + 1,
                (None, true) => 0,
                (None, false) if self.cards.is_empty() => continue,
                (None, false) => 1,
            };
            self.cards.insert(place, card.clone());
        }
    }

    /// Adds a card after the card `after`, or at the end, and returns its id. A source goes to the end of the piece,
    /// and the first card must be a source.
    pub(crate) fn add_stack_card(&mut self, after: Option<u64>, what: CardContent) -> Option<u64> {
        let after = after.and_then(|id| self.find_card_position(id));
        if self.cards.is_empty() && !what.is_source() {
            return None;
        }
        let index = match after {
            Some(at) if what.is_source() => self.piece_of(at).end,
            Some(at) => at + 1,
            None => self.cards.len(),
        };
        self.next += 1;
        let id = self.next;
        self.cards.insert(index, RecipeCard { id, on: true, what });
        Some(id)
    }

    /// Removes a card; removing a source removes its operators too, unless it is the only source.
    pub(crate) fn remove_stack_card(&mut self, id: u64) {
        let Some(at) = self.find_card_position(id) else {
            return;
        };
        if self.cards[at].what.is_source() {
            self.cards.drain(self.piece_of(at));
        } else {
            self.cards.remove(at);
        }
    }

    /// Inserts a copy after a card, of a source with its operators, and returns the copy's id.
    pub(crate) fn duplicate_stack_card(&mut self, id: u64) -> Option<u64> {
        let index = self.find_card_position(id)?;
        let range = if self.cards[index].what.is_source() {
            self.piece_of(index)
        } else {
            index..index + 1
        };
        let mut copies = self.cards[range.clone()].to_vec();
        for card in &mut copies {
            self.next += 1;
            card.id = self.next;
        }
        let first = copies.first().map(|card| card.id);
        self.cards.splice(range.end..range.end, copies);
        first
    }

    /// Switches a card on or off.
    pub(crate) fn switch_stack_card(&mut self, id: u64) {
        if let Some(card) = self.get_mut(id) {
            card.on = !card.on;
        }
    }

    /// Moves a card before the one at index `to`; a source moves with its operators to a boundary between pieces.
    /// Returns whether anything moved.
    pub(crate) fn move_to(&mut self, id: u64, to: usize) -> bool {
        let Some(from) = self.find_card_position(id) else {
            return false;
        };
        let to = to.min(self.cards.len());
        let (range, to) = if self.cards[from].what.is_source() {
            let moved_piece = self.piece_of(from);
            let to = if to < self.cards.len() {
                let piece = self.piece_of(to);
                if to == piece.start || to < from {
                    piece.start
                } else {
                    piece.end
                }
            } else {
                to
            };
            (moved_piece, to)
        } else {
            (from..from + 1, to.max(1))
        };
        if (range.start..=range.end).contains(&to) {
            return false;
        }
        let count = range.len();
        let moved: Vec<RecipeCard> = self.cards.drain(range.clone()).collect();
        let to = if to > range.start { to - count } else { to };
        self.cards.splice(to..to, moved);
        true
    }

    /// Moves a card one place up or down. Returns whether anything moved.
    pub(crate) fn shift_stack_card(&mut self, id: u64, down: bool) -> bool {
        let Some(at) = self.find_card_position(id) else {
            return false;
        };
        if !self.cards[at].what.is_source() {
            let to = if down { at + 2 } else { at.saturating_sub(1) };
            return to <= self.cards.len() && self.move_to(id, to);
        }
        let shifted_piece = self.piece_of(at);
        if down {
            shifted_piece.end < self.cards.len() && {
                let next = self.piece_of(shifted_piece.end).end;
                self.move_to(id, next)
            }
        } else {
            at > 0 && self.move_to(id, self.piece_of(at - 1).start)
        }
    }
}

/// Returns the contents of the cards for a tree.
fn whats(root: &RecipeNode) -> Vec<CardContent> {
    let mut all = Vec::new();
    let mut piece = |via: PostureTransition, node: &RecipeNode| match node {
        RecipeNode::Pipe(pipe) => {
            let node = (*pipe.of).clone();
            all.push(CardContent::Source { via, node });
            all.extend(pipe.steps.iter().cloned().map(CardContent::Step));
        }
        other => {
            let node = other.clone();
            all.push(CardContent::Source { via, node });
        }
    };
    match root {
        RecipeNode::Then(then) => {
            piece(PostureTransition::default(), &then.first);
            for joined in &then.next {
                piece(joined.via, &joined.node);
            }
        }
        one => piece(PostureTransition::default(), one),
    }
    all
}

/// Returns for each of `new` the id of the corresponding old card: equal ones are matched from both ends, and those
/// between by kind, in order.
fn match_old_cards(old: &[RecipeCard], new: &[CardContent]) -> Vec<Option<u64>> {
    let same = |(card, what): &(&RecipeCard, &CardContent)| card.what == **what;
    let front = old.iter().zip(new).take_while(same).count();
    let most = old.len().min(new.len()) - front;
    let back = old
        .iter()
        .rev()
        .zip(new.iter().rev())
        .take(most)
        .take_while(same)
        .count();
    let mut ids: Vec<Option<u64>> = vec![None; new.len()];
    for at in 0..front {
        ids[at] = Some(old[at].id);
    }
    for at in 1..=back {
        ids[new.len() - at] = Some(old[old.len() - at].id);
    }
    let mut free = old[front..old.len() - back].iter();
    for at in front..new.len() - back {
        let mut ahead = free.clone();
        if let Some(card) = ahead.find(|card| card.what.is_like(&new[at])) {
            ids[at] = Some(card.id);
            free = ahead;
        }
    }
    ids
}

#[cfg(test)]
mod tests;
