//! The saved searches: a list with the number of hits of each. They are stored in the corpus; those that were stored on
//! this computer before can be taken over.

use std::collections::BTreeMap;

use chereme_corpus::{KeptSearch, SearchOptions};
use chereme_sign::query::TokenQuery;
use chereme_sign::text::fold_text;
use eframe::egui::{Button, Key, Popup, PopupCloseBehavior, Role, ScrollArea, Ui, WidgetInfo};

use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::settings::{SavedSearch, SearchHistory};
use crate::words::{fill_text_braces, search_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, searching};

/// The list of saved searches.
#[derive(Debug, Default)]
pub(super) struct SavedSearchList {
    /// The name for the query to save, and the search that is being renamed.
    name: String,
    renaming: Option<(String, String)>,
    /// The name of a saved search that the query is to replace, if the user agrees.
    replacing: Option<String>,
    /// Whether the list was just opened, so that the name takes the keyboard.
    opened: bool,
    /// The number of hits of each saved search, if counted.
    counts: BTreeMap<String, Option<usize>>,
    counting: BTreeMap<WorkId, String>,
    /// The work that takes over searches of this computer, and those that stay there.
    taking: Option<(WorkId, Vec<SavedSearch>)>,
    /// The searches that are left on this computer, once the others are taken over or forgotten.
    left: Option<Vec<SavedSearch>>,
    /// Whether the user is asked if searches of this computer replace those of the corpus.
    taking_asks: bool,
}

impl SavedSearchList {
    pub(super) fn forget_counts(&mut self) {
        self.counts.clear();
    }

    pub(super) fn receive_saved_search_result(&mut self, id: WorkId, ended: &WorkResult) {
        if let Some(query) = self.counting.remove(&id) {
            let total = match ended {
                Ok(WorkOutcome::Found(answer)) => Some(answer.total),
                _ => None,
            };
            self.counts.insert(query, total);
        }
        if let Some((_, left)) = self.taking.take_if(|taking| taking.0 == id) {
            self.left = ended.is_ok().then_some(left);
        }
    }

    /// Draws the button with the list behind it; returns the chosen query.
    pub(super) fn show_saved_search_menu(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, query: &str) -> Option<String> {
        if let Some(saved) = self.left.take() {
            seen.send_command(WindowCommand::Searches(SearchHistory {
                saved,
                ..seen.settings.searches.clone()
            }));
        }
        let saved = ui.button(seen.say_text(words::SAVED));
        self.opened |= saved.clicked();
        let mut chosen = None;
        Popup::from_toggle_button_response(&saved)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .accessible_name(seen.say_text(words::SAVED))
            .show(|ui| {
                ui.set_min_width(300.0);
                self.show_save_search_field(ui, seen, query);
                chosen = self.draw_saved_searches(ui, seen);
                self.of_this_computer(ui, seen);
            });
        chosen
    }

    /// Draws the field that saves the query under a name.
    fn show_save_search_field(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, query: &str) {
        ui.horizontal(|ui| {
            let hint = seen.say_text(words::SAVE_NAME);
            let before = self.name.clone();
            let field =
                script_edit::draw_text_line(ui, &mut self.name, |field| field.hint_text(hint).desired_width(170.0));
            let response = field.response.response;
            let text = self.name.clone();
            response.widget_info(|| WidgetInfo {
                label: Some(hint.to_owned()),
                ..WidgetInfo::text_edit(true, &before, &text, hint)
            });
            if std::mem::take(&mut self.opened) {
                response.request_focus();
            }
            let named = !self.name.trim().is_empty() && TokenQuery::parse_query(query).is_ok();
            let save = Button::new(seen.say_text(words::SAVE));
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let pressed = ui.add_enabled(named, save).clicked();
            if named && (pressed || entered) {
                let all = &seen.snapshot.overview.searches;
                // Names differ by more than case and accents.
                let same = |kept: &&KeptSearch| fold_text(&kept.name) == fold_text(self.name.trim());
                let other = all.iter().find(same).filter(|kept| kept.query != query);
                self.replacing = other.map(|kept| kept.name.clone());
                if self.replacing.is_none() {
                    self.save_search_query(query, seen.out);
                }
            }
        });
        self.confirm_search_replacement(ui, seen, query);
    }

