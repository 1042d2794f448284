//! The recordings: sequences of signs.

use super::signs::{self, Sign};

/// A recording.
#[derive(Clone, Debug)]
pub(crate) struct Take {
    /// The name of its files.
    pub(crate) stem: &'static str,
    /// A description in English.
    pub(crate) about: &'static str,
    /// The signs.
    pub(crate) signs: Vec<Sign>,
    /// How long postures are held, in seconds, if not for the usual time.
    pub(crate) hold: Option<f64>,
    /// The meaning of the whole in French and in English, if it is an utterance.
    pub(crate) phrase: Option<[&'static str; 2]>,
    /// The seed of its small irregularities.
    pub(crate) seed: u64,
}

/// Returns every recording, in the order of their names.
pub(crate) fn takes() -> Vec<Take> {
    let take = |stem, about, signs: Vec<Sign>| Take {
        stem,
        about,
        signs,
        hold: None,
        phrase: None,
        seed: 0,
    };
    let single = |stem, about, sign| take(stem, about, vec![sign]);
    let phrase = vec![signs::chien(), signs::bol(), signs::donner(), signs::aimer()];
    let mut takes = vec![
        single("aimer", "the sign AIMER", signs::aimer()),
        take("animaux", "paws of three animals, both hands held", signs::paws()),
        single("bol", "the sign BOL", signs::bol()),
        single("chat", "the cat's walk", signs::chat()),
        single("chien", "the sign CHIEN", signs::chien()),
        single("clair", "the sign CLAIR", signs::clair()),
        Take {
            hold: Some(0.25),
            ..take(
                "configurations",
                "the manual alphabet, letter by letter",
                signs::letters(),
            )
        },
        single("donner", "the sign DONNER", signs::donner()),
        single("escargot", "the sign ESCARGOT", signs::escargot()),
        single("penser", "the sign PENSER", signs::penser()),
        Take {
            phrase: Some([
                "Je donne son bol au chien, il aime ça.",
                "I give the dog its bowl, it likes that.",
            ]),
            ..take("phrase", "four signs in one breath", phrase)
        },
        single("punir", "the sign PUNIR", signs::punir()),
        single("week-end", "the sign WEEK-END", signs::week_end()),
    ];
    for (seed, take) in (11..).zip(&mut takes) {
        take.seed = seed;
    }
    takes
}
