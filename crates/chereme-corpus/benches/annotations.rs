//! Benchmark of an annotation file with many annotations: import, single edits, and export of its tokens:
//! `cargo bench -p chereme-corpus --bench annotations [-- SIGNS]`.
//!
//! The session has 100,000 signs by default: a gloss tier, three component tiers below it, and a translation over every
//! eight signs. The import is compared with plain SQLite that receives the same annotations from memory, with the
//! schema's indexes. Edits are complete operations, including history, search index and the write to disk, in that
//! session and in one of 2,000 signs.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant as Clock};

use chereme_corpus::{
    AnnotateOptions, AnnotationAction, AnnotationName, Corpus, ExportOptions, ExportWhat, ImportOptions,
    ProgressReceiver, TableMoment, TierRequestName, ignore_progress_step,
};
use chereme_motion::RecordingInstant;

/// The tiers below the glosses.
const COMPONENTS: [&str; 3] = ["RH Configuration", "RH Placement", "LH Configuration"];
/// The time from the start of one sign to that of the next, in milliseconds.
const STEP: usize = 600;
/// The length of a sign, in milliseconds.
const SIGN: usize = 450;

fn main() {
    let signs = std::env::args()
        .skip(1)
        .find_map(|arg| arg.parse::<usize>().ok())
        .unwrap_or(100_000);
    let folder = tempfile::tempdir().expect("a folder");
    for signs in [2000, signs] {
        let text = folder.path().join(format!("session-{signs}.eaf"));
        std::fs::write(&text, eaf(signs)).expect("written");
        let path = folder.path().join(format!("{signs}.chereme"));
        let mut corpus = import(&text, &path, signs);
        edits(&mut corpus, signs);
        export(&corpus, folder.path(), signs);
        take_back(&mut corpus);
    }
}

fn import(text: &Path, path: &Path, signs: usize) -> Corpus {
    let clock = Clock::now();
    let mut corpus = Corpus::create_corpus(path, "bench").expect("made");
    let mut hear = ignore_progress_step;
    let files = [text.to_owned()];
    let report = corpus
        .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    let ours = clock.elapsed();
    assert!(!report.has_refusals(), "{report:?}");
    let count = report.created["annotations"] as usize;
    assert_eq!(report.created["tokens"] as usize, signs);
    let peer = plain_rows(&path.with_extension("db"), count);
    println!(
        "{count} annotations, {signs} tokens: import {}, rows alone {}, {:.1}x",
        shown(ours),
        shown(peer),
        ours.as_secs_f64() / peer.as_secs_f64()
    );
    corpus
}

/// Writes the same number of annotation rows into a database without history, tokens or search index.
fn plain_rows(path: &Path, count: usize) -> Duration {
    let connection = rusqlite::Connection::open(path).expect("opened");
    let clock = Clock::now();
    connection
        .execute_batch(
            "PRAGMA journal_mode = WAL;
             CREATE TABLE annotation (id INTEGER PRIMARY KEY, tier INTEGER, start INTEGER, end INTEGER,
                 value TEXT, parent INTEGER);
             CREATE INDEX a ON annotation (tier, start); CREATE INDEX b ON annotation (parent);
             BEGIN",
        )
        .expect("made");
    let mut insert = connection
        .prepare("INSERT INTO annotation (tier, start, end, value, parent) VALUES (?1, ?2, ?3, ?4, ?5)")
        .expect("sql");
    for row in 0..count {
        let start = (row * STEP) as i64;
        let value = configuration(row);
        insert
            .execute((row as i64 % 5, start, start + SIGN as i64, value, row as i64 / 4))
            .expect("written");
    }
    drop(insert);
    connection
        .execute_batch("COMMIT; PRAGMA wal_checkpoint(TRUNCATE)")
        .expect("written");
    clock.elapsed()
}

fn edits(corpus: &mut Corpus, signs: usize) {
    for (what, change) in [
        ("another value", value as fn(usize) -> AnnotationAction),
        ("another end", end),
    ] {
        let mut times: Vec<Duration> = (0..9)
            .map(|edit| {
                let action = change((signs - 1) * edit / 8);
                let clock = Clock::now();
                let mut hear = ignore_progress_step;
                corpus
                    .annotate_corpus(
                        &[action.into()],
                        &AnnotateOptions::default(),
                        &mut ProgressReceiver::new(&mut hear),
                    )
                    .expect("changed");
                clock.elapsed()
            })
            .collect();
        times.sort_unstable();
        println!(
            "  {what} of one gloss in {signs}: median {}, longest {}",
            shown(times[4]),
            shown(times[8])
        );
    }
}

fn gloss_at(sign: usize) -> AnnotationName {
    let start = RecordingInstant::from_micros((sign * STEP * 1000) as i64);
    AnnotationName::At {
        tier: TierRequestName::Number(1),
        start: TableMoment::Time(start),
    }
}

fn value(sign: usize) -> AnnotationAction {
    AnnotationAction::Set {
        annotation: gloss_at(sign),
        start: None,
        end: None,
        value: Some("MAISON".to_owned()),
    }
}

