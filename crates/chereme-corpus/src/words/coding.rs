//! French forms of messages about notation, components and changes to tiers, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const CODING: &[(&str, &str)] = &[
    (
        "there is no symbol; write at least a handshape or a movement",
        "il n’y a aucun symbole ; écrivez au moins une configuration ou un mouvement",
    ),
    (
        "symbol {n} is {text}, which HamNoSys 4 does not have; write one of its 209 symbols or their names",
        "le symbole {n} est {text}, que HamNoSys 4 n’a pas ; écrivez l’un de ses 209 symboles ou leurs noms",
    ),
    (
        "symbol {n} is {symbol}, but expected {expected}",
        "le symbole {n} est {symbol}, mais il fallait : {expected}",
    ),
    (
        "after the last symbol, {n}, expected {expected}",
        "après le dernier symbole, {n}, il fallait : {expected}",
    ),
    (
        "symbol {n}, {symbol}, is not closed; expected {expected} at symbol {at}",
        "le symbole {n}, {symbol}, n’est pas fermé ; il fallait {expected} au symbole {at}",
    ),
    (
        "symbol {n} nests deeper than {limit} levels; split the sign into parts",
        "le symbole {n} dépasse {limit} niveaux ; divisez le signe en parties",
    ),
    (
        "{n} symbols are more than a transcription has; write {limit} at most",
        "{n} symboles sont plus que n’en a une transcription ; écrivez-en {limit} au plus",
    ),
    (
        "{text} is no direction; write one to three of u or d, o or i, l or r, such as \"u\", \"ol\" or \"dir\"",
        "{text} n’est pas une direction ; écrivez une à trois lettres, u ou d, o ou i, l ou r, comme \"u\", \"ol\" ou \"dir\"",
    ),
    (
        "{text} is not one of the eight directions; write u, ur, r, dr, d, dl, l or ul",
        "{text} n’est aucune des huit directions ; écrivez u, ur, r, dr, d, dl, l ou ul",
    ),
    (
        "body language of version {n} is unknown; this program reads version {known}",
        "le langage corporel de version {n} est inconnu ; ce programme lit la version {known}",
    ),
    (
        "{name} is no value of body language",
        "{name} n’est pas une valeur du langage corporel",
    ),
    (
        "{name} is moved by {by} shoulder widths; it must be from -1 to 1",
        "{name} est déplacé de {by} largeurs d’épaules ; il faut de -1 à 1",
    ),
    (
        "{name} is {value}; it must be from 0 to {most}",
        "{name} est {value} ; il faut de 0 à {most}",
    ),
    (
        "{name} is in {found}; it must be in {unit}",
        "{name} est en {found} ; il faut {unit}",
    ),
    (
        "{place}: there is no field {name}",
        "{place} : il n’y a pas de champ {name}",
    ),
    (
        "{place}: the field {name} is missing",
        "{place} : il manque le champ {name}",
    ),
    (
        "{place}: {text} means {other} already; give each value its own ids, aliases and names",
        "{place} : {text} désigne déjà {other} ; donnez à chaque valeur ses propres ids, alias et noms",
    ),
    (
        "{place}: there is no value {id}",
        "{place} : il n’y a pas de valeur {id}",
    ),
    (
        "{place}: the value lies within itself; give it a broader one that is not part of it",
        "{place} : la valeur est contenue en elle-même ; donnez-lui une valeur plus large qui n’en fait pas partie",
    ),
    (
        "the sign before overlaps the first sign, so the onset is empty",
        "le signe d’avant chevauche le premier signe : le début est vide",
    ),
    (
        "the sign after overlaps the last sign, so the offset is empty",
        "le signe d’après chevauche le dernier signe : la fin est vide",
    ),
    (
        "M1 lies {time} s before the recording, where nothing is to be read",
        "M1 est {time} s avant l’enregistrement, où il n’y a rien à lire",
    ),
    (
        "{part} is no hand, phase or component",
        "{part} n’est ni une main, ni une phase, ni un composant",
    ),
    (
        "{part} is the second hand or phase of this field: give one of each",
        "{part} est la deuxième main ou phase de ce champ : donnez-en une de chaque",
    ),
    (
        "{text}: after the component stands at most one feature, such as orientation.palm",
        "{text} : le composant est suivi d’au plus un trait, comme orientation.palm",
    ),
    (
        "{text}: non-manual components belong to no hand; leave the hand out",
        "{text} : les composants non manuels ne sont à aucune main ; ôtez la main",
    ),
    (
        "{text} is no hand: right, left, dominant or weak",
        "{text} n’est pas une main : right, left, dominant ou weak",
    ),
    (
        "{text} is no phase: initial, middle, middle2 ... or final",
        "{text} n’est pas une phase : initial, middle, middle2 ... ou final",
    ),
    (
        "{text} is no role; write {roles}, or a component such as right.configuration or nonmanual.brows",
        "{text} n’est pas un rôle ; écrivez {roles}, ou un composant comme right.configuration ou nonmanual.brows",
    ),
    (
        "{text} names the {hand} hand; a role alone has none",
        "{text} nomme la main {hand} ; un rôle seul n’en a pas",
    ),
    (
        "{text} names a phase, {phase}; a tier holds successive values one after another",
        "{text} nomme une phase, {phase} ; un acteur contient des valeurs les unes après les autres",
    ),
    (
        "{annotation} is on {tier}, which does not exist",
        "{annotation} est sur {tier}, qui n’existe pas",
    ),
    ("tier:{id} does not exist", "il n’y a pas de tier:{id}"),
    (
        "annotation:{id} does not exist",
        "il n’y a pas d’annotation:{id}",
    ),
    (
        "{tier} is a {stereotype}: its annotations have no times of their own; change the one above",
        "{tier} est un {stereotype} : ses annotations n’ont pas de temps à elles ; modifiez celle au-dessus",
    ),
    (
        "{tier} has times of its own; give the new annotation a time instead of a parent",
        "{tier} a des temps à lui ; donnez à la nouvelle annotation un temps au lieu d’un parent",
    ),
    (
        "{tier} is no Symbolic_Subdivision: its annotations have no order to change",
        "{tier} n’est pas un Symbolic_Subdivision : ses annotations n’ont pas d’ordre à changer",
    ),
    (
        "{annotation} from {start} to {end} must lie inside one annotation of {tier}; {other} there lasts from {from} to {to}",
        "{annotation}, de {start} à {end}, doit se trouver dans une annotation de {tier} ; {other} y dure de {from} à {to}",
    ),
    (
        "{annotation} from {start} to {end} must lie inside one annotation of {tier}",
        "{annotation}, de {start} à {end}, doit se trouver dans une annotation de {tier}",
    ),
    (
        "{parent} is not on {tier}, the tier above {below}",
        "{parent} n’est pas sur {tier}, l’acteur au-dessus de {below}",
    ),
    (
        "the first annotation of {tier} below {parent} must last from {start} to {end} as that does; split it afterwards",
        "la première annotation de {tier} sous {parent} doit durer de {start} à {end} comme celle-ci ; divisez-la ensuite",
    ),
    (
        "on the Time_Subdivision {tier} a new annotation takes the head or the tail of an existing one; split {other} instead",
        "sur le Time_Subdivision {tier}, une nouvelle annotation prend le début ou la fin d’une autre ; divisez plutôt {other}",
    ),
    (
        "{annotation} cannot have a boundary at {at}; between {from} and {to} is right",
        "{annotation} ne peut pas avoir de limite à {at} ; entre {from} et {to}, c’est possible",
    ),
    (
        "{annotation} cannot be cut at {at}; it lasts from {start} to {end}",
        "{annotation} ne se coupe pas à {at} ; elle dure de {start} à {end}",
    ),
    (
        "{first} and {second} are not neighbours in this order on one tier below one parent; merge only such",
        "{first} et {second} ne se suivent pas dans cet ordre sur un acteur sous un même parent ; ne fusionnez que de telles annotations",
    ),
    (
        "{first} says {one} and {second} says {other}; give the value for the merged annotation",
        "{first} dit {one} et {second} dit {other} ; donnez la valeur de l’annotation fusionnée",
    ),
    (
        "{time} is too far from the start of the recording",
        "{time} est trop loin du début de l’enregistrement",
    ),
    (
        "{tier} has the name {name} of {other}; give it another",
        "{tier} porte le nom {name} de {other} ; donnez-lui un autre nom",
    ),
    (
        "{tier} hangs below {parent}, which does not exist; make it a root tier",
        "{tier} est sous {parent}, qui n’existe pas ; faites-en un acteur racine",
    ),
    (
        "{tier} hangs below itself; give it a parent that is not below it",
        "{tier} est sous lui-même ; donnez-lui un parent qui n’est pas sous lui",
    ),
    (
        "{tier} hangs below more than {n} other tiers; hang it higher",
        "{tier} est sous plus de {n} autres acteurs ; mettez-le plus haut",
    ),
    (
        "{tier} has times of its own but hangs below {parent}, which has none; make it Symbolic_Subdivision or Symbolic_Association",
        "{tier} a des temps à lui mais est sous {parent}, qui n’en a pas ; faites-en Symbolic_Subdivision ou Symbolic_Association",
    ),
    (
        "{annotation} on {tier} starts and ends at {at}; it must last at least a microsecond",
        "{annotation} sur {tier} commence et finit à {at} ; elle doit durer au moins une microseconde",
    ),
    (
        "{annotation} from {start} to {end} overlaps {other} on {tier}; {advice}",
        "{annotation}, de {start} à {end}, chevauche {other} sur {tier} ; {advice}",
    ),
    (
        "end it at {time} or before",
        "finissez-la à {time} ou avant",
    ),
    (
        "start it at {time} or after",
        "commencez-la à {time} ou après",
    ),
    (
        "move one of the two, or shorten the other",
        "déplacez l’une des deux, ou raccourcissez l’autre",
    ),
    (
        "{annotation} on {tier} has no annotation above it on {above}",
        "{annotation} sur {tier} n’a pas d’annotation au-dessus d’elle sur {above}",
    ),
    (
        "{annotation} on the root tier {tier} hangs below {parent}; annotations of a root tier have no parent",
        "{annotation} sur l’acteur racine {tier} est sous {parent} ; les annotations d’un acteur racine n’ont pas de parent",
    ),
    (
        "{annotation} on the symbolic {tier} lasts from {start} to {end}; from its parent follows {from} to {to}",
        "{annotation} sur {tier}, symbolique, dure de {start} à {end} ; de sa parente suit {from} à {to}",
    ),
    (
        "{annotation} on {tier} lasts from {start} to {end}; it must lie inside {parent}, from {from} to {to}",
        "{annotation} sur {tier} dure de {start} à {end} ; elle doit se trouver dans {parent}, de {from} à {to}",
    ),
    (
        "the Time_Subdivision {tier} of {parent} leaves {from} to {to} uncovered; move a boundary there",
        "le Time_Subdivision {tier} de {parent} laisse libre de {from} à {to} ; mettez-y une limite",
    ),
    (
        "{parent} has {other} on the Symbolic_Association {tier} already; change that one, or remove {annotation}",
        "{parent} a déjà {other} sur {tier}, qui est Symbolic_Association ; modifiez celle-ci, ou retirez {annotation}",
    ),
    (
        "{annotation} on {tier} has place {order} among its siblings; it must be {expected}",
        "{annotation} sur {tier} a la place {order} parmi ses sœurs ; il faut {expected}",
    ),
    (
        "{annotation} on {tier} says {value}, which is not in {vocabulary}",
        "{annotation} sur {tier} dit {value}, qui n’est pas dans {vocabulary}",
    ),
    (
        "{text} names no component: configuration, placement, movement, orientation or nonmanual",
        "{text} ne nomme pas de composant : configuration, placement, movement, orientation ou nonmanual",
    ),
];
