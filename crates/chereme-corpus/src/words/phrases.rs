//! Phrases in English and in another language, from the folders of words.

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use chereme_sign::words::folders::{PhrasePart, language_files};

use super::InterfaceLanguage;
use super::parts_words::{find_unquoted, is_quoted};

/// A phrase with blanks for its variable parts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct BlankedPhrase(Vec<PhrasePart>);

impl BlankedPhrase {
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

    fn add_words(&mut self, words: &str) {
        match self.0.last_mut() {
            Some(PhrasePart::Words(last)) => last.push_str(words),
            _ if words.is_empty() => {}
            _ => self.0.push(PhrasePart::Words(words.to_owned())),
        }
    }

    /// Returns the phrase with its blanks filled by `value`, which gets the name of a blank.
    pub(super) fn fill_phrase_blanks(&self, value: impl Fn(&str) -> String) -> String {
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
    pub(super) fn phrase_form(&self) -> String {
        self.fill_phrase_blanks(|name| format!("{{{name}}}"))
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
        let has_lines = |part: &PhrasePart| matches!(part, PhrasePart::Words(words) if words.contains('\n'));
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
    pub(super) english: BlankedPhrase,
    pub(super) other: BlankedPhrase,
}

impl PhrasePair {
    /// Returns `text`, which is the English phrase, in the other language, each variable part converted by `convert`, which
    /// also gets the name of the blank; nothing if `text` is not this phrase.
    pub(super) fn translate_phrase(&self, text: &str, convert: &dyn Fn(&str, &str) -> String) -> Option<String> {
        let values = self.english.blanks_in(text)?;
        let value = |name: &str| {
            let value_entry = values.iter().find(|(known, _)| *known == name);
            value_entry.map_or_else(String::new, |(name, value)| convert(name, value))
        };
        Some(self.other.fill_phrase_blanks(value))
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
    fn from_files(language: InterfaceLanguage) -> Self {
        let mut book = Self::default();
        let others = read_phrases(language);
        for (id, english) in read_phrases(InterfaceLanguage::English) {
            let Some(other) = others.get(&id).cloned() else {
                continue;
            };
            match id.split('-').next() {
                Some("history" | "noun" | "window") => {}
                Some(kind) => {
                    let key = (kind.to_owned(), english.phrase_form());
                    book.fixed_texts.insert(key, other.phrase_form());
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
pub(super) fn phrase_book(language: InterfaceLanguage) -> Option<&'static PhraseBook> {
    static BOOKS_BY_CODE: LazyLock<BTreeMap<&str, OnceLock<PhraseBook>>> = LazyLock::new(|| {
        let codes = language_files().keys().map(String::as_str);
        codes.map(|code| (code, OnceLock::new())).collect()
    });
    if language == InterfaceLanguage::English {
        return None;
    }
    let book = BOOKS_BY_CODE.get(language.language_code())?.get_or_init(|| {
        let mut book = PhraseBook::from_files(language);
        let beside_code = super::described_messages().filter(|_| language == InterfaceLanguage::French);
        book.add_messages(beside_code);
        book
    });
    Some(book)
}

/// Returns a message in a third language, whose folder may hold the message and those within it.
pub(super) fn message_from_folder(text: &str, language: InterfaceLanguage) -> Option<String> {
    let convert = |_: &str, part: &str| {
        let is_smaller = part.len() < text.len() && !is_quoted(part);
        let inner = is_smaller.then(|| message_from_folder(part, language));
        inner.flatten().unwrap_or_else(|| part.to_owned())
    };
    let mut pairs = phrase_book(language)?.messages.iter();
    pairs.find_map(|pair| pair.translate_phrase(text, &convert))
}

/// Returns the phrases of a language by their ids.
fn read_phrases(language: InterfaceLanguage) -> BTreeMap<String, BlankedPhrase> {
    let files = language_files().get(language.language_code());
    let phrases = files.into_iter().flat_map(|files| files.word_book());
    phrases
        .map(|(id, phrase)| (id.clone(), BlankedPhrase(phrase.parts.clone())))
        .collect()
}

#[cfg(test)]
mod tests {
    use chereme_sign::words::folders::{WordBook, WordFile, read_word_book};

    use super::*;

    #[test]
    fn every_file_of_words_is_whole_and_has_each_phrase_once() {
        let own = |code: &'static str| {
            let files = chereme_data::files_below("schema/words");
            let files = files.filter(move |(path, _)| path.split('/').next() == Some(code));
            files.map(|(path, text)| WordFile {
                path: path.to_owned(),
                text: text.into(),
            })
        };
        let mut books = BTreeMap::new();
        for (language, _) in InterfaceLanguage::all_listed() {
            let code = language.language_code();
            let mut book = WordBook::new();
            for file in own(code) {
                let (phrases, faults) = read_word_book(std::slice::from_ref(&file));
                assert!(faults.is_empty(), "{faults:?}");
                let is_entry =
                    |line: &&str| line.starts_with(|first: char| first.is_ascii_lowercase()) && line.contains('=');
                let entries = file.text.lines().filter(is_entry);
                assert_eq!(phrases.len(), entries.count(), "{}: twice", file.path);
                for (id, phrase) in phrases {
                    let kind = id.split('-').next().unwrap_or_default();
                    let kinds = [
                        "message", "line", "help", "title", "guide", "menu", "page", "operator", "language", "history",
                        "noun", "window", "texts", "setting", "tier", "detector", "program", "body", "finger",
                    ];
                    assert!(kinds.contains(&kind), "{}", phrase.place);
                    let place = phrase.place.clone();
                    assert_eq!(book.insert(id, phrase), None, "{place}");
                }
            }
            books.insert(code, book);
        }
        let english = &books["en"];
        assert!(english.len() > 3000, "{}", english.len());
        assert!(english.keys().eq(books["fr"].keys()));
        for phrase in books.values().flatten() {
            let Some(same) = english.get(phrase.0) else {
                panic!("{}: no such phrase in English", phrase.1.place);
            };
            assert!(phrase.1.can_stand_for(phrase.0, same), "{}", phrase.1.place);
        }
        for id in english
            .keys()
            .filter(|id| id.starts_with("menu-") || id.starts_with("page-"))
        {
            assert!(books["de"].contains_key(id), "{id} has no German");
        }
    }

    #[test]
    fn no_english_text_has_two_forms_in_another_language() {
        let (english, french) = (InterfaceLanguage::English, InterfaceLanguage::French);
        let others = read_phrases(french);
        let mut known = BTreeMap::new();
        for (id, phrase) in read_phrases(english) {
            let other = &others[&id];
            assert!(other.own_length() > 0 || phrase.own_length() == 0, "{id}");
            let kind = id.split('-').next().unwrap_or_default().to_owned();
            // Texts that are asked for by their id may differ.
            let by_id = [
                "menu", "page", "language", "history", "noun", "window", "texts", "setting",
            ];
            if by_id.contains(&kind.as_str()) {
                continue;
            }
            let first = known.insert((kind, phrase.phrase_form()), other.clone());
            assert!(first.is_none_or(|first| first == *other), "{id}");
        }
    }

    #[test]
    fn every_message_has_the_same_blanks_in_both_languages() {
        let blanks = |phrase: &BlankedPhrase| {
            let blank = |part: &PhrasePart| match part {
                PhrasePart::Blank(name) => Some(name.clone()),
                PhrasePart::Words(_) => None,
            };
            let mut names: Vec<String> = phrase.0.iter().filter_map(blank).collect();
            names.sort();
            names
        };
        let book = phrase_book(InterfaceLanguage::French).expect("French");
        for pair in &book.messages {
            assert_eq!(blanks(&pair.english), blanks(&pair.other), "{pair:?}");
        }
        let mut lines = book.fixed_texts.iter().filter(|((kind, _), _)| kind == "line");
        let of = |form: &str| blanks(&BlankedPhrase::from_form(form));
        assert!(lines.all(|((_, english), other)| of(english) == of(other)));
    }

    #[test]
    fn no_message_hides_another() {
        let messages = &phrase_book(InterfaceLanguage::French).expect("French").messages;
        for pair in messages {
            let form = pair.english.phrase_form();
            let mut fitting = messages.iter().filter(|known| known.english.blanks_in(&form).is_some());
            let first = fitting.next().map(|known| known.english.phrase_form());
            assert_eq!(first, Some(form));
        }
    }

    #[test]
    fn phrases_are_filled_and_recognised() {
        let pair = PhrasePair {
            english: BlankedPhrase::from_form("{n} of {name}: {what}"),
            other: BlankedPhrase::from_form("{what} ({name}, {n})"),
        };
        let same = |_: &str, value: &str| value.to_owned();
        assert_eq!(
            pair.translate_phrase("3 of a {n}: x of y", &same).as_deref(),
            Some("x of y (a {n}, 3)")
        );
        assert_eq!(pair.translate_phrase("3 of a", &same), None);
        assert_eq!(pair.translate_phrase("3 of a: b\nc", &same), None);
        assert_eq!(pair.english.phrase_form(), "{n} of {name}: {what}");
        let braces = BlankedPhrase(vec![PhrasePart::Words("write }".to_owned())]);
        assert_eq!(braces.blanks_in("write }"), Some(Vec::new()));
    }
}
