//! Reads handshapes and orientations, for both hands or one by one.

use super::{Parsed, Parser};
use crate::hamnosys::direction::{Compass, Direction};
use crate::hamnosys::symbol::{Bracket, Kind};
use crate::hamnosys::tree::{
    Aim, Bend, Digit, Digits, Each, FingerContact, Form, Frame, HandClass, Handshape, Opening,
    Posture, Size, ThumbExtra, ThumbPosition,
};

/// One half of a split configuration.
#[derive(Default)]
struct Half {
    shape: Option<Handshape>,
    extended: Option<Aim<Direction>>,
    palm: Option<Aim<Compass>>,
    place: Option<crate::hamnosys::tree::Place>,
}

impl Parser<'_> {
    /// Reads the handshape, orientation and place that are present.
    pub(super) fn posture(&mut self) -> Parsed<Posture> {
        let mut posture = Posture::default();
        loop {
            match self.peek() {
                Some(Kind::Base(_)) if posture.shape.is_unset() => {
                    posture.shape = Each::Shared(self.handshape()?);
                }
                Some(Kind::Extended(_)) if posture.extended.is_unset() => {
                    posture.extended = Each::Shared(self.extended()?);
                }
                Some(Kind::Palm(_)) if posture.palm.is_unset() => {
                    posture.palm = Each::Shared(self.palm()?);
                }
                Some(Kind::Open(Bracket::Par)) if self.at_split_config(&posture) => {
                    self.split_config(&mut posture)?;
                }
                _ => break,
            }
        }
        if posture.place.is_none() && self.at_place() {
            posture.place = Some(self.place()?);
        }
        Ok(posture)
    }

    /// Returns whether a group is a configuration for each hand, of parts that are not set yet.
    pub(super) fn at_split_config(&self, posture: &Posture) -> bool {
        self.is_split_config(self.at, posture)
    }

    pub(super) fn is_split_config(&self, at: usize, posture: &Posture) -> bool {
        let (inside, Some(plus)) = self.group(at) else {
            return false;
        };
        let first = inside
            .iter()
            .find(|token| !matches!(token.kind, Kind::Plus | Kind::Still));
        let config = |kind| matches!(kind, Kind::Base(_) | Kind::Extended(_) | Kind::Palm(_));
        let Some(first) = first else {
            return false;
        };
        let taken = match first.kind {
            Kind::Base(_) => !posture.shape.is_unset(),
            Kind::Extended(_) => !posture.extended.is_unset(),
            Kind::Palm(_) => !posture.palm.is_unset(),
            _ => true,
        };
        let half_begins = |token: Option<&super::Token>| {
            token.is_none_or(|token| config(token.kind) || token.kind == Kind::Still)
        };
        !taken && half_begins(inside[..plus].first()) && half_begins(inside[plus + 1..].first())
    }

    fn split_config(&mut self, posture: &mut Posture) -> Parsed<()> {
        let opened = self.at;
        self.at += 1;
        let dominant = self.half()?;
        if !self.eat(Kind::Plus) {
            self.missing("hamplus between the two hands")?;
        }
        let other = self.half()?;
        self.close(opened, Bracket::Par)?;
        split(&mut posture.shape, dominant.shape, other.shape);
        split(&mut posture.extended, dominant.extended, other.extended);
        split(&mut posture.palm, dominant.palm, other.palm);
        if dominant.place.is_some() || other.place.is_some() {
            posture.place = Some(crate::hamnosys::tree::Place::Split(
                dominant.place.map(Box::new),
                other.place.map(Box::new),
            ));
        }
        Ok(())
    }

    fn half(&mut self) -> Parsed<Half> {
        let mut half = Half::default();
        loop {
            match self.peek() {
                Some(Kind::Base(_)) if half.shape.is_none() => {
                    half.shape = Some(self.handshape()?);
                }
                Some(Kind::Extended(_)) if half.extended.is_none() => {
                    half.extended = Some(self.extended()?);
                }
                Some(Kind::Palm(_)) if half.palm.is_none() => half.palm = Some(self.palm()?),
                Some(Kind::Still) => self.at += 1,
                None | Some(Kind::Plus | Kind::Close(_)) => return Ok(half),
                _ if half.place.is_none() && self.at_place() => half.place = Some(self.place()?),
                _ => self.unexpected(
                    "a handshape, a direction, a palm, a place, hamplus or hamparend",
                )?,
            }
        }
    }

    /// Reads the direction of the hand's axis: one symbol, two that form a corner, or the middle of two.
    pub(super) fn extended(&mut self) -> Parsed<Aim<Direction>> {
        let mut aim = Aim::at(self.extended_direction()?);
        let between = self.next_is(0, Kind::Between)
            && matches!(self.kind(self.at + 1), Some(Kind::Extended(_)));
        self.at += usize::from(between);
        if between || matches!(self.peek(), Some(Kind::Extended(_))) {
            aim.second = Some(self.extended_direction()?);
        }
        self.aim_marks(&mut aim);
        Ok(aim)
    }

    fn extended_direction(&mut self) -> Parsed<Direction> {
        let Some(Kind::Extended(first)) = self.peek() else {
            self.missing("a direction of the extended finger")?;
            return Ok(Direction::OUT);
        };
        self.at += 1;
        if let Some(Kind::Extended(second)) = self.peek()
            && let Some(corner) = first.corner_with(second)
        {
            self.at += 1;
            return Ok(corner);
        }
        Ok(first)
    }

    /// Reads the direction of the palm: one symbol, or the middle of two.
    pub(super) fn palm(&mut self) -> Parsed<Aim<Compass>> {
        let Some(Kind::Palm(first)) = self.peek() else {
            self.missing("a palm orientation")?;
            return Ok(Aim::at(Compass::D));
        };
        self.at += 1;
        let mut aim = Aim::at(first);
        let between =
            self.next_is(0, Kind::Between) && matches!(self.kind(self.at + 1), Some(Kind::Palm(_)));
        self.at += usize::from(between);
        if let Some(Kind::Palm(second)) = self.peek() {
            aim.second = Some(second);
            self.at += 1;
        }
        self.aim_marks(&mut aim);
        Ok(aim)
    }

    fn aim_marks<D>(&mut self, aim: &mut Aim<D>) {
        loop {
            match self.peek() {
                Some(Kind::Approx) if !aim.approx => aim.approx = true,
                Some(Kind::Relative) if aim.frame == Frame::Plain => aim.frame = Frame::Relative,
                _ => return,
            }
            self.at += 1;
        }
    }

    /// Reads a handshape with all its modifiers.
    pub(super) fn handshape(&mut self) -> Parsed<Handshape> {
        let from = self.at;
        let mut shape = Handshape {
            form: self.form()?,
            ..Handshape::default()
        };
        let mut digits = Vec::new();
        loop {
            match self.peek() {
                Some(Kind::Between) if matches!(self.kind(self.at + 1), Some(Kind::Base(_))) => {
                    if shape.between.is_some() {
                        break;
                    }
                    self.at += 1;
                    shape.between = Some(self.form()?);
                }
                Some(Kind::Between) if shape.thumb.is_none() => {
                    let Some((extra, length)) = self.thumb_between() else {
                        break;
                    };
                    shape.thumb = Some(extra);
                    self.at += length;
                }
                Some(Kind::Approx) if !shape.approx => {
                    shape.approx = true;
                    self.at += 1;
                }
                Some(Kind::Thumb(_) | Kind::Bend(_)) => {
                    let form = shape.between.as_mut().unwrap_or(&mut shape.form);
                    let mut marked = *form;
                    self.form_marks(&mut marked);
                    *shape.between.as_mut().unwrap_or(&mut shape.form) = marked;
                }
                Some(Kind::Digit(digit)) => {
                    if !self.finger(digit, &mut shape, &mut digits) {
                        break;
                    }
                }
                Some(Kind::Part(part))
                    if shape.thumb.is_none() && ends_shape(self.kind(self.at + 1)) =>
                {
                    shape.thumb = Some(ThumbExtra::Contact(part));
                    self.at += 1;
                }
                _ => break,
            }
        }
        sort_digits(&mut shape, &digits);
        shape.written = self.written(from, |out| out.handshape(&shape));
        Ok(shape)
    }

    fn form(&mut self) -> Parsed<Form> {
        let Some(Kind::Base(class)) = self.peek() else {
            self.missing("a handshape")?;
            return Ok(Form::default());
        };
        self.at += 1;
        let mut form = Form {
            class,
            ..Form::default()
        };
        self.form_marks(&mut form);
        Ok(form)
    }

    fn form_marks(&mut self, form: &mut Form) {
        loop {
            match self.peek() {
                Some(Kind::Thumb(thumb)) => {
                    if form.thumb.is_some() || form.opening.is_some() {
                        self.note("the thumb's position is there twice", "write one", true);
                    }
                    match opening(form.class, thumb) {
                        None => form.thumb = Some(thumb),
                        opening => form.opening = opening,
                    }
                    self.at += 1;
                }
                Some(Kind::Bend(bend)) => {
                    if form.bend.is_some() {
                        self.note("the bend is there twice", "write one, or hambetween", true);
                    }
                    form.bend = Some(self.bend(bend));
                }
                _ => return,
            }
        }
    }

    /// Takes a bend, or the middle of two.
    fn bend(&mut self, first: Bend) -> Bend {
        self.at += 1;
        match self.kind(self.at + 1) {
            Some(Kind::Bend(second)) if self.next_is(0, Kind::Between) => {
                self.at += 2;
                middle_bend(first, second)
            }
            _ => first,
        }
    }

    /// Takes a finger of a handshape with its marks; returns false if the finger begins a place.
    fn finger(&mut self, digit: Digit, shape: &mut Handshape, digits: &mut Vec<Digit>) -> bool {
        let second = |kind| match kind {
            Some(Kind::Digit(second)) => Some(second),
            _ => None,
        };
        let (one, two) = (self.kind(self.at + 1), self.kind(self.at + 2));
        let contact = match (one, two) {
            (Some(Kind::Part(part)), Some(Kind::Digit(second))) => Some((second, Some(part), 3)),
            (Some(CROSS), two) => second(two).map(|second| (second, None, 3)),
            (Some(Kind::Part(part)), Some(CROSS)) => {
                second(self.kind(self.at + 3)).map(|second| (second, Some(part), 4))
            }
            _ => None,
        };
        if let Some((second, part, length)) = contact {
            shape.contacts.push(FingerContact {
                first: digit,
                second,
                part,
            });
            self.at += length;
            return true;
        }
        match one {
            Some(Kind::Bend(bend)) => {
                self.at += 1;
                if shape.bends[digit as usize].is_some() {
                    self.note("the bend of this digit is there twice", "write one", true);
                }
                shape.bends[digit as usize] = Some(self.bend(bend));
                return true;
            }
            Some(Kind::Size(Size::Big)) => {
                if shape.opposed.is_some() {
                    self.at += 1;
                    self.note("a second finger that the thumb meets", "mark one", true);
                    self.at -= 1;
                }
                shape.opposed = shape.opposed.or(Some(digit));
                self.at += 1;
            }
            Some(Kind::Part(_)) if ends_shape(two) => {}
            Some(Kind::Part(_) | Kind::Contact(_)) => return false,
            Some(Kind::Open(Bracket::Seq)) if matches!(two, Some(Kind::Contact(_))) => {
                return false;
            }
            _ => {}
        }
        if digits.contains(&digit) {
            self.note("the digit is there twice", "write it once", true);
        } else {
            digits.push(digit);
        }
        self.at += 1;
        true
    }

    /// Returns the position of the thumb given by a hambetween that joins no handshapes, and its length.
    fn thumb_between(&self) -> Option<(ThumbExtra, usize)> {
        match (self.kind(self.at + 1), self.kind(self.at + 2)) {
            (Some(Kind::Digit(one)), Some(Kind::Digit(two))) => {
                Some((ThumbExtra::Between(one, two), 3))
            }
            (Some(Kind::Extended(_) | Kind::Palm(_) | Kind::Plus | Kind::Close(_)) | None, _) => {
                Some((ThumbExtra::Enclosed, 1))
            }
            _ => None,
        }
    }
}

