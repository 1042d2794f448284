//! Guides with examples in French, line by line, such as the help of queries.

use chereme_analysis::detect::DETECTORS;
use chereme_compose::recipe::Step;

use super::{Forms, Language};

/// Lines, and notes behind examples, in English and French.
const GUIDES: &[(&str, &str)] = &[
    (
        "A query is a list of conditions; a token must meet all of them:",
        "Une requête est une liste de conditions ; une occurrence doit les remplir toutes :",
    ),
    (
        "U on the right hand, near the chin",
        "U à la main droite, près du menton",
    ),
    (
        "a gloss in BO..., weak hand without S",
        "une glose en BO..., main non dominante sans S",
    ),
    (
        "one or the other; parentheses group",
        "l’un ou l’autre ; les parenthèses groupent",
    ),
    (
        "Components, on either hand unless one is named",
        "Composants, à l’une ou l’autre main si aucune n’est nommée",
    ),
    ("before it: the hand", "devant : la main"),
    (
        "before it: first, between, last value;",
        "devant : première valeur, entre deux, dernière ;",
    ),
    (
        "a single value is both first and last",
        "une valeur seule est première et dernière",
    ),
    ("after it: one part of it", "derrière : une de ses parties"),
    (
        "synonyms: handshape, location, emplacement, mouvement",
        "synonymes : handshape, location, emplacement, mouvement",
    ),
    ("Values", "Valeurs"),
    (
        "one of these, or a narrower value",
        "l’une d’elles, ou une valeur plus précise",
    ),
    (
        "exactly this, nothing narrower",
        "celle-ci même, rien de plus précis",
    ),
    (
        "begins at the head, then the chest",
        "commence à la tête, puis la poitrine",
    ),
    (
        "begins at the head, then elsewhere",
        "commence à la tête, puis ailleurs",
    ),
    ("coded, with another value", "codé, avec une autre valeur"),
    (
        "with blanks: in quotes",
        "avec des espaces : entre guillemets",
    ),
    (
        "* for any characters of value or name;",
        "* pour tous caractères de la valeur ou du nom ;",
    ),
    (
        "case counts only after a double sign",
        "la casse ne compte qu’après un signe double",
    ),
    (
        "features, and one that is absent",
        "des traits, dont un absent",
    ),
    ("has a value", "a une valeur"),
    (
        "the three kinds of missing values",
        "les trois sortes de valeurs manquantes",
    ),
    (
        "Texts: gloss, translation, comment, text (all three)",
        "Textes : gloss, translation, comment, text (tous les trois)",
    ),
    (
        "words anywhere; a phrase",
        "des mots n’importe où ; une expression",
    ),
    ("the whole text", "le texte entier"),
    ("words in it", "des mots dedans"),
    ("up to one slip, or two", "à une faute près, ou deux"),
    (
        "a regular expression, in any text",
        "une expression régulière, dans tout texte",
    ),
    (
        "Times: duration, start, end, in s, ms or min",
        "Temps : duration, start, end, en s, ms ou min",
    ),
    (
        "Attributes of the sign, from a lexicon table",
        "Attributs du signe, d’une table de lexique",
    ),
    (
        "Curves of face and head during the token (1 is the usual reach, or degrees)",
        "Courbes du visage et de la tête pendant l’occurrence (1 est l’ampleur usuelle, ou degrés)",
    ),
    (
        "Keys of cued speech, placement before shape",
        "Clés de la LfPC, l’emplacement avant la forme",
    ),
    (
        "milliseconds from the sound to the hand",
        "millisecondes du son à la main",
    ),
    ("The token as a whole", "L’occurrence entière"),
    (
        "of its annotation, else of its values",
        "de son annotation, sinon de ses valeurs",
    ),
    (
        "Relation to another annotation of the recording",
        "Relation à une autre annotation de l’enregistrement",
    ),
    ("By example", "Par l’exemple"),
    (
        "only more similar tokens",
        "seulement des occurrences plus semblables",
    ),
    (
        "Saved searches, anywhere in a query",
        "Recherches enregistrées, partout dans une requête",
    ),
    (
        "French works, too: et, ou, non, chevauche, avant, après, dans, couvre.",
        "Le français marche aussi : et, ou, non, chevauche, avant, après, dans, couvre.",
    ),
    (
        "Everyday words that find nothing, such as handshape U placement chin,",
        "Des mots de tous les jours sans résultat, comme handshape U placement chin,",
    ),
    (
        "lead to a suggested query.",
        "mènent à une requête proposée.",
    ),
];

/// Returns a guide in `language`: its headings, and the notes two blanks or more behind an example; examples stay.
#[must_use]
pub fn guide(text: &str, language: Language) -> String {
    guide_among(text, language, &[])
}

/// Returns a guide in `language`, as [`guide`] does, with words of the library and those of a program, `own`.
#[must_use]
pub fn guide_among(text: &str, language: Language, own: &[Forms]) -> String {
    match language {
        Language::English => text.to_owned(),
        Language::French => text
            .split('\n')
            .map(|line| in_french(line, own))
            .collect::<Vec<_>>()
            .join("\n"),
    }
}

fn in_french(line: &str, own: &[Forms]) -> String {
    let words = line.trim_start();
    let note = words.rsplit("  ").next().unwrap_or(words);
    let examples = || Step::DESCRIPTIONS.iter().flat_map(|it| it.examples);
    let known = |text: &str| {
        let operators = examples().map(|(_, effect)| (effect.en, effect.fr));
        let detectors = DETECTORS.iter().map(|it| it.description().finds);
        let detectors = detectors.map(|finds| (finds.en, finds.fr));
        let own = own.iter().copied().flatten();
        let mut all = GUIDES.iter().chain(own).copied();
        let found = all.find(|(english, _)| *english == text);
        found.or_else(|| {
            let mut described = operators.chain(detectors);
            described.find(|(english, _)| *english == text)
        })
    };
    match known(words).or_else(|| known(note)) {
        Some((english, french)) => format!("{}{french}", &line[..line.len() - english.len()]),
        None => line.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_of_queries_is_french_and_keeps_its_examples() {
        let english = crate::QUERY_HELP;
        assert_eq!(guide(english, Language::English), english);
        let french = guide(english, Language::French);
        assert_eq!(french.lines().count(), english.lines().count());
        assert!(
            french.starts_with("Une requête est") && !french.contains(" the "),
            "{french}"
        );
        for line in [
            "  right.configuration=U placement=chin    U à la main droite, près du menton",
            "  gloss~ESCARGO   gloss~ESCRGO~2          à une faute près, ou deux",
            "  overlaps  not-overlaps  inside  not-inside  overlaps-begin  overlaps-end",
        ] {
            assert!(french.lines().any(|it| it == line), "{line}");
        }
    }
}
