## Messages: `{ $name }` is a variable part.

line-command-face-fitted-on-frames = { $system } de { $whose }, ajusté sur { $n } images de { $recording }
line-command-face-unknown = inconnus : { $names }
line-command-face-frames-in-track = { $recording } : { $n } images de { $system } dans la piste { $name }
line-command-face-weights-fitted-on = les poids ont été ajustés sur { $on }
line-command-face-frames-with-bridged-gaps = images à trous comblés : { $n }
line-command-face-annotations-written = annotations écrites : { $n }
line-command-face-stored-from-now-on-these-weights = enregistré : désormais ces poids valent pour tous les visages de { $whose }
message-command-face-no-face-system = { $name } n’est pas un système de visage
message-command-face-systems = les systèmes sont : { $names }

## Help of commands and options.

help-command-face-show-captured-face-in-program-s = Montrer un visage capté dans les nombres du programme, ou énumérer les systèmes de visage pris en charge
help-command-face-recording-token-in = L’enregistrement, ou une occurrence qu’il contient
help-command-face-show-one-face-system-arkit-mediapipe = Montrer un système de visage : arkit, mediapipe, openface, fap, mesh, sigml ou house (celui du programme)
help-command-face-propose-annotations-brows-lids-gaze-mouth = Proposer des annotations de sourcils, paupières, regard, bouche et tête, chacune avec sa confiance et la règle qui l’a trouvée
help-command-face-fit-weights-mapping-signer-from-take = Ajuster les poids de la correspondance au signeur, d’après une prise où chaque partie du visage va à ses extrêmes
help-command-face-store-result-proposals-as-tiers-such = Enregistrer le résultat : les propositions sur des acteurs tels que « nonmanual.brows (proposed) », les poids ajustés pour chaque visage du signeur ; `undo` le retire
help-command-face-captured-channels-stay-as-their-file = Les canaux captés restent tels que dans leur fichier. Le programme en déduit ses propres nombres d’un visage, ou les estime d’après les points d’un visage filmé (.pose). Sans enregistrement, la commande énumère les systèmes de visage (ARKit, MediaPipe, OpenFace, MPEG-4, SiGML), et avec --system la correspondance d’un système et ses pertes.
help-command-face-systems = (les systèmes)
help-command-face-channels-formulas-losses = (ses canaux, formules et pertes)
help-command-face-face-recording = (le visage d’un enregistrement)
help-command-face-brows-blinks-gaze-mouth-shakes-nods = (sourcils, clignements, regard, bouche et mouvements de la tête comme acteurs)
help-command-face-weights-for-this-signer-from-range = (les poids de ce signeur, d’après toute l’ampleur)

## Titles of columns.

title-command-face-confidence = confiance
title-command-face-end = fin
title-command-face-formula = formule
title-command-face-least = minimum
title-command-face-mean = moyenne
title-command-face-most = maximum
title-command-face-number = nombre
title-command-face-numbers-face = nombres d’un visage
title-command-face-rule = règle
title-command-face-system = système
title-command-face-times-above = fois au-dessus
title-command-face-times-below = fois au-dessous
title-command-face-weights = poids
