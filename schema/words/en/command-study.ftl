## Messages: `{ $name }` is a variable part.

line-command-study-answered-by = answered by { $count }
line-command-study-questionnaire-films-orders-trials-kb = questionnaire { $path }: { $n } films, { $orders } orders of trials, { $size } KB
message-command-study-plan-names-picture-missing = the plan names a picture that is missing: { $path }
message-command-study-these-clips-give-same-film = these clips give the same film: { $one }; { $other }
line-command-study-new-replaced-unchanged-answers-stored = { $files }: { $n } new, { $more } replaced, { $same } unchanged; { $count } answers stored
message-command-study-nothing-stored-this-dry-run = nothing was stored: this was a dry run
line-command-study-end-answers-passed-over-not-reached = { $people }, { $n } to the end; { $answers } answers, { $m } passed over, { $k } not reached
line-command-study-wrote-answers = wrote { $n } answers to { $path }
line-command-study-deleted-undo-restores-answers-so-file = deleted { $code }; undo restores the answers, so the file still holds them
line-command-study-participants-answered-analysed = { $n } participants answered, { $m } are analysed
line-command-study-report = report: { $path }
line-command-study-rho = { $measure } and { $question }: rho { $rho }
message-command-study-left-out = left out: { $n }: { $why }
line-command-study-deleted-study = deleted the study { $name }
message-command-study-replaced-plan-nobody-had-answered = replaced the plan, which nobody had answered
message-command-study-stored-plan = stored the plan
message-command-study-write-name-recipe-with-for-item = write a name, =, and a recipe with { "{" }{ "}" } for the item: 'captured={ "{" }{ "}" }'

## Help of commands and options.

