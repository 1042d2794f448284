//! Measures the transcriber in closed loops: notation to movement to notation, and movement to notation to movement.
//!
//! `cargo run --release -p chereme-tests --example transcribe -- notation FOLDER BODY.bvh` animates every
//! `.sigml` file of a folder on a body, transcribes the movement, and prints how often each feature
//! agrees with the notation, also separately for the half of the signs on which thresholds are tuned and for the other
//! half; `... -- plain FOLDER BODY.bvh` does so without verifying places by re-synthesis;
//! `... -- blind FOLDER BODY.bvh` exports each sign as BVH, and transcribes the file like any other capture;
//! `... -- blind-why FEATURE FOLDER BODY.bvh` prints each part in which the feature differs from the notation, `... --
//! blind-confusions FEATURE FOLDER BODY.bvh` counts pairs of written and found values; `... -- plain-why` and `... --
//! plain-confusions` do so without export;
//! `... -- why FEATURE FOLDER BODY.bvh` does so with places verified by re-synthesis, `... -- confusions FEATURE ...`
//! counts pairs of written and found values, both in the half for tuning. Instead of the folder a text file may have
//! one sign in HamNoSys characters on each line. Signs are animated at the body's own frame rate; a number after the
//! body is another frame rate, `1/7` takes one sign in seven, and a file of body language (`.json`) replaces numbers of
//! the animator, but not of the transcriber.
//! `... -- noisy FOLDER BODY.bvh` does as `blind` with movement that is disturbed before its export: by noise, by slow
//! wobble, without End Sites, with one decimal, and with few frames.
//! `... -- movement FILE.bvh...` transcribes captured movement, animates the transcription, and prints their distance.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

#[path = "../notation/bodies.rs"]
mod bodies;
mod compare;
mod movement;
mod noisy;
mod notation;

use std::error::Error;
use std::path::Path;

use chereme_compose::notation::AnimatorSettings;
use notation::More;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["notation", folder, body, rate @ ..] => closed(folder, body, rate, More::Nothing),
        ["plain", folder, body, rate @ ..] => closed(folder, body, rate, More::Plain),
        ["blind", folder, body, rate @ ..] => closed(folder, body, rate, More::Blind),
        ["blind-why", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::BlindWhy(feature))
        }
        ["why", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::Why(feature))
        }
        ["plain-why", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::PlainWhy(feature))
        }
        ["confusions", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::Confusions(feature))
        }
        ["blind-confusions", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::BlindConfusions(feature))
        }
        ["plain-confusions", feature, folder, body, rate @ ..] => {
            closed(folder, body, rate, More::PlainConfusions(feature))
        }
        ["noisy", folder, body, rate @ ..] => {
            let (settings, rate, every) = settings(rate)?;
            noisy::table((Path::new(folder), every), Path::new(body), (rate, settings))
        }
        ["movement", files @ ..] if !files.is_empty() => movement::table(files),
        _ => Err(
            "say `notation FOLDER BODY.bvh`, `plain FOLDER BODY.bvh`, `blind FOLDER BODY.bvh`, `noisy FOLDER BODY.bvh`, `why FEATURE FOLDER BODY.bvh` or `confusions FEATURE \
             FOLDER BODY.bvh`, the frames a second behind it where they are others than the body's; or `movement FILE.bvh...`"
                .into(),
        ),
    }
}

fn closed(folder: &str, body: &str, words: &[&str], more: More<'_>) -> Result<()> {
    let (settings, rate, every) = settings(words)?;
    let folder = (Path::new(folder), every);
    notation::table(folder, Path::new(body), (rate, settings), more)
}

/// Reads the words behind the body: the animator's settings, the frame rate, and how many signs stand for one in the
/// sample.
fn settings(words: &[&str]) -> Result<(AnimatorSettings, Option<u32>, usize)> {
    let mut settings = AnimatorSettings::default();
    let (mut rate, mut every) = (None, 1);
    for word in words {
        if word.ends_with(".json") {
            settings.language = settings.language.with_file(&std::fs::read_to_string(word)?)?;
        } else if let Some(n) = word.strip_prefix("1/") {
            every = n.parse::<usize>()?.max(1);
        } else {
            rate = Some(word.parse()?);
        }
    }
    Ok((settings, rate, every))
}
