//! The targets of the pointing fingertip in the space of the head, and the position of the lips.
//!
//! Lengths are shares of the head's height from chin to top (about 230 mm): towards the cueing hand, up from the
//! height of the chin, and forward of the middle of the skull. Places and angles of the forearm follow the
//! means of five cuers that SPPAS measured (synthesis of 3,752 pictures, face of 140 by 125 mm), moved outwards
//! so that the finger touches the skin and leaves the lips free.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, FacePosture, ModelPose, Skeleton};

/// The chin, as landmarks have it, in the space of the head.
const CHIN_HEAD_POSITION: DVec3 = DVec3::new(0.0, 0.04, 0.44);
/// The least distance of the tip from the contour of the lips, in metres.
pub(super) const LIP_CLEARANCE_M: f64 = 0.006;
/// The distance from the lips with which paths are planned, in metres: more than the least, as faces move.
const PLANNED_LIP_CLEARANCE_M: f64 = 0.009;

/// The space of a head, seen from the cueing hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct CueHeadSpace {
    origin: DVec3,
    /// Unit vectors towards the cueing hand, up and forward.
    pub(super) axes: [DVec3; 3],
    /// The head's height in metres.
    pub(super) size: f64,
    throat: DVec3,
    /// The largest distance of the front of the chest forward, in the space of the head.
    chest: f64,
    /// The distance from the wrist to the end of the middle finger.
    hand: f64,
}

/// A place for the tip, with the posture of the hand there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CueSpot {
    /// The position in the space of the head.
    pub(super) at: DVec3,
    /// The angle of forearm and fingers above the horizontal, in radians.
    pub(super) angle: f64,
    /// The angle by which the fingers lean back towards the face, in radians.
    pub(super) lean: f64,
    /// Whether the tip touches the body here.
    pub(super) touches: bool,
}

impl CueHeadSpace {
    /// Returns the head's space in a posture; `None` if the skeleton has no head or no trunk.
    pub(super) fn from_head_posture(
        anatomy: &BodyAnatomy,
        skeleton: &Skeleton,
        model: &ModelPose,
        side: BodySide,
    ) -> Option<Self> {
        let [left, up, forward] = anatomy.head_axes(model)?;
        let measures = anatomy.anatomy_measures()?;
        let size = measures.head;
        let axes = [left * side.side_sign(), up, forward];
        let chin = anatomy.landmark_place_position(skeleton, model, "chin")?;
        let mut head = Self {
            origin: chin,
            axes,
            size,
            throat: DVec3::ZERO,
            chest: 0.0,
            hand: measures.hand / size,
        };
        // The chin is the landmark that skeletons have; places of cues count from the middle of the head.
        head.origin = chin - head.head_to_model_direction(CHIN_HEAD_POSITION) * size;
        let throat = anatomy.landmark_place_position(skeleton, model, "throat");
        // Without a neck the throat is where it is below the head of an average body, in head sizes.
        head.throat = throat.map_or(DVec3::new(0.0, -0.23, 0.25), |at| head.model_to_head_point(at));
        let front_landmarks =
            ["upper-chest", "chest"].map(|name| anatomy.landmark_place_position(skeleton, model, name));
        let fronts = front_landmarks
            .into_iter()
            .flatten()
            .map(|at| head.model_to_head_point(at).z);
        head.chest = fronts.fold(head.throat.z, f64::max);
        Some(head)
    }

