//! Writes results to the terminal: tables and sentences for people, one JSON document for programs, progress bars.

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use anyhow::Result;
use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::words::{
    InterfaceLanguage, InterfaceText, counted_in, fill_text_braces, filled_message, trouble_words,
};
use chereme_corpus::{ProgressListener, ProgressReceiver, ProgressStep, ProgressUnit};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use serde_json::{Value, json};

use crate::{table, words};

/// A column of a table of items: its title, and the text of its cell for an item.
pub(crate) type ItemColumn<'c, T> = (&'c str, &'c dyn Fn(&T) -> String);

/// The output of a command. If its reader stops reading early, the program ends quietly.
pub(crate) struct CommandOutput {
    json: bool,
    /// The largest width of a table in letters; `None` for no limit.
    width: Option<usize>,
    language: InterfaceLanguage,
    document: Option<Value>,
    text: io::BufWriter<io::Stdout>,
}

impl CommandOutput {
    /// Returns an output whose tables are at most `width` letters wide; 0 sets no limit, `None` the terminal's width.
    pub(crate) fn new(json: bool, width: Option<usize>, language: InterfaceLanguage) -> Self {
        let terminal = || {
            let terminal = io::stdout().is_terminal().then(terminal_size::terminal_size);
            terminal.flatten().map(|(width, _)| usize::from(width.0))
        };
        Self {
            json,
            // A file or another program has no width, and neither has 0.
            width: width.or_else(terminal).filter(|width| *width > 0),
            language,
            document: None,
            text: io::BufWriter::new(io::stdout()),
        }
    }

    /// Returns whether a JSON document is wanted.
    pub(crate) fn is_json(&self) -> bool {
        self.json
    }

    /// Sets the JSON document, which replaces tables and sentences if JSON was requested.
    pub(crate) fn set_json_document(&mut self, document: impl Serialize) -> Result<()> {
        self.document = Some(serde_json::to_value(document)?);
        Ok(())
    }

    /// Suppresses all further lines, because a file is written to standard output.
    pub(crate) fn silence_output(&mut self) {
        self.json = false;
        self.document = None;
    }

    /// Writes a line for people, in the language of the output if the table of messages has it.
    pub(crate) fn write_output_line(&mut self, text: impl AsRef<str>) -> Result<()> {
        let text = text.as_ref();
        // Messages stand in the table without their indent.
        let words = text.trim_start();
        let indent = &text[..text.len() - words.len()];
        self.line_as_is(&format!("{indent}{}", self.translate_message(words)))
    }

    /// Writes a message for people: its English form, and the values of its blanks in their order, which stand in it as
    /// they are.
    pub(crate) fn filled_line(&mut self, form: &str, values: &[&dyn Display]) -> Result<()> {
        self.line_as_is(&filled_message(form, values, self.language))
    }

    /// Writes a text of the shared table with its blanks filled, in the language of the output.
    pub(crate) fn text_line(&mut self, text: InterfaceText, values: &[(&str, &dyn Display)]) -> Result<()> {
        self.line_as_is(&fill_text_braces(self.output_text(text), values))
    }

    /// Writes a line for people without a look into the table of messages, as for rows of a table.
    pub(crate) fn line_as_is(&mut self, text: &str) -> Result<()> {
        if !self.json {
            ignore_closed_pipe(writeln!(self.text, "{}", table::escape_terminal_text(text, true)))?;
        }
        Ok(())
    }

    /// Writes a table for people, with its titles in the language of the output.
    pub(crate) fn write_titled_table(&mut self, titles: &[&str], rows: &[Vec<String>]) -> Result<()> {
        let language = self.language;
        let titles = titles.iter().map(|title| words::title(title, language));
        self.write_named_columns(&titles.collect::<Vec<_>>(), rows)
    }

    /// Writes a table for people with a row for each item and its titles in the language of the output.
    pub(crate) fn write_item_table<'items, T: 'items>(
        &mut self,
        items: impl IntoIterator<Item = &'items T>,
        columns: &[ItemColumn<'_, T>],
    ) -> Result<()> {
        let titles: Vec<&str> = columns.iter().map(|(title, _)| *title).collect();
        let row = |item| columns.iter().map(|(_, cell)| cell(item)).collect();
        self.write_titled_table(&titles, &items.into_iter().map(row).collect::<Vec<_>>())
    }

    /// Writes a table for people under names that are the same in every language, shortened to the largest width.
    pub(crate) fn write_named_columns(&mut self, header: &[&str], rows: &[Vec<String>]) -> Result<()> {
        if self.json {
            return Ok(());
        }
        let table = table::lay_out_table(header, rows, self.width);
        for line in &table.lines {
            self.line_as_is(line)?;
        }
        if !table.left_out.is_empty() {
            let names = table.left_out.join(", ");
            self.filled_line("no room for: {names}; --width 0 shows all columns", &[&names])?;
        }
        Ok(())
    }

    /// Returns a count with its noun, such as `2 tokens`, in the language of the output.
    pub(crate) fn format_counted_noun(&self, count: u64, noun: &str) -> String {
        counted_in(count, noun, self.language)
    }

    /// Returns a message of the library in the language of the output; unchanged if there is no translation.
    pub(crate) fn translate_message(&self, text: &str) -> String {
        words::localized_message(text, self.language).unwrap_or_else(|| text.to_owned())
    }

    /// Writes a warning of the library in the language of the output.
    pub(crate) fn write_warning(&mut self, warning: &str) -> Result<()> {
        self.write_remark(trouble_words::WARNING, warning)
    }

    /// Writes several warnings of the library, one after the other.
    pub(crate) fn write_warnings<'w>(&mut self, warnings: impl IntoIterator<Item = &'w String>) -> Result<()> {
        warnings.into_iter().try_for_each(|warning| self.write_warning(warning))
    }

