//! Ranks performances of a function for a sentence, and animates the sentence with the chosen one.

use std::thread;

use chereme_analysis::dtw::CostMethod;
use chereme_analysis::phases::{self, NoPath, PhasedPerformance, PhasedScore};
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use chereme_sign::text::did_you_mean;
use serde::Serialize;

use super::expressions::{self, FaceExpression};
use super::performances::{FACE_CHANNELS, FaceChannel, FacePerformance, of_expression};
use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName, find_addressed_recording};
use crate::curves::face_fits::CorpusFits;
use crate::curves::face_stage;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The number of performances that represent all in the search for a medoid.
const MAX_MEDOID_REFERENCES: usize = 64;

/// The criterion of a ranking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RankingCriterion {
    /// Most similar to the sentence's own face first; if it has none, as for the medoid.
    #[default]
    Nearest,
    /// Least similar to the sentence's own face first.
    Farthest,
    /// Most similar to all others first: a typical performance of the function.
    Medoid,
}

/// Options for comparing and ranking performances.
#[derive(Debug, Clone, PartialEq)]
pub struct ChooseOptions {
    /// The criterion.
    pub rank: RankingCriterion,
    /// The names of the channels to compare; if empty, head, brows, and brows drawn together.
    pub channels: Vec<String>,
    /// The factor of each phase's cost.
    pub weights: [f64; 4],
    /// Whether the ratio of lengths is a factor of the score, as in the paper.
    pub stretch: bool,
    /// The treatment of phases whose lengths no path connects.
    pub no_path: NoPath,
    /// The number of performances that are reported with reasons; the others are only counted.
    pub limit: usize,
}

impl Default for ChooseOptions {
    fn default() -> Self {
        Self {
            rank: RankingCriterion::default(),
            channels: Vec::new(),
            weights: [1.0; 4],
            stretch: true,
            no_path: NoPath::default(),
            limit: 20,
        }
    }
}

/// Performances ranked for a sentence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PerformanceChoice {
    /// The function.
    pub function: ExpressionFunction,
    /// The sentence's expression.
    pub target: String,
    /// The row of the sentence's recording.
    pub recording_id: i64,
    /// The milestones of that expression, on its recording's clock.
    pub milestones: ExpressionMilestones,
    /// The criterion used: the medoid if the sentence has no face of its own.
    pub rank: RankingCriterion,
    /// The channels that were compared, with their units.
    pub channels: Vec<FaceChannel>,
    /// Requested channels that are missing from the sentence's own face, or from half of the performances.
    pub left_out: Vec<String>,
    /// How many performances were compared.
    pub compared: u64,
    /// The number of performances with which each was compared to find the most typical one; 0 if they are ranked
    /// against the sentence's own face.
    pub references: u64,
    /// The number of comparisons in which a phase had no path under the plain window, so that the window was adapted.
    pub adapted: u64,
    /// The first performances, best first.
    pub ranking: Vec<RankedPerformance>,
    /// Performances that could not be compared, with the reason.
    pub skipped: Vec<(String, String)>,
}

/// One performance in a ranking.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RankedPerformance {
    /// The address of the performance.
    pub token: String,
    /// Its recording's name.
    pub recording: String,
    /// The row of its recording.
    pub recording_id: i64,
    /// Its milestones, on the clock of its recording.
    pub milestones: ExpressionMilestones,
    /// The recipe that gives the sentence this face.
    pub recipe: String,
    /// The score that determines its place; smaller is more similar.
    pub score: f64,
    /// The parts of the score; in a ranking by medoid, compared with the most typical performance, and for that one
    /// compared with the second.
    #[serde(flatten)]
    pub parts: FaceScore,
}

/// A score phase by phase, with the reasons.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceScore {
    /// The sum over phases times the ratio of lengths.
    pub stretched: f64,
    /// The sum over phases, without the ratio of lengths.
    pub unstretched: f64,
    /// The ratio of the target's length to that of the performance.
    pub stretch: f64,
    /// The absolute value of that ratio's natural logarithm.
    pub log_stretch: f64,
    /// Whether a phase was left out because one of the two lacks it.
    pub partial: bool,
    /// The phases.
    pub phases: Vec<phases::PhaseScore>,
    /// The mean difference of each channel over all phases in the channel's unit, largest first.
    pub channels: Vec<ScoredChannel>,
}

/// The difference in one channel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScoredChannel {
    /// The channel.
    pub name: &'static str,
    /// The mean difference of aligned frames, in the channel's unit.
    pub difference: f64,
}

