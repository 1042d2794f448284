//! Facial expressions: movements of the canonical head by the numbers of a face, in head heights.

use std::f32::consts::{PI, TAU};

use chereme_motion::FacePosture;
use glam::Vec3;

use super::body_face::{
    CanonicalHead, EYE_LOOP_VERTICES, FacePart, LEFT_EYEBALL, LIP_LINE_HEIGHT, MOUTH_LOOP_VERTICES, eye_loop_vertex,
};
use super::solids::smooth_step;

/// A [`Face`] in this module's numbers.
#[derive(Debug, Clone)]
pub(super) struct FaceFeatures {
    pub(super) brows: [f32; 2],
    pub(super) frown: f32,
    pub(super) lids: [f32; 2],
    /// The direction of gaze: to the signer's left, and up.
    pub(super) gaze: [f32; 2],
    pub(super) nose: f32,
    jaw: f32,
    aside: f32,
    parted: f32,
    wide: f32,
    corners: [f32; 2],
    pressed: f32,
    pout: f32,
    pub(super) teeth: f32,
    pub(super) tongue: f32,
    pub(super) tongue_aside: f32,
    pub(super) cheeks: [f32; 2],
}

/// The distance that the chin moves down with the jaw.
const CHIN_DROP_DISTANCE: f32 = 0.150;
/// Half the width of the mouth at rest.
const MOUTH_HALF_WIDTH: f32 = 0.110;

impl FaceFeatures {
    pub(super) fn from_face_values(face: &FacePosture) -> Self {
        let number = |number: f64| {
            // A face from a file may hold anything: a value that is no number is taken as neutral.
            if number.is_finite() {
                number.clamp(-1.0, 1.0) as f32
            } else {
                0.0
            }
        };
        let only_up = |value: f64| number(value).max(0.0);
        Self {
            brows: face.brows.map(number),
            frown: only_up(face.frown),
            lids: face.lids.map(number),
            gaze: face.gaze.map(number),
            nose: number(face.nose),
            jaw: only_up(face.jaw),
            aside: number(face.aside),
            parted: only_up(face.parted),
            wide: number(face.wide),
            corners: face.corners.map(number),
            pressed: only_up(face.pressed),
            pout: only_up(face.pout),
            teeth: only_up(face.teeth),
            tongue: only_up(face.tongue),
            tongue_aside: number(face.tongue_aside),
            cheeks: face.cheeks.map(number),
        }
    }

    /// Returns whether the lips are open.
    pub(super) fn has_open_lips(&self) -> bool {
        self.mouth_gap().iter().sum::<f32>() > 0.006
    }

    /// Returns the opening of the mouth above and below the line between the lips.
    pub(super) fn mouth_gap(&self) -> [f32; 2] {
        let shut = 1.0 - self.pressed;
        // A tongue or teeth that show need open lips, whatever the face says of them.
        let tongue = if self.tongue > 0.0 { 0.35 } else { 0.0 };
        let parted = self.parted.max(self.teeth * 0.35).max(tongue);
        [
            0.032 * parted * shut,
            (0.029 * parted + CHIN_DROP_DISTANCE * self.jaw) * shut,
        ]
    }

    /// Returns half the width of the mouth.
    pub(super) fn mouth_half_width(&self) -> f32 {
        let narrow = (-self.wide).max(0.0);
        MOUTH_HALF_WIDTH
            * (1.0 + 0.40 * self.wide.max(0.0))
            * (1.0 - 0.42 * narrow)
            * (1.0 - 0.18 * self.pout)
            * (1.0 - 0.10 * self.jaw)
    }

    /// Returns the distance by which the lips are pushed forwards.
    pub(super) fn lip_protrusion(&self) -> f32 {
        0.055 * self.pout + 0.018 * (-self.wide).max(0.0) - 0.010 * self.pressed
    }

    /// Returns the displacement of a place by the lower jaw.
    pub(super) fn jaw_displacement(&self, at: Vec3) -> Vec3 {
        let low = smooth_step((LIP_LINE_HEIGHT + 0.055 - at.y) / 0.10);
        let front = smooth_step((at.z + 0.06) / 0.26);
        let much = low * front;
        Vec3::new(
            // The jaw turns about its joint, so that the chin moves back while it goes down.
            0.055 * self.aside,
            -CHIN_DROP_DISTANCE * self.jaw,
            -0.16 * CHIN_DROP_DISTANCE * self.jaw,
        ) * much
    }

