//! The bulk of hands and head: bones with their flesh and an ellipsoid, measured from joints alone.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, ModelPose, Skeleton};
use chereme_sign::hamnosys::sites::digit_joint;
use chereme_sign::hamnosys::{HandClass, HandDigit, HandLocation, HandSite, Handshape, ThumbPosition};

/// Half the thickness of a finger, in hand lengths: 8 mm at 19 cm.
const FINGER: f64 = 0.042;
/// Half the thickness of a palm, in hand lengths.
const PALM: f64 = 0.07;

/// A bone with its flesh.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tube {
    /// The digit from the thumb, 0, to the little finger, 4.
    pub(crate) digit: usize,
    /// 0 in the palm, 1 to 3 from the knuckle outwards.
    pub(crate) bone: usize,
    pub(crate) ends: [DVec3; 2],
    pub(crate) radius: f64,
}

/// A hand in one frame, in model space.
pub(crate) struct Hand {
    pub(crate) tubes: Vec<Tube>,
    pub(crate) wrist: DVec3,
    /// The knuckle of the middle finger.
    pub(crate) palm_end: DVec3,
    palm: DVec3,
    radial: DVec3,
    length: f64,
}

impl Hand {
    pub(crate) fn of(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose, side: BodySide) -> Option<Self> {
        let arm = anatomy.arm_chain(side)?;
        let wrist = model.model_joint_position(arm.hand);
        let length = anatomy.anatomy_measures()?.hand;
        let (along, palm) = (anatomy.hand_direction(side, model)?, anatomy.palm_normal(side, model)?);
        let mut tubes = Vec::new();
        let mut palm_end = wrist + along * (0.5 * length);
        for (digit, which) in HandDigit::ALL_HAND_DIGITS.into_iter().enumerate() {
            let joints: Vec<usize> = (1..=3)
                .filter_map(|n| anatomy.part_joint(digit_joint(side, which, n)))
                .fold(Vec::new(), |mut all, joint| {
                    if !all.contains(&joint) {
                        all.push(joint);
                    }
                    all
                });
            let mut joints = joints;
            if which == HandDigit::Thumb
                && let Some(last) = anatomy.part_joint(chereme_motion::BodyPart::Thumb(side, 3))
                && !joints.contains(&last)
            {
                joints.push(last);
            }
            let (Some(&first), Some(&last)) = (joints.first(), joints.last()) else {
                continue;
            };
            let mut points: Vec<DVec3> = joints.iter().map(|&joint| model.model_joint_position(joint)).collect();
            let tip = match (skeleton.joint_at(last).tip, skeleton.joint_children(last)) {
                (Some(tip), _) => points[points.len() - 1] + model.model_joint_rotation(last) * tip,
                (None, &[child]) => model.model_joint_position(child),
                _ => {
                    let before = skeleton
                        .joint_parent(last)
                        .map_or(wrist, |before| model.model_joint_position(before));
                    points[points.len() - 1] + (points[points.len() - 1] - before) * 0.8
                }
            };
            points.push(tip);
            let base = model.model_joint_position(first);
            if which == HandDigit::Middle {
                palm_end = base;
            }
            if which != HandDigit::Thumb {
                tubes.push(Tube {
                    digit,
                    bone: 0,
                    ends: [wrist.lerp(base, 0.3), base],
                    radius: PALM * length,
                });
            }
            let radius = FINGER * length;
            for (n, pair) in points.windows(2).enumerate() {
                // The flesh ends at the tip.
                let last = n + 2 == points.len();
                let step = pair[1] - pair[0];
                let end = if last {
                    pair[1] - step.clamp_length_max(radius)
                } else {
                    pair[1]
                };
                let bone = n + 5 - points.len();
                tubes.push(Tube {
                    digit,
                    bone,
                    ends: [pair[0], end],
                    radius,
                });
            }
        }
        let radial = palm.cross(along) * side.side_sign();
        Some(Self {
            tubes,
            wrist,
            palm_end,
            palm,
            radial,
            length,
        })
    }

    fn bone(&self, digit: usize, bone: usize) -> Option<&Tube> {
        self.tubes.iter().find(|tube| tube.digit == digit && tube.bone == bone)
    }

    /// Returns a point near a part of the hand; the tip of the index finger if none is named.
    pub(crate) fn part(&self, named: Option<&HandSite>) -> Option<DVec3> {
        let digits = named.map(|site| &site.digits);
        let among = |digit: &HandDigit| digits.is_some_and(|digits| digits.contains_digit(*digit));
        let digit = HandDigit::ALL_HAND_DIGITS.iter().position(among).unwrap_or(1);
        Some(match named.and_then(|site| site.at) {
            Some(HandLocation::MidJoint) => self.bone(digit, 2)?.ends[0],
            Some(HandLocation::Base) => self.bone(digit, 1)?.ends[0],
            None | Some(HandLocation::Tip | HandLocation::Nail | HandLocation::Pad) => self.bone(digit, 3)?.ends[1],
            _ => self.palm_end,
        })
    }

