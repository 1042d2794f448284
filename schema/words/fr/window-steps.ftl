## Texts of the first steps, the short introduction.

window-steps-look = Regarder
window-steps-look-how = Cliquez sur un signe : { $play-toggle } le lit, { $play-frame-forward } avance d’une image, la souris le tourne.
window-steps-annotate = Annoter
window-steps-annotate-how = Glissez sur la ligne de temps, écrivez la glose, Entrée ; { $value-picture } choisit une configuration ou un lieu par son image.
window-steps-search = Rechercher
window-steps-search-how = { $edit-search }, puis appuyez sur main, corps ou mouvement et désignez ce que vous cherchez.
window-steps-make = Créer un signe
window-steps-make-how = { $recombine-selected } donne au signe sélectionné une autre configuration, un autre lieu ou mouvement ; { $recombine-store } l’enregistre.
window-steps-back = Revenir en arrière
window-steps-back-how = { $edit-undo } annule toute étape, demain aussi ; rien n’est à enregistrer.
window-steps-more = { $help-palette } trouve toute commande par son nom, { $help-keys } montre et change les touches.
