//! Tests of reading and writing MP4: times, colours, rotations, fragments, and damaged files.

use crate::mp4::read_mp4_index;
use std::io::Cursor;

use proptest::prelude::*;

use super::{FilmProperties, Mp4Container, Mp4Error, Mp4Muxer, PictureColours, PictureRotation, mp4_h264};

/// Returns Exp-Golomb codes as binary digits.
fn codes(values: &[u32]) -> String {
    let code = |value: &u32| {
        let bits = format!("{:b}", value + 1);
        format!("{}{bits}", "0".repeat(bits.len() - 1))
    };
    values.iter().map(code).collect()
}

/// A sequence of 32 by 32 pixels in the profile "High" whose colours are BT.709 over the full range, written by hand.
fn sequence() -> Vec<u8> {
    // 4:2:0 in eight bits, no scaling lists; picture order type 2.
    let format = codes(&[1, 0, 0]) + "00";
    sequence_of(100, &format, &codes(&[2]), "11")
}

/// Returns such a sequence of a profile, with its colour format, its order of pictures, and whether it has frames only
/// (with the flag that follows).
fn sequence_of(profile: u8, format: &str, order: &str, frames: &str) -> Vec<u8> {
    let mut all = format!("{profile:08b}{:08b}{:08b}", 0, 30);
    // seq_parameter_set_id 0; 16 frame numbers, one reference frame; no gaps in frame numbers.
    all += &(codes(&[0]) + format + &codes(&[0]) + order + &codes(&[1]));
    all += "0";
    // Two by two macroblocks; frames only, direct_8x8, no cropping; video usability information follows.
    all += &codes(&[1, 1]);
    all += &format!("{frames}01");
    // No aspect ratio and no overscan; a video format, the full range and a description of the colours; nothing else.
    all += "00110111";
    all += &format!("{:08b}{:08b}{:08b}", 1, 1, 1);
    all += "0000001";
    while !all.len().is_multiple_of(8) {
        all += "0";
    }
    let bytes = all.as_bytes().chunks(8).map(|byte| {
        let text = std::str::from_utf8(byte).expect("digits");
        u8::from_str_radix(text, 2).expect("a byte")
    });
    let mut piece = vec![0x67];
    let mut zeros = 0;
    for byte in bytes {
        if zeros >= 2 && byte <= 3 {
            piece.push(3);
            zeros = 0;
        }
        zeros = if byte == 0 { zeros + 1 } else { 0 };
        piece.push(byte);
    }
    piece
}

/// Returns a film of `count` made-up coded pictures; every fourth refreshes.
fn film(count: usize) -> Vec<u8> {
    film_at_rate(count, (25, 1))
}

fn film_at_rate(count: usize, rate: (u32, u32)) -> Vec<u8> {
    let mut muxer = Mp4Muxer::new(FilmProperties {
        width: 32,
        height: 32,
        rate,
        colours: PictureColours {
            matrix: 1,
            full_range: false,
        },
    });
    for index in 0..count {
        let mut stream = Vec::new();
        let mut put = |piece: &[u8]| {
            stream.extend_from_slice(&[0, 0, 0, 1]);
            stream.extend_from_slice(piece);
        };
        if index % 4 == 0 {
            put(&sequence());
            put(&[0x68, 0xee, 0x3c, 0x80]);
            put(&[0x65, 0x88, index as u8 + 1]);
        } else {
            put(&[0x41, 0x9a, index as u8 + 1, 7]);
        }
        muxer.add_coded_picture(&stream);
    }
    let mut bytes = Vec::new();
    muxer.write_mp4_film(&mut bytes).expect("written");
    bytes
}

#[test]
fn a_film_of_more_than_thirteen_hours_has_its_whole_length() {
    let bytes = film_at_rate(2, (1, 47_000));
    let clock = &bytes[find(&bytes, b"mdhd")..];
    let stated = clock[24..32].try_into().expect("eight");
    assert_eq!((clock[0], u64::from_be_bytes(stated)), (1, 2 * 47_000 * 90_000));
    assert_eq!(opened(&bytes).timescale, 90_000);
}

