## Messages: `{ $name }` is a variable part.

line-command-export-wrote-mb = écrit : { $n }, { $size } Mo, dans { $path }
message-command-export-wrote-kb = écrit : { $path }, { $size } Ko
message-command-export-standard-output-has-no-extension-says = la sortie standard n’a pas d’extension qui dise le format
message-command-export-name-as-with-format-csv = nommez-le, comme avec --format csv

## Help of commands and options.

help-command-export-export-movement-annotations-tables-whole-enriched = Exporter du mouvement, des annotations, des tables, ou toute la base enrichie
help-command-export-file-folder-write-standard-output = Le fichier ou dossier à écrire ; - est la sortie standard
help-command-export-format-such-as-bvh-csv-needed = Le format, comme bvh ou csv ; nécessaire avec --to -, et pour écrire plusieurs fichiers dans un dossier
help-command-export-what-export-all-gloss-token-41 = Quoi exporter : all (tout), une glose, token:41, recording:3, tier:12, inventory:configurations (en .json), ou query:'right.configuration=U' ; plusieurs vont ensemble
help-command-export-extension-determines-format-bvh-movement-recording = L’extension de --to détermine le format : .bvh (mouvement d’un enregistrement ou d’une occurrence), .glb (le même en glTF, pour Blender et le web, avec les annotations), .vrma (mouvement pour avatars), .c3d, .trc ou .markers.csv (marqueurs), .eaf ou .TextGrid (les acteurs d’un enregistrement, pour ELAN ou Praat), .elan.txt (les mêmes, comme texte à tabulations d’ELAN), .srt ou .vtt (ses traductions ou gloses en sous-titres, une langue par fichier ; tier:12 en nomme une), .csv ou .tsv (occurrences avec tous les composants), .curves.csv (l’intensité de chaque non-manuel, image par image), .sigml (signes notés, en SiGML gestuel), .hsigml (les mêmes en symboles de HamNoSys), .hns ou .txt (les mêmes en texte HamNoSys, un signe par ligne), et, si le programme a été compilé avec `--features parquet`, .parquet (occurrences pour pandas, polars et DuckDB), .components.parquet, .annotations.parquet et .frames.parquet (une ligne par valeur, par annotation, ou par articulation et par image). Un nom sans extension est un dossier : avec --format, il reçoit un fichier de ce format pour chaque enregistrement ou occurrence qui a de quoi. Sans --format, `all` y écrit la base, un dictionnaire des données avec des exemples de requêtes, un fichier par table, les enregistrements, les inventaires, les sommes de contrôle et la provenance. Avec --to -, le fichier va sur la sortie standard. Un fichier EAF que personne n’a modifié revient octet pour octet, et une modification ne change que ses propres lignes. Le même corpus donne toujours les mêmes octets.
