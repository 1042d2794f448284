//! The activity of a face as a few numbers, whatever face it is.

use serde::{Deserialize, Serialize};

use crate::time::{FrameRate, RecordingInstant};

/// The posture of a face: each number is 0 at rest, and 1 at the usual limit of the movement.
///
/// Pairs are of the signer's right and left, in this order. Numbers that say so go down to -1 for the opposite.
/// Data spells each number as the field does ([`FacePosture::FACE_NUMBER_NAMES`]); shorter names of older data are read as well.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FacePosture {
    /// The brows raised; -1 is lowered.
    #[serde(rename = "brow_raise", alias = "brows")]
    pub brows: [f64; 2],
    /// The brows drawn together.
    #[serde(rename = "brow_squeeze", alias = "frown")]
    pub frown: f64,
    /// The eyes closed; -1 is wide open.
    #[serde(rename = "eye_close", alias = "lids")]
    pub lids: [f64; 2],
    /// The direction of the eyes: to the signer's left, and up; -1 is to the right or down.
    pub gaze: [f64; 2],
    /// The nose wrinkled; -1 is the nostrils widened.
    #[serde(rename = "nose_wrinkle", alias = "nose")]
    pub nose: f64,
    /// The jaw dropped.
    #[serde(rename = "jaw_open", alias = "jaw")]
    pub jaw: f64,
    /// The jaw moved to the signer's left; -1 is to the right.
    #[serde(rename = "jaw_left", alias = "aside")]
    pub aside: f64,
    /// The lips apart from each other, regardless of the jaw.
    #[serde(rename = "lips_part", alias = "parted")]
    pub parted: f64,
    /// The mouth stretched sideways; -1 is rounded.
    #[serde(rename = "mouth_stretch", alias = "wide")]
    pub wide: f64,
    /// The corners of the mouth raised; -1 is lowered.
    #[serde(rename = "lip_corner", alias = "corners")]
    pub corners: [f64; 2],
    /// The lips pressed together and drawn in, regardless of the jaw.
    #[serde(rename = "lip_press", alias = "pressed")]
    pub pressed: f64,
    /// The lips pushed forward.
    #[serde(rename = "lip_pucker", alias = "pout")]
    pub pout: f64,
    /// The teeth visible, as far as the mouth is open.
    #[serde(rename = "teeth_show", alias = "teeth")]
    pub teeth: f64,
    /// The tongue out of the mouth.
    #[serde(rename = "tongue_out", alias = "tongue")]
    pub tongue: f64,
    /// The tongue moved to the signer's left; -1 is to the right.
    #[serde(rename = "tongue_left", alias = "tongue_aside")]
    pub tongue_aside: f64,
    /// The cheeks puffed; -1 is sucked in.
    #[serde(rename = "cheek_puff", alias = "cheeks")]
    pub cheeks: [f64; 2],
}

impl FacePosture {
    /// How many numbers it has.
    pub const FACE_NUMBER_COUNT: usize = 21;

    /// The name of each number as the field spells it, in the order of [`numbers`](Self::face_numbers).
    pub const FACE_NUMBER_NAMES: [&str; Self::FACE_NUMBER_COUNT] = [
        "brow_raise_right",
        "brow_raise_left",
        "brow_squeeze",
        "eye_close_right",
        "eye_close_left",
        "gaze_left",
        "gaze_up",
        "nose_wrinkle",
        "jaw_open",
        "jaw_left",
        "lips_part",
        "mouth_stretch",
        "lip_corner_right",
        "lip_corner_left",
        "lip_press",
        "lip_pucker",
        "teeth_show",
        "tongue_out",
        "tongue_left",
        "cheek_puff_right",
        "cheek_puff_left",
    ];

    /// Returns the position in [`FACE_NUMBER_NAMES`](Self::FACE_NUMBER_NAMES) of a number; `None` for an unknown name.
    #[must_use]
    pub fn face_number_position(name: &str) -> Option<usize> {
        Self::FACE_NUMBER_NAMES.iter().position(|known| *known == name)
    }

    /// Returns the least value that the number at this position can have: -1 if it has an opposite, else 0.
    #[must_use]
    pub fn least_face_number(position: usize) -> f64 {
        // Squeeze, jaw, parting, press, pucker, teeth and tongue have no opposite movement.
        const UNOPPOSED_FACE_NUMBERS: [usize; 7] = [2, 8, 10, 14, 15, 16, 17];
        if UNOPPOSED_FACE_NUMBERS.contains(&position) {
            0.0
        } else {
            -1.0
        }
    }

    /// Returns the face with these numbers, each clamped to its range; NaN becomes 0.
    #[must_use]
    pub fn from_numbers(numbers: [f64; Self::FACE_NUMBER_COUNT]) -> Self {
        let mut face = Self::default();
        for (at, (own, number)) in face.face_fields_mut().into_iter().zip(numbers).enumerate() {
            *own = if number.is_nan() {
                0.0
            } else {
                number.clamp(Self::least_face_number(at), 1.0)
            };
        }
        face
    }

    /// Returns the mirror image of the face: right and left change places.
    #[must_use]
    pub fn mirrored_face(&self) -> Self {
        let swap = |[a, b]: [f64; 2]| [b, a];
        Self {
            brows: swap(self.brows),
            lids: swap(self.lids),
            // A look to the left is a look to the right in the mirror; up stays up.
            gaze: [-self.gaze[0], self.gaze[1]],
            aside: -self.aside,
            corners: swap(self.corners),
            tongue_aside: -self.tongue_aside,
            cheeks: swap(self.cheeks),
            ..*self
        }
    }

