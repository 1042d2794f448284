//! `chereme study`: perceptual studies, from the plan to the answers.

mod commands_study_answers;
mod study_report;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::study::study_plan::{
    ConditionOrder, LocalizedTexts, QuestionKind, QuestionViewing, StudyPlan, StudyQuestion, StudyTrial, TrialDesign,
    text_in,
};
use chereme_corpus::study::{
    AnswersFile, AnswersOptions, ColumnUse, QuestionnaireOptions, StudyRequest, split_quoted_words,
};
use chereme_corpus::{Corpus, FileStatus};
use clap::Subcommand;

use super::import_command::print_finding;
use crate::args::{CommandLine, NamedChoices, read_named_text};
use crate::output::{CommandOutput, with_progress_bar};

/// Run a perceptual study: plan it, build its questionnaire, import the answers, report on them
///
/// A study shows clips of the corpus to people and asks about them. `new` stores a plan, `build` makes a folder with one
/// page and its films. The page works in a browser without a network, in English and French, by mouse or keyboard;
/// people answer it and send back the file that it saves. `import` brings the files into the corpus, and `report`
/// says what the answers show.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme study new lsf.chereme places --items 'BOL CHAT' --condition 'captured={}' --condition 'higher={} | place both by up 10cm' --ask realism --ask 'gloss=items ESCARGOT LIMACE'
  chereme study new lsf.chereme pointing --trials trials.csv --ask 'place@bowls=left right' --ask realism
  chereme study build lsf.chereme places --to places/
  chereme study import lsf.chereme places answers/
  chereme study import lsf.chereme places limesurvey.csv --columns columns.csv
  chereme study answers lsf.chereme places --participant p7 --missing
  chereme study answers lsf.chereme places --to answers.csv
  chereme study report lsf.chereme places --to report.html")]
pub(crate) struct StudyArgs {
    #[command(subcommand)]
    action: StudyCommand,
}

#[derive(Debug, Subcommand)]
enum StudyCommand {
    /// Plan a study: items in conditions, or a table of trials, and questions
    ///
    /// A plan that nobody has answered is replaced. For texts, labels, pictures, hypotheses and exclusions, edit the JSON
    /// that `chereme study show CORPUS NAME --json` prints, and give it back with --plan.
    New(Box<NewArgs>),
    /// Show the plan of a study; with --json as a file for --plan
    Show {
        /// The corpus
        corpus: PathBuf,
        /// The name of the study
        name: String,
    },
    /// Build the questionnaire: a folder with one page and its films
    ///
    /// All films have the same body, camera, size and background; the first and the last picture stand still for half a
    /// second. Films in sign language can be put into the folder media beside them: consent, instructions, end,
    /// question-NAME and profile-NAME, as .mp4 or .webm, or as NAME.fr.mp4 for one language. The page sends nothing
    /// anywhere. A number in its address, as index.html?n=12, gives participant 12 the order of that number; without it
    /// an order is drawn.
    Build {
        /// The corpus
        corpus: PathBuf,
        /// The name of the study
        name: String,
        /// The folder
        #[arg(long, value_name = "FOLDER")]
        to: PathBuf,
        /// The height of films in pixels, from 64 to 1080
        #[arg(long, default_value_t = 540, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(64..=1080))]
        height: u16,
        /// The number of pictures per second, from 1 to 120
        #[arg(long, default_value_t = 25, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=120))]
        rate: u32,
        /// Replace a questionnaire that exists already; other files in its folder stay
        #[arg(long)]
        force: bool,
        /// Who will see the films; if somebody did not agree to that (`chereme consent`), nothing is built
        #[arg(long = "for", value_name = "AUDIENCE", default_value = "public", value_parser = ["research", "public"])]
        audience: String,
    },
    /// Import answers: files that the questionnaire saved, tables with one answer a row, folders of both
    ///
    /// Answers to another plan, to unknown trials, or outside a scale are left out and reported. Later answers replace
    /// those of a participant who had not finished. The same file twice changes nothing.
    ///
    /// Tables with one participant a row, as LimeSurvey and Qualtrics export them, need --columns: a table (.csv) whose
    /// column `column` holds titles, with `item`, `condition`, `question` (and `part`, `role`) for answers, or `means`:
    /// participant, language, started_day, finished, profile.NAME, consent.NAME. Codes stand under `values`, as
    /// `A1=left; A2=right`.
    Import {
        /// The corpus
        corpus: PathBuf,
        /// The name of the study
        name: String,
        /// The files or folders
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// The meaning of the columns of tables with one participant a row (.csv)
        #[arg(long, value_name = "FILE")]
        columns: Option<PathBuf>,
        /// Report what would be imported, and the use of each column, and store nothing
        #[arg(long)]
        dry_run: bool,
    },
    Answers(commands_study_answers::StudyAnswersArgs),
    Report(study_report::StudyReportArgs),
    /// Delete a participant with all answers, because the person asks for it
    ///
    /// The answers leave the study and every export, but not the file: the history keeps them, so that undo can restore
    /// them, and copies of the corpus made earlier have them too. If nothing may remain, import the other answers into a
    /// corpus that never had these.
    Forget {
        /// The corpus
        corpus: PathBuf,
        /// The name of the study
        name: String,
        /// The code that the participant chose
        code: String,
    },
    /// Delete a study with all its answers; undo restores it
    Delete {
        /// The corpus
        corpus: PathBuf,
        /// The name of the study
        name: String,
    },
}

