//! The words about an operator that people read: in help, in a form and in its report.

use chereme_sign::words::InterfaceText;

/// The words about an operator, in English and French.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OperatorDescription {
    /// The title of its card, such as "Repeat".
    pub title: InterfaceText,
    /// Its effect in a few words, for a list of operators.
    pub hint: InterfaceText,
    /// Recipes from the operator on, as help shows them, each with its effect.
    pub examples: &'static [(&'static str, InterfaceText)],
    /// The sentences that it may write into its report, and its reasons to refuse settings; `{name}` stands for a
    /// variable part. A sentence that is contained in another comes after it.
    pub messages: &'static [InterfaceText],
}
