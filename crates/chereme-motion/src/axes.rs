//! Units and axes of a file, and the conversion to model space and back.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::clip::{Clip, JointChannel};
use crate::skeleton::{Skeleton, SkeletonJoint};

/// One of the three axes of a space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum SpaceAxis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl SpaceAxis {
    /// Returns 0, 1 or 2.
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns the unit vector along the axis.
    #[must_use]
    pub const fn axis_vector(self) -> DVec3 {
        match self {
            Self::X => DVec3::X,
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
        }
    }

    /// Returns the right-handed rotation by `angle` radians about the axis.
    #[must_use]
    pub fn axis_rotation(self, angle: f64) -> DQuat {
        DQuat::from_axis_angle(self.axis_vector(), angle)
    }
}

/// An axis and the direction along it, written `+Y` or `-Z`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct AxisDirection {
    /// The axis.
    pub axis: SpaceAxis,
    /// Whether it points against the axis.
    pub negative: bool,
}

impl AxisDirection {
    /// Returns the direction nearest to `vector`; of equally near ones that of the first axis.
    #[must_use]
    pub fn nearest_axis_direction(vector: DVec3) -> Self {
        let size = vector.abs();
        let axis = if size.x >= size.y && size.x >= size.z {
            SpaceAxis::X
        } else if size.y >= size.z {
            SpaceAxis::Y
        } else {
            SpaceAxis::Z
        };
        Self {
            axis,
            negative: vector[axis.index()] < 0.0,
        }
    }

    /// Returns the unit vector of the direction.
    #[must_use]
    pub fn axis_direction_vector(self) -> DVec3 {
        if self.negative {
            -self.axis.axis_vector()
        } else {
            self.axis.axis_vector()
        }
    }
}

impl fmt::Display for AxisDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{:?}", if self.negative { '-' } else { '+' }, self.axis)
    }
}

/// A text that is not a direction or a pair of axes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} names no axes; write a direction as +X, -Z …, and axes as up,left: for example +Y,+X")]
pub struct AxesError(pub String);

impl FromStr for AxisDirection {
    type Err = AxesError;
    fn from_str(text: &str) -> Result<Self, AxesError> {
        let error = || AxesError(text.to_owned());
        let (negative, name) = match text.trim() {
            t if t.starts_with('-') => (true, &t[1..]),
            t => (false, t.strip_prefix('+').unwrap_or(t)),
        };
        let axis = match name {
            "X" | "x" => SpaceAxis::X,
            "Y" | "y" => SpaceAxis::Y,
            "Z" | "z" => SpaceAxis::Z,
            _ => return Err(error()),
        };
        Ok(Self { axis, negative })
    }
}

crate::keep_as_text!(AxisDirection);

/// The directions in a file that are the signer's up and left; the third follows from the right-hand rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct SignerAxes {
    up: AxisDirection,
    left: AxisDirection,
}

impl SignerAxes {
    /// Model space: Y up, the left at +X, facing +Z.
    pub const MODEL_AXES: Self = Self {
        up: AxisDirection {
            axis: SpaceAxis::Y,
            negative: false,
        },
        left: AxisDirection {
            axis: SpaceAxis::X,
            negative: false,
        },
    };

    /// Returns the axes with these directions for up and left; `None` if both are on one axis.
    #[must_use]
    pub fn new(up: AxisDirection, left: AxisDirection) -> Option<Self> {
        (up.axis != left.axis).then_some(Self { up, left })
    }

    /// Returns the direction that is up in the file.
    #[must_use]
    pub fn up_direction(self) -> AxisDirection {
        self.up
    }

    /// Returns the direction to the signer's left in the file.
    #[must_use]
    pub fn left_direction(self) -> AxisDirection {
        self.left
    }

    /// Returns the direction that the signer faces in the file.
    #[must_use]
    pub fn forward_direction(self) -> AxisDirection {
        // Left × up is forward in a right-handed space: X × Y = Z.
        AxisDirection::nearest_axis_direction(self.left.axis_direction_vector().cross(self.up.axis_direction_vector()))
    }

    /// Returns the rotation from the file's directions to those of model space.
    #[must_use]
    pub fn to_model(self) -> DQuat {
        let (left, up, forward) = (
            self.left.axis_direction_vector(),
            self.up.axis_direction_vector(),
            self.forward_direction().axis_direction_vector(),
        );
        // The columns lead from model space to the file, so the transpose is the way back.
        DQuat::from_mat3(&DMat3::from_cols(left, up, forward).transpose()).normalize()
    }
}

impl fmt::Display for SignerAxes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.up, self.left)
    }
}

impl FromStr for SignerAxes {
    type Err = AxesError;
    fn from_str(text: &str) -> Result<Self, AxesError> {
        let error = || AxesError(text.to_owned());
        let (up, left) = text.split_once(',').ok_or_else(error)?;
        Self::new(up.parse()?, left.parse()?).ok_or_else(error)
    }
}

/// The conversion of a file's numbers to metres in model space: its unit and its axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpaceConvention {
    /// Metres per unit of the file; above zero.
    pub metres_per_unit: f64,
    /// The file's axes.
    pub axes: SignerAxes,
}

impl SpaceConvention {
    /// Metres in model space: nothing to convert.
    pub const MODEL_CONVENTION: Self = Self {
        metres_per_unit: 1.0,
        axes: SignerAxes::MODEL_AXES,
    };

    /// Converts a position in the file to metres in model space.
    #[must_use]
    pub fn file_point_to_model(&self, at: DVec3) -> DVec3 {
        self.axes.to_model() * (at * self.metres_per_unit)
    }

