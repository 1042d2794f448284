//! Texts of the recombination pane.

texts! {
    TITLE: "Recombine", "Recombiner";
    RECIPE: "Recipe", "Recette";
    HINT: "ESCARGOT | configure right U", "ESCARGOT | configure right U";
    GLOSS: "Gloss of the new sign", "Glose du nouveau signe";
    STORE: "Store", "Enregistrer";
    SHOW_STORED: "Show it", "Le voir";
    STORE_AGAIN: "Store as new", "Enregistrer à part";
    REPLACE: "Replace {name}", "Remplacer {name}";
    REPLACE_TIP: "Its gloss, its token and people's annotations on its tiers stay; undo restores the former sign", "Sa glose, son occurrence et les annotations sur ses acteurs restent ; annuler rétablit l’ancien signe";
    REPLACE_SAME: "The sign has this recipe already.", "Le signe a déjà cette recette.";
    NEEDS_GLOSS: "A new sign needs a gloss.", "Un nouveau signe a besoin d’une glose.";
    NEEDS_RECIPE: "There is nothing to store yet.", "Il n’y a encore rien à enregistrer.";
    EMPTY: "A new sign begins with an existing one.", "Un nouveau signe part d’un signe existant.";
    EMPTY_MORE: "Choose a sign, change its components, and see the result at once.", "Choisissez un signe, changez ses composants, et voyez aussitôt le résultat.";
    BEGIN_SELECTED: "Begin with {gloss}", "Partir de {gloss}";
    OPENED: "The recipe of {name}", "La recette de {name}";
    CLEAR: "Clear", "Vider";
    ADD_OPERATOR: "Change…", "Changer…";
    ADD_SOURCE: "Then…", "Puis…";
    BEGIN_WITH: "Begin with…", "Commencer par…";
    CARD: "Card: {card}", "Carte : {card}";
    CARD_MENU: "More for: {card}", "Plus pour : {card}";
    REMOVE_CARD: "Remove: {card}", "Retirer : {card}";
    REMOVE: "Remove", "Retirer";
    SWITCHED_ON: "Switched on: {card}", "En service : {card}";
    SWITCH_TIP: "Switch on or off; it stays in the stack", "Mettre en ou hors service ; la carte reste";
    INCOMPLETE: "Not filled in yet; left out.", "Pas encore rempli ; laissé de côté.";
    RESIDUAL: "{mm} mm from its goal", "à {mm} mm du but";
    MADE_LASTS: "{time} s, generated in {took} ms", "{time} s, généré en {took} ms";
    SHOW_ORIGINAL: "Original", "Original";
    SHOW_MADE: "Made", "Résultat";
    CHANNELS: "The source of each channel ({n})", "La source de chaque canal ({n})";
    JOINS: "Joins ({n})", "Raccords ({n})";
    CONTACTS: "Contacts undone ({n})", "Contacts défaits ({n})";
    OTHER_SIGN: "Take another sign", "Prendre un autre signe";
    SUGGEST: "New signs from {sign}", "Ce qu’on peut faire de {sign}";
    NO_PARTNERS: "No sign differs from it in one component only.", "Aucun signe n’en diffère par un seul composant.";
    UNUSED: "{field}: values that no sign has with the rest", "{field} : valeurs qu’aucun signe n’a avec le reste";
    SIGN: "Sign", "Signe";
    SIGN_NAME: "Gloss or address of the sign", "Glose ou adresse du signe";
    SIGN_HINT: "Gloss", "Glose";
    TAKE_SELECTED: "Take {gloss}", "Prendre {gloss}";
    SPELL: "Spelling", "Épellation";
    LETTERS: "Letters", "Lettres";
    LETTERS_HINT: "LSF", "LSF";
    ALPHABET: "Alphabet", "Alphabet";
    ANY_ALPHABET: "usual alphabet", "alphabet habituel";
    POINT: "Pointing", "Pointage";
    POINT_AT: "at", "vers";
    CUE: "Cued speech", "Langue parlée complétée";
    CUE_TEXT: "French text to cue", "Texte à coder";
    CUE_HINT: "le chat dort", "le chat dort";
    CUE_OWN_HAND: "signer’s hand", "main du signeur";
    CUE_LEFT: "left", "gauche";
    CUE_RIGHT: "right", "droite";
    CUE_PHASES: "phases of", "phases de";
    CUE_PACE: "sounds last", "durée des sons";
    HAMNOSYS: "HamNoSys", "HamNoSys";
    HAMNOSYS_SYMBOLS: "HamNoSys symbols", "Symboles HamNoSys";
    SIGML: "Notated sign", "Signe noté";
    SIGML_NAME: "Name of the notated sign", "Nom du signe noté";
    TEXT: "As text", "En texte";
    CONFIGURE: "Handshape", "Configuration";
    CONFIGURE_HINT: "another shape of the hand", "une autre forme de la main";
    PLACE: "Place", "Emplacement";
    PLACE_DOES: "the hands elsewhere", "les mains ailleurs";
    ORIENT: "Orientation", "Orientation";
    ORIENT_HINT: "the hands turned", "les mains tournées";
    TRAVEL: "Path", "Trajet";
    TRAVEL_HINT: "the hands moved along a path", "les mains portées le long d’un chemin";
    AMPLIFY: "Size", "Ampleur";
    AMPLIFY_HINT: "larger or smaller movement", "mouvement plus ample ou plus petit";
    REPEAT: "Repeat", "Répéter";
    REPEAT_HINT: "again and again", "encore et encore";
    REVERSE: "Reverse", "Inverser";
    REVERSE_HINT: "backwards", "à l’envers";
    SWAP: "Swap hands", "Échanger les mains";
    SWAP_HINT: "the arms exchange their movement", "les bras échangent leurs rôles";
    MIRROR: "Mirror", "Miroir";
    MIRROR_HINT: "one arm copies the other", "un bras copie l’autre";
    RETIME: "Speed", "Vitesse";
    RETIME_HINT: "slower or faster", "plus lent ou plus vite";
    SPAN: "Part", "Extrait";
    SPAN_HINT: "a part of the movement", "une partie du mouvement";
    SPAN_FROM: "from", "à partir de";
    SPAN_TO: "to", "jusqu’à";
    TRIM: "Trim", "Rogner";
    TRIM_HINT: "without rest and odd first and last frames", "sans repos ni images fausses au début et à la fin";
    INDICATE: "Direct", "Diriger";
    INDICATE_HINT: "between other places, as a directional verb", "entre d’autres lieux, comme un verbe directionnel";
    NONMANUAL: "Face and head", "Visage et tête";
    NONMANUAL_HINT: "head and face of another sign", "tête et visage d’un autre signe";
    HAND: "Hand", "Main";
    RIGHT_HAND: "right hand", "main droite";
    LEFT_HAND: "left hand", "main gauche";
    BOTH_HANDS: "both hands", "deux mains";
    DOMINANT_HAND: "dominant hand", "main dominante";
    WEAK_HAND: "weak hand", "main dominée";
    UNIT: "Unit", "Unité";
    OF_ARM: "% of the arm", "% du bras";
    VIA: "Transition", "Transition";
    COURSE: "Course", "Allure";
    COURSE_USUAL: "usual", "habituelle";
    COURSE_SLERP: "slerp", "slerp";
    COURSE_COSINE: "cosine", "cosinus";
    COURSE_SIGMOID: "sigmoid", "sigmoïde";
    COURSE_JERK: "minimum jerk", "jerk minimal";
    COURSE_LEARNED: "learned", "apprise";
    LASTS: "time", "durée";
    HOLD: "hold", "tenue";
    LEFT: "left", "gauche";
    RIGHT: "right", "droite";
    UP: "up", "haut";
    DOWN: "down", "bas";
    FORWARD: "forward", "avant";
    BACK: "back", "arrière";
    TO_THE_LEFT: "left", "gauche";
    UPWARDS: "up", "haut";
    IN_FRONT: "forward", "avant";
    ABOVE_FLOOR: "height", "hauteur";
    SPOT_ME: "me", "moi";
    SPOT_YOU: "you", "toi";
    SPOT_TOWARDS: "direction", "direction";
    SPOT_VALUE: "named place", "lieu nommé";
    SPOT_POINT: "point", "point";
    SPOT_FROM: "from", "de";
    SPOT_TO: "to", "à";
    HANDSHAPE: "Handshape", "Configuration";
    HANDSHAPE_WEAK: "Handshape of the weak hand", "Configuration de la main dominée";
    HANDSHAPE_HINT: "U, 5, beak…", "U, 5, beak…";
    PLACE_NAME: "Place", "Emplacement";
    PLACE_HINT: "chin, chest…", "chin, chest…";
    ON_BODY: "Body of", "Corps de";
    ANY_BODY: "anybody", "n’importe qui";
    WHERE_FROM: "Shape from", "Forme prise de";
    CHOICE_VALUE: "value", "valeur";
    CHOICE_BEST: "best of a query", "meilleur d’une requête";
    CHOICE_KEEP: "as it is", "telle quelle";
    FROM_SIGN: "from sign", "du signe";
    ANOTHER_SHAPE: "+ shape", "+ forme";
    ANOTHER_SHAPE_TIP: "One for each shape that the sign holds in turn", "Une pour chaque forme que le signe tient tour à tour";
    WHERE_TO: "Where to", "Vers où";
    GOAL_BY: "moved by", "déplacé de";
    GOAL_NEAR: "as in sign", "comme dans le signe";
    WITH: "with", "avec";
    WRIST: "wrist", "poignet";
    THUMB: "thumb tip", "bout du pouce";
    INDEX: "index tip", "bout de l’index";
    MIDDLE: "middle tip", "bout du majeur";
    RING: "ring tip", "bout de l’annulaire";
    LITTLE: "little tip", "bout de l’auriculaire";
    PALM: "palm", "paume";
    FINGERS: "fingers", "doigts";
    TURN: "Turn", "Rotation";
    ABOUT: "about", "autour de";
    ADD_TURN: "+ turn", "+ rotation";
    COPIED: "copied from the", "copié de la";
    SIZE: "Size", "Ampleur";
    TIMES: "How often", "Combien de fois";
    SMALLER: "size", "taille";
    FASTER: "tempo", "tempo";
    GAP: "gap", "pause";
    PACE: "Pace", "Allure";
    PACE_TIMES: "times as long", "fois plus long";
    PACE_TO: "lasting", "d’une durée de";
    ANOTHER_PHASE: "+ phase", "+ phase";
    ANOTHER_PHASE_TIP: "One for each phase of the sign in turn", "Une pour chaque phase du signe";
    LEG: "Way", "Chemin";
    IN_TIME: "in", "en";
    DRAW_ON_STAGE: "Draw on the stage", "Dessiner sur la scène";
    DRAW_ON_STAGE_HINT: "The next drag on the stage draws the path of the hand, as it is seen there", "Le prochain glissement sur la scène dessine le trajet de la main, tel qu’on l’y voit";
    CURVE: "Curve through {n} points", "Courbe par {n} points";
    CURVE_HINT: "Pull it on the stage, at a point or between two; a right click removes a point.", "Tirez-la sur la scène, à un point ou entre deux ; un clic droit enlève un point.";
    COURSE_POINT: "Point {n} of the path", "Point {n} du trajet";
    COURSE_LINE: "Path of the hand", "Trajet de la main";
    ADD_LEG: "+ way", "+ chemin";
    BOARD: "Board", "Tableau";
    BOARD_FRONT: "seen from the front", "vu de face";
    BOARD_ABOVE: "seen from above", "vu d’en haut";
    BOARD_SIDE: "seen from the side", "vu de côté";
    BOARD_DRAW: "Draw the path here", "Dessinez le trajet ici";
    NEEDS_CARD: "Choose a card of the recipe first.", "Choisissez d’abord une carte de la recette.";
}

