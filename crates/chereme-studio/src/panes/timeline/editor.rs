//! The field for values, with a list of matching values, below the annotation.

use std::collections::BTreeSet;

use chereme_corpus::{TierContents, requests};
use chereme_sign::ComponentInventory;
use eframe::egui::{
    Align2, Area, Id, Key, Modifiers, Order, Rect, Response, Role, Ui, Vec2, WidgetInfo, pos2, text::CCursor,
    text::CCursorRange, vec2,
};
use serde::{Deserialize, Serialize};

use super::timeline_edit::{self, TimelineScene};
use super::value_list::{self, OfferedValues};
use super::{TimelinePane, select};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::panes::stage;
use crate::pickers::{self, ValuePicker};
use crate::script::script_edit as edit_text;
use crate::words::{InterfaceText, fill_text_braces, timeline as words};

const VALUE_FIELD_WIDTH_POINTS: f32 = 260.0;
/// The height of the field with its list, in points.
const VALUE_FIELD_HEIGHT_POINTS: f32 = 260.0;

/// The target of a typed value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum EditTarget {
    /// Existing annotations.
    Of(BTreeSet<i64>),
    /// A new annotation, stored when the value is kept.
    New {
        /// The tier's row id.
        tier: i64,
        /// Its start in microseconds.
        start: i64,
        /// Its end in microseconds.
        end: i64,
    },
}

/// A value that is being typed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ValueEditing {
    /// The recording's row id.
    pub(crate) recording: i64,
    pub(crate) target: EditTarget,
    pub(crate) text: String,
    /// The text when the field was opened.
    #[serde(default)]
    pub(super) before: String,
    /// The value that arrow keys moved to.
    #[serde(skip)]
    pub(super) marked: Option<usize>,
    /// Whether the field has had the keyboard focus.
    #[serde(skip)]
    begun: bool,
    /// Whether the text was restored, so that the first typed letter does not replace it.
    #[serde(skip)]
    again: bool,
    /// Whether values are shown as pictures.
    #[serde(skip)]
    pictures: bool,
    /// Whether the pictures have been shown yet.
    #[serde(skip)]
    pictured: bool,
    /// Whether another pane has the keyboard until the field is clicked.
    #[serde(skip)]
    aside: bool,
}

impl ValueEditing {
    pub(super) fn new(recording: i64, target: EditTarget, text: String) -> Self {
        Self {
            recording,
            target,
            before: text.clone(),
            text,
            marked: None,
            begun: false,
            again: false,
            pictures: false,
            pictured: false,
            aside: false,
        }
    }

    /// Switches between pictures and text.
    pub(super) fn turn_to_pictures(&mut self) {
        (self.pictures, self.pictured, self.begun) = (!self.pictures, false, false);
    }

    /// Returns the same value for a field that opens again with the restored text.
    pub(super) fn reopened_editing(self) -> Self {
        Self {
            begun: false,
            again: true,
            ..self
        }
    }

    /// Returns the tier of the annotations.
    pub(super) fn editing_tier<'a>(&self, scene: &TimelineScene<'a>) -> Option<&'a TierContents> {
        match &self.target {
            EditTarget::New { tier, .. } => scene.tier_of(*tier),
            EditTarget::Of(annotations) => {
                let first = annotations.first()?;
                Some(scene.seen.snapshot.find_open_annotation(*first)?.tier)
            }
        }
    }

    /// Returns the span of the first annotation in microseconds.
    pub(super) fn editing_span_micros(&self, scene: &TimelineScene<'_>) -> Option<(i64, i64)> {
        match &self.target {
            EditTarget::New { start, end, .. } => Some((*start, *end)),
            EditTarget::Of(annotations) => {
                let it = scene.seen.snapshot.find_open_annotation(*annotations.first()?)?;
                let columns = &it.tier.annotations;
                Some((columns.starts[it.at], columns.ends[it.at]))
            }
        }
    }
}

/// The key pressed in the field.
enum FieldKey {
    Nothing,
    /// Keep this value; and whether to go on to the next annotation.
    Keep(String, bool),
    Drop,
}

