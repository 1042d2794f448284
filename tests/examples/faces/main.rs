//! Repeats the experiment of the founding paper on faces with generated performances, from capture files to tables.
//!
//! `cargo run --release -p chereme-tests --example faces -- [FOLDER] [--write] [--pool N]`
//!
//! Eighteen sentences in three functions (negation, wh and yes/no questions) are performed by a generator whose faces and
//! milestones are known. They are written as files of MPEG-4 parameters and imported; then their milestones are derived,
//! and they are scored, ranked, and transferred to each other. FOLDER keeps the files, the corpus and `tables.md`;
//! without it they are in a temporary folder. `--pool N` chooses among N performances instead, and prints the time of
//! that. `--write` puts the tables into `tests/examples/faces/RESULTS.md`; those of the other kind remain.
//!
//! Each table states what it shows and what it does not. Nobody rated these performances: the paper's correlations with
//! comprehension need people, and no number of this program replaces them.

#![allow(clippy::print_stdout, reason = "the tables are the program's result")]

mod pool;
mod proposals;
mod sentence;
mod table;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use chereme_corpus::{
    ChooseOptions, Corpus, CorpusAddress, ExpressionFunction, ImportOptions, MilestoneOptions, PerformanceChoice,
    ProgressReceiver, RankingCriterion, RowName, ignore_progress_step,
};

use sentence::{Numbers, Sentence};
use table::{Tables, rho};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut folder = None;
    let mut pool = None;
    let mut write = false;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--write" => write = true,
            "--pool" => pool = Some(words.next().ok_or("--pool needs a number")?.parse()?),
            word => folder = Some(PathBuf::from(word)),
        }
    }
    let own = tempfile::tempdir()?;
    let folder = folder.unwrap_or_else(|| own.path().to_owned());
    std::fs::create_dir_all(&folder)?;
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/faces/RESULTS.md");
    let (tables, speed) = table::sections(&std::fs::read_to_string(&results)?);
    if let Some(count) = pool {
        let text = pool::run(&folder, count)?;
        if write {
            std::fs::write(results, tables + &text)?;
        }
        println!("{text}");
        return Ok(());
    }
    let mut tables = Tables::default();
    let all = Sentence::all();
    let mut corpus = captured(&folder, &all)?;
    find_milestones(&mut corpus, &all, &mut tables)?;
    let pairs = score(&corpus, &all, &mut tables)?;
    let choices = choose(&corpus, &all, &mut tables)?;
    animate(&mut corpus, &all, &choices, &mut tables)?;
    simulate(&pairs, &mut tables);
    propose(&mut tables);
    time(&corpus, &mut tables)?;
    let text = tables.text();
    std::fs::write(folder.join("tables.md"), &text)?;
    if write {
        std::fs::write(results, text.clone() + &speed)?;
    }
    println!("{text}");
    Ok(())
}

/// Returns the address of a sentence's recording.
fn address(name: &str) -> CorpusAddress {
    CorpusAddress::Recording(RowName::Text(name.to_owned()))
}

/// Writes every sentence as a capture file, imports it, and annotates its signs and its function.
fn captured(folder: &Path, all: &[Sentence]) -> Result<Corpus, Failure> {
    let path = folder.join("faces.chereme");
    if path.exists() {
        std::fs::remove_file(&path)?;
    }
    let mut corpus = Corpus::create_corpus(&path, "faces")?;
    let mut files = Vec::new();
    for sentence in all {
        let path = folder.join(format!("{}.fap", sentence.name));
        std::fs::write(&path, sentence.fap())?;
        files.push(path);
    }
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus.import_paths(&files, &ImportOptions::default(), progress)?;
    for sentence in all {
        sentence.annotate(&mut corpus)?;
    }
    Ok(corpus)
}

/// Derives the milestones and compares them with those that the generator used.
fn find_milestones(corpus: &mut Corpus, all: &[Sentence], tables: &mut Tables) -> Result<(), Failure> {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let found = corpus.derive_face_milestones(&MilestoneOptions::default(), progress)?;
    let mut rows = Vec::new();
    let mut right = 0;
    for sentence in all {
        let mut own = found.expressions.iter();
        let own = own.find(|it| it.recording == sentence.name);
        let own = own.ok_or("an expression was not found")?;
        let same = own.milestones == sentence.milestones;
        right += usize::from(same);
        rows.push(vec![
            sentence.name.clone(),
            own.function.to_string(),
            own.signs.join(" "),
            own.milestones.to_string(),
            if same { "as known" } else { "not as known" }.to_owned(),
        ]);
    }
    tables.add(
        "Milestones (section 3)",
        &["sentence", "function", "signs", "M1 to M5", "compared"],
        rows,
        [
            &format!("{right} of {} are those that the generator used.", all.len()),
            "Milestones that follow from glosses are as good as the glosses; whether people would set them so is open.",
        ],
    );
    Ok(())
}

/// The score of a pair of sentences of one function, with their known difference.
struct Pair {
    score: f64,
    known: f64,
}

