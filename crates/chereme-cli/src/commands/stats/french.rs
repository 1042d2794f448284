//! The French of `chereme stats`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Describe a lexicon by numbers: entropy, functional load, association of fields, conditions on the hands",
            "Décrire un lexique par des nombres : entropie, charge fonctionnelle, association de champs, conditions sur les mains",
        ),
        (
            "Every sign counts once, by its citation form; with a query every token that it finds. Fields are columns of an imported table, whose cells are taken as written, or fields of queries such as dominant.configuration, as in `chereme pairs`.",
            "Chaque signe compte une fois, par sa forme de citation ; avec une requête, chaque occurrence qu’elle trouve. Les champs sont des colonnes d’une table importée, dont les cellules sont prises telles qu’écrites, ou des champs de requête comme dominant.configuration, comme dans `chereme pairs`.",
        ),
        (
            "Entropy is in bits, from the shares as they are. The functional load of a field is the share of the entropy of forms that is lost without it, (H(L) - H(L without it)) / H(L); that of a contrast is the share that is lost if its two values are one. Intervals of 95 % are the jackknife's over entries, and Wilson's for shares. Draws with replacement would take the same entry twice, as a homonym that the lexicon does not have.",
            "L’entropie est en bits, à partir des parts telles quelles. La charge fonctionnelle d’un champ est la part de l’entropie des formes qui se perd sans lui, (H(L) - H(L sans lui)) / H(L) ; celle d’un contraste est la part qui se perd si ses deux valeurs n’en font qu’une. Les intervalles à 95 % sont ceux du jackknife sur les entrées, et de Wilson pour les parts. Des tirages avec remise prendraient deux fois la même entrée, un homonyme que le lexique n’a pas.",
        ),
        (
            "Association counts the entries that have both fields: mutual information, chi-square and Cramér's V. p is the share of shuffled lexica in which they go together at least as much. Fields with many rare values share information by chance alone: compare with the mean of the shuffled ones.",
            "L’association compte les entrées qui ont les deux champs : information mutuelle, chi carré et V de Cramér. p est la part des lexiques mélangés où ils vont ensemble au moins autant. Des champs à beaucoup de valeurs rares partagent de l’information par le seul hasard : comparez avec la moyenne des lexiques mélangés.",
        ),
        (
            "Battison's conditions: symmetrical signs have the same handshape on both hands; asymmetrical ones have the same one, or an unmarked one on the weak hand. They need the type of a sign (Signbank's 1, 2s, 2a, or words such as ASL-LEX's) and both handshapes.",
            "Conditions de Battison : les signes symétriques ont la même configuration aux deux mains ; les asymétriques ont la même, ou une configuration non marquée à la main dominée. Il faut le type du signe (1, 2s, 2a de Signbank, ou des mots comme ceux d’ASL-LEX) et les deux configurations.",
        ),
        (
            "`--json` gives \"source\" (columns, citations or tokens), \"entries\", \"compared\", \"forms\", \"entropy\", \"fields\" (each with \"field\", \"values\", \"given\", \"empty\", \"successive\", \"entropy\", \"entropy_given\", \"load\" and \"frequent\") and \"findings\"; with --of \"of\" (\"values\", \"contrasts\"), with --between \"between\" (\"n\", \"bits\", \"chi_square\", \"df\", \"cramers_v\", \"p\", \"p_bits\", \"chance\", \"rows\", \"columns\", \"cells\"), with --battison \"battison\" (\"symmetry\" and \"dominance\", each with \"exceptions\"). A number is \"value\" or null, \"why\", and \"interval\".",
            "`--json` donne \"source\" (columns, citations ou tokens), \"entries\", \"compared\", \"forms\", \"entropy\", \"fields\" (chacun avec \"field\", \"values\", \"given\", \"empty\", \"successive\", \"entropy\", \"entropy_given\", \"load\" et \"frequent\") et \"findings\" ; avec --of \"of\" (\"values\", \"contrasts\"), avec --between \"between\" (\"n\", \"bits\", \"chi_square\", \"df\", \"cramers_v\", \"p\", \"p_bits\", \"chance\", \"rows\", \"columns\", \"cells\"), avec --battison \"battison\" (\"symmetry\" et \"dominance\", chacune avec \"exceptions\"). Un nombre est \"value\" ou null, \"why\" et \"interval\".",
        ),
        (
            "(tokens instead of signs)",
            "(des occurrences au lieu de signes)",
        ),
        (
            "The tokens to count, as in `chereme search`",
            "Les occurrences à compter, comme dans `chereme search`",
        ),
        (
            "All values of this field, and its contrasts",
            "Toutes les valeurs de ce champ, et ses contrastes",
        ),
        (
            "The association of these two fields, and their cross table",
            "L’association de ces deux champs, et leur tableau croisé",
        ),
        (
            "Battison's conditions on signs with two hands, and the signs that do not keep them",
            "Les conditions de Battison sur les signes à deux mains, et les signes qui ne les respectent pas",
        ),
        (
            "The handshapes that count as unmarked; without it B, A, S, C, O, 1, 5",
            "Les configurations qui comptent comme non marquées ; sinon B, A, S, C, O, 1, 5",
        ),
        (
            "The most values, contrasts and glosses that are printed",
            "Le nombre maximal de valeurs, de contrastes et de gloses affichés",
        ),
        (
            "The number of shuffles for p; 0 computes none",
            "Le nombre de mélanges pour p ; 0 n’en calcule pas",
        ),
        (
            "Write a table (.csv): the cross table, the values of a field, the exceptions, or else the fields",
            "Écrire une table (.csv) : le tableau croisé, les valeurs d’un champ, les exceptions, ou sinon les champs",
        ),
    ],
    lines: &[
        (
            "entries: {n}, compared: {m}, different forms: {k}",
            "entrées : {n}, comparées : {m}, formes différentes : {k}",
        ),
        (
            "entropy of forms in bits: {number}",
            "entropie des formes en bits : {number}",
        ),
        (
            "{field}: {n} values in {given} entries, {empty} entries without one",
            "{field} : {n} valeurs dans {given} entrées, {empty} entrées sans valeur",
        ),
        (
            "entropy in bits: {all}; without empty cells: {given}",
            "entropie en bits : {all} ; sans les cellules vides : {given}",
        ),
        (
            "functional load: {number}",
            "charge fonctionnelle : {number}",
        ),
        ("contrasts: - ({why})", "contrastes : - ({why})"),
        (
            "contrasts that distinguish signs, the largest load first; ∅ is the empty cell",
            "contrastes qui distinguent des signes, la plus grande charge d’abord ; ∅ est la cellule vide",
        ),
        (
            "contrasts that are not shown: {n}; --json has all",
            "contrastes non affichés : {n} ; --json les donne tous",
        ),
        (
            "rows that are not shown: {n}; --json has all",
            "lignes non affichées : {n} ; --json les donne toutes",
        ),
        (
            "columns that are not shown: {n}; --json has all",
            "colonnes non affichées : {n} ; --json les donne toutes",
        ),
        (
            "exceptions that are not shown: {n}; --json has all",
            "exceptions non affichées : {n} ; --json les donne toutes",
        ),
        (
            "{one} × {other}: {n} entries with both, {m} left out",
            "{one} × {other} : {n} entrées avec les deux, {m} laissées de côté",
        ),
        (
            "mutual information in bits: {bits} (shuffled: {mean}), p {p}",
            "information mutuelle en bits : {bits} (mélangé : {mean}), p {p}",
        ),
        (
            "chi-square: {value} (shuffled: {mean}), df {df}, p {p}",
            "chi carré : {value} (mélangé : {mean}), degrés de liberté {df}, p {p}",
        ),
        ("Cramér's V: {value}", "V de Cramér : {value}"),
        (
            "one-handed: {n}, symmetrical: {s}, asymmetrical: {a}, of no known type: {o}",
            "à une main : {n}, symétriques : {s}, asymétriques : {a}, d’aucun type connu : {o}",
        ),
        (
            "unmarked handshapes: {list}",
            "configurations non marquées : {list}",
        ),
        (
            "symmetry: both handshapes given {n}, the same {same}, different {other}; kept by {share}",
            "symétrie : les deux configurations données {n}, les mêmes {same}, différentes {other} ; respectée par {share}",
        ),
        (
            "dominance: both handshapes given {n}, the same {same}, different {other}, of these with an unmarked weak hand {k}; kept by {share}; weak hand unmarked in {all}",
            "dominance : les deux configurations données {n}, les mêmes {same}, différentes {other}, dont main dominée non marquée {k} ; respectée par {share} ; main dominée non marquée dans {all}",
        ),
        (
            "entries that do not keep symmetry: {n}",
            "entrées qui ne respectent pas la symétrie : {n}",
        ),
        (
            "entries that do not keep dominance: {n}",
            "entrées qui ne respectent pas la dominance : {n}",
        ),
        (
            "without one of the handshapes: {list}",
            "sans l’une des configurations : {list}",
        ),
        ("entries: {list}", "entrées : {list}"),
        ("table: {path}", "table : {path}"),
    ],
    titles: &[
        ("field", "champ"),
        ("values", "valeurs"),
        ("empty", "vide"),
        ("entropy", "entropie"),
        ("without empty", "sans vide"),
        ("load", "charge"),
        ("± load", "± charge"),
        ("most frequent", "les plus fréquentes"),
        ("minimal pairs", "paires minimales"),
        ("strong hand", "main dominante"),
        ("weak hand", "main dominée"),
    ],
};
