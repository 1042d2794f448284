//! Words for errors of the corpus.

texts! {
    ERROR: "error: {what}", "erreur : {what}";
    WHERE: "  where: {what}", "  où : {what}";
    WHAT_TO_DO: "  what to do: {what}", "  que faire : {what}";
    WARNING: "warning: {what}", "attention : {what}";
    NOTE: "note: {what}", "note : {what}";
    PLACED: "{place}: {what}", "{place} : {what}";
    UPGRADED: "note: {path} was written by an older program (version {from}) and is of version {to} now; {kept} is the file as it was", "note : {path} venait d’un programme plus ancien (version {from}) et est maintenant en version {to} ; {kept} est le fichier tel qu’il était";
    LINE: "line {n}: ", "ligne {n} : ";
    ACTIONS: "The actions are: {names}", "Les actions sont : {names}";
    FAILED: "That could not be done.", "Cela n’a pas été possible.";
    TASK_FAILED: "{task}: that could not be done.", "{task} : cela n’a pas été possible.";
    SEVERAL: "Changes that cannot be made: {n}; none was.", "Modifications impossibles : {n} ; aucune n’a été faite.";
    NOT_FOUND: "{path}: there is nothing of this name.", "{path} : rien ne porte ce nom.";
    THERE_ALREADY: "{path}: something of this name is there already.", "{path} : quelque chose porte déjà ce nom.";
    NOT_ALLOWED: "{path} may not be read or written.", "{path} ne peut être ni lu ni écrit.";
    FILE_FAILED: "{path} could not be read or written.", "{path} n’a pas pu être lu ou écrit.";
    NOT_A_CORPUS: "{path} cannot be opened as a corpus.", "{path} ne s’ouvre pas comme corpus.";
    DATABASE: "The corpus could not be read or written.", "Le corpus n’a pas pu être lu ou écrit.";
    BUSY: "Another program is writing to the corpus.", "Un autre programme écrit dans le corpus.";
    DISK_FULL: "The disk is full.", "Le disque est plein.";
    READ_ONLY: "The corpus may not be written here.", "Le corpus ne peut pas être écrit ici.";
    DAMAGED: "Something in the corpus is damaged.", "Quelque chose est abîmé dans le corpus.";
    INDEX: "The search index has a fault.", "L’index de recherche a un défaut.";
    OTHER_CORPUS: "choose a file that Chereme made; the start page makes a new one, empty or of a folder’s files", "choisissez un fichier créé par Chereme ; la page de départ en crée un, vide ou à partir d’un dossier";
    CHECK_HERE: "“Check the corpus” of the File menu shows where, and builds derived data again", "« Vérifier le corpus » du menu Fichier dit où, et refait ce qui peut l’être";
    CHECK_PATH: "check the spelling of the path", "vérifiez l’orthographe du chemin";
    OTHER_NAME: "choose another name, or move the existing one away", "choisissez un autre nom, ou déplacez ce qui existe";
    ASK_RIGHTS: "the file or its folder needs rights that you do not have", "le fichier ou son dossier demande des droits que vous n’avez pas";
    TRY_AGAIN: "try again when it is done", "réessayez quand il aura fini";
    MAKE_ROOM: "make room and try again; nothing was lost", "faites de la place et réessayez ; rien n’est perdu";
    QUERY_WRONG: "The query is not understood:", "La requête ne se comprend pas :";
}
