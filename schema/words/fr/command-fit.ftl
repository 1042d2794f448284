## Messages: `{ $name }` is a variable part.

line-command-fit-stored-as-track = enregistré comme la piste { $name }
line-command-fit-frames-skeleton-scaled-by-median-distance = { $n } images ; squelette à l’échelle { $scale } ; distance médiane des marqueurs { $mm } mm

## Help of commands and options.

help-command-fit-fit-skeleton-markers-recording-report-distance = Ajuster un squelette aux marqueurs d’un enregistrement, et donner la distance de chaque marqueur
help-command-fit-recording-with-markers-such-as-recording = L’enregistrement des marqueurs, comme recording:3
help-command-fit-recording-whose-skeleton-fitted-without-program = L’enregistrement dont le squelette est ajusté ; sinon le corps du programme
help-command-fit-track-markers-if-there-several = La piste de marqueurs, s’il y en a plusieurs
help-command-fit-person-whose-markers-used-if-they = La personne dont les marqueurs servent, s’ils sont ceux de plusieurs personnes : Anna pour Anna:LSHO
help-command-fit-report-distances-store-nothing = Donner les distances sans rien enregistrer
help-command-fit-movement-becomes-track-recording-distances-markers = Le mouvement devient une piste de l’enregistrement, et les distances des marqueurs dans chaque image une piste de courbes ; les marqueurs restent tels quels. Le programme connaît les étiquettes de trois jeux de marqueurs : Plug-in Gait, les 41 marqueurs de CMU, et Helen Hayes.

## Titles of columns.

title-command-fit-joint = articulation
title-command-fit-marker = marqueur
title-command-fit-median-mm = médiane_mm
title-command-fit-most-mm = maximum_mm
title-command-fit-seen = vu
