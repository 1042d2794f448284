//! `chereme map`: places similar signs near each other in a plane, as a table or a picture.

use std::collections::HashMap;
use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::MapOptions;
use chereme_sign::SignComponent;
use serde_json::json;

use super::lexicon_command::LexiconScopeArgs;
use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};
use crate::streams;

/// Place the signs on a map: similar signs lie near each other
///
/// Two signs are similar if they share values, features of handshapes, or broader places; all components have the same
/// weight. Without a query the map shows the citation forms of all signs. `--json` gives "components", "left_out" (the
/// number of tokens without a coding for them) and "signs", each with "token", "gloss", "origin", "x" and "y" from 0 to
/// 1, and "near", the five most similar tokens.
#[derive(Debug, clap::Args)]
pub(crate) struct MapArgs {
    /// The corpus
    corpus: PathBuf,
    /// The tokens to place, as in `chereme search`
    query: Vec<String>,
    #[command(flatten)]
    scope: LexiconScopeArgs,
    /// The components that count: configuration, placement, movement, orientation, nonmanual
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    by: Vec<SignComponent>,
    /// Draw the map to this file, an .svg; - is standard output
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &CommandLine, args: &MapArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = MapOptions {
        components: args.by.clone(),
        query: (!args.query.is_empty()).then(|| args.query.join(" ")),
        scope: args.scope.lexicon_scope(),
    };
    let map = with_progress_bar(|progress| corpus.arrange_sign_map(&options, progress))?;
    if let Some(to) = &args.to {
        if streams::is_standard(to) {
            streams::not_with_json(output.is_json())?;
            let stand = streams::stdout_stand_in("map", "svg")?;
            // The drawing is a file in any case, which is then copied to standard output.
            map.draw_sign_map(&stand.path, false)?;
            output.silence_output();
            return streams::copy_to_stdout(&stand);
        }
        let bytes = map.draw_sign_map(to, args.force)?;
        output.filled_line(
            "drew {n} signs to {path}: {size} KB",
            &[&map.signs.len(), &to.display(), &bytes.div_ceil(1024)],
        )?;
    } else {
        let gloss_pairs = map.signs.iter().map(|sign| (sign.token, sign.gloss.as_str()));
        let glosses: HashMap<i64, &str> = gloss_pairs.collect();
        let near = |ids: &[i64]| {
            let near_glosses = ids.iter().filter_map(|id| glosses.get(id).copied());
            near_glosses.collect::<Vec<_>>().join(", ")
        };
        output.write_item_table(
            &map.signs,
            &[
                ("token", &|sign| sign.token.to_string()),
                ("gloss", &|sign| sign.gloss.clone()),
                ("x", &|sign| format!("{:.3}", sign.x)),
                ("y", &|sign| format!("{:.3}", sign.y)),
                ("most alike", &|sign| near(&sign.near)),
            ],
        )?;
    }
    if map.left_out > 0 {
        output.filled_line(
            "left out: {n} tokens that are not coded for these components",
            &[&map.left_out],
        )?;
    }
    output.set_json_document(json!(map))
}