/// The title and the description of each operator, by its name.
pub(crate) const OPERATORS: [(&str, super::Text, super::Text); 14] = [
    ("configure", CONFIGURE, CONFIGURE_HINT),
    ("place", PLACE, PLACE_DOES),
    ("orient", ORIENT, ORIENT_HINT),
    ("travel", TRAVEL, TRAVEL_HINT),
    ("amplify", AMPLIFY, AMPLIFY_HINT),
    ("repeat", REPEAT, REPEAT_HINT),
    ("reverse", REVERSE, REVERSE_HINT),
    ("swap", SWAP, SWAP_HINT),
    ("mirror", MIRROR, MIRROR_HINT),
    ("retime", RETIME, RETIME_HINT),
    ("span", SPAN, SPAN_HINT),
    ("trim", TRIM, TRIM_HINT),
    ("indicate", INDICATE, INDICATE_HINT),
    ("nonmanual", NONMANUAL, NONMANUAL_HINT),
];

/// The captions of settings, by the names that operators give them.
pub(crate) const SETTINGS: [(&str, super::Text); 9] = [
    ("copied", COPIED),
    ("from-sign", FROM_SIGN),
    ("from-time", SPAN_FROM),
    ("gap", GAP),
    ("scale", SMALLER),
    ("size", SIZE),
    ("tempo", FASTER),
    ("times", TIMES),
    ("to-time", SPAN_TO),
];
