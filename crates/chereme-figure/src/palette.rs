//! The colours of a figure and of the paper it is drawn on.

/// A colour as red, green and blue from 0 to 255, in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RgbColour(pub [u8; 3]);

impl RgbColour {
    /// Returns the colour of a six-digit hexadecimal number `0xRRGGBB`.
    #[must_use]
    pub const fn from_hex_colour(rgb: u32) -> Self {
        Self([(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8])
    }

    /// Returns the colour at the share `weight` (0 to 1) between `self` and `other`.
    #[must_use]
    pub fn mix_colour(self, other: Self, weight: f32) -> Self {
        let weight = weight.clamp(0.0, 1.0);
        Self(std::array::from_fn(|i| {
            let (a, b) = (f32::from(self.0[i]), f32::from(other.0[i]));
            (a + (b - a) * weight + 0.5) as u8
        }))
    }

    /// Returns the colour with its three parts multiplied by `factor`.
    #[must_use]
    pub fn scale_colour(self, factor: f32) -> Self {
        Self(self.0.map(|part| (f32::from(part) * factor).clamp(0.0, 255.0) as u8))
    }
}

/// The paper a picture is drawn on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PaperTheme {
    /// Near white, with dark text.
    #[default]
    Light,
    /// Near black, with light text.
    Dark,
}

impl PaperTheme {
    /// Returns the colour of the paper.
    #[must_use]
    pub const fn theme_paper_colour(self) -> RgbColour {
        match self {
            Self::Light => RgbColour::from_hex_colour(0xF4_F5_F7),
            Self::Dark => RgbColour::from_hex_colour(0x16_19_1F),
        }
    }

    /// Returns the colour of text.
    #[must_use]
    pub const fn theme_text_colour(self) -> RgbColour {
        match self {
            Self::Light => RgbColour::from_hex_colour(0x24_2B_36),
            Self::Dark => RgbColour::from_hex_colour(0xE3_E7_EE),
        }
    }

    /// Returns the colour of rules between cells and of grids.
    #[must_use]
    pub const fn rule_colour(self) -> RgbColour {
        match self {
            Self::Light => RgbColour::from_hex_colour(0xD3_D8_E0),
            Self::Dark => RgbColour::from_hex_colour(0x33_3A_46),
        }
    }

    /// Returns the colour of the line around a figure.
    #[must_use]
    pub const fn outline_colour(self) -> RgbColour {
        match self {
            Self::Light => RgbColour::from_hex_colour(0x1D_22_2B),
            Self::Dark => RgbColour::from_hex_colour(0x7C_88_9A),
        }
    }
}

/// The colours of one hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HandColours {
    /// The palm's side of the palm and fingers.
    pub palm: RgbColour,
    /// The back of the palm and fingers.
    pub back: RgbColour,
    /// The finger nails.
    pub nail: RgbColour,
}

/// The colours of a figure: dark clothing behind light hands, as sign language is filmed.
///
/// Hands have the face's skin and differ from the clothing by lightness, so that red and green need not be
/// distinguished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FigurePalette {
    /// The right hand.
    pub right: HandColours,
    /// The left hand.
    pub left: HandColours,
    /// Head and neck.
    pub face: RgbColour,
    /// The hair.
    pub crown: RgbColour,
    /// Lashes.
    pub marks: RgbColour,
    /// The white of the eyes.
    pub eyes: RgbColour,
    /// The lips.
    pub mouth: RgbColour,
    /// The tongue.
    pub tongue: RgbColour,
    /// The iris of the eyes.
    pub iris: RgbColour,
    /// The brows.
    pub brows: RgbColour,
    /// The cut of the hair, whose colour is `crown`.
    pub cut: HairCut,
    /// Chest and belly.
    pub torso: RgbColour,
    /// Upper and lower arms.
    pub sleeves: RgbColour,
    /// Legs and feet.
    pub legs: RgbColour,
}

/// A cut of hair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HairCut {
    /// Short.
    #[default]
    Short,
    /// To the chin.
    Bob,
    /// Tied in a knot behind the head.
    Tied,
    /// No hair.
    None,
}

/// The Monk scale of skin tones (public, Google 2022), a little redder, from the lightest on.
const MONK_SKIN_TONES: [u32; 10] = [
    0xF8_E8_DC, 0xF6_E1_D0, 0xF6_D8_BA, 0xEC_C6_9E, 0xE6_B6_8C, 0xA9_7A_54, 0x86_58_3F, 0x66_41_31, 0x42_2F_28,
    0x30_24_1F,
];

