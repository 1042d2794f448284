//! Handshapes: finds the nearest form by joint angles.

use std::sync::{Arc, Mutex, PoisonError};

use chereme_motion::{BodyAnatomy, BodyPart, BodySide, HandAngles, HandFinger};
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::{
    BodyLanguage, CeeOpening, DigitList, FingerBend, HandClass, HandDigit, Handshape, HandshapeForm, ThumbPosition,
};

use super::BestReading;
use crate::transcribe::transcribe_tuned::tuned;

const CANDIDATE_HAND_CLASSES: [HandClass; 12] = [
    HandClass::Fist,
    HandClass::Flat,
    HandClass::Finger2,
    HandClass::Finger23,
    HandClass::Finger23Spread,
    HandClass::Finger2345,
    HandClass::Pinch12,
    HandClass::Pinch12Open,
    HandClass::PinchAll,
    HandClass::Cee12,
    HandClass::Cee12Open,
    HandClass::CeeAll,
];
const CANDIDATE_THUMB_POSITIONS: [Option<ThumbPosition>; 4] = [
    None,
    Some(ThumbPosition::Out),
    Some(ThumbPosition::Across),
    Some(ThumbPosition::Opposed),
];
const CANDIDATE_BENDS: [Option<FingerBend>; 7] = [
    None,
    Some(FingerBend::Bent),
    Some(FingerBend::Round),
    Some(FingerBend::Hooked),
    Some(FingerBend::DoubleBent),
    Some(FingerBend::DoubleHooked),
    Some(FingerBend::HalfBent),
];
const CANDIDATE_OPENINGS: [Option<CeeOpening>; 3] = [None, Some(CeeOpening::Tight), Some(CeeOpening::Slack)];

/// Postures that differ by less than this (degrees) look the same.
const ALIKE_POSTURE_DEGREES: f64 = 1.0;

/// An entry of the table: a form with its angles in degrees.
#[derive(Debug)]
struct FormAngles {
    shape: Handshape,
    angles: [f64; HandAngles::HAND_ANGLE_COUNT],
    cost: f64,
}

/// The table of all candidate handshapes: every form of every class, and half-way between any two of the
/// plain ones.
#[derive(Debug)]
pub(super) struct HandFormTable {
    language: BodyLanguage,
    entries: Vec<FormAngles>,
}

impl HandFormTable {
    /// Returns the table for a body language; the last one is cached.
    pub(super) fn form_table_for(language: &BodyLanguage) -> Arc<Self> {
        static LAST_FORM_TABLE: Mutex<Option<Arc<HandFormTable>>> = Mutex::new(None);
        let mut last = LAST_FORM_TABLE.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(forms) = last.as_ref().filter(|forms| forms.language == *language) {
            return Arc::clone(forms);
        }
        let forms = Arc::new(Self::build_form_table(language));
        *last = Some(Arc::clone(&forms));
        forms
    }

    fn build_form_table(language: &BodyLanguage) -> Self {
        let mut entries: Vec<FormAngles> = Vec::new();
        let entry = |shape: Handshape, cost: f64| {
            let angles = hand_angles(&shape, language).to_array().map(f64::to_degrees);
            FormAngles { shape, angles, cost }
        };
        for form in plain_hand_forms() {
            add_form_entry(&mut entries, entry(bare_handshape(form), 0.0));
        }
        let forms: Vec<HandshapeForm> = entries.iter().map(|entry| entry.shape.form).collect();
        let plain_forms = entries.len();
        for (n, &first) in forms.iter().enumerate() {
            for &second in &forms[n + 1..] {
                let shape = Handshape {
                    between: Some(second),
                    ..bare_handshape(first)
                };
                let between = entry(shape, tuned().shape.costs[0]);
                let looks_like = |plain: &FormAngles| {
                    let form = plain.shape.form;
                    form.thumb == first.thumb
                        && [first.class, second.class].contains(&form.class)
                        && same_fingers(plain, &between)
                };
                if first.thumb != second.thumb || !entries[..plain_forms].iter().any(looks_like) {
                    entries.push(between);
                }
            }
        }
        for form in plain_hand_forms() {
            for digits in other_digits(form.class) {
                let shape = Handshape {
                    special: digits,
                    ..bare_handshape(form)
                };
                entries.push(entry(shape, tuned().shape.costs[1]));
            }
        }
        Self {
            language: language.clone(),
            entries,
        }
    }

