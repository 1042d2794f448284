//! What is to be signed: places, directions and handshapes over time, as a choreographer notes them.

use chereme_motion::Side;

/// The point of the hand that comes to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Point {
    /// The wrist.
    Wrist,
    /// A landmark of the hand without its side, such as `palm` or `index-tip`.
    Of(&'static str),
}

/// Where a hand is at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beat {
    /// Seconds from the start of the sign.
    pub(crate) at: f64,
    /// A landmark of the body; `ipsi-` at its start is the hand's own side.
    pub(crate) landmark: &'static str,
    /// From the landmark, in centimetres: towards the hand's own side, up, forward.
    pub(crate) offset: [f64; 3],
    /// The point of the hand that is there.
    pub(crate) point: Point,
    /// Where the hand points, and where its palm faces: to the hand's own side, up, forward.
    pub(crate) fingers: [f64; 3],
    /// Where the palm faces.
    pub(crate) palm: [f64; 3],
    /// How far the way to this moment bows out in its middle, in centimetres, in the same directions.
    pub(crate) bow: [f64; 3],
    /// How far the elbow is raised, from 0 to 1.
    pub(crate) elbow: f64,
}

/// Returns a beat with the palm in neutral space, facing inwards.
pub(crate) const fn beat(at: f64, landmark: &'static str, offset: [f64; 3]) -> Beat {
    Beat {
        at,
        landmark,
        offset,
        point: Point::Of("palm"),
        fingers: [0.0, 0.0, 1.0],
        palm: [-1.0, 0.0, 0.0],
        bow: [0.0; 3],
        elbow: 0.0,
    }
}

impl Beat {
    /// Returns the beat with the hand pointing and the palm facing so.
    pub(crate) const fn facing(self, fingers: [f64; 3], palm: [f64; 3]) -> Self {
        Self {
            fingers,
            palm,
            ..self
        }
    }

    /// Returns the beat with another point of the hand at the place.
    pub(crate) const fn with(self, point: Point) -> Self {
        Self { point, ..self }
    }

    /// Returns the beat with the way to it bowed.
    pub(crate) const fn bowed(self, bow: [f64; 3]) -> Self {
        Self { bow, ..self }
    }

    /// Returns the beat with the elbow raised.
    pub(crate) const fn raised(self, elbow: f64) -> Self {
        Self { elbow, ..self }
    }

    /// Returns the same at another moment.
    pub(crate) const fn again(self, at: f64) -> Self {
        Self { at, ..self }
    }
}

/// A handshape that is held: a value of the inventory `configurations`, from and to in seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape(pub(crate) &'static str, pub(crate) f64, pub(crate) f64);

/// What one hand does in a sign; a hand without beats rests.
#[derive(Clone, Debug, Default)]
pub(crate) struct Part {
    /// In order of time; the first at 0, the last at the sign's length.
    pub(crate) beats: Vec<Beat>,
    /// In order of time.
    pub(crate) shapes: Vec<Shape>,
}

/// A value said of a stretch of the sign on a tier, in seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Says(
    pub(crate) Tier,
    pub(crate) &'static str,
    pub(crate) f64,
    pub(crate) f64,
);

/// The tiers whose values the score tells; handshapes and orientations follow from the movement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Tier {
    /// Where the hand is.
    Placement(Side),
    /// What kind of movement it makes.
    Movement(Side),
    /// Where it moves.
    Direction(Side),
    /// The eyebrows, which the skeleton does not have.
    Brows,
    /// The head.
    Head,
}

/// A turn of head or trunk that is reached at a moment: nod, turn to the left, tilt to the right, in degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn(pub(crate) f64, pub(crate) [f64; 3]);

/// One sign.
#[derive(Clone, Debug)]
pub(crate) struct Sign {
    /// The name, in French capitals as usual.
    pub(crate) gloss: &'static str,
    /// What it means in French and in English.
    pub(crate) means: [&'static str; 2],
    /// How long the stroke and its hold take, in seconds.
    pub(crate) length: f64,
    /// From when on the hands hold still, in seconds; the length where they do not.
    pub(crate) hold: f64,
    /// The right hand, which is dominant.
    pub(crate) right: Part,
    /// The left hand.
    pub(crate) left: Part,
    /// What is said of it.
    pub(crate) says: Vec<Says>,
    /// What the head does.
    pub(crate) head: Vec<Turn>,
    /// What the trunk does.
    pub(crate) trunk: Vec<Turn>,
}

impl Sign {
    /// Returns what the hand of `side` does.
    pub(crate) fn part(&self, side: Side) -> &Part {
        match side {
            Side::Right => &self.right,
            Side::Left => &self.left,
        }
    }
}

/// A recording: signs one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Take {
    /// The name of its files.
    pub(crate) stem: &'static str,
    /// What it shows, in English.
    pub(crate) about: &'static str,
    /// The signs with the moments at which their strokes start, in seconds.
    pub(crate) signs: Vec<(f64, Sign)>,
    /// The length in seconds.
    pub(crate) length: f64,
    /// What the whole means in French and in English, where it is an utterance.
    pub(crate) phrase: Option<[&'static str; 2]>,
    /// The seed of its small irregularities.
    pub(crate) seed: u64,
}