    /// Converts a direction from the space of the head to model space.
    pub(super) fn head_to_model_direction(&self, v: DVec3) -> DVec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }

    /// Converts a point from the space of the head to model space.
    pub(super) fn head_to_model_point(&self, at: DVec3) -> DVec3 {
        self.origin + self.head_to_model_direction(at) * self.size
    }

    /// Converts a point from model space to the space of the head.
    pub(super) fn model_to_head_point(&self, at: DVec3) -> DVec3 {
        let offset = (at - self.origin) / self.size;
        DVec3::new(
            offset.dot(self.axes[0]),
            offset.dot(self.axes[1]),
            offset.dot(self.axes[2]),
        )
    }

    /// Returns the place with that name; `None` if it is unknown.
    pub(super) fn find_cue_spot(&self, placement: &str) -> Option<CueSpot> {
        let spot = |at: [f64; 3], angle: f64, lean: f64, touches| CueSpot {
            at: DVec3::from(at),
            angle: angle.to_radians(),
            lean: lean.to_radians(),
            touches,
        };
        Some(match placement {
            "side" => spot([0.43, 0.20, 0.44], 68.0, 6.0, false),
            "side-forward" => spot([0.43, 0.20, 0.55], 68.0, 6.0, false),
            "side-down" => spot([0.43, 0.145, 0.44], 68.0, 6.0, false),
            "mouth" => spot([0.16, 0.195, 0.41], 63.0, 16.0, true),
            "chin" => spot([0.045, 0.045, 0.465], 61.0, 16.0, true),
            "cheek" => spot([0.22, 0.325, 0.37], 64.0, 16.0, true),
            "throat" => self.at_throat(spot([0.0; 3], 54.0, 48.0, true)),
            "rest" => spot([0.42, -0.55, 0.85], 45.0, 4.0, false),
            _ => return None,
        })
    }
}

/// The distance of the wrist in front of the chest while the hand is at the throat, in heights of the head: half of a
/// forearm, and a shirt.
const BEFORE_CHEST: f64 = 0.45;
/// The largest angle by which fingers lean back towards the throat, in radians.
const FARTHEST_LEAN: f64 = 1.2;

impl CueHeadSpace {
    /// Returns the spot at the throat, in front of a collar: the fingers lean so that the wrist stays in front of the
    /// chest, however deep that is, and the tip moves forward if leaning is not enough.
    fn at_throat(&self, usual: CueSpot) -> CueSpot {
        let mut position = self.throat + DVec3::new(0.04, 0.0, 0.13);
        let wanted = self.chest + BEFORE_CHEST - position.z;
        // The lean at which the wrist is as far in front as wanted, if the hand is long enough.
        let wanted_lean = (wanted / self.hand.max(0.1)).clamp(-1.0, 1.0).asin();
        let lean = wanted_lean.clamp(usual.lean, FARTHEST_LEAN);
        position.z += (wanted - self.hand * lean.sin()).max(0.0);
        CueSpot {
            at: position,
            lean,
            ..usual
        }
    }
}

/// Returns the distance in metres of a point in the head's space from the lips of a face, seen from the front; negative
/// inside.
///
/// The contour is an ellipse about the mouth that grows as the jaw drops and the corners move apart.
pub(super) fn lip_clearance(at: DVec3, face: &FacePosture, size: f64) -> f64 {
    let jaw = face.jaw.clamp(0.0, 1.0);
    let middle = DVec3::new(0.0, 0.21 - 0.035 * jaw, 0.0);
    let (wide, high) = (0.11 * (1.0 + 0.12 * face.wide.clamp(-1.0, 1.0)), 0.05 + 0.035 * jaw);
    let (x, y) = (at.x - middle.x, at.y - middle.y);
    let mut nearest = f64::INFINITY;
    const LIP_CONTOUR_STEPS: u32 = 96;
    for n in 0..LIP_CONTOUR_STEPS {
        let angle = std::f64::consts::TAU * f64::from(n) / f64::from(LIP_CONTOUR_STEPS);
        let (dx, dy) = (wide * angle.cos() - x, high * angle.sin() - y);
        nearest = nearest.min(dx.hypot(dy));
    }
    let inside = (x / wide).powi(2) + (y / high).powi(2) < 1.0;
    nearest * size * if inside { -1.0 } else { 1.0 }
}

/// The bend of a path between two places, at its middle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct CuePathBow {
    /// The displacement in the space of the head.
    by: DVec3,
}

