//! Texts of the export window.

texts! {
    TITLE: "Export", "Exportation";
    WHAT: "What", "Quoi";
    FORMAT: "Format", "Format";
    WHERE: "Where to", "Vers où";
    REPLACE: "Replace the existing file", "Remplacer ce qui s’y trouve";
    WRITE: "Write", "Écrire";
    WRITTEN: "Written: {n} files in {folder}", "Écrit : {n} fichiers dans {folder}";
    WRITTEN_ONE: "Written: {name} in {folder}", "Écrit : {name} dans {folder}";
    WRITTEN_NONE: "Nothing was written.", "Rien n’a été écrit.";
    STOPPED: "Stopped; nothing was written.", "Arrêté ; rien n’a été écrit.";
    TOKEN: "The selected token {name}", "L’occurrence sélectionnée {name}";
    TIER: "The tier {name}", "L’acteur {name}";
    RECORDING: "The recording {name}", "L’enregistrement {name}";
    FOUND_ALL: "The {n} tokens found", "Les {n} occurrences trouvées";
    FOUND: "The {n} tokens found: {query}", "Les {n} occurrences trouvées : {query}";
    ALL_OF_IT: "The whole corpus", "Tout le corpus";
    FOLDER: "folder of files in open formats", "dossier de fichiers aux formats ouverts";
    CSV: "table (.csv)", "tableau (.csv)";
    TSV: "table (.tsv)", "tableau (.tsv)";
    BVH: "movement (.bvh)", "mouvement (.bvh)";
    EAF: "ELAN (.eaf)", "ELAN (.eaf)";
    SIGML: "SiGML (.sigml)", "SiGML (.sigml)";
    HSIGML: "H-SiGML (.hsigml)", "H-SiGML (.hsigml)";
    HNS: "HamNoSys (.hns)", "HamNoSys (.hns)";
}
