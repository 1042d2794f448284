//! Face systems: the names of the channels of a face capture, and their mapping to this project's [`FacePosture`].
//!
//! Each system is a file of `schema/faces`: its channels, a formula over them for each number of a face and for the
//! turns of the head, and the losses of the mapping. Captured channels stay as they are; a [`DerivedFaceView`] is derived from
//! them.
//!
//! ```
//! use chereme_formats::faces::FaceSystem;
//! use chereme_motion::{FrameNumberColumn, ScalarCurve, CurveTrack, FrameRate, FrameTimes};
//!
//! let channel = |name, value| ScalarCurve::new(name, FrameNumberColumn::from_double_floats(vec![value]));
//! let shapes = ["JawOpen", "BrowInnerUp", "EyeBlinkLeft", "MouthClose"];
//! let curves = shapes.map(|name| channel(name, 0.5)).to_vec();
//! let curves = CurveTrack::new(FrameTimes::Even(FrameRate::new(60, 1)?), curves)?;
//! let arkit = FaceSystem::system_of_curves(&curves).expect("these are shapes of ARKit");
//! let view = arkit.derive_face_view(&curves);
//! assert_eq!((arkit.id.as_str(), view.faces[0].jaw), ("arkit", 0.5));
//! assert_eq!(view.face_number_values("tongue_left"), None, "it has no such channel");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod faces_fit;
mod faces_mesh;
mod formula;
#[cfg(test)]
#[path = "tests/mesh.rs"]
mod mesh_tests;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use chereme_motion::{CurveTrack, FacePosture};
use serde::{Deserialize, Serialize};

use crate::finding::{FindingSeverity, ImportFinding};
use formula::FaceFormula;

pub use faces_fit::{ExcursionReach, FaceCalibration};
pub use faces_mesh::{FACE_MEASURE_COUNT, FaceMeasures, FaceMesh};

/// The files of systems, in the order in which a capture is compared with them.
const FACE_SYSTEM_FILES: [&str; 7] = [
    chereme_data::schema_text("faces/house.json"),
    chereme_data::schema_text("faces/mediapipe.json"),
    chereme_data::schema_text("faces/arkit.json"),
    chereme_data::schema_text("faces/openface.json"),
    chereme_data::schema_text("faces/fap.json"),
    chereme_data::schema_text("faces/sigml.json"),
    chereme_data::schema_text("faces/mesh.json"),
];

/// A system of face parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaceSystem {
    /// The short name, such as `arkit`.
    pub id: String,
    /// The version of the mapping.
    pub version: u32,
    /// The name for people.
    pub name: String,
    /// Its numbers, and their source.
    pub description: String,
    /// Channels that identify a capture of this system, if it has all of them.
    needs: Vec<String>,
    /// Channels that identify a capture of this system, too; one of them is enough.
    #[serde(default)]
    or: Vec<String>,
    /// Channels that rule this system out.
    #[serde(default)]
    without: Vec<String>,
    /// The channels as the system spells them.
    pub channels: Vec<String>,
    /// Other names of channels.
    #[serde(default)]
    pub aliases: BTreeMap<String, String>,
    /// The formula over the channels for each number of a [`FacePosture`], by its name in [`FacePosture::FACE_NUMBER_NAMES`].
    pub house: BTreeMap<String, String>,
    /// The formulas in radians for the turns of the head: `pitch` (down), `yaw` (to the signer's left) and `roll` (to
    /// the right).
    #[serde(default)]
    pub head: BTreeMap<String, String>,
    /// The formulas in metres for the place of the head: `left`, `up` and `forward`.
    #[serde(default)]
    pub place: BTreeMap<String, String>,
    /// Whether each channel is a code of SiGML, whose posture `schema/notation/face.json` defines.
    #[serde(default)]
    pub expressions: bool,
    /// Whether the channels in the formulas of [`Self::house`] are shares from 0 to 1.
    #[serde(default)]
    shares: bool,
    /// Numbers of a face for which the system has no channels.
    pub unknown: Vec<String>,
    /// The losses of the mapping.
    pub loses: Vec<MappingLoss>,
    /// The least values of channels in a frame with a face; frames below them show no face.
    #[serde(default)]
    sure: BTreeMap<String, f64>,
    /// Pairs of channels that move together in people; if they move against each other, the capture has its sides
    /// exchanged.
    #[serde(default)]
    agree: Vec<[String; 2]>,
}

