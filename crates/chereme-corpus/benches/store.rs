//! Benchmark of import to a stored corpus, bytes per hour, partial reads and opening, compared with other programs.
//!
//! Run with `cargo bench -p chereme-corpus --bench store [-- MINUTES]`; ten minutes of capture by default. The capture
//! is synthetic: 75 joints, 228 channels, 120 frames per second, eight sinusoids per channel and a hundredth of a
//! degree of noise, six decimals. Compared in the same run: bvh_anim, which reads the file, with its frames stored as
//! one blob of f32 per second; and the text under zstd.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::fs::File;
use std::io::{BufWriter, Read, Write};
use std::path::Path;
use std::time::Instant as Clock;

use chereme_corpus::{ChannelGroup, Corpus, ImportOptions, ProgressReceiver, ignore_progress_step};
use chereme_motion::{RecordingInstant, TimeSpan};

const JOINTS: usize = 75;
const RATE: usize = 120;

fn main() {
    let minutes = std::env::args()
        .skip(1)
        .find_map(|arg| arg.parse::<f64>().ok())
        .unwrap_or(10.0);
    let frames = (minutes * 60.0) as usize * RATE;
    let folder = tempfile::tempdir().expect("a folder");
    let text = folder.path().join("capture.bvh");
    let size = write_capture(&text, frames).expect("written");
    let hours = frames as f64 / RATE as f64 / 3600.0;
    println!("{JOINTS} joints, {frames} frames, {:.0} MB of text", mega(size));

    let path = folder.path().join("bench.chereme");
    let clock = Clock::now();
    let mut corpus = Corpus::create_corpus(&path, "bench").expect("made");
    let mut hear = ignore_progress_step;
    let report = corpus
        .import_paths(
            std::slice::from_ref(&text),
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("imported");
    assert!(!report.has_refusals(), "{report:?}");
    drop(corpus);
    let ours = clock.elapsed().as_secs_f64();
    let stored = std::fs::metadata(&path).expect("there").len();
    println!("largest memory so far: {}", peak_memory());
    let (peer, peer_stored) = import_with_bvh_anim(&text, folder.path());
    println!(
        "import to a stored corpus: {ours:.2} s, {:.0} MB/s; bvh_anim + f32 blobs {peer:.2} s; ratio {:.2}",
        mega(size) / ours,
        peer / ours
    );
    println!(
        "stored: {:.0} MB an hour without loss ({:.2} of the text); f32 blobs {:.0} MB an hour",
        mega(stored) / hours,
        stored as f64 / size as f64,
        mega(peer_stored) / hours
    );
    if minutes <= 10.0 {
        for level in [3, 12] {
            let bytes = std::fs::read(&text).expect("read");
            let packed = zstd::encode_all(bytes.as_slice(), level).expect("packed").len() as u64;
            println!("  the text under zstd -{level}: {:.0} MB an hour", mega(packed) / hours);
        }
    }
    partial_reads(&path, frames);
}

fn partial_reads(path: &Path, frames: usize) {
    let clock = Clock::now();
    let corpus = Corpus::open_corpus(path, "bench").expect("opened");
    println!("opening: {:.1} ms", clock.elapsed().as_secs_f64() * 1e3);
    let address = "recording:1".parse().expect("an address");
    let seconds = frames / RATE - 1;
    for (what, groups) in [
        ("one hand", &[ChannelGroup::RightHand][..]),
        ("the whole body", &ChannelGroup::ALL_CHANNEL_GROUPS[..]),
    ] {
        let clock = Clock::now();
        let reads = 100;
        for read in 0..reads {
            let start = RecordingInstant::from_seconds((read * 7919 % seconds) as f64);
            let span = TimeSpan::span_between(start, start.shifted_instant(1_000_000));
            let moving = corpus.movement_in(&address, Some(span), groups).expect("read");
            assert_eq!(moving.clip.clip_frame_count(), RATE);
        }
        println!(
            "one second of {what}, anywhere: {:.2} ms",
            clock.elapsed().as_secs_f64() * 1e3 / f64::from(reads as u32)
        );
    }
}

fn import_with_bvh_anim(text: &Path, folder: &Path) -> (f64, u64) {
    let clock = Clock::now();
    let mut bytes = Vec::new();
    File::open(text)
        .and_then(|mut file| file.read_to_end(&mut bytes))
        .expect("read");
    let bvh = bvh_anim::from_bytes(&bytes[..]).expect("clean text");
    let path = folder.join("peer.db");
    let connection = rusqlite::Connection::open(&path).expect("opened");
    connection
        .execute_batch("PRAGMA journal_mode = WAL; CREATE TABLE b (i INTEGER PRIMARY KEY, d BLOB); BEGIN")
        .expect("made");
    let mut blob = Vec::new();
    for (at, frame) in bvh.frames().enumerate() {
        blob.extend(frame.as_slice().iter().flat_map(|value| value.to_le_bytes()));
        if at % RATE == RATE - 1 {
            connection
                .execute("INSERT INTO b (d) VALUES (?1)", [&blob])
                .expect("written");
            blob.clear();
        }
    }
    connection
        .execute_batch("COMMIT; PRAGMA wal_checkpoint(TRUNCATE)")
        .expect("written");
    drop(connection);
    (
        clock.elapsed().as_secs_f64(),
        std::fs::metadata(&path).expect("there").len(),
    )
}

fn mega(bytes: u64) -> f64 {
    bytes as f64 / 1e6
}

fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or_else(|| "not known here".to_owned(), |text| text.trim().to_owned())
}

