//! `chereme studio`: starts the program of the window.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{self, ExitCode};

use anyhow::Result;
use chereme_corpus::CorpusError;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// The program that opens the window. It is a program of its own, so that this one is built without a window's crates.
const STUDIO_PROGRAM: &str = "chereme-studio";

/// Open the workbench: annotate, search and recombine in a window
///
/// Without a corpus the window offers the starter corpus, recent corpora, and the import of a folder. The settings are
/// in the file chereme/studio.json of the platform's settings folder; --language changes the language there. F1 shows
/// the keys: ELAN's, Praat's or a video editor's.
#[derive(Debug, clap::Args)]
pub(crate) struct StudioArgs {
    /// The corpus to open
    corpus: Option<PathBuf>,
    /// The folder for the settings and the starter corpus, instead of the platform's
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

pub(super) fn run(cli: &CommandLine, args: &StudioArgs, _: &mut CommandOutput) -> Result<ExitCode> {
    if let Some(corpus) = &args.corpus {
        // The window would open on an error that the terminal shows better.
        fs::metadata(corpus).map_err(|error| CorpusError::from_file_failure(corpus, error))?;
    }
    let program_path = env::current_exe().and_then(fs::canonicalize).ok();
    let program = find_studio_program(program_path.as_deref(), env::var_os("PATH").as_deref()).ok_or_else(|| {
        CorpusError::from_wrong_message("the window is a program of its own, chereme-studio, and neither the folder of this program nor the path has it")
            .with_error_place(program_path.as_deref().and_then(Path::parent).unwrap_or(Path::new(STUDIO_PROGRAM)).display().to_string())
            .with_advice("in a checkout, build it with `cargo build --release`; elsewhere, install it with `cargo install --path crates/chereme-studio`")
    })?;
    let mut command = process::Command::new(&program);
    command.args(cli.json.then_some("--json"));
    for (option, value) in [("--author", &cli.author), ("--language", &cli.language)] {
        command.args(value.iter().flat_map(|value| [option, value]));
    }
    if let Some(folder) = &args.folder {
        command.arg("--folder").arg(folder);
    }
    if let Some(corpus) = &args.corpus {
        command.arg("--").arg(corpus);
    }
    hand_over(&mut command).map_err(|error| CorpusError::from_file_failure(program, error).into())
}

/// Returns the program of the window: beside this program, whose path is `own`, or in a folder of `path`.
fn find_studio_program(own: Option<&Path>, path: Option<&OsStr>) -> Option<PathBuf> {
    let name = format!("{STUDIO_PROGRAM}{}", env::consts::EXE_SUFFIX);
    let own_folder = own.and_then(Path::parent).map(Path::to_owned);
    // An empty or relative folder of the path would be one of the user's current folder.
    let named = path.into_iter().flat_map(env::split_paths);
    let folders = own_folder
        .into_iter()
        .chain(named.filter(|folder| folder.is_absolute()));
    folders.map(|folder| folder.join(&name)).find(|file| file.is_file())
}

/// Replaces this program by the command; so signals, the terminal and the exit code are the window's.
#[cfg(unix)]
fn hand_over(command: &mut process::Command) -> io::Result<ExitCode> {
    use std::os::unix::process::CommandExt as _;
    Err(command.exec())
}

/// Runs the command, on systems that cannot replace a program, and returns its exit code.
#[cfg(not(unix))]
fn hand_over(command: &mut process::Command) -> io::Result<ExitCode> {
    let code = command.status()?.code();
    let code = code.and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_found_beside_the_program_and_then_on_the_path() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = format!("{STUDIO_PROGRAM}{}", env::consts::EXE_SUFFIX);
        let at = |room: &str| folder.path().join(room);
        for room in ["beside", "first", "second"] {
            fs::create_dir_all(at(room).join("folder")).expect("a folder");
        }
        let own = at("beside").join("chereme");
        let path = env::join_paths([PathBuf::new(), "here".into(), at("first"), at("second")]);
        let path = path.expect("a path");
        let found = || find_studio_program(Some(&own), Some(&path));
        assert_eq!(found(), None);
        assert_eq!(find_studio_program(None, None), None);
        // A folder of that name is no program.
        fs::create_dir(at("first").join(&name)).expect("a folder");
        for room in ["second", "beside"] {
            let program = at(room).join(&name);
            fs::write(&program, "").expect("a file");
            assert_eq!(found(), Some(program));
        }
    }
}
