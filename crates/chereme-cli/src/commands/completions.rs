//! `chereme completions` and `chereme man`: scripts for shells, and manual pages.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::CorpusError;
use clap::CommandFactory;
use clap_complete::Shell;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Write the completion script of a shell to standard output
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme completions bash > ~/.local/share/bash-completion/completions/chereme
  chereme completions zsh > ~/.zfunc/_chereme
  chereme completions fish > ~/.config/fish/completions/chereme.fish
  chereme completions powershell >> $PROFILE")]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Write the manual pages for the program `man`
#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// The folder for the pages, one for each command; without it the page of the whole program goes to standard output
    #[arg(long, value_name = "FOLDER")]
    to: Option<PathBuf>,
}

pub(super) fn run(_: &CommandLine, args: &CompletionsArgs, output: &mut CommandOutput) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut CommandLine::command(), "chereme", &mut script);
    let script = String::from_utf8(script)?;
    output.line_as_is(script.trim_end())?;
    output.set_json_document(serde_json::json!({ "shell": args.shell.to_string(), "script": script }))
}

pub(super) fn write_man_pages(_: &CommandLine, args: &ManArgs, output: &mut CommandOutput) -> Result<()> {
    let Some(folder) = &args.to else {
        let mut page = Vec::new();
        clap_mangen::Man::new(CommandLine::command()).render(&mut page)?;
        let page = String::from_utf8(page)?;
        output.line_as_is(page.trim_end())?;
        return output.set_json_document(serde_json::json!({ "page": page }));
    };
    let fault = |error| CorpusError::from_file_failure(folder, error);
    std::fs::create_dir_all(folder).map_err(fault)?;
    let mut root_command = CommandLine::command();
    root_command.build();
    let mut files = Vec::new();
    let mut write = |command: clap::Command| -> Result<()> {
        let page = clap_mangen::Man::new(command);
        let path = folder.join(page.get_filename());
        let mut file = std::fs::File::create(&path).map_err(fault)?;
        page.render(&mut file)?;
        file.flush().map_err(fault)?;
        files.push(path);
        Ok(())
    };
    for command in root_command.get_subcommands() {
        // Clap wants names that live as long as the program, which ends after these few.
        let name: &'static str = format!("chereme-{}", command.get_name()).leak();
        write(command.clone().name(name))?;
    }
    write(root_command)?;
    let count = output.format_counted_noun(files.len() as u64, "files");
    output.filled_line("wrote {n} to {path}", &[&count, &folder.display()])?;
    output.set_json_document(serde_json::json!({ "files": files }))
}
