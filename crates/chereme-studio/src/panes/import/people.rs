//! Names of body parts, axes and units for people, and remarks about files.

use chereme_motion::Axes;

use super::data::axes_parts;
use crate::words::{Language, Text, fill, import as words, spoken};

const fn text(en: &'static str, fr: &'static str) -> Text {
    Text::new(en, fr)
}

/// Parts that occur once.
const MIDDLE: [(&str, Text); 6] = [
    ("head", text("head", "tête")),
    ("jaw", text("jaw", "mâchoire")),
    ("neck", text("neck", "cou")),
    ("chest", text("chest", "poitrine")),
    ("spine", text("spine", "colonne vertébrale")),
    ("hips", text("hips", "bassin")),
];

/// Parts that occur on either side: of the right, and of the left.
const SIDES: [(&str, [Text; 2]); 14] = [
    (
        "eye",
        [
            text("right eye", "œil droit"),
            text("left eye", "œil gauche"),
        ],
    ),
    (
        "clavicle",
        [
            text("right collarbone", "clavicule droite"),
            text("left collarbone", "clavicule gauche"),
        ],
    ),
    (
        "upper arm",
        [
            text("right upper arm", "bras droit"),
            text("left upper arm", "bras gauche"),
        ],
    ),
    (
        "forearm",
        [
            text("right forearm", "avant-bras droit"),
            text("left forearm", "avant-bras gauche"),
        ],
    ),
    (
        "hand",
        [
            text("right hand", "main droite"),
            text("left hand", "main gauche"),
        ],
    ),
    (
        "thigh",
        [
            text("right thigh", "cuisse droite"),
            text("left thigh", "cuisse gauche"),
        ],
    ),
    (
        "shin",
        [
            text("right lower leg", "jambe droite"),
            text("left lower leg", "jambe gauche"),
        ],
    ),
    (
        "foot",
        [
            text("right foot", "pied droit"),
            text("left foot", "pied gauche"),
        ],
    ),
    (
        "toes",
        [
            text("right toes", "orteils droits"),
            text("left toes", "orteils gauches"),
        ],
    ),
    (
        "thumb",
        [
            text("right thumb", "pouce droit"),
            text("left thumb", "pouce gauche"),
        ],
    ),
    (
        "index",
        [
            text("right index finger", "index droit"),
            text("left index finger", "index gauche"),
        ],
    ),
    (
        "middle",
        [
            text("right middle finger", "majeur droit"),
            text("left middle finger", "majeur gauche"),
        ],
    ),
    (
        "ring",
        [
            text("right ring finger", "annulaire droit"),
            text("left ring finger", "annulaire gauche"),
        ],
    ),
    (
        "little",
        [
            text("right little finger", "auriculaire droit"),
            text("left little finger", "auriculaire gauche"),
        ],
    ),
];

/// The joints of a finger, from the wrist on.
const JOINTS: [(&str, Text); 4] = [
    ("metacarpal", text("inside the palm", "dans la paume")),
    ("base", text("first joint", "première articulation")),
    ("middle", text("middle joint", "articulation du milieu")),
    ("end", text("last joint", "dernière articulation")),
];

/// Returns the name of a part of the body, such as `right middle middle`; any other text is returned unchanged.
pub(in crate::panes) fn part(name: &str, language: Language) -> String {
    let of = |all: &[(&str, Text)], name: &str| {
        let found = all.iter().find(|(it, _)| *it == name)?;
        Some(found.1.of(language))
    };
    if let Some(found) = of(&MIDDLE, name) {
        return found.to_owned();
    }
    let sided = || {
        let (side, rest) = name.split_once(' ')?;
        let side = ["right", "left"].iter().position(|it| *it == side)?;
        let named = |rest: &str| {
            let found = SIDES.iter().find(|(it, _)| *it == rest)?;
            Some(found.1[side].of(language))
        };
        if let Some(found) = named(rest) {
            return Some(found.to_owned());
        }
        let (finger, joint) = rest.rsplit_once(' ')?;
        Some(format!("{}, {}", named(finger)?, of(&JOINTS, joint)?))
    };
    sided().unwrap_or_else(|| name.to_owned())
}

