//! Compares postures and movements from small signs with those that the reference engine makes from them.
//!
//! The numbers of the reference lie outside this repository, in `facts` next to the shared data; the file describes its
//! fields. Positions are in shoulder widths from the middle of the shoulders: left, up, forward.

use std::path::Path;

use chereme_compose::MovementMaterial;
use chereme_compose::notation::{AnimatorSettings, SignPerformer};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide, Clip, HandFinger, ModelPose};
use chereme_sign::hamnosys::sites::{digit_joint, resolve_body_site};
use chereme_sign::hamnosys::{
    BodyLanguage, CompassDirection, HandDigit, HandPlace, LocationSide, NotatedSign, SidedLocation, SpatialDirection,
    orientation,
};
use serde_json::Value;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// What is compared: its name, its unit, and the tolerance with its reason.
pub(crate) struct VectorGroup {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) tolerance: f64,
    pub(crate) reason: &'static str,
}

const fn vector_group(name: &'static str, unit: &'static str, tolerance: f64, reason: &'static str) -> VectorGroup {
    VectorGroup {
        name,
        unit,
        tolerance,
        reason,
    }
}

const HAND_AXIS_REASON: &str = "the reference's knuckles read up to 18° off its own rule";
const JOINT_LIMITS_REASON: &str = "the same; wrist and forearm have limits here";
const OTHER_BODY_REASON: &str = "landmarks, arms and hands differ between bodies";
const FROM_LANDMARK_REASON: &str = "from the landmark; hands are of different sizes";

/// The groups, in the order of the table.
pub(crate) const VECTOR_GROUPS: [VectorGroup; 22] = [
    vector_group("palm as asked, one hand", "°", 20.0, HAND_AXIS_REASON),
    vector_group("palm reached, one hand", "°", 20.0, JOINT_LIMITS_REASON),
    vector_group("fingers reached, one hand", "°", 20.0, JOINT_LIMITS_REASON),
    vector_group("palm reached, left hand, mirrored", "°", 20.0, JOINT_LIMITS_REASON),
    vector_group("palm reached, left hand, parallel", "°", 20.0, JOINT_LIMITS_REASON),
    vector_group("palm reached, half-way direction", "°", 25.0, JOINT_LIMITS_REASON),
    vector_group("palm reached, half-way palm", "°", 25.0, JOINT_LIMITS_REASON),
    vector_group("place in the face, no mark", "sw", 0.2, FROM_LANDMARK_REASON),
    vector_group("place in the face, close", "sw", 0.2, FROM_LANDMARK_REASON),
    vector_group("place in the face, touch", "sw", 0.2, FROM_LANDMARK_REASON),
    vector_group("place before trunk and head, no mark", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place before trunk and head, close", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place at the trunk, touch", "sw", 0.2, OTHER_BODY_REASON),
    vector_group(
        "place, arm extended",
        "sw",
        0.2,
        "the arm is truly extended here, to .93 there",
    ),
    vector_group("place between two", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place, both hands", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place, hands together", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place, the hand at the other hand", "sw", 0.2, OTHER_BODY_REASON),
    vector_group("place, the other hand under it", "sw", 0.2, OTHER_BODY_REASON),
    vector_group(
        "joints of fingers",
        "°",
        20.0,
        "rest postures of fingers differ between bodies",
    ),
    vector_group(
        "straight movements, direction",
        "°",
        15.0,
        "the reference is exact to 2°",
    ),
    vector_group("written times", "share", 0.02, "one frame of 60 a second"),
];

/// The differences of a group, each with the key of its sign, in the group's unit.
pub(crate) struct VectorDifferences {
    pub(crate) group: &'static VectorGroup,
    differences: Vec<(String, f64)>,
}

impl VectorDifferences {
    /// Returns the differences, each with the key of its sign, the least first.
    pub(crate) fn sorted_differences(&self) -> Vec<(String, f64)> {
        let mut sorted = self.differences.clone();
        sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
        sorted
    }

    /// Returns how many are within the tolerance of the group.
    pub(crate) fn count_within(&self) -> usize {
        let within = self.differences.iter().filter(|(_, off)| *off <= self.group.tolerance);
        within.count()
    }
}

/// The reference's file, the body that performs, and how many signs are left out.
struct VectorComparison<'a> {
    vectors: &'a Value,
    performer: SignPerformer,
    stage: &'a MovementMaterial,
    every: usize,
    table: Vec<VectorDifferences>,
}

