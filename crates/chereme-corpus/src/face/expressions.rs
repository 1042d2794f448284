//! Finds expressions by function: annotations on function tiers, with milestones that were written or that follow from
//! the glosses.

use chereme_motion::{Instant, Span};
use chereme_sign::milestones::{EDGE, Function, Milestones, Phase, milestones};
use chereme_sign::text::fold;
use chereme_sign::tier::Hands;
use chereme_sign::{HandRef, TierRole};
use rusqlite::Connection;

use crate::address::Address;
use crate::db::columns::AnnotationOrigin;
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, Result};

/// Names of function tiers, folded and without punctuation.
const NAMES: [&str; 14] = [
    "function",
    "functions",
    "grammaticalfunction",
    "nonmanualfunction",
    "construction",
    "constructions",
    "clausetype",
    "sentencetype",
    "fonction",
    "fonctions",
    "typedephrase",
    "typedeproposition",
    "satztyp",
    "zinstype",
];
/// The prefix of the name of a tier of milestones; the function follows.
pub(crate) const TIER: &str = "milestones ";

/// An expression of the face in a recording.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Expression {
    pub(crate) recording: i64,
    pub(crate) function: Function,
    /// The milestones on the recording's clock.
    pub(crate) milestones: Milestones,
    /// The annotation of its function, or of its first phase if no tier names a function.
    pub(crate) annotation: i64,
    /// The glosses that it spans.
    pub(crate) signs: Vec<String>,
    /// The annotations of its phases; empty if its milestones follow from the glosses.
    pub(crate) stored: Vec<i64>,
    /// Whether a person wrote or corrected its milestones.
    pub(crate) corrected: bool,
    /// Findings about the expression.
    pub(crate) odd: Vec<String>,
}

/// The signs of one signer in order of time, and the utterances that contain them.
struct Signing {
    signs: Vec<(Span, String)>,
    utterances: Vec<Span>,
}

fn is_function_tier(row: &TierRow, named: Option<&str>) -> bool {
    let plain: String = fold(&row.name)
        .chars()
        .filter(|it| it.is_alphanumeric())
        .collect();
    match named {
        Some(name) => row.name == name || fold(&row.name) == fold(name),
        None => NAMES.contains(&&*plain),
    }
}

fn span_of(row: &AnnotationRow) -> Span {
    Span::between(
        Instant::from_micros(row.start_us),
        Instant::from_micros(row.end_us),
    )
}

fn middle(span: Span) -> Instant {
    span.start().shifted(span.micros() / 2)
}

/// Returns the expressions of a recording in order of time, of one function or of all; `tier` is the name of the
/// function tier.
pub(crate) fn of_recording(
    connection: &Connection,
    recording: i64,
    function: Option<&Function>,
    tier: Option<&str>,
) -> Result<Vec<Expression>> {
    let all = tiers::tiers(connection, recording)?;
    let mut written = written(connection, recording, &all, function)?;
    let mut found = Vec::new();
    for row in all.iter().filter(|row| is_function_tier(row, tier)) {
        let mut signing = None;
        for annotation in tiers::annotations(connection, row.id)? {
            let own = Function::of(&annotation.value);
            let wanted = function.is_none_or(|function| *function == own);
            if !annotation.is_filled() || !wanted {
                continue;
            }
            let span = span_of(&annotation);
            let same = |it: &Expression| it.function == own && it.milestones.body().overlaps(span);
            let signing = match &signing {
                Some(signing) => signing,
                None => signing.insert(Signing::of(connection, &all, row.participant.as_deref())?),
            };
            if let Some(at) = written.iter().position(same) {
                let stored = written.remove(at);
                found.push(Expression {
                    annotation: annotation.id,
                    signs: signing.glosses(stored.milestones.body()),
                    odd: stored.milestones.oddities(),
                    ..stored
                });
                continue;
            }
            found.push(signing.expression(recording, own, &annotation));
        }
    }
    found.extend(written);
    found.sort_by_key(|it| (it.milestones.m2, it.annotation));
    Ok(found)
}

impl Signing {
    /// Returns the signs on a participant's gloss tier with the most annotations; if there are several, that of the
    /// dominant hand.
    fn of(connection: &Connection, all: &[TierRow], participant: Option<&str>) -> Result<Self> {
        let mut best = ((false, false, 0), Vec::new());
        let mut utterances = Vec::new();
        for row in all {
            let rows = match row.role {
                TierRole::Gloss | TierRole::Translation => tiers::annotations(connection, row.id)?,
                _ => continue,
            };
            let said = rows.iter().filter(|it| it.is_filled());
            if row.role == TierRole::Translation {
                utterances.extend(said.map(span_of));
                continue;
            }
            let mut signs: Vec<(Span, String)> = said
                .map(|it| (span_of(it), it.value.trim().to_owned()))
                .collect();
            signs.sort_by_key(|(span, _)| (span.start(), span.end()));
            let same = participant.is_none() || row.participant.as_deref() == participant;
            let other_hand = matches!(row.hand, Some(Hands::One(HandRef::Left | HandRef::Weak)));
            let rank = (same, !other_hand, signs.len());
            if best.1.is_empty() || rank > best.0 {
                best = (rank, signs);
            }
        }
        utterances.sort_by_key(|span| (span.start(), span.end()));
        Ok(Self {
            signs: best.1,
            utterances,
        })
    }

