## Messages: `{ $name }` is a variable part.

line-command-detect-coded-in = codé : { $annotations } dans { $recordings }
line-command-detect-proposed-in = proposé : { $annotations } dans { $recordings }
line-command-detect-nothing-found-in = rien trouvé dans { $recording } : { $why }
line-command-detect-nothing-examine-in = rien à examiner dans { $recordings }

## Help of commands and options.

help-command-detect-cut-takes-into-signs = Découper des prises en signes, ou lancer un autre détecteur sur des enregistrements
help-command-detect-detector = Le détecteur
help-command-detect-only-in-this-recording-token = Seulement dans cet enregistrement ou cette occurrence, ou dans les enregistrements des occurrences que trouve une requête : `in` et son adresse ou sa requête
help-command-detect-write-found-on-tiers-proposals = Écrire le résultat sur des acteurs de propositions
help-command-detect-write-found-as-codings-your-own = Écrire le résultat comme vos propres codages
help-command-detect-find-more-signs = Trouver plus de signes ; deux fois pour plus encore
help-command-detect-find-fewer-signs = Trouver moins de signes ; deux fois pour moins encore
help-command-detect-cost-sign-usual = Le coût d’un signe : 4 d’ordinaire ; 0 donne un quart de signes en trop
help-command-detect-detector-signs-finds-signs-between = Le détecteur « signs » trouve les signes entre les repos, et la préparation, le noyau, la tenue et la rétraction de chaque main. Plusieurs signes sans repos entre eux sont séparés par un modèle appris sur des signes engendrés ; --more et --fewer, ou --cost, changent la facilité avec laquelle il les sépare. Les autres détecteurs figurent ci-dessous.
help-command-detect-without-propose-store-result-shown = Sans --propose ni --store le résultat est affiché, et rien n’est écrit. Avec --propose il est écrit sur des acteurs comme « gloss (proposed) », à la place des propositions d’avant que personne n’a modifiées ; `propose --accept` les accepte. Avec --store il devient vos propres codages, sauf là où se trouve autre chose. La glose d’un signe trouvé est UNGLOSSED. Un appel est une opération, que `undo` annule. Les images étranges aux bouts d’une prise sont laissées de côté.
help-command-detect-json-gives-detector-annotations = `--json` donne "detector", "annotations", le nombre de celles qui ont été écrites, "recordings", les noms de ceux qui ont de nouvelles annotations, "unobserved", le nombre d’enregistrements sans la partie que le détecteur examine, "found", les propositions de chaque enregistrement avec acteur, temps, valeur, confiance et indices, et "without", les enregistrements où rien n’a été trouvé, avec la raison.
