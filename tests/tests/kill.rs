//! Processes killed at random moments: the work they reported is stored, and nothing is broken.

mod common;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};

use chereme_corpus::Corpus;
use chereme_tests::workers::{Worker, small_corpus};
use common::Check;

const WORKER: &str = env!("CARGO_BIN_EXE_chereme-worker");

/// A new corpus begins after this many kills, so that its check stays quick.
const KILLS_PER_CORPUS: usize = 25;

/// Numbers that are random enough and the same in every run (xorshift, Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

/// Kills workers during the task: most after they are ready, every eighth while it is still starting.
///
/// The moments lie anywhere in the first operations, however long these take here: they come later
/// if no operation was finished before a kill, and sooner if several were.
fn kill_at(task: &str, seed: u64, kills: usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let template = small_corpus(folder.path(), "template").expect("a corpus");
    let mut longest = 3 * operation_time(&template, task) / 2;
    let mut numbers = Numbers(seed);
    let mut reported: BTreeMap<String, BTreeSet<i64>> = BTreeMap::new();
    let mut total = 0;
    let path = folder.path().join("killed.chereme");
    for kill in 0..kills {
        if kill % KILLS_PER_CORPUS == 0 {
            for end in ["", "-wal", "-shm"] {
                let mut name = path.clone().into_os_string();
                name.push(end);
                let _ = fs::remove_file(name);
            }
            fs::copy(&template, &path).expect("copied");
            reported.clear();
        }
        let author = format!("{task}-{kill}");
        let mut worker = Worker::start(WORKER, &path, task, &author, usize::MAX).expect("started");
        if kill % 8 != 7 {
            worker.wait_until_ready().expect("the corpus opens");
        }
        sleep(Duration::from_micros(numbers.below(longest)));
        let said = worker.kill().expect("killed");
        assert!(!said.ended && said.errors.is_empty(), "{author}: {}", said.errors);
        total += said.done.len();
        longest = match said.done.len() {
            0 => longest + longest / 8,
            1 | 2 => longest,
            _ => longest - longest / 8,
        };
        reported.insert(author, said.done);
        let every = if kill % 5 == 4 { Check::Everything } else { Check::Rows };
        common::expect_whole(&path, &reported, every);
    }
    assert!(total > 0, "every kill came before the first operation was done");
}

/// Returns how many microseconds one operation takes, by doing a few on a copy.
fn operation_time(template: &Path, task: &str) -> u64 {
    const FEW: u32 = 4;
    let path = template.with_extension("tried");
    fs::copy(template, &path).expect("copied");
    let mut worker = Worker::start(WORKER, &path, task, "first", FEW as usize).expect("started");
    worker.wait_until_ready().expect("the corpus opens");
    let start = Instant::now();
    let said = worker.hear().expect("heard");
    assert!(said.ended, "{task}: {}", said.errors);
    let one = start.elapsed() / FEW;
    u64::try_from(one.as_micros()).expect("short").clamp(1_000, 150_000)
}

#[test]
fn killed_while_importing() {
    kill_at("import", 0x9e37_79b9_7f4a_7c15, 40);
}

#[test]
fn killed_while_annotating() {
    kill_at("annotate", 0xd6e8_feb8_6659_fd93, 60);
}

#[test]
fn killed_while_recombining() {
    kill_at("recombine", 0xa5a3_564e_2799_4c8b, 40);
}

#[test]
fn killed_while_undoing_and_redoing() {
    kill_at("history", 0xbf58_476d_1ce4_e5b9, 60);
}

#[test]
fn killed_while_a_corpus_is_made() {
    let mut numbers = Numbers(0x94d0_49bb_1331_11eb);
    for kill in 0..20 {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x");
        let mut worker = Worker::start(WORKER, &path, "create", "made", 1000).expect("started");
        worker.wait_until_ready().expect("ready");
        sleep(Duration::from_micros(numbers.below(120_000)));
        let said = worker.kill().expect("killed");
        assert!(said.errors.is_empty(), "{}", said.errors);
        let last = i64::try_from(said.done.len()).expect("few");
        for step in 0..=last {
            let path = folder.path().join(format!("made-{step}.chereme"));
            if !path.exists() {
                assert!(step == last, "{step} was reported and is lost");
                continue;
            }
            let corpus = Corpus::open_corpus(&path, "checker");
            let corpus = corpus.unwrap_or_else(|error| panic!("kill {kill}, corpus {step}: {error}"));
            assert_eq!(corpus.operation_log(9).expect("log").len(), 0);
        }
    }
}
