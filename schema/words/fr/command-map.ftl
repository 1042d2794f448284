## Messages: `{ $name }` is a variable part.

line-command-map-left-out-tokens-not-coded-for = laissées de côté : { $n } occurrences qui ne sont pas codées pour ces composants
line-command-map-drew-signs-kb = signes dessinés dans { $path } : { $n }, { $size } Ko

## Help of commands and options.

help-command-map-place-signs-on-map-similar-signs = Placer les signes sur une carte : les signes qui se ressemblent sont proches
help-command-map-tokens-place-as-in-chereme-search = Les occurrences à placer, comme dans `chereme search`
help-command-map-components-count-configuration-placement-movement-orientation = Les composants qui comptent : configuration, placement, movement, orientation, nonmanual
help-command-map-draw-map-this-file-svg-standard = Dessiner la carte dans ce fichier, un .svg ; - est la sortie standard
help-command-map-two-signs-similar-if-they-share = Deux signes se ressemblent s’ils partagent des valeurs, des traits de configurations ou des emplacements plus larges ; tous les composants ont le même poids. Sans requête, la carte montre les formes de citation de tous les signes. `--json` donne "components", "left_out" (le nombre d’occurrences qui ne sont pas codées pour eux) et "signs", chacun avec "token", "gloss", "origin", "x" et "y" de 0 à 1, et "near", les cinq occurrences les plus proches.

## Titles of columns.

title-command-map-most-alike = le plus proche