    /// Returns the form nearest to a hand's angles; the runner-up is the next best that shares no form
    /// with it. Residuals are weighted roots of mean squares in degrees. Longer notation costs more, the
    /// `loose`r the hands are. `None` if no angle is known.
    ///
    pub(super) fn nearest_handshape(
        &self,
        hand: &HandAngles,
        known: &KnownHandAngles,
        loose: f64,
    ) -> Option<BestReading<Handshape>> {
        let total: f64 = known.0.iter().sum();
        if total <= 0.0 {
            return None;
        }
        let hand_degrees = hand.to_array().map(f64::to_degrees);
        let off = |angles: &[f64; HandAngles::HAND_ANGLE_COUNT]| -> f64 {
            let squares = hand_degrees.iter().zip(angles).zip(&known.0);
            let sum: f64 = squares.map(|((a, b), w)| w * (a - b) * (a - b)).sum();
            (sum / total).sqrt()
        };
        let scored = |residual: f64, cost: f64| (residual + tuned().shape.floor) * (1.0 + loose * cost);
        let residuals: Vec<f64> = self.entries.iter().map(|entry| off(&entry.angles)).collect();
        let score = |n: usize| scored(residuals[n], self.entries[n].cost);
        let all = 0..self.entries.len();
        let best = all.clone().min_by(|&a, &b| score(a).total_cmp(&score(b)))?;
        let mut best_form = ScoredForm {
            score: score(best),
            residual: residuals[best],
            shape: self.entries[best].shape.clone(),
            cost: self.entries[best].cost,
        };
        for n in self.best_without_fingers(&hand_degrees, known) {
            let entry = &self.entries[n];
            let mut tried = ScoredForm {
                score: score(n),
                residual: residuals[n],
                shape: entry.shape.clone(),
                cost: entry.cost,
            };
            while let Some(next) = self.excepted(&tried, hand, known, &off, &scored) {
                tried = next;
            }
            if tried.score < best_form.score {
                best_form = tried;
            }
        }
        let tied = all.clone().filter(|&n| {
            let shape = &self.entries[n].shape;
            score(n) <= best_form.score * (1.0 + tuned().shape.tie) && mark_count(shape) < mark_count(&best_form.shape)
        });
        let plainest = tied.min_by_key(|&n| mark_count(&self.entries[n].shape));
        if let Some(n) = plainest {
            best_form.shape = self.entries[n].shape.clone();
            best_form.residual = residuals[n];
        }
        let runner_up = all
            .filter(|&n| !has_common_form(&self.entries[n].shape, &best_form.shape))
            .min_by(|&a, &b| score(a).total_cmp(&score(b)))
            .map(|n| (self.entries[n].shape.clone(), residuals[n]));
        Some(BestReading {
            best: best_form.shape,
            residual: best_form.residual,
            runner_up,
        })
    }

    /// Returns the indices of the forms that fit best without their worst finger, and of those that fit best without their
    /// two worst; the thumb always counts.
    fn best_without_fingers(&self, own: &[f64; HandAngles::HAND_ANGLE_COUNT], known: &KnownHandAngles) -> Vec<usize> {
        let mut near: [Vec<(f64, usize)>; 2] = [Vec::new(), Vec::new()];
        for (n, entry) in self.entries.iter().enumerate() {
            if entry.shape.between.is_some() {
                continue;
            }
            let part = |range: std::ops::Range<usize>| -> f64 {
                range.map(|k| known.0[k] * (own[k] - entry.angles[k]).powi(2)).sum()
            };
            let mut fingers = [0, 1, 2, 3].map(|finger| part(5 + 4 * finger..9 + 4 * finger));
            fingers.sort_by(f64::total_cmp);
            let thumb = part(0..5);
            near[0].push((thumb + fingers[0] + fingers[1] + fingers[2], n));
            near[1].push((thumb + fingers[0] + fingers[1], n));
        }
        let mut candidates = Vec::new();
        for near in &mut near {
            let few = tuned().shape.tried.min(near.len());
            if few < near.len() {
                near.select_nth_unstable_by(few, |a, b| a.0.total_cmp(&b.0));
            }
            candidates.extend(near[..few].iter().map(|(_, n)| *n));
        }
        candidates.sort_unstable();
        candidates.dedup();
        candidates
    }

