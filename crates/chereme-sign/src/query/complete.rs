//! Completion of a query at a cursor.

use super::lex::{Cursor, WordContext, is_quote};
use super::tree::{At, Missing, Property, TextField, TimeField};
use super::words::{self, Simple};
use super::{MAX_CHARS, compare, values};
use crate::component::{Component, Field};
use crate::relation::Relation;
use crate::text::fold;
use std::ops::Range;

/// The kind of text that may follow at a place of a query, and the characters that a completion replaces.
#[derive(Debug, Clone, PartialEq)]
pub struct Completion {
    /// The kind of thing that could stand here.
    pub expected: Expected,
    /// The part of the word before the cursor, without an opening quote.
    pub prefix: String,
    /// The characters (not bytes) that a completion replaces, quotes included; empty if nothing is written yet.
    pub replace: Range<usize>,
    /// The words of the language itself that begin with the prefix, in the order of offering. Only the caller knows
    /// values of inventories, names of signers and so on.
    pub words: Vec<&'static str>,
}

/// The kind of thing that could stand at a place.
#[derive(Debug, Clone, PartialEq)]
pub enum Expected {
    /// A term: the name of a field, a joint, a relation, or a word to search for.
    Term,
    /// The field of the comparison on the right of a relation.
    Annotation,
    /// The name of a component, after `on`.
    Component,
    /// The part of this component, after its dot: `nonmanual.`
    Part(Component),
    /// A value of this component.
    Value(Field),
    /// A feature of a value of this component, without a minus before it.
    Feature(Field),
    /// A value of this property.
    Property(Property),
    /// A text, or a word of it.
    Text(TextField),
    /// A time with its unit.
    Time(TimeField),
    /// The distance after `within`.
    Distance,
    /// The reference of the distance after `within`.
    Reference,
    /// The name of a tier, in parentheses.
    TierName,
    /// A value on the tier of this name.
    TierValue(String),
    /// The token or sign to resemble, after `like`.
    Example,
    /// A term, or `on` and components, after an example.
    AfterExample,
    /// A value of a field that does not exist.
    Unknown,
}

/// Returns the completions at the character `cursor` of `text`; a cursor beyond the end counts as the end.
///
/// The text need not be a valid query. Text after the cursor matters only as the rest of a word that a completion would
/// replace.
#[must_use]
pub fn complete(text: &str, cursor: usize) -> Completion {
    let chars: Vec<char> = text.chars().take(MAX_CHARS).collect();
    let before = &chars[..cursor.min(chars.len())];
    let mut scan = Scan {
        cursor: Cursor::new(before),
        len: before.len(),
    };
    let (expected, prefix_at) = scan.run();
    finish(&chars, before.len(), expected, prefix_at)
}

fn finish(chars: &[char], cursor: usize, expected: Expected, at: At) -> Completion {
    let quoted = chars.get(at.start).is_some_and(|c| is_quote(*c)) && at.start < cursor;
    let written = at.start + usize::from(quoted);
    let mut prefix: String = chars[written..cursor].iter().collect();
    let (mut expected, mut start) = (expected, at.start);
    let names_field = matches!(
        expected,
        Expected::Term | Expected::Annotation | Expected::Component | Expected::AfterExample
    );
    let mut dotted = false;
    if names_field
        && !quoted
        && let Some((head, last)) = prefix.rsplit_once('.')
    {
        let component = head
            .rsplit('.')
            .next()
            .and_then(|part| words::part(part).parse().ok());
        start = cursor - last.chars().count();
        dotted = true;
        expected = component.map_or(expected, Expected::Part);
        prefix = last.to_owned();
    }
    let end = if quoted {
        cursor + usize::from(chars.get(cursor).is_some_and(|c| is_quote(*c)))
    } else {
        let mut rest = Cursor::new(chars);
        rest.pos = cursor;
        rest.bare(if names_field {
            WordContext::Term
        } else {
            WordContext::Value
        })
        .end
    };
    let words = if quoted {
        Vec::new()
    } else {
        fixed_words(&expected, dotted, &fold(&prefix))
    };
    Completion {
        expected,
        prefix,
        replace: start..end,
        words,
    }
}

