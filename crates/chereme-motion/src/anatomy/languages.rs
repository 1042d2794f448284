//! Words for parts of the body in joints' names in other languages than English, and letters that are written in
//! several forms. Names of fingers stand in [`super::names`].

use super::names::Word;

/// Returns the plain form of a letter: without its accent (umlauts keep theirs), and as wide as in ASCII.
pub(super) fn plain(c: char) -> char {
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
pub(super) fn lookup(core: &str, sided: bool) -> Option<Word> {
    german(core, sided)
        .or_else(|| french(core, sided))
        .or_else(|| japanese(core))
}

/// Looks up a German word, with umlauts written as two letters.
fn german(core: &str, sided: bool) -> Option<Word> {
    Some(match core {
        "huefte" | "hueftgelenk" if sided => Word::SideHip,
        "huefte" | "hueften" => Word::Hips,
        "wirbel" | "wirbelsaeule" | "brust" | "brustkorb" | "bauch" | "ruecken" | "oberkoerper" => {
            Word::Spine
        }
        "hals" | "nacken" | "genick" => Word::Neck,
        "kopf" | "schaedel" => Word::Head,
        "kiefer" | "unterkiefer" => Word::Jaw,
        "auge" | "augapfel" => Word::Eye,
        "schluesselbein" => Word::Clavicle,
        "schulter" => Word::Shoulder,
        "oberarm" => Word::UpperArm,
        "unterarm" | "ellbogen" | "ellenbogen" => Word::Forearm,
        "handgelenk" => Word::Wrist,
        "oberschenkel" => Word::Thigh,
        "bein" => Word::Leg,
        "unterschenkel" | "knie" | "schienbein" => Word::Shin,
        "fussgelenk" | "knoechel" | "sprunggelenk" => Word::Ankle,
        "fuss" => Word::Foot,
        "zehen" | "zehe" | "zeh" | "fussballen" => Word::Toes,
        _ => return None,
    })
}

/// Looks up a French word, without accents.
pub(super) fn french(core: &str, sided: bool) -> Option<Word> {
    Some(match core {
        "hanche" if sided => Word::SideHip,
        "bassin" | "hanche" | "hanches" => Word::Hips,
        "colonne" | "dos" | "poitrine" | "torse" | "tronc" | "buste" | "ventre" => Word::Spine,
        "cou" | "nuque" => Word::Neck,
        "tete" | "crane" => Word::Head,
        "machoire" | "mandibule" => Word::Jaw,
        "oeil" | "yeux" => Word::Eye,
        "clavicule" => Word::Clavicle,
        "epaule" => Word::Shoulder,
        "bras" => Word::UpperArm,
        "avantbras" | "coude" => Word::Forearm,
        "poignet" => Word::Wrist,
        // Without a side it is the English word for a node above the others.
        "main" if sided => Word::Hand,
        "cuisse" => Word::Thigh,
        "jambe" => Word::Leg,
        "genou" | "mollet" => Word::Shin,
        "cheville" => Word::Ankle,
        "pied" => Word::Foot,
        "orteil" | "orteils" => Word::Toes,
        _ => return None,
    })
}

/// Looks up a Japanese word.
fn japanese(core: &str) -> Option<Word> {
    Some(match core {
        "センター" => Word::Root,
        "下半身" | "腰" => Word::Hips,
        "上半身" | "胸" => Word::Spine,
        "首" => Word::Neck,
        "頭" => Word::Head,
        "顎" | "あご" => Word::Jaw,
        "目" => Word::Eye,
        "肩" => Word::Clavicle,
        "腕" | "上腕" => Word::UpperArm,
        "ひじ" | "肘" | "前腕" => Word::Forearm,
        "手首" => Word::Wrist,
        "手" => Word::Hand,
        "もも" | "太もも" => Word::Thigh,
        "足" => Word::Leg,
        "ひざ" | "膝" | "すね" => Word::Shin,
        "足首" => Word::Ankle,
        "つま先" | "爪先" => Word::Toes,
        _ => return None,
    })
}
