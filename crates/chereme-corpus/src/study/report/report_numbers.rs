//! Numbers and reasons of a report as texts.

use super::{ExclusionReason, VerdictReason};
use crate::study::report::report_words as w;
use crate::study::study_plan::ExclusionRule;
use crate::words::{InterfaceLanguage, fill_text_braces};

/// Returns a number with a minus sign and the decimal mark of the language.
#[must_use]
pub fn format_report_number(value: f64, decimals: usize, language: InterfaceLanguage) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    let text = if zero {
        text.replace('-', "")
    } else {
        text.replace('-', "−")
    };
    match language {
        InterfaceLanguage::French => text.replace('.', ","),
        InterfaceLanguage::English | InterfaceLanguage::Other(_) => text,
    }
}

/// Returns a share in percent, with one decimal.
#[must_use]
pub fn format_percent(share: f64, language: InterfaceLanguage) -> String {
    with_sign(format_report_number(100.0 * share, 1, language), language)
}

/// Returns a level such as 0.95 in percent, without decimals if it is whole.
#[must_use]
pub fn format_level(level: f64, language: InterfaceLanguage) -> String {
    let percent = 100.0 * level;
    let is_whole = (percent - percent.round()).abs() < 1e-9;
    with_sign(
        format_report_number(percent, usize::from(!is_whole), language),
        language,
    )
}

fn with_sign(number: String, language: InterfaceLanguage) -> String {
    match language {
        InterfaceLanguage::French => format!("{number}\u{a0}%"),
        InterfaceLanguage::English | InterfaceLanguage::Other(_) => format!("{number}%"),
    }
}

/// Returns p with two digits that count, or as less than 0.0001.
#[must_use]
pub fn format_p_value(p: f64, language: InterfaceLanguage) -> String {
    match p {
        p if p < 0.0001 => format!("< {}", format_report_number(0.0001, 4, language)),
        p if p < 0.01 => format_report_number(p, 4, language),
        p => format_report_number(p, 3, language),
    }
}

/// Returns the sentence for the reason of a conclusion.
#[must_use]
pub fn verdict_reason_sentence(because: VerdictReason, language: InterfaceLanguage) -> String {
    let why = match because {
        VerdictReason::NoTest(why) => w::undefined_reason_words(why).text_in_language(language),
        _ => "",
    };
    fill_text_braces(
        w::verdict_reason_words(because).text_in_language(language),
        &[("why", &why)],
    )
}

/// Returns the words for a reason to leave somebody out.
#[must_use]
pub fn exclusion_reason_words(reason: &ExclusionReason, language: InterfaceLanguage) -> String {
    let (n, question) = match reason {
        ExclusionReason::Rule(ExclusionRule::ChecksWrong(n)) => (*n, ""),
        ExclusionReason::Filter { question } => (0, question.as_str()),
        _ => (0, ""),
    };
    fill_text_braces(
        w::exclusion_reason_text(reason).text_in_language(language),
        &[("n", &n), ("question", &question)],
    )
}
