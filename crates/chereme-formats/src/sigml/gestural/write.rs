//! Writes the tree of a sign as gestural SiGML.

use super::super::node::{bend_text, digits_text};
use super::super::raw::Element;
use super::super::words::Word;
use chereme_sign::hamnosys::{
    Aim, BodyAction, BodyLocation, BodyPlace, Circular, Constellation, Contact, Digits, Directed,
    Each, Form, Frame, Growth, HandSite, HandsUsed, Handshape, Manner, Manual, Motion, MotionKind,
    Place, Posture, Repetition, Sign, Site, ThumbExtra, Zigzag,
};
use std::fmt::Display;

/// Returns `sign_manual`; that of a compound contains one for each part.
pub(in super::super) fn write_manual(sign: &Sign) -> Element<'static> {
    if let [part] = sign.parts.as_slice() {
        return part_element(part);
    }
    let mut whole = Element::new("sign_manual");
    whole.children.extend(sign.parts.iter().map(part_element));
    whole
}

impl Element<'static> {
    /// Sets an attribute.
    pub(in super::super) fn set(&mut self, name: &str, value: impl Into<String>) {
        let value: String = value.into();
        self.attributes.push((name.to_owned().into(), value.into()));
    }

    /// Sets an attribute if there is a value.
    pub(in super::super) fn some(&mut self, name: &str, value: Option<impl Into<String>>) {
        if let Some(value) = value {
            self.set(name, value);
        }
    }

    /// Sets an attribute to the word of a value, if any.
    pub(in super::super) fn word<T: Word>(&mut self, name: &str, value: Option<T>) {
        self.some(name, value.map(Word::word));
    }

    /// Sets an attribute to true if `value` is.
    pub(in super::super) fn flag(&mut self, name: &str, value: bool) {
        self.some(name, value.then_some("true"));
    }

    fn shown<T: Display>(&mut self, name: &str, value: Option<T>) {
        self.some(name, value.map(|value| value.to_string()));
    }

    fn digits(&mut self, name: &str, digits: &Digits) {
        let some = !digits.is_empty();
        self.some(name, some.then(|| digits_text(&digits.0)));
    }
}

/// Formats a number so that it reads back equal.
pub(in super::super) fn number(value: f64) -> String {
    value.to_string()
}

fn part_element(part: &Manual) -> Element<'static> {
    let mut element = Element::new("sign_manual");
    match part.hands {
        HandsUsed::Dominant => {}
        HandsUsed::Nondominant => element.flag("nondominant", true),
        HandsUsed::Both(symmetry) => {
            element.flag("both_hands", true);
            element.flag("lr_symm", symmetry.left_right);
            element.flag("ud_symm", symmetry.up_down);
            element.flag("oi_symm", symmetry.out_in);
            element.flag("outofphase", symmetry.out_of_phase);
            element.flag("realspace", symmetry.real_space);
        }
    }
    element.flag("holdover", part.holdover);
    let children = &mut element.children;
    children.extend(
        part.body
            .iter()
            .map(|action| action_element("nonmanualconfig", action)),
    );
    children.extend(posture_elements(&part.posture));
    children.extend(part.actions.iter().map(motion_element));
    element
}

fn action_element(name: &'static str, action: &BodyAction) -> Element<'static> {
    let mut part = Element::new("handconfig");
    part.word("bodypart", Some(action.part));
    part.word("side", action.side);
    let mut element = Element::new(name);
    element.children.push(part);
    element
        .children
        .extend(action.motion.iter().map(|motion| motion_element(motion)));
    element
}

fn posture_elements(posture: &Posture) -> Vec<Element<'static>> {
    let mut elements = Vec::new();
    elements.extend(each(&posture.shape, write_shape));
    elements.extend(each(&posture.extended, |aim, element| {
        write_aim("extfidir", aim, element);
    }));
    elements.extend(each(&posture.palm, |aim, element| {
        write_aim("palmor", aim, element);
    }));
    elements.extend(posture.place.as_ref().map(place_element));
    elements
}

