//! Tests of the sentences of the history about changes of annotations.

use super::*;

#[test]
fn the_history_names_what_was_done() {
    let (_folder, mut corpus) = corpus();
    let said = "add G 0-100 A; add G 100-200 B; add G 200-300 C; add C 0-50 V";
    annotate(&mut corpus, said).expect(said);
    for (changes, want) in [
        ("set 1 = HOUSE; set 2 = HOUSE", "2 glosses changed to HOUSE in Take 1"),
        ("set 1 = A; set 2 = B", "2 annotations say something else in Take 1"),
        ("set 4 = U", "1 handshape changed to U in Take 1"),
        ("set 3 200-290", "1 annotation moved in Take 1"),
        ("merge 1 2 = A", "2 annotations merged in Take 1"),
        ("split 1 50", "1 annotation split in Take 1"),
        ("remove 3", "1 removed in Take 1"),
    ] {
        annotate(&mut corpus, changes).expect(changes);
        assert_eq!(corpus.operation_log(1).expect("log")[0].summary, want, "{changes}");
    }
}

#[test]
fn annotations_below_a_moved_one_follow_it_and_removed_ones_are_counted() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 0-400 A; add I 10-60 a; add I 300-380 b").expect("added");
    let before = shown(&corpus);
    for (change, want, below) in [
        ("set 1 0-100", "1 annotation moved, 1 removed in Take 1", "a"),
        ("set 1 1000-1390", "1 annotation moved in Take 1", "a b"),
        ("set 1 1000-1100", "1 annotation moved, 1 removed in Take 1", "a"),
    ] {
        annotate(&mut corpus, change).expect(change);
        assert_eq!(corpus.operation_log(1).expect("log")[0].summary, want, "{change}");
        let left = ["a", "b"].into_iter().filter(|value| {
            let said = format!(" {value}");
            shown(&corpus).split("; ").any(|row| row.ends_with(&said))
        });
        assert_eq!(left.collect::<Vec<_>>().join(" "), below, "{:?}", shown(&corpus));
        corpus.undo_operation().expect("undone");
        assert_eq!(shown(&corpus), before);
    }
}
