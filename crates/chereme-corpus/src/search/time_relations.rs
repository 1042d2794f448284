//! Temporal relations between a token and other annotations of its recording.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::query::{QueryTest, TestSubject, TextField, TextPattern, ValueComparison};
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentReading, TierRole, TimeRelation};

use super::compile::{self, QueryContext, QueryResult};
use super::docs::{DocumentList, DocumentTimes};
use super::probe::{IndexDocument, NumberColumn, RowField};
use super::search_component::ComponentTest;
use super::search_finding::FindingKind;
use super::search_findings;
use super::search_plan::{self, QueryPlan};
use super::{search_texts, text_match};
use crate::db::stored_search::search_answers::{self, CodedRow, RecordingReadings};
use crate::db::stored_search::search_terms::{self, hand_codes, hands_of, phase_code, phase_counts};
use crate::error::CorpusResult;

/// A relation to another annotation.
///
/// The other annotation may be on any tier that has the component, text or name, even if it belongs to the token
/// itself; a relation to a gloss is one to another token.
pub(crate) struct NeighbourRelation {
    /// The relation; nothing for a condition on annotations of a tier that overlap the token, where a missing
    /// annotation counts as unset.
    relation: Option<TimeRelation>,
    other: Vec<RelatedAnnotationTest>,
    /// Whether the token itself may be the overlapping other.
    itself: bool,
}

enum RelatedAnnotationTest {
    /// Another token whose gloss passes.
    Gloss(QueryPlan),
    Component(Box<ComponentTest>),
    /// An annotation of tiers with this role.
    Role(TierRole, QueryTest),
    /// An annotation on tiers whose name matches.
    Tier(TextPattern, ValueComparison),
}

impl NeighbourRelation {
    /// Prepares a relation to annotations that pass a test; without a relation it must be a test on a tier.
    pub(crate) fn new(ask: &QueryContext<'_>, relation: Option<TimeRelation>, test: &QueryTest) -> QueryResult<Self> {
        let other = match &test.what {
            TestSubject::Component(field, comparison) => {
                let range = test.subject_at.char_range();
                let test = ComponentTest::new(ask, field, comparison, range)?;
                vec![RelatedAnnotationTest::Component(Box::new(test))]
            }
            TestSubject::Tier(name, comparison) => {
                check_tier(ask, name, test)?;
                vec![RelatedAnnotationTest::Tier(name.clone(), comparison.clone())]
            }
            TestSubject::Whole(field, _) | TestSubject::Words(field, _) | TestSubject::Fuzzy { field, .. } => {
                texts_beside(ask, test, *field)?
            }
            TestSubject::Said(..)
            | TestSubject::Property(..)
            | TestSubject::Time(..)
            | TestSubject::Attribute(..)
            | TestSubject::Curve(..)
            | TestSubject::Notation(..) => Vec::new(),
        };
        Ok(Self {
            relation,
            other,
            itself: false,
        })
    }

    /// Returns the relation with the token itself accepted as an overlapping other.
    pub(crate) fn or_itself(self) -> Self {
        Self {
            itself: self.relation == Some(TimeRelation::Overlaps),
            ..self
        }
    }

    /// Returns the candidates for which the relation holds.
    pub(crate) fn filter_related_candidates(
        &self,
        ask: &QueryContext<'_>,
        candidates: DocumentList,
    ) -> QueryResult<DocumentList> {
        let times = DocumentTimes::open_document_times(ask.now)?;
        let ids = ask.now.open_row_column(RowField::Token)?;
        // Annotations are read once for each recording, not once for each token.
        let mut by_recording: BTreeMap<i64, Vec<RelationCandidate>> = BTreeMap::new();
        let mut passing = DocumentList::new();
        for doc in candidates {
            match times.document_times(doc) {
                Some((recording, start, end)) => {
                    let (token, span) = (
                        ids.document_number(doc).unwrap_or_default(),
                        TimeSpan::from_span_micros(start, end),
                    );
                    let candidates = by_recording.entry(recording).or_default();
                    candidates.push(RelationCandidate { doc, token, span });
                }
                None if self.passes_alone() => passing.push(doc),
                None => {}
            }
        }
        let recordings = by_recording.keys().copied().collect();
        let mut glosses = self.related_gloss_spans(ask, &recordings, &times, &*ids)?;
        for (recording, candidates) in by_recording {
            let mut marks = glosses.remove(&recording).unwrap_or_default();
            self.collect_related_spans(ask, recording, &mut marks)?;
            let marks = RelatedSpans::new(marks);
            for one in candidates {
                ask.count_examined_row()?;
                if self.holds_for_candidate(&one, &marks) {
                    passing.push(one.doc);
                }
            }
        }
        passing.sort_unstable();
        Ok(passing)
    }

