//! A line of text with completion: typed letters narrow a list, arrows choose, Enter takes the chosen candidate.

use crate::script::script_edit;
use chereme_sign::text::fold_text;
use eframe::egui::{
    Button, Id, Key, Modifiers, Popup, PopupCloseBehavior, Rect, Response, RichText, Role, ScrollArea, TextEdit, Ui,
    WidgetInfo, text::CCursor, text::CCursorRange, vec2,
};

/// How many candidates are offered at once.
pub(crate) const MAX_OFFERED_CANDIDATES: usize = 40;

/// The least width of a list that shows remarks, in points.
const WIDTH_WITH_REMARKS: f32 = 320.0;

/// The remark on a candidate, if it has one.
type CandidateRemark<'a> = dyn Fn(&str) -> Option<String> + 'a;

/// Settings of a line of text with completion.
#[derive(Clone, Copy)]
pub(crate) struct CompletionLine<'a> {
    /// Accessible name; empty if a label beside the line names it.
    pub(crate) name: &'a str,
    pub(crate) hint: &'a str,
    pub(crate) width: f32,
    /// Whether Enter takes the only candidate if it begins with the typed text.
    pub(crate) takes_only: bool,
    /// The remark on each candidate.
    pub(crate) about: Option<&'a CandidateRemark<'a>>,
}

impl Default for CompletionLine<'_> {
    fn default() -> Self {
        Self {
            name: "",
            hint: "",
            width: f32::INFINITY,
            takes_only: true,
            about: None,
        }
    }
}

/// The outcome of the line in this frame.
pub(crate) struct CompletionOutcome {
    pub(crate) response: Response,
    /// Whether the text has changed.
    pub(crate) changed: bool,
    /// Whether a candidate was taken, or Enter pressed.
    pub(crate) entered: bool,
}

/// The state of a list of candidates between frames.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct CandidateListState {
    /// The candidate that Enter takes.
    chosen: Option<usize>,
    /// Whether Escape closed the list.
    away: bool,
    /// The rectangle of the list in the last frame.
    rect: Option<Rect>,
}

/// Returns the entries of `all` that begin with `typed`, then those that contain it, ignoring case and accents.
pub(crate) fn fitting_candidates<'a>(all: impl Iterator<Item = &'a str>, typed: &str) -> Vec<String> {
    let wanted = fold_text(typed.trim());
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for text in all {
        let folded = fold_text(text);
        if folded.starts_with(&wanted) {
            first.push(text.to_owned());
        } else if second.len() < MAX_OFFERED_CANDIDATES && folded.contains(&wanted) {
            second.push(text.to_owned());
        }
        if first.len() >= MAX_OFFERED_CANDIDATES {
            break;
        }
    }
    first.extend(second);
    first.truncate(MAX_OFFERED_CANDIDATES);
    first
}

/// Returns whether there is exactly one candidate, and it begins with the typed text.
fn is_only(offered: &[String], typed: &str) -> bool {
    let typed = fold_text(typed.trim());
    match offered {
        [one] => !typed.is_empty() && fold_text(one).starts_with(&typed),
        _ => false,
    }
}

