## Messages: `{ $name }` is a variable part.

message-filming-film-recording-names = c’est le film que nomme l’enregistrement { $name }
message-filming-pictures-coded-as-played-through-ffmpeg = ses images sont codées en { $coding }, qui se joue par ffmpeg s’il est installé
message-filming-install-ffmpeg-convert-film-once = installez ffmpeg, ou convertissez le film une fois : { $command }
message-filming-install-ffmpeg-used-then-convert-film = installez ffmpeg, qui est alors utilisé ; ou convertissez le film une fois, là où il y a ffmpeg : { $command }
message-filming-film-cannot-read = le film ne se lit pas : { $why }
message-filming-export-copy-again-from-where-recorded = exportez-le ou copiez-le de nouveau depuis l’appareil qui l’a enregistré
message-filming-film-cannot-played-program-itself-plays = le film ne se joue pas : { $why } ; le programme lui-même joue du H.264 (8 bits, 4:2:0, non entrelacé) dans des fichiers MP4 ou MOV
message-filming-film-cannot-played = le film ne se joue pas : { $why }
message-filming-ffmpeg-finds-no-pictures-in = ffmpeg n’y trouve pas d’images
message-filming-has-no-frames = il n’a pas d’images
message-filming-frame-film-cannot-decoded-by-ffmpeg = l’image { $n } du film ne se décode pas par ffmpeg
message-filming-frame-film-cannot-decoded = l’image { $n } du film ne se décode pas : { $why }
message-filming-file-damaged-there-copy-again-look = le fichier est abîmé à cet endroit ; copiez-le de nouveau, ou regardez une autre image
message-filming-no-mp4-quicktime-film = ni un film MP4 ni un film QuickTime
message-filming-film-has-no-frame-frames-0 = le film n’a pas d’image { $n } ; ses images sont 0 à { $last }
message-filming-frame-film-not-found = l’image { $n } du film est introuvable
message-filming-file-cut-short = le fichier est tronqué
message-filming-decoder-gave-up = le décodeur a abandonné
message-filming-not-whole = il n’est pas entier
message-filming-pictures-coded = images codées : { $n } sur { $all }
message-filming-film-cannot-written = le film ne s’écrit pas : { $why }
message-filming-film-by-pixels-at-pictures-second = un film de { $width } sur { $height } pixels à { $rate } images par seconde est trop grand pour les lecteurs
message-filming-make-lower-with-height-draw-fewer = rendez-le moins haut avec --height, dessinez moins d’extraits côte à côte, ou baissez --rate
message-filming-film-cannot-coded = le film ne se code pas : { $why }
