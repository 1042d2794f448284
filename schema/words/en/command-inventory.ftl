## Messages: `{ $name }` is a variable part.

line-command-inventory-added = added { $value } to { $inventory }
line-command-inventory-from-now-on-annotations-changed-lexicon = { $from } is { $to } from now on; annotations changed: { $n }, lexicon entries: { $entries }
message-command-inventory-write-language-name-such-as-fr = write LANGUAGE=NAME, such as fr=poing
line-command-inventory-parted = { $value } is one with no other value any more
message-command-inventory-makes-one = `chereme inventory CORPUS equate VALUE OTHER` makes two of them one
message-command-inventory-none-equal = no values of different inventories are one: `chereme inventory CORPUS equate --propose` finds some

## Help of commands and options.

help-command-inventory-add-values-inventory-merge-two-into = Add values to an inventory, merge two into one, or say which values of two inventories are one
help-command-inventory-add-value = Add a value
help-command-inventory-inventory-such-as-configurations = The inventory, such as configurations
help-command-inventory-value-as-annotations-queries-spell = The value, as annotations and queries spell it
help-command-inventory-another-spelling = Another spelling
help-command-inventory-broader-value-contains-this-one-as = The broader value that contains this one, as head contains chin
help-command-inventory-symbols-in-hamnosys-by-name = Its symbols in HamNoSys, by name
help-command-inventory-value-removed = The value that is removed
help-command-inventory-value-stays = The value that stays
help-command-inventory-name-in-spoken-language-such-as = Its name in a spoken language, such as en="bent hand"
help-command-inventory-feature-value-such-as-index-spread = A feature of the value, such as index or spread
help-command-inventory-merge-two-values-annotations-with-first = Merge two values: annotations with the first value get the second one
help-command-inventory-inventory = The inventory
help-command-inventory-each-call-one-operation-chereme-undo = Each call is one operation that `chereme undo` takes back. `chereme list CORPUS inventories` names the inventories; `chereme export CORPUS inventory:NAME --to x.json` writes one, and `import` reads it again.
help-command-inventory-spelling-first-value-becomes-another-spelling = The spelling of the first value becomes another spelling of the second, so that a table with the old spelling can be imported again.
help-command-inventory-equate = Say which values of two inventories are one, list those that are, or propose some
help-command-inventory-each-coding-keeps-word = Each coding keeps its own word, and a search by either word finds both; counts, pickers and dictionaries show the value once, as a rule by the second of the two words. Without values, those that are one are listed. Values are proposed if they are equal in name, symbols, posture, place, direction, orientation or features, and are one only when you say so. `--json` gives "equal_values" (groups, that which stands for the others first) or "proposals".
help-command-inventory-both-values = Both values, as INVENTORY/VALUE; the second stands for the first
help-command-inventory-list-likely = List values that seem to be one, with the reasons
help-command-inventory-take-out = Take this value out of those that it is one with

## Titles of columns.

title-command-inventory-same-as = the same as
title-command-inventory-equal-in = equal in
