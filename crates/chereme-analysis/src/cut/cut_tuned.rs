//! The tuned numbers of cutting, which are data: `schema/cutting.json`.

use std::collections::BTreeMap;

use chereme_sign::tuned::tuned_numbers;

tuned_numbers! {
    "cutting.json";
    /// Scales of postures.
    scales: PostureScales {
        place: f64,
        palm: f64,
        fingers: f64,
        smoothing: f64,
    }
    /// Numbers for activities, which lie between two rests.
    activity: ActivityNumbers {
        up: f64,
        down: f64,
        above_rest: [f64; 2],
        still: f64,
        highest_rest: f64,
        around: f64,
        weak_share: f64,
    }
    /// Numbers for a single sign between two rests.
    peel: PeelNumbers {
        level: f64,
        slow: f64,
    }
    /// Numbers for several signs in one activity.
    decoder: DecoderNumbers {
        weight: f64,
        cost: f64,
        slider: f64,
        second: f64,
        shortest: usize,
        gap: usize,
        longest: usize,
        clip: f64,
        boundary_prior: f64,
        flank: [f64; 2],
    }
    /// Numbers for holds and phases.
    holds: HoldNumbers {
        place: f64,
        turn: f64,
        peak: f64,
        least: f64,
        shortest: f64,
        moving: f64,
        same: [f64; 3],
        other: [f64; 3],
        sure: f64,
        unheld: f64,
        edge: f64,
    }
    /// Numbers for confidence.
    confidence: ConfidenceNumbers {
        decoded: [f64; 2],
        peeled: [f64; 2],
    }
    /// Weights of the three linear heads.
    heads: HeadWeights {
        sign: BTreeMap<String, f64>,
        begin: BTreeMap<String, f64>,
        end: BTreeMap<String, f64>,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_cutting_has_a_unit_and_a_meaning() {
        let faults = crate::tuned_faults::tuned_document_faults(DOCUMENT);
        assert_eq!(faults, Vec::<String>::new());
        let heads = &tuned().heads;
        for head in [&heads.begin, &heads.end] {
            assert!(head.keys().eq(heads.sign.keys()), "one list of numbers for all heads");
        }
    }
}
