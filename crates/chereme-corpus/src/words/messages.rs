//! French forms of the library's messages, looked up by their English form.
//!
//! The library writes its messages in English. Each line of a table has such a message and its French form; `{name}`
//! stands for a variable part, which is put into French as well if a table has it, and copied otherwise. The tables are
//! in the files beside this one, by theme; the first form that fits counts, so that a form with more words of its own
//! comes before one with fewer.

use chereme_analysis::detect::DETECTORS;
use chereme_compose::recipe::Step;

use super::Language;
use super::agreeing::AGREEING;
use super::asking::ASKING;
use super::captures::CAPTURES;
use super::coding::CODING;
use super::composing::COMPOSING;
use super::count::counted_in_french;
use super::counting::COUNTING;
use super::documents::DOCUMENTS;
use super::editing::EDITING;
use super::filming::FILMING;
use super::findings::FINDINGS;
use super::foreign::FOREIGN;
use super::importing::IMPORTING;
use super::lines::{GENERAL, LINES};
use super::moving::MOVING;
use super::notes::NOTES;
use super::parts::{by_lines, carried, is_quoted, placed_in_french, side_in_french};
use super::pointed::POINTED;
use super::publishing::PUBLISHING;
use super::queries::QUERIES;
use super::reading::READING;
use super::reporting::REPORTS;
use super::studies::STUDIES;
use crate::import::readers::endings;

