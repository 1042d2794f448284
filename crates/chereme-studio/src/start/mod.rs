//! The page without a corpus: the starter corpus, recent ones, a path, a folder to import, and a wall of signs.

pub(crate) mod wall;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use eframe::egui::epaint::RectShape;
use eframe::egui::{
    Button, Key, ProgressBar, Rect, Response, RichText, Role, ScrollArea, Sense, Shape, StrokeKind,
    Ui, UiBuilder, WidgetInfo, vec2,
};

use chereme_motion::Span;

use crate::action::Action;
use crate::app::Studio;
use crate::command::Command;
use crate::file_dialogs::Choose;
use crate::panes::list_row;
use crate::script::edit;
use crate::words::{Language, Text, fill, shell as words};
use crate::work::begin::Begin;

/// The text typed on the page.
#[derive(Debug, Default)]
pub(crate) struct Start {
    path: String,
    /// Whether the likeliest button has been given the keyboard.
    come: bool,
}

impl Start {
    /// Resets the state, for the next time that the page is shown.
    pub(crate) fn leave(&mut self) {
        *self = Self::default();
    }
}

/// Returns the possible uses of a typed path: open it, create it, or import it.
pub(crate) fn uses(path: &str, is_file: bool, is_folder: bool) -> [bool; 3] {
    let typed = !path.trim().is_empty();
    [
        typed && is_file,
        typed && !is_file && !is_folder,
        typed && is_folder,
    ]
}

/// An offer on the page: its name, a hint, and its command.
type Offer = (Text, Text, Command);

/// A button for the typed path: its name, and its use of the path.
type Typed = (Text, fn(PathBuf) -> Begin);

/// The keys that give the keyboard to the page if nothing has it.
const KEYS: [Key; 4] = [Key::ArrowDown, Key::ArrowUp, Key::Enter, Key::Space];
/// The greatest width of the column, in points.
const WIDE: f32 = 620.0;
/// The least width of the column beside the wall, in points.
const LEAST: f32 = 400.0;
/// The margin at the sides of the column, in points.
const EDGE: f32 = 20.0;
/// A window narrower than this, in points, has the wall below the column.
const WALLED: f32 = 860.0;
/// The height of a wall below the column, in points.
const STRIP: f32 = 190.0;
/// How many recent corpora the page shows; the menu lists all.
const RECENT: usize = 4;
/// The width of the button that removes a recent corpus from the list, in points.
const FORGET: f32 = 36.0;
/// A window lower than this has no room to spare, in points.
const LOW: f32 = 680.0;

impl Studio {
    pub(crate) fn start_page(&mut self, ui: &mut Ui) {
        // A key that would have no effect gives the keyboard to the likeliest button.
        let lost = ui.memory(|memory| memory.focused().is_none());
        if lost && ui.input(|input| KEYS.into_iter().any(|key| input.key_pressed(key))) {
            self.start.come = false;
        }
        let whole = ui.available_rect_before_wrap();
        let walled = whole.width() >= WALLED;
        let mut column = whole;
        if walled {
            let share = (whole.width() * 0.42).clamp(LEAST, WIDE);
            column.set_width(share);
            let room = whole.with_min_x(column.right()).shrink2(vec2(20.0, 28.0));
            self.wall(ui, room);
        }
        let builder = UiBuilder::new().max_rect(column).id_salt("start");
        ui.scope_builder(builder, |ui| self.start_column(ui, walled));
    }

    /// Shows the wall; a click on a sign opens the starter corpus with that sign.
    fn wall(&mut self, ui: &mut Ui, room: Rect) {
        let language = self.settings.language;
        if let Some(gloss) = wall::show(ui, &self.little, language, room) {
            self.greets = Some(gloss);
            self.out.send(Command::Do(Action::OpenStarter));
        }
    }

