//! `chereme agree`: compares what two annotators made of the same recordings.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    AgreeOptions, AnnotatorAgreement, CorpusError, DisagreementSide, MeasureFigure, NumberQuartiles, RowName,
    TableMoment, USUAL_MEASURES, ValueDisagreement,
};
use serde_json::json;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Measure how far two annotators agree, on which values they differ, and where
///
/// Two tiers are compared in every recording that has both. A tier is named by its name; by a pattern, "*-A" and "*-B",
/// whose star stands for the same text in both; by annotator:NAME, for the tiers of both people that describe the
/// same; or by tier:12, also of two recordings. Annotations without a value are left out; if nobody gave a value, the
/// spans alone are compared.
///
/// Measures: kappa_ipf, raw, matched, kappa, kappa_max (ELAN's modified kappa of Holle and Rein: units match if 60 % of the
/// longer one overlap); alpha_u, u_alpha, u_alpha_spans, cu_alpha (Krippendorff, over time); gamma, gamma_cat (Mathet, by
/// alignment; chance is drawn as in pygamma-agreement); label_raw, label_kappa, label_pi, label_ac1, label_alpha,
/// label_alpha_features (values of matched units alone; the last weighs the features of handshapes); overlap_a, overlap_b
/// (ELAN's ratio of overlap, from either tier); frames_raw, frames_kappa, frames_alpha (10 ms each); boundaries (boundary
/// similarity of tiers without gaps); segment_mf1s, segment_mf1b, segment_f1, segment_iou, segment_overlap, segment_count,
/// segment_splits, segment_merges (spans alone on a grid of 40 ms, the tier of --a being the truth: mF1S and mF1B of Renz et
/// al., F1 of spans that share more than half, IoU of frames, mean overlap of pairs, and for each true unit the units, splits
/// and merges of --b). Asked for by name, and with movement, they are printed beside the simplest ways to cut the takes:
/// uniform with the true count, every minimum of speed, one span an activity. A measure that is undefined has a reason instead of a number. With fewer than 10
/// units, or one value, only counts are printed.
///
/// Intervals hold 95 of 100 draws of units, or of recordings if there are 10 or more. That of gamma only shows how exact
/// its chance is: more --samples make it narrower.
///
/// `--json` gives "a", "b", "values", "units_a", "units_b", "matched", "equal", "unmatched_a", "unmatched_b",
/// "left_out_a", "left_out_b", "counts_only", "measures" (each with "value" or null, "why", and "interval"), "onset_s" and
/// "offset_s" (b less a: "q1", "median", "q3"), "by_value", "disagreements" (their numbers), "pairs" (each pair of tiers),
/// "baselines" (each "baseline" with its "measures") and "findings"; with --list "list", with --confusion "confusion", with --into "adjudicated".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme agree mine.chereme --a 'Gloss Anna' --b 'Gloss Ben'
  chereme agree mine.chereme --a '*-A' --b '*-B' --in recording:3 --list
  chereme agree mine.chereme --a annotator:Anna --b annotator:Ben --confusion
  chereme agree mine.chereme --a tier:4 --b tier:19 --measure kappa_ipf --json
  chereme agree mine.chereme --a 'Gloss Anna' --b 'Gloss Ben' --into Gloss   (then decide: chereme conflicts mine.chereme)")]
