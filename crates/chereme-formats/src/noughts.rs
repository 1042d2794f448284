//! Places at exactly 0 0 0, as some programs write gaps.

use chereme_motion::column::FileNumber;
use glam::DVec3;

use crate::finding::ImportFinding;
use crate::tally::FindingTally;

/// The number of markers that a finding names.
const MAX_NAMED_MARKERS: usize = 5;

/// The least distance of a marker from 0, as a share of its usual one, for its places at exactly 0 0 0 to be gaps.
const NEAR_NOUGHT: f64 = 0.1;

/// Makes gaps of the places at exactly 0 0 0 of markers that are otherwise far from there, and reports their count.
///
/// A marker that is there in every frame was never seen if others are elsewhere.
pub(crate) fn open_noughts(names: &[String], columns: &mut [Vec<Option<FileNumber>>], findings: &mut FindingTally) {
    let places = |axes: &[Vec<Option<FileNumber>>]| -> Vec<Option<DVec3>> {
        let coordinate = |axis: &Vec<Option<FileNumber>>, frame: usize| Some(axis[frame].as_ref()?.to_f64());
        let place = |frame| {
            let [x, y, z] = [0, 1, 2].map(|axis| coordinate(&axes[axis], frame));
            Some(DVec3::new(x?, y?, z?))
        };
        (0..axes[0].len()).map(place).collect()
    };
    let is_nought = |place: &Option<DVec3>| *place == Some(DVec3::ZERO);
    let has_places = columns
        .chunks(3)
        .any(|axes| places(axes).iter().flatten().any(|at| *at != DVec3::ZERO));
    let (mut opened, mut markers, mut left) = (0, Vec::new(), 0);
    for (name, axes) in names.iter().zip(columns.chunks_mut(3)) {
        let places = places(axes);
        let noughts = places.iter().filter(|place| is_nought(place)).count();
        if noughts == 0 {
            continue;
        }
        let seen = places.iter().flatten().map(|at| at.length());
        let mut far: Vec<f64> = seen.filter(|length| *length > 0.0).collect();
        far.sort_by(f64::total_cmp);
        let is_far = match (far.first(), far.get(far.len() / 2)) {
            (Some(least), Some(usual)) => *least > NEAR_NOUGHT * usual,
            _ => has_places && !is_origin(name),
        };
        if !is_far {
            // An origin is at 0 0 0 by its nature.
            left += if has_places && is_origin(name) { 0 } else { noughts };
            continue;
        }
        for axis in axes {
            for (number, _) in axis.iter_mut().zip(&places).filter(|(_, at)| is_nought(at)) {
                *number = None;
            }
        }
        opened += noughts;
        markers.push(name.as_str());
    }
    if opened > 0 {
        let some = markers[..markers.len().min(MAX_NAMED_MARKERS)].join(", ");
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!(
                    "{opened} places of {} markers are exactly 0 0 0 and become gaps, as some programs write gaps so: {some}",
                    markers.len()
                ),
            )
            .with_remedy("write gaps as empty cells, and a marker that is really there as 0.001"),
        );
    }
    if left > 0 {
        findings.push_warning_finding(
            None,
            format!("{left} places are exactly 0 0 0 though the file calls them seen; some programs write gaps so"),
        );
    }
}

/// Returns whether a marker may be the point from which the places of a body are measured.
fn is_origin(name: &str) -> bool {
    let name = name.to_lowercase();
    let words = ["root", "pelvis", "hip", "origin"];
    words.iter().any(|word| name.contains(word))
}
