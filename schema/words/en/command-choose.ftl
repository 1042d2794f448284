## Messages: `{ $name }` is a variable part.

line-command-choose-more-not-compared = and { $n } more were not compared
line-command-choose-performances-for-compared = { $n } performances of { $function } for { $sign }, { $order }; compared: { $channels }
message-command-choose-most-similar-own-face-first = the most similar to its own face first
message-command-choose-least-similar-own-face-first = the least similar to its own face first
message-command-choose-most-usual-first = the most usual first
line-command-choose-left-out-as-they-unknown = left out, as they are unknown: { $names }
message-command-choose-comparisons-with-phases-too-different-lengths = comparisons with phases of too different lengths for the window of 10 frames, which was widened: { $n }
line-command-choose-each-compared-with-others = each was compared with { $n } others
line-command-choose-not-compared = not compared: { $token }: { $why }

## Help of commands and options.

help-command-choose-rank-recorded-expressions-face-such-as = Rank recorded expressions of the face, such as those of a negation, for a sentence, and animate it with one of them
help-command-choose-function-expression-negation-wh-yn-topic = The function of the expression: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier of functions
help-command-choose-sentence-recording-token-in-annotation-function = The sentence: a recording, a token in it, or the annotation of its function
help-command-choose-order-ranking = The order of the ranking
help-command-choose-how-many-performances-report = How many performances to report
help-command-choose-animate-sentence-with-face-store-under = Animate the sentence with the face, and store it under this gloss
help-command-choose-address-performance-animate-with-without-first = The address of the performance to animate with; without it the first of the ranking
help-command-choose-channels-compare-separated-by-commas-head = The channels to compare, separated by commas: head, brow, eye, gaze, jaw, mouth …; without it head and brows
help-command-choose-weights-phases-onset-first-rest-offset = The weights of the phases onset, first, rest and offset, such as 1,2,2,0.5
help-command-choose-leave-ratio-lengths-out-score = Leave the ratio of lengths out of the score
help-command-choose-refuse-phases-no-path-within-alignment = Refuse phases that no path within the alignment window (10 frames) connects, instead of widening the window
help-command-choose-most-similar-sentence-s-own-face = The most similar to the sentence's own face; the medoid if that face was not recorded
help-command-choose-least-similar-sentence-s-own-face = The least similar to the sentence's own face
help-command-choose-most-similar-all-others = The most similar to all others
help-command-choose-dynamic-time-warping-aligns-each-phase = Dynamic time warping aligns each phase of a recorded performance (see `milestones`) with the same phase of the sentence's own face. The score is the sum of the distances times the ratio of lengths; 0 is the same face. If the sentence's face was not recorded, the most typical performance, the medoid, comes first. A recording is never its own candidate; equal scores are ordered by name.
help-command-choose-with-as-sentence-generated-again-with = With --as the sentence is generated again with head, trunk and face of the first performance, or of the one that --use names; each of its phases is stretched to the length of the sentence's own.
help-command-choose-json-gives-ranking-each-with-token = `--json` gives "ranking", each with "token", "recording", "score", "unstretched", "stretch", "partial", "phases" ("phase", "frames", "distance", "normalized", "made", "channels") and "channels", and "channels", "left_out", "compared", "adapted", "skipped"; with --as "made" and "recipe".

## Titles of columns.

title-command-choose-differs-most-in = differs most in
title-command-choose-score = score
title-command-choose-stretch = stretch
