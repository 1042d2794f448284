//! Folders of words: one for each language, named by its code, with files in Fluent's syntax.
//!
//! `schema/words/LANGUAGE/ROOM.ftl` holds the phrases of a room. A phrase has the same id in all languages; the id begins with
//! its kind: `message`, `line`, `help`, `title`, `guide`, `menu`, `window`, `page`, `history` or `noun`; the last two may choose
//! among variants. Comments in the files are for translators.
//! [`add_word_files`] adds a folder of the user's own, whose phrases come before those of the program.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement};
use fluent_syntax::parser;

use super::InterfaceLanguage;

/// A file of words.
#[derive(Debug, Clone)]
pub struct WordFile {
    /// The path, which begins with the folder of the language, such as `fr/menus.ftl`.
    pub path: String,
    /// The contents.
    pub text: Cow<'static, str>,
}

/// A piece of a phrase.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PhrasePart {
    /// Words of the phrase itself.
    Words(String),
    /// The name of a variable part.
    Blank(String),
}

/// A phrase of a file of words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredPhrase {
    /// Its pieces.
    pub parts: Vec<PhrasePart>,
    /// The whole phrase, in which `{name}` is a variable part.
    pub text: String,
    /// Its file and line, such as `fr/menus.ftl:3`.
    pub place: String,
}

impl StoredPhrase {
    /// Returns the sorted names of the variable parts.
    #[must_use]
    pub fn blank_names(&self) -> Vec<String> {
        let blank = |part: &PhrasePart| match part {
            PhrasePart::Blank(name) => Some(name.clone()),
            PhrasePart::Words(_) => None,
        };
        let mut names: Vec<String> = self.parts.iter().filter_map(blank).collect();
        names.sort_unstable();
        names
    }

    /// Returns whether it can stand for the English phrase with this id: it has the same variable parts. A sentence or a noun,
    /// in which a number or a value chooses, may name them as often as the language needs.
    #[must_use]
    pub fn can_stand_for(&self, id: &str, english: &Self) -> bool {
        is_sentence(id) || self.blank_names() == english.blank_names()
    }
}

/// The phrases of a language by their ids.
pub type WordBook = BTreeMap<String, StoredPhrase>;

/// A fault of a file of words: file and line, and what is wrong.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {fault}")]
pub struct WordFileError {
    /// The file and line, such as `fr/menus.ftl:3`.
    pub place: String,
    /// What is wrong.
    pub fault: String,
}

/// The files of a language, which are read when a phrase is needed.
#[derive(Debug, Default)]
pub struct LanguageFiles {
    files: Vec<WordFile>,
    book: OnceLock<WordBook>,
}

impl LanguageFiles {
    /// Returns the phrases. One that is damaged, or has not the variable parts of its English, is left out.
    pub fn word_book(&self) -> &WordBook {
        self.book.get_or_init(|| {
            let mut book = WordBook::new();
            for file in &self.files {
                let (mut phrases, _) = read_word_book(std::slice::from_ref(file));
                phrases.retain(|id, phrase| match own_english().get(id) {
                    Some(english) => phrase.can_stand_for(id, english),
                    None => true,
                });
                book.extend(phrases);
            }
            book
        })
    }

    /// Reads all phrases, and the faults of the files.
    #[must_use]
    pub fn read_all(&self) -> (WordBook, Vec<WordFileError>) {
        read_word_book(&self.files)
    }

    /// Returns the texts of the files that hold sentences or nouns, whose form depends on a number or a value.
    pub fn sentence_texts(&self) -> impl Iterator<Item = &str> {
        let texts = self.files.iter().map(|file| &*file.text);
        texts.filter(|text| text.contains("\nhistory-") || text.contains("\nnoun-"))
    }

    /// Returns the language's own name for itself, without reading whole files; without one its code.
    pub(super) fn language_name<'a>(&'a self, code: &'a str) -> &'a str {
        // The user's own files come last, and count before the program's.
        let mut lines = self.files.iter().rev().flat_map(|file| file.text.lines());
        let name = lines.find_map(|line| line.strip_prefix("language-name = "));
        name.map_or(code, str::trim)
    }
}

static ADDED_FILES: OnceLock<Vec<WordFile>> = OnceLock::new();

