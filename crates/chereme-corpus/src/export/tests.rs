//! Tests that exports can be imported again without loss.

use std::path::{Path, PathBuf};

use chereme_formats::eaf;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::{SignComponent, TierRole};

use super::*;
use crate::db::signs::TokenValueRow;
use crate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, ImportOptions, ListFilter, ListKind, NewTier,
    TierRequestName, TrackChange, ignore_progress_step,
};

const EAF: &str = include_str!("tests.eaf");

pub(super) struct Place {
    folder: tempfile::TempDir,
    corpora: usize,
}

impl Place {
    pub(super) fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        Self { folder, corpora: 0 }
    }

    pub(super) fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(&path, bytes).expect("written");
        path
    }

    /// Returns a new corpus of these files.
    pub(super) fn corpus(&mut self, files: &[PathBuf]) -> Corpus {
        self.corpora += 1;
        let path = self.folder.path().join(format!("{}.chereme", self.corpora));
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let mut hear = ignore_progress_step;
        let report = corpus
            .import_paths(files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("imported");
        assert!(!report.has_refusals(), "{report:?}");
        corpus
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

pub(super) fn export(corpus: &Corpus, what: &ExportWhat, to: &Path) -> CorpusResult<ExportReport> {
    let mut hear = ignore_progress_step;
    corpus.export_corpus(
        what,
        to,
        &ExportOptions::default(),
        &mut ProgressReceiver::new(&mut hear),
    )
}

pub(super) fn address(text: &str) -> ExportWhat {
    ExportWhat::Address(text.parse().expect("an address"))
}

#[test]
fn an_annotation_file_is_exported_unchanged() {
    let mut place = Place::new();
    let file = place.file("Take 1.eaf", EAF.as_bytes());
    let corpus = place.corpus(&[file]);
    let out = place.path("out.eaf");
    let report = export(&corpus, &address("recording:1"), &out).expect("exported");
    let text = std::fs::read_to_string(&out).expect("text");
    assert_eq!(text, EAF);
    assert_eq!(report.files[0].bytes, text.len() as u64);
    let [note] = &report.notes[..] else {
        panic!("{:?}", report.notes);
    };
    assert!(
        note.starts_with("this is for you alone"),
        "nobody stated a consent: {note}"
    );
    let again = place.corpus(&[out]);
    let twice = place.path("twice.eaf");
    export(&again, &ExportWhat::All, &twice).expect("exported");
    assert_eq!(std::fs::read_to_string(&twice).expect("text"), text);
}

#[test]
fn export_writes_changes_and_keeps_the_rest_of_the_file() {
    let mut place = Place::new();
    let file = place.file("Take 1.eaf", EAF.as_bytes());
    let mut corpus = place.corpus(&[file]);
    let recording = RowName::Number(1);
    let tier = |name: &str| TierRequestName::parse_tier_name(name, Some(&recording)).expect("a name");
    let at = |millis| Some(TableMoment::Time(RecordingInstant::from_millis(millis)));
    let called = |id: &str| AnnotationName::parse_annotation_name(id, Some(&recording));
    let changes = [
        AnnotationAction::Set {
            annotation: called("a1"),
            start: at(5),
            end: at(505),
            value: None,
        },
        AnnotationAction::Set {
            annotation: called("a7"),
            start: None,
            end: None,
            value: Some("H".into()),
        },
        AnnotationAction::Add {
            tier: tier("Gloss RH"),
            start: at(2000),
            end: at(2500),
            parent: None,
            order: None,
            value: "CHAT".into(),
            confidence: None,
        },
    ];
    let changes: Vec<_> = changes.into_iter().map(Into::into).collect();
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &changes,
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("changed");
    let role = TierRole::Component {
        component: SignComponent::Placement,
        feature: None,
    };
    let new = NewTier {
        participant: Some("Anna".into()),
        ..NewTier::new(recording.clone(), "RH location", role)
    };
    corpus.add_tier(&new).expect("added");
    let say = |start, end, value: &str| {
        AnnotationChange::from(AnnotationAction::Add {
            tier: tier("RH location"),
            start: at(start),
            end: at(end),
            parent: None,
            order: None,
            value: value.into(),
            confidence: None,
        })
    };
    corpus
        .annotate_corpus(
            &[say(0, 100, "chin"), say(100, 400, "?"), say(2000, 2500, "N/A")],
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("added");
    let out = place.path("out.eaf");
    export(&corpus, &address("recording:1"), &out).expect("exported");
    let bytes = std::fs::read(&out).expect("bytes");
    let (before, _) = eaf::read_eaf(EAF.as_bytes()).expect("a document");
    let (after, findings) = eaf::read_eaf(&bytes).expect("a document");
    assert!(findings.is_empty(), "{findings:?}");
    let find = |id: &str| {
        let all = after
            .tiers
            .iter()
            .flat_map(|tier| tier.annotations.iter().map(move |it| (tier, it)));
        all.filter(|(_, it)| it.id == id)
            .map(|(tier, it)| (tier.name.clone(), it.clone()))
            .next()
            .expect(id)
    };
    assert_eq!(find("a1").1.millis, Some([5, 505]));
    let (_, shape) = find("a7");
    assert_eq!((shape.value.as_str(), shape.entry.as_deref()), ("H", Some("cve_h")));
    assert_eq!(find("a21").0, "Gloss RH");
    let (name, chin) = find("a22");
    assert_eq!((name.as_str(), chin.value.as_str()), ("RH location", "chin"));
    let placements = after
        .vocabularies
        .iter()
        .find(|it| it.id == "placements")
        .expect("the vocabulary");
    assert!(
        placements
            .entries
            .iter()
            .any(|entry| Some(&entry.id) == chin.entry.as_ref() && entry.values[0].value == "chin")
    );
    assert_eq!(after.tiers.len(), before.tiers.len() + 1);
    assert_ne!(after.date, before.date);
    let again = place.corpus(&[out]);
    let tokens = |corpus: &Corpus| {
        let rows = corpus
            .list_rows(ListKind::Tokens, &ListFilter::default())
            .expect("listed")
            .rows;
        let cell = |row: &serde_json::Map<String, serde_json::Value>| {
            format!("{} {} {}", row["gloss"], row["start_us"], row["components"])
        };
        rows.iter().map(cell).collect::<std::collections::BTreeSet<_>>()
    };
    assert_eq!(tokens(&again), tokens(&corpus));
}

#[test]
fn generated_recordings_are_marked_in_their_file() {
    let mut place = Place::new();
    let file = place.file("Take 1.eaf", EAF.as_bytes());
    let mut corpus = place.corpus(&[file]);
    let change = crate::RecordingChange {
        signer: Some(Some("Berta".into())),
        origin: Some(crate::RecordOrigin::Made),
        licence: Some(Some("CC BY 4.0".into())),
        ..Default::default()
    };
    corpus.change_recording(&RowName::Number(1), &change).expect("changed");
    let left = crate::SignerChange {
        handedness: Some(Some(chereme_motion::BodySide::Left)),
        ..Default::default()
    };
    corpus
        .change_signer(&RowName::Text("Berta".into()), &left)
        .expect("changed");
    let out = place.path("out.eaf");
    export(&corpus, &address("recording:1"), &out).expect("exported");
    let again = place.corpus(&[out]);
    let shown = |corpus: &Corpus, kind| corpus.list_rows(kind, &ListFilter::default()).expect("listed").rows;
    for column in ["signer", "origin", "licence"] {
        let of = |corpus: &Corpus| shown(corpus, ListKind::Recordings)[0][column].clone();
        assert_eq!(of(&again), of(&corpus), "{column}");
    }
    // The participant of the tiers is somebody else.
    let signers = shown(&again, ListKind::Signers);
    let berta = signers.iter().find(|row| row["name"] == "Berta").expect("the signer");
    assert_eq!(berta["handedness"], "left");
}

/// A gloss, its translations, and its values.
type Coded = (String, Vec<(String, String)>, Vec<String>);

/// Returns the codings of each sign's lexicon entry, in an order that does not depend on columns.
fn codings(corpus: &Corpus) -> Vec<Coded> {
    let connection = corpus.store.read_connection();
    let mut all = Vec::new();
    let listed = corpus.list_rows(ListKind::Signs, &ListFilter::default());
    for sign in listed.expect("listed").rows {
        let id = sign["id"].as_i64().expect("a row");
        let tokens = signs::tokens_of_sign(connection, id).expect("tokens");
        let mut values: Vec<String> = tokens
            .iter()
            .flat_map(|token| signs::load_token_values(connection, token.id).expect("values"))
            .map(|row| {
                let row = TokenValueRow {
                    inventory_id: None,
                    ..row
                };
                format!("{row:?}")
            })
            .collect();
        values.sort();
        let mut texts = signs::list_sign_translations(connection, id).expect("translations");
        texts.sort();
        let gloss = sign["gloss"].as_str().expect("a gloss").to_owned();
        all.push((gloss, texts, values));
    }
    all
}

#[test]
fn a_table_of_lexicon_tokens_gives_the_same_codings() {
    let lexicon = "NL gloss\tEN gloss\tFR translation\tHandshape strong\tHandshape weak\tLocation\tFinal location\tMovement direction\tHandshape change\tMouthing\n\
        PET\tCAP\tcasquette\tB\tN/A\tforehead > head\t\tup, forward\t\tpet\n\
        BAL\tBALL\tballon\tS + closing\t\tneutral space\tchest\t?\tclosing > opening\t\n\
        LOPEN\tTO WALK\tmarcher\tV > 1 > S\tB\t> chin\t\tleft + right\t\t-\n\
        X\t\t\t> 5\t5 >\t\t\t\tB > 5\t\n\
        \"Y, z\"\tA\tB\tV\t\tchest, left\t\t\t\t\n";
    let mut place = Place::new();
    let file = place.file("lexicon.tsv", lexicon.as_bytes());
    let corpus = place.corpus(&[file]);
    for name in ["out.csv", "out.tsv"] {
        let out = place.path(name);
        let report = export(&corpus, &ExportWhat::All, &out).expect("exported");
        assert!(report.notes.is_empty(), "{:?}", report.notes);
        let again = place.corpus(&[out]);
        assert_eq!(codings(&again), codings(&corpus), "{name}");
    }
}

#[test]
fn the_shared_lexicon_gives_the_same_codings() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set");
        return;
    };
    let mut place = Place::new();
    let corpus = place.corpus(&[Path::new(&data).join("phonology/ngt_lexicon.tsv")]);
    let out = place.path("out.csv");
    let report = export(&corpus, &ExportWhat::All, &out).expect("exported");
    assert!(report.notes.is_empty(), "{:?}", report.notes);
    let again = place.corpus(&[out]);
    for (again, want) in codings(&again).into_iter().zip(codings(&corpus)) {
        assert_eq!(again, want);
    }
}

#[test]
fn shared_annotation_files_are_exported_unchanged() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set");
        return;
    };
    let mut files = Vec::new();
    find(&Path::new(&data).join("annotation"), &mut files);
    files.sort();
    let mut place = Place::new();
    for file in files {
        let bytes = std::fs::read(&file).expect("bytes");
        if eaf::read_eaf(&bytes).is_err() {
            continue;
        }
        let corpus = place.corpus(std::slice::from_ref(&file));
        let out = place.path("out.eaf");
        let options = ExportOptions {
            force: true,
            ..ExportOptions::default()
        };
        let mut hear = ignore_progress_step;
        corpus
            .export_corpus(
                &address("recording:1"),
                &out,
                &options,
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("exported");
        assert!(
            std::fs::read(&out).expect("bytes") == bytes,
            "{} is not the same byte for byte",
            file.display()
        );
    }
}

