//! `chereme stats`: the statistics of a lexicon.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    BattisonConditions, Corpus, EmptyCellTreatment, FieldAssociation, FieldInDepth, FieldStatistics, FieldValue,
    HandCondition, LexiconStatistics, MeasuredSign, NeighbourDefinition, SignMeasureOptions, StatsEstimate,
    StatsFinding, StatsOptions,
};

use super::lexicon_command::LexiconScopeArgs;
use super::pairs_command::EMPTY_CELL_CHOICES;
use crate::args::{CommandLine, NamedChoices};
use crate::output::{CommandOutput, with_progress_bar};

/// Describe a lexicon by numbers: entropy, functional load, association of fields, conditions on the hands
///
/// Every sign counts once, by its citation form; with a query every token that it finds. Fields are columns of an imported
/// table, whose cells are taken as written, or fields of queries such as dominant.configuration, as in `chereme pairs`.
///
/// Entropy is in bits, from the shares as they are. The functional load of a field is the share of the entropy of forms
/// that is lost without it, (H(L) - H(L without it)) / H(L); that of a contrast is the share that is lost if its two values are
/// one. Intervals of 95 % are the jackknife's over entries, and Wilson's for shares. Draws with replacement would take the
/// same entry twice, as a homonym that the lexicon does not have.
///
/// Association counts the entries that have both fields: mutual information, chi-square and Cramér's V. p is the share of
/// shuffled lexica in which they go together at least as much. Fields with many rare values share information by chance
/// alone: compare with the mean of the shuffled ones.
///
/// Battison's conditions: symmetrical signs have the same handshape on both hands; asymmetrical ones have the same one, or an
/// unmarked one on the weak hand. They need the type of a sign (Signbank's 1, 2s, 2a, or words such as ASL-LEX's) and both
/// handshapes.
///
/// `--per sign` measures each sign: density (neighbours that differ in at most `--within` fields), minimal pairs by field,
/// homonyms, family (signs that are equal but for the handshape), the mean share of its values and of its pairs of values in
/// their fields, captured tokens (the two hands count once) and their signers. `--store` keeps them with the entries:
/// `density>20` is then a query, and `search --sort density`, `--count density` and tables know them.
///
/// `--json` gives "source" (columns, citations or tokens), "entries", "compared", "forms", "entropy", "fields" (each with "field",
/// "values", "given", "empty", "successive", "entropy", "entropy_given", "load" and "frequent") and "findings"; with --of
/// "of" ("values", "contrasts"), with --between "between" ("n", "bits", "chi_square", "df", "cramers_v", "p", "p_bits",
/// "chance", "rows", "columns", "cells"), with --battison "battison" ("symmetry" and "dominance", each with "exceptions"). A
/// number is "value" or null, "why", and "interval".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme stats mine.chereme
  chereme stats mine.chereme --fields S13 --of 'Handshape strong'
  chereme stats mine.chereme --between dominant.configuration placement --to table.csv
  chereme stats mine.chereme --fields Handedness,'Handshape strong','Handshape weak' --battison
  chereme stats mine.chereme origin=captured   (tokens instead of signs)
  chereme stats mine.chereme --fields S13 --per sign --store --to measures.csv")]
pub(crate) struct StatsArgs {
    /// The corpus
    corpus: PathBuf,
    /// The tokens to count, as in `chereme search`
    query: Vec<String>,
    #[command(flatten)]
    scope: LexiconScopeArgs,
    /// The fields to compare, separated by commas, or a set of Signbank's columns: S13, F8, F7, F5, C3
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    fields: Vec<String>,
    /// The treatment of empty fields
    #[arg(long, value_parser = EMPTY_CELL_CHOICES, default_value = "value")]
    empty: EmptyCellTreatment,
    /// All values of this field, and its contrasts
    #[arg(long, value_name = "FIELD")]
    of: Option<String>,
    /// The association of these two fields, and their cross table
    #[arg(long, num_args = 2, value_names = ["FIELD", "FIELD"])]
    between: Vec<String>,
    /// Battison's conditions on signs with two hands, and the signs that do not keep them
    #[arg(long)]
    battison: bool,
    /// The handshapes that count as unmarked; without it B, A, S, C, O, 1, 5
    #[arg(long, value_name = "A,B,...", value_delimiter = ',', requires = "battison")]
    unmarked: Vec<String>,
    /// Measure each sign instead of the lexicon
    #[arg(long, value_parser = PER_SIGN_CHOICES, conflicts_with_all = ["of", "between", "battison"])]
    per: Option<MeasuredThing>,
    /// The definition of a neighbour
    #[arg(long, value_parser = NEIGHBOUR_CHOICES, default_value = "asl-lex", requires = "per")]
    neighbours: NeighbourDefinition,
    /// The most fields in which neighbours differ
    #[arg(long, value_name = "N", default_value_t = 1, requires = "per", value_parser = clap::value_parser!(u8).range(1..=8))]
    within: u8,
    /// Store the measures as attributes of the entries; the earlier ones are replaced
    #[arg(long, requires = "per")]
    store: bool,
    /// The most values, contrasts and glosses that are printed
    #[arg(long, value_name = "N", default_value_t = 20)]
    limit: usize,
    /// The number of shuffles for p; 0 computes none
    #[arg(long, value_name = "N", default_value_t = 1000)]
    samples: usize,
    /// The seed of all draws; the same seed gives the same numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a table (.csv): the cross table, the values of a field, the exceptions, the signs, or else the fields
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a table that exists already
    #[arg(long)]
    force: bool,
}

