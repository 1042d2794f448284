//! Handshapes, directions and places.

use super::super::node::Node;
use super::super::raw::Element;
use super::super::words::Word;
use super::unexpected;
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_sign::hamnosys::{
    Aim, BodyLocation, BodyPlace, Compass, Constellation, Contact, Direction, Each, FingerContact,
    Form, Frame, HandSite, Handshape, Place, Posture, Site, ThumbExtra,
};

/// Collects the parts of a posture from their elements.
pub(super) struct Reader<'e> {
    parent: &'e Element<'e>,
    posture: Posture,
}

impl<'e> Reader<'e> {
    /// Starts with an empty posture; `parent` is the element around it.
    pub(super) fn new(parent: &'e Element<'e>) -> Self {
        Self {
            parent,
            posture: Posture::default(),
        }
    }

    /// Returns whether an element is a part of a posture.
    pub(super) fn takes(&self, name: &str) -> bool {
        matches!(name, "handconfig" | "split_handconfig") || is_place(name)
    }

    /// Reads one element; it replaces an earlier one for the same part, with a warning.
    pub(super) fn take(&mut self, element: &Element<'_>, findings: &mut Findings) {
        match &*element.name {
            "handconfig" => {
                let known = self.posture.extended.dominant().copied();
                let hand = Hand::read(element, known, findings);
                let own = Posture {
                    shape: shared(hand.shape),
                    extended: shared(hand.extended),
                    palm: shared(hand.palm),
                    place: None,
                };
                self.merge(own, element, findings);
            }
            "split_handconfig" => {
                let own = split_hands(element, findings);
                self.merge(own, element, findings);
            }
            _ => {
                let own = Posture {
                    place: Some(read_place(element, findings)),
                    ..Posture::default()
                };
                self.merge(own, element, findings);
            }
        }
    }

    /// Returns the posture.
    pub(super) fn finish(self) -> Posture {
        self.posture
    }

    fn merge(&mut self, own: Posture, element: &Element<'_>, findings: &mut Findings) {
        let posture = &mut self.posture;
        let twice = over(&mut posture.shape, own.shape)
            | over(&mut posture.extended, own.extended)
            | over(&mut posture.palm, own.palm)
            | (own.place.is_some() && posture.place.is_some());
        if own.place.is_some() {
            posture.place = own.place;
        }
        if twice {
            let parent = &self.parent.name;
            findings.add("parts of a posture said twice", || {
                let message = format!(
                    "<{}> says what another in <{parent}> said before; the last one counts",
                    element.name
                );
                Finding::warning(element.line.0, message).with_remedy(
                    "write <split_handconfig> or <split_location> where each hand has its own",
                )
            });
        }
    }
}

fn shared<T>(one: Option<T>) -> Each<T> {
    one.map_or(Each::Unset, Each::Shared)
}

/// Replaces a value unless the new one is unset; returns whether it replaced one.
fn over<T>(target: &mut Each<T>, own: Each<T>) -> bool {
    if own.is_unset() {
        return false;
    }
    let twice = !target.is_unset();
    *target = own;
    twice
}

/// The contents of one `handconfig`.
#[derive(Default)]
struct Hand {
    shape: Option<Handshape>,
    extended: Option<Aim<Direction>>,
    palm: Option<Aim<Compass>>,
}

impl Hand {
    /// Reads an element; `known` is the direction from an earlier element.
    fn read(element: &Element<'_>, known: Option<Aim<Direction>>, findings: &mut Findings) -> Self {
        for child in &element.children {
            unexpected(child, element, findings);
        }
        let mut node = Node::new(element, findings);
        let extended = node.direction("extfidir").map(|first| {
            let second = node.direction("second_extfidir");
            aim_of(first, second, &mut node, "extfidir")
        });
        let pointing = extended.or(known).map(|aim| aim.first);
        let palm = node.palm("palmor", pointing).map(|first| {
            let second = node.compass("second_palmor");
            aim_of(first, second, &mut node, "palmor")
        });
        node.successive("successivefingers");
        let hand = Self {
            shape: handshape(&mut node),
            extended,
            palm,
        };
        node.finish();
        hand
    }
}

fn aim_of<D>(first: D, second: Option<D>, node: &mut Node<'_, '_>, what: &str) -> Aim<D> {
    let approx = node.flag(&format!("approx_{what}"));
    let absolute = node.flag(&format!("abs_{what}"));
    let relative = node.flag(&format!("rel_{what}"));
    let frame = match (absolute, relative) {
        (_, true) => Frame::Relative,
        (true, false) => Frame::Absolute,
        (false, false) => Frame::Plain,
    };
    if absolute || relative {
        node.note("directions relative to something", |tag| {
            format!("<{tag}> says what its {what} is relative to, which few programs read")
        });
    }
    Aim {
        first,
        second,
        approx,
        frame,
    }
}

