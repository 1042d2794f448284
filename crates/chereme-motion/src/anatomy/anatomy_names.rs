//! The meaning of a joint's name, across the naming conventions in use.
//!
//! Splits a name into words at separators, digits and capitals, removes words for the side, the rig's prefix and
//! fillers, and looks up the rest in one table.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::languages::{self, plain_letter_form};
use crate::hand::{BodySide, HandFinger};

/// The meaning of a joint's name. `Shoulder`, `SideHip`, `Leg`, `Foot` and `Hand` mean different joints in
/// different conventions; the other joints' names decide which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JointWord {
    Root,
    Hips,
    Spine,
    Neck,
    Head,
    Jaw,
    Eye,
    Clavicle,
    Shoulder,
    UpperArm,
    Forearm,
    Wrist,
    Hand,
    Digit(AnatomyDigit, DigitSegment),
    SideHip,
    Thigh,
    Leg,
    Shin,
    Ankle,
    Foot,
    Toes,
}

impl JointWord {
    /// Returns whether such a joint exists on each side.
    pub(super) fn is_sided_word(self) -> bool {
        !matches!(
            self,
            Self::Root | Self::Hips | Self::Spine | Self::Neck | Self::Head | Self::Jaw
        )
    }
}

/// The thumb or one of the fingers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum AnatomyDigit {
    Thumb,
    Finger(HandFinger),
}

impl AnatomyDigit {
    pub(super) const ALL_ANATOMY_DIGITS: [Self; 5] = [
        Self::Thumb,
        Self::Finger(HandFinger::Index),
        Self::Finger(HandFinger::Middle),
        Self::Finger(HandFinger::Ring),
        Self::Finger(HandFinger::Little),
    ];
}

/// The bone of a digit that a name describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DigitSegment {
    Metacarpal,
    Proximal,
    Intermediate,
    Distal,
    Number(u32),
    Unsaid,
}

/// The meaning of one name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct JointLabel {
    pub(super) side: Option<BodySide>,
    pub(super) word: JointWord,
}

/// Habits that the names of one skeleton share.
#[derive(Debug, Clone, Copy, Default)]
struct NamingHabits {
    /// Whether digits are numbered from 0, the thumb, rather than from 1.
    from_zero: bool,
    /// Whether the letters G and D are the sides (*gauche*, *droite*), since the words beside them are French.
    french: bool,
}

/// Returns the meaning of each name of a skeleton; `None` for an unknown name.
pub(super) fn read_all(names: &[&str]) -> Vec<Option<JointLabel>> {
    let mut bare: Vec<&str> = names.iter().map(|name| without_rig(name)).collect();
    // A character's name may have several words, and stand before the prefix of a rig.
    for _ in 0..4 {
        let prefix = common_prefix(&bare);
        if prefix.is_empty() {
            break;
        }
        bare = bare
            .iter()
            .map(|name| without_rig(name.strip_prefix(prefix).unwrap_or(name)))
            .collect();
    }
    let split: Vec<Vec<String>> = bare.iter().map(|name| split_joint_name(name)).collect();
    let has = |words: &[String], word: &str| words.iter().any(|other| other == word);
    let counts = |words: &&Vec<String>| has(words, "finger") && has(words, "0");
    let french = |words: &&Vec<String>| {
        let is_core = |word: &&String| !matches!(word.as_str(), "g" | "d") && !starts_number(word);
        let core: String = words.iter().filter(is_core).map(String::as_str).collect();
        (has(words, "g") || has(words, "d")) && languages::find_french_word(&core, true).is_some()
    };
    let habits = NamingHabits {
        from_zero: split.iter().any(|words| counts(&words)),
        french: split.iter().filter(french).count() > 1,
    };
    bare.iter().map(|name| parse_joint_label(name, habits)).collect()
}

/// Returns the side that a name states, whatever the rest of it means.
pub(super) fn stated_side(name: &str) -> Option<BodySide> {
    let words = split_joint_name(without_rig(name));
    let mut sides = words.iter().filter_map(|word| parse_side_word(word));
    let first = sides.next()?;
    sides.all(|side| side == first).then_some(first)
}

fn starts_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit())
}

