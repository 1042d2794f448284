//! The French of `chereme import`.

use crate::words::Words;

/// The French words of the command.
pub(in crate::commands) const WORDS: Words = Words {
    help: &[
        (
            "Import recordings, annotations, lexicons and inventories into a corpus",
            "Importer enregistrements, annotations, lexiques et inventaires dans un corpus",
        ),
        (
            "Files and folders; - is standard input, with its kind in --format",
            "Fichiers et dossiers ; - est l’entrée standard, et --format en donne le genre",
        ),
        (
            "The kind of the file on standard input, as an extension: eaf, bvh, csv, sigml ...",
            "Le genre de fichier de l’entrée standard, par son extension : eaf, bvh, csv, sigml ...",
        ),
        (
            "The name of the recording or table on standard input",
            "Le nom de l’enregistrement ou de la table de l’entrée standard",
        ),
        (
            "Report what would be done, and write nothing",
            "Dire ce qui serait fait, sans rien écrire",
        ),
        (
            "Keep your edits and take the file's other changes; if both changed the same annotation, yours stays",
            "Garder vos modifications et prendre les autres du fichier ; si les deux ont changé la même annotation, la vôtre reste",
        ),
        (
            "Take everything from the file, even if it takes back your edits",
            "Tout prendre du fichier, même si cela annule vos modifications",
        ),
        (
            "Leave a recording as it is if the file would take back your edits",
            "Laisser un enregistrement tel quel si le fichier annulait vos modifications",
        ),
        ("The signer's dominant hand", "La main dominante du signeur"),
        (
            "The unit of length of the movement files: m, cm, mm, inch, ft, acclaim, or metres per unit",
            "L’unité de longueur des fichiers de mouvement : m, cm, mm, inch, ft, acclaim, ou des mètres par unité",
        ),
        (
            "The axes of the movement files: the directions up and to the signer's left, such as +Z,+X",
            "Les axes des fichiers de mouvement : vers le haut et vers la gauche du signeur, comme +Z,+X",
        ),
        (
            "A file that assigns joints to parts of the body, in lines such as `right wrist = RHand`",
            "Un fichier qui attribue les articulations aux parties du corps, en lignes comme `right wrist = RHand`",
        ),
        (
            "Read the root's columns as the numbers suggest if the header gives a wrong order or unit",
            "Lire les colonnes de la racine d’après leurs nombres si l’en-tête en donne mal l’ordre ou l’unité",
        ),
        (
            "A JSON file with the meaning of tiers or columns",
            "Un fichier JSON qui donne le sens des acteurs ou des colonnes",
        ),
        (
            "The origin of the recordings",
            "L’origine des enregistrements",
        ),
        (
            "The terms under which the recordings may be used",
            "Les conditions d’usage des enregistrements",
        ),
        (
            "The recording for all tracks and tiers of the files, instead of the one with the files' name",
            "L’enregistrement pour toutes les pistes et tous les acteurs des fichiers, au lieu de celui qui porte leur nom",
        ),
        (
            "The start of the files' tracks on the recording's clock, such as 0.48s",
            "Le début des pistes des fichiers sur l’horloge de l’enregistrement, comme 0.48s",
        ),
        (
            "The time of day at which the files' tracks start, if they do not state it: 12:34:56:07, or 12:34:56:07@25 for 25 frames a second. Tracks of a recording with known times of day are aligned by them",
            "L’heure à laquelle commencent les pistes des fichiers, s’ils ne la donnent pas : 12:34:56:07, ou 12:34:56:07@25 pour 25 images par seconde. Les pistes d’un enregistrement dont les heures sont connues sont calées sur elles",
        ),
        (
            "The frame rate of points from film and of tables of markers that do not state it, in frames per second, such as 50 or 30000/1001",
            "La cadence des points d’un film et des tables de marqueurs qui ne la donnent pas, en images par seconde, comme 50 ou 30000/1001",
        ),
        (
            "Files of the same name in one folder become one recording, and so do files with overlapping timecodes; files of the same name in two folders become two recordings, except for annotations that fit into a take of their name. A film is linked to the recording with its name, or whose .eaf names it. A line of HamNoSys holds the gloss, a tab, and the symbols. The report shows how each file was interpreted. Options override this, also later: --map gives an imported file other tiers or columns. A corpus that does not exist yet is created. If a file cannot be read, the others are imported.",
            "Les fichiers du même nom dans un dossier forment un enregistrement, de même que ceux dont les timecodes se recouvrent ; les fichiers du même nom dans deux dossiers en forment deux, sauf des annotations qui tiennent dans une prise de leur nom. Un film est lié à l’enregistrement qui porte son nom, ou dont le .eaf le nomme. Une ligne de HamNoSys contient la glose, une tabulation et les symboles. Le rapport montre comment chaque fichier a été interprété. Des options y changent quelque chose, même plus tard : --map donne à un fichier déjà importé d’autres acteurs ou colonnes. Un corpus qui n’existe pas encore est créé. Si un fichier ne peut pas être lu, les autres sont importés.",
        ),
        (
            "An annotation file that was imported before and edited since updates its recording, annotation by annotation. If that would take back edits made in the corpus, the file is refused and the edits are listed; then --merge, --theirs or --mine decides. One import is one operation: `chereme undo` takes it back, and Ctrl-C leaves the corpus as it was.",
            "Un fichier d’annotation déjà importé et modifié depuis met à jour son enregistrement, annotation par annotation. Si cela annulait des modifications faites dans le corpus, le fichier est refusé et elles sont énumérées ; --merge, --theirs ou --mine en décide alors. Un import est une opération : `chereme undo` l’annule, et Ctrl-C laisse le corpus tel qu’il était.",
        ),
    ],
    lines: &[
        (
            "and {n} more findings like these, all of them with --json",
            "et {n} constats de plus comme ceux-ci, tous avec --json",
        ),
        ("made: {list}", "créés : {list}"),
        ("removed: {list}", "retirés : {list}"),
        ("would make: {list}", "créerait : {list}"),
        ("would remove: {list}", "retirerait : {list}"),
        (
            "{n} more files were imported without a warning; --json lists their notes",
            "autres fichiers importés sans avertissement : {n} ; --json donne leurs notes",
        ),
        (
            "not read: {what} without an ending ({why})",
            "pas lus : {what} sans extension ({why})",
        ),
        ("not read: {what} ({why})", "pas lus : {what} ({why})"),
        ("nothing new", "rien de nouveau"),
        (
            "{n} joints, {rate}, unit {unit}, axes up,left = {axes}",
            "{n} articulations, {rate}, unité {unit}, axes haut,gauche = {axes}",
        ),
        (
            "track {name}: {n} points, {all} frames, {rate}, unit {unit}, axes up,left = {axes}",
            "piste {name} : {n} points, {all} images, {rate}, unité {unit}, axes haut,gauche = {axes}",
        ),
        (
            "track {name}: {n} points, {all} frames, {rate}",
            "piste {name} : {n} points, {all} images, {rate}",
        ),
        (
            "track {name}: {n} curves, {all} frames, {rate}",
            "piste {name} : {n} courbes, {all} images, {rate}",
        ),
        ("column {name}: {meaning}", "colonne {name} : {meaning}"),
        (
            "{file}: updated -> recording {name}",
            "{file} : mis à jour -> enregistrement {name}",
        ),
        ("{file}: updated", "{file} : mis à jour"),
        (
            "{file}: unchanged -> recording {name}",
            "{file} : inchangé -> enregistrement {name}",
        ),
        ("{file}: unchanged", "{file} : inchangé"),
        (
            "{file}: REFUSED -> recording {name}",
            "{file} : REFUSÉ -> enregistrement {name}",
        ),
        ("{file}: REFUSED", "{file} : REFUSÉ"),
        (
            "{file} -> recording {name}",
            "{file} -> enregistrement {name}",
        ),
        (
            "standard input has no extension that says its kind",
            "l’entrée standard n’a pas d’extension qui dise son genre",
        ),
        (
            "name it, as with --format eaf",
            "nommez-le, comme avec --format eaf",
        ),
        (
            "{format} is no extension of a file, or {name} no name",
            "{format} n’est pas une extension de fichier, ou {name} n’est pas un nom",
        ),
        (
            "write --format eaf, and --name take1",
            "écrivez --format eaf, et --name prise1",
        ),
        (
            "a corpus stores the path of a film, and standard input has none",
            "un corpus retient le chemin d’un film, et l’entrée standard n’en a pas",
        ),
        ("name the file of the film", "nommez le fichier du film"),
        (
            "write hours, minutes, seconds and frames: 12:34:56:07@25",
            "écrivez heures, minutes, secondes et images : 12:34:56:07@25",
        ),
        (
            "write a whole number such as 50, or a fraction such as 30000/1001",
            "écrivez un nombre entier comme 50, ou une fraction comme 30000/1001",
        ),
        (
            "a unit of length has between 0.000001 and 1000 metres",
            "une unité de longueur fait entre 0,000001 et 1000 mètres",
        ),
        (
            "write m, cm, mm, inch, ft, acclaim, or how many metres one unit is",
            "écrivez m, cm, mm, inch, ft, acclaim, ou combien de mètres fait une unité",
        ),
        (
            "write lines such as `right wrist = RHand`, each a part of the body and a joint",
            "écrivez des lignes comme `right wrist = RHand`, chacune une partie du corps et une articulation",
        ),
    ],
    titles: &[],
};
