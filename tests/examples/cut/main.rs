//! Measures how well takes are cut into signs: `cargo run -p chereme-tests --example cut -- SIGML-FOLDER BODY.bvh [STRINGS]`.
//!
//! Strings of eight signs each are generated from notation on the body, from rest to rest, at three tempi, without and with
//! noise, and signs alone, from a seed. The signs are halved by a hash of their names. Truth is the time from the first to the
//! last posture of each sign. The takes of the starter corpus, which are made as well, are cut, too; their truth is their
//! tokens. Each table has the baselines. `... -- takes FILE.bvh...` prints the cuts of captures; `... -- learn STRINGS
//! SIGML-FOLDER BODY.bvh...` learns the weights from the tuning half, and prints them for `schema/cutting.json`.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

#[allow(dead_code, reason = "other examples need more of it")]
#[path = "../notation/bodies.rs"]
mod bodies;
mod captures;
mod learn;
mod strings;

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use chereme_analysis::agreement::span_measures::{SpanComparison, compare_span_lists, divide_evenly, grid_frames};
use chereme_analysis::cut::{CutOptions, cut_baselines, cut_take};
use chereme_motion::{BodyAnatomy, Clip, TimeSpan};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// How many strings of each half are generated, unless a number is given.
const USUAL_STRINGS: usize = 12;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["takes", files @ ..] if !files.is_empty() => captures::print_cuts(files),
        ["learn", count, folder, bodies @ ..] if !bodies.is_empty() => {
            learn::print_weights(Path::new(folder), bodies, count.parse()?)
        }
        [folder, body] => print_tables(Path::new(folder), Path::new(body), USUAL_STRINGS),
        [folder, body, count] => print_tables(Path::new(folder), Path::new(body), count.parse()?),
        _ => Err(
            "say `SIGML-FOLDER BODY.bvh [STRINGS]`, `learn STRINGS SIGML-FOLDER BODY.bvh...` or `takes FILE.bvh...`"
                .into(),
        ),
    }
}

fn print_tables(folder: &Path, body: &Path, count: usize) -> Result<()> {
    for is_tuned in [true, false] {
        let strings = strings::generate_strings(folder, body, count, is_tuned)?;
        let half = if is_tuned { "tuning half" } else { "other half" };
        println!("\n### Strings of generated signs, {half}: {} strings\n", strings.len());
        print_methods(&strings);
        print_confidence(&strings);
        let alone = strings::generate_isolated(folder, body, 4 * count, is_tuned)?;
        println!("\n### Generated signs alone, {half}: {} takes\n", alone.len());
        print_methods(&alone);
    }
    let starter = captures::starter_takes()?;
    println!(
        "\n### Takes of the starter corpus, also made: {} takes\n",
        starter.len()
    );
    print_methods(&starter);
    Ok(())
}

/// A take with the true times of its signs.
pub(crate) struct TrueTake {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    pub(crate) anatomy: BodyAnatomy,
    pub(crate) signs: Vec<TimeSpan>,
}

fn span_frames(spans: &[TimeSpan]) -> Vec<Range<i64>> {
    let frames = spans.iter().map(|span| {
        let (start, end) = (span.span_start_instant(), span.span_end_instant());
        grid_frames(start.instant_micros(), end.instant_micros())
    });
    frames.collect()
}

/// Returns the spans of the signs that are cut out of a take.
pub(crate) fn cut_spans(clip: &Clip, anatomy: &BodyAnatomy, cost: f64) -> Vec<TimeSpan> {
    let cut = cut_take(clip, anatomy, CutOptions { sign_cost: cost }).unwrap_or_default();
    cut.signs.iter().map(|sign| sign.span).collect()
}

/// Prints the figures of each method.
fn print_methods(takes: &[TrueTake]) {
    println!(
        "| method | count | F1@.5 | mF1S | mF1B | IoU | mean IoU of pairs | begin, end (median ms) | splits | merges |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    let usual = CutOptions::default().sign_cost;
    type Method = fn(&TrueTake, f64) -> Vec<Range<i64>>;
    let uniform: Method = |take, _| {
        let length = span_frames(&[take.clip.clip_span()]);
        divide_evenly(length[0].clone(), take.signs.len())
    };
    let minima: Method = |take, _| span_frames(&cut_baselines(&take.clip, &take.anatomy).speed_minima);
    let activities: Method = |take, _| span_frames(&cut_baselines(&take.clip, &take.anatomy).activities);
    let cut: Method = |take, cost| span_frames(&cut_spans(&take.clip, &take.anatomy, cost));
    let rows: [(&str, Method, f64); 7] = [
        ("uniform, true count", uniform, 0.0),
        ("every minimum of speed", minima, 0.0),
        ("one span an activity", activities, 0.0),
        ("one sign an activity (peel)", cut, 1e9),
        ("**cut**", cut, usual),
        ("cut, more", cut, CutOptions::with_more_signs(1).sign_cost),
        ("cut, fewer", cut, CutOptions::with_more_signs(-1).sign_cost),
    ];
    for (name, method, cost) in rows {
        let mut all = SpanComparison::default();
        for take in takes {
            all.add_span_comparison(&compare_span_lists(&span_frames(&take.signs), &method(take, cost)));
        }
        print_row(name, &all);
    }
}

/// Prints how many signs are right (they overlap a true one by half) in each quarter of confidence.
fn print_confidence(takes: &[TrueTake]) {
    let mut judged: Vec<(f64, bool)> = Vec::new();
    for take in takes {
        let truth = span_frames(&take.signs);
        let cut = cut_take(&take.clip, &take.anatomy, CutOptions::default()).unwrap_or_default();
        judged.extend(cut.signs.iter().map(|sign| {
            let compared = |one: &Range<i64>| compare_span_lists(std::slice::from_ref(one), &span_frames(&[sign.span]));
            (sign.confidence, truth.iter().any(|one| compared(one).spans[2].hits > 0))
        }));
    }
    judged.sort_by(|one, other| other.0.total_cmp(&one.0));
    println!("\n| signs by confidence | mean confidence | right |\n|---|--:|--:|");
    for (number, quarter) in judged.chunks(judged.len().div_ceil(4).max(1)).enumerate() {
        let mean = quarter.iter().map(|(confidence, _)| confidence).sum::<f64>() / quarter.len() as f64;
        let right = quarter.iter().filter(|(_, is_right)| *is_right).count() as f64 / quarter.len() as f64;
        println!("| quarter {} | {mean:.2} | {right:.2} |", number + 1);
    }
}

fn print_row(name: &str, all: &SpanComparison) {
    let percent = |figure: chereme_analysis::agreement::AgreementMeasure| match figure {
        Ok(figure) => format!("{:.0}", 100.0 * figure),
        Err(_) => "–".to_owned(),
    };
    let median = |offsets: &[i64]| -> i64 {
        let mut sorted: Vec<i64> = offsets.iter().map(|offset| offset.abs() * 40).collect();
        sorted.sort_unstable();
        sorted.get(sorted.len() / 2).copied().unwrap_or(0)
    };
    println!(
        "| {name} | {} % | {} | {} | {} | {} | {} | {}, {} | {} | {} |",
        percent(all.span_count_ratio()),
        percent(all.half_overlap_f1()),
        percent(all.mean_span_f1()),
        percent(all.mean_boundary_f1()),
        percent(all.frame_overlap()),
        percent(all.mean_pair_overlap()),
        median(&all.begin_offsets),
        median(&all.end_offsets),
        all.splits,
        all.merges,
    );
}