/// Shows the field below `below`, and carries out its keys.
pub(super) fn show_value_field(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>, below: Rect) {
    let Some(mut editing) = timeline.entry.take_open_editing() else {
        timeline.entry.left = false;
        return;
    };
    // Another recording was opened while the value was typed: the value belongs to the former one.
    if editing.recording != scene.contents.recording.id {
        let text = editing.text.trim().to_owned();
        timeline_edit::store_typed_value(timeline, editing, &text, scene.seen.out);
        return;
    }
    // A restored draft may belong to an annotation that changed meanwhile.
    if editing.again && !editing.begun {
        match find_place(editing, scene) {
            Some(found) => editing = found,
            None => return,
        }
    }
    let Some(tier) = editing.editing_tier(scene) else {
        editing.again = true;
        find_place(editing, scene);
        return;
    };
    let choices = scene.scene_tier_values(tier);
    // The keyboard left the field: a valid value is stored, another waits in it.
    if std::mem::take(&mut timeline.entry.left) {
        if let Some(value) = choices.value_to_store(&editing.text, editing.marked) {
            return carry_out_field_key(timeline, editing, tier, FieldKey::Keep(value, false), scene.seen.out);
        }
        editing.aside = true;
    }
    let digits = timeline
        .entry
        .digits
        .digit_values_of_tier(tier.row.id, &choices)
        .to_vec();
    let stored = scene.scene_tier_inventory(tier);
    let offered = OfferedValues {
        stored,
        choices: &choices,
        digits: &digits,
    };
    let pictured = stored.filter(|stored| editing.pictures && timeline_edit::has_pictures(&stored.inventory));
    if let Some(stored) = pictured {
        let asked = show_value_pictures(timeline, ui, scene, &mut editing, &stored.inventory, offered, below);
        timeline.entry.picker.inspect_requested_value(scene.seen);
        return carry_out_field_key(timeline, editing, tier, asked, scene.seen.out);
    }
    let asked = draw_value_field(ui, scene, &mut editing, tier, offered, below);
    carry_out_field_key(timeline, editing, tier, asked, scene.seen.out);
}

/// Carries out a key of the field.
fn carry_out_field_key(
    timeline: &mut TimelinePane,
    editing: ValueEditing,
    tier: &TierContents,
    asked: FieldKey,
    out: &CommandOutbox,
) {
    match asked {
        FieldKey::Nothing => timeline.entry.editing = Some(editing),
        FieldKey::Drop => {}
        FieldKey::Keep(value, on) => {
            let next = if on { next(&editing, tier) } else { None };
            let same = matches!(&editing.target, EditTarget::Of(all) if all.len() == 1);
            if !same || value != editing.before {
                timeline_edit::store_typed_value(timeline, editing, &value, out);
            }
            if let Some(at) = next {
                select::select_tier_annotation(tier, at, out);
                timeline.asked.to_select.clear();
                timeline.edit_at(tier, at);
            }
        }
    }
}

/// Returns the index of the annotation after the edited one.
fn next(editing: &ValueEditing, tier: &TierContents) -> Option<usize> {
    let columns = &tier.annotations;
    let next = match &editing.target {
        // A new annotation is not in the columns yet, so that its place is found by its end.
        EditTarget::New { end, .. } => columns.starts.partition_point(|start| start < end),
        EditTarget::Of(all) => {
            let last = columns.ids.iter().rposition(|id| all.contains(id))?;
            last + 1
        }
    };
    (next < columns.len()).then_some(next)
}