fn end(sign: usize) -> AnnotationAction {
    let end = RecordingInstant::from_micros(((sign * STEP + SIGN - 40) * 1000) as i64);
    AnnotationAction::Set {
        annotation: gloss_at(sign),
        start: None,
        end: Some(TableMoment::Time(end)),
        value: None,
    }
}

fn export(corpus: &Corpus, folder: &Path, signs: usize) {
    for to in ["tokens.csv", "session.eaf"] {
        let to = folder.join(format!("{signs}-{to}"));
        let what = match to.extension() {
            Some(kind) if kind == "eaf" => ExportWhat::Address("recording:1".parse().expect("an address")),
            _ => ExportWhat::All,
        };
        let clock = Clock::now();
        let mut hear = ignore_progress_step;
        let options = ExportOptions::default();
        let report = corpus
            .export_corpus(&what, &to, &options, &mut ProgressReceiver::new(&mut hear))
            .expect("written");
        println!(
            "  {} written: {}, {:.1} MB",
            to.extension().unwrap_or_default().to_string_lossy(),
            shown(clock.elapsed()),
            report.files[0].bytes as f64 / 1e6
        );
    }
}

/// Undoes all operations, the import last.
fn take_back(corpus: &mut Corpus) {
    let edits = corpus.operation_log(usize::MAX).expect("log").len() - 1;
    for _ in 0..edits {
        corpus.undo_operation().expect("undone");
    }
    let clock = Clock::now();
    corpus.undo_operation().expect("undone");
    println!("  the import taken back: {}", shown(clock.elapsed()));
}

fn configuration(sign: usize) -> &'static str {
    ["flat", "5", "Y", "S", "U", "1", "B-round", "beak"][sign % 8]
}

fn placement(sign: usize) -> &'static str {
    ["chin", "chest", "temple", "neutral", "forehead"][sign % 5]
}

fn eaf(signs: usize) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ANNOTATION_DOCUMENT AUTHOR=\"\" \
         DATE=\"2024-01-01T00:00:00+00:00\" FORMAT=\"3.0\" VERSION=\"3.0\">\n\
         <HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>\n<TIME_ORDER>\n",
    );
    for sign in 0..signs {
        for (end, time) in [(0, sign * STEP), (1, sign * STEP + SIGN)] {
            let _ = writeln!(
                text,
                "<TIME_SLOT TIME_SLOT_ID=\"ts{}\" TIME_VALUE=\"{time}\"/>",
                sign * 2 + end
            );
        }
    }
    text.push_str("</TIME_ORDER>\n");
    let mut next = 0;
    text.push_str("<TIER LINGUISTIC_TYPE_REF=\"free\" TIER_ID=\"Gloss\">\n");
    for sign in 0..signs {
        let value = format!("SIGN-{}", sign % 997);
        alignable(&mut text, &mut next, sign * 2, sign * 2 + 1, &value);
    }
    text.push_str("</TIER>\n<TIER LINGUISTIC_TYPE_REF=\"free\" TIER_ID=\"Translation\">\n");
    for sign in (0..signs).step_by(8) {
        let last = (sign + 7).min(signs - 1) * 2 + 1;
        alignable(&mut text, &mut next, sign * 2, last, "the cat goes home");
    }
    text.push_str("</TIER>\n");
    for (place, tier) in COMPONENTS.iter().enumerate() {
        let _ = writeln!(
            text,
            "<TIER LINGUISTIC_TYPE_REF=\"below\" PARENT_REF=\"Gloss\" TIER_ID=\"{tier}\">"
        );
        for sign in 0..signs {
            let value = match place {
                1 => placement(sign),
                _ => configuration(sign + place),
            };
            next += 1;
            let _ = writeln!(
                text,
                "<ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"a{next}\" ANNOTATION_REF=\"a{}\">\
                 <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>",
                sign + 1
            );
        }
        text.push_str("</TIER>\n");
    }
    text.push_str(
        "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"free\" TIME_ALIGNABLE=\"true\" \
         GRAPHIC_REFERENCES=\"false\"/>\n<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"below\" \
         TIME_ALIGNABLE=\"false\" GRAPHIC_REFERENCES=\"false\" CONSTRAINTS=\"Symbolic_Association\"/>\n\
         <CONSTRAINT STEREOTYPE=\"Symbolic_Association\" DESCRIPTION=\"1-1\"/>\n\
         </ANNOTATION_DOCUMENT>\n",
    );
    text
}

fn alignable(text: &mut String, next: &mut usize, start: usize, end: usize, value: &str) {
    *next += 1;
    let _ = writeln!(
        text,
        "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{next}\" TIME_SLOT_REF1=\"ts{start}\" \
         TIME_SLOT_REF2=\"ts{end}\"><ANNOTATION_VALUE>{value}</ANNOTATION_VALUE>\
         </ALIGNABLE_ANNOTATION></ANNOTATION>"
    );
}

fn shown(time: Duration) -> String {
    match time.as_secs_f64() {
        seconds if seconds < 1.0 => format!("{:.1} ms", seconds * 1e3),
        seconds => format!("{seconds:.2} s"),
    }
}
