//! Neighbours in a table of values: how many rows differ from each row in so many fields.

use std::collections::HashMap;

use super::UndefinedStatistic;

/// The most lookups, rows times subsets of fields, that a count may take.
const MAX_NEIGHBOUR_LOOKUPS: usize = 400_000_000;

/// The number of other rows around one row.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RowNeighbours {
    /// The number of rows that differ in no field, in one, in two and so on.
    pub by_distance: Vec<u64>,
    /// For each field the number of rows that differ in it alone.
    pub by_field: Vec<u64>,
}

/// Counts for each row the other rows that differ from it in at most `most` fields.
///
/// Rows are not compared with each other: for every subset of at most `most` fields, the rows that are equal in all others
/// are counted by a hash. A row that differs in d fields is counted once for each subset of j fields that contains these,
/// `C(fields - d, j - d)` times, from which the counts by distance follow one after another.
///
/// # Errors
/// [`UndefinedStatistic::TooMany`] if there are too many subsets for so many rows; [`UndefinedStatistic::Unequal`] if a row
/// has more or fewer fields than the first.
pub fn count_row_neighbours(rows: &[Vec<u32>], most: usize) -> Result<Vec<RowNeighbours>, UndefinedStatistic> {
    let fields = rows.first().map_or(0, Vec::len);
    if rows.iter().any(|row| row.len() != fields) {
        return Err(UndefinedStatistic::Unequal);
    }
    let most = most.min(fields);
    let subset_count: u64 = (1..=most).map(|size| choose(fields, size)).sum();
    if subset_count.saturating_mul(rows.len() as u64) > MAX_NEIGHBOUR_LOOKUPS as u64 {
        return Err(UndefinedStatistic::TooMany);
    }
    let hashes: Vec<Vec<u128>> = rows.iter().map(|row| cell_hashes(row)).collect();
    let whole: Vec<u128> = hashes
        .iter()
        .map(|cells| cells.iter().fold(0, |sum: u128, hash| sum.wrapping_add(*hash)))
        .collect();
    let equal = count_equal_keys(&whole);
    let mut neighbours: Vec<RowNeighbours> = equal
        .iter()
        .map(|count| RowNeighbours {
            by_distance: vec![*count],
            by_field: vec![0; fields],
        })
        .collect();
    for size in 1..=most {
        let mut sums = vec![0_u64; rows.len()];
        for_each_subset(fields, size, &mut |subset| {
            let left_out = |cells: &Vec<u128>| {
                subset
                    .iter()
                    .fold(0, |sum: u128, field| sum.wrapping_add(cells[*field]))
            };
            let keys: Vec<u128> = whole
                .iter()
                .zip(&hashes)
                .map(|(sum, cells)| sum.wrapping_sub(left_out(cells)))
                .collect();
            for (row, count) in count_equal_keys(&keys).into_iter().enumerate() {
                sums[row] += count;
                if let [field] = subset {
                    neighbours[row].by_field[*field] = count - equal[row];
                }
            }
        });
        for (row, sum) in neighbours.iter_mut().zip(sums) {
            let nearer = row.by_distance.iter().enumerate();
            let counted: u64 = nearer
                .map(|(distance, count)| choose(fields - distance, size - distance) * count)
                .sum();
            row.by_distance.push(sum - counted);
        }
    }
    for row in &mut neighbours {
        // Every row was counted among those that are equal to it.
        row.by_distance[0] -= 1;
    }
    Ok(neighbours)
}

/// Returns for each key how many keys are equal to it, itself included.
fn count_equal_keys(keys: &[u128]) -> Vec<u64> {
    let mut counts: HashMap<u128, u64> = HashMap::with_capacity(keys.len());
    for key in keys {
        *counts.entry(*key).or_default() += 1;
    }
    keys.iter().map(|key| counts[key]).collect()
}

/// Returns a hash of each cell with the number of its field; the sum over fields is the hash of a row.
fn cell_hashes(row: &[u32]) -> Vec<u128> {
    let hash = |(field, value): (usize, &u32)| {
        let key = ((field as u64) << 32) | u64::from(*value);
        // Two halves of 64 bits: that two of a million rows are taken for equal by chance has a probability of 1e-26.
        (u128::from(mix_bits(key)) << 64) | u128::from(mix_bits(!key))
    };
    row.iter().enumerate().map(hash).collect()
}

/// Mixes the bits of a number: the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
fn mix_bits(key: u64) -> u64 {
    let mut bits = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

/// Returns the number of subsets of `size` among `all` things.
fn choose(all: usize, size: usize) -> u64 {
    (0..size as u64).fold(1_u64, |count, taken| {
        count.saturating_mul(all as u64 - taken) / (taken + 1)
    })
}

/// Calls a function for each subset of `size` of the numbers below `all`, in order.
fn for_each_subset(all: usize, size: usize, visit: &mut dyn FnMut(&[usize])) {
    let mut subset: Vec<usize> = (0..size).collect();
    loop {
        visit(&subset);
        // The last member that can still move up; those behind it follow it closely.
        let Some(moved) = (0..size).rev().find(|place| subset[*place] < all - size + place) else {
            return;
        };
        subset[moved] += 1;
        for place in moved + 1..size {
            subset[place] = subset[place - 1] + 1;
        }
    }
}