fn find(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            find(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "eaf") {
            files.push(path);
        }
    }
}

#[test]
fn exporting_tables_changes_no_annotation() {
    let mut place = Place::new();
    let file = place.file("Take 1.eaf", EAF.as_bytes());
    let mut corpus = place.corpus(&[file]);
    let tiers = corpus
        .list_rows(ListKind::Tiers, &ListFilter::default())
        .expect("listed")
        .total;
    let log = corpus.operation_log(9).expect("log").len();
    for tier in 1..=tiers {
        let out = place.path(&format!("{tier}.csv"));
        export(&corpus, &address(&format!("tier:{tier}")), &out).expect("exported");
        let bytes = std::fs::read(&out).expect("bytes");
        let mut hear = ignore_progress_step;
        let options = AnnotateOptions::default();
        corpus
            .annotate_table(&bytes, "t.csv", None, &options, &mut ProgressReceiver::new(&mut hear))
            .expect("carried out");
    }
    assert_eq!(corpus.operation_log(9).expect("log").len(), log, "nothing changed");
}

#[test]
fn files_appear_whole_and_replace_nothing_unasked() {
    let mut place = Place::new();
    let file = place.file("Take 1.eaf", EAF.as_bytes());
    let corpus = place.corpus(&[file]);
    let there = place.file("there.csv", b"mine");
    for (what, to, want) in [
        (ExportWhat::All, "there.csv", "there.csv"),
        (address("recording:7"), "new.eaf", "there is no recording:7"),
        (ExportWhat::Tokens(vec![1, 2]), "new.bvh", "these are 2 tokens"),
        (address("recording:1"), "new.xyz", "\"xyz\" is no format"),
        (address("recording:1"), "folder", "only everything"),
        (ExportWhat::All, "missing/new.csv", "missing"),
    ] {
        let to = place.path(to);
        let error = export(&corpus, &what, &to).expect_err(want);
        assert!(error.to_string().contains(want), "{error}");
        assert!(to == there || !to.exists());
    }
    assert_eq!(std::fs::read(&there).expect("bytes"), b"mine");
    let options = ExportOptions {
        force: true,
        ..ExportOptions::default()
    };
    let mut hear = ignore_progress_step;
    let report = corpus
        .export_corpus(
            &ExportWhat::All,
            &there,
            &options,
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    let text = std::fs::read_to_string(&there).expect("text");
    assert!(
        text.starts_with("token,gloss,lexicon,recording,start_s,end_s,origin,signer,hand,citation,"),
        "{text}"
    );
    assert_eq!(report.files[0].bytes, text.len() as u64);
    let left: Vec<_> = std::fs::read_dir(place.folder.path())
        .expect("a folder")
        .filter(|entry| {
            entry
                .as_ref()
                .is_ok_and(|entry| entry.file_name().to_string_lossy().ends_with(".part"))
        })
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn several_recordings_go_into_one_folder_a_file_each() {
    let mut place = Place::new();
    let one = place.file("one.eaf", EAF.as_bytes());
    let two = place.file("two.eaf", EAF.replace("BOL", "TASSE").as_bytes());
    let corpus = place.corpus(&[one, two]);
    let write = |what: &ExportWhat, to: &Path, force: bool, format: &str| {
        let options = ExportOptions {
            force,
            ..ExportOptions::from(format)
        };
        let mut hear = ignore_progress_step;
        corpus.export_corpus(what, to, &options, &mut ProgressReceiver::new(&mut hear))
    };
    let to = place.path("takes");
    let several = ExportWhat::Several(vec![
        "recording:one".parse().expect("an address"),
        "recording:two".parse().expect("an address"),
        "recording:1".parse().expect("an address"),
    ]);
    let report = write(&several, &to, false, "eaf").expect("written");
    let names: Vec<_> = report.files.iter().filter_map(|file| file.path.file_name()).collect();
    assert_eq!(names, ["one.eaf", "two.eaf"], "each once");
    assert!(
        write(&several, &to, false, "eaf").is_err(),
        "nothing is replaced unasked"
    );
    write(&several, &to, true, ".EAF").expect("replaced");
    let all = write(&ExportWhat::All, &place.path("all"), false, "eaf").expect("written");
    assert_eq!(all.files.len(), 2);
    let tokens = place.path("tokens");
    let found = write(&ExportWhat::Tokens(vec![1, 2]), &tokens, false, "eaf").expect("written");
    assert!(!found.files.is_empty() && found.files.len() <= 2);
    assert!(write(&several, &place.path("x"), false, "glb").is_err());
    for (name, fits) in [("a.eaf", true), ("a.srt", false), ("a.old", true)] {
        let written = write(&address("recording:one"), &place.path(name), false, "eaf");
        assert_eq!(written.is_ok(), fits, "{name}");
    }
    let mut hear = ignore_progress_step;
    let mut bytes = Vec::new();
    corpus
        .export_stream(
            &address("recording:one"),
            "eaf",
            &mut bytes,
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("written");
    assert_eq!(bytes, std::fs::read(to.join("one.eaf")).expect("read"));
}

/// Returns the BVH files of a folder and its subfolders, up to a size.
fn captures(folder: &Path, most: u64) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|it| it == "bvh") && path.metadata().expect("a size").len() < most {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Returns the positions of all joints in all frames, with their names in GLB.
fn places(corpus: &Corpus) -> (Vec<String>, Vec<Vec<chereme_motion::glam::DVec3>>) {
    let clip = corpus
        .movement_at_address(&"recording:1".parse().expect("an address"))
        .expect("movement")
        .clip;
    let names = clip.clip_skeleton().skeleton_joints().iter().map(|it| it.name.clone());
    let frames = (0..clip.clip_frame_count()).map(|at| clip.model_pose(at).model_joint_positions().to_vec());
    (names.collect(), frames.collect())
}

#[test]
fn a_bvh_file_of_movement_that_begins_late_says_what_it_lacks() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let file = captures(&own, 1 << 20).swap_remove(0);
    let mut place = Place::new();
    let mut corpus = place.corpus(std::slice::from_ref(&file));
    let take = RowName::Number(1);
    let name = corpus.recording_tracks(&take).expect("tracks")[0].name.clone();
    for (offset_us, expected) in [(0, None), (500_000, Some("begins 0.5 s after"))] {
        let change = TrackChange::Offset(offset_us);
        corpus.change_track(&take, &name, &change).expect("moved");
        let to = place.path(&format!("{offset_us}.bvh"));
        let report = export(&corpus, &address("recording:1"), &to).expect("a BVH");
        let about_file = report
            .notes
            .iter()
            .filter(|note| !note.starts_with("this is for you alone"));
        let notes = about_file.cloned().collect::<Vec<_>>().join("\n");
        assert_eq!(notes.is_empty(), expected.is_none(), "{notes}");
        assert!(notes.contains(expected.unwrap_or_default()), "{notes}");
    }
}

#[test]
fn movement_goes_through_glb_and_back_to_bvh_within_a_hundredth_of_a_millimetre() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let mut files: Vec<PathBuf> = captures(&own, 1 << 20).into_iter().take(6).collect();
    assert!(!files.is_empty());
    match std::env::var_os("CHEREME_SHARED_DATA") {
        Some(data) => files.extend(captures(&Path::new(&data).join("motion/bvh"), 1 << 18)),
        None => eprintln!("CHEREME_SHARED_DATA is not set: only own files are tried"),
    }
    let mut place = Place::new();
    let mut tried = 0;
    for file in files {
        let first = place.corpus(std::slice::from_ref(&file));
        if first
            .movement_at_address(&"recording:1".parse().expect("an address"))
            .is_err()
        {
            continue;
        }
        let (joints, before) = places(&first);
        if before.is_empty() {
            continue;
        }
        let name = format!("{tried}");
        let [glb, bvh] = ["glb", "bvh"].map(|it| place.path(&format!("{name}.{it}")));
        export(&first, &address("recording:1"), &glb).expect("a GLB");
        let second = place.corpus(&[glb]);
        export(&second, &address("recording:1"), &bvh).expect("a BVH");
        let third = place.corpus(&[bvh]);
        let (others, after) = places(&third);
        assert_eq!(joints.len(), others.len(), "{}", file.display());
        assert_eq!(before.len(), after.len(), "{}", file.display());
        let pairs = before.iter().flatten().zip(after.iter().flatten());
        let apart = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(apart < 1e-5, "{}: {apart} m", file.display());
        tried += 1;
    }
    assert!(tried > 0);
}

#[test]
fn markers_without_the_curves_beside_them_are_named() {
    let mut place = Place::new();
    let points = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n\
                  100\t100\t2\t1\tmm\nFrame#\tTime\tLWRA\n\t\tX1\tY1\tZ1\n\n1\t0.00\t1\t9\t3\n2\t0.01\t2\t9\t3\n";
    let face = "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:00:01.0,61,0.5\n";
    let points = place.file("a.trc", points.as_bytes());
    let face = place.file("a.csv", face.as_bytes());
    for (files, reported) in [(vec![points.clone()], false), (vec![points, face], true)] {
        let corpus = place.corpus(&files);
        let to = place.path(&format!("{reported}.c3d"));
        let report = export(&corpus, &address("recording:1"), &to).expect("exported");
        let named = |it: &String| it.contains("without the curves face");
        assert_eq!(report.notes.iter().any(named), reported, "{:?}", report.notes);
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn a_program_without_parquet_says_what_to_do() {
    let mut place = Place::new();
    let corpus = place.corpus(&[]);
    for name in ["all.parquet", "all.annotations.parquet", "all.frames.parquet"] {
        let refused = export(&corpus, &ExportWhat::All, &place.path(name));
        let error = refused.expect_err("refused");
        let remedy = error.error_remedy().expect("a remedy");
        assert!(remedy.remedy_text().contains("--features parquet"), "{remedy}");
        assert!(!place.path(name).exists());
    }
}

#[test]
fn tables_of_tokens_say_who_signs_and_which_fields_do_not_count() {
    let mut place = Place::new();
    let slots: String = ["0", "1000"]
        .iter()
        .enumerate()
        .map(|(at, time)| format!("<TIME_SLOT TIME_SLOT_ID=\"t{at}\" TIME_VALUE=\"{time}\"/>"))
        .collect();
    let tiers = [
        ("Gloss A", "anna", "CHIEN"),
        ("Handshape right", "anna", "flat"),
        ("Handshape right 2", "ben", "5"),
        ("Location right", "anna", "chin"),
    ];
    let tiers = tiers.iter().enumerate().map(|(at, (name, annotator, value))| {
        format!(
            "<TIER TIER_ID=\"{name}\" ANNOTATOR=\"{annotator}\" PARTICIPANT=\"Cem\" LINGUISTIC_TYPE_REF=\"t\">\
             <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{at}\" TIME_SLOT_REF1=\"t0\" TIME_SLOT_REF2=\"t1\">\
             <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>"
        )
    });
    let text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2024-01-01T00:00:00Z\" \
         FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>\
         <TIME_ORDER>{slots}</TIME_ORDER>{}<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"t\" TIME_ALIGNABLE=\"true\"/>\
         </ANNOTATION_DOCUMENT>",
        tiers.collect::<String>()
    );
    let file = place.file("dialogue.eaf", text.as_bytes());
    let mut corpus = place.corpus(&[file]);
    let proposed = corpus.store.named_operation("test", |connection| {
        connection.execute(
            "UPDATE annotation SET origin = 'detector', confidence = 0.9 WHERE value = 'chin'",
            [],
        )?;
        crate::tokens::update_recording_tokens(connection, 1, None, &[])?;
        Ok(((), String::new()))
    });
    proposed.expect("changed");
    let table = place.path("tokens.csv");
    export(&corpus, &ExportWhat::All, &table).expect("exported");
    let folder = place.path("folder");
    export(&corpus, &ExportWhat::All, &folder).expect("exported");
    for path in [table.clone(), folder.join("tables").join("token.csv")] {
        let mut reader = ::csv::Reader::from_path(&path).expect("a table");
        let titles = reader.headers().expect("titles").clone();
        let row = reader.records().next().expect("a token").expect("a row");
        let cell = |title: &str| {
            let at = titles.iter().position(|one| one == title);
            row[at.unwrap_or_else(|| panic!("{title} in {titles:?}"))].to_owned()
        };
        let marks = ["signer", "disputed", "proposed"].map(cell);
        assert_eq!(
            marks,
            ["Cem", "right.configuration", "right.placement"],
            "{}",
            path.display()
        );
    }
    let listed = corpus
        .list_rows(ListKind::Tokens, &ListFilter::default())
        .expect("listed");
    let listed = serde_json::to_string(&listed).expect("JSON");
    for part in [
        "\"signer\":\"Cem\"",
        "\"disputed\":\"right.configuration\"",
        "\"proposed\":\"right.placement\"",
    ] {
        assert!(listed.contains(part), "{part} in {listed}");
    }
    // Read back as a lexicon, the marks are no properties of signs.
    let again = place.corpus(&[table]);
    let attributes: i64 = again
        .store
        .read_connection()
        .query_row(
            "SELECT count(*) FROM attribute WHERE name IN ('disputed', 'proposed')",
            [],
            |row| row.get(0),
        )
        .expect("counted");
    assert_eq!(attributes, 0);
}
