//! French forms of messages about tables of points, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const POINTED: &[(&str, &str)] = &[
    (
        "the table states neither a rate nor times; {n} frames a second are taken",
        "la table ne donne ni cadence ni temps ; {n} images par seconde sont prises",
    ),
    (
        "this is no table of points: no columns have the name of a point and an axis, such as wrist_x, wrist_y and wrist_z",
        "ce n’est pas une table de points : aucune colonne n’a le nom d’un point et un axe, comme wrist_x, wrist_y et wrist_z",
    ),
    (
        "the header has no row of axes, which begins with Frame; export the take again with its header",
        "l’en-tête n’a pas la ligne des axes, qui commence par Frame ; exportez de nouveau la prise avec son en-tête",
    ),
    (
        "the header has no row of types; export the take again with its header",
        "l’en-tête n’a pas la ligne des types ; exportez de nouveau la prise avec son en-tête",
    ),
    (
        "the header has no row of names; export the take again with its header",
        "l’en-tête n’a pas la ligne des noms ; exportez de nouveau la prise avec son en-tête",
    ),
    (
        "the header has no row of {what}; export the take again with its header",
        "l’en-tête n’a pas de ligne {what} ; exportez de nouveau la prise avec son en-tête",
    ),
    (
        "the file has no section Trajectories, which holds markers, but {names}; export the trajectories, too",
        "le fichier n’a pas de section Trajectories, qui contient les marqueurs, mais {names} ; exportez aussi les trajectoires",
    ),
    (
        "the places of its bones are relative to their parents (Coordinate Space is Local), and it holds no markers; export them in global coordinates, or the take as BVH, FBX or C3D",
        "les positions de ses os sont relatives à leurs parents (Coordinate Space est Local), et il ne contient pas de marqueurs ; exportez-les en coordonnées globales, ou la prise en BVH, FBX ou C3D",
    ),
    (
        "the places of its bones are relative to their parents (Coordinate Space is Local), and are left out",
        "les positions de ses os sont relatives à leurs parents (Coordinate Space est Local), et laissées de côté",
    ),
    (
        "export them in global coordinates, or the take as BVH, FBX or C3D",
        "exportez-les en coordonnées globales, ou la prise en BVH, FBX ou C3D",
    ),
    (
        "the titles of the bodies (BODY_NAMES) do not show which columns are places; export the take as C3D, or as TSV with 3D data",
        "les titres des corps (BODY_NAMES) ne montrent pas quelles colonnes sont des positions ; exportez la prise en C3D, ou en TSV avec des données 3D",
    ),
    (
        "each row is one point of a frame, which the column {name} names; write one row for each frame, with columns such as wrist_x, wrist_y and wrist_z",
        "chaque ligne est un point d’une image, que nomme la colonne {name} ; écrivez une ligne par image, avec des colonnes comme wrist_x, wrist_y et wrist_z",
    ),
    (
        "the rows up to here lack {n} cells of the header; the header fits other rows than these",
        "jusqu’ici il manque aux lignes {n} cellules de l’en-tête ; l’en-tête va avec d’autres lignes que celles-ci",
    ),
    (
        "the header has more than {n} columns",
        "l’en-tête a plus de {n} colonnes",
    ),
    (
        "its time is not after that of the row before; sort the rows by time, one row for each frame",
        "son temps n’est pas après celui de la ligne précédente ; triez les lignes par temps, une ligne par image",
    ),
    (
        "{cell} of the column {name} is no number, and was left out",
        "{cell} de la colonne {name} n’est pas un nombre, et a été laissé de côté",
    ),
    ("cells without a number", "cellules sans nombre"),
    (
        "the times are milliseconds, as the stated rate shows; they are read as such",
        "les temps sont des millisecondes, comme la cadence indiquée le montre ; ils sont lus ainsi",
    ),
    (
        "the file states {stated}, and the times of the rows show {rate}, which is taken",
        "le fichier indique {stated}, et les temps des lignes montrent {rate}, qui est pris",
    ),
    (
        "some rows have no time; the numbers of the frames and the rate show it",
        "des lignes n’ont pas de temps ; les numéros des images et la cadence le montrent",
    ),
    (
        "the numbers of the frames do not rise; the rows are taken one after the other",
        "les numéros des images ne montent pas ; les lignes sont prises l’une après l’autre",
    ),
    (
        "frames are missing, as their numbers show; every frame has its own time",
        "des images manquent, comme leurs numéros le montrent ; chaque image a son propre temps",
    ),
    (
        "the unit is {unit}; metres are assumed",
        "l’unité est {unit} ; le mètre est supposé",
    ),
    (
        "say the unit with --unit, such as --unit mm, or write it into the titles, such as wrist_x [mm]",
        "donnez l’unité avec --unit, comme --unit mm, ou écrivez-la dans les titres, comme wrist_x [mm]",
    ),
    (
        "say the unit with --unit, such as --unit mm",
        "donnez l’unité avec --unit, comme --unit mm",
    ),
    (
        "the places where bodies expect their markers are left out, for the seen markers are there: {n}",
        "les positions où les corps attendent leurs marqueurs sont laissées de côté, car les marqueurs vus sont là : {n}",
    ),
    (
        "its markers are where bodies expect them, not where cameras saw them: {n}",
        "ses marqueurs sont là où les corps les attendent, et non là où les caméras les ont vus : {n}",
    ),
    (
        "columns of rotations are left out, for a table of points holds the places of bones and rigid bodies alone: {n}",
        "des colonnes de rotations sont laissées de côté, car une table de points ne contient que les positions des os et des corps rigides : {n}",
    ),
    (
        "export the take as BVH or FBX, too, for a skeleton that moves",
        "exportez aussi la prise en BVH ou en FBX, pour un squelette qui bouge",
    ),
    (
        "columns of errors and qualities of markers and bodies are left out: {n}",
        "des colonnes d’erreurs et de qualités des marqueurs et des corps sont laissées de côté : {n}",
    ),
    (
        "a second section Trajectories is left out",
        "une deuxième section Trajectories est laissée de côté",
    ),
    (
        "put it into a file of its own",
        "mettez-la dans son propre fichier",
    ),
    (
        "sections of other data are left out: {names}",
        "des sections d’autres données sont laissées de côté : {names}",
    ),
    (
        "export the trial as C3D, which holds analog channels and events, too",
        "exportez l’essai en C3D, qui contient aussi les canaux analogiques et les événements",
    ),
    (
        "no row of units; millimetres are assumed",
        "aucune ligne d’unités ; le millimètre est supposé",
    ),
    (
        "columns of trajectories that are no places, such as velocities, are left out: {n}",
        "des colonnes de trajectoires qui ne sont pas des positions, comme des vitesses, sont laissées de côté : {n}",
    ),
    (
        "the header states {stated} frames, and the file holds {held}",
        "l’en-tête annonce {stated} images, et le fichier en contient {held}",
    ),
    (
        "annotations are imported from a table with a row for each: its tier, begin, end and value",
        "les annotations s’importent d’une table avec une ligne pour chacune : son acteur, son début, sa fin et sa valeur",
    ),
    (
        "columns of text are left out: {names}",
        "des colonnes de texte sont laissées de côté : {names}",
    ),
    (
        "the table states no unit; its points are {n} apart at most, so metres are assumed",
        "la table ne donne pas d’unité ; ses points ont au plus {n} entre eux, le mètre est donc supposé",
    ),
    (
        "the table states no unit; its points are {n} apart at most, so centimetres are assumed",
        "la table ne donne pas d’unité ; ses points ont au plus {n} entre eux, le centimètre est donc supposé",
    ),
    (
        "the table states no unit; its points are {n} apart at most, so millimetres are assumed",
        "la table ne donne pas d’unité ; ses points ont au plus {n} entre eux, le millimètre est donc supposé",
    ),
    (
        "markers of head and feet show that {seen} is up, and {program} usually has {usual} up; {taken} is taken",
        "les marqueurs de tête et de pieds montrent que {seen} est vers le haut, et {program} a d’habitude {usual} vers le haut ; {taken} est pris",
    ),
    (
        "the file does not state which axis is up; {axis} is taken, as {program} usually has it",
        "le fichier ne dit pas quel axe est vertical ; {axis} est pris, comme d’habitude dans {program}",
    ),
];
