## Texts of the map of signs.

window-map-title = Carte
window-map-by = Semblables par
window-map-whole = Toute la carte
window-map-count = Signes sur la carte : { $n }
window-map-left-out = non codés pour cela : { $n }
window-map-none-in-sight = Aucun signe n’est visible. « Toute la carte » les montre tous.
window-map-alike = les plus proches :
window-map-hint = La molette agrandit, un glissement déplace, un clic ouvre un signe, Maj et un glissement autour de signes les choisissent.
