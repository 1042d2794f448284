//! The window for a path, in place of the file chooser that the system lacks.

use std::path::{Path, PathBuf};

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::{Align2, Button, Context, Id, Key, RichText, TextEdit, Window};

use crate::command::{ChooserPurpose, CommandOutbox};
use crate::panes::complete_pane::CompletionLine;
use crate::panes::import::PathCompletions;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, shell as words};
use crate::work::begin::with_extension;

/// The width of the window in points, if the window around it is wide enough.
const PATH_WINDOW_WIDTH: f32 = 520.0;

/// The window that asks for a path.
#[derive(Default)]
pub(crate) struct TypedPath {
    /// The use of the path; `None` while the window is closed.
    what: Option<ChooserPurpose>,
    text: String,
    /// Whether the field takes the keyboard.
    fresh: bool,
    paths: PathCompletions,
}

impl TypedPath {
    /// Opens the window, because the system has no file chooser; the field begins with a path beside the corpus.
    pub(crate) fn ask_for_path(&mut self, what: ChooserPurpose, corpus: Option<&Path>) {
        let corpus_folder = corpus.and_then(Path::parent).map(Path::to_owned);
        let existing_folder = corpus_folder.filter(|folder| folder.is_dir());
        let here = existing_folder.or_else(|| std::env::current_dir().ok());
        let here = here.unwrap_or_default();
        let start = match what {
            ChooserPurpose::NewCorpus => free_file_path(&here, "corpus"),
            ChooserPurpose::Copy => {
                let raw_stem = corpus.and_then(Path::file_stem);
                let stem = raw_stem.unwrap_or_default().to_string_lossy();
                free_file_path(&here, &format!("{stem}-copy"))
            }
            // The separator at the end lets the list offer the contents of the folder.
            _ => here.join(""),
        };
        *self = Self {
            what: Some(what),
            text: start.display().to_string(),
            fresh: true,
            paths: PathCompletions::default(),
        };
    }

    /// Shows the window while it is open; Enter and its button use the path, Escape closes it.
    pub(crate) fn ui(&mut self, ctx: &Context, language: InterfaceLanguage, out: &CommandOutbox) {
        let Some(what) = self.what else {
            return;
        };
        let title = what.chooser_title().text_in_language(language);
        let (mut open, mut used) = (true, None);
        let window = Window::new(title)
            .id(Id::unique("typed path"))
            .open(&mut open)
            .pivot(Align2::CENTER_CENTER)
            .default_pos(ctx.content_rect().center())
            .constrain_to(ctx.content_rect())
            .resizable(false);
        window.show(ctx, |ui| {
            ui.set_width(PATH_WINDOW_WIDTH.min(ctx.content_rect().width() - 40.0));
            let label = ui.label(words::NO_CHOOSER.text_in_language(language));
            let id = Id::unique("typed path field");
            if self.fresh {
                let end = CCursor::new(self.text.chars().count());
                let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
                state.cursor.set_char_range(Some(CCursorRange::one(end)));
                TextEdit::store_state(ui.ctx(), id, state);
            }
            let TypedPath { paths, text, fresh, .. } = &mut *self;
            let typed = paths.show_path_field(ui, id, CompletionLine::default(), text);
            let entered = typed.response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            // The window is measured first, and cannot have the keyboard then.
            if *fresh {
                typed.response.request_focus();
                *fresh = ui.is_sizing_pass();
            }
            typed.response.labelled_by(label.id);
            let path = PathBuf::from(text.trim());
            let empty = path.as_os_str().is_empty();
            let wrong = (!empty).then(|| why_not(what, &path)).flatten();
            ui.horizontal(|ui| {
                let ready = !empty && wrong.is_none();
                let name = RichText::new(button_text(what).text_in_language(language)).strong();
                let button = ui.add_enabled(ready, Button::new(name));
                if button.clicked() || (entered && ready) {
                    used = Some(path);
                } else if entered {
                    self.fresh = true;
                }
                if ui.button(words::CANCEL.text_in_language(language)).clicked() {
                    self.what = None;
                }
            });
            if let Some((why, path)) = &wrong {
                let reason = fill_text_braces(why.text_in_language(language), &[("path", &path.display())]);
                ui.weak(reason);
            }
        });
        if let Some(path) = used {
            self.what = None;
            if let Some(command) = what.command_for_paths(vec![path]) {
                out.send_command(command);
            }
        } else if !open || super::take_escape_key(ctx) {
            self.what = None;
        }
    }
}

