//! The face of an avatar: the presets of VRM and the direction of the eyes, from the numbers of a face.

use chereme_motion::FacePosture;
use chereme_motion::glam::{DQuat, EulerRot};

/// The strength of a facial expression in each frame, from 0 to 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExpressionTrack {
    /// The name.
    pub name: String,
    /// The weight in each frame.
    pub weights: Vec<f64>,
}

/// The face of an avatar in each frame of a clip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AvatarFace {
    /// The expressions: presets of VRM by their names, and others.
    pub expressions: Vec<ExpressionTrack>,
    /// The direction of the eyes in degrees, to the signer's left and up; empty if the eyes do not move.
    pub gaze: Vec<[f64; 2]>,
}

/// How far eyes turn aside and up at a gaze of 1, in degrees, as the program draws them.
const MAX_GAZE_DEGREES: [f64; 2] = [26.0, 22.0];
/// How far parted lips open a mouth with a closed jaw, as a share of an open jaw.
const PARTED_LIPS_SHARE: f64 = 0.3;

impl AvatarFace {
    /// Returns the presets of VRM that faces show: `blink` (or one for each eye, if they differ), the five vowels, and
    /// the gaze. Presets that stay 0 are left out; brows, nose, cheeks, teeth and tongue have none.
    #[must_use]
    pub fn avatar_face_from_faces(faces: &[FacePosture]) -> Self {
        let lids = |eye: usize| move |face: &FacePosture| face.lids[eye].max(0.0);
        let even = faces.iter().all(|face| lids(0)(face) == lids(1)(face));
        let mut expressions: Vec<ExpressionTrack> = Vec::new();
        let mut add = |name: &str, weight: &dyn Fn(&FacePosture) -> f64| {
            let weights: Vec<f64> = faces.iter().map(|face| weight(face).clamp(0.0, 1.0)).collect();
            if weights.iter().any(|weight| *weight > 0.0) {
                let name = name.to_owned();
                expressions.push(ExpressionTrack { name, weights });
            }
        };
        if even {
            add("blink", &lids(0));
        } else {
            add("blinkRight", &lids(0));
            add("blinkLeft", &lids(1));
        }
        for (at, name) in ["aa", "ih", "ou", "ee", "oh"].into_iter().enumerate() {
            add(name, &|face| vowels(face)[at]);
        }
        let turned = |face: &FacePosture| [face.gaze[0] * MAX_GAZE_DEGREES[0], face.gaze[1] * MAX_GAZE_DEGREES[1]];
        let mut gaze: Vec<[f64; 2]> = faces.iter().map(turned).collect();
        if gaze.iter().all(|turned| *turned == [0.0; 2]) {
            gaze.clear();
        }
        Self { expressions, gaze }
    }
}

/// Returns the rotation of the eyes for a direction in degrees: about the vertical axis, then about the one to the left.
pub(super) fn eye_rotation_from_gaze([left, up]: [f64; 2]) -> DQuat {
    DQuat::from_rotation_y(left.to_radians()) * DQuat::from_rotation_x(-up.to_radians())
}

/// Returns the direction in degrees, to the left and up, of a rotation of the eyes.
pub(super) fn gaze_from_eye_rotation(rotation: DQuat) -> [f64; 2] {
    let (left, down, _) = rotation.to_euler(EulerRot::YXZ);
    [left.to_degrees(), -down.to_degrees()]
}

/// Returns the weights of aa, ih, ou, ee and oh: wide or round lips, each more or less open. They add up to 1 at most.
fn vowels(face: &FacePosture) -> [f64; 5] {
    let lips = 1.0 - face.pressed.clamp(0.0, 1.0);
    let open = (lips * face.jaw.max(PARTED_LIPS_SHARE * face.parted)).clamp(0.0, 1.0);
    let round = (lips * face.pout.max(-face.wide)).clamp(0.0, 1.0);
    let wide = (lips * face.wide).clamp(0.0, 1.0) * (1.0 - round);
    let plain = 1.0 - round - wide;
    [
        plain * open,
        wide * (1.0 - open),
        round * (1.0 - open),
        wide * open,
        round * open,
    ]
}

#[cfg(test)]
mod tests {
    use chereme_motion::glam::DVec3;

    use super::*;

    #[test]
    fn faces_show_the_presets_of_vrm() {
        let face = |change: fn(&mut FacePosture)| {
            let mut face = FacePosture::default();
            change(&mut face);
            face
        };
        for (face, want) in [
            (face(|_| ()), vec![]),
            (face(|it| it.lids = [0.8; 2]), vec![("blink", 0.8)]),
            (face(|it| it.lids = [-1.0; 2]), vec![]),
            (
                face(|it| it.lids = [1.0, 0.5]),
                vec![("blinkRight", 1.0), ("blinkLeft", 0.5)],
            ),
            (face(|it| it.lids = [0.0, 1.0]), vec![("blinkLeft", 1.0)]),
            (face(|it| it.jaw = 0.6), vec![("aa", 0.6)]),
            (face(|it| it.wide = 1.0), vec![("ih", 1.0)]),
            (face(|it| it.pout = 1.0), vec![("ou", 1.0)]),
            (face(|it| (it.jaw, it.wide) = (1.0, 1.0)), vec![("ee", 1.0)]),
            (face(|it| (it.jaw, it.wide) = (1.0, -1.0)), vec![("oh", 1.0)]),
            (
                face(|it| (it.jaw, it.wide) = (0.5, -0.5)),
                vec![("aa", 0.25), ("ou", 0.25), ("oh", 0.25)],
            ),
            (face(|it| (it.jaw, it.pressed) = (1.0, 1.0)), vec![]),
            (face(|it| it.brows = [1.0; 2]), vec![]),
        ] {
            let shown = AvatarFace::avatar_face_from_faces(&[face]).expressions;
            let shown: Vec<(&str, f64)> = shown.iter().map(|it| (it.name.as_str(), it.weights[0])).collect();
            assert_eq!(shown, want);
        }
    }

    #[test]
    fn eyes_turn_to_the_signers_left_and_up() {
        let mut face = FacePosture::default();
        assert!(AvatarFace::avatar_face_from_faces(&[face]).gaze.is_empty());
        face.gaze = [1.0, 0.5];
        let gaze = AvatarFace::avatar_face_from_faces(&[FacePosture::default(), face]).gaze;
        assert_eq!(gaze, [[0.0; 2], [26.0, 11.0]]);
        let look = eye_rotation_from_gaze(gaze[1]) * DVec3::Z;
        assert!((look.x - 26_f64.to_radians().sin() * 11_f64.to_radians().cos()).abs() < 1e-9);
        assert!((look.y - 11_f64.to_radians().sin()).abs() < 1e-9);
        for want in [[0.0, 0.0], [26.0, -22.0], [-80.0, 80.0]] {
            let is = super::gaze_from_eye_rotation(eye_rotation_from_gaze(want));
            assert!((is[0] - want[0]).hypot(is[1] - want[1]) < 1e-9, "{is:?}");
        }
    }
}
