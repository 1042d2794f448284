//! The BVH reader and writer on other people's files, and beside `bvh_anim` on those that it reads.
//!
//! The files are not part of the repository: their folder is named by `CHEREME_SHARED_DATA`.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test fails by panicking and may speak"
)]

use std::fs;
use std::path::{Path, PathBuf};

use bvh_anim::ChannelType;
use chereme_formats::bvh::bvh_convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{
    BvhChannel, BvhHierarchy, BvhMotionHeader, BvhReadOptions, BvhReadSummary, BvhReader, BvhWriter, ChannelFix,
    MotionBlock,
};
use chereme_motion::Clip;

struct Read {
    hierarchy: BvhHierarchy,
    header: BvhMotionHeader,
    blocks: Vec<MotionBlock>,
    summary: BvhReadSummary,
}

fn read(bytes: &[u8], block_frames: usize) -> Read {
    let mut reader = BvhReader::open_with(bytes, BvhReadOptions { block_frames }).unwrap();
    let mut blocks = Vec::new();
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block).unwrap() {
        blocks.push(block.clone());
    }
    assert_eq!(reader.bytes_read(), bytes.len() as u64);
    let (hierarchy, header) = (reader.bvh_hierarchy().clone(), reader.bvh_motion_header().clone());
    Read {
        hierarchy,
        header,
        blocks,
        summary: reader.finish_bvh_reading(),
    }
}

fn write(read: &Read) -> Vec<u8> {
    let motion = read
        .header
        .has_motion
        .then_some((read.header.frame_time.as_ref(), read.summary.frames));
    let mut writer = BvhWriter::new(Vec::new(), &read.hierarchy, motion).unwrap();
    for block in &read.blocks {
        writer.write_motion_block(block).unwrap();
    }
    writer.finish_bvh_writing().unwrap()
}

/// Returns the files of the shared data; prints a reason if the folder is missing.
fn files() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set; nothing to compare with");
        return Vec::new();
    };
    let mut files = Vec::new();
    let mut folders = vec![Path::new(&folder).join("motion/bvh")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "bvh") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

#[test]
fn read_write_read_is_equal_in_every_number() {
    for path in files() {
        let bytes = fs::read(&path).unwrap();
        let first = read(&bytes, 256);
        let again = read(&write(&first), 100);
        assert_eq!(again.hierarchy, first.hierarchy, "{path:?}");
        assert_eq!(again.header.frame_time, first.header.frame_time, "{path:?}");
        assert_eq!(again.summary.frames, first.summary.frames, "{path:?}");
        let numbers = |read: &Read| {
            let rows = read
                .blocks
                .iter()
                .flat_map(|block| (0..block.frames).map(move |frame| (block, frame)));
            let columns = |(block, frame): (&MotionBlock, usize)| -> Vec<_> {
                block
                    .columns
                    .iter()
                    .map(|column| column.exact_number_at(frame))
                    .collect()
            };
            rows.flat_map(columns).collect::<Vec<_>>()
        };
        assert!(numbers(&first) == numbers(&again), "{path:?}");
        assert!(numbers(&first) == numbers_of_text(&bytes), "{path:?}");
    }
}

/// Returns the numbers of the rows, read in the plainest way.
fn numbers_of_text(bytes: &[u8]) -> Vec<Option<chereme_formats::bvh::raw::FileNumber>> {
    let text = String::from_utf8_lossy(bytes);
    let Some((_, motion)) = text.split_once("Frame Time:") else {
        return Vec::new();
    };
    motion
        .split_ascii_whitespace()
        .skip(1)
        .map(|token| Some(token.parse().unwrap()))
        .collect()
}

