//! The answers of the BVH reader to odd, broken and hostile text.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test fails by panicking and may speak"
)]

use std::fmt::Write as _;

use chereme_formats::bvh::raw::{BvhError, BvhHierarchy, BvhReadSummary, BvhReader, BvhWriter, MotionBlock};

const GOOD: &str = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 90 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n\
\tJOINT Left Arm\n\t{\n\t\tOFFSET 10.5 0 0\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 5 0 0\n\t\t}\n\t}\n}\n\
MOTION\nFrames: 3\nFrame Time: 0.01\n\
1 2 3 4 5 6 7 8 9\n1.5 -2.25 3e-3 0 -0 6 7 8 9\n1 2 3 4 5 6 7 8 9\n";

/// One joint of one channel; `@` stands for the rows.
const TINY: &str = "HIERARCHY\nROOT A\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n";

struct Read {
    hierarchy: BvhHierarchy,
    blocks: Vec<MotionBlock>,
    summary: BvhReadSummary,
}

fn read(bytes: &[u8]) -> Result<Read, BvhError> {
    let mut reader = BvhReader::open_bvh(bytes)?;
    let mut blocks = Vec::new();
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block)? {
        blocks.push(block.clone());
    }
    Ok(Read {
        hierarchy: reader.bvh_hierarchy().clone(),
        blocks,
        summary: reader.finish_bvh_reading(),
    })
}

/// Returns the findings' lines and messages, or the error, as text.
fn answer(bytes: &[u8]) -> String {
    match read(bytes) {
        Err(error) => error.to_string(),
        Ok(read) => {
            let mut text = format!("{} frames", read.summary.frames);
            for finding in read.summary.findings {
                let line = finding.line.unwrap_or(0);
                write!(text, " | {line}: {}", finding.message).unwrap();
            }
            text
        }
    }
}

