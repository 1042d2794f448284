//! French forms of messages about films, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const FILMING: &[(&str, &str)] = &[
    (
        "it is the film that the recording {name} names",
        "c’est le film que nomme l’enregistrement {name}",
    ),
    (
        "its pictures are coded as {coding}, which is played through ffmpeg where that is installed",
        "ses images sont codées en {coding}, qui se joue par ffmpeg s’il est installé",
    ),
    (
        "install ffmpeg, or convert the film once: {command}",
        "installez ffmpeg, ou convertissez le film une fois : {command}",
    ),
    (
        "install ffmpeg, which is used then; or convert the film once, where ffmpeg is: {command}",
        "installez ffmpeg, qui est alors utilisé ; ou convertissez le film une fois, là où il y a ffmpeg : {command}",
    ),
    (
        "the film cannot be read: {why}",
        "le film ne se lit pas : {why}",
    ),
    (
        "export or copy it again from where it was recorded",
        "exportez-le ou copiez-le de nouveau depuis l’appareil qui l’a enregistré",
    ),
    (
        "the film cannot be played: {why}; the program itself plays H.264 (8 bits, 4:2:0, not interlaced) in MP4 or MOV files",
        "le film ne se joue pas : {why} ; le programme lui-même joue du H.264 (8 bits, 4:2:0, non entrelacé) dans des fichiers MP4 ou MOV",
    ),
    (
        "the film cannot be played: {why}",
        "le film ne se joue pas : {why}",
    ),
    (
        "ffmpeg finds no pictures in it",
        "ffmpeg n’y trouve pas d’images",
    ),
    ("it has no frames", "il n’a pas d’images"),
    (
        "frame {n} of the film cannot be decoded by ffmpeg",
        "l’image {n} du film ne se décode pas par ffmpeg",
    ),
    (
        "frame {n} of the film cannot be decoded: {why}",
        "l’image {n} du film ne se décode pas : {why}",
    ),
    (
        "the file is damaged there; copy it again, or look at another frame",
        "le fichier est abîmé à cet endroit ; copiez-le de nouveau, ou regardez une autre image",
    ),
    (
        "no MP4 or QuickTime film",
        "ni un film MP4 ni un film QuickTime",
    ),
    (
        "the film has no frame {n}; its frames are 0 to {last}",
        "le film n’a pas d’image {n} ; ses images sont 0 à {last}",
    ),
    (
        "frame {n} of the film was not found",
        "l’image {n} du film est introuvable",
    ),
    ("the file is cut short", "le fichier est tronqué"),
    ("the decoder gave up", "le décodeur a abandonné"),
    ("it is not whole", "il n’est pas entier"),
    (
        "of {all} pictures {n} were coded",
        "images codées : {n} sur {all}",
    ),
    (
        "the film cannot be written: {why}",
        "le film ne s’écrit pas : {why}",
    ),
    (
        "a film of {width} by {height} pixels at {rate} pictures a second is too large for players",
        "un film de {width} sur {height} pixels à {rate} images par seconde est trop grand pour les lecteurs",
    ),
    (
        "make it lower with --height, draw fewer clips next to each other, or lower --rate",
        "rendez-le moins haut avec --height, dessinez moins d’extraits côte à côte, ou baissez --rate",
    ),
    (
        "the film cannot be coded: {why}",
        "le film ne se code pas : {why}",
    ),
];