/// Removes namespaces and the prefixes of well-known rigs.
pub(super) fn without_rig(name: &str) -> &str {
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    for rig in [
        "mixamorig",
        "Character1_",
        "Bip001",
        "Bip01",
        "J_Bip_C_",
        "J_Bip_",
        "J_Adj_",
    ] {
        let cut = name.get(..rig.len()).filter(|head| head.eq_ignore_ascii_case(rig));
        if cut.is_some() && name.len() > rig.len() {
            let rest = &name[rig.len()..];
            let digits = rest.trim_start_matches(|c: char| c.is_ascii_digit());
            let rest = if rig == "mixamorig" { digits } else { rest };
            return rest.trim_start_matches(['_', ' ', '-']);
        }
    }
    name
}

/// Returns the leading word that four of five joints share, with its separator: a character's name.
fn common_prefix<'a>(names: &[&'a str]) -> &'a str {
    let name_head = |name: &'a str| {
        let end = name.find(['_', '-', '.', ' '])?;
        let head = &name[..=end];
        let head_words = split_joint_name(head);
        let plain = head_words.iter().all(|word| parse_side_word(word).is_none());
        let is_label = parse_joint_label(head, NamingHabits::default()).is_some();
        (plain && !is_label && name.len() > head.len()).then_some(head)
    };
    let mut heads: BTreeMap<&str, usize> = BTreeMap::new();
    for head in names.iter().filter_map(|name| name_head(name)) {
        *heads.entry(head).or_default() += 1;
    }
    match heads.into_iter().max_by_key(|&(_, count)| count) {
        Some((head, count)) if count > 1 && count * 5 >= names.len() * 4 => head,
        _ => "",
    }
}

