//! The signs of the founding paper, as plausible forms of LSF: approximations, nobody's production.

use chereme_motion::Side::{Left, Right};

use super::score::Point::{Of, Wrist};
use super::score::Tier::{Brows, Direction, Head, Movement, Placement};
use super::score::{Part, Says, Shape, Sign, Turn, beat};

const DOWN: [f64; 3] = [0.0, -1.0, 0.0];
const IN: [f64; 3] = [-1.0, 0.0, 0.0];
const OUT: [f64; 3] = [0.0, 0.0, 1.0];

fn sign(gloss: &'static str, means: [&'static str; 2], length: f64) -> Sign {
    Sign {
        gloss,
        means,
        length,
        hold: length,
        right: Part::default(),
        left: Part::default(),
        says: Vec::new(),
        head: Vec::new(),
        trunk: Vec::new(),
    }
}

/// Two hollow hands side by side, palms up, draw the walls of a bowl.
pub(crate) fn bol() -> Sign {
    let side = Part {
        beats: vec![
            beat(0.0, "neutral-space", [6.6, -4.0, 0.0])
                .facing([-0.22, 0.05, 1.0], [-0.05, 1.0, 0.0]),
            beat(0.62, "neutral-space", [13.5, 5.0, 0.0])
                .facing([-0.15, 0.15, 1.0], [-0.9, 0.45, 0.0])
                .bowed([2.5, -3.0, 0.0])
                .raised(0.15),
            beat(0.85, "neutral-space", [13.5, 5.0, 0.0])
                .facing([-0.15, 0.15, 1.0], [-0.9, 0.45, 0.0])
                .raised(0.15),
        ],
        shapes: vec![Shape("B-round", 0.0, 0.85)],
    };
    Sign {
        hold: 0.62,
        right: side.clone(),
        left: side,
        says: vec![
            Says(Placement(Right), "neutral", 0.0, 0.85),
            Says(Placement(Left), "neutral", 0.0, 0.85),
            Says(Movement(Right), "arc", 0.0, 0.62),
            Says(Movement(Left), "arc", 0.0, 0.62),
            Says(Direction(Right), "up-right", 0.0, 0.62),
            Says(Direction(Left), "up-left", 0.0, 0.62),
        ],
        head: vec![Turn(0.1, [9.0, 0.0, 0.0]), Turn(0.85, [5.0, 0.0, 0.0])],
        trunk: vec![Turn(0.2, [2.0, 0.0, 0.0])],
        ..sign("BOL", ["bol", "bowl"], 0.85)
    }
}

/// The flat hand pats the signer's side twice, as one calls a dog.
pub(crate) fn chien() -> Sign {
    let off = beat(0.0, "ipsi-hip", [11.5, -3.0, 5.0]).facing([-0.1, -1.0, 0.25], IN);
    let on = beat(0.0, "ipsi-hip", [5.8, -5.0, 4.0]).facing([-0.05, -1.0, 0.2], IN);
    Sign {
        hold: 0.56,
        right: Part {
            beats: vec![
                off,
                on.again(0.17),
                off.again(0.36),
                on.again(0.53),
                on.again(0.72),
            ],
            shapes: vec![Shape("flat", 0.0, 0.72)],
        },
        says: vec![
            Says(Placement(Right), "hip", 0.0, 0.72),
            Says(Movement(Right), "tap", 0.0, 0.56),
            Says(Direction(Right), "left", 0.0, 0.56),
        ],
        head: vec![Turn(0.2, [6.0, -6.0, 2.0]), Turn(0.72, [3.0, -2.0, 0.0])],
        trunk: vec![Turn(0.15, [1.0, 0.0, 3.0])],
        ..sign("CHIEN", ["chien", "dog"], 0.72)
    }
}

/// The tip of the index comes to the temple.
pub(crate) fn penser() -> Sign {
    let on = beat(0.26, "ipsi-temple", [1.2, 0.0, 0.6])
        .with(Of("index-tip"))
        .facing([-0.62, 0.74, -0.25], [-0.75, -0.6, -0.2])
        .raised(0.12);
    let off = beat(0.0, "ipsi-temple", [6.0, -1.5, 4.0])
        .with(Of("index-tip"))
        .facing([-0.45, 0.86, -0.1], [-0.85, -0.45, -0.1])
        .raised(0.12);
    Sign {
        hold: 0.26,
        right: Part {
            beats: vec![off, on, on.again(0.66)],
            shapes: vec![Shape("1", 0.0, 0.66)],
        },
        says: vec![
            Says(Placement(Right), "temple", 0.0, 0.66),
            Says(Movement(Right), "contact", 0.0, 0.26),
            Says(Direction(Right), "left", 0.0, 0.26),
            Says(Brows, "furrowed", 0.05, 0.66),
            Says(Head, "tilted-right", 0.2, 0.66),
        ],
        head: vec![Turn(0.3, [-2.0, 3.0, 4.0]), Turn(0.66, [-1.0, 3.0, 4.0])],
        ..sign("PENSER", ["penser", "to think"], 0.66)
    }
}