fn handshape(node: &mut Node<'_, '_>) -> Option<Handshape> {
    let class = node.word("handshape");
    let second_class = node.word("second_handshape");
    let form = Form {
        class: class.unwrap_or_default(),
        thumb: node.word("thumbpos"),
        bend: node.bend("mainbend"),
        opening: node.word("ceeopening"),
    };
    let second = Form {
        class: second_class.unwrap_or(form.class),
        thumb: node.word("second_thumbpos"),
        bend: node.bend("second_mainbend"),
        opening: node.word("second_ceeopening"),
    };
    let between = (second_class.is_some()
        || second.thumb.is_some()
        || second.bend.is_some()
        || second.opening.is_some())
    .then_some(second);
    let mut shape = Handshape {
        form,
        between,
        approx: node.flag("approx_shape"),
        splay: node.parsed("splay", "0, 1 or 2", |text| {
            text.parse().ok().filter(|splay| *splay <= 2)
        }),
        special: node.digits("specialfingers"),
        exempt: node.digits("exempteddigits"),
        opposed: node.digit("opposedfinger"),
        bends: ["bend1", "bend2", "bend3", "bend4", "bend5"].map(|name| node.bend(name)),
        ..Handshape::default()
    };
    for prefix in ["", "second_"] {
        let part = node.word(&format!("{prefix}contactkind"));
        if let Some((first, second)) = node.pair(&format!("{prefix}contactpair")) {
            shape.contacts.push(FingerContact {
                first,
                second,
                part,
            });
        }
    }
    shape.thumb = thumb(node);
    if class.is_some() {
        return Some(shape);
    }
    if shape != Handshape::default() {
        node.warn("handshapes without a class", |tag| {
            format!("<{tag}> says something of a handshape without handshape=…; it was left out")
        });
    }
    None
}

fn thumb(node: &mut Node<'_, '_>) -> Option<ThumbExtra> {
    let between = node.pair("thumbbetween");
    let enclosed = node.flag("thumbenclosed");
    let contact = node.word("thumbcontact");
    between
        .map(|(first, second)| ThumbExtra::Between(first, second))
        .or(enclosed.then_some(ThumbExtra::Enclosed))
        .or(contact.map(ThumbExtra::Contact))
}

