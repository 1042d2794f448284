## Texts of the export window.

window-export-title = Exportation
window-export-what = Quoi
window-export-format = Format
window-export-skeleton = Squelette
window-export-captured = celui de la capture
window-export-where = Vers où
window-export-replace = Remplacer ce qui s’y trouve
window-export-write = Écrire
window-export-written = Écrit : { $n } fichiers dans { $folder }
window-export-written-one = Écrit : { $name } dans { $folder }
window-export-written-none = Rien n’a été écrit.
window-export-stopped = Arrêté ; rien n’a été écrit.
window-export-token = L’occurrence sélectionnée { $name }
window-export-tier = L’acteur { $name }
window-export-recording = L’enregistrement { $name }
window-export-found-all = Les { $n } occurrences trouvées
window-export-found = Les { $n } occurrences trouvées : { $query }
window-export-all-of-it = Tout le corpus
window-export-folder = dossier de fichiers aux formats ouverts
window-export-csv = tableau (.csv)
window-export-tsv = tableau (.tsv)
window-export-bvh = mouvement (.bvh)
window-export-eaf = ELAN (.eaf)
window-export-sigml = SiGML (.sigml)
window-export-hsigml = H-SiGML (.hsigml)
window-export-hns = HamNoSys (.hns)
