//! French forms of messages about files of movement and markers, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const READING: &[(&str, &str)] = &[
    (
        "the file can't be read on: {why}",
        "le fichier ne se lit plus : {why}",
    ),
    ("the file is empty", "le fichier est vide"),
    ("the text is UTF-16", "le texte est en UTF-16"),
    ("this is not text", "ce n’est pas du texte"),
    (
        "the file begins with {found}, not with HIERARCHY",
        "le fichier commence par {found}, et non par HIERARCHY",
    ),
    (
        "found {found} where {expected} belongs",
        "{found} se trouve là où il fallait {expected}",
    ),
    (
        "the brace that joint {joint} opened on line {n} is not closed before {before}",
        "l’accolade que l’articulation {joint} ouvre à la ligne {n} n’est pas fermée avant {before}",
    ),
    ("the end of the file", "la fin du fichier"),
    ("a second ROOT", "un deuxième ROOT"),
    (
        "the channel {channel} of joint {joint} is unknown",
        "le canal {channel} de l’articulation {joint} est inconnu",
    ),
    (
        "joints are nested more than {n} deep",
        "il y a plus de {n} articulations l’une sous l’autre",
    ),
    (
        "a word of more than {n} bytes",
        "un mot de plus de {n} octets",
    ),
    (
        "column {n} ({channel} of joint {joint}): {found} is not a finite number",
        "colonne {n} ({channel} de l’articulation {joint}) : {found} n’est pas un nombre fini",
    ),
    (
        "column {n} ({channel} of joint {joint}): {found} has a decimal comma",
        "colonne {n} ({channel} de l’articulation {joint}) : {found} a une virgule décimale",
    ),
    (
        "column {n} ({channel} of joint {joint}): {found} is larger than any number a program can hold",
        "colonne {n} ({channel} de l’articulation {joint}) : {found} dépasse tout nombre qu’un programme peut retenir",
    ),
    (
        "column {n} ({channel} of joint {joint}): {found} is not a number",
        "colonne {n} ({channel} de l’articulation {joint}) : {found} n’est pas un nombre",
    ),
    (
        "the row has {n} numbers, but the hierarchy has {all} channels",
        "la ligne a {n} nombres, mais la hiérarchie a {all} canaux",
    ),
    ("the frame time is {text}", "la durée d’image est {text}"),
    ("there is no frame time", "il n’y a pas de durée d’image"),
    (
        "check the disk and the permissions, and try again",
        "vérifiez le disque et les droits, et réessayez",
    ),
    (
        "export the recording again",
        "exportez de nouveau l’enregistrement",
    ),
    (
        "save the file as UTF-8 with a text editor",
        "enregistrez le fichier en UTF-8 avec un éditeur de texte",
    ),
    (
        "a BVH file is text that begins with the line HIERARCHY",
        "un fichier BVH est un texte qui commence par la ligne HIERARCHY",
    ),
    (
        "compare the lines around it with another joint of the file",
        "comparez les lignes autour avec une autre articulation du fichier",
    ),
    (
        "add the missing \"}\", or export again if the file was cut off",
        "ajoutez le \"}\" qui manque, ou exportez de nouveau si le fichier a été tronqué",
    ),
    (
        "split the file: one skeleton with one ROOT each",
        "divisez le fichier : un squelette avec un ROOT dans chacun",
    ),
    (
        "channels are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation (Xscale, Yscale, Zscale)",
        "les canaux sont Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation (Xscale, Yscale, Zscale)",
    ),
    (
        "a file of this shape is taken for damage; export it again with fewer joints or digits",
        "un fichier de cette forme passe pour abîmé ; exportez-le de nouveau avec moins d’articulations ou de chiffres",
    ),
    (
        "the file is damaged here; export it again",
        "le fichier est abîmé ici ; exportez-le de nouveau",
    ),
    (
        "each row holds one number per channel; correct the row or the CHANNELS lines",
        "chaque ligne contient un nombre par canal ; corrigez la ligne ou les lignes CHANNELS",
    ),
    (
        "give the seconds per frame in the header, such as \"Frame Time: 0.0083333\" for 120 Hz",
        "donnez dans l’en-tête les secondes par image, comme \"Frame Time: 0.0083333\" pour 120 Hz",
    ),
    (
        "the exporter could not compute it; fill the gap in the capture software and export again",
        "le programme d’exportation n’a pas pu le calculer ; comblez le trou dans le logiciel de capture et exportez de nouveau",
    ),
    (
        "export with decimal points (set the system's number format to English)",
        "exportez avec des points décimaux (mettez en anglais le format des nombres du système)",
    ),
    (
        "a number such as -12.345 or 1.2e-3 belongs here",
        "il faut ici un nombre comme -12.345 ou 1.2e-3",
    ),
    (
        "the file begins with a byte-order mark; skipped",
        "le fichier commence par une marque d’ordre des octets ; ignorée",
    ),
    (
        "lines end with CR alone, as on old Macs",
        "les lignes finissent par CR seul, comme sur les anciens Mac",
    ),
    (
        "the line HIERARCHY is missing; the file begins with ROOT",
        "il manque la ligne HIERARCHY ; le fichier commence par ROOT",
    ),
    (
        "the keyword {word} has an unusual spelling",
        "le mot-clé {word} a une graphie inhabituelle",
    ),
    (
        "the brace of joint {joint} stands on the line of the name",
        "l’accolade de l’articulation {joint} est sur la ligne du nom",
    ),
    ("a joint has no name", "une articulation n’a pas de nom"),
    (
        "name it in the capture software; unnamed joints can't be found by name",
        "nommez-la dans le logiciel de capture ; une articulation sans nom ne se trouve pas par son nom",
    ),
    (
        "the joint name {name} is not UTF-8; read as Latin-1",
        "le nom d’articulation {name} n’est pas en UTF-8 ; lu en Latin-1",
    ),
    ("save the file as UTF-8", "enregistrez le fichier en UTF-8"),
    (
        "two joints are called {name}; only their positions distinguish them",
        "deux articulations s’appellent {name} ; seules leurs positions les distinguent",
    ),
    ("rename one of them", "renommez l’une d’elles"),
    (
        "the OFFSET of joint {joint} goes over several lines",
        "l’OFFSET de l’articulation {joint} est sur plusieurs lignes",
    ),
    (
        "joint {joint} has no OFFSET; taken as 0 0 0",
        "l’articulation {joint} n’a pas d’OFFSET ; pris pour 0 0 0",
    ),
    (
        "correct the number after CHANNELS",
        "corrigez le nombre après CHANNELS",
    ),
    ("check the CHANNELS line", "vérifiez la ligne CHANNELS"),
    (
        "joint {joint} has scale channels; kept, but no scale is shown",
        "l’articulation {joint} a des canaux d’échelle ; gardés, mais aucune échelle n’est montrée",
    ),
    (
        "joint {joint} below the root has position channels",
        "l’articulation {joint}, sous la racine, a des canaux de position",
    ),
    (
        "joint {joint} has no channels and never moves by itself",
        "l’articulation {joint} n’a pas de canaux et ne bouge jamais d’elle-même",
    ),
    (
        "joint {joint} has an End Site beside children; both kept",
        "l’articulation {joint} a un End Site à côté d’enfants ; les deux sont gardés",
    ),
    (
        "joint {joint} has several End Sites; all kept",
        "l’articulation {joint} a plusieurs End Sites ; tous gardés",
    ),
    (
        "an End Site has the name {name}; dropped",
        "un End Site porte le nom {name} ; ignoré",
    ),
    (
        "there is no MOTION section: a skeleton without movement",
        "il n’y a pas de section MOTION : un squelette sans mouvement",
    ),
    (
        "the line \"Frames:\" is missing; rows are counted instead",
        "il manque la ligne \"Frames:\" ; les lignes sont comptées à la place",
    ),
    (
        "the frame count {n} is no count; rows are counted instead",
        "le nombre d’images {n} n’en est pas un ; les lignes sont comptées à la place",
    ),
    (
        "correct the line \"Frames:\"",
        "corrigez la ligne \"Frames:\"",
    ),
    (
        "the header says {declared} frames, but there are {n}; the rows count",
        "l’en-tête dit {declared} images, mais il y en a {n} ; ce sont les lignes qui comptent",
    ),
    (
        "check that the recording is whole",
        "vérifiez que l’enregistrement est entier",
    ),
    (
        "there are no frames: a skeleton without movement",
        "il n’y a pas d’images : un squelette sans mouvement",
    ),
    (
        "the header line {line} has unusual blanks",
        "la ligne d’en-tête {line} a des espaces inhabituelles",
    ),
    (
        "there is no frame time above 0 ({found}); with one frame at most, none is needed",
        "il n’y a pas de durée d’image au-dessus de 0 ({found}) ; avec une image au plus, il n’en faut pas",
    ),
    (
        "a frame lasts {seconds} seconds",
        "une image dure {seconds} secondes",
    ),
    (
        "if frames per second are meant, write 1 divided by that, such as \"Frame Time: 0.0333333\" for 30",
        "s’il s’agit d’images par seconde, écrivez 1 divisé par ce nombre, comme \"Frame Time: 0.0333333\" pour 30",
    ),
    (
        "several frames stand on one line; split by the number of channels",
        "plusieurs images sont sur une ligne ; divisées d’après le nombre de canaux",
    ),
    (
        "the last row breaks off: {n} numbers of {all}; dropped",
        "la dernière ligne s’interrompt : {n} nombres sur {all} ; ignorée",
    ),
    (
        "the file was cut off; export it again",
        "le fichier a été tronqué ; exportez-le de nouveau",
    ),
    (
        "text follows the motion, beginning with {text}; ignored",
        "du texte suit le mouvement, à partir de {text} ; ignoré",
    ),
    (
        "the root's columns hold rotation before position, though CHANNELS says the reverse: {why}",
        "les colonnes de la racine ont la rotation avant la position, alors que CHANNELS dit l’inverse : {why}",
    ),
    (
        "read the root's rotation before its position (root channel fix \"rotation-before-position\")",
        "lisez la rotation de la racine avant sa position (correction \"rotation-before-position\")",
    ),
    (
        "columns 4 to 6 stay at the root's OFFSET",
        "les colonnes 4 à 6 restent à l’OFFSET de la racine",
    ),
    (
        "the file can't be written: {why}",
        "le fichier ne s’écrit pas : {why}",
    ),
    (
        "the joint name {name} has braces, line ends or blanks at its ends, which BVH can't hold; rename the joint",
        "le nom d’articulation {name} a des accolades, des fins de ligne ou des espaces aux bouts, ce que BVH n’admet pas ; renommez l’articulation",
    ),
    (
        "the file promises {n} frames and holds {found}",
        "le fichier annonce {n} images et en contient {found}",
    ),
    (
        "the file states {n} frames, and its data has room for {more} more, which are left out",
        "images annoncées par le fichier : {n} ; ses données ont de la place pour {more} autres, qui sont laissées de côté",
    ),
    (
        "correct the number of the last frame in the file's header if they are frames",
        "corrigez le numéro de la dernière image dans l’en-tête du fichier si ce sont des images",
    ),
    (
        "the header states {other} frames a second and POINT:RATE {n}, which are taken",
        "l’en-tête annonce {other} images par seconde et POINT:RATE {n}, qui sont prises",
    ),
    (
        "POINT:Y_SCREEN says that {axis} is up, and the markers of head and feet show {shown}, which is taken",
        "POINT:Y_SCREEN dit que {axis} est vers le haut, et les marqueurs de tête et de pieds montrent {shown}, qui est pris",
    ),
    (
        "it begins with frame {n} of its capture; that is {time} s here",
        "il commence à l’image {n} de sa capture ; c’est {time} s ici",
    ),
    (
        "{n} places of {markers} markers are exactly 0 0 0 and become gaps, as some programs write gaps so: {names}",
        "positions de {markers} marqueurs exactement à 0 0 0, qui deviennent des trous, comme certains programmes les écrivent : {n} ; {names}",
    ),
    (
        "write gaps as empty cells, and a marker that is really there as 0.001",
        "écrivez les trous comme des cellules vides, et un marqueur qui est vraiment là comme 0.001",
    ),
    (
        "{n} places are exactly 0 0 0 though the file calls them seen; some programs write gaps so",
        "positions exactement à 0 0 0 que le fichier dit vues : {n} ; certains programmes écrivent ainsi les trous",
    ),
    (
        "the unit of points is {unit}; millimetres are assumed",
        "l’unité des points est {unit} ; le millimètre est supposé",
    ),
    (
        "analog channels without a scale",
        "canaux analogiques sans échelle",
    ),
    (
        "the analog channel {name} has no usable scale; its numbers are the file's own",
        "le canal analogique {name} n’a pas d’échelle utilisable ; ses nombres sont ceux du fichier",
    ),
    (
        "events outside the frames were left out: {n}",
        "événements hors des images, laissés de côté : {n}",
    ),
    (
        "this is no C3D file: its second byte is not 80",
        "ce n’est pas un fichier C3D : son deuxième octet n’est pas 80",
    ),
    (
        "processor type {n} is not known; save the file again as C3D for Intel processors",
        "le type de processeur {n} n’est pas connu ; enregistrez de nouveau le fichier en C3D pour processeurs Intel",
    ),
    (
        "the file ends within its {part}; it is cut short",
        "le fichier finit dans {part} ; il est tronqué",
    ),
    (
        "the frame rate is {n}, not a positive number",
        "la cadence est {n}, et non un nombre positif",
    ),
    (
        "the file holds neither points nor analog channels",
        "le fichier ne contient ni points ni canaux analogiques",
    ),
    (
        "C3D holds places in a room, and these are {what}",
        "un C3D contient des positions dans l’espace, et celles-ci sont {what}",
    ),
    (
        "C3D needs an even frame rate",
        "un C3D demande une cadence régulière",
    ),
    (
        "C3D files hold at most {n} points here, and these are {found}",
        "un fichier C3D contient ici au plus {n} points, et il y en a {found}",
    ),
    (
        "TRC holds places in a room, and these are {what}",
        "un TRC contient des positions dans l’espace, et celles-ci sont {what}",
    ),
    (
        "TRC has no unit of {n} m",
        "un TRC n’a pas d’unité de {n} m",
    ),
    (
        "this is no TRC file: its first line does not begin with PathFileType",
        "ce n’est pas un fichier TRC : sa première ligne ne commence pas par PathFileType",
    ),
    (
        "DataRate is {text}; write the number of frames a second there",
        "DataRate est {text} ; écrivez-y le nombre d’images par seconde",
    ),
    (
        "DataRate is {text}; the times of the rows show {rate}",
        "DataRate est {text} ; les temps des lignes montrent {rate}",
    ),
    (
        "the line of {what} is missing",
        "il manque la ligne de {what}",
    ),
    (
        "the row has {n} cells, and {markers} markers need {expected}",
        "la ligne a {n} cases, et {markers} marqueurs en demandent {expected}",
    ),
    (
        "the file holds no markers",
        "le fichier ne contient pas de marqueurs",
    ),
    (
        "the label {name} occurs again; it is {other} here",
        "l’étiquette {name} revient ; elle est {other} ici",
    ),
    (
        "a marker has no label; it is {name} here",
        "un marqueur n’a pas d’étiquette ; il est {name} ici",
    ),
    ("markers without a label", "marqueurs sans étiquette"),
    (
        "the numbers have decimal commas",
        "les nombres ont des virgules décimales",
    ),
    (
        "the last row has {n} cells and the row before {before}; the file may be cut short, and the last number of that row too",
        "cellules de la dernière ligne : {n}, de la précédente : {before} ; le fichier est peut-être tronqué, et le dernier nombre de cette ligne aussi",
    ),
    (
        "export the take again from the program that recorded it",
        "exportez de nouveau la prise depuis le programme qui l’a enregistrée",
    ),
    (
        "the times are milliseconds, as DataRate shows; they are read as such",
        "les temps sont des millisecondes, comme DataRate le montre ; ils sont lus ainsi",
    ),
    (
        "some rows have no time; the numbers of the frames and DataRate show it",
        "des lignes n’ont pas de temps ; les numéros des images et DataRate le montrent",
    ),
    (
        "{key} says {n}, and the file holds {found}",
        "{key} dit {n}, et le fichier contient {found}",
    ),
    (
        "some rows have no time; frames are taken to be even",
        "des lignes n’ont pas de temps ; les images sont prises comme régulières",
    ),
    (
        "the times do not follow DataRate; every frame has its own time",
        "les temps ne suivent pas DataRate ; chaque image a son propre temps",
    ),
    (
        "the unit is {unit}; millimetres are assumed",
        "l’unité est {unit} ; le millimètre est supposé",
    ),
    (
        "no markers of head and feet show which axis is up; {axis} is taken",
        "aucun marqueur de tête et de pieds ne montre l’axe vertical ; {axis} est pris",
    ),
    (
        "no pair of markers such as LSHO and RSHO shows which side is left; the first axis that fits is taken",
        "aucune paire de marqueurs comme LSHO et RSHO ne montre le côté gauche ; le premier axe possible est pris",
    ),
    (
        "say the axes with --axes, such as --axes +Z,+X: up, and the signer's left",
        "donnez les axes avec --axes, comme --axes +Z,+X : le haut, et la gauche du signeur",
    ),
];