    fn glosses(&self, span: Span) -> Vec<String> {
        let inside = self
            .signs
            .iter()
            .filter(|(sign, _)| span.contains(middle(*sign)));
        inside.map(|(_, gloss)| gloss.clone()).collect()
    }

    /// Returns the expression over the signs whose middle lies in an annotation; without signs, over the
    /// annotation's own span.
    fn expression(&self, recording: i64, function: Function, of: &AnnotationRow) -> Expression {
        let span = span_of(of);
        let own = self.utterances.iter().find(|it| it.contains(middle(span)));
        let signs: Vec<&(Span, String)> = self
            .signs
            .iter()
            .filter(|(sign, _)| own.is_none_or(|own| own.contains(middle(*sign))))
            .collect();
        let inside = |(sign, _): &&(Span, String)| span.contains(middle(*sign));
        let first = signs.iter().position(inside);
        let last = signs.iter().rposition(inside).map(|last| last + 1);
        let times: Vec<Span> = signs.iter().map(|(sign, _)| *sign).collect();
        let range = first.zip(last).map(|(first, last)| first..last);
        let found = range
            .clone()
            .and_then(|of| milestones(&times, of, &function, EDGE));
        let mut odd = Vec::new();
        let marks = found.unwrap_or_else(|| {
            odd.push("no gloss lies in it, so its own span stands for one sign".to_owned());
            Milestones {
                m1: span.start().shifted(-EDGE),
                m2: span.start(),
                m3: None,
                m4: span.end(),
                m5: span.end().shifted(EDGE),
            }
        });
        odd.extend(marks.oddities());
        let glosses = range.map(|range| {
            signs[range]
                .iter()
                .map(|(_, gloss)| gloss.clone())
                .collect()
        });
        Expression {
            recording,
            function,
            milestones: marks,
            annotation: of.id,
            signs: glosses.unwrap_or_default(),
            stored: Vec::new(),
            corrected: false,
            odd,
        }
    }
}

/// Returns the expressions with milestones written on tiers, phase by phase.
fn written(
    connection: &Connection,
    recording: i64,
    all: &[TierRow],
    function: Option<&Function>,
) -> Result<Vec<Expression>> {
    let mut found = Vec::new();
    for row in all {
        let Some(own) = function_of_tier(&row.name) else {
            continue;
        };
        if function.is_some_and(|function| *function != own) {
            continue;
        }
        let mut phases: Vec<(Phase, AnnotationRow)> = Vec::new();
        for annotation in tiers::annotations(connection, row.id)? {
            let Some(phase) = phase_of(&annotation.value) else {
                continue;
            };
            let follows = phases.last().is_some_and(|(last, before)| {
                *last < phase && annotation.start_us - before.end_us < 2_000
            });
            if !follows && !phases.is_empty() {
                found.extend(joined(recording, &own, &phases));
                phases.clear();
            }
            phases.push((phase, annotation));
        }
        found.extend(joined(recording, &own, &phases));
    }
    Ok(found)
}

/// Returns the function of a tier of milestones, such as `milestones wh` or `milestones wh 2`.
fn function_of_tier(name: &str) -> Option<Function> {
    let rest = name.strip_prefix(TIER)?.trim();
    let bare = rest
        .trim_end_matches(|it: char| it.is_ascii_digit())
        .trim_end();
    let name = if bare.is_empty() { rest } else { bare };
    (!name.is_empty()).then(|| Function::of(name))
}

fn phase_of(value: &str) -> Option<Phase> {
    let first = value.split_whitespace().next()?;
    // A body that consists of one phase.
    if first == "M2-M4" {
        return Some(Phase::Rest);
    }
    Phase::ALL
        .into_iter()
        .find(|phase| phase.between() == first)
}

/// Returns the end outside of the recording that a value states, as in `M1-M2 from -0.300s`.
fn outside(value: &str, word: &str) -> Option<Instant> {
    let mut words = value
        .split_whitespace()
        .skip_while(|it| *it != word)
        .skip(1);
    let seconds: f64 = words.next()?.strip_suffix('s')?.parse().ok()?;
    Some(Instant::from_seconds(seconds))
}

