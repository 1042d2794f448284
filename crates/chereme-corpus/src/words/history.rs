//! Sentences that describe the effects of operations.

use std::fmt::Display;

use super::count::counted_in_french;
use super::{Language, Text, deeds, fill};
use crate::OperationRow;

texts! {
    TITLE: "History", "Historique";
    EMPTY: "Nothing has been done yet.", "Rien n’a encore été fait.";
    FILTER: "Who or what", "Qui ou quoi";
    NONE_FIT: "Nothing like that was done.", "Rien de tel n’a été fait.";
    NOW: "now", "maintenant";
    UNDONE: "undone", "annulé";
    GONE: "undone, and not to be done again", "annulé, et ne peut être rétabli";
    BEGINNING: "The empty corpus", "Le corpus vide";
    TIP_BACK: "Click to go back to just after this", "Cliquez pour revenir juste après ceci";
    TIP_FORWARD: "Click to do it again, up to here", "Cliquez pour rétablir jusqu’ici";
    WALK_BACK: "Undo {n} steps?", "Annuler {n} étapes ?";
    WALK_FORWARD: "Do {n} steps again?", "Rétablir {n} étapes ?";
    WALK_GO: "Yes", "Oui";
    WALKED_BACK: "{n} steps undone.", "{n} étapes annulées.";
    WALKED_FORWARD: "{n} steps done again.", "{n} étapes rétablies.";
    UNDID: "undone: operation {id}, {what}", "annulé : opération {id}, {what}";
    REDID: "done again: operation {id}, {what}", "rétabli : opération {id}, {what}";
    ALL_UNDONE: "{count} undone, and nothing is left to undo ({asked} were asked for)", "annulé : {count}, et il ne reste rien à annuler ({asked} étaient demandées)";
    ALL_REDONE: "{count} done again, and nothing is left to redo ({asked} were asked for)", "rétabli : {count}, et il ne reste rien à rétablir ({asked} étaient demandées)";
    UNDO_OF: "undo of {id}: ", "annulation de {id} : ";
    REDO_OF: "redo of {id}: ", "rétablissement de {id} : ";
    NUMBER: "id", "n°";
    WHEN: "when", "quand";
    WHO: "who", "qui";
    WHAT: "what", "quoi";
    CHANGES: "changes", "modifications";
    DID_IMPORT: "Imported: {what}", "Importé : {what}";
    FILES: "{n} files from {first} to {last}", "{n} fichiers, de {first} à {last}";
    NOTHING_NEW: "nothing new", "rien de nouveau";
    DID_RECOMBINE: "{gloss} made: {recipe}", "{gloss} composé : {recipe}";
    DID_RECOMBINE_AGAIN: "{gloss} made again: {recipe}", "{gloss} refait : {recipe}";
    DID_ANNOTATE: "{what} in {place}", "{what} dans {place}";
    ADDED: "{n} annotations added", "{n} annotations ajoutées";
    ONE_ADDED: "{n} annotation added", "{n} annotation ajoutée";
    CHANGED: "{n} annotations changed", "{n} annotations modifiées";
    ONE_CHANGED: "{n} annotation changed", "{n} annotation modifiée";
    REMOVED: "{n} annotations removed", "{n} annotations supprimées";
    ONE_REMOVED: "{n} annotation removed", "{n} annotation supprimée";
    ONE_RESTORED: "{n} annotation restored in {place}", "{n} annotation rétablie dans {place}";
    RESTORED: "{n} annotations restored in {place}", "{n} annotations rétablies dans {place}";
    TAKEN_BACK: "Undone: {what}", "Annulé : {what}";
    DONE_AGAIN: "Done again: {what}", "Rétabli : {what}";
    BY_OTHERS: "{who} changed the corpus in another program: {what}", "{who} a modifié le corpus dans un autre programme : {what}";
    DID_ADD_TIER: "Tier {tier} added to {place}", "Acteur {tier} ajouté à {place}";
    DID_CHANGE_TIER: "Tier {tier} of {place} changed", "Acteur {tier} de {place} modifié";
    DID_REMOVE_TIER: "Tier removed: {what}", "Acteur supprimé : {what}";
    DID_CHANGE_RECORDING: "Recording changed: {what}", "Enregistrement modifié : {what}";
    DID_CHANGE_SIGNER: "Signer changed: {what}", "Signeur modifié : {what}";
    DID_CHANGE_SIGN: "Sign changed: {what}", "Signe modifié : {what}";
    DID_CITE: "Citation form: {what}", "Forme de citation : {what}";
    DID_TRANSCRIBE: "Transcribed: {what}", "Transcrit : {what}";
    DID_PROPOSE: "Proposed from movement: {what}", "Proposé d’après le mouvement : {what}";
    DID_ACCEPT: "Proposed values accepted: {n}, in {place}", "Valeurs proposées acceptées : {n}, dans {place}";
    DID_ADJUDICATE: "Adjudicated on the tier {what}", "Tranché sur l’acteur {what}";
    DID_ADD_TIERS: "Tiers added: {what}", "Acteurs ajoutés : {what}";
    DID_COPY_TIER: "Tier copied: {what}", "Acteur copié : {what}";
    DID_ORDER_TIERS: "Tiers put in order: {what}", "Acteurs remis en ordre : {what}";
    DID_ADD_TRACKS: "Tracks added: {what}", "Pistes ajoutées : {what}";
    DID_CHANGE_TRACK: "Track changed: {what}", "Piste modifiée : {what}";
    DID_CHANGE_MEDIA: "Media changed: {what}", "Média modifié : {what}";
    DID_ADD_VALUE: "Value {value} added to {place}", "Valeur {value} ajoutée à {place}";
    DID_MERGE_VALUES: "Value {value} merged into {into} in {place}", "Valeur {value} fusionnée avec {into} dans {place}";
    DID_KEEP_SEARCH: "Search saved: {what}", "Recherche enregistrée : {what}";
    DID_RENAME_SEARCH: "Search renamed: {what}", "Recherche renommée : {what}";
    DID_PLAN_STUDY: "Study planned: {what}", "Étude préparée : {what}";
    DID_IMPORT_ANSWERS: "Answers imported: {what}", "Réponses importées : {what}";
    DID_FORGET_PARTICIPANT: "Participant of a study deleted: {what}", "Participant d’une étude supprimé : {what}";
    DID_CHANGE_CONSENT: "Consent changed: {what}", "Consentement modifié : {what}";
    DID_DELETE_STUDY: "Study deleted: {what}", "Étude supprimée : {what}";
    DID_DELETE: "Deleted: {what}", "Supprimé : {what}";
    BACK_AGAIN: "Restored: {what}", "Rétabli : {what}";
    DID_FORGET_SEARCH: "Saved search removed: {what}", "Recherche enregistrée supprimée : {what}";
}

