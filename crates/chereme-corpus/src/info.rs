//! An overview of a corpus.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use crate::Corpus;
pub use crate::db::stored_info::TrackAmount;
pub use crate::db::stored_rows::{InventoryInfo, SignerInfo};
use crate::db::{OperationRow, SCHEMA_VERSION, stored_attributes, stored_info as rows};
use crate::error::CorpusResult;

/// Overview of the contents of a corpus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CorpusInfo {
    /// The file.
    pub path: PathBuf,
    /// Its size in bytes.
    pub file_bytes: u64,
    /// The version of its schema.
    pub schema_version: i32,
    /// How many rows there are of each kind.
    pub counts: BTreeMap<&'static str, u64>,
    /// Number of recordings by origin.
    pub recordings: BTreeMap<String, u64>,
    /// Number of tracks by kind: `skeleton`, `markers`, `curves`, `media`.
    pub tracks: BTreeMap<String, u64>,
    /// Number of tokens by origin.
    pub tokens: BTreeMap<String, u64>,
    /// Number of tiers by role.
    pub tiers: BTreeMap<String, u64>,
    /// Hours of movement of skeletons.
    pub motion_hours: f64,
    /// Frames of movement of skeletons.
    pub motion_frames: u64,
    /// Hours and frames by kind of track: `skeleton`, `markers`, `curves`.
    pub amounts: BTreeMap<String, TrackAmount>,
    /// Sizes of the file's contents in bytes: `motion`, `history`, `search`, `sources`, `rest`.
    pub bytes: BTreeMap<&'static str, u64>,
    /// The signers.
    pub signers: Vec<SignerInfo>,
    /// The inventories.
    pub inventories: Vec<InventoryInfo>,
    /// The properties of signs from tables, besides their components.
    pub attributes: Vec<AttributeInfo>,
    /// The newest operation.
    pub last_operation: Option<OperationRow>,
}

/// Summary of an attribute of signs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttributeInfo {
    /// Its name, the title of its column.
    pub name: String,
    /// How many entries have it.
    pub entries: u64,
    /// The least number, if all values are numbers.
    pub least: Option<f64>,
    /// The greatest number, if all values are numbers.
    pub greatest: Option<f64>,
}

impl Corpus {
    /// Returns an overview of the contents of the corpus.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn load_corpus_info(&self) -> CorpusResult<CorpusInfo> {
        let connection = self.store.read_connection();
        let amounts = rows::sum_track_amounts(connection)?;
        let motion = amounts.get("skeleton").copied().unwrap_or_default();
        let bytes = rows::content_sizes_bytes(connection)?;
        Ok(CorpusInfo {
            path: self.corpus_file_path().to_owned(),
            file_bytes: bytes.values().sum(),
            schema_version: SCHEMA_VERSION,
            counts: rows::count_rows_by_kind(connection)?,
            recordings: rows::count_recordings_by_origin(connection)?,
            tracks: rows::count_tracks_by_kind(connection)?,
            tokens: rows::count_tokens_by_origin(connection)?,
            tiers: rows::count_tiers_by_role(connection)?,
            motion_hours: motion.hours,
            motion_frames: motion.frames,
            amounts,
            bytes,
            signers: rows::load_signer_infos(connection)?,
            inventories: rows::load_inventory_infos(connection)?,
            attributes: stored_attributes::summarise_attributes(connection)?
                .into_iter()
                .map(|attribute| AttributeInfo {
                    name: attribute.name,
                    entries: attribute.entries,
                    least: attribute.range.map(|(least, _)| least),
                    greatest: attribute.range.map(|(_, greatest)| greatest),
                })
                .collect(),
            last_operation: self.operation_log(1)?.pop(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_corpus_has_its_inventories_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let info = corpus.load_corpus_info().expect("info");
        let full: Vec<_> = info
            .counts
            .iter()
            .filter(|(_, count)| **count > 0)
            .map(|(what, _)| *what)
            .collect();
        assert_eq!(full, ["inventories", "values"]);
        assert_eq!(
            info.inventories.len(),
            chereme_sign::inventory::builtin_inventories().len()
        );
        assert!(info.bytes["rest"] > 0 && info.file_bytes >= info.bytes["rest"]);
        assert_eq!((info.motion_frames, info.last_operation), (0, None));
        assert!(info.amounts.is_empty());
    }

    #[test]
    fn markers_and_faces_are_counted_beside_movement() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("face.csv");
        // The second table has times of its own: 36 s in all.
        let rows = |times: &[f64]| -> String {
            let row = |time: &f64| format!("{time},0.5\n");
            times.iter().map(row).collect()
        };
        let even: Vec<f64> = (0..90).map(|frame| f64::from(frame) / 10.0).collect();
        let head = "time [s],jaw_open\n";
        std::fs::write(&path, format!("{head}{}", rows(&even))).expect("written");
        let other = folder.path().join("other.csv");
        std::fs::write(&other, format!("{head}{}", rows(&[0.0, 8.0, 27.0]))).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = crate::ignore_progress_step;
        let progress = &mut crate::ProgressReceiver::new(&mut hear);
        let report = corpus.import_paths(&[path, other], &crate::ImportOptions::default(), progress);
        report.expect("imported");
        let info = corpus.load_corpus_info().expect("info");
        assert_eq!((info.motion_frames, info.motion_hours), (0, 0.0));
        let kinds: Vec<&str> = info.amounts.keys().map(String::as_str).collect();
        assert_eq!(kinds, ["curves"]);
        let curves = info.amounts["curves"];
        assert_eq!(curves.frames, 93);
        assert!((curves.hours * 3600.0 - 55.0).abs() < 1e-3, "{curves:?}");
    }
}
