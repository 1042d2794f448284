## Messages: `{ $name }` is a variable part.

message-command-recombine-there-already-stays-replace-instead-as = note : { $gloss } existait déjà et reste ; --replace { $other } au lieu de --as met un signe à sa place
line-command-recombine-stored-as-token-recording-s = { $gloss } enregistré : token:{ $token }, enregistrement { $name }, { $seconds } s : { $recipe }
line-command-recombine-s-not-stored-give-gloss-with = { $seconds } s, pas enregistré (donnez-lui une glose avec --as) : { $recipe }

## Help of commands and options.

help-command-recombine-compose-new-sign-from-stored-ones = Composer un nouveau signe à partir d’autres, et l’enregistrer
help-command-recombine-recipe-as-text-json-standard-input = La recette, en texte ou en JSON ; - est l’entrée standard
help-command-recombine-replace-sign-generated-before-keeps-gloss = Remplacer un signe généré auparavant ; il garde sa glose, son occurrence et les annotations que des personnes ont mises sur ses acteurs
help-command-recombine-explain-sign-steps-source-each-channel = Expliquer le signe : les étapes, la source de chaque canal, les raccords et les écarts
help-command-recombine-draw-sign-contact-sheet-png-animation = Dessiner le signe en planche (.png), en animation (.gif) ou en film (.mp4)
help-command-recombine-recipe-sign-changes-escargot-configure-right = Une recette est un signe et ce qu’on en fait : ESCARGOT | configure right U. Le nouveau signe a ses propres acteurs et se trouve par la recherche comme un signe capté ; sa recette est enregistrée avec lui. Mettez la recette entre guillemets pour votre interpréteur de commandes.
help-command-recombine-sources-what-recipe-begins-with = Sources : par quoi une recette commence
help-command-recombine-sign-corpus-with-movement-as-notation = un signe du corpus, avec mouvement ou en notation
help-command-recombine-whole-recording-by-name-if-no = un enregistrement entier, par son nom si aucun signe ne le porte
help-command-recombine-word-in-manual-alphabet = un mot dans un alphabet manuel
help-command-recombine-reaching-for-point-left-up-from = vers un point : à gauche, au-dessus du sol, en avant
help-command-recombine-notation = de la notation
help-command-recombine-operators-changes-one-after-another-each = Opérateurs : les changements, l’un après l’autre, chacun après |
help-command-recombine-one-after-other-with-transitions = L’un après l’autre, avec des transitions
