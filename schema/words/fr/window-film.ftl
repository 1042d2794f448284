## Texts about films.

window-film-title = Film
window-film-no-film = Cet enregistrement n’a pas de film. Liez-en un, ou importez un fichier ELAN qui le nomme.
window-film-link = Lier un film…
window-film-coming = Ouverture du film…
window-film-gone = Le film n’est ni à { $path }, ni dans les dossiers à côté du corpus.
window-film-missing = Introuvable : { $name }
window-film-find = Le retrouver…
window-film-about = À propos de l’enregistrement
window-film-not-begun = Le film n’a pas encore commencé ici.
window-film-is-over = Le film est fini ici.
window-film-back = Reculer d’une image du film
window-film-forward = Avancer d’une image du film
window-film-hold = Fixer
window-film-hold-hint = Le film reste fixe pendant que l’enregistrement bouge : trouvez le même moment dans les deux
window-film-here = Cette image est ici
window-film-here-hint = L’image du film que vous voyez est le moment de la tête de lecture ; annuler revient en arrière
window-film-offset = Début du film
window-film-offset-hint = Le début du film sur l’horloge de l’enregistrement ; faites glisser, ou tapez des secondes
window-film-frame-of = image { $n } sur { $all } du film
