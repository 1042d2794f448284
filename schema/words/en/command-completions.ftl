## Messages: `{ $name }` is a variable part.

line-command-completions-wrote = wrote { $n } to { $path }

## Help of commands and options.

help-command-completions-write-completion-script-shell-standard-output = Write the completion script of a shell to standard output
help-command-completions-shell = The shell
help-command-completions-write-manual-pages-for-program-man = Write the manual pages for the program `man`
help-command-completions-folder-for-pages-one-for-each = The folder for the pages, one for each command; without it the page of the whole program goes to standard output
