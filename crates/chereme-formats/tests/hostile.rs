//! Every reader on damaged bytes: cut short, with wrong counts and sizes, with numbers and words that do not belong there,
//! with endless nesting. A reader returns a document or an error; it does not panic, hang or fill the memory.

use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};

use chereme_formats::bvh::raw::{BvhReader, MotionBlock};
use chereme_formats::roles::TierMapping;
use chereme_formats::{
    anvil, c3d, curves, eaf, exmaralda, gltf, hns, keypoints, lexicon, points as point_tables, pose, sigml, signstream,
    subtitles, table, textgrid, trc, xra,
};
use chereme_motion::{
    Clip, FrameNumberColumn, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, RecordingInstant, Skeleton,
    SkeletonJoint, SpaceConvention, glam::DVec3,
};

/// A format: a small file of it, and its reader, which returns whether it accepted the bytes.
struct Format {
    name: &'static str,
    sample: Vec<u8>,
    read: fn(&[u8]) -> bool,
    /// Whether the file is text, whose words are exchanged too.
    is_text: bool,
}

fn format(name: &'static str, sample: impl Into<Vec<u8>>, read: fn(&[u8]) -> bool) -> Format {
    let sample = sample.into();
    Format {
        is_text: std::str::from_utf8(&sample).is_ok(),
        name,
        sample,
        read,
    }
}

const BVH: &str = "HIERARCHY\nROOT Hips\n{\n OFFSET 0 90 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation \
Yrotation\n JOINT Head\n {\n  OFFSET 0 60 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  End Site\n  {\n   OFFSET 0 20 0\n  }\n }\n}\n\
MOTION\nFrames: 3\nFrame Time: 0.04\n0 90 0 1 2 3 4 5 6\n0 90 0 1 2 3 4 5 6\n0 91 0.5 1 2 3 4 5 1e1\n";

const EAF: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2024-01-01T00:00:00Z" FORMAT="3.0" VERSION="3.0">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"><PROPERTY NAME="lastUsedAnnotationId">2</PROPERTY></HEADER>
    <TIME_ORDER><TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="0"/><TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="500"/></TIME_ORDER>
    <TIER LINGUISTIC_TYPE_REF="gloss" TIER_ID="Gloss RH">
        <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2">
            <ANNOTATION_VALUE>CHIEN &amp; CHAT</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
    </TIER>
    <TIER LINGUISTIC_TYPE_REF="part" PARENT_REF="Gloss RH" TIER_ID="Place">
        <ANNOTATION><REF_ANNOTATION ANNOTATION_ID="a2" ANNOTATION_REF="a1"><ANNOTATION_VALUE>chin</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
    </TIER>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
    <LINGUISTIC_TYPE CONSTRAINTS="Symbolic_Association" LINGUISTIC_TYPE_ID="part" TIME_ALIGNABLE="false"/>
</ANNOTATION_DOCUMENT>
"#;

const ECV: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<CV_RESOURCE AUTHOR="" DATE="2021-05-11T16:48:01+08:00" VERSION="0.2"><CONTROLLED_VOCABULARY CV_ID="Handshape">
<CV_ENTRY_ML CVE_ID="c1"><CVE_VALUE DESCRIPTION="" LANG_REF="und">B</CVE_VALUE></CV_ENTRY_ML></CONTROLLED_VOCABULARY></CV_RESOURCE>
"#;

const PFSX: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<preferences version="1.1"><prefGroup key="TierColors"><pref key="Gloss"><Object class="java.awt.Color">0,160,255</Object></pref></prefGroup>
<prefList key="MultiTierViewer.TierOrder"><String>B</String><String>A</String></prefList></preferences>
"#;

