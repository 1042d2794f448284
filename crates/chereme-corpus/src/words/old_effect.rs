//! Reads the summaries that programs up to version 12 of the schema stored, when such a file is upgraded.
//!
//! A name may hold one of the words that separate the parts of a summary. Such a summary can be read in two ways, so it is
//! not read and stays a text.

use serde_json::{Map, Value};

use super::effect::{AnnotationDeed, AnnotationEffect, OperationEffect, ValuedThing};
use super::phrases::BlankedPhrase;

/// The forms of summaries by the names of their operations; where there are two, the first that fits is meant.
const OLD_SUMMARIES: [(&str, &str); 31] = [
    ("import", "nothing new"),
    ("import", "{count} files from {first} to {last}"),
    ("import", "{first}"),
    ("recombine", "{gloss} = {recipe}"),
    ("recombine again", "{gloss} = {recipe}"),
    ("annotate", "{changes} in {recording}"),
    ("propose", "{changes} in {recording}"),
    ("accept", "{changes} in {recording}"),
    ("add tier", "{tier} to {recording}"),
    ("change tier", "{tier} of {recording}"),
    ("add tiers", "{count} to {recording}"),
    ("add value", "{value} to {inventory}"),
    ("merge values", "{value} into {into} in {inventory}"),
    ("adjudicate", "{tier}"),
    ("order tiers", "{recording}"),
    ("change recording", "{recording}"),
    ("change signer", "{signer}"),
    ("change media", "{recording}"),
    ("set citation", "token:{token} for {gloss}"),
    ("transcribe", "token:{token} {gloss}"),
    ("add tracks", "{recording}: {tracks}"),
    (
        "merge",
        "{from}: {added} added, {changed} changed, {removed} removed, {conflicts} conflicts",
    ),
    ("keep search", "{names}"),
    ("rename search", "{from} to {to}"),
    ("forget search", "{name}"),
    ("delete", "{names}"),
    ("plan study", "{study}"),
    ("delete study", "{study}"),
    ("forget participant", "{study}"),
    ("change consent", "{names}"),
    ("mend", "tokens derived again"),
];

/// Returns the effect that the summary of an operation with this name means; nothing if it is not clear.
pub(crate) fn effect_of_summary(name: &str, summary: &str) -> Option<OperationEffect> {
    let mut forms = OLD_SUMMARIES.iter().filter(|(known, _)| *known == name);
    let mut fields = forms.find_map(|(_, form)| fields_of_form(form, summary))?;
    match name {
        "import" if fields.len() < 3 => {
            // Several files, whose names hold the word between them.
            if summary.contains(" files from ") {
                return None;
            }
            let first = fields.get("first").cloned().unwrap_or_else(|| "".into());
            fields.insert("count".to_owned(), u64::from(first != "").into());
            fields.insert("first".to_owned(), first.clone());
            fields.insert("last".to_owned(), first);
        }
        "annotate" | "propose" | "accept" => {
            let text = |name: &str| fields.get(name).and_then(Value::as_str);
            let effect = annotation_effect(text("changes")?, text("recording")?)?;
            let count = effect.count_removed();
            let effect = serde_json::to_value(effect).ok()?;
            fields.extend(effect.as_object()?.clone());
            fields.insert("count".to_owned(), count.into());
        }
        "add tier" | "change tier" => {
            let quoted = fields.get("tier").and_then(Value::as_str)?;
            let tier: String = serde_json::from_str(quoted).ok()?;
            fields.insert("tier".to_owned(), tier.into());
        }
        _ => {}
    }
    fields.insert("does".to_owned(), name.replace(' ', "-").into());
    serde_json::from_value(Value::Object(fields)).ok()
}

/// Returns what stands in the blanks of a form; nothing if the text has another form, or its own words more than once.
fn fields_of_form(form: &str, text: &str) -> Option<Map<String, Value>> {
    let mut words = form.split(['{', '}']).step_by(2).filter(|words| !words.is_empty());
    if words.any(|words| text.matches(words).count() != 1) {
        return None;
    }
    let phrase = BlankedPhrase::from_form(form);
    let field = |(name, text): (&str, &str)| {
        let value: Value = match name {
            "count" | "token" | "added" | "changed" | "removed" | "conflicts" => text.parse::<u64>().ok()?.into(),
            "names" | "tracks" => vec![text].into(),
            _ => text.into(),
        };
        Some((name.to_owned(), value))
    };
    phrase.blanks_in(text)?.into_iter().map(field).collect()
}

/// Reads changes of annotations such as `2 added, 1 annotation moved`, and their place.
fn annotation_effect(mut rest: &str, place: &str) -> Option<AnnotationEffect> {
    let mut changes = Vec::new();
    while !rest.is_empty() {
        // The value that annotations got comes last, and may hold commas.
        let valued = valued_deed(rest);
        let (part, after) = match rest.split_once(", ") {
            Some(parts) if valued.is_none() => parts,
            _ => (rest, ""),
        };
        changes.push(valued.or_else(|| counted_deed(part))?);
        rest = after;
    }
    let count_text = place.strip_suffix(" recordings");
    let several = count_text.and_then(|count| count.parse::<u64>().ok());
    let recording = several.map_or(place, |_| "").to_owned();
    let recordings = several.unwrap_or(1);
    Some(AnnotationEffect {
        changes,
        recordings,
        recording,
    })
}

fn counted_deed(part: &str) -> Option<AnnotationDeed> {
    use AnnotationDeed as Deed;
    let (count, what) = part.split_once(' ')?;
    let count: u64 = count.parse().ok()?;
    let noun = if count == 1 { "annotation " } else { "annotations " };
    Some(match what.strip_prefix(noun).unwrap_or(what) {
        "added" => Deed::AnnotationsAdded { count },
        "changed" => Deed::AnnotationsChanged { count },
        "removed" => Deed::AnnotationsRemoved { count },
        "moved" => Deed::AnnotationsMoved { count },
        "merged" => Deed::AnnotationsMerged { count },
        "split" => Deed::AnnotationsSplit { count },
        "says something else" | "say something else" => Deed::AnnotationsRevalued { count },
        _ => return None,
    })
}

fn valued_deed(part: &str) -> Option<AnnotationDeed> {
    let (counted, value) = part.split_once(" changed to ")?;
    let (count, noun) = counted.split_once(' ')?;
    let of = match noun.strip_suffix('s').unwrap_or(noun) {
        "handshape" => ValuedThing::Handshape,
        "placement" => ValuedThing::Placement,
        "movement" => ValuedThing::Movement,
        "orientation" => ValuedThing::Orientation,
        "glos" | "glosse" => ValuedThing::Gloss,
        "annotation" => ValuedThing::Annotation,
        _ => return None,
    };
    let (count, value) = (count.parse().ok()?, value.to_owned());
    Some(AnnotationDeed::AnnotationsValued { count, of, value })
}