fn opened(bytes: &[u8]) -> Mp4Container {
    read_mp4_index(&mut Cursor::new(bytes)).expect("a film").0
}

/// Returns the byte at which the content of the first box of a kind begins.
fn find(bytes: &[u8], kind: &[u8; 4]) -> usize {
    let at = memchr::memmem::find(bytes, kind);
    at.expect("the box is there") + 4
}

fn boxed(kind: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let mut bytes = (content.len() as u32 + 8).to_be_bytes().to_vec();
    bytes.extend_from_slice(kind);
    bytes.extend_from_slice(content);
    bytes
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}

/// Appends a box to the one at `path`, lengthens the boxes around it, and shifts the offsets of the index.
fn inserted(bytes: &[u8], path: &[&[u8; 4]], new: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut sizes = Vec::new();
    let (mut at, mut end) = (0, bytes.len());
    for kind in path {
        loop {
            let size = u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four")) as usize;
            if &bytes[at + 4..at + 8] == *kind {
                sizes.push(at);
                end = at + size;
                at += 8;
                break;
            }
            at += size;
            assert!(at < end, "{kind:?} is there");
        }
    }
    for at in sizes {
        let size = u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four"));
        bytes[at..at + 4].copy_from_slice(&(size + new.len() as u32).to_be_bytes());
    }
    bytes.splice(end..end, new.iter().copied());
    let stco = find(&bytes, b"stco") + 8;
    let offset = u32::from_be_bytes(bytes[stco..stco + 4].try_into().expect("four"));
    bytes[stco..stco + 4].copy_from_slice(&(offset + new.len() as u32).to_be_bytes());
    bytes
}

#[test]
fn a_film_that_is_written_is_read_back() {
    let bytes = film(10);
    let film = opened(&bytes);
    assert_eq!((film.width, film.height), (32, 32));
    assert_eq!((film.coding.as_str(), film.coding_name()), ("avc1", "H.264"));
    assert_eq!(film.frames.len(), 10);
    assert_eq!(film.ticks_to_micros(film.film_length_ticks()), 400_000);
    let sync: Vec<bool> = film.frames.iter().map(|frame| frame.sync).collect();
    let want: Vec<bool> = (0..10).map(|index| index % 4 == 0).collect();
    assert_eq!(sync, want);
    for (index, frame) in film.frames.iter().enumerate() {
        assert_eq!(film.ticks_to_micros(frame.shown), index as i64 * 40_000);
        let sample = &bytes[frame.offset as usize..][..frame.size as usize];
        let last = if index % 4 == 0 { index + 1 } else { 7 };
        assert_eq!(sample.last(), Some(&(last as u8)), "{index}");
    }
    assert_eq!(film.sync_before(7), 4);
    let said = mp4_h264::read_avc_configuration(&film.configuration).expect("parameter sets");
    assert_eq!((said.length, said.sets.len()), (4, 2));
    let frame = film.frames[1];
    let sample = &bytes[frame.offset as usize..][..frame.size as usize];
    let mut stream = Vec::new();
    mp4_h264::annex_b(&said, sample, true, &mut stream).expect("a stream");
    let pieces: Vec<&[u8]> = mp4_h264::split_stream_pieces(&stream).collect();
    assert_eq!(pieces.len(), 3);
    assert!(mp4_h264::is_sequence(pieces[0]) && mp4_h264::is_parameters(pieces[1]));
    assert!(!mp4_h264::is_refresh(pieces[2]));
}

