//! Body language: the meaning of the categories of notation in numbers.
//!
//! After Kennaway, *Avatar-independent scripting for real-time gesture animation* (section 4): such
//! numbers belong to a person, not to a body, so lengths are in units of the body. One file,
//! `schema/notation/body_language.json`, holds each number with its unit and source; another file of the
//! same form may replace some of them.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chereme_motion::{BodyAnatomy, WristLimits};
use serde::{Deserialize, Serialize};

/// The version of body-language files that this program reads.
const LANGUAGE_FILE_VERSION: u32 = 1;

/// The reason why a file of body language is refused.
#[derive(Debug, thiserror::Error)]
pub enum BodyLanguageError {
    /// It is not JSON of this form.
    #[error("not a file of body language: {0}; its form is that of body_language.json")]
    Form(#[from] serde_json::Error),
    /// It is newer than this program.
    #[error("body language of version {0} is unknown; this program reads version {LANGUAGE_FILE_VERSION}")]
    Version(u32),
    /// An unknown name.
    #[error("{name:?} is no value of body language{}", crate::text::did_you_mean(nearest.as_deref()))]
    Unknown {
        /// The name.
        name: String,
        /// The most similar known name.
        nearest: Option<String>,
    },
    /// A value is missing from the file that must hold all.
    #[error("{0:?} is missing")]
    Missing(&'static str),
    /// An unknown place.
    #[error("{name:?} is no place of the body{}; places are those of landmarks, such as chin, chest, right-ear", crate::text::did_you_mean(nearest.as_deref()))]
    Place {
        /// The name.
        name: String,
        /// The most similar known name.
        nearest: Option<String>,
    },
    /// A place is moved too far from its usual position.
    #[error("{name} is moved by {by} shoulder widths; it must be from -1 to 1")]
    Far {
        /// The place.
        name: String,
        /// The number.
        by: f64,
    },
    /// A number is not finite, negative or too large.
    #[error("{name} is {value}; it must be from 0 to {most}")]
    Range {
        /// The name.
        name: String,
        /// The number.
        value: f64,
        /// The largest possible one.
        most: f64,
    },
    /// The unit differs from the value's.
    #[error("{name} is in {found:?}; it must be in {unit:?}")]
    Unit {
        /// The name.
        name: String,
        /// The unit in the file.
        found: String,
        /// The right one.
        unit: &'static str,
    },
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct LanguageFile {
    version: u32,
    #[serde(default)]
    description: String,
    #[serde(default)]
    values: BTreeMap<String, (f64, String, String)>,
    #[serde(default)]
    places: BTreeMap<String, [f64; 3]>,
}

/// The differences between one file of body language and another.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LanguageChanges {
    /// Numbers by the names of [`BodyLanguage::LANGUAGE_VALUE_NAMES`].
    pub values: BTreeMap<String, f64>,
    /// New offsets of places, as in [`BodyLanguage::places`].
    pub places: BTreeMap<String, [f64; 3]>,
}

macro_rules! body_language {
    ($($name:literal $field:ident $unit:literal $doc:literal)*) => {
        /// The meaning of the categories of notation in numbers. Unless noted, lengths are shares of the
        /// arm from shoulder to wrist, angles are in degrees, times in seconds.
        ///
        /// The file gives the source of each number.
        #[derive(Debug, Clone, PartialEq)]
        pub struct BodyLanguage {
            $(#[doc = $doc] pub $field: f64,)*
            /// Offsets of the body's places from their positions according to a skeleton's measures: the
            /// landmark's name with the offset (left, up, forward) in shoulder widths.
            pub places: BTreeMap<String, [f64; 3]>,
        }

        impl BodyLanguage {
            /// Every value's name and unit, in the order of the file.
            pub const LANGUAGE_VALUE_NAMES: &'static [(&'static str, &'static str)] = &[$(($name, $unit)),*];

            fn complete(values: &BTreeMap<String, (f64, String, String)>) -> Result<Self, BodyLanguageError> {
                Ok(Self {
                    $($field: values.get($name).ok_or(BodyLanguageError::Missing($name))?.0,)*
                    places: BTreeMap::new(),
                })
            }

            /// Returns the number with a name of [`LANGUAGE_VALUE_NAMES`](Self::LANGUAGE_VALUE_NAMES).
            #[must_use]
            pub fn value(&self, name: &str) -> Option<f64> {
                match name {
                    $($name => Some(self.$field),)*
                    _ => None,
                }
            }

            fn slot(&mut self, name: &str) -> Option<&mut f64> {
                match name {
                    $($name => Some(&mut self.$field),)*
                    _ => None,
                }
            }
        }
    };
}

body_language! {
    "distance.near-trunk" near_trunk "arm" "Distance from the trunk of a hand close to it."
    "distance.medium-trunk" medium_trunk "arm" "Distance from the trunk of a hand in the space in front of it."
    "distance.near-face" near_face "arm" "Distance from the face of a hand close to it."
    "distance.medium-face" medium_face "arm" "Distance from the face of a hand in front of it."
    "distance.far" far "arm" "Distance from the trunk of a hand that is held far away."
    "distance.hands-near" hands_near "arm" "Distance between hands that are close to each other."
    "distance.hands-apart" hands_apart "shoulder" "The distance from the middle to each of two hands without a written distance, in shoulder widths."
    "distance.beside" beside "shoulder" "Distance of the symbol `beside` from the side of the body, in shoulder widths."
    "move.small" move_small "arm" "A small straight movement."
    "move.normal" move_normal "arm" "A straight movement."
    "move.big" move_big "arm" "A big straight movement."
    "arc.small" arc_small "share" "The depth of a shallow arc against its chord."
    "arc.normal" arc_normal "share" "The depth of an arc against its chord."
    "arc.big" arc_big "share" "The depth of a deep arc against its chord."
    "zigzag.small" zigzag_small "arm" "Half the width of a small zigzag."
    "zigzag.normal" zigzag_normal "arm" "Half the width of a zigzag."
    "zigzag.big" zigzag_big "arm" "Half the width of a big zigzag."
    "zigzag.waves" zigzag_waves "count" "The number of waves of a zigzag."
    "zigzag.rate" zigzag_rate "1/s" "The highest number of a zigzag's waves per second."
    "circle.small" circle_small "arm" "The radius of a small circle."
    "circle.normal" circle_normal "arm" "The radius of a circle."
    "circle.big" circle_big "arm" "The radius of a big circle."
    "ellipse.small" ellipse_small "share" "The short axis of a slightly narrow ellipse against the long one."
    "ellipse.normal" ellipse_normal "share" "The short axis of an ellipse against the long one."
    "ellipse.big" ellipse_big "share" "The short axis of a narrow ellipse against the long one."
    "growth" growth "share" "The share by which something grows or shrinks from one repetition to the next."
    "wrist.nodding" wrist_nodding "deg" "The angle of a nodding hand to either side."
    "wrist.swinging" wrist_swinging "deg" "The angle of a swinging hand to either side."
    "wrist.twisting" wrist_twisting "deg" "The angle of a twisting forearm to either side."
    "wrist.stirring" wrist_stirring "deg" "Half the opening of the cone of a stirring hand."
    "wrist.small" wrist_small "share" "The angle of a small wrist movement, as a share of the usual one."
    "wrist.big" wrist_big "share" "The angle of a big wrist movement, as a share of the usual one."
    "wrist.cycles" wrist_cycles "count" "The number of times that a wrist moves to and fro."
    "play.angle" play_angle "deg" "The angle of playing fingers at their base joints, to either side."
    "play.cycles" play_cycles "count" "The number of times that each playing finger moves to and fro."
    "bounce" bounce "share" "The share of its path by which a bouncing hand springs back."
    "cross.size" cross_size "arm" "The length of a stroke of a cross."
    "time.straight" time_straight "s" "Duration of a straight movement."
    "time.arc" time_arc "s" "Duration of a curved movement."
    "time.circle" time_circle "s" "Duration of one turn of a circle."
    "time.wrist" time_wrist "s" "Duration of a wrist movement once to and fro."
    "time.play" time_play "s" "Duration of a finger movement once to and fro."
    "time.replace" time_replace "s" "Duration of a change of handshape or orientation."
    "time.return" time_return "s" "Duration of the return before a repetition."
    "time.still" time_still "s" "Duration of a movement in which nothing moves."
    "time.hold" time_hold "s" "Duration of a sign that consists of a posture only."
    "time.end" time_end "s" "Time for which the end of a movement is held."
    "time.contact" time_contact "s" "Time for which a hand stays after a hard contact."
    "time.rest" time_rest "s" "Duration of a rest before a movement."
    "time.transition" time_transition "s" "Duration of a transition, without the time that its distance adds."
    "time.transition-arm" time_transition_arm "s" "The time that each arm's length of distance adds to a transition."
    "time.approach-most" time_approach_most "s" "The longest approach to a movement that is slow or small."
    "time.slowest-turn" time_turn "s" "The time that each right angle of the hand's rotation adds to a transition."
    "time.body" time_body "s" "Duration of a movement of the body."
    "time.attack" time_attack "s" "Time in which a non-manual rises from nothing to its full strength."
    "time.release" time_release "s" "Time in which a non-manual falls back to nothing."
    "speed.most" speed_most "arm/s" "The highest speed of a hand."
    "speed.wrist" speed_wrist "arm/s" "The speed that no wrist exceeds; time is stretched instead."
    "speed.joint" speed_joint "rad/s" "The speed that no joint of an arm exceeds; time is stretched instead."
    "manner.fast" manner_fast "share" "Duration of a fast movement, as a share of the usual one."
    "manner.slow" manner_slow "share" "Duration of a slow movement, as a share of the usual one."
    "manner.tense" manner_tense "share" "Duration of a tense movement, as a share of the usual one."
    "manner.halt" manner_halt "share" "Duration of a movement with a sudden stop, as a share of the usual one."
    "repeat.several" repeat_several "count" "The number of repetitions for \"several times\", after the first performance."
    "repeat.random" repeat_random "count" "The number of repetitions for \"many times at random\", after the first performance."
    "repeat.shift" repeat_shift "arm" "The distance by which each repetition begins farther on."
    "fused" fused "share" "The share of its time that a movement shares with the next one, with which it is fused."
    "bend.base" bend_base "deg" "The largest flexion of a base joint."
    "bend.middle" bend_middle "deg" "The largest flexion of a middle joint."
    "bend.end" bend_end "deg" "The largest flexion of an end joint."
    "bend.thumb-middle" bend_thumb_middle "deg" "The largest flexion of the thumb's middle joint."
    "bend.thumb-end" bend_thumb_end "deg" "The largest flexion of the thumb's end joint."
    "splay" splay "share" "The spread of fingers, as a share of the spread hand's."
    "splay.more" splay_more "share" "A wide spread, as a share of the usual one."
    "elbow.own-side" elbow_own_side "deg" "The angle of the arm's plane from the vertical, with the hand in front of its own shoulder."
    "elbow.across" elbow_across "deg" "The angle of the arm's plane from the vertical, with the hand in front of the other shoulder."
    "elbow.low" elbow_low "arm" "The usual depth of an elbow below its shoulder, with the hand at the belly."
    "elbow.level" elbow_level "arm" "The same with the hand at the height of the shoulder."
    "elbow.high" elbow_high "arm" "The same with the hand in front of the forehead."
    "clavicle.from" clavicle_from "share" "The share of the arm's length beyond which the collar bone helps."
    "clavicle.most" clavicle_most "deg" "The limit of a collar bone's rotation, which is approached but not reached."
    "clavicle.shrug" shrug "deg" "The largest rotation of a collar bone that helps a hand to its written direction."
    "clavicle.shrug-down" shrug_down "share" "The share of that rotation that is allowed downwards."
    "room.side" room_side "arm" "The distance to either side within which a hand still counts as at its place in space."
    "room.up" room_up "arm" "The same distance upwards."
    "room.down" room_down "arm" "The same distance downwards."
    "room.forward" room_forward "arm" "The same distance forwards."
    "room.back" room_back "arm" "The same distance backwards."
    "room.close" room_close "share" "The share of these distances that is allowed close to the trunk or in front of the face."
    "room.face" room_face "share" "The share of these distances that is allowed close to the face."
    "room.free-out" room_free_out "arm" "The distance that a hand without a written place may move towards its own side."
    "room.free-in" room_free_in "arm" "The same distance towards the other side."
    "room.free-up" room_free_up "arm" "The same distance upwards."
    "room.free-down" room_free_down "arm" "The same distance downwards."
    "room.free-forward" room_free_forward "arm" "The same distance forwards."
    "room.free-back" room_free_back "arm" "The same distance backwards."
    "limit.flexion" limit_flexion "deg" "The limit of a wrist's bend towards the palm."
    "limit.extension" limit_extension "deg" "The limit of a wrist's bend towards the back of the hand."
    "limit.radial" limit_radial "deg" "The limit of a wrist's bend towards the thumb."
    "limit.ulnar" limit_ulnar "deg" "The limit of a wrist's bend towards the little finger."
    "limit.pronation" limit_pronation "deg" "The limit of a forearm's rotation from thumb up to palm down."
    "limit.supination" limit_supination "deg" "The limit of a forearm's rotation from thumb up to palm up."
    "limit.elbow" limit_elbow "deg" "The limit of an elbow's flexion."
    "life.sway" life_sway "deg" "The angle by which a trunk sways to either side; 0 switches it off."
    "life.sway-time" life_sway_time "s" "Duration of one sway of the trunk to and fro."
    "life.head" life_head "share" "The share of the angle to the hands by which a head turns to them; 0 switches it off."
    "life.gaze" life_gaze "share" "The share of the angle to the hands by which the eyes turn to them; 0 switches it off."
    "life.shoulder" life_shoulder "deg" "The angle by which a shoulder rises with a hand above it; 0 switches it off."
    "life.blink" life_blink "s" "The longest time between two blinks, apart from those at the boundaries of signs; 0 switches them off."
    "life.seed" life_seed "count" "The seed of the sway: each number gives another sway."
    "tolerance" tolerance "deg" "The largest deviation of a hand from its written direction that still counts as that direction."
    "course.targetted.gain" targetted_gain "count" "The growth of stiffness in a targetted movement."
    "course.targetted.power" targetted_power "count" "The power of the covered share of the path with which that stiffness grows."
    "course.targetted.ratio" targetted_ratio "count" "The ratio of the two gains: 4 is critical."
    "course.lax.gain" lax_gain "count" "The growth of stiffness in a lax movement."
    "course.lax.power" lax_power "count" "The power of the covered share of the path with which that stiffness grows."
    "course.lax.ratio" lax_ratio "count" "The ratio of the two gains."
    "course.contact.gain" contact_gain "count" "The growth of stiffness in a movement into contact."
    "course.contact.power" contact_power "count" "The power of the covered share of the path with which that stiffness grows."
    "course.contact.ratio" contact_ratio "count" "The ratio of the two gains."
    "course.contact.brake" contact_brake "share" "The share of the time in which a hand stops after it hits something."
    "course.halt.gain" halt_gain "count" "The growth of stiffness before a sudden stop."
    "course.halt.power" halt_power "count" "The power of the covered share of the path with which that stiffness grows."
    "course.halt.ratio" halt_ratio "count" "The ratio of the two gains."
    "course.tense.gain" tense_gain "count" "The growth of stiffness in a tense movement; 0 for a steady one."
    "course.tense.power" tense_power "count" "The power of the covered share of the path with which that stiffness grows."
    "course.tense.ratio" tense_ratio "count" "The ratio of the two gains."
    "course.linear.ramp" linear_ramp "share" "The share of the time in which a linear movement reaches its speed, and loses it."
}

impl Default for BodyLanguage {
    fn default() -> Self {
        Self::default_body_language().clone()
    }
}

impl BodyLanguage {
    /// Returns the limits of wrist and forearm.
    #[must_use]
    pub fn wrist_limits(&self) -> WristLimits {
        let angles = |less: f64, more: f64| [less.to_radians(), more.to_radians()];
        WristLimits {
            flexion: angles(self.limit_extension, self.limit_flexion),
            deviation: angles(self.limit_ulnar, self.limit_radial),
            turn: angles(self.limit_pronation, self.limit_supination),
        }
    }

    /// Returns the body language of the program's own file.
    #[must_use]
    pub fn default_body_language() -> &'static Self {
        static DEFAULT_BODY_LANGUAGE: OnceLock<BodyLanguage> = OnceLock::new();
        DEFAULT_BODY_LANGUAGE.get_or_init(|| {
            let text = chereme_data::schema_text("notation/body_language.json");
            Self::parse_body_language(text).expect("the program's own body language is whole")
        })
    }

    /// Returns this body language without sway, blinks and the help of head, eyes and shoulders, so that only notated
    /// parts move.
    #[must_use]
    pub fn without_life(&self) -> Self {
        Self {
            life_sway: 0.0,
            life_head: 0.0,
            life_gaze: 0.0,
            life_shoulder: 0.0,
            life_blink: 0.0,
            ..self.clone()
        }
    }

    fn parse_body_language(text: &str) -> Result<Self, BodyLanguageError> {
        let file = read_language_file(text)?;
        Self::complete(&file.values)
    }

    /// Reads all values and places of a file of the same form.
    ///
    /// # Errors
    /// [`BodyLanguageError`] for a name that is unknown, a wrong unit, or a number out of range.
    pub fn parse_language_changes(text: &str) -> Result<LanguageChanges, BodyLanguageError> {
        let file = read_language_file(text)?;
        let values = file.values.into_iter();
        Ok(LanguageChanges {
            values: values.map(|(name, (value, ..))| (name, value)).collect(),
            places: file.places,
        })
    }

    /// Returns this body language with the values and places that a file of the same form holds.
    ///
    /// # Errors
    /// The same as [`parse_language_changes`](Self::parse_language_changes)'s.
    pub fn with_file(&self, text: &str) -> Result<Self, BodyLanguageError> {
        let LanguageChanges { values, places } = Self::parse_language_changes(text)?;
        let values = values.iter().map(|(name, value)| (name.as_str(), *value));
        let mut changed = self.with_measured(values)?;
        changed.places.extend(places);
        Ok(changed)
    }

    /// Returns this body language with measured values in place of some of its own, such as those
    /// found in captured signs; names are those of [`LANGUAGE_VALUE_NAMES`](Self::LANGUAGE_VALUE_NAMES).
    ///
    /// # Errors
    /// [`BodyLanguageError`] if a name is unknown or a number out of range.
    pub fn with_measured<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Self, BodyLanguageError> {
        let mut changed = self.clone();
        for (name, value) in values {
            check_language_value(name, value, None)?;
            if let Some(slot) = changed.slot(name) {
                *slot = value;
            }
        }
        Ok(changed)
    }
}

fn read_language_file(text: &str) -> Result<LanguageFile, BodyLanguageError> {
    let file: LanguageFile = serde_json::from_str(text)?;
    if file.version != LANGUAGE_FILE_VERSION {
        return Err(BodyLanguageError::Version(file.version));
    }
    for (name, (value, unit, _)) in &file.values {
        check_language_value(name, *value, Some(unit))?;
    }
    file.places.iter().try_for_each(|(name, by)| check_place(name, by))?;
    Ok(file)
}

fn check_place(name: &str, by: &[f64; 3]) -> Result<(), BodyLanguageError> {
    let landmark_names = BodyAnatomy::landmark_names();
    if !landmark_names.iter().any(|known| known == name) {
        let nearest = crate::text::nearest_candidate(name, landmark_names.iter().map(String::as_str));
        return Err(BodyLanguageError::Place {
            name: name.to_owned(),
            nearest: nearest.map(str::to_owned),
        });
    }
    match by.iter().find(|by| !(-1.0..=1.0).contains(*by)) {
        Some(&by) => Err(BodyLanguageError::Far {
            name: name.to_owned(),
            by,
        }),
        None => Ok(()),
    }
}

fn check_language_value(name: &str, value: f64, found: Option<&str>) -> Result<(), BodyLanguageError> {
    let entry = BodyLanguage::LANGUAGE_VALUE_NAMES
        .iter()
        .find(|(known, _)| *known == name);
    let Some(&(_, unit)) = entry else {
        let names = BodyLanguage::LANGUAGE_VALUE_NAMES.iter().map(|(name, _)| *name);
        return Err(BodyLanguageError::Unknown {
            name: name.to_owned(),
            nearest: crate::text::nearest_candidate(name, names).map(str::to_owned),
        });
    };
    if let Some(found) = found.filter(|found| *found != unit) {
        return Err(BodyLanguageError::Unit {
            name: name.to_owned(),
            found: found.to_owned(),
            unit,
        });
    }
    let most = match unit {
        "deg" => 180.0,
        "s" => 10.0,
        "arm" | "shoulder" => 3.0,
        "arm/s" | "rad/s" | "count" => 100.0,
        _ => 10.0,
    };
    if !(0.0..=most).contains(&value) {
        return Err(BodyLanguageError::Range {
            name: name.to_owned(),
            value,
            most,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_file_names_exactly_the_known_values_with_their_units() {
        let text = chereme_data::schema_text("notation/body_language.json");
        let file = read_language_file(text).expect("the own file");
        assert_eq!(file.values.len(), BodyLanguage::LANGUAGE_VALUE_NAMES.len());
        assert!(BodyLanguage::default_body_language().move_small < BodyLanguage::default_body_language().move_big);
    }

    #[test]
    fn another_file_replaces_some_and_odd_ones_are_refused() {
        let usual = BodyLanguage::default_body_language();
        let file = |name: &str, value: f64, unit: &str| {
            format!(r#"{{"version": 1, "values": {{"{name}": [{value}, "{unit}", "mine"]}}}}"#)
        };
        let mine = usual.with_file(&file("time.arc", 0.5, "s")).expect("mine");
        assert_eq!((mine.time_arc, mine.time_straight), (0.5, usual.time_straight));
        let says = |text: &str| usual.with_file(text).expect_err("refused").to_string();
        assert!(says(&file("time.ark", 0.5, "s")).contains("time.arc"));
        assert!(says(&file("time.arc", 0.5, "ms")).contains("\"s\""));
        assert!(says(&file("time.arc", -1.0, "s")).contains("from 0 to 10"));
        assert!(says(r#"{"version": 2, "values": {}}"#).contains("version 2"));
        assert!(usual.with_measured([("move.big", f64::NAN)]).is_err());
        assert_eq!(usual.with_measured([("move.big", 0.5)]).expect("0.5").move_big, 0.5);
    }

    #[test]
    fn each_unit_has_its_own_range() {
        let usual = BodyLanguage::default_body_language();
        let mut units = BTreeMap::new();
        for (name, unit) in BodyLanguage::LANGUAGE_VALUE_NAMES {
            let most = match *unit {
                "deg" => 180.0,
                "arm" | "shoulder" => 3.0,
                "arm/s" | "rad/s" | "count" => 100.0,
                _ => 10.0,
            };
            units.insert(*unit, most);
            let with = |value: f64| usual.with_measured([(*name, value)]);
            assert_eq!(with(most).expect(name).value(name), Some(most));
            assert_eq!(with(0.0).expect(name).value(name), Some(0.0));
            for value in [most + 0.01, -0.01] {
                let said = with(value).expect_err(name).to_string();
                assert!(said.contains(&format!("from 0 to {most}")), "{said}");
            }
        }
        assert!(units.len() > 6, "{units:?}");
    }
}