    fn holds_for_candidate(&self, candidate: &RelationCandidate, marks: &RelatedSpans) -> bool {
        match self.relation {
            Some(relation) => marks.any_span_related(relation, candidate, |mark| mark.passes),
            None => {
                marks.any_span_related(TimeRelation::Overlaps, candidate, |mark| mark.passes)
                    || self.passes_alone() && !marks.any_span_related(TimeRelation::Overlaps, candidate, |_| true)
            }
        }
    }

    /// Returns whether a token passes if no annotation of the tier overlaps it.
    fn passes_alone(&self) -> bool {
        self.relation.is_none()
            && self.other.iter().any(|other| match other {
                RelatedAnnotationTest::Tier(_, comparison) => {
                    comparison.comparison_accepts_reading(&ComponentReading::Unset, |_, _| false)
                }
                _ => false,
            })
    }

    /// Returns the tokens whose gloss passes, by recording.
    fn related_gloss_spans(
        &self,
        ask: &QueryContext<'_>,
        recordings: &BTreeSet<i64>,
        times: &DocumentTimes,
        ids: &dyn NumberColumn,
    ) -> QueryResult<BTreeMap<i64, Vec<RelatedSpan>>> {
        let mut marks: BTreeMap<i64, Vec<RelatedSpan>> = BTreeMap::new();
        for other in &self.other {
            let RelatedAnnotationTest::Gloss(plan) = other else {
                continue;
            };
            for doc in search_plan::evaluate_query_plan(ask, plan, None)? {
                let Some((recording, start, end)) = times.document_times(doc) else {
                    continue;
                };
                if recordings.contains(&recording) {
                    marks.entry(recording).or_default().push(RelatedSpan {
                        span: TimeSpan::from_span_micros(start, end),
                        // A token is no neighbour of itself, unless the relation is to a stretch of its
                        // curve.
                        token: ids.document_number(doc).filter(|_| !self.itself),
                        passes: true,
                    });
                }
            }
        }
        Ok(marks)
    }

