//! Annotation files of ANVIL, EXMARaLDA and SignStream.

use super::*;
use crate::address::{CorpusAddress, RowName};

fn anvil(elements: &str) -> String {
    format!(
        "<annotation><head><video src=\"take.mov\"/><info key=\"coder\">Zoé</info></head><body>\
         <track name=\"Signs.Right\" type=\"primary\">{elements}</track>\
         <track name=\"Brows\" type=\"primarypoint\"><el index=\"0\" time=\"0.1\"><attribute name=\"type\">raised</attribute></el></track>\
         </body></annotation>"
    )
}

fn element(index: u8, start: &str, end: &str, gloss: &str, hand: &str) -> String {
    format!(
        "<el index=\"{index}\" start=\"{start}\" end=\"{end}\"><attribute name=\"token\">{gloss}</attribute>\
         <attribute name=\"handshape\">{hand}</attribute></el>"
    )
}

const EXB: &str = "<basic-transcription><basic-body><common-timeline><tli id=\"a\" time=\"0.01\"/>\
    <tli id=\"b\" time=\"0.15\"/></common-timeline><tier id=\"t\" category=\"gloss\" type=\"t\">\
    <event start=\"a\" end=\"b\">CHAT</event></tier></basic-body></basic-transcription>";

const XRA: &str = "<Document><Tier id=\"t\" tiername=\"gloss\"><Annotation><Location><Interval><Begin midpoint=\"0.01\"/>\
    <End midpoint=\"0.15\"/></Interval></Location><Label><Tag>CHAT</Tag></Label></Annotation></Tier></Document>";

const COLLECTION: &str = "<SIGNSTREAM-DATABASE><CODING-SCHEME><FIELD ID=\"1\" NAME=\"main gloss\"/></CODING-SCHEME><UTTERANCES>\
    <UTTERANCE ID=\"1\" S=\"10\" E=\"150\"><SEGMENT PARTICIPANT-ID=\"0\"><TRACK FID=\"1\"><A S=\"0\" E=\"140\">CHAT</A></TRACK>\
    </SEGMENT></UTTERANCE></UTTERANCES></SIGNSTREAM-DATABASE>";

fn hits(corpus: &mut Corpus, query: &str) -> u64 {
    let found = corpus.search_tokens(query, &SearchOptions::default());
    found.expect("an answer").total as u64
}

#[test]
fn signs_of_other_programs_are_found_with_their_movement() {
    let first = element(0, "0.0100001", "0.15", "CHAT", "5");
    for (name, text, tiers) in [
        ("take.anvil", anvil(&first), 4),
        ("take.exb", EXB.to_owned(), 1),
        ("take.xra", XRA.to_owned(), 1),
        ("take.xml", COLLECTION.to_owned(), 2),
    ] {
        let desk = Desk::new();
        let mut corpus = desk.corpus("a.chereme");
        import(&mut corpus, &desk.file("take.bvh", MOVEMENT), "{}");
        let report = import(&mut corpus, &desk.file(name, &text), "{}");
        assert_eq!(report.status, FileStatus::Imported, "{name}: {:?}", report.findings);
        assert_eq!(recordings_of(&corpus), [1], "{name}");
        assert_eq!(roles(&corpus).len(), tiers, "{name}: {:?}", roles(&corpus));
        assert_eq!(hits(&mut corpus, "gloss:CHAT"), 1, "{name}");
        assert_whole(&mut corpus);
        let again = import(&mut corpus, &desk.file(name, &text), "{}");
        assert_eq!(again.status, FileStatus::Unchanged, "{name}: {:?}", again.findings);
    }
}

#[test]
fn an_edited_anvil_file_updates_its_recording() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("a.chereme");
    import(&mut corpus, &desk.file("take.bvh", MOVEMENT), "{}");
    let old = element(0, "0.05", "0.1", "CHAT", "5");
    import(&mut corpus, &desk.file("take.anvil", &anvil(&old)), "{}");
    assert_eq!(hits(&mut corpus, "right.configuration=5"), 1);
    // Another element comes before it, and its own end and handshape change.
    let new = element(0, "0", "0.05", "CHIEN", "B") + &element(1, "0.05", "0.12", "CHAT", "S");
    let report = import(&mut corpus, &desk.file("take.anvil", &anvil(&new)), "{}");
    assert_eq!(report.status, FileStatus::Updated, "{:?}", report.findings);
    for (query, expected) in [
        ("gloss=CHAT right.configuration=S", 1),
        ("gloss=CHIEN right.configuration=B", 1),
        ("right.configuration=5", 0),
    ] {
        assert_eq!(hits(&mut corpus, query), expected, "{query}");
    }
    assert_whole(&mut corpus);
    let folder = desk.folder.path();
    for name in ["out.eaf", "out.TextGrid"] {
        let what = ExportWhat::Address(CorpusAddress::Recording(RowName::Number(1)));
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let options = ExportOptions::default();
        let written = corpus.export_corpus(&what, &folder.join(name), &options, progress);
        written.expect("exported");
        let bytes = fs::read(folder.join(name)).expect("a file");
        let read = readers::find_transcript_parser(Path::new(name)).expect("a reader");
        let (transcript, _) = read(&bytes).expect("a document");
        if name == "out.eaf" {
            let coder = ("coder".to_owned(), "Zoé".to_owned());
            assert!(transcript.properties.contains(&coder), "{:?}", transcript.properties);
            assert_eq!(transcript.media[0].url, "take.mov");
        }
        let tier = transcript.tiers.iter().find(|it| it.name == "Signs.Right.token");
        let mut values: Vec<(i64, i64, &str)> = tier
            .expect("the tier")
            .annotations
            .iter()
            .map(|it| {
                (
                    it.span.span_start_instant().instant_micros(),
                    it.span.span_end_instant().instant_micros(),
                    it.value.as_str(),
                )
            })
            .collect();
        values.sort_unstable();
        assert_eq!(values, [(0, 50_000, "CHIEN"), (50_000, 120_000, "CHAT")], "{name}");
    }
}
