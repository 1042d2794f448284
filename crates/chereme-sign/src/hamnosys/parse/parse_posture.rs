//! Reads handshapes and orientations, for both hands or one by one.

use super::{HamnosysParsed, HamnosysParser};
use crate::hamnosys::direction::{CompassDirection, SpatialDirection};
use crate::hamnosys::symbol::{BracketKind, SymbolKind};
use crate::hamnosys::tree::{
    CeeOpening, DigitList, DirectionAim, DirectionFrame, EachHand, FingerBend, FingerContact, HandClass, HandDigit,
    Handshape, HandshapeForm, MotionSize, NotatedPosture, ThumbExtra, ThumbPosition,
};

/// One half of a split configuration.
#[derive(Default)]
struct SplitHandHalf {
    shape: Option<Handshape>,
    extended: Option<DirectionAim<SpatialDirection>>,
    palm: Option<DirectionAim<CompassDirection>>,
    place: Option<crate::hamnosys::tree::HandPlace>,
}

impl HamnosysParser<'_> {
    /// Reads the handshape, orientation and place that are present.
    pub(super) fn parse_hand_posture(&mut self) -> HamnosysParsed<NotatedPosture> {
        let mut posture = NotatedPosture::default();
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Base(_)) if posture.shape.is_unset() => {
                    posture.shape = EachHand::Shared(self.parse_handshape()?);
                }
                Some(SymbolKind::Extended(_)) if posture.extended.is_unset() => {
                    posture.extended = EachHand::Shared(self.parse_extended_direction()?);
                }
                Some(SymbolKind::Palm(_)) if posture.palm.is_unset() => {
                    posture.palm = EachHand::Shared(self.parse_palm_direction()?);
                }
                Some(SymbolKind::Open(BracketKind::Par)) if self.at_split_config(&posture) => {
                    self.split_config(&mut posture)?;
                }
                _ => break,
            }
        }
        if posture.place.is_none() && self.at_place() {
            posture.place = Some(self.parse_hand_place()?);
        }
        Ok(posture)
    }

    /// Returns whether a group is a configuration for each hand, of parts that are not set yet.
    pub(super) fn at_split_config(&self, posture: &NotatedPosture) -> bool {
        self.is_split_config(self.at, posture)
    }

    pub(super) fn is_split_config(&self, at: usize, posture: &NotatedPosture) -> bool {
        let (inside, Some(plus)) = self.group_tokens(at) else {
            return false;
        };
        let first = inside
            .iter()
            .find(|token| !matches!(token.kind, SymbolKind::Plus | SymbolKind::Still));
        let config = |kind| {
            matches!(
                kind,
                SymbolKind::Base(_) | SymbolKind::Extended(_) | SymbolKind::Palm(_)
            )
        };
        let Some(first) = first else {
            return false;
        };
        // A second bracket of the same kind is no configuration, as each is written once.
        let taken = match first.kind {
            SymbolKind::Base(_) => !posture.shape.is_unset(),
            SymbolKind::Extended(_) => !posture.extended.is_unset(),
            SymbolKind::Palm(_) => !posture.palm.is_unset(),
            _ => true,
        };
        let half_begins = |token: Option<&super::LexedSymbol>| {
            token.is_none_or(|token| config(token.kind) || token.kind == SymbolKind::Still)
        };
        !taken && half_begins(inside[..plus].first()) && half_begins(inside[plus + 1..].first())
    }

    fn split_config(&mut self, posture: &mut NotatedPosture) -> HamnosysParsed<()> {
        let opened = self.at;
        self.at += 1;
        let dominant = self.parse_split_half()?;
        if !self.eat_symbol_kind(SymbolKind::Plus) {
            self.report_missing_symbol("hamplus between the two hands")?;
        }
        let other = self.parse_split_half()?;
        self.close_bracket(opened, BracketKind::Par)?;
        set_split_values(&mut posture.shape, dominant.shape, other.shape);
        set_split_values(&mut posture.extended, dominant.extended, other.extended);
        set_split_values(&mut posture.palm, dominant.palm, other.palm);
        if dominant.place.is_some() || other.place.is_some() {
            posture.place = Some(crate::hamnosys::tree::HandPlace::Split(
                dominant.place.map(Box::new),
                other.place.map(Box::new),
            ));
        }
        Ok(())
    }

    fn parse_split_half(&mut self) -> HamnosysParsed<SplitHandHalf> {
        let mut half = SplitHandHalf::default();
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Base(_)) if half.shape.is_none() => {
                    half.shape = Some(self.parse_handshape()?);
                }
                Some(SymbolKind::Extended(_)) if half.extended.is_none() => {
                    half.extended = Some(self.parse_extended_direction()?);
                }
                Some(SymbolKind::Palm(_)) if half.palm.is_none() => half.palm = Some(self.parse_palm_direction()?),
                Some(SymbolKind::Still) => self.at += 1,
                None | Some(SymbolKind::Plus | SymbolKind::Close(_)) => return Ok(half),
                _ if half.place.is_none() && self.at_place() => half.place = Some(self.parse_hand_place()?),
                _ => self.refuse_next_symbol("a handshape, a direction, a palm, a place, hamplus or hamparend")?,
            }
        }
    }

    /// Reads the direction of the hand's axis: one symbol, two that form a corner, or the middle of two.
    pub(super) fn parse_extended_direction(&mut self) -> HamnosysParsed<DirectionAim<SpatialDirection>> {
        let mut aim = DirectionAim::aim_at(self.extended_direction()?);
        let between = self.next_is(0, SymbolKind::Between)
            && matches!(self.symbol_kind_at(self.at + 1), Some(SymbolKind::Extended(_)));
        self.at += usize::from(between);
        if between || matches!(self.peek_symbol_kind(), Some(SymbolKind::Extended(_))) {
            aim.second = Some(self.extended_direction()?);
        }
        self.aim_marks(&mut aim);
        Ok(aim)
    }

    fn extended_direction(&mut self) -> HamnosysParsed<SpatialDirection> {
        let Some(SymbolKind::Extended(first)) = self.peek_symbol_kind() else {
            self.report_missing_symbol("a direction of the extended finger")?;
            return Ok(SpatialDirection::OUT_DIRECTION);
        };
        self.at += 1;
        if let Some(SymbolKind::Extended(second)) = self.peek_symbol_kind()
            && let Some(corner) = first.corner_with(second)
        {
            self.at += 1;
            return Ok(corner);
        }
        Ok(first)
    }

    /// Reads the direction of the palm: one symbol, or the middle of two.
    pub(super) fn parse_palm_direction(&mut self) -> HamnosysParsed<DirectionAim<CompassDirection>> {
        let Some(SymbolKind::Palm(first)) = self.peek_symbol_kind() else {
            self.report_missing_symbol("a palm orientation")?;
            return Ok(DirectionAim::aim_at(CompassDirection::D));
        };
        self.at += 1;
        let mut aim = DirectionAim::aim_at(first);
        let between = self.next_is(0, SymbolKind::Between)
            && matches!(self.symbol_kind_at(self.at + 1), Some(SymbolKind::Palm(_)));
        self.at += usize::from(between);
        if let Some(SymbolKind::Palm(second)) = self.peek_symbol_kind() {
            aim.second = Some(second);
            self.at += 1;
        }
        self.aim_marks(&mut aim);
        Ok(aim)
    }

    fn aim_marks<D>(&mut self, aim: &mut DirectionAim<D>) {
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Approx) if !aim.approx => aim.approx = true,
                Some(SymbolKind::Relative) if aim.frame == DirectionFrame::Plain => {
                    aim.frame = DirectionFrame::Relative
                }
                _ => return,
            }
            self.at += 1;
        }
    }

    /// Reads a handshape with all its modifiers.
    pub(super) fn parse_handshape(&mut self) -> HamnosysParsed<Handshape> {
        let from = self.at;
        let mut shape = Handshape {
            form: self.parse_hand_form()?,
            ..Handshape::default()
        };
        let mut digits = Vec::new();
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Between) if matches!(self.symbol_kind_at(self.at + 1), Some(SymbolKind::Base(_))) => {
                    // A shape lies between two others at most.
                    if shape.between.is_some() {
                        break;
                    }
                    self.at += 1;
                    shape.between = Some(self.parse_hand_form()?);
                }
                Some(SymbolKind::Between) if shape.thumb.is_none() => {
                    let Some((extra, length)) = self.thumb_between() else {
                        break;
                    };
                    shape.thumb = Some(extra);
                    self.at += length;
                }
                Some(SymbolKind::Approx) if !shape.approx => {
                    shape.approx = true;
                    self.at += 1;
                }
                Some(SymbolKind::Thumb(_) | SymbolKind::Bend(_)) => {
                    // Marks belong to the last written of two forms.
                    let form = shape.between.as_mut().unwrap_or(&mut shape.form);
                    let mut marked = *form;
                    self.form_marks(&mut marked);
                    *shape.between.as_mut().unwrap_or(&mut shape.form) = marked;
                }
                Some(SymbolKind::Digit(digit)) => {
                    if !self.parse_finger_marks(digit, &mut shape, &mut digits) {
                        break;
                    }
                }
                Some(SymbolKind::Part(part))
                    if shape.thumb.is_none() && ends_shape(self.symbol_kind_at(self.at + 1)) =>
                {
                    shape.thumb = Some(ThumbExtra::Contact(part));
                    self.at += 1;
                }
                _ => break,
            }
        }
        sort_digits(&mut shape, &digits);
        shape.written = self.written_symbols_since(from, |out| out.write_handshape(&shape));
        Ok(shape)
    }

    fn parse_hand_form(&mut self) -> HamnosysParsed<HandshapeForm> {
        let Some(SymbolKind::Base(class)) = self.peek_symbol_kind() else {
            self.report_missing_symbol("a handshape")?;
            return Ok(HandshapeForm::default());
        };
        self.at += 1;
        let mut form = HandshapeForm {
            class,
            ..HandshapeForm::default()
        };
        self.form_marks(&mut form);
        Ok(form)
    }

    fn form_marks(&mut self, form: &mut HandshapeForm) {
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Thumb(thumb)) => {
                    if form.thumb.is_some() || form.opening.is_some() {
                        self.note_symbol_finding("the thumb's position is there twice", "write one", true);
                    }
                    // In a C, the marks of the thumb say how far it is open.
                    match cee_opening(form.class, thumb) {
                        None => form.thumb = Some(thumb),
                        opening => form.opening = opening,
                    }
                    self.at += 1;
                }
                Some(SymbolKind::Bend(bend)) => {
                    if form.bend.is_some() {
                        self.note_symbol_finding("the bend is there twice", "write one, or hambetween", true);
                    }
                    form.bend = Some(self.parse_finger_bend(bend));
                }
                _ => return,
            }
        }
    }

    /// Takes a bend, or the middle of two.
    fn parse_finger_bend(&mut self, first: FingerBend) -> FingerBend {
        self.at += 1;
        match self.symbol_kind_at(self.at + 1) {
            Some(SymbolKind::Bend(second)) if self.next_is(0, SymbolKind::Between) => {
                self.at += 2;
                middle_bend(first, second)
            }
            _ => first,
        }
    }

    /// Takes a finger of a handshape with its marks; returns false if the finger begins a place.
    fn parse_finger_marks(&mut self, digit: HandDigit, shape: &mut Handshape, digits: &mut Vec<HandDigit>) -> bool {
        let second = |kind| match kind {
            Some(SymbolKind::Digit(second)) => Some(second),
            _ => None,
        };
        let (one, two) = (self.symbol_kind_at(self.at + 1), self.symbol_kind_at(self.at + 2));
        let contact = match (one, two) {
            (Some(SymbolKind::Part(part)), Some(SymbolKind::Digit(second))) => Some((second, Some(part), 3)),
            (Some(CROSS_CONTACT_KIND), two) => second(two).map(|second| (second, None, 3)),
            (Some(SymbolKind::Part(part)), Some(CROSS_CONTACT_KIND)) => {
                second(self.symbol_kind_at(self.at + 3)).map(|second| (second, Some(part), 4))
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
            Some(SymbolKind::Bend(bend)) => {
                self.at += 1;
                if shape.bends[digit as usize].is_some() {
                    self.note_symbol_finding("the bend of this digit is there twice", "write one", true);
                }
                shape.bends[digit as usize] = Some(self.parse_finger_bend(bend));
                return true;
            }
            Some(SymbolKind::Size(MotionSize::Big)) => {
                // A finding names the symbol before the reader.
                if shape.opposed.is_some() {
                    self.at += 1;
                    self.note_symbol_finding("a second finger that the thumb meets", "mark one", true);
                    self.at -= 1;
                }
                shape.opposed = shape.opposed.or(Some(digit));
                self.at += 1;
            }
            // A part of a finger at the end is where the thumb touches; anything else begins a place.
            Some(SymbolKind::Part(_)) if ends_shape(two) => {}
            Some(SymbolKind::Part(_) | SymbolKind::Contact(_)) => return false,
            Some(SymbolKind::Open(BracketKind::Seq)) if matches!(two, Some(SymbolKind::Contact(_))) => {
                return false;
            }
            _ => {}
        }
        if digits.contains(&digit) {
            self.note_symbol_finding("the digit is there twice", "write it once", true);
        } else {
            digits.push(digit);
        }
        self.at += 1;
        true
    }

    /// Returns the position of the thumb given by a hambetween that joins no handshapes, and its length.
    fn thumb_between(&self) -> Option<(ThumbExtra, usize)> {
        match (self.symbol_kind_at(self.at + 1), self.symbol_kind_at(self.at + 2)) {
            (Some(SymbolKind::Digit(one)), Some(SymbolKind::Digit(two))) => Some((ThumbExtra::Between(one, two), 3)),
            (
                Some(SymbolKind::Extended(_) | SymbolKind::Palm(_) | SymbolKind::Plus | SymbolKind::Close(_)) | None,
                _,
            ) => Some((ThumbExtra::Enclosed, 1)),
            _ => None,
        }
    }
}

