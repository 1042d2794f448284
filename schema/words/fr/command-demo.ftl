## Messages: `{ $name }` is a variable part.

message-command-demo-files-starter-corpus-refused = des fichiers du corpus de départ ont été refusés : { $files }
message-command-demo-starter-corpus-has-no-answer = le corpus de départ n’a pas de réponse à { $query }
message-command-demo-stored-sign-has-token = un signe enregistré a une occurrence
message-command-demo-new-sign-limace-not-found-by = { $query } ne trouve pas le nouveau signe LIMACE
line-command-demo-more-starter-recipes-txt = et { $n } de plus de starter/recipes.txt : { $names }
line-command-demo-1-starter-corpus-in = 1. Le corpus de départ : { $n } dans { $path }
line-command-demo-built = construit { $what } : { $n }
message-command-demo-2-search = 2. Chercher { $what }, { $query } : { $n }
message-command-demo-3-make-stored-as-token = 3. Composer { $gloss } = { $recipe } : enregistré, token:{ $token } ({ $why })
line-command-demo-found-again-by-search = retrouvé par la recherche, { $query } : { $n }
line-command-demo-4-pictures-in = 4. Images dans { $path } : { $names }
message-command-demo-5-written-out-limace-bvh-tokens = 5. Exporté : LIMACE.bvh, tokens.csv, et tout dans le dossier enriched
line-command-demo-6-dictionary-for-any-browser = 6. Un dictionnaire de { $signs } pour tout navigateur : { $path }
line-command-demo-look-at-first-then-try = Regardez d’abord { $path }. Puis essayez :
message-command-demo-corpus-built-first = le corpus est d’abord construit
message-command-demo-by-handshape = par configuration
message-command-demo-by-placement = par emplacement
message-command-demo-slug-snail-with-another-handshape = la limace est l’escargot avec une autre configuration
message-command-demo-bowl-stands-on-left = le bol est à gauche
message-command-demo-dark-light-played-backwards = foncé est clair joué à l’envers
message-command-demo-there-already-name-empty-folder-new = { $path } existe déjà ; nommez un dossier vide ou nouveau
message-command-demo-no-folder-name-free-here = aucun nom de dossier n’est libre ici

## Help of commands and options.

help-command-demo-show-program-s-main-work-on = Faire l’essentiel sur le corpus de départ : construire, chercher, recombiner, enregistrer, dessiner, exporter, publier
help-command-demo-folder-for-results-demo-without-new = Le dossier des résultats de la démonstration ; sinon un nouveau dans le dossier courant
help-command-demo-starter-corpus-generated-by-program-not = Le corpus de départ a été généré par un programme, pas capté ; il est contenu dans celui-ci.
