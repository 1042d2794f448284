//! Benchmark of search over a million tokens, compared with plain SQLite on the same rows:
//! `cargo bench -p chereme-corpus --bench search`.
//!
//! 500 recordings of 2,000 tokens each; about 4,500 glosses, 60 configurations and 40 placements on each hand, all
//! distributed by Zipf's law; a sentence of three to eight words over every eight tokens. The measured time of Chereme
//! covers everything from the text of the query to the hits with their values; SQLite only counts rows. Times are the
//! best of several runs. `CHEREME_BENCH_TOKENS` sets another number of tokens.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chereme_corpus::{Corpus, SearchOptions};
use rusqlite::Connection;

const RECORDINGS: usize = 500;

fn main() {
    let tokens = std::env::var("CHEREME_BENCH_TOKENS");
    let tokens: usize = tokens.ok().and_then(|n| n.parse().ok()).unwrap_or(1_000_000);
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("search-{tokens}.chereme"));
    remove(&path);
    let (_, took) = timed(|| build(&path, tokens));
    println!("{tokens} tokens written as rows            {}", shown(took));
    let (mut corpus, _) = timed(|| Corpus::open_corpus(&path, "bench").expect("opened"));
    let (_, took) = timed(|| search(&mut corpus, "gloss=INDEX", 50, false));
    println!("index made from the rows                {}", shown(took));
    drop(corpus);
    let size = std::fs::metadata(&path).map_or(0, |data| data.len());
    let index = index_size(&path);
    println!("file {} MB, of which the index {} MB", size >> 20, index >> 20);
    println!("peak memory so far {} MB\n", peak_memory());
    open_and_ask(&path);
    ask(&path);
    remove(&path);
}

const PATTERN: &str = "gloss:MA*SON right.configuration=config03 right.placement=placement05";

fn open_and_ask(path: &Path) {
    let mut opened = Vec::new();
    let mut asked = Vec::new();
    for _ in 0..7 {
        let (mut corpus, took) = timed(|| Corpus::open_corpus(path, "bench").expect("opened"));
        opened.push(took);
        asked.push(timed(|| search(&mut corpus, PATTERN, 50, false)).1);
    }
    println!("open                                    {}", shown(best(opened)));
    println!("first query after it                    {}\n", shown(best(asked)));
}

fn ask(path: &Path) {
    let mut corpus = Corpus::open_corpus(path, "bench").expect("opened");
    let peer = Connection::open(path).expect("opened");
    peer.execute_batch("CREATE INDEX IF NOT EXISTS bench ON token_value (component, hand, value, token_id)")
        .expect("indexed");
    println!(
        "{:<34}{:>8}{:>11}{:>11}{:>11}{:>11}",
        "", "found", "ours", "+facets", "join", "exists"
    );
    for (name, query, join, exists) in QUERIES {
        let total = search(&mut corpus, query, 50, false);
        let ours = best((0..41).map(|_| timed(|| search(&mut corpus, query, 50, false)).1));
        let facets = best((0..11).map(|_| timed(|| search(&mut corpus, query, 50, true)).1));
        let peers = [join, exists].map(|sql| {
            let count = |connection: &Connection| -> usize {
                let mut statement = connection.prepare_cached(sql).expect("sql");
                let found: i64 = statement.query_row([], |row| row.get(0)).expect("counted");
                found as usize
            };
            (!sql.is_empty()).then(|| {
                assert_eq!(count(&peer), total, "{name}");
                best((0..3).map(|_| timed(|| count(&peer)).1))
            })
        });
        let ratio = |peer: Option<Duration>| match peer {
            Some(peer) => format!("{} {:.0}x", shown(peer), peer.as_secs_f64() / ours.as_secs_f64()),
            None => String::new(),
        };
        println!(
            "{name:<34}{total:>8}{:>11}{:>11}  {:>16}{:>16}",
            shown(ours),
            shown(facets),
            ratio(peers[0]),
            ratio(peers[1])
        );
    }
}

