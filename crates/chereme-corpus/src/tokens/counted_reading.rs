//! The one reading of a token that counts, of all that annotators and detectors say.
//!
//! For each component and hand the annotations of one annotator are one reading. That of the adjudicated tier counts; else
//! that of the corpus's preferred annotator; else, phase by phase, the value on which all agree. Everything else does not
//! count; the token keeps it as opinions: proposals of detectors, disputed values, and what others say of a value
//! that counts.

use std::collections::BTreeMap;

use chereme_motion::TimeSpan;
use chereme_sign::token::{ComponentSpan, component_readings};
use chereme_sign::{ComponentField, HandRef, SignComponent};

use super::CodedAnnotation;
use crate::db::people::ADJUDICATION_ANNOTATOR;
use crate::db::signs::TokenValueRow;
use crate::db::stored_columns::OpinionStanding;

/// A gloss and what was annotated during it.
pub(super) struct AnnotatedGloss<'a> {
    pub(super) span: TimeSpan,
    /// Its own hand, if its tier has one.
    pub(super) hand: Option<HandRef>,
    /// The annotations that belong to it, by time.
    pub(super) coded: Vec<&'a CodedAnnotation>,
    /// The annotator whose readings count before those of others.
    pub(super) preferred: Option<&'a str>,
}

/// A component or a feature of it, and the hand.
type FieldKey<'a> = (SignComponent, Option<&'a str>, Option<HandRef>);

/// The annotations by one annotator of one component of one hand.
struct AnnotatorReading<'a> {
    annotator: Option<&'a str>,
    coded: Vec<&'a CodedAnnotation>,
}

/// A field with its phase, and the annotation that gives its value.
type PhasedReading<'a> = (ComponentField, &'a CodedAnnotation);

/// A field with its phase, the annotation that would give its value, and the reason why it does not.
type StandingReading<'a> = (ComponentField, &'a CodedAnnotation, OpinionStanding);

impl<'a> AnnotatedGloss<'a> {
    /// Returns the values that count, by field and time, and after them the opinions.
    pub(super) fn counted_token_values(&self) -> Vec<TokenValueRow> {
        let (mut counted, mut opinions) = (Vec::new(), Vec::new());
        for (_, tiers) in self.coded_by_field() {
            let (mut proposed, mut coded) = (Vec::new(), Vec::new());
            for tier in tiers.into_values() {
                // A person may have corrected some proposals of a tier and left the others.
                let (proposals, codings): (Vec<_>, Vec<_>) = tier.into_iter().partition(|one| one.proposal.is_some());
                proposed.extend(Some(proposals).filter(|some| !some.is_empty()));
                coded.extend(Some(codings).filter(|some| !some.is_empty()));
            }
            let readings = merge_tiers_of_annotators(coded);
            let (counting, weighed) = self.split_counting(&readings);
            counted.extend(counting.iter().map(|(field, source)| counted_row(field, source)));
            let proposals = proposed.iter().flat_map(|tier| self.phased_readings(tier));
            let proposals = proposals.filter_map(|(field, source)| Some((field, source, source.proposal?)));
            let all = weighed.into_iter().chain(proposals);
            opinions.extend(all.map(|(field, source, standing)| opinion_row(&field, source, standing)));
        }
        counted.extend(opinions);
        counted
    }

    /// Returns the annotations of each field by tier.
    fn coded_by_field(&self) -> BTreeMap<FieldKey<'a>, BTreeMap<i64, Vec<&'a CodedAnnotation>>> {
        let mut fields: BTreeMap<FieldKey<'a>, BTreeMap<i64, Vec<&CodedAnnotation>>> = BTreeMap::new();
        for &coded in &self.coded {
            let field = &coded.span.field;
            // The hand of a gloss says nothing about the face.
            let hand = field.hand.or(self.hand.filter(|_| field.component.is_manual()));
            let key = (field.component, field.feature.as_deref(), hand);
            fields
                .entry(key)
                .or_default()
                .entry(coded.tier)
                .or_default()
                .push(coded);
        }
        fields
    }

