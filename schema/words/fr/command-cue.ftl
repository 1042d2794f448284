## Messages: `{ $name }` is a variable part.

message-command-cue-there-nothing-cue-write-text-from = il n’y a rien à coder ; écrivez un texte, ou --from FICHIER

## Help of commands and options.

help-command-cue-generate-cued-speech-for-text-cueing = Coder un texte en langue parlée complétée, la main près du visage qui parle, sur n’importe quel corps
help-command-cue-body-cues-signer-signer-name-skeleton = Le corps qui code : celui d’un signeur (signer:NOM), ou le squelette d’un enregistrement (recording:NOM) ; sinon le programme en choisit un
help-command-cue-cue-with-left-hand = Coder de la main gauche
help-command-cue-explain-movement = Expliquer le mouvement
help-command-cue-rules-spelling-turn-french-text-into = Des règles d’orthographe donnent les phones d’un texte français. Avec --phones, l’entrée est faite de phones ; --from prend des phones, des mots ou des phrases et leurs temps dans un fichier d’annotations, comme un TextGrid, un EAF, un XRA ou un SRT. Avec --as, le mouvement est enregistré comme un nouveau signe, avec des acteurs pour les phones, les clés, la main et les doigts ; la requête `cue.shape=5 cue.placement=throat` trouve alors ses clés, et `cue=24 meets cue=31` des paires de clés.
help-command-cue-draw-movement-contact-sheet-png-animation = Dessiner le mouvement en planche (.png) ou en animation (.gif)
