//! Any corpus of signers, consents and recipes over recipes: nothing that is withheld is in any output, by bytes and by
//! name. What is withheld is read off the rules here, and not off the program.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proptest::test_runner::TestRunner;

use super::*;
use crate::export::{ExportOptions, ExportWhat};
use crate::publish::PublishOptions;

/// Captured signs: the recording and the sign of the starter corpus, the new name of both, and the signer.
const CAPTURED: [(&str, &str, &str, &str); 2] = [
    ("bol", "BOL", "QZ0ZQ", "Qzadazq"),
    ("escargot", "ESCARGOT", "QZ1ZQ", "Qzbeazq"),
];
const MADE_SIGNS: usize = 3;

/// A recipe over earlier signs, by their positions.
#[derive(Debug, Clone)]
struct AnyRecipe {
    operator: usize,
    first: prop::sample::Index,
    second: prop::sample::Index,
}

/// The consents of the signers, then those of all recordings, by kind.
type Said = Vec<[Option<ConsentAudience>; 3]>;

#[derive(Debug, Clone)]
struct AnyCorpus {
    recipes: Vec<AnyRecipe>,
    said: Said,
    undone: usize,
}

fn any_corpus() -> impl Strategy<Value = AnyCorpus> {
    let index = any::<prop::sample::Index>;
    let recipe = (0..4_usize, index(), index()).prop_map(|(operator, first, second)| AnyRecipe {
        operator,
        first,
        second,
    });
    let audience = prop_oneof![4 => Just(Some(ConsentAudience::Public)), 1 => any_audience()];
    let said = prop::collection::vec(prop::array::uniform3(audience), 2 * CAPTURED.len() + MADE_SIGNS);
    let recipes = prop::collection::vec(recipe, MADE_SIGNS);
    (recipes, said, 0..3_usize).prop_map(|(recipes, said, undone)| AnyCorpus { recipes, said, undone })
}

/// A sign with what it was made from, and the sources whose movement it shows.
#[derive(Debug, Clone, Default)]
struct KnownSign {
    name: String,
    signer: Option<&'static str>,
    sources: Vec<usize>,
    kept: Vec<usize>,
}

fn build(folder: &Path, any: &AnyCorpus) -> (Corpus, Vec<KnownSign>) {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let is_wanted = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "bol" || stem == "escargot");
    let files: Vec<PathBuf> = files.into_iter().filter(is_wanted).collect();
    let mut corpus = Corpus::create_corpus(&folder.join("a.chereme"), "A").expect("created");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&files, &ImportOptions::default(), progress)
        .expect("imported");
    let mut signs = Vec::new();
    for (recording, gloss, name, signer) in CAPTURED {
        let change = RecordingChange {
            name: Some(name.into()),
            signer: Some(Some(signer.into())),
            origin: Some(RecordOrigin::Captured),
            licence: Some(Some("CC0".into())),
            ..RecordingChange::default()
        };
        corpus
            .change_recording(&RowName::Text(recording.into()), &change)
            .expect("changed");
        let change = crate::SignChange {
            gloss: Some(name.into()),
            ..crate::SignChange::default()
        };
        corpus
            .change_sign(&RowName::Text(gloss.into()), &change)
            .expect("changed");
        signs.push(KnownSign {
            name: name.to_owned(),
            signer: Some(signer),
            ..KnownSign::default()
        });
    }
    let participants = "UPDATE tier SET participant = NULL";
    let cleared = corpus.store.named_operation("test", |connection| {
        connection.execute(participants, [])?;
        Ok(((), String::new()))
    });
    cleared.expect("changed");
    for (n, recipe) in any.recipes.iter().enumerate() {
        let [first, second] = [recipe.first, recipe.second].map(|index| index.index(signs.len()));
        let [one, two] = [first, second].map(|at| signs[at].clone());
        let whole = |at: usize, sign: &KnownSign| sign.kept.iter().copied().chain([at]).collect::<Vec<_>>();
        let (text, sources, kept) = match recipe.operator {
            0 => (format!("{} | retime 100%", one.name), vec![first], whole(first, &one)),
            1 => (format!("{} | mirror", one.name), vec![first], Vec::new()),
            2 => {
                let kept = [whole(first, &one), whole(second, &two)].concat();
                (format!("{} then {}", one.name, two.name), vec![first, second], kept)
            }
            _ => {
                let text = format!("{} | configure right from {}", one.name, two.name);
                (text, vec![first, second], whole(first, &one))
            }
        };
        let name = format!("QZ{}ZQ", CAPTURED.len() + n);
        corpus.recombine_recipe(&text, &name).expect("generated");
        signs.push(KnownSign {
            name,
            signer: None,
            sources,
            kept,
        });
    }
    let subjects = CAPTURED.iter().map(|captured| format!("signer:{}", captured.3));
    let subjects = subjects.chain(signs.iter().map(|sign| format!("recording:{}", sign.name)));
    for (subject, said) in subjects.zip(&any.said) {
        let change = ConsentChange {
            movement: Some(said[0]),
            annotation: Some(said[1]),
            derived: Some(said[2]),
            ..ConsentChange::default()
        };
        corpus.change_consent(&[address(&subject)], &change).expect("changed");
    }
    // What is undone and done again is as before.
    for _ in 0..any.undone {
        corpus.undo_operation().expect("undone");
    }
    for _ in 0..any.undone {
        corpus.redo_operation().expect("redone");
    }
    (corpus, signs)
}

