//! Reads names, quantities and settings of a recipe's text, word by word.

use std::str::FromStr;

use super::lexer::{RecipeTextToken, RecipeTokenKind, lex_recipe_text, text_fault_at, unquote_recipe_text};
use crate::cue_timing::PhaseRule;
use crate::error::{RecipeTextProblem, TextError};
use crate::recipe_settings::*;
use crate::units::{BodyDirection, HandChoice, RecipeLength, RecipeSeconds, UnitError};
use chereme_sign::query::TokenQuery;

const MAX_PARSE_DEPTH: usize = 32;

/// A parsed value, or the fault and its place.
pub(crate) type ParsedText<T> = Result<T, TextError>;

/// Reads a recipe's text word by word.
pub(crate) struct RecipeParser<'a> {
    text: &'a str,
    tokens: Vec<RecipeTextToken>,
    at: usize,
    depth: usize,
}

impl<'a> RecipeParser<'a> {
    /// Returns a parser at the start of a text.
    pub(crate) fn for_recipe_text(text: &'a str) -> ParsedText<Self> {
        Ok(Self {
            text,
            tokens: lex_recipe_text(text)?,
            at: 0,
            depth: 0,
        })
    }

    /// Enters one more level of parentheses.
    pub(crate) fn enter_parentheses(&mut self) -> ParsedText<()> {
        self.depth += 1;
        if self.depth > MAX_PARSE_DEPTH {
            return Err(self.fault_at_position(RecipeTextProblem::TooDeep(MAX_PARSE_DEPTH)));
        }
        Ok(())
    }

    /// Leaves a level of parentheses.
    pub(crate) fn leave_parentheses(&mut self) {
        self.depth -= 1;
    }

    /// Returns whether nothing is left.
    pub(crate) fn is_at_text_end(&self) -> bool {
        self.peek_recipe_token().is_none()
    }

    pub(crate) fn parse_notation_settings(&mut self, what: &'static str) -> ParsedText<NotationSettings> {
        let mut notation = NotationSettings {
            of: self.parse_recipe_name(what)?,
            language: None,
            on: None,
        };
        loop {
            if self.accept_word("with") {
                let language = self.parse_recipe_name("\"default\", \"measured\" or a file of body language")?;
                notation.language = Some(language);
            } else if self.accept_word("on") {
                notation.on = Some(self.parse_recipe_name("a signer")?);
            } else {
                return Ok(notation);
            }
        }
    }

    pub(crate) fn parse_spell_settings(&mut self) -> ParsedText<SpellSettings> {
        let mut spell = SpellSettings {
            word: self.parse_recipe_name("the word to spell")?,
            hand: HandChoice::Dominant,
            alphabet: None,
            hold: None,
            via: PostureTransition::default(),
            on: None,
        };
        loop {
            if let Some(hand) = self.parse_hand_choice() {
                spell.hand = hand;
            } else if self.accept_word("with") {
                spell.alphabet = Some(self.parse_recipe_name("an alphabet")?);
            } else if self.accept_word("hold") {
                spell.hold = Some(self.parse_quantity("a time, such as 0.2s")?);
            } else if self.accept_word("on") {
                spell.on = Some(self.parse_recipe_name("a signer")?);
            } else if let Some(via) = self.parse_transition()? {
                spell.via = via;
            } else {
                return Ok(spell);
            }
        }
    }

