//! Texts of the timeline.

use chereme_corpus::TierRole;

use super::Text;

texts! {
    NO_PROPOSAL: "There is no proposal here. {value.propose} reads handshapes, places, movements and orientations from the movement.", "Il n’y a pas de proposition ici. {value.propose} lit configurations, emplacements, mouvements et orientations dans le mouvement.";
    DETECT_TITLE: "Propose with a detector", "Proposer avec un détecteur";
    DETECT_SIGN: "Proposals for the selected sign, on tiers of their own:", "Propositions pour le signe sélectionné, sur des acteurs à part :";
    DETECT_SPAN: "Proposals for the selected time, on tiers of their own:", "Propositions pour le temps sélectionné, sur des acteurs à part :";
    DETECT_RECORDING: "Proposals for the whole recording, on tiers of their own:", "Propositions pour tout l’enregistrement, sur des acteurs à part :";
    TITLE: "Timeline", "Ligne de temps";
    EMPTY: "This recording has no tiers yet.", "Cet enregistrement n’a pas encore d’acteurs.";
    NO_RECORDINGS: "This corpus has no recordings, and so no tiers. Its signs are in the library and in the search.", "Ce corpus n’a pas d’enregistrements, donc pas d’acteurs. Ses signes sont dans le fonds et la recherche.";
    OTHER_ON_STAGE: "The stage shows {made}; these are the tiers of {recording}.", "La scène montre {made} ; voici les acteurs de {recording}.";
    NO_RECORDING: "Choose a recording to see its tiers.", "Choisissez un enregistrement pour voir ses acteurs.";
    TIER: "Tier {name}", "Acteur {name}";
    RULER: "Ruler", "Règle";
    UNSET: "unset", "non renseigné";
    NOT_APPLICABLE: "n/a", "sans objet";
    UNCLEAR: "unclear", "incertain";
    SELECTED: "Selected: {start} to {end}", "Sélection : {start} à {end}";
    OVERVIEW: "Overview: {start} to {end} is seen", "Vue d’ensemble : on voit de {start} à {end}";
    LANE: "Lane of {name}", "Piste de {name}";
    FOLD: "Fold {name}", "Replier {name}";
    UNFOLD: "Unfold {name}", "Déplier {name}";
    NORMAL: "Normal", "Normal";
    BULLDOZER: "Bulldozer", "Bulldozer";
    SHIFT: "Shift", "Décaler";
    SNAPS_TO: "Snap to:", "Caler sur :";
    SNAP: "Snap", "Caler";
    FRAMES: "Frames", "Images";
    BOUNDARIES: "Boundaries", "Limites";
    MINIMA: "Speed minima", "Minima de vitesse";
    LANES: "Lanes", "Pistes";
    NO_LANES: "Lanes: no movement", "Pistes : pas de mouvement";
    LANE_SPEED: "Wrist speed", "Vitesse du poignet";
    LANE_APERTURE: "Aperture", "Ouverture";
    LANE_PALM: "Palm", "Paume";
    LANE_DISTANCE: "Hand distance", "Distance des mains";
    LANE_FACE: "Face and trunk", "Visage et tronc";
    NO_FACE: "No curves of the face are stored here; signs generated from notation have them.", "Pas de courbes du visage ici ; les signes générés d’une notation en ont.";
    TIERS: "Tiers", "Acteurs";
    TIERS_HIDDEN: "Tiers, {n} hidden", "Acteurs, {n} masqués";
    SELECTED_COUNT: "{n} selected", "{n} sélectionnées";
    VALUE_ON: "Value on {tier}", "Valeur sur {tier}";
    VALUE: "Value {value}", "Valeur {value}";
    BY_PICTURE: "By picture", "En image";
    BY_TEXT: "By typing", "Au clavier";
    NO_PICTURES: "The values of this tier have no pictures.", "Les valeurs de cet acteur n’ont pas d’images.";
    NO_SUCH_VALUE: "The tier has no such value.", "L’acteur n’a pas cette valeur.";
    NEW_VALUE: "Enter, or a click elsewhere, keeps what you typed.", "Entrée, ou un clic ailleurs, garde ce que vous avez écrit.";
    COPY_TITLE: "Copy to which tier?", "Copier vers quel acteur ?";
    MOVE_TITLE: "Move to which tier?", "Déplacer vers quel acteur ?";
    FILTER_TIERS: "Name of a tier", "Nom d’un acteur";
    NEEDS_TIER: "Add a tier first: Tier menu.", "Ajoutez d’abord un acteur : menu Acteur.";
    NO_ROOM: "There is an annotation already. Select a time that is free.", "Il y a déjà une annotation. Sélectionnez un temps libre.";
    NO_ROOM_BELOW: "This tier depends on another: select a time inside an annotation of that tier that is free here.", "Cet acteur dépend d’un autre : sélectionnez un temps libre à l’intérieur d’une de ses annotations.";
    NO_TIMES: "Annotations of this tier have no times of their own; change the parent annotation.", "Les annotations de cet acteur n’ont pas de temps propre ; modifiez l’annotation parente.";
    BLOCKED: "It cannot go further: a neighbour or the end is in the way.", "Impossible d’aller plus loin : un voisin ou la fin l’empêche.";
    HAS_BELOW: "Other annotations depend on it, so it cannot leave its tier. Copy it instead.", "D’autres annotations en dépendent ; elle ne peut pas quitter son acteur. Copiez-la plutôt.";
    NO_DIGIT: "No value of this tier has that digit yet.", "Aucune valeur de cet acteur n’a encore ce chiffre.";
    NO_NEXT: "There is no next annotation on this tier to merge with.", "Il n’y a pas d’annotation suivante à fusionner sur cet acteur.";
    SPLIT_INSIDE: "Put the playhead inside the annotation first.", "Placez d’abord le curseur dans l’annotation.";
    DRAFT_BACK: "Your unfinished text is back: Enter keeps it, Escape drops it.", "Ce que vous écriviez est revenu : Entrée le garde, Échap l’abandonne.";
    DRAFT_LOST: "Your unfinished text has no place any more: “{text}”", "Ce que vous écriviez n’a plus de place : « {text} »";
    DRAFT_LOST_REMEDY: "Its annotation or tier is gone. Type it elsewhere, or undo what removed it.", "Son annotation ou son acteur n’existe plus. Écrivez-le ailleurs, ou annulez ce qui l’a supprimé.";
    TO_LEFT: "left", "gauche";
    TO_RIGHT: "right", "droite";
    TO_UP: "up", "haut";
    TO_DOWN: "down", "bas";
    TO_FRONT: "forward", "avant";
    TO_BACK: "back", "arrière";
    RIGHT_SHORT: "R", "D";
    LEFT_SHORT: "L", "G";
    NO_MOVEMENT: "no movement", "pas de mouvement";
    MEASURING: "measuring…", "mesure en cours…";
    ADD_TITLE: "Add a tier", "Ajouter un acteur";
    TIERS_LIKE: "Tiers as in…", "Acteurs comme dans…";
    USUAL_ARE: "Gloss, translation, handshape, placement, movement and orientation of either hand, mouth, brows, head", "Glose, traduction, configuration, emplacement, mouvement et orientation de chaque main, bouche, sourcils, tête";
    COPY_TIER_TITLE: "Copy the tier", "Copier l’acteur";
    COPY_TIER_NAME: "{name} copy", "{name} copie";
    COPIED_WHAT: "With", "Avec";
    COPIED_ALL: "all annotations", "toutes les annotations";
    COPIED_TIMES: "annotations without values", "les annotations sans valeurs";
    COPIED_NOTHING: "no annotations", "aucune annotation";
    COPIED_HOLDING: "annotations that contain:", "les annotations qui contiennent :";
    COPIED_TEXT: "Text they contain", "Texte contenu";
    COPY: "Copy", "Copier";
    SORTED_ALREADY: "The tiers are in this order already.", "Les acteurs sont déjà dans cet ordre.";
    NONE_EMPTY: "Every tier that is shown has annotations.", "Tous les acteurs affichés ont des annotations.";
    CHANGE_TITLE: "Change the tier", "Modifier l’acteur";
    REMOVE_TITLE: "Remove the tier?", "Supprimer l’acteur ?";
    REMOVE_ABOUT: "Removes {name}, with dependent tiers: {tiers}, and annotations: {n}. Undo restores them.", "Supprime {name}, avec des acteurs dépendants : {tiers}, et des annotations : {n}. Annuler les rétablit.";
    ADD: "Add", "Ajouter";
    CHANGE: "Change", "Modifier";
    REMOVE: "Remove", "Supprimer";
    TIER_NAME: "Name of the tier", "Nom de l’acteur";
    TIER_ROLE: "What it says", "Ce qu’il dit";
    TIER_HAND: "Hand", "Main";
    TIER_PARENT: "Below", "Dépend de";
    TIER_HOW: "How", "Comment";
    HOW_FILLED: "fills it without gaps", "la remplit sans trous";
    HOW_WITHIN: "within its time", "dans son temps";
    HOW_LISTED: "in order, without times", "en ordre, sans temps";
    HOW_ONE: "one for each, its time", "une pour chacune, son temps";
    ROLE_GLOSS: "gloss", "glose";
    ROLE_TRANSLATION: "translation", "traduction";
    ROLE_COMMENT: "comment", "commentaire";
    ROLE_FREE: "anything", "autre";
    HAND_NONE: "none", "aucune";
    HAND_RIGHT: "right", "droite";
    HAND_LEFT: "left", "gauche";
    HAND_DOMINANT: "dominant", "dominante";
    HAND_WEAK: "weak", "dominée";
    HAND_BOTH: "both", "les deux";
    PARENT_NONE: "no other tier", "aucun autre acteur";
    COPIED: "Annotations copied: {n}", "Annotations copiées : {n}";
    TIME_COPIED: "Copied: {time}", "Copié : {time}";
    NOTHING_TO_PASTE: "Nothing was copied: Ctrl+C copies annotations, and a spreadsheet’s cells can be pasted.", "Rien n’a été copié : Ctrl+C copie des annotations, et les cellules d’un tableur se collent aussi.";
    PASTE_TITLE: "Some of it does not fit", "Une partie ne convient pas";
    PASTE_REST: "Paste the others: {n}", "Coller les autres : {n}";
    PASTE_ABOUT: "Nothing is pasted yet. Lines that do not fit:", "Rien n’est encore collé. Lignes qui ne conviennent pas :";
    PASTE_LINE: "Line {n}: {what}", "Ligne {n} : {what}";
    PASTE_TAKEN: "There is an annotation already at that time. Paste at the playhead instead.", "Il y a déjà une annotation à ce temps. Collez plutôt au curseur.";
    ONE_TIER: "Select annotations of one tier only, or another tier as the target.", "Sélectionnez des annotations d’un seul acteur, ou un autre acteur comme destination.";
    PASTE_MORE: "and {n} more", "et {n} autres";
    ODD_TIME: "“{text}” is no time: write 1.5, 0:01.500 or f12", "« {text} » n’est pas un temps : écrivez 1.5, 0:01.500 ou f12";
    ODD_ROW: "no start and end in “{text}”", "ni début ni fin dans « {text} »";
    ODD_ENDS: "it ends at {text}, which is not after its start", "elle finit à {text}, ce qui n’est pas après son début";
    ODD_TIER: "no tier {text} here", "pas d’acteur {text} ici";
    ODD_TAKEN: "there is an annotation already at {text}", "il y a déjà une annotation à {text}";
    ODD_VALUE: "“{text}” is no value of its tier", "« {text} » n’est pas une valeur de son acteur";
    ODD_OUTSIDE: "the annotation that begins at {text} is not within the recording", "l’annotation qui commence à {text} n’est pas dans l’enregistrement";
    ODD_PARENT: "no annotation of the parent tier contains {text}", "aucune annotation de l’acteur parent ne contient {text}";
    ODD_LEFT: "no annotation is left for “{text}”", "il ne reste pas d’annotation pour « {text} »";
    NO_ROOM_BESIDE: "There is no room: another annotation, or the end, follows at once.", "Il n’y a pas de place : une autre annotation, ou la fin, suit aussitôt.";
    ONLY_ONE: "This tier has one annotation for each of the parent tier.", "Cet acteur a une seule annotation pour chacune de l’acteur parent.";
    NO_PREVIOUS: "There is no previous annotation on this tier to merge with.", "Il n’y a pas d’annotation précédente à fusionner sur cet acteur.";
    NOTHING_BELOW: "No tier depends on this one, or each dependent tier has its annotation.", "Aucun acteur ne dépend de celui-ci, ou chaque acteur dépendant a son annotation.";
    NO_NEIGHBOUR: "There is no free time up to a neighbour.", "Il n’y a pas de temps libre jusqu’à un voisin.";
    LAST_OF_TIER: "No further annotation on this tier. With Loop on, it starts again from the other end.", "Pas d’autre annotation sur cet acteur. Avec la boucle, on reprend à l’autre bout.";
    MENU_NEW: "New", "Nouvelle";
    MENU_BESIDE: "Split, merge, extend", "Scinder, fusionner, étendre";
    GO_TITLE: "Go to a time", "Aller à un temps";
    GO_FIELD: "Time, or f and a frame", "Temps, ou f et une image";
    GO_THERE: "{time}, frame {frame}", "{time}, image {frame}";
    GO_HOW: "1:23.4 or 83.4 · f512 is a frame · +2 and -0.5 from here · 50%", "1:23.4 ou 83.4 · f512 est une image · +2 et -0.5 d’ici · 50%";
    GO_BEYOND: "The recording ends at {time}.", "L’enregistrement finit à {time}.";
    GO: "Go", "Aller";
    TIER_AT_END: "The tier is the last in that direction.", "L’acteur est le dernier dans ce sens.";
}

/// Returns the name of a tier's role that has no component.
pub(crate) fn role(role: &TierRole) -> Text {
    match role {
        TierRole::Gloss => ROLE_GLOSS,
        TierRole::Translation => ROLE_TRANSLATION,
        TierRole::Comment => ROLE_COMMENT,
        TierRole::Component { .. } | TierRole::Free => ROLE_FREE,
    }
}
