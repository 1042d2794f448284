## Messages: `{ $name }` is a variable part.

line-command-milestones-phases-written-expressions-keep-corrected-milestones = phases écrites : { $n } ; expressions qui gardent des jalons corrigés : { $kept }
message-command-milestones-no-tier-names-functions-annotate-wh = aucun acteur ne nomme de fonctions ; annotez wh, yn, negation ou topic sur un acteur appelé "function"
message-command-milestones-no-such-expression-functions = pas de telle expression ; les fonctions sont : { $names }

## Help of commands and options.

help-command-milestones-derive-milestones-expressions-face-from-glosses = Déduire des gloses et des fonctions les jalons des expressions du visage, sous forme d’acteurs
help-command-milestones-tier-names-functions-without-those-called = L’acteur qui nomme les fonctions ; sinon ceux qui s’appellent fonction, construction, type de phrase, etc.
help-command-milestones-report-milestones-write-nothing = Donner les jalons, sans rien écrire
help-command-milestones-tier-called-function-construction-clause-type = Un acteur nommé « function » (ou construction, clause type, fonction ; un autre avec --tier) porte une annotation comme wh, yn, negation ou topic au-dessus des signes de chaque expression. M1 est la fin du signe qui précède l’expression, M2 le début de son premier signe, M3 le début de son deuxième signe (negation) ou de son dernier (toutes les autres), M4 la fin de son dernier signe, et M5 le début du signe qui la suit. Sans signe avant ou après elle dans l’énoncé, M1 ou M5 est à 500 ms. L’énoncé est une annotation d’un acteur de traduction s’il y en a un, sinon tout l’enregistrement. Une expression sur un seul signe n’a pas de M3.
help-command-milestones-phases-m1-m2-m2-m3-m3 = Les phases M1-M2, M2-M3, M3-M4 et M4-M5 sont écrites sur un acteur tel que « milestones wh ». La commande ne change jamais les phases qu’une personne a déplacées ou écrites. `undo` annule la dernière modification.
help-command-milestones-json-gives-written-kept-functions-expressions = `--json` donne "written", "kept", "functions" et "expressions", chacune avec "recording", "address", "function", "signs", "m1_us" à "m5_us" ("m3_us" est null pour un seul signe), "corrected" et "findings".
help-command-milestones-all-functions-nothing-written = (toutes les fonctions ; rien n’est écrit)
help-command-milestones-milestone-corrected = (un jalon corrigé)

## Titles of columns.

title-command-milestones-address = adresse
