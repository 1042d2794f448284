//! `chereme cued`: evaluates captured cued speech, from markers to a dictionary of movements.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{
    CorpusError, CueConfusion, CueCosts, CueOptions, CuePhaseStatistics, CueRecognition, CueSlips, CueTargets,
    CuedMarkers, CuedOptions, DictionaryCueOptions, DictionaryReport, FoundKey, FromDictionary, RestoreOptions,
    RestoredTake, RowName, ScriptCoverage, SlipKind, read_marker_labels,
};
use chereme_sign::cue::PhoneAlphabet;
use clap::Subcommand;

use super::cue_command::PHASE_RULE_CHOICES;
use super::track_command::parse_recording_address;
use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Work with captured cued speech: markers, restoration, recognition, targets, phases, dictionary, slips
///
/// A take is a recording of a cuer's markers (C3D, TRC) with tiers called Phones or Keys from a TextGrid or EAF file of
/// the same name. Markers are called FA1-5 on the forearm, HB1-7 on the back of the hand, I, M, R, L 1-8 on the
/// fingers, T1-6 on the thumb; RF1-5, RN1-2, RE1-2 on forehead, nose and ears, LP1-16 on the lips, CK1-12 on the
/// cheeks, JW1-8 on the jaw, TH1-18 on the throat. If the files use other labels, --labels names a table that maps
/// them. Without a named recording the command works on all captured takes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme cued mine.chereme markers recording:3
  chereme cued mine.chereme restore
  chereme cued mine.chereme recognise
  chereme cued mine.chereme targets --store
  chereme cued mine.chereme phases --draw phases.svg
  chereme cued mine.chereme dictionary --script sentences.txt
  chereme cued mine.chereme say 'le chat dort' --as CHAT_DORT
  chereme cued mine.chereme slips recording:3 --text 'le chat dort'")]
pub(crate) struct CuedArgs {
    /// The corpus
    corpus: PathBuf,
    /// The code: french, english-us or english-gb
    #[arg(long, default_value = "french", global = true)]
    code: String,
    /// A habit of the cuer, such as schwa-as-eu; may be repeated
    #[arg(long = "variant", value_name = "NAME", global = true)]
    variants: Vec<String>,
    /// A table of two columns: the program's name of a marker, and its label in the files
    #[arg(long, value_name = "FILE", global = true)]
    labels: Option<PathBuf>,
    #[command(subcommand)]
    action: CuedCommand,
}

