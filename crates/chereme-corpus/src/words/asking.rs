//! French forms of messages about lists, searches, merges, recipes and inventories, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const ASKING: &[(&str, &str)] = &[
    (
        "a recording is in a corpus",
        "un enregistrement est dans un corpus",
    ),
    (
        "name the corpus first: `chereme diff CORPUS recording:1 recording:2`",
        "nommez d’abord le corpus : `chereme diff CORPUS recording:1 recording:2`",
    ),
    (
        "subtitles are not merged: their lines have no tiers",
        "des sous-titres ne se fusionnent pas : leurs lignes n’ont pas d’acteurs",
    ),
    (
        "a merged file cannot be written in the format of this one",
        "un fichier fusionné ne s’écrit pas dans le format de celui-ci",
    ),
    (
        "import it into a corpus, then the other with {command}",
        "importez-le dans un corpus, puis l’autre avec {command}",
    ),
    (
        "merge the .eaf or .TextGrid, and export subtitles from it",
        "fusionnez les .eaf ou .TextGrid, et exportez-en des sous-titres",
    ),
    (
        "name annotation files: {endings}",
        "nommez des fichiers d’annotations : {endings}",
    ),
    (
        "the {row} was changed by something else since, so this cannot be taken back",
        "{row} : modifié depuis par autre chose, on ne peut donc pas revenir en arrière",
    ),
    (
        "`chereme log CORPUS` lists all operations; `chereme check CORPUS` looks for damage",
        "`chereme log CORPUS` dit ce qui a été fait ; `chereme check CORPUS` cherche des dommages",
    ),
    (
        "choose a file that `chereme new` or `chereme import` made",
        "choisissez un fichier créé par `chereme new` ou `chereme import`",
    ),
    (
        "check the spelling of the path; `chereme new` makes an empty corpus",
        "vérifiez l’orthographe du chemin ; `chereme new` crée un corpus vide",
    ),
    ("there is nothing of this name", "rien ne porte ce nom"),
    (
        "something of this name is there already",
        "quelque chose porte déjà ce nom",
    ),
    (
        "it is a folder or a device",
        "c’est un dossier ou un périphérique",
    ),
    ("it is empty", "il est vide"),
    (
        "it is cut short: {n} bytes are there of {size}",
        "il est tronqué : {n} octets sur {size}",
    ),
    (
        "copy it again, or take it from a backup",
        "copiez-le de nouveau, ou reprenez-le d’une sauvegarde",
    ),
    ("it is no database", "ce n’est pas une base de données"),
    (
        "it is a database of another program",
        "c’est une base d’un autre programme",
    ),
    (
        "its tiers may have roles that this program does not know: {roles}",
        "ses acteurs peuvent avoir des rôles que ce programme ne connaît pas : {roles}",
    ),
    (
        "its schema is version {n}, and this program knows up to {most}",
        "son schéma est la version {n}, et ce programme connaît jusqu’à {most}",
    ),
    (
        "open it with a newer version of Chereme",
        "ouvrez-le avec une version plus récente de Chereme",
    ),
    (
        "its version number is wrong: it is {n}, and the file holds data",
        "son numéro de version est faux : c’est {n}, et le fichier contient des données",
    ),
    (
        "take the file from a backup; keep this one too, as its data are still in it",
        "reprenez le fichier d’une sauvegarde ; gardez aussi celui-ci, car ses données y sont encore",
    ),
    ("its making was cut short", "sa création a été interrompue"),
    (
        "delete it and create it again",
        "effacez-le et créez-le de nouveau",
    ),
    (
        "it holds {n} views, triggers or virtual tables that Chereme did not create",
        "il contient {n} vues, déclencheurs ou tables virtuelles que Chereme n’a pas créés",
    ),
    (
        "take the file as untrusted: somebody has put code into it",
        "ne vous fiez pas à ce fichier : quelqu’un y a mis du code",
    ),
    (
        "the file or its folder may not be read or written by you",
        "vous n’avez pas le droit de lire ou d’écrire ce fichier ou ce dossier",
    ),
    (
        "`chereme check CORPUS` lists all damage and says how to mend it; a backup may be whole",
        "`chereme check CORPUS` donne la liste des dommages et dit comment les réparer ; une sauvegarde peut être intacte",
    ),
    (
        "`chereme check CORPUS --mend` builds the search index again",
        "`chereme check CORPUS --mend` reconstruit l’index de recherche",
    ),
    ("there is no tier:{id}", "il n’y a pas de tier:{id}"),
    ("there is no sign:{id}", "il n’y a pas de sign:{id}"),
    (
        "{gloss} has no translation {text} in {language}",
        "{gloss} n’a pas de traduction {text} en {language}",
    ),
    ("a value needs a name", "une valeur doit avoir un nom"),
    ("a {what} needs a name", "il faut un nom ({what})"),
    (
        "another search is saved as {name}",
        "une autre recherche est enregistrée sous {name}",
    ),
    (
        "saved searches use each other: {names}",
        "des recherches enregistrées s’appellent l’une l’autre : {names}",
    ),
    (
        "the query uses more than {n} saved searches",
        "la requête appelle plus de {n} recherches enregistrées",
    ),
    ("use fewer of them", "appelez-en moins"),
    (
        "the saved search {other} uses @{name}",
        "la recherche enregistrée {other} appelle @{name}",
    ),
    (
        "change or delete that one first",
        "modifiez ou supprimez d’abord celle-là",
    ),
    (
        "give it another name, or replace that one: {command}",
        "donnez-lui un autre nom, ou remplacez celle-là : {command}",
    ),
    (
        "keep searches that do not name each other in a circle",
        "enregistrez des recherches qui ne se nomment pas en cercle",
    ),
    (
        "a saved search needs a name of one line",
        "une recherche enregistrée demande un nom d’une ligne",
    ),
    ("give it a name", "donnez-lui un nom"),
    (
        "there is no saved search yet: `chereme search CORPUS --keep NAME QUERY` saves one",
        "il n’y a encore aucune recherche enregistrée : `chereme search CORPUS --keep NOM REQUÊTE` en enregistre une",
    ),
    (
        "`chereme list CORPUS searches` lists all {n}",
        "`chereme list CORPUS searches` donne la liste des {n}",
    ),
    (
        "`chereme list CORPUS searches` lists those that are",
        "`chereme list CORPUS searches` donne la liste de celles qui le sont",
    ),
    (
        "no search is saved as {name}",
        "aucune recherche n’est enregistrée sous {name}",
    ),
    (
        "{things} have no column {name}",
        "pas de colonne {name} pour {things}",
    ),
    ("the columns are: {names}", "les colonnes sont : {names}"),
    (
        "{what} cannot be listed",
        "{what} : on ne peut pas en donner la liste",
    ),
    (
        "what can be listed: {names}",
        "ce dont on peut donner la liste : {names}",
    ),
    (
        "the column {name} cannot be {pattern}",
        "la colonne {name} ne peut pas être {pattern}",
    ),
    (
        "write a number, >5, >=5, <5, <=5, 2..5, or none",
        "écrivez un nombre, >5, >=5, <5, <=5, 2..5, ou none",
    ),
    ("write yes or no", "écrivez yes ou no"),
    (
        "tokens are filtered by their components with a query",
        "les occurrences se filtrent par leurs composants avec une requête",
    ),
    (
        "{n} of {all} tokens are coded for {components}; a map needs two",
        "occurrences codées pour {components} : {n} sur {all} ; une carte en demande deux",
    ),
    (
        "import annotations or a lexicon with these components, or choose others; `chereme list CORPUS tokens` shows the codings",
        "importez des annotations ou un lexique avec ces composants, ou choisissez-en d’autres ; `chereme list CORPUS tokens` montre les codages",
    ),
    (
        "{n} tokens are too many for a map of at most {most}",
        "{n} occurrences sont trop pour une carte d’au plus {most}",
    ),
    ("narrow the query", "restreignez la requête"),
    (
        "there is no open conflict {n}",
        "il n’y a pas de conflit {n} à trancher",
    ),
    (
        "the {what} that it belongs to was removed here",
        "ce dont il fait partie ({what}) a été retiré ici",
    ),
    (
        "add by hand what the other side has, or decide for mine",
        "ajoutez à la main ce que l’autre côté a, ou décidez pour le mien",
    ),
    (
        "after this decision the tiers would break a rule: {rule}",
        "après cette décision, les acteurs enfreindraient une règle : {rule}",
    ),
    (
        "decide the conflicts of that place together, change what is in the way first, or decide for mine",
        "décidez ensemble les conflits de cet endroit, changez d’abord ce qui gêne, ou décidez pour le mien",
    ),
    (
        "the {what} holds more than the other side removed",
        "{what} : il y a dedans plus que l’autre côté n’a retiré",
    ),
    (
        "remove by hand what is in it, or decide for mine",
        "retirez à la main ce qui s’y trouve, ou décidez pour le mien",
    ),
    (
        "there can be one {what} only",
        "il ne peut y en avoir qu’un ({what})",
    ),
    (
        "decide for mine or theirs",
        "décidez pour le mien ou le leur",
    ),
    (
        "the two corpora have no common beginning: neither is a copy of the other",
        "les deux corpus n’ont pas de début commun : aucun n’est une copie de l’autre",
    ),
    (
        "name the copy that both come from with --base; else export its recordings as .eaf and import these with --merge",
        "nommez avec --base la copie dont les deux viennent ; sinon exportez ses enregistrements en .eaf et importez-les avec --merge",
    ),
    (
        "both have a recording {name}: that of {path} is {other} here",
        "les deux ont un enregistrement {name} : celui de {path} est {other} ici",
    ),
    (
        "both have a study {name} with another plan: that of {path} is {other} here",
        "les deux ont une étude {name}, avec un autre plan : celle de {path} est {other} ici",
    ),
    (
        "both have a participant {code}, two people: that of {path} is {other} here",
        "les deux ont un participant {code}, deux personnes : celui de {path} est {other} ici",
    ),
    ("it is another file", "c’est un autre fichier"),
    ("nothing is written over", "rien n’est remplacé"),
    (
        "proposals lie on tiers whose names end in \"(proposed)\"",
        "les propositions sont sur des acteurs dont le nom finit par \"(proposed)\"",
    ),
    (
        "annotation:{id} on {tier} is no proposal",
        "annotation:{id} sur {tier} n’est pas une proposition",
    ),
    (
        "a new sign needs a gloss",
        "un nouveau signe demande une glose",
    ),
    (
        "a recipe is a sign and the changes to it, such as: ESCARGOT | configure right U",
        "une recette est un signe et ce qui y change, par exemple : ESCARGOT | configure right U",
    ),
    (
        "`chereme list CORPUS signs` and `… values` list what there is",
        "`chereme list CORPUS signs` et `… values` donnent la liste de ce qu’il y a",
    ),
    (
        "the recipe generates no movement",
        "la recette ne produit pas de mouvement",
    ),
    (
        "{name} was not generated by a recipe",
        "{name} n’a pas été composé par une recette",
    ),
    (
        "store the result as a new sign, with a gloss of its own",
        "enregistrez le résultat comme un nouveau signe, avec une glose à lui",
    ),
    (
        "derived from the former {name}, and left unchanged: {others}",
        "dérivés de l’ancien {name}, et laissés tels quels : {others}",
    ),
    (
        "annotations beyond the new end were shortened or taken away: {n}",
        "annotations raccourcies ou retirées au-delà de la nouvelle fin : {n}",
    ),
    ("{name} has no gloss any more", "{name} n’a plus de glose"),
    (
        "write its gloss on the tier Gloss first, or store a new sign",
        "écrivez d’abord sa glose sur l’acteur Gloss, ou enregistrez un nouveau signe",
    ),
    (
        "the recipe takes movement from {name} itself, which it would replace",
        "la recette prend du mouvement de {name}, qu’elle remplacerait",
    ),
    (
        "begin with the source of that sign, or store a new sign",
        "commencez par la source de ce signe, ou enregistrez un nouveau signe",
    ),
    (
        "the two cannot be compared: {why}",
        "les deux ne se comparent pas : {why}",
    ),
    (
        "the signs of this corpus have no attributes; columns of a lexicon table that are no components become some",
        "les signes de ce corpus n’ont pas d’attributs ; les colonnes d’une table de lexique qui ne sont pas des composants en deviennent",
    ),
    (
        "the attributes are: {names} and {n} more",
        "les attributs sont : {names} et {n} de plus",
    ),
    (
        "the attributes are: {names}",
        "les attributs sont : {names}",
    ),
    (
        "`like` orders the whole answer, or removes less similar tokens from all of it",
        "`like` classe toute la réponse, ou en retire les occurrences moins semblables",
    ),
    (
        "write it beside the other terms, not after `not` or `or`",
        "écrivez-le à côté des autres termes, pas après `not` ou `or`",
    ),
    (
        "phases of movement are not values of a token: they divide the time of signing",
        "les phases du mouvement ne sont pas des valeurs d’une occurrence : elles divisent le temps signé",
    ),
    (
        "write a relation to them: overlaps movement.phase=stroke",
        "écrivez une relation à elles : overlaps movement.phase=stroke",
    ),
    (
        "the corpus has no {kind}",
        "il n’y a rien de ce genre dans le corpus : {kind}",
    ),
    (
        "there are: {names} and {n} more",
        "il y a : {names} et {n} de plus",
    ),
    ("there are: {names}", "il y a : {names}"),
    (
        "no {kind} is called {name}",
        "rien de ce genre ({kind}) ne s’appelle {name}",
    ),
    (
        "write token=41; a sign is found by gloss=CHAT",
        "écrivez token=41 ; un signe se trouve par gloss=CHAT",
    ),
    (
        "nothing is known of the parts of {component}",
        "on ne sait rien des parties de {component}",
    ),
    ("its parts are: {names}", "ses parties sont : {names}"),
    (
        "{component} has no part {part}",
        "{component} n’a pas de partie {part}",
    ),
    (
        "no value of {field} has a feature {feature}",
        "aucune valeur de {field} n’a le trait {feature}",
    ),
    (
        "a face has no curve {name}",
        "un visage n’a pas de courbe {name}",
    ),
    ("the curves are: {names}", "les courbes sont : {names}"),
    (
        "token:{id} has no value of {field}",
        "token:{id} n’a pas de valeur de {field}",
    ),
    (
        "write like token:41, or like and a gloss of the corpus",
        "écrivez like token:41, ou like et une glose du corpus",
    ),
    (
        "another program keeps writing to the corpus",
        "un autre programme n’arrête pas d’écrire dans le corpus",
    ),
    ("try again when it is done", "réessayez quand il aura fini"),
    (
        "the search index did not follow the rows and was built again",
        "l’index de recherche ne suivait pas les lignes ; il a été reconstruit",
    ),
    (
        "write for example placement=head > chest",
        "écrivez par exemple placement=head > chest",
    ),
    (
        "successive values have no phase before them",
        "des valeurs successives n’ont pas de phase devant elles",
    ),
    (
        "this component changes too often for so many values",
        "ce composant change trop souvent pour tant de valeurs",
    ),
    (
        "values of one field or of two are counted",
        "on compte les valeurs d’un champ ou de deux",
    ),
    (
        "name for example placement, or placement and signer",
        "nommez par exemple placement, ou placement et signer",
    ),
    (
        "values of {name} are not counted",
        "les valeurs de {name} ne se comptent pas",
    ),
    (
        "count a component such as placement, or gloss, signer, recording, origin, hand",
        "comptez un composant comme placement, ou gloss, signer, recording, origin, hand",
    ),
    (
        "the table would have {rows} rows and {columns} columns",
        "la table aurait {rows} lignes et {columns} colonnes",
    ),
    (
        "count fields of fewer values, or one field",
        "comptez des champs de moins de valeurs, ou un seul champ",
    ),
    (
        "this is too long for a comparison that tolerates slips",
        "c’est trop long pour une comparaison qui admet des fautes",
    ),
    (
        "write at most {n} characters",
        "écrivez au plus {n} caractères",
    ),
    (
        "no citation form is coded for {field}",
        "aucune forme de citation n’est codée pour {field}",
    ),
    ("there are more than {n} pairs", "il y a plus de {n} paires"),
    ("compare more fields", "comparez plus de champs"),
    (
        "no imported table has a column {field} with the others",
        "aucune table importée n’a de colonne {field} avec les autres",
    ),
    (
        "{inventory} has the value {name} already",
        "{inventory} a déjà la valeur {name}",
    ),
    (
        "`chereme list CORPUS values` lists the values",
        "`chereme list CORPUS values` donne la liste des valeurs",
    ),
    (
        "give the value spellings that no other one has",
        "donnez à la valeur des graphies qu’aucune autre n’a",
    ),
    (
        "{from} and {into} are one value already, {left}",
        "{from} et {into} sont déjà une seule valeur, {left}",
    ),
    (
        "the inventory {inventory} has no value {name}",
        "l’inventaire {inventory} n’a pas de valeur {name}",
    ),
    (
        "{address} has no expression of {function}",
        "{address} n’a pas d’expression de {function}",
    ),
    (
        "{fault}; did you mean one of {names}?",
        "{fault} ; vouliez-vous dire l’un de {names} ?",
    ),
    (
        "{fault}; did you mean {near}?",
        "{fault} ; vouliez-vous dire {near} ?",
    ),
];
