## Messages: `{ $name }` is a variable part.

line-commands-no-room-for-width-0-shows = pas de place pour : { $names } ; --width 0 montre toutes les colonnes
message-commands-would-change = changerait : { $n }
message-commands-changed = modifié : { $n }
line-commands-not-used = pas utilisés : { $names }
message-commands-nothing-stored = rien n’a été enregistré
line-commands-left-out = laissé de côté : { $what }
line-commands-drew = { $path } dessiné
line-commands-made = créé : { $path }
message-commands-tokens = occurrences : { $list }
message-commands-write-in-utf-8-name-file = écrivez-le en UTF-8, ou nommez un fichier
message-commands-standard-input-no-text = l’entrée standard n’est pas du texte
message-commands-json-both-want-standard-output = --json et --to - veulent tous deux la sortie standard
message-commands-leave-json-out-name-file = laissez --json de côté, ou nommez un fichier
message-commands-choose-another-name-write-over-with = choisissez un autre nom, ou remplacez-le avec --force

## Help of commands and options.

help-commands-corpus-database-for-signed-movement-import = Une base de corpus pour le mouvement signé : importer, chercher, recombiner, regarder et exporter des signes
help-commands-one-file-name-chereme-holds-recordings = Un seul fichier, NOM.chereme, contient les enregistrements, les annotations de leurs acteurs et les nouveaux signes qu’on en compose. Commencez par `chereme demo`, ou importez un dossier à vous.
help-commands-print-one-json-document-on-standard = Écrire un document JSON sur la sortie standard au lieu de tableaux
help-commands-your-name-in-history-without-environment = Votre nom dans l’historique ; sinon la variable d’environnement CHEREME_AUTHOR, ou le nom de l’utilisateur de la machine
help-commands-width-tables-in-letters-0-for = La largeur des tableaux en lettres, 0 pour toute leur largeur ; sinon celle du terminal, ou toute leur largeur si la sortie va dans un fichier ou un autre programme
help-commands-language-help-tables-messages-system = La langue de l’aide, des tableaux et des messages ; sinon l’anglais ou le français, selon le système. Les mots qui manquent à une langue sont en anglais, comme l’est toujours le JSON. La variable d’environnement CHEREME_WORDS nomme un dossier avec vos propres langues : `chereme words --help`
help-commands-corpus = Le corpus
help-commands-gloss-new-sign-without-nothing-stored = La glose du nouveau signe ; sans elle rien n’est enregistré
help-commands-replace-file-exists-already = Remplacer un fichier qui existe déjà
help-commands-in-table-write-apostrophe-before-cells = Dans un tableau, écrire une apostrophe devant les cellules qu’un tableur prendrait pour des formules
help-commands-signer-who-moves = Le signeur qui bouge
help-commands-replace-picture-exists-already = Remplacer une image qui existe déjà
help-commands-remarks = Remarques
help-commands-rule-for-timing-hand-fingers = La règle des temps de la main et des doigts
help-commands-duration-sounds-as-multiple-usual-one = La durée des sons en multiple de la durée habituelle, de 0.1 à 10 ; sinon 1.6
help-commands-read-input-as-phones-in-this = Lire l’entrée comme des phones dans cet alphabet
help-commands-function-expressions-negation-wh-yn-topic = La fonction des expressions : negation, wh, yn, topic, conditional, rhetorical, ou un autre mot de l’acteur ; sinon toutes
help-commands-draw-medians-quartiles-picture-svg = Dessiner médianes et quartiles dans une image (.svg)
help-commands-code-french-english-us-english-gb = Le code : french, english-us ou english-gb
help-commands-examples = Exemples :

## Titles of columns.

title-commands-channel = canal
title-commands-channels = canaux
title-commands-component = composant
title-commands-components = composants
title-commands-count = nombre
title-commands-differs-in = diffère par
title-commands-frames = images
title-commands-function = fonction
title-commands-gloss = glose
title-commands-hand = main
title-commands-keys = clés
title-commands-kind = genre
title-commands-offset-s = décalage_s
title-commands-origin = origine
title-commands-partner = partenaire
title-commands-phase = phase
title-commands-recipe = recette
title-commands-corpus = corpus
title-commands-recording = enregistrement
title-commands-seconds = secondes
title-commands-sign = signe
title-commands-signs = signes
title-commands-start = début
title-commands-tier = acteur
title-commands-tiers = acteurs
title-commands-token = occurrence
title-commands-value = valeur
