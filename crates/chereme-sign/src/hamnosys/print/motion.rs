//! Prints movements as symbols.

use super::Write;
use crate::hamnosys::direction::{Compass, Direction};
use crate::hamnosys::symbol::{Bracket, Kind, Mark};
use crate::hamnosys::tree::{
    Amount, Circular, Curve, Directed, Growth, Manner, Motion, MotionKind, Posture, Repeat,
    Repetition, Size, Zigzag,
};

impl Write {
    pub(in crate::hamnosys) fn motion(&mut self, motion: &Motion) {
        if self.written(&motion.written) {
            return;
        }
        match &motion.kind {
            MotionKind::Directed(directed) => self.directed(directed),
            MotionKind::Circular(circle) => self.circular(circle),
            MotionKind::Wrist { motion, size } => {
                self.symbol(Kind::Wrist(*motion));
                self.size(*size);
            }
            MotionKind::Cross { diagonal } => self.symbol(Kind::Cross {
                diagonal: *diagonal,
            }),
            MotionKind::FingerPlay(digits) => {
                self.symbol(Kind::FingerPlay);
                for digit in &digits.0 {
                    self.symbol(Kind::Digit(*digit));
                }
            }
            MotionKind::Still => self.symbol(Kind::Still),
            MotionKind::Body(action) => self.body_action(action),
            MotionKind::Split(one, two) => {
                self.symbol(Kind::Open(Bracket::Par));
                if let Some(one) = one {
                    self.motion(one);
                }
                self.symbol(Kind::Plus);
                if let Some(two) = two {
                    self.motion(two);
                }
                self.symbol(Kind::Close(Bracket::Par));
            }
            MotionKind::Sequence { motions, fused } => self.group(
                if *fused {
                    Bracket::Fusion
                } else {
                    Bracket::Seq
                },
                motions,
            ),
            MotionKind::Parallel(motions) => self.group(Bracket::Par, motions),
            MotionKind::Target { motion, posture } => self.target(motion.as_deref(), posture),
            MotionKind::Repeated { motion, repetition } => {
                self.motion(motion);
                self.repetition(repetition);
            }
        }
        self.manner(&motion.manner);
    }

    fn group(&mut self, bracket: Bracket, motions: &[Motion]) {
        self.symbol(Kind::Open(bracket));
        for motion in motions {
            self.motion(motion);
        }
        self.symbol(Kind::Close(bracket));
    }

    fn target(&mut self, motion: Option<&Motion>, posture: &Posture) {
        let only_place = Posture {
            place: posture.place.clone(),
            ..Posture::default()
        };
        match motion {
            Some(motion) if *posture == only_place => {
                self.motion(motion);
                match &posture.place {
                    Some(place) => self.place(place),
                    None => self.lose("a movement to no posture is written without one"),
                }
            }
            Some(motion) => {
                self.lose("a movement to a handshape is written as a movement and a change at the same time");
                self.symbol(Kind::Open(Bracket::Par));
                self.motion(motion);
                self.symbol(Kind::Replace);
                self.posture(posture);
                self.symbol(Kind::Close(Bracket::Par));
            }
            None => {
                self.symbol(Kind::Replace);
                self.posture(posture);
            }
        }
    }

    fn directed(&mut self, directed: &Directed) {
        self.direction_symbols(directed.direction, Kind::Move);
        if let Some(second) = directed.second {
            self.symbol(Kind::Between);
            self.direction_symbols(second, Kind::Move);
        }
        self.amount(directed.size);
        self.curve(directed.curve);
        self.zigzag(directed.zigzag);
        if let Some(ellipse) = directed.ellipse {
            self.symbol(Kind::Ellipse(ellipse));
        }
    }

    /// Writes a direction of a movement; a corner as its two symbols.
    fn direction_symbols(&mut self, direction: Direction, kind: fn(Direction) -> Kind) {
        match direction.corner_parts() {
            None => self.symbol(kind(direction)),
            Some((one, two)) => {
                self.symbol(kind(one));
                self.symbol(kind(two));
            }
        }
    }