    /// Writes a note of the library in the language of the output.
    pub(crate) fn write_note(&mut self, note: &str) -> Result<()> {
        self.write_remark(trouble_words::NOTE, note)
    }

    /// Writes a remedy of the library in the language of the output.
    pub(crate) fn write_remedy(&mut self, remedy: &ErrorRemedy) -> Result<()> {
        self.write_remark(trouble_words::WHAT_TO_DO, remedy.remedy_text())
    }

    fn write_remark(&mut self, form: InterfaceText, remark: &str) -> Result<()> {
        let what = self.translate_message(remark);
        self.text_line(form, &[("what", &what)])
    }

    /// Returns a text of the shared table in the language of the output.
    pub(crate) fn output_text(&self, text: InterfaceText) -> &'static str {
        text.text_in_language(self.language)
    }

    /// Returns the language of the output.
    pub(crate) fn output_language(&self) -> InterfaceLanguage {
        self.language
    }

    /// Writes the JSON document, if any, and flushes the output.
    pub(crate) fn finish_output(&mut self) -> Result<()> {
        if self.json {
            let document = self.document.take().unwrap_or_else(|| json!({}));
            ignore_closed_pipe(serde_json::to_writer(&mut self.text, &document).map_err(io::Error::from))?;
            ignore_closed_pipe(writeln!(self.text))?;
        }
        ignore_closed_pipe(self.text.flush())
    }

    /// Reports why the work failed, and returns the exit code.
    pub(crate) fn report_command_failure(&mut self, error: &anyhow::Error) -> ExitCode {
        let corpus_error = error.downcast_ref::<chereme_corpus::CorpusError>();
        let place = corpus_error.and_then(chereme_corpus::CorpusError::error_place);
        let remedy = corpus_error.and_then(chereme_corpus::CorpusError::error_remedy);
        // The library's errors are whole sentences; others name their causes in a row.
        let message = corpus_error.map_or_else(|| format!("{error:#}"), ToString::to_string);
        let is_list = matches!(corpus_error, Some(chereme_corpus::CorpusError::Several { .. }));
        if self.json {
            self.document = Some(json!({
                "error": { "message": message, "where": place, "remedy": remedy }
            }));
            let _ = self.finish_output();
        } else {
            // Output that was written before the error comes out before it.
            let _ = self.text.flush();
            let spoken = |text: &str| self.translate_message(text);
            let label =
                |text: InterfaceText, value: String| fill_text_braces(self.output_text(text), &[("what", &value)]);
            let shown_message = match corpus_error.filter(|_| is_list) {
                Some(list) => list.spoken_error_message(self.language, &spoken),
                None => drawn_below(&message, &spoken),
            };
            write_to_stderr(&label(trouble_words::ERROR, shown_message));
            // A place that the message names already is not repeated.
            if let Some(place) = place.filter(|place| !message.contains(place.as_str())) {
                write_to_stderr(&label(trouble_words::WHERE, spoken(&place)));
            }
            if let Some(remedy) = remedy {
                write_to_stderr(&label(trouble_words::WHAT_TO_DO, spoken(remedy.remedy_text())));
            }
        }
        ExitCode::FAILURE
    }
}

/// Returns a message in the language of `spoken`. A drawing of the error's position that begins it (words, carets below
/// them, the error) stands at its end, so that text before the message cannot shift the carets.
fn drawn_below(message: &str, spoken: &dyn Fn(&str) -> String) -> String {
    let lines: Vec<&str> = message.splitn(3, '\n').collect();
    match lines[..] {
        [words, carets, reason] if carets.trim_start().starts_with('^') => {
            format!("{}\n{words}\n{carets}", spoken(reason))
        }
        _ => spoken(message),
    }
}

fn ignore_closed_pipe(done: io::Result<()>) -> Result<()> {
    match done {
        // The reader has seen enough, as with `head`: that is no failure.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => std::process::exit(0),
        other => Ok(other?),
    }
}

