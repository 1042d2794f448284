## Messages: `{ $name }` is a variable part.

line-command-render-drew-frames-or-symbols = drew { $what } to { $path }: { $drawn }, { $size } KB
line-command-render-has-no-movement-own-notation-animated = { $name } has no movement of its own: its notation was animated on { $body }
line-command-render-has-no-notation-transcribed-from-movement = { $name } has no notation: it was transcribed from its movement, and not stored
message-command-render-speed-number-from = a speed is a number from { $least } to { $most }

## Help of commands and options.

help-command-render-draw-movement-as-contact-sheet-png = Draw movement as a contact sheet (.png), an animation (.gif) or a film (.mp4), handshapes (.png), or notation (.svg)
help-command-render-number-pictures-per-second-in-film = The number of pictures per second in a film, from 1 to 120
help-command-render-write-glosses-below-animation-film-while = Write glosses below an animation or a film while they are signed
help-command-render-what-draw = What to draw
help-command-render-picture-write-extension-determines-kind-standard = The picture to write; its extension determines the kind; - is standard output
help-command-render-kind-picture-for-standard-output-png = The kind of picture for standard output: png, gif, mp4 or svg
help-command-render-number-pictures-side-by-side-in = The number of pictures side by side in a contact sheet, from 1 to 64
help-command-render-leave-out-close-ups-hands-face = Leave out the close-ups of hands and face
help-command-render-hand-on-handshapes-drawn = The hand on which handshapes are drawn
help-command-render-height-one-picture-in-pixels-from = The height of one picture in pixels, from 32 to 2000; without it 260, for films 540, for handshapes 128, for faces 160
help-command-render-speed-animation-from-0-05-20 = The speed of an animation, from 0.05 to 20; 1 is the recorded speed
help-command-render-show-close-up-face-next-signer = Show a close-up of the face next to the signer, in every picture
help-command-render-what-gloss-recording-s-name-token = WHAT is a gloss, a recording's name, token:41, recording:3, recording:"NGT Thanks", or inventory:configurations or inventory:configurations/U for handshapes. If a sign has only a notation, the program animates it first. The program draws the symbols of HamNoSys without a font; inventory:hamnosys shows all of them. inventory:faces shows the face for each non-manual of SiGML. Several WHAT are drawn next to each other in one film or animation: they begin together, and the shorter ones stop at their last picture. Films are in H.264, which every player, browser and office program can show.
help-command-render-for-whom-it-is-drawn = For whom it is drawn: what people did not agree to show them is left out and listed
