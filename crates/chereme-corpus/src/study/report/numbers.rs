//! Numbers and reasons of a report as texts.

use super::{Because, Reason};
use crate::study::plan::Exclusion;
use crate::words::{Language, fill, reporting as w};

/// Returns a number with a minus sign and the decimal mark of the language.
#[must_use]
pub fn number(value: f64, decimals: usize, language: Language) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    let text = if zero {
        text.replace('-', "")
    } else {
        text.replace('-', "−")
    };
    match language {
        Language::French => text.replace('.', ","),
        Language::English | Language::Other(_) => text,
    }
}

/// Returns a share in percent, with one decimal.
#[must_use]
pub fn percent(share: f64, language: Language) -> String {
    with_sign(number(100.0 * share, 1, language), language)
}

/// Returns a level such as 0.95 in percent, without decimals if it is whole.
#[must_use]
pub fn level(level: f64, language: Language) -> String {
    let percent = 100.0 * level;
    let whole = (percent - percent.round()).abs() < 1e-9;
    with_sign(number(percent, usize::from(!whole), language), language)
}

fn with_sign(number: String, language: Language) -> String {
    match language {
        Language::French => format!("{number}\u{a0}%"),
        Language::English | Language::Other(_) => format!("{number}%"),
    }
}

/// Returns p with two digits that count, or as less than 0.0001.
#[must_use]
pub fn p(p: f64, language: Language) -> String {
    match p {
        p if p < 0.0001 => format!("< {}", number(0.0001, 4, language)),
        p if p < 0.01 => number(p, 4, language),
        p => number(p, 3, language),
    }
}

/// Returns the sentence for the reason of a conclusion.
#[must_use]
pub fn because(because: Because, language: Language) -> String {
    let why = match because {
        Because::NoTest(why) => w::undefined(why).of(language),
        _ => "",
    };
    fill(w::because(because).of(language), &[("why", &why)])
}

/// Returns the words for a reason to leave somebody out.
#[must_use]
pub fn reason(reason: &Reason, language: Language) -> String {
    let (n, question) = match reason {
        Reason::Rule(Exclusion::ChecksWrong(n)) => (*n, ""),
        Reason::Filter { question } => (0, question.as_str()),
        _ => (0, ""),
    };
    fill(
        w::reason(reason).of(language),
        &[("n", &n), ("question", &question)],
    )
}
