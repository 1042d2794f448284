//! Tests of the cross table.

use super::*;

#[test]
fn a_cell_narrows_the_query_to_its_two_values() {
    let text = |text: &str| text.to_owned();
    for (query, values, narrowed) in [
        (
            "gloss=A",
            [("placement", "neutral space"), ("signer", "Ada")],
            "gloss=A placement==\"neutral space\" signer==Ada",
        ),
        (
            "",
            [("placement", "unset"), ("movement", "\"unset\"")],
            "placement=unset movement==\"unset\"",
        ),
        (
            "a or b",
            [("attribute.class", "Noun"), ("attribute.n", "1 to 2")],
            "(a or b) attribute.class==Noun attribute.n>=1 attribute.n<2",
        ),
    ] {
        let values = values.map(|(field, value)| (text(field), text(value)));
        let found = narrowed_query(query, values.iter().map(|(field, value)| (field, value)));
        assert_eq!(found.as_deref(), Some(narrowed), "{query}");
    }
    let values = [(text("no.field"), text("x"))];
    assert_eq!(
        narrowed_query("", values.iter().map(|(field, value)| (field, value))),
        None
    );
}
