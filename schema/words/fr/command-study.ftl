## Messages: `{ $name }` is a variable part.

line-command-study-answered-by = a reçu les réponses de { $count }
line-command-study-questionnaire-films-orders-trials-kb = questionnaire { $path } : { $n } films, { $orders } ordres d’essais, { $size } Ko
message-command-study-plan-names-picture-missing = le plan nomme une image qui manque : { $path }
message-command-study-these-clips-give-same-film = ces extraits donnent le même film : { $one } ; { $other }
line-command-study-new-replaced-unchanged-answers-stored = { $files } : { $n } nouveaux, { $more } remplacés, { $same } inchangés ; { $count } réponses enregistrées
message-command-study-nothing-stored-this-dry-run = rien n’a été enregistré : c’était un essai
line-command-study-end-answers-passed-over-not-reached = { $people }, dont { $n } jusqu’à la fin ; { $answers } réponses, { $m } passées, { $k } non atteintes
line-command-study-wrote-answers = { $n } réponses écrites dans { $path }
line-command-study-deleted-undo-restores-answers-so-file = { $code } supprimé ; undo rétablit les réponses, le fichier les contient donc encore
line-command-study-participants-answered-analysed = participants : { $n } ont répondu, { $m } sont analysés
line-command-study-report = rapport : { $path }
line-command-study-rho = { $measure } et { $question } : rho { $rho }
message-command-study-left-out = écartés : { $n } : { $why }
line-command-study-deleted-study = étude { $name } supprimée
message-command-study-replaced-plan-nobody-had-answered = plan remplacé ; personne n’y avait répondu
message-command-study-stored-plan = plan enregistré
message-command-study-write-name-recipe-with-for-item = écrivez un nom, =, et une recette avec { "{" }{ "}" } pour l’élément : 'captured={ "{" }{ "}" }'

## Help of commands and options.

