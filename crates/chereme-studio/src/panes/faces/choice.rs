//! The ranked candidates side by side, the reasons for their ranks, and the storing of the sentence with a chosen face.

use std::sync::Arc;

use chereme_corpus::{Choice, ExpressionPhase, Milestones, Ranked};
use eframe::egui::{
    Align2, Button, CollapsingHeader, Grid, Rect, RichText, Role, ScrollArea, Sense, Stroke,
    StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::{Faces, counted, data};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::miniatures::{self, Cell, Focus, Motion};
use crate::words::{Text, faces as words, fill};
use crate::work::recombining;

/// The least width of a figure, and the height of its name below it, in points.
const FIGURE: f32 = 150.0;
const FOOT: f32 = 36.0;
/// How many sentences are animated at the same time.
const AT_ONCE: usize = 2;

impl Faces {
    /// Shows the sentence's own face and the candidates, side by side.
    pub(super) fn candidates(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        choice: &Arc<Choice>,
        out: &mut Outbox,
    ) {
        let moment = data::loop_moment(&choice.milestones, miniatures::clock(ui));
        let sentence = self.sentence_name(choice);
        let own = fill(seen.say(words::OWN), &[("name", &sentence)]);
        let motion = self.recorded(choice.recording_id, &choice.milestones, choice, moment);
        let room = ui.available_width();
        let gap = 6.0;
        let columns = ((room + gap) / (FIGURE + gap)).floor().max(1.0);
        let side = ((room + gap) / columns - gap).min(FIGURE * 1.6);
        let mut picked = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(gap);
            ui.horizontal_wrapped(|ui| {
                self.figure(ui, seen, out, motion, side, (&own, "", false));
                for (n, it) in choice.ranking.iter().enumerate() {
                    let motion = match self.carried {
                        true => self.on_sentence(seen, it, choice, moment, out),
                        false => self.recorded(it.recording_id, &it.milestones, choice, moment),
                    };
                    let values: [(&str, &dyn std::fmt::Display); 2] =
                        [("n", &(n + 1)), ("name", &it.recording)];
                    let name = fill(seen.say(words::CANDIDATE), &values);
                    let score = format!("{:.3}", it.score);
                    let stretch = format!("{:.2}", it.parts.stretch);
                    let values: [(&str, &dyn std::fmt::Display); 2] =
                        [("score", &score), ("stretch", &stretch)];
                    let shown_score = fill(seen.say(words::SCORE), &values);
                    let chosen = self.chosen.as_deref() == Some(&it.token);
                    if self.figure(ui, seen, out, motion, side, (&name, &shown_score, chosen)) {
                        picked = Some(it.clone());
                    }
                }
            });
        });
        if let Some(it) = picked {
            self.choose(&it);
        }
    }

    /// Returns a recorded expression, and the time in it that corresponds to `moment` of the sentence, in seconds.
    fn recorded(
        &self,
        recording: i64,
        own: &Milestones,
        choice: &Choice,
        moment: f64,
    ) -> Option<(Motion, f64)> {
        let into = data::into_span(own, &choice.milestones, moment, self.in_step);
        Some((Motion::Span(recording, data::seen_span(own)), into))
    }

    /// Returns the sentence with the face of a performance, and the time in it; requests the animation if necessary.
    fn on_sentence(
        &mut self,
        seen: &PaneInput<'_>,
        it: &Ranked,
        choice: &Choice,
        moment: f64,
        out: &mut Outbox,
    ) -> Option<(Motion, f64)> {
        if let Some(made) = self.made.get(&it.recipe) {
            let made = made.clone()?;
            // The recipe's milestones are relative to the first frame of the movement.
            let start = data::seen_span(&choice.milestones).start().seconds();
            let lasts = made.clip.span().seconds();
            let into = moment.max(start).min(lasts - 1e-6).max(0.0);
            return Some((Motion::Made(made), into));
        }
        let asked = self.carrying.values().any(|recipe| *recipe == it.recipe);
        let running = |id: &crate::work::WorkId| seen.running.contains_key(id);
        let busy = self.carrying.keys().filter(|id| running(id)).count();
        if !asked && busy < AT_ONCE && self.carrying.len() < AT_ONCE {
            let id = out.work(recombining::preview(it.recipe.clone()));
            self.carrying.insert(id, it.recipe.clone());
        }
        None
    }

    /// Shows one figure with its name below; returns whether it was clicked.
    fn figure(
        &self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        motion: Option<(Motion, f64)>,
        side: f32,
        (name, shown_score, chosen): (&str, &str, bool),
    ) -> bool {
        let (rect, response) = ui.allocate_exact_size(vec2(side, side + FOOT), Sense::click());
        let label = match shown_score.is_empty() {
            true => name.to_owned(),
            false => format!("{name}: {shown_score}"),
        };
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        if !ui.is_rect_visible(rect) {
            return response.clicked();
        }
        let picture = Rect::from_min_size(rect.min, Vec2::splat(side));
        match motion {
            Some((motion, into)) => {
                let focus = match self.wide {
                    true => Focus::Signing,
                    false => Focus::Face,
                };
                let cell = Cell::new(motion, picture.size())
                    .focused(focus)
                    .playing(into);
                seen.little.paint(ui, seen, out, &cell, picture);
            }
            None => {
                let back = ui.visuals().extreme_bg_color;
                ui.painter().rect_filled(picture, 6.0, back);
            }
        }
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let strong = ui.visuals().text_color();
        let weak = ui.visuals().weak_text_color();
        let body = TextStyle::Body.resolve(ui.style());
        let small = TextStyle::Small.resolve(ui.style());
        let left = rect.left() + 4.0;
        let at = |below: f32| pos2(left, picture.bottom() + below);
        painter.text(at(10.0), Align2::LEFT_CENTER, name, body, strong);
        painter.text(at(26.0), Align2::LEFT_CENTER, shown_score, small, weak);
        if chosen || response.hovered() || response.has_focus() {
            let wide = if chosen { 2.0 } else { 1.0 };
            let stroke = Stroke::new(wide, seen.colours().accent);
            ui.painter()
                .rect_stroke(rect, 6.0, stroke, StrokeKind::Inside);
        }
        response.on_hover_text(label).clicked()
    }

    /// Shows how many performances were compared and skipped.
    pub(super) fn show_counts(&self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &Choice) {
        let skipped = choice.skipped.len() as u64;
        let lines = [
            counted(seen, words::COMPARED_COUNT, choice.compared),
            counted(seen, words::ADAPTED, choice.adapted),
            counted(seen, words::SKIPPED, skipped),
            (!choice.left_out.is_empty()).then(|| {
                let names = choice.left_out.join(", ");
                fill(seen.say(words::LEFT_OUT), &[("names", &names)])
            }),
        ];
        let lines: Vec<String> = lines.into_iter().flatten().collect();
        ui.weak(lines.join(" · "));
    }

    /// Shows the table of phases and channels for the chosen performance.
    pub(super) fn reasons(&self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &Choice) {
        let Some(chosen) = self.chosen(choice) else {
            return;
        };
        let title = fill(seen.say(words::WHY), &[("name", &chosen.recording)]);
        let header = CollapsingHeader::new(title)
            .id_salt("why")
            .default_open(true);
        let shown = header.show(ui, |ui| {
            // A table that is wider than the pane scrolls sideways by itself.
            ScrollArea::horizontal().show(ui, |ui| {
                Grid::new("reasons").striped(true).show(ui, |ui| {
                    ui.weak(seen.say(words::PHASE));
                    ui.weak(seen.say(words::COST));
                    for channel in &choice.channels {
                        ui.weak(channel.name);
                    }
                    ui.end_row();
                    for (phase, cells) in data::reasons(&chosen.parts, choice.channels.len()) {
                        ui.label(seen.say(phase_text(phase)));
                        for cell in cells {
                            ui.monospace(cell);
                        }
                        ui.end_row();
                    }
                });
            });
        });
        shown
            .header_response
            .on_hover_text(seen.say(words::WHY_TIP));
    }

    /// Shows the gloss of the new sign, and the button that stores it.
    pub(super) fn putting(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        choice: &Choice,
        out: &mut Outbox,
    ) {
        let recipe = self.chosen(choice).map(|it| it.recipe.clone());
        ui.horizontal_wrapped(|ui| {
            let shown = crate::script::edit::line(ui, &mut self.gloss, |field| {
                field.hint_text(seen.say(words::GLOSS)).desired_width(220.0)
            });
            shown
                .response
                .response
                .widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say(words::GLOSS)));
            let named = !self.gloss.trim().is_empty();
            let locked = seen.snapshot.is_read_only();
            let ready = named && !locked && recipe.is_some() && !seen.is_running(self.storing);
            let why = match (locked, named) {
                (true, _) => crate::words::shell::READ_ONLY_WHY,
                (_, false) => crate::words::recombine::NEEDS_GLOSS,
                _ => words::NEEDS_CHOICE,
            };
            let button = ui.add_enabled(ready, Button::new(seen.say(words::PUT)));
            if button.on_disabled_hover_text(seen.say(why)).clicked()
                && let Some(recipe) = &recipe
            {
                let gloss = self.gloss.trim().to_owned();
                self.stored = None;
                self.storing = Some(out.work(recombining::store(recipe.clone(), gloss)));
            }
            let button = ui.add_enabled(recipe.is_some(), Button::new(seen.say(words::RECIPE)));
            if button.clicked()
                && let Some(recipe) = recipe
            {
                out.send(Command::Recipe(recipe, None));
            }
        });
        let stored = self.stored.as_ref();
        let stored = stored.filter(|it| seen.snapshot.recording(it.1).is_some());
        if let Some((gloss, recording)) = stored {
            ui.horizontal_wrapped(|ui| {
                let text = fill(seen.say(words::STORED), &[("gloss", gloss)]);
                ui.label(RichText::new(text).color(seen.colours().good));
                if ui.small_button(seen.say(words::SHOW_STORED)).clicked() {
                    out.send(Command::Recording(*recording));
                    out.send(Command::Look);
                }
            });
        }
    }
}

fn phase_text(phase: ExpressionPhase) -> Text {
    match phase {
        ExpressionPhase::Onset => words::ONSET,
        ExpressionPhase::First => words::FIRST_PART,
        ExpressionPhase::Rest => words::REST,
        ExpressionPhase::Offset => words::OFFSET,
    }
}