impl FaceScore {
    fn from_phased_score(score: PhasedScore, channels: &[FaceChannel]) -> Self {
        let mut named: Vec<ScoredChannel> = channels
            .iter()
            .enumerate()
            .map(|(at, channel)| {
                let (mut sum, mut frames) = (0.0, 0.0);
                // Phases weigh by their frames, so that the mean is over frames and not over phases.
                for phase in &score.phases {
                    if let Some(difference) = phase.channels.get(at) {
                        sum += difference * phase.frames[0] as f64;
                        frames += phase.frames[0] as f64;
                    }
                }
                ScoredChannel {
                    name: channel.name,
                    difference: if frames > 0.0 { sum / frames } else { 0.0 },
                }
            })
            .collect();
        named.sort_by(|a, b| b.difference.total_cmp(&a.difference).then(a.name.cmp(b.name)));
        Self {
            stretched: score.score,
            unstretched: score.unstretched,
            stretch: score.stretch,
            log_stretch: score.log_stretch,
            partial: score.partial,
            phases: score.phases,
            channels: named,
        }
    }
}

impl ChooseOptions {
    fn compared_channel_indices(&self) -> CorpusResult<Vec<usize>> {
        if self.channels.is_empty() {
            return Ok((0..FACE_CHANNELS.len()).filter(|at| FACE_CHANNELS[*at].usual).collect());
        }
        let mut places = Vec::new();
        for name in &self.channels {
            let alike =
                |channel: &FaceChannel| channel.name == name || (channel.name.starts_with(&**name) && !name.is_empty());
            let alike_channels: Vec<usize> = (0..FACE_CHANNELS.len())
                .filter(|at| alike(&FACE_CHANNELS[*at]))
                .collect();
            if alike_channels.is_empty() {
                let names = || FACE_CHANNELS.iter().map(|channel| channel.name);
                let near = chereme_sign::text::nearest_candidate(name, names());
                let all: Vec<&str> = names().collect();
                return Err(CorpusError::from_wrong_message(format!(
                    "{name:?} is no channel of a face{}",
                    did_you_mean(near)
                ))
                .with_error_place(name)
                .with_advice(format!(
                    "the channels are: {}; the start of a name stands for all that begin so",
                    all.join(", ")
                )));
            }
            places.extend(alike_channels);
        }
        places.sort_unstable();
        places.dedup();
        Ok(places)
    }

    fn scoring(&self) -> phases::PhasedScoreOptions {
        phases::PhasedScoreOptions {
            no_path: self.no_path,
            weights: self.weights,
            ..phases::PhasedScoreOptions::default()
        }
    }

    fn rank_value(&self, score: &PhasedScore) -> f64 {
        match self.stretch {
            true => score.score,
            false => score.unstretched,
        }
    }
}

impl Corpus {
    /// Returns the difference of the expression at `b` from that at `a`, phase by phase and channel by channel; 0 means
    /// equal.
    ///
    /// # Errors
    /// Fails if an address has no expression, or not just one, or the two have no channel in common.
    pub fn score_faces(
        &self,
        [a, b]: [&CorpusAddress; 2],
        function: Option<&ExpressionFunction>,
        options: &ChooseOptions,
    ) -> CorpusResult<FaceScore> {
        let connection = self.store.read_connection();
        let asked = options.compared_channel_indices()?;
        let fits = CorpusFits::load_corpus_fits(connection)?;
        let mut both = Vec::new();
        for address in [a, b] {
            let it = expressions::find_expression_at(connection, address, function)?;
            let name = address.to_string();
            let performance = of_expression(connection, &it, name, "", &asked, &fits)?;
            both.push(performance.ok_or_else(|| faceless(address))?);
        }
        let is_shown = |at: &usize| both.iter().all(|performance| performance.columns[*at].is_some());
        let use_of: Vec<usize> = (0..asked.len()).filter(is_shown).collect();
        if use_of.is_empty() {
            return Err(
                CorpusError::from_wrong_message("the two faces have no channel in common").with_command_advice(
                    "name channels that both have with --channels; `chereme face CORPUS RECORDING` lists them",
                ),
            );
        }
        // A body of one phase can be compared only with a body taken as one.
        let one = both
            .iter()
            .any(|performance| performance.expression.milestones.m3.is_none());
        let cut = |performance: &FacePerformance| performance.phased_of(&asked, &use_of, one);
        let (query, other) = (cut(&both[0])?, cut(&both[1])?);
        let explanation_result =
            phases::explain_phased_score(&query, &other, query.phased_seconds(), &options.scoring());
        let explanation = explanation_result.map_err(|error| phased_comparison_error(&error))?;
        let channels: Vec<FaceChannel> = use_of.iter().map(|at| FACE_CHANNELS[asked[*at]]).collect();
        Ok(FaceScore::from_phased_score(explanation, &channels))
    }