    /// Returns the readings that count, and the others with the reason why they do not.
    fn split_counting(&self, readings: &[AnnotatorReading<'a>]) -> (Vec<PhasedReading<'a>>, Vec<StandingReading<'a>>) {
        let by = |annotator: Option<&str>| {
            let is_own = |reading: &AnnotatorReading<'_>| annotator.is_some() && reading.annotator == annotator;
            readings.iter().position(is_own)
        };
        // An adjudication was made to settle what the annotators dispute.
        let chosen = by(Some(ADJUDICATION_ANNOTATOR)).or_else(|| by(self.preferred));
        let phase_readings = |reading: &AnnotatorReading<'a>| self.phased_readings(&reading.coded);
        let mut phased: Vec<Vec<PhasedReading<'a>>> = readings.iter().map(phase_readings).collect();
        if let Some(chosen) = chosen {
            let counting = phased.remove(chosen);
            let others = phased.into_iter().flatten();
            let weighed = others.map(|(field, source)| {
                let is_same = |own: &PhasedReading<'_>| own.0 == field && own.1.span.reading == source.span.reading;
                let agrees = counting.iter().any(is_same);
                let standing = if agrees {
                    OpinionStanding::Agreed
                } else {
                    OpinionStanding::Replaced
                };
                (field, source, standing)
            });
            let weighed = weighed.collect();
            return (counting, weighed);
        }
        phased.retain(|reading| !reading.is_empty());
        let Some((first, others)) = phased.split_first() else {
            return Default::default();
        };
        let same_phases = |other: &Vec<PhasedReading<'_>>| {
            other.len() == first.len() && other.iter().zip(first).all(|(one, two)| one.0 == two.0)
        };
        // Readings with other phases cannot be compared phase by phase.
        if !others.iter().all(same_phases) {
            let disputed = phased.into_iter().flatten();
            let disputed = disputed.map(|(field, source)| (field, source, OpinionStanding::Disputed));
            return (Vec::new(), disputed.collect());
        }
        let (mut counting, mut weighed) = (Vec::new(), Vec::new());
        for (place, (field, source)) in first.iter().enumerate() {
            let said = others.iter().map(|other| other[place].1);
            let (standing, own) = match said.clone().all(|other| other.span.reading == source.span.reading) {
                true => (OpinionStanding::Agreed, None),
                false => (OpinionStanding::Disputed, Some(*source)),
            };
            counting.extend(own.is_none().then(|| (field.clone(), *source)));
            let opinions = own.into_iter().chain(said);
            weighed.extend(opinions.map(|source| (field.clone(), source, standing)));
        }
        (counting, weighed)
    }

    fn phased_readings(&self, coded: &[&'a CodedAnnotation]) -> Vec<PhasedReading<'a>> {
        let around: Vec<ComponentSpan> = coded.iter().map(|one| one.span.clone()).collect();
        let readings = component_readings(self.span, &[], self.hand, &around).into_iter();
        readings.map(|(field, place)| (field, coded[place])).collect()
    }
}

/// Makes one reading of the tiers of each annotator. Tiers of a hand that say something at the same time are different
/// readings even of one annotator, or of nobody in particular: a sign has its handshapes one after the other.
fn merge_tiers_of_annotators(tiers: Vec<Vec<&CodedAnnotation>>) -> Vec<AnnotatorReading<'_>> {
    let mut readings: Vec<AnnotatorReading<'_>> = Vec::new();
    for tier in tiers {
        let annotator = tier[0].annotator.as_deref();
        let joins = |reading: &&mut AnnotatorReading<'_>| {
            let mut pairs = reading
                .coded
                .iter()
                .flat_map(|one| tier.iter().map(move |two| (one, two)));
            reading.annotator == annotator && !pairs.any(|(one, two)| is_second_opinion(one, two))
        };
        match readings.iter_mut().find(joins) {
            Some(reading) => {
                reading.coded.extend(tier);
                let time = |coded: &&CodedAnnotation| (coded.span.span.span_start_instant(), coded.annotation);
                reading.coded.sort_by_key(time);
            }
            None => readings.push(AnnotatorReading { annotator, coded: tier }),
        }
    }
    readings
}

/// Returns whether two annotations of a hand share at least half of the shorter one.
fn is_second_opinion(one: &CodedAnnotation, two: &CodedAnnotation) -> bool {
    let (a, b) = (one.span.span, two.span.span);
    let shared = a.span_intersection(b).map_or(0, TimeSpan::span_micros);
    let shorter = a.span_micros().min(b.span_micros());
    one.span.field.component.is_manual() && shared > 0 && shared.saturating_mul(2) >= shorter
}

fn counted_row(field: &ComponentField, source: &CodedAnnotation) -> TokenValueRow {
    TokenValueRow {
        inventory_id: source.inventory,
        annotation_id: Some(source.annotation),
        ..TokenValueRow::from_field_reading(field, &source.span.reading)
    }
}

/// Returns the row of an opinion: the field has no value from it, and its annotation says what it would be.
fn opinion_row(field: &ComponentField, source: &CodedAnnotation, standing: OpinionStanding) -> TokenValueRow {
    TokenValueRow {
        // The origin of the annotation shows which of the usual ones it has.
        standing: Some(standing).filter(|standing| !standing.is_usual()),
        inventory_id: source.inventory,
        annotation_id: Some(source.annotation),
        ..TokenValueRow::from_field_reading(field, &chereme_sign::ComponentReading::Unset)
    }
}
