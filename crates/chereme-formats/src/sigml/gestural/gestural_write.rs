//! Writes the tree of a sign as gestural SiGML.

use super::super::node::{bend_text, digits_text};
use super::super::sigml_raw::SigmlElement;
use super::super::sigml_words::SigmlWord;
use chereme_sign::hamnosys::{
    BodyAction, BodyLocation, BodyPlace, CircularPath, DigitList, DirectedPath, DirectionAim, DirectionFrame, EachHand,
    HamnosysSign, HandConstellation, HandPlace, HandSite, HandsUsed, Handshape, HandshapeForm, ManualPart,
    MotionGrowth, MotionKind, MotionManner, MotionRepetition, NotatedMotion, NotatedPosture, PathZigzag, PlaceContact,
    SidedLocation, ThumbExtra,
};
use std::fmt::Display;

/// Returns `sign_manual`; that of a compound contains one for each part.
pub(in super::super) fn write_manual(sign: &HamnosysSign) -> SigmlElement<'static> {
    if let [part] = sign.parts.as_slice() {
        return part_element(part);
    }
    let mut root_element = SigmlElement::new("sign_manual");
    root_element.children.extend(sign.parts.iter().map(part_element));
    root_element
}

impl SigmlElement<'static> {
    /// Sets an attribute.
    pub(in super::super) fn set_attribute(&mut self, name: &str, value: impl Into<String>) {
        let value: String = value.into();
        self.attributes.push((name.to_owned().into(), value.into()));
    }

    /// Sets an attribute if there is a value.
    pub(in super::super) fn set_optional_attribute(&mut self, name: &str, value: Option<impl Into<String>>) {
        if let Some(value) = value {
            self.set_attribute(name, value);
        }
    }

    /// Sets an attribute to the word of a value, if any.
    pub(in super::super) fn set_word_attribute<T: SigmlWord>(&mut self, name: &str, value: Option<T>) {
        self.set_optional_attribute(name, value.map(SigmlWord::sigml_word));
    }

    /// Sets an attribute to true if `value` is.
    pub(in super::super) fn set_flag_attribute(&mut self, name: &str, value: bool) {
        self.set_optional_attribute(name, value.then_some("true"));
    }

    fn set_displayed_attribute<T: Display>(&mut self, name: &str, value: Option<T>) {
        self.set_optional_attribute(name, value.map(|value| value.to_string()));
    }

    fn set_digits_attribute(&mut self, name: &str, digits: &DigitList) {
        let some = !digits.is_empty();
        self.set_optional_attribute(name, some.then(|| digits_text(&digits.0)));
    }
}

/// Formats a number so that it reads back equal.
pub(in super::super) fn format_sigml_number(value: f64) -> String {
    value.to_string()
}

fn part_element(part: &ManualPart) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("sign_manual");
    match part.hands {
        HandsUsed::Dominant => {}
        HandsUsed::Nondominant => element.set_flag_attribute("nondominant", true),
        HandsUsed::Both(symmetry) => {
            element.set_flag_attribute("both_hands", true);
            element.set_flag_attribute("lr_symm", symmetry.left_right);
            element.set_flag_attribute("ud_symm", symmetry.up_down);
            element.set_flag_attribute("oi_symm", symmetry.out_in);
            element.set_flag_attribute("outofphase", symmetry.out_of_phase);
            element.set_flag_attribute("realspace", symmetry.real_space);
        }
    }
    element.set_flag_attribute("holdover", part.holdover);
    let children = &mut element.children;
    children.extend(part.body.iter().map(|action| action_element("nonmanualconfig", action)));
    children.extend(posture_elements(&part.posture));
    children.extend(part.actions.iter().map(motion_element));
    element
}