/// Something that a mapping loses.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MappingLoss {
    /// The affected numbers of a face, or `head`.
    pub channels: Vec<String>,
    /// A sentence that describes the loss.
    pub says: String,
    /// The severity of the loss.
    pub severity: FindingSeverity,
}

/// A face that is derived from captured channels, frame by frame.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivedFaceView {
    /// The system of the channels.
    pub system: &'static FaceSystem,
    /// The face of each frame; unknown numbers are 0.
    pub faces: Vec<FacePosture>,
    /// Which numbers of a face the capture gives.
    pub known: [bool; FacePosture::FACE_NUMBER_COUNT],
    /// The turns of the head in each frame, in radians: pitch (down), yaw (to the signer's left), roll (to the right).
    pub head: Option<Vec<[f64; 3]>>,
    /// The place of the head in each frame, in metres to the signer's left, up and forward.
    pub place: Option<Vec<[f64; 3]>>,
    /// The number of frames with a gap that was filled from its neighbours.
    pub bridged: usize,
    /// The losses of the mapping, and oddities of the capture.
    pub findings: Vec<ImportFinding>,
    /// The units that were converted or guessed; they are among the findings, too.
    pub units: Vec<ImportFinding>,
}

impl DerivedFaceView {
    /// Returns the numbers of a name of [`FacePosture::FACE_NUMBER_NAMES`] over all frames; `None` if the capture does not give them.
    #[must_use]
    pub fn face_number_values(&self, name: &str) -> Option<Vec<f64>> {
        let channel_index = FacePosture::face_number_position(name).filter(|at| self.known[*at])?;
        Some(
            self.faces
                .iter()
                .map(|face| face.face_numbers()[channel_index])
                .collect(),
        )
    }
}