/// Name, query, the straightforward join for SQLite, and its EXISTS over a covering index.
const QUERIES: [(&str, &str, &str, &str); 9] = [
    (
        "two components and a gloss",
        PATTERN,
        "SELECT count(DISTINCT t.id) FROM token t JOIN sign s ON s.id = t.sign_id
         JOIN token_value a ON a.token_id = t.id JOIN token_value b ON b.token_id = t.id
         WHERE s.gloss LIKE 'MA%SON' AND a.component = 'configuration' AND a.hand = 'right'
         AND a.value = 'config03' AND b.component = 'placement' AND b.hand = 'right'
         AND b.value = 'placement05'",
        "SELECT count(*) FROM token t JOIN sign s ON s.id = t.sign_id WHERE s.gloss LIKE 'MA%SON'
         AND EXISTS (SELECT 1 FROM token_value v WHERE v.component = 'configuration'
             AND v.hand = 'right' AND v.value = 'config03' AND v.token_id = t.id)
         AND EXISTS (SELECT 1 FROM token_value v WHERE v.component = 'placement'
             AND v.hand = 'right' AND v.value = 'placement05' AND v.token_id = t.id)",
    ),
    (
        "two components",
        "right.configuration=config03 right.placement=placement05",
        "SELECT count(DISTINCT t.id) FROM token t
         JOIN token_value a ON a.token_id = t.id JOIN token_value b ON b.token_id = t.id
         WHERE a.component = 'configuration' AND a.hand = 'right'
         AND a.value = 'config03' AND b.component = 'placement' AND b.hand = 'right'
         AND b.value = 'placement05'",
        "SELECT count(*) FROM token_value a WHERE a.component = 'configuration'
         AND a.hand = 'right' AND a.value = 'config03'
         AND EXISTS (SELECT 1 FROM token_value v WHERE v.component = 'placement'
             AND v.hand = 'right' AND v.value = 'placement05' AND v.token_id = a.token_id)",
    ),
    (
        "one component, either hand",
        "configuration=config03",
        "SELECT count(DISTINCT token_id) FROM token_value
         WHERE component = 'configuration' AND value = 'config03'",
        "",
    ),
    (
        "one component, the commonest",
        "right.configuration=config00",
        "SELECT count(DISTINCT token_id) FROM token_value
         WHERE component = 'configuration' AND hand = 'right' AND value = 'config00'",
        "",
    ),
    (
        "gloss",
        "gloss=maison",
        "SELECT count(*) FROM token t JOIN sign s ON s.id = t.sign_id WHERE s.gloss = 'MAISON'",
        "",
    ),
    (
        "gloss pattern",
        "gloss=*SON",
        "SELECT count(*) FROM token t JOIN sign s ON s.id = t.sign_id WHERE s.gloss LIKE '%SON'",
        "",
    ),
    ("phrase in what is said", "\"slow animal\"", "", ""),
    ("not coded so", "not configuration=config00", "", ""),
    (
        "beside another",
        "gloss:MA*SON right.configuration=config03 before gloss=BOL",
        "",
        "",
    ),
];

fn search(corpus: &mut Corpus, query: &str, limit: usize, facets: bool) -> usize {
    let options = SearchOptions {
        limit: Some(limit),
        facets,
        ..SearchOptions::default()
    };
    corpus.search_tokens(query, &options).expect("answered").total
}

fn build(path: &Path, tokens: usize) {
    drop(Corpus::create_corpus(path, "bench").expect("made"));
    let mut connection = Connection::open(path).expect("opened");
    connection
        .execute_batch("PRAGMA synchronous = OFF; PRAGMA cache_size = -500000;")
        .expect("set");
    let transaction = connection.transaction().expect("begun");
    let triggers = triggers(&transaction);
    for (name, _) in &triggers {
        transaction
            .execute_batch(&format!("DROP TRIGGER {name}"))
            .expect("dropped");
    }
    let mut numbers = Numbers(7);
    write_signs(&transaction);
    let (glosses, values) = (Zipf::new(4500), [Zipf::new(60), Zipf::new(40)]);
    let mut token = transaction
        .prepare(
            "INSERT INTO token (sign_id, recording_id, annotation_id, start_us, end_us, hand, origin)
             VALUES (?1, ?2, ?3, ?4, ?5, 'right', 'captured')",
        )
        .expect("sql");
    let mut value = transaction
        .prepare(
            "INSERT INTO token_value (token_id, hand, component, state, value)
             VALUES (?1, ?2, ?3, 'value', ?4)",
        )
        .expect("sql");
    let mut annotation = transaction
        .prepare(
            "INSERT INTO annotation (tier_id, start_us, end_us, value, origin)
             VALUES (?1, ?2, ?3, ?4, 'human')",
        )
        .expect("sql");
    for number in 0..tokens {
        let each = tokens.div_ceil(RECORDINGS);
        let (recording, place) = ((number / each + 1) as i64, (number % each) as i64);
        let (start, end) = (place * 600_000, place * 600_000 + 450_000);
        if place == 0 {
            transaction
                .execute_batch(&format!(
                    "INSERT INTO recording (id, name, signer_id, origin)
                         VALUES ({recording}, 'Session {recording}', {recording} % 20 + 1, 'captured');
                     INSERT INTO tier (id, recording_id, name, position, role)
                         VALUES ({recording} * 2, {recording}, 'Gloss', 0, 'gloss');
                     INSERT INTO tier (id, recording_id, name, position, role)
                         VALUES ({recording} * 2 + 1, {recording}, 'Said', 1, 'translation');"
                ))
                .expect("written");
        }
        if place % 8 == 0 {
            let sentence = sentence(&mut numbers);
            let until = start + 8 * 600_000;
            annotation
                .execute((recording * 2 + 1, start, until, sentence))
                .expect("written");
        }
        let sign = glosses.pick(&mut numbers) + 1;
        annotation
            .execute((recording * 2, start, end, gloss(sign - 1)))
            .expect("written");
        let said = transaction.last_insert_rowid();
        token
            .execute((sign as i64, recording, said, start, end))
            .expect("written");
        let id = transaction.last_insert_rowid();
        for hand in ["right", "left"] {
            for (component, name, zipf) in [
                ("configuration", "config", &values[0]),
                ("placement", "placement", &values[1]),
            ] {
                let text = format!("{name}{:02}", zipf.pick(&mut numbers));
                value.execute((id, hand, component, text)).expect("written");
            }
        }
    }
    drop((token, value, annotation));
    for (_, sql) in &triggers {
        transaction.execute_batch(sql).expect("made");
    }
    transaction
        .execute_batch("UPDATE search_state SET content = content + 1")
        .expect("counted");
    transaction.commit().expect("written");
}