#[derive(Debug, clap::Args)]
struct NewArgs {
    /// The corpus
    corpus: PathBuf,
    /// The name of the study
    name: String,
    /// A plan as JSON, instead of all other options; - is standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = ["title", "items", "conditions", "trials", "asks"])]
    plan: Option<PathBuf>,
    /// The title that participants see; without it the name
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// The items, separated by blanks
    #[arg(long, value_name = "ITEMS", requires = "conditions")]
    items: Option<String>,
    /// A condition: its name, and a recipe with {} for the item; may be repeated
    #[arg(long = "condition", value_name = "NAME=RECIPE", value_parser = parse_study_condition, requires = "items")]
    conditions: Vec<(String, String)>,
    /// A table of trials with the columns item, condition, clip, and if wished role (training, main, check), part,
    /// answer; other columns are measures of the clip
    #[arg(long, value_name = "FILE")]
    trials: Option<PathBuf>,
    /// A question: realism, realism=1-7, gloss=items (the items as options), 'place=left right', or place@PART=… for one
    /// part of the study; may be repeated
    #[arg(long = "ask", value_name = "QUESTION")]
    asks: Vec<String>,
    /// The highest answer of scales, from 2 to 9
    #[arg(long, default_value_t = 5, value_name = "N", value_parser = clap::value_parser!(i64).range(2..=9))]
    scale: i64,
    /// The order of conditions
    #[arg(long, value_parser = CONDITION_ORDER_CHOICES, default_value = "latin")]
    order: ConditionOrder,
    /// The seed of all shuffles
    #[arg(long, default_value_t = 1, value_name = "N")]
    seed: u64,
    /// How often each trial is shown, from 1 to 20
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20))]
    blocks: u32,
    /// Show each item to a participant in one condition only
    #[arg(long)]
    between: bool,
    /// Add the measure distance to each trial: the distance of its clip from that of the same item in this condition, as
    /// in `chereme score`; the report correlates answers with it
    #[arg(long, value_name = "CONDITION")]
    distance_from: Option<String>,
}

/// The orders of conditions.
const CONDITION_ORDER_CHOICES: NamedChoices<ConditionOrder> = NamedChoices(&[
    (
        "latin",
        "Balanced Latin square: each condition follows each other equally often",
        ConditionOrder::Latin,
    ),
    ("random", "Shuffled", ConditionOrder::Random),
]);

/// Parses a condition.
fn parse_study_condition(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, recipe)) if !name.trim().is_empty() && !recipe.trim().is_empty() => {
            Ok((name.trim().to_owned(), recipe.trim().to_owned()))
        }
        _ => Err("write a name, =, and a recipe with {} for the item: 'captured={}'".to_owned()),
    }
}

