//! Ranks performances of a function for a sentence, and animates the sentence with the chosen one.

use std::thread;

use chereme_analysis::dtw::CostMethod;
use chereme_analysis::phases::{self, NoPath, Phased, PhasedScore};
use chereme_motion::{Instant, Span};
use chereme_sign::Remedy;
use chereme_sign::milestones::{Function, Milestones};
use chereme_sign::text::did_you_mean;
use serde::Serialize;

use super::expressions::{self, Expression};
use super::performances::{CHANNELS, FaceChannel, Performance, of_expression};
use super::{Fits, recording_of, stage};
use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::recombine::Recombination;

/// The number of performances that represent all in the search for a medoid.
const REFERENCES: usize = 64;

/// The criterion of a ranking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rank {
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
    pub rank: Rank,
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
            rank: Rank::default(),
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
pub struct Choice {
    /// The function.
    pub function: Function,
    /// The sentence's expression.
    pub target: String,
    /// The row of the sentence's recording.
    pub recording_id: i64,
    /// The milestones of that expression, on its recording's clock.
    pub milestones: Milestones,
    /// The criterion used: the medoid if the sentence has no face of its own.
    pub rank: Rank,
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
    pub ranking: Vec<Ranked>,
    /// Performances that could not be compared, with the reason.
    pub skipped: Vec<(String, String)>,
}

