//! Prints places as symbols.

use super::Write;
use crate::hamnosys::symbol::{Bracket, Kind};
use crate::hamnosys::tree::{
    Bend, BodyLocation, BodyPlace, Constellation, Contact, FingerPart, HandLocation, HandSite,
    Place, Side, Site,
};

impl Write {
    pub(super) fn place(&mut self, place: &Place) {
        match place {
            Place::Body(place) => self.body_place(place),
            Place::Hand(site) => self.hand_site(site),
            Place::Hands(hands) => self.constellation(hands),
            Place::Split(one, two) => {
                self.symbol(Kind::Open(Bracket::Par));
                if let Some(one) = one {
                    self.place(one);
                }
                self.symbol(Kind::Plus);
                if let Some(two) = two {
                    self.place(two);
                }
                self.symbol(Kind::Close(Bracket::Par));
            }
            Place::Named(number) => {
                for _ in 0..*number {
                    self.symbol(Kind::Refer);
                }
            }
        }
    }

    pub(in crate::hamnosys) fn body_place(&mut self, place: &BodyPlace) {
        if self.written(&place.written) {
            return;
        }
        let brushing = self.begin_brushing(place.contact);
        let alone = matches!(place.contact, None | Some(Contact::ArmExtended));
        match &place.site {
            Some(site) => self.body_site(site),
            None if alone && place.by.is_none() => {
                self.symbol(Kind::Body(BodyLocation::NeutralSpace));
            }
            None => {}
        }
        if let Some(second) = &place.second {
            self.symbol(Kind::Between);
            self.body_site(second);
        }
        if place.behind {
            self.symbol(Kind::Behind);
        }
        self.contact(place.contact, place.by.as_ref());
        self.define(place.define);
        self.end_brushing(brushing);
    }

    pub(in crate::hamnosys) fn body_site(&mut self, site: &Site<BodyLocation>) {
        let (mark, before) = side_mark(site.side);
        if before {
            self.marks(mark);
        }
        let (location, level) = base_location(site.at);
        self.symbol(Kind::Body(location));
        if let Some(level) = level {
            self.symbol(Kind::Bend(level));
        }
        if !before {
            self.marks(mark);
        }
        self.unsaid_side(site.side);
        if site.approx {
            self.symbol(Kind::Approx);
        }
    }

    pub(in crate::hamnosys) fn hand_site(&mut self, site: &HandSite) {
        if self.written(&site.written) {
            return;
        }
        let brushing = self.begin_brushing(site.contact);
        self.one_hand_site(site);
        if let Some(second) = &site.second {
            self.symbol(Kind::Between);
            match &second.written.0 {
                Some(_) => self.hand_site(second),
                None => self.one_hand_site(second),
            }
            if second.contact.is_some() || second.second.is_some() || second.define.is_some() {
                self.lose("further marks of the second of two sites cannot be written in text");
            }
        }
        self.contact(site.contact, site.by.as_deref());
        self.define(site.define);
        self.end_brushing(brushing);
    }

    fn one_hand_site(&mut self, site: &HandSite) {
        let (mark, before) = side_mark(site.side);
        let mut mark = mark;
        if before {
            self.marks(mark);
        }
        match (site.at, site.side) {
            (Some(HandLocation::WristBack), Some(Side::Palmar)) => {
                self.symbol(Kind::WristSide(Side::Palmar));
                mark = None;
            }
            (Some(at), _) => self.hand_location(at),
            (None, _) => {}
        }
        for digit in &site.digits.0 {
            self.symbol(Kind::Digit(*digit));
        }
        if site.at.is_none() && site.digits.is_empty() {
            self.lose("a site of a hand without part and digits has no symbol");
        }
        if !before {
            self.marks(mark);
        }
        self.unsaid_side(site.side);
        if site.approx {
            self.symbol(Kind::Approx);
        }
    }

    fn hand_location(&mut self, at: HandLocation) {
        use HandLocation as H;
        match at {
            H::UpperArm => self.symbol(Kind::Body(BodyLocation::UpperArm)),
            H::Elbow => self.symbol(Kind::Body(BodyLocation::Elbow)),
            H::ElbowInside => self.symbol(Kind::Body(BodyLocation::ElbowInside)),
            H::LowerArm => self.symbol(Kind::Body(BodyLocation::LowerArm)),
            H::Tip => self.symbol(Kind::Part(FingerPart::Tip)),
            H::Nail => self.symbol(Kind::Part(FingerPart::Nail)),
            H::Pad => self.symbol(Kind::Part(FingerPart::Pad)),
            H::MidJoint => self.symbol(Kind::Part(FingerPart::MidJoint)),
            H::Base => self.symbol(Kind::Part(FingerPart::Base)),
            H::Side => self.symbol(Kind::Part(FingerPart::Side)),
            at => self.symbol(Kind::Hand(at)),
        }
    }

