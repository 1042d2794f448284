## Messages: `{ $name }` is a variable part.

message-command-words-language-lacks-phrases = { $language } lacks { $n } of { $all } phrases
message-command-words-no-words-for-language = there are no words for the language { $language }
message-command-words-languages-with-words = languages with words: { $codes }
message-command-words-phrase-written-id-text = a phrase is written as id = text, with variable parts such as { "{" } $name { "}" }
message-command-words-folder-holds-no-words = this folder holds no words
message-command-words-folder-for-each-language = a folder of words has a folder for each language, such as de, with files that end in .ftl
message-command-words-no-phrase-of-program = { $id } is no phrase of the program
message-command-words-variable-parts-differ = the variable parts of { $id } are not those of: { $text }
message-command-words-words-and-variables-only = { $id } may hold words and { "{" } $variables { "}" } only
message-command-words-braces-too-deep = too many braces in each other
message-command-words-read-before-added = words were read before this file was added

## Help of commands and options.

help-command-words-list-languages-or-what-to-do = List the languages of the programs, or what a translator has to do
help-command-words-language-is-folder = A language is a folder of files in Fluent's syntax, as schema/words/fr has them. The environment variable CHEREME_WORDS names a folder with such folders of your own: both programs and published pages read them besides their own, and --language takes their names. What a language lacks is English.
help-command-words-list-missing-phrases = List the phrases that this language lacks, and those that cannot be used
help-command-words-read-folder-too = Read this folder of languages, too, as CHEREME_WORDS would name it

## Titles of columns.

title-command-words-language = language
title-command-words-translated = translated
title-command-words-phrases = phrases
title-command-words-english = English
