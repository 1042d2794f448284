//! Texts of the help in English and French, from `help.tsv`: the English text, a tab, the French one.

const HELP: &str = include_str!("help.tsv");

/// Returns a text of the help in French; nothing if the table lacks it.
pub(super) fn of(english: &str) -> Option<&'static str> {
    let mut rows = HELP.lines().filter_map(|line| line.split_once('\t'));
    rows.find_map(|(known, french)| (known == english).then_some(french))
}
