//! French forms of messages about annotation files, tables, lexicons and SiGML, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const DOCUMENTS: &[(&str, &str)] = &[
    (
        "the text is in {encoding}; EAF is read in UTF-8 and UTF-16, and in Latin-1 and Windows-1252 where the file says so: open it in ELAN or a text editor and save it as UTF-8",
        "le texte est en {encoding} ; un EAF se lit en UTF-8 et en UTF-16, et en Latin-1 et Windows-1252 si le fichier le dit : ouvrez-le dans ELAN ou un éditeur de texte et enregistrez-le en UTF-8",
    ),
    (
        "this is not XML; an EAF file starts with <?xml …?> and <ANNOTATION_DOCUMENT …>",
        "ce n’est pas du XML ; un fichier EAF commence par <?xml …?> et <ANNOTATION_DOCUMENT …>",
    ),
    (
        "the root element is <{found}>; it should be <sigml>, or a single <hamgestural_sign> or <hns_sign>",
        "l’élément racine est <{found}> ; il faut <sigml>, ou un seul <hamgestural_sign> ou <hns_sign>",
    ),
    (
        "the root element is <{found}>; it should be <{expected}>",
        "l’élément racine est <{found}> ; il faut <{expected}>",
    ),
    (
        "the file ends inside <{open}>; it was cut short: copy it again, or take one of ELAN's backups (.001 to .005)",
        "le fichier finit dans <{open}> ; il est tronqué : copiez-le de nouveau, ou prenez une sauvegarde d’ELAN (.001 à .005)",
    ),
    (
        "the file ends inside <{open}>; it was cut short: copy it again",
        "le fichier finit dans <{open}> ; il est tronqué : copiez-le de nouveau",
    ),
    (
        "a <!DOCTYPE …> is not read, for entities can hide anything; remove it, no EAF file needs one",
        "un <!DOCTYPE …> n’est pas lu, car des entités peuvent tout cacher ; retirez-le, aucun fichier EAF n’en a besoin",
    ),
    (
        "a <!DOCTYPE …> with declarations of its own is not read, for entities can hide anything; take away what stands between [ and ]",
        "un <!DOCTYPE …> avec ses propres déclarations n’est pas lu, car des entités peuvent tout cacher ; retirez ce qui est entre [ et ]",
    ),
    (
        "{what}, more than {n}; no EAF file needs as many",
        "{what}, plus de {n} ; aucun fichier EAF n’en demande autant",
    ),
    (
        "{what}, more than {n}; no SiGML file needs as many",
        "{what}, plus de {n} ; aucun fichier SiGML n’en demande autant",
    ),
    (
        "the text is in {encoding}, and SiGML is read in UTF-8; open it in a text editor and save it as UTF-8",
        "le texte est en {encoding}, et un SiGML se lit en UTF-8 ; ouvrez-le dans un éditeur de texte et enregistrez-le en UTF-8",
    ),
    (
        "this is not XML; a SiGML file starts with <sigml>",
        "ce n’est pas du XML ; un fichier SiGML commence par <sigml>",
    ),
    (
        "annotation {id} refers to {what} {name}, which is not in the file",
        "l’annotation {id} renvoie à {what} {name}, qui n’est pas dans le fichier",
    ),
    (
        "annotation {id} has no place in time and was left out",
        "l’annotation {id} n’a pas de place dans le temps et a été laissée de côté",
    ),
    (
        "annotation {id} has no length",
        "l’annotation {id} n’a pas de durée",
    ),
    ("annotation {id} has {kind}", "l’annotation {id} a {kind}"),
    (
        "the time slot id {id} is given twice; the first counts",
        "l’id de temps {id} est donné deux fois ; le premier compte",
    ),
    (
        "the time slot {id} lies before the start",
        "le temps {id} est avant le début",
    ),
    (
        "the annotation id {id} is empty or given twice; this annotation gets a new one",
        "l’id d’annotation {id} est vide ou donné deux fois ; cette annotation en reçoit un nouveau",
    ),
    (
        "the tier {name} is there twice; this one gets a number",
        "l’acteur {name} est là deux fois ; celui-ci reçoit un numéro",
    ),
    (
        "the tier type {name} is there twice; the first counts",
        "le type d’acteur {name} est là deux fois ; le premier compte",
    ),
    (
        "the tier {name} has the type {kind}, which is not in the file",
        "l’acteur {name} a le type {kind}, qui n’est pas dans le fichier",
    ),
    (
        "the tier {name} hangs below {parent}, which is not in the file; it becomes a root tier",
        "l’acteur {name} est sous {parent}, qui n’est pas dans le fichier ; il devient un acteur racine",
    ),
    (
        "the tier {name} hangs below more than {n} others; it becomes a root tier",
        "l’acteur {name} est sous plus de {n} autres ; il devient un acteur racine",
    ),
    (
        "the tier {name} hangs below itself; it becomes a root tier",
        "l’acteur {name} est sous lui-même ; il devient un acteur racine",
    ),
    (
        "the type of tier {name} has the stereotype {what}, which is not one of ELAN's four",
        "le type de l’acteur {name} a le stéréotype {what}, qui n’est pas l’un des quatre d’ELAN",
    ),
    (
        "the tier {name} hangs below another, and its type has no stereotype",
        "l’acteur {name} est sous un autre, et son type n’a pas de stéréotype",
    ),
    (
        "the tier {name} has no parent, and its type has a stereotype",
        "l’acteur {name} n’a pas de parent, et son type a un stéréotype",
    ),
    (
        "the time units {units} are not known; they were read as milliseconds",
        "les unités de temps {units} ne sont pas connues ; elles ont été lues comme des millisecondes",
    ),
    (
        "set TIME_UNITS to milliseconds, PAL-frames or NTSC-frames",
        "mettez TIME_UNITS à milliseconds, PAL-frames ou NTSC-frames",
    ),
    (
        "the times are in {units}; they become milliseconds",
        "les temps sont en {units} ; ils deviennent des millisecondes",
    ),
    (
        "the Time_Subdivision {name} leaves part of annotation {id} uncovered",
        "le Time_Subdivision {name} laisse libre une partie de l’annotation {id}",
    ),
    (
        "ELAN allows no gaps there; move a boundary, or make the tier Included_In",
        "ELAN n’y admet pas de trous ; déplacez une limite, ou faites de l’acteur un Included_In",
    ),
    (
        "annotation {id} does not lie within an annotation of the tier above",
        "l’annotation {id} n’est pas dans une annotation de l’acteur au-dessus",
    ),
    (
        "annotation {id} ends before it starts; the ends were exchanged",
        "l’annotation {id} finit avant de commencer ; les bouts ont été échangés",
    ),
    (
        "the annotations below {above} are not one chain; loose annotations follow in the order of the file",
        "les annotations sous {above} ne forment pas une chaîne ; les autres suivent dans l’ordre du fichier",
    ),
    (
        "annotation {id} is not the only one below its parent, and its tier allows one",
        "l’annotation {id} n’est pas seule sous son parent, et son acteur n’en admet qu’une",
    ),
    (
        "annotations overlap on the tier {name}: {list}",
        "des annotations se chevauchent sur l’acteur {name} : {list}",
    ),
    (
        "the file says that it is in {encoding}, and is in UTF-8; it was read as UTF-8",
        "le fichier se dit en {encoding}, et est en UTF-8 ; il a été lu en UTF-8",
    ),
    (
        "the text is in {encoding}; it is written so again",
        "le texte est en {encoding} ; il sera écrit de même",
    ),
    (
        "<{element}> has an attribute twice; the first counts",
        "<{element}> a deux fois un attribut ; le premier compte",
    ),
    (
        "<{element}> has the attribute {name}, which EAF doesn't know; it was kept aside",
        "<{element}> a l’attribut {name}, qu’EAF ne connaît pas ; il a été gardé à part",
    ),
    (
        "<{element}> in <{outer}> is not known to EAF; it was kept aside",
        "<{element}> dans <{outer}> n’est pas connu d’EAF ; il a été gardé à part",
    ),
    (
        "<{element}> in <{outer}> is not known to EAF; it was left out",
        "<{element}> dans <{outer}> n’est pas connu d’EAF ; il a été laissé de côté",
    ),
    (
        "{attribute} of <{element}> is not a whole number within the range of times; it was left out",
        "{attribute} de <{element}> n’est pas un nombre entier dans l’étendue des temps ; il a été laissé de côté",
    ),
    (
        "{attribute} of <{element}> is not a whole number; it was left out",
        "{attribute} de <{element}> n’est pas un nombre entier ; il a été laissé de côté",
    ),
    (
        "the attributes of <{element}> were left out",
        "les attributs de <{element}> ont été laissés de côté",
    ),
    (
        "this ANNOTATION holds {n} annotations instead of one",
        "cette ANNOTATION contient {n} annotations au lieu d’une",
    ),
    (
        "the colour of the tier {name} is not understood",
        "la couleur de l’acteur {name} ne se comprend pas",
    ),
    (
        "the text in <{element}> stands outside any value; it was left out",
        "le texte dans <{element}> est hors de toute valeur ; il a été laissé de côté",
    ),
    (
        "<{element}> stands inside the text of <{outer}>; it was left out",
        "<{element}> est dans le texte de <{outer}> ; il a été laissé de côté",
    ),
    (
        "there is more after the end of the document; it was left out",
        "il y a autre chose après la fin du document ; cela a été laissé de côté",
    ),
    (
        "<{element}> has a broken attribute; write NAME=\"value\"",
        "<{element}> a un attribut mal écrit ; écrivez NOM=\"valeur\"",
    ),
    (
        "write &amp; for an ampersand",
        "écrivez &amp; pour une esperluette",
    ),
    (
        "an XML comment or instruction is not kept",
        "un commentaire ou une instruction XML n’est pas gardé",
    ),
    (
        "this is not text; save it as lines of text in UTF-8",
        "ce n’est pas du texte ; enregistrez-le en lignes de texte, en UTF-8",
    ),
    (
        "no line holds HamNoSys; a line is a gloss, a tab and symbols, as characters or by name: hamflathand hamextfingeru hampalml",
        "aucune ligne ne contient de HamNoSys ; une ligne est une glose, une tabulation et des symboles, en caractères ou par leur nom : hamflathand hamextfingeru hampalml",
    ),
    (
        "the line holds no HamNoSys; it was left out",
        "la ligne ne contient pas de HamNoSys ; elle a été laissée de côté",
    ),
    (
        "write the gloss, a tab, and HamNoSys",
        "écrivez la glose, une tabulation, et du HamNoSys",
    ),
    (
        "HamNoSys had been saved as UTF-8 and read as Latin-1 or Windows-1252; its symbols were mended",
        "le HamNoSys avait été enregistré en UTF-8 et lu en Latin-1 ou Windows-1252 ; ses symboles ont été réparés",
    ),
    (
        "nothing needs to be done; a new export of the source as UTF-8 would be clean",
        "rien à faire ; une nouvelle exportation de la source en UTF-8 serait propre",
    ),
    (
        "call a column \"gloss\", or name it in a mapping: {mapping}",
        "appelez une colonne \"gloss\", ou nommez-la dans une correspondance : {mapping}",
    ),
    (
        "the column {name} is there twice; the first counts",
        "la colonne {name} est là deux fois ; la première compte",
    ),
    (
        "the column {name} is there twice",
        "la colonne {name} est là deux fois",
    ),
    (
        "the column {name} is not used",
        "la colonne {name} n’est pas utilisée",
    ),
    (
        "the row has no {what}; it was left out",
        "la ligne n’a pas de {what} ; elle a été laissée de côté",
    ),
    (
        "rows without {title} that {other} names: {n}",
        "lignes sans {title} que nomme {other} : {n}",
    ),
    (
        "cells of {title} that name handshapes, such as {cell}, were taken for these: {n}",
        "cases de {title} qui nomment des configurations, comme {cell}, prises pour celles-ci : {n}",
    ),
    (
        "search for them as {query}, and for the others as {other}",
        "cherchez-les par {query}, et les autres par {other}",
    ),
    (
        "the first row holds HamNoSys: it was taken for a sign, not for titles",
        "la première ligne contient du HamNoSys : elle a été prise pour un signe, pas pour des titres",
    ),
    (
        "the titles of the columns are in line {line}; the text above them was left out: {text}",
        "les titres des colonnes sont à la ligne {line} ; le texte au-dessus a été laissé de côté : {text}",
    ),
    (
        "values that programs write for an empty cell were taken as unset: {values}",
        "des valeurs que des programmes écrivent pour une case vide ont été prises pour non renseignées : {values}",
    ),
    (
        "if one of them is a value of the component, write it in another spelling in the table",
        "si l’une d’elles est une valeur de la composante, écrivez-la autrement dans la table",
    ),
    (
        "of the columns beside HamNoSys, number {n} after it was taken for the gloss: {gloss}; the others were left out",
        "des colonnes autour de HamNoSys, la colonne {n} après lui a été prise pour la glose : {gloss} ; les autres ont été laissées de côté",
    ),
    (
        "the text after HamNoSys was left out: {text}",
        "le texte après HamNoSys a été laissé de côté : {text}",
    ),
    (
        "of the columns before HamNoSys, number {n} was taken for the gloss: {gloss}; the others were left out",
        "des colonnes avant le HamNoSys, la {n} a été prise pour la glose : {gloss} ; les autres ont été laissées de côté",
    ),
    (
        "if another one is the gloss, leave out the others, or save the file as a table with titles: .tsv",
        "si une autre est la glose, enlevez les autres, ou enregistrez le fichier comme table avec des titres : .tsv",
    ),
    (
        "write titles above the columns: gloss, hamnosys",
        "écrivez des titres au-dessus des colonnes : gloss, hamnosys",
    ),
    (
        "{name}: {value} ({n}) and {other} ({more}) are kept as two values",
        "{name} : {value} ({n}) et {other} ({more}) sont gardées comme deux valeurs",
    ),
    (
        "the mapping is not JSON: {why}",
        "la correspondance n’est pas du JSON : {why}",
    ),
    (
        "this is not text; save the subtitles as text in UTF-8",
        "ce n’est pas du texte ; enregistrez les sous-titres en texte UTF-8",
    ),
    (
        "no line holds times such as 00:00:01,000 --> 00:00:02,500",
        "aucune ligne ne contient de temps comme 00:00:01,000 --> 00:00:02,500",
    ),
    (
        "the block {text} was left out",
        "le bloc {text} a été laissé de côté",
    ),
    (
        "{text} are no times; the cue was left out",
        "{text} ne sont pas des temps ; le sous-titre a été laissé de côté",
    ),
    (
        "the text {text} stands after a blank line; it was added to the cue before it",
        "le texte {text} se trouve après une ligne vide ; il a été ajouté au sous-titre qui précède",
    ),
    (
        "the line {text} belongs to no cue and was left out",
        "la ligne {text} n’appartient à aucun sous-titre et a été laissée de côté",
    ),
    (
        "write it below the times of its cue, with no blank line before it",
        "écrivez-la sous les temps de son sous-titre, sans ligne vide devant elle",
    ),
    (
        "the position of the cue was left out",
        "la position du sous-titre a été laissée de côté",
    ),
    (
        "an empty cue was left out",
        "un sous-titre vide a été laissé de côté",
    ),
    (
        "the cue {text} ends after the next begins; it ends at {time} now",
        "le sous-titre {text} finit après le début du suivant ; il finit maintenant à {time}",
    ),
    (
        "the annotation {text} ends after the next begins; it ends at {time} now",
        "l’annotation {text} finit après le début de la suivante ; elle finit maintenant à {time}",
    ),
    (
        "{n} annotations begin together with the next one and were left out",
        "annotations qui commencent avec la suivante, laissées de côté : {n}",
    ),
    (
        "a row has the participant {other}, its tier {first}, which was kept",
        "une ligne a pour participant {other}, son tier {first}, qui a été gardé",
    ),
    (
        "a row was left out: {why}",
        "une ligne a été laissée de côté : {why}",
    ),
    (
        "{n} cues begin together with the next one and were left out",
        "sous-titres qui commencent avec le suivant, laissés de côté : {n}",
    ),
    (
        "the table has no titles; it was read as ELAN exports it: tier, begin, end, annotation",
        "la table n’a pas de titres ; elle a été lue comme ELAN l’exporte : acteur, début, fin, annotation",
    ),
    (
        "name the columns recording, tier, start, end, value, action, id",
        "appelez les colonnes recording, tier, start, end, value, action, id",
    ),
    (
        "the duration {length} from {start} is too long",
        "la durée {length} à partir de {start} est trop longue",
    ),
    (
        "the end {end} is not after the start {start}",
        "la fin {end} n’est pas après le début {start}",
    ),
    (
        "an added annotation needs a tier",
        "une annotation ajoutée demande un acteur",
    ),
    (
        "an added annotation needs a start, or a parent on a symbolic tier",
        "une annotation ajoutée demande un début, ou un parent sur un acteur symbolique",
    ),
    (
        "an added annotation needs an end",
        "une annotation ajoutée demande une fin",
    ),
    (
        "{text} is no action: add, remove or set",
        "{text} n’est pas une action : add, remove ou set",
    ),
    (
        "{text} is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12",
        "{text} n’est pas un temps : écrivez 1.5, 1.5s, 1500ms, 0:01.500 ou f12",
    ),
    (
        "{text} is no unit of time: write s, ms or frames",
        "{text} n’est pas une unité de temps : écrivez s, ms ou frames",
    ),
    (
        "the table is empty; its first row should name the columns",
        "la table est vide ; sa première ligne doit nommer les colonnes",
    ),
    (
        "this is not a table of text; save it as CSV or TSV in UTF-8",
        "ce n’est pas une table de texte ; enregistrez-la en CSV ou TSV, en UTF-8",
    ),
    ("no object begins here", "ici ne commence aucun objet"),
    (
        "write an object with a gloss on each line, or one array of such objects",
        "écrivez un objet avec une glose par ligne, ou un seul tableau de tels objets",
    ),
    (
        "the first row has {n} columns, more than {most}",
        "la première ligne a {n} colonnes, plus de {most}",
    ),
    (
        "the table has more than {rows} rows or {cells} cells up to here; divide it into several files",
        "le tableau a plus de {rows} lignes ou {cells} cellules jusqu’ici ; répartissez-le en plusieurs fichiers",
    ),
    (
        "the cell of column {n} has {bytes} bytes, and a value has at most {longest}; look for a quotation mark that is not closed",
        "la cellule de la colonne {n} a {bytes} octets, et une valeur en a au plus {longest} ; cherchez un guillemet qui n’est pas fermé",
    ),
    (
        "the rows up to here lack {lacking} cells of the first row's {n} columns; write one row of titles that fits the others",
        "il manque jusqu’ici {lacking} cases aux {n} colonnes de la première ligne ; écrivez une ligne de titres qui va avec les autres",
    ),
    (
        "from {start} to {end} without a unit would be seconds, and no annotation is so long or so late; if these are milliseconds, call the columns start_ms and end_ms, else start_s and end_s",
        "de {start} à {end} sans unité serait en secondes, et aucune annotation n’est si longue ni si tardive ; si ce sont des millisecondes, appelez les colonnes start_ms et end_ms, sinon start_s et end_s",
    ),
    (
        "no column of the first row ({found}) is {needed}; {remedy}",
        "aucune colonne de la première ligne ({found}) n’est {needed} ; {remedy}",
    ),
    (
        "the row has {n} cells and the first row {all}; the rest was taken as empty",
        "la ligne a {n} cases et la première {all} ; le reste a été pris comme vide",
    ),
    (
        "the row has {n} cells and the first row {all}; the rest was left out",
        "la ligne a {n} cases et la première {all} ; le reste a été laissé de côté",
    ),
    (
        "put texts that hold the delimiter in quotes, or name the further columns",
        "mettez entre guillemets les textes qui contiennent le séparateur, ou nommez les autres colonnes",
    ),
    (
        "the quotation marks around {text} were left out: a spreadsheet writes them",
        "les guillemets autour de {text} ont été laissés de côté : un tableur les écrit",
    ),
    (
        "the quotation mark before {text} closes nowhere at the end of a cell; it was taken as text",
        "le guillemet devant {text} n’est fermé à la fin d’aucune case ; il a été pris comme texte",
    ),
    (
        "a cell of this row has more than {n} lines",
        "une case de cette ligne a plus de {n} lignes",
    ),
    (
        "look for a quotation mark that is not closed",
        "cherchez un guillemet qui n’est pas fermé",
    ),
    ("the text is in UTF-16", "le texte est en UTF-16"),
    (
        "the text is not UTF-8; it was read as Windows-1252, so accents may be wrong",
        "le texte n’est pas en UTF-8 ; il a été lu en Windows-1252, des accents peuvent être faux",
    ),
    ("save it as UTF-8", "enregistrez-le en UTF-8"),
    (
        "{text} on {name} lasts from {start} to {end} s; it was left out",
        "{text} sur {name} dure de {start} à {end} s ; elle a été laissée de côté",
    ),
    (
        "correct its times in Praat",
        "corrigez ses temps dans Praat",
    ),
    (
        "{text} on {name} ends after the next interval begins; it ends at {time} now",
        "{text} sur {name} finit après le début de l’intervalle suivant ; elle finit maintenant à {time}",
    ),
    (
        "a TextGrid has no hierarchy; tiers below others stand next to them",
        "un TextGrid n’a pas de hiérarchie ; les acteurs sous d’autres sont à côté d’eux",
    ),
    (
        "{text} at {time} on {name} overlaps others; a TextGrid has no room for it",
        "{text} à {time} sur {name} en chevauche d’autres ; un TextGrid n’a pas de place pour elle",
    ),
    (
        "this is not text; save it in Praat as a text file",
        "ce n’est pas du texte ; enregistrez-le dans Praat comme fichier texte",
    ),
    (
        "this holds a {class}, not a TextGrid; choose Save as text file for a TextGrid in Praat",
        "ceci contient un {class}, et non un TextGrid ; choisissez dans Praat « Save as text file » pour un TextGrid",
    ),
    (
        "this does not begin as a TextGrid does: File type = \"ooTextFile\", Object class = \"TextGrid\"",
        "ceci ne commence pas comme un TextGrid : File type = \"ooTextFile\", Object class = \"TextGrid\"",
    ),
    (
        "{what} belongs here; the file is cut short or damaged",
        "il faut ici {what} ; le fichier est tronqué ou abîmé",
    ),
    (
        "values follow after the last tier; they were left out",
        "des valeurs suivent le dernier acteur ; elles ont été laissées de côté",
    ),
    (
        "the root element is a sign; <sigml> is missing around it",
        "l’élément racine est un signe ; il manque <sigml> autour",
    ),
    (
        "there is no sign in the document",
        "il n’y a pas de signe dans le document",
    ),
    (
        "<{element}> was read as a wrapper around the signs in it",
        "<{element}> a été lu comme une enveloppe autour de ses signes",
    ),
    (
        "<{element}> was read as {what}",
        "<{element}> a été lu comme {what}",
    ),
    (
        "<{element}> is no notated sign; it was left out",
        "<{element}> n’est pas un signe noté ; laissé de côté",
    ),
    ("<{element}> has no gloss", "<{element}> n’a pas de glose"),
    (
        "<{element}> says nothing of the hands",
        "<{element}> ne dit rien des mains",
    ),
    (
        "<{element}> has no place in <{parent}>; it was left out",
        "<{element}> n’a pas de place dans <{parent}> ; laissé de côté",
    ),
    (
        "<{element}> has no attribute {what}; it was left out",
        "<{element}> n’a pas d’attribut {what} ; laissé de côté",
    ),
    (
        "<{element}> names no part of the body; it was left out",
        "<{element}> ne nomme aucune partie du corps ; laissé de côté",
    ),
    (
        "<{element}> stands after a motion; it was read as part of the posture the sign begins with",
        "<{element}> suit un mouvement ; lu comme une partie de la posture initiale du signe",
    ),
    (
        "<{element}> stands outside <tgt_motion>; it changes nothing",
        "<{element}> est hors de <tgt_motion> ; cela ne change rien",
    ),
    (
        "<{element}> stands twice; the second follows the first",
        "<{element}> est là deux fois ; le second suit le premier",
    ),
    (
        "<{element}> has no {name}; it was left out",
        "<{element}> n’a pas de {name} ; laissé de côté",
    ),
    (
        "<{element}> is layout; it was left out",
        "<{element}> est de la mise en page ; laissé de côté",
    ),
    (
        "<{element}> is not a symbol of HamNoSys; it was left out",
        "<{element}> n’est pas un symbole HamNoSys ; laissé de côté",
    ),
    (
        "<{element}> holds no motion; nothing moves",
        "<{element}> ne contient pas de mouvement ; rien ne bouge",
    ),
    (
        "<{element}> has no motion that can be read; nothing moves",
        "<{element}> n’a pas de mouvement lisible ; rien ne bouge",
    ),
    (
        "<{element}> holds more than two motions; the others were left out",
        "<{element}> contient plus de deux mouvements ; les autres ont été laissés de côté",
    ),
    (
        "<{element}> holds fewer than two halves; they belong to the dominant hand",
        "<{element}> contient moins de deux moitiés ; elles sont à la main dominante",
    ),
    (
        "<{element}> says what another in <{parent}> said before; the last one counts",
        "<{element}> dit ce qu’un autre dans <{parent}> a déjà dit ; le dernier compte",
    ),
    (
        "<tgt_motion> says no posture that it ends in",
        "<tgt_motion> ne dit pas la posture où il finit",
    ),
    (
        "the value of an attribute holds a reference to nothing known; it was kept as it is written",
        "la valeur d’un attribut renvoie à quelque chose d’inconnu ; gardée comme elle est écrite",
    ),
    (
        "</{element}> closes nothing; take it away",
        "</{element}> ne ferme rien ; ôtez-le",
    ),
    (
        "<{element}> is a second root element; put all signs into one <sigml>",
        "<{element}> est un deuxième élément racine ; mettez tous les signes dans un <sigml>",
    ),
    (
        "a document type is named; it is not fetched, and not kept",
        "un type de document est nommé ; il n’est ni cherché ni gardé",
    ),
    (
        "there is text after the end; it was left out",
        "il y a du texte après la fin ; laissé de côté",
    ),
    (
        "there is text in <{element}>: {text}; it was left out",
        "il y a du texte dans <{element}> : {text} ; laissé de côté",
    ),
    (
        "SiGML says everything in attributes",
        "SiGML dit tout dans des attributs",
    ),
    ("put them into <seq_motion>", "mettez-les dans <seq_motion>"),
    (
        "write the posture first, or put a target into <tgt_motion>",
        "écrivez d’abord la posture, ou mettez une cible dans <tgt_motion>",
    ),
    (
        "write one <changeposture> for each finger, if their order matters",
        "écrivez un <changeposture> par doigt, si leur ordre compte",
    ),
    (
        "begin it with <handconfig bodypart=\"shoulders\"/> or another part",
        "commencez-le par <handconfig bodypart=\"shoulders\"/> ou une autre partie",
    ),
    (
        "{symbol} is kept in the text but is not part of the hands' movement",
        "{symbol} reste dans le texte mais ne fait pas partie du mouvement des mains",
    ),
    (
        "only the first of the alternatives is in the tree",
        "seule la première des possibilités est dans l’arbre",
    ),
    (
        "write another sign for each other alternative",
        "écrivez un autre signe pour chaque autre possibilité",
    ),
    (
        "the alternatives are not closed",
        "les possibilités ne sont pas fermées",
    ),
    ("close them with hamaltend", "fermez-les avec hamaltend"),
    ("the mark is there twice", "la marque y est deux fois"),
    ("the digit is there twice", "le doigt y est deux fois"),
    ("write it once", "écrivez-la une fois"),
    ("write one, or hambetween", "écrivez-en une, ou hambetween"),
    (
        "fingers that change one after the other are not in the tree",
        "des doigts qui changent l’un après l’autre ne sont pas dans l’arbre",
    ),
    (
        "write one hamreplace for each finger, if their order matters",
        "écrivez un hamreplace par doigt, si leur ordre compte",
    ),
    (
        "another sign begins without hamplus before it",
        "un autre signe commence sans hamplus devant lui",
    ),
    (
        "write hamplus between the parts of a compound, or hamreplace before a new handshape",
        "écrivez hamplus entre les parties d’un composé, ou hamreplace devant une nouvelle configuration",
    ),
    (
        "a configuration without hamreplace before it",
        "une configuration sans hamreplace devant elle",
    ),
    (
        "write hamreplace before what changes",
        "écrivez hamreplace devant ce qui change",
    ),
    (
        "write one movement with its size",
        "écrivez un mouvement avec sa taille",
    ),
    ("write the contact alone", "écrivez le contact seul"),
    ("write the place itself", "écrivez l’emplacement lui-même"),
    (
        "write the part of the hand that is in contact",
        "écrivez la partie de la main qui est en contact",
    ),
    (
        "line {n}, column {column}: {what}",
        "ligne {n}, colonne {column} : {what}",
    ),
    ("line {n}: {what}", "ligne {n} : {what}"),
];
