//! French words for the kinds of rows that an overview counts.

use chereme_corpus::TierRole;
use chereme_corpus::words::InterfaceLanguage;

/// Kinds besides roles of tiers, as commands and queries spell them, and in French: one, and several.
const ROW_KIND_WORDS: [(&str, &str, &str); 10] = [
    ("captured", "capté", "captés"),
    ("annotated", "annoté", "annotés"),
    ("generated", "produit", "produits"),
    ("made", "composé", "composés"),
    ("lexicon", "de lexique", "de lexique"),
    ("configuration", "de configuration", "de configuration"),
    ("placement", "d’emplacement", "d’emplacement"),
    ("movement", "de mouvement", "de mouvement"),
    ("orientation", "d’orientation", "d’orientation"),
    ("nonmanual", "non manuel", "non manuels"),
];

/// Returns a number of rows of a kind in a language; in French the word of queries follows in brackets if it differs.
pub(crate) fn format_kind_count(count: u64, kind: &str, language: InterfaceLanguage) -> String {
    let roles = TierRole::PLAIN_TIER_ROLES.iter().map(|role| {
        let [one, several] = role.role_words().counted;
        (role.role_kind_name(), one, several)
    });
    let mut all = ROW_KIND_WORDS.iter().copied().chain(roles);
    let known_kind = all.find(|(english, ..)| *english == kind);
    match (language, known_kind) {
        (InterfaceLanguage::French, Some((english, one, several))) => {
            let word = if count < 2 { one } else { several };
            match word.ends_with(english) {
                true => format!("{count} {word}"),
                false => format!("{count} {word} ({english})"),
            }
        }
        _ => format!("{count} {kind}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_have_french_words_and_keep_those_of_queries() {
        for (count, kind, french) in [
            (1, "made", "1 composé (made)"),
            (2, "free", "2 libres (free)"),
            (1, "gloss", "1 de gloses (gloss)"),
            (2, "orientation", "2 d’orientation"),
            (3, "skeleton", "3 skeleton"),
        ] {
            assert_eq!(format_kind_count(count, kind, InterfaceLanguage::French), french);
        }
        assert_eq!(format_kind_count(2, "made", InterfaceLanguage::English), "2 made");
    }
}
