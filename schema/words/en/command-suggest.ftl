## Messages: `{ $name }` is a variable part.

line-command-suggest-possible-pairs-in-one-sign-not = possible pairs, in which one sign is not coded for all fields ({ $n } of { $all }):
line-command-suggest-values-no-sign-has-with-rest = values of { $field } that no sign has with the rest: { $list }
message-command-suggest-no-sign-differs-from-in-one = no sign differs from it in one component only

## Help of commands and options.

help-command-suggest-suggest-new-signs-could-composed-from = Suggest new signs that could be composed from a sign
help-command-suggest-sign-gloss-token-41 = The sign: a gloss or token:41
help-command-suggest-lists-signs-differ-from-in-exactly = Lists the signs that differ from it in exactly one field (minimal pairs), each with a recipe if one generates it from the sign, and the values that no sign combines with the rest of its coding.

## Titles of columns.

title-command-suggest-alike-in = alike in