#[test]
fn sequences_of_every_kind_are_read_up_to_their_colours() {
    let plain = codes(&[1, 0, 0]) + "00";
    // Lists of 4 by 4 numbers: the first is flat (16 differences of 0), the second ends at once (a difference of -8),
    // the third grows by one each time; and one of 8 by 8.
    let lists = codes(&[1, 0, 0])
        + "01"
        + &("1".to_owned() + &codes(&[0; 16]))
        + &("1".to_owned() + &codes(&[16]))
        + &("1".to_owned() + &codes(&[1; 16]))
        + "000"
        + &("1".to_owned() + &codes(&[0; 64]))
        + "0";
    // Full colours have a flag more, and twelve lists.
    let full = codes(&[3]) + "0" + &codes(&[0, 0]) + "01" + &"0".repeat(12);
    let orders = [
        codes(&[2]),
        codes(&[0, 4]),
        codes(&[1]) + "0" + &codes(&[5, 2, 0]),
        codes(&[1]) + "1" + &codes(&[0, 0, 3, 7, 8, 9]),
    ];
    for (profile, format) in [(100, &plain), (100, &lists), (244, &full), (66, &String::new())] {
        for order in &orders {
            for (frames, interlaced) in [("11", false), ("001", true)] {
                let read = mp4_h264::read_sequence_parameters(&sequence_of(profile, format, order, frames));
                let read = read.unwrap_or_else(|error| panic!("{profile} {order}: {error}"));
                assert_eq!((read.profile, read.interlaced), (profile, interlaced));
                let colours = PictureColours {
                    matrix: 1,
                    full_range: true,
                };
                assert_eq!(read.colours, Some(colours), "{profile} {format} {order} {frames}");
            }
        }
    }
    let endless = codes(&[1]) + "0" + &codes(&[0, 0, 256]);
    let refused = mp4_h264::read_sequence_parameters(&sequence_of(66, "", &endless, "11"));
    assert!(matches!(refused, Err(Mp4Error::Parameters(_))), "{refused:?}");
}

#[test]
fn colours_are_read_from_the_stream_and_from_the_container() {
    let said = mp4_h264::read_sequence_parameters(&sequence()).expect("a sequence");
    let full = PictureColours {
        matrix: 1,
        full_range: true,
    };
    assert_eq!((said.profile, said.interlaced), (100, false));
    assert_eq!(said.colours, Some(full));
    let film = opened(&film(1));
    let limited = PictureColours {
        full_range: false,
        ..full
    };
    assert_eq!(film.colours, Some(limited));
    for cut in 0..sequence().len() {
        // A sequence cut short gives an error, but no panic.
        let _ = mp4_h264::read_sequence_parameters(&sequence()[..cut]);
    }
}

#[test]
fn the_rotation_of_phone_films_is_read() {
    let one = 0x1_0000_u32;
    let minus = one.wrapping_neg();
    for (matrix, turn, size) in [
        ([one, 0, 0, one], PictureRotation::None, [40, 30]),
        ([0, one, minus, 0], PictureRotation::Quarter, [30, 40]),
        ([minus, 0, 0, minus], PictureRotation::Half, [40, 30]),
        ([0, minus, one, 0], PictureRotation::ThreeQuarters, [30, 40]),
        ([7, 7, 7, 7], PictureRotation::None, [40, 30]),
    ] {
        let mut bytes = film(2);
        let at = find(&bytes, b"tkhd") + 40;
        for (term, place) in matrix.iter().zip([0, 4, 12, 16]) {
            bytes[at + place..at + place + 4].copy_from_slice(&term.to_be_bytes());
        }
        let film = opened(&bytes);
        assert_eq!(film.turn, turn, "{matrix:?}");
        assert_eq!(turn.rotated_picture_size([40, 30]), size);
    }
}

#[test]
fn pictures_are_shown_at_their_composition_times() {
    // Decoded in the order 0 1 2 3, shown in the order 0 2 3 1, one frame later than decoded; the edit list removes
    // that delay.
    let ctts = [0, 4, 1, 3600, 1, 10_800, 1, 0, 1, 0];
    let bytes = inserted(
        &film(4),
        &[b"moov", b"trak", b"mdia", b"minf", b"stbl"],
        &boxed(b"ctts", &words(&ctts)),
    );
    let edit = boxed(b"elst", &words(&[0, 1, 160, 3600, 0x1_0000]));
    let bytes = inserted(&bytes, &[b"moov", b"trak"], &boxed(b"edts", &edit));
    let film = opened(&bytes);
    let shown: Vec<i64> = film.frames.iter().map(|it| film.ticks_to_micros(it.shown)).collect();
    assert_eq!(shown, [0, 120_000, 40_000, 80_000]);
    assert_eq!(film.shown_order(), [0, 2, 3, 1]);
    assert!(film.frames.iter().all(|frame| !frame.hidden));
}

