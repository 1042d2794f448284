## Messages: `{ $name }` is a variable part.

line-command-lexicon-linked-otherwise = linked otherwise than before: { $n }
line-command-lexicon-removed = lexicon removed: { $name }
line-command-lexicon-relations-changed = relations that changed: { $n }
message-command-lexicon-nothing-changed = nothing is to be changed
message-command-lexicon-add-option = add --name, --language, --release, --terms, --citation or --notes
message-command-lexicon-no-lexicon = the corpus has no lexicon: import a table or notation with --lexicon NAME
line-command-lexicon-united = { $names }: one lexicon with { $name } now; entries that came: { $moved }, joined: { $joined }
line-command-lexicon-both-codings = both codings were kept of: { $list }
line-command-lexicon-other-numbers = entries with another number: { $list }
message-command-lexicon-bare-glosses = tokens annotated with the bare gloss of several entries, of which the first was taken: { $n }

## Help of commands and options.

help-command-lexicon-list-change-link = List the lexicons of a corpus, say what they are, and link recordings to them
help-command-lexicon-sign-is-entry = A sign is an entry of a lexicon: BOOK of an American and BOOK of a British lexicon are two signs. An imported table is a lexicon with the name of its file, unless the import names one. Where several lexicons have a gloss, write which one is meant: sign:NGT/BOOK. Queries know lexicon=NGT, language=dse and file=ngt.csv.
help-command-lexicon-glosses-looked-up = The glosses of a recording's tiers are looked up in the lexicon to which the recording is linked; those that it does not have are signs of no lexicon. The recordings of a corpus with one lexicon are linked to it; with several, link them yourself. Without an action the lexicons are listed. `--json` gives for each "id", "name", "language", "version", "terms", "citation", "notes", "signs", "homonyms", "files", "recordings", "tokens" and "guessed_tokens".
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
help-command-lexicon-entries-of-one-gloss = Several entries may have one gloss: BANK, BANK#2. A table keeps them apart by a column that identifies its rows, such as id, or by a column "homonym" with 1, 2 and so on. A bare gloss in an annotation means the first ("guessed_tokens" counts these); write BANK#2 for the second. sign:BANK#2 names it, gloss=BANK finds all. `annotate` and the window rename signs.
help-command-lexicon-unite = Make lexicons one: entries, recordings and files belong to the one that stays; undo takes it back
help-command-lexicon-same-entries = Entries are the same if their rows have the same id, otherwise by gloss and number. Both codings are kept, as two forms of one entry, and entries that differ are named. Lexicons that differ in language, version, terms or citation are refused.
help-command-lexicon-that-go = The lexicons that go
help-command-lexicon-that-stays = The lexicon that stays
help-command-lexicon-relate = Say how a sign is related to others: variants, synonyms, the parts of a compound in order
help-command-lexicon-relate-both-ends = A relation is read from both ends: if BOOKSHOP is compound-of BOOK SHOP, BOOK is part-of BOOKSHOP. Queries know related.variant=BOOK and related.part-of=*. Tables bring relations in columns such as "variants", "relations to other signs" (variant:BANK, seealso:SHORE) and "sequential morphology" (HOUSE + ROOF).
help-command-lexicon-unrelate = Take relations of a sign to others away
help-command-lexicon-relations = List the relations of a sign or of all signs, or those that the form of signs decides
help-command-lexicon-relation-sign = The sign, as a gloss or sign:LEXICON/GLOSS
help-command-lexicon-relation-name = The relation: variant, homonym, synonym, antonym, paradigm, see-also, compound-of, part-of, derived-from, source-of, hyponym-of, hypernym-of
help-command-lexicon-relation-others = The other signs
help-command-lexicon-relations-of-sign = The sign; without it those of all signs
help-command-lexicon-relations-by-form = List the relations that the form decides and nobody stated: homonyms are equal in all fields, the signs of a paradigm in all but the handshape
help-command-lexicon-relations-store = Store them
help-command-lexicon-relations-fields = The fields that count as form, as in `chereme pairs`

## Titles of columns.

title-command-lexicon-version = version
title-command-lexicon-terms = terms
title-command-lexicon-files = files
title-command-lexicon-relation = relation
title-command-lexicon-other-sign = other sign
title-command-lexicon-source = source
