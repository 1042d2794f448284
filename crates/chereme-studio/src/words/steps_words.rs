//! Texts of the first steps, the short introduction.

texts! {
    LOOK: "Look", "Regarder";
    LOOK_HOW: "Click a sign: it plays with {play.toggle}, goes frame by frame with {play.frame-forward}, and turns with the mouse.", "Cliquez sur un signe : {play.toggle} le lit, {play.frame-forward} avance d’une image, la souris le tourne.";
    ANNOTATE: "Annotate", "Annoter";
    ANNOTATE_HOW: "Drag on the timeline, type the gloss, Enter; {value.picture} chooses a handshape or a place by its picture.", "Glissez sur la ligne de temps, écrivez la glose, Entrée ; {value.picture} choisit une configuration ou un lieu par son image.";
    SEARCH: "Search", "Rechercher";
    SEARCH_HOW: "{edit.search}, then press hand, body or movement and point at what you look for.", "{edit.search}, puis appuyez sur main, corps ou mouvement et désignez ce que vous cherchez.";
    MAKE: "Make a new sign", "Créer un signe";
    MAKE_HOW: "{recombine.selected} gives the selected sign another handshape, place or movement; {recombine.store} stores it.", "{recombine.selected} donne au signe sélectionné une autre configuration, un autre lieu ou mouvement ; {recombine.store} l’enregistre.";
    BACK: "Take back", "Revenir en arrière";
    BACK_HOW: "{edit.undo} takes back any step, also tomorrow; nothing has to be saved.", "{edit.undo} annule toute étape, demain aussi ; rien n’est à enregistrer.";
    MORE: "{help.palette} finds any command by its name, {help.keys} shows and changes the keys.", "{help.palette} trouve toute commande par son nom, {help.keys} montre et change les touches.";
}
