//! Numbers for the page: varying lengths of bytes, and differences.

/// Appends a number: seven bits a byte, the lowest first, the sign in the lowest bit.
pub(super) fn push_coded_number(out: &mut Vec<u8>, number: i64) {
    // Small negative numbers then take as few bytes as small positive ones.
    let mut rest = ((number << 1) ^ (number >> 63)) as u64;
    while rest >= 0x80 {
        out.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    out.push(rest as u8);
}

/// Appends a row of numbers: its order of differences, 0 to 2, then the numbers. Order 0 is a row of equal numbers, and
/// has one number.
pub(super) fn push_row(out: &mut Vec<u8>, row: &[i64]) {
    let Some(&first) = row.first() else { return };
    if row.iter().all(|value| *value == first) {
        out.push(0);
        push_coded_number(out, first);
        return;
    }
    let once = row_differences(row);
    let twice = row_differences(&once);
    let cost = |row: &[i64]| row.iter().map(|value| value.unsigned_abs()).sum::<u64>();
    // Smooth movement has small second differences, noisy movement small first ones.
    let (order, row) = match cost(&twice[1..]) < cost(&once[1..]) {
        true => (2, twice),
        false => (1, once),
    };
    out.push(order);
    row.iter().for_each(|value| push_coded_number(out, *value));
}

/// The order of a row of corners: its numbers lie on straight lines between them.
const CORNER_ROW_ORDER: u8 = 3;
/// The most numbers between two corners: the search for the next one takes the square of it.
const MAX_CORNER_DISTANCE: usize = 64;

/// Appends a row of numbers in the fewest bytes, none of them farther than `tolerance` from its own: as [`push_row`] does,
/// or as corners, each with its distance from the one before and the difference from it.
pub(super) fn push_close_row(out: &mut Vec<u8>, row: &[i64], tolerance: i64) {
    let (Some(least), Some(greatest)) = (row.iter().min(), row.iter().max()) else {
        return;
    };
    if greatest - least <= 2 * tolerance {
        out.push(0);
        push_coded_number(out, (least + greatest).div_euclid(2));
        return;
    }
    let mut corners = vec![CORNER_ROW_ORDER];
    push_coded_number(&mut corners, row[0]);
    let mut corner = 0;
    while corner + 1 < row.len() {
        let next = next_row_corner(row, corner, tolerance);
        push_coded_number(&mut corners, (next - corner) as i64);
        push_coded_number(&mut corners, row[next] - row[corner]);
        corner = next;
    }
    let mut differences = Vec::new();
    push_row(&mut differences, row);
    out.append(if corners.len() < differences.len() {
        &mut corners
    } else {
        &mut differences
    });
}

/// Returns the place of the farthest number to which a straight line from that at `corner` stays close.
fn next_row_corner(row: &[i64], corner: usize, tolerance: i64) -> usize {
    let is_close = |end: &usize| {
        let length = (end - corner) as i64;
        let rise = row[*end] - row[corner];
        (corner + 1..*end).all(|at| {
            // Both sides are multiplied by the length, so that the numbers stay whole.
            let line = row[corner] * length + rise * (at - corner) as i64;
            (row[at] * length - line).abs() <= tolerance * length
        })
    };
    let farthest = (corner + MAX_CORNER_DISTANCE).min(row.len() - 1);
    (corner + 1..=farthest).rev().find(is_close).unwrap_or(corner + 1)
}

/// Returns the differences of each number to the one before; the first is kept.
fn row_differences(row: &[i64]) -> Vec<i64> {
    let before = std::iter::once(0).chain(row.iter().copied());
    row.iter().zip(before).map(|(value, before)| value - before).collect()
}

#[cfg(test)]
pub(super) mod tests;
