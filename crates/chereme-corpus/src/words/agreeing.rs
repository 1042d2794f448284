//! French forms of messages about agreement between annotators, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const AGREEING: &[(&str, &str)] = &[
    ("both tiers empty", "les deux acteurs sont vides"),
    ("one value only", "une seule valeur"),
    ("no item has two values", "aucune unité n’a deux valeurs"),
    ("values are missing", "il manque des valeurs"),
    (
        "no disagreement is expected by chance",
        "le hasard ne fait attendre aucun désaccord",
    ),
    ("no boundary", "aucune frontière"),
    (
        "units with gaps between them",
        "unités séparées par des vides",
    ),
    ("too many units overlap", "trop d’unités se chevauchent"),
    (
        "too many units of {recording} overlap to be aligned: its disagreements are those of units matched by overlap",
        "trop d’unités de {recording} se chevauchent pour être alignées : ses désaccords sont ceux des unités appariées par recouvrement",
    ),
    (
        "no annotation has a value, so only spans are compared",
        "aucune annotation n’a de valeur : seules les durées sont comparées",
    ),
    (
        "annotations without a value are left out: {n} of {a}, {m} of {b}",
        "annotations sans valeur, laissées de côté : {n} de {a}, {m} de {b}",
    ),
    (
        "several tiers of {recording} could belong to {tier}: name both by name or number",
        "plusieurs acteurs de {recording} pourraient aller avec {tier} : nommez les deux par nom ou numéro",
    ),
    (
        "no measure is called {name}",
        "aucune mesure ne s’appelle {name}",
    ),
    ("the measures are: {names}", "les mesures sont : {names}"),
    (
        "units match if 51 to 100 % of the longer one overlap",
        "deux unités se correspondent si 51 à 100 % de la plus longue sont communs",
    ),
    ("ELAN's 60 % is usual", "les 60 % d’ELAN sont l’usage"),
    (
        "{n} draws are more than the {most} that are made at most",
        "{n} tirages, c’est plus que le maximum de {most}",
    ),
    (
        "1000 draws and 30 samples are usual",
        "1000 tirages et 30 échantillons sont l’usage",
    ),
    (
        "the tier {tier} of {recording} would be compared with itself",
        "l’acteur {tier} de {recording} serait comparé à lui-même",
    ),
    (
        "name the tier of the other annotator",
        "nommez l’acteur de l’autre annotateur",
    ),
    (
        "no tier has the annotator {name}; did you mean {other}?",
        "aucun acteur n’a l’annotateur {name} ; vouliez-vous dire {other} ?",
    ),
    (
        "no tier has the annotator {name}",
        "aucun acteur n’a l’annotateur {name}",
    ),
    (
        "`chereme list CORPUS tiers` shows the annotator of each tier",
        "`chereme list CORPUS tiers` montre l’annotateur de chaque acteur",
    ),
    (
        "no recording has both {a} and {b}; did you mean {name}?",
        "aucun enregistrement n’a {a} et {b} à la fois ; vouliez-vous dire {name} ?",
    ),
    (
        "no recording has both {a} and {b}",
        "aucun enregistrement n’a {a} et {b} à la fois",
    ),
    (
        "`chereme list CORPUS tiers` lists all tiers; write their names, \"*-A\" and \"*-B\", annotator:NAME, or tier:12",
        "`chereme list CORPUS tiers` énumère tous les acteurs ; écrivez leurs noms, « *-A » et « *-B », annotator:NOM, ou tier:12",
    ),
    (
        "the two tiers belong to different recordings",
        "les deux acteurs sont de deux enregistrements différents",
    ),
    (
        "copy one of them to the recording of the other, then adjudicate",
        "copiez l’un dans l’enregistrement de l’autre, puis tranchez",
    ),
    (
        "the annotation {value} at {s} s has no length, so it cannot go onto a third tier",
        "l’annotation {value} à {s} s n’a pas de durée et ne peut donc pas aller sur un troisième acteur",
    ),
    (
        "give it an end after its start, or delete it, then adjudicate",
        "donnez-lui une fin après son début, ou supprimez-la, puis tranchez",
    ),
    (
        "several pairs of tiers of {recording} would go onto the tier {tier}",
        "plusieurs paires d’acteurs de {recording} iraient sur l’acteur {tier}",
    ),
    ("name one pair of tiers", "nommez une seule paire d’acteurs"),
];