fn action_element(name: &'static str, action: &BodyAction) -> SigmlElement<'static> {
    let mut part = SigmlElement::new("handconfig");
    part.set_word_attribute("bodypart", Some(action.part));
    part.set_word_attribute("side", action.side);
    let mut element = SigmlElement::new(name);
    element.children.push(part);
    element
        .children
        .extend(action.motion.iter().map(|motion| motion_element(motion)));
    element
}

fn posture_elements(posture: &NotatedPosture) -> Vec<SigmlElement<'static>> {
    let mut elements = Vec::new();
    elements.extend(write_each_hand(&posture.shape, write_shape));
    elements.extend(write_each_hand(&posture.extended, |aim, element| {
        write_aim("extfidir", aim, element);
    }));
    elements.extend(write_each_hand(&posture.palm, |aim, element| {
        write_aim("palmor", aim, element);
    }));
    elements.extend(posture.place.as_ref().map(place_element));
    elements
}

fn write_each_hand<T>(
    value: &EachHand<T>,
    write: impl Fn(&T, &mut SigmlElement<'static>),
) -> Option<SigmlElement<'static>> {
    let hand = |one: Option<&T>| {
        let mut element = SigmlElement::new("handconfig");
        if let Some(one) = one {
            write(one, &mut element);
        }
        element
    };
    match value {
        EachHand::Unset => None,
        EachHand::Shared(one) => Some(hand(Some(one))),
        EachHand::Split(dominant, other) => {
            let mut element = SigmlElement::new("split_handconfig");
            element.children = vec![hand(dominant.as_ref()), hand(other.as_ref())];
            Some(element)
        }
    }
}

fn write_aim<D: Display>(what: &str, aim: &DirectionAim<D>, element: &mut SigmlElement<'static>) {
    element.set_attribute(what, aim.first.to_string());
    element.set_displayed_attribute(&format!("second_{what}"), aim.second.as_ref());
    element.set_flag_attribute(&format!("approx_{what}"), aim.approx);
    element.set_flag_attribute(&format!("abs_{what}"), aim.frame == DirectionFrame::Absolute);
    element.set_flag_attribute(&format!("rel_{what}"), aim.frame == DirectionFrame::Relative);
}

fn write_shape(shape: &Handshape, element: &mut SigmlElement<'static>) {
    write_form("", &shape.form, ["handshape", "mainbend"], element);
    if let Some(between) = &shape.between {
        write_form("second_", between, ["second_handshape", "second_mainbend"], element);
    }
    element.set_flag_attribute("approx_shape", shape.approx);
    element.set_displayed_attribute("splay", shape.splay);
    element.set_digits_attribute("specialfingers", &shape.special);
    element.set_digits_attribute("exempteddigits", &shape.exempt);
    element.set_optional_attribute("opposedfinger", shape.opposed.map(|digit| digits_text(&[digit])));
    for (at, bend) in shape.bends.iter().enumerate() {
        element.set_optional_attribute(&format!("bend{}", at + 1), bend.map(bend_text));
    }
    for (contact, prefix) in shape.contacts.iter().zip(["", "second_"]) {
        let pair = digits_text(&[contact.first, contact.second]);
        element.set_attribute(&format!("{prefix}contactpair"), pair);
        element.set_word_attribute(&format!("{prefix}contactkind"), contact.part);
    }
    match shape.thumb {
        Some(ThumbExtra::Between(first, second)) => {
            element.set_attribute("thumbbetween", digits_text(&[first, second]));
        }
        Some(ThumbExtra::Enclosed) => element.set_flag_attribute("thumbenclosed", true),
        Some(ThumbExtra::Contact(part)) => element.set_word_attribute("thumbcontact", Some(part)),
        None => {}
    }
}

fn write_form(prefix: &str, form: &HandshapeForm, names: [&str; 2], element: &mut SigmlElement<'static>) {
    element.set_word_attribute(names[0], Some(form.class));
    element.set_word_attribute(&format!("{prefix}thumbpos"), form.thumb);
    element.set_optional_attribute(names[1], form.bend.map(bend_text));
    element.set_word_attribute(&format!("{prefix}ceeopening"), form.opening);
}

