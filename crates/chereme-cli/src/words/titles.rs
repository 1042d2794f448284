//! Titles of the tables that commands print, in English and French. Names of columns that filters use stay English.

use chereme_corpus::words::Language;

/// Titles in English and French.
const TITLES: &[(&str, &str)] = &[
    ("action", "action"),
    ("adds", "ajoute"),
    ("address", "adresse"),
    ("alike in", "pareils en"),
    ("arrives ms", "arrive ms"),
    (
        "begins ms: median (quartiles)",
        "part ms : médiane (quartiles)",
    ),
    ("begins: median (quartiles)", "début : médiane (quartiles)"),
    ("channel", "canal"),
    ("channels", "canaux"),
    ("component", "composant"),
    ("components", "composants"),
    ("confidence", "confiance"),
    ("count", "nombre"),
    ("differs in", "diffère par"),
    ("differs most in", "diffère surtout par"),
    ("distance a frame", "distance par image"),
    ("duration", "durée"),
    ("duration_s", "durée_s"),
    ("end", "fin"),
    ("ends: median (quartiles)", "fin : médiane (quartiles)"),
    ("face_mm", "visage_mm"),
    ("feature", "trait"),
    ("fingers", "doigts"),
    ("first source", "première source"),
    ("formula", "formule"),
    ("frames", "images"),
    ("function", "fonction"),
    ("gloss", "glose"),
    ("hand", "main"),
    ("hand_axis_mm", "axe_main_mm"),
    ("hand_mm", "main_mm"),
    ("hidden", "cachés"),
    ("instead", "à la place"),
    ("join", "raccord"),
    ("joint", "articulation"),
    ("keys", "clés"),
    ("kind", "genre"),
    ("least", "minimum"),
    ("length", "durée"),
    ("line", "ligne"),
    ("marker", "marqueur"),
    ("mean", "moyenne"),
    ("mean difference", "écart moyen"),
    ("median_mm", "médiane_mm"),
    ("milestones", "jalons"),
    ("most", "maximum"),
    ("most alike", "le plus proche"),
    ("most_mm", "maximum_mm"),
    ("number", "nombre"),
    ("numbers of a face", "nombres d’un visage"),
    ("name", "nom"),
    ("offset_s", "décalage_s"),
    ("origin", "origine"),
    ("pair", "paire"),
    ("part", "partie"),
    ("partner", "partenaire"),
    ("path", "chemin"),
    ("phase", "phase"),
    ("phones", "phones"),
    ("placement", "emplacement"),
    ("predicted", "prévu"),
    ("produced", "produit"),
    ("rate", "cadence"),
    ("read back", "relu"),
    ("recipe", "recette"),
    ("recording", "enregistrement"),
    ("residual", "écart"),
    ("restored", "restaurés"),
    ("rule", "règle"),
    ("runner-up", "second choix"),
    ("score", "score"),
    ("seconds", "secondes"),
    ("seen", "vu"),
    ("sentence", "phrase"),
    ("shape", "configuration"),
    ("share", "part"),
    ("sign", "signe"),
    ("signs", "signes"),
    ("slip", "erreur"),
    ("source", "source"),
    ("start", "début"),
    ("stretch", "étirement"),
    ("system", "système"),
    ("tier", "acteur"),
    ("tiers", "acteurs"),
    ("times above", "fois au-dessus"),
    ("times below", "fois au-dessous"),
    ("token", "occurrence"),
    ("uncertain", "incertains"),
    ("value", "valeur"),
    ("wanted", "voulu"),
    ("weights", "poids"),
];

/// Returns the title of a column in `language`; a title that the table lacks stays as it is.
pub(crate) fn title(title: &str, language: Language) -> &str {
    let known = TITLES.iter().find(|known| known.0 == title);
    match (language, known) {
        (Language::French, Some((_, french))) => french,
        _ => title,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_title_has_one_french_form() {
        for (at, (english, french)) in TITLES.iter().enumerate() {
            assert!(!french.trim().is_empty(), "{english}");
            assert!(
                !TITLES[at + 1..].iter().any(|it| it.0 == *english),
                "{english}"
            );
        }
        assert_eq!(title("length", Language::French), "durée");
        assert_eq!(title("length", Language::English), "length");
        assert_eq!(title("offset_us", Language::French), "offset_us");
    }
}