pub(super) fn run(cli: &CommandLine, args: &StudyArgs, output: &mut CommandOutput) -> Result<ExitCode> {
    match &args.action {
        StudyCommand::Import {
            corpus,
            name,
            files,
            columns,
            dry_run,
        } => {
            let columns = columns.as_deref().map(Corpus::read_study_text);
            let options = AnswersOptions {
                columns: columns.transpose()?,
                dry_run: *dry_run,
            };
            import_study_answers(cli, corpus, name, files, &options, output)
        }
        other => run_study_action(cli, other, output).map(|()| ExitCode::SUCCESS),
    }
}

fn run_study_action(cli: &CommandLine, action: &StudyCommand, output: &mut CommandOutput) -> Result<()> {
    match action {
        StudyCommand::New(new) => plan_new_study(cli, new, output),
        StudyCommand::Show { corpus, name } => {
            let study = cli.open_cli_corpus(corpus)?.study_with_answers(name)?;
            print_study_plan(&study.plan, output)?;
            if !study.participants.is_empty() {
                let count = output.format_counted_noun(study.participants.len() as u64, "participants");
                output.filled_line("answered by {count}", &[&count])?;
            }
            output.set_json_document(study.plan)
        }
        StudyCommand::Build {
            corpus,
            name,
            to,
            height,
            rate,
            force,
            audience,
        } => {
            let options = QuestionnaireOptions {
                audience: audience.parse()?,
                height: usize::from(*height),
                rate: *rate,
                force: *force,
            };
            let mut corpus = cli.open_cli_corpus(corpus)?;
            let done = with_progress_bar(|progress| corpus.build_study(name, to, options, progress))?;
            output.filled_line(
                "questionnaire {path}: {n} films, {orders} orders of trials, {size} KB",
                &[
                    &done.page.display(),
                    &done.films,
                    &done.orders,
                    &done.bytes.div_ceil(1000),
                ],
            )?;
            for picture in &done.missing {
                output.write_warning(&format!(
                    "the plan names a picture that is missing: {}",
                    picture.display()
                ))?;
            }
            for [one, other] in &done.alike {
                output.write_warning(&format!("these clips give the same film: {one}; {other}"))?;
            }
            output.set_json_document(done)
        }
        // Its exit code is its own.
        StudyCommand::Import { .. } => Ok(()),
        StudyCommand::Answers(args) => commands_study_answers::run(cli, args, output),
        StudyCommand::Report(args) => study_report::run(cli, args, output),
        StudyCommand::Forget { corpus, name, code } => {
            cli.open_cli_corpus(corpus)?.forget_participant(name, code)?;
            output.filled_line(
                "deleted {code}; undo restores the answers, so the file still holds them",
                &[&code],
            )?;
            output.set_json_document(serde_json::json!({ "study": name, "participant": code }))
        }
        StudyCommand::Delete { corpus, name } => {
            cli.open_cli_corpus(corpus)?.delete_study(name)?;
            output.filled_line("deleted the study {name}", &[&name])?;
            output.set_json_document(serde_json::json!({ "study": name }))
        }
    }
}

/// Imports answers; nothing but refused files is a failure.
fn import_study_answers(
    cli: &CommandLine,
    corpus: &Path,
    name: &str,
    files: &[PathBuf],
    options: &AnswersOptions,
    output: &mut CommandOutput,
) -> Result<ExitCode> {
    let mut corpus = cli.open_cli_corpus(corpus)?;
    let report = with_progress_bar(|progress| corpus.import_answers(name, files, options, progress))?;
    for file in &report.files {
        print_column_uses(&file.columns, output)?;
        if file.findings.is_empty() && file.status != FileStatus::Refused {
            continue;
        }
        let refused = match file.status {
            FileStatus::Refused => ": REFUSED",
            _ => "",
        };
        output.write_output_line(format!("{}{refused}", file.path))?;
        for finding in &file.findings {
            print_finding(finding, output)?;
        }
    }
    output.filled_line(
        "{files}: {n} new, {more} replaced, {same} unchanged; {count} answers stored",
        &[
            &output.format_counted_noun(report.files.len() as u64, "files"),
            &report.added,
            &report.replaced,
            &report.unchanged,
            &report.answers,
        ],
    )?;
    let refused = |file: &AnswersFile| file.status == FileStatus::Refused;
    if options.dry_run {
        output.write_output_line("nothing was stored: this was a dry run")?;
    }
    // Some good files of many are a success, as their answers are stored.
    let code = match report.files.iter().all(refused) {
        true => ExitCode::FAILURE,
        false => ExitCode::SUCCESS,
    };
    output.set_json_document(report)?;
    Ok(code)
}

