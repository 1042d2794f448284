## Messages: `{ $name }` is a variable part.

line-command-completions-wrote = écrit : { $n } dans { $path }

## Help of commands and options.

help-command-completions-write-completion-script-shell-standard-output = Écrire le script de complétion d’un shell sur la sortie standard
help-command-completions-shell = Le shell
help-command-completions-write-manual-pages-for-program-man = Écrire les pages du manuel, pour le programme `man`
help-command-completions-folder-for-pages-one-for-each = Le dossier des pages, une par commande ; sinon la page de tout le programme va sur la sortie standard
