//! The tree of a sign as notation describes it.
//!
//! The parts and their names follow gestural SiGML 1.2; HamNoSys text is another spelling of the same
//! tree. Parts that a spelling omits are `None` here, never a default: readers of the tree choose their
//! own.

mod hamnosys_tree_motion;
mod tree_hand;
mod tree_place;

pub use hamnosys_tree_motion::{
    BodyAction, CircularPath, ClockRange, DirectedPath, EllipseAxis, MotionGrowth, MotionKind, MotionManner,
    MotionRepetition, MotionSize, NotatedMotion, PathCurve, PathZigzag, RepeatKind, SizeAmount, WristMotion,
};
pub use tree_hand::{
    CeeOpening, DigitList, FingerBend, FingerContact, FingerPart, HandClass, HandDigit, Handshape, HandshapeForm,
    ThumbExtra, ThumbPosition,
};
pub use tree_place::{
    BodyLocation, BodyPlace, HandConstellation, HandLocation, HandPlace, HandSite, LocationSide, PlaceContact,
    SidedLocation,
};

use serde::{Deserialize, Serialize};

use super::direction::{CompassDirection, SpatialDirection};

/// A sign: the actions of the hands, part after part.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HamnosysSign {
    /// The parts of a compound in their order; one for a simple sign.
    pub parts: Vec<ManualPart>,
}

/// The actions of the hands in one part of a sign.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ManualPart {
    /// The acting hands.
    pub hands: HandsUsed,
    /// Whether the hands keep the last posture of the part before.
    pub holdover: bool,
    /// Actions of the body while the sign begins.
    pub body: Vec<BodyAction>,
    /// The posture it begins with.
    pub posture: NotatedPosture,
    /// The actions after the first posture, in order.
    pub actions: Vec<NotatedMotion>,
    /// The spelling of this part in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}

/// The acting hands of a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandsUsed {
    /// The dominant hand alone.
    #[default]
    Dominant,
    /// The other hand alone.
    Nondominant,
    /// Both, the second following the first by a symmetry.
    Both(HandSymmetry),
}

/// The symmetry by which the second hand follows the dominant one.
///
/// Without any of the mirrors both do the same (parallel).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandSymmetry {
    /// Left and right are exchanged.
    pub left_right: bool,
    /// Up and down are exchanged.
    pub up_down: bool,
    /// Out and in are exchanged.
    pub out_in: bool,
    /// The second hand is half a period behind.
    pub out_of_phase: bool,
    /// Whether places are meant in real space, not on each hand's own side.
    pub real_space: bool,
}

/// A notated value of the hands: unset, shared, or one for each hand.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EachHand<T> {
    /// Unset: as before, or as usual.
    #[default]
    Unset,
    /// For every acting hand; the second takes it through the symmetry.
    Shared(T),
    /// One value for the dominant hand, then one for the other; a missing one keeps its previous value.
    Split(Option<T>, Option<T>),
}

impl<T> EachHand<T> {
    /// Returns the dominant hand's value.
    #[must_use]
    pub fn dominant_value(&self) -> Option<&T> {
        match self {
            Self::Unset => None,
            Self::Shared(one) => Some(one),
            Self::Split(dominant, _) => dominant.as_ref(),
        }
    }

    /// Returns the other hand's own value, without symmetry.
    #[must_use]
    pub fn other_value(&self) -> Option<&T> {
        match self {
            Self::Split(_, other) => other.as_ref(),
            _ => None,
        }
    }

    /// Returns whether no value is set.
    #[must_use]
    pub fn is_unset(&self) -> bool {
        matches!(self, Self::Unset)
    }
}

/// A posture of the hands, part by part; unset parts keep their previous values.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NotatedPosture {
    /// The handshape.
    pub shape: EachHand<Handshape>,
    /// The direction of the hand's own axis, from the wrist to the middle knuckle.
    pub extended: EachHand<DirectionAim<SpatialDirection>>,
    /// The direction of the palm, as an angle about that axis.
    pub palm: EachHand<DirectionAim<CompassDirection>>,
    /// The place of the hands.
    pub place: Option<HandPlace>,
}

impl NotatedPosture {
    /// Returns whether no part of it is set.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A direction, or the middle of two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DirectionAim<D> {
    /// The direction.
    pub first: D,
    /// The second direction, if half-way between two is meant.
    #[serde(default = "unset_direction", skip_serializing_if = "Option::is_none")]
    pub second: Option<D>,
    /// Whether it is only approximate.
    #[serde(default)]
    pub approx: bool,
    /// The reference frame.
    #[serde(default)]
    pub frame: DirectionFrame,
}

fn unset_direction<D>() -> Option<D> {
    None
}

impl<D> DirectionAim<D> {
    /// Returns an aim straight in one direction.
    pub const fn aim_at(first: D) -> Self {
        Self {
            first,
            second: None,
            approx: false,
            frame: DirectionFrame::Plain,
        }
    }
}

impl DirectionAim<CompassDirection> {
    /// Returns the angle (rad) as in [`CompassDirection::compass_angle`]; half-way on the shorter side if there are two.
    #[must_use]
    pub fn aim_angle(&self) -> f64 {
        let first = self.first.compass_angle();
        let Some(second) = self.second else {
            return first;
        };
        let apart = second.compass_angle() - first;
        let turns = (apart / std::f64::consts::TAU).round();
        first + (apart - turns * std::f64::consts::TAU) / 2.0
    }
}

/// The reference frame of a direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DirectionFrame {
    /// By default the signer's body.
    #[default]
    Plain,
    /// The body, stated explicitly.
    Absolute,
    /// The movement's direction, or the place on the body.
    Relative,
}

/// The symbols of a part in text, if they differ from those the printer would choose.
///
/// Two parts are equal whatever their spelling. Code that changes a part must reset its spelling
/// (`WrittenSymbols::default()`).
#[derive(Debug, Clone, Default)]
pub struct WrittenSymbols(pub Option<Box<str>>);

impl PartialEq for WrittenSymbols {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
