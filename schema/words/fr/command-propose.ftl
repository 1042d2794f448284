## Messages: `{ $name }` is a variable part.

line-command-propose-accepted = accepté : { $n }
line-command-propose-rejected = rejeté : { $n }
line-command-propose-in-for-could-not-read-from = { $annotations } dans { $recordings }, pour { $tokens } ; illisible dans le mouvement : { $unread }
line-command-propose-left-because-something-else-lies = laissées, car autre chose occupe leur place : { $n }
line-command-propose-by-confidence = par confiance, à partir de : { $counts }

## Help of commands and options.

help-command-propose-propose-values-component-from-movement-for = Proposer d’après le mouvement des valeurs d’un composant, pour les occurrences qui n’en ont pas ; ou lancer un détecteur sur des enregistrements
help-command-propose-run-this-detector-on-every-recording = Lancer ce détecteur sur tous les enregistrements, ou sur celui de --for
help-command-propose-component-configuration-handshape-placement-movement-orientation = Le composant : configuration (ou handshape), placement, movement ou orientation ; sinon les quatre
help-command-propose-only-for-tokens-this-recording-for = Seulement pour les occurrences de cet enregistrement, ou pour cette occurrence
help-command-propose-accept-these-proposals-by-numbers-their = Accepter ces propositions, par les numéros de leurs annotations, comme vos propres codages ; sans numéros, toutes celles que désignent les autres options
help-command-propose-reject-these-proposals-by-numbers-their = Rejeter ces propositions, par les numéros de leurs annotations ; sans numéros, toutes celles que désignent les autres options
help-command-propose-accept-those-tiers-with-this-name = Accepter ou rejeter celles des acteurs de ce nom
help-command-propose-accept-those-with-this-confidence = Accepter ou rejeter celles dont la confiance atteint ce nombre, de 0 à 1
help-command-propose-with-accept-proposals-become-your-own = Avec --accept, les propositions deviennent vos propres codages, sur les acteurs que vous avez pour ce composant et cette main ; les acteurs de propositions devenus vides sont supprimés. Sans numéros, toutes sont acceptées, ou celles d’un composant, de --for, de --tier et de --confidence. Avec --reject elles restent sur des acteurs comme « configuration dominant (rejected) », ne comptent nulle part et ne sont pas proposées à nouveau.
help-command-propose-movement-each-token-transcribed-values-written = La configuration et la paume de chaque main sont lues à leurs tenues, les lieux d’après le signe entier ; tous sont écrits dans le temps d’une tenue, et les mouvements dans le temps de leurs actes. Les valeurs sont écrites sur des acteurs à part, comme « configuration dominant (proposed) », en annotations d’un détecteur ; « en mouvement » dit que rien n’y est tenu. Elles ne comptent ni dans les recherches, les décomptes et les statistiques, ni dans les recettes et les exports d’occurrences, tant que personne ne les a acceptées ; la condition `proposed:yes` les lit. Un appel est une opération, que `undo` annule. Ctrl-C l’arrête et laisse le corpus tel qu’il était.
help-command-propose-with-detector-short-for-detect = Avec --detector rien n’est transcrit ; c’est une forme brève de `detect --propose`.
help-command-propose-json-gives-tokens-annotations-numbers-those = `--json` donne "tokens" et "annotations", les nombres de celles qui ont été écrites, "unread", le nombre d’occurrences dont le mouvement n’a pas pu être transcrit, "recordings", les noms de ceux qui ont de nouvelles annotations, "by_confidence", les nombres d’annotations par dixième de confiance, et "codings", les valeurs, chacune avec "token", "gloss", "field", "value", "start_us", "end_us", "confidence", "is_moving" si rien n’est tenu, et "runner_up" en mots de notation. Avec --accept ou --reject il donne ce que donne `annotate`, et "left", le nombre de propositions pour lesquelles il n’y a pas de place. Avec --detector il donne ce que donne `detect`.
help-command-propose-finds-proposed-codings-too = (trouve aussi les codages proposés)
help-command-propose-takes-all-them-back = (les retire tous)
message-command-propose-moving = en mouvement
message-command-propose-numbers-name-proposals-already = des numéros d’annotations désignent déjà des propositions : omettez la composante, --for, --tier et --confidence