    /// Adds the annotations of a recording to which the relation may hold.
    fn collect_related_spans(
        &self,
        ask: &QueryContext<'_>,
        recording: i64,
        marks: &mut Vec<RelatedSpan>,
    ) -> CorpusResult<()> {
        ask.go_on()?;
        let mut add = |row: &CodedRow<'_>, passes: bool| {
            let wanted = passes || self.relation.is_none();
            if let Some((start, end)) = row.span.filter(|_| wanted) {
                marks.push(RelatedSpan {
                    span: TimeSpan::from_span_micros(start, end),
                    token: None,
                    passes,
                });
            }
        };
        for other in &self.other {
            match other {
                RelatedAnnotationTest::Gloss(_) => {}
                RelatedAnnotationTest::Component(test) => {
                    let left_handed = search_answers::left_handed(ask.connection, recording)?;
                    let asked = RecordingReadings {
                        component: test.field.component.component_name(),
                        phases: test.field.phase.is_some(),
                        opinions: ask.opinions.get(),
                    };
                    search_answers::coded_in_recording(ask.connection, recording, asked, |row| {
                        add(&row, component_passes(test, &row, left_handed));
                    })?;
                }
                RelatedAnnotationTest::Role(wanted, test) => {
                    for (tier, _, role) in search_answers::list_recording_tier_roles(ask.connection, recording)? {
                        if role == *wanted {
                            search_answers::on_tier(ask.connection, tier, |row| {
                                add(&row, text_passes(test, &row));
                            })?;
                        }
                    }
                }
                RelatedAnnotationTest::Tier(pattern, comparison) => {
                    for (tier, name, _) in search_answers::list_recording_tier_roles(ask.connection, recording)? {
                        if pattern.matches_text(&name) {
                            search_answers::on_tier(ask.connection, tier, |row| {
                                add(&row, text_match::text_passes(comparison, &reading_of(&row)));
                            })?;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

/// Reports that no tier of the corpus has such a name.
fn check_tier(ask: &QueryContext<'_>, name: &TextPattern, test: &QueryTest) -> QueryResult<()> {
    let names = search_answers::tier_names(ask.connection)?;
    if names.iter().any(|tier_name| name.matches_text(tier_name)) {
        return Ok(());
    }
    let near = search_findings::similar_names(&name.pattern_segments().concat(), &names);
    let kind = FindingKind::CannotMatch {
        why: "no tier has this name".to_owned(),
        names: if near.is_empty() { names } else { near },
    };
    ask.add_query_finding(test.to_string(), test.at, kind);
    Ok(())
}

fn texts_beside(ask: &QueryContext<'_>, test: &QueryTest, field: TextField) -> QueryResult<Vec<RelatedAnnotationTest>> {
    let mut other = Vec::new();
    if matches!(field, TextField::Any | TextField::Gloss) {
        // Words in any text are sought on tiers of each kind; here the gloss takes its share.
        let mut field_test = test.clone();
        match &mut field_test.what {
            TestSubject::Whole(field, _) | TestSubject::Words(field, _) | TestSubject::Fuzzy { field, .. } => {
                *field = TextField::Gloss;
            }
            _ => {}
        }
        other.push(RelatedAnnotationTest::Gloss(compile::plan_comparison(
            ask,
            &field_test,
        )?));
    }
    let roles = [
        (TextField::Translation, TierRole::Translation),
        (TextField::Comment, TierRole::Comment),
    ];
    for (own, role) in roles {
        if field == TextField::Any || field == own {
            other.push(RelatedAnnotationTest::Role(role, test.clone()));
        }
    }
    Ok(other)
}

fn reading_of(row: &CodedRow<'_>) -> ComponentReading {
    match search_terms::reading_from_state(row.state, row.value.map(str::trim)) {
        ComponentReading::Value(value) if value.is_empty() => ComponentReading::Unset,
        reading => reading,
    }
}

fn component_passes(test: &ComponentTest, row: &CodedRow<'_>, left_handed: bool) -> bool {
    let hands = hands_of(test.field.hand);
    let row_hands = hand_codes(row.hand, left_handed);
    let phase = phase_code(row.phase);
    if !row_hands.iter().any(|hand| hands.contains(hand)) || !phase_counts(test.field.phase, &phase) {
        return false;
    }
    let reading = reading_of(row);
    let folded = reading.reading_value().map_or(String::new(), fold_text);
    test.accepts_reading(row.part, &reading, &folded)
}

fn text_passes(test: &QueryTest, row: &CodedRow<'_>) -> bool {
    let reading = reading_of(row);
    match &test.what {
        TestSubject::Whole(_, comparison) => text_match::text_passes(comparison, &reading),
        what => reading
            .reading_value()
            .is_some_and(|text| search_texts::passes_word_test(what, text)),
    }
}

struct RelationCandidate {
    doc: IndexDocument,
    token: i64,
    span: TimeSpan,
}

struct RelatedSpan {
    span: TimeSpan,
    /// The token, if the annotation is that of one.
    token: Option<i64>,
    passes: bool,
}

/// Annotations ordered by start, each with the latest end up to it, for a fast search around a span.
struct RelatedSpans {
    marks: Vec<RelatedSpan>,
    latest: Vec<RecordingInstant>,
}

impl RelatedSpans {
    fn new(mut marks: Vec<RelatedSpan>) -> Self {
        marks.sort_by_key(|mark| mark.span.span_start_instant());
        let mut latest = Vec::with_capacity(marks.len());
        for mark in &marks {
            let before = latest.last().copied().unwrap_or(mark.span.span_end_instant());
            latest.push(before.max(mark.span.span_end_instant()));
        }
        Self { marks, latest }
    }

    /// Returns whether the relation holds between the candidate and one of the wanted annotations.
    fn any_span_related(
        &self,
        relation: TimeRelation,
        candidate: &RelationCandidate,
        wanted: impl Fn(&RelatedSpan) -> bool,
    ) -> bool {
        let holds = |mark: &RelatedSpan| {
            wanted(mark) && mark.token != Some(candidate.token) && relation.relation_holds(candidate.span, mark.span)
        };
        let reach = match relation {
            TimeRelation::Before | TimeRelation::After | TimeRelation::NotInside | TimeRelation::NotOverlaps => {
                // Such neighbours may lie anywhere in the recording.
                return self.marks.iter().any(holds);
            }
            TimeRelation::Around(reach) | TimeRelation::OfBegin(reach) | TimeRelation::OfEnd(reach) => reach.max(0),
            _ => 0,
        };
        let (from, to) = (
            candidate.span.span_start_instant().shifted_instant(-reach),
            candidate.span.span_end_instant().shifted_instant(reach),
        );
        let until = self.marks.partition_point(|mark| mark.span.span_start_instant() <= to);
        let earlier_marks = self.marks[..until].iter().zip(&self.latest).rev();
        // Before the first place where no earlier annotation reaches the span, none can touch it.
        let mut near = earlier_marks.take_while(|(_, latest)| **latest >= from);
        near.any(|(mark, _)| holds(mark))
    }
}
