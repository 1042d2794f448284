//! Agreement between annotators: two tiers of the same recordings, compared on values, spans and both, with the list
//! of disagreements, and their adjudication on a third tier.

mod adjudicate;
mod agree_figures;
mod agree_tiers;
mod alike;
mod baselines;
mod disagreements;
#[cfg(test)]
mod tests;

use serde::Serialize;

pub use adjudicate::AdjudicationResult;
pub use agree_figures::{FigureInterval, MEASURE_NAMES, MeasureFigure, USUAL_MEASURES, ValueAgreement, ValueConfusion};
pub use alike::alike_tiers;
pub use disagreements::{DisagreementCounts, DisagreementKind, DisagreementSide, ValueDisagreement};

use crate::Corpus;
use crate::address::RowName;
use crate::error::{CorpusError, CorpusResult};
use crate::face::NumberQuartiles;
use crate::progress::ProgressReceiver;

/// The fewest units on the fuller tier for which figures say something; with fewer, people see counts.
pub const FEWEST_UNITS: u64 = 10;

/// The tiers to compare, and the settings of the measures.
#[derive(Debug, Clone, PartialEq)]
pub struct AgreeOptions {
    /// The tiers of the first annotator: a name, a name with one `*` for the part that both names share, `tier:12`, or
    /// `annotator:NAME`.
    pub a: String,
    /// The tiers of the second annotator, in the same form.
    pub b: String,
    /// Only this recording.
    pub recording: Option<RowName>,
    /// The measures, of [`MEASURE_NAMES`]; empty: all.
    pub measures: Vec<String>,
    /// The share of the longer unit that must overlap for a match, from 0.51 to 1.
    pub share: f64,
    /// Starts or ends further apart than this are a disagreement, in microseconds.
    pub tolerance_us: i64,
    /// The number of bootstrap draws; 0: no intervals.
    pub draws: usize,
    /// The number of random continua of gamma; 0: no gamma.
    pub samples: usize,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Whether the whole recording counts as the time that both annotated, instead of the time from the first start to
    /// the last end.
    pub whole: bool,
}

impl AgreeOptions {
    /// Returns the usual settings for two tiers.
    #[must_use]
    pub fn new(a: impl Into<String>, b: impl Into<String>) -> Self {
        Self {
            a: a.into(),
            b: b.into(),
            recording: None,
            measures: Vec::new(),
            share: chereme_analysis::agreement::matching::DEFAULT_OVERLAP_SHARE,
            tolerance_us: 80_000,
            draws: 1000,
            samples: 30,
            seed: 1,
            whole: false,
        }
    }

    fn check_agree_options(&self) -> CorpusResult<()> {
        let measure_names = self.measures.iter();
        let mut unknown = measure_names.filter(|name| !MEASURE_NAMES.contains(&name.as_str()));
        if let Some(unknown) = unknown.next() {
            return Err(
                CorpusError::from_wrong_message(format!("no measure is called {unknown:?}"))
                    .with_error_place(unknown.as_str())
                    .with_advice(format!("the measures are: {}", MEASURE_NAMES.join(", "))),
            );
        }
        if !(0.51..=1.0).contains(&self.share) {
            let text = "units match if 51 to 100 % of the longer one overlap";
            return Err(CorpusError::from_wrong_message(text)
                .with_error_place(self.share.to_string())
                .with_advice("ELAN's 60 % is usual"));
        }
        for (count, most) in [(self.draws, MOST_DRAWS), (self.samples, MAX_AGREEMENT_SAMPLES)] {
            if count > most {
                let text = format!("{count} draws are more than the {most} that are made at most");
                return Err(CorpusError::from_wrong_message(text)
                    .with_error_place(count.to_string())
                    .with_advice("1000 draws and 30 samples are usual"));
            }
        }
        Ok(())
    }

    /// Returns whether a measure is asked for.
    fn wants_measure(&self, measure: &str) -> bool {
        self.measures.is_empty() || self.measures.iter().any(|name| name == measure)
    }
}

/// The most bootstrap draws, and the most random continua.
const MOST_DRAWS: usize = 100_000;
const MAX_AGREEMENT_SAMPLES: usize = 10_000;

/// How many units two annotators have, and how many of them match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct UnitCounts {
    /// The units of the first.
    pub units_a: u64,
    /// The units of the second.
    pub units_b: u64,
    /// The matched pairs.
    pub matched: u64,
    /// The matched pairs with equal values.
    pub equal: u64,
    /// The units of the first without a match.
    pub unmatched_a: u64,
    /// The units of the second without a match.
    pub unmatched_b: u64,
    /// The annotations of the first that have no value and are left out.
    pub left_out_a: u64,
    /// The annotations of the second that have no value and are left out.
    pub left_out_b: u64,
}

