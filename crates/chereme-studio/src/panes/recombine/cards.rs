//! The stack's widgets: a frame for each card, with its settings and its results.

use eframe::egui::{
    Button, CursorIcon, DragAndDrop, Frame, Id, Key, Modifiers, Rect, Response, RichText, Role, Sense, Stroke,
    TextStyle, Ui, WidgetInfo, vec2,
};

use super::live::{CardNote, RecipeTrouble};
use super::stack::{CardContent, CardStack, RecipeCard};
use super::{RecombinePane, catalogue, recombine_fields, recombine_settings};
use crate::action::Action;
use crate::context::PaneInput;
use crate::window_remedy;
use crate::words::{
    InterfaceLanguage, fill_text_braces, recombine_words as words, search_words, translate_library_message,
};

/// Residuals above this are reported as a warning, in metres.
const RESIDUAL_WARNING_METRES: f64 = 0.005;
/// Distance from the edge within which a dragged card scrolls the list, in points.
const CARD_SCROLL_EDGE_POINTS: f32 = 28.0;

/// Time without typing before an error is shown, in seconds.
const TYPING_PAUSE_SECONDS: f64 = 1.2;

/// The payload of a drag: the id of a card.
struct DraggedCard(u64);

/// An action of the user on the stack in this frame.
enum CardStackAction {
    Choose(u64),
    Change(u64, CardContent),
    Act(u64, Action),
    Move(u64, usize),
}

/// A card with its results, for display.
struct ShownCard<'a> {
    card: &'a RecipeCard,
    first: bool,
    counts: bool,
    chosen: bool,
    /// Whether the card takes the keyboard.
    focus: bool,
    /// Whether the card is new, so that its first field takes the keyboard.
    fresh: bool,
    note: Option<&'a CardNote>,
    trouble: Option<&'a RecipeTrouble>,
}

/// Shows every card; returns whether any was changed.
pub(super) fn show_recipe_cards(pane: &mut RecombinePane, ui: &mut Ui, seen: &PaneInput<'_>) -> bool {
    let mut did = Vec::new();
    let (focus, fresh) = (pane.focus.take(), pane.fresh.take());
    let mut places = Vec::new();
    // An unfinished name is not an error yet.
    let now = ui.input(|input| input.time);
    let typing = ui.ctx().text_edit_focused() && now - pane.changed.1 < TYPING_PAUSE_SECONDS;
    if typing {
        ui.ctx().request_repaint_after_secs(TYPING_PAUSE_SECONDS as f32);
    }
    let RecombinePane { stack, live, .. } = pane;
    for (at, card) in stack.stack_cards().iter().enumerate() {
        let shown = ShownCard {
            card,
            first: at == 0,
            counts: stack.is_card_used(at),
            chosen: pane.chosen == Some(card.id),
            focus: focus == Some(card.id),
            fresh: fresh == Some(card.id),
            note: live.notes.get(&card.id).filter(|_| live.trouble.is_none()),
            trouble: live
                .trouble
                .as_ref()
                .filter(|trouble| trouble.card == Some(card.id) && !typing),
        };
        let indent = if card.what.is_source() { 0 } else { 10 };
        let margin = eframe::egui::Margin {
            left: indent,
            ..Default::default()
        };
        let inner = Frame::new().outer_margin(margin).show(ui, |ui| {
            ui.push_id(card.id, |ui| show_card_frame(ui, seen, &shown, stack, &mut did));
        });
        places.push(inner.response.rect);
    }
    drop_between(ui, seen, stack, &places, &mut did);
    let changed = did.iter().any(|action| !matches!(action, CardStackAction::Choose(_)));
    for did in did {
        match did {
            CardStackAction::Choose(id) => pane.chosen = Some(id),
            CardStackAction::Change(id, what) => {
                if let Some(card) = pane.stack.get_mut(id) {
                    card.what = what;
                }
            }
            CardStackAction::Act(id, action) => pane.apply_card_action(id, action),
            CardStackAction::Move(id, to) => drop(pane.stack.move_to(id, to)),
        }
    }
    changed
}

