//! SiGML files: values read, findings, refusals, and round trips.

use chereme_formats::sigml::{self, SigmlError};
use chereme_sign::hamnosys::{
    FingerBend, HandPlace, HandsUsed, ManualPart, MotionKind, NonmanualAct, NonmanualPart, NotatedSign, PlaceContact,
    ThumbPosition, TierKind, TierStart,
};

fn document(manual: &str) -> String {
    format!(
        "<sigml>\n<hamgestural_sign gloss=\"X\">\n<sign_manual>\n{manual}\n</sign_manual>\n</hamgestural_sign>\n</sigml>\n"
    )
}

/// Reads the one part of a sign; returns it with the findings as `line: message`.
fn part(manual: &str) -> (ManualPart, Vec<String>) {
    let (mut signs, findings) = sigml::read_sigml_signs(document(manual).as_bytes()).expect("it is SiGML");
    let line = |line: Option<u64>| line.map_or_else(String::new, |line| line.to_string());
    let reported = findings
        .iter()
        .map(|finding| format!("{}: {}", line(finding.line), finding.message));
    (signs.remove(0).sign.sign.parts.remove(0), reported.collect())
}

#[test]
fn a_sign_is_read_with_every_attribute() {
    let text = br#"<?xml version="1.0"?><!DOCTYPE sigml SYSTEM "http://example.org/sigml.dtd">
<sigml><hamgestural_sign gloss="HERE &amp; NOW" speed="1.2" timescale="2" duration="0.5" sign_language="dse" gloss_language="nl">
<sign_nonmanual>
  <head_tier presynchronization="slight_delay"><head_movement movement="SH_shaking_left_and_right"/>
    <head_par><head_movement movement="NF"/><head_movement movement="TL" amount="0.5"/></head_par></head_tier>
  <mouthing_tier fitpicturetomanual="true"><mouth_picture picture="hi:r"/><mouth_gesture movement="L04"/></mouthing_tier>
</sign_nonmanual>
<sign_manual both_hands="true" lr_symm="true" outofphase="true">
  <handconfig handshape="finger2" thumbpos="across" mainbend="bent" bend5="hooked"/>
  <split_handconfig><handconfig extfidir="o" second_extfidir="uor"/><handconfig/></split_handconfig>
  <handconfig palmor="d" rel_palmor="false"/>
  <location_bodyarm location="chest" side="right_at" contact="touch"><location_hand location="tip" digits="2"/></location_bodyarm>
  <rpt_motion repetition="fromstart"><directedmotion direction="d" size="small" manner="fast"/></rpt_motion>
</sign_manual></hamgestural_sign></sigml>"#;
    let (signs, findings) = sigml::read_sigml_signs(text).expect("it is SiGML");
    let sign = &signs[0].sign;
    assert_eq!(sign.gloss, "HERE & NOW");
    assert_eq!(
        (sign.speed, sign.timescale, sign.duration),
        (Some(1.2), Some(2.0), Some(0.5))
    );
    assert_eq!(sign.sign_language.as_deref(), Some("dse"));
    let reported: Vec<_> = findings.iter().map(|f| (f.line, &f.message[..])).collect();
    assert_eq!(
        reported,
        [
            (Some(1), "a document type is named; it is not fetched, and not kept"),
            (
                Some(5),
                "<head_movement> has an amount or speed, which is not in SiGML 1.2; it was kept as a factor"
            ),
        ]
    );
    let head = &sign.nonmanual.tiers[&TierKind::Head];
    assert_eq!(head.start, Some(TierStart::SlightDelay));
    assert_eq!(head.groups[0], [NonmanualAct::new(NonmanualPart::Head, "SH")]);
    assert_eq!(head.groups[1].len(), 2);
    assert!(sign.nonmanual.tiers[&TierKind::Mouthing].fit_picture);
    let part = &sign.sign.parts[0];
    assert!(matches!(part.hands, HandsUsed::Both(s) if s.left_right && s.out_of_phase && !s.up_down));
    let shape = part.posture.shape.dominant_value().expect("there is one");
    assert_eq!(shape.form.thumb, Some(ThumbPosition::Across));
    assert_eq!(shape.bends[4], Some(FingerBend::Hooked));
    let aim = part.posture.extended.dominant_value().expect("there is one");
    assert_eq!(aim.second.map(|d| d.to_string()).as_deref(), Some("uor"));
    assert_eq!(part.posture.extended.other_value(), None);
    let MotionKind::Repeated { motion, .. } = &part.actions[0].kind else {
        panic!("{:?}", part.actions)
    };
    assert!(motion.manner.fast);
}