pub(crate) struct AgreeArgs {
    /// The corpus
    corpus: PathBuf,
    /// The tier of the first annotator
    #[arg(long, value_name = "TIER")]
    a: String,
    /// The tier of the second annotator
    #[arg(long, value_name = "TIER")]
    b: String,
    /// Only this recording
    #[arg(long = "in", value_name = "RECORDING")]
    recording: Option<String>,
    /// Only these measures, separated by commas; `all` prints all, and without it the usual five are printed
    #[arg(long = "measure", value_name = "NAME,...", value_delimiter = ',')]
    measures: Vec<String>,
    /// Starts or ends further apart than this are a disagreement
    #[arg(long, value_name = "TIME", default_value = "80ms")]
    tolerance: TableMoment,
    /// The share of the longer unit, in percent, that must overlap for a match: 51 to 100
    #[arg(long, value_name = "PERCENT", default_value_t = 60)]
    overlap: u8,
    /// The number of draws for intervals; 0 computes none
    #[arg(long, value_name = "DRAWS", default_value_t = 1000)]
    bootstrap: usize,
    /// The number of random continua for gamma, at least 30; 0 leaves gamma out
    #[arg(long, value_name = "N", default_value_t = 30)]
    samples: usize,
    /// The seed of all draws; the same seed gives the same numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Count the whole recording as annotated, instead of the time from the first annotation to the last
    #[arg(long)]
    whole: bool,
    /// List the disagreements, the costliest first
    #[arg(long)]
    list: bool,
    /// List the values that were confused, and the features in which they differ
    #[arg(long)]
    confusion: bool,
    /// Write the disagreements to a table (.csv)
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a table that exists already
    #[arg(long)]
    force: bool,
    /// Write what both agree on to a new tier of this name, with a conflict for each disagreement, which `conflicts` decides
    #[arg(long, value_name = "TIER")]
    into: Option<String>,
}

/// The most rows of values that are printed.
const MAX_PRINTED_VALUES: usize = 30;

impl AgreeArgs {
    fn agreement_arg_options(&self) -> Result<AgreeOptions> {
        let tolerance_us = match self.tolerance {
            TableMoment::Time(time) if time.instant_micros() >= 0 => time.instant_micros(),
            _ => {
                return Err(CorpusError::from_wrong_message("a tolerance is a time of 0 or more")
                    .with_error_place("--tolerance")
                    .with_advice("write 80ms, or 0.08s")
                    .into());
            }
        };
        // No names ask for all measures in the library.
        let all = self.measures.iter().any(|name| name == "all");
        Ok(AgreeOptions {
            recording: self
                .recording
                .as_deref()
                .map(RowName::parse_recording_name)
                .transpose()?,
            measures: if all { Vec::new() } else { self.measures.clone() },
            share: f64::from(self.overlap) / 100.0,
            tolerance_us,
            draws: self.bootstrap,
            samples: self.samples,
            seed: self.seed,
            whole: self.whole,
            ..AgreeOptions::new(&self.a, &self.b)
        })
    }

    /// Returns whether a measure is printed.
    fn prints(&self, measure: &str) -> bool {
        match self.measures.is_empty() {
            true => USUAL_MEASURES.contains(&measure),
            false => self.measures.iter().any(|name| name == measure || name == "all"),
        }
    }
}

pub(super) fn run(cli: &CommandLine, args: &AgreeArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = args.agreement_arg_options()?;
    let agreement = with_progress_bar(|progress| corpus.compare_annotators(&options, progress))?;
    let adjudicated = match &args.into {
        Some(into) => Some(with_progress_bar(|progress| {
            corpus.adjudicate_tiers(&options, into, progress)
        })?),
        None => None,
    };
    print_agreement(&agreement, args, output)?;
    let mut document = serde_json::to_value(&agreement)?;
    if args.confusion {
        print_annotator_confusion(&agreement, output)?;
        document["confusion"] = json!(agreement.confusion);
    }
    if args.list {
        print_disagreements(&agreement.list, output)?;
        document["list"] = json!(agreement.list);
    }
    if let Some(path) = &args.to {
        agreement.write_disagreements(path, args.force)?;
        output.filled_line("table of disagreements: {path}", &[&path.display()])?;
    }
    if let Some(it) = adjudicated {
        output.filled_line(
            "on the tier {name}: {annotations} on which both agree; {conflicts} to decide",
            &[
                &format_args!("{:?}", it.tier),
                &output.format_counted_noun(it.agreed, "annotations"),
                &output.format_counted_noun(it.conflicts, "conflicts"),
            ],
        )?;
        document["adjudicated"] = json!(it);
    }
    output.set_json_document(document)
}

