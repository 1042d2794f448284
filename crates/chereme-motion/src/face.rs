//! What a face does, as a few numbers, whatever face it is.

use serde::{Deserialize, Serialize};

use crate::time::{Instant, Rate};

/// The posture of a face: each number is 0 at rest and 1 where the face usually goes no farther.
///
/// Pairs are of the signer's right and left, in this order. Numbers that say so go down to -1 for the opposite.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Face {
    /// The brows raised; -1 is lowered.
    pub brows: [f64; 2],
    /// The brows drawn together.
    pub frown: f64,
    /// The eyes closed; -1 is wide open.
    pub lids: [f64; 2],
    /// Where the eyes look: to the signer's left and up; -1 is to the right and down.
    pub gaze: [f64; 2],
    /// The nose wrinkled.
    pub nose: f64,
    /// The jaw dropped.
    pub jaw: f64,
    /// The jaw moved to the signer's left; -1 is to the right.
    pub aside: f64,
    /// The lips apart from each other, wherever the jaw is.
    pub parted: f64,
    /// The mouth stretched sideways; -1 is rounded.
    pub wide: f64,
    /// The corners of the mouth raised; -1 is lowered.
    pub corners: [f64; 2],
    /// The lips closed on each other and drawn in, wherever the jaw is.
    pub pressed: f64,
    /// The lips pushed forward.
    pub pout: f64,
    /// The teeth shown, as far as the mouth is open.
    pub teeth: f64,
    /// The tongue out of the mouth.
    pub tongue: f64,
    /// The tongue moved to the signer's left; -1 is to the right.
    pub tongue_aside: f64,
    /// The cheeks puffed; -1 is sucked in.
    pub cheeks: [f64; 2],
}

impl Face {
    /// How many numbers it has.
    pub const LEN: usize = 21;

    /// Returns its numbers, in the order of its fields.
    #[must_use]
    pub fn numbers(&self) -> [f64; Self::LEN] {
        let mut copy = *self;
        copy.all().map(|number| *number)
    }

    /// Adds so much of another face; what is then beyond its end stays at the end.
    ///
    /// ```
    /// use chereme_motion::Face;
    /// let open = Face { jaw: 0.8, ..Face::default() };
    /// let mut face = Face { brows: [1.0, 1.0], ..Face::default() };
    /// face.add(&open, 0.5);
    /// assert_eq!((face.jaw, face.brows), (0.4, [1.0, 1.0]));
    /// ```
    pub fn add(&mut self, other: &Self, weight: f64) {
        for (own, more) in self.all().into_iter().zip(other.numbers()) {
            *own = (*own + weight * more).clamp(-1.0, 1.0);
        }
    }

    /// Returns the face on the way from this one to another, `share` being 0 here and 1 there.
    #[must_use]
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let mut face = *self;
        for (own, there) in face.all().into_iter().zip(other.numbers()) {
            *own += (there - *own) * share;
        }
        face
    }

    /// Returns the face at a moment of a clip, of which `faces` are those of its frames; nothing beyond them.
    #[must_use]
    pub fn at(faces: &[Self], rate: Rate, moment: Instant) -> Option<Self> {
        faces.get(rate.frame_at(moment)).copied()
    }

    /// Tells whether nothing in it differs from rest.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        *self == Self::default()
    }

    fn all(&mut self) -> [&mut f64; Self::LEN] {
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
    use super::Face;

    #[test]
    fn faces_add_up_and_end_somewhere() {
        let mut face = Face::default();
        assert!(face.is_at_rest());
        let down = Face {
            brows: [-0.7, -0.7],
            gaze: [0.0, -1.0],
            ..Face::default()
        };
        face.add(&down, 1.0);
        face.add(&down, 1.0);
        assert_eq!((face.brows, face.gaze), ([-1.0, -1.0], [0.0, -1.0]));
        assert_eq!(face.towards(&Face::default(), 0.5).brows, [-0.5, -0.5]);
        assert_eq!(face.towards(&down, 1.0), down);
    }

    #[test]
    fn every_number_is_counted_once() {
        let names = serde_json::to_value(Face::default()).expect("a face is written");
        let fields = names.as_object().expect("with names").values();
        let numbers = fields.map(|field| field.as_array().map_or(1, Vec::len));
        assert_eq!(numbers.sum::<usize>(), Face::LEN);
    }
}
