//! What a language still lacks, and folders of words of the user's own.

use std::fs;
use std::path::Path;

use chereme_sign::words::folders::{self, LanguageFiles, WordFile, WordFileError};
use serde::Serialize;

use crate::error::{CorpusError, CorpusResult};

/// The largest file of words that is read, in bytes; the largest of the program is 30 times smaller.
const LARGEST_WORD_FILE: u64 = 1 << 20;

/// What a language has, lacks and does wrong.
#[derive(Debug, Serialize)]
pub struct LanguageCoverage {
    /// The code, such as `fr`.
    pub language: String,
    /// The number of phrases in English.
    pub phrases: usize,
    /// The number of those that the language has.
    pub translated: usize,
    /// The others, by their files.
    pub missing: Vec<MissingPhrase>,
    /// Phrases that cannot be used.
    pub faults: Vec<PhraseFault>,
}

/// A phrase that a language lacks.
#[derive(Debug, Serialize)]
pub struct MissingPhrase {
    /// The id.
    pub id: String,
    /// The English, in which `{name}` is a variable part.
    pub english: String,
    /// The file and line of the English, such as `en/menus.ftl:3`.
    pub place: String,
}

/// A fault of a phrase.
#[derive(Debug, Serialize)]
pub struct PhraseFault {
    /// Its file and line, such as `de/menus.ftl:3`.
    pub place: String,
    /// What is wrong.
    pub fault: String,
}

/// Adds a folder of the user's own: in it a folder for each language, with files that end in `.ftl`. Call it before anything
/// asks for words.
///
/// # Errors
/// Fails if the folder or a file cannot be read, or a file is damaged.
pub fn use_word_folder(folder: &Path) -> CorpusResult<()> {
    folders::add_word_files(read_word_folder(folder)?).map_err(|error| {
        let WordFileError { place, fault } = error;
        CorpusError::from_wrong_message(format!("{place}: {fault}"))
            .with_error_place(folder.display().to_string())
            .with_advice("a phrase is written as id = text, with variable parts such as { $name }")
    })
}

/// Returns what a language has and lacks, with the words of a folder of the user's own if one is named.
///
/// # Errors
/// Fails if there are no words for the language, or the folder cannot be read.
pub fn language_coverage(code: &str, folder: Option<&Path>) -> CorpusResult<LanguageCoverage> {
    let with_folder;
    let languages = match folder {
        Some(folder) => {
            with_folder = folders::sorted_by_language(read_word_folder(folder)?);
            &with_folder
        }
        None => folders::language_files(),
    };
    let files = languages.get(code).ok_or_else(|| {
        let codes: Vec<&str> = languages.keys().map(String::as_str).collect();
        CorpusError::from_wrong_message(format!("there are no words for the language {code}"))
            .with_advice(format!("languages with words: {}", codes.join(", ")))
    })?;
    Ok(compared_with_english(code, files))
}

fn compared_with_english(code: &str, files: &LanguageFiles) -> LanguageCoverage {
    let english = folders::own_english();
    let usable = files.word_book();
    let (written, damaged) = files.read_all();
    let mut faults: Vec<PhraseFault> = damaged
        .into_iter()
        .map(|WordFileError { place, fault }| PhraseFault { place, fault })
        .collect();
    for (id, phrase) in &written {
        let fault = match english.get(id) {
            None => format!("{id} is no phrase of the program"),
            // A phrase that lacks a variable part would hide something from the reader.
            Some(same) if phrase.can_stand_for(id, same) => continue,
            Some(same) => format!("the variable parts of {id} are not those of: {}", same.text),
        };
        let place = phrase.place.clone();
        faults.push(PhraseFault { place, fault });
    }
    let lacking = english.iter().filter(|(id, _)| !usable.contains_key(*id));
    let missing_phrases = lacking.map(|(id, phrase)| MissingPhrase {
        id: id.clone(),
        english: phrase.text.clone(),
        place: phrase.place.clone(),
    });
    let missing: Vec<MissingPhrase> = missing_phrases.collect();
    LanguageCoverage {
        language: code.to_owned(),
        phrases: english.len(),
        translated: english.len() - missing.len(),
        missing,
        faults,
    }
}