/// Reports whether somebody said that an audience may not see a sign.
fn is_refused(signs: &[KnownSign], said: &Said, at: usize, kind: usize, audience: ConsentAudience) -> bool {
    let no = |said: Option<ConsentAudience>| said.is_some_and(|said| said < audience);
    let own = said[CAPTURED.len() + at];
    let derived = match signs[at].signer {
        Some(_) => no(said[at][kind]) || own[kind].or(said[at][kind]).is_none(),
        None => no(own[2]),
    };
    let mut sources = signs[at].sources.iter();
    no(own[kind])
        || derived
        || sources.any(|source| is_refused(signs, said, *source, 2, audience))
        || (kind == 1
            && signs[at]
                .sources
                .iter()
                .any(|source| is_refused(signs, said, *source, 1, audience)))
        || (kind == 0
            && signs[at]
                .kept
                .iter()
                .any(|source| is_refused(signs, said, *source, 0, audience)))
}

/// Returns all bytes of files in a folder, with their names.
fn all_bytes(folder: &Path) -> Vec<u8> {
    let mut all = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            all.extend(entry.file_name().to_string_lossy().bytes());
            all.push(0);
            match entry.path().is_dir() {
                true => folders.push(entry.path()),
                false => all.extend(fs::read(entry.path()).expect("read")),
            }
        }
    }
    all
}

fn right_arm_blocks(corpus: &Corpus) -> BTreeMap<String, Vec<Vec<u8>>> {
    let sql = "SELECT r.name, b.data FROM track_block tb JOIN block b ON b.hash = tb.hash
         JOIN track t ON t.id = tb.track_id JOIN recording r ON r.id = t.recording_id
         WHERE tb.channel_group = 'right-arm'";
    let mut statement = corpus.store.read_connection().prepare(sql).expect("read");
    let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)));
    let mut blocks: BTreeMap<String, Vec<Vec<u8>>> = BTreeMap::new();
    for row in rows.expect("read") {
        let (name, data): (String, Vec<u8>) = row.expect("read");
        blocks.entry(name).or_default().push(data);
    }
    blocks
}

#[test]
fn nothing_that_is_withheld_is_in_any_output_by_bytes_and_by_name() {
    let mut runner = TestRunner::new(ProptestConfig {
        cases: 3,
        max_shrink_iters: 2,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let shown = std::cell::Cell::new(0);
    let checked = runner.run(&any_corpus(), |any| {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut corpus, signs) = build(folder.path(), &any);
        let blocks = right_arm_blocks(&corpus);
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        for audience in [ConsentAudience::Public, ConsentAudience::Research] {
            let outputs = folder.path().join(audience.audience_name());
            fs::create_dir(&outputs).expect("made");
            for format in [None, Some("bvh"), Some("glb"), Some("eaf"), Some("csv")] {
                let options = ExportOptions {
                    format: format.map(str::to_owned),
                    audience: audience.audience_name().parse().expect("an audience"),
                    ..ExportOptions::default()
                };
                let to = outputs.join(format.unwrap_or("everything"));
                // An export of nothing is refused.
                let done = corpus.export_corpus(&ExportWhat::All, &to, &options, progress);
                prop_assert!(format.is_some() || done.is_ok(), "{:?}", done);
            }
            if audience == ConsentAudience::Public {
                // A dictionary without signs is refused, too.
                let to = outputs.join("dictionary");
                drop(corpus.publish_dictionary(&to, &PublishOptions::default(), progress));
            }
            let bytes = all_bytes(&outputs);
            let holds = |part: &[u8]| bytes.windows(part.len()).any(|other| other == part);
            for (at, sign) in signs.iter().enumerate() {
                let refused = |kind: usize| is_refused(&signs, &any.said, at, kind, audience);
                if refused(1) {
                    prop_assert!(!holds(sign.name.as_bytes()), "{} is named for {}", sign.name, audience);
                } else {
                    shown.set(shown.get() + usize::from(holds(sign.name.as_bytes())));
                }
                // A generated sign may be withheld for itself alone, while its source is shown with the same movement.
                if at < CAPTURED.len() && refused(0) {
                    let data = blocks.get(&sign.name).into_iter().flatten();
                    let left = data.filter(|data| data.len() >= 64 && holds(data)).count();
                    prop_assert_eq!(left, 0, "the movement of {} for {}", sign.name, audience);
                }
            }
        }
        Ok(())
    });
    checked.unwrap_or_else(|error| panic!("{error}"));
    assert!(shown.get() > 0, "something is shown");
}