fn show_card_frame(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    shown: &ShownCard<'_>,
    stack: &CardStack,
    did: &mut Vec<CardStackAction>,
) {
    let colours = seen.pane_colours();
    let edge = match (shown.trouble.is_some(), shown.chosen) {
        (true, _) => Stroke::new(1.5, colours.trouble),
        (false, true) => Stroke::new(1.5, colours.accent),
        (false, false) => Stroke::new(1.0, colours.rule),
    };
    let fill = if shown.card.what.is_source() {
        ui.visuals().faint_bg_color
    } else {
        ui.visuals().panel_fill
    };
    let frame = Frame::new().fill(fill).stroke(edge).corner_radius(6).inner_margin(6);
    let inner = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 4.0;
        show_card_header(ui, seen, shown, stack, did);
        let mut what = shown.card.what.clone();
        let id = Id::unique(("card", shown.card.id));
        let changed = ui
            .scope(|ui| {
                if !shown.card.on {
                    ui.disable();
                }
                let at = recombine_settings::SettingsCard {
                    card: shown.card.id,
                    id,
                    first: shown.first,
                    whole: shown.chosen,
                };
                if shown.fresh {
                    recombine_fields::give_focus(ui);
                }
                let changed = recombine_settings::show_card_settings(ui, seen, at, &mut what);
                recombine_fields::takes_focus(ui);
                changed
            })
            .inner;
        if changed {
            did.push(CardStackAction::Choose(shown.card.id));
            did.push(CardStackAction::Change(shown.card.id, what));
        }
        if let Some(what) = show_results(ui, seen, shown) {
            did.push(CardStackAction::Choose(shown.card.id));
            did.push(CardStackAction::Change(shown.card.id, what));
        }
    });
    let rect = inner.response.rect.intersect(ui.clip_rect());
    let pressed = ui.input(|input| {
        let press_position = input.pointer.interact_pos();
        input.pointer.any_pressed() && press_position.is_some_and(|at| rect.contains(at))
    });
    // Any press in a card chooses it, the ones on its fields, too, which take the click.
    if pressed && !shown.chosen {
        did.push(CardStackAction::Choose(shown.card.id));
    }
}

/// Shows the line above a card: its name, its switch, and its actions.
fn show_card_header(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    shown: &ShownCard<'_>,
    stack: &CardStack,
    did: &mut Vec<CardStackAction>,
) {
    let card = shown.card;
    let title = seen.say_text(catalogue::card_content_title(&card.what));
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let only = card.what.is_source() && stack.count_stack_sources() < 2;
        let mut on = card.on;
        let label = fill_text_braces(seen.say_text(words::SWITCHED_ON), &[("card", &title)]);
        let response = ui.add_enabled(!only, eframe::egui::Checkbox::without_text(&mut on));
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, !only, on, &label));
        let tip = card_button_tooltip(seen, words::SWITCH_TIP, Action::CardSwitch);
        if response.on_hover_text(tip).changed() {
            did.push(CardStackAction::Act(card.id, Action::CardSwitch));
        }
        let buttons = 62.0;
        let width = (ui.available_width() - buttons).max(40.0);
        let handle = show_card_handle(ui, seen, shown, title, width);
        if handle.clicked() || handle.gained_focus() || handle.drag_started() {
            did.push(CardStackAction::Choose(card.id));
        }
        if handle.drag_started() {
            DragAndDrop::set_payload(ui.ctx(), DraggedCard(card.id));
        }
        let name = fill_text_braces(seen.say_text(words::CARD_MENU), &[("card", &title)]);
        let menu = ui.menu_button("…", |ui| show_card_menu(ui, seen, card.id, did));
        menu.response
            .widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let name = fill_text_braces(seen.say_text(words::REMOVE_CARD), &[("card", &title)]);
        let remove = ui.add(Button::new("×").frame(false).min_size(vec2(24.0, 24.0)));
        remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let tip = self::card_button_tooltip(seen, words::REMOVE, Action::CardRemove);
        if remove.on_hover_text(tip).clicked() {
            did.push(CardStackAction::Act(card.id, Action::CardRemove));
        }
    });
}

