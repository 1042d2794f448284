//! How a file was understood, with a struct for each kind of thing that files hold.

use std::ops::Deref;
use std::sync::Arc;

use chereme_formats::eaf;
use chereme_formats::lexicon::LexiconColumn;
use chereme_formats::roles::TierGuess;
use chereme_motion::PartEvidence;
use serde::{Serialize, Serializer};

use crate::track::TrackKind;

/// The interpretation of a file. JSON has the fields of all parts side by side.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FileInterpretation {
    /// Movement: its rate, unit and axes.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub movement: Option<MovementRead>,
    /// The joints of a body.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub body: Option<SharedPart<BodyRead>>,
    /// How the root was read, if an option decided that.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub root: Option<RootRead>,
    /// Joints whose offsets contradict the movement, which counts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placed_by_movement: Option<Vec<String>>,
    /// Frames at the ends that are no part of the movement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub odd_frames: Option<Vec<String>>,
    /// Frames in which the movement was probably lost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lapses: Option<Vec<String>>,
    /// Tiers of an annotation file, or how ELAN shows them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tiers: Option<SharedPart<TiersRead>>,
    /// Columns of a lexicon table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<Vec<LexiconColumn>>,
    /// The lexicon to which the signs of the file belong.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lexicon: Option<String>,
    /// Recordings that took the tiers of a template.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recordings: Option<Vec<String>>,
    /// Inventories, by their ids.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inventories: Option<Vec<String>>,
    /// Tracks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tracks: Option<Vec<TrackRead>>,
    /// Changes of annotations by a file that was imported before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes: Option<ReimportChanges>,
}

impl FileInterpretation {
    /// Returns whether nothing is known.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns what the tiers were taken for.
    #[must_use]
    pub fn guessed_tiers(&self) -> &[TierGuess] {
        match self.tiers.as_deref() {
            Some(TiersRead::Guessed(tiers)) => tiers,
            Some(TiersRead::Shown(_)) | None => &[],
        }
    }
}

/// A part of an interpretation that is held once for all files in which it is the same, since an import of many takes
/// reports the same body and the same tiers for each of them.
#[derive(Debug, PartialEq)]
pub struct SharedPart<T>(Arc<T>);

impl<T> Clone for SharedPart<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> From<T> for SharedPart<T> {
    fn from(part: T) -> Self {
        Self(Arc::new(part))
    }
}

impl<T> Deref for SharedPart<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Serialize> Serialize for SharedPart<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// The parts of the interpretations of earlier files.
#[derive(Debug, Default)]
pub(super) struct EarlierInterpretations {
    bodies: Vec<SharedPart<BodyRead>>,
    tiers: Vec<SharedPart<TiersRead>>,
}

impl EarlierInterpretations {
    /// Replaces parts of an interpretation by equal ones of earlier files.
    pub(super) fn share_equal_parts(&mut self, understood: &mut FileInterpretation) {
        share_equal_part(&mut self.bodies, understood.body.as_mut());
        share_equal_part(&mut self.tiers, understood.tiers.as_mut());
    }
}

fn share_equal_part<T: PartialEq>(earlier: &mut Vec<SharedPart<T>>, own: Option<&mut SharedPart<T>>) {
    /// The largest number of different parts that are compared.
    const MAX_COMPARED_PARTS: usize = 16;
    let Some(own) = own else { return };
    match earlier.iter().find(|shared| **shared == *own) {
        Some(same) => *own = same.clone(),
        // Each new part is compared with all that are held, so their number is limited.
        None if earlier.len() < MAX_COMPARED_PARTS => earlier.push(own.clone()),
        None => {}
    }
}

/// Movement as it was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MovementRead {
    /// How many joints there are.
    pub joints: usize,
    /// How many channels there are, of a format that lists them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub channels: Option<usize>,
    /// The rate, such as `30 fps`.
    pub frame_rate: String,
    /// The name of the unit.
    pub unit: &'static str,
    /// The unit in metres.
    pub metres_per_unit: f64,
    /// The axes that point up and to the left.
    pub axes: String,
    /// How sure unit and axes are, if they were inferred.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub guess: Option<ConventionRead>,
}

/// How sure the unit and the axes of movement are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConventionRead {
    /// From 0 to 1.
    pub confidence: f64,
    /// The evidence, a sentence each.
    pub reasons: Vec<String>,
}