/// Scores every pair of each function.
fn score(corpus: &Corpus, all: &[Sentence], tables: &mut Tables) -> Result<Vec<Pair>, Failure> {
    let options = ChooseOptions::default();
    let mut pairs = Vec::new();
    let mut selves = 0.0_f64;
    let mut rows = Vec::new();
    for gold in all {
        let mut row = vec![gold.name.clone()];
        for other in all.iter().filter(|it| it.function == gold.function) {
            let both = [&address(&gold.name), &address(&other.name)];
            let score = corpus.score_faces(both, None, &options)?;
            row.push(format!("{:.2}", score.stretched));
            if gold.name == other.name {
                selves = selves.max(score.stretched);
                continue;
            }
            pairs.push(Pair {
                score: score.stretched,
                known: gold.difference(other),
            });
        }
        rows.push(row);
    }
    let known: Vec<f64> = pairs.iter().map(|it| it.known).collect();
    let score: Vec<f64> = pairs.iter().map(|it| it.score).collect();
    let together = rho(&known, &score);
    tables.add(
        "Scores (section 5): rows are gold, columns the sentences of the same function",
        &["gold", "1", "2", "3", "4", "5", "6"],
        rows,
        [
            &format!(
                "The greatest score of a sentence against itself is {selves}. Over {} pairs the score goes with the known \
                 difference of the generator's parameters (Spearman {together:.2}).",
                pairs.len()
            ),
            "Whether people see these differences: the generator is no signer, and its parameters are not perception.",
        ],
    );
    Ok(pairs)
}

/// Chooses the nearest and the farthest performance for each sentence.
fn choose(
    corpus: &Corpus,
    all: &[Sentence],
    tables: &mut Tables,
) -> Result<BTreeMap<String, [PerformanceChoice; 2]>, Failure> {
    let mut choices = BTreeMap::new();
    let mut rows = Vec::new();
    let (mut right, mut widened) = (0, 0);
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for sentence in all {
        let function = ExpressionFunction::from_function_name(sentence.function);
        let mut of = |rank| {
            let options = ChooseOptions {
                rank,
                ..ChooseOptions::default()
            };
            corpus.choose_performances(&function, &address(&sentence.name), &options, progress)
        };
        let (near, far) = (of(RankingCriterion::Nearest)?, of(RankingCriterion::Farthest)?);
        let others = all
            .iter()
            .filter(|it| it.function == sentence.function && it.name != sentence.name);
        let like = others
            .min_by(|a, b| sentence.difference(a).total_cmp(&sentence.difference(b)))
            .map(|it| it.name.clone());
        let like = like.ok_or("a function has one sentence")?;
        let (first, last) = (&near.ranking[0], &far.ranking[0]);
        right += usize::from(first.recording == like);
        widened += near.adapted;
        let why = &first.parts.channels[0];
        rows.push(vec![
            sentence.name.clone(),
            format!("{} {:.2}", first.recording, first.score),
            format!("{} {:.2}", last.recording, last.score),
            format!("{} {:.2}", why.name, why.difference),
            like,
        ]);
        choices.insert(sentence.name.clone(), [near, far]);
    }
    let titles = [
        "sentence",
        "nearest",
        "farthest",
        "nearest differs most in",
        "nearest as known",
    ];
    tables.add(
        "Choosing (section 7) among the five other sentences of the same function",
        &titles,
        rows,
        [
            &format!(
                "In {right} of {} sentences the nearest is the one whose parameters are nearest; chance would give {:.1}. \
                 In {widened} comparisons a phase was too long for the paper's window of 10 frames, which was widened.",
                all.len(),
                all.len() as f64 / 5.0
            ),
            "How well choosing works among signers: the candidates are few, and one generator made them.",
        ],
    );
    Ok(choices)
}

/// Animates each sentence with its nearest and its farthest face, and measures the errors at the milestones.
fn animate(
    corpus: &mut Corpus,
    all: &[Sentence],
    choices: &BTreeMap<String, [PerformanceChoice; 2]>,
    tables: &mut Tables,
) -> Result<(), Failure> {
    let (mut made, mut worst) = (0, 0.0_f64);
    let mut rows = Vec::new();
    for sentence in all {
        let mut row = vec![sentence.name.clone()];
        let both = choices.get(&sentence.name).ok_or("nothing was chosen")?;
        for (choice, which) in both.iter().zip(["nearest", "farthest"]) {
            let best = &choice.ranking[0];
            let gloss = format!("{}-{which}", sentence.name);
            let done = corpus.animate_choice(choice, &best.token, &gloss)?;
            let donor = all.iter().find(|it| it.name == best.recording);
            let donor = donor.ok_or("no such sentence")?;
            let brows: Vec<f64> = done.faces.iter().map(|face| face.brows[0]).collect();
            let off = off(sentence, donor, &brows);
            worst = worst.max(off);
            made += 1;
            row.push(best.recording.clone());
            row.push(format!("{off:.3}"));
        }
        rows.push(row);
    }
    tables.add(
        "Warping (sections 3 and 7): brows at M2, M3 and M4 against the chosen performance at its own",
        &["sentence", "nearest", "off", "farthest", "off"],
        rows,
        [
            &format!(
                "{made} sentences were animated and stored. At each milestone the brows pass, within a frame, the value that \
                 the chosen performance has at the same milestone; the greatest distance is {worst:.3} of the usual raise."
            ),
            "Whether the faces between the milestones look right; `chereme render` draws them for the eye.",
        ],
    );
    Ok(())
}

