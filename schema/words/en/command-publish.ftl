## Messages: `{ $name }` is a variable part.

line-command-publish-published-them-with-movement = published { $signs }, { $moving } of them with movement: { $path }
line-command-publish-signers-files-kb = signers: { $n }; files: { $files }, { $size } KB
line-command-publish-terms = terms { $terms }: { $n }
message-command-publish-handshapes-with-picture-usual-one-name = handshapes with the picture of the usual one of that name: { $n }; the source may mean another one
line-command-publish-handshapes-without-picture-their-values-have = handshapes without a picture: { $n }; their values have no posture
line-command-publish-signs-whose-movement-has-no-arms = signs whose movement has no arms to show: { $n }
line-command-publish-movement-cut-after-3600-frames = movement cut after 3600 frames: { $glosses }
line-command-publish-movement-generated-from-notation = movement generated from notation: { $n }
line-command-publish-without-movement-notation-cannot-be-performed = without movement, as their notation cannot be performed: { $glosses }
line-command-publish-touch-lost-on-program-s-own = a touch is lost on the program's own body: { $glosses }
message-command-publish-minimal-pairs-left-out-there-more = minimal pairs are left out: there are more than 5,000,000, as the signs are coded in few fields
message-command-publish-without-movement = without movement: { $signs } ({ $first }): { $why }
message-command-publish-without-lexicon = without words and values of their lexicon: { $signs } ({ $first }): { $why }
message-command-publish-not-published = not published: { $signs } ({ $first }): { $why }
message-command-publish-not-stated-what-signers-agreed = it is not stated what the signers agreed to
message-command-publish-signers-did-not-agree = the signers did not agree to it
message-command-publish-no-terms-use-stated = no terms of use are stated
message-command-publish-terms-source-forbid-changes = the terms of a source forbid changes
message-command-publish-two-copies-corpus-disagree = two copies of the corpus disagree
message-command-publish-source-not-known-no-longer-there = a source is not known, or no longer there

## Help of commands and options.

help-command-publish-publish-dictionary-signs-folder-web-pages = Publish a dictionary of signs: a folder of web pages that works without a server
help-command-publish-people-search-by-word-by-drawn = People search by word, by drawn handshape, by place on the body, by movement and by one or two hands; signs that nearly fit follow those that do. Signs move in the list as the reader chooses. Each has a page with its movement and face, which can be slowed down, scrubbed, turned, mirrored and saved as a film, its words, sentences and values, its minimal pairs side by side and its terms of use. The folder opens by a double click and from any web server, in English, French and German, and asks no other computer for anything.
help-command-publish-signs-that-have-notation-no-movement = Signs that have a notation and no movement move on the program's own body, and their pages say so; --no-animation leaves them as they are.
help-command-publish-from-web-server-https-browser-keeps = From a web server (https) a browser keeps a copy of the search and of the signs that were opened, or of all signs if somebody wants that, so that the dictionary works without a connection. With a connection, each page asks first whether the copy still holds, and deletes from it what a newer publication does not have. Without one, the copy is shown for at most 30 days.
help-command-publish-with-own-body-every-sign-plays = With --own-body every sign plays on the program's own body. That removes the height and the proportions of signers, but not their rhythm and their movement, by which people are recognised, too. Hands that touch something touch it on that body, too; the report names the signs for which that failed.
help-command-publish-only-what-everybody-may-see-published = Only what everybody may see is published: recordings whose signers agreed (`chereme consent`), under stated terms, and signs made from such recordings alone. Names of signers, recordings and files stay out; remarks, too, without --notes. The report lists the signs that were left out, and why. A second publication replaces the first one, and a sign that was withdrawn leaves no trace; files of others in the folder stay.
help-command-publish-json-gives-page-signs-moving-signers = `--json` gives "page", "signs", "moving", "signers", "files", "bytes", "terms" (signs by terms of use), "undrawn" (handshapes without a picture), "namesakes" (handshapes with the picture of the usual one of that name), "armless" (signs whose movement has no arms to show), "cut" (signs whose movement is cut), "own_body", "apart" (signs with a touch that is lost on that body), "without_pairs" (whether there are too many minimal pairs), "animated" (signs that move by their notation), "unanimated" (those whose notation cannot be performed) and "left_out", each with "why", "part" ("sign", "movement", or "lexicon" for its words and values), "signs", "first" and "remedy".
help-command-publish-signs-as-query-for-their-tokens = The signs, as a query for their tokens as in `chereme search`; all signs without it
help-command-publish-folder-write = The folder to write
help-command-publish-title-pages = The title of the pages
help-command-publish-terms-use-what-shows-nobody-has = The terms of use of what shows nobody and has none: entries of tables, signs generated from notation
help-command-publish-address-people-write-also-withdraw-sign = The address to which people write, also to withdraw a sign
help-command-publish-publish-remarks-on-signs-too = Publish the remarks on signs, too
help-command-publish-leave-signs-that-have-notation = Leave signs that have a notation and no movement without movement
help-command-publish-play-every-sign-on-program-s = Play every sign on the program's own body, not on that of its signer