/// Prints counts, measures, and the table of values.
fn print_agreement(found: &AnnotatorAgreement, args: &AgreeArgs, output: &mut CommandOutput) -> Result<()> {
    output.write_warnings(&found.findings)?;
    let counts = &found.counts;
    output.filled_line(
        "{a} has {n} units and {b} has {m}, in {pairs}",
        &[
            &format_args!("{:?}", found.a),
            &counts.units_a,
            &format_args!("{:?}", found.b),
            &counts.units_b,
            &output.format_counted_noun(found.pairs.len() as u64, "pairs of tiers"),
        ],
    )?;
    output.filled_line(
        "matched: {n}, {equal} of them with equal values; only a: {a}, only b: {b}",
        &[&counts.matched, &counts.equal, &counts.unmatched_a, &counts.unmatched_b],
    )?;
    let kinds = &found.disagreements;
    output.filled_line(
        "disagreements in the alignment: only a {a}, only b {b}, other value {value}, start or end \
         {boundary}",
        &[&kinds.only_a, &kinds.only_b, &kinds.value, &kinds.boundary],
    )?;
    if let (Some(onset), Some(offset)) = (&found.onset_s, &found.offset_s) {
        output.filled_line(
            "start of b less a: {onset}; end: {offset} (median and quartiles, in ms)",
            &[&quartiles(onset), &quartiles(offset)],
        )?;
    }
    // Too few units make misleading figures; JSON has them for those who know.
    if found.counts_only && found.baselines.is_empty() {
        output.write_output_line("too few units or values for figures; with --json they are computed all the same")?;
        return Ok(());
    }
    let shown = found.measures.iter().filter(|(name, _)| args.prints(name));
    let rows: Vec<Vec<String>> = shown
        .map(|(name, figure)| {
            vec![
                (*name).to_owned(),
                format_figure_value(figure, output),
                format_figure_interval(figure),
                describe_drawn_samples(figure, output),
            ]
        })
        .collect();
    output.write_titled_table(&["measure", "value", "95 %", "draws"], &rows)?;
    for baseline in &found.baselines {
        let shown = baseline.measures.iter().filter(|(name, _)| args.prints(name));
        let figures: Vec<String> = shown
            .map(|(name, figure)| format!("{name} {}", format_figure_value(figure, output)))
            .collect();
        output.filled_line("baseline {name}: {figures}", &[&baseline.baseline, &figures.join(", ")])?;
    }
    let shown_values = found.by_value.iter().take(MAX_PRINTED_VALUES);
    let rows: Vec<Vec<String>> = shown_values
        .map(|entry| {
            vec![
                entry.value.clone(),
                entry.a.to_string(),
                entry.b.to_string(),
                entry.both.to_string(),
                entry.other.to_string(),
                entry.alone.to_string(),
                format_figure_value(&entry.kappa, output),
                format_figure_value(&entry.alpha_u, output),
            ]
        })
        .collect();
    if !rows.is_empty() {
        let titles = ["value", "a", "b", "both", "other value", "alone", "kappa", "alpha_u"];
        output.write_titled_table(&titles, &rows)?;
    }
    if found.by_value.len() > MAX_PRINTED_VALUES {
        let more = found.by_value.len() - MAX_PRINTED_VALUES;
        output.filled_line("values that are not shown: {n}; --json has all", &[&more])?;
    }
    if found.pairs.len() > 1 {
        let rows: Vec<Vec<String>> = found
            .pairs
            .iter()
            .map(|entry| pair_agreement_row(entry, output))
            .collect();
        let titles = [
            "recording",
            "tier a",
            "tier b",
            "a",
            "b",
            "matched",
            "equal",
            "kappa_ipf",
            "alpha_u",
        ];
        output.write_titled_table(&titles, &rows)?;
    }
    Ok(())
}

