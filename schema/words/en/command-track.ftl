## Messages: `{ $name }` is a variable part.

message-command-track-starts-at-s-now-s-correlation = { $track } starts at { $time } s (now { $now } s): correlation { $r } with { $other }, elsewhere at most { $most }, confidence { $sure }
message-command-track-this-uncertain-look-at-both-tracks = this is uncertain: look at both tracks before you use it, or name other channels
message-command-track-write-time-in-seconds-such-as = write a time in seconds such as 0.48s, or 480ms

## Help of commands and options.

help-command-track-list-tracks-recording-move-align-rename = List the tracks of a recording, or move, align, rename or remove one of them
help-command-track-recording-such-as-recording-3-recording = The recording, such as recording:3 or recording:"NGT Thanks"
help-command-track-track-s-name = The track's name
help-command-track-new-path-film-another-media-file = The new path of a film or another media file that was moved
help-command-track-new-start-track-on-recording-s = The new start of the track on the recording's clock, such as 0.48s or -12ms
help-command-track-new-name-track = The new name of the track
help-command-track-remove-track-with-all-data = Remove the track with all its data
help-command-track-joints-points-curves-track-whose-speeds = The joints, points or curves of the track whose speeds are compared
help-command-track-joints-points-curves-other-track = The joints, points or curves of the other track
help-command-track-largest-shift-from-present-offset = The largest shift from the present offset
help-command-track-move-track-offset-found = Move the track to the offset that was found
help-command-track-align-track-with-this-one-find = Align the track with this one: find the offset with the most similar speeds, of the wrists if no channel is named
help-command-track-recording-has-any-number-tracks-on = A recording has any number of tracks on one clock: movement of skeletons, markers, curves, media. Without an option the tracks are listed. `chereme import CORPUS FILE --into recording:3 --offset 0.48s` imports a file's tracks into an existing recording.

## Titles of columns.

title-command-track-duration-s = duration_s
title-command-track-rate = rate
