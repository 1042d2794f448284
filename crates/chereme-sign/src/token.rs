//! From tiers to tokens: collects the values of component tiers for one token of a sign.

use crate::component::{ComponentField, ComponentReading, HandRef, SignComponent, SignPhase};
use chereme_motion::TimeSpan;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The value of a component tier over a stretch of time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComponentSpan {
    /// The tier's field, without a phase.
    pub field: ComponentField,
    /// The time.
    pub span: TimeSpan,
    /// The value, or the reason for its absence.
    pub reading: ComponentReading,
}

/// Returns the index in `tokens` of the gloss to which an annotation of a component tier belongs.
///
/// It belongs to the gloss with which it shares the most time, provided that this is at least half of the shorter of
/// the two; among equals, to the one that starts first. An annotation without length belongs to none.
#[must_use]
pub fn owning_token_index(annotation: TimeSpan, tokens: &[TimeSpan]) -> Option<usize> {
    let shared = |token: &TimeSpan| token.span_intersection(annotation).map_or(0, TimeSpan::span_micros);
    let best = tokens
        .iter()
        .enumerate()
        .max_by_key(|(n, token)| (shared(token), Reverse((token.span_start_instant(), *n))));
    let (place, token) = best?;
    let shorter = annotation.span_micros().min(token.span_micros());
    // Twice a long time may exceed 64 bits.
    let enough = i128::from(shared(token)) * 2 >= i128::from(shorter);
    (shared(token) > 0 && enough).then_some(place)
}

/// Returns the component values of a gloss from the annotations around it: each field with the index in `around` of the
/// annotation that gives its value.
///
/// `token` is the gloss's span and `others` are the spans of the glosses around it, of the same hand or signer: an
/// annotation belongs to one gloss only, see [`owning_token_index`]. `hand` is the gloss's own hand, if its tier has one:
/// annotations about another hand are then left out, and annotations of hand tiers that name no hand count as about
/// this one; non-manual components belong to no hand and always count. Hands are compared as they are: resolve
/// `dominant` and `weak` first.
///
/// Of one field, a single value has no phase. Of several, in the order of their starts, the first is
/// [`SignPhase::Initial`], the last [`SignPhase::Final`], and those between are [`SignPhase::Middle`] from 1 on (beyond 255 they
/// are left out). Neighbours with equal values count as one. The result is sorted by the fields without their phases,
/// then by time.
///
/// ```
/// use chereme_motion::{RecordingInstant, TimeSpan};
/// use chereme_sign::token::{ComponentSpan, component_readings};
///
/// let span = |a, b| TimeSpan::span_between(RecordingInstant::from_millis(a), RecordingInstant::from_millis(b));
/// let says = |field: &str, span, value: &str| ComponentSpan {
///     field: field.parse().expect("a field"),
///     span,
///     reading: value.into(),
/// };
/// let around = [
///     says("right.placement", span(0, 300), "chin"),
///     says("right.placement", span(300, 620), "chest"),
///     says("right.configuration", span(20, 610), "U"),
///     says("right.configuration", span(600, 900), "S"),
/// ];
/// let found = component_readings(span(0, 600), &[span(620, 900)], None, &around);
/// let said = |(field, place): &(_, usize)| format!("{field}={}", around[*place].reading);
/// let found: Vec<String> = found.iter().map(said).collect();
/// assert_eq!(
///     found,
///     ["right.configuration=U", "initial.right.placement=chin", "final.right.placement=chest"]
/// );
/// ```
#[must_use]
pub fn component_readings(
    token: TimeSpan,
    others: &[TimeSpan],
    hand: Option<HandRef>,
    around: &[ComponentSpan],
) -> Vec<(ComponentField, usize)> {
    let tokens: Vec<TimeSpan> = std::iter::once(token).chain(others.iter().copied()).collect();
    let mut fields: BTreeMap<ComponentKey, Vec<usize>> = BTreeMap::new();
    for (place, annotation) in around.iter().enumerate() {
        let manual = annotation.field.component.is_manual();
        let about = annotation.field.hand.or(hand.filter(|_| manual));
        let ours = !manual || hand.is_none() || about == hand;
        if ours && owning_token_index(annotation.span, &tokens) == Some(0) {
            let key = (annotation.field.component, annotation.field.feature.as_deref(), about);
            fields.entry(key).or_default().push(place);
        }
    }
    fields
        .into_iter()
        .flat_map(|(key, places)| phased(key, places, around))
        .collect()
}

type ComponentKey<'a> = (SignComponent, Option<&'a str>, Option<HandRef>);