/// The joints of a body, as they were identified.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct BodyRead {
    /// The parts of the body that were found.
    pub roles: Vec<JointRole>,
    /// The names of all joints, in their order.
    pub joint_names: Vec<String>,
    /// Parts that were not found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<String>,
    /// Optical markers among the joints.
    pub markers: Vec<String>,
}

/// A part of the body, and the joint that it is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointRole {
    /// The part, such as `right hand`.
    pub part: String,
    /// The joint's name.
    pub joint: String,
    /// The evidence.
    pub by: PartEvidence,
}

/// How the root was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RootRead {
    /// The order of its columns.
    pub root_order: &'static str,
    /// The factor for its places.
    pub root_scale: f64,
}

/// The tiers of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum TiersRead {
    /// Tiers with their inferred roles.
    Guessed(Vec<TierGuess>),
    /// Order, colours and visibility.
    Shown(eaf::eaf_settings::TierDisplaySettings),
}

/// A track as it was stored.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrackRead {
    /// The kind.
    pub kind: TrackKind,
    /// The name.
    pub name: String,
    /// Frames in a second.
    pub rate: Option<f64>,
    /// How many frames there are.
    pub frames: Option<u64>,
    /// Where it begins on the clock of the recording, in microseconds.
    pub offset_us: i64,
    /// Its duration in microseconds.
    pub duration_us: Option<i64>,
    /// How many joints, points or scalar channels it has.
    pub channels: u64,
    /// The unit of places in metres, if it has places in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metres_per_unit: Option<f64>,
    /// The axes of its places that point up and to the left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<String>,
}

impl TrackRead {
    /// Describes the track in a line for people; nothing for media.
    #[must_use]
    pub fn track_description_line(&self) -> Option<String> {
        let (name, channels, frames) = (&self.name, self.channels, self.frames?);
        let seconds = self.duration_us.unwrap_or_default() as f64 / 1e6;
        let rate = match self.rate {
            Some(rate) => format!("{} fps", round_frame_rate(rate)),
            None => format!("~{} fps", round_frame_rate(frames as f64 / seconds.max(1e-6))),
        };
        let what = match self.kind {
            TrackKind::Markers => "points",
            TrackKind::Curves => "curves",
            _ => return None,
        };
        let head = format!("track {name}: {channels} {what}, {frames} frames, {rate}");
        Some(match (self.metres_per_unit, &self.axes) {
            (Some(metres), Some(axes)) => {
                let unit = match metres {
                    1.0 => "m".to_owned(),
                    0.01 => "cm".to_owned(),
                    0.001 => "mm".to_owned(),
                    other => format!("{other} m"),
                };
                format!("{head}, unit {unit}, axes up,left = {axes}")
            }
            _ => head,
        })
    }
}

/// Rounds a rate to three decimals.
fn round_frame_rate(rate: f64) -> f64 {
    (rate * 1000.0).round() / 1000.0
}

/// How many annotations a file that was imported before has changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct ReimportChanges {
    /// Annotations that are new.
    pub added: usize,
    /// Annotations with another value or time.
    pub changed: usize,
    /// Annotations that the file has no more.
    pub removed: usize,
    /// Annotations that stayed.
    pub unchanged: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_parts_of_many_reports_are_stored_once() {
        let of = |name: &str| FileInterpretation {
            body: Some(SharedPart::from(BodyRead {
                joint_names: vec![name.to_owned()],
                ..BodyRead::default()
            })),
            ..FileInterpretation::default()
        };
        let mut all = [of("Hips"), of("Hips"), of("pelvis"), of("Hips")];
        let before: Vec<String> = all.iter().map(|it| format!("{it:?}")).collect();
        let mut earlier = EarlierInterpretations::default();
        all.iter_mut().for_each(|it| earlier.share_equal_parts(it));
        let after: Vec<String> = all.iter().map(|it| format!("{it:?}")).collect();
        assert_eq!(after, before, "they say the same");
        let held = |at: usize| all[at].body.as_ref().map(|body| Arc::as_ptr(&body.0));
        assert!(held(0) == held(1) && held(0) == held(3) && held(0) != held(2));
        let json = serde_json::to_value(&all[1]).expect("JSON");
        assert_eq!(json["joint_names"][0], "Hips", "side by side with the other parts");
    }
}