#[derive(Debug, Subcommand)]
enum CuedCommand {
    /// Report the known markers of a recording, and how often they are visible
    Markers {
        /// The recording
        #[arg(value_parser = parse_recording_address)]
        recording: RowName,
    },
    /// Restore hidden markers from models of hand and face, as a separate track with predicted errors
    Restore {
        /// The recordings whose markers are restored
        #[arg(value_parser = parse_recording_address)]
        recordings: Vec<RowName>,
        /// The recordings from which the models learn; without it those of the hand alone and of the face alone, or all
        #[arg(long, value_name = "RECORDING", value_parser = parse_recording_address)]
        train: Vec<RowName>,
        /// The number of principal components of the hand's posture, from 1 to 25
        #[arg(long, default_value_t = 20, value_name = "N")]
        components: usize,
        /// Report the errors and store nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Recognise shapes and placements at the targets of keys, with confusion tables
    Recognise {
        /// The recordings from which the recognisers learn; without it every second one
        #[arg(long, value_name = "RECORDING", value_parser = parse_recording_address)]
        train: Vec<RowName>,
        /// The recordings that are recognised; without it all others
        #[arg(long, value_name = "RECORDING", value_parser = parse_recording_address)]
        test: Vec<RowName>,
    },
    /// Find the movements, targets and gestural scores of keys
    Targets {
        /// The recordings
        #[arg(value_parser = parse_recording_address)]
        recordings: Vec<RowName>,
        /// Write them as tiers
        #[arg(long)]
        store: bool,
    },
    /// Measure when hand and fingers start and arrive relative to the sounds, by kind of key
    Phases {
        /// The recordings
        #[arg(value_parser = parse_recording_address)]
        recordings: Vec<RowName>,
        /// Draw medians and quartiles to a picture (.svg)
        #[arg(long, value_name = "FILE")]
        draw: Option<PathBuf>,
        /// Replace a picture that exists already
        #[arg(long)]
        force: bool,
    },
    /// List the movements between keys in captured takes, and those that a script needs in addition
    Dictionary {
        /// The recordings
        #[arg(value_parser = parse_recording_address)]
        recordings: Vec<RowName>,
        /// The script, a text with one sentence on each line: report how much of it the takes cover, and which
        /// sentences would add most
        #[arg(long, value_name = "FILE")]
        script: Option<PathBuf>,
    },
    /// Compose a sentence from the dictionary, and recognise its keys as a check
    Say {
        /// The text, or phones with --phones
        text: String,
        /// Read the input as phones in this alphabet
        #[arg(long, value_parser = super::keys_command::PHONE_ALPHABET_CHOICES, value_name = "ALPHABET")]
        phones: Option<PhoneAlphabet>,
        /// The recordings from which the dictionary is cut
        #[arg(long = "from", value_name = "RECORDING", value_parser = parse_recording_address)]
        recordings: Vec<RowName>,
        /// The rule for the timing of hand and fingers
        #[arg(long, value_parser = PHASE_RULE_CHOICES, default_value = "paper")]
        by: PhaseRule,
        /// The duration of sounds as a multiple of the usual one, from 0.1 to 10; without it 1.6
        #[arg(long, value_name = "FACTOR")]
        pace: Option<f64>,
        /// The cost of a duration that differs by 100 ms
        #[arg(long, default_value_t = 1.0, value_name = "COST")]
        duration_cost: f64,
        /// The cost of a join whose ends differ by the spread within one key
        #[arg(long, default_value_t = 1.0, value_name = "COST")]
        join_cost: f64,
        /// The gloss of the new recording; without it nothing is stored
        #[arg(long = "as", value_name = "GLOSS")]
        gloss: Option<String>,
    },
    /// Compare the keys of a take with those that its phones or a text predict
    Slips {
        /// The recording
        #[arg(value_parser = parse_recording_address)]
        recording: RowName,
        /// The text that was cued; without it the tier of phones predicts the keys
        #[arg(long)]
        text: Option<String>,
        /// Recognise the produced keys from the markers, even if a tier gives them
        #[arg(long)]
        recognised: bool,
    },
}

pub(super) fn run(cli: &CommandLine, args: &CuedArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let labels = args.labels.as_deref().map(read_marker_labels).transpose()?;
    let options = CuedOptions {
        code: args.code.clone(),
        variants: args.variants.clone(),
        labels: labels.unwrap_or_default(),
    };
    match &args.action {
        CuedCommand::Markers { recording } => print_marker_sets(&corpus.cued_markers(recording, &options)?, output),
        CuedCommand::Restore {
            recordings,
            train,
            components,
            dry_run,
        } => {
            let how = RestoreOptions {
                train: train.clone(),
                components: *components,
                dry_run: *dry_run,
                cued: options,
            };
            let done = with_progress_bar(|progress| corpus.restore_markers(recordings, &how, progress))?;
            print_restored_takes(&done, *dry_run, output)
        }
        CuedCommand::Recognise { train, test } => {
            print_cue_recognition(&corpus.recognise_cues(train, test, &options)?, output)
        }
        CuedCommand::Targets { recordings, store } => {
            let take_targets = corpus.find_cue_targets(recordings, *store, &options)?;
            print_cue_targets(&take_targets, *store, output)
        }
        CuedCommand::Phases {
            recordings,
            draw,
            force,
        } => {
            let phase_statistics = corpus.cue_phases(recordings, &options)?;
            print_cue_phases(&phase_statistics, output)?;
            if let Some(path) = draw {
                phase_statistics.draw_cue_phases(path, *force)?;
                output.filled_line("drew {path}", &[&path.display()])?;
            }
            output.set_json_document(phase_statistics)
        }
        CuedCommand::Dictionary { recordings, script } => {
            let read_script = |path: &PathBuf| {
                std::fs::read_to_string(path).map_err(|error| CorpusError::from_file_failure(path, error))
            };
            let text = script.as_ref().map(read_script).transpose()?;
            let cue_book =
                with_progress_bar(|progress| corpus.cue_dictionary(recordings, text.as_deref(), &options, progress))?;
            print_cue_dictionary(&cue_book, output)
        }
        CuedCommand::Say {
            text,
            phones,
            recordings,
            by,
            pace,
            duration_cost,
            join_cost,
            gloss,
        } => {
            let mut how = CueOptions {
                phase: *by,
                ..CueOptions::default()
            };
            how.reading.phones = *phones;
            how.reading.pace = *pace;
            how.reading.code.clone_from(&options.code);
            how.reading.variants.clone_from(&options.variants);
            let request = DictionaryCueOptions {
                cue: &how,
                cued: &options,
                costs: CueCosts {
                    duration: *duration_cost,
                    join: *join_cost,
                },
                recordings,
            };
            let composed =
                with_progress_bar(|progress| corpus.cue_from_dictionary(text, &request, gloss.as_deref(), progress))?;
            print_comparison(&composed, output)?;
            output.set_json_document(composed)
        }
        CuedCommand::Slips {
            recording,
            text,
            recognised,
        } => print_cue_slips(
            &corpus.cue_slips(recording, text.as_deref(), *recognised, &options)?,
            output,
        ),
    }
}

fn print_marker_sets(markers: &CuedMarkers, output: &mut CommandOutput) -> Result<()> {
    for (name, set) in [("hand", &markers.hand), ("face", &markers.face)] {
        let visible = format!(
            "{name}: {} markers, {:.1} % of their positions visible",
            set.found,
            set.seen * 100.0
        );
        output.write_output_line(match set.missing.len() {
            0 => visible,
            // The names of more would fill several lines, and mean that the labels are not the program's.
            1..=12 => format!("{visible}; missing: {}", set.missing.join(", ")),
            count => format!("{visible}; {count} are missing"),
        })?;
    }
    if !markers.unused.is_empty() {
        output.filled_line("not used: {names}", &[&markers.unused.join(", ")])?;
    }
    output.filled_line(
        "{n} frames at {rate} a second; {hidden} hidden places restored",
        &[&markers.frames, &markers.rate, &markers.restored],
    )?;
    output.set_json_document(markers)
}

fn print_restored_takes(takes: &[RestoredTake], dry_run: bool, output: &mut CommandOutput) -> Result<()> {
    let mm = |value: Option<f64>| value.map_or_else(String::new, |number| format!("{number:.2}"));
    output.write_item_table(
        takes,
        &[
            ("recording", &|take| take.recording.clone()),
            ("frames", &|take| take.frames.to_string()),
            ("hidden", &|take| take.hidden.to_string()),
            ("restored", &|take| take.restored.to_string()),
            ("uncertain", &|take| take.uncertain.to_string()),
            ("hand_mm", &|take| mm(take.hand_mm)),
            ("hand_axis_mm", &|take| mm(take.hand_axis_mm)),
            ("face_mm", &|take| mm(take.face_mm)),
        ],
    )?;
    // Findings are about the models, which are the same for all takes.
    output.write_warnings(takes.first().iter().flat_map(|take| &take.findings))?;
    if dry_run {
        output.write_output_line("nothing was stored")?;
    }
    output.set_json_document(takes)
}

fn print_cue_recognition(recognition: &CueRecognition, output: &mut CommandOutput) -> Result<()> {
    output.write_output_line(format!(
        "{} recognised after training on {}",
        output.format_counted_noun(recognition.tested_on.len() as u64, "recordings"),
        output.format_counted_noun(recognition.trained_on.len() as u64, "recordings"),
    ))?;
    if recognition.same {
        output.write_output_line("warning: the recognisers were tested on the keys from which they learned")?;
    }
    output.write_warnings(&recognition.findings)?;
    print_cue_confusion("shapes", &recognition.shapes, output)?;
    print_cue_confusion("placements", &recognition.placements, output)?;
    output.set_json_document(recognition)
}

fn print_cue_targets(takes: &[CueTargets], is_stored: bool, output: &mut CommandOutput) -> Result<()> {
    let count = |take: &CueTargets, time: fn(&FoundKey) -> Option<[i64; 2]>| {
        take.keys.iter().filter_map(time).count().to_string()
    };
    output.write_item_table(
        takes,
        &[
            ("recording", &|take| take.recording.clone()),
            ("keys", &|take| take.keys.len().to_string()),
            ("hand", &|take| count(take, |key| key.hand_us)),
            ("fingers", &|take| count(take, |key| key.fingers_us)),
            ("tiers", &|take| take.tiers.join(", ")),
        ],
    )?;
    output.write_warnings(takes.iter().flat_map(|take| &take.findings))?;
    if !is_stored {
        output.write_output_line("nothing was stored; --store writes tiers")?;
    }
    output.set_json_document(takes)
}

fn print_cue_phases(statistics: &CuePhaseStatistics, output: &mut CommandOutput) -> Result<()> {
    // Quartiles lie around the median, which readers look for first.
    let milliseconds = |[low, median, high]: [f64; 3]| format!("{median:+.0} ({low:+.0} to {high:+.0})");
    let share = |[low, median, high]: [f64; 3]| format!("{median:.2} ({low:.2} to {high:.2})");
    output.write_item_table(
        &statistics.rows,
        &[
            ("part", &|row| row.part.to_owned()),
            ("kind", &|row| row.kind.to_owned()),
            ("n", &|row| row.n.to_string()),
            ("begins ms: median (quartiles)", &|row| milliseconds(row.begins_ms)),
            ("arrives ms", &|row| milliseconds(row.arrives_ms)),
            ("share", &|row| share(row.share)),
        ],
    )?;
    output.write_warnings(&statistics.findings)
}

fn print_cue_dictionary(cue_book: &DictionaryReport, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "{n} movements from {recordings}: {found} of {all} pairs of keys; components miss \
         markers by {mm} mm",
        &[
            &cue_book.dikeys,
            &output.format_counted_noun(cue_book.recordings.len() as u64, "recordings"),
            &cue_book.kinds,
            &cue_book.of,
            &format_args!("{:.2}", cue_book.missed_mm),
        ],
    )?;
    for left in &cue_book.left_out {
        let left = output.translate_message(left);
        output.filled_line("left out: {what}", &[&left])?;
    }
    match &cue_book.script {
        Some(script) => print_script_coverage(script, output)?,
        None => output.write_item_table(
            &cue_book.pairs,
            &[
                ("pair", &|row| row.pair.clone()),
                ("count", &|row| row.count.to_string()),
                ("first source", &|row| row.sources.first().cloned().unwrap_or_default()),
            ],
        )?,
    }
    output.set_json_document(cue_book)
}