/// Prints the use of the columns of a table.
fn print_column_uses(uses: &[ColumnUse], output: &mut CommandOutput) -> Result<()> {
    if uses.is_empty() {
        return Ok(());
    }
    output.write_item_table(
        uses,
        &[
            ("column", &|used| used.column.clone()),
            ("means", &|used| used.means.clone()),
            ("cells", &|used| used.cells.to_string()),
            ("example", &|used| used.example.clone()),
            ("stands for", &|used| used.stands_for.clone()),
        ],
    )
}

fn plan_new_study(cli: &CommandLine, args: &NewArgs, output: &mut CommandOutput) -> Result<()> {
    let named =
        |path: &PathBuf| -> Result<(String, String)> { Ok((read_named_text(path)?, path.display().to_string())) };
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let mut plan = match &args.plan {
        Some(path) => {
            let (text, place) = named(path)?;
            let mut plan = Corpus::read_plan(&text, &place)?;
            // One plan may be stored under several names.
            plan.name.clone_from(&args.name);
            plan
        }
        None => {
            let request = StudyRequest {
                name: args.name.clone(),
                title: args.title.clone(),
                items: args.items.as_deref().map(split_quoted_words).unwrap_or_default(),
                conditions: args.conditions.clone(),
                trials: args.trials.as_ref().map(named).transpose()?,
                questions: args.asks.clone(),
                scale: args.scale,
                design: TrialDesign {
                    order: args.order,
                    seed: args.seed,
                    blocks: args.blocks,
                    between: args.between,
                },
                ..StudyRequest::default()
            };
            request.make_study_plan()?
        }
    };
    if let Some(condition) = &args.distance_from {
        with_progress_bar(|progress| corpus.measure_distances(&mut plan, condition, progress))?;
    }
    let done = with_progress_bar(|progress| corpus.plan_study(&plan, progress))?;
    print_study_plan(&done.plan, output)?;
    output.write_output_line(match done.replaced {
        true => "replaced the plan, which nobody had answered",
        false => "stored the plan",
    })?;
    output.set_json_document(done)
}

fn print_study_plan(plan: &StudyPlan, output: &mut CommandOutput) -> Result<()> {
    let language = output.output_language().language_code();
    let local_text = |texts: &LocalizedTexts| text_in(texts, language).unwrap_or_default().to_owned();
    output.line_as_is(&format!("{}: {}", plan.name, local_text(&plan.title)))?;
    let right = |trial: &StudyTrial| trial.right.values().map(String::as_str).collect::<Vec<_>>().join(" ");
    output.write_item_table(
        &plan.trials,
        &[
            ("part", &|trial| trial.part.clone()),
            ("role", &|trial| trial.role.trial_role_name().to_owned()),
            ("item", &|trial| trial.item.clone()),
            ("condition", &|trial| trial.condition.clone()),
            ("right answer", &right),
            ("clip", &|trial| trial.clip.clone()),
        ],
    )?;
    output.write_item_table(
        &plan.questions,
        &[
            ("question", &|entry| entry.name.clone()),
            ("answers", &|entry| format_possible_answers(entry)),
            ("parts", &|entry| entry.parts.join(" ")),
            ("text", &|entry| local_text(&entry.text)),
        ],
    )
}

/// Returns the possible answers to a question in short.
fn format_possible_answers(question: &StudyQuestion) -> String {
    let answers = match &question.kind {
        QuestionKind::Scale { low, high, .. } => format!("{low}-{high}"),
        QuestionKind::Choice { options } => {
            let names: Vec<&str> = options.iter().map(|option| option.name.as_str()).collect();
            names.join(" ")
        }
    };
    match question.after {
        QuestionViewing::First => answers,
        QuestionViewing::Second => format!("{answers} (2)"),
    }
}