/// Returns the summary of an import in a language; names of files stay as they are.
fn imported(summary: &str, language: Language) -> String {
    if summary == NOTHING_NEW.en {
        return NOTHING_NEW.of(language).to_owned();
    }
    let files = summary.split_once(" files from ").and_then(|(n, rest)| {
        let (first, last) = rest.split_once(" to ")?;
        let n: usize = n.parse().ok()?;
        Some(fill(
            FILES.of(language),
            &[("n", &n), ("first", &first), ("last", &last)],
        ))
    });
    files.unwrap_or_else(|| summary.to_owned())
}

/// Returns the effect of an operation, as a sentence.
#[must_use]
pub fn sentence(it: &OperationRow, language: Language) -> String {
    let say = |text: Text, values: &[(&str, &dyn Display)]| fill(text.of(language), values);
    let summary = it.summary.as_str();
    let parted = |word: &str| summary.rsplit_once(word);
    let known = match it.name.as_str() {
        "import" => Some(say(DID_IMPORT, &[("what", &imported(summary, language))])),
        "recombine" | "recombine again" => summary.split_once(" = ").map(|(gloss, recipe)| {
            let text = if it.name == "recombine" {
                DID_RECOMBINE
            } else {
                DID_RECOMBINE_AGAIN
            };
            say(text, &[("gloss", &gloss), ("recipe", &recipe)])
        }),
        "annotate" => annotated(summary, language),
        "add tier" => parted(" to ").map(|(tier, place)| {
            let tier = tier.trim_matches('"');
            say(DID_ADD_TIER, &[("tier", &tier), ("place", &place)])
        }),
        "change tier" => parted(" of ").map(|(tier, place)| {
            let tier = tier.trim_matches('"');
            say(DID_CHANGE_TIER, &[("tier", &tier), ("place", &place)])
        }),
        "add value" => parted(" to ")
            .map(|(value, place)| say(DID_ADD_VALUE, &[("value", &value), ("place", &place)])),
        "merge values" => parted(" in ").and_then(|(values, place)| {
            let (value, into) = values.split_once(" into ")?;
            let all: [(&str, &dyn Display); 3] =
                [("value", &value), ("into", &into), ("place", &place)];
            Some(say(DID_MERGE_VALUES, &all))
        }),
        "merge" => Some(say(super::merge::DID_MERGE, &[("what", &summary)])),
        "decide" => Some(say(super::merge::DID_DECIDE, &[("what", &summary)])),
        "propose" => annotated(summary, language).map(|what| say(DID_PROPOSE, &[("what", &what)])),
        "accept" => {
            accepted(summary).map(|(n, place)| say(DID_ACCEPT, &[("n", &n), ("place", &place)]))
        }
        name => plain(name).map(|text| say(text, &[("what", &summary)])),
    };
    known.unwrap_or_else(|| format!("{}: {summary}", it.name))
}

