//! The colours of a figure and of the paper it is drawn on.

/// A colour as red, green and blue from 0 to 255, in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// Returns the colour of a six-digit hexadecimal number `0xRRGGBB`.
    #[must_use]
    pub const fn hex(rgb: u32) -> Self {
        Self([(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8])
    }

    /// Returns the colour at the share `weight` (0 to 1) between `self` and `other`.
    #[must_use]
    pub fn mixed(self, other: Self, weight: f32) -> Self {
        let weight = weight.clamp(0.0, 1.0);
        Self(std::array::from_fn(|i| {
            let (a, b) = (f32::from(self.0[i]), f32::from(other.0[i]));
            (a + (b - a) * weight + 0.5) as u8
        }))
    }

    /// Returns the colour with its three parts multiplied by `factor`.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self(
            self.0
                .map(|part| (f32::from(part) * factor).clamp(0.0, 255.0) as u8),
        )
    }
}

/// The paper a picture is drawn on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Theme {
    /// Near white, with dark text.
    #[default]
    Light,
    /// Near black, with light text.
    Dark,
}

impl Theme {
    /// Returns the colour of the paper.
    #[must_use]
    pub const fn background(self) -> Colour {
        match self {
            Self::Light => Colour::hex(0xF4_F5_F7),
            Self::Dark => Colour::hex(0x16_19_1F),
        }
    }

    /// Returns the colour of text.
    #[must_use]
    pub const fn text(self) -> Colour {
        match self {
            Self::Light => Colour::hex(0x24_2B_36),
            Self::Dark => Colour::hex(0xE3_E7_EE),
        }
    }

    /// Returns the colour of rules between cells and of grids.
    #[must_use]
    pub const fn rule(self) -> Colour {
        match self {
            Self::Light => Colour::hex(0xD3_D8_E0),
            Self::Dark => Colour::hex(0x33_3A_46),
        }
    }

    /// Returns the colour of the line around a figure.
    #[must_use]
    pub const fn outline(self) -> Colour {
        match self {
            Self::Light => Colour::hex(0x1D_22_2B),
            Self::Dark => Colour::hex(0x7C_88_9A),
        }
    }
}

/// The colours of one hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HandColours {
    /// The palm's side of the palm and fingers.
    pub palm: Colour,
    /// The back of the palm and fingers.
    pub back: Colour,
    /// The finger nails.
    pub nail: Colour,
}

/// The colours of a figure: dark clothing behind light hands, as sign language is filmed.
///
/// The hands differ from each other as warm from cool and from the clothing by lightness, so that red and
/// green need not be distinguished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Palette {
    /// The right hand.
    pub right: HandColours,
    /// The left hand.
    pub left: HandColours,
    /// Head and neck.
    pub face: Colour,
    /// The back of the head.
    pub crown: Colour,
    /// Brows, pupils.
    pub marks: Colour,
    /// The white of the eyes.
    pub eyes: Colour,
    /// The mouth.
    pub mouth: Colour,
    /// Chest and belly.
    pub torso: Colour,
    /// Upper and lower arms.
    pub sleeves: Colour,
    /// Legs and feet.
    pub legs: Colour,
}

impl Default for Palette {
    fn default() -> Self {
        Self {
            right: HandColours {
                palm: Colour::hex(0xFC_E0_BC),
                back: Colour::hex(0xEB_B9_83),
                nail: Colour::hex(0xFF_F4_E6),
            },
            left: HandColours {
                palm: Colour::hex(0xE4_E4_F6),
                back: Colour::hex(0xB9_BF_DD),
                nail: Colour::hex(0xFA_FA_FF),
            },
            face: Colour::hex(0xE6_D2_BE),
            crown: Colour::hex(0x6E_67_63),
            marks: Colour::hex(0x2E_2B_2C),
            eyes: Colour::hex(0xFB_FB_F8),
            mouth: Colour::hex(0x9C_57_50),
            torso: Colour::hex(0x33_3F_50),
            sleeves: Colour::hex(0x4A_5A_70),
            legs: Colour::hex(0x3C_40_48),
        }
    }
}
