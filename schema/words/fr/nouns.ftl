## Nouns with a number: `noun-` and the English plural.

noun-annotations = { $count ->
    [one] annotation
   *[other] annotations
}
noun-answers = { $count ->
    [one] réponse
   *[other] réponses
}
noun-attributes = { $count ->
    [one] attribut
   *[other] attributs
}
noun-blocks = { $count ->
    [one] bloc
   *[other] blocs
}
noun-changes = { $count ->
    [one] modification
   *[other] modifications
}
noun-columns = { $count ->
    [one] colonne
   *[other] colonnes
}
noun-conflicts = { $count ->
    [one] conflit
   *[other] conflits
}
noun-curves = { $count ->
    [one] courbe
   *[other] courbes
}
noun-edits = { $count ->
    [one] modification
   *[other] modifications
}
noun-files = { $count ->
    [one] fichier
   *[other] fichiers
}
noun-frames = { $count ->
    [one] image
   *[other] images
}
noun-index-documents = { $count ->
    [one] document de l’index
   *[other] documents de l’index
}
noun-inventories = { $count ->
    [one] inventaire
   *[other] inventaires
}
noun-joints = { $count ->
    [one] articulation
   *[other] articulations
}
noun-media = { $count ->
    [one] média
   *[other] médias
}
noun-notations = { $count ->
    [one] notation
   *[other] notations
}
noun-operations = { $count ->
    [one] opération
   *[other] opérations
}
noun-participants = { $count ->
    [one] participant
   *[other] participants
}
noun-pairs-of-frames = { $count ->
    [one] paire d’images
   *[other] paires d’images
}
noun-pairs-of-tiers = { $count ->
    [one] paire d’acteurs
   *[other] paires d’acteurs
}
noun-points = { $count ->
    [one] point
   *[other] points
}
noun-questions = { $count ->
    [one] question
   *[other] questions
}
noun-recipes = { $count ->
    [one] recette
   *[other] recettes
}
noun-recordings = { $count ->
    [one] enregistrement
   *[other] enregistrements
}
noun-rows = { $count ->
    [one] ligne
   *[other] lignes
}
noun-samples = { $count ->
    [one] échantillon
   *[other] échantillons
}
noun-searches = { $count ->
    [one] recherche
   *[other] recherches
}
noun-signers = { $count ->
    [one] signeur
   *[other] signeurs
}
noun-corpora = { $count ->
    [one] corpus
   *[other] corpus
}
noun-lexicons = { $count ->
    [one] lexique
   *[other] lexiques
}
noun-signs = { $count ->
    [one] signe
   *[other] signes
}
noun-skeletons = { $count ->
    [one] squelette
   *[other] squelettes
}
noun-studies = { $count ->
    [one] étude
   *[other] études
}
noun-symbols = { $count ->
    [one] symbole
   *[other] symboles
}
noun-tables = { $count ->
    [one] table
   *[other] tables
}
noun-tiers = { $count ->
    [one] acteur
   *[other] acteurs
}
noun-times = { $count ->
    [one] fois
   *[other] fois
}
noun-tokens = { $count ->
    [one] occurrence
   *[other] occurrences
}
noun-units = { $count ->
    [one] unité
   *[other] unités
}
noun-values = { $count ->
    [one] valeur
   *[other] valeurs
}
noun-tracks = { $count ->
    [one] piste
   *[other] pistes
}
