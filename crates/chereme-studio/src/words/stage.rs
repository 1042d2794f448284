//! The stage.

texts! {
    TITLE: "Stage", "Scène";
    EMPTY: "Nothing is here yet: take in files or a folder, or drop them on the window.", "Il n’y a encore rien ici : importez des fichiers ou un dossier, ou déposez-les sur la fenêtre.";
    NO_RECORDING: "Choose a recording to see it here.", "Choisissez un enregistrement pour le voir ici.";
    ONLY_SIGNS: "There are no recordings here, but signs; they are found in the search.", "Il n’y a pas d’enregistrements ici, mais des signes ; la recherche les trouve.";
    TO_SIGNS: "To the search", "Vers la recherche";
    NO_MOVEMENT: "This recording holds no movement. Import the motion file of the same name.", "Cet enregistrement ne contient pas de mouvement. Importez le fichier de mouvement du même nom.";
    LOADING: "Loading the movement…", "Chargement du mouvement…";
    NO_FINGERS: "This skeleton has no fingers: its hands are mittens.", "Ce squelette n’a pas de doigts : les mains sont des moufles.";
    COMING: "Loading what is here…", "Chargement de ce passage…";
    NO_MORE: "no movement after {time}", "pas de mouvement après {time}";
    FRAME_OF: "frame {n} of {all}", "image {n} sur {all}";
    SPLIT_1: "One view", "Une vue";
    SPLIT_2: "Two views", "Deux vues";
    SPLIT_4: "Four views", "Quatre vues";
    TRAILS: "Trails", "Traces";
    TRAILS_HINT: "Ways of wrists and fingertips, past and to come", "Trajets des poignets et du bout des doigts, passés et à venir";
    REACH: "Length of the trails in seconds", "Longueur des traces en secondes";
    GHOSTS: "Ghosts", "Fantômes";
    GHOSTS_HINT: "Moments before (blue) and after (orange)", "Instants d’avant (bleu) et d’après (orange)";
    PLACES: "Places", "Lieux";
    PLACES_HINT: "Landmarks and zones of placement; click one to choose it", "Repères et zones d’emplacement ; cliquez pour en choisir une";
    GRID: "Grid", "Grille";
    GRID_HINT: "Signing space in squares of 10 cm", "Espace de signation en carrés de 10 cm";
    BESIDE: "Beside", "À côté";
    OVER: "Over", "Dessus";
    ALONE: "Alone", "Seul";
    COMPARE: "Compare", "Comparer";
    ORIGINAL: "Original", "Original";
    NO_ORIGINAL: "No original: {made}", "Pas d’original : {made}";
    MADE_OF: "Made: {name}", "Composé : {name}";
    BACK: "Back to the recording", "Retour à l’enregistrement";
    PUT_AWAY: "Put away", "Ranger";
    FIGURE: "The signer", "La personne qui signe";
    PLAY: "Play", "Lire";
    PAUSE: "Pause", "Pause";
    LITTLE_NOTHING: "no movement", "sans mouvement";
    SPEED: "Speed", "Vitesse";
    VIEW: "View", "Vue";
    MORE_TOOLS: "Show…", "Afficher…";
    TIME: "Time", "Temps";
    LOOP: "Loop", "Boucle";
    HANDLE: "Move: {hand}", "Déplacer : {hand}";
    HANDLE_LETTERS: "LUF", "GHA";
    HANDLE_HINT: "Drag, or an end to go along it (Ctrl: whole centimetres); arrow keys, Page Up and Page Down, with Shift 5 cm; Escape takes it back", "Faites glisser, ou un bout pour aller dans son sens (Ctrl : centimètres entiers) ; flèches, Page préc. et suiv., avec Maj 5 cm ; Échap revient en arrière";
}
