## Texts of the pickers of values.

window-pickers-choose = Choisir…
window-pickers-filter = Taper pour trouver une valeur
window-pickers-none = Aucune valeur ne correspond à « { $text } ».
window-pickers-enter = Entrée choisit { $value }
window-pickers-tip =
    { $value }
    Flèches pour aller, Entrée pour choisir, Ctrl et un clic pour en savoir tout
window-pickers-on-body = Sur le corps
window-pickers-in-space = Dans l’espace
window-pickers-from-front = De face
window-pickers-from-side = De côté
window-pickers-head = Tête
window-pickers-trunk = Corps
window-pickers-weak-hand = Main faible
window-pickers-space-front = Vu de face
window-pickers-space-side = De côté
window-pickers-near = Près
window-pickers-reach = Milieu
window-pickers-far = Loin
window-pickers-point-at = Désignez un lieu
window-pickers-zone = { $value }, sur l’image
window-pickers-away = Vers l’avant
window-pickers-level = Sans avancer
window-pickers-towards = Vers soi
window-pickers-as-signer = Vu par la personne qui signe
window-pickers-drawing = Le corps se dessine…
