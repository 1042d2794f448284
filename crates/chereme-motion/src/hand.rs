//! The posture of one hand as joint angles, whatever the skeleton.

use serde::{Deserialize, Serialize};

/// A side of the signer's body, always from the signer's own point of view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodySide {
    /// The signer's right.
    Right,
    /// The signer's left.
    Left,
}

impl BodySide {
    /// Both sides, right first.
    pub const BOTH_SIDES: [Self; 2] = [Self::Right, Self::Left];

    /// Returns the opposite side.
    #[must_use]
    pub fn opposite_side(self) -> Self {
        match self {
            Self::Right => Self::Left,
            Self::Left => Self::Right,
        }
    }

    /// Returns the sign of this side on the X axis of model space: the left is positive.
    #[must_use]
    pub fn side_sign(self) -> f64 {
        match self {
            Self::Right => -1.0,
            Self::Left => 1.0,
        }
    }

    /// Returns `right` or `left`.
    #[must_use]
    pub fn body_side_name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }
}

/// One of the four fingers other than the thumb.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandFinger {
    /// The index finger.
    Index,
    /// The middle finger.
    Middle,
    /// The ring finger.
    Ring,
    /// The little finger.
    Little,
}

impl HandFinger {
    /// The four fingers, from the thumb's side outwards.
    pub const ALL_FINGERS: [Self; 4] = [Self::Index, Self::Middle, Self::Ring, Self::Little];

    /// Returns the index of this finger in [`HandAngles::fingers`].
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Returns the name of this finger in lower case.
    #[must_use]
    pub fn finger_name(self) -> &'static str {
        match self {
            Self::Index => "index",
            Self::Middle => "middle",
            Self::Ring => "ring",
            Self::Little => "little",
        }
    }
}

/// The angles of one finger in radians; all zero is a straight finger along the hand.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FingerAngles {
    /// Angle of the base joint in the plane of the palm, positive towards the thumb's side.
    pub spread: f64,
    /// Flexion of the base, middle and end joint, positive towards the palm.
    pub flexion: [f64; 3],
}

/// The angles of the thumb in radians; all zero is a straight thumb beside the index finger.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ThumbAngles {
    /// Angle of the thumb's metacarpal in the plane of the palm, away from the hand's axis;
    /// a right angle points straight out to the side.
    pub radial: f64,
    /// Angle of the metacarpal out of the plane of the palm, towards the palm's side.
    pub palmar: f64,
    /// Rotation of the thumb about its own length, positive towards facing the little finger's base. At zero, with the
    /// thumb beside the index finger, its pad faces that finger and it bends in the plane of the palm; a skeleton's
    /// rest pose counts as zero.
    pub opposition: f64,
    /// Flexion of the middle and the end joint, positive across the palm.
    pub flexion: [f64; 2],
}

/// The posture of a hand's thumb and fingers in radians, the same for a right and a left hand.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct HandAngles {
    /// The thumb.
    pub thumb: ThumbAngles,
    /// Index, middle, ring and little finger, in this order.
    pub fingers: [FingerAngles; 4],
}

impl HandAngles {
    /// How many angles a hand has.
    pub const HAND_ANGLE_COUNT: usize = 21;

    /// Returns every angle in a fixed order: the thumb's five (radial, palmar, opposition and two
    /// flexions), then for each finger its spread and three flexions.
    #[must_use]
    pub fn to_array(&self) -> [f64; Self::HAND_ANGLE_COUNT] {
        let t = &self.thumb;
        let mut all = [0.0; Self::HAND_ANGLE_COUNT];
        all[..5].copy_from_slice(&[t.radial, t.palmar, t.opposition, t.flexion[0], t.flexion[1]]);
        for (finger, slot) in self.fingers.iter().zip(all[5..].chunks_exact_mut(4)) {
            slot[0] = finger.spread;
            slot[1..].copy_from_slice(&finger.flexion);
        }
        all
    }

    /// Returns the posture whose [`to_array`](Self::to_array) is `all`.
    #[must_use]
    pub fn from_array(all: [f64; Self::HAND_ANGLE_COUNT]) -> Self {
        let mut hand = Self {
            thumb: ThumbAngles {
                radial: all[0],
                palmar: all[1],
                opposition: all[2],
                flexion: [all[3], all[4]],
            },
            ..Self::default()
        };
        for (finger, slot) in hand.fingers.iter_mut().zip(all[5..].chunks_exact(4)) {
            finger.spread = slot[0];
            finger.flexion = [slot[1], slot[2], slot[3]];
        }
        hand
    }

    /// Returns the posture with every angle passed through `f`, for example into degrees.
    #[must_use]
    pub fn map_hand_angles(&self, f: impl Fn(f64) -> f64) -> Self {
        Self::from_array(self.to_array().map(f))
    }

    /// Interpolates between `self` (`weight` 0) and `other` (1), angle by angle.
    #[must_use]
    pub fn interpolate_hand_angles(&self, other: &Self, weight: f64) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        Self::from_array(std::array::from_fn(|i| a[i] + (b[i] - a[i]) * weight))
    }
}
