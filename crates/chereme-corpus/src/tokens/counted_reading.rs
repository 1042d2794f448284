//! The one reading of a token that counts, of all that annotators and detectors say.
//!
//! For each component and hand the annotations of one annotator are one reading. That of the adjudicated tier counts; else
//! that of the corpus's preferred annotator; else, phase by phase, the value on which all agree. Disputed
//! values and proposals of detectors do not count; the token keeps both as opinions.

use std::collections::BTreeMap;

use chereme_motion::TimeSpan;
use chereme_sign::token::{ComponentSpan, component_readings};
use chereme_sign::{ComponentField, HandRef, SignComponent};

use super::CodedAnnotation;
use crate::db::people::ADJUDICATION_ANNOTATOR;
use crate::db::signs::TokenValueRow;

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

impl<'a> AnnotatedGloss<'a> {
    /// Returns the values that count, by field and time, and after them the opinions.
    pub(super) fn counted_token_values(&self) -> Vec<TokenValueRow> {
        let (mut counted, mut opinions) = (Vec::new(), Vec::new());
        for (_, tiers) in self.coded_by_field() {
            let (mut proposed, mut coded) = (Vec::new(), Vec::new());
            for tier in tiers.into_values() {
                // A person may have corrected some proposals of a tier and left the others.
                let (proposals, codings): (Vec<_>, Vec<_>) = tier.into_iter().partition(|one| one.is_proposal);
                proposed.extend(Some(proposals).filter(|some| !some.is_empty()));
                coded.extend(Some(codings).filter(|some| !some.is_empty()));
            }
            let readings = merge_tiers_of_annotators(coded);
            let (counting, disputed) = self.split_disputed(&readings);
            counted.extend(counting.iter().map(|(field, source)| counted_row(field, source)));
            let proposals = proposed.iter().flat_map(|tier| self.phased_readings(tier));
            opinions.extend(
                disputed
                    .into_iter()
                    .chain(proposals)
                    .map(|(field, source)| opinion_row(&field, source)),
            );
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

    /// Returns the readings that count, and those that are in dispute.
    fn split_disputed(&self, readings: &[AnnotatorReading<'a>]) -> (Vec<PhasedReading<'a>>, Vec<PhasedReading<'a>>) {
        let by = |annotator: Option<&str>| {
            let mut own = readings
                .iter()
                .filter(|reading| annotator.is_some() && reading.annotator == annotator);
            own.next()
        };
        // An adjudication was made to settle what the annotators dispute.
        let chosen = by(Some(ADJUDICATION_ANNOTATOR)).or_else(|| by(self.preferred));
        let standing = match chosen {
            Some(chosen) => std::slice::from_ref(chosen),
            None => readings,
        };
        let phased: Vec<Vec<PhasedReading<'a>>> = standing
            .iter()
            .map(|reading| self.phased_readings(&reading.coded))
            .filter(|phased| !phased.is_empty())
            .collect();
        let Some((first, others)) = phased.split_first() else {
            return Default::default();
        };
        let same_phases = |other: &Vec<PhasedReading<'_>>| {
            other.len() == first.len() && other.iter().zip(first).all(|(one, two)| one.0 == two.0)
        };
        // Readings with other phases cannot be compared phase by phase.
        let alike = others.iter().all(same_phases);
        let (mut counting, mut disputed) = (Vec::new(), Vec::new());
        for (place, (field, source)) in first.iter().enumerate() {
            let agrees = |other: &Vec<PhasedReading<'_>>| other[place].1.span.reading == source.span.reading;
            if alike && others.iter().all(agrees) {
                counting.push((field.clone(), *source));
            } else if alike {
                disputed.extend(phased.iter().map(|reading| reading[place].clone()));
            }
        }
        if !alike {
            disputed = phased.into_iter().flatten().collect();
        }
        (counting, disputed)
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
fn opinion_row(field: &ComponentField, source: &CodedAnnotation) -> TokenValueRow {
    TokenValueRow {
        inventory_id: source.inventory,
        annotation_id: Some(source.annotation),
        ..TokenValueRow::from_field_reading(field, &chereme_sign::ComponentReading::Unset)
    }
}
