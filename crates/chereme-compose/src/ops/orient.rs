//! `orient`: rotates the hands in the world; they keep their movement and their own rotations.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{ModelPose, Side};
use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::arm::{self, Reach};
use crate::body::Frame;
use crate::error::Cause;
use crate::ops::{Description, place, say};
use crate::recipe::Solver;
use crate::stroke::SignStroke;
use crate::units::towards;
use crate::work::{Columns, Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Done, Operator, Syntax};
use crate::text::{Parsed, Parser, list};
use crate::units::{Degrees, Direction, Hands};

/// Settings of `orient right palm up`, `orient right fingers forward palm down`, `orient both by 30deg about up`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Orient {
    /// The hands that turn.
    #[serde(default = "crate::recipe::dominant")]
    pub hand: Hands,
    /// The direction of the palm in the middle of the sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub palm: Vec<Direction>,
    /// The direction of straight fingers in the middle of the sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<Direction>,
    /// Rotations about the signer's own directions, right-handed, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by: Vec<Turn>,
}

/// A rotation about one of the signer's directions: `30deg about up`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The angle; positive is counter-clockwise, seen against the direction.
    pub angle: Degrees,
    /// The axis.
    pub about: Direction,
}

impl Syntax for Orient {
    const NAME: &'static str = "orient";
    const KEYWORDS: &'static [&'static str] = &["palm", "fingers", "about"];
    const DESCRIPTION: Description = Description {
        title: Text::new("Orientation", "Orientation"),
        hint: Text::new("the hands turned", "les mains tournées"),
        examples: &[
            (
                "orient right palm up fingers forward",
                Text::new(
                    "another direction of palm and fingers",
                    "une autre direction de la paume et des doigts",
                ),
            ),
            (
                "orient right by 30deg about up",
                Text::new("turned about a direction", "tournée autour d’un axe"),
            ),
        ],
        messages: &[
            Text::new(
                "the {side} hand is turned by {angle}",
                "la main {side} est tournée de {angle}",
            ),
            Text::new(
                "the {limb} wrist bends by {angle}, more than wrists can",
                "le poignet {limb} se plie de {angle}, plus qu’un poignet ne peut",
            ),
            Text::new(
                "neither palm nor fingers nor a turn is given",
                "ni la paume, ni les doigts, ni une rotation ne sont donnés",
            ),
            Text::new(
                "the palm faces across the fingers, so both cannot have the same direction or opposite ones",
                "la paume est tournée en travers des doigts : ils ne peuvent avoir ni la même direction, ni des directions opposées",
            ),
            Text::new("\"about\" and a direction", "\"about\" et une direction"),
            Text::new(
                "\"palm\", \"fingers\" or \"by\"",
                "\"palm\", \"fingers\" ou \"by\"",
            ),
            Text::new("an angle, such as {example}", "un angle, comme {example}"),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let mut orient = Self {
            hand: parser.hand().unwrap_or(Hands::Dominant),
            palm: Vec::new(),
            fingers: Vec::new(),
            by: Vec::new(),
        };
        let mut some = false;
        loop {
            if parser.accept("palm") {
                orient.palm = parser.directions()?;
            } else if parser.accept("fingers") {
                orient.fingers = parser.directions()?;
            } else if parser.accept("by") {
                let angle = parser.quantity("an angle, such as 30deg")?;
                parser.expect("about", "\"about\" and a direction")?;
                let about = parser.direction().ok_or_else(|| parser.no_direction())?;
                orient.by.push(Turn { angle, about });
            } else if some {
                return Ok(orient);
            } else {
                let words = ["palm", "fingers", "by"];
                return Err(parser.expected("\"palm\", \"fingers\" or \"by\"", &words));
            }
            some = true;
        }
    }

    fn usual() -> Self {
        Self {
            hand: Hands::Dominant,
            palm: vec![Direction::Up],
            fingers: Vec::new(),
            by: Vec::new(),
        }
    }
}

impl Display for Orient {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "orient {}", self.hand.name())?;
        for (word, directions) in [("palm", &self.palm), ("fingers", &self.fingers)] {
            if !directions.is_empty() {
                write!(f, " {word} ")?;
                list(f, directions.iter().map(|d| d.name()), " ")?;
            }
        }
        for turn in &self.by {
            write!(f, " by {} about {}", turn.angle, turn.about.name())?;
        }
        Ok(())
    }
}

impl Operator for Orient {
    fn check(&self) -> Result<(), RecipeError> {
        if self.palm.is_empty() && self.fingers.is_empty() && self.by.is_empty() {
            return Err(RecipeError::Empty {
                step: Self::NAME,
                what: "neither palm nor fingers nor a turn is given",
            });
        }
        for directions in [&self.palm, &self.fingers] {
            if !directions.is_empty() {
                check::directions(Self::NAME, directions)?;
            }
        }
        if let (Some(palm), Some(fingers)) = (towards(&self.palm), towards(&self.fingers))
            && palm.cross(fingers).length() < 1e-6
        {
            return Err(RecipeError::Empty {
                step: Self::NAME,
                what: "the palm faces across the fingers, so both cannot have the same direction or opposite ones",
            });
        }
        let angle = |turn: &Turn| turn.angle.0;
        let mut angles = self.by.iter().map(angle);
        angles.try_for_each(|angle| check::range(Self::NAME, "the angle", angle, -360.0, 360.0))
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(orient(work, self, given.text)?.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::All(self.hand.sides(handedness))))
    }
}

/// The largest bend of wrists, in degrees: flexion reaches about 80, extension 70.
const MOST_BEND: f64 = 85.0;