impl CuePathBow {
    /// Returns the bow of the path between two places: forward, away from the face, and outwards as far as the lips
    /// require.
    pub(super) fn bow_between_spots(from: &CueSpot, to: &CueSpot, size: f64) -> Self {
        let far = from.at.distance(to.at);
        let forward = if from.touches || to.touches {
            0.03 + 0.15 * far
        } else {
            0.0
        };
        // The mouth as wide and open as in speech.
        let open = FacePosture {
            jaw: 0.75,
            wide: 0.8,
            ..FacePosture::default()
        };
        let mut bow = Self {
            by: DVec3::new(0.0, 0.0, forward),
        };
        let clear = |bow: &Self| {
            let ends = lip_clearance(from.at, &open, size).min(lip_clearance(to.at, &open, size));
            // A path cannot be farther from the lips than its own ends are.
            let wanted = PLANNED_LIP_CLEARANCE_M.min(ends);
            (1..24).all(|n| {
                let bow_place = bow.bowed_tip_position(from, to, f64::from(n) / 24.0);
                lip_clearance(bow_place, &open, size) >= wanted - 1e-9
            })
        };
        // A path that never clears the lips does not bow without end.
        while !clear(&bow) && bow.by.x < 0.6 {
            bow.by.x += 0.01;
        }
        bow
    }

    /// Returns the bow between two equal keys: the hand moves a little away and back, so that a viewer sees two keys.
    pub(super) fn repeated_key_bow() -> Self {
        Self {
            by: DVec3::new(0.02, 0.0, 0.07),
        }
    }

