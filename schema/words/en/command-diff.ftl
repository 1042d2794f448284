## Help of commands and options.

help-command-diff-compare-two-annotation-files-two-recordings = Compare two annotation files, or two recordings, by meaning
help-command-diff-two-files-corpus-then-two-recordings = Two files, or a corpus and then two recordings or files
help-command-diff-exit-with-1-if-there-differences = Exit with 1 if there are differences
help-command-diff-lists-annotations-added-removed-moved-given = Lists annotations that were added, removed, moved or given another value, and changes of tiers. Time slots, the order of elements and the spelling of a file make no difference; times within a millisecond are equal. Annotations are matched by their ids if both files descend from the same file, otherwise by tier and time. Both sides are annotation files or templates that `import` reads (- is standard input), or the first argument is a corpus, and the sides are files or addresses such as recording:3. With --json it prints { "{" }"added", "removed", "moved", "revalued", "tiers", "document"{ "}" }. The exit code is 0 after a comparison, 1 if the comparison failed or, with --exit-code, if there are differences, and 2 on wrong usage.
