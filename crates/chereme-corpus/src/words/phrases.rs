//! Phrases in English and in another language, from the files of words in `schema/words`.
//!
//! `schema/words/LANGUAGE/ROOM.ftl` holds the phrases of a room in Fluent's syntax. A phrase has the same id in all languages;
//! the id begins with its kind: `message`, `help`, `title`, `guide`, `line`, `history` or `noun`.
//! A `message` is recognised in a finished text; a `line` is looked up by its English form and filled, so that no name is part of
//! what is looked at. Comments in the files are for translators.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement};
use fluent_syntax::parser;
use include_dir::{Dir, include_dir};

use super::Language;
use super::parts::find_unquoted;

/// The files of words, in one folder for each language.
pub(super) static WORD_FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../schema/words");

/// A piece of a phrase.
#[derive(Debug, Clone, PartialEq, Eq)]
enum PhrasePart {
    /// Words of the phrase itself.
    Words(String),
    /// The name of a variable part.
    Blank(String),
}

/// A phrase with blanks for its variable parts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Phrase(Vec<PhrasePart>);

impl Phrase {
    /// Reads a phrase in which `{name}` is a variable part.
    pub(super) fn from_form(form: &str) -> Self {
        let mut phrase = Self::default();
        let mut rest = form;
        while let Some((words, after)) = rest.split_once('{') {
            phrase.add_words(words);
            let (name, after) = after.split_once('}').unwrap_or((after, ""));
            phrase.0.push(PhrasePart::Blank(name.to_owned()));
            rest = after;
        }
        phrase.add_words(rest);
        phrase
    }

    fn from_pattern(pattern: &Pattern<&str>) -> Self {
        let mut phrase = Self::default();
        for element in &pattern.elements {
            match element {
                PatternElement::TextElement { value } => phrase.add_words(value),
                PatternElement::Placeable { expression } => match expression {
                    Expression::Inline(InlineExpression::VariableReference { id }) => {
                        phrase.0.push(PhrasePart::Blank(id.name.to_owned()));
                    }
                    Expression::Inline(InlineExpression::StringLiteral { value }) => {
                        phrase.add_words(value);
                    }
                    // Nothing else stands in the files; a test reads them all.
                    _ => phrase.0.push(PhrasePart::Blank("unknown".to_owned())),
                },
            }
        }
        phrase
    }

    fn add_words(&mut self, words: &str) {
        match self.0.last_mut() {
            Some(PhrasePart::Words(last)) => last.push_str(words),
            _ if words.is_empty() => {}
            _ => self.0.push(PhrasePart::Words(words.to_owned())),
        }
    }

    /// Returns the phrase with its blanks filled by `value`, which gets the name of a blank.
    pub(super) fn filled(&self, value: impl Fn(&str) -> String) -> String {
        let part = |part: &PhrasePart| match part {
            PhrasePart::Words(words) => words.clone(),
            PhrasePart::Blank(name) => value(name),
        };
        self.0.iter().map(part).collect()
    }

    /// Returns the names of its blanks in their order.
    pub(super) fn blank_names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|part| match part {
            PhrasePart::Blank(name) => Some(name.as_str()),
            PhrasePart::Words(_) => None,
        })
    }

    /// Returns the phrase as a form, in which `{name}` is a variable part.
    pub(super) fn form(&self) -> String {
        self.filled(|name| format!("{{{name}}}"))
    }

    /// Returns the number of bytes of its own words.
    fn own_length(&self) -> usize {
        let length = |part: &PhrasePart| match part {
            PhrasePart::Words(words) => words.len(),
            PhrasePart::Blank(_) => 0,
        };
        self.0.iter().map(length).sum()
    }

    /// Returns the names of its blanks with what stands for them in `text`; nothing if `text` is not this phrase.
    pub(super) fn blanks_in<'t>(&self, text: &'t str) -> Option<Vec<(&str, &'t str)>> {
        let has_lines =
            |part: &PhrasePart| matches!(part, PhrasePart::Words(words) if words.contains('\n'));
        // A phrase of one line fits no text of several, whose parts it would mix.
        if text.contains('\n') && !self.0.iter().any(has_lines) {
            return None;
        }
        let mut values = Vec::new();
        let mut rest = text;
        for (index, part) in self.0.iter().enumerate() {
            match part {
                PhrasePart::Words(words) => rest = rest.strip_prefix(words.as_str())?,
                PhrasePart::Blank(name) => {
                    let end = match self.0.get(index + 1) {
                        Some(PhrasePart::Words(words)) => find_unquoted(rest, words)?,
                        _ => rest.len(),
                    };
                    values.push((name.as_str(), &rest[..end]));
                    rest = &rest[end..];
                }
            }
        }
        rest.is_empty().then_some(values)
    }
}