fn each<T>(value: &Each<T>, write: impl Fn(&T, &mut Element<'static>)) -> Option<Element<'static>> {
    let hand = |one: Option<&T>| {
        let mut element = Element::new("handconfig");
        if let Some(one) = one {
            write(one, &mut element);
        }
        element
    };
    match value {
        Each::Unset => None,
        Each::Shared(one) => Some(hand(Some(one))),
        Each::Split(dominant, other) => {
            let mut element = Element::new("split_handconfig");
            element.children = vec![hand(dominant.as_ref()), hand(other.as_ref())];
            Some(element)
        }
    }
}

fn write_aim<D: Display>(what: &str, aim: &Aim<D>, element: &mut Element<'static>) {
    element.set(what, aim.first.to_string());
    element.shown(&format!("second_{what}"), aim.second.as_ref());
    element.flag(&format!("approx_{what}"), aim.approx);
    element.flag(&format!("abs_{what}"), aim.frame == Frame::Absolute);
    element.flag(&format!("rel_{what}"), aim.frame == Frame::Relative);
}

fn write_shape(shape: &Handshape, element: &mut Element<'static>) {
    write_form("", &shape.form, ["handshape", "mainbend"], element);
    if let Some(between) = &shape.between {
        write_form(
            "second_",
            between,
            ["second_handshape", "second_mainbend"],
            element,
        );
    }
    element.flag("approx_shape", shape.approx);
    element.shown("splay", shape.splay);
    element.digits("specialfingers", &shape.special);
    element.digits("exempteddigits", &shape.exempt);
    element.some(
        "opposedfinger",
        shape.opposed.map(|digit| digits_text(&[digit])),
    );
    for (at, bend) in shape.bends.iter().enumerate() {
        element.some(&format!("bend{}", at + 1), bend.map(bend_text));
    }
    for (contact, prefix) in shape.contacts.iter().zip(["", "second_"]) {
        let pair = digits_text(&[contact.first, contact.second]);
        element.set(&format!("{prefix}contactpair"), pair);
        element.word(&format!("{prefix}contactkind"), contact.part);
    }
    match shape.thumb {
        Some(ThumbExtra::Between(first, second)) => {
            element.set("thumbbetween", digits_text(&[first, second]));
        }
        Some(ThumbExtra::Enclosed) => element.flag("thumbenclosed", true),
        Some(ThumbExtra::Contact(part)) => element.word("thumbcontact", Some(part)),
        None => {}
    }
}

fn write_form(prefix: &str, form: &Form, names: [&str; 2], element: &mut Element<'static>) {
    element.word(names[0], Some(form.class));
    element.word(&format!("{prefix}thumbpos"), form.thumb);
    element.some(names[1], form.bend.map(bend_text));
    element.word(&format!("{prefix}ceeopening"), form.opening);
}

fn place_element(place: &Place) -> Element<'static> {
    match place {
        Place::Body(place) => body_element(place),
        Place::Hand(site) => hand_element(site),
        Place::Hands(hands) => constellation_element(hands),
        Place::Split(dominant, other) => {
            let mut element = Element::new("split_location");
            let half = |half: &Option<Box<Place>>| match half {
                Some(place) => place_element(place),
                None => Element::new("location_hand"),
            };
            element.children = vec![half(dominant), half(other)];
            element
        }
        Place::Named(number) => {
            let mut element = Element::new("use_locname");
            element.shown("use_locname", Some(number));
            element
        }
    }
}

fn constellation_element(hands: &Constellation) -> Element<'static> {
    let mut element = Element::new("handconstellation");
    element.word("contact", hands.contact);
    element.shown("def_locname", hands.define);
    if hands.dominant.is_some() || hands.other.is_some() {
        for site in [&hands.other, &hands.dominant] {
            let empty = || Element::new("location_hand");
            element
                .children
                .push(site.as_ref().map_or_else(empty, hand_element));
        }
    }
    element.children.extend(hands.at.as_ref().map(body_element));
    element
}

