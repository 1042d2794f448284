//! Kinds of movement, step by step.

use super::super::direction::Direction;
use super::super::tree::{
    Amount, Circular, Contact, Directed, Manner, Motion, MotionKind, Place, Posture, Repeat, Size,
    Symmetry, WristMotion,
};
use super::Value;

/// The simultaneous actions of a hand.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Step {
    pub(super) kinds: Vec<Value>,
    pub(super) directions: Vec<Value>,
    pub(super) sizes: Vec<Value>,
    pub(super) repetitions: Vec<Value>,
    pub(super) manners: Vec<Value>,
}

impl Step {
    pub(super) fn of(kind: Value) -> Self {
        Self {
            kinds: vec![kind],
            ..Self::default()
        }
    }

    /// Adds simultaneous actions.
    pub(super) fn join(&mut self, other: Self) {
        self.kinds.extend(other.kinds);
        self.directions.extend(other.directions);
        self.sizes.extend(other.sizes);
        self.repetitions.extend(other.repetitions);
        self.manners.extend(other.manners);
    }
}

/// Merges simultaneous courses, step by step.
pub(super) fn together(courses: Vec<Vec<Step>>) -> Vec<Step> {
    let mut whole: Vec<Step> = Vec::new();
    for course in courses {
        for (at, step) in course.into_iter().enumerate() {
            match whole.get_mut(at) {
                Some(known) => known.join(step),
                None => whole.push(step),
            }
        }
    }
    whole
}

/// Returns a motion without nested motions; `None` for others.
pub(super) fn simple(motion: &Motion, symmetry: Option<Symmetry>) -> Option<Step> {
    let mut step = match &motion.kind {
        MotionKind::Directed(directed) => straight_or_curved(directed, symmetry),
        MotionKind::Circular(circular) => round(circular),
        MotionKind::Wrist { motion, size } => {
            let mut step = Step::of(wrist(*motion));
            step.sizes = size_of(Amount {
                first: *size,
                second: None,
            });
            step
        }
        MotionKind::Cross { .. } => Step::of(Value::near("path")),
        MotionKind::FingerPlay(digits) if digits.is_empty() => Step::of(Value::exact("wiggle")),
        MotionKind::FingerPlay(_) => Step::of(Value::near("wiggle")),
        MotionKind::Still => Step::of(Value::exact("hold")),
        _ => return None,
    };
    step.manners = manners(&motion.manner);
    if motion.manner.alternating {
        step.repetitions.push(Value::exact("alternating"));
    }
    Some(step)
}

fn straight_or_curved(directed: &Directed, symmetry: Option<Symmetry>) -> Step {
    let kind = if directed.curve.is_some() {
        Value::exact("arc")
    } else if let Some(zigzag) = directed.zigzag {
        Value::exact(if zigzag.wavy { "wavy" } else { "zigzag" })
    } else {
        Value::exact("straight")
    };
    let direction = through(directed.direction, symmetry).to_string();
    let exact = directed.second.is_none();
    Step {
        directions: vec![Value {
            word: direction,
            exact,
        }],
        sizes: size_of(directed.size),
        ..Step::of(kind)
    }
}

/// Returns the direction that the other hand takes by a symmetry.
pub(super) fn through(direction: Direction, symmetry: Option<Symmetry>) -> Direction {
    let Some(symmetry) = symmetry else {
        return direction;
    };
    let [left, up, out] = direction.vector();
    let part = |flipped: bool, part: f64| {
        let sign = if part.abs() < 1e-9 {
            0
        } else if part > 0.0 {
            1
        } else {
            -1
        };
        if flipped { -sign } else { sign }
    };
    let parts = (
        part(symmetry.up_down, up),
        part(symmetry.out_in, out),
        part(symmetry.left_right, left),
    );
    Direction::from_parts(parts.0, parts.1, parts.2).unwrap_or(direction)
}

fn round(circular: &Circular) -> Step {
    let kind = if circular.growth.is_some() {
        "spiral"
    } else {
        "circle"
    };
    let mut step = Step::of(Value::exact(kind));
    step.sizes = size_of(circular.size);
    step
}

fn wrist(motion: WristMotion) -> Value {
    match motion {
        WristMotion::Nodding => Value::exact("nodding"),
        WristMotion::Swinging => Value::exact("swinging"),
        WristMotion::Twisting => Value::exact("twisting"),
        WristMotion::StirCw | WristMotion::StirCcw => Value::near("stirring"),
    }
}

fn size_of(amount: Amount) -> Vec<Value> {
    let word = match amount.first {
        Some(Size::Small) => "small",
        Some(Size::Big) => "large",
        None => "normal",
    };
    let exact = amount
        .second
        .is_none_or(|second| Some(second) == amount.first);
    let word = word.to_owned();
    vec![Value { word, exact }]
}

/// Returns the marked manners.
pub(super) fn manners(manner: &Manner) -> Vec<Value> {
    [
        (manner.fast, "fast"),
        (manner.slow, "slow"),
        (manner.tense, "tense"),
        (manner.rest, "rest"),
        (manner.halt, "halt"),
    ]
    .into_iter()
    .filter(|(marked, _)| *marked)
    .map(|(_, word)| Value::exact(word))
    .collect()
}

/// Returns the value for a kind of repetition.
pub(super) fn repetition(repeat: Repeat) -> Value {
    match repeat {
        Repeat::FromStart => Value::exact("twice"),
        Repeat::FromStartSeveral => Value::exact("several"),
        Repeat::ToFro | Repeat::Reverse => Value::exact("back-and-forth"),
        Repeat::ManyRandom => Value::near("several"),
        Repeat::Continue => Value::exact("continued"),
        Repeat::ContinueSeveral => Value::exact("continued-several"),
        Repeat::Swap => Value::near("alternating"),
    }
}

/// Returns the kind of contact that a target makes.
pub(super) fn contact(posture: &Posture) -> Option<Value> {
    let contact = match posture.place.as_ref()? {
        Place::Body(place) => place.contact,
        Place::Hand(site) => site.contact,
        Place::Hands(hands) => hands.contact,
        Place::Split(..) | Place::Named(_) => None,
    };
    match contact? {
        Contact::Touch => Some(Value::exact("contact")),
        Contact::Brushing => Some(Value::exact("brush")),
        Contact::Interlock => Some(Value::exact("grasp")),
        Contact::Cross | Contact::Close | Contact::ArmExtended => None,
    }
}
