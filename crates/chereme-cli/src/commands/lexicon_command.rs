//! `chereme lexicon`: lists the lexicons of a corpus, changes them, and links recordings to them.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    Corpus, CorpusAddress, CorpusError, LexiconChange, LexiconContents, LexiconScope, LinkedRecordings, PairOptions,
    RelationChange, RowName, SignRelation,
};
use clap::{Args, Subcommand};

use super::track_command::parse_recording_address;
use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// List the lexicons of a corpus, say what they are, and link recordings to them
///
/// A sign is an entry of a lexicon: BOOK of an American and BOOK of a British lexicon are two signs. An imported table is
/// a lexicon with the name of its file, unless the import names one. Where several lexicons have a gloss,
/// write which one is meant: sign:NGT/BOOK. Queries know lexicon=NGT, language=dse and file=ngt.csv.
///
/// The glosses of a recording's tiers are looked up in the lexicon to which the recording is linked; those that it does
/// not have are signs of no lexicon. The recordings of a corpus with one lexicon are linked to it; with several, link
/// them yourself. Without an action the lexicons are listed. `--json` gives for each "id", "name", "language", "version",
/// "terms", "citation", "notes", "signs", "homonyms", "files", "recordings", "tokens" and "guessed_tokens".
///
/// Several entries may have one gloss: BANK, BANK#2. A table keeps them apart by a column that identifies its rows, such as
/// id, or by a column "homonym" with 1, 2 and so on. A bare gloss in an annotation means the first ("guessed_tokens" counts
/// these); write BANK#2 for the second. sign:BANK#2 names it, gloss=BANK finds all. `annotate` and the window rename signs.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  chereme lexicon mine.chereme
  chereme lexicon mine.chereme set ngt --name NGT --language dse --terms 'CC BY 4.0'
  chereme lexicon mine.chereme link NGT recording:3 recording:4
  chereme lexicon mine.chereme link NGT --where signer=Ada
  chereme lexicon mine.chereme relate BOOKSHOP compound-of BOOK SHOP
  chereme lexicon mine.chereme relations --by-form --store
  chereme lexicon mine.chereme unite 'NGT (2)' --into NGT")]
pub(crate) struct LexiconArgs {
    /// The corpus
    corpus: PathBuf,
    #[command(subcommand)]
    action: Option<LexiconAction>,
}

#[derive(Debug, Subcommand)]
enum LexiconAction {
    /// Say what a lexicon is: its name, language, version, terms, and how to cite it
    Set(LexiconSetArgs),
    /// Look up the glosses of recordings in a lexicon from now on
    Link(LexiconLinkArgs),
    /// Look up the glosses of recordings in no lexicon
    Unlink(LexiconRecordingArgs),
    /// Make lexicons one: entries, recordings and files belong to the one that stays; undo takes it back
    ///
    /// Entries are the same if their rows have the same id, otherwise by gloss and number. Both codings are kept, as two
    /// forms of one entry, and entries that differ are named. Lexicons that differ in language, version, terms or
    /// citation are refused.
    Unite {
        /// The lexicons that go
        #[arg(value_name = "LEXICON", required = true)]
        lexicons: Vec<String>,
        /// The lexicon that stays
        #[arg(long, value_name = "LEXICON")]
        into: String,
    },
    /// Say how a sign is related to others: variants, synonyms, the parts of a compound in order
    ///
    /// A relation is read from both ends: if BOOKSHOP is compound-of BOOK SHOP, BOOK is part-of BOOKSHOP. Queries know
    /// related.variant=BOOK and related.part-of=*. Tables bring relations in columns such as "variants", "relations to other
    /// signs" (variant:BANK, seealso:SHORE) and "sequential morphology" (HOUSE + ROOF).
    Relate(LexiconRelationArgs),
    /// Take relations of a sign to others away
    Unrelate(LexiconRelationArgs),
    /// List the relations of a sign or of all signs, or those that the form of signs decides
    Relations(LexiconRelationsArgs),
    /// Remove a lexicon that has no signs
    Remove {
        /// The lexicon, by name
        lexicon: String,
    },
}

#[derive(Debug, Args)]
struct LexiconSetArgs {
    /// The lexicon, by name
    lexicon: String,
    /// Its new name
    #[arg(long)]
    name: Option<String>,
    /// Its sign language, as a code of ISO 639-3 such as dse; an empty text takes it away, here and below
    #[arg(long, value_name = "CODE")]
    language: Option<String>,
    /// Its version
    #[arg(long, value_name = "TEXT")]
    release: Option<String>,
    /// The terms under which it may be used
    #[arg(long)]
    terms: Option<String>,
    /// How to cite it
    #[arg(long, value_name = "TEXT")]
    citation: Option<String>,
    /// Remarks
    #[arg(long, value_name = "TEXT")]
    notes: Option<String>,
}