/// The schema's triggers count changes one by one; a single count for all suffices here.
fn triggers(connection: &Connection) -> Vec<(String, String)> {
    let mut statement = connection
        .prepare("SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'")
        .expect("sql");
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))
        .expect("rows");
    rows.collect::<rusqlite::Result<_>>().expect("rows")
}

fn write_signs(connection: &Connection) {
    for signer in 1..=20 {
        let hand = if signer % 10 == 0 { "left" } else { "right" };
        connection
            .execute(
                "INSERT INTO signer (id, name, handedness) VALUES (?1, ?2, ?3)",
                (signer, format!("Signer {signer}"), hand),
            )
            .expect("written");
    }
    for number in 0..4500 {
        let sign = (number as i64 + 1, gloss(number));
        connection
            .execute("INSERT INTO sign (id, gloss) VALUES (?1, ?2)", sign)
            .expect("written");
    }
}

/// Returns glosses of syllables, with some common ones among them so that patterns have matches.
fn gloss(number: usize) -> String {
    match number {
        0 => return "INDEX".to_owned(),
        3 => return "MAISON".to_owned(),
        40 => return "BOL".to_owned(),
        90 => return "MAUVAISE-SAISON".to_owned(),
        _ => {}
    }
    const SYLLABLES: [&str; 17] = [
        "MA", "TO", "BO", "LI", "CHA", "RE", "SON", "VE", "PU", "NI", "DO", "KA", "ÉCO", "GRU", "FI", "ZA", "HU",
    ];
    let mut rest = number;
    let mut text = String::new();
    for _ in 0..3 {
        text.push_str(SYLLABLES[rest % 17]);
        rest /= 17;
    }
    text
}

fn sentence(numbers: &mut Numbers) -> String {
    const WORDS: [&str; 24] = [
        "the", "a", "slow", "animal", "cat", "dog", "house", "bowl", "goes", "sees", "gives", "to", "from", "old",
        "young", "friend", "school", "snail", "quickly", "was", "is", "under", "over", "again",
    ];
    let count = 3 + (numbers.next() * 6.0) as usize;
    let words = (0..count).map(|_| WORDS[(numbers.next() * 24.0) as usize % 24]);
    words.collect::<Vec<_>>().join(" ")
}

/// Random numbers below a bound; the n-th has the frequency 1 / n.
struct Zipf(Vec<f64>);

impl Zipf {
    fn new(count: usize) -> Self {
        let mut sum = 0.0;
        let sums = (1..=count).map(|n| {
            sum += 1.0 / n as f64;
            sum
        });
        Self(sums.collect())
    }

    fn pick(&self, numbers: &mut Numbers) -> usize {
        let total = self.0.last().copied().unwrap_or(1.0);
        let at = numbers.next() * total;
        self.0.partition_point(|sum| *sum < at).min(self.0.len() - 1)
    }
}

/// A small generator of numbers in 0..1 (splitmix64), which gives the same numbers in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}

fn best(times: impl IntoIterator<Item = Duration>) -> Duration {
    times.into_iter().min().unwrap_or_default()
}

fn shown(time: Duration) -> String {
    let micros = time.as_secs_f64() * 1e6;
    match micros {
        ..1000.0 => format!("{micros:.0} us"),
        ..1_000_000.0 => format!("{:.2} ms", micros / 1e3),
        _ => format!("{:.2} s", micros / 1e6),
    }
}

fn index_size(path: &Path) -> i64 {
    Connection::open(path)
        .and_then(|connection| {
            let sql = "SELECT coalesce(sum(length(data)), 0) FROM search_file";
            connection.query_row(sql, [], |row| row.get(0))
        })
        .unwrap_or(0)
}

/// Returns the peak memory of the process in MB, if the system reports it.
fn peak_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) >> 10
}

fn remove(path: &Path) {
    for end in ["", "-wal", "-shm"] {
        let mut name = path.as_os_str().to_owned();
        name.push(end);
        let _ = std::fs::remove_file(name);
    }
}
