//! Texts of the pickers of values.

texts! {
    CHOOSE: "Choose…", "Choisir…";
    FILTER: "Type to find a value", "Taper pour trouver une valeur";
    NONE: "No value fits “{text}”.", "Aucune valeur ne correspond à « {text} ».";
    ENTER: "Enter picks {value}", "Entrée choisit {value}";
    TIP: "{value}\nArrow keys walk, Enter picks, Ctrl and a click shows its details", "{value}\nFlèches pour aller, Entrée pour choisir, Ctrl et un clic pour en savoir tout";
    ON_BODY: "On the body", "Sur le corps";
    IN_SPACE: "In space", "Dans l’espace";
    FROM_FRONT: "From the front", "De face";
    FROM_SIDE: "From the side", "De côté";
    HEAD: "Head", "Tête";
    TRUNK: "Body", "Corps";
    WEAK_HAND: "Weak hand", "Main faible";
    SPACE_FRONT: "As the addressee sees it", "Vu de face";
    SPACE_SIDE: "From the side", "De côté";
    NEAR: "Near", "Près";
    REACH: "Middle", "Milieu";
    FAR: "Far", "Loin";
    POINT_AT: "Point at a place", "Désignez un lieu";
    ZONE: "{value}, on the picture", "{value}, sur l’image";
    AWAY: "Away", "Vers l’avant";
    LEVEL: "Across", "Sans avancer";
    TOWARDS: "Towards", "Vers soi";
    AS_SIGNER: "As the signer sees it", "Vu par la personne qui signe";
    DRAWING: "The body is being drawn…", "Le corps se dessine…";
}