/// Asserts that the answer to each text contains the expected one.
fn check<'a>(cases: impl IntoIterator<Item = (&'a str, impl AsRef<[u8]>, &'a str)>) {
    let mut failures = String::new();
    for (name, bytes, expected) in cases {
        let answer = answer(bytes.as_ref());
        if !answer.starts_with(expected) {
            write!(failures, "\n{name}\n  expected: {expected}\n    answer: {answer}").unwrap();
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

fn good(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from:?}");
    GOOD.replacen(from, to, 1)
}

fn tiny(rows: &str) -> String {
    format!("{TINY}{rows}")
}

#[test]
fn deviations_from_the_format_are_tolerated_with_findings() {
    let cases: Vec<(&str, String, &str)> = vec![
        ("as it should be", GOOD.into(), "3 frames"),
        (
            "byte-order mark",
            format!("\u{feff}{GOOD}"),
            "3 frames | 1: the file begins with a byte-order mark; skipped",
        ),
        (
            "CR LF",
            GOOD.replace('\n', "\r\n"),
            "3 frames | 1: lines end with CR LF, as on Windows",
        ),
        (
            "CR",
            GOOD.replace('\n', "\r"),
            "3 frames | 1: lines end with CR alone, as on old Macs",
        ),
        (
            "no HIERARCHY",
            good("HIERARCHY\n", ""),
            "3 frames | 1: the line HIERARCHY is missing",
        ),
        (
            "End site",
            good("End Site", "End site"),
            "3 frames | 10: the keyword \"End site\" has an unusual spelling",
        ),
        (
            "EndSite",
            good("End Site", "EndSite"),
            "3 frames | 10: the keyword \"EndSite\" has an unusual spelling",
        ),
        (
            "End Site name",
            good("End Site", "End Site Tip"),
            "3 frames | 10: an End Site has the name \"Tip\"; dropped",
        ),
        (
            "root, motion",
            good("ROOT", "root").replace("MOTION", "Motion"),
            "3 frames | 2: the keyword \"root\" has an unusual spelling (2 times)",
        ),
        (
            "brace on name line",
            good("ROOT Hips\n{", "ROOT Hips {"),
            "3 frames | 2: the brace of joint \"Hips\" stands",
        ),
        (
            "offset over lines",
            good("10.5 0 0", "10.5\n0 0"),
            "3 frames | 8: the OFFSET of joint \"Left Arm\" goes over",
        ),
        (
            "no offset",
            good("OFFSET 10.5 0 0\n", "\n"),
            "3 frames | 7: joint \"Left Arm\" has no OFFSET; taken as 0 0 0",
        ),
        (
            "no End Site",
            good("End Site\n\t\t{\n\t\t\tOFFSET 5 0 0\n\t\t}\n", ""),
            "3 frames | 7: joint \"Left Arm\" is a leaf without End Site",
        ),
        (
            "End Site and child",
            good("\tJOINT", "\tEnd Site\n{\nOFFSET 1 2 3\n}\n\tJOINT"),
            "3 frames | 3: joint \"Hips\" has an End Site beside children",
        ),
        (
            "two End Sites",
            good("\t\tEnd Site", "\tEnd Site\n{\nOFFSET 1 2 3\n}\n\tEnd Site"),
            "3 frames | 7: joint \"Left Arm\" has several End Sites",
        ),
        (
            "channel count",
            good("CHANNELS 3", "CHANNELS 4"),
            "3 frames | 9: joint \"Left Arm\" announces 4 channels and names 3; the names count",
        ),
        (
            "no channel count",
            good("CHANNELS 3", "CHANNELS"),
            "3 frames | 9: joint \"Left Arm\" announces Zrotation channels and names 3",
        ),
        (
            "channels over lines",
            good("CHANNELS 3 Zrotation", "CHANNELS 3 Zrotation\n"),
            "3 frames",
        ),
        (
            "two names alike",
            good("Left Arm", "Hips"),
            "3 frames | 6: two joints are called \"Hips\"",
        ),
        ("no name", good("Left Arm", ""), "3 frames | 6: a joint has no name"),
        (
            "positions below the root",
            good(
                "CHANNELS 3 Zrotation Xrotation Yrotation",
                "CHANNELS 3 Xposition Yposition Zposition",
            ),
            "3 frames | 9: joint \"Left Arm\" below the root has position",
        ),
        (
            "scale",
            good(
                "CHANNELS 3 Zrotation Xrotation Yrotation",
                "CHANNELS 3 Xscale Yscale Zscale",
            ),
            "3 frames | 9: joint \"Left Arm\" has scale channels",
        ),
        (
            "no MOTION",
            GOOD.split("MOTION").next().unwrap().into(),
            "0 frames | 16: there is no MOTION section",
        ),
        (
            "only MOTION",
            format!("{}MOTION\n", GOOD.split("MOTION").next().unwrap()),
            "0 frames | 16: the line \"Frames:\" is missing; rows are counted instead | 17: there are no frames: a skeleton without movement | 17: there is no frame time above 0 (missing)",
        ),
        (
            "zero frames",
            TINY.replace("Frames: 2", "Frames: 0"),
            "0 frames | 14: there are no frames",
        ),
        (
            "too few frames",
            tiny("1\n"),
            "1 frames | 14: the header says 2 frames, but there are 1; the rows count",
        ),
        (
            "too many frames",
            tiny("1\n2\n3\n"),
            "3 frames | 14: the header says 2 frames, but there are 3",
        ),
        (
            "four thousand million",
            tiny("1\n").replace("Frames: 2", "Frames: 4000000000"),
            "1 frames | 14: the header says 4000000000 frames, but",
        ),
        (
            "more than numbers hold",
            tiny("1\n").replace("Frames: 2", "Frames: 99999999999999999999999"),
            "1 frames | 12: the frame count \"99999999999999999999999\" is no count",
        ),
        (
            "frame count -1",
            tiny("1\n2\n").replace("Frames: 2", "Frames: -1"),
            "2 frames | 12: the frame count \"-1\" is no count",
        ),
        (
            "frame count missing",
            tiny("1\n2\n").replace("Frames: 2\n", ""),
            "2 frames | 11: the line \"Frames:\" is missing",
        ),
        (
            "header case",
            tiny("1\n2\n").replace("Frame Time", "Frame time"),
            "2 frames | 13: the keyword \"Frame time\" has an unusual spelling",
        ),
        (
            "header without blank",
            tiny("1\n2\n").replace("Time: ", "Time:"),
            "2 frames | 13: the header line \"Frame Time\" has unusual blanks",
        ),
        (
            "header without colon",
            tiny("1\n2\n").replace("Time: 0.01", "Time .01"),
            "2 frames | 13: the header line \"Frame Time\" has unusual blanks",
        ),
        (
            "blank before colon",
            tiny("1\n2\n").replace("Time:", "Time :"),
            "2 frames",
        ),
        (
            "header on one line",
            tiny("1\n2\n").replace("2\nFrame", "2 Frame"),
            "2 frames",
        ),
        (
            "no frame time, one frame",
            tiny("1\n").replace("Frames: 2\nFrame Time: 0.01", "Frames: 1"),
            "1 frames | 13: there is no frame time above 0 (missing)",
        ),
        (
            "frame time 30",
            tiny("1\n2\n").replace("0.01", "30"),
            "2 frames | 13: a frame lasts 30 seconds",
        ),
        (
            "frames on one line",
            tiny("1 2"),
            "2 frames | 14: several frames stand on one line",
        ),
        (
            "one line, cut off",
            good("9\n1.5", "9 1.5").replace("0 6 7 8 9\n1 2 3 4 5 6 7 8 9\n", ""),
            "1 frames | 19: the header says 3 frames, but there are 1; the rows count | 19: the last row breaks off: 4 numbers of 9; dropped",
        ),
        (
            "last row incomplete",
            GOOD.trim_end_matches("6 7 8 9\n").into(),
            "2 frames | 19: the header says 3 frames, but there are 2; the rows count | 21: the last row breaks off: 5 numbers of 9; dropped",
        ),
        ("blank lines", GOOD.replace('\n', "\n\n \t\n"), "3 frames"),
        (
            "text after",
            tiny("1\n2\n# made by hand 1 2 3\nmore"),
            "2 frames | 16: text follows the motion, beginning with \"#\"; ignored",
        ),
        (
            "all on one line",
            GOOD.replace('\n', " "),
            "3 frames | 1: the brace of joint \"Hips\" stands on the line of the name (2 times) | 1: several frames",
        ),
    ];
    check(cases);
}

#[test]
fn meaningless_files_are_refused() {
    let utf16: Vec<u8> = GOOD.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let utf16_mark: Vec<u8> = [0xff, 0xfe].into_iter().chain(utf16.iter().copied()).collect();
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("empty", b"".to_vec(), "line 1: the file is empty"),
        ("blank", b" \n\n".to_vec(), "line 3: the file is empty"),
        ("UTF-16", utf16, "line 1: the text is UTF-16; save the file as UTF-8"),
        ("UTF-16 with mark", utf16_mark, "line 1: the text is UTF-16"),
        ("binary", b"\x7fELF\x02\0\0\x01".to_vec(), "line 1: this is not text"),
        (
            "binary without zeros",
            b"\x89PNG\r\n\x1a\nxyz".to_vec(),
            "line 1: this is not text",
        ),
        (
            "XML",
            b"<?xml version='1.0'?>".to_vec(),
            "line 1: the file begins with \"<?xml\", not with HIERARCHY",
        ),
        (
            "two roots",
            good("MOTION", "ROOT B\n{\n}\nMOTION").into(),
            "line 16: a second ROOT; split the file",
        ),
        ("root inside", good("JOINT", "ROOT").into(), "line 6: a second ROOT"),
        (
            "unknown channel",
            good("Zrotation", "Wrotation").into(),
            "line 5: the channel \"Wrotation\" of joint \"Hips\" is unknown; channels are",
        ),
        (
            "cut in the hierarchy",
            GOOD[..120].into(),
            "line 6: found \"the end of the file\" where the opening",
        ),
        (
            "unclosed",
            good("}\nMOTION", "MOTION").into(),
            "line 15: the brace that joint \"Hips\" opened on line 3 is not closed before MOTION",
        ),
        (
            "brace too many",
            good("}\nMOTION", "}\n}\nMOTION").into(),
            "line 16: found \"}\" where MOTION belongs",
        ),
        (
            "no brace",
            good("\t{", "\t").into(),
            "line 8: found \"OFFSET\" where the opening",
        ),
        (
            "short offset",
            good("10.5 0 0", "10.5 0").into(),
            "line 9: OFFSET of joint \"Left Arm\": \"CHANNELS\" is not a number",
        ),
        (
            "long offset",
            good("10.5 0 0", "10.5 0 0 7").into(),
            "line 8: found \"7\" where OFFSET, CHANNELS",
        ),
        (
            "comma in offset",
            good("10.5", "10,5").into(),
            "line 8: OFFSET of joint \"Left Arm\": \"10,5\" has a decimal comma; export with",
        ),
        (
            "comma in frame time",
            good("0.01", "0,01").into(),
            "line 18: Frame Time: \"0,01\" has a decimal comma",
        ),
        (
            "no frame time",
            good("Frame Time: 0.01\n", "").into(),
            "line 18: there is no frame time; give the seconds per frame",
        ),
        (
            "frame time 0",
            good("0.01", "0.0").into(),
            "line 18: the frame time is 0.0; give",
        ),
        (
            "frame time negative",
            good("0.01", "-0.01").into(),
            "line 18: the frame time is -0.01",
        ),
        (
            "frame time of many digits",
            good("0.01", &format!("-{}", "1".repeat(309))).into(),
            "line 18: the frame time is -111111111111111111111111111111111111111…; give",
        ),
        (
            "one frame said, two there",
            tiny("1\n2\n")
                .replace("Frames: 2\nFrame Time: 0.01", "Frames: 1")
                .into(),
            "line 13: there is no frame time",
        ),
        (
            "NaN",
            good("-2.25", "nan").into(),
            "line 20: column 2 (Yposition of joint \"Hips\"): \"nan\" is not a finite number; the exporter",
        ),
        (
            "NaN first",
            good("1.5", "NaN").into(),
            "line 20: column 1 (Xposition of joint \"Hips\"): \"NaN\" is not a finite",
        ),
        (
            "NaN after the last",
            tiny("1\n2\nnan\n").into(),
            "line 16: column 1 (Xrotation of joint \"A\"): \"nan\" is not a finite",
        ),
        (
            "infinity",
            good("-2.25", "-1.#INF").into(),
            "line 20: column 2 (Yposition of joint \"Hips\"): \"-1.#INF\" is not a finite",
        ),
        (
            "1e400",
            good("-2.25", "1e400").into(),
            "line 20: column 2 (Yposition of joint \"Hips\"): \"1e400\" is larger than",
        ),
        (
            "decimal comma",
            good("-2.25", "-2,25").into(),
            "line 20: column 2 (Yposition of joint \"Hips\"): \"-2,25\" has a decimal comma",
        ),
        (
            "garbage",
            good("-2.25", "abc").into(),
            "line 20: column 2 (Yposition of joint \"Hips\"): \"abc\" is not a number",
        ),
        (
            "narrow row",
            good("5 6 7 8 9\n1.5", "5 6 7 8\n1.5").into(),
            "line 19: the row has 8 numbers, but the hierarchy has 9 channels",
        ),
        (
            "wide row",
            good("8 9\n1.5", "8 9 10\n1.5").into(),
            "line 19: the row has 10 numbers, but the hierarchy has 9",
        ),
        (
            "wide last row",
            format!("{}10\n", GOOD.trim_end().to_owned() + " ").into(),
            "line 21: the row has 10 numbers",
        ),
        (
            "wrapped row",
            good("4 5", "4\n5").into(),
            "line 19: the row has 4 numbers",
        ),
        (
            "text before the last",
            tiny("1\nthe end\n").into(),
            "line 15: column 1 (Xrotation of joint \"A\"): \"the\" is not a number",
        ),
        (
            "numbers without channels",
            tiny("1\n").replace("CHANNELS 1 Xrotation", "CHANNELS 0").into(),
            "line 14: the row has 1 numbers, but the hierarchy has 0",
        ),
        (
            "a word without end",
            tiny(&"9".repeat(5000)).into(),
            "line 14: a word of more than 1024 bytes",
        ),
        (
            "a name without end",
            good("Hips", &"x".repeat(5000)).into(),
            "line 2: a word of more than 1024 bytes",
        ),
        (
            "header garbage",
            good("Frames", "Fromage").into(),
            "line 17: found \"Fromage\" where \"Frames:\"",
        ),
    ];
    check(cases);
}

