//! French forms of messages about consent and dictionaries, looked up by their English form.

/// Messages and remedies in English and French; a form that is contained in another comes after it.
pub(super) const PUBLISHING: &[(&str, &str)] = &[
    ("{name} is no audience", "{name} n’est pas un public"),
    (
        "write public, research or nobody",
        "écrivez public, research ou nobody",
    ),
    (
        "a text of a consent has at most {n} bytes",
        "un texte d’un consentement a au plus {n} octets",
    ),
    ("{day} is no day", "{day} n’est pas un jour"),
    ("write it as 2026-11-27", "écrivez-le comme 2026-11-27"),
    (
        "{address} is neither a signer nor a recording",
        "{address} n’est ni un signeur ni un enregistrement",
    ),
    (
        "write signer:NAME or recording:NAME",
        "écrivez signer:NOM ou recording:NOM",
    ),
    (
        "terms of use are a text of at most {n} bytes",
        "des conditions d’utilisation sont un texte d’au plus {n} octets",
    ),
    ("nobody is named", "personne n’est nommé"),
    (
        "name signers or recordings, such as signer:Ada or recording:3",
        "nommez des signeurs ou des enregistrements, comme signer:Ada ou recording:3",
    ),
    (
        "state what the signers agreed to: `chereme consent CORPUS signer:NAME --all public`",
        "indiquez ce que les signeurs ont accepté : `chereme consent CORPUS signer:NOM --all public`",
    ),
    (
        "the signers did not agree that everybody sees it",
        "les signeurs n’ont pas accepté que tout le monde le voie",
    ),
    (
        "state the terms of recordings with `chereme consent CORPUS signer:NAME --licence TERMS`, those of entries that show nobody with --terms TERMS",
        "indiquez les conditions des enregistrements avec `chereme consent CORPUS signer:NOM --licence CONDITIONS`, celles des entrées qui ne montrent personne avec --terms CONDITIONS",
    ),
    (
        "a recording that they were made from may not be changed",
        "un enregistrement dont ils sont faits ne peut pas être modifié",
    ),
    (
        "two copies of the corpus disagree about it: `chereme conflicts CORPUS` lists what is to be decided",
        "deux copies du corpus ne sont pas d’accord : `chereme conflicts CORPUS` donne la liste de ce qui est à décider",
    ),
    (
        "a recording that they were made from is not known, or was deleted",
        "un enregistrement dont ils sont faits n’est pas connu, ou a été supprimé",
    ),
    (
        "none of {n} signs may be published",
        "aucun des {n} signes ne peut être publié",
    ),
    ("no sign is to be published", "aucun signe n’est à publier"),
    (
        "import recordings or a lexicon, or choose other signs",
        "importez des enregistrements ou un lexique, ou choisissez d’autres signes",
    ),
    (
        "a dictionary has at most {n} signs",
        "un dictionnaire a au plus {n} signes",
    ),
    (
        "choose fewer with a query",
        "choisissez-en moins avec une requête",
    ),
    (
        "{name} was not written by a publication",
        "{name} n’a pas été écrit par une publication",
    ),
    (
        "name an empty folder, or move the file away",
        "nommez un dossier vide, ou déplacez le fichier",
    ),
    (
        "this folder has no name of its own",
        "ce dossier n’a pas de nom à lui",
    ),
    (
        "name a folder that can be replaced, such as dictionary/",
        "nommez un dossier qui peut être remplacé, comme dictionnaire/",
    ),
    (
        "folders lie too deep inside each other",
        "des dossiers sont imbriqués trop profondément",
    ),
    (
        "a file's name is no text",
        "le nom d’un fichier n’est pas un texte",
    ),
    ("move it out of the folder", "déplacez-le hors du dossier"),
    (
        "the corpus itself lies in this folder",
        "le corpus lui-même est dans ce dossier",
    ),
    (
        "name a folder that holds only what everybody may see",
        "nommez un dossier qui ne contient que ce que tout le monde peut voir",
    ),
    (
        "the new pages are in place, but the old ones could not be removed",
        "les nouvelles pages sont en place, mais les anciennes n’ont pas pu être supprimées",
    ),
    (
        "remove this folder: signs that were withdrawn may be in it",
        "supprimez ce dossier : des signes retirés peuvent s’y trouver",
    ),
];
