//! Reads movements, their modifiers, and the postures they end in.

use super::{HamnosysParsed, HamnosysParser, MAX_BRACKET_DEPTH, is_motion};
use crate::hamnosys::direction::{CompassDirection, SpatialDirection};
use crate::hamnosys::symbol::{BracketKind, MannerMark, SymbolKind};
use crate::hamnosys::tree::{
    CircularPath, DigitList, DirectedPath, HandPlace, MotionGrowth, MotionKind, MotionManner, MotionRepetition,
    MotionSize, NotatedMotion, NotatedPosture, PathCurve, PathZigzag, PlaceContact, RepeatKind,
};

/// A motion with its depth of nesting.
type NestedMotion = (NotatedMotion, usize);

/// The element that a size mark would belong to.
#[derive(Clone, Copy, PartialEq)]
enum SizeMarkTarget {
    Path,
    Curve,
    Zigzag,
    ZigzagGrowth,
    Ellipse,
    Growth,
    Other,
}

impl HamnosysParser<'_> {
    /// Reads movements up to the end of the part, of the bracket, or hamplus.
    pub(super) fn parse_actions(&mut self) -> HamnosysParsed<Vec<NotatedMotion>> {
        Ok(self.deep_actions()?.into_iter().map(|deep| deep.0).collect())
    }

    fn deep_actions(&mut self) -> HamnosysParsed<Vec<NestedMotion>> {
        let mut motions = Vec::new();
        while let Some(kind) = self.peek_symbol_kind() {
            match kind {
                SymbolKind::Plus => break,
                SymbolKind::Close(_) if self.depth > 0 => break,
                SymbolKind::Symmetry { .. } | SymbolKind::Base(_) if self.depth == 0 => break,
                SymbolKind::Nondominant if self.depth == 0 && !self.motion_follows() => break,
                SymbolKind::Open(BracketKind::Par)
                    if self.depth == 0 && self.begins_split_shape() && !motions.is_empty() =>
                {
                    break;
                }
                _ if self.begins_action(kind) => motions.push(self.deeper(Self::parse_action)?),
                _ => self.refuse_next_symbol("a movement, a place it ends at, or the end")?,
            }
        }
        Ok(motions)
    }

    fn motion_follows(&self) -> bool {
        self.symbol_kind_at(self.at + 1)
            .is_some_and(|kind| is_motion(kind) || matches!(kind, SymbolKind::Replace | SymbolKind::Open(_)))
    }

    fn begins_split_shape(&self) -> bool {
        matches!(self.symbol_kind_at(self.at + 1), Some(SymbolKind::Base(_)))
            && self.at_split_config(&NotatedPosture::default())
    }

    fn begins_action(&self, kind: SymbolKind) -> bool {
        match kind {
            SymbolKind::Replace | SymbolKind::Open(_) | SymbolKind::Manner(_) | SymbolKind::Repeat(_) => true,
            SymbolKind::Base(_) | SymbolKind::Extended(_) | SymbolKind::Palm(_) | SymbolKind::Nondominant => true,
            SymbolKind::Alternating => true,
            kind => is_motion(kind) || self.at_place(),
        }
    }

    /// Reads one movement with all its following modifiers.
    pub(super) fn parse_action(&mut self) -> HamnosysParsed<NestedMotion> {
        let from = self.at;
        let (kind, mut height) = self.parse_core_motion()?;
        let mut motion = NotatedMotion::new(kind);
        // Each mark that follows applies to all before it, so that the motion is wrapped again and again.
        for wraps in 0.. {
            self.parse_manner_marks(&mut motion);
            motion.written = self.written_symbols_since(from, |out| out.write_motion(&motion));
            let wrapped = match self.peek_symbol_kind() {
                Some(SymbolKind::Repeat(_)) => {
                    let repetition = self.parse_repetition();
                    repeat_motion(motion, repetition)
                }
                Some(SymbolKind::Open(BracketKind::Seq)) => match self.symbol_kind_at(self.at + 1) {
                    Some(SymbolKind::Repeat(_)) => {
                        let repetition = self.moving_repetition()?;
                        repeat_motion(motion, repetition)
                    }
                    Some(SymbolKind::Contact(PlaceContact::Brushing)) => {
                        let place = self.parse_brushing_place()?;
                        target_place_motion(motion, place)
                    }
                    Some(SymbolKind::Contact(_)) => {
                        let place = self.parse_hand_place()?;
                        target_place_motion(motion, place)
                    }
                    _ => return Ok((motion, height)),
                },
                _ if self.at_place() => {
                    let place = self.parse_hand_place()?;
                    target_place_motion(motion, place)
                }
                _ => return Ok((motion, height)),
            };
            motion = NotatedMotion::new(wrapped);
            height += 1;
            // Nested as deep as brackets may be, trees are still walked without running out of stack.
            if height >= MAX_BRACKET_DEPTH || wraps >= MAX_BRACKET_DEPTH {
                return Err(self.too_deep());
            }
        }
        Ok((motion, height))
    }

    /// Reads a movement without the marks that may follow any movement.
    fn parse_core_motion(&mut self) -> HamnosysParsed<(MotionKind, usize)> {
        let Some(kind) = self.peek_symbol_kind() else {
            self.report_missing_symbol("a movement")?;
            return Ok((MotionKind::Still, 1));
        };
        Ok(match kind {
            SymbolKind::Move(_) => (self.parse_directed_motion(), 1),
            SymbolKind::Circle(_) => (self.parse_circular_motion(), 1),
            SymbolKind::Wrist(motion) => {
                self.at += 1;
                (MotionKind::Wrist { motion, size: None }, 1)
            }
            SymbolKind::Cross { diagonal } => {
                self.at += 1;
                (MotionKind::Cross { diagonal }, 1)
            }
            SymbolKind::FingerPlay => (self.finger_play(), 1),
            SymbolKind::Still => {
                self.at += 1;
                (MotionKind::Still, 1)
            }
            SymbolKind::Replace => (self.replacement()?, 1),
            SymbolKind::Nondominant => {
                self.at += 1;
                let (motion, height) = self.deeper(Self::parse_action)?;
                (MotionKind::Split(None, Some(Box::new(motion))), height + 1)
            }
            SymbolKind::Open(bracket) => return self.group_action(bracket),
            SymbolKind::Base(_) | SymbolKind::Extended(_) | SymbolKind::Palm(_) => {
                self.note_symbol_finding(
                    "a configuration without hamreplace before it",
                    "write hamreplace before what changes",
                    false,
                );
                (self.changed_posture()?, 1)
            }
            // A mark without a movement belongs to one that is not written: the hand stays.
            SymbolKind::Manner(_) | SymbolKind::Repeat(_) | SymbolKind::Alternating => (MotionKind::Still, 1),
            _ if self.at_body_action() => {
                let (body, height) = self.deeper(Self::parse_body_action)?;
                (MotionKind::Body(body), height + 1)
            }
            _ if self.at_place() => {
                let place = self.parse_hand_place()?;
                (
                    posture_change_motion(NotatedPosture {
                        place: Some(place),
                        ..NotatedPosture::default()
                    }),
                    1,
                )
            }
            _ => {
                self.refuse_next_symbol("a movement")?;
                (MotionKind::Still, 1)
            }
        })
    }

    fn replacement(&mut self) -> HamnosysParsed<MotionKind> {
        self.at += 1;
        self.drop_growth();
        let kind = self.changed_posture()?;
        self.drop_growth();
        Ok(kind)
    }

    fn drop_growth(&mut self) {
        while let Some(SymbolKind::Growth { .. }) = self.peek_symbol_kind() {
            self.drop(
                "fingers that change one after the other are not in the tree",
                "write one hamreplace for each finger, if their order matters",
            );
        }
    }

    fn changed_posture(&mut self) -> HamnosysParsed<MotionKind> {
        let posture = self.parse_hand_posture()?;
        if posture.is_empty() {
            self.report_missing_symbol("a handshape, a direction, a palm or a place after hamreplace")?;
        }
        Ok(posture_change_motion(posture))
    }

    fn group_action(&mut self, bracket: BracketKind) -> HamnosysParsed<(MotionKind, usize)> {
        let opened = self.at;
        match (bracket, self.symbol_kind_at(self.at + 1)) {
            (BracketKind::Seq, Some(SymbolKind::Repeat(_) | SymbolKind::Contact(PlaceContact::Brushing))) => {
                return Ok((MotionKind::Still, 1));
            }
            (BracketKind::Par, _) if self.at_split_config(&NotatedPosture::default()) => {
                self.note_symbol_finding(
                    "a configuration without hamreplace before it",
                    "write hamreplace before what changes",
                    false,
                );
                return Ok((self.changed_posture()?, 1));
            }
            (BracketKind::Seq | BracketKind::Par, _) if self.at_place() => {
                let place = self.parse_hand_place()?;
                let posture = NotatedPosture {
                    place: Some(place),
                    ..NotatedPosture::default()
                };
                return Ok((posture_change_motion(posture), 1));
            }
            (BracketKind::Par, _) if self.group_tokens(self.at).1.is_some() => {
                return self.split_action();
            }
            _ => {}
        }
        self.at += 1;
        let motions = self.deeper(Self::deep_actions)?;
        if motions.is_empty() {
            self.report_missing_symbol("a movement in the bracket")?;
        }
        while matches!(self.peek_symbol_kind(), Some(SymbolKind::Plus)) {
            self.refuse_next_symbol("a closing bracket; only hamparbegin has two halves")?;
        }
        self.close_bracket(opened, bracket)?;
        let height = 1 + motions.iter().map(|deep| deep.1).max().unwrap_or_default();
        let motions = motions.into_iter().map(|deep| deep.0).collect();
        let kind = match bracket {
            BracketKind::Par => MotionKind::Parallel(motions),
            BracketKind::Seq | BracketKind::Fusion => MotionKind::Sequence {
                motions,
                fused: bracket == BracketKind::Fusion,
            },
        };
        Ok((kind, height))
    }

    fn split_action(&mut self) -> HamnosysParsed<(MotionKind, usize)> {
        let opened = self.at;
        self.at += 1;
        let dominant = self.deeper(Self::half_action)?;
        if !self.eat_symbol_kind(SymbolKind::Plus) {
            self.report_missing_symbol("hamplus between the two hands")?;
        }
        let other = self.deeper(Self::half_action)?;
        while matches!(self.peek_symbol_kind(), Some(SymbolKind::Plus)) {
            self.refuse_next_symbol("hamparend; there are two hands only")?;
            self.deeper(Self::half_action)?;
        }
        self.close_bracket(opened, BracketKind::Par)?;
        let height = 1 + [&dominant, &other]
            .into_iter()
            .flatten()
            .map(|deep| deep.1)
            .max()
            .unwrap_or_default();
        let boxed = |deep: Option<NestedMotion>| deep.map(|deep| Box::new(deep.0));
        Ok((MotionKind::Split(boxed(dominant), boxed(other)), height))
    }

    fn half_action(&mut self) -> HamnosysParsed<Option<NestedMotion>> {
        let from = self.at;
        let mut motions = self.deep_actions()?;
        if motions.len() < 2 {
            return Ok(motions.pop());
        }
        let height = 1 + motions.iter().map(|deep| deep.1).max().unwrap_or_default();
        let motions = motions.into_iter().map(|deep| deep.0).collect();
        let mut motion = NotatedMotion::new(MotionKind::Parallel(motions));
        motion.written = self.written_symbols_since(from, |out| out.write_motion(&motion));
        Ok(Some((motion, height)))
    }

    fn finger_play(&mut self) -> MotionKind {
        self.at += 1;
        let mut digits = DigitList::default();
        while let Some(SymbolKind::Digit(digit)) = self.peek_symbol_kind() {
            if matches!(
                self.symbol_kind_at(self.at + 1),
                Some(SymbolKind::Part(_) | SymbolKind::Contact(_))
            ) {
                break;
            }
            if digits.contains_digit(digit) {
                self.note_symbol_finding("the digit is there twice", "write it once", true);
            } else {
                digits.0.push(digit);
            }
            self.at += 1;
        }
        MotionKind::FingerPlay(digits)
    }

    fn parse_directed_motion(&mut self) -> MotionKind {
        let (direction, second) = self.parse_direction_pair(|kind| match kind {
            SymbolKind::Move(direction) => Some(direction),
            _ => None,
        });
        let mut kind = MotionKind::Directed(DirectedPath {
            direction,
            second,
            size: Default::default(),
            curve: None,
            zigzag: None,
            ellipse: None,
        });
        self.modifiers(&mut kind, SizeMarkTarget::Path);
        kind
    }

    fn parse_circular_motion(&mut self) -> MotionKind {
        let (axis, second) = self.parse_direction_pair(|kind| match kind {
            SymbolKind::Circle(axis) => Some(axis),
            _ => None,
        });
        let mut kind = MotionKind::Circular(CircularPath {
            axis,
            second,
            size: Default::default(),
            ellipse: None,
            ellipse_size: None,
            clock: Default::default(),
            zigzag: None,
            growth: None,
        });
        self.modifiers(&mut kind, SizeMarkTarget::Path);
        kind
    }

    /// Takes a direction, or the middle of two.
    fn parse_direction_pair(
        &mut self,
        direction_of: fn(SymbolKind) -> Option<SpatialDirection>,
    ) -> (SpatialDirection, Option<SpatialDirection>) {
        let first = self.parse_one_direction(direction_of);
        let between =
            self.next_is(0, SymbolKind::Between) && self.symbol_kind_at(self.at + 1).and_then(direction_of).is_some();
        self.at += usize::from(between);
        (first, between.then(|| self.parse_one_direction(direction_of)))
    }

    /// Takes one symbol of a direction, or the two symbols of a corner.
    fn parse_one_direction(&mut self, direction_of: fn(SymbolKind) -> Option<SpatialDirection>) -> SpatialDirection {
        let direction_at = |parser: &Self, ahead| parser.symbol_kind_at(parser.at + ahead).and_then(direction_of);
        let first = direction_at(self, 0).unwrap_or(SpatialDirection::OUT_DIRECTION);
        let corner = direction_at(self, 1).and_then(|second| {
            let corner = first.corner_with(second)?;
            (corner.corner_parts() == Some((first, second))).then_some(corner)
        });
        self.at += 1 + usize::from(corner.is_some());
        corner.unwrap_or(first)
    }

    /// Takes marks of manner, and marks of size and form after them.
    fn parse_manner_marks(&mut self, motion: &mut NotatedMotion) {
        loop {
            self.modifiers(&mut motion.kind, SizeMarkTarget::Path);
            let manner = &mut motion.manner;
            let flag = match self.peek_symbol_kind() {
                Some(SymbolKind::Manner(mark)) => manner_flag(manner, mark),
                Some(SymbolKind::Alternating) if manner.alternating => &mut manner.second_alternating,
                Some(SymbolKind::Alternating) => &mut manner.alternating,
                Some(SymbolKind::Approx) => {
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
                Some(SymbolKind::Relative) => {
                    self.drop(
                        "relative to the movement, of a movement, is not in the tree",
                        "write it after a direction or a palm",
                    );
                    continue;
                }
                _ => return,
            };
            if std::mem::replace(flag, true) {
                self.note_symbol_finding("the mark is there twice", "write it once", true);
            }
            self.at += 1;
        }
    }

    /// Takes the marks that modify a movement's form, in any order.
    fn modifiers(&mut self, kind: &mut MotionKind, mut last: SizeMarkTarget) {
        loop {
            let there = match (self.peek_symbol_kind(), &mut *kind) {
                (Some(SymbolKind::Size(size)), kind) => self.apply_size_mark(size, kind, last),
                (Some(SymbolKind::Growth { increasing }), kind) => {
                    let growth = MotionGrowth { increasing, size: None };
                    apply_growth_mark(kind, growth, &mut last)
                }
                (Some(SymbolKind::Arc(to)), MotionKind::Directed(directed)) => {
                    last = SizeMarkTarget::Curve;
                    bulge(&mut directed.curve, to)
                }
                (
                    Some(SymbolKind::Zigzag { wavy }),
                    MotionKind::Directed(DirectedPath { zigzag, .. })
                    | MotionKind::Circular(CircularPath { zigzag, .. }),
                ) => {
                    last = SizeMarkTarget::Zigzag;
                    set_empty_slot(
                        zigzag,
                        PathZigzag {
                            wavy,
                            size: None,
                            growth: None,
                        },
                    )
                }
                (
                    Some(SymbolKind::Ellipse(axis)),
                    MotionKind::Directed(DirectedPath { ellipse, .. })
                    | MotionKind::Circular(CircularPath { ellipse, .. }),
                ) => {
                    last = SizeMarkTarget::Ellipse;
                    set_empty_slot(ellipse, axis)
                }
                (Some(SymbolKind::Clock(to)), MotionKind::Circular(circle)) => {
                    last = SizeMarkTarget::Other;
                    let clock = &mut circle.clock;
                    set_empty_slot(&mut clock.start, to) || set_empty_slot(&mut clock.end, to)
                }
                (Some(SymbolKind::ClockFull), MotionKind::Circular(circle)) => {
                    last = SizeMarkTarget::Other;
                    circle.clock.full = circle.clock.full.saturating_add(1);
                    circle.clock.full <= 8
                }
                (
                    Some(
                        SymbolKind::Arc(_)
                        | SymbolKind::Zigzag { .. }
                        | SymbolKind::Ellipse(_)
                        | SymbolKind::Clock(_)
                        | SymbolKind::ClockFull,
                    ),
                    MotionKind::Still,
                ) => return,
                (
                    Some(
                        SymbolKind::Arc(_)
                        | SymbolKind::Zigzag { .. }
                        | SymbolKind::Ellipse(_)
                        | SymbolKind::Clock(_)
                        | SymbolKind::ClockFull,
                    ),
                    _,
                ) => false,
                _ => return,
            };
            match there {
                true => self.at += 1,
                false if matches!(self.peek_symbol_kind(), Some(SymbolKind::Size(_))) && !takes_size(kind) => {
                    return;
                }
                false => self.drop(
                    "the tree has no place for this mark of this movement",
                    "write one of a kind, after the movement that it modifies",
                ),
            }
        }
    }

    fn apply_size_mark(&mut self, size: MotionSize, kind: &mut MotionKind, last: SizeMarkTarget) -> bool {
        let between = self.next_is(1, SymbolKind::Between);
        let second = match self.symbol_kind_at(self.at + 2) {
            Some(SymbolKind::Size(second)) if between => Some(second),
            _ => None,
        };
        match (kind, last) {
            (MotionKind::Directed(directed), SizeMarkTarget::Curve) => directed
                .curve
                .as_mut()
                .is_some_and(|curve| set_empty_slot(&mut curve.size, size)),
            (
                MotionKind::Directed(DirectedPath { zigzag, .. }) | MotionKind::Circular(CircularPath { zigzag, .. }),
                SizeMarkTarget::Zigzag | SizeMarkTarget::ZigzagGrowth,
            ) => zigzag.as_mut().is_some_and(|zigzag| match &mut zigzag.growth {
                Some(growth) if last == SizeMarkTarget::ZigzagGrowth => set_empty_slot(&mut growth.size, size),
                _ => set_empty_slot(&mut zigzag.size, size),
            }),
            (MotionKind::Circular(circle), SizeMarkTarget::Ellipse) => set_empty_slot(&mut circle.ellipse_size, size),
            (MotionKind::Circular(circle), SizeMarkTarget::Growth) => circle
                .growth
                .as_mut()
                .is_some_and(|growth| set_empty_slot(&mut growth.size, size)),
            (
                MotionKind::Directed(DirectedPath { size: amount, .. })
                | MotionKind::Circular(CircularPath { size: amount, .. }),
                _,
            ) => {
                let free = set_empty_slot(&mut amount.first, size);
                // The mark between the two sizes and the second one were only looked at so far.
                if free && second.is_some() {
                    amount.second = second;
                    self.at += 2;
                }
                free
            }
            (MotionKind::Wrist { size: own, .. }, _) => set_empty_slot(own, size),
            _ => false,
        }
    }

    fn parse_repetition(&mut self) -> MotionRepetition {
        let mut repetition = MotionRepetition::plain_repetition(self.parse_repeat_kind());
        if let Some(SymbolKind::Repeat(_)) = self.peek_symbol_kind() {
            repetition.second = Some(self.parse_repeat_kind());
        }
        repetition.growth = self.parse_motion_growth();
        repetition.approx = self.eat_symbol_kind(SymbolKind::Approx);
        repetition
    }

    fn parse_repeat_kind(&mut self) -> RepeatKind {
        match self.peek_symbol_kind() {
            Some(SymbolKind::Repeat(repeat)) => {
                self.at += 1;
                repeat
            }
            _ => RepeatKind::FromStart,
        }
    }

    fn parse_motion_growth(&mut self) -> Option<MotionGrowth> {
        let Some(SymbolKind::Growth { increasing }) = self.peek_symbol_kind() else {
            return None;
        };
        self.at += 1;
        Some(MotionGrowth {
            increasing,
            size: self.eat_size(),
        })
    }

    fn eat_size(&mut self) -> Option<MotionSize> {
        let Some(SymbolKind::Size(size)) = self.peek_symbol_kind() else {
            return None;
        };
        self.at += 1;
        Some(size)
    }

    /// Reads a repetition in brackets with the movement from one to the next.
    fn moving_repetition(&mut self) -> HamnosysParsed<MotionRepetition> {
        let opened = self.at;
        self.at += 1;
        let mut repetition = self.parse_repetition();
        if let Some(SymbolKind::Move(_)) = self.peek_symbol_kind() {
            repetition.shift = Some(self.parse_one_direction(|kind| match kind {
                SymbolKind::Move(direction) => Some(direction),
                _ => None,
            }));
            repetition.shift_size = self.eat_size();
            repetition.shift_growth = self.parse_motion_growth();
        } else if !matches!(self.peek_symbol_kind(), Some(SymbolKind::Close(_))) {
            self.report_missing_symbol("the movement from one repetition to the next")?;
        }
        while let Some(kind) = self.peek_symbol_kind() {
            match kind {
                SymbolKind::Close(_) => break,
                SymbolKind::Open(_) => self.refuse_next_symbol("hamseqend")?,
                _ => self.drop(
                    "the tree holds one straight movement from one repetition to the next",
                    "write one movement with its size",
                ),
            }
        }
        self.close_bracket(opened, BracketKind::Seq)?;
        Ok(repetition)
    }
}

