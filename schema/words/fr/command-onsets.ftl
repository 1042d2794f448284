## Messages: `{ $name }` is a variable part.

line-command-onsets-expressions-without-face = expressions : { $n } ; sans visage : { $none }
line-command-onsets-expressions-during-nothing-measured-at-times = expressions pendant lesquelles rien n’a été mesuré par moments : { $n }
message-command-onsets-expressions-more-than-half-hour-not = expressions de plus d’une demi-heure, qui n’ont pas été examinées : { $n } ; annotez-en de plus courtes

## Help of commands and options.

help-command-onsets-measure-when-non-manuals-begin-end = Mesurer quand les éléments non manuels commencent et finissent par rapport aux signes qu’ils couvrent, pour chaque fonction
help-command-onsets-channel-face-head-begins-when-halfway = Un canal du visage ou de la tête commence quand il est à mi-chemin entre sa valeur une demi-seconde avant l’expression et sa valeur la plus extrême pendant les signes, et finit quand il est revenu à mi-chemin ; s’il n’est pas revenu une demi-seconde après M5, il n’a pas de fin. Les débuts sont en secondes après le début du premier signe (négatif : avant lui), les fins en secondes après la fin du dernier. Les fonctions sont celles de `milestones`.
help-command-onsets-json-gives-expressions-without-face-with = `--json` donne "expressions", "without_face", "with_gaps", "too_long" et "rows", chacune avec "function", "channel", "n", "onset_s" ("q1", "median", "q3"), "ends" et "offset_s", qui est null sans fins.

## Titles of columns.

title-command-onsets-n-ends = n des fins
title-command-onsets-begins-median-quartiles = début : médiane (quartiles)
title-command-onsets-ends-median-quartiles = fin : médiane (quartiles)