fn place_element(place: &HandPlace) -> SigmlElement<'static> {
    match place {
        HandPlace::Body(place) => body_element(place),
        HandPlace::Hand(site) => hand_element(site),
        HandPlace::Hands(hands) => constellation_element(hands),
        HandPlace::Split(dominant, other) => {
            let mut element = SigmlElement::new("split_location");
            let half = |half: &Option<Box<HandPlace>>| match half {
                Some(place) => place_element(place),
                None => SigmlElement::new("location_hand"),
            };
            element.children = vec![half(dominant), half(other)];
            element
        }
        HandPlace::Named(number) => {
            let mut element = SigmlElement::new("use_locname");
            element.set_displayed_attribute("use_locname", Some(number));
            element
        }
    }
}

fn constellation_element(hands: &HandConstellation) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("handconstellation");
    element.set_word_attribute("contact", hands.contact);
    element.set_displayed_attribute("def_locname", hands.define);
    if hands.dominant.is_some() || hands.other.is_some() {
        for site in [&hands.other, &hands.dominant] {
            let empty = || SigmlElement::new("location_hand");
            element.children.push(site.as_ref().map_or_else(empty, hand_element));
        }
    }
    element.children.extend(hands.at.as_ref().map(body_element));
    element
}

fn body_element(place: &BodyPlace) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("location_bodyarm");
    let mut site = |prefix: &str, approx: &str, site: &Option<SidedLocation<BodyLocation>>| {
        if let Some(site) = site {
            element.set_word_attribute(&format!("{prefix}location"), Some(site.at));
            element.set_word_attribute(&format!("{prefix}side"), site.side);
            element.set_flag_attribute(approx, site.approx);
        }
    };
    site("", "approx_location", &place.site);
    site("second_", "approx_second_location", &place.second);
    element.set_flag_attribute("behind", place.behind);
    element.set_word_attribute("contact", place.contact);
    element.set_displayed_attribute("def_locname", place.define);
    element.children.extend(place.by.as_ref().map(hand_element));
    element
}

fn hand_element(site: &HandSite) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("location_hand");
    let mut one = |prefix: &str, approx: &str, site: &HandSite| {
        element.set_word_attribute(&format!("{prefix}location"), site.at);
        element.set_digits_attribute(&format!("{prefix}digits"), &site.digits);
        element.set_word_attribute(&format!("{prefix}side"), site.side);
        element.set_flag_attribute(approx, site.approx);
    };
    one("", "approx_location", site);
    if let Some(second) = &site.second {
        one("second_", "approx_second_location", second);
    }
    element.set_word_attribute("contact", site.contact);
    element.set_displayed_attribute("def_locname", site.define);
    element.children.extend(site.by.as_deref().map(hand_element));
    element
}

fn motion_element(motion: &NotatedMotion) -> SigmlElement<'static> {
    if let Some(brushing) = brushing_element(motion) {
        return brushing;
    }
    let mut element = match &motion.kind {
        MotionKind::Directed(directed) => directed_element(directed),
        MotionKind::Circular(circular) => circular_element(circular),
        MotionKind::Wrist { motion, size } => {
            let mut element = SigmlElement::new("wristmotion");
            element.set_word_attribute("motion", Some(*motion));
            element.set_word_attribute("size", *size);
            element
        }
        MotionKind::Cross { diagonal } => {
            let mut element = SigmlElement::new("crossmotion");
            element.set_attribute("cross", if *diagonal { "x" } else { "plus" });
            element
        }
        MotionKind::FingerPlay(digits) => {
            let mut element = SigmlElement::new("fingerplay");
            element.set_digits_attribute("digits", digits);
            element
        }
        MotionKind::Still => SigmlElement::new("nomotion"),
        MotionKind::Body(action) => action_element("nonman_motion", action),
        MotionKind::Split(dominant, other) => {
            let half = |half: &Option<Box<NotatedMotion>>| match half {
                Some(motion) => motion_element(motion),
                None => SigmlElement::new("nomotion"),
            };
            let mut element = SigmlElement::new("split_motion");
            element.children = vec![half(dominant), half(other)];
            element
        }
        MotionKind::Sequence { motions, fused } => {
            let mut element = group_element("seq_motion", motions);
            element.set_flag_attribute("fused", *fused);
            element
        }
        MotionKind::Parallel(motions) => group_element("par_motion", motions),
        MotionKind::Target { motion, posture } => {
            let mut element = SigmlElement::new("tgt_motion");
            let still = || SigmlElement::new("changeposture");
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
fn brushing_element(motion: &NotatedMotion) -> Option<SigmlElement<'static>> {
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
        HandPlace::Body(place) => &mut place.contact,
        HandPlace::Hand(site) => &mut site.contact,
        _ => return None,
    };
    let hands = posture.shape.is_unset() && posture.extended.is_unset() && posture.palm.is_unset();
    if *contact != Some(PlaceContact::Brushing) || !simple || !hands || motion.manner != MotionManner::default() {
        return None;
    }
    *contact = Some(PlaceContact::Touch);
    let mut element = motion_element(inner);
    element.children.push(place_element(&place));
    Some(element)
}

