//! The cheapest assignment of sparse costs.
//!
//! Shortest augmenting paths with prices (Jonker and Volgenant 1987) over the edges that exist, so that two tiers of
//! thousands of units, where each unit has a few candidates, take milliseconds. Solvers of full tables need the square
//! of that in memory and the cube in time.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// The candidates of each row: a column, and the cost of the pair relative to both staying alone, below 0.
pub(super) type AssignmentEdges = Vec<Vec<(usize, f64)>>;

/// A distance with the place that it leads to.
#[derive(PartialEq)]
struct GoalDistance(f64, AssignmentGoal);

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum AssignmentGoal {
    /// A row stays alone.
    Alone(usize),
    Column(usize),
}

impl Eq for GoalDistance {}

impl PartialOrd for GoalDistance {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for GoalDistance {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

/// Returns the column of each row in the assignment of least cost; a row may stay alone at cost 0.
pub(super) fn assign_least_cost(edges: &AssignmentEdges, columns: usize) -> Vec<Option<usize>> {
    let mut work = AssignmentWork {
        edges,
        row_price: vec![0.0; edges.len()],
        column_price: vec![0.0; columns],
        column_of: vec![None; edges.len()],
        row_of: vec![None; columns],
        distance: vec![f64::INFINITY; columns],
        from: vec![usize::MAX; columns],
    };
    for row in 0..edges.len() {
        work.insert_assignment_row(row);
    }
    work.column_of
}

struct AssignmentWork<'a> {
    edges: &'a AssignmentEdges,
    row_price: Vec<f64>,
    column_price: Vec<f64>,
    column_of: Vec<Option<usize>>,
    row_of: Vec<Option<usize>>,
    /// The distance of each column in the current search, and the row before it.
    distance: Vec<f64>,
    from: Vec<usize>,
}

impl AssignmentWork<'_> {
    /// Adds a row to the assignment of least cost of the rows before it.
    fn insert_assignment_row(&mut self, row: usize) {
        // Dijkstra's search needs costs of at least 0, so that the price starts at the cheapest choice.
        let costs = self.edges[row].iter();
        let cheapest = costs.map(|(column, cost)| cost - self.column_price[*column]);
        self.row_price[row] = cheapest.fold(0.0, f64::min);
        let mut heap = BinaryHeap::new();
        let (mut touched, mut settled) = (Vec::new(), Vec::new());
        self.push_reachable_goals(row, 0.0, &mut heap, &mut touched);
        let mut end = None;
        while let Some(Reverse(GoalDistance(reached, goal))) = heap.pop() {
            match goal {
                AssignmentGoal::Alone(_) => {
                    end = Some((reached, goal));
                    break;
                }
                AssignmentGoal::Column(column) => {
                    // A longer way to a column that was reached by a shorter one since.
                    if reached > self.distance[column] {
                        continue;
                    }
                    let Some(next) = self.row_of[column] else {
                        end = Some((reached, goal));
                        break;
                    };
                    settled.push((column, next, reached));
                    self.push_reachable_goals(next, reached, &mut heap, &mut touched);
                }
            }
        }
        if let Some((total, goal)) = end {
            self.row_price[row] += total;
            // Prices of settled columns keep pairs in use at a reduced cost of 0.
            for (column, next, reached) in settled {
                self.column_price[column] -= total - reached;
                self.row_price[next] += total - reached;
            }
            self.shift_assigned_rows(row, goal);
        }
        // Only these have changed: to clear all columns for each row would take squared time.
        for column in touched {
            self.distance[column] = f64::INFINITY;
        }
    }

    /// Puts what a row can reach onto the heap.
    fn push_reachable_goals(
        &mut self,
        row: usize,
        reached: f64,
        heap: &mut BinaryHeap<Reverse<GoalDistance>>,
        touched: &mut Vec<usize>,
    ) {
        let price = self.row_price[row];
        heap.push(Reverse(GoalDistance(reached - price, AssignmentGoal::Alone(row))));
        for &(column, cost) in &self.edges[row] {
            // Rounding may leave a reduced cost just below 0.
            let through = reached + (cost - price - self.column_price[column]).max(0.0);
            if self.column_of[row] != Some(column) && through < self.distance[column] {
                if self.distance[column].is_infinite() {
                    touched.push(column);
                }
                self.distance[column] = through;
                self.from[column] = row;
                heap.push(Reverse(GoalDistance(through, AssignmentGoal::Column(column))));
            }
        }
    }

    /// Moves the rows along the path that ends at `goal`.
    fn shift_assigned_rows(&mut self, start: usize, goal: AssignmentGoal) {
        let mut column = match goal {
            AssignmentGoal::Column(column) => column,
            AssignmentGoal::Alone(row) => match self.column_of[row].take() {
                // A row that leaves its column hands it to the row before it.
                Some(column) => column,
                None => return,
            },
        };
        loop {
            let row = self.from[column];
            self.row_of[column] = Some(row);
            let before = self.column_of[row].replace(column);
            match before {
                Some(next) if row != start => column = next,
                _ => return,
            }
        }
    }
}
