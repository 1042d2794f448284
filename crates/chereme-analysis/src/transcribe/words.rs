//! Features in words, as tables show them.

use chereme_sign::hamnosys::{
    Bend, BodyPlace, Contact, Digit, Digits, Form, HandSite, Handshape, Side, Site, Size,
};

pub(super) fn shape(shape: &Handshape) -> String {
    let mut words = form(&shape.form);
    if let Some(second) = &shape.between {
        words = format!("{words} | {}", form(second));
    }
    if !shape.special.is_empty() {
        words = format!("{words}, digits {}", digits(&shape.special));
    }
    for (n, bend) in shape.bends.iter().enumerate() {
        if let Some(bend) = bend {
            words = format!("{words}, digit {} {}", n + 1, bend_name(*bend));
        }
    }
    words
}

fn form(form: &Form) -> String {
    let mut words = format!("{:?}", form.class).to_lowercase();
    if let Some(thumb) = form.thumb {
        words = format!("{words} thumb {}", format!("{thumb:?}").to_lowercase());
    }
    if let Some(opening) = form.opening {
        words = format!("{words} {}", format!("{opening:?}").to_lowercase());
    }
    if let Some(bend) = form.bend {
        words = format!("{words} {}", bend_name(bend));
    }
    words
}

fn bend_name(bend: Bend) -> &'static str {
    match bend {
        Bend::Bent => "bent",
        Bend::Round => "round",
        Bend::Hooked => "hooked",
        Bend::DoubleBent => "double-bent",
        Bend::DoubleHooked => "double-hooked",
        Bend::HalfBent => "half-bent",
        Bend::Joints(_) => "bent by joints",
    }
}

fn digits(digits: &Digits) -> String {
    digits
        .0
        .iter()
        .map(|digit: &Digit| digit.number().to_string())
        .collect()
}

pub(super) fn place(place: &BodyPlace) -> String {
    let mut words = place.site.as_ref().map(site).unwrap_or_default();
    if let Some(second) = &place.second {
        words = format!("{words} | {}", site(second));
    }
    words
}

fn site<L: std::fmt::Debug>(site: &Site<L>) -> String {
    let at = format!("{:?}", site.at).to_lowercase();
    match site.side {
        Some(side) => format!("{at} {}", side_name(side)),
        None => at,
    }
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::LeftBeside => "left beside",
        Side::LeftAt => "left",
        Side::RightAt => "right",
        Side::RightBeside => "right beside",
        Side::Front => "front",
        Side::Back => "back",
        Side::Dorsal => "dorsal",
        Side::Palmar => "palmar",
        Side::Radial => "radial",
        Side::Ulnar => "ulnar",
    }
}

pub(super) fn hand_site(site: &HandSite) -> String {
    let mut words = site
        .at
        .map(|at| format!("{at:?}").to_lowercase())
        .unwrap_or_default();
    if !site.digits.is_empty() {
        words = format!("{words} {}", digits(&site.digits));
    }
    if let Some(side) = site.side {
        words = format!("{words} {}", side_name(side));
    }
    words
}

pub(super) fn contact(contact: Option<Contact>) -> &'static str {
    match contact {
        None => "none",
        Some(Contact::Touch) => "touch",
        Some(Contact::Close) => "close",
        Some(Contact::Interlock) => "interlock",
        Some(Contact::Cross) => "cross",
        Some(Contact::ArmExtended) => "arm extended",
        Some(Contact::Brushing) => "brushing",
    }
}

pub(super) fn size(size: Option<Size>) -> &'static str {
    match size {
        Some(Size::Small) => "small",
        None => "usual",
        Some(Size::Big) => "big",
    }
}
