//! Widgets for places in the signing space: points, and everything that a recipe can name as a place.

use chereme_corpus::recipe::{BodyDirection, RecipeLength, SigningSpot};
use chereme_sign::SignComponent;
use eframe::egui::{Id, Ui};

use super::recombine_fields;
use crate::context::PaneInput;
use crate::words::{InterfaceText, recombine_words as words};

/// Shows a point as three lengths: to the left, up from the floor, forward.
pub(super) fn show_point_field(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut [RecipeLength; 3]) -> bool {
    let rows = [
        (words::TO_THE_LEFT, -80.0..=80.0),
        (words::ABOVE_FLOOR, 0.0..=220.0),
        (words::IN_FRONT, -20.0..=100.0),
    ];
    let mut changed = false;
    for (axis, (text, range)) in value.iter_mut().zip(rows) {
        ui.horizontal(|ui| {
            recombine_fields::show_field_caption(ui, seen, text);
            match axis {
                RecipeLength::Metres(metres) => {
                    let mut cm = recombine_fields::round_shown_number(*metres * 100.0);
                    if recombine_fields::show_number_slider(ui, seen.say_text(text), &mut cm, range, " cm") {
                        *metres = cm / 100.0;
                        changed = true;
                    }
                }
                RecipeLength::Arm(share) => {
                    let mut percent = recombine_fields::round_shown_number(*share * 100.0);
                    if recombine_fields::show_number_slider(ui, seen.say_text(text), &mut percent, -300.0..=300.0, " %")
                    {
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
pub(super) fn show_spot_field(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, name: &str, value: &mut SigningSpot) -> bool {
    let mut kind = match value {
        SigningSpot::Me => SpotKind::Me,
        SigningSpot::You => SpotKind::You,
        SigningSpot::Towards(_) => SpotKind::Towards,
        SigningSpot::Value(_) => SpotKind::Value,
        SigningSpot::Point(_) => SpotKind::Point,
    };
    let all = [
        (SpotKind::Me, seen.say_text(words::SPOT_ME)),
        (SpotKind::You, seen.say_text(words::SPOT_YOU)),
        (SpotKind::Towards, seen.say_text(words::SPOT_TOWARDS)),
        (SpotKind::Value, seen.say_text(words::SPOT_VALUE)),
        (SpotKind::Point, seen.say_text(words::SPOT_POINT)),
    ];
    let mut changed = recombine_fields::show_value_choice(ui, name, &mut kind, &all);
    if changed {
        *value = match kind {
            SpotKind::Me => SigningSpot::Me,
            SpotKind::You => SigningSpot::You,
            SpotKind::Towards => SigningSpot::Towards(vec![BodyDirection::Left]),
            SpotKind::Value => SigningSpot::Value(String::new()),
            SpotKind::Point => SigningSpot::Point([0.3, 1.4, 0.5].map(RecipeLength::Metres)),
        };
    }
    match value {
        SigningSpot::Towards(all) => changed |= recombine_fields::show_direction_switches(ui, seen, name, all),
        SigningSpot::Value(text) => {
            changed |= recombine_fields::of_inventory(ui, seen, id, SignComponent::Placement, text)
        }
        SigningSpot::Point(at) => changed |= show_point_field(ui, seen, at),
        SigningSpot::Me | SigningSpot::You => {}
    }
    changed
}

/// Shows a place in the signing space that may be left out.
pub(super) fn optional_spot(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    text: InterfaceText,
    value: &mut Option<SigningSpot>,
) -> bool {
    let row = ui.horizontal_wrapped(|ui| {
        let mut is_set = value.is_some();
        let mut changed = ui.checkbox(&mut is_set, seen.say_text(text)).changed();
        if changed {
            *value = is_set.then_some(SigningSpot::Me);
        }
        if let Some(value) = value {
            changed |= show_spot_field(ui, seen, id, seen.say_text(text), value);
        }
        changed
    });
    row.inner
}
