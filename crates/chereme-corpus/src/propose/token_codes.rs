//! Reads the components of a token from its movement: postures at their holds, and movements at the time of their acts.

use std::collections::{BTreeMap, BTreeSet};

use chereme_analysis::cut::HandChannel;
use chereme_analysis::transcribe::{FeatureKind, HeldReading, NotationFeature, list_single_acts};
use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::hamnosys::components::{MappedValue, SignMapper};
use chereme_sign::hamnosys::{HamnosysSign, HandsUsed, ManualPart, NotatedMotion, NotatedPosture, NotatedSign};
use chereme_sign::{HandRef, SignComponent, SignPhase};

use super::{ProposalSubject, ProposedValue};
use crate::Corpus;
use crate::address::CorpusAddress;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::search::SearchHit;
use crate::transcribe::{SignTranscription, TranscribedFeature};

/// The confidence of a value that has no rival.
const UNRIVALLED_CONFIDENCE: f64 = 0.6;
/// The share of its confidence that a posture keeps if no hold shows it. Of 60 notated signs, animated, 52 of 64 such readings
/// of palms and fingers were right, and 158 of 178 held ones.
const PASSING_CONFIDENCE: f64 = 0.9;
/// The share of a sign for which a place is held, and how far the hand goes from it in arm lengths, if it makes no path.
const STAYING_SHARE: f64 = 0.85;
const STAYING_REACH: f64 = 0.05;
/// The kinds of movement that are paths of the hand.
const PATH_KINDS: [&str; 7] = ["path", "straight", "arc", "circle", "zigzag", "wavy", "spiral"];

/// The components of a token as they were read.
pub(super) struct TokenCodes {
    /// The values, in no order.
    pub(super) values: Vec<(ProposalSubject, ProposedValue)>,
    /// Whether a handshape is left out because nobody captured it.
    pub(super) lacks_fingers: bool,
}

/// The mapping of notation to a corpus's values, for the hands of one signer.
struct CodeMapper<'i> {
    mapper: SignMapper<'i>,
    dominant: BodySide,
}

impl Corpus {
    /// Returns the values of components read from a token's movement.
    pub(super) fn read_token_codes(
        &self,
        components: &BTreeSet<SignComponent>,
        hit: &SearchHit,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<TokenCodes> {
        let (Some(start), Some(end), Some(_)) = (hit.start_us, hit.end_us, &hit.recording) else {
            return Err(CorpusError::from_wrong_message("there is no movement to read"));
        };
        let address = CorpusAddress::Token(hit.token);
        let written = self.transcribe_movement(&address, progress)?;
        let inventories = self.inventories_now()?;
        let stretch = crate::address::find_addressed_stretch(self.store.read_connection(), &address)?;
        let dominant = self.dominant_side(&stretch)?;
        let mapper = SignMapper::new(inventories.iter().map(|stored| &stored.inventory));
        let codes = CodeMapper {
            mapper: mapper.of_left_handed(dominant == BodySide::Left),
            dominant,
        };
        let instant = RecordingInstant::from_micros;
        let sign = TimeSpan::span_between(instant(written.start_us.max(start)), instant(written.end_us.min(end)));
        let holds = self.stretch_holds(&stretch, sign)?;
        let mut values = codes.held_values(&holds);
        values.extend(codes.place_values(&written, &holds, sign));
        values.extend(codes.movement_values(&written, &holds, sign));
        values.retain(|((component, ..), _)| components.contains(component));
        let all = values.len();
        values.retain(|((component, _, hand), _)| {
            *component != SignComponent::Configuration || !written.assumed.contains(&codes.hand_side(*hand))
        });
        let lacks_fingers = values.len() < all;
        if values.is_empty() && !lacks_fingers {
            return Err(CorpusError::from_wrong_message("no component was seen"));
        }
        Ok(TokenCodes { values, lacks_fingers })
    }
}

impl CodeMapper<'_> {
    fn hand_side(&self, hand: HandRef) -> BodySide {
        match hand {
            HandRef::Weak => self.dominant.opposite_side(),
            _ => self.dominant,
        }
    }

    /// Returns the values of a posture and acts of the hands, with the hand that each belongs to.
    fn map_hand_values(
        &self,
        hands: HandsUsed,
        posture: &NotatedPosture,
        actions: Vec<NotatedMotion>,
    ) -> Vec<(HandRef, MappedValue)> {
        let part = ManualPart {
            hands,
            posture: posture.clone(),
            actions,
            ..ManualPart::default()
        };
        let notated = NotatedSign {
            sign: HamnosysSign { parts: vec![part] },
            ..NotatedSign::default()
        };
        let values = self.mapper.map_sign_components(&notated).values;
        values
            .into_iter()
            .filter_map(|value| Some((value.field.hand?, value)))
            .collect()
    }

