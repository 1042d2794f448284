//! The tuned numbers of transcription.
//!
//! The file `schema/notation/reading.json` holds each number with its unit and its meaning, grouped by the modules that
//! use them.

use std::sync::OnceLock;

use chereme_sign::tuned::{number, read};
use serde::Deserialize;

/// Declares a group of numbers; the data file documents each of them.
macro_rules! numbers {
    ($($(#[$doc:meta])* $group:ident { $($name:ident: $kind:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Deserialize)]
            #[serde(deny_unknown_fields)]
            pub(crate) struct $group {
                $(#[serde(deserialize_with = "number")] pub(crate) $name: $kind,)*
            }
        )*
    };
}

numbers! {
    /// Numbers for transcription as a whole.
    ReadingNumbers {
        made: f64,
    }
    /// Numbers for a whole clip.
    SceneNumbers {
        looked_at: usize,
    }
    /// Numbers for smoothing.
    DenoiseNumbers {
        trembles: f64,
        widest: f64,
    }
    /// Numbers for the detection of synthesised movement.
    PrecisionNumbers {
        turned: [f64; 2],
        shaped: f64,
        many: f64,
        looked_at: usize,
    }
    /// Numbers for handshapes.
    ShapeNumbers {
        thumb: [f64; 5],
        finger: [f64; 4],
        same: f64,
        floor: f64,
        tried: usize,
        odd: f64,
        costs: [f64; 3],
    }
    /// Numbers for orientations.
    AimNumbers {
        plain: f64,
        half: [f64; 3],
        half_palm: f64,
        corner: f64,
        spread: [(f64, f64); 3],
        wider: [i32; 3],
        looked_at: f64,
        beyond: f64,
        apart: f64,
    }
    /// Numbers for the place of one hand.
    PlaceNumbers {
        touch: [f64; 3],
        nearness: [[f64; 4]; 2],
        said: [f64; 3],
        step: f64,
        unsaid: f64,
        own_sides: f64,
        rather_not: f64,
    }
    /// Numbers for the candidate places.
    ChoiceNumbers {
        between: f64,
        oblique: f64,
        rare: f64,
        top: f64,
        across: f64,
        beside: f64,
        wide: f64,
        regions: f64,
        skips: f64,
        distant: f64,
        between_them: f64,
        apart: f64,
        aside: f64,
        above: f64,
    }
    /// Numbers for the distribution of hands about their places.
    SpreadNumbers {
        shares: [f64; 3],
        of_trunk: [f64; 3],
        short: f64,
        exact: f64,
        anywhere: [f64; 2],
        pushed: f64,
        slides: f64,
        missed: f64,
    }
    /// Numbers for the parts of a hand.
    PartNumbers {
        rank: f64,
        before: f64,
        two: f64,
        pinched: f64,
    }
    /// Numbers for constellations of the two hands.
    TogetherNumbers {
        together: f64,
        pairs: usize,
        rather: [f64; 2],
        parts: f64,
        step: f64,
        unnamed: f64,
        contact: f64,
        touches: f64,
    }
    /// Numbers for the symmetry of the hands.
    HandsNumbers {
        stays: f64,
        alike: f64,
        points: f64,
        shaped: f64,
        parallel: f64,
        placed: f64,
    }
    /// Numbers for cuts of movement into paths.
    CutsNumbers {
        least: (f64, f64),
        short: f64,
        brief: f64,
        stops: f64,
        corners: f64,
        closed: f64,
        roundish: f64,
        flattened: f64,
        slows: f64,
        onward: f64,
        turns: f64,
        faint: f64,
        back: (f64, f64),
        lap: f64,
        rise: f64,
        near: f64,
    }
    /// Numbers for fits of paths.
    PathNumbers {
        exact: f64,
        points: usize,
        curved: f64,
        shallow: (f64, f64, f64),
        round: f64,
        part: f64,
        part_off: f64,
        narrow: f64,
        wide: f64,
    }
    /// Numbers for acts.
    ActsNumbers {
        turned: f64,
        reshaped: f64,
        again: f64,
        lever: f64,
        sways: f64,
        lets_go: f64,
        gap: f64,
        lull: f64,
        per: f64,
        aside: f64,
    }
    /// Numbers for repetitions.
    FoldNumbers {
        alike: f64,
        grows: f64,
    }
    /// Numbers for movements to and fro.
    SwayNumbers {
        sway: f64,
        besides: f64,
    }
    /// Numbers for the notation as a whole.
    TreeNumbers {
        most_apart: f64,
        sure: f64,
        most: usize,
    }
    /// Numbers for the manner of a movement.
    MannerNumbers {
        rests: f64,
        late: f64,
        even: f64,
        unexpected: f64,
        targetted: [f64; 3],
        contact: [f64; 3],
        stop: [f64; 3],
        tense: [f64; 3],
        round: [f64; 3],
    }
    /// Numbers for the check by re-synthesis.
    ResynthesisNumbers {
        shared: usize,
        pairs: usize,
        turns: usize,
        turned_at: usize,
        finalists: usize,
        exact: f64,
        nearly: f64,
        almost: f64,
        inexact: f64,
        places: [usize; 3],
    }
}

/// The tuned numbers of transcription.
#[derive(Debug, Deserialize)]
pub(crate) struct Tuned {
    pub(crate) reading: ReadingNumbers,
    pub(crate) scene: SceneNumbers,
    pub(crate) denoise: DenoiseNumbers,
    pub(crate) precision: PrecisionNumbers,
    pub(crate) shape: ShapeNumbers,
    pub(crate) aim: AimNumbers,
    pub(crate) place: PlaceNumbers,
    pub(crate) choice: ChoiceNumbers,
    pub(crate) spread: SpreadNumbers,
    pub(crate) part: PartNumbers,
    pub(crate) together: TogetherNumbers,
    pub(crate) hands: HandsNumbers,
    pub(crate) cuts: CutsNumbers,
    pub(crate) path: PathNumbers,
    pub(crate) acts: ActsNumbers,
    pub(crate) fold: FoldNumbers,
    pub(crate) sway: SwayNumbers,
    pub(crate) tree: TreeNumbers,
    pub(crate) manner: MannerNumbers,
    pub(crate) resynthesis: ResynthesisNumbers,
}

/// Returns the tuned numbers.
pub(crate) fn tuned() -> &'static Tuned {
    static TUNED: OnceLock<Tuned> = OnceLock::new();
    TUNED.get_or_init(|| {
        let text = include_str!("../../../../schema/notation/reading.json");
        read(text).expect("the program's own file has every number")
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde_json::Value;

    use super::*;

    #[test]
    fn every_number_has_a_unit_and_a_meaning_of_its_own() {
        const UNITS: [&str; 12] = [
            "arm", "m", "rad", "deg", "s", "turns", "nepers", "share", "factor", "count", "arm/s",
            "rad/s",
        ];
        let text = include_str!("../../../../schema/notation/reading.json");
        let mut groups: BTreeMap<String, Value> = serde_json::from_str(text).expect("JSON");
        let [version, description] = ["version", "description"].map(|name| groups.remove(name));
        assert_eq!(version, Some(1.into()));
        let description = description.unwrap_or_default().to_string();
        let mut count = 0;
        for (group, numbers) in groups {
            let numbers: BTreeMap<String, (Value, String, String)> =
                serde_json::from_value(numbers).expect("numbers");
            for (name, (_, units, meaning)) in numbers {
                for unit in units.split(", ") {
                    assert!(
                        UNITS.contains(&unit) || unit == "m/rad",
                        "{group}.{name}: {unit}"
                    );
                    assert!(description.contains(&format!(" {unit} ")), "{unit}");
                }
                assert!(meaning.len() > 20, "{group}.{name}: {meaning}");
                count += 1;
            }
        }
        assert_eq!(count, 132);
        assert!(tuned().place.touch.iter().all(|it| *it > 0.0));
    }

    #[test]
    fn a_number_of_another_name_is_refused() {
        let text = include_str!("../../../../schema/notation/reading.json");
        let other = text.replace("\"looked_at\": [48,", "\"looked_to\": [48,");
        assert_ne!(text, other);
        let refused = read::<Tuned>(&other).expect_err("refused").to_string();
        assert!(refused.contains("looked_to"), "{refused}");
    }
}
