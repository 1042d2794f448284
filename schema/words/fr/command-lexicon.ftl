## Messages: `{ $name }` is a variable part.

line-command-lexicon-linked-otherwise = liés autrement qu’avant : { $n }
line-command-lexicon-removed = lexique supprimé : { $name }
line-command-lexicon-relations-changed = relations changées : { $n }
message-command-lexicon-nothing-changed = rien n’est à modifier
message-command-lexicon-add-option = ajoutez --name, --language, --release, --terms, --citation ou --notes
message-command-lexicon-no-lexicon = le corpus n’a pas de lexique : importez une table ou une notation avec --lexicon NOM
line-command-lexicon-united = { $names } : un seul lexique avec { $name } désormais ; entrées venues : { $moved }, réunies : { $joined }
line-command-lexicon-both-codings = les deux codages ont été gardés pour : { $list }
line-command-lexicon-other-numbers = entrées qui ont un autre numéro : { $list }
message-command-lexicon-bare-glosses = occurrences annotées par la seule glose de plusieurs entrées, dont la première a été prise : { $n }

## Help of commands and options.

help-command-lexicon-list-change-link = Lister les lexiques d’un corpus, dire ce qu’ils sont et y lier des enregistrements
help-command-lexicon-sign-is-entry = Un signe est une entrée d’un lexique : BOOK d’un lexique américain et BOOK d’un lexique britannique sont deux signes. Une table importée est un lexique du nom de son fichier, sauf si l’importation en nomme un. Si plusieurs lexiques ont une glose, écrivez lequel est voulu : sign:NGT/BOOK. Les requêtes connaissent lexicon=NGT, language=dse et file=ngt.csv.
help-command-lexicon-glosses-looked-up = Les gloses des acteurs d’un enregistrement sont cherchées dans le lexique auquel l’enregistrement est lié ; celles qu’il n’a pas sont des signes d’aucun lexique. Les enregistrements d’un corpus qui a un seul lexique y sont liés ; s’il en a plusieurs, liez-les vous-même. Sans action, les lexiques sont listés. `--json` donne pour chacun "id", "name", "language", "version", "terms", "citation", "notes", "signs", "homonyms", "files", "recordings", "tokens" et "guessed_tokens".
help-command-lexicon-say-what-it-is = Dire ce qu’est un lexique : son nom, sa langue, sa version, ses conditions et comment le citer
help-command-lexicon-look-up = Chercher désormais les gloses d’enregistrements dans un lexique
help-command-lexicon-look-up-in-none = Ne chercher les gloses d’enregistrements dans aucun lexique
help-command-lexicon-remove = Supprimer un lexique qui n’a pas de signe
help-command-lexicon-by-name = Le lexique, par son nom
help-command-lexicon-language = Sa langue des signes, comme code ISO 639-3 tel que dse ; un texte vide l’enlève, ici et ci-dessous
help-command-lexicon-version = Sa version
help-command-lexicon-cite = Comment le citer
help-command-lexicon-recordings = Les enregistrements, comme recording:3
help-command-lexicon-recordings-of-query = Les enregistrements dont une requête trouve une occurrence, comme dans `chereme search`
help-command-lexicon-all-recordings = Tous les enregistrements du corpus
help-command-lexicon-signs-of-one = Prendre seulement les signes de ce lexique
help-command-lexicon-signs-of-all = Prendre les signes de tous les lexiques comme s’ils étaient d’un seul
help-command-lexicon-compare-others = Le comparer aussi aux signes d’autres lexiques
help-command-lexicon-import-into = Le lexique auquel appartiennent les signes des tables et des notations ; sans lui, une table en est un à elle seule, et une notation appartient au seul lexique du corpus
help-command-lexicon-import-language = La langue des signes de ce lexique, comme code ISO 639-3 tel que dse
help-command-lexicon-pairs-of-query = Les occurrences dont les signes sont comparés, comme dans `chereme search` ; sans cela les formes de citation
help-command-lexicon-entries-of-one-gloss = Plusieurs entrées peuvent avoir une même glose : BANK, BANK#2. Une table les distingue par une colonne qui identifie ses lignes, comme id, ou par une colonne « homonym » avec 1, 2 et ainsi de suite. La seule glose d’une annotation désigne la première ("guessed_tokens" les compte) ; écrivez BANK#2 pour la deuxième. sign:BANK#2 la nomme, gloss=BANK les trouve toutes. `annotate` et la fenêtre renomment les signes.
help-command-lexicon-unite = Réunir des lexiques : entrées, enregistrements et fichiers appartiennent à celui qui reste ; undo l’annule
help-command-lexicon-same-entries = Deux entrées sont la même si leurs lignes ont le même identifiant, sinon par glose et numéro. Les deux codages sont gardés, comme deux formes d’une entrée, et les entrées qui diffèrent sont nommées. Des lexiques qui diffèrent par la langue, la version, les conditions ou la citation sont refusés.
help-command-lexicon-that-go = Les lexiques qui disparaissent
help-command-lexicon-that-stays = Le lexique qui reste
help-command-lexicon-relate = Dire comment un signe est relié à d’autres : variantes, synonymes, parties d’un composé dans l’ordre
help-command-lexicon-relate-both-ends = Une relation se lit des deux côtés : si BOOKSHOP est compound-of BOOK SHOP, BOOK est part-of BOOKSHOP. Les requêtes connaissent related.variant=BOOK et related.part-of=*. Les tableaux apportent des relations dans des colonnes telles que « variants », « relations to other signs » (variant:BANK, seealso:SHORE) et « sequential morphology » (HOUSE + ROOF).
help-command-lexicon-unrelate = Retirer des relations d’un signe avec d’autres
help-command-lexicon-relations = Lister les relations d’un signe ou de tous les signes, ou celles que la forme des signes décide
help-command-lexicon-relation-sign = Le signe, comme glose ou sign:LEXIQUE/GLOSE
help-command-lexicon-relation-name = La relation : variant, homonym, synonym, antonym, paradigm, see-also, compound-of, part-of, derived-from, source-of, hyponym-of, hypernym-of
help-command-lexicon-relation-others = Les autres signes
help-command-lexicon-relations-of-sign = Le signe ; sans lui, celles de tous les signes
help-command-lexicon-relations-by-form = Lister les relations que la forme décide et que personne n’a dites : les homonymes sont égaux dans tous les champs, les signes d’un paradigme dans tous sauf la configuration
help-command-lexicon-relations-store = Les enregistrer
help-command-lexicon-relations-fields = Les champs qui comptent comme forme, comme dans `chereme pairs`

## Titles of columns.

title-command-lexicon-version = version
title-command-lexicon-terms = conditions
title-command-lexicon-files = fichiers
title-command-lexicon-relation = relation
title-command-lexicon-other-sign = autre signe
title-command-lexicon-source = source
