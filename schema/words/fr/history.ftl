## The history: what each operation did. `history-` and the name of the operation; its variable parts are its fields.
## The names of people's things (files, tiers, glosses, recordings) stand in the sentence as they are.

history-import = Importé : { $count ->
    [0] rien de nouveau
    [1] { $first }
   *[other] { $count } fichiers, de { $first } à { $last }
}
history-recombine = { $gloss } composé : { $recipe }
history-recombine-again = { $gloss } refait : { $recipe }
history-annotate = { $changes } dans { $recordings ->
    [1] { $recording }
   *[other] { $recordings } enregistrements
}
history-propose = Proposé d’après le mouvement : { $changes } dans { $recordings ->
    [1] { $recording }
   *[other] { $recordings } enregistrements
}
history-accept = Valeurs proposées acceptées : { $count }, dans { $recordings ->
    [1] { $recording }
   *[other] { $recordings } enregistrements
}
history-reject = Valeurs proposées rejetées : { $count }, dans { $recordings ->
    [1] { $recording }
   *[other] { $recordings } enregistrements
}
history-adjudicate = Tranché sur l’acteur { $tier }
history-prefer-annotator = Annotateur préféré : { $annotator }
history-add-tier = Acteur { $tier } ajouté à { $recording }
history-change-tier = Acteur { $tier } de { $recording } modifié
history-remove-tier = Acteurs supprimés de { $recording } : { $tiers }, avec { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-add-tiers = { $count ->
    [one] { $count } acteur ajouté à { $recording }
   *[other] { $count } acteurs ajoutés à { $recording }
}
history-copy-tier = Acteur { $tier } de { $recording } copié sous le nom { $copy }, avec { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-work-on-tiers = { $deed ->
    [added] Acteurs ajoutés : { $tiers }
    [copied] Acteurs copiés : { $tiers }
    [removed] Acteurs supprimés : { $tiers }
    [shifted] Acteurs déplacés dans le temps : { $tiers }
   *[changed] Acteurs modifiés : { $tiers }
}, dans { $recordings ->
    [one] { $recordings } enregistrement
   *[other] { $recordings } enregistrements
}
history-order-tiers = Acteurs remis en ordre : { $recording }
history-add-value = Valeur { $value } ajoutée à { $inventory }
history-merge-values = Valeur { $value } fusionnée avec { $into } dans { $inventory }
history-equate-values = Les valeurs { $value } et { $other } n’en font qu’une
history-part-value = { $value } ne fait plus qu’une avec aucune autre valeur
history-change-recording = Enregistrement modifié : { $recording }
history-change-signer = Signeur modifié : { $signer }
history-change-sign = Signe modifié : { $sign }
history-rename-sign = Signe { $former } renommé en { $sign }, dans { $annotations ->
    [one] { $annotations } annotation
   *[other] { $annotations } annotations
}
history-set-citation = Forme de citation : token:{ $token } pour { $gloss }
history-change-person = Personne modifiée : { $person }
history-unite-people = { $names } et { $person } ne font plus qu’une seule personne
history-unite-lexicons = Lexiques réunis : { $names } dans { $lexicon }
history-relate-signs = Relations de signes ({ $relation }) : { $count }
history-remove-person = Personne supprimée : { $person }
history-import-people = { $people ->
    [one] une personne lue
   *[other] { $people } personnes lues
} dans { $file }
history-change-lexicon = Lexique modifié : { $lexicon }
history-remove-lexicon = Lexique supprimé : { $lexicon }
history-measure-signs = Mesures de { $signs ->
    [one] { $signs } signe
   *[other] { $signs } signes
} enregistrées
history-link-lexicon = Gloses de { $recordings ->
    [one] { $recordings } enregistrement
   *[other] { $recordings } enregistrements
} cherchées dans le lexique { $lexicon }
history-unlink-lexicon = Gloses de { $recordings ->
    [one] { $recordings } enregistrement
   *[other] { $recordings } enregistrements
} cherchées dans aucun lexique
history-transcribe = Transcrit : token:{ $token } { $gloss }
history-add-tracks = Pistes ajoutées à { $recording } : { $tracks }
history-change-track = Piste { $track } de { $recording } { $change ->
    [moved] : commence à { $seconds } s
    [renamed] renommée en { $to }
   *[removed] supprimée
}
history-change-media = Média modifié : { $recording }
history-fit-markers = Squelette ajusté aux marqueurs { $markers } de { $recording }, { $millimetres } mm
# One person of several whose markers are in one track.
history-fit-markers-of-person = Squelette ajusté aux marqueurs { $markers } de { $subject } dans { $recording }, { $millimetres } mm
history-restore-markers = { $places ->
    [one] { $places } position de marqueur perdu calculée
   *[other] { $places } positions de marqueurs perdus calculées
} dans { $recordings ->
    [one] { $recordings } enregistrement
   *[other] { $recordings } enregistrements
}
history-fit-face = Visage { $track } de { $recording } ajusté à { $signer }
history-cue-from-dictionary = { $gloss } codé d’après le dictionnaire, avec { $movements ->
    [one] { $movements } mouvement
   *[other] { $movements } mouvements
}
history-find-targets = Cibles de { $keys ->
    [one] { $keys } clé
   *[other] { $keys } clés
} trouvées dans { $recordings ->
    [one] { $recordings } enregistrement
   *[other] { $recordings } enregistrements
}
history-keep-search = Recherche enregistrée : { $names }
history-rename-search = Recherche { $from } renommée en { $to }
history-forget-search = Recherche enregistrée supprimée : { $name }
history-delete = Supprimé : { $names }
history-delete-undone = Rétabli : { $names }
history-plan-study = Étude préparée : { $study }
history-import-answers = Réponses importées : { $study }, { $participants ->
    [one] { $participants } participant
   *[other] { $participants } participants
}
history-forget-participant = Participant d’une étude supprimé : { $study }
history-delete-study = Étude supprimée : { $study }
history-change-consent = Consentement modifié : { $names }
history-merge = Fusionné { $from } : { $added } ajoutés, { $changed } modifiés, { $removed } supprimés, { $conflicts ->
    [one] { $conflicts } conflit
   *[other] { $conflicts } conflits
}
# The decision is for the state of this corpus, for that of the other one, or for both of them.
history-decide = Conflits décidés : { $conflicts } : { $decision ->
    [mine] le mien
    [theirs] le leur
   *[both] les deux
}
history-mend = Occurrences calculées à nouveau
# Operations of an earlier program, of which only its English sentence is known.
history-summary-only = { $name } : { $summary }
history-summary-only-import = Importé : { $summary }
history-summary-only-recombine = Composé : { $summary }
history-summary-only-recombine-again = Refait : { $summary }
history-summary-only-annotate = Annotations : { $summary }
history-summary-only-propose = Proposé d’après le mouvement : { $summary }
history-summary-only-accept = Valeurs proposées acceptées : { $summary }
history-summary-only-add-tier = Acteur ajouté : { $summary }
history-summary-only-change-tier = Acteur modifié : { $summary }
history-summary-only-remove-tier = Acteur supprimé : { $summary }
history-summary-only-add-tiers = Acteurs ajoutés : { $summary }
history-summary-only-copy-tier = Acteur copié : { $summary }
history-summary-only-add-value = Valeur ajoutée : { $summary }
history-summary-only-merge-values = Valeurs fusionnées : { $summary }
history-summary-only-equate-values = Valeurs réunies : { $summary }
history-summary-only-part-value = Valeur séparée des autres : { $summary }
history-summary-only-rename-search = Recherche renommée : { $summary }
history-summary-only-change-sign = Signe modifié : { $summary }
history-summary-only-set-citation = Forme de citation : { $summary }
history-summary-only-change-person = Personne modifiée : { $summary }
history-summary-only-unite-people = Personnes réunies : { $summary }
history-summary-only-unite-lexicons = Lexiques réunis : { $summary }
history-summary-only-relate-signs = Relations de signes : { $summary }
history-summary-only-remove-person = Personne supprimée : { $summary }
history-summary-only-import-people = Personnes lues dans un tableau : { $summary }
history-summary-only-change-lexicon = Lexique modifié : { $summary }
history-summary-only-remove-lexicon = Lexique supprimé : { $summary }
history-summary-only-measure-signs = Mesures enregistrées : { $summary }
history-summary-only-link-lexicon = Gloses cherchées dans un lexique : { $summary }
history-summary-only-unlink-lexicon = Gloses cherchées dans aucun lexique : { $summary }
history-summary-only-transcribe = Transcrit : { $summary }
history-summary-only-add-tracks = Pistes ajoutées : { $summary }
history-summary-only-change-track = Piste modifiée : { $summary }
history-summary-only-import-answers = Réponses importées : { $summary }
history-summary-only-merge = Fusionné : { $summary }
history-summary-only-decide = Décidé : { $summary }
history-undone = Annulé : { $what }

## Changes of annotations; several of them stand in a list.

history-annotations-added = { $count ->
    [one] { $count } annotation ajoutée
   *[other] { $count } annotations ajoutées
}
history-annotations-changed = { $count ->
    [one] { $count } annotation modifiée
   *[other] { $count } annotations modifiées
}
history-annotations-removed = { $count ->
    [one] { $count } annotation supprimée
   *[other] { $count } annotations supprimées
}
# The undo of a removal.
history-annotations-removed-undone = { $count ->
    [one] { $count } annotation rétablie
   *[other] { $count } annotations rétablies
}
history-annotations-moved = { $count ->
    [one] { $count } annotation déplacée
   *[other] { $count } annotations déplacées
}
history-annotations-merged = { $count ->
    [one] { $count } annotation fusionnée
   *[other] { $count } annotations fusionnées
}
history-annotations-split = { $count ->
    [one] { $count } annotation coupée
   *[other] { $count } annotations coupées
}
history-annotations-revalued = { $count ->
    [one] { $count } annotation dit autre chose
   *[other] { $count } annotations disent autre chose
}
history-annotations-valued = { $count } { $of ->
    [handshape] { $count ->
        [one] configuration changée
       *[other] configurations changées
    }
    [placement] { $count ->
        [one] emplacement changé
       *[other] emplacements changés
    }
    [movement] { $count ->
        [one] mouvement changé
       *[other] mouvements changés
    }
    [orientation] { $count ->
        [one] orientation changée
       *[other] orientations changées
    }
    [gloss] { $count ->
        [one] glose changée
       *[other] gloses changées
    }
   *[annotation] { $count ->
        [one] annotation changée
       *[other] annotations changées
    }
} en { $value }

## Changes of rows, in the details of an operation: what they are of, their name, and their place.

history-row-added = { $what ->
    [annotation] annotation { $name } ajoutée
    [tier] acteur { $name } ajouté
    [recording] enregistrement { $name } ajouté
    [signer] signeur { $name } ajouté
    [sign] signe { $name } ajouté
    [translation] traduction { $name } ajoutée
    [inventory] inventaire { $name } ajouté
    [value] valeur { $name } ajoutée
    [search] recherche { $name } ajoutée
    [study] étude { $name } ajoutée
    [participant] participant { $name } ajouté
    [recipe] recette { $name } ajoutée
   *[notation] notation { $name } ajoutée
}{ $place }{ $span }
history-row-removed = { $what ->
    [annotation] annotation { $name } supprimée
    [tier] acteur { $name } supprimé
    [recording] enregistrement { $name } supprimé
    [signer] signeur { $name } supprimé
    [sign] signe { $name } supprimé
    [translation] traduction { $name } supprimée
    [inventory] inventaire { $name } supprimé
    [value] valeur { $name } supprimée
    [search] recherche { $name } supprimée
    [study] étude { $name } supprimée
    [participant] participant { $name } supprimé
    [recipe] recette { $name } supprimée
   *[notation] notation { $name } supprimée
}{ $place }{ $span }
history-row-changed = { $what ->
    [annotation] annotation { $name }
    [tier] acteur { $name }
    [recording] enregistrement { $name }
    [signer] signeur { $name }
    [sign] signe { $name }
    [translation] traduction { $name }
    [inventory] inventaire { $name }
    [value] valeur { $name }
    [search] recherche { $name }
    [study] étude { $name }
    [participant] participant { $name }
    [recipe] recette { $name }
   *[notation] notation { $name }
}{ $place } : { $fields }
history-row-place = { $what ->
    [value] { " dans " }
   *[other] { " sur " }
}{ $name }
history-row-place-of = { " sur " }{ $name } de { $whole }
history-row-span = { ", de " }{ $start } à { $end }
history-row-fields = { $one } ; { $other }
history-row-field = { $field ->
    [start] début
    [end] fin
    [value] valeur
    [state] état
    [confidence] certitude
    [origin] origine
    [name] nom
    [gloss] glose
    [notes] remarques
    [licence] licence
    [consent] consentement
    [signer] signeur
    [handedness] main dominante
    [recording] enregistrement
    [tier] acteur
    [parent] parent
    [role] rôle
    [component] composant
    [hand] main
    [participant] participant
    [annotator] annotateur
    [language] langue
    [text] texte
    [query] requête
    [inventory] inventaire
    [duration] durée
   *[other] { $field }
} : { $from } → { $to }
history-row-order = son ordre ou sa forme
history-row-nothing = rien
