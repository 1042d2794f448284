## Messages: `{ $name }` is a variable part.

line-command-check-mended = mended: { $what }
line-command-check-not-damage-but-against-rules-tiers = not damage, but against the rules of tiers: { $count }
message-command-check-all-well-looked-at = all is well: looked at { $list }
message-command-check-there-faults-looked-at = there are faults: looked at { $list }
message-command-check-check-cannot-go-on-take-backup = the check cannot go on: take a backup, or save what can be read with `chereme export CORPUS all --to FOLDER`

## Help of commands and options.

help-command-check-look-for-damage-database-rows-files = Look for damage: database, rows, files and blocks by their hashes, tokens, history, search index
help-command-check-rebuild-derived-data-tokens-wrong-search = Rebuild derived data: tokens that are wrong, and the search index
help-command-check-take-rows-as-they-now-for = Take the rows as they are now for right, after a change by another program
help-command-check-reports-all-damage-with-remedy-exit = Reports all damage with its remedy; the exit code is 1 if there is any. Annotations that break the rules of tiers are listed as questions about the data: they came so from a file.
