//! The help of the program and its messages about wrong arguments, in English and French.

use chereme_corpus::words::{InterfaceLanguage, InterfaceText};

/// An option that the program does not have.
pub(crate) const UNKNOWN_OPTION_TEXT: InterfaceText = InterfaceText::from_id("program-unknown-option");

/// An option without its value.
pub(crate) const MISSING_VALUE_TEXT: InterfaceText = InterfaceText::from_id("program-missing-value");

/// A value that an option does not take.
pub(crate) const UNWANTED_VALUE_TEXT: InterfaceText = InterfaceText::from_id("program-unwanted-value");

/// A second corpus.
pub(crate) const SECOND_CORPUS_TEXT: InterfaceText = InterfaceText::from_id("program-second-corpus");

/// The remedy for wrong arguments.
pub(crate) const SEE_HELP: InterfaceText = InterfaceText::from_id("program-see-help");

/// Returns the help.
pub(crate) fn studio_help_text(language: InterfaceLanguage) -> &'static str {
    match language {
        InterfaceLanguage::French => FRENCH_STUDIO_HELP,
        InterfaceLanguage::English | InterfaceLanguage::Other(_) => ENGLISH_STUDIO_HELP,
    }
}

const ENGLISH_STUDIO_HELP: &str = "\
Open the workbench: annotate, search and recombine in a window

Without a corpus the window offers the starter corpus, recent corpora, and the import of a folder. The settings are
in the file chereme/studio.json of the platform's settings folder; --language changes the language there. F1 shows
the keys: ELAN's, Praat's or a video editor's.

Usage: chereme-studio [OPTIONS] [CORPUS]

Arguments:
  [CORPUS]               The corpus to open

Options:
      --folder <DIR>     The folder for the settings and the starter corpus, instead of the platform's
      --author <NAME>    Your name in the history; without it the environment variable CHEREME_AUTHOR, or the name of
                         the machine's user
      --language <CODE>  The language of the window and of messages, such as fr; without it that of the settings, or of
                         the system. The environment variable CHEREME_WORDS names a folder with languages of your own
      --json             Print an error as one JSON document on standard output
  -h, --help             Print help
  -V, --version          Print version
";

const FRENCH_STUDIO_HELP: &str = "\
Ouvrir l’atelier : annoter, chercher et recombiner dans une fenêtre

Sans corpus, la fenêtre propose le corpus de départ, les corpus récents, et l’import d’un dossier. Les réglages sont
dans le fichier chereme/studio.json du dossier de réglages du système ; --language y change la langue. F1 montre les
touches : celles d’ELAN, de Praat ou d’un montage vidéo.

Utilisation : chereme-studio [OPTIONS] [CORPUS]

Arguments :
  [CORPUS]               Le corpus à ouvrir

Options :
      --folder <DIR>     Le dossier des réglages et du corpus de départ, au lieu de celui du système
      --author <NOM>     Votre nom dans l’historique ; sinon la variable d’environnement CHEREME_AUTHOR, ou le nom de
                         l’utilisateur de la machine
      --language <CODE>  La langue de la fenêtre et des messages, comme fr ; sinon celle des réglages, ou du système.
                         La variable d’environnement CHEREME_WORDS nomme un dossier avec vos propres langues
      --json             Écrire une erreur en un document JSON sur la sortie standard
  -h, --help             Afficher l’aide
  -V, --version          Afficher la version
";
