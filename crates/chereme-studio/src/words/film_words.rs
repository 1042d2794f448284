//! Texts about films.

texts! {
    TITLE: "Film", "Film";
    NO_FILM: "This recording has no film. Link one, or import an ELAN file that names it.", "Cet enregistrement n’a pas de film. Liez-en un, ou importez un fichier ELAN qui le nomme.";
    LINK: "Link a film…", "Lier un film…";
    COMING: "Opening the film…", "Ouverture du film…";
    GONE: "The film is not at {path}, nor in the folders next to the corpus.", "Le film n’est ni à {path}, ni dans les dossiers à côté du corpus.";
    MISSING: "Missing: {name}", "Introuvable : {name}";
    FIND: "Find it…", "Le retrouver…";
    ABOUT: "About the recording", "À propos de l’enregistrement";
    NOT_BEGUN: "The film has not begun here.", "Le film n’a pas encore commencé ici.";
    IS_OVER: "The film is over here.", "Le film est fini ici.";
    BACK: "One film frame back", "Reculer d’une image du film";
    FORWARD: "One film frame forward", "Avancer d’une image du film";
    HOLD: "Hold", "Fixer";
    HOLD_HINT: "The film stands still while the recording moves: find the same moment in both", "Le film reste fixe pendant que l’enregistrement bouge : trouvez le même moment dans les deux";
    HERE: "This frame is here", "Cette image est ici";
    HERE_HINT: "The frame of the film that you see is the moment of the playhead; undo takes it back", "L’image du film que vous voyez est le moment de la tête de lecture ; annuler revient en arrière";
    OFFSET: "Start of the film", "Début du film";
    OFFSET_HINT: "The start of the film on the clock of the recording; drag it, or type seconds", "Le début du film sur l’horloge de l’enregistrement ; faites glisser, ou tapez des secondes";
    FRAME_OF: "film frame {n} of {all}", "image {n} sur {all} du film";
}
