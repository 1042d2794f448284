//! `amplify`: enlarges or shrinks the hands' paths about their middles.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::words::Text;
use chereme_sign::{Component, Handedness};
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::arm::Reach;
use crate::check;
use crate::contact::{self, BLEND, Carry, Keep, blended};
use crate::error::{Cause, RecipeError};
use crate::ops::place::{self, describe_reach};
use crate::ops::travel::wrist_path;
use crate::ops::{Description, Done, Field, FieldSetting, Operator, Syntax, say};
use crate::recipe::Solver;
use crate::stroke::SignStroke;
use crate::text::{Parsed, Parser};
use crate::units::{Factor, Hands};
use crate::work::{Group, Work};

/// Settings of `amplify both 1.5`: enlarges the hands' paths about their middles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Amplify {
    /// The hands whose movement changes, each about the middle of its own path; hands that touch each other stay
    /// together.
    #[serde(default = "crate::recipe::both")]
    pub hand: Hands,
    /// The factor for distances from the middle of the path.
    pub by: Factor,
}

impl Syntax for Amplify {
    const NAME: &'static str = "amplify";
    const DESCRIPTION: Description = Description {
        title: Text::new("Size", "Ampleur"),
        hint: Text::new(
            "larger or smaller movement",
            "mouvement plus ample ou plus petit",
        ),
        examples: &[(
            "amplify both 1.5",
            Text::new("larger paths", "de plus grands trajets"),
        )],
        messages: &[
            Text::new(
                "the hands' paths are {share} as large",
                "les trajets des mains font {share} de leur taille",
            ),
            Text::new("nothing to do", "rien à faire"),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        Ok(Self {
            hand: parser.hand().unwrap_or(Hands::Both),
            by: parser.quantity("a factor, such as 1.5 or 150%")?,
        })
    }

    fn usual() -> Self {
        Self {
            hand: Hands::Both,
            by: Factor(1.5),
        }
    }
}

impl Display for Amplify {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "amplify {} {}", self.hand.name(), self.by)
    }
}

impl Operator for Amplify {
    fn check(&self) -> Result<(), RecipeError> {
        check::range(Self::NAME, "the factor", self.by.0, 0.0, 20.0)
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(amplify(work, self, given.text)?.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::All(self.hand.sides(handedness))))
    }

    fn is_nothing(&self) -> bool {
        self.by == Factor(1.0)
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let size = Text::new("Size", "Ampleur");
        vec![
            FieldSetting::hands(&mut self.hand),
            FieldSetting::new(size, Field::Factor(&mut self.by, 0.0..=3.0)),
        ]
    }
}

/// The factor below which a hand hardly moves any more.
const STANDS: f64 = 0.1;

/// Multiplies the distances of the wrists from the middles of their movement.
pub(crate) fn amplify(
    work: &mut Work,
    settings: &Amplify,
    operator: &str,
) -> Result<(Vec<String>, f64), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let factor = settings.by.0;
    if factor == 1.0 {
        return Ok((vec!["nothing to do".into()], 0.0));
    }
    let rest = SignStroke::of_work(work)?.describe_rests(work);
    let reach = scale(work, sides, factor)?;
    let stands = factor < STANDS;
    say::withdraw(work, sides, operator, |component, feature| {
        component == Component::Movement
            && (feature == Some("size") || stands && feature != Some("phase"))
    });
    work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
    let mut did = vec![format!(
        "the hands' paths are {:.0}% as large",
        factor * 100.0
    )];
    did.extend(rest);
    did.extend(describe_reach(&reach));
    Ok((did, reach.residual))
}

/// Scales the wrists' paths, each about its own middle, so that parallel paths stay parallel and a resting hand rests.
/// While the hands touch each other, they keep their positions relative to each other.
pub(crate) fn scale(work: &mut Work, sides: &[Side], factor: f64) -> Result<Reach, Cause> {
    let stroke = SignStroke::of_work(work)?;
    let blend = (BLEND / work.rate.frame_time()).round() as usize;
    let mut paths = WristPaths::default();
    for &side in sides {
        let path = wrist_path(work, side)?;
        let middle = path[stroke.frames.clone()].iter().sum::<DVec3>() / stroke.frames.len() as f64;
        let beside = path.iter().map(|at| *at - middle).collect();
        paths.0[usize::from(side == Side::Left)] = beside;
    }
    let touching: BTreeSet<usize> = contact::touches(work).between_hands().collect();
    let touching: Vec<usize> = touching
        .into_iter()
        .filter(|f| stroke.frames.contains(f))
        .collect();
    let mean = touching
        .iter()
        .map(|&frame| paths.apart(frame))
        .sum::<DVec3>();
    let mean = mean / touching.len().max(1) as f64;
    let mut slides = vec![None; work.frames];
    for frame in touching {
        slides[frame] = Some((factor - 1.0) * (paths.apart(frame) - mean));
    }
    let slides = blended(&slides, blend);
    let shares = paths.shares(&stroke);
    place::wrists(work, sides, Solver::Analytic, &stroke, |side, frame, at| {
        let hand = usize::from(side == Side::Left);
        let own = (factor - 1.0) * paths.0[hand][frame];
        let relation = (1.0 - factor) * mean - slides[frame];
        at + own + relation * shares[hand]
    })
}

/// The positions of the right and the left wrist relative to the middles of their paths; empty for a hand that keeps
/// its path.
#[derive(Default)]
struct WristPaths([Vec<DVec3>; 2]);

impl WristPaths {
    /// Returns the right wrist's position minus the left one's.
    fn apart(&self, frame: usize) -> DVec3 {
        let [right, left] = self.0.each_ref().map(|path| path.get(frame).copied());
        right.unwrap_or_default() - left.unwrap_or_default()
    }

    /// Returns the share of each hand in what keeps them together, by the size of their paths; that of the left hand is
    /// negative.
    fn shares(&self, stroke: &SignStroke) -> [f64; 2] {
        let size = |path: &Vec<DVec3>| {
            let frames = path.get(stroke.frames.clone()).unwrap_or_default();
            frames.iter().map(|at| at.length_squared()).sum::<f64>()
        };
        let [right, left] = self.0.each_ref().map(size);
        let all = (right + left).max(f64::MIN_POSITIVE);
        [right / all, -left / all]
    }
}