impl StatsArgs {
    fn stats_options(&self) -> StatsOptions {
        StatsOptions {
            fields: self.fields.clone(),
            empty: self.empty,
            query: (!self.query.is_empty()).then(|| self.query.join(" ")),
            scope: self.scope.lexicon_scope(),
            of: self.of.clone(),
            between: self.between.clone().try_into().ok(),
            battison: self.battison,
            unmarked: self.unmarked.clone(),
            samples: self.samples,
            seed: self.seed,
        }
    }
}

/// The things that are measured one by one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MeasuredThing {
    Sign,
}

const PER_SIGN_CHOICES: NamedChoices<MeasuredThing> = NamedChoices(&[(
    "sign",
    "Neighbours, homonyms, families and uses of each sign",
    MeasuredThing::Sign,
)]);

const NEIGHBOUR_CHOICES: NamedChoices<NeighbourDefinition> = NamedChoices(&[
    (
        "asl-lex",
        "Every other entry that differs in at most so many fields, homonyms too, if one value is the same",
        NeighbourDefinition::AslLex,
    ),
    (
        "signbank",
        "Every other entry that differs in one field or more, up to so many; homonyms are none",
        NeighbourDefinition::Signbank,
    ),
    (
        "corpus-tools",
        "Every other form up to so many fields away; the entries of one form count once",
        NeighbourDefinition::CorpusTools,
    ),
]);

/// The most columns of a cross table that are printed.
const MAX_CROSS_TABLE_COLUMNS: usize = 12;
/// The most glosses that a finding names.
const MOST_GLOSSES: usize = 12;

pub(super) fn run(cli: &CommandLine, args: &StatsArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    if args.per == Some(MeasuredThing::Sign) {
        return measure_each_sign(&mut corpus, args, output);
    }
    let lexicon_statistics = with_progress_bar(|progress| corpus.lexicon_statistics(&args.stats_options(), progress))?;
    if let Some(of) = &lexicon_statistics.of {
        in_depth(of, args.limit, output)?;
    }
    if let Some(between) = &lexicon_statistics.between {
        print_field_association(between, args.limit, output)?;
    }
    if let Some(battison) = &lexicon_statistics.battison {
        print_battison_conditions(battison, args.limit, output)?;
    }
    // Without a question the overview answers the usual one.
    if lexicon_statistics.of.is_none() && lexicon_statistics.between.is_none() && lexicon_statistics.battison.is_none()
    {
        print_lexicon_overview(&lexicon_statistics, output)?;
    }
    for finding in &lexicon_statistics.findings {
        print_finding(finding, output)?;
    }
    if let Some(path) = &args.to {
        lexicon_statistics.write_table(path, args.force)?;
        output.filled_line("table: {path}", &[&path.display()])?;
    }
    output.set_json_document(lexicon_statistics)
}

