//! French forms of messages about recipes and the movement that they generate, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const COMPOSING: &[(&str, &str)] = &[
    ("the name of the sign is empty", "le nom du signe est vide"),
    (
        "the name of the alphabet is empty",
        "le nom de l’alphabet est vide",
    ),
    (
        "the name of the signer is empty",
        "le nom du signeur est vide",
    ),
    ("the name of the code is empty", "le nom du code est vide"),
    (
        "the name of the body language is empty",
        "le nom du langage corporel est vide",
    ),
    ("the word is empty", "le mot est vide"),
    ("the value is empty", "la valeur est vide"),
    ("the query is empty", "la requête est vide"),
    ("there is nothing to cue", "il n’y a rien à coder"),
    ("nothing is notated", "rien n’est noté"),
    (
        "phones are written as sampa, ipa or mfa",
        "les phones s’écrivent en sampa, ipa ou mfa",
    ),
    (
        "one hand cues: name right, left, dominant or weak",
        "une seule main code : nommez right, left, dominant ou weak",
    ),
    (
        "it ends before it begins; write the earlier time first, such as 0.4s..1.9s",
        "cela finit avant de commencer ; écrivez d’abord le premier temps, comme 0.4s..1.9s",
    ),
    (
        "the directions are missing, too many, or cancel out",
        "les directions manquent, sont trop nombreuses, ou s’annulent",
    ),
    (
        "this recipe is of version {n}; this program reads version 1, so a newer one is needed",
        "cette recette est de la version {n} ; ce programme lit la version 1, il en faut un plus récent",
    ),
    (
        "{step}: {what} is {found}; it must lie between {least} and {most}",
        "{step} : {what} est {found} ; il faut une valeur entre {least} et {most}",
    ),
    (
        "a recipe has at most {most} {what}; split it and store the parts as signs",
        "une recette a au plus {most} {what} ; divisez-la et enregistrez les parties comme signes",
    ),
    ("sources and operators", "sources et opérateurs"),
    ("letters in a word", "lettres dans un mot"),
    ("character {n}: {why}", "caractère {n} : {why}"),
    (
        "the text ends where {what} was expected",
        "le texte finit là où il fallait : {what}",
    ),
    (
        "{found} stands where {what} was expected",
        "{found} se trouve là où il fallait : {what}",
    ),
    ("this {sign} is never closed", "{sign} n’est jamais fermé"),
    (
        "the query is not understood: {why}",
        "la requête ne se comprend pas : {why}",
    ),
    (
        "the query {query} is not understood: {why}",
        "la requête {query} ne se comprend pas : {why}",
    ),
    (
        "the text is longer than {n} bytes",
        "le texte dépasse {n} octets",
    ),
    (
        "parentheses are nested deeper than {n}",
        "il y a plus de {n} parenthèses les unes dans les autres",
    ),
    ("the evaluation was stopped", "l’évaluation a été arrêtée"),
    (
        "the corpus has no captured keys with the tier Hand M1 M2",
        "le corpus n’a pas de clés captées avec l’acteur Hand M1 M2",
    ),
    (
        "the body language {name} cannot be used: {why}",
        "le langage corporel {name} ne peut pas servir : {why}",
    ),
    (
        "the body language cannot be used: {why}",
        "le langage corporel ne peut pas servir : {why}",
    ),
    (
        "this skeleton has no {side} arm (shoulder, elbow, wrist)",
        "ce squelette n’a pas de bras (épaule, coude, poignet) de ce côté : {side}",
    ),
    (
        "the {side} hand has no fingers in this skeleton",
        "la main {side} n’a pas de doigts dans ce squelette",
    ),
    (
        "there is no head in this skeleton",
        "ce squelette n’a pas de tête",
    ),
    (
        "the target is {cm} cm away from the {side} shoulder, and the arm is {long} cm long",
        "la cible est à {cm} cm de l’épaule ({side}), et le bras mesure {long} cm",
    ),
    (
        "{given} values are given, but the {side} hand holds {held} one after another",
        "{given} valeurs sont données, mais la main {side} en a {held} à la suite",
    ),
    (
        "{given} paces are given, but the sign has {phases} phases",
        "{given} allures sont données, mais le signe a {phases} phases",
    ),
    (
        "no sign with movement holds {value}, and its inventory gives no {what} for it",
        "aucun signe avec mouvement n’a {value}, et son inventaire n’en donne rien de tel : {what}",
    ),
    (
        "the query {query} finds no sign with movement",
        "la requête {query} ne trouve aucun signe avec mouvement",
    ),
    (
        "{address} shows no {what} to take",
        "{address} ne montre rien de tel à prendre : {what}",
    ),
    (
        "the movement lasts {length} s, so that nothing of it is left",
        "le mouvement dure {length} s : il n’en reste rien",
    ),
    (
        "{cm} cm in {time} s is faster than any arm",
        "{cm} cm en {time} s, aucun bras n’est aussi rapide",
    ),
    (
        "leave the time out, or give it {time} s or more",
        "omettez le temps, ou donnez-lui {time} s ou plus",
    ),
    (
        "the two pieces do not meet: {what} would leap by {distance} m, at {speed} m/s",
        "les deux morceaux ne se rejoignent pas : {what} sauterait de {distance} m, à {speed} m/s",
    ),
    (
        "too fast: {speed} m/s at {part}, {added} m/s more than before, and at most {most} m/s can be added",
        "trop rapide : {speed} m/s pour {part}, {added} m/s de plus qu’avant, et {most} m/s de plus au maximum",
    ),
    (
        "give it more time, or cut wrong first or last frames off before (`| trim`)",
        "donnez-lui plus de temps, ou coupez avant les premières ou dernières images fausses (`| trim`)",
    ),
    ("\"{name}\" has no frames", "\"{name}\" n’a pas d’images"),
    (
        "the result would have {frames} frames, and at most {most} can be generated for this skeleton",
        "le résultat aurait {frames} images, et on peut en produire au plus {most} pour ce squelette",
    ),
    (
        "the corpus shows too few transitions to learn their course from",
        "le corpus montre trop peu de transitions pour en apprendre le déroulement",
    ),
    (
        "{address} has changed since this sign was generated",
        "{address} a changé depuis que ce signe a été composé",
    ),
    (
        "the stored inputs lack what this step needs",
        "il manque aux données enregistrées ce que demande cette étape",
    ),
    (
        "the result is not a valid movement: {why}",
        "le résultat n’est pas un mouvement valable : {why}",
    ),
    ("resolve the recipe again", "résolvez de nouveau la recette"),
    (
        "name its joints in a roles file, or use a recording that has one",
        "nommez ses articulations dans un fichier de rôles, ou prenez un enregistrement qui en a un",
    ),
    (
        "move it nearer by {cm} cm or more",
        "rapprochez-la de {cm} cm ou plus",
    ),
    ("give 1 or {n}", "donnez-en 1 ou {n}"),
    ("generate it again", "composez-le de nouveau"),
    ("generate the sign again", "composez de nouveau le signe"),
    (
        "name another rule: paper, attina, sppas or duchnowski",
        "nommez une autre règle : paper, attina, sppas ou duchnowski",
    ),
    (
        "use a recording of the hands, or name its joints in a roles file",
        "prenez un enregistrement des mains, ou nommez ses articulations dans un fichier de rôles",
    ),
    (
        "name its joint in a roles file",
        "nommez son articulation dans un fichier de rôles",
    ),
    (
        "choose another value, or annotate a sign that has it",
        "choisissez une autre valeur, ou annotez un signe qui l’a",
    ),
    ("choose another sign", "choisissez un autre signe"),
    ("loosen it", "assouplissez-la"),
    ("name times within it", "nommez des temps qui s’y trouvent"),
    (
        "cut wrong first or last frames off (`| trim`, or `| span 0.2s..1.5s`), or give the transition more time (`then via 0.4s`, `repeat 2 gap 0.3s`)",
        "coupez les premières ou dernières images fausses (`| trim`, ou `| span 0.2s..1.5s`), ou donnez plus de temps à la transition (`then via 0.4s`, `repeat 2 gap 0.3s`)",
    ),
    (
        "name a recording with movement",
        "nommez un enregistrement avec un mouvement",
    ),
    (
        "make it shorter, or in several signs",
        "faites-le plus court, ou en plusieurs signes",
    ),
    (
        "import captured movement, or use sigmoid",
        "importez du mouvement capté, ou prenez sigmoid",
    ),
    (
        "a recipe needs \"version\"",
        "une recette demande \"version\"",
    ),
    (
        "a recipe needs \"make\", its tree",
        "une recette demande \"make\", son arbre",
    ),
    (
        "unknown field {name}; a recipe has version and make",
        "champ inconnu {name} ; une recette a version et make",
    ),
    (
        "{name} holds one thing, but {first} and {second} are given; leave one out",
        "{name} contient une chose, mais {first} et {second} sont donnés ; ôtez-en une",
    ),
    (
        "a recipe's tree has only strings, lists and objects with string keys",
        "l’arbre d’une recette n’a que des textes, des listes et des objets à clés de texte",
    ),
    (
        "the body of {name} has no arm with shoulder, elbow and wrist",
        "le corps de {name} n’a pas de bras avec épaule, coude et poignet",
    ),
    (
        "the movement would last {seconds} s; at most {most} s can be generated at once",
        "le mouvement durerait {seconds} s ; on peut en produire au plus {most} s d’un coup",
    ),
    (
        "name them in a roles file",
        "nommez-les dans un fichier de rôles",
    ),
    ("animate its signs one by one", "animez ses signes un à un"),
    (
        "the hands remain {cm} cm deep in each other",
        "les mains restent l’une dans l’autre de {cm} cm",
    ),
    (
        "the hands would go through each other at {time} s: each moves {cm} cm aside",
        "les mains se traverseraient à {time} s : chacune s’écarte de {cm} cm",
    ),
    (
        "the {side} hand would go through the head at {time} s: it moves {cm} cm aside",
        "la main {side} traverserait la tête à {time} s : elle s’écarte de {cm} cm",
    ),
    (
        "movements are turned by {angle} and shortened by {share} %, so that the arm stays comfortable",
        "les mouvements sont tournés de {angle} et raccourcis de {share} %, pour que le bras reste à l’aise",
    ),
    (
        "movements are turned by {angle}, so that the arm stays comfortable",
        "les mouvements sont tournés de {angle}, pour que le bras reste à l’aise",
    ),
    (
        "movements are shortened by {share} %, so that the arm stays comfortable",
        "les mouvements sont raccourcis de {share} %, pour que le bras reste à l’aise",
    ),
    (
        "the {side} hand stays {cm} cm short of its contact",
        "il manque {cm} cm à la main {side} pour son contact",
    ),
    (
        "the {side} hand stays up to {cm} cm off its path",
        "la main {side} reste jusqu’à {cm} cm à côté de son trajet",
    ),
    (
        "the {side} hand is turned up to {angle} less than written: {why}",
        "la main {side} est tournée jusqu’à {angle} de moins qu’il n’est écrit : {why}",
    ),
    (
        "the {side} hand's circle is moved {cm} cm, so that it stays out of the trunk",
        "le cercle de la main {side} est déplacé de {cm} cm, pour qu’il reste hors du tronc",
    ),
    (
        "the {side} hand was moved {cm} cm out of the trunk",
        "la main {side} a été écartée du tronc de {cm} cm",
    ),
    (
        "the {side} hand touches with the part in front of the named one",
        "la main {side} touche avec la partie qui est devant celle qui est nommée",
    ),
    (
        "movements of the body in place of a hand are annotated, not animated",
        "les mouvements du corps à la place d’une main s’annotent, ils ne s’animent pas",
    ),
    (
        "the notation asks for another speed than can be performed: {used} times the usual one is used",
        "la notation demande une vitesse qui ne peut être exécutée : {used} fois la vitesse habituelle est prise",
    ),
    (
        "{gloss} lasts {lasts} s, and its notation asks for {asked} s",
        "{gloss} dure {lasts} s, et sa notation demande {asked} s",
    ),
    (
        "the animator does not know these non-manuals: {names}",
        "l’animateur ne connaît pas ces non-manuels : {names}",
    ),
    (
        "the wrist bends no farther",
        "le poignet ne se plie pas plus",
    ),
    (
        "the forearm turns no farther",
        "l’avant-bras ne tourne pas plus",
    ),
    ("the arm does not reach", "le bras n’y arrive pas"),
    ("the trunk is in the way", "le tronc est dans le chemin"),
    ("there is no time for it", "il n’y a pas le temps"),
    (
        "{point} touched {place} at {time}; it is now {cm} cm away, having moved {by} cm against it",
        "{point} touchait {place} à {time} ; c’est maintenant à {cm} cm, après un déplacement de {by} cm",
    ),
    (
        "{point} touched {place} at {time}; now {other} is {cm} cm away from {there}",
        "{point} touchait {place} à {time} ; maintenant {other} est à {cm} cm de {there}",
    ),
    (
        "{point} touched {place} at {time}; it comes to {cm} cm of it at the nearest",
        "{point} touchait {place} à {time} ; il en approche à {cm} cm au plus",
    ),
    (
        "the course was learned from {what}",
        "le déroulement a été appris de {what}",
    ),
    (
        "the fingertip comes within {mm} mm of the lips at {time}; they should be {least} mm free",
        "le bout du doigt vient à {mm} mm des lèvres à {time} ; il devrait les laisser libres de {least} mm",
    ),
    (
        "the fingertip stays {mm} mm or more outside the lips",
        "le bout du doigt reste à {mm} mm ou plus des lèvres",
    ),
    (
        "operators left out, as they cancel out or become one: {n}",
        "opérateurs laissés de côté, car ils s’annulent ou n’en font qu’un : {n}",
    ),
    (
        "{step}: a wrist is moved by {cm} cm so that {point} and {place} touch",
        "{step} : un poignet est déplacé de {cm} cm pour que {point} et {place} se touchent",
    ),
    (
        "both hands cannot be at {value}: it moves with them",
        "les deux mains ne peuvent pas être ici : {value} bouge avec elles",
    ),
    (
        "name one hand, such as {command}",
        "nommez une seule main, comme {command}",
    ),
    (
        "{address} has no movement of hands: {what}",
        "{address} n’a pas de mouvement des mains : {what}",
    ),
    ("its skeleton has no arms", "son squelette n’a pas de bras"),
    ("it shows a face only", "on n’y voit qu’un visage"),
    (
        "all joints of its arms and fingers stand still",
        "aucune articulation des bras ni des doigts ne bouge",
    ),
    (
        "name a sign in which a hand moves",
        "nommez un signe dont une main bouge",
    ),
    (
        "{address} is a signer, and a body is written signer:NAME or recording:NAME",
        "{address} est un signeur, et un corps s’écrit signer:NOM ou recording:NOM",
    ),
    (
        "{address} is a recording, and a body is written signer:NAME or recording:NAME",
        "{address} est un enregistrement, et un corps s’écrit signer:NOM ou recording:NOM",
    ),
    (
        "{address} is a sign, and a body is written signer:NAME or recording:NAME",
        "{address} est un signe, et un corps s’écrit signer:NOM ou recording:NOM",
    ),
    (
        "{address} is a signer without a recording that moves, and a body is written signer:NAME or recording:NAME",
        "{address} est un signeur sans enregistrement de mouvement, et un corps s’écrit signer:NOM ou recording:NOM",
    ),
    (
        "{address} is a signer, and the movement of a sign or a recording is wanted",
        "{address} est un signeur, et il faut le mouvement d’un signe ou d’un enregistrement",
    ),
    (
        "{address} is a signer, and notation is wanted",
        "{address} est un signeur, et il faut une notation",
    ),
    (
        "{address} is a recording, and notation is wanted",
        "{address} est un enregistrement, et il faut une notation",
    ),
    (
        "{address} is in a recording without a skeleton, and the movement of a skeleton is wanted",
        "{address} est dans un enregistrement sans squelette, et il faut le mouvement d’un squelette",
    ),
    ("write {address} instead", "écrivez plutôt {address}"),
    (
        "reaching takes {time} s",
        "atteindre la cible prend {time} s",
    ),
    (
        "{step}: up to {speed} m/s at {part}, {added} m/s more than before",
        "{step} : jusqu’à {speed} m/s pour {part}, {added} m/s de plus qu’avant",
    ),
    (
        "{step}: a hand stays up to {cm} cm from its target",
        "{step} : une main reste jusqu’à {cm} cm de sa cible",
    ),
    ("no path is given", "aucun trajet n’est donné"),
    ("it has no milestones", "il n’a pas de jalons"),
    (
        "{address} is not in the corpus",
        "{address} n’est pas dans le corpus",
    ),
    (
        "{address} could be any of {names}",
        "{address} peut être n’importe lequel de {names}",
    ),
    (
        "{address} has no movement: it is an entry of a lexicon",
        "{address} n’a pas de mouvement : c’est une entrée d’un lexique",
    ),
    (
        "{address} has no expression of the face to transfer: {why}",
        "{address} n’a pas d’expression du visage à transférer : {why}",
    ),
    (
        "{text} is no {component} of any inventory",
        "{text} n’est dans aucun inventaire de {component}",
    ),
    (
        "{name} is no manual alphabet",
        "{name} n’est pas un alphabet manuel",
    ),
    (
        "{letter} is no letter of the manual alphabet {alphabet}",
        "{letter} n’est pas une lettre de l’alphabet manuel {alphabet}",
    ),
    (
        "the corpus cannot be read: {why}",
        "le corpus ne se lit pas : {why}",
    ),
    (
        "name a sign that was captured or generated",
        "nommez un signe qui a été capté ou composé",
    ),
    (
        "import it as SiGML or HamNoSys, or write it from its movement: {command}",
        "importez-le en SiGML ou en HamNoSys, ou écrivez-le d’après son mouvement : {command}",
    ),
    ("spell with {known} only", "épelez avec {known} seulement"),
    (
        "{text} is no number with a unit, such as {example}",
        "{text} n’est pas un nombre avec une unité, comme {example}",
    ),
    (
        "{text} has {found}; write one of {units}",
        "{text} a {found} ; écrivez l’une de {units}",
    ),
    ("the unknown unit {unit}", "l’unité inconnue {unit}"),
    (
        "the code {code} has no table of durations",
        "le code {code} n’a pas de table de durées",
    ),
    (
        "give each phone its milliseconds, such as h=80 aU=240, or leave the pace out",
        "donnez à chaque phone ses millisecondes, comme h=80 aU=240, ou laissez l’allure de côté",
    ),
    (
        "phone {n} {label} is not in the code {code}; it has no key",
        "le phone {n} {label} n’est pas dans le code {code} ; il n’a pas de clé",
    ),
    (
        "phone {n} {label} begins before the phone before it ends",
        "le phone {n} {label} commence avant la fin du précédent",
    ),
    (
        "{letter} in {word} is silent: no rule of pronunciation knows it",
        "{letter} dans {word} est muet : aucune règle de prononciation ne le connaît",
    ),
    (
        "{text} was left out; write it in words",
        "{text} a été laissé de côté ; écrivez-le en toutes lettres",
    ),
    ("\"|\", \"then\" or the end", "\"|\", \"then\" ou la fin"),
    (
        "the symbols of a sign, in quotes",
        "les symboles d’un signe, entre guillemets",
    ),
    (
        "a SiGML file or a notated sign",
        "un fichier SiGML ou un signe noté",
    ),
    (
        "a sign, \"spell\", \"point\" or \"(\"",
        "un signe, \"spell\", \"point\" ou \"(\"",
    ),
    (
        "\"default\", \"measured\" or a file of body language",
        "\"default\", \"measured\" ou un fichier de langage corporel",
    ),
    ("the word to spell", "le mot à épeler"),
    ("the factor", "le facteur"),
    ("the angle", "l’angle"),
    ("the number of times", "le nombre de fois"),
    ("the time", "le temps"),
    (
        "the text to cue, in quotes",
        "le texte à coder, entre guillemets",
    ),
    (
        "an alphabet: sampa, ipa or mfa",
        "un alphabet : sampa, ipa ou mfa",
    ),
    ("a code, such as french", "un code, comme french"),
    (
        "a habit of cuers, such as schwa-as-eu",
        "une habitude de codeur, comme schwa-as-eu",
    ),
    ("a rule of phases", "une règle de phases"),
    ("a hand or \"at\"", "une main ou \"at\""),
    (
        "a value, \"from\" and a sign, \"best(...)\" or \"_\"",
        "une valeur, \"from\" et un signe, \"best(...)\" ou \"_\"",
    ),
    (
        "me, you, a direction, a placement, or a point such as 30cm,140cm,50cm",
        "me, you, une direction, un emplacement, ou un point comme 30cm,140cm,50cm",
    ),
    (
        "a comma: a point has three lengths",
        "une virgule : un point a trois longueurs",
    ),
    (
        "a direction (left, right, up, down, forward, back)",
        "une direction (left, right, up, down, forward, back)",
    ),
    (
        "slerp, cosine, sigmoid, minimum-jerk, learned, or a time such as 0.2s",
        "slerp, cosine, sigmoid, minimum-jerk, learned, ou un temps comme 0.2s",
    ),
    (
        "two times with two dots between, such as 0.4s..1.9s",
        "deux temps avec deux points entre eux, comme 0.4s..1.9s",
    ),
    (
        "a point: left, up and forward, such as 10cm,5cm,0cm",
        "un point : gauche, haut et avant, comme 10cm,5cm,0cm",
    ),
    ("\"from\" and a sign", "\"from\" et un signe"),
    ("a point of the hand", "un point de la main"),
    ("a factor, such as {example}", "un facteur, comme {example}"),
    ("a time, such as {example}", "un temps, comme {example}"),
    (
        "a length, such as {example}",
        "une longueur, comme {example}",
    ),
    ("the length in metres", "la longueur en mètres"),
    ("the share of the arm", "la part du bras"),
    ("the transition's time", "la durée de la transition"),
    ("did you mean {name}?", "vouliez-vous dire {name} ?"),
    ("the body moves: {what}", "le corps bouge : {what}"),
    (
        "notation of {gloss}: {what}",
        "notation de {gloss} : {what}",
    ),
    (
        "{what} {time} s, the median of {n} in the corpus",
        "{what} {time} s, la médiane de {n} dans le corpus",
    ),
    (
        "{what} {time} s: the corpus shows too few to learn from",
        "{what} {time} s : le corpus en montre trop peu pour apprendre",
    ),
    ("letters are held for", "les lettres sont tenues"),
    (
        "from letter to letter it takes",
        "d’une lettre à l’autre il faut",
    ),
    (
        "measured on {pairs} pairs, {vowels} vowels and {consonants} consonants alone",
        "mesuré sur {pairs} paires, {vowels} voyelles et {consonants} consonnes seules",
    ),
];
