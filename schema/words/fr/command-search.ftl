## Messages: `{ $name }` is a variable part.

line-command-search-saved-search-deleted = recherche enregistrée @{ $name } supprimée : { $query }
message-command-search-saved-stands-for-this-query = enregistré : @{ $name } vaut pour cette requête
line-command-search-1-token = 1 occurrence : { $query }
line-command-search-0-tokens = 0 occurrence : { $query }
line-command-search-tokens = { $n } occurrences : { $query }
line-command-search-tokens-shown = { $n } occurrences, dont { $shown } affichées : { $query }
line-command-search-tokens-in-corpora-shown = { $n } occurrences dans { $corpora }, dont { $shown } affichées : { $query }
message-command-search-several-corpora-asked-query-nothing-saved = plusieurs corpus répondent à une requête, et rien n’est enregistré ni sauté
message-command-search-write-query-after-their-files-leave = écrivez une requête après leurs fichiers, sans --keep ni --offset
message-command-search-there-no-table-write = il n’y a pas de table à écrire
message-command-search-name-fields-with-count-cross = nommez ses champs avec --count ou --cross
message-command-search-write-number-all = écrivez un nombre, ou all

## Help of commands and options.

help-command-search-number-values-each-field-whose-counts = Le nombre de valeurs de chaque champ dont le compte est montré, ou all
help-command-search-count-values-field-among-all-tokens = Compter les valeurs d’un champ parmi toutes les occurrences trouvées, par exemple placement ou signer
help-command-search-count-them-for-each-value-another = Les compter aussi pour chaque valeur d’un autre champ, par exemple signer
help-command-search-count-how-often-each-pair-values = Compter combien de fois se rencontre chaque paire de valeurs de deux champs, par exemple dominant.configuration placement
help-command-search-write-table-count-cross-with-commas = Écrire le tableau de --count ou de --cross avec des virgules ou des tabulations entre les cellules
help-command-search-find-tokens-answer-query = Trouver les occurrences qui répondent à une requête
help-command-search-query-all-conditions-must-hold-name = La requête ; toutes ses conditions doivent être vraies. @NOM est une recherche enregistrée. D’autres corpus se placent avant elle
help-command-search-save-query-in-corpus-as-name = Enregistrer la requête dans le corpus sous @NOM
help-command-search-replace-search-saved-under-name = Remplacer la recherche enregistrée sous ce nom
help-command-search-delete-saved-search-name = Supprimer la recherche enregistrée NOM
help-command-search-show-at-most-n-tokens = Montrer au plus N occurrences
help-command-search-skip-first-n-tokens = Sauter les N premières occurrences
help-command-search-order-results = L’ordre des résultats : rank (les meilleurs d’abord si la requête classe, sinon par enregistrement et temps), gloss, place (enregistrement et temps), duration (les plus longs d’abord), ou un attribut comme density ; avec - devant, les plus grands d’abord
help-command-search-leave-out-counts-values = Sans les comptes des valeurs
help-command-search-query-finds-lexicon-entries-like-captured = Une requête trouve les entrées du lexique comme les occurrences captées. Mettez-la entre guillemets pour votre interpréteur de commandes, par exemple 'right.configuration=U placement=chin' ou 'gloss:BO* not weak.configuration=S'. Toute requête peut contenir @NOM pour une recherche enregistrée avec --keep NOM ; `chereme list CORPUS searches` énumère celles qui sont enregistrées.
help-command-search-several-corpora-asked-one-after-another = Plusieurs corpus sont interrogés l’un après l’autre si leurs fichiers se placent avant la requête ; les résultats nomment leur corpus, et les comptes s’ajoutent.
help-command-search-table-for-people-read = Un tableau à lire
help-command-search-commas-between-cells = Des virgules entre les cellules
help-command-search-tabs-between-cells = Des tabulations entre les cellules

## Titles of columns.

title-command-search-length = durée
