//! The texts of the pane of agreement, and what it asks the corpus, without widgets.

use std::fmt::Display;

use chereme_corpus::{
    AgreeOptions, AnnotatorAgreement, DisagreementKind, DisagreementSide, MEASURE_NAMES, MeasureFigure,
    NumberQuartiles, RecordingContents, RowName, ValueDisagreement,
};
use chereme_motion::{RecordingInstant, TimeSpan};

use super::super::timeline::timeline_data::time_text;
use crate::words::{InterfaceLanguage, InterfaceText, agreement as words, fill_text_braces, translate_library_message};

/// The two tiers, and the settings of the comparison.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AgreementChoices {
    /// The first and the second tier of the open recording.
    pub(super) tiers: [Option<i64>; 2],
    /// Whether the tiers of these names are compared in every recording.
    pub(super) everywhere: bool,
    pub(super) gamma: bool,
    pub(super) tolerance_ms: i64,
    /// The share of the longer unit that must overlap for a match, in percent.
    pub(super) overlap: u8,
    pub(super) whole: bool,
    /// Whether the tiers are named by texts: a name, a pattern with a star, `annotator:NAME`, or `tier:12`.
    pub(super) by_text: bool,
    /// These texts, once they are typed.
    pub(super) texts: [String; 2],
    /// How many draws intervals and the chance of gamma come from, and their seed.
    pub(super) draws: usize,
    pub(super) samples: usize,
    pub(super) seed: u64,
}

impl Default for AgreementChoices {
    fn default() -> Self {
        Self {
            tiers: [None, None],
            everywhere: false,
            gamma: false,
            tolerance_ms: 80,
            overlap: 60,
            whole: false,
            by_text: false,
            texts: [String::new(), String::new()],
            draws: 1000,
            samples: 30,
            seed: 1,
        }
    }
}

impl AgreementChoices {
    /// Returns the options of the comparison, and the names of both tiers; nothing without two tiers of the recording.
    pub(super) fn agree_options(&self, contents: &RecordingContents) -> Option<(AgreeOptions, [String; 2])> {
        let [a, b] = self.tiers;
        let named = |id: Option<i64>| {
            let tier = contents.tiers.iter().find(|it| Some(it.row.id) == id);
            tier.map(|it| it.row.name.clone())
        };
        let typed = self.texts.each_ref().map(|text| text.trim().to_owned());
        if self.by_text && typed.iter().any(String::is_empty) {
            return None;
        }
        let (names, texts) = match (self.by_text, self.everywhere) {
            (true, _) => (typed.clone(), typed),
            (false, true) => {
                let names = [named(a)?, named(b)?];
                (names.clone(), names)
            }
            (false, false) => {
                // Names are not unique over recordings, numbers are.
                let numbers = [a?, b?].map(|id| format!("tier:{id}"));
                ([named(a)?, named(b)?], numbers)
            }
        };
        let open = RowName::Number(contents.recording.id);
        let [first, second] = texts;
        let wanted = |measure: &&str| self.gamma || !measure.starts_with("gamma");
        let measures = MEASURE_NAMES.iter().copied().filter(wanted);
        let options = AgreeOptions {
            measures: measures.map(str::to_owned).collect(),
            share: f64::from(self.overlap) / 100.0,
            tolerance_us: self.tolerance_ms * 1000,
            whole: self.whole,
            draws: self.draws,
            samples: self.samples,
            seed: self.seed,
            recording: (self.by_text && !self.everywhere).then_some(open),
            ..AgreeOptions::new(first, second)
        };
        Some((options, names))
    }
}

/// Returns how much later the second annotator starts and ends, in milliseconds: medians with quartiles.
pub(super) fn annotator_delays(found: &AnnotatorAgreement, language: InterfaceLanguage) -> Option<String> {
    let quartiles = |delay: &NumberQuartiles| {
        let [q1, median, q3] = [delay.q1, delay.median, delay.q3].map(|seconds| format!("{:+.0}", seconds * 1000.0));
        format!("{median} ({q1} … {q3})")
    };
    let (start, end) = found.onset_s.as_ref().zip(found.offset_s.as_ref())?;
    let (start, end) = (quartiles(start), quartiles(end));
    let values: [(&str, &dyn Display); 2] = [("start", &start), ("end", &end)];
    Some(fill_text_braces(words::DELAYS.text_in_language(language), &values))
}

/// The kinds of disagreements in sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum DisagreementKinds {
    #[default]
    All,
    Only(DisagreementKind),
}

/// The order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum DisagreementOrder {
    #[default]
    Costliest,
    Time,
}

/// A disagreement as a row of the list.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DisagreementRow {
    /// Its place in the list of the comparison.
    pub(super) place: usize,
    pub(super) name: String,
    pub(super) about: String,
}

/// The annotations of both sides, which identify a disagreement in a later comparison.
pub(super) type DisagreementKey = [Option<i64>; 2];

pub(super) fn disagreement_key(it: &ValueDisagreement) -> DisagreementKey {
    [&it.a, &it.b].map(|side| side.as_ref().map(|annotated| annotated.annotation))
}

