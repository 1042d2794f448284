//! Completion of a query at a cursor.

use super::query_lex::{QueryCursor, WordContext, is_quote};
use super::query_tree::{MissingReason, QueryPlace, TextField, TimeField, WholeTokenProperty};
use super::query_words::{self, SimpleField};
use super::{MAX_CHARS, query_compare, query_values};
use crate::component::{ComponentField, SignComponent};
use crate::relation::TimeRelation;
use crate::text::fold_text;
use std::ops::Range;

/// The kind of text that may follow at a place of a query, and the characters that a completion replaces.
#[derive(Debug, Clone, PartialEq)]
pub struct CursorCompletion {
    /// The kind of thing that could stand here.
    pub expected: ExpectedText,
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
pub enum ExpectedText {
    /// A term: the name of a field, a joint, a relation, or a word to search for.
    Term,
    /// The field of the comparison on the right of a relation.
    Annotation,
    /// The name of a component, after `on`.
    Component,
    /// The part of this component, after its dot: `nonmanual.`
    Part(SignComponent),
    /// A value of this component.
    Value(ComponentField),
    /// A feature of a value of this component, without a minus before it.
    Feature(ComponentField),
    /// A value of this property.
    Property(WholeTokenProperty),
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
pub fn complete_query(text: &str, cursor: usize) -> CursorCompletion {
    let chars: Vec<char> = text.chars().take(MAX_CHARS).collect();
    let before = &chars[..cursor.min(chars.len())];
    let mut scan = CompletionScan {
        cursor: QueryCursor::new(before),
        len: before.len(),
    };
    let (expected, prefix_at) = scan.run();
    finish_completion(&chars, before.len(), expected, prefix_at)
}

fn finish_completion(chars: &[char], cursor: usize, expected: ExpectedText, at: QueryPlace) -> CursorCompletion {
    let quoted = chars.get(at.start).is_some_and(|c| is_quote(*c)) && at.start < cursor;
    let written = at.start + usize::from(quoted);
    let mut prefix: String = chars[written..cursor].iter().collect();
    let (mut expected, mut start) = (expected, at.start);
    let names_field = matches!(
        expected,
        ExpectedText::Term | ExpectedText::Annotation | ExpectedText::Component | ExpectedText::AfterExample
    );
    let mut dotted = false;
    if names_field
        && !quoted
        && let Some((head, last)) = prefix.rsplit_once('.')
    {
        let component = head
            .rsplit('.')
            .next()
            .and_then(|part| query_words::canonical_part_name(part).parse().ok());
        start = cursor - last.chars().count();
        dotted = true;
        expected = component.map_or(expected, ExpectedText::Part);
        prefix = last.to_owned();
    }
    let end = if quoted {
        cursor + usize::from(chars.get(cursor).is_some_and(|c| is_quote(*c)))
    } else {
        let mut rest = QueryCursor::new(chars);
        rest.pos = cursor;
        rest.skip_bare_word(if names_field {
            WordContext::Term
        } else {
            WordContext::Value
        })
        .end
    };
    let words = if quoted {
        Vec::new()
    } else {
        fixed_words(&expected, dotted, &fold_text(&prefix))
    };
    CursorCompletion {
        expected,
        prefix,
        replace: start..end,
        words,
    }
}

fn fixed_words(expected: &ExpectedText, dotted: bool, prefix: &str) -> Vec<&'static str> {
    let fields = || query_words::part_names().chain(query_words::simple_names());
    let terms = || {
        let relations = TimeRelation::PLAIN_RELATIONS.into_iter().map(|(name, _)| name);
        fields()
            .chain(["or", "not", query_words::LIKE_WORD])
            .chain(relations)
            .chain([query_words::WITHIN_WORD])
    };
    let all: Vec<&'static str> = match expected {
        ExpectedText::Term | ExpectedText::AfterExample | ExpectedText::Annotation | ExpectedText::Component
            if dotted =>
        {
            query_words::part_names().collect()
        }
        ExpectedText::Term => terms().collect(),
        ExpectedText::AfterExample => [query_words::ON_WORD].into_iter().chain(terms()).collect(),
        ExpectedText::Annotation => {
            let texts = TextField::ALL_TEXT_FIELDS.into_iter().map(TextField::text_field_name);
            query_words::part_names()
                .chain(texts)
                .chain([query_words::TIER_WORD])
                .collect()
        }
        ExpectedText::Component => query_words::part_names().collect(),
        ExpectedText::Property(property) => property.fixed_values().unwrap_or(&["*", "unset"]).to_vec(),
        ExpectedText::Value(_) => ["*"]
            .into_iter()
            .chain(MissingReason::ALL_MISSING_REASONS.map(MissingReason::missing_reason_name))
            .collect(),
        ExpectedText::Reference => query_words::WITHIN_KINDS.to_vec(),
        ExpectedText::Example => vec!["token:", "sign:"],
        _ => Vec::new(),
    };
    all.into_iter()
        .filter(|word| fold_text(word).starts_with(prefix))
        .collect()
}

