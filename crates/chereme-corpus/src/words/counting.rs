//! French forms of messages about the statistics of a lexicon, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const COUNTING: &[(&str, &str)] = &[
    (
        "no entry has a value in all of the fields",
        "aucune entrée n’a de valeur dans tous les champs",
    ),
    ("no entry has a value", "aucune entrée n’a de valeur"),
    (
        "all entries have the same form",
        "toutes les entrées ont la même forme",
    ),
    (
        "all entries have the same value",
        "toutes les entrées ont la même valeur",
    ),
    ("nothing was drawn", "rien n’a été tiré"),
    (
        "there are too many pairs of values",
        "il y a trop de paires de valeurs",
    ),
    (
        "the numbers do not allow it",
        "les nombres ne le permettent pas",
    ),
    ("1000 are usual", "1000 sont l’usage"),
    (
        "the field {name} is not among the fields",
        "le champ {name} n’est pas parmi les champs",
    ),
    ("the fields are: {names}", "les champs sont : {names}"),
    ("name it in --fields, too", "nommez-le aussi dans --fields"),
    (
        "no token found is coded for {field}",
        "aucune occurrence trouvée n’est codée pour {field}",
    ),
    (
        "the fields do not say the type of a sign and the handshapes of both hands",
        "les champs ne disent pas le type du signe et les configurations des deux mains",
    ),
    (
        "name them in --fields: columns such as Handedness, Handshape strong and Handshape weak, or configuration.handedness, configuration and weak.configuration",
        "nommez-les dans --fields : des colonnes comme Handedness, Handshape strong et Handshape weak, ou configuration.handedness, configuration et weak.configuration",
    ),
    (
        "{field}: {value} ({n}) and {common} ({m}) differ only in case or accents, and count as two values",
        "{field} : {value} ({n}) et {common} ({m}) ne diffèrent que par la casse ou les accents, et comptent pour deux valeurs",
    ),
    (
        "if they are one value, correct the table and import it again",
        "si c’est une seule valeur, corrigez la table et importez-la de nouveau",
    ),
    (
        "if they are one value: {command}",
        "si c’est une seule valeur : {command}",
    ),
    (
        "most entries have no value in some fields ({list}, of {n} entries): entropy, load and dense places of the lexicon there mirror how completely entries are coded",
        "la plupart des entrées n’ont pas de valeur dans certains champs ({list}, sur {n} entrées) : l’entropie, la charge et les endroits denses du lexique y reflètent le degré de codage des entrées",
    ),
    (
        "compare with --empty unknown, or leave these fields out with --fields",
        "comparez avec --empty unknown, ou laissez ces champs de côté avec --fields",
    ),
    (
        "cells with successive values, such as a > b, count as one value each: {list}",
        "les cellules à valeurs successives, comme a > b, comptent chacune pour une valeur : {list}",
    ),
    (
        "{field}: {value} ({n}) is no known type of sign",
        "{field} : {value} ({n}) n’est pas un type de signe connu",
    ),
    (
        "the types are 1, 2s and 2a, or words such as one-handed, symmetrical, asymmetrical",
        "les types sont 1, 2s et 2a, ou des mots comme one-handed, symmetrical, asymmetrical",
    ),
    (
        "one-handed entries with a handshape of the weak hand: {n}",
        "entrées à une main avec une configuration de la main dominée : {n}",
    ),
    (
        "look at them: either the type or the handshape of the weak hand is wrong",
        "regardez-les : soit le type, soit la configuration de la main dominée est faux",
    ),
    (
        "one-handed entries whose place is the weak hand: {n}",
        "entrées à une main dont l’emplacement est la main dominée : {n}",
    ),
    (
        "look at them: a weak hand that is touched is part of the sign",
        "regardez-les : une main dominée que l’autre touche fait partie du signe",
    ),
    (
        "alternating entries that are not symmetrical: {n}",
        "entrées alternées qui ne sont pas symétriques : {n}",
    ),
    (
        "look at them: hands that alternate both move",
        "regardez-les : des mains qui alternent bougent toutes deux",
    ),
    (
        "the cross table would have {n} cells, and at most {most} are written",
        "le tableau croisé aurait {n} cellules, et on en écrit au plus {most}",
    ),
    (
        "`--json` has the cells that are not 0",
        "`--json` contient les cellules qui ne sont pas 0",
    ),
];