    pub(in crate::hamnosys) fn constellation(&mut self, hands: &Constellation) {
        if self.written(&hands.written) {
            return;
        }
        let brushing = self.begin_brushing(hands.contact);
        match (&hands.dominant, &hands.other) {
            (None, None) => {}
            (Some(one), None) => self.hand_site(one),
            (one, two) => {
                self.symbol(Kind::Open(Bracket::Par));
                for (site, plus) in [(one, true), (two, false)] {
                    if let Some(site) = site {
                        self.hand_site(site);
                    }
                    if plus {
                        self.symbol(Kind::Plus);
                    }
                }
                self.symbol(Kind::Close(Bracket::Par));
            }
        }
        self.contact(hands.contact, None);
        self.define(hands.define);
        if let Some(at) = &hands.at {
            self.body_place(at);
        }
        self.end_brushing(brushing);
    }

    fn contact(&mut self, contact: Option<Contact>, by: Option<&HandSite>) {
        let contact = match contact {
            Some(Contact::Brushing) => Some(Contact::Touch),
            contact => contact,
        };
        match (contact, by) {
            (None, None) => {}
            (Some(contact), None) => self.symbol(Kind::Contact(contact)),
            (contact, Some(by)) => {
                if contact.is_none() {
                    self.lose("a part of the hand without a contact is written as touching");
                }
                self.symbol(Kind::Open(Bracket::Seq));
                self.symbol(Kind::Contact(contact.unwrap_or(Contact::Touch)));
                self.hand_site(by);
                self.symbol(Kind::Close(Bracket::Seq));
            }
        }
    }

    fn begin_brushing(&mut self, contact: Option<Contact>) -> bool {
        let brushing = contact == Some(Contact::Brushing);
        if brushing {
            self.symbol(Kind::Open(Bracket::Seq));
            self.symbol(Kind::Contact(Contact::Brushing));
        }
        brushing
    }

    fn end_brushing(&mut self, brushing: bool) {
        if brushing {
            self.symbol(Kind::Close(Bracket::Seq));
        }
    }

    fn define(&mut self, number: Option<u8>) {
        for _ in 0..number.unwrap_or_default() {
            self.symbol(Kind::Define);
        }
    }

    fn marks(&mut self, mark: Option<Kind>) {
        if let Some(mark) = mark {
            self.symbol(mark);
        }
    }

    fn unsaid_side(&mut self, side: Option<Side>) {
        if matches!(side, Some(Side::Front | Side::Back)) {
            self.lose("front and back of a place have no symbol; they are left out");
        }
    }
}

/// Returns the mark of a side, and whether it comes before the place.
fn side_mark(side: Option<Side>) -> (Option<Kind>, bool) {
    match side {
        None | Some(Side::Front | Side::Back) => (None, false),
        Some(Side::LeftAt) => (Some(Kind::At), true),
        Some(Side::LeftBeside) => (Some(Kind::Beside), true),
        Some(Side::RightAt) => (Some(Kind::At), false),
        Some(Side::RightBeside) => (Some(Kind::Beside), false),
        Some(Side::Palmar) => (Some(Kind::Hand(HandLocation::Palm)), false),
        Some(Side::Dorsal) => (Some(Kind::Hand(HandLocation::HandBack)), false),
        Some(Side::Radial) => (Some(Kind::Hand(HandLocation::ThumbSide)), false),
        Some(Side::Ulnar) => (Some(Kind::Hand(HandLocation::PinkySide)), false),
    }
}

/// Returns the symbol's location, with a mark for the upper or lower of two.
fn base_location(at: BodyLocation) -> (BodyLocation, Option<Bend>) {
    use BodyLocation as L;
    match at {
        L::UpperLip => (L::Lips, Some(Bend::DoubleBent)),
        L::LowerLip => (L::Lips, Some(Bend::DoubleHooked)),
        L::UpperTeeth => (L::Teeth, Some(Bend::DoubleBent)),
        L::LowerTeeth => (L::Teeth, Some(Bend::DoubleHooked)),
        L::UpperEyelid => (L::Eyes, Some(Bend::DoubleBent)),
        L::LowerEyelid => (L::Eyes, Some(Bend::DoubleHooked)),
        at => (at, None),
    }
}