/// The hand of Y crawls over the back of the flat hand and turns slowly from side to side.
pub(crate) fn escargot() -> Sign {
    let crawl = |at: f64, along: f64, yaw: f64| {
        let (sine, cosine) = yaw.to_radians().sin_cos();
        beat(
            at,
            "neutral-space",
            [-4.0 + 6.0 * along, 2.5, -8.0 + 7.0 * along],
        )
        .facing([sine - 0.62, 0.05, cosine], DOWN)
        .raised(0.45)
    };
    let under = beat(0.0, "neutral-space", [1.0, -7.5, -5.0])
        .facing([-0.82, 0.0, 0.5], DOWN)
        .raised(0.3);
    Sign {
        right: Part {
            beats: vec![
                crawl(0.0, 0.0, -17.0),
                crawl(0.48, 0.25, 17.0),
                crawl(0.96, 0.5, -17.0),
                crawl(1.44, 0.75, 17.0),
                crawl(1.92, 1.0, -12.0),
            ],
            shapes: vec![Shape("Y", 0.0, 1.92)],
        },
        left: Part {
            beats: vec![under, under.again(1.92)],
            shapes: vec![Shape("flat", 0.0, 1.92)],
        },
        says: vec![
            Says(Placement(Right), "hand-back", 0.0, 1.92),
            Says(Placement(Left), "neutral", 0.0, 1.92),
            Says(Movement(Right), "swinging", 0.0, 1.92),
            Says(Movement(Left), "hold", 0.0, 1.92),
            Says(Direction(Right), "out", 0.0, 1.92),
        ],
        head: vec![Turn(0.2, [9.0, 2.0, 0.0]), Turn(1.92, [8.0, -2.0, 0.0])],
        trunk: vec![Turn(0.3, [2.0, 0.0, 0.0])],
        ..sign("ESCARGOT", ["escargot", "snail"], 1.92)
    }
}

/// Closed hands before the face open while they part and rise: light spreads.
pub(crate) fn clair() -> Sign {
    let side = Part {
        beats: vec![
            beat(0.0, "nose", [7.0, -12.0, 19.0]).facing([-0.3, 1.0, 0.3], [-0.45, -0.1, 1.0]),
            beat(0.16, "nose", [7.0, -12.0, 19.0]).facing([-0.3, 1.0, 0.3], [-0.45, -0.1, 1.0]),
            beat(0.72, "nose", [22.0, -4.0, 20.0])
                .facing([0.05, 1.0, 0.12], [-0.1, 0.0, 1.0])
                .bowed([0.0, 1.5, 2.5])
                .raised(0.15),
            beat(0.95, "nose", [22.0, -4.0, 20.0])
                .facing([0.05, 1.0, 0.12], [-0.1, 0.0, 1.0])
                .raised(0.15),
        ],
        shapes: vec![Shape("beak", 0.0, 0.24), Shape("5", 0.66, 0.95)],
    };
    Sign {
        hold: 0.72,
        right: side.clone(),
        left: side,
        says: vec![
            Says(Placement(Right), "before-face", 0.0, 0.95),
            Says(Placement(Left), "before-face", 0.0, 0.95),
            Says(Movement(Right), "opening", 0.16, 0.72),
            Says(Movement(Left), "opening", 0.16, 0.72),
            Says(Direction(Right), "up-right", 0.16, 0.72),
            Says(Direction(Left), "up-left", 0.16, 0.72),
            Says(Brows, "raised", 0.2, 0.95),
        ],
        head: vec![Turn(0.1, [4.0, 0.0, 0.0]), Turn(0.75, [-4.0, 0.0, 0.0])],
        ..sign("CLAIR", ["clair", "light, bright"], 0.95)
    }
}

