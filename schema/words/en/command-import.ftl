## Messages: `{ $name }` is a variable part.

line-command-import-more-findings-like-these-all-them = and { $n } more findings like these, all of them with --json
message-command-import-made = made: { $list }
message-command-import-removed = removed: { $list }
message-command-import-would-make = would make: { $list }
message-command-import-would-remove = would remove: { $list }
line-command-import-more-files-imported-without-warning-json = { $n } more files were imported without a warning; --json lists their notes
message-command-import-not-read-without-ending = not read: { $what } without an ending ({ $why })
line-command-import-not-read = not read: { $what } ({ $why })
line-command-import-recording-holds-file-and = recording { $name } holds { $file } and
line-command-import-more-recordings-hold-several-files = { $n } more recordings hold several files; --json lists them
message-command-import-nothing-new = nothing new
line-command-import-joints-unit-axes-up-left = { $n } joints, { $rate }, unit { $unit }, axes up,left = { $axes }
message-command-import-track-points-frames-unit-axes-up = track { $name }: { $n } points, { $all } frames, { $rate }, unit { $unit }, axes up,left = { $axes }
message-command-import-track-points-frames = track { $name }: { $n } points, { $all } frames, { $rate }
message-command-import-track-curves-frames = track { $name }: { $n } curves, { $all } frames, { $rate }
line-command-import-lexicon = lexicon { $name }
line-command-import-column = column { $name }: { $meaning }
message-command-import-updated-recording = { $file }: updated -> recording { $name }
message-command-import-updated = { $file }: updated
message-command-import-unchanged-recording = { $file }: unchanged -> recording { $name }
message-command-import-unchanged = { $file }: unchanged
message-command-import-refused-recording = { $file }: REFUSED -> recording { $name }
message-command-import-refused = { $file }: REFUSED
message-command-import-recording = { $file } -> recording { $name }
message-command-import-standard-input-has-no-extension-says = standard input has no extension that says its kind
message-command-import-name-as-with-format-eaf = name it, as with --format eaf
message-command-import-no-extension-file-no-name = { $format } is no extension of a file, or { $name } no name
message-command-import-write-format-eaf-name-take1 = write --format eaf, and --name take1
message-command-import-corpus-stores-path-film-standard-input = a corpus stores the path of a film, and standard input has none
message-command-import-name-file-film = name the file of the film
message-command-import-write-hours-minutes-seconds-frames-12 = write hours, minutes, seconds and frames: 12:34:56:07@25
message-command-import-write-whole-number-such-as-50 = write a whole number such as 50, or a fraction such as 30000/1001
message-command-import-unit-length-has-between-0-000001 = a unit of length has between 0.000001 and 1000 metres
message-command-import-write-m-cm-mm-inch-ft = write m, cm, mm, inch, ft, acclaim, or how many metres one unit is
message-command-import-write-lines-such-as-right-wrist = write lines such as `right wrist = RHand`, each a part of the body and a joint

## Help of commands and options.

help-command-import-import-recordings-annotations-lexicons-inventories-into = Import recordings, annotations, lexicons and inventories into a corpus
help-command-import-files-folders-standard-input-with-kind = Files and folders; - is standard input, with its kind in --format
help-command-import-kind-file-on-standard-input-as = The kind of the file on standard input, as an extension: eaf, bvh, csv, sigml ...
help-command-import-name-recording-table-on-standard-input = The name of the recording or table on standard input
help-command-import-give-each-take-without-tokens = Give each take without tokens one whose gloss is the take's name, over the sign that is found in its movement
help-command-import-report-what-would-done-write-nothing = Report what would be done, and write nothing
help-command-import-keep-your-edits-take-file-s = Keep your edits and take the file's other changes; if both changed the same annotation, yours stays
help-command-import-take-everything-from-file-even-if = Take everything from the file, even if it takes back your edits
help-command-import-leave-recording-as-if-file-would = Leave a recording as it is if the file would take back your edits
help-command-import-signer-s-dominant-hand = The signer's dominant hand
help-command-import-unit-length-movement-files-m-cm = The unit of length of the movement files: m, cm, mm, inch, ft, acclaim, or metres per unit
help-command-import-axes-movement-files-directions-up-signer = The axes of the movement files: the directions up and to the signer's left, such as +Z,+X
help-command-import-file-assigns-joints-parts-body-in = A file that assigns joints to parts of the body, in lines such as `right wrist = RHand`
help-command-import-read-root-s-columns-as-numbers = Read the root's columns as the numbers suggest if the header gives a wrong order or unit
help-command-import-json-file-with-meaning-tiers-columns = A JSON file with the meaning of tiers or columns
help-command-import-origin-recordings = The origin of the recordings
help-command-import-terms-under-recordings-may-used = The terms under which the recordings may be used
help-command-import-recording-for-all-tracks-tiers-files = The recording for all tracks and tiers of the files, instead of the one with the files' name
help-command-import-evidence-joins-files-into-one-recording = The evidence that joins files into one recording
help-command-import-folder-name-what-annotation-file-says = Folder and name, what an annotation file says, and a true timecode within a folder
help-command-import-also-same-name-in-another-folder = Also the same name in another folder, if only one recording has it
help-command-import-also-any-timecode-in-neighbouring-folders = Also any timecode, in neighbouring folders too
help-command-import-folder-name-alone = Folder and name alone
help-command-import-start-files-tracks-on-recording-s = The start of the files' tracks on the recording's clock, such as 0.48s
help-command-import-time-day-at-files-tracks-start = The time of day at which the files' tracks start, if they do not state it: 12:34:56:07, or 12:34:56:07@25 for 25 frames a second. Tracks of a recording with known times of day are aligned by them
help-command-import-frame-rate-points-from-film-tables = The frame rate of points from film and of tables of markers that do not state it, in frames per second, such as 50 or 30000/1001
help-command-import-files-same-name-in-one-folder = Files of the same name in one folder become one recording; so does a film that an .eaf names, and, within a folder, a file of another kind whose timecode overlaps. What only may belong together, such as files of the same name in two folders, is not joined but listed with what to do (--join, --into), and the report says what was joined and why. A line of HamNoSys holds the gloss, a tab, and the symbols. The report shows how each file was interpreted. Options override this, also later: --map gives an imported file other tiers or columns. A corpus that does not exist yet is created. If a file cannot be read, the others are imported.
help-command-import-annotation-file-imported-before-edited-since = An annotation file that was imported before and edited since updates its recording, annotation by annotation. If that would take back edits made in the corpus, the file is refused and the edits are listed; then --merge, --theirs or --mine decides. One import is one operation: `chereme undo` takes it back, and Ctrl-C leaves the corpus as it was.
