## Messages: `{ $name }` is a variable part.

line-command-history-limit-shows-more = and { $n }; --limit shows more
line-command-history-rows = rows: { $names }
message-command-history-write-how-many-operations-1-more = write how many operations, 1 or more
message-command-history-write-number-operation-such-as-12 = write the number of an operation, such as 12

## Help of commands and options.

help-command-history-undo-last-change = Undo the last change
help-command-history-how-many-operations-undo = How many operations to undo
help-command-history-redo-change-undone-last = Redo the change that was undone last
help-command-history-how-many-operations-redo = How many operations to redo
help-command-history-list-operations-newest-first-show-changes = List the operations, newest first, or show the changes of one of them
help-command-history-operation-show-in-detail-by-number = The operation to show in detail, by its number in the list
help-command-history-show-changes-below-each-operation = Show the changes below each operation
help-command-history-list-at-most-n-operations-each = List at most N operations, and of each at most N changes
help-command-history-every-change-can-undone-also-after = Every change can be undone, also after a restart. If --times is greater than the number of operations, all of them are undone, and the command reports how many; it fails only if there was nothing to undo.
help-command-history-for-one-operation-with-changes-for = For one operation, or with --changes for each of them, lists every annotation, tier, recording, sign and value that was added, changed or removed: its name, and each field before and after.