fn measure_each_sign(corpus: &mut Corpus, args: &StatsArgs, output: &mut CommandOutput) -> Result<()> {
    let options = SignMeasureOptions {
        fields: args.fields.clone(),
        empty: args.empty,
        query: (!args.query.is_empty()).then(|| args.query.join(" ")),
        scope: args.scope.lexicon_scope(),
        definition: args.neighbours,
        within: usize::from(args.within),
    };
    let measures = with_progress_bar(|progress| corpus.measure_signs(&options, progress))?;
    output.filled_line(
        "entries: {n}, measured: {m}; neighbours: mean {mean}, median {median}; signs without one: {k}",
        &[
            &measures.entries,
            &measures.signs.len(),
            &format!("{:.3}", measures.mean_density),
            &measures.median_density,
            &measures.without_neighbour,
        ],
    )?;
    output.filled_line("fields: {list}", &[&measures.fields.join(", ")])?;
    let mut by_density: Vec<&MeasuredSign> = measures.signs.iter().collect();
    by_density.sort_by_key(|sign| std::cmp::Reverse(sign.density));
    let share = |value: Option<f64>| value.map(|share| format!("{share:.4}")).unwrap_or_default();
    output.write_item_table(
        by_density.into_iter().take(args.limit),
        &[
            ("gloss", &|sign| sign.gloss.clone()),
            ("neighbours", &|sign| sign.density.to_string()),
            ("minimal pairs", &|sign| sign.pairs.to_string()),
            ("homonyms", &|sign| sign.homonyms.len().to_string()),
            ("family", &|sign| {
                sign.family_size.map(|size| size.to_string()).unwrap_or_default()
            }),
            ("probability", &|sign| share(sign.probability)),
            ("of pairs", &|sign| share(sign.pair_probability)),
            ("tokens", &|sign| sign.tokens.to_string()),
            ("signers", &|sign| sign.signers.to_string()),
        ],
    )?;
    if let Some(more) = hidden_row_count(measures.signs.len(), args.limit) {
        output.filled_line("signs that are not shown: {n}; --to and --json have all", &[&more])?;
    }
    if let Some(path) = &args.to {
        measures.write_sign_measures(path, args.force)?;
        output.filled_line("table: {path}", &[&path.display()])?;
    }
    if args.store {
        let count = corpus.store_sign_measures(&measures)?;
        output.filled_line("entries with stored measures: {n}", &[&count])?;
    }
    output.set_json_document(measures)
}

fn print_lexicon_overview(found: &LexiconStatistics, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "entries: {n}, compared: {m}, different forms: {k}",
        &[&found.entries, &found.compared, &found.forms],
    )?;
    output.filled_line(
        "entropy of forms in bits: {number}",
        &[&format_estimate_interval(&found.entropy, 3, output)],
    )?;
    let frequent_text = |field: &FieldStatistics| -> String {
        let frequent = field.frequent.iter();
        let frequent = frequent.map(|entry| format!("{} {}", entry.value, format_share_percent(entry.share)));
        frequent.collect::<Vec<String>>().join(", ")
    };
    let row = |field: &FieldStatistics| {
        vec![
            field.field.clone(),
            field.values.to_string(),
            field.empty.to_string(),
            format_estimate_value(&field.entropy, 3, output),
            format_half_interval(&field.entropy, 3),
            format_estimate_value(&field.entropy_given, 3, output),
            format_estimate_value(&field.load, 4, output),
            format_half_interval(&field.load, 4),
            frequent_text(field),
        ]
    };
    let rows: Vec<Vec<String>> = found.fields.iter().map(row).collect();
    if rows.is_empty() {
        return Ok(());
    }
    output.write_titled_table(
        &[
            "field",
            "values",
            "empty",
            "entropy",
            "±",
            "without empty",
            "load",
            "± load",
            "most frequent",
        ],
        &rows,
    )
}

