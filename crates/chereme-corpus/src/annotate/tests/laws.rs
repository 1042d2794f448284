//! Laws under random changes: the rules hold, tokens are up to date, and each change can be undone.

use chereme_sign::tier::{TierSet, check_tier_set};
use proptest::prelude::*;
use rusqlite::Connection;

use super::super::scope;
use super::{annotate, corpus, rows, strings};
use crate::Corpus;
use crate::db::stored_tiers as tier_rows;
use crate::error::{CorpusError, CorpusResult};
use crate::tokens;

/// Generates one change that may or may not be legal.
fn wish() -> impl Strategy<Value = String> {
    let id = 1u32..14;
    let tier = prop::sample::select(vec!["G", "G", "H", "C", "C", "L", "T", "I"]);
    let times = (0u32..20, 1u32..7).prop_map(|(start, length)| format!("{}-{}", start * 10, (start + length) * 10));
    let value = prop::sample::select(vec!["U", "H", "unset"]);
    prop_oneof![
        6 => (tier, times.clone(), value.clone()).prop_map(|(tier, times, value)| format!("add {tier} {times} {value}")),
        1 => (prop::sample::select(vec!["S", "A"]), id.clone(), value.clone()).prop_map(|(tier, id, value)| format!("below {tier} {id} {value}")),
        3 => (id.clone(), times).prop_map(|(id, times)| format!("set {id} {times}")),
        1 => (id.clone(), value.clone()).prop_map(|(id, value)| format!("set {id} = {value}")),
        2 => (id.clone(), 0u32..200).prop_map(|(id, at)| format!("split {id} {at}")),
        1 => (id.clone(), id.clone(), value).prop_map(|(a, b, value)| format!("merge {a} {b} = {value}")),
        1 => id.prop_map(|id| format!("remove {id}")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 30, failure_persistence: None, ..ProptestConfig::with_cases(4) })]

    #[test]
    fn any_changes_keep_the_rules_and_can_be_undone_and_done_again(wishes in prop::collection::vec(wish(), 30)) {
        let (_folder, mut corpus) = corpus();
        let mut states = vec![rows(corpus.store.read_connection())];
        for wish in &wishes {
            let before = corpus.operation_log(1).expect("log")[0].id;
            let done = annotate(&mut corpus, wish).is_ok();
            let now = rows(corpus.store.read_connection());
            if !done {
                prop_assert!(&now == states.last().expect("a state"), "{} failed and changed rows", wish);
            }
            if corpus.operation_log(1).expect("log")[0].id != before {
                states.push(now);
            }
            check_rules(&corpus);
            check_tokens(&mut corpus, wish);
        }
        for state in states.iter().rev().skip(1) {
            corpus.undo_operation().expect("undone");
            prop_assert!(&rows(corpus.store.read_connection()) == state, "other rows than before");
        }
        for state in states.iter().skip(1) {
            corpus.redo_operation().expect("done again");
            prop_assert!(&rows(corpus.store.read_connection()) == state, "other rows than before");
        }
        check_tokens(&mut corpus, "redo");
    }
}

fn check_rules(corpus: &Corpus) {
    let connection = corpus.store.read_connection();
    let tiers = tier_rows::load_tier_rows(connection, 1).expect("tiers");
    let annotations: Vec<_> = tiers
        .iter()
        .flat_map(|tier| tier_rows::load_tier_annotation_rows(connection, tier.id).expect("annotations"))
        .map(|row| scope::rule_annotation_from_row(&row))
        .collect();
    let found = check_tier_set(&TierSet::new(tiers.iter().map(scope::sign_tier), annotations));
    assert!(found.is_empty(), "{found:?}");
}

/// Checks that tokens near a change equal those derived again from everything, and that search finds the same number.
fn check_tokens(corpus: &mut Corpus, change: &str) {
    let near = token_rows(corpus.store.read_connection());
    let again: CorpusResult<()> = corpus.store.named_operation("derive", |connection| {
        tokens::update_recording_tokens(connection, 1, None, &crate::inventories::load_of(connection, 1)?)?;
        assert_eq!(token_rows(connection), near, "after {change}");
        Err(CorpusError::Stopped)
    });
    assert!(matches!(again, Err(CorpusError::Stopped)));
    let (_, index) = corpus.store.searchable_connection().expect("index");
    let tokens = near.iter().filter(|row| row.starts_with("token")).count();
    assert_eq!(index.indexed_document_count(), tokens as u64);
}

/// Returns the rows of tokens and their values, as one text each.
fn token_rows(connection: &Connection) -> Vec<String> {
    let sql = "SELECT concat_ws(' ', 'token', t.id, s.gloss, t.annotation_id, t.start_us, t.end_us, t.hand)
                   FROM token t JOIN sign s ON s.id = t.sign_id
               UNION ALL SELECT concat_ws(' ', 'value', token_id, phase, position, hand, component, state,
                   value, inventory_id, annotation_id) FROM token_value ORDER BY 1";
    strings(connection, sql)
}
