//! `chereme inventory`: adds values to an inventory, merges two of them, or makes values of two inventories one.

use std::path::PathBuf;

use anyhow::Result;
use chereme_sign::InventoryValue;
use clap::Subcommand;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Add values to an inventory, merge two into one, or say which values of two inventories are one
///
/// Each call is one operation that `chereme undo` takes back. `chereme list CORPUS inventories` names the
/// inventories; `chereme export CORPUS inventory:NAME --to x.json` writes one, and `import` reads it again.
#[derive(Debug, clap::Args)]
pub(crate) struct InventoryArgs {
    /// The corpus
    corpus: PathBuf,
    #[command(subcommand)]
    action: InventoryCommand,
}

#[derive(Debug, Subcommand)]
enum InventoryCommand {
    /// Add a value
    AddValue {
        /// The inventory, such as configurations
        inventory: String,
        /// The value, as annotations and queries spell it
        value: String,
        /// Its name in a spoken language, such as en="bent hand"
        #[arg(long, value_name = "LANGUAGE=NAME", value_parser = parse_value_name)]
        name: Vec<(String, String)>,
        /// Another spelling
        #[arg(long)]
        alias: Vec<String>,
        /// The broader value that contains this one, as head contains chin
        #[arg(long)]
        broader: Option<String>,
        /// A feature of the value, such as index or spread
        #[arg(long)]
        feature: Vec<String>,
        /// Its symbols in HamNoSys, by name
        #[arg(long)]
        hamnosys: Option<String>,
        /// Remarks
        #[arg(long)]
        notes: Option<String>,
    },
    /// Merge two values: annotations with the first value get the second one
    ///
    /// The spelling of the first value becomes another spelling of the second, so that a table with the old spelling
    /// can be imported again.
    MergeValue {
        /// The inventory
        inventory: String,
        /// The value that is removed
        from: String,
        /// The value that stays
        into: String,
    },
    /// Say which values of two inventories are one, list those that are, or propose some
    ///
    /// Each coding keeps its own word, and a search by either word finds both; counts, pickers and dictionaries show the
    /// value once, as a rule by the second of the two words. Without values, those that are one are listed. Values are
    /// proposed if they are equal in name, symbols, posture, place, direction, orientation or features, and are one only
    /// when you say so. `--json` gives "equal_values" (groups, that which stands for the others first) or "proposals".
    Equate {
        /// Both values, as INVENTORY/VALUE; the second stands for the first
        #[arg(num_args = 2, value_names = ["VALUE", "OTHER"])]
        values: Vec<String>,
        /// List values that seem to be one, with the reasons
        #[arg(long, conflicts_with = "values")]
        propose: bool,
        /// Take this value out of those that it is one with
        #[arg(long, value_name = "VALUE", conflicts_with_all = ["values", "propose"])]
        remove: Option<String>,
    },
}

fn parse_value_name(text: &str) -> Result<(String, String), String> {
    let (language, name) = text.split_once('=').ok_or("write LANGUAGE=NAME, such as fr=poing")?;
    Ok((language.trim().to_owned(), name.trim().to_owned()))
}

pub(super) fn run(cli: &CommandLine, args: &InventoryArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    match &args.action {
        InventoryCommand::AddValue {
            inventory,
            value,
            name,
            alias,
            broader,
            feature,
            hamnosys,
            notes,
        } => {
            let new = InventoryValue {
                id: value.clone(),
                names: name.iter().cloned().collect(),
                aliases: alias.clone(),
                broader: broader.clone(),
                features: feature.iter().cloned().collect(),
                hamnosys: hamnosys.clone(),
                notes: notes.clone(),
                ..InventoryValue::default()
            };
            corpus.add_value(inventory, &new)?;
            output.filled_line(
                "added {value} to {inventory}",
                &[&format_args!("{:?}", value), &inventory],
            )?;
            output.set_json_document(serde_json::json!({ "inventory": inventory, "value": value }))
        }
        InventoryCommand::Equate { propose: true, .. } => {
            let proposals = corpus.propose_equal_values()?;
            output.write_item_table(
                &proposals,
                &[
                    ("value", &|row| row.value.to_string()),
                    ("the same as", &|row| row.other.to_string()),
                    ("equal in", &|row| row.reasons.join(", ")),
                ],
            )?;
            output.write_note("`chereme inventory CORPUS equate VALUE OTHER` makes two of them one")?;
            output.set_json_document(serde_json::json!({ "proposals": proposals }))
        }
        InventoryCommand::Equate { values, remove, .. } => {
            if let [value, other] = values.as_slice() {
                corpus.equate_values(value, other)?;
            }
            if let Some(value) = remove {
                let parted = corpus.part_equal_value(value)?;
                output.filled_line("{value} is one with no other value any more", &[&parted])?;
            }
            let equal_values = corpus.list_equal_values()?;
            for group in equal_values.equal_groups() {
                let texts: Vec<String> = group.iter().map(ToString::to_string).collect();
                output.write_output_line(texts.join(" = "))?;
            }
            if equal_values.equal_groups().is_empty() {
                output.write_note("no values of different inventories are one: `chereme inventory CORPUS equate --propose` finds some")?;
            }
            output.set_json_document(serde_json::json!({ "equal_values": equal_values }))
        }
        InventoryCommand::MergeValue { inventory, from, into } => {
            let merged = corpus.merge_values(inventory, from, into)?;
            output.filled_line(
                "{from} is {to} from now on; annotations changed: {n}, lexicon entries: {entries}",
                &[
                    &format_args!("{:?}", from),
                    &format_args!("{:?}", merged.value),
                    &merged.annotations,
                    &merged.entries,
                ],
            )?;
            output.set_json_document(merged)
        }
    }
}
