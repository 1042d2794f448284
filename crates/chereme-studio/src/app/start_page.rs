//! The page without a corpus: the starter corpus, recent ones, a path, a folder to import, and a wall of signs.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use eframe::egui::epaint::RectShape;
use eframe::egui::{
    Button, Key, ProgressBar, Rect, Response, RichText, Role, ScrollArea, Sense, Shape, StrokeKind, Ui, UiBuilder,
    WidgetInfo, vec2,
};

use chereme_motion::TimeSpan;

use super::Studio;
use crate::action::Action;
use crate::command::{ChooserPurpose, WindowCommand};
use crate::panes::list_row;
use crate::script::script_edit;
use crate::start_wall;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, shell as words};
use crate::work::begin::CorpusOpening;

/// The text typed on the page.
#[derive(Debug, Default)]
pub(crate) struct StartPage {
    path: String,
    /// Whether the likeliest button has been given the keyboard.
    come: bool,
}

impl StartPage {
    /// Resets the state, for the next time that the page is shown.
    pub(crate) fn reset_start_page(&mut self) {
        *self = Self::default();
    }
}

/// Returns the possible uses of a typed path: open it, create it, or import it.
pub(crate) fn typed_path_uses(path: &str, is_file: bool, is_folder: bool) -> [bool; 3] {
    let typed = !path.trim().is_empty();
    [typed && is_file, typed && !is_file && !is_folder, typed && is_folder]
}

/// An offer on the page: its name, a hint, and its command.
type StartOffer = (InterfaceText, InterfaceText, WindowCommand);

/// A button for the typed path: its name, and its use of the path.
type TypedPathButton = (InterfaceText, fn(PathBuf) -> CorpusOpening);

/// The keys that give the keyboard to the page if nothing has it.
const START_PAGE_KEYS: [Key; 4] = [Key::ArrowDown, Key::ArrowUp, Key::Enter, Key::Space];
/// The greatest width of the column, in points.
const MAX_START_COLUMN_POINTS: f32 = 620.0;
/// The least width of the column beside the wall, in points.
const MIN_START_COLUMN_POINTS: f32 = 400.0;
/// The margin at the sides of the column, in points.
const START_COLUMN_EDGE_POINTS: f32 = 20.0;
/// A window narrower than this, in points, has the wall below the column.
const WALL_BESIDE_WIDTH_POINTS: f32 = 860.0;
/// The height of a wall below the column, in points.
const WALL_STRIP_HEIGHT_POINTS: f32 = 190.0;
/// How many recent corpora the page shows; the menu lists all.
const MAX_START_RECENT_CORPORA: usize = 4;
/// The width of the button that removes a recent corpus from the list, in points.
const FORGET_BUTTON_WIDTH_POINTS: f32 = 36.0;
/// A window lower than this has no room to spare, in points.
const LOW_WINDOW_HEIGHT_POINTS: f32 = 680.0;

impl Studio {
    pub(crate) fn start_page(&mut self, ui: &mut Ui) {
        // A key that would have no effect gives the keyboard to the likeliest button.
        let lost = ui.memory(|memory| memory.focused().is_none());
        if lost && ui.input(|input| START_PAGE_KEYS.into_iter().any(|key| input.key_pressed(key))) {
            self.start.come = false;
        }
        let page_rect = ui.available_rect_before_wrap();
        let walled = page_rect.width() >= WALL_BESIDE_WIDTH_POINTS;
        let mut column = page_rect;
        if walled {
            let share = (page_rect.width() * 0.42).clamp(MIN_START_COLUMN_POINTS, MAX_START_COLUMN_POINTS);
            column.set_width(share);
            let room = page_rect.with_min_x(column.right()).shrink2(vec2(20.0, 28.0));
            self.show_starter_wall(ui, room);
        }
        let builder = UiBuilder::new().max_rect(column).id_salt("start");
        ui.scope_builder(builder, |ui| self.start_column(ui, walled));
    }

