//! Counts of things as text, in singular and plural.

use super::Language;

/// Nouns as plural, singular, French singular and French plural.
const NOUNS: [(&str, &str, &str, &str); 39] = [
    ("annotations", "annotation", "annotation", "annotations"),
    ("answers", "answer", "réponse", "réponses"),
    ("attributes", "attribute", "attribut", "attributs"),
    ("blocks", "block", "bloc", "blocs"),
    ("changes", "change", "modification", "modifications"),
    ("columns", "column", "colonne", "colonnes"),
    ("conflicts", "conflict", "conflit", "conflits"),
    ("curves", "curve", "courbe", "courbes"),
    ("edits", "edit", "modification", "modifications"),
    ("files", "file", "fichier", "fichiers"),
    ("frames", "frame", "image", "images"),
    (
        "index documents",
        "index document",
        "document de l’index",
        "documents de l’index",
    ),
    ("inventories", "inventory", "inventaire", "inventaires"),
    ("joints", "joint", "articulation", "articulations"),
    ("media", "media file", "média", "médias"),
    ("notations", "notation", "notation", "notations"),
    ("operations", "operation", "opération", "opérations"),
    ("participants", "participant", "participant", "participants"),
    (
        "pairs of frames",
        "pair of frames",
        "paire d’images",
        "paires d’images",
    ),
    (
        "pairs of tiers",
        "pair of tiers",
        "paire d’acteurs",
        "paires d’acteurs",
    ),
    ("points", "point", "point", "points"),
    ("questions", "question", "question", "questions"),
    ("recipes", "recipe", "recette", "recettes"),
    (
        "recordings",
        "recording",
        "enregistrement",
        "enregistrements",
    ),
    ("rows", "row", "ligne", "lignes"),
    ("samples", "sample", "échantillon", "échantillons"),
    ("searches", "search", "recherche", "recherches"),
    ("signers", "signer", "signeur", "signeurs"),
    ("signs", "sign", "signe", "signes"),
    ("skeletons", "skeleton", "squelette", "squelettes"),
    ("studies", "study", "étude", "études"),
    ("symbols", "symbol", "symbole", "symboles"),
    ("tables", "table", "table", "tables"),
    ("tiers", "tier", "acteur", "acteurs"),
    ("times", "time", "fois", "fois"),
    ("tokens", "token", "occurrence", "occurrences"),
    ("units", "unit", "unité", "unités"),
    ("values", "value", "valeur", "valeurs"),
    ("tracks", "track", "piste", "pistes"),
];

/// Returns `1 token`, `2 tokens`, with the noun given in its plural.
#[must_use]
pub fn counted(count: u64, noun: &str) -> String {
    counted_in(count, noun, Language::English)
}

/// Returns a count of things in a language; a noun that the table lacks stays English.
#[must_use]
pub fn counted_in(count: u64, noun: &str, language: Language) -> String {
    format!("{count} {}", numbered(count, noun, language))
}

/// Returns the form of a noun, given in its plural, that goes with a number.
#[must_use]
pub fn numbered(count: u64, noun: &str, language: Language) -> String {
    let known = NOUNS.iter().find(|known| known.0 == noun);
    match (known, language) {
        // French uses the plural from two on.
        (Some((_, _, one, many)), Language::French) => {
            if count < 2 { one } else { many }.to_string()
        }
        (Some((many, one, ..)), Language::English) => {
            if count == 1 { one } else { many }.to_string()
        }
        (None, _) if count != 1 => noun.to_owned(),
        (None, _) => match noun.strip_suffix("ies") {
            Some(stem) => format!("{stem}y"),
            None => noun.strip_suffix('s').unwrap_or(noun).to_owned(),
        },
    }
}

/// Returns a count in English words, such as `2 tokens`, in French; nothing if the noun is unknown.
pub(super) fn counted_in_french(text: &str) -> Option<String> {
    let (count, noun) = text.split_once(' ')?;
    let count: u64 = count.parse().ok()?;
    let (plural, ..) = NOUNS.iter().find(|it| noun == it.0 || noun == it.1)?;
    Some(counted_in(count, plural, Language::French))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_in_messages_are_put_into_french() {
        for (english, french) in [
            ("1 token", Some("1 occurrence")),
            ("12 pairs of frames", Some("12 paires d’images")),
            ("3 fancies", None),
            ("tokens", None),
        ] {
            assert_eq!(counted_in_french(english).as_deref(), french);
        }
    }

    #[test]
    fn nouns_agree_with_their_numbers() {
        for (count, noun, english, french) in [
            (1, "tokens", "1 token", "1 occurrence"),
            (0, "tokens", "0 tokens", "0 occurrence"),
            (2, "inventories", "2 inventories", "2 inventaires"),
            (1, "inventories", "1 inventory", "1 inventaire"),
            (1, "searches", "1 search", "1 recherche"),
            (1, "fancies", "1 fancy", "1 fancy"),
            (
                1,
                "novelties of a kind",
                "1 novelties of a kind",
                "1 novelties of a kind",
            ),
        ] {
            assert_eq!(counted(count, noun), english);
            assert_eq!(counted_in(count, noun, Language::French), french);
        }
    }
}
