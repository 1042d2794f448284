use super::read_signstream_file;
use crate::markup::MarkupError;
use crate::roles::{TierMapping, guess_tiers};
use crate::tests::tiers_as_lines as lines;

const WHOLE: &str = r#"<SIGNSTREAM-DATABASE SIGNSTREAM-VERSION="2"><AUTHOR>C. N.</AUTHOR>
<PARTICIPANTS><PARTICIPANT ID="0" LABEL="Benjamin" NAME="B" AGE="" GENDER="m" LANGUAGE="ASL"><BACKGROUND/></PARTICIPANT></PARTICIPANTS>
<CODING-SCHEME><FIELD ID="10000" NAME="main gloss"/>
<FIELD ID="1" NAME="eye brows"><VALUE ID="2" NAME="raised"/><VALUE ID="400001" NAME="ONSET"/></FIELD></CODING-SCHEME>
<MEDIA-FILES><MEDIA-FILE ID="1" LEGACY-PATH="data:video.mov"/><MEDIA-FILE ID="2" LEGACY-PATH="data:side.mov"/></MEDIA-FILES>
<UTTERANCES>
<UTTERANCE ID="3" S="666" E="3333"><MEDIA-REF ID="1"/><MEDIA-REF ID="2"/>
<SEGMENT PARTICIPANT-ID="0"><TRACK FID="10000"><A S="0" E="233">JOHN</A><A S="300" E="500">LOVE</A></TRACK>
<TRACK FID="1"><A S="300" E="2300" VID="2"/><A S="-33" E="266" VID="400001"/><A S="2300" E="2400" VID="9"/></TRACK></SEGMENT></UTTERANCE>
<UTTERANCE ID="4" S="4000" E="5000"><MEDIA-REF ID="1"/></UTTERANCE>
</UTTERANCES></SIGNSTREAM-DATABASE>"#;

#[test]
fn fields_become_tiers_on_the_clock_of_the_film() {
    let (transcript, findings) = read_signstream_file(WHOLE.as_bytes()).expect("a collection");
    assert_eq!(
        lines(&transcript),
        [
            "utterance [utterance]: 666000-3333000 \"3\", 4000000-5000000 \"4\"",
            "main gloss [main gloss]: 666000-899000 \"JOHN\", 966000-1166000 \"LOVE\"",
            "eye brows [eye brows]: 966000-2966000 \"raised\", 633000-932000 \"ONSET\", 2966000-3066000 \"9\"",
        ]
    );
    assert_eq!(transcript.tiers[1].participant.as_deref(), Some("Benjamin"));
    assert_eq!(transcript.media[1].url, "data/side.mov");
    assert_eq!(findings.len(), 1, "{findings:?}");
    let guesses = guess_tiers(&transcript, &TierMapping::default());
    let topic = |at: usize| guesses[at].guessed_tier_topic().map(|it| it.to_string());
    assert_eq!(topic(1).as_deref(), Some("gloss"));
    assert_eq!(topic(2).as_deref(), Some("nonmanual.brows"));
}

#[test]
fn utterances_of_several_films_have_no_common_clock() {
    let other = WHOLE.replace("E=\"5000\"><MEDIA-REF ID=\"1\"/>", "E=\"5000\"><MEDIA-REF ID=\"3\"/>");
    assert_eq!(
        read_signstream_file(other.as_bytes()),
        Err(MarkupError::Films { films: 2 })
    );
    let joined = WHOLE.replace(
        "E=\"5000\"><MEDIA-REF ID=\"1\"/>",
        "E=\"5000\"><MEDIA-REF ID=\"3\"/><MEDIA-REF ID=\"2\"/>",
    );
    assert!(read_signstream_file(joined.as_bytes()).is_ok());
    let newer = "<SIGNSTREAM-DATABASE SIGNSTREAM-VERSION=\"3\"><SEGMENTS/></SIGNSTREAM-DATABASE>";
    assert!(matches!(
        read_signstream_file(newer.as_bytes()),
        Err(MarkupError::Missing { .. })
    ));
}
