//! The French of `chereme study`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Run a perceptual study: plan it, build its questionnaire, import the answers, report on them",
            "Mener une étude perceptive : la préparer, construire son questionnaire, importer les réponses, en rendre compte",
        ),
        (
            "A study shows clips of the corpus to people and asks about them. `new` stores a plan, `build` makes a folder with one page and its films. The page works in a browser without a network, in English and French, by mouse or keyboard; people answer it and send back the file that it saves. `import` brings the files into the corpus, and `report` says what the answers show.",
            "Une étude montre à des personnes des extraits du corpus et pose des questions. `new` enregistre un plan, `build` crée un dossier avec une page et ses films. La page fonctionne dans un navigateur sans réseau, en anglais et en français, à la souris ou au clavier ; les personnes y répondent et renvoient le fichier qu’elle enregistre. `import` apporte les fichiers dans le corpus, et `report` dit ce que montrent les réponses.",
        ),
        (
            "Plan a study: items in conditions, or a table of trials, and questions",
            "Préparer une étude : des éléments dans des conditions, ou un tableau d’essais, et des questions",
        ),
        (
            "A plan that nobody has answered is replaced. For texts, labels, pictures, hypotheses and exclusions, edit the JSON that `chereme study show CORPUS NAME --json` prints, and give it back with --plan.",
            "Un plan auquel personne n’a répondu est remplacé. Pour les textes, libellés, images, hypothèses et exclusions, modifiez le JSON que `chereme study show CORPUS NOM --json` affiche, et rendez-le avec --plan.",
        ),
        (
            "Show the plan of a study; with --json as a file for --plan",
            "Montrer le plan d’une étude ; avec --json, sous la forme d’un fichier pour --plan",
        ),
        (
            "Build the questionnaire: a folder with one page and its films",
            "Construire le questionnaire : un dossier avec une page et ses films",
        ),
        (
            "All films have the same body, camera, size and background; the first and the last picture stand still for half a second. Films in sign language can be put into the folder media beside them: consent, instructions, end, question-NAME and profile-NAME, as .mp4 or .webm, or as NAME.fr.mp4 for one language. The page sends nothing anywhere. A number in its address, as index.html?n=12, gives participant 12 the order of that number; without it an order is drawn.",
            "Tous les films ont le même corps, la même caméra, la même taille et le même fond ; la première et la dernière image restent immobiles une demi-seconde. Des films en langue des signes peuvent être placés à côté, dans le dossier media : consent, instructions, end, question-NOM et profile-NOM, en .mp4 ou .webm, ou NOM.fr.mp4 pour une langue. La page n’envoie rien nulle part. Un numéro dans son adresse, comme index.html?n=12, donne au participant 12 l’ordre de ce numéro ; sans lui, un ordre est tiré au sort.",
        ),
        ("The folder", "Le dossier"),
        (
            "The height of films in pixels, from 64 to 1080",
            "La hauteur des films en pixels, de 64 à 1080",
        ),
        (
            "The number of pictures per second, from 1 to 120",
            "Le nombre d’images par seconde, de 1 à 120",
        ),
        (
            "Replace a questionnaire that exists already; other files in its folder stay",
            "Remplacer un questionnaire qui existe déjà ; les autres fichiers de son dossier restent",
        ),
        (
            "Import answers: files that the questionnaire saved, tables with one answer a row, folders of both",
            "Importer des réponses : fichiers enregistrés par le questionnaire, tableaux avec une réponse par ligne, dossiers des deux",
        ),
        (
            "Answers to another plan, to unknown trials, or outside a scale are left out and reported. Later answers replace those of a participant who had not finished. The same file twice changes nothing.",
            "Les réponses à un autre plan, à des essais inconnus ou hors d’une échelle sont laissées de côté et signalées. Des réponses plus récentes remplacent celles d’un participant qui n’avait pas terminé. Le même fichier deux fois ne change rien.",
        ),
        (
            "Tables with one participant a row, as LimeSurvey and Qualtrics export them, need --columns: a table (.csv) whose column `column` holds titles, with `item`, `condition`, `question` (and `part`, `role`) for answers, or `means`: participant, language, started_day, finished, profile.NAME, consent.NAME. Codes stand under `values`, as `A1=left; A2=right`.",
            "Les tableaux avec un participant par ligne, comme ceux de LimeSurvey et de Qualtrics, demandent --columns : un tableau (.csv) dont la colonne `column` contient des titres, avec `item`, `condition`, `question` (et `part`, `role`) pour les réponses, ou `means` : participant, language, started_day, finished, profile.NOM, consent.NOM. Les codes sont sous `values`, comme `A1=left; A2=right`.",
        ),
        ("The files or folders", "Les fichiers ou dossiers"),
        (
            "The meaning of the columns of tables with one participant a row (.csv)",
            "Le sens des colonnes des tableaux avec un participant par ligne (.csv)",
        ),
        (
            "Report on the answers: people, counts, recognition, comparisons, conclusions",
            "Rendre compte des réponses : personnes, comptes, reconnaissance, comparaisons, conclusions",
        ),
        (
            "Conclusions follow the hypotheses of the plan. Without hypotheses all pairs of conditions are compared, and nothing is concluded. Tests are two-sided unless the plan expects a trend. Beside the test of all answers stands one of the means of people, which conclusions follow; intervals come from resampled people. FILE.html is a page with figures, which needs no network; a folder gets the page, the JSON and tables. The same plan and answers give the same bytes.",
            "Les conclusions suivent les hypothèses du plan. Sans hypothèse, toutes les paires de conditions sont comparées et rien n’est conclu. Les tests sont bilatéraux, sauf si le plan attend une tendance. À côté du test de toutes les réponses figure celui des moyennes des personnes, que suivent les conclusions ; les intervalles viennent de personnes rééchantillonnées. FICHIER.html est une page avec des figures, qui n’a pas besoin de réseau ; un dossier reçoit la page, le JSON et des tableaux. Le même plan et les mêmes réponses donnent les mêmes octets.",
        ),
        (
            "The page (.html), the document (.json), or a folder for both and tables",
            "La page (.html), le document (.json), ou un dossier pour les deux et des tableaux",
        ),
        (
            "Replace files that exist already",
            "Remplacer des fichiers qui existent déjà",
        ),
        (
            "List the answers one by one, or write all of them as a table",
            "Montrer les réponses une à une, ou les écrire toutes dans un tableau",
        ),
        (
            "Questions without an answer are listed, too: a participant passed over them, for example because the browser could not show the film, or did not get that far. A table (.csv) has one answer a row, and import reads it again.",
            "Les questions sans réponse sont montrées aussi : un participant les a passées, par exemple parce que le navigateur n’a pas pu montrer le film, ou n’est pas allé jusque-là. Un tableau (.csv) a une réponse par ligne, et l’importation le relit.",
        ),
        (
            "The table to write (.csv), with all answers",
            "Le tableau à écrire (.csv), avec toutes les réponses",
        ),
        (
            "Only the answers of this participant",
            "Seulement les réponses de ce participant",
        ),
        (
            "Only answers whose item, condition, part or question contains these words",
            "Seulement les réponses dont l’élément, la condition, la partie ou la question contient ces mots",
        ),
        (
            "Only questions without an answer",
            "Seulement les questions sans réponse",
        ),
        (
            "Report what would be imported, and the use of each column, and store nothing",
            "Montrer ce qui serait importé et l’usage de chaque colonne, sans rien enregistrer",
        ),
        (
            "Delete a participant with all answers, because the person asks for it",
            "Supprimer un participant avec toutes ses réponses, parce que la personne le demande",
        ),
        (
            "The answers leave the study and every export, but not the file: the history keeps them, so that undo can restore them, and copies of the corpus made earlier have them too. If nothing may remain, import the other answers into a corpus that never had these.",
            "Les réponses quittent l’étude et tout export, mais pas le fichier : l’historique les garde, pour que undo puisse les rétablir, et les copies antérieures du corpus les ont aussi. Si rien ne doit rester, importez les autres réponses dans un corpus qui n’a jamais eu celles-ci.",
        ),
        (
            "The code that the participant chose",
            "Le code choisi par le participant",
        ),
        (
            "Delete a study with all its answers; undo restores it",
            "Supprimer une étude avec toutes ses réponses ; undo la rétablit",
        ),
        ("The name of the study", "Le nom de l’étude"),
        (
            "A plan as JSON, instead of all other options; - is standard input",
            "Un plan en JSON, au lieu de toutes les autres options ; - est l’entrée standard",
        ),
        (
            "The title that participants see; without it the name",
            "Le titre que voient les participants ; à défaut, le nom",
        ),
        (
            "The items, separated by blanks",
            "Les éléments, séparés par des espaces",
        ),
        (
            "A condition: its name, and a recipe with {} for the item; may be repeated",
            "Une condition : son nom, et une recette avec {} pour l’élément ; peut être répétée",
        ),
        (
            "A table of trials with the columns item, condition, clip, and if wished role (training, main, check), part, answer; other columns are measures of the clip",
            "Un tableau d’essais avec les colonnes item, condition, clip et, si l’on veut, role (training, main, check), part, answer ; les autres colonnes sont des mesures de l’extrait",
        ),
        (
            "A question: realism, realism=1-7, gloss=items (the items as options), 'place=left right', or place@PART=… for one part of the study; may be repeated",
            "Une question : realism, realism=1-7, gloss=items (les éléments comme options), 'place=gauche droite', ou place@PARTIE=… pour une partie de l’étude ; peut être répétée",
        ),
        (
            "The highest answer of scales, from 2 to 9",
            "La plus haute réponse des échelles, de 2 à 9",
        ),
        ("The order of conditions", "L’ordre des conditions"),
        ("The seed of all shuffles", "La graine de tous les tirages"),
        (
            "How often each trial is shown, from 1 to 20",
            "Combien de fois chaque essai est montré, de 1 à 20",
        ),
        (
            "Show each item to a participant in one condition only",
            "Ne montrer chaque élément à un participant que dans une condition",
        ),
        (
            "Add the measure distance to each trial: the distance of its clip from that of the same item in this condition, as in `chereme score`; the report correlates answers with it",
            "Ajouter à chaque essai la mesure distance : la distance de son extrait à celui du même élément dans cette condition, comme dans `chereme score` ; le rapport lui corrèle les réponses",
        ),
        (
            "Balanced Latin square: each condition follows each other equally often",
            "Carré latin équilibré : chaque condition suit chaque autre aussi souvent",
        ),
        ("Shuffled", "Au hasard"),
    ],
    lines: &[
        ("answered by {count}", "a reçu les réponses de {count}"),
        (
            "questionnaire {path}: {n} films, {orders} orders of trials, {size} KB",
            "questionnaire {path} : {n} films, {orders} ordres d’essais, {size} Ko",
        ),
        (
            "the plan names a picture that is missing: {path}",
            "le plan nomme une image qui manque : {path}",
        ),
        (
            "these clips give the same film: {one}; {other}",
            "ces extraits donnent le même film : {one} ; {other}",
        ),
        (
            "{files}: {n} new, {more} replaced, {same} unchanged; {count} answers stored",
            "{files} : {n} nouveaux, {more} remplacés, {same} inchangés ; {count} réponses enregistrées",
        ),
        (
            "nothing was stored: this was a dry run",
            "rien n’a été enregistré : c’était un essai",
        ),
        (
            "{people}, {n} to the end; {answers} answers, {m} passed over, {k} not reached",
            "{people}, dont {n} jusqu’à la fin ; {answers} réponses, {m} passées, {k} non atteintes",
        ),
        (
            "wrote {n} answers to {path}",
            "{n} réponses écrites dans {path}",
        ),
        (
            "deleted {code}; undo restores the answers, so the file still holds them",
            "{code} supprimé ; undo rétablit les réponses, le fichier les contient donc encore",
        ),
        (
            "{n} participants answered, {m} are analysed",
            "participants : {n} ont répondu, {m} sont analysés",
        ),
        ("report: {path}", "rapport : {path}"),
        (
            "{measure} and {question}: rho {rho}",
            "{measure} et {question} : rho {rho}",
        ),
        ("left out: {n}: {why}", "écartés : {n} : {why}"),
        ("deleted the study {name}", "étude {name} supprimée"),
        (
            "replaced the plan, which nobody had answered",
            "plan remplacé ; personne n’y avait répondu",
        ),
        ("stored the plan", "plan enregistré"),
        (
            "write a name, =, and a recipe with {} for the item: 'captured={}'",
            "écrivez un nom, =, et une recette avec {} pour l’élément : 'captured={}'",
        ),
    ],
    titles: &[
        ("column", "colonne"),
        ("means", "sens"),
        ("cells", "cases"),
        ("example", "exemple"),
        ("stands for", "représente"),
        ("participant", "participant"),
        ("place", "place"),
        ("answer", "réponse"),
        ("plays", "lectures"),
        ("part", "partie"),
        ("parts", "parties"),
        ("role", "rôle"),
        ("item", "élément"),
        ("condition", "condition"),
        ("right answer", "bonne réponse"),
        ("clip", "extrait"),
        ("question", "question"),
        ("answers", "réponses"),
        ("text", "texte"),
        ("mean", "moyenne"),
        ("s.d.", "éc.-type"),
        ("median", "médiane"),
        ("right", "juste"),
        ("hypothesis", "hypothèse"),
        ("first", "premier"),
        ("second", "second"),
        ("delta", "delta"),
        ("interval", "intervalle"),
        ("p, all answers", "p, réponses"),
        ("p (Holm), all answers", "p (Holm), réponses"),
        ("p, people", "p, personnes"),
        ("p (Holm), people", "p (Holm), personnes"),
    ],
};
