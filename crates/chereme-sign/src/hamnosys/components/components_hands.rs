//! Follows each hand through a sign.

use super::super::direction::{CompassDirection, SpatialDirection};
use super::super::tree::{
    DirectionAim, EachHand, HandSymmetry, HandsUsed, Handshape, ManualPart, MotionKind, NotatedMotion, NotatedPosture,
};
use super::components_motion::{self, MotionStep};
use super::components_place::{PlaceHand, placement_value};
use super::components_shape::{InventoryHandshapes, handshape_openness};
use super::{ComponentWord, NotationLosses};
use crate::component::SignComponent;

/// The actions of both hands, in order of time.
pub(super) struct HandActions<'s, 'i> {
    shapes: &'s InventoryHandshapes<'i>,
    dominant: HandCourse,
    weak: HandCourse,
}

/// The successive values of one field.
pub(super) type FieldCourse = (SignComponent, Option<&'static str>, Vec<Vec<ComponentWord>>);

/// The shapes and actions of one hand.
#[derive(Debug, Default)]
struct HandCourse {
    shape: Option<Handshape>,
    shapes: Vec<Vec<ComponentWord>>,
    fingers: Vec<Vec<ComponentWord>>,
    palms: Vec<Vec<ComponentWord>>,
    places: Vec<Vec<ComponentWord>>,
    steps: Vec<MotionStep>,
    acts: bool,
}

/// The hands that a notation concerns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NotatedHands {
    Dominant,
    Weak,
    Both(HandSymmetry),
}

impl NotatedHands {
    /// Returns the acting hands, each with the symmetry that applies to its notation.
    fn notated_hands(self) -> impl Iterator<Item = (bool, Option<HandSymmetry>)> {
        let (dominant, weak) = match self {
            Self::Dominant => (Some((true, None)), None),
            Self::Weak => (None, Some((false, None))),
            Self::Both(symmetry) => (Some((true, None)), Some((false, Some(symmetry)))),
        };
        dominant.into_iter().chain(weak)
    }
}

impl<'s, 'i> HandActions<'s, 'i> {
    pub(super) fn new(shapes: &'s InventoryHandshapes<'i>) -> Self {
        Self {
            shapes,
            dominant: HandCourse::default(),
            weak: HandCourse::default(),
        }
    }

    /// Processes one part of a sign.
    pub(super) fn process_manual_part(&mut self, part: &ManualPart, lost: &mut NotationLosses) {
        let acting = match part.hands {
            HandsUsed::Dominant => NotatedHands::Dominant,
            HandsUsed::Nondominant => NotatedHands::Weak,
            HandsUsed::Both(symmetry) => NotatedHands::Both(symmetry),
        };
        if !part.body.is_empty() {
            lost.add_notation_loss("movement: what the body does");
        }
        self.process_hand_posture(&part.posture, acting, lost);
        if part.posture.place.is_none() && !part.holdover {
            for (dominant, _) in acting.notated_hands() {
                let hand = self.hand_course_mut(dominant);
                // A hand without a place is in neutral space, unless an earlier part of the sign has left it
                // elsewhere.
                if hand.places.is_empty() {
                    hand.places.push(vec![ComponentWord::exact_value("neutral")]);
                }
            }
        }
        for action in &part.actions {
            let steps = self.motion_steps(action, acting, lost);
            self.take_hand_steps(steps, acting);
        }
    }

    /// Returns the successive values of each field, for the dominant and for the weak hand.
    pub(super) fn both_hand_courses(self) -> [Vec<FieldCourse>; 2] {
        [self.dominant.hand_field_courses(), self.weak.hand_field_courses()]
    }

    fn hand_course_mut(&mut self, dominant: bool) -> &mut HandCourse {
        if dominant { &mut self.dominant } else { &mut self.weak }
    }

    fn take_hand_steps(&mut self, steps: [Vec<MotionStep>; 2], acting: NotatedHands) {
        let [dominant, weak] = steps;
        self.dominant.steps.extend(dominant);
        self.weak.steps.extend(weak);
        for (dominant, symmetry) in acting.notated_hands() {
            let hand = self.hand_course_mut(dominant);
            hand.acts = true;
            if symmetry.is_some_and(|symmetry| symmetry.out_of_phase) {
                for step in &mut hand.steps {
                    step.repetitions.push(ComponentWord::exact_value("alternating"));
                }
            }
        }
    }