#[derive(Debug, Args)]
struct LexiconRelationArgs {
    /// The sign, as a gloss or sign:LEXICON/GLOSS
    #[arg(value_parser = parse_sign_address)]
    sign: RowName,
    /// The relation: variant, homonym, synonym, antonym, paradigm, see-also, compound-of, part-of, derived-from, source-of,
    /// hyponym-of, hypernym-of
    relation: String,
    /// The other signs
    #[arg(required = true, value_parser = parse_sign_address)]
    others: Vec<RowName>,
}

#[derive(Debug, Args)]
struct LexiconRelationsArgs {
    /// The sign; without it those of all signs
    #[arg(value_parser = parse_sign_address)]
    sign: Option<RowName>,
    /// List the relations that the form decides and nobody stated: homonyms are equal in all fields, the signs of a paradigm
    /// in all but the handshape
    #[arg(long, conflicts_with = "sign")]
    by_form: bool,
    /// Store them
    #[arg(long, requires = "by_form")]
    store: bool,
    /// The fields that count as form, as in `chereme pairs`
    #[arg(long, value_name = "FIELD", num_args = 1.., requires = "by_form")]
    fields: Vec<String>,
    #[command(flatten)]
    scope: LexiconScopeArgs,
}

/// Reads a sign: a gloss, `sign:GLOSS`, `sign:LEXICON/GLOSS` or `sign:12`.
fn parse_sign_address(text: &str) -> Result<RowName, CorpusError> {
    match text.parse()? {
        CorpusAddress::Sign(name) => Ok(name),
        CorpusAddress::Gloss(gloss) => Ok(RowName::Text(gloss)),
        _ => {
            Err(CorpusError::from_wrong_message(format!("{text:?} is no sign")).with_advice("write a gloss or sign:12"))
        }
    }
}

#[derive(Debug, Args)]
struct LexiconLinkArgs {
    /// The lexicon, by name
    lexicon: String,
    #[command(flatten)]
    recordings: LexiconRecordingArgs,
}

/// The recordings to link.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct LexiconRecordingArgs {
    /// The recordings, such as recording:3
    #[arg(value_name = "RECORDING", value_parser = parse_recording_address)]
    recordings: Vec<RowName>,
    /// The recordings with a token that a query finds, as in `chereme search`
    #[arg(long = "where", value_name = "QUERY")]
    query: Option<String>,
    /// All recordings of the corpus
    #[arg(long)]
    all: bool,
}

impl LexiconRecordingArgs {
    /// Links the recordings to a lexicon, or to none, and prints how many were linked otherwise before.
    fn link_recordings(&self, corpus: &mut Corpus, lexicon: Option<&str>, output: &mut CommandOutput) -> Result<()> {
        let linked = match &self.query {
            Some(query) => {
                let ids = with_progress_bar(|progress| corpus.recordings_of_query(query, progress))?;
                LinkedRecordings::Named(ids.into_iter().map(RowName::Number).collect())
            }
            None if self.all => LinkedRecordings::All,
            None => LinkedRecordings::Named(self.recordings.clone()),
        };
        let names = with_progress_bar(|progress| corpus.link_lexicon(lexicon, &linked, progress))?;
        let count = output.format_counted_noun(names.len() as u64, "recordings");
        output.filled_line("linked otherwise than before: {n}", &[&count])
    }
}

/// The lexicons whose signs a command compares.
#[derive(Debug, Args)]
pub(super) struct LexiconScopeArgs {
    /// Take the signs of this lexicon alone
    #[arg(long, value_name = "NAME", conflicts_with = "across")]
    lexicon: Option<String>,
    /// Take the signs of all lexicons as if they were one
    #[arg(long)]
    across: bool,
}

impl LexiconScopeArgs {
    pub(super) fn lexicon_scope(&self) -> LexiconScope {
        match &self.lexicon {
            Some(name) => LexiconScope::Named(name.clone()),
            None if self.across => LexiconScope::Across,
            None => LexiconScope::Single,
        }
    }
}