    pub(crate) fn parse_cue_settings(&mut self) -> ParsedText<CueSettings> {
        let mut cue = CueSettings {
            text: self.parse_recipe_name("the text to cue, in quotes")?,
            phones: None,
            code: None,
            variants: Vec::new(),
            hand: HandChoice::Dominant,
            phase: PhaseRule::default(),
            pace: None,
            on: None,
        };
        loop {
            if let Some(hand) = self.parse_hand_choice() {
                cue.hand = hand;
            } else if self.accept_word("as") {
                cue.phones = Some(self.parse_recipe_name("an alphabet: sampa, ipa or mfa")?);
            } else if self.accept_word("with") {
                cue.code = Some(self.parse_recipe_name("a code, such as french")?);
            } else if self.accept_word("variant") {
                cue.variants
                    .push(self.parse_recipe_name("a habit of cuers, such as schwa-as-eu")?);
            } else if self.accept_word("by") {
                let rules = PhaseRule::ALL_PHASE_RULES.map(PhaseRule::phase_rule_name);
                let rule = PhaseRule::ALL_PHASE_RULES
                    .into_iter()
                    .find(|rule| self.current_word() == Some(rule.phase_rule_name()));
                cue.phase = rule.ok_or_else(|| self.expected_text_error("a rule of phases", &rules))?;
                self.at += 1;
            } else if self.accept_word("pace") {
                cue.pace = Some(self.parse_quantity("a factor, such as 1.6")?);
            } else if self.accept_word("on") {
                cue.on = Some(self.parse_recipe_name("a signer")?);
            } else {
                return Ok(cue);
            }
        }
    }

    pub(crate) fn parse_point_settings(&mut self) -> ParsedText<PointSettings> {
        let hand = self.parse_hand_choice().unwrap_or(HandChoice::Dominant);
        self.expect_word("at", "a hand or \"at\"")?;
        let mut point = PointSettings {
            hand,
            at: self.parse_signing_spot()?,
            with: None,
            hold: None,
            via: PostureTransition::default(),
            on: None,
        };
        loop {
            if self.accept_word("with") {
                point.with = Some(self.parse_value_choice()?);
            } else if self.accept_word("hold") {
                point.hold = Some(self.parse_quantity("a time, such as 0.3s")?);
            } else if self.accept_word("on") {
                point.on = Some(self.parse_recipe_name("a signer")?);
            } else if let Some(via) = self.parse_transition()? {
                point.via = via;
            } else {
                return Ok(point);
            }
        }
    }

    pub(crate) fn parse_value_choice(&mut self) -> ParsedText<ValueChoice> {
        if self.accept_word("_") {
            return Ok(ValueChoice::Keep);
        }
        if self.accept_word("from") {
            return self.parse_recipe_name("a sign").map(ValueChoice::From);
        }
        if let Some(query) = self.parse_query_text()? {
            return Ok(ValueChoice::Best(query));
        }
        self.parse_recipe_name("a value, \"from\" and a sign, \"best(...)\" or \"_\"")
            .map(ValueChoice::Value)
    }

    pub(crate) fn parse_query_text(&mut self) -> ParsedText<Option<String>> {
        let Some(token) = self
            .peek_recipe_token()
            .filter(|token| token.kind == RecipeTokenKind::Query)
        else {
            return Ok(None);
        };
        let query = token.text.clone();
        TokenQuery::parse_query(&query)
            .map_err(|error| self.fault_at_position(RecipeTextProblem::Query(error.to_string())))?;
        self.at += 1;
        Ok(Some(query))
    }

    pub(crate) fn parse_signing_spot(&mut self) -> ParsedText<SigningSpot> {
        if self.accept_word("me") {
            return Ok(SigningSpot::Me);
        }
        if self.accept_word("you") {
            return Ok(SigningSpot::You);
        }
        if self.current_word().and_then(BodyDirection::from_word).is_some() {
            return self.parse_directions().map(SigningSpot::Towards);
        }
        if let Some(point) = self.spot_point()? {
            return Ok(SigningSpot::Point(point));
        }
        self.parse_recipe_name("me, you, a direction, a placement, or a point such as 30cm,140cm,50cm")
            .map(SigningSpot::Value)
    }

