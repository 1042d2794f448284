## Messages: `{ $name }` is a variable part.

line-command-export-wrote-mb = wrote { $n }, { $size } MB, to { $path }
message-command-export-wrote-kb = wrote { $path }, { $size } KB
message-command-export-standard-output-has-no-extension-says = standard output has no extension that says the format
message-command-export-name-as-with-format-csv = name it, as with --format csv

## Help of commands and options.

help-command-export-export-movement-annotations-tables-whole-enriched = Export movement, annotations, tables, or the whole enriched database
help-command-export-file-folder-write-standard-output = The file or folder to write; - is standard output
help-command-export-format-such-as-bvh-csv-needed = The format, such as bvh or csv; needed with --to -, and to write several files into a folder
help-command-export-what-export-all-gloss-token-41 = What to export: all, a gloss, token:41, recording:3, tier:12, inventory:configurations (as .json), or query:'right.configuration=U'; several are written together
help-command-export-extension-determines-format-bvh-movement-recording = The extension of --to determines the format: .bvh (movement of a recording or token), .glb (a person with that movement as glTF, for Blender and the web, with the annotations; .bones.glb without the person), .vrma (movement for avatars), .c3d, .trc or .markers.csv (markers), .eaf, .TextGrid or .xra (a recording's tiers, for ELAN, Praat or SPPAS), .elan.txt (the same as ELAN's tab-delimited text), .srt or .vtt (its translations or glosses as subtitles, one language a file; tier:12 names one), .csv or .tsv (tokens with all components), .curves.csv (the strength of each non-manual, frame by frame), .livelink.csv (a captured face with its timecodes, as Live Link Face writes it for Unreal), .sigml (notated signs as gestural SiGML), .hsigml (the same as HamNoSys's symbols), .hns or .txt (the same as HamNoSys text, one sign on each line), and, if the program was built with `--features parquet`, .parquet (tokens for pandas, polars and DuckDB), .components.parquet, .annotations.parquet and .frames.parquet (a row for each value, each annotation, or each joint in each frame). A name without an extension is a folder: with --format it gets a file of that format for each recording or token that has something for it. Without --format `all` writes into it the database, a data dictionary with example queries, a file for each table, the recordings, the inventories, checksums and provenance. With --to - the file goes to standard output. An EAF file that nobody changed comes back byte for byte, and an edit changes only its own lines. The same corpus always gives the same bytes.
help-command-export-for-whom-it-is-written = For whom it is written: what people did not agree to show them is left out and listed
help-command-export-bones-of-these-avatars = In .bvh and .glb: move the bones of these avatars instead of the captured ones: mixamo, rigify, smplx, ue5, unity, vrm, or a file with a table of bones
help-command-export-frames-a-second-of-movement = The frames a second of .bvh, .glb and .vrma, such as 30; without it, those of the capture
help-command-export-keep-hips-in-place = In .bvh, .glb and .vrma: keep the hips above their first place
help-command-export-copy-history-too = With all and no format: copy the history, too, with everything that was deleted or changed
help-command-export-everything-written-for-those-who-keep = Everything is written for those who keep the corpus, with a note that names who has not agreed that others see it. With --for research or --for public only what all contributors agreed to (`chereme consent`) is written; what is left out is listed, with the reason. LICENCES.md, provenance.json and the copyright of a .glb hold the terms of all who contributed to a recording, or that it may not be shared. A copy of everything has no history unless --with-history is given, and one for others has no studies or saved searches.
