//! Follows each hand through a sign.

use super::super::direction::{Compass, Direction};
use super::super::tree::{
    Aim, Each, HandsUsed, Handshape, Manual, Motion, MotionKind, Posture, Symmetry,
};
use super::motion::{self, Step};
use super::place::{Whose, placement};
use super::shape::{Shapes, openness};
use super::{Lost, Value};
use crate::component::Component;

/// The actions of both hands, in order of time.
pub(super) struct Hands<'s, 'i> {
    shapes: &'s Shapes<'i>,
    dominant: Hand,
    weak: Hand,
}

/// The successive values of one field.
pub(super) type Course = (Component, Option<&'static str>, Vec<Vec<Value>>);

/// The shapes and actions of one hand.
#[derive(Debug, Default)]
struct Hand {
    shape: Option<Handshape>,
    shapes: Vec<Vec<Value>>,
    fingers: Vec<Vec<Value>>,
    palms: Vec<Vec<Value>>,
    places: Vec<Vec<Value>>,
    steps: Vec<Step>,
    acts: bool,
}

/// The hands that a notation concerns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Acting {
    Dominant,
    Weak,
    Both(Symmetry),
}

impl Acting {
    /// Returns the acting hands, each with the symmetry that applies to its notation.
    fn hands(self) -> impl Iterator<Item = (bool, Option<Symmetry>)> {
        let (dominant, weak) = match self {
            Self::Dominant => (Some((true, None)), None),
            Self::Weak => (None, Some((false, None))),
            Self::Both(symmetry) => (Some((true, None)), Some((false, Some(symmetry)))),
        };
        dominant.into_iter().chain(weak)
    }
}

impl<'s, 'i> Hands<'s, 'i> {
    pub(super) fn new(shapes: &'s Shapes<'i>) -> Self {
        Self {
            shapes,
            dominant: Hand::default(),
            weak: Hand::default(),
        }
    }

    /// Processes one part of a sign.
    pub(super) fn part(&mut self, part: &Manual, lost: &mut Lost) {
        let acting = match part.hands {
            HandsUsed::Dominant => Acting::Dominant,
            HandsUsed::Nondominant => Acting::Weak,
            HandsUsed::Both(symmetry) => Acting::Both(symmetry),
        };
        if !part.body.is_empty() {
            lost.add("movement: what the body does");
        }
        self.posture(&part.posture, acting, lost);
        if part.posture.place.is_none() && !part.holdover {
            for (dominant, _) in acting.hands() {
                let hand = self.hand(dominant);
                if hand.places.is_empty() {
                    hand.places.push(vec![Value::exact("neutral")]);
                }
            }
        }
        for action in &part.actions {
            let steps = self.motion(action, acting, lost);
            self.take(steps, acting);
        }
    }

    /// Returns the successive values of each field, for the dominant and for the weak hand.
    pub(super) fn courses(self) -> [Vec<Course>; 2] {
        [self.dominant.courses(), self.weak.courses()]
    }

    fn hand(&mut self, dominant: bool) -> &mut Hand {
        if dominant {
            &mut self.dominant
        } else {
            &mut self.weak
        }
    }

    fn take(&mut self, steps: [Vec<Step>; 2], acting: Acting) {
        let [dominant, weak] = steps;
        self.dominant.steps.extend(dominant);
        self.weak.steps.extend(weak);
        for (dominant, symmetry) in acting.hands() {
            let hand = self.hand(dominant);
            hand.acts = true;
            if symmetry.is_some_and(|symmetry| symmetry.out_of_phase) {
                for step in &mut hand.steps {
                    step.repetitions.push(Value::exact("alternating"));
                }
            }
        }
    }