fn joined(
    recording: i64,
    function: &Function,
    phases: &[(Phase, AnnotationRow)],
) -> Option<Expression> {
    let (first, last) = (phases.first()?, phases.last()?);
    let mut times: [Option<Instant>; 5] = [None; 5];
    for (phase, row) in phases {
        let at = Phase::ALL.iter().position(|it| it == phase)?;
        let span = span_of(row);
        let one = row.value.starts_with("M2-M4");
        times[if one { 1 } else { at }] = Some(span.start());
        times[at + 1] = Some(span.end());
    }
    let whole = times[2].is_none();
    for at in 1..5 {
        times[at] = times[at].or(times[at - 1]);
    }
    for at in (0..4).rev() {
        times[at] = times[at].or(times[at + 1]);
    }
    let [m1, m2, m3, m4, m5] = times.map(|at| at.unwrap_or(span_of(&first.1).start()));
    let m2 = if whole && phases.len() == 1 {
        span_of(&first.1).start()
    } else {
        m2
    };
    Some(Expression {
        recording,
        function: function.clone(),
        milestones: Milestones {
            m1: outside(&first.1.value, "from").unwrap_or(m1),
            m2,
            m3: (!whole && m3 != m2).then_some(m3),
            m4,
            m5: outside(&last.1.value, "to").unwrap_or(m5),
        },
        annotation: first.1.id,
        signs: Vec::new(),
        stored: phases.iter().map(|(_, row)| row.id).collect(),
        corrected: phases
            .iter()
            .any(|(_, row)| matches!(row.origin, AnnotationOrigin::Human | AnnotationOrigin::File)),
        odd: Vec::new(),
    })
}

/// Returns the single expression at an address: that of a recording with only one, that of an annotation of a function
/// or phase, or the one over a token.
pub(crate) fn at(
    connection: &Connection,
    address: &Address,
    function: Option<&Function>,
) -> Result<Expression> {
    let recording = super::recording_of(connection, address)?;
    let mut all = of_recording(connection, recording, function, None)?;
    match address {
        Address::Annotation(id) => {
            all.retain(|it| it.annotation == *id || it.stored.contains(id));
        }
        Address::Recording(_) => {}
        other => {
            let stretch = crate::address::stretch(connection, other)?;
            if stretch.token.is_some() {
                all.retain(|it| it.milestones.body().overlaps(stretch.span));
            }
        }
    }
    let of = function.map_or(String::new(), |function| format!(" of {function}"));
    match all.len() {
        1 => Ok(all.remove(0)),
        0 => Err(Error::wrong(format!("{address} has no expression{of}"))
            .at(address.to_string())
            .advise(
                "annotate its function (wh, yn, negation, topic …) on a tier called \"function\" over its signs, or write \
                 its phases on a tier such as \"milestones wh\"",
            )),
        count => {
            let names: Vec<String> = all
                .iter()
                .take(8)
                .map(|it| format!("annotation:{} ({} at {})", it.annotation, it.function, it.milestones.m2))
                .collect();
            Err(Error::wrong(format!("{address} has {count} expressions{of}: {}", names.join(", ")))
                .at(address.to_string())
                .advise("name one of them"))
        }
    }
}

/// Returns an expression with the milestones that follow from the glosses, ignoring tiers of milestones.
pub(crate) fn derived(connection: &Connection, it: &Expression) -> Result<Expression> {
    let annotation = tiers::annotation(connection, it.annotation)?;
    let tier = tiers::tier(connection, annotation.tier_id)?;
    let all = tiers::tiers(connection, it.recording)?;
    let signing = Signing::of(connection, &all, tier.participant.as_deref())?;
    let fresh = signing.expression(it.recording, it.function.clone(), &annotation);
    Ok(Expression {
        stored: it.stored.clone(),
        ..fresh
    })
}

/// Returns the expression that a function would have if it spanned all signs of a recording; `None` if it has no
/// glosses.
pub(crate) fn over_all(
    connection: &Connection,
    recording: i64,
    function: &Function,
) -> Result<Option<Expression>> {
    let all = tiers::tiers(connection, recording)?;
    let signing = Signing::of(connection, &all, None)?;
    let times: Vec<Span> = signing.signs.iter().map(|(span, _)| *span).collect();
    let found = milestones(&times, 0..times.len(), function, EDGE);
    Ok(found.map(|marks| Expression {
        recording,
        function: function.clone(),
        milestones: marks,
        annotation: 0,
        signs: signing.signs.into_iter().map(|(_, gloss)| gloss).collect(),
        stored: Vec::new(),
        corrected: false,
        odd: marks.oddities(),
    }))
}
