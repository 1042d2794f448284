//! Temporal relations between a token and other annotations of its recording.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{Instant, Span};
use chereme_sign::query::{Comparison, Pattern, Test, TextField, What};
use chereme_sign::text::fold;
use chereme_sign::{Reading, Relation, TierRole};

use super::compile::{self, Ask, Asked};
use super::component::ComponentTest;
use super::docs::{Docs, Times};
use super::finding::FindingKind;
use super::findings;
use super::plan::{self, Plan};
use super::probe::{Column, Doc, RowField};
use super::{text_match, texts};
use crate::db::search::answers::{self, CodedRow};
use crate::db::search::terms::{self, hand_codes, hands_of, phase_code, phase_counts};
use crate::error::Result;

/// A relation to another annotation.
///
/// The other annotation may be on any tier that has the component, text or name, even if it belongs to the token
/// itself; a relation to a gloss is one to another token.
pub(crate) struct Beside {
    /// The relation; nothing for a condition on annotations of a tier that overlap the token, where a missing
    /// annotation counts as unset.
    relation: Option<Relation>,
    other: Vec<Other>,
    /// Whether the token itself may be the overlapping other.
    itself: bool,
}

enum Other {
    /// Another token whose gloss passes.
    Gloss(Plan),
    Component(Box<ComponentTest>),
    /// An annotation of tiers with this role.
    Role(TierRole, Test),
    /// An annotation on tiers whose name matches.
    Tier(Pattern, Comparison),
}

impl Beside {
    /// Prepares a relation to annotations that pass a test; without a relation it must be a test on a tier.
    pub(crate) fn new(ask: &Ask<'_>, relation: Option<Relation>, test: &Test) -> Asked<Self> {
        let other = match &test.what {
            What::Component(field, comparison) => {
                let range = test.subject_at.range();
                let test = ComponentTest::new(ask, field, comparison, range)?;
                vec![Other::Component(Box::new(test))]
            }
            What::Tier(name, comparison) => {
                check_tier(ask, name, test)?;
                vec![Other::Tier(name.clone(), comparison.clone())]
            }
            What::Whole(field, _) | What::Words(field, _) | What::Fuzzy { field, .. } => {
                texts_beside(ask, test, *field)?
            }
            What::Property(..) | What::Time(..) | What::Attribute(..) | What::Curve(..) => {
                Vec::new()
            }
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
            itself: self.relation == Some(Relation::Overlaps),
            ..self
        }
    }

    /// Returns the candidates for which the relation holds.
    pub(crate) fn filter(&self, ask: &Ask<'_>, candidates: Docs) -> Asked<Docs> {
        let times = Times::open(ask.now)?;
        let ids = ask.now.rows(RowField::Token)?;
        let mut by_recording: BTreeMap<i64, Vec<Candidate>> = BTreeMap::new();
        let mut found = Docs::new();
        for doc in candidates {
            match times.get(doc) {
                Some((recording, start, end)) => {
                    let (token, span) = (ids.get(doc).unwrap_or_default(), span(start, end));
                    let candidates = by_recording.entry(recording).or_default();
                    candidates.push(Candidate { doc, token, span });
                }
                None if self.passes_alone() => found.push(doc),
                None => {}
            }
        }
        let recordings = by_recording.keys().copied().collect();
        let mut glosses = self.glosses(ask, &recordings, &times, &*ids)?;
        for (recording, candidates) in by_recording {
            let mut marks = glosses.remove(&recording).unwrap_or_default();
            self.collect(ask, recording, &mut marks)?;
            let marks = Marks::new(marks);
            for one in candidates {
                ask.look()?;
                if self.holds(&one, &marks) {
                    found.push(one.doc);
                }
            }
        }
        found.sort_unstable();
        Ok(found)
    }

    fn holds(&self, candidate: &Candidate, marks: &Marks) -> bool {
        match self.relation {
            Some(relation) => marks.any(relation, candidate, |mark| mark.passes),
            None => {
                marks.any(Relation::Overlaps, candidate, |mark| mark.passes)
                    || self.passes_alone() && !marks.any(Relation::Overlaps, candidate, |_| true)
            }
        }
    }

    /// Returns whether a token passes if no annotation of the tier overlaps it.
    fn passes_alone(&self) -> bool {
        self.relation.is_none()
            && self.other.iter().any(|other| match other {
                Other::Tier(_, comparison) => comparison.accepts(&Reading::Unset, |_, _| false),
                _ => false,
            })
    }

    /// Returns the tokens whose gloss passes, by recording.
    fn glosses(
        &self,
        ask: &Ask<'_>,
        recordings: &BTreeSet<i64>,
        times: &Times,
        ids: &dyn Column,
    ) -> Asked<BTreeMap<i64, Vec<RelatedSpan>>> {
        let mut marks: BTreeMap<i64, Vec<RelatedSpan>> = BTreeMap::new();
        for other in &self.other {
            let Other::Gloss(plan) = other else {
                continue;
            };
            for doc in plan::evaluate(ask, plan, None)? {
                let Some((recording, start, end)) = times.get(doc) else {
                    continue;
                };
                if recordings.contains(&recording) {
                    marks.entry(recording).or_default().push(RelatedSpan {
                        span: span(start, end),
                        token: ids.get(doc).filter(|_| !self.itself),
                        passes: true,
                    });
                }
            }
        }
        Ok(marks)
    }

