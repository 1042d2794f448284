//! Proposals of non-manuals find what a generator put into noisy curves, and little else.

#[path = "../examples/faces/proposals.rs"]
mod proposals;

#[test]
fn proposals_find_the_inserted_values_and_little_else() {
    let all = proposals::counted(30);
    let found: Vec<String> = all.keys().map(|(part, value)| format!("{part}.{value}")).collect();
    assert_eq!(
        found,
        [
            "brows.furrowed",
            "brows.raised",
            "brows.raised-left",
            "brows.raised-right",
            "gaze.down",
            "gaze.left",
            "gaze.right",
            "gaze.up",
            "head.nodding",
            "head.shaking",
            "lids.blink",
            "lids.closed",
            "mouth.open",
        ]
    );
    for ((part, value), count) in all {
        let (precision, recall) = (count.precision(), count.recall());
        eprintln!("{part}.{value}: {count:?}, precision {precision:.3}, recall {recall:.3}");
        assert!(count.there > 20, "{part}.{value}: {count:?}");
        assert!(precision >= 0.9, "{part}.{value}: {count:?}");
        assert!(recall >= 0.9, "{part}.{value}: {count:?}");
    }
}
