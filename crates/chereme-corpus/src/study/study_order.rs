//! The order in which participants see the trials: one row per participant, all of them computed when the study is built.

use chereme_analysis::random::RandomNumbers;

use super::study_plan::{ConditionOrder, StudyPlan, TrialRole};

/// How many trials lie between two versions of an item if there is room: versions are at least this far apart.
const MIN_VERSION_DISTANCE: usize = 3;
/// How many shuffles are tried for an order without versions close to each other: fewer for many trials.
const SHUFFLE_TRIES: std::ops::RangeInclusive<usize> = 8..=200;
/// The number of trials that all shuffles of one group draw together, about.
const SHUFFLED_TRIAL_BUDGET: usize = 5000;
/// The least number of rows, so that participants with the same row are few.
const LEAST_ROWS: usize = 48;
/// The largest number of rows.
const MAX_ORDER_ROWS: usize = 96;

/// A trial at its place in a participant's order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct ShownTrial {
    /// The position of the trial in the plan.
    pub trial: usize,
    /// The block, from 1; 0 for training.
    pub block: u32,
}

/// Returns a balanced Latin square of `k` conditions: each condition stands once in each row and equally often in each
/// column, and each follows each other one equally often. There are `k` rows if `k` is even, `2 k` if it is odd.
///
/// Source: E. J. Williams, "Experimental designs balanced for the estimation of residual effects of treatments",
/// *Australian Journal of Scientific Research* A 2, 1949.
#[must_use]
pub fn williams_square(k: usize) -> Vec<Vec<usize>> {
    if k == 0 {
        return Vec::new();
    }
    // 0, 1, k-1, 2, k-2, …: neighbouring differences are all different.
    let first: Vec<usize> = (0..k)
        .map(|at| if at % 2 == 1 { at.div_ceil(2) } else { (k - at / 2) % k })
        .collect();
    let row = |shift: usize| first.iter().map(|version| (version + shift) % k).collect::<Vec<_>>();
    let mut rows: Vec<Vec<usize>> = (0..k).map(row).collect();
    if k % 2 == 1 && k > 1 {
        let mirrored: Vec<Vec<usize>> = rows.iter().map(|row| row.iter().rev().copied().collect()).collect();
        rows.extend(mirrored);
    }
    rows
}

/// Returns the orders of a plan's trials; participant number `n`, from 0, sees row `n` modulo their number. Every main
/// trial that the participant sees is shown once in each block of the design. Parts follow each other, and the training
/// of a part precedes it.
#[must_use]
pub fn trial_order_rows(plan: &StudyPlan) -> Vec<Vec<ShownTrial>> {
    let parts: Vec<PartTrials> = plan
        .plan_parts()
        .into_iter()
        .map(|part| PartTrials::trials_of_part(plan, part))
        .collect();
    let cycle = parts.iter().map(|part| part.cycle(plan)).fold(1, least_multiple);
    let count = if cycle > MAX_ORDER_ROWS {
        MAX_ORDER_ROWS
    } else {
        cycle * LEAST_ROWS.div_ceil(cycle)
    };
    (0..count)
        .map(|row| {
            // Neighbouring seeds give generators whose first numbers are unrelated: SplitMix64 mixes them.
            let mut random = RandomNumbers::new(plan.design.seed.wrapping_mul(1_000_003).wrapping_add(row as u64));
            parts
                .iter()
                .flat_map(|part| part.order_part_row(plan, row, &mut random))
                .collect()
        })
        .collect()
}

/// The trials of one part of a study, as positions in the plan.
struct PartTrials {
    training: Vec<usize>,
    checks: Vec<usize>,
    /// The versions of each item.
    items: Vec<Vec<usize>>,
    /// The item of each trial of the plan, as a position in `items`; that of other parts has no meaning.
    item_of: Vec<usize>,
}

impl PartTrials {
    fn trials_of_part(plan: &StudyPlan, part: &str) -> Self {
        let mut it = Self {
            training: Vec::new(),
            checks: Vec::new(),
            items: Vec::new(),
            item_of: vec![0; plan.trials.len()],
        };
        let mut names: Vec<&str> = Vec::new();
        for (at, trial) in plan.trials.iter().enumerate().filter(|(_, trial)| trial.part == part) {
            match trial.role {
                TrialRole::Training => it.training.push(at),
                TrialRole::Check => it.checks.push(at),
                TrialRole::Main => match names.iter().position(|name| *name == trial.item) {
                    Some(item) => {
                        it.items[item].push(at);
                        it.item_of[at] = item;
                    }
                    None => {
                        it.item_of[at] = names.len();
                        names.push(&trial.item);
                        it.items.push(vec![at]);
                    }
                },
            }
        }
        it
    }

    /// Returns after how many rows the conditions of each item have been in every order of the square.
    fn cycle(&self, plan: &StudyPlan) -> usize {
        let of = |versions: &Vec<usize>| match (plan.design.between, plan.design.order) {
            (true, _) => versions.len(),
            (_, ConditionOrder::Latin) => williams_square(versions.len()).len(),
            (_, ConditionOrder::Random) => 1,
        };
        self.items.iter().map(of).fold(1, least_multiple)
    }

