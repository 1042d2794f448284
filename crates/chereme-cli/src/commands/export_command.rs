//! `chereme export`: writes movement, tiers, tables or the whole database as files.

use std::path::{Path, PathBuf};
use std::{fs, io};

use anyhow::{Context, Result};
use chereme_corpus::{Corpus, CorpusError, ExportOptions, ExportWhat, MovementForm, SearchOptions};

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar, write_to_stderr};
use crate::streams;

/// Export movement, annotations, tables, or the whole enriched database
///
/// The extension of --to determines the format: .bvh (movement of a recording or token), .glb (a person with that
/// movement as glTF, for Blender and the web, with the annotations; .bones.glb without the person), .vrma (movement for
/// avatars), .c3d, .trc or .markers.csv (markers), .eaf, .TextGrid or .xra (a recording's tiers, for ELAN, Praat or
/// SPPAS), .elan.txt (the same as ELAN's tab-delimited text), .srt or .vtt (its translations or glosses as subtitles,
/// one language a file; tier:12 names one), .csv or .tsv (tokens with all components), .curves.csv (the strength of
/// each non-manual, frame by frame), .livelink.csv (a captured face with its timecodes, as Live Link Face writes it for
/// Unreal), .sigml (notated signs as gestural SiGML), .hsigml (the same as HamNoSys's symbols), .hns or .txt (the same
/// as HamNoSys text, one sign on each line), and, if the program was built with `--features parquet`, .parquet (tokens
/// for pandas, polars and DuckDB), .components.parquet, .annotations.parquet and .frames.parquet (a row for each value,
/// each annotation, or each joint in each frame). A name without an extension is a folder: with --format it gets a file
/// of that format for each recording or token that has something for it. Without --format `all` writes into it the
/// database, a data dictionary with example queries, a file for each table, the recordings, the inventories, checksums
/// and provenance. With --to - the file goes to standard output. An EAF file that nobody changed comes back byte for
/// byte, and an edit changes only its own lines. The same corpus always gives the same bytes.
///
/// Everything is written for those who keep the corpus, with a note that names who has not agreed that others see it.
/// With --for research or --for public only what all contributors agreed to (`chereme consent`) is written; what is left
/// out is listed, with the reason. LICENCES.md, provenance.json and the copyright of a .glb hold the terms of all who
/// contributed to a recording, or that it may not be shared. A copy of everything has no history unless
/// --with-history is given, and one for others has no studies or saved searches.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme export mine.chereme all --to shared/ --for research
  chereme export mine.chereme recording:3 --to take.bvh
  chereme export mine.chereme 'query:right.configuration=U' --to takes/ --format bvh
  chereme export mine.chereme ESCARGOT LIMACE token:41 --to takes/ --format bvh
  chereme export mine.chereme ESCARGOT --to snail.bvh --skeleton mixamo --fps 30
  chereme export mine.chereme all --to mine.frames.parquet
  chereme export mine.chereme all --to - --format csv | head")]
pub(crate) struct ExportArgs {
    /// The corpus
    corpus: PathBuf,
    /// What to export: all, a gloss, token:41, recording:3, tier:12, inventory:configurations (as .json), or
    /// query:'right.configuration=U'; several are written together
    #[arg(required = true)]
    what: Vec<String>,
    /// The file or folder to write; - is standard output
    #[arg(long, value_name = "PATH")]
    to: PathBuf,
    /// The format, such as bvh or csv; needed with --to -, and to write several files into a folder
    #[arg(long, value_name = "FORMAT")]
    format: Option<String>,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
    /// In a table write an apostrophe before cells that a spreadsheet would take for formulas
    #[arg(long)]
    spreadsheet_safe: bool,
    /// For whom it is written: what people did not agree to show them is left out and listed
    #[arg(long = "for", value_name = "AUDIENCE", default_value = "me", value_parser = ["me", "research", "public"])]
    audience: String,
    /// In .bvh and .glb: move the bones of these avatars instead of the captured ones: mixamo, rigify, smplx, ue5, unity,
    /// vrm, or a file with a table of bones
    #[arg(long, value_name = "NAME|FILE")]
    skeleton: Option<String>,
    /// The frames a second of .bvh, .glb and .vrma, such as 30; without it, those of the capture
    #[arg(long, value_name = "N")]
    fps: Option<f64>,
    /// In .bvh, .glb and .vrma: keep the hips above their first place
    #[arg(long)]
    in_place: bool,
    /// With all and no format: copy the history, too, with everything that was deleted or changed
    #[arg(long)]
    with_history: bool,
}

