//! French forms of messages about stored rows, changes, explanations and the window, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const LINES: &[(&str, &str)] = &[
    (
        "no window can be opened: {reason}",
        "aucune fenêtre ne peut s’ouvrir : {reason}",
    ),
    (
        "a display (X11 or Wayland) with OpenGL is needed; on Debian: {command}. Every other command of chereme works without a window",
        "il faut un affichage (X11 ou Wayland) avec OpenGL ; sous Debian : {command}. Toutes les autres commandes de chereme se passent de fenêtre",
    ),
    (
        "a display with OpenGL is needed. Every other command of chereme works without a window",
        "il faut un affichage avec OpenGL. Toutes les autres commandes de chereme se passent de fenêtre",
    ),
    ("there is no track {name}", "il n’y a pas de piste {name}"),
    ("warning: {what}", "attention : {what}"),
    ("note: {what}", "note : {what}"),
    ("error: {what}", "erreur : {what}"),
    ("what to do: {what}", "que faire : {what}"),
    (
        "tier {name}: {role} (before: {old})",
        "acteur {name} : {role} (avant : {old})",
    ),
    (
        "tier {name} at {time}: {old} became {new}, and moved",
        "acteur {name} à {time} : {old} est devenu {new}, et s’est déplacé",
    ),
    (
        "tier {name} at {time}: {old} became {new}",
        "acteur {name} à {time} : {old} est devenu {new}",
    ),
    (
        "tier {name} at {time}: {value} moved from {start}",
        "acteur {name} à {time} : {value}, auparavant à {start}",
    ),
    (
        "tier {name} at {time}: {value} hangs below another",
        "acteur {name} à {time} : {value} dépend d’une autre annotation",
    ),
    (
        "tier {name} at {time}: {value} added",
        "acteur {name} à {time} : {value} ajouté",
    ),
    (
        "tier {name} at {time}: {value} removed",
        "acteur {name} à {time} : {value} supprimé",
    ),
    (
        "tier {name} at {time}: {what}",
        "acteur {name} à {time} : {what}",
    ),
    ("tier {name}: not known", "acteur {name} : inconnu"),
    ("tier {name}: {role}", "acteur {name} : {role}"),
    (
        "added annotation {name} on {tier} of {recording}, {start} to {end}",
        "annotation {name} ajoutée sur {tier} de {recording}, de {start} à {end}",
    ),
    (
        "added tier {name} on {recording}",
        "acteur {name} ajouté sur {recording}",
    ),
    ("added recording {name}", "enregistrement {name} ajouté"),
    ("added signer {name}", "signeur {name} ajouté"),
    ("added sign {name}", "signe {name} ajouté"),
    (
        "added translation {name} on {sign}",
        "traduction {name} ajoutée sur {sign}",
    ),
    ("added inventory {name}", "inventaire {name} ajouté"),
    (
        "added value {name} on {inventory}",
        "valeur {name} ajoutée dans {inventory}",
    ),
    ("added search {name}", "recherche {name} ajoutée"),
    (
        "added recipe {name} on {recording}",
        "recette {name} ajoutée sur {recording}",
    ),
    (
        "added notation {name} on {sign}",
        "notation {name} ajoutée sur {sign}",
    ),
    (
        "removed annotation {name} on {tier} of {recording}, {start} to {end}",
        "annotation {name} supprimée sur {tier} de {recording}, de {start} à {end}",
    ),
    (
        "removed tier {name} on {recording}",
        "acteur {name} supprimé sur {recording}",
    ),
    ("removed recording {name}", "enregistrement {name} supprimé"),
    ("removed signer {name}", "signeur {name} supprimé"),
    ("removed sign {name}", "signe {name} supprimé"),
    (
        "removed translation {name} on {sign}",
        "traduction {name} supprimée sur {sign}",
    ),
    ("removed inventory {name}", "inventaire {name} supprimé"),
    (
        "removed value {name} on {inventory}",
        "valeur {name} supprimée dans {inventory}",
    ),
    ("removed search {name}", "recherche {name} supprimée"),
    (
        "removed recipe {name} on {recording}",
        "recette {name} supprimée sur {recording}",
    ),
    (
        "removed notation {name} on {sign}",
        "notation {name} supprimée sur {sign}",
    ),
    (
        "annotation {name} on {tier} of {recording}: {changes}",
        "annotation {name} sur {tier} de {recording} : {changes}",
    ),
    (
        "start from {old} to {new}; end from {before} to {after}",
        "début : {old} → {new} ; fin : {before} → {after}",
    ),
    ("start from {old} to {new}", "début : {old} → {new}"),
    ("end from {old} to {new}", "fin : {old} → {new}"),
    ("value from {old} to {new}", "valeur : {old} → {new}"),
    ("name from {old} to {new}", "nom : {old} → {new}"),
    ("gloss from {old} to {new}", "glose : {old} → {new}"),
    ("notes from {old} to {new}", "remarques : {old} → {new}"),
    ("its order or form", "son ordre ou sa forme"),
    ("character {n}", "caractère {n}"),
    (
        "steps (residual: the largest distance of a wrist from its goal)",
        "étapes (écart : la plus grande distance d’un poignet à son but)",
    ),
    ("steps", "étapes"),
    ("channels", "canaux"),
    ("joins", "raccords"),
    ("contacts undone", "contacts défaits"),
    ("{step}   (residual {mm} mm)", "{step}   (écart {mm} mm)"),
    (
        "one change cannot be made, and none was:",
        "une modification est impossible, et aucune n’a été faite :",
    ),
    (
        "{n} changes cannot be made, and none was:",
        "{n} modifications sont impossibles, et aucune n’a été faite :",
    ),
    (
        "its version is {version}, and this program reads {one} and {other}",
        "sa version est {version}, et ce programme lit {one} et {other}",
    ),
    (
        "it holds {n} columns of {frames} frames, not {count} of {others}",
        "il contient {n} colonnes de {frames} images, et non {count} de {others}",
    ),
    (
        "bytes follow its last column",
        "des octets suivent sa dernière colonne",
    ),
    (
        "the form {form} of numbers is unknown",
        "la forme {form} de nombres est inconnue",
    ),
    (
        "the coding {form} is unknown",
        "le codage {form} est inconnu",
    ),
    ("its gaps are out of order", "ses lacunes sont en désordre"),
    ("a number is not finite", "un nombre n’est pas fini"),
    (
        "an exception is about frame {n}",
        "une exception concerne l’image {n}",
    ),
    (
        "the exception {text} is no number",
        "l’exception {text} n’est pas un nombre",
    ),
    (
        "a constant is not as long as its numbers",
        "une constante n’est pas aussi longue que ses nombres",
    ),
    ("a column has {n} numbers", "une colonne a {n} nombres"),
    (
        "its changeset is empty",
        "son jeu de modifications est vide",
    ),
    ("it is missing", "absent"),
    ("it is no text", "ce n’est pas du texte"),
    (
        "it names the unknown table {table}",
        "il nomme la table inconnue {table}",
    ),
    (
        "it holds the unknown change {kind}",
        "il contient la modification inconnue {kind}",
    ),
    (
        "its kind {kind} is unknown to this program",
        "ce programme ne connaît pas son genre {kind}",
    ),
    ("its {what} cannot be read", "illisible : {what}"),
    (
        "its numbers are {form}, not decimals",
        "ses nombres sont {form}, et non des décimaux",
    ),
    (
        "a scalar channel has several columns",
        "un canal scalaire a plusieurs colonnes",
    ),
    ("its file has no place", "son fichier n’a pas d’emplacement"),
    (
        "changeset {operation}, part {part}",
        "jeu de modifications {operation}, partie {part}",
    ),
    ("changeset {operation}", "jeu de modifications {operation}"),
    ("row {row} of {table}", "ligne {row} de {table}"),
    (
        "one of the rows {first} to {last} of {table}",
        "une des lignes {first} à {last} de {table}",
    ),
    ("a row of meta", "une ligne de meta"),
    ("the stored file {name}", "le fichier enregistré {name}"),
    ("the study {name}", "l’étude {name}"),
    (
        "it breaks a rule of its table: {rule}",
        "elle enfreint une règle de sa table : {rule}",
    ),
    (
        "this part cannot be read: {why}",
        "cette partie ne peut pas être lue : {why}",
    ),
    (
        "the new sign got no token",
        "le nouveau signe n’a pas reçu d’occurrence",
    ),
    (
        "{recording} has no track {name}",
        "{recording} n’a pas de piste {name}",
    ),
    ("a tier that is gone", "un acteur qui n’existe plus"),
];

