//! The French of the options, lines and titles that several commands have, and of the program itself.

use super::Words;

/// The shared words.
pub(super) const SHARED: Words = Words {
    help: &[
        (
            "A corpus database for signed movement: import, search, recombine, look at and export signs",
            "Une base de corpus pour le mouvement signé : importer, chercher, recombiner, regarder et exporter des signes",
        ),
        (
            "One file, NAME.chereme, holds recordings, the annotations of their tiers, and the new signs made from them. Start with `chereme demo`, or import a folder of your own.",
            "Un seul fichier, NOM.chereme, contient les enregistrements, les annotations de leurs acteurs et les nouveaux signes qu’on en compose. Commencez par `chereme demo`, ou importez un dossier à vous.",
        ),
        (
            "Print one JSON document on standard output instead of tables",
            "Écrire un document JSON sur la sortie standard au lieu de tableaux",
        ),
        (
            "Your name in the history; without it the environment variable CHEREME_AUTHOR, or the name of the machine's user",
            "Votre nom dans l’historique ; sinon la variable d’environnement CHEREME_AUTHOR, ou le nom de l’utilisateur de la machine",
        ),
        (
            "The width of tables in letters, 0 for their full width; without it the width of the terminal, or the full width if the output goes to a file or another program",
            "La largeur des tableaux en lettres, 0 pour toute leur largeur ; sinon celle du terminal, ou toute leur largeur si la sortie va dans un fichier ou un autre programme",
        ),
        (
            "The language of help, tables and messages: en or fr; without it the language of the system. JSON is always in English",
            "La langue de l’aide, des tableaux et des messages : en ou fr ; sinon celle du système. Le JSON est toujours en anglais",
        ),
        ("The corpus", "Le corpus"),
        (
            "The gloss of the new sign; without it nothing is stored",
            "La glose du nouveau signe ; sans elle rien n’est enregistré",
        ),
        (
            "Replace a file that exists already",
            "Remplacer un fichier qui existe déjà",
        ),
        (
            "In a table write an apostrophe before cells that a spreadsheet would take for formulas",
            "Dans un tableau, écrire une apostrophe devant les cellules qu’un tableur prendrait pour des formules",
        ),
        ("The signer who moves", "Le signeur qui bouge"),
        (
            "Replace a picture that exists already",
            "Remplacer une image qui existe déjà",
        ),
        ("Remarks", "Remarques"),
        (
            "The rule for the timing of hand and fingers",
            "La règle des temps de la main et des doigts",
        ),
        (
            "The duration of sounds as a multiple of the usual one, from 0.1 to 10; without it 1.6",
            "La durée des sons en multiple de la durée habituelle, de 0.1 à 10 ; sinon 1.6",
        ),
        (
            "Read the input as phones in this alphabet",
            "Lire l’entrée comme des phones dans cet alphabet",
        ),
        (
            "The function of the expressions: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier; without it all",
            "La fonction des expressions : negation, wh, yn, topic, conditional, rhetorical, ou un autre mot de l’acteur ; sinon toutes",
        ),
        (
            "Draw medians and quartiles to a picture (.svg)",
            "Dessiner médianes et quartiles dans une image (.svg)",
        ),
        (
            "The code: french, english-us or english-gb",
            "Le code : french, english-us ou english-gb",
        ),
        ("Examples:", "Exemples :"),
    ],
    lines: &[
        (
            "no room for: {names}; --width 0 shows all columns",
            "pas de place pour : {names} ; --width 0 montre toutes les colonnes",
        ),
        ("would change: {n}", "changerait : {n}"),
        ("changed: {n}", "modifié : {n}"),
        ("not used: {names}", "pas utilisés : {names}"),
        ("nothing was stored", "rien n’a été enregistré"),
        ("left out: {what}", "laissé de côté : {what}"),
        ("drew {path}", "{path} dessiné"),
        ("made {path}", "créé : {path}"),
        ("tokens: {list}", "occurrences : {list}"),
        (
            "write it in UTF-8, or name a file",
            "écrivez-le en UTF-8, ou nommez un fichier",
        ),
        (
            "standard input is no text",
            "l’entrée standard n’est pas du texte",
        ),
        (
            "--json and --to - both want standard output",
            "--json et --to - veulent tous deux la sortie standard",
        ),
        (
            "leave --json out, or name a file",
            "laissez --json de côté, ou nommez un fichier",
        ),
        (
            "choose another name, or write over it with --force",
            "choisissez un autre nom, ou remplacez-le avec --force",
        ),
    ],
    titles: &[
        ("channel", "canal"),
        ("channels", "canaux"),
        ("component", "composant"),
        ("components", "composants"),
        ("count", "nombre"),
        ("differs in", "diffère par"),
        ("frames", "images"),
        ("function", "fonction"),
        ("gloss", "glose"),
        ("hand", "main"),
        ("keys", "clés"),
        ("kind", "genre"),
        ("name", "nom"),
        ("offset_s", "décalage_s"),
        ("origin", "origine"),
        ("partner", "partenaire"),
        ("phase", "phase"),
        ("recipe", "recette"),
        ("recording", "enregistrement"),
        ("seconds", "secondes"),
        ("sign", "signe"),
        ("signs", "signes"),
        ("start", "début"),
        ("tier", "acteur"),
        ("tiers", "acteurs"),
        ("token", "occurrence"),
        ("value", "valeur"),
    ],
};
