//! Handshapes: finds the nearest form by joint angles.

use std::sync::{Arc, Mutex, PoisonError};

use chereme_motion::{Anatomy, Finger, HandAngles, Part, Side};
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::{
    Bend, BodyLanguage, Digit, Digits, Form, HandClass, Handshape, Opening, ThumbPosition,
};

use super::Found;
use crate::transcribe::tuned::tuned;

const CLASSES: [HandClass; 12] = [
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
const THUMBS: [Option<ThumbPosition>; 4] = [
    None,
    Some(ThumbPosition::Out),
    Some(ThumbPosition::Across),
    Some(ThumbPosition::Opposed),
];
const BENDS: [Option<Bend>; 7] = [
    None,
    Some(Bend::Bent),
    Some(Bend::Round),
    Some(Bend::Hooked),
    Some(Bend::DoubleBent),
    Some(Bend::DoubleHooked),
    Some(Bend::HalfBent),
];
const OPENINGS: [Option<Opening>; 3] = [None, Some(Opening::Tight), Some(Opening::Slack)];

/// Postures that differ by less than this (degrees) look the same.
const ALIKE: f64 = 1.0;

/// An entry of the table: a form with its angles in degrees.
#[derive(Debug)]
struct FormAngles {
    shape: Handshape,
    angles: [f64; HandAngles::LEN],
    cost: f64,
}

/// The table of all candidate handshapes: every form of every class, and half-way between any two of the
/// plain ones.
#[derive(Debug)]
pub(super) struct Forms {
    language: BodyLanguage,
    entries: Vec<FormAngles>,
}

impl Forms {
    /// Returns the table for a body language; the last one is cached.
    pub(super) fn of(language: &BodyLanguage) -> Arc<Self> {
        static LAST: Mutex<Option<Arc<Forms>>> = Mutex::new(None);
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(forms) = last.as_ref().filter(|forms| forms.language == *language) {
            return Arc::clone(forms);
        }
        let forms = Arc::new(Self::made(language));
        *last = Some(Arc::clone(&forms));
        forms
    }

    fn made(language: &BodyLanguage) -> Self {
        let mut entries: Vec<FormAngles> = Vec::new();
        let entry = |shape: Handshape, cost: f64| {
            let angles = hand_angles(&shape, language)
                .to_array()
                .map(f64::to_degrees);
            FormAngles {
                shape,
                angles,
                cost,
            }
        };
        for form in plain() {
            add(&mut entries, entry(bare(form), 0.0));
        }
        let forms: Vec<Form> = entries.iter().map(|entry| entry.shape.form).collect();
        let plain_forms = entries.len();
        for (n, &first) in forms.iter().enumerate() {
            for &second in &forms[n + 1..] {
                let shape = Handshape {
                    between: Some(second),
                    ..bare(first)
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
        for form in plain() {
            for digits in other_digits(form.class) {
                let shape = Handshape {
                    special: digits,
                    ..bare(form)
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
    pub(super) fn nearest(
        &self,
        hand: &HandAngles,
        known: &Known,
        loose: f64,
    ) -> Option<Found<Handshape>> {
        let total: f64 = known.0.iter().sum();
        if total <= 0.0 {
            return None;
        }
        let own = hand.to_array().map(f64::to_degrees);
        let off = |angles: &[f64; HandAngles::LEN]| -> f64 {
            let squares = own.iter().zip(angles).zip(&known.0);
            let sum: f64 = squares.map(|((a, b), w)| w * (a - b) * (a - b)).sum();
            (sum / total).sqrt()
        };
        let scored =
            |residual: f64, cost: f64| (residual + tuned().shape.floor) * (1.0 + loose * cost);
        let residuals: Vec<f64> = self
            .entries
            .iter()
            .map(|entry| off(&entry.angles))
            .collect();
        let score = |n: usize| scored(residuals[n], self.entries[n].cost);
        let all = 0..self.entries.len();
        let best = all.clone().min_by(|&a, &b| score(a).total_cmp(&score(b)))?;
        let mut found = Tried {
            score: score(best),
            residual: residuals[best],
            shape: self.entries[best].shape.clone(),
            cost: self.entries[best].cost,
        };
        for n in self.best_without_fingers(&own, known) {
            let entry = &self.entries[n];
            let mut tried = Tried {
                score: score(n),
                residual: residuals[n],
                shape: entry.shape.clone(),
                cost: entry.cost,
            };
            while let Some(next) = self.excepted(&tried, hand, known, &off, &scored) {
                tried = next;
            }
            if tried.score < found.score {
                found = tried;
            }
        }
        let runner_up = all
            .filter(|&n| !related(&self.entries[n].shape, &found.shape))
            .min_by(|&a, &b| score(a).total_cmp(&score(b)))
            .map(|n| (self.entries[n].shape.clone(), residuals[n]));
        Some(Found {
            best: found.shape,
            residual: found.residual,
            runner_up,
        })
    }

    /// Returns the indices of the forms that fit best without their worst finger, and of those that fit best without their
    /// two worst; the thumb always counts.
    fn best_without_fingers(&self, own: &[f64; HandAngles::LEN], known: &Known) -> Vec<usize> {
        let mut near: [Vec<(f64, usize)>; 2] = [Vec::new(), Vec::new()];
        for (n, entry) in self.entries.iter().enumerate() {
            if entry.shape.between.is_some() {
                continue;
            }
            let part = |range: std::ops::Range<usize>| -> f64 {
                range
                    .map(|k| known.0[k] * (own[k] - entry.angles[k]).powi(2))
                    .sum()
            };
            let mut fingers = [0, 1, 2, 3].map(|finger| part(5 + 4 * finger..9 + 4 * finger));
            fingers.sort_by(f64::total_cmp);
            let thumb = part(0..5);
            near[0].push((thumb + fingers[0] + fingers[1] + fingers[2], n));
            near[1].push((thumb + fingers[0] + fingers[1], n));
        }
        let mut found = Vec::new();
        for near in &mut near {
            let few = tuned().shape.tried.min(near.len());
            if few < near.len() {
                near.select_nth_unstable_by(few, |a, b| a.0.total_cmp(&b.0));
            }
            found.extend(near[..few].iter().map(|(_, n)| *n));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns the handshape with a separate notation for one digit, if that fits better.
    fn excepted(
        &self,
        from: &Tried,
        hand: &HandAngles,
        known: &Known,
        off: &impl Fn(&[f64; HandAngles::LEN]) -> f64,
        scored: &impl Fn(f64, f64) -> f64,
    ) -> Option<Tried> {
        let now = hand_angles(&from.shape, &self.language);
        let mut better: Option<Tried> = None;
        for finger in Finger::ALL {
            let n = finger.index();
            let weight = &known.0[5 + 4 * n..9 + 4 * n];
            let apart = (0..3).map(|joint| {
                let off = hand.fingers[n].flexion[joint] - now.fingers[n].flexion[joint];
                off.to_degrees().abs() * weight[joint + 1].min(1.0)
            });
            if from.shape.bends[n + 1].is_some() || apart.fold(0.0, f64::max) < tuned().shape.odd {
                continue;
            }
            for bend in BENDS.into_iter().flatten() {
                let mut shape = from.shape.clone();
                shape.bends[n + 1] = Some(bend);
                let angles = hand_angles(&shape, &self.language).to_array();
                let residual = off(&angles.map(f64::to_degrees));
                let cost = from.cost + tuned().shape.costs[2];
                let score = scored(residual, cost);
                let least = better.as_ref().map_or(from.score, |found| found.score);
                if score < least {
                    better = Some(Tried {
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
struct Tried {
    score: f64,
    residual: f64,
    shape: Handshape,
    cost: f64,
}

/// Returns whether two handshapes look the same to within a fraction of a degree.
pub(super) fn is_same(a: &Handshape, b: &Handshape, language: &BodyLanguage) -> bool {
    let degrees = |shape| hand_angles(shape, language).to_array().map(f64::to_degrees);
    apart(&degrees(a), &degrees(b)) < ALIKE
}

/// Returns whether two handshapes have a form in common.
fn related(a: &Handshape, b: &Handshape) -> bool {
    let forms = |shape: &Handshape| [Some(shape.form), shape.between];
    let shares = forms(a)
        .iter()
        .flatten()
        .any(|form| forms(b).contains(&Some(*form)));
    shares && a.special == b.special
}

fn bare(form: Form) -> Handshape {
    Handshape {
        form,
        ..Handshape::default()
    }
}

/// Returns every class with every thumb position or opening and every bend, the simpler first.
fn plain() -> impl Iterator<Item = Form> {
    let with = |class: HandClass| -> Vec<(Option<ThumbPosition>, Option<Opening>)> {
        match class {
            HandClass::Pinch12 | HandClass::Pinch12Open | HandClass::PinchAll => {
                vec![(None, None)]
            }
            HandClass::Cee12 | HandClass::Cee12Open | HandClass::CeeAll => {
                OPENINGS.map(|opening| (None, opening)).to_vec()
            }
            _ => THUMBS.map(|thumb| (thumb, None)).to_vec(),
        }
    };
    BENDS.into_iter().flat_map(move |bend| {
        CLASSES.into_iter().flat_map(move |class| {
            with(class).into_iter().map(move |(thumb, opening)| Form {
                class,
                thumb,
                bend,
                opening,
            })
        })
    })
}

/// Returns the digits that may replace a class's own.
fn other_digits(class: HandClass) -> Vec<Digits> {
    use Digit::{Index, Little, Middle, Ring};
    let sets: &[&[Digit]] = match class {
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
    sets.iter().map(|digits| Digits(digits.to_vec())).collect()
}

fn add(entries: &mut Vec<FormAngles>, entry: FormAngles) {
    if entries
        .iter()
        .all(|old| apart(&old.angles, &entry.angles) > tuned().shape.same)
    {
        entries.push(entry);
    }
}

/// Returns whether the fingers of two forms are the same, whatever their thumbs are.
fn same_fingers(a: &FormAngles, b: &FormAngles) -> bool {
    let fingers = |form: &FormAngles| -> [f64; HandAngles::LEN] {
        let mut angles = form.angles;
        angles[..5].fill(0.0);
        angles
    };
    apart(&fingers(a), &fingers(b)) < ALIKE
}

/// Returns the root of the mean square of the differences.
fn apart(a: &[f64; HandAngles::LEN], b: &[f64; HandAngles::LEN]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (squares / HandAngles::LEN as f64).sqrt()
}

/// The weight of each of a hand's angles on a skeleton: zero if the joint is missing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Known([f64; HandAngles::LEN]);

impl Known {
    /// Returns the weights for the hand of a side, and the joints it lacks.
    pub(super) fn of(anatomy: &Anatomy, side: Side) -> (Self, Vec<Part>) {
        let mut weights = [0.0; HandAngles::LEN];
        let mut missing = Vec::new();
        let mut has = |part: Part| {
            let there = anatomy.joint(part).is_some();
            if !there {
                missing.push(part);
            }
            there
        };
        let thumb = [0, 1, 2].map(|n| has(Part::Thumb(side, n)));
        for (n, weight) in tuned().shape.thumb.into_iter().enumerate() {
            let there = thumb[n.saturating_sub(2)];
            weights[n] = if there { weight } else { 0.0 };
        }
        for finger in Finger::ALL {
            let first = 5 + 4 * finger.index();
            for joint in 1..4_u8 {
                if has(Part::Finger(side, finger, joint)) {
                    let at = first + usize::from(joint);
                    weights[at] = tuned().shape.finger[usize::from(joint)];
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
    pub(super) fn apart(&self, a: &HandAngles, b: &HandAngles) -> f64 {
        let (a, b) = (a.to_array(), b.to_array());
        let squares = self.0.iter().zip(a.iter().zip(b));
        let sum: f64 = squares.map(|(w, (a, b))| w * (a - b) * (a - b)).sum();
        (sum / self.0.iter().sum::<f64>().max(1e-9)).sqrt()
    }

    /// A hand that has every joint.
    #[cfg(test)]
    fn whole() -> Self {
        let mut weights = [0.0; HandAngles::LEN];
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
        let language = BodyLanguage::usual();
        let (forms, known) = (Forms::of(language), Known::whole());
        for form in plain().step_by(7) {
            let shape = bare(form);
            let hand = hand_angles(&shape, language);
            let found = forms.nearest(&hand, &known, 1.0).expect("found");
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
        let language = BodyLanguage::usual();
        let (forms, known) = (Forms::of(language), Known::whole());
        let of = |class, bend| Form {
            class,
            bend,
            ..Form::default()
        };
        let mut three = bare(of(HandClass::Finger2345, None));
        three.bends[4] = Some(Bend::DoubleHooked);
        let cases = [
            Handshape {
                between: Some(of(HandClass::Finger2345, None)),
                ..bare(of(HandClass::Flat, None))
            },
            Handshape {
                between: Some(of(HandClass::Flat, Some(Bend::Round))),
                ..bare(of(HandClass::Flat, None))
            },
            Handshape {
                special: Digits(vec![Digit::Little]),
                ..bare(of(HandClass::Finger2, None))
            },
            three,
        ];
        for shape in cases {
            let hand = hand_angles(&shape, language);
            let found = forms.nearest(&hand, &known, 1.0).expect("found");
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
        let language = BodyLanguage::usual();
        let (forms, known) = (Forms::of(language), Known::whole());
        let across = |class, bend| Form {
            class,
            bend,
            thumb: Some(ThumbPosition::Across),
            ..Form::default()
        };
        let pointing = bare(across(HandClass::Finger2, Some(Bend::Round)));
        let thumb = hand_angles(&bare(across(HandClass::Finger23, None)), language).to_array();
        let mut hand = hand_angles(&pointing, language).to_array();
        for (own, other) in hand[..5].iter_mut().zip(thumb) {
            *own = (*own + other) / 2.0;
        }
        let found = forms.nearest(&HandAngles::from_array(hand), &known, 1.0);
        assert_eq!(found.expect("found").best, pointing);
    }

    #[test]
    fn the_handshape_class_is_recognised_without_the_thumb_and_with_noise() {
        let language = BodyLanguage::usual();
        let forms = Forms::of(language);
        let mut known = Known::whole();
        known.0[..5].fill(0.0);
        for class in [
            HandClass::Flat,
            HandClass::Finger2,
            HandClass::Finger23Spread,
        ] {
            let mut all = hand_angles(&bare(of_class(class)), language).to_array();
            for (n, angle) in all.iter_mut().enumerate() {
                *angle += 0.09 * ((n * 7 + 3) as f64).sin();
            }
            let found = forms.nearest(&HandAngles::from_array(all), &known, 1.0);
            assert_eq!(found.expect("found").best.form.class, class);
        }
        known.0.fill(0.0);
        assert!(forms.nearest(&HandAngles::default(), &known, 1.0).is_none());
    }

    fn of_class(class: HandClass) -> Form {
        Form {
            class,
            ..Form::default()
        }
    }
}