fn group_element(name: &'static str, motions: &[NotatedMotion]) -> SigmlElement<'static> {
    let mut element = SigmlElement::new(name);
    element.children.extend(motions.iter().map(motion_element));
    element
}

fn repeated_element(motion: &NotatedMotion, repetition: &MotionRepetition) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("rpt_motion");
    element.set_word_attribute("repetition", Some(repetition.repeat));
    element.set_word_attribute("second_repetition", repetition.second);
    write_growth("repetition_incrdecr", repetition.growth, &mut element);
    element.set_displayed_attribute("repetition_baseshift", repetition.shift);
    element.set_word_attribute("baseshift_size", repetition.shift_size);
    write_growth("baseshift_incrdecr", repetition.shift_growth, &mut element);
    element.set_flag_attribute("approx_repetition", repetition.approx);
    element.children.push(motion_element(motion));
    element
}

fn directed_element(directed: &DirectedPath) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("directedmotion");
    element.set_attribute("direction", directed.direction.to_string());
    element.set_displayed_attribute("second_direction", directed.second);
    element.set_word_attribute("size", directed.size.first);
    element.set_word_attribute("second_size", directed.size.second);
    if let Some(curve) = directed.curve {
        element.set_attribute("curve", curve.to.compass_letters());
        element.set_word_attribute("curve_size", curve.size);
    }
    write_zigzag(directed.zigzag, &mut element);
    element.set_word_attribute("ellipse_direction", directed.ellipse);
    element
}

fn circular_element(circular: &CircularPath) -> SigmlElement<'static> {
    let mut element = SigmlElement::new("circularmotion");
    element.set_attribute("axis", circular.axis.to_string());
    element.set_displayed_attribute("second_axis", circular.second);
    element.set_word_attribute("size", circular.size.first);
    element.set_word_attribute("second_size", circular.size.second);
    element.set_displayed_attribute("start", circular.clock.start);
    element.set_flag_attribute("clockplus", circular.clock.full > 0);
    element.set_flag_attribute("second_clockplus", circular.clock.full > 1);
    element.set_displayed_attribute("end", circular.clock.end);
    element.set_word_attribute("ellipse_direction", circular.ellipse);
    element.set_word_attribute("ellipse_size", circular.ellipse_size);
    write_zigzag(circular.zigzag, &mut element);
    write_growth("incrdecr", circular.growth, &mut element);
    element
}

fn write_zigzag(zigzag: Option<PathZigzag>, element: &mut SigmlElement<'static>) {
    if let Some(zigzag) = zigzag {
        element.set_attribute("zigzag_style", if zigzag.wavy { "wavy" } else { "zigzag" });
        element.set_word_attribute("zigzag_size", zigzag.size);
        write_growth("zigzag_incrdecr", zigzag.growth, element);
    }
}

fn write_growth(name: &str, growth: Option<MotionGrowth>, element: &mut SigmlElement<'static>) {
    if let Some(growth) = growth {
        let trend = if growth.increasing { "increasing" } else { "decreasing" };
        element.set_attribute(name, trend);
        element.set_word_attribute(&format!("{name}_size"), growth.size);
    }
}

fn write_manner(manner: &MotionManner, element: &mut SigmlElement<'static>) {
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
        element.set_flag_attribute(name, value);
    }
    element.set_optional_attribute("speed", manner.speed.map(format_sigml_number));
}
