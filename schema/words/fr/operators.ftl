## Opérateurs des recettes : le titre d’une carte, l’effet en quelques mots, et les effets des exemples dans l’aide de recombine.

operator-amplify-title = Ampleur
operator-amplify-hint = mouvement plus ample ou plus petit
guide-operator-amplify-larger-paths = de plus grands trajets

operator-configure-title = Configuration
operator-configure-hint = une autre forme de la main
guide-operator-configure-another-handshape = une autre configuration
guide-operator-configure-handshapes-another-sign = les configurations d’un autre signe
guide-operator-configure-for-each-shape = pour chaque forme que le signe tient tour à tour ; _ en garde une
guide-operator-configure-best-hit-query = celle du meilleur résultat d’une requête

operator-span-title = Extrait
operator-span-hint = une partie du mouvement
guide-operator-span-part = une partie
guide-operator-span-all-from-time = tout à partir d’un temps

operator-trim-title = Rogner
operator-trim-hint = sans repos ni images fausses au début et à la fin
guide-operator-trim-rest-odd-first = le repos et les images fausses des bouts coupés

operator-indicate-title = Diriger
operator-indicate-hint = entre d’autres lieux, comme un verbe directionnel
guide-operator-indicate-directional-verb-between = un verbe directionnel entre d’autres lieux

operator-swap-title = Échanger les mains
operator-swap-hint = les bras échangent leurs rôles
guide-operator-swap-arms-exchanged = les bras échangés

operator-mirror-title = Miroir
operator-mirror-hint = un bras copie l’autre
guide-operator-mirror-left-arm-like = le bras gauche comme le droit

operator-nonmanual-title = Visage et tête
operator-nonmanual-hint = tête et visage d’un autre signe
guide-operator-nonmanual-head-face-another = tête et visage d’un autre signe
guide-operator-nonmanual-expression-fitted-part = une expression, ajustée à une partie par ses jalons

operator-face-title = Visage
operator-face-hint = sourcils, yeux, bouche, tête : des valeurs propres
guide-operator-face-values-of-parts = sourcils, yeux et bouche, sur une partie du signe
guide-operator-face-share-of-value = la moitié d’une valeur, et la tête qui secoue
guide-operator-face-mouthing = une labialisation, par ses sons en SAMPA
guide-operator-face-face-alone-another = le visage d’un autre signe, sans sa tête

operator-on-title = Corps
operator-on-hint = sur un autre corps
guide-operator-on-another-body = sur le corps d’un autre signeur, ou d’un autre enregistrement
guide-operator-on-programs-own-body = sur le corps du programme

operator-orient-title = Orientation
operator-orient-hint = les mains tournées
guide-operator-orient-another-direction-palm = une autre direction de la paume et des doigts
guide-operator-orient-turned-about-direction = tournée autour d’un axe

operator-place-title = Emplacement
operator-place-hint = les mains ailleurs
guide-operator-place-another-place-moved = un autre emplacement : déplacé
guide-operator-place-at-placement-touched = à un emplacement, touché de l’index
guide-operator-place-at-point-left = à un point : à gauche, au-dessus du sol, en avant
guide-operator-place-at-place-another = à l’emplacement d’un autre signe
guide-operator-place-with-another-solver = avec une autre méthode pour les bras

operator-repeat-title = Répéter
operator-repeat-hint = encore et encore
guide-operator-repeat-again-each-smaller = de nouveau, toujours plus petit et plus vite

operator-retime-title = Vitesse
operator-retime-hint = plus lent ou plus vite
guide-operator-retime-slower-half-long = plus lent : une fois et demie la durée
guide-operator-retime-slow-fast-time = aussi lent ou vite que la durée le veut
guide-operator-retime-phase-by-phase = phase par phase

operator-reverse-title = Inverser
operator-reverse-hint = à l’envers
guide-operator-reverse-backwards = à l’envers

operator-travel-title = Trajet
operator-travel-hint = les mains portées le long d’un chemin
guide-operator-travel-along-path-each = le long d’un trajet : chaque étape a son temps
guide-operator-travel-along-curve-left = le long d’une courbe : gauche, haut, avant

## Phrases de leurs comptes rendus, et raisons de refuser des réglages : `{ $name }` est une partie variable.

