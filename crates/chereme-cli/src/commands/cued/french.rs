//! The French of `chereme cued`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Work with captured cued speech: markers, restoration, recognition, targets, phases, dictionary, slips",
            "Travailler sur la LfPC captée : marqueurs, restauration, reconnaissance, cibles, phases, dictionnaire, erreurs",
        ),
        (
            "A habit of the cuer, such as schwa-as-eu; may be repeated",
            "Une habitude du codeur, comme schwa-as-eu ; peut être répétée",
        ),
        (
            "A table of two columns: the program's name of a marker, and its label in the files",
            "Une table de deux colonnes : le nom d’un marqueur pour le programme, et son étiquette dans les fichiers",
        ),
        (
            "Report the known markers of a recording, and how often they are visible",
            "Donner les marqueurs connus d’un enregistrement, et la part des images où ils sont visibles",
        ),
        (
            "Restore hidden markers from models of hand and face, as a separate track with predicted errors",
            "Restaurer les marqueurs cachés d’après des modèles de la main et du visage, en une piste à part avec l’erreur prédite",
        ),
        (
            "The recordings whose markers are restored",
            "Les enregistrements dont les marqueurs sont restaurés",
        ),
        (
            "The recordings from which the models learn; without it those of the hand alone and of the face alone, or all",
            "Les enregistrements dont les modèles apprennent ; sinon ceux de la main seule et du visage seul, ou tous",
        ),
        (
            "The number of principal components of the hand's posture, from 1 to 25",
            "Le nombre de composantes principales de la posture de la main, de 1 à 25",
        ),
        (
            "Recognise shapes and placements at the targets of keys, with confusion tables",
            "Reconnaître configurations et emplacements aux cibles des clés, avec les tables de confusion",
        ),
        (
            "The recordings from which the recognisers learn; without it every second one",
            "Les enregistrements dont les reconnaisseurs apprennent ; sinon un sur deux",
        ),
        (
            "The recordings that are recognised; without it all others",
            "Les enregistrements reconnus ; sinon tous les autres",
        ),
        (
            "Find the movements, targets and gestural scores of keys",
            "Trouver les mouvements, les cibles et les partitions gestuelles des clés",
        ),
        ("The recordings", "Les enregistrements"),
        ("Write them as tiers", "Les écrire sur des acteurs"),
        (
            "Measure when hand and fingers start and arrive relative to the sounds, by kind of key",
            "Mesurer quand la main et les doigts partent et arrivent par rapport aux sons, par sorte de clé",
        ),
        (
            "List the movements between keys in captured takes, and those that a script needs in addition",
            "Énumérer les mouvements entre clés des prises captées, et ceux qu’il faut de plus pour un script",
        ),
        (
            "The script, a text with one sentence on each line: report how much of it the takes cover, and which sentences would add most",
            "Le script, un texte d’une phrase par ligne : dire quelle part en est couverte par les prises, et quelles phrases ajouteraient le plus",
        ),
        (
            "Compose a sentence from the dictionary, and recognise its keys as a check",
            "Composer une phrase à partir du dictionnaire, et en reconnaître les clés pour contrôle",
        ),
        (
            "The text, or phones with --phones",
            "Le texte, ou des phones avec --phones",
        ),
        (
            "The recordings from which the dictionary is cut",
            "Les enregistrements dont le dictionnaire est tiré",
        ),
        (
            "The cost of a duration that differs by 100 ms",
            "Le coût d’une durée qui diffère de 100 ms",
        ),
        (
            "The cost of a join whose ends differ by the spread within one key",
            "Le coût d’un raccord dont les bouts diffèrent de l’écart au sein d’une clé",
        ),
        (
            "The gloss of the new recording; without it nothing is stored",
            "La glose du nouvel enregistrement ; sans elle rien n’est enregistré",
        ),
        (
            "Compare the keys of a take with those that its phones or a text predict",
            "Comparer les clés d’une prise à celles que prédisent ses phones ou un texte",
        ),
        (
            "The text that was cued; without it the tier of phones predicts the keys",
            "Le texte codé ; sinon l’acteur des phones prédit les clés",
        ),
        (
            "Recognise the produced keys from the markers, even if a tier gives them",
            "Reconnaître les clés produites d’après les marqueurs, même si un acteur les donne",
        ),
        (
            "A take is a recording of a cuer's markers (C3D, TRC) with tiers called Phones or Keys from a TextGrid or EAF file of the same name. Markers are called FA1-5 on the forearm, HB1-7 on the back of the hand, I, M, R, L 1-8 on the fingers, T1-6 on the thumb; RF1-5, RN1-2, RE1-2 on forehead, nose and ears, LP1-16 on the lips, CK1-12 on the cheeks, JW1-8 on the jaw, TH1-18 on the throat. If the files use other labels, --labels names a table that maps them. Without a named recording the command works on all captured takes.",
            "Une prise est un enregistrement des marqueurs d’une personne qui code (C3D, TRC), avec des acteurs nommés Phones ou Keys d’un fichier TextGrid ou EAF du même nom. Les marqueurs s’appellent FA1-5 sur l’avant-bras, HB1-7 sur le dos de la main, I, M, R, L 1-8 sur les doigts, T1-6 sur le pouce ; RF1-5, RN1-2, RE1-2 sur le front, le nez et les oreilles, LP1-16 sur les lèvres, CK1-12 sur les joues, JW1-8 sur la mâchoire, TH1-18 sur la gorge. Si les fichiers ont d’autres étiquettes, --labels nomme une table de correspondance. Sans enregistrement nommé, la commande porte sur toutes les prises captées.",
        ),
        ("The recording", "L’enregistrement"),
        (
            "Report the errors and store nothing",
            "Donner les erreurs sans rien enregistrer",
        ),
    ],
    lines: &[
        (
            "{name}: {n} markers, {share} % of their positions visible; missing: {names}",
            "{name} : {n} marqueurs, {share} % de leurs positions visibles ; il manque {names}",
        ),
        (
            "{name}: {n} markers, {share} % of their positions visible; {missing} are missing",
            "{name} : {n} marqueurs, {share} % de leurs positions visibles ; il en manque {missing}",
        ),
        (
            "{name}: {n} markers, {share} % of their positions visible",
            "{name} : {n} marqueurs, {share} % de leurs positions visibles",
        ),
        (
            "{n} frames at {rate} a second; {hidden} hidden places restored",
            "{n} images à {rate} par seconde ; positions cachées restaurées : {hidden}",
        ),
        (
            "nothing was stored; --store writes tiers",
            "rien n’a été enregistré ; --store écrit des acteurs",
        ),
        (
            "nothing was stored; --as GLOSS stores it",
            "rien n’a été enregistré ; --as GLOSE l’enregistre",
        ),
        (
            "{what} recognised after training on {other}",
            "reconnu : {what}, appris sur {other}",
        ),
        (
            "the recognisers were tested on the keys from which they learned",
            "la reconnaissance a été éprouvée sur les clés dont elle a appris",
        ),
        (
            "{n} movements from {recordings}: {found} of {all} pairs of keys; components miss markers by {mm} mm",
            "mouvements de {recordings} : {n} ; paires de clés : {found} sur {all} ; les composants manquent les marqueurs de {mm} mm",
        ),
        (
            "the script: {n} sentences, {pairs} pairs, {share} % of them in the dictionary; {missing} different ones are missing",
            "le script : {n} phrases, {pairs} paires, dont {share} % dans le dictionnaire ; différentes qui manquent : {missing}",
        ),
        (
            "{n} keys predicted by {code}, {produced} produced ({rate}); {same} as predicted",
            "clés prévues par {code} : {n}, produites : {produced} ({rate}), comme prévu : {same}",
        ),
        (
            "{name}: {share} % right; shown in rows, recognised in columns",
            "{name} : {share} % justes ; montrées en lignes, reconnues en colonnes",
        ),
        (
            "{n} keys in {seconds} s: {exact} exact, {others} stand in for others, {synthetic} synthetic; cost {cost}",
            "clés en {seconds} s : {n}, dont exactes : {exact}, à la place d’autres : {others}, synthétiques : {synthetic} ; coût {cost}",
        ),
        (
            "read back: {shapes} % of shapes, {placements} % of placements",
            "relu : {shapes} % des formes, {placements} % des emplacements",
        ),
        ("stored as {name}", "enregistré sous {name}"),
    ],
    titles: &[
        ("adds", "ajoute"),
        ("arrives ms", "arrive ms"),
        (
            "begins ms: median (quartiles)",
            "part ms : médiane (quartiles)",
        ),
        ("duration", "durée"),
        ("face_mm", "visage_mm"),
        ("fingers", "doigts"),
        ("first source", "première source"),
        ("hand_axis_mm", "axe_main_mm"),
        ("hand_mm", "main_mm"),
        ("hidden", "cachés"),
        ("instead", "à la place"),
        ("join", "raccord"),
        ("line", "ligne"),
        ("pair", "paire"),
        ("part", "partie"),
        ("predicted", "prévu"),
        ("produced", "produit"),
        ("read back", "relu"),
        ("restored", "restaurés"),
        ("sentence", "phrase"),
        ("share", "part"),
        ("slip", "erreur"),
        ("source", "source"),
        ("uncertain", "incertains"),
        ("wanted", "voulu"),
    ],
};