/// Returns the number of proposals that `2 added, 2 removed in X` accepted, and X: each is replaced by a value.
fn accepted(summary: &str) -> Option<(&str, &str)> {
    let (counts, place) = summary.rsplit_once(" in ")?;
    let n = counts
        .split(", ")
        .find_map(|it| it.strip_suffix(" removed"))?;
    Some((n, place))
}

/// Returns the sentence for operations whose summary is inserted unchanged.
fn plain(name: &str) -> Option<Text> {
    Some(match name {
        "remove tier" => DID_REMOVE_TIER,
        "adjudicate" => DID_ADJUDICATE,
        "add tiers" => DID_ADD_TIERS,
        "copy tier" => DID_COPY_TIER,
        "order tiers" => DID_ORDER_TIERS,
        "change recording" => DID_CHANGE_RECORDING,
        "change signer" => DID_CHANGE_SIGNER,
        "change sign" => DID_CHANGE_SIGN,
        "set citation" => DID_CITE,
        "transcribe" => DID_TRANSCRIBE,
        "add tracks" => DID_ADD_TRACKS,
        "change track" => DID_CHANGE_TRACK,
        "change media" => DID_CHANGE_MEDIA,
        "keep search" => DID_KEEP_SEARCH,
        "rename search" => DID_RENAME_SEARCH,
        "forget search" => DID_FORGET_SEARCH,
        "delete" => DID_DELETE,
        "plan study" => DID_PLAN_STUDY,
        "import answers" => DID_IMPORT_ANSWERS,
        "forget participant" => DID_FORGET_PARTICIPANT,
        "delete study" => DID_DELETE_STUDY,
        "change consent" => DID_CHANGE_CONSENT,
        _ => return None,
    })
}

/// Returns the effect of undoing an operation, as a sentence: removed things are restored.
#[must_use]
pub fn taken_back(it: &OperationRow, language: Language) -> String {
    let restored = || {
        let (counts, place) = it.summary.rsplit_once(" in ")?;
        let (n, what) = counts.split_once(' ')?;
        let text = if n == "1" { ONE_RESTORED } else { RESTORED };
        let values: [(&str, &dyn Display); 2] = [("n", &n), ("place", &place)];
        (it.name == "annotate" && what == "removed").then(|| fill(text.of(language), &values))
    };
    if it.name == "delete" {
        return fill(BACK_AGAIN.of(language), &[("what", &it.summary)]);
    }
    let whole = || {
        fill(
            TAKEN_BACK.of(language),
            &[("what", &sentence(it, language))],
        )
    };
    restored().unwrap_or_else(whole)
}