fn body_element(place: &BodyPlace) -> Element<'static> {
    let mut element = Element::new("location_bodyarm");
    let mut site = |prefix: &str, approx: &str, site: &Option<Site<BodyLocation>>| {
        if let Some(site) = site {
            element.word(&format!("{prefix}location"), Some(site.at));
            element.word(&format!("{prefix}side"), site.side);
            element.flag(approx, site.approx);
        }
    };
    site("", "approx_location", &place.site);
    site("second_", "approx_second_location", &place.second);
    element.flag("behind", place.behind);
    element.word("contact", place.contact);
    element.shown("def_locname", place.define);
    element.children.extend(place.by.as_ref().map(hand_element));
    element
}

fn hand_element(site: &HandSite) -> Element<'static> {
    let mut element = Element::new("location_hand");
    let mut one = |prefix: &str, approx: &str, site: &HandSite| {
        element.word(&format!("{prefix}location"), site.at);
        element.digits(&format!("{prefix}digits"), &site.digits);
        element.word(&format!("{prefix}side"), site.side);
        element.flag(approx, site.approx);
    };
    one("", "approx_location", site);
    if let Some(second) = &site.second {
        one("second_", "approx_second_location", second);
    }
    element.word("contact", site.contact);
    element.shown("def_locname", site.define);
    element
        .children
        .extend(site.by.as_deref().map(hand_element));
    element
}

fn motion_element(motion: &Motion) -> Element<'static> {
    if let Some(brushing) = brushing_element(motion) {
        return brushing;
    }
    let mut element = match &motion.kind {
        MotionKind::Directed(directed) => directed_element(directed),
        MotionKind::Circular(circular) => circular_element(circular),
        MotionKind::Wrist { motion, size } => {
            let mut element = Element::new("wristmotion");
            element.word("motion", Some(*motion));
            element.word("size", *size);
            element
        }
        MotionKind::Cross { diagonal } => {
            let mut element = Element::new("crossmotion");
            element.set("cross", if *diagonal { "x" } else { "plus" });
            element
        }
        MotionKind::FingerPlay(digits) => {
            let mut element = Element::new("fingerplay");
            element.digits("digits", digits);
            element
        }
        MotionKind::Still => Element::new("nomotion"),
        MotionKind::Body(action) => action_element("nonman_motion", action),
        MotionKind::Split(dominant, other) => {
            let half = |half: &Option<Box<Motion>>| match half {
                Some(motion) => motion_element(motion),
                None => Element::new("nomotion"),
            };
            let mut element = Element::new("split_motion");
            element.children = vec![half(dominant), half(other)];
            element
        }
        MotionKind::Sequence { motions, fused } => {
            let mut element = group_element("seq_motion", motions);
            element.flag("fused", *fused);
            element
        }
        MotionKind::Parallel(motions) => group_element("par_motion", motions),
        MotionKind::Target { motion, posture } => {
            let mut element = Element::new("tgt_motion");
            let still = || Element::new("changeposture");
            let motion = motion.as_deref().map_or_else(still, motion_element);
            element.children.push(motion);
            element.children.extend(posture_elements(posture));
            element
        }
        MotionKind::Repeated { motion, repetition } => repeated_element(motion, repetition),
    };
    write_manner(&motion.manner, &mut element);
    element
}