/// Adds the files of the user's own folder to those of the program; call it once, before anything asks for words.
///
/// # Errors
/// Fails if a file is damaged, or words were asked for before.
pub fn add_word_files(files: Vec<WordFile>) -> Result<(), WordFileError> {
    if let Some(error) = read_word_book(&files).1.into_iter().next() {
        return Err(error);
    }
    let place = files.first().map(|file| file.path.clone());
    ADDED_FILES.set(files).map_err(|_| WordFileError {
        place: place.unwrap_or_default(),
        fault: "words were read before this file was added".to_owned(),
    })
}

/// Returns the files of each language by its code.
#[must_use]
pub fn language_files() -> &'static BTreeMap<String, LanguageFiles> {
    static FILES_BY_LANGUAGE: LazyLock<BTreeMap<String, LanguageFiles>> =
        LazyLock::new(|| sorted_by_language(ADDED_FILES.get_or_init(Vec::new).clone()));
    &FILES_BY_LANGUAGE
}

/// Returns the program's own files and `added` ones by the codes of their languages.
#[must_use]
pub fn sorted_by_language(added: Vec<WordFile>) -> BTreeMap<String, LanguageFiles> {
    let mut languages: BTreeMap<String, LanguageFiles> = BTreeMap::new();
    for file in own_files().chain(added) {
        if let Some((code, _)) = file.path.split_once('/') {
            let language = languages.entry(code.to_owned()).or_default();
            language.files.push(file);
        }
    }
    languages
}

/// Returns the files that come with the program.
fn own_files() -> impl Iterator<Item = WordFile> {
    chereme_data::files_below("schema/words").map(|(path, text)| WordFile {
        path: path.to_owned(),
        text: Cow::Borrowed(text),
    })
}

/// Returns the phrases of the program in English, which every other language follows.
#[must_use]
pub fn own_english() -> &'static WordBook {
    static ENGLISH_BOOK: LazyLock<WordBook> = LazyLock::new(|| {
        let files: Vec<WordFile> = own_files().filter(|file| file.path.starts_with("en/")).collect();
        read_word_book(&files).0
    });
    &ENGLISH_BOOK
}

/// Returns the form of a phrase in `language`, otherwise in English.
pub fn phrase_text(id: &str, language: InterfaceLanguage) -> Option<&'static str> {
    let codes = [language.language_code(), InterfaceLanguage::English.language_code()];
    let mut books = codes.into_iter().filter_map(|code| language_files().get(code));
    let phrase = books.find_map(|files| files.word_book().get(id))?;
    Some(&phrase.text)
}

/// The depth of braces beyond which a file is refused: its reader follows each with a call.
const DEEPEST_BRACES: usize = 8;