/// Messages and remedies in English and French; a form that is contained in another comes after it.
const MESSAGES: &[(&str, &str)] = &[
    (
        "{path}: something of this name is there already",
        "{path} : quelque chose porte déjà ce nom",
    ),
    (
        "no detector is called {name}",
        "aucun détecteur ne s’appelle {name}",
    ),
    (
        "the detectors are: {names}",
        "les détecteurs sont : {names}",
    ),
    (
        "{text} is no number of a conflict",
        "{text} n’est pas un numéro de conflit",
    ),
    (
        "write the name of a signer or a recording; {command} lists them",
        "écrivez le nom d’un signeur ou d’un enregistrement ; {command} en donne la liste",
    ),
    (
        "write annotation:12; {command} lists them",
        "écrivez annotation:12 ; {command} en donne la liste",
    ),
    (
        "name channels that both have with --channels; {command} lists them",
        "nommez avec --channels des canaux que les deux ont ; {command} en donne la liste",
    ),
    (
        "the file is damaged: take a backup, or save what can still be read with {command}",
        "le fichier est abîmé : prenez une sauvegarde, ou sauvez ce qui se lit encore avec {command}",
    ),
    ("nothing changed", "rien n’a changé"),
    ("the file is damaged: {why}", "le fichier est abîmé : {why}"),
    (
        "left out of {where}, the first {gloss}: {why}",
        "laissé de côté ({where}, le premier : {gloss}) : {why}",
    ),
    (
        "words that name no symbol",
        "des mots qui ne nomment aucun symbole",
    ),
    (
        "there is no field or attribute {name}",
        "il n’y a ni champ ni attribut {name}",
    ),
    (
        "there is no field {name}, and attributes are not counted",
        "il n’y a pas de champ {name}, et les attributs ne se comptent pas",
    ),
    ("the file has too many bytes", "le fichier a trop d’octets"),
    (
        "no column is called a gloss",
        "aucune colonne ne s’appelle glose",
    ),
    (
        "the movement has no frames",
        "le mouvement n’a pas d’images",
    ),
    (
        "a key has no part {part}",
        "une clé n’a pas de partie {part}",
    ),
    (
        "{text} is no number of a frame",
        "{text} n’est pas un numéro d’image",
    ),
    (
        "the stored frame time is no number",
        "la durée d’image enregistrée n’est pas un nombre",
    ),
    (
        "frame {n} of {name} is missing",
        "il manque l’image {n} de {name}",
    ),
    (
        "<{element}> was read as {what}; write digits from 1 (thumb) to 5, each once",
        "<{element}> a été lu comme {what} ; écrivez des doigts de 1 (pouce) à 5, chacun une fois",
    ),
    (
        "write one of its 209 symbols or their names",
        "écrivez l’un de ses 209 symboles ou de leurs noms",
    ),
    (
        "write one of its 209 symbols, perhaps {near}",
        "écrivez l’un de ses 209 symboles, peut-être {near}",
    ),
    (
        "write one of its 209 symbols",
        "écrivez l’un de ses 209 symboles",
    ),
    (
        "write one of a kind, after the movement that it modifies",
        "écrivez-en un de chaque sorte, après le mouvement qu’il modifie",
    ),
    (
        "{path} cannot be opened as a corpus: {why}",
        "{path} ne s’ouvre pas comme corpus : {why}",
    ),
    (
        "{path}: it may not be read or written",
        "{path} : ni lecture ni écriture permise",
    ),
    (
        "{path}: there is nothing of this name",
        "{path} : rien ne porte ce nom",
    ),
    (
        "the corpus database says: {what}",
        "la base du corpus dit : {what}",
    ),
    (
        "the search index says: {what}",
        "l’index de recherche dit : {what}",
    ),
    (
        "{path} was moved, deleted or replaced meanwhile; the work is saved in {rescued}",
        "{path} a été déplacé, supprimé ou remplacé entre-temps ; le travail est enregistré dans {rescued}",
    ),
    (
        "compare the two files, and give the one with the work its name",
        "comparez les deux fichiers, et donnez son nom à celui qui contient le travail",
    ),
    ("{place} is damaged: {why}", "{place} est abîmé : {why}"),
    (
        "stopped; the corpus is as it was before",
        "arrêté ; le corpus est tel qu’il était",
    ),
    (
        "one change cannot be made, and none was:\n{rest}",
        "une modification est impossible, et aucune n’a été faite :\n{rest}",
    ),
    (
        "{n} changes cannot be made, and none was:\n{rest}",
        "{n} modifications sont impossibles, et aucune n’a été faite :\n{rest}",
    ),
    (
        "{gloss} is coded for too few components to compare it with other signs: {n}, and {least} are needed",
        "{gloss} est codé pour trop peu de composants pour le comparer à d’autres signes : {n}, il en faut {least}",
    ),
    (
        "code its handshape, placement and movement, or have them proposed with `chereme propose`",
        "codez sa configuration, son emplacement et son mouvement, ou faites-les proposer par `chereme propose`",
    ),
    (
        "check the spelling of the path",
        "vérifiez l’orthographe du chemin",
    ),
    (
        "choose another name, or move the existing one away",
        "choisissez un autre nom, ou déplacez ce qui existe",
    ),
    (
        "another program has been writing to the corpus for 20 seconds; try again when it is done",
        "un autre programme écrit dans le corpus depuis 20 secondes ; réessayez quand il aura fini",
    ),
    (
        "the disk is full; make room and try again, nothing was lost",
        "le disque est plein ; faites de la place et réessayez, rien n’est perdu",
    ),
    (
        "the file or its folder may not be written by you",
        "vous n’avez pas le droit d’écrire ce fichier ou ce dossier",
    ),
    (
        "no sign is called {gloss}; did you mean {near}?",
        "aucun signe ne s’appelle {gloss} ; vouliez-vous dire {near} ?",
    ),
    (
        "no sign is called {gloss}",
        "aucun signe ne s’appelle {gloss}",
    ),
    (
        "no recording is called {name}; did you mean {near}?",
        "aucun enregistrement ne s’appelle {name} ; vouliez-vous dire {near} ?",
    ),
    (
        "no recording is called {name}",
        "aucun enregistrement ne s’appelle {name}",
    ),
    (
        "no annotation is called {name}",
        "aucune annotation ne s’appelle {name}",
    ),
    (
        "no recording has a tier {name}",
        "aucun enregistrement n’a d’acteur {name}",
    ),
    (
        "the recording {name} has no tier {tier}; did you mean {near}?",
        "l’enregistrement {name} n’a pas d’acteur {tier} ; vouliez-vous dire {near} ?",
    ),
    (
        "the recording {name} has no tier {tier}",
        "l’enregistrement {name} n’a pas d’acteur {tier}",
    ),
    ("its tiers are: {names}", "ses acteurs sont : {names}"),
    ("the signers are: {names}", "les signeurs sont : {names}"),
    ("there is no signer:{name}", "il n’y a pas de signer:{name}"),
    (
        "there is no recording:{id}",
        "il n’y a pas de recording:{id}",
    ),
    ("there is no token:{id}", "il n’y a pas de token:{id}"),
    (
        "there is no annotation:{id}",
        "il n’y a pas d’annotation:{id}",
    ),
    (
        "there is no operation {id}",
        "il n’y a pas d’opération {id}",
    ),
    (
        "there is another {what} called {name}",
        "un autre ({what}) s’appelle déjà {name}",
    ),
    ("give it another name", "donnez-lui un autre nom"),
    (
        "which recording’s tier is {tier}?",
        "de quel enregistrement est l’acteur {tier} ?",
    ),
    (
        "name the recording too, or write tier:12",
        "nommez aussi l’enregistrement, ou écrivez tier:12",
    ),
    ("{command} lists them", "{command} en donne la liste"),
    (
        "{command} lists the glosses",
        "{command} donne la liste des gloses",
    ),
    (
        "{command} lists all operations",
        "{command} dit ce qui a été fait",
    ),
    (
        "generated signs take movement from {what}: {made}",
        "des signes composés prennent leur mouvement de {what} : {made}",
    ),
    (
        "delete them as well with --with-dependents, or keep them with --keep-dependents: they keep their own movement, and their recipes cannot be evaluated again",
        "supprimez-les aussi avec --with-dependents, ou gardez-les avec --keep-dependents : ils gardent leur mouvement, mais leurs recettes ne peuvent plus être évaluées",
    ),
    (
        "{gloss} has {count} in recordings that stay, the first in {place}",
        "{gloss} a {count} dans des enregistrements qui restent, la première dans {place}",
    ),
    (
        "delete its annotations as well with --with-dependents, or name the recordings, too",
        "supprimez aussi ses annotations avec --with-dependents, ou nommez aussi les enregistrements",
    ),
    (
        "{what} is neither a recording nor a sign",
        "{what} n’est ni un enregistrement ni un signe",
    ),
    (
        "a token goes with its annotation: {command}",
        "une occurrence part avec son annotation : {command}",
    ),
    (
        "remove a tier with {command}",
        "supprimez un acteur avec {command}",
    ),
    (
        "write recording:3, recording:NAME or sign:GLOSS",
        "écrivez recording:3, recording:NOM ou sign:GLOSE",
    ),
    (
        "write sign:{gloss} or recording:{name}",
        "écrivez sign:{gloss} ou recording:{name}",
    ),
    ("there is nothing to undo", "il n’y a rien à annuler"),
    ("there is nothing to redo", "il n’y a rien à rétablir"),
    (
        "only what was undone last, with no other work since, can be done again",
        "on ne rétablit que ce qui vient d’être annulé, sans autre travail depuis",
    ),
    (
        "{what} can mean {n} things: {list}",
        "{what} peut désigner {n} choses : {list}",
    ),
    ("write which one", "écrivez laquelle"),
    (
        "{address} is a lexicon entry without movement",
        "{address} est une entrée du lexique, sans mouvement",
    ),
    (
        "name a token that was recorded, such as token:41",
        "nommez une occurrence enregistrée, comme token:41",
    ),
    (
        "{what} from {start} to {end} overlaps {other} ({from} to {to}) on the tier {tier} of {recording}",
        "{what}, de {start} à {end}, chevauche {other} ({from} à {to}) sur l’acteur {tier} de {recording}",
    ),
    ("free next to it: {times}", "libre à côté : {times}"),
    ("a new annotation", "une nouvelle annotation"),
    ("the right hand", "la main droite"),
    ("the left hand", "la main gauche"),
    ("the body", "le corps"),
    ("the hips", "les hanches"),
    ("the wrists", "les poignets"),
    ("the feet", "les pieds"),
    ("an operator", "un opérateur"),
    (
        "the tier {name} of the file is {other} in the corpus",
        "l’acteur {name} du fichier est {other} dans le corpus",
    ),
    (
        "{value} is no value of the inventory {inventory} of the tier {tier}; did you mean {near}?",
        "{value} n’est pas une valeur de l’inventaire {inventory} de l’acteur {tier} ; vouliez-vous dire {near} ?",
    ),
    (
        "{value} is no value of the inventory {inventory} of the tier {tier}",
        "{value} n’est pas une valeur de l’inventaire {inventory} de l’acteur {tier}",
    ),
    (
        "the tier {tier} cannot be {what}",
        "l’acteur {tier} ne peut pas être {what}",
    ),
    (
        "the recipe cannot be read: {why}\n{drawn}",
        "la recette ne se lit pas : {why}\n{drawn}",
    ),
    (
        "the recipe cannot be read: {why}",
        "la recette ne se lit pas : {why}",
    ),
    (
        "the recipe cannot be made: {step}: {why}",
        "la recette ne peut pas être exécutée : {step} : {why}",
    ),
    (
        "the recipe cannot be made: {why}",
        "la recette ne peut pas être exécutée : {why}",
    ),
    (
        "this kind of file is not known",
        "ce genre de fichier n’est pas connu",
    ),
    (
        "the folder {folder} is not there",
        "le dossier {folder} n’existe pas",
    ),
    (
        "make it first, or choose another place",
        "créez-le d’abord, ou choisissez un autre endroit",
    ),
    ("{what} is no format", "{what} n’est pas un format"),
    ("the table asks for nothing", "la table ne demande rien"),
    (
        "{condition} counts narrower values, too: {values}; == counts the value alone",
        "{condition} compte aussi des valeurs plus précises : {values} ; == ne compte que la valeur",
    ),
    (
        "{condition} counts values that are equal to it by an alias, too: {values}; {field}== with one of these names counts it alone",
        "{condition} compte aussi des valeurs égales par un alias : {values} ; {field}== avec un de ces noms ne compte que lui",
    ),
    (
        "{condition} matched: {values}",
        "{condition} a trouvé : {values}",
    ),
    (
        "{condition}: no {field} is coded in this corpus yet",
        "{condition} : aucune valeur de {field} n’est encore codée dans ce corpus",
    ),
    (
        "{condition} finds nothing: {why}; there are: {names}",
        "{condition} ne trouve rien : {why} ; il y a : {names}",
    ),
    (
        "{condition} finds nothing: {why}",
        "{condition} ne trouve rien : {why}",
    ),
    (
        "no token has all of it; alone they find: {terms}",
        "aucune occurrence n’a tout cela ; chacun à part trouve : {terms}",
    ),
    (
        "no sign has such a gloss",
        "aucun signe n’a une telle glose",
    ),
    ("no tier has this name", "aucun acteur ne s’appelle ainsi"),
    (
        "no token of the corpus has it",
        "aucune occurrence du corpus ne l’a",
    ),
    (
        "no token has this relation to such an annotation",
        "aucune occurrence n’est ainsi placée par rapport à une telle annotation",
    ),
    (
        "no value of {field} is coded in this corpus",
        "rien de {field} n’est codé dans ce corpus",
    ),
    (
        "only parts of {field} are coded in this corpus: {parts}",
        "de {field}, seules des parties sont codées dans ce corpus : {parts}",
    ),
    (
        "no token has such a value of {field}",
        "aucune occurrence n’a une telle valeur de {field}",
    ),
    (
        "{component} is not read from movement yet",
        "{component} ne se lit pas encore dans le mouvement",
    ),
    (
        "what can be proposed: {names}",
        "ce qui peut être proposé : {names}",
    ),
    (
        "the tier {name} has no phones to cue",
        "l’acteur {name} n’a pas de phones à coder",
    ),
    (
        "there is nothing to cue in {text}",
        "il n’y a rien à coder dans {text}",
    ),
    (
        "write words, or phones with --phones",
        "écrivez des mots, ou des phones avec --phones",
    ),
    ("there is no code {code}", "il n’y a pas de code {code}"),
    ("the codes are {codes}", "les codes sont {codes}"),
    (
        "the code {code} has no variant {variant}; it has {known}",
        "le code {code} n’a pas de variante {variant} ; il a {known}",
    ),
    ("the variants are {known}", "les variantes sont {known}"),
    (
        "the code {code} has no rules of spelling",
        "le code {code} n’a pas de règles d’orthographe",
    ),
    (
        "give phones: --phones sampa, ipa or mfa; or --espeak, if espeak-ng is installed",
        "donnez des phones : --phones sampa, ipa ou mfa ; ou --espeak, si espeak-ng est installé",
    ),
    ("the text has {n} bytes", "le texte a {n} octets"),
    (
        "mend that place, or export the take again from the program that recorded it",
        "corrigez cet endroit, ou exportez de nouveau la prise depuis le programme qui l’a enregistrée",
    ),
    (
        "the text takes {n} s to say",
        "il faut {n} s pour dire le texte",
    ),
    (
        "say at most an hour at once",
        "dites au plus une heure à la fois",
    ),
    (
        "{path}: the file is no text in UTF-8",
        "{path} : le fichier n’est pas du texte en UTF-8",
    ),
    (
        "save it as text in UTF-8",
        "enregistrez-le comme texte en UTF-8",
    ),
    (
        "cue at most 256 KiB at once, about an hour of speech",
        "codez au plus 256 Kio à la fois, environ une heure de parole",
    ),
    (
        "give at most 1 MiB at once",
        "donnez au plus 1 Mio à la fois",
    ),
    ("the pace is {n}", "l’allure est {n}"),
    (
        "a pace from 0.1 to 10; 1.6 is usual for people who cue",
        "une allure de 0,1 à 10 ; 1,6 est l’allure habituelle de qui code",
    ),
    (
        "{label}: {text} is no duration in milliseconds",
        "{label} : {text} n’est pas une durée en millisecondes",
    ),
    (
        "write for example a=120: from 1 to 60000",
        "écrivez par exemple a=120 : de 1 à 60000",
    ),
];