/// Returns the rows of the list.
pub(super) fn disagreement_rows(
    found: &AnnotatorAgreement,
    names: &[String; 2],
    kinds: DisagreementKinds,
    order: DisagreementOrder,
    language: InterfaceLanguage,
) -> Vec<DisagreementRow> {
    let is_wanted = |disagreement: &ValueDisagreement| match kinds {
        DisagreementKinds::All => true,
        DisagreementKinds::Only(kind) => disagreement.kind == kind,
    };
    let mut places: Vec<usize> = (0..found.list.len()).collect();
    places.retain(|at| is_wanted(&found.list[*at]));
    if order == DisagreementOrder::Time {
        let time = |at: &usize| (found.list[*at].recording_id, found.list[*at].start_us);
        places.sort_by_key(time);
    }
    let several = found.pairs.len() > 1;
    let row = |place: usize| {
        let it = &found.list[place];
        DisagreementRow {
            place,
            name: row_name(it, names, language),
            about: describe_disagreement(it, several, language),
        }
    };
    places.into_iter().map(row).collect()
}

fn row_name(it: &ValueDisagreement, names: &[String; 2], language: InterfaceLanguage) -> String {
    let say = |text: InterfaceText, values: &[(&str, &dyn Display)]| {
        fill_text_braces(text.text_in_language(language), values)
    };
    let value = |side: &Option<DisagreementSide>| match side {
        Some(it) if !it.value.is_empty() => it.value.clone(),
        _ => words::NO_VALUE.text_in_language(language).to_owned(),
    };
    let apart = |of: fn(&DisagreementSide) -> i64| match (&it.a, &it.b) {
        (Some(a), Some(b)) => format!("{:+.0}", (of(b) - of(a)) as f64 / 1000.0),
        _ => String::new(),
    };
    match it.kind {
        DisagreementKind::OnlyA | DisagreementKind::OnlyB => {
            let (side, name) = match it.kind {
                DisagreementKind::OnlyA => (&it.a, &names[0]),
                _ => (&it.b, &names[1]),
            };
            say(words::ROW_ONLY, &[("value", &value(side)), ("tier", name)])
        }
        DisagreementKind::Value => say(words::ROW_VALUE, &[("a", &value(&it.a)), ("b", &value(&it.b))]),
        DisagreementKind::Boundary => {
            let (start, end) = (apart(|side| side.start_us), apart(|side| side.end_us));
            let values: [(&str, &dyn Display); 3] = [("value", &value(&it.a)), ("start", &start), ("end", &end)];
            say(words::ROW_BOUNDARY, &values)
        }
    }
}

fn describe_disagreement(it: &ValueDisagreement, several: bool, language: InterfaceLanguage) -> String {
    let [start, end] = [it.start_us, it.end_us].map(|at| time_text(RecordingInstant::from_micros(at)));
    let mut parts = vec![format!("{start} – {end}")];
    if several {
        parts.push(it.recording.clone());
    }
    if it.kind == DisagreementKind::Value && !it.differs.is_empty() {
        let features = it.differs.join(", ");
        parts.push(fill_text_braces(
            words::DIFFERS.text_in_language(language),
            &[("features", &features)],
        ));
    }
    parts.join(" · ")
}

/// Returns the span of a disagreement.
pub(super) fn disagreement_span(it: &ValueDisagreement) -> TimeSpan {
    let [start, end] = [it.start_us, it.end_us].map(RecordingInstant::from_micros);
    TimeSpan::span_between(start, end)
}

/// Returns the row to go to from the row `now`, `by` rows further; nothing at either end.
pub(super) fn step_disagreement_row(now: Option<usize>, by: isize, count: usize) -> Option<usize> {
    match now {
        _ if count == 0 => None,
        None if by < 0 => Some(count - 1),
        None => Some(0),
        Some(now) => now.checked_add_signed(by).filter(|to| *to < count),
    }
}

/// Returns a measure as text: its value, or the reason why it has none.
pub(super) fn measure_value_text(figure: &MeasureFigure, language: InterfaceLanguage) -> String {
    match (figure.figure_text(), &figure.why) {
        (Some(text), _) => text,
        (None, Some(why)) => {
            let why = translate_library_message(why, language);
            fill_text_braces(words::UNDEFINED.text_in_language(language), &[("why", &why)])
        }
        (None, None) => String::new(),
    }
}

/// Returns the interval of a measure, and what was drawn for it.
pub(super) fn measure_interval_texts(figure: &MeasureFigure, language: InterfaceLanguage) -> Option<[String; 2]> {
    let it = figure.interval.as_ref()?;
    let of = chereme_corpus::words::noun_form_for_count(2, it.of, language);
    let values: [(&str, &dyn Display); 2] = [("n", &it.draws), ("of", &of)];
    Some([
        format!("{:.3} … {:.3}", it.low, it.high),
        fill_text_braces(words::DRAWS.text_in_language(language), &values),
    ])
}

/// Returns the name of one of the usual measures for people; other measures have the names of the command line.
pub(super) fn usual_measure_title(measure: &str) -> Option<InterfaceText> {
    Some(match measure {
        "raw" => words::RAW,
        "matched" => words::MATCHED,
        "kappa_ipf" => words::KAPPA_IPF,
        "alpha_u" => words::ALPHA_U,
        "gamma" => words::GAMMA_NAME,
        _ => return None,
    })
}

