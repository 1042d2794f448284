use super::read_anvil;
use crate::markup::MarkupError;
use crate::roles::{TierMapping, guess_tiers};
use crate::tests::tiers_as_lines as lines;
use crate::textgrid::{self, TextGridForm};

const WHOLE: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<annotation>
  <head>
    <specification src="../spec.xml" />
    <video src="film/take.mov" master="true" />
    <info key="coder" type="String">
      Zoé
    </info>
  </head>
  <body>
    <track name="Signs.Right" type="primary">
      <el index="0" start="0.2" end="0.64"><attribute name="token">CHAT</attribute>
        <attribute name="handshape">5</attribute><comment>sure?</comment></el>
      <el index="1" start="1.2000000476837158" end="2"><attribute name="token">CHIEN</attribute></el>
    </track>
    <track name="Signs.Right.place" type="singleton" ref="Signs.Right">
      <el index="0" ref="1"><attribute name="place">chin</attribute></el>
    </track>
    <track name="Phrase" type="span" ref="Signs.Right">
      <el index="0" start="0" end="1"><attribute name="text">le chat, le chien</attribute></el>
    </track>
    <track name="Phase" type="subdivision" ref="Signs.Right">
      <el-group ref="0">
        <el index="0"><attribute name="type">prep</attribute></el>
        <el index="1" start="0.3"><attribute name="type">stroke</attribute></el>
        <el index="2"><attribute name="type">hold</attribute></el>
      </el-group>
    </track>
    <track name="Beats" type="primarypoint">
      <el index="0" time="0.5"><attribute name="b">x</attribute></el>
      <el index="1" time="0.51"><attribute name="b">y</attribute></el>
    </track>
    <track name="Empty" type="primary"></track>
  </body>
</annotation>"#;

#[test]
fn tracks_of_all_types_become_tiers() {
    let (transcript, findings) = read_anvil(WHOLE.as_bytes()).expect("a file");
    assert_eq!(
        lines(&transcript),
        [
            "Signs.Right [ANVIL track]: 200000-640000 \"\", 1200000-2000000 \"\"",
            "Signs.Right.token [token] Symbolic_Association of Signs.Right: a 200000-640000 \"CHAT\", b 1200000-2000000 \"CHIEN\"",
            "Signs.Right.handshape [handshape] Symbolic_Association of Signs.Right: a 200000-640000 \"5\"",
            "Signs.Right.comment [comment] Symbolic_Association of Signs.Right: a 200000-640000 \"sure?\"",
            "Signs.Right.place [place] Symbolic_Association of Signs.Right: b 1200000-2000000 \"chin\"",
            "Phrase [text]: 200000-2000000 \"le chat, le chien\"",
            "Phase [type] Time_Subdivision of Signs.Right: a 200000-300000 \"prep\", a 300000-470000 \"stroke\", a 470000-640000 \"hold\"",
            "Beats [TextTier]: 500000-510000 \"x\", 510000-550000 \"y\"",
            "Empty []:",
        ]
    );
    assert_eq!(transcript.media[0].url, "film/take.mov");
    assert_eq!(transcript.media[0].mime_type, "video/quicktime");
    assert_eq!(transcript.properties, [("coder".to_owned(), "Zoé".to_owned())]);
    assert_eq!(transcript.tiers[0].annotator.as_deref(), Some("Zoé"));
    assert_eq!(findings.len(), 2, "{findings:?}");
}

