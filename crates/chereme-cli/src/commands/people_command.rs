//! `chereme people`: lists the people of a corpus, says who they are, and makes two one.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ConsentAudience, CorpusError, PersonChange, PersonContents, RowName};
use chereme_motion::BodySide;
use clap::{Args, Subcommand};

use crate::args::{BODY_SIDE_CHOICES, CommandLine, NamedChoices};
use crate::output::CommandOutput;
use crate::streams;

/// List the people of a corpus, say who they are, and make two names one person
///
/// Signers, participants of tiers and annotators are people. A person has one name that the corpus uses, any number of other
/// names, under which files may know them, and attributes of your choice: region, age, school. The signer of a token is
/// the participant of its tier, or else the signer of its recording. Queries know every name (signer=Ada), and attributes
/// as signer.region=north, signer.age>40; `chereme search CORPUS QUERY --count signer.region` counts by them.
///
/// An attribute is for you alone until you say who else may see it (--for). Other names never leave in a copy for others.
/// Without an action all people are listed. `--json` gives for each "id", "name", "aliases", "handedness", "notes",
/// "attributes", "recordings", "participant_tiers" and "annotator_tiers".
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  chereme people mine.chereme
  chereme people mine.chereme set S07 --attribute region=north --attribute age=34 --for research
  chereme people mine.chereme set S07 --name Ada --keep-name --alias A.L.
  chereme people mine.chereme unite ada A.L. --into Ada
  chereme people mine.chereme import people.csv --dry-run")]
pub(crate) struct PeopleArgs {
    /// The corpus
    corpus: PathBuf,
    #[command(subcommand)]
    action: Option<PeopleAction>,
}

#[derive(Debug, Subcommand)]
enum PeopleAction {
    /// Say who a person is: names, dominant hand, remarks and attributes
    Set(PersonSetArgs),
    /// Make people one, everywhere: recordings, participants, annotators, names and attributes; undo takes it back
    Unite {
        /// The people whose names become other names
        #[arg(value_name = "PERSON", required = true)]
        people: Vec<String>,
        /// The person who stays
        #[arg(long, value_name = "PERSON")]
        into: String,
    },
    /// Read a table of people: a column name, and any of other names, handedness, notes; every other column is an attribute
    Import {
        /// The table (CSV or TSV); - reads it from the input
        table: PathBuf,
        /// Who may see its attributes; without it new ones are for you alone
        #[arg(long = "for", value_name = "AUDIENCE", value_parser = ATTRIBUTE_AUDIENCES)]
        audience: Option<ConsentAudience>,
        /// Say what would change, and change nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Remove a person of whom the corpus has neither recordings nor tiers
    Remove {
        /// The person, by any of their names
        person: String,
    },
}

#[derive(Debug, Args)]
struct PersonSetArgs {
    /// The person, by any of their names
    person: String,
    /// The new name
    #[arg(long)]
    name: Option<String>,
    /// Keep the former name as another name, so that files which say it are understood
    #[arg(long, requires = "name")]
    keep_name: bool,
    /// The dominant hand
    #[arg(long, value_parser = BODY_SIDE_CHOICES)]
    handedness: Option<BodySide>,
    /// Remarks; an empty text takes them away
    #[arg(long, value_name = "TEXT")]
    notes: Option<String>,
    /// Add another name
    #[arg(long, value_name = "NAME")]
    alias: Vec<String>,
    /// Take another name away
    #[arg(long, value_name = "NAME")]
    no_alias: Vec<String>,
    /// Say something of the person, such as region=north; an empty text takes it away
    #[arg(long, value_name = "NAME=TEXT", value_parser = parse_attribute)]
    attribute: Vec<(String, String)>,
    /// Who may see the attributes that are set; without any that are set, who may see all
    #[arg(long = "for", value_name = "AUDIENCE", value_parser = ATTRIBUTE_AUDIENCES)]
    audience: Option<ConsentAudience>,
}

/// The people who may see an attribute.
const ATTRIBUTE_AUDIENCES: NamedChoices<ConsentAudience> = NamedChoices(&[
    ("public", "", ConsentAudience::Public),
    ("research", "", ConsentAudience::Research),
    ("nobody", "", ConsentAudience::Nobody),
]);

fn parse_attribute(text: &str) -> std::result::Result<(String, String), String> {
    let parts = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
    let named = parts.map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned()));
    named.ok_or_else(|| "write a name and a text, such as region=north".to_owned())
}

