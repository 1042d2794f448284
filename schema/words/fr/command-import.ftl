## Messages: `{ $name }` is a variable part.

line-command-import-more-findings-like-these-all-them = et { $n } constats de plus comme ceux-ci, tous avec --json
message-command-import-made = créés : { $list }
message-command-import-removed = retirés : { $list }
message-command-import-would-make = créerait : { $list }
message-command-import-would-remove = retirerait : { $list }
line-command-import-more-files-imported-without-warning-json = autres fichiers importés sans avertissement : { $n } ; --json donne leurs notes
message-command-import-not-read-without-ending = pas lus : { $what } sans extension ({ $why })
line-command-import-not-read = pas lus : { $what } ({ $why })
line-command-import-recording-holds-file-and = l’enregistrement { $name } contient { $file } et
line-command-import-more-recordings-hold-several-files = autres enregistrements de plusieurs fichiers : { $n } ; --json les donne
message-command-import-nothing-new = rien de nouveau
line-command-import-joints-unit-axes-up-left = { $n } articulations, { $rate }, unité { $unit }, axes haut,gauche = { $axes }
message-command-import-track-points-frames-unit-axes-up = piste { $name } : { $n } points, { $all } images, { $rate }, unité { $unit }, axes haut,gauche = { $axes }
message-command-import-track-points-frames = piste { $name } : { $n } points, { $all } images, { $rate }
message-command-import-track-curves-frames = piste { $name } : { $n } courbes, { $all } images, { $rate }
line-command-import-lexicon = lexique { $name }
line-command-import-column = colonne { $name } : { $meaning }
message-command-import-updated-recording = { $file } : mis à jour -> enregistrement { $name }
message-command-import-updated = { $file } : mis à jour
message-command-import-unchanged-recording = { $file } : inchangé -> enregistrement { $name }
message-command-import-unchanged = { $file } : inchangé
message-command-import-refused-recording = { $file } : REFUSÉ -> enregistrement { $name }
message-command-import-refused = { $file } : REFUSÉ
message-command-import-recording = { $file } -> enregistrement { $name }
message-command-import-standard-input-has-no-extension-says = l’entrée standard n’a pas d’extension qui dise son genre
message-command-import-name-as-with-format-eaf = nommez-le, comme avec --format eaf
message-command-import-no-extension-file-no-name = { $format } n’est pas une extension de fichier, ou { $name } n’est pas un nom
message-command-import-write-format-eaf-name-take1 = écrivez --format eaf, et --name prise1
message-command-import-corpus-stores-path-film-standard-input = un corpus retient le chemin d’un film, et l’entrée standard n’en a pas
message-command-import-name-file-film = nommez le fichier du film
message-command-import-write-hours-minutes-seconds-frames-12 = écrivez heures, minutes, secondes et images : 12:34:56:07@25
message-command-import-write-whole-number-such-as-50 = écrivez un nombre entier comme 50, ou une fraction comme 30000/1001
message-command-import-unit-length-has-between-0-000001 = une unité de longueur fait entre 0,000001 et 1000 mètres
message-command-import-write-m-cm-mm-inch-ft = écrivez m, cm, mm, inch, ft, acclaim, ou combien de mètres fait une unité
message-command-import-write-lines-such-as-right-wrist = écrivez des lignes comme `right wrist = RHand`, chacune une partie du corps et une articulation

## Help of commands and options.