pub(super) fn run(cli: &CommandLine, args: &ExportArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let what = parse_export_what(&mut corpus, &args.what)?;
    let options = ExportOptions {
        force: args.force,
        format: args.format.clone(),
        spreadsheet_safe: args.spreadsheet_safe,
        audience: args.audience.parse()?,
        with_history: args.with_history,
        movement: read_movement_form(args)?,
    };
    if streams::is_standard(&args.to) {
        streams::not_with_json(output.is_json())?;
        // A file has its format in its extension; a pipe has none.
        if args.format.is_none() {
            return Err(
                CorpusError::from_wrong_message("standard output has no extension that says the format")
                    .with_error_place("-")
                    .with_advice("name it, as with --format csv")
                    .into(),
            );
        }
        let mut out = streams::StdoutDocument::new();
        let notes = with_progress_bar(|progress| corpus.export_stream(&what, options, &mut out, progress))?;
        io::Write::flush(&mut out)?;
        for note in notes {
            // Notes must not get into the file that standard output is.
            write_to_stderr(&format!("note: {}", output.translate_message(&note)));
        }
        output.silence_output();
        return Ok(());
    }
    let report = with_progress_bar(|progress| corpus.export_corpus(&what, &args.to, &options, progress))?;
    match report.files.as_slice() {
        [one] => output.filled_line(
            "wrote {path}, {size} KB",
            &[&one.path.display(), &one.bytes.div_ceil(1024)],
        )?,
        files => {
            let bytes: u64 = files.iter().map(|file| file.bytes).sum();
            let megabytes = bytes as f64 / 1e6;
            output.filled_line(
                "wrote {n}, {size} MB, to {path}",
                &[
                    &output.format_counted_noun(files.len() as u64, "files"),
                    &format_args!("{:.1}", megabytes),
                    &args.to.display(),
                ],
            )?;
        }
    }
    for note in &report.notes {
        output.write_note(note)?;
    }
    output.set_json_document(report)
}

/// Reads the form of movement; an avatar that is not known by name is a file with a table of bones.
fn read_movement_form(args: &ExportArgs) -> Result<MovementForm> {
    let avatar = args.skeleton.as_deref();
    let table = match avatar.map(Path::new).filter(|path| path.is_file()) {
        Some(path) => Some(fs::read_to_string(path).with_context(|| path.display().to_string())?),
        None => None,
    };
    Ok(MovementForm::read_movement_form(
        table.as_deref().or(avatar),
        args.fps,
        args.in_place,
    )?)
}

/// Reads what to export: all, addresses, or queries.
fn parse_export_what(corpus: &mut Corpus, words: &[String]) -> Result<ExportWhat> {
    match words {
        [one] if one == "all" => return Ok(ExportWhat::All),
        [one] => {
            if let Some(query) = one.strip_prefix("query:") {
                return Ok(ExportWhat::Tokens(find_exported_tokens(corpus, query)?));
            }
            if let Some(name) = one.strip_prefix("inventory:") {
                return Ok(ExportWhat::Inventory(name.to_owned()));
            }
            return Ok(ExportWhat::Address(one.parse()?));
        }
        _ => {}
    }
    let mut addresses = Vec::new();
    for word in words {
        match word.strip_prefix("query:") {
            Some(query) => addresses.extend(
                find_exported_tokens(corpus, query)?
                    .into_iter()
                    .map(chereme_corpus::CorpusAddress::Token),
            ),
            None => addresses.push(word.parse()?),
        }
    }
    Ok(ExportWhat::Several(addresses))
}

fn find_exported_tokens(corpus: &mut Corpus, query: &str) -> Result<Vec<i64>> {
    let options = SearchOptions {
        facets: false,
        ..SearchOptions::default()
    };
    let answer = corpus.search_tokens(query, &options)?;
    Ok(answer.hits.iter().map(|hit| hit.token).collect())
}
