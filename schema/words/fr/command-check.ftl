## Messages: `{ $name }` is a variable part.

line-command-check-mended = réparé : { $what }
line-command-check-not-damage-but-against-rules-tiers = pas des dégâts, mais contraires aux règles des acteurs : { $count }
message-command-check-all-well-looked-at = tout va bien ; vérifié : { $list }
message-command-check-there-faults-looked-at = il y a des défauts ; vérifié : { $list }
message-command-check-check-cannot-go-on-take-backup = la vérification ne peut pas continuer : prenez une sauvegarde, ou sauvez ce qui se lit avec `chereme export CORPUS all --to DOSSIER`

## Help of commands and options.

help-command-check-look-for-damage-database-rows-files = Chercher les dégâts : base, lignes, fichiers et blocs par leurs empreintes, occurrences, historique, index de recherche
help-command-check-rebuild-derived-data-tokens-wrong-search = Reconstruire les données dérivées : les occurrences fausses et l’index de recherche
help-command-check-take-rows-as-they-now-for = Tenir les lignes pour justes telles qu’elles sont, après une modification par un autre programme
help-command-check-reports-all-damage-with-remedy-exit = Donne tous les dégâts avec leurs remèdes ; le code de sortie est 1 s’il y en a. Les annotations contraires aux règles des acteurs sont listées comme questions sur les données : elles sont venues ainsi d’un fichier.