#[test]
fn fixed_point_rows_are_written_byte_for_byte() {
    for path in files()
        .iter()
        .filter(|path| path.ends_with("AV_8Walk_Meredith_HVHA_Rep1.bvh"))
    {
        let bytes = fs::read(path).unwrap();
        let rows = |bytes: &[u8]| {
            let text = String::from_utf8_lossy(bytes).replace("-0.0000 ", "0.0000 ");
            let (_, motion) = text.split_once("Frame Time").unwrap();
            motion
                .lines()
                .skip(1)
                .map(|line| line.trim().to_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(rows(&write(&read(&bytes, 256))), rows(&bytes));
    }
}

#[test]
fn oddities_are_found() {
    let found: Vec<String> = files()
        .iter()
        .flat_map(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let findings = read(&fs::read(path).unwrap(), 256).summary.findings;
            findings
                .into_iter()
                .map(move |f| format!("{name}:{} {}", f.line.unwrap_or(0), f.message))
        })
        .collect();
    eprintln!("{}", found.join("\n"));
    let expected = [
        "Boxing_Toes.bvh:130 the header says 3069 frames, but there are 3070",
        "NGT Thanks.bvh:317 the root's columns hold rotation before position",
        "ànîm.bvh:39 there is no MOTION section",
        "sinusoidal.bvh:15 joint \"child3\" is a leaf without End Site",
        "cmu_12_01_walk.bvh:1 lines end with CR LF",
        "kateBVH.bvh:9 joint \"mixamorig:Spine\" below the root has position channels (48 times)",
    ];
    for start in expected.iter().filter(|_| !found.is_empty()) {
        assert!(found.iter().any(|message| message.starts_with(start)), "{start}");
    }
}

#[test]
fn only_the_signers_file_has_its_root_columns_swapped() {
    let is_swapped = |path: &PathBuf| read(&fs::read(path).unwrap(), 256).summary.root_fix.is_some();
    let files = files();
    let swapped: Vec<_> = files.iter().filter(|path| is_swapped(path)).collect();
    assert!(
        files.is_empty() || (swapped.len() == 1 && swapped[0].ends_with("NGT Thanks.bvh")),
        "{swapped:?}"
    );
    use BvhChannel::{Xposition, Xrotation, Yposition, Yrotation, Zposition, Zrotation};
    let said = [Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation];
    let meant = [Xrotation, Yrotation, Zrotation, Xposition, Yposition, Zposition];
    assert_eq!(ChannelFix::RotationBeforePosition.apply_channel_fix(&said), meant);
}

/// Returns the clip of a file's blocks, in its own unit and axes.
fn clip_of(read: &Read) -> Clip {
    let mut builder = ClipBuilder::new(&read.hierarchy, read.summary.root_fix).unwrap();
    for block in &read.blocks {
        builder.push_block_rows(0..block.frames, |at| block.columns.get(at));
    }
    builder
        .finish_bvh_clip(bvh_convert::rate_from_frame_time(read.header.frame_time.as_ref()).unwrap())
        .unwrap()
}

#[test]
fn clips_convert_to_columns_with_equal_rotations() {
    for path in files() {
        let first = read(&fs::read(&path).unwrap(), 256);
        let clip = clip_of(&first);
        // If the root's columns have another order than the header says, the header gives the order to write.
        assert_eq!(
            bvh_convert::widen_hierarchy(&first.hierarchy, &clip),
            first.hierarchy,
            "{path:?}"
        );
        let columns = bvh_convert::columns_from_clip(&clip, &first.hierarchy, 9).unwrap();
        let block = MotionBlock {
            first_frame: 0,
            frames: clip.clip_frame_count(),
            columns,
        };
        let summary = BvhReadSummary {
            root_fix: None,
            ..first.summary
        };
        let again = clip_of(&Read {
            blocks: vec![block],
            summary,
            ..first
        });
        for joint in 0..clip.clip_skeleton().len() {
            for frame in 0..clip.clip_frame_count() {
                let (a, b) = (
                    clip.joint_channel(joint).rotations[frame],
                    again.joint_channel(joint).rotations[frame],
                );
                assert!(a.angle_between(b) < 1e-7, "{path:?} {joint} {frame}");
                let (a, b) = (
                    clip.joint_translation(joint, frame),
                    again.joint_translation(joint, frame),
                );
                assert!(a.abs_diff_eq(b, 1e-8), "{path:?} {joint} {frame}");
            }
        }
    }
}

#[test]
fn clean_files_read_as_in_an_independent_reader() {
    let mut compared = 0;
    let mut refused = Vec::new();
    for path in files() {
        let bytes = fs::read(&path).unwrap();
        let Ok(Ok(theirs)) = std::panic::catch_unwind(|| bvh_anim::from_bytes(&bytes)) else {
            refused.push(path);
            continue;
        };
        let ours = read(&bytes, 64);
        compared += 1;
        compare(&ours, &theirs, &path);
        let copy = bvh_anim::from_bytes(write(&ours)).unwrap();
        compare(&ours, &copy, &path);
    }
    eprintln!("{compared} files compared; the oracle does not read {refused:?}");
    assert!(compared == 0 || compared > 25);
}

fn compare(ours: &Read, theirs: &bvh_anim::Bvh, path: &Path) {
    assert_eq!(ours.summary.frames, theirs.num_frames() as u64, "{path:?}");
    let ours_time = ours.header.frame_time.as_ref().unwrap().to_f64();
    assert!((theirs.frame_time().as_secs_f64() - ours_time).abs() < 1e-8, "{path:?}");
    let mut joints = ours.hierarchy.joints.iter();
    for joint in theirs.joints().filter(|joint| joint.data().num_channels() > 0) {
        let mine = joints.next().unwrap();
        let data = joint.data();
        // The oracle cuts names at blanks and colons.
        let cut = mine.name.split([' ', ':']).next().unwrap();
        assert_eq!(cut.as_bytes(), <_ as AsRef<[u8]>>::as_ref(data.name()), "{path:?}");
        let offset = data.offset();
        let offsets = [offset.x, offset.y, offset.z];
        assert_eq!(
            mine.offset.each_ref().map(|number| number.to_f64() as f32),
            offsets,
            "{path:?}"
        );
        let words: Vec<&str> = data
            .channels()
            .iter()
            .map(|channel| word(channel.channel_type()))
            .collect();
        assert_eq!(
            mine.channels
                .iter()
                .map(|channel| channel.channel_word())
                .collect::<Vec<_>>(),
            words,
            "{path:?}"
        );
    }
    let mut frames = theirs.frames();
    for block in &ours.blocks {
        for frame in 0..block.frames {
            let row = frames.next().unwrap().as_slice();
            let mine: Vec<f32> = block
                .columns
                .iter()
                .map(|column| column.decimal_value_at(frame) as f32)
                .collect();
            assert!(
                mine.iter().zip(row).all(|(a, b)| (a - b).abs() <= a.abs() * 1.2e-7),
                "{path:?} {frame}"
            );
        }
    }
}

fn word(channel: ChannelType) -> &'static str {
    match channel {
        ChannelType::PositionX => "Xposition",
        ChannelType::PositionY => "Yposition",
        ChannelType::PositionZ => "Zposition",
        ChannelType::RotationX => "Xrotation",
        ChannelType::RotationY => "Yrotation",
        ChannelType::RotationZ => "Zrotation",
    }
}