const ANVIL: &str = r#"<annotation><head><specification src="s.xml"/><video src="a.mov"/><info key="coder">Z</info></head><body>
<track name="a.b" type="primary"><el index="0" start="0.5" end="1"><attribute name="x">1</attribute><attribute name="y">2</attribute></el>
<el index="1" start="1" end="2"><attribute name="x">1</attribute><comment>c</comment></el></track>
<track name="s" type="singleton" ref="a.b"><el index="0" ref="1"><attribute name="v"><value-link ref-track="a.b" ref-index="0"/></attribute></el></track>
<track name="r" type="span" ref="a.b"><el index="0" start="0" end="1"/></track><track name="p" type="primarypoint"><el index="0" time="3"/></track>
<track name="d" type="subdivision" ref="a.b"><el-group ref="0"><el index="0"/><el index="1" start="0.7"/></el-group></track>
<set name="z"><el/></set></body></annotation>"#;
const EXB: &str = r#"<basic-transcription><head><meta-information><referenced-file url="a.wav"/></meta-information><speakertable><speaker id="S">
<abbreviation>A</abbreviation></speaker></speakertable></head><basic-body><common-timeline><tli id="T0" time="0"/><tli id="T1"/><tli id="T2" time="2"/>
</common-timeline><tier id="t" speaker="S" category="v" type="t"><event start="T0" end="T1">x</event><event start="T1" end="T2">y &amp; z</event></tier>
</basic-body></basic-transcription>"#;
const XRA: &str = "<Document author=\"a\" format=\"1.5\"><Metadata><Entry key=\"k\">v</Entry></Metadata>\
    <Tier id=\"t\" tiername=\"Phones\"><Annotation id=\"a\"><Location><Interval score=\"0.5\"><Begin midpoint=\"0.1\"/>\
    <End midpoint=\"0.2\"/></Interval><Point midpoint=\"0.1\"/></Location><Label><Tag score=\"1\">O/</Tag><Tag>o</Tag></Label>\
    </Annotation></Tier><Tier id=\"u\"/><Hierarchy><Link type=\"TimeAlignment\" from=\"t\" to=\"u\"/></Hierarchy>\
    <Vocabulary id=\"v\"><Entry>O/</Entry><Tier id=\"t\"/></Vocabulary></Document>";

const SIGNSTREAM: &str = r#"<SIGNSTREAM-DATABASE><PARTICIPANTS><PARTICIPANT ID="0" NAME="B"/></PARTICIPANTS><CODING-SCHEME><FIELD ID="1" NAME="gloss">
<VALUE ID="2" NAME="v"/></FIELD></CODING-SCHEME><MEDIA-FILES><MEDIA-FILE ID="1" LEGACY-PATH="a.mov"/></MEDIA-FILES><UTTERANCES><UTTERANCE ID="3"
S="666" E="3333"><MEDIA-REF ID="1"/><SEGMENT PARTICIPANT-ID="0"><TRACK FID="1"><A S="0" E="9" VID="2"/><A S="10" E="20">X</A></TRACK></SEGMENT>
</UTTERANCE></UTTERANCES></SIGNSTREAM-DATABASE>"#;

const TEXT_GRID: &str = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 2\ntiers? <exists>\nsize = 2\nitem \
[]:\n item [1]:\n class = \"IntervalTier\"\n name = \"gloss\"\n xmin = 0\n xmax = 2\n intervals: size = 2\n intervals [1]:\n xmin = 0\n \
xmax = 1\n text = \"A \"\"b\"\"\"\n intervals [2]:\n xmin = 1\n xmax = 2\n text = \"\"\n item [2]:\n class = \"TextTier\"\n name = \
\"events\"\n xmin = 0\n xmax = 2\n points: size = 1\n points [1]:\n number = 0.5\n mark = \"clap\"\n";

const SRT: &str =
    "1\n00:00:01,000 --> 00:00:02,500\nthe <i>dog</i>\nsleeps\n\n2\n00:00:03,000 --> 00:00:04,000\nthe cat\n";
