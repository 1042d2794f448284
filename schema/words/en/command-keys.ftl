## Messages: `{ $name }` is a variable part.

message-command-keys-there-nothing-read-write-text-from = there is nothing to read; write a text, or --from FILE

## Help of commands and options.

help-command-keys-take-phones-times-from-this-textgrid = Take phones, words or sentences and their times from this file: TextGrid, EAF, XRA, SRT, VTT or another one with annotations
help-command-keys-tier-phones-in-file-without-first = The tier of that file; without it the first whose name aligners use for phones, else for words, else the only one
help-command-keys-print-keys-cued-speech-for-text = Print the keys of cued speech for a text or for phones
help-command-keys-text-phones-separated-by-blanks-120 = The text, or the phones separated by blanks (a=120 is a phone of 120 ms); - is standard input
help-command-keys-read-input-as-text-default = Read the input as text (the default)
help-command-keys-take-pronunciation-from-program-espeak-ng = Take the pronunciation from the program espeak-ng, which must be installed
help-command-keys-habit-some-cuers-such-as-schwa = A habit of some cuers, such as schwa-as-eu; may be repeated
help-command-keys-say-words-as-this-file-does = Say words as this file does: a word and its phones on each line, a dictionary of MFA or SPPAS, or Lexique's table
help-command-keys-keep-silent-final-consonants-silent-before = Keep silent final consonants silent before a vowel
help-command-keys-pronunciation-e-at-end-word = The pronunciation of an e at the end of a word
help-command-keys-give-keys-times-duration-phones-as = Give the keys times: the duration of phones as a multiple of the usual one, from 0.1 to 10; people who cue need about 1.6
help-command-keys-key-handshape-at-placement-shape-stands = A key is a handshape at a placement: the shape stands for a consonant, the placement for a vowel. Rules of spelling turn French text into phones; `fils{ "{" }f i l{ "}" }` says a word as its braces state, and `--dictionary` brings your own pronunciations. Phones in the input are separated by blanks, or written together, as in bɔ̃ʒuʁ; `#` is a pause.
help-command-keys-json-gives-code-words-text-phones = `--json` gives "code", "words" ("text", "phones"), "keys" ("shape", "placement", "or_placement" if the vowel is uncertain, "phones" in SAMPA, "start_us", "vowel_us", "end_us": null without --pace) and "findings".

## Titles of columns.

title-command-keys-phones = phones
title-command-keys-placement = placement
title-command-keys-shape = shape