help-command-study-run-perceptual-study-plan-build-questionnaire = Run a perceptual study: plan it, build its questionnaire, import the answers, report on them
help-command-study-study-shows-clips-corpus-people-asks = A study shows clips of the corpus to people and asks about them. `new` stores a plan, `build` makes a folder with one page and its films. The page works in a browser without a network, in English and French, by mouse or keyboard; people answer it and send back the file that it saves. `import` brings the files into the corpus, and `report` says what the answers show.
help-command-study-plan-study-items-in-conditions-table = Plan a study: items in conditions, or a table of trials, and questions
help-command-study-plan-nobody-has-answered-replaced-for = A plan that nobody has answered is replaced. For texts, labels, pictures, hypotheses and exclusions, edit the JSON that `chereme study show CORPUS NAME --json` prints, and give it back with --plan.
help-command-study-show-plan-study-with-json-as = Show the plan of a study; with --json as a file for --plan
help-command-study-build-questionnaire-folder-with-one-page = Build the questionnaire: a folder with one page and its films
help-command-study-all-films-have-same-body-camera = All films have the same body, camera, size and background; the first and the last picture stand still for half a second. Films in sign language can be put into the folder media beside them: consent, instructions, end, question-NAME and profile-NAME, as .mp4 or .webm, or as NAME.fr.mp4 for one language. The page sends nothing anywhere. A number in its address, as index.html?n=12, gives participant 12 the order of that number; without it an order is drawn.
help-command-study-folder = The folder
help-command-study-height-films-in-pixels-from-64 = The height of films in pixels, from 64 to 1080
help-command-study-number-pictures-per-second-from-1 = The number of pictures per second, from 1 to 120
help-command-study-replace-questionnaire-exists-already-other-files = Replace a questionnaire that exists already; other files in its folder stay
help-command-study-import-answers-files-questionnaire-saved-tables = Import answers: files that the questionnaire saved, tables with one answer a row, folders of both
help-command-study-answers-another-plan-unknown-trials-outside = Answers to another plan, to unknown trials, or outside a scale are left out and reported. Later answers replace those of a participant who had not finished. The same file twice changes nothing.
help-command-study-tables-with-one-participant-row-as = Tables with one participant a row, as LimeSurvey and Qualtrics export them, need --columns: a table (.csv) whose column `column` holds titles, with `item`, `condition`, `question` (and `part`, `role`) for answers, or `means`: participant, language, started_day, finished, profile.NAME, consent.NAME. Codes stand under `values`, as `A1=left; A2=right`.
help-command-study-files-folders = The files or folders
help-command-study-meaning-columns-tables-with-one-participant = The meaning of the columns of tables with one participant a row (.csv)
help-command-study-report-on-answers-people-counts-recognition = Report on the answers: people, counts, recognition, comparisons, conclusions
help-command-study-conclusions-follow-hypotheses-plan-without-hypotheses = Conclusions follow the hypotheses of the plan. Without hypotheses all pairs of conditions are compared, and nothing is concluded. Tests are two-sided unless the plan expects a trend. Beside the test of all answers stands one of the means of people, which conclusions follow; intervals come from resampled people. FILE.html is a page with figures, which needs no network; a folder gets the page, the JSON and tables. The same plan and answers give the same bytes.
help-command-study-page-html-document-json-folder-for = The page (.html), the document (.json), or a folder for both and tables
help-command-study-replace-files-exist-already = Replace files that exist already
help-command-study-list-answers-one-by-one-write = List the answers one by one, or write all of them as a table
help-command-study-questions-without-answer-listed-too-participant = Questions without an answer are listed, too: a participant passed over them, for example because the browser could not show the film, or did not get that far. A table (.csv) has one answer a row, and import reads it again.
help-command-study-table-write-csv-with-all-answers = The table to write (.csv), with all answers
help-command-study-only-answers-this-participant = Only the answers of this participant
help-command-study-only-answers-whose-item-condition-part = Only answers whose item, condition, part or question contains these words
help-command-study-only-questions-without-answer = Only questions without an answer
help-command-study-report-what-would-imported-use-each = Report what would be imported, and the use of each column, and store nothing
help-command-study-delete-participant-with-all-answers-because = Delete a participant with all answers, because the person asks for it
help-command-study-answers-leave-study-every-export-but = The answers leave the study and every export, but not the file: the history keeps them, so that undo can restore them, and copies of the corpus made earlier have them too. If nothing may remain, import the other answers into a corpus that never had these.
help-command-study-code-participant-chose = The code that the participant chose
help-command-study-delete-study-with-all-answers-undo = Delete a study with all its answers; undo restores it
help-command-study-name-study = The name of the study
help-command-study-plan-as-json-instead-all-other = A plan as JSON, instead of all other options; - is standard input
help-command-study-title-participants-see-without-name = The title that participants see; without it the name
help-command-study-items-separated-by-blanks = The items, separated by blanks
help-command-study-condition-name-recipe-with-for-item = A condition: its name, and a recipe with { "{" }{ "}" } for the item; may be repeated
help-command-study-table-trials-with-columns-item-condition = A table of trials with the columns item, condition, clip, and if wished role (training, main, check), part, answer; other columns are measures of the clip
help-command-study-question-realism-realism-1-7-gloss = A question: realism, realism=1-7, gloss=items (the items as options), 'place=left right', or place@PART=… for one part of the study; may be repeated
help-command-study-highest-answer-scales-from-2-9 = The highest answer of scales, from 2 to 9
help-command-study-order-conditions = The order of conditions
help-command-study-seed-all-shuffles = The seed of all shuffles
help-command-study-how-often-each-trial-shown-from = How often each trial is shown, from 1 to 20
help-command-study-show-each-item-participant-in-one = Show each item to a participant in one condition only
help-command-study-add-measure-distance-each-trial-distance = Add the measure distance to each trial: the distance of its clip from that of the same item in this condition, as in `chereme score`; the report correlates answers with it
help-command-study-balanced-latin-square-each-condition-follows = Balanced Latin square: each condition follows each other equally often
help-command-study-shuffled = Shuffled

## Titles of columns.

title-command-study-column = column
title-command-study-means = means
title-command-study-cells = cells
title-command-study-example = example
title-command-study-stands-for = stands for
title-command-study-participant = participant
title-command-study-place = place
title-command-study-answer = answer
title-command-study-plays = plays
title-command-study-parts = parts
title-command-study-role = role
title-command-study-item = item
title-command-study-condition = condition
title-command-study-right-answer = right answer
title-command-study-clip = clip
title-command-study-question = question
title-command-study-answers = answers
title-command-study-text = text
title-command-study-s-d = s.d.
title-command-study-median = median
title-command-study-right = right
title-command-study-hypothesis = hypothesis
title-command-study-first = first
title-command-study-second = second
title-command-study-delta = delta
title-command-study-interval = interval
title-command-study-p-all-answers = p, all answers
title-command-study-p-holm-all-answers = p (Holm), all answers
title-command-study-p-people = p, people
title-command-study-p-holm-people = p (Holm), people
help-command-study-who-will-see-films = Who will see the films; if somebody did not agree to that (`chereme consent`), nothing is built