fn fixed_words(expected: &Expected, dotted: bool, prefix: &str) -> Vec<&'static str> {
    let fields = || words::part_names().chain(words::simple_names());
    let terms = || {
        let relations = Relation::PLAIN.into_iter().map(|(name, _)| name);
        fields()
            .chain(["or", "not", words::LIKE])
            .chain(relations)
            .chain([words::WITHIN])
    };
    let all: Vec<&'static str> = match expected {
        Expected::Term | Expected::AfterExample | Expected::Annotation | Expected::Component
            if dotted =>
        {
            words::part_names().collect()
        }
        Expected::Term => terms().collect(),
        Expected::AfterExample => [words::ON].into_iter().chain(terms()).collect(),
        Expected::Annotation => {
            let texts = TextField::ALL.into_iter().map(TextField::name);
            words::part_names()
                .chain(texts)
                .chain([words::TIER])
                .collect()
        }
        Expected::Component => words::part_names().collect(),
        Expected::Property(property) => property.fixed_values().unwrap_or(&["*", "unset"]).to_vec(),
        Expected::Value(_) => ["*"]
            .into_iter()
            .chain(Missing::ALL.map(Missing::name))
            .collect(),
        Expected::Reference => words::WITHIN_KINDS.to_vec(),
        Expected::Example => vec!["token:", "sign:"],
        _ => Vec::new(),
    };
    all.into_iter()
        .filter(|word| fold(word).starts_with(prefix))
        .collect()
}

/// A lenient reading of the text before the cursor.
struct Scan<'a> {
    cursor: Cursor<'a>,
    len: usize,
}

/// The kind of text at the cursor, and its start.
type Found = (Expected, At);

