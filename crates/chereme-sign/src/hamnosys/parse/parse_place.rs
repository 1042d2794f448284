//! Places: on the body, on a hand, in a constellation of the two hands.

use super::{HamnosysParsed, HamnosysParser};
use crate::hamnosys::symbol::{BracketKind, SymbolKind};
use crate::hamnosys::tree::{
    BodyLocation, BodyPlace, FingerBend, HandConstellation, HandLocation, HandPlace, HandSite, LocationSide,
    PlaceContact, SidedLocation, WrittenSymbols,
};

/// The contact, and the part of the hand.
type TouchingSite = (PlaceContact, Option<HandSite>);

impl HamnosysParser<'_> {
    /// Returns whether a place begins here.
    pub(super) fn at_place(&self) -> bool {
        match self.peek_symbol_kind() {
            Some(SymbolKind::Open(BracketKind::Seq)) => self.at_contact_group(),
            Some(SymbolKind::Open(BracketKind::Par)) => self.at_split_place(),
            Some(SymbolKind::Contact(PlaceContact::Brushing)) => false,
            Some(SymbolKind::Contact(_) | SymbolKind::Behind | SymbolKind::Refer) => true,
            Some(kind) => is_site(kind),
            None => false,
        }
    }

    fn at_contact_group(&self) -> bool {
        self.next_is(0, SymbolKind::Open(BracketKind::Seq))
            && matches!(self.symbol_kind_at(self.at + 1), Some(SymbolKind::Contact(contact)) if contact != PlaceContact::Brushing)
    }

    fn at_split_place(&self) -> bool {
        let (inside, Some(_)) = self.group_tokens(self.at) else {
            return false;
        };
        let mut sites = 0;
        for token in inside {
            match token.kind {
                kind if is_site(kind) => sites += 1,
                SymbolKind::Contact(_) => sites += 1,
                SymbolKind::Plus
                | SymbolKind::Between
                | SymbolKind::Behind
                | SymbolKind::Approx
                | SymbolKind::Still => {}
                SymbolKind::Define | SymbolKind::Refer | SymbolKind::Bend(_) => {}
                SymbolKind::Open(BracketKind::Seq) | SymbolKind::Close(BracketKind::Seq) => {}
                _ => return false,
            }
        }
        sites > 0
    }

    /// Reads a place.
    pub(super) fn parse_hand_place(&mut self) -> HamnosysParsed<HandPlace> {
        match self.peek_symbol_kind() {
            Some(SymbolKind::Refer) => {
                let mut number = 0;
                while self.eat_symbol_kind(SymbolKind::Refer) {
                    number += 1;
                }
                Ok(HandPlace::Named(number.min(5)))
            }
            Some(SymbolKind::Open(BracketKind::Par)) => self.split_place(),
            Some(SymbolKind::Contact(_) | SymbolKind::Open(BracketKind::Seq)) => self.bare_contact(),
            _ if self.at_body_site() => Ok(HandPlace::Body(self.parse_body_place()?)),
            _ => self.hand_place(),
        }
    }

    fn split_place(&mut self) -> HamnosysParsed<HandPlace> {
        let from = self.at;
        self.at += 1;
        let dominant = self.half_place()?;
        if !self.eat_symbol_kind(SymbolKind::Plus) {
            self.report_missing_symbol("hamplus between the places of the two hands")?;
        }
        let other = self.half_place()?;
        self.close_bracket(from, BracketKind::Par)?;
        match (dominant, other) {
            (Some(HandPlace::Hand(one)), Some(HandPlace::Hand(two)))
                // Two parts of hands without contacts of their own touch each other.
                if one.contact.is_none() && two.contact.is_none() =>
            {
                let contact = self.parse_contact()?;
                self.parse_constellation(from, Some(one), Some(two), contact)
            }
            (mut one, mut two) => {
                if let Some((contact, by)) = self.parse_contact()? {
                    for place in [&mut one, &mut two].into_iter().flatten() {
                        add_touch_contact(place, contact, by.clone());
                    }
                }
                Ok(HandPlace::Split(one.map(Box::new), two.map(Box::new)))
            }
        }
    }

    fn half_place(&mut self) -> HamnosysParsed<Option<HandPlace>> {
        let mut place = None;
        loop {
            match self.peek_symbol_kind() {
                None | Some(SymbolKind::Plus | SymbolKind::Close(_)) => return Ok(place),
                Some(SymbolKind::Still) => self.at += 1,
                _ if place.is_none() && self.at_place() => {
                    place = Some(self.deeper(Self::parse_hand_place)?);
                }
                _ => self.refuse_next_symbol("a place, hamplus or hamparend")?,
            }
        }
    }

    /// Reads a contact that no place comes before: of the two hands, or with the last contact.
    fn bare_contact(&mut self) -> HamnosysParsed<HandPlace> {
        let from = self.at;
        let Some((contact, by)) = self.parse_contact()? else {
            self.report_missing_symbol("a contact")?;
            return Ok(HandPlace::Body(BodyPlace::default()));
        };
        if contact != PlaceContact::ArmExtended {
            return self.parse_constellation(from, by.clone(), by, Some((contact, None)));
        }
        let mut place = BodyPlace {
            contact: Some(contact),
            by,
            ..BodyPlace::default()
        };
        place.written = self.written_symbols_since(from, |out| out.write_body_place(&place));
        Ok(HandPlace::Body(place))
    }

    /// Reads the rest of a constellation after the sites and the contact.
    fn parse_constellation(
        &mut self,
        from: usize,
        dominant: Option<HandSite>,
        other: Option<HandSite>,
        contact: Option<TouchingSite>,
    ) -> HamnosysParsed<HandPlace> {
        let (contact, by) = match contact {
            Some((contact, by)) => (Some(contact), by),
            None => (None, None),
        };
        if by.is_some() {
            self.note_symbol_finding(
                "the parts of the hands are said before already",
                "write the contact alone",
                true,
            );
        }
        let mut hands = HandConstellation {
            dominant,
            other,
            contact,
            ..HandConstellation::default()
        };
        // A part after the contact of the two hands is that of both.
        if self.at_hand_site() && hands.dominant.is_none() && contact.is_some() {
            let site = self.parse_hand_site()?;
            hands.dominant = Some(site.clone());
            hands.other = Some(site);
        }
        hands.define = self.parse_definition_number();
        if self.at_body_site() {
            hands.at = Some(self.parse_body_place()?);
        }
        hands.written = self.written_symbols_since(from, |out| out.write_constellation(&hands));
        Ok(HandPlace::Hands(hands))
    }

    fn hand_place(&mut self) -> HamnosysParsed<HandPlace> {
        let from = self.at;
        let mut site = self.parse_hand_site()?;
        let bare = site.contact.is_none();
        if let Some((contact, by)) = self.parse_contact()? {
            site.contact = Some(contact);
            site.by = by.map(Box::new);
        }
        let define = self.parse_definition_number();
        if self.at_body_site() && bare && site.by.is_none() && site.contact.is_some() {
            let contact = site.contact.take().map(|contact| (contact, None));
            site.written = WrittenSymbols(None);
            return self.parse_constellation(from, Some(site), None, contact);
        }
        site.define = define;
        site.written = self.written_symbols_since(from, |out| out.write_hand_site(&site));
        Ok(HandPlace::Hand(site))
    }

    /// Reads a contact, or a group of a contact with the part of the hand.
    pub(super) fn parse_contact(&mut self) -> HamnosysParsed<Option<TouchingSite>> {
        match self.peek_symbol_kind() {
            Some(SymbolKind::Contact(contact)) if contact != PlaceContact::Brushing => {
                self.at += 1;
                Ok(Some((contact, None)))
            }
            Some(SymbolKind::Open(BracketKind::Seq)) if self.at_contact_group() => {
                let opened = self.at;
                let Some(SymbolKind::Contact(contact)) = self.symbol_kind_at(self.at + 1) else {
                    return Ok(None);
                };
                self.at += 2;
                let by = if self.at_hand_site() || self.at_body_site() {
                    Some(self.parse_hand_site()?)
                } else {
                    self.report_missing_symbol("the part of the hand that is in contact")?;
                    None
                };
                while !matches!(self.peek_symbol_kind(), None | Some(SymbolKind::Close(_))) {
                    self.refuse_next_symbol("hamseqend")?;
                }
                self.close_bracket(opened, BracketKind::Seq)?;
                Ok(Some((contact, by)))
            }
            _ => Ok(None),
        }
    }

    fn parse_definition_number(&mut self) -> Option<u8> {
        let mut number = 0;
        while self.eat_symbol_kind(SymbolKind::Define) {
            number += 1;
        }
        (number > 0).then_some(number.min(5))
    }

    pub(super) fn at_body_site(&self) -> bool {
        let mut position = self.at;
        while matches!(self.symbol_kind_at(position), Some(SymbolKind::At | SymbolKind::Beside)) {
            position += 1;
        }
        matches!(
            self.symbol_kind_at(position),
            Some(SymbolKind::Body(_) | SymbolKind::Behind)
        )
    }

    fn at_hand_site(&self) -> bool {
        let mut position = self.at;
        while matches!(self.symbol_kind_at(position), Some(SymbolKind::At | SymbolKind::Beside)) {
            position += 1;
        }
        matches!(
            self.symbol_kind_at(position),
            Some(SymbolKind::Hand(_) | SymbolKind::WristSide(_) | SymbolKind::Digit(_) | SymbolKind::Part(_))
        )
    }

    fn parse_body_place(&mut self) -> HamnosysParsed<BodyPlace> {
        let from = self.at;
        let mut place = BodyPlace {
            behind: self.eat_symbol_kind(SymbolKind::Behind),
            ..BodyPlace::default()
        };
        if self.at_body_site() {
            let site = self.parse_body_site()?;
            // Neutral space is where hands are if nothing is written, so that it is no site.
            let plain = site.at == BodyLocation::NeutralSpace && site.side.is_none() && !site.approx;
            place.site = (!plain).then_some(site);
        }
        if self.next_is(0, SymbolKind::Between) {
            self.at += 1;
            if self.at_body_site() {
                place.second = Some(self.parse_body_site()?);
            } else {
                self.report_missing_symbol("the second of two places on the body")?;
            }
        }
        place.behind |= self.eat_symbol_kind(SymbolKind::Behind);
        if let Some((contact, by)) = self.parse_contact()? {
            place.contact = Some(contact);
            place.by = by;
        }
        place.behind |= self.eat_symbol_kind(SymbolKind::Behind);
        place.define = self.parse_definition_number();
        place.written = self.written_symbols_since(from, |out| out.write_body_place(&place));
        Ok(place)
    }

    /// Reads a location of body or arm with its side.
    pub(super) fn parse_body_site(&mut self) -> HamnosysParsed<SidedLocation<BodyLocation>> {
        let mut side = self.parse_side_marks(None, true);
        let Some(SymbolKind::Body(at)) = self.peek_symbol_kind() else {
            self.report_missing_symbol("a place on the body")?;
            return Ok(SidedLocation {
                at: BodyLocation::NeutralSpace,
                side,
                approx: false,
            });
        };
        self.at += 1;
        let mut site = SidedLocation {
            at,
            side: None,
            approx: false,
        };
        loop {
            match self.peek_symbol_kind() {
                // Marks of double bends select the upper or lower one here: of lips, teeth, eyelids.
                Some(SymbolKind::Bend(bend)) => match select_body_level(site.at, bend) {
                    Some(level) => {
                        site.at = level;
                        self.at += 1;
                    }
                    None => self.refuse_next_symbol("a contact or a movement")?,
                },
                Some(SymbolKind::At | SymbolKind::Beside) => side = self.parse_side_marks(side, false),
                Some(SymbolKind::Approx) if !site.approx => {
                    site.approx = true;
                    self.at += 1;
                }
                // Parts of hands name the side of an arm: its palmar side is the inner one.
                Some(SymbolKind::Hand(part)) if side.is_none() && is_arm(site.at) => {
                    let Some(of_arm) = hand_side(part) else {
                        break;
                    };
                    side = Some(of_arm);
                    self.at += 1;
                }
                _ => break,
            }
        }
        site.side = side;
        Ok(site)
    }

    /// Takes marks of side: before a place they mean its left, after it its right.
    fn parse_side_marks(&mut self, before: Option<LocationSide>, left: bool) -> Option<LocationSide> {
        let mut side = before;
        while let Some(kind @ (SymbolKind::At | SymbolKind::Beside)) = self.peek_symbol_kind() {
            if side.is_some() {
                self.note_symbol_finding("a second side of the same place", "write one", true);
            }
            side = side.or(Some(match (kind, left) {
                (SymbolKind::At, true) => LocationSide::LeftAt,
                (SymbolKind::At, false) => LocationSide::RightAt,
                (_, true) => LocationSide::LeftBeside,
                (_, false) => LocationSide::RightBeside,
            }));
            self.at += 1;
        }
        side
    }

    /// Reads a site of a hand, or the middle of two.
    fn parse_hand_site(&mut self) -> HamnosysParsed<HandSite> {
        let from = self.at;
        let mut site = self.one_hand_site()?;
        if self.next_is(0, SymbolKind::Between) {
            self.at += 1;
            if self.at_hand_site() || self.at_body_site() {
                site.second = Some(Box::new(self.one_hand_site()?));
            } else {
                self.report_missing_symbol("the second of two parts of the hand")?;
            }
        }
        site.written = self.written_symbols_since(from, |out| out.write_hand_site(&site));
        Ok(site)
    }

    fn one_hand_site(&mut self) -> HamnosysParsed<HandSite> {
        let from = self.at;
        let mut site = HandSite {
            side: self.parse_side_marks(None, true),
            ..HandSite::default()
        };
        let mut parts = 0;
        loop {
            match self.peek_symbol_kind() {
                Some(SymbolKind::Hand(part)) => {
                    match (site.at, hand_side(part)) {
                        // The first part is the place, a second one its side.
                        (None, _) if site.digits.is_empty() => site.at = Some(part),
                        (_, Some(side)) if site.side.is_none() => site.side = Some(side),
                        _ => break,
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(SymbolKind::WristSide(side)) if parts == 0 => {
                    site.at = Some(HandLocation::WristBack);
                    site.side = site.side.or(Some(side));
                    parts += 1;
                    self.at += 1;
                }
                Some(SymbolKind::Part(part)) => {
                    let part = finger_location(part);
                    match site.at {
                        None => site.at = Some(part),
                        // A side that came first was taken for the place.
                        Some(at) if hand_side(at).is_some() && site.side.is_none() => {
                            site.side = hand_side(at);
                            site.at = Some(part);
                        }
                        Some(at) if is_finger(at) => self.note_symbol_finding(
                            "a second part of the same digit",
                            "write one, or hambetween",
                            true,
                        ),
                        Some(_) => break,
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(SymbolKind::Digit(digit)) => {
                    if site.at.is_some_and(|at| !is_finger(at)) {
                        break;
                    }
                    if site.digits.contains_digit(digit) {
                        self.note_symbol_finding("the digit is there twice", "write it once", true);
                    } else {
                        site.digits.0.push(digit);
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(SymbolKind::At | SymbolKind::Beside) if parts > 0 => {
                    site.side = self.parse_side_marks(site.side, false);
                }
                Some(SymbolKind::Approx) if parts > 0 && !site.approx => {
                    site.approx = true;
                    self.at += 1;
                }
                // Elbow, forearm and upper arm have one symbol for body and hand.
                Some(SymbolKind::Body(at)) if parts == 0 => {
                    match arm_location(at) {
                        Some(arm) => {
                            site.at = Some(arm);
                            self.at += 1;
                        }
                        None => self.drop(
                            "a place on the body where a part of the hand is meant",
                            "write the part of the hand that is in contact",
                        ),
                    }
                    parts += 1;
                }
                _ => break,
            }
        }
        if parts == 0 {
            self.report_missing_symbol("a part of the hand")?;
        }
        site.written = self.written_symbols_since(from, |out| out.write_hand_site(&site));
        Ok(site)
    }

    /// Reads the place of a brushing contact after `hamseqbegin hambrushing`.
    pub(super) fn parse_brushing_place(&mut self) -> HamnosysParsed<HandPlace> {
        let from = self.at;
        self.at += 2;
        let mut place = if self.at_place() {
            self.deeper(Self::parse_hand_place)?
        } else {
            self.report_missing_symbol("the place that is brushed")?;
            HandPlace::Body(BodyPlace::default())
        };
        while !matches!(self.peek_symbol_kind(), None | Some(SymbolKind::Close(_))) {
            self.refuse_next_symbol("hamseqend")?;
        }
        self.close_bracket(from, BracketKind::Seq)?;
        self.parse_brush_target(&mut place, from);
        Ok(place)
    }

    fn parse_brush_target(&mut self, place: &mut HandPlace, from: usize) {
        match place {
            HandPlace::Body(body) => {
                body.contact = Some(PlaceContact::Brushing);
                body.written = WrittenSymbols(None);
                body.written = self.written_symbols_since(from, |out| out.write_body_place(body));
            }
            HandPlace::Hand(site) => {
                site.contact = Some(PlaceContact::Brushing);
                site.written = WrittenSymbols(None);
                site.written = self.written_symbols_since(from, |out| out.write_hand_site(site));
            }
            HandPlace::Hands(hands) => {
                hands.contact = Some(PlaceContact::Brushing);
                hands.written = WrittenSymbols(None);
                hands.written = self.written_symbols_since(from, |out| out.write_constellation(hands));
            }
            HandPlace::Split(one, two) => {
                for half in [one, two].into_iter().flatten() {
                    add_touch_contact(half, PlaceContact::Brushing, None);
                }
            }
            HandPlace::Named(_) => {
                self.note_symbol_finding("a brushing contact with a named place", "write the place itself", true)
            }
        }
    }
}

/// Adds a contact to a place that has none, or to one that is brushed.
fn add_touch_contact(place: &mut HandPlace, contact: PlaceContact, by: Option<HandSite>) {
    let brushing = contact == PlaceContact::Brushing;
    match place {
        HandPlace::Body(body) if body.contact.is_none() || brushing => {
            body.contact = Some(contact);
            body.by = body.by.take().or(by);
            body.written = WrittenSymbols(None);
        }
        HandPlace::Hand(site) if site.contact.is_none() || brushing => {
            site.contact = Some(contact);
            site.by = site.by.take().or(by.map(Box::new));
            site.written = WrittenSymbols(None);
        }
        HandPlace::Hands(hands) if hands.contact.is_none() || brushing => {
            hands.contact = Some(contact);
            hands.written = WrittenSymbols(None);
        }
        _ => {}
    }
}

fn is_site(kind: SymbolKind) -> bool {
    use SymbolKind as K;
    matches!(
        kind,
        K::Body(_) | K::Hand(_) | K::WristSide(_) | K::Digit(_) | K::Part(_) | K::At | K::Beside
    )
}

/// Returns the upper or lower of a pair of locations, which marks of double bends select.
fn select_body_level(location: BodyLocation, bend: FingerBend) -> Option<BodyLocation> {
    use BodyLocation as L;
    Some(match (location, bend) {
        (L::Lips, FingerBend::DoubleBent) => L::UpperLip,
        (L::Lips, FingerBend::DoubleHooked) => L::LowerLip,
        (L::Teeth, FingerBend::DoubleBent) => L::UpperTeeth,
        (L::Teeth, FingerBend::DoubleHooked) => L::LowerTeeth,
        (L::Eyes, FingerBend::DoubleBent) => L::UpperEyelid,
        (L::Eyes, FingerBend::DoubleHooked) => L::LowerEyelid,
        _ => return None,
    })
}

fn is_arm(location: BodyLocation) -> bool {
    arm_location(location).is_some()
}

fn arm_location(location: BodyLocation) -> Option<HandLocation> {
    match location {
        BodyLocation::UpperArm => Some(HandLocation::UpperArm),
        BodyLocation::Elbow => Some(HandLocation::Elbow),
        BodyLocation::ElbowInside => Some(HandLocation::ElbowInside),
        BodyLocation::LowerArm => Some(HandLocation::LowerArm),
        _ => None,
    }
}

/// Returns the side that a part of the hand means when it follows another part.
fn hand_side(part: HandLocation) -> Option<LocationSide> {
    match part {
        HandLocation::Palm => Some(LocationSide::Palmar),
        HandLocation::HandBack => Some(LocationSide::Dorsal),
        HandLocation::ThumbSide => Some(LocationSide::Radial),
        HandLocation::PinkySide => Some(LocationSide::Ulnar),
        _ => None,
    }
}

fn finger_location(part: crate::hamnosys::tree::FingerPart) -> HandLocation {
    use crate::hamnosys::tree::FingerPart as P;
    match part {
        P::Tip => HandLocation::Tip,
        P::Nail => HandLocation::Nail,
        P::Pad => HandLocation::Pad,
        P::MidJoint => HandLocation::MidJoint,
        P::Base => HandLocation::Base,
        P::Side => HandLocation::Side,
    }
}

fn is_finger(part: HandLocation) -> bool {
    use HandLocation as H;
    matches!(part, H::Tip | H::Nail | H::Pad | H::MidJoint | H::Base | H::Side)
}
