//! The data files of Chereme, embedded in its programs: the folders `schema` and `corpus` of the repository.
//!
//! The crate lists and returns files; the crates that read them know their meaning.

/// Every file with its path, such as `schema/faces/house.json`, sorted by path in each folder.
const SCHEMA_FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// Returns the files below a folder such as `corpus` or `schema/words`, each with its path from there and its text.
pub fn files_below(folder: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    SCHEMA_FILES.iter().filter_map(move |(path, text)| {
        let rest = path.strip_prefix(folder)?.strip_prefix('/')?;
        Some((rest, *text))
    })
}

/// Returns the text of a file of `schema`, such as `faces/house.json`. In a constant, a missing file does not compile.
///
/// # Panics
/// Panics if there is no such file.
#[must_use]
pub const fn schema_text(name: &str) -> &'static str {
    text_below("schema/", name)
}

/// Returns the text of a file of the starter corpus, such as `bol.bvh`.
///
/// # Panics
/// Panics if there is no such file.
#[must_use]
pub const fn starter_text(name: &str) -> &'static str {
    text_below("corpus/", name)
}

/// Returns modules in Rust with a constant for each text of the English files `PREFIX-PART.ftl`: of the phrase
/// `window-shell-close` in `window-shell.ftl` the constant `shell::CLOSE`. A build script includes them in a crate whose
/// module `words` has the type of texts; `visibility` is that of the constants. A name without a phrase does not compile.
#[must_use]
pub fn declare_text_constants(prefix: &str, visibility: &str) -> String {
    let mut modules = String::new();
    for (path, words) in files_below("schema/words/en") {
        let part = path.strip_prefix(prefix).and_then(|name| name.strip_suffix(".ftl"));
        let Some(part) = part.and_then(|name| name.strip_prefix('-')) else {
            continue;
        };
        let start = format!("{prefix}-{part}-");
        let constants: String = words
            .lines()
            .filter_map(|line| {
                let (id, _) = line.split_once(" =")?;
                let name = id.strip_prefix(&start)?.to_uppercase().replace('-', "_");
                Some(format!(
                    "/// The text `{id}`.\n{visibility} const {name}: InterfaceText = InterfaceText::from_id({id:?});\n"
                ))
            })
            .collect();
        let module = part.replace('-', "_");
        modules.push_str(&format!(
            "/// Texts of the files `{path}`.\npub(crate) mod {module} {{ use crate::words::InterfaceText;\n{constants}}}\n"
        ));
    }
    modules
}

const fn text_below(folder: &str, name: &str) -> &'static str {
    let mut index = 0;
    while index < SCHEMA_FILES.len() {
        let (path, text) = SCHEMA_FILES[index];
        if is_joined(path.as_bytes(), folder.as_bytes(), name.as_bytes()) {
            return text;
        }
        index += 1;
    }
    panic!("there is no such data file")
}

/// Returns whether `path` is `folder` followed by `name`; comparing texts is not yet possible in constants.
const fn is_joined(path: &[u8], folder: &[u8], name: &[u8]) -> bool {
    if path.len() != folder.len() + name.len() {
        return false;
    }
    let mut index = 0;
    while index < path.len() {
        let wanted = match index < folder.len() {
            true => folder[index],
            false => name[index - folder.len()],
        };
        if path[index] != wanted {
            return false;
        }
        index += 1;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_folder_and_name() {
        assert!(schema_text("faces/house.json").contains("house"));
        assert!(starter_text("bol.bvh").starts_with("HIERARCHY"));
        let mut word_files = files_below("schema/words");
        assert!(word_files.any(|(path, _)| path.starts_with("fr/")));
        assert!(files_below("corpus").all(|(path, _)| !path.ends_with(".rs")));
        assert_eq!(files_below("cor").count(), 0);
    }

    #[test]
    #[should_panic(expected = "no such data file")]
    fn a_missing_file_is_refused() {
        let _ = schema_text("faces/nobody.json");
    }
}
