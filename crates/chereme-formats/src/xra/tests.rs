use super::{read_xra, write_xra};
use crate::tests::tiers_as_lines as lines;
use crate::transcript::POINT_TIER_KIND;

const WHOLE: &str = r#"<?xml version='1.0' encoding='utf-8'?>
<Document author="Zoé" date="2026-05-30T10:04:23+02:00" format="1.5" name="Codage">
  <Metadata><Entry key="created">2026</Entry></Metadata>
  <Media id="m1" url="file:///prise.wav" mimetype="audio/wav"><Tier id="t1"/><Content>abc</Content></Media>
  <Tier id="t1" tiername="PhonAlign">
    <Metadata><Entry key="language">0</Entry></Metadata>
    <Annotation id="a1"><Location><Interval><Begin midpoint="0.0" radius="0.0"/><End midpoint="0.5209139999999997" radius="0.005"/></Interval></Location><Label><Tag>#</Tag></Label></Annotation>
    <Annotation id="a2"><Location><Interval score="0.2"><Begin midpoint="9"/><End midpoint="10"/></Interval><Interval score="0.8"><Begin midpoint="0.520914"/><End midpoint="0.7"/></Interval></Location><Label><Tag score="0.9">O/</Tag><Tag>o</Tag></Label></Annotation>
    <Annotation id="a3"><Location><Interval><Begin midpoint="0.7"/><End midpoint="1.0"/></Interval></Location><Label><Tag> U~/ </Tag></Label></Annotation>
  </Tier>
  <Tier id="t2" tiername="TokensAlign">
    <Annotation id="a1"><Location><Interval><Begin midpoint="0.0"/><End midpoint="0.520914"/></Interval></Location><Label><Tag>#</Tag></Label></Annotation>
    <Annotation id="b2"><Location><Interval><Begin midpoint="0.520914"/><End midpoint="1.0"/></Interval></Location><Label><Tag>l'un</Tag></Label><Label/></Annotation>
  </Tier>
  <Tier id="t3" tiername="CS-Keys">
    <Annotation><Location><Interval><Begin midpoint="0.5"/><End midpoint="1.0"/></Interval></Location><Label><Tag>5</Tag></Label><Label><Tag>c</Tag></Label></Annotation>
    <Annotation><Location><Interval><Begin midpoint="0.8"/><End midpoint="1.2"/></Interval></Location><Label><Tag>cue:mouth-4</Tag></Label></Annotation>
    <Annotation><Location><Interval><Begin midpoint="a"/><End midpoint="1.2"/></Interval></Location></Annotation>
  </Tier>
  <Tier id="t4" tiername="Ton">
    <Annotation><Location><Point midpoint="0.1234" radius="0.01"/></Location><Label><Tag>H*</Tag></Label></Annotation>
    <Annotation><Location><Disjoint><Interval><Begin midpoint="0.2"/><End midpoint="0.3"/></Interval><Interval><Begin midpoint="0.4"/><End midpoint="0.6"/></Interval></Disjoint></Location></Annotation>
  </Tier>
  <Tier id="t5" tiername="Notes"><Annotation><Location><Point midpoint="0.7"/></Location><Label><Tag>L%</Tag></Label></Annotation></Tier>
  <Hierarchy><Link type="TimeAlignment" from="t1" to="t2"/><Link type="TimeAlignment" from="t5" to="t4"/></Hierarchy>
</Document>"#;

#[test]
fn tiers_alternatives_and_links_are_read() {
    let (transcript, findings) = read_xra(WHOLE.as_bytes()).expect("a document");
    assert_eq!(
        lines(&transcript),
        [
            "PhonAlign [] Included_In of TokensAlign: a 0-520914 \"#\", b 520914-700000 \"{O/|o}\", b 700000-1000000 \"U~/\"",
            "TokensAlign []: 0-520914 \"#\", 520914-1000000 \"l'un\"",
            "CS-Keys []: 500000-1000000 \"5\\nc\"",
            "CS-Keys (2) []: 800000-1200000 \"cue:mouth-4\"",
            "Ton []: 123400-163400 \"H*\", 200000-600000 \"\"",
            "Notes [TextTier]: 700000-740000 \"L%\"",
        ]
    );
    assert_eq!(transcript.tiers[5].kind, POINT_TIER_KIND);
    let ids: Vec<&str> = transcript.tiers[..2]
        .iter()
        .map(|tier| tier.annotations[0].id.as_str())
        .collect();
    assert_eq!(ids, ["a1", "a1-2"], "an id that two tiers share");
    assert_eq!(
        (transcript.author.as_str(), transcript.media[0].url.as_str()),
        ("Zoé", "file:///prise.wav")
    );
    for said in [
        "has several places in time",
        "of the tier \"CS-Keys\" has no time in seconds",
        "annotations of \"CS-Keys\" overlap others: 1",
        "\"Notes\" does not lie within \"Ton\" everywhere",
    ] {
        assert!(
            findings.iter().any(|finding| finding.message.contains(said)),
            "{said}: {findings:?}"
        );
    }
}

#[test]
fn a_written_document_reads_back_equal() {
    let (mut first, _) = read_xra(WHOLE.as_bytes()).expect("a document");
    first.tiers[0].participant = Some("Zoé & Co".to_owned());
    first.tiers[1].annotations[1].value = "<l'un> \"ça\"".to_owned();
    let text = write_xra(&first, "prise");
    let (again, findings) = read_xra(text.as_bytes()).expect("a document");
    assert!(findings.is_empty(), "{findings:?}");
    // Keys come back in the notation of SPPAS.
    first.tiers[3].annotations[0].value = "4\nm".to_owned();
    assert_eq!(again, first);
    assert_eq!(write_xra(&again, "prise"), text);
    assert!(
        text.contains("<Link type=\"TimeAlignment\" from=\"t0\" to=\"t1\" />"),
        "{text}"
    );
    assert!(
        text.contains("<Begin midpoint=\"0.0\" />"),
        "a whole number would be a frame: {text}"
    );
}

#[test]
fn old_versions_are_read_and_what_is_no_document_is_refused() {
    let old = "<Document><Tier ID=\"t\" tiername=\"Old\"><Annotation><Location><Localization score=\"1.0\"><TimeInterval>\
               <Begin midpoint=\"1\"/><End midpoint=\"2\"/></TimeInterval></Localization></Location><Label><Text>a</Text></Label>\
               </Annotation></Tier></Document>";
    let (transcript, findings) = read_xra(old.as_bytes()).expect("a document");
    assert_eq!(lines(&transcript), ["Old []: 1000000-2000000 \"a\""]);
    assert!(findings[0].message.contains("whole numbers"), "{findings:?}");
    for (text, said) in [
        ("<ANNOTATION_DOCUMENT/>", "it should be <Document>"),
        ("<Document><Tier id=\"t\">", "cut short"),
        ("<!DOCTYPE d [<!ENTITY a \"b\">]><Document/>", "entities"),
        ("a,b", "SPPAS"),
    ] {
        let error = read_xra(text.as_bytes()).expect_err(text).to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
}
