## Operators of recipes: the title of a card, the effect in a few words, and the effects of the examples in the help of recombine.

operator-amplify-title = Size
operator-amplify-hint = larger or smaller movement
guide-operator-amplify-larger-paths = larger paths

operator-configure-title = Handshape
operator-configure-hint = another shape of the hand
guide-operator-configure-another-handshape = another handshape
guide-operator-configure-handshapes-another-sign = the handshapes of another sign
guide-operator-configure-for-each-shape = for each shape that the sign holds in turn; _ keeps one
guide-operator-configure-best-hit-query = that of the best hit of a query

operator-span-title = Part
operator-span-hint = a part of the movement
guide-operator-span-part = a part of it
guide-operator-span-all-from-time = all from a time on

operator-trim-title = Trim
operator-trim-hint = without rest and odd first and last frames
guide-operator-trim-rest-odd-first = rest and odd first and last frames cut off

operator-indicate-title = Direct
operator-indicate-hint = between other places, as a directional verb
guide-operator-indicate-directional-verb-between = a directional verb between other places

operator-swap-title = Swap hands
operator-swap-hint = the arms exchange their movement
guide-operator-swap-arms-exchanged = the arms exchanged

operator-mirror-title = Mirror
operator-mirror-hint = one arm copies the other
guide-operator-mirror-left-arm-like = the left arm like the right one

operator-nonmanual-title = Face and head
operator-nonmanual-hint = head and face of another sign
guide-operator-nonmanual-head-face-another = head and face of another sign
guide-operator-nonmanual-expression-fitted-part = an expression, fitted to a part by its milestones

operator-face-title = Face
operator-face-hint = brows, eyes, mouth, head: values of their own
guide-operator-face-values-of-parts = brows, eyes and mouth, over a part of the sign
guide-operator-face-share-of-value = half of a value, and a shaking head
guide-operator-face-mouthing = a mouthing, by its sounds in SAMPA
guide-operator-face-face-alone-another = the face of another sign, without its head

operator-on-title = Body
operator-on-hint = on another body
guide-operator-on-another-body = on the body of another signer, or in another recording
guide-operator-on-programs-own-body = on the program's own body

operator-orient-title = Orientation
operator-orient-hint = the hands turned
guide-operator-orient-another-direction-palm = another direction of palm and fingers
guide-operator-orient-turned-about-direction = turned about a direction

operator-place-title = Place
operator-place-hint = the hands elsewhere
guide-operator-place-another-place-moved = another place: moved
guide-operator-place-at-placement-touched = at a placement, touched with the index finger
guide-operator-place-at-point-left = at a point: to the left, up from the floor, forward
guide-operator-place-at-place-another = at the place of another sign
guide-operator-place-with-another-solver = with another solver of the arms

operator-repeat-title = Repeat
operator-repeat-hint = again and again
guide-operator-repeat-again-each-smaller = again, each smaller and faster

operator-retime-title = Speed
operator-retime-hint = slower or faster
guide-operator-retime-slower-half-long = slower: half as long again
guide-operator-retime-slow-fast-time = as slow or fast as the time demands
guide-operator-retime-phase-by-phase = phase by phase

operator-reverse-title = Reverse
operator-reverse-hint = backwards
guide-operator-reverse-backwards = backwards

operator-travel-title = Path
operator-travel-hint = the hands moved along a path
guide-operator-travel-along-path-each = along a path: each leg has its own time
guide-operator-travel-along-curve-left = along a curve: left, up, forward

## Sentences of their reports, and reasons to refuse settings: `{ $name }` is a variable part.

