//! French forms of import findings and remedies, looked up by their English form like the messages.

/// Findings and remedies in English and French; a form that is contained in another comes after it.
pub(super) const FINDINGS: &[(&str, &str)] = &[
    (
        "the file does not state the rate of the film; {n} frames a second are taken",
        "le fichier ne dit pas la cadence du film ; {n} images par seconde sont prises",
    ),
    (
        "the file states {rate}; the rate that was asked for is taken: {taken}",
        "le fichier indique {rate} ; la cadence demandée est prise : {taken}",
    ),
    (
        "the file states {rate}, which stays: only points from film take another rate",
        "le fichier indique {rate}, qui reste : seuls les points d’un film prennent une autre cadence",
    ),
    (
        "it was imported before, and its points keep their unit and axes",
        "il a été importé auparavant, et ses points gardent leur unité et leurs axes",
    ),
    (
        "undo the earlier import, and import it again with --unit and --axes",
        "annulez l’importation précédente, et importez-le de nouveau avec --unit et --axes",
    ),
    (
        "it was imported before with {rate}, and its points keep that rate",
        "il a été importé auparavant avec {rate}, et ses points gardent cette cadence",
    ),
    (
        "undo the earlier import, and import it again with --rate, such as --rate 50",
        "annulez l’importation précédente, et importez-le de nouveau avec --rate, comme --rate 50",
    ),
    (
        "import it with --rate, such as --rate 50 or --rate 30000/1001",
        "importez-le avec --rate, comme --rate 50 ou --rate 30000/1001",
    ),
    (
        "the points are estimated from film; they have no depth",
        "les points sont estimés d’après un film ; ils n’ont pas de profondeur",
    ),
    (
        "the points are estimated from film",
        "les points sont estimés d’après un film",
    ),
    (
        "the size of the pictures is not stated; points reach {x} by {y} pixels",
        "la taille des images n’est pas dite ; les points vont jusqu’à {x} sur {y} pixels",
    ),
    (
        "by timecode it starts {time} from the start of the recording",
        "d’après le timecode, il commence à {time} du début de l’enregistrement",
    ),
    (
        "its timecodes are those of the recording {name}: it is taken for the same take",
        "ses timecodes sont ceux de l’enregistrement {name} : il est pris pour la même prise",
    ),
    (
        "its timecodes are those of several recordings: {names}",
        "ses timecodes sont ceux de plusieurs enregistrements : {names}",
    ),
    (
        "say which one it belongs to: import CORPUS FILE --into RECORDING",
        "dites auquel il appartient : import CORPUS FILE --into RECORDING",
    ),
    (
        "the recording {name} has its tiers now",
        "l’enregistrement {name} a maintenant ses acteurs",
    ),
    (
        "{n} recordings without tiers have its tiers now",
        "{n} enregistrements sans acteur ont maintenant les siens",
    ),
    (
        "a template of tiers, and no recording next to it is without tiers",
        "un modèle d’acteurs, et aucun enregistrement à côté n’est sans acteur",
    ),
    (
        "name the recording: import CORPUS FILE --into RECORDING",
        "nommez l’enregistrement : import CORPUS FILE --into RECORDING",
    ),
    (
        "settings of ELAN for an annotation file that is not there",
        "des réglages d’ELAN pour un fichier d’annotations absent",
    ),
    (
        "import the .eaf of the same name with it",
        "importez avec lui le .eaf du même nom",
    ),
    (
        "the ends of these finger bones point elsewhere than the fingers and are turned to them: {names}",
        "les extrémités de ces os des doigts pointent ailleurs que les doigts et sont tournées vers eux : {names}",
    ),
    (
        "the ends of these finger bones have no length, so that their fingertips are guessed: {names}",
        "les extrémités de ces os des doigts n’ont pas de longueur ; les bouts des doigts sont donc supposés : {names}",
    ),
    (
        "the ends of these finger bones are over twice as long as the rest of the hand suggests, and are drawn and measured at the usual length: {names}",
        "les extrémités de ces os des doigts sont plus de deux fois plus longues que le reste de la main ne le laisse attendre ; elles sont dessinées et mesurées à la longueur habituelle : {names}",
    ),
    (
        "the stored numbers stay those of the file; if the fingers are right and the rest is not, say the unit with --unit",
        "les nombres enregistrés restent ceux du fichier ; si les doigts sont justes et le reste ne l’est pas, donnez l’unité par --unit",
    ),
    (
        "no joint of the body turns in this take: its arms and hands stand still",
        "aucune articulation du corps ne tourne dans cette prise : les bras et les mains restent immobiles",
    ),
    (
        "export the take again with the movement of all joints, and import that file; nothing is proposed for this one",
        "exportez de nouveau la prise avec le mouvement de toutes les articulations, et importez ce fichier ; rien n’est proposé pour celui-ci",
    ),
    (
        "not found in the skeleton: {parts} and {n} more",
        "introuvables dans le squelette : {parts} et {n} autres",
    ),
    (
        "not found in the skeleton: {parts}",
        "introuvables dans le squelette : {parts}",
    ),
    (
        "if a joint is one of these, say so in a roles file (--roles)",
        "si une articulation en est une, dites-le dans un fichier de rôles (--roles)",
    ),
    (
        "{part} was taken to be {joint}; other joints could be it",
        "{part} : pris pour {joint} ; d’autres articulations pourraient l’être",
    ),
    (
        "no tier was recognised as one of glosses, so no tokens were made",
        "aucun acteur n’a été reconnu comme celui des gloses : pas d’occurrences",
    ),
    (
        "give tiers their roles in a mapping file (--map), or with `chereme annotate`",
        "donnez leurs rôles aux acteurs dans un fichier de correspondances (--map), ou avec `chereme annotate`",
    ),
    (
        "the file's unit of length cannot be inferred from its skeleton; one unit is taken for {n} m",
        "l’unité de longueur du fichier ne se déduit pas de son squelette ; une unité est prise pour {n} m",
    ),
    (
        "say the unit with --unit, such as --unit cm",
        "donnez l’unité avec --unit, comme --unit cm",
    ),
    (
        "the gloss {gloss} stands in line {n} too; this row is kept as another entry of that sign",
        "la glose {gloss} est aussi à la ligne {n} ; cette ligne est gardée comme une autre entrée de ce signe",
    ),
    (
        "if these are two signs, write {one} and {other}",
        "si ce sont deux signes, écrivez {one} et {other}",
    ),
    (
        "{n} empty intervals were left out; they are gaps now",
        "{n} intervalles vides ont été laissés de côté ; ce sont des trous maintenant",
    ),
    (
        "lines end with CR LF, as on Windows",
        "les lignes finissent par CR LF, comme sous Windows",
    ),
    (
        "no part of the movement, and left out of measures and pictures: {list}",
        "ne fait pas partie du mouvement, et reste hors des mesures et des images : {list}",
    ),
    (
        "the movement was probably lost here: {list}; and {n} times more",
        "le mouvement a probablement été perdu ici : {list} ; et {n} fois encore",
    ),
    (
        "the movement was probably lost here: {list}",
        "le mouvement a probablement été perdu ici : {list}",
    ),
    (
        "what is read from these frames may be wrong: look at them, and keep signs clear of them, or mend the capture and import it again",
        "ce qui est lu de ces images peut être faux : regardez-les, et tenez-en les signes à l’écart, ou corrigez la capture et importez-la de nouveau",
    ),
    (
        "frames stand several times: the movement was recorded at about {n} frames a second",
        "des images sont là plusieurs fois : le mouvement a été enregistré à environ {n} images par seconde",
    ),
    (
        "a recipe cuts them off: {recipe}",
        "une recette les coupe : {recipe}",
    ),
    (
        "tier {n} is called {name}; here it is {other}",
        "l’acteur {n} s’appelle {name} ; ici c’est {other}",
    ),
    (
        "it holds settings or vocabularies of ELAN",
        "il contient des réglages ou des vocabulaires d’ELAN",
    ),
    (
        "import the .eaf next to it; this file goes with it",
        "importez le .eaf à côté ; ce fichier l’accompagne",
    ),
    (
        "the recording {name}, which came from {path}, has this file's name already: this one is called {other}",
        "l’enregistrement {name}, venu de {path}, a déjà le nom de ce fichier : celui-ci s’appelle {other}",
    ),
    (
        "joint {name} is a leaf without End Site; its length is unknown",
        "l’articulation {name} est une feuille sans End Site ; sa longueur est inconnue",
    ),
    (
        "import it with --mend-root to read it so; the stored numbers stay the file's",
        "importez-le avec --mend-root pour le lire ainsi ; les nombres enregistrés restent ceux du fichier",
    ),
    (
        "its timecodes count {n} frames a second",
        "ses codes temporels comptent {n} images par seconde",
    ),
    (
        "its first row has the time {time} s of the day; that is {start} s here",
        "sa première ligne porte l’heure {time} s du jour ; c’est {start} s ici",
    ),
    (
        "nothing about the {side} hand can be read from this movement, because these joints were not found: {parts}",
        "rien de la main {side} ne peut être lu dans ce mouvement, car ces articulations n’ont pas été trouvées : {parts}",
    ),
    (
        "the {side} hand has no joints of these digits, and a handshape read from it is a guess about them: {digits}",
        "la main {side} n’a pas d’articulations de ces doigts, et une configuration lue sur elle les devine : {digits}",
    ),
    (
        "the unit of length is uncertain; {unit} is assumed ({reason})",
        "l’unité de longueur est incertaine ; {unit} est supposé ({reason})",
    ),
    (
        "the columns {first} and {second} are both taken for {meaning}; signs have the values of both",
        "les colonnes {first} et {second} sont prises toutes deux pour {meaning} ; les signes ont les valeurs des deux",
    ),
    (
        "say in a mapping what each is: {mapping}",
        "dites dans une correspondance ce qu’est chacune : {mapping}",
    ),
    (
        "the times are frames, and a table states no rate; write them in seconds, or as hh:mm:ss.ms",
        "les temps sont des images, et une table n’indique pas de cadence ; écrivez-les en secondes, ou comme hh:mm:ss.ms",
    ),
    (
        "the shapes should be shares from 0 to 1 and reach {n}: they are read as percent",
        "les formes devraient être des parts de 0 à 1 et atteignent {n} : elles sont lues en pour cent",
    ),
    (
        "check them: if they are shares beyond 1, cut them to 1 and import the file again",
        "vérifiez-les : si ce sont des parts au-delà de 1, ramenez-les à 1 et réimportez le fichier",
    ),
    (
        "nothing needs to be done if they are",
        "rien n’est à faire si c’est bien le cas",
    ),
    (
        "the turns of the head are degrees and reach {n}: they were converted",
        "les rotations de la tête sont en degrés et atteignent {n} : elles ont été converties",
    ),
    (
        "the turns of the head reach {n}: they are read as degrees",
        "les rotations de la tête atteignent {n} : elles sont lues en degrés",
    ),
    (
        "the turns of the head reach {n}, too far for radians and little for degrees: they are read as radians",
        "les rotations de la tête atteignent {n}, trop pour des radians et peu pour des degrés : elles sont lues en radians",
    ),
    (
        "write the unit into the titles, such as HeadYaw [deg] or HeadYaw [rad]",
        "écrivez l’unité dans les titres, comme HeadYaw [deg] ou HeadYaw [rad]",
    ),
    (
        "the first column counts frames, whose rate is not stated; write it into its title, such as frame [30 fps]",
        "la première colonne compte des images, dont la cadence n’est pas indiquée ; écrivez-la dans son titre, comme frame [30 fps]",
    ),
    (
        "the frame {frame} has {n} weights for {names} names",
        "l’image {frame} a {n} poids pour {names} noms",
    ),
    (
        "no row could be read; {fault}",
        "aucune ligne n’a pu être lue ; {fault}",
    ),
    (
        "{text} is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12; the rate of hh:mm:ss:ff is not stated: export the times as hh:mm:ss.ms",
        "{text} n’est pas un temps : écrivez 1.5, 1.5s, 1500ms, 0:01.500 ou f12 ; la cadence de hh:mm:ss:ff n’est pas indiquée : exportez les temps en hh:mm:ss.ms",
    ),
    (
        "{text} is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12; write a point before the decimals",
        "{text} n’est pas un temps : écrivez 1.5, 1.5s, 1500ms, 0:01.500 ou f12 ; écrivez un point devant les décimales",
    ),
    (
        "no column is called a gloss; {column} was taken for it",
        "aucune colonne ne s’appelle glose ; {column} a été prise pour elle",
    ),
    (
        "call the column {name}, or say so in a mapping: {mapping}",
        "appelez la colonne {name}, ou dites-le dans une correspondance : {mapping}",
    ),
    (
        "{sign}: the components come near the notation, but leave out {what}",
        "{sign} : les composants s’approchent de la notation, mais laissent de côté {what}",
    ),
    (
        "<{element}> has an amount or speed, which is not in SiGML {version}; it was kept as a factor",
        "<{element}> a une quantité ou une vitesse, ce que SiGML {version} n’a pas ; gardée comme facteur",
    ),
    (
        "<{element}> belongs into <{tier}>; it was kept in <{other}>",
        "<{element}> a sa place dans <{tier}> ; gardé dans <{other}>",
    ),
    (
        "<{element}> should say {what} in {attribute}",
        "<{element}> devrait dire {what} dans {attribute}",
    ),
    (
        "<{element}>: SiGML {version} lists no {value}; it was kept as it is",
        "<{element}> : SiGML {version} ne connaît pas {value} ; gardé tel quel",
    ),
    (
        "<{element}> is not in SiGML {version}; it was kept as a factor",
        "<{element}> n’est pas dans SiGML {version} ; gardé comme facteur",
    ),
    ("mend or remove it", "corrigez-le ou retirez-le"),
    (
        "nothing is lost; leave it out to be rid of this finding",
        "rien n’est perdu ; retirez-le pour ne plus avoir cette remarque",
    ),
    (
        "{symbol}: the bend is there twice",
        "{symbol} : la flexion y est deux fois",
    ),
    (
        "{attribute} is not one of the eight directions; it was read as {value}",
        "{attribute} n’est aucune des huit directions ; lu comme {value}",
    ),
    (
        "queries find them, as in {query}; to take one for something else, say so in a mapping: {mapping}",
        "les requêtes les trouvent, comme {query} ; pour en prendre un pour autre chose, dites-le dans une correspondance : {mapping}",
    ),
    (
        "if they are one: chereme inventory CORPUS merge-value {values}",
        "si ce n’en est qu’une : chereme inventory CORPUS merge-value {values}",
    ),
    (
        "files that are read end in {endings}",
        "les fichiers qui sont lus finissent par {endings}",
    ),
    ("write one of {values}", "écrivez l’un de {values}"),
    (
        "signer: {now} (before: {then})",
        "signeur : {now} (avant : {then})",
    ),
    (
        "origin: {now} (before: {then})",
        "origine : {now} (avant : {then})",
    ),
    (
        "licence: {now} (before: {then})",
        "licence : {now} (avant : {then})",
    ),
    (
        "dominant hand of {name}: {now} (before: {then})",
        "main dominante de {name} : {now} (avant : {then})",
    ),
    (
        "its recording has no signer, so no signer has the dominant hand now",
        "son enregistrement n’a pas de signeur, donc aucun signeur n’a maintenant la main dominante",
    ),
    (
        "name the signer, too, with --signer",
        "nommez aussi le signeur, avec --signer",
    ),
    (
        "it is in the corpus already, so {option} has no effect",
        "il est déjà dans le corpus, donc {option} est sans effet",
    ),
    (
        "move its tracks with `chereme track`; or `chereme undo` its first import, and import it again",
        "déplacez ses pistes avec `chereme track` ; ou annulez son premier import avec `chereme undo`, et importez-le de nouveau",
    ),
    (
        "it was not read again: its recording has {n} skeletons from such files, and nothing shows which one is this file's",
        "il n’a pas été relu : son enregistrement a {n} squelettes de tels fichiers, et on ne sait pas lequel est le sien",
    ),
    (
        "to read it in another manner, import a copy of it under another name",
        "pour le lire d’une autre manière, importez-en une copie sous un autre nom",
    ),
    (
        "it was imported before: its movement was read again, as the options say",
        "il a été importé auparavant : son mouvement a été relu, comme les options le disent",
    ),
    (
        "unit of length: {now} m (before: {then} m)",
        "unité de longueur : {now} m (avant : {then} m)",
    ),
    (
        "axes up,left: {now} (before: {then})",
        "axes haut,gauche : {now} (avant : {then})",
    ),
    (
        "the parts of the body are those of the roles file",
        "les parties du corps sont celles du fichier de rôles",
    ),
    (
        "order of the root's columns: {now} (before: {then})",
        "ordre des colonnes de la racine : {now} (avant : {then})",
    ),
    (
        "factor for the root's positions: {now} (before: {then})",
        "facteur des positions de la racine : {now} (avant : {then})",
    ),
    (
        "annotations without text are not in the TextGrid, where an empty interval is a gap; an .eaf keeps them: {n}",
        "des annotations sans texte ne sont pas dans le TextGrid, où un intervalle vide est un trou ; un .eaf les garde : {n}",
    ),
    (
        "{text} at {time} on {name} overlaps others; in the TextGrid it starts at {start}",
        "{text} à {time} sur {name} en chevauche d’autres ; dans le TextGrid elle commence à {start}",
    ),
    (
        "it is a copy of a part of corpus.chereme, in the folder of an export",
        "c’est la copie d’une partie de corpus.chereme, dans le dossier d’une exportation",
    ),
    (
        "open the corpus.chereme of that folder, or merge it into yours: `chereme merge CORPUS OTHER`",
        "ouvrez le corpus.chereme de ce dossier, ou réunissez-le avec le vôtre : `chereme merge CORPUS AUTRE`",
    ),
];