pub(super) fn run(cli: &CommandLine, args: &PeopleArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    match &args.action {
        None => {}
        Some(PeopleAction::Set(set)) => {
            let change = set.person_change();
            if change == PersonChange::default() {
                return Err(CorpusError::from_wrong_message("nothing is to be changed")
                    .with_advice("add --name, --handedness, --notes, --alias, --no-alias, --attribute or --for")
                    .into());
            }
            let person = corpus.change_person(&RowName::Text(set.person.clone()), &change)?;
            print_people(std::slice::from_ref(&person), output)?;
            return output.set_json_document(person);
        }
        Some(PeopleAction::Unite { people, into }) => {
            let from: Vec<RowName> = people.iter().cloned().map(RowName::Text).collect();
            let report = corpus.unite_people(&from, &RowName::Text(into.clone()))?;
            let recordings = output.format_counted_noun(report.recordings, "recordings");
            let tiers = output.format_counted_noun(report.tiers, "tiers");
            let names = report.united.join(", ");
            output.filled_line(
                "{names}: one person with {name} now; {recordings}, {tiers}",
                &[&names, &report.into, &recordings, &tiers],
            )?;
            if report.is_consent_narrower {
                output.write_warning("what they agreed to differed: the narrower consent holds from now on")?;
            }
            if report.is_consent_extended {
                output.write_warning("one of them had agreed to nothing: what the other agreed to holds for both")?;
            }
            return output.set_json_document(report);
        }
        Some(PeopleAction::Import {
            table,
            audience,
            dry_run,
        }) => {
            let bytes = streams::read_file_or_stdin(table)?;
            let report = corpus.import_people_table(&bytes, &table.to_string_lossy(), *audience, *dry_run)?;
            for finding in &report.findings {
                let line = finding.line.map(|line| format!("line {line}: ")).unwrap_or_default();
                let message = output.translate_message(&finding.message);
                output.write_output_line(format!("{}: {line}{message}", finding.severity))?;
            }
            if *dry_run {
                output.write_note("a dry run: nothing was changed")?;
            }
            for (form, names) in [
                ("people added: {n} {names}", &report.added),
                ("people changed: {n} {names}", &report.changed),
            ] {
                output.filled_line(form, &[&names.len(), &names.join(", ")])?;
            }
            output.filled_line("people as they were: {n}", &[&report.unchanged])?;
            return output.set_json_document(report);
        }
        Some(PeopleAction::Remove { person }) => {
            let name = corpus.remove_person(&RowName::Text(person.clone()))?;
            output.filled_line("person removed: {name}", &[&name])?;
        }
    }
    let people = corpus.list_people()?;
    print_people(&people, output)?;
    output.set_json_document(people)
}

impl PersonSetArgs {
    fn person_change(&self) -> PersonChange {
        PersonChange {
            name: self.name.clone(),
            keeps_former_name: self.keep_name,
            handedness: self.handedness.map(Some),
            notes: self
                .notes
                .clone()
                .map(|text| Some(text).filter(|text| !text.is_empty())),
            add_aliases: self.alias.clone(),
            remove_aliases: self.no_alias.clone(),
            attributes: self.attribute.iter().cloned().collect::<BTreeMap<_, _>>(),
            audience: self.audience,
        }
    }
}

fn print_people(people: &[PersonContents], output: &mut CommandOutput) -> Result<()> {
    if people.is_empty() {
        return output.write_note("the corpus knows nobody yet");
    }
    let attribute_text = |person: &PersonContents| {
        let each = person.attributes.iter();
        each.map(|attribute| match attribute.audience {
            ConsentAudience::Nobody => format!("{}={}", attribute.name, attribute.text),
            audience => format!("{}={} ({audience})", attribute.name, attribute.text),
        })
        .collect::<Vec<_>>()
        .join(", ")
    };
    let rows: Vec<Vec<String>> = people
        .iter()
        .map(|person| {
            vec![
                person.name.clone(),
                person.aliases.join(", "),
                person.recordings.to_string(),
                person.participant_tiers.to_string(),
                person.annotator_tiers.to_string(),
                person.handedness.clone().unwrap_or_default(),
                attribute_text(person),
            ]
        })
        .collect();
    let titles = [
        "name",
        "other names",
        "recordings",
        "tiers as participant",
        "tiers as annotator",
        "handedness",
        "attributes",
    ];
    output.write_titled_table(&titles, &rows)
}