/// Returns a sentence about the axes of a file that point up and to the signer's left.
pub(in crate::panes) fn axes(axes: Axes, language: Language) -> String {
    let axis = |axis: &str| {
        let name = axis.trim_start_matches(['+', '-']);
        let text = if axis.starts_with('-') {
            words::AXIS_REVERSED
        } else {
            words::AXIS
        };
        fill(text.of(language), &[("axis", &name)])
    };
    let [up, left] = axes_parts(axes);
    let (up, left) = (axis(&up), axis(&left));
    fill(
        words::AXES_ARE.of(language),
        &[("up", &up), ("left", &left)],
    )
}

/// Returns the name of a unit of length, if it has one.
pub(super) fn unit(name: &str, language: Language) -> Option<&'static str> {
    let text = match name {
        "m" => words::METRES,
        "cm" => words::CENTIMETRES,
        "mm" => words::MILLIMETRES,
        "in" | "inch" | "inches" => words::INCHES,
        "as given" => words::AS_CHOSEN,
        "unknown" => words::NOT_KNOWN,
        _ => return None,
    };
    Some(text.of(language))
}

/// Returns a remark of the corpus about a file, with names of body parts for people; the usual remarks about captured
/// files are translated.
pub(super) fn remark(message: &str, language: Language) -> String {
    if let Some(list) = message.strip_prefix("not found in the skeleton: ") {
        let (list, more) = match list.split_once(" and ") {
            Some((list, more)) => (list, more.trim_end_matches(" more")),
            None => (list, ""),
        };
        let parts: Vec<String> = list.split(", ").map(|it| part(it, language)).collect();
        let parts = parts.join(" · ");
        let text = if more.is_empty() {
            words::PARTS_NOT_FOUND
        } else {
            words::MORE_PARTS_NOT_FOUND
        };
        return fill(text.of(language), &[("parts", &parts), ("n", &more)]);
    }
    let taken = message.strip_suffix("; other joints could be it");
    if let Some((name, joint)) = taken.and_then(|it| it.split_once(" was taken to be ")) {
        let name = part(name, language);
        let joint = joint.trim_matches('"');
        return fill(
            words::OTHER_JOINTS.of(language),
            &[("part", &name), ("joint", &joint)],
        );
    }
    spoken(message, language)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::anatomy::Part;

    #[test]
    fn every_part_has_a_name_of_its_own_in_both_languages() {
        for language in [Language::English, Language::French] {
            let mut all: Vec<String> = Part::all()
                .iter()
                .map(|it| part(&it.to_string(), language))
                .collect();
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), count, "no two are called alike");
        }
        for it in Part::all() {
            let name = it.to_string();
            assert_ne!(part(&name, Language::French), name);
        }
        assert_eq!(
            part("right middle middle", Language::English),
            "right middle finger, middle joint"
        );
        assert_eq!(
            part("left thumb end", Language::French),
            "pouce gauche, dernière articulation"
        );
        assert_eq!(part("tail", Language::French), "tail");
    }

    #[test]
    fn axes_are_described_by_a_sentence() {
        let said = |text: &str, language| axes(text.parse().expect("axes"), language);
        assert_eq!(
            said("+Y,+X", Language::English),
            "up is the file's Y axis, and the signer's left is its X axis"
        );
        assert_eq!(
            said("+Z,-X", Language::French),
            "le haut est l’axe Z du fichier, la gauche du signeur l’axe X inversé"
        );
    }

    #[test]
    fn remarks_name_parts_in_everyday_words() {
        for (message, english, french) in [
            (
                "not found in the skeleton: jaw, right middle base and 3 more",
                "Not found among the joints: jaw · right middle finger, first joint, and 3 more",
                "Introuvable parmi les articulations : mâchoire · majeur droit, première articulation, et 3 autres",
            ),
            (
                "not found in the skeleton: neck",
                "Not found among the joints: neck",
                "Introuvable parmi les articulations : cou",
            ),
            (
                "neck was taken to be \"NS:C7\"; other joints could be it",
                "neck was taken to be NS:C7; other joints could be it",
                "cou : pris pour NS:C7 ; d’autres articulations pourraient l’être",
            ),
            ("x", "x", "x"),
        ] {
            assert_eq!(remark(message, Language::English), english);
            assert_eq!(remark(message, Language::French), french);
        }
    }
}
