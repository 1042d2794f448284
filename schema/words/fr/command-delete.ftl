## Help of commands and options.

help-command-delete-delete-recordings-signs-with-everything-belongs = Supprimer des enregistrements et des signes avec tout ce qui leur appartient
help-command-delete-recording-goes-with-tracks-tiers-annotations = Un enregistrement part avec ses pistes, ses acteurs, ses annotations, ses occurrences et sa recette ; les films à côté du corpus restent. Un signe part avec ses entrées de lexique, ses traductions et ses remarques, et avec les enregistrements composés pour lui seul ; un signe qui perd sa dernière occurrence part aussi, sauf s’il a une traduction ou une remarque. Le tout est une seule opération, que `chereme undo` annule : le fichier garde pour cela les nombres, et ne devient pas plus petit.
help-command-delete-if-generated-signs-take-movement-from = Si des signes composés prennent leur mouvement d’un enregistrement, ou si un signe est annoté dans des enregistrements qui restent, rien n’est supprimé sans --with-dependents ou --keep-dependents.
help-command-delete-recordings-signs-such-as-recording-3 = Les enregistrements et les signes, comme recording:3 ou sign:LIMACE
help-command-delete-delete-also-generated-signs-take-movement = Supprimer aussi les signes composés qui en prennent leur mouvement, et les annotations des signes dans les enregistrements qui restent
help-command-delete-keep-generated-signs-take-movement-from = Garder les signes composés qui en prennent leur mouvement ; leurs recettes ne peuvent plus être évaluées
help-command-delete-report-what-would-deleted-write-nothing = Dire ce qui serait supprimé, et ne rien écrire
