//! Golden tables of lexicons, roles of tiers, notation, subtitles, and texts of times.

use chereme_sign::hamnosys::{NotatedSign, from_names, parse_lenient};

use super::{findings, transcript};
use crate::golden::{compare, put};
use crate::lexicon;
use crate::roles::{TierMapping, TierRoleEvidence, guess_roles};
use crate::{hns, sigml, subtitles, timecode};

const LEXICON: &str = chereme_data::starter_text("lexicon.csv");

const WIDE: &str = "Gloss;Handshape strong;Handshape weak;Location;Movement shape;Movement direction;Contact type;\
Handshape change;Absolute Orientation: palm;Repeated Movement;right.placement;Frequency;English;Hamnosys;Notes\n\
A;S + W;O >5;neutral space > head;circle parallel + straight;outwards > downwards > inwards;none + initial;\
closing > opening;backwards > forwards;yes;chin;12;cat;hamfist hamextfingeru hampalml;odd\n\
B;;-;cheek + chin;;variable;> final;>S;back/palm;no;;1,5;\"dog; hound\";;\n\
A;?;N/A;weak hand: back;;;;wiggle, closing;;;;x;;hamnothing;\n\
;B;;;;;;;;;;;;;\n";

fn lexicon_of(out: &mut String, text: &str, mapping: &TierMapping) {
    let (read, found) = match lexicon::read_lexicon(text.as_bytes(), mapping) {
        Ok(read) => read,
        Err(error) => {
            put(out, format!("refused: {error}"));
            return;
        }
    };
    put(out, format!("delimiter {}", read.delimiter));
    for column in &read.columns {
        put(out, format!("{column:?}"));
    }
    for entry in &read.entries {
        let mut head = entry.clone();
        head.codings.clear();
        put(out, format!("{head:?}"));
        for coding in &entry.codings {
            put(out, format!("  {} {coding:?}", coding.coding_field()));
        }
    }
    for inventory in read.component_inventories() {
        put(out, format!("{inventory:?}"));
    }
    findings(out, &found);
    let mut bytes = Vec::new();
    lexicon::write_lexicon(&read, &mut bytes).expect("a vector takes everything");
    put(out, String::from_utf8(bytes).expect("UTF-8"));
}

#[test]
fn golden_lexicons() {
    let mut out = String::new();
    let plain = TierMapping::default();
    let mapping = TierMapping::from_json(
        r#"{"columns": {"Frequency": "movement.count", "English": "translation", "Notes": "comment"}}"#,
    );
    let usual =
        "[{\"gloss\": \"CHAT\", \"handshape\": \"B\", \"n\": 3}, {\"gloss\": \"CHIEN\", \"location\": \"chin\"}]";
    let keyed = "{\"CHAT\": \"hamfist hamextfingeru hampalml\", \"CHIEN\": \"hamflathand hamextfingeru hampalmd\"}";
    let slots = "{\"signs\": [{\"signlevel information\": {\"gloss\": [\"A\"]}}]}";
    for (name, text) in [
        ("the starter corpus", LEXICON),
        ("wide", WIDE),
        ("JSON rows", usual),
        ("JSON by gloss", keyed),
        ("other JSON", slots),
        ("nothing", ""),
        ("one cell", "gloss"),
        ("no titles", "CHAT\tB\nCHIEN\tS\n"),
    ] {
        put(&mut out, format!("## {name}"));
        lexicon_of(&mut out, text, &plain);
    }
    put(&mut out, "## mapped");
    match &mapping {
        Ok(mapping) => lexicon_of(&mut out, WIDE, mapping),
        Err(error) => put(&mut out, format!("{error}")),
    }
    compare("lexicons", &out);
}