    fn start_column(&mut self, ui: &mut Ui, walled: bool) {
        let language = self.settings.language;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let width = (ui.available_width() - 2.0 * EDGE).min(WIDE - 2.0 * EDGE);
            let left = (ui.available_width() - width) / 2.0;
            ui.horizontal(|ui| {
                ui.add_space(left.max(0.0));
                ui.vertical(|ui| {
                    ui.set_width(width);
                    let low = ui.ctx().content_rect().height() < LOW;
                    ui.add_space(if low { 12.0 } else { 56.0 });
                    ui.label(
                        RichText::new(words::START_TITLE.of(language))
                            .size(34.0)
                            .strong(),
                    );
                    ui.label(RichText::new(words::START_LEAD.of(language)).size(16.0));
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
                        let size = vec2(width, STRIP);
                        let (room, _) = ui.allocate_exact_size(size, Sense::hover());
                        self.wall(ui, room);
                    }
                });
            });
        });
    }

    /// Returns the place of the sign to show first to a new user, once.
    pub(crate) fn greeting(&mut self) -> Option<(i64, Span)> {
        let gloss = self.greets.take()?;
        let signs = &self.snapshot.as_ref()?.overview.signs;
        let wanted = signs.iter().find(|it| it.gloss == gloss);
        wanted
            .and_then(|it| it.place)
            .or_else(|| signs.iter().find_map(|it| it.place))
    }

    fn beginning_page(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let Some(beginning) = &self.beginning else {
            return;
        };
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(words::TASK_OPENING.of(language));
            ui.weak(&beginning.far.task);
        });
        if let Some(share) = beginning.far.share() {
            ui.add(ProgressBar::new(share));
        }
        if ui.button(words::CANCEL.of(language)).clicked() {
            self.out.send(Command::StopBeginning);
        }
    }

    fn offers_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let offers: [Offer; 4] = [
            (
                words::START_STARTER,
                words::START_STARTER_HINT,
                Command::Do(Action::OpenStarter),
            ),
            (
                words::START_OPEN,
                words::START_OPEN_HINT,
                Command::Do(Action::Open),
            ),
            (
                words::START_IMPORT,
                words::START_IMPORT_HINT,
                Command::Choose(Choose::CorpusOfFolder),
            ),
            (
                words::START_NEW,
                words::START_NEW_HINT,
                Command::Do(Action::New),
            ),
        ];
        for (name, hint, command) in offers {
            let row = offer(ui, 46.0, name.of(language), hint.of(language));
            if !std::mem::replace(&mut self.start.come, true) {
                row.request_focus();
            }
            if row.clicked() {
                self.out.send(command);
            }
        }
    }

    fn path_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let label = ui.strong(words::START_TYPED.of(language));
        let field = edit::line(ui, &mut self.start.path, |field| {
            field.desired_width(f32::INFINITY)
        });
        let field = field.response.response.labelled_by(label.id);
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let path = PathBuf::from(self.start.path.trim());
        let can = uses(&self.start.path, path.is_file(), path.is_dir());
        let offers: [Typed; 3] = [
            (words::START_TYPED_OPEN, Begin::Open),
            (words::START_TYPED_NEW, Begin::New),
            (words::START_TYPED_IMPORT, Begin::Folder),
        ];
        ui.horizontal(|ui| {
            for (can, (text, begin)) in can.into_iter().zip(offers) {
                let button = ui.add_enabled(can, Button::new(text.of(language)));
                if button.clicked() || (can && entered) {
                    self.out.send(Command::Begin(begin(path.clone())));
                }
            }
        });
        ui.weak(words::START_DROP.of(language));
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            for (it, name) in Language::all_listed() {
                ui.selectable_value(&mut self.settings.language, it, name);
            }
            let steps = ui.button(Action::FirstSteps.row().name.of(language));
            if steps.clicked() {
                self.out.send(Command::Do(Action::FirstSteps));
            }
        });
    }

    fn recent_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ui.strong(Text::from_id("menu-bar-recent").of(language));
        for path in self.settings.recent.iter().take(RECENT) {
            let there = path.is_file();
            let (name, folder) = parts(path);
            let about = if there {
                folder
            } else {
                format!("{folder} · {}", words::START_GONE.of(language))
            };
            let label = fill(words::START_FORGET.of(language), &[("name", &name)]);
            let (row, forget) = ui
                .horizontal(|ui| {
                    let wide = (ui.available_width() - FORGET).max(0.0);
                    let size = vec2(wide, 40.0);
                    let row = ui.allocate_ui(size, |ui| {
                        ui.add_enabled_ui(there, |ui| offer(ui, 40.0, &name, &about))
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
                self.out.send(Command::Begin(Begin::Open(path.clone())));
            }
            if forget {
                let mut settings = self.settings.clone();
                settings.recent.retain(|it| it != path);
                self.out.send(Command::Settings(Box::new(settings)));
            }
        }
    }
}

/// Shows an offer in a frame.
fn offer(ui: &mut Ui, height: f32, name: &str, about: &str) -> Response {
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
fn parts(path: &Path) -> (String, String) {
    let text = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    (
        text(path.file_stem()),
        text(path.parent().map(Path::as_os_str)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_offers_its_possible_actions() {
        assert_eq!(uses("", false, true), [false; 3]);
        assert_eq!(uses("a.chereme", true, false), [true, false, false]);
        assert_eq!(uses("new", false, false), [false, true, false]);
        assert_eq!(
            parts(Path::new("/a/b.chereme")),
            ("b".to_owned(), "/a".to_owned())
        );
        assert_eq!(uses("folder", false, true), [false, false, true]);
    }
}