    /// Returns the values of handshapes and palms at their holds.
    fn held_values(&self, holds: &[HeldReading]) -> Vec<(ProposalSubject, ProposedValue)> {
        let mut values = Vec::new();
        for reading in holds {
            let channel = match reading.channel {
                HandChannel::Fingers => SignComponent::Configuration,
                HandChannel::Palm => SignComponent::Orientation,
                // The whole sign shows its places better.
                HandChannel::Place => continue,
            };
            let is_shared = matches!(reading.hands, HandsUsed::Both(_));
            for (hand, mapped) in self.map_hand_values(reading.hands, &reading.posture, Vec::new()) {
                let is_own = is_shared || self.hand_side(hand) == reading.hand;
                if mapped.field.component != channel || !is_own {
                    continue;
                }
                let subject = (channel, mapped.field.feature, hand);
                let kinds = feature_kinds(&subject);
                let of_hand = |feature: &&NotationFeature| feature.hand.is_none_or(|side| side == reading.hand);
                let rivals = reading.features.iter().filter(of_hand).filter_map(|feature| {
                    let next = feature.runner_up.as_ref().filter(|_| kinds.contains(&feature.kind))?;
                    Some((feature.residual, next.residual, next.value.as_str()))
                });
                let (margin, runner_up) = least_margin(rivals);
                // A hold is as sure as its value differs from others: how long it is says little more.
                let passing = if reading.held.is_held { 1.0 } else { PASSING_CONFIDENCE };
                let shown = if channel == SignComponent::Configuration {
                    reading.shown
                } else {
                    1.0
                };
                values.push((
                    subject,
                    ProposedValue {
                        start_us: reading.held.span.span_start_instant().instant_micros(),
                        end_us: reading.held.span.span_end_instant().instant_micros(),
                        value: mapped.value,
                        confidence: rounded_confidence(margin * shown * passing),
                        is_moving: !reading.held.is_held,
                        runner_up,
                    },
                ));
            }
        }
        values
    }

    /// Returns the readings of the places that a hand holds.
    fn place_holds<'h>(&self, holds: &'h [HeldReading], hand: HandRef) -> impl Iterator<Item = &'h HeldReading> {
        let side = self.hand_side(hand);
        holds.iter().filter(move |reading| {
            let is_of_both = matches!(reading.hands, HandsUsed::Both(_));
            reading.channel == HandChannel::Place && (is_of_both || reading.hand == side)
        })
    }

    /// Returns the places of the whole sign at the times of the holds. The whole of a sign, contacts included, shows better
    /// than one hold does at which places it begins and ends. Without a hold for each, places share the time of the sign.
    fn place_values(
        &self,
        written: &SignTranscription,
        holds: &[HeldReading],
        sign: TimeSpan,
    ) -> Vec<(ProposalSubject, ProposedValue)> {
        let notated = NotatedSign {
            sign: written.sign.clone(),
            ..NotatedSign::default()
        };
        let mut places: BTreeMap<HandRef, Vec<(Option<SignPhase>, String)>> = BTreeMap::new();
        for mapped in self.mapper.map_sign_components(&notated).values {
            if mapped.field.component == SignComponent::Placement && mapped.field.feature.is_none() {
                let hand = mapped.field.hand.unwrap_or(HandRef::Dominant);
                places.entry(hand).or_default().push((mapped.field.phase, mapped.value));
            }
        }
        let micros =
            |span: TimeSpan| [span.span_start_instant(), span.span_end_instant()].map(|at| at.instant_micros());
        let [start, end] = micros(sign);
        let mut values = Vec::new();
        for (hand, mut own) in places {
            own.sort();
            own.dedup_by(|a, b| a.1 == b.1);
            let count = own.len();
            let side = self.hand_side(hand);
            let readings: Vec<&HeldReading> = self.place_holds(holds, hand).collect();
            let has_holds = count == readings.len() || count == 1;
            for (nth, (_, value)) in own.into_iter().enumerate() {
                let hold = readings.get(nth).filter(|_| has_holds);
                let part_time = |part: usize| start + (end - start) * part as i64 / count as i64;
                let times = hold.map_or([part_time(nth), part_time(nth + 1)], |hold| micros(hold.held.span));
                let of_place = |feature: &&TranscribedFeature| {
                    let is_timed = count == 1 || (times[0]..times[1]).contains(&feature.at_us);
                    is_timed && feature.hand.is_none_or(|of| of == side)
                };
                let subject = (SignComponent::Placement, None, hand);
                let (margin, runner_up) = transcribed_margin(&subject, written.features.iter().filter(of_place));
                let proposed = ProposedValue {
                    is_moving: hold.is_none_or(|hold| !hold.held.is_held),
                    ..ProposedValue::of_act(times, &value, margin, runner_up)
                };
                values.push((subject, proposed));
            }
        }
        values
    }

    /// Returns the kinds of movement, each in the time of its act; no path of a hand that stays in its place.
    fn movement_values(
        &self,
        written: &SignTranscription,
        holds: &[HeldReading],
        sign: TimeSpan,
    ) -> Vec<(ProposalSubject, ProposedValue)> {
        let Some(part) = written.sign.parts.first() else {
            return Vec::new();
        };
        let stays = |hand: HandRef| {
            self.place_holds(holds, hand).any(|reading| {
                let held = reading.held;
                held.is_held && held.share > STAYING_SHARE && held.reach < STAYING_REACH
            })
        };
        let whole = sign.span_start_instant().instant_micros()..sign.span_end_instant().instant_micros();
        let acts = list_single_acts(&part.actions);
        let mut values = Vec::new();
        for (stage, act) in written.stages.iter().skip(1).zip(acts) {
            let hands = match stage.hand {
                None => part.hands,
                Some(side) if side == self.dominant => HandsUsed::Dominant,
                Some(_) => HandsUsed::Nondominant,
            };
            let mapped = self.map_hand_values(hands, &part.posture, vec![act.clone()]);
            for hand in [HandRef::Dominant, HandRef::Weak] {
                let is_kind = |(own, value): &&(HandRef, MappedValue)| {
                    let is_path = PATH_KINDS.contains(&value.value.as_str());
                    let is_of_act = *own == hand && stage.hand.is_none_or(|side| side == self.hand_side(hand));
                    // An act that only leads to a place moves nothing that has a name.
                    is_of_act && is_movement_kind(value) && value.value != "hold" && !(is_path && stays(hand))
                };
                let kinds: Vec<&MappedValue> = mapped.iter().filter(is_kind).map(|(_, value)| value).collect();
                let of_act = |feature: &&TranscribedFeature| {
                    feature.action == stage.action
                        && feature
                            .hand
                            .is_none_or(|side| Some(side) == stage.hand || stage.hand.is_none())
                };
                let subject = (SignComponent::Movement, None, hand);
                let (margin, runner_up) = transcribed_margin(&subject, written.features.iter().filter(of_act));
                let (start, end) = (stage.start_us.max(whole.start), stage.end_us.min(whole.end));
                // Annotations of one tier cannot overlap: acts of a hand at once share the time.
                let part_time = |part: usize| start + (end - start).max(0) * part as i64 / kinds.len() as i64;
                values.extend(kinds.iter().enumerate().map(|(nth, kind)| {
                    let times = [part_time(nth), part_time(nth + 1)];
                    let proposed = ProposedValue::of_act(times, &kind.value, margin, runner_up.clone());
                    ((SignComponent::Movement, None, hand), proposed)
                }));
            }
        }
        for (hand, still) in self.map_hand_values(part.hands, &part.posture, Vec::new()) {
            let subject = (SignComponent::Movement, None, hand);
            if is_movement_kind(&still) && values.iter().all(|(known, _)| *known != subject) {
                let times = [whole.start, whole.end];
                let proposed = ProposedValue::of_act(times, &still.value, UNRIVALLED_CONFIDENCE, None);
                values.push((subject, proposed));
            }
        }
        values
    }
}