fn split_hands(element: &Element<'_>, findings: &mut Findings) -> Posture {
    Node::new(element, findings).finish();
    let mut hands = Vec::new();
    for child in &element.children {
        if child.name == "handconfig" && hands.len() < 2 {
            hands.push(Hand::read(child, None, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    if hands.len() < 2 {
        one_half(element, findings);
    }
    let mut hands = hands.into_iter();
    let dominant = hands.next().unwrap_or_default();
    let other = hands.next().unwrap_or_default();
    Posture {
        shape: split(dominant.shape, other.shape),
        extended: split(dominant.extended, other.extended),
        palm: split(dominant.palm, other.palm),
        place: None,
    }
}

fn split<T>(dominant: Option<T>, other: Option<T>) -> Each<T> {
    match (dominant, other) {
        (None, None) => Each::Unset,
        (dominant, other) => Each::Split(dominant, other),
    }
}

/// Reports a split element without two halves.
pub(super) fn one_half(element: &Element<'_>, findings: &mut Findings) {
    findings.add("splits with one half", || {
        let message = format!(
            "<{}> holds fewer than two halves; they belong to the dominant hand",
            element.name
        );
        Finding::warning(element.line.0, message)
    });
}

/// Returns whether an element is a place of the hands.
pub(super) fn is_place(name: &str) -> bool {
    matches!(
        name,
        "location_bodyarm"
            | "location_hand"
            | "handconstellation"
            | "split_location"
            | "use_locname"
    )
}

/// Reads an element that [`is_place`].
pub(super) fn read_place(element: &Element<'_>, findings: &mut Findings) -> Place {
    match &*element.name {
        "location_hand" => Place::Hand(hand_site(element, findings)),
        "handconstellation" => Place::Hands(constellation(element, findings)),
        "split_location" => split_place(element, findings),
        "use_locname" => {
            let mut node = Node::new(element, findings);
            let number = node.name_number("use_locname");
            node.finish();
            Place::Named(number.unwrap_or(1))
        }
        _ => Place::Body(body_place(element, findings)),
    }
}

fn split_place(element: &Element<'_>, findings: &mut Findings) -> Place {
    Node::new(element, findings).finish();
    let mut halves = Vec::new();
    for child in &element.children {
        if is_place(&child.name) && halves.len() < 2 {
            let place = read_place(child, findings);
            let is_stated = place != Place::Hand(HandSite::default());
            halves.push(is_stated.then(|| Box::new(place)));
        } else {
            unexpected(child, element, findings);
        }
    }
    if halves.len() < 2 {
        one_half(element, findings);
    }
    let mut halves = halves.into_iter().map(Option::into_iter);
    let mut next = || halves.next().and_then(|mut half| half.next());
    Place::Split(next(), next())
}

/// Reads a constellation of the two hands. Of two sites the first is the touched one, on the other hand, as in nested
/// `location_hand` elements: for a dominant hand that points at a watch, transcribers write the wrist's back, then the
/// index finger's tip.
fn constellation(element: &Element<'_>, findings: &mut Findings) -> Constellation {
    let mut node = Node::new(element, findings);
    let mut hands = Constellation {
        contact: node.word("contact"),
        define: node.name_number("def_locname"),
        ..Constellation::default()
    };
    node.finish();
    let mut sites = 0;
    for child in &element.children {
        match (&*child.name, sites) {
            ("location_hand", 0 | 1) => {
                let site = hand_site(child, findings);
                let site = (site != HandSite::default()).then_some(site);
                hands.other = std::mem::replace(&mut hands.dominant, site);
                sites += 1;
            }
            ("location_bodyarm", _) if hands.at.is_none() => {
                hands.at = Some(body_place(child, findings));
            }
            _ => unexpected(child, element, findings),
        }
    }
    hands
}

fn body_place(element: &Element<'_>, findings: &mut Findings) -> BodyPlace {
    let mut node = Node::new(element, findings);
    let site = site(&mut node, "", "approx_location", BodyLocation::NeutralSpace);
    let here = site.map_or(BodyLocation::NeutralSpace, |site| site.at);
    let mut place = BodyPlace {
        second: self::site(&mut node, "second_", "approx_second_location", here),
        site,
        behind: node.flag("behind"),
        contact: node.word("contact"),
        define: node.name_number("def_locname"),
        ..BodyPlace::default()
    };
    node.finish();
    place.by = acting_site(element, findings);
    place
}

/// Reads a location with its side; a side without a location belongs to `here`.
fn site(
    node: &mut Node<'_, '_>,
    prefix: &str,
    approx: &str,
    here: BodyLocation,
) -> Option<Site<BodyLocation>> {
    let at = node.word(&format!("{prefix}location"));
    let side = node.word(&format!("{prefix}side"));
    let approx = node.flag(approx);
    if at.is_none() && (side.is_some() || approx) {
        node.warn("sides without a location", |tag| {
            let here = here.word();
            format!(
                "<{tag}> has {prefix}side without {prefix}location; it was read as a side of {here}"
            )
        });
    } else if at.is_none() {
        return None;
    }
    Some(Site {
        at: at.unwrap_or(here),
        side,
        approx,
    })
}

fn hand_site(element: &Element<'_>, findings: &mut Findings) -> HandSite {
    let mut node = Node::new(element, findings);
    let second = HandSite {
        at: node.word("second_location"),
        digits: node.digits("second_digits"),
        side: node.word("second_side"),
        approx: node.flag("approx_second_location"),
        ..HandSite::default()
    };
    let mut site = HandSite {
        at: node.word("location"),
        digits: node.digits("digits"),
        side: node.word("side"),
        approx: node.flag("approx_location"),
        second: (second != HandSite::default()).then(|| Box::new(second)),
        contact: node.word("contact"),
        define: node.name_number("def_locname"),
        ..HandSite::default()
    };
    if site.contact == Some(Contact::ArmExtended) {
        node.note("an arm extended to a hand", |tag| {
            format!("<{tag}> has contact=\"armextended\", which is for places on the body")
        });
    }
    node.finish();
    site.by = acting_site(element, findings).map(Box::new);
    site
}

/// Reads the `location_hand` in a location: the named part of the acting hand.
fn acting_site(element: &Element<'_>, findings: &mut Findings) -> Option<HandSite> {
    let mut found = None;
    for child in &element.children {
        if child.name == "location_hand" && found.is_none() {
            found = Some(hand_site(child, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    found
}