    /// Ranks the recorded performances of a function for a sentence, phase by phase; a recording is never its own
    /// candidate.
    ///
    /// The sentence is a recording or token with an expression of that function; for a recording without one the
    /// expression spans all of its signs. Equal scores are ordered by the names of recordings.
    ///
    /// # Errors
    /// Fails if the address names no such sentence, no performance can be compared, or `progress` stops the work.
    pub fn choose_performances(
        &self,
        function: &ExpressionFunction,
        target: &CorpusAddress,
        options: &ChooseOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<PerformanceChoice> {
        let connection = self.store.read_connection();
        let asked = options.compared_channel_indices()?;
        let target_sentence = self.load_sentence_expression(function, target)?;
        let pool = self
            .faces
            .borrow_mut()
            .load_pooled_performances(connection, function, &asked, progress)?;
        let fits = CorpusFits::load_corpus_fits(connection)?;
        let gold_performance = of_expression(connection, &target_sentence, target.to_string(), "", &asked, &fits)?;
        let gold = match gold_performance {
            Some(gold) if options.rank != RankingCriterion::Medoid && gold.shows_performance() => Some(gold),
            _ => None,
        };
        // Without the sentence's own face nothing is far from it, and the medoid would answer another
        // question.
        if gold.is_none() && options.rank == RankingCriterion::Farthest {
            return Err(faceless(target));
        }
        let others: Vec<&FacePerformance> = pool
            .iter()
            .filter(|performance| performance.expression.recording != target_sentence.recording)
            .collect();
        if others.is_empty() {
            return Err(
                CorpusError::from_wrong_message(format!("no other recording has a performance of {function}"))
                    .with_error_place(function.function_name())
                    .with_command_advice("`chereme milestones CORPUS` lists the functions that there are"),
            );
        }
        let asked_for = RankingRequest {
            options,
            asked: &asked,
            own: &target_sentence,
            target,
            start: self.start_of(target_sentence.recording)?,
        };
        asked_for.ranked(gold.as_ref(), &others)
    }

    /// Returns the recipe that gives a sentence the face of a performance.
    ///
    /// # Errors
    /// Fails if the sentence no longer exists.
    pub fn recipe_of_choice(&self, choice: &PerformanceChoice, token: &str) -> CorpusResult<String> {
        let target: CorpusAddress = choice.target.parse()?;
        let recording = find_addressed_recording(self.store.read_connection(), &target)?;
        let start = self.start_of(recording)?;
        Ok(transfer_recipe_text(
            recording,
            &choice.function,
            &choice.milestones,
            start,
            token,
        ))
    }

    /// Returns the start of a recording's movement on its clock, in microseconds.
    fn start_of(&self, recording: i64) -> CorpusResult<i64> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, &RowName::Number(recording))?;
        let full_span = TimeSpan::span_between(
            RecordingInstant::RECORDING_START,
            RecordingInstant::from_micros(row.duration_us),
        );
        face_stage::first_frame(connection, recording, full_span)
    }

    /// Returns the expression of a sentence for a function.
    fn load_sentence_expression(
        &self,
        function: &ExpressionFunction,
        target: &CorpusAddress,
    ) -> CorpusResult<FaceExpression> {
        let connection = self.store.read_connection();
        match expressions::find_expression_at(connection, target, Some(function)) {
            Ok(found) => Ok(found),
            Err(error) => {
                let recording = find_addressed_recording(connection, target)?;
                // Several expressions of the function exist, and the whole sentence must not stand in for a
                // choice.
                if !expressions::load_recording_expressions(connection, recording, Some(function), None)?.is_empty() {
                    return Err(error);
                }
                expressions::over_all(connection, recording, function)?.ok_or(error)
            }
        }
    }
}

/// The performances that a ranking compares, and their order.
#[derive(Default)]
struct RankedCandidates<'a> {
    /// The sentence's own face, if the ranking starts from it.
    query: Option<PhasedPerformance>,
    ready: Vec<(&'a FacePerformance, PhasedPerformance)>,
    /// The performances with which each is compared, by their index, if there is no query.
    references: Vec<usize>,
    /// Scores and indices, the best first.
    order: Vec<(f64, usize)>,
    /// How many comparisons needed a wider window.
    adapted: u64,
    /// Addresses of those that could not be compared, and why.
    skipped: Vec<(String, String)>,
}