/// Returns `2 added, 1 changed in X`, or the names of the changed things, as a sentence.
#[must_use]
pub fn annotated(summary: &str, language: Language) -> Option<String> {
    let (counts, place) = summary.rsplit_once(" in ")?;
    let mut parts = Vec::new();
    let mut rest = Some(counts);
    while let Some(now) = rest {
        // The text of a value comes last, and may contain commas.
        if let Some(whole) = deeds::translated(now, language) {
            parts.push(whole);
            break;
        }
        let (part, after) = match now.split_once(", ") {
            Some((part, after)) => (part, Some(after)),
            None => (now, None),
        };
        rest = after;
        if let Some(part) = deeds::translated(part, language) {
            parts.push(part);
            continue;
        }
        let (count, what) = part.split_once(' ')?;
        let text = match (what, count == "1") {
            ("added", true) => ONE_ADDED,
            ("added", false) => ADDED,
            ("changed", true) => ONE_CHANGED,
            ("changed", false) => CHANGED,
            ("removed", true) => ONE_REMOVED,
            ("removed", false) => REMOVED,
            _ => return None,
        };
        parts.push(fill(text.of(language), &[("n", &count)]));
    }
    let parts = parts.join(", ");
    let place = match (language, counted_in_french(place)) {
        (Language::French, Some(several)) => several,
        _ => place.to_owned(),
    };
    let values: [(&str, &dyn Display); 2] = [("what", &parts), ("place", &place)];
    Some(fill(DID_ANNOTATE.of(language), &values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::OperationKind;

    fn row(
        id: i64,
        kind: OperationKind,
        target: Option<i64>,
        name: &str,
        summary: &str,
    ) -> OperationRow {
        OperationRow {
            id,
            at: "2026-01-02T03:04:05Z".into(),
            author: "Zoé".into(),
            kind,
            target,
            name: name.into(),
            summary: summary.into(),
            changes: 1,
            stands: true,
        }
    }

    #[test]
    fn operations_are_sentences_in_both_languages() {
        for (name, summary, english, french) in [
            (
                "propose",
                "3 added in 2 recordings",
                "Proposed from movement: 3 annotations added in 2 recordings",
                "Proposé d’après le mouvement : 3 annotations ajoutées dans 2 enregistrements",
            ),
            (
                "annotate",
                "2 added, 1 removed in Un",
                "2 annotations added, 1 annotation removed in Un",
                "2 annotations ajoutées, 1 annotation supprimée dans Un",
            ),
            (
                "recombine",
                "LIMACE = ESCARGOT | swap",
                "LIMACE made: ESCARGOT | swap",
                "LIMACE composé : ESCARGOT | swap",
            ),
            (
                "annotate",
                "3 handshapes changed to U in Un",
                "3 handshapes changed to U in Un",
                "3 configurations changées en U dans Un",
            ),
            (
                "annotate",
                "1 annotation moved, 2 glosses changed to A, moved in B in Un",
                "1 annotation moved, 2 glosses changed to A, moved in B in Un",
                "1 annotation déplacée, 2 gloses changées en A, moved in B dans Un",
            ),
            (
                "annotate",
                "2 annotations merged in Un",
                "2 annotations merged in Un",
                "2 annotations fusionnées dans Un",
            ),
            ("import", "a.bvh", "Imported: a.bvh", "Importé : a.bvh"),
            (
                "import",
                "27 files from aimer.bvh to week-end.eaf",
                "Imported: 27 files from aimer.bvh to week-end.eaf",
                "Importé : 27 fichiers, de aimer.bvh à week-end.eaf",
            ),
            (
                "import",
                "nothing new",
                "Imported: nothing new",
                "Importé : rien de nouveau",
            ),
            (
                "propose",
                "2 added in Un",
                "Proposed from movement: 2 annotations added in Un",
                "Proposé d’après le mouvement : 2 annotations ajoutées dans Un",
            ),
            (
                "accept",
                "2 added, 2 removed in Un",
                "Proposed values accepted: 2, in Un",
                "Valeurs proposées acceptées : 2, dans Un",
            ),
            (
                "keep search",
                "chins",
                "Search saved: chins",
                "Recherche enregistrée : chins",
            ),
            (
                "annotate",
                "2 removed in Un",
                "2 annotations removed in Un",
                "2 annotations supprimées dans Un",
            ),
            (
                "merge values",
                "2S into 2s in hands",
                "Value 2S merged into 2s in hands",
                "Valeur 2S fusionnée avec 2s dans hands",
            ),
            ("delete", "a, B", "Deleted: a, B", "Supprimé : a, B"),
            ("novel", "x", "novel: x", "novel: x"),
        ] {
            let row = row(1, OperationKind::Do, None, name, summary);
            assert_eq!(sentence(&row, Language::English), english);
            assert_eq!(sentence(&row, Language::French), french);
        }
    }

    #[test]
    fn undoing_a_removal_reads_as_a_restoration() {
        for (summary, english, french) in [
            (
                "3 removed in Un",
                "3 annotations restored in Un",
                "3 annotations rétablies dans Un",
            ),
            (
                "1 removed in Un",
                "1 annotation restored in Un",
                "1 annotation rétablie dans Un",
            ),
            (
                "2 annotations merged in Un",
                "Undone: 2 annotations merged in Un",
                "Annulé : 2 annotations fusionnées dans Un",
            ),
        ] {
            let row = row(2, OperationKind::Undo, Some(1), "annotate", summary);
            assert_eq!(taken_back(&row, Language::English), english);
            assert_eq!(taken_back(&row, Language::French), french);
        }
        let row = row(2, OperationKind::Undo, Some(1), "delete", "escargot");
        assert_eq!(taken_back(&row, Language::French), "Rétabli : escargot");
    }
}