const VTT: &str = "WEBVTT\n\nNOTE a note\n\nid\n00:01.000 --> 00:02.500 align:start\n<v Anna>the dog &amp; the cat\n";
const TRC: &str = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\
\tOrigNumFrames\n100\t100\t3\t2\tmm\t100\t1\t3\nFrame#\tTime\tLSHO\t\t\tRSHO\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n1\t0\t1\t2\t3\t-1\t2\t3\n\
2\t0.01\t1\t2\t3\t-1\t2\t3\n3\t0.02\t1\t2\t3\t\t\t\n";
const MOTIVE: &str = "Format Version,1.23,Take Name,a,Export Frame Rate,100,Length Units,Meters\n\n,Type,Marker,Marker,Marker\n,Name,w,w,w\n,ID,1,1,1\n\
,,Position,Position,Position\nFrame,Time (Seconds),X,Y,Z\n0,0,1,2,3\n1,0.01,1,2,3\n";
const NEXUS: &str = "Trajectories\n100\n,,A:w,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n1,0,1,2,3\n2,0,1,2,3\n";
const QUALISYS: &str = "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nMARKER_NAMES\tw\n1\t2\t3\n4\t5\t6\n";
const DEEP_LAB_CUT: &str = "scorer,a,a,a\nbodyparts,w,w,w\ncoords,x,y,likelihood\n0,1,2,0.9\n1,1,2,0.9\n";
const LIVE_LINK: &str = "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,HeadYaw\n11:00:00:00.0,3,0.1,0.2,0.3\n11:00:00:01.0,3,0.1,0.25,0.3\n\
11:00:00:02.0,3,0.1,0.3,0.3\n";
const OPEN_FACE: &str = "frame, face_id, timestamp, confidence, success, AU01_r, AU45_c\n1, 0, 0.000, 0.98, 1, 0.5, 0\n2, 0, 0.033, 0.98, 1, \
0.6, 1\n";
const SCORES: &str = "{\"frames\":[{\"timestampMs\":0,\"faceBlendshapes\":[{\"categories\":[{\"categoryName\":\"jawOpen\",\"score\":0.5}]}]},\
{\"timestampMs\":40,\"faceBlendshapes\":[{\"categories\":[{\"categoryName\":\"jawOpen\",\"score\":0.25}]}]}]}";
const FAP: &str = "2.1 anna 25 2\n0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 \
0 0 0 0 0 0 0 0 0 0 0 0 0\n0 100\n0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 \
0 0 0 0 0 0 0 0 0\n1 120\n";
const PEOPLE: &str = "{\"version\":1.3,\"people\":[{\"person_id\":[-1],\"pose_keypoints_2d\":[10.5,20,0.9,0,0,0],\
\"hand_left_keypoints_2d\":[1,2,0.5]}]}";
const FILM: &str = "[{\"camera\":\"a\",\"width\":640,\"height\":360,\"frames\":{\"0\":{\"people\":[{\"pose_keypoints_2d\":[1,2,0.5]}]},\
\"3\":{\"people\":[]}}}]";
const MARKS: &str = "[{\"timestampMs\":0,\"poseLandmarks\":[{\"x\":0.5,\"y\":0.5,\"z\":0,\"visibility\":1}],\
\"poseWorldLandmarks\":[{\"x\":0.1,\"y\":0.2,\"z\":0}]},{\"timestampMs\":40}]";
const SIGML: &str = "<sigml><hns_sign gloss=\"HUND\"><hamnosys_manual><hamflathand/><hamextfingeru/><hampalml/><hamchin/></hamnosys_manual>\
</hns_sign><hamgestural_sign gloss=\"KAT\"><sign_manual><handconfig handshape=\"flat\" extfidir=\"u\" palmor=\"l\"/>\
<location_bodyarm location=\"chin\"/><directedmotion direction=\"r\"/></sign_manual></hamgestural_sign></sigml>";
const HNS: &str = "HUND\thamflathand hamextfingeru hampalml hamchin\nKAT\t\\hamfist \\hamextfingeru\n";
const TABLE: &str = "gloss;Handshape strong;Location;frequency\nCAT;B;forehead > chin;12\nDOG;5;neutral space;3\n";
const SIGNS: &str =
    "[{\"gloss\":\"CAT\",\"handshape\":\"B\",\"location\":\"chin\"},{\"gloss\":\"DOG\",\"hamnosys\":\"hamfist\"}]";
