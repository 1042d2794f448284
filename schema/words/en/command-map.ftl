## Messages: `{ $name }` is a variable part.

line-command-map-left-out-tokens-not-coded-for = left out: { $n } tokens that are not coded for these components
line-command-map-drew-signs-kb = drew { $n } signs to { $path }: { $size } KB

## Help of commands and options.

help-command-map-place-signs-on-map-similar-signs = Place the signs on a map: similar signs lie near each other
help-command-map-tokens-place-as-in-chereme-search = The tokens to place, as in `chereme search`
help-command-map-components-count-configuration-placement-movement-orientation = The components that count: configuration, placement, movement, orientation, nonmanual
help-command-map-draw-map-this-file-svg-standard = Draw the map to this file, an .svg; - is standard output
help-command-map-two-signs-similar-if-they-share = Two signs are similar if they share values, features of handshapes, or broader places; all components have the same weight. Without a query the map shows the citation forms of all signs. `--json` gives "components", "left_out" (the number of tokens without a coding for them) and "signs", each with "token", "gloss", "origin", "x" and "y" from 0 to 1, and "near", the five most similar tokens.

## Titles of columns.

title-command-map-most-alike = most alike