/// Returns the tooltip of a button: its effect, and its key.
fn card_button_tooltip(seen: &PaneInput<'_>, text: crate::words::InterfaceText, action: Action) -> String {
    format!("{} ({})", seen.say_text(text), seen.keys.action_keys_text(action))
}

/// Shows the title, which selects a card and is the handle for dragging it.
fn show_card_handle(ui: &mut Ui, seen: &PaneInput<'_>, shown: &ShownCard<'_>, title: &str, width: f32) -> Response {
    let size = vec2(width, ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let label = fill_text_braces(seen.say_text(words::CARD), &[("card", &title)]);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, shown.chosen, &label));
    if shown.focus {
        response.request_focus();
        response.scroll_to_me(None);
    }
    if response.has_focus() {
        let up = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::ArrowUp));
        let down = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::ArrowDown));
        if up || down {
            let direction = if up {
                eframe::egui::FocusDirection::Up
            } else {
                eframe::egui::FocusDirection::Down
            };
            ui.memory_mut(|memory| memory.move_focus(direction));
        }
        let stroke = Stroke::new(1.5, seen.pane_colours().accent);
        let kind = eframe::egui::StrokeKind::Outside;
        ui.painter().rect_stroke(rect, 3.0, stroke, kind);
    }
    let colour = if shown.counts {
        ui.visuals().strong_text_color()
    } else {
        ui.visuals().weak_text_color()
    };
    let grip = ui.visuals().weak_text_color();
    for dot in 0..6 {
        let dot_centre = rect.left_center() + vec2(4.0 + 4.0 * (dot % 2) as f32, 4.0 * (dot / 2) as f32 - 4.0);
        ui.painter().circle_filled(dot_centre, 1.2, grip);
    }
    let title_position = rect.left_center() + vec2(16.0, 0.0);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let font = TextStyle::Button.resolve(ui.style());
    painter.text(title_position, eframe::egui::Align2::LEFT_CENTER, title, font, colour);
    response.on_hover_cursor(CursorIcon::Grab)
}

fn show_card_menu(ui: &mut Ui, seen: &PaneInput<'_>, id: u64, did: &mut Vec<CardStackAction>) {
    for action in [
        Action::CardUp,
        Action::CardDown,
        Action::CardDuplicate,
        Action::CardSwitch,
        Action::CardRemove,
    ] {
        let button =
            Button::new(seen.say_text(action.action_row().name)).shortcut_text(seen.keys.action_keys_text(action));
        if ui.add(button).clicked() {
            did.push(CardStackAction::Act(id, action));
            ui.close();
        }
    }
}

/// Returns the reason for a failure in `language`; a step that is named before it stays as it is.
fn translate_step_failure(text: &str, language: InterfaceLanguage) -> String {
    let translation = translate_library_message(text, language);
    match text.split_once(": ") {
        Some((step, cause)) if translation == text => {
            format!("{step}: {}", translate_library_message(cause, language))
        }
        _ => translation,
    }
}

