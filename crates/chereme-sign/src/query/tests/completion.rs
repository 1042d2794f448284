//! Tests of the completions offered at a cursor of a query.

use super::*;

#[test]
fn a_cursor_gets_the_possible_continuations() {
    for (text, expected, prefix, replaced) in COMPLETIONS {
        let cursor = text.chars().position(|c| c == '|').expect("a cursor");
        let query = text.replace('|', "");
        let found = complete_query(&query, cursor);
        let chars: Vec<char> = query.chars().collect();
        let old: String = chars[found.replace.clone()].iter().collect();
        let shown = format!("{:?}", found.expected);
        assert!(shown.starts_with(expected), "{text}: {shown}");
        assert_eq!((&found.prefix[..], &old[..]), (*prefix, *replaced), "{text}");
    }
}

/// Queries with a cursor, the expected kind of text there, the prefix, and the text to replace.
const COMPLETIONS: &[(&str, &str, &str, &str)] = &[
    ("|", "Term", "", ""),
    ("conf|", "Term", "conf", "conf"),
    ("co|nf x", "Term", "co", "conf"),
    ("gloss=A |", "Term", "", ""),
    ("not (pl|", "Term", "pl", "pl"),
    ("right.conf|", "Term", "conf", "conf"),
    ("final.right.|", "Term", "", ""),
    ("nonmanual.br|", "Part(NonManual)", "br", "br"),
    (
        "placement=|",
        "Value(ComponentField { hand: None, component: Placement",
        "",
        "",
    ),
    ("placement=chi|", "Value", "chi", "chi"),
    ("placement=ch|in gloss=A", "Value", "ch", "chin"),
    ("placement=chest,ch|", "Value", "ch", "ch"),
    ("placement = chest , |", "Value", "", ""),
    ("placement=\"neutral s|", "Value", "neutral s", "\"neutral s"),
    ("placement=\"neutral s|\" x", "Value", "neutral s", "\"neutral s\""),
    ("placement=\"neutral space\" gl|", "Term", "gl", "gl"),
    ("confguration=U|", "Unknown", "U", "U"),
    ("configuration=[|", "Feature", "", ""),
    ("configuration=[index mi|", "Feature", "mi", "mi"),
    ("configuration=[index -th|", "Feature", "th", "th"),
    ("configuration=[index] gl|", "Term", "gl", "gl"),
    ("origin=ma|", "Property(Origin)", "ma", "ma"),
    ("signer=An|", "Property(Signer)", "An", "An"),
    ("gloss:BO|", "Text(Gloss)", "BO", "BO"),
    ("gloss=INDEX:|", "Text(Gloss)", "INDEX:", "INDEX:"),
    ("gloss~A~|", "Text(Gloss)", "A~", "A~"),
    ("duration<0.|", "Time(Duration)", "0.", "0."),
    ("gloss=A overlaps |", "Annotation", "", ""),
    ("gloss=A overlaps nonmanual.|", "Part(NonManual)", "", ""),
    ("within |", "Distance", "", ""),
    ("within 0.5s |", "Reference", "", ""),
    ("within 0.5s ar|", "Reference", "ar", "ar"),
    ("within 0.5s around gl|", "Annotation", "gl", "gl"),
    ("within 0.5s of-begin gloss=|", "Text(Gloss)", "", ""),
    ("overlaps tier(|", "TierName", "", ""),
    ("overlaps tier(\"Mou|", "TierName", "Mou", "\"Mou"),
    ("overlaps tier(\"Mouthing\")=m|", "TierValue(\"Mouthing\")", "m", "m"),
    ("like |", "Example", "", ""),
    ("like token:4|", "Example", "token:4", "token:4"),
    ("like token:41 |", "AfterExample", "", ""),
    ("like token:41 o|", "AfterExample", "o", "o"),
    ("like token:41 on |", "Component", "", ""),
    ("like token:41 on configuration:2, pl|", "Component", "pl", "pl"),
    ("like token:41 on configuration gl|", "Term", "gl", "gl"),
    ("\"slow an|", "Term", "slow an", "\"slow an"),
];

#[test]
fn completions_offer_the_words_of_the_language() {
    for (text, words) in [
        ("conf", "configuration"),
        ("du", "duration"),
        ("origin=ma", "made"),
        ("hand=", "right left dominant weak both"),
        ("placement=u", "unset unclear"),
        ("over", "overlaps overlaps-begin overlaps-end"),
        ("within 1s ", "around of-begin of-end"),
        ("like token:4 on", "on"),
        (
            "right.",
            "configuration placement movement orientation nonmanual right left dominant weak initial middle final",
        ),
        ("\"conf", ""),
        ("gloss=C", ""),
    ] {
        assert_eq!(
            complete_query(text, text.chars().count()).words.join(" "),
            words,
            "{text}"
        );
    }
}
