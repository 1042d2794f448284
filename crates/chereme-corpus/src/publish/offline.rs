//! The copy of a dictionary that a browser keeps for use without a connection.
//!
//! `offline.txt` lists each file with its hash and size; the hash of that list is the version, which `version.txt` holds
//! and `sw.js` was written for. The script asks for the version before each page and deletes what a newer publication
//! does not have, so that a withdrawn sign is gone from a device when it next has a connection.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::json;
use sha2::{Digest, Sha256};

use super::folder::{PublicationFolder, PublishedFile};
use super::publish_facets;
use super::{png, publish_words};
use crate::db::stored_motion::to_hex_text;
use crate::error::{CorpusError, CorpusResult};
use crate::page::fill_page_parts;
use chereme_sign::inventory;

const SERVICE_WORKER_SCRIPT: &str = include_str!("page/sw.js");

/// The number of days without a connection for which a copy is shown.
pub(super) const OFFLINE_COPY_DAYS: u32 = 30;
/// The sizes of the icon, in pixels.
const ICON_SIZES_PX: [usize; 2] = [192, 512];
/// The handshape of the icon.
const ICON_HANDSHAPE: &str = "5";

/// Writes the files that let a browser keep a copy; every other file of the publication is written before.
pub(super) fn write_offline_files(folder: &mut PublicationFolder, title: &str) -> CorpusResult<()> {
    for size in ICON_SIZES_PX {
        folder.write_published_file(&format!("icons/{size}.png"), &png(&icon(size)?)?)?;
    }
    folder.write_published_file("manifest.webmanifest", manifest(title).as_bytes())?;
    // The version is the hash of the list, so these files cannot be in it.
    let list = offline_file_list(folder.published_files());
    let version = short_hash(list.as_bytes());
    folder.write_published_file("offline.txt", list.as_bytes())?;
    folder.write_published_file("version.txt", format!("{version}\n").as_bytes())?;
    let days = OFFLINE_COPY_DAYS.to_string();
    let texts = publish_words::offline_texts(&days).to_string();
    let parts = [("VERSION", version.as_str()), ("DAYS", &days), ("TEXTS", &texts)];
    let worker = fill_page_parts(SERVICE_WORKER_SCRIPT, &parts);
    folder.write_published_file("sw.js", worker.as_bytes())
}

/// Returns the first 16 digits of the SHA-256 hash of some bytes.
pub(super) fn short_hash(bytes: &[u8]) -> String {
    to_hex_text(&Sha256::digest(bytes)[..8])
}

/// Returns the list of files, a line each: hash, size, name.
fn offline_file_list(files: &BTreeMap<String, PublishedFile>) -> String {
    let mut list = String::new();
    for (name, it) in files {
        let _ = writeln!(list, "{} {} {name}", it.hash, it.size);
    }
    list
}

/// Returns the manifest, which names the dictionary on the screen of a phone.
fn manifest(title: &str) -> String {
    let icons = ICON_SIZES_PX.map(|size| {
        json!({
            "src": format!("icons/{size}.png"), "sizes": format!("{size}x{size}"), "type": "image/png",
        })
    });
    let all = json!({
        "name": title, "short_name": title, "start_url": "index.html", "scope": "./", "display": "minimal-ui",
        "background_color": "#fbfaf7", "theme_color": "#0b4f6c", "icons": icons,
    });
    format!("{all:#}\n")
}

/// Draws a hand.
fn icon(size: usize) -> CorpusResult<chereme_figure::RasterImage> {
    let builtin = inventory::builtin_by_id("configurations");
    let value = builtin.and_then(|inventory| inventory.value_by_id(ICON_HANDSHAPE).map(|value| (inventory, value)));
    let posture = value.and_then(|(inventory, value)| value.hand_pose(inventory));
    let angles = posture.ok_or_else(|| CorpusError::from_wrong_message("the icon's handshape has no posture"))?;
    publish_facets::draw_handshape(&angles, size)
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::process::Command;

    use super::super::tests::{consented, files, publish};
    use super::*;
    use crate::consent::tests::corpus;
    use crate::{ConsentAudience, Corpus, RowName, SignChange};

    fn two_publications(folder: &Path) -> Corpus {
        let mut corpus = corpus(folder);
        // A name that no coded number holds by chance.
        let change = SignChange {
            gloss: Some("QZBOWLZQ".into()),
            ..SignChange::default()
        };
        let sign = RowName::Text("BOL".into());
        corpus.change_sign(&sign, &change).expect("changed");
        consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
        publish(&mut corpus, &folder.join("old"), Some("CC0")).expect("published");
        consented(&mut corpus, "recording:bol", ConsentAudience::Nobody);
        publish(&mut corpus, &folder.join("new"), Some("CC0")).expect("published");
        corpus
    }

    #[test]
    fn the_list_has_every_file_and_the_script_its_hash() {
        let folder = tempfile::tempdir().expect("a folder");
        two_publications(folder.path());
        let mut versions = Vec::new();
        for name in ["old", "new"] {
            let files = files(&folder.path().join(name));
            let text = |name: &str| String::from_utf8(files[name].clone()).expect("text");
            let list = text("offline.txt");
            let listed: Vec<&str> = list.lines().collect();
            let without = ["files.txt", "offline.txt", "sw.js", "version.txt"];
            let wanted = files.iter().filter(|it| !without.contains(&it.0.as_str()));
            let wanted: Vec<String> = wanted
                .map(|(name, bytes)| format!("{} {} {name}", short_hash(bytes), bytes.len()))
                .collect();
            assert_eq!(listed, wanted);
            let version = short_hash(list.as_bytes());
            assert_eq!(text("version.txt"), format!("{version}\n"));
            assert!(text("sw.js").contains(&format!("const VERSION = \"{version}\";")));
            assert!(!text("sw.js").contains("@@"));
            versions.push(version);
            let manifest: serde_json::Value = serde_json::from_str(&text("manifest.webmanifest")).expect("JSON");
            let icon = manifest["icons"][0]["src"].as_str().expect("an icon");
            assert!(files.contains_key(icon));
        }
        assert_ne!(versions[0], versions[1]);
    }

    #[test]
    fn a_withdrawn_sign_does_not_survive_in_the_copy_of_a_browser() {
        let folder = tempfile::tempdir().expect("a folder");
        two_publications(folder.path());
        let script = folder.path().join("test.js");
        std::fs::write(&script, include_str!("tests/worker.js")).expect("written");
        let [old, new] = ["old", "new"].map(|it| folder.path().join(it));
        let mut node = Command::new("node");
        let node = node.arg(script).args([old, new]).args(["QZBOWLZQ", "ESCARGOT"]);
        let Ok(done) = node.output() else {
            println!("skipped: there is no node");
            return;
        };
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{said}");
    }
}