fn draw_value_field(
    ui: &mut Ui,
    scene: &TimelineScene<'_>,
    editing: &mut ValueEditing,
    tier: &TierContents,
    offered: OfferedValues<'_>,
    below: Rect,
) -> FieldKey {
    let OfferedValues {
        stored,
        choices,
        digits,
    } = offered;
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let (enter, tab, escape) = (pressed(Key::Enter), pressed(Key::Tab), pressed(Key::Escape));
    // ELAN keeps a value with Ctrl and Enter.
    let enter = enter | ui.input_mut(|input| input.consume_key(Modifiers::COMMAND, Key::Enter));
    // The original text does not filter: the whole list can be chosen from.
    let filter = if editing.text == editing.before && !editing.again {
        ""
    } else {
        &editing.text
    };
    let fitting = choices.matching_value_indices(filter);
    value_list::step_value_mark(editing, &fitting, up, down);
    let mut asked = FieldKey::Nothing;
    let mut turn = false;
    let opened = editing.begun;
    let pictured = stored.is_some_and(|stored| timeline_edit::has_pictures(&stored.inventory));
    let height = value_list::value_list_height(ui, fitting.len(), pictured);
    let (area, width) = area(ui, below, vec2(VALUE_FIELD_WIDTH_POINTS, height));
    let shown = area.show(ui.ctx(), |ui| {
        eframe::egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_width(width);
            let before = editing.text.clone();
            let label = fill_text_braces(scene.seen.say_text(words::VALUE_ON), &[("tier", &tier.row.name)]);
            text_field(ui, editing, &label);
            if pictured {
                turn = show_pictures_switch(ui, scene, words::BY_PICTURE);
            }
            let typed = editing.text.strip_prefix(before.as_str()).unwrap_or_default();
            if let Some(value) = value_list::value_of_typed_digit(&before, typed, choices, digits) {
                asked = FieldKey::Keep(value.to_owned(), false);
            }
            if editing.text != before {
                editing.marked = None;
            }
            if let Some(value) = value_list::show_matching_values(ui, scene, editing, &fitting, offered, up || down) {
                asked = FieldKey::Keep(value, false);
            }
        });
    });
    if turn {
        editing.turn_to_pictures();
        return FieldKey::Nothing;
    }
    if escape {
        return FieldKey::Drop;
    }
    // Only after the first frame: the press that opened the field is still in the input.
    if enter || tab || opened && is_pressed_elsewhere(ui, shown.response.rect) {
        return match choices.value_to_store(&editing.text, editing.marked) {
            Some(value) => FieldKey::Keep(value, tab),
            None => FieldKey::Nothing,
        };
    }
    asked
}

/// Shows the values as pictures in place of the field.
fn show_value_pictures(
    timeline: &mut TimelinePane,
    ui: &mut Ui,
    scene: &TimelineScene<'_>,
    editing: &mut ValueEditing,
    inventory: &ComponentInventory,
    offered: OfferedValues<'_>,
    below: Rect,
) -> FieldKey {
    if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return FieldKey::Drop;
    }
    let opened = std::mem::replace(&mut editing.pictured, true);
    if !opened {
        // A digit picks the same value among the pictures as in the list.
        timeline.entry.picker = ValuePicker::new_focused_picker();
        timeline.entry.picker.digits = offered.digits.to_vec();
    }
    let screen = ui.ctx().content_rect();
    let full_width =
        pickers::pickers_data::picker_width_points(pickers::pickers_data::inventory_picker_form(inventory));
    let width = full_width.min(screen.width() - 48.0);
    let mut asked = FieldKey::Nothing;
    let mut back = false;
    let height = pickers::pickers_data::picker_height_points(pickers::pickers_data::inventory_picker_form(inventory));
    let free = stage::visible_stage_rect(ui.ctx()).and_then(|stage_rect| free_side_column(stage_rect, screen, below));
    let (area, size) = match free {
        Some(free) => in_column(free, vec2(width, height)),
        None => {
            let (area, width) = area(ui, below, vec2(width, f32::INFINITY));
            (area, vec2(width, (screen.height() - 80.0).min(460.0)))
        }
    };
    let shown = area.show(ui.ctx(), |ui| {
        eframe::egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_width(size.x);
            ui.set_max_height(size.y);
            back = show_pictures_switch(ui, scene, words::BY_TEXT);
            let chosen = inventory
                .find_inventory_value(&editing.text)
                .map(|value| value.id.as_str());
            let picked = pickers::show_inventory_picker(ui, &mut timeline.entry.picker, scene.seen, inventory, chosen);
            if let Some(value) = picked {
                asked = FieldKey::Keep(value, false);
            }
        });
    });
    if back {
        editing.turn_to_pictures();
    }
    if matches!(asked, FieldKey::Nothing) && opened && is_pressed_elsewhere(ui, shown.response.rect) {
        return match offered.choices.value_to_store(&editing.text, None) {
            Some(value) => FieldKey::Keep(value, false),
            None => FieldKey::Nothing,
        };
    }
    asked
}