/// Writes a line on standard error.
pub(crate) fn write_to_stderr(text: &str) {
    let _ = writeln!(io::stderr(), "{}", table::escape_terminal_text(text, true));
}

/// Reports wrong usage, or prints the help.
pub(crate) fn report_usage_error(
    error: &clap::Error,
    json: bool,
    language: InterfaceLanguage,
    actions: &[String],
) -> ExitCode {
    if json && error.use_stderr() {
        let text = error.to_string();
        // Clap separates the error from its advice by an empty line.
        let (message, remedy) = text.split_once("\n\n").unwrap_or((&text, ""));
        let message = message.trim_start_matches("error: ").trim();
        let document = json!({ "error": { "message": message, "where": Value::Null, "remedy": remedy.trim() } });
        let _ = writeln!(io::stdout(), "{document}");
    } else if language == InterfaceLanguage::French && error.use_stderr() {
        print_stderr_note(&words::french_usage_message(&error.render().to_string()));
    } else {
        // A closed terminal is not an error.
        let _ = error.print();
    }
    if !json && error.kind() == clap::error::ErrorKind::UnknownArgument && !actions.is_empty() {
        let text = fill_text_braces(
            trouble_words::ACTIONS.text_in_language(language),
            &[("names", &actions.join(", "))],
        );
        print_stderr_note(&text);
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

/// Does long work while a progress bar is shown, which is gone when the work is done.
pub(crate) fn with_progress_bar<T>(work: impl FnOnce(&mut ProgressReceiver<'_>) -> T) -> T {
    work(&mut ProgressReceiver::new(&mut CommandProgressBar::new()))
}

/// A progress bar, shown only on a terminal.
pub(crate) struct CommandProgressBar {
    bar: ProgressBar,
    unit: Option<ProgressUnit>,
}

impl CommandProgressBar {
    pub(crate) fn new() -> Self {
        let target = if io::stderr().is_terminal() {
            ProgressDrawTarget::stderr_with_hz(10)
        } else {
            ProgressDrawTarget::hidden()
        };
        // If no handler can be installed, Ctrl-C ends the program at once, which does not damage a corpus.
        static INTERRUPT_LISTENER: Once = Once::new();
        INTERRUPT_LISTENER.call_once(|| drop(ctrlc::set_handler(interrupted)));
        ACTIVE_BAR_COUNT.fetch_add(1, Ordering::Relaxed);
        let bar = ProgressBar::with_draw_target(None, target);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, unit: None }
    }
}

impl ProgressListener for CommandProgressBar {
    /// Shows a step; after Ctrl-C it asks the work to stop, which leaves the corpus as it was.
    fn hear_progress_step(&mut self, step: ProgressStep<'_>) -> ControlFlow<()> {
        if self.unit != Some(step.unit) {
            self.unit = Some(step.unit);
            let counts = match step.unit {
                ProgressUnit::Bytes => "{bytes}/{total_bytes} {bytes_per_sec}",
                ProgressUnit::Frames => "{pos}/{len} frames",
                ProgressUnit::Items => "{pos}/{len}",
            };
            let template = format!("{{msg:24}} [{{bar:32}}] {counts} {{eta}}");
            if let Ok(style) = ProgressStyle::with_template(&template) {
                self.bar.set_style(style.progress_chars("=> "));
            }
        }
        self.bar.set_length(step.total.unwrap_or(step.done));
        self.bar.set_position(step.done);
        // Setting a message redraws the bar, which steps of one task come too often for.
        if self.bar.message() != step.task {
            self.bar.set_message(step.task.to_owned());
        }
        if STOP_REQUESTED.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Prints a note that another program is writing to the corpus.
pub(crate) fn print_waiting_note() {
    print_stderr_note("waiting up to 20 seconds for another program that is writing to the corpus ...");
}

/// Prints a line on standard error.
fn print_stderr_note(text: &str) {
    // A closed terminal is not an error.
    let _ = writeln!(io::stderr(), "{text}");
}

static STOP_REQUESTED: AtomicBool = AtomicBool::new(false);
static ACTIVE_BAR_COUNT: AtomicUsize = AtomicUsize::new(0);

/// Handles Ctrl-C: the first one asks long work to stop; a second one, or one without long work, ends the program.
fn interrupted() {
    // 130 is what shells expect of a program that Ctrl-C ended.
    if ACTIVE_BAR_COUNT.load(Ordering::Relaxed) == 0 || STOP_REQUESTED.swap(true, Ordering::Relaxed) {
        std::process::exit(130);
    }
    print_stderr_note("stopping; Ctrl-C again ends the program at once");
}

impl Drop for CommandProgressBar {
    fn drop(&mut self) {
        ACTIVE_BAR_COUNT.fetch_sub(1, Ordering::Relaxed);
        self.bar.finish_and_clear();
    }
}
