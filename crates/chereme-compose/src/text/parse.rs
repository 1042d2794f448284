//! Parses a recipe's text into the tree.

use std::str::FromStr;

use super::lexer::{Kind, Token, fault, lex};
use crate::cue::PhaseRule;
use crate::error::{Problem, RecipeError, TextError};
use crate::recipe::*;
use crate::units::{Direction, Hands, Length, UnitError};
use chereme_sign::query::Query;

const DEEPEST: usize = 32;

impl FromStr for Recipe {
    type Err = RecipeError;

    fn from_str(text: &str) -> Result<Self, RecipeError> {
        let tokens = lex(text)?;
        let mut parser = Parser {
            text,
            tokens,
            at: 0,
            depth: 0,
        };
        let root = parser.sequence()?;
        if parser.peek().is_some() {
            return Err(parser
                .expected("\"|\", \"then\" or the end", &["then"])
                .into());
        }
        Self::new(root)
    }
}

/// A parsed value, or the fault and its place.
pub(crate) type Parsed<T> = Result<T, TextError>;

/// Reads a recipe's text word by word.
pub(crate) struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn sequence(&mut self) -> Parsed<Node> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fault(Problem::TooDeep(DEEPEST)));
        }
        let first = self.pipe()?;
        let mut next = Vec::new();
        while self.accept("then") {
            let via = self.via()?.unwrap_or_default();
            let node = self.pipe()?;
            next.push(Joined { via, node });
        }
        self.depth -= 1;
        Ok(if next.is_empty() {
            first
        } else {
            Node::Then(Then {
                first: Box::new(first),
                next,
            })
        })
    }

    fn pipe(&mut self) -> Parsed<Node> {
        let of = self.source()?;
        let mut steps = Vec::new();
        while self.accept_kind(Kind::Pipe) {
            steps.push(self.step()?);
        }
        Ok(if steps.is_empty() {
            of
        } else {
            Node::Pipe(Pipe {
                of: Box::new(of),
                steps,
            })
        })
    }

    fn source(&mut self) -> Parsed<Node> {
        if self.accept_kind(Kind::Open) {
            let inside = self.sequence()?;
            if !self.accept_kind(Kind::Close) {
                return Err(self.expected("\")\"", &[]));
            }
            return Ok(inside);
        }
        if self.accept("spell") {
            return self.spell();
        }
        if self.accept("point") {
            return self.point();
        }
        if self.accept("cue") {
            return self.cue();
        }
        if self.accept("hamnosys") {
            let notation = self.notation("the symbols of a sign, in quotes")?;
            return Ok(Node::Hamnosys(notation));
        }
        if self.accept("sigml") {
            let notation = self.notation("a SiGML file or a notated sign")?;
            return Ok(Node::Sigml(notation));
        }
        if self
            .word()
            .is_some_and(|word| Step::words().contains(&word))
        {
            return Err(self.expected("a sign, \"spell\", \"point\" or \"(\"", &[]));
        }
        self.name("a sign, \"spell\", \"point\" or \"(\"")
            .map(Node::Sign)
    }

    fn notation(&mut self, what: &'static str) -> Parsed<Notation> {
        let mut notation = Notation {
            of: self.name(what)?,
            language: None,
            on: None,
        };
        loop {
            if self.accept("with") {
                let language = self.name("\"default\", \"measured\" or a file of body language")?;
                notation.language = Some(language);
            } else if self.accept("on") {
                notation.on = Some(self.name("a signer")?);
            } else {
                return Ok(notation);
            }
        }
    }

    fn spell(&mut self) -> Parsed<Node> {
        let mut spell = Spell {
            word: self.name("the word to spell")?,
            hand: Hands::Dominant,
            alphabet: None,
            hold: None,
            via: Transition::default(),
            on: None,
        };
        loop {
            if let Some(hand) = self.hand() {
                spell.hand = hand;
            } else if self.accept("with") {
                spell.alphabet = Some(self.name("an alphabet")?);
            } else if self.accept("hold") {
                spell.hold = Some(self.quantity("a time, such as 0.2s")?);
            } else if self.accept("on") {
                spell.on = Some(self.name("a signer")?);
            } else if let Some(via) = self.via()? {
                spell.via = via;
            } else {
                return Ok(Node::Spell(spell));
            }
        }
    }

    fn cue(&mut self) -> Parsed<Node> {
        let mut cue = Cue {
            text: self.name("the text to cue, in quotes")?,
            phones: None,
            code: None,
            variants: Vec::new(),
            hand: Hands::Dominant,
            phase: PhaseRule::default(),
            pace: None,
            on: None,
        };
        loop {
            if let Some(hand) = self.hand() {
                cue.hand = hand;
            } else if self.accept("as") {
                cue.phones = Some(self.name("an alphabet: sampa, ipa or mfa")?);
            } else if self.accept("with") {
                cue.code = Some(self.name("a code, such as french")?);
            } else if self.accept("variant") {
                cue.variants
                    .push(self.name("a habit of cuers, such as schwa-as-eu")?);
            } else if self.accept("by") {
                let rules = PhaseRule::ALL.map(PhaseRule::name);
                let rule = PhaseRule::ALL
                    .into_iter()
                    .find(|rule| self.word() == Some(rule.name()));
                cue.phase = rule.ok_or_else(|| self.expected("a rule of phases", &rules))?;
                self.at += 1;
            } else if self.accept("pace") {
                cue.pace = Some(self.quantity("a factor, such as 1.6")?);
            } else if self.accept("on") {
                cue.on = Some(self.name("a signer")?);
            } else {
                return Ok(Node::Cue(cue));
            }
        }
    }

    fn point(&mut self) -> Parsed<Node> {
        let hand = self.hand().unwrap_or(Hands::Dominant);
        self.expect("at", "a hand or \"at\"")?;
        let mut point = Point {
            hand,
            at: self.spot()?,
            with: None,
            hold: None,
            via: Transition::default(),
            on: None,
        };
        loop {
            if self.accept("with") {
                point.with = Some(self.choice()?);
            } else if self.accept("hold") {
                point.hold = Some(self.quantity("a time, such as 0.3s")?);
            } else if self.accept("on") {
                point.on = Some(self.name("a signer")?);
            } else if let Some(via) = self.via()? {
                point.via = via;
            } else {
                return Ok(Node::Point(point));
            }
        }
    }

    fn step(&mut self) -> Parsed<Step> {
        if let Some(word) = self.word().map(str::to_owned) {
            self.at += 1;
            if let Some(step) = Step::parse(self, &word) {
                return step;
            }
            self.at -= 1;
        }
        Err(self.expected("an operator", &Step::words()))
    }

    pub(crate) fn choice(&mut self) -> Parsed<Choice> {
        if self.accept("_") {
            return Ok(Choice::Keep);
        }
        if self.accept("from") {
            return self.name("a sign").map(Choice::From);
        }
        if let Some(query) = self.query()? {
            return Ok(Choice::Best(query));
        }
        self.name("a value, \"from\" and a sign, \"best(...)\" or \"_\"")
            .map(Choice::Value)
    }

    pub(crate) fn query(&mut self) -> Parsed<Option<String>> {
        let Some(token) = self.peek().filter(|token| token.kind == Kind::Query) else {
            return Ok(None);
        };
        let query = token.text.clone();
        Query::parse(&query).map_err(|error| self.fault(Problem::Query(error.to_string())))?;
        self.at += 1;
        Ok(Some(query))
    }

    pub(crate) fn spot(&mut self) -> Parsed<Spot> {
        if self.accept("me") {
            return Ok(Spot::Me);
        }
        if self.accept("you") {
            return Ok(Spot::You);
        }
        if self.word().and_then(Direction::from_word).is_some() {
            return self.directions().map(Spot::Towards);
        }
        if let Some(point) = self.spot_point()? {
            return Ok(Spot::Point(point));
        }
        self.name("me, you, a direction, a placement, or a point such as 30cm,140cm,50cm")
            .map(Spot::Value)
    }

    /// Reads three lengths with commas between, if a comma follows the first.
    pub(crate) fn spot_point(&mut self) -> Parsed<Option<[Length; 3]>> {
        let starts = self.is_length(self.at) && {
            let unit = self.tokens.get(self.at + 1);
            let after = if unit.is_some_and(|t| t.kind == Kind::Word) {
                2
            } else {
                1
            };
            self.tokens
                .get(self.at + after)
                .is_some_and(|t| t.kind == Kind::Comma)
        };
        if !starts {
            return Ok(None);
        }
        const WANTED: &str = "a length, such as 30cm";
        let mut point = [self.quantity(WANTED)?; 3];
        for slot in &mut point[1..] {
            if !self.accept_kind(Kind::Comma) {
                return Err(self.expected("a comma: a point has three lengths", &[]));
            }
            *slot = self.quantity(WANTED)?;
        }
        Ok(Some(point))
    }

    /// Reads legs, one after another; on a path they are separated by `then`.
    pub(crate) fn legs(&mut self, path: bool) -> Parsed<Vec<Leg>> {
        let mut legs = vec![self.leg(path)?];
        loop {
            if path && self.word() == Some("then") && self.is_leg(self.at + 1) {
                self.at += 1;
            } else if path || self.word().and_then(Direction::from_word).is_none() {
                return Ok(legs);
            }
            legs.push(self.leg(path)?);
        }
    }

    fn leg(&mut self, path: bool) -> Parsed<Leg> {
        let towards = self.directions()?;
        let distance = self.quantity("a length, such as 25cm")?;
        let time = if path && self.accept("in") {
            Some(self.quantity("a time, such as 0.4s")?)
        } else {
            None
        };
        Ok(Leg {
            towards,
            distance,
            time,
        })
    }

    fn is_leg(&self, mut at: usize) -> bool {
        let start = at;
        let is_direction =
            |t: &&Token| t.kind == Kind::Word && Direction::from_word(&t.text).is_some();
        while self.tokens.get(at).filter(is_direction).is_some() {
            at += 1;
        }
        at > start && self.is_length(at)
    }

    fn is_length(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|token| {
            let digits = token.text.trim_start_matches(['-', '+', '.']);
            token.kind == Kind::Word && digits.starts_with(|c: char| c.is_ascii_digit())
        })
    }

    pub(crate) fn directions(&mut self) -> Parsed<Vec<Direction>> {
        let mut all = Vec::new();
        while !(all.len() == 1 && self.word() == Some("in") && self.is_length(self.at + 1)) {
            let Some(direction) = self.direction() else {
                break;
            };
            all.push(direction);
        }
        if all.is_empty() {
            return Err(self.no_direction());
        }
        Ok(all)
    }

    pub(crate) fn direction(&mut self) -> Option<Direction> {
        let direction = self.word().and_then(Direction::from_word)?;
        self.at += 1;
        Some(direction)
    }

    pub(crate) fn no_direction(&self) -> TextError {
        let words = Direction::ALL.map(Direction::name);
        self.expected("a direction (left, right, up, down, forward, back)", &words)
    }

    pub(crate) fn hand(&mut self) -> Option<Hands> {
        let hand = self.word().and_then(Hands::from_word)?;
        self.at += 1;
        Some(hand)
    }

    pub(crate) fn via(&mut self) -> Parsed<Option<Transition>> {
        if !self.accept("via") {
            return Ok(None);
        }
        const WANTED: &str =
            "slerp, cosine, sigmoid, minimum-jerk, learned, or a time such as 0.2s";
        let mut via = Transition::default();
        if !self.is_length(self.at) {
            via.profile = Some(self.one_of(&Profile::ALL, Profile::name, WANTED)?);
        }
        if self.is_length(self.at) {
            via.time = Some(self.quantity(WANTED)?);
        }
        Ok(Some(via))
    }

    pub(crate) fn one_of<T: Copy>(
        &mut self,
        all: &[T],
        name: fn(T) -> &'static str,
        expected: &'static str,
    ) -> Parsed<T> {
        let found = all
            .iter()
            .copied()
            .find(|item| self.word() == Some(name(*item)));
        let found = found.ok_or_else(|| {
            let words: Vec<&str> = all.iter().map(|item| name(*item)).collect();
            self.expected(expected, &words)
        })?;
        self.at += 1;
        Ok(found)
    }

    /// Reads a number with its unit, which may be separated by a blank.
    pub(crate) fn quantity<T: FromStr<Err = UnitError>>(
        &mut self,
        expected: &'static str,
    ) -> Parsed<T> {
        if !self.is_length(self.at) {
            return Err(self.expected(expected, &[]));
        }
        let mut text = self.tokens[self.at].text.clone();
        let mut used = 1;
        let bare = text.parse::<f64>().is_ok();
        if let Some(unit) = self.tokens.get(self.at + 1)
            && bare
            && unit.kind == Kind::Word
            && [
                "mm", "cm", "m", "in", "inch", "inches", "%", "s", "sec", "ms", "deg", "°",
                "degrees",
            ]
            .contains(&unit.text.as_str())
        {
            text.push_str(&unit.text);
            used = 2;
        }
        let quantity = text
            .parse()
            .map_err(|error: UnitError| self.fault(Problem::Unit(error)))?;
        self.at += used;
        Ok(quantity)
    }

    /// Reads a name: a quoted text, or a word without another meaning.
    pub(crate) fn name(&mut self, expected: &'static str) -> Parsed<String> {
        let quoted = self.peek().filter(|token| token.kind == Kind::Quoted);
        let plain = || {
            self.peek()
                .filter(|token| token.kind == Kind::Word && token.text != "then")
        };
        let Some(token) = quoted.or_else(plain) else {
            return Err(self.expected(expected, &[]));
        };
        let name = token.text.clone();
        if name.is_empty() {
            return Err(self.expected(expected, &[]));
        }
        self.at += 1;
        Ok(name)
    }

    /// Reads a count.
    pub(crate) fn count(&mut self, expected: &'static str) -> Parsed<u32> {
        let count = self.word().and_then(|word| word.parse().ok());
        let count = count.ok_or_else(|| self.expected(expected, &[]))?;
        self.at += 1;
        Ok(count)
    }

    /// Reads two times with two dots between; one of them may be missing.
    pub(crate) fn cut(&mut self) -> Parsed<Cut> {
        const WANTED: &str = "two times with two dots between, such as 0.4s..1.9s";
        let start = self.at;
        let mut text = String::new();
        while let Some(word) = self.word().filter(|word| !["then", "by"].contains(word)) {
            text.push_str(word);
            self.at += 1;
        }
        let Some((from, to)) = text.split_once("..").filter(|_| text != "..") else {
            self.at = start;
            return Err(self.expected(WANTED, &[]));
        };
        let time = |text: &str| match text {
            "" => Ok(None),
            text => text.parse().map(Some),
        };
        let times = time(from).and_then(|from| Ok((from, time(to)?)));
        let (from, to) = times.map_err(|error: UnitError| {
            self.at = start;
            self.fault(Problem::Unit(error))
        })?;
        Ok(Cut { from, to })
    }

    /// Reads the points of a curve, with `then` between them.
    pub(crate) fn points(&mut self) -> Parsed<Vec<[Length; 3]>> {
        const WANTED: &str = "a point: left, up and forward, such as 10cm,5cm,0cm";
        let mut points = Vec::new();
        loop {
            let point = self.spot_point()?;
            points.push(point.ok_or_else(|| self.expected(WANTED, &[]))?);
            if self.word() != Some("then") || !self.is_point(self.at + 1) {
                return Ok(points);
            }
            self.at += 1;
        }
    }

    /// Returns whether a length followed by a comma is at `at`.
    fn is_point(&self, at: usize) -> bool {
        let comma = |at: usize| self.tokens.get(at).is_some_and(|it| it.kind == Kind::Comma);
        self.is_length(at) && (comma(at + 1) || comma(at + 2))
    }

    /// Returns whether a length comes after the next word.
    pub(crate) fn is_length_next(&self) -> bool {
        self.is_length(self.at + 1)
    }

    /// Returns the parser's position, for [`back_to`](Self::back_to).
    pub(crate) fn place(&self) -> usize {
        self.at
    }

    /// Returns to an earlier position.
    pub(crate) fn back_to(&mut self, place: usize) {
        self.at = place;
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    pub(crate) fn word(&self) -> Option<&str> {
        self.peek()
            .filter(|token| token.kind == Kind::Word)
            .map(|token| token.text.as_str())
    }

    pub(crate) fn accept(&mut self, word: &str) -> bool {
        let found = self.word() == Some(word);
        self.at += usize::from(found);
        found
    }

    /// Reads a comma if one is next.
    pub(crate) fn comma(&mut self) -> bool {
        self.accept_kind(Kind::Comma)
    }

    fn accept_kind(&mut self, kind: Kind) -> bool {
        let found = self.peek().is_some_and(|token| token.kind == kind);
        self.at += usize::from(found);
        found
    }

    pub(crate) fn expect(&mut self, word: &'static str, expected: &'static str) -> Parsed<()> {
        if self.accept(word) {
            Ok(())
        } else {
            Err(self.expected(expected, &[word]))
        }
    }

    pub(crate) fn expected(&self, expected: &'static str, words: &[&str]) -> TextError {
        let found = self.peek().map(|token| token.text.clone());
        let nearest = found
            .as_deref()
            .and_then(|found| chereme_sign::text::nearest(found, words.iter().copied()))
            .map(str::to_owned);
        self.fault(Problem::Expected {
            expected,
            found,
            nearest,
        })
    }

    fn fault(&self, problem: Problem) -> TextError {
        let at = self.peek().map_or(self.text.len(), |token| token.at.start);
        fault(self.text, at, problem)
    }
}