/// Returns the area for the field: below the annotation, or above it if there is more room.
///
/// An area above that would reach into the stage is moved aside from the stage's middle, so that the signer stays in
/// sight.
fn area(ui: &Ui, below: Rect, size: Vec2) -> (Area, f32) {
    let width = size.x;
    let screen = ui.ctx().content_rect();
    let (under, over) = (screen.bottom() - below.bottom(), below.top() - screen.top());
    // Above only if there is little room below and more of it above.
    let (corner, at, width) = if under < VALUE_FIELD_HEIGHT_POINTS && over > under {
        let corner = below.left_top() - vec2(0.0, 2.0);
        let reached = |rect: &Rect| rect.top() < corner.y && rect.bottom() > corner.y - size.y;
        let stage = stage::visible_stage_rect(ui.ctx()).filter(reached);
        let (left, width) = stage.map_or((corner.x, width), |stage_rect| {
            place_beside_stage(corner.x, width, stage_rect, screen)
        });
        (Align2::LEFT_BOTTOM, pos2(left, corner.y), width)
    } else {
        let corner = below.left_bottom() + vec2(0.0, 2.0);
        (Align2::LEFT_TOP, corner, width)
    };
    let area = Area::new(Id::unique("timeline value").with(corner.0))
        .order(Order::Foreground)
        .pivot(corner)
        .fixed_pos(at)
        .constrain_to(screen);
    (area, width)
}

/// The space between the edge of a column beside the stage and the contents of an area in it, in points.
const SIDE_COLUMN_EDGE_POINTS: f32 = 18.0;

/// Returns the free part of the screen left or right of the stage, whichever is wider: below the menus, and above the
/// line of the annotation with the name of its tier, if that leaves enough. `None` if it is too small for pictures.
fn free_side_column(stage: Rect, screen: Rect, annotation: Rect) -> Option<Rect> {
    /// The height of the menus, and the least useful size, in points.
    const MENU_HEIGHT_POINTS: f32 = 30.0;
    const MIN_SIDE_COLUMN_POINTS: Vec2 = vec2(290.0, 340.0);
    let left = screen.left()..=stage.left();
    let right = stage.right()..=screen.right();
    let across = if left.end() - left.start() >= right.end() - right.start() {
        left
    } else {
        right
    };
    let column_rect = Rect::from_x_y_ranges(across, screen.top() + MENU_HEIGHT_POINTS..=screen.bottom());
    let above = column_rect.with_max_y(annotation.top());
    let aside = annotation.x_range().intersection(column_rect.x_range()).span() <= 0.0;
    let fits = |rect: &Rect| rect.width() >= MIN_SIDE_COLUMN_POINTS.x && rect.height() >= MIN_SIDE_COLUMN_POINTS.y;
    // If the annotation is not in the column, the column may reach down to the window's edge.
    let free = Some(above).filter(fits).or(aside.then_some(column_rect));
    free.filter(fits)
}

/// Returns an area at the lower end of a column, as near to the timeline as possible, and the size of its
/// contents, which are higher in a narrower column.
fn in_column(free: Rect, wanted: Vec2) -> (Area, Vec2) {
    let most = free.size() - vec2(SIDE_COLUMN_EDGE_POINTS, SIDE_COLUMN_EDGE_POINTS);
    let width = wanted.x.min(most.x);
    // Pictures in a narrower column need more rows.
    let size = vec2(width, (wanted.y * wanted.x / width).min(most.y));
    let area = Area::new(Id::unique("timeline value").with("column"))
        .order(Order::Foreground)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(free.left_bottom() + vec2(2.0, -2.0))
        .constrain_to(free);
    (area, size)
}