    /// Reads three lengths with commas between, if a comma follows the first.
    pub(crate) fn spot_point(&mut self) -> ParsedText<Option<[RecipeLength; 3]>> {
        let starts = self.is_length(self.at) && {
            let unit = self.tokens.get(self.at + 1);
            let after = if unit.is_some_and(|t| t.kind == RecipeTokenKind::Word) {
                2
            } else {
                1
            };
            self.tokens
                .get(self.at + after)
                .is_some_and(|t| t.kind == RecipeTokenKind::Comma)
        };
        if !starts {
            return Ok(None);
        }
        const WANTED_SPOT: &str = "a length, such as 30cm";
        let mut point = [self.parse_quantity(WANTED_SPOT)?; 3];
        for slot in &mut point[1..] {
            if !self.accept_kind(RecipeTokenKind::Comma) {
                return Err(self.expected_text_error("a comma: a point has three lengths", &[]));
            }
            *slot = self.parse_quantity(WANTED_SPOT)?;
        }
        Ok(Some(point))
    }

    /// Reads legs, one after another; on a path they are separated by `then`.
    pub(crate) fn parse_straight_legs(&mut self, path: bool) -> ParsedText<Vec<StraightLeg>> {
        let mut legs = vec![self.parse_straight_leg(path)?];
        loop {
            if path && self.current_word() == Some("then") && self.is_leg(self.at + 1) {
                self.at += 1;
            } else if path || self.current_word().and_then(BodyDirection::from_word).is_none() {
                return Ok(legs);
            }
            legs.push(self.parse_straight_leg(path)?);
        }
    }

    fn parse_straight_leg(&mut self, path: bool) -> ParsedText<StraightLeg> {
        let towards = self.parse_directions()?;
        let distance = self.parse_quantity("a length, such as 25cm")?;
        let time = if path && self.accept_word("in") {
            Some(self.parse_quantity("a time, such as 0.4s")?)
        } else {
            None
        };
        Ok(StraightLeg {
            towards,
            distance,
            time,
        })
    }

    fn is_leg(&self, mut at: usize) -> bool {
        let start = at;
        let is_direction =
            |t: &&RecipeTextToken| t.kind == RecipeTokenKind::Word && BodyDirection::from_word(&t.text).is_some();
        while self.tokens.get(at).filter(is_direction).is_some() {
            at += 1;
        }
        at > start && self.is_length(at)
    }

