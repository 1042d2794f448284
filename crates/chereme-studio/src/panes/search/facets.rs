//! Facets: how often each value occurs among what was found.

use std::collections::BTreeMap;

use chereme_sign::{Component, Field};
use eframe::egui::{
    Align2, Rect, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo,
    pos2, vec2,
};

use super::builder::with_value;
use super::rows::component_text;
use crate::context::Seen;
use crate::pickers;
use crate::words::{Text, fill, search as words};

/// The words of fields for hands and phases.
const PARTS: [(&str, Text); 6] = [
    ("right", words::RIGHT),
    ("left", words::LEFT),
    ("dominant", words::DOMINANT),
    ("weak", words::WEAK),
    ("initial", words::INITIAL),
    ("final", words::FINAL),
];

/// Draws how often each value occurs; returns the query that wants the one that was chosen too.
pub(super) fn show(
    ui: &mut Ui,
    seen: &Seen<'_>,
    facets: &BTreeMap<String, Vec<(String, usize)>>,
    query: &str,
    height: f32,
) -> Option<String> {
    let mut chosen = None;
    ScrollArea::vertical()
        .id_salt("facets")
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for field in order(facets.keys()) {
                let values = &facets[field];
                let name = facet_name(field, seen);
                ui.label(RichText::new(name).small().weak());
                let most = values.iter().map(|(_, count)| *count).max().unwrap_or(1);
                for (value, count) in values {
                    if facet(ui, seen, field, value, *count as f32 / most as f32, *count) {
                        chosen = Some(with_value(query, field, value));
                    }
                }
                ui.add_space(4.0);
            }
        });
    chosen
}

/// Returns the fields of facets in the order of the components, the others after them.
pub(super) fn order<'a>(fields: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut all: Vec<&String> = fields.collect();
    let place = |field: &&String| {
        let component = field.parse::<Field>().ok().map(|it| it.component);
        Component::ALL
            .iter()
            .position(|it| Some(*it) == component)
            .unwrap_or(Component::ALL.len())
    };
    all.sort_by_key(place);
    all
}

fn facet_name(field: &str, seen: &Seen<'_>) -> String {
    let Ok(known) = field.parse::<Field>() else {
        return field.to_owned();
    };
    let mut name = seen.say(component_text(known.component)).to_owned();
    for part in known.feature.iter() {
        name.push_str(&format!(" · {part}"));
    }
    let hand = known.hand.map(|hand| hand.to_string());
    let phase = known.phase.map(|phase| phase.to_string());
    for part in hand.into_iter().chain(phase) {
        let known = PARTS.iter().find(|(word, _)| *word == part);
        let part = known.map_or(part.as_str(), |(_, text)| seen.say(*text));
        name.push_str(&format!(" ({part})"));
    }
    name
}

/// Draws one value with its picture, its count, and a bar that is as long as it is frequent.
fn facet(ui: &mut Ui, seen: &Seen<'_>, field: &str, value: &str, share: f32, count: usize) -> bool {
    let parsed = field.parse::<Field>().ok();
    let inventory = parsed.as_ref().and_then(|field| {
        let all = seen.snapshot.overview.inventories.iter();
        all.map(|it| &it.inventory)
            .find(|it| it.component == field.component && it.feature == field.feature)
    });
    let size = vec2(ui.available_width() - 4.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = format!("{field}={value} ({count})");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let colours = seen.colours();
        let bar = Rect::from_min_size(rect.min, vec2(rect.width() * share, rect.height()));
        painter.rect_filled(bar.shrink(1.0), 3.0, colours.selection.gamma_multiply(0.5));
        let picture = Rect::from_min_size(rect.min, vec2(26.0, 26.0));
        let mut left = rect.left() + 6.0;
        if let Some(inventory) = inventory
            && pickers::picture(ui, picture.shrink(1.0), seen, inventory, value)
        {
            left = picture.right() + 5.0;
        }
        let visuals = ui.style().interact(&response);
        let font = TextStyle::Body.resolve(ui.style());
        let text = visuals.text_color();
        let at = pos2(left, rect.center().y);
        painter.text(at, Align2::LEFT_CENTER, value, font.clone(), text);
        let at = rect.right_center() - vec2(6.0, 0.0);
        let weak = ui.visuals().weak_text_color();
        painter.text(at, Align2::RIGHT_CENTER, count, font, weak);
        if response.has_focus() || response.hovered() {
            let stroke = Stroke::new(1.0, colours.accent);
            painter.rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
        }
    }
    let tip = fill(seen.say(words::FACET_TIP), &[("value", &value)]);
    response.on_hover_text(tip).clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_stand_in_the_order_of_the_components() {
        let fields = ["signer", "right.placement", "origin", "configuration"].map(str::to_owned);
        let order: Vec<&str> = order(fields.iter())
            .into_iter()
            .map(String::as_str)
            .collect();
        assert_eq!(
            order,
            ["configuration", "right.placement", "signer", "origin"]
        );
    }
}