    /// Returns vertex `k` of the mouth's loop `ring`; the depth is relative to rest.
    pub(super) fn moved_lip_vertex(&self, ring: usize, k: usize) -> Vec3 {
        let (sine, cosine) = (TAU * k as f32 / MOUTH_LOOP_VERTICES as f32).sin_cos();
        let far = sine.abs();
        let upper = sine >= 0.0;
        let bow = 1.0 - 0.28 * (-(cosine / 0.16).powi(2)).exp();
        let narrow = (-self.wide).max(0.0);
        let full = (1.0 - 0.22 * self.wide.max(0.0))
            * (1.0 + 0.15 * narrow)
            * (1.0 - 0.72 * self.pressed)
            * (1.0 + 0.25 * self.pout);
        let thick = if upper {
            0.034 * far.powf(0.8) * bow
        } else {
            0.042 * far.powf(0.9)
        } * full;
        let [above, below] = self.mouth_gap();
        let gap = if upper { above } else { below } * far.powf(0.75);
        let (inner, wide, out) = [
            (0.0, 0.97, 0.0),
            (0.5, 0.985, 0.016),
            (1.0, 1.0, 0.004),
            (1.0, 1.0, 0.0),
        ][ring];
        let corner = 0.10 + self.corners[usize::from(cosine > 0.0)];
        let lift = 0.042 * corner.clamp(-1.0, 1.1) * cosine.abs().powf(2.2)
            - 0.035 * self.jaw * (1.0 - self.pressed) * cosine.abs().powi(3);
        // The lower lip goes aside with the jaw, the upper one only by a third.
        let aside = 0.055 * self.aside * (0.35 + 0.65 * smooth_step(-sine));
        let nose = if upper { 0.010 * self.nose.max(0.0) } else { 0.0 };
        Vec3::new(
            self.mouth_half_width() * wide * cosine + aside,
            LIP_LINE_HEIGHT + sine.signum() * (thick * inner + gap) + lift + nose,
            out * (1.0 - 0.6 * self.pressed) + self.lip_protrusion() * (0.35 + 0.65 * far.max(1.0 - cosine.abs())),
        )
    }

    /// Returns the positions of the canonical head's vertices with this expression.
    pub(super) fn moved_head_vertices(&self, canon: &CanonicalHead) -> Vec<Vec3> {
        let rest = Self::from_face_values(&FacePosture::default());
        let mut rim = Vec::with_capacity(MOUTH_LOOP_VERTICES);
        let mut places: Vec<Vec3> = canon.knots.iter().map(|knot| knot.at).collect();
        let drawn = |own: Vec3, still: Vec3, at: Vec3| {
            // The lips curve back around the teeth as they widen.
            let round = 1.1 * (still.x * still.x - own.x * own.x);
            let jaw = if own.y < LIP_LINE_HEIGHT {
                0.16 * (own.y - still.y).min(0.0)
            } else {
                0.0
            };
            Vec3::new(own.x, own.y, at.z + own.z + round + jaw)
        };
        for (index, knot) in canon.knots.iter().enumerate() {
            if let FacePart::Mouth(ring @ 0..=2, k) = knot.place {
                let (own, still) = (self.moved_lip_vertex(ring, k), rest.moved_lip_vertex(ring, k));
                places[index] = drawn(own, still, knot.at);
                if ring == 2 {
                    let home = Vec3::new(still.x, still.y, knot.at.z);
                    // The jaw moves the skin of its own accord: only what the lips add to it is passed on.
                    let moved = places[index] - home - Vec3::Z * still.z;
                    rim.push((home, moved - self.jaw_displacement(home)));
                }
            }
        }
        for (index, knot) in canon.knots.iter().enumerate() {
            let knot_place = knot.at;
            match knot.place {
                FacePart::Skin | FacePart::Mouth(..) => {
                    // The three inner loops were placed above; the fourth is skin around the mouth.
                    if !matches!(knot.place, FacePart::Mouth(0..=2, _)) {
                        places[index] = knot_place
                            + self.jaw_displacement(knot_place)
                            + lip_pull_displacement(&rim, knot_place)
                            + self.feature_displacement(knot_place);
                    }
                }
                FacePart::Eye(side, ring, k) => places[index] = self.lidded(side, ring, k, knot_place),
                FacePart::Bowl(k) => {
                    places[index] = if k < MOUTH_LOOP_VERTICES {
                        let edge = self.moved_lip_vertex(0, k);
                        Vec3::new(
                            edge.x * 0.92,
                            LIP_LINE_HEIGHT + (edge.y - LIP_LINE_HEIGHT) * 0.96,
                            knot_place.z + self.lip_protrusion() * 0.6,
                        )
                    } else {
                        knot_place + Vec3::Y * (-0.5 * self.mouth_gap()[1])
                    };
                }
                FacePart::Socket(..) => {}
            }
        }
        places
    }

