//! `chereme demo`: the main job on the starter corpus.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use chereme_corpus::{
    Corpus, ExportOptions, ExportWhat, ImportOptions, PictureOptions, Progress, SearchOptions,
    starter_files, unpack_starter,
};
use serde_json::{Value, json};

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Do the main job on the starter corpus: build, search, recombine, store, draw, export
///
/// The starter corpus was made by a program, not captured; it is part of this one.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The folder for the results of the demo; else a new one in the current folder
    dir: Option<PathBuf>,
}

/// What the demo makes: gloss, recipe, and what it shows.
const MADE: [(&str, &str, &str); 3] = [
    (
        "LIMACE",
        "ESCARGOT | configure right U",
        "the slug is the snail with another handshape",
    ),
    (
        "BOL-À-GAUCHE",
        "BOL | place both by left 25cm",
        "the bowl stands on the left",
    ),
    ("FONCÉ", "CLAIR | reverse", "dark is light played backwards"),
];

const ASKED: [(&str, &str); 2] = [
    ("right.configuration=Y", "by handshape"),
    ("placement=head", "by placement"),
];

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let folder = folder(args.dir.as_deref())?;
    let mut demo = Demo {
        path: folder.join("starter.chereme"),
        corpus: None,
        folder,
        steps: Vec::new(),
    };
    demo.build(cli, output)?;
    demo.search(output)?;
    demo.recombine(output)?;
    demo.draw(output)?;
    demo.export(output)?;
    demo.next(output)?;
    output.document(json!({ "folder": demo.folder, "corpus": demo.path, "steps": demo.steps }))
}

/// The folder that was named, empty or not there yet, or a new one.
fn folder(named: Option<&Path>) -> Result<PathBuf> {
    if let Some(named) = named {
        let taken = named
            .read_dir()
            .is_ok_and(|mut entries| entries.next().is_some());
        if taken || named.is_file() {
            bail!(
                "{} is there already; name an empty folder or a new one",
                named.display()
            );
        }
        return Ok(named.to_owned());
    }
    let name = |count: usize| match count {
        1 => PathBuf::from("chereme-demo"),
        _ => PathBuf::from(format!("chereme-demo-{count}")),
    };
    (1..10_000)
        .map(name)
        .find(|path| !path.exists())
        .context("no folder name is free here")
}

/// The recipes of the starter corpus, as gloss and recipe.
fn recipes() -> Vec<(String, String)> {
    let file = starter_files().find(|(name, _)| *name == Path::new("recipes.txt"));
    let text = file.map_or_else(Default::default, |(_, bytes)| {
        String::from_utf8_lossy(bytes)
    });
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| line.split_once(" = "))
        .map(|(gloss, recipe)| (gloss.trim().to_owned(), recipe.trim().to_owned()))
        .collect()
}

struct Demo {
    folder: PathBuf,
    path: PathBuf,
    corpus: Option<Corpus>,
    steps: Vec<Value>,
}

impl Demo {
    fn corpus(&mut self) -> Result<&mut Corpus> {
        self.corpus.as_mut().context("the corpus is built first")
    }

    fn build(&mut self, cli: &Cli, output: &mut Output) -> Result<()> {
        let files = self.folder.join("starter");
        let unpacked = unpack_starter(&files)?;
        output.line(format!(
            "1. The starter corpus: {} in {}",
            output.counted(unpacked.len() as u64, "files"),
            files.display()
        ))?;
        let mut corpus = Corpus::create(&self.path, &cli.author())?;
        let mut bar = Bar::new();
        let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
        let report = corpus.import(
            &[files],
            &ImportOptions::default(),
            &mut Progress::new(&mut hear),
        )?;
        drop(bar);
        let made: Vec<String> = report
            .created
            .iter()
            .map(|(what, count)| output.counted(*count, what))
            .collect();
        output.line(format!(
            "   built {}: {}",
            self.path.display(),
            made.join(", ")
        ))?;
        if report.has_refusals() {
            bail!(
                "files of the starter corpus were refused: {:?}",
                report.files
            );
        }
        self.steps
            .push(json!({ "step": "build", "created": report.created }));
        self.corpus = Some(corpus);
        Ok(())
    }

    fn search(&mut self, output: &mut Output) -> Result<()> {
        for (query, what) in ASKED {
            let answer = self.corpus()?.search(query, &SearchOptions::default())?;
            let glosses: Vec<&str> = answer.hits.iter().map(|hit| hit.gloss.as_str()).collect();
            output.line(format!(
                "2. Search {what}, {query}: {}",
                output.counted(answer.total as u64, "tokens")
            ))?;
            output.line(format!("   {}", glosses.join(", ")))?;
            if answer.total == 0 {
                bail!("the starter corpus has no answer to {query}");
            }
            self.steps
                .push(json!({ "step": "search", "query": query, "glosses": glosses }));
        }
        Ok(())
    }

