//! The tuned numbers of transcription.
//!
//! The file `schema/notation/reading.json` holds each number with its unit and its meaning, grouped by the modules that
//! use them.

use chereme_sign::tuned::tuned_numbers;

tuned_numbers! {
    "notation/reading.json";
    /// Numbers for transcription as a whole.
    reading: ReadingNumbers {
        made: f64,
    }
    /// Numbers for a whole clip.
    scene: SceneNumbers {
        looked_at: usize,
    }
    /// Numbers for smoothing.
    denoise: DenoiseNumbers {
        trembles: f64,
        widest: f64,
        longest: f64,
        odd: f64,
    }
    /// Numbers for the detection of synthesised movement.
    precision: PrecisionNumbers {
        turned: [f64; 2],
        shaped: f64,
        many: f64,
        lever: f64,
        looked_at: usize,
    }
    /// Numbers for handshapes.
    shape: ShapeNumbers {
        thumb: [f64; 5],
        finger: [f64; 4],
        same: f64,
        floor: f64,
        tried: usize,
        odd: f64,
        costs: [f64; 3],
        tie: f64,
    }
    /// Numbers for orientations.
    aim: AimNumbers {
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
    place: PlaceNumbers {
        touch: [f64; 3],
        nearness: [[f64; 4]; 2],
        said: [f64; 3],
        step: f64,
        unsaid: f64,
        own_sides: f64,
        rather_not: f64,
    }
    /// Numbers for the candidate places.
    choice: ChoiceNumbers {
        between: f64,
        oblique: f64,
        usual: [f64; 24],
        neutral: f64,
        top: f64,
        top_alone: [f64; 2],
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
    spread: SpreadNumbers {
        shares: [f64; 3],
        free: [[f64; 3]; 3],
        room: [[f64; 5]; 3],
        anywhere: [f64; 3],
        short: f64,
        exact: f64,
        touching: [[f64; 3]; 2],
        astray: [f64; 3],
        missed: [f64; 3],
        pushed: f64,
        slides: f64,
    }
    /// Numbers for the parts of a hand.
    part: PartNumbers {
        rank: f64,
        before: f64,
        two: f64,
        pinched: f64,
    }
    /// Numbers for constellations of the two hands.
    together: TogetherNumbers {
        together: f64,
        reach: f64,
        pairs: usize,
        rather: [f64; 2],
        parts: f64,
        step: f64,
        unnamed: [f64; 2],
        contact: f64,
        touches: f64,
    }
    /// Numbers for the symmetry of the hands.
    hands: HandsNumbers {
        stays: f64,
        alike: f64,
        points: f64,
        shaped: f64,
        parallel: f64,
        placed: f64,
    }
    /// Numbers for cuts of movement into paths.
    cuts: CutsNumbers {
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
    path: PathNumbers {
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
    acts: ActsNumbers {
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
    fold: FoldNumbers {
        alike: f64,
        grows: f64,
    }
    /// Numbers for movements to and fro.
    sway: SwayNumbers {
        sway: f64,
        besides: f64,
    }
    /// Numbers for the notation as a whole.
    tree: TreeNumbers {
        most_apart: f64,
        sure: f64,
        most: usize,
    }
    /// Numbers for the manner of a movement.
    manner: MannerNumbers {
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
    resynthesis: ResynthesisNumbers {
        shared: usize,
        pairs: [usize; 2],
        rounds: [usize; 2],
        beam: [usize; 2],
        neighbours: usize,
        widely: usize,
        turns: usize,
        turned_at: usize,
        moved: usize,
        targets: [usize; 2],
        nearer: f64,
        convincing: f64,
        finalists: usize,
        exact: f64,
        nearly: f64,
        almost: f64,
        sure: f64,
        displaced: f64,
        near: f64,
        posed: f64,
        rather: f64,
        less: f64,
        inexact: f64,
        farther: f64,
        per: f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_a_unit_and_a_meaning_of_its_own() {
        assert_eq!(
            crate::tuned_faults::tuned_document_faults(DOCUMENT),
            Vec::<String>::new()
        );
        assert!(tuned().place.touch.iter().all(|it| *it > 0.0));
    }

    #[test]
    fn a_number_of_another_name_is_refused() {
        let other = DOCUMENT.replace("\"looked_at\": [48,", "\"looked_to\": [48,");
        assert_ne!(DOCUMENT, other);
        let refused = chereme_sign::tuned::read_tuned_document::<Tuned>(&other)
            .expect_err("refused")
            .to_string();
        assert!(refused.contains("looked_to"), "{refused}");
    }
}
