//! The French of `chereme agree`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Measure how far two annotators agree, on which values they differ, and where",
            "Mesurer l’accord de deux annotateurs, sur quelles valeurs ils diffèrent, et où",
        ),
        (
            "Two tiers are compared in every recording that has both. A tier is named by its name; by a pattern, \"*-A\" and \"*-B\", whose star stands for the same text in both; by annotator:NAME, for the tiers of both people that describe the same; or by tier:12, also of two recordings. Annotations without a value are left out; if nobody gave a value, the spans alone are compared.",
            "Deux acteurs sont comparés dans chaque enregistrement qui a les deux. Un acteur se nomme par son nom ; par un motif, « *-A » et « *-B », où l’étoile est le même texte des deux côtés ; par annotator:NOM, et les acteurs qui décrivent la même chose sont comparés ; ou par tier:12, même de deux enregistrements. Les annotations sans valeur sont laissées de côté ; si personne n’a donné de valeur, seules les durées sont comparées.",
        ),
        (
            "Measures: kappa_ipf, raw, matched, kappa, kappa_max (ELAN's modified kappa of Holle and Rein: units match if 60 % of the longer one overlap); alpha_u, u_alpha, u_alpha_spans, cu_alpha (Krippendorff, over time); gamma, gamma_cat (Mathet, by alignment; chance is drawn as in pygamma-agreement); label_raw, label_kappa, label_pi, label_ac1, label_alpha, label_alpha_features (values of matched units alone; the last weighs the features of handshapes); overlap_a, overlap_b (ELAN's ratio of overlap, from either tier); frames_raw, frames_kappa, frames_alpha (10 ms each); boundaries (boundary similarity of tiers without gaps). A measure that is undefined has a reason instead of a number. With fewer than 10 units, or one value, only counts are printed.",
            "Mesures : kappa_ipf, raw, matched, kappa, kappa_max (le kappa modifié de Holle et Rein, comme dans ELAN : deux unités se correspondent si 60 % de la plus longue sont communs) ; alpha_u, u_alpha, u_alpha_spans, cu_alpha (Krippendorff, sur le temps) ; gamma, gamma_cat (Mathet, par alignement ; le hasard est tiré comme dans pygamma-agreement) ; label_raw, label_kappa, label_pi, label_ac1, label_alpha, label_alpha_features (valeurs des seules unités qui se correspondent ; la dernière pèse les traits des configurations) ; overlap_a, overlap_b (le taux de recouvrement d’ELAN, depuis chaque acteur) ; frames_raw, frames_kappa, frames_alpha (10 ms chacune) ; boundaries (similarité des frontières d’acteurs sans vides). Une mesure indéfinie a une raison au lieu d’un nombre. Avec moins de 10 unités, ou une seule valeur, seuls des nombres d’unités sont affichés.",
        ),
        (
            "Intervals hold 95 of 100 draws of units, or of recordings if there are 10 or more. That of gamma only shows how exact its chance is: more --samples make it narrower.",
            "Les intervalles contiennent 95 tirages sur 100, d’unités, ou d’enregistrements s’il y en a 10 ou plus. Celui de gamma ne montre que la précision de son hasard : plus de --samples le resserrent.",
        ),
        (
            "`--json` gives \"a\", \"b\", \"values\", \"units_a\", \"units_b\", \"matched\", \"equal\", \"unmatched_a\", \"unmatched_b\", \"left_out_a\", \"left_out_b\", \"counts_only\", \"measures\" (each with \"value\" or null, \"why\", and \"interval\"), \"onset_s\" and \"offset_s\" (b less a: \"q1\", \"median\", \"q3\"), \"by_value\", \"disagreements\" (their numbers), \"pairs\" (each pair of tiers) and \"findings\"; with --list \"list\", with --confusion \"confusion\", with --into \"adjudicated\".",
            "`--json` donne \"a\", \"b\", \"values\", \"units_a\", \"units_b\", \"matched\", \"equal\", \"unmatched_a\", \"unmatched_b\", \"left_out_a\", \"left_out_b\", \"counts_only\", \"measures\" (chacune avec \"value\" ou null, \"why\" et \"interval\"), \"onset_s\" et \"offset_s\" (b moins a : \"q1\", \"median\", \"q3\"), \"by_value\", \"disagreements\" (leurs nombres), \"pairs\" (chaque paire d’acteurs) et \"findings\" ; avec --list \"list\", avec --confusion \"confusion\", avec --into \"adjudicated\".",
        ),
        (
            "The tier of the first annotator",
            "L’acteur du premier annotateur",
        ),
        (
            "The tier of the second annotator",
            "L’acteur du second annotateur",
        ),
        ("Only this recording", "Seulement cet enregistrement"),
        (
            "Only these measures, separated by commas; `all` prints all, and without it the usual five are printed",
            "Seulement ces mesures, séparées par des virgules ; `all` les affiche toutes, et sans cette option les cinq usuelles sont affichées",
        ),
        (
            "Starts or ends further apart than this are a disagreement",
            "Des débuts ou des fins plus éloignés que cela sont un désaccord",
        ),
        (
            "The share of the longer unit, in percent, that must overlap for a match: 51 to 100",
            "La part de l’unité la plus longue, en pour cent, qui doit être commune pour une correspondance : 51 à 100",
        ),
        (
            "The number of draws for intervals; 0 computes none",
            "Le nombre de tirages pour les intervalles ; 0 n’en calcule aucun",
        ),
        (
            "The number of random continua for gamma, at least 30; 0 leaves gamma out",
            "Le nombre de continus aléatoires pour gamma, au moins 30 ; 0 omet gamma",
        ),
        (
            "The seed of all draws; the same seed gives the same numbers",
            "La graine de tous les tirages ; la même graine donne les mêmes nombres",
        ),
        (
            "Count the whole recording as annotated, instead of the time from the first annotation to the last",
            "Compter tout l’enregistrement comme annoté, au lieu du temps de la première annotation à la dernière",
        ),
        (
            "List the disagreements, the costliest first",
            "Énumérer les désaccords, les plus coûteux d’abord",
        ),
        (
            "List the values that were confused, and the features in which they differ",
            "Énumérer les valeurs confondues, et les traits par lesquels elles diffèrent",
        ),
        (
            "Write the disagreements to a table (.csv)",
            "Écrire les désaccords dans une table (.csv)",
        ),
        (
            "Replace a table that exists already",
            "Remplacer une table qui existe déjà",
        ),
        (
            "Write what both agree on to a new tier of this name, with a conflict for each disagreement, which `conflicts` decides",
            "Écrire ce sur quoi les deux s’accordent sur un nouvel acteur de ce nom, avec un conflit par désaccord, que `conflicts` tranche",
        ),
        (
            "(then decide: chereme conflicts mine.chereme)",
            "(puis trancher : chereme conflicts mine.chereme)",
        ),
    ],
    lines: &[
        (
            "a tolerance is a time of 0 or more",
            "une tolérance est un temps, 0 ou plus",
        ),
        (
            "table of disagreements: {path}",
            "table des désaccords : {path}",
        ),
        ("write 80ms, or 0.08s", "écrivez 80ms, ou 0.08s"),
        (
            "on the tier {name}: {annotations} on which both agree; {conflicts} to decide",
            "sur l’acteur {name} : accord des deux pour {annotations} ; à trancher : {conflicts}",
        ),
        (
            "{a} has {n} units and {b} has {m}, in {pairs}",
            "unités de {a} : {n} ; de {b} : {m} ; dans {pairs}",
        ),
        (
            "matched: {n}, {equal} of them with equal values; only a: {a}, only b: {b}",
            "en correspondance : {n}, dont de même valeur : {equal} ; seulement a : {a}, seulement b : {b}",
        ),
        (
            "disagreements in the alignment: only a {a}, only b {b}, other value {value}, start or end {boundary}",
            "désaccords dans l’alignement : seulement a {a}, seulement b {b}, autre valeur {value}, début ou fin {boundary}",
        ),
        (
            "start of b less a: {onset}; end: {offset} (median and quartiles, in ms)",
            "début de b moins a : {onset} ; fin : {offset} (médiane et quartiles, en ms)",
        ),
        (
            "too few units or values for figures; with --json they are computed all the same",
            "trop peu d’unités ou de valeurs pour des mesures ; --json les calcule quand même",
        ),
        (
            "values that are not shown: {n}; --json has all",
            "valeurs qui ne sont pas affichées : {n} ; --json les a toutes",
        ),
    ],
    titles: &[
        ("measure", "mesure"),
        ("draws", "tirages"),
        ("both", "les deux"),
        ("other value", "autre valeur"),
        ("alone", "seul"),
        ("tier a", "acteur a"),
        ("tier b", "acteur b"),
        ("matched", "correspond"),
        ("equal", "égal"),
        ("times", "fois"),
        ("features of a alone", "traits de a seul"),
        ("features of b alone", "traits de b seul"),
        ("from (s)", "de (s)"),
        ("to (s)", "à (s)"),
        ("start (ms)", "début (ms)"),
        ("end (ms)", "fin (ms)"),
        ("cost", "coût"),
    ],
};