const EXPORT: &str = "{\"name\":\"c\",\"signs\":[{\"signlevel\":{\"entryid\":7,\"gloss\":[\"DOG\"]},\"cfg modules\":{\"a\":\
{\"_handconfiguration\":[{\"field_number\":4,\"slots\":[{\"slot_number\":17,\"symbol\":\"E\"}]}],\"_articulators\":[\"Hand\",{\"1\":true}]}},\
\"loc modules\":{\"x\":{\"locationtree\":{\"checkstates\":{\"Body>Chin\":2}}}}}]}";
const ROWS: &str = "tier,start_ms,end_ms,value\nGloss,0,500,CAT\nGloss,600,900,DOG\n";

fn binary_text_grid() -> Vec<u8> {
    let mut bytes = b"ooBinaryFile\x08TextGrid".to_vec();
    let float = |bytes: &mut Vec<u8>, value: f64| bytes.extend(value.to_be_bytes());
    float(&mut bytes, 0.0);
    float(&mut bytes, 2.0);
    bytes.push(1);
    bytes.extend(1_i32.to_be_bytes());
    bytes.push(12);
    bytes.extend(b"IntervalTier");
    bytes.extend(5_i16.to_be_bytes());
    bytes.extend(b"gloss");
    float(&mut bytes, 0.0);
    float(&mut bytes, 2.0);
    bytes.extend(1_i32.to_be_bytes());
    float(&mut bytes, 0.0);
    float(&mut bytes, 2.0);
    bytes.extend(1_i16.to_be_bytes());
    bytes.extend(b"A");
    bytes
}

fn body() -> Clip {
    let skeleton = Skeleton::new(vec![
        SkeletonJoint::new("hips", None, DVec3::Y),
        SkeletonJoint::new("chest", Some(0), DVec3::Y * 0.3),
        SkeletonJoint::new("head", Some(1), DVec3::Y * 0.3),
    ])
    .expect("a skeleton");
    Clip::from_rest_pose(skeleton.into(), FrameRate::new(25, 1).expect("a rate"), 3)
}

fn markers() -> MarkerTrack {
    let column = |phase: f32| FrameNumberColumn::from_single_floats((0..4).map(|at| at as f32 + phase).collect());
    let point = |name| MotionMarker::new(name, vec![column(1.0), column(2.0), column(3.0)]);
    let rate = FrameRate::new(100, 1).expect("a rate");
    let space = MarkerSpace::World(SpaceConvention::MODEL_CONVENTION);
    MarkerTrack::new(FrameTimes::Even(rate), space, vec![point("LSHO"), point("RSHO")]).expect("markers")
}

fn points() -> Vec<u8> {
    let mut bytes = 0.2f32.to_le_bytes().to_vec();
    let short = |bytes: &mut Vec<u8>, value: u16| bytes.extend(value.to_le_bytes());
    for value in [100, 50, 0, 1, 4] {
        short(&mut bytes, value);
    }
    bytes.extend(b"HAND");
    short(&mut bytes, 4);
    bytes.extend(b"XYZC");
    for value in [1, 0, 0, 5] {
        short(&mut bytes, value);
    }
    bytes.extend(b"WRIST");
    bytes.extend(25f32.to_le_bytes());
    bytes.extend(2u32.to_le_bytes());
    short(&mut bytes, 1);
    bytes.extend((0..8).flat_map(|at: u8| f32::from(at).to_le_bytes()));
    bytes
}

