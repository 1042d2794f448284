## Messages: `{ $name }` is a variable part.

message-command-merge-conflicts = which conflicts?
message-command-merge-there-no-conflicts = there are no conflicts
message-command-merge-standard-input-has-no-name-by = standard input has no name by which the corpus could find the earlier version of the file
message-command-merge-write-chereme-import-corpus-format-eaf = write `chereme import CORPUS - --format eaf --name NAME --merge`
message-command-merge-corpus-cannot-merged-into-annotation-file = a corpus cannot be merged into an annotation file
message-command-merge-name-corpus-first = name the corpus first
message-command-merge-corpus-already-has-state-from-file = a corpus already has the state from which the file was exported
message-command-merge-leave-base-out = leave --base out
message-command-merge-merged-file-needs-name = the merged file needs a name
message-command-merge-write-merged-eaf-for-standard-output = write --to merged.eaf, or --to - for standard output
message-command-merge-no-decision-given = no decision is given
message-command-merge-add-take-mine-theirs-both = add --take mine, theirs or both
message-command-merge-chereme-conflicts-corpus-lists-them-all = `chereme conflicts CORPUS` lists them; `all` means all of them
message-command-merge-name-them-by-their-numbers-write = name them by their numbers, or write all

## Help of commands and options.

help-command-merge-merge-copy-somebody-else-changed-into = Merge a copy that somebody else changed into your corpus or annotation file
help-command-merge-your-corpus-your-annotation-file = Your corpus, or your annotation file
help-command-merge-other-corpus-annotation-file = The other corpus or annotation file
help-command-merge-corpus-file-both-copies = The corpus or file that both were copies of
help-command-merge-merged-annotation-file-standard-output = The merged annotation file; - is standard output
help-command-merge-list-conflicts-merges-decide-some-them = List the conflicts of merges, or decide some of them
help-command-merge-conflicts-decide-by-their-numbers-all = The conflicts to decide, by their numbers, or all
help-command-merge-candidate-take = The candidate to take
help-command-merge-your-candidate-stays = Your candidate stays
help-command-merge-other-candidate-takes-place = The other candidate takes its place
help-command-merge-both-stay = Both stay
help-command-merge-list-decided-conflicts-too = List decided conflicts, too
help-command-merge-change-only-one-side-made-taken = A change that only one side made is taken over, field by field. Different changes of one field are a conflict: your value stays, and the other one is kept as a candidate until you decide with `chereme conflicts`. OTHER is a copy of the corpus, or an annotation file that was exported from it and changed. If both are annotation files, --to names the merged file, which has the layout of yours; the other side's candidates are then on tiers `NAME (theirs)`. For corpora the common earlier state is found in their history; --base names it for files, and for corpora without a common history. A merge into a corpus is one operation: `chereme undo` takes it back.
help-command-merge-each-conflict-has-your-candidate-in = Each conflict has your candidate, which is in the corpus, and the other side's. `--take mine` leaves yours, `--take theirs` replaces it with the other one, and `--take both` keeps the two: the second annotation goes on the same tier if there is room, otherwise on a tier `NAME (theirs)`. A decision is an operation: `chereme undo` takes it back.
