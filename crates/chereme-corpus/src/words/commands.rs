//! French forms of messages about words of the command line, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const COMMANDS: &[(&str, &str)] = &[
    (
        "the window is a program of its own, chereme-studio, and neither the folder of this program nor the path has it",
        "la fenêtre est un programme à part, chereme-studio, et ni le dossier de ce programme ni le PATH ne l’ont",
    ),
    (
        "in a checkout, build it with `cargo build --release`; elsewhere, install it with `cargo install --path crates/chereme-studio`",
        "dans un dépôt, compilez-le avec `cargo build --release` ; ailleurs, installez-le avec `cargo install --path crates/chereme-studio`",
    ),
    (
        "no window can be opened: {reason}",
        "aucune fenêtre ne peut s’ouvrir : {reason}",
    ),
    (
        "a display (X11 or Wayland) with OpenGL is needed; on Debian: {command}. Every other command of chereme works without a window",
        "il faut un affichage (X11 ou Wayland) avec OpenGL ; sous Debian : {command}. Toutes les autres commandes de chereme se passent de fenêtre",
    ),
    (
        "a display with OpenGL is needed. Every other command of chereme works without a window",
        "il faut un affichage avec OpenGL. Toutes les autres commandes de chereme se passent de fenêtre",
    ),
    (
        "write a time such as 0.2s or -200ms",
        "écrivez un temps comme 0.2s ou -200ms",
    ),
    (
        "there is nothing to cue; write a text, or --from FILE",
        "il n’y a rien à coder ; écrivez un texte, ou --from FICHIER",
    ),
    (
        "there is nothing to read; write a text, or --from FILE",
        "il n’y a rien à lire ; écrivez un texte, ou --from FICHIER",
    ),
    (
        "{path} is there already; name an empty folder or a new one",
        "{path} existe déjà ; nommez un dossier vide ou nouveau",
    ),
    (
        "no folder name is free here",
        "aucun nom de dossier n’est libre ici",
    ),
    (
        "standard output has no extension that says the format",
        "la sortie standard n’a pas d’extension qui dise le format",
    ),
    (
        "name it, as with --format csv",
        "nommez-le, comme avec --format csv",
    ),
    (
        "standard input has no extension that says its kind",
        "l’entrée standard n’a pas d’extension qui dise son genre",
    ),
    (
        "name it, as with --format eaf",
        "nommez-le, comme avec --format eaf",
    ),
    (
        "{format} is no extension of a file, or {name} no name",
        "{format} n’est pas une extension de fichier, ou {name} n’est pas un nom",
    ),
    (
        "write --format eaf, and --name take1",
        "écrivez --format eaf, et --name prise1",
    ),
    (
        "a corpus stores the path of a film, and standard input has none",
        "un corpus retient le chemin d’un film, et l’entrée standard n’en a pas",
    ),
    ("name the file of the film", "nommez le fichier du film"),
    (
        "write hours, minutes, seconds and frames: 12:34:56:07@25",
        "écrivez heures, minutes, secondes et images : 12:34:56:07@25",
    ),
    (
        "write a whole number such as 50, or a fraction such as 30000/1001",
        "écrivez un nombre entier comme 50, ou une fraction comme 30000/1001",
    ),
    (
        "write m, cm, mm, inch, ft, acclaim, or how many metres one unit is",
        "écrivez m, cm, mm, inch, ft, acclaim, ou combien de mètres fait une unité",
    ),
    (
        "write lines such as `right wrist = RHand`, each a part of the body and a joint",
        "écrivez des lignes comme `right wrist = RHand`, chacune une partie du corps et une articulation",
    ),
    (
        "write how many operations, 1 or more",
        "écrivez combien d’opérations, 1 ou plus",
    ),
    (
        "write the number of an operation, such as 12",
        "écrivez le numéro d’une opération, comme 12",
    ),
    (
        "no detector is called {name}",
        "aucun détecteur ne s’appelle {name}",
    ),
    (
        "the detectors are: {names}",
        "les détecteurs sont : {names}",
    ),
    (
        "{name} is no face system",
        "{name} n’est pas un système de visage",
    ),
    ("the systems are: {names}", "les systèmes sont : {names}"),
    (
        "write LANGUAGE=NAME, such as fr=poing",
        "écrivez LANGUE=NOM, comme fr=poing",
    ),
    (
        "write LANGUAGE=TEXT, such as fr=escargot",
        "écrivez LANGUE=TEXTE, comme fr=escargot",
    ),
    (
        "write COLUMN=PATTERN, such as gloss=BO*",
        "écrivez COLONNE=MOTIF, comme gloss=BO*",
    ),
    (
        "standard input has no name by which the corpus could find the earlier version of the file",
        "l’entrée standard n’a pas de nom par lequel le corpus trouve la version d’avant du fichier",
    ),
    (
        "write `chereme import CORPUS - --format eaf --name NAME --merge`",
        "écrivez `chereme import CORPUS - --format eaf --name NOM --merge`",
    ),
    (
        "a corpus cannot be merged into an annotation file",
        "un corpus ne se fusionne pas dans un fichier d’annotations",
    ),
    ("name the corpus first", "nommez d’abord le corpus"),
    (
        "a corpus already has the state from which the file was exported",
        "un corpus a déjà l’état d’où le fichier a été exporté",
    ),
    ("leave --base out", "laissez --base de côté"),
    (
        "the merged file needs a name",
        "le fichier fusionné demande un nom",
    ),
    (
        "write --to merged.eaf, or --to - for standard output",
        "écrivez --to fusion.eaf, ou --to - pour la sortie standard",
    ),
    ("no decision is given", "aucune décision n’est donnée"),
    (
        "add --take mine, theirs or both",
        "ajoutez --take mine, theirs ou both",
    ),
    (
        "`chereme conflicts CORPUS` lists them; `all` means all of them",
        "`chereme conflicts CORPUS` en donne la liste ; `all` les désigne tous",
    ),
    (
        "name them by their numbers, or write all",
        "nommez-les par leurs numéros, ou écrivez all",
    ),
    (
        "no tier names functions; annotate wh, yn, negation or topic on a tier called \"function\"",
        "aucun acteur ne nomme de fonctions ; annotez wh, yn, negation ou topic sur un acteur appelé \"function\"",
    ),
    (
        "no such expression; the functions are: {names}",
        "pas de telle expression ; les fonctions sont : {names}",
    ),
    (
        "the check cannot go on: take a backup, or save what can be read with `chereme export CORPUS all --to FOLDER`",
        "la vérification ne peut pas continuer : prenez une sauvegarde, ou sauvez ce qui se lit avec `chereme export CORPUS all --to DOSSIER`",
    ),
    (
        "{name} is no recording and no token; name one, such as recording:3",
        "{name} n’est ni un enregistrement ni une occurrence ; nommez-en un, comme recording:3",
    ),
    (
        "a speed is a number from {least} to {most}",
        "une vitesse est un nombre de {least} à {most}",
    ),
    (
        "there is no table to write",
        "il n’y a pas de table à écrire",
    ),
    (
        "name its fields with --count or --cross",
        "nommez ses champs avec --count ou --cross",
    ),
    ("write a number, or all", "écrivez un nombre, ou all"),
    (
        "no sign differs from it in one component only",
        "aucun signe n’en diffère par un seul composant",
    ),
    (
        "--role names the {own} hand, and --hand says {other}",
        "--role nomme la main {own}, et --hand dit {other}",
    ),
    ("name the hand once", "nommez la main une fois"),
    (
        "write recording:3 or recording:\"NAME\"",
        "écrivez recording:3 ou recording:\"NOM\"",
    ),
    (
        "write a time in seconds such as 0.48s, or 480ms",
        "écrivez un temps en secondes comme 0.48s, ou 480ms",
    ),
    ("there is no track {name}", "il n’y a pas de piste {name}"),
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
];
