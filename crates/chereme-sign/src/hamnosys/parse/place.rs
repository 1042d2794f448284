//! Places: on the body, on a hand, in a constellation of the two hands.

use super::{Parsed, Parser};
use crate::hamnosys::symbol::{Bracket, Kind};
use crate::hamnosys::tree::{
    Bend, BodyLocation, BodyPlace, Constellation, Contact, HandLocation, HandSite, Place, Side,
    Site, Written,
};

/// The contact, and the part of the hand.
type Touching = (Contact, Option<HandSite>);

impl Parser<'_> {
    /// Returns whether a place begins here.
    pub(super) fn at_place(&self) -> bool {
        match self.peek() {
            Some(Kind::Open(Bracket::Seq)) => self.at_contact_group(),
            Some(Kind::Open(Bracket::Par)) => self.at_split_place(),
            Some(Kind::Contact(Contact::Brushing)) => false,
            Some(Kind::Contact(_) | Kind::Behind | Kind::Refer) => true,
            Some(kind) => is_site(kind),
            None => false,
        }
    }

    fn at_contact_group(&self) -> bool {
        self.next_is(0, Kind::Open(Bracket::Seq))
            && matches!(self.kind(self.at + 1), Some(Kind::Contact(contact)) if contact != Contact::Brushing)
    }

    fn at_split_place(&self) -> bool {
        let (inside, Some(_)) = self.group(self.at) else {
            return false;
        };
        let mut sites = 0;
        for token in inside {
            match token.kind {
                kind if is_site(kind) => sites += 1,
                Kind::Contact(_) => sites += 1,
                Kind::Plus | Kind::Between | Kind::Behind | Kind::Approx | Kind::Still => {}
                Kind::Define | Kind::Refer | Kind::Bend(_) => {}
                Kind::Open(Bracket::Seq) | Kind::Close(Bracket::Seq) => {}
                _ => return false,
            }
        }
        sites > 0
    }

    /// Reads a place.
    pub(super) fn place(&mut self) -> Parsed<Place> {
        match self.peek() {
            Some(Kind::Refer) => {
                let mut number = 0;
                while self.eat(Kind::Refer) {
                    number += 1;
                }
                Ok(Place::Named(number.min(5)))
            }
            Some(Kind::Open(Bracket::Par)) => self.split_place(),
            Some(Kind::Contact(_) | Kind::Open(Bracket::Seq)) => self.bare_contact(),
            _ if self.at_body_site() => Ok(Place::Body(self.body_place()?)),
            _ => self.hand_place(),
        }
    }

    fn split_place(&mut self) -> Parsed<Place> {
        let from = self.at;
        self.at += 1;
        let dominant = self.half_place()?;
        if !self.eat(Kind::Plus) {
            self.missing("hamplus between the places of the two hands")?;
        }
        let other = self.half_place()?;
        self.close(from, Bracket::Par)?;
        match (dominant, other) {
            (Some(Place::Hand(one)), Some(Place::Hand(two)))
                if one.contact.is_none() && two.contact.is_none() =>
            {
                let contact = self.contact()?;
                self.constellation(from, Some(one), Some(two), contact)
            }
            (mut one, mut two) => {
                if let Some((contact, by)) = self.contact()? {
                    for place in [&mut one, &mut two].into_iter().flatten() {
                        touch(place, contact, by.clone());
                    }
                }
                Ok(Place::Split(one.map(Box::new), two.map(Box::new)))
            }
        }
    }

    fn half_place(&mut self) -> Parsed<Option<Place>> {
        let mut place = None;
        loop {
            match self.peek() {
                None | Some(Kind::Plus | Kind::Close(_)) => return Ok(place),
                Some(Kind::Still) => self.at += 1,
                _ if place.is_none() && self.at_place() => {
                    place = Some(self.deeper(Self::place)?);
                }
                _ => self.unexpected("a place, hamplus or hamparend")?,
            }
        }
    }

    /// Reads a contact that no place comes before: of the two hands, or with the last contact.
    fn bare_contact(&mut self) -> Parsed<Place> {
        let from = self.at;
        let Some((contact, by)) = self.contact()? else {
            self.missing("a contact")?;
            return Ok(Place::Body(BodyPlace::default()));
        };
        if contact != Contact::ArmExtended {
            return self.constellation(from, by.clone(), by, Some((contact, None)));
        }
        let mut place = BodyPlace {
            contact: Some(contact),
            by,
            ..BodyPlace::default()
        };
        place.written = self.written(from, |out| out.body_place(&place));
        Ok(Place::Body(place))
    }

    /// Reads the rest of a constellation after the sites and the contact.
    fn constellation(
        &mut self,
        from: usize,
        dominant: Option<HandSite>,
        other: Option<HandSite>,
        contact: Option<Touching>,
    ) -> Parsed<Place> {
        let (contact, by) = match contact {
            Some((contact, by)) => (Some(contact), by),
            None => (None, None),
        };
        if by.is_some() {
            self.note(
                "the parts of the hands are said before already",
                "write the contact alone",
                true,
            );
        }
        let mut hands = Constellation {
            dominant,
            other,
            contact,
            ..Constellation::default()
        };
        if self.at_hand_site() && hands.dominant.is_none() && contact.is_some() {
            let site = self.hand_site()?;
            hands.dominant = Some(site.clone());
            hands.other = Some(site);
        }
        hands.define = self.define();
        if self.at_body_site() {
            hands.at = Some(self.body_place()?);
        }
        hands.written = self.written(from, |out| out.constellation(&hands));
        Ok(Place::Hands(hands))
    }

    fn hand_place(&mut self) -> Parsed<Place> {
        let from = self.at;
        let mut site = self.hand_site()?;
        let bare = site.contact.is_none();
        if let Some((contact, by)) = self.contact()? {
            site.contact = Some(contact);
            site.by = by.map(Box::new);
        }
        let define = self.define();
        if self.at_body_site() && bare && site.by.is_none() && site.contact.is_some() {
            let contact = site.contact.take().map(|contact| (contact, None));
            site.written = Written(None);
            return self.constellation(from, Some(site), None, contact);
        }
        site.define = define;
        site.written = self.written(from, |out| out.hand_site(&site));
        Ok(Place::Hand(site))
    }

    /// Reads a contact, or a group of a contact with the part of the hand.
    pub(super) fn contact(&mut self) -> Parsed<Option<Touching>> {
        match self.peek() {
            Some(Kind::Contact(contact)) if contact != Contact::Brushing => {
                self.at += 1;
                Ok(Some((contact, None)))
            }
            Some(Kind::Open(Bracket::Seq)) if self.at_contact_group() => {
                let opened = self.at;
                let Some(Kind::Contact(contact)) = self.kind(self.at + 1) else {
                    return Ok(None);
                };
                self.at += 2;
                let by = if self.at_hand_site() || self.at_body_site() {
                    Some(self.hand_site()?)
                } else {
                    self.missing("the part of the hand that is in contact")?;
                    None
                };
                while !matches!(self.peek(), None | Some(Kind::Close(_))) {
                    self.unexpected("hamseqend")?;
                }
                self.close(opened, Bracket::Seq)?;
                Ok(Some((contact, by)))
            }
            _ => Ok(None),
        }
    }

    fn define(&mut self) -> Option<u8> {
        let mut number = 0;
        while self.eat(Kind::Define) {
            number += 1;
        }
        (number > 0).then_some(number.min(5))
    }

    pub(super) fn at_body_site(&self) -> bool {
        let mut at = self.at;
        while matches!(self.kind(at), Some(Kind::At | Kind::Beside)) {
            at += 1;
        }
        matches!(self.kind(at), Some(Kind::Body(_) | Kind::Behind))
    }

    fn at_hand_site(&self) -> bool {
        let mut at = self.at;
        while matches!(self.kind(at), Some(Kind::At | Kind::Beside)) {
            at += 1;
        }
        matches!(
            self.kind(at),
            Some(Kind::Hand(_) | Kind::WristSide(_) | Kind::Digit(_) | Kind::Part(_))
        )
    }

    fn body_place(&mut self) -> Parsed<BodyPlace> {
        let from = self.at;
        let mut place = BodyPlace {
            behind: self.eat(Kind::Behind),
            ..BodyPlace::default()
        };
        if self.at_body_site() {
            let site = self.body_site()?;
            let plain =
                site.at == BodyLocation::NeutralSpace && site.side.is_none() && !site.approx;
            place.site = (!plain).then_some(site);
        }
        if self.next_is(0, Kind::Between) {
            self.at += 1;
            if self.at_body_site() {
                place.second = Some(self.body_site()?);
            } else {
                self.missing("the second of two places on the body")?;
            }
        }
        place.behind |= self.eat(Kind::Behind);
        if let Some((contact, by)) = self.contact()? {
            place.contact = Some(contact);
            place.by = by;
        }
        place.behind |= self.eat(Kind::Behind);
        place.define = self.define();
        place.written = self.written(from, |out| out.body_place(&place));
        Ok(place)
    }

    /// Reads a location of body or arm with its side.
    pub(super) fn body_site(&mut self) -> Parsed<Site<BodyLocation>> {
        let mut side = self.sides(None, true);
        let Some(Kind::Body(at)) = self.peek() else {
            self.missing("a place on the body")?;
            return Ok(Site {
                at: BodyLocation::NeutralSpace,
                side,
                approx: false,
            });
        };
        self.at += 1;
        let mut site = Site {
            at,
            side: None,
            approx: false,
        };
        loop {
            match self.peek() {
                Some(Kind::Bend(bend)) => match level(site.at, bend) {
                    Some(level) => {
                        site.at = level;
                        self.at += 1;
                    }
                    None => self.unexpected("a contact or a movement")?,
                },
                Some(Kind::At | Kind::Beside) => side = self.sides(side, false),
                Some(Kind::Approx) if !site.approx => {
                    site.approx = true;
                    self.at += 1;
                }
                Some(Kind::Hand(part)) if side.is_none() && is_arm(site.at) => {
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
    fn sides(&mut self, before: Option<Side>, left: bool) -> Option<Side> {
        let mut side = before;
        while let Some(kind @ (Kind::At | Kind::Beside)) = self.peek() {
            if side.is_some() {
                self.note("a second side of the same place", "write one", true);
            }
            side = side.or(Some(match (kind, left) {
                (Kind::At, true) => Side::LeftAt,
                (Kind::At, false) => Side::RightAt,
                (_, true) => Side::LeftBeside,
                (_, false) => Side::RightBeside,
            }));
            self.at += 1;
        }
        side
    }

    /// Reads a site of a hand, or the middle of two.
    fn hand_site(&mut self) -> Parsed<HandSite> {
        let from = self.at;
        let mut site = self.one_hand_site()?;
        if self.next_is(0, Kind::Between) {
            self.at += 1;
            if self.at_hand_site() || self.at_body_site() {
                site.second = Some(Box::new(self.one_hand_site()?));
            } else {
                self.missing("the second of two parts of the hand")?;
            }
        }
        site.written = self.written(from, |out| out.hand_site(&site));
        Ok(site)
    }

    fn one_hand_site(&mut self) -> Parsed<HandSite> {
        let from = self.at;
        let mut site = HandSite {
            side: self.sides(None, true),
            ..HandSite::default()
        };
        let mut parts = 0;
        loop {
            match self.peek() {
                Some(Kind::Hand(part)) => {
                    match (site.at, hand_side(part)) {
                        (None, _) if site.digits.is_empty() => site.at = Some(part),
                        (_, Some(side)) if site.side.is_none() => site.side = Some(side),
                        _ => break,
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(Kind::WristSide(side)) if parts == 0 => {
                    site.at = Some(HandLocation::WristBack);
                    site.side = site.side.or(Some(side));
                    parts += 1;
                    self.at += 1;
                }
                Some(Kind::Part(part)) => {
                    let part = finger_location(part);
                    match site.at {
                        None => site.at = Some(part),
                        Some(at) if hand_side(at).is_some() && site.side.is_none() => {
                            site.side = hand_side(at);
                            site.at = Some(part);
                        }
                        Some(at) if is_finger(at) => self.note(
                            "a second part of the same digit",
                            "write one, or hambetween",
                            true,
                        ),
                        Some(_) => break,
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(Kind::Digit(digit)) => {
                    if site.at.is_some_and(|at| !is_finger(at)) {
                        break;
                    }
                    if site.digits.contains(digit) {
                        self.note("the digit is there twice", "write it once", true);
                    } else {
                        site.digits.0.push(digit);
                    }
                    parts += 1;
                    self.at += 1;
                }
                Some(Kind::At | Kind::Beside) if parts > 0 => {
                    site.side = self.sides(site.side, false);
                }
                Some(Kind::Approx) if parts > 0 && !site.approx => {
                    site.approx = true;
                    self.at += 1;
                }
                Some(Kind::Body(at)) if parts == 0 => {
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
            self.missing("a part of the hand")?;
        }
        site.written = self.written(from, |out| out.hand_site(&site));
        Ok(site)
    }

    /// Reads the place of a brushing contact after `hamseqbegin hambrushing`.
    pub(super) fn brushing(&mut self) -> Parsed<Place> {
        let from = self.at;
        self.at += 2;
        let mut place = if self.at_place() {
            self.deeper(Self::place)?
        } else {
            self.missing("the place that is brushed")?;
            Place::Body(BodyPlace::default())
        };
        while !matches!(self.peek(), None | Some(Kind::Close(_))) {
            self.unexpected("hamseqend")?;
        }
        self.close(from, Bracket::Seq)?;
        self.brush(&mut place, from);
        Ok(place)
    }

    fn brush(&mut self, place: &mut Place, from: usize) {
        match place {
            Place::Body(body) => {
                body.contact = Some(Contact::Brushing);
                body.written = Written(None);
                body.written = self.written(from, |out| out.body_place(body));
            }
            Place::Hand(site) => {
                site.contact = Some(Contact::Brushing);
                site.written = Written(None);
                site.written = self.written(from, |out| out.hand_site(site));
            }
            Place::Hands(hands) => {
                hands.contact = Some(Contact::Brushing);
                hands.written = Written(None);
                hands.written = self.written(from, |out| out.constellation(hands));
            }
            Place::Split(one, two) => {
                for half in [one, two].into_iter().flatten() {
                    touch(half, Contact::Brushing, None);
                }
            }
            Place::Named(_) => self.note(
                "a brushing contact with a named place",
                "write the place itself",
                true,
            ),
        }
    }
}

/// Adds a contact to a place that has none, or to one that is brushed.
fn touch(place: &mut Place, contact: Contact, by: Option<HandSite>) {
    let brushing = contact == Contact::Brushing;
    match place {
        Place::Body(body) if body.contact.is_none() || brushing => {
            body.contact = Some(contact);
            body.by = body.by.take().or(by);
            body.written = Written(None);
        }
        Place::Hand(site) if site.contact.is_none() || brushing => {
            site.contact = Some(contact);
            site.by = site.by.take().or(by.map(Box::new));
            site.written = Written(None);
        }
        Place::Hands(hands) if hands.contact.is_none() || brushing => {
            hands.contact = Some(contact);
            hands.written = Written(None);
        }
        _ => {}
    }
}

fn is_site(kind: Kind) -> bool {
    use Kind as K;
    matches!(
        kind,
        K::Body(_) | K::Hand(_) | K::WristSide(_) | K::Digit(_) | K::Part(_) | K::At | K::Beside
    )
}

/// Returns the upper or lower of a pair of locations, which marks of double bends select.
fn level(location: BodyLocation, bend: Bend) -> Option<BodyLocation> {
    use BodyLocation as L;
    Some(match (location, bend) {
        (L::Lips, Bend::DoubleBent) => L::UpperLip,
        (L::Lips, Bend::DoubleHooked) => L::LowerLip,
        (L::Teeth, Bend::DoubleBent) => L::UpperTeeth,
        (L::Teeth, Bend::DoubleHooked) => L::LowerTeeth,
        (L::Eyes, Bend::DoubleBent) => L::UpperEyelid,
        (L::Eyes, Bend::DoubleHooked) => L::LowerEyelid,
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
fn hand_side(part: HandLocation) -> Option<Side> {
    match part {
        HandLocation::Palm => Some(Side::Palmar),
        HandLocation::HandBack => Some(Side::Dorsal),
        HandLocation::ThumbSide => Some(Side::Radial),
        HandLocation::PinkySide => Some(Side::Ulnar),
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
    matches!(
        part,
        H::Tip | H::Nail | H::Pad | H::MidJoint | H::Base | H::Side
    )
}
