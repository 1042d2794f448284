//! The widgets of a face in a recipe: a value and its share for each part.

use std::collections::BTreeMap;

use chereme_corpus::recipe::{FacePart, RecipeFactor};
use eframe::egui::{Id, Ui};

use super::recombine_fields::{show_inventory_line, show_number_slider};
use super::recombine_settings::show_recipe_text_line;
use crate::context::PaneInput;

/// The width of a slider with its number, in points.
const SHARE_SLIDER_WIDTH_POINTS: f32 = 150.0;

/// Shows the parts of a face, each with its value, its picture and the share of it; returns whether the user changed one.
pub(super) fn show_face_parts(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    show: &mut BTreeMap<FacePart, String>,
) -> bool {
    let mut changed = false;
    for part in FacePart::ALL_FACE_PARTS {
        let inventory = part.face_part_inventory();
        let part_name = inventory.names.get(seen.language.language_code());
        let name = part_name.map_or(part.face_part_name(), String::as_str);
        let text = show.remove(&part).unwrap_or_default();
        let (value, share) = text.split_once('*').unwrap_or((&text, "1"));
        let (mut value, share) = (value.to_owned(), share.parse::<RecipeFactor>());
        let mut share = share.map_or(1.0, |factor| factor.0);
        ui.horizontal_wrapped(|ui| {
            ui.weak(name);
            changed |= match part {
                FacePart::Mouthing => show_recipe_text_line(ui, name, "bOl", &mut value),
                _ => show_inventory_line(ui, seen, id.with(name), &[inventory], [name, ""], &mut value),
            };
            if !value.is_empty() && ui.available_size_before_wrap().x < SHARE_SLIDER_WIDTH_POINTS {
                // A slider is a row of its own, which does not wrap.
                ui.end_row();
            }
            changed |= !value.is_empty() && show_number_slider(ui, name, &mut share, 0.0..=1.0, "×");
        });
        let part_share = Some(share).filter(|share| *share != 1.0);
        let share = part_share.map_or_else(String::new, |share| format!("*{share}"));
        show.extend((!value.is_empty()).then(|| (part, value + &share)));
    }
    changed
}
