## Messages: `{ $name }` is a variable part.

line-command-detect-coded-in = coded: { $annotations } in { $recordings }
line-command-detect-proposed-in = proposed: { $annotations } in { $recordings }
line-command-detect-nothing-found-in = nothing found in { $recording }: { $why }
line-command-detect-nothing-examine-in = nothing to examine in { $recordings }

## Help of commands and options.

help-command-detect-cut-takes-into-signs = Cut takes into signs, or run another detector on recordings
help-command-detect-detector = The detector
help-command-detect-only-in-this-recording-token = Only in this recording or token, or in the recordings of the tokens that a query finds: `in` and its address or query
help-command-detect-write-found-on-tiers-proposals = Write what is found on tiers of proposals
help-command-detect-write-found-as-codings-your-own = Write what is found as codings of your own
help-command-detect-find-more-signs = Find more signs; twice for still more
help-command-detect-find-fewer-signs = Find fewer signs; twice for still fewer
help-command-detect-cost-sign-usual = The cost of a sign: 4 is usual, 0 gives a quarter too many signs
help-command-detect-detector-signs-finds-signs-between = The detector "signs" finds the signs between rests, and the preparation, stroke, hold and retraction of each hand. Several signs without a rest between them are parted by a model that was learned on generated signing; --more and --fewer, or --cost, change how readily it does so. The other detectors are listed below.
help-command-detect-without-propose-store-result-shown = Without --propose and --store the result is shown, and nothing is written. With --propose it is written on tiers such as "gloss (proposed)", where it replaces earlier proposals that nobody has changed; `propose --accept` accepts them. With --store it becomes your own codings, except where something else lies. The gloss of a sign that was found is UNGLOSSED. A call is one operation, which `undo` takes back. Odd frames at the ends of a take are left out.
help-command-detect-json-gives-detector-annotations = `--json` gives "detector", "annotations", the number of those that were written, "recordings", the names of those with new annotations, "unobserved", the number of recordings without the part that the detector examines, "found", the proposals of each recording with tier, times, value, confidence and evidence, and "without", the recordings in which nothing was found, with the reason.