/// Applies one rotation in the world to each hand over the whole stroke, so that in its middle palm and fingers have the
/// wanted directions.
pub(crate) fn orient(
    work: &mut Work,
    settings: &Orient,
    operator: &str,
) -> Result<(Vec<String>, f64), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let stroke = SignStroke::of_work(work)?;
    let middle = stroke.middle_frame();
    let mut worst = Reach::default();
    let mut did = Vec::new();
    for &side in sides {
        let turn = turn(work, &frame, middle, side, settings)?;
        let hand = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
        let columns = Columns::of(work, [hand]);
        let hands = columns.rotations(hand).iter().enumerate();
        let hands: Vec<DQuat> = hands
            .map(|(at, hand)| stroke.turn_share(at, turn) * *hand)
            .collect();
        let targets = columns.positions(hand).to_vec();
        let reach = arm::move_wrist(
            work,
            side,
            &columns,
            &targets,
            Some(&hands),
            Solver::Analytic,
        );
        worst = worst.worse(reach.ok_or(Cause::NoArm(side))?);
        let angle = DQuat::IDENTITY.angle_between(turn).to_degrees();
        did.push(format!("the {} hand is turned by {angle:.0}°", side.name()));
        let bend = wrist_bend(work, side).to_degrees();
        if bend > MOST_BEND {
            did.push(format!(
                "the {} wrist bends by {bend:.0}°, more than wrists can",
                side.name()
            ));
        }
    }
    say::withdraw(work, sides, operator, |component, _| {
        component == Component::Orientation
    });
    for &side in sides {
        record_directions(work, &frame, middle, side, operator);
    }
    did.extend(stroke.describe_rests(work));
    work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
    Ok((did, worst.residual))
}

/// The largest rotation away from the hand's directions in the middle of the sign, in radians, at which the values of
/// these directions still hold.
const SAME: f64 = 0.5;

/// Notes the directions of palm and fingers around the frame `middle`.
fn record_directions(work: &mut Work, frame: &Frame, middle: usize, side: Side, operator: &str) {
    let directions = |work: &Work, at: usize| {
        let model = ModelPose::of(&work.skeleton, &work.pose(at));
        let fingers = work.anatomy.hand_direction(side, &model)?;
        let palm = work.anatomy.palm_normal(side, &model)?;
        Some([fingers, palm].map(|direction| frame.to_body(direction)))
    };
    let Some([fingers, palm]) = directions(work, middle) else {
        return;
    };
    let same = |at: &usize| {
        directions(work, *at)
            .is_some_and(|[f, p]| f.angle_between(fingers) < SAME && p.angle_between(palm) < SAME)
    };
    let start = middle - (0..middle).rev().take_while(same).count();
    let end = middle + (middle..work.frames).take_while(same).count();
    let values = [
        ("fingers", say::direction(fingers)),
        ("palm", say::palm(fingers, palm).map(str::to_owned)),
    ];
    for (feature, value) in values {
        let what = (Component::Orientation, Some(feature));
        if let Some(value) = value {
            say::record(
                work,
                side,
                what,
                &value,
                start..end.max(start + 1),
                operator,
            );
        }
    }
}

/// Returns the largest angle between a forearm and its hand, in radians.
fn wrist_bend(work: &Work, side: Side) -> f64 {
    let Some(arm) = work.anatomy.arm(side) else {
        return 0.0;
    };
    let rest = work.skeleton.rest_model_pose();
    let Some(along) = work.anatomy.hand_direction(side, &rest) else {
        return 0.0;
    };
    let along = rest.rotation(arm.hand).inverse() * along;
    let columns = Columns::of(work, [arm.hand]);
    let (elbows, wrists) = (columns.positions(arm.forearm), columns.positions(arm.hand));
    let turned = columns.rotations(arm.hand);
    (0..work.frames)
        .map(|f| (wrists[f] - elbows[f]).angle_between(turned[f] * along))
        .filter(|bend| bend.is_finite())
        .fold(0.0, f64::max)
}

/// Returns the rotation in model space for the settings at the frame `middle`.
fn turn(
    work: &Work,
    frame: &Frame,
    middle: usize,
    side: Side,
    settings: &Orient,
) -> Result<DQuat, Cause> {
    let model = ModelPose::of(&work.skeleton, &work.pose(middle));
    let anatomy = &work.anatomy;
    let hand = anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
    let none = || Cause::NoFingers(side);
    let palm = anatomy.palm_normal(side, &model).ok_or_else(none)?;
    let fingers = anatomy.hand_direction(side, &model).ok_or_else(none)?;
    let wanted = |directions: &[_]| towards(directions).map(|v| frame.direction(v));
    let mut turn = match (wanted(&settings.palm), wanted(&settings.fingers)) {
        (None, None) => DQuat::IDENTITY,
        (Some(to), None) => arc(palm, to, fingers),
        (None, Some(to)) => arc(fingers, to, palm),
        (Some(palm_to), Some(to)) => {
            let across = palm_to.reject_from_normalized(to);
            let rotation = anatomy.hand_rotation(side, to, across).ok_or_else(none)?;
            rotation * model.rotation(hand).inverse()
        }
    };
    for step in &settings.by {
        let axis = frame.direction(step.about.vector());
        turn = DQuat::from_axis_angle(axis, step.angle.0.to_radians()) * turn;
    }
    Ok(turn.normalize())
}

/// Returns the shortest rotation from `from` to `to`; about `axis` if they are opposite.
fn arc(from: DVec3, to: DVec3, axis: DVec3) -> DQuat {
    if from.dot(to) < -1.0 + 1e-9 {
        return DQuat::from_axis_angle(axis, std::f64::consts::PI);
    }
    DQuat::from_rotation_arc(from, to)
}
