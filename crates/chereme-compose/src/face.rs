//! Derives faces, frame by frame, from scalar curves of non-manuals.

use std::ops::Range;

use chereme_motion::FacePosture;
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;

use crate::outcome::GeneratedCurve;

/// The prefix of the names of curves that hold a number of a face.
pub const FACE_NUMBER_PREFIX: &str = "face.";

/// Returns the face of each frame, as many as the longest curve has; empty if no curve belongs to a face.
///
/// A curve `face.jaw_open` is a number of the face itself, by [`FacePosture::FACE_NUMBER_NAMES`]. Any other curve gives the amount of its
/// non-manual. If that has several phases, such as the sounds of a mouth picture, they are spread evenly over the time
/// in which the amount is at least half of its maximum.
#[must_use]
pub fn faces_from_curves(curves: &[GeneratedCurve]) -> Vec<FacePosture> {
    let mut faces = Vec::new();
    for curve in curves {
        if let Some(at) = curve
            .name
            .strip_prefix(FACE_NUMBER_PREFIX)
            .and_then(FacePosture::face_number_position)
        {
            if faces.len() < curve.values.len() {
                faces.resize(curve.values.len(), FacePosture::default());
            }
            for (face, value) in faces.iter_mut().zip(&curve.values) {
                let mut numbers = [0.0; FacePosture::FACE_NUMBER_COUNT];
                numbers[at] = *value;
                face.add_face_share(&FacePosture::from_numbers(numbers), 1.0);
            }
            continue;
        }
        let name_parts = curve.name.split_once('.');
        let Some(expression) = name_parts.and_then(|(part, code)| FacialExpression::from_nonmanual_code(part, code))
        else {
            continue;
        };
        if faces.len() < curve.values.len() {
            faces.resize(curve.values.len(), FacePosture::default());
        }
        for run in positive_value_runs(&curve.values) {
            let core = face_run_core(&curve.values, &run);
            for frame in run {
                let share = (frame as f64 + 0.5 - core.start as f64) / core.len() as f64;
                let face = expression.expression_face_at(share.clamp(0.0, 1.0));
                faces[frame].add_face_share(&face, curve.values[frame]);
            }
        }
    }
    faces
}

/// Returns the runs of frames with values above zero.
fn positive_value_runs(values: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (frame, value) in values.iter().enumerate() {
        if *value > 0.0 {
            match runs.last_mut() {
                Some(run) if run.end == frame => run.end += 1,
                _ => runs.push(frame..frame + 1),
            }
        }
    }
    runs
}

/// Returns the part of a run from the first to the last frame with at least half of the run's greatest value.
fn face_run_core(values: &[f64], run: &Range<usize>) -> Range<usize> {
    let most = values[run.clone()].iter().copied().fold(0.0, f64::max);
    let much = |frame: &usize| values[*frame] >= most / 2.0;
    let first = run.clone().find(much).unwrap_or(run.start);
    let last = run.clone().rev().find(much).unwrap_or(run.start);
    first..last + 1
}

#[cfg(test)]
mod tests {
    use super::faces_from_curves;
    use crate::outcome::GeneratedCurve;

    fn curve(name: &str, values: &[f64]) -> GeneratedCurve {
        GeneratedCurve {
            name: name.to_owned(),
            values: values.to_vec(),
        }
    }

    #[test]
    fn curves_of_a_face_add_up() {
        let up = [0.0, 0.5, 1.0, 0.5, 0.0];
        let all = faces_from_curves(&[
            curve("brows.RB", &up),
            curve("lids.SB", &up),
            curve("head.SH", &[1.0; 9]),
        ]);
        assert_eq!(all.len(), 5, "a head is no face");
        let brows: Vec<f64> = all.iter().map(|face| face.brows[0]).collect();
        assert_eq!(brows, up);
        assert_eq!(all[2].lids, [0.5, 0.5]);
        assert!(faces_from_curves(&[curve("head.SH", &[1.0; 9])]).is_empty());
    }

    #[test]
    fn numeric_face_curves_are_used_unchanged() {
        let all = faces_from_curves(&[
            curve("face.mouth_stretch", &[-0.5, 0.25]),
            curve("face.jaw_open", &[0.3, 0.6]),
            curve("brows.RB", &[1.0, 0.0]),
            curve("face.unknown", &[1.0, 1.0]),
        ]);
        assert_eq!((all[0].wide, all[1].wide, all[1].jaw), (-0.5, 0.25, 0.6));
        assert_eq!(all[0].brows, [1.0, 1.0]);
    }

    #[test]
    fn a_word_is_mouthed_while_its_curve_is_at_least_half() {
        let mut values = vec![0.0; 30];
        values[5..25].fill(1.0);
        (values[4], values[25]) = (0.3, 0.3);
        let all = faces_from_curves(&[curve("mouthing.map", &values)]);
        assert!(all[14].jaw > 0.7 && all[15].jaw > 0.7, "open in the middle");
        assert!(all[5].jaw < 0.1 && all[24].jaw < 0.1, "closed at both ends");
        assert!(all[5].pressed > 0.3 && all[4].pressed < 0.2);
        assert!(all[3].is_at_rest() && all[26].is_at_rest());
    }

    #[test]
    fn a_word_mouthed_twice_begins_twice() {
        let mut values = vec![1.0; 21];
        values[10] = 0.0;
        let all = faces_from_curves(&[curve("mouthing.ba", &values)]);
        assert!(all[0].jaw < 0.1 && all[9].jaw > 0.7);
        assert!(all[11].jaw < 0.1 && all[20].jaw > 0.7);
    }
}