fn in_depth(of: &FieldInDepth, limit: usize, output: &mut CommandOutput) -> Result<()> {
    let field_statistics = &of.statistics;
    output.filled_line(
        "{field}: {n} values in {given} entries, {empty} entries without one",
        &[
            &of.field,
            &field_statistics.values,
            &field_statistics.given,
            &field_statistics.empty,
        ],
    )?;
    output.filled_line(
        "entropy in bits: {all}; without empty cells: {given}",
        &[
            &format_estimate_interval(&field_statistics.entropy, 4, output),
            &format_estimate_interval(&field_statistics.entropy_given, 4, output),
        ],
    )?;
    output.filled_line(
        "functional load: {number}",
        &[&format_estimate_interval(&field_statistics.load, 6, output)],
    )?;
    let ends = |value: &FieldValue| {
        let ends = value
            .interval
            .map(|interval| [interval.low, interval.high].map(format_share_percent).join(" … "));
        ends.unwrap_or_default()
    };
    output.write_item_table(
        of.values.iter().take(limit),
        &[
            ("value", &|value| value.value.clone()),
            ("count", &|value| value.count.to_string()),
            ("share", &|value| format_share_percent(value.share)),
            ("95 %", &ends),
        ],
    )?;
    if let Some(more) = hidden_row_count(of.values.len(), limit) {
        output.filled_line("values that are not shown: {n}; --json has all", &[&more])?;
    }
    if let Some(why) = of.why {
        let why = output.translate_message(why);
        return output.filled_line("contrasts: - ({why})", &[&why]);
    }
    // An empty cell would look like a missing one.
    let cell = |text: &String| match text.is_empty() {
        true => "∅".to_owned(),
        false => text.clone(),
    };
    output.write_output_line("contrasts that distinguish signs, the largest load first; ∅ is the empty cell")?;
    output.write_item_table(
        of.contrasts.iter().take(limit),
        &[
            ("value", &|pair| cell(&pair.a)),
            ("other value", &|pair| cell(&pair.b)),
            ("minimal pairs", &|pair| pair.pairs.to_string()),
            ("load", &|pair| format!("{:.6}", pair.load)),
        ],
    )?;
    if let Some(more) = hidden_row_count(of.contrasts.len(), limit) {
        output.filled_line("contrasts that are not shown: {n}; --json has all", &[&more])?;
    }
    Ok(())
}

fn print_field_association(it: &FieldAssociation, limit: usize, output: &mut CommandOutput) -> Result<()> {
    let [one, other] = &it.fields;
    output.filled_line(
        "{one} × {other}: {n} entries with both, {m} left out",
        &[&one, &other, &it.n, &it.left_out],
    )?;
    let (bits, chi_square) = it
        .chance
        .map_or((None, None), |measure| (Some(measure.bits), Some(measure.chi_square)));
    let mean = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |number| format!("{number:.digits$}"));
    output.filled_line(
        "mutual information in bits: {bits} (shuffled: {mean}), p {p}",
        &[
            &format_estimate_value(&it.bits, 4, output),
            &mean(bits, 4),
            &format_estimate_value(&it.p_bits, 4, output),
        ],
    )?;
    output.filled_line(
        "chi-square: {value} (shuffled: {mean}), df {df}, p {p}",
        &[
            &format_estimate_value(&it.chi_square, 2, output),
            &mean(chi_square, 2),
            &it.df,
            &format_estimate_value(&it.p, 4, output),
        ],
    )?;
    output.filled_line(
        "Cramér's V: {value}",
        &[&format_estimate_value(&it.cramers_v, 4, output)],
    )?;
    let columns: Vec<&FieldValue> = it.columns.iter().take(MAX_CROSS_TABLE_COLUMNS).collect();
    let title = format!("{one} / {other}");
    let mut header = vec![title.as_str(), "all"];
    header.extend(columns.iter().map(|column| column.value.as_str()));
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for cell in &it.cells {
        counts.insert((&cell.row, &cell.column), cell.count);
    }
    let row = |row: &FieldValue| {
        let mut cells = vec![row.value.clone(), row.count.to_string()];
        cells.extend(columns.iter().map(|column| {
            let count = counts.get(&(row.value.as_str(), column.value.as_str()));
            count.copied().unwrap_or(0).to_string()
        }));
        cells
    };
    let rows: Vec<Vec<String>> = it.rows.iter().take(limit).map(row).collect();
    output.write_named_columns(&header, &rows)?;
    if let Some(more) = hidden_row_count(it.rows.len(), limit) {
        output.filled_line("rows that are not shown: {n}; --json has all", &[&more])?;
    }
    if let Some(more) = hidden_row_count(it.columns.len(), MAX_CROSS_TABLE_COLUMNS) {
        output.filled_line("columns that are not shown: {n}; --json has all", &[&more])?;
    }
    Ok(())
}

