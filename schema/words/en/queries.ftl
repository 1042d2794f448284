## Messages: `{ $name }` is a variable part.

message-queries-value-in-no-inventory-did-you = the value { $value } is in no inventory; did you mean { $near }?
message-queries-value-in-no-inventory = the value { $value } is in no inventory
message-queries-known-values-more = known values: { $values } and { $n } more
message-queries-known-values = known values: { $values }
message-queries-value-should-stand-here = a value should stand here
message-queries-write-value-for-any-unset-n = write a value, * for any, or unset, n/a or unclear
message-queries-there-no-field = there is no field { $name }
message-queries-no-component = { $name } is no component
message-queries-part = { $part } is a part of { $component }
message-queries-there-no-relation = there is no relation { $name }
message-queries-search-for-word-write-in-quotes = to search for the word, write it in quotes: { $word }
message-queries-hand-stands-before-not-after = the hand stands before { $component }, not after it
message-queries-this-no-regular-expression = this is no regular expression: { $reason }
message-queries-this-bracket-not-closed = this bracket is not closed
message-queries-this-value-empty = this value is empty
message-queries-this-sign-joins-nothing-here = this sign joins nothing here
message-queries-no-time = { $text } is no time
message-queries-has-no-unit = { $text } has no unit
message-queries-no-number = "{ $text }" is no number
message-queries-there-no-unit-time = there is no unit of time { $unit }
message-queries-does-not-compare-times = { $operator } does not compare times
message-queries-does-not-compare-values = { $operator } does not compare values
message-queries-does-not-compare-texts = { $operator } does not compare texts
message-queries-has-no-field-on-left = { $operator } has no field on its left
message-queries-needs-comparison-on-right = { $word } needs a comparison on its right
message-queries-within-needs-distance = `within` needs a distance
message-queries-like-needs-example = `like` needs an example
message-queries-no-likeness = { $text } is no likeness
message-queries-no-example = { $text } is no example
message-queries-saved-search = which saved search?
message-queries-ask-in-several-steps = ask in several steps
message-queries-write-number-such-as = write a number such as { $n }
message-queries-one-time-should-stand-here = one time should stand here
message-queries-names-no-component = { $name } names no component
message-queries-write-for-example-tier-mouthing-ma = write for example tier("Mouthing")=ma* or tier("Mouthing")=*
message-queries-tier-s-name-missing = the tier's name is missing
message-queries-write-after-tier-s-name-name = write ) after the tier's name; a name with blanks needs quotes
message-queries-this-parenthesis-not-closed = this parenthesis is not closed
message-queries-comparison-should-follow-tier = a comparison should follow the tier
message-queries-write-for-example-attribute-sign-frequency = write for example attribute("Sign Frequency")>2
message-queries-name-attribute-should-stand-here = the name of an attribute should stand here
message-queries-write-after-name-name-with-blanks = write ) after the name; a name with blanks needs quotes
message-queries-comparison-should-follow-attribute = a comparison should follow the attribute
message-queries-this-range-ends-before-starts = this range ends before it starts
message-queries-lesser-number-stands-first = the lesser number stands first
message-queries-shorter-time-stands-first = the shorter time stands first
message-queries-write-field-before-such-as-placement = write a field before it, such as placement=chin; text with such signs is searched in quotes
message-queries-write-word-part-one-empty-query = write a word or part of one; the empty query finds everything
message-queries-there-nothing-search-for-in-this = there is nothing to search for in this
message-queries-one-other-written-with = one or the other is written with `or`
message-queries-terms-side-by-side-must-all = terms side by side must all hold already
message-queries-write-condition-must-not-hold-with = write a condition that must not hold with `not`
message-queries-component-has-at-most-one-hand = a component has at most one hand and one phase before it
message-queries-one-too-many = { $part } is one too many
message-queries-leave-hand-out = leave the hand out
message-queries-non-manual-components-belong-no-hand = non-manual components belong to no hand
message-queries-after-component-stands-at-most-one = after a component stands at most one part of it
message-queries-write-for-example-orientation-palm-nonmanual = write for example orientation.palm or nonmanual.brows
message-queries-write-configuration-placement-movement-orientation-nonmanual = write configuration, placement, movement, orientation or nonmanual here
message-queries-gloss-with-colon-stands-after-gloss = a gloss with a colon stands after gloss= or in quotes
message-queries-fields-text-with-such-signs-searched = fields are { $names }; text with such signs is searched in quotes
message-queries-successive-values-not-compared-with = successive values are not compared with `!=`
message-queries-write-not-before-comparison-not-placement = write `not` before the comparison: not placement=head > chest
message-queries-values-compared-with-this-value-none = values are compared with =, != or == (this value and none narrower)
message-queries-only-components-have-features = only components have features
message-queries-write-name-here = write a name here
message-queries-texts-compared-with-whole-words-in = texts are compared with = (whole), : (words in it) or ~ (up to a slip)
message-queries-write-either-field-bo-field-bol = write either field:BO* or field~BOL
message-queries-wildcards-do-not-go-with = wildcards do not go with ~
message-queries-one-slip-1-nothing-two-2 = one slip is ~1 or nothing, two are ~2; a ~ inside a text needs quotes
message-queries-text-searched-up-one-two-slips = a text is searched up to one or two slips
message-queries-write-cue-24-cue-shape-5 = write cue=24, cue.shape=5, cue.placement=throat or cue.phase>100
message-queries-key-written-as-placement-shape-mouth = a key is written as placement and shape: mouth-4, or 24 with the numbers of the paper (1 side, 2 mouth, 3 chin, 4 cheek, 5 throat)
message-queries-this-no-key = this is no key
message-queries-notation-not-compared-like-this = a notation is not compared like this
message-queries-write-notation-and-symbols = write notation~ and symbols that it has, or notation= and the whole notation; `not` before it denies it
message-queries-write-symbols-as-names-or-characters = write symbols as names or characters, … for a gap, ? for any symbol, [movement] for any of a class and hamcircle* for names that begin so: notation~"hamfinger2 … hamcircle*"
message-queries-more-than-symbols-follow-each-other = more than { $n } symbols follow each other here
message-queries-no-symbol-notation-stands-here = no symbol of notation stands here
message-queries-no-class-symbols-called = no class of symbols is called { $name }: { $names }
message-queries-no-symbol-begins-with = no symbol's name begins with { $name }
message-queries-no-symbol-hamnosys = { $name } is no symbol of HamNoSys
message-queries-number-should-stand-here = a number should stand here
message-queries-write-for-example-nonmanual-brows-0 = write for example nonmanual.brows>0.5
message-queries-no-values-known-for-this-field = no values are known for this field
message-queries-value-begins-with-no-regular-expression = a value that begins with / and is no regular expression is quoted
message-queries-this-regular-expression-not-closed = this regular expression is not closed
message-queries-write-at-end = write / at its end; { $rest }
message-queries-this-quote-not-closed = this quote is not closed
message-queries-write-at-end-text = write " at the end of the text
message-queries-value-ends-before-this = a value ends before this
message-queries-successive-values-those-component-placement-head = successive values are those of a component: placement=head > chest
message-queries-value-with-in-written-in-quotes = a value with = in it is written in quotes
message-queries-blank-missing-here = a blank is missing here
message-queries-quote-inside-quoted-text-written = a quote inside a quoted text is written \"
message-queries-query-longer-than-characters = the query is longer than { $n } characters
message-queries-this-parenthesis-closes-none = this parenthesis closes none
message-queries-leave-out-open-one-before = leave it out, or open one before it
message-queries-has-nothing-join-here = { $word } has nothing to join here
message-queries-query-ends-where-term-should-stand = the query ends where a term should stand
message-queries-term-should-stand-before-this-parenthesis = a term should stand before this parenthesis
message-queries-write-comparison-beside-search-for-word = write a comparison beside it; to search for the word itself, write { $word }
message-queries-write-comparison-such-as-placement-chin = write a comparison such as placement=chin, or a word
message-queries-more-than-parentheses-negations-inside-each = more than { $n } parentheses and negations inside each other
message-queries-take-some-them-out = take some of them out
message-queries-features-need-field-before-them = features need a field before them
message-queries-list-features-value-configuration-index-thumb = a list of features is a value: configuration=[index -thumb]
message-queries-comma-stands-only-between-values-one = a comma stands only between the values of one field
message-queries-terms-side-by-side-must-all-hold = terms side by side must all hold; `or` between them means that one is enough
message-queries-write-where-group-ends = write ) where the group ends
message-queries-write-name-saved-search-with-blanks = write @ and the name of a saved search, with blanks: @"my search"
message-queries-write-within-0-5s-around-within = write within 0.5s around, within 0.5s of-begin or within 0.5s of-end
message-queries-does-not-say-what-distance-counted = { $kind } does not say what the distance is counted from
message-queries-search-for-word-write-in-quotes-2 = { $advice }; to search for the word, write it in quotes: { $word }
message-queries-write-component-gloss-tier-such-as = write a component, a gloss or a tier, such as nonmanual.brows=raised, gloss=CHAT or tier("Mouthing")=*
message-queries-successive-values-belong-one-token-not = successive values belong to one token, not to an annotation beside it
message-queries-ask-them-token-itself-placement-head = ask them of the token itself: placement=head > chest
message-queries-this-no-annotation-could-stand-in = this is no annotation that could stand in a relation of time
message-queries-write-like-token-41-like-chat = write like token:41 or like CHAT, and then, if not all components count, on configuration, placement
message-queries-does-not-follow-example = { $joint } does not follow an example
message-queries-likeness-goes-from-0-1-write = likeness goes from 0 to 1: write above 0.6, or above 60%
message-queries-example-one-token-one-sign = an example is one token or one sign
message-queries-component-should-stand-here = a component should stand here
message-queries-write-for-example-on-configuration-2 = write for example on configuration:2, placement
message-queries-no-weight = { $text } is no weight
message-queries-weight-number-above-0-at-most = a weight is a number above 0 and at most 1000, such as configuration:2
message-queries-write-0-8s-1s-0-5s = write { $name }<0.8s, { $first }>=1s or { $other }=0.5s..1s; `not` before it for the opposite
message-queries-time-should-stand-here = a time should stand here
message-queries-write-number-with-unit-0-8s = write a number with its unit: 0.8s, 800ms or 2min
message-queries-range-stands-after-as-in-duration = a range stands after =, as in duration=0.5s..1s
message-queries-times-counted-in-s-ms-min = times are counted in s, ms or min
message-queries-this-time-too-long = this time is too long
message-queries-recordings-last-hours-not-years = recordings last hours, not years
message-queries-one-several-values-written-with-commas = one of several values is written with commas: placement=chest,chin
message-queries-value-joint-written-in-quotes = a value that is a joint is written in quotes
message-queries-field-without-value-written-unset-n = a field without a value is written =unset, =n/a or =unclear
message-queries-write-for-example-placement-head-chest = write for example placement=head > chest, placement=head > * or * > chest
message-queries-more-than-values-follow-each-other = more than { $n } values follow each other here
message-queries-nothing-begins-goes-on-where-no = nothing begins or goes on where no value is
message-queries-write-after-last-feature = write ] after the last feature
message-queries-write-for-example-configuration-index-middle = write for example configuration=[index middle -thumb]
message-queries-feature-missing-between-brackets = a feature is missing between the brackets
message-queries-features-names-between-blanks-those-must = features are names between blanks, those that must be absent with a minus: [index -thumb]
message-queries-this-no-feature = this is no feature
message-queries-longer-than-characters = it is longer than { $n } characters
message-queries-needs-too-much-memory = it needs too much memory
