//! Step patterns as tables: the steps by which an alignment may reach a cell.

use serde::{Deserialize, Serialize};

/// The allowed steps of an alignment with their weights.
///
/// With *i* the frame of the query, *j* that of the reference, *d* the local distance and *g* the least
/// cost of reaching a cell; the first cell always weighs 1. Of steps with equal costs, the one listed
/// first wins. Sources: Sakoe and Chiba 1978 (doi 10.1109/TASSP.1978.1163055), table I, for the symmetric
/// and P1 patterns; Rabiner and Juang 1993, chapter 4, for the plain asymmetric one (Itakura's slope) and
/// type III c.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepPattern {
    /// `d + min(g(i-1,j-1), g(i,j-1), g(i-1,j))`; favours the diagonal and so has no norm.
    Symmetric1,
    /// `min(g(i-1,j-1) + 2d, g(i,j-1) + d, g(i-1,j) + d)`; normalised by the sum of the lengths.
    #[default]
    Symmetric2,
    /// `d + min(g(i-1,j), g(i-1,j-1), g(i-1,j-2))`; every frame of the query counts exactly once and
    /// frames of the reference may be skipped, so its arguments cannot be exchanged. A path needs `M-1 <=
    /// 2(N-1)`. Normalised by the query's length.
    Asymmetric,
    /// Sakoe and Chiba's symmetric pattern of slope constraint P = 1.
    SymmetricP1,
    /// Sakoe and Chiba's asymmetric pattern of slope constraint P = 1.
    AsymmetricP1,
    /// Rabiner and Juang's type III with slope weighting c: no two successive steps along the query.
    TypeIiiC,
}

/// The divisor that makes the costs of alignments of different lengths comparable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CostNorm {
    /// Path weights depend on the path, so there is no norm.
    None,
    /// The query's length.
    Query,
    /// The sum of both lengths.
    Both,
}

/// One step that reaches a cell: its origin, and the cells passed on the way with their weights. Cells are
/// given as offsets back along the query and along the reference.
pub(crate) struct StepProduction {
    pub(crate) from: (usize, usize),
    pub(crate) via: &'static [(usize, usize, f64)],
}

const fn production(from: (usize, usize), via: &'static [(usize, usize, f64)]) -> StepProduction {
    StepProduction { from, via }
}

const SYMMETRIC1_PRODUCTIONS: &[StepProduction] = &[
    production((1, 1), &[(0, 0, 1.0)]),
    production((0, 1), &[(0, 0, 1.0)]),
    production((1, 0), &[(0, 0, 1.0)]),
];
const SYMMETRIC2_PRODUCTIONS: &[StepProduction] = &[
    production((1, 1), &[(0, 0, 2.0)]),
    production((0, 1), &[(0, 0, 1.0)]),
    production((1, 0), &[(0, 0, 1.0)]),
];
const ASYMMETRIC_PRODUCTIONS: &[StepProduction] = &[
    production((1, 0), &[(0, 0, 1.0)]),
    production((1, 1), &[(0, 0, 1.0)]),
    production((1, 2), &[(0, 0, 1.0)]),
];
const SYMMETRIC_P1: &[StepProduction] = &[
    production((1, 2), &[(0, 1, 2.0), (0, 0, 1.0)]),
    production((1, 1), &[(0, 0, 2.0)]),
    production((2, 1), &[(1, 0, 2.0), (0, 0, 1.0)]),
];
const ASYMMETRIC_P1: &[StepProduction] = &[
    production((1, 2), &[(0, 1, 0.5), (0, 0, 0.5)]),
    production((1, 1), &[(0, 0, 1.0)]),
    production((2, 1), &[(1, 0, 1.0), (0, 0, 1.0)]),
];
const TYPE_III_C: &[StepProduction] = &[
    production((1, 2), &[(0, 0, 1.0)]),
    production((1, 1), &[(0, 0, 1.0)]),
    production((2, 1), &[(1, 0, 1.0), (0, 0, 1.0)]),
    production((2, 2), &[(1, 0, 1.0), (0, 0, 1.0)]),
];

impl StepPattern {
    /// Every step pattern.
    pub const ALL_STEP_PATTERNS: [Self; 6] = [
        Self::Symmetric1,
        Self::Symmetric2,
        Self::Asymmetric,
        Self::SymmetricP1,
        Self::AsymmetricP1,
        Self::TypeIiiC,
    ];

    pub(crate) fn step_productions(self) -> &'static [StepProduction] {
        match self {
            Self::Symmetric1 => SYMMETRIC1_PRODUCTIONS,
            Self::Symmetric2 => SYMMETRIC2_PRODUCTIONS,
            Self::Asymmetric => ASYMMETRIC_PRODUCTIONS,
            Self::SymmetricP1 => SYMMETRIC_P1,
            Self::AsymmetricP1 => ASYMMETRIC_P1,
            Self::TypeIiiC => TYPE_III_C,
        }
    }

    pub(crate) fn cost_norm(self) -> CostNorm {
        match self {
            Self::Symmetric1 => CostNorm::None,
            Self::Symmetric2 | Self::SymmetricP1 => CostNorm::Both,
            Self::Asymmetric | Self::AsymmetricP1 | Self::TypeIiiC => CostNorm::Query,
        }
    }

    /// Returns the weight of a diagonal step, if the pattern has only single steps in both directions.
    pub(crate) fn diagonal_weight(self) -> Option<f64> {
        match self {
            Self::Symmetric1 => Some(1.0),
            Self::Symmetric2 => Some(2.0),
            _ => None,
        }
    }

    /// Returns whether steps of this pattern can cover `query` by `reference` frames without a window.
    pub(crate) fn may_span_frames(self, query: usize, reference: usize) -> bool {
        let (n, m) = (query.saturating_sub(1), reference.saturating_sub(1));
        match self {
            Self::Symmetric1 | Self::Symmetric2 => true,
            Self::Asymmetric => m <= n.saturating_mul(2),
            Self::SymmetricP1 | Self::AsymmetricP1 | Self::TypeIiiC => {
                m <= n.saturating_mul(2) && n <= m.saturating_mul(2)
            }
        }
    }
}