    /// Returns the distance (m) of the thumb from its notated place across the hand; `None` if the handshape does not put
    /// it across.
    pub(crate) fn thumb_off(&self, shape: &Handshape) -> Option<f64> {
        let plain = shape.between.is_none() && shape.thumb.is_none() && shape.bends[0].is_none();
        if shape.form.thumb != Some(ThumbPosition::Across) || !plain {
            return None;
        }
        let thumb = self.bone(0, 3)?;
        match shape.form.class {
            HandClass::Flat | HandClass::Finger2345 => {
                if shape.form.bend.is_some() || !shape.exempt.is_empty() {
                    return None;
                }
                // Flesh on flesh: the palm's own thickness, then the thumb's.
                let tip = thumb.ends[1];
                let over = (tip - self.wrist).dot(self.palm) - PALM * self.length - thumb.radius;
                let middle = (self.palm_end - self.wrist).dot(self.radial);
                let short = (tip - self.wrist).dot(self.radial) - middle;
                Some(over.abs().max(short.max(0.0)))
            }
            HandClass::Fist | HandClass::Finger2 | HandClass::Finger23 | HandClass::Finger23Spread => {
                let folded = folded(shape);
                let of = |digit: usize| {
                    let on = self.bone(digit, 2)?;
                    let (apart, direction) = between(thumb.ends, on.ends);
                    let off = (apart - thumb.radius - on.radius).abs();
                    // In front of the finger, not behind it or beside its end.
                    Some(if direction.dot(self.palm) > 0.3 * apart {
                        off
                    } else {
                        off.max(apart)
                    })
                };
                folded.into_iter().filter_map(of).min_by(f64::total_cmp)
            }
            _ => None,
        }
    }
}

/// Returns the folded fingers on which a thumb across lies: the first two of them.
fn folded(shape: &Handshape) -> Vec<usize> {
    let selected = chereme_sign::hamnosys::angles::selected_fingers(shape.form.class, &shape.special.0);
    let fist = shape.form.class == HandClass::Fist;
    let all = (1..5).filter(|&digit| {
        let out = !fist && selected[digit - 1];
        let exempt = fist && shape.exempt.contains_digit(HandDigit::ALL_HAND_DIGITS[digit]);
        !out && !exempt
    });
    all.take(2).collect()
}

/// Returns the largest depth of two hands in each other, in metres.
pub(crate) fn deepest(a: &Hand, b: &Hand) -> f64 {
    if a.palm_end.distance(b.palm_end) > 2.2 * a.length {
        return 0.0;
    }
    let pairs = a
        .tubes
        .iter()
        .flat_map(|one| b.tubes.iter().map(move |other| (one, other)));
    let deep = pairs.map(|(one, other)| one.radius + other.radius - between(one.ends, other.ends).0);
    deep.fold(0.0, f64::max)
}

/// Returns the distance of two segments, and the direction from the second to the first.
pub(crate) fn between(a: [DVec3; 2], b: [DVec3; 2]) -> (f64, DVec3) {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let flat = uu * vv - uv * uv;
    let mut s = if flat > 1e-12 {
        ((uv * vw - vv * uw) / flat).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let mut t = if vv > 1e-12 { (uv * s + vw) / vv } else { 0.0 };
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = if uu > 1e-12 {
            ((t * uv - uw) / uu).clamp(0.0, 1.0)
        } else {
            0.0
        };
    }
    let offset = (a[0] + u * s) - (b[0] + v * t);
    (offset.length(), offset)
}

/// The skull in one frame, as an ellipsoid a little within the places of the face.
pub(crate) struct Skull {
    middle: DVec3,
    axes: [DVec3; 3],
    half: [f64; 3],
}

impl Skull {
    pub(crate) fn of(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose) -> Option<Self> {
        let size = anatomy.anatomy_measures()?.head;
        let axes = anatomy.head_axes(model)?;
        let top = anatomy.landmark_place_position(skeleton, model, "head-top")?;
        Some(Self {
            middle: top - axes[1] * (0.5 * size),
            axes,
            half: [0.33, 0.49, 0.42].map(|share| share * size),
        })
    }

    /// Returns the depth of a point in the skull, in metres, along the line from its middle.
    pub(crate) fn depth(&self, at: DVec3) -> f64 {
        let offset = at - self.middle;
        let share = (0..3).map(|n| (offset.dot(self.axes[n]) / self.half[n]).powi(2));
        let share = share.sum::<f64>().sqrt();
        match share < 1.0 {
            true => offset.length() * (1.0 / share.max(1e-6) - 1.0),
            false => 0.0,
        }
    }
}