/// A request for a ranking.
struct RankingRequest<'a> {
    options: &'a ChooseOptions,
    asked: &'a [usize],
    own: &'a FaceExpression,
    target: &'a CorpusAddress,
    /// The start of the sentence's movement on its recording's clock, in microseconds.
    start: i64,
}

impl RankingRequest<'_> {
    fn ranked(&self, gold: Option<&FacePerformance>, others: &[&FacePerformance]) -> CorpusResult<PerformanceChoice> {
        let used = self.usable_channels(gold, others);
        if used.is_empty() {
            return Err(faceless(self.target));
        }
        let one = self.own.milestones.m3.is_none();
        let query = gold.map(|gold| gold.phased_of(self.asked, &used, one)).transpose()?;
        let mut candidates = RankedCandidates {
            query,
            ..RankedCandidates::default()
        };
        let cut = in_parallel(others, |performance| performance.phased_of(self.asked, &used, one));
        for (performance, cut) in others.iter().zip(cut) {
            match cut {
                Ok(phased) => candidates.ready.push((performance, phased)),
                Err(error) => candidates
                    .skipped
                    .push((performance.address.clone(), error.to_string())),
            }
        }
        self.score_candidates(&mut candidates);
        if candidates.order.is_empty() {
            let why = candidates
                .skipped
                .first()
                .map_or(String::new(), |(address, why)| format!(": {address}: {why}"));
            return Err(CorpusError::from_wrong_message(format!(
                "no performance can be compared{why}"
            )));
        }
        let channels: Vec<FaceChannel> = used.iter().map(|at| FACE_CHANNELS[self.asked[*at]]).collect();
        let ranking = (0..candidates.order.len().min(self.options.limit))
            .map(|rank| self.explain_ranked(&candidates, rank, &channels))
            .collect::<CorpusResult<_>>()?;
        let unused_channels = (0..self.asked.len()).filter(|at| !used.contains(at));
        Ok(PerformanceChoice {
            function: self.own.function.clone(),
            target: self.target.to_string(),
            recording_id: self.own.recording,
            milestones: self.own.milestones,
            rank: match candidates.query {
                Some(_) => self.options.rank,
                None => RankingCriterion::Medoid,
            },
            left_out: unused_channels
                .map(|at| FACE_CHANNELS[self.asked[at]].name.to_owned())
                .collect(),
            compared: candidates.order.len() as u64,
            references: candidates.references.len() as u64,
            adapted: candidates.adapted,
            ranking,
            skipped: candidates.skipped,
            channels,
        })
    }

    /// Returns the asked channels, by their index in the request, that the comparison uses: those of the sentence's own
    /// face, else those that most performances show.
    fn usable_channels(&self, gold: Option<&FacePerformance>, others: &[&FacePerformance]) -> Vec<usize> {
        let is_usable = |at: &usize| match gold {
            Some(gold) => gold.columns[*at].is_some(),
            None => {
                let candidates = || others.iter().filter(|performance| performance.is_comparable());
                let shown = candidates().filter(|performance| performance.columns[*at].is_some());
                // A channel that few performances show would leave the others out of the ranking.
                shown.count() * 2 >= candidates().count()
            }
        };
        (0..self.asked.len()).filter(is_usable).collect()
    }

    fn sentence_seconds(&self) -> f64 {
        self.own.milestones.milestone_span().span_seconds()
    }

    /// Scores the candidates against the sentence's own face, or without one against each other, and orders them.
    fn score_candidates(&self, candidates: &mut RankedCandidates<'_>) {
        let (seconds, scoring) = (self.sentence_seconds(), self.options.scoring());
        let ready = &candidates.ready;
        // Each against each grows with the square; references at even steps represent all recordings.
        let step = ready.len().div_ceil(MAX_MEDOID_REFERENCES).max(1);
        if candidates.query.is_none() {
            candidates.references = (0..ready.len()).step_by(step).collect();
        }
        let scores = in_parallel(&(0..ready.len()).collect::<Vec<_>>(), |&at| match &candidates.query {
            Some(query) => {
                let score_result = phases::score_phased_candidate(query, &ready[at].1, seconds, &scoring);
                score_result.map(|score| (self.options.rank_value(&score), adapted(&score)))
            }
            None => self.mean_reference_score(ready, at, &candidates.references, seconds),
        });
        for (at, score) in scores.into_iter().enumerate() {
            match score {
                Ok((score, adapted)) => {
                    candidates.adapted += adapted;
                    candidates.order.push((score, at));
                }
                Err(error) => candidates
                    .skipped
                    .push((ready[at].0.address.clone(), error.to_string())),
            }
        }
        let farthest = self.options.rank == RankingCriterion::Farthest;
        candidates.order.sort_by(|(a, i), (b, j)| {
            let by_score = if farthest { b.total_cmp(a) } else { a.total_cmp(b) };
            let name = |at: &usize| (&ready[*at].0.name, &ready[*at].0.address);
            by_score.then_with(|| name(i).cmp(&name(j)))
        });
    }

    /// Returns the performance at a rank with the parts of its score.
    fn explain_ranked(
        &self,
        candidates: &RankedCandidates<'_>,
        rank: usize,
        channels: &[FaceChannel],
    ) -> CorpusResult<RankedPerformance> {
        let (score, at) = candidates.order[rank];
        let (performance, phased) = &candidates.ready[at];
        let against = match &candidates.query {
            Some(query) => query,
            None => {
                // The most typical performance is explained against the second, as it differs from itself in
                // nothing.
                let other = usize::from(rank == 0).min(candidates.order.len() - 1);
                &candidates.ready[candidates.order[other].1].1
            }
        };
        let parts = phases::explain_phased_score(against, phased, self.sentence_seconds(), &self.options.scoring());
        Ok(RankedPerformance {
            token: performance.address.clone(),
            recording: performance.name.clone(),
            recording_id: performance.expression.recording,
            milestones: performance.expression.milestones,
            recipe: transfer_recipe_text(
                self.own.recording,
                &self.own.function,
                &self.own.milestones,
                self.start,
                &performance.address,
            ),
            score,
            parts: FaceScore::from_phased_score(parts.map_err(|error| phased_comparison_error(&error))?, channels),
        })
    }

    /// Returns the mean score of a performance against references other than itself.
    fn mean_reference_score(
        &self,
        ready: &[(&FacePerformance, PhasedPerformance)],
        at: usize,
        references: &[usize],
        seconds: f64,
    ) -> std::result::Result<(f64, u64), phases::PhasedError> {
        let (mut sum, mut count, mut made) = (0.0, 0, 0);
        for other in references.iter().filter(|other| **other != at) {
            let score_result =
                phases::score_phased_candidate(&ready[*other].1, &ready[at].1, seconds, &self.options.scoring())?;
            sum += self.options.rank_value(&score_result);
            made += adapted(&score_result);
            count += 1;
        }
        Ok((sum / f64::from(count.max(1)), made))
    }
}