    /// Returns the position of the tip after a share of the path.
    pub(super) fn bowed_tip_position(&self, from: &CueSpot, to: &CueSpot, share: f64) -> DVec3 {
        // The square of a sine leaves the straight path and comes back to it without a corner.
        let bend = (std::f64::consts::PI * share).sin();
        from.at.lerp(to.at, share) + self.by * (bend * bend)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head() -> CueHeadSpace {
        CueHeadSpace {
            origin: DVec3::ZERO,
            axes: [DVec3::X, DVec3::Y, DVec3::Z],
            size: 0.23,
            throat: DVec3::new(0.0, -0.23, 0.25),
            chest: 0.5,
            hand: 0.83,
        }
    }

    #[test]
    fn at_the_throat_the_wrist_is_before_the_chest_of_any_body() {
        for chest in [0.3, 0.5, 0.7, 0.9, 1.4] {
            let own = CueHeadSpace { chest, ..head() };
            let spot = own.find_cue_spot("throat").expect("a throat");
            let wrist = spot.at.z + own.hand * spot.lean.sin();
            assert!(wrist >= chest + BEFORE_CHEST - 1e-9, "{chest}: {wrist}");
            assert!(
                spot.at.z >= own.throat.z + 0.13 - 1e-9,
                "the tip stays outside the skin"
            );
        }
    }

    const PLACES: [&str; 8] = [
        "side",
        "side-forward",
        "side-down",
        "mouth",
        "chin",
        "cheek",
        "throat",
        "rest",
    ];

    #[test]
    fn paths_between_places_keep_away_from_the_lips() {
        let open = FacePosture {
            jaw: 0.75,
            wide: 0.8,
            ..FacePosture::default()
        };
        let head = head();
        for (from, to) in PLACES.iter().flat_map(|a| PLACES.map(|b| (*a, b))) {
            let (a, b) = (head.find_cue_spot(from).expect(from), head.find_cue_spot(to).expect(to));
            let bow = CuePathBow::bow_between_spots(&a, &b, head.size);
            for n in 0..=100 {
                let at = bow.bowed_tip_position(&a, &b, f64::from(n) / 100.0);
                let clear = lip_clearance(at, &open, head.size);
                assert!(clear > LIP_CLEARANCE_M, "{from} to {to} at {n}: {clear}");
            }
        }
    }

    #[test]
    fn paths_bend_outwards_only_as_far_as_the_lips_require() {
        let open = FacePosture {
            jaw: 0.75,
            wide: 0.8,
            ..FacePosture::default()
        };
        let head = head();
        let mut aside = 0;
        for (from, to) in PLACES.iter().flat_map(|a| PLACES.map(|b| (*a, b))) {
            let (a, b) = (head.find_cue_spot(from).expect(from), head.find_cue_spot(to).expect(to));
            let bow = CuePathBow::bow_between_spots(&a, &b, head.size);
            let nearest = |bow: &CuePathBow| {
                let places = (0..=24).map(|n| bow.bowed_tip_position(&a, &b, f64::from(n) / 24.0));
                let far = places.map(|at| lip_clearance(at, &open, head.size));
                far.fold(f64::INFINITY, f64::min)
            };
            let ends = [a, b].map(|spot| lip_clearance(spot.at, &open, head.size));
            let wanted = PLANNED_LIP_CLEARANCE_M.min(ends[0]).min(ends[1]) - 1e-9;
            assert!(nearest(&bow) >= wanted, "{from} to {to}");
            if bow.by.x > 0.0 {
                aside += 1;
                let less = CuePathBow {
                    by: bow.by - DVec3::X * 0.01,
                };
                assert!(nearest(&less) < wanted, "{from} to {to}: {}", bow.by);
            }
            let middle = bow.bowed_tip_position(&a, &b, 0.5) - a.at.midpoint(b.at);
            let forward = match a.touches || b.touches {
                true => 0.03 + 0.15 * a.at.distance(b.at),
                false => 0.0,
            };
            assert!((middle.z - forward).abs() < 1e-9 && middle.y.abs() < 1e-9);
            assert!(bow.bowed_tip_position(&a, &b, 0.0).distance(a.at) < 1e-12);
            assert!(bow.bowed_tip_position(&a, &b, 1.0).distance(b.at) < 1e-12);
        }
        assert!((1..PLACES.len().pow(2) / 2).contains(&aside), "{aside}");
    }

    #[test]
    fn the_space_of_a_head_moves_and_turns_with_it() {
        let mut own = head();
        let turned = chereme_motion::glam::DQuat::from_scaled_axis(DVec3::new(0.3, -0.5, 0.8));
        own.axes = own.axes.map(|axis| turned * axis);
        own.origin = DVec3::new(0.1, 1.5, -0.2);
        let at = DVec3::new(0.3, -0.2, 0.5);
        let there = own.head_to_model_point(at);
        assert!(there.distance(own.origin + turned * at * 0.23) < 1e-12);
        assert!(own.model_to_head_point(there).distance(at) < 1e-12);
    }

    #[test]
    fn the_contour_of_the_lips_grows_with_the_jaw_and_the_corners() {
        let size = 0.2;
        for (jaw, wide, half_width, low) in [
            (0.0, 0.0, 0.11, 0.16),
            (1.0, 0.0, 0.11, 0.09),
            (0.5, 1.0, 0.1232, 0.125),
            (0.0, -1.0, 0.0968, 0.16),
        ] {
            let face = FacePosture {
                jaw,
                wide,
                ..FacePosture::default()
            };
            let middle = 0.21 - 0.035 * jaw;
            let aside = DVec3::new(half_width + 0.1, middle, 0.3);
            assert!((lip_clearance(aside, &face, size) - 0.02).abs() < 1e-9, "{jaw} {wide}");
            let below = DVec3::new(0.0, low - 0.1, 0.3);
            assert!((lip_clearance(below, &face, size) - 0.02).abs() < 1e-9, "{jaw} {wide}");
            let inside = DVec3::new(0.0, low + 0.01, 0.3);
            assert!(
                (lip_clearance(inside, &face, size) + 0.002).abs() < 1e-9,
                "{jaw} {wide}"
            );
        }
    }

    #[test]
    fn clearance_is_the_distance_to_the_contour() {
        let face = FacePosture::default();
        let outside = lip_clearance(DVec3::new(0.21, 0.21, 0.0), &face, 0.2);
        assert!((outside - 0.02).abs() < 1e-9, "{outside}");
        assert!(lip_clearance(DVec3::new(0.0, 0.21, 0.0), &face, 0.2) < 0.0);
    }
}