/// The share of light colour in the palms of each tone; small for tones whose clothes are light too.
const PALM_LIGHT_SHARES: [f32; 10] = [0.55, 0.55, 0.55, 0.55, 0.55, 0.06, 0.20, 0.28, 0.34, 0.38];

impl FigurePalette {
    /// Returns the colours of a signer with a tone of skin, from 1, the lightest, to 10; other numbers are clamped.
    /// Clothes are dark behind light hands and light behind dark ones.
    #[must_use]
    pub fn of_tone(tone: usize) -> Self {
        let tone = tone.clamp(1, 10);
        let skin = RgbColour::from_hex_colour(MONK_SKIN_TONES[tone - 1]);
        let light = RgbColour::from_hex_colour(0xFC_DE_C2);
        // From the sixth tone on, clothes are light behind dark hands.
        let dark = tone > 5;
        let hand = HandColours {
            palm: skin.mix_colour(light, PALM_LIGHT_SHARES[tone - 1]),
            back: skin
                .scale_colour(0.87)
                .mix_colour(RgbColour::from_hex_colour(0x9A_4A_28), 0.10),
            nail: skin.mix_colour(RgbColour::from_hex_colour(0xFF_EE_E6), if dark { 0.45 } else { 0.6 }),
        };
        let cloth = RgbColour::from_hex_colour(match tone {
            0..=5 => 0x33_40_5A,
            6 => 0xF4_F1_EA,
            _ => 0xE9_E4_DA,
        });
        Self {
            right: hand,
            left: hand,
            face: skin,
            crown: RgbColour::from_hex_colour(if tone < 4 {
                0x5A_41_30
            } else if dark {
                0x1E_19_18
            } else {
                0x3D_2F_28
            }),
            marks: RgbColour::from_hex_colour(0x2A_20_1D),
            eyes: RgbColour::from_hex_colour(0xFB_F9_F5),
            mouth: skin.mix_colour(RgbColour::from_hex_colour(0xA8_40_48), if dark { 0.42 } else { 0.55 }),
            tongue: RgbColour::from_hex_colour(0xC9_69_6B),
            iris: RgbColour::from_hex_colour(if dark { 0x4A_30_20 } else { 0x6B_4A_2E }),
            brows: RgbColour::from_hex_colour(if tone < 4 { 0x4A_35_28 } else { 0x26_1D_1A }),
            cut: HairCut::default(),
            torso: cloth,
            sleeves: if dark {
                cloth
            } else {
                cloth.mix_colour(RgbColour::from_hex_colour(0xFF_FF_FF), 0.05)
            },
            legs: RgbColour::from_hex_colour(if dark { 0xB9_B2_A6 } else { 0x2A_30_3C }),
        }
    }

    /// Returns the palette with hands in two tints, warm for the right hand and cool for the left, as an aid in
    /// pictures of crossing hands.
    #[must_use]
    pub fn with_hands_apart(mut self) -> Self {
        let hand = |palm, back, nail| HandColours {
            palm: RgbColour::from_hex_colour(palm),
            back: RgbColour::from_hex_colour(back),
            nail: RgbColour::from_hex_colour(nail),
        };
        self.right = hand(0xFC_E0_BC, 0xEB_B9_83, 0xFF_F4_E6);
        self.left = hand(0xE4_E4_F6, 0xB9_BF_DD, 0xFA_FA_FF);
        self
    }
}

impl Default for FigurePalette {
    fn default() -> Self {
        Self::of_tone(5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the contrast of two colours as in the web's guidelines, from 1 to 21.
    fn contrast(a: RgbColour, b: RgbColour) -> f32 {
        let bright = |colour: RgbColour| {
            let [r, g, b] = colour.0.map(|part| {
                let part = f32::from(part) / 255.0;
                if part <= 0.040_45 {
                    part / 12.92
                } else {
                    ((part + 0.055) / 1.055).powf(2.4)
                }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (a, b) = (bright(a), bright(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn hands_and_face_stand_out_from_the_clothes_on_every_tone() {
        for tone in 1..=10 {
            let palette = FigurePalette::of_tone(tone);
            for cloth in [palette.torso, palette.sleeves] {
                for skin in [palette.face, palette.right.palm, palette.left.back] {
                    let found = contrast(skin, cloth);
                    assert!(found >= 3.0, "tone {tone}: {found} of {skin:?} on {cloth:?}");
                    if cloth == palette.torso {
                        assert!(found >= 3.0, "tone {tone}: {found} of {skin:?} on {cloth:?}");
                    }
                }
            }
        }
    }
}