    /// Returns the handshape with a separate notation for one digit, if that fits better.
    fn excepted(
        &self,
        from: &ScoredForm,
        hand: &HandAngles,
        known: &KnownHandAngles,
        off: &impl Fn(&[f64; HandAngles::HAND_ANGLE_COUNT]) -> f64,
        scored: &impl Fn(f64, f64) -> f64,
    ) -> Option<ScoredForm> {
        let now = hand_angles(&from.shape, &self.language);
        let mut better: Option<ScoredForm> = None;
        for finger in HandFinger::ALL_FINGERS {
            let n = finger.index();
            let weight = &known.0[5 + 4 * n..9 + 4 * n];
            let apart = (0..3).map(|joint| {
                let off = hand.fingers[n].flexion[joint] - now.fingers[n].flexion[joint];
                off.to_degrees().abs() * weight[joint + 1].min(1.0)
            });
            if from.shape.bends[n + 1].is_some() || apart.fold(0.0, f64::max) < tuned().shape.odd {
                continue;
            }
            for bend in CANDIDATE_BENDS.into_iter().flatten() {
                let mut shape = from.shape.clone();
                shape.bends[n + 1] = Some(bend);
                let angles = hand_angles(&shape, &self.language).to_array();
                let residual = off(&angles.map(f64::to_degrees));
                let cost = from.cost + tuned().shape.costs[2];
                let score = scored(residual, cost);
                let least = better.as_ref().map_or(from.score, |found| found.score);
                if score < least {
                    better = Some(ScoredForm {
                        score,
                        residual,
                        shape,
                        cost,
                    });
                }
            }
        }
        better
    }
}

/// A candidate form with its score.
struct ScoredForm {
    score: f64,
    residual: f64,
    shape: Handshape,
    cost: f64,
}

/// Returns whether two handshapes look the same to within a fraction of a degree.
pub(super) fn is_same(a: &Handshape, b: &Handshape, language: &BodyLanguage) -> bool {
    let degrees = |shape| hand_angles(shape, language).to_array().map(f64::to_degrees);
    mean_angle_difference(&degrees(a), &degrees(b)) < ALIKE_POSTURE_DEGREES
}

/// Returns how many bends, second forms, special digits and exceptions a handshape is written with.
fn mark_count(shape: &Handshape) -> usize {
    let bends = shape.bends.iter().chain([&shape.form.bend]).flatten().count();
    bends + usize::from(shape.between.is_some()) + usize::from(!shape.special.is_empty())
}

/// Returns whether two handshapes have a form in common.
fn has_common_form(a: &Handshape, b: &Handshape) -> bool {
    let forms = |shape: &Handshape| [Some(shape.form), shape.between];
    let shares = forms(a).iter().flatten().any(|form| forms(b).contains(&Some(*form)));
    shares && a.special == b.special
}

fn bare_handshape(form: HandshapeForm) -> Handshape {
    Handshape {
        form,
        ..Handshape::default()
    }
}

/// Returns every class with every thumb position or opening and every bend, the simpler first.
fn plain_hand_forms() -> impl Iterator<Item = HandshapeForm> {
    let with = |class: HandClass| -> Vec<(Option<ThumbPosition>, Option<CeeOpening>)> {
        match class {
            HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll => {
                vec![(None, None)]
            }
            HandClass::Cee12 | HandClass::Cee12Open | HandClass::CeeAll => {
                CANDIDATE_OPENINGS.map(|opening| (None, opening)).to_vec()
            }
            _ => CANDIDATE_THUMB_POSITIONS.map(|thumb| (thumb, None)).to_vec(),
        }
    };
    CANDIDATE_BENDS.into_iter().flat_map(move |bend| {
        CANDIDATE_HAND_CLASSES.into_iter().flat_map(move |class| {
            with(class).into_iter().map(move |(thumb, opening)| HandshapeForm {
                class,
                thumb,
                bend,
                opening,
            })
        })
    })
}