impl FaceSystem {
    /// Returns every system.
    #[must_use]
    pub fn all_face_systems() -> &'static [Self] {
        static ALL_FACE_SYSTEMS: OnceLock<Vec<FaceSystem>> = OnceLock::new();
        ALL_FACE_SYSTEMS.get_or_init(|| {
            let read = |text: &&str| serde_json::from_str(text);
            let all: Result<_, _> = FACE_SYSTEM_FILES.iter().map(read).collect();
            all.expect("the program's own face systems are whole, which a test shows")
        })
    }

    /// Returns the system of that short name.
    #[must_use]
    pub fn find_face_system(id: &str) -> Option<&'static Self> {
        Self::all_face_systems().iter().find(|system| system.id == id)
    }

    /// Returns the system of a track of curves; `None` if the curves are not a face.
    #[must_use]
    pub fn system_of_curves(curves: &CurveTrack) -> Option<&'static Self> {
        Self::of_names(curves.track_curves().iter().map(|curve| curve.name.as_str()))
    }

    /// Returns the system of channels of these names; `None` if they are not a face's.
    #[must_use]
    pub fn of_names<'a>(names: impl Iterator<Item = &'a str>) -> Option<&'static Self> {
        let names: Vec<String> = names.map(plain_channel_name).collect();
        let has = |name: &String| names.contains(&plain_channel_name(name));
        Self::all_face_systems().iter().find(|system| {
            let alias = |name: &String| {
                let other = system.aliases.iter().find(|(_, channel)| *channel == name);
                has(name) || other.is_some_and(|(alias, _)| has(alias))
            };
            let all = !system.needs.is_empty() && system.needs.iter().all(alias);
            (all || system.or.iter().any(alias)) && !system.without.iter().any(has)
        })
    }

    /// Reports whether the channels are ARKit's shapes, which Live Link Face has columns for.
    #[must_use]
    pub fn has_live_link_shapes(&self) -> bool {
        ["arkit", "mediapipe"].contains(&self.id.as_str())
    }

    /// Returns the position of the curve that has this channel, by its name or another name of the system.
    pub(crate) fn position_of_channel(&self, curves: &CurveTrack, channel: &str) -> Option<usize> {
        let wanted_name = plain_channel_name(channel);
        curves.track_curves().iter().position(|curve| {
            let name = plain_channel_name(&curve.name);
            let alias = self.aliases.iter().find(|(alias, _)| plain_channel_name(alias) == name);
            alias.map_or(name, |(_, channel)| plain_channel_name(channel)) == wanted_name
        })
    }

    /// Returns the face that the channels of this system describe.
    #[must_use]
    pub fn derive_face_view(&'static self, curves: &CurveTrack) -> DerivedFaceView {
        let mut bridged = vec![false; curves.curve_frame_count()];
        let mut columns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let counted = self.used_channel_names();
        let unsure = self.unsure(curves);
        for curve in curves.track_curves() {
            let name = plain_channel_name(&curve.name);
            let matched_alias = self.aliases.iter().find(|(alias, _)| plain_channel_name(alias) == name);
            let name = matched_alias.map_or(name, |(_, channel)| plain_channel_name(channel));
            if !counted.contains(&name) {
                continue;
            }
            let mut values: Vec<Option<f64>> = curve.values.column_values().collect();
            // A number of which the tracker itself is not sure is worse than one between its neighbours.
            for (value, _) in values.iter_mut().zip(&unsure).filter(|(_, unsure)| **unsure) {
                *value = None;
            }
            for (gap, value) in bridged.iter_mut().zip(&values) {
                *gap |= value.is_none();
            }
            if let Some(whole) = interpolate_gaps(&mut values) {
                columns.entry(name).or_insert(whole);
            }
        }
        let mut units = Vec::new();
        if self.shares {
            let of_head = Self::named_in(self.head.values().chain(self.place.values()));
            // Angles beyond 1 are usual, and say nothing about whether shapes are in percent.
            let (turns, mut shapes) = columns.into_iter().partition(|(name, _)| of_head.contains(name));
            units.extend(from_percent(&mut shapes));
            columns = turns;
            columns.extend(shapes);
        }
        let frames = curves.curve_frame_count();
        let channel = |name: &str| columns.get(&plain_channel_name(name)).map(Vec::as_slice);
        let of = |formulas: &BTreeMap<String, String>, name: &str| {
            let formula = FaceFormula::parse_face_formula(formulas.get(name)?).ok()?;
            formula.evaluate_formula(frames, &channel)
        };
        let three = |formulas: &BTreeMap<String, String>, names: [&str; 3]| {
            let [a, b, c] = names.map(|name| of(formulas, name));
            let (a, b, c) = (a?, b?, c?);
            Some((0..frames).map(|at| [a[at], b[at], c[at]]).collect())
        };
        let numbers = FacePosture::FACE_NUMBER_NAMES.map(|name| of(&self.house, name));
        let face = |frame: usize| {
            let number = |values: &Option<Vec<f64>>| values.as_ref().map_or(0.0, |column| column[frame]);
            FacePosture::from_numbers(std::array::from_fn(|at| number(&numbers[at])))
        };
        let given_channels = std::array::from_fn(|at| numbers[at].is_some());
        let mut head: Option<Vec<[f64; 3]>> = three(&self.head, ["pitch", "yaw", "roll"]);
        if let Some(head) = &mut head {
            // Angles of a head beyond half a turn must be degrees.
            units.extend(from_degrees(head, self.stated_unit(curves)));
        }
        let still = head
            .as_ref()
            .is_some_and(|all| all.iter().flatten().all(|angle| *angle == 0.0));
        let mut findings = self.mapping_loss_findings(&given_channels);
        findings.extend(units.iter().cloned());
        if still {
            let says = "the turns of the head are all 0: the tracker did not record them";
            findings.push(ImportFinding::new_note_finding(None, says));
        }
        for [a, b] in &self.agree {
            findings.extend(disagreeing_channels_finding([a, b], channel(a), channel(b)));
        }
        DerivedFaceView {
            system: self,
            faces: (0..frames).map(face).collect(),
            known: given_channels,
            head: head.filter(|_| !still),
            place: three(&self.place, ["left", "up", "forward"]),
            bridged: bridged.into_iter().filter(|gap| *gap).count(),
            findings,
            units,
        }
    }

    /// Returns the unit of the turns of the head as the file states it; empty if it does not.
    fn stated_unit<'c>(&self, curves: &'c CurveTrack) -> &'c str {
        let turns = Self::named_in(self.head.values());
        let mut turn_curves = curves.track_curves().iter().filter(|curve| {
            let name = plain_channel_name(&curve.name);
            let alias = self.aliases.iter().find(|(alias, _)| plain_channel_name(alias) == name);
            turns.contains(&alias.map_or(name, |(_, channel)| plain_channel_name(channel)))
        });
        turn_curves
            .find(|curve| !curve.unit.is_empty())
            .map_or("", |curve| &curve.unit)
    }

    /// Returns for each frame whether the capture found no face in it.
    fn unsure(&self, curves: &CurveTrack) -> Vec<bool> {
        let mut unsure = vec![false; curves.curve_frame_count()];
        for curve in curves.track_curves() {
            let name = plain_channel_name(&curve.name);
            let least = self.sure.iter().find(|(known, _)| plain_channel_name(known) == name);
            let Some((_, least)) = least else { continue };
            for (unsure, value) in unsure.iter_mut().zip(curve.values.column_values()) {
                *unsure |= value.is_some_and(|value| value < *least);
            }
        }
        unsure
    }

    /// Returns the losses of the mapping for a capture that gives the `known` numbers.
    fn mapping_loss_findings(&self, known: &[bool; FacePosture::FACE_NUMBER_COUNT]) -> Vec<ImportFinding> {
        let concerns = |name: &String| {
            let is_known = |at: usize| known[at] || self.unknown.contains(name);
            FacePosture::face_number_position(name).map_or(self.head.contains_key("yaw"), is_known)
        };
        let relevant_losses = self.loses.iter().filter(|loss| loss.channels.iter().any(concerns));
        let mut findings: Vec<ImportFinding> = relevant_losses
            .map(|loss| match loss.severity {
                FindingSeverity::Note => ImportFinding::new_note_finding(None, &*loss.says),
                FindingSeverity::Warning => ImportFinding::new_warning_finding(None, &*loss.says),
            })
            .collect();
        let missing: Vec<&str> = FacePosture::FACE_NUMBER_NAMES
            .into_iter()
            .zip(known)
            .filter(|(name, known)| !**known && self.house.contains_key(*name))
            .map(|(name, _)| name)
            .collect();
        if !missing.is_empty() && !self.expressions {
            let says = format!("the capture lacks channels for {}", missing.join(", "));
            let remedy = "they are unknown, not at rest, and are left out of scores";
            findings.push(ImportFinding::new_warning_finding(None, says).with_remedy(remedy));
        }
        findings
    }

    /// Returns the channels that formulas and checks use.
    fn used_channel_names(&self) -> BTreeSet<String> {
        let formulas = self.house.values().chain(self.head.values());
        let mut named = Self::named_in(formulas.chain(self.place.values()));
        named.extend(self.agree.iter().flatten().map(|name| plain_channel_name(name)));
        named
    }

    /// Returns the channels that formulas name.
    fn named_in<'a>(formulas: impl Iterator<Item = &'a String>) -> BTreeSet<String> {
        let read: Vec<FaceFormula> = formulas
            .filter_map(|text| FaceFormula::parse_face_formula(text).ok())
            .collect();
        read.iter()
            .flat_map(FaceFormula::formula_channel_names)
            .map(plain_channel_name)
            .collect()
    }
}