/// The flat hand strokes up the chest and leaves it forward.
pub(crate) fn aimer() -> Sign {
    Sign {
        hold: 0.68,
        right: Part {
            beats: vec![
                beat(0.0, "chest", [1.0, -6.0, 2.2])
                    .facing([-1.0, 0.22, 0.12], [0.0, 0.0, -1.0])
                    .raised(0.25),
                beat(0.45, "upper-chest", [3.0, -1.0, 3.6])
                    .facing([-1.0, 0.4, 0.2], [0.0, 0.1, -1.0])
                    .bowed([0.0, 0.0, 0.6])
                    .raised(0.35),
                beat(0.68, "upper-chest", [8.0, 3.0, 13.0])
                    .facing([-0.8, 0.6, 0.45], [-0.1, 0.6, -0.8])
                    .bowed([0.0, 1.5, 0.0])
                    .raised(0.25),
                beat(0.84, "upper-chest", [8.0, 3.0, 13.0])
                    .facing([-0.8, 0.6, 0.45], [-0.1, 0.6, -0.8])
                    .raised(0.25),
            ],
            shapes: vec![Shape("flat", 0.0, 0.84)],
        },
        says: vec![
            Says(Placement(Right), "chest", 0.0, 0.28),
            Says(Placement(Right), "upper-chest", 0.34, 0.84),
            Says(Movement(Right), "brush", 0.0, 0.68),
            Says(Direction(Right), "up-out", 0.0, 0.68),
            Says(Brows, "raised", 0.0, 0.84),
            Says(Head, "nodding", 0.1, 0.84),
        ],
        head: vec![
            Turn(0.15, [-2.0, 0.0, 0.0]),
            Turn(0.5, [9.0, 0.0, 2.0]),
            Turn(0.84, [2.0, 0.0, 2.0]),
        ],
        trunk: vec![Turn(0.6, [2.5, 0.0, 0.0])],
        ..sign("AIMER", ["aimer", "to like"], 0.84)
    }
}

/// A fist comes down on the wrist of the other fist and stops there.
pub(crate) fn punir() -> Sign {
    let on = beat(0.26, "neutral-space", [-8.5, 0.9, -6.5])
        .facing([-0.35, -0.05, 1.0], IN)
        .raised(0.15);
    let under = beat(0.0, "neutral-space", [3.0, -9.0, -3.0])
        .facing([-0.75, 0.0, 0.65], DOWN)
        .raised(0.15);
    Sign {
        hold: 0.40,
        right: Part {
            beats: vec![
                beat(0.0, "neutral-space", [-4.0, 17.0, -6.0])
                    .facing([-0.3, 0.45, 1.0], IN)
                    .raised(0.1),
                on.bowed([0.0, 0.0, 2.0]),
                beat(0.33, "neutral-space", [-8.3, 1.7, -6.5])
                    .facing([-0.35, 0.0, 1.0], IN)
                    .raised(0.15),
                on.again(0.40),
                on.again(0.58),
            ],
            shapes: vec![Shape("S", 0.0, 0.58)],
        },
        left: Part {
            beats: vec![under, under.again(0.58)],
            shapes: vec![Shape("S", 0.0, 0.58)],
        },
        says: vec![
            Says(Placement(Right), "wrist", 0.0, 0.58),
            Says(Placement(Left), "neutral", 0.0, 0.58),
            Says(Movement(Right), "contact", 0.0, 0.40),
            Says(Movement(Left), "hold", 0.0, 0.58),
            Says(Direction(Right), "down", 0.0, 0.40),
            Says(Brows, "furrowed", 0.0, 0.58),
        ],
        head: vec![
            Turn(0.05, [1.0, 0.0, 0.0]),
            Turn(0.28, [7.0, 0.0, 0.0]),
            Turn(0.58, [5.0, 0.0, 0.0]),
        ],
        trunk: vec![Turn(0.28, [2.0, 0.0, 0.0])],
        ..sign("PUNIR", ["punir", "to punish"], 0.58)
    }
}

/// The letter W goes straight to the side and becomes an E.
pub(crate) fn week_end() -> Sign {
    let at = |at: f64, side: f64| {
        beat(at, "neutral-space", [side, 17.0, -8.0]).facing([0.0, 1.0, 0.22], OUT)
    };
    Sign {
        hold: 0.68,
        right: Part {
            beats: vec![at(0.0, 4.0), at(0.18, 4.0), at(0.68, 26.0), at(0.88, 26.0)],
            shapes: vec![Shape("W", 0.0, 0.30), Shape("E", 0.62, 0.88)],
        },
        says: vec![
            Says(Placement(Right), "high", 0.0, 0.30),
            Says(Placement(Right), "high-right", 0.56, 0.88),
            Says(Movement(Right), "straight", 0.18, 0.68),
            Says(Direction(Right), "right", 0.18, 0.68),
        ],
        head: vec![Turn(0.2, [2.0, 2.0, 0.0]), Turn(0.7, [2.0, -5.0, 0.0])],
        ..sign("WEEK-END", ["week-end", "weekend"], 0.88)
    }
}

