//! French forms of messages about annotations, tiers and the corpus file, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const EDITING: &[(&str, &str)] = &[
    (
        "write token:41, recording:3, recording:\"NGT Thanks\", sign:LIMACE or a gloss",
        "écrivez token:41, recording:3, recording:\"NGT Thanks\", sign:LIMACE ou une glose",
    ),
    (
        "{text} names nothing after the colon",
        "{text} ne nomme rien après les deux-points",
    ),
    (
        "{text} is no number of a token",
        "{text} n’est pas un numéro d’occurrence",
    ),
    (
        "{text} is no number of a {kind}",
        "{text} n’est pas un numéro de {kind}",
    ),
    (
        "{text} is no time: write 1.5, 0:01.500 or f12",
        "{text} n’est pas un temps : écrivez 1.5, 0:01.500 ou f12",
    ),
    ("no start and end in {text}", "ni début ni fin dans {text}"),
    (
        "it ends at {text}, which is not after its start",
        "elle finit à {text}, ce qui n’est pas après son début",
    ),
    (
        "{text} is no value of its tier",
        "{text} n’est pas une valeur de son acteur",
    ),
    (
        "the annotation that begins at {text} is not within the recording",
        "l’annotation qui commence à {text} n’est pas dans l’enregistrement",
    ),
    (
        "no annotation of the parent tier contains {text}",
        "aucune annotation de l’acteur parent ne contient {text}",
    ),
    (
        "there is an annotation already at {text}",
        "il y a déjà une annotation à {text}",
    ),
    (
        "no annotation is left for {text}",
        "il ne reste pas d’annotation pour {text}",
    ),
    (
        "the text has no start and end times",
        "le texte n’a ni débuts ni fins",
    ),
    (
        "write tier, start, end and value in each line, with tabs between them",
        "écrivez acteur, début, fin et valeur dans chaque ligne, séparés par des tabulations",
    ),
    (
        "the recording {name} has no frames",
        "l’enregistrement {name} n’a pas d’images",
    ),
    (
        "add the tier, or name another one with --tier",
        "ajoutez l’acteur, ou nommez-en un autre avec --tier",
    ),
    ("the text is not UTF-8", "le texte n’est pas en UTF-8"),
    ("an empty text names nothing", "un texte vide ne nomme rien"),
    ("{what} is no token", "{what} n’est pas une occurrence"),
    ("write token:41 or a gloss", "écrivez token:41 ou une glose"),
    (
        "a recording has this name: write {address}",
        "un enregistrement porte ce nom : écrivez {address}",
    ),
    (
        "the sign {address} has no token",
        "le signe {address} n’a pas d’occurrence",
    ),
    (
        "import or make one first",
        "importez-en une ou créez-en une d’abord",
    ),
    (
        "the corpus knows no signer; a recording's body is recording:NAME",
        "le corpus ne connaît aucun signeur ; le corps d’un enregistrement est recording:NOM",
    ),
    (
        "make it move first: `chereme animate CORPUS GLOSS --as NAME`",
        "donnez-lui d’abord un mouvement : `chereme animate CORPUS GLOSE --as NOM`",
    ),
    (
        "hang it below another tier, or below none",
        "mettez-le sous un autre acteur, ou sous aucun",
    ),
    (
        "its annotations cannot hang below {tier} as {stereotype}: {why}",
        "ses annotations ne peuvent pas être sous {tier} comme {stereotype} : {why}",
    ),
    (
        "choose Included_In, or change those annotations first",
        "choisissez Included_In, ou modifiez d’abord ces annotations",
    ),
    (
        "no annotation above holds the time from {start} to {end}",
        "aucune annotation au-dessus ne contient le temps de {start} à {end}",
    ),
    (
        "every annotation of the tier must lie inside one of the tier above",
        "chaque annotation de l’acteur doit se trouver dans une annotation de l’acteur au-dessus",
    ),
    (
        "or name the unit with the table: --unit ms, --unit s or --unit frames",
        "ou donnez l’unité avec la table : --unit ms, --unit s ou --unit frames",
    ),
    (
        "the row names {what}, but annotation:{id} is on the tier {tier} of recording:{number} ({name})",
        "la ligne nomme {what}, mais annotation:{id} est sur l’acteur {tier} de recording:{number} ({name})",
    ),
    (
        "correct the row; a table made from another corpus does not fit this one",
        "corrigez la ligne ; une table faite d’un autre corpus ne va pas avec celui-ci",
    ),
    (
        "write a row for each change below the row of column names",
        "écrivez une ligne par modification, sous la ligne des noms de colonnes",
    ),
    (
        "the columns are recording, tier, start, end, duration, value, action, id, parent",
        "les colonnes sont recording, tier, start, end, duration, value, action, id, parent",
    ),
    (
        "name the annotation by its id, or by its tier and start",
        "nommez l’annotation par son id, ou par son acteur et son début",
    ),
    (
        "the recording has no tier {id}, or it is named twice",
        "l’enregistrement n’a pas d’acteur {id}, ou il est nommé deux fois",
    ),
    (
        "name each tier of the recording once",
        "nommez une fois chaque acteur de l’enregistrement",
    ),
    (
        "{what} cannot go from {start} to {end}: there is no room for the others",
        "{what} ne peut pas aller de {start} à {end} : il n’y a pas de place pour les autres",
    ),
    (
        "the furthest is from {start} to {end}",
        "au plus loin : de {start} à {end}",
    ),
    ("nothing is to be added", "rien n’est à ajouter"),
    (
        "an annotation of the symbolic tier {tier} needs one above it",
        "une annotation de l’acteur symbolique {tier} en demande une au-dessus",
    ),
    (
        "name its parent, or the times of its parent",
        "nommez son parent, ou les temps de son parent",
    ),
    (
        "an annotation of the tier {tier} needs a start and an end",
        "une annotation de l’acteur {tier} demande un début et une fin",
    ),
    (
        "only annotations of symbolic tiers have no times of their own",
        "seules les annotations des acteurs symboliques n’ont pas de temps à elles",
    ),
    ("nothing was added", "rien n’a été ajouté"),
    ("the recording is gone", "l’enregistrement n’existe plus"),
    (
        "`chereme list CORPUS values --where 'inventory={name}'` lists the values",
        "`chereme list CORPUS values --where 'inventory={name}'` donne la liste des valeurs",
    ),
    (
        "which recording's tier is {tier}?",
        "de quel enregistrement est l’acteur {tier} ?",
    ),
    (
        "add one first: `chereme annotate CORPUS --in RECORDING add-tier NAME`",
        "ajoutez-en un d’abord : `chereme annotate CORPUS --in ENREGISTREMENT add-tier NOM`",
    ),
    ("{id} could not be added", "{id} n’a pas pu être ajouté"),
    (
        "name the recording too, or write which one",
        "nommez aussi l’enregistrement, ou dites lequel",
    ),
    (
        "`chereme list CORPUS annotations` lists those that are there",
        "`chereme list CORPUS annotations` donne la liste de celles qui existent",
    ),
    (
        "the one there, {name}, starts at {start}",
        "celle qui s’y trouve, {name}, commence à {start}",
    ),
    (
        "no annotation of the tier {tier} starts at {start}",
        "aucune annotation de l’acteur {tier} ne commence à {start}",
    ),
    (
        "no annotation of the tier above {tier} holds the time from {start} to {end}",
        "aucune annotation de l’acteur au-dessus de {tier} ne contient le temps de {start} à {end}",
    ),
    ("name the parent by its id", "nommez le parent par son id"),
    (
        "write a regular expression such as ^BO.*; a text is found without --regex",
        "écrivez une expression régulière comme ^BO.* ; un simple texte se trouve sans --regex",
    ),
    (
        "the new text names the group {name}, which the expression does not have",
        "le nouveau texte nomme le groupe {name}, que l’expression n’a pas",
    ),
    (
        "$1 is the first group in round brackets; a dollar sign is written $$",
        "$1 est le premier groupe entre parenthèses ; un dollar s’écrit $$",
    ),
    (
        "{text} is no regular expression: {why}",
        "{text} n’est pas une expression régulière : {why}",
    ),
    (
        "annotations of the tier {tier} would leave the recording {name}",
        "des annotations de l’acteur {tier} sortiraient de l’enregistrement {name}",
    ),
    (
        "shift it by {seconds} at most",
        "décalez-le de {seconds} au plus",
    ),
    (
        "the recording {name} has all of these tiers already",
        "l’enregistrement {name} a déjà tous ces acteurs",
    ),
    (
        "add single tiers, or copy those of another recording",
        "ajoutez des acteurs un à un, ou copiez ceux d’un autre enregistrement",
    ),
    (
        "the tier {tier} holds no glosses",
        "l’acteur {tier} ne contient pas de gloses",
    ),
    ("name a gloss tier", "nommez un acteur de gloses"),
    (
        "the recording {name} has no tiers to copy",
        "l’enregistrement {name} n’a pas d’acteurs à copier",
    ),
    (
        "name another, or take the usual tiers",
        "nommez-en un autre, ou prenez les acteurs habituels",
    ),
    (
        "the recording {name} has no movement, and so no frames to snap to",
        "l’enregistrement {name} n’a pas de mouvement, donc pas d’images où se caler",
    ),
    (
        "the recording {name} has no movement, and so no frames {what}",
        "l’enregistrement {name} n’a pas de mouvement, donc pas d’images {what}",
    ),
    ("give times in seconds", "donnez les temps en secondes"),
    (
        "frame {n} is not there: the recording {name} has {all} frames",
        "l’image {n} n’existe pas : l’enregistrement {name} a {all} images",
    ),
    (
        "frames are counted from f0; its end is f{n}",
        "les images se comptent à partir de f0 ; sa fin est f{n}",
    ),
    (
        "it would end at {end}, before its start at {start}",
        "elle finirait à {end}, avant son début à {start}",
    ),
    (
        "{time} is before the start of the recording {name}",
        "{time} est avant le début de l’enregistrement {name}",
    ),
    (
        "times are counted from the start of the recording",
        "les temps se comptent à partir du début de l’enregistrement",
    ),
    (
        "{time} is later than the recording {name} can be long, and it has no movement to say how long it is",
        "{time} est plus tard que l’enregistrement {name} ne peut durer, et aucun mouvement ne dit sa durée",
    ),
    (
        "a bare number counts in seconds; write 1500ms for milliseconds, or name a column start_ms",
        "un nombre sans unité compte en secondes ; écrivez 1500ms pour des millisecondes, ou appelez une colonne start_ms",
    ),
    (
        "{time} is after the end of the recording {name}, which is {length} long",
        "{time} est après la fin de l’enregistrement {name}, qui dure {length}",
    ),
    (
        "end it with the recording",
        "finissez-la avec l’enregistrement",
    ),
    (
        "a {stereotype} has times of its own and cannot hang below the symbolic tier {tier}",
        "un acteur {stereotype} a des temps à lui et ne peut pas être sous l’acteur symbolique {tier}",
    ),
    (
        "make it Symbolic_Subdivision or Symbolic_Association",
        "faites-en Symbolic_Subdivision ou Symbolic_Association",
    ),
    ("a tier needs a name", "un acteur doit avoir un nom"),
    (
        "the recording has a tier {name} already",
        "l’enregistrement a déjà un acteur {name}",
    ),
    (
        "the inventory {name} is for {what}, and the tier {tier} is not",
        "l’inventaire {name} est pour {what}, et l’acteur {tier} ne l’est pas",
    ),
    (
        "there is no inventory {name}",
        "il n’y a pas d’inventaire {name}",
    ),
    (
        "change the tier's role, or import an inventory for it",
        "changez le rôle de l’acteur, ou importez un inventaire pour lui",
    ),
    (
        "for this tier there are: {names}",
        "pour cet acteur il y a : {names}",
    ),
    (
        "change those annotations first, or leave the tier free",
        "modifiez d’abord ces annotations, ou laissez l’acteur libre",
    ),
    (
        "no time next to it is free: move or shorten the other one first",
        "aucun temps à côté n’est libre : déplacez ou raccourcissez d’abord l’autre",
    ),
    (
        "take the file from a backup, or import the recording again",
        "reprenez le fichier d’une sauvegarde, ou importez de nouveau l’enregistrement",
    ),
    (
        "`chereme check CORPUS --mend` puts it right",
        "`chereme check CORPUS --mend` le répare",
    ),
    (
        "the rows were changed without it",
        "les lignes ont été modifiées sans lui",
    ),
    (
        "the next search builds it again; so does `chereme check CORPUS --mend`",
        "la prochaine recherche le reconstruit ; `chereme check CORPUS --mend` aussi",
    ),
    (
        "it holds {documents} documents for {tokens} tokens",
        "il contient {documents} documents pour {tokens} occurrences",
    ),
    ("tokens derived again", "occurrences dérivées de nouveau"),
    (
        "the tokens were derived again from the tiers",
        "les occurrences ont été dérivées de nouveau des acteurs",
    ),
    (
        "the search index was built again",
        "l’index de recherche a été reconstruit",
    ),
    (
        "it refers to a row of {table} that is not there",
        "elle renvoie à une ligne de {table} qui n’existe pas",
    ),
    (
        "its bytes do not match the hash that names it",
        "ses octets ne correspondent pas à l’empreinte qui le nomme",
    ),
    ("its document cannot be read", "son document ne se lit pas"),
    (
        "its document does not match the hash that names it",
        "son document ne correspond pas à l’empreinte qui le nomme",
    ),
    (
        "frames {first} to {last} of {all} are missing",
        "il manque les images {first} à {last} sur {all}",
    ),
    (
        "correct the value: `chereme annotate CORPUS set ANNOTATION --value TEXT`",
        "corrigez la valeur : `chereme annotate CORPUS set ANNOTATION --value TEXTE`",
    ),
    (
        "correct the times: `chereme annotate CORPUS set ANNOTATION --start TIME --end TIME`",
        "corrigez les temps : `chereme annotate CORPUS set ANNOTATION --start TEMPS --end TEMPS`",
    ),
    (
        "give it another name: `chereme annotate CORPUS tier TIER --name NAME --in RECORDING`",
        "donnez-lui un autre nom : `chereme annotate CORPUS tier ACTEUR --name NOM --in ENREGISTREMENT`",
    ),
    (
        "correct the tiers in the file that they come from, and import it again",
        "corrigez les acteurs dans le fichier d’où ils viennent, et importez-le de nouveau",
    ),
    (
        "correct it in the file that it comes from and import that again, or remove it: `chereme annotate CORPUS remove ANNOTATION`",
        "corrigez-la dans le fichier d’où elle vient et importez-le de nouveau, ou supprimez-la : `chereme annotate CORPUS remove ANNOTATION`",
    ),
    (
        "its content does not match its checksum",
        "son contenu ne correspond pas à sa somme de contrôle",
    ),
    (
        "compare it with a backup; if it is right as it is now, `chereme check CORPUS --accept` keeps it so",
        "comparez avec une sauvegarde ; si c’est juste tel quel, `chereme check CORPUS --accept` le garde ainsi",
    ),
    (
        "its file {name} is not as it was stored",
        "son fichier {name} n’est pas tel qu’il a été enregistré",
    ),
    (
        "its bytes do not match its hash",
        "ses octets ne correspondent pas à son empreinte",
    ),
    (
        "its plan does not match the hash that names it",
        "son plan ne correspond pas à l’empreinte qui le nomme",
    ),
    (
        "further overlapping annotations on {tier}: {n}",
        "autres annotations qui se chevauchent sur {tier} : {n}",
    ),
    (
        "ELAN allows no overlap within a tier; put one of each two on another tier",
        "ELAN n’admet pas de chevauchement dans un acteur ; mettez l’une des deux sur un autre acteur",
    ),
    (
        "its tokens do not agree with its tiers",
        "ses occurrences ne correspondent pas à ses acteurs",
    ),
    ("it is cut short", "il est tronqué"),
    (
        "{id} can be {n} annotations: {list}",
        "{id} peut désigner {n} annotations : {list}",
    ),
    (
        "the tier {tier} says {n} that the inventory {inventory} does not have: {list}",
        "l’acteur {tier} dit {n} que l’inventaire {inventory} n’a pas : {list}",
    ),
    ("the new annotation", "la nouvelle annotation"),
    (
        "an annotation without a value ({id})",
        "une annotation sans valeur ({id})",
    ),
    (
        "{what} has {n} frames of {all}",
        "{what} a {n} images sur {all}",
    ),
    (
        "operation {id} holds {n} of its {all} changes",
        "l’opération {id} contient {n} de ses {all} modifications",
    ),
    (
        "a token goes with its annotation: {command}",
        "une occurrence part avec son annotation : {command}",
    ),
    (
        "write recording:3, recording:NAME or sign:GLOSS",
        "écrivez recording:3, recording:NOM ou sign:GLOSE",
    ),
    (
        "the recording has no tier {text}",
        "l’enregistrement n’a pas d’acteur {text}",
    ),
];
