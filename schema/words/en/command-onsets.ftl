## Messages: `{ $name }` is a variable part.

line-command-onsets-expressions-without-face = expressions: { $n }; without a face: { $none }
line-command-onsets-expressions-during-nothing-measured-at-times = expressions during which nothing was measured at times: { $n }
message-command-onsets-expressions-more-than-half-hour-not = expressions of more than half an hour, which were not examined: { $n }; annotate shorter ones

## Help of commands and options.

help-command-onsets-measure-when-non-manuals-begin-end = Measure when non-manuals begin and end relative to the signs that they span, for each function
help-command-onsets-channel-face-head-begins-when-halfway = A channel of the face or head begins when it is halfway from its value half a second before the expression to its most extreme value over the signs, and ends when it is halfway back; one that is not back half a second after M5 has no end. Onsets are in seconds after the start of the first sign (negative: before it), and ends in seconds after the end of the last sign. The functions are those of `milestones`.
help-command-onsets-json-gives-expressions-without-face-with = `--json` gives "expressions", "without_face", "with_gaps", "too_long" and "rows", each with "function", "channel", "n", "onset_s" ("q1", "median", "q3"), "ends" and "offset_s", which is null without ends.

## Titles of columns.

title-command-onsets-n-ends = n of ends
title-command-onsets-begins-median-quartiles = begins: median (quartiles)
title-command-onsets-ends-median-quartiles = ends: median (quartiles)
