## Messages: `{ $name }` is a variable part.

line-commands-no-room-for-width-0-shows = no room for: { $names }; --width 0 shows all columns
message-commands-would-change = would change: { $n }
message-commands-changed = changed: { $n }
line-commands-not-used = not used: { $names }
message-commands-nothing-stored = nothing was stored
line-commands-left-out = left out: { $what }
line-commands-drew = drew { $path }
line-commands-made = made { $path }
message-commands-tokens = tokens: { $list }
message-commands-write-in-utf-8-name-file = write it in UTF-8, or name a file
message-commands-standard-input-no-text = standard input is no text
message-commands-json-both-want-standard-output = --json and --to - both want standard output
message-commands-leave-json-out-name-file = leave --json out, or name a file
message-commands-choose-another-name-write-over-with = choose another name, or write over it with --force

## Help of commands and options.

help-commands-corpus-database-for-signed-movement-import = A corpus database for signed movement: import, search, recombine, look at and export signs
help-commands-one-file-name-chereme-holds-recordings = One file, NAME.chereme, holds recordings, the annotations of their tiers, and the new signs made from them. Start with `chereme demo`, or import a folder of your own.
help-commands-print-one-json-document-on-standard = Print one JSON document on standard output instead of tables
help-commands-your-name-in-history-without-environment = Your name in the history; without it the environment variable CHEREME_AUTHOR, or the name of the machine's user
help-commands-width-tables-in-letters-0-for = The width of tables in letters, 0 for their full width; without it the width of the terminal, or the full width if the output goes to a file or another program
help-commands-language-help-tables-messages-system = The language of help, tables and messages; without it English or French, as the system. Words that a language lacks are English, as JSON always is. The environment variable CHEREME_WORDS names a folder with languages of your own: `chereme words --help`
help-commands-corpus = The corpus
help-commands-gloss-new-sign-without-nothing-stored = The gloss of the new sign; without it nothing is stored
help-commands-replace-file-exists-already = Replace a file that exists already
help-commands-in-table-write-apostrophe-before-cells = In a table write an apostrophe before cells that a spreadsheet would take for formulas
help-commands-signer-who-moves = The signer who moves
help-commands-replace-picture-exists-already = Replace a picture that exists already
help-commands-remarks = Remarks
help-commands-rule-for-timing-hand-fingers = The rule for the timing of hand and fingers
help-commands-duration-sounds-as-multiple-usual-one = The duration of sounds as a multiple of the usual one, from 0.1 to 10; without it 1.6
help-commands-read-input-as-phones-in-this = Read the input as phones in this alphabet
help-commands-function-expressions-negation-wh-yn-topic = The function of the expressions: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier; without it all
help-commands-draw-medians-quartiles-picture-svg = Draw medians and quartiles to a picture (.svg)
help-commands-code-french-english-us-english-gb = The code: french, english-us or english-gb
help-commands-examples = Examples:

## Titles of columns.

title-commands-channel = channel
title-commands-channels = channels
title-commands-component = component
title-commands-components = components
title-commands-count = count
title-commands-differs-in = differs in
title-commands-frames = frames
title-commands-function = function
title-commands-gloss = gloss
title-commands-hand = hand
title-commands-keys = keys
title-commands-kind = kind
title-commands-offset-s = offset_s
title-commands-origin = origin
title-commands-partner = partner
title-commands-phase = phase
title-commands-recipe = recipe
title-commands-corpus = corpus
title-commands-recording = recording
title-commands-seconds = seconds
title-commands-sign = sign
title-commands-signs = signs
title-commands-start = start
title-commands-tier = tier
title-commands-tiers = tiers
title-commands-token = token
title-commands-value = value
