## Messages: `{ $name }` is a variable part.

line-command-people-united = { $names } : une seule personne avec { $name } désormais ; { $recordings }, { $tiers }
line-command-people-added = personnes ajoutées : { $n } { $names }
line-command-people-changed = personnes modifiées : { $n } { $names }
line-command-people-unchanged = personnes inchangées : { $n }
line-command-people-removed = personne supprimée : { $name }
message-command-people-consent-narrower = leurs consentements différaient : le plus étroit vaut désormais
message-command-people-consent-extended = l’un n’avait consenti à rien : ce à quoi l’autre a consenti vaut pour les deux
message-command-people-dry-run = un essai : rien n’a été modifié
message-command-people-nobody = le corpus ne connaît encore personne
message-command-people-add-option = ajoutez --name, --handedness, --notes, --alias, --no-alias, --attribute ou --for
message-command-people-name-and-text = écrivez un nom et un texte, comme region=nord

## Help of commands and options.

help-command-people-list = Lister les personnes d’un corpus, dire qui elles sont, et faire de deux noms une seule personne
help-command-people-one-name = Signeurs, participants des acteurs et annotateurs sont des personnes. Une personne a un nom que le corpus emploie, d’autres noms en nombre quelconque, sous lesquels des fichiers peuvent la connaître, et des attributs de votre choix : région, âge, école. Le signeur d’une occurrence est le participant de son acteur, sinon le signeur de son enregistrement. Les requêtes connaissent chaque nom (signer=Ada), et les attributs sous la forme signer.region=nord, signer.age>40 ; `chereme search CORPUS QUERY --count signer.region` compte selon eux.
help-command-people-audience = Un attribut est pour vous seul tant que vous ne dites pas qui d’autre peut le voir (--for). Les autres noms ne sortent jamais dans une copie pour autrui. Sans action, toutes les personnes sont listées. `--json` donne pour chacune "id", "name", "aliases", "handedness", "notes", "attributes", "recordings", "participant_tiers" et "annotator_tiers".
help-command-people-set = Dire qui est une personne : noms, main dominante, remarques et attributs
help-command-people-unite = Faire de plusieurs personnes une seule, partout : enregistrements, participants, annotateurs, noms et attributs ; annuler revient dessus
help-command-people-unite-names = Les personnes dont les noms deviennent d’autres noms
help-command-people-unite-into = La personne qui reste
help-command-people-import = Lire un tableau de personnes : une colonne name, et au besoin other names, handedness, notes ; toute autre colonne est un attribut
help-command-people-import-table = Le tableau (CSV ou TSV) ; - le lit sur l’entrée
help-command-people-import-audience = Qui peut voir ses attributs ; sans cela les nouveaux sont pour vous seul
help-command-people-import-dry-run = Dire ce qui changerait, et ne rien changer
help-command-people-remove = Supprimer une personne dont le corpus n’a ni enregistrement ni acteur
help-command-people-person = La personne, par l’un de ses noms
help-command-people-new-name = Le nouveau nom
help-command-people-keep-name = Garder l’ancien nom comme autre nom, pour que les fichiers qui le disent soient compris
help-command-people-hand = La main dominante
help-command-people-notes = Des remarques ; un texte vide les enlève
help-command-people-alias = Ajouter un autre nom
help-command-people-no-alias = Enlever un autre nom
help-command-people-attribute = Dire quelque chose de la personne, comme region=nord ; un texte vide l’enlève
help-command-people-attribute-audience = Qui peut voir les attributs donnés ; si aucun n’est donné, qui peut les voir tous

## Titles of columns.

title-command-people-other-names = autres noms
title-command-people-as-participant = acteurs comme participant
title-command-people-as-annotator = acteurs comme annotateur
