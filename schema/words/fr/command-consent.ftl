## Help of commands and options.

help-command-consent-state-what-signers-agreed-who-may = Indiquer ce que les signeurs ont accepté : qui peut voir leur mouvement, son annotation et les signes qui en sont faits
help-command-consent-consent-belongs-signer-one-recording-where = Un consentement appartient à un signeur ou à un enregistrement ; si les deux disent quelque chose, le plus étroit vaut. Après une fusion de copies qui ne sont pas d’accord aussi, le plus étroit vaut jusqu’à une décision (`chereme conflicts`). Sans indication, un consentement est inconnu, et `chereme publish` laisse de côté ce qu’il concerne. Un mouvement montre qui signe, même sans visage : ne l’indiquez qu’après l’accord de la personne. Sans option, les consentements sont énumérés.
help-command-consent-signers-recordings-such-as-signer-ada = Les signeurs et enregistrements, comme signer:Ada ou recording:3
help-command-consent-who-may-see-all-three-public = Qui peut voir les trois : public, research, nobody ou unknown
help-command-consent-who-may-see-recorded-movement = Qui peut voir le mouvement enregistré
help-command-consent-who-may-see-what-annotators-wrote = Qui peut voir ce que les annotateurs en ont écrit
help-command-consent-who-may-see-signs-made-from = Qui peut voir les signes qui en sont faits
help-command-consent-day-agreement-such-as-2026-11 = Le jour de l’accord, comme 2026-11-27
help-command-consent-what-signed-version-form-language = Ce qui a été signé : la version d’un formulaire, sa langue
help-command-consent-terms-use-those-recordings-have-none = Les conditions d’utilisation des enregistrements qui n’en ont pas

## Titles of columns.

title-command-consent-of = de
title-command-consent-name = nom
title-command-consent-movement = mouvement
title-command-consent-annotation = annotation
title-command-consent-derived = dérivés
title-command-consent-day = jour
title-command-consent-form = formulaire