/// Returns what a measure measures.
pub(super) fn measure_meaning(measure: &str) -> Option<InterfaceText> {
    Some(match measure {
        "kappa_ipf" => words::ABOUT_KAPPA_IPF,
        "raw" => words::ABOUT_RAW,
        "matched" => words::ABOUT_MATCHED,
        "kappa" => words::ABOUT_KAPPA,
        "kappa_max" => words::ABOUT_KAPPA_MAX,
        "alpha_u" => words::ABOUT_ALPHA_U,
        "u_alpha" => words::ABOUT_U_ALPHA,
        "u_alpha_spans" => words::ABOUT_U_ALPHA_SPANS,
        "cu_alpha" => words::ABOUT_CU_ALPHA,
        "gamma" => words::ABOUT_GAMMA,
        "gamma_cat" => words::ABOUT_GAMMA_CAT,
        "label_alpha_features" => words::ABOUT_FEATURES,
        "boundaries" => words::ABOUT_BOUNDARIES,
        it if it.starts_with("label_") => words::ABOUT_LABELS,
        it if it.starts_with("overlap_") => words::ABOUT_OVERLAP,
        it if it.starts_with("frames_") => words::ABOUT_FRAMES,
        it if it.starts_with("segment_") => words::ABOUT_SEGMENTS,
        _ => return None,
    })
}

/// Returns a name for the third tier that is not in `taken`: the common part of both names, or both together.
pub(super) fn third_name([a, b]: &[String; 2], taken: &[&str]) -> String {
    let same = |pair: &(char, char)| pair.0 == pair.1;
    let before: String = a.chars().zip(b.chars()).take_while(same).map(|pair| pair.0).collect();
    let (rest_a, rest_b) = (&a[before.len()..], &b[before.len()..]);
    let reversed_pairs = rest_a.chars().rev().zip(rest_b.chars().rev());
    let after: usize = reversed_pairs.take_while(same).map(|pair| pair.0.len_utf8()).sum();
    let after = &rest_a[rest_a.len() - after..];
    let trimmed = |text: &str| {
        let blank = |letter: char| letter.is_whitespace() || "-_.:/+()".contains(letter);
        text.trim_matches(blank).to_owned()
    };
    let trimmed_parts = [trimmed(&before), trimmed(after)];
    let parts: Vec<&str> = trimmed_parts
        .iter()
        .map(String::as_str)
        .filter(|part| !part.is_empty())
        .collect();
    let shared = parts.join(" ");
    let stem = match shared.chars().count() {
        0 | 1 => format!("{a} + {b}"),
        _ => shared,
    };
    let is_free = |name: &String| !taken.contains(&name.as_str());
    let numbered = (2..).map(|n| format!("{stem} {n}"));
    let mut names = std::iter::once(stem.clone()).chain(numbered);
    names.find(is_free).unwrap_or(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_stop_at_either_end() {
        for (now, by, count, to) in [
            (None, 1, 0, None),
            (None, 1, 3, Some(0)),
            (None, -1, 3, Some(2)),
            (Some(0), 1, 3, Some(1)),
            (Some(2), 1, 3, None),
            (Some(0), -1, 3, None),
        ] {
            assert_eq!(step_disagreement_row(now, by, count), to, "{now:?} {by} {count}");
        }
    }

    #[test]
    fn the_third_tier_has_what_both_names_share() {
        for (a, b, taken, name) in [
            ("Gloss Anna", "Gloss Ben", vec![], "Gloss"),
            ("Gloss-A", "Gloss-B", vec!["Gloss-A", "Gloss-B"], "Gloss"),
            ("Anna Gloss", "Ben Gloss", vec!["Gloss"], "Gloss 2"),
            ("left", "right", vec![], "left + right"),
            ("Été a", "Été b", vec!["Été", "Été 2"], "Été 3"),
            ("x", "x", vec![], "x + x"),
        ] {
            let names = [a.to_owned(), b.to_owned()];
            assert_eq!(third_name(&names, &taken), name);
        }
    }

    #[test]
    fn every_measure_is_explained() {
        for measure in MEASURE_NAMES {
            assert!(measure_meaning(measure).is_some(), "{measure}");
        }
        for measure in chereme_corpus::USUAL_MEASURES {
            assert!(usual_measure_title(measure).is_some(), "{measure}");
        }
    }

    #[test]
    fn an_undefined_measure_gives_its_reason() {
        let figure = |value, why: Option<&str>| MeasureFigure {
            value,
            why: why.map(str::to_owned),
            interval: None,
        };
        let said = |figure| measure_value_text(&figure, InterfaceLanguage::English);
        assert_eq!(said(figure(Some(-0.0001), None)), "0.000");
        assert_eq!(said(figure(None, Some("one value only"))), "– (one value only)");
        let french = measure_value_text(&figure(None, Some("one value only")), InterfaceLanguage::French);
        assert_eq!(french, "– (une seule valeur)");
    }
}
