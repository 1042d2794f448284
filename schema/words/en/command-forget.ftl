## Messages: `{ $name }` is a variable part.

message-command-forget-no-signer = { $who } is no signer
message-command-forget-write-signer-name = write signer:NAME; recordings and signs go with `chereme delete`
message-command-forget-nothing-written-yet = nothing is written yet; with --yes { $signer } goes for good, with { $n } and the history:
message-command-forget-forgotten-for-good = forgotten for good: { $signer }, { $n } and the history:
message-command-forget-proof = proof: { $n } hashes, identities, names and texts were searched for in the bytes of the file, and none was found outside of rows of others
message-command-forget-rows-of-others-say = rows of others say this, too: { $text } (table { $name })
message-command-forget-files-not-touched = films beside the corpus, copies, exports and publications are not touched: delete them yourself

## Help of commands and options.

help-command-forget-forget-signer-for-good = Forget a signer for good: the one operation that cannot be undone
help-command-forget-all-recordings-of-signer-go = All recordings of the signer go, with tracks, tiers, annotations, tokens, recipes and numbers, and the signer. So do the whole history of the corpus, its search index, and older versions of the file beside it. Then the file is written again, and its bytes are searched for every hash, identity, name and text that was removed; the report says how many were searched for. Texts that rows of somebody else say, too, such as a gloss, stay and are listed.
help-command-forget-nothing-forgotten-while-needed = Nothing is forgotten while something else needs it: signs of others made from these recordings, recordings of others with the same movement, recordings that show others, too, studies, and open decisions after a merge. Films beside the corpus, copies elsewhere, exports and publications are files that this program does not know: delete them yourself, and publish again.
help-command-forget-json-gives = `--json` gives "signer", "dry_run", "recordings", "older_files", "searched" and "still_said", each with "text" and "table".
help-command-forget-signer-such-as = The signer, such as signer:S07
help-command-forget-do-it = Do it; without this the command only says what would go
line-command-forget-more-texts-stand-in-rows = { $n } more texts stand in rows of others: --json lists them
