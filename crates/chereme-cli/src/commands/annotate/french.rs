//! The French of `chereme annotate`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Add, change, move, split, merge, replace and remove annotations and tiers; in bulk from a table",
            "Ajouter, modifier, déplacer, couper, fusionner, remplacer et supprimer annotations et acteurs ; en masse à partir d’une table",
        ),
        (
            "The recording of the named tiers and annotations: recording:3 or its name",
            "L’enregistrement des acteurs et annotations nommés : recording:3 ou son nom",
        ),
        (
            "Move boundaries to the nearest frames of the recording's movement",
            "Amener les limites aux images les plus proches du mouvement",
        ),
        (
            "The treatment of annotations in the way of one that is added or moved",
            "Le sort des annotations qui gênent celle qu’on ajoute ou déplace",
        ),
        (
            "Report the ids of all annotations; without it of at most 100 in JSON, and of at most 20 in text",
            "Donner les numéros de toutes les annotations ; sinon de 100 au plus en JSON, et de 20 au plus en texte",
        ),
        (
            "They stay, and the change is refused",
            "Elles restent, et la modification est refusée",
        ),
        (
            "They are pushed along as far as necessary",
            "Elles sont poussées autant qu’il le faut",
        ),
        (
            "All later annotations of the tier move along",
            "Toutes les annotations suivantes de l’acteur se déplacent aussi",
        ),
        ("Add an annotation", "Ajouter une annotation"),
        ("The tier", "L’acteur"),
        (
            "Its value; unset, n/a and unclear are the three kinds of missing values",
            "Sa valeur ; unset, n/a et unclear sont les trois sortes de valeurs manquantes",
        ),
        ("Its start time", "Son début"),
        ("Its end time", "Sa fin"),
        (
            "Its parent annotation, on a tier whose annotations have no times of their own",
            "L’annotation parente, sur un acteur dont les annotations n’ont pas de temps propre",
        ),
        (
            "Its position among its siblings, counted from 0",
            "Sa position parmi ses sœurs, comptée à partir de 0",
        ),
        (
            "Change the value of an annotation, or move it",
            "Changer la valeur d’une annotation, ou la déplacer",
        ),
        ("The annotation", "L’annotation"),
        ("Its new value", "Sa nouvelle valeur"),
        ("Its new start time", "Son nouveau début"),
        ("Its new end time", "Sa nouvelle fin"),
        ("Cut an annotation in two", "Couper une annotation en deux"),
        (
            "The annotation, which becomes the first half",
            "L’annotation, qui devient la première moitié",
        ),
        ("The time of the cut", "Le moment de la coupure"),
        (
            "Merge two neighbouring annotations into one",
            "Fusionner deux annotations voisines",
        ),
        ("The earlier one, which stays", "La première, qui reste"),
        (
            "The later one, which is removed",
            "La seconde, qui disparaît",
        ),
        (
            "The value of the merged annotation; needed if the two values differ",
            "La valeur de l’annotation fusionnée ; nécessaire si les deux valeurs diffèrent",
        ),
        (
            "Move an annotation of a symbolic subdivision to another position among its siblings",
            "Donner à une annotation d’une subdivision symbolique une autre position parmi ses sœurs",
        ),
        (
            "The position, counted from 0",
            "La position, comptée à partir de 0",
        ),
        (
            "Remove annotations, with all that depend on them",
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
        ("The replacement", "Le texte de remplacement"),
        (
            "Take the text as a regular expression; $1 in the new text is its first group",
            "Lire le texte comme une expression régulière ; $1 dans le nouveau texte en est le premier groupe",
        ),
        (
            "Only values that equal the whole text",
            "Seulement les valeurs qui sont ce texte et rien d’autre",
        ),
        (
            "Only tiers with this name, where * stands for any letters; or tier:12",
            "Seulement les acteurs de ce nom, * pour des lettres quelconques ; ou tier:12",
        ),
        (
            "Report what would change, and write nothing",
            "Dire ce qui changerait, sans rien écrire",
        ),
        (
            "Shift all annotations of tiers in time, in the recording named by --in",
            "Décaler dans le temps toutes les annotations d’acteurs de l’enregistrement nommé par --in",
        ),
        (
            "The amount, such as 0.2s or -200ms; a negative amount shifts towards the start",
            "La durée, comme 0.2s ou -200ms ; une durée négative décale vers le début",
        ),
        (
            "Report how many annotations would move, and write nothing",
            "Dire combien d’annotations se déplaceraient, sans rien écrire",
        ),
        (
            "Paste annotations that the window or a spreadsheet copied, into the recording named by --in",
            "Coller des annotations copiées par la fenêtre ou un tableur, dans l’enregistrement nommé par --in",
        ),
        (
            "Each line of the text has a tier, a start, an end and a value, with tabs between them; titles may give another order. Annotations keep their times and tiers, unless --at and --tier give others.",
            "Chaque ligne du texte a un acteur, un début, une fin et une valeur, séparés par des tabulations ; des titres peuvent donner un autre ordre. Les annotations gardent leurs temps et leurs acteurs, sauf si --at et --tier en donnent d’autres.",
        ),
        (
            "The text; - is standard input",
            "Le texte ; - est l’entrée standard",
        ),
        (
            "The tier of annotations without a tier name; with --at, of all if they name one tier only",
            "L’acteur des annotations sans nom d’acteur ; avec --at, de toutes si elles n’en nomment qu’un",
        ),
        (
            "The start of the first annotation; the others keep their distances from it",
            "Le début de la première annotation ; les autres gardent leur distance à elle",
        ),
        (
            "Paste the annotations that have a place even if others have none",
            "Coller les annotations qui ont une place, même si d’autres n’en ont pas",
        ),
        (
            "Carry out the changes in a table, all of them or none",
            "Faire les modifications d’une table, toutes ou aucune",
        ),
        (
            "Add a tier to the recording named by --in",
            "Ajouter un acteur à l’enregistrement nommé par --in",
        ),
        ("Its name", "Son nom"),
        ("The parent tier", "L’acteur parent"),
        (
            "Its relation to the parent: Time_Subdivision, Included_In, Symbolic_Subdivision or Symbolic_Association",
            "Sa relation au parent : Time_Subdivision, Included_In, Symbolic_Subdivision ou Symbolic_Association",
        ),
        (
            "The inventory of its values; without it the usual one of its component",
            "L’inventaire de ses valeurs ; sinon celui de son composant",
        ),
        (
            "Add the usual tiers to the recording named by --in, or those of another recording",
            "Ajouter les acteurs habituels à l’enregistrement nommé par --in, ou ceux d’un autre enregistrement",
        ),
        (
            "The recording whose tiers are copied, without their annotations",
            "L’enregistrement dont les acteurs sont copiés, sans leurs annotations",
        ),
        (
            "Change a tier: its name, subject, hand, inventory, people or language",
            "Changer un acteur : son nom, son objet, sa main, son inventaire, ses personnes ou sa langue",
        ),
        ("Its new name", "Son nouveau nom"),
        ("The inventory of its values", "L’inventaire de ses valeurs"),
        (
            "Copy a tier under another name",
            "Copier un acteur sous un autre nom",
        ),
        ("The name of the copy", "Le nom de la copie"),
        (
            "Leave out the values of its annotations",
            "Sans les valeurs de ses annotations",
        ),
        ("Leave out its annotations", "Sans ses annotations"),
        (
            "Take only annotations whose value contains this text, ignoring case and accents",
            "Seulement les annotations dont la valeur contient ce texte, sans égard à la casse et aux accents",
        ),
        (
            "Remove a tier, the tiers below it, and all their annotations",
            "Supprimer un acteur, ceux qui en dépendent, et toutes leurs annotations",
        ),
        (
            "Change the recording named by --in: its name, signer or remarks",
            "Changer ce qu’on sait de l’enregistrement nommé par --in",
        ),
        (
            "The origin: captured, made or generated",
            "L’origine : captured (capturé), made (composé) ou generated (généré)",
        ),
        (
            "The terms under which it may be used",
            "Ses conditions d’usage",
        ),
        (
            "Change a signer: name, handedness or remarks",
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
            "The table (.csv, .tsv or .txt); - is standard input",
            "La table (.csv, .tsv ou .txt) ; - est l’entrée standard",
        ),
        (
            "The unit of bare numbers: s, ms or frames",
            "L’unité des nombres sans unité : s, ms ou frames",
        ),
        (
            "The hand of the annotations, if the role does not name it",
            "La main des annotations, si le rôle ne la nomme pas",
        ),
        (
            "The signer who is annotated, whom `signer=` finds; \"\" removes the name",
            "Le signeur annoté, que `signer=` trouve ; \"\" enlève le nom",
        ),
        (
            "The annotator; \"\" removes the name",
            "L’annotateur ; \"\" enlève le nom",
        ),
        (
            "The language of its values, such as de; \"\" removes it",
            "La langue de ses valeurs, comme de ; \"\" l’enlève",
        ),
        (
            "The subject of its annotations; the word before the dot, as in right.placement, is their hand",
            "L’objet de ses annotations ; le mot avant le point, comme dans right.placement, est leur main",
        ),
        (
            "Each call is one operation that `chereme undo` takes back. A change that would break a rule of the tiers is refused, with a remedy. A time is 1.5, 1.5s, 1500ms, 0:01.500 or a frame such as f90. A tier is tier:12, or its name with --in RECORDING; an annotation is annotation:12, or its id in the file from which it was imported.",
            "Chaque appel est une opération que `chereme undo` annule. Une modification qui romprait une règle des acteurs est refusée, avec un remède. Un temps s’écrit 1.5, 1.5s, 1500ms, 0:01.500 ou comme image, par exemple f90. Un acteur est tier:12, ou son nom avec --in RECORDING ; une annotation est annotation:12, ou son id dans le fichier dont elle a été importée.",
        ),
        (
            "Actions on annotations: add, set, split, merge, reorder, remove, replace, shift, paste, from. On tiers: add-tier, add-tiers, tier, copy-tier, remove-tier. On other things: recording, signer, sign, cite.",
            "Actions sur les annotations : add, set, split, merge, reorder, remove, replace, shift, paste, from. Sur les acteurs : add-tier, add-tiers, tier, copy-tier, remove-tier. Sur le reste : recording, signer, sign, cite.",
        ),
        (
            "Dependent tiers are shifted, too. Without --tier all tiers of the recording are shifted.",
            "Les acteurs dépendants suivent. Sans --tier, tous les acteurs de l’enregistrement se déplacent.",
        ),
        (
            "Columns: recording, tier, start, end, duration, value, action (add, set, remove), id, parent. The title (start_ms, `end [s]`), the number (1500ms) or --unit gives the unit of times; without any of them times are in seconds. The tab-delimited text that ELAN exports is such a table, with and without titles.",
            "Colonnes : recording, tier, start, end, duration, value, action (add, set, remove), id, parent. Le titre (start_ms, `end [s]`), le nombre (1500ms) ou --unit donne l’unité des temps ; sinon les temps sont en secondes. Le texte à tabulations qu’ELAN exporte est une telle table, avec ou sans titres.",
        ),
        (
            "The usual tiers: gloss and translation; below the gloss handshape, placement, movement with its direction, palm and finger direction of either hand, mouth, brows and head; and a comment. If a tier of that name exists, it stays as it is.",
            "Les acteurs habituels : glose et traduction ; sous la glose, configuration, emplacement, mouvement avec sa direction, directions de la paume et des doigts de chaque main, bouche, sourcils et tête ; et un commentaire. Si un acteur de ce nom existe, il reste tel quel.",
        ),
        ("No hand", "Aucune main"),
    ],
    lines: &[
        (
            "nothing is written; it would be:",
            "rien n’est écrit ; ce serait :",
        ),
        ("added tier:{id}, {name}", "ajouté : tier:{id}, {name}"),
        ("changed tier:{id}, {name}", "modifié : tier:{id}, {name}"),
        (
            "changed recording:{id}, {name}",
            "modifié : recording:{id}, {name}",
        ),
        (
            "changed signer:{id}, {name}",
            "modifié : signer:{id}, {name}",
        ),
        ("changed {gloss}", "modifié : {gloss}"),
        ("removed {names} with {n}", "retiré : {names} avec {n}"),
        (
            "token:{id} is the citation form of {gloss}",
            "token:{id} est la forme de citation de {gloss}",
        ),
        (
            "{tier} of {recording} at {time} s: {from} -> {to}",
            "{tier} de {recording} à {time} s : {from} -> {to}",
        ),
        (
            "write a time such as 0.2s or -200ms",
            "écrivez un temps comme 0.2s ou -200ms",
        ),
        (
            "write LANGUAGE=TEXT, such as fr=escargot",
            "écrivez LANGUE=TEXTE, comme fr=escargot",
        ),
        (
            "--role names the {own} hand, and --hand says {other}",
            "--role nomme la main {own}, et --hand dit {other}",
        ),
        ("name the hand once", "nommez la main une fois"),
        ("which recording?", "quel enregistrement ?"),
        ("name it with --in", "nommez-le avec --in"),
    ],
    titles: &[],
};
