## Messages: `{ $name }` is a variable part.

line-command-list-mb-schema-version = { $path } : { $size } Mo, version { $version } du schéma
line-command-list-holds = contient : { $list }
line-command-list-movement-hours = mouvement : { $hours } heures, { $frames }
line-command-list-markers-hours = marqueurs : { $hours } heures, { $frames }
line-command-list-faces-other-curves-hours = visages et autres courbes : { $hours } heures, { $frames }
message-command-list-recordings = enregistrements : { $list }
line-command-list-tracks = pistes : { $list }
message-command-list-tiers = acteurs : { $list }
message-command-list-signer-handedness-not-known = signeur { $name } : latéralité inconnue, { $n }
message-command-list-signer-right = signeur { $name } : droitier, { $n }
message-command-list-signer-left = signeur { $name } : gaucher, { $n }
line-command-list-signer = signeur { $name } : { $hand }, { $n }
message-command-list-inventories = inventaires : { $list }
line-command-list-attributes-signs = attributs des signes : { $list }
line-command-list-last-change-by = dernière modification : { $at } par { $who } : { $what }
message-command-list-write-column-pattern-such-as-gloss = écrivez COLONNE=MOTIF, comme gloss=BO*

## Help of commands and options.

help-command-list-only-values-this-inventory-name-may = Seulement les valeurs de cet inventaire, dont le nom peut contenir des espaces
help-command-list-what-list = Quoi lister
help-command-list-only-rows-with-these-values-such = Seulement les lignes de ces valeurs, comme gloss=BO*, start_us=>=500000, recording=recording:3, parent=none
help-command-list-column-sort-by = La colonne du tri
help-command-list-sort-from-greatest-least = Trier du plus grand au plus petit
help-command-list-list-at-most-n-rows = Lister au plus N lignes
help-command-list-skip-first-n-rows = Sauter les N premières lignes
help-command-list-show-overview-corpus = Donner un aperçu d’un corpus
help-command-list-list-rows-recordings-tracks-signs-tokens = Lister : enregistrements (recordings), pistes (tracks), signes (signs), occurrences (tokens), acteurs (tiers), annotations, inventaires (inventories), valeurs (values), signeurs (signers), recherches (searches), études (studies), opérations (operations)
