## Messages: `{ $name }` is a variable part.

message-command-keys-there-nothing-read-write-text-from = il n’y a rien à lire ; écrivez un texte, ou --from FICHIER

## Help of commands and options.

help-command-keys-take-phones-times-from-this-textgrid = Prendre les phones, les mots ou les phrases et leurs temps dans ce fichier : TextGrid, EAF, XRA, SRT, VTT ou un autre avec des annotations
help-command-keys-tier-phones-in-file-without-first = L’acteur de ce fichier ; sinon le premier dont le nom est celui que les aligneurs donnent aux phones, sinon aux mots, sinon le seul
help-command-keys-print-keys-cued-speech-for-text = Écrire les clés de la langue parlée complétée d’un texte ou de phones
help-command-keys-text-phones-separated-by-blanks-120 = Le texte, ou les phones séparés par des blancs (a=120 est un phone de 120 ms) ; - est l’entrée standard
help-command-keys-read-input-as-text-default = Lire l’entrée comme un texte (par défaut)
help-command-keys-take-pronunciation-from-program-espeak-ng = Prendre la prononciation du programme espeak-ng, qui doit être installé
help-command-keys-habit-some-cuers-such-as-schwa = Une habitude de certains codeurs, comme schwa-as-eu ; peut être répétée
help-command-keys-say-words-as-this-file-does = Prononcer les mots comme ce fichier : un mot et ses phones par ligne, un dictionnaire de MFA ou de SPPAS, ou la table de Lexique
help-command-keys-keep-silent-final-consonants-silent-before = Laisser muettes les consonnes finales muettes devant une voyelle
help-command-keys-pronunciation-e-at-end-word = La prononciation d’un e final
help-command-keys-give-keys-times-duration-phones-as = Donner des temps aux clés : la durée des phones en multiple de la durée habituelle, de 0.1 à 10 ; qui code en a besoin d’environ 1.6
help-command-keys-key-handshape-at-placement-shape-stands = Une clé est une configuration à un emplacement : la configuration vaut pour une consonne, l’emplacement pour une voyelle. Des règles d’orthographe donnent les phones d’un texte français ; `fils{ "{" }f i l{ "}" }` prononce un mot comme ses accolades le disent, et `--dictionary` apporte vos propres prononciations. Dans l’entrée, les phones sont séparés par des espaces, ou écrits ensemble, comme dans bɔ̃ʒuʁ ; `#` est une pause.
help-command-keys-json-gives-code-words-text-phones = `--json` donne "code", "words" ("text", "phones"), "keys" ("shape", "placement", "or_placement" si la voyelle est incertaine, "phones" en SAMPA, "start_us", "vowel_us", "end_us" : null sans --pace) et "findings".

## Titles of columns.

title-command-keys-phones = phones
title-command-keys-placement = emplacement
title-command-keys-shape = configuration
