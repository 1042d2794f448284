//! The table of least costs with the path through it; fills it by the faster method that its step pattern allows.

use super::skew::Reversed;
use super::{Options, Series, rows, skew};

pub(super) enum Table {
    Rows(rows::Table),
    Skew(skew::Table),
}

impl Table {
    pub(super) fn fill<const KEEP: bool>(
        query: &Series,
        reference: &Series,
        options: &Options,
    ) -> Option<Self> {
        let rows = options.window.rows(query.frames(), reference.frames());
        let Some(diagonal) = options.pattern.diagonal() else {
            return Some(Self::Rows(rows::fill(
                query, reference, &rows, options, KEEP,
            )));
        };
        let ask = skew::Ask {
            rows: &rows,
            diagonal,
            local: options.local,
            limit: f64::INFINITY,
            rest: &[],
        };
        skew::fill::<KEEP>(query, &Reversed::of(reference), &ask).map(Self::Skew)
    }

    /// Returns the least cost of reaching each frame of the reference with the query's last; infinite if
    /// no path leads there.
    pub(super) fn last(&self) -> &[f64] {
        match self {
            Self::Rows(table) => &table.last,
            Self::Skew(table) => &table.last,
        }
    }

    /// Returns the path to frame `end` of the reference, first pair first, from a table that kept
    /// its steps.
    pub(super) fn path(&self, query: usize, end: usize, options: &Options) -> Vec<(usize, usize)> {
        let productions = options.pattern.productions();
        let mut path = Vec::with_capacity(query * 2);
        let (mut i, mut j) = (query - 1, end);
        loop {
            if i == 0 && j == 0 && !options.open_begin {
                path.push((0, 0));
                break;
            }
            let step = match self {
                Self::Rows(table) => table.step(i, j),
                Self::Skew(table) => table.step(i, j),
            };
            let production = &productions[usize::from(step)];
            path.extend(production.via.iter().rev().map(|(a, b, _)| (i - a, j - b)));
            let (di, dj) = production.from;
            if di > i {
                break;
            }
            (i, j) = (i - di, j - dj);
        }
        path.reverse();
        path
    }
}