    fn process_hand_posture(&mut self, posture: &NotatedPosture, acting: NotatedHands, lost: &mut NotationLosses) {
        for (dominant, notated) in of_hands(&posture.shape, acting) {
            let value = self.shapes.nearest_handshape_value(notated.0, lost);
            let hand = self.hand_course_mut(dominant);
            hand.acts = true;
            hand.shape = Some(notated.0.clone());
            hand.shapes.extend(value.map(|value| vec![value]));
        }
        for (dominant, (aim, symmetry)) in of_hands(&posture.extended, acting) {
            let to =
                |direction: SpatialDirection| components_motion::symmetric_direction(direction, symmetry).to_string();
            let value = aimed_value(aim, to(aim.first), "fingers", lost);
            self.hand_course_mut(dominant).fingers.push(vec![value]);
        }
        for (dominant, (aim, symmetry)) in of_hands(&posture.palm, acting) {
            // Two hands mirror their palms even if they point in parallel.
            let to = |palm: CompassDirection| match symmetry {
                Some(_) => palm.mirrored_compass_direction(),
                None => palm,
            };
            let value = aimed_value(aim, to(aim.first).compass_letters().to_owned(), "palm", lost);
            self.hand_course_mut(dominant).palms.push(vec![value]);
        }
        if let Some(place) = &posture.place {
            let two = matches!(place, super::super::tree::HandPlace::Split(..));
            let both = [(true, None), (false, None)];
            let whose: Vec<_> = if two {
                both.to_vec()
            } else {
                acting.notated_hands().collect()
            };
            for (dominant, symmetry) in whose {
                let mirrored = symmetry.is_some_and(|s| s.left_right || !s.real_space);
                let whose = PlaceHand { dominant, mirrored };
                if let Some(value) = placement_value(place, whose, lost) {
                    self.hand_course_mut(dominant).places.push(vec![value]);
                }
            }
        }
    }

    /// Returns the steps of each hand in a motion; the postures it leads to are included.
    fn motion_steps(
        &mut self,
        motion: &NotatedMotion,
        acting: NotatedHands,
        lost: &mut NotationLosses,
    ) -> [Vec<MotionStep>; 2] {
        let mut steps = match &motion.kind {
            MotionKind::Split(dominant, other) => {
                let mut half = |motion: &Option<Box<NotatedMotion>>, acting| match motion {
                    Some(motion) => self.motion_steps(motion, acting, lost),
                    None => [Vec::new(), Vec::new()],
                };
                let [dominant, _] = half(dominant, NotatedHands::Dominant);
                let [_, weak] = half(other, NotatedHands::Weak);
                [dominant, weak]
            }
            MotionKind::Sequence { motions, .. } => {
                let mut hand_steps = [Vec::new(), Vec::new()];
                for motion in motions {
                    let motion_steps = self.motion_steps(motion, acting, lost);
                    for (whole, own) in hand_steps.iter_mut().zip(motion_steps) {
                        whole.extend(own);
                    }
                }
                hand_steps
            }
            MotionKind::Parallel(motions) => {
                let (mut dominant, mut weak) = (Vec::new(), Vec::new());
                for motion in motions {
                    let [one, other] = self.motion_steps(motion, acting, lost);
                    dominant.push(one);
                    weak.push(other);
                }
                [
                    components_motion::merge_step_courses(dominant),
                    components_motion::merge_step_courses(weak),
                ]
            }
            MotionKind::Target { motion, posture } => self.target_steps(motion.as_deref(), posture, acting, lost),
            MotionKind::Repeated { motion, repetition } => {
                let mut steps = self.motion_steps(motion, acting, lost);
                // The inventory has how often, and not how one time differs from the next.
                if repetition.growth.is_some() || repetition.shift.is_some() || repetition.approx {
                    lost.add_notation_loss("movement.repetition: how it changes");
                }
                let second = repetition.second.map(components_motion::repetition_value);
                for step in steps.iter_mut().flatten() {
                    step.repetitions
                        .push(components_motion::repetition_value(repetition.repeat));
                    step.repetitions.extend(second.clone());
                    // A contact that is made several times is what the inventory calls a tap.
                    let tapped = |kind: &mut ComponentWord| kind.word == "contact";
                    for kind in step.kinds.iter_mut().filter_map(|value| tapped(value).then_some(value)) {
                        "tap".clone_into(&mut kind.word);
                    }
                }
                steps
            }
            MotionKind::Body(_) => {
                lost.add_notation_loss("movement: what the body does");
                [Vec::new(), Vec::new()]
            }
            _ => {
                let mut steps = [Vec::new(), Vec::new()];
                for (dominant, symmetry) in acting.notated_hands() {
                    steps[usize::from(!dominant)].extend(components_motion::simple_motion_step(motion, symmetry));
                }
                return steps;
            }
        };
        for step in steps.iter_mut().flatten() {
            step.manners.extend(components_motion::manner_values(&motion.manner));
            if motion.manner.alternating {
                step.repetitions.push(ComponentWord::exact_value("alternating"));
            }
        }
        steps
    }

