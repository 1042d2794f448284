## Messages: `{ $name }` is a variable part.

message-command-pairs-pairs-signs-compared-by-them-certain = paires : { $n }, de { $signs } signes ({ $all } comparés par { $fields }), dont certaines : { $certain } (les deux valeurs sont données)
line-command-pairs-homonyms-pairs-in-groups-signs-forms = homonymes : paires { $n }, groupes { $groups }, signes { $signs }, formes { $forms }
line-command-pairs-by-field = par champ : { $list }
line-command-pairs-in-most-pairs = dans le plus de paires : { $list }

## Help of commands and options.

help-command-pairs-count-minimal-pairs-lexicon = Compter les paires minimales d’un lexique
help-command-pairs-fields-compare-separated-by-commas-set = Les champs à comparer, séparés par des virgules, ou un ensemble de colonnes de Signbank : S13, F8, F7, F5, C3
help-command-pairs-treatment-empty-fields = Le traitement des champs vides
help-command-pairs-list-pairs = Énumérer les paires
help-command-pairs-two-signs-minimal-pair-if-exactly = Deux signes forment une paire minimale si un seul des champs diffère. Les champs sont les colonnes d’une table importée, dont les cellules sont comparées telles qu’écrites, ou des champs de requête comme dominant.configuration, sur lesquels les formes de citation sont comparées.
help-command-pairs-empty-field-value-like-any-other = Un champ vide est une valeur comme une autre
help-command-pairs-empty-field-unknown-signs-with-empty = Un champ vide est inconnu : les signes qui en ont un ne comptent pas