    /// Shows the wall; a click on a sign opens the starter corpus with that sign.
    fn show_starter_wall(&mut self, ui: &mut Ui, room: Rect) {
        let language = self.settings.language;
        if let Some(gloss) = start_wall::show_sign_wall(ui, &self.little, language, room) {
            self.greets = Some(gloss);
            self.out.send_command(WindowCommand::Do(Action::OpenStarter));
        }
    }

    fn start_column(&mut self, ui: &mut Ui, walled: bool) {
        let language = self.settings.language;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let width = (ui.available_width() - 2.0 * START_COLUMN_EDGE_POINTS)
                .min(MAX_START_COLUMN_POINTS - 2.0 * START_COLUMN_EDGE_POINTS);
            let left = (ui.available_width() - width) / 2.0;
            ui.horizontal(|ui| {
                ui.add_space(left.max(0.0));
                ui.vertical(|ui| {
                    ui.set_width(width);
                    let low = ui.ctx().content_rect().height() < LOW_WINDOW_HEIGHT_POINTS;
                    ui.add_space(if low { 12.0 } else { 56.0 });
                    ui.label(
                        RichText::new(words::START_TITLE.text_in_language(language))
                            .size(34.0)
                            .strong(),
                    );
                    ui.label(RichText::new(words::START_LEAD.text_in_language(language)).size(16.0));
                    let gap = if low { 10.0 } else { 24.0 };
                    ui.add_space(gap);
                    if self.beginning.is_some() {
                        self.beginning_page(ui);
                        return;
                    }
                    // A returning user continues with a recent corpus.
                    if !self.settings.recent.is_empty() {
                        self.recent_part(ui);
                        ui.add_space(gap);
                    }
                    self.offers_part(ui);
                    ui.add_space(gap);
                    self.path_part(ui);
                    if !walled {
                        ui.add_space(gap);
                        let size = vec2(width, WALL_STRIP_HEIGHT_POINTS);
                        let (room, _) = ui.allocate_exact_size(size, Sense::hover());
                        self.show_starter_wall(ui, room);
                    }
                });
            });
        });
    }

    /// Returns the place of the sign to show first to a new user, once.
    pub(crate) fn take_greeting_sign(&mut self) -> Option<(i64, TimeSpan)> {
        let gloss = self.greets.take()?;
        let signs = &self.snapshot.as_ref()?.overview.signs;
        let wanted = signs.iter().find(|sign| sign.gloss == gloss);
        wanted
            .and_then(|sign| sign.place)
            .or_else(|| signs.iter().find_map(|sign| sign.place))
    }

    fn beginning_page(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let Some(beginning) = &self.beginning else {
            return;
        };
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(words::TASK_OPENING.text_in_language(language));
            ui.weak(&beginning.far.task);
        });
        if let Some(share) = beginning.far.finished_share() {
            ui.add(ProgressBar::new(share));
        }
        if ui.button(words::CANCEL.text_in_language(language)).clicked() {
            self.out.send_command(WindowCommand::StopBeginning);
        }
    }

    fn offers_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let offers: [StartOffer; 4] = [
            (
                words::START_STARTER,
                words::START_STARTER_HINT,
                WindowCommand::Do(Action::OpenStarter),
            ),
            (
                words::START_OPEN,
                words::START_OPEN_HINT,
                WindowCommand::Do(Action::Open),
            ),
            (
                words::START_IMPORT,
                words::START_IMPORT_HINT,
                WindowCommand::Choose(ChooserPurpose::CorpusOfFolder),
            ),
            (words::START_NEW, words::START_NEW_HINT, WindowCommand::Do(Action::New)),
        ];
        for (name, hint, command) in offers {
            let row = show_start_offer(
                ui,
                46.0,
                name.text_in_language(language),
                hint.text_in_language(language),
            );
            if !std::mem::replace(&mut self.start.come, true) {
                row.request_focus();
            }
            if row.clicked() {
                self.out.send_command(command);
            }
        }
    }

    fn path_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let label = ui.strong(words::START_TYPED.text_in_language(language));
        let edited_line =
            script_edit::draw_text_line(ui, &mut self.start.path, |field| field.desired_width(f32::INFINITY));
        let field = edited_line.response.response.labelled_by(label.id);
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let path = PathBuf::from(self.start.path.trim());
        let can = typed_path_uses(&self.start.path, path.is_file(), path.is_dir());
        let offers: [TypedPathButton; 3] = [
            (words::START_TYPED_OPEN, CorpusOpening::Open),
            (words::START_TYPED_NEW, CorpusOpening::New),
            (words::START_TYPED_IMPORT, CorpusOpening::Folder),
        ];
        ui.horizontal(|ui| {
            for (can, (text, begin)) in can.into_iter().zip(offers) {
                let button = ui.add_enabled(can, Button::new(text.text_in_language(language)));
                if button.clicked() || (can && entered) {
                    self.out.send_command(WindowCommand::Begin(begin(path.clone())));
                }
            }
        });
        ui.weak(words::START_DROP.text_in_language(language));
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            for (it, name) in InterfaceLanguage::all_listed() {
                ui.selectable_value(&mut self.settings.language, it, name);
            }
            let steps = ui.button(Action::FirstSteps.action_row().name.text_in_language(language));
            if steps.clicked() {
                self.out.send_command(WindowCommand::Do(Action::FirstSteps));
            }
        });
    }

    fn recent_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ui.strong(InterfaceText::from_id("menu-bar-recent").text_in_language(language));
        for path in self.settings.recent.iter().take(MAX_START_RECENT_CORPORA) {
            let there = path.is_file();
            let (name, folder) = split_file_path(path);
            let about = if there {
                folder
            } else {
                format!("{folder} · {}", words::START_GONE.text_in_language(language))
            };
            let label = fill_text_braces(words::START_FORGET.text_in_language(language), &[("name", &name)]);
            let (row, forget) = ui
                .horizontal(|ui| {
                    let wide = (ui.available_width() - FORGET_BUTTON_WIDTH_POINTS).max(0.0);
                    let size = vec2(wide, 40.0);
                    let row = ui.allocate_ui(size, |ui| {
                        ui.add_enabled_ui(there, |ui| show_start_offer(ui, 40.0, &name, &about))
                    });
                    let button = ui.button("×");
                    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
                    (row.inner.inner, button.on_hover_text(&label).clicked())
                })
                .inner;
            if there && !std::mem::replace(&mut self.start.come, true) {
                row.request_focus();
            }
            if row.clicked() {
                self.out
                    .send_command(WindowCommand::Begin(CorpusOpening::Open(path.clone())));
            }
            if forget {
                let mut settings = self.settings.clone();
                settings.recent.retain(|recent_path| recent_path != path);
                self.out.send_command(WindowCommand::Settings(Box::new(settings)));
            }
        }
    }
}

/// Shows an offer in a frame.
fn show_start_offer(ui: &mut Ui, height: f32, name: &str, about: &str) -> Response {
    let frame = ui.painter().add(Shape::Noop);
    let row = list_row(ui, height, false, name, about);
    let visuals = ui.visuals();
    let fill = visuals.faint_bg_color;
    let edge = visuals.widgets.noninteractive.bg_stroke;
    let shape = RectShape::new(row.rect, 5.0, fill, edge, StrokeKind::Inside);
    ui.painter().set(frame, shape);
    row
}

/// Returns the name of a file without its extension, and its folder.
fn split_file_path(path: &Path) -> (String, String) {
    let text = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    (text(path.file_stem()), text(path.parent().map(Path::as_os_str)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_offers_its_possible_actions() {
        assert_eq!(typed_path_uses("", false, true), [false; 3]);
        assert_eq!(typed_path_uses("a.chereme", true, false), [true, false, false]);
        assert_eq!(typed_path_uses("new", false, false), [false, true, false]);
        assert_eq!(
            split_file_path(Path::new("/a/b.chereme")),
            ("b".to_owned(), "/a".to_owned())
        );
        assert_eq!(typed_path_uses("folder", false, true), [false, false, true]);
    }
}
