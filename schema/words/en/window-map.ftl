## Texts of the map of signs.

window-map-title = Map
window-map-by = Similar by
window-map-whole = Whole map
window-map-count = Signs on the map: { $n }
window-map-left-out = not coded for these: { $n }
window-map-none-in-sight = No sign is in sight. “Whole map” shows all of them.
window-map-alike = most similar:
window-map-hint = The wheel zooms, a drag moves, a click opens a sign, Shift and a drag around signs select them.
