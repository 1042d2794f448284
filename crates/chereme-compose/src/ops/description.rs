//! The words about an operator that people read in help and in a form. They lie in `schema/words/LANGUAGE/operators.ftl`, with the
//! sentences of the reports.

use chereme_sign::words::InterfaceText;

/// The words about an operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OperatorDescription {
    /// The title of its card, such as "Repeat".
    pub title: InterfaceText,
    /// Its effect in a few words, for a list of operators.
    pub hint: InterfaceText,
    /// Recipes from the operator on, as help shows them, each with its effect.
    pub examples: &'static [(&'static str, InterfaceText)],
}

/// Describes an operator by its name and by examples, each after the last part of the id of its effect.
macro_rules! described_operator {
    ($name:literal, $($effect:literal: $example:literal),+ $(,)?) => {
        OperatorDescription {
            title: InterfaceText::from_id(concat!("operator-", $name, "-title")),
            hint: InterfaceText::from_id(concat!("operator-", $name, "-hint")),
            examples: &[$(($example, InterfaceText::from_id(concat!("guide-operator-", $name, "-", $effect)))),+],
        }
    };
}
pub(super) use described_operator;