const TIERS: [&str; 96] = [
    "Gloss RH",
    "GlossL S1",
    "GlossR S2",
    "RH-IDgloss",
    "LH-IDgloss",
    "Lexem_Gebärde_r_A",
    "Lexem_Gebärde_l_B",
    "HandShape right",
    "Hand shape (left)",
    "RH_config",
    "LH_placement",
    "RH_movement",
    "LH_orientation",
    "Config MD",
    "Config MG",
    "Emplacement MD",
    "Mouvement main gauche",
    "Orientation de la paume",
    "Conf_D",
    "H1",
    "H2",
    "H2 handshape",
    "Hold",
    "Free Translation",
    "Translation_into_German_A",
    "Traduction",
    "sentence",
    "Mouthing",
    "Mundbild_A",
    "Mundbild_Mundgestik_A",
    "eyebrows",
    "sourcils",
    "regard",
    "Eye gaze",
    "Head movement",
    "Head placement",
    "Non-manual",
    "Comments RH handshape",
    "Commentaire",
    "Commentaire gloss",
    "Comment translation",
    "Translation of gloss",
    "Handshape gloss",
    "Location gloss RH",
    "Gloss mouthing",
    "Mouthing translation",
    "Mouth handshape",
    "Head orientation",
    "Head gloss",
    "Placement mouth",
    "Location on head",
    "Movement head RH",
    "Brows comment",
    "Handshape location",
    "Handshape movement orientation",
    "Palm orientation location",
    "Contact location",
    "Movement direction",
    "Movement direction location",
    "Bewegung rechte Hand",
    "both",
    "left",
    "right",
    "EBf",
    "Ci",
    "Hno",
    "Mmo",
    "Mctr",
    "non-dominant handshape",
    "P-Gloss",
    "Non-dominant POS",
    "Gloss RH part of speech",
    "Wortart",
    "Wortart gloss translation",
    "Non-dominant mood",
    "RH S1",
    "left A",
    "W-RGph",
    "default",
    "",
    "日本語",
    "Config MD/Dominante",
    "Config MND",
    "Conf_ND",
    "finger orientation left",
    "Gaze left",
    "brow_raise right",
    "Cheeks",
    "Tongue",
    "Shoulders",
    "Body lean",
    "Blink",
    "Aperture",
    "Handshape initial",
    "Final location RH",
    "Repetition",
];

#[test]
fn golden_roles_of_tiers() {
    let mut out = String::new();
    let tier = |name: &'static str, parent: Option<usize>| TierRoleEvidence {
        name,
        parent,
        kind: if name.len().is_multiple_of(5) { "gloss" } else { "" },
        one_to_one: parent.is_some(),
        ..TierRoleEvidence::default()
    };
    put(&mut out, "## each by itself");
    for name in TIERS {
        let guesses = guess_roles(&[tier(name, None)], &TierMapping::default());
        guesses.iter().for_each(|it| put(&mut out, format!("{it:?}")));
    }
    put(&mut out, "## all together, each second one below the first");
    let all: Vec<TierRoleEvidence<'_>> = TIERS
        .iter()
        .enumerate()
        .map(|(n, name)| tier(name, (n % 2 == 1).then(|| n - 1)))
        .collect();
    for guess in guess_roles(&all, &TierMapping::default()) {
        put(&mut out, format!("{guess:?} {:?}", guess.guessed_tier_topic()));
    }
    put(&mut out, "## mappings");
    for text in [
        r#"{"tiers": {"Gloss RH": "left.gloss", "H1": "nonmanual.brows", "Ci": "ignore"}}"#,
        r#"{"tiers": {"A": "final.weak.placement", "B": "translation:fr", "C": "attribute"}, "columns": {}}"#,
        r#"{"tiers": {"A": "glos"}}"#,
        r#"{"tier": {}}"#,
        r#"{"tiers": {"A": 3}}"#,
        "[1]",
        "{",
    ] {
        match TierMapping::from_json(text) {
            Ok(mapping) => {
                put(&mut out, format!("{text}: {mapping:?}"));
                for guess in guess_roles(&all[..20], &mapping) {
                    put(&mut out, format!("  {guess:?}"));
                }
            }
            Err(error) => put(&mut out, format!("{text}: {error}")),
        }
    }
    compare("roles", &out);
}

const SIGNS: [&str; 14] = [
    "hamflathand hamthumboutmod hamextfingerui hampalmd hamchest hamlrat hamtouch hammoveo hamsmallmod",
    "hamsymmlr hamfinger2 hamfingerhookmod hamextfingero hampalmdl hamneutralspace hammover hamrepeatfromstart",
    "hamparbegin hamflathand hamextfingero hampalml hamplus hamfist hamextfingero hampalmu hamparend hammoved",
    "hampinch12 hamextfingeru hampalmd hamlips hamtouch hamreplace hampinch12open hamextfingero hampalmd",
    "hamfinger23spread hamextfingeru hampalml hamfingerplay hamslow",
    "hamceeall hamextfingeruo hampalml hamcircleo hamclocku hamellipseh hamrepeatreverse hamfast",
    "hamfist hamextfingero hampalmd hamseqbegin hammover hamarcu hammoved hamhalt hamseqend",
    "hamsymmpar hamfinger2345 hamextfingero hampalmd hamalternatingmotion hammoveu hamtense",
    "hamfinger2 hamextfingerul hampalml hamindexfinger hamfingertip hamcheek hamlrbeside hamclose hamtwisting",
    "hamflathand hambetween hamfist hamextfingeru hampalmd hambetween hampalml hamchin hamtouch hamnodding",
    "hamfusionbegin hammoveu hammover hamfusionend",
    "hamflathand hamextfingeru hampalmd hamparbegin hammoveo hamplus hamreplace hamfist hamparend hamwavy",
    "hamfinger2 hamfinger23 hamextfingeru hampalmd hammoveo hamincreasing hamdecreasing",
    "hamflathand hamparend hamextfingeru",
];