    fn posture(&mut self, posture: &Posture, acting: Acting, lost: &mut Lost) {
        for (dominant, notated) in of_hands(&posture.shape, acting) {
            let value = self.shapes.nearest(notated.0, lost);
            let hand = self.hand(dominant);
            hand.acts = true;
            hand.shape = Some(notated.0.clone());
            hand.shapes.extend(value.map(|value| vec![value]));
        }
        for (dominant, (aim, symmetry)) in of_hands(&posture.extended, acting) {
            let to = |direction: Direction| motion::through(direction, symmetry).to_string();
            let value = aimed(aim, to(aim.first), "fingers", lost);
            self.hand(dominant).fingers.push(vec![value]);
        }
        for (dominant, (aim, symmetry)) in of_hands(&posture.palm, acting) {
            let flipped = symmetry.is_some_and(|symmetry| symmetry.left_right);
            let to = |palm: Compass| if flipped { palm.mirrored() } else { palm };
            let value = aimed(aim, to(aim.first).letters().to_owned(), "palm", lost);
            self.hand(dominant).palms.push(vec![value]);
        }
        if let Some(place) = &posture.place {
            let two = matches!(place, super::super::tree::Place::Split(..));
            let both = [(true, None), (false, None)];
            let whose: Vec<_> = if two {
                both.to_vec()
            } else {
                acting.hands().collect()
            };
            for (dominant, symmetry) in whose {
                let mirrored = symmetry.is_some_and(|s| s.left_right || !s.real_space);
                let whose = Whose { dominant, mirrored };
                if let Some(value) = placement(place, whose, lost) {
                    self.hand(dominant).places.push(vec![value]);
                }
            }
        }
    }

    /// Returns the steps of each hand in a motion; the postures it leads to are included.
    fn motion(&mut self, motion: &Motion, acting: Acting, lost: &mut Lost) -> [Vec<Step>; 2] {
        let mut steps = match &motion.kind {
            MotionKind::Split(dominant, other) => {
                let mut half = |motion: &Option<Box<Motion>>, acting| match motion {
                    Some(motion) => self.motion(motion, acting, lost),
                    None => [Vec::new(), Vec::new()],
                };
                let [dominant, _] = half(dominant, Acting::Dominant);
                let [_, weak] = half(other, Acting::Weak);
                [dominant, weak]
            }
            MotionKind::Sequence { motions, .. } => {
                let mut whole = [Vec::new(), Vec::new()];
                for motion in motions {
                    let own = self.motion(motion, acting, lost);
                    for (whole, own) in whole.iter_mut().zip(own) {
                        whole.extend(own);
                    }
                }
                whole
            }
            MotionKind::Parallel(motions) => {
                let (mut dominant, mut weak) = (Vec::new(), Vec::new());
                for motion in motions {
                    let [one, other] = self.motion(motion, acting, lost);
                    dominant.push(one);
                    weak.push(other);
                }
                [motion::together(dominant), motion::together(weak)]
            }
            MotionKind::Target { motion, posture } => {
                self.target(motion.as_deref(), posture, acting, lost)
            }
            MotionKind::Repeated { motion, repetition } => {
                let mut steps = self.motion(motion, acting, lost);
                if repetition.growth.is_some() || repetition.shift.is_some() || repetition.approx {
                    lost.add("movement.repetition: how it changes");
                }
                let second = repetition.second.map(motion::repetition);
                for step in steps.iter_mut().flatten() {
                    step.repetitions.push(motion::repetition(repetition.repeat));
                    step.repetitions.extend(second.clone());
                    let tapped = |kind: &mut Value| kind.word == "contact";
                    for kind in step
                        .kinds
                        .iter_mut()
                        .filter_map(|it| tapped(it).then_some(it))
                    {
                        "tap".clone_into(&mut kind.word);
                    }
                }
                steps
            }
            MotionKind::Body(_) => {
                lost.add("movement: what the body does");
                [Vec::new(), Vec::new()]
            }
            _ => {
                let mut steps = [Vec::new(), Vec::new()];
                for (dominant, symmetry) in acting.hands() {
                    steps[usize::from(!dominant)].extend(motion::simple(motion, symmetry));
                }
                return steps;
            }
        };
        for step in steps.iter_mut().flatten() {
            step.manners.extend(motion::manners(&motion.manner));
            if motion.manner.alternating {
                step.repetitions.push(Value::exact("alternating"));
            }
        }
        steps
    }

    fn target(
        &mut self,
        path: Option<&Motion>,
        posture: &Posture,
        acting: Acting,
        lost: &mut Lost,
    ) -> [Vec<Step>; 2] {
        let mut steps = match path {
            Some(path) => self.motion(path, acting, lost),
            None => self.change(posture, acting),
        };
        if let Some(contact) = motion::contact(posture) {
            for (dominant, _) in acting.hands() {
                if let Some(last) = steps[usize::from(!dominant)].last_mut() {
                    last.kinds.push(contact.clone());
                }
            }
        }
        self.posture(posture, acting, lost);
        steps
    }

