//! Kinds of movement, step by step.

use super::super::direction::SpatialDirection;
use super::super::tree::{
    CircularPath, DirectedPath, HandPlace, HandSymmetry, MotionKind, MotionManner, MotionSize, NotatedMotion,
    NotatedPosture, PlaceContact, RepeatKind, SizeAmount, WristMotion,
};
use super::ComponentWord;

/// The simultaneous actions of a hand.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct MotionStep {
    pub(super) kinds: Vec<ComponentWord>,
    pub(super) directions: Vec<ComponentWord>,
    pub(super) sizes: Vec<ComponentWord>,
    pub(super) repetitions: Vec<ComponentWord>,
    pub(super) manners: Vec<ComponentWord>,
}

impl MotionStep {
    pub(super) fn from_motion_value(kind: ComponentWord) -> Self {
        Self {
            kinds: vec![kind],
            ..Self::default()
        }
    }

    /// Adds simultaneous actions.
    pub(super) fn join_motion_step(&mut self, other: Self) {
        self.kinds.extend(other.kinds);
        self.directions.extend(other.directions);
        self.sizes.extend(other.sizes);
        self.repetitions.extend(other.repetitions);
        self.manners.extend(other.manners);
    }
}

/// Merges simultaneous courses, step by step.
pub(super) fn merge_step_courses(courses: Vec<Vec<MotionStep>>) -> Vec<MotionStep> {
    let mut merged_steps: Vec<MotionStep> = Vec::new();
    for course in courses {
        for (at, step) in course.into_iter().enumerate() {
            match merged_steps.get_mut(at) {
                Some(known) => known.join_motion_step(step),
                None => merged_steps.push(step),
            }
        }
    }
    merged_steps
}

/// Returns a motion without nested motions; `None` for others.
pub(super) fn simple_motion_step(motion: &NotatedMotion, symmetry: Option<HandSymmetry>) -> Option<MotionStep> {
    let mut step = match &motion.kind {
        MotionKind::Directed(directed) => straight_or_curved(directed, symmetry),
        MotionKind::Circular(circular) => circular_motion_step(circular),
        MotionKind::Wrist { motion, size } => {
            let mut step = MotionStep::from_motion_value(wrist_motion_value(*motion));
            step.sizes = size_of(SizeAmount {
                first: *size,
                second: None,
            });
            step
        }
        // Two crossing paths have no value of their own, so that the nearest one stands for them.
        MotionKind::Cross { .. } => MotionStep::from_motion_value(ComponentWord::approximate_value("path")),
        MotionKind::FingerPlay(digits) if digits.is_empty() => {
            MotionStep::from_motion_value(ComponentWord::exact_value("wiggle"))
        }
        // The inventory does not say which fingers wiggle.
        MotionKind::FingerPlay(_) => MotionStep::from_motion_value(ComponentWord::approximate_value("wiggle")),
        MotionKind::Still => MotionStep::from_motion_value(ComponentWord::exact_value("hold")),
        _ => return None,
    };
    step.manners = manner_values(&motion.manner);
    if motion.manner.alternating {
        step.repetitions.push(ComponentWord::exact_value("alternating"));
    }
    Some(step)
}

fn straight_or_curved(directed: &DirectedPath, symmetry: Option<HandSymmetry>) -> MotionStep {
    let kind = if directed.curve.is_some() {
        ComponentWord::exact_value("arc")
    } else if let Some(zigzag) = directed.zigzag {
        ComponentWord::exact_value(if zigzag.wavy { "wavy" } else { "zigzag" })
    } else {
        ComponentWord::exact_value("straight")
    };
    let direction = symmetric_direction(directed.direction, symmetry).to_string();
    let exact = directed.second.is_none();
    MotionStep {
        directions: vec![ComponentWord { word: direction, exact }],
        sizes: size_of(directed.size),
        ..MotionStep::from_motion_value(kind)
    }
}

/// Returns the direction that the other hand takes by a symmetry.
pub(super) fn symmetric_direction(direction: SpatialDirection, symmetry: Option<HandSymmetry>) -> SpatialDirection {
    let Some(symmetry) = symmetry else {
        return direction;
    };
    let [left, up, out] = direction.spatial_direction_vector();
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
    SpatialDirection::from_parts(parts.0, parts.1, parts.2).unwrap_or(direction)
}

fn circular_motion_step(circular: &CircularPath) -> MotionStep {
    let kind = if circular.growth.is_some() { "spiral" } else { "circle" };
    let mut step = MotionStep::from_motion_value(ComponentWord::exact_value(kind));
    step.sizes = size_of(circular.size);
    step
}

fn wrist_motion_value(motion: WristMotion) -> ComponentWord {
    match motion {
        WristMotion::Nodding => ComponentWord::exact_value("nodding"),
        WristMotion::Swinging => ComponentWord::exact_value("swinging"),
        WristMotion::Twisting => ComponentWord::exact_value("twisting"),
        WristMotion::StirCw | WristMotion::StirCcw => ComponentWord::approximate_value("stirring"),
    }
}

fn size_of(amount: SizeAmount) -> Vec<ComponentWord> {
    let word = match amount.first {
        Some(MotionSize::Small) => "small",
        Some(MotionSize::Big) => "large",
        None => "normal",
    };
    let exact = amount.second.is_none_or(|second| Some(second) == amount.first);
    let word = word.to_owned();
    vec![ComponentWord { word, exact }]
}

/// Returns the marked manners.
pub(super) fn manner_values(manner: &MotionManner) -> Vec<ComponentWord> {
    [
        (manner.fast, "fast"),
        (manner.slow, "slow"),
        (manner.tense, "tense"),
        (manner.rest, "rest"),
        (manner.halt, "halt"),
    ]
    .into_iter()
    .filter(|(marked, _)| *marked)
    .map(|(_, word)| ComponentWord::exact_value(word))
    .collect()
}

/// Returns the value for a kind of repetition.
pub(super) fn repetition_value(repeat: RepeatKind) -> ComponentWord {
    match repeat {
        RepeatKind::FromStart => ComponentWord::exact_value("twice"),
        RepeatKind::FromStartSeveral => ComponentWord::exact_value("several"),
        RepeatKind::ToFro | RepeatKind::Reverse => ComponentWord::exact_value("back-and-forth"),
        RepeatKind::ManyRandom => ComponentWord::approximate_value("several"),
        RepeatKind::Continue => ComponentWord::exact_value("continued"),
        RepeatKind::ContinueSeveral => ComponentWord::exact_value("continued-several"),
        RepeatKind::Swap => ComponentWord::approximate_value("alternating"),
    }
}

/// Returns the kind of contact that a target makes.
pub(super) fn contact_value(posture: &NotatedPosture) -> Option<ComponentWord> {
    let contact = match posture.place.as_ref()? {
        HandPlace::Body(place) => place.contact,
        HandPlace::Hand(site) => site.contact,
        HandPlace::Hands(hands) => hands.contact,
        HandPlace::Split(..) | HandPlace::Named(_) => None,
    };
    match contact? {
        PlaceContact::Touch => Some(ComponentWord::exact_value("contact")),
        PlaceContact::Brushing => Some(ComponentWord::exact_value("brush")),
        PlaceContact::Interlock => Some(ComponentWord::exact_value("grasp")),
        PlaceContact::Cross | PlaceContact::Close | PlaceContact::ArmExtended => None,
    }
}