#[test]
fn pictures_that_lead_a_refresh_are_decoded_from_the_one_before() {
    let mut film = opened(&film(8));
    // Frame 4 is a sync frame, and frame 5 is shown before it.
    (film.frames[4].shown, film.frames[5].shown) = (film.frames[5].shown, film.frames[4].shown);
    assert_eq!(film.sync_before(4), 4);
    assert_eq!(film.sync_before(5), 0);
    assert_eq!(film.sync_before(6), 4);
}

#[test]
fn an_edit_list_may_delay_and_cut_a_film() {
    // The edit list: half a second of nothing, then two frames from the film's third one on.
    let rows = [0, 2, 500, u32::MAX, 0x1_0000, 80, 7200, 0x1_0000];
    let edit = boxed(b"edts", &boxed(b"elst", &words(&rows)));
    let film = opened(&inserted(&film(8), &[b"moov", b"trak"], &edit));
    let hidden: Vec<bool> = film.frames.iter().map(|frame| frame.hidden).collect();
    assert_eq!(hidden, [true, true, false, false, true, true, true, true]);
    assert_eq!(film.ticks_to_micros(film.frames[2].shown), 500_000);
    assert_eq!(film.shown_order(), [2, 3]);
}

#[test]
fn fragmented_films_are_read() {
    let whole = film(8);
    let described = opened(&whole);
    // The same film without its table, followed by two fragments of four frames each.
    let mut bytes = whole;
    let stsz = find(&bytes, b"stsz") + 8;
    bytes[stsz..stsz + 4].copy_from_slice(&0_u32.to_be_bytes());
    let trex = boxed(b"trex", &words(&[0, 1, 1, 3600, 0, 0x1_0000]));
    let mut bytes = inserted(&bytes, &[b"moov"], &boxed(b"mvex", &trex));
    for piece in 0..2_u32 {
        let frames = &described.frames[piece as usize * 4..][..4];
        let base = bytes.len() as u64;
        let shift = (frames[0].offset + 40).wrapping_sub(base) as u32;
        let mut run = words(&[0x205, 4, shift, 0x200_0000]);
        run.extend(frames.iter().flat_map(|frame| frame.size.to_be_bytes()));
        let mut traf = boxed(b"tfhd", &words(&[0x2_0000, 1]));
        traf.extend(boxed(b"tfdt", &words(&[0, piece * 4 * 3600])));
        traf.extend(boxed(b"trun", &run));
        bytes.extend(boxed(b"moof", &boxed(b"traf", &traf)));
    }
    let film = opened(&bytes);
    assert_eq!(film.frames.len(), 8);
    for (frame, want) in film.frames.iter().zip(&described.frames) {
        assert_eq!((frame.shown, frame.size), (want.shown, want.size));
        assert_eq!((frame.offset, frame.sync), (want.offset + 40, want.sync));
    }
}

#[test]
fn files_that_are_no_film_are_refused_with_an_explanation() {
    let said = |bytes: &[u8]| {
        let refused = read_mp4_index(&mut Cursor::new(bytes)).expect_err("refused");
        refused.to_string()
    };
    assert_eq!(said(b""), Mp4Error::NoMp4.to_string());
    assert_eq!(said(b"RIFF....AVI LIST"), Mp4Error::NoMp4.to_string());
    let bytes = film(3);
    let movie = find(&bytes, b"moov") - 8;
    assert!(said(&bytes[..movie]).contains("moov"));
    let mut sound = bytes.clone();
    let handler = find(&sound, b"hdlr") + 8;
    sound[handler..handler + 4].copy_from_slice(b"soun");
    assert!(said(&sound).contains("only soun"));
    let mut still = bytes;
    let clock = find(&still, b"mdhd") + 12;
    still[clock..clock + 4].fill(0);
    assert!(said(&still).contains("clock"));
}

