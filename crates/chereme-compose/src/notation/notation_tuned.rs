//! The tuned numbers of the animator.
//!
//! The file `schema/notation/animating.json` holds each number with its unit and its meaning, grouped by the modules that
//! use them. Numbers that differ between people and languages stand in `body_language.json` instead.

use chereme_sign::tuned::tuned_numbers;

tuned_numbers! {
    "notation/animating.json";
    /// Numbers for approaches.
    approach: ApproachNumbers {
        lever: f64,
        slower: f64,
        solved: (f64, f64),
        slowest: f64,
    }
    /// Numbers for the bones of an arm.
    arm: ArmNumbers {
        soft: f64,
        rises: [f64; 2],
        hangs: [f64; 2],
    }
    /// Numbers for the flesh of hands.
    bulk: BulkNumbers {
        soft: f64,
        gives: f64,
        far: f64,
        around: f64,
        touching: f64,
        beside: f64,
    }
    /// Numbers for shifts of hands within their place.
    comfort: ComfortNumbers {
        shifted: f64,
        taken: f64,
        strained: f64,
        most_leaned: f64,
        leaned: f64,
        most_bent: f64,
        bent: f64,
        most_shortened: f64,
        shortened: f64,
        near: f64,
    }
    /// Numbers for contacts.
    contact: ContactNumbers {
        beside: f64,
        laid: f64,
        behind: f64,
        away: f64,
    }
    /// Numbers for the choice of an arm's plane and shoulder.
    freedom: FreedomNumbers {
        inwards: f64,
        swivel: f64,
        elbow: f64,
        turned: f64,
        away: f64,
        raised: f64,
        lifted: f64,
        above: f64,
        flared: (f64, f64),
        crossed: (f64, f64),
        low: f64,
        pumping: f64,
        pumped: (f64, f64),
        missed: f64,
        within: f64,
        behind: (f64, f64),
        bent: (f64, f64),
        folded: (f64, f64),
        twisted: (f64, f64),
        untried: f64,
        shrugged: f64,
        shrugging: f64,
        hopeless: (f64, f64),
        shrugs_above: f64,
        around: f64,
    }
    /// Numbers for hands that pass each other.
    hands_apart: HandsApartNumbers {
        near: f64,
        far: f64,
        around: f64,
        longest: f64,
    }
    /// Numbers for sway, head and eyes.
    life: LifeNumbers {
        sway: [f64; 3],
        nod: f64,
        after: f64,
        starts: f64,
        slowly: f64,
        at_head: [f64; 2],
        away: [f64; 2],
        blink: [f64; 2],
        apart: f64,
        eyes: f64,
    }
    /// Numbers for movements.
    motion: MotionNumbers {
        let_go: f64,
        rubs: f64,
        far_turn: f64,
        leaving_turn: f64,
        leads_back: f64,
        shallow: f64,
        soon: f64,
        bends: f64,
        turning: f64,
        hit: f64,
        flaps: (f64, f64),
    }
    /// Numbers for head, trunk and face.
    nonmanual: NonmanualNumbers {
        shakes: f64,
        spread: [f64; 2],
    }
    /// Numbers for leaning hands.
    orient: OrientNumbers {
        leans: f64,
        turned_over: f64,
    }
    /// Numbers for mirrored hands.
    own_side: OwnSideNumbers {
        crosses: f64,
        soft: f64,
        like: f64,
        around: f64,
    }
    /// Numbers for corrections at the trunk.
    push_out: PushOutNumbers {
        near: f64,
    }
    /// Numbers for hands that go round the head.
    skull: SkullNumbers {
        soft: f64,
        around: f64,
    }
    /// Numbers for an arm over time.
    solve: SolveNumbers {
        chosen: f64,
        free_from: f64,
        lead: f64,
        bending: f64,
        pushing: f64,
        around: f64,
        margin: f64,
        most_turned: f64,
        near_turned: f64,
    }
    /// Numbers for time.
    tempo: TempoNumbers {
        easy: f64,
        slightly: f64,
        calm: f64,
        still: f64,
        hardest: f64,
        longer: f64,
    }
    /// Numbers for thumbs.
    thumb: ThumbNumbers {
        apart: f64,
        most: f64,
        skin: f64,
        level: f64,
    }
    /// Numbers for the path from one posture to another.
    transit: TransitNumbers {
        round: f64,
        behind: f64,
        placed: f64,
        swung: f64,
        outwards: f64,
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
    }
}