/// The hand of a body in one frame, in body space.
#[derive(Clone, Copy)]
struct SeenHand {
    along: DVec3,
    normal: DVec3,
    palm: DVec3,
}

/// Compares one sign out of `every` with the reference.
pub(crate) fn compare_vectors(file: &Path, stage: &MovementMaterial, every: usize) -> Result<Vec<VectorDifferences>> {
    let vectors: Value = serde_json::from_slice(&std::fs::read(file)?)?;
    let settings = AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    let table = VECTOR_GROUPS.iter().map(|group| VectorDifferences {
        group,
        differences: Vec::new(),
    });
    let mut comparison = VectorComparison {
        vectors: &vectors,
        performer: SignPerformer::new(stage.clone(), settings)?,
        stage,
        every,
        table: table.collect(),
    };
    comparison.compare_orientations()?;
    comparison.compare_places()?;
    comparison.compare_handshapes()?;
    comparison.compare_movements()?;
    Ok(comparison.table)
}

impl<'a> VectorComparison<'a> {
    /// Returns the sampled signs of a section of the file, without those in which the reference has gaps: it has no place
    /// there, or does not tell it from another.
    fn sampled_section(&self, name: &str) -> impl Iterator<Item = (&'a str, &'a Value)> + use<'a> {
        let section = self.vectors[name].as_object().into_iter().flatten();
        let gaps = |key: &str| {
            REFERENCE_GAPS
                .iter()
                .any(|[place, mark]| key.starts_with(place) && key.contains(mark))
        };
        let signs = section.filter(move |(key, value)| value.get("failed").is_none() && !gaps(key));
        signs.map(|(key, value)| (key.as_str(), value)).step_by(self.every)
    }

    fn add_difference(&mut self, group: &str, key: &str, off: f64) {
        let row = self.table.iter_mut().find(|row| row.group.name == group);
        row.expect("a group of the table")
            .differences
            .push((key.to_owned(), off));
    }

    /// Performs a sign with this manual part; `attributes` are those of the sign.
    fn perform_manual(&self, attributes: &str, manual: &str, whole: bool) -> Result<Clip> {
        let sign = &read_sign(attributes, manual)?;
        Ok(match whole {
            true => self.performer.perform_sign(sign)?,
            false => self.performer.perform_first_posture(sign)?,
        })
    }

    /// Returns the hands, right and left, in the first posture of a sign.
    fn first_posture(&self, manual: &str) -> Result<[SeenHand; 2]> {
        let model = self.perform_manual("", manual, false)?.model_pose(0);
        let seen = [BodySide::Right, BodySide::Left].map(|side| self.seen_hand(side, &model));
        let [Some(right), Some(left)] = seen else {
            return Err("the body has no two hands with fingers".into());
        };
        Ok([right, left])
    }

    fn seen_hand(&self, side: BodySide, model: &ModelPose) -> Option<SeenHand> {
        let anatomy = &self.stage.anatomy;
        let frame = anatomy.body_frame(model)?;
        let joint = |part| Some(model.model_joint_position(anatomy.part_joint(part)?));
        let wrist = joint(BodyPart::Hand(side))?;
        let knuckle = joint(BodyPart::Finger(side, HandFinger::Middle, 1))?;
        Some(SeenHand {
            along: frame.direction_to_body(anatomy.hand_direction(side, model)?),
            normal: frame.direction_to_body(anatomy.palm_normal(side, model)?),
            palm: frame.to_body((wrist + knuckle) * 0.5),
        })
    }

    fn compare_orientations(&mut self) -> Result<()> {
        for (key, value) in self.sampled_section("a_one_hand") {
            let (extended, palm) = key.split_once('_').ok_or("a key without a palm")?;
            let along = extended.parse::<SpatialDirection>()?.spatial_direction_vector();
            let asked = orientation::palm_direction_vector(along, palm.parse::<CompassDirection>()?.compass_angle());
            let [right, _] = self.first_posture(&manual_part("", &flat_hand(extended, palm), ""))?;
            let [fingers, normal] = [vector_from_json(&value["f"]), vector_from_json(&value["n"])];
            let asked = degrees_between(asked.into(), normal);
            self.add_difference("palm as asked, one hand", key, asked);
            self.add_difference("palm reached, one hand", key, degrees_between(right.normal, normal));
            self.add_difference("fingers reached, one hand", key, degrees_between(right.along, fingers));
        }
        let sections = [
            (
                "a_both_lr_left_hand",
                "palm reached, left hand, mirrored",
                LEFT_RIGHT_ATTRIBUTES,
                1,
            ),
            (
                "a_both_parallel_left_hand",
                "palm reached, left hand, parallel",
                PARALLEL_ATTRIBUTES,
                1,
            ),
            ("a_half_way_direction", "palm reached, half-way direction", "", 0),
            ("a_half_way_palm", "palm reached, half-way palm", "", 0),
        ];
        for (section, group, symmetry, hand) in sections {
            for (key, value) in self.sampled_section(section) {
                let (extended, palm) = key.split_once('_').ok_or("a key without a palm")?;
                let seen = self.first_posture(&manual_part(symmetry, &flat_hand(extended, palm), ""))?;
                self.add_difference(
                    group,
                    key,
                    degrees_between(seen[hand].normal, vector_from_json(&value["n"])),
                );
            }
        }
        Ok(())
    }

    fn compare_places(&mut self) -> Result<()> {
        for (key, value) in self.sampled_section("b_locations") {
            let parts: Vec<&str> = key.split('|').collect();
            let [location, side, contact] = parts[..] else { continue };
            // A location without a name is no location.
            let place = match location {
                "none" => String::new(),
                _ => body_place(location, side, contact, ""),
            };
            self.compare_palm(
                [place_group(location, contact), key],
                ["", &flat_hand("u", "l"), &place],
                value,
            )?;
        }
        for (key, value) in self.sampled_section("b_other_directions") {
            let parts: Vec<&str> = key.split('_').collect();
            let [location, hand, contact] = parts[..] else { continue };
            let place = body_place(location, "", contact, "");
            self.compare_palm(
                [place_group(location, contact), key],
                ["", &keyed_hand(hand), &place],
                value,
            )?;
        }
        for (key, value) in self.sampled_section("b_half_way_locations") {
            let (pair, contact) = key.split_once('_').unwrap_or((key, ""));
            let (first, second) = pair.split_once('-').unwrap_or((pair, ""));
            let place = body_place(first, "", contact, &format!(" second_location=\"{second}\""));
            self.compare_palm(["place between two", key], ["", &flat_hand("u", "l"), &place], value)?;
        }
        for (key, value) in self.sampled_section("b_both_hands") {
            let parts: Vec<&str> = key.split('_').collect();
            let [location, symmetry, contact] = parts[..] else {
                continue;
            };
            let group = if contact == "armextended" {
                "place, arm extended"
            } else {
                "place, both hands"
            };
            let symmetry = if symmetry == "lr" {
                LEFT_RIGHT_ATTRIBUTES
            } else {
                PARALLEL_ATTRIBUTES
            };
            let place = body_place(location, "", contact, "");
            self.compare_palm([group, key], [symmetry, &flat_hand("o", "l"), &place], value)?;
        }
        for (key, value) in self.sampled_section("b_constellation_mirror") {
            let parts: Vec<&str> = key.split('_').collect();
            let [contact, location, hand] = parts[..] else { continue };
            let site = if location.is_empty() {
                String::new()
            } else {
                body_place(location, "", "", "")
            };
            let place = format!(
                "<handconstellation{}>{site}</handconstellation>",
                xml_attribute("contact", contact)
            );
            self.compare_palm(
                ["place, hands together", key],
                [LEFT_RIGHT_ATTRIBUTES, &keyed_hand(hand), &place],
                value,
            )?;
        }
        for (key, value) in self.sampled_section("b_hand_of_other_hand") {
            let (part, contact) = key.split_once('_').unwrap_or((key, ""));
            let touched = format!(
                "<location_hand location=\"{part}\"{}/>",
                xml_attribute("contact", contact)
            );
            let held = body_place("stomach", "", "", "");
            let place = format!("<split_location>{touched}{held}</split_location>");
            let seen = self.first_posture(&manual_part("", SPLIT_HANDS, &place))?;
            let groups = ["place, the hand at the other hand", "place, the other hand under it"];
            for (n, (group, palm)) in groups.into_iter().zip(["palm", "left_palm"]).enumerate() {
                self.add_difference(group, key, seen[n].palm.distance(vector_from_json(&value[palm])));
            }
        }
        Ok(())
    }

    /// Adds the distance of the right palm from the reference's: from the landmark at places of the face.
    fn compare_palm(
        &mut self,
        [group, key]: [&str; 2],
        [attributes, hand, place]: [&str; 3],
        value: &Value,
    ) -> Result<()> {
        let manual = manual_part(attributes, hand, place);
        let clip = self.perform_manual("", &manual, false)?;
        let model = clip.model_pose(0);
        let right = self
            .seen_hand(BodySide::Right, &model)
            .ok_or("the body has no right hand with fingers")?;
        let between = self.landmark_difference(&manual, key, &model).unwrap_or_default();
        self.add_difference(
            group,
            key,
            right.palm.distance(vector_from_json(&value["palm"]) + between),
        );
        Ok(())
    }

    /// Returns the vector from the reference's landmark of a place of the face to this body's.
    fn landmark_difference(&self, manual: &str, key: &str, model: &ModelPose) -> Option<DVec3> {
        let name = key.split(['|', '_']).next()?;
        (FACE_LOCATIONS.contains(&name) && !key.ends_with("armextended")).then_some(())?;
        let sign = read_sign("", manual).ok()?;
        let Some(HandPlace::Body(place)) = &sign.sign.parts.first()?.posture.place else {
            return None;
        };
        let (letter, side) = match place.site?.side {
            Some(LocationSide::LeftAt | LocationSide::LeftBeside) => ("L", Some(LocationSide::LeftAt)),
            Some(LocationSide::RightAt | LocationSide::RightBeside) => ("R", Some(LocationSide::RightAt)),
            _ => ("C", None),
        };
        let landmarks = &self.vectors["body"]["landmarks"];
        let mut letters = [letter, "C", "R"].into_iter();
        let there = letters.find_map(|letter| landmarks.get(format!("S-{name}-{letter}")))?;
        let site = resolve_body_site(&SidedLocation { side, ..place.site? }, BodySide::Right, false);
        let anatomy = &self.stage.anatomy;
        let skeleton = self.stage.clip.clip_skeleton();
        let here = anatomy.landmark_place_position(skeleton, model, &site.landmark)?;
        Some(anatomy.body_frame(model)?.to_body(here) + DVec3::from(site.offset) - vector_from_json(there))
    }

    /// Compares bends at base, middle and end joints: the worst of a hand's twelve.
    fn compare_handshapes(&mut self) -> Result<()> {
        let plain = self.vectors["c_handshapes"]["s_flat__"].clone();
        for (key, value) in self.sampled_section("c_handshapes") {
            let Some(["s", shape, thumb, bend]) = key.split('_').collect::<Vec<_>>().first_chunk::<4>().copied() else {
                continue;
            };
            let [shape, thumb, bend] = [
                xml_attribute("handshape", shape),
                xml_attribute("thumbpos", thumb),
                xml_attribute("mainbend", bend),
            ];
            let hand = format!("<handconfig{shape}{thumb}{bend}/>{}", aim_attributes("u", "l"));
            let model = self
                .perform_manual("", &manual_part("", &hand, ""), false)?
                .model_pose(0);
            let mut worst = 0.0_f64;
            for (digit, letter) in HandDigit::ALL_HAND_DIGITS.into_iter().skip(1).zip(["I", "M", "R", "P"]) {
                let Some(bends) = self.finger_bends(digit, &model) else {
                    continue;
                };
                for (joint, bend) in [0, 2, 3].into_iter().zip(bends) {
                    let there = |sign: &Value| sign[letter][joint].as_f64().unwrap_or_default();
                    worst = worst.max((bend - (there(value) - there(&plain))).abs());
                }
            }
            self.add_difference("joints of fingers", key, worst);
        }
        Ok(())
    }

    /// Returns the bends (degrees) of a finger of the right hand at its three joints.
    fn finger_bends(&self, digit: HandDigit, model: &ModelPose) -> Option<[f64; 3]> {
        let anatomy = &self.stage.anatomy;
        let side = BodySide::Right;
        let joints = [1, 2, 3].map(|n| anatomy.part_joint(digit_joint(side, digit, n)));
        let [Some(base), Some(middle), Some(end)] = joints.map(|joint| Some(model.model_joint_position(joint?))) else {
            return None;
        };
        let name = format!(
            "right-{}-tip",
            ["thumb", "index", "middle", "ring", "pinky"][digit as usize]
        );
        let skeleton = self.stage.clip.clip_skeleton();
        let tip = anatomy.landmark_place_position(skeleton, model, &name)?;
        let (along, palm) = (anatomy.hand_direction(side, model)?, anatomy.palm_normal(side, model)?);
        let bones = [middle - base, end - middle, tip - end];
        let raised = bones[0].dot(palm).atan2(bones[0].dot(along)).to_degrees();
        Some([
            raised,
            degrees_between(bones[0], bones[1]),
            degrees_between(bones[1], bones[2]),
        ])
    }

    fn compare_movements(&mut self) -> Result<()> {
        for (key, _) in self.sampled_section("d_paths") {
            let Some(["m", direction, size]) = key.split('_').collect::<Vec<_>>().first_chunk::<3>().copied() else {
                continue;
            };
            let motion = format!(
                "<directedmotion direction=\"{direction}\"{}/>",
                xml_attribute("size", size)
            );
            let clip = self.perform_manual("", &manual_part("", &flat_hand("o", "d"), &motion), true)?;
            let ends =
                [0, clip.clip_frame_count() - 1].map(|frame| self.seen_hand(BodySide::Right, &clip.model_pose(frame)));
            let [Some(start), Some(end)] = ends else { continue };
            let written = direction.parse::<SpatialDirection>()?.spatial_direction_vector();
            self.add_difference(
                "straight movements, direction",
                key,
                degrees_between(end.palm - start.palm, written.into()),
            );
        }
        let motions = [
            ("att", "<directedmotion direction=\"l\"/>"),
            (
                "atr",
                "<rpt_motion repetition=\"fromstart\"><circularmotion axis=\"o\"/></rpt_motion>",
            ),
        ];
        for (begins, motion) in motions {
            let hand = flat_hand("o", "d");
            let usual = clip_seconds(&self.perform_manual("", &manual_part("", &hand, motion), true)?);
            for (key, _) in self.sampled_section("e_nonmanual_and_times") {
                let Some((name, number)) = key.strip_prefix(begins).and_then(|rest| rest.split_once('_')) else {
                    continue;
                };
                let factor: f64 = number.parse()?;
                let asked = match name {
                    "speed" => usual / factor,
                    "timescale" => usual * factor,
                    "duration" => factor,
                    _ => continue,
                };
                let clip = self.perform_manual(&xml_attribute(name, number), &manual_part("", &hand, motion), true)?;
                let lasts = clip_seconds(&clip);
                self.add_difference("written times", key, (lasts / asked - 1.0).abs());
            }
        }
        Ok(())
    }
}