/// Returns why the path cannot be used, with the name that the reason is about; `None` if it can.
fn why_not(what: ChooserPurpose, path: &Path) -> Option<(InterfaceText, PathBuf)> {
    let missing = |there: bool| (!there).then(|| (words::PATH_MISSING, path.to_owned()));
    match what {
        ChooserPurpose::Files | ChooserPurpose::Answers => missing(path.exists()),
        ChooserPurpose::Questionnaire
        | ChooserPurpose::Report
        | ChooserPurpose::SavePlan
        | ChooserPurpose::AnswersTable
        | ChooserPurpose::Disagreements => None,
        ChooserPurpose::Corpus
        | ChooserPurpose::Merge
        | ChooserPurpose::Media(..)
        | ChooserPurpose::Trials
        | ChooserPurpose::Columns
        | ChooserPurpose::Plan => missing(path.is_file()),
        ChooserPurpose::Folder | ChooserPurpose::CorpusOfFolder => missing(path.is_dir()),
        ChooserPurpose::NewCorpus | ChooserPurpose::Copy => {
            let target = with_extension(path.to_owned());
            let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
            match folder {
                _ if target.exists() => Some((words::PATH_TAKEN, target)),
                Some(folder) if !folder.is_dir() => Some((words::PATH_MISSING, folder.to_owned())),
                _ => None,
            }
        }
    }
}

/// Returns the name of the button that uses the path.
fn button_text(what: ChooserPurpose) -> InterfaceText {
    match what {
        ChooserPurpose::Corpus => words::START_TYPED_OPEN,
        ChooserPurpose::NewCorpus => words::START_TYPED_NEW,
        ChooserPurpose::Copy => words::PATH_SAVE,
        ChooserPurpose::Files | ChooserPurpose::Folder | ChooserPurpose::CorpusOfFolder => words::START_TYPED_IMPORT,
        ChooserPurpose::Merge
        | ChooserPurpose::Media(..)
        | ChooserPurpose::Questionnaire
        | ChooserPurpose::Answers
        | ChooserPurpose::Report
        | ChooserPurpose::Trials
        | ChooserPurpose::Columns
        | ChooserPurpose::Plan
        | ChooserPurpose::SavePlan
        | ChooserPurpose::AnswersTable
        | ChooserPurpose::Disagreements => words::PATH_CHOOSE,
    }
}

