//! The window for a path, in place of the file chooser that the system lacks.

use std::path::{Path, PathBuf};

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::{Align2, Button, Context, Id, Key, RichText, TextEdit, Window};

use crate::app::Studio;
use crate::file_dialogs::Choose;
use crate::panes::complete::Line;
use crate::panes::import::Paths;
use crate::words::{Text, fill, shell as words};
use crate::work::begin::with_extension;

/// The width of the window in points, if the window around it is wide enough.
const WIDE: f32 = 520.0;

/// The window that asks for a path.
#[derive(Default)]
pub(crate) struct TypedPath {
    /// The use of the path; `None` while the window is closed.
    what: Option<Choose>,
    text: String,
    /// Whether the field takes the keyboard.
    fresh: bool,
    paths: Paths,
}

impl TypedPath {
    /// Opens the window; `start` is the path that the field begins with.
    pub(crate) fn ask(&mut self, what: Choose, start: String) {
        *self = Self {
            what: Some(what),
            text: start,
            fresh: true,
            paths: Paths::default(),
        };
    }
}

/// Returns why the path cannot be used, with the name that the reason is about; `None` if it can.
fn why_not(what: Choose, path: &Path) -> Option<(Text, PathBuf)> {
    let missing = |there: bool| (!there).then(|| (words::PATH_MISSING, path.to_owned()));
    match what {
        Choose::Files | Choose::Answers => missing(path.exists()),
        Choose::Questionnaire
        | Choose::Report
        | Choose::SavePlan
        | Choose::AnswersTable
        | Choose::Disagreements => None,
        Choose::Corpus
        | Choose::Merge
        | Choose::Media(..)
        | Choose::Trials
        | Choose::Columns
        | Choose::Plan => missing(path.is_file()),
        Choose::Folder | Choose::CorpusOfFolder => missing(path.is_dir()),
        Choose::NewCorpus | Choose::Copy => {
            let target = with_extension(path.to_owned());
            let folder = target.parent().filter(|it| !it.as_os_str().is_empty());
            match folder {
                _ if target.exists() => Some((words::PATH_TAKEN, target)),
                Some(folder) if !folder.is_dir() => Some((words::PATH_MISSING, folder.to_owned())),
                _ => None,
            }
        }
    }
}

/// Returns the name of the button that uses the path.
fn button_text(what: Choose) -> Text {
    match what {
        Choose::Corpus => words::START_TYPED_OPEN,
        Choose::NewCorpus => words::START_TYPED_NEW,
        Choose::Copy => words::PATH_SAVE,
        Choose::Files | Choose::Folder | Choose::CorpusOfFolder => words::START_TYPED_IMPORT,
        Choose::Merge
        | Choose::Media(..)
        | Choose::Questionnaire
        | Choose::Answers
        | Choose::Report
        | Choose::Trials
        | Choose::Columns
        | Choose::Plan
        | Choose::SavePlan
        | Choose::AnswersTable
        | Choose::Disagreements => words::PATH_CHOOSE,
    }
}

/// Returns the path of a file that does not exist yet: the folder and the name, with a number if necessary.
fn free_name(folder: &Path, stem: &str) -> PathBuf {
    let name = |number: usize| match number {
        1 => folder.join(format!("{stem}.chereme")),
        _ => folder.join(format!("{stem}-{number}.chereme")),
    };
    let free = (1..1000).map(name).find(|path| !path.exists());
    free.unwrap_or_else(|| name(1000))
}

impl Studio {
    /// Opens the window for a path, because the system has no file chooser.
    pub(crate) fn ask_path(&mut self, what: Choose) {
        let corpus = self.corpus().cloned();
        let beside = corpus.as_deref().and_then(Path::parent).map(Path::to_owned);
        let here = beside.filter(|it| it.is_dir());
        let here = here.or_else(|| std::env::current_dir().ok());
        let here = here.unwrap_or_default();
        let start = match what {
            Choose::NewCorpus => free_name(&here, "corpus"),
            Choose::Copy => {
                let stem = corpus.as_deref().and_then(Path::file_stem);
                let stem = stem.unwrap_or_default().to_string_lossy();
                free_name(&here, &format!("{stem}-copy"))
            }
            // The separator at the end lets the list offer the contents of the folder.
            _ => here.join(""),
        };
        self.overlays
            .typed_path
            .ask(what, start.display().to_string());
    }

