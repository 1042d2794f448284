//! Texts of the measures of signs.

texts! {
    TITLE: "Measures", "Mesures";
    TASK: "Measuring signs", "Mesure des signes";
    NEIGHBOURS: "Neighbours", "Voisins";
    ASL_LEX: "as in ASL-LEX: homonyms are neighbours", "comme ASL-LEX : les homonymes sont voisins";
    SIGNBANK: "as in Signbank: homonyms are none", "comme Signbank : les homonymes n’en sont pas";
    CORPUS_TOOLS: "as in Corpus Tools: each form once", "comme Corpus Tools : chaque forme une fois";
    WITHIN: "differ in at most", "diffèrent par au plus";
    WITHIN_FIELDS: "fields: {n}", "champs : {n}";
    EMPTY_CELLS: "An empty field", "Un champ vide";
    EMPTY_VALUE: "is a value", "est une valeur";
    EMPTY_UNKNOWN: "leaves the sign out", "écarte le signe";
    LEXICON: "Lexicon", "Lexique";
    ONLY_LEXICON: "the only one", "le seul";
    ACROSS: "all together", "tous ensemble";
    FIELDS: "Fields: {fields}", "Champs : {fields}";
    ALL_CODED: "all that are coded", "tous ceux qui sont codés";
    COLUMN_SETS: "Sets of Signbank’s columns", "Jeux de colonnes de Signbank";
    OTHER_FIELD: "Another field, or a column of a table", "Un autre champ, ou une colonne d’un tableau";
    OTHER_HINT: "another field, then Enter", "un autre champ, puis Entrée";
    AMONG: "Among the signs that a query finds", "Parmi les signes trouvés par une requête";
    AMONG_HINT: "query, then Enter", "requête, puis Entrée";
    STORE: "Store as attributes", "Enregistrer comme attributs";
    STORE_TIP: "The measures stay with the signs: queries such as density>20, the order of hits and tables know them.", "Les mesures restent avec les signes : des requêtes comme density>20, l’ordre des résultats et les tableaux les connaissent.";
    SUMMARY: "Signs measured: {n} of {all} · neighbours: mean {mean}, median {median} · without one: {alone}", "Signes mesurés : {n} sur {all} · voisins : moyenne {mean}, médiane {median} · sans aucun : {alone}";
    NONE: "No sign has a value in these fields.", "Aucun signe n’a de valeur dans ces champs.";
    STOPPED: "Stopped before there were measures.", "Arrêté avant d’avoir des mesures.";
    AGAIN: "Measure again", "Mesurer de nouveau";
    DENSITY: "neighbours", "voisins";
    PAIRS: "minimal pairs", "paires min.";
    HOMONYMS: "homonyms", "homonymes";
    FAMILY: "family", "famille";
    FAMILY_SIZE: "size of the family", "taille de la famille";
    PROBABILITY: "probability", "probabilité";
    PAIR_PROBABILITY: "of pairs", "des paires";
    PAIR_PROBABILITY_NAME: "probability of pairs", "probabilité des paires";
    TOKENS: "tokens", "emplois";
    SIGNERS: "signers", "signeurs";
    ROW: "{gloss}, neighbours {n}", "{gloss}, voisins {n}";
    PAIRS_TIP: "Minimal pairs by field: {pairs}", "Paires minimales par champ : {pairs}";
    HOMONYMS_TIP: "Homonyms: {glosses}", "Homonymes : {glosses}";
    FAMILY_TIP: "Family of {gloss}: equal but for the handshape", "Famille de {gloss} : égaux sauf la configuration";
}