message-operator-hands-paths-large = the hands' paths are { $share } as large
message-operator-nothing-do = nothing to do
message-operator-becomes-over-from = { $value } becomes { $other } over { $span }, from { $origin }
message-operator-shape-changes-in-s-instead-s-sign = the shape changes in { $is } s instead of { $asked } s: the sign leaves no more time
message-operator-no-value = (no value)
message-operator-no-value-given = no value is given
message-operator-movement-ends-at = the movement ends at { $time }
message-operator-kept-frames = kept { $from } to { $to } of { $all }: frames { $first } to { $last }
message-operator-movement-from-rest-back-left-out-phases = the movement from rest and back to it is left out: the phases of the sign are known
message-operator-left-out = left out { $what }
message-operator-movement-has-no-rest-before-after = the movement has no rest before or after it
message-operator-cm-nearer-far-arms-reach = { $spot } is { $cm } cm nearer, as far as the arms reach
message-operator-path-cm-became-cm = the path of { $from } cm became { $to } cm
message-operator-neither-where-starts-nor-where-ends-given = neither where it starts nor where it ends is given
message-operator-one-arm-copied-other-name-right-left = one arm is copied to the other; name right, left, dominant or weak
message-operator-hands-go-through-each-other-in-frames = the hands go through each other in { $n } frames, from { $first } on; take one aside, as with: place left by left 5cm
message-operator-joints-without-counterpart-stay-they = joints without a counterpart stay as they were: { $names }
message-operator-joints-head-from-s-stretched-s = { $n } joints of the head from { $sign } ({ $own } s stretched to { $time } s)
message-operator-movement-put-on-body = the movement is put on another body: { $body }
message-operator-movement-has-body-already-unchanged = the movement is on this body already and stays as it is: { $body }
message-operator-name-body-empty = the name of the body is empty
message-operator-signer-recording-built-in = signer:NAME, recording:NAME or built-in
message-operator-from-onto = { $function } from { $sign }: { $own } onto { $target }
message-operator-name-function-empty = the name of the function is empty
message-operator-milestones-decrease-write-m1-m5-in-order = milestones decrease; write M1 to M5 in order of time
message-operator-part-such-0-4s-1-9s-five = a part such as 0.4s..1.9s, or five times with commas between
message-operator-mouth-keeps-own-movement = the mouth keeps its own movement
message-operator-first-s-lie-before-movement-not-seen = the first { $time } s lie before the movement and are not seen
message-operator-last-s-lie-after-movement-not-seen = the last { $time } s lie after the movement and are not seen
message-operator-joints-head-trunk = { $head } joints of the head and { $trunk } of the trunk
message-operator-face-shows = the face shows { $values } from { $from } to { $to }
message-operator-face-from-s-stretched-s = the face from { $sign } ({ $own } s stretched to { $time } s)
message-operator-no-part-face-given-write-one = no part of the face is given; write one with its value, such as brows=raised
message-operator-part-with-value-such-as-brows = a part with its value, such as brows=raised (brows, eyes, cheeks, nose, mouth, mouthing, gaze, head), or "from" and a sign
message-operator-sounds-word-in-sampa-such-as = the sounds of a word in SAMPA, such as "bOl"
message-operator-hand-turned-by = the { $side } hand is turned by { $angle }
message-operator-wrist-bends-by-more-than-wrists-can = the { $limb } wrist bends by { $angle }, more than wrists can
message-operator-neither-palm-nor-fingers-nor-turn-given = neither palm nor fingers nor a turn is given
message-operator-palm-faces-across-fingers-both-cannot-have = the palm faces across the fingers, so both cannot have the same direction or opposite ones
message-operator-about-direction = "about" and a direction
message-operator-palm-fingers-by = "palm", "fingers" or "by"
message-operator-angle-such = an angle, such as { $example }
message-operator-place-from = the place is from { $origin }
message-operator-what-counts-contact-at-where-at = what counts is the contact at { $time }, where the { $part } was at the { $place }
message-operator-out-reach-wrist-stays-cm-short-at = out of reach: the wrist stays { $cm } cm short at frame { $n }
message-operator-collar-bone-helped-in-frames-beyond-arm = the collar bone helped in { $n } frames, beyond { $share } of the arm's length
message-operator-moved = moved { $way }
message-operator-hand-moved = the { $side } hand is moved { $way }
message-operator-rest-before-after-stays = the rest before { $start } and after { $end } stays as it is
message-operator-rest-before-stays = the rest before { $time } stays as it is
message-operator-rest-after-stays = the rest after { $time } stays as it is
message-operator-right-hand-kept-out-head-trunk-moved = the right hand is kept out of head and trunk: moved by up to { $rest }
message-operator-left-hand-kept-out-head-trunk-moved = the left hand is kept out of head and trunk: moved by up to { $rest }
message-operator-right-hand-cm-away-from-place-placement = the right hand is { $cm } cm away from the place, so its placement is left open
message-operator-left-hand-cm-away-from-place-placement = the left hand is { $cm } cm away from the place, so its placement is left open
message-operator-place-contact-at-at-mouth = the place is that of the contact at { $time }: the { $part } at the mouth
message-operator-place-contact-at-at-chin = the place is that of the contact at { $time }: the { $part } at the chin
message-operator-place-contact-at-at-chest = the place is that of the contact at { $time }: the { $part } at the chest
message-operator-place-contact-at-at = the place is that of the contact at { $time }: the { $part } at the { $place }
message-operator-name-placement-empty = the name of the placement is empty
message-operator-hand-by-at-near = a hand, "by", "at" or "near"
message-operator-placement-point-such-0cm-120cm-30cm = a placement or a point such as 0cm,120cm,30cm
message-operator-wrist-leaves-arm-s-reach-fast-beyond = the wrist leaves the arm's reach fast: beyond { $share }% of its length it lags behind, so that the elbow opens smoothly
message-operator-out-reach-wrist-stays-cm-short = out of reach: a wrist stays { $cm } cm short
message-operator-times-frames-between = { $times } times, { $gap } frames between
message-operator-hands-do-not-go-back-rest-between = the hands do not go back to rest between them
message-operator-repetition = repetition { $n } to { $next }: { $what }
message-operator-repetition-2 = repetition { $n }: { $what }
message-operator-repetition-3 = repetition { $one } to { $next }
message-operator-how-often-such-2 = how often, such as 2
message-operator-number-times = the number of times
message-operator-s-became-s = { $from } s became { $to } s
message-operator-no-pace-given = no pace is given
message-operator-factor-such-150-time = a factor, such as 150%, or "to" and a time
message-operator-frames-played-backwards = { $n } frames played backwards
message-operator-no-longer-written-runs-other-way = { $component } { $value } is no longer written: it runs the other way
message-operator-sign-became-s-long-instead-s-path = the sign became { $to } s long instead of { $from } s, so that the path has its time
message-operator-time-after-via-not-used-legs-curves = the time after "via" is not used: legs and curves have their own, such as left 5cm in 0.2s
message-operator-legs-take = the legs take { $times }
message-operator-cm-in-s-faster-than-people-sign = { $cm } cm in { $time } s is faster than people sign
message-operator-1-leg-cm-in-all = 1 leg, { $cm } cm in all
message-operator-legs-cm-in-all = { $n } legs, { $cm } cm in all
message-operator-legs-curve-given-keep-one-them = legs and a curve are given: keep one of them
message-operator-only-curve-has-time-each-leg-has = only a curve has a time; each leg has its own, such as left 5cm in 0.2s
message-operator-curve-has-more-than-64-points = the curve has more than 64 points
message-operator-curve-cm = a curve of { $cm } cm ({ $what })

setting-hand = Hand
setting-transition = Transition
setting-times = How often
setting-scale = size
setting-tempo = tempo
setting-gap = gap
setting-from-sign = from sign
setting-copied-from = copied from the
setting-from-spot = from
setting-to-spot = to
setting-from-time = from
setting-to-time = to
setting-size = Size
setting-face = Face
setting-body = Body