fn signs() -> Vec<NotatedSign> {
    let sign = |(n, names): (usize, &&str)| {
        let text = from_names(names.split(' ')).expect(names);
        NotatedSign {
            gloss: format!("S{n}"),
            sign: parse_lenient(&text).sign,
            ..NotatedSign::default()
        }
    };
    SIGNS.iter().enumerate().map(sign).collect()
}

fn sigml_of(out: &mut String, bytes: &[u8]) {
    match sigml::read_sigml_signs(bytes) {
        Ok((signs, found)) => {
            signs.iter().for_each(|it| put(out, format!("{it:?}")));
            findings(out, &found);
        }
        Err(error) => put(out, format!("refused: {error}")),
    }
}

const SIGML: &str = r#"<?xml version="1.0"?><!DOCTYPE sigml SYSTEM "http://example.org/sigml.dtd">
<sigml><hamgestural_sign gloss="HERE &amp; NOW" speed="1.2" timescale="2" duration="0.5" sign_language="dse" gloss_language="nl">
<sign_nonmanual>
  <head_tier presynchronization="slight_delay"><head_movement movement="SH_shaking_left_and_right"/>
    <head_par><head_movement movement="NF"/><head_movement movement="TL" amount="0.5"/></head_par></head_tier>
  <mouthing_tier fitpicturetomanual="true"><mouth_picture picture="hi:r"/><mouth_gesture movement="L04"/></mouthing_tier>
  <facialexpr_tier><eye_brows movement="RB"/><eye_gaze direction="AD"/><eye_lids movement="WB"/><nose movement="WR"/></facialexpr_tier>
  <body_tier><body_movement movement="TF" speed="2"/></body_tier><shoulder_tier><shoulder_movement movement="UB"/></shoulder_tier>
  <extra_tier><x/></extra_tier>
</sign_nonmanual>
<sign_manual both_hands="true" lr_symm="true" outofphase="true">
  <handconfig handshape="finger2" second_handshape="fist" thumbpos="across" mainbend="bent" bend5="hooked" specialfingers="24" exemptedfingers="3"/>
  <split_handconfig><handconfig extfidir="o" second_extfidir="uor"/><handconfig extfidir="uuo"/></split_handconfig>
  <handconfig palmor="d" rel_palmor="false" second_palmor="dl"/>
  <location_bodyarm location="chest" second_location="stomach" side="right_at" contact="touch"><location_hand location="tip" digits="2"/></location_bodyarm>
  <par_motion><directedmotion direction="u" size="big" second_size="small" curve="r" curve_size="big"/><tgt_motion><changeposture/><handconfig handshape="flat"/></tgt_motion></par_motion>
  <seq_motion fused="true"><circularmotion axis="o" start="u" clockplus="true" ellipse_direction="h" ellipse_size="small" zigzag_style="wavy"/><wristmotion motion="twisting" size="big"/></seq_motion>
  <rpt_motion repetition="fromstart_several" second_repetition="reverse" incrdecr="incr" incrdecr_size="small" baseshift="l" baseshift_size="big"><directedmotion direction="d" size="small" manner="fast"/></rpt_motion>
  <split_motion><nomotion/><fingerplay digits="23"/></split_motion>
  <nondominant><directedmotion direction="r" approx_shape="true"/></nondominant>
</sign_manual></hamgestural_sign>
<hns_sign gloss="B"><hamnosys_nonmanual><hnm_head tag="NO"/><hnm_mouthpicture picture="a"/></hamnosys_nonmanual>
<hamnosys_manual><hamfist/><hamextfingeru/><hampalml/><hamunknown/></hamnosys_manual></hns_sign>
<hns_sign><hamnosys_manual><hamfist/></hamnosys_manual></hns_sign><other/></sigml>"#;