#[test]
fn deviations_are_read_and_reported_with_their_line() {
    for (manual, reported) in [
        (
            r#"<handconfig extfidir="uuo"/>"#,
            r#"4: extfidir="uuo" was read as "uo""#,
        ),
        (r#"<handconfig extfidir="lu"/>"#, r#"4: extfidir="lu" was read as "ul""#),
        (r#"<handconfig extfidir="UL"/>"#, r#"4: extfidir="UL" was read as "ul""#),
        (
            r#"<handconfig handshape="FINGER2"/>"#,
            r#"4: <handconfig handshape="FINGER2"> was read as "finger2""#,
        ),
        (
            r#"<handconfig handshape="hamflathand"/>"#,
            r#"4: <handconfig handshape="hamflathand"> was read as "flat""#,
        ),
        (
            r#"<handconfig handshape="fist" thumbpos="hamthumbmod"/>"#,
            r#"4: <handconfig thumbpos="hamthumbmod">: the value means nothing; it was left out"#,
        ),
        (
            r#"<handconfig extfidir="oi"/>"#,
            r#"4: <handconfig extfidir="oi">: the value means nothing; it was left out"#,
        ),
        (
            r#"<handconfig palmor="il"/>"#,
            r#"4: palmor="il" is not one of the eight directions; it was read as "l""#,
        ),
        (
            r#"<handconfig palmor="o"/>"#,
            r#"4: <handconfig palmor="o">: the value means nothing; it was left out"#,
        ),
        (
            r#"<handconfig extfidir="u"/><handconfig palmor="o"/>"#,
            r#"4: palmor="o" is none of the eight directions; on a hand that points so it was read as "d""#,
        ),
        (
            r#"<handconfig extfidir="l" palmor="i"/>"#,
            r#"4: palmor="i" is none of the eight directions; on a hand that points so it was read as "l""#,
        ),
        (
            r#"<handconfig handshape="flat" successivefingers="towards_pinky"/>"#,
            r#"4: successivefingers="towards_pinky": the fingers change all at once"#,
        ),
        (
            r#"<handconfig palmor="d" abs_palmor="true"/>"#,
            "4: <handconfig> says what its palmor is relative to, which few programs read",
        ),
        (
            r#"<handconfig handshape="flat" mainbend="410"/>"#,
            r#"4: <handconfig mainbend="410">: the bend is given joint by joint"#,
        ),
        (
            r#"<handconfig handshape="flat" mainbend="0.50.50.5"/>"#,
            r#"4: mainbend="0.50.50.5" was read as the bends 0.5 0.5 0.5 of three joints, 4 being as far as goes"#,
        ),
        (
            r#"<handconfig handshape="flat" bend2="stiff"/>"#,
            r#"4: <handconfig bend2="stiff">: the value means nothing; it was left out"#,
        ),
        (
            r#"<handconfig handshape="paw"/>"#,
            r#"4: <handconfig handshape="paw">: the value means nothing; it was left out"#,
        ),
        (
            r#"<handconfig handshape="flat" exempteddigits="227"/>"#,
            r#"4: <handconfig exempteddigits="227"> was read as "2"; write digits from 1 (thumb) to 5, each once"#,
        ),
        (
            r#"<handconfig thumbpos="out"/>"#,
            "4: <handconfig> says something of a handshape without handshape=…; it was left out",
        ),
        (
            r#"<handconfig handshape="flat" colour="red"/>"#,
            r#"4: <handconfig> has no attribute colour="red"; it was left out"#,
        ),
        (
            "<handconfig handshape=\"flat\"/>\n<handconfig handshape=\"fist\"/>",
            "5: <handconfig> says what another in <sign_manual> said before; the last one counts",
        ),
        (
            "<nomotion/>\n<handconfig handshape=\"flat\"/>",
            "5: <handconfig> stands after a motion; it was read as part of the posture the sign begins with",
        ),
        (
            r#"<location_bodyarm side="right_at"/>"#,
            "4: <location_bodyarm> has side without location; it was read as a side of neutralspace",
        ),
        (
            r#"<location_bodyarm location="chest" second_side="left_at"/>"#,
            "4: <location_bodyarm> has second_side without second_location; it was read as a side of chest",
        ),
        (
            "<split_location><location_bodyarm/></split_location>",
            "4: <split_location> holds fewer than two halves; they belong to the dominant hand",
        ),
        ("<no_motion/>", "4: <no_motion> was read as <nomotion>"),
        (
            r#"<directedmotion direction="u" speed="0.3"/>"#,
            "4: <directedmotion speed> is not in SiGML 1.2; it was kept as a factor",
        ),
        (
            r#"<directedmotion/>"#,
            r#"4: <directedmotion> has no direction that can be read; it was taken as "o""#,
        ),
        (
            "<par_motion><nomotion/></par_motion>",
            "4: <par_motion> holds 1 motions instead of two or more",
        ),
        (
            "<rpt_motion repetition=\"swap\"><nomotion/>\n<nomotion/></rpt_motion>",
            "4: <rpt_motion> holds 2 motions instead of one; they were read as a sequence",
        ),
        (
            "<rpt_motion><nomotion/></rpt_motion>",
            r#"4: <rpt_motion> has no repetition that can be read; it was taken as "fromstart""#,
        ),
        (
            "<tgt_motion><nomotion/></tgt_motion>",
            "4: <tgt_motion> says no posture that it ends in",
        ),
        (
            "<changeposture/>",
            "4: <changeposture> stands outside <tgt_motion>; it changes nothing",
        ),
        ("<dance/>", "4: <dance> has no place in <sign_manual>; it was left out"),
        (
            "\n<nomotion>“2” tip&gt;</nomotion>",
            r#"5: there is text in <nomotion>: "“2” tip"; it was left out"#,
        ),
        ("<!-- so -->", "4: an XML comment or instruction is not kept"),
        (
            "<nonmanualconfig><nomotion/></nonmanualconfig>",
            "4: <nonmanualconfig> names no part of the body; it was left out",
        ),
    ] {
        assert_eq!(part(manual).1, [reported], "{manual}");
    }
}

#[test]
fn a_location_inside_a_motion_means_brushing() {
    let (part, reported) = part(
        r#"<circularmotion axis="o" fast="true"><location_hand location="handback" contact="touch"/></circularmotion>"#,
    );
    assert!(reported.is_empty(), "{reported:?}");
    let MotionKind::Target {
        motion: Some(motion),
        posture,
    } = &part.actions[0].kind
    else {
        panic!("{:?}", part.actions)
    };
    assert!(motion.manner.fast && !part.actions[0].manner.fast);
    assert!(matches!(&posture.place, Some(HandPlace::Hand(site)) if site.contact == Some(PlaceContact::Brushing)));
}

#[test]
fn symbols_are_read_and_written() {
    let text = br#"<sigml>
<hns_sign gloss="HERE">
<hamnosys_nonmanual><hnm_head tag="NO"/><hnm_mouthpicture picture="hi:r"/><hnm_nose tag="XX"/><hnm_body tag=""/></hamnosys_nonmanual>
<hamnosys_manual>
<hamsymmlr/><hamfinger2/><hamthumbacrossmod/>
<hamextfingero/><hampalmd/><hamtab/>
<hamfoo/>
<hammoved/><hamsmallmod/><hamrepeatfromstart/>
</hamnosys_manual>
</hns_sign>
</sigml>"#;
    let (signs, findings) = sigml::read_sigml_signs(text).expect("it is SiGML");
    let reported: Vec<_> = findings.iter().map(|f| (f.line, &f.message[..])).collect();
    assert_eq!(
        reported,
        [
            (Some(3), "<hnm_nose>: SiGML 1.2 lists no \"XX\"; it was kept as it is"),
            (Some(3), "<hnm_body tag=\"\"> says nothing; it was left out"),
            (Some(6), "<hamtab> is layout; it was left out"),
            (Some(7), "<hamfoo> is not a symbol of HamNoSys; it was left out"),
        ]
    );
    let sign = &signs[0].sign;
    assert!(matches!(sign.sign.parts[0].hands, HandsUsed::Both(symmetry) if symmetry.left_right));
    assert_eq!(
        sign.nonmanual.tiers[&TierKind::Head].groups[0],
        [NonmanualAct::new(NonmanualPart::Head, "NO")]
    );
    let (written, lost) = sigml::write_symbols([sign]);
    assert_eq!(lost, [Vec::<String>::new()]);
    let (again, findings) = sigml::read_sigml_signs(&written).expect("we wrote it");
    assert_eq!((&again[0].sign, findings.len()), (sign, 1), "{findings:?}");
    let gestural = sigml::write_gestural([sign]);
    assert_eq!(
        sigml::read_sigml_signs(&gestural).expect("we wrote it").0[0].sign.sign,
        sign.sign
    );
}

#[test]
fn every_spelling_of_a_text_gives_the_same_symbols() {
    let characters = "\u{e001}\u{e020}\u{e03c}";
    for (text, losses) in [
        (characters, 0),
        ("hamflathand hamextfingeru hampalmd", 0),
        ("hamflathand\thamextfingeru\thampalmd", 0),
        ("hamflathand, hamextfingeru,hampalmd", 0),
        ("HamFlatHand \u{e020}\u{e03c}", 0),
        ("U+E001 U+E020 U+E03C", 0),
        ("\\hamflathand\\hamextfingeru\\hampalmd", 0),
        ("hamflathand hamnosuch hamextfingeru hampalmd", 1),
    ] {
        let sign = NotatedSign {
            text: Some(text.to_owned()),
            ..NotatedSign::default()
        };
        let (written, lost) = sigml::write_symbols([&sign]);
        assert_eq!(lost[0].len(), losses, "{text:?}: {lost:?}");
        let (again, _) = sigml::read_sigml_signs(&written).expect("we wrote it");
        let read = again[0].sign.text.as_deref().unwrap_or_default();
        assert_eq!(read.replace(' ', ""), characters, "{text:?}");
    }
}

#[test]
fn losses_of_the_symbol_form_are_reported() {
    let text = document(r#"<directedmotion direction="uol" speed="0.5"/>"#);
    let (signs, _) = sigml::read_sigml_signs(text.as_bytes()).expect("it is SiGML");
    let (_, lost) = sigml::write_symbols(signs.iter().map(|entry| &entry.sign));
    assert!(!lost[0].is_empty());
}

#[test]
fn elements_with_the_prefix_of_a_namespace_are_read_like_those_without() {
    let plain = document("<handconfig handshape=\"flat\" extfidir=\"u\" palmor=\"d\"/>");
    let prefixed = plain
        .replace("</", "</sg:")
        .replace("<s", "<sg:s")
        .replace("<h", "<sg:h");
    let named = prefixed.replacen("<sg:sigml>", "<sg:sigml xmlns:sg=\"http://example.org/sigml\">", 1);
    let wanted = sigml::read_sigml_signs(plain.as_bytes()).expect("it is SiGML");
    for text in [prefixed, named] {
        let (signs, findings) = sigml::read_sigml_signs(text.as_bytes()).expect("it is SiGML");
        assert_eq!((signs, findings), wanted.clone(), "{text}");
    }
}

#[test]
fn files_that_are_no_sigml_are_refused() {
    let deep = format!("<sigml>{}", "<sigmlsection>".repeat(100));
    let bomb = "<!DOCTYPE sigml [<!ENTITY a \"b\"><!ENTITY c \"&a;&a;\">]><sigml/>";
    for (text, expected) in [
        ("", "line 1: this is not XML"),
        ("hello", "line 1: this is not XML"),
        ("\u{1}<sigml/>", "line 1: this is not XML"),
        ("<eaf/>", "line 1: the root element is <eaf>"),
        (
            "<sigml>\n<hamgestural_sign>",
            "line 2: the file ends inside <hamgestural_sign>",
        ),
        ("<sigml>\n</sign>", "line 2: </sign> closes <sigml>"),
        ("<sigml/>\n<sigml/>", "line 2: <sigml> is a second root element"),
        ("<sigml a/>", "line 1: <sigml> has a broken attribute"),
        (bomb, "line 1: a <!DOCTYPE …> with declarations of its own is not read"),
        (&deep, "line 1: elements are nested too deep, more than 64"),
        (
            "<?xml version=\"1.0\" encoding=\"latin1\"?><sigml base_uri=\"é\"/>",
            "line 1: the text is in latin1",
        ),
    ] {
        let error = sigml::read_sigml_signs(text.as_bytes()).expect_err(text).to_string();
        assert!(error.starts_with(expected), "{text}: {error}");
    }
    let wide: Vec<u8> = "<sigml/>".bytes().flat_map(|byte| [byte, 0]).collect();
    assert!(matches!(
        sigml::read_sigml_signs(&wide),
        Err(SigmlError::Encoding { .. })
    ));
    assert!(matches!(
        sigml::read_sigml_signs(b"<sigml a='\xff'/>"),
        Err(SigmlError::Encoding { line: 1, .. })
    ));
}

#[test]
fn other_encodings_are_read_if_the_document_declares_them() {
    let sign = "<SiGML>\n<hns_sign gloss=\"ÉTÉ\"><hamnosys_manual><hamfist/></hamnosys_manual></hns_sign></SiGML>";
    let western = format!("<?xml version='1.0'\nencoding='ISO-8859-1'?>{sign}");
    let western: Vec<u8> = western.chars().map(|c| u32::from(c) as u8).collect();
    let wide = format!("\u{feff}<?xml version=\"1.0\" encoding=\"utf-16\"?>\n{sign}");
    let wide: Vec<u8> = wide.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [western, wide] {
        let (signs, findings) = sigml::read_sigml_signs(&bytes).expect("it is SiGML");
        assert_eq!((&*signs[0].sign.gloss, signs[0].line.0), ("ÉTÉ", 3));
        assert_eq!(findings.len(), 2, "{findings:?}");
    }
}

#[test]
fn nesting_up_to_the_limit_is_read_and_written() {
    let depth = 59;
    let motion = format!(
        "{}<directedmotion direction=\"u\"/>{}",
        "<seq_motion>".repeat(depth),
        "</seq_motion>".repeat(depth)
    );
    let site = format!(
        "{}{}",
        "<location_hand digits=\"2\">".repeat(depth),
        "</location_hand>".repeat(depth)
    );
    for text in [document(&motion), document(&site)] {
        let (signs, _) = sigml::read_sigml_signs(text.as_bytes()).expect("it is not too deep");
        let written = sigml::write_gestural(signs.iter().map(|entry| &entry.sign));
        assert_eq!(sigml::read_sigml_signs(&written).expect("we wrote it").0, signs);
        let _ = sigml::write_symbols(signs.iter().map(|entry| &entry.sign));
    }
}

#[test]
fn truncation_anywhere_is_an_error_or_a_document() {
    let text = document(
        "<handconfig extfidir=\"uuo\"/><rpt_motion repetition=\"swap\"><directedmotion direction=\"u\"/></rpt_motion>",
    );
    for end in 0..text.len() {
        let whole = text[..end].trim_end().ends_with("</sigml>");
        assert_eq!(sigml::read_sigml_signs(&text.as_bytes()[..end]).is_ok(), whole, "{end}");
    }
}