/// Shows the results of a card: its effects, its residual, or why it is impossible; returns the corrected card if the
/// user accepts a proposed correction.
fn show_results(ui: &mut Ui, seen: &PaneInput<'_>, shown: &ShownCard<'_>) -> Option<CardContent> {
    if let Some(trouble) = shown.trouble {
        ui.label(
            RichText::new(translate_step_failure(&trouble.text, seen.language))
                .small()
                .color(seen.pane_colours().trouble),
        );
        if let Some(remedy) = trouble
            .remedy
            .as_ref()
            .filter(|remedy| !trouble.text.contains(remedy.remedy_text()))
            .and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language))
        {
            ui.label(RichText::new(remedy).small());
        }
        let correction = trouble.meant.as_ref()?;
        let mended = shown
            .card
            .what
            .with_corrected_name(&correction.written, &correction.right)?;
        let text = fill_text_braces(seen.say_text(search_words::MEND), &[("text", &correction.right)]);
        return ui.small_button(text).clicked().then_some(mended);
    }
    if shown.card.on && !shown.card.what.is_complete() {
        ui.label(RichText::new(seen.say_text(words::INCOMPLETE)).small().weak());
    }
    let quiet = shown.card.what.is_source() && !shown.chosen;
    let note = shown.note.filter(|_| shown.counts && !quiet)?;
    if let Some(residual) = note.residual {
        let text = fill_text_braces(
            seen.say_text(words::RESIDUAL),
            &[("mm", &format!("{:.1}", residual * 1000.0))],
        );
        let colour = if residual > RESIDUAL_WARNING_METRES {
            seen.pane_colours().trouble
        } else {
            seen.pane_colours().good
        };
        ui.label(RichText::new(text).small().color(colour));
    }
    for did in &note.did {
        let text = translate_library_message(&seen.snapshot.name_tokens_in_text(did), seen.language);
        ui.label(RichText::new(text).small().weak());
    }
    None
}

/// Shows the dragged card at the pointer.
fn show_dragged_card(ui: &Ui, seen: &PaneInput<'_>, stack: &CardStack, id: u64, at: eframe::egui::Pos2) {
    let Some(place) = stack.find_card_position(id) else {
        return;
    };
    let title = seen.say_text(catalogue::card_content_title(&stack.stack_cards()[place].what));
    let layer = eframe::egui::LayerId::new(eframe::egui::Order::Tooltip, Id::unique("carried card"));
    let painter = ui.ctx().layer_painter(layer);
    let font = TextStyle::Button.resolve(ui.style());
    let galley = painter.layout_no_wrap(title.to_owned(), font, ui.visuals().strong_text_color());
    let size = galley.size() + vec2(20.0, 10.0);
    let rect = Rect::from_min_size(at + vec2(10.0, -size.y / 2.0), size);
    let stroke = Stroke::new(1.5, seen.pane_colours().accent);
    let kind = eframe::egui::StrokeKind::Inside;
    painter.rect(rect, 6.0, ui.visuals().panel_fill, stroke, kind);
    painter.galley(rect.min + vec2(10.0, 5.0), galley, ui.visuals().text_color());
}

/// Shows the place where a dragged card would go, and drops it there.
fn drop_between(ui: &mut Ui, seen: &PaneInput<'_>, stack: &CardStack, places: &[Rect], did: &mut Vec<CardStackAction>) {
    let Some(dragged) = DragAndDrop::payload::<DraggedCard>(ui.ctx()) else {
        return;
    };
    let (Some(at), Some(first)) = (ui.input(|input| input.pointer.interact_pos()), places.first()) else {
        return;
    };
    let to = places.iter().take_while(|rect| rect.center().y < at.y).count();
    let y = match places.get(to) {
        Some(rect) => rect.top() - 3.0,
        None => places.last().map_or(first.bottom(), |rect| rect.bottom()) + 3.0,
    };
    let stroke = Stroke::new(3.0, seen.pane_colours().accent);
    ui.painter().hline(first.x_range(), y, stroke);
    show_dragged_card(ui, seen, stack, dragged.0, at);
    // Near the edge, the list scrolls.
    let clip = ui.clip_rect();
    let beyond = (clip.top() + CARD_SCROLL_EDGE_POINTS - at.y).max(0.0)
        - (at.y - clip.bottom() + CARD_SCROLL_EDGE_POINTS).max(0.0);
    if beyond != 0.0 {
        ui.scroll_with_delta(vec2(
            0.0,
            beyond.clamp(-CARD_SCROLL_EDGE_POINTS, CARD_SCROLL_EDGE_POINTS) * 0.4,
        ));
        ui.ctx().request_repaint();
    }
    if ui.input(|input| input.pointer.any_released()) {
        DragAndDrop::take_payload::<DraggedCard>(ui.ctx());
        did.push(CardStackAction::Move(dragged.0, to));
    }
}