fn print_script_coverage(script: &ScriptCoverage, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "the script: {n} sentences, {pairs} pairs, {share} % of them in the \
         dictionary; {missing} different ones are missing",
        &[
            &script.sentences,
            &script.pairs,
            &format_args!("{:.1}", script.covered * 100.0),
            &script.missing.len(),
        ],
    )?;
    output.write_item_table(
        &script.worth,
        &[
            ("line", &|sentence| sentence.line.to_string()),
            ("adds", &|sentence| sentence.adds.to_string()),
            ("sentence", &|sentence| sentence.text.clone()),
        ],
    )
}

fn print_cue_slips(slips: &CueSlips, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "{n} keys predicted by {code}, {produced} produced ({rate}); {same} as predicted",
        &[
            &slips.predicted,
            &output.translate_message(slips.predicted_by),
            &slips.produced,
            &output.translate_message(slips.produced_by),
            &slips.right,
        ],
    )?;
    for kind in [
        SlipKind::Insertion,
        SlipKind::Deletion,
        SlipKind::Placement,
        SlipKind::Shape,
        SlipKind::Both,
    ] {
        let count = slips.count_slips_of(kind);
        if count > 0 {
            output.write_output_line(format!("{}: {count}", kind.slip_kind_name()))?;
        }
    }
    let seconds = |micros: i64| format!("{:.2}", micros as f64 / 1e6);
    output.write_item_table(
        &slips.slips,
        &[
            ("seconds", &|slip| slip.at_us.map_or_else(String::new, seconds)),
            ("slip", &|slip| slip.kind.slip_kind_name().to_owned()),
            ("predicted", &|slip| slip.predicted.clone().unwrap_or_default()),
            ("produced", &|slip| slip.produced.clone().unwrap_or_default()),
        ],
    )?;
    output.set_json_document(slips)
}

