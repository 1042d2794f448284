## Messages: `{ $name }` is a variable part.

message-command-forget-no-signer = { $who } n’est pas un signeur
message-command-forget-write-signer-name = écrivez signer:NOM ; les enregistrements et les signes se suppriment avec `chereme delete`
message-command-forget-nothing-written-yet = rien n’est encore écrit ; avec --yes { $signer } disparaît définitivement, avec { $n } et l’historique :
message-command-forget-forgotten-for-good = oublié définitivement : { $signer }, { $n } et l’historique :
message-command-forget-proof = preuve : { $n } empreintes, identités, noms et textes ont été cherchés dans les octets du fichier, et aucun n’a été trouvé en dehors des lignes d’autres personnes
message-command-forget-rows-of-others-say = des lignes d’autres personnes le disent aussi : { $text } (table { $name })
message-command-forget-files-not-touched = les films à côté du corpus, les copies, les exportations et les publications restent : supprimez-les vous-même

## Help of commands and options.

help-command-forget-forget-signer-for-good = Oublier un signeur définitivement : la seule opération qui ne peut pas être annulée
help-command-forget-all-recordings-of-signer-go = Tous les enregistrements du signeur disparaissent, avec leurs pistes, acteurs, annotations, occurrences, recettes et nombres, et le signeur lui-même. L’historique entier du corpus, son index de recherche et les versions plus anciennes du fichier à côté de lui aussi. Ensuite le fichier est réécrit, et ses octets sont fouillés à la recherche de chaque empreinte, identité, nom et texte retiré ; le rapport dit combien ont été cherchés. Les textes que disent aussi les lignes de quelqu’un d’autre, comme une glose, restent et sont énumérés.
help-command-forget-nothing-forgotten-while-needed = Rien n’est oublié tant qu’autre chose en a besoin : des signes d’autres personnes faits à partir de ces enregistrements, des enregistrements d’autres personnes avec le même mouvement, des enregistrements qui montrent aussi d’autres personnes, des études et des décisions ouvertes après une fusion. Les films à côté du corpus, les copies ailleurs, les exportations et les publications sont des fichiers que ce programme ne connaît pas : supprimez-les vous-même, et publiez de nouveau.
help-command-forget-json-gives = `--json` donne "signer", "dry_run", "recordings", "older_files", "searched" et "still_said", chacun avec "text" et "table".
help-command-forget-signer-such-as = Le signeur, comme signer:S07
help-command-forget-do-it = Le faire ; sans cela, la commande dit seulement ce qui disparaîtrait
line-command-forget-more-texts-stand-in-rows = { $n } autres textes se trouvent aussi dans des lignes d’autres : --json les donne
