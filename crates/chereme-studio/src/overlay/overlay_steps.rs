//! The first steps: five short loops, with a sentence for each.

use std::sync::Arc;

use chereme_motion::{BodySide, HandAngles};
use eframe::egui::{
    Align2, Context, FontId, Id, Label, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, Vec2, Window, pos2,
    vec2,
};

use crate::action::Action;
use crate::keys::ActionKeys;
use crate::miniatures::{self, MiniatureFigures, MiniatureFocus};
use crate::model::generated::GeneratedClip;
use crate::start_wall;
use crate::theme::{self, ThemeColours};
use crate::words::{InterfaceLanguage, InterfaceText, steps_words as words};

/// The loop of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum StepLoop {
    /// A sign plays.
    Sign,
    /// A sign plays, and an annotation grows below it.
    Annotation,
    /// A hand takes one shape after the other.
    Hand,
    /// A sign, and the same sign with the other hand.
    Two,
    /// A sign plays forwards and back.
    Back,
}

/// For each step its subject, the instructions with action ids between braces in place of keys, and its loop.
const FIRST_STEP_ENTRIES: [(InterfaceText, InterfaceText, StepLoop); 5] = [
    (words::LOOK, words::LOOK_HOW, StepLoop::Sign),
    (words::ANNOTATE, words::ANNOTATE_HOW, StepLoop::Annotation),
    (words::SEARCH, words::SEARCH_HOW, StepLoop::Hand),
    (words::MAKE, words::MAKE_HOW, StepLoop::Two),
    (words::BACK, words::BACK_HOW, StepLoop::Back),
];

/// The side of a loop in points, and its duration in seconds.
const STEP_LOOP_SIDE: f32 = 104.0;
const STEP_LOOP_SECONDS: f64 = 4.0;
/// The height of the last sentence in points.
const LAST_SENTENCE_HEIGHT: f32 = 48.0;

/// The window with the first steps; it stays open beside the work.
#[derive(Debug, Default)]
pub(crate) struct FirstSteps {
    open: bool,
}

impl FirstSteps {
    pub(crate) fn toggle_first_steps(&mut self) {
        self.open = !self.open;
    }

    pub(crate) fn ui(
        &mut self,
        ctx: &Context,
        keys: &ActionKeys,
        little: &MiniatureFigures,
        language: InterfaceLanguage,
    ) {
        if !self.open {
            return;
        }
        let room = ctx.content_rect().size();
        let width = 400.0_f32.min(room.x - 40.0);
        let mut open = true;
        Window::new(Action::FirstSteps.action_row().name.text_in_language(language))
            .id(Id::unique("first steps"))
            .open(&mut open)
            .pivot(Align2::RIGHT_TOP)
            .default_pos(ctx.content_rect().right_top() + eframe::egui::vec2(-12.0, 40.0))
            .default_width(width)
            .resizable(false)
            .show(ctx, |ui| {
                ui.set_width(width);
                let high = (room.y - 140.0).max(120.0);
                let area = ScrollArea::vertical().max_height(high);
                area.min_scrolled_height(high.min(5.0 * (STEP_LOOP_SIDE + 12.0) + LAST_SENTENCE_HEIGHT))
                    .show(ui, |ui| {
                        // The bar that scrolls covers no text.
                        ui.set_max_width(width - 10.0);
                        let signs = start_wall::loaded_starter_signs(ui.ctx());
                        for (at, (what, how, film)) in FIRST_STEP_ENTRIES.into_iter().enumerate() {
                            ui.horizontal_top(|ui| {
                                let (rect, _) = ui.allocate_exact_size(Vec2::splat(STEP_LOOP_SIDE), Sense::hover());
                                let sign = signs.get(at % signs.len().max(1));
                                film.paint_step_loop(ui, little, language, sign, rect);
                                ui.vertical(|ui| {
                                    let title = format!("{}. {}", at + 1, what.text_in_language(language));
                                    ui.label(RichText::new(title).strong());
                                    ui.add(Label::new(keys.name_keys_in_text(how.text_in_language(language))).wrap());
                                });
                            });
                            ui.add_space(4.0);
                        }
                        ui.add(Label::new(keys.name_keys_in_text(words::MORE.text_in_language(language))).wrap());
                    });
            });
        self.open = open && !super::take_escape_key(ctx);
    }
}

