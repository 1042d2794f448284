use super::read_exmaralda;
use crate::tests::tiers_as_lines as lines;

const WHOLE: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- (c) http://www.rrz.uni-hamburg.de/exmaralda -->
<basic-transcription>
  <head>
    <meta-information>
      <project-name>Essai</project-name><transcription-name/>
      <referenced-file url="take.mpg"/>
      <ud-meta-information><ud-information attribute-name="Place">Paris</ud-information></ud-meta-information>
      <comment></comment><transcription-convention/>
    </meta-information>
    <speakertable>
      <speaker id="SPK0"><abbreviation>ANNA</abbreviation><sex value="f"/><languages-used/><l1/><l2/><ud-speaker-information/><comment/></speaker>
    </speakertable>
  </head>
  <basic-body>
    <common-timeline>
      <tli id="T0" time="0.0"/><tli id="T1" time="0.5"/><tli id="T2"/><tli id="T3" time="1.5" type="appl"/>
    </common-timeline>
    <tier id="TIE0" speaker="SPK0" category="gloss" type="t" display-name="ANNA [gloss]">
      <event start="T0" end="T1">CHAT &amp; CO </event>
      <event start="T1" end="T2">CHIEN</event>
    </tier>
    <tier id="TIE1" speaker="SPK0" category="handshape" type="a">
      <event start="T0" end="T1">5<ud-information attribute-name="x">y</ud-information></event>
      <event start="T0" end="T3">B</event>
      <event start="T0" end="T9">lost</event>
    </tier>
    <tier id="TIE2" category="" type="d"/>
  </basic-body>
  <tierformat-table><x/></tierformat-table>
</basic-transcription>"#;

#[test]
fn tiers_lie_on_the_timeline() {
    let (transcript, findings) = read_exmaralda(WHOLE.as_bytes()).expect("a transcription");
    assert_eq!(
        lines(&transcript),
        [
            "ANNA [gloss] [gloss]: 0-500000 \"CHAT & CO \", 500000-1000000 \"CHIEN\"",
            "ANNA [handshape] [handshape]: 0-500000 \"5\"",
            "ANNA [handshape] (2) [handshape]: 0-1500000 \"B\"",
            "TIE2 []:",
        ]
    );
    assert_eq!(transcript.tiers[0].participant.as_deref(), Some("ANNA"));
    assert_eq!(transcript.media[0].url, "take.mpg");
    let named = |key: &str, text: &str| (key.to_owned(), text.to_owned());
    assert_eq!(
        transcript.properties,
        [named("project-name", "Essai"), named("Place", "Paris")]
    );
    let all: Vec<&String> = findings.iter().map(|it| &it.message).collect();
    for said in [
        "points of the timeline without a time lie evenly between their neighbours: 1",
        "the event \"lost\" of the tier \"ANNA [handshape]\" lies between points",
        "elements <ud-information> are not read and were left out: 1",
        "annotations of \"ANNA [handshape]\" overlap others: 1",
    ] {
        assert!(all.iter().any(|it| it.contains(said)), "{said}: {all:?}");
    }
}

#[test]
fn points_without_times_lie_between_those_with_times() {
    let timeline = |points: &str| {
        format!(
            "<basic-transcription><basic-body><common-timeline>{points}</common-timeline><tier id=\"t\" category=\"v\">\
             <event start=\"a\" end=\"b\">1</event><event start=\"b\" end=\"c\">2</event></tier></basic-body></basic-transcription>"
        )
    };
    for (points, expected, said) in [
        (
            "<tli id=\"a\"/><tli id=\"b\"/><tli id=\"c\"/>",
            "0-1000000 \"1\", 1000000-2000000 \"2\"",
            "no point of the timeline has a time",
        ),
        (
            "<tli id=\"a\"/><tli id=\"b\"/><tli id=\"c\" time=\"3\"/>",
            "0-1500000 \"1\", 1500000-3000000 \"2\"",
            "without a time lie evenly",
        ),
        (
            "<tli id=\"a\" time=\"2\"/><tli id=\"b\"/><tli id=\"c\" time=\"x\"/>",
            "2000000-3000000 \"1\", 3000000-4000000 \"2\"",
            "is no number of seconds",
        ),
        (
            "<tli id=\"a\" time=\"2\"/><tli id=\"b\" time=\"1\"/><tli id=\"c\" time=\"3\"/>",
            "1000000-2000000 \"1\"",
            "is earlier than the one before it",
        ),
    ] {
        let (transcript, findings) = read_exmaralda(timeline(points).as_bytes()).expect("a transcription");
        let found = lines(&transcript).remove(0);
        assert!(found.starts_with(&format!("v [v]: {expected}")), "{points}: {found}");
        assert!(
            findings.iter().any(|it| it.message.contains(said)),
            "{points}: {findings:?}"
        );
    }
}
