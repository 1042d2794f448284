//! The terms by which the index finds values.

/// Which hand a term is about: by side, by part in signing, or none.
pub(crate) const HANDS: [&str; 5] = ["r", "l", "d", "w", "n"];
/// Which of the sign's values a term is about: the only one, the first, one between, the last.
pub(crate) const PHASES: [&str; 4] = ["o", "i", "m", "f"];

/// What a term says where it says no value.
pub(crate) mod special {
    /// The field has a value, whichever.
    pub(crate) const ANY: &str = "\u{1}any";
    /// The field does not apply.
    pub(crate) const NOT_APPLICABLE: &str = "\u{1}n/a";
    /// The field cannot be told.
    pub(crate) const UNCLEAR: &str = "\u{1}unclear";
}

/// Returns the term for a value of a component, as `hand|phase|component|feature|value`.
pub(crate) fn reading_term(
    hand: &str,
    phase: &str,
    component: &str,
    feature: Option<&str>,
    value: &str,
) -> String {
    format!(
        "{hand}|{phase}|{component}|{}|{value}",
        feature.unwrap_or_default()
    )
}