    fn is_length(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|token| {
            let digits = token.text.trim_start_matches(['-', '+', '.']);
            token.kind == RecipeTokenKind::Word && digits.starts_with(|c: char| c.is_ascii_digit())
        })
    }

    pub(crate) fn parse_directions(&mut self) -> ParsedText<Vec<BodyDirection>> {
        let mut all = Vec::new();
        while !(all.len() == 1 && self.current_word() == Some("in") && self.is_length(self.at + 1)) {
            let Some(direction) = self.parse_direction() else {
                break;
            };
            all.push(direction);
        }
        if all.is_empty() {
            return Err(self.no_direction());
        }
        Ok(all)
    }

    pub(crate) fn parse_direction(&mut self) -> Option<BodyDirection> {
        let direction = self.current_word().and_then(BodyDirection::from_word)?;
        self.at += 1;
        Some(direction)
    }

    pub(crate) fn no_direction(&self) -> TextError {
        let words = BodyDirection::ALL_BODY_DIRECTIONS.map(BodyDirection::body_direction_name);
        self.expected_text_error("a direction (left, right, up, down, forward, back)", &words)
    }

    pub(crate) fn parse_hand_choice(&mut self) -> Option<HandChoice> {
        let hand = self.current_word().and_then(HandChoice::from_word)?;
        self.at += 1;
        Some(hand)
    }

    pub(crate) fn parse_transition(&mut self) -> ParsedText<Option<PostureTransition>> {
        if !self.accept_word("via") {
            return Ok(None);
        }
        const WANTED_PROFILE: &str = "slerp, cosine, sigmoid, minimum-jerk, learned, or a time such as 0.2s";
        let mut via = PostureTransition::default();
        if !self.is_length(self.at) {
            via.profile = Some(self.one_of(
                &TransitionProfile::ALL_TRANSITION_PROFILES,
                TransitionProfile::transition_profile_name,
                WANTED_PROFILE,
            )?);
        }
        if self.is_length(self.at) {
            via.time = Some(self.parse_quantity(WANTED_PROFILE)?);
        }
        Ok(Some(via))
    }

    pub(crate) fn one_of<T: Copy>(
        &mut self,
        all: &[T],
        name: fn(T) -> &'static str,
        expected: &'static str,
    ) -> ParsedText<T> {
        let first_match = all
            .iter()
            .copied()
            .find(|item| self.current_word() == Some(name(*item)));
        let matching_item = first_match.ok_or_else(|| {
            let words: Vec<&str> = all.iter().map(|item| name(*item)).collect();
            self.expected_text_error(expected, &words)
        })?;
        self.at += 1;
        Ok(matching_item)
    }

    /// Reads a number with its unit, which may be separated by a blank.
    pub(crate) fn parse_quantity<T: FromStr<Err = UnitError>>(&mut self, expected: &'static str) -> ParsedText<T> {
        if !self.is_length(self.at) {
            return Err(self.expected_text_error(expected, &[]));
        }
        let mut text = self.tokens[self.at].text.clone();
        let mut used = 1;
        let bare = text.parse::<f64>().is_ok();
        if let Some(unit) = self.tokens.get(self.at + 1)
            && bare
            && unit.kind == RecipeTokenKind::Word
            && [
                "mm", "cm", "m", "in", "inch", "inches", "%", "s", "sec", "ms", "deg", "°", "degrees",
            ]
            .contains(&unit.text.as_str())
        {
            text.push_str(&unit.text);
            used = 2;
        }
        let quantity = text
            .parse()
            .map_err(|error: UnitError| self.fault_at_position(RecipeTextProblem::Unit(error)))?;
        self.at += used;
        Ok(quantity)
    }

    /// Reads a name: a quoted text, or a word without another meaning.
    pub(crate) fn parse_recipe_name(&mut self, expected: &'static str) -> ParsedText<String> {
        let quoted = self
            .peek_recipe_token()
            .filter(|token| token.kind == RecipeTokenKind::Quoted);
        let plain = || {
            self.peek_recipe_token()
                .filter(|token| token.kind == RecipeTokenKind::Word && token.text != "then")
        };
        let Some(token) = quoted.or_else(plain) else {
            return Err(self.expected_text_error(expected, &[]));
        };
        let name = token.text.clone();
        if name.is_empty() {
            return Err(self.expected_text_error(expected, &[]));
        }
        self.at += 1;
        Ok(name)
    }

    /// Reads a count.
    pub(crate) fn parse_repetition_count(&mut self, expected: &'static str) -> ParsedText<u32> {
        let parsed_count = self.current_word().and_then(|word| word.parse().ok());
        let count = parsed_count.ok_or_else(|| self.expected_text_error(expected, &[]))?;
        self.at += 1;
        Ok(count)
    }

    /// Reads two times with two dots between; one of them may be missing.
    pub(crate) fn parse_time_span(&mut self) -> ParsedText<[Option<RecipeSeconds>; 2]> {
        const WANTED_TIME_SPAN: &str = "two times with two dots between, such as 0.4s..1.9s";
        let start = self.at;
        let mut text = String::new();
        while let Some(word) = self.current_word().filter(|word| !["then", "by"].contains(word)) {
            text.push_str(word);
            self.at += 1;
        }
        let Some((from, to)) = text.split_once("..").filter(|_| text != "..") else {
            self.at = start;
            return Err(self.expected_text_error(WANTED_TIME_SPAN, &[]));
        };
        let time = |text: &str| match text {
            "" => Ok(None),
            text => text.parse().map(Some),
        };
        let times = time(from).and_then(|from| Ok((from, time(to)?)));
        let (from, to) = times.map_err(|error: UnitError| {
            self.at = start;
            self.fault_at_position(RecipeTextProblem::Unit(error))
        })?;
        Ok([from, to])
    }

    /// Reads the points of a curve, with `then` between them.
    pub(crate) fn parse_curve_points(&mut self) -> ParsedText<Vec<[RecipeLength; 3]>> {
        const WANTED_CURVE_POINT: &str = "a point: left, up and forward, such as 10cm,5cm,0cm";
        let mut points = Vec::new();
        loop {
            let point = self.spot_point()?;
            points.push(point.ok_or_else(|| self.expected_text_error(WANTED_CURVE_POINT, &[]))?);
            if self.current_word() != Some("then") || !self.is_point(self.at + 1) {
                return Ok(points);
            }
            self.at += 1;
        }
    }

    /// Returns whether a length followed by a comma is at `at`.
    fn is_point(&self, at: usize) -> bool {
        let comma = |at: usize| {
            self.tokens
                .get(at)
                .is_some_and(|token| token.kind == RecipeTokenKind::Comma)
        };
        self.is_length(at) && (comma(at + 1) || comma(at + 2))
    }

    /// Returns whether a length comes after the next word.
    pub(crate) fn is_length_next(&self) -> bool {
        self.is_length(self.at + 1)
    }

    /// Returns the parser's position, for [`back_to`](Self::back_to).
    pub(crate) fn parser_position(&self) -> usize {
        self.at
    }

    /// Returns to an earlier position.
    pub(crate) fn back_to(&mut self, place: usize) {
        self.at = place;
    }

    fn peek_recipe_token(&self) -> Option<&RecipeTextToken> {
        self.tokens.get(self.at)
    }

    pub(crate) fn current_word(&self) -> Option<&str> {
        self.peek_recipe_token()
            .filter(|token| token.kind == RecipeTokenKind::Word)
            .map(|token| token.text.as_str())
    }

    pub(crate) fn accept_word(&mut self, word: &str) -> bool {
        let is_match = self.current_word() == Some(word);
        self.at += usize::from(is_match);
        is_match
    }

    /// Reads a word such as `brows=raised`: its name, and its value without quotes.
    pub(crate) fn accept_assignment(&mut self) -> Option<(String, String)> {
        let (name, value) = self.current_word()?.split_once('=')?;
        let is_quoted = value.starts_with('"');
        let value = if is_quoted {
            unquote_recipe_text(value)
        } else {
            value.to_owned()
        };
        let assignment = (name.to_owned(), value);
        self.at += 1;
        Some(assignment)
    }

    /// Reads a sign of this kind if one is next.
    pub(crate) fn accept_kind(&mut self, kind: RecipeTokenKind) -> bool {
        let is_match = self.peek_recipe_token().is_some_and(|token| token.kind == kind);
        self.at += usize::from(is_match);
        is_match
    }

    pub(crate) fn expect_word(&mut self, word: &'static str, expected: &'static str) -> ParsedText<()> {
        if self.accept_word(word) {
            Ok(())
        } else {
            Err(self.expected_text_error(expected, &[word]))
        }
    }

    pub(crate) fn expected_text_error(&self, expected: &'static str, words: &[&str]) -> TextError {
        let token_text = self.peek_recipe_token().map(|token| token.text.clone());
        let nearest = token_text
            .as_deref()
            .and_then(|found| chereme_sign::text::nearest_candidate(found, words.iter().copied()))
            .map(str::to_owned);
        self.fault_at_position(RecipeTextProblem::Expected {
            expected,
            found: token_text,
            nearest,
        })
    }

    /// Returns an error at the word that was read last.
    pub(crate) fn fault_at_last_word(&mut self, problem: RecipeTextProblem) -> TextError {
        self.at -= 1;
        self.fault_at_position(problem)
    }

    fn fault_at_position(&self, problem: RecipeTextProblem) -> TextError {
        let fault_offset = self.peek_recipe_token().map_or(self.text.len(), |token| token.at.start);
        text_fault_at(self.text, fault_offset, problem)
    }
}
