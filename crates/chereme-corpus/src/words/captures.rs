//! French forms of messages about faces, scenes and films that are read, bodies and pictures, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const CAPTURES: &[(&str, &str)] = &[
    (
        "the movement lasts {n} s, and at most {most} s can be drawn at once",
        "le mouvement dure {n} s, et on dessine au plus {most} s à la fois",
    ),
    (
        "name an annotation or a token of it, or store a part of it with a recipe: {recipe}",
        "nommez une annotation ou une occurrence de cet enregistrement, ou enregistrez-en une partie par une recette : {recipe}",
    ),
    (
        "the skeleton's own posture (bind pose)",
        "la posture propre du squelette (pose de liaison)",
    ),
    ("a T-pose", "une pose en T"),
    ("the body jumps {n} m", "le corps saute de {n} m"),
    (
        "the body turns by {n}° at once",
        "le corps tourne d’un coup de {n}°",
    ),
    ("a hand jumps {n} m", "une main saute de {n} m"),
    (
        "the body stands still, then jumps {n} cm",
        "le corps reste immobile, puis saute de {n} cm",
    ),
    (
        "the body jumps {n} cm to the rest pose",
        "le corps saute de {n} cm vers la pose de repos",
    ),
    (
        "the body jumps {n} cm away and returns",
        "le corps saute de {n} cm et revient",
    ),
    (
        "the {limb} arm stands still, then jumps {n} cm",
        "le bras {limb} reste immobile, puis saute de {n} cm",
    ),
    (
        "the {limb} arm jumps {n} cm to the rest pose",
        "le bras {limb} saute de {n} cm vers la pose de repos",
    ),
    (
        "the {limb} arm jumps {n} cm away and returns",
        "le bras {limb} saute de {n} cm et revient",
    ),
    (
        "the {side} fingers stand still, then jump {n} cm",
        "les doigts de la main {side} restent immobiles, puis sautent de {n} cm",
    ),
    (
        "the {side} fingers jump {n} cm to the rest pose",
        "les doigts de la main {side} sautent de {n} cm vers la pose de repos",
    ),
    (
        "the {side} fingers jump {n} cm away and return",
        "les doigts de la main {side} sautent de {n} cm et reviennent",
    ),
    (
        "frames {first} to {last}: {what}",
        "images {first} à {last} : {what}",
    ),
    ("frame {n}: {what}", "image {n} : {what}"),
    (
        "this is no table of channels: its first column is neither a timecode, a time nor a frame number",
        "ce n’est pas une table de canaux : sa première colonne n’est ni un timecode, ni un temps, ni un numéro d’image",
    ),
    (
        "the row has {n} cells, and the header has {expected}",
        "cases de la ligne : {n}, de l’en-tête : {expected}",
    ),
    (
        "the file holds no numbers",
        "le fichier ne contient pas de nombres",
    ),
    (
        "it holds the scores of one frame",
        "il contient les valeurs d’une seule image",
    ),
    (
        "it has more than {names} names of scores, or {scores} scores",
        "il a plus de {names} noms de valeurs, ou de {scores} valeurs",
    ),
    (
        "no frame holds categories with a categoryName and a score",
        "aucune image ne contient de catégories avec un categoryName et un score",
    ),
    (
        "its frames have no times; {n} a second are taken",
        "ses images n’ont pas de temps ; {n} par seconde sont prises",
    ),
    (
        "its timestamps are those of a series of pictures, at most 1 ms apart; {n} frames a second are taken",
        "ses horodatages sont ceux d’une suite d’images fixes, à 1 ms d’écart au plus ; {n} images par seconde sont prises",
    ),
    (
        "no step into the next second shows how many frames a second its timecodes count; {n} are taken",
        "aucun passage à la seconde suivante ne montre combien d’images par seconde ses timecodes comptent ; {n} sont prises",
    ),
    (
        "its timecodes leave out frames (drop frame), so {n} of them last 1.001 s",
        "ses timecodes sautent des images (drop frame), donc {n} d’entre elles durent 1,001 s",
    ),
    (
        "the decimals of its timecodes are those of the second, which the frames show already",
        "les décimales de ses timecodes sont celles de la seconde, que les images montrent déjà",
    ),
    (
        "rows without a face (BlendShapeCount is 0), whose numbers, if there are any, mean nothing: {n}",
        "lignes sans visage (BlendShapeCount vaut 0), dont les nombres, s’il y en a, ne veulent rien dire : {n}",
    ),
    (
        "its times are whole numbers some microseconds of a film apart; they are read as microseconds",
        "ses temps sont des nombres entiers, espacés comme les microsecondes d’un film ; ils sont lus comme des microsecondes",
    ),
    (
        "its times are whole numbers some milliseconds of a film apart; they are read as milliseconds",
        "ses temps sont des nombres entiers, espacés comme les millisecondes d’un film ; ils sont lus comme des millisecondes",
    ),
    (
        "write the unit into the title of that column, such as time [ms] or time [s]",
        "écrivez l’unité dans le titre de cette colonne, comme time [ms] ou time [s]",
    ),
    (
        "landmarks beside the scores are left out: {n} frames have them",
        "les points à côté des valeurs sont laissés de côté : {n} images en ont",
    ),
    (
        "write the landmarks into a file of their own, without scores",
        "écrivez les points dans un fichier à part, sans valeurs",
    ),
    (
        "the times of the frames are not even; every frame has its own time",
        "les temps des images ne sont pas réguliers ; chaque image a son propre temps",
    ),
    (
        "its first frame has the time {seconds} s; that is 0 s here",
        "sa première image a le temps {seconds} s ; c’est 0 s ici",
    ),
    (
        "it begins with frame {n} of its film; that is 0 s here",
        "il commence à l’image {n} de son film ; c’est 0 s ici",
    ),
    (
        "in row {row} a person is far from the last place of the person who is nearest, and may be another one",
        "à la ligne {row}, une personne est loin de la dernière position de la plus proche, et peut en être une autre",
    ),
    ("people who jump", "personnes qui sautent"),
    (
        "places are from -1 to 1 in the picture's width and height: angles between them need its proportions",
        "les positions vont de -1 à 1 dans la largeur et la hauteur de l’image : les angles entre elles demandent ses proportions",
    ),
    (
        "left and right hands are those that MediaPipe names; it takes the film for mirrored",
        "mains gauche et droite sont celles que MediaPipe nomme ; il prend le film pour un reflet",
    ),
    (
        "{key} does not state the sides of its hands; they are in the order of each frame, and may change places",
        "{key} ne dit pas les côtés de ses mains ; elles sont dans l’ordre de chaque image, et peuvent changer de place",
    ),
    ("hands without a side", "mains sans côté"),
    (
        "write \"handedness\" into each frame",
        "écrivez \"handedness\" dans chaque image",
    ),
    (
        "write the seconds of each row into the column \"timestamp\"",
        "écrivez les secondes de chaque ligne dans la colonne \"timestamp\"",
    ),
    (
        "gaps in its rows: {n}, {seconds} s in all, the longest after {at} s; nothing counts as measured there",
        "trous dans ses lignes : {n}, {seconds} s en tout, le plus long après {at} s ; rien n’y compte comme mesuré",
    ),
    (
        "export it again if the gaps are not in the recording itself",
        "exportez-le de nouveau si les trous ne sont pas dans l’enregistrement lui-même",
    ),
    (
        "write \"timestampMs\" into each frame",
        "écrivez \"timestampMs\" dans chaque image",
    ),
    (
        "the file ends within a packet; it is cut short",
        "le fichier finit dans un paquet ; il est tronqué",
    ),
    (
        "packet {n} is of version {version}; {known} is known",
        "le paquet {n} est de la version {version} ; {known} est connue",
    ),
    ("packet {n} has no time", "le paquet {n} n’a pas de temps"),
    (
        "its compressed bytes are damaged; what comes before the damage is read",
        "ses octets compressés sont abîmés ; ce qui précède est lu",
    ),
    (
        "the file holds more than 512 MB",
        "le fichier contient plus de 512 Mo",
    ),
    (
        "the file ends within packet {n} of {all}",
        "le fichier finit dans le paquet {n} sur {all}",
    ),
    (
        "packet {n} has {found} channels, and the first has {all}",
        "le paquet {n} a {found} canaux, et le premier {all}",
    ),
    (
        "joint {name} is too far away to be written in its rest pose",
        "l’articulation {name} est trop loin pour être écrite, dans sa pose de repos",
    ),
    (
        "joint {name} is too far away to be written in frame {n}",
        "l’articulation {name} est trop loin pour être écrite, à l’image {n}",
    ),
    (
        "marker {name} is too far away to be written in frame {n}",
        "le marqueur {name} est trop loin pour être écrit, à l’image {n}",
    ),
    (
        "import it again with the right --unit, or write .bvh, which holds any number",
        "importez-le de nouveau avec la bonne --unit, ou écrivez un .bvh, qui contient tout nombre",
    ),
    (
        "packet {n} is not later than the one before it; it was left out",
        "le paquet {n} n’est pas plus tard que le précédent ; il a été laissé de côté",
    ),
    (
        "rows without a face (success is 0), whose numbers are kept and mean nothing: {n}",
        "lignes sans visage (success est 0), dont les nombres sont gardés et ne veulent rien dire : {n}",
    ),
    (
        "the file holds more than {n} faces (face_id); run OpenFace for one face, or split the file",
        "le fichier contient plus de {n} visages (face_id) ; lancez OpenFace pour un seul visage, ou partagez le fichier",
    ),
    (
        "each of its faces (face_id) is a track of its own: {names}",
        "chacun de ses visages (face_id) est une piste à part : {names}",
    ),
    (
        "the turns of the head are all 0: the tracker did not record them",
        "les rotations de la tête sont toutes 0 : le suivi ne les a pas enregistrées",
    ),
    (
        "the capture lacks channels for {names}",
        "il manque à la capture des canaux pour {names}",
    ),
    (
        "they are unknown, not at rest, and are left out of scores",
        "ils sont inconnus, et non au repos, et restent hors des scores",
    ),
    (
        "{one} and {other} move against each other (r = {r}), which faces do not",
        "{one} et {other} bougent l’un contre l’autre (r = {r}), ce que les visages ne font pas",
    ),
    (
        "the writer of the file may have exchanged the sides of one pair",
        "le programme qui a écrit le fichier a peut-être échangé les côtés d’une paire",
    ),
    (
        "{n} trees of joints were put below one root",
        "{n} arbres d’articulations ont été mis sous une racine",
    ),
    ("scales that are not even", "échelles inégales"),
    (
        "the node {name} is stretched or mirrored; its mean scale is taken",
        "le nœud {name} est étiré ou en miroir ; son échelle moyenne est prise",
    ),
    ("this is no FBX file", "ce n’est pas un fichier FBX"),
    (
        "FBX of this version is not supported; open it in Blender or MotionBuilder and save it as FBX 2013 or later",
        "cette version de FBX n’est pas lue ; ouvrez-le dans Blender ou MotionBuilder et enregistrez-le en FBX 2013 ou plus récent",
    ),
    (
        "the file holds no skeleton: no bone and no animated node",
        "le fichier ne contient pas de squelette : ni os ni nœud animé",
    ),
    (
        "the file holds no skeleton: no skin and no animated node",
        "le fichier ne contient pas de squelette : ni peau ni nœud animé",
    ),
    (
        "its take lasts {seconds} s with {joints} joints; at most {most} positions can be held",
        "sa prise dure {seconds} s avec {joints} articulations ; on peut retenir au plus {most} positions",
    ),
    ("{n} nodes are too many", "{n} nœuds sont trop"),
    ("warnings of the parser", "remarques de la lecture"),
    (
        "it states no unit; centimetres are taken",
        "il ne dit pas d’unité ; le centimètre est pris",
    ),
    (
        "its axes are left-handed: left and right may be exchanged",
        "ses axes sont d’orientation gauche : la gauche et la droite sont peut-être échangées",
    ),
    (
        "it states no axes; Y is taken for up",
        "il ne dit pas d’axes ; Y est pris pour le haut",
    ),
    (
        "only its first take was read; left out: {names}",
        "seule sa première prise a été lue ; laissées de côté : {names}",
    ),
    (
        "export each take to a file of its own",
        "exportez chaque prise dans un fichier à elle",
    ),
    (
        "only its first animation was read; left out: {names}",
        "seule sa première animation a été lue ; laissées de côté : {names}",
    ),
    (
        "export each animation to a file of its own",
        "exportez chaque animation dans un fichier à elle",
    ),
    (
        "it has no animation; one frame at rest was made",
        "il n’a pas d’animation ; une image au repos a été faite",
    ),
    (
        "joints whose rest position contradicts the movement, which is used: {n}",
        "articulations dont la position au repos contredit le mouvement, qui est utilisé : {n}",
    ),
    (
        "its keys come {found} times a second, though it states {stated}; the keys count",
        "ses clés viennent {found} fois par seconde, alors qu’il dit {stated} ; ce sont les clés qui comptent",
    ),
    (
        "the range of its take is no time; that of its keys is taken",
        "l’étendue de sa prise n’est pas un temps ; celle de ses clés est prise",
    ),
    (
        "its take begins at {time} s; that is 0 s here",
        "sa prise commence à {time} s ; c’est 0 s ici",
    ),
    (
        "its movement begins at {time} s; that is 0 s here",
        "son mouvement commence à {time} s ; c’est 0 s ici",
    ),
    (
        "this is no glTF 2.0 file",
        "ce n’est pas un fichier glTF 2.0",
    ),
    (
        "its JSON is not that of glTF: {why}",
        "son JSON n’est pas celui de glTF : {why}",
    ),
    (
        "the file ends within {part}; it is cut short",
        "le fichier finit dans {part} ; il est tronqué",
    ),
    (
        "the movement is packed by the extension {name}; export it without compression",
        "le mouvement est comprimé par l’extension {name} ; exportez-le sans compression",
    ),
    (
        "the buffer {name} is not in the file or next to it; save as .glb, or keep the .bin beside the .gltf",
        "le tampon {name} n’est ni dans le fichier ni à côté ; enregistrez en .glb, ou gardez le .bin à côté du .gltf",
    ),
    (
        "it needs the extension {name}; movement is read without it",
        "il demande l’extension {name} ; le mouvement est lu sans elle",
    ),
    (
        "its key times make more frames than can be held; one frame at rest was made",
        "ses temps de clés font plus d’images qu’on n’en peut retenir ; une image au repos a été faite",
    ),
    (
        "channel {n} changes the scale of a node; that is not shown",
        "le canal {n} change l’échelle d’un nœud ; cela n’est pas montré",
    ),
    (
        "{n} of its {all} key times lie between frames of {rate}; movement is read at that rate",
        "{n} de ses {all} temps de clés tombent entre des images de {rate} ; le mouvement est lu à cette cadence",
    ),
    (
        "the skeleton has no {part}, which avatars need",
        "il manque au squelette ce qu’un avatar demande : {part}",
    ),
    (
        "this is no MP4 or QuickTime file",
        "ce n’est pas un fichier MP4 ou QuickTime",
    ),
    (
        "the file has no movie header (moov); the recording was cut off, or is not finished",
        "le fichier n’a pas d’en-tête de film (moov) ; l’enregistrement a été interrompu, ou n’est pas fini",
    ),
    (
        "the file holds no pictures, only {what}",
        "le fichier ne contient pas d’images, seulement {what}",
    ),
    (
        "the parameter sets of H.264 are broken: {why}",
        "les paramètres H.264 sont abîmés : {why}",
    ),
    (
        "the file does not end where its last box does; it may be cut short",
        "le fichier ne finit pas là où sa dernière boîte finit ; il est peut-être tronqué",
    ),
    (
        "the file holds {n} films; the first is shown",
        "le fichier contient {n} films ; le premier est montré",
    ),
    (
        "the file is cut short; frames beyond its end, which are left out: {n}",
        "le fichier est tronqué ; images au-delà de sa fin, laissées de côté : {n}",
    ),
    (
        "the film was cut in {n} pieces by its edit list; it is shown uncut",
        "le film a été coupé en {n} morceaux par sa liste de montage ; il est montré entier",
    ),
    (
        "write it again as one piece, for example with ffmpeg",
        "écrivez-le de nouveau d’une pièce, par exemple avec ffmpeg",
    ),
    (
        "version {n} of .pose is not known; 0.0, 0.1 and 0.2 are",
        "la version {n} de .pose n’est pas connue ; 0.0, 0.1 et 0.2 le sont",
    ),
    (
        "the file holds no points",
        "le fichier ne contient pas de points",
    ),
    (
        "the component {name} has the format {format}; XYC and XYZC are known",
        "le composant {name} a le format {format} ; XYC et XYZC sont connus",
    ),
    (
        "{n} more people are in the film; only the first {most} were read",
        "personnes de plus dans le film : {n} ; seules les {most} premières ont été lues",
    ),
    (
        "the landmarks in metres were multiplied by the picture's width and height; they are divided by them again",
        "les repères en mètres ont été multipliés par la largeur et la hauteur de l’image ; ils sont divisés de nouveau",
    ),
    (
        "places are shares of the picture's width and height: angles between them need its proportions",
        "les positions sont des parts de la largeur et de la hauteur de l’image : les angles entre elles demandent ses proportions",
    ),
    (
        "it has more than {n} places of points",
        "il a plus de {n} positions de points",
    ),
    (
        "frame {n} is beyond the last possible one",
        "l’image {n} est au-delà de la dernière possible",
    ),
    (
        "the points {group} in three dimensions are left out: their unit is not stated",
        "les points {group} en trois dimensions sont laissés de côté : leur unité n’est pas dite",
    ),
    (
        "frame {n} shows {left} more people than the {most} who are followed",
        "l’image {n} montre {left} personnes de plus que les {most} qui sont suivies",
    ),
    (
        "the trunk lies askew to all axes; Y up is assumed",
        "le tronc est de travers par rapport à tous les axes ; Y vers le haut est supposé",
    ),
    (
        "neither the rest pose nor the first frame shows a trunk with two sides: Y up and the left at +X are assumed; say the axes if that is wrong",
        "ni la pose de repos ni la première image ne montrent un tronc à deux côtés : Y vers le haut et la gauche en +X sont supposés ; dites les axes si c’est faux",
    ),
    (
        "the toes point away from where the body would face: the file may have left and right, or a left-handed space, exchanged",
        "les orteils pointent à l’opposé du visage : le fichier a peut-être échangé la gauche et la droite, ou un espace d’orientation gauche",
    ),
    (
        "a body {units} units tall is {metres} m in {unit}",
        "un corps de {units} unités fait {metres} m en {unit}",
    ),
    (
        "a stature of {metres} m is unusual",
        "une taille de {metres} m est inhabituelle",
    ),
    (
        "line {n} of the roles ({text}) is not of the form `part = joint`",
        "la ligne {n} des rôles ({text}) n’a pas la forme `partie = articulation`",
    ),
    (
        "line {n} of the roles names {part} again; each part has one joint",
        "la ligne {n} des rôles nomme de nouveau {part} ; chaque partie a une articulation",
    ),
    (
        "line {n} of the roles: {why}",
        "ligne {n} des rôles : {why}",
    ),
    (
        "the roles are no JSON object of parts and joint names: {why}",
        "les rôles ne sont pas un objet JSON de parties et de noms d’articulations : {why}",
    ),
    (
        "joint {joint} is given to both {first} and {second}; only spine and chest may share",
        "l’articulation {joint} est donnée à {first} et à {second} ; seuls spine et chest peuvent la partager",
    ),
    (
        "{text} names no axes; write a direction as +X, -Z …, and axes as up,left: for example +Y,+X",
        "{text} ne nomme pas d’axes ; écrivez une direction comme +X, -Z …, et des axes comme haut,gauche : par exemple +Y,+X",
    ),
    (
        "the points have no place in a room; only markers in three dimensions can be fitted",
        "les points n’ont pas de position dans l’espace ; seuls des marqueurs en trois dimensions s’ajustent",
    ),
    (
        "only {n} of {all} markers have a known label, and {needed} are needed",
        "marqueurs d’étiquette connue : {n} sur {all} ; il en faut {needed}",
    ),
    (
        "no frame has {n} markers with a known label at once",
        "aucune image n’a {n} marqueurs d’étiquette connue à la fois",
    ),
    (
        "the skeleton has no trunk, arms and head with known joints",
        "le squelette n’a pas de tronc, de bras ni de tête aux articulations connues",
    ),
    (
        "the skeleton has no {side} arm: name its upper arm, forearm and hand in a roles file",
        "le squelette n’a pas de bras de ce côté ({side}) : nommez son bras, son avant-bras et sa main dans un fichier de rôles",
    ),
    (
        "the clip has no frames; transcribe a stretch of at least one",
        "le mouvement n’a pas d’images ; transcrivez-en au moins une",
    ),
    (
        "the skeleton has no arm with shoulder, elbow and wrist on a trunk; name them in a roles file",
        "le squelette n’a pas de bras avec épaule, coude et poignet sur un tronc ; nommez-les dans un fichier de rôles",
    ),
    (
        "{seconds} s are too long for one sign; give the span of a token of at most {most} s",
        "{seconds} s sont trop pour un signe ; donnez la durée d’une occurrence d’au plus {most} s",
    ),
    (
        "{n} joints tremble from frame to frame, by {angle} at most: they were smoothed",
        "articulations qui tremblent d’image en image, de {angle} au plus, et ont été lissées : {n}",
    ),
    (
        "the {side} hand has too few fingers to define its palm",
        "la main {side} a trop peu de doigts pour définir sa paume",
    ),
    (
        "the {side} handshape is inferred from {what} alone, and may be another",
        "la configuration {side} est déduite de {what} seulement, et peut être une autre",
    ),
    (
        "the {side} handshape is inferred without {what}",
        "la configuration {side} est déduite sans {what}",
    ),
    (
        "the skeleton has no arm on the {side} side",
        "le squelette n’a pas de bras de ce côté : {side}",
    ),
    (
        "the hands rest or the arms stick out in every frame: only that posture is transcribed; give a span in which something is signed",
        "les mains reposent ou les bras s’écartent dans toutes les images : seule cette posture est transcrite ; donnez une durée où l’on signe",
    ),
    (
        "{n} actions are many for one sign: give the span of a single token",
        "{n} actions sont beaucoup pour un signe : donnez la durée d’une seule occurrence",
    ),
    (
        "re-synthesised, the {side} hand begins {cm} cm from its observed place",
        "synthétisée de nouveau, la main {side} commence à {cm} cm de sa place observée",
    ),
    (
        "re-synthesised, the movement is {cm} cm from the observed one",
        "synthétisé de nouveau, le mouvement est à {cm} cm de celui qui a été observé",
    ),
    (
        "re-synthesised, the movement {names} is {cm} cm from the observed one; {first}, which was read first, is {more} cm from it",
        "synthétisé de nouveau, le mouvement {names} est à {cm} cm de celui qui a été observé ; {first}, lu d’abord, en est à {more} cm",
    ),
    (
        "the clip is empty: it has no frame to draw",
        "le mouvement est vide : il n’a pas d’image à dessiner",
    ),
    (
        "there is no frame {n}; the clip's frames are 0 to {last}",
        "il n’y a pas d’image {n} ; les images du mouvement sont 0 à {last}",
    ),
    (
        "a picture of {width} by {height} pixels cannot be made; sides are from 16 to {side}, one view has at most {view} pixels and a sheet at most {most}; ask for fewer or smaller cells",
        "une image de {width} sur {height} pixels est impossible ; les côtés vont de 16 à {side}, une vue a au plus {view} pixels et une planche au plus {most} ; demandez des cases moins nombreuses ou plus petites",
    ),
    (
        "an animation cannot run at the speed {speed}; give a number from {least} to {most}",
        "une animation ne va pas à la vitesse {speed} ; donnez un nombre de {least} à {most}",
    ),
    (
        "an animation of {n} pictures is too long, at most {most} are drawn; draw a shorter stretch, or run it faster",
        "une animation de {n} images est trop longue, au plus {most} se dessinent ; dessinez un passage plus court, ou plus vite",
    ),
    (
        "stopped after {n} of {all} pictures",
        "arrêté après {n} images sur {all}",
    ),
    (
        "the PNG could not be written",
        "le PNG n’a pas pu être écrit",
    ),
    (
        "the GIF could not be written",
        "le GIF n’a pas pu être écrit",
    ),
];