/// A lenient reading of the text before the cursor.
struct CompletionScan<'a> {
    cursor: QueryCursor<'a>,
    len: usize,
}

/// The kind of text at the cursor, and its start.
type ExpectedAtCursor = (ExpectedText, QueryPlace);

impl CompletionScan<'_> {
    fn run(&mut self) -> ExpectedAtCursor {
        let mut expected = ExpectedText::Term;
        loop {
            self.cursor.skip_blanks();
            let start = self.cursor.pos;
            if self.is_scan_ended() {
                return (expected, self.cursor.place_since(start));
            }
            expected = match self.scan_element(expected) {
                Ok(next) => next,
                Err(found) => return found,
            };
        }
    }

    fn is_scan_ended(&self) -> bool {
        self.cursor.pos >= self.len
    }

    /// Reads one element; returns as an error the result of the scan, if the cursor lies in the element.
    fn scan_element(&mut self, expected: ExpectedText) -> Result<ExpectedText, ExpectedAtCursor> {
        match self.cursor.peek_char() {
            Some(c) if is_quote(c) => self
                .scan_word(&expected, WordContext::Term)
                .map(|()| after_word(&expected)),
            Some(',') if expected == ExpectedText::Term => {
                self.cursor.pos += 1;
                Ok(ExpectedText::Component)
            }
            Some('(' | ')' | ',') => {
                self.cursor.pos += 1;
                Ok(ExpectedText::Term)
            }
            _ if expected == ExpectedText::Example || expected == ExpectedText::Distance => {
                let place = WordContext::Value;
                self.scan_word(&expected, place).map(|()| after_word(&expected))
            }
            _ => self.scan_term(expected),
        }
    }

    /// Reads a word; returns as an error the result of the scan, if the cursor is at its end.
    fn scan_word(&mut self, expected: &ExpectedText, place: WordContext) -> Result<(), ExpectedAtCursor> {
        let start = self.cursor.pos;
        let closed = self.cursor.read_query_word(place).is_ok();
        let quoted = self.cursor.pos > start + 1 && self.quote_at(start);
        if self.cursor.pos == start {
            self.cursor.pos += 1;
        }
        if !closed || self.is_scan_ended() && !quoted {
            let end = self.len;
            return Err((expected.clone(), QueryPlace { start, end }));
        }
        Ok(())
    }

    fn quote_at(&self, pos: usize) -> bool {
        self.cursor
            .text_at_place(QueryPlace {
                start: pos,
                end: pos + 1,
            })
            .chars()
            .all(is_quote)
    }

    /// Reads a word and the operator, values or parenthesis that belong to it.
    fn scan_term(&mut self, expected: ExpectedText) -> Result<ExpectedText, ExpectedAtCursor> {
        let start = self.cursor.pos;
        self.scan_word(&expected, WordContext::Term)?;
        let name_at = self.cursor.place_since(start);
        let name = self.cursor.text_at_place(name_at);
        self.cursor.skip_blanks();
        if let Some(operator) = self.cursor.peek_operator() {
            self.cursor.pos += operator.chars().count();
            if expected == ExpectedText::Component {
                // A weight: no value can be proposed.
                self.scan_word(&ExpectedText::Unknown, WordContext::Value)?;
            } else {
                self.scan_values(&self.expected_subject(name_at), operator)?;
            }
            return Ok(ExpectedText::Term);
        }
        if name == query_words::TIER_WORD && self.cursor.eat_char('(') {
            return self.scan_tier();
        }
        if expected == ExpectedText::Component {
            return Ok(ExpectedText::Term);
        }
        Ok(match &name[..] {
            _ if query_words::plain_relation(&name).is_some() => ExpectedText::Annotation,
            query_words::WITHIN_WORD => ExpectedText::Distance,
            query_words::LIKE_WORD => ExpectedText::Example,
            query_words::ON_WORD if expected == ExpectedText::AfterExample => ExpectedText::Component,
            "of" if expected == ExpectedText::Reference => ExpectedText::Reference,
            _ if expected == ExpectedText::Reference => ExpectedText::Annotation,
            _ => ExpectedText::Term,
        })
    }

    fn expected_subject(&self, at: QueryPlace) -> ExpectedText {
        match query_words::simple_field(&self.cursor.text_at_place(at)) {
            Some(SimpleField::Text(field)) => ExpectedText::Text(field),
            Some(SimpleField::Property(property)) => ExpectedText::Property(property),
            Some(SimpleField::Time(field)) => ExpectedText::Time(field),
            None => query_compare::parse_component_field(&self.cursor, at)
                .map_or(ExpectedText::Unknown, ExpectedText::Value),
        }
    }

    /// Reads values separated by commas.
    fn scan_values(&mut self, expected: &ExpectedText, operator: &str) -> Result<(), ExpectedAtCursor> {
        loop {
            self.cursor.skip_blanks();
            let start = self.cursor.pos;
            if self.is_scan_ended() {
                return Err((expected.clone(), self.cursor.place_since(start)));
            }
            match (self.cursor.peek_char(), expected) {
                (Some('['), ExpectedText::Value(field)) => self.scan_features(field)?,
                _ => self.scan_word(expected, WordContext::Value)?,
            }
            if operator == "~" && self.cursor.eat_char('~') {
                self.scan_word(&ExpectedText::Unknown, WordContext::Value)?;
            }
            let mut ahead = self.cursor.clone();
            ahead.skip_blanks();
            if !ahead.eat_char(',') {
                return Ok(());
            }
            self.cursor = ahead;
        }
    }

    fn scan_features(&mut self, field: &ComponentField) -> Result<(), ExpectedAtCursor> {
        self.cursor.pos += 1;
        let mut start = self.cursor.pos;
        loop {
            match self.cursor.peek_char() {
                None => {
                    return Err((ExpectedText::Feature(field.clone()), self.cursor.place_since(start)));
                }
                Some(']') => break,
                Some('-' | '−' | '–' | '+') if start == self.cursor.pos => start += 1,
                Some(c) if !query_values::is_feature_char(c) => start = self.cursor.pos + 1,
                Some(_) => {}
            }
            self.cursor.pos += 1;
        }
        self.cursor.pos += 1;
        Ok(())
    }

    /// Reads a tier's name, its parenthesis and its values.
    fn scan_tier(&mut self) -> Result<ExpectedText, ExpectedAtCursor> {
        self.cursor.skip_blanks();
        let start = self.cursor.pos;
        if self.is_scan_ended() {
            return Err((ExpectedText::TierName, self.cursor.place_since(start)));
        }
        self.scan_word(&ExpectedText::TierName, WordContext::Value)?;
        let quoted_name = self.cursor.text_at_place(self.cursor.place_since(start));
        let name = quoted_name.trim_matches(is_quote).to_owned();
        self.cursor.skip_blanks();
        self.cursor.eat_char(')');
        self.cursor.skip_blanks();
        if let Some(operator) = self.cursor.peek_operator() {
            self.cursor.pos += operator.chars().count();
            self.scan_values(&ExpectedText::TierValue(name), operator)?;
        }
        Ok(ExpectedText::Term)
    }
}

fn after_word(expected: &ExpectedText) -> ExpectedText {
    match expected {
        ExpectedText::Example => ExpectedText::AfterExample,
        ExpectedText::Distance => ExpectedText::Reference,
        _ => ExpectedText::Term,
    }
}
