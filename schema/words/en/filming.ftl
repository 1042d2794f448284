## Messages: `{ $name }` is a variable part.

message-filming-film-recording-names = it is the film that the recording { $name } names
message-filming-pictures-coded-as-played-through-ffmpeg = its pictures are coded as { $coding }, which is played through ffmpeg where that is installed
message-filming-install-ffmpeg-convert-film-once = install ffmpeg, or convert the film once: { $command }
message-filming-install-ffmpeg-used-then-convert-film = install ffmpeg, which is used then; or convert the film once, where ffmpeg is: { $command }
message-filming-film-cannot-read = the film cannot be read: { $why }
message-filming-export-copy-again-from-where-recorded = export or copy it again from where it was recorded
message-filming-film-cannot-played-program-itself-plays = the film cannot be played: { $why }; the program itself plays H.264 (8 bits, 4:2:0, not interlaced) in MP4 or MOV files
message-filming-film-cannot-played = the film cannot be played: { $why }
message-filming-ffmpeg-finds-no-pictures-in = ffmpeg finds no pictures in it
message-filming-has-no-frames = it has no frames
message-filming-frame-film-cannot-decoded-by-ffmpeg = frame { $n } of the film cannot be decoded by ffmpeg
message-filming-frame-film-cannot-decoded = frame { $n } of the film cannot be decoded: { $why }
message-filming-file-damaged-there-copy-again-look = the file is damaged there; copy it again, or look at another frame
message-filming-no-mp4-quicktime-film = no MP4 or QuickTime film
message-filming-film-has-no-frame-frames-0 = the film has no frame { $n }; its frames are 0 to { $last }
message-filming-frame-film-not-found = frame { $n } of the film was not found
message-filming-file-cut-short = the file is cut short
message-filming-decoder-gave-up = the decoder gave up
message-filming-not-whole = it is not whole
message-filming-pictures-coded = of { $all } pictures { $n } were coded
message-filming-film-cannot-written = the film cannot be written: { $why }
message-filming-film-by-pixels-at-pictures-second = a film of { $width } by { $height } pixels at { $rate } pictures a second is too large for players
message-filming-make-lower-with-height-draw-fewer = make it lower with --height, draw fewer clips next to each other, or lower --rate
message-filming-film-cannot-coded = the film cannot be coded: { $why }