help-command-import-import-recordings-annotations-lexicons-inventories-into = Importer enregistrements, annotations, lexiques et inventaires dans un corpus
help-command-import-files-folders-standard-input-with-kind = Fichiers et dossiers ; - est l’entrée standard, et --format en donne le genre
help-command-import-kind-file-on-standard-input-as = Le genre de fichier de l’entrée standard, par son extension : eaf, bvh, csv, sigml ...
help-command-import-name-recording-table-on-standard-input = Le nom de l’enregistrement ou de la table de l’entrée standard
help-command-import-give-each-take-without-tokens = Donner à chaque prise sans occurrence une occurrence dont la glose est le nom de la prise, sur le signe trouvé dans son mouvement
help-command-import-report-what-would-done-write-nothing = Dire ce qui serait fait, sans rien écrire
help-command-import-keep-your-edits-take-file-s = Garder vos modifications et prendre les autres du fichier ; si les deux ont changé la même annotation, la vôtre reste
help-command-import-take-everything-from-file-even-if = Tout prendre du fichier, même si cela annule vos modifications
help-command-import-leave-recording-as-if-file-would = Laisser un enregistrement tel quel si le fichier annulait vos modifications
help-command-import-signer-s-dominant-hand = La main dominante du signeur
help-command-import-unit-length-movement-files-m-cm = L’unité de longueur des fichiers de mouvement : m, cm, mm, inch, ft, acclaim, ou des mètres par unité
help-command-import-axes-movement-files-directions-up-signer = Les axes des fichiers de mouvement : vers le haut et vers la gauche du signeur, comme +Z,+X
help-command-import-file-assigns-joints-parts-body-in = Un fichier qui attribue les articulations aux parties du corps, en lignes comme `right wrist = RHand`
help-command-import-read-root-s-columns-as-numbers = Lire les colonnes de la racine d’après leurs nombres si l’en-tête en donne mal l’ordre ou l’unité
help-command-import-json-file-with-meaning-tiers-columns = Un fichier JSON qui donne le sens des acteurs ou des colonnes
help-command-import-origin-recordings = L’origine des enregistrements
help-command-import-terms-under-recordings-may-used = Les conditions d’usage des enregistrements
help-command-import-recording-for-all-tracks-tiers-files = L’enregistrement pour toutes les pistes et tous les acteurs des fichiers, au lieu de celui qui porte leur nom
help-command-import-evidence-joins-files-into-one-recording = L’indice qui joint des fichiers en un enregistrement
help-command-import-folder-name-what-annotation-file-says = Le dossier et le nom, ce que dit un fichier d’annotations, et un vrai timecode dans un même dossier
help-command-import-also-same-name-in-another-folder = Aussi le même nom dans un autre dossier, si un seul enregistrement le porte
help-command-import-also-any-timecode-in-neighbouring-folders = Aussi tout timecode, même dans des dossiers voisins
help-command-import-folder-name-alone = Le dossier et le nom seuls
help-command-import-start-files-tracks-on-recording-s = Le début des pistes des fichiers sur l’horloge de l’enregistrement, comme 0.48s
help-command-import-time-day-at-files-tracks-start = L’heure à laquelle commencent les pistes des fichiers, s’ils ne la donnent pas : 12:34:56:07, ou 12:34:56:07@25 pour 25 images par seconde. Les pistes d’un enregistrement dont les heures sont connues sont calées sur elles
help-command-import-frame-rate-points-from-film-tables = La cadence des points d’un film et des tables de marqueurs qui ne la donnent pas, en images par seconde, comme 50 ou 30000/1001
help-command-import-files-same-name-in-one-folder = Les fichiers du même nom dans un dossier forment un enregistrement ; un film qu’un .eaf nomme s’y joint, et, dans un même dossier, un fichier d’un autre type dont le timecode se recouvre. Ce qui va peut-être ensemble, comme des fichiers du même nom dans deux dossiers, n’est pas joint mais donné avec ce qu’il faut faire (--join, --into), et le rapport dit ce qui a été joint et pourquoi. Une ligne de HamNoSys contient la glose, une tabulation et les symboles. Le rapport montre comment chaque fichier a été interprété. Des options y changent quelque chose, même plus tard : --map donne à un fichier déjà importé d’autres acteurs ou colonnes. Un corpus qui n’existe pas encore est créé. Si un fichier ne peut pas être lu, les autres sont importés.
help-command-import-annotation-file-imported-before-edited-since = Un fichier d’annotation déjà importé et modifié depuis met à jour son enregistrement, annotation par annotation. Si cela annulait des modifications faites dans le corpus, le fichier est refusé et elles sont énumérées ; --merge, --theirs ou --mine en décide alors. Un import est une opération : `chereme undo` l’annule, et Ctrl-C laisse le corpus tel qu’il était.
