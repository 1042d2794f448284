//! French forms of messages about perceptual studies, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const STUDIES: &[(&str, &str)] = &[
    (
        "`chereme study show CORPUS NAME --json` prints the plan of a study to begin with",
        "`chereme study show CORPUS NOM --json` affiche le plan d’une étude pour commencer",
    ),
    ("the plan is too large", "le plan est trop grand"),
    (
        "the plan cannot be read: {error}",
        "le plan ne peut pas être lu : {error}",
    ),
    (
        "the format of a plan is {name}",
        "le format d’un plan est {name}",
    ),
    (
        "the plan is of version {n}; this program reads version {own}",
        "le plan est de version {n} ; ce programme lit la version {own}",
    ),
    ("a study needs a name", "une étude a besoin d’un nom"),
    (
        "a study needs at least one trial that is analysed",
        "une étude a besoin d’au moins un essai qui soit analysé",
    ),
    ("a study needs trials", "une étude a besoin d’essais"),
    (
        "a study needs a question",
        "une étude a besoin d’une question",
    ),
    (
        "ask one with --ask realism",
        "posez-en une avec --ask realism",
    ),
    (
        "name --items and at least one --condition, or a table of trials with --trials FILE",
        "nommez --items et au moins une --condition, ou un tableau d’essais avec --trials FICHIER",
    ),
    (
        "a study has 1 to {n} questions",
        "une étude a de 1 à {n} questions",
    ),
    (
        "a study has at most {n} trials",
        "une étude a au plus {n} essais",
    ),
    ("a design has 1 to {n} blocks", "un plan a de 1 à {n} blocs"),
    (
        "a participant would see {n} films; {most} are the most",
        "un participant verrait {n} films ; {most} sont le maximum",
    ),
    (
        "each question needs a name of its own: {name}",
        "chaque question a besoin d’un nom à elle : {name}",
    ),
    (
        "each option needs a name of its own: {name}",
        "chaque option a besoin d’un nom à elle : {name}",
    ),
    (
        "a scale has 2 to {n} answers",
        "une échelle a de 2 à {n} réponses",
    ),
    (
        "a choice has 2 to {n} options",
        "un choix a de 2 à {n} options",
    ),
    (
        "a label stands at a number beyond the scale",
        "un libellé porte un nombre hors de l’échelle",
    ),
    (
        "{name} is no name of a picture in the folder media",
        "{name} n’est pas le nom d’une image du dossier media",
    ),
    (
        "a trial needs an item and a clip",
        "un essai a besoin d’un élément et d’un extrait",
    ),
    (
        "{item} stands twice with the condition {name}; answers could not be told apart",
        "{item} figure deux fois avec la condition {name} ; les réponses seraient confondues",
    ),
    (
        "nothing is asked about {item}",
        "rien n’est demandé sur {item}",
    ),
    (
        "{name} is a scale, which has no right answer",
        "{name} est une échelle, qui n’a pas de bonne réponse",
    ),
    (
        "fill in both cells, or remove the row",
        "remplissez les deux cases, ou retirez la ligne",
    ),
    ("a measure is no number", "une mesure n’est pas un nombre"),
    (
        "the plan has no question about the participant {name}",
        "le plan n’a pas de question sur le participant {name}",
    ),
    (
        "the plan has no question {name}",
        "le plan n’a pas de question {name}",
    ),
    (
        "the plan has no part {name}",
        "le plan n’a pas de partie {name}",
    ),
    (
        "the plan has no option {name}",
        "le plan n’a pas d’option {name}",
    ),
    (
        "the plan has no measure {name}",
        "le plan n’a pas de mesure {name}",
    ),
    ("it has: {names}", "il a : {names}"),
    (
        "alpha lies between 0 and 1",
        "alpha est compris entre 0 et 1",
    ),
    (
        "the largest difference lies between 0 and 1",
        "la plus grande différence est comprise entre 0 et 1",
    ),
    (
        "at least two groups are compared",
        "on compare au moins deux groupes",
    ),
    (
        "{question} is asked about no trial among {names}",
        "{question} n’est posée pour aucun essai parmi {names}",
    ),
    (
        "two groups have the same trials",
        "deux groupes ont les mêmes essais",
    ),
    (
        "people have answered the study {name}, so that its plan cannot change",
        "des personnes ont répondu à l’étude {name}, son plan ne peut donc plus changer",
    ),
    (
        "give the new plan another name",
        "donnez un autre nom au nouveau plan",
    ),
    (
        "no participant has the code {code}",
        "aucun participant n’a le code {code}",
    ),
    (
        "`chereme study answers CORPUS NAME` lists the codes",
        "`chereme study answers CORPUS NOM` donne la liste des codes",
    ),
    ("there is no study {name}", "il n’y a pas d’étude {name}"),
    ("a question needs a name", "une question a besoin d’un nom"),
    (
        "write a name, and for other answers than the usual scale = and the ends of a scale or the options: realism=1-7, gloss=items, place=left right",
        "écrivez un nom et, pour d’autres réponses que l’échelle usuelle, = et les bouts d’une échelle ou les options : realism=1-7, gloss=items, place=gauche droite",
    ),
    (
        "no question has the option {name}, which is to be right",
        "aucune question n’a l’option {name}, qui doit être la bonne",
    ),
    (
        "name the option in the question, or leave the cell empty",
        "nommez l’option dans la question, ou laissez la case vide",
    ),
    (
        "the columns are item, condition, clip, and if wished role, part, answer, and measures in numbers",
        "les colonnes sont item, condition, clip et, si l’on veut, role, part, answer, et des mesures en nombres",
    ),
    (
        "{text} is no role of a trial",
        "{text} n’est pas un rôle d’essai",
    ),
    (
        "the roles are training, main and check",
        "les rôles sont training, main et check",
    ),
    (
        "{text} in the column {name} is no number",
        "{text} dans la colonne {name} n’est pas un nombre",
    ),
    (
        "{text} in the column {name} cannot be read",
        "{text} dans la colonne {name} ne peut pas être lu",
    ),
    (
        "columns beside item, condition, clip, role, part and answer are measures of the clip",
        "les colonnes autres que item, condition, clip, role, part et answer sont des mesures de l’extrait",
    ),
    (
        "the table has no column {name}",
        "le tableau n’a pas de colonne {name}",
    ),
    (
        "a map of columns has no column {name}",
        "une description de colonnes n’a pas de colonne {name}",
    ),
    (
        "its columns are column, item, condition, part, role, question, means and values",
        "ses colonnes sont column, item, condition, part, role, question, means et values",
    ),
    (
        "the row names no column of the answers",
        "la ligne ne nomme aucune colonne des réponses",
    ),
    (
        "{before} and this column answer the same question",
        "{before} et cette colonne répondent à la même question",
    ),
    (
        "the map has no column of participants",
        "la description n’a pas de colonne des participants",
    ),
    (
        "add a row with `participant` under `means`",
        "ajoutez une ligne avec `participant` sous `means`",
    ),
    (
        "no question about participants is called {name}; did you mean {near}?",
        "aucune question sur les participants ne s’appelle {name} ; vouliez-vous dire {near} ?",
    ),
    (
        "no question about participants is called {name}",
        "aucune question sur les participants ne s’appelle {name}",
    ),
    (
        "{word} is no meaning of a column",
        "{word} n’est pas le sens d’une colonne",
    ),
    (
        "the meanings are participant, language, started_day, finished, profile.NAME and consent.NAME",
        "les sens sont participant, language, started_day, finished, profile.NOM et consent.NOM",
    ),
    (
        "`chereme study show CORPUS NAME` lists the trials",
        "`chereme study show CORPUS NOM` liste les essais",
    ),
    (
        "{pair} does not say what it stands for",
        "{pair} ne dit pas ce qu’il représente",
    ),
    (
        "write codes and their values as `A1=left; A2=right`",
        "écrivez les codes et leurs valeurs comme `A1=left; A2=right`",
    ),
    (
        "the map names a column that the table does not have: {name}; did you mean {near}?",
        "la description nomme une colonne que le tableau n’a pas : {name} ; vouliez-vous dire {near} ?",
    ),
    (
        "the map names a column that the table does not have: {name}",
        "la description nomme une colonne que le tableau n’a pas : {name}",
    ),
    (
        "{text} in the column {name} is no answer to {question}; it was left out",
        "{text} dans la colonne {name} n’est pas une réponse à {question} ; elle a été laissée de côté",
    ),
    (
        "say in the map what it stands for, under `values`, as `A1=left; A2=right`",
        "dites dans la description ce qu’il représente, sous `values`, comme `A1=left; A2=right`",
    ),
    (
        "the table cannot be read: {error}",
        "le tableau ne peut pas être lu : {error}",
    ),
    (
        "the row has {n} cells, and there are {titles} titles",
        "la ligne a {n} cases, et il y a {titles} titres",
    ),
    (
        "put a cell that holds the separator into double quotes",
        "mettez entre guillemets doubles une case qui contient le séparateur",
    ),
    (
        "the table has more than {n} columns",
        "le tableau a plus de {n} colonnes",
    ),
    (
        "the table has more than {n} cells",
        "le tableau a plus de {n} cases",
    ),
    (
        "the table has two columns {name}",
        "le tableau a deux colonnes {name}",
    ),
    (
        "give each column a title of its own",
        "donnez à chaque colonne un titre à elle",
    ),
    (
        "{question} was answered more often than {item} ({condition}) is shown",
        "{question} a eu plus de réponses que {item} ({condition}) n’est montré",
    ),
    (
        "another participant has the code {code}, whose answers stay: the seeds are {a} and {b}",
        "un autre participant a le code {code}, et ses réponses restent : les graines sont {a} et {b}",
    ),
    (
        "if they are two people, write another code into this file; if not, delete the earlier answers with `chereme study forget CORPUS NAME CODE`; then import again",
        "si ce sont deux personnes, écrivez un autre code dans ce fichier ; sinon supprimez les premières réponses avec `chereme study forget CORPUS NOM CODE` ; puis importez de nouveau",
    ),
    (
        "the table has more than {n} rows",
        "le tableau a plus de {n} lignes",
    ),
    (
        "a table of answers has one answer in each row, under the names of the answers' JSON; one with a participant in each row needs --columns",
        "un tableau de réponses a une réponse par ligne, sous les noms du JSON des réponses ; un tableau avec un participant par ligne demande --columns",
    ),
    (
        "there are no files of answers",
        "il n’y a pas de fichiers de réponses",
    ),
    (
        "answers are files that end in .json or .csv",
        "les réponses sont des fichiers qui finissent par .json ou .csv",
    ),
    (
        "folders lie more than {n} deep inside each other",
        "des dossiers sont emboîtés sur plus de {n} niveaux",
    ),
    (
        "name the folder that holds the answers",
        "nommez le dossier qui contient les réponses",
    ),
    (
        "there are more than {n} files",
        "il y a plus de {n} fichiers",
    ),
    (
        "the file is no chereme-answers, but {format}",
        "le fichier n’est pas un chereme-answers, mais {format}",
    ),
    (
        "import the files that the questionnaire saves",
        "importez les fichiers que le questionnaire enregistre",
    ),
    (
        "the answers are of version {n}; this program reads version {own}",
        "les réponses sont de version {n} ; ce programme lit la version {own}",
    ),
    (
        "import them with the version of Chereme that built the questionnaire",
        "importez-les avec la version de Chereme qui a construit le questionnaire",
    ),
    (
        "the answers of {code} belong to another plan than that of the study {name}",
        "les réponses de {code} appartiennent à un autre plan que celui de l’étude {name}",
    ),
    (
        "import them into the study that the questionnaire was built from; a plan that changed is another plan",
        "importez-les dans l’étude dont le questionnaire est issu ; un plan modifié est un autre plan",
    ),
    (
        "{code} is no code of a participant",
        "{code} n’est pas un code de participant",
    ),
    (
        "a code has up to 60 letters, digits, hyphens, dots, underscores and blanks",
        "un code a au plus 60 lettres, chiffres, traits d’union, points, tirets bas et espaces",
    ),
    (
        "the participant has more than {n} answers",
        "le participant a plus de {n} réponses",
    ),
    (
        "{code} did not agree that the answers are analysed",
        "{code} n’a pas accepté que les réponses soient analysées",
    ),
    ("delete the file", "supprimez le fichier"),
    (
        "the participant {code} has finished before with other answers, which stay",
        "le participant {code} avait terminé avec d’autres réponses, qui restent",
    ),
    (
        "if these are the right ones, delete the others with `chereme study forget CORPUS NAME CODE` and import again",
        "si celles-ci sont les bonnes, supprimez les autres avec `chereme study forget CORPUS NOM CODE` et importez de nouveau",
    ),
    (
        "the participant {code} has {n} answers, more than this file, and they stay",
        "le participant {code} a {n} réponses, plus que ce fichier, et elles restent",
    ),
    (
        "{code}: the plan has no answer {option} to {name}; it was left out",
        "{code} : le plan n’a pas de réponse {option} à {name} ; elle a été laissée de côté",
    ),
    (
        "{code}: the browser could not show films; trials without all answers: {trials}",
        "{code} : le navigateur n’a pas pu montrer des films ; essais sans toutes leurs réponses : {trials}",
    ),
    (
        "look whether the participant had the whole folder `media` and a current browser",
        "vérifiez que le participant avait tout le dossier `media` et un navigateur récent",
    ),
    (
        "answer {n} was left out: {why}",
        "la réponse {n} a été laissée de côté : {why}",
    ),
    (
        "a row was left out: {why}",
        "une ligne a été laissée de côté : {why}",
    ),
    (
        "{name} was answered twice in trial {n}",
        "{name} a reçu deux réponses dans l’essai {n}",
    ),
    (
        "the plan has no trial with {item} and {condition} ({role})",
        "le plan n’a pas d’essai avec {item} et {condition} ({role})",
    ),
    (
        "the plan does not ask {name} there; did you mean {near}?",
        "le plan n’y demande pas {name} ; vouliez-vous dire {near} ?",
    ),
    (
        "the plan does not ask {name} there",
        "le plan n’y demande pas {name}",
    ),
    (
        "{n} is no place in an order of trials",
        "{n} n’est pas une place dans un ordre d’essais",
    ),
    (
        "the scale of {name} goes from {low} to {high}",
        "l’échelle de {name} va de {low} à {high}",
    ),
    (
        "{value} lies outside the scale from {low} to {high}",
        "{value} est hors de l’échelle de {low} à {high}",
    ),
    (
        "{name} is a scale, which has no options",
        "{name} est une échelle, qui n’a pas d’options",
    ),
    (
        "{name} is a choice, which has no numbers",
        "{name} est un choix, qui n’a pas de nombres",
    ),
    (
        "{name} has no option {option}",
        "{name} n’a pas d’option {option}",
    ),
    ("{name} has no answer", "{name} n’a pas de réponse"),
    ("and {n} more findings", "et {n} autres constats"),
    (
        "the answers cannot be read: {error}",
        "les réponses ne peuvent pas être lues : {error}",
    ),
    (
        "the column {name} is not known and was left out",
        "la colonne {name} est inconnue et a été laissée de côté",
    ),
];