/// Points of version 0.0, whose frames without people take two bytes.
fn old_points() -> Vec<u8> {
    let mut bytes = points();
    bytes.splice(0..4, 0f32.to_le_bytes());
    let body = bytes.len() - 42;
    bytes.truncate(body);
    for value in [25_u16, 3, 0, 0, 0] {
        bytes.extend(value.to_le_bytes());
    }
    bytes
}

fn read_bvh(bytes: &[u8]) -> bool {
    let Ok(mut reader) = BvhReader::open_bvh(bytes) else {
        return false;
    };
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block).is_ok_and(|more| more) {}
    true
}

fn formats() -> Vec<Format> {
    let about = gltf::GlbDescription::default();
    let keys = |bytes: &[u8]| {
        let mut reader = keypoints::KeypointReader::default();
        let pushed = reader.push_keypoint_document(None, bytes);
        pushed.and_then(|()| reader.finish_keypoint_tracks(None)).is_ok()
    };
    let gltf_of = |bytes: &[u8]| gltf::read_gltf(bytes, &|_| None).is_ok();
    let signs = |bytes: &[u8]| lexicon::read_lexicon(bytes, &TierMapping::default()).is_ok();
    let mut all = vec![
        format("bvh", BVH, read_bvh),
        format("eaf", EAF, |bytes| eaf::read_eaf(bytes).is_ok()),
        format("ecv", ECV, |bytes| eaf::read_vocabularies(bytes).is_ok()),
        format("pfsx", PFSX, |bytes| {
            eaf::eaf_settings::read_display_settings(bytes).is_ok()
        }),
        format("anvil", ANVIL, |bytes| anvil::read_anvil(bytes).is_ok()),
        format("exmaralda", EXB, |bytes| exmaralda::read_exmaralda(bytes).is_ok()),
        format("xra", XRA, |bytes| xra::read_xra(bytes).is_ok()),
        format("signstream", SIGNSTREAM, |bytes| {
            signstream::read_signstream_file(bytes).is_ok()
        }),
        format("textgrid", TEXT_GRID, |bytes| {
            textgrid::read_textgrid_file(bytes).is_ok()
        }),
        format("textgrid, binary", binary_text_grid(), |bytes| {
            textgrid::read_textgrid_file(bytes).is_ok()
        }),
        format("srt", SRT, |bytes| subtitles::read_subtitles(bytes).is_ok()),
        format("vtt", VTT, |bytes| subtitles::read_subtitles(bytes).is_ok()),
        format("glb", gltf::write_glb(&body(), &about).expect("a body"), gltf_of),
        format(
            "c3d",
            c3d::write_c3d(&markers(), RecordingInstant::RECORDING_START).expect("markers"),
            |bytes| c3d::read_c3d(bytes).is_ok(),
        ),
        format("trc", TRC, |bytes| trc::read_trc_file(bytes).is_ok()),
        format("pose", points(), |bytes| pose::read_pose_file(bytes).is_ok()),
        format("pose 0.0", old_points(), |bytes| pose::read_pose_file(bytes).is_ok()),
        format("openpose", PEOPLE, keys),
        format("openpose, a film", FILM, keys),
        format("landmarks", MARKS, keys),
        format("sigml", SIGML, |bytes| sigml::read_sigml_signs(bytes).is_ok()),
        format("hamnosys", HNS, |bytes| hns::read_hns(bytes).is_ok()),
        format("lexicon", TABLE, signs),
        format("lexicon as json", SIGNS, signs),
        format("slp-aa", EXPORT, signs),
        format("annotations", ROWS, |bytes| {
            table::annotations::read_change_table(bytes, None).is_ok()
        }),
    ];
    for (name, text) in [
        ("live link", LIVE_LINK),
        ("openface", OPEN_FACE),
        ("scores", SCORES),
        ("fap", FAP),
        ("curves", "time [s],a,b\n0,1,2\n0.1,2,3\n"),
    ] {
        all.push(format(name, text, |bytes| curves::read_curves(bytes).is_ok()));
    }
    for (name, text) in [
        (
            "points",
            "time,palm_x,palm_y,palm_z,e_x,e_y,e_z\n0,1,2,3,4,5,6\n0.01,1,2,3,,,\n",
        ),
        ("motive", MOTIVE),
        ("nexus", NEXUS),
        ("qualisys", QUALISYS),
        ("deeplabcut", DEEP_LAB_CUT),
    ] {
        all.push(format(name, text, |bytes| {
            point_tables::read_point_table(bytes, None).is_ok()
        }));
    }
    #[cfg(feature = "fbx")]
    all.push(format("fbx", include_str!("../src/fbx/plain.fbx"), |bytes| {
        chereme_formats::fbx::read_fbx(bytes).is_ok()
    }));
    all
}