pub(super) fn run(cli: &CommandLine, args: &LexiconArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    match &args.action {
        None => {}
        Some(LexiconAction::Set(set)) => {
            let change = set.lexicon_change();
            if change == LexiconChange::default() {
                return Err(CorpusError::from_wrong_message("nothing is to be changed")
                    .with_advice("add --name, --language, --release, --terms, --citation or --notes")
                    .into());
            }
            corpus.change_lexicon(&set.lexicon, &change)?;
        }
        Some(LexiconAction::Link(link)) => {
            link.recordings
                .link_recordings(&mut corpus, Some(&link.lexicon), output)?;
        }
        Some(LexiconAction::Unite { lexicons, into }) => {
            let report = with_progress_bar(|progress| corpus.unite_lexicons(lexicons, into, progress))?;
            output.filled_line(
                "{names}: one lexicon with {name} now; entries that came: {moved}, joined: {joined}",
                &[&report.united.join(", "), &report.into, &report.moved, &report.joined],
            )?;
            for (form, list) in [
                ("both codings were kept of: {list}", &report.differing),
                ("entries with another number: {list}", &report.renumbered),
            ] {
                if !list.is_empty() {
                    output.filled_line(form, &[&list.join(", ")])?;
                }
            }
            return output.set_json_document(report);
        }
        Some(LexiconAction::Relate(stated)) => {
            return stated.change_relations(&mut corpus, RelationChange::Add, output);
        }
        Some(LexiconAction::Unrelate(stated)) => {
            return stated.change_relations(&mut corpus, RelationChange::Remove, output);
        }
        Some(LexiconAction::Relations(asked)) => {
            let relations = match asked.by_form {
                true => {
                    let options = PairOptions {
                        fields: asked.fields.clone(),
                        scope: asked.scope.lexicon_scope(),
                        ..PairOptions::default()
                    };
                    with_progress_bar(|progress| corpus.relate_by_form(&options, asked.store, progress))?
                }
                false => corpus.list_relations(asked.sign.as_ref())?,
            };
            return print_relations(&relations, output);
        }
        Some(LexiconAction::Remove { lexicon }) => {
            let removed = corpus.remove_lexicon(lexicon)?;
            output.filled_line("lexicon removed: {name}", &[&removed.name])?;
        }
        Some(LexiconAction::Unlink(recordings)) => recordings.link_recordings(&mut corpus, None, output)?,
    }
    let lexicons = corpus.list_lexicons()?;
    print_lexicons(&lexicons, output)?;
    output.set_json_document(lexicons)
}

impl LexiconSetArgs {
    fn lexicon_change(&self) -> LexiconChange {
        let filled = |text: &Option<String>| {
            let text = text.as_deref().map(str::trim);
            text.map(|trimmed| Some(trimmed.to_owned()).filter(|owned_text| !owned_text.is_empty()))
        };
        LexiconChange {
            name: self.name.clone(),
            language: filled(&self.language),
            version: filled(&self.release),
            terms: filled(&self.terms),
            citation: filled(&self.citation),
            notes: filled(&self.notes),
        }
    }
}

impl LexiconRelationArgs {
    fn change_relations(&self, corpus: &mut Corpus, change: RelationChange, output: &mut CommandOutput) -> Result<()> {
        let changed = corpus.change_relations(&self.sign, &self.relation, &self.others, change)?;
        output.filled_line("relations that changed: {n}", &[&changed])?;
        print_relations(&corpus.list_relations(Some(&self.sign))?, output)
    }
}

fn print_relations(relations: &[SignRelation], output: &mut CommandOutput) -> Result<()> {
    output.write_item_table(
        relations,
        &[
            ("sign", &|row| row.sign.clone()),
            ("relation", &|row| row.relation.clone()),
            ("other sign", &|row| row.related.clone()),
            ("source", &|row| row.source.clone().unwrap_or_default()),
        ],
    )?;
    output.set_json_document(relations)
}

/// Returns the names of the first files, and how many more there are.
fn shown_file_names(files: &[String]) -> String {
    const MAX_SHOWN_FILES: usize = 3;
    let shown = files.iter().take(MAX_SHOWN_FILES).map(String::as_str);
    let names = shown.collect::<Vec<_>>().join(", ");
    match files.len().saturating_sub(MAX_SHOWN_FILES) {
        0 => names,
        more => format!("{names} +{more}"),
    }
}

fn print_lexicons(lexicons: &[LexiconContents], output: &mut CommandOutput) -> Result<()> {
    if lexicons.is_empty() {
        return output.write_note("the corpus has no lexicon: import a table or notation with --lexicon NAME");
    }
    output.write_item_table(
        lexicons,
        &[
            ("name", &|row| row.lexicon.name.clone()),
            ("language", &|row| row.lexicon.language.clone().unwrap_or_default()),
            ("version", &|row| row.lexicon.version.clone().unwrap_or_default()),
            ("signs", &|row| row.signs.to_string()),
            ("homonyms", &|row| row.homonyms.to_string()),
            ("tokens", &|row| row.tokens.to_string()),
            ("recordings", &|row| row.recordings.to_string()),
            ("terms", &|row| row.lexicon.terms.clone().unwrap_or_default()),
            ("files", &|row| shown_file_names(&row.files)),
        ],
    )?;
    let guessed: i64 = lexicons.iter().map(|row| row.guessed_tokens).sum();
    if guessed > 0 {
        output.write_warning(&format!(
            "tokens annotated with the bare gloss of several entries, of which the first was taken: {guessed}"
        ))?;
    }
    Ok(())
}
