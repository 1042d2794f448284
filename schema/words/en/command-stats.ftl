## Messages: `{ $name }` is a variable part.

line-command-stats-entries-compared-different-forms = entries: { $n }, compared: { $m }, different forms: { $k }
line-command-stats-entropy-forms-in-bits = entropy of forms in bits: { $number }
line-command-stats-values-in-entries-entries-without-one = { $field }: { $n } values in { $given } entries, { $empty } entries without one
line-command-stats-entropy-in-bits-without-empty-cells = entropy in bits: { $all }; without empty cells: { $given }
line-command-stats-functional-load = functional load: { $number }
line-command-stats-contrasts = contrasts: - ({ $why })
message-command-stats-contrasts-distinguish-signs-largest-load-first = contrasts that distinguish signs, the largest load first; ∅ is the empty cell
line-command-stats-contrasts-not-shown-json-has-all = contrasts that are not shown: { $n }; --json has all
line-command-stats-rows-not-shown-json-has-all = rows that are not shown: { $n }; --json has all
line-command-stats-columns-not-shown-json-has-all = columns that are not shown: { $n }; --json has all
line-command-stats-exceptions-not-shown-json-has-all = exceptions that are not shown: { $n }; --json has all
line-command-stats-entries-with-both-left-out = { $one } × { $other }: { $n } entries with both, { $m } left out
line-command-stats-mutual-information-in-bits-shuffled-p = mutual information in bits: { $bits } (shuffled: { $mean }), p { $p }
line-command-stats-chi-square-shuffled-df-p = chi-square: { $value } (shuffled: { $mean }), df { $df }, p { $p }
line-command-stats-cramer-s-v = Cramér's V: { $value }
line-command-stats-one-handed-symmetrical-asymmetrical-no-known = one-handed: { $n }, symmetrical: { $s }, asymmetrical: { $a }, of no known type: { $o }
line-command-stats-unmarked-handshapes = unmarked handshapes: { $list }
line-command-stats-symmetry-both-handshapes-given-same-different = symmetry: both handshapes given { $n }, the same { $same }, different { $other }; kept by { $share }
message-command-stats-dominance-both-handshapes-given-same-different = dominance: both handshapes given { $n }, the same { $same }, different { $other }, of these with an unmarked weak hand { $k }; kept by { $share }; weak hand unmarked in { $all }
message-command-stats-entries-do-not-keep-symmetry = entries that do not keep symmetry: { $n }
message-command-stats-entries-do-not-keep-dominance = entries that do not keep dominance: { $n }
line-command-stats-without-one-handshapes = without one of the handshapes: { $list }
line-command-stats-entries = entries: { $list }
line-command-stats-entries-measured-neighbours-mean-median = entries: { $n }, measured: { $m }; neighbours: mean { $mean }, median { $median }; signs without one: { $k }
line-command-stats-fields-of-forms = fields: { $list }
line-command-stats-signs-not-shown-to-json-have-all = signs that are not shown: { $n }; --to and --json have all
line-command-stats-entries-with-stored-measures = entries with stored measures: { $n }
line-command-stats-table = table: { $path }

## Help of commands and options.

