## Messages: `{ $name }` is a variable part.

message-command-cued-markers-their-positions-visible-missing = { $name } : { $n } marqueurs, { $share } % de leurs positions visibles ; il manque { $names }
message-command-cued-markers-their-positions-visible-missing-2 = { $name } : { $n } marqueurs, { $share } % de leurs positions visibles ; il en manque { $missing }
message-command-cued-markers-their-positions-visible = { $name } : { $n } marqueurs, { $share } % de leurs positions visibles
line-command-cued-frames-at-second-hidden-places-restored = { $n } images à { $rate } par seconde ; positions cachées restaurées : { $hidden }
message-command-cued-nothing-stored-store-writes-tiers = rien n’a été enregistré ; --store écrit des acteurs
message-command-cued-nothing-stored-as-gloss-stores = rien n’a été enregistré ; --as GLOSE l’enregistre
message-command-cued-recognised-after-training-on = reconnu : { $what }, appris sur { $other }
message-command-cued-recognisers-tested-on-keys-from-they = la reconnaissance a été éprouvée sur les clés dont elle a appris
message-command-cued-movements-from-pairs-keys-components-miss = mouvements de { $recordings } : { $n } ; paires de clés : { $found } sur { $all } ; les composants manquent les marqueurs de { $mm } mm
message-command-cued-script-sentences-pairs-them-in-dictionary = le script : { $n } phrases, { $pairs } paires, dont { $share } % dans le dictionnaire ; différentes qui manquent : { $missing }
line-command-cued-keys-predicted-by-produced-as-predicted = clés prévues par { $code } : { $n }, produites : { $produced } ({ $rate }), comme prévu : { $same }
line-command-cued-right-shown-in-rows-recognised-in = { $name } : { $share } % justes ; montrées en lignes, reconnues en colonnes
message-command-cued-keys-in-s-exact-stand-in = clés en { $seconds } s : { $n }, dont exactes : { $exact }, à la place d’autres : { $others }, synthétiques : { $synthetic } ; coût { $cost }
line-command-cued-read-back-shapes-placements = relu : { $shapes } % des formes, { $placements } % des emplacements
line-command-cued-stored-as = enregistré sous { $name }

## Help of commands and options.

help-command-cued-work-with-captured-cued-speech-markers = Travailler sur la LfPC captée : marqueurs, restauration, reconnaissance, cibles, phases, dictionnaire, erreurs
help-command-cued-habit-cuer-such-as-schwa-as = Une habitude du codeur, comme schwa-as-eu ; peut être répétée
help-command-cued-table-two-columns-program-s-name = Une table de deux colonnes : le nom d’un marqueur pour le programme, et son étiquette dans les fichiers
help-command-cued-report-known-markers-recording-how-often = Donner les marqueurs connus d’un enregistrement, et la part des images où ils sont visibles
help-command-cued-restore-hidden-markers-from-models-hand = Restaurer les marqueurs cachés d’après des modèles de la main et du visage, en une piste à part avec l’erreur prédite
help-command-cued-recordings-whose-markers-restored = Les enregistrements dont les marqueurs sont restaurés
help-command-cued-recordings-from-models-learn-without-those = Les enregistrements dont les modèles apprennent ; sinon ceux de la main seule et du visage seul, ou tous
help-command-cued-number-principal-components-hand-s-posture = Le nombre de composantes principales de la posture de la main, de 1 à 25
help-command-cued-recognise-shapes-placements-at-targets-keys = Reconnaître configurations et emplacements aux cibles des clés, avec les tables de confusion
help-command-cued-recordings-from-recognisers-learn-without-every = Les enregistrements dont les reconnaisseurs apprennent ; sinon un sur deux
help-command-cued-recordings-recognised-without-all-others = Les enregistrements reconnus ; sinon tous les autres
help-command-cued-find-movements-targets-gestural-scores-keys = Trouver les mouvements, les cibles et les partitions gestuelles des clés
help-command-cued-recordings = Les enregistrements
help-command-cued-write-them-as-tiers = Les écrire sur des acteurs
help-command-cued-measure-when-hand-fingers-start-arrive = Mesurer quand la main et les doigts partent et arrivent par rapport aux sons, par sorte de clé
help-command-cued-list-movements-between-keys-in-captured = Énumérer les mouvements entre clés des prises captées, et ceux qu’il faut de plus pour un script
help-command-cued-script-text-with-one-sentence-on = Le script, un texte d’une phrase par ligne : dire quelle part en est couverte par les prises, et quelles phrases ajouteraient le plus
help-command-cued-compose-sentence-from-dictionary-recognise-keys = Composer une phrase à partir du dictionnaire, et en reconnaître les clés pour contrôle
help-command-cued-text-phones-with-phones = Le texte, ou des phones avec --phones
help-command-cued-recordings-from-dictionary-cut = Les enregistrements dont le dictionnaire est tiré
help-command-cued-cost-duration-differs-by-100-ms = Le coût d’une durée qui diffère de 100 ms
help-command-cued-cost-join-whose-ends-differ-by = Le coût d’un raccord dont les bouts diffèrent de l’écart au sein d’une clé
help-command-cued-gloss-new-recording-without-nothing-stored = La glose du nouvel enregistrement ; sans elle rien n’est enregistré
help-command-cued-compare-keys-take-with-those-phones = Comparer les clés d’une prise à celles que prédisent ses phones ou un texte
help-command-cued-text-cued-without-tier-phones-predicts = Le texte codé ; sinon l’acteur des phones prédit les clés
help-command-cued-recognise-produced-keys-from-markers-even = Reconnaître les clés produites d’après les marqueurs, même si un acteur les donne
help-command-cued-take-recording-cuer-s-markers-c3d = Une prise est un enregistrement des marqueurs d’une personne qui code (C3D, TRC), avec des acteurs nommés Phones ou Keys d’un fichier TextGrid ou EAF du même nom. Les marqueurs s’appellent FA1-5 sur l’avant-bras, HB1-7 sur le dos de la main, I, M, R, L 1-8 sur les doigts, T1-6 sur le pouce ; RF1-5, RN1-2, RE1-2 sur le front, le nez et les oreilles, LP1-16 sur les lèvres, CK1-12 sur les joues, JW1-8 sur la mâchoire, TH1-18 sur la gorge. Si les fichiers ont d’autres étiquettes, --labels nomme une table de correspondance. Sans enregistrement nommé, la commande porte sur toutes les prises captées.
help-command-cued-recording = L’enregistrement
help-command-cued-report-errors-store-nothing = Donner les erreurs sans rien enregistrer

## Titles of columns.

title-command-cued-adds = ajoute
title-command-cued-arrives-ms = arrive ms
title-command-cued-begins-ms-median-quartiles = part ms : médiane (quartiles)
title-command-cued-duration = durée
title-command-cued-face-mm = visage_mm
title-command-cued-fingers = doigts
title-command-cued-first-source = première source
title-command-cued-hand-axis-mm = axe_main_mm
title-command-cued-hand-mm = main_mm
title-command-cued-hidden = cachés
title-command-cued-instead = à la place
title-command-cued-join = raccord
title-command-cued-line = ligne
title-command-cued-pair = paire
title-command-cued-part = partie
title-command-cued-predicted = prévu
title-command-cued-produced = produit
title-command-cued-read-back = relu
title-command-cued-restored = restaurés
title-command-cued-sentence = phrase
title-command-cued-share = part
title-command-cued-slip = erreur
title-command-cued-source = source
title-command-cued-uncertain = incertains
title-command-cued-wanted = voulu
