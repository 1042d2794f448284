//! Generates small files like those that people have: movement, annotations, a lexicon.

use std::fmt::Write as _;

/// The joints of a small signer: name, parent, offset in centimetres.
const JOINTS: [(&str, Option<usize>, [f64; 3]); 20] = [
    ("Hips", None, [0.0, 0.0, 0.0]),
    ("Spine", Some(0), [0.0, 12.0, 0.0]),
    ("Spine1", Some(1), [0.0, 22.0, 0.0]),
    ("Neck", Some(2), [0.0, 16.0, 0.0]),
    ("Head", Some(3), [0.0, 9.5, 1.5]),
    ("RightShoulder", Some(2), [-3.0, 12.0, 0.0]),
    ("RightArm", Some(5), [-14.0, 0.0, 0.0]),
    ("RightForeArm", Some(6), [-28.0, 0.0, 0.0]),
    ("RightHand", Some(7), [-25.5, 0.0, 0.0]),
    ("RightHandIndex1", Some(8), [-9.5, 0.0, 2.5]),
    ("RightHandIndex2", Some(9), [-4.0, 0.0, 0.0]),
    ("LeftShoulder", Some(2), [3.0, 12.0, 0.0]),
    ("LeftArm", Some(11), [14.0, 0.0, 0.0]),
    ("LeftForeArm", Some(12), [28.0, 0.0, 0.0]),
    ("LeftHand", Some(13), [25.5, 0.0, 0.0]),
    ("LeftHandIndex1", Some(14), [9.5, 0.0, 2.5]),
    ("LeftHandIndex2", Some(15), [4.0, 0.0, 0.0]),
    ("RightUpLeg", Some(0), [-9.0, -2.0, 0.0]),
    ("RightLeg", Some(17), [0.0, -42.0, 0.0]),
    ("RightFoot", Some(18), [0.0, -41.0, 0.0]),
];

/// Returns a BVH file of `frames` frames at 100 a second; each `seed` gives another movement.
#[must_use]
pub fn bvh(frames: usize, seed: u32) -> String {
    let mut text = String::from("HIERARCHY\n");
    joint(&mut text, 0, 0);
    let _ = writeln!(text, "MOTION\nFrames: {frames}\nFrame Time: 0.010000");
    let size = 20.0 + f64::from(seed % 100_003) / 10_000.0;
    for frame in 0..frames {
        let _ = write!(text, "0.00 95.50 0.00");
        for joint in 0..JOINTS.len() {
            for axis in 0..3 {
                let phase = frame as f64 * 0.02 * f64::from(1 + axis) + joint as f64;
                let _ = write!(text, " {:.4}", size * phase.sin());
            }
        }
        text.push('\n');
    }
    text
}

fn joint(text: &mut String, at: usize, depth: usize) {
    let (name, parent, [x, y, z]) = JOINTS[at];
    let pad = "  ".repeat(depth);
    let (word, position) = match parent {
        None => ("ROOT", "6 Xposition Yposition Zposition "),
        Some(_) => ("JOINT", "3 "),
    };
    let _ = writeln!(text, "{pad}{word} {name}\n{pad}{{");
    let _ = writeln!(text, "{pad}  OFFSET {x:.2} {y:.2} {z:.2}");
    let _ = writeln!(text, "{pad}  CHANNELS {position}Zrotation Xrotation Yrotation");
    let children: Vec<usize> = (0..JOINTS.len()).filter(|&child| JOINTS[child].1 == Some(at)).collect();
    for &child in &children {
        joint(text, child, depth + 1);
    }
    if children.is_empty() {
        let _ = writeln!(text, "{pad}  End Site\n{pad}  {{");
        let _ = writeln!(text, "{pad}    OFFSET 0.00 2.00 0.00\n{pad}  }}");
    }
    let _ = writeln!(text, "{pad}}}");
}