/// A phrase in English and in another language.
#[derive(Debug, Clone)]
pub(super) struct PhrasePair {
    pub(super) english: Phrase,
    pub(super) other: Phrase,
}

impl PhrasePair {
    /// Returns `text`, which is the English phrase, in the other language, each variable part converted by `convert`, which
    /// also gets the name of the blank; nothing if `text` is not this phrase.
    pub(super) fn translate(
        &self,
        text: &str,
        convert: &dyn Fn(&str, &str) -> String,
    ) -> Option<String> {
        let values = self.english.blanks_in(text)?;
        let value = |name: &str| {
            let known = values.iter().find(|(known, _)| *known == name);
            known.map_or_else(String::new, |(name, value)| convert(name, value))
        };
        Some(self.other.filled(value))
    }
}

/// All phrases of a language beside their English forms.
#[derive(Debug, Default)]
pub(super) struct PhraseBook {
    /// Messages, those with most words of their own first: a text that two of them fit is the one that says more of it.
    pub(super) messages: Vec<PhrasePair>,
    /// The forms of texts by kind (`help`, `title`, `guide`, `line` or `message`) and English form.
    fixed_texts: BTreeMap<(String, String), String>,
}

impl PhraseBook {
    fn from_files(language: Language) -> Self {
        let mut book = Self::default();
        let others = read_phrases(language);
        for (id, english) in read_phrases(Language::English) {
            let Some(other) = others.get(&id).cloned() else {
                continue;
            };
            match id.split('-').next() {
                Some("history" | "noun") => {}
                Some(kind) => {
                    let key = (kind.to_owned(), english.form());
                    book.fixed_texts.insert(key, other.form());
                    if kind == "message" {
                        book.messages.push(PhrasePair { english, other });
                    }
                }
                None => {}
            }
        }
        book
    }

    /// Returns a text of this kind in the language of the book.
    pub(super) fn fixed_text(&self, kind: &str, english: &str) -> Option<&str> {
        let key = (kind.to_owned(), english.to_owned());
        self.fixed_texts.get(&key).map(String::as_str)
    }

    /// Adds messages that stand beside their code, and sorts all messages.
    fn add_messages(&mut self, pairs: impl Iterator<Item = PhrasePair>) {
        self.messages.extend(pairs);
        self.messages
            .sort_by_key(|pair| std::cmp::Reverse(pair.english.own_length()));
    }
}

/// Returns the phrases of a language; nothing for English, which is the language of the messages themselves.
pub(super) fn phrase_book(language: Language) -> Option<&'static PhraseBook> {
    static FRENCH_BOOK: OnceLock<PhraseBook> = OnceLock::new();
    match language {
        Language::English => None,
        Language::French => Some(FRENCH_BOOK.get_or_init(|| {
            let mut book = PhraseBook::from_files(language);
            book.add_messages(super::described_messages());
            book
        })),
    }
}