    fn save_search_query(&mut self, query: &str, out: &CommandOutbox) {
        let name = std::mem::take(&mut self.name);
        let query = query.to_owned();
        out.request_work(searching::save_searches(vec![KeptSearch { name, query }]));
    }

    /// Asks whether the query replaces the saved search of its name, while that is open.
    fn confirm_search_replacement(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, query: &str) {
        let typed = fold_text(self.name.trim());
        let asked = self.replacing.take();
        let Some(name) = asked.filter(|name| fold_text(name) == typed) else {
            return;
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(fill_text_braces(seen.say_text(words::REPLACES), &[("name", &name)]));
            if ui.button(seen.say_text(words::REPLACE)).clicked() {
                self.save_search_query(query, seen.out);
            } else {
                self.replacing = Some(name);
            }
        });
    }

    /// Draws the saved searches; returns the chosen one.
    fn draw_saved_searches(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) -> Option<String> {
        let mut chosen = None;
        let all = &seen.snapshot.overview.searches;
        if all.is_empty() {
            ui.weak(seen.say_text(words::NO_SAVED));
        }
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            for kept in all {
                self.count_saved_search_hits(&kept.query, seen.out);
                let hit_count = self.counts.get(&kept.query).copied().flatten();
                ui.push_id(&kept.name, |ui| {
                    ui.horizontal(|ui| {
                        if self.show_rename_search_field(ui, seen, &kept.name) {
                            return;
                        }
                        let number = hit_count.map_or(String::new(), |count| count.to_string());
                        let button = Button::new(&kept.name).shortcut_text(number);
                        let about = format!("{}\n@{}", kept.query, kept.name);
                        if ui.add(button).on_hover_text(about).clicked() {
                            chosen = Some(kept.query.clone());
                        }
                        let name = fill_text_braces(seen.say_text(words::RENAME), &[("name", &kept.name)]);
                        if draw_named_button(ui, seen.say_text(words::RENAME_SHORT), &name) {
                            self.renaming = Some((kept.name.clone(), kept.name.clone()));
                        }
                        let name = fill_text_braces(seen.say_text(words::DELETE), &[("name", &kept.name)]);
                        if draw_named_button(ui, "×", &name) {
                            seen.request_work(searching::delete_search(kept.name.clone()));
                        }
                    });
                });
            }
        });
        chosen
    }

    /// Draws the field that renames a saved search, if it is this one.
    fn show_rename_search_field(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, name: &str) -> bool {
        let Some((of, text)) = self.renaming.as_mut().filter(|(of, _)| of == name) else {
            return false;
        };
        let hint = fill_text_braces(seen.say_text(words::RENAME), &[("name", of)]);
        let before = text.clone();
        let field = script_edit::draw_text_line(ui, text, |field| field.desired_width(200.0));
        let response = field.response.response;
        let shown = text.clone();
        response.widget_info(|| WidgetInfo {
            label: Some(hint.clone()),
            ..WidgetInfo::text_edit(true, &before, &shown, &hint)
        });
        if response.lost_focus() {
            let to = shown.trim();
            if !to.is_empty() && to != name {
                seen.request_work(searching::rename_search(name.to_owned(), to.to_owned()));
            }
            self.renaming = None;
        } else if !response.has_focus() {
            response.request_focus();
        }
        true
    }

    /// Offers the searches saved on this computer, from before corpora saved searches.
    fn of_this_computer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let old = &seen.settings.searches.saved;
        if old.is_empty() {
            return;
        }
        ui.separator();
        ui.weak(fill_text_braces(
            seen.say_text(words::OF_THIS_COMPUTER),
            &[("n", &old.len())],
        ));
        let (clashing, fresh) = clashing(old, &seen.snapshot.overview.searches);
        let running = self.taking.as_ref().map(|taking| taking.0);
        let free = !seen.is_running(running);
        ui.horizontal_wrapped(|ui| {
            if self.taking_asks && !clashing.is_empty() {
                let clashing_names: Vec<&str> = clashing.iter().map(|search| search.name.as_str()).collect();
                let names = [("names", &clashing_names.join(", ") as &dyn std::fmt::Display)];
                ui.label(fill_text_braces(seen.say_text(words::TAKE_REPLACES), &names));
                if ui.button(seen.say_text(words::TAKE_ALL)).clicked() && free {
                    self.take_over(old, Vec::new(), seen.out);
                }
                let others = Button::new(seen.say_text(words::TAKE_OTHERS));
                if ui.add_enabled(!fresh.is_empty(), others).clicked() && free {
                    self.take_over(&fresh, clashing, seen.out);
                }
            } else if ui.button(seen.say_text(words::TAKE_OVER)).clicked() && free {
                self.taking_asks = !clashing.is_empty();
                if !self.taking_asks {
                    self.take_over(old, Vec::new(), seen.out);
                }
            }
            if ui.button(seen.say_text(words::LEAVE_BEHIND)).clicked() {
                self.left = Some(Vec::new());
            }
        });
    }

    /// Saves searches of this computer in the corpus; the others stay on this computer.
    fn take_over(&mut self, all: &[SavedSearch], left: Vec<SavedSearch>, out: &CommandOutbox) {
        let all = all.iter().map(|saved| KeptSearch {
            name: saved.name.clone(),
            query: saved.query.clone(),
        });
        let id = out.request_work(searching::save_searches(all.collect()));
        (self.taking, self.taking_asks) = (Some((id, left)), false);
    }

    fn count_saved_search_hits(&mut self, query: &str, out: &CommandOutbox) {
        if self.counts.contains_key(query) {
            return;
        }
        self.counts.insert(query.to_owned(), None);
        let id = out.request_work(searching::search_tokens_job(query.to_owned(), only_counted()));
        self.counting.insert(id, query.to_owned());
    }
}