    fn target_steps(
        &mut self,
        path: Option<&NotatedMotion>,
        posture: &NotatedPosture,
        acting: NotatedHands,
        lost: &mut NotationLosses,
    ) -> [Vec<MotionStep>; 2] {
        let mut steps = match path {
            Some(path) => self.motion_steps(path, acting, lost),
            None => self.posture_change_steps(posture, acting),
        };
        if let Some(contact) = components_motion::contact_value(posture) {
            for (dominant, _) in acting.notated_hands() {
                if let Some(last) = steps[usize::from(!dominant)].last_mut() {
                    last.kinds.push(contact.clone());
                }
            }
        }
        self.process_hand_posture(posture, acting, lost);
        steps
    }

    /// Returns the steps to a posture without a motion of its own.
    fn posture_change_steps(&self, posture: &NotatedPosture, acting: NotatedHands) -> [Vec<MotionStep>; 2] {
        let mut steps = [Vec::new(), Vec::new()];
        for (dominant, (shape, _)) in of_hands(&posture.shape, acting) {
            let hand_before = if dominant { &self.dominant } else { &self.weak };
            let before = hand_before.shape.as_ref();
            let kind = match before {
                // The same fingers with another bend only bend; otherwise the more open of the two shapes names the
                // motion.
                Some(before) if before.form.class == shape.form.class => "bending",
                Some(before) if handshape_openness(before) < handshape_openness(shape) => "opening",
                Some(_) => "closing",
                None => "finger",
            };
            steps[usize::from(!dominant)].push(MotionStep::from_motion_value(ComponentWord::exact_value(kind)));
        }
        let turned = |changes: &mut dyn Iterator<Item = bool>, word: &str, steps: &mut [Vec<MotionStep>; 2]| {
            for dominant in changes {
                let hand_steps = &mut steps[usize::from(!dominant)];
                let step = MotionStep::from_motion_value(ComponentWord::approximate_value(word));
                match hand_steps.last_mut() {
                    Some(last) => last.join_motion_step(step),
                    // A turn of a hand that changes its shape at the same time is one motion with it.
                    None => hand_steps.push(step),
                }
            }
        };
        let palms: Vec<bool> = of_hands(&posture.palm, acting).map(|(hand, _)| hand).collect();
        let fingers: Vec<bool> = of_hands(&posture.extended, acting).map(|(hand, _)| hand).collect();
        // Palm and fingers change together if the forearm twists, so that the palm alone is counted then.
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
    notated: &EachHand<T>,
    acting: NotatedHands,
) -> impl Iterator<Item = (bool, (&T, Option<HandSymmetry>))> {
    let shared = match notated {
        EachHand::Shared(one) => Some(one),
        _ => None,
    };
    let split_values = match notated {
        EachHand::Split(dominant, other) => [(true, dominant.as_ref()), (false, other.as_ref())],
        _ => [(true, None), (false, None)],
    };
    let split = split_values
        .into_iter()
        .filter_map(|(hand, one)| Some((hand, (one?, None))));
    let shared = shared.into_iter().flat_map(move |one| {
        let hands = acting.notated_hands();
        hands.map(move |(hand, symmetry)| (hand, (one, symmetry)))
    });
    shared.chain(split)
}

fn aimed_value<D: PartialEq>(
    aim: &DirectionAim<D>,
    word: String,
    what: &str,
    lost: &mut NotationLosses,
) -> ComponentWord {
    let between = aim.second.as_ref().is_some_and(|second| *second != aim.first);
    if between {
        lost.add_notation_loss(format!("orientation.{what}: half-way between two"));
    }
    let exact = !between && !aim.approx;
    ComponentWord { word, exact }
}

impl HandCourse {
    fn hand_field_courses(self) -> Vec<FieldCourse> {
        let mut steps = self.steps;
        if steps.is_empty() && self.acts {
            steps.push(MotionStep::from_motion_value(ComponentWord::exact_value("hold")));
        }
        let moving = steps.iter().any(|step| {
            let still = |kind: &ComponentWord| kind.word == "hold";
            !step.kinds.iter().all(still)
        });
        let once = || vec![ComponentWord::exact_value("once")];
        let mut features: [Vec<Vec<ComponentWord>>; 5] = Default::default();
        for mut step in steps {
            // Only a movement is made once; a hold has no number of times.
            if step.repetitions.is_empty() && moving {
                step.repetitions = once();
            }
            let MotionStep {
                kinds,
                directions,
                sizes,
                repetitions,
                manners,
            } = step;
            for (list, own) in features
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
            (SignComponent::Configuration, None, self.shapes),
            (SignComponent::Orientation, Some("fingers"), self.fingers),
            (SignComponent::Orientation, Some("palm"), self.palms),
            (SignComponent::Placement, None, self.places),
            (SignComponent::Movement, None, kinds),
            (SignComponent::Movement, Some("direction"), directions),
            (SignComponent::Movement, Some("size"), sizes),
            (SignComponent::Movement, Some("repetition"), repetitions),
            (SignComponent::Movement, Some("manner"), manners),
        ]
    }
}
