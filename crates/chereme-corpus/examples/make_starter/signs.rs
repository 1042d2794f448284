//! The signs of the founding paper in HamNoSys, as plausible forms of LSF: approximations, not recorded from any
//! signer.

use chereme_motion::BodySide::{self, Left, Right};
use chereme_sign::hamnosys::{NonmanualAct, NonmanualPart, NonmanualPart as Of, NotatedSign, parse_hamnosys};
use chereme_sign::inventory::{InventoryValue, builtin_by_id};

use super::notes::{DIRECTION, MOVEMENT, PLACEMENT};

/// One sign.
#[derive(Clone, Debug)]
pub(crate) struct Sign {
    /// The gloss, in French capitals as usual.
    pub(crate) gloss: String,
    /// Its meaning in French and in English.
    pub(crate) means: [&'static str; 2],
    /// The names of its symbols, without the prefix `ham`.
    pub(crate) symbols: &'static str,
    /// The activity of body and head, by the codes of SiGML, and its amount; brows are annotated only, not moved.
    pub(crate) acts: &'static [(NonmanualPart, &'static str, f64)],
    /// Values that are more precise than the symbols, or one of several simultaneous values.
    pub(crate) finer: &'static [Finer],
}

/// Values of a tier in order, by the index of the tier and the hand, which replace those of the notation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finer(
    pub(crate) usize,
    pub(crate) Option<BodySide>,
    pub(crate) &'static [&'static str],
);

impl Sign {
    /// Returns the names of its symbols.
    pub(crate) fn hamnosys(&self) -> String {
        let names = self.symbols.split_whitespace();
        names.map(|name| format!("ham{name}")).collect::<Vec<_>>().join(" ")
    }

    /// Returns the sign in the form for the animator.
    pub(crate) fn notated(&self) -> NotatedSign {
        let read = parse_hamnosys(&self.hamnosys());
        let read = read.unwrap_or_else(|error| panic!("{}: {error}", self.gloss));
        assert!(read.findings.is_empty(), "{}: {:?}", self.gloss, read.findings);
        let mut notated = NotatedSign {
            gloss: self.gloss.clone(),
            sign: read.sign,
            ..NotatedSign::default()
        };
        for &(part, code, amount) in self.acts {
            let act = NonmanualAct {
                amount: Some(amount),
                ..NonmanualAct::new(part, code)
            };
            notated.nonmanual.push_act_group(part.sigml_tier(), vec![act]);
        }
        notated
    }
}

fn sign(gloss: &str, means: [&'static str; 2], symbols: &'static str) -> Sign {
    Sign {
        gloss: gloss.to_owned(),
        means,
        symbols,
        acts: &[],
        finer: &[],
    }
}

/// The flat hand strokes up the chest and moves forward from it.
pub(crate) fn aimer() -> Sign {
    Sign {
        acts: &[(Of::Head, "NO", 0.5), (Of::Brows, "RB", 1.0)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["chest", "upper-chest"]),
            Finer(MOVEMENT, Some(Right), &["brush"]),
        ],
        ..sign(
            "AIMER",
            ["aimer", "to like"],
            "flathand extfingerl palml chest touch moveu seqbegin brushing shoulders between chest touch seqend moveuo smallmod",
        )
    }
}

/// Two hollow hands side by side, palms up, draw the walls of a bowl.
pub(crate) fn bol() -> Sign {
    Sign {
        acts: &[(Of::Head, "NF", 0.4)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["neutral"]),
            Finer(PLACEMENT, Some(Left), &["neutral"]),
        ],
        ..sign(
            "BOL",
            ["bol", "bowl"],
            "symmlr flathand fingerbendmod extfingero palmu parbegin pinkyside plus pinkyside parend close neutralspace \
             parbegin moveur arcd replace extfingero palmul parend",
        )
    }
}

/// The hands of U are a cat's forepaws that step in turn.
pub(crate) fn chat() -> Sign {
    Sign {
        acts: &[(Of::Body, "TF", 0.3), (Of::Brows, "RB", 1.0)],
        finer: &[
            Finer(MOVEMENT, Some(Right), &["arc"]),
            Finer(MOVEMENT, Some(Left), &["arc"]),
            Finer(DIRECTION, Some(Right), &["out"]),
            Finer(DIRECTION, Some(Left), &["out"]),
        ],
        ..sign(
            "CHAT",
            ["chat (sa marche)", "cat (its walk)"],
            "symmlr finger23 thumbacrossmod extfingero palmd \
             parbegin moveo smallmod arcu plus movei smallmod parend \
             seqbegin parbegin movei plus moveo arcu parend parbegin moveo arcu plus movei parend seqend \
             repeatcontinue",
        )
    }
}

/// The flat hand pats the signer's side twice, like someone who calls a dog.
pub(crate) fn chien() -> Sign {
    Sign {
        acts: &[(Of::Body, "TR", 0.4)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["hip"]),
            Finer(MOVEMENT, Some(Right), &["tap"]),
        ],
        ..sign(
            "CHIEN",
            ["chien", "dog"],
            "flathand extfingerd palmdl belowstomach lrat close \
             moveil smallmod belowstomach lrat touch repeatfromstart",
        )
    }
}

/// Closed hands before the face open while they separate and rise: light spreads.
pub(crate) fn clair() -> Sign {
    Sign {
        acts: &[(Of::Head, "NB", 0.4), (Of::Brows, "RB", 1.0)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["before-face"]),
            Finer(PLACEMENT, Some(Left), &["before-face"]),
            Finer(MOVEMENT, Some(Right), &["opening"]),
            Finer(MOVEMENT, Some(Left), &["opening"]),
        ],
        ..sign(
            "CLAIR",
            ["clair", "light, bright"],
            "symmlr pinchall extfingeru palmd close chin \
             parbegin moveur largemod replace finger2345 thumboutmod parend slow",
        )
    }
}

