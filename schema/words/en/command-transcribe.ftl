## Help of commands and options.

help-command-transcribe-transcribe-captured-generated-sign-in-hamnosys = Transcribe a captured or generated sign in HamNoSys, with the residual of each feature
help-command-transcribe-movement-transcribe-gloss-token-41-recording = The movement to transcribe: a gloss, token:41, or recording:3 if it is short
help-command-transcribe-write-names-symbols-in-place-table = Write the names of the symbols in place of the table
help-command-transcribe-store-transcription-as-token-s-notation = Store the transcription as the token's notation; `undo` takes it back
help-command-transcribe-replace-notation-token-has-already = Replace the notation that the token has already
help-command-transcribe-residual-distance-movement-from-transcription-runner = The residual is the distance of the movement from its transcription, and the runner-up is the second-best reading. Only a HamNoSys font shows the characters; their names are printed below them, `--names` prints nothing else, and `render TOKEN --to it.svg` draws a stored notation.
help-command-transcribe-if-sign-generated-from-notation-alone = If a sign was generated from notation alone, the program animates its transcription as a check. If its hands move differently, it tries similar movements and other postures. Values that it replaces have two residuals in cm: how far the hands are from the observed ones with the new value and with the old one, on average. It also reads the acts of trunk, head and shoulders, such as body.TF or head.SR in the codes of SiGML. That takes up to a minute; Ctrl-C stops it.
help-command-transcribe-json-gives-gloss-token-recording-start = `--json` gives "gloss", "token", "recording", "start_us", "end_us", the whole as "hamnosys" and "symbols" and as the tree "sign"; "stages", the posture at the beginning and each action with "action", "hand", "start_us", "end_us", "hamnosys", "symbols"; "features", each with "feature", "hand", "action" (null for the posture), "at_us", "start_us", "end_us", "value", "hamnosys", "symbols", "residual", "unit" (deg, cm or share) and "runner_up" ("value", "hamnosys", "symbols", "residual"; null if there is no second reading); "nonmanual", the tiers with acts that were read; "findings". Times are microseconds from the start of the recording.
help-command-transcribe-then-export-mine-chereme-token-41 = (then: export mine.chereme token:41 --to it.sigml)

## Titles of columns.

title-command-transcribe-action = action
title-command-transcribe-feature = feature
title-command-transcribe-residual = residual
title-command-transcribe-runner-up = runner-up