/// Shows the line; `candidates` is only called while the line has the focus.
pub(crate) fn show_completion_line(
    ui: &mut Ui,
    id: Id,
    line: CompletionLine<'_>,
    text: &mut String,
    candidates: &dyn Fn(&str) -> Vec<String>,
) -> CompletionOutcome {
    let focused = ui.memory(|memory| memory.has_focus(id));
    let mut listed: CandidateListState = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let before = listed;
    let pointed = ui.input(|input| input.pointer.interact_pos());
    // A press on the list takes the focus from the line, and must still find the list.
    let is_pressed = listed.rect.zip(pointed).is_some_and(|(rect, at)| rect.contains(at));
    let mut offered = Vec::new();
    if focused || is_pressed {
        offered = candidates(text);
        offered.retain(|offer| offer != text);
    }
    let open = !offered.is_empty() && (!listed.away || is_pressed);
    let mut taken = None;
    if focused && open {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::ArrowDown) {
            let next = listed.chosen.map_or(0, |at| at + 1);
            listed.chosen = Some(next.min(offered.len() - 1));
        }
        if pressed(Key::ArrowUp) {
            listed.chosen = listed.chosen.and_then(|at| at.checked_sub(1));
        }
        if pressed(Key::Escape) {
            listed.away = true;
        }
        let only = line.takes_only && is_only(&offered, text);
        let enter = listed.chosen.or(only.then_some(0));
        // Without a choice Enter is left to the line, which ends the entry.
        if enter.is_some() && pressed(Key::Enter) {
            taken = enter.and_then(|at| offered.get(at)).cloned();
        }
    }
    let shown = script_edit::draw_text_line(ui, text, |field| {
        field.id(id).hint_text(line.hint).desired_width(line.width)
    });
    let response = shown.response.response;
    if !line.name.is_empty() {
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, line.name));
    }
    let mut changed = response.changed();
    if changed {
        (listed.chosen, listed.away) = (None, false);
    }
    if !focused && !is_pressed {
        listed = CandidateListState::default();
    }
    listed.rect = None;
    if open && taken.is_none() && (response.has_focus() || is_pressed) {
        let least = if line.about.is_some() {
            WIDTH_WITH_REMARKS
        } else {
            180.0
        };
        let width = response.rect.width().max(least);
        let popup = Popup::from_response(&response)
            .id(id.with("list"))
            .open(true)
            .close_behavior(PopupCloseBehavior::IgnoreClicks)
            .gap(2.0)
            .width(width);
        let shown = popup.show(|ui| {
            ui.set_width(width);
            ScrollArea::vertical().max_height(240.0).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                for (at, candidate) in offered.iter().enumerate() {
                    let chosen = listed.chosen == Some(at);
                    let mut button = Button::selectable(chosen, candidate)
                        .truncate()
                        .min_size(vec2(ui.available_width(), 0.0));
                    if let Some(about) = line.about.and_then(|about| about(candidate)) {
                        button = button.right_text(RichText::new(about).small().weak());
                    }
                    let response = ui.add(button);
                    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, candidate));
                    if chosen && listed.chosen != before.chosen {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() {
                        taken = Some(candidate.clone());
                    }
                }
            });
        });
        listed.rect = shown.map(|shown| shown.response.rect);
    }
    let entered_key = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let entered = taken.is_some() || entered_key;
    if let Some(taken) = taken {
        *text = taken;
        changed = true;
        listed = CandidateListState {
            away: true,
            ..CandidateListState::default()
        };
        // Typing goes on behind what was taken.
        to_end(ui, id, text.chars().count());
        response.request_focus();
    }
    if listed != before {
        ui.data_mut(|data| data.insert_temp(id, listed));
    }
    CompletionOutcome {
        response,
        changed,
        entered,
    }
}

/// Puts the cursor of a text field behind its last letter.
fn to_end(ui: &Ui, id: Id, letters: usize) {
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    let end = CCursorRange::one(CCursor::new(letters));
    state.cursor.set_char_range(Some(end));
    TextEdit::store_state(ui.ctx(), id, state);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn enter_takes_the_only_candidate_that_continues_the_typed_text() {
        let mut window = egui_kittest::Harness::new_ui_state(
            |ui, text: &mut String| {
                let all = ["ESCARGOT", "BOL", "BON"];
                let candidates = |typed: &str| fitting_candidates(all.into_iter(), typed);
                let line = CompletionLine {
                    name: "sign",
                    width: 120.0,
                    ..CompletionLine::default()
                };
                show_completion_line(ui, Id::unique("sign"), line, text, &candidates);
            },
            String::new(),
        );
        use egui_kittest::kittest::Queryable;
        for (typed, taken) in [("esc", "ESCARGOT"), ("bo", "bo"), ("argot", "argot")] {
            window.state_mut().clear();
            window.run();
            window.get_by_label("sign").focus();
            window.run();
            window.get_by_label("sign").type_text(typed);
            window.run();
            window.key_press(Key::Enter);
            window.run();
            assert_eq!(window.state(), taken);
        }
    }

    #[test]
    fn candidates_that_begin_with_the_letters_come_before_those_that_contain_them() {
        let all = ["Écureuil", "recul", "CURE", "bol"];
        assert_eq!(fitting_candidates(all.into_iter(), "cu"), ["CURE", "Écureuil", "recul"]);
        assert_eq!(fitting_candidates(all.into_iter(), "écu"), ["Écureuil", "recul"]);
        assert_eq!(fitting_candidates(all.into_iter(), "").len(), 4);
    }
}