/// A hand that holds something goes from the signer to the addressee.
pub(crate) fn donner() -> Sign {
    Sign {
        acts: &[(Of::Body, "TF", 0.3)],
        finer: &[Finer(PLACEMENT, Some(Right), &["near", "far"])],
        ..sign(
            "DONNER",
            ["donner", "to give"],
            "pinchall fingerstraightmod extfingero palmu chest lrat close moveo largemod arcu",
        )
    }
}

/// The hand of Y crawls over the back of the flat hand and turns slowly from side to side.
pub(crate) fn escargot() -> Sign {
    Sign {
        acts: &[(Of::Head, "NF", 0.4)],
        finer: &[
            Finer(MOVEMENT, Some(Right), &["swinging"]),
            Finer(PLACEMENT, Some(Left), &["neutral"]),
        ],
        ..sign(
            "ESCARGOT",
            ["escargot", "snail"],
            "parbegin finger2 thumboutmod pinky plus flathand parend \
             parbegin extfingerol plus extfingeror parend parbegin palmd between palmdl plus palmd parend \
             parbegin ringfinger fingermidjoint plus handback parend touch \
             parbegin moveo smallmod swinging repeatcontinueseveral parend slow",
        )
    }
}

/// The tip of the index comes to the temple.
pub(crate) fn penser() -> Sign {
    Sign {
        acts: &[(Of::Head, "TR", 0.4), (Of::Brows, "FU", 1.0)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["temple"]),
            Finer(MOVEMENT, Some(Right), &["contact"]),
        ],
        ..sign(
            "PENSER",
            ["penser", "to think"],
            "finger2 thumbacrossmod extfingerul palmdl forehead lrat between ear lrat close movel smallmod forehead lrat between ear lrat touch",
        )
    }
}

/// A fist comes down on the wrist of the other fist and stops there.
pub(crate) fn punir() -> Sign {
    Sign {
        acts: &[(Of::Head, "NF", 0.5), (Of::Brows, "FU", 1.0)],
        finer: &[
            Finer(PLACEMENT, Some(Right), &["wrist"]),
            Finer(PLACEMENT, Some(Left), &["neutral"]),
            Finer(MOVEMENT, Some(Right), &["contact"]),
        ],
        ..sign(
            "PUNIR",
            ["punir", "to punish"],
            "parbegin fist thumbacrossmod plus fist thumbacrossmod parend parbegin extfingero plus extfingeror parend \
             parbegin palml plus palmd parend \
             parbegin chest plus stomach parend moved parbegin pinkyside plus wristback parend touch halt",
        )
    }
}

/// The letter W goes straight to the side and becomes an E.
pub(crate) fn week_end() -> Sign {
    Sign {
        finer: &[
            Finer(PLACEMENT, Some(Right), &["high", "high-right"]),
            Finer(MOVEMENT, Some(Right), &["straight"]),
        ],
        ..sign(
            "WEEK-END",
            ["week-end", "weekend"],
            "finger23spread thumbacrossmod indexfinger middlefinger ringfinger extfingeru palmd shoulders lrat \
             parbegin mover largemod replace flathand thumbacrossmod doublehooked parend",
        )
    }
}

/// Returns signs for the paws of three animals, which the hands only hold.
pub(crate) fn paws() -> Vec<Sign> {
    vec![
        sign(
            "LION",
            ["lion (sa patte)", "lion (its paw)"],
            "symmlr finger2345 thumboutmod fingerbendmod extfingero palmd chest nomotion",
        ),
        sign(
            "POULE",
            ["poule (sa patte)", "hen (its foot)"],
            "symmlr finger23spread thumboutmod extfingero palmd chest nomotion",
        ),
        sign(
            "VACHE",
            ["vache (son sabot)", "cow (its hoof)"],
            "symmlr fist thumbacrossmod extfingero palmd chest nomotion",
        ),
    ]
}

/// Returns the letters of the French manual alphabet as notated in the inventory, beside the right shoulder, or lower
/// if the hand points down; each gloss is `DS:` and the letter.
pub(crate) fn letters() -> Vec<Sign> {
    let alphabet = builtin_by_id("lsf-alphabet").map_or(&[][..], |inventory| &inventory.values);
    alphabet.iter().filter_map(letter).collect()
}

fn letter(value: &'static InventoryValue) -> Option<Sign> {
    let names: Vec<&str> = value.hamnosys.as_deref()?.split(' ').collect();
    let palm = names.iter().position(|name| name.starts_with("hampalm"))?;
    let (posture, action) = names.split_at(palm + 1);
    let height = match names.contains(&"hamextfingerd") {
        true => "hamchest",
        false => "hamshoulders",
    };
    let place = [height, "hamlrbeside"];
    let symbols = [posture, &place, action].concat().join(" ");
    let means = ["fr", "en"].map(|language| value.value_name_in(language));
    let symbols: &'static str = symbols.replace("ham", "").leak();
    let finer: &[Finer] = match value.id.as_str() {
        "J" => &[Finer(MOVEMENT, Some(Right), &["arc"])],
        "Z" => &[Finer(MOVEMENT, Some(Right), &["zigzag"])],
        _ => &[],
    };
    Some(Sign {
        finer,
        ..sign(&format!("DS:{}", value.id), means, symbols)
    })
}
