//! Handshapes, directions and places.

use super::super::node::AttributeReader;
use super::super::sigml_raw::SigmlElement;
use super::super::sigml_words::SigmlWord;
use super::report_unexpected_gestural;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, CompassDirection, DirectionAim, DirectionFrame, EachHand, FingerContact,
    HandConstellation, HandPlace, HandSite, Handshape, HandshapeForm, NotatedPosture, PlaceContact, SidedLocation,
    SpatialDirection, ThumbExtra,
};

/// Collects the parts of a posture from their elements.
pub(super) struct PostureReader<'e> {
    parent: &'e SigmlElement<'e>,
    posture: NotatedPosture,
}

impl<'e> PostureReader<'e> {
    /// Starts with an empty posture; `parent` is the element around it.
    pub(super) fn new(parent: &'e SigmlElement<'e>) -> Self {
        Self {
            parent,
            posture: NotatedPosture::default(),
        }
    }

    /// Returns whether an element is a part of a posture.
    pub(super) fn is_posture_part(&self, name: &str) -> bool {
        matches!(name, "handconfig" | "split_handconfig") || is_place(name)
    }

    /// Reads one element; it replaces an earlier one for the same part, with a warning.
    pub(super) fn read_posture_part(&mut self, element: &SigmlElement<'_>, findings: &mut FindingTally) {
        match &*element.name {
            "handconfig" => {
                let dominant_direction = self.posture.extended.dominant_value().copied();
                let hand = HandConfig::read_hand_config(element, dominant_direction, findings);
                let hand_posture = NotatedPosture {
                    shape: share_between_hands(hand.shape),
                    extended: share_between_hands(hand.extended),
                    palm: share_between_hands(hand.palm),
                    place: None,
                };
                self.merge_posture(hand_posture, element, findings);
            }
            "split_handconfig" => {
                let split_posture = split_hands(element, findings);
                self.merge_posture(split_posture, element, findings);
            }
            _ => {
                let place_posture = NotatedPosture {
                    place: Some(read_place(element, findings)),
                    ..NotatedPosture::default()
                };
                self.merge_posture(place_posture, element, findings);
            }
        }
    }

    /// Returns the posture.
    pub(super) fn finish_posture(self) -> NotatedPosture {
        self.posture
    }

    fn merge_posture(&mut self, own: NotatedPosture, element: &SigmlElement<'_>, findings: &mut FindingTally) {
        let posture = &mut self.posture;
        let twice = override_each_hand(&mut posture.shape, own.shape)
            | override_each_hand(&mut posture.extended, own.extended)
            | override_each_hand(&mut posture.palm, own.palm)
            | (own.place.is_some() && posture.place.is_some());
        if own.place.is_some() {
            posture.place = own.place;
        }
        if twice {
            let parent = &self.parent.name;
            findings.add_limited_finding("parts of a posture said twice", || {
                let message = format!(
                    "<{}> says what another in <{parent}> said before; the last one counts",
                    element.name
                );
                ImportFinding::new_warning_finding(element.line.0, message)
                    .with_remedy("write <split_handconfig> or <split_location> where each hand has its own")
            });
        }
    }
}

fn share_between_hands<T>(one: Option<T>) -> EachHand<T> {
    one.map_or(EachHand::Unset, EachHand::Shared)
}

/// Replaces a value unless the new one is unset; returns whether it replaced one.
fn override_each_hand<T>(target: &mut EachHand<T>, own: EachHand<T>) -> bool {
    if own.is_unset() {
        return false;
    }
    let twice = !target.is_unset();
    *target = own;
    twice
}

/// The contents of one `handconfig`.
#[derive(Default)]
struct HandConfig {
    shape: Option<Handshape>,
    extended: Option<DirectionAim<SpatialDirection>>,
    palm: Option<DirectionAim<CompassDirection>>,
}