/// Returns the recipe that transfers the expression of `token` to the milestones of a recording whose movement begins
/// at `start` microseconds of its clock.
fn transfer_recipe_text(
    recording: i64,
    function: &ExpressionFunction,
    milestones: &ExpressionMilestones,
    start: i64,
    token: &str,
) -> String {
    // A recipe counts from the first frame of its material.
    let milestone_times = milestones.shift_milestones(-start).milestone_times();
    let times = milestone_times
        .map(|at| format!("{}s", at.instant_seconds()))
        .join(", ");
    format!("recording:{recording} | nonmanual \"{function}\" from {token} over {times} by phases")
}

fn adapted(score: &PhasedScore) -> u64 {
    let made = |phase: &phases::PhaseScore| phase.made.is_some_and(|made| made != CostMethod::AsAsked);
    u64::from(score.phases.iter().any(made))
}

/// Returns the results of `work` for each item, in order, computed by as many threads as the machine has cores.
fn in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = thread::available_parallelism().map_or(1, usize::from).min(8);
    let part = items.len().div_ceil(threads).max(1);
    // Starting threads takes longer than so few items.
    if items.len() < 64 || threads == 1 {
        return items.iter().map(work).collect();
    }
    thread::scope(|scope| {
        let running: Vec<_> = items
            .chunks(part)
            .map(|part| scope.spawn(|| part.iter().map(&work).collect::<Vec<R>>()))
            .collect();
        let done = running.into_iter().flat_map(|thread| thread.join().unwrap_or_default());
        done.collect()
    })
}

fn phased_comparison_error(error: &phases::PhasedError) -> CorpusError {
    CorpusError::from_wrong_message(format!("the two faces cannot be compared: {error}"))
}

fn faceless(address: &CorpusAddress) -> CorpusError {
    CorpusError::from_wrong_message(format!("{address} shows no face and no turn of the head"))
        .with_error_place(address.to_string())
        .with_command_advice(
            "import its face file under the recording's name, or rank by the medoid with --rank medoid",
        )
}
