## Messages: `{ $name }` is a variable part.

message-command-studio-window-program-own-chereme-studio-neither = la fenêtre est un programme à part, chereme-studio, et ni le dossier de ce programme ni le PATH ne l’ont
message-command-studio-in-checkout-build-with-cargo-build = dans un dépôt, compilez-le avec `cargo build --release` ; ailleurs, installez-le avec `cargo install --path crates/chereme-studio`

## Help of commands and options.

help-command-studio-open-workbench-annotate-search-recombine-in = Ouvrir l’atelier : annoter, chercher et recombiner dans une fenêtre
help-command-studio-corpus-open = Le corpus à ouvrir
help-command-studio-folder-for-settings-starter-corpus-instead = Le dossier des réglages et du corpus de départ, à la place de celui du système
help-command-studio-without-corpus-window-offers-starter-corpus = Sans corpus, la fenêtre propose le corpus de départ, les corpus récents, et l’import d’un dossier. Les réglages sont dans le fichier chereme/studio.json du dossier de réglages du système ; --language y change la langue. F1 montre les touches : celles d’ELAN, de Praat ou d’un montage vidéo.