/// Returns the phrases of a language by their ids.
fn read_phrases(language: Language) -> BTreeMap<String, Phrase> {
    let folder = WORD_FILES.get_dir(language.code());
    let files = folder.into_iter().flat_map(|folder| folder.files());
    let mut phrases = BTreeMap::new();
    for text in files.filter_map(|file| file.contents_utf8()) {
        // A damaged entry is left out; a test finds it.
        let (Ok(resource) | Err((resource, _))) = parser::parse(text);
        for entry in resource.body {
            if let Entry::Message(message) = entry
                && let Some(pattern) = &message.value
            {
                phrases.insert(message.id.name.to_owned(), Phrase::from_pattern(pattern));
            }
        }
    }
    phrases
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_words_is_whole_and_has_each_phrase_once() {
        let mut counts = Vec::new();
        for (language, _) in Language::ALL {
            let mut ids = BTreeMap::new();
            let folder = WORD_FILES.get_dir(language.code()).expect("a folder");
            for file in folder.files() {
                let path = file.path().display().to_string();
                let text = file.contents_utf8().expect("UTF-8");
                let resource = parser::parse(text).unwrap_or_else(|(_, errors)| {
                    panic!("{path}: {errors:?}");
                });
                for entry in resource.body {
                    let Entry::Message(message) = entry else {
                        let is_comment = matches!(
                            entry,
                            Entry::Comment(_) | Entry::GroupComment(_) | Entry::ResourceComment(_)
                        );
                        assert!(is_comment, "{path}: {entry:?}");
                        continue;
                    };
                    let before = ids.insert(message.id.name.to_owned(), path.clone());
                    assert!(before.is_none(), "{path}, {before:?}: {}", message.id.name);
                    let kind = message.id.name.split('-').next();
                    let kinds = [
                        "message", "help", "title", "guide", "line", "history", "noun",
                    ];
                    assert!(kind.is_some_and(|kind| kinds.contains(&kind)), "{path}");
                }
            }
            counts.push(ids);
        }
        assert!(counts[0].len() > 3000, "{}", counts[0].len());
        assert_eq!(
            counts[0].keys().collect::<Vec<_>>(),
            counts[1].keys().collect::<Vec<_>>()
        );
    }

    #[test]
    fn no_english_text_has_two_forms_in_another_language() {
        let (english, french) = (Language::English, Language::French);
        let others = read_phrases(french);
        let mut known = BTreeMap::new();
        for (id, phrase) in read_phrases(english) {
            let other = &others[&id];
            assert!(other.own_length() > 0 || phrase.own_length() == 0, "{id}");
            let kind = id.split('-').next().unwrap_or_default().to_owned();
            let first = known.insert((kind, phrase.form()), other.clone());
            assert!(first.is_none_or(|first| first == *other), "{id}");
        }
    }

    #[test]
    fn every_message_has_the_same_blanks_in_both_languages() {
        let blanks = |phrase: &Phrase| {
            let blank = |part: &PhrasePart| match part {
                PhrasePart::Blank(name) => Some(name.clone()),
                PhrasePart::Words(_) => None,
            };
            let mut names: Vec<String> = phrase.0.iter().filter_map(blank).collect();
            names.sort();
            names
        };
        let book = phrase_book(Language::French).expect("French");
        for pair in &book.messages {
            assert_eq!(blanks(&pair.english), blanks(&pair.other), "{pair:?}");
        }
        let mut lines = book
            .fixed_texts
            .iter()
            .filter(|((kind, _), _)| kind == "line");
        let of = |form: &str| blanks(&Phrase::from_form(form));
        assert!(lines.all(|((_, english), other)| of(english) == of(other)));
    }

    #[test]
    fn no_message_hides_another() {
        let messages = &phrase_book(Language::French).expect("French").messages;
        for pair in messages {
            let form = pair.english.form();
            let mut fitting = messages
                .iter()
                .filter(|known| known.english.blanks_in(&form).is_some());
            let first = fitting.next().map(|known| known.english.form());
            assert_eq!(first, Some(form));
        }
    }

    #[test]
    fn phrases_are_filled_and_recognised() {
        let pair = PhrasePair {
            english: Phrase::from_form("{n} of {name}: {what}"),
            other: Phrase::from_form("{what} ({name}, {n})"),
        };
        let same = |_: &str, value: &str| value.to_owned();
        assert_eq!(
            pair.translate("3 of a {n}: x of y", &same).as_deref(),
            Some("x of y (a {n}, 3)")
        );
        assert_eq!(pair.translate("3 of a", &same), None);
        assert_eq!(pair.translate("3 of a: b\nc", &same), None);
        assert_eq!(pair.english.form(), "{n} of {name}: {what}");
        let braces = Phrase(vec![PhrasePart::Words("write }".to_owned())]);
        assert_eq!(braces.blanks_in("write }"), Some(Vec::new()));
    }
}
