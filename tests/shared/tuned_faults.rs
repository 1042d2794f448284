//! Checks the documents of tuned numbers; crates with such a document take this file as a module of their tests.

use std::collections::BTreeMap;

use serde_json::Value;

/// Lists the numbers of a document that lack a meaning, or whose unit the document's description does not explain.
pub(crate) fn tuned_document_faults(text: &str) -> Vec<String> {
    let mut groups: BTreeMap<String, Value> = match serde_json::from_str(text) {
        Ok(groups) => groups,
        Err(error) => return vec![error.to_string()],
    };
    let mut fault_texts = Vec::new();
    if groups.remove("version").is_none() {
        fault_texts.push("no version".to_owned());
    }
    let description = groups.remove("description").unwrap_or_default().to_string();
    for (group, numbers) in groups {
        let numbers: BTreeMap<String, (Value, String, String)> = match serde_json::from_value(numbers) {
            Ok(numbers) => numbers,
            Err(error) => {
                fault_texts.push(format!("{group}: {error}"));
                continue;
            }
        };
        for (name, (_, units, meaning)) in numbers {
            for unit in units.split(", ") {
                if !description.contains(&format!(" {unit} ")) {
                    fault_texts.push(format!("{group}.{name}: the unit {unit}"));
                }
            }
            if meaning.len() < 14 {
                fault_texts.push(format!("{group}.{name}: the meaning {meaning}"));
            }
        }
    }
    fault_texts
}
