//! The saved searches: a list with the number of hits of each. They are stored in the corpus; those that were stored on
//! this computer before can be taken over.

use std::collections::BTreeMap;

use chereme_corpus::{KeptSearch, SearchOptions};
use chereme_sign::query::Query;
use chereme_sign::text::fold;
use eframe::egui::{Button, Key, Popup, PopupCloseBehavior, Role, ScrollArea, Ui, WidgetInfo};

use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::script::edit;
use crate::settings::{SavedSearch, Searches};
use crate::words::{fill, search as words};
use crate::work::{Ended, Outcome, WorkId, searching};

/// The list of saved searches.
#[derive(Debug, Default)]
pub(super) struct Kept {
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

impl Kept {
    pub(super) fn forget_counts(&mut self) {
        self.counts.clear();
    }

    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) {
        if let Some(query) = self.counting.remove(&id) {
            let total = match ended {
                Ok(Outcome::Found(answer)) => Some(answer.total),
                _ => None,
            };
            self.counts.insert(query, total);
        }
        if let Some((_, left)) = self.taking.take_if(|taking| taking.0 == id) {
            self.left = ended.is_ok().then_some(left);
        }
    }

    /// Draws the button with the list behind it; returns the chosen query.
    pub(super) fn menu(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        if let Some(saved) = self.left.take() {
            out.send(Command::Searches(Searches {
                saved,
                ..seen.settings.searches.clone()
            }));
        }
        let saved = ui.button(seen.say(words::SAVED));
        self.opened |= saved.clicked();
        let mut chosen = None;
        Popup::from_toggle_button_response(&saved)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .accessible_name(seen.say(words::SAVED))
            .show(|ui| {
                ui.set_min_width(300.0);
                self.keep(ui, seen, out, query);
                chosen = self.list(ui, seen, out);
                self.of_this_computer(ui, seen, out);
            });
        chosen
    }

    /// Draws the field that saves the query under a name.
    fn keep(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, query: &str) {
        ui.horizontal(|ui| {
            let hint = seen.say(words::SAVE_NAME);
            let before = self.name.clone();
            let field = edit::line(ui, &mut self.name, |field| {
                field.hint_text(hint).desired_width(170.0)
            });
            let response = field.response.response;
            let text = self.name.clone();
            response.widget_info(|| WidgetInfo {
                label: Some(hint.to_owned()),
                ..WidgetInfo::text_edit(true, &before, &text, hint)
            });
            if std::mem::take(&mut self.opened) {
                response.request_focus();
            }
            let named = !self.name.trim().is_empty() && Query::parse(query).is_ok();
            let save = Button::new(seen.say(words::SAVE));
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let pressed = ui.add_enabled(named, save).clicked();
            if named && (pressed || entered) {
                let all = &seen.snapshot.overview.searches;
                // Names differ by more than case and accents.
                let same = |kept: &&KeptSearch| fold(&kept.name) == fold(self.name.trim());
                let other = all.iter().find(same).filter(|kept| kept.query != query);
                self.replacing = other.map(|kept| kept.name.clone());
                if self.replacing.is_none() {
                    self.save(query, out);
                }
            }
        });
        self.replace(ui, seen, out, query);
    }

    fn save(&mut self, query: &str, out: &mut Outbox) {
        let name = std::mem::take(&mut self.name);
        let query = query.to_owned();
        out.work(searching::save_searches(vec![KeptSearch { name, query }]));
    }