    /// Returns the steps to a posture without a motion of its own.
    fn change(&self, posture: &Posture, acting: Acting) -> [Vec<Step>; 2] {
        let mut steps = [Vec::new(), Vec::new()];
        for (dominant, (shape, _)) in of_hands(&posture.shape, acting) {
            let before = if dominant { &self.dominant } else { &self.weak };
            let before = before.shape.as_ref();
            let kind = match before {
                Some(before) if before.form.class == shape.form.class => "bending",
                Some(before) if openness(before) < openness(shape) => "opening",
                Some(_) => "closing",
                None => "finger",
            };
            steps[usize::from(!dominant)].push(Step::of(Value::exact(kind)));
        }
        let turned =
            |changes: &mut dyn Iterator<Item = bool>, word: &str, steps: &mut [Vec<Step>; 2]| {
                for dominant in changes {
                    let own = &mut steps[usize::from(!dominant)];
                    let step = Step::of(Value::near(word));
                    match own.last_mut() {
                        Some(last) => last.join(step),
                        None => own.push(step),
                    }
                }
            };
        let palms: Vec<bool> = of_hands(&posture.palm, acting)
            .map(|(hand, _)| hand)
            .collect();
        let fingers: Vec<bool> = of_hands(&posture.extended, acting)
            .map(|(hand, _)| hand)
            .collect();
        if palms.is_empty() {
            turned(&mut fingers.into_iter(), "wrist", &mut steps);
        } else {
            turned(&mut palms.into_iter(), "twisting", &mut steps);
        }
        steps
    }
}

/// Returns each hand's notated value, with the symmetry that applies to it.
fn of_hands<T>(
    notated: &Each<T>,
    acting: Acting,
) -> impl Iterator<Item = (bool, (&T, Option<Symmetry>))> {
    let shared = match notated {
        Each::Shared(one) => Some(one),
        _ => None,
    };
    let split = match notated {
        Each::Split(dominant, other) => [(true, dominant.as_ref()), (false, other.as_ref())],
        _ => [(true, None), (false, None)],
    };
    let split = split
        .into_iter()
        .filter_map(|(hand, one)| Some((hand, (one?, None))));
    let shared = shared.into_iter().flat_map(move |one| {
        let hands = acting.hands();
        hands.map(move |(hand, symmetry)| (hand, (one, symmetry)))
    });
    shared.chain(split)
}

fn aimed<D: PartialEq>(aim: &Aim<D>, word: String, what: &str, lost: &mut Lost) -> Value {
    let between = aim
        .second
        .as_ref()
        .is_some_and(|second| *second != aim.first);
    if between {
        lost.add(format!("orientation.{what}: half-way between two"));
    }
    let exact = !between && !aim.approx;
    Value { word, exact }
}

impl Hand {
    fn courses(self) -> Vec<Course> {
        let mut steps = self.steps;
        if steps.is_empty() && self.acts {
            steps.push(Step::of(Value::exact("hold")));
        }
        let moving = steps.iter().any(|step| {
            let still = |kind: &Value| kind.word == "hold";
            !step.kinds.iter().all(still)
        });
        let once = || vec![Value::exact("once")];
        let mut features: [Vec<Vec<Value>>; 5] = Default::default();
        for mut step in steps {
            if step.repetitions.is_empty() && moving {
                step.repetitions = once();
            }
            let Step {
                kinds,
                directions,
                sizes,
                repetitions,
                manners,
            } = step;
            for (list, own) in
                features
                    .iter_mut()
                    .zip([kinds, directions, sizes, repetitions, manners])
            {
                if !own.is_empty() {
                    list.push(own);
                }
            }
        }
        let [kinds, directions, sizes, repetitions, manners] = features;
        vec![
            (Component::Configuration, None, self.shapes),
            (Component::Orientation, Some("fingers"), self.fingers),
            (Component::Orientation, Some("palm"), self.palms),
            (Component::Placement, None, self.places),
            (Component::Movement, None, kinds),
            (Component::Movement, Some("direction"), directions),
            (Component::Movement, Some("size"), sizes),
            (Component::Movement, Some("repetition"), repetitions),
            (Component::Movement, Some("manner"), manners),
        ]
    }
}
