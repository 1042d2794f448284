## Help of commands and options.

help-command-animate-synthesise-movement-from-notation-hamnosys-sigml = Synthétiser un mouvement à partir d’une notation, HamNoSys ou SiGML, sur n’importe quel corps
help-command-animate-notation-file-hamnosys-text-notated-sign = La notation : un fichier, du HamNoSys, ou un signe noté ; - est du SiGML ou du HamNoSys de l’entrée standard
help-command-animate-body-signs-signer-signer-name-skeleton = Le corps qui signe : celui d’un signeur (signer:NOM), ou le squelette d’un enregistrement (recording:NOM) ; sinon le programme en choisit un
help-command-animate-explain-movement-strokes-residuals-approximations = Expliquer le mouvement : traits, écarts, approximations
help-command-animate-draw-movement-contact-sheet-png-animation = Dessiner le mouvement en planche (.png), en animation (.gif) ou en film (.mp4)
help-command-animate-size-duration-depth-movements-default-quiet = La taille, la durée et la profondeur des mouvements : default ; quiet (comme default, sans balancement, clignements ni autre mouvement que la notation n’écrit pas) ; measured (chaque nombre que montrent au moins huit signes captés du corpus, sinon default) ; ou un fichier JSON de vos propres nombres, comme schema/notation/body_language.json ; sans l’option, measured
help-command-animate-notation-sigml-file-hamnosys-in-quotes = La notation est un fichier SiGML ; du HamNoSys entre guillemets, en caractères ou en noms de symboles ; un fichier de lignes de HamNoSys (.hns ou .txt) ; ou un signe que le corpus a en notation, comme une glose ou token:41. Plusieurs signes sont exécutés l’un après l’autre, et les mains vont droit de l’un au suivant. Avec --as, le mouvement est enregistré comme un nouveau signe, avec ses acteurs et sa recette.