    /// Asks whether the query replaces the saved search of its name, while that is open.
    fn replace(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, query: &str) {
        let typed = fold(self.name.trim());
        let asked = self.replacing.take();
        let Some(name) = asked.filter(|name| fold(name) == typed) else {
            return;
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(fill(seen.say(words::REPLACES), &[("name", &name)]));
            if ui.button(seen.say(words::REPLACE)).clicked() {
                self.save(query, out);
            } else {
                self.replacing = Some(name);
            }
        });
    }

    /// Draws the saved searches; returns the chosen one.
    fn list(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) -> Option<String> {
        let mut chosen = None;
        let all = &seen.snapshot.overview.searches;
        if all.is_empty() {
            ui.weak(seen.say(words::NO_SAVED));
        }
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            for kept in all {
                self.count(&kept.query, out);
                let known = self.counts.get(&kept.query).copied().flatten();
                ui.push_id(&kept.name, |ui| {
                    ui.horizontal(|ui| {
                        if self.rename(ui, seen, &kept.name, out) {
                            return;
                        }
                        let number = known.map_or(String::new(), |it| it.to_string());
                        let button = Button::new(&kept.name).shortcut_text(number);
                        let about = format!("{}\n@{}", kept.query, kept.name);
                        if ui.add(button).on_hover_text(about).clicked() {
                            chosen = Some(kept.query.clone());
                        }
                        let name = fill(seen.say(words::RENAME), &[("name", &kept.name)]);
                        if named(ui, seen.say(words::RENAME_SHORT), &name) {
                            self.renaming = Some((kept.name.clone(), kept.name.clone()));
                        }
                        let name = fill(seen.say(words::DELETE), &[("name", &kept.name)]);
                        if named(ui, "×", &name) {
                            out.work(searching::delete_search(kept.name.clone()));
                        }
                    });
                });
            }
        });
        chosen
    }

    /// Draws the field that renames a saved search, if it is this one.
    fn rename(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, name: &str, out: &mut Outbox) -> bool {
        let Some((of, text)) = self.renaming.as_mut().filter(|(of, _)| of == name) else {
            return false;
        };
        let hint = fill(seen.say(words::RENAME), &[("name", of)]);
        let before = text.clone();
        let field = edit::line(ui, text, |field| field.desired_width(200.0));
        let response = field.response.response;
        let shown = text.clone();
        response.widget_info(|| WidgetInfo {
            label: Some(hint.clone()),
            ..WidgetInfo::text_edit(true, &before, &shown, &hint)
        });
        if response.lost_focus() {
            let to = shown.trim();
            if !to.is_empty() && to != name {
                out.work(searching::rename_search(name.to_owned(), to.to_owned()));
            }
            self.renaming = None;
        } else if !response.has_focus() {
            response.request_focus();
        }
        true
    }

    /// Offers the searches saved on this computer, from before corpora saved searches.
    fn of_this_computer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let old = &seen.settings.searches.saved;
        if old.is_empty() {
            return;
        }
        ui.separator();
        ui.weak(fill(
            seen.say(words::OF_THIS_COMPUTER),
            &[("n", &old.len())],
        ));
        let (clashing, fresh) = clashing(old, &seen.snapshot.overview.searches);
        let running = self.taking.as_ref().map(|taking| taking.0);
        let free = !seen.is_running(running);
        ui.horizontal_wrapped(|ui| {
            if self.taking_asks && !clashing.is_empty() {
                let names: Vec<&str> = clashing.iter().map(|it| it.name.as_str()).collect();
                let names = [("names", &names.join(", ") as &dyn std::fmt::Display)];
                ui.label(fill(seen.say(words::TAKE_REPLACES), &names));
                if ui.button(seen.say(words::TAKE_ALL)).clicked() && free {
                    self.take_over(old, Vec::new(), out);
                }
                let others = Button::new(seen.say(words::TAKE_OTHERS));
                if ui.add_enabled(!fresh.is_empty(), others).clicked() && free {
                    self.take_over(&fresh, clashing, out);
                }
            } else if ui.button(seen.say(words::TAKE_OVER)).clicked() && free {
                self.taking_asks = !clashing.is_empty();
                if !self.taking_asks {
                    self.take_over(old, Vec::new(), out);
                }
            }
            if ui.button(seen.say(words::LEAVE_BEHIND)).clicked() {
                self.left = Some(Vec::new());
            }
        });
    }

    /// Saves searches of this computer in the corpus; the others stay on this computer.
    fn take_over(&mut self, all: &[SavedSearch], left: Vec<SavedSearch>, out: &mut Outbox) {
        let all = all.iter().map(|it| KeptSearch {
            name: it.name.clone(),
            query: it.query.clone(),
        });
        let id = out.work(searching::save_searches(all.collect()));
        (self.taking, self.taking_asks) = (Some((id, left)), false);
    }

    fn count(&mut self, query: &str, out: &mut Outbox) {
        if self.counts.contains_key(query) {
            return;
        }
        self.counts.insert(query.to_owned(), None);
        let id = out.work(searching::search(query.to_owned(), only_counted()));
        self.counting.insert(id, query.to_owned());
    }
}

/// Returns the searches of this computer that would replace another one of the corpus or of themselves, and the others.
fn clashing(old: &[SavedSearch], kept: &[KeptSearch]) -> (Vec<SavedSearch>, Vec<SavedSearch>) {
    let kept = kept.iter().map(|it| (fold(&it.name), it.query.clone()));
    let mut known: BTreeMap<String, String> = kept.collect();
    old.iter().cloned().partition(|old| {
        let first = known.entry(fold(old.name.trim()));
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
fn named(ui: &mut Ui, sign: &str, name: &str) -> bool {
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