    fn order_part_row(&self, plan: &StudyPlan, row: usize, random: &mut RandomNumbers) -> Vec<ShownTrial> {
        let mut shown: Vec<ShownTrial> = self
            .training
            .iter()
            .map(|&trial| ShownTrial { trial, block: 0 })
            .collect();
        let mut main: Vec<ShownTrial> = Vec::new();
        for block in 1..=plan.design.blocks {
            let groups = if plan.design.between {
                let one = |(item, versions): (usize, &Vec<usize>)| versions[(row + item) % versions.len()];
                vec![self.items.iter().enumerate().map(one).collect()]
            } else {
                match plan.design.order {
                    ConditionOrder::Latin => self.latin(row + block as usize - 1),
                    ConditionOrder::Random => vec![self.items.concat()],
                }
            };
            for group in groups {
                let late = &main[main.len().saturating_sub(MIN_VERSION_DISTANCE - 1)..];
                let before: Vec<usize> = late.iter().map(|shown| self.item_of[shown.trial]).collect();
                let order = self.space_versions_apart(&before, &group, random);
                main.extend(order.into_iter().map(|trial| ShownTrial { trial, block }));
            }
        }
        self.put_checks(&mut main, random);
        shown.extend(main);
        shown
    }

    /// Returns the versions of items in groups that follow each other; each group has at most one version of an item.
    /// The versions of an item are in the order of a row of its square, and each item takes another row.
    fn latin(&self, row: usize) -> Vec<Vec<usize>> {
        let most = self.items.iter().map(Vec::len).max().unwrap_or(0);
        let mut groups = vec![Vec::new(); most];
        for (at, versions) in self.items.iter().enumerate() {
            let square = williams_square(versions.len());
            let order = &square[(row + at) % square.len()];
            for (turn, &version) in order.iter().enumerate() {
                // An item with fewer versions than groups skips some, and other ones in the next row.
                let turned_group = (turn * most / versions.len() + row + at) % most;
                let group = if versions.len() == most { turn } else { turned_group };
                groups[group].push(versions[version]);
            }
        }
        groups
    }

    /// Inserts the check trials, spread evenly with some chance.
    fn put_checks(&self, main: &mut Vec<ShownTrial>, random: &mut RandomNumbers) {
        let length = main.len();
        for (done, &trial) in self.checks.iter().enumerate() {
            let stretch = (length / self.checks.len()).max(1);
            let check_place = done + stretch * done + random.random_below(stretch) + 1;
            let index = check_place.min(main.len());
            let block = main.get(index.saturating_sub(1)).map_or(1, |shown| shown.block);
            main.insert(index, ShownTrial { trial, block });
        }
    }

    /// Returns the trials of `group` in random order, with versions of an item [`MIN_VERSION_DISTANCE`] from each other and from the
    /// items `before` if that is possible; otherwise the best order that was found.
    fn space_versions_apart(&self, before: &[usize], group: &[usize], random: &mut RandomNumbers) -> Vec<usize> {
        let mut best: Option<(usize, Vec<usize>)> = None;
        let tries = SHUFFLED_TRIAL_BUDGET / group.len().max(1);
        for _ in 0..tries.clamp(*SHUFFLE_TRIES.start(), *SHUFFLE_TRIES.end()) {
            let order = self.draw_spaced_trials(before, group, random);
            let cost = self.closeness(before, &order);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, order));
            }
            if cost == 0 {
                break;
            }
        }
        best.map_or_else(Vec::new, |(_, order)| order)
    }

    /// Returns the trials one after another, each drawn from those whose item was not seen of late; an item with many
    /// versions left goes first if the others could no longer keep its versions apart.
    fn draw_spaced_trials(&self, before: &[usize], group: &[usize], random: &mut RandomNumbers) -> Vec<usize> {
        let mut left = group.to_vec();
        let mut versions = vec![0_usize; self.items.len()];
        group.iter().for_each(|&trial| versions[self.item_of[trial]] += 1);
        let mut seen = before.to_vec();
        let mut order = Vec::with_capacity(left.len());
        while !left.is_empty() {
            let late = &seen[seen.len().saturating_sub(MIN_VERSION_DISTANCE - 1)..];
            let item = |at: usize| self.item_of[left[at]];
            let among =
                |shut: &[usize]| -> Vec<usize> { (0..left.len()).filter(|&at| !shut.contains(&item(at))).collect() };
            let mut free = among(late);
            if free.is_empty() {
                free = among(&late[late.len().saturating_sub(1)..]);
            }
            if free.is_empty() {
                free = among(&[]);
            }
            let most = free.iter().map(|&at| versions[item(at)]).max().unwrap_or(0);
            if most > 1 && (most - 1) * MIN_VERSION_DISTANCE + 1 >= left.len() {
                free.retain(|&at| versions[item(at)] == most);
            }
            let trial = left.remove(free[random.random_below(free.len())]);
            seen.push(self.item_of[trial]);
            versions[self.item_of[trial]] -= 1;
            order.push(trial);
        }
        order
    }

    /// Returns how many versions of an item are too close to each other; twice in a row counts hundredfold.
    fn closeness(&self, before: &[usize], order: &[usize]) -> usize {
        let items = order.iter().map(|&trial| self.item_of[trial]);
        let all: Vec<usize> = before.iter().copied().chain(items).collect();
        let mut cost = 0;
        for at in 0..all.len() {
            for far in 1..MIN_VERSION_DISTANCE.min(all.len() - at) {
                if all[at] == all[at + far] {
                    cost += if far == 1 { 100 } else { 1 };
                }
            }
        }
        cost
    }
}

fn least_multiple(a: usize, b: usize) -> usize {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    (a / x.max(1)).saturating_mul(b).clamp(1, 10_000)
}

#[cfg(test)]
mod tests;
