## Messages: `{ $name }` is a variable part.

line-command-fit-stored-as-track = stored as the track { $name }
line-command-fit-frames-skeleton-scaled-by-median-distance = { $n } frames; the skeleton scaled by { $scale }; median distance of the markers { $mm } mm

## Help of commands and options.

help-command-fit-fit-skeleton-markers-recording-report-distance = Fit a skeleton to the markers of a recording, and report the distance of every marker
help-command-fit-recording-with-markers-such-as-recording = The recording with markers, such as recording:3
help-command-fit-recording-whose-skeleton-fitted-without-program = The recording whose skeleton is fitted; without it the program's own body
help-command-fit-track-markers-if-there-several = The track of markers, if there are several
help-command-fit-person-whose-markers-used-if-they = The person whose markers are used, if they are those of several people: Anna for Anna:LSHO
help-command-fit-report-distances-store-nothing = Report the distances and store nothing
help-command-fit-movement-becomes-track-recording-distances-markers = The movement becomes a track of the recording, and the distances of the markers in every frame become a track of curves; the markers stay as they are. The program knows the labels of three sets of markers: Plug-in Gait, the 41 markers of CMU, and Helen Hayes.

## Titles of columns.

title-command-fit-joint = joint
title-command-fit-marker = marker
title-command-fit-median-mm = median_mm
title-command-fit-most-mm = most_mm
title-command-fit-seen = seen
