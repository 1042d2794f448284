//! The recordings: which signs, when.

use super::alphabet;
use super::score::{Sign, Take};
use super::signs;

/// How long the signer stands before the first stroke and after the last one, in seconds.
const BEFORE: f64 = 0.85;
const AFTER: f64 = 0.85;

/// Returns every recording, in the order of their names.
pub(crate) fn takes() -> Vec<Take> {
    let single = |stem, about, sign: Sign| take(stem, about, vec![(0.0, sign)]);
    let mut takes = vec![
        single("aimer", "the sign AIMER", signs::aimer()),
        take(
            "animaux",
            "paws of three animals, both hands held",
            row(paws(), 0.38),
        ),
        single("bol", "the sign BOL", signs::bol()),
        single("chat", "the cat's walk", signs::chat()),
        single("chien", "the sign CHIEN", signs::chien()),
        single("clair", "the sign CLAIR", signs::clair()),
        take(
            "configurations",
            "the manual alphabet, letter by letter",
            row(alphabet::letters(), 0.30),
        ),
        single("donner", "the sign DONNER", signs::donner()),
        single("escargot", "the sign ESCARGOT", signs::escargot()),
        single("penser", "the sign PENSER", signs::penser()),
        Take {
            phrase: Some([
                "Je donne son bol au chien, il aime ça.",
                "I give the dog its bowl, it likes that.",
            ]),
            ..take("phrase", "four signs in one breath", phrase())
        },
        single("punir", "the sign PUNIR", signs::punir()),
        single("week-end", "the sign WEEK-END", signs::week_end()),
    ];
    for (seed, take) in (11..).zip(&mut takes) {
        take.seed = seed;
    }
    takes
}

fn paws() -> Vec<Sign> {
    vec![
        signs::paws("LION", ["lion (sa patte)", "lion (its paw)"], "5_folded"),
        signs::paws("POULE", ["poule (sa patte)", "hen (its foot)"], "3"),
        signs::paws("VACHE", ["vache (son sabot)", "cow (its hoof)"], "S"),
    ]
}

fn phrase() -> Vec<(f64, Sign)> {
    let gaps = [0.0, 0.42, 0.30, 0.34];
    let signs = [
        signs::chien(),
        signs::bol(),
        signs::donner(),
        signs::aimer(),
    ];
    let mut at = 0.0;
    let timed = signs.into_iter().zip(gaps).map(|(sign, gap)| {
        let start = at + gap;
        at = start + sign.length;
        (start, sign)
    });
    timed.collect()
}

/// Places signs one after the other with the same time between them.
fn row(signs: Vec<Sign>, gap: f64) -> Vec<(f64, Sign)> {
    let mut at = 0.0;
    let timed = signs.into_iter().map(|sign| {
        let start = at;
        at += sign.length + gap;
        (start, sign)
    });
    timed.collect()
}

fn take(stem: &'static str, about: &'static str, signs: Vec<(f64, Sign)>) -> Take {
    let signs: Vec<(f64, Sign)> = signs
        .into_iter()
        .map(|(at, sign)| (at + BEFORE, sign))
        .collect();
    let end = signs.last().map_or(0.0, |(at, sign)| at + sign.length);
    Take {
        stem,
        about,
        signs,
        length: ((end + AFTER) * 10.0).ceil() / 10.0,
        phrase: None,
        seed: 0,
    }
}
