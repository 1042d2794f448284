## Help of commands and options.

help-command-transcribe-transcribe-captured-generated-sign-in-hamnosys = Transcrire un signe capturé ou composé en HamNoSys, avec l’écart de chaque trait
help-command-transcribe-movement-transcribe-gloss-token-41-recording = Quoi transcrire : une glose, token:41, ou recording:3 s’il est court
help-command-transcribe-write-names-symbols-in-place-table = Écrire les noms des symboles à la place du tableau
help-command-transcribe-store-transcription-as-token-s-notation = Enregistrer la transcription comme notation de l’occurrence ; `undo` l’annule
help-command-transcribe-replace-notation-token-has-already = Remplacer la notation que l’occurrence a déjà
help-command-transcribe-residual-distance-movement-from-transcription-runner = L’écart est la distance du mouvement à sa transcription, et le second choix est la deuxième meilleure lecture. Seule une police HamNoSys montre les caractères ; leurs noms sont écrits en dessous, `--names` n’écrit rien d’autre, et `render TOKEN --to it.svg` dessine une notation enregistrée.
help-command-transcribe-if-sign-generated-from-notation-alone = Si un signe a été généré d’une notation seule, le programme anime sa transcription pour contrôle. Si les mains bougent autrement, il essaie des mouvements semblables et d’autres postures. Les valeurs qu’il remplace ont deux écarts en cm : la distance moyenne des mains à celles qui ont été observées, avec la nouvelle valeur et avec l’ancienne. Il lit aussi les actes du tronc, de la tête et des épaules, comme body.TF ou head.SR dans les codes de SiGML. Cela prend jusqu’à une minute ; Ctrl-C l’arrête.
help-command-transcribe-json-gives-gloss-token-recording-start = `--json` donne "gloss", "token", "recording", "start_us", "end_us", l’ensemble comme "hamnosys" et "symbols" et comme arbre "sign" ; "stages", la posture initiale et chaque action avec "action", "hand", "start_us", "end_us", "hamnosys", "symbols" ; "features", chacun avec "feature", "hand", "action" (null pour la posture), "at_us", "start_us", "end_us", "value", "hamnosys", "symbols", "residual", "unit" (deg, cm ou share) et "runner_up" ("value", "hamnosys", "symbols", "residual" ; null sans deuxième lecture) ; "nonmanual", les lignes avec les actes lus ; "findings". Les temps sont en microsecondes depuis le début de l’enregistrement.
help-command-transcribe-then-export-mine-chereme-token-41 = (puis : export mine.chereme token:41 --to it.sigml)

## Titles of columns.

title-command-transcribe-action = action
title-command-transcribe-feature = trait
title-command-transcribe-residual = écart
title-command-transcribe-runner-up = second choix
