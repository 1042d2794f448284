## What detectors find, and why they propose it.

detector-signs-peeled = the only sign between two rests, by the { $side } hand
detector-signs-peeled-by-both = the only sign between two rests, by both hands; the { $side } hand leads
detector-signs-decoded = one of several signs between two rests, by the { $side } hand
detector-signs-decoded-by-both = one of several signs between two rests, by both hands; the { $side } hand leads
detector-signs-phase = part of the sign that this hand makes
detector-signs-finds = signs, and the preparation, stroke, hold and retraction of each hand
detector-nonmanuals-finds = actions of brows, lids, gaze, mouth and head, from the curves of the face
detector-nonmanuals-shorter = { $peak } above the median; { $threshold } is enough, for less than { $time } s
detector-nonmanuals-above = { $peak } above the median; { $threshold } is enough
detector-nonmanuals-swings = { $count } half swings of { $mean } degrees; { $fewest } of { $least } are enough
