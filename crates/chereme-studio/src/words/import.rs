//! The import.

texts! {
    TITLE: "Import", "Importation";
    PATH: "File or folder", "Fichier ou dossier";
    LOOK: "Look at it first", "Examiner d’abord";
    TAKE: "Import", "Importer";
    NOTHING: "Type the path of a file or folder, or drop it on the window.", "Écrivez le chemin d’un fichier ou d’un dossier, ou déposez-le sur la fenêtre.";
    DRY: "This is what was understood; nothing is written yet.", "Voici ce qui a été compris ; rien n’est encore écrit.";
    DONE: "Imported.", "Importé.";
    IMPORTED: "understood", "compris";
    UNCHANGED: "already there", "déjà présent";
    SKIPPED: "left alone", "ignoré";
    REFUSED: "refused", "refusé";
    LINE: "line {n}", "ligne {n}";
}
