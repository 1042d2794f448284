//! Infers the unit and the axes in which a skeleton was written, from the body that it describes.

use glam::DVec3;

use super::measures::{BodyMeasures, trunk_axes};
use super::{BodyAnatomy, BodyPart};
use crate::axes::{AxisDirection, SignerAxes, SpaceConvention};
use crate::hand::BodySide;
use crate::pose::ModelPose;
use crate::skeleton::Skeleton;

/// The likely unit and axes of a skeleton, and the reasons.
#[derive(Debug, Clone, PartialEq)]
pub struct ConventionGuess {
    /// The unit and axes; those of model space if there is no evidence for others.
    pub convention: SpaceConvention,
    /// `m`, `cm`, `mm`, `inch`, `acclaim` (1/0.45 inch) or `unknown`.
    pub unit_name: &'static str,
    /// Confidence in the guess: 1 if everything fits, 0 if there is no evidence.
    pub confidence: f64,
    /// Confidence in the axes alone.
    pub axes_confidence: f64,
    /// The evidence for and against the guess, a sentence each.
    pub reasons: Vec<String>,
}

impl ConventionGuess {
    /// Returns the reason that doubts the unit, if it gives the body a stature that few people have.
    #[must_use]
    pub fn unusual_stature(&self) -> Option<&str> {
        let mut reasons = self.reasons.iter().map(String::as_str);
        reasons.find(|reason| reason.starts_with(UNUSUAL_UNIT_REASON))
    }
}

/// The beginning of the reason that doubts the unit.
const UNUSUAL_UNIT_REASON: &str = "a stature of ";

/// The units in which files are written, each with its name and its length in metres. Acclaim's unit is 1/0.45 inch,
/// as CMU's skeletons state it.
const FILE_LENGTH_UNITS: [(&str, f64); 5] = [
    ("m", 1.0),
    ("cm", 0.01),
    ("mm", 0.001),
    ("inch", 0.0254),
    ("acclaim", 0.0254 / 0.45),
];

/// The factor in stature, as a logarithm, by which a unit other than metric ones must fit better: a body of 100 units is
/// rather 1 m tall in centimetres than 2.54 m in inches.
const RARE_UNIT_PENALTY: f64 = 0.15;

/// The statures that a unit may give to a body, in metres; they include children.
const STATURE_RANGE_M: std::ops::Range<f64> = 1.2..2.3;

/// The stature in metres assumed for a body whose unit is not one of the usual units of files.
const ASSUMED_STATURE_M: f64 = 1.7;

impl BodyAnatomy {
    /// Guesses the unit and axes of a skeleton as a file wrote it.
    ///
    /// The unit follows from the stature; the axes follow from the direction from hips to shoulders (up) and from right
    /// to left. Many files keep bones along one local axis and put the body together by rotations only. Therefore pass
    /// the posture of the first frame, in the file's own unit and axes, if there is one: it decides if the rest pose is
    /// ambiguous, or if the two stand or face in different directions.
    #[must_use]
    pub fn guess_convention(&self, skeleton: &Skeleton, first: Option<&ModelPose>) -> ConventionGuess {
        let mut reasons = Vec::new();
        let rest = skeleton.rest_model_pose();
        let measures = BodyMeasures::measure_body(self, skeleton, &rest);
        let (unit_name, metres_per_unit, sure) = guess_length_unit(measures, skeleton, &rest, &mut reasons);
        let (axes, sure_axes) = self.guess_signer_axes(&rest, first, &mut reasons);
        ConventionGuess {
            convention: SpaceConvention { metres_per_unit, axes },
            unit_name,
            confidence: sure.min(sure_axes),
            axes_confidence: sure_axes,
            reasons,
        }
    }