message-operator-hands-paths-large = les trajets des mains font { $share } de leur taille
message-operator-nothing-do = rien à faire
message-operator-becomes-over-from = { $value } devient { $other } sur { $span }, d’après { $origin }
message-operator-shape-changes-in-s-instead-s-sign = la forme change en { $is } s au lieu de { $asked } s : le signe ne laisse pas plus de temps
message-operator-no-value = (sans valeur)
message-operator-no-value-given = aucune valeur n’est donnée
message-operator-movement-ends-at = le mouvement finit à { $time }
message-operator-kept-frames = gardé de { $from } à { $to } sur { $all } : images { $first } à { $last }
message-operator-movement-from-rest-back-left-out-phases = le mouvement depuis le repos et vers lui est laissé de côté : les phases du signe sont connues
message-operator-left-out = laissé de côté : { $what }
message-operator-movement-has-no-rest-before-after = le mouvement n’a pas de repos avant ou après
message-operator-cm-nearer-far-arms-reach = { $spot } est plus près de { $cm } cm, autant que les bras atteignent
message-operator-path-cm-became-cm = le trajet de { $from } cm est devenu { $to } cm
message-operator-neither-where-starts-nor-where-ends-given = ni son départ ni son arrivée ne sont donnés
message-operator-one-arm-copied-other-name-right-left = un bras est copié sur l’autre ; nommez right, left, dominant ou weak
message-operator-hands-go-through-each-other-in-frames = les mains se traversent dans { $n } images, à partir de { $first } ; écartez-en une, comme avec : place left by left 5cm
message-operator-joints-without-counterpart-stay-they = les articulations sans pendant restent comme elles étaient : { $names }
message-operator-joints-head-from-s-stretched-s = { $n } articulations de la tête d’après { $sign } ({ $own } s étirées à { $time } s)
message-operator-movement-put-on-body = le mouvement est mis sur un autre corps : { $body }
message-operator-movement-has-body-already-unchanged = le mouvement est déjà sur ce corps et reste tel quel : { $body }
message-operator-name-body-empty = le nom du corps est vide
message-operator-signer-recording-built-in = signer:NOM, recording:NOM ou built-in
message-operator-from-onto = { $function } d’après { $sign } : { $own } sur { $target }
message-operator-name-function-empty = le nom de la fonction est vide
message-operator-milestones-decrease-write-m1-m5-in-order = les jalons reculent ; écrivez M1 à M5 dans l’ordre du temps
message-operator-part-such-0-4s-1-9s-five = une partie comme 0.4s..1.9s, ou cinq temps séparés par des virgules
message-operator-mouth-keeps-own-movement = la bouche garde son propre mouvement
message-operator-first-s-lie-before-movement-not-seen = les premières { $time } s sont avant le mouvement et ne se voient pas
message-operator-last-s-lie-after-movement-not-seen = les dernières { $time } s sont après le mouvement et ne se voient pas
message-operator-joints-head-trunk = { $head } articulations de la tête et { $trunk } du tronc
message-operator-face-shows = le visage montre { $values } de { $from } à { $to }
message-operator-face-from-s-stretched-s = le visage de { $sign } ({ $own } s étirées à { $time } s)
message-operator-no-part-face-given-write-one = aucune partie du visage n’est donnée ; écrivez-en une avec sa valeur, comme brows=raised
message-operator-part-with-value-such-as-brows = une partie avec sa valeur, comme brows=raised (brows, eyes, cheeks, nose, mouth, mouthing, gaze, head), ou « from » et un signe
message-operator-sounds-word-in-sampa-such-as = les sons d’un mot en SAMPA, comme « bOl »
message-operator-hand-turned-by = la main { $side } est tournée de { $angle }
message-operator-wrist-bends-by-more-than-wrists-can = le poignet { $limb } se plie de { $angle }, plus qu’un poignet ne peut
message-operator-neither-palm-nor-fingers-nor-turn-given = ni la paume, ni les doigts, ni une rotation ne sont donnés
message-operator-palm-faces-across-fingers-both-cannot-have = la paume est tournée en travers des doigts : ils ne peuvent avoir ni la même direction, ni des directions opposées
message-operator-about-direction = "about" et une direction
message-operator-palm-fingers-by = "palm", "fingers" ou "by"
message-operator-angle-such = un angle, comme { $example }
message-operator-place-from = l’emplacement vient de { $origin }
message-operator-what-counts-contact-at-where-at = ce qui compte est le contact à { $time }, où { $part } était à : { $place }
message-operator-out-reach-wrist-stays-cm-short-at = hors de portée : il manque { $cm } cm au poignet à l’image { $n }
message-operator-collar-bone-helped-in-frames-beyond-arm = la clavicule a aidé dans { $n } images, au-delà de { $share } de la longueur du bras
message-operator-moved = déplacé : { $way }
message-operator-hand-moved = la main { $side } est déplacée : { $way }
message-operator-rest-before-after-stays = le repos avant { $start } et après { $end } reste tel quel
message-operator-rest-before-stays = le repos avant { $time } reste tel quel
message-operator-rest-after-stays = le repos après { $time } reste tel quel
message-operator-right-hand-kept-out-head-trunk-moved = la main droite est tenue hors de la tête et du tronc : déplacée de { $rest }
message-operator-left-hand-kept-out-head-trunk-moved = la main gauche est tenue hors de la tête et du tronc : déplacée de { $rest }
message-operator-right-hand-cm-away-from-place-placement = la main droite est à { $cm } cm du lieu, son emplacement reste donc ouvert
message-operator-left-hand-cm-away-from-place-placement = la main gauche est à { $cm } cm du lieu, son emplacement reste donc ouvert
message-operator-place-contact-at-at-mouth = l’emplacement est celui du contact à { $time } : { $part } à la bouche
message-operator-place-contact-at-at-chin = l’emplacement est celui du contact à { $time } : { $part } au menton
message-operator-place-contact-at-at-chest = l’emplacement est celui du contact à { $time } : { $part } à la poitrine
message-operator-place-contact-at-at = l’emplacement est celui du contact à { $time } : { $part } à { $place }
message-operator-name-placement-empty = le nom de l’emplacement est vide
message-operator-hand-by-at-near = une main, "by", "at" ou "near"
message-operator-placement-point-such-0cm-120cm-30cm = un emplacement ou un point comme 0cm,120cm,30cm
message-operator-wrist-leaves-arm-s-reach-fast-beyond = le poignet quitte vite la portée du bras : au-delà de { $share } % de sa longueur il prend du retard, pour que le coude s’ouvre sans à-coup
message-operator-out-reach-wrist-stays-cm-short = hors de portée : il manque { $cm } cm à un poignet
message-operator-times-frames-between = { $times } fois, { $gap } images entre deux
message-operator-hands-do-not-go-back-rest-between = les mains ne reviennent pas au repos entre deux
message-operator-repetition = répétition { $n } à { $next } : { $what }
message-operator-repetition-2 = répétition { $n } : { $what }
message-operator-repetition-3 = de la répétition { $one } à { $next }
message-operator-how-often-such-2 = combien de fois, comme 2
message-operator-number-times = le nombre de fois
message-operator-s-became-s = { $from } s sont devenus { $to } s
message-operator-no-pace-given = aucune allure n’est donnée
message-operator-factor-such-150-time = un facteur, comme 150%, ou "to" et un temps
message-operator-frames-played-backwards = { $n } images jouées à l’envers
message-operator-no-longer-written-runs-other-way = { $component } { $value } n’est plus dit : il va dans l’autre sens
message-operator-sign-became-s-long-instead-s-path = le signe dure { $to } s au lieu de { $from } s, pour que le trajet ait son temps
message-operator-time-after-via-not-used-legs-curves = le temps après "via" n’est pas utilisé : segments et courbes ont le leur, comme left 5cm in 0.2s
message-operator-legs-take = les étapes durent { $times }
message-operator-cm-in-s-faster-than-people-sign = { $cm } cm en { $time } s, c’est plus vite qu’on ne signe
message-operator-1-leg-cm-in-all = 1 étape, { $cm } cm en tout
message-operator-legs-cm-in-all = { $n } étapes, { $cm } cm en tout
message-operator-legs-curve-given-keep-one-them = des segments et une courbe sont donnés : gardez l’un des deux
message-operator-only-curve-has-time-each-leg-has = seule une courbe a un temps ; chaque segment a le sien, comme left 5cm in 0.2s
message-operator-curve-has-more-than-64-points = la courbe a plus de 64 points
message-operator-curve-cm = une courbe de { $cm } cm ({ $what })

setting-hand = Main
setting-transition = Transition
setting-times = Combien de fois
setting-scale = taille
setting-tempo = tempo
setting-gap = pause
setting-from-sign = du signe
setting-copied-from = copié de la
setting-from-spot = de
setting-to-spot = à
setting-from-time = à partir de
setting-to-time = jusqu’à
setting-size = Ampleur
setting-face = Visage
setting-body = Corps
