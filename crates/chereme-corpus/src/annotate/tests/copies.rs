//! Tests of copying and reordering tiers.

use super::*;

fn named(name: &str) -> TierRequestName {
    TierRequestName::parse_tier_name(name, Some(&RowName::Number(1))).expect("a name")
}

fn tiers(corpus: &Corpus) -> Vec<TierRow> {
    tier_rows::load_tier_rows(corpus.store.read_connection(), 1).expect("read")
}

fn names(corpus: &Corpus) -> Vec<String> {
    tiers(corpus).into_iter().map(|tier| tier.name).collect()
}

/// Returns the annotations of a tier as `(start, value)`.
fn said(corpus: &Corpus, name: &str) -> Vec<(i64, String)> {
    let id = tiers(corpus).into_iter().find(|it| it.name == name).expect("a tier").id;
    let rows = tier_rows::load_tier_annotation_rows(corpus.store.read_connection(), id).expect("read");
    rows.into_iter().map(|it| (it.start_us, it.value)).collect()
}

#[test]
fn a_copy_holds_the_requested_parts_below_the_same_parent() {
    let (_folder, mut corpus) = corpus();
    let three = "add G 0-1000 MAISON; add G 2000-3000 école; add G 4000-5000 ÉCOLE-2";
    annotate(&mut corpus, three).expect("added");
    let before = names(&corpus);
    for (number, (copied, want)) in [
        (CopiedAnnotations::All, vec!["MAISON", "école", "ÉCOLE-2"]),
        (CopiedAnnotations::Times, vec!["", "", ""]),
        (CopiedAnnotations::Nothing, vec![]),
        (CopiedAnnotations::Holding("Ecole".into()), vec!["école", "ÉCOLE-2"]),
    ]
    .into_iter()
    .enumerate()
    {
        let name = format!("copy {number}");
        let row = corpus.copy_tier(&named("G"), &name, &copied).expect("copied");
        assert_eq!(row.role, crate::TierRole::Gloss);
        let values: Vec<String> = said(&corpus, &name).into_iter().map(|it| it.1).collect();
        assert_eq!(values, want, "{copied:?}");
        let now = names(&corpus);
        let at = |name: &str| now.iter().position(|it| it == name);
        assert_eq!(at(&name), at("G").map(|it| it + 1));
    }
    let taken = corpus.copy_tier(&named("G"), "H", &CopiedAnnotations::All);
    assert!(matches!(taken, Err(CorpusError::Wrong { .. })));
    for _ in 0..4 {
        corpus.undo_operation().expect("undone");
    }
    assert_eq!(names(&corpus), before);
}

#[test]
fn a_tier_without_gaps_keeps_none_when_it_is_filtered() {
    let (_folder, mut corpus) = corpus();
    let changes = "add G 0-1000 MAISON; add T 0-1000 a; add T 500-1000 b";
    annotate(&mut corpus, changes).expect("added");
    let copied = CopiedAnnotations::Holding("b".into());
    corpus.copy_tier(&named("T"), "T2", &copied).expect("copied");
    let want = [(0, String::new()), (500_000, "b".to_owned())];
    assert_eq!(said(&corpus, "T2"), want);
}

#[test]
fn tiers_stand_in_the_requested_order() {
    let (_folder, mut corpus) = corpus();
    let before = names(&corpus);
    let mut order: Vec<i64> = tiers(&corpus).iter().map(|it| it.id).collect();
    order.reverse();
    let last = order.pop().expect("tiers");
    corpus.order_tiers(&RowName::Number(1), &order).expect("ordered");
    let mut want = before.clone();
    want.reverse();
    assert_eq!(names(&corpus), want);
    for wrong in [vec![last, last], vec![99_999]] {
        assert!(corpus.order_tiers(&RowName::Number(1), &wrong).is_err());
    }
    corpus.undo_operation().expect("undone");
    assert_eq!(names(&corpus), before);
}
