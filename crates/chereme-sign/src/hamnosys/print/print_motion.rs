//! Prints movements as symbols.

use super::HamnosysWriter;
use crate::hamnosys::direction::{CompassDirection, SpatialDirection};
use crate::hamnosys::symbol::{BracketKind, MannerMark, SymbolKind};
use crate::hamnosys::tree::{
    CircularPath, DirectedPath, MotionGrowth, MotionKind, MotionManner, MotionRepetition, MotionSize, NotatedMotion,
    NotatedPosture, PathCurve, PathZigzag, RepeatKind, SizeAmount,
};

impl HamnosysWriter {
    pub(in crate::hamnosys) fn write_motion(&mut self, motion: &NotatedMotion) {
        if self.write_kept_symbols(&motion.written) {
            return;
        }
        match &motion.kind {
            MotionKind::Directed(directed) => self.write_directed_path(directed),
            MotionKind::Circular(circle) => self.write_circular_path(circle),
            MotionKind::Wrist { motion, size } => {
                self.symbol(SymbolKind::Wrist(*motion));
                self.write_motion_size(*size);
            }
            MotionKind::Cross { diagonal } => self.symbol(SymbolKind::Cross { diagonal: *diagonal }),
            MotionKind::FingerPlay(digits) => {
                self.symbol(SymbolKind::FingerPlay);
                for digit in &digits.0 {
                    self.symbol(SymbolKind::Digit(*digit));
                }
            }
            MotionKind::Still => self.symbol(SymbolKind::Still),
            MotionKind::Body(action) => self.write_body_action(action),
            MotionKind::Split(one, two) => {
                self.symbol(SymbolKind::Open(BracketKind::Par));
                if let Some(one) = one {
                    self.write_motion(one);
                }
                self.symbol(SymbolKind::Plus);
                if let Some(two) = two {
                    self.write_motion(two);
                }
                self.symbol(SymbolKind::Close(BracketKind::Par));
            }
            MotionKind::Sequence { motions, fused } => {
                self.write_motion_group(if *fused { BracketKind::Fusion } else { BracketKind::Seq }, motions)
            }
            MotionKind::Parallel(motions) => self.write_motion_group(BracketKind::Par, motions),
            MotionKind::Target { motion, posture } => self.write_target_motion(motion.as_deref(), posture),
            MotionKind::Repeated { motion, repetition } => {
                self.write_motion(motion);
                self.write_repetition(repetition);
            }
        }
        self.write_manner_marks(&motion.manner);
    }

    fn write_motion_group(&mut self, bracket: BracketKind, motions: &[NotatedMotion]) {
        self.symbol(SymbolKind::Open(bracket));
        for motion in motions {
            self.write_motion(motion);
        }
        self.symbol(SymbolKind::Close(bracket));
    }

    fn write_target_motion(&mut self, motion: Option<&NotatedMotion>, posture: &NotatedPosture) {
        let only_place = NotatedPosture {
            place: posture.place.clone(),
            ..NotatedPosture::default()
        };
        match motion {
            Some(motion) if *posture == only_place => {
                self.write_motion(motion);
                match &posture.place {
                    Some(place) => self.write_hand_place(place),
                    None => self.report_notation_loss("a movement to no posture is written without one"),
                }
            }
            Some(motion) => {
                self.report_notation_loss(
                    "a movement to a handshape is written as a movement and a change at the same time",
                );
                self.symbol(SymbolKind::Open(BracketKind::Par));
                self.write_motion(motion);
                self.symbol(SymbolKind::Replace);
                self.write_hand_posture(posture);
                self.symbol(SymbolKind::Close(BracketKind::Par));
            }
            None => {
                self.symbol(SymbolKind::Replace);
                self.write_hand_posture(posture);
            }
        }
    }

    fn write_directed_path(&mut self, directed: &DirectedPath) {
        self.direction_symbols(directed.direction, SymbolKind::Move);
        if let Some(second) = directed.second {
            self.symbol(SymbolKind::Between);
            self.direction_symbols(second, SymbolKind::Move);
        }
        self.write_size_amount(directed.size);
        self.write_path_curve(directed.curve);
        self.write_path_zigzag(directed.zigzag);
        if let Some(ellipse) = directed.ellipse {
            self.symbol(SymbolKind::Ellipse(ellipse));
        }
    }

    /// Writes a direction of a movement; a corner as its two symbols.
    fn direction_symbols(&mut self, direction: SpatialDirection, kind: fn(SpatialDirection) -> SymbolKind) {
        match direction.corner_parts() {
            None => self.symbol(kind(direction)),
            Some((one, two)) => {
                self.symbol(kind(one));
                self.symbol(kind(two));
            }
        }
    }

