//! Reads movements, their modifiers, and the postures they end in.

use super::{MAX_DEPTH, Parsed, Parser, is_motion};
use crate::hamnosys::direction::{Compass, Direction};
use crate::hamnosys::symbol::{Bracket, Kind, Mark};
use crate::hamnosys::tree::{
    Circular, Contact, Curve, Digits, Directed, Growth, Manner, Motion, MotionKind, Place, Posture,
    Repeat, Repetition, Size, Zigzag,
};

/// A motion with its depth of nesting.
type Deep = (Motion, usize);

/// The element that a size mark would belong to.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    Path,
    Curve,
    Zigzag,
    ZigzagGrowth,
    Ellipse,
    Growth,
    Other,
}

impl Parser<'_> {
    /// Reads movements up to the end of the part, of the bracket, or hamplus.
    pub(super) fn actions(&mut self) -> Parsed<Vec<Motion>> {
        Ok(self
            .deep_actions()?
            .into_iter()
            .map(|deep| deep.0)
            .collect())
    }

    fn deep_actions(&mut self) -> Parsed<Vec<Deep>> {
        let mut motions = Vec::new();
        while let Some(kind) = self.peek() {
            match kind {
                Kind::Plus => break,
                Kind::Close(_) if self.depth > 0 => break,
                Kind::Symmetry { .. } | Kind::Base(_) if self.depth == 0 => break,
                Kind::Nondominant if self.depth == 0 && !self.motion_follows() => break,
                Kind::Open(Bracket::Par)
                    if self.depth == 0 && self.begins_split_shape() && !motions.is_empty() =>
                {
                    break;
                }
                _ if self.begins_action(kind) => motions.push(self.deeper(Self::action)?),
                _ => self.unexpected("a movement, a place it ends at, or the end")?,
            }
        }
        Ok(motions)
    }

    fn motion_follows(&self) -> bool {
        self.kind(self.at + 1)
            .is_some_and(|kind| is_motion(kind) || matches!(kind, Kind::Replace | Kind::Open(_)))
    }

    fn begins_split_shape(&self) -> bool {
        matches!(self.kind(self.at + 1), Some(Kind::Base(_)))
            && self.at_split_config(&Posture::default())
    }

    fn begins_action(&self, kind: Kind) -> bool {
        match kind {
            Kind::Replace | Kind::Open(_) | Kind::Manner(_) | Kind::Repeat(_) => true,
            Kind::Base(_) | Kind::Extended(_) | Kind::Palm(_) | Kind::Nondominant => true,
            Kind::Alternating => true,
            kind => is_motion(kind) || self.at_place(),
        }
    }

    /// Reads one movement with all its following modifiers.
    pub(super) fn action(&mut self) -> Parsed<Deep> {
        let from = self.at;
        let (kind, mut height) = self.core()?;
        let mut motion = Motion::new(kind);
        for wraps in 0.. {
            self.manner(&mut motion);
            motion.written = self.written(from, |out| out.motion(&motion));
            let wrapped = match self.peek() {
                Some(Kind::Repeat(_)) => {
                    let repetition = self.repetition();
                    repeated(motion, repetition)
                }
                Some(Kind::Open(Bracket::Seq)) => match self.kind(self.at + 1) {
                    Some(Kind::Repeat(_)) => {
                        let repetition = self.moving_repetition()?;
                        repeated(motion, repetition)
                    }
                    Some(Kind::Contact(Contact::Brushing)) => {
                        let place = self.brushing()?;
                        target(motion, place)
                    }
                    Some(Kind::Contact(_)) => {
                        let place = self.place()?;
                        target(motion, place)
                    }
                    _ => return Ok((motion, height)),
                },
                _ if self.at_place() => {
                    let place = self.place()?;
                    target(motion, place)
                }
                _ => return Ok((motion, height)),
            };
            motion = Motion::new(wrapped);
            height += 1;
            if height >= MAX_DEPTH || wraps >= MAX_DEPTH {
                return Err(self.too_deep());
            }
        }
        Ok((motion, height))
    }

    /// Reads a movement without the marks that may follow any movement.
    fn core(&mut self) -> Parsed<(MotionKind, usize)> {
        let Some(kind) = self.peek() else {
            self.missing("a movement")?;
            return Ok((MotionKind::Still, 1));
        };
        Ok(match kind {
            Kind::Move(_) => (self.directed(), 1),
            Kind::Circle(_) => (self.circular(), 1),
            Kind::Wrist(motion) => {
                self.at += 1;
                (MotionKind::Wrist { motion, size: None }, 1)
            }
            Kind::Cross { diagonal } => {
                self.at += 1;
                (MotionKind::Cross { diagonal }, 1)
            }
            Kind::FingerPlay => (self.finger_play(), 1),
            Kind::Still => {
                self.at += 1;
                (MotionKind::Still, 1)
            }
            Kind::Replace => (self.replacement()?, 1),
            Kind::Nondominant => {
                self.at += 1;
                let (motion, height) = self.deeper(Self::action)?;
                (MotionKind::Split(None, Some(Box::new(motion))), height + 1)
            }
            Kind::Open(bracket) => return self.group_action(bracket),
            Kind::Base(_) | Kind::Extended(_) | Kind::Palm(_) => {
                self.note(
                    "a configuration without hamreplace before it",
                    "write hamreplace before what changes",
                    false,
                );
                (self.changed_posture()?, 1)
            }
            Kind::Manner(_) | Kind::Repeat(_) | Kind::Alternating => (MotionKind::Still, 1),
            _ if self.at_body_action() => {
                let (body, height) = self.deeper(Self::body_action)?;
                (MotionKind::Body(body), height + 1)
            }
            _ if self.at_place() => {
                let place = self.place()?;
                (
                    change(Posture {
                        place: Some(place),
                        ..Posture::default()
                    }),
                    1,
                )
            }
            _ => {
                self.unexpected("a movement")?;
                (MotionKind::Still, 1)
            }
        })
    }

    fn replacement(&mut self) -> Parsed<MotionKind> {
        self.at += 1;
        self.drop_growth();
        let kind = self.changed_posture()?;
        self.drop_growth();
        Ok(kind)
    }

    fn drop_growth(&mut self) {
        while let Some(Kind::Growth { .. }) = self.peek() {
            self.drop(
                "fingers that change one after the other are not in the tree",
                "write one hamreplace for each finger, if their order matters",
            );
        }
    }

    fn changed_posture(&mut self) -> Parsed<MotionKind> {
        let posture = self.posture()?;
        if posture.is_empty() {
            self.missing("a handshape, a direction, a palm or a place after hamreplace")?;
        }
        Ok(change(posture))
    }

    fn group_action(&mut self, bracket: Bracket) -> Parsed<(MotionKind, usize)> {
        let opened = self.at;
        match (bracket, self.kind(self.at + 1)) {
            (Bracket::Seq, Some(Kind::Repeat(_) | Kind::Contact(Contact::Brushing))) => {
                return Ok((MotionKind::Still, 1));
            }
            (Bracket::Par, _) if self.at_split_config(&Posture::default()) => {
                self.note(
                    "a configuration without hamreplace before it",
                    "write hamreplace before what changes",
                    false,
                );
                return Ok((self.changed_posture()?, 1));
            }
            (Bracket::Seq | Bracket::Par, _) if self.at_place() => {
                let place = self.place()?;
                let posture = Posture {
                    place: Some(place),
                    ..Posture::default()
                };
                return Ok((change(posture), 1));
            }
            (Bracket::Par, _) if self.group(self.at).1.is_some() => return self.split_action(),
            _ => {}
        }
        self.at += 1;
        let motions = self.deeper(Self::deep_actions)?;
        if motions.is_empty() {
            self.missing("a movement in the bracket")?;
        }
        while matches!(self.peek(), Some(Kind::Plus)) {
            self.unexpected("a closing bracket; only hamparbegin has two halves")?;
        }
        self.close(opened, bracket)?;
        let height = 1 + motions.iter().map(|deep| deep.1).max().unwrap_or_default();
        let motions = motions.into_iter().map(|deep| deep.0).collect();
        let kind = match bracket {
            Bracket::Par => MotionKind::Parallel(motions),
            Bracket::Seq | Bracket::Fusion => MotionKind::Sequence {
                motions,
                fused: bracket == Bracket::Fusion,
            },
        };
        Ok((kind, height))
    }

    fn split_action(&mut self) -> Parsed<(MotionKind, usize)> {
        let opened = self.at;
        self.at += 1;
        let dominant = self.deeper(Self::half_action)?;
        if !self.eat(Kind::Plus) {
            self.missing("hamplus between the two hands")?;
        }
        let other = self.deeper(Self::half_action)?;
        while matches!(self.peek(), Some(Kind::Plus)) {
            self.unexpected("hamparend; there are two hands only")?;
            self.deeper(Self::half_action)?;
        }
        self.close(opened, Bracket::Par)?;
        let height = 1 + [&dominant, &other]
            .into_iter()
            .flatten()
            .map(|deep| deep.1)
            .max()
            .unwrap_or_default();
        let boxed = |deep: Option<Deep>| deep.map(|deep| Box::new(deep.0));
        Ok((MotionKind::Split(boxed(dominant), boxed(other)), height))
    }

    fn half_action(&mut self) -> Parsed<Option<Deep>> {
        let from = self.at;
        let mut motions = self.deep_actions()?;
        if motions.len() < 2 {
            return Ok(motions.pop());
        }
        let height = 1 + motions.iter().map(|deep| deep.1).max().unwrap_or_default();
        let motions = motions.into_iter().map(|deep| deep.0).collect();
        let mut motion = Motion::new(MotionKind::Parallel(motions));
        motion.written = self.written(from, |out| out.motion(&motion));
        Ok(Some((motion, height)))
    }

    fn finger_play(&mut self) -> MotionKind {
        self.at += 1;
        let mut digits = Digits::default();
        while let Some(Kind::Digit(digit)) = self.peek() {
            if matches!(
                self.kind(self.at + 1),
                Some(Kind::Part(_) | Kind::Contact(_))
            ) {
                break;
            }
            if digits.contains(digit) {
                self.note("the digit is there twice", "write it once", true);
            } else {
                digits.0.push(digit);
            }
            self.at += 1;
        }
        MotionKind::FingerPlay(digits)
    }

    fn directed(&mut self) -> MotionKind {
        let (direction, second) = self.directions(|kind| match kind {
            Kind::Move(direction) => Some(direction),
            _ => None,
        });
        let mut kind = MotionKind::Directed(Directed {
            direction,
            second,
            size: Default::default(),
            curve: None,
            zigzag: None,
            ellipse: None,
        });
        self.modifiers(&mut kind, Last::Path);
        kind
    }

    fn circular(&mut self) -> MotionKind {
        let (axis, second) = self.directions(|kind| match kind {
            Kind::Circle(axis) => Some(axis),
            _ => None,
        });
        let mut kind = MotionKind::Circular(Circular {
            axis,
            second,
            size: Default::default(),
            ellipse: None,
            ellipse_size: None,
            clock: Default::default(),
            zigzag: None,
            growth: None,
        });
        self.modifiers(&mut kind, Last::Path);
        kind
    }

    /// Takes a direction, or the middle of two.
    fn directions(
        &mut self,
        direction_of: fn(Kind) -> Option<Direction>,
    ) -> (Direction, Option<Direction>) {
        let first = self.direction(direction_of);
        let between = self.next_is(0, Kind::Between)
            && self.kind(self.at + 1).and_then(direction_of).is_some();
        self.at += usize::from(between);
        (first, between.then(|| self.direction(direction_of)))
    }

    /// Takes one symbol of a direction, or the two symbols of a corner.
    fn direction(&mut self, direction_of: fn(Kind) -> Option<Direction>) -> Direction {
        let at = |parser: &Self, ahead| parser.kind(parser.at + ahead).and_then(direction_of);
        let first = at(self, 0).unwrap_or(Direction::OUT);
        let corner = at(self, 1).and_then(|second| {
            let corner = first.corner_with(second)?;
            (corner.corner_parts() == Some((first, second))).then_some(corner)
        });
        self.at += 1 + usize::from(corner.is_some());
        corner.unwrap_or(first)
    }

    /// Takes marks of manner, and marks of size and form after them.
    fn manner(&mut self, motion: &mut Motion) {
        loop {
            self.modifiers(&mut motion.kind, Last::Path);
            let manner = &mut motion.manner;
            let flag = match self.peek() {
                Some(Kind::Manner(mark)) => manner_flag(manner, mark),
                Some(Kind::Alternating) if manner.alternating => &mut manner.second_alternating,
                Some(Kind::Alternating) => &mut manner.alternating,
                Some(Kind::Approx) => {
                    match &mut motion.kind {
                        MotionKind::Repeated { repetition, .. } if !repetition.approx => {
                            repetition.approx = true;
                            self.at += 1;
                        }
                        _ => self.drop(
                            "roughly so, of a movement, is not in the tree",
                            "write it after a handshape, a direction, a place or a repetition",
                        ),
                    }
                    continue;
                }
                Some(Kind::Relative) => {
                    self.drop(
                        "relative to the movement, of a movement, is not in the tree",
                        "write it after a direction or a palm",
                    );
                    continue;
                }
                _ => return,
            };
            if std::mem::replace(flag, true) {
                self.note("the mark is there twice", "write it once", true);
            }
            self.at += 1;
        }
    }

    /// Takes the marks that modify a movement's form, in any order.
    fn modifiers(&mut self, kind: &mut MotionKind, mut last: Last) {
        loop {
            let there = match (self.peek(), &mut *kind) {
                (Some(Kind::Size(size)), kind) => self.size(size, kind, last),
                (Some(Kind::Growth { increasing }), kind) => {
                    let growth = Growth {
                        increasing,
                        size: None,
                    };
                    grow(kind, growth, &mut last)
                }
                (Some(Kind::Arc(to)), MotionKind::Directed(directed)) => {
                    last = Last::Curve;
                    bulge(&mut directed.curve, to)
                }
                (
                    Some(Kind::Zigzag { wavy }),
                    MotionKind::Directed(Directed { zigzag, .. })
                    | MotionKind::Circular(Circular { zigzag, .. }),
                ) => {
                    last = Last::Zigzag;
                    set(
                        zigzag,
                        Zigzag {
                            wavy,
                            size: None,
                            growth: None,
                        },
                    )
                }
                (
                    Some(Kind::Ellipse(axis)),
                    MotionKind::Directed(Directed { ellipse, .. })
                    | MotionKind::Circular(Circular { ellipse, .. }),
                ) => {
                    last = Last::Ellipse;
                    set(ellipse, axis)
                }
                (Some(Kind::Clock(to)), MotionKind::Circular(circle)) => {
                    last = Last::Other;
                    let clock = &mut circle.clock;
                    set(&mut clock.start, to) || set(&mut clock.end, to)
                }
                (Some(Kind::ClockFull), MotionKind::Circular(circle)) => {
                    last = Last::Other;
                    circle.clock.full = circle.clock.full.saturating_add(1);
                    circle.clock.full <= 8
                }
                (
                    Some(
                        Kind::Arc(_)
                        | Kind::Zigzag { .. }
                        | Kind::Ellipse(_)
                        | Kind::Clock(_)
                        | Kind::ClockFull,
                    ),
                    MotionKind::Still,
                ) => return,
                (
                    Some(
                        Kind::Arc(_)
                        | Kind::Zigzag { .. }
                        | Kind::Ellipse(_)
                        | Kind::Clock(_)
                        | Kind::ClockFull,
                    ),
                    _,
                ) => false,
                _ => return,
            };
            match there {
                true => self.at += 1,
                false if matches!(self.peek(), Some(Kind::Size(_))) && !takes_size(kind) => return,
                false => self.drop(
                    "the tree has no place for this mark of this movement",
                    "write one of a kind, after the movement that it modifies",
                ),
            }
        }
    }

    fn size(&mut self, size: Size, kind: &mut MotionKind, last: Last) -> bool {
        let between = self.next_is(1, Kind::Between);
        let second = match self.kind(self.at + 2) {
            Some(Kind::Size(second)) if between => Some(second),
            _ => None,
        };
        match (kind, last) {
            (MotionKind::Directed(directed), Last::Curve) => directed
                .curve
                .as_mut()
                .is_some_and(|curve| set(&mut curve.size, size)),
            (
                MotionKind::Directed(Directed { zigzag, .. })
                | MotionKind::Circular(Circular { zigzag, .. }),
                Last::Zigzag | Last::ZigzagGrowth,
            ) => zigzag
                .as_mut()
                .is_some_and(|zigzag| match &mut zigzag.growth {
                    Some(growth) if last == Last::ZigzagGrowth => set(&mut growth.size, size),
                    _ => set(&mut zigzag.size, size),
                }),
            (MotionKind::Circular(circle), Last::Ellipse) => set(&mut circle.ellipse_size, size),
            (MotionKind::Circular(circle), Last::Growth) => circle
                .growth
                .as_mut()
                .is_some_and(|growth| set(&mut growth.size, size)),
            (
                MotionKind::Directed(Directed { size: amount, .. })
                | MotionKind::Circular(Circular { size: amount, .. }),
                _,
            ) => {
                let free = set(&mut amount.first, size);
                if free && second.is_some() {
                    amount.second = second;
                    self.at += 2;
                }
                free
            }
            (MotionKind::Wrist { size: own, .. }, _) => set(own, size),
            _ => false,
        }
    }

    fn repetition(&mut self) -> Repetition {
        let mut repetition = Repetition::plain(self.repeat());
        if let Some(Kind::Repeat(_)) = self.peek() {
            repetition.second = Some(self.repeat());
        }
        repetition.growth = self.growth();
        repetition.approx = self.eat(Kind::Approx);
        repetition
    }

    fn repeat(&mut self) -> Repeat {
        match self.peek() {
            Some(Kind::Repeat(repeat)) => {
                self.at += 1;
                repeat
            }
            _ => Repeat::FromStart,
        }
    }

    fn growth(&mut self) -> Option<Growth> {
        let Some(Kind::Growth { increasing }) = self.peek() else {
            return None;
        };
        self.at += 1;
        Some(Growth {
            increasing,
            size: self.eat_size(),
        })
    }

    fn eat_size(&mut self) -> Option<Size> {
        let Some(Kind::Size(size)) = self.peek() else {
            return None;
        };
        self.at += 1;
        Some(size)
    }

    /// Reads a repetition in brackets with the movement from one to the next.
    fn moving_repetition(&mut self) -> Parsed<Repetition> {
        let opened = self.at;
        self.at += 1;
        let mut repetition = self.repetition();
        if let Some(Kind::Move(_)) = self.peek() {
            repetition.shift = Some(self.direction(|kind| match kind {
                Kind::Move(direction) => Some(direction),
                _ => None,
            }));
            repetition.shift_size = self.eat_size();
            repetition.shift_growth = self.growth();
        } else if !matches!(self.peek(), Some(Kind::Close(_))) {
            self.missing("the movement from one repetition to the next")?;
        }
        while let Some(kind) = self.peek() {
            match kind {
                Kind::Close(_) => break,
                Kind::Open(_) => self.unexpected("hamseqend")?,
                _ => self.drop(
                    "the tree holds one straight movement from one repetition to the next",
                    "write one movement with its size",
                ),
            }
        }
        self.close(opened, Bracket::Seq)?;
        Ok(repetition)
    }
}