impl ProposedValue {
    fn of_act([start_us, end_us]: [i64; 2], value: &str, confidence: f64, runner_up: Option<String>) -> Self {
        Self {
            value: value.to_owned(),
            start_us,
            end_us,
            confidence: rounded_confidence(confidence),
            is_moving: false,
            runner_up,
        }
    }
}

fn is_movement_kind(value: &MappedValue) -> bool {
    value.field.component == SignComponent::Movement && value.field.feature.is_none()
}

fn rounded_confidence(confidence: f64) -> f64 {
    (confidence.clamp(0.0, 1.0) * 1000.0).round() / 1000.0
}

/// Returns the kinds of features of notation that a value is made of.
fn feature_kinds((component, feature, _): &ProposalSubject) -> &'static [FeatureKind] {
    match (component, feature.as_deref()) {
        (SignComponent::Configuration, _) => &[FeatureKind::Handshape],
        (SignComponent::Placement, _) => &[FeatureKind::Location, FeatureKind::Contact],
        (SignComponent::Movement, _) => &[FeatureKind::Movement, FeatureKind::Course],
        (SignComponent::Orientation, Some("fingers")) => &[FeatureKind::Direction],
        (SignComponent::Orientation, _) => &[FeatureKind::Palm],
        _ => &[],
    }
}

fn transcribed_margin<'f>(
    subject: &ProposalSubject,
    features: impl Iterator<Item = &'f TranscribedFeature>,
) -> (f64, Option<String>) {
    let kinds = feature_kinds(subject);
    least_margin(
        features
            .filter(|feature| kinds.contains(&feature.feature))
            .filter_map(|feature| {
                let next = feature.runner_up.as_ref()?;
                Some((feature.value.residual, next.residual, next.value.as_str()))
            }),
    )
}

/// Returns how surely a value is better than its nearest rival, from 0.5 to 1, and that rival: of the features that it is
/// made of, each with its residual, its rival's and its rival, the least sure one counts.
fn least_margin<'f>(rivals: impl Iterator<Item = (f64, f64, &'f str)>) -> (f64, Option<String>) {
    let margins = rivals.filter_map(|(own, other, rival)| {
        // Two residuals of 0 divide zero by zero; the second is never better than the first.
        let share = other / (own + other);
        share.is_finite().then_some((share.clamp(0.5, 1.0), rival))
    });
    match margins.min_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((margin, rival)) => (margin, Some(rival.to_owned())),
        None => (UNRIVALLED_CONFIDENCE, None),
    }
}
