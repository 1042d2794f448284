## Messages: `{ $name }` is a variable part.

line-command-history-limit-shows-more = et { $n } ; --limit en montre plus
line-command-history-rows = lignes : { $names }
message-command-history-write-how-many-operations-1-more = écrivez combien d’opérations, 1 ou plus
message-command-history-write-number-operation-such-as-12 = écrivez le numéro d’une opération, comme 12

## Help of commands and options.

help-command-history-undo-last-change = Annuler la dernière modification
help-command-history-how-many-operations-undo = Combien d’opérations annuler
help-command-history-redo-change-undone-last = Rétablir ce qui vient d’être annulé
help-command-history-how-many-operations-redo = Combien d’opérations rétablir
help-command-history-list-operations-newest-first-show-changes = Lister les opérations, la plus récente d’abord, ou montrer ce que l’une d’elles a changé
help-command-history-operation-show-in-detail-by-number = L’opération à montrer en détail, par son numéro dans la liste
help-command-history-show-changes-below-each-operation = Montrer sous chaque opération ce qu’elle a changé
help-command-history-list-at-most-n-operations-each = Lister au plus N opérations, et de chacune au plus N modifications
help-command-history-every-change-can-undone-also-after = Toute modification peut être annulée, même après un redémarrage. Si --times dépasse le nombre d’opérations, toutes sont annulées, et la commande dit combien ; elle n’échoue que s’il n’y avait rien à annuler.
help-command-history-for-one-operation-with-changes-for = Pour une opération, ou avec --changes pour chacune, énumère les annotations, acteurs, enregistrements, signes et valeurs ajoutés, modifiés ou supprimés : leur nom, et chaque champ, avant et après.