impl HandConfig {
    /// Reads an element; `known` is the direction from an earlier element.
    fn read_hand_config(
        element: &SigmlElement<'_>,
        known: Option<DirectionAim<SpatialDirection>>,
        findings: &mut FindingTally,
    ) -> Self {
        for child in &element.children {
            report_unexpected_gestural(child, element, findings);
        }
        let mut node = AttributeReader::new(element, findings);
        let extended = node.read_direction_attribute("extfidir").map(|first| {
            let second = node.read_direction_attribute("second_extfidir");
            aim_of(first, second, &mut node, "extfidir")
        });
        let pointing = extended.or(known).map(|aim| aim.first);
        let palm = node.read_palm_attribute("palmor", pointing).map(|first| {
            let second = node.read_compass_attribute("second_palmor");
            aim_of(first, second, &mut node, "palmor")
        });
        node.report_successive_fingers("successivefingers");
        let hand = Self {
            shape: read_gestural_handshape(&mut node),
            extended,
            palm,
        };
        node.report_unread_attributes();
        hand
    }
}

fn aim_of<D>(first: D, second: Option<D>, node: &mut AttributeReader<'_, '_>, what: &str) -> DirectionAim<D> {
    let approx = node.read_flag_attribute(&format!("approx_{what}"));
    let absolute = node.read_flag_attribute(&format!("abs_{what}"));
    let relative = node.read_flag_attribute(&format!("rel_{what}"));
    let frame = match (absolute, relative) {
        (_, true) => DirectionFrame::Relative,
        (true, false) => DirectionFrame::Absolute,
        (false, false) => DirectionFrame::Plain,
    };
    if absolute || relative {
        node.add_element_note("directions relative to something", |tag| {
            format!("<{tag}> says what its {what} is relative to, which few programs read")
        });
    }
    DirectionAim {
        first,
        second,
        approx,
        frame,
    }
}

fn read_gestural_handshape(node: &mut AttributeReader<'_, '_>) -> Option<Handshape> {
    let class = node.read_word_attribute("handshape");
    let second_class = node.read_word_attribute("second_handshape");
    let form = HandshapeForm {
        class: class.unwrap_or_default(),
        thumb: node.read_word_attribute("thumbpos"),
        bend: node.read_bend_attribute("mainbend"),
        opening: node.read_word_attribute("ceeopening"),
    };
    let second = HandshapeForm {
        class: second_class.unwrap_or(form.class),
        thumb: node.read_word_attribute("second_thumbpos"),
        bend: node.read_bend_attribute("second_mainbend"),
        opening: node.read_word_attribute("second_ceeopening"),
    };
    let between =
        (second_class.is_some() || second.thumb.is_some() || second.bend.is_some() || second.opening.is_some())
            .then_some(second);
    let mut shape = Handshape {
        form,
        between,
        approx: node.read_flag_attribute("approx_shape"),
        splay: node.parse_attribute("splay", "0, 1 or 2", |text| {
            text.parse().ok().filter(|splay| *splay <= 2)
        }),
        special: node.read_digits_attribute("specialfingers"),
        exempt: node.read_digits_attribute("exempteddigits"),
        opposed: node.read_digit_attribute("opposedfinger"),
        bends: ["bend1", "bend2", "bend3", "bend4", "bend5"].map(|name| node.read_bend_attribute(name)),
        ..Handshape::default()
    };
    for prefix in ["", "second_"] {
        let part = node.read_word_attribute(&format!("{prefix}contactkind"));
        if let Some((first, second)) = node.read_digit_pair(&format!("{prefix}contactpair")) {
            shape.contacts.push(FingerContact { first, second, part });
        }
    }
    shape.thumb = read_thumb_extra(node);
    if class.is_some() {
        return Some(shape);
    }
    if shape != Handshape::default() {
        node.add_element_warning("handshapes without a class", |tag| {
            format!("<{tag}> says something of a handshape without handshape=…; it was left out")
        });
    }
    None
}