/// A hand that holds something goes from the signer to the addressee.
pub(crate) fn donner() -> Sign {
    Sign {
        hold: 0.58,
        right: Part {
            beats: vec![
                beat(0.0, "neutral-space", [7.0, -1.0, -13.0])
                    .facing([-0.35, 0.1, 1.0], [0.0, 1.0, 0.1]),
                beat(0.58, "neutral-space", [6.0, 2.0, 14.0])
                    .facing([-0.1, 0.1, 1.0], [-0.1, 1.0, 0.0])
                    .bowed([0.0, 3.5, 0.0]),
                beat(0.78, "neutral-space", [6.0, 2.0, 14.0])
                    .facing([-0.1, 0.1, 1.0], [-0.1, 1.0, 0.0]),
            ],
            shapes: vec![Shape("beak-flat", 0.0, 0.78)],
        },
        says: vec![
            Says(Placement(Right), "near", 0.0, 0.18),
            Says(Placement(Right), "far", 0.40, 0.78),
            Says(Movement(Right), "arc", 0.0, 0.58),
            Says(Direction(Right), "out", 0.0, 0.58),
        ],
        head: vec![Turn(0.1, [5.0, -2.0, 0.0]), Turn(0.6, [2.0, 0.0, 0.0])],
        trunk: vec![Turn(0.5, [3.0, 0.0, 0.0])],
        ..sign("DONNER", ["donner", "to give"], 0.78)
    }
}

/// The hands of U are a cat's forepaws that step in turn.
pub(crate) fn chat() -> Sign {
    const STEP: f64 = 0.40;
    const STEPS: usize = 6;
    let paw = |first: usize| {
        let beats = (0..=STEPS).map(|n| {
            let front = (n + first).is_multiple_of(2);
            let at = beat(
                n as f64 * STEP,
                "neutral-space",
                [9.0, -6.0, if front { 7.0 } else { -6.0 }],
            );
            let at = if front {
                at.facing([-0.05, -0.12, 1.0], DOWN)
            } else {
                at.facing([-0.1, -0.40, 1.0], DOWN)
            };
            at.bowed([0.0, if front && n > 0 { 6.5 } else { 0.0 }, 0.0])
                .raised(0.2)
        });
        Part {
            beats: beats.collect(),
            shapes: vec![Shape("U", 0.0, STEP * STEPS as f64)],
        }
    };
    let length = STEP * STEPS as f64;
    Sign {
        right: paw(1),
        left: paw(0),
        says: vec![
            Says(Placement(Right), "neutral", 0.0, length),
            Says(Placement(Left), "neutral", 0.0, length),
            Says(Movement(Right), "arc", 0.0, length),
            Says(Movement(Left), "arc", 0.0, length),
            Says(Direction(Right), "out", 0.0, length),
            Says(Direction(Left), "out", 0.0, length),
            Says(Brows, "raised", 0.3, 1.9),
        ],
        head: vec![
            Turn(0.3, [5.0, 4.0, 0.0]),
            Turn(1.2, [5.0, -4.0, 0.0]),
            Turn(2.2, [4.0, 2.0, 0.0]),
        ],
        trunk: vec![
            Turn(0.4, [3.0, 0.0, 2.0]),
            Turn(0.8, [3.0, 0.0, -2.0]),
            Turn(1.2, [3.0, 0.0, 2.0]),
            Turn(1.6, [3.0, 0.0, -2.0]),
            Turn(2.0, [3.0, 0.0, 2.0]),
        ],
        ..sign("CHAT", ["chat (sa marche)", "cat (its walk)"], length)
    }
}

/// Both hands are the paws of an animal and stay where they are.
pub(crate) fn paws(gloss: &'static str, means: [&'static str; 2], shape: &'static str) -> Sign {
    const LENGTH: f64 = 0.6;
    let still = beat(0.0, "neutral-space", [14.0, 8.0, -2.0])
        .facing([-0.1, 0.35, 1.0], DOWN)
        .raised(0.2);
    let paw = Part {
        beats: vec![still, still.again(LENGTH)],
        shapes: vec![Shape(shape, 0.0, LENGTH)],
    };
    Sign {
        hold: 0.0,
        right: paw.clone(),
        left: paw,
        ..sign(gloss, means, LENGTH)
    }
}

/// Returns a sign of the right hand alone that stays `length` seconds at the place where words are spelt.
pub(crate) fn letter(
    gloss: &'static str,
    means: [&'static str; 2],
    shape: &'static str,
    length: f64,
) -> Sign {
    Sign {
        right: Part {
            beats: vec![beat(0.0, "ipsi-shoulder", [5.0, -12.0, 24.0]).with(Wrist)],
            shapes: vec![Shape(shape, 0.0, length)],
        },
        says: vec![Says(Placement(Right), "high-right", 0.0, length)],
        ..sign(gloss, means, length)
    }
}
