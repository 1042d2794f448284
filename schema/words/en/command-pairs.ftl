## Messages: `{ $name }` is a variable part.

message-command-pairs-pairs-signs-compared-by-them-certain = { $n } pairs of { $signs } signs ({ $all } compared by { $fields }), { $certain } of them certain: both values are given
line-command-pairs-homonyms-pairs-in-groups-signs-forms = homonyms: { $n } pairs in { $groups } groups of { $signs } signs; { $forms } forms
line-command-pairs-by-field = by field: { $list }
line-command-pairs-in-most-pairs = in most pairs: { $list }

## Help of commands and options.

help-command-pairs-count-minimal-pairs-lexicon = Count the minimal pairs of a lexicon
help-command-pairs-fields-compare-separated-by-commas-set = The fields to compare, separated by commas, or a set of Signbank's columns: S13, F8, F7, F5, C3
help-command-pairs-treatment-empty-fields = The treatment of empty fields
help-command-pairs-list-pairs = List the pairs
help-command-pairs-two-signs-minimal-pair-if-exactly = Two signs are a minimal pair if exactly one of the fields differs. Fields are columns of an imported table, whose cells are compared as written, or fields of queries such as dominant.configuration, by which citation forms are compared.
help-command-pairs-empty-field-value-like-any-other = An empty field is a value like any other
help-command-pairs-empty-field-unknown-signs-with-empty = An empty field is unknown: signs with an empty field do not count
