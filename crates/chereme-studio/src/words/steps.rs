//! The first steps.

texts! {
    LOOK: "Look", "Regarder";
    LOOK_HOW: "Choose a recording in the library. {play.toggle} plays and stops, {play.frame-forward} goes on by a frame, and the speed is beside the buttons. The mouse turns the signer; its wheel comes nearer.", "Choisissez un enregistrement dans le fonds. {play.toggle} lit et arrête, {play.frame-forward} avance d’une image, la vitesse est à côté des boutons. La souris tourne le signeur ; la molette rapproche.";
    SELECT: "Select a span", "Sélectionner un intervalle";
    SELECT_HOW: "Drag on the timeline in the row of a tier; or {annotation.begin-end} at the begin and again at the end. {play.selection} plays only that.", "Glissez sur la ligne de temps dans la ligne d’un acteur ; ou {annotation.begin-end} au début et de nouveau à la fin. {play.selection} ne lit que cela.";
    ANNOTATE: "Annotate", "Annoter";
    ANNOTATE_HOW: "Double-click in the selection, or {annotation.new}; type the gloss, and Enter keeps it. Alt and a drag over free time do both at once.", "Double-cliquez dans la sélection, ou {annotation.new} ; écrivez la glose, Entrée la garde. Alt et un glissement là où il n’y a rien font les deux à la fois.";
    VALUE: "Choose a value by its picture", "Choisir une valeur par son image";
    VALUE_HOW: "On a tier of handshapes or places, {value.picture} shows all of them as pictures. Digits choose what is used most.", "Sur un acteur de configurations ou d’emplacements, {value.picture} les montre toutes en images. Les chiffres choisissent les plus utilisées.";
    BOUNDS: "Move boundaries", "Déplacer les limites";
    BOUNDS_HOW: "Drag an edge of an annotation, or with Alt all of it; it settles on frames and on other boundaries.", "Glissez un bord d’une annotation, ou avec Alt l’annotation entière ; elle se cale sur les images et les autres limites.";
    SEARCH: "Search", "Rechercher";
    SEARCH_HOW: "{edit.search}, then for example “handshape U”, or Add a condition. A click opens what was found at its place.", "{edit.search}, puis par exemple « configuration U », ou Ajouter une condition. Un clic ouvre le résultat à sa place.";
    MAKE: "Make a new sign", "Créer un signe";
    MAKE_HOW: "{recombine.selected} begins with the selected sign; Change… gives it another handshape, place or movement. {recombine.store} stores it under a gloss.", "{recombine.selected} part du signe sélectionné ; Changer… lui donne une autre configuration, un autre emplacement ou mouvement. {recombine.store} l’enregistre sous une glose.";
    BACK: "Take back", "Revenir en arrière";
    BACK_HOW: "{edit.undo} takes back any step, {edit.redo} does it again; the history takes back many at once. Nothing has to be saved.", "{edit.undo} annule toute étape, {edit.redo} la rétablit ; l’historique en annule plusieurs. Rien n’est à enregistrer.";
    MORE: "Everything else", "Tout le reste";
    MORE_HOW: "{help.palette} finds any command by its name, {help.keys} shows and changes the keys.", "{help.palette} trouve toute commande par son nom, {help.keys} montre et change les touches.";
}
