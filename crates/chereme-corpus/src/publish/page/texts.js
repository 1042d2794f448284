"use strict";
const TEXTS = {
  en: {
    language: "Français", search: "Search a word", clear: "Start again", shape: "Handshape", place: "Place", movement: "Movement", hands: "Hands",
    one: "one hand", two: "two hands", any: "any", signs: "{n} signs", sign: "1 sign", none: "No sign is exactly so.", near: "Nearly so", differs: "differs: {what}", unknown: "not coded",
    more: "Show more", groups: { fist: "fist", thumb: "thumb", index: "index", little: "little finger", two: "two fingers", three: "three fingers", four: "four fingers", five: "all fingers", ring: "fingers and thumb opposed", other: "others", word: "without a picture" },
    all: "all of them", like: "no picture; named after {shape}", namesakes: "The pictures show the usual handshapes of these names. The source may mean slightly different ones.", panels: { head: "head", space: "before the signer", trunk: "body", hand: "the other hand" },
    play: "Play", pause: "Pause", slow: "Speed", back: "One frame back", next: "One frame on", mirror: "Mirror", camera: "Camera", front: "front", side: "side", near2: "hands",
    keys: "Space: play or pause · , and . : one frame · S: speed · M: mirror · C: camera", still: "Your browser cannot show the movement (no WebGL 2). The picture shows its middle.", missing: "The movement could not be loaded.",
    about: "One choice of each kind is enough. Signs that nearly fit follow after those that fit.", keysSearch: "/ : search · arrows: choose · Esc: start again", image: "movement of {gloss}",
    copyPart: "This device keeps a copy of the search and of the signs that were opened, for use without a connection.", copyAll: "This device keeps a copy of all signs, for use without a connection.", copyBegins: "The copy begins.", copyBusy: "Copied so far: {kept} of {files} files.",
    copyFailed: "The copy is not complete: {kept} of {files} files.", copyNone: "This device keeps no copy.", copyKeep: "Keep all signs ({size} MB)", copyAgain: "Keep all signs", copyForget: "Delete the copy",
  },
  fr: {
    language: "English", search: "Chercher un mot", clear: "Recommencer", shape: "Configuration", place: "Emplacement", movement: "Mouvement", hands: "Mains",
    one: "une main", two: "deux mains", any: "toutes", signs: "{n} signes", sign: "1 signe", none: "Aucun signe n’est exactement ainsi.", near: "Presque ainsi", differs: "différence : {what}", unknown: "non codé",
    more: "En voir plus", groups: { fist: "poing", thumb: "pouce", index: "index", little: "auriculaire", two: "deux doigts", three: "trois doigts", four: "quatre doigts", five: "tous les doigts", ring: "doigts opposés au pouce", other: "autres", word: "sans image" },
    all: "toutes", like: "sans image ; nommée d’après {shape}", namesakes: "Les images montrent les configurations usuelles de ces noms. La source peut en entendre de légèrement différentes.", panels: { head: "tête", space: "devant le signeur", trunk: "corps", hand: "l’autre main" },
    play: "Lire", pause: "Pause", slow: "Vitesse", back: "Image précédente", next: "Image suivante", mirror: "Miroir", camera: "Caméra", front: "face", side: "profil", near2: "mains",
    keys: "Espace : lire ou pause · , et . : une image · S : vitesse · M : miroir · C : caméra", still: "Votre navigateur ne peut pas montrer le mouvement (pas de WebGL 2). L’image en montre le milieu.", missing: "Le mouvement n’a pas pu être chargé.",
    about: "Un choix de chaque sorte suffit. Les signes qui conviennent presque suivent ceux qui conviennent.", keysSearch: "/ : chercher · flèches : choisir · Échap : recommencer", image: "mouvement de {gloss}",
    copyPart: "Cet appareil garde une copie de la recherche et des signes ouverts, pour un usage sans connexion.", copyAll: "Cet appareil garde une copie de tous les signes, pour un usage sans connexion.", copyBegins: "La copie commence.", copyBusy: "Copié jusqu’ici : {kept} fichiers sur {files}.",
    copyFailed: "La copie n’est pas complète : {kept} fichiers sur {files}.", copyNone: "Cet appareil ne garde pas de copie.", copyKeep: "Garder tous les signes ({size} Mo)", copyAgain: "Garder tous les signes", copyForget: "Supprimer la copie",
  },
};
