//! The ranked candidates side by side, the reasons for their ranks, and the storing of the sentence with a chosen face.

use std::sync::Arc;

use chereme_corpus::{ExpressionMilestones, ExpressionPhase, PerformanceChoice, RankedPerformance};
use eframe::egui::{
    Align2, Button, CollapsingHeader, Grid, Rect, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};

use super::{FacesPane, counted_face_text, faces_data};
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureFocus, MiniatureMotion};
use crate::words::{InterfaceText, faces_words as words, fill_text_braces};
use crate::work::recombining;

/// The least width of a figure, and the height of its name below it, in points.
const MIN_CANDIDATE_FIGURE_WIDTH: f32 = 150.0;
const CANDIDATE_NAME_HEIGHT: f32 = 36.0;
/// How many sentences are animated at the same time.
const MAX_ANIMATED_SENTENCES: usize = 2;

/// The lines below the figure of a candidate, and whether it is chosen.
struct CandidateCaption<'a> {
    name: &'a str,
    score: &'a str,
    chosen: bool,
}

impl FacesPane {
    /// Shows the sentence's own face and the candidates, side by side.
    pub(super) fn show_face_candidates(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &Arc<PerformanceChoice>) {
        let moment = faces_data::loop_moment(&choice.milestones, miniatures::figure_loop_clock(ui));
        let sentence = self.sentence_name(choice);
        let own_label = fill_text_braces(seen.say_text(words::OWN), &[("name", &sentence)]);
        let motion = self.recorded(choice.recording_id, &choice.milestones, choice, moment);
        let room = ui.available_width();
        let gap = 6.0;
        let columns = ((room + gap) / (MIN_CANDIDATE_FIGURE_WIDTH + gap)).floor().max(1.0);
        let side = ((room + gap) / columns - gap).min(MIN_CANDIDATE_FIGURE_WIDTH * 1.6);
        let mut picked = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(gap);
            ui.horizontal_wrapped(|ui| {
                let caption = CandidateCaption {
                    name: &own_label,
                    score: "",
                    chosen: false,
                };
                self.show_candidate_figure(ui, seen, motion, side, &caption);
                for (n, it) in choice.ranking.iter().enumerate() {
                    let motion = match self.carried {
                        true => self.on_sentence(seen, it, choice, moment),
                        false => self.recorded(it.recording_id, &it.milestones, choice, moment),
                    };
                    let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &(n + 1)), ("name", &it.recording)];
                    let name = fill_text_braces(seen.say_text(words::CANDIDATE), &values);
                    let score = format!("{:.3}", it.score);
                    let stretch = format!("{:.2}", it.parts.stretch);
                    let values: [(&str, &dyn std::fmt::Display); 2] = [("score", &score), ("stretch", &stretch)];
                    let shown_score = fill_text_braces(seen.say_text(words::SCORE), &values);
                    let caption = CandidateCaption {
                        name: &name,
                        score: &shown_score,
                        chosen: self.chosen.as_deref() == Some(&it.token),
                    };
                    if self.show_candidate_figure(ui, seen, motion, side, &caption) {
                        picked = Some(it.clone());
                    }
                }
            });
        });
        if let Some(it) = picked {
            self.choose_performance(&it);
        }
    }

    /// Returns a recorded expression, and the time in it that corresponds to `moment` of the sentence, in seconds.
    fn recorded(
        &self,
        recording: i64,
        own: &ExpressionMilestones,
        choice: &PerformanceChoice,
        moment: f64,
    ) -> Option<(MiniatureMotion, f64)> {
        let into = faces_data::into_span(own, &choice.milestones, moment, self.in_step);
        Some((MiniatureMotion::Span(recording, faces_data::seen_span(own)), into))
    }

    /// Returns the sentence with the face of a performance, and the time in it; requests the animation if necessary.
    fn on_sentence(
        &mut self,
        seen: &PaneInput<'_>,
        it: &RankedPerformance,
        choice: &PerformanceChoice,
        moment: f64,
    ) -> Option<(MiniatureMotion, f64)> {
        if let Some(made) = self.made.get(&it.recipe) {
            let made = made.clone()?;
            // The recipe's milestones are relative to the first frame of the movement.
            let start = faces_data::seen_span(&choice.milestones)
                .span_start_instant()
                .instant_seconds();
            let lasts = made.clip.clip_span().span_seconds();
            let into = moment.max(start).min(lasts - 1e-6).max(0.0);
            return Some((MiniatureMotion::Made(made), into));
        }
        let asked = self.carrying.values().any(|recipe| *recipe == it.recipe);
        let running = |id: &crate::work::WorkId| seen.running.contains_key(id);
        let busy = self.carrying.keys().filter(|id| running(id)).count();
        if !asked && busy < MAX_ANIMATED_SENTENCES && self.carrying.len() < MAX_ANIMATED_SENTENCES {
            let id = seen.request_work(recombining::preview_recipe_job(it.recipe.clone()));
            self.carrying.insert(id, it.recipe.clone());
        }
        None
    }

    /// Shows one figure with its name below; returns whether it was clicked.
    fn show_candidate_figure(
        &self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        motion: Option<(MiniatureMotion, f64)>,
        side: f32,
        caption: &CandidateCaption<'_>,
    ) -> bool {
        let CandidateCaption { name, score, chosen } = *caption;
        let (rect, response) = ui.allocate_exact_size(vec2(side, side + CANDIDATE_NAME_HEIGHT), Sense::click());
        let label = match score.is_empty() {
            true => name.to_owned(),
            false => format!("{name}: {score}"),
        };
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        if !ui.is_rect_visible(rect) {
            return response.clicked();
        }
        let picture = Rect::from_min_size(rect.min, Vec2::splat(side));
        match motion {
            Some((motion, into)) => {
                let focus = match self.wide {
                    true => MiniatureFocus::Signing,
                    false => MiniatureFocus::Face,
                };
                let cell = MiniatureCell::new(motion, picture.size())
                    .with_picture_focus(focus)
                    .with_playing_clock(into);
                seen.little.paint_figure(ui, seen.language, seen.out, &cell, picture);
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
        let text_position = |below: f32| pos2(left, picture.bottom() + below);
        painter.text(text_position(10.0), Align2::LEFT_CENTER, name, body, strong);
        painter.text(text_position(26.0), Align2::LEFT_CENTER, score, small, weak);
        if chosen || response.hovered() || response.has_focus() {
            let wide = if chosen { 2.0 } else { 1.0 };
            let stroke = Stroke::new(wide, seen.pane_colours().accent);
            ui.painter().rect_stroke(rect, 6.0, stroke, StrokeKind::Inside);
        }
        response.on_hover_text(label).clicked()
    }

    /// Shows how many performances were compared and skipped.
    pub(super) fn show_counts(&self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &PerformanceChoice) {
        let skipped = choice.skipped.len() as u64;
        let lines = [
            counted_face_text(seen, words::COMPARED_COUNT, choice.compared),
            counted_face_text(seen, words::ADAPTED, choice.adapted),
            counted_face_text(seen, words::SKIPPED, skipped),
            (!choice.left_out.is_empty()).then(|| {
                let names = choice.left_out.join(", ");
                fill_text_braces(seen.say_text(words::LEFT_OUT), &[("names", &names)])
            }),
        ];
        let lines: Vec<String> = lines.into_iter().flatten().collect();
        ui.weak(lines.join(" · "));
    }

    /// Shows the table of phases and channels for the chosen performance.
    pub(super) fn show_score_reasons(&self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &PerformanceChoice) {
        let Some(chosen) = self.chosen_performance(choice) else {
            return;
        };
        let title = fill_text_braces(seen.say_text(words::WHY), &[("name", &chosen.recording)]);
        let header = CollapsingHeader::new(title).id_salt("why").default_open(true);
        let shown = header.show(ui, |ui| {
            // A table that is wider than the pane scrolls sideways by itself.
            ScrollArea::horizontal().show(ui, |ui| {
                Grid::new("reasons").striped(true).show(ui, |ui| {
                    ui.weak(seen.say_text(words::PHASE));
                    ui.weak(seen.say_text(words::COST));
                    for channel in &choice.channels {
                        ui.weak(channel.name);
                    }
                    ui.end_row();
                    for (phase, cells) in faces_data::score_reason_rows(&chosen.parts, choice.channels.len()) {
                        ui.label(seen.say_text(phase_text(phase)));
                        for cell in cells {
                            ui.monospace(cell);
                        }
                        ui.end_row();
                    }
                });
            });
        });
        shown.header_response.on_hover_text(seen.say_text(words::WHY_TIP));
    }

    /// Shows the gloss of the new sign, and the button that stores it.
    pub(super) fn show_face_sign_form(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, choice: &PerformanceChoice) {
        let recipe = self.chosen_performance(choice).map(|ranked| ranked.recipe.clone());
        ui.horizontal_wrapped(|ui| {
            let shown = crate::script::script_edit::draw_text_line(ui, &mut self.gloss, |field| {
                field.hint_text(seen.say_text(words::GLOSS)).desired_width(220.0)
            });
            shown
                .response
                .response
                .widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say_text(words::GLOSS)));
            let named = !self.gloss.trim().is_empty();
            let locked = seen.snapshot.is_read_only();
            let ready = named && !locked && recipe.is_some() && !seen.is_running(self.storing);
            let why = match (locked, named) {
                (true, _) => crate::words::shell::READ_ONLY_WHY,
                (_, false) => crate::words::recombine_words::NEEDS_GLOSS,
                _ => words::NEEDS_CHOICE,
            };
            let button = ui.add_enabled(ready, Button::new(seen.say_text(words::PUT)));
            if button.on_disabled_hover_text(seen.say_text(why)).clicked()
                && let Some(recipe) = &recipe
            {
                let gloss = self.gloss.trim().to_owned();
                self.stored = None;
                self.storing = Some(seen.request_work(recombining::store_recipe_job(recipe.clone(), gloss)));
            }
            let button = ui.add_enabled(recipe.is_some(), Button::new(seen.say_text(words::RECIPE)));
            if button.clicked()
                && let Some(recipe) = recipe
            {
                seen.send_command(WindowCommand::Recipe(recipe, None));
            }
        });
        let stored_sign = self.stored.as_ref();
        let stored = stored_sign.filter(|entry| seen.snapshot.recording_glance(entry.1).is_some());
        if let Some((gloss, recording)) = stored {
            ui.horizontal_wrapped(|ui| {
                let text = fill_text_braces(seen.say_text(words::STORED), &[("gloss", gloss)]);
                ui.label(RichText::new(text).color(seen.pane_colours().good));
                if ui.small_button(seen.say_text(words::SHOW_STORED)).clicked() {
                    seen.send_command(WindowCommand::Recording(*recording));
                    seen.send_command(WindowCommand::Look);
                }
            });
        }
    }
}

fn phase_text(phase: ExpressionPhase) -> InterfaceText {
    match phase {
        ExpressionPhase::Onset => words::ONSET,
        ExpressionPhase::First => words::FIRST_PART,
        ExpressionPhase::Rest => words::REST,
        ExpressionPhase::Offset => words::OFFSET,
    }
}
