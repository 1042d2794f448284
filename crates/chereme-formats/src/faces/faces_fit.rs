//! The weights of a mapping fitted to a person, from a take in which the face goes as far as it can.

use std::collections::BTreeMap;

use chereme_motion::FacePosture;
use serde::{Deserialize, Serialize};

use super::DerivedFaceView;

/// The least excursion from rest, in the take, of a number that is fitted; a number that moves less keeps its weights,
/// as the person did not try it out.
const MIN_TRIED_EXCURSION: f64 = 0.15;
/// The greatest factor by which weights grow.
const MAX_WEIGHT_FACTOR: f64 = 4.0;
/// The share of the largest excursion from rest above which a frame counts as active.
const ACTIVE_EXCURSION_SHARE: f64 = 0.25;
/// The share of active frames whose excursions stay below the one that maps to 1.
const FULL_EXCURSION_SHARE: f64 = 0.95;

/// A calibration of a face mapping for one person: each number counts from that person's rest, and is 1 at the
/// excursion that the person seldom exceeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaceCalibration {
    /// The short name of the system, such as `arkit`.
    pub system: String,
    /// The version of the mapping whose weights these factors belong to.
    pub version: u32,
    /// The frames of the take.
    pub frames: usize,
    /// The calibration of each number, by its name in [`FacePosture`].
    pub numbers: BTreeMap<String, ExcursionReach>,
}

/// The rest value of a number, and its usual largest excursions from there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExcursionReach {
    /// The median.
    pub rest: f64,
    /// The excursion upwards that the number seldom exceeds; `None` if the take has none.
    pub up: Option<f64>,
    /// The same downwards.
    pub down: Option<f64>,
}

impl ExcursionReach {
    fn reach_from_values(values: &[f64], position: usize) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let rest = *sorted.get(sorted.len() / 2)?;
        let far = |sign: f64| {
            let mut deviations: Vec<f64> = values.iter().map(|value| sign * (value - rest)).collect();
            let most = deviations.iter().copied().fold(0.0, f64::max);
            if most < MIN_TRIED_EXCURSION {
                return None;
            }
            deviations.retain(|deviation| *deviation >= ACTIVE_EXCURSION_SHARE * most);
            deviations.sort_by(f64::total_cmp);
            let reach_index = (FULL_EXCURSION_SHARE * (deviations.len() - 1) as f64).round() as usize;
            Some(deviations[reach_index].max(1.0 / MAX_WEIGHT_FACTOR))
        };
        let opposite = FacePosture::least_face_number(position) < 0.0;
        Some(Self {
            rest,
            up: far(1.0),
            down: far(-1.0).filter(|_| opposite),
        })
    }

    /// Returns the factors that scale the number's excursions above and below its rest.
    #[must_use]
    pub fn excursion_factors(&self) -> [f64; 2] {
        [self.up, self.down].map(|far| far.map_or(1.0, |far| 1.0 / far))
    }

    fn scale_excursion(&self, value: f64) -> f64 {
        let [up, down] = self.excursion_factors();
        let deviation = value - self.rest;
        deviation * if deviation >= 0.0 { up } else { down }
    }
}

impl FaceCalibration {
    /// Returns the calibration from a take, without the numbers that its capture does not give; `None` if the take has
    /// no frame or the system's channels are expressions.
    #[must_use]
    pub fn calibration_from_view(view: &DerivedFaceView) -> Option<Self> {
        if view.faces.is_empty() || view.system.expressions {
            return None;
        }
        let mut numbers = BTreeMap::new();
        for (position, name) in FacePosture::FACE_NUMBER_NAMES.into_iter().enumerate() {
            if let Some(values) = view.face_number_values(name)
                && let Some(reach) = ExcursionReach::reach_from_values(&values, position)
            {
                numbers.insert(name.to_owned(), reach);
            }
        }
        Some(Self {
            system: view.system.id.clone(),
            version: view.system.version,
            frames: view.faces.len(),
            numbers,
        })
    }

    /// Returns whether the calibration belongs to the system and mapping version of a view.
    #[must_use]
    pub fn is_calibration_for(&self, view: &DerivedFaceView) -> bool {
        self.system == view.system.id && self.version == view.system.version
    }

    /// Scales the numbers of a view by this calibration.
    pub fn apply_face_calibration(&self, view: &mut DerivedFaceView) {
        let by_place: Vec<Option<&ExcursionReach>> = FacePosture::FACE_NUMBER_NAMES
            .iter()
            .map(|name| self.numbers.get(*name))
            .collect();
        for face in &mut view.faces {
            let mut numbers = face.face_numbers();
            for (number, reach) in numbers.iter_mut().zip(&by_place) {
                if let Some(reach) = reach {
                    *number = reach.scale_excursion(*number);
                }
            }
            *face = FacePosture::from_numbers(numbers);
        }
    }

    /// Returns the names of the numbers that hardly moved in the take.
    pub fn untried_number_names(&self) -> impl Iterator<Item = &str> {
        let still = |reach: &ExcursionReach| reach.up.is_none() && reach.down.is_none();
        let all = self.numbers.iter();
        all.filter(move |(_, reach)| still(reach))
            .map(|(name, _)| name.as_str())
    }
}
