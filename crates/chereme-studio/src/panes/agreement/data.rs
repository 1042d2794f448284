//! The texts of the pane of agreement, and what it asks the corpus, without widgets.

use std::fmt::Display;

use chereme_corpus::{
    AgreeOptions, Agreement, Contents, Disagreement, DisagreementKind, DisagreementSide, Figure,
    MEASURES, Name, Quartiles,
};
use chereme_motion::{Instant, Span};

use super::super::timeline::data::time_text;
use crate::words::{Language, Text, agreement as words, fill, spoken};

/// The two tiers, and the settings of the comparison.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choices {
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

impl Default for Choices {
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

impl Choices {
    /// Returns the options of the comparison, and the names of both tiers; nothing without two tiers of the recording.
    pub(super) fn options(&self, contents: &Contents) -> Option<(AgreeOptions, [String; 2])> {
        let [a, b] = self.tiers;
        let named = |id: Option<i64>| {
            let found = contents.tiers.iter().find(|it| Some(it.row.id) == id);
            found.map(|it| it.row.name.clone())
        };
        let typed = self.texts.each_ref().map(|it| it.trim().to_owned());
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
                let numbers = [a?, b?].map(|id| format!("tier:{id}"));
                ([named(a)?, named(b)?], numbers)
            }
        };
        let open = Name::Number(contents.recording.id);
        let [first, second] = texts;
        let wanted = |it: &&str| self.gamma || !it.starts_with("gamma");
        let measures = MEASURES.iter().copied().filter(wanted);
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
pub(super) fn delays(found: &Agreement, language: Language) -> Option<String> {
    let quartiles = |it: &Quartiles| {
        let [q1, median, q3] = [it.q1, it.median, it.q3].map(|it| format!("{:+.0}", it * 1000.0));
        format!("{median} ({q1} … {q3})")
    };
    let (start, end) = found.onset_s.as_ref().zip(found.offset_s.as_ref())?;
    let (start, end) = (quartiles(start), quartiles(end));
    let values: [(&str, &dyn Display); 2] = [("start", &start), ("end", &end)];
    Some(fill(words::DELAYS.of(language), &values))
}

/// The kinds of disagreements in sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Kinds {
    #[default]
    All,
    Only(DisagreementKind),
}

/// The order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Order {
    #[default]
    Costliest,
    Time,
}

/// A disagreement as a row of the list.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Its place in the list of the comparison.
    pub(super) place: usize,
    pub(super) name: String,
    pub(super) about: String,
}

/// The annotations of both sides, which identify a disagreement in a later comparison.
pub(super) type Key = [Option<i64>; 2];

pub(super) fn key(it: &Disagreement) -> Key {
    [&it.a, &it.b].map(|side| side.as_ref().map(|it| it.annotation))
}

/// Returns the rows of the list.
pub(super) fn rows(
    found: &Agreement,
    names: &[String; 2],
    (kinds, order): (Kinds, Order),
    language: Language,
) -> Vec<Row> {
    let is_wanted = |it: &Disagreement| match kinds {
        Kinds::All => true,
        Kinds::Only(kind) => it.kind == kind,
    };
    let mut places: Vec<usize> = (0..found.list.len()).collect();
    places.retain(|at| is_wanted(&found.list[*at]));
    if order == Order::Time {
        let time = |at: &usize| (found.list[*at].recording_id, found.list[*at].start_us);
        places.sort_by_key(time);
    }
    let several = found.pairs.len() > 1;
    let row = |place: usize| {
        let it = &found.list[place];
        Row {
            place,
            name: row_name(it, names, language),
            about: about(it, several, language),
        }
    };
    places.into_iter().map(row).collect()
}

fn row_name(it: &Disagreement, names: &[String; 2], language: Language) -> String {
    let say = |text: Text, values: &[(&str, &dyn Display)]| fill(text.of(language), values);
    let value = |side: &Option<DisagreementSide>| match side {
        Some(it) if !it.value.is_empty() => it.value.clone(),
        _ => words::NO_VALUE.of(language).to_owned(),
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
        DisagreementKind::Value => say(
            words::ROW_VALUE,
            &[("a", &value(&it.a)), ("b", &value(&it.b))],
        ),
        DisagreementKind::Boundary => {
            let (start, end) = (apart(|it| it.start_us), apart(|it| it.end_us));
            let values: [(&str, &dyn Display); 3] =
                [("value", &value(&it.a)), ("start", &start), ("end", &end)];
            say(words::ROW_BOUNDARY, &values)
        }
    }
}

