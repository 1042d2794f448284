//! Sentences that describe the effects of operations, from the messages `history-…` of the files of words.

use serde_json::{Value, json};

use super::InterfaceLanguage;
use super::count::format_noun_count;
use super::effect::{AnnotationDeed, AnnotationEffect, OperationEffect};
use super::phrases::BlankedPhrase;
use super::sentences::{filled_sentence, load_message_patterns};

pub use crate::words::texts::history::*;

/// Returns the effect of an operation, as a sentence.
#[must_use]
pub fn operation_sentence(effect: &OperationEffect, language: InterfaceLanguage) -> String {
    let mut fields = effect.to_json();
    let special = match effect {
        OperationEffect::ChangeSign { former: Some(_), .. } => Some("rename-sign".to_owned()),
        OperationEffect::FitMarkers { subject: Some(_), .. } => Some("fit-markers-of-person".to_owned()),
        OperationEffect::SummaryOnly { name, .. } => {
            let special = format!("summary-only-{}", name.replace(' ', "-"));
            let is_known = load_message_patterns(language).contains_key(sentence_id(&special).as_str());
            is_known.then_some(special)
        }
        _ => None,
    };
    if let Some(id) = special {
        fields["does"] = id.into();
    }
    described_value(&fields, language)
}

/// Returns the effect of an operation in English, as programs get it.
pub(super) fn operation_summary(effect: &OperationEffect) -> String {
    let fields = effect.to_json();
    BlankedPhrase::from_form(effect.summary_form()).fill_phrase_blanks(|name| {
        let quoted = name.strip_prefix("quoted ").map(|name| &fields[name]);
        if let Some(noun) = name.strip_prefix("counted ") {
            return format_noun_count(fields[noun].as_u64().unwrap_or_default(), noun);
        }
        match (name, quoted.unwrap_or(&fields[name])) {
            ("changes", Value::Array(deeds)) => {
                let deeds: Vec<String> = deeds.iter().map(summary_of_deed).collect();
                deeds.join(", ")
            }
            ("annotations" | "conflicts" | "participants", Value::Number(count)) => {
                format_noun_count(count.as_u64().unwrap_or_default(), name)
            }
            (_, Value::String(text)) if quoted.is_some() => format!("{text:?}"),
            (_, field) => described_value(field, InterfaceLanguage::English),
        }
    })
}

fn summary_of_deed(deed: &Value) -> String {
    match deed["does"].as_str() {
        Some("annotations-added") => format!("{} added", deed["count"]),
        Some("annotations-changed") => format!("{} changed", deed["count"]),
        Some("annotations-removed") => format!("{} removed", deed["count"]),
        _ => described_value(deed, InterfaceLanguage::English),
    }
}

/// Returns the effect of undoing an operation, as a sentence: removed things are restored.
#[must_use]
pub fn undo_sentence(effect: &OperationEffect, language: InterfaceLanguage) -> String {
    let mut fields = effect.to_json();
    match effect {
        OperationEffect::Delete { .. } => fields["does"] = "delete-undone".into(),
        OperationEffect::Annotate(AnnotationEffect { changes, .. })
            if matches!(changes[..], [AnnotationDeed::AnnotationsRemoved { .. }]) =>
        {
            fields["changes"][0]["does"] = "annotations-removed-undone".into();
        }
        _ => {
            let what = operation_sentence(effect, language);
            fields = json!({ "does": "undone", "what": what });
        }
    }
    described_value(&fields, language)
}

/// Returns changes of annotations as a sentence, such as `2 annotations added, 1 annotation changed in X`.
#[must_use]
pub fn annotation_sentence(effect: &AnnotationEffect, language: InterfaceLanguage) -> String {
    operation_sentence(&OperationEffect::Annotate(effect.clone()), language)
}

/// Returns a stored value in words: an object by the message that its `does` names, a list by its items.
pub(crate) fn described_value(value: &Value, language: InterfaceLanguage) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(|item| described_value(item, language)).collect();
            items.join(", ")
        }
        Value::Object(fields) => {
            let field = |name: &str| match fields.get(name) {
                Some(value) => described_value(value, language),
                None => format!("{{{name}}}"),
            };
            let stated_id = fields.get("does").and_then(Value::as_str);
            let id = stated_id.unwrap_or_default();
            let sentence = filled_sentence(&sentence_id(id), language, &field);
            sentence.unwrap_or_else(|| id.to_owned())
        }
        other => other.to_string(),
    }
}

fn sentence_id(id: &str) -> String {
    format!("history-{id}")
}

#[cfg(test)]
#[path = "tests/history.rs"]
mod tests;