    /// Shows the window for a path while it is open; Enter and its button use the path, Escape closes it.
    pub(super) fn typing_path(&mut self, ctx: &Context) {
        let Some(what) = self.overlays.typed_path.what else {
            return;
        };
        let language = self.settings.language;
        let Self { overlays, out, .. } = self;
        let asking = &mut overlays.typed_path;
        let title = what.title().of(language);
        let (mut open, mut used) = (true, None);
        let window = Window::new(title)
            .id(Id::unique("typed path"))
            .open(&mut open)
            .pivot(Align2::CENTER_CENTER)
            .default_pos(ctx.content_rect().center())
            .constrain_to(ctx.content_rect())
            .resizable(false);
        window.show(ctx, |ui| {
            ui.set_width(WIDE.min(ctx.content_rect().width() - 40.0));
            let label = ui.label(words::NO_CHOOSER.of(language));
            let id = Id::unique("typed path field");
            if asking.fresh {
                let end = CCursor::new(asking.text.chars().count());
                let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
                state.cursor.set_char_range(Some(CCursorRange::one(end)));
                TextEdit::store_state(ui.ctx(), id, state);
            }
            let TypedPath {
                paths, text, fresh, ..
            } = &mut *asking;
            let typed = paths.show(ui, id, Line::default(), text);
            let entered =
                typed.response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
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
                let name = RichText::new(button_text(what).of(language)).strong();
                let button = ui.add_enabled(ready, Button::new(name));
                if button.clicked() || (entered && ready) {
                    used = Some(path);
                } else if entered {
                    asking.fresh = true;
                }
                if ui.button(words::CANCEL.of(language)).clicked() {
                    asking.what = None;
                }
            });
            if let Some((why, path)) = &wrong {
                let reason = fill(why.of(language), &[("path", &path.display())]);
                ui.weak(reason);
            }
        });
        if let Some(path) = used {
            asking.what = None;
            if let Some(command) = what.command(vec![path]) {
                out.send(command);
            }
        } else if !open || super::escaped(ctx) {
            asking.what = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::{NodeT, Queryable};

    use super::*;
    use crate::{Language, Options};
    use chereme_corpus::Corpus;

    type Driven<'a> = Harness<'a, Studio>;

    /// Returns a window on a system without a file chooser.
    fn window<'a>(corpus: Option<PathBuf>) -> Driven<'a> {
        let mut studio = Studio::new(Options {
            corpus,
            ..Options::default()
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
            Choose::Corpus,
            Choose::NewCorpus,
            Choose::Copy,
            Choose::CorpusOfFolder,
            Choose::Files,
            Choose::Folder,
            Choose::Merge,
            Choose::Media(1, None),
        ];
        for (language, _) in Language::ALL {
            let mut window = window(None);
            window.state_mut().settings.language = language;
            for what in uses {
                let command = crate::command::Command::Choose(what);
                window.state_mut().out.send(command);
                window.run_steps(4);
                let label = words::NO_CHOOSER.of(language);
                let field = window.get_by_role_and_label(eframe::egui::Role::TextInput, label);
                assert!(field.accesskit_node().is_focused(), "{what:?}");
                let title = what.title().of(language);
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
        drop(Corpus::create(&path, "A").expect("made"));
        let mut window = window(Some(path));
        window.state_mut().stands(false);
        window.run_steps(3);
        window.get_by_label("Save a copy…").click();
        window.run_steps(8);
        let label = words::NO_CHOOSER.of(Language::English);
        let field = window.get_by_role_and_label(eframe::egui::Role::TextInput, label);
        assert!(field.accesskit_node().is_focused());
    }

    #[test]
    fn a_copy_is_saved_to_the_proposed_and_to_a_typed_path() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("mine.chereme");
        drop(Corpus::create(&path, "A").expect("made"));
        let mut window = window(Some(path));
        let open = |window: &Driven<'_>| window.state().corpus().cloned();
        for (typed, target) in [
            (None, "mine-copy.chereme"),
            (Some("other"), "other.chereme"),
        ] {
            let command = crate::command::Command::Choose(Choose::Copy);
            window.state_mut().out.send(command);
            window.run_steps(4);
            if let Some(typed) = typed {
                // The file that is open now is there already, and is not replaced.
                let there = folder.path().join("mine.chereme");
                for (text, can) in [(there, false), (folder.path().join(typed), true)] {
                    window.state_mut().overlays.typed_path.text = text.display().to_string();
                    window.run_steps(2);
                    let save = window.get_by_label(words::PATH_SAVE.of(Language::English));
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
        for name in [
            "mine.chereme",
            "mine.chereme-shm",
            "mine.chereme-wal",
            "take.bvh",
        ] {
            std::fs::write(folder.path().join(name), "").expect("written");
        }
        std::fs::create_dir(folder.path().join("more")).expect("made");
        let base = format!("{}/", folder.path().display());
        let mut window = window(None);
        let command = crate::command::Command::Choose(Choose::Corpus);
        window.state_mut().out.send(command);
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
        assert_eq!(
            window.state().overlays.typed_path.text,
            format!("{base}more/")
        );
    }

    #[test]
    fn a_path_that_cannot_be_used_has_a_reason() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a.chereme"), "").expect("written");
        let cases = [
            (Choose::Corpus, "a.chereme", None),
            (Choose::Corpus, "b.chereme", Some(words::PATH_MISSING)),
            (Choose::Corpus, "", Some(words::PATH_MISSING)),
            (Choose::Folder, "", None),
            (Choose::Folder, "a.chereme", Some(words::PATH_MISSING)),
            (Choose::Files, "", None),
            (Choose::Copy, "b", None),
            (Choose::Copy, "a", Some(words::PATH_TAKEN)),
            (Choose::NewCorpus, "c/b", Some(words::PATH_MISSING)),
        ];
        for (what, name, want) in cases {
            let why = why_not(what, &at(name)).map(|it| it.0.of(Language::English));
            let want = want.map(|it| it.of(Language::English));
            assert_eq!(why, want, "{what:?} {name}");
        }
        assert_eq!(free_name(folder.path(), "a"), at("a-2.chereme"));
        assert_eq!(why_not(Choose::Copy, Path::new("b")), None, "a bare name");
    }
}
