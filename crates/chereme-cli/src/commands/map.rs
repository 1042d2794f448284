//! `chereme map`: places similar signs near each other in a plane, as a table or a picture.

use std::collections::HashMap;
use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{MapOptions, Progress, Step};
use chereme_sign::Component;
use serde_json::json;

use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::streams;

/// Place the signs on a map: similar signs lie near each other
///
/// Two signs are similar if they share values, features of handshapes, or broader places; all components have the same
/// weight. Without a query the map shows the citation forms of all signs. `--json` gives "components", "left_out" (the
/// number of tokens without a coding for them) and "signs", each with "token", "gloss", "origin", "x" and "y" from 0 to
/// 1, and "near", the five most similar tokens.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The tokens to place, as in `chereme search`
    query: Vec<String>,
    /// The components that count: configuration, placement, movement, orientation, nonmanual
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    by: Vec<Component>,
    /// Draw the map to this file, an .svg; - is standard output
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let options = MapOptions {
        components: args.by.clone(),
        query: (!args.query.is_empty()).then(|| args.query.join(" ")),
    };
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let map = corpus.map(&options, &mut Progress::new(&mut hear))?;
    drop(bar);
    if let Some(to) = &args.to {
        if streams::is_standard(to) {
            streams::not_with_json(output.is_json())?;
            let stand = streams::output("map", "svg")?;
            map.draw(&stand.path, false)?;
            output.silence();
            return streams::copy(&stand);
        }
        let bytes = map.draw(to, args.force)?;
        output.filled_line(
            "drew {n} signs to {path}: {size} KB",
            &[&map.signs.len(), &to.display(), &bytes.div_ceil(1024)],
        )?;
    } else {
        let glosses = map.signs.iter().map(|it| (it.token, it.gloss.as_str()));
        let glosses: HashMap<i64, &str> = glosses.collect();
        let rows: Vec<Vec<String>> = map
            .signs
            .iter()
            .map(|it| {
                let near: Vec<&str> = it
                    .near
                    .iter()
                    .filter_map(|id| glosses.get(id).copied())
                    .collect();
                vec![
                    it.token.to_string(),
                    it.gloss.clone(),
                    format!("{:.3}", it.x),
                    format!("{:.3}", it.y),
                    near.join(", "),
                ]
            })
            .collect();
        output.table(&["token", "gloss", "x", "y", "most alike"], &rows)?;
    }
    if map.left_out > 0 {
        output.filled_line(
            "left out: {n} tokens that are not coded for these components",
            &[&map.left_out],
        )?;
    }
    output.document(json!(map))
}
