## Messages: `{ $name }` is a variable part.

message-command-cued-markers-their-positions-visible-missing = { $name }: { $n } markers, { $share } % of their positions visible; missing: { $names }
message-command-cued-markers-their-positions-visible-missing-2 = { $name }: { $n } markers, { $share } % of their positions visible; { $missing } are missing
message-command-cued-markers-their-positions-visible = { $name }: { $n } markers, { $share } % of their positions visible
line-command-cued-frames-at-second-hidden-places-restored = { $n } frames at { $rate } a second; { $hidden } hidden places restored
message-command-cued-nothing-stored-store-writes-tiers = nothing was stored; --store writes tiers
message-command-cued-nothing-stored-as-gloss-stores = nothing was stored; --as GLOSS stores it
message-command-cued-recognised-after-training-on = { $what } recognised after training on { $other }
message-command-cued-recognisers-tested-on-keys-from-they = the recognisers were tested on the keys from which they learned
message-command-cued-movements-from-pairs-keys-components-miss = { $n } movements from { $recordings }: { $found } of { $all } pairs of keys; components miss markers by { $mm } mm
message-command-cued-script-sentences-pairs-them-in-dictionary = the script: { $n } sentences, { $pairs } pairs, { $share } % of them in the dictionary; { $missing } different ones are missing
line-command-cued-keys-predicted-by-produced-as-predicted = { $n } keys predicted by { $code }, { $produced } produced ({ $rate }); { $same } as predicted
line-command-cued-right-shown-in-rows-recognised-in = { $name }: { $share } % right; shown in rows, recognised in columns
message-command-cued-keys-in-s-exact-stand-in = { $n } keys in { $seconds } s: { $exact } exact, { $others } stand in for others, { $synthetic } synthetic; cost { $cost }
line-command-cued-read-back-shapes-placements = read back: { $shapes } % of shapes, { $placements } % of placements
line-command-cued-stored-as = stored as { $name }

## Help of commands and options.

help-command-cued-work-with-captured-cued-speech-markers = Work with captured cued speech: markers, restoration, recognition, targets, phases, dictionary, slips
help-command-cued-habit-cuer-such-as-schwa-as = A habit of the cuer, such as schwa-as-eu; may be repeated
help-command-cued-table-two-columns-program-s-name = A table of two columns: the program's name of a marker, and its label in the files
help-command-cued-report-known-markers-recording-how-often = Report the known markers of a recording, and how often they are visible
help-command-cued-restore-hidden-markers-from-models-hand = Restore hidden markers from models of hand and face, as a separate track with predicted errors
help-command-cued-recordings-whose-markers-restored = The recordings whose markers are restored
help-command-cued-recordings-from-models-learn-without-those = The recordings from which the models learn; without it those of the hand alone and of the face alone, or all
help-command-cued-number-principal-components-hand-s-posture = The number of principal components of the hand's posture, from 1 to 25
help-command-cued-recognise-shapes-placements-at-targets-keys = Recognise shapes and placements at the targets of keys, with confusion tables
help-command-cued-recordings-from-recognisers-learn-without-every = The recordings from which the recognisers learn; without it every second one
help-command-cued-recordings-recognised-without-all-others = The recordings that are recognised; without it all others
help-command-cued-find-movements-targets-gestural-scores-keys = Find the movements, targets and gestural scores of keys
help-command-cued-recordings = The recordings
help-command-cued-write-them-as-tiers = Write them as tiers
help-command-cued-measure-when-hand-fingers-start-arrive = Measure when hand and fingers start and arrive relative to the sounds, by kind of key
help-command-cued-list-movements-between-keys-in-captured = List the movements between keys in captured takes, and those that a script needs in addition
help-command-cued-script-text-with-one-sentence-on = The script, a text with one sentence on each line: report how much of it the takes cover, and which sentences would add most
help-command-cued-compose-sentence-from-dictionary-recognise-keys = Compose a sentence from the dictionary, and recognise its keys as a check
help-command-cued-text-phones-with-phones = The text, or phones with --phones
help-command-cued-recordings-from-dictionary-cut = The recordings from which the dictionary is cut
help-command-cued-cost-duration-differs-by-100-ms = The cost of a duration that differs by 100 ms
help-command-cued-cost-join-whose-ends-differ-by = The cost of a join whose ends differ by the spread within one key
help-command-cued-gloss-new-recording-without-nothing-stored = The gloss of the new recording; without it nothing is stored
help-command-cued-compare-keys-take-with-those-phones = Compare the keys of a take with those that its phones or a text predict
help-command-cued-text-cued-without-tier-phones-predicts = The text that was cued; without it the tier of phones predicts the keys
help-command-cued-recognise-produced-keys-from-markers-even = Recognise the produced keys from the markers, even if a tier gives them
help-command-cued-take-recording-cuer-s-markers-c3d = A take is a recording of a cuer's markers (C3D, TRC) with tiers called Phones or Keys from a TextGrid or EAF file of the same name. Markers are called FA1-5 on the forearm, HB1-7 on the back of the hand, I, M, R, L 1-8 on the fingers, T1-6 on the thumb; RF1-5, RN1-2, RE1-2 on forehead, nose and ears, LP1-16 on the lips, CK1-12 on the cheeks, JW1-8 on the jaw, TH1-18 on the throat. If the files use other labels, --labels names a table that maps them. Without a named recording the command works on all captured takes.
help-command-cued-recording = The recording
help-command-cued-report-errors-store-nothing = Report the errors and store nothing

## Titles of columns.

title-command-cued-adds = adds
title-command-cued-arrives-ms = arrives ms
title-command-cued-begins-ms-median-quartiles = begins ms: median (quartiles)
title-command-cued-duration = duration
title-command-cued-face-mm = face_mm
title-command-cued-fingers = fingers
title-command-cued-first-source = first source
title-command-cued-hand-axis-mm = hand_axis_mm
title-command-cued-hand-mm = hand_mm
title-command-cued-hidden = hidden
title-command-cued-instead = instead
title-command-cued-join = join
title-command-cued-line = line
title-command-cued-pair = pair
title-command-cued-part = part
title-command-cued-predicted = predicted
title-command-cued-produced = produced
title-command-cued-read-back = read back
title-command-cued-restored = restored
title-command-cued-sentence = sentence
title-command-cued-share = share
title-command-cued-slip = slip
title-command-cued-source = source
title-command-cued-uncertain = uncertain
title-command-cued-wanted = wanted
