//! Finds expressions by function: annotations on function tiers, with milestones that were written or that follow from
//! the glosses.

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::milestones::{
    ExpressionFunction, ExpressionMilestones, ExpressionPhase, UTTERANCE_EDGE_MICROS, find_expression_milestones,
};
use chereme_sign::text::fold_text;
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{HandRef, TierRole};
use rusqlite::Connection;

use crate::address::CorpusAddress;
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// Names of function tiers, folded and without punctuation.
const FUNCTION_TIER_NAMES: [&str; 14] = [
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
pub(crate) const MILESTONE_TIER_PREFIX: &str = "milestones ";

/// An expression of the face in a recording.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FaceExpression {
    pub(crate) recording: i64,
    pub(crate) function: ExpressionFunction,
    /// The milestones on the recording's clock.
    pub(crate) milestones: ExpressionMilestones,
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
struct SignerSigns {
    signs: Vec<(TimeSpan, String)>,
    utterances: Vec<TimeSpan>,
}

fn is_function_tier(row: &TierRow, named: Option<&str>) -> bool {
    // Tiers are called `Clause type`, `clause_type` or `clauseType`; letters alone are compared.
    let plain: String = fold_text(&row.name)
        .chars()
        .filter(|letter| letter.is_alphanumeric())
        .collect();
    match named {
        Some(name) => row.name == name || fold_text(&row.name) == fold_text(name),
        None => FUNCTION_TIER_NAMES.contains(&&*plain),
    }
}

fn span_middle(span: TimeSpan) -> RecordingInstant {
    span.span_start_instant().shifted_instant(span.span_micros() / 2)
}

/// Returns the expressions of a recording in order of time, of one function or of all; `tier` is the name of the
/// function tier.
pub(crate) fn load_recording_expressions(
    connection: &Connection,
    recording: i64,
    function: Option<&ExpressionFunction>,
    tier: Option<&str>,
) -> CorpusResult<Vec<FaceExpression>> {
    let all = stored_tiers::load_tier_rows(connection, recording)?;
    // Milestones that stand on tiers take precedence over those derived from glosses.
    let mut written = load_written_expressions(connection, recording, &all, function)?;
    let mut expressions = Vec::new();
    for row in all.iter().filter(|row| is_function_tier(row, tier)) {
        let mut signing = None;
        for annotation in stored_tiers::load_tier_annotation_rows(connection, row.id)? {
            let annotation_function = ExpressionFunction::from_function_name(&annotation.value);
            let wanted = function.is_none_or(|function| *function == annotation_function);
            if !annotation.is_filled() || !wanted {
                continue;
            }
            let span = annotation.annotation_row_span();
            let same = |expression: &FaceExpression| {
                expression.function == annotation_function
                    && expression.milestones.expression_body_span().is_overlapping_span(span)
            };
            // Glosses are read once for each tier, and only if it has an expression that needs them.
            let signing = match &signing {
                Some(signing) => signing,
                None => signing.insert(SignerSigns::load_participant_signs(
                    connection,
                    &all,
                    row.participant.as_deref(),
                )?),
            };
            if let Some(at) = written.iter().position(same) {
                let stored = written.remove(at);
                expressions.push(FaceExpression {
                    annotation: annotation.id,
                    signs: signing.glosses_in_span(stored.milestones.expression_body_span()),
                    odd: stored.milestones.milestone_oddities(),
                    ..stored
                });
                continue;
            }
            expressions.push(signing.expression_over_annotation(recording, annotation_function, &annotation));
        }
    }
    // The others have milestones but no annotation of their function.
    expressions.extend(written);
    expressions.sort_by_key(|expression| (expression.milestones.m2, expression.annotation));
    Ok(expressions)
}

impl SignerSigns {
    /// Returns the signs on a participant's gloss tier with the most annotations; if there are several, that of the
    /// dominant hand.
    fn load_participant_signs(
        connection: &Connection,
        all: &[TierRow],
        participant: Option<&str>,
    ) -> CorpusResult<Self> {
        let mut best = ((false, false, 0), Vec::new());
        let mut utterances = Vec::new();
        for row in all {
            let rows = match row.role {
                TierRole::Gloss | TierRole::Translation => stored_tiers::load_tier_annotation_rows(connection, row.id)?,
                _ => continue,
            };
            let filled_rows = rows.iter().filter(|annotation| annotation.is_filled());
            if row.role == TierRole::Translation {
                utterances.extend(filled_rows.map(AnnotationRow::annotation_row_span));
                continue;
            }
            let mut signs: Vec<(TimeSpan, String)> = filled_rows
                .map(|annotation| (annotation.annotation_row_span(), annotation.value.trim().to_owned()))
                .collect();
            signs.sort_by_key(|(span, _)| (span.span_start_instant(), span.span_end_instant()));
            let same = participant.is_none() || row.participant.as_deref() == participant;
            let other_hand = matches!(row.hand, Some(AnnotatedHands::One(HandRef::Left | HandRef::Weak)));
            // The participant matters most, then the hand, and only then the number of signs.
            let rank = (same, !other_hand, signs.len());
            if best.1.is_empty() || rank > best.0 {
                best = (rank, signs);
            }
        }
        utterances.sort_by_key(|span| (span.span_start_instant(), span.span_end_instant()));
        Ok(Self {
            signs: best.1,
            utterances,
        })
    }

    fn glosses_in_span(&self, span: TimeSpan) -> Vec<String> {
        let inside = self
            .signs
            .iter()
            .filter(|(sign, _)| span.has_instant(span_middle(*sign)));
        inside.map(|(_, gloss)| gloss.clone()).collect()
    }

    /// Returns the expression over the signs whose middle lies in an annotation; without signs, over the
    /// annotation's own span.
    fn expression_over_annotation(
        &self,
        recording: i64,
        function: ExpressionFunction,
        of: &AnnotationRow,
    ) -> FaceExpression {
        let span = of.annotation_row_span();
        // The signs of a neighbouring sentence must not limit the milestones of this one.
        let utterance = self
            .utterances
            .iter()
            .find(|candidate| candidate.has_instant(span_middle(span)));
        let signs: Vec<&(TimeSpan, String)> = self
            .signs
            .iter()
            .filter(|(sign, _)| utterance.is_none_or(|own| own.has_instant(span_middle(*sign))))
            .collect();
        let inside = |(sign, _): &&(TimeSpan, String)| span.has_instant(span_middle(*sign));
        let first = signs.iter().position(inside);
        // The range ends after its last sign.
        let last = signs.iter().rposition(inside).map(|last| last + 1);
        let times: Vec<TimeSpan> = signs.iter().map(|(sign, _)| *sign).collect();
        let range = first.zip(last).map(|(first, last)| first..last);
        let sign_milestones = range
            .clone()
            .and_then(|of| find_expression_milestones(&times, of, &function, UTTERANCE_EDGE_MICROS));
        let mut odd = Vec::new();
        // Without glosses there is no transition to measure, so that onset and offset have a usual length.
        let marks = sign_milestones.unwrap_or_else(|| {
            odd.push("no gloss lies in it, so its own span stands for one sign".to_owned());
            ExpressionMilestones {
                m1: span.span_start_instant().shifted_instant(-UTTERANCE_EDGE_MICROS),
                m2: span.span_start_instant(),
                m3: None,
                m4: span.span_end_instant(),
                m5: span.span_end_instant().shifted_instant(UTTERANCE_EDGE_MICROS),
            }
        });
        odd.extend(marks.milestone_oddities());
        let glosses = range.map(|range| signs[range].iter().map(|(_, gloss)| gloss.clone()).collect());
        FaceExpression {
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
fn load_written_expressions(
    connection: &Connection,
    recording: i64,
    all: &[TierRow],
    function: Option<&ExpressionFunction>,
) -> CorpusResult<Vec<FaceExpression>> {
    let mut expressions = Vec::new();
    for row in all {
        let Some(own) = function_of_tier(&row.name) else {
            continue;
        };
        if function.is_some_and(|function| *function != own) {
            continue;
        }
        let mut phases: Vec<(ExpressionPhase, AnnotationRow)> = Vec::new();
        for annotation in stored_tiers::load_tier_annotation_rows(connection, row.id)? {
            let Some(phase) = phase_of(&annotation.value) else {
                continue;
            };
            let follows = phases
                .last()
                .is_some_and(|(last, before)| *last < phase && annotation.start_us - before.end_us < 2_000);
            if !follows && !phases.is_empty() {
                expressions.extend(join_milestone_phases(recording, &own, &phases));
                phases.clear();
            }
            phases.push((phase, annotation));
        }
        expressions.extend(join_milestone_phases(recording, &own, &phases));
    }
    Ok(expressions)
}

/// Returns the function of a tier of milestones, such as `milestones wh` or `milestones wh 2`.
fn function_of_tier(name: &str) -> Option<ExpressionFunction> {
    let rest = name.strip_prefix(MILESTONE_TIER_PREFIX)?.trim();
    let bare = rest.trim_end_matches(|letter: char| letter.is_ascii_digit()).trim_end();
    // A function whose name has only digits keeps them, as they cannot be a number behind a name.
    let name = if bare.is_empty() { rest } else { bare };
    (!name.is_empty()).then(|| ExpressionFunction::from_function_name(name))
}

fn phase_of(value: &str) -> Option<ExpressionPhase> {
    let first = value.split_whitespace().next()?;
    // A body that consists of one phase.
    if first == "M2-M4" {
        return Some(ExpressionPhase::Rest);
    }
    ExpressionPhase::ALL_EXPRESSION_PHASES
        .into_iter()
        .find(|phase| phase.milestone_range_name() == first)
}

/// Returns the end outside of the recording that a value states, as in `M1-M2 from -0.300s`.
fn parse_outside_end(value: &str, word: &str) -> Option<RecordingInstant> {
    let mut words = value.split_whitespace().skip_while(|part| *part != word).skip(1);
    let seconds: f64 = words.next()?.strip_suffix('s')?.parse().ok()?;
    Some(RecordingInstant::from_seconds(seconds))
}

fn join_milestone_phases(
    recording: i64,
    function: &ExpressionFunction,
    phases: &[(ExpressionPhase, AnnotationRow)],
) -> Option<FaceExpression> {
    let (first, last) = (phases.first()?, phases.last()?);
    let mut times: [Option<RecordingInstant>; 5] = [None; 5];
    for (phase, row) in phases {
        let phase_index = ExpressionPhase::ALL_EXPRESSION_PHASES
            .iter()
            .position(|candidate| candidate == phase)?;
        let span = row.annotation_row_span();
        // An undivided body reaches from M2 to M4 without M3, whose place stays empty.
        let one = row.value.starts_with("M2-M4");
        times[if one { 1 } else { phase_index }] = Some(span.span_start_instant());
        times[phase_index + 1] = Some(span.span_end_instant());
    }
    let is_undivided = times[2].is_none();
    // Phases cut off by the recording's ends are missing: their milestones fall together with a neighbour's.
    for at in 1..5 {
        times[at] = times[at].or(times[at - 1]);
    }
    for at in (0..4).rev() {
        times[at] = times[at].or(times[at + 1]);
    }
    let [m1, m2, m3, m4, m5] = times.map(|at| at.unwrap_or(first.1.annotation_row_span().span_start_instant()));
    let m2 = if is_undivided && phases.len() == 1 {
        first.1.annotation_row_span().span_start_instant()
    } else {
        m2
    };
    Some(FaceExpression {
        recording,
        function: function.clone(),
        milestones: ExpressionMilestones {
            m1: parse_outside_end(&first.1.value, "from").unwrap_or(m1),
            m2,
            m3: (!is_undivided && m3 != m2).then_some(m3),
            m4,
            m5: parse_outside_end(&last.1.value, "to").unwrap_or(m5),
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
pub(crate) fn find_expression_at(
    connection: &Connection,
    address: &CorpusAddress,
    function: Option<&ExpressionFunction>,
) -> CorpusResult<FaceExpression> {
    let recording = crate::address::find_addressed_recording(connection, address)?;
    let mut all = load_recording_expressions(connection, recording, function, None)?;
    match address {
        CorpusAddress::Annotation(id) => {
            all.retain(|expression| expression.annotation == *id || expression.stored.contains(id));
        }
        CorpusAddress::Recording(_) => {}
        other => {
            let stretch = crate::address::find_addressed_stretch(connection, other)?;
            // A span or tier names no single sign, so that it does not choose among the expressions.
            if stretch.token.is_some() {
                all.retain(|expression| {
                    expression
                        .milestones
                        .expression_body_span()
                        .is_overlapping_span(stretch.span)
                });
            }
        }
    }
    let of = function.map_or(String::new(), |function| format!(" of {function}"));
    match all.len() {
        1 => Ok(all.remove(0)),
        0 => Err(CorpusError::from_wrong_message(format!("{address} has no expression{of}"))
            .with_error_place(address.to_string())
            .with_advice(
                "annotate its function (wh, yn, negation, topic …) on a tier called \"function\" over its signs, or write \
                 its phases on a tier such as \"milestones wh\"",
            )),
        count => {
            let names: Vec<String> = all
                .iter()
                .take(8)
                .map(|expression| format!("annotation:{} ({} at {})", expression.annotation, expression.function, expression.milestones.m2))
                .collect();
            Err(CorpusError::from_wrong_message(format!("{address} has {count} expressions{of}: {}", names.join(", ")))
                .with_error_place(address.to_string())
                .with_advice("name one of them"))
        }
    }
}

/// Returns an expression with the milestones that follow from the glosses, ignoring tiers of milestones.
pub(crate) fn derive_expression_milestones(
    connection: &Connection,
    it: &FaceExpression,
) -> CorpusResult<FaceExpression> {
    let annotation = stored_tiers::load_annotation_row(connection, it.annotation)?;
    let tier = stored_tiers::load_tier_row(connection, annotation.tier_id)?;
    let all = stored_tiers::load_tier_rows(connection, it.recording)?;
    let signing = SignerSigns::load_participant_signs(connection, &all, tier.participant.as_deref())?;
    let fresh = signing.expression_over_annotation(it.recording, it.function.clone(), &annotation);
    Ok(FaceExpression {
        stored: it.stored.clone(),
        ..fresh
    })
}

/// Returns the expression that a function would have if it spanned all signs of a recording; `None` if it has no
/// glosses.
pub(crate) fn over_all(
    connection: &Connection,
    recording: i64,
    function: &ExpressionFunction,
) -> CorpusResult<Option<FaceExpression>> {
    let all = stored_tiers::load_tier_rows(connection, recording)?;
    let signing = SignerSigns::load_participant_signs(connection, &all, None)?;
    let times: Vec<TimeSpan> = signing.signs.iter().map(|(span, _)| *span).collect();
    let recording_milestones = find_expression_milestones(&times, 0..times.len(), function, UTTERANCE_EDGE_MICROS);
    Ok(recording_milestones.map(|marks| FaceExpression {
        recording,
        function: function.clone(),
        milestones: marks,
        annotation: 0,
        signs: signing.signs.into_iter().map(|(_, gloss)| gloss).collect(),
        stored: Vec::new(),
        corrected: false,
        odd: marks.milestone_oddities(),
    }))
}
