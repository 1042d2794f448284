## The program of the window, as a command.

program-unknown-option = option inconnue : { $option }
program-missing-value = { $option } demande une valeur
program-unwanted-value = { $option } prend un de { $codes }, pas { $value }
program-second-corpus = un seul corpus s’ouvre à la fois ; { $option } en est un deuxième
program-see-help = chereme-studio --help donne la liste des options