#[test]
fn an_attribute_states_the_role_of_its_tier_else_the_track_does() {
    let (transcript, _) = read_anvil(WHOLE.as_bytes()).expect("a file");
    let topics = |transcript: &crate::transcript::AnnotationTranscript| -> Vec<String> {
        let guesses = guess_tiers(transcript, &TierMapping::default());
        let topic = |it: &crate::roles::TierGuess| it.guessed_tier_topic().map_or("-".to_owned(), |it| it.to_string());
        guesses.iter().map(topic).collect()
    };
    assert_eq!(
        topics(&transcript)[..5],
        ["-", "right.gloss", "right.configuration", "comment", "right.placement"]
    );
    let body = |tracks: &str| format!("<annotation><body>{tracks}</body></annotation>");
    let element = |first: &str, second: &str| {
        format!(
            "<el index=\"0\" start=\"0\" end=\"1\"><attribute name=\"{first}\">a</attribute><attribute name=\"{second}\">b</attribute></el>"
        )
    };
    for (track, first, second, expected) in [
        ("Gloss RH", "what", "certainty", ["-", "right.gloss", "-"]),
        ("RH", "handshape", "gloss", ["-", "right.configuration", "right.gloss"]),
        (
            "Handshape",
            "right",
            "left",
            ["-", "right.configuration", "left.configuration"],
        ),
        ("Signs", "right", "left", ["-", "right.gloss", "left.gloss"]),
        ("Signs", "gloss", "lemma", ["-", "gloss", "translation"]),
        ("Things", "size", "colour", ["-", "-", "-"]),
    ] {
        let track = format!(
            "<track name=\"{track}\" type=\"primary\">{}</track>",
            element(first, second)
        );
        let (transcript, _) = read_anvil(body(&track).as_bytes()).expect("a file");
        assert_eq!(topics(&transcript), expected, "{track}");
    }
}

#[test]
fn encodings_are_those_of_the_declaration() {
    let utf_16 = |text: &str| -> Vec<u8> {
        let units = std::iter::once(0xfeff).chain(text.encode_utf16());
        units.flat_map(u16::to_le_bytes).collect()
    };
    let text = WHOLE.replace("UTF-8", "UTF-16");
    let latin = WHOLE.replace("UTF-8", "ISO-8859-1");
    let latin: Vec<u8> = latin.chars().map(|c| c as u8).collect();
    let (expected, _) = read_anvil(WHOLE.as_bytes()).expect("a file");
    for bytes in [utf_16(&text), latin, [b"\xef\xbb\xbf", WHOLE.as_bytes()].concat()] {
        assert_eq!(read_anvil(&bytes).expect("a file").0, expected);
    }
}

#[test]
fn oddities_are_reported_and_nothing_is_lost_in_silence() {
    let body = |tracks: &str| format!("<annotation><body>{tracks}</body></annotation>");
    for (tracks, expected, said) in [
        (
            "<track name=\"a\" type=\"primary\"><el index=\"0\" start=\"0\" end=\"2\"/><el index=\"1\" start=\"1\" end=\"3\"/></track>",
            vec!["a []: 0-2000000 \"\"", "a (2) []: 1000000-3000000 \"\""],
            "annotations of \"a\" overlap others: 1 were put on tiers of their own, as \"a (2)\"",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el index=\"0\" start=\"-0.5\" end=\"-0.5\"/></track>",
            vec!["a []: -500000--460000 \"\""],
            "has no length; it lasts 40 ms",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el index=\"0\" start=\"2\" end=\"1\"/></track>",
            vec!["a []: 1000000-2000000 \"\""],
            "the ends were exchanged",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el index=\"7\" start=\"2\"/></track>",
            vec!["a []:"],
            "element 7 of the track \"a\" has no time that can be read and was left out",
        ),
        (
            "<track name=\"a\" type=\"span\" ref=\"b\"><el start=\"0\" end=\"0\"/></track><track name=\"b\" type=\"span\" ref=\"a\"/>",
            vec!["a []:", "b []:"],
            "the track \"b\" refers to \"a\", and so to itself; its 0 elements were left out",
        ),
        (
            "<track name=\"a\" type=\"singleton\" ref=\"c\"><el ref=\"0\"/></track>",
            vec!["a []:"],
            "the track \"a\" refers to \"c\", which is not in the file; its 1 elements were left out",
        ),
        (
            "<track name=\"s\" type=\"singleton\" ref=\"a\"><el ref=\"0\"><attribute name=\"v\">1</attribute></el><el ref=\"0\"><attribute name=\"v\">2</attribute></el><el ref=\"9\"/></track>\
             <track name=\"a\" type=\"primary\"><el index=\"0\" start=\"0\" end=\"1\"/></track>",
            vec![
                "s [v] Symbolic_Association of a: a 0-1000000 \"1\"",
                "s (2) [v] Symbolic_Association of a: a 0-1000000 \"2\"",
                "a []: 0-1000000 \"\"",
            ],
            "element 2 of the track \"s\" refers to no element that was read and was left out",
        ),
        (
            "<track name=\"a\" type=\"odd\"><el index=\"0\" time=\"1\"/></track>",
            vec!["a [TextTier]: 1000000-1040000 \"\""],
            "the type \"odd\", which is not known",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el start=\"0\" end=\"1\"><attribute name=\"l\"><value-link ref-track=\"b.c\" ref-index=\"3\"/><value-link ref-track=\"b.c\" ref-index=\"4\"/></attribute></el></track>",
            vec!["a [l]: 0-1000000 \"b.c 3, b.c 4\""],
            "links to other elements are kept as texts, the track and the index: 2",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el start=\"0\" end=\"1\"><attribute name=\"p\"><value-point x=\"1\" y=\"2\"/></attribute></el></track>",
            vec!["a [p]: 0-1000000 \"\""],
            "elements <value-point> are not read and were left out: 1",
        ),
        (
            "<set name=\"people\"><el/><el/></set><track name=\"a\"/><track name=\"a\"/>",
            vec!["a []:", "a (2) []:"],
            "the set \"people\" has no times; its 2 elements were left out",
        ),
        (
            "<track name=\"a\" type=\"primary\"><el start=\"0\" end=\"1\"><attribute name=\"v\">1</attribute><attribute name=\"v\">2</attribute></el></track>",
            vec!["a [v]: 0-1000000 \"1; 2\""],
            "has the attribute \"v\" twice; both values are kept",
        ),
    ] {
        let (transcript, findings) = read_anvil(body(tracks).as_bytes()).expect("a file");
        assert_eq!(lines(&transcript), expected, "{tracks}");
        let all: Vec<&String> = findings.iter().map(|it| &it.message).collect();
        assert!(all.iter().any(|it| it.contains(said)), "{tracks}: {all:?}");
    }
}