    /// Converts `skeleton` from the file's unit and axes to metres and model axes.
    #[must_use]
    pub fn file_skeleton_to_model(&self, skeleton: &Skeleton) -> Skeleton {
        self.map_skeleton(skeleton, self.axes.to_model(), self.metres_per_unit)
    }

    /// Converts `clip` from the file's unit and axes to metres and model axes.
    ///
    /// The own space of every joint is rotated in the same way, so that offsets o, translations t and rotations q
    /// become s·(C o), s·(C t) and C q C⁻¹, with C the change of axes and s the metres per unit.
    #[must_use]
    pub fn file_clip_to_model(&self, clip: &Clip) -> Clip {
        self.map_clip(clip, self.axes.to_model(), self.metres_per_unit)
    }

    /// Converts `clip` from metres and model axes to the file's unit and axes: the inverse of [`clip`](Self::file_clip_to_model).
    #[must_use]
    pub fn clip_back(&self, clip: &Clip) -> Clip {
        self.map_clip(clip, self.axes.to_model().inverse(), 1.0 / self.metres_per_unit)
    }

    fn map_skeleton(&self, skeleton: &Skeleton, turn: DQuat, scale: f64) -> Skeleton {
        let joints = skeleton
            .skeleton_joints()
            .iter()
            .map(|joint| SkeletonJoint {
                name: joint.name.clone(),
                parent: joint.parent,
                offset: turn * (joint.offset * scale),
                // The rest rotation changes axes on both sides: its own space turns with its parent's.
                rest: (turn * joint.rest * turn.inverse()).normalize(),
                tip: joint.tip.map(|tip| turn * (tip * scale)),
            })
            .collect();
        // No joint is added or reordered, which is all that could make a skeleton invalid.
        Skeleton::new(joints).expect("turning and scaling keeps a skeleton one")
    }

    fn map_clip(&self, clip: &Clip, turn: DQuat, scale: f64) -> Clip {
        let skeleton = Arc::new(self.map_skeleton(clip.clip_skeleton(), turn, scale));
        let back = turn.inverse();
        let channels = clip
            .joint_channels()
            .iter()
            .map(|channel| JointChannel {
                rotations: channel
                    .rotations
                    .iter()
                    .map(|&q| (turn * q * back).normalize())
                    .collect(),
                translations: channel
                    .translations
                    .as_ref()
                    .map(|places| places.iter().map(|&t| turn * (t * scale)).collect()),
            })
            .collect();
        Clip::new(skeleton, clip.clip_frame_rate(), channels).expect("turning and scaling keeps a clip one")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::FrameRate;

    fn all_axes() -> Vec<SignerAxes> {
        let names = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];
        let pairs = names
            .iter()
            .flat_map(|up| names.iter().map(move |left| format!("{up},{left}")));
        pairs.filter_map(|text| text.parse().ok()).collect()
    }

    #[test]
    fn all_twenty_four_axes_turn_up_left_and_forward_to_y_x_and_z() {
        let all = all_axes();
        assert_eq!(all.len(), 24);
        for axes in all {
            let turn = axes.to_model();
            assert!(
                (turn * axes.up_direction().axis_direction_vector()).abs_diff_eq(DVec3::Y, 1e-12),
                "{axes}"
            );
            assert!(
                (turn * axes.left_direction().axis_direction_vector()).abs_diff_eq(DVec3::X, 1e-12),
                "{axes}"
            );
            assert!(
                (turn * axes.forward_direction().axis_direction_vector()).abs_diff_eq(DVec3::Z, 1e-12),
                "{axes}"
            );
            assert_eq!(axes.to_string().parse(), Ok(axes));
        }
        assert!("+Y,-Y".parse::<SignerAxes>().is_err() && "up".parse::<SignerAxes>().is_err());
    }

    #[test]
    fn a_clip_converted_there_and_back_is_unchanged() {
        let skeleton = Skeleton::new(vec![
            SkeletonJoint::new("a", None, DVec3::new(1.0, 2.0, 3.0)),
            SkeletonJoint::new("b", Some(0), DVec3::new(0.0, 10.0, 4.0)).with_tip(DVec3::Z),
        ])
        .expect("a tree");
        let mut channels =
            Clip::from_rest_pose(skeleton.clone().into(), FrameRate::new(1, 1).expect("rate"), 1).into_channels();
        channels[0].rotations[0] = DQuat::from_rotation_x(0.7) * DQuat::from_rotation_z(0.2);
        channels[0].translations = Some(vec![DVec3::new(5.0, 6.0, 7.0)]);
        let clip = Clip::new(skeleton.into(), FrameRate::new(1, 1).expect("rate"), channels).expect("clip");
        for axes in all_axes() {
            let convention = SpaceConvention {
                metres_per_unit: 0.01,
                axes,
            };
            let model = convention.file_clip_to_model(&clip);
            let there = convention.file_point_to_model(clip.model_pose(0).model_joint_position(1));
            assert!(model.model_pose(0).model_joint_position(1).abs_diff_eq(there, 1e-12));
            let back = convention.clip_back(&model);
            assert!(back.clip_pose_at(0).rotations[0].angle_between(clip.clip_pose_at(0).rotations[0]) < 1e-7);
            assert!(
                back.model_pose(0)
                    .model_joint_position(1)
                    .abs_diff_eq(clip.model_pose(0).model_joint_position(1), 1e-9)
            );
        }
    }
}
