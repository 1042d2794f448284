## Help of commands and options.

help-command-new-create-empty-corpus-with-inventories-handshapes = Create an empty corpus with the inventories of handshapes, placements, movements and the rest
help-command-new-file-create-such-as-lsf-chereme = The file to create, such as lsf.chereme; it must not exist yet
