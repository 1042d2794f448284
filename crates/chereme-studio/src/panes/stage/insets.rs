//! Close-ups of both hands and of the face, in the corners of the stage.

use chereme_corpus::proposed_for;
use chereme_figure::View;
use chereme_motion::Side;
use chereme_sign::HandRef;
use chereme_sign::tier::Hands;
use eframe::egui::epaint::RectShape;
use eframe::egui::{
    Align2, Color32, CornerRadius, Pos2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use super::Stage;
use super::data::{self, Inset, StagePart};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::pickers;
use crate::words::{fill, stage as words};

/// Returns the close-ups of all parts.
pub(super) fn of(stage: &Stage, parts: &[StagePart]) -> Vec<Inset> {
    if stage.signer.is_none() {
        return Vec::new();
    }
    let insets = |part: &StagePart| data::insets(part, stage.eyes[part.eye].view, stage.insets);
    parts.iter().flat_map(insets).collect()
}

/// Shows the close-ups; a click on a hand turns the hands so that their palms are visible, or back.
pub(super) fn show(
    stage: &Stage,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    (insets, before): (&[Inset], usize),
) {
    if stage.textures.len() != before + insets.len() {
        return;
    }
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    for (at, (inset, texture)) in insets.iter().zip(&stage.textures[before..]).enumerate() {
        let painter = ui.painter();
        // Corners of the picture would be visible outside of its rounded frame.
        let picture = RectShape::filled(inset.rect, CornerRadius::same(3), Color32::WHITE);
        painter.add(picture.with_texture(texture.id(), whole));
        let colours = seen.colours();
        let id = ui.scope_id().with(("inset", at));
        let response = ui.interact(inset.rect, id, Sense::click());
        let name = seen.say(name(inset.view).row().name);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
        let lit = response.hovered() || response.has_focus();
        let (width, colour) = if lit {
            (2.0, colours.accent)
        } else {
            (1.0, colours.rule)
        };
        let stroke = Stroke::new(width, colour);
        let painter = ui.painter();
        painter.rect_stroke(
            inset.rect,
            CornerRadius::same(3),
            stroke,
            StrokeKind::Inside,
        );
        let action = match inset.view {
            View::Face => None,
            _ => Some(Action::StagePalms),
        };
        let tip = action.map(|action| {
            let keys = seen.keys.text(action);
            fill(
                seen.say(words::INSET_TIP),
                &[("name", &name), ("keys", &keys)],
            )
        });
        let clicked = response.clicked();
        response.on_hover_text(tip.unwrap_or_else(|| name.to_owned()));
        if let Some(action) = action.filter(|_| clicked) {
            out.send(Command::Do(action));
        }
    }
}

/// Shows the picture of a selected proposal next to the close-up of its hand, with its confidence.
pub(super) fn proposal(ui: &Ui, seen: &PaneInput<'_>, insets: &[Inset]) {
    let Some(proposal) = Proposal::of(seen) else {
        return;
    };
    let is_hand =
        |it: &&Inset| it.view == View::Hand(proposal.side) || it.view == View::Palm(proposal.side);
    let Some(inset) = insets.iter().find(is_hand) else {
        return;
    };
    let away = inset.rect.width() + 6.0;
    let away = match proposal.side {
        Side::Right => away,
        Side::Left => -away,
    };
    let rect = inset.rect.translate(vec2(away, 0.0));
    let painter = ui.painter();
    painter.rect_filled(rect, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let picture = rect.with_max_y(rect.bottom() - 18.0).shrink(2.0);
    let stored = seen.snapshot.overview.inventories.iter();
    let mut stored = stored.filter(|it| Some(it.id) == proposal.inventory);
    let mut value = proposal.value.as_str();
    if let Some(stored) = stored.next() {
        pickers::picture(ui, picture, seen, &stored.inventory, value);
        let known = stored.inventory.find(value);
        value = known.map_or(value, |it| pickers::data::short_name(it, seen.language));
    }
    let stroke = Stroke::new(1.5, seen.colours().component);
    painter.rect_stroke(rect, CornerRadius::same(3), stroke, StrokeKind::Inside);
    let sure = proposal
        .sure
        .map(|sure| format!(" · {:.0} %", sure * 100.0));
    let font = TextStyle::Small.resolve(ui.style());
    let sure = sure.unwrap_or_default();
    // A long name leaves room for the confidence.
    let room = rect.width() - 4.0 - 6.0 * sure.chars().count() as f32;
    let text = pickers::fitted(ui, value.to_owned(), &font, room) + &sure;
    let at = rect.center_bottom() - vec2(0.0, 9.0);
    let colour = ui.visuals().text_color();
    painter.text(at, Align2::CENTER_CENTER, text, font, colour);
}

/// The selected proposed value.
struct Proposal {
    side: Side,
    value: String,
    inventory: Option<i64>,
    sure: Option<f64>,
}

impl Proposal {
    fn of(seen: &PaneInput<'_>) -> Option<Self> {
        let found = seen.snapshot.annotation(seen.shown.annotation()?)?;
        let row = &found.tier.row;
        proposed_for(&row.name)?;
        let side = match row.hand {
            Some(Hands::One(HandRef::Left | HandRef::Weak)) => Side::Left,
            _ => Side::Right,
        };
        Some(Self {
            side,
            value: found.tier.annotations.values[found.at].to_string(),
            inventory: row.inventory_id,
            sure: found.tier.annotations.confidences[found.at],
        })
    }
}

/// Returns the action with the name of a close-up.
fn name(view: View) -> Action {
    match view {
        View::Hand(Side::Left) | View::Palm(Side::Left) => Action::ViewLeftHand,
        View::Face => Action::ViewFace,
        _ => Action::ViewRightHand,
    }
}
