//! Texts of the window for work on the tiers of many recordings.

texts! {
    TITLE: "Tiers of many recordings", "Acteurs de plusieurs enregistrements";
    RECORDINGS: "In which recordings", "Dans quels enregistrements";
    EVERY: "All: {n}", "Tous : {n}";
    FOUND: "Those with a token that a query finds", "Ceux qui ont une occurrence trouvée par une requête";
    NAMED: "Those of a name or a signer", "Ceux d’un nom ou d’un participant";
    TICKED: "Those that are ticked: {n}", "Ceux qui sont cochés : {n}";
    QUERY: "Query", "Requête";
    QUERY_HINT: "signer=S07 placement=chin", "signer=S07 placement=chin";
    PATTERN: "Name, where * stands for any letters", "Nom, où * remplace des lettres";
    PATTERN_HINT: "S07*, or signer:S07", "S07*, ou signer:S07";
    WORK: "Work", "Travail";
    ADD_USUAL: "add the usual tiers", "ajouter les acteurs habituels";
    ADD_LIKE: "add the tiers of the open recording", "ajouter les acteurs de l’enregistrement ouvert";
    ADD: "add a tier", "ajouter un acteur";
    CHANGE: "change tiers", "modifier des acteurs";
    COPY: "copy tiers", "copier des acteurs";
    REMOVE: "remove tiers", "supprimer des acteurs";
    SHIFT: "move tiers in time", "décaler des acteurs dans le temps";
    TIER: "Tiers of this name", "Acteurs de ce nom";
    TIER_HINT: "* stands for any letters", "* remplace des lettres";
    SHIFTED: "Tiers of these names", "Acteurs de ces noms";
    SHIFTED_HINT: "parted by commas; empty: all", "séparés par des virgules ; vide : tous";
    NEW_NAME: "New name", "Nouveau nom";
    COPY_NAME: "Name of the copies", "Nom des copies";
    KEPT: "as it is", "inchangé";
    REMOVED: "removed", "retiré";
    PARENT: "Below the tier", "Dépend de l’acteur";
    PARTICIPANT: "Participant", "Participant";
    ANNOTATOR: "Annotator", "Annotateur";
    LANGUAGE: "Language", "Langue";
    CHANGES_TEXT: "Change: {field}", "Modifier : {field}";
    SECONDS: "By seconds, earlier with -", "De secondes, plus tôt avec -";
    SKIP: "Leave out recordings that refuse", "Laisser de côté ceux qui refusent";
    TRY: "Show what would change", "Montrer ce qui changerait";
    CARRY_OUT: "Carry out", "Exécuter";
    ONLY_WITH_TOKENS: "The query is about tokens: recordings without one are left out.", "La requête porte sur des occurrences : les enregistrements sans occurrence sont laissés de côté.";
    WOULD: "Would change: {n} · refuse: {refusing} · stay as they are: {same}", "Changeraient : {n} · refusent : {refusing} · inchangés : {same}";
    ROW: "{name}: {tiers} ({annotations})", "{name} : {tiers} ({annotations})";
    REFUSES: "{name} refuses: {why}", "{name} refuse : {why}";
    REFUSED: "Nothing is done while a recording refuses: leave it out, or change the work.", "Rien ne se fait tant qu’un enregistrement refuse : laissez-le de côté, ou changez le travail.";
    STOPPED: "Stopped; nothing was changed.", "Arrêté ; rien n’a été modifié.";
    TASK: "Working on tiers", "Travail sur les acteurs";
}
