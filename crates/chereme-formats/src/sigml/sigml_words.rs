//! The words of SiGML's attributes.

use chereme_sign::hamnosys::{
    BodyLocation, CeeOpening, EllipseAxis, FingerPart, HandClass, HandLocation, LocationSide, MotionSize,
    NonmanualPart, PlaceContact, RepeatKind, ThumbPosition, TierEnd, TierKind, TierStart, WristMotion,
};

/// Values that an attribute spells with one word.
pub(super) trait SigmlWord: Copy + PartialEq + 'static {
    /// Every word with its value; of several words for one value the first is written.
    const WORD_VALUES: &'static [(&'static str, Self)];

    /// Returns the value of a word.
    fn from_sigml_word(word: &str) -> Option<Self> {
        let word_pair = Self::WORD_VALUES.iter().find(|(known, _)| *known == word);
        word_pair.map(|(_, value)| *value)
    }

    /// Returns the word of the value.
    fn sigml_word(self) -> &'static str {
        let word_pair = Self::WORD_VALUES.iter().find(|(_, value)| *value == self);
        word_pair.map_or("", |(word, _)| word)
    }
}

macro_rules! words {
    ($type:ident: $($word:literal $value:ident,)+) => {
        impl SigmlWord for $type {
            const WORD_VALUES: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];
        }
    };
}

words!(HandClass: "fist" Fist, "flat" Flat, "finger2" Finger2, "finger23" Finger23,
    "finger23spread" Finger23Spread, "finger2345" Finger2345, "pinch12" Pinch12,
    "pinchall" PinchAll, "pinch12open" Pinch12Open, "cee12" Cee12, "ceeall" CeeAll,
    "cee12open" Cee12Open,);

words!(ThumbPosition: "out" Out, "across" Across, "opposed" Opposed,);

words!(CeeOpening: "tight" Tight, "slack" Slack,);

words!(FingerPart: "tip" Tip, "nail" Nail, "pad" Pad, "midjoint" MidJoint, "base" Base,
    "side" Side,);

words!(BodyLocation: "head" Head, "headtop" HeadTop, "forehead" Forehead, "eyebrows" Eyebrows,
    "eyes" Eyes, "uppereyelid" UpperEyelid, "lowereyelid" LowerEyelid, "nose" Nose,
    "nostrils" Nostrils, "lips" Lips, "upperlip" UpperLip, "lowerlip" LowerLip, "tongue" Tongue,
    "teeth" Teeth, "upperteeth" UpperTeeth, "lowerteeth" LowerTeeth, "chin" Chin,
    "underchin" UnderChin, "neck" Neck, "shoulders" Shoulders, "shouldertop" ShoulderTop,
    "chest" Chest, "stomach" Stomach, "belowstomach" BelowStomach, "ear" Ear, "earlobe" EarLobe,
    "cheek" Cheek, "upperarm" UpperArm, "elbow" Elbow, "elbowinside" ElbowInside,
    "lowerarm" LowerArm, "neutralspace" NeutralSpace,);

words!(HandLocation: "upperarm" UpperArm, "elbow" Elbow, "elbowinside" ElbowInside,
    "lowerarm" LowerArm, "wristback" WristBack, "thumbball" ThumbBall, "palm" Palm,
    "handback" HandBack, "thumbside" ThumbSide, "pinkyside" PinkySide, "tip" Tip, "nail" Nail,
    "pad" Pad, "midjoint" MidJoint, "base" Base, "side" Side,);

words!(LocationSide: "left_beside" LeftBeside, "left_at" LeftAt, "right_at" RightAt,
    "right_beside" RightBeside, "front" Front, "back" Back, "dorsal" Dorsal, "palmar" Palmar,
    "radial" Radial, "ulnar" Ulnar,);

words!(PlaceContact: "touch" Touch, "close" Close, "interlock" Interlock, "cross" Cross,
    "armextended" ArmExtended, "brushing" Brushing,);

words!(MotionSize: "small" Small, "big" Big,);

words!(EllipseAxis: "h" Horizontal, "ur" UpRight, "v" Vertical, "ul" UpLeft,);

words!(WristMotion: "nodding" Nodding, "swinging" Swinging, "twisting" Twisting,
    "stircw" StirCw, "stirccw" StirCcw,);

words!(RepeatKind: "fromstart" FromStart, "fromstart_several" FromStartSeveral, "tofroto" ToFro,
    "manyrandom" ManyRandom, "continue" Continue, "continue_several" ContinueSeveral,
    "reverse" Reverse, "swap" Swap,);

words!(TierStart: "slight_delay" SlightDelay, "start_slightly_ahead" StartSlightlyAhead,);

words!(TierEnd: "lasts_longer" LastsLonger, "ends_before" EndsBefore,);

words!(TierKind: "shoulder_tier" Shoulder, "body_tier" Body, "head_tier" Head,
    "eyegaze_tier" EyeGaze, "facialexpr_tier" FacialExpr, "mouthing_tier" Mouthing,
    "extra_tier" Extra,);

words!(NonmanualPart: "shoulder_movement" Shoulders, "body_movement" Body, "head_movement" Head,
    "eye_gaze" Gaze, "eye_brows" Brows, "eye_lids" Lids, "nose" Nose,
    "mouth_gesture" MouthGesture, "mouth_picture" MouthPicture, "mouth_meta" MouthMeta,
    "extra_movement" Extra, "neutral" Neutral,);

/// Returns the element that holds simultaneous acts on a tier.
pub(super) fn group_name(tier: TierKind) -> &'static str {
    match tier {
        TierKind::Shoulder => "shoulder_par",
        TierKind::Body => "body_par",
        TierKind::Head => "head_par",
        TierKind::EyeGaze => "eye_par",
        TierKind::FacialExpr => "facial_expr_par",
        TierKind::Mouthing => "mouthing_par",
        TierKind::Extra => "extra_par",
    }
}

/// Returns the attribute for the tag of a part, in gestural SiGML.
pub(super) fn tag_name(part: NonmanualPart) -> &'static str {
    match part {
        NonmanualPart::Gaze => "direction",
        NonmanualPart::MouthPicture => "picture",
        NonmanualPart::MouthMeta => "mouthmetatype",
        _ => "movement",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<T: SigmlWord + std::fmt::Debug>(count: usize) {
        assert_eq!(T::WORD_VALUES.len(), count);
        for (word, value) in T::WORD_VALUES {
            assert_eq!((T::from_sigml_word(word), value.sigml_word()), (Some(*value), *word));
        }
    }

    #[test]
    fn every_value_has_a_word_of_its_own() {
        check::<HandClass>(12);
        check::<ThumbPosition>(3);
        check::<CeeOpening>(2);
        check::<FingerPart>(6);
        check::<BodyLocation>(32);
        check::<HandLocation>(16);
        check::<LocationSide>(10);
        check::<PlaceContact>(6);
        check::<MotionSize>(2);
        check::<EllipseAxis>(4);
        check::<WristMotion>(5);
        check::<RepeatKind>(8);
        check::<TierStart>(2);
        check::<TierEnd>(2);
        check::<TierKind>(7);
        check::<NonmanualPart>(12);
    }
}
