//! Prints places as symbols.

use super::HamnosysWriter;
use crate::hamnosys::symbol::{BracketKind, SymbolKind};
use crate::hamnosys::tree::{
    BodyLocation, BodyPlace, FingerBend, FingerPart, HandConstellation, HandLocation, HandPlace, HandSite,
    LocationSide, PlaceContact, SidedLocation,
};

impl HamnosysWriter {
    pub(super) fn write_hand_place(&mut self, place: &HandPlace) {
        match place {
            HandPlace::Body(place) => self.write_body_place(place),
            HandPlace::Hand(site) => self.write_hand_site(site),
            HandPlace::Hands(hands) => self.write_constellation(hands),
            HandPlace::Split(one, two) => {
                self.symbol(SymbolKind::Open(BracketKind::Par));
                if let Some(one) = one {
                    self.write_hand_place(one);
                }
                self.symbol(SymbolKind::Plus);
                if let Some(two) = two {
                    self.write_hand_place(two);
                }
                self.symbol(SymbolKind::Close(BracketKind::Par));
            }
            HandPlace::Named(number) => {
                for _ in 0..*number {
                    self.symbol(SymbolKind::Refer);
                }
            }
        }
    }

    pub(in crate::hamnosys) fn write_body_place(&mut self, place: &BodyPlace) {
        if self.write_kept_symbols(&place.written) {
            return;
        }
        let brushing = self.begin_brushing(place.contact);
        let alone = matches!(place.contact, None | Some(PlaceContact::ArmExtended));
        match &place.site {
            Some(site) => self.write_body_site(site),
            None if alone && place.by.is_none() => {
                self.symbol(SymbolKind::Body(BodyLocation::NeutralSpace));
            }
            None => {}
        }
        if let Some(second) = &place.second {
            self.symbol(SymbolKind::Between);
            self.write_body_site(second);
        }
        if place.behind {
            self.symbol(SymbolKind::Behind);
        }
        self.write_contact(place.contact, place.by.as_ref());
        self.write_definition_number(place.define);
        self.end_brushing(brushing);
    }

    pub(in crate::hamnosys) fn write_body_site(&mut self, site: &SidedLocation<BodyLocation>) {
        let (mark, before) = side_mark(site.side);
        if before {
            self.write_doubled_mark(mark);
        }
        let (location, level) = base_location(site.at);
        self.symbol(SymbolKind::Body(location));
        if let Some(level) = level {
            self.symbol(SymbolKind::Bend(level));
        }
        if !before {
            self.write_doubled_mark(mark);
        }
        self.unsaid_side(site.side);
        if site.approx {
            self.symbol(SymbolKind::Approx);
        }
    }

    pub(in crate::hamnosys) fn write_hand_site(&mut self, site: &HandSite) {
        if self.write_kept_symbols(&site.written) {
            return;
        }
        let brushing = self.begin_brushing(site.contact);
        self.one_hand_site(site);
        if let Some(second) = &site.second {
            self.symbol(SymbolKind::Between);
            match &second.written.0 {
                Some(_) => self.write_hand_site(second),
                None => self.one_hand_site(second),
            }
            if second.contact.is_some() || second.second.is_some() || second.define.is_some() {
                self.report_notation_loss("further marks of the second of two sites cannot be written in text");
            }
        }
        self.write_contact(site.contact, site.by.as_deref());
        self.write_definition_number(site.define);
        self.end_brushing(brushing);
    }

    fn one_hand_site(&mut self, site: &HandSite) {
        let (mark, before) = side_mark(site.side);
        let mut mark = mark;
        if before {
            self.write_doubled_mark(mark);
        }
        match (site.at, site.side) {
            (Some(HandLocation::WristBack), Some(LocationSide::Palmar)) => {
                self.symbol(SymbolKind::WristSide(LocationSide::Palmar));
                mark = None;
            }
            (Some(at), _) => self.hand_location(at),
            (None, _) => {}
        }
        for digit in &site.digits.0 {
            self.symbol(SymbolKind::Digit(*digit));
        }
        if site.at.is_none() && site.digits.is_empty() {
            self.report_notation_loss("a site of a hand without part and digits has no symbol");
        }
        if !before {
            self.write_doubled_mark(mark);
        }
        self.unsaid_side(site.side);
        if site.approx {
            self.symbol(SymbolKind::Approx);
        }
    }

    fn hand_location(&mut self, at: HandLocation) {
        use HandLocation as H;
        match at {
            H::UpperArm => self.symbol(SymbolKind::Body(BodyLocation::UpperArm)),
            H::Elbow => self.symbol(SymbolKind::Body(BodyLocation::Elbow)),
            H::ElbowInside => self.symbol(SymbolKind::Body(BodyLocation::ElbowInside)),
            H::LowerArm => self.symbol(SymbolKind::Body(BodyLocation::LowerArm)),
            H::Tip => self.symbol(SymbolKind::Part(FingerPart::Tip)),
            H::Nail => self.symbol(SymbolKind::Part(FingerPart::Nail)),
            H::Pad => self.symbol(SymbolKind::Part(FingerPart::Pad)),
            H::MidJoint => self.symbol(SymbolKind::Part(FingerPart::MidJoint)),
            H::Base => self.symbol(SymbolKind::Part(FingerPart::Base)),
            H::Side => self.symbol(SymbolKind::Part(FingerPart::Side)),
            at => self.symbol(SymbolKind::Hand(at)),
        }
    }

