//! Names of body parts, axes and units for people, and remarks about files.

use chereme_motion::SignerAxes;
use chereme_sign::words::folders::phrase_text;

use super::import_data::axes_parts;
use crate::words::{InterfaceLanguage, fill_text_braces, import_words as words, translate_library_message};

/// Returns the name of a part of the body, such as `right middle middle`; any other text is returned unchanged.
pub(in crate::panes) fn body_part_name(name: &str, language: InterfaceLanguage) -> String {
    let named_part = |part: &str| phrase_text(&format!("body-part-{}", part.replace(' ', "-")), language);
    let finger_joint = || {
        let (finger, joint) = name.rsplit_once(' ')?;
        let joint = phrase_text(&format!("finger-joint-{joint}"), language)?;
        Some(format!("{}, {joint}", named_part(finger)?))
    };
    let known_part = named_part(name).map(str::to_owned).or_else(finger_joint);
    known_part.unwrap_or_else(|| name.to_owned())
}

/// Returns a sentence about the axes of a file that point up and to the signer's left.
pub(in crate::panes) fn axes_sentence(axes: SignerAxes, language: InterfaceLanguage) -> String {
    let axis = |axis: &str| {
        let name = axis.trim_start_matches(['+', '-']);
        let text = if axis.starts_with('-') {
            words::AXIS_REVERSED
        } else {
            words::AXIS
        };
        fill_text_braces(text.text_in_language(language), &[("axis", &name)])
    };
    let [up, left] = axes_parts(axes);
    let (up, left) = (axis(&up), axis(&left));
    fill_text_braces(
        words::AXES_ARE.text_in_language(language),
        &[("up", &up), ("left", &left)],
    )
}

/// Returns the name of a unit of length, if it has one.
pub(super) fn length_unit_name(name: &str, language: InterfaceLanguage) -> Option<&'static str> {
    let text = match name {
        "m" => words::METRES,
        "cm" => words::CENTIMETRES,
        "mm" => words::MILLIMETRES,
        "in" | "inch" | "inches" => words::INCHES,
        "as given" => words::AS_CHOSEN,
        "unknown" => words::NOT_KNOWN,
        _ => return None,
    };
    Some(text.text_in_language(language))
}

/// Returns a remark of the corpus about a file, with names of body parts for people; the usual remarks about captured
/// files are translated.
pub(super) fn translate_import_remark(message: &str, language: InterfaceLanguage) -> String {
    if let Some(list) = message.strip_prefix("not found in the skeleton: ") {
        let (list, more) = match list.split_once(" and ") {
            Some((list, more)) => (list, more.trim_end_matches(" more")),
            None => (list, ""),
        };
        let part_names: Vec<String> = list.split(", ").map(|name| body_part_name(name, language)).collect();
        let parts = part_names.join(" · ");
        let text = if more.is_empty() {
            words::PARTS_NOT_FOUND
        } else {
            words::MORE_PARTS_NOT_FOUND
        };
        return fill_text_braces(text.text_in_language(language), &[("parts", &parts), ("n", &more)]);
    }
    let taken = message.strip_suffix("; other joints could be it");
    if let Some((name, joint)) = taken.and_then(|clause| clause.split_once(" was taken to be ")) {
        let name = body_part_name(name, language);
        let joint = joint.trim_matches('"');
        return fill_text_braces(
            words::OTHER_JOINTS.text_in_language(language),
            &[("part", &name), ("joint", &joint)],
        );
    }
    translate_library_message(message, language)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::anatomy::BodyPart;

    #[test]
    fn every_part_has_a_name_of_its_own_in_both_languages() {
        for language in [InterfaceLanguage::English, InterfaceLanguage::French] {
            let mut all: Vec<String> = BodyPart::all_body_parts()
                .iter()
                .map(|it| body_part_name(&it.to_string(), language))
                .collect();
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), count, "no two are called alike");
        }
        for it in BodyPart::all_body_parts() {
            let name = it.to_string();
            assert_ne!(body_part_name(&name, InterfaceLanguage::French), name);
        }
        assert_eq!(
            body_part_name("right middle middle", InterfaceLanguage::English),
            "right middle finger, middle joint"
        );
        assert_eq!(
            body_part_name("left thumb end", InterfaceLanguage::French),
            "pouce gauche, dernière articulation"
        );
        assert_eq!(body_part_name("tail", InterfaceLanguage::French), "tail");
    }

    #[test]
    fn axes_are_described_by_a_sentence() {
        let said = |text: &str, language| axes_sentence(text.parse().expect("axes"), language);
        assert_eq!(
            said("+Y,+X", InterfaceLanguage::English),
            "up is the file's Y axis, and the signer's left is its X axis"
        );
        assert_eq!(
            said("+Z,-X", InterfaceLanguage::French),
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
            assert_eq!(translate_import_remark(message, InterfaceLanguage::English), english);
            assert_eq!(translate_import_remark(message, InterfaceLanguage::French), french);
        }
    }
}
