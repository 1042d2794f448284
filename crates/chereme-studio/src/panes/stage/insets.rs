//! Close-ups of both hands and of the face, in the corners of the stage.

use chereme_corpus::proposed_for;
use chereme_figure::FigureView;
use chereme_motion::BodySide;
use chereme_sign::HandRef;
use chereme_sign::tier::AnnotatedHands;
use eframe::egui::epaint::RectShape;
use eframe::egui::{
    Align2, Color32, CornerRadius, Pos2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2,
};

use super::StagePane;
use super::stage_data::{self, StageInset, StagePart};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::layout::PaneKind;
use crate::pickers;
use crate::words::{fill_text_braces, stage_words as words};

/// Returns the close-ups of all parts.
pub(super) fn stage_insets(stage: &StagePane, parts: &[StagePart]) -> Vec<StageInset> {
    if stage.signer.is_none() {
        return Vec::new();
    }
    let insets = |part: &StagePart| stage_data::place_part_insets(part, stage.eyes[part.eye].view, stage.insets);
    parts.iter().flat_map(insets).collect()
}

/// Shows the close-ups; a click on a hand turns the hands so that their palms are visible, or back.
pub(super) fn show_stage_insets(
    stage: &StagePane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    insets: &[StageInset],
    before: usize,
) {
    // The textures of the last layout do not fit the new close-ups yet.
    if stage.textures.len() != before + insets.len() {
        return;
    }
    let full_uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    for (at, (inset, texture)) in insets.iter().zip(&stage.textures[before..]).enumerate() {
        let painter = ui.painter();
        // Corners of the picture would be visible outside of its rounded frame.
        let picture = RectShape::filled(inset.rect, CornerRadius::same(3), Color32::WHITE);
        painter.add(picture.with_texture(texture.id(), full_uv));
        let colours = seen.pane_colours();
        let id = ui.scope_id().with(("inset", at));
        let response = ui.interact(inset.rect, id, Sense::click());
        let name = seen.say_text(inset_name_action(inset.view).action_row().name);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
        let lit = response.hovered() || response.has_focus();
        let (width, colour) = if lit {
            (2.0, colours.accent)
        } else {
            (1.0, colours.rule)
        };
        let stroke = Stroke::new(width, colour);
        let painter = ui.painter();
        painter.rect_stroke(inset.rect, CornerRadius::same(3), stroke, StrokeKind::Inside);
        let action = match inset.view {
            FigureView::Face => None,
            _ => Some(Action::StagePalms),
        };
        let tip = action.map(|action| {
            let keys = seen.keys.action_keys_text(action);
            fill_text_braces(seen.say_text(words::INSET_TIP), &[("name", &name), ("keys", &keys)])
        });
        let clicked = response.clicked();
        response.on_hover_text(tip.unwrap_or_else(|| name.to_owned()));
        // The face has one direction only, so that a click on it does nothing.
        if let Some(action) = action.filter(|_| clicked) {
            seen.send_command(WindowCommand::Do(action));
        }
    }
}

/// Shows the picture of a selected proposal next to the close-up of its hand, with its confidence.
pub(super) fn show_inset_proposal(ui: &Ui, seen: &PaneInput<'_>, insets: &[StageInset]) {
    // Who recombines does not decide on proposals, and elsewhere nobody sees what is selected.
    let is_in_sight = |pane: PaneKind| pane.is_in_sight(ui.ctx());
    if seen.shown.made.is_some() || is_in_sight(PaneKind::Recombine) || !is_in_sight(PaneKind::Timeline) {
        return;
    }
    let Some(proposal) = SelectedProposal::from_selected_proposal(seen) else {
        return;
    };
    let is_hand = |inset: &&StageInset| {
        inset.view == FigureView::Hand(proposal.side) || inset.view == FigureView::Palm(proposal.side)
    };
    let Some(inset) = insets.iter().find(is_hand) else {
        return;
    };
    let distance = inset.rect.width() + 6.0;
    let away = match proposal.side {
        // The picture stands towards the middle, since close-ups lie in the corners.
        BodySide::Right => distance,
        BodySide::Left => -distance,
    };
    let rect = inset.rect.translate(vec2(away, 0.0));
    let painter = ui.painter();
    painter.rect_filled(rect, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let picture = rect.with_max_y(rect.bottom() - 18.0).shrink(2.0);
    let stored_inventories = seen.snapshot.overview.inventories.iter();
    let mut stored = stored_inventories.filter(|inventory| Some(inventory.id) == proposal.inventory);
    let mut value = proposal.value.as_str();
    if let Some(stored) = stored.next() {
        pickers::paint_inventory_value(ui, picture, seen, &stored.inventory, value);
        let found_value = stored.inventory.find_inventory_value(value);
        value = found_value.map_or(value, |coded| pickers::pickers_data::short_name(coded, seen.language));
    }
    let stroke = Stroke::new(1.5, seen.pane_colours().component);
    painter.rect_stroke(rect, CornerRadius::same(3), stroke, StrokeKind::Inside);
    let sure = proposal.sure.map(|sure| format!(" · {:.0} %", sure * 100.0));
    let font = TextStyle::Small.resolve(ui.style());
    let sure = sure.unwrap_or_default();
    // A long name leaves room for the confidence.
    let room = rect.width() - 4.0 - 6.0 * sure.chars().count() as f32;
    let text = pickers::shorten_text_to_width(ui, value.to_owned(), &font, room) + &sure;
    let text_position = rect.center_bottom() - vec2(0.0, 9.0);
    let colour = ui.visuals().text_color();
    painter.text(text_position, Align2::CENTER_CENTER, text, font, colour);
}

/// The selected proposed value.
struct SelectedProposal {
    side: BodySide,
    value: String,
    inventory: Option<i64>,
    sure: Option<f64>,
}

impl SelectedProposal {
    fn from_selected_proposal(seen: &PaneInput<'_>) -> Option<Self> {
        let selection = seen.snapshot.find_open_annotation(seen.shown.selected_annotation()?)?;
        let row = &selection.tier.row;
        proposed_for(&row.name)?;
        let side = match row.hand {
            Some(AnnotatedHands::One(HandRef::Left | HandRef::Weak)) => BodySide::Left,
            _ => BodySide::Right,
        };
        Some(Self {
            side,
            value: selection.tier.annotations.values[selection.at].to_string(),
            inventory: row.inventory_id,
            sure: selection.tier.annotations.confidences[selection.at],
        })
    }
}

/// Returns the action with the name of a close-up.
fn inset_name_action(view: FigureView) -> Action {
    match view {
        FigureView::Hand(BodySide::Left) | FigureView::Palm(BodySide::Left) => Action::ViewLeftHand,
        FigureView::Face => Action::ViewFace,
        _ => Action::ViewRightHand,
    }
}