/// Returns the searches of this computer that would replace another one of the corpus or of themselves, and the others.
fn clashing(old: &[SavedSearch], kept: &[KeptSearch]) -> (Vec<SavedSearch>, Vec<SavedSearch>) {
    let kept = kept
        .iter()
        .map(|search| (fold_text(&search.name), search.query.clone()));
    let mut queries_by_name: BTreeMap<String, String> = kept.collect();
    old.iter().cloned().partition(|old| {
        let first = queries_by_name.entry(fold_text(old.name.trim()));
        *first.or_insert_with(|| old.query.clone()) != old.query
    })
}

/// Returns the options of a search that only counts hits.
pub(super) fn only_counted() -> SearchOptions {
    SearchOptions {
        limit: Some(0),
        facets: false,
        ..SearchOptions::default()
    }
}

/// Draws a small button with the accessible name `name`; returns whether it was clicked.
fn draw_named_button(ui: &mut Ui, sign: &str, name: &str) -> bool {
    let response = ui.small_button(sign).on_hover_text(name);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    response.clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn searches_of_this_computer_clash_with_others_of_their_names() {
        let old = |name: &str, query: &str| SavedSearch {
            name: name.to_owned(),
            query: query.to_owned(),
        };
        let kept = KeptSearch {
            name: "Menton".to_owned(),
            query: "placement=chin".to_owned(),
        };
        let all = [
            old("menton ", "placement=head"),
            old("MENTON", "placement=chin"),
            old("brefs", "duration<1s"),
            old("Brefs", "duration<2s"),
        ];
        let (clashing, fresh) = clashing(&all, &[kept]);
        assert_eq!(clashing, [all[0].clone(), all[3].clone()]);
        assert_eq!(fresh, [all[1].clone(), all[2].clone()]);
    }
}
