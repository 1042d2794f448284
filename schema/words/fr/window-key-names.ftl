## Names of keys, as keyboards have them.

window-key-names-ctrl = Ctrl
window-key-names-shift = Maj
window-key-names-alt = Alt
window-key-names-space = Espace
window-key-names-enter = Entrée
window-key-names-tab = Tab
window-key-names-escape = Échap
window-key-names-backspace = Retour arrière
window-key-names-delete = Suppr
window-key-names-insert = Inser
window-key-names-home = Origine
window-key-names-end = Fin
window-key-names-page-up = Page préc.
window-key-names-page-down = Page suiv.
window-key-names-left = Gauche
window-key-names-right = Droite
window-key-names-up = Haut
window-key-names-down = Bas