/// Splits a name into lower-case words at separators, between letters and digits, and at capitals. Umlauts become two
/// letters, in whichever of their two forms they are written: `hüfte` is `huefte`. Other accents are removed, and
/// wide letters and digits become plain ones.
fn split_joint_name(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let letters: Vec<char> = name.chars().map(plain_letter_form).collect();
    for (i, &c) in letters.iter().enumerate() {
        if c == '\u{308}' {
            words.last_mut().into_iter().for_each(|word| word.push('e'));
            continue;
        }
        if matches!(c, '\u{300}'..='\u{36f}') {
            continue;
        }
        if !c.is_alphanumeric() {
            words.push(String::new());
            continue;
        }
        let before = i.checked_sub(1).map(|at| letters[at]);
        let next_lower = letters.get(i + 1).is_some_and(|c| c.is_lowercase());
        let starts = before.is_some_and(|b| {
            (b.is_numeric() != c.is_numeric()) || (c.is_uppercase() && (b.is_lowercase() || next_lower))
        });
        if starts {
            words.push(String::new());
        }
        let word = words.last_mut();
        if let Some(word) = word {
            match c {
                'ä' | 'Ä' => word.push_str("ae"),
                'ö' | 'Ö' => word.push_str("oe"),
                'ü' | 'Ü' => word.push_str("ue"),
                'ß' | 'ẞ' => word.push_str("ss"),
                'œ' | 'Œ' => word.push_str("oe"),
                c => word.extend(c.to_lowercase()),
            }
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

fn parse_side_word(word: &str) -> Option<BodySide> {
    match word {
        "l" | "left" | "lft" | "lf" | "links" | "linke" | "linker" | "linkes" | "gauche" => Some(BodySide::Left),
        "r" | "right" | "rgt" | "rt" | "rechts" | "rechte" | "rechter" | "rechtes" | "droit" | "droite" => {
            Some(BodySide::Right)
        }
        _ => None,
    }
}

/// Words that mark a joint as a helper, regardless of the other words in its name.
const HELPER_JOINT_WORDS: [&str; 25] = [
    "twist",
    "roll",
    "ik",
    "fk",
    "pole",
    "ctrl",
    "control",
    "end",
    "nub",
    "tip",
    "top",
    "helper",
    "target",
    "aux",
    "site",
    "lid",
    "brow",
    "socket",
    "weapon",
    "prop",
    "effector",
    "leaf",
    "null",
    "lash",
    "correctiveroot",
];

/// Words without a meaning.
const FILLER_JOINT_WORDS: [&str; 15] = [
    "joint", "jnt", "bone", "def", "org", "mch", "bip", "bend", "smplhf", "c", "center", "b", "m", "x", "stretch",
];

/// Returns the meaning of one name.
fn parse_joint_label(name: &str, habits: NamingHabits) -> Option<JointLabel> {
    let all = split_joint_name(&with_forearm(name));
    if let [letter, number] = all.as_slice()
        && matches!(letter.as_str(), "l" | "t" | "c")
        && number.chars().all(|c| c.is_ascii_digit())
        && name.starts_with(|c: char| c.is_uppercase())
    {
        let word = if letter == "c" {
            JointWord::Neck
        } else {
            JointWord::Spine
        };
        return Some(JointLabel { side: None, word });
    }
    if all.iter().any(|word| HELPER_JOINT_WORDS.contains(&word.as_str())) {
        return None;
    }
    let numbers: Vec<&str> = all
        .iter()
        .filter(|word| starts_number(word))
        .map(String::as_str)
        .collect();
    let sides = |word: &str| match word {
        "g" if habits.french => Some(BodySide::Left),
        "d" if habits.french => Some(BodySide::Right),
        _ => parse_side_word(word),
    };
    let mut given_side = None;
    let mut core = String::new();
    for word in &all {
        if numbers.contains(&word.as_str()) || FILLER_JOINT_WORDS.contains(&word.as_str()) {
            continue;
        }
        match sides(word) {
            Some(side) if given_side.is_none() => given_side = Some(side),
            Some(_) => return None,
            None => core.push_str(word),
        }
    }
    let (found, core) = merged_side(given_side, &core, &numbers, habits);
    let word = find_joint_word(core, found.is_some(), &numbers, habits)?;
    Some(JointLabel { side: found, word })
}

/// Writes out the forearm of Motive's names, `LFArm` and `RFArm`: as words they would read like `lf_arm`, a left arm.
fn with_forearm(name: &str) -> Cow<'_, str> {
    match name.strip_suffix("FArm") {
        Some(side @ ("L" | "R")) => Cow::Owned(format!("{side}Forearm")),
        _ => Cow::Borrowed(name),
    }
}

/// Finds the side in names without separators or capitals: `lhumerus`, `leftupperarm`, `左腕`.
fn merged_side<'a>(
    found: Option<BodySide>,
    core: &'a str,
    numbers: &[&str],
    habits: NamingHabits,
) -> (Option<BodySide>, &'a str) {
    if found.is_some() || find_joint_word(core, false, numbers, habits).is_some() {
        return (found, core);
    }
    for (head, side) in [
        ("left", BodySide::Left),
        ("right", BodySide::Right),
        ("links", BodySide::Left),
        ("rechts", BodySide::Right),
        ("左", BodySide::Left),
        ("右", BodySide::Right),
        ("l", BodySide::Left),
        ("r", BodySide::Right),
    ] {
        if let Some(rest) = core.strip_prefix(head)
            && find_joint_word(rest, true, numbers, habits).is_some_and(JointWord::is_sided_word)
        {
            return (Some(side), rest);
        }
    }
    (found, core)
}

fn find_joint_word(core: &str, sided: bool, numbers: &[&str], habits: NamingHabits) -> Option<JointWord> {
    Some(match core {
        "root" => JointWord::Root,
        "hip" if sided => JointWord::SideHip,
        "pelvis" | "hips" if sided => return None,
        "hips" | "hip" | "pelvis" | "hara" | "becken" => JointWord::Hips,
        "spine" | "spinelower" | "spineupper" | "spinemid" | "lowerback" | "upperback" | "back" | "abdomen"
        | "abdomenlower" | "abdomenupper" | "ab" | "torso" | "lowertorso" | "uppertorso" | "waist" | "chest"
        | "chestlower" | "chestupper" | "upperchest" | "lowerchest" | "thorax" | "ribs" | "ribcage" | "stomach"
        | "belly" | "sternum" => JointWord::Spine,
        "neck" | "lowerneck" | "upperneck" | "necklower" | "neckupper" => JointWord::Neck,
        "head" | "skull" => JointWord::Head,
        "jaw" | "mandible" | "lowerjaw" => JointWord::Jaw,
        "eye" | "eyeball" | "faceeye" => JointWord::Eye,
        "clavicle" | "collar" | "clav" | "collarbone" | "clavicula" => JointWord::Clavicle,
        "shoulder" | "shldr" | "shldrs" | "shld" => JointWord::Shoulder,
        "upperarm" | "uparm" | "arm" | "humerus" | "armupper" | "uarm" | "bicep" => JointWord::UpperArm,
        "forearm" | "lowerarm" | "lowarm" | "elbow" | "radius" | "armlower" | "ulna" => JointWord::Forearm,
        "wrist" | "handwrist" => JointWord::Wrist,
        "hand" | "carpus" => JointWord::Hand,
        "thigh" | "upleg" | "upperleg" | "femur" | "legupper" => JointWord::Thigh,
        "leg" => JointWord::Leg,
        "shin" | "lowleg" | "lowerleg" | "calf" | "knee" | "tibia" | "leglower" => JointWord::Shin,
        "ankle" | "footankle" => JointWord::Ankle,
        "foot" | "feet" => JointWord::Foot,
        "toe" | "toes" | "toebase" | "ball" | "football" | "toebone" => JointWord::Toes,
        _ => {
            return languages::find_foreign_word(core, sided)
                .or_else(|| parse_digit_word(core, numbers, habits.from_zero));
        }
    })
}

const DIGIT_NAME_WORDS: [(&str, AnatomyDigit); 31] = [
    ("thumb", AnatomyDigit::Thumb),
    ("index", AnatomyDigit::Finger(HandFinger::Index)),
    ("pointer", AnatomyDigit::Finger(HandFinger::Index)),
    ("middle", AnatomyDigit::Finger(HandFinger::Middle)),
    ("mid", AnatomyDigit::Finger(HandFinger::Middle)),
    ("ring", AnatomyDigit::Finger(HandFinger::Ring)),
    ("pinky", AnatomyDigit::Finger(HandFinger::Little)),
    ("pinkie", AnatomyDigit::Finger(HandFinger::Little)),
    ("little", AnatomyDigit::Finger(HandFinger::Little)),
    ("first", AnatomyDigit::Thumb),
    ("second", AnatomyDigit::Finger(HandFinger::Index)),
    ("third", AnatomyDigit::Finger(HandFinger::Middle)),
    ("fourth", AnatomyDigit::Finger(HandFinger::Ring)),
    ("fifth", AnatomyDigit::Finger(HandFinger::Little)),
    ("daumen", AnatomyDigit::Thumb),
    ("zeige", AnatomyDigit::Finger(HandFinger::Index)),
    ("mittel", AnatomyDigit::Finger(HandFinger::Middle)),
    ("kleiner", AnatomyDigit::Finger(HandFinger::Little)),
    ("kleine", AnatomyDigit::Finger(HandFinger::Little)),
    ("klein", AnatomyDigit::Finger(HandFinger::Little)),
    ("pouce", AnatomyDigit::Thumb),
    ("majeur", AnatomyDigit::Finger(HandFinger::Middle)),
    ("annulaire", AnatomyDigit::Finger(HandFinger::Ring)),
    ("auriculaire", AnatomyDigit::Finger(HandFinger::Little)),
    ("親指", AnatomyDigit::Thumb),
    ("人指", AnatomyDigit::Finger(HandFinger::Index)),
    ("人差指", AnatomyDigit::Finger(HandFinger::Index)),
    ("人差し指", AnatomyDigit::Finger(HandFinger::Index)),
    ("中指", AnatomyDigit::Finger(HandFinger::Middle)),
    ("薬指", AnatomyDigit::Finger(HandFinger::Ring)),
    ("小指", AnatomyDigit::Finger(HandFinger::Little)),
];

fn parse_digit_word(core: &str, numbers: &[&str], from_zero: bool) -> Option<JointWord> {
    if let Some(rest) = ["finger", "digit"].iter().find_map(|prefix| core.strip_prefix(prefix)) {
        return numbered_finger(rest, numbers, from_zero);
    }
    let inside = core.starts_with("inhand");
    let heads = ["inhand", "hand", "main", "doigt", "f"].iter();
    let bare = heads
        .filter_map(|head| core.strip_prefix(head))
        .find(|rest| DIGIT_NAME_WORDS.iter().any(|(name, _)| rest.starts_with(name)));
    let core = bare.unwrap_or(core);
    if matches!(core, "palm" | "carpal" | "metacarpal") {
        let n: usize = numbers.first()?.parse().ok()?;
        let digit = *AnatomyDigit::ALL_ANATOMY_DIGITS.get(n)?;
        return Some(JointWord::Digit(digit, DigitSegment::Metacarpal));
    }
    let (name, digit) = DIGIT_NAME_WORDS.iter().find(|(name, _)| core.starts_with(name))?;
    let number = numbers.first().and_then(|n| n.parse().ok());
    let read_segment = segment(&core[name.len()..], number)?;
    let segment = if inside { DigitSegment::Metacarpal } else { read_segment };
    Some(JointWord::Digit(*digit, segment))
}

fn segment(rest: &str, number: Option<u32>) -> Option<DigitSegment> {
    Some(match rest.strip_prefix("finger").unwrap_or(rest) {
        "" => number.map_or(DigitSegment::Unsaid, DigitSegment::Number),
        // Segments are also counted by letters; of these, `b` and `c` are fillers.
        "a" => DigitSegment::Number(1),
        "metacarpal" | "mc" | "meta" | "carpal" | "cmc" => DigitSegment::Metacarpal,
        "proximal" | "pp" | "prox" | "mcp" | "grundglied" => DigitSegment::Proximal,
        "intermediate" | "medial" | "mp" | "inter" | "med" | "pip" | "mittelglied" => DigitSegment::Intermediate,
        "distal" | "dp" | "dist" | "dip" | "ip" | "endglied" => DigitSegment::Distal,
        _ => return None,
    })
}

/// Reads `Finger2Medial`, `Finger12` (finger 1, bone 2) and `finger_2_1`.
fn numbered_finger(rest: &str, numbers: &[&str], from_zero: bool) -> Option<JointWord> {
    let (first, more) = (numbers.first()?, numbers.get(1));
    let finger = first.get(..1)?.parse::<usize>().ok()?;
    let place = if from_zero { finger } else { finger.checked_sub(1)? };
    let digit = *AnatomyDigit::ALL_ANATOMY_DIGITS.get(place)?;
    let bone = match (more, first.get(1..)) {
        (Some(more), _) => more.parse().ok()?,
        (None, Some(bone)) if !bone.is_empty() => bone.parse::<u32>().ok()? + 1,
        _ => 1,
    };
    Some(JointWord::Digit(digit, segment(rest, Some(bone))?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn say(name: &str) -> String {
        match read_all(&[name])[0] {
            None => "-".to_owned(),
            Some(JointLabel { side, word }) => {
                let side = side.map_or("", BodySide::body_side_name);
                format!("{side} {word:?}").trim().to_owned()
            }
        }
    }

    #[test]
    fn prefixes_of_rigs_are_removed_with_the_number_of_the_copy() {
        for (name, bare) in [
            ("mixamorig:Hips", "Hips"),
            ("mixamorig12Hips", "Hips"),
            ("mixamorig3_Hips", "Hips"),
            ("Character1_Hips", "Hips"),
            ("Bip01 Pelvis", "Pelvis"),
            ("Bip001-Pelvis", "Pelvis"),
            ("bip001_L_Hand", "L_Hand"),
            ("J_Bip_C_Hips", "Hips"),
            // Only copies of a Mixamo rig are numbered: elsewhere digits belong to the name.
            ("J_Adj_2nd", "2nd"),
            ("Bip01 3", "3"),
            ("scene|Hips", "Hips"),
            ("Hips", "Hips"),
            ("mixamorig", "mixamorig"),
        ] {
            assert_eq!(without_rig(name), bare, "{name}");
        }
    }

    #[test]
    fn joint_names_of_many_conventions_are_understood() {
        let index = "left Digit(Finger(Index), ";
        for (name, want) in [
            ("mixamorig:LeftForeArm", "left Forearm".to_owned()),
            ("mixamorig9:RightHand", "right Hand".into()),
            ("mixamorig_RightUpLeg", "right Thigh".into()),
            ("mixamorigLeftHandIndex1", format!("{index}Number(1))")),
            ("mixamorig:HeadTop_End", "-".into()),
            ("lhumerus", "left UpperArm".into()),
            ("rradius", "right Forearm".into()),
            ("lwrist", "left Wrist".into()),
            ("LHipJoint", "left SideHip".into()),
            ("LeftInHandIndex", format!("{index}Metacarpal)")),
            ("L5", "Spine".into()),
            ("T12", "Spine".into()),
            ("f_index.01.L", format!("{index}Number(1))")),
            ("upper_arm.L", "left UpperArm".into()),
            ("palm.01.L", format!("{index}Metacarpal)")),
            ("DEF-forearm.R", "right Forearm".into()),
            ("leftIndexIntermediate", format!("{index}Intermediate)")),
            ("J_Bip_L_UpperArm", "left UpperArm".into()),
            ("J_Bip_C_UpperChest", "Spine".into()),
            ("upperarm_l", "left UpperArm".into()),
            ("upperarm_twist_01_l", "-".into()),
            ("index_metacarpal_l", format!("{index}Metacarpal)")),
            ("left_index1", format!("{index}Number(1))")),
            ("left_eye_smplhf", "left Eye".into()),
            ("rShldr", "right Shoulder".into()),
            ("lMid2", "left Digit(Finger(Middle), Number(2))".into()),
            ("Upperarm_R", "right UpperArm".into()),
            ("Pelvis_R", "-".into()),
            ("LeftFinger2Medial", format!("{index}Intermediate)")),
            ("LeftSecondPP", format!("{index}Proximal)")),
            ("Bip01 L Finger12", "left Digit(Thumb, Number(3))".into()),
            ("LFingers", "-".into()),
            ("LThumb", "left Digit(Thumb, Unsaid)".into()),
            ("Root", "Root".into()),
            ("base", "-".into()),
            ("", "-".into()),
            ("箱", "-".into()),
            ("手", "Hand".into()),
            ("左手首", "left Wrist".into()),
            ("右人指１", "right Digit(Finger(Index), Number(1))".into()),
            ("Épaule Gauche", "left Shoulder".into()),
            ("E\u{301}pauleDroite", "right Shoulder".into()),
            ("AvantBrasDroit", "right Forearm".into()),
            ("MainGaucheMajeur2", "left Digit(Finger(Middle), Number(2))".into()),
            ("main", "-".into()),
            ("mWristLeft", "left Wrist".into()),
            ("arm_stretch.l", "left UpperArm".into()),
            ("Root_M", "Root".into()),
            ("root.x", "Root".into()),
            ("Left_Index_MCP", format!("{index}Proximal)")),
            ("LeftIndexDIP", format!("{index}Distal)")),
            ("L_index_a", format!("{index}Number(1))")),
            ("LeftDigit2Metacarpal", format!("{index}Metacarpal)")),
            ("LFArm", "left Forearm".into()),
            ("RFArm", "right Forearm".into()),
            ("LUArm", "left UpperArm".into()),
            ("lf_arm", "left UpperArm".into()),
            ("Lf_Arm", "left UpperArm".into()),
            ("LFoot", "left Foot".into()),
            ("LIndex1", format!("{index}Number(1))")),
            ("Hüfte", "Hips".into()),
            ("linke Hüfte", "left SideHip".into()),
            ("Hu\u{308}fte.R", "right SideHip".into()),
            ("Wirbelsäule2", "Spine".into()),
            ("Fuß.L", "left Foot".into()),
            ("FUSS_R", "right Foot".into()),
            ("OberarmLinks", "left UpperArm".into()),
            ("linksUnterarm", "left Forearm".into()),
            ("Zeigefinger1.L", format!("{index}Number(1))")),
            ("Zeigefinger Mittelglied links", format!("{index}Intermediate)")),
            ("KleinerFinger2.R", "right Digit(Finger(Little), Number(2))".into()),
        ] {
            assert_eq!(say(name), want, "{name}");
        }
    }

    #[test]
    fn a_character_prefix_is_ignored() {
        // Of one word, of two, with a number, with a letter, and before the prefix of a rig.
        for prefix in ["Anna_", "CC_Base_", "Skeleton 001_", "f_avg_", "Mod.Bip01_"] {
            let names = ["Hips", "Spine", "LeftForearm", "Head"].map(|name| format!("{prefix}{name}"));
            let mut names: Vec<&str> = names.iter().map(String::as_str).collect();
            names.insert(0, "Armature");
            let words: Vec<_> = read_all(&names)
                .into_iter()
                .skip(1)
                .map(|l| l.map(|l| l.word))
                .collect();
            let want = [JointWord::Hips, JointWord::Spine, JointWord::Forearm, JointWord::Head].map(Some);
            assert_eq!(words, want, "{prefix}");
        }
    }

    #[test]
    fn letters_are_sides_beside_french_words() {
        let sides = |names: &[&str]| {
            let labels = read_all(names).into_iter();
            labels.map(|label| label?.side).collect::<Vec<_>>()
        };
        let (left, right) = (Some(BodySide::Left), Some(BodySide::Right));
        let french = ["Bras_G", "AvantBras_D", "Index1_G", "Pouce2_D", "Cou"];
        assert_eq!(sides(&french), [left, right, left, right, None]);
        assert_eq!(sides(&["Arm_D", "Index1_G", "Bras_G"]), [None; 3]);
    }
}