    /// Adds the annotations of a recording to which the relation may hold.
    fn collect(&self, ask: &Ask<'_>, recording: i64, marks: &mut Vec<RelatedSpan>) -> Result<()> {
        ask.go_on()?;
        let mut add = |row: &CodedRow<'_>, passes: bool| {
            let wanted = passes || self.relation.is_none();
            if let Some((start, end)) = row.span.filter(|_| wanted) {
                marks.push(RelatedSpan {
                    span: span(start, end),
                    token: None,
                    passes,
                });
            }
        };
        for other in &self.other {
            match other {
                Other::Gloss(_) => {}
                Other::Component(test) => {
                    let left_handed = answers::left_handed(ask.connection, recording)?;
                    let (name, phases) = (test.field.component.name(), test.field.phase.is_some());
                    answers::coded_in_recording(ask.connection, recording, name, phases, |row| {
                        add(&row, component_passes(test, &row, left_handed));
                    })?;
                }
                Other::Role(wanted, test) => {
                    for (tier, _, role) in answers::tiers(ask.connection, recording)? {
                        if role == *wanted {
                            answers::on_tier(ask.connection, tier, |row| {
                                add(&row, text_passes(test, &row));
                            })?;
                        }
                    }
                }
                Other::Tier(pattern, comparison) => {
                    for (tier, name, _) in answers::tiers(ask.connection, recording)? {
                        if pattern.matches(&name) {
                            answers::on_tier(ask.connection, tier, |row| {
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
fn check_tier(ask: &Ask<'_>, name: &Pattern, test: &Test) -> Asked<()> {
    let names = answers::tier_names(ask.connection)?;
    if names.iter().any(|it| name.matches(it)) {
        return Ok(());
    }
    let near = findings::like(&name.segments().concat(), &names);
    let kind = FindingKind::CannotMatch {
        why: "no tier has this name".to_owned(),
        names: if near.is_empty() { names } else { near },
    };
    ask.find(test.to_string(), test.at, kind);
    Ok(())
}

fn texts_beside(ask: &Ask<'_>, test: &Test, field: TextField) -> Asked<Vec<Other>> {
    let mut other = Vec::new();
    if matches!(field, TextField::Any | TextField::Gloss) {
        let mut own = test.clone();
        match &mut own.what {
            What::Whole(field, _) | What::Words(field, _) | What::Fuzzy { field, .. } => {
                *field = TextField::Gloss;
            }
            _ => {}
        }
        other.push(Other::Gloss(compile::test(ask, &own)?));
    }
    let roles = [
        (TextField::Translation, TierRole::Translation),
        (TextField::Comment, TierRole::Comment),
    ];
    for (own, role) in roles {
        if field == TextField::Any || field == own {
            other.push(Other::Role(role, test.clone()));
        }
    }
    Ok(other)
}

fn reading_of(row: &CodedRow<'_>) -> Reading {
    match terms::reading(row.state, row.value.map(str::trim)) {
        Reading::Value(value) if value.is_empty() => Reading::Unset,
        reading => reading,
    }
}

fn component_passes(test: &ComponentTest, row: &CodedRow<'_>, left_handed: bool) -> bool {
    let hands = hands_of(test.field.hand);
    let own = hand_codes(row.hand, left_handed);
    let phase = phase_code(row.phase);
    if !own.iter().any(|hand| hands.contains(hand)) || !phase_counts(test.field.phase, &phase) {
        return false;
    }
    let reading = reading_of(row);
    let folded = reading.value().map_or(String::new(), fold);
    test.accepts(row.part, &reading, &folded)
}

fn text_passes(test: &Test, row: &CodedRow<'_>) -> bool {
    let reading = reading_of(row);
    match &test.what {
        What::Whole(_, comparison) => text_match::text_passes(comparison, &reading),
        what => reading
            .value()
            .is_some_and(|text| texts::passes(what, text)),
    }
}

struct Candidate {
    doc: Doc,
    token: i64,
    span: Span,
}

struct RelatedSpan {
    span: Span,
    /// The token, if the annotation is that of one.
    token: Option<i64>,
    passes: bool,
}

/// Annotations ordered by start, each with the latest end up to it, for a fast search around a span.
struct Marks {
    marks: Vec<RelatedSpan>,
    latest: Vec<Instant>,
}

impl Marks {
    fn new(mut marks: Vec<RelatedSpan>) -> Self {
        marks.sort_by_key(|mark| mark.span.start());
        let mut latest = Vec::with_capacity(marks.len());
        for mark in &marks {
            let before = latest.last().copied().unwrap_or(mark.span.end());
            latest.push(before.max(mark.span.end()));
        }
        Self { marks, latest }
    }

    /// Returns whether the relation holds between the candidate and one of the wanted annotations.
    fn any(
        &self,
        relation: Relation,
        candidate: &Candidate,
        wanted: impl Fn(&RelatedSpan) -> bool,
    ) -> bool {
        let holds = |mark: &RelatedSpan| {
            wanted(mark)
                && mark.token != Some(candidate.token)
                && relation.holds(candidate.span, mark.span)
        };
        let reach = match relation {
            Relation::Before | Relation::After | Relation::NotInside | Relation::NotOverlaps => {
                return self.marks.iter().any(holds);
            }
            Relation::Around(reach) | Relation::OfBegin(reach) | Relation::OfEnd(reach) => {
                reach.max(0)
            }
            _ => 0,
        };
        let (from, to) = (
            candidate.span.start().shifted(-reach),
            candidate.span.end().shifted(reach),
        );
        let until = self.marks.partition_point(|mark| mark.span.start() <= to);
        let near = self.marks[..until].iter().zip(&self.latest).rev();
        let mut near = near.take_while(|(_, latest)| **latest >= from);
        near.any(|(mark, _)| holds(mark))
    }
}

fn span(start: i64, end: i64) -> Span {
    Span::between(Instant::from_micros(start), Instant::from_micros(end))
}