    fn guess_signer_axes(
        &self,
        rest: &ModelPose,
        first: Option<&ModelPose>,
        reasons: &mut Vec<String>,
    ) -> (SignerAxes, f64) {
        let still = trunk_axes(self, rest);
        let posed = first.and_then(|pose| trunk_axes(self, pose));
        // Below this cosine, rest pose and first frame point different ways.
        let turned = |n: usize, least: f64| {
            let pair = still.zip(posed);
            pair.is_some_and(|(still, posed)| still[n].dot(posed[n]) < least)
        };
        let first_frame = |why: &str| format!("the first frame (the rest pose {why})");
        let (chosen, why) = match (still, posed) {
            (None, Some(posed)) => (posed, first_frame("does not show the trunk")),
            (_, Some(posed)) if turned(1, 0.7) => (posed, first_frame("stands another way up")),
            (_, Some(posed)) if turned(2, 0.5) => (posed, first_frame("faces another way")),
            (Some(still), _) => (still, "the rest pose".to_owned()),
            (None, None) => {
                reasons.push(
                    "neither the rest pose nor the first frame shows a trunk with two sides: \
                     Y up and the left at +X are assumed; say the axes if that is wrong"
                        .to_owned(),
                );
                return (SignerAxes::MODEL_AXES, 0.0);
            }
        };
        let [left, up, _] = chosen;
        let up_axis = AxisDirection::nearest_axis_direction(up);
        let mut off = left;
        // The up axis is taken already: left is the strongest of the two others.
        off[up_axis.axis.index()] = 0.0;
        let Some(axes) = SignerAxes::new(up_axis, AxisDirection::nearest_axis_direction(off)) else {
            reasons.push("the trunk lies askew to all axes; Y up is assumed".to_owned());
            return (SignerAxes::MODEL_AXES, 0.0);
        };
        reasons.push(format!(
            "up is {} and left is {} in {why}",
            axes.up_direction(),
            axes.left_direction()
        ));
        let mut sure = up
            .dot(axes.up_direction().axis_direction_vector())
            .min(left.dot(axes.left_direction().axis_direction_vector()));
        // Toes that point back reveal a mirrored file, which nothing else does.
        if self.toes_point_back(first.unwrap_or(rest)) {
            sure *= 0.5;
            reasons.push(
                "the toes point away from where the body would face: the file may have left and \
                 right, or a left-handed space, exchanged"
                    .to_owned(),
            );
        }
        (axes, sure.clamp(0.0, 1.0))
    }

    fn toes_point_back(&self, pose: &ModelPose) -> bool {
        let feet: Vec<DVec3> = BodySide::BOTH_SIDES
            .iter()
            .filter_map(|&side| {
                let toes = self.part_joint(BodyPart::Toes(side))?;
                let foot = self.part_joint(BodyPart::Foot(side))?;
                (pose.model_joint_position(toes) - pose.model_joint_position(foot)).try_normalize()
            })
            .collect();
        let forward = trunk_axes(self, pose).map(|[_, _, forward]| forward);
        // Both feet, since one may be turned far out.
        !feet.is_empty() && forward.is_some_and(|forward| feet.iter().all(|foot| foot.dot(forward) < -0.5))
    }
}

fn guess_length_unit(
    measures: Option<BodyMeasures>,
    skeleton: &Skeleton,
    rest: &ModelPose,
    reasons: &mut Vec<String>,
) -> (&'static str, f64, f64) {
    let Some(measures) = measures else {
        let (metres, kept) = fallback_scale(skeleton, rest);
        reasons.push(format!(
            "no arm, leg or hand to infer the unit from: {kept}; say the unit if that is wrong"
        ));
        return ("unknown", metres, 0.0);
    };
    // The geometric mean: statures are compared by factors.
    let middle = (STATURE_RANGE_M.start * STATURE_RANGE_M.end).sqrt();
    let off = |metres: f64| (measures.stature * metres / middle).ln().abs();
    let unlikely = |(name, metres): (&str, f64)| {
        let is_rare = matches!(name, "inch" | "acclaim");
        off(metres) + if is_rare { RARE_UNIT_PENALTY } else { 0.0 }
    };
    let (name, metres) = FILE_LENGTH_UNITS
        .into_iter()
        .min_by(|a, b| unlikely(*a).total_cmp(&unlikely(*b)))
        .unwrap_or(FILE_LENGTH_UNITS[0]);
    let stature = measures.stature * metres;
    let half = (STATURE_RANGE_M.end / middle).ln();
    // Beyond 1.7 times the range no unit makes the body a person.
    if off(metres) > half * 1.7 {
        let metres = ASSUMED_STATURE_M / measures.stature;
        reasons.push(format!(
            "a body {:.4} units tall is no person in metres, centimetres, millimetres, inches or \
             Acclaim's unit: it is taken for {ASSUMED_STATURE_M} m tall; say the unit if that is wrong",
            measures.stature
        ));
        return ("unknown", metres, 0.0);
    }
    reasons.push(format!(
        "a body {:.2} units tall is {stature:.2} m in {name}",
        measures.stature
    ));
    // Within the wider limits it may be a child or a figure: half sure.
    let sure = if STATURE_RANGE_M.contains(&stature) { 1.0 } else { 0.5 };
    if sure < 1.0 {
        reasons.push(format!("{UNUSUAL_UNIT_REASON}{stature:.2} m is unusual"));
    }
    (name, metres, sure)
}

/// Returns the scale for an unknown unit and its name: metres, or centimetres if the skeleton would be larger than
/// three metres.
fn fallback_scale(skeleton: &Skeleton, rest: &ModelPose) -> (f64, &'static str) {
    let root = rest.model_joint_position(0);
    let ends = (0..skeleton.len()).map(|j| {
        rest.bone_tip_position(skeleton, j)
            .unwrap_or(rest.model_joint_position(j))
    });
    let extent = ends.map(|at| at.distance(root)).fold(0.0, f64::max);
    if extent > 3.0 {
        (0.01, "it is taken for centimetres")
    } else {
        (1.0, "it is taken for metres")
    }
}
