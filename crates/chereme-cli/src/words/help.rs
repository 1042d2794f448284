//! Texts of the help as English and French.

/// Returns a text of the help in French; nothing where it has none yet.
pub(super) fn of(english: &str) -> Option<&'static str> {
    let found = HELP.iter().find(|(known, _)| *known == english);
    found.map(|(_, french)| *french)
}

const HELP: &[(&str, &str)] = &[
    (
        "Count the minimal pairs of a lexicon",
        "Compter les paires minimales d’un lexique",
    ),
    (
        "The fields, with commas between them, or a set of Signbank's columns: S13, F8, F7, F5, C3",
        "Les champs, séparés par des virgules, ou un ensemble de colonnes de Signbank : S13, F8, F7, F5, C3",
    ),
    ("How an empty field counts", "Comment un champ vide compte"),
    ("List the pairs", "Énumérer les paires"),
    (
        "How many values of each field to count: a number, or all",
        "Combien de valeurs de chaque champ compter : un nombre, ou all",
    ),
    (
        "Count the values of a field among all tokens found, such as placement or signer",
        "Compter les valeurs d’un champ parmi toutes les occurrences trouvées, par exemple placement ou signer",
    ),
    (
        "Count them for each value of another field, too, such as signer",
        "Les compter aussi pour chaque valeur d’un autre champ, par exemple signer",
    ),
    (
        "Count how often the values of two fields meet, such as dominant.configuration placement",
        "Compter combien de fois les valeurs de deux champs se rencontrent, par exemple dominant.configuration placement",
    ),
    (
        "Write the table of --count or --cross with commas or tabs between its cells",
        "Écrire le tableau de --count ou de --cross avec des virgules ou des tabulations entre les cellules",
    ),
    (
        "Only values of this inventory, whose name may hold blanks",
        "Seulement les valeurs de cet inventaire, dont le nom peut contenir des espaces",
    ),
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
        "Your name in the history; else CHEREME_AUTHOR of the environment, or the user of the machine",
        "Votre nom dans l’historique ; sinon CHEREME_AUTHOR de l’environnement, ou l’utilisateur de la machine",
    ),
    (
        "How many letters wide tables are, 0 for as wide as they need; else as wide as the terminal, or unshortened if the output goes to a file or another program",
        "La largeur des tableaux en lettres, 0 pour toute leur largeur ; sinon celle du terminal, ou sans rien raccourcir si la sortie va dans un fichier ou un autre programme",
    ),
    (
        "The language of help, tables and messages, en or fr, also after the command; else that of the locale. JSON is always in English",
        "La langue de l’aide, des tableaux et des messages, en ou fr, aussi après la commande ; sinon celle du système. Le JSON est toujours en anglais",
    ),
    (
        "Synthesise movement from notation: HamNoSys or SiGML, on any body",
        "Synthétiser un mouvement à partir d’une notation, HamNoSys ou SiGML, sur n’importe quel corps",
    ),
    ("The corpus", "Le corpus"),
    (
        "The notation: a file, HamNoSys text, or a notated sign; - is SiGML or HamNoSys from standard input",
        "La notation : un fichier, du HamNoSys, ou un signe noté ; - est du SiGML ou du HamNoSys de l’entrée standard",
    ),
    (
        "Whose body signs: a signer, or a recording for its skeleton (signer:NAME, recording:NAME); else the corpus chooses",
        "Le corps qui signe : un signeur, ou un enregistrement pour son squelette (signer:NOM, recording:NOM) ; sinon le corpus choisit",
    ),
    (
        "The gloss of the new sign; without it nothing is stored",
        "La glose du nouveau signe ; sans elle rien n’est enregistré",
    ),
    (
        "Show how the movement comes about: strokes, residuals, what was approximated",
        "Expliquer le mouvement : traits, écarts, approximations",
    ),
    (
        "Draw the movement to a contact sheet (.png) or an animation (.gif)",
        "Dessiner le mouvement en planche (.png) ou en animation (.gif)",
    ),
    (
        "Add, change, move, split, merge, replace and remove annotations and tiers; in bulk from a table",
        "Ajouter, modifier, déplacer, couper, fusionner, remplacer et supprimer annotations et acteurs ; en masse à partir d’une table",
    ),
    (
        "The recording meant by names of tiers and ids of annotations: recording:3 or its name",
        "L’enregistrement dont on nomme les acteurs et les annotations : recording:3 ou son nom",
    ),
    (
        "Move boundaries to the nearest frames of the recording's movement",
        "Amener les limites aux images les plus proches du mouvement",
    ),
    (
        "How annotations give way to one that is added or moved",
        "Comment les annotations font place à celle qu’on ajoute ou déplace",
    ),
    (
        "Report the ids of all annotations; else of at most 100 in JSON, and of at most 20 in words",
        "Donner les numéros de toutes les annotations ; sinon de 100 au plus en JSON, et de 20 au plus en texte",
    ),
    (
        "They stay, and the change is refused",
        "Elles restent, et la modification est refusée",
    ),
    (
        "They are pushed on as far as they are in the way",
        "Elles sont poussées autant qu’il le faut",
    ),
    (
        "All that comes after moves along",
        "Tout ce qui suit se déplace aussi",
    ),
    ("Add an annotation", "Ajouter une annotation"),
    ("The tier", "L’acteur"),
    (
        "What it says; unset, n/a and unclear are the three kinds of missing values",
        "Ce qu’elle dit ; unset, n/a et unclear sont les trois sortes de valeurs manquantes",
    ),
    ("Where it starts", "Son début"),
    ("Where it ends", "Sa fin"),
    (
        "The annotation above it, on a tier whose annotations have no times of their own",
        "L’annotation parente, sur un acteur dont les annotations n’ont pas de temps propre",
    ),
    (
        "Its place among its siblings, from 0",
        "Sa place parmi ses sœurs, à partir de 0",
    ),
    (
        "Change what an annotation says, or move it",
        "Changer ce que dit une annotation, ou la déplacer",
    ),
    ("The annotation", "L’annotation"),
    ("Its new value", "Sa nouvelle valeur"),
    ("Where it starts from now on", "Son nouveau début"),
    ("Where it ends from now on", "Sa nouvelle fin"),
    ("Cut an annotation in two", "Couper une annotation en deux"),
    (
        "The annotation, which becomes the first half",
        "L’annotation, qui devient la première moitié",
    ),
    ("Where to cut", "Où couper"),
    (
        "Make one annotation of two neighbours",
        "Fusionner deux annotations voisines",
    ),
    ("The earlier one, which stays", "La première, qui reste"),
    ("The later one, which goes", "La seconde, qui disparaît"),
    (
        "What the one says; needed where the two differ",
        "Ce que dit la fusion ; nécessaire si les deux diffèrent",
    ),
    (
        "Give an annotation of a list another place among its siblings",
        "Donner à une annotation d’une liste une autre place parmi ses sœurs",
    ),
    ("The place, from 0", "La place, à partir de 0"),
    (
        "Remove annotations with all below them",
        "Supprimer des annotations avec toutes celles qui en dépendent",
    ),
    ("The annotations", "Les annotations"),
    (
        "Replace text in the values of annotations, of all tiers or of some",
        "Remplacer un texte dans les valeurs des annotations, sur tous les acteurs ou sur certains",
    ),
    (
        "The text to look for, letter by letter, anywhere in a value",
        "Le texte cherché, lettre pour lettre, n’importe où dans une valeur",
    ),
    ("The text to put there", "Le texte de remplacement"),
    (
        "Take the text as a regular expression; $1 in the new text is its first group",
        "Lire le texte comme une expression régulière ; $1 dans le nouveau texte en est le premier groupe",
    ),
    (
        "Only values that are the text and nothing else",
        "Seulement les valeurs qui sont ce texte et rien d’autre",
    ),
    (
        "Only tiers of this name, * for any letters; or tier:12",
        "Seulement les acteurs de ce nom, * pour des lettres quelconques ; ou tier:12",
    ),
    (
        "Report what would change, and write nothing",
        "Dire ce qui changerait, sans rien écrire",
    ),
    (
        "Move all annotations of tiers, of the recording named by --in, in time",
        "Décaler dans le temps toutes les annotations d’acteurs de l’enregistrement nommé par --in",
    ),
    (
        "By how much: 0.2s, -200ms; minus is earlier",
        "De combien : 0.2s, -200ms ; moins va vers le début",
    ),
    (
        "Report how many would move, and write nothing",
        "Dire combien se déplaceraient, sans rien écrire",
    ),
    (
        "Make the changes of a table, all of them or none",
        "Faire les modifications d’une table, toutes ou aucune",
    ),
    (
        "The table (.csv or .tsv); - is standard input",
        "La table (.csv ou .tsv) ; - est l’entrée standard",
    ),
    (
        "Look for damage: database, blocks and hashes, tier rules, tokens, history, search index",
        "Chercher les dégâts : base, blocs et sommes, règles des acteurs, occurrences, historique, index de recherche",
    ),
    (
        "Rebuild what is derived (tokens, search index) if it is wrong",
        "Reconstruire ce qui est dérivé (occurrences, index de recherche) si c’est faux",
    ),
    (
        "Write the completions of a shell to standard output",
        "Écrire les complétions d’un shell sur la sortie standard",
    ),
    ("The shell", "Le shell"),
    (
        "Write the manual pages, in the form of the program `man`",
        "Écrire les pages du manuel, pour le programme `man`",
    ),
    (
        "The folder for a page of each command; without it the page of the whole goes to standard output",
        "Le dossier pour une page par commande ; sans lui la page de l’ensemble va sur la sortie standard",
    ),
    (
        "Do the main job on the starter corpus: build, search, recombine, store, draw, export",
        "Faire l’essentiel sur le corpus de départ : construire, chercher, recombiner, enregistrer, dessiner, exporter",
    ),
    (
        "The folder for the results of the demo; else a new one in the current folder",
        "Le dossier des résultats de la démonstration ; sinon un nouveau dans le dossier courant",
    ),
    (
        "Write out movement, annotations, tables, or the whole enriched database",
        "Exporter du mouvement, des annotations, des tables, ou toute la base enrichie",
    ),
    (
        "What: all, a gloss, token:41, recording:3, tier:12, or query:'right.configuration=U'; several are written together",
        "Quoi : all (tout), une glose, token:41, recording:3, tier:12, ou query:'right.configuration=U' ; plusieurs vont ensemble",
    ),
    (
        "The file or folder to write; - is standard output",
        "Le fichier ou dossier à écrire ; - est la sortie standard",
    ),
    (
        "The format, such as bvh or csv: needed with --to -, and to write a file for each into a folder",
        "Le format, comme bvh ou csv : nécessaire avec --to -, et pour écrire un fichier pour chacun dans un dossier",
    ),
    (
        "Write over a file that is there already",
        "Remplacer un fichier qui existe déjà",
    ),
    ("Undo the last change", "Annuler la dernière modification"),
    (
        "How many operations to undo",
        "Combien d’opérations annuler",
    ),
    (
        "Redo what was undone last",
        "Rétablir ce qui vient d’être annulé",
    ),
    (
        "How many operations to redo",
        "Combien d’opérations rétablir",
    ),
    (
        "List the operations, newest first, or show what one of them changed",
        "Lister les opérations, la plus récente d’abord, ou montrer ce que l’une d’elles a changé",
    ),
    (
        "The operation to show in detail, by its number in the list",
        "L’opération à montrer en détail, par son numéro dans la liste",
    ),
    (
        "Show below each operation what it changed",
        "Montrer sous chaque opération ce qu’elle a changé",
    ),
    (
        "List at most N operations, and of each at most N changes",
        "Lister au plus N opérations, et de chacune au plus N modifications",
    ),
    (
        "Import recordings, annotations, lexicons and inventories into a corpus",
        "Importer enregistrements, annotations, lexiques et inventaires dans un corpus",
    ),
    (
        "Files and folders; - is standard input, whose kind --format says",
        "Fichiers et dossiers ; - est l’entrée standard, dont --format dit le genre",
    ),
    (
        "The kind of file that standard input is, by its extension: eaf, bvh, csv, sigml ...",
        "Le genre de fichier de l’entrée standard, par son extension : eaf, bvh, csv, sigml ...",
    ),
    (
        "The name of the recording or table that standard input holds",
        "Le nom de l’enregistrement ou de la table de l’entrée standard",
    ),
    (
        "Report what would be done, and write nothing",
        "Dire ce qui serait fait, sans rien écrire",
    ),
    (
        "Keep your edits and take the file's other changes; where both changed the same annotation, yours stays",
        "Garder vos modifications et prendre les autres du fichier ; si les deux ont changé la même annotation, la vôtre reste",
    ),
    (
        "Take what the file says, also where it takes back your edits",
        "Prendre ce que dit le fichier, même s’il annule vos modifications",
    ),
    (
        "Leave a recording as it is where the file would take back your edits",
        "Laisser un enregistrement tel quel si le fichier annulait vos modifications",
    ),
    ("Whose movement it is", "De qui est le mouvement"),
    ("The signer's dominant hand", "La main dominante du signeur"),
    (
        "The unit of length of the movement files: m, cm, mm, inch, ft, acclaim, or metres per unit",
        "L’unité de longueur des fichiers de mouvement : m, cm, mm, inch, ft, acclaim, ou des mètres par unité",
    ),
    (
        "The axes of the movement files: the directions up and to the signer's left, such as +Z,+X",
        "Les axes des fichiers de mouvement : vers le haut et vers la gauche du signeur, comme +Z,+X",
    ),
    (
        "A file that says which joint is what: lines such as `right wrist = RHand`",
        "Un fichier qui dit le rôle de chaque articulation : des lignes comme `right wrist = RHand`",
    ),
    (
        "Read the root's columns in the order of the numbers if the header has their order or unit wrong",
        "Lire les colonnes de la racine dans l’ordre des nombres si l’en-tête en donne mal l’ordre ou l’unité",
    ),
    (
        "A file that says which tier or column is what (JSON)",
        "Un fichier qui dit le rôle de chaque acteur ou colonne (JSON)",
    ),
    (
        "How the recordings came about",
        "L’origine des enregistrements",
    ),
    (
        "The terms under which the recordings may be used",
        "Les conditions d’usage des enregistrements",
    ),
    (
        "List rows: recordings, signs, tokens, tiers, annotations, inventories, values, signers, searches, operations",
        "Lister : enregistrements (recordings), signes (signs), occurrences (tokens), acteurs (tiers), annotations, inventaires (inventories), valeurs (values), signeurs (signers), recherches (searches), opérations (operations)",
    ),
    ("What to list", "Quoi lister"),
    (
        "Only rows that fit, such as gloss=BO*, start_us=>=500000, recording=recording:3, parent=none",
        "Seulement les lignes qui conviennent, comme gloss=BO*, start_us=>=500000, recording=recording:3, parent=none",
    ),
    ("The column to sort by", "La colonne du tri"),
    (
        "Sort from the greatest to the least",
        "Trier du plus grand au plus petit",
    ),
    ("List at most N rows", "Lister au plus N lignes"),
    ("Skip the first N rows", "Sauter les N premières lignes"),
    (
        "Show what a corpus holds",
        "Montrer ce que contient un corpus",
    ),
    (
        "Make an empty corpus with the inventories of handshapes, placements, movements and the rest",
        "Créer un corpus vide avec les inventaires de configurations, emplacements, mouvements et autres",
    ),
    (
        "The file to make, such as lsf.chereme; nothing may be there yet",
        "Le fichier à créer, comme lsf.chereme ; rien ne doit y être encore",
    ),
    (
        "Make a new sign from stored ones, and store it",
        "Composer un nouveau signe à partir d’autres, et l’enregistrer",
    ),
    (
        "The recipe, as text or JSON; - is standard input",
        "La recette, en texte ou en JSON ; - est l’entrée standard",
    ),
    (
        "Replace a sign that was made before; it keeps its gloss, its token and the annotations that people wrote on its tiers",
        "Remplacer un signe déjà composé ; il garde sa glose, son occurrence et les annotations de ses acteurs",
    ),
    (
        "Show how the sign comes about: the steps, where each channel comes from, joins and residuals",
        "Expliquer le signe : les étapes, la source de chaque canal, les raccords et les écarts",
    ),
    (
        "Draw the sign to a contact sheet (.png) or an animation (.gif)",
        "Dessiner le signe en planche (.png) ou en animation (.gif)",
    ),
    (
        "Draw movement as a contact sheet (.png) or an animation (.gif), handshapes (.png), or notation (.svg)",
        "Dessiner un mouvement en planche (.png) ou en animation (.gif), des configurations (.png), ou une notation (.svg)",
    ),
    ("What to draw", "Quoi dessiner"),
    (
        "The picture; its extension says the kind; - is standard output",
        "L’image ; son extension en dit le genre ; - est la sortie standard",
    ),
    (
        "The kind of picture for standard output: png, gif or svg",
        "Le genre d’image pour la sortie standard : png, gif ou svg",
    ),
    (
        "How many pictures a contact sheet has side by side, from 1 to 64",
        "Combien d’images une planche a côte à côte, de 1 à 64",
    ),
    (
        "How high one picture is, in pixels, from 32 to 2000",
        "La hauteur d’une image, en pixels, de 32 à 2000",
    ),
    (
        "How fast an animation runs; 1 is the recorded speed",
        "La vitesse de l’animation ; 1 est la vitesse d’origine",
    ),
    (
        "Leave out the pictures of hands and face from close by",
        "Sans les gros plans des mains et du visage",
    ),
    (
        "Which hand a handshape is drawn on",
        "La main sur laquelle une configuration est dessinée",
    ),
    (
        "Score how alike two pieces of movement are, with the alignment",
        "Mesurer la ressemblance de deux mouvements, avec leur alignement",
    ),
    (
        "The first: a gloss, token:41 or recording:3",
        "Le premier : une glose, token:41 ou recording:3",
    ),
    ("The second", "Le second"),
    (
        "Draw the alignment to a picture (.png)",
        "Dessiner l’alignement dans une image (.png)",
    ),
    (
        "Write over a picture that is there already",
        "Remplacer une image qui existe déjà",
    ),
    (
        "Find the tokens that answer a query",
        "Trouver les occurrences qui répondent à une requête",
    ),
    (
        "The query, words side by side must all hold; or @NAME, a kept one",
        "La requête, dont tous les termes doivent être vrais ; ou @NOM, une recherche gardée",
    ),
    (
        "Save the query in the corpus as @NAME, in place of an earlier one of that name",
        "Garder la requête dans le corpus sous @NOM, à la place d’une autre de ce nom",
    ),
    (
        "Delete the saved search NAME",
        "Supprimer la recherche gardée NOM",
    ),
    ("Show at most N tokens", "Montrer au plus N occurrences"),
    (
        "Skip the first N tokens",
        "Sauter les N premières occurrences",
    ),
    ("In which order", "Dans quel ordre"),
    (
        "Leave out the counts of values",
        "Sans les comptes des valeurs",
    ),
    (
        "Open the workbench: annotate, search and recombine in a window",
        "Ouvrir l’atelier : annoter, chercher et recombiner dans une fenêtre",
    ),
    ("The corpus to open", "Le corpus à ouvrir"),
    (
        "The folder for the settings and the starter corpus, in place of the platform's",
        "Le dossier des réglages et du corpus de départ, à la place de celui du système",
    ),
    (
        "List what could be made from a sign",
        "Lister ce qu’on pourrait composer à partir d’un signe",
    ),
    (
        "The sign: a gloss or token:41",
        "Le signe : une glose ou token:41",
    ),
    (
        "Add a tier to the recording named by --in",
        "Ajouter un acteur à l’enregistrement nommé par --in",
    ),
    ("Its name", "Son nom"),
    (
        "What its annotations say: gloss, translation, comment, free, or a component such as placement or nonmanual.brows",
        "Ce que disent ses annotations : gloss, translation, comment, free, ou un composant comme placement ou nonmanual.brows",
    ),
    ("Whose hand they are about", "La main dont elles parlent"),
    ("The tier above", "L’acteur parent"),
    (
        "How it hangs below: Time_Subdivision, Included_In, Symbolic_Subdivision or Symbolic_Association",
        "Son lien au parent : Time_Subdivision, Included_In, Symbolic_Subdivision ou Symbolic_Association",
    ),
    (
        "The inventory its values come from; the usual one of its component where none is named",
        "L’inventaire de ses valeurs ; sinon celui de son composant",
    ),
    (
        "Add the usual tiers to the recording named by --in, or those of another recording",
        "Ajouter les acteurs habituels à l’enregistrement nommé par --in, ou ceux d’un autre enregistrement",
    ),
    (
        "The recording whose tiers it shall have, without their annotations",
        "L’enregistrement dont il reçoit les acteurs, sans leurs annotations",
    ),
    ("Change what a tier is", "Changer un acteur"),
    ("Its new name", "Son nouveau nom"),
    ("What its annotations say", "Ce que disent ses annotations"),
    (
        "The inventory its values come from",
        "L’inventaire de ses valeurs",
    ),
    (
        "Copy a tier under another name",
        "Copier un acteur sous un autre nom",
    ),
    ("The name of the copy", "Le nom de la copie"),
    (
        "Leave the values of its annotations out",
        "Sans les valeurs de ses annotations",
    ),
    ("Leave its annotations out", "Sans ses annotations"),
    (
        "Take only annotations whose value holds this text, whatever its case and accents",
        "Seulement les annotations dont la valeur contient ce texte, sans égard à la casse et aux accents",
    ),
    (
        "Remove a tier, the tiers below it, and all their annotations",
        "Supprimer un acteur, ceux qui en dépendent, et toutes leurs annotations",
    ),
    (
        "Change what is known of the recording named by --in",
        "Changer ce qu’on sait de l’enregistrement nommé par --in",
    ),
    (
        "captured, made or generated",
        "captured (capturé), made (composé) ou generated (généré)",
    ),
    (
        "The terms under which it may be used",
        "Ses conditions d’usage",
    ),
    ("Remarks", "Remarques"),
    (
        "Change what is known of a signer",
        "Changer ce qu’on sait d’un signeur",
    ),
    ("The signer", "Le signeur"),
    ("The new name", "Le nouveau nom"),
    ("The dominant hand", "La main dominante"),
    (
        "Change a sign: its gloss, remarks and translations",
        "Changer un signe : sa glose, ses remarques et ses traductions",
    ),
    ("The gloss", "La glose"),
    ("The new gloss", "La nouvelle glose"),
    (
        "Add a translation, such as fr=escargot",
        "Ajouter une traduction, comme fr=escargot",
    ),
    ("Remove a translation", "Supprimer une traduction"),
    (
        "Make a token the citation form of its sign",
        "Faire d’une occurrence la forme de citation de son signe",
    ),
    (
        "The token, such as token:41",
        "L’occurrence, comme token:41",
    ),
    (
        "Transcribe a captured or made sign in HamNoSys, with the residual of each feature",
        "Transcrire un signe capturé ou composé en HamNoSys, avec l’écart de chaque trait",
    ),
    (
        "What to write: a gloss, token:41, or recording:3 where it is short",
        "Quoi transcrire : une glose, token:41, ou recording:3 s’il est court",
    ),
    (
        "Write the names of the symbols in place of the table",
        "Écrire les noms des symboles à la place du tableau",
    ),
    (
        "Keep what was written as the token's notation; `undo` takes it back",
        "Garder la transcription comme notation de l’occurrence ; `undo` l’annule",
    ),
    (
        "Write over a notation that the token has already",
        "Remplacer la notation que l’occurrence a déjà",
    ),
];