fn read_thumb_extra(node: &mut AttributeReader<'_, '_>) -> Option<ThumbExtra> {
    let between = node.read_digit_pair("thumbbetween");
    let enclosed = node.read_flag_attribute("thumbenclosed");
    let contact = node.read_word_attribute("thumbcontact");
    between
        .map(|(first, second)| ThumbExtra::Between(first, second))
        .or(enclosed.then_some(ThumbExtra::Enclosed))
        .or(contact.map(ThumbExtra::Contact))
}

fn split_hands(element: &SigmlElement<'_>, findings: &mut FindingTally) -> NotatedPosture {
    AttributeReader::new(element, findings).report_unread_attributes();
    let mut hands = Vec::new();
    for child in &element.children {
        if child.name == "handconfig" && hands.len() < 2 {
            hands.push(HandConfig::read_hand_config(child, None, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    if hands.len() < 2 {
        one_half(element, findings);
    }
    let mut hands = hands.into_iter();
    let dominant = hands.next().unwrap_or_default();
    let other = hands.next().unwrap_or_default();
    NotatedPosture {
        shape: split_between_hands(dominant.shape, other.shape),
        extended: split_between_hands(dominant.extended, other.extended),
        palm: split_between_hands(dominant.palm, other.palm),
        place: None,
    }
}

fn split_between_hands<T>(dominant: Option<T>, other: Option<T>) -> EachHand<T> {
    match (dominant, other) {
        (None, None) => EachHand::Unset,
        (dominant, other) => EachHand::Split(dominant, other),
    }
}

/// Reports a split element without two halves.
pub(super) fn one_half(element: &SigmlElement<'_>, findings: &mut FindingTally) {
    findings.add_limited_finding("splits with one half", || {
        let message = format!(
            "<{}> holds fewer than two halves; they belong to the dominant hand",
            element.name
        );
        ImportFinding::new_warning_finding(element.line.0, message)
    });
}

/// Returns whether an element is a place of the hands.
pub(super) fn is_place(name: &str) -> bool {
    matches!(
        name,
        "location_bodyarm" | "location_hand" | "handconstellation" | "split_location" | "use_locname"
    )
}

/// Reads an element that [`is_place`].
pub(super) fn read_place(element: &SigmlElement<'_>, findings: &mut FindingTally) -> HandPlace {
    match &*element.name {
        "location_hand" => HandPlace::Hand(read_hand_site(element, findings)),
        "handconstellation" => HandPlace::Hands(read_hand_constellation(element, findings)),
        "split_location" => split_place(element, findings),
        "use_locname" => {
            let mut node = AttributeReader::new(element, findings);
            let number = node.name_number("use_locname");
            node.report_unread_attributes();
            HandPlace::Named(number.unwrap_or(1))
        }
        _ => HandPlace::Body(read_body_place(element, findings)),
    }
}

fn split_place(element: &SigmlElement<'_>, findings: &mut FindingTally) -> HandPlace {
    AttributeReader::new(element, findings).report_unread_attributes();
    let mut halves = Vec::new();
    for child in &element.children {
        if is_place(&child.name) && halves.len() < 2 {
            let place = read_place(child, findings);
            let is_stated = place != HandPlace::Hand(HandSite::default());
            halves.push(is_stated.then(|| Box::new(place)));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    if halves.len() < 2 {
        one_half(element, findings);
    }
    let mut halves = halves.into_iter().map(Option::into_iter);
    let mut next = || halves.next().and_then(|mut half| half.next());
    HandPlace::Split(next(), next())
}

/// Reads a constellation of the two hands. Of two sites the first is the touched one, on the other hand, as in nested
/// `location_hand` elements: for a dominant hand that points at a watch, transcribers write the wrist's back, then the
/// index finger's tip.
fn read_hand_constellation(element: &SigmlElement<'_>, findings: &mut FindingTally) -> HandConstellation {
    let mut node = AttributeReader::new(element, findings);
    let mut hands = HandConstellation {
        contact: node.read_word_attribute("contact"),
        define: node.name_number("def_locname"),
        ..HandConstellation::default()
    };
    node.report_unread_attributes();
    let mut sites = 0;
    for child in &element.children {
        match (&*child.name, sites) {
            ("location_hand", 0 | 1) => {
                let read_site = read_hand_site(child, findings);
                let site = (read_site != HandSite::default()).then_some(read_site);
                hands.other = std::mem::replace(&mut hands.dominant, site);
                sites += 1;
            }
            ("location_bodyarm", _) if hands.at.is_none() => {
                hands.at = Some(read_body_place(child, findings));
            }
            _ => report_unexpected_gestural(child, element, findings),
        }
    }
    hands
}

fn read_body_place(element: &SigmlElement<'_>, findings: &mut FindingTally) -> BodyPlace {
    let mut node = AttributeReader::new(element, findings);
    let site = read_sided_site(&mut node, "", "approx_location", BodyLocation::NeutralSpace);
    let here = site.map_or(BodyLocation::NeutralSpace, |site| site.at);
    let mut place = BodyPlace {
        second: self::read_sided_site(&mut node, "second_", "approx_second_location", here),
        site,
        behind: node.read_flag_attribute("behind"),
        contact: node.read_word_attribute("contact"),
        define: node.name_number("def_locname"),
        ..BodyPlace::default()
    };
    node.report_unread_attributes();
    place.by = acting_site(element, findings);
    place
}

/// Reads a location with its side; a side without a location belongs to `here`.
fn read_sided_site(
    node: &mut AttributeReader<'_, '_>,
    prefix: &str,
    approx: &str,
    here: BodyLocation,
) -> Option<SidedLocation<BodyLocation>> {
    let location = node.read_word_attribute(&format!("{prefix}location"));
    let side = node.read_word_attribute(&format!("{prefix}side"));
    let approx = node.read_flag_attribute(approx);
    if location.is_none() && (side.is_some() || approx) {
        node.add_element_warning("sides without a location", |tag| {
            let here = here.sigml_word();
            format!("<{tag}> has {prefix}side without {prefix}location; it was read as a side of {here}")
        });
    } else if location.is_none() {
        return None;
    }
    Some(SidedLocation {
        at: location.unwrap_or(here),
        side,
        approx,
    })
}

fn read_hand_site(element: &SigmlElement<'_>, findings: &mut FindingTally) -> HandSite {
    let mut node = AttributeReader::new(element, findings);
    let second = HandSite {
        at: node.read_word_attribute("second_location"),
        digits: node.read_digits_attribute("second_digits"),
        side: node.read_word_attribute("second_side"),
        approx: node.read_flag_attribute("approx_second_location"),
        ..HandSite::default()
    };
    let mut site = HandSite {
        at: node.read_word_attribute("location"),
        digits: node.read_digits_attribute("digits"),
        side: node.read_word_attribute("side"),
        approx: node.read_flag_attribute("approx_location"),
        second: (second != HandSite::default()).then(|| Box::new(second)),
        contact: node.read_word_attribute("contact"),
        define: node.name_number("def_locname"),
        ..HandSite::default()
    };
    if site.contact == Some(PlaceContact::ArmExtended) {
        node.add_element_note("an arm extended to a hand", |tag| {
            format!("<{tag}> has contact=\"armextended\", which is for places on the body")
        });
    }
    node.report_unread_attributes();
    site.by = acting_site(element, findings).map(Box::new);
    site
}

/// Reads the `location_hand` in a location: the named part of the acting hand.
fn acting_site(element: &SigmlElement<'_>, findings: &mut FindingTally) -> Option<HandSite> {
    let mut found_site = None;
    for child in &element.children {
        if child.name == "location_hand" && found_site.is_none() {
            found_site = Some(read_hand_site(child, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    found_site
}
