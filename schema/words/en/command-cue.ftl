## Messages: `{ $name }` is a variable part.

message-command-cue-there-nothing-cue-write-text-from = there is nothing to cue; write a text, or --from FILE

## Help of commands and options.

help-command-cue-generate-cued-speech-for-text-cueing = Generate cued speech for a text: the cueing hand next to the speaking face, on any body
help-command-cue-body-cues-signer-signer-name-skeleton = The body that cues: that of a signer (signer:NAME), or the skeleton of a recording (recording:NAME); without it the program chooses one
help-command-cue-cue-with-left-hand = Cue with the left hand
help-command-cue-explain-movement = Explain the movement
help-command-cue-rules-spelling-turn-french-text-into = Rules of spelling turn French text into phones. With --phones the input itself is phones; --from takes phones, words or sentences and their times from a file with annotations, such as a TextGrid, EAF, XRA or SRT file. With --as the movement is stored as a new sign with tiers for phones, keys, hand and fingers; then the query `cue.shape=5 cue.placement=throat` finds its keys, and `cue=24 meets cue=31` finds pairs of keys.
help-command-cue-draw-movement-contact-sheet-png-animation = Draw the movement to a contact sheet (.png) or an animation (.gif)