fn print_battison_conditions(it: &BattisonConditions, limit: usize, output: &mut CommandOutput) -> Result<()> {
    output.filled_line(
        "one-handed: {n}, symmetrical: {s}, asymmetrical: {a}, of no known type: {o}",
        &[&it.one_handed, &it.symmetry.entries, &it.dominance.entries, &it.other],
    )?;
    output.filled_line("unmarked handshapes: {list}", &[&it.unmarked.join(", ")])?;
    output.filled_line(
        "symmetry: both handshapes given {n}, the same {same}, different {other}; kept by {share}",
        &[
            &it.symmetry.given,
            &it.symmetry.same,
            &it.symmetry.different,
            &format_estimate_share(&it.symmetry.kept, output),
        ],
    )?;
    output.filled_line(
        "dominance: both handshapes given {n}, the same {same}, different {other}, of these with \
         an unmarked weak hand {k}; kept by {share}; weak hand unmarked in {all}",
        &[
            &it.dominance.given,
            &it.dominance.same,
            &it.dominance.different,
            &it.dominance.different_unmarked,
            &format_estimate_share(&it.dominance.kept, output),
            &format_estimate_share(&it.dominance.unmarked_share, output),
        ],
    )?;
    let [one, other] = [&it.symmetry, &it.dominance].map(|condition| condition.exceptions.len());
    let title = format!("entries that do not keep symmetry: {one}");
    print_condition_exceptions(&title, &it.symmetry, limit, output)?;
    let title = format!("entries that do not keep dominance: {other}");
    print_condition_exceptions(&title, &it.dominance, limit, output)
}

fn print_condition_exceptions(
    title: &str,
    condition: &HandCondition,
    limit: usize,
    output: &mut CommandOutput,
) -> Result<()> {
    let count = condition.exceptions.len();
    if count > 0 {
        output.write_output_line(title)?;
        output.write_item_table(
            condition.exceptions.iter().take(limit),
            &[
                ("gloss", &|entry| entry.gloss.clone()),
                ("strong hand", &|entry| entry.strong.clone()),
                ("weak hand", &|entry| entry.weak.clone()),
            ],
        )?;
        if let Some(more) = hidden_row_count(count, limit) {
            output.filled_line("exceptions that are not shown: {n}; --json has all", &[&more])?;
        }
    }
    if !condition.incomplete.is_empty() {
        output.filled_line(
            "without one of the handshapes: {list}",
            &[&some_of(&condition.incomplete)],
        )?;
    }
    Ok(())
}

fn print_finding(finding: &StatsFinding, output: &mut CommandOutput) -> Result<()> {
    output.write_warning(&finding.message)?;
    if !finding.glosses.is_empty() {
        output.filled_line("  entries: {list}", &[&some_of(&finding.glosses)])?;
    }
    match &finding.remedy {
        Some(remedy) => output.write_remedy(remedy),
        None => Ok(()),
    }
}

/// Returns the first glosses of a list, and how many follow.
fn some_of(glosses: &[String]) -> String {
    let shown = glosses[..glosses.len().min(MOST_GLOSSES)].join(", ");
    match glosses.len().saturating_sub(MOST_GLOSSES) {
        0 => shown,
        more => format!("{shown} (+ {more})"),
    }
}

/// Returns how many rows of a table are not shown, if some are not.
fn hidden_row_count(all: usize, limit: usize) -> Option<usize> {
    all.checked_sub(limit).filter(|more| *more > 0)
}

/// Returns a number with its interval, or the reason for its absence.
fn format_estimate_interval(of: &StatsEstimate, digits: usize, output: &CommandOutput) -> String {
    let estimate_interval = of.interval;
    let ends = estimate_interval.map(|interval| format!(" ({:.digits$} … {:.digits$})", interval.low, interval.high));
    format!(
        "{}{}",
        format_estimate_value(of, digits, output),
        ends.unwrap_or_default()
    )
}

/// Returns a number, or the reason for its absence.
fn format_estimate_value(of: &StatsEstimate, digits: usize, output: &CommandOutput) -> String {
    match (of.value, of.why) {
        (Some(value), _) => format!("{value:.digits$}"),
        (None, Some(why)) => format!("- ({})", output.translate_message(why)),
        (None, None) => String::new(),
    }
}

/// Returns half the width of an interval above the number; below it may be cut.
fn format_half_interval(of: &StatsEstimate, digits: usize) -> String {
    let half = of.value.zip(of.interval);
    // The upper half, since the lower one may be cut at zero.
    half.map(|(value, ends)| format!("{:.digits$}", ends.high - value))
        .unwrap_or_default()
}

fn format_share_percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Returns a share in percent with its interval, or the reason for its absence.
fn format_estimate_share(of: &StatsEstimate, output: &CommandOutput) -> String {
    match (of.value, of.interval) {
        (Some(value), Some(ends)) => {
            let (low, high) = (format_share_percent(ends.low), format_share_percent(ends.high));
            format!("{} ({low} … {high})", format_share_percent(value))
        }
        _ => format_estimate_value(of, 4, output),
    }
}