#[test]
fn other_documents_are_refused() {
    for (text, said) in [
        (
            "<annotation><info/></annotation>",
            "<annotation> has no <body>; a file of ANVIL has one",
        ),
        ("<annotation-spec/>", "it should be <annotation>"),
        ("<annotation><body>", "it was cut short"),
        ("", "a file of ANVIL starts with"),
        (
            "<!DOCTYPE a [<!ENTITY b \"c\">]><annotation><body/></annotation>",
            "entities can hide anything",
        ),
    ] {
        let error = read_anvil(text.as_bytes()).expect_err("no file");
        assert!(error.to_string().contains(said), "{text}: {error}");
    }
    let named = "<!DOCTYPE annotation SYSTEM \"a.dtd\"><annotation><body/></annotation>";
    assert_eq!(read_anvil(named.as_bytes()).expect("a file").1.len(), 1);
    assert!(matches!(read_anvil(b"\xff\xfe\0"), Err(MarkupError::Encoding { .. })));
}

#[test]
fn points_and_intervals_come_back_from_a_text_grid() {
    let (transcript, _) = read_anvil(WHOLE.as_bytes()).expect("a file");
    let (text, _) = textgrid::write_textgrid(&transcript, TextGridForm::Long, transcript.transcript_end());
    let (again, _) = textgrid::read_textgrid_file(text.as_bytes()).expect("a grid");
    for tier in transcript.tiers.iter().filter(|it| it.kind != super::ELEMENT_TIER_TYPE) {
        let other = again.tiers.iter().find(|it| it.name == tier.name).expect(&tier.name);
        let parts = |tier: &crate::transcript::TranscriptTier| -> Vec<_> {
            tier.annotations.iter().map(|it| (it.span, it.value.clone())).collect()
        };
        assert_eq!(parts(tier), parts(other), "{}", tier.name);
    }
}

#[test]
fn ids_stay_when_other_elements_come() {
    let (before, _) = read_anvil(WHOLE.as_bytes()).expect("a file");
    let more =
        "type=\"primary\">\n      <el index=\"0\" start=\"0\" end=\"0.1\"><attribute name=\"token\">X</attribute></el>";
    let text = WHOLE
        .replacen("type=\"primary\">", more, 1)
        .replace("<el index=\"0\" start=\"0.2\"", "<el index=\"9\" start=\"0.2\"");
    let (after, _) = read_anvil(text.as_bytes()).expect("a file");
    let ids = |tier: usize, all: &crate::transcript::AnnotationTranscript| -> Vec<String> {
        all.tiers[tier].annotations.iter().map(|it| it.id.clone()).collect()
    };
    assert_eq!(ids(1, &before), ids(1, &after)[1..]);
    assert_eq!(ids(7, &before), ids(7, &after));
}