    fn write_circular_path(&mut self, circle: &CircularPath) {
        self.direction_symbols(circle.axis, SymbolKind::Circle);
        if let Some(second) = circle.second {
            self.symbol(SymbolKind::Between);
            self.direction_symbols(second, SymbolKind::Circle);
        }
        self.write_size_amount(circle.size);
        if let Some(ellipse) = circle.ellipse {
            self.symbol(SymbolKind::Ellipse(ellipse));
        }
        self.write_motion_size(circle.ellipse_size);
        for point in [circle.clock.start, circle.clock.end].into_iter().flatten() {
            self.symbol(SymbolKind::Clock(point));
        }
        for _ in 0..circle.clock.full {
            self.symbol(SymbolKind::ClockFull);
        }
        self.write_path_zigzag(circle.zigzag);
        self.write_motion_growth(circle.growth);
    }

    fn write_path_curve(&mut self, curve: Option<PathCurve>) {
        let Some(curve) = curve else {
            return;
        };
        let (one, two) = match curve.to {
            CompassDirection::Ur => (CompassDirection::U, Some(CompassDirection::R)),
            CompassDirection::Ul => (CompassDirection::U, Some(CompassDirection::L)),
            CompassDirection::Dr => (CompassDirection::D, Some(CompassDirection::R)),
            CompassDirection::Dl => (CompassDirection::D, Some(CompassDirection::L)),
            straight => (straight, None),
        };
        self.symbol(SymbolKind::Arc(one));
        if let Some(two) = two {
            self.symbol(SymbolKind::Arc(two));
        }
        self.write_motion_size(curve.size);
    }

    fn write_path_zigzag(&mut self, zigzag: Option<PathZigzag>) {
        let Some(zigzag) = zigzag else {
            return;
        };
        self.symbol(SymbolKind::Zigzag { wavy: zigzag.wavy });
        self.write_motion_size(zigzag.size);
        self.write_motion_growth(zigzag.growth);
    }

    fn write_motion_growth(&mut self, growth: Option<MotionGrowth>) {
        if let Some(growth) = growth {
            self.symbol(SymbolKind::Growth {
                increasing: growth.increasing,
            });
            self.write_motion_size(growth.size);
        }
    }

    fn write_size_amount(&mut self, amount: SizeAmount) {
        self.write_motion_size(amount.first);
        if amount.second.is_some() {
            self.symbol(SymbolKind::Between);
            self.write_motion_size(amount.second);
        }
    }

    fn write_motion_size(&mut self, size: Option<MotionSize>) {
        if let Some(size) = size {
            self.symbol(SymbolKind::Size(size));
        }
    }

    fn write_repetition(&mut self, repetition: &MotionRepetition) {
        let moving = repetition.shift.is_some();
        if moving {
            self.symbol(SymbolKind::Open(BracketKind::Seq));
        }
        self.write_repeat_kind(repetition.repeat);
        if let Some(second) = repetition.second {
            self.write_repeat_kind(second);
        }
        self.write_motion_growth(repetition.growth);
        if repetition.approx {
            self.symbol(SymbolKind::Approx);
        }
        if let Some(shift) = repetition.shift {
            self.direction_symbols(shift, SymbolKind::Move);
            self.write_motion_size(repetition.shift_size);
            self.write_motion_growth(repetition.shift_growth);
            self.symbol(SymbolKind::Close(BracketKind::Seq));
        }
    }

    fn write_repeat_kind(&mut self, repeat: RepeatKind) {
        let (said, lost) = match repeat {
            RepeatKind::ToFro => (RepeatKind::Reverse, Some("to and fro is written as in reverse")),
            RepeatKind::ManyRandom => (
                RepeatKind::FromStartSeveral,
                Some("many times at random is written as several times"),
            ),
            RepeatKind::Swap => (
                RepeatKind::FromStart,
                Some("with the hands exchanged is written as once more"),
            ),
            repeat => (repeat, None),
        };
        if let Some(lost) = lost {
            self.report_notation_loss(lost);
        }
        self.symbol(SymbolKind::Repeat(said));
    }

    fn write_manner_marks(&mut self, manner: &MotionManner) {
        let marks = [
            (manner.fast, SymbolKind::Manner(MannerMark::Fast)),
            (manner.slow, SymbolKind::Manner(MannerMark::Slow)),
            (manner.tense, SymbolKind::Manner(MannerMark::Tense)),
            (manner.rest, SymbolKind::Manner(MannerMark::Rest)),
            (manner.halt, SymbolKind::Manner(MannerMark::Halt)),
            (manner.alternating, SymbolKind::Alternating),
            (manner.second_alternating, SymbolKind::Alternating),
        ];
        for (there, mark) in marks {
            if there {
                self.symbol(mark);
            }
        }
        if manner.bouncing {
            self.report_notation_loss("that a movement bounces has no symbol; it is left out");
        }
        if manner.absolute {
            self.report_notation_loss("that a movement is absolute has no symbol; it is left out");
        }
        if manner.speed.is_some() {
            self.report_notation_loss("a factor of speed has no symbol; fast and slow are the only ones");
        }
    }
}
