## Messages: `{ $name }` is a variable part.

line-command-publish-published-them-with-movement = publié : { $signs }, dont avec mouvement { $moving } : { $path }
line-command-publish-signers-files-kb = signeurs : { $n } ; fichiers : { $files }, { $size } Ko
line-command-publish-terms = conditions { $terms } : { $n }
message-command-publish-handshapes-with-picture-usual-one-name = configurations avec l’image de la configuration usuelle de ce nom : { $n } ; la source peut en entendre une autre
line-command-publish-handshapes-without-picture-their-values-have = configurations sans image : { $n } ; leurs valeurs n’ont pas de posture
line-command-publish-signs-whose-movement-has-no-arms = signes dont le mouvement n’a pas de bras à montrer : { $n }
line-command-publish-movement-cut-after-3600-frames = mouvement coupé après 3600 images : { $glosses }
line-command-publish-movement-generated-from-notation = mouvement généré d’après la notation : { $n }
line-command-publish-without-movement-notation-cannot-be-performed = sans mouvement, car leur notation ne peut être jouée : { $glosses }
line-command-publish-touch-lost-on-program-s-own = un contact est perdu sur le corps du programme : { $glosses }
message-command-publish-minimal-pairs-left-out-there-more = les paires minimales sont laissées de côté : il y en a plus de 5 000 000, car les signes sont codés dans peu de champs
message-command-publish-without-movement = sans mouvement : { $signs } ({ $first }) : { $why }
message-command-publish-without-lexicon = sans les mots ni les valeurs de leur lexique : { $signs } ({ $first }) : { $why }
message-command-publish-not-published = non publiés : { $signs } ({ $first }) : { $why }
message-command-publish-not-stated-what-signers-agreed = il n’est pas indiqué ce que les signeurs ont accepté
message-command-publish-signers-did-not-agree = les signeurs n’ont pas donné leur accord
message-command-publish-no-terms-use-stated = aucune condition d’utilisation n’est indiquée
message-command-publish-terms-source-forbid-changes = les conditions d’une source interdisent les modifications
message-command-publish-two-copies-corpus-disagree = deux copies du corpus ne sont pas d’accord
message-command-publish-source-not-known-no-longer-there = une source n’est pas connue, ou n’existe plus

## Help of commands and options.

help-command-publish-publish-dictionary-signs-folder-web-pages = Publier un dictionnaire de signes : un dossier de pages web qui fonctionne sans serveur
help-command-publish-people-search-by-word-by-drawn = On cherche par mot, par configuration dessinée, par emplacement sur le corps, par mouvement, par une ou deux mains ; les signes qui conviennent presque suivent ceux qui conviennent. Les signes bougent dans la liste comme la personne qui lit le choisit. Chacun a une page avec son mouvement et son visage, que l’on peut ralentir, parcourir, tourner, inverser et enregistrer en film, ses mots, ses phrases et ses valeurs, ses paires minimales côte à côte et ses conditions d’utilisation. Le dossier s’ouvre d’un double clic et depuis tout serveur web, en anglais, en français et en allemand, et ne demande rien à un autre ordinateur.
help-command-publish-signs-that-have-notation-no-movement = Les signes qui ont une notation et pas de mouvement bougent sur le corps du programme, et leurs pages le disent ; --no-animation les laisse tels quels.
help-command-publish-from-web-server-https-browser-keeps = Depuis un serveur web (https), un navigateur garde une copie de la recherche et des signes ouverts, ou de tous les signes si quelqu’un le veut, pour que le dictionnaire fonctionne sans connexion. Avec une connexion, chaque page demande d’abord si la copie vaut encore, et en supprime ce qu’une publication plus récente n’a pas. Sans connexion, la copie est montrée pendant 30 jours au plus.
help-command-publish-with-own-body-every-sign-plays = Avec --own-body, chaque signe est joué par le corps du programme. Cela retire la taille et les proportions des signeurs, mais pas leur rythme ni leur mouvement, auxquels on reconnaît aussi les personnes. Les mains qui touchent quelque chose le touchent aussi sur ce corps ; le compte rendu nomme les signes pour lesquels cela a échoué.
help-command-publish-only-what-everybody-may-see-published = Seul est publié ce que tout le monde peut voir : les enregistrements dont les signeurs ont donné leur accord (`chereme consent`), sous des conditions indiquées, et ce qui n’est fait que de tels enregistrements. Les noms des signeurs, des enregistrements et des fichiers restent dehors ; les remarques aussi, sans --notes. Le compte rendu dit ce qui a été laissé de côté et pourquoi. Une deuxième publication remplace la première, et un signe retiré ne laisse pas de trace ; les fichiers d’autrui dans le dossier restent.
help-command-publish-json-gives-page-signs-moving-signers = `--json` donne "page", "signs", "moving", "signers", "files", "bytes", "terms" (signes par conditions d’utilisation), "undrawn" (configurations sans image), "namesakes" (configurations avec l’image de la configuration usuelle de ce nom), "armless" (signes dont le mouvement n’a pas de bras à montrer), "cut" (signes dont le mouvement est coupé), "own_body", "apart" (signes dont un contact est perdu sur ce corps), "without_pairs" (s’il y a trop de paires minimales), "animated" (signes qui bougent d’après leur notation), "unanimated" (ceux dont la notation ne peut être jouée) et "left_out", chacun avec "why", "part" ("sign" pour le signe entier, "movement", ou "lexicon" pour ses mots et ses valeurs), "signs", "first" et "remedy".
help-command-publish-signs-as-query-for-their-tokens = Les signes, par une requête de leurs occurrences comme dans `chereme search` ; tous les signes sans elle
help-command-publish-folder-write = Le dossier à écrire
help-command-publish-title-pages = Le titre des pages
help-command-publish-terms-use-what-shows-nobody-has = Les conditions d’utilisation de ce qui ne montre personne et n’en a pas : entrées de tables, signes générés à partir d’une notation
help-command-publish-address-people-write-also-withdraw-sign = L’adresse à laquelle on écrit, aussi pour retirer un signe
help-command-publish-publish-remarks-on-signs-too = Publier aussi les remarques sur les signes
help-command-publish-leave-signs-that-have-notation = Laisser sans mouvement les signes qui ont une notation et pas de mouvement
help-command-publish-play-every-sign-on-program-s = Jouer chaque signe sur le corps du programme, pas sur celui de son signeur
