//! Names of files and folders that every web server and every disk can hold.

use std::collections::BTreeMap;

use chereme_sign::text::fold_text;
use sha2::{Digest, Sha256};

use crate::db::stored_motion::to_hex_text;

/// The longest name, in bytes, before the mark of a hash.
const MAX_FILE_NAME_BYTES: usize = 80;
/// Names that Windows keeps for devices.
const WINDOWS_DEVICE_NAMES: [&str; 6] = ["con", "prn", "aux", "nul", "com", "lpt"];

/// Returns a name for each text, by text. Names that differ only in case or accents belong to one file on some disks, so
/// all but one of them get a mark of their own. The name of a text does not depend on the order, nor on texts that
/// look different.
pub(super) fn unique_file_names<'t>(texts: impl IntoIterator<Item = &'t str>) -> BTreeMap<&'t str, String> {
    let mut groups: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for text in texts {
        let group = groups.entry(fold_text(&plain_file_name(text))).or_default();
        if !group.contains(&text) {
            group.push(text);
        }
    }
    let mut names = BTreeMap::new();
    for (key, mut group) in groups {
        // The text that a name shows exactly is the first to have it; capitals come before small letters.
        group.sort_by_key(|text| (plain_file_name(text) != **text, *text));
        for (at, text) in group.into_iter().enumerate() {
            let name = plain_file_name(text);
            let free = at == 0 && !is_reserved(&key) && name.len() <= MAX_FILE_NAME_BYTES;
            let name = if free { name } else { hash_marked_name(&name, text) };
            names.insert(text, name);
        }
    }
    names
}

/// Returns the text in letters, digits and `-`, `_`, `.`, `+`, `(`, `)`.
fn plain_file_name(text: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "-_.+()".contains(c);
    let text = chereme_sign::text::compose_accents(text.trim());
    let name: String = text.chars().map(|c| if safe(c) { c } else { '_' }).collect();
    name.trim_matches('.').to_owned()
}

fn is_reserved(folded: &str) -> bool {
    let stem = folded.split('.').next().unwrap_or_default();
    let device = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    stem.is_empty() || WINDOWS_DEVICE_NAMES.contains(&device)
}

fn hash_marked_name(name: &str, text: &str) -> String {
    let mut end = name.len().min(MAX_FILE_NAME_BYTES);
    while !name.is_char_boundary(end) {
        end -= 1;
    }
    let mark = to_hex_text(&Sha256::digest(text));
    format!("{}~{}", &name[..end], &mark[..8])
}

/// Returns a name as a part of an address.
pub(super) fn in_address(name: &str) -> String {
    let mut address = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || b"-_.~".contains(&byte) {
            address.push(char::from(byte));
        } else {
            address.push_str(&format!("%{byte:02X}"));
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn names_that_a_disk_takes_for_one_are_kept_apart() {
        let texts = [
            "CHAT", "chat", "CHÂT", "A/B", "A:B", "A_B", "", "..", "con", "COM1", "é", "e\u{301}",
        ];
        let names = unique_file_names(texts);
        assert_eq!(names["CHAT"], "CHAT");
        assert_eq!(names["A_B"], "A_B");
        assert_eq!(names["é"], "é");
        let keys: BTreeSet<String> = names.values().map(|it| fold_text(it)).collect();
        assert_eq!(keys.len(), texts.len());
        assert!(names["chat"].starts_with("chat~") && names["A/B"].starts_with("A_B~"));
        assert!(names[""].starts_with('~') && names["con"].starts_with("con~"));
        assert_eq!(in_address("É (2)"), "%C3%89%20%282%29");
    }

    proptest! {
        #[test]
        fn every_text_has_a_safe_name_of_its_own(texts in prop::collection::btree_set(".{0,12}", 0..12)) {
            let names = unique_file_names(texts.iter().map(String::as_str));
            prop_assert_eq!(names.len(), texts.len());
            let keys: BTreeSet<String> = names.values().map(|it| fold_text(it)).collect();
            prop_assert_eq!(keys.len(), texts.len());
            for name in names.values() {
                prop_assert!(!name.is_empty() && !name.starts_with('.') && !name.ends_with('.'));
                prop_assert!(!name.contains(['/', '\\', ':', '*', '?', '"', '<', '>', '|', '%', '#', '\0']));
                prop_assert!(name.len() <= MAX_FILE_NAME_BYTES + 9);
            }
        }
    }
}