/// Returns the line on which braces are too deep in each other; an entry begins with a letter.
fn line_of_deep_braces(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    text.lines().zip(1..).find_map(|(line, number)| {
        if line.starts_with(|first: char| first.is_ascii_alphabetic()) {
            depth = 0;
        }
        line.bytes().find_map(|byte| {
            match byte {
                b'{' => depth += 1,
                b'}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            (depth > DEEPEST_BRACES).then_some(number)
        })
    })
}

/// Reads the phrases of files, a later one before an earlier one of the same id, and the faults of the files.
#[must_use]
pub fn read_word_book(files: &[WordFile]) -> (WordBook, Vec<WordFileError>) {
    let (mut book, mut faults) = (WordBook::new(), Vec::new());
    for file in files {
        let mut report = |line: usize, fault: String| {
            let place = format!("{}:{line}", file.path);
            faults.push(WordFileError { place, fault });
        };
        if let Some(line) = line_of_deep_braces(&file.text) {
            report(line, "too many braces in each other".to_owned());
            continue;
        }
        // Parsed messages do not know their lines.
        let numbered = file.text.lines().zip(1..);
        let lines = numbered.filter_map(|(text, line)| Some((text.split_once('=')?.0.trim(), line)));
        let lines: BTreeMap<&str, usize> = lines.collect();
        let (resource, errors) = match parser::parse(&*file.text) {
            Ok(resource) => (resource, Vec::new()),
            Err(damaged) => damaged,
        };
        for error in errors {
            let before = file.text.get(..error.pos.start).unwrap_or_default();
            report(before.matches('\n').count() + 1, error.kind.to_string());
        }
        for entry in resource.body {
            if let Entry::Message(message) = entry
                && let Some(pattern) = &message.value
            {
                let id = message.id.name;
                let line = lines.get(id).copied().unwrap_or_default();
                match phrase_parts(pattern) {
                    Some(parts) => {
                        let place = format!("{}:{line}", file.path);
                        let text = form_of(&parts);
                        let phrase = StoredPhrase { parts, text, place };
                        book.insert(id.to_owned(), phrase);
                    }
                    None => report(line, format!("{id} may hold words and {{ $variables }} only")),
                }
            }
        }
    }
    (book, faults)
}

/// Returns whether an id is that of a sentence or a noun, which may choose among variants.
#[must_use]
pub fn is_sentence(id: &str) -> bool {
    id.starts_with("history-") || id.starts_with("noun-")
}

/// Returns the pieces of a pattern, of variants those of the usual one; nothing if it holds something else.
fn phrase_parts(pattern: &Pattern<&str>) -> Option<Vec<PhrasePart>> {
    let mut parts: Vec<PhrasePart> = Vec::new();
    for element in &pattern.elements {
        let words = match element {
            PatternElement::TextElement { value } => value,
            PatternElement::Placeable { expression } => match expression {
                Expression::Inline(InlineExpression::VariableReference { id }) => {
                    parts.push(PhrasePart::Blank(id.name.to_owned()));
                    continue;
                }
                Expression::Inline(InlineExpression::StringLiteral { value }) => value,
                Expression::Select { variants, .. } => {
                    // A count is shown by its usual variant, as translators see it.
                    let usual = variants.iter().find(|variant| variant.default)?;
                    parts.extend(phrase_parts(&usual.value)?);
                    continue;
                }
                Expression::Inline(_) => return None,
            },
        };
        match parts.last_mut() {
            Some(PhrasePart::Words(last)) => last.push_str(words),
            _ => parts.push(PhrasePart::Words((*words).to_owned())),
        }
    }
    Some(parts)
}

fn form_of(parts: &[PhrasePart]) -> String {
    let part = |part: &PhrasePart| match part {
        PhrasePart::Words(words) => words.clone(),
        PhrasePart::Blank(name) => format!("{{{name}}}"),
    };
    parts.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word_file(path: &str, text: &str) -> WordFile {
        WordFile {
            path: path.to_owned(),
            text: Cow::Owned(text.to_owned()),
        }
    }

    #[test]
    fn a_folder_of_the_user_comes_before_that_of_the_program() {
        let added = vec![
            word_file(
                "fr/mine.ftl",
                "menu-edit-undo = Défaire\nmenu-edit-redo = { $n } fois\n",
            ),
            word_file(
                "tlh/a.ftl",
                "language-name = tlhIngan Hol\nmenu-x = { $n } ch { \"{\" }\n",
            ),
        ];
        let languages = sorted_by_language(added);
        let french = languages["fr"].word_book();
        assert_eq!(french["menu-edit-undo"].text, "Défaire");
        assert_eq!(french["menu-edit-undo"].place, "fr/mine.ftl:1");
        assert_eq!(french["menu-edit-redo"].text, "Rétablir");
        let other = &languages["tlh"];
        assert_eq!(other.language_name("tlh"), "tlhIngan Hol");
        let phrase = &other.word_book()["menu-x"];
        assert_eq!(
            (phrase.text.as_str(), phrase.place.as_str()),
            ("{n} ch {", "tlh/a.ftl:2")
        );
        assert_eq!(phrase.blank_names(), ["n"]);
    }

    #[test]
    fn a_damaged_file_is_refused_with_its_line() {
        for (text, line, part) in [
            ("menu-a = A\nmenu-b\n", 2, ""),
            ("menu-a = A\nmenu-b = { menu-a }\n", 2, "words and { $variables }"),
            ("menu-b = B\nmenu-a = {{{\n{{{{\n{{{ $a }}}}}}}}}}\n", 4, "braces"),
        ] {
            let (_, faults) = read_word_book(&[word_file("de/x.ftl", text)]);
            let [fault] = &faults[..] else {
                panic!("{text}: {faults:?}")
            };
            assert_eq!(fault.place, format!("de/x.ftl:{line}"));
            assert!(fault.fault.contains(part), "{fault}");
        }
    }
}
