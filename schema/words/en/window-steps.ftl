## Texts of the first steps, the short introduction.

window-steps-look = Look
window-steps-look-how = Click a sign: it plays with { $play-toggle }, goes frame by frame with { $play-frame-forward }, and turns with the mouse.
window-steps-annotate = Annotate
window-steps-annotate-how = Drag on the timeline, type the gloss, Enter; { $value-picture } chooses a handshape or a place by its picture.
window-steps-search = Search
window-steps-search-how = { $edit-search }, then press hand, body or movement and point at what you look for.
window-steps-make = Make a new sign
window-steps-make-how = { $recombine-selected } gives the selected sign another handshape, place or movement; { $recombine-store } stores it.
window-steps-back = Take back
window-steps-back-how = { $edit-undo } takes back any step, also tomorrow; nothing has to be saved.
window-steps-more = { $help-palette } finds any command by its name, { $help-keys } shows and changes the keys.
