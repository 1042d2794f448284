## Messages: `{ $name }` is a variable part.

line-command-inventory-added = { $value } ajouté à { $inventory }
line-command-inventory-from-now-on-annotations-changed-lexicon = { $from } est désormais { $to } ; annotations modifiées : { $n }, entrées du lexique : { $entries }
message-command-inventory-write-language-name-such-as-fr = écrivez LANGUE=NOM, comme fr=poing
line-command-inventory-parted = { $value } est désormais séparée de toute autre valeur
message-command-inventory-makes-one = `chereme inventory CORPUS equate VALEUR AUTRE` en réunit deux
message-command-inventory-none-equal = aucune valeur n’en fait qu’une avec celle d’un autre inventaire : `chereme inventory CORPUS equate --propose` en propose

## Help of commands and options.

help-command-inventory-add-values-inventory-merge-two-into = Ajouter des valeurs à un inventaire, en fusionner deux, ou dire quelles valeurs de deux inventaires n’en font qu’une
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
help-command-inventory-equate = Dire quelles valeurs de deux inventaires n’en font qu’une, lister celles qui le font, ou en proposer
help-command-inventory-each-coding-keeps-word = Chaque codage garde son mot, et une recherche par l’un des mots trouve les deux ; décomptes, listes de choix et dictionnaires montrent la valeur une fois, en règle générale par le second mot. Sans valeurs, celles qui n’en font qu’une sont listées. Des valeurs sont proposées si elles ont en commun le nom, les symboles, la posture, le lieu, la direction, l’orientation ou les traits, et n’en font qu’une que si vous le dites. `--json` donne "equal_values" (des groupes, celle qui vaut pour les autres en premier) ou "proposals".
help-command-inventory-both-values = Les deux valeurs, comme INVENTAIRE/VALEUR ; la seconde vaut pour la première
help-command-inventory-list-likely = Lister les valeurs qui semblent n’en faire qu’une, avec les raisons
help-command-inventory-take-out = Séparer cette valeur de celles avec lesquelles elle n’en fait qu’une

## Titles of columns.

title-command-inventory-same-as = la même que
title-command-inventory-equal-in = égales par
