## Messages: `{ $name }` is a variable part.

message-command-score-distance-in-all-for-each-frame = distance { $n } en tout, { $mean } par image des deux (0 : le même mouvement ; chaque partie a sa propre échelle)
line-command-score-largest-distance-joint-cm = plus grande distance d’une articulation : { $cm } cm
line-command-score-alignment = alignement : { $n }
message-command-score-score-0-alike-without-ratio-lengths = score { $n } (0 : pareil) ; sans le rapport des durées { $other }, rapport { $ratio } ; une phase est vide dans l’un des deux et laissée de côté
message-command-score-score-0-alike-without-ratio-lengths-ratio = score { $n } (0 : pareil) ; sans le rapport des durées { $other }, rapport { $ratio }

## Help of commands and options.

help-command-score-measure-similarity-two-pieces-movement-align = Mesurer la ressemblance de deux mouvements, et les aligner
help-command-score-first-piece-gloss-token-41-recording = Le premier mouvement : une glose, token:41 ou recording:3
help-command-score-second-piece = Le second mouvement
help-command-score-draw-alignment-picture-png = Dessiner l’alignement dans une image (.png)
help-command-score-compare-expressions-face-phase-by-phase = Comparer phase par phase les expressions du visage au lieu du mouvement ; voir `milestones` et `choose`
help-command-score-function-expressions-if-there-several = La fonction des expressions, s’il y en a plusieurs
help-command-score-score-distance-under-dynamic-time-warping = Le score est la distance par déformation temporelle dynamique, sur l’emplacement, le mouvement, l’orientation et la configuration, chacun à son échelle ; 0 est le même mouvement. Les configurations de mains que personne n’a captées, dont les doigts restent au repos, ne sont pas comparées ; « findings » et « left_out » de `--json` les nomment.

## Titles of columns.

title-command-score-distance-frame = distance par image
title-command-score-mean-difference = écart moyen
title-command-score-milestones = jalons
title-command-score-path = chemin
