//! French forms of the notes on recipe steps, looked up by their English form.

/// Notes in English and French; a form that is contained in another comes after it.
pub(super) const NOTES: &[(&str, &str)] = &[
    (
        "{value} becomes {other} over {span}, from {origin}",
        "{value} devient {other} sur {span}, d’après {origin}",
    ),
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
    ("(no value)", "(sans valeur)"),
    ("right fingers  {from}", "doigts droits  {from}"),
    ("left fingers   {from}", "doigts gauches {from}"),
    ("right arm      {from}", "bras droit     {from}"),
    ("left arm       {from}", "bras gauche    {from}"),
    ("head           {from}", "tête           {from}"),
    ("trunk          {from}", "tronc          {from}"),
    ("legs           {from}", "jambes         {from}"),
    (
        "right {from}–{to}: position {mm} mm, velocity {v} m/s, acceleration {a} m/s²   ({what})",
        "droite {from}–{to} : position {mm} mm, vitesse {v} m/s, accélération {a} m/s²   ({what})",
    ),
    (
        "left  {from}–{to}: position {mm} mm, velocity {v} m/s, acceleration {a} m/s²   ({what})",
        "gauche {from}–{to} : position {mm} mm, vitesse {v} m/s, accélération {a} m/s²   ({what})",
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
    ("the movement ends at {time}", "le mouvement finit à {time}"),
    ("left out {what}", "laissé de côté : {what}"),
    (
        "the movement has no rest before or after it",
        "le mouvement n’a pas de repos avant ou après",
    ),
    (
        "kept {from} to {to} of {all}: frames {first} to {last}",
        "gardé de {from} à {to} sur {all} : images {first} à {last}",
    ),
    (
        "the {side} hand is turned by {angle}",
        "la main {side} est tournée de {angle}",
    ),
    (
        "the {limb} wrist bends by {angle}, more than wrists can",
        "le poignet {limb} se plie de {angle}, plus qu’un poignet ne peut",
    ),
    (
        "the place is from {origin}",
        "l’emplacement vient de {origin}",
    ),
    (
        "what counts is the contact at {time}, where the {part} was at the {place}",
        "ce qui compte est le contact à {time}, où {part} était à : {place}",
    ),
    (
        "out of reach: the wrist stays {cm} cm short at frame {n}",
        "hors de portée : il manque {cm} cm au poignet à l’image {n}",
    ),
    (
        "out of reach: a wrist stays {cm} cm short",
        "hors de portée : il manque {cm} cm à un poignet",
    ),
    (
        "the collar bone helped in {n} frames, beyond {share} of the arm's length",
        "la clavicule a aidé dans {n} images, au-delà de {share} de la longueur du bras",
    ),
    ("moved {way}", "déplacé : {way}"),
    (
        "the right hand is kept out of head and trunk: moved by up to {rest}",
        "la main droite est tenue hors de la tête et du tronc : déplacée de {rest}",
    ),
    (
        "the left hand is kept out of head and trunk: moved by up to {rest}",
        "la main gauche est tenue hors de la tête et du tronc : déplacée de {rest}",
    ),
    (
        "the right hand is {cm} cm away from the place, so its placement is left open",
        "la main droite est à {cm} cm du lieu, son emplacement reste donc ouvert",
    ),
    (
        "the left hand is {cm} cm away from the place, so its placement is left open",
        "la main gauche est à {cm} cm du lieu, son emplacement reste donc ouvert",
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
    (
        "the place is that of the contact at {time}: the {part} at the mouth",
        "l’emplacement est celui du contact à {time} : {part} à la bouche",
    ),
    (
        "the place is that of the contact at {time}: the {part} at the chin",
        "l’emplacement est celui du contact à {time} : {part} au menton",
    ),
    (
        "the place is that of the contact at {time}: the {part} at the chest",
        "l’emplacement est celui du contact à {time} : {part} à la poitrine",
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
        "{n} frames played backwards",
        "{n} images jouées à l’envers",
    ),
    (
        "{component} {value} is no longer written: it runs the other way",
        "{component} {value} n’est plus dit : il va dans l’autre sens",
    ),
    (
        "{spot} is {cm} cm nearer, as far as the arms reach",
        "{spot} est plus près de {cm} cm, autant que les bras atteignent",
    ),
    (
        "the path of {from} cm became {to} cm",
        "le trajet de {from} cm est devenu {to} cm",
    ),
    (
        "the hands' paths are {share} as large",
        "les trajets des mains font {share} de leur taille",
    ),
    ("nothing to do", "rien à faire"),
    (
        "{times} times, {gap} frames between",
        "{times} fois, {gap} images entre deux",
    ),
    (
        "repetition {n} to {next}: {what}",
        "répétition {n} à {next} : {what}",
    ),
    ("repetition {n}: {what}", "répétition {n} : {what}"),
    (
        "the second signer's movement is put on the first one's body",
        "le mouvement du second signeur est mis sur le corps du premier",
    ),
    ("{from} s became {to} s", "{from} s sont devenus {to} s"),
    (
        "repetition {one} to {next}",
        "de la répétition {one} à {next}",
    ),
];
