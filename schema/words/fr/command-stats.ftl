## Messages: `{ $name }` is a variable part.

line-command-stats-entries-compared-different-forms = entrées : { $n }, comparées : { $m }, formes différentes : { $k }
line-command-stats-entropy-forms-in-bits = entropie des formes en bits : { $number }
line-command-stats-values-in-entries-entries-without-one = { $field } : { $n } valeurs dans { $given } entrées, { $empty } entrées sans valeur
line-command-stats-entropy-in-bits-without-empty-cells = entropie en bits : { $all } ; sans les cellules vides : { $given }
line-command-stats-functional-load = charge fonctionnelle : { $number }
line-command-stats-contrasts = contrastes : - ({ $why })
message-command-stats-contrasts-distinguish-signs-largest-load-first = contrastes qui distinguent des signes, la plus grande charge d’abord ; ∅ est la cellule vide
line-command-stats-contrasts-not-shown-json-has-all = contrastes non affichés : { $n } ; --json les donne tous
line-command-stats-rows-not-shown-json-has-all = lignes non affichées : { $n } ; --json les donne toutes
line-command-stats-columns-not-shown-json-has-all = colonnes non affichées : { $n } ; --json les donne toutes
line-command-stats-exceptions-not-shown-json-has-all = exceptions non affichées : { $n } ; --json les donne toutes
line-command-stats-entries-with-both-left-out = { $one } × { $other } : { $n } entrées avec les deux, { $m } laissées de côté
line-command-stats-mutual-information-in-bits-shuffled-p = information mutuelle en bits : { $bits } (mélangé : { $mean }), p { $p }
line-command-stats-chi-square-shuffled-df-p = chi carré : { $value } (mélangé : { $mean }), degrés de liberté { $df }, p { $p }
line-command-stats-cramer-s-v = V de Cramér : { $value }
line-command-stats-one-handed-symmetrical-asymmetrical-no-known = à une main : { $n }, symétriques : { $s }, asymétriques : { $a }, d’aucun type connu : { $o }
line-command-stats-unmarked-handshapes = configurations non marquées : { $list }
line-command-stats-symmetry-both-handshapes-given-same-different = symétrie : les deux configurations données { $n }, les mêmes { $same }, différentes { $other } ; respectée par { $share }
message-command-stats-dominance-both-handshapes-given-same-different = dominance : les deux configurations données { $n }, les mêmes { $same }, différentes { $other }, dont main dominée non marquée { $k } ; respectée par { $share } ; main dominée non marquée dans { $all }
message-command-stats-entries-do-not-keep-symmetry = entrées qui ne respectent pas la symétrie : { $n }
message-command-stats-entries-do-not-keep-dominance = entrées qui ne respectent pas la dominance : { $n }
line-command-stats-without-one-handshapes = sans l’une des configurations : { $list }
line-command-stats-entries = entrées : { $list }
line-command-stats-entries-measured-neighbours-mean-median = entrées : { $n }, mesurées : { $m } ; voisins : moyenne { $mean }, médiane { $median } ; signes sans voisin : { $k }
line-command-stats-fields-of-forms = champs : { $list }
line-command-stats-signs-not-shown-to-json-have-all = signes non affichés : { $n } ; --to et --json les ont tous
line-command-stats-entries-with-stored-measures = entrées aux mesures enregistrées : { $n }
line-command-stats-table = table : { $path }

## Help of commands and options.

