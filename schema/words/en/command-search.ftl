## Messages: `{ $name }` is a variable part.

line-command-search-saved-search-deleted = saved search @{ $name } deleted: { $query }
message-command-search-saved-stands-for-this-query = saved: @{ $name } stands for this query
line-command-search-1-token = 1 token: { $query }
line-command-search-0-tokens = 0 tokens: { $query }
line-command-search-tokens = { $n } tokens: { $query }
line-command-search-tokens-shown = { $n } tokens, { $shown } shown: { $query }
line-command-search-tokens-in-corpora-shown = { $n } tokens in { $corpora }, { $shown } shown: { $query }
message-command-search-several-corpora-asked-query-nothing-saved = several corpora are asked a query, and nothing is saved or skipped
message-command-search-write-query-after-their-files-leave = write a query after their files, and leave out --keep and --offset
message-command-search-there-no-table-write = there is no table to write
message-command-search-name-fields-with-count-cross = name its fields with --count or --cross
message-command-search-write-number-all = write a number, or all

## Help of commands and options.

help-command-search-number-values-each-field-whose-counts = The number of values of each field whose counts are shown, or all
help-command-search-count-values-field-among-all-tokens = Count the values of a field among all tokens found, such as placement or signer
help-command-search-count-them-for-each-value-another = Count them for each value of another field, too, such as signer
help-command-search-count-how-often-each-pair-values = Count how often each pair of values of two fields occurs, such as dominant.configuration placement
help-command-search-write-table-count-cross-with-commas = Write the table of --count or --cross with commas or tabs between its cells
help-command-search-find-tokens-answer-query = Find the tokens that answer a query
help-command-search-query-all-conditions-must-hold-name = The query; all of its conditions must hold. @NAME stands for a saved search. Further corpora stand before it
help-command-search-save-query-in-corpus-as-name = Save the query in the corpus as @NAME
help-command-search-replace-search-saved-under-name = Replace the search that is saved under that name
help-command-search-delete-saved-search-name = Delete the saved search NAME
help-command-search-show-at-most-n-tokens = Show at most N tokens
help-command-search-skip-first-n-tokens = Skip the first N tokens
help-command-search-order-results = The order of the results: rank (the best first if the query ranks, otherwise by recording and time), gloss, place (recording and time), duration (the longest first), or an attribute such as density; with - before it the greatest first
help-command-search-leave-out-counts-values = Leave out the counts of values
help-command-search-query-finds-lexicon-entries-like-captured = A query finds lexicon entries like captured tokens. Quote it for your shell, for example 'right.configuration=U placement=chin' or 'gloss:BO* not weak.configuration=S'. Any query can contain @NAME for a search that was saved with --keep NAME; `chereme list CORPUS searches` lists the saved ones.
help-command-search-several-corpora-asked-one-after-another = Several corpora are asked one after another if their files stand before the query; hits name their corpus, and counts are added up.
help-command-search-table-for-people-read = A table for people to read
help-command-search-commas-between-cells = Commas between the cells
help-command-search-tabs-between-cells = Tabs between the cells

## Titles of columns.

title-command-search-length = length