const CROSS: Kind = Kind::Contact(crate::hamnosys::tree::Contact::Cross);

/// Returns whether this symbol can follow a complete handshape, so that a part of a finger before it
/// belongs to the handshape.
fn ends_shape(kind: Option<Kind>) -> bool {
    use Kind as K;
    matches!(
        kind,
        Some(K::Extended(_) | K::Palm(_) | K::Plus | K::Close(_))
    )
}

fn split<T>(each: &mut Each<T>, dominant: Option<T>, other: Option<T>) {
    if dominant.is_some() || other.is_some() {
        *each = Each::Split(dominant, other);
    }
}

/// Returns the opening of a cee by the mark of its thumb.
fn opening(class: HandClass, thumb: ThumbPosition) -> Option<Opening> {
    match (is_cee(class), thumb) {
        (true, ThumbPosition::Across) => Some(Opening::Tight),
        (true, ThumbPosition::Opposed) => Some(Opening::Slack),
        _ => None,
    }
}

fn is_cee(class: HandClass) -> bool {
    use HandClass as C;
    matches!(class, C::Cee12 | C::Cee12Open | C::CeeAll)
}

/// Sorts the digits after a handshape: those that replace its own, and those that the bend leaves out (as
/// the University of East Anglia's converter reads them).
fn sort_digits(shape: &mut Handshape, digits: &[Digit]) {
    use HandClass as C;
    let thumb = |digit: &&Digit| **digit == Digit::Thumb;
    let fingers = || digits.iter().filter(|digit| !thumb(digit)).copied();
    let thumbs = || digits.iter().filter(thumb).copied();
    let bent = shape.form.bend.is_some() || shape.between.is_some_and(|form| form.bend.is_some());
    let all = Digits(digits.to_vec());
    let (special, exempt) = match shape.form.class {
        C::Fist | C::Flat | C::Finger2345 if bent => (Digits::default(), all),
        C::Fist | C::Flat | C::Finger2345 => (all, Digits::default()),
        C::PinchAll | C::CeeAll => (Digits::default(), all),
        C::Finger23 | C::Finger23Spread if fingers().count() < 2 => (Digits::default(), all),
        C::Finger2 | C::Finger23 | C::Finger23Spread => {
            (Digits(fingers().collect()), Digits(thumbs().collect()))
        }
        C::Pinch12 | C::Pinch12Open | C::Cee12 | C::Cee12Open => (all, Digits::default()),
    };
    shape.special = special;
    shape.exempt = exempt;
}

/// Returns the joints half-way between two bends, rounded down joint by joint.
fn middle_bend(first: Bend, second: Bend) -> Bend {
    let (a, b) = (first.joints(), second.joints());
    Bend::Joints(std::array::from_fn(|joint| {
        ((a[joint] + b[joint]) / 2.0).floor()
    }))
}