fn change(posture: Posture) -> MotionKind {
    MotionKind::Target {
        motion: None,
        posture: Box::new(posture),
    }
}

fn target(motion: Motion, place: Place) -> MotionKind {
    MotionKind::Target {
        motion: Some(Box::new(motion)),
        posture: Box::new(Posture {
            place: Some(place),
            ..Posture::default()
        }),
    }
}

fn repeated(motion: Motion, repetition: Repetition) -> MotionKind {
    MotionKind::Repeated {
        motion: Box::new(motion),
        repetition,
    }
}

fn manner_flag(manner: &mut Manner, mark: Mark) -> &mut bool {
    match mark {
        Mark::Fast => &mut manner.fast,
        Mark::Slow => &mut manner.slow,
        Mark::Tense => &mut manner.tense,
        Mark::Rest => &mut manner.rest,
        Mark::Halt => &mut manner.halt,
    }
}

/// Sets an empty slot; returns whether it was empty.
fn set<T>(slot: &mut Option<T>, value: T) -> bool {
    let free = slot.is_none();
    slot.get_or_insert(value);
    free
}

/// Adds a curve, or makes it diagonal by a second mark.
fn bulge(curve: &mut Option<Curve>, to: Compass) -> bool {
    let Some(first) = curve else {
        *curve = Some(Curve { to, size: None });
        return true;
    };
    let gap = (first.to as i8 - to as i8).rem_euclid(8);
    if first.size.is_some() || !(gap == 2 || gap == 6) {
        return false;
    }
    let between = if gap == 2 {
        to as usize + 1
    } else {
        first.to as usize + 1
    };
    first.to = Compass::ALL[between % 8];
    true
}

fn grow(kind: &mut MotionKind, growth: Growth, last: &mut Last) -> bool {
    match kind {
        MotionKind::Directed(Directed {
            zigzag: Some(zigzag),
            ..
        }) => {
            *last = Last::ZigzagGrowth;
            set(&mut zigzag.growth, growth)
        }
        MotionKind::Circular(circle) => {
            let of_zigzag = *last == Last::Zigzag;
            match &mut circle.zigzag {
                Some(zigzag) if of_zigzag => {
                    *last = Last::ZigzagGrowth;
                    set(&mut zigzag.growth, growth)
                }
                _ => {
                    *last = Last::Growth;
                    set(&mut circle.growth, growth)
                }
            }
        }
        _ => false,
    }
}

fn takes_size(kind: &MotionKind) -> bool {
    matches!(
        kind,
        MotionKind::Directed(_) | MotionKind::Circular(_) | MotionKind::Wrist { .. }
    )
}
