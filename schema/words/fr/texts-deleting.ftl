## Words about deleted recordings and signs.

texts-deleting-nothing-written = rien n’est écrit ; ceci serait supprimé :
texts-deleting-deleted = supprimé :
texts-deleting-prevented-by = sans --with-dependents ni --keep-dependents, ceci l’empêche :
texts-deleting-kept = ceci reste, avec son propre mouvement :
