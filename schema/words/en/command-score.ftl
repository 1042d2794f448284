## Messages: `{ $name }` is a variable part.

message-command-score-distance-in-all-for-each-frame = distance { $n } in all, { $mean } for each frame of the two (0: the same movement; each part is in its own scale)
line-command-score-largest-distance-joint-cm = largest distance of a joint: { $cm } cm
line-command-score-alignment = alignment: { $n }
message-command-score-score-0-alike-without-ratio-lengths = score { $n } (0: alike); without the ratio of lengths { $other }, ratio { $ratio }; a phase is empty in one of them and left out
message-command-score-score-0-alike-without-ratio-lengths-ratio = score { $n } (0: alike); without the ratio of lengths { $other }, ratio { $ratio }

## Help of commands and options.

help-command-score-measure-similarity-two-pieces-movement-align = Measure the similarity of two pieces of movement, and align them
help-command-score-first-piece-gloss-token-41-recording = The first piece: a gloss, token:41 or recording:3
help-command-score-second-piece = The second piece
help-command-score-draw-alignment-picture-png = Draw the alignment to a picture (.png)
help-command-score-compare-expressions-face-phase-by-phase = Compare expressions of the face phase by phase instead of movement; see `milestones` and `choose`
help-command-score-function-expressions-if-there-several = The function of the expressions, if there are several
help-command-score-score-distance-under-dynamic-time-warping = The score is the distance under dynamic time warping, over placement, movement, orientation and configuration, each in its own scale; 0 is the same movement. Handshapes of hands that nobody captured, whose fingers rest throughout, are not compared; "findings" and "left_out" of `--json` list them.

## Titles of columns.

title-command-score-distance-frame = distance a frame
title-command-score-mean-difference = mean difference
title-command-score-milestones = milestones
title-command-score-path = path