impl UnitCounts {
    fn add_unit_counts(&mut self, other: &Self) {
        self.units_a += other.units_a;
        self.units_b += other.units_b;
        self.matched += other.matched;
        self.equal += other.equal;
        self.unmatched_a += other.unmatched_a;
        self.unmatched_b += other.unmatched_b;
        self.left_out_a += other.left_out_a;
        self.left_out_b += other.left_out_b;
    }

    /// Returns whether there are too few units for figures that say something.
    #[must_use]
    pub fn are_few(&self) -> bool {
        self.units_a.max(self.units_b) < FEWEST_UNITS
    }
}

/// The agreement of two tiers of one recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairAgreement {
    /// The recording's name.
    pub recording: String,
    /// The name of the first tier.
    pub tier_a: String,
    /// The name of the second tier.
    pub tier_b: String,
    /// The counts.
    #[serde(flatten)]
    pub counts: UnitCounts,
    /// The measures without gamma, which needs more units, and without intervals.
    #[serde(serialize_with = "agree_figures::serialize_figures_in_order")]
    pub measures: Vec<(&'static str, MeasureFigure)>,
}

/// The agreement of a simple way to cut takes with the first annotator.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BaselineAgreement {
    /// Its name: `uniform` with the true count, `speed_minima` or `activities`.
    pub baseline: &'static str,
    /// The measures of segments.
    #[serde(serialize_with = "agree_figures::serialize_figures_in_order")]
    pub measures: Vec<(&'static str, MeasureFigure)>,
}

/// The agreement of two annotators, over all pairs of tiers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnnotatorAgreement {
    /// The tiers of the first annotator, as asked for.
    pub a: String,
    /// The tiers of the second annotator, as asked for.
    pub b: String,
    /// How many different values there are.
    pub values: usize,
    /// The counts.
    #[serde(flatten)]
    pub counts: UnitCounts,
    /// Whether there are too few units, or only one value, for figures that say something; then people see counts.
    pub counts_only: bool,
    /// The measures, in the order of [`MEASURE_NAMES`].
    #[serde(serialize_with = "agree_figures::serialize_figures_in_order")]
    pub measures: Vec<(&'static str, MeasureFigure)>,
    /// Starts of the second less those of the first, of matched units, in seconds.
    pub onset_s: Option<NumberQuartiles>,
    /// Ends of the second less those of the first, of matched units, in seconds.
    pub offset_s: Option<NumberQuartiles>,
    /// The agreement on each value, the most frequent value first.
    pub by_value: Vec<ValueAgreement>,
    /// The number of disagreements of each kind.
    pub disagreements: DisagreementCounts,
    /// Each pair of tiers.
    pub pairs: Vec<PairAgreement>,
    /// The measures of segments that the simplest ways to cut these takes reach against the first annotator, if measures of
    /// segments are asked for by name and all recordings have movement.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub baselines: Vec<BaselineAgreement>,
    /// Remarks for the user.
    pub findings: Vec<String>,
    /// The values of matched units that differ, most frequent first.
    #[serde(skip)]
    pub confusion: Vec<ValueConfusion>,
    /// The disagreements, the costliest first.
    #[serde(skip)]
    pub list: Vec<ValueDisagreement>,
}

impl Corpus {
    /// Compares two tiers in every recording that has both. Returns the measures of agreement, the values on which they
    /// differ, and where.
    ///
    /// Times are rounded to milliseconds. Annotations without a value are left out, unless nobody gave a value: then the
    /// spans alone are compared. Values that one inventory knows under several spellings are equal. The measures are
    /// explained in [`chereme_analysis::agreement`].
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if no recording has both tiers, an option has a wrong value, or a measure is unknown;
    /// [`CorpusError::Stopped`] if `progress` asks to stop.
    pub fn compare_annotators(
        &self,
        options: &AgreeOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotatorAgreement> {
        options.check_agree_options()?;
        let coded = agree_tiers::read_tier_pairs(self, options)?;
        let mut agreement = agree_figures::measure_agreement(&coded, options, progress)?;
        if options
            .measures
            .iter()
            .any(|name| name.starts_with(agree_figures::SEGMENT_PREFIX))
        {
            agreement.baselines = baselines::measure_baselines(self, &coded, progress)?;
        }
        Ok(agreement)
    }
}