help-command-study-run-perceptual-study-plan-build-questionnaire = Mener une étude perceptive : la préparer, construire son questionnaire, importer les réponses, en rendre compte
help-command-study-study-shows-clips-corpus-people-asks = Une étude montre à des personnes des extraits du corpus et pose des questions. `new` enregistre un plan, `build` crée un dossier avec une page et ses films. La page fonctionne dans un navigateur sans réseau, en anglais et en français, à la souris ou au clavier ; les personnes y répondent et renvoient le fichier qu’elle enregistre. `import` apporte les fichiers dans le corpus, et `report` dit ce que montrent les réponses.
help-command-study-plan-study-items-in-conditions-table = Préparer une étude : des éléments dans des conditions, ou un tableau d’essais, et des questions
help-command-study-plan-nobody-has-answered-replaced-for = Un plan auquel personne n’a répondu est remplacé. Pour les textes, libellés, images, hypothèses et exclusions, modifiez le JSON que `chereme study show CORPUS NOM --json` affiche, et rendez-le avec --plan.
help-command-study-show-plan-study-with-json-as = Montrer le plan d’une étude ; avec --json, sous la forme d’un fichier pour --plan
help-command-study-build-questionnaire-folder-with-one-page = Construire le questionnaire : un dossier avec une page et ses films
help-command-study-all-films-have-same-body-camera = Tous les films ont le même corps, la même caméra, la même taille et le même fond ; la première et la dernière image restent immobiles une demi-seconde. Des films en langue des signes peuvent être placés à côté, dans le dossier media : consent, instructions, end, question-NOM et profile-NOM, en .mp4 ou .webm, ou NOM.fr.mp4 pour une langue. La page n’envoie rien nulle part. Un numéro dans son adresse, comme index.html?n=12, donne au participant 12 l’ordre de ce numéro ; sans lui, un ordre est tiré au sort.
help-command-study-folder = Le dossier
help-command-study-height-films-in-pixels-from-64 = La hauteur des films en pixels, de 64 à 1080
help-command-study-number-pictures-per-second-from-1 = Le nombre d’images par seconde, de 1 à 120
help-command-study-replace-questionnaire-exists-already-other-files = Remplacer un questionnaire qui existe déjà ; les autres fichiers de son dossier restent
help-command-study-import-answers-files-questionnaire-saved-tables = Importer des réponses : fichiers enregistrés par le questionnaire, tableaux avec une réponse par ligne, dossiers des deux
help-command-study-answers-another-plan-unknown-trials-outside = Les réponses à un autre plan, à des essais inconnus ou hors d’une échelle sont laissées de côté et signalées. Des réponses plus récentes remplacent celles d’un participant qui n’avait pas terminé. Le même fichier deux fois ne change rien.
help-command-study-tables-with-one-participant-row-as = Les tableaux avec un participant par ligne, comme ceux de LimeSurvey et de Qualtrics, demandent --columns : un tableau (.csv) dont la colonne `column` contient des titres, avec `item`, `condition`, `question` (et `part`, `role`) pour les réponses, ou `means` : participant, language, started_day, finished, profile.NOM, consent.NOM. Les codes sont sous `values`, comme `A1=left; A2=right`.
help-command-study-files-folders = Les fichiers ou dossiers
help-command-study-meaning-columns-tables-with-one-participant = Le sens des colonnes des tableaux avec un participant par ligne (.csv)
help-command-study-report-on-answers-people-counts-recognition = Rendre compte des réponses : personnes, comptes, reconnaissance, comparaisons, conclusions
help-command-study-conclusions-follow-hypotheses-plan-without-hypotheses = Les conclusions suivent les hypothèses du plan. Sans hypothèse, toutes les paires de conditions sont comparées et rien n’est conclu. Les tests sont bilatéraux, sauf si le plan attend une tendance. À côté du test de toutes les réponses figure celui des moyennes des personnes, que suivent les conclusions ; les intervalles viennent de personnes rééchantillonnées. FICHIER.html est une page avec des figures, qui n’a pas besoin de réseau ; un dossier reçoit la page, le JSON et des tableaux. Le même plan et les mêmes réponses donnent les mêmes octets.
help-command-study-page-html-document-json-folder-for = La page (.html), le document (.json), ou un dossier pour les deux et des tableaux
help-command-study-replace-files-exist-already = Remplacer des fichiers qui existent déjà
help-command-study-list-answers-one-by-one-write = Montrer les réponses une à une, ou les écrire toutes dans un tableau
help-command-study-questions-without-answer-listed-too-participant = Les questions sans réponse sont montrées aussi : un participant les a passées, par exemple parce que le navigateur n’a pas pu montrer le film, ou n’est pas allé jusque-là. Un tableau (.csv) a une réponse par ligne, et l’importation le relit.
help-command-study-table-write-csv-with-all-answers = Le tableau à écrire (.csv), avec toutes les réponses
help-command-study-only-answers-this-participant = Seulement les réponses de ce participant
help-command-study-only-answers-whose-item-condition-part = Seulement les réponses dont l’élément, la condition, la partie ou la question contient ces mots
help-command-study-only-questions-without-answer = Seulement les questions sans réponse
help-command-study-report-what-would-imported-use-each = Montrer ce qui serait importé et l’usage de chaque colonne, sans rien enregistrer
help-command-study-delete-participant-with-all-answers-because = Supprimer un participant avec toutes ses réponses, parce que la personne le demande
help-command-study-answers-leave-study-every-export-but = Les réponses quittent l’étude et tout export, mais pas le fichier : l’historique les garde, pour que undo puisse les rétablir, et les copies antérieures du corpus les ont aussi. Si rien ne doit rester, importez les autres réponses dans un corpus qui n’a jamais eu celles-ci.
help-command-study-code-participant-chose = Le code choisi par le participant
help-command-study-delete-study-with-all-answers-undo = Supprimer une étude avec toutes ses réponses ; undo la rétablit
help-command-study-name-study = Le nom de l’étude
help-command-study-plan-as-json-instead-all-other = Un plan en JSON, au lieu de toutes les autres options ; - est l’entrée standard
help-command-study-title-participants-see-without-name = Le titre que voient les participants ; à défaut, le nom
help-command-study-items-separated-by-blanks = Les éléments, séparés par des espaces
help-command-study-condition-name-recipe-with-for-item = Une condition : son nom, et une recette avec { "{" }{ "}" } pour l’élément ; peut être répétée
help-command-study-table-trials-with-columns-item-condition = Un tableau d’essais avec les colonnes item, condition, clip et, si l’on veut, role (training, main, check), part, answer ; les autres colonnes sont des mesures de l’extrait
help-command-study-question-realism-realism-1-7-gloss = Une question : realism, realism=1-7, gloss=items (les éléments comme options), 'place=gauche droite', ou place@PARTIE=… pour une partie de l’étude ; peut être répétée
help-command-study-highest-answer-scales-from-2-9 = La plus haute réponse des échelles, de 2 à 9
help-command-study-order-conditions = L’ordre des conditions
help-command-study-seed-all-shuffles = La graine de tous les tirages
help-command-study-how-often-each-trial-shown-from = Combien de fois chaque essai est montré, de 1 à 20
help-command-study-show-each-item-participant-in-one = Ne montrer chaque élément à un participant que dans une condition
help-command-study-add-measure-distance-each-trial-distance = Ajouter à chaque essai la mesure distance : la distance de son extrait à celui du même élément dans cette condition, comme dans `chereme score` ; le rapport lui corrèle les réponses
help-command-study-balanced-latin-square-each-condition-follows = Carré latin équilibré : chaque condition suit chaque autre aussi souvent
help-command-study-shuffled = Au hasard

## Titles of columns.

title-command-study-column = colonne
title-command-study-means = sens
title-command-study-cells = cases
title-command-study-example = exemple
title-command-study-stands-for = représente
title-command-study-participant = participant
title-command-study-place = place
title-command-study-answer = réponse
title-command-study-plays = lectures
title-command-study-parts = parties
title-command-study-role = rôle
title-command-study-item = élément
title-command-study-condition = condition
title-command-study-right-answer = bonne réponse
title-command-study-clip = extrait
title-command-study-question = question
title-command-study-answers = réponses
title-command-study-text = texte
title-command-study-s-d = éc.-type
title-command-study-median = médiane
title-command-study-right = juste
title-command-study-hypothesis = hypothèse
title-command-study-first = premier
title-command-study-second = second
title-command-study-delta = delta
title-command-study-interval = intervalle
title-command-study-p-all-answers = p, réponses
title-command-study-p-holm-all-answers = p (Holm), réponses
title-command-study-p-people = p, personnes
title-command-study-p-holm-people = p (Holm), personnes
help-command-study-who-will-see-films = Qui verra les films ; si quelqu’un ne l’a pas accepté (`chereme consent`), rien n’est construit