    fn circular(&mut self, circle: &Circular) {
        self.direction_symbols(circle.axis, Kind::Circle);
        if let Some(second) = circle.second {
            self.symbol(Kind::Between);
            self.direction_symbols(second, Kind::Circle);
        }
        self.amount(circle.size);
        if let Some(ellipse) = circle.ellipse {
            self.symbol(Kind::Ellipse(ellipse));
        }
        self.size(circle.ellipse_size);
        for point in [circle.clock.start, circle.clock.end].into_iter().flatten() {
            self.symbol(Kind::Clock(point));
        }
        for _ in 0..circle.clock.full {
            self.symbol(Kind::ClockFull);
        }
        self.zigzag(circle.zigzag);
        self.growth(circle.growth);
    }

    fn curve(&mut self, curve: Option<Curve>) {
        let Some(curve) = curve else {
            return;
        };
        let (one, two) = match curve.to {
            Compass::Ur => (Compass::U, Some(Compass::R)),
            Compass::Ul => (Compass::U, Some(Compass::L)),
            Compass::Dr => (Compass::D, Some(Compass::R)),
            Compass::Dl => (Compass::D, Some(Compass::L)),
            straight => (straight, None),
        };
        self.symbol(Kind::Arc(one));
        if let Some(two) = two {
            self.symbol(Kind::Arc(two));
        }
        self.size(curve.size);
    }

    fn zigzag(&mut self, zigzag: Option<Zigzag>) {
        let Some(zigzag) = zigzag else {
            return;
        };
        self.symbol(Kind::Zigzag { wavy: zigzag.wavy });
        self.size(zigzag.size);
        self.growth(zigzag.growth);
    }

    fn growth(&mut self, growth: Option<Growth>) {
        if let Some(growth) = growth {
            self.symbol(Kind::Growth {
                increasing: growth.increasing,
            });
            self.size(growth.size);
        }
    }

    fn amount(&mut self, amount: Amount) {
        self.size(amount.first);
        if amount.second.is_some() {
            self.symbol(Kind::Between);
            self.size(amount.second);
        }
    }

    fn size(&mut self, size: Option<Size>) {
        if let Some(size) = size {
            self.symbol(Kind::Size(size));
        }
    }

    fn repetition(&mut self, repetition: &Repetition) {
        let moving = repetition.shift.is_some();
        if moving {
            self.symbol(Kind::Open(Bracket::Seq));
        }
        self.repeat(repetition.repeat);
        if let Some(second) = repetition.second {
            self.repeat(second);
        }
        self.growth(repetition.growth);
        if repetition.approx {
            self.symbol(Kind::Approx);
        }
        if let Some(shift) = repetition.shift {
            self.direction_symbols(shift, Kind::Move);
            self.size(repetition.shift_size);
            self.growth(repetition.shift_growth);
            self.symbol(Kind::Close(Bracket::Seq));
        }
    }

    fn repeat(&mut self, repeat: Repeat) {
        let (said, lost) = match repeat {
            Repeat::ToFro => (Repeat::Reverse, Some("to and fro is written as in reverse")),
            Repeat::ManyRandom => (
                Repeat::FromStartSeveral,
                Some("many times at random is written as several times"),
            ),
            Repeat::Swap => (
                Repeat::FromStart,
                Some("with the hands exchanged is written as once more"),
            ),
            repeat => (repeat, None),
        };
        if let Some(lost) = lost {
            self.lose(lost);
        }
        self.symbol(Kind::Repeat(said));
    }

    fn manner(&mut self, manner: &Manner) {
        let marks = [
            (manner.fast, Kind::Manner(Mark::Fast)),
            (manner.slow, Kind::Manner(Mark::Slow)),
            (manner.tense, Kind::Manner(Mark::Tense)),
            (manner.rest, Kind::Manner(Mark::Rest)),
            (manner.halt, Kind::Manner(Mark::Halt)),
            (manner.alternating, Kind::Alternating),
            (manner.second_alternating, Kind::Alternating),
        ];
        for (there, mark) in marks {
            if there {
                self.symbol(mark);
            }
        }
        if manner.bouncing {
            self.lose("that a movement bounces has no symbol; it is left out");
        }
        if manner.absolute {
            self.lose("that a movement is absolute has no symbol; it is left out");
        }
        if manner.speed.is_some() {
            self.lose("a factor of speed has no symbol; fast and slow are the only ones");
        }
    }
}
