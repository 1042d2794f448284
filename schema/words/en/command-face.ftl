## Messages: `{ $name }` is a variable part.

line-command-face-fitted-on-frames = { $system } of { $whose }, fitted on { $n } frames of { $recording }
line-command-face-unknown = unknown: { $names }
line-command-face-frames-in-track = { $recording }: { $n } frames of { $system } in the track { $name }
line-command-face-weights-fitted-on = the weights were fitted on { $on }
line-command-face-frames-with-bridged-gaps = frames with bridged gaps: { $n }
line-command-face-annotations-written = { $n } annotations written
line-command-face-stored-from-now-on-these-weights = stored: from now on these weights apply to all faces of { $whose }
message-command-face-no-face-system = { $name } is no face system
message-command-face-systems = the systems are: { $names }

## Help of commands and options.

help-command-face-show-captured-face-in-program-s = Show a captured face in the program's own numbers, or list the supported face systems
help-command-face-recording-token-in = The recording, or a token in it
help-command-face-show-one-face-system-arkit-mediapipe = Show one face system: arkit, mediapipe, openface, fap, mesh, sigml or house (the program's own)
help-command-face-propose-annotations-brows-lids-gaze-mouth = Propose annotations of brows, lids, gaze, mouth and head, each with its confidence and the rule that found it
help-command-face-fit-weights-mapping-signer-from-take = Fit the weights of the mapping to the signer, from a take in which each part of the face moves to its extremes
help-command-face-store-result-proposals-as-tiers-such = Store the result: proposals as tiers such as "nonmanual.brows (proposed)", fitted weights for every face of the signer; `undo` takes it back
help-command-face-captured-channels-stay-as-their-file = Captured channels stay as their file has them. The program derives its own numbers of a face from them, or estimates them from the points of a face on film (.pose). Without a recording the command lists the face systems (ARKit, MediaPipe, OpenFace, MPEG-4, SiGML), and with --system the mapping of one system and its losses.
help-command-face-systems = (the systems)
help-command-face-channels-formulas-losses = (its channels, formulas and losses)
help-command-face-face-recording = (the face of a recording)
help-command-face-brows-blinks-gaze-mouth-shakes-nods = (brows, blinks, gaze, mouth, shakes and nods as tiers)
help-command-face-weights-for-this-signer-from-range = (weights for this signer, from a range of motion)

## Titles of columns.

title-command-face-confidence = confidence
title-command-face-end = end
title-command-face-formula = formula
title-command-face-least = least
title-command-face-mean = mean
title-command-face-most = most
title-command-face-number = number
title-command-face-numbers-face = numbers of a face
title-command-face-rule = rule
title-command-face-system = system
title-command-face-times-above = times above
title-command-face-times-below = times below
title-command-face-weights = weights