/// Reads the files `LANGUAGE/ROOM.ftl` of a folder.
fn read_word_folder(folder: &Path) -> CorpusResult<Vec<WordFile>> {
    let listed = |folder: &Path| -> CorpusResult<Vec<_>> {
        let read_entries = fs::read_dir(folder).and_then(Iterator::collect::<std::io::Result<Vec<_>>>);
        let mut entries = read_entries.map_err(|error| CorpusError::from_file_failure(folder, error))?;
        // The system lists files in any order, and reports should not change with it.
        entries.sort_by_key(fs::DirEntry::file_name);
        Ok(entries)
    };
    let mut files = Vec::new();
    for language in listed(folder)? {
        if !language.path().is_dir() {
            continue;
        }
        for entry in listed(&language.path())? {
            let path = entry.path();
            if path.extension().is_none_or(|ending| ending != "ftl") {
                continue;
            }
            let fault = |error| CorpusError::from_file_failure(&path, error);
            // Such a file holds something else than words, and would only fill the memory.
            if fs::metadata(&path).map_err(fault)?.len() > LARGEST_WORD_FILE {
                return Err(fault(std::io::ErrorKind::FileTooLarge.into()));
            }
            let text = fs::read_to_string(&path).map_err(fault)?;
            let file_names = [language.file_name(), entry.file_name()];
            let names = file_names.map(|name| name.to_string_lossy().into_owned());
            files.push(WordFile {
                path: names.join("/"),
                text: text.into(),
            });
        }
    }
    if files.is_empty() {
        return Err(CorpusError::from_wrong_message("this folder holds no words")
            .with_error_place(folder.display().to_string())
            .with_advice("a folder of words has a folder for each language, such as de, with files that end in .ftl"));
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn french_lacks_nothing_and_a_folder_lacks_what_it_does_not_say() {
        let french = language_coverage("fr", None).expect("French");
        assert_eq!((french.missing.len(), french.faults.len()), (0, 0));
        let folder = tempfile::tempdir().expect("a folder");
        let refused = |folder: &Path, code: &str| {
            let error = language_coverage(code, Some(folder)).expect_err("refused");
            let remedy = error.error_remedy().map(|remedy| remedy.remedy_text().to_owned());
            format!("{error}; {}", remedy.unwrap_or_default())
        };
        assert!(refused(folder.path(), "tlh").starts_with("this folder holds no words; "));
        fs::create_dir(folder.path().join("tlh")).expect("made");
        let file = folder.path().join("tlh/mine.ftl");
        let text = "menu-edit-undo = a\nmenu-edit-redo = { $n }\nmenu-none = b\nmenu-x\n";
        fs::write(&file, text).expect("written");
        let coverage = language_coverage("tlh", Some(folder.path())).expect("read");
        assert_eq!(coverage.translated, 1);
        assert_eq!(coverage.missing.len(), coverage.phrases - 1);
        let redo = coverage.missing.iter().find(|row| row.id == "menu-edit-redo");
        let redo = redo.expect("an unusable phrase is missing");
        assert_eq!(redo.english, "Redo");
        assert!(redo.place.starts_with("en/menus.ftl:"), "{}", redo.place);
        let places = coverage.faults.iter().map(|row| row.place.as_str());
        let places: Vec<&str> = places.collect();
        assert_eq!(places, ["tlh/mine.ftl:4", "tlh/mine.ftl:2", "tlh/mine.ftl:3"]);
        let unknown = refused(folder.path(), "xx");
        assert!(unknown.contains("language xx; languages with words: ") && unknown.contains("fr"));
        let error = use_word_folder(folder.path()).expect_err("damaged");
        assert!(error.to_string().contains("tlh/mine.ftl:4"), "{error}");
    }
}