/// Returns the path of a file that does not exist yet: the folder and the name, with a number if necessary.
fn free_file_path(folder: &Path, stem: &str) -> PathBuf {
    let name = |number: usize| match number {
        1 => folder.join(format!("{stem}.chereme")),
        _ => folder.join(format!("{stem}-{number}.chereme")),
    };
    let free = (1..1000).map(name).find(|path| !path.exists());
    free.unwrap_or_else(|| name(1000))
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::{NodeT, Queryable};

    use super::*;
    use crate::StudioOptions;
    use crate::app::Studio;
    use chereme_corpus::Corpus;

    type Driven<'a> = Harness<'a, Studio>;

    /// Returns a window on a system without a file chooser.
    fn window<'a>(corpus: Option<PathBuf>) -> Driven<'a> {
        let mut studio = Studio::new(StudioOptions {
            corpus,
            ..StudioOptions::default()
        });
        studio.chooser.show = |_, _| Box::pin(async { Vec::new() });
        let mut window = Harness::builder()
            .with_size([1000.0, 700.0])
            .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), studio);
        window.step();
        idle(&mut window);
        window
    }

    fn idle(window: &mut Driven<'_>) {
        for _ in 0..12_000 {
            window.step();
            if window.state().is_idle() {
                window.run_steps(2);
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        panic!("never idle");
    }

    fn press(window: &mut Driven<'_>, key: Key) {
        window.key_press(key);
        window.run_steps(2);
    }

    #[test]
    fn without_a_file_chooser_every_command_asks_for_a_path_in_a_field() {
        let uses = [
            ChooserPurpose::Corpus,
            ChooserPurpose::NewCorpus,
            ChooserPurpose::Copy,
            ChooserPurpose::CorpusOfFolder,
            ChooserPurpose::Files,
            ChooserPurpose::Folder,
            ChooserPurpose::Merge,
            ChooserPurpose::Media(1, None),
        ];
        for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
            let mut window = window(None);
            window.state_mut().settings.language = language;
            for what in uses {
                let command = crate::command::WindowCommand::Choose(what);
                window.state_mut().out.send_command(command);
                window.run_steps(4);
                let label = words::NO_CHOOSER.text_in_language(language);
                let field = window.get_by_role_and_label(eframe::egui::Role::TextInput, label);
                assert!(field.accesskit_node().is_focused(), "{what:?}");
                let title = what.chooser_title().text_in_language(language);
                assert!(window.query_all_by_label(title).next().is_some());
                press(&mut window, Key::Escape);
                assert!(window.query_by_label(label).is_none(), "Escape closes it");
            }
        }
    }

    #[test]
    fn the_field_has_the_keyboard_after_a_click_on_a_notice_too() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("mine.chereme");
        drop(Corpus::create_corpus(&path, "A").expect("made"));
        let mut window = window(Some(path));
        window.state_mut().report_corpus_file_standing(false);
        window.run_steps(3);
        window.get_by_label("Save a copy…").click();
        window.run_steps(8);
        let label = words::NO_CHOOSER.text_in_language(InterfaceLanguage::English);
        let field = window.get_by_role_and_label(eframe::egui::Role::TextInput, label);
        assert!(field.accesskit_node().is_focused());
    }

    #[test]
    fn a_copy_is_saved_to_the_proposed_and_to_a_typed_path() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("mine.chereme");
        drop(Corpus::create_corpus(&path, "A").expect("made"));
        let mut window = window(Some(path));
        let open = |window: &Driven<'_>| window.state().shown_corpus_path().cloned();
        for (typed, target) in [(None, "mine-copy.chereme"), (Some("other"), "other.chereme")] {
            let command = crate::command::WindowCommand::Choose(ChooserPurpose::Copy);
            window.state_mut().out.send_command(command);
            window.run_steps(4);
            if let Some(typed) = typed {
                // The file that is open now is there already, and is not replaced.
                let there = folder.path().join("mine.chereme");
                for (text, can) in [(there, false), (folder.path().join(typed), true)] {
                    window.state_mut().overlays.typed_path.text = text.display().to_string();
                    window.run_steps(2);
                    let save = window.get_by_label(words::PATH_SAVE.text_in_language(InterfaceLanguage::English));
                    assert_eq!(save.accesskit_node().is_disabled(), !can, "{text:?}");
                }
            }
            press(&mut window, Key::Enter);
            let target = folder.path().join(target);
            for _ in 0..2_000 {
                window.step();
                if open(&window).as_ref() == Some(&target) {
                    break;
                }
                std::thread::sleep(std::time::Duration::from_millis(5));
            }
            assert_eq!(open(&window), Some(target), "the copy is open");
            idle(&mut window);
        }
    }

    #[test]
    fn paths_are_completed_before_a_corpus_is_open_and_without_its_companions() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["mine.chereme", "mine.chereme-shm", "mine.chereme-wal", "take.bvh"] {
            std::fs::write(folder.path().join(name), "").expect("written");
        }
        std::fs::create_dir(folder.path().join("more")).expect("made");
        let base = format!("{}/", folder.path().display());
        let mut window = window(None);
        let command = crate::command::WindowCommand::Choose(ChooserPurpose::Corpus);
        window.state_mut().out.send_command(command);
        window.run_steps(4);
        window.state_mut().overlays.typed_path.text = format!("{base}m");
        let there = |window: &Driven<'_>, name: &str| {
            let label = format!("{base}{name}");
            window.query_all_by_label(&label).next().is_some()
        };
        for _ in 0..2_000 {
            window.step();
            if there(&window, "mine.chereme") {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        for (name, want) in [
            ("mine.chereme", true),
            ("more/", true),
            ("mine.chereme-shm", false),
            ("mine.chereme-wal", false),
        ] {
            assert_eq!(there(&window, name), want, "{name}");
        }
        // An arrow chooses the folder, which comes first; then its contents are offered.
        press(&mut window, Key::ArrowDown);
        press(&mut window, Key::Enter);
        assert_eq!(window.state().overlays.typed_path.text, format!("{base}more/"));
    }

    #[test]
    fn a_path_that_cannot_be_used_has_a_reason() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a.chereme"), "").expect("written");
        let cases = [
            (ChooserPurpose::Corpus, "a.chereme", None),
            (ChooserPurpose::Corpus, "b.chereme", Some(words::PATH_MISSING)),
            (ChooserPurpose::Corpus, "", Some(words::PATH_MISSING)),
            (ChooserPurpose::Folder, "", None),
            (ChooserPurpose::Folder, "a.chereme", Some(words::PATH_MISSING)),
            (ChooserPurpose::Files, "", None),
            (ChooserPurpose::Copy, "b", None),
            (ChooserPurpose::Copy, "a", Some(words::PATH_TAKEN)),
            (ChooserPurpose::NewCorpus, "c/b", Some(words::PATH_MISSING)),
        ];
        for (what, name, want) in cases {
            let why = why_not(what, &at(name)).map(|it| it.0.text_in_language(InterfaceLanguage::English));
            let want = want.map(|it| it.text_in_language(InterfaceLanguage::English));
            assert_eq!(why, want, "{what:?} {name}");
        }
        assert_eq!(free_file_path(folder.path(), "a"), at("a-2.chereme"));
        assert_eq!(why_not(ChooserPurpose::Copy, Path::new("b")), None, "a bare name");
    }
}
