## Messages: `{ $name }` is a variable part.

message-command-agree-tolerance-time-0-more = une tolérance est un temps, 0 ou plus
line-command-agree-table-disagreements = table des désaccords : { $path }
message-command-agree-write-80ms-0-08s = écrivez 80ms, ou 0.08s
line-command-agree-on-tier-on-both-agree-decide = sur l’acteur { $name } : accord des deux pour { $annotations } ; à trancher : { $conflicts }
line-command-agree-has-units-has-in = unités de { $a } : { $n } ; de { $b } : { $m } ; dans { $pairs }
line-command-agree-matched-them-with-equal-values-only = en correspondance : { $n }, dont de même valeur : { $equal } ; seulement a : { $a }, seulement b : { $b }
message-command-agree-disagreements-in-alignment-only-only-b = désaccords dans l’alignement : seulement a { $a }, seulement b { $b }, autre valeur { $value }, début ou fin { $boundary }
line-command-agree-start-b-less-end-median-quartiles = début de b moins a : { $onset } ; fin : { $offset } (médiane et quartiles, en ms)
message-command-agree-too-few-units-values-for-figures = trop peu d’unités ou de valeurs pour des mesures ; --json les calcule quand même
line-command-agree-values-not-shown-json-has-all = valeurs qui ne sont pas affichées : { $n } ; --json les a toutes
line-command-agree-baseline = référence { $name } : { $figures }

## Help of commands and options.

help-command-agree-measure-how-far-two-annotators-agree = Mesurer l’accord de deux annotateurs, sur quelles valeurs ils diffèrent, et où
help-command-agree-two-tiers-compared-in-every-recording = Deux acteurs sont comparés dans chaque enregistrement qui a les deux. Un acteur se nomme par son nom ; par un motif, « *-A » et « *-B », où l’étoile est le même texte des deux côtés ; par annotator:NOM, et les acteurs qui décrivent la même chose sont comparés ; ou par tier:12, même de deux enregistrements. Les annotations sans valeur sont laissées de côté ; si personne n’a donné de valeur, seules les durées sont comparées.
help-command-agree-measures-kappa-ipf-raw-matched-kappa = Mesures : kappa_ipf, raw, matched, kappa, kappa_max (le kappa modifié de Holle et Rein, comme dans ELAN : deux unités se correspondent si 60 % de la plus longue sont communs) ; alpha_u, u_alpha, u_alpha_spans, cu_alpha (Krippendorff, sur le temps) ; gamma, gamma_cat (Mathet, par alignement ; le hasard est tiré comme dans pygamma-agreement) ; label_raw, label_kappa, label_pi, label_ac1, label_alpha, label_alpha_features (valeurs des seules unités qui se correspondent ; la dernière pèse les traits des configurations) ; overlap_a, overlap_b (le taux de recouvrement d’ELAN, depuis chaque acteur) ; frames_raw, frames_kappa, frames_alpha (10 ms chacune) ; boundaries (similarité des frontières d’acteurs sans vides) ; segment_mf1s, segment_mf1b, segment_f1, segment_iou, segment_overlap, segment_count, segment_splits, segment_merges (les étendues seules sur une grille de 40 ms, l’acteur de --a étant la vérité : mF1S et mF1B de Renz et al., F1 des étendues qui partagent plus de la moitié, IoU des images, recouvrement moyen des paires, et pour chaque unité vraie les unités, divisions et fusions de --b). Demandées par leur nom, et avec un mouvement, elles sont affichées à côté des façons les plus simples de découper les prises : uniforme avec le vrai nombre, chaque minimum de vitesse, une étendue par activité. Une mesure indéfinie a une raison au lieu d’un nombre. Avec moins de 10 unités, ou une seule valeur, seuls des nombres d’unités sont affichés.
help-command-agree-intervals-hold-95-100-draws-units = Les intervalles contiennent 95 tirages sur 100, d’unités, ou d’enregistrements s’il y en a 10 ou plus. Celui de gamma ne montre que la précision de son hasard : plus de --samples le resserrent.
help-command-agree-json-gives-b-values-units-units = `--json` donne "a", "b", "values", "units_a", "units_b", "matched", "equal", "unmatched_a", "unmatched_b", "left_out_a", "left_out_b", "counts_only", "measures" (chacune avec "value" ou null, "why" et "interval"), "onset_s" et "offset_s" (b moins a : "q1", "median", "q3"), "by_value", "disagreements" (leurs nombres), "pairs" (chaque paire d’acteurs), "baselines" (chaque "baseline" avec ses "measures") et "findings" ; avec --list "list", avec --confusion "confusion", avec --into "adjudicated".
help-command-agree-tier-first-annotator = L’acteur du premier annotateur
help-command-agree-tier-second-annotator = L’acteur du second annotateur
help-command-agree-only-this-recording = Seulement cet enregistrement
help-command-agree-only-these-measures-separated-by-commas = Seulement ces mesures, séparées par des virgules ; `all` les affiche toutes, et sans cette option les cinq usuelles sont affichées
help-command-agree-starts-ends-further-apart-than-this = Des débuts ou des fins plus éloignés que cela sont un désaccord
help-command-agree-share-longer-unit-in-percent-must = La part de l’unité la plus longue, en pour cent, qui doit être commune pour une correspondance : 51 à 100
help-command-agree-number-draws-for-intervals-0-computes = Le nombre de tirages pour les intervalles ; 0 n’en calcule aucun
help-command-agree-number-random-continua-for-gamma-at = Le nombre de continus aléatoires pour gamma, au moins 30 ; 0 omet gamma
help-command-agree-seed-all-draws-same-seed-gives = La graine de tous les tirages ; la même graine donne les mêmes nombres
help-command-agree-count-whole-recording-as-annotated-instead = Compter tout l’enregistrement comme annoté, au lieu du temps de la première annotation à la dernière
help-command-agree-list-disagreements-costliest-first = Énumérer les désaccords, les plus coûteux d’abord
help-command-agree-list-values-confused-features-in-they = Énumérer les valeurs confondues, et les traits par lesquels elles diffèrent
help-command-agree-write-disagreements-table-csv = Écrire les désaccords dans une table (.csv)
help-command-agree-replace-table-exists-already = Remplacer une table qui existe déjà
help-command-agree-write-what-both-agree-on-new = Écrire ce sur quoi les deux s’accordent sur un nouvel acteur de ce nom, avec un conflit par désaccord, que `conflicts` tranche
help-command-agree-then-decide-chereme-conflicts-mine-chereme = (puis trancher : chereme conflicts mine.chereme)

## Titles of columns.

title-command-agree-measure = mesure
title-command-agree-draws = tirages
title-command-agree-both = les deux
title-command-agree-other-value = autre valeur
title-command-agree-alone = seul
title-command-agree-tier = acteur a
title-command-agree-tier-b = acteur b
title-command-agree-matched = correspond
title-command-agree-equal = égal
title-command-agree-times = fois
title-command-agree-features-alone = traits de a seul
title-command-agree-features-b-alone = traits de b seul
title-command-agree-from-s = de (s)
title-command-agree-s = à (s)
title-command-agree-start-ms = début (ms)
title-command-agree-end-ms = fin (ms)
title-command-agree-cost = coût