/// Forms with few words of their own, which are tried after all others.
pub(super) const GENERAL: &[(&str, &str)] = &[
    ("and {n} more", "et {n} de plus"),
    (
        "{rest}, and still {cm} cm in the body",
        "{rest}, et encore à {cm} cm dans le corps",
    ),
    (
        "{rest}, at {time} {cm} cm away from its goal, as the hand would enter the body there; turn it with `orient`",
        "{rest}, à {time} à {cm} cm de son but, car la main y entrerait dans le corps ; tournez-la avec `orient`",
    ),
    ("{cm} cm in 1 frame", "{cm} cm dans 1 image"),
    ("{cm} cm in {n} frames", "{cm} cm dans {n} images"),
    (
        "{source} ({gloss}), {n} frames at {rate} fps",
        "{source} ({gloss}), {n} images à {rate} i/s",
    ),
    (
        "the first sign's return to rest is left out",
        "le retour au repos du premier signe est laissé de côté",
    ),
    (
        "the second sign's movement from rest is left out",
        "le mouvement du second signe depuis le repos est laissé de côté",
    ),
    (
        "the notation is performed by the body of {address}",
        "la notation est jouée par le corps de {address}",
    ),
    ("{cm} cm left, {rest}", "{cm} cm à gauche, {rest}"),
    ("{cm} cm right, {rest}", "{cm} cm à droite, {rest}"),
    ("{cm} cm up, {rest}", "{cm} cm vers le haut, {rest}"),
    ("{cm} cm down, {rest}", "{cm} cm vers le bas, {rest}"),
    ("{cm} cm forward", "{cm} cm en avant"),
    ("{cm} cm back", "{cm} cm en arrière"),
    ("{names} and {n} more", "{names} et {n} autres"),
    ("{file}, line {n}: {what}", "{file}, ligne {n} : {what}"),
    ("{file}, line {n}", "{file}, ligne {n}"),
    ("the tier {name}", "l’acteur {name}"),
    ("once", "une fois"),
    (
        "the {limb} wrist or forearm is at its limit in frame {n}: the reading is {angle} beyond it",
        "le poignet ou l’avant-bras {limb} est à sa limite à l’image {n} : la lecture la dépasse de {angle}",
    ),
];