/// Returns a hierarchy of `joints` one below the other, or all below the root.
fn many(joints: usize, nested: bool) -> String {
    let mut text = String::from("HIERARCHY\nROOT R\n{\nOFFSET 0 0 0\nCHANNELS 0\n");
    for joint in 1..joints {
        write!(
            text,
            "JOINT J{joint}\n{{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
        )
        .unwrap();
        if !nested {
            text.push_str("}\n");
        }
    }
    text.push_str(&"}\n".repeat(if nested { joints } else { 1 }));
    text.push_str("MOTION\nFrames: 2\nFrame Time: 0.01\n");
    for _ in 0..2 {
        text.push_str(&"1.5 ".repeat((joints - 1) * 3));
        text.push('\n');
    }
    text
}

#[test]
fn large_hierarchies_are_read() {
    let deep = format!("HIERARCHY\nROOT A {{\n{}", "JOINT B {\n".repeat(1_000_000));
    check([
        (
            "ten thousand joints",
            many(10_000, false),
            "2 frames | 3: joint \"R\" has no channels",
        ),
        (
            "a hundred thousand joints",
            many(100_000, false),
            "line 54619: more than 32768 channels",
        ),
        ("512 deep", many(512, true), "2 frames"),
        (
            "513 deep",
            many(513, true),
            "line 2050: joints are nested more than 512 deep",
        ),
        ("a million deep", deep, "line 514: joints are nested more than 512 deep"),
    ]);
}

