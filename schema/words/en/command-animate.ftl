## Help of commands and options.

help-command-animate-synthesise-movement-from-notation-hamnosys-sigml = Synthesise movement from notation: HamNoSys or SiGML, on any body
help-command-animate-notation-file-hamnosys-text-notated-sign = The notation: a file, HamNoSys text, or a notated sign; - is SiGML or HamNoSys from standard input
help-command-animate-body-signs-signer-signer-name-skeleton = The body that signs: that of a signer (signer:NAME), or the skeleton of a recording (recording:NAME); without it the program chooses one
help-command-animate-explain-movement-strokes-residuals-approximations = Explain the movement: strokes, residuals, approximations
help-command-animate-draw-movement-contact-sheet-png-animation = Draw the movement to a contact sheet (.png), an animation (.gif) or a film (.mp4)
help-command-animate-size-duration-depth-movements-default-quiet = The size, duration and depth of movements: default; quiet (the default without sway, blinks and other movement that the notation does not write); measured (every number that at least eight captured signs of the corpus show, else the default); or a JSON file of your own numbers, as in schema/notation/body_language.json; without the option measured
help-command-animate-notation-sigml-file-hamnosys-in-quotes = The notation is a SiGML file; HamNoSys in quotes, as characters or as names of symbols; a file with lines of HamNoSys (.hns or .txt); or a sign that the corpus holds as notation, such as a gloss or token:41. Several signs are performed one after another, and the hands move straight from one to the next. With --as the movement is stored as a new sign, with its own tiers and its recipe.