fn read_sign(attributes: &str, manual: &str) -> Result<NotatedSign> {
    let text = format!("<sigml><hamgestural_sign gloss=\"V\"{attributes}>{manual}</hamgestural_sign></sigml>");
    let (signs, _) = chereme_formats::sigml::read_sigml_signs(text.as_bytes())?;
    Ok(signs.into_iter().next().ok_or("no sign was read")?.sign)
}

/// Returns the time from the first frame to the last.
fn clip_seconds(clip: &Clip) -> f64 {
    (clip.clip_frame_count() - 1) as f64 / clip.clip_frame_rate().per_second()
}

/// Places whose gaps in the reference are described with its numbers, and the mark for which each is one: they are not
/// above the head and the shoulder, or are at the hips.
const REFERENCE_GAPS: [[&str; 2]; 6] = [
    ["headtop", ""],
    ["head_", "touch"],
    ["neutralspace", "close"],
    ["neutralspace", "touch"],
    ["neutralspace", "armextended"],
    ["shouldertop", ""],
];

const LEFT_RIGHT_ATTRIBUTES: &str = " both_hands=\"true\" lr_symm=\"true\"";
/// Flat hands, the dominant one's palm on the other's.
const SPLIT_HANDS: &str = concat!(
    r#"<split_handconfig><handconfig handshape="flat"/><handconfig handshape="flat"/></split_handconfig>"#,
    r#"<split_handconfig><handconfig extfidir="ol"/><handconfig extfidir="or"/></split_handconfig>"#,
    r#"<split_handconfig><handconfig palmor="d"/><handconfig palmor="u"/></split_handconfig>"#
);
const PARALLEL_ATTRIBUTES: &str = " both_hands=\"true\"";
const FACE_LOCATIONS: [&str; 19] = [
    "forehead",
    "eyebrows",
    "eyes",
    "uppereyelid",
    "lowereyelid",
    "nose",
    "nostrils",
    "lips",
    "upperlip",
    "lowerlip",
    "tongue",
    "teeth",
    "upperteeth",
    "lowerteeth",
    "chin",
    "underchin",
    "ear",
    "earlobe",
    "cheek",
];