/// A table of texts in English and French.
pub type Forms = &'static [(&'static str, &'static str)];

/// Returns a message of the library in `language`; nothing if the table lacks it.
#[must_use]
pub fn message(text: &str, language: Language) -> Option<String> {
    message_among(text, language, &[])
}

/// Returns a message in `language`, as [`message`] does, from the tables of the library and those of a program, `own`.
#[must_use]
pub fn message_among(text: &str, language: Language, own: &[Forms]) -> Option<String> {
    if language == Language::English {
        return Some(text.to_owned());
    }
    in_french(text, own)
}

/// Returns all messages in English and French; those of a program come before the most general forms of the library.
pub fn forms(own: &[Forms]) -> impl Iterator<Item = (&'static str, &'static str)> {
    let first = MESSAGES.iter().chain(FINDINGS).chain(QUERIES).copied();
    let operators = Step::DESCRIPTIONS.iter().flat_map(|it| it.messages);
    let detectors = DETECTORS.iter().flat_map(|it| it.description().messages);
    let rest = AGREEING
        .iter()
        .chain(COUNTING)
        .chain(NOTES)
        .chain(MOVING)
        .chain(IMPORTING)
        .chain(FILMING)
        .chain(EDITING)
        .chain(COMPOSING)
        .chain(CODING)
        .chain(READING)
        .chain(STUDIES)
        .chain(PUBLISHING)
        .chain(REPORTS)
        .chain(POINTED)
        .chain(CAPTURES)
        .chain(FOREIGN)
        .chain(DOCUMENTS)
        .chain(ASKING)
        .chain(LINES);
    let own = own.iter().copied().flatten();
    first
        .chain(operators.chain(detectors).map(|it| (it.en, it.fr)))
        .chain(rest.chain(own).chain(GENERAL).copied())
}