/// Returns the difference of the brows, within a frame of the sentence's M2, M3 and M4, from the donor's brows at its
/// own milestones.
fn off(sentence: &Sentence, donor: &Sentence, brows: &[f64]) -> f64 {
    let (own, theirs) = (
        sentence.milestones.milestone_times(),
        donor.milestones.milestone_times(),
    );
    let mut off = 0.0_f64;
    for n in 1..4 {
        // If signs touch, the expression begins or ends at once, and has no single value there.
        if own[n] == own[n - 1] || own[n] == own[n + 1] {
            continue;
        }
        let want = donor.brow(theirs[n].instant_seconds());
        let at = own[n].instant_seconds() * 30.0;
        let first = (at.floor() as usize).saturating_sub(1).min(brows.len());
        let last = (at.ceil() as usize + 2).min(brows.len());
        let around = &brows[first..last];
        let least = around.iter().copied().fold(f64::INFINITY, f64::min);
        let most = around.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        off = off.max(least - want).max(want - most);
    }
    off
}

/// Correlates scores with ratings drawn from a model, as people's answers would be evaluated.
fn simulate(pairs: &[Pair], tables: &mut Tables) {
    let mut numbers = Numbers(8);
    let mut rows = Vec::new();
    let scores: Vec<f64> = pairs.iter().map(|pair| pair.score).collect();
    for (name, weight) in [("ratings follow the score", -1.0), ("ratings are noise", 0.0)] {
        let rating = |score: &f64| {
            let rating: f64 = 5.0 + weight * score + 1.5 * numbers.normal();
            rating.clamp(1.0, 7.0).round()
        };
        let ratings: Vec<f64> = scores.iter().map(rating).collect();
        let together = format!("{:.2}", rho(&scores, &ratings));
        rows.push(vec![name.to_owned(), pairs.len().to_string(), together]);
    }
    tables.add(
        "Correlation (section 8) with ratings drawn from a model",
        &["model", "pairs", "Spearman"],
        rows,
        [
            "The computation finds a correlation that was put in, and finds little without one.",
            "Whether faces with smaller scores are understood better: these ratings are simulated. That is a question to \
             people; the paper reports their answers, and this program has none.",
        ],
    );
}

/// Compares proposals for brows, lids, gaze, mouth and head with the events that a generator put into noisy curves.
fn propose(tables: &mut Tables) {
    let all = proposals::counted(30);
    let rows = all.iter().map(|((part, value), count)| {
        vec![
            format!("{part}: {value}"),
            count.there.to_string(),
            count.proposed.to_string(),
            format!("{:.3}", count.precision()),
            format!("{:.3}", count.recall()),
        ]
    });
    let rows = rows.collect();
    let least = |of: fn(&proposals::Count) -> f64| all.values().map(of).fold(1.0, f64::min);
    let (precision, recall) = (least(proposals::Count::precision), least(proposals::Count::recall));
    tables.add(
        "Proposals for non-manuals, over 30 generated takes of 40 s with noise, drift and what only looks alike",
        &["part and value", "there", "proposed", "precision", "recall"],
        rows,
        [
            &format!(
                "Every precision is at least {precision:.2} and every recall at least {recall:.2}; a proposal is right if it has \
                 the right value and shares half of the time of both together."
            ),
            "How well the rules do on people: signers hold, blend and begin earlier than a generator, and no take of signing \
             with such annotations could be tried.",
        ],
    );
}

/// Measures when faces begin and end relative to the signs, for each function.
fn time(corpus: &Corpus, tables: &mut Tables) -> Result<(), Failure> {
    let mut hear = ignore_progress_step;
    let onsets = corpus.measure_nonmanual_onsets(None, &mut ProgressReceiver::new(&mut hear))?;
    let said = |it: &chereme_corpus::NumberQuartiles| format!("{:+.3} ({:+.3} to {:+.3})", it.median, it.q1, it.q3);
    let rows = onsets.rows.iter().map(|row| {
        vec![
            row.function.to_string(),
            row.channel.to_owned(),
            row.n.to_string(),
            said(&row.onset_s),
            row.offset_s.as_ref().map(said).unwrap_or_default(),
        ]
    });
    tables.add(
        "Begin against the first sign and end against the last, in seconds: median (quartiles)",
        &["function", "channel", "n", "begin", "end"],
        rows.collect(),
        [
            &format!(
                "The generator moves from M1 to M2 and from M4 to M5; half of that way is what is measured, in {} expressions.",
                onsets.expressions
            ),
            "When signers begin and end: the generator knows only the paper's half second at the edges.",
        ],
    );
    Ok(())
}
