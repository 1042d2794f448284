## Messages: `{ $name }` is a variable part.

message-command-track-starts-at-s-now-s-correlation = { $track } commence à { $time } s (maintenant { $now } s) : corrélation { $r } avec { $other }, ailleurs au plus { $most }, confiance { $sure }
message-command-track-this-uncertain-look-at-both-tracks = c’est incertain : regardez les deux pistes avant de vous en servir, ou nommez d’autres canaux
message-command-track-write-time-in-seconds-such-as = écrivez un temps en secondes comme 0.48s, ou 480ms

## Help of commands and options.

help-command-track-list-tracks-recording-move-align-rename = Énumérer les pistes d’un enregistrement, ou en décaler, caler, renommer ou supprimer une
help-command-track-recording-such-as-recording-3-recording = L’enregistrement, comme recording:3 ou recording:"NGT Thanks"
help-command-track-track-s-name = Le nom de la piste
help-command-track-new-path-film-another-media-file = Le nouveau chemin d’un film ou d’un autre média qui a été déplacé
help-command-track-new-start-track-on-recording-s = Le nouveau début de la piste sur l’horloge de l’enregistrement, comme 0.48s ou -12ms
help-command-track-new-name-track = Le nouveau nom de la piste
help-command-track-remove-track-with-all-data = Supprimer la piste avec toutes ses données
help-command-track-joints-points-curves-track-whose-speeds = Les articulations, points ou courbes de la piste dont on compare les vitesses
help-command-track-joints-points-curves-other-track = Les articulations, points ou courbes de l’autre piste
help-command-track-largest-shift-from-present-offset = Le plus grand écart au décalage actuel
help-command-track-move-track-offset-found = Déplacer la piste au décalage trouvé
help-command-track-align-track-with-this-one-find = Caler la piste sur celle-ci : trouver le décalage où les vitesses se ressemblent le plus, celles des poignets si aucun canal n’est nommé
help-command-track-recording-has-any-number-tracks-on = Un enregistrement a autant de pistes que voulu sur une seule horloge : mouvements de squelettes, marqueurs, courbes, médias. Sans option, les pistes sont énumérées. `chereme import CORPUS FILE --into recording:3 --offset 0.48s` apporte les pistes d’un fichier à un enregistrement existant.

## Titles of columns.

title-command-track-duration-s = durée_s
title-command-track-rate = cadence
