//! A placement of the open recipe that can be dragged on the stage.

use chereme_corpus::recipe::{
    BodyDirection, HandChoice, MeasuredSpline, PlacementGoal, RecipeLength, StraightLeg, TravelSettings,
    mean_of_directions,
};
use chereme_motion::glam::DVec3;

/// A placement in the recipe, as its card holds it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacementHandle {
    /// The number of the card.
    pub(crate) card: u64,
    /// The hands that are placed.
    pub(crate) hand: HandChoice,
    pub(crate) to: PlacementGoal,
    /// The distance by which the hands were moved so far: metres to the left, up and forward.
    pub(crate) moved: Option<[f64; 3]>,
}

/// A path of the open recipe that can be pulled on the stage.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TravelCourse {
    /// The number of the card.
    pub(crate) card: u64,
    /// The path, as its card holds it.
    pub(crate) travel: TravelSettings,
}

impl TravelCourse {
    /// Returns the points on the path, in metres to the left, up and forward of the place where the hand would be
    /// without the path; `arm` is the length of the arm in metres.
    pub(crate) fn course_points(&self, arm: f64) -> Vec<DVec3> {
        points_of(&self.travel, arm)
    }

    /// Returns a dense sequence of positions along the path, in the same space as [`points`](Self::points).
    pub(crate) fn course_positions(&self, arm: f64) -> Vec<DVec3> {
        let points = self.course_points(arm);
        // A path of straight legs is its own line; a curve needs points in between.
        if self.travel.through.is_empty() {
            std::iter::once(DVec3::ZERO).chain(points).collect()
        } else {
            MeasuredSpline::new(&points).spline_drawing_points().to_vec()
        }
    }
}

impl PlacementHandle {
    /// Returns whether the goal is a point in body space rather than an offset of the hands.
    pub(crate) fn is_point(&self) -> bool {
        matches!(self.to, PlacementGoal::AtPoint(_))
    }

    /// Returns the value that a drag changes, in metres to the left, up and forward: the offset, the offset from
    /// another sign, or the point. For a named place, returns the distance moved so far, if it is known.
    pub(crate) fn handle_offset_value(&self, arm: f64) -> Option<[f64; 3]> {
        let sum = |legs: &[chereme_corpus::recipe::StraightLeg]| {
            let offsets = legs.iter().map(|leg| {
                mean_of_directions(&leg.towards).unwrap_or(DVec3::ZERO) * leg.distance.length_in_metres(arm)
            });
            offsets.sum::<DVec3>().to_array()
        };
        match &self.to {
            PlacementGoal::By(legs) => Some(sum(legs)),
            PlacementGoal::Near { by, .. } => Some(sum(by)),
            PlacementGoal::AtPoint(at) => Some(at.map(|length| length.length_in_metres(arm))),
            // A named place has no number of its own: its way so far stands for it.
            PlacementGoal::At(_) | PlacementGoal::Best(_) => self.moved,
        }
    }

    /// Returns the goal with another value; a named place becomes an offset.
    pub(crate) fn goal_with_value(&self, value: [f64; 3]) -> PlacementGoal {
        // A dragged handle is at no named place any more.
        match &self.to {
            PlacementGoal::By(_) | PlacementGoal::At(_) | PlacementGoal::Best(_) => {
                PlacementGoal::By(offset_legs(value))
            }
            PlacementGoal::Near { of, .. } => PlacementGoal::Near {
                of: of.clone(),
                by: offset_legs(value),
            },
            PlacementGoal::AtPoint(_) => PlacementGoal::AtPoint(value.map(RecipeLength::Metres)),
        }
    }
}

/// Returns the legs of an offset to the left, up and forward, in metres; an empty list for a zero offset.
pub(crate) fn legs_of(offset: [f64; 3]) -> Vec<StraightLeg> {
    let axes = [
        (BodyDirection::Left, BodyDirection::Right),
        (BodyDirection::Up, BodyDirection::Down),
        (BodyDirection::Forward, BodyDirection::Back),
    ];
    let leg = |(metres, (plus, minus)): (f64, (BodyDirection, BodyDirection))| StraightLeg {
        towards: vec![if metres < 0.0 { minus } else { plus }],
        distance: RecipeLength::Metres(metres.abs()),
        time: None,
    };
    let all = offset.into_iter().zip(axes);
    all.filter(|(metres, _)| *metres != 0.0).map(leg).collect()
}

/// Returns the legs of an offset; one leg of length zero for a zero offset, so that it remains an offset.
pub(crate) fn offset_legs(offset: [f64; 3]) -> Vec<StraightLeg> {
    let mut legs = legs_of(offset);
    if legs.is_empty() {
        legs.push(StraightLeg {
            towards: vec![BodyDirection::Up],
            distance: RecipeLength::Metres(0.0),
            time: None,
        });
    }
    legs
}

/// Returns the points of a path, in metres to the left, up and forward of its beginning: those of its curve, or the
/// ends of its legs.
pub(crate) fn points_of(travel: &TravelSettings, arm: f64) -> Vec<DVec3> {
    if !travel.through.is_empty() {
        let point = |at: &[RecipeLength; 3]| DVec3::from(at.map(|length| length.length_in_metres(arm)));
        return travel.through.iter().map(point).collect();
    }
    let mut position = DVec3::ZERO;
    let legs = travel.path.iter();
    legs.map(|leg| {
        position += mean_of_directions(&leg.towards).unwrap_or_default() * leg.distance.length_in_metres(arm);
        position
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::recipe::{Recipe, RecipeNode, Step};

    fn handle(text: &str) -> PlacementHandle {
        let recipe: Recipe = format!("A | {text}").parse().expect(text);
        let RecipeNode::Pipe(pipe) = recipe.recipe_root() else {
            panic!("no pipe")
        };
        let [Step::Place(place)] = pipe.steps.as_slice() else {
            panic!("no place")
        };
        PlacementHandle {
            card: 1,
            hand: place.hand,
            to: place.to.clone(),
            moved: Some([0.1, 0.2, 0.3]),
        }
    }

    #[test]
    fn the_position_of_every_placement_is_read_and_written_back() {
        for (text, value) in [
            ("place both by left 25cm", [0.25, 0.0, 0.0]),
            ("place right by down 5cm forward 10%", [0.0, -0.05, 0.06]),
            ("place left near BOL by up 5cm", [0.0, 0.05, 0.0]),
            ("place right at 5cm,140cm,30cm", [0.05, 1.4, 0.3]),
            ("place right at chin", [0.1, 0.2, 0.3]),
        ] {
            let handle = handle(text);
            let read = handle.handle_offset_value(0.6).expect("a value");
            let off = DVec3::from(read).distance(DVec3::from(value));
            assert!(off < 1e-9, "{text}: {read:?}");
            let moved = PlacementHandle {
                to: handle.goal_with_value([-0.1, 0.0, 0.035]),
                ..handle.clone()
            };
            let again = moved.handle_offset_value(0.6).expect("a value");
            assert!(DVec3::from(again).distance(DVec3::new(-0.1, 0.0, 0.035)) < 1e-9);
            assert_eq!(moved.is_point(), handle.is_point());
        }
        let named = handle("place right at chin");
        assert!(matches!(named.goal_with_value([0.0, 0.1, 0.0]), PlacementGoal::By(_)));
        assert_eq!(PlacementHandle { moved: None, ..named }.handle_offset_value(0.6), None);
        let near = handle("place left near BOL by up 5cm");
        assert!(matches!(near.goal_with_value([0.0; 3]), PlacementGoal::Near { of, .. } if of == "BOL"));
    }
}