fn posture_change_motion(posture: NotatedPosture) -> MotionKind {
    MotionKind::Target {
        motion: None,
        posture: Box::new(posture),
    }
}

fn target_place_motion(motion: NotatedMotion, place: HandPlace) -> MotionKind {
    MotionKind::Target {
        motion: Some(Box::new(motion)),
        posture: Box::new(NotatedPosture {
            place: Some(place),
            ..NotatedPosture::default()
        }),
    }
}

fn repeat_motion(motion: NotatedMotion, repetition: MotionRepetition) -> MotionKind {
    MotionKind::Repeated {
        motion: Box::new(motion),
        repetition,
    }
}

fn manner_flag(manner: &mut MotionManner, mark: MannerMark) -> &mut bool {
    match mark {
        MannerMark::Fast => &mut manner.fast,
        MannerMark::Slow => &mut manner.slow,
        MannerMark::Tense => &mut manner.tense,
        MannerMark::Rest => &mut manner.rest,
        MannerMark::Halt => &mut manner.halt,
    }
}

/// Sets an empty slot; returns whether it was empty.
fn set_empty_slot<T>(slot: &mut Option<T>, value: T) -> bool {
    let free = slot.is_none();
    slot.get_or_insert(value);
    free
}

/// Adds a curve, or makes it diagonal by a second mark.
fn bulge(curve: &mut Option<PathCurve>, to: CompassDirection) -> bool {
    let Some(first) = curve else {
        *curve = Some(PathCurve { to, size: None });
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
    first.to = CompassDirection::ALL_COMPASS_DIRECTIONS[between % 8];
    true
}

fn apply_growth_mark(kind: &mut MotionKind, growth: MotionGrowth, last: &mut SizeMarkTarget) -> bool {
    match kind {
        MotionKind::Directed(DirectedPath {
            zigzag: Some(zigzag), ..
        }) => {
            *last = SizeMarkTarget::ZigzagGrowth;
            set_empty_slot(&mut zigzag.growth, growth)
        }
        MotionKind::Circular(circle) => {
            // The mark belongs to what was written last, the zigzag or the circle.
            let of_zigzag = *last == SizeMarkTarget::Zigzag;
            match &mut circle.zigzag {
                Some(zigzag) if of_zigzag => {
                    *last = SizeMarkTarget::ZigzagGrowth;
                    set_empty_slot(&mut zigzag.growth, growth)
                }
                _ => {
                    *last = SizeMarkTarget::Growth;
                    set_empty_slot(&mut circle.growth, growth)
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
