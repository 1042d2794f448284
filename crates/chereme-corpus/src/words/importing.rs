//! French forms of messages about imported and exported files, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const IMPORTING: &[(&str, &str)] = &[
    (
        "the file has more than {n} bytes",
        "le fichier a plus de {n} octets",
    ),
    ("the file has {n} bytes", "le fichier a {n} octets"),
    (
        "numbers in the column {name} may have a comma before decimals or before thousands; {text} was read as {number}, and so were {n} in all",
        "les nombres de la colonne {name} peuvent avoir une virgule avant les décimales ou avant les milliers ; {text} a été lu {number}, comme {n} en tout",
    ),
    (
        "if the comma parts thousands, save the table without it, and import it again",
        "si la virgule sépare les milliers, enregistrez la table sans elle, et importez-la de nouveau",
    ),
    (
        "rename one of the two files",
        "renommez l’un des deux fichiers",
    ),
    (
        "the file cannot be written: {why}",
        "le fichier ne s’écrit pas : {why}",
    ),
    (
        "the table cannot be written: {why}",
        "la table ne s’écrit pas : {why}",
    ),
    (
        "the BVH cannot be written: {why}",
        "le BVH ne s’écrit pas : {why}",
    ),
    (
        "the script cannot be written: {why}",
        "le script ne s’écrit pas : {why}",
    ),
    ("frame {n} is missing", "il manque l’image {n}"),
    (
        "the stored numbers are no decimals",
        "les nombres enregistrés ne sont pas des décimaux",
    ),
    (
        "something of this name is there already, and no folder is replaced",
        "quelque chose porte déjà ce nom, et aucun dossier n’est remplacé",
    ),
    (
        "not stated: ask the owner before use",
        "pas indiqué : demandez au propriétaire avant tout usage",
    ),
    (
        "say which joint is what with `chereme track`, or write .glb",
        "dites quelle articulation est quoi avec `chereme track`, ou écrivez un .glb",
    ),
    (
        "write .markers.csv, which has its exact numbers",
        "écrivez .markers.csv, qui a ses nombres exacts",
    ),
    (
        "the movement of {name} has no frames",
        "le mouvement de {name} n’a pas d’images",
    ),
    (
        "write .bvh, which holds a skeleton that does not move",
        "écrivez .bvh, qui contient un squelette immobile",
    ),
    (
        "the column {name} is kept as an attribute of each sign",
        "la colonne {name} est gardée comme attribut de chaque signe",
    ),
    (
        "write 00:00:01,000 --> 00:00:02,500",
        "écrivez 00:00:01,000 --> 00:00:02,500",
    ),
    (
        "the recording {name} has no tokens",
        "l’enregistrement {name} n’a pas d’occurrences",
    ),
    (
        "the recording {name} has no tiers",
        "l’enregistrement {name} n’a pas d’acteurs",
    ),
    (
        "the recording {name} has no movement",
        "l’enregistrement {name} n’a pas de mouvement",
    ),
    (
        "name recordings that have some, or another format",
        "nommez des enregistrements qui en ont, ou un autre format",
    ),
    (
        "add one with {command}, or export .eaf, which needs none",
        "ajoutez-en un avec {command}, ou exportez en .eaf, qui s’en passe",
    ),
    (
        "the subtitles hold the tier {name}; not written: {others}, each of which can be exported by its number",
        "les sous-titres contiennent l’acteur {name} ; non écrits : {others} ; chacun peut être exporté par son numéro",
    ),
    (
        "the tier {name} has no annotations",
        "l’acteur {name} n’a pas d’annotations",
    ),
    ("{command} counts them", "{command} les compte"),
    (
        "without what {format} holds, and left out: {n} of {all}: {names}",
        "sans ce que contient un {format}, et laissés de côté : {n} sur {all} : {names}",
    ),
    (
        "none of the {n} can be written as {format}; the first: {why}",
        "aucun des {n} ne peut être écrit en {format} ; le premier : {why}",
    ),
    (
        "the file of {name} cannot be written: {why}",
        "le fichier de {name} ne peut pas être écrit : {why}",
    ),
    (
        "the recording {name} has no track of markers",
        "l’enregistrement {name} n’a pas de piste de marqueurs",
    ),
    (
        "the recording {name} has no track of curves",
        "l’enregistrement {name} n’a pas de piste de courbes",
    ),
    (
        "the recording {name} has no track of {kind}",
        "l’enregistrement {name} n’a pas de piste de ce genre : {kind}",
    ),
    (
        "`chereme track CORPUS RECORDING` lists its tracks",
        "`chereme track CORPUS ENREGISTREMENT` donne la liste de ses pistes",
    ),
    (
        "the file holds the track {name}; not written: {others}",
        "le fichier contient la piste {name} ; non écrites : {others}",
    ),
    (
        "the recording {name} has neither glosses nor translations",
        "l’enregistrement {name} n’a ni gloses ni traductions",
    ),
    (
        "annotate one of the two, or export .eaf or .TextGrid",
        "annotez l’un des deux, ou exportez en .eaf ou .TextGrid",
    ),
    (
        "{entries} of the lexicon are in no recording",
        "du lexique, dans aucun enregistrement : {entries}",
    ),
    (
        "write .csv, which pandas, polars and DuckDB read, too",
        "écrivez un .csv, que pandas, polars et DuckDB lisent aussi",
    ),
    (
        "export a tier as .csv, or a folder of everything",
        "exportez un acteur en .csv, ou le dossier complet",
    ),
    (
        "export .bvh, or a folder of everything",
        "exportez un .bvh, ou le dossier complet",
    ),
    (
        "this program was built without Parquet",
        "ce programme a été compilé sans Parquet",
    ),
    (
        "build it with `cargo build --release --features parquet`; or {what}",
        "compilez-le avec `cargo build --release --features parquet` ; ou {what}",
    ),
    (
        "the value has {n} bytes, and a value has at most {most}",
        "la valeur a {n} octets, et une valeur en a au plus {most}",
    ),
    (
        "shorten it in the file that it comes from",
        "raccourcissez-la dans le fichier d’où elle vient",
    ),
    (
        "only a table of tokens or annotations is written for spreadsheets",
        "seul un tableau d’occurrences ou d’annotations s’écrit pour les tableurs",
    ),
    (
        "end the name in .csv or .tsv, or leave --spreadsheet-safe out",
        "terminez le nom par .csv ou .tsv, ou omettez --spreadsheet-safe",
    ),
    (
        "only everything can be written as a folder of all formats",
        "seul l’ensemble s’écrit comme un dossier de tous les formats",
    ),
    (
        "the name ends in .{ending}, and the format is {format}",
        "le nom finit en .{ending}, et le format est {format}",
    ),
    (
        "leave --format out, or end the name in .{format}",
        "omettez --format, ou donnez au nom la fin .{format}",
    ),
    ("{format} is not written", "{format} ne s’écrit pas"),
    (
        "write .glb or .bvh, which Blender and others read",
        "écrivez un .glb ou un .bvh, que Blender et d’autres lisent",
    ),
    ("{format} is a picture", "{format} est une image"),
    (
        "draw it with `chereme render CORPUS WHAT --to FILE`",
        "dessinez-le avec `chereme render CORPUS QUOI --to FICHIER`",
    ),
    (
        "json is not written as a file",
        "json ne s’écrit pas comme fichier",
    ),
    (
        "add --json to `chereme list` or `chereme search`; export all to a folder for the inventories",
        "ajoutez --json à `chereme list` ou `chereme search` ; exportez tout dans un dossier pour les inventaires",
    ),
    (
        "annotations become markers of Blender's timeline by `exec(bpy.context.scene[\"chereme_markers\"])` in its Python console after the import",
        "les annotations deviennent des marqueurs de la chronologie de Blender par `exec(bpy.context.scene[\"chereme_markers\"])` dans sa console Python après l’importation",
    ),
    (
        "only an inventory is written as JSON",
        "seul un inventaire s’écrit en JSON",
    ),
    (
        "name one, such as inventory:configurations; tokens go into .csv or .tsv, everything into a folder",
        "nommez-en un, comme inventory:configurations ; les occurrences vont dans un .csv ou un .tsv, l’ensemble dans un dossier",
    ),
    (
        "the inventory {name} is written as JSON",
        "l’inventaire {name} s’écrit en JSON",
    ),
    (
        "the recording has no tokens: the table holds its curves",
        "l’enregistrement n’a pas d’occurrences : la table contient ses courbes",
    ),
    (
        "expressions that VRM does not define move only avatars that have them by name: {names}",
        "les expressions que VRM ne définit pas n’animent que les avatars qui les ont sous ce nom : {names}",
    ),
    (
        "the body lacks bones that VRM requires, so some programs refuse the file: {names}",
        "il manque au corps des os que VRM exige, certains programmes refusent donc le fichier : {names}",
    ),
    (
        "the file holds markers alone, without the curves {names}; .curves.csv holds those",
        "le fichier ne contient que des marqueurs, sans les courbes {names} ; .curves.csv les contient",
    ),
    (
        "a BVH file does not say that its movement begins {start} s after its recording; state that offset when you import it, or the annotations are beside it",
        "un fichier BVH ne dit pas que son mouvement commence {start} s après son enregistrement ; indiquez ce décalage à l’importation, sinon les annotations sont à côté",
    ),
    (
        "the file holds all of the recording {name}",
        "le fichier contient tout l’enregistrement {name}",
    ),
    (
        "such a file holds one recording, and these are {n}",
        "un tel fichier contient un enregistrement, et il y en a {n}",
    ),
    (
        "name one, such as recording:3 or token:41, or write a file for each with --to FOLDER --format bvh",
        "nommez-en un, comme recording:3 ou token:41, ou écrivez un fichier pour chacun avec --to DOSSIER --format bvh",
    ),
    (
        "none of these tokens has a notation",
        "aucune de ces occurrences n’a de notation",
    ),
    (
        "`chereme list CORPUS tokens --where notation=*` lists those that have one",
        "`chereme list CORPUS tokens --where notation=*` donne la liste de celles qui en ont une",
    ),
    (
        "{what} without notation: left out",
        "sans notation, laissé de côté : {what}",
    ),
    ("there is nothing to write", "il n’y a rien à écrire"),
    (
        "name recordings or tokens, or a query that finds some",
        "nommez des enregistrements ou des occurrences, ou une requête qui en trouve",
    ),
    (
        "annotations_to_markers.py turns the annotations into markers of Blender's timeline",
        "annotations_to_markers.py fait des annotations des marqueurs de la chronologie de Blender",
    ),
    (
        "an inventory is one file",
        "un inventaire est un seul fichier",
    ),
    (
        "{address} is without movement",
        "{address} est sans mouvement",
    ),
    (
        "name recordings, or tokens that were recorded",
        "nommez des enregistrements, ou des occurrences enregistrées",
    ),
    (
        "correct the line `Frame Time:` of the file",
        "corrigez la ligne `Frame Time:` du fichier",
    ),
    (
        "other movement was imported from this file before, as the recording {name}; movement is not replaced, and this is a recording of its own",
        "un autre mouvement a été importé de ce fichier auparavant, comme l’enregistrement {name} ; un mouvement ne se remplace pas, et celui-ci est un enregistrement à part",
    ),
    (
        "undo the earlier import, if it is not needed any more",
        "annulez l’ancienne importation, si elle ne sert plus",
    ),
    (
        "its movement is the same as that of the recording {name}, from {path}",
        "son mouvement est le même que celui de l’enregistrement {name}, de {path}",
    ),
    (
        "correct the roles file (--roles), or leave it out",
        "corrigez le fichier de rôles (--roles), ou laissez-le de côté",
    ),
    (
        "the directions up and left are uncertain; {axes} is assumed ({reason})",
        "les directions haut et gauche sont incertaines ; {axes} est supposé ({reason})",
    ),
    (
        "look at it with `chereme render`; say the axes with --axes, or name the joints in a roles file",
        "regardez-le avec `chereme render` ; donnez les axes avec --axes, ou nommez les articulations dans un fichier de rôles",
    ),
    (
        "a joint is placed beyond what a number can hold; correct the number",
        "une articulation est placée au-delà de ce qu’un nombre peut dire ; corrigez le nombre",
    ),
    (
        "joints identified by their position in the skeleton, not by name: {names}",
        "articulations reconnues à leur position dans le squelette, pas à leur nom : {names}",
    ),
    (
        "{n} optical markers are beside the skeleton and do not count as joints: {names}",
        "marqueurs optiques à côté du squelette, qui ne comptent pas comme articulations : {n} ({names})",
    ),
    (
        "say which one in a roles file (--roles)",
        "dites laquelle dans un fichier de rôles (--roles)",
    ),
    (
        "the recording {name} of this name had no movement: it has this one now",
        "l’enregistrement {name} de ce nom n’avait pas de mouvement : il a maintenant celui-ci",
    ),
    (
        "the root seems to be in another unit than the bones: its positions times {scale} would put the feet on the ground",
        "la racine semble être dans une autre unité que les os : ses positions multipliées par {scale} mettraient les pieds au sol",
    ),
    (
        "in the unit that the file states the body is {height} m tall; its lengths are multiplied by {step}",
        "dans l’unité que dit le fichier, le corps mesure {height} m ; ses longueurs sont multipliées par {step}",
    ),
    (
        "in the axes that the file states ({stated}) the body lies or hangs upside down; it is righted: {axes} is assumed",
        "selon les axes que dit le fichier ({stated}), le corps est couché ou suspendu la tête en bas ; il est redressé : {axes} est supposé",
    ),
    (
        "say the axes with --axes, such as --axes +Y,+X, if it does so in truth",
        "donnez les axes avec --axes, comme --axes +Y,+X, si c’est bien le cas",
    ),
    (
        "say the unit with --unit, such as --unit cm, if the body is as tall as the file says",
        "donnez l’unité avec --unit, comme --unit cm, si le corps est aussi grand que le dit le fichier",
    ),
    (
        "the recording has a tier \"events\" already, so the events of this file were left out",
        "l’enregistrement a déjà un acteur \"events\" : les événements de ce fichier ont été laissés de côté",
    ),
    (
        "rename that tier and import the file again",
        "renommez cet acteur et importez de nouveau le fichier",
    ),
    (
        "its timecodes begin {time} after those of the track {name} and share no moment with them: both start together",
        "ses timecodes commencent {time} après ceux de la piste {name} et n’ont aucun moment en commun : les deux commencent ensemble",
    ),
    (
        "if they are of one take, say where it starts: track CORPUS RECORDING NAME --offset TIME",
        "s’ils sont d’une même prise, dites où elle commence : track CORPUS ENREGISTREMENT NOM --offset TEMPS",
    ),
    (
        "it is the recording {name} already (from {path}); its tiers now have the roles of the mapping",
        "c’est déjà l’enregistrement {name} (de {path}) ; ses acteurs ont maintenant les rôles de la correspondance",
    ),
    (
        "the file and your edits contradict each other: {rule}",
        "le fichier et vos modifications se contredisent : {rule}",
    ),
    (
        "import it with --theirs (the file as it is) or --mine (your edits)",
        "importez-le avec --theirs (le fichier tel quel) ou --mine (vos modifications)",
    ),
    (
        "it would take back {many} of yours: the recording stays as it is",
        "il retirerait de vos modifications ({many}) : l’enregistrement reste tel quel",
    ),
    (
        "it was changed since it was imported, and would take back {many} of yours",
        "il a changé depuis son importation, et retirerait de vos modifications : {many}",
    ),
    (
        "import it again with --merge (your edits and the file's changes; yours where both changed the same annotation), --theirs (the file), or --mine (your edits)",
        "importez-le de nouveau avec --merge (vos modifications et celles du fichier ; les vôtres là où les deux touchent la même annotation), --theirs (le fichier), ou --mine (vos modifications)",
    ),
    (
        "its property {property} is not understood: {why}",
        "sa propriété {property} ne se comprend pas : {why}",
    ),
    (
        "the roles of tiers are inferred from their names",
        "les rôles des acteurs sont déduits de leurs noms",
    ),
    (
        "it is no part of the recording {name} of this name in another folder, which ends before its annotations",
        "il ne fait pas partie de l’enregistrement {name} de ce nom dans un autre dossier, qui finit avant ses annotations",
    ),
    (
        "if it is: `chereme undo`, then import it with --into recording:N",
        "s’il en fait partie : `chereme undo`, puis importez-le avec --into recording:N",
    ),
    (
        "it is an export of {name}, which says more",
        "il est un export de {name}, qui en dit plus",
    ),
    (
        "if it holds changes of its own: `chereme annotate CORPUS --in RECORDING from FILE`",
        "s’il a ses propres modifications : `chereme annotate CORPUS --in RECORDING from FILE`",
    ),
    (
        "its annotations end at {end}, but the movement of the recording {name} at {length}",
        "ses annotations finissent à {end}, mais le mouvement de l’enregistrement {name} à {length}",
    ),
    (
        "see whether both are of the same take; `chereme undo`, and another name for the file, keeps them apart",
        "voyez si les deux sont de la même prise ; `chereme undo`, puis un autre nom pour le fichier, les sépare",
    ),
    (
        "the recording {name} has a tier {tier} already, and this file would bring another",
        "l’enregistrement {name} a déjà un acteur {tier}, et ce fichier en apporterait un autre",
    ),
    (
        "undo the earlier import first, or rename the file or the tier",
        "annulez d’abord l’ancienne importation, ou renommez le fichier ou l’acteur",
    ),
    (
        "it is taken for a new version of {path}: {n} of {all} annotations are the same",
        "il est pris pour une nouvelle version de {path} : {n} annotations sur {all} sont les mêmes",
    ),
    (
        "it is taken for another file than {path}, with which it shares {n} of {all} annotations",
        "il est pris pour un autre fichier que {path}, avec lequel il partage {n} annotations sur {all}",
    ),
    (
        "if it is a new version of that file: `chereme undo`, then import it with --merge, --theirs or --mine",
        "si c’est une nouvelle version de ce fichier : `chereme undo`, puis importez-le avec --merge, --theirs ou --mine",
    ),
    (
        "its annotations were there before: {changed} changed, {added} added, {removed} removed, {same} as they were",
        "ses annotations étaient déjà là : {changed} modifiées, {added} ajoutées, {removed} retirées, {same} telles quelles",
    ),
    (
        "the tier {name} is called {other} in the file: it has the new name here, too",
        "l’acteur {name} s’appelle {other} dans le fichier : il porte ce nouveau nom ici aussi",
    ),
    (
        "annotations that the file does not have moved with the annotations above them: {count}",
        "annotations que le fichier n’a pas, déplacées avec celles au-dessus d’elles : {count}",
    ),
    (
        "with this file, an annotation that it does not have would break a rule: {rule}",
        "avec ce fichier, une annotation qu’il n’a pas enfreindrait une règle : {rule}",
    ),
    (
        "add that annotation to the file, or remove it from the corpus, then import the file again",
        "ajoutez cette annotation au fichier, ou retirez-la du corpus, puis importez le fichier à nouveau",
    ),
    (
        "the tier {name}, which the file has not, is kept",
        "l’acteur {name}, que le fichier n’a pas, est gardé",
    ),
    (
        "`chereme undo` takes the import back",
        "`chereme undo` annule l’importation",
    ),
    (
        "`chereme conflicts CORPUS` lists both candidates; decide there",
        "`chereme conflicts CORPUS` montre les deux possibilités ; tranchez là",
    ),
    (
        "the vocabulary {name} has {entry} twice; the second stays text",
        "le vocabulaire {name} a {entry} deux fois ; le second reste du texte",
    ),
    (
        "import the .eaf that uses them, or give their components in a mapping file (--map)",
        "importez le .eaf qui s’en sert, ou donnez leurs composants dans un fichier de correspondances (--map)",
    ),
    (
        "the names of the vocabularies {names} name no component: they are kept for the annotation files that use them",
        "les noms des vocabulaires {names} ne nomment aucun composant : ils sont gardés pour les fichiers d’annotations qui s’en servent",
    ),
    (
        "tiers of these names are there already in {names}",
        "des acteurs de ces noms existent déjà dans {names}",
    ),
    (
        "annotate CORPUS add-tiers --like copies those that are missing from another recording",
        "annotate CORPUS add-tiers --like copie d’un autre enregistrement ceux qui manquent",
    ),
    (
        "an inventory is an object with id, component, version, names and values; schema/inventory.schema.json describes it; a lexicon is an array of objects with gloss and hamnosys",
        "un inventaire est un objet avec id, component, version, names et values ; schema/inventory.schema.json le décrit ; un lexique est un tableau d’objets avec gloss et hamnosys",
    ),
    ("the file is not UTF-8", "le fichier n’est pas en UTF-8"),
    (
        "it holds no inventory and no signs",
        "il ne contient ni inventaire ni signes",
    ),
    (
        "with the values that the corpus has of it already: {reason}",
        "avec les valeurs que le corpus en a déjà : {reason}",
    ),
    (
        "keep the ids of values, or give the inventory an id of its own",
        "gardez les ids des valeurs, ou donnez à l’inventaire un id à lui",
    ),
    (
        "it was imported before: its columns were read again, as the mapping says",
        "il a été importé auparavant : ses colonnes ont été relues, comme le dit la correspondance",
    ),
    (
        "its columns were read as in the import before, by the mapping given then: {columns}",
        "ses colonnes ont été lues comme à l’importation d’avant, selon la correspondance donnée alors : {columns}",
    ),
    (
        "signs of an earlier version of this table that have no row here, and were kept: {names}, and {n} more",
        "signes d’une version antérieure de ce tableau qui n’ont pas de ligne ici, et ont été gardés : {names}, et {n} de plus",
    ),
    (
        "signs of an earlier version of this table that have no row here, and were kept: {names}",
        "signes d’une version antérieure de ce tableau qui n’ont pas de ligne ici, et ont été gardés : {names}",
    ),
    (
        "{command} deletes a sign that is not wanted any more; or put its row back into the table, and import that again",
        "{command} supprime un signe qui n’est plus voulu ; ou remettez sa ligne dans le tableau, et réimportez celui-ci",
    ),
    (
        "the inventory {id} has other names for values, under which they are stored: {names}, and {n} more",
        "l’inventaire {id} a d’autres noms pour des valeurs, sous lesquels elles sont enregistrées : {names}, et {n} de plus",
    ),
    (
        "the inventory {id} has other names for values, under which they are stored: {names}",
        "l’inventaire {id} a d’autres noms pour des valeurs, sous lesquels elles sont enregistrées : {names}",
    ),
    (
        "a lexicon is a table with a header row and a column of glosses",
        "un lexique est une table avec une ligne d’en-tête et une colonne de gloses",
    ),
    (
        "a file that is read whole has at most 512 MiB; a BVH file that is named may be larger",
        "un fichier lu en entier a au plus 512 Mio ; un fichier BVH donné par son nom peut être plus grand",
    ),
    (
        "the mapping names what no tier or column of these files is called: {names}",
        "la correspondance nomme ce qu’aucun acteur ni aucune colonne de ces fichiers ne s’appelle : {names}",
    ),
    (
        "look at the names that the report lists, and correct the mapping",
        "regardez les noms que donne le rapport, et corrigez la correspondance",
    ),
    (
        "it lies {n} folders deep",
        "il est à {n} dossiers de profondeur",
    ),
    (
        "import it by its own name",
        "importez-le par son propre nom",
    ),
    (
        "signs of an earlier file of this name that are missing here, and were kept: {names}",
        "signes d’un ancien fichier de ce nom qui manquent ici, et ont été gardés : {names}",
    ),
    (
        "undo the earlier import, if the new file is to take its place",
        "annulez l’ancienne importation, si le nouveau fichier doit la remplacer",
    ),
    (
        "another file of this name, {path}, was imported before; the signs of this one stand next to those, also where they have the same gloss",
        "un autre fichier de ce nom, {path}, a été importé auparavant ; les signes de celui-ci sont à côté des autres, même s’ils ont la même glose",
    ),
    (
        "give each sign a gloss in the file, and import it again",
        "donnez une glose à chaque signe dans le fichier, et importez-le de nouveau",
    ),
    (
        "the sign has no gloss: it is called {name}, as the file",
        "le signe n’a pas de glose : il s’appelle {name}, comme le fichier",
    ),
    (
        "{n} signs have no gloss: they are called {first} to {last}, by the file and the line",
        "{n} signes n’ont pas de glose : ils s’appellent {first} à {last}, d’après le fichier et la ligne",
    ),
    (
        "{gloss}: its HamNoSys was saved as UTF-8 and read as Latin-1, and parts of it are lost; the sign was left uncoded",
        "{gloss} : son HamNoSys a été enregistré en UTF-8 et lu en Latin-1, et des parties en sont perdues ; le signe n’a pas été codé",
    ),
    (
        "export the source again as UTF-8, and import that",
        "exportez de nouveau la source en UTF-8, et importez-la",
    ),
    (
        "{gloss}: {text} holds no HamNoSys; the sign was left uncoded by it",
        "{gloss} : {text} ne contient pas de HamNoSys ; le signe n’en est pas codé",
    ),
    (
        "the notation of {gloss} cannot be stored: {why}",
        "la notation de {gloss} ne s’enregistre pas : {why}",
    ),
    (
        "the recording {name} has this file's name already: this one is called {other}",
        "l’enregistrement {name} a déjà le nom de ce fichier : celui-ci s’appelle {other}",
    ),
    (
        "the film has more than {n} files of frames",
        "le film a plus de {n} fichiers d’images",
    ),
    (
        "files of OpenPose are called NAME_000000000000_keypoints.json, one for each frame",
        "les fichiers d’OpenPose s’appellent NOM_000000000000_keypoints.json, un par image",
    ),
    (
        "inventories, signs, scores of a face or points from film",
        "inventaires, signes, valeurs d’un visage ou points d’un film",
    ),
    ("points from film", "points d’un film"),
    (
        "import the .eaf that names it; its recording is linked to it then",
        "importez le .eaf qui le nomme ; son enregistrement lui est alors lié",
    ),
    ("text without HamNoSys", "du texte sans HamNoSys"),
    (
        "a .txt holds HamNoSys, a sign a line: the gloss, a tab, and symbols or their names",
        "un .txt contient du HamNoSys, un signe par ligne : la glose, une tabulation, et des symboles ou leurs noms",
    ),
    (
        "movement in a form that this build of the program does not read",
        "un mouvement sous une forme que ce programme, tel que compilé, ne lit pas",
    ),
    (
        "open it in Blender and export .glb or .bvh",
        "ouvrez-le dans Blender et exportez un .glb ou un .bvh",
    ),
    (
        "merge it into yours: `chereme merge CORPUS OTHER`; or export its files, and import those",
        "fusionnez-le dans le vôtre : `chereme merge CORPUS AUTRE` ; ou exportez ses fichiers, et importez-les",
    ),
    (
        "your {mine} gives way to the file's {theirs}",
        "votre {mine} cède la place à celui du fichier : {theirs}",
    ),
    (
        "your {mine} goes: the file does not have it",
        "votre {mine} part : le fichier ne l’a pas",
    ),
    (
        "the file's {theirs} comes back, which you removed",
        "{theirs} du fichier revient, que vous aviez retiré",
    ),
    (
        "your {mine} stays; the file still says {theirs}",
        "votre {mine} reste ; le fichier dit encore {theirs}",
    ),
    (
        "both were changed: your {mine} stays, the file says {theirs}",
        "les deux ont changé : votre {mine} reste, le fichier dit {theirs}",
    ),
    (
        "your {mine} stays, though the file has removed it",
        "votre {mine} reste, bien que le fichier l’ait retiré",
    ),
    (
        "the file's {theirs} is left out: you removed it, or it overlaps what you changed",
        "{theirs} du fichier est laissé de côté : vous l’aviez retiré, ou il chevauche ce que vous avez modifié",
    ),
    (
        "the same bytes were imported before, from {path}",
        "les mêmes octets ont été importés auparavant, de {path}",
    ),
    (
        "the same file was imported before",
        "le même fichier a été importé auparavant",
    ),
    (
        "if they are of two takes: `chereme undo`, and import each file by its name",
        "s’ils sont de deux prises : `chereme undo`, puis importez chaque fichier par son nom",
    ),
    (
        "it is the only file of its kind next to one of movement: it is taken for the take {name}",
        "c’est le seul fichier de son genre à côté d’un fichier de mouvement : il est pris pour la prise {name}",
    ),
    (
        "the markers beside the skeleton are too many to be kept as a track of points; they stay its joints",
        "les marqueurs à côté du squelette sont trop nombreux pour une piste de points ; ils restent des articulations",
    ),
    (
        "cut the take into shorter files",
        "coupez la prise en fichiers plus courts",
    ),
    ("it is no object", "ce n’est pas un objet"),
    (
        "track {id} is no media file of {name}",
        "la piste {id} n’est pas un média de {name}",
    ),
    (
        "look at the recording's media again",
        "revoyez les médias de l’enregistrement",
    ),
    ("a media file needs a place", "il faut dire où est le média"),
    ("give its path", "donnez son chemin"),
    ("there is no such file", "il n’y a pas de tel fichier"),
    (
        "the file is longer than a megabyte",
        "le fichier dépasse un mégaoctet",
    ),
    (
        "the offsets of {n} are not where the movement puts {them}: the movement is used, and the stored numbers stay those of the file",
        "les offsets de {n} ne sont pas là où le mouvement met {them} : le mouvement est utilisé, et les nombres enregistrés restent ceux du fichier",
    ),
    (
        "a file of the recording {name}",
        "un fichier de l’enregistrement {name}",
    ),
    (
        "H.264 of a profile with more than 8 bits, or 4:2:2",
        "du H.264 d’un profil de plus de 8 bits, ou 4:2:2",
    ),
    (
        "{what} with \">\" or \"+\" in it would be read back as several",
        "{what} avec \">\" ou \"+\" se relirait comme plusieurs",
    ),
];