/// Returns the digits that may replace a class's own.
fn other_digits(class: HandClass) -> Vec<DigitList> {
    use HandDigit::{Index, Little, Middle, Ring};
    let sets: &[&[HandDigit]] = match class {
        HandClass::Finger2 => &[&[Middle], &[Ring], &[Little]],
        HandClass::Finger23 | HandClass::Finger23Spread => &[
            &[Index, Ring],
            &[Index, Little],
            &[Middle, Ring],
            &[Middle, Little],
            &[Ring, Little],
            &[Index, Middle, Ring],
            &[Middle, Ring, Little],
        ],
        HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::Cee12 | HandClass::Cee12Open => {
            &[&[Middle], &[Ring], &[Little], &[Index, Middle]]
        }
        _ => &[],
    };
    sets.iter().map(|digits| DigitList(digits.to_vec())).collect()
}

fn add_form_entry(entries: &mut Vec<FormAngles>, entry: FormAngles) {
    if entries
        .iter()
        .all(|old| mean_angle_difference(&old.angles, &entry.angles) > tuned().shape.same)
    {
        entries.push(entry);
    }
}

/// Returns whether the fingers of two forms are the same, whatever their thumbs are.
fn same_fingers(a: &FormAngles, b: &FormAngles) -> bool {
    let fingers = |form: &FormAngles| -> [f64; HandAngles::HAND_ANGLE_COUNT] {
        let mut angles = form.angles;
        angles[..5].fill(0.0);
        angles
    };
    mean_angle_difference(&fingers(a), &fingers(b)) < ALIKE_POSTURE_DEGREES
}

/// Returns the root of the mean square of the differences.
fn mean_angle_difference(a: &[f64; HandAngles::HAND_ANGLE_COUNT], b: &[f64; HandAngles::HAND_ANGLE_COUNT]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (squares / HandAngles::HAND_ANGLE_COUNT as f64).sqrt()
}

/// The weight of each of a hand's angles on a skeleton: zero if the joint is missing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KnownHandAngles([f64; HandAngles::HAND_ANGLE_COUNT]);

impl KnownHandAngles {
    /// Returns the weights for the hand of a side, and the joints it lacks.
    pub(super) fn known_angle_weights(anatomy: &BodyAnatomy, side: BodySide) -> (Self, Vec<BodyPart>) {
        let mut weights = [0.0; HandAngles::HAND_ANGLE_COUNT];
        let mut missing = Vec::new();
        let mut has = |part: BodyPart| {
            let there = anatomy.part_joint(part).is_some();
            if !there {
                missing.push(part);
            }
            there
        };
        let thumb = [0, 1, 2].map(|n| has(BodyPart::Thumb(side, n)));
        for (n, weight) in tuned().shape.thumb.into_iter().enumerate() {
            let there = thumb[n.saturating_sub(2)];
            weights[n] = if there { weight } else { 0.0 };
        }
        for finger in HandFinger::ALL_FINGERS {
            let first = 5 + 4 * finger.index();
            for joint in 1..4_u8 {
                if has(BodyPart::Finger(side, finger, joint)) {
                    let angle_index = first + usize::from(joint);
                    weights[angle_index] = tuned().shape.finger[usize::from(joint)];
                }
            }
            if weights[first + 1] > 0.0 {
                weights[first] = tuned().shape.finger[0];
            }
        }
        (Self(weights), missing)
    }

    /// Returns the difference of two postures: the root of the mean square over the known angles, in
    /// radians.
    pub(super) fn known_angle_difference(&self, a: &HandAngles, b: &HandAngles) -> f64 {
        let (a, b) = (a.to_array(), b.to_array());
        let squares = self.0.iter().zip(a.iter().zip(b));
        let sum: f64 = squares.map(|(w, (a, b))| w * (a - b) * (a - b)).sum();
        (sum / self.0.iter().sum::<f64>().max(1e-9)).sqrt()
    }

    /// Returns the share of a whole hand's weights that the skeleton shows.
    pub(super) fn known_weight_share(&self) -> f64 {
        self.0.iter().sum::<f64>() / Self::whole_hand_weights().0.iter().sum::<f64>()
    }

