//! `amplify`: enlarges or shrinks the hands' paths about their middle.

use std::fmt::{self, Display, Formatter};

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::words::Text;
use chereme_sign::{Component, Handedness};
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::arm::Reach;
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::{Cause, RecipeError};
use crate::ops::place::{self, describe_reach};
use crate::ops::travel::wrist_path;
use crate::ops::{Description, Done, Field, FieldSetting, Operator, Syntax, say};
use crate::recipe::Solver;
use crate::text::{Parsed, Parser};
use crate::units::{Factor, Hands};
use crate::work::{Group, Work};

/// Settings of `amplify both 1.5`: enlarges the hands' paths about their middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Amplify {
    /// The hands whose movement changes; two hands have one common middle.
    #[serde(default = "crate::recipe::both")]
    pub hand: Hands,
    /// The factor for distances from the middle of the movement.
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

/// Multiplies the distances of the wrists from the middle of their movement.
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
    did.extend(describe_reach(&reach));
    Ok((did, reach.residual))
}

/// Scales the wrists' paths about their common middle.
pub(crate) fn scale(work: &mut Work, sides: &[Side], factor: f64) -> Result<Reach, Cause> {
    let mut middle = DVec3::ZERO;
    for &side in sides {
        let path = wrist_path(work, side)?;
        middle += path.iter().sum::<DVec3>() / (path.len() * sides.len()) as f64;
    }
    place::wrists(work, sides, Solver::Analytic, |_, _, at| {
        middle + (at - middle) * factor
    })
}