fn in_french(text: &str, own: &[Forms]) -> Option<String> {
    let part = |blank: &str, part: &str| {
        if blank == "list" {
            let each = part.split("; ");
            let each = each.map(|it| in_french(it, own).unwrap_or_else(|| it.to_owned()));
            return each.collect::<Vec<_>>().join(" ; ");
        }
        let side = side_in_french(blank, part).map(str::to_owned);
        let spoken = || in_french(part, own).filter(|_| !is_quoted(part));
        side.or_else(spoken).unwrap_or_else(|| part.to_owned())
    };
    if text.starts_with('.') && text == endings(Language::English) {
        return Some(endings(Language::French));
    }
    let mut all = forms(own);
    let translated = all.find_map(|(english, french)| carried(text, english, french, &part));
    translated
        .or_else(|| counted_in_french(text))
        .or_else(|| placed_in_french(text, &|it| part("", it)))
        .or_else(|| by_lines(text, &|it| part("", it)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_message_has_the_same_blanks_in_both_languages() {
        let blanks = |text: &str| {
            let mut names: Vec<String> = text
                .split('{')
                .skip(1)
                .filter_map(|rest| Some(rest.split_once('}')?.0.to_owned()))
                .collect();
            names.sort();
            names
        };
        for (english, french) in forms(&[]) {
            assert_eq!(blanks(english), blanks(french), "{english}");
            let same = carried(english, english, english, &|_, it| it.to_owned());
            assert_eq!(same.as_deref(), Some(english), "it is of its own form");
        }
    }

    #[test]
    fn no_form_hides_a_later_one() {
        for (english, _) in forms(&[]) {
            let mut fitting = forms(&[])
                .filter(|(form, _)| carried(english, form, form, &|_, it| it.to_owned()).is_some());
            assert_eq!(fitting.next().map(|first| first.0), Some(english));
        }
    }

    #[test]
    fn common_failures_have_french_messages() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut corpus = crate::Corpus::create(&path, "A").expect("made");
        let mut hear = crate::unheard;
        let progress = &mut crate::Progress::new(&mut hear);
        let failures = [
            corpus.undo().map(drop),
            corpus.redo().map(drop),
            corpus.recombine("NONE | swap", "X").map(drop),
            corpus.preview("| ").map(drop),
            corpus
                .suggest(&"NONE".parse().expect("an address"))
                .map(drop),
            corpus.operation(99, 1).map(drop),
            crate::Corpus::open(&folder.path().join("none"), "A").map(drop),
            crate::Corpus::create(&path, "A").map(drop),
            corpus
                .export(
                    &crate::ExportWhat::All,
                    &folder.path().join("x.xyz"),
                    &crate::ExportOptions::default(),
                    progress,
                )
                .map(drop),
        ];
        for failure in failures {
            let text = failure.expect_err("a failure").to_string();
            let french = message(&text, Language::French);
            assert!(french.is_some_and(|it| it != text), "{text}");
        }
        assert_eq!(message("no such words", Language::French), None);
        for (english, french) in [
            (
                "a.png cannot be opened as a corpus: there is nothing of this name",
                "a.png ne s’ouvre pas comme corpus : rien ne porte ce nom",
            ),
            (
                "lines end with CR LF, as on Windows",
                "les lignes finissent par CR LF, comme sous Windows",
            ),
            (
                "<eye_gaze> belongs into <eyegaze_tier>; it was kept in <facialexpr_tier>",
                "<eye_gaze> a sa place dans <eyegaze_tier> ; gardé dans <facialexpr_tier>",
            ),
        ] {
            let said = message(english, Language::French);
            assert_eq!(said.as_deref(), Some(french));
        }
        let inside = "gloss=ESC finds nothing: no sign has such a gloss; there are: ESCARGOT";
        assert_eq!(
            message(inside, Language::French).as_deref(),
            Some("gloss=ESC ne trouve rien : aucun signe n’a une telle glose ; il y a : ESCARGOT")
        );
        assert_eq!(message("x", Language::English).as_deref(), Some("x"));
        assert_eq!(
            message(
                "no sign is called \"BOLL\"; did you mean \"BOL\"?",
                Language::French
            )
            .as_deref(),
            Some("aucun signe ne s’appelle \"BOLL\" ; vouliez-vous dire \"BOL\" ?")
        );
    }
}