/// Numbers that come out the same every time.
struct Chance(u64);

impl Chance {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % limit.max(1)
    }
}

/// Words that replace numbers and names.
const WORDS: [&str; 14] = [
    "",
    "-1",
    "0",
    "4294967295",
    "18446744073709551616",
    "1e308",
    "1e999",
    "-0",
    "NaN",
    "inf",
    "\"",
    "{",
    "\u{fffd}",
    "99999999",
];

/// Returns damaged forms of a file.
fn damaged(format: &Format, chance: &mut Chance) -> Vec<Vec<u8>> {
    let whole = &format.sample;
    let mut all = vec![Vec::new()];
    // Cut at every block of a few bytes.
    let step = (whole.len() / 64).max(1);
    all.extend((0..whole.len()).step_by(step).map(|end| whole[..end].to_vec()));
    // Bytes and words of two, four and eight bytes turned to their extremes.
    for _ in 0..96 {
        let mut bytes = whole.clone();
        for _ in 0..=chance.below(3) {
            let at = chance.below(bytes.len());
            let width = [1, 2, 4, 8][chance.below(4)].min(bytes.len() - at);
            let fill = [0x00, 0xff, 0x7f, 0x80, chance.below(256) as u8][chance.below(5)];
            bytes[at..at + width].fill(fill);
        }
        all.push(bytes);
    }
    // Parts left out, doubled, exchanged.
    for _ in 0..24 {
        let (a, b) = (chance.below(whole.len()), chance.below(whole.len()));
        let (a, b) = (a.min(b), a.max(b));
        let mut bytes = whole[..a].to_vec();
        match chance.below(3) {
            0 => {}
            1 => bytes.extend([&whole[a..b], &whole[a..b]].concat()),
            _ => bytes.extend(whole[a..b].iter().rev()),
        }
        bytes.extend(&whole[b..]);
        all.push(bytes);
    }
    if format.is_text {
        let text = String::from_utf8_lossy(whole);
        let cuts: Vec<(usize, usize)> = words(&text);
        for _ in 0..96 {
            let (from, to) = cuts[chance.below(cuts.len())];
            let word = WORDS[chance.below(WORDS.len())];
            all.push(format!("{}{word}{}", &text[..from], &text[to..]).into_bytes());
        }
        for _ in 0..4 {
            let (from, _) = cuts[chance.below(cuts.len())];
            let many = "(<{[\"".chars().nth(chance.below(5)).unwrap_or('{');
            let deep: String = std::iter::repeat_n(many, 30_000).collect();
            all.push(format!("{}{deep}{}", &text[..from], &text[from..]).into_bytes());
        }
    }
    all
}

/// Returns the positions of a text's words, runs of letters and digits.
fn words(text: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut from = None;
    for (at, letter) in text.char_indices() {
        let inside = letter.is_alphanumeric() || ".-+".contains(letter);
        match (inside, from) {
            (true, None) => from = Some(at),
            (false, Some(start)) => {
                found.push((start, at));
                from = None;
            }
            _ => {}
        }
    }
    found
}

