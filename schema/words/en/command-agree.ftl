## Messages: `{ $name }` is a variable part.

message-command-agree-tolerance-time-0-more = a tolerance is a time of 0 or more
line-command-agree-table-disagreements = table of disagreements: { $path }
message-command-agree-write-80ms-0-08s = write 80ms, or 0.08s
line-command-agree-on-tier-on-both-agree-decide = on the tier { $name }: { $annotations } on which both agree; { $conflicts } to decide
line-command-agree-has-units-has-in = { $a } has { $n } units and { $b } has { $m }, in { $pairs }
line-command-agree-matched-them-with-equal-values-only = matched: { $n }, { $equal } of them with equal values; only a: { $a }, only b: { $b }
message-command-agree-disagreements-in-alignment-only-only-b = disagreements in the alignment: only a { $a }, only b { $b }, other value { $value }, start or end { $boundary }
line-command-agree-start-b-less-end-median-quartiles = start of b less a: { $onset }; end: { $offset } (median and quartiles, in ms)
message-command-agree-too-few-units-values-for-figures = too few units or values for figures; with --json they are computed all the same
line-command-agree-values-not-shown-json-has-all = values that are not shown: { $n }; --json has all
line-command-agree-baseline = baseline { $name }: { $figures }

## Help of commands and options.

help-command-agree-measure-how-far-two-annotators-agree = Measure how far two annotators agree, on which values they differ, and where
help-command-agree-two-tiers-compared-in-every-recording = Two tiers are compared in every recording that has both. A tier is named by its name; by a pattern, "*-A" and "*-B", whose star stands for the same text in both; by annotator:NAME, for the tiers of both people that describe the same; or by tier:12, also of two recordings. Annotations without a value are left out; if nobody gave a value, the spans alone are compared.
help-command-agree-measures-kappa-ipf-raw-matched-kappa = Measures: kappa_ipf, raw, matched, kappa, kappa_max (ELAN's modified kappa of Holle and Rein: units match if 60 % of the longer one overlap); alpha_u, u_alpha, u_alpha_spans, cu_alpha (Krippendorff, over time); gamma, gamma_cat (Mathet, by alignment; chance is drawn as in pygamma-agreement); label_raw, label_kappa, label_pi, label_ac1, label_alpha, label_alpha_features (values of matched units alone; the last weighs the features of handshapes); overlap_a, overlap_b (ELAN's ratio of overlap, from either tier); frames_raw, frames_kappa, frames_alpha (10 ms each); boundaries (boundary similarity of tiers without gaps); segment_mf1s, segment_mf1b, segment_f1, segment_iou, segment_overlap, segment_count, segment_splits, segment_merges (spans alone on a grid of 40 ms, the tier of --a being the truth: mF1S and mF1B of Renz et al., F1 of spans that share more than half, IoU of frames, mean overlap of pairs, and for each true unit the units, splits and merges of --b). Asked for by name, and with movement, they are printed beside the simplest ways to cut the takes: uniform with the true count, every minimum of speed, one span an activity. A measure that is undefined has a reason instead of a number. With fewer than 10 units, or one value, only counts are printed.
help-command-agree-intervals-hold-95-100-draws-units = Intervals hold 95 of 100 draws of units, or of recordings if there are 10 or more. That of gamma only shows how exact its chance is: more --samples make it narrower.
help-command-agree-json-gives-b-values-units-units = `--json` gives "a", "b", "values", "units_a", "units_b", "matched", "equal", "unmatched_a", "unmatched_b", "left_out_a", "left_out_b", "counts_only", "measures" (each with "value" or null, "why", and "interval"), "onset_s" and "offset_s" (b less a: "q1", "median", "q3"), "by_value", "disagreements" (their numbers), "pairs" (each pair of tiers), "baselines" (each "baseline" with its "measures") and "findings"; with --list "list", with --confusion "confusion", with --into "adjudicated".
help-command-agree-tier-first-annotator = The tier of the first annotator
help-command-agree-tier-second-annotator = The tier of the second annotator
help-command-agree-only-this-recording = Only this recording
help-command-agree-only-these-measures-separated-by-commas = Only these measures, separated by commas; `all` prints all, and without it the usual five are printed
help-command-agree-starts-ends-further-apart-than-this = Starts or ends further apart than this are a disagreement
help-command-agree-share-longer-unit-in-percent-must = The share of the longer unit, in percent, that must overlap for a match: 51 to 100
help-command-agree-number-draws-for-intervals-0-computes = The number of draws for intervals; 0 computes none
help-command-agree-number-random-continua-for-gamma-at = The number of random continua for gamma, at least 30; 0 leaves gamma out
help-command-agree-seed-all-draws-same-seed-gives = The seed of all draws; the same seed gives the same numbers
help-command-agree-count-whole-recording-as-annotated-instead = Count the whole recording as annotated, instead of the time from the first annotation to the last
help-command-agree-list-disagreements-costliest-first = List the disagreements, the costliest first
help-command-agree-list-values-confused-features-in-they = List the values that were confused, and the features in which they differ
help-command-agree-write-disagreements-table-csv = Write the disagreements to a table (.csv)
help-command-agree-replace-table-exists-already = Replace a table that exists already
help-command-agree-write-what-both-agree-on-new = Write what both agree on to a new tier of this name, with a conflict for each disagreement, which `conflicts` decides
help-command-agree-then-decide-chereme-conflicts-mine-chereme = (then decide: chereme conflicts mine.chereme)

## Titles of columns.

title-command-agree-measure = measure
title-command-agree-draws = draws
title-command-agree-both = both
title-command-agree-other-value = other value
title-command-agree-alone = alone
title-command-agree-tier = tier a
title-command-agree-tier-b = tier b
title-command-agree-matched = matched
title-command-agree-equal = equal
title-command-agree-times = times
title-command-agree-features-alone = features of a alone
title-command-agree-features-b-alone = features of b alone
title-command-agree-from-s = from (s)
title-command-agree-s = to (s)
title-command-agree-start-ms = start (ms)
title-command-agree-end-ms = end (ms)
title-command-agree-cost = cost