impl Scan<'_> {
    fn run(&mut self) -> Found {
        let mut expected = Expected::Term;
        loop {
            self.cursor.skip_blanks();
            let start = self.cursor.pos;
            if self.ended() {
                return (expected, self.cursor.at(start));
            }
            expected = match self.step(expected) {
                Ok(next) => next,
                Err(found) => return found,
            };
        }
    }

    fn ended(&self) -> bool {
        self.cursor.pos >= self.len
    }

    /// Reads one element; returns as an error the result of the scan, if the cursor lies in the element.
    fn step(&mut self, expected: Expected) -> Result<Expected, Found> {
        match self.cursor.peek() {
            Some(c) if is_quote(c) => self
                .word(&expected, WordContext::Term)
                .map(|()| after_word(&expected)),
            Some(',') if expected == Expected::Term => {
                self.cursor.pos += 1;
                Ok(Expected::Component)
            }
            Some('(' | ')' | ',') => {
                self.cursor.pos += 1;
                Ok(Expected::Term)
            }
            _ if expected == Expected::Example || expected == Expected::Distance => {
                let place = WordContext::Value;
                self.word(&expected, place).map(|()| after_word(&expected))
            }
            _ => self.term(expected),
        }
    }

    /// Reads a word; returns as an error the result of the scan, if the cursor is at its end.
    fn word(&mut self, expected: &Expected, place: WordContext) -> Result<(), Found> {
        let start = self.cursor.pos;
        let closed = self.cursor.word(place).is_ok();
        let quoted = self.cursor.pos > start + 1 && self.quote_at(start);
        if self.cursor.pos == start {
            self.cursor.pos += 1;
        }
        if !closed || self.ended() && !quoted {
            let end = self.len;
            return Err((expected.clone(), At { start, end }));
        }
        Ok(())
    }

    fn quote_at(&self, pos: usize) -> bool {
        self.cursor
            .text(At {
                start: pos,
                end: pos + 1,
            })
            .chars()
            .all(is_quote)
    }

    /// Reads a word and the operator, values or parenthesis that belong to it.
    fn term(&mut self, expected: Expected) -> Result<Expected, Found> {
        let start = self.cursor.pos;
        self.word(&expected, WordContext::Term)?;
        let at = self.cursor.at(start);
        let name = self.cursor.text(at);
        self.cursor.skip_blanks();
        if let Some(operator) = self.cursor.operator() {
            self.cursor.pos += operator.chars().count();
            if expected == Expected::Component {
                // A weight: no value can be proposed.
                self.word(&Expected::Unknown, WordContext::Value)?;
            } else {
                self.values(&self.subject(at), operator)?;
            }
            return Ok(Expected::Term);
        }
        if name == words::TIER && self.cursor.eat('(') {
            return self.tier();
        }
        if expected == Expected::Component {
            return Ok(Expected::Term);
        }
        Ok(match &name[..] {
            _ if words::plain_relation(&name).is_some() => Expected::Annotation,
            words::WITHIN => Expected::Distance,
            words::LIKE => Expected::Example,
            words::ON if expected == Expected::AfterExample => Expected::Component,
            "of" if expected == Expected::Reference => Expected::Reference,
            _ if expected == Expected::Reference => Expected::Annotation,
            _ => Expected::Term,
        })
    }

    fn subject(&self, at: At) -> Expected {
        match words::simple_field(&self.cursor.text(at)) {
            Some(Simple::Text(field)) => Expected::Text(field),
            Some(Simple::Property(property)) => Expected::Property(property),
            Some(Simple::Time(field)) => Expected::Time(field),
            None => compare::component(&self.cursor, at).map_or(Expected::Unknown, Expected::Value),
        }
    }

    /// Reads values separated by commas.
    fn values(&mut self, expected: &Expected, operator: &str) -> Result<(), Found> {
        loop {
            self.cursor.skip_blanks();
            let start = self.cursor.pos;
            if self.ended() {
                return Err((expected.clone(), self.cursor.at(start)));
            }
            match (self.cursor.peek(), expected) {
                (Some('['), Expected::Value(field)) => self.features(field)?,
                _ => self.word(expected, WordContext::Value)?,
            }
            if operator == "~" && self.cursor.eat('~') {
                self.word(&Expected::Unknown, WordContext::Value)?;
            }
            let mut ahead = self.cursor.clone();
            ahead.skip_blanks();
            if !ahead.eat(',') {
                return Ok(());
            }
            self.cursor = ahead;
        }
    }

    fn features(&mut self, field: &Field) -> Result<(), Found> {
        self.cursor.pos += 1;
        let mut start = self.cursor.pos;
        loop {
            match self.cursor.peek() {
                None => return Err((Expected::Feature(field.clone()), self.cursor.at(start))),
                Some(']') => break,
                Some('-' | '−' | '–' | '+') if start == self.cursor.pos => start += 1,
                Some(c) if !values::is_feature_char(c) => start = self.cursor.pos + 1,
                Some(_) => {}
            }
            self.cursor.pos += 1;
        }
        self.cursor.pos += 1;
        Ok(())
    }

    /// Reads a tier's name, its parenthesis and its values.
    fn tier(&mut self) -> Result<Expected, Found> {
        self.cursor.skip_blanks();
        let start = self.cursor.pos;
        if self.ended() {
            return Err((Expected::TierName, self.cursor.at(start)));
        }
        self.word(&Expected::TierName, WordContext::Value)?;
        let name = self.cursor.text(self.cursor.at(start));
        let name = name.trim_matches(is_quote).to_owned();
        self.cursor.skip_blanks();
        self.cursor.eat(')');
        self.cursor.skip_blanks();
        if let Some(operator) = self.cursor.operator() {
            self.cursor.pos += operator.chars().count();
            self.values(&Expected::TierValue(name), operator)?;
        }
        Ok(Expected::Term)
    }
}

fn after_word(expected: &Expected) -> Expected {
    match expected {
        Expected::Example => Expected::AfterExample,
        Expected::Distance => Expected::Reference,
        _ => Expected::Term,
    }
}
