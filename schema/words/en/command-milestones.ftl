## Messages: `{ $name }` is a variable part.

line-command-milestones-phases-written-expressions-keep-corrected-milestones = phases written: { $n }; expressions that keep corrected milestones: { $kept }
message-command-milestones-no-tier-names-functions-annotate-wh = no tier names functions; annotate wh, yn, negation or topic on a tier called "function"
message-command-milestones-no-such-expression-functions = no such expression; the functions are: { $names }

## Help of commands and options.

help-command-milestones-derive-milestones-expressions-face-from-glosses = Derive the milestones of expressions of the face from glosses and functions, and write them as tiers
help-command-milestones-tier-names-functions-without-those-called = The tier that names functions; without it those called function, construction, clause type and the like
help-command-milestones-report-milestones-write-nothing = Report the milestones, and write nothing
help-command-milestones-tier-called-function-construction-clause-type = A tier called "function" (or construction, clause type, fonction; any other with --tier) holds an annotation such as wh, yn, negation or topic over the signs of each expression. M1 is the end of the sign before the expression, M2 the start of its first sign, M3 the start of its second sign (negation) or of its last sign (all others), M4 the end of its last sign, and M5 the start of the sign after it. If there is no sign before or after it in the utterance, M1 or M5 lies 500 ms away. The utterance is an annotation of a translation tier if there is one, otherwise the whole recording. An expression over one sign has no M3.
help-command-milestones-phases-m1-m2-m2-m3-m3 = The phases M1-M2, M2-M3, M3-M4 and M4-M5 are written on a tier such as "milestones wh". The command never changes phases that a person moved or wrote. `undo` takes the last change back.
help-command-milestones-json-gives-written-kept-functions-expressions = `--json` gives "written", "kept", "functions" and "expressions", each with "recording", "address", "function", "signs", "m1_us" to "m5_us" ("m3_us" is null for one sign), "corrected" and "findings".
help-command-milestones-all-functions-nothing-written = (all functions; nothing is written)
help-command-milestones-milestone-corrected = (a milestone corrected)

## Titles of columns.

title-command-milestones-address = address
