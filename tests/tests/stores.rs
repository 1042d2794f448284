//! Corpora that earlier versions wrote: the newest code opens them, whole, with all that they hold.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use chereme_corpus::{Corpus, Progress, SearchOptions, unheard};
use chereme_tests::repository;

/// Returns the stored corpora by their version of the schema.
fn stores() -> BTreeMap<usize, PathBuf> {
    let folder = repository::root().join("tests/stores");
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    files
        .filter_map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            let version = name.strip_suffix(".chereme.zst")?.parse().ok()?;
            Some((version, entry.path()))
        })
        .collect()
}

#[test]
fn there_is_a_corpus_of_every_version_of_the_schema() {
    let steps = repository::schema_steps().len();
    let versions: Vec<usize> = stores().into_keys().collect();
    let wanted: Vec<usize> = (1..=steps).collect();
    assert_eq!(
        versions, wanted,
        "write what is missing: cargo run -p chereme-tests --bin chereme-store -- tests/stores"
    );
}

#[test]
fn corpora_of_earlier_versions_open_whole() {
    for (version, store) in stores() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("old.chereme");
        let packed = fs::read(&store).expect("read");
        let bytes = zstd::decode_all(packed.as_slice()).expect("unpacked");
        fs::write(&path, bytes).expect("written");
        let mut corpus = Corpus::open(&path, "reader").expect("opened");
        let check = corpus
            .check(false, &mut Progress::new(&mut unheard))
            .expect("checked");
        assert!(check.ok, "version {version}: {:?}", check.faults);
        for (query, total) in [
            ("gloss=BOL", 1),
            ("right.configuration=S placement=chin", 2),
            ("origin=made", 1),
            ("\"slug\"", 1),
        ] {
            let answer = corpus
                .search(query, &SearchOptions::default())
                .expect(query);
            assert_eq!(answer.total, total, "version {version}: {query}");
        }
        let bowl = "recording:\"bowl and cat\"".parse().expect("an address");
        let moving = corpus.movement(&bowl).expect("movement");
        assert_eq!(moving.clip.frames(), 200, "version {version}");
        let operations = corpus.log(usize::MAX).expect("log").len();
        assert_eq!(operations, 4, "version {version}");
        corpus.undo().expect("the made sign is taken back");
        corpus.undo().expect("the import is taken back");
        assert!(corpus.undo().is_err(), "version {version}");
    }
}
