## Messages: `{ $name }` is a variable part.

line-command-choose-more-not-compared = pas comparées non plus : { $n }
line-command-choose-performances-for-compared = { $n } exécutions de { $function } pour { $sign }, { $order } ; comparé : { $channels }
message-command-choose-most-similar-own-face-first = d’abord la plus semblable à son propre visage
message-command-choose-least-similar-own-face-first = d’abord la moins semblable à son propre visage
message-command-choose-most-usual-first = d’abord la plus habituelle
line-command-choose-left-out-as-they-unknown = laissés de côté, car inconnus : { $names }
message-command-choose-comparisons-with-phases-too-different-lengths = comparaisons de phases de durées trop différentes pour la fenêtre de 10 images, qui a été élargie : { $n }
line-command-choose-each-compared-with-others = comparaisons de chacune avec d’autres : { $n }
line-command-choose-not-compared = pas comparée : { $token } : { $why }

## Help of commands and options.

help-command-choose-rank-recorded-expressions-face-such-as = Classer pour une phrase les expressions du visage enregistrées, comme celles d’une négation, et l’animer avec l’une d’elles
help-command-choose-function-expression-negation-wh-yn-topic = La fonction de l’expression : negation, wh, yn, topic, conditional, rhetorical, ou un autre mot de l’acteur des fonctions
help-command-choose-sentence-recording-token-in-annotation-function = La phrase : un enregistrement, une occurrence qu’il contient, ou l’annotation de sa fonction
help-command-choose-order-ranking = L’ordre du classement
help-command-choose-how-many-performances-report = Combien d’exécutions donner
help-command-choose-animate-sentence-with-face-store-under = Animer la phrase avec ce visage, et l’enregistrer sous cette glose
help-command-choose-address-performance-animate-with-without-first = L’adresse de l’exécution avec laquelle animer ; sinon la première du classement
help-command-choose-channels-compare-separated-by-commas-head = Les canaux à comparer, séparés par des virgules : head, brow, eye, gaze, jaw, mouth … ; sinon la tête et les sourcils
help-command-choose-weights-phases-onset-first-rest-offset = Les poids des phases onset, first, rest et offset, par exemple 1,2,2,0.5
help-command-choose-leave-ratio-lengths-out-score = Ne pas compter le rapport des durées
help-command-choose-refuse-phases-no-path-within-alignment = Refuser les phases qu’aucun chemin dans la fenêtre d’alignement (10 images) ne relie, au lieu d’élargir la fenêtre
help-command-choose-most-similar-sentence-s-own-face = La plus proche du visage propre de la phrase ; le médoïde si ce visage n’a pas été enregistré
help-command-choose-least-similar-sentence-s-own-face = La plus éloignée du visage propre de la phrase
help-command-choose-most-similar-all-others = La plus proche de toutes les autres
help-command-choose-dynamic-time-warping-aligns-each-phase = La déformation temporelle dynamique aligne chaque phase d’une exécution enregistrée (voir `milestones`) sur la même phase du visage propre de la phrase. Le score est la somme des distances fois le rapport des durées ; 0 est le même visage. Si le visage de la phrase n’a pas été enregistré, l’exécution la plus typique, le médoïde, vient en premier. Un enregistrement n’est jamais son propre candidat ; à score égal, l’ordre est celui des noms.
help-command-choose-with-as-sentence-generated-again-with = Avec --as, la phrase est générée de nouveau avec la tête, le tronc et le visage de la première exécution, ou de celle que --use nomme ; chacune de ses phases est étirée à la durée de celle de la phrase.
help-command-choose-json-gives-ranking-each-with-token = `--json` donne "ranking", chacune avec "token", "recording", "score", "unstretched", "stretch", "partial", "phases" ("phase", "frames", "distance", "normalized", "made", "channels") et "channels", et "channels", "left_out", "compared", "adapted", "skipped" ; avec --as "made" et "recipe".

## Titles of columns.

title-command-choose-differs-most-in = diffère surtout par
title-command-choose-score = score
title-command-choose-stretch = étirement
