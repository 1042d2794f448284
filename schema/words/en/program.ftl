## The program of the window, as a command.

program-unknown-option = unknown option { $option }
program-missing-value = { $option } needs a value
program-unwanted-value = { $option } takes one of { $codes }, not { $value }
program-second-corpus = one corpus can be opened at once; { $option } is a second one
program-see-help = chereme-studio --help lists the options