fn pair_agreement_row(it: &chereme_corpus::PairAgreement, output: &CommandOutput) -> Vec<String> {
    let figure = |name: &str| {
        let matching_measure = it.measures.iter().find(|(own, _)| *own == name);
        matching_measure
            // A pair with few units has counts and no figures.
            .filter(|_| !it.counts.are_few())
            .map(|(_, figure)| format_figure_value(figure, output))
            .unwrap_or_default()
    };
    vec![
        it.recording.clone(),
        it.tier_a.clone(),
        it.tier_b.clone(),
        it.counts.units_a.to_string(),
        it.counts.units_b.to_string(),
        it.counts.matched.to_string(),
        it.counts.equal.to_string(),
        figure("kappa_ipf"),
        figure("alpha_u"),
    ]
}

/// Returns the value of a measure, or the reason why it has none.
fn format_figure_value(figure: &MeasureFigure, output: &CommandOutput) -> String {
    match (figure.figure_text(), &figure.why) {
        (Some(value), _) => value,
        (None, Some(why)) => format!("- ({})", output.translate_message(why)),
        (None, None) => String::new(),
    }
}

fn format_figure_interval(figure: &MeasureFigure) -> String {
    let shown = figure
        .interval
        .map(|range| format!("{:.3} … {:.3}", range.low, range.high));
    shown.unwrap_or_default()
}

/// Returns how many draws an interval comes from, and what was drawn.
fn describe_drawn_samples(figure: &MeasureFigure, output: &CommandOutput) -> String {
    let shown = figure.interval.map(|range| {
        let of = chereme_corpus::words::noun_form_for_count(2, range.of, output.output_language());
        format!("{} × {of}", range.draws)
    });
    shown.unwrap_or_default()
}

fn quartiles(it: &NumberQuartiles) -> String {
    let [q1, median, q3] = [it.q1, it.median, it.q3].map(|seconds| format!("{:+.0}", seconds * 1000.0));
    format!("{median} ({q1} … {q3})")
}

fn print_annotator_confusion(found: &AnnotatorAgreement, output: &mut CommandOutput) -> Result<()> {
    output.write_item_table(
        &found.confusion,
        &[
            ("times", &|entry| entry.count.to_string()),
            ("a", &|entry| entry.a.clone()),
            ("b", &|entry| entry.b.clone()),
            ("features of a alone", &|entry| entry.only_a.join(" ")),
            ("features of b alone", &|entry| entry.only_b.join(" ")),
        ],
    )
}

fn print_disagreements(found: &[ValueDisagreement], output: &mut CommandOutput) -> Result<()> {
    let side = |optional_side: &Option<DisagreementSide>| {
        optional_side
            .as_ref()
            .map(|side| side.value.clone())
            .unwrap_or_default()
    };
    let apart =
        |disagreement: &ValueDisagreement, time: fn(&DisagreementSide) -> i64| match (&disagreement.a, &disagreement.b)
        {
            (Some(a), Some(b)) => format!("{:+.0}", (time(b) - time(a)) as f64 / 1000.0),
            _ => String::new(),
        };
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    output.write_item_table(
        found,
        &[
            ("recording", &|disagreement| disagreement.recording.clone()),
            ("from (s)", &|disagreement| seconds(disagreement.start_us)),
            ("to (s)", &|disagreement| seconds(disagreement.end_us)),
            ("kind", &|disagreement| {
                disagreement.kind.disagreement_kind_name().to_owned()
            }),
            ("a", &|disagreement| side(&disagreement.a)),
            ("b", &|disagreement| side(&disagreement.b)),
            ("start (ms)", &|disagreement| apart(disagreement, |side| side.start_us)),
            ("end (ms)", &|disagreement| apart(disagreement, |side| side.end_us)),
            ("cost", &|disagreement| format!("{:.2}", disagreement.cost)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use chereme_corpus::MEASURE_NAMES;

    use super::*;

    #[test]
    fn the_help_names_every_measure() {
        let mut command = <crate::args::CommandLine as clap::CommandFactory>::command();
        let agree = command.find_subcommand_mut("agree").expect("the command");
        let help = agree.render_long_help().to_string();
        for measure in MEASURE_NAMES {
            assert!(help.contains(measure), "{measure}");
        }
        assert!(USUAL_MEASURES.iter().all(|it| MEASURE_NAMES.contains(it)));
    }
}
