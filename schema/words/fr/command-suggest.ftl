## Messages: `{ $name }` is a variable part.

line-command-suggest-possible-pairs-in-one-sign-not = paires possibles, où un signe n’est pas codé pour tous les champs ({ $n } sur { $all }) :
line-command-suggest-values-no-sign-has-with-rest = valeurs de { $field } qu’aucun signe n’a avec le reste : { $list }
message-command-suggest-no-sign-differs-from-in-one = aucun signe n’en diffère par un seul composant

## Help of commands and options.

help-command-suggest-suggest-new-signs-could-composed-from = Suggérer de nouveaux signes à composer à partir d’un signe
help-command-suggest-sign-gloss-token-41 = Le signe : une glose ou token:41
help-command-suggest-lists-signs-differ-from-in-exactly = Énumère les signes qui en diffèrent par un seul champ (paires minimales), chacun avec une recette si l’une le compose à partir du signe, et les valeurs qu’aucun signe ne combine avec le reste de son codage.

## Titles of columns.

title-command-suggest-alike-in = pareils en
