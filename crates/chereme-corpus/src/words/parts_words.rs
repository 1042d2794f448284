//! Puts the parts of messages into French: quoted words, lines, places and times.

/// Returns whether a text is somebody's own words in quotation marks, which are the same in every language.
pub(super) fn is_quoted(text: &str) -> bool {
    let inner = text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    inner.is_some_and(|inner_text| !inner_text.replace("\\\"", "").contains('"'))
}

/// Returns where words first stand in a text outside of quotation marks; inside of them if they stand nowhere else.
pub(super) fn find_unquoted(text: &str, words: &str) -> Option<usize> {
    let (mut is_inside, mut is_escaped) = (false, false);
    for (place, letter) in text.char_indices() {
        if !is_inside && text[place..].starts_with(words) {
            return Some(place);
        }
        is_inside ^= letter == '"' && !is_escaped;
        is_escaped = letter == '\\' && !is_escaped;
    }
    text.find(words)
}

/// Returns a text of several lines, each put into words alone; nothing if that changes none.
pub(super) fn by_lines(text: &str, say: &dyn Fn(&str) -> String) -> Option<String> {
    if !text.contains('\n') {
        return None;
    }
    let translated_text = text.lines().map(say).collect::<Vec<_>>().join("\n");
    Some(translated_text).filter(|said| said != text)
}

/// Returns a thing with its place or time in French: `"Gloss" of "bol"`, `"BOL" at 1.150s`, `"BOL" from 1.150s to 2.000s`,
/// or a list of spans such as `0.000s to 1.150s, 2.000s and later`.
pub(super) fn placed_in_french(text: &str, say: &dyn Fn(&str) -> String) -> Option<String> {
    let span = |text: &str| match text.split_once(" to ") {
        Some((start, end)) if is_time(start) && is_time(end) => Some(format!("{start} à {end}")),
        _ => text
            .strip_suffix(" and later")
            .filter(|start| is_time(start))
            .map(|start| format!("{start} et plus tard")),
    };
    let spans: Option<Vec<String>> = text.split(", ").map(span).collect();
    if let Some(spans) = spans {
        return Some(spans.join(", "));
    }
    if let Some(place) = find_unquoted(text, " of ")
        && let (what, whole) = (&text[..place], &text[place + " of ".len()..])
        && is_quoted(what)
        && (is_quoted(whole) || whole.starts_with("recording:"))
    {
        return Some(format!("{what} de {whole}"));
    }
    if let Some((what, times)) = text.rsplit_once(" from ")
        && let Some(span) = span(times)
    {
        return Some(format!("{} de {span}", say(what)));
    }
    let (what, at) = text.rsplit_once(" at ")?;
    is_time(at).then(|| format!("{} à {at}", say(what)))
}

/// Returns whether a text is a time such as `1.150s`.
fn is_time(text: &str) -> bool {
    let number = text.strip_suffix('s').map(|digits| digits.trim_start_matches('-'));
    number.is_some_and(|digits| {
        digits.starts_with(|c: char| c.is_ascii_digit())
            && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
    })
}

/// Returns a side in French: feminine for `{side}`, as hands are, and masculine for `{limb}`, as arms and wrists are.
pub(super) fn side_in_french(blank: &str, side: &str) -> Option<&'static str> {
    Some(match (blank, side) {
        ("side", "right") => "droite",
        ("limb", "right") => "droit",
        ("side" | "limb", "left") => "gauche",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use crate::words::{InterfaceLanguage, localized_message};

    #[test]
    fn lists_of_failures_and_things_with_times_keep_their_parts() {
        let say = |text: &str| localized_message(text, InterfaceLanguage::French).unwrap_or_else(|| text.to_owned());
        for (english, french) in [
            ("\"CHAT\" from 1.829s to 2.244s", "\"CHAT\" de 1.829s à 2.244s"),
            ("\"from 1s to 2s\" at 3.5s", "\"from 1s to 2s\" à 3.5s"),
            ("\"x\" at home", "\"x\" at home"),
            (
                "\"Gloss of \\\"x\\\"\" of \"bol of y\"",
                "\"Gloss of \\\"x\\\"\" de \"bol of y\"",
            ),
            ("\"Gloss\" of recording:\"bol\"", "\"Gloss\" de recording:\"bol\""),
            (
                "the recording \"bol\" has no track of markers",
                "l’enregistrement \"bol\" n’a pas de piste de marqueurs",
            ),
            (
                "free next to it: 0.000s to 1.150s, 2.000s and later",
                "libre à côté : 0.000s à 1.150s, 2.000s et plus tard",
            ),
            (
                "no sign is called \"the body\"",
                "aucun signe ne s’appelle \"the body\"",
            ),
            (
                "the new annotation from 0s to 1s must lie inside one annotation of the tier \"Gloss\"; \"BOL\" at 1.150s there lasts from 1.150s to 1.630s",
                "la nouvelle annotation, de 0s à 1s, doit se trouver dans une annotation de l’acteur \"Gloss\" ; \"BOL\" à 1.150s y dure de 1.150s à 1.630s",
            ),
        ] {
            assert_eq!(say(english), french);
        }
        let wrong = |message: &str, place: &str, remedy: &'static str| {
            crate::CorpusError::from_wrong_message(message)
                .with_error_place(place)
                .with_advice(remedy)
        };
        let errors = vec![
            wrong(
                "a new annotation from 1s to 2s overlaps \"BOL\" (1s to 3s) on the tier \"G\" of \"bol\"",
                "a.txt, line 1",
                "free next to it: 0s to 1s",
            ),
            wrong("nothing changed", "a.txt, line 2", "write which one"),
        ];
        let error = crate::CorpusError::from_error_list(errors);
        let french = "2 modifications sont impossibles, et aucune n’a été faite :\n\
                      a.txt, ligne 1 : une nouvelle annotation, de 1s à 2s, chevauche \"BOL\" (1s à 3s) sur l’acteur \"G\" de \"bol\" (libre à côté : 0s à 1s)\n\
                      a.txt, ligne 2 : rien n’a changé (écrivez laquelle)";
        assert_eq!(error.spoken_error_message(InterfaceLanguage::French, &say), french);
    }
}
