## Help of commands and options.

help-command-delete-delete-recordings-signs-with-everything-belongs = Delete recordings and signs with everything that belongs to them
help-command-delete-recording-goes-with-tracks-tiers-annotations = A recording goes with its tracks, tiers, annotations, tokens and recipe; films next to the corpus stay. A sign goes with its lexicon entries, translations and remarks, and with recordings that were generated for it alone; a sign that loses its last token goes too, unless it has a translation or a remark. All of it is one operation, and `chereme undo` restores it: the file keeps the numbers for that, and does not become smaller.
help-command-delete-if-generated-signs-take-movement-from = If generated signs take movement from a recording, or a sign is annotated in recordings that stay, nothing is deleted without --with-dependents or --keep-dependents.
help-command-delete-recordings-signs-such-as-recording-3 = The recordings and signs, such as recording:3 or sign:LIMACE
help-command-delete-delete-also-generated-signs-take-movement = Delete also generated signs that take movement from them, and annotations of the signs in recordings that stay
help-command-delete-keep-generated-signs-take-movement-from = Keep generated signs that take movement from them; their recipes cannot be evaluated again
help-command-delete-report-what-would-deleted-write-nothing = Report what would be deleted, and write nothing