const CROSS_CONTACT_KIND: SymbolKind = SymbolKind::Contact(crate::hamnosys::tree::PlaceContact::Cross);

/// Returns whether this symbol can follow a complete handshape, so that a part of a finger before it
/// belongs to the handshape.
fn ends_shape(kind: Option<SymbolKind>) -> bool {
    use SymbolKind as K;
    matches!(kind, Some(K::Extended(_) | K::Palm(_) | K::Plus | K::Close(_)))
}

fn set_split_values<T>(each: &mut EachHand<T>, dominant: Option<T>, other: Option<T>) {
    if dominant.is_some() || other.is_some() {
        *each = EachHand::Split(dominant, other);
    }
}

/// Returns the opening of a cee by the mark of its thumb.
fn cee_opening(class: HandClass, thumb: ThumbPosition) -> Option<CeeOpening> {
    match (is_cee(class), thumb) {
        (true, ThumbPosition::Across) => Some(CeeOpening::Tight),
        (true, ThumbPosition::Opposed) => Some(CeeOpening::Slack),
        _ => None,
    }
}

fn is_cee(class: HandClass) -> bool {
    use HandClass as C;
    matches!(class, C::Cee12 | C::Cee12Open | C::CeeAll)
}

/// Sorts the digits after a handshape: those that replace its own, and those that the bend leaves out (as
/// the University of East Anglia's converter reads them).
fn sort_digits(shape: &mut Handshape, digits: &[HandDigit]) {
    use HandClass as C;
    let thumb = |digit: &&HandDigit| **digit == HandDigit::Thumb;
    let fingers = || digits.iter().filter(|digit| !thumb(digit)).copied();
    let thumbs = || digits.iter().filter(thumb).copied();
    let bent = shape.form.bend.is_some() || shape.between.is_some_and(|form| form.bend.is_some());
    let all = DigitList(digits.to_vec());
    let (special, exempt) = match shape.form.class {
        C::Fist | C::Flat | C::Finger2345 if bent => (DigitList::default(), all),
        C::Fist | C::Flat | C::Finger2345 => (all, DigitList::default()),
        C::PinchAll | C::CeeAll => (DigitList::default(), all),
        C::Finger23 | C::Finger23Spread if fingers().count() < 2 => (DigitList::default(), all),
        C::Finger2 | C::Finger23 | C::Finger23Spread => (DigitList(fingers().collect()), DigitList(thumbs().collect())),
        C::Pinch12 | C::Pinch12Open | C::Cee12 | C::Cee12Open => (all, DigitList::default()),
    };
    shape.special = special;
    shape.exempt = exempt;
}

/// Returns the joints half-way between two bends, rounded down joint by joint.
fn middle_bend(first: FingerBend, second: FingerBend) -> FingerBend {
    let (a, b) = (first.joint_bends(), second.joint_bends());
    FingerBend::Joints(std::array::from_fn(|joint| ((a[joint] + b[joint]) / 2.0).floor()))
}