    /// Returns the displacement of the skin by brows, cheeks and nose.
    pub(super) fn feature_displacement(&self, at: Vec3) -> Vec3 {
        // No feature of the face reaches behind the middle of the head.
        if at.z < 0.0 {
            return Vec3::ZERO;
        }
        let near = |x: f32, y: f32, reach: f32| {
            let (dx, dy) = (at.x - x, at.y - y);
            (-(dx * dx + dy * dy) / (reach * reach)).exp()
        };
        let mut by = Vec3::ZERO;
        for side in 0..2 {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let brow = self.brows[side];
            // A brow rises further than it falls: the eye is in the way below.
            let lift = if brow > 0.0 { 0.055 * brow } else { 0.034 * brow };
            for [x, y] in [[0.048, 0.105], [0.135, 0.130], [0.223, 0.095]] {
                by.y += lift * 0.62 * near(sign * x, y, 0.060);
            }
            by.y += lift * 0.3 * near(sign * 0.12, 0.22, 0.09);
            let inner = near(sign * 0.05, 0.10, 0.05);
            by += Vec3::new(-0.020 * sign, -0.016, 0.012) * self.frown * inner;
            let wing = near(sign * 0.050, -0.165, 0.035);
            // The number of the nose is signed: wrinkled above zero, nostrils widened below.
            let (wrinkled, widened) = (self.nose.max(0.0), (-self.nose).max(0.0));
            by += Vec3::new(0.012 * sign, 0.036, 0.0) * wrinkled * wing;
            by += Vec3::new(0.036 * sign, 0.007, 0.004) * widened * wing;
            let fold = near(sign * 0.125, -0.12, 0.055);
            by += Vec3::new(0.0, 0.030, 0.022) * wrinkled * fold;
            let corner = self.corners[side];
            let apple = near(sign * 0.155, -0.165, 0.062);
            by += Vec3::new(0.006 * sign, 0.020, 0.050) * corner.max(0.0) * apple;
            let cheek = self.cheeks[side];
            let puff = near(sign * 0.190, -0.250, 0.095);
            // A cheek puffs out further than it is sucked in.
            let much = if cheek > 0.0 { [0.050, 0.076] } else { [0.040, 0.060] };
            by += Vec3::new(much[0] * sign, 0.0, much[1]) * cheek * puff;
        }
        by
    }

    /// Returns the position of a lid's vertex: the lid's edge slides over the eyeball.
    fn lidded(&self, side: usize, ring: usize, k: usize, at: Vec3) -> Vec3 {
        let upper = k <= EYE_LOOP_VERTICES / 2;
        let shut = self.lids[side];
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let [x, y] = eye_loop_vertex(side, ring, k);
        let [_, edge] = eye_loop_vertex(side, 0, k);
        let look = 0.012 * self.gaze[1];
        let height = |t: f32| 0.030 * (PI * t.powf(1.15)).sin().max(0.0).powf(0.9);
        let half = EYE_LOOP_VERTICES as f32 / 2.0;
        let t = if k < EYE_LOOP_VERTICES / 2 {
            k as f32 / half
        } else {
            2.0 - k as f32 / half
        };
        let to = if upper {
            // The lids meet where the lower one has risen by 0.42 of its height.
            let closed = -0.58 * height(t);
            let lid = if shut > 0.0 {
                edge + (closed - edge) * shut
            } else {
                edge * (1.0 - 0.42 * shut)
            };
            // The upper lid follows the gaze up and down, less as it closes.
            lid + look * (1.0 - shut.max(0.0)) * (edge / 0.046).clamp(0.0, 1.0)
        } else if shut > 0.0 {
            edge * (1.0 - 0.42 * shut)
        } else {
            edge * (1.0 - 0.25 * shut)
        };
        // The edge takes the whole movement, and each loop further out a smaller share.
        let follow = [1.0, 0.94, 0.42, 0.12][ring];
        let y = y + (to - edge) * follow;
        let (dx, reach) = (
            x - sign * LEFT_EYEBALL.0.x,
            LEFT_EYEBALL.1 * (1.10 + 0.03 * ring as f32),
        );
        let over = reach * reach - (0.86 * dx).powi(2) - y * y;
        // Lids lie on the eyeball, so that their depth is that of a sphere a little larger.
        let ball = LEFT_EYEBALL.0.z + over.max(0.0).sqrt();
        let z = match ring {
            0 => ball,
            1 => ball + 0.004,
            2 => (ball + 0.006).max(at.z) * 0.5 + at.z * 0.5,
            _ => at.z,
        };
        let brow = self.feature_displacement(at) * [0.0, 0.05, 0.25, 0.7][ring];
        Vec3::new(x, y, z) + brow
    }
}

/// Returns the displacement of the skin at a place by the edge of the lips.
fn lip_pull_displacement(rim: &[(Vec3, Vec3)], at: Vec3) -> Vec3 {
    let (mut sum, mut by, mut nearest) = (0.0, Vec3::ZERO, f32::INFINITY);
    for &(home, moved) in rim {
        let far = home.distance_squared(at);
        nearest = nearest.min(far);
        let weight = (-far / (0.035 * 0.035)).exp();
        sum += weight;
        by += moved * weight;
    }
    // Beyond 0.3 head heights, here squared, the lips pull nothing.
    if nearest > 0.09 {
        return Vec3::ZERO;
    }
    by / (sum + 1e-6) * (-nearest / (0.085 * 0.085)).exp()
}