    fn recombine(&mut self, output: &mut Output) -> Result<()> {
        for (gloss, recipe, why) in MADE {
            let made = self.corpus()?.recombine(recipe, gloss)?;
            let token = made.token.context("a stored sign has a token")?;
            output.line(format!(
                "3. Make {gloss} = {recipe}: stored as token:{token} ({why})"
            ))?;
            self.steps.push(
                json!({ "step": "recombine", "gloss": gloss, "recipe": recipe, "token": token }),
            );
        }
        let more = recipes();
        let more: Vec<_> = more
            .iter()
            .filter(|(gloss, _)| !MADE.iter().any(|it| it.0 == gloss))
            .collect();
        for (gloss, recipe) in &more {
            self.corpus()?.recombine(recipe, gloss)?;
        }
        let names: Vec<&str> = more.iter().map(|(gloss, _)| gloss.as_str()).collect();
        output.line(format!(
            "   and {} more of starter/recipes.txt: {}",
            more.len(),
            names.join(", ")
        ))?;
        let query = "origin=made right.configuration=U";
        let answer = self.corpus()?.search(query, &SearchOptions::default())?;
        let glosses: Vec<&str> = answer.hits.iter().map(|hit| hit.gloss.as_str()).collect();
        output.line(format!(
            "   found again by search, {query}: {}",
            glosses.join(", ")
        ))?;
        if !glosses.contains(&"LIMACE") {
            bail!("the new sign LIMACE is not found by {query}");
        }
        self.steps
            .push(json!({ "step": "search", "query": query, "glosses": glosses }));
        Ok(())
    }

    fn draw(&mut self, output: &mut Output) -> Result<()> {
        let names = [
            "ESCARGOT.png",
            "LIMACE.png",
            "LIMACE.gif",
            "BOL-À-GAUCHE.png",
            "FONCÉ.png",
        ];
        let mut bar = Bar::new();
        let mut drawn = Vec::new();
        for name in names {
            let to = self.folder.join(name);
            let gloss = to
                .file_stem()
                .map(|stem| stem.to_string_lossy().into_owned());
            let address = gloss.unwrap_or_default().parse()?;
            let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
            let options = PictureOptions::default();
            drawn.push(self.corpus()?.draw(
                &address,
                &to,
                &options,
                &mut Progress::new(&mut hear),
            )?);
        }
        drop(bar);
        output.line(format!(
            "4. Pictures in {}: {}",
            self.folder.display(),
            names.join(", ")
        ))?;
        self.steps
            .push(json!({ "step": "draw", "pictures": drawn }));
        Ok(())
    }

    fn export(&mut self, output: &mut Output) -> Result<()> {
        let mut bar = Bar::new();
        let mut written = Vec::new();
        let limace = ExportWhat::Address("LIMACE".parse()?);
        for (what, name) in [
            (limace, "LIMACE.bvh"),
            (ExportWhat::All, "tokens.csv"),
            (ExportWhat::All, "enriched"),
        ] {
            let to = self.folder.join(name);
            let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
            let progress = &mut Progress::new(&mut hear);
            written.push(
                self.corpus()?
                    .export(&what, &to, &ExportOptions::default(), progress)?,
            );
        }
        drop(bar);
        output.line(
            "5. Written out: LIMACE.bvh, tokens.csv, and everything in the folder enriched",
        )?;
        self.steps
            .push(json!({ "step": "export", "written": written }));
        Ok(())
    }

    fn next(&mut self, output: &mut Output) -> Result<()> {
        let corpus = self.path.display();
        output.line("")?;
        output.line(format!(
            "Look at {} first. Then try:",
            self.folder.join("LIMACE.gif").display()
        ))?;
        for line in [
            format!("chereme search {corpus} 'movement=straight not placement=head'"),
            format!(
                "chereme recombine {corpus} 'AIMER | reverse | repeat 2' --as 'ÊTRE DÉGOÛTÉ' --explain"
            ),
            format!(
                "chereme recombine {corpus} 'spell LSF | travel right down 20cm then up 20cm' --as LSF"
            ),
            format!("chereme render {corpus} inventory:configurations --to handshapes.png"),
            format!("chereme log {corpus}      # and: chereme undo {corpus}"),
            "chereme import mine.chereme FOLDER-OF-BVH-AND-EAF --dry-run".to_owned(),
        ] {
            output.line(format!("  {line}"))?;
        }
        Ok(())
    }
}
