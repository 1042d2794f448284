## Messages: `{ $name }` is a variable part.

line-command-list-mb-schema-version = { $path }: { $size } MB, schema version { $version }
line-command-list-holds = holds: { $list }
line-command-list-movement-hours = movement: { $hours } hours, { $frames }
line-command-list-markers-hours = markers: { $hours } hours, { $frames }
line-command-list-faces-other-curves-hours = faces and other curves: { $hours } hours, { $frames }
message-command-list-recordings = recordings: { $list }
line-command-list-tracks = tracks: { $list }
message-command-list-tiers = tiers: { $list }
message-command-list-signer-handedness-not-known = signer { $name }: handedness not known, { $n }
message-command-list-signer-right = signer { $name }: right, { $n }
message-command-list-signer-left = signer { $name }: left, { $n }
line-command-list-signer = signer { $name }: { $hand }, { $n }
message-command-list-inventories = inventories: { $list }
line-command-list-attributes-signs = attributes of signs: { $list }
line-command-list-last-change-by = last change: { $at } by { $who }: { $what }
message-command-list-write-column-pattern-such-as-gloss = write COLUMN=PATTERN, such as gloss=BO*

## Help of commands and options.

help-command-list-only-values-this-inventory-name-may = Only values of this inventory; its name may contain blanks
help-command-list-what-list = What to list
help-command-list-only-rows-with-these-values-such = Only rows with these values, such as gloss=BO*, start_us=>=500000, recording=recording:3, parent=none
help-command-list-column-sort-by = The column to sort by
help-command-list-sort-from-greatest-least = Sort from the greatest to the least
help-command-list-list-at-most-n-rows = List at most N rows
help-command-list-skip-first-n-rows = Skip the first N rows
help-command-list-show-overview-corpus = Show an overview of a corpus
help-command-list-list-rows-recordings-tracks-signs-tokens = List rows: recordings, tracks, signs, tokens, tiers, annotations, inventories, values, signers, searches, studies, operations
