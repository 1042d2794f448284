//! Words for parts of the body in joints' names in other languages than English, and letters that are written in
//! several forms. Names of fingers stand in [`super::names`].

use super::anatomy_names::JointWord;

/// Returns the plain form of a letter: without its accent (umlauts keep theirs), and as wide as in ASCII.
pub(super) fn plain_letter_form(c: char) -> char {
    let wide = |c: char| char::from_u32(u32::from(c) - 0xFEE0).unwrap_or(c);
    match c {
        '\u{FF01}'..='\u{FF5E}' => wide(c),
        'à' | 'â' => 'a',
        'À' | 'Â' => 'A',
        'é' | 'è' | 'ê' | 'ë' => 'e',
        'É' | 'È' | 'Ê' | 'Ë' => 'E',
        'î' | 'ï' => 'i',
        'Î' | 'Ï' => 'I',
        'ô' => 'o',
        'Ô' => 'O',
        'ù' | 'û' => 'u',
        'Ù' | 'Û' => 'U',
        'ç' => 'c',
        'Ç' => 'C',
        c => c,
    }
}

/// Looks up a German, French or Japanese word, in plain lower-case letters.
pub(super) fn find_foreign_word(core: &str, sided: bool) -> Option<JointWord> {
    german(core, sided)
        .or_else(|| find_french_word(core, sided))
        .or_else(|| japanese(core))
}

/// Looks up a German word, with umlauts written as two letters.
fn german(core: &str, sided: bool) -> Option<JointWord> {
    Some(match core {
        "huefte" | "hueftgelenk" if sided => JointWord::SideHip,
        "huefte" | "hueften" => JointWord::Hips,
        "wirbel" | "wirbelsaeule" | "brust" | "brustkorb" | "bauch" | "ruecken" | "oberkoerper" => JointWord::Spine,
        "hals" | "nacken" | "genick" => JointWord::Neck,
        "kopf" | "schaedel" => JointWord::Head,
        "kiefer" | "unterkiefer" => JointWord::Jaw,
        "auge" | "augapfel" => JointWord::Eye,
        "schluesselbein" => JointWord::Clavicle,
        "schulter" => JointWord::Shoulder,
        "oberarm" => JointWord::UpperArm,
        "unterarm" | "ellbogen" | "ellenbogen" => JointWord::Forearm,
        "handgelenk" => JointWord::Wrist,
        "oberschenkel" => JointWord::Thigh,
        "bein" => JointWord::Leg,
        "unterschenkel" | "knie" | "schienbein" => JointWord::Shin,
        "fussgelenk" | "knoechel" | "sprunggelenk" => JointWord::Ankle,
        "fuss" => JointWord::Foot,
        "zehen" | "zehe" | "zeh" | "fussballen" => JointWord::Toes,
        _ => return None,
    })
}

/// Looks up a French word, without accents.
pub(super) fn find_french_word(core: &str, sided: bool) -> Option<JointWord> {
    Some(match core {
        "hanche" if sided => JointWord::SideHip,
        "bassin" | "hanche" | "hanches" => JointWord::Hips,
        "colonne" | "dos" | "poitrine" | "torse" | "tronc" | "buste" | "ventre" => JointWord::Spine,
        "cou" | "nuque" => JointWord::Neck,
        "tete" | "crane" => JointWord::Head,
        "machoire" | "mandibule" => JointWord::Jaw,
        "oeil" | "yeux" => JointWord::Eye,
        "clavicule" => JointWord::Clavicle,
        "epaule" => JointWord::Shoulder,
        "bras" => JointWord::UpperArm,
        "avantbras" | "coude" => JointWord::Forearm,
        "poignet" => JointWord::Wrist,
        // Without a side it is the English word for a node above the others.
        "main" if sided => JointWord::Hand,
        "cuisse" => JointWord::Thigh,
        "jambe" => JointWord::Leg,
        "genou" | "mollet" => JointWord::Shin,
        "cheville" => JointWord::Ankle,
        "pied" => JointWord::Foot,
        "orteil" | "orteils" => JointWord::Toes,
        _ => return None,
    })
}

/// Looks up a Japanese word.
fn japanese(core: &str) -> Option<JointWord> {
    Some(match core {
        "センター" => JointWord::Root,
        "下半身" | "腰" => JointWord::Hips,
        "上半身" | "胸" => JointWord::Spine,
        "首" => JointWord::Neck,
        "頭" => JointWord::Head,
        "顎" | "あご" => JointWord::Jaw,
        "目" => JointWord::Eye,
        "肩" => JointWord::Clavicle,
        "腕" | "上腕" => JointWord::UpperArm,
        "ひじ" | "肘" | "前腕" => JointWord::Forearm,
        "手首" => JointWord::Wrist,
        "手" => JointWord::Hand,
        "もも" | "太もも" => JointWord::Thigh,
        "足" => JointWord::Leg,
        "ひざ" | "膝" | "すね" => JointWord::Shin,
        "足首" => JointWord::Ankle,
        "つま先" | "爪先" => JointWord::Toes,
        _ => return None,
    })
}
