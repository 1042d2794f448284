## Messages: `{ $name }` is a variable part.

message-command-recombine-there-already-stays-replace-instead-as = note: { $gloss } was there already and stays; --replace { $other } instead of --as puts a sign in its place
line-command-recombine-stored-as-token-recording-s = stored { $gloss } as token:{ $token }, recording { $name }, { $seconds } s: { $recipe }
line-command-recombine-s-not-stored-give-gloss-with = { $seconds } s, not stored (give it a gloss with --as): { $recipe }

## Help of commands and options.

help-command-recombine-compose-new-sign-from-stored-ones = Compose a new sign from stored ones, and store it
help-command-recombine-recipe-as-text-json-standard-input = The recipe, as text or JSON; - is standard input
help-command-recombine-replace-sign-generated-before-keeps-gloss = Replace a sign that was generated before; it keeps its gloss, its token and the annotations that people wrote on its tiers
help-command-recombine-explain-sign-steps-source-each-channel = Explain the sign: its steps, the source of each channel, joins and residuals
help-command-recombine-draw-sign-contact-sheet-png-animation = Draw the sign to a contact sheet (.png), an animation (.gif) or a film (.mp4)
help-command-recombine-recipe-sign-changes-escargot-configure-right = A recipe is a sign and the changes to it: ESCARGOT | configure right U. The new sign gets its own tiers and is found by search like a captured one; its recipe is stored with it. Quote the recipe for your shell.
help-command-recombine-sources-what-recipe-begins-with = Sources: what a recipe begins with
help-command-recombine-sign-corpus-with-movement-as-notation = a sign of the corpus, with movement or as notation
help-command-recombine-whole-recording-by-name-if-no = a whole recording, by its name if no sign has that name
help-command-recombine-word-in-manual-alphabet = a word in a manual alphabet
help-command-recombine-reaching-for-point-left-up-from = reaching for a point: to the left, up from the floor, forward
help-command-recombine-notation = notation
help-command-recombine-operators-changes-one-after-another-each = Operators: the changes, one after another, each after |
help-command-recombine-one-after-other-with-transitions = One after the other, with transitions