#[test]
fn numbers_of_endless_digits_are_bounded() {
    let mut text = many(1000, false);
    text.truncate(text.find("1.5 ").unwrap());
    let row = format!("0.{} ", "3".repeat(999)).repeat(999 * 3) + "\n";
    let frames = text.replace("Frames: 2", "Frames: 12") + &row.repeat(12);
    check([(
        "3 MB a row",
        frames,
        "line 5016: more than 33554432 bytes of numbers with more than eighteen",
    )]);
}

#[test]
fn truncation_at_any_byte_never_panics() {
    let whole = read(GOOD.as_bytes()).unwrap();
    for end in 0..GOOD.len() {
        if let Ok(read) = read(&GOOD.as_bytes()[..end]) {
            assert_eq!(read.hierarchy, whole.hierarchy, "{end}");
            let frames = whole.blocks[0].frames.min(read.summary.frames as usize);
            assert!(frames == 3 || !read.summary.findings.is_empty(), "{end}");
        }
    }
}

#[test]
fn flipped_bytes_never_panic_and_what_reads_reads_again() {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let pieces: [&[u8]; 12] = [
        b"\n",
        b"}",
        b"{",
        b"1e9",
        b"-",
        b"nan",
        b"\r",
        b" ",
        b"JOINT",
        b"\xff",
        b"\0",
        b"123456789012345678901",
    ];
    for _ in 0..4000 {
        let mut bytes = GOOD.as_bytes().to_vec();
        for _ in 0..=random(3) {
            let at = random(bytes.len());
            match random(4) {
                0 => bytes[at] ^= 1 << random(8),
                1 => drop(bytes.remove(at)),
                2 => drop(bytes.splice(at..at, pieces[random(pieces.len())].iter().copied())),
                _ => bytes[at] = random(256) as u8,
            }
        }
        if let Ok(first) = read(&bytes) {
            assert_written_equal(&first);
        }
    }
}

