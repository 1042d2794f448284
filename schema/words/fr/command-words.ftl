## Messages : `{ $name }` est une partie variable.

message-command-words-language-lacks-phrases = il manque { $n } phrases sur { $all } à { $language }
message-command-words-no-words-for-language = il n’y a pas de mots pour la langue { $language }
message-command-words-languages-with-words = langues qui ont des mots : { $codes }
message-command-words-phrase-written-id-text = une phrase s’écrit id = texte, avec des parties variables comme { "{" } $name { "}" }
message-command-words-folder-holds-no-words = ce dossier ne contient pas de mots
message-command-words-folder-for-each-language = un dossier de mots a un dossier pour chaque langue, comme de, avec des fichiers en .ftl
message-command-words-no-phrase-of-program = { $id } n’est pas une phrase du programme
message-command-words-variable-parts-differ = les parties variables de { $id } ne sont pas celles de : { $text }
message-command-words-words-and-variables-only = { $id } ne peut contenir que des mots et des { "{" } $variables { "}" }
message-command-words-braces-too-deep = trop d’accolades les unes dans les autres
message-command-words-read-before-added = des mots ont été lus avant que ce fichier soit ajouté

## Aide des commandes et des options.

help-command-words-list-languages-or-what-to-do = Donner les langues des programmes, ou ce qu’il reste à traduire
help-command-words-language-is-folder = Une langue est un dossier de fichiers dans la syntaxe de Fluent, comme schema/words/fr. La variable d’environnement CHEREME_WORDS nomme un dossier qui contient de tels dossiers à vous : les deux programmes et les pages publiées les lisent en plus des leurs, et --language accepte leurs noms. Ce qui manque à une langue est en anglais.
help-command-words-list-missing-phrases = Donner les phrases qui manquent à cette langue, et celles qui sont inutilisables
help-command-words-read-folder-too = Lire aussi ce dossier de langues, comme le nommerait CHEREME_WORDS

## Titres des colonnes.

title-command-words-language = langue
title-command-words-translated = traduites
title-command-words-phrases = phrases
title-command-words-english = anglais