fn print_cue_confusion(name: &str, of: &CueConfusion, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "{name}: {share} % right; shown in rows, recognised in columns",
        &[&name, &format_args!("{:.1}", of.rate * 100.0)],
    )?;
    let titles: Vec<&str> = std::iter::once("")
        .chain(of.classes.iter().map(String::as_str))
        .collect();
    let rows: Vec<Vec<String>> = of
        .classes
        .iter()
        .zip(&of.counts)
        .map(|(class, counts)| {
            std::iter::once(class.clone())
                .chain(counts.iter().map(u64::to_string))
                .collect()
        })
        .collect();
    output.write_named_columns(&titles, &rows)
}

fn print_comparison(composed: &FromDictionary, output: &mut CommandOutput) -> Result<()> {
    output.write_item_table(
        &composed.pieces,
        &[
            ("seconds", &|piece| format!("{:.2}", piece.at_us as f64 / 1e6)),
            ("wanted", &|piece| piece.wanted.clone()),
            ("instead", &|piece| piece.instead.clone().unwrap_or_default()),
            ("source", &|piece| piece.source.clone()),
            ("duration", &|piece| format!("{:.2}", piece.duration_cost)),
            ("join", &|piece| format!("{:.2}", piece.join_cost)),
            ("read back", &|piece| piece.read.clone().unwrap_or_default()),
        ],
    )?;
    output.filled_line(
        "{n} keys in {seconds} s: {exact} exact, {others} stand in for others, \
         {synthetic} synthetic; cost {cost}",
        &[
            &composed.keys,
            &format_args!("{:.2}", composed.duration_us as f64 / 1e6),
            &composed.exact,
            &composed.backed_off,
            &composed.synthetic,
            &format_args!("{:.2}", composed.cost),
        ],
    )?;
    if let (Some(shapes), Some(placements)) = (composed.shapes_read, composed.placements_read) {
        output.filled_line(
            "read back: {shapes} % of shapes, {placements} % of placements",
            &[
                &format_args!("{:.1}", shapes * 100.0),
                &format_args!("{:.1}", placements * 100.0),
            ],
        )?;
    }
    output.write_warnings(&composed.findings)?;
    match &composed.recording {
        Some(name) => output.filled_line("stored as {name}", &[&name]),
        None => output.write_output_line("nothing was stored; --as GLOSS stores it"),
    }
}
