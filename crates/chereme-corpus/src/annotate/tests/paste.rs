//! Tests of pasted annotations.

use super::*;
use crate::annotate::annotate_paste::PasteOptions;

fn paste(corpus: &mut Corpus, text: &str, options: &PasteOptions) -> CorpusResult<(u64, Vec<String>)> {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let name = RowName::Text(RECORDING.into());
    let (report, odd) = corpus.paste_annotations(&name, text, "copied.tsv", options, progress)?;
    let odd = odd.iter().map(|it| format!("{}: {}", it.line, it.odd_line_fault()));
    Ok((report.added, odd.collect()))
}

const COPIED: &str = "tier\tstart\tend\tvalue\nG\t0.000\t0.100\tBOL\nG\t0.200\t0.300\tCHAT\n";

#[test]
fn pasted_annotations_keep_their_times_or_their_distances() {
    let (_folder, mut corpus) = corpus();
    let steps = corpus.count_undo_steps().expect("steps").0;
    let (added, odd) = paste(&mut corpus, COPIED, &PasteOptions::default()).expect("pasted");
    assert_eq!((added, odd), (2, vec![]));
    let at_frame = PasteOptions {
        tier: Some(TierRequestName::parse_tier_name("H", Some(&RowName::Text(RECORDING.into()))).expect("a tier")),
        at: Some(TableMoment::Frame(50)),
        ..PasteOptions::default()
    };
    paste(&mut corpus, COPIED, &at_frame).expect("pasted");
    let frames = "A tier\tf90\tf95\tMAISON";
    let refused = paste(&mut corpus, frames, &PasteOptions::default()).expect_err("no such tier");
    assert!(refused.to_string().contains("has no tier \"A tier\""), "{refused}");
    assert_eq!(corpus.count_undo_steps().expect("steps").0, steps + 2);
    let all = shown(&corpus);
    for span in ["0-100 BOL", "200-300 CHAT", "500-600 BOL", "700-800 CHAT"] {
        assert!(all.contains(span), "{all}");
    }
}

#[test]
fn lines_without_a_place_are_refused_or_left_out() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 0-100 MAISON").expect("added");
    let before = shown(&corpus);
    let text = format!("{COPIED}G\t2.000\t1.000\tLOUP\nC\t0.000\t0.100\tno-such-shape\n");
    let Err(CorpusError::Several { errors, .. }) = paste(&mut corpus, &text, &PasteOptions::default()) else {
        panic!("some lines have no place");
    };
    let places: Vec<_> = errors.iter().filter_map(CorpusError::error_place).collect();
    assert_eq!(
        places,
        ["copied.tsv, line 2", "copied.tsv, line 4", "copied.tsv, line 5"]
    );
    assert_eq!(shown(&corpus), before);
    let partly = PasteOptions {
        partly: true,
        ..PasteOptions::default()
    };
    let (added, odd) = paste(&mut corpus, &text, &partly).expect("pasted");
    assert_eq!(added, 1);
    assert_eq!(
        odd,
        [
            "2: there is an annotation already at 0.000s",
            "4: it ends at 1.000, which is not after its start",
            "5: \"no-such-shape\" is no value of its tier",
        ]
    );
    let values = paste(&mut corpus, "BOL\nCHAT\n", &partly).expect_err("no times");
    assert!(values.error_remedy().is_some(), "{values}");
}