/// Writes a capture of a body with hands in which every channel moves.
fn write_capture(path: &Path, frames: usize) -> std::io::Result<u64> {
    let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
    write_hierarchy(&mut out)?;
    write!(out, "MOTION\nFrames: {frames}\nFrame Time: 0.008333\n")?;
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let channels = 3 * JOINTS + 3;
    let waves: Vec<[(f64, f64, f64); 8]> = (0..channels)
        .map(|_| {
            std::array::from_fn(|k| {
                let hertz = 0.2 + 5.8 * k as f64 / 7.0;
                (8.0 / hertz * random(), hertz * std::f64::consts::TAU, random() * 6.3)
            })
        })
        .collect();
    let mut line = String::new();
    for frame in 0..frames {
        let time = frame as f64 / RATE as f64;
        line.clear();
        for wave in &waves {
            let value: f64 = wave
                .iter()
                .map(|(size, speed, phase)| size * (speed * time + phase).sin())
                .sum();
            let noise = (random() + random() + random() - 1.5) * 0.02;
            line.push_str(&format!("{:.6} ", value + noise));
        }
        line.pop();
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    out.flush()?;
    std::fs::metadata(path).map(|it| it.len())
}

/// Writes hips, a spine, two arms with five fingers of three joints, and filler joints up to 75.
fn write_hierarchy(out: &mut impl Write) -> std::io::Result<()> {
    writeln!(out, "HIERARCHY")?;
    let mut count = 0;
    let mut open = |out: &mut dyn Write, name: &str, offset: &str| -> std::io::Result<()> {
        let (word, channels) = match count {
            0 => ("ROOT", "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"),
            _ => ("JOINT", "3 Zrotation Xrotation Yrotation"),
        };
        count += 1;
        writeln!(out, "{word} {name}\n{{\nOFFSET {offset}\nCHANNELS {channels}")
    };
    let end = |out: &mut dyn Write| writeln!(out, "End Site\n{{\nOFFSET 0 2 0\n}}");
    let close = |out: &mut dyn Write, many: usize| out.write_all("}\n".repeat(many).as_bytes());
    open(out, "Hips", "0 95 0")?;
    for side in ["Left", "Right"] {
        let x = if side == "Left" { "9" } else { "-9" };
        open(out, &format!("{side}UpLeg"), &format!("{x} -5 0"))?;
        open(out, &format!("{side}Leg"), "0 -42 0")?;
        open(out, &format!("{side}Foot"), "0 -42 0")?;
        end(out)?;
        close(out, 3)?;
    }
    for (name, offset) in [("Spine", "0 10 0"), ("Spine1", "0 12 0"), ("Spine2", "0 12 0")] {
        open(out, name, offset)?;
    }
    open(out, "Neck", "0 18 0")?;
    open(out, "Head", "0 9 0")?;
    for filler in 0..17 {
        open(out, &format!("Face{filler}"), "1 5 6")?;
        end(out)?;
        close(out, 1)?;
    }
    close(out, 2)?;
    for side in ["Left", "Right"] {
        let sign = if side == "Left" { "" } else { "-" };
        open(out, &format!("{side}Shoulder"), &format!("{sign}4 14 0"))?;
        open(out, &format!("{side}Arm"), &format!("{sign}14 0 0"))?;
        open(out, &format!("{side}ForeArm"), &format!("{sign}28 0 0"))?;
        open(out, &format!("{side}Hand"), &format!("{sign}25 0 0"))?;
        for (at, finger) in ["Thumb", "Index", "Middle", "Ring", "Pinky"].iter().enumerate() {
            let z = 3 - 2 * at as i32;
            open(out, &format!("{side}Hand{finger}1"), &format!("{sign}9 0 {z}"))?;
            open(out, &format!("{side}Hand{finger}2"), &format!("{sign}3 0 0"))?;
            open(out, &format!("{side}Hand{finger}3"), &format!("{sign}2 0 0"))?;
            end(out)?;
            close(out, 3)?;
        }
        close(out, 4)?;
    }
    for extra in 0..8 {
        open(out, &format!("Prop{extra}"), "0 5 -10")?;
        end(out)?;
        close(out, 1)?;
    }
    close(out, 4)?;
    assert_eq!(count, JOINTS, "the header's channels are those of the rows");
    Ok(())
}