/// Returns a name without regard to case and surrounding blanks, and with its side in full: `browDown_L` is `browdownleft`.
fn plain_channel_name(name: &str) -> String {
    let name = name.trim().to_lowercase();
    let sides = [("_l", "left"), ("_r", "right")];
    let sided = sides.iter().find_map(|(end, side)| {
        let rest = name.strip_suffix(end)?;
        Some(format!("{rest}{side}"))
    });
    sided.unwrap_or(name)
}

/// The value above which numbers that should be shares are percent: trackers exceed 1 a little.
pub(crate) const PERCENT_VALUE_LIMIT: f64 = 2.0;
/// The value above which they are percent without a doubt.
const CLEARLY_PERCENT: f64 = 10.0;

/// Divides the channels of shares by 100 if they are percent, and says so.
fn from_percent(columns: &mut BTreeMap<String, Vec<f64>>) -> Option<ImportFinding> {
    let all = columns.values().flatten();
    let most = all.fold(0.0, |most: f64, value| most.max(value.abs()));
    if most <= PERCENT_VALUE_LIMIT {
        return None;
    }
    columns.values_mut().flatten().for_each(|value| *value /= 100.0);
    let says = format!("the shapes should be shares from 0 to 1 and reach {most}: they are read as percent");
    let remedy = match most < CLEARLY_PERCENT {
        true => "check them: if they are shares beyond 1, cut them to 1 and import the file again",
        false => "nothing needs to be done if they are",
    };
    Some(ImportFinding::new_warning_finding(None, says).with_remedy(remedy))
}