help-command-stats-describe-lexicon-by-numbers-entropy-functional = Describe a lexicon by numbers: entropy, functional load, association of fields, conditions on the hands
help-command-stats-every-sign-counts-once-by-citation = Every sign counts once, by its citation form; with a query every token that it finds. Fields are columns of an imported table, whose cells are taken as written, or fields of queries such as dominant.configuration, as in `chereme pairs`.
help-command-stats-entropy-in-bits-from-shares-as = Entropy is in bits, from the shares as they are. The functional load of a field is the share of the entropy of forms that is lost without it, (H(L) - H(L without it)) / H(L); that of a contrast is the share that is lost if its two values are one. Intervals of 95 % are the jackknife's over entries, and Wilson's for shares. Draws with replacement would take the same entry twice, as a homonym that the lexicon does not have.
help-command-stats-association-counts-entries-have-both-fields = Association counts the entries that have both fields: mutual information, chi-square and Cramér's V. p is the share of shuffled lexica in which they go together at least as much. Fields with many rare values share information by chance alone: compare with the mean of the shuffled ones.
help-command-stats-battison-s-conditions-symmetrical-signs-have = Battison's conditions: symmetrical signs have the same handshape on both hands; asymmetrical ones have the same one, or an unmarked one on the weak hand. They need the type of a sign (Signbank's 1, 2s, 2a, or words such as ASL-LEX's) and both handshapes.
help-command-stats-per-sign-measures-each-sign-density = `--per sign` measures each sign: density (neighbours that differ in at most `--within` fields), minimal pairs by field, homonyms, family (signs that are equal but for the handshape), the mean share of its values and of its pairs of values in their fields, captured tokens (the two hands count once) and their signers. `--store` keeps them with the entries: `density>20` is then a query, and `search --sort density`, `--count density` and tables know them.
help-command-stats-measure-each-sign-instead-lexicon = Measure each sign instead of the lexicon
help-command-stats-definition-neighbour = The definition of a neighbour
help-command-stats-most-fields-neighbours-differ = The most fields in which neighbours differ
help-command-stats-store-measures-attributes-entries = Store the measures as attributes of the entries; the earlier ones are replaced
help-command-stats-neighbours-homonyms-families-uses-each-sign = Neighbours, homonyms, families and uses of each sign
help-command-stats-every-other-entry-at-most-homonyms = Every other entry that differs in at most so many fields, homonyms too, if one value is the same
help-command-stats-every-other-entry-one-field-more = Every other entry that differs in one field or more, up to so many; homonyms are none
help-command-stats-every-other-form-so-many-fields = Every other form up to so many fields away; the entries of one form count once
help-command-stats-json-gives-source-columns-citations-tokens = `--json` gives "source" (columns, citations or tokens), "entries", "compared", "forms", "entropy", "fields" (each with "field", "values", "given", "empty", "successive", "entropy", "entropy_given", "load" and "frequent") and "findings"; with --of "of" ("values", "contrasts"), with --between "between" ("n", "bits", "chi_square", "df", "cramers_v", "p", "p_bits", "chance", "rows", "columns", "cells"), with --battison "battison" ("symmetry" and "dominance", each with "exceptions"). A number is "value" or null, "why", and "interval".
help-command-stats-tokens-instead-signs = (tokens instead of signs)
help-command-stats-tokens-count-as-in-chereme-search = The tokens to count, as in `chereme search`
help-command-stats-all-values-this-field-contrasts = All values of this field, and its contrasts
help-command-stats-association-these-two-fields-their-cross = The association of these two fields, and their cross table
help-command-stats-battison-s-conditions-on-signs-with = Battison's conditions on signs with two hands, and the signs that do not keep them
help-command-stats-handshapes-count-as-unmarked-without-b = The handshapes that count as unmarked; without it B, A, S, C, O, 1, 5
help-command-stats-most-values-contrasts-glosses-printed = The most values, contrasts and glosses that are printed
help-command-stats-number-shuffles-for-p-0-computes = The number of shuffles for p; 0 computes none
help-command-stats-write-table-csv-cross-table-values = Write a table (.csv): the cross table, the values of a field, the exceptions, the signs, or else the fields

## Titles of columns.

title-command-stats-field = field
title-command-stats-values = values
title-command-stats-empty = empty
title-command-stats-entropy = entropy
title-command-stats-without-empty = without empty
title-command-stats-load = load
title-command-stats-load-2 = ± load
title-command-stats-most-frequent = most frequent
title-command-stats-neighbours = neighbours
title-command-stats-homonyms = homonyms
title-command-stats-family = family
title-command-stats-probability = probability
title-command-stats-probability-pairs = of pairs
title-command-stats-signers = signers
title-command-stats-minimal-pairs = minimal pairs
title-command-stats-strong-hand = strong hand
title-command-stats-weak-hand = weak hand