#[test]
fn golden_signs_in_sigml_and_lines_of_symbols() {
    let mut out = String::new();
    put(&mut out, "## every element");
    sigml_of(&mut out, SIGML.as_bytes());
    let signs = signs();
    for sign in &signs {
        put(&mut out, format!("## {}", sign.gloss));
        let gestural = sigml::write_gestural([sign]);
        put(&mut out, String::from_utf8_lossy(&gestural));
        sigml_of(&mut out, &gestural);
        let (symbols, lost) = sigml::write_symbols([sign]);
        put(&mut out, format!("{}lost {lost:?}", String::from_utf8_lossy(&symbols)));
        sigml_of(&mut out, &symbols);
        let (line, lost) = hns::write_hns([sign]);
        put(&mut out, format!("{}lost {lost:?}", String::from_utf8_lossy(&line)));
    }
    put(&mut out, "## refused");
    for text in ["", "<sigml>", "<a/>", "<sigml/>", "text"] {
        sigml_of(&mut out, text.as_bytes());
    }
    put(&mut out, "## lines");
    for text in [
        "A\tU+E001 U+E020 U+E03C\nB;HAMFLATHAND HAMEXTFINGERU HAMPALMD\nC \\hamfist\\hamextfingeru\\hampalmd\n",
        "a title\nA\thamfist hamextfingeru hampalml hamparend\nB\t\n\nD D\thamfist hamextfingero\n",
        "nothing\n",
    ] {
        match hns::read_hns(text.as_bytes()) {
            Ok((entries, found)) => {
                entries.iter().for_each(|it| put(&mut out, format!("{it:?}")));
                findings(&mut out, &found);
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare("notation", &out);
}

#[test]
fn golden_subtitles_and_timecodes() {
    let mut out = String::new();
    for text in [
        "1\n00:00:01,000 --> 00:00:02,500\nHallo\nWelt\n\n2\n00:00:03,000 --> 00:00:04,000\nja\n",
        "\u{feff}1\r\n00:00:01.000 --> 00:00:02.5\r\n<i>Hallo</i> {\\an8}\r\n\r\n",
        "00:01,000 --> 00:02,000\na\n00:02,000 --> 00:03,000\nb",
        "WEBVTT - films\n\nNOTE a\nb\n\nSTYLE\n::cue{}\n\nx1\n00:01.000 --> 00:02.000 align:start\n<v Anna>R&amp;D &lt;3\n\n\
         00:02.000 --> 01:00:03.000\n<v.loud Bo>x</v>\n",
        "WEBVTT\n\n00:00.000 --> 00:02.000\na\n\n00:01.000 --> 00:03.000\nb\n\n00:05.000 --> 00:04.000\nc\n",
        "1\n00:00:01,000 -> 00:00:02,500\nx\n",
        "",
    ] {
        put(&mut out, format!("## {text:?}"));
        match subtitles::read_subtitles(text.as_bytes()) {
            Ok((it, found)) => {
                transcript(&mut out, &it);
                findings(&mut out, &found);
                for form in [subtitles::SubtitleFormat::Srt, subtitles::SubtitleFormat::Vtt] {
                    put(&mut out, format!("{form:?}\n{}", subtitles::write_subtitles(&it, form)));
                }
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    put(&mut out, "## times of day");
    for text in [
        "10:11:12:13",
        "10:11:12;13",
        "23:59:59:23.500",
        "00:01:00;02",
        "00:10:00;00",
        "10:11:12",
        "01:00:00:12@30",
        "25:00:00:00",
        "1:2",
        "",
    ] {
        for rate in [23.976, 25.0, 29.97, 59.94, 120.0] {
            put(
                &mut out,
                format!("{text} at {rate}: {:?}", timecode::time_of_day(text, rate)),
            );
        }
    }
    put(&mut out, "## rates");
    for per_second in [
        0.0, -1.0, 0.5, 0.0001, 1.0, 12.5, 23.976, 23.98, 24.0, 29.97, 29.970_03, 30.0, 59.94, 99.999, 100.1, 119.88,
        240.0, 1e5, 2e6, 33.3333,
    ] {
        put(
            &mut out,
            format!("{per_second}: {:?}", crate::tracks::rate_of(per_second)),
        );
    }
    compare("texts_times", &out);
}
