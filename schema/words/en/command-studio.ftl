## Messages: `{ $name }` is a variable part.

message-command-studio-window-program-own-chereme-studio-neither = the window is a program of its own, chereme-studio, and neither the folder of this program nor the path has it
message-command-studio-in-checkout-build-with-cargo-build = in a checkout, build it with `cargo build --release`; elsewhere, install it with `cargo install --path crates/chereme-studio`

## Help of commands and options.

help-command-studio-open-workbench-annotate-search-recombine-in = Open the workbench: annotate, search and recombine in a window
help-command-studio-corpus-open = The corpus to open
help-command-studio-folder-for-settings-starter-corpus-instead = The folder for the settings and the starter corpus, instead of the platform's
help-command-studio-without-corpus-window-offers-starter-corpus = Without a corpus the window offers the starter corpus, recent corpora, and the import of a folder. The settings are in the file chereme/studio.json of the platform's settings folder; --language changes the language there. F1 shows the keys: ELAN's, Praat's or a video editor's.
