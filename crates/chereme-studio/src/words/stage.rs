//! The stage.

texts! {
    TITLE: "Stage", "Scène";
    NO_RECORDING: "Choose a recording to see it here.", "Choisissez un enregistrement pour le voir ici.";
    NO_MOVEMENT: "This recording holds no movement. Import the motion file of the same name.", "Cet enregistrement ne contient pas de mouvement. Importez le fichier de mouvement du même nom.";
    LOADING: "Loading the movement…", "Chargement du mouvement…";
    FIGURE: "The signer", "La personne qui signe";
    PLAY: "Play", "Lire";
    PAUSE: "Pause", "Pause";
    LITTLE_NOTHING: "no movement", "sans mouvement";
    SPEED: "Speed", "Vitesse";
    VIEW: "View", "Vue";
    TIME: "Time", "Temps";
    LOOP: "Loop", "Boucle";
}