impl StepLoop {
    /// Paints the loop at the present time.
    fn paint_step_loop(
        self,
        ui: &Ui,
        little: &MiniatureFigures,
        language: InterfaceLanguage,
        sign: Option<&Arc<GeneratedClip>>,
        rect: Rect,
    ) {
        let colours = ThemeColours::colours_for_theme(theme::is_dark(ui.ctx()));
        let clock = miniatures::figure_loop_clock(ui);
        let share = (clock / STEP_LOOP_SECONDS).rem_euclid(1.0) as f32;
        let painter = ui.painter().with_clip_rect(rect);
        painter.rect_filled(rect, 6.0, ui.visuals().extreme_bg_color);
        let film = |rect: Rect, clock: f64, focus: MiniatureFocus| {
            if let Some(sign) = sign {
                little.paint_made(ui, language, sign, clock, rect, focus);
            }
        };
        match self {
            Self::Sign => film(rect, clock, MiniatureFocus::Signing),
            Self::Annotation => {
                let foot = rect.with_min_y(rect.bottom() - 24.0);
                film(rect.with_max_y(foot.top()), clock, MiniatureFocus::Signing);
                let grown = (share * 1.6).min(1.0);
                let left = foot.left() + foot.width() * 0.15;
                let size = vec2(foot.width() * 0.7 * grown, 15.0);
                let bar = Rect::from_min_size(pos2(left, foot.top() + 4.0), size);
                painter.rect_filled(bar, 3.0, colours.gloss);
                if grown >= 1.0 {
                    let name = sign.map_or("", |sign| sign.name.as_str());
                    let letters = ((share - 0.62).max(0.0) * 30.0) as usize;
                    let typed: String = name.chars().take(letters).collect();
                    let font = FontId::proportional(11.0);
                    let text_position = bar.left_center() + vec2(4.0, 0.0);
                    painter.text(text_position, Align2::LEFT_CENTER, typed, font, colours.on_annotation);
                }
                let now = foot.left() + foot.width() * (0.15 + 0.7 * grown);
                painter.vline(now, foot.y_range(), Stroke::new(1.5, colours.playhead));
            }
            Self::Hand => {
                let shape = (share * 3.0) as usize;
                little.paint_hand(ui, language, BodySide::Right, &hand_with_straight_fingers(shape), rect);
            }
            Self::Two => {
                let right = MiniatureFocus::Hand(BodySide::Right);
                let changed = share >= 0.5;
                film(rect, clock, if changed { right } else { MiniatureFocus::Signing });
            }
            Self::Back => {
                let to_and_fro = if share < 0.5 { share } else { 1.0 - share };
                film(rect, f64::from(to_and_fro) * STEP_LOOP_SECONDS, MiniatureFocus::Signing);
                let from = rect.center_top() + vec2(if share < 0.5 { -14.0 } else { 14.0 }, 12.0);
                let vector = vec2(if share < 0.5 { 28.0 } else { -28.0 }, 0.0);
                painter.arrow(from, vector, Stroke::new(2.0, colours.accent));
            }
        }
        let edge = Stroke::new(1.0, colours.rule);
        ui.painter().rect_stroke(rect, 6.0, edge, StrokeKind::Inside);
    }
}

/// Returns a hand with the given number of straight fingers, beginning with the index finger.
fn hand_with_straight_fingers(straight: usize) -> HandAngles {
    let mut angles = HandAngles::default();
    for finger in angles.fingers.iter_mut().skip(straight + 1) {
        finger.flexion = [1.5; 3];
    }
    angles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key_chord::{DefaultKeymap, ReboundKeys};

    #[test]
    fn every_key_named_in_a_step_belongs_to_an_action() {
        for (keymap, _) in DefaultKeymap::ALL_KEYMAPS {
            let keys = ActionKeys::new(keymap, &ReboundKeys::default(), InterfaceLanguage::English);
            let all = FIRST_STEP_ENTRIES.map(|it| it.1).into_iter().chain([words::MORE]);
            for how in all {
                for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
                    let text = keys.name_keys_in_text(how.text_in_language(language));
                    assert!(!text.contains(['{', '}']), "{text}");
                    let bare = text
                        .split_whitespace()
                        .any(|word| crate::action::ACTIONS.iter().any(|row| word.starts_with(row.id)));
                    assert!(!bare, "an action without a key: {text}");
                }
            }
        }
    }

    #[test]
    fn the_hand_picture_differs_from_step_to_step() {
        assert_ne!(hand_with_straight_fingers(0), hand_with_straight_fingers(1));
        assert_ne!(hand_with_straight_fingers(1), hand_with_straight_fingers(2));
    }
}
