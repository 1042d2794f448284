//! From text to the tree.

mod expression;
mod travel;

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

type Parsed<T> = Result<T, TextError>;

struct Parser<'a> {
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
        if let Some(word) = self.word().filter(|word| Step::WORDS.contains(word)) {
            let _ = word;
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
        let Some(word) = self.word().map(str::to_owned) else {
            return Err(self.expected("an operator", &Step::WORDS));
        };
        if !Step::WORDS.contains(&word.as_str()) {
            return Err(self.expected("an operator", &Step::WORDS));
        }
        if word != "from" && word != "to" {
            self.at += 1;
        }
        Ok(match word.as_str() {
            "configure" => Step::Configure(self.configure()?),
            "place" => Step::Place(self.place()?),
            "reverse" => Step::Reverse,
            "swap" => Step::Swap,
            "mirror" => Step::Mirror(Mirror {
                from: self.hand().unwrap_or(Hands::Dominant),
            }),
            "repeat" => Step::Repeat(self.repeat()?),
            "orient" => Step::Orient(self.orient()?),
            "amplify" => Step::Amplify(Amplify {
                hand: self.hand().unwrap_or(Hands::Both),
                by: self.quantity("a factor, such as 1.5 or 150%")?,
            }),
            "travel" => Step::Travel(self.travel()?),
            "retime" => Step::Retime(self.retime()?),
            "span" => Step::Span(self.cut()?),
            "trim" => Step::Trim,
            "nonmanual" => Step::Nonmanual(self.nonmanual()?),
            _ => Step::Indicate(self.indicate()?),
        })
    }

    fn configure(&mut self) -> Parsed<Configure> {
        let hand = self.hand().unwrap_or(Hands::Dominant);
        let mut values = vec![self.choice()?];
        while self.accept_kind(Kind::Comma) {
            values.push(self.choice()?);
        }
        let via = self.via()?.unwrap_or_default();
        Ok(Configure { hand, values, via })
    }

    fn choice(&mut self) -> Parsed<Choice> {
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

    fn query(&mut self) -> Parsed<Option<String>> {
        let Some(token) = self.peek().filter(|token| token.kind == Kind::Query) else {
            return Ok(None);
        };
        let query = token.text.clone();
        Query::parse(&query).map_err(|error| self.fault(Problem::Query(error.to_string())))?;
        self.at += 1;
        Ok(Some(query))
    }

    fn place(&mut self) -> Parsed<Place> {
        let hand = self.hand().unwrap_or(Hands::Both);
        let to = if self.accept("by") {
            Goal::By(self.legs(false)?)
        } else if self.accept("near") || self.accept("from") {
            let of = self.name("a sign")?;
            let by = if self.accept("by") {
                self.legs(false)?
            } else {
                Vec::new()
            };
            Goal::Near { of, by }
        } else if self.accept("at") {
            match self.query()? {
                Some(query) => Goal::Best(query),
                None => match self.spot_point()? {
                    Some(point) => Goal::AtPoint(point),
                    None => Goal::At(self.name("a placement or a point such as 0cm,120cm,30cm")?),
                },
            }
        } else {
            return Err(self.expected(
                "a hand, \"by\", \"at\" or \"near\"",
                &[
                    "by", "at", "near", "right", "left", "both", "dominant", "weak",
                ],
            ));
        };
        let mut place = Place {
            hand,
            to,
            with: None,
            solver: Solver::Analytic,
        };
        loop {
            if self.accept("with") {
                place.with =
                    Some(self.one_of(&HandPoint::ALL, HandPoint::name, "a point of the hand")?);
            } else if self.accept("using") {
                let name = |solver: Solver| match solver {
                    Solver::Analytic => "analytic",
                    Solver::Fabrik => "fabrik",
                };
                place.solver =
                    self.one_of(&[Solver::Analytic, Solver::Fabrik], name, "a solver")?;
            } else {
                return Ok(place);
            }
        }
    }

    fn repeat(&mut self) -> Parsed<Repeat> {
        let times = self.word().and_then(|word| word.parse::<u32>().ok());
        let Some(times) = times else {
            return Err(self.expected("how often, such as 2", &[]));
        };
        self.at += 1;
        let mut repeat = Repeat {
            times,
            scale: None,
            tempo: None,
            gap: None,
            via: Transition::default(),
        };
        loop {
            if self.accept("scale") {
                repeat.scale = Some(self.quantity("a factor, such as 0.8")?);
            } else if self.accept("tempo") {
                repeat.tempo = Some(self.quantity("a factor, such as 1.2")?);
            } else if self.accept("gap") {
                repeat.gap = Some(self.quantity("a time, such as 0.1s")?);
            } else if let Some(via) = self.via()? {
                repeat.via = via;
            } else {
                return Ok(repeat);
            }
        }
    }

    fn orient(&mut self) -> Parsed<Orient> {
        let mut orient = Orient {
            hand: self.hand().unwrap_or(Hands::Dominant),
            palm: Vec::new(),
            fingers: Vec::new(),
            by: Vec::new(),
        };
        let start = self.at;
        loop {
            if self.accept("palm") {
                orient.palm = self.directions()?;
            } else if self.accept("fingers") {
                orient.fingers = self.directions()?;
            } else if self.accept("by") {
                let angle = self.quantity("an angle, such as 30deg")?;
                self.expect("about", "\"about\" and a direction")?;
                let about = self.direction().ok_or_else(|| self.no_direction())?;
                orient.by.push(Turn { angle, about });
            } else if self.at == start {
                let words = ["palm", "fingers", "by"];
                return Err(self.expected("\"palm\", \"fingers\" or \"by\"", &words));
            } else {
                return Ok(orient);
            }
        }
    }

    fn retime(&mut self) -> Parsed<Retime> {
        let mut paces = Vec::new();
        loop {
            paces.push(if self.accept("to") {
                Pace::To(self.quantity("a time, such as 2s")?)
            } else {
                Pace::Times(self.quantity("a factor, such as 150%, or \"to\" and a time")?)
            });
            if !self.accept_kind(Kind::Comma) {
                return Ok(Retime { paces });
            }
        }
    }

    fn indicate(&mut self) -> Parsed<Indicate> {
        let from = if self.accept("from") {
            Some(self.spot()?)
        } else {
            None
        };
        let to = if self.accept("to") {
            Some(self.spot()?)
        } else {
            None
        };
        let hand = if self.accept("with") {
            self.hand().ok_or_else(|| self.expected("a hand", &[]))?
        } else {
            Hands::Both
        };
        Ok(Indicate { hand, from, to })
    }

    fn spot(&mut self) -> Parsed<Spot> {
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

    /// Reads three lengths with commas between, where a comma follows the first.
    fn spot_point(&mut self) -> Parsed<Option<[Length; 3]>> {
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

    /// Reads one leg after another; on a path `then` stands between them.
    fn legs(&mut self, path: bool) -> Parsed<Vec<Leg>> {
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

    fn directions(&mut self) -> Parsed<Vec<Direction>> {
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

    fn direction(&mut self) -> Option<Direction> {
        let direction = self.word().and_then(Direction::from_word)?;
        self.at += 1;
        Some(direction)
    }

    fn no_direction(&self) -> TextError {
        let words = Direction::ALL.map(Direction::name);
        self.expected("a direction (left, right, up, down, forward, back)", &words)
    }

    fn hand(&mut self) -> Option<Hands> {
        let hand = self.word().and_then(Hands::from_word)?;
        self.at += 1;
        Some(hand)
    }

    fn via(&mut self) -> Parsed<Option<Transition>> {
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

    fn one_of<T: Copy>(
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

    /// Reads a number with its unit, which may stand apart.
    fn quantity<T: FromStr<Err = UnitError>>(&mut self, expected: &'static str) -> Parsed<T> {
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

    /// Reads a name: a quoted text, or a word that means nothing else.
    fn name(&mut self, expected: &'static str) -> Parsed<String> {
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

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn word(&self) -> Option<&str> {
        self.peek()
            .filter(|token| token.kind == Kind::Word)
            .map(|token| token.text.as_str())
    }

    fn accept(&mut self, word: &str) -> bool {
        let found = self.word() == Some(word);
        self.at += usize::from(found);
        found
    }

    fn accept_kind(&mut self, kind: Kind) -> bool {
        let found = self.peek().is_some_and(|token| token.kind == kind);
        self.at += usize::from(found);
        found
    }

    fn expect(&mut self, word: &'static str, expected: &'static str) -> Parsed<()> {
        if self.accept(word) {
            Ok(())
        } else {
            Err(self.expected(expected, &[word]))
        }
    }

    fn expected(&self, expected: &'static str, words: &[&str]) -> TextError {
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