#[test]
fn a_truncated_film_shows_the_pictures_it_still_has() {
    let bytes = film(10);
    let cut = &bytes[..bytes.len() - 20];
    let (film, findings) = read_mp4_index(&mut Cursor::new(cut)).expect("a film");
    assert!((1..10).contains(&film.frames.len()));
    assert_eq!(findings.len(), 2, "{findings:?}");
}

#[test]
fn counts_that_no_file_holds_take_no_memory() {
    for (kind, at) in [(b"stsz", 8), (b"stts", 4), (b"stss", 4), (b"stsc", 4), (b"stco", 4)] {
        let mut bytes = film(4);
        let place = find(&bytes, kind) + at;
        bytes[place..place + 4].fill(0xff);
        let read = read_mp4_index(&mut Cursor::new(&bytes));
        if let Ok((film, _)) = read {
            assert!(film.frames.len() <= 4, "{kind:?}");
        }
    }
    // One size for all frames, and the largest possible count.
    let mut bytes = film(4);
    let place = find(&bytes, b"stsz") + 4;
    bytes[place..place + 4].copy_from_slice(&1_u32.to_be_bytes());
    bytes[place + 4..place + 8].copy_from_slice(&5_000_000_u32.to_be_bytes());
    let film = opened(&bytes);
    assert!(film.frames.len() <= bytes.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn hostile_bytes_are_read_or_refused(
        flips in prop::collection::vec((0usize..1200, any::<u8>()), 1..20),
        cut in 0usize..1400,
        pieces in any::<bool>(),
    ) {
        let mut bytes = film(6);
        if pieces {
            let mut run = words(&[0xf05, 3, 40, 0]);
            run.extend(words(&[3600, 7, 0, 0, 3600, 7, 0, 0, 3600, 7, 0, 0]));
            let mut traf = boxed(b"tfhd", &words(&[0x2_0000, 1]));
            traf.extend(boxed(b"trun", &run));
            bytes.extend(boxed(b"moof", &boxed(b"traf", &traf)));
        }
        for (at, value) in flips {
            let at = at % bytes.len();
            bytes[at] = value;
        }
        bytes.truncate(bytes.len().max(cut));
        if let Ok((film, _)) = read_mp4_index(&mut Cursor::new(&bytes)) {
            prop_assert!(!film.shown_order().is_empty());
            for frame in &film.frames {
                prop_assert!(frame.offset + u64::from(frame.size) <= bytes.len() as u64);
            }
            let _ = (film.film_length_ticks(), film.ticks_to_micros(i64::MAX), film.sync_before(usize::MAX));
            if let Ok(said) = mp4_h264::read_avc_configuration(&film.configuration) {
                for set in &said.sets {
                    let _ = mp4_h264::read_sequence_parameters(set);
                }
            }
        }
    }
}

#[test]
fn golden_films_written_and_read() {
    use crate::golden::{compare, put};
    let mut out = String::new();
    let whole = film(9);
    crate::tests::bytes(&mut out, &whole);
    let container = opened(&whole);
    for frame in &container.frames {
        put(&mut out, format!("{frame:?}"));
    }
    put(
        &mut out,
        format!(
            "{:?}",
            Mp4Container {
                frames: Vec::new(),
                ..container
            }
        ),
    );
    let piece = sequence();
    put(&mut out, format!("{:?}", mp4_h264::read_sequence_parameters(&piece)));
    for profile in [66, 77, 100, 122] {
        for format in ["1", "010", "011"] {
            let odd = sequence_of(profile, format, &codes(&[0, 3]), "01");
            put(
                &mut out,
                format!("{profile} {format}: {:?}", mp4_h264::read_sequence_parameters(&odd)),
            );
        }
    }
    for cut in [0, 8, 40, whole.len() / 2, whole.len() - 1] {
        let read = read_mp4_index(&mut Cursor::new(&whole[..cut])).map(|it| it.0.frames.len());
        put(
            &mut out,
            format!("{cut} bytes: {:?}", read.map_err(|it| it.to_string())),
        );
    }
    compare("mp4", &out);
}