fn about(it: &Disagreement, several: bool, language: Language) -> String {
    let [start, end] = [it.start_us, it.end_us].map(|at| time_text(Instant::from_micros(at)));
    let mut parts = vec![format!("{start} – {end}")];
    if several {
        parts.push(it.recording.clone());
    }
    if it.kind == DisagreementKind::Value && !it.differs.is_empty() {
        let features = it.differs.join(", ");
        parts.push(fill(
            words::DIFFERS.of(language),
            &[("features", &features)],
        ));
    }
    parts.join(" · ")
}

/// Returns the span of a disagreement.
pub(super) fn span(it: &Disagreement) -> Span {
    let [start, end] = [it.start_us, it.end_us].map(Instant::from_micros);
    Span::between(start, end)
}

/// Returns the row to go to from the row `now`, `by` rows further; nothing at either end.
pub(super) fn step(now: Option<usize>, by: isize, count: usize) -> Option<usize> {
    match now {
        _ if count == 0 => None,
        None if by < 0 => Some(count - 1),
        None => Some(0),
        Some(now) => now.checked_add_signed(by).filter(|to| *to < count),
    }
}

/// Returns a measure as text: its value, or the reason why it has none.
pub(super) fn value(figure: &Figure, language: Language) -> String {
    match (figure.text(), &figure.why) {
        (Some(text), _) => text,
        (None, Some(why)) => {
            let why = spoken(why, language);
            fill(words::UNDEFINED.of(language), &[("why", &why)])
        }
        (None, None) => String::new(),
    }
}

/// Returns the interval of a measure, and what was drawn for it.
pub(super) fn interval(figure: &Figure, language: Language) -> Option<[String; 2]> {
    let it = figure.interval.as_ref()?;
    let of = chereme_corpus::words::numbered(2, it.of, language);
    let values: [(&str, &dyn Display); 2] = [("n", &it.draws), ("of", &of)];
    Some([
        format!("{:.3} … {:.3}", it.low, it.high),
        fill(words::DRAWS.of(language), &values),
    ])
}

/// Returns the name of one of the usual measures for people; other measures have the names of the command line.
pub(super) fn title(measure: &str) -> Option<Text> {
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
pub(super) fn meaning(measure: &str) -> Option<Text> {
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
        _ => return None,
    })
}

/// Returns a name for the third tier that is not in `taken`: the common part of both names, or both together.
pub(super) fn third_name([a, b]: &[String; 2], taken: &[&str]) -> String {
    let same = |it: &(char, char)| it.0 == it.1;
    let before: String = a
        .chars()
        .zip(b.chars())
        .take_while(same)
        .map(|it| it.0)
        .collect();
    let (rest_a, rest_b) = (&a[before.len()..], &b[before.len()..]);
    let after = rest_a.chars().rev().zip(rest_b.chars().rev());
    let after: usize = after.take_while(same).map(|it| it.0.len_utf8()).sum();
    let after = &rest_a[rest_a.len() - after..];
    let trimmed = |text: &str| {
        let blank = |it: char| it.is_whitespace() || "-_.:/+()".contains(it);
        text.trim_matches(blank).to_owned()
    };
    let parts = [trimmed(&before), trimmed(after)];
    let parts: Vec<&str> = parts
        .iter()
        .map(String::as_str)
        .filter(|it| !it.is_empty())
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
            assert_eq!(step(now, by, count), to, "{now:?} {by} {count}");
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
        for measure in MEASURES {
            assert!(meaning(measure).is_some(), "{measure}");
        }
        for measure in chereme_corpus::USUAL_MEASURES {
            assert!(title(measure).is_some(), "{measure}");
        }
    }

    #[test]
    fn an_undefined_measure_gives_its_reason() {
        let figure = |value, why: Option<&str>| Figure {
            value,
            why: why.map(str::to_owned),
            interval: None,
        };
        let said = |figure| value(&figure, Language::English);
        assert_eq!(said(figure(Some(-0.0001), None)), "0.000");
        assert_eq!(
            said(figure(None, Some("one value only"))),
            "– (one value only)"
        );
        let french = value(&figure(None, Some("one value only")), Language::French);
        assert_eq!(french, "– (une seule valeur)");
    }
}
