//! Reading and writing BVH beside `bvh_anim` and beside the standard library's own number parser.
//!
//! The recording is generated here: 75 joints, 228 channels, 120 frames per second, sums of sinusoids of 0.2 to 6
//! Hz with a little noise, written with six digits after the point as most exporters do. After divan's table come
//! the ratios: sums over runs taken in turns, by processor time if the system reports it, so that a busy machine
//! misleads less.

#![allow(clippy::print_stdout, reason = "the ratios are the bench's result")]

use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

use chereme_formats::bvh::raw::{BvhReader, BvhWriter, MotionBlock};
use divan::Bencher;
use divan::counter::BytesCount;

const JOINTS: usize = 75;
const CHANNELS: usize = 3 + 3 * JOINTS;
const FRAMES: usize = 2400;
const WAVES: usize = 8;

fn main() {
    divan::main();
    if std::env::args().any(|argument| argument == "--bench") {
        print_ratios();
    }
}

#[divan::bench]
fn read(bencher: Bencher) {
    run(bencher, read_ours);
}

#[divan::bench]
fn read_bvh_anim(bencher: Bencher) {
    run(bencher, read_theirs);
}

#[divan::bench]
fn split_and_parse(bencher: Bencher) {
    run(bencher, split_and_parse_numbers);
}

#[divan::bench]
fn write(bencher: Bencher) {
    let text = recording();
    let blocks = blocks(text.as_bytes());
    bencher
        .counter(BytesCount::of_str(&text))
        .bench_local(|| write_ours(&text, &blocks));
}

#[divan::bench]
fn write_bvh_anim(bencher: Bencher) {
    let text = recording();
    let theirs = bvh_anim::from_str(&text).expect("made text is sound");
    bencher
        .counter(BytesCount::of_str(&text))
        .bench_local(|| write_theirs(&theirs));
}

fn run(bencher: Bencher, reading: fn(&str) -> f64) {
    let text = recording();
    bencher
        .counter(BytesCount::of_str(&text))
        .bench_local(|| reading(black_box(&text)));
}

fn read_ours(text: &str) -> f64 {
    let mut reader = BvhReader::open_bvh(text.as_bytes()).expect("made text is sound");
    let mut block = MotionBlock::default();
    let mut last = 0.0;
    while reader.next_block(&mut block).expect("made text is sound") {
        last = block.columns[0].decimal_value_at(block.frames - 1);
    }
    last
}

fn read_theirs(text: &str) -> f64 {
    let bvh = bvh_anim::from_str(text).expect("made text is sound");
    bvh.frames().last().map_or(0.0, |frame| f64::from(frame.as_slice()[0]))
}

fn split_and_parse_numbers(text: &str) -> f64 {
    let (_, motion) = text
        .split_once("Frame Time: 0.00833333\n")
        .expect("made text has a header");
    let numbers = motion
        .split_ascii_whitespace()
        .map(|token| token.parse::<f64>().expect("made text is sound"));
    numbers.collect::<Vec<f64>>().len() as f64
}

fn blocks(text: &[u8]) -> Vec<MotionBlock> {
    let mut reader = BvhReader::open_bvh(text).expect("made text is sound");
    let mut blocks = Vec::new();
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block).expect("made text is sound") {
        blocks.push(block.clone());
    }
    blocks
}

fn write_ours(text: &str, blocks: &[MotionBlock]) -> usize {
    let reader = BvhReader::open_bvh(text.as_bytes()).expect("made text is sound");
    let motion = Some((reader.bvh_motion_header().frame_time.as_ref(), FRAMES as u64));
    let out = Vec::with_capacity(text.len() + 1024);
    let mut writer = BvhWriter::new(out, reader.bvh_hierarchy(), motion).expect("a vector takes all");
    blocks
        .iter()
        .for_each(|block| writer.write_motion_block(block).expect("a vector takes all"));
    writer.finish_bvh_writing().expect("a vector takes all").len()
}

fn write_theirs(bvh: &bvh_anim::Bvh) -> usize {
    let options = bvh_anim::write::WriteOptions::new().with_motion_values_significant_figures(6);
    options.write_to_string(bvh).len()
}

