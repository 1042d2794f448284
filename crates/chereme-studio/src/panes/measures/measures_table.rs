//! The columns of the table of measured signs, and its order.

use chereme_corpus::MeasuredSign;

use crate::words::{InterfaceText, measures_words as words, search_words};

/// A column of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MeasureColumn {
    Gloss,
    Density,
    Pairs,
    Homonyms,
    Family,
    Probability,
    PairProbability,
    Tokens,
    Signers,
}

impl MeasureColumn {
    /// The columns with their titles, and their shares of the width.
    pub(super) const ALL_MEASURE_COLUMNS: [(Self, InterfaceText, f32); 9] = [
        (Self::Gloss, search_words::GLOSS, 0.16),
        (Self::Density, words::DENSITY, 0.13),
        (Self::Pairs, words::PAIRS, 0.13),
        (Self::Homonyms, words::HOMONYMS, 0.12),
        (Self::Family, words::FAMILY, 0.07),
        (Self::Probability, words::PROBABILITY, 0.11),
        (Self::PairProbability, words::PAIR_PROBABILITY, 0.1),
        (Self::Tokens, words::TOKENS, 0.09),
        (Self::Signers, words::SIGNERS, 0.09),
    ];

    /// Returns the number of a sign in this column; `None` in the column of glosses, or without one.
    fn measured_number(self, sign: &MeasuredSign) -> Option<f64> {
        match self {
            Self::Gloss => None,
            Self::Density => Some(sign.density as f64),
            Self::Pairs => Some(sign.pairs as f64),
            Self::Homonyms => Some(sign.homonyms.len() as f64),
            Self::Family => sign.family_size.map(|size| size as f64),
            Self::Probability => sign.probability,
            Self::PairProbability => sign.pair_probability,
            Self::Tokens => Some(sign.tokens as f64),
            Self::Signers => Some(sign.signers as f64),
        }
    }

    /// Returns the text of a cell: shares with four digits, as the command line writes them.
    pub(super) fn measure_cell_text(self, sign: &MeasuredSign) -> String {
        let number = self.measured_number(sign);
        match self {
            Self::Gloss => sign.gloss.clone(),
            Self::Probability | Self::PairProbability => number.map_or(String::new(), |share| format!("{share:.4}")),
            _ => number.map_or(String::new(), |count| count.to_string()),
        }
    }
}

/// The column that gives the order, and whether the greatest comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MeasureOrder {
    pub(super) column: MeasureColumn,
    pub(super) descending: bool,
}

impl Default for MeasureOrder {
    fn default() -> Self {
        Self {
            column: MeasureColumn::Density,
            descending: true,
        }
    }
}

impl MeasureOrder {
    /// Returns the order after a press on the title of a column: the other direction, or that column with its greatest
    /// number first.
    pub(super) fn order_after_press(self, column: MeasureColumn) -> Self {
        let descending = match self.column == column {
            true => !self.descending,
            false => column != MeasureColumn::Gloss,
        };
        Self { column, descending }
    }

    /// Returns the places of signs in this order, those without a number last; signs of one number keep their own order.
    pub(super) fn sort_measured_signs(self, signs: &[MeasuredSign]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..signs.len()).collect();
        order.sort_by(|one, other| {
            let [one, other] = [one, other].map(|at| &signs[*at]);
            let numbers = [one, other].map(|sign| self.column.measured_number(sign));
            let ascending = match (self.column, numbers) {
                (MeasureColumn::Gloss, _) => one.gloss.cmp(&other.gloss),
                (_, [Some(a), Some(b)]) => a.total_cmp(&b),
                (_, [a, b]) => return a.is_none().cmp(&b.is_none()),
            };
            match self.descending {
                true => ascending.reverse(),
                false => ascending,
            }
        });
        order
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn sign(gloss: &str, density: u64, probability: Option<f64>) -> MeasuredSign {
        MeasuredSign {
            gloss: gloss.to_owned(),
            token: 1,
            density,
            pairs: 0,
            pairs_by_field: BTreeMap::new(),
            homonyms: Vec::new(),
            family: None,
            family_size: None,
            probability,
            pair_probability: None,
            tokens: 0,
            signers: 0,
        }
    }

    #[test]
    fn signs_are_sorted_by_a_column_in_either_direction_without_a_number_last() {
        let signs = [
            sign("BOL", 3, None),
            sign("AIMER", 12, Some(0.25)),
            sign("CHAT", 3, Some(0.5)),
        ];
        let order = MeasureOrder::default();
        assert_eq!(order.sort_measured_signs(&signs), [1, 0, 2]);
        let order = order.order_after_press(MeasureColumn::Density);
        assert_eq!(order.sort_measured_signs(&signs), [0, 2, 1]);
        let order = order.order_after_press(MeasureColumn::Probability);
        assert_eq!(order.sort_measured_signs(&signs), [2, 1, 0]);
        let order = order.order_after_press(MeasureColumn::Probability);
        assert_eq!(order.sort_measured_signs(&signs), [1, 2, 0], "none stays last");
        let order = order.order_after_press(MeasureColumn::Gloss);
        assert_eq!(order.sort_measured_signs(&signs), [1, 0, 2]);
    }

    #[test]
    fn cells_are_written_as_the_command_line_writes_them() {
        let sign = sign("AIMER", 12, Some(0.123_46));
        for (column, text) in [
            (MeasureColumn::Gloss, "AIMER"),
            (MeasureColumn::Density, "12"),
            (MeasureColumn::Probability, "0.1235"),
            (MeasureColumn::PairProbability, ""),
        ] {
            assert_eq!(column.measure_cell_text(&sign), text);
        }
    }
}