fn phased(
    (component, feature, hand): ComponentKey,
    mut places: Vec<usize>,
    around: &[ComponentSpan],
) -> Vec<(ComponentField, usize)> {
    places.sort_by_key(|place| {
        (
            around[*place].span.span_start_instant(),
            around[*place].span.span_end_instant(),
        )
    });
    // A value that lasts over two annotations is one phase.
    places.dedup_by(|later, earlier| around[*later].reading == around[*earlier].reading);
    let last = places.len().saturating_sub(1);
    let phase = |place: usize| match place {
        _ if last == 0 => Some(None),
        0 => Some(Some(SignPhase::Initial)),
        place if place == last => Some(Some(SignPhase::Final)),
        place => Some(Some(SignPhase::Middle(u8::try_from(place).ok()?))),
    };
    let field = |phase| ComponentField {
        hand,
        component,
        feature: feature.map(str::to_owned),
        phase,
    };
    let numbered = places.into_iter().enumerate();
    numbered
        .filter_map(|(place, index)| Some((field(phase(place)?), index)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn span(start: i64, end: i64) -> TimeSpan {
        TimeSpan::from_span_micros(start, end)
    }

    fn says(text: &str) -> ComponentSpan {
        let (times, rest) = text.split_once(' ').expect("times");
        let (start, end) = times.split_once('-').expect("two times");
        let (field, value) = rest.split_once('=').expect("a value");
        let number = |text: &str| text.parse().expect("a number");
        ComponentSpan {
            field: field.parse().expect("a field"),
            span: span(number(start), number(end)),
            reading: match value {
                "?" => ComponentReading::Unclear,
                "n/a" => ComponentReading::NotApplicable,
                value => value.into(),
            },
        }
    }

    #[test]
    fn annotations_belong_to_the_gloss_they_share_most_with() {
        for (annotation, tokens, place) in [
            (span(0, 10), &[span(0, 10)][..], Some(0)),
            (span(5, 15), &[span(0, 10)], Some(0)),
            (span(6, 16), &[span(0, 10)], None),
            (span(6, 100), &[span(0, 10)], None),
            (span(9, 10), &[span(0, 10)], Some(0)),
            (span(0, 1000), &[span(10, 12), span(20, 29)], Some(1)),
            (span(5, 15), &[span(0, 10), span(10, 20)], Some(0)),
            (span(4, 15), &[span(0, 10), span(10, 20)], Some(0)),
            (span(5, 16), &[span(0, 10), span(10, 20)], Some(1)),
            (span(5, 5), &[span(0, 10)], None),
            (span(0, 10), &[], None),
        ] {
            assert_eq!(
                owning_token_index(annotation, tokens),
                place,
                "{annotation:?} {tokens:?}"
            );
        }
    }

    #[test]
    fn phases_follow_the_order_of_time() {
        let right = Some(HandRef::Right);
        for (hand, around, wanted) in [
            (right, &["0-100 configuration=U"][..], "right.configuration=U"),
            (None, &["0-100 configuration=U"], "configuration=U"),
            (
                right,
                &["50-100 right.placement=chest", "0-50 right.placement=chin"],
                "initial.right.placement=chin final.right.placement=chest",
            ),
            (
                None,
                &[
                    "0-30 movement=arc",
                    "30-60 movement=?",
                    "60-80 movement=arc",
                    "80-100 movement=hold",
                ],
                "initial.movement=arc middle.movement=unclear middle2.movement=arc final.movement=hold",
            ),
            (None, &["0-50 movement=arc", "50-100 movement=arc"], "movement=arc"),
            (
                right,
                &[
                    "0-99 left.configuration=5",
                    "0-99 nonmanual.brows=raised",
                    "0-99 orientation.palm=up",
                ],
                "right.orientation.palm=up nonmanual.brows=raised",
            ),
            (
                None,
                &[
                    "0-99 left.configuration=5",
                    "0-99 right.configuration=n/a",
                    "70-200 right.configuration=S",
                ],
                "right.configuration=not applicable left.configuration=5",
            ),
            (right, &[], ""),
        ] {
            let around: Vec<ComponentSpan> = around.iter().map(|text| says(text)).collect();
            let found = component_readings(span(0, 100), &[span(100, 200)], hand, &around);
            let found = found.iter().map(|(f, place)| format!("{f}={}", around[*place].reading));
            let found: Vec<String> = found.collect();
            assert_eq!(found.join(" "), wanted);
        }
    }

    #[test]
    fn a_repeated_value_belongs_to_its_own_annotation() {
        let around = ["60-80 movement=out", "0-20 movement=out", "20-30 movement=down"].map(says);
        let found = component_readings(span(0, 100), &[], None, &around);
        let places: Vec<usize> = found.into_iter().map(|(_, place)| place).collect();
        assert_eq!(places, [1, 2, 0]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn an_annotation_is_read_by_one_gloss_at_most(
            cuts in proptest::collection::btree_set(0i64..60, 2..6),
            at in (0i64..60, 1i64..30),
        ) {
            let cuts: Vec<i64> = cuts.into_iter().collect();
            let tokens: Vec<TimeSpan> = cuts.windows(2).map(|pair| span(pair[0], pair[1])).collect();
            let around = [ComponentSpan { span: span(at.0, at.0 + at.1), ..says("0-1 movement=arc") }];
            let readers = (0..tokens.len()).filter(|n| {
                let others: Vec<TimeSpan> =
                    tokens.iter().enumerate().filter(|(k, _)| k != n).map(|(_, span)| *span).collect();
                !component_readings(tokens[*n], &others, None, &around).is_empty()
            });
            prop_assert!(readers.count() <= 1);
        }
    }
}