/// A tier of an EAF file: its name, its parent, and its annotations as milliseconds and value.
pub type Tier<'a> = (&'a str, Option<&'a str>, &'a [(i64, i64, &'a str)]);

/// Returns an EAF file; tiers with a parent lie within its annotations (`Included_In`).
#[must_use]
pub fn eaf(participant: &str, tiers: &[Tier<'_>]) -> String {
    let mut slots = String::new();
    let mut body = String::new();
    let (mut slot, mut count) = (0, 0);
    for (name, parent, annotations) in tiers {
        let kind = if parent.is_some() { "within" } else { "free" };
        let parent = parent.map_or(String::new(), |it| format!(" PARENT_REF=\"{it}\""));
        let _ = writeln!(
            body,
            "<TIER TIER_ID=\"{name}\" LINGUISTIC_TYPE_REF=\"{kind}\" PARTICIPANT=\"{participant}\"{parent}>"
        );
        for (start, end, value) in *annotations {
            count += 1;
            for time in [start, end] {
                slot += 1;
                let _ = writeln!(slots, "<TIME_SLOT TIME_SLOT_ID=\"ts{slot}\" TIME_VALUE=\"{time}\"/>");
            }
            let _ = writeln!(
                body,
                "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{count}\" \
                 TIME_SLOT_REF1=\"ts{}\" TIME_SLOT_REF2=\"ts{slot}\">\
                 <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>",
                slot - 1
            );
        }
        body.push_str("</TIER>\n");
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2024-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\">\n\
         <HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>\n<TIME_ORDER>\n{slots}</TIME_ORDER>\n{body}\
         <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"free\" TIME_ALIGNABLE=\"true\"/>\n\
         <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"within\" CONSTRAINTS=\"Included_In\" TIME_ALIGNABLE=\"true\"/>\n\
         </ANNOTATION_DOCUMENT>\n"
    )
}

/// Returns an EAF file of two seconds with two signs, coded on both hands, and a translation.
#[must_use]
pub fn two_signs() -> String {
    let glosses = [(100, 700, "BOL"), (900, 1500, "CHAT")];
    let handshapes = [(100, 700, "5"), (900, 1500, "S")];
    eaf(
        "Anna",
        &[
            ("Gloss", None, &glosses),
            ("Handshape RH", Some("Gloss"), &handshapes),
            ("Handshape LH", Some("Gloss"), &[(100, 700, "5")]),
            ("Location", Some("Gloss"), &[(100, 700, "chest"), (900, 1500, "chin")]),
            ("Brows", None, &[(800, 1600, "raised")]),
            ("Translation", None, &[(0, 1800, "a bowl for the cat")]),
        ],
    )
}

/// Returns a lexicon table of four signs: two are a minimal pair, one moves from a place to another.
#[must_use]
pub fn lexicon() -> &'static str {
    "gloss\tEN gloss\tHandshape strong\tHandshape weak\tLocation\n\
     CHAT\tcat\tS\t\tchin\n\
     ESCARGOT\tsnail\tH\tB\tweak hand\n\
     LIMACE\tslug\tU\tB\tweak hand\n\
     JOUR\tday\tB\t\tneutral space > head\n"
}

/// Returns a SiGML file of two signs: MERCI, a flat hand that leaves the chin in an arc, and OUI.
#[must_use]
pub fn sigml() -> &'static str {
    r#"<sigml>
<hamgestural_sign gloss="MERCI">
  <sign_nonmanual><head_tier><head_movement movement="NO"/></head_tier></sign_nonmanual>
  <sign_manual>
    <handconfig handshape="flat"/>
    <handconfig extfidir="u"/>
    <handconfig palmor="u"/>
    <location_bodyarm location="chin" contact="touch"/>
    <directedmotion direction="o" curve="u" size="small"/>
  </sign_manual>
</hamgestural_sign>
<hns_sign gloss="OUI">
  <hamnosys_manual>
    <hamfist/><hamthumbacrossmod/><hamextfingero/><hampalmd/><hamnodding/><hamrepeatfromstart/>
  </hamnosys_manual>
</hns_sign>
</sigml>
"#
}
