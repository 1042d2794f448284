//! French forms of query errors and their remedies, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const QUERIES: &[(&str, &str)] = &[
    (
        "the value {value} is in no inventory; did you mean {near}?",
        "la valeur {value} n’est dans aucun inventaire ; vouliez-vous dire {near} ?",
    ),
    (
        "the value {value} is in no inventory",
        "la valeur {value} n’est dans aucun inventaire",
    ),
    (
        "known values: {values} and {n} more",
        "valeurs connues : {values} et {n} autres",
    ),
    ("known values: {values}", "valeurs connues : {values}"),
    (
        "a value should stand here",
        "une valeur doit se trouver ici",
    ),
    (
        "write a value, * for any, or unset, n/a or unclear",
        "écrivez une valeur, * pour n’importe laquelle, ou unset, n/a ou unclear",
    ),
    ("there is no field {name}", "il n’y a pas de champ {name}"),
    ("{name} is no component", "{name} n’est pas un composant"),
    (
        "{part} is a part of {component}",
        "{part} est une partie de {component}",
    ),
    (
        "there is no relation {name}",
        "il n’y a pas de relation {name}",
    ),
    (
        "to search for the word, write it in quotes: {word}",
        "pour chercher le mot, écrivez-le entre guillemets : {word}",
    ),
    (
        "the hand stands before {component}, not after it",
        "la main se met avant {component}, pas après",
    ),
    (
        "this is no regular expression: {reason}",
        "ce n’est pas une expression régulière : {reason}",
    ),
    (
        "this bracket is not closed",
        "cette parenthèse n’est pas fermée",
    ),
    ("this value is empty", "cette valeur est vide"),
    ("this sign joins nothing here", "ce signe ne relie rien ici"),
    ("{text} is no time", "{text} n’est pas un temps"),
    ("{text} has no unit", "{text} n’a pas d’unité"),
    ("{text} is no number", "{text} n’est pas un nombre"),
    (
        "there is no unit of time {unit}",
        "il n’y a pas d’unité de temps {unit}",
    ),
    (
        "{operator} does not compare times",
        "{operator} ne compare pas des temps",
    ),
    (
        "{operator} does not compare values",
        "{operator} ne compare pas des valeurs",
    ),
    (
        "{operator} does not compare texts",
        "{operator} ne compare pas des textes",
    ),
    (
        "{operator} has no field on its left",
        "{operator} n’a pas de champ à sa gauche",
    ),
    (
        "{word} needs a comparison on its right",
        "{word} demande une comparaison à sa droite",
    ),
    ("`within` needs a distance", "`within` demande une distance"),
    ("`like` needs an example", "`like` demande un exemple"),
    ("{text} is no likeness", "{text} n’est pas une ressemblance"),
    ("{text} is no example", "{text} n’est pas un exemple"),
    ("which saved search?", "quelle recherche enregistrée ?"),
    ("ask in several steps", "demandez en plusieurs étapes"),
    ("write a number such as {n}", "écrivez un nombre comme {n}"),
    ("one time should stand here", "un temps doit se trouver ici"),
];