/// The farthest that a head turns to a side, in radians, with some room; a greater number may be degrees.
pub(crate) const FARTHEST_TURN: f64 = 1.7;
/// Half a turn in radians with some room: greater numbers are degrees.
pub(crate) const HALF_TURN: f64 = 3.2;

/// Converts the turns of a head to radians if they are degrees, by the unit that the file states or else by their size, and
/// says so.
fn from_degrees(head: &mut [[f64; 3]], unit: &str) -> Option<ImportFinding> {
    let most = (head.iter().flatten()).fold(0.0, |most: f64, turn| most.max(turn.abs()));
    let remedy = "write the unit into the titles, such as HeadYaw [deg] or HeadYaw [rad]";
    let finding = match unit {
        "rad" => return None,
        // A head that was not tracked turns nowhere in any unit.
        _ if most == 0.0 => return None,
        "deg" => ImportFinding::new_note_finding(
            None,
            format!("the turns of the head are degrees and reach {most}: they were converted"),
        ),
        _ if most > HALF_TURN => ImportFinding::new_warning_finding(
            None,
            format!("the turns of the head reach {most}: they are read as degrees"),
        )
        .with_remedy(remedy),
        _ if most > FARTHEST_TURN => {
            let says = format!(
                "the turns of the head reach {most}, too far for radians and little for degrees: they are read as radians"
            );
            return Some(ImportFinding::new_warning_finding(None, says).with_remedy(remedy));
        }
        _ => return None,
    };
    for turn in head.iter_mut().flatten() {
        *turn = turn.to_radians();
    }
    Some(finding)
}

/// Fills gaps by linear interpolation between their neighbours; `None` if there are only gaps.
fn interpolate_gaps(values: &mut [Option<f64>]) -> Option<Vec<f64>> {
    let present_values: Vec<(usize, f64)> = values
        .iter()
        .enumerate()
        .filter_map(|(at, value)| Some((at, (*value)?)))
        .collect();
    let (first, last) = (present_values.first()?, present_values.last()?);
    let mut bridged = vec![first.1; values.len()];
    for pair in present_values.windows(2) {
        let ((from, a), (to, b)) = (pair[0], pair[1]);
        for (n, value) in bridged[from..to].iter_mut().enumerate() {
            *value = a + (b - a) * n as f64 / (to - from) as f64;
        }
    }
    bridged[last.0..].fill(last.1);
    Some(bridged)
}

/// Returns a finding if two channels that move together in people move against each other.
fn disagreeing_channels_finding(names: [&str; 2], a: Option<&[f64]>, b: Option<&[f64]>) -> Option<ImportFinding> {
    let (a, b) = (a?, b?);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut both, mut own_a, mut own_b) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        both += (a - mean_a) * (b - mean_b);
        own_a += (a - mean_a).powi(2);
        own_b += (b - mean_b).powi(2);
    }
    let together = both / (own_a * own_b).sqrt();
    let moves = |own: f64, values: &[f64]| (own / values.len().max(1) as f64).sqrt() > 0.02;
    let odd = moves(own_a, a) && moves(own_b, b) && together < -0.2;
    odd.then(|| {
        let [a, b] = names;
        let says = format!("{a} and {b} move against each other (r = {together:.2}), which faces do not");
        let remedy = "the writer of the file may have exchanged the sides of one pair";
        ImportFinding::new_warning_finding(None, says).with_remedy(remedy)
    })
}
