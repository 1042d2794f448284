//! Words about deleted recordings and signs.

texts! {
    NOTHING_WRITTEN: "nothing is written; this would be deleted:", "rien n’est écrit ; ceci serait supprimé :";
    DELETED: "deleted:", "supprimé :";
    PREVENTED_BY: "without --with-dependents or --keep-dependents these prevent it:", "sans --with-dependents ni --keep-dependents, ceci l’empêche :";
    KEPT: "these stay, with their own movement:", "ceci reste, avec son propre mouvement :";
}
