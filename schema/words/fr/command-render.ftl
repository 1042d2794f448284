## Messages: `{ $name }` is a variable part.

line-command-render-drew-frames-or-symbols = { $what } dessiné dans { $path } : { $drawn }, { $size } Ko
line-command-render-has-no-movement-own-notation-animated = { $name } n’a pas de mouvement à lui : sa notation a été animée sur { $body }
line-command-render-has-no-notation-transcribed-from-movement = { $name } n’a pas de notation : il a été transcrit de son mouvement, sans être enregistré
message-command-render-speed-number-from = une vitesse est un nombre de { $least } à { $most }

## Help of commands and options.

help-command-render-draw-movement-as-contact-sheet-png = Dessiner un mouvement en planche (.png), en animation (.gif) ou en film (.mp4), des configurations (.png), ou une notation (.svg)
help-command-render-number-pictures-per-second-in-film = Le nombre d’images par seconde d’un film, de 1 à 120
help-command-render-write-glosses-below-animation-film-while = Écrire les gloses sous une animation ou un film pendant qu’elles sont signées
help-command-render-what-draw = Quoi dessiner
help-command-render-picture-write-extension-determines-kind-standard = L’image à écrire ; son extension en détermine le genre ; - est la sortie standard
help-command-render-kind-picture-for-standard-output-png = Le genre d’image pour la sortie standard : png, gif, mp4 ou svg
help-command-render-number-pictures-side-by-side-in = Le nombre d’images côte à côte dans une planche, de 1 à 64
help-command-render-leave-out-close-ups-hands-face = Sans les gros plans des mains et du visage
help-command-render-hand-on-handshapes-drawn = La main sur laquelle une configuration est dessinée
help-command-render-height-one-picture-in-pixels-from = La hauteur d’une image, en pixels, de 32 à 2000 ; sinon 260, pour les films 540, pour les configurations 128, pour les visages 160
help-command-render-speed-animation-from-0-05-20 = La vitesse de l’animation, de 0.05 à 20 ; 1 est la vitesse d’origine
help-command-render-show-close-up-face-next-signer = Montrer un gros plan du visage à côté du signeur, dans chaque image
help-command-render-what-gloss-recording-s-name-token = WHAT est une glose, le nom d’un enregistrement, token:41, recording:3, recording:"NGT Thanks", ou inventory:configurations ou inventory:configurations/U pour les configurations. Si un signe n’a qu’une notation, le programme l’anime d’abord. Le programme dessine les symboles de HamNoSys sans police ; inventory:hamnosys les montre tous. inventory:faces montre le visage de chaque non-manuel de SiGML. Plusieurs WHAT sont dessinés côte à côte dans un film ou une animation : ils commencent ensemble, et les plus courts s’arrêtent sur leur dernière image. Les films sont en H.264, que tout lecteur, navigateur et logiciel de bureau sait montrer.
help-command-render-for-whom-it-is-drawn = Pour qui c’est dessiné : ce que des personnes n’ont pas accepté de leur montrer est laissé de côté et énuméré