fn assert_written_equal(first: &Read) {
    let frame_time = "0.01".parse().unwrap();
    let motion = Some((Some(&frame_time), first.summary.frames));
    let Ok(mut writer) = BvhWriter::new(Vec::new(), &first.hierarchy, motion) else {
        return;
    };
    for block in &first.blocks {
        writer.write_motion_block(block).unwrap();
    }
    let again = read(&writer.finish_bvh_writing().unwrap()).unwrap();
    assert_eq!(again.hierarchy, first.hierarchy);
    assert_eq!(again.summary.frames, first.summary.frames);
    for (a, b) in first.blocks.iter().zip(&again.blocks) {
        for (a, b) in a.columns.iter().zip(&b.columns) {
            assert!(
                (0..a.mantissas.len()).all(|frame| a.exact_number_at(frame) == b.exact_number_at(frame)),
                "{a:?} {b:?}"
            );
        }
    }
}

/// Gives its bytes in pieces of a size.
struct Pieces<'a>(&'a [u8], usize);

impl std::io::Read for Pieces<'_> {
    fn read(&mut self, to: &mut [u8]) -> std::io::Result<usize> {
        let count = self.1.min(self.0.len()).min(to.len());
        let (now, later) = self.0.split_at(count);
        to[..count].copy_from_slice(now);
        self.0 = later;
        Ok(count)
    }
}

#[test]
fn pieces_of_any_size_read_alike() {
    let mut text = GOOD.to_owned();
    let mut plain: Vec<f64> = Vec::new();
    for frame in 0..9000u32 {
        let row: Vec<String> = (0..9)
            .map(|c| format!("{:.4}", f64::from(frame * 7 % 1000) * 0.37 - f64::from(c) * 20.0))
            .collect();
        plain.extend(row.iter().map(|number| number.parse::<f64>().unwrap()));
        text.push_str(&row.join(" "));
        text.push('\n');
    }
    for size in [1, 2, 3, 7, 64, 4095, 65_536, 262_143, 1 << 20] {
        let mut reader = BvhReader::open_bvh(Pieces(text.as_bytes(), size)).unwrap();
        let (mut block, mut row) = (MotionBlock::default(), 0);
        while reader.next_block(&mut block).unwrap() {
            assert_eq!(block.first_frame, row as u64);
            for frame in 0..block.frames {
                for (index, column) in block.columns.iter().enumerate() {
                    let at = (row + frame).checked_sub(3).map(|row| plain[row * 9 + index]);
                    assert!(
                        at.is_none_or(|value| value == column.decimal_value_at(frame)),
                        "{size} {row} {frame}"
                    );
                }
            }
            row += block.frames;
        }
        assert_eq!(reader.bytes_read(), text.len() as u64);
        assert_eq!(reader.finish_bvh_reading().frames, 9003);
    }
}