/// Prints the speed of this reader and writer as a multiple of each peer's.
fn print_ratios() {
    let text = recording();
    let blocks = blocks(text.as_bytes());
    let theirs = bvh_anim::from_str(&text).expect("made text is sound");
    let mut seconds = [0.0; 5];
    for _ in 0..8 {
        seconds[0] += time(40, || read_ours(&text) as usize);
        seconds[1] += time(6, || read_theirs(&text) as usize);
        seconds[2] += time(15, || split_and_parse_numbers(&text) as usize);
        seconds[3] += time(20, || write_ours(&text, &blocks));
        seconds[4] += time(3, || write_theirs(&theirs));
    }
    let megabytes = 8.0 * text.len() as f64 / 1e6;
    let [read, anim, split, write, write_anim] = seconds.map(|seconds| megabytes / seconds);
    println!(
        "read: {read:.0} MB/s, {:.1} x bvh_anim, {:.1} x split and parse",
        read / anim,
        read / split
    );
    println!("write: {write:.0} MB/s, {:.1} x bvh_anim", write / write_anim);
}

/// Returns the seconds of one run, the mean of many: the system counts processor time in steps of milliseconds.
fn time(runs: usize, run: impl Fn() -> usize) -> f64 {
    let (start, before) = (Instant::now(), processor_seconds());
    for _ in 0..runs {
        black_box(run());
    }
    let all = match (before, processor_seconds()) {
        (Some(before), Some(after)) => after - before,
        _ => start.elapsed().as_secs_f64(),
    };
    all / runs as f64
}

/// Returns the running time of this thread, as Linux reports it.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split(' ').next()?.parse::<f64>().ok()? / 1e9)
}

/// Returns the recording's text, the same in every run.
fn recording() -> String {
    let mut text = hierarchy();
    let mut random = Random(20);
    let waves: Vec<[(f64, f64, f64); WAVES]> = (0..CHANNELS).map(|_| waves(&mut random)).collect();
    write!(text, "MOTION\nFrames: {FRAMES}\nFrame Time: 0.00833333\n").expect("a string takes all");
    for frame in 0..FRAMES {
        let seconds = frame as f64 / 120.0;
        for (channel, waves) in waves.iter().enumerate() {
            let sum: f64 = waves
                .iter()
                .map(|(height, speed, phase)| height * (speed * seconds + phase).sin())
                .sum();
            let (scale, level) = match channel {
                1 => (2.0, 95.0),
                0 | 2 => (2.0, 0.0),
                _ if channel < 90 => (6.0, 0.0),
                _ if channel % 3 == 1 => (25.0, 30.0),
                _ => (4.0, 0.0),
            };
            let value = level + scale * sum + 0.01 * random.next();
            let end = if channel + 1 == CHANNELS { '\n' } else { ' ' };
            write!(text, "{value:.6}{end}").expect("a string takes all");
        }
    }
    text
}

fn waves(random: &mut Random) -> [(f64, f64, f64); WAVES] {
    std::array::from_fn(|_| {
        let hertz = 0.2 * 30f64.powf(random.next().abs());
        (
            0.4 * random.next() / hertz,
            std::f64::consts::TAU * hertz,
            3.2 * random.next(),
        )
    })
}

/// A chain of joints in arms of five.
fn hierarchy() -> String {
    let mut text = String::from("HIERARCHY\nROOT Hips\n{\n\tOFFSET 0.000000 95.000000 0.000000\n");
    text.push_str("\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n");
    for joint in 1..JOINTS {
        text.push_str(&format!(
            "\tJOINT Joint{joint}\n\t{{\n\t\tOFFSET 3.500000 -0.250000 1.000000\n"
        ));
        text.push_str("\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n");
        if joint % 5 == 0 || joint == JOINTS - 1 {
            text.push_str("\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 2.800000 0.000000 0.000000\n\t\t}\n");
            text.push_str(&"\t}\n".repeat(if joint % 5 == 0 { 5 } else { joint % 5 }));
        }
    }
    text + "}\n"
}

/// Numbers between -1 and 1 that are the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
