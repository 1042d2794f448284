## Messages: `{ $name }` is a variable part.

line-command-propose-accepted = { $n } accepted
line-command-propose-rejected = { $n } rejected
line-command-propose-in-for-could-not-read-from = { $annotations } in { $recordings }, for { $tokens }; { $unread } could not be read from movement
line-command-propose-left-because-something-else-lies = left, because something else lies in their place: { $n }
line-command-propose-by-confidence = by confidence, from: { $counts }

## Help of commands and options.

help-command-propose-propose-values-component-from-movement-for = Propose values of a component from movement, for tokens without a value of it; or run a detector on recordings
help-command-propose-run-this-detector-on-every-recording = Run this detector on every recording, or on that of --for
help-command-propose-component-configuration-handshape-placement-movement-orientation = The component: configuration (or handshape), placement, movement or orientation; without it all four
help-command-propose-only-for-tokens-this-recording-for = Only for the tokens of this recording, or for this token
help-command-propose-accept-these-proposals-by-numbers-their = Accept these proposals, by the numbers of their annotations, as codings of your own; without numbers all that the other options name
help-command-propose-reject-these-proposals-by-numbers-their = Reject these proposals, by the numbers of their annotations; without numbers all that the other options name
help-command-propose-accept-those-tiers-with-this-name = Accept or reject those of tiers with this name
help-command-propose-accept-those-with-this-confidence = Accept or reject those with this confidence or more, from 0 to 1
help-command-propose-with-accept-proposals-become-your-own = With --accept, proposals become your own codings on the tiers that you have for that component and hand; empty tiers of proposals are removed. Without numbers all are accepted, or those of a component, --for, --tier and --confidence. With --reject they stay on tiers such as "configuration dominant (rejected)", count nowhere and are not proposed again.
help-command-propose-movement-each-token-transcribed-values-written = Handshape and palm of each hand are read at their holds, places from the whole sign; all of them are written in the time of a hold, and movements in the time of their acts. The values are written on separate tiers, such as "configuration dominant (proposed)", as annotations of a detector; "moving" says that nothing is held there. They do not count in searches, counts, statistics, recipes and exports of tokens until a person accepts them; the condition `proposed:yes` reads them. A call is one operation, which `undo` takes back. Ctrl-C stops it and leaves the corpus as it was.
help-command-propose-with-detector-short-for-detect = With --detector no transcription runs; it is short for `detect --propose`.
help-command-propose-json-gives-tokens-annotations-numbers-those = `--json` gives "tokens" and "annotations", the numbers of those that were written, "unread", the number of tokens whose movement could not be transcribed, "recordings", the names of those with new annotations, "by_confidence", the numbers of annotations for each tenth of confidence, and "codings", the values, each with "token", "gloss", "field", "value", "start_us", "end_us", "confidence", "is_moving" if nothing is held, and "runner_up" in words of notation. With --accept or --reject it gives what `annotate` gives, and "left", the number of proposals for which there is no room. With --detector it gives what `detect` gives.
help-command-propose-finds-proposed-codings-too = (finds proposed codings, too)
help-command-propose-takes-all-them-back = (takes all of them back)
message-command-propose-moving = moving
message-command-propose-numbers-name-proposals-already = numbers of annotations name proposals already: leave out the component, --for, --tier and --confidence
