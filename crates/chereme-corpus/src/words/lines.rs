//! French forms of messages about the results of commands, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const LINES: &[(&str, &str)] = &[
    ("warning: {what}", "attention : {what}"),
    ("note: {what}", "note : {what}"),
    ("error: {what}", "erreur : {what}"),
    (
        "and {n} more were not compared",
        "pas comparées non plus : {n}",
    ),
    (
        "and {n} more of starter/recipes.txt: {names}",
        "et {n} de plus de starter/recipes.txt : {names}",
    ),
    (
        "and {n}; --limit shows more",
        "et {n} ; --limit en montre plus",
    ),
    ("and {n} more", "et {n} de plus"),
    (
        "and {n} more findings like these, all of them with --json",
        "et {n} constats de plus comme ceux-ci, tous avec --json",
    ),
    (
        "no room for: {names}; --width 0 shows all columns",
        "pas de place pour : {names} ; --width 0 montre toutes les colonnes",
    ),
    (
        "nothing is written; it would be:",
        "rien n’est écrit ; ce serait :",
    ),
    ("would change: {n}", "changerait : {n}"),
    ("changed: {n}", "modifié : {n}"),
    ("mended: {what}", "réparé : {what}"),
    (
        "all is well: looked at {list}",
        "tout va bien ; vérifié : {list}",
    ),
    (
        "there are faults: looked at {list}",
        "il y a des défauts ; vérifié : {list}",
    ),
    (
        "{n} performances of {function} for {sign}, {order}; compared: {channels}",
        "{n} exécutions de {function} pour {sign}, {order} ; comparé : {channels}",
    ),
    (
        "the most similar to its own face first",
        "d’abord la plus semblable à son propre visage",
    ),
    (
        "the least similar to its own face first",
        "d’abord la moins semblable à son propre visage",
    ),
    ("the most usual first", "d’abord la plus habituelle"),
    (
        "left out, as they are unknown: {names}",
        "laissés de côté, car inconnus : {names}",
    ),
    (
        "comparisons with phases of too different lengths for the window of 10 frames, which was widened: {n}",
        "comparaisons de phases de durées trop différentes pour la fenêtre de 10 images, qui a été élargie : {n}",
    ),
    (
        "each was compared with {n} others",
        "comparaisons de chacune avec d’autres : {n}",
    ),
    (
        "not compared: {token}: {why}",
        "pas comparée : {token} : {why}",
    ),
    (
        "{name}: {n} markers, {share} % of their positions visible; {missing} are missing",
        "{name} : {n} marqueurs, {share} % de leurs positions visibles ; il en manque {missing}",
    ),
    (
        "{name}: {n} markers, {share} % of their positions visible",
        "{name} : {n} marqueurs, {share} % de leurs positions visibles",
    ),
    ("not used: {names}", "pas utilisés : {names}"),
    (
        "{n} frames at {rate} a second; {hidden} hidden places restored",
        "{n} images à {rate} par seconde ; positions cachées restaurées : {hidden}",
    ),
    (
        "nothing was stored; --store writes tiers",
        "rien n’a été enregistré ; --store écrit des acteurs",
    ),
    (
        "nothing was stored; --as GLOSS stores it",
        "rien n’a été enregistré ; --as GLOSE l’enregistre",
    ),
    ("nothing was stored", "rien n’a été enregistré"),
    (
        "{what} recognised after training on {other}",
        "reconnu : {what}, appris sur {other}",
    ),
    (
        "the recognisers were tested on the keys from which they learned",
        "la reconnaissance a été éprouvée sur les clés dont elle a appris",
    ),
    (
        "{n} movements from {recordings}: {found} of {all} pairs of keys; components miss markers by {mm} mm",
        "mouvements de {recordings} : {n} ; paires de clés : {found} sur {all} ; les composants manquent les marqueurs de {mm} mm",
    ),
    (
        "the script: {n} sentences, {pairs} pairs, {share} % of them in the dictionary; {missing} different ones are missing",
        "le script : {n} phrases, {pairs} paires, dont {share} % dans le dictionnaire ; différentes qui manquent : {missing}",
    ),
    (
        "{n} keys predicted by {code}, {produced} produced ({rate}); {same} as predicted",
        "clés prévues par {code} : {n}, produites : {produced} ({rate}), comme prévu : {same}",
    ),
    (
        "{name}: {share} % right; shown in rows, recognised in columns",
        "{name} : {share} % justes ; montrées en lignes, reconnues en colonnes",
    ),
    (
        "{n} keys in {seconds} s: {exact} exact, {others} stand in for others, {synthetic} synthetic; cost {cost}",
        "clés en {seconds} s : {n}, dont exactes : {exact}, à la place d’autres : {others}, synthétiques : {synthetic} ; coût {cost}",
    ),
    (
        "read back: {shapes} % of shapes, {placements} % of placements",
        "relu : {shapes} % des formes, {placements} % des emplacements",
    ),
    (
        "stored as the track {name}",
        "enregistré comme la piste {name}",
    ),
    ("stored as {name}", "enregistré sous {name}"),
    (
        "left out: {n} tokens that are not coded for these components",
        "laissées de côté : {n} occurrences qui ne sont pas codées pour ces composants",
    ),
    ("left out: {what}", "laissé de côté : {what}"),
    (
        "drew {n} signs to {path}: {size} KB",
        "signes dessinés dans {path} : {n}, {size} Ko",
    ),
    (
        "drew {what} to {path}: {n} frames, {size} KB",
        "{what} dessiné dans {path} : {n} images, {size} Ko",
    ),
    (
        "drew {what} to {path}: 1 frame, {size} KB",
        "{what} dessiné dans {path} : 1 image, {size} Ko",
    ),
    (
        "drew {what} to {path}: {n} symbols, {size} KB",
        "{what} dessiné dans {path} : {n} symboles, {size} Ko",
    ),
    (
        "drew {what} to {path}: 1 symbol, {size} KB",
        "{what} dessiné dans {path} : 1 symbole, {size} Ko",
    ),
    ("drew {path}", "{path} dessiné"),
    (
        "wrote {n}, {size} MB, to {path}",
        "écrit : {n}, {size} Mo, dans {path}",
    ),
    ("wrote {path}, {size} KB", "écrit : {path}, {size} Ko"),
    ("wrote {n} to {path}", "écrit : {n} dans {path}"),
    ("made {path}", "créé : {path}"),
    ("made: {list}", "créés : {list}"),
    ("removed: {list}", "retirés : {list}"),
    ("would make: {list}", "créerait : {list}"),
    ("would remove: {list}", "retirerait : {list}"),
    (
        "{recording}: {n} frames of {system} in the track {name}",
        "{recording} : {n} images de {system} dans la piste {name}",
    ),
    (
        "the weights were fitted on {on}",
        "les poids ont été ajustés sur {on}",
    ),
    (
        "frames with bridged gaps: {n}",
        "images à trous comblés : {n}",
    ),
    ("{n} annotations written", "annotations écrites : {n}"),
    (
        "stored: from now on these weights apply to all faces of {whose}",
        "enregistré : désormais ces poids valent pour tous les visages de {whose}",
    ),
    (
        "{n} frames; the skeleton scaled by {scale}; median distance of the markers {mm} mm",
        "{n} images ; squelette à l’échelle {scale} ; distance médiane des marqueurs {mm} mm",
    ),
    ("rows: {names}", "lignes : {names}"),
    (
        "{n} more files were imported without a warning; --json lists their notes",
        "autres fichiers importés sans avertissement : {n} ; --json donne leurs notes",
    ),
    (
        "not read: {what} without an ending ({why})",
        "pas lus : {what} sans extension ({why})",
    ),
    ("not read: {what} ({why})", "pas lus : {what} ({why})"),
    ("what to do: {what}", "que faire : {what}"),
    ("nothing new", "rien de nouveau"),
    (
        "{n} joints, {rate}, unit {unit}, axes up,left = {axes}",
        "{n} articulations, {rate}, unité {unit}, axes haut,gauche = {axes}",
    ),
    (
        "track {name}: {n} points, {all} frames, {rate}, unit {unit}, axes up,left = {axes}",
        "piste {name} : {n} points, {all} images, {rate}, unité {unit}, axes haut,gauche = {axes}",
    ),
    (
        "track {name}: {n} points, {all} frames, {rate}",
        "piste {name} : {n} points, {all} images, {rate}",
    ),
    (
        "track {name}: {n} curves, {all} frames, {rate}",
        "piste {name} : {n} courbes, {all} images, {rate}",
    ),
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
    ("column {name}: {meaning}", "colonne {name} : {meaning}"),
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
        "added {value} to {inventory}",
        "{value} ajouté à {inventory}",
    ),
    (
        "{from} is {to} from now on; annotations changed: {n}, lexicon entries: {entries}",
        "{from} est désormais {to} ; annotations modifiées : {n}, entrées du lexique : {entries}",
    ),
    (
        "{path}: {size} MB, schema version {version}",
        "{path} : {size} Mo, version {version} du schéma",
    ),
    ("holds: {list}", "contient : {list}"),
    (
        "movement: {hours} hours, {frames}",
        "mouvement : {hours} heures, {frames}",
    ),
    ("recordings: {list}", "enregistrements : {list}"),
    ("tracks: {list}", "pistes : {list}"),
    ("tokens: {list}", "occurrences : {list}"),
    ("tiers: {list}", "acteurs : {list}"),
    (
        "signer {name}: handedness not known, {n}",
        "signeur {name} : latéralité inconnue, {n}",
    ),
    (
        "signer {name}: right, {n}",
        "signeur {name} : droitier, {n}",
    ),
    ("signer {name}: left, {n}", "signeur {name} : gaucher, {n}"),
    ("signer {name}: {hand}, {n}", "signeur {name} : {hand}, {n}"),
    ("inventories: {list}", "inventaires : {list}"),
    (
        "attributes of signs: {list}",
        "attributs des signes : {list}",
    ),
    (
        "last change: {at} by {who}: {what}",
        "dernière modification : {at} par {who} : {what}",
    ),
    (
        "phases written: {n}; expressions that keep corrected milestones: {kept}",
        "phases écrites : {n} ; expressions qui gardent des jalons corrigés : {kept}",
    ),
    (
        "expressions: {n}; without a face: {none}",
        "expressions : {n} ; sans visage : {none}",
    ),
    (
        "{n} pairs of {signs} signs ({all} compared by {fields}), {certain} of them certain: both values are given",
        "paires : {n}, de {signs} signes ({all} comparés par {fields}), dont certaines : {certain} (les deux valeurs sont données)",
    ),
    (
        "homonyms: {n} pairs in {groups} groups of {signs} signs; {forms} forms",
        "homonymes : paires {n}, groupes {groups}, signes {signs}, formes {forms}",
    ),
    ("by field: {list}", "par champ : {list}"),
    ("in most pairs: {list}", "dans le plus de paires : {list}"),
    ("{n} accepted", "accepté : {n}"),
    (
        "proposed: {annotations} in {recordings}",
        "proposé : {annotations} dans {recordings}",
    ),
    (
        "nothing to examine in {recordings}",
        "rien à examiner dans {recordings}",
    ),
    (
        "{annotations} in {recordings}, for {tokens}; {unread} could not be read from movement",
        "{annotations} dans {recordings}, pour {tokens} ; illisible dans le mouvement : {unread}",
    ),
    (
        "{gloss} was there already and stays; --replace {other} instead of --as puts a sign in its place",
        "{gloss} existait déjà et reste ; --replace {other} au lieu de --as met un signe à sa place",
    ),
    (
        "stored {gloss} as token:{token}, recording {name}, {seconds} s: {recipe}",
        "{gloss} enregistré : token:{token}, enregistrement {name}, {seconds} s : {recipe}",
    ),
    (
        "{seconds} s, not stored (give it a gloss with --as): {recipe}",
        "{seconds} s, pas enregistré (donnez-lui une glose avec --as) : {recipe}",
    ),
    (
        "{name} has no movement of its own: its notation was animated on {body}",
        "{name} n’a pas de mouvement à lui : sa notation a été animée sur {body}",
    ),
    (
        "{name} has no notation: it was transcribed from its movement, and not stored",
        "{name} n’a pas de notation : il a été transcrit de son mouvement, sans être enregistré",
    ),
    (
        "distance {n} in all, {mean} for each aligned pair of frames (0: the same movement; each part is in its own scale)",
        "distance {n} en tout, {mean} par paire d’images alignées (0 : le même mouvement ; chaque partie a sa propre échelle)",
    ),
    (
        "largest distance of a joint: {cm} cm",
        "plus grande distance d’une articulation : {cm} cm",
    ),
    ("alignment: {n}", "alignement : {n}"),
    (
        "score {n} (0: alike); without the ratio of lengths {other}, ratio {ratio}; a phase is empty in one of them and left out",
        "score {n} (0 : pareil) ; sans le rapport des durées {other}, rapport {ratio} ; une phase est vide dans l’un des deux et laissée de côté",
    ),
    (
        "score {n} (0: alike); without the ratio of lengths {other}, ratio {ratio}",
        "score {n} (0 : pareil) ; sans le rapport des durées {other}, rapport {ratio}",
    ),
    (
        "saved search @{name} deleted: {query}",
        "recherche enregistrée @{name} supprimée : {query}",
    ),
    (
        "saved: @{name} stands for this query",
        "enregistré : @{name} vaut pour cette requête",
    ),
    (
        "possible pairs, in which one sign is not coded for all fields ({n} of {all}):",
        "paires possibles, où un signe n’est pas codé pour tous les champs ({n} sur {all}) :",
    ),
    (
        "values of {field} that no sign has with the rest: {list}",
        "valeurs de {field} qu’aucun signe n’a avec le reste : {list}",
    ),
    ("added tier:{id}, {name}", "ajouté : tier:{id}, {name}"),
    ("changed tier:{id}, {name}", "modifié : tier:{id}, {name}"),
    (
        "changed recording:{id}, {name}",
        "modifié : recording:{id}, {name}",
    ),
    (
        "changed signer:{id}, {name}",
        "modifié : signer:{id}, {name}",
    ),
    ("changed {gloss}", "modifié : {gloss}"),
    ("removed {names} with {n}", "retiré : {names} avec {n}"),
    (
        "token:{id} is the citation form of {gloss}",
        "token:{id} est la forme de citation de {gloss}",
    ),
    (
        "{track} starts at {time} s (now {now} s): correlation {r} with {other}, elsewhere at most {most}, confidence {sure}",
        "{track} commence à {time} s (maintenant {now} s) : corrélation {r} avec {other}, ailleurs au plus {most}, confiance {sure}",
    ),
    (
        "this is uncertain: look at both tracks before you use it, or name other channels",
        "c’est incertain : regardez les deux pistes avant de vous en servir, ou nommez d’autres canaux",
    ),
    ("there are no conflicts", "il n’y a pas de conflits"),
    (
        "1. The starter corpus: {n} in {path}",
        "1. Le corpus de départ : {n} dans {path}",
    ),
    ("built {what}: {n}", "construit {what} : {n}"),
    (
        "2. Search {what}, {query}: {n}",
        "2. Chercher {what}, {query} : {n}",
    ),
    (
        "3. Make {gloss} = {recipe}: stored as token:{token} ({why})",
        "3. Composer {gloss} = {recipe} : enregistré, token:{token} ({why})",
    ),
    (
        "found again by search, {query}: {n}",
        "retrouvé par la recherche, {query} : {n}",
    ),
    (
        "4. Pictures in {path}: {names}",
        "4. Images dans {path} : {names}",
    ),
    (
        "5. Written out: LIMACE.bvh, tokens.csv, and everything in the folder enriched",
        "5. Exporté : LIMACE.bvh, tokens.csv, et tout dans le dossier enriched",
    ),
    (
        "Look at {path} first. Then try:",
        "Regardez d’abord {path}. Puis essayez :",
    ),
    (
        "the corpus is built first",
        "le corpus est d’abord construit",
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
    (
        "{file}: updated -> recording {name}",
        "{file} : mis à jour -> enregistrement {name}",
    ),
    ("{file}: updated", "{file} : mis à jour"),
    (
        "{file}: unchanged -> recording {name}",
        "{file} : inchangé -> enregistrement {name}",
    ),
    ("{file}: unchanged", "{file} : inchangé"),
    (
        "{file}: REFUSED -> recording {name}",
        "{file} : REFUSÉ -> enregistrement {name}",
    ),
    ("{file}: REFUSED", "{file} : REFUSÉ"),
    (
        "{file} -> recording {name}",
        "{file} -> enregistrement {name}",
    ),
    ("1 token: {query}", "1 occurrence : {query}"),
    ("0 tokens: {query}", "0 occurrence : {query}"),
    ("{n} tokens: {query}", "{n} occurrences : {query}"),
    (
        "{n} tokens, {shown} shown: {query}",
        "{n} occurrences, dont {shown} affichées : {query}",
    ),
    ("character {n}", "caractère {n}"),
    ("by handshape", "par configuration"),
    ("by placement", "par emplacement"),
    (
        "the slug is the snail with another handshape",
        "la limace est l’escargot avec une autre configuration",
    ),
    ("the bowl stands on the left", "le bol est à gauche"),
    (
        "dark is light played backwards",
        "foncé est clair joué à l’envers",
    ),
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
        "the new sign got no token",
        "le nouveau signe n’a pas reçu d’occurrence",
    ),
    (
        "{recording} has no track {name}",
        "{recording} n’a pas de piste {name}",
    ),
    ("a tier that is gone", "un acteur qui n’existe plus"),
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
    ("{cm} cm left, {rest}", "{cm} cm à gauche, {rest}"),
    ("{cm} cm right, {rest}", "{cm} cm à droite, {rest}"),
    ("{cm} cm up, {rest}", "{cm} cm vers le haut, {rest}"),
    ("{cm} cm down, {rest}", "{cm} cm vers le bas, {rest}"),
    ("{cm} cm forward", "{cm} cm en avant"),
    ("{cm} cm back", "{cm} cm en arrière"),
    (
        "{tier} of {recording} at {time} s: {from} -> {to}",
        "{tier} de {recording} à {time} s : {from} -> {to}",
    ),
    ("{names} and {n} more", "{names} et {n} autres"),
    ("{file}, line {n}: {what}", "{file}, ligne {n} : {what}"),
];
