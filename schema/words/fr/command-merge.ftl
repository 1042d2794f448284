## Messages: `{ $name }` is a variable part.

message-command-merge-conflicts = quels conflits ?
message-command-merge-there-no-conflicts = il n’y a pas de conflits
message-command-merge-standard-input-has-no-name-by = l’entrée standard n’a pas de nom par lequel le corpus trouve la version d’avant du fichier
message-command-merge-write-chereme-import-corpus-format-eaf = écrivez `chereme import CORPUS - --format eaf --name NOM --merge`
message-command-merge-corpus-cannot-merged-into-annotation-file = un corpus ne se fusionne pas dans un fichier d’annotations
message-command-merge-name-corpus-first = nommez d’abord le corpus
message-command-merge-corpus-already-has-state-from-file = un corpus a déjà l’état d’où le fichier a été exporté
message-command-merge-leave-base-out = laissez --base de côté
message-command-merge-merged-file-needs-name = le fichier fusionné demande un nom
message-command-merge-write-merged-eaf-for-standard-output = écrivez --to fusion.eaf, ou --to - pour la sortie standard
message-command-merge-no-decision-given = aucune décision n’est donnée
message-command-merge-add-take-mine-theirs-both = ajoutez --take mine, theirs ou both
message-command-merge-chereme-conflicts-corpus-lists-them-all = `chereme conflicts CORPUS` en donne la liste ; `all` les désigne tous
message-command-merge-name-them-by-their-numbers-write = nommez-les par leurs numéros, ou écrivez all

## Help of commands and options.

help-command-merge-merge-copy-somebody-else-changed-into = Fusionner une copie modifiée par quelqu’un d’autre avec votre corpus ou fichier d’annotation
help-command-merge-your-corpus-your-annotation-file = Votre corpus, ou votre fichier d’annotation
help-command-merge-other-corpus-annotation-file = L’autre corpus ou fichier d’annotation
help-command-merge-corpus-file-both-copies = Le corpus ou fichier dont les deux étaient des copies
help-command-merge-merged-annotation-file-standard-output = Le fichier d’annotation réuni ; - est la sortie standard
help-command-merge-list-conflicts-merges-decide-some-them = Énumérer les conflits des fusions, ou en décider
help-command-merge-conflicts-decide-by-their-numbers-all = Les conflits à décider, par leurs numéros, ou all
help-command-merge-candidate-take = La version à retenir
help-command-merge-your-candidate-stays = Votre version reste
help-command-merge-other-candidate-takes-place = L’autre version la remplace
help-command-merge-both-stay = Les deux restent
help-command-merge-list-decided-conflicts-too = Énumérer aussi les conflits décidés
help-command-merge-change-only-one-side-made-taken = Une modification faite d’un seul côté est reprise, champ par champ. Des modifications différentes d’un même champ forment un conflit : votre valeur reste, et l’autre est gardée jusqu’à ce que vous décidiez avec `chereme conflicts`. OTHER est une copie du corpus, ou un fichier d’annotation qui en a été exporté et modifié. Si les deux sont des fichiers d’annotation, --to nomme le fichier réuni, qui a la mise en page du vôtre ; les versions de l’autre côté sont alors sur des acteurs `NOM (theirs)`. Pour les corpus, l’état commun se trouve dans leur historique ; --base le nomme pour les fichiers, et pour les corpus sans historique commun. Une fusion dans un corpus est une opération : `chereme undo` l’annule.
help-command-merge-each-conflict-has-your-candidate-in = Chaque conflit a votre version, qui est dans le corpus, et celle de l’autre côté. `--take mine` laisse la vôtre, `--take theirs` la remplace par l’autre, et `--take both` garde les deux : la seconde annotation va sur le même acteur s’il y a de la place, sinon sur un acteur `NOM (theirs)`. Une décision est une opération : `chereme undo` l’annule.