    /// Returns its numbers, in the order of its fields.
    #[must_use]
    pub fn face_numbers(&self) -> [f64; Self::FACE_NUMBER_COUNT] {
        let mut copy = *self;
        copy.face_fields_mut().map(|number| *number)
    }

    /// Adds a share of another face; a field beyond its range stays at the end of it.
    ///
    /// ```
    /// use chereme_motion::FacePosture;
    /// let open = FacePosture { jaw: 0.8, ..FacePosture::default() };
    /// let mut face = FacePosture { brows: [1.0, 1.0], ..FacePosture::default() };
    /// face.add_face_share(&open, 0.5);
    /// assert_eq!((face.jaw, face.brows), (0.4, [1.0, 1.0]));
    /// ```
    pub fn add_face_share(&mut self, other: &Self, weight: f64) {
        let sums = self.face_fields_mut().into_iter().zip(other.face_numbers());
        for (position, (own, more)) in sums.enumerate() {
            *own = (*own + weight * more).clamp(Self::least_face_number(position), 1.0);
        }
    }

    /// Interpolates between this face and another; `share` is 0 for this one and 1 for the other.
    #[must_use]
    pub fn interpolate_face(&self, other: &Self, share: f64) -> Self {
        let mut face = *self;
        for (own, there) in face.face_fields_mut().into_iter().zip(other.face_numbers()) {
            *own += (there - *own) * share;
        }
        face
    }

    /// Returns the face at a moment of a clip whose frames have `faces`; `None` beyond them.
    #[must_use]
    pub fn face_at_moment(faces: &[Self], rate: FrameRate, moment: RecordingInstant) -> Option<Self> {
        faces.get(rate.nearest_frame_at(moment)).copied()
    }

    /// Returns whether every field is at rest.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        *self == Self::default()
    }

    fn face_fields_mut(&mut self) -> [&mut f64; Self::FACE_NUMBER_COUNT] {
        let [right_brow, left_brow] = &mut self.brows;
        let [right_lid, left_lid] = &mut self.lids;
        let [leftwards, upwards] = &mut self.gaze;
        let [right_corner, left_corner] = &mut self.corners;
        let [right_cheek, left_cheek] = &mut self.cheeks;
        [
            right_brow,
            left_brow,
            &mut self.frown,
            right_lid,
            left_lid,
            leftwards,
            upwards,
            &mut self.nose,
            &mut self.jaw,
            &mut self.aside,
            &mut self.parted,
            &mut self.wide,
            right_corner,
            left_corner,
            &mut self.pressed,
            &mut self.pout,
            &mut self.teeth,
            &mut self.tongue,
            &mut self.tongue_aside,
            right_cheek,
            left_cheek,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::FacePosture;

    #[test]
    fn faces_add_up_within_limits() {
        let mut face = FacePosture::default();
        assert!(face.is_at_rest());
        let down = FacePosture {
            brows: [-0.7, -0.7],
            gaze: [0.0, -1.0],
            ..FacePosture::default()
        };
        face.add_face_share(&down, 1.0);
        face.add_face_share(&down, 1.0);
        assert_eq!((face.brows, face.gaze), ([-1.0, -1.0], [0.0, -1.0]));
        assert_eq!(face.interpolate_face(&FacePosture::default(), 0.5).brows, [-0.5, -0.5]);
        assert_eq!(face.interpolate_face(&down, 1.0), down);
    }

    #[test]
    fn face_numbers_have_names_limits_and_a_mirror() {
        let numbers: [f64; FacePosture::FACE_NUMBER_COUNT] = std::array::from_fn(|at| 0.01 * (at + 1) as f64);
        let face = FacePosture::from_numbers(numbers);
        assert_eq!(face.face_numbers(), numbers);
        let at = |name: &str| FacePosture::face_number_position(name).expect("a name");
        assert_eq!(face.jaw, numbers[at("jaw_open")]);
        assert_eq!(
            face.brows,
            [numbers[at("brow_raise_right")], numbers[at("brow_raise_left")]]
        );
        assert_eq!(FacePosture::face_number_position("jaw"), None);
        assert_eq!(face.mirrored_face().mirrored_face(), face);
        assert_eq!(face.mirrored_face().brows[1], face.brows[0]);
        let far = FacePosture::from_numbers([-3.0; FacePosture::FACE_NUMBER_COUNT]);
        assert_eq!((far.jaw, far.wide, far.pout), (0.0, -1.0, 0.0));
        let gap = FacePosture::from_numbers([f64::NAN; FacePosture::FACE_NUMBER_COUNT]);
        assert!(gap.is_at_rest());
    }

    #[test]
    fn older_names_are_read_as_well() {
        let old = r#"{"jaw": 0.5, "wide": -1.0, "brows": [1.0, 0.0]}"#;
        let new = r#"{"jaw_open": 0.5, "mouth_stretch": -1.0, "brow_raise": [1.0, 0.0]}"#;
        let read = |text| serde_json::from_str::<FacePosture>(text).expect("a face");
        assert_eq!(read(old), read(new));
        assert!(serde_json::from_str::<FacePosture>(r#"{"jaws": 1.0}"#).is_err());
    }

    #[test]
    fn the_number_of_face_numbers_is_right() {
        let names = serde_json::to_value(FacePosture::default()).expect("a face is written");
        let fields = names.as_object().expect("with names").values();
        let numbers = fields.map(|field| field.as_array().map_or(1, Vec::len));
        assert_eq!(numbers.sum::<usize>(), FacePosture::FACE_NUMBER_COUNT);
    }
}