/// Returns the left edge and the width of an area that does not cover the middle of the stage, where the signer is;
/// without room for that, returns `left` and `width` unchanged.
fn place_beside_stage(left: f32, width: f32, stage: Rect, screen: Rect) -> (f32, f32) {
    /// The least useful width, in points.
    const MIN_WIDTH_BESIDE_POINTS: f32 = 260.0;
    // The signer takes the middle half of the stage, less in a low or wide one.
    let half = (stage.width() * 0.5).min(stage.height() * 0.55).min(150.0);
    let (from, to) = (stage.center().x - half, stage.center().x + half);
    if left + width + SIDE_COLUMN_EDGE_POINTS <= from || left >= to {
        return (left, width);
    }
    let (before, after) = (
        from - screen.left() - SIDE_COLUMN_EDGE_POINTS,
        screen.right() - to - SIDE_COLUMN_EDGE_POINTS,
    );
    let before_it = || {
        let width = width.min(before);
        (from - width - SIDE_COLUMN_EDGE_POINTS, width)
    };
    // With room on both sides, the shorter way aside.
    match (before >= width, after >= width) {
        (true, true) if to - left < left + width - from => (to, width),
        (true, _) => before_it(),
        (false, true) => (to, width),
        _ if before.max(after) < MIN_WIDTH_BESIDE_POINTS => (left, width),
        _ if before >= after => before_it(),
        _ => (to, after),
    }
}

/// Returns whether the mouse was pressed outside of `rect`. Callers ignore the field's first frame, since the tap that
/// opened the field may end within it.
fn is_pressed_elsewhere(ui: &Ui, rect: Rect) -> bool {
    ui.input(|input| {
        let press_position = input.pointer.interact_pos();
        input.pointer.any_pressed() && press_position.is_some_and(|at| !rect.contains(at))
    })
}

/// Shows the button that switches between pictures and text.
fn show_pictures_switch(ui: &mut Ui, scene: &TimelineScene<'_>, text: InterfaceText) -> bool {
    let button = ui.small_button(scene.seen.say_text(text));
    let keys = scene.seen.keys.action_keys_text(Action::PictureValue);
    button.on_hover_text(keys).clicked()
}

fn text_field(ui: &mut Ui, editing: &mut ValueEditing, label: &str) -> Response {
    let id = Id::unique("timeline value field");
    // The field requests the focus before it is shown, so that it receives the text typed in this frame.
    if !editing.aside {
        ui.memory_mut(|memory| memory.request_focus(id));
    }
    let mut output = edit_text::draw_text_line(ui, &mut editing.text, |field| {
        field.id(id).desired_width(f32::INFINITY).lock_focus(true)
    });
    let response = output.response.response.clone();
    editing.aside &= !response.has_focus();
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::TextInput, true, label);
        info.current_text_value = Some(editing.text.clone());
        info
    });
    if !std::mem::replace(&mut editing.begun, true) {
        let end = CCursor::new(editing.text.chars().count());
        // Text that was in the field is selected, so that typing replaces it; restored text is not.
        let start = if editing.again { end } else { CCursor::new(0) };
        let range = CCursorRange::two(start, end);
        output.state.cursor.set_char_range(Some(range));
        output.state.store(ui.ctx(), response.id);
    }
    response
}

