## Messages: `{ $name }` is a variable part.

line-command-people-united = { $names }: one person with { $name } now; { $recordings }, { $tiers }
line-command-people-added = people added: { $n } { $names }
line-command-people-changed = people changed: { $n } { $names }
line-command-people-unchanged = people as they were: { $n }
line-command-people-removed = person removed: { $name }
message-command-people-consent-narrower = what they agreed to differed: the narrower consent holds from now on
message-command-people-consent-extended = one of them had agreed to nothing: what the other agreed to holds for both
message-command-people-dry-run = a dry run: nothing was changed
message-command-people-nobody = the corpus knows nobody yet
message-command-people-add-option = add --name, --handedness, --notes, --alias, --no-alias, --attribute or --for
message-command-people-name-and-text = write a name and a text, such as region=north

## Help of commands and options.

help-command-people-list = List the people of a corpus, say who they are, and make two names one person
help-command-people-one-name = Signers, participants of tiers and annotators are people. A person has one name that the corpus uses, any number of other names, under which files may know them, and attributes of your choice: region, age, school. The signer of a token is the participant of its tier, or else the signer of its recording. Queries know every name (signer=Ada), and attributes as signer.region=north, signer.age>40; `chereme search CORPUS QUERY --count signer.region` counts by them.
help-command-people-audience = An attribute is for you alone until you say who else may see it (--for). Other names never leave in a copy for others. Without an action all people are listed. `--json` gives for each "id", "name", "aliases", "handedness", "notes", "attributes", "recordings", "participant_tiers" and "annotator_tiers".
help-command-people-set = Say who a person is: names, dominant hand, remarks and attributes
help-command-people-unite = Make people one, everywhere: recordings, participants, annotators, names and attributes; undo takes it back
help-command-people-unite-names = The people whose names become other names
help-command-people-unite-into = The person who stays
help-command-people-import = Read a table of people: a column name, and any of other names, handedness, notes; every other column is an attribute
help-command-people-import-table = The table (CSV or TSV); - reads it from the input
help-command-people-import-audience = Who may see its attributes; without it new ones are for you alone
help-command-people-import-dry-run = Say what would change, and change nothing
help-command-people-remove = Remove a person of whom the corpus has neither recordings nor tiers
help-command-people-person = The person, by any of their names
help-command-people-new-name = The new name
help-command-people-keep-name = Keep the former name as another name, so that files which say it are understood
help-command-people-hand = The dominant hand
help-command-people-notes = Remarks; an empty text takes them away
help-command-people-alias = Add another name
help-command-people-no-alias = Take another name away
help-command-people-attribute = Say something of the person, such as region=north; an empty text takes it away
help-command-people-attribute-audience = Who may see the attributes that are set; without any that are set, who may see all

## Titles of columns.

title-command-people-other-names = other names
title-command-people-as-participant = tiers as participant
title-command-people-as-annotator = tiers as annotator
