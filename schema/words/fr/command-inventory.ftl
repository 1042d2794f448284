## Messages: `{ $name }` is a variable part.

line-command-inventory-added = { $value } ajouté à { $inventory }
line-command-inventory-from-now-on-annotations-changed-lexicon = { $from } est désormais { $to } ; annotations modifiées : { $n }, entrées du lexique : { $entries }
message-command-inventory-write-language-name-such-as-fr = écrivez LANGUE=NOM, comme fr=poing

## Help of commands and options.

help-command-inventory-add-values-inventory-merge-two-into = Ajouter des valeurs à un inventaire, ou en fusionner deux
help-command-inventory-add-value = Ajouter une valeur
help-command-inventory-inventory-such-as-configurations = L’inventaire, comme configurations
help-command-inventory-value-as-annotations-queries-spell = La valeur, telle que l’écrivent annotations et requêtes
help-command-inventory-another-spelling = Une autre graphie
help-command-inventory-broader-value-contains-this-one-as = La valeur plus large qui contient celle-ci, comme head contient chin
help-command-inventory-symbols-in-hamnosys-by-name = Ses symboles en HamNoSys, par leurs noms
help-command-inventory-value-removed = La valeur qui disparaît
help-command-inventory-value-stays = La valeur qui reste
help-command-inventory-name-in-spoken-language-such-as = Son nom dans une langue parlée, comme fr="main pliée"
help-command-inventory-feature-value-such-as-index-spread = Un trait de la valeur, comme index ou spread
help-command-inventory-merge-two-values-annotations-with-first = Fusionner deux valeurs : les annotations qui ont la première reçoivent la seconde
help-command-inventory-inventory = L’inventaire
help-command-inventory-each-call-one-operation-chereme-undo = Chaque appel est une opération que `chereme undo` annule. `chereme list CORPUS inventories` nomme les inventaires ; `chereme export CORPUS inventory:NAME --to x.json` en écrit un, et `import` le relit.
help-command-inventory-spelling-first-value-becomes-another-spelling = La graphie de la première valeur devient une autre graphie de la seconde : une table avec l’ancienne graphie peut être importée de nouveau.