/// Finds a place for typed text whose target was removed or stored meanwhile: the stored annotation, or a notice if
/// there is no place for it. Returns `None` for text that was stored as typed.
fn find_place(editing: ValueEditing, scene: &TimelineScene<'_>) -> Option<ValueEditing> {
    if let EditTarget::New { tier, start, end } = editing.target
        && let Some(columns) = scene.tier_of(tier).map(|tier| &tier.annotations)
    {
        let index = columns.starts.partition_point(|other_start| *other_start < start);
        // The columns are in order, so that an annotation at this time can only be here.
        let there = index < columns.len() && (columns.starts[index], columns.ends[index]) == (start, end);
        if !there {
            return Some(editing);
        }
        let before = requests::typed_annotation_value(columns, index);
        let target = EditTarget::Of(BTreeSet::from([columns.ids[index]]));
        return (before != editing.text).then_some(ValueEditing {
            target,
            before,
            ..editing
        });
    }
    if let EditTarget::Of(all) = &editing.target {
        let mut found_annotations = all
            .iter()
            .filter_map(|id| scene.seen.snapshot.find_open_annotation(*id));
        if let Some(it) = found_annotations.next() {
            // A value that was stored as typed needs no field; several annotations may differ, so that theirs stays.
            let stored = requests::typed_annotation_value(&it.tier.annotations, it.at) == editing.text;
            return (!stored || all.len() > 1).then_some(editing);
        }
    }
    if !editing.text.trim().is_empty() {
        let text = fill_text_braces(scene.seen.say_text(words::DRAFT_LOST), &[("text", &editing.text)]);
        scene
            .seen
            .send_command(WindowCommand::Notify(text, words::DRAFT_LOST_REMEDY));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn editing() -> ValueEditing {
        ValueEditing::new(1, EditTarget::Of(BTreeSet::from([1])), "A".into())
    }

    #[test]
    fn arrow_keys_move_through_the_candidates_and_back_to_the_text() {
        let mut it = editing();
        let fitting = [4, 2, 7];
        for (up, down, want) in [
            (false, true, Some(4)),
            (false, true, Some(2)),
            (false, true, Some(7)),
            (false, true, Some(7)),
            (true, false, Some(2)),
            (true, false, Some(4)),
            (true, false, None),
        ] {
            value_list::step_value_mark(&mut it, &fitting, up, down);
            assert_eq!(it.marked, want);
        }
        it.marked = Some(9);
        value_list::step_value_mark(&mut it, &fitting, false, false);
        assert_eq!(it.marked, None);
    }

    #[test]
    fn a_draft_reads_back_unchanged() {
        let mut it = editing();
        it.text = "école".into();
        let text = serde_json::to_string(&it).expect("written");
        let read: ValueEditing = serde_json::from_str(&text).expect("read");
        assert_eq!(read, it);
    }

    #[test]
    fn an_opened_editor_leaves_the_signer_visible() {
        let screen = Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 800.0));
        let stage = Rect::from_min_max(pos2(340.0, 60.0), pos2(1000.0, 390.0));
        let clear = |(left, width): (f32, f32)| left + width <= 520.0 || left >= 820.0;
        for left in [100.0, 300.0, 412.0, 600.0, 700.0, 900.0] {
            for width in [260.0, 574.0] {
                let (at, wide) = place_beside_stage(left, width, stage, screen);
                assert!(clear((at, wide)) && wide >= 260.0 && at >= 0.0, "{left} {width}");
                assert!(at + wide <= 1280.0 || at == left);
            }
        }
        let small = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        assert_eq!(place_beside_stage(50.0, 260.0, small, small), (50.0, 260.0));
    }

    #[test]
    fn pictures_of_values_cover_neither_the_stage_nor_the_annotation() {
        for (size, stage) in [
            (vec2(1280.0, 800.0), [340.0, 60.0, 1000.0, 390.0]),
            (vec2(1280.0, 800.0), [676.0, 60.0, 1272.0, 390.0]),
            (vec2(1920.0, 1080.0), [500.0, 60.0, 1500.0, 560.0]),
        ] {
            let screen = Rect::from_min_size(pos2(0.0, 0.0), size);
            let [left, top, right, bottom] = stage;
            let stage = Rect::from_min_max(pos2(left, top), pos2(right, bottom));
            for left in [210.0, 600.0, 1100.0] {
                let lane = size.y - 130.0;
                let below = Rect::from_min_max(pos2(left, lane), pos2(left + 60.0, lane + 22.0));
                let free = free_side_column(stage, screen, below).expect("room");
                assert!(!free.intersects(stage.shrink(1.0)) && !free.intersects(below.shrink(1.0)));
                assert!(screen.contains_rect(free) && free.width() > 300.0);
                let (_, inside) = in_column(free, vec2(780.0, 560.0));
                assert!(
                    inside.x <= free.width() - SIDE_COLUMN_EDGE_POINTS
                        && inside.y <= free.height() - SIDE_COLUMN_EDGE_POINTS
                );
            }
        }
        let small = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        assert_eq!(free_side_column(small, small, small), None);
    }
}
