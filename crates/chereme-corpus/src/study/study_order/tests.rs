use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;

use super::*;
use crate::study::study_plan::tests::plan_of;

fn item(plan: &StudyPlan, trial: usize) -> &str {
    &plan.trials[trial].item
}

proptest! {
    #[test]
    fn in_a_square_each_condition_follows_each_other_equally_often(k in 1_usize..12) {
        let rows = williams_square(k);
        prop_assert_eq!(rows.len(), if k % 2 == 0 || k == 1 { k } else { 2 * k });
        let mut follows: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for row in &rows {
            let all: BTreeSet<usize> = row.iter().copied().collect();
            prop_assert_eq!(all, (0..k).collect());
            for pair in row.windows(2) {
                *follows.entry((pair[0], pair[1])).or_default() += 1;
            }
        }
        prop_assert_eq!(follows.len(), k * (k - 1));
        let often = if k % 2 == 0 { 1 } else { 2 };
        prop_assert!(follows.values().all(|times| *times == often));
        for column in 0..k {
            let mut times = vec![0; k];
            rows.iter().for_each(|row| times[row[column]] += 1);
            prop_assert!(times.iter().all(|it| *it == rows.len() / k));
        }
    }

    #[test]
    fn rows_show_every_trial_with_versions_apart(
        items in 1_usize..9, conditions in 1_usize..5, blocks in 1_u32..3, seed in any::<u64>(),
        between in any::<bool>(), random in any::<bool>(), missing in 0_usize..6,
    ) {
        let mut trials: Vec<(String, String)> = Vec::new();
        for item in 0..items {
            for condition in 0..conditions {
                trials.push((format!("i{item}"), format!("c{condition}")));
            }
        }
        trials.truncate((trials.len() - missing.min(trials.len() - 1)).max(1));
        let mut plan = plan_of(&trials);
        plan.design.seed = seed;
        plan.design.blocks = blocks;
        plan.design.between = between;
        plan.design.order = if random { ConditionOrder::Random } else { ConditionOrder::Latin };
        let all = trial_order_rows(&plan);
        prop_assert!(all.len() >= LEAST_ROWS && all.len() <= MAX_ORDER_ROWS);
        prop_assert_eq!(&all, &trial_order_rows(&plan));
        for row in &all {
            for block in 1..=blocks {
                let shown: Vec<usize> = row.iter().filter(|it| it.block == block).map(|it| it.trial).collect();
                let once: BTreeSet<usize> = shown.iter().copied().collect();
                prop_assert_eq!(once.len(), shown.len());
                if between {
                    let items: BTreeSet<&str> = shown.iter().map(|it| item(&plan, *it)).collect();
                    prop_assert_eq!(items.len(), shown.len());
                    prop_assert_eq!(items.len(), plan.main_items().len());
                } else {
                    prop_assert_eq!(shown.len(), plan.trials.len());
                }
            }
            let names: Vec<&str> = row.iter().map(|it| item(&plan, it.trial)).collect();
            let whole = trials.len() == items * conditions;
            if items >= 2 && whole {
                prop_assert!(names.windows(2).all(|it| it[0] != it[1]), "{:?}", names);
            }
            if items >= 3 && whole && !random {
                prop_assert!(names.windows(3).all(|it| it[0] != it[2]), "{:?}", names);
            }
        }
    }
}

#[test]
fn over_all_rows_each_version_of_an_item_follows_each_other_equally_often() {
    for conditions in [2, 3, 4] {
        let names: Vec<(String, String)> = (0..5)
            .flat_map(|item| (0..conditions).map(move |it| (format!("i{item}"), format!("c{it}"))))
            .collect();
        let plan = plan_of(&names);
        let all = trial_order_rows(&plan);
        for name in plan.main_items() {
            let mut follows: BTreeMap<(usize, usize), usize> = BTreeMap::new();
            for row in &all {
                let own: Vec<usize> = row
                    .iter()
                    .map(|it| it.trial)
                    .filter(|it| item(&plan, *it) == name)
                    .collect();
                for pair in own.windows(2) {
                    *follows.entry((pair[0], pair[1])).or_default() += 1;
                }
            }
            let times: BTreeSet<usize> = follows.values().copied().collect();
            assert_eq!((follows.len(), times.len()), (conditions * (conditions - 1), 1));
        }
    }
}

#[test]
fn the_largest_plan_is_put_in_order() {
    for order in [ConditionOrder::Latin, ConditionOrder::Random] {
        let names: Vec<(String, String)> = (0..500).map(|at| (format!("i{}", at % 2), format!("c{at}"))).collect();
        let mut plan = plan_of(&names);
        plan.design.order = order;
        plan.design.blocks = 2;
        let all = trial_order_rows(&plan);
        assert_eq!(
            (all.len(), all[0].len()),
            (if order == ConditionOrder::Latin { 96 } else { 48 }, 1000)
        );
    }
}

#[test]
fn training_comes_first_parts_follow_each_other_and_checks_are_spread() {
    let names: Vec<(String, String)> = (0..30).map(|item| (format!("i{item}"), "made".to_owned())).collect();
    let mut plan = plan_of(&names);
    plan.trials[0].role = TrialRole::Training;
    plan.trials[1].role = TrialRole::Check;
    plan.trials[2].role = TrialRole::Check;
    for trial in &mut plan.trials[20..] {
        trial.part = "second".to_owned();
    }
    for row in trial_order_rows(&plan) {
        assert_eq!(row[0], ShownTrial { trial: 0, block: 0 });
        assert_eq!(row.len(), 30);
        let second = row.iter().position(|it| it.trial >= 20).expect("shown");
        assert_eq!(second, 20);
        assert!(row[second..].iter().all(|it| it.trial >= 20));
        let checks: Vec<usize> = (0..20).filter(|at| [1, 2].contains(&row[*at].trial)).collect();
        assert!(checks.len() == 2 && checks[0] < 11 && checks[1] > 9, "{checks:?}");
    }
}
