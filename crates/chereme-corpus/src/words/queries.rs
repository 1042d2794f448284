//! French forms of query errors and their remedies, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const QUERIES: &[(&str, &str)] = &[
    (
        "the value {value} is in no inventory; did you mean {near}?",
        "la valeur {value} n’est dans aucun inventaire ; vouliez-vous dire {near} ?",
    ),
    (
        "the value {value} is in no inventory",
        "la valeur {value} n’est dans aucun inventaire",
    ),
    (
        "known values: {values} and {n} more",
        "valeurs connues : {values} et {n} autres",
    ),
    ("known values: {values}", "valeurs connues : {values}"),
    (
        "a value should stand here",
        "une valeur doit se trouver ici",
    ),
    (
        "write a value, * for any, or unset, n/a or unclear",
        "écrivez une valeur, * pour n’importe laquelle, ou unset, n/a ou unclear",
    ),
    ("there is no field {name}", "il n’y a pas de champ {name}"),
    ("{name} is no component", "{name} n’est pas un composant"),
    (
        "{part} is a part of {component}",
        "{part} est une partie de {component}",
    ),
    (
        "there is no relation {name}",
        "il n’y a pas de relation {name}",
    ),
    (
        "to search for the word, write it in quotes: {word}",
        "pour chercher le mot, écrivez-le entre guillemets : {word}",
    ),
    (
        "the hand stands before {component}, not after it",
        "la main se met avant {component}, pas après",
    ),
    (
        "this is no regular expression: {reason}",
        "ce n’est pas une expression régulière : {reason}",
    ),
    (
        "this bracket is not closed",
        "cette parenthèse n’est pas fermée",
    ),
    ("this value is empty", "cette valeur est vide"),
    ("this sign joins nothing here", "ce signe ne relie rien ici"),
    ("{text} is no time", "{text} n’est pas un temps"),
    ("{text} has no unit", "{text} n’a pas d’unité"),
    ("\"{text}\" is no number", "\"{text}\" n’est pas un nombre"),
    (
        "there is no unit of time {unit}",
        "il n’y a pas d’unité de temps {unit}",
    ),
    (
        "{operator} does not compare times",
        "{operator} ne compare pas des temps",
    ),
    (
        "{operator} does not compare values",
        "{operator} ne compare pas des valeurs",
    ),
    (
        "{operator} does not compare texts",
        "{operator} ne compare pas des textes",
    ),
    (
        "{operator} has no field on its left",
        "{operator} n’a pas de champ à sa gauche",
    ),
    (
        "{word} needs a comparison on its right",
        "{word} demande une comparaison à sa droite",
    ),
    ("`within` needs a distance", "`within` demande une distance"),
    ("`like` needs an example", "`like` demande un exemple"),
    ("{text} is no likeness", "{text} n’est pas une ressemblance"),
    ("{text} is no example", "{text} n’est pas un exemple"),
    ("which saved search?", "quelle recherche enregistrée ?"),
    ("ask in several steps", "demandez en plusieurs étapes"),
    ("write a number such as {n}", "écrivez un nombre comme {n}"),
    ("one time should stand here", "un temps doit se trouver ici"),
    (
        "{name} names no component",
        "{name} ne nomme pas de composant",
    ),
    (
        "write for example tier(\"Mouthing\")=ma* or tier(\"Mouthing\")=*",
        "écrivez par exemple tier(\"Mouthing\")=ma* ou tier(\"Mouthing\")=*",
    ),
    ("the tier's name is missing", "il manque le nom de l’acteur"),
    (
        "write ) after the tier's name; a name with blanks needs quotes",
        "écrivez ) après le nom de l’acteur ; un nom avec des espaces demande des guillemets",
    ),
    (
        "this parenthesis is not closed",
        "cette parenthèse n’est pas fermée",
    ),
    (
        "a comparison should follow the tier",
        "une comparaison doit suivre l’acteur",
    ),
    (
        "write for example attribute(\"Sign Frequency\")>2",
        "écrivez par exemple attribute(\"Sign Frequency\")>2",
    ),
    (
        "the name of an attribute should stand here",
        "le nom d’un attribut doit se trouver ici",
    ),
    (
        "write ) after the name; a name with blanks needs quotes",
        "écrivez ) après le nom ; un nom avec des espaces demande des guillemets",
    ),
    (
        "a comparison should follow the attribute",
        "une comparaison doit suivre l’attribut",
    ),
    (
        "this range ends before it starts",
        "cet intervalle finit avant de commencer",
    ),
    (
        "the lesser number stands first",
        "le plus petit nombre vient d’abord",
    ),
    (
        "the shorter time stands first",
        "le temps le plus court vient d’abord",
    ),
    (
        "write a field before it, such as placement=chin; text with such signs is searched in quotes",
        "écrivez un champ devant, comme placement=chin ; un texte avec de tels caractères se cherche entre guillemets",
    ),
    (
        "write a word or part of one; the empty query finds everything",
        "écrivez un mot ou une partie de mot ; la requête vide trouve tout",
    ),
    (
        "there is nothing to search for in this",
        "il n’y a rien à chercher ici",
    ),
    (
        "one or the other is written with `or`",
        "l’un ou l’autre s’écrit avec `or`",
    ),
    (
        "terms side by side must all hold already",
        "des termes côte à côte doivent déjà être tous vrais",
    ),
    (
        "write a condition that must not hold with `not`",
        "écrivez avec `not` une condition qui doit être fausse",
    ),
    (
        "a component has at most one hand and one phase before it",
        "un composant a devant lui au plus une main et une phase",
    ),
    ("{part} is one too many", "{part} est de trop"),
    ("leave the hand out", "ôtez la main"),
    (
        "non-manual components belong to no hand",
        "les composants non manuels ne sont à aucune main",
    ),
    (
        "after a component stands at most one part of it",
        "un composant est suivi d’au plus une de ses parties",
    ),
    (
        "write for example orientation.palm or nonmanual.brows",
        "écrivez par exemple orientation.palm ou nonmanual.brows",
    ),
    (
        "write configuration, placement, movement, orientation or nonmanual here",
        "écrivez ici configuration, placement, movement, orientation ou nonmanual",
    ),
    (
        "a gloss with a colon stands after gloss= or in quotes",
        "une glose avec deux-points se met après gloss= ou entre guillemets",
    ),
    (
        "fields are {names}; text with such signs is searched in quotes",
        "les champs sont {names} ; un texte avec de tels caractères se cherche entre guillemets",
    ),
    (
        "successive values are not compared with `!=`",
        "des valeurs successives ne se comparent pas avec `!=`",
    ),
    (
        "write `not` before the comparison: not placement=head > chest",
        "écrivez `not` devant la comparaison : not placement=head > chest",
    ),
    (
        "values are compared with =, != or == (this value and none narrower)",
        "les valeurs se comparent avec =, != ou == (cette valeur, et aucune plus précise)",
    ),
    (
        "only components have features",
        "seuls les composants ont des traits",
    ),
    ("write a name here", "écrivez un nom ici"),
    (
        "texts are compared with = (whole), : (words in it) or ~ (up to a slip)",
        "les textes se comparent avec = (entier), : (mots dedans) ou ~ (à une faute près)",
    ),
    (
        "write either field:BO* or field~BOL",
        "écrivez champ:BO* ou champ~BOL",
    ),
    (
        "wildcards do not go with ~",
        "les jokers ne vont pas avec ~",
    ),
    (
        "one slip is ~1 or nothing, two are ~2; a ~ inside a text needs quotes",
        "une faute, c’est ~1 ou rien, deux ~2 ; un ~ dans un texte demande des guillemets",
    ),
    (
        "a text is searched up to one or two slips",
        "un texte se cherche à une ou deux fautes près",
    ),
    (
        "write cue=24, cue.shape=5, cue.placement=throat or cue.phase>100",
        "écrivez cue=24, cue.shape=5, cue.placement=throat ou cue.phase>100",
    ),
    (
        "a key is written as placement and shape: mouth-4, or 24 with the numbers of the paper (1 side, 2 mouth, 3 chin, 4 cheek, 5 throat)",
        "une clé s’écrit emplacement et forme : mouth-4, ou 24 avec les numéros de l’article (1 side, 2 mouth, 3 chin, 4 cheek, 5 throat)",
    ),
    ("this is no key", "ce n’est pas une clé"),
    (
        "a number should stand here",
        "un nombre doit se trouver ici",
    ),
    (
        "write for example nonmanual.brows>0.5",
        "écrivez par exemple nonmanual.brows>0.5",
    ),
    (
        "no values are known for this field",
        "aucune valeur n’est connue pour ce champ",
    ),
    (
        "a value that begins with / and is no regular expression is quoted",
        "une valeur qui commence par / sans être une expression régulière se met entre guillemets",
    ),
    (
        "this regular expression is not closed",
        "cette expression régulière n’est pas fermée",
    ),
    ("write / at its end; {rest}", "écrivez / à la fin ; {rest}"),
    ("this quote is not closed", "ce guillemet n’est pas fermé"),
    (
        "write \" at the end of the text",
        "écrivez \" à la fin du texte",
    ),
    ("a value ends before this", "une valeur finit avant ceci"),
    (
        "successive values are those of a component: placement=head > chest",
        "des valeurs successives sont celles d’un composant : placement=head > chest",
    ),
    (
        "a value with = in it is written in quotes",
        "une valeur qui contient = s’écrit entre guillemets",
    ),
    ("a blank is missing here", "il manque une espace ici"),
    (
        "a quote inside a quoted text is written \\\"",
        "un guillemet dans un texte entre guillemets s’écrit \\\"",
    ),
    (
        "the query is longer than {n} characters",
        "la requête dépasse {n} caractères",
    ),
    (
        "this parenthesis closes none",
        "cette parenthèse n’en ferme aucune",
    ),
    (
        "leave it out, or open one before it",
        "ôtez-la, ou ouvrez-en une avant",
    ),
    (
        "{word} has nothing to join here",
        "{word} n’a rien à relier ici",
    ),
    (
        "the query ends where a term should stand",
        "la requête finit là où un terme doit se trouver",
    ),
    (
        "a term should stand before this parenthesis",
        "un terme doit se trouver avant cette parenthèse",
    ),
    (
        "write a comparison beside it; to search for the word itself, write {word}",
        "écrivez une comparaison à côté ; pour chercher le mot lui-même, écrivez {word}",
    ),
    (
        "write a comparison such as placement=chin, or a word",
        "écrivez une comparaison comme placement=chin, ou un mot",
    ),
    (
        "more than {n} parentheses and negations inside each other",
        "plus de {n} parenthèses et négations les unes dans les autres",
    ),
    ("take some of them out", "ôtez-en quelques-unes"),
    (
        "features need a field before them",
        "des traits demandent un champ devant eux",
    ),
    (
        "a list of features is a value: configuration=[index -thumb]",
        "une liste de traits est une valeur : configuration=[index -thumb]",
    ),
    (
        "a comma stands only between the values of one field",
        "une virgule ne se met qu’entre les valeurs d’un même champ",
    ),
    (
        "terms side by side must all hold; `or` between them means that one is enough",
        "des termes côte à côte doivent tous être vrais ; avec `or` entre eux, un seul suffit",
    ),
    (
        "write ) where the group ends",
        "écrivez ) là où le groupe finit",
    ),
    (
        "write @ and the name of a saved search, with blanks: @\"my search\"",
        "écrivez @ et le nom d’une recherche enregistrée, avec des espaces : @\"ma recherche\"",
    ),
    (
        "write within 0.5s around, within 0.5s of-begin or within 0.5s of-end",
        "écrivez within 0.5s around, within 0.5s of-begin ou within 0.5s of-end",
    ),
    (
        "{kind} does not say what the distance is counted from",
        "{kind} ne dit pas d’où se compte la distance",
    ),
    (
        "{advice}; to search for the word, write it in quotes: {word}",
        "{advice} ; pour chercher le mot, écrivez-le entre guillemets : {word}",
    ),
    (
        "write a component, a gloss or a tier, such as nonmanual.brows=raised, gloss=CHAT or tier(\"Mouthing\")=*",
        "écrivez un composant, une glose ou un acteur, comme nonmanual.brows=raised, gloss=CHAT ou tier(\"Mouthing\")=*",
    ),
    (
        "successive values belong to one token, not to an annotation beside it",
        "des valeurs successives sont à une occurrence, pas à une annotation à côté",
    ),
    (
        "ask them of the token itself: placement=head > chest",
        "demandez-les à l’occurrence elle-même : placement=head > chest",
    ),
    (
        "this is no annotation that could stand in a relation of time",
        "ce n’est pas une annotation qui puisse être dans une relation de temps",
    ),
    (
        "write like token:41 or like CHAT, and then, if not all components count, on configuration, placement",
        "écrivez like token:41 ou like CHAT, puis, si tous les composants ne comptent pas, on configuration, placement",
    ),
    (
        "{joint} does not follow an example",
        "{joint} ne suit pas un exemple",
    ),
    (
        "likeness goes from 0 to 1: write above 0.6, or above 60%",
        "la ressemblance va de 0 à 1 : écrivez above 0.6, ou above 60%",
    ),
    (
        "an example is one token or one sign",
        "un exemple est une occurrence ou un signe",
    ),
    (
        "a component should stand here",
        "un composant doit se trouver ici",
    ),
    (
        "write for example on configuration:2, placement",
        "écrivez par exemple on configuration:2, placement",
    ),
    ("{text} is no weight", "{text} n’est pas un poids"),
    (
        "a weight is a number above 0 and at most 1000, such as configuration:2",
        "un poids est un nombre au-dessus de 0 et d’au plus 1000, comme configuration:2",
    ),
    (
        "write {name}<0.8s, {first}>=1s or {other}=0.5s..1s; `not` before it for the opposite",
        "écrivez {name}<0.8s, {first}>=1s ou {other}=0.5s..1s ; `not` devant pour le contraire",
    ),
    ("a time should stand here", "un temps doit se trouver ici"),
    (
        "write a number with its unit: 0.8s, 800ms or 2min",
        "écrivez un nombre avec son unité : 0.8s, 800ms ou 2min",
    ),
    (
        "a range stands after =, as in duration=0.5s..1s",
        "un intervalle se met après =, comme duration=0.5s..1s",
    ),
    (
        "times are counted in s, ms or min",
        "les temps se comptent en s, ms ou min",
    ),
    ("this time is too long", "ce temps est trop long"),
    (
        "recordings last hours, not years",
        "un enregistrement dure des heures, pas des années",
    ),
    (
        "one of several values is written with commas: placement=chest,chin",
        "l’une de plusieurs valeurs s’écrit avec des virgules : placement=chest,chin",
    ),
    (
        "a value that is a joint is written in quotes",
        "une valeur qui est un mot de liaison s’écrit entre guillemets",
    ),
    (
        "a field without a value is written =unset, =n/a or =unclear",
        "un champ sans valeur s’écrit =unset, =n/a ou =unclear",
    ),
    (
        "write for example placement=head > chest, placement=head > * or * > chest",
        "écrivez par exemple placement=head > chest, placement=head > * ou * > chest",
    ),
    (
        "more than {n} values follow each other here",
        "plus de {n} valeurs se suivent ici",
    ),
    (
        "nothing begins or goes on where no value is",
        "rien ne commence ni ne continue là où il n’y a pas de valeur",
    ),
    (
        "write ] after the last feature",
        "écrivez ] après le dernier trait",
    ),
    (
        "write for example configuration=[index middle -thumb]",
        "écrivez par exemple configuration=[index middle -thumb]",
    ),
    (
        "a feature is missing between the brackets",
        "il manque un trait entre les crochets",
    ),
    (
        "features are names between blanks, those that must be absent with a minus: [index -thumb]",
        "les traits sont des noms séparés par des espaces, avec un moins pour ceux qui doivent être absents : [index -thumb]",
    ),
    ("this is no feature", "ce n’est pas un trait"),
    (
        "it is longer than {n} characters",
        "elle dépasse {n} caractères",
    ),
    ("it needs too much memory", "elle demande trop de mémoire"),
];
