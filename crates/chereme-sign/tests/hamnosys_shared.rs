//! Transcriptions by other people, if they are stored next to the repository.

use chereme_sign::hamnosys::{HamnosysSymbol, parse_hamnosys, parse_lenient};

#[test]
fn transcriptions_of_others_read_and_print_as_they_were() {
    let Ok(data) = std::env::var("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let mut texts = std::collections::BTreeSet::new();
    for file in [
        "lingpy-pysign/test-signs.tsv",
        "hearai-parse-hamnosys/hamnosys_example.txt",
        "hearai-parse-hamnosys/test_source.txt",
    ] {
        let path = std::path::Path::new(&data).join("notation/hamnosys").join(file);
        let text = std::fs::read_to_string(path).expect("a readable file");
        let symbol = |c: char| HamnosysSymbol::from_char(c).is_some() && !matches!(c, '!' | '+');
        texts.extend(
            text.split(|c| !symbol(c))
                .map(|run| run.trim_matches(' ').to_owned())
                .filter(|run| run.chars().filter(|c| !c.is_ascii()).count() > 3),
        );
    }
    let (mut refused, mut canonical) = (0, 0);
    for text in &texts {
        match parse_hamnosys(text) {
            Ok(read) => {
                assert_eq!(read.transcription_text(), *text);
                canonical += usize::from(!format!("{:?}", read.sign).contains("WrittenSymbols(Some("));
            }
            Err(_) => {
                refused += 1;
                assert_eq!(parse_lenient(text).transcription_text(), *text);
            }
        }
    }
    eprintln!(
        "{} of {} accepted, {canonical} as the printer writes them",
        texts.len() - refused,
        texts.len()
    );
    assert!(refused * 50 <= texts.len(), "{refused} of {} refused", texts.len());
}
