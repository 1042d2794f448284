//! French forms of messages about annotation files of ANVIL, EXMARaLDA, SignStream and other programs, looked up by their
//! English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const FOREIGN: &[(&str, &str)] = &[
    (
        "the text is in {encoding}; files of {tool} are read in UTF-8 and UTF-16, and in Latin-1 and Windows-1252 where the file says so: open it in a text editor and save it as UTF-8",
        "le texte est en {encoding} ; les fichiers de {tool} se lisent en UTF-8 et en UTF-16, et en Latin-1 et Windows-1252 si le fichier le dit : ouvrez-le dans un éditeur de texte et enregistrez-le en UTF-8",
    ),
    (
        "this is not XML; a file of {tool} starts with <?xml …?> and <{root}>",
        "ce n’est pas du XML ; un fichier de {tool} commence par <?xml …?> et <{root}>",
    ),
    (
        "<{parent}> has no <{child}>; a file of {tool} has one",
        "<{parent}> n’a pas de <{child}> ; un fichier de {tool} en a un",
    ),
    (
        "{what}, more than {n}; no file of {tool} needs as many",
        "{what}, plus de {n} ; aucun fichier de {tool} n’en demande autant",
    ),
    (
        "its utterances lie in {n} films, each with a time of its own; save the utterances of each film as a collection of its own",
        "ses énoncés sont dans {n} films, chacun avec son propre temps ; enregistrez les énoncés de chaque film dans une collection à part",
    ),
    (
        "elements <{name}> are not read and were left out: {n}",
        "des éléments <{name}> ne sont pas lus et ont été laissés de côté : {n}",
    ),
    (
        "an annotation of the tier {tier} at {time} has no length; it lasts 40 ms, or until the next one",
        "une annotation de l’acteur {tier} à {time} n’a pas de durée ; elle dure 40 ms, ou jusqu’à la suivante",
    ),
    (
        "an annotation of the tier {tier} at {time} ends before it starts; the ends were exchanged",
        "une annotation de l’acteur {tier} à {time} finit avant de commencer ; ses bords ont été échangés",
    ),
    (
        "annotations of {tier} overlap others: {n} were put on tiers of their own, as {name}",
        "des annotations de {tier} en chevauchent d’autres : {n} ont été mises sur des acteurs à part, comme {name}",
    ),
    (
        "more than {limit} annotations of {tier} overlap at once: {n} of them still do",
        "plus de {limit} annotations de {tier} se chevauchent à la fois : {n} le font encore",
    ),
    (
        "another tier is called {name}, too; here it is {other}",
        "un autre acteur s’appelle aussi {name} ; ici c’est {other}",
    ),
    (
        "the specification {name} is another file and is not read; values are those of the elements",
        "la spécification {name} est un autre fichier et n’est pas lue ; les valeurs sont celles des éléments",
    ),
    (
        "the set {name} has no times; its {n} elements were left out",
        "l’ensemble {name} n’a pas de temps ; ses {n} éléments ont été laissés de côté",
    ),
    (
        "the head names {source}, too (<{name}>); import it by itself",
        "l’en-tête nomme aussi {source} (<{name}>) ; importez-le à part",
    ),
    (
        "the track {name} refers to {other}, and so to itself; its {n} elements were left out",
        "la piste {name} renvoie à {other}, et donc à elle-même ; ses {n} éléments ont été laissés de côté",
    ),
    (
        "the track {name} refers to {other}, which is not in the file; its {n} elements were left out",
        "la piste {name} renvoie à {other}, qui n’est pas dans le fichier ; ses {n} éléments ont été laissés de côté",
    ),
    (
        "the track {name} is of the type {kind}, which is not known; its elements are read by their times",
        "la piste {name} est du type {kind}, qui n’est pas connu ; ses éléments sont lus d’après leurs temps",
    ),
    (
        "element {index} of the track {name} refers to no element that was read and was left out",
        "l’élément {index} de la piste {name} ne renvoie à aucun élément lu et a été laissé de côté",
    ),
    (
        "element {index} of the track {name} has no time that can be read and was left out",
        "l’élément {index} de la piste {name} n’a pas de temps lisible et a été laissé de côté",
    ),
    (
        "the elements of the track {name} span those of {other}: they have their times, and no link to them",
        "les éléments de la piste {name} recouvrent ceux de {other} : ils en ont les temps, sans lien avec eux",
    ),
    (
        "the boundary at {time} on the track {name} is out of order; the elements beside it share their time evenly",
        "la limite à {time} sur la piste {name} n’est pas à sa place ; les éléments voisins se partagent le temps à parts égales",
    ),
    (
        "an element of the track {name} has the attribute {attribute} twice; both values are kept",
        "un élément de la piste {name} a deux fois l’attribut {attribute} ; les deux valeurs sont gardées",
    ),
    (
        "links to other elements are kept as texts, the track and the index: {n}",
        "des liens vers d’autres éléments sont gardés comme textes, la piste et l’indice : {n}",
    ),
    (
        "the time {text} of the point {id} is no number of seconds; it was left out",
        "le temps {text} du point {id} n’est pas un nombre de secondes ; il a été laissé de côté",
    ),
    (
        "the point {id} of the timeline is earlier than the one before it",
        "le point {id} de la ligne du temps est antérieur au précédent",
    ),
    (
        "no point of the timeline has a time: points lie a second apart now",
        "aucun point de la ligne du temps n’a de temps : les points sont maintenant à une seconde l’un de l’autre",
    ),
    (
        "align the transcription with its film in the Partitur Editor, and import it again",
        "alignez la transcription sur son film dans l’éditeur de partition, et importez-la de nouveau",
    ),
    (
        "points of the timeline without a time lie evenly between their neighbours: {n}",
        "des points de la ligne du temps sans temps sont à intervalles égaux entre leurs voisins : {n}",
    ),
    (
        "the event {text} of the tier {tier} lies between points that the timeline does not have; it was left out",
        "l’événement {text} de l’acteur {tier} est entre des points que la ligne du temps n’a pas ; il a été laissé de côté",
    ),
    (
        "an annotation of the utterance {id} has no times in milliseconds; it was left out",
        "une annotation de l’énoncé {id} n’a pas de temps en millisecondes ; elle a été laissée de côté",
    ),
    (
        "the coding scheme has no value {id} of the field {field}; the number is kept",
        "le schéma de codage n’a pas de valeur {id} du champ {field} ; le numéro est gardé",
    ),
    (
        "{evidence}, but another attribute has the glosses",
        "{evidence}, mais un autre attribut a les gloses",
    ),
    (
        "{evidence}; it is that of its track",
        "{evidence} ; c’est celui de sa piste",
    ),
    (
        "an .xml holds SiGML or a collection of SignStream: its root is <sigml> or <SIGNSTREAM-DATABASE>",
        "un .xml contient du SiGML ou une collection de SignStream : sa racine est <sigml> ou <SIGNSTREAM-DATABASE>",
    ),
    (
        "write its annotations as a table (.csv) with the columns tier, start_s, end_s and value",
        "écrivez ses annotations dans une table (.csv) avec les colonnes tier, start_s, end_s et value",
    ),
    (
        "import it in ELAN (File, Import), and save it as .eaf",
        "importez-le dans ELAN (Fichier, Importer), et enregistrez-le en .eaf",
    ),
    (
        "convert it with chat2elan in CLAN, and import the .eaf",
        "convertissez-le avec chat2elan dans CLAN, et importez le .eaf",
    ),
    (
        "give its name the ending .exb",
        "donnez à son nom la terminaison .exb",
    ),
    (
        "import the .anvil files that were made with it",
        "importez les fichiers .anvil faits avec elle",
    ),
    (
        "select each TextGrid of it in Praat, and save it as a file of its own",
        "sélectionnez-en chaque TextGrid dans Praat, et enregistrez-le dans un fichier à part",
    ),
    (
        "import the .exb that it was made from",
        "importez le .exb dont elle vient",
    ),
    (
        "export its events in BORIS as TextGrid, and import that",
        "exportez ses événements de BORIS en TextGrid, et importez celui-ci",
    ),
    (
        "convert them into .TextGrid or .eaf with the services of BAS, and import that",
        "convertissez-les en .TextGrid ou en .eaf avec les services du BAS, et importez le résultat",
    ),
    (
        "a transcription of EXMARaLDA",
        "une transcription d’EXMARaLDA",
    ),
    ("a specification of ANVIL", "une spécification d’ANVIL"),
    (
        "a download of SignStream collections, whose times have no stated unit",
        "un téléchargement de collections SignStream, dont les temps n’ont pas d’unité indiquée",
    ),
    (
        "a transcript of CLAN (CHAT)",
        "une transcription de CLAN (CHAT)",
    ),
    ("a transcript of CLAN", "une transcription de CLAN"),
    ("a collection of Praat", "une collection de Praat"),
    (
        "a segmented transcription of EXMARaLDA",
        "une transcription segmentée d’EXMARaLDA",
    ),
    (
        "a collection of SignStream 3",
        "une collection de SignStream 3",
    ),
    (
        "a transcript of Transcriber",
        "une transcription de Transcriber",
    ),
    ("a text of FLEx", "un texte de FLEx"),
    ("a project of BORIS", "un projet de BORIS"),
    (
        "annotations of BAS (Partitur)",
        "des annotations du BAS (Partitur)",
    ),
    ("a spreadsheet of Datavyu", "une feuille de Datavyu"),
    ("annotations of NOVA", "des annotations de NOVA"),
    ("a transcript of Transana", "une transcription de Transana"),
    ("a project of MAXQDA", "un projet de MAXQDA"),
    (
        "the path is not UTF-8, and as text it is that of another file: {path}",
        "le chemin n’est pas en UTF-8, et en texte c’est celui d’un autre fichier : {path}",
    ),
    (
        "it is no regular file, but a pipe, a socket or a device",
        "ce n’est pas un fichier ordinaire, mais un tube, une socket ou un périphérique",
    ),
    (
        "save what comes from it as a file, and import that",
        "enregistrez dans un fichier ce qui en vient, et importez-le",
    ),
];
