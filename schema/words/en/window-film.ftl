## Texts about films.

window-film-title = Film
window-film-no-film = This recording has no film. Link one, or import an ELAN file that names it.
window-film-link = Link a film…
window-film-coming = Opening the film…
window-film-gone = The film is not at { $path }, nor in the folders next to the corpus.
window-film-missing = Missing: { $name }
window-film-find = Find it…
window-film-about = About the recording
window-film-not-begun = The film has not begun here.
window-film-is-over = The film is over here.
window-film-back = One film frame back
window-film-forward = One film frame forward
window-film-hold = Hold
window-film-hold-hint = The film stands still while the recording moves: find the same moment in both
window-film-here = This frame is here
window-film-here-hint = The frame of the film that you see is the moment of the playhead; undo takes it back
window-film-offset = Start of the film
window-film-offset-hint = The start of the film on the clock of the recording; drag it, or type seconds
window-film-frame-of = film frame { $n } of { $all }
