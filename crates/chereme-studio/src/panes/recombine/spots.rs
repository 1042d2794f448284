//! Widgets for places in the signing space: points, and everything that a recipe can name as a place.

use chereme_corpus::recipe::{Direction, Length, Spot};
use chereme_sign::Component;
use eframe::egui::{Id, Ui};

use super::fields;
use crate::context::PaneInput;
use crate::words::{Text, recombine as words};

/// Shows a point as three lengths: to the left, up from the floor, forward.
pub(super) fn point(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut [Length; 3]) -> bool {
    let rows = [
        (words::TO_THE_LEFT, -80.0..=80.0),
        (words::ABOVE_FLOOR, 0.0..=220.0),
        (words::IN_FRONT, -20.0..=100.0),
    ];
    let mut changed = false;
    for (axis, (text, range)) in value.iter_mut().zip(rows) {
        ui.horizontal(|ui| {
            fields::caption(ui, seen, text);
            match axis {
                Length::Metres(metres) => {
                    let mut cm = fields::tidy(*metres * 100.0);
                    if fields::slide(ui, seen.say(text), &mut cm, range, " cm") {
                        *metres = cm / 100.0;
                        changed = true;
                    }
                }
                Length::Arm(share) => {
                    let mut percent = fields::tidy(*share * 100.0);
                    if fields::slide(ui, seen.say(text), &mut percent, -300.0..=300.0, " %") {
                        *share = percent / 100.0;
                        changed = true;
                    }
                }
            }
        });
    }
    changed
}

#[derive(Clone, Copy, PartialEq)]
enum SpotKind {
    Me,
    You,
    Towards,
    Value,
    Point,
}

/// Shows a place in the signing space.
pub(super) fn spot(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    name: &str,
    value: &mut Spot,
) -> bool {
    let mut kind = match value {
        Spot::Me => SpotKind::Me,
        Spot::You => SpotKind::You,
        Spot::Towards(_) => SpotKind::Towards,
        Spot::Value(_) => SpotKind::Value,
        Spot::Point(_) => SpotKind::Point,
    };
    let all = [
        (SpotKind::Me, seen.say(words::SPOT_ME)),
        (SpotKind::You, seen.say(words::SPOT_YOU)),
        (SpotKind::Towards, seen.say(words::SPOT_TOWARDS)),
        (SpotKind::Value, seen.say(words::SPOT_VALUE)),
        (SpotKind::Point, seen.say(words::SPOT_POINT)),
    ];
    let mut changed = fields::choose(ui, name, &mut kind, &all);
    if changed {
        *value = match kind {
            SpotKind::Me => Spot::Me,
            SpotKind::You => Spot::You,
            SpotKind::Towards => Spot::Towards(vec![Direction::Left]),
            SpotKind::Value => Spot::Value(String::new()),
            SpotKind::Point => Spot::Point([0.3, 1.4, 0.5].map(Length::Metres)),
        };
    }
    match value {
        Spot::Towards(all) => changed |= fields::directions(ui, seen, name, all),
        Spot::Value(text) => {
            changed |= fields::of_inventory(ui, seen, id, Component::Placement, text)
        }
        Spot::Point(at) => changed |= point(ui, seen, at),
        Spot::Me | Spot::You => {}
    }
    changed
}

/// Shows a place in the signing space that may be left out.
pub(super) fn optional_spot(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    text: Text,
    value: &mut Option<Spot>,
) -> bool {
    let row = ui.horizontal_wrapped(|ui| {
        let mut said = value.is_some();
        let mut changed = ui.checkbox(&mut said, seen.say(text)).changed();
        if changed {
            *value = said.then_some(Spot::Me);
        }
        if let Some(value) = value {
            changed |= spot(ui, seen, id, seen.say(text), value);
        }
        changed
    });
    row.inner
}
