## Messages: `{ $name }` is a variable part.

message-queries-value-in-no-inventory-did-you = la valeur { $value } n’est dans aucun inventaire ; vouliez-vous dire { $near } ?
message-queries-value-in-no-inventory = la valeur { $value } n’est dans aucun inventaire
message-queries-known-values-more = valeurs connues : { $values } et { $n } autres
message-queries-known-values = valeurs connues : { $values }
message-queries-value-should-stand-here = une valeur doit se trouver ici
message-queries-write-value-for-any-unset-n = écrivez une valeur, * pour n’importe laquelle, ou unset, n/a ou unclear
message-queries-there-no-field = il n’y a pas de champ { $name }
message-queries-no-component = { $name } n’est pas un composant
message-queries-part = { $part } est une partie de { $component }
message-queries-there-no-relation = il n’y a pas de relation { $name }
message-queries-search-for-word-write-in-quotes = pour chercher le mot, écrivez-le entre guillemets : { $word }
message-queries-hand-stands-before-not-after = la main se met avant { $component }, pas après
message-queries-this-no-regular-expression = ce n’est pas une expression régulière : { $reason }
message-queries-this-bracket-not-closed = cette parenthèse n’est pas fermée
message-queries-this-value-empty = cette valeur est vide
message-queries-this-sign-joins-nothing-here = ce signe ne relie rien ici
message-queries-no-time = { $text } n’est pas un temps
message-queries-has-no-unit = { $text } n’a pas d’unité
message-queries-no-number = "{ $text }" n’est pas un nombre
message-queries-there-no-unit-time = il n’y a pas d’unité de temps { $unit }
message-queries-does-not-compare-times = { $operator } ne compare pas des temps
message-queries-does-not-compare-values = { $operator } ne compare pas des valeurs
message-queries-does-not-compare-texts = { $operator } ne compare pas des textes
message-queries-has-no-field-on-left = { $operator } n’a pas de champ à sa gauche
message-queries-needs-comparison-on-right = { $word } demande une comparaison à sa droite
message-queries-within-needs-distance = `within` demande une distance
message-queries-like-needs-example = `like` demande un exemple
message-queries-no-likeness = { $text } n’est pas une ressemblance
message-queries-no-example = { $text } n’est pas un exemple
message-queries-saved-search = quelle recherche enregistrée ?
message-queries-ask-in-several-steps = demandez en plusieurs étapes
message-queries-write-number-such-as = écrivez un nombre comme { $n }
message-queries-one-time-should-stand-here = un temps doit se trouver ici
message-queries-names-no-component = { $name } ne nomme pas de composant
message-queries-write-for-example-tier-mouthing-ma = écrivez par exemple tier("Mouthing")=ma* ou tier("Mouthing")=*
message-queries-tier-s-name-missing = il manque le nom de l’acteur
message-queries-write-after-tier-s-name-name = écrivez ) après le nom de l’acteur ; un nom avec des espaces demande des guillemets
message-queries-this-parenthesis-not-closed = cette parenthèse n’est pas fermée
message-queries-comparison-should-follow-tier = une comparaison doit suivre l’acteur
message-queries-write-for-example-attribute-sign-frequency = écrivez par exemple attribute("Sign Frequency")>2
message-queries-name-attribute-should-stand-here = le nom d’un attribut doit se trouver ici
message-queries-write-after-name-name-with-blanks = écrivez ) après le nom ; un nom avec des espaces demande des guillemets
message-queries-comparison-should-follow-attribute = une comparaison doit suivre l’attribut
message-queries-this-range-ends-before-starts = cet intervalle finit avant de commencer
message-queries-lesser-number-stands-first = le plus petit nombre vient d’abord
message-queries-shorter-time-stands-first = le temps le plus court vient d’abord
message-queries-write-field-before-such-as-placement = écrivez un champ devant, comme placement=chin ; un texte avec de tels caractères se cherche entre guillemets
message-queries-write-word-part-one-empty-query = écrivez un mot ou une partie de mot ; la requête vide trouve tout
message-queries-there-nothing-search-for-in-this = il n’y a rien à chercher ici
message-queries-one-other-written-with = l’un ou l’autre s’écrit avec `or`
message-queries-terms-side-by-side-must-all = des termes côte à côte doivent déjà être tous vrais
message-queries-write-condition-must-not-hold-with = écrivez avec `not` une condition qui doit être fausse
message-queries-component-has-at-most-one-hand = un composant a devant lui au plus une main et une phase
message-queries-one-too-many = { $part } est de trop
message-queries-leave-hand-out = ôtez la main
message-queries-non-manual-components-belong-no-hand = les composants non manuels ne sont à aucune main
message-queries-after-component-stands-at-most-one = un composant est suivi d’au plus une de ses parties
message-queries-write-for-example-orientation-palm-nonmanual = écrivez par exemple orientation.palm ou nonmanual.brows
message-queries-write-configuration-placement-movement-orientation-nonmanual = écrivez ici configuration, placement, movement, orientation ou nonmanual
message-queries-gloss-with-colon-stands-after-gloss = une glose avec deux-points se met après gloss= ou entre guillemets
message-queries-fields-text-with-such-signs-searched = les champs sont { $names } ; un texte avec de tels caractères se cherche entre guillemets
message-queries-successive-values-not-compared-with = des valeurs successives ne se comparent pas avec `!=`
message-queries-write-not-before-comparison-not-placement = écrivez `not` devant la comparaison : not placement=head > chest
message-queries-values-compared-with-this-value-none = les valeurs se comparent avec =, != ou == (cette valeur, et aucune plus précise)
message-queries-only-components-have-features = seuls les composants ont des traits
message-queries-write-name-here = écrivez un nom ici
message-queries-texts-compared-with-whole-words-in = les textes se comparent avec = (entier), : (mots dedans) ou ~ (à une faute près)
message-queries-write-either-field-bo-field-bol = écrivez champ:BO* ou champ~BOL
message-queries-wildcards-do-not-go-with = les jokers ne vont pas avec ~
message-queries-one-slip-1-nothing-two-2 = une faute, c’est ~1 ou rien, deux ~2 ; un ~ dans un texte demande des guillemets
message-queries-text-searched-up-one-two-slips = un texte se cherche à une ou deux fautes près
message-queries-write-cue-24-cue-shape-5 = écrivez cue=24, cue.shape=5, cue.placement=throat ou cue.phase>100
message-queries-key-written-as-placement-shape-mouth = une clé s’écrit emplacement et forme : mouth-4, ou 24 avec les numéros de l’article (1 side, 2 mouth, 3 chin, 4 cheek, 5 throat)
message-queries-this-no-key = ce n’est pas une clé
message-queries-notation-not-compared-like-this = une notation ne se compare pas ainsi
message-queries-write-notation-and-symbols = écrivez notation~ et des symboles qu’elle a, ou notation= et toute la notation ; `not` devant le nie
message-queries-write-symbols-as-names-or-characters = écrivez les symboles par leurs noms ou leurs caractères, … pour un écart, ? pour un symbole quelconque, [movement] pour l’un d’une classe et hamcircle* pour les noms qui commencent ainsi : notation~"hamfinger2 … hamcircle*"
message-queries-more-than-symbols-follow-each-other = plus de { $n } symboles se suivent ici
message-queries-no-symbol-notation-stands-here = aucun symbole de notation ne se trouve ici
message-queries-no-class-symbols-called = aucune classe de symboles ne s’appelle { $name } : { $names }
message-queries-no-symbol-begins-with = aucun nom de symbole ne commence par { $name }
message-queries-no-symbol-hamnosys = { $name } n’est pas un symbole de HamNoSys
message-queries-number-should-stand-here = un nombre doit se trouver ici
message-queries-write-for-example-nonmanual-brows-0 = écrivez par exemple nonmanual.brows>0.5
message-queries-no-values-known-for-this-field = aucune valeur n’est connue pour ce champ
message-queries-value-begins-with-no-regular-expression = une valeur qui commence par / sans être une expression régulière se met entre guillemets
message-queries-this-regular-expression-not-closed = cette expression régulière n’est pas fermée
message-queries-write-at-end = écrivez / à la fin ; { $rest }
message-queries-this-quote-not-closed = ce guillemet n’est pas fermé
message-queries-write-at-end-text = écrivez " à la fin du texte
message-queries-value-ends-before-this = une valeur finit avant ceci
message-queries-successive-values-those-component-placement-head = des valeurs successives sont celles d’un composant : placement=head > chest
message-queries-value-with-in-written-in-quotes = une valeur qui contient = s’écrit entre guillemets
message-queries-blank-missing-here = il manque une espace ici
message-queries-quote-inside-quoted-text-written = un guillemet dans un texte entre guillemets s’écrit \"
message-queries-query-longer-than-characters = la requête dépasse { $n } caractères
message-queries-this-parenthesis-closes-none = cette parenthèse n’en ferme aucune
message-queries-leave-out-open-one-before = ôtez-la, ou ouvrez-en une avant
message-queries-has-nothing-join-here = { $word } n’a rien à relier ici
message-queries-query-ends-where-term-should-stand = la requête finit là où un terme doit se trouver
message-queries-term-should-stand-before-this-parenthesis = un terme doit se trouver avant cette parenthèse
message-queries-write-comparison-beside-search-for-word = écrivez une comparaison à côté ; pour chercher le mot lui-même, écrivez { $word }
message-queries-write-comparison-such-as-placement-chin = écrivez une comparaison comme placement=chin, ou un mot
message-queries-more-than-parentheses-negations-inside-each = plus de { $n } parenthèses et négations les unes dans les autres
message-queries-take-some-them-out = ôtez-en quelques-unes
message-queries-features-need-field-before-them = des traits demandent un champ devant eux
message-queries-list-features-value-configuration-index-thumb = une liste de traits est une valeur : configuration=[index -thumb]
message-queries-comma-stands-only-between-values-one = une virgule ne se met qu’entre les valeurs d’un même champ
message-queries-terms-side-by-side-must-all-hold = des termes côte à côte doivent tous être vrais ; avec `or` entre eux, un seul suffit
message-queries-write-where-group-ends = écrivez ) là où le groupe finit
message-queries-write-name-saved-search-with-blanks = écrivez @ et le nom d’une recherche enregistrée, avec des espaces : @"ma recherche"
message-queries-write-within-0-5s-around-within = écrivez within 0.5s around, within 0.5s of-begin ou within 0.5s of-end
message-queries-does-not-say-what-distance-counted = { $kind } ne dit pas d’où se compte la distance
message-queries-search-for-word-write-in-quotes-2 = { $advice } ; pour chercher le mot, écrivez-le entre guillemets : { $word }
message-queries-write-component-gloss-tier-such-as = écrivez un composant, une glose ou un acteur, comme nonmanual.brows=raised, gloss=CHAT ou tier("Mouthing")=*
message-queries-successive-values-belong-one-token-not = des valeurs successives sont à une occurrence, pas à une annotation à côté
message-queries-ask-them-token-itself-placement-head = demandez-les à l’occurrence elle-même : placement=head > chest
message-queries-this-no-annotation-could-stand-in = ce n’est pas une annotation qui puisse être dans une relation de temps
message-queries-write-like-token-41-like-chat = écrivez like token:41 ou like CHAT, puis, si tous les composants ne comptent pas, on configuration, placement
message-queries-does-not-follow-example = { $joint } ne suit pas un exemple
message-queries-likeness-goes-from-0-1-write = la ressemblance va de 0 à 1 : écrivez above 0.6, ou above 60%
message-queries-example-one-token-one-sign = un exemple est une occurrence ou un signe
message-queries-component-should-stand-here = un composant doit se trouver ici
message-queries-write-for-example-on-configuration-2 = écrivez par exemple on configuration:2, placement
message-queries-no-weight = { $text } n’est pas un poids
message-queries-weight-number-above-0-at-most = un poids est un nombre au-dessus de 0 et d’au plus 1000, comme configuration:2
message-queries-write-0-8s-1s-0-5s = écrivez { $name }<0.8s, { $first }>=1s ou { $other }=0.5s..1s ; `not` devant pour le contraire
message-queries-time-should-stand-here = un temps doit se trouver ici
message-queries-write-number-with-unit-0-8s = écrivez un nombre avec son unité : 0.8s, 800ms ou 2min
message-queries-range-stands-after-as-in-duration = un intervalle se met après =, comme duration=0.5s..1s
message-queries-times-counted-in-s-ms-min = les temps se comptent en s, ms ou min
message-queries-this-time-too-long = ce temps est trop long
message-queries-recordings-last-hours-not-years = un enregistrement dure des heures, pas des années
message-queries-one-several-values-written-with-commas = l’une de plusieurs valeurs s’écrit avec des virgules : placement=chest,chin
message-queries-value-joint-written-in-quotes = une valeur qui est un mot de liaison s’écrit entre guillemets
message-queries-field-without-value-written-unset-n = un champ sans valeur s’écrit =unset, =n/a ou =unclear
message-queries-write-for-example-placement-head-chest = écrivez par exemple placement=head > chest, placement=head > * ou * > chest
message-queries-more-than-values-follow-each-other = plus de { $n } valeurs se suivent ici
message-queries-nothing-begins-goes-on-where-no = rien ne commence ni ne continue là où il n’y a pas de valeur
message-queries-write-after-last-feature = écrivez ] après le dernier trait
message-queries-write-for-example-configuration-index-middle = écrivez par exemple configuration=[index middle -thumb]
message-queries-feature-missing-between-brackets = il manque un trait entre les crochets
message-queries-features-names-between-blanks-those-must = les traits sont des noms séparés par des espaces, avec un moins pour ceux qui doivent être absents : [index -thumb]
message-queries-this-no-feature = ce n’est pas un trait
message-queries-longer-than-characters = elle dépasse { $n } caractères
message-queries-needs-too-much-memory = elle demande trop de mémoire