fn place_group(location: &str, contact: &str) -> &'static str {
    match (FACE_LOCATIONS.contains(&location), contact) {
        (_, "armextended") => "place, arm extended",
        (true, "touch") => "place in the face, touch",
        (true, "close") => "place in the face, close",
        (true, _) => "place in the face, no mark",
        (false, "touch") => "place at the trunk, touch",
        (false, "close") => "place before trunk and head, close",
        (false, _) => "place before trunk and head, no mark",
    }
}

fn manual_part(attributes: &str, hand: &str, then: &str) -> String {
    format!("<sign_manual{attributes}>{hand}{then}</sign_manual>")
}

fn xml_attribute(name: &str, value: &str) -> String {
    match value {
        "" => String::new(),
        value => format!(" {name}=\"{value}\""),
    }
}

/// Returns a flat hand; each direction may be half-way between two, `u-ul`.
fn flat_hand(extended: &str, palm: &str) -> String {
    format!("<handconfig handshape=\"flat\"/>{}", aim_attributes(extended, palm))
}

fn aim_attributes(extended: &str, palm: &str) -> String {
    let aim = |name: &str, written: &str| {
        let (first, second) = written.split_once('-').unwrap_or((written, ""));
        let second = xml_attribute(&format!("second_{name}"), second);
        format!("<handconfig {name}=\"{first}\"{second}/>")
    };
    aim("extfidir", extended) + &aim("palmor", palm)
}

/// Returns a flat hand whose directions a key names together, `uldl`.
fn keyed_hand(key: &str) -> String {
    let (extended, palm) = key.split_at(key.len() / 2);
    flat_hand(extended, palm)
}

fn body_place(location: &str, side: &str, contact: &str, more: &str) -> String {
    let [side, contact] = [xml_attribute("side", side), xml_attribute("contact", contact)];
    format!("<location_bodyarm location=\"{location}\"{side}{contact}{more}/>")
}

fn vector_from_json(value: &Value) -> DVec3 {
    let part = |n: usize| value[n].as_f64().unwrap_or(f64::NAN);
    DVec3::new(part(0), part(1), part(2))
}

fn degrees_between(first: DVec3, second: DVec3) -> f64 {
    first.angle_between(second).to_degrees()
}
