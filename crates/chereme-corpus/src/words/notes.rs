//! French forms of the notes on recipe steps, looked up by their English form.

/// Notes in English and French; a form that is contained in another comes after it.
pub(super) const NOTES: &[(&str, &str)] = &[
    (
        "{letter} from {sign} (same signer)",
        "{letter} de {sign} (même signeur)",
    ),
    ("{sign} (same signer)", "{sign} (même signeur)"),
    ("{sign} (another signer)", "{sign} (autre signeur)"),
    (
        "{sign} (its {value} changed)",
        "{sign} (son {value} modifié)",
    ),
    ("right fingers  {from}", "doigts droits  {from}"),
    ("left fingers   {from}", "doigts gauches {from}"),
    ("right arm      {from}", "bras droit     {from}"),
    ("left arm       {from}", "bras gauche    {from}"),
    ("head           {from}", "tête           {from}"),
    ("trunk          {from}", "tronc          {from}"),
    ("legs           {from}", "jambes         {from}"),
    (
        "right {from}–{to}: position {mm} mm, change of velocity {v} m/s, of acceleration {a} m/s²   ({what})",
        "droite {from}–{to} : position {mm} mm, changement de vitesse {v} m/s, d’accélération {a} m/s²   ({what})",
    ),
    (
        "left  {from}–{to}: position {mm} mm, change of velocity {v} m/s, of acceleration {a} m/s²   ({what})",
        "gauche {from}–{to} : position {mm} mm, changement de vitesse {v} m/s, d’accélération {a} m/s²   ({what})",
    ),
    (
        "letters are held for {time} s, the median of {n} in the corpus",
        "les lettres sont tenues {time} s, la médiane de {n} dans le corpus",
    ),
    (
        "letters are held for {time} s: the corpus shows too few to learn from",
        "les lettres sont tenues {time} s : le corpus en montre trop peu pour apprendre",
    ),
    (
        "from letter to letter it takes {time} s, the median of {n} in the corpus",
        "d’une lettre à l’autre il faut {time} s, la médiane de {n} dans le corpus",
    ),
    (
        "from letter to letter it takes {time} s: the corpus shows too few to learn from",
        "d’une lettre à l’autre il faut {time} s : le corpus en montre trop peu pour apprendre",
    ),
    (
        "the right hand stays where it is: the second sign does not use it",
        "la main droite reste où elle est : le second signe ne s’en sert pas",
    ),
    (
        "the left hand stays where it is: the second sign does not use it",
        "la main gauche reste où elle est : le second signe ne s’en sert pas",
    ),
    (
        "right hand: leaves {n} frames before the end, enters at frame {at}, {between} frames between",
        "main droite : part {n} images avant la fin, arrive à l’image {at}, {between} images entre deux",
    ),
    (
        "left hand: leaves {n} frames before the end, enters at frame {at}, {between} frames between",
        "main gauche : part {n} images avant la fin, arrive à l’image {at}, {between} images entre deux",
    ),
    ("right-temple", "tempe droite"),
    ("left-temple", "tempe gauche"),
    ("right-cheek", "joue droite"),
    ("left-cheek", "joue gauche"),
    ("right-index-tip", "bout de l’index droit"),
    ("left-index-tip", "bout de l’index gauche"),
    ("right-thumb-tip", "bout du pouce droit"),
    ("left-thumb-tip", "bout du pouce gauche"),
    ("right-middle-tip", "bout du majeur droit"),
    ("left-middle-tip", "bout du majeur gauche"),
    ("right-palm", "paume droite"),
    ("left-palm", "paume gauche"),
    (
        "the {limb} index finger's line passes {mm} mm beside the target",
        "la ligne de l’index {limb} passe à {mm} mm de la cible",
    ),
    (
        "the second signer's movement is put on the first one's body",
        "le mouvement du second signeur est mis sur le corps du premier",
    ),
    (
        "up to {speed} m/s at {part} between the pieces",
        "jusqu’à {speed} m/s entre les morceaux pour {part}",
    ),
];