/// Returns a simple motion, with the place that it brushes along.
fn brushing_element(motion: &Motion) -> Option<Element<'static>> {
    let MotionKind::Target {
        motion: Some(inner),
        posture,
    } = &motion.kind
    else {
        return None;
    };
    let simple = matches!(
        inner.kind,
        MotionKind::Directed(_)
            | MotionKind::Circular(_)
            | MotionKind::Wrist { .. }
            | MotionKind::Cross { .. }
            | MotionKind::FingerPlay(_)
    );
    let mut place = posture.place.clone()?;
    let contact = match &mut place {
        Place::Body(place) => &mut place.contact,
        Place::Hand(site) => &mut site.contact,
        _ => return None,
    };
    let hands = posture.shape.is_unset() && posture.extended.is_unset() && posture.palm.is_unset();
    if *contact != Some(Contact::Brushing)
        || !simple
        || !hands
        || motion.manner != Manner::default()
    {
        return None;
    }
    *contact = Some(Contact::Touch);
    let mut element = motion_element(inner);
    element.children.push(place_element(&place));
    Some(element)
}

fn group_element(name: &'static str, motions: &[Motion]) -> Element<'static> {
    let mut element = Element::new(name);
    element.children.extend(motions.iter().map(motion_element));
    element
}

fn repeated_element(motion: &Motion, repetition: &Repetition) -> Element<'static> {
    let mut element = Element::new("rpt_motion");
    element.word("repetition", Some(repetition.repeat));
    element.word("second_repetition", repetition.second);
    write_growth("repetition_incrdecr", repetition.growth, &mut element);
    element.shown("repetition_baseshift", repetition.shift);
    element.word("baseshift_size", repetition.shift_size);
    write_growth("baseshift_incrdecr", repetition.shift_growth, &mut element);
    element.flag("approx_repetition", repetition.approx);
    element.children.push(motion_element(motion));
    element
}

fn directed_element(directed: &Directed) -> Element<'static> {
    let mut element = Element::new("directedmotion");
    element.set("direction", directed.direction.to_string());
    element.shown("second_direction", directed.second);
    element.word("size", directed.size.first);
    element.word("second_size", directed.size.second);
    if let Some(curve) = directed.curve {
        element.set("curve", curve.to.letters());
        element.word("curve_size", curve.size);
    }
    write_zigzag(directed.zigzag, &mut element);
    element.word("ellipse_direction", directed.ellipse);
    element
}

fn circular_element(circular: &Circular) -> Element<'static> {
    let mut element = Element::new("circularmotion");
    element.set("axis", circular.axis.to_string());
    element.shown("second_axis", circular.second);
    element.word("size", circular.size.first);
    element.word("second_size", circular.size.second);
    element.shown("start", circular.clock.start);
    element.flag("clockplus", circular.clock.full > 0);
    element.flag("second_clockplus", circular.clock.full > 1);
    element.shown("end", circular.clock.end);
    element.word("ellipse_direction", circular.ellipse);
    element.word("ellipse_size", circular.ellipse_size);
    write_zigzag(circular.zigzag, &mut element);
    write_growth("incrdecr", circular.growth, &mut element);
    element
}

fn write_zigzag(zigzag: Option<Zigzag>, element: &mut Element<'static>) {
    if let Some(zigzag) = zigzag {
        element.set("zigzag_style", if zigzag.wavy { "wavy" } else { "zigzag" });
        element.word("zigzag_size", zigzag.size);
        write_growth("zigzag_incrdecr", zigzag.growth, element);
    }
}

fn write_growth(name: &str, growth: Option<Growth>, element: &mut Element<'static>) {
    if let Some(growth) = growth {
        let trend = if growth.increasing {
            "increasing"
        } else {
            "decreasing"
        };
        element.set(name, trend);
        element.word(&format!("{name}_size"), growth.size);
    }
}

fn write_manner(manner: &Manner, element: &mut Element<'static>) {
    for (name, value) in [
        ("abs_motion", manner.absolute),
        ("alternating", manner.alternating),
        ("second_alternating", manner.second_alternating),
        ("bouncing", manner.bouncing),
        ("fast", manner.fast),
        ("slow", manner.slow),
        ("tense", manner.tense),
        ("rest", manner.rest),
        ("halt", manner.halt),
    ] {
        element.flag(name, value);
    }
    element.some("speed", manner.speed.map(number));
}