    pub(in crate::hamnosys) fn write_constellation(&mut self, hands: &HandConstellation) {
        if self.write_kept_symbols(&hands.written) {
            return;
        }
        let brushing = self.begin_brushing(hands.contact);
        match (&hands.dominant, &hands.other) {
            (None, None) => {}
            (Some(one), None) => self.write_hand_site(one),
            (one, two) => {
                self.symbol(SymbolKind::Open(BracketKind::Par));
                for (site, plus) in [(one, true), (two, false)] {
                    if let Some(site) = site {
                        self.write_hand_site(site);
                    }
                    if plus {
                        self.symbol(SymbolKind::Plus);
                    }
                }
                self.symbol(SymbolKind::Close(BracketKind::Par));
            }
        }
        self.write_contact(hands.contact, None);
        self.write_definition_number(hands.define);
        if let Some(at) = &hands.at {
            self.write_body_place(at);
        }
        self.end_brushing(brushing);
    }

    fn write_contact(&mut self, contact: Option<PlaceContact>, by: Option<&HandSite>) {
        let contact = match contact {
            Some(PlaceContact::Brushing) => Some(PlaceContact::Touch),
            contact => contact,
        };
        match (contact, by) {
            (None, None) => {}
            (Some(contact), None) => self.symbol(SymbolKind::Contact(contact)),
            (contact, Some(by)) => {
                if contact.is_none() {
                    self.report_notation_loss("a part of the hand without a contact is written as touching");
                }
                self.symbol(SymbolKind::Open(BracketKind::Seq));
                self.symbol(SymbolKind::Contact(contact.unwrap_or(PlaceContact::Touch)));
                self.write_hand_site(by);
                self.symbol(SymbolKind::Close(BracketKind::Seq));
            }
        }
    }

    fn begin_brushing(&mut self, contact: Option<PlaceContact>) -> bool {
        let brushing = contact == Some(PlaceContact::Brushing);
        if brushing {
            self.symbol(SymbolKind::Open(BracketKind::Seq));
            self.symbol(SymbolKind::Contact(PlaceContact::Brushing));
        }
        brushing
    }

    fn end_brushing(&mut self, brushing: bool) {
        if brushing {
            self.symbol(SymbolKind::Close(BracketKind::Seq));
        }
    }

    fn write_definition_number(&mut self, number: Option<u8>) {
        for _ in 0..number.unwrap_or_default() {
            self.symbol(SymbolKind::Define);
        }
    }

    fn write_doubled_mark(&mut self, mark: Option<SymbolKind>) {
        if let Some(mark) = mark {
            self.symbol(mark);
        }
    }

    fn unsaid_side(&mut self, side: Option<LocationSide>) {
        if matches!(side, Some(LocationSide::Front | LocationSide::Back)) {
            self.report_notation_loss("front and back of a place have no symbol; they are left out");
        }
    }
}

/// Returns the mark of a side, and whether it comes before the place.
fn side_mark(side: Option<LocationSide>) -> (Option<SymbolKind>, bool) {
    match side {
        None | Some(LocationSide::Front | LocationSide::Back) => (None, false),
        Some(LocationSide::LeftAt) => (Some(SymbolKind::At), true),
        Some(LocationSide::LeftBeside) => (Some(SymbolKind::Beside), true),
        Some(LocationSide::RightAt) => (Some(SymbolKind::At), false),
        Some(LocationSide::RightBeside) => (Some(SymbolKind::Beside), false),
        Some(LocationSide::Palmar) => (Some(SymbolKind::Hand(HandLocation::Palm)), false),
        Some(LocationSide::Dorsal) => (Some(SymbolKind::Hand(HandLocation::HandBack)), false),
        Some(LocationSide::Radial) => (Some(SymbolKind::Hand(HandLocation::ThumbSide)), false),
        Some(LocationSide::Ulnar) => (Some(SymbolKind::Hand(HandLocation::PinkySide)), false),
    }
}

/// Returns the symbol's location, with a mark for the upper or lower of two.
fn base_location(at: BodyLocation) -> (BodyLocation, Option<FingerBend>) {
    use BodyLocation as L;
    match at {
        L::UpperLip => (L::Lips, Some(FingerBend::DoubleBent)),
        L::LowerLip => (L::Lips, Some(FingerBend::DoubleHooked)),
        L::UpperTeeth => (L::Teeth, Some(FingerBend::DoubleBent)),
        L::LowerTeeth => (L::Teeth, Some(FingerBend::DoubleHooked)),
        L::UpperEyelid => (L::Eyes, Some(FingerBend::DoubleBent)),
        L::LowerEyelid => (L::Eyes, Some(FingerBend::DoubleHooked)),
        at => (at, None),
    }
}