    /// A hand that has every joint.
    fn whole_hand_weights() -> Self {
        let mut weights = [0.0; HandAngles::HAND_ANGLE_COUNT];
        weights[..5].copy_from_slice(&tuned().shape.thumb);
        for slot in weights[5..].chunks_exact_mut(4) {
            slot.copy_from_slice(&tuned().shape.finger);
        }
        Self(weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_plain_form_is_recovered_or_replaced_by_one_that_looks_the_same() {
        let language = BodyLanguage::default_body_language();
        let (forms, known) = (
            HandFormTable::form_table_for(language),
            KnownHandAngles::whole_hand_weights(),
        );
        for form in plain_hand_forms().step_by(7) {
            let shape = bare_handshape(form);
            let hand = hand_angles(&shape, language);
            let found = forms.nearest_handshape(&hand, &known, 1.0).expect("found");
            assert!(
                is_same(&found.best, &shape, language),
                "{shape:?}\n{:?} {}",
                found.best,
                found.residual
            );
        }
    }

    #[test]
    fn in_between_forms_special_digits_and_exceptions_are_recovered() {
        let language = BodyLanguage::default_body_language();
        let (forms, known) = (
            HandFormTable::form_table_for(language),
            KnownHandAngles::whole_hand_weights(),
        );
        let of = |class, bend| HandshapeForm {
            class,
            bend,
            ..HandshapeForm::default()
        };
        let mut three = bare_handshape(of(HandClass::Finger2345, None));
        three.bends[4] = Some(FingerBend::DoubleHooked);
        let cases = [
            Handshape {
                between: Some(of(HandClass::Finger2345, None)),
                ..bare_handshape(of(HandClass::Flat, None))
            },
            Handshape {
                between: Some(of(HandClass::Flat, Some(FingerBend::Round))),
                ..bare_handshape(of(HandClass::Flat, None))
            },
            Handshape {
                special: DigitList(vec![HandDigit::Little]),
                ..bare_handshape(of(HandClass::Finger2, None))
            },
            three,
        ];
        for shape in cases {
            let hand = hand_angles(&shape, language);
            let found = forms.nearest_handshape(&hand, &known, 1.0).expect("found");
            assert!(
                is_same(&found.best, &shape, language),
                "{shape:?}\n{:?} {}",
                found.best,
                found.residual
            );
        }
    }

    #[test]
    fn a_thumb_that_lies_elsewhere_on_the_folded_fingers_does_not_add_a_form() {
        let language = BodyLanguage::default_body_language();
        let (forms, known) = (
            HandFormTable::form_table_for(language),
            KnownHandAngles::whole_hand_weights(),
        );
        let across = |class, bend| HandshapeForm {
            class,
            bend,
            thumb: Some(ThumbPosition::Across),
            ..HandshapeForm::default()
        };
        let pointing = bare_handshape(across(HandClass::Finger2, Some(FingerBend::Round)));
        let thumb = hand_angles(&bare_handshape(across(HandClass::Finger23, None)), language).to_array();
        let mut hand = hand_angles(&pointing, language).to_array();
        for (own, other) in hand[..5].iter_mut().zip(thumb) {
            *own = (*own + other) / 2.0;
        }
        let found = forms.nearest_handshape(&HandAngles::from_array(hand), &known, 1.0);
        assert_eq!(found.expect("found").best, pointing);
    }

    #[test]
    fn the_handshape_class_is_recognised_without_the_thumb_and_with_noise() {
        let language = BodyLanguage::default_body_language();
        let forms = HandFormTable::form_table_for(language);
        let mut known = KnownHandAngles::whole_hand_weights();
        known.0[..5].fill(0.0);
        for class in [HandClass::Flat, HandClass::Finger2, HandClass::Finger23Spread] {
            let mut all = hand_angles(&bare_handshape(of_class(class)), language).to_array();
            for (n, angle) in all.iter_mut().enumerate() {
                *angle += 0.09 * ((n * 7 + 3) as f64).sin();
            }
            let found = forms.nearest_handshape(&HandAngles::from_array(all), &known, 1.0);
            assert_eq!(found.expect("found").best.form.class, class);
        }
        known.0.fill(0.0);
        assert!(forms.nearest_handshape(&HandAngles::default(), &known, 1.0).is_none());
    }

    fn of_class(class: HandClass) -> HandshapeForm {
        HandshapeForm {
            class,
            ..HandshapeForm::default()
        }
    }
}
