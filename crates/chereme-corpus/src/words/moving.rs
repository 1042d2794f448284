//! French forms of messages about tracks, faces, notation, cued speech and pictures, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const MOVING: &[(&str, &str)] = &[
    (
        "{name} names nobody's body",
        "{name} n’est le corps de personne",
    ),
    (
        "the body's {hands} joints of fingers: no handshape can be seen",
        "les {hands} articulations des doigts du corps : aucune configuration ne se voit",
    ),
    (
        "name another body with --signer, or the joints in a roles file",
        "nommez un autre corps avec --signer, ou les articulations dans un fichier de rôles",
    ),
    ("there is no notation", "il n’y a pas de notation"),
    (
        "write HamNoSys, a SiGML file, or the gloss of a notated sign",
        "écrivez du HamNoSys, un fichier SiGML, ou la glose d’un signe noté",
    ),
    ("the HamNoSys text", "le texte HamNoSys"),
    (
        "symbols may be written as characters or by name: hamflathand hamextfingeru hampalml",
        "les symboles s’écrivent en caractères ou par leur nom : hamflathand hamextfingeru hampalml",
    ),
    (
        "made of what was understood: {what}",
        "fait de ce qui a été compris : {what}",
    ),
    (
        "the notation cannot be copied: {why}",
        "la notation ne se copie pas : {why}",
    ),
    ("there is no file {name}", "il n’y a pas de fichier {name}"),
    (
        "name a file, or a sign that the corpus holds as notation by its gloss",
        "nommez un fichier, ou par sa glose un signe dont le corpus a la notation",
    ),
    ("{address} has no notation", "{address} n’a pas de notation"),
    (
        "import a SiGML file or a HamNoSys lexicon that holds the sign, or `chereme transcribe CORPUS SIGN --store`",
        "importez un fichier SiGML ou un lexique HamNoSys qui contient le signe, ou `chereme transcribe CORPUS SIGNE --store`",
    ),
    (
        "a SiGML file holds <hamgestural_sign> elements",
        "un fichier SiGML contient des éléments <hamgestural_sign>",
    ),
    (
        "write a sign a line: the gloss, a tab, and HamNoSys",
        "écrivez un signe par ligne : la glose, une tabulation, et du HamNoSys",
    ),
    (
        "it is too long for signs in a row",
        "c’est trop long pour des signes à la suite",
    ),
    (
        "import it, then animate its signs by gloss",
        "importez-le, puis animez ses signes par leur glose",
    ),
    (
        "give at most 64 KiB at once to espeak-ng",
        "donnez au plus 64 Kio à la fois à espeak-ng",
    ),
    (
        "espeak-ng cannot be run: {why}",
        "espeak-ng ne se lance pas : {why}",
    ),
    (
        "install espeak-ng, or give French text without --espeak, or phones with --phones",
        "installez espeak-ng, ou donnez du texte français sans --espeak, ou des phones avec --phones",
    ),
    ("espeak-ng failed", "espeak-ng a échoué"),
    (
        "try `espeak-ng -v {voice}` by itself: the voice may be missing",
        "essayez `espeak-ng -v {voice}` à part : la voix manque peut-être",
    ),
    (
        "give a file of at most 256 MiB",
        "donnez un fichier d’au plus 256 Mio",
    ),
    (
        "give a TextGrid or an EAF file with a tier of phones",
        "donnez un fichier TextGrid ou EAF avec un acteur de phones",
    ),
    (
        "there is no tier {name}; there are: {names}",
        "il n’y a pas d’acteur {name} ; il y a : {names}",
    ),
    (
        "no tier is called like phones; there are: {names}",
        "aucun acteur n’a un nom de phones ; il y a : {names}",
    ),
    ("name one with --tier", "nommez-en un avec --tier"),
    (
        "give a table of two columns and at most 1 MiB",
        "donnez une table de deux colonnes et d’au plus 1 Mio",
    ),
    (
        "{row} has no second column",
        "{row} n’a pas de deuxième colonne",
    ),
    (
        "{name} is no marker of the models",
        "{name} n’est pas un marqueur des modèles",
    ),
    (
        "import a .c3d or .trc file of a cuer; other labels are mapped with --labels FILE",
        "importez un fichier .c3d ou .trc d’un codeur ; d’autres étiquettes se traduisent avec --labels FICHIER",
    ),
    (
        "\"{name}\" has no track of markers",
        "\"{name}\" n’a pas de piste de marqueurs",
    ),
    (
        "{n} labels of {name} are known as markers of a cuer's hand or face",
        "étiquettes de {name} connues comme marqueurs de la main ou du visage d’un codeur : {n}",
    ),
    (
        "{name} has {n} frames; at most {most} are followed at once",
        "{name} a {n} images ; au plus {most} sont suivies à la fois",
    ),
    (
        "cut the recording into shorter takes",
        "coupez l’enregistrement en prises plus courtes",
    ),
    (
        "the frames of {name} are not even in time",
        "les images de {name} ne sont pas régulières dans le temps",
    ),
    (
        "export it from the camera system with a constant frame rate",
        "exportez-le du système de caméras avec une cadence constante",
    ),
    (
        "the points of {name} lie on a picture, and not in a room",
        "les points de {name} sont sur une image, et non dans l’espace",
    ),
    (
        "no recording shows the markers of a cuer's hand or face",
        "aucun enregistrement ne montre les marqueurs de la main ou du visage d’un codeur",
    ),
    (
        "import .c3d or .trc files of a cuer; other labels are mapped with --labels FILE",
        "importez des fichiers .c3d ou .trc d’un codeur ; d’autres étiquettes se traduisent avec --labels FICHIER",
    ),
    (
        "no recording has the markers of a hand and a tier of keys or phones",
        "aucun enregistrement n’a les marqueurs d’une main et un acteur de clés ou de phones",
    ),
    (
        "import the TextGrid or EAF file of each take under the same name, with a tier called Phones or Keys",
        "importez le fichier TextGrid ou EAF de chaque prise sous le même nom, avec un acteur appelé Phones ou Keys",
    ),
    (
        "the takes have {n} frames; a dictionary holds {most}",
        "les prises ont {n} images ; un dictionnaire en contient {most}",
    ),
    ("name fewer recordings", "nommez moins d’enregistrements"),
    (
        "too few frames show every marker of the hand and the head",
        "trop peu d’images montrent tous les marqueurs de la main et de la tête",
    ),
    (
        "restore the hidden markers first: chereme cued CORPUS restore",
        "restaurez d’abord les marqueurs cachés : chereme cued CORPUS restore",
    ),
    (
        "markers are hidden at the targets: {a} of {keys} shapes and {b} placements are not read and count in no rate; chereme cued CORPUS restore restores the markers",
        "des marqueurs sont cachés aux cibles : {a} formes sur {keys} et {b} emplacements ne sont pas lus et ne comptent dans aucun taux ; chereme cued CORPUS restore restaure les marqueurs",
    ),
    (
        "{key} on the tier Keys is no key",
        "{key} sur l’acteur Keys n’est pas une clé",
    ),
    (
        "write keys as mouth-4, 4-m or 24; silence is an empty annotation or #",
        "écrivez les clés comme mouth-4, 4-m ou 24 ; un silence est une annotation vide ou #",
    ),
    (
        "{name}: its keys have no room in its frames",
        "{name} : ses clés n’ont pas de place dans ses images",
    ),
    (
        "no key has a target whose markers are seen",
        "aucune clé n’a de cible dont les marqueurs se voient",
    ),
    (
        "the recognisers cannot learn from these keys: {why}",
        "rien ne s’apprend de ces clés pour les reconnaître : {why}",
    ),
    (
        "import more takes with keys, or restore their hidden markers first: chereme cued CORPUS restore",
        "importez plus de prises avec des clés, ou restaurez d’abord leurs marqueurs cachés : chereme cued CORPUS restore",
    ),
    (
        "a hand has from 1 to 25; the founding paper keeps 12",
        "une main en a de 1 à 25 ; l’article d’origine en garde 12",
    ),
    (
        "{n} places of {all} recordings",
        "{n} endroits de {all} enregistrements",
    ),
    (
        "there is no model of the hand: {why}",
        "il n’y a pas de modèle de la main : {why}",
    ),
    (
        "there is no model of the face: {why}",
        "il n’y a pas de modèle du visage : {why}",
    ),
    (
        "name with --train recordings that show every marker, of the hand alone or the face alone",
        "nommez avec --train des enregistrements qui montrent tous les marqueurs, de la main seule ou du visage seul",
    ),
    (
        "a cost is no number from 0 to 1000",
        "un coût n’est pas un nombre de 0 à 1000",
    ),
    ("1 is usual for both", "1 est habituel pour les deux"),
    (
        "no movement could be cut",
        "aucun mouvement n’a pu être découpé",
    ),
    (
        "too few captured keys of each kind have measured phases",
        "trop peu de clés captées de chaque sorte ont des phases mesurées",
    ),
    (
        "store them first: chereme cued CORPUS targets --store",
        "enregistrez-les d’abord : chereme cued CORPUS targets --store",
    ),
    (
        "the program's own movement is used, as there is no dictionary: {why}",
        "le mouvement du programme est utilisé, faute de dictionnaire : {why}",
    ),
    ("the keys have no times", "les clés n’ont pas de temps"),
    (
        "put together from captured movements between keys; the tier Dikeys names the source of each",
        "assemblé de mouvements captés entre des clés ; l’acteur Dikeys nomme la source de chacun",
    ),
    (
        "{name} has no tier of phones",
        "{name} n’a pas d’acteur de phones",
    ),
    (
        "give the text with --text, or import an alignment with a tier called Phones",
        "donnez le texte avec --text, ou importez un alignement avec un acteur appelé Phones",
    ),
    (
        "{n} keys are too many to compare",
        "{n} clés sont trop à comparer",
    ),
    (
        "{name} has no keys or phones to look for",
        "{name} n’a ni clés ni phones à chercher",
    ),
    (
        "import an alignment with a tier called Phones",
        "importez un alignement avec un acteur appelé Phones",
    ),
    (
        "the curve {name} has {n} values for {frames} frames",
        "la courbe {name} a {n} valeurs pour {frames} images",
    ),
    (
        "the curve {name} has a number out of range",
        "la courbe {name} a un nombre hors limites",
    ),
    (
        "the recording {name} has no curves",
        "l’enregistrement {name} n’a pas de courbes",
    ),
    (
        "signs made from notation with non-manual tiers have some; `chereme list CORPUS recordings` counts them",
        "les signes faits d’une notation avec des acteurs non manuels en ont ; `chereme list CORPUS recordings` les compte",
    ),
    (
        "the curves cannot be written: {why}",
        "les courbes ne s’écrivent pas : {why}",
    ),
    (
        "{name} is no channel of a face",
        "{name} n’est pas un canal d’un visage",
    ),
    (
        "the channels are: {names}; the start of a name stands for all that begin so",
        "les canaux sont : {names} ; le début d’un nom vaut pour tous ceux qui commencent ainsi",
    ),
    (
        "the two faces have no channel in common",
        "les deux visages n’ont aucun canal en commun",
    ),
    (
        "no other recording has a performance of {function}",
        "aucun autre enregistrement n’a d’exécution de {function}",
    ),
    (
        "`chereme milestones CORPUS` lists the functions that there are",
        "`chereme milestones CORPUS` donne la liste des fonctions qu’il y a",
    ),
    (
        "no performance can be compared",
        "aucune exécution ne se compare",
    ),
    (
        "the two faces cannot be compared: {why}",
        "les deux visages ne se comparent pas : {why}",
    ),
    (
        "{address} shows no face and no turn of the head",
        "{address} ne montre ni visage ni rotation de la tête",
    ),
    (
        "import its face file under the recording's name, or rank by the medoid with --rank medoid",
        "importez son fichier de visage sous le nom de l’enregistrement, ou classez d’après le médoïde avec --rank medoid",
    ),
    (
        "no gloss lies in it, so its own span stands for one sign",
        "aucune glose ne s’y trouve : sa propre durée vaut pour un signe",
    ),
    (
        "annotate its function (wh, yn, negation, topic …) on a tier called \"function\" over its signs, or write its phases on a tier such as \"milestones wh\"",
        "annotez sa fonction (wh, yn, negation, topic …) sur un acteur appelé \"function\" au-dessus de ses signes, ou écrivez ses phases sur un acteur comme \"milestones wh\"",
    ),
    ("name one of them", "nommez l’une d’elles"),
    (
        "the take never moves {parts}: their weights stay",
        "la prise ne bouge jamais {parts} : leurs poids restent",
    ),
    (
        "record a take in which each part of the face goes as far as it can",
        "enregistrez une prise où chaque partie du visage va aussi loin qu’elle peut",
    ),
    (
        "the face of {name} is estimated from points on film, which count from their own median and keep no weights",
        "le visage de {name} est estimé d’après des points d’un film, qui se comptent depuis leur propre médiane et ne gardent pas de poids",
    ),
    (
        "fit a take of a face system, such as Live Link or MPEG-4",
        "ajustez une prise d’un système de visage, comme Live Link ou MPEG-4",
    ),
    (
        "the recording {name} has no captured face",
        "l’enregistrement {name} n’a pas de visage capté",
    ),
    (
        "import its face file (Live Link CSV, OpenFace CSV, MediaPipe JSON, .fap) under the same name",
        "importez son fichier de visage (CSV de Live Link ou d’OpenFace, JSON de MediaPipe, .fap) sous le même nom",
    ),
    (
        "there are no expressions with a function",
        "aucune expression n’a de fonction",
    ),
    (
        "annotate wh, yn, negation or topic on a tier called \"function\"; see `chereme milestones --help`",
        "annotez wh, yn, negation ou topic sur un acteur appelé \"function\" ; voyez `chereme milestones --help`",
    ),
    (
        "{address} lasts {seconds} s, and expressions of more than {most} s are not compared",
        "{address} dure {seconds} s, et les expressions de plus de {most} s ne sont pas comparées",
    ),
    (
        "annotate shorter expressions on the tier \"function\"",
        "annotez des expressions plus courtes sur l’acteur « function »",
    ),
    (
        "{address}: nothing was measured in {seconds} s of its {length} s",
        "{address} : rien n’a été mesuré pendant {seconds} s de ses {length} s",
    ),
    (
        "compare an expression that its capture covers without gaps",
        "comparez une expression que sa capture couvre sans trous",
    ),
    (
        "{address} does not show {name}",
        "{address} ne montre pas {name}",
    ),
    ("the face has no rate", "le visage n’a pas de cadence"),
    (
        "{name} is a face of {minutes} min, too long to be performed at once",
        "{name} est un visage de {minutes} min, trop long pour être exécuté d’un coup",
    ),
    (
        "annotate the part on a gloss tier and name its token",
        "annotez la partie sur un acteur de gloses et nommez son occurrence",
    ),
    (
        "{name} is {minutes} min long, and a recipe takes {most} min at most; annotate the part on a gloss tier and name its token",
        "{name} dure {minutes} min, et une recette prend au plus {most} min ; annotez la partie sur un acteur de gloses et nommez son occurrence",
    ),
    (
        "a recording with movement",
        "un enregistrement avec un mouvement",
    ),
    (
        "the recording {name} holds no movement",
        "l’enregistrement {name} ne contient pas de mouvement",
    ),
    (
        "import the motion file of the same name; movement is made from markers by `chereme fit CORPUS RECORDING`",
        "importez le fichier de mouvement du même nom ; `chereme fit CORPUS ENREGISTREMENT` fait un mouvement de marqueurs",
    ),
    ("it holds no movement", "il ne contient pas de mouvement"),
    ("it is too long", "il est trop long"),
    ("joint {name} has a gap", "l’articulation {name} a un trou"),
    (
        "such a picture shows one movement, and several are named",
        "une telle image montre un seul mouvement, et plusieurs sont nommés",
    ),
    (
        "several movements are drawn next to each other to an .mp4 or a .gif",
        "plusieurs mouvements se dessinent côte à côte dans un .mp4 ou un .gif",
    ),
    (
        "the notation holds what is no symbol",
        "la notation contient ce qui n’est pas un symbole",
    ),
    (
        "the name does not end in .svg, but the picture is an SVG",
        "le nom ne finit pas par .svg, mais l’image est un SVG",
    ),
    (
        "give a name that ends in .svg",
        "donnez un nom qui finit par .svg",
    ),
    (
        "the symbols of HamNoSys are drawn to an .svg",
        "les symboles HamNoSys se dessinent dans un .svg",
    ),
    (
        "no inventory is called {name}",
        "aucun inventaire ne s’appelle {name}",
    ),
    (
        "the inventories are: {names}",
        "les inventaires sont : {names}",
    ),
    (
        "{inventory} has no handshape {name}",
        "{inventory} n’a pas de configuration {name}",
    ),
    ("near to it: {names}", "proches : {names}"),
    (
        "the values of {inventory} have no handshapes",
        "les valeurs de {inventory} ne sont pas des configurations",
    ),
    (
        "draw the inventory configurations",
        "dessinez l’inventaire configurations",
    ),
    (
        "a handshape is drawn to a .png",
        "une configuration se dessine dans un .png",
    ),
    (
        "faces are drawn to a .png",
        "les visages se dessinent dans un .png",
    ),
    (
        "write a contact sheet to .png, an animation to .gif, a film to .mp4, or the notation to .svg",
        "écrivez une planche en .png, une animation en .gif, un film en .mp4, ou la notation en .svg",
    ),
    (
        "write a contact sheet to .png, an animation to .gif, a film to .mp4",
        "écrivez une planche en .png, une animation en .gif, un film en .mp4",
    ),
    (
        "the picture's name has no ending that says its kind",
        "le nom de l’image n’a pas de fin qui dise son genre",
    ),
    (
        "{one} and {other} share no movement that could bring them together",
        "{one} et {other} n’ont en commun aucun mouvement qui puisse les accorder",
    ),
    (
        "name a joint, point or curve that moves in both, or set the offset by hand",
        "nommez une articulation, un point ou une courbe qui bouge dans les deux, ou réglez le décalage à la main",
    ),
    ("{name} is a file of media", "{name} est un média"),
    (
        "compare a track of points that were estimated from it",
        "comparez une piste de points estimés d’après lui",
    ),
    ("the track has no {name}", "la piste n’a pas de {name}"),
    (
        "`chereme list CORPUS tracks` lists tracks; export one as .csv to see its channels",
        "`chereme list CORPUS tracks` donne la liste des pistes ; exportez-en une en .csv pour voir ses canaux",
    ),
    ("a track needs a name", "une piste doit avoir un nom"),
    (
        "another track is called {name}",
        "une autre piste s’appelle {name}",
    ),
    (
        "the recording has no track; import a file into it",
        "l’enregistrement n’a pas de piste ; importez-y un fichier",
    ),
    ("its tracks are: {names}", "ses pistes sont : {names}"),
    (
        "\"{recording}\" has no track {name}",
        "\"{recording}\" n’a pas de piste {name}",
    ),
    (
        "markers are known by labels such as LSHO, RWRA, C7 or R.Elbow; rename them in the file",
        "les marqueurs se reconnaissent à des étiquettes comme LSHO, RWRA, C7 ou R.Elbow ; renommez-les dans le fichier",
    ),
    (
        "{name}: a skeleton fitted to {markers}, {mm} mm",
        "{name} : un squelette ajusté à {markers}, {mm} mm",
    ),
    (
        "import a .c3d or .trc file into it: chereme import CORPUS FILE --into recording:3",
        "importez-y un fichier .c3d ou .trc : chereme import CORPUS FICHIER --into recording:3",
    ),
    ("{name} has no skeleton", "{name} n’a pas de squelette"),
    (
        "name a recording of movement, or leave --to out for the program's own body",
        "nommez un enregistrement de mouvement, ou omettez --to pour le corps du programme",
    ),
    (
        "this is no capture of a skeleton: markers are {mm} mm from it in the median and seen in {share} % of the frames; a good fit is below {most} mm and above {least} %",
        "ce n’est pas la capture d’un squelette : les marqueurs en sont à {mm} mm (médiane) et se voient dans {share} % des images ; un bon ajustement est sous {most} mm et au-dessus de {least} %",
    ),
    (
        "the body of the markers is {m} m tall; if that is wrong, import the file again with its unit",
        "le corps des marqueurs mesure {m} m ; si c’est faux, importez de nouveau le fichier avec son unité",
    ),
    (
        "the turn of the left forearm and palm about the forearm is a guess, as no pair of markers on the sides of thumb and little finger shows it; call them {a} and {b}",
        "la rotation de l’avant-bras gauche et de la paume autour de l’avant-bras est supposée, car aucune paire de marqueurs du côté du pouce et de l’auriculaire ne la montre ; nommez-les {a} et {b}",
    ),
    (
        "the turn of the right forearm and palm about the forearm is a guess, as no pair of markers on the sides of thumb and little finger shows it; call them {a} and {b}",
        "la rotation de l’avant-bras droit et de la paume autour de l’avant-bras est supposée, car aucune paire de marqueurs du côté du pouce et de l’auriculaire ne la montre ; nommez-les {a} et {b}",
    ),
    (
        "no marker is on the fingers, which stay at rest: handshapes read from this track are not the signer's",
        "aucun marqueur n’est sur les doigts, qui restent au repos : les configurations lues sur cette piste ne sont pas celles du signeur",
    ),
    (
        "the markers are those of several people: {names}",
        "les marqueurs sont ceux de plusieurs personnes : {names}",
    ),
    (
        "no marker with a known label is of {name}; the people are: {names}",
        "aucun marqueur d’étiquette connue n’est de {name} ; les personnes sont : {names}",
    ),
    (
        "name one of them: --subject {name}",
        "nommez l’une d’elles : --subject {name}",
    ),
    (
        "markers that are not of {name} and are left out: {n}",
        "marqueurs qui ne sont pas de {name} et sont laissés de côté : {n}",
    ),
    (
        "the recording has a body already, from which signs are read; import the file again as a recording of its own for another person",
        "l’enregistrement a déjà un corps, sur lequel les signes se lisent ; pour une autre personne, importez de nouveau le fichier comme un enregistrement à part",
    ),
    (
        "frames with too few markers, in which the posture before is held: {n}",
        "images avec trop peu de marqueurs, où la posture d’avant est tenue : {n}",
    ),
    ("its times are missing", "ses temps manquent"),
    (
        "the track {name} has no frames",
        "la piste {name} n’a pas d’images",
    ),
    (
        "the media track was not stored",
        "la piste de média n’a pas été enregistrée",
    ),
    (
        "a track of kind {kind} is no table",
        "une piste de genre {kind} n’est pas une table",
    ),
    (
        "a skeleton is written as .bvh; media are files already",
        "un squelette s’écrit en .bvh ; les médias sont déjà des fichiers",
    ),
    (
        "the track cannot be written: {why}",
        "la piste ne s’écrit pas : {why}",
    ),
    (
        "{address} lasts {seconds} s; at most one sign of {most} s is transcribed at once",
        "{address} dure {seconds} s ; au plus un signe de {most} s se transcrit à la fois",
    ),
    (
        "name a token in it: token:41",
        "nommez une occurrence qui s’y trouve : token:41",
    ),
    (
        "{address} has another notation already",
        "{address} a déjà une autre notation",
    ),
    (
        "add --force to replace it; undo brings it back",
        "ajoutez --force pour la remplacer ; undo la ramène",
    ),
    (
        "the notation cannot be kept: {why}",
        "la notation ne se garde pas : {why}",
    ),
    (
        "the fingers of the right hand rest throughout the recording, so its handshape was not captured: the notated one is an assumption",
        "les doigts de la main droite restent au repos dans tout l’enregistrement ; sa configuration n’a donc pas été captée : celle de la notation est supposée",
    ),
    (
        "the fingers of the left hand rest throughout the recording, so its handshape was not captured: the notated one is an assumption",
        "les doigts de la main gauche restent au repos dans tout l’enregistrement ; sa configuration n’a donc pas été captée : celle de la notation est supposée",
    ),
    (
        "nothing is proposed for takes in which no joint of the body turns: {names}",
        "rien n’est proposé pour les prises où aucune articulation du corps ne tourne : {names}",
    ),
    (
        "handshapes are not proposed where fingers rest throughout, as nobody captured them: {names}",
        "les configurations ne sont pas proposées là où les doigts restent au repos, car personne ne les a captées : {names}",
    ),
    (
        "handshapes of the {side} hand are not compared, as its fingers rest throughout and nobody captured them: {names}",
        "les configurations de la main {side} ne sont pas comparées, car ses doigts restent au repos et personne ne les a captées : {names}",
    ),
    (
        "not compared, as one or both of the skeletons have no joints for it: {names}",
        "pas comparé, car l’un des squelettes au moins n’a pas d’articulations pour cela : {names}",
    ),
    (
        "the two have only handshapes in common, and nobody captured them, as the fingers rest throughout",
        "les deux n’ont en commun que des configurations, et personne ne les a captées : les doigts restent au repos",
    ),
    (
        "compare recordings whose fingers move, or that have joints of the arms",
        "comparez des enregistrements dont les doigts bougent, ou qui ont des articulations des bras",
    ),
    (
        "{name} has a face but no body to compare",
        "{name} a un visage, mais pas de corps à comparer",
    ),
    (
        "{name} is no recording and no token",
        "{name} n’est ni un enregistrement ni une occurrence",
    ),
    (
        "name one, such as recording:3 or token:41",
        "nommez-en un, comme recording:3 ou token:41",
    ),
    (
        "{name} is no recording",
        "{name} n’est pas un enregistrement",
    ),
    (
        "write recording:3, or the name of a recording",
        "écrivez recording:3, ou le nom d’un enregistrement",
    ),
    (
        "{name} is a sign with all its tokens",
        "{name} est un signe avec toutes ses occurrences",
    ),
    (
        "write sign:{name} to delete them all",
        "écrivez sign:{name} pour les supprimer toutes",
    ),
    (
        "{name} is both a sign and a recording",
        "{name} est à la fois un signe et un enregistrement",
    ),
    (
        "finger angles count from the straightest posture in this signer's takes, which is up to {n} degrees bent",
        "les angles des doigts se comptent depuis la posture la plus droite des prises de ce signeur, qui est pliée jusqu’à {n} degrés",
    ),
    (
        "the notation is odd: {why}",
        "la notation est étrange : {why}",
    ),
    (
        "{name} is no kind of track",
        "{name} n’est pas un genre de piste",
    ),
    (
        "the kinds are: skeleton, markers, curves, media",
        "les genres sont : skeleton, markers, curves, media",
    ),
    (
        "{name} is no origin of a recording",
        "{name} n’est pas une origine d’enregistrement",
    ),
    (
        "write captured, made or generated",
        "écrivez captured, made ou generated",
    ),
    (
        "{address} has no expression",
        "{address} n’a pas d’expression",
    ),
    ("all captured signers", "tous les signeurs captés"),
    (
        "a take could not be restored",
        "une prise n’a pas pu être restaurée",
    ),
    (
        "the visible markers of the {part} are {mm} mm from the model on average, so restored ones are not to be trusted; check the labels and the axes of this recording, or train on takes of the same person",
        "les marqueurs visibles ({part}) sont en moyenne à {mm} mm du modèle : ne vous fiez pas à ceux qui sont restaurés ; vérifiez les étiquettes et les axes de cet enregistrement, ou apprenez sur des prises de la même personne",
    ),
];