/// Returns the most memory that this process ever used, in MiB, if the system reports it.
fn most_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}

/// The most memory, in MiB, that files of a few kilobytes may take.
const MOST: u64 = 1536;

#[test]
fn every_reader_takes_its_own_sample() {
    for format in formats() {
        assert!((format.read)(&format.sample), "{}", format.name);
    }
}

#[test]
fn no_reader_panics_on_damaged_bytes_or_fills_the_memory() {
    let mut chance = Chance(20);
    let mut faults = String::new();
    for format in formats() {
        for (number, bytes) in damaged(&format, &mut chance).into_iter().enumerate() {
            let done = catch_unwind(AssertUnwindSafe(|| (format.read)(&bytes)));
            if done.is_err() {
                let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(300)]).into_owned();
                let _ = writeln!(faults, "{} panics on form {number}: {shown:?}", format.name);
            }
        }
        if let Some(most) = most_memory().filter(|most| *most > MOST) {
            panic!("{} or one before it took {most} MiB", format.name);
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn every_reader_takes_or_refuses_the_samples_of_all_others() {
    for format in formats() {
        for other in formats() {
            (format.read)(&other.sample);
        }
    }
}

/// Tests counts and sizes that would need more memory than the machine has, in files that are otherwise valid.
#[test]
fn promises_of_endless_data_are_refused_or_cut() {
    let mut old = old_points();
    let end = old.len();
    // 65,535 frames without people, and a component of 65,535 points.
    old[end - 8..end - 6].copy_from_slice(&u16::MAX.to_le_bytes());
    pose::read_pose_file(&old).ok();
    let glb = |accessor: &str, more: &str| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"name\":\"a\"}}],\"scenes\":[{{\"nodes\":[0]}}],\
             \"accessors\":[{accessor}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":16,\"byteStride\":0}}],\
             \"buffers\":[{{\"byteLength\":16,\"uri\":\"data:application/octet-stream;base64,AAAAAAAAgD8AAABAAABAQA==\"}}],\
             \"animations\":[{{\"channels\":[{{\"sampler\":0,\"target\":{{\"node\":0,\"path\":\"translation\"}}}}],\
             \"samplers\":[{{\"input\":0,\"output\":1}}]}}]{more}}}"
        )
    };
    for accessor in [
        "{\"componentType\":5126,\"count\":4000000000,\"type\":\"SCALAR\"},{\"componentType\":5126,\"count\":4000000000,\"type\":\"VEC3\"}",
        "{\"bufferView\":0,\"componentType\":5126,\"count\":200000000,\"type\":\"SCALAR\"},{\"bufferView\":0,\"componentType\":5126,\"count\":200000000,\"type\":\"VEC3\"}",
        "{\"bufferView\":0,\"byteOffset\":18446744073709551615,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}",
    ] {
        let text = glb(accessor, "");
        assert!(gltf::read_gltf(text.as_bytes(), &|_| None).is_err(), "{accessor}");
    }
    let far = "{\"people\":[{\"pose_keypoints_2d\":[1,2,0.5]}]}";
    let film = format!("{{\"frames\":{{\"0\":{far},\"5183999\":{far},\"18446744073709551615\":{far}}}}}");
    let mut reader = keypoints::KeypointReader::default();
    assert!(reader.push_keypoint_document(None, film.as_bytes()).is_err());
    let frames: Vec<String> = (0..2000)
        .map(|at| format!("[{{\"categoryName\":\"n{at}\",\"score\":0}}]"))
        .collect();
    let scores = format!("{{\"frames\":[{}]}}", frames.join(","));
    assert!(curves::read_curves(scores.as_bytes()).is_err());
    if let Some(most) = most_memory() {
        assert!(most < MOST, "{most} MiB");
    }
}
