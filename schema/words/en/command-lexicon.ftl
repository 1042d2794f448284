## Messages: `{ $name }` is a variable part.

line-command-lexicon-linked-otherwise = linked otherwise than before: { $n }
line-command-lexicon-removed = lexicon removed: { $name }
message-command-lexicon-nothing-changed = nothing is to be changed
message-command-lexicon-add-option = add --name, --language, --release, --terms, --citation or --notes
message-command-lexicon-no-lexicon = the corpus has no lexicon: import a table or notation with --lexicon NAME

## Help of commands and options.

help-command-lexicon-list-change-link = List the lexicons of a corpus, say what they are, and link recordings to them
help-command-lexicon-sign-is-entry = A sign is an entry of a lexicon: BOOK of an American and BOOK of a British lexicon are two signs. An imported table is a lexicon with the name of its file, unless the import names one. Where several lexicons have a gloss, write which one is meant: sign:NGT/BOOK. Queries know lexicon=NGT, language=dse and file=ngt.csv.
help-command-lexicon-glosses-looked-up = The glosses of a recording's tiers are looked up in the lexicon to which the recording is linked; those that it does not have are signs of no lexicon. The recordings of a corpus with one lexicon are linked to it; with several, link them yourself. Without an action the lexicons are listed. `--json` gives for each "id", "name", "language", "version", "terms", "citation", "notes", "signs", "files", "recordings" and "tokens".
help-command-lexicon-say-what-it-is = Say what a lexicon is: its name, language, version, terms, and how to cite it
help-command-lexicon-look-up = Look up the glosses of recordings in a lexicon from now on
help-command-lexicon-look-up-in-none = Look up the glosses of recordings in no lexicon
help-command-lexicon-remove = Remove a lexicon that has no signs
help-command-lexicon-by-name = The lexicon, by name
help-command-lexicon-language = Its sign language, as a code of ISO 639-3 such as dse; an empty text takes it away, here and below
help-command-lexicon-version = Its version
help-command-lexicon-cite = How to cite it
help-command-lexicon-recordings = The recordings, such as recording:3
help-command-lexicon-recordings-of-query = The recordings with a token that a query finds, as in `chereme search`
help-command-lexicon-all-recordings = All recordings of the corpus
help-command-lexicon-signs-of-one = Take the signs of this lexicon alone
help-command-lexicon-signs-of-all = Take the signs of all lexicons as if they were one
help-command-lexicon-compare-others = Compare it with the signs of other lexicons, too
help-command-lexicon-import-into = The lexicon to which the signs of tables and notation belong; without it a table is one of its own, and notation belongs to the only one of the corpus
help-command-lexicon-import-language = The sign language of that lexicon, as a code of ISO 639-3 such as dse
help-command-lexicon-pairs-of-query = The tokens whose signs are compared, as in `chereme search`; without it the citation forms

## Titles of columns.

title-command-lexicon-version = version
title-command-lexicon-terms = terms
title-command-lexicon-files = files