help-command-stats-describe-lexicon-by-numbers-entropy-functional = Décrire un lexique par des nombres : entropie, charge fonctionnelle, association de champs, conditions sur les mains
help-command-stats-every-sign-counts-once-by-citation = Chaque signe compte une fois, par sa forme de citation ; avec une requête, chaque occurrence qu’elle trouve. Les champs sont des colonnes d’une table importée, dont les cellules sont prises telles qu’écrites, ou des champs de requête comme dominant.configuration, comme dans `chereme pairs`.
help-command-stats-entropy-in-bits-from-shares-as = L’entropie est en bits, à partir des parts telles quelles. La charge fonctionnelle d’un champ est la part de l’entropie des formes qui se perd sans lui, (H(L) - H(L sans lui)) / H(L) ; celle d’un contraste est la part qui se perd si ses deux valeurs n’en font qu’une. Les intervalles à 95 % sont ceux du jackknife sur les entrées, et de Wilson pour les parts. Des tirages avec remise prendraient deux fois la même entrée, un homonyme que le lexique n’a pas.
help-command-stats-association-counts-entries-have-both-fields = L’association compte les entrées qui ont les deux champs : information mutuelle, chi carré et V de Cramér. p est la part des lexiques mélangés où ils vont ensemble au moins autant. Des champs à beaucoup de valeurs rares partagent de l’information par le seul hasard : comparez avec la moyenne des lexiques mélangés.
help-command-stats-battison-s-conditions-symmetrical-signs-have = Conditions de Battison : les signes symétriques ont la même configuration aux deux mains ; les asymétriques ont la même, ou une configuration non marquée à la main dominée. Il faut le type du signe (1, 2s, 2a de Signbank, ou des mots comme ceux d’ASL-LEX) et les deux configurations.
help-command-stats-per-sign-measures-each-sign-density = `--per sign` mesure chaque signe : densité (les voisins qui diffèrent dans `--within` champs au plus), paires minimales par champ, homonymes, famille (les signes égaux à la configuration près), part moyenne de ses valeurs et de ses paires de valeurs dans leurs champs, occurrences captées (les deux mains comptent une fois) et leurs signeurs. `--store` les garde avec les entrées : `density>20` est alors une requête, et `search --sort density`, `--count density` et les tables les connaissent.
help-command-stats-measure-each-sign-instead-lexicon = Mesurer chaque signe au lieu du lexique
help-command-stats-definition-neighbour = La définition d’un voisin
help-command-stats-most-fields-neighbours-differ = Le nombre maximal de champs où des voisins diffèrent
help-command-stats-store-measures-attributes-entries = Enregistrer les mesures comme attributs des entrées ; les précédentes sont remplacées
help-command-stats-neighbours-homonyms-families-uses-each-sign = Voisins, homonymes, familles et usages de chaque signe
help-command-stats-every-other-entry-at-most-homonyms = Toute autre entrée qui diffère dans ce nombre de champs au plus, homonymes compris, si une valeur est commune
help-command-stats-every-other-entry-one-field-more = Toute autre entrée qui diffère dans un champ ou plus, jusqu’à ce nombre ; les homonymes n’en sont pas
help-command-stats-every-other-form-so-many-fields = Toute autre forme jusqu’à ce nombre de champs ; les entrées d’une même forme comptent une fois
help-command-stats-json-gives-source-columns-citations-tokens = `--json` donne "source" (columns, citations ou tokens), "entries", "compared", "forms", "entropy", "fields" (chacun avec "field", "values", "given", "empty", "successive", "entropy", "entropy_given", "load" et "frequent") et "findings" ; avec --of "of" ("values", "contrasts"), avec --between "between" ("n", "bits", "chi_square", "df", "cramers_v", "p", "p_bits", "chance", "rows", "columns", "cells"), avec --battison "battison" ("symmetry" et "dominance", chacune avec "exceptions"). Un nombre est "value" ou null, "why" et "interval".
help-command-stats-tokens-instead-signs = (des occurrences au lieu de signes)
help-command-stats-tokens-count-as-in-chereme-search = Les occurrences à compter, comme dans `chereme search`
help-command-stats-all-values-this-field-contrasts = Toutes les valeurs de ce champ, et ses contrastes
help-command-stats-association-these-two-fields-their-cross = L’association de ces deux champs, et leur tableau croisé
help-command-stats-battison-s-conditions-on-signs-with = Les conditions de Battison sur les signes à deux mains, et les signes qui ne les respectent pas
help-command-stats-handshapes-count-as-unmarked-without-b = Les configurations qui comptent comme non marquées ; sinon B, A, S, C, O, 1, 5
help-command-stats-most-values-contrasts-glosses-printed = Le nombre maximal de valeurs, de contrastes et de gloses affichés
help-command-stats-number-shuffles-for-p-0-computes = Le nombre de mélanges pour p ; 0 n’en calcule pas
help-command-stats-write-table-csv-cross-table-values = Écrire une table (.csv) : le tableau croisé, les valeurs d’un champ, les exceptions, les signes, ou sinon les champs

## Titles of columns.

title-command-stats-field = champ
title-command-stats-values = valeurs
title-command-stats-empty = vide
title-command-stats-entropy = entropie
title-command-stats-without-empty = sans vide
title-command-stats-load = charge
title-command-stats-load-2 = ± charge
title-command-stats-most-frequent = les plus fréquentes
title-command-stats-neighbours = voisins
title-command-stats-homonyms = homonymes
title-command-stats-family = famille
title-command-stats-probability = probabilité
title-command-stats-probability-pairs = des paires
title-command-stats-signers = signeurs
title-command-stats-minimal-pairs = paires minimales
title-command-stats-strong-hand = main dominante
title-command-stats-weak-hand = main dominée
