## Help of commands and options.

help-command-new-create-empty-corpus-with-inventories-handshapes = Créer un corpus vide avec les inventaires de configurations, emplacements, mouvements et autres
help-command-new-file-create-such-as-lsf-chereme = Le fichier à créer, comme lsf.chereme ; il ne doit pas encore exister
