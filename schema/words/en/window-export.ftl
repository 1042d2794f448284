## Texts of the export window.

window-export-title = Export
window-export-what = What
window-export-format = Format
window-export-skeleton = Skeleton
window-export-captured = as captured
window-export-where = Where to
window-export-replace = Replace the existing file
window-export-write = Write
window-export-written = Written: { $n } files in { $folder }
window-export-written-one = Written: { $name } in { $folder }
window-export-written-none = Nothing was written.
window-export-stopped = Stopped; nothing was written.
window-export-token = The selected token { $name }
window-export-tier = The tier { $name }
window-export-recording = The recording { $name }
window-export-found-all = The { $n } tokens found
window-export-found = The { $n } tokens found: { $query }
window-export-all-of-it = The whole corpus
window-export-folder = folder of files in open formats
window-export-csv = table (.csv)
window-export-tsv = table (.tsv)
window-export-bvh = movement (.bvh)
window-export-eaf = ELAN (.eaf)
window-export-sigml = SiGML (.sigml)
window-export-hsigml = H-SiGML (.hsigml)
window-export-hns = HamNoSys (.hns)
