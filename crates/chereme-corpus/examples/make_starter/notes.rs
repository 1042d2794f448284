//! What is said of a take on each tier.

use chereme_motion::Side;
use chereme_motion::glam::DVec3;

use super::facing;
use super::perform::Performance;
use super::score::{Part, Sign, Take, Tier};

/// A tier of the annotation files.
pub(crate) struct TierKind {
    /// Its name; `@` stands for `RH` or `LH`.
    pub(crate) name: &'static str,
    /// The name of its ELAN type.
    pub(crate) kind: &'static str,
    /// The inventory whose values it has.
    pub(crate) inventory: Option<&'static str>,
}

/// The tiers below the gloss, and beside it the phases.
pub(crate) const TIERS: [TierKind; 9] = [
    tier("Configuration @", "configuration", Some("configurations")),
    tier("Placement @", "placement", Some("placements")),
    tier("Movement @", "movement", Some("movements")),
    tier(
        "Movement direction @",
        "movement direction",
        Some("directions"),
    ),
    tier("Palm direction @", "palm direction", Some("palm")),
    tier("Finger direction @", "finger direction", Some("fingers")),
    tier("Brows", "brows", Some("brows")),
    tier("Head", "head", Some("head")),
    tier("Phase @", "phase", None),
];

const fn tier(name: &'static str, kind: &'static str, inventory: Option<&'static str>) -> TierKind {
    TierKind {
        name,
        kind,
        inventory,
    }
}

/// The place of a tier in [`TIERS`].
pub(crate) const CONFIGURATION: usize = 0;
const PALM: usize = 4;
const FINGERS: usize = 5;
/// The place of the phases in [`TIERS`].
pub(crate) const PHASE: usize = 8;

/// A value said of a stretch of time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Note {
    /// The place of the tier in [`TIERS`].
    pub(crate) tier: usize,
    /// The hand; none where the tier has none.
    pub(crate) side: Option<Side>,
    /// The value.
    pub(crate) value: &'static str,
    /// From when to when, in seconds.
    pub(crate) from: f64,
    /// The end.
    pub(crate) to: f64,
    /// The place of the sign in the take.
    pub(crate) sign: usize,
}

/// Returns what is said of the signs of `take`, tier by tier in order of time.
pub(crate) fn notes(take: &Take, performance: &Performance) -> Vec<Note> {
    let mut notes: Vec<Note> = Vec::new();
    for (place, (start, sign)) in take.signs.iter().enumerate() {
        let said = of_sign(sign);
        notes.extend(said.into_iter().map(|note| Note {
            from: start + note.from,
            to: start + note.to,
            sign: place,
            ..note
        }));
    }
    for (side, hand) in Side::BOTH.into_iter().zip(&performance.hands) {
        notes.extend(hand.phases.iter().map(|&(value, from, to)| Note {
            tier: PHASE,
            side: Some(side),
            value,
            from,
            to,
            sign: 0,
        }));
    }
    notes
}

/// Returns what is said of a sign, its start being nought; phases are left out.
pub(crate) fn of_sign(sign: &Sign) -> Vec<Note> {
    let note = |tier, side, value, from, to| Note {
        tier,
        side,
        value,
        from,
        to,
        sign: 0,
    };
    let mut notes = Vec::new();
    for side in Side::BOTH {
        let part = sign.part(side);
        for shape in &part.shapes {
            notes.push(note(CONFIGURATION, Some(side), shape.0, shape.1, shape.2));
        }
        notes.extend(facings(sign, part, side));
    }
    for says in &sign.says {
        let (tier, side) = match says.0 {
            Tier::Placement(side) => (1, Some(side)),
            Tier::Movement(side) => (2, Some(side)),
            Tier::Direction(side) => (3, Some(side)),
            Tier::Brows => (6, None),
            Tier::Head => (7, None),
        };
        notes.push(note(tier, side, says.1, says.2, says.3));
    }
    notes
}

/// Returns where palm and fingers point at the start and, where that is another value, at the end.
fn facings(sign: &Sign, part: &Part, side: Side) -> Vec<Note> {
    let named = |beat: Option<&super::score::Beat>| {
        let own = |[x, y, z]: [f64; 3]| DVec3::new(x * side.sign(), y, z);
        let beat = beat?;
        let fingers = own(beat.fingers).normalize();
        facing::named(fingers, own(beat.palm).reject_from_normalized(fingers))
    };
    let (Some(first), Some(last)) = (named(part.beats.first()), named(part.beats.last())) else {
        return Vec::new();
    };
    let moves = part
        .beats
        .windows(2)
        .find(|pair| pair[0].fingers != pair[1].fingers || pair[0].palm != pair[1].palm);
    let [turning, turned] = moves.map_or([0.0, 0.0], |pair| [pair[0].at, sign.hold]);
    let third = (turned - turning) / 3.0;
    let mut notes = Vec::new();
    for (tier, n) in [(FINGERS, 0), (PALM, 1)] {
        let mut note = |value, from, to| {
            notes.push(Note {
                tier,
                side: Some(side),
                value,
                from,
                to,
                sign: 0,
            });
        };
        if first[n] == last[n] {
            note(first[n], 0.0, sign.length);
        } else {
            note(first[n], 0.0, turning + third);
            note(last[n], turned - third, sign.length);
        }
    }
    notes
}