/// One performance in a ranking.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ranked {
    /// The address of the performance.
    pub token: String,
    /// Its recording's name.
    pub recording: String,
    /// The row of its recording.
    pub recording_id: i64,
    /// Its milestones, on the clock of its recording.
    pub milestones: Milestones,
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
    fn of(score: PhasedScore, channels: &[FaceChannel]) -> Self {
        let mut named: Vec<ScoredChannel> = channels
            .iter()
            .enumerate()
            .map(|(at, channel)| {
                let (mut sum, mut frames) = (0.0, 0.0);
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
        named.sort_by(|a, b| {
            b.difference
                .total_cmp(&a.difference)
                .then(a.name.cmp(b.name))
        });
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
    fn places(&self) -> Result<Vec<usize>> {
        if self.channels.is_empty() {
            return Ok((0..CHANNELS.len())
                .filter(|at| CHANNELS[*at].usual)
                .collect());
        }
        let mut places = Vec::new();
        for name in &self.channels {
            let alike = |channel: &FaceChannel| {
                channel.name == name || (channel.name.starts_with(&**name) && !name.is_empty())
            };
            let found: Vec<usize> = (0..CHANNELS.len())
                .filter(|at| alike(&CHANNELS[*at]))
                .collect();
            if found.is_empty() {
                let names = || CHANNELS.iter().map(|channel| channel.name);
                let near = chereme_sign::text::nearest(name, names());
                let all: Vec<&str> = names().collect();
                return Err(Error::wrong(format!(
                    "{name:?} is no channel of a face{}",
                    did_you_mean(near)
                ))
                .at(name)
                .advise(format!(
                    "the channels are: {}; the start of a name stands for all that begin so",
                    all.join(", ")
                )));
            }
            places.extend(found);
        }
        places.sort_unstable();
        places.dedup();
        Ok(places)
    }

    fn scoring(&self) -> phases::Options {
        phases::Options {
            no_path: self.no_path,
            weights: self.weights,
            ..phases::Options::default()
        }
    }

    fn value(&self, score: &PhasedScore) -> f64 {
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
        [a, b]: [&Address; 2],
        function: Option<&Function>,
        options: &ChooseOptions,
    ) -> Result<FaceScore> {
        let connection = self.store.read();
        let asked = options.places()?;
        let fits = Fits::of(connection)?;
        let mut both = Vec::new();
        for address in [a, b] {
            let it = expressions::at(connection, address, function)?;
            let name = address.to_string();
            let found = of_expression(connection, &it, name, "", &asked, &fits)?;
            both.push(found.ok_or_else(|| faceless(address))?);
        }
        let known = |at: &usize| both.iter().all(|it| it.columns[*at].is_some());
        let use_of: Vec<usize> = (0..asked.len()).filter(known).collect();
        if use_of.is_empty() {
            return Err(Error::wrong("the two faces have no channel in common")
                .advise(Remedy::command("name channels that both have with --channels; `chereme face CORPUS RECORDING` lists them")));
        }
        let one = both.iter().any(|it| it.expression.milestones.m3.is_none());
        let cut = |it: &Performance| it.phased_of(&asked, &use_of, one);
        let (query, other) = (cut(&both[0])?, cut(&both[1])?);
        let found = phases::explained(&query, &other, query.seconds(), &options.scoring());
        let found = found.map_err(|error| refused(&error))?;
        let channels: Vec<FaceChannel> = use_of.iter().map(|at| CHANNELS[asked[*at]]).collect();
        Ok(FaceScore::of(found, &channels))
    }

    /// Ranks the recorded performances of a function for a sentence, phase by phase; a recording is never its own
    /// candidate.
    ///
    /// The sentence is a recording or token with an expression of that function; for a recording without one the
    /// expression spans all of its signs. Equal scores are ordered by the names of recordings.
    ///
    /// # Errors
    /// Fails if the address names no such sentence, no performance can be compared, or `progress` stops the work.
    pub fn choose(
        &self,
        function: &Function,
        target: &Address,
        options: &ChooseOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Choice> {
        let connection = self.store.read();
        let asked = options.places()?;
        let own = self.sentence(function, target)?;
        let pool = self
            .faces
            .borrow_mut()
            .of(connection, function, &asked, progress)?;
        let fits = Fits::of(connection)?;
        let gold = of_expression(connection, &own, target.to_string(), "", &asked, &fits)?;
        let gold = match gold {
            Some(gold) if options.rank != Rank::Medoid && gold.shows() => Some(gold),
            _ => None,
        };
        if gold.is_none() && options.rank == Rank::Farthest {
            return Err(faceless(target));
        }
        let others: Vec<&Performance> = pool
            .iter()
            .filter(|it| it.expression.recording != own.recording)
            .collect();
        if others.is_empty() {
            return Err(Error::wrong(format!(
                "no other recording has a performance of {function}"
            ))
            .at(function.name())
            .advise(Remedy::command(
                "`chereme milestones CORPUS` lists the functions that there are",
            )));
        }
        let asked_for = Asked {
            options,
            asked: &asked,
            own: &own,
            target,
            start: self.start_of(own.recording)?,
        };
        asked_for.ranked(gold.as_ref(), &others)
    }

    /// Animates a sentence with the face of a performance: the recipe `SENTENCE | nonmanual … by phases`, stored as `gloss`.
    ///
    /// # Errors
    /// Those of [`recombine`](Self::recombine).
    pub fn animate_choice(
        &mut self,
        choice: &Choice,
        token: &str,
        gloss: &str,
    ) -> Result<Recombination> {
        let recipe = self.recipe_of_choice(choice, token)?;
        self.recombine(&recipe, gloss)
    }

    /// Returns the recipe that gives a sentence the face of a performance.
    ///
    /// # Errors
    /// Fails if the sentence no longer exists.
    pub fn recipe_of_choice(&self, choice: &Choice, token: &str) -> Result<String> {
        let target: Address = choice.target.parse()?;
        let recording = recording_of(self.store.read(), &target)?;
        let start = self.start_of(recording)?;
        Ok(carried(
            recording,
            &choice.function,
            &choice.milestones,
            start,
            token,
        ))
    }

    /// Returns the start of a recording's movement on its clock, in microseconds.
    fn start_of(&self, recording: i64) -> Result<i64> {
        let connection = self.store.read();
        let row = address::recording(connection, &Name::Number(recording))?;
        let whole = Span::between(Instant::ZERO, Instant::from_micros(row.duration_us));
        stage::first_frame(connection, recording, whole)
    }

    /// Returns the expression of a sentence for a function.
    fn sentence(&self, function: &Function, target: &Address) -> Result<Expression> {
        let connection = self.store.read();
        match expressions::at(connection, target, Some(function)) {
            Ok(found) => Ok(found),
            Err(error) => {
                let recording = recording_of(connection, target)?;
                if !expressions::of_recording(connection, recording, Some(function), None)?
                    .is_empty()
                {
                    return Err(error);
                }
                expressions::over_all(connection, recording, function)?.ok_or(error)
            }
        }
    }
}

/// A request for a ranking.
struct Asked<'a> {
    options: &'a ChooseOptions,
    asked: &'a [usize],
    own: &'a Expression,
    target: &'a Address,
    /// The start of the sentence's movement on its recording's clock, in microseconds.
    start: i64,
}

impl Asked<'_> {
    fn ranked(&self, gold: Option<&Performance>, others: &[&Performance]) -> Result<Choice> {
        let known = |at: &usize| match gold {
            Some(gold) => gold.columns[*at].is_some(),
            None => {
                let candidates = || others.iter().filter(|it| it.is_comparable());
                let shown = candidates().filter(|it| it.columns[*at].is_some());
                shown.count() * 2 >= candidates().count()
            }
        };
        let use_of: Vec<usize> = (0..self.asked.len()).filter(known).collect();
        let left_out = (0..self.asked.len()).filter(|at| !use_of.contains(at));
        let left_out = left_out
            .map(|at| CHANNELS[self.asked[at]].name.to_owned())
            .collect();
        if use_of.is_empty() {
            return Err(faceless(self.target));
        }
        let one = self.own.milestones.m3.is_none();
        let seconds = self.own.milestones.span().seconds();
        let scoring = self.options.scoring();
        let query = gold
            .map(|gold| gold.phased_of(self.asked, &use_of, one))
            .transpose()?;
        let cut = in_parallel(others, |it| it.phased_of(self.asked, &use_of, one));
        let mut skipped = Vec::new();
        let mut ready: Vec<(&Performance, Phased)> = Vec::new();
        for (it, cut) in others.iter().zip(cut) {
            match cut {
                Ok(phased) => ready.push((it, phased)),
                Err(error) => skipped.push((it.address.clone(), error.to_string())),
            }
        }
        let step = ready.len().div_ceil(REFERENCES).max(1);
        let references: Vec<usize> = match query {
            Some(_) => Vec::new(),
            None => (0..ready.len()).step_by(step).collect(),
        };
        let scores = in_parallel(&(0..ready.len()).collect::<Vec<_>>(), |&at| match &query {
            Some(query) => {
                let found = phases::score(query, &ready[at].1, seconds, &scoring);
                found.map(|score| (self.options.value(&score), adapted(&score)))
            }
            None => self.usual(&ready, at, &references, seconds),
        });
        let mut order = Vec::new();
        let mut made = 0;
        for (at, score) in scores.into_iter().enumerate() {
            match score {
                Ok((score, adapted)) => {
                    made += adapted;
                    order.push((score, at));
                }
                Err(error) => skipped.push((ready[at].0.address.clone(), error.to_string())),
            }
        }
        let farthest = self.options.rank == Rank::Farthest;
        order.sort_by(|(a, i), (b, j)| {
            let by_score = if farthest {
                b.total_cmp(a)
            } else {
                a.total_cmp(b)
            };
            let name = |at: &usize| (&ready[*at].0.name, &ready[*at].0.address);
            by_score.then_with(|| name(i).cmp(&name(j)))
        });
        let Some((_, best)) = order.first() else {
            let why = skipped.first().map_or(String::new(), |(address, why)| {
                format!(": {address}: {why}")
            });
            return Err(Error::wrong(format!("no performance can be compared{why}")));
        };
        let channels: Vec<FaceChannel> =
            use_of.iter().map(|at| CHANNELS[self.asked[*at]]).collect();
        let explain = |&(score, at): &(f64, usize)| -> Result<Ranked> {
            let against = match (&query, at == *best) {
                (Some(query), _) => query,
                (None, false) => &ready[*best].1,
                (None, true) => &ready[order.get(1).map_or(*best, |(_, second)| *second)].1,
            };
            let parts = phases::explained(against, &ready[at].1, seconds, &scoring);
            let it = ready[at].0;
            Ok(Ranked {
                token: it.address.clone(),
                recording: it.name.clone(),
                recording_id: it.expression.recording,
                milestones: it.expression.milestones,
                recipe: carried(
                    self.own.recording,
                    &self.own.function,
                    &self.own.milestones,
                    self.start,
                    &it.address,
                ),
                score,
                parts: FaceScore::of(parts.map_err(|error| refused(&error))?, &channels),
            })
        };
        Ok(Choice {
            function: self.own.function.clone(),
            target: self.target.to_string(),
            recording_id: self.own.recording,
            milestones: self.own.milestones,
            rank: if query.is_some() {
                self.options.rank
            } else {
                Rank::Medoid
            },
            left_out,
            compared: order.len() as u64,
            references: references.len() as u64,
            adapted: made,
            ranking: order
                .iter()
                .take(self.options.limit)
                .map(explain)
                .collect::<Result<_>>()?,
            skipped,
            channels,
        })
    }

    /// Returns the mean score of a performance against references other than itself.
    fn usual(
        &self,
        ready: &[(&Performance, Phased)],
        at: usize,
        references: &[usize],
        seconds: f64,
    ) -> std::result::Result<(f64, u64), phases::PhasedError> {
        let (mut sum, mut count, mut made) = (0.0, 0, 0);
        for other in references.iter().filter(|other| **other != at) {
            let found = phases::score(
                &ready[*other].1,
                &ready[at].1,
                seconds,
                &self.options.scoring(),
            )?;
            sum += self.options.value(&found);
            made += adapted(&found);
            count += 1;
        }
        Ok((sum / f64::from(count.max(1)), made))
    }
}

/// Returns the recipe that transfers the expression of `token` to the milestones of a recording whose movement begins
/// at `start` microseconds of its clock.
fn carried(
    recording: i64,
    function: &Function,
    milestones: &Milestones,
    start: i64,
    token: &str,
) -> String {
    let times = milestones.shifted(-start).times();
    let times = times.map(|at| format!("{}s", at.seconds())).join(", ");
    format!("recording:{recording} | nonmanual \"{function}\" from {token} over {times} by phases")
}

fn adapted(score: &PhasedScore) -> u64 {
    let made =
        |phase: &phases::PhaseScore| phase.made.is_some_and(|made| made != CostMethod::AsAsked);
    u64::from(score.phases.iter().any(made))
}

/// Returns the results of `work` for each item, in order, computed by as many threads as the machine has cores.
fn in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = thread::available_parallelism()
        .map_or(1, usize::from)
        .min(8);
    let part = items.len().div_ceil(threads).max(1);
    if items.len() < 64 || threads == 1 {
        return items.iter().map(work).collect();
    }
    thread::scope(|scope| {
        let running: Vec<_> = items
            .chunks(part)
            .map(|part| scope.spawn(|| part.iter().map(&work).collect::<Vec<R>>()))
            .collect();
        let done = running
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_default());
        done.collect()
    })
}

fn refused(error: &phases::PhasedError) -> Error {
    Error::wrong(format!("the two faces cannot be compared: {error}"))
}

fn faceless(address: &Address) -> Error {
    Error::wrong(format!("{address} shows no face and no turn of the head"))
        .at(address.to_string())
        .advise(Remedy::command("import its face file under the recording's name, or rank by the medoid with --rank medoid"))
}
